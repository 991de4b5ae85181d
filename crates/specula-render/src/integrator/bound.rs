//! Vertices of a batch whose lobes are bound one after the other: those with textures, bump maps, mixed materials, and lobes
//! that batches do not know. Lobes are evaluated and sampled one after the other, too, but for kinds that are gathered
//! (`own_lobes`).
//!
//! All else of them is done in batches: random numbers, lights, shadow rays, roulette. Frames come from the batch where
//! surfaces are as their meshes say, and from [`PathTracer::shading_point`] where they are bent.

use core::ops::Range;

use specula_bsdf::batch::SampleOutcome;
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::hair::Hair;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};

use super::own_lobes::OwnLobes;
use super::path_states::PathStates;
use super::ray_queue::{RayQueue, index};
use super::vertex_batch::{self, LightSamples, ScatterSamples, Surfaces, Vectors, VertexBatch};
use super::wavefront::{MaterialRun, Wavefront};
use super::{PathTracer, ShadingPoint, estimator};
use crate::accel::{Accel, BlockHits, Hit, Ray};
use crate::bump::Softness;
use crate::film::ScatterCounts;
use crate::geometry::{Coordinates, NONE, PrimitiveLocation, Surface};
use crate::light::Receiver;
use crate::material::{Materials, Plain, PointLobe};
use crate::ray_cone::RayCone;
use crate::sampler::Sampler;

/// What a vertex has of its own.
pub(super) struct BoundVertex {
    lobe: BoundLobe,
    /// That of the lobe.
    material: u32,
    /// Whether its lobe is among the gathered ones.
    is_gathered: bool,
    /// As of [`ShadingPoint`].
    softness: Option<Softness>,
    opaque: bool,
    /// Whether its lobe takes all light.
    is_black: bool,
    /// How many lights are sampled there; 0 where none can contribute.
    pub(super) lights: u32,
}

/// A [`PointLobe`] without borrowed tables.
#[allow(
    clippy::large_enum_variant,
    reason = "they lie in one buffer; a box would allocate at every hit"
)]
enum BoundLobe {
    Listed(Lobe<f32>),
    /// That of a material.
    Measured(u32),
    Hair(Hair<f32>),
}

/// Where a path hits a vertex of the batch.
#[derive(Clone, Copy)]
struct Arrival<'a> {
    ray: Ray,
    hit: Hit,
    cone: RayCone,
    time: f32,
    sampler: &'a Sampler,
    /// As of `PathState`.
    rough: bool,
}

impl BoundVertex {
    /// * `material`: of the lobe.
    #[inline(always)]
    fn new(lobe: PointLobe<'_>, material: u32, opaque: bool, lights: u32) -> Self {
        let is_black = matches!(lobe, PointLobe::Listed(Lobe::Black(_)));
        let is_lit = !is_black && !lobe.is_specular();
        Self {
            lobe: match lobe {
                PointLobe::Listed(lobe) => BoundLobe::Listed(lobe),
                PointLobe::Measured(_) => BoundLobe::Measured(material),
                PointLobe::Hair(hair) => BoundLobe::Hair(hair),
            },
            material,
            is_gathered: false,
            softness: None,
            opaque,
            is_black,
            lights: if is_lit { lights } else { 0 },
        }
    }

    /// The colour of its lobe.
    pub(super) fn albedo(&self, materials: &Materials) -> Rgb<f32> {
        match &self.lobe {
            BoundLobe::Listed(lobe) => lobe.albedo(),
            BoundLobe::Measured(material) => {
                let lobe = materials.measured(*material);
                lobe.map_or(Rgb::BLACK, Bsdf::albedo)
            }
            BoundLobe::Hair(hair) => hair.albedo(),
        }
    }

    /// What continues a path from it.
    pub(super) fn exit(&self) -> Exit {
        Exit {
            lights: self.lights,
            opaque: self.opaque,
            is_pane: matches!(&self.lobe, BoundLobe::Listed(Lobe::ThinDielectric(_))),
            eta: None,
        }
    }

    /// The vertex as lights are chosen for it.
    ///
    /// * `i`: its index.
    pub(super) fn receiver(&self, s: &Surfaces, i: usize) -> Receiver {
        s.receiver(i, self.opaque)
    }
}

/// What a path takes from a vertex, beside its sample.
#[derive(Clone, Copy)]
pub(super) struct Exit {
    /// How many lights are sampled there.
    pub(super) lights: u32,
    pub(super) opaque: bool,
    /// Whether it is a thin pane, behind which hidden lights stay hidden.
    pub(super) is_pane: bool,
    /// Index beyond the surface over the index before it; `None`: that of the sample.
    pub(super) eta: Option<f32>,
}

