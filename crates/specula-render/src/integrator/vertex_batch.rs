//! Vertices of many paths as structures of arrays, and the loops over them.
//!
//! The loops are free of branches and compiled for each instruction set. They call the functions of `estimator`,
//! as `integrator.rs` does for single vertices.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;
use specula_bsdf::batch::SampleOutcome;
use specula_bsdf::bsdf::Event;
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{BsdfSample, Frame, Rgb, Vec3};

use super::estimator;
use crate::accel::BLOCK;
use crate::film::ScatterCounts;
use crate::geometry::{triangle_normal, unit_or};
use crate::light::{LightSample, Parallelogram, ParallelogramSample, Receiver};
use crate::offset::{SurfacePoint, coupled};
use crate::options::Strategy;
use crate::sampler::RandomNumbers;
use crate::simd::simd_levels;
use crate::soa;

/// Most vertices at once.
pub(super) const WAVEFRONT_SIZE: usize = BLOCK;

/// One value of each vertex.
pub(super) type Floats = soa::Floats<WAVEFRONT_SIZE>;

/// One index of each vertex.
pub(super) type Indices = soa::Column<u32, WAVEFRONT_SIZE>;

/// One vector of each vertex.
pub(super) type Vectors = soa::Vectors<WAVEFRONT_SIZE>;

/// Corners, normals and barycentric weights of the triangles that rays hit.
pub(super) struct Triangles {
    pub(super) corners: [Vectors; 3],
    /// Those of the corners, where there are any; zero where the mesh has none.
    pub(super) normals: [Vectors; 3],
    pub(super) has_normals: [bool; WAVEFRONT_SIZE],
    /// Barycentric weights of the second and third corner.
    pub(super) weights: [Floats; 2],
    /// Whether the vertex is on such a triangle; else its surface is complete.
    pub(super) is_triangle: [bool; WAVEFRONT_SIZE],
    /// How many are.
    pub(super) count: usize,
}

/// Surfaces, with frames that face their viewers.
pub(super) struct Surfaces {
    pub(super) position: Vectors,
    /// Bound on the error of each component of the position.
    pub(super) error: Floats,
    /// Geometric normals, towards the outside.
    pub(super) ng: Vectors,
    /// Shading normals; on the viewer's side of the surface after [`face_viewers`].
    pub(super) ns: Vectors,
    pub(super) tangent: Vectors,
    /// 1 where the viewer is outside, else -1.
    pub(super) side: Floats,
    /// Towards the viewer, unit.
    pub(super) wo_world: Vectors,
    /// Axes of the shading frame; the third is `ns`.
    pub(super) axes: [Vectors; 2],
    /// `wo_world`, in the frame.
    pub(super) wo: Vectors,
}

/// Light samples, of which occlusion is not known.
pub(super) struct LightSamples {
    /// Towards the light, unit.
    pub(super) wi_world: Vectors,
    pub(super) radiance: Vectors,
    /// As of `LightSample`; 0 where there is no sample.
    pub(super) pdf: Floats,
    pub(super) delta: [bool; WAVEFRONT_SIZE],
    /// Whether it comes from infinity; else from the target.
    pub(super) is_infinite: [bool; WAVEFRONT_SIZE],
    pub(super) target: Vectors,
    /// Bound on the error of each component of the target.
    pub(super) target_error: Floats,
    pub(super) target_normal: Vectors,
    /// `wi_world`, in the frame.
    pub(super) wi: Vectors,
    /// `f |cos|` of the lobe, and its density.
    pub(super) f_cos: Vectors,
    pub(super) lobe_pdf: Floats,
    /// Contribution to the path, should nothing occlude it.
    pub(super) contribution: Vectors,
    /// The shadow ray.
    pub(super) origin: Vectors,
    pub(super) direction: Vectors,
}

/// Directions sampled from lobes.
pub(super) struct ScatterSamples {
    pub(super) wi: Vectors,
    pub(super) weight: Vectors,
    pub(super) pdf: Floats,
    pub(super) outcome: [SampleOutcome; WAVEFRONT_SIZE],
    /// Of the path, before and after.
    pub(super) throughput: Vectors,
    /// Product of the squared relative indices.
    pub(super) eta_scale: Floats,
    pub(super) direction: Vectors,
    pub(super) origin: Vectors,
    /// Whether the path continues.
    pub(super) alive: [bool; WAVEFRONT_SIZE],
    /// Index beyond the surface over the index before it, where lobes were sampled one after the other.
    pub(super) eta: Floats,
}

