//! What rays pass on their way: cut-outs, hidden lights, and boundaries without surface, between
//! which media absorb.

use specula_bsdf::{Rgb, Vec3};

use super::{PathTracer, State};
use crate::accel::Ray;
use crate::geometry::{NONE, Surface};
use crate::light::LightSample;
use crate::medium_stack::{MediumStack, transmittance};
use crate::offset::leave;
use crate::sampler::Sampler;

/// How much of the ray to a light is looked at: not its very end.
pub(super) const TO_LIGHT: f32 = 1.0 - 1e-4;
/// Most surfaces that a ray passes.
const MOST_PASSES: u32 = 4096;

/// What a surface does with a ray that meets it.
enum Meeting {
    Stops,
    /// It is not there.
    Passes,
    /// It bounds what absorbs, and nothing else.
    Crosses,
}

impl PathTracer<'_> {
    /// The first surface that does not let the ray pass, and what is absorbed on the way to it.
    /// Hidden lights let the camera's rays pass until these have met something else, as in Mitsuba.
    #[inline]
    pub(super) fn nearest(
        &self,
        ray: &Ray,
        sampler: &Sampler,
        depth: u32,
        state: &mut State,
    ) -> Option<Surface> {
        let geometry = &self.scene.geometry;
        let mut ray = *ray;
        let mut begin = ray.origin;
        let mut hidden = self.scene.hide_emitters && depth == 0;
        for pass in 0..MOST_PASSES {
            state.tally.rays += 1;
            let hit = geometry.accel.intersect(&ray)?;
            let surface = geometry.surface(&ray, &hit);
            hidden &= surface.light != NONE;
            let meeting = match (hidden, geometry.has_passable) {
                (true, _) => Meeting::Passes,
                (false, true) => self.meeting(&surface, sampler, [depth, pass, 1]),
                (false, false) => Meeting::Stops,
            };
            if let (Some(absorption), Meeting::Stops | Meeting::Crosses) =
                (state.media.absorption(), &meeting)
            {
                let distance = (surface.position - begin).length();
                state.throughput *= transmittance(absorption, distance);
            }
            match meeting {
                Meeting::Stops => return Some(surface),
                Meeting::Passes => {}
                Meeting::Crosses => {
                    self.cross(&mut state.media, &surface, ray.direction);
                    begin = surface.position;
                }
            }
            ray.origin = leave(surface.position, surface.error, surface.ng, ray.direction);
        }
        None
    }

    /// What is left of a light's radiance on its way to the vertex; `None` where something stands
    /// between them.
    ///
    /// * `position`, `error`, `ng`: of the vertex' surface.
    /// * `media`: what the vertex is in, on the light's side.
    #[inline]
    pub(super) fn transmittance(
        &self,
        (position, error, ng): (Vec3<f32>, Vec3<f32>, Vec3<f32>),
        light: &LightSample,
        media: &MediumStack,
        sampler: &Sampler,
        depth: u32,
        rays: &mut u64,
    ) -> Option<Rgb<f32>> {
        let origin = leave(position, error, ng, light.wi);
        let ray = match light.from {
            None => Ray {
                origin,
                direction: light.wi,
                t_max: f32::INFINITY,
            },
            Some(target) => Ray {
                origin,
                direction: leave(target.point, target.error, target.normal, -light.wi) - origin,
                t_max: TO_LIGHT,
            },
        };
        if self.scene.geometry.has_passable {
            return self.transmittance_through(
                ray,
                position,
                light,
                *media,
                (sampler, depth),
                rays,
            );
        }
        *rays += 1;
        let visible = !self.scene.geometry.accel.occluded(&ray);
        visible.then(|| last_stretch(position, light, media))
    }

    /// [`PathTracer::transmittance`] where some surfaces let rays pass.
    fn transmittance_through(
        &self,
        mut ray: Ray,
        mut begin: Vec3<f32>,
        light: &LightSample,
        mut media: MediumStack,
        (sampler, depth): (&Sampler, u32),
        rays: &mut u64,
    ) -> Option<Rgb<f32>> {
        let geometry = &self.scene.geometry;
        let mut left = Rgb::WHITE;
        for pass in 0..MOST_PASSES {
            *rays += 1;
            let Some(hit) = geometry.accel.intersect(&ray) else {
                return Some(left * last_stretch(begin, light, &media));
            };
            let surface = geometry.surface(&ray, &hit);
            match self.meeting(&surface, sampler, [depth, pass, 2]) {
                Meeting::Stops => return None,
                Meeting::Passes => {}
                Meeting::Crosses => {
                    if let Some(absorption) = media.absorption() {
                        let distance = (surface.position - begin).length();
                        left *= transmittance(absorption, distance);
                    }
                    self.cross(&mut media, &surface, ray.direction);
                    begin = surface.position;
                }
            }
            ray.origin = leave(surface.position, surface.error, surface.ng, ray.direction);
            ray.t_max -= hit.t;
            if ray.t_max <= 0.0 {
                return Some(left * last_stretch(begin, light, &media));
            }
        }
        None
    }

    /// What a surface does with a ray, by chance where it is partly transparent.
    fn meeting(&self, surface: &Surface, sampler: &Sampler, key: [u32; 3]) -> Meeting {
        let shape = &self.scene.geometry.shapes[surface.shape as usize];
        let there = shape.alpha.is_none_or(|alpha| {
            let alpha = self.scene.textures.float(alpha, &surface.place());
            alpha >= 1.0 || sampler.hashed(key) < alpha
        });
        match (there, shape.is_interface) {
            (false, _) => Meeting::Passes,
            (true, false) => Meeting::Stops,
            (true, true) => Meeting::Crosses,
        }
    }

    /// Passes a surface: what the path is in changes where that bounds a body.
    #[inline]
    pub(super) fn cross(&self, media: &mut MediumStack, surface: &Surface, direction: Vec3<f32>) {
        let material = self.scene.geometry.shapes[surface.shape as usize].material;
        if let Some(boundary) = self.scene.materials.boundary(material) {
            media.cross(material, boundary, surface.ng.dot(direction) < 0.0);
        }
    }
}

/// What the last body leaves of a light. What sees one at infinity is in none that is closed.
fn last_stretch(begin: Vec3<f32>, light: &LightSample, media: &MediumStack) -> Rgb<f32> {
    match (media.absorption(), &light.from) {
        (Some(absorption), Some(target)) => {
            transmittance(absorption, (target.point - begin).length())
        }
        _ => Rgb::WHITE,
    }
}
