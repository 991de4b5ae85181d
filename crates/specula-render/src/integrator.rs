//! Unidirectional path tracing with next-event estimation.
//!
//! At every vertex one light is sampled (of two, at first vertices of rough metal: `candidates`) and one
//! direction; what both can find is weighted by the
//! power heuristic (Veach 1997, 9.2.4) with exponent 3/2. From the fourth vertex on, paths survive with
//! twice their throughput's largest channel as probability, corrected for the squeezing of radiance by
//! refraction (pbrt's eta scale), at least 5 %; above 95 % roulette is not played.
//!
//! The shading frame is turned such that both normals face the viewer; a direction whose side of
//! the shading normal differs from its side of the surface carries nothing, so that light does not
//! leak. A view below the shading horizon is left to the lobes, which know it; only perfect mirrors
//! and panes, which have no answer there, take the geometric normal instead.
//!
//! Media absorb between the surface where a path enters them and the one where it leaves
//! (`medium_stack`); a path begins in none.

pub(crate) mod bias;
mod candidates;
mod path_states;
mod shade;
mod sharing;
mod vertex_batch;
mod visibility;
mod wavefront;

pub(crate) use wavefront::Wavefront;

use specula_bsdf::bsdf::{Event, Lobe};
use specula_bsdf::{Bsdf, BsdfSample, Frame, Rgb, Transport, Vec3};
use specula_scene::scene::{BumpRules, ColourParam};

use crate::accel::Ray;
use crate::bump::{self, Softness};
use crate::film::PixelSample;
use crate::geometry::{NONE, Surface};
use crate::light::{LightSample, Receiver};
use crate::material::{Coat, Material};
use crate::medium_stack::MediumStack;
use crate::offset::leave;
use crate::options::{RenderOptions, Strategy};
use crate::prepared::PreparedScene;
use crate::renderer::ScatterCounts;
use crate::sampler::Sampler;

/// Vertices before roulette begins.
const ROULETTE_FROM: u32 = 3;

/// Probability of going on with a throughput, its largest channel, refraction's squeezing taken out.
#[inline(always)]
fn survival_probability(largest: f32) -> f32 {
    (2.0 * largest).clamp(0.05, 1.0)
}

/// Weight by the power heuristic with exponent 3/2.
///
/// * `ratio`: the other strategy's density over this one's.
#[inline(always)]
fn power_heuristic(ratio: f32) -> f32 {
    1.0 / (1.0 + ratio * ratio.sqrt())
}

/// Traces paths through a scene.
#[derive(Clone, Copy)]
pub(crate) struct PathTracer<'a> {
    scene: &'a PreparedScene,
    max_depth: u32,
    strategy: Strategy,
    /// Whether paths of a group share what they find.
    shares: bool,
    /// The most radiance that a contribution of indirect light may bring; infinite where it is unbounded.
    bound: f32,
}

/// Where the last direction was sampled, if lights could have found it too.
#[derive(Clone, Copy)]
struct Previous {
    receiver: Receiver,
    pdf: f32,
}

/// A surface with its lobe and frames, turned to the viewer.
struct Vertex {
    surface: Surface,
    lobe: Lobe<f32>,
    /// Whether the lobe is black where `wi.z <= 0`.
    opaque: bool,
    frame: Frame<f32>,
    /// How light fades where a bump map by Mitsuba's rules bends the normal.
    softness: Option<Softness>,
    /// Geometric normal on the viewer's side.
    facing: Vec3<f32>,
    wo: Vec3<f32>,
}

impl Vertex {
    /// The vertex as lights are chosen for it.
    #[inline]
    fn receiver(&self) -> Receiver {
        Receiver {
            point: self.surface.position,
            normal: self.opaque.then_some(self.frame.n),
        }
    }
}