/// Everything about the vertices of a wavefront.
pub(super) struct VertexBatch {
    /// How many there are.
    pub(super) count: usize,
    /// Of each vertex the index of its path, and its index among the live paths.
    pub(super) path_indices: Indices,
    pub(super) live_indices: Indices,
    pub(super) triangles: Triangles,
    /// Whether the vertex is on a face of a small scene, which is loaded with others.
    pub(super) on_face: [bool; WAVEFRONT_SIZE],
    pub(super) surfaces: Surfaces,
    pub(super) light_samples: LightSamples,
    /// The second candidates, where two are sampled.
    pub(super) second_light_samples: LightSamples,
    /// Probability with which light sampling takes a light from infinity.
    pub(super) share_from_infinity: Floats,
    pub(super) scatter_samples: ScatterSamples,
    /// Of the set that is in use.
    pub(super) random_numbers: RandomNumbers<WAVEFRONT_SIZE>,
    /// Those of the second light candidates.
    pub(super) second_random_numbers: [Floats; 4],
    /// Where camera rays pass through the raster.
    pub(super) raster: [Floats; 2],
    /// What scales the values of lobes, or the albedo of the base under a coat, where materials have it.
    pub(super) reflectance: Vectors,
    /// The base under a coat with all bounces.
    pub(super) base: Vectors,
}

/// Of zeros.
pub(super) const ZERO: Floats = Floats::of(0.0);

impl VertexBatch {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            count: 0,
            path_indices: Indices::of(0),
            live_indices: Indices::of(0),
            triangles: Triangles {
                corners: [Vectors::ZERO; 3],
                normals: [Vectors::ZERO; 3],
                has_normals: [false; WAVEFRONT_SIZE],
                weights: [ZERO; 2],
                is_triangle: [false; WAVEFRONT_SIZE],
                count: 0,
            },
            on_face: [false; WAVEFRONT_SIZE],
            surfaces: Surfaces {
                position: Vectors::ZERO,
                error: ZERO,
                ng: Vectors::ZERO,
                ns: Vectors::ZERO,
                tangent: Vectors::ZERO,
                side: ZERO,
                wo_world: Vectors::ZERO,
                axes: [Vectors::ZERO; 2],
                wo: Vectors::ZERO,
            },
            light_samples: LightSamples::ZERO,
            second_light_samples: LightSamples::ZERO,
            share_from_infinity: ZERO,
            scatter_samples: ScatterSamples {
                wi: Vectors::ZERO,
                weight: Vectors::ZERO,
                pdf: ZERO,
                outcome: [SampleOutcome::Rejected; WAVEFRONT_SIZE],
                throughput: Vectors::ZERO,
                eta_scale: ZERO,
                direction: Vectors::ZERO,
                origin: Vectors::ZERO,
                alive: [false; WAVEFRONT_SIZE],
                eta: ZERO,
            },
            random_numbers: RandomNumbers::ZERO,
            second_random_numbers: [ZERO; 4],
            raster: [ZERO; 2],
            reflectance: Vectors::ZERO,
            base: Vectors::ZERO,
        })
    }
}

impl LightSamples {
    const ZERO: Self = Self {
        wi_world: Vectors::ZERO,
        radiance: Vectors::ZERO,
        pdf: ZERO,
        delta: [false; WAVEFRONT_SIZE],
        is_infinite: [false; WAVEFRONT_SIZE],
        target: Vectors::ZERO,
        target_error: ZERO,
        target_normal: Vectors::ZERO,
        wi: Vectors::ZERO,
        f_cos: Vectors::ZERO,
        lobe_pdf: ZERO,
        contribution: Vectors::ZERO,
        origin: Vectors::ZERO,
        direction: Vectors::ZERO,
    };

    /// Stores a light sample.
    #[inline]
    pub(super) fn set(&mut self, i: usize, light: Option<LightSample>) {
        let Some(light) = light else {
            self.pdf[i] = 0.0;
            return;
        };
        self.wi_world.set(i, light.wi);
        self.radiance.set_colour(i, light.radiance);
        self.pdf[i] = light.pdf;
        self.delta[i] = light.delta;
        self.is_infinite[i] = light.target.is_none();
        if let Some(target) = light.target {
            self.target.set(i, target.position);
            self.target_error[i] = target.error.x;
            self.target_normal.set(i, target.normal);
        }
    }
}