impl Exit {
    /// From a vertex of a plain material.
    ///
    /// * `lights`: how many are sampled there.
    pub(super) fn of_plain(plain: &Plain, lights: u32) -> Self {
        Self {
            lights,
            opaque: plain.opaque,
            is_pane: matches!(plain.lobe, Lobe::ThinDielectric(_)),
            eta: plain.is_batched.then_some(plain.eta),
        }
    }
}

impl PathTracer<'_> {
    /// The runs of vertices whose lobes are bound.
    pub(super) fn bound_runs<'s>(
        &'s self,
        runs: &'s [MaterialRun],
    ) -> impl Iterator<Item = &'s MaterialRun> {
        let materials = &self.scene.materials;
        runs.iter()
            .filter(|run| materials.plain(run.key / 2).is_none())
    }

    /// Loads the surfaces of vertices whose lobes are bound.
    pub(super) fn load_bound(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            paths,
            live,
            hits,
            runs,
            batch,
            quadrics,
            ..
        } = wavefront;
        let materials = &self.scene.materials;
        for run in self.bound_runs(runs) {
            let is_bent = materials.is_bent(run.key / 2);
            let needs_tangent = self.needs_tangent(run.key);
            for i in run.range() {
                if batch.on_face[i] {
                    continue;
                }
                let k = batch.live_indices[i] as usize;
                match hits.get(&self.scene.geometry.accel, k, || live.ray(k)) {
                    Some(hit) if !is_bent => {
                        let time = || paths.times[live.index(k)];
                        let ray = (|| live.ray(k), &hit, time);
                        self.load_surface((batch, quadrics), i, ray, needs_tangent);
                    }
                    // It is set when its lobe is bound.
                    _ => batch.triangles.is_triangle[i] = false,
                }
            }
        }
    }

    /// Binds lobes and reflectances where they differ from vertex to vertex.
    pub(super) fn bind_vertices(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            live,
            hits,
            runs,
            batch,
            bound,
            own_lobes,
            tally,
            ..
        } = wavefront;
        let counts = &mut tally.vertices;
        let scene = self.scene;
        let from = (&**paths, &**live, &**hits);
        bound.clear();
        own_lobes.clear();
        for run in runs.iter_mut() {
            let count = run.range().len() as u64;
            if let Some(sides) = scene.materials.plain(run.key / 2) {
                let plain = &sides[(run.key % 2) as usize];
                if plain.is_batched {
                    counts.batched += count;
                } else {
                    counts.bound += count;
                }
                let Some(reflectance) = plain.reflectance else {
                    continue;
                };
                for i in run.range() {
                    let Some(arrival) = arrival(&scene.geometry.accel, from, batch, i) else {
                        continue;
                    };
                    let place = self.textured_surface(&batch.surfaces, i, &arrival).place();
                    let colour = Materials::reflectance(&scene.textures, reflectance, &place);
                    batch.reflectance.set_colour(i, colour);
                    if let Some(coat) = &plain.coat {
                        batch.base.set_colour(i, coat.base(colour));
                    }
                }
                continue;
            }
            run.first_bound = bound.len();
            let is_bent = scene.materials.is_bent(run.key / 2);
            for i in run.range() {
                let Some(arrival) = arrival(&scene.geometry.accel, from, batch, i) else {
                    continue;
                };
                let s = &mut batch.surfaces;
                let mut vertex = if is_bent {
                    self.bind_bent(s, i, &arrival, depth)
                } else {
                    self.bind_textured(s, i, &arrival, (run.key / 2, depth))
                };
                if let BoundLobe::Listed(lobe) = &vertex.lobe {
                    let material = vertex.material;
                    let differs_in_alphas = scene.materials.differs_in_alphas(material);
                    let material = differs_in_alphas.then_some(material);
                    vertex.is_gathered = own_lobes.push(i, lobe, material);
                }
                if vertex.is_gathered {
                    counts.batched += 1;
                } else {
                    counts.bound += 1;
                }
                bound.push(vertex);
            }
        }
    }

    /// Binds the lobe of a vertex whose surface is as its mesh says.
    #[inline(always)]
    fn bind_textured(
        &self,
        s: &mut Surfaces,
        i: usize,
        arrival: &Arrival<'_>,
        (material, depth): (u32, u32),
    ) -> BoundVertex {
        let scene = self.scene;
        let place = self.textured_surface(s, i, arrival).place();
        let outside = s.side[i] > 0.0;
        let chosen = scene
            .materials
            .at(material, &scene.textures, &place, outside, |_| 0.0);
        let lobe = chosen.lobe(&scene.textures, &place, outside);
        let opaque = chosen.is_opaque(&lobe);
        if lobe.is_specular() {
            vertex_batch::use_geometric_normals(i, i + 1, s);
        }
        let lights = self.light_candidates_of(&lobe, depth);
        BoundVertex::new(lobe, chosen.index, opaque, lights)
    }

    /// Binds the lobe of a vertex of any other kind, and sets its surface.
    fn bind_bent(
        &self,
        s: &mut Surfaces,
        i: usize,
        arrival: &Arrival<'_>,
        depth: u32,
    ) -> BoundVertex {
        let Arrival {
            ref ray,
            ref hit,
            cone,
            time,
            sampler,
            rough,
        } = *arrival;
        let surface = self.scene.geometry.surface(ray, hit, time);
        let surface = self.with_footprint_of(surface, ray, cone).0;
        let vertex = self.shading_point(surface, -ray.direction, sampler, depth, rough);
        s.set(i, &vertex);
        let lights = self.light_candidates_of(&vertex.lobe, depth);
        BoundVertex {
            softness: vertex.softness,
            ..BoundVertex::new(vertex.lobe, vertex.material, vertex.opaque, lights)
        }
    }

    /// The surface of a vertex as its textures see it, by what the batch knows.
    fn textured_surface(&self, s: &Surfaces, i: usize, arrival: &Arrival<'_>) -> Surface {
        let Arrival {
            ref ray,
            ref hit,
            cone,
            time,
            ..
        } = *arrival;
        let geometry = &self.scene.geometry;
        let surface = match geometry.coordinates(hit) {
            None => geometry.surface(ray, hit, time),
            Some(Coordinates {
                uv,
                second_uv,
                colour,
            }) => Surface {
                position: s.position.get(i),
                error: Vec3::splat(s.error[i]),
                ng: s.ng.get(i),
                ns: s.ns.get(i),
                tangent: s.tangent.get(i),
                uv,
                second_uv,
                colour,
                shape: geometry.group_of(hit).shape_of[hit.primitive as usize],
                light: NONE,
                at: PrimitiveLocation::of(hit, time),
                footprint: None,
            },
        };
        self.with_footprint_of(surface, ray, cone).0
    }

    /// Evaluates bound lobes towards light samples, and computes the contributions of these.
    ///
    /// * `depth`, `nth`: of the light candidates.
    pub(super) fn evaluate_bound(
        &self,
        (paths, path_indices): (&PathStates, &[u32]),
        (runs, bound, own_lobes): (&[MaterialRun], &[BoundVertex], &mut OwnLobes),
        (s, throughput): (&Surfaces, &Vectors),
        a: &mut LightSamples,
        [depth, nth]: [u32; 2],
    ) {
        for run in self.bound_runs(runs) {
            let Range { start, end } = run.range();
            for (i, vertex) in run.bound(bound) {
                let is_lit = vertex.lights > nth;
                a.pdf[i] = if is_lit {
                    a.pdf[i] * vertex.lights as f32
                } else {
                    0.0
                };
            }
            vertex_batch::lights_to_local(start, end, s, a);
        }
        own_lobes.evaluate(s, a);
        for run in self.bound_runs(runs) {
            let Range { start, end } = run.range();
            for (i, vertex) in run.bound(bound) {
                let sampler = &paths.samplers[index(path_indices[i])];
                let stream = || sampler.stream(depth, estimator::stream_of_candidate(nth));
                match &vertex.lobe {
                    _ if vertex.is_gathered => {}
                    BoundLobe::Listed(lobe) => evaluate(lobe, s, a, i, stream),
                    BoundLobe::Hair(hair) => evaluate(hair, s, a, i, stream),
                    BoundLobe::Measured(material) => {
                        if let Some(lobe) = self.scene.materials.measured(*material) {
                            evaluate(lobe, s, a, i, stream);
                        }
                    }
                }
                if let Some(softness) = &vertex.softness {
                    let f_cos = a.f_cos.colour(i) * softness.factor(a.wi_world.get(i));
                    a.f_cos.set_colour(i, f_cos);
                }
            }
            vertex_batch::light_contributions(start, end, throughput, a);
        }
    }

    /// Samples bound lobes; returns how many directions, and how many of them were rejected.
    pub(super) fn sample_bound(
        &self,
        (paths, path_indices): (&PathStates, &[u32]),
        (runs, bound, own_lobes): (&[MaterialRun], &[BoundVertex], &mut OwnLobes),
        (s, u): (&Surfaces, [&[f32]; 3]),
        scatter: &mut ScatterSamples,
        depth: u32,
    ) -> ScatterCounts {
        own_lobes.sample(s, u, scatter);
        let mut counts = ScatterCounts::default();
        for (i, vertex) in self.bound_runs(runs).flat_map(|run| run.bound(bound)) {
            if vertex.is_black {
                scatter.set(i, None);
                continue;
            }
            let sampler = &paths.samplers[index(path_indices[i])];
            let stream = || sampler.stream(depth, estimator::STREAM_SCATTER);
            let u = u.map(|u| u[i]);
            let is_sampled = match &vertex.lobe {
                _ if vertex.is_gathered => scatter.outcome[i] != SampleOutcome::Rejected,
                BoundLobe::Listed(lobe) => sample(lobe, s, scatter, (i, u), stream),
                BoundLobe::Hair(hair) => sample(hair, s, scatter, (i, u), stream),
                BoundLobe::Measured(material) => (self.scene.materials.measured(*material))
                    .is_some_and(|lobe| sample(lobe, s, scatter, (i, u), stream)),
            };
            counts.sampled += 1;
            counts.rejected += u64::from(!is_sampled);
            if let (Some(softness), true) = (&vertex.softness, is_sampled) {
                let direction = s.frame(i).to_world(scatter.wi.get(i)).normalize();
                let weight = scatter.weight.colour(i) * softness.factor(direction);
                scatter.weight.set_colour(i, weight);
            }
        }
        counts
    }
}