/// A path being traced.
struct State {
    radiance: Rgb<f32>,
    throughput: Rgb<f32>,
    /// Product of the squared relative indices so far.
    eta_scale: f32,
    /// What the path is in.
    media: MediumStack,
    /// Whether the path has only passed through thin panes: lights that are hidden stay so.
    straight: bool,
    /// Whether it was scattered by a lobe that is not perfectly smooth.
    rough: bool,
    /// As of `PathTracer`; infinite while others may have another throughput.
    bound: f32,
    previous: Option<Previous>,
    tally: Tally,
}

impl State {
    /// Adds light that was scattered so many times on its way to the camera.
    #[inline(always)]
    fn add(&mut self, contribution: Rgb<f32>, events: u32) {
        self.radiance += bias::bounded(contribution, events, self.bound);
    }
}

/// What is counted on the way.
#[derive(Clone, Copy, Default)]
pub(crate) struct Tally {
    pub(crate) rays: u64,
    pub(crate) scattered: ScatterCounts,
}

impl Tally {
    /// Of both.
    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            scattered: self.scattered.and(other.scattered),
        }
    }
}

/// A path on its way.
struct Path {
    sampler: Sampler,
    /// The one that it goes on with.
    ray: Ray,
    state: State,
    /// What its first vertex showed.
    first: PixelSample,
}

impl<'a> PathTracer<'a> {
    /// A tracer with the options' depth and strategy.
    pub(crate) fn new(scene: &'a PreparedScene, options: &RenderOptions) -> Self {
        Self {
            scene,
            max_depth: options.max_depth,
            strategy: options.strategy,
            shares: options.share_paths > 1,
            bound: (options.clamp).map_or(f32::INFINITY, |most| most / scene.develop.exposure()),
        }
    }

    /// What a path of a wavefront that has ended brings to its pixel, and the weight of its sample.
    #[inline(always)]
    pub(crate) fn contribution(&self, wavefront: &Wavefront, path: usize) -> (PixelSample, f32) {
        let (seen, weight) = wavefront.seen(path);
        let colour = self.scene.develop.of(seen.colour);
        (PixelSample { colour, ..seen }, weight)
    }

    /// Follows a path to its end, one vertex after the other.
    #[cfg(test)]
    fn follow(&self, path: &mut Path) {
        let mut depth = 0;
        while self.step(path, depth) {
            depth += 1;
        }
    }

    /// The material of the surface at which a sample goes wrong, if it is a surface's: follows it again
    /// until its radiance is not finite.
    #[cold]
    pub(crate) fn blame(
        &self,
        wavefront: &mut Wavefront,
        pixel: [u32; 2],
        sampler: Sampler,
    ) -> Option<u32> {
        self.begin(wavefront, std::iter::once((pixel, sampler)));
        let mut path = wavefront.first();
        let mut depth = 0;
        loop {
            let found = self.nearest(&path.ray, &path.sampler, depth, &mut path.state);
            let shape = found.as_ref().map(|s| s.shape);
            let goes_on = self.meet(&mut path, found, depth);
            let State {
                radiance,
                throughput,
                ..
            } = &path.state;
            if !goes_on || !radiance.is_finite() || !throughput.is_finite() {
                let shapes = &self.scene.geometry.shapes;
                return shape.map(|s| shapes[s as usize].material);
            }
            depth += 1;
        }
    }

    /// Takes a path from one vertex to the next; returns whether it goes on.
    fn step(&self, path: &mut Path, depth: u32) -> bool {
        let found = self.nearest(&path.ray, &path.sampler, depth, &mut path.state);
        self.meet(path, found, depth)
    }

    /// What a path does where its ray ends; returns whether it goes on.
    ///
    /// * `found`: the surface there; `None` where there is none.
    fn meet(&self, path: &mut Path, found: Option<Surface>, depth: u32) -> bool {
        let Path { ray, state, .. } = path;
        let Some(surface) = found else {
            if !(state.straight && self.scene.hide_emitters) {
                let radiance = self.background(state.previous, ray.direction);
                state.add(state.throughput * radiance, depth);
            }
            return false;
        };
        let radiance = self.emission(state.previous, &surface, ray.direction);
        state.add(state.throughput * radiance, depth);
        self.pass_on(path, surface, depth)
    }

