//! Rays through cut-outs, hidden lights, boundaries of media that have no surface, and out of fibres of hair.

use specula_bsdf::{Rgb, Vec3};

use super::estimator::{self, MOST_PASSES};
use super::{PathState, PathTracer};
use crate::accel::Ray;
use crate::geometry::{NONE, Surface};
use crate::light::LightSample;
use crate::medium_stack::{MediumStack, transmittance};
use crate::offset::SurfacePoint;
use crate::sampler::Sampler;

/// What a surface does to a ray that hits it.
enum Passage {
    /// The ray ends.
    Blocked,
    /// The ray passes as if nothing were there.
    Free,
    /// The ray passes from one medium into another.
    Boundary,
}

impl PathTracer<'_> {
    /// The first surface that blocks the ray. Media on the way absorb.
    ///
    /// Hidden lights let camera rays pass until these have hit something else, as in Mitsuba.
    #[inline]
    pub(super) fn intersect(
        &self,
        ray: &Ray,
        sampler: &Sampler,
        depth: u32,
        state: &mut PathState,
    ) -> Option<Surface> {
        let geometry = &self.scene.geometry;
        let mut ray = *ray;
        let mut begin = ray.origin;
        let mut hidden = self.scene.hide_emitters && depth == 0;
        let time = self.time(sampler);
        for pass in 0..MOST_PASSES {
            state.tally.rays += 1;
            let hit = geometry.accel.intersect_at(&ray, time)?;
            let surface = geometry.surface(&ray, &hit, time);
            hidden &= surface.light != NONE;
            let passage = match (hidden, geometry.has_passable) {
                (true, _) => Passage::Free,
                (false, true) => self.passage(&surface, ray.direction, sampler, [depth, pass, 1]),
                (false, false) => Passage::Blocked,
            };
            if let (Some(absorption), Passage::Blocked | Passage::Boundary) =
                (state.media.absorption(), &passage)
            {
                let distance = (surface.position - begin).length();
                state.throughput *= transmittance(absorption, distance);
            }
            match passage {
                Passage::Blocked => return Some(surface),
                Passage::Free => {}
                Passage::Boundary => {
                    self.cross(&mut state.media, &surface, ray.direction);
                    begin = surface.position;
                }
            }
            ray.origin = surface.point().ray_origin(ray.direction);
        }
        None
    }

    /// Transmittance from a light to the vertex; `None` where the light is occluded.
    ///
    /// * `from`: the vertex.
    /// * `media`: those at the vertex, on the light's side.
    #[inline]
    pub(super) fn transmittance(
        &self,
        from: &SurfacePoint,
        light: &LightSample,
        media: &MediumStack,
        sampler: &Sampler,
        depth: u32,
        rays: &mut u64,
    ) -> Option<Rgb<f32>> {
        let ray = match &light.target {
            None => estimator::spawn_ray(from, light.wi),
            Some(target) => estimator::shadow_ray(from, light.wi, target),
        };
        let geometry = &self.scene.geometry;
        let end = light.target.as_ref().map(|target| target.position);
        if geometry.has_passable {
            let way = (from.position, end);
            return self.transmittance_through(ray, way, *media, (sampler, depth), rays);
        }
        *rays += 1;
        let visible = !geometry.accel.occluded_at(&ray, self.time(sampler));
        visible.then(|| transmittance_to_light(from.position, end, media))
    }

    /// [`PathTracer::transmittance`] where some surfaces let rays pass.
    ///
    /// * `begin`, `end`: the vertex and the light; no end: it is at infinity.
    pub(super) fn transmittance_through(
        &self,
        mut ray: Ray,
        (mut begin, end): (Vec3<f32>, Option<Vec3<f32>>),
        mut media: MediumStack,
        (sampler, depth): (&Sampler, u32),
        rays: &mut u64,
    ) -> Option<Rgb<f32>> {
        let geometry = &self.scene.geometry;
        let mut product = Rgb::WHITE;
        let time = self.time(sampler);
        for pass in 0..MOST_PASSES {
            *rays += 1;
            let Some(hit) = geometry.accel.intersect_at(&ray, time) else {
                return Some(product * transmittance_to_light(begin, end, &media));
            };
            let surface = geometry.surface(&ray, &hit, time);
            match self.passage(&surface, ray.direction, sampler, [depth, pass, 2]) {
                Passage::Blocked => return None,
                Passage::Free => {}
                Passage::Boundary => {
                    if let Some(absorption) = media.absorption() {
                        let distance = (surface.position - begin).length();
                        product *= transmittance(absorption, distance);
                    }
                    self.cross(&mut media, &surface, ray.direction);
                    begin = surface.position;
                }
            }
            ray.origin = surface.point().ray_origin(ray.direction);
            ray.t_max -= hit.t;
            if ray.t_max <= 0.0 {
                return Some(product * transmittance_to_light(begin, end, &media));
            }
        }
        None
    }

    /// What a surface does to a ray: by chance where it is partly transparent.
    fn passage(
        &self,
        surface: &Surface,
        direction: Vec3<f32>,
        sampler: &Sampler,
        key: [u32; 3],
    ) -> Passage {
        let shape = &self.scene.geometry.shapes[surface.shape as usize];
        let there = shape.alpha.is_none_or(|alpha| {
            let alpha = self.scene.textures.float(alpha, &surface.place());
            alpha >= 1.0 || sampler.hashed(key) < alpha
        });
        let is_passed = shape.is_interface || shape.is_left_by(surface.ng, direction);
        match (there, is_passed) {
            (false, _) => Passage::Free,
            (true, false) => Passage::Blocked,
            (true, true) => Passage::Boundary,
        }
    }

    /// Updates the media where a path passes a surface that bounds one.
    #[inline]
    pub(super) fn cross(&self, media: &mut MediumStack, surface: &Surface, direction: Vec3<f32>) {
        let material = self.scene.geometry.shapes[surface.shape as usize].material;
        if let Some(boundary) = self.scene.materials.boundary(material) {
            media.cross(material, boundary, surface.ng.dot(direction) < 0.0);
        }
    }
}

/// Transmittance of the medium in front of the light. A vertex that sees infinity is in no closed medium.
fn transmittance_to_light(
    begin: Vec3<f32>,
    end: Option<Vec3<f32>>,
    media: &MediumStack,
) -> Rgb<f32> {
    match (media.absorption(), end) {
        (Some(absorption), Some(end)) => transmittance(absorption, (end - begin).length()),
        _ => Rgb::WHITE,
    }
}