/// Where a path hits a vertex of the batch.
///
/// * `i`: its index.
fn arrival<'a>(
    accel: &Accel,
    (paths, live, hits): (&'a PathStates, &RayQueue, &BlockHits),
    batch: &VertexBatch,
    i: usize,
) -> Option<Arrival<'a>> {
    let k = batch.live_indices[i] as usize;
    let path = live.index(k);
    let ray = live.ray(k);
    Some(Arrival {
        ray,
        hit: hits.get(accel, k, || ray)?,
        cone: paths.cones[path],
        time: paths.times[path],
        sampler: &paths.samplers[path],
        rough: paths.rough[path],
    })
}

impl Surfaces {
    /// Sets a vertex that was shaded singly so far.
    fn set(&mut self, i: usize, vertex: &ShadingPoint<'_>) {
        let ShadingPoint {
            surface, frame, wo, ..
        } = vertex;
        self.position.set(i, surface.position);
        self.error[i] = surface.error.x;
        self.ng.set(i, surface.ng);
        self.ns.set(i, frame.n);
        self.side[i] = if surface.ng.dot(*wo) > 0.0 { 1.0 } else { -1.0 };
        self.wo_world.set(i, *wo);
        self.axes[0].set(i, frame.s);
        self.axes[1].set(i, frame.t);
        self.wo.set(i, frame.to_local(*wo));
    }
}