    /// What a path does at a surface, its emission aside; returns whether it goes on.
    fn pass_on(&self, path: &mut Path, surface: Surface, depth: u32) -> bool {
        let Path {
            sampler,
            ray,
            state,
            first,
        } = path;
        if depth >= self.max_depth && depth > 0 {
            return false;
        }
        let vertex = self.vertex(surface, -ray.direction, sampler, depth, state.rough);
        if depth == 0 {
            first.albedo = vertex.lobe.albedo();
            first.normal = vertex.frame.n;
            first.depth = Some((vertex.surface.position - ray.origin).length());
            if self.max_depth == 0 {
                return false;
            }
        }
        self.add_direct(state, &vertex, sampler, depth);
        match self.scatter(state, &vertex, sampler, depth) {
            Some(next) => *ray = next,
            None => return false,
        }
        true
    }

    /// Light from infinity on a ray that meets nothing.
    ///
    /// * `previous`: where it was sampled, if lights could have found it too.
    #[inline]
    fn background(&self, previous: Option<Previous>, direction: Vec3<f32>) -> Rgb<f32> {
        let lights = &self.scene.lights;
        let mut sum = Rgb::BLACK;
        for (radiance, pdf) in lights.arriving_from_infinity(direction) {
            let weight = self.lobe_weight(previous, |receiver| {
                lights.share_from_infinity(receiver) * pdf
            });
            sum += radiance * weight;
        }
        sum
    }

    /// Light that the surface sends out itself.
    ///
    /// * `previous`: as of [`Self::background`].
    #[inline]
    fn emission(
        &self,
        previous: Option<Previous>,
        surface: &Surface,
        direction: Vec3<f32>,
    ) -> Rgb<f32> {
        let shape = &self.scene.geometry.shapes[surface.shape as usize];
        let emits = shape.two_sided || surface.ng.dot(direction) < 0.0;
        if surface.light == NONE || !emits {
            return Rgb::BLACK;
        }
        let weight = self.lobe_weight(previous, |receiver| {
            self.scene.lights.pdf_of_surface(receiver, surface)
        });
        let radiance = match shape.radiance {
            ColourParam::Value(radiance) => radiance,
            textured => {
                let place = surface.place();
                let colour = self.scene.textures.colour(textured, &place);
                colour.map(|v| v.max(0.0))
            }
        };
        radiance * weight
    }

    /// Weight of light found by a lobe's direction.
    #[inline]
    fn lobe_weight(
        &self,
        previous: Option<Previous>,
        light_pdf: impl FnOnce(&Receiver) -> f32,
    ) -> f32 {
        match (previous, self.strategy) {
            (None, _) | (_, Strategy::BsdfOnly) => 1.0,
            (_, Strategy::LightsOnly) => 0.0,
            (Some(p), _) => self.heuristic(p.pdf, light_pdf(&p.receiver)),
        }
    }

    /// Weight of the strategy with density `a` against the one with density `b`.
    #[inline]
    fn heuristic(&self, a: f32, b: f32) -> f32 {
        // As a ratio: squares of densities overflow.
        let ratio = b / a;
        match self.strategy {
            Strategy::Balance => 1.0 / (1.0 + ratio),
            Strategy::Power => 1.0 / (1.0 + ratio * ratio),
            _ => power_heuristic(ratio),
        }
    }

