//! Unidirectional path tracing with next-event estimation.
//!
//! At every vertex one light is sampled (two at first vertices of rough metal: `candidates`) and one direction.
//! Both are combined by the power heuristic. The rules are in `estimator`. `wavefront` and `shade` apply them to
//! batches of vertices, `bound` where lobes differ from vertex to vertex. This module applies them to single vertices,
//! with any material, through cut-outs and media; it is the reference of the others.
//!
//! Both normals of a vertex face the viewer. A direction whose sides of the two differ carries nothing, so that
//! light does not leak. Lobes answer for views below the shading horizon; perfect mirrors and panes have no
//! answer there and take the geometric normal instead.
//!
//! Hair scatters to both sides of its normals, and from where a ray enters a fibre to where it leaves it: rays within
//! fibres pass (`visibility`).
//!
//! Media absorb between the surface where a path enters them and the one where it leaves (`medium_stack`). A
//! path begins in none.

mod bound;
mod bumped;
mod candidates;
mod direct;
pub(crate) mod estimator;
mod faces;
mod footprints;
mod hair;
mod lens_rays;
mod own_lobes;
mod path_states;
mod quadrics;
mod queue;
mod ray_queue;
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
use crate::bump::Softness;
use crate::film::{PixelSample, ScatterCounts, VertexCounts};
use crate::geometry::{HairShape, NONE, Surface};
use crate::light::{LightSample, Receiver};
use crate::material::PointLobe;
use crate::medium_stack::MediumStack;
use crate::options::{RenderOptions, Strategy};
use crate::prepared::PreparedScene;
use crate::ray_cone::RayCone;
use crate::sampler::Sampler;

/// Traces paths through a scene.
#[derive(Clone, Copy)]
pub(crate) struct PathTracer<'a> {
    scene: &'a PreparedScene,
    max_depth: u32,
    strategy: Strategy,
    /// Whether paths of a group share vertices.
    shares: bool,
    /// Largest contribution of indirect light, as radiance; infinite where it is not clamped.
    bound: f32,
}

/// The vertex where the last direction was sampled.
#[derive(Clone, Copy)]
struct PreviousVertex {
    receiver: Receiver,
    /// Density of the direction, per light candidate.
    pdf: f32,
}

/// A surface with its lobe and shading frame, which faces the viewer.
struct ShadingPoint<'a> {
    surface: Surface,
    lobe: PointLobe<'a>,
    /// That of the lobe: one of the parts where materials are mixed.
    material: u32,
    /// Whether the lobe is black where `wi.z <= 0`.
    opaque: bool,
    frame: Frame<f32>,
    /// How light fades where a bump map by Mitsuba's rules bends the normal.
    softness: Option<Softness>,
    /// Geometric normal on the viewer's side.
    facing: Vec3<f32>,
    wo: Vec3<f32>,
}

impl ShadingPoint<'_> {
    /// The point as lights are chosen for it.
    #[inline]
    fn receiver(&self) -> Receiver {
        Receiver {
            point: self.surface.position,
            normal: self.opaque.then_some(self.frame.n),
        }
    }
}

/// The state of a path.
struct PathState {
    radiance: Rgb<f32>,
    throughput: Rgb<f32>,
    /// Product of the squared relative indices so far.
    eta_scale: f32,
    /// The media that the path is in.
    media: MediumStack,
    /// What the path stands for, at its last vertex; where textures are filtered.
    cone: RayCone,
    /// Whether the path has passed through thin panes only: hidden lights stay hidden.
    straight: bool,
    /// Whether it was scattered by a lobe that is not perfectly smooth.
    rough: bool,
    /// As of `PathTracer`; infinite while the path is shared, as others may have another throughput.
    bound: f32,
    previous: Option<PreviousVertex>,
    tally: Tally,
}

impl PathState {
    /// Adds light that was scattered `events` times on its way to the camera.
    #[inline(always)]
    fn add(&mut self, contribution: Rgb<f32>, events: u32) {
        self.radiance += estimator::clamp_indirect(contribution, events, self.bound);
    }
}

/// Counts of a render.
#[derive(Clone, Copy, Default)]
pub(crate) struct Tally {
    pub(crate) rays: u64,
    pub(crate) scattered: ScatterCounts,
    pub(crate) vertices: VertexCounts,
}

impl Tally {
    /// Of both.
    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            scattered: self.scattered.and(other.scattered),
            vertices: self.vertices.and(other.vertices),
        }
    }
}