impl ScatterSamples {
    /// Stores what a lobe sampled; `None`: nothing.
    #[inline]
    pub(super) fn set(&mut self, i: usize, sample: Option<BsdfSample<f32>>) {
        let Some(sample) = sample else {
            self.wi.set(i, Vec3::ZERO);
            self.weight.set_colour(i, Rgb::BLACK);
            self.pdf[i] = 0.0;
            self.outcome[i] = SampleOutcome::Rejected;
            return;
        };
        self.wi.set(i, sample.wi);
        self.weight.set_colour(i, sample.weight);
        self.pdf[i] = sample.pdf;
        self.outcome[i] = match (sample.event, sample.specular) {
            (Event::Reflection, false) => SampleOutcome::Reflection,
            (Event::Transmission, false) => SampleOutcome::Transmission,
            (Event::Reflection, true) => SampleOutcome::SpecularReflection,
            (Event::Transmission, true) => SampleOutcome::SpecularTransmission,
        };
        self.eta[i] = sample.eta;
        self.eta_scale[i] = estimator::eta_scale_after(self.eta_scale[i], sample.eta);
    }
}

impl Surfaces {
    #[inline(always)]
    pub(super) fn frame(&self, i: usize) -> Frame<f32> {
        Frame {
            s: self.axes[0].get(i),
            t: self.axes[1].get(i),
            n: self.ns.get(i),
        }
    }

    /// A vertex as rays leave it.
    #[inline(always)]
    fn point(&self, i: usize) -> SurfacePoint {
        SurfacePoint {
            position: self.position.get(i),
            error: Vec3::splat(self.error[i]),
            normal: self.ng.get(i),
        }
    }

    /// A vertex as lights are chosen for it.
    ///
    /// * `opaque`: whether nothing passes its surface.
    #[inline(always)]
    pub(super) fn receiver(&self, i: usize, opaque: bool) -> Receiver {
        Receiver {
            point: self.position.get(i),
            normal: opaque.then(|| self.ns.get(i)),
        }
    }

    /// The cosine of a direction to the geometric normal on the viewer's side.
    #[inline(always)]
    fn facing(&self, i: usize, w: Vec3<f32>) -> f32 {
        self.side[i] * self.ng.get(i).dot(w)
    }
}

/// Position, error and normals of the first `n` vertices that are on triangles.
#[apply(simd_levels)]
pub(super) fn interpolate_triangles(n: usize, t: &Triangles, s: &mut Surfaces) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let [a, b, c] = [&t.corners[0], &t.corners[1], &t.corners[2]].map(|v| v.get(i));
        let [na, nb, nc] = [&t.normals[0], &t.normals[1], &t.normals[2]].map(|v| v.get(i));
        let (u, v) = (t.weights[0][i], t.weights[1][i]);
        let w = 1.0 - u - v;
        let ng = triangle_normal([a, b, c]);
        let ns = select(t.has_normals[i], unit_or(na * w + nb * u + nc * v, ng), ng);
        let position = a * w + b * u + c * v;
        let reach = largest(abs(a), largest(abs(b), abs(c)));
        let error = coupled(reach).x;
        let is_triangle = t.is_triangle[i];
        s.position
            .set(i, select(is_triangle, position, s.position.get(i)));
        s.ng.set(i, select(is_triangle, ng, s.ng.get(i)));
        s.ns.set(i, select(is_triangle, ns, s.ns.get(i)));
        s.error[i] = if is_triangle { error } else { s.error[i] };
    }
}

/// One of two vectors, without a branch.
#[inline(always)]
pub(super) fn select(is_new: bool, new: Vec3<f32>, old: Vec3<f32>) -> Vec3<f32> {
    vec3(
        if is_new { new.x } else { old.x },
        if is_new { new.y } else { old.y },
        if is_new { new.z } else { old.z },
    )
}

#[inline(always)]
fn abs(v: Vec3<f32>) -> Vec3<f32> {
    vec3(v.x.abs(), v.y.abs(), v.z.abs())
}

#[inline(always)]
fn largest(a: Vec3<f32>, b: Vec3<f32>) -> Vec3<f32> {
    vec3(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z))
}