    /// * `rough`: whether the path was scattered by a lobe that is not perfectly smooth.
    fn vertex(
        &self,
        surface: Surface,
        wo: Vec3<f32>,
        sampler: &Sampler,
        depth: u32,
        rough: bool,
    ) -> Vertex {
        let outside = surface.ng.dot(wo) > 0.0;
        let facing = if outside { surface.ng } else { -surface.ng };
        let shape = &self.scene.geometry.shapes[surface.shape as usize];
        let textures = &self.scene.textures;
        let place = surface.place();
        let materials = &self.scene.materials;
        let material = materials.on_path(shape.material, rough);
        let chosen = materials.at(material, textures, &place, |level| {
            sampler.hashed([depth, level, 0])
        });
        let mut lobe = chosen.lobe(textures, &place, outside);
        let material = chosen.material;
        let (ns, tangent) = self.shading(&surface, material);
        let tangent = if material.is_plain_and_isotropic() {
            Vec3::ZERO
        } else {
            tangent
        };
        let ns = if ns.dot(facing) < 0.0 { -ns } else { ns };
        let (ns, softness) = match material.bump_rules {
            BumpRules::Mitsuba { fades } if material.bump.is_some() => {
                let unbent = surface.ns;
                let sign = if unbent.dot(facing) < 0.0 { -1.0 } else { 1.0 };
                Softness::new(unbent * sign, ns, wo, fades)
            }
            _ => (ns, None),
        };
        let n = if ns.dot(wo) <= 0.0 && lobe.is_specular() {
            facing
        } else {
            ns
        };
        let frame = Frame::from_normal_tangent(n, tangent);
        if let (Some(coat), Lobe::Gltf(gltf)) = (material.coat, &mut lobe) {
            let normal = self.coat_normal(coat, &surface, facing);
            *gltf = gltf.with_coat_normal(frame.to_local(normal));
        }
        Vertex {
            surface,
            opaque: chosen.is_opaque(&lobe),
            lobe,
            frame,
            softness,
            facing,
            wo: wo.normalize(),
        }
    }

    /// Shading normal and tangent, bent and turned as the material asks.
    #[inline]
    fn shading(&self, surface: &Surface, material: &Material) -> (Vec3<f32>, Vec3<f32>) {
        let (ns, tangent) = match &material.bump {
            None => (surface.ns, surface.tangent),
            Some(r) => {
                let PreparedScene {
                    textures, geometry, ..
                } = self.scene;
                bump::bend(r, material.bump_rules, textures, geometry, surface)
            }
        };
        let rotation_rad = material.rotation_rad(&self.scene.textures, || surface.place());
        if rotation_rad == 0.0 {
            return (ns, tangent);
        }
        let [_, along_v] = self.scene.geometry.partials(surface).dp;
        let frame = Frame::from_normal_tangent(ns, tangent);
        let side = if frame.t.dot(along_v) < 0.0 {
            -1.0
        } else {
            1.0
        };
        let (sin, cos) = rotation_rad.sin_cos();
        (ns, frame.s * cos + frame.t * (sin * side))
    }

    /// The normal of a clear coat, on the side of `facing`.
    fn coat_normal(&self, coat: Coat, surface: &Surface, facing: Vec3<f32>) -> Vec3<f32> {
        let scene = self.scene;
        let normal = match &coat.0 {
            None => surface.ns,
            Some(r) => {
                let rules = BumpRules::Plain;
                bump::bend(r, rules, &scene.textures, &scene.geometry, surface).0
            }
        };
        let side = if normal.dot(facing) < 0.0 { -1.0 } else { 1.0 };
        normal * side
    }

    /// Light from one sampled light.
    #[inline]
    fn add_direct(&self, state: &mut State, vertex: &Vertex, sampler: &Sampler, depth: u32) {
        if vertex.lobe.is_specular() {
            return;
        }
        let count = self.lights_at(&vertex.lobe, depth);
        let consider = |which| self.consider_light(state, vertex, sampler, depth, [which, count]);
        let first = consider(0);
        let kept = if count == 1 {
            first
        } else {
            candidates::keep_one([first, consider(1)], || candidates::choice(sampler, depth))
        };
        let Some((light, contribution)) = kept else {
            return;
        };
        let mut beyond;
        let media = if vertex.frame.n.dot(light.wi) < 0.0 {
            beyond = state.media;
            self.cross(&mut beyond, &vertex.surface, light.wi);
            &beyond
        } else {
            &state.media
        };
        let s = &vertex.surface;
        let place = (s.position, s.error, s.ng);
        let left = self.transmittance(place, &light, media, sampler, depth, &mut state.tally.rays);
        if let Some(left) = left {
            state.add(contribution * left, depth + 1);
        }
    }