/// A lobe's stream, where its values are estimates.
#[inline(always)]
fn stream_for(lobe: &impl Bsdf<f32>, stream: impl FnOnce() -> Stream) -> Stream {
    if lobe.is_stochastic() {
        stream()
    } else {
        Stream::new(0)
    }
}

/// Evaluates a lobe towards the light sample of a vertex, where there is one.
#[inline]
fn evaluate(
    lobe: &impl Bsdf<f32>,
    s: &Surfaces,
    a: &mut LightSamples,
    i: usize,
    stream: impl FnOnce() -> Stream,
) {
    if a.pdf[i] > 0.0 {
        let mut stream = stream_for(lobe, stream);
        let (wo, wi) = (s.wo.get(i), a.wi.get(i));
        let (f_cos, pdf) = lobe.eval_pdf_random(wo, wi, Transport::Radiance, &mut stream);
        a.f_cos.set_colour(i, f_cos);
        a.lobe_pdf[i] = pdf;
    }
}

/// Samples a lobe at a vertex; returns whether there is a direction.
#[inline]
fn sample(
    lobe: &impl Bsdf<f32>,
    s: &Surfaces,
    scatter: &mut ScatterSamples,
    (i, u): (usize, [f32; 3]),
    stream: impl FnOnce() -> Stream,
) -> bool {
    let mut stream = stream_for(lobe, stream);
    let sample = lobe.sample_random(s.wo.get(i), u, Transport::Radiance, &mut stream);
    scatter.set(i, sample);
    sample.is_some()
}

/// [`evaluate`] for all vertices of a run of one lobe.
///
/// * `stream`: of a vertex.
pub(super) fn evaluate_run(
    lobe: &Lobe<f32>,
    range: Range<usize>,
    s: &Surfaces,
    a: &mut LightSamples,
    stream: impl Fn(usize) -> Stream,
) {
    for i in range {
        evaluate(lobe, s, a, i, || stream(i));
    }
}

/// Samples the lobe of all vertices of a run; the insides of black ones give none.
///
/// * `u`: random numbers.
/// * `stream`: of a vertex.
pub(super) fn sample_run(
    plain: &Plain,
    range: Range<usize>,
    (s, u): (&Surfaces, [&[f32]; 3]),
    scatter: &mut ScatterSamples,
    stream: impl Fn(usize) -> Stream,
) {
    for i in range {
        if plain.black_inside && s.side[i] < 0.0 {
            scatter.set(i, None);
        } else {
            let u = u.map(|u| u[i]);
            sample(&plain.lobe, s, scatter, (i, u), || stream(i));
        }
    }
}