/// Turns the normals of the first `n` surfaces to their viewers, and computes their frames.
#[apply(simd_levels)]
pub(super) fn face_viewers(n: usize, s: &mut Surfaces) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let wo = s.wo_world.get(i).normalize();
        s.wo_world.set(i, wo);
        let ng = s.ng.get(i);
        let side = if ng.dot(wo) > 0.0 { 1.0 } else { -1.0 };
        s.side[i] = side;
        let ns = s.ns.get(i);
        let ns = ns * if ns.dot(ng * side) < 0.0 { -1.0 } else { 1.0 };
        s.ns.set(i, ns);
        let frame = Frame::from_normal_tangent(ns, s.tangent.get(i));
        s.axes[0].set(i, frame.s);
        s.axes[1].set(i, frame.t);
        s.wo.set(i, frame.to_local(wo));
    }
}

/// Scales values of lobes, or weights of their samples.
///
/// * `from`, `to`: the vertices.
#[apply(simd_levels)]
pub(super) fn scale_values(from: usize, to: usize, by: &Vectors, values: &mut Vectors) {
    for i in from..to.min(WAVEFRONT_SIZE) {
        values.set_colour(i, by.colour(i) * values.colour(i));
    }
}

/// Frames about the geometric normals where the viewer is behind the shading normal: perfect mirrors have no
/// answer there.
///
/// * `from`, `to`: the vertices of mirrors.
pub(super) fn use_geometric_normals(from: usize, to: usize, s: &mut Surfaces) {
    for i in from..to {
        if s.wo.z[i] <= 0.0 {
            let n = s.ng.get(i) * s.side[i];
            let frame = Frame::from_normal_tangent(n, s.tangent.get(i));
            s.ns.set(i, n);
            s.axes[0].set(i, frame.s);
            s.axes[1].set(i, frame.t);
            s.wo.set(i, frame.to_local(s.wo_world.get(i)));
        }
    }
}

/// Samples points of the one light of a scene, a parallelogram, for the first `n` vertices, as `Area::sample`
/// does.
///
/// * `u`: random numbers of the points.
#[apply(simd_levels)]
pub(super) fn sample_parallelogram(
    n: usize,
    (light, radiance, two_sided): (&Parallelogram, Rgb<f32>, bool),
    u: [&Floats; 2],
    s: &Surfaces,
    a: &mut LightSamples,
) {
    let (normal, error) = (light.normal, light.error.x);
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let ParallelogramSample { point, wi, pdf } =
            light.sample(s.position.get(i), [u[0][i], u[1][i]]);
        let emits = two_sided | (normal.dot(wi) < 0.0);
        a.pdf[i] = if emits { pdf } else { 0.0 };
        a.wi_world.set(i, wi);
        a.radiance.set_colour(i, radiance);
        a.delta[i] = false;
        a.is_infinite[i] = false;
        a.target.set(i, point);
        a.target_error[i] = error;
        a.target_normal.set(i, normal);
    }
}

/// Directions to lights in the shading frames. Samples from the wrong side get density 0.
///
/// * `from`, `to`: the vertices.
#[apply(simd_levels)]
pub(super) fn lights_to_local(from: usize, to: usize, s: &Surfaces, a: &mut LightSamples) {
    for i in from..to.min(WAVEFRONT_SIZE) {
        let wi_world = a.wi_world.get(i);
        let wi = s.frame(i).to_local(wi_world);
        let through = estimator::sides_agree(wi.z, s.facing(i, wi_world));
        a.wi.set(i, wi);
        a.pdf[i] = if through { a.pdf[i] } else { 0.0 };
    }
}

/// Contributions of light samples, with their MIS weights.
///
/// * `from`, `to`: the vertices.
#[apply(simd_levels)]
pub(super) fn light_contributions(
    from: usize,
    to: usize,
    throughput: &Vectors,
    a: &mut LightSamples,
) {
    for i in from..to.min(WAVEFRONT_SIZE) {
        let pdf = a.pdf[i];
        let weight = estimator::light_weight(Strategy::Mis, a.delta[i], pdf, a.lobe_pdf[i]);
        let (f_cos, radiance) = (a.f_cos.colour(i), a.radiance.colour(i));
        let contribution =
            estimator::light_contribution(throughput.colour(i), f_cos, radiance, weight, pdf);
        let arrives = pdf > 0.0;
        let pick = |c: f32| if arrives { c } else { 0.0 };
        a.contribution.set_colour(i, contribution.map(pick));
    }
}