    /// Samples a light, and says what it would bring to the path; `None`: nothing.
    ///
    /// * `which`, `count`: of how many.
    #[inline]
    fn consider_light(
        &self,
        state: &State,
        vertex: &Vertex,
        sampler: &Sampler,
        depth: u32,
        [which, count]: [u32; 2],
    ) -> Option<(LightSample, Rgb<f32>)> {
        let receiver = vertex.receiver();
        let scene = self.scene;
        let world = (&scene.geometry, &scene.textures);
        let u = candidates::random_numbers(sampler.light(depth), which, count);
        let mut light = scene.lights.sample(&receiver, world, u)?;
        if self.strategy == Strategy::BsdfOnly && !light.delta {
            return None;
        }
        light.pdf *= count as f32;
        let wi = vertex.frame.to_local(light.wi);
        if wi.z * vertex.facing.dot(light.wi) <= 0.0 {
            return None;
        }
        let wo = vertex.frame.to_local(vertex.wo);
        let mut stream = sampler.stream(depth, candidates::stream(which));
        let (f_cos, pdf) = vertex
            .lobe
            .eval_pdf_random(wo, wi, Transport::Radiance, &mut stream);
        if f_cos.is_black() {
            return None;
        }
        let f_cos = match &vertex.softness {
            Some(softness) => f_cos * softness.factor(light.wi),
            None => f_cos,
        };
        let weight = if light.delta || self.strategy == Strategy::LightsOnly {
            1.0
        } else {
            self.heuristic(light.pdf, pdf)
        };
        let contribution = state.throughput * f_cos * (light.radiance * (weight / light.pdf));
        (weight > 0.0).then_some((light, contribution))
    }

    /// Samples the next direction; `None` where the path ends.
    #[inline]
    fn scatter(
        &self,
        state: &mut State,
        vertex: &Vertex,
        sampler: &Sampler,
        depth: u32,
    ) -> Option<Ray> {
        let [u0, u1, u2, survival] = sampler.scatter(depth);
        let wo = vertex.frame.to_local(vertex.wo);
        let mut stream = sampler.stream(depth, 1);
        let sample =
            (vertex.lobe).sample_random(wo, [u0, u1, u2], Transport::Radiance, &mut stream);
        if !matches!(vertex.lobe, Lobe::Black(_)) {
            let scattered = &mut state.tally.scattered;
            scattered.sampled += 1;
            scattered.rejected += u64::from(sample.is_none());
        }
        let BsdfSample {
            wi,
            weight,
            pdf,
            specular,
            eta,
            event,
        } = sample?;
        let direction = vertex.frame.to_world(wi).normalize();
        if wi.z * vertex.facing.dot(direction) <= 0.0 {
            return None;
        }
        state.throughput *= weight;
        if let Some(softness) = &vertex.softness {
            state.throughput *= softness.factor(direction);
        }
        state.eta_scale *= eta * eta;
        state.rough |= !specular;
        state.straight &=
            matches!(vertex.lobe, Lobe::ThinDielectric(_)) && event == Event::Transmission;
        if event == Event::Transmission {
            self.cross(&mut state.media, &vertex.surface, direction);
        }
        let largest = state.throughput.max_channel() * state.eta_scale;
        if largest.is_nan() || largest <= 0.0 {
            return None;
        }
        let probability = survival_probability(largest);
        if depth >= ROULETTE_FROM && probability < 0.95 {
            if survival >= probability {
                return None;
            }
            state.throughput *= 1.0 / probability;
        }
        let s = &vertex.surface;
        state.previous = (!specular).then_some(Previous {
            receiver: vertex.receiver(),
            pdf: candidates::density(pdf, self.lights_at(&vertex.lobe, depth)),
        });
        Some(Ray {
            origin: leave(s.position, s.error, s.ng, direction),
            direction,
            t_max: f32::INFINITY,
        })
    }
}