/// A path.
struct Path {
    sampler: Sampler,
    /// The ray to its next vertex.
    ray: Ray,
    state: PathState,
    /// Albedo, normal and depth of its first vertex.
    first: PixelSample,
}

/// The point from which light behind a portal is seen: where a light sample could have had the ray's direction, else
/// where the ray begins.
#[inline]
fn portal_viewpoint(previous: Option<&PreviousVertex>, ray: &Ray) -> Vec3<f32> {
    previous.map_or(ray.origin, |p| p.receiver.point)
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

    /// The time of a path, in exposures: 0 where nothing moves.
    #[inline(always)]
    fn time(&self, sampler: &Sampler) -> f32 {
        if self.scene.moves {
            sampler.time()
        } else {
            0.0
        }
    }

    /// The pixel sample of a path that has ended, developed, and its filter weight.
    #[inline(always)]
    pub(crate) fn contribution(&self, wavefront: &Wavefront, path: usize) -> (PixelSample, f32) {
        let (sample, weight) = wavefront.pixel_sample(path);
        let colour = self.scene.develop.of(sample.colour);
        (PixelSample { colour, ..sample }, weight)
    }

    /// Follows a path to its end, one vertex after the other.
    #[cfg(test)]
    fn follow(&self, path: &mut Path) {
        let mut depth = 0;
        while self.step(path, depth) {
            depth += 1;
        }
    }

    /// The material at which a sample became invalid; `None` beyond all surfaces. Follows the path again until
    /// its radiance is not finite.
    #[cold]
    pub(crate) fn material_of_invalid_sample(
        &self,
        wavefront: &mut Wavefront,
        pixel: [u32; 2],
        sampler: Sampler,
    ) -> Option<u32> {
        self.begin(wavefront, std::iter::once((pixel, sampler)));
        let mut path = wavefront.first_path();
        let mut depth = 0;
        loop {
            let surface = self.intersect(&path.ray, &path.sampler, depth, &mut path.state);
            let shape = surface.as_ref().map(|s| s.shape);
            let continues = self.shade(&mut path, surface, depth);
            let PathState {
                radiance,
                throughput,
                ..
            } = &path.state;
            if !continues || !radiance.is_finite() || !throughput.is_finite() {
                let shapes = &self.scene.geometry.shapes;
                return shape.map(|s| shapes[s as usize].material);
            }
            depth += 1;
        }
    }

    /// Takes a path from one vertex to the next; returns whether it continues.
    fn step(&self, path: &mut Path, depth: u32) -> bool {
        let surface = self.intersect(&path.ray, &path.sampler, depth, &mut path.state);
        self.shade(path, surface, depth)
    }

    /// Adds emission where a path's ray ends, and shades the surface there; returns whether the path continues.
    ///
    /// * `surface`: `None` where the ray hit nothing.
    fn shade(&self, path: &mut Path, surface: Option<Surface>, depth: u32) -> bool {
        let Path { ray, state, .. } = path;
        let Some(surface) = surface else {
            if !(state.straight && self.scene.hide_emitters) {
                let radiance = self.background(state.previous, ray);
                state.add(state.throughput * radiance, depth);
            }
            return false;
        };
        let radiance = self.emission(state.previous, &surface, ray.direction);
        state.add(state.throughput * radiance, depth);
        self.shade_surface(path, surface, depth)
    }

    /// Adds direct light at a surface and scatters the path; returns whether it continues.
    fn shade_surface(&self, path: &mut Path, surface: Surface, depth: u32) -> bool {
        let Path {
            sampler,
            ray,
            state,
            first,
        } = path;
        if depth >= self.max_depth && depth > 0 {
            return false;
        }
        state.tally.vertices.single += 1;
        let surface = self.with_footprint(surface, ray, state);
        let vertex = self.shading_point(surface, -ray.direction, sampler, depth, state.rough);
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

    /// Light from infinity on a ray that hits nothing, with its MIS weight.
    ///
    /// * `previous`: where the ray was sampled; `None` where no light sample could have had its direction.
    #[inline]
    fn background(&self, previous: Option<PreviousVertex>, ray: &Ray) -> Rgb<f32> {
        let lights = &self.scene.lights;
        let mut sum = Rgb::BLACK;
        let direction = ray.direction;
        let from = portal_viewpoint(previous.as_ref(), ray);
        let through_portals = lights.arriving_through_portals(from, direction);
        for (radiance, pdf) in (lights.arriving_from_infinity(direction)).chain(through_portals) {
            let weight = self.emission_weight(previous, |receiver| {
                lights.share_from_infinity(receiver) * pdf
            });
            sum += radiance * weight;
        }
        sum
    }

    /// Emission of a surface, with its MIS weight.
    ///
    /// * `previous`: as of [`Self::background`].
    #[inline]
    fn emission(
        &self,
        previous: Option<PreviousVertex>,
        surface: &Surface,
        direction: Vec3<f32>,
    ) -> Rgb<f32> {
        let shape = &self.scene.geometry.shapes[surface.shape as usize];
        let emits = shape.two_sided || surface.ng.dot(direction) < 0.0;
        if surface.light == NONE || !emits {
            return Rgb::BLACK;
        }
        let weight = self.emission_weight(previous, |receiver| {
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

    /// MIS weight of emission on a ray that a lobe sampled, or the camera.
    ///
    /// * `light_pdf`: density with which light sampling takes the direction at a receiver.
    #[inline]
    fn emission_weight(
        &self,
        previous: Option<PreviousVertex>,
        light_pdf: impl FnOnce(&Receiver) -> f32,
    ) -> f32 {
        match previous {
            None => estimator::emission_weight(self.strategy, None, || 0.0),
            Some(p) => {
                estimator::emission_weight(self.strategy, Some(p.pdf), || light_pdf(&p.receiver))
            }
        }
    }

    /// The surface with its material's lobe and its shading frame.
    ///
    /// * `rough`: as of `PathState`.
    fn shading_point(
        &self,
        surface: Surface,
        wo: Vec3<f32>,
        sampler: &Sampler,
        depth: u32,
        rough: bool,
    ) -> ShadingPoint<'a> {
        let outside = surface.ng.dot(wo) > 0.0;
        let facing = if outside { surface.ng } else { -surface.ng };
        let shape = &self.scene.geometry.shapes[surface.shape as usize];
        let textures = &self.scene.textures;
        let place = surface.place();
        let materials = &self.scene.materials;
        let material = materials.on_path(shape.material, rough);
        let chosen = materials.at(material, textures, &place, outside, |level| {
            sampler.hashed([depth, level, 0])
        });
        let material = chosen.material;
        let bent = self.bumped_frame(&surface, material);
        let coat = (material.coat).map(|coat| self.bumped_coat(coat, &surface, facing));
        let ns = bent.normal;
        let tangent = if material.takes_any_tangent && bent.spread.is_none() {
            Vec3::ZERO
        } else {
            bent.tangent
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
        let mut frame = Frame::from_normal_tangent(ns, tangent);
        let own_coat = coat.map_or(0.0, |c| c.spread.map_or(0.0, |s| s.trace_about(c.normal)));
        let mut lobe = if bent.spread.is_none() && own_coat <= 0.0 {
            chosen.lobe(textures, &place, outside)
        } else {
            let map = bent
                .spread
                .map_or_else(Default::default, |s| s.within(&frame));
            let (widening, turn_rad) = chosen.widening(textures, &place, map, own_coat);
            let (sin, cos) = turn_rad.sin_cos();
            frame = Frame::from_normal_tangent(ns, frame.s * cos + frame.t * sin);
            chosen.widened_lobe(textures, &place, outside, &widening)
        };
        if ns.dot(wo) <= 0.0 && lobe.is_specular() {
            frame = Frame::from_normal_tangent(facing, tangent);
        }
        if let (Some(coat), PointLobe::Listed(Lobe::Gltf(gltf))) = (coat, &mut lobe) {
            *gltf = gltf.with_coat_normal(frame.to_local(coat.normal));
        }
        if let (PointLobe::Hair(hair), Some(HairShape::Surface)) = (&mut lobe, shape.hair) {
            *hair = hair.at_offset(self.offset_across(&surface, &frame));
        }
        ShadingPoint {
            surface,
            material: chosen.index,
            opaque: chosen.is_opaque(&lobe),
            lobe,
            frame,
            softness,
            facing,
            wo: wo.normalize(),
        }
    }

    /// How many lights are sampled at a vertex: one where it is measured.
    #[inline]
    fn light_candidates_of(&self, lobe: &PointLobe<'_>, depth: u32) -> u32 {
        let listed = lobe.listed();
        listed.map_or(1, |lobe| self.light_candidates(lobe, depth))
    }

    /// Adds direct light from one light sample.
    #[inline]
    fn add_direct(
        &self,
        state: &mut PathState,
        vertex: &ShadingPoint<'_>,
        sampler: &Sampler,
        depth: u32,
    ) {
        if vertex.lobe.is_specular() {
            return;
        }
        let count = self.light_candidates_of(&vertex.lobe, depth);
        let candidate = |nth| self.sample_light(state, vertex, sampler, depth, [nth, count]);
        let first = candidate(0);
        let chosen = if count == 1 {
            first
        } else {
            candidates::choose([first, candidate(1)], || {
                candidates::random_number(sampler, depth)
            })
        };
        let Some((light, contribution)) = chosen else {
            return;
        };
        let mut beyond;
        let media = if vertex.facing.dot(light.wi) < 0.0 {
            beyond = state.media;
            self.cross(&mut beyond, &vertex.surface, light.wi);
            &beyond
        } else {
            &state.media
        };
        let from = vertex.surface.point();
        let rays = &mut state.tally.rays;
        let transmittance = self.transmittance(&from, &light, media, sampler, depth, rays);
        if let Some(transmittance) = transmittance {
            state.add(contribution * transmittance, depth + 1);
        }
    }

    /// A light sample and its contribution, should nothing occlude it; `None`: it has none.
    ///
    /// * `nth`, `count`: which of how many light candidates.
    #[inline]
    fn sample_light(
        &self,
        state: &PathState,
        vertex: &ShadingPoint<'_>,
        sampler: &Sampler,
        depth: u32,
        [nth, count]: [u32; 2],
    ) -> Option<(LightSample, Rgb<f32>)> {
        let receiver = vertex.receiver();
        let scene = self.scene;
        let world = (&scene.geometry, &scene.textures);
        let u = estimator::candidate_random_numbers(sampler.light(depth), nth, count);
        let mut light = scene.lights.sample(&receiver, world, u)?;
        if self.strategy == Strategy::BsdfOnly && !light.delta {
            return None;
        }
        light.pdf *= count as f32;
        let wi = vertex.frame.to_local(light.wi);
        if !vertex.lets_through(wi, light.wi) {
            return None;
        }
        let wo = vertex.frame.to_local(vertex.wo);
        let mut stream = sampler.stream(depth, estimator::stream_of_candidate(nth));
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
        let weight = estimator::light_weight(self.strategy, light.delta, light.pdf, pdf);
        let contribution = estimator::light_contribution(
            state.throughput,
            f_cos,
            light.radiance,
            weight,
            light.pdf,
        );
        (weight > 0.0).then_some((light, contribution))
    }

    /// Samples the next ray; `None` where the path ends.
    #[inline]
    fn scatter(
        &self,
        state: &mut PathState,
        vertex: &ShadingPoint<'_>,
        sampler: &Sampler,
        depth: u32,
    ) -> Option<Ray> {
        let [u0, u1, u2, survival] = sampler.scatter(depth);
        let wo = vertex.frame.to_local(vertex.wo);
        let mut stream = sampler.stream(depth, estimator::STREAM_SCATTER);
        let sample =
            (vertex.lobe).sample_random(wo, [u0, u1, u2], Transport::Radiance, &mut stream);
        if !matches!(vertex.lobe, PointLobe::Listed(Lobe::Black(_))) {
            let scattered = &mut state.tally.scattered;
            scattered.sampled += 1;
            scattered.rejected += u64::from(sample.is_none());
        }
        let sample = sample?;
        let BsdfSample {
            wi,
            weight,
            pdf,
            specular,
            eta,
            event,
        } = sample;
        let direction = vertex.frame.to_world(wi).normalize();
        if !vertex.lets_through(wi, direction) {
            return None;
        }
        state.throughput *= weight;
        if let Some(softness) = &vertex.softness {
            state.throughput *= softness.factor(direction);
        }
        state.eta_scale = estimator::eta_scale_after(state.eta_scale, eta);
        state.rough |= !specular;
        self.spread_cone(state, vertex, &sample, sampler);
        state.straight &= matches!(vertex.lobe, PointLobe::Listed(Lobe::ThinDielectric(_)))
            && event == Event::Transmission;
        if vertex.is_crossed(direction, event) {
            self.cross(&mut state.media, &vertex.surface, direction);
        }
        let (survives, throughput) =
            estimator::russian_roulette(depth, state.throughput, state.eta_scale, survival);
        if !survives {
            return None;
        }
        state.throughput = throughput;
        state.previous = (!specular).then_some(PreviousVertex {
            receiver: vertex.receiver(),
            pdf: estimator::pdf_per_candidate(pdf, self.light_candidates_of(&vertex.lobe, depth)),
        });
        Some(estimator::spawn_ray(&vertex.surface.point(), direction))
    }
}