/// Replaces the first of two light candidates by the one that chance chooses; see `candidates`.
///
/// * `u`: the random numbers that choose.
/// * `a`, `b`: the first and the second candidates.
#[apply(simd_levels)]
pub(super) fn choose_candidates(
    from: usize,
    to: usize,
    u: &Floats,
    a: &mut LightSamples,
    b: &LightSamples,
) {
    for i in from..to.min(WAVEFRONT_SIZE) {
        let [x, y] = [a.contribution.colour(i), b.contribution.colour(i)];
        let (is_second, scale) = estimator::choose_candidate(x, y, u[i]);
        let pick = |a: f32, b: f32| if is_second { b } else { a };
        let [of_a, of_b] =
            [&*a, b].map(|a| (a.wi_world.get(i), a.target.get(i), a.target_normal.get(i)));
        let pick_vector =
            |a: Vec3<f32>, b: Vec3<f32>| vec3(pick(a.x, b.x), pick(a.y, b.y), pick(a.z, b.z));
        let contribution = rgb(pick(x.r, y.r), pick(x.g, y.g), pick(x.b, y.b));
        a.contribution.set_colour(i, contribution * scale);
        a.wi_world.set(i, pick_vector(of_a.0, of_b.0));
        a.target.set(i, pick_vector(of_a.1, of_b.1));
        a.target_normal.set(i, pick_vector(of_a.2, of_b.2));
        a.target_error[i] = pick(a.target_error[i], b.target_error[i]);
        a.is_infinite[i] = (is_second & b.is_infinite[i]) | (!is_second & a.is_infinite[i]);
    }
}

/// Shadow rays of the first `n` light samples.
#[apply(simd_levels)]
pub(super) fn shadow_rays(n: usize, s: &Surfaces, a: &mut LightSamples) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let wi = a.wi_world.get(i);
        let target = SurfacePoint {
            position: a.target.get(i),
            error: Vec3::splat(a.target_error[i]),
            normal: a.target_normal.get(i),
        };
        let to_infinity = estimator::spawn_ray(&s.point(i), wi);
        let to_target = estimator::shadow_ray(&s.point(i), wi, &target);
        let is_infinite = a.is_infinite[i];
        let pick = |infinity: f32, target: f32| if is_infinite { infinity } else { target };
        let (direction, along) = (to_infinity.direction, to_target.direction);
        a.origin.set(i, to_infinity.origin);
        a.direction.x[i] = pick(direction.x, along.x);
        a.direction.y[i] = pick(direction.y, along.y);
        a.direction.z[i] = pick(direction.z, along.z);
    }
}

/// How many directions were sampled, and how many of them rejected.
///
/// * `sides`: 1 or -1 where lobes are black from the inside, where no direction is sampled.
pub(super) fn count_scattered(kinds: &[SampleOutcome], sides: Option<&[f32]>) -> ScatterCounts {
    let is_rejected = |k: &SampleOutcome| *k == SampleOutcome::Rejected;
    match sides {
        None => ScatterCounts {
            sampled: kinds.len() as u64,
            rejected: kinds.iter().filter(|k| is_rejected(k)).count() as u64,
        },
        Some(sides) => (kinds.iter().zip(sides))
            .filter(|(_, side)| **side >= 0.0)
            .fold(ScatterCounts::default(), |sum, (kind, _)| ScatterCounts {
                sampled: sum.sampled + 1,
                rejected: sum.rejected + u64::from(is_rejected(kind)),
            }),
    }
}

/// Continues the first `n` paths in the directions that lobes sampled, or ends them.
///
/// * `survival`: random numbers for Russian roulette.
#[apply(simd_levels)]
pub(super) fn scatter(
    n: usize,
    depth: u32,
    s: &Surfaces,
    survival: &Floats,
    scatter: &mut ScatterSamples,
) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let wi = scatter.wi.get(i);
        let direction = s.frame(i).to_world(wi).normalize();
        let throughput = scatter.throughput.colour(i) * scatter.weight.colour(i);
        let (survives, throughput) =
            estimator::russian_roulette(depth, throughput, scatter.eta_scale[i], survival[i]);
        scatter.alive[i] = estimator::sides_agree(wi.z, s.facing(i, direction)) & survives;
        scatter.throughput.set_colour(i, throughput);
        scatter.direction.set(i, direction);
        scatter
            .origin
            .set(i, estimator::spawn_ray(&s.point(i), direction).origin);
    }
}
