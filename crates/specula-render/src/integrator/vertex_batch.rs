//! Vertices of many paths side by side: structures of arrays, and the loops over them.
//!
//! The loops are free of branches and compiled for the machine's vectors; each does what its scalar
//! twin of `integrator.rs` does, in the same order of operations.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use multiversion::multiversion;
use specula_bsdf::batch::{Colours, Directions, SampleOutcome};
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Frame, Rgb, Vec3};

use super::{ROULETTE_FROM, candidates, power_heuristic, survival_probability};
use crate::geometry::unit_or;
use crate::light::{LightSample, Parallelogram, Receiver, Seen};
use crate::material::Plain;
use crate::offset::{coupled, leave};
use crate::renderer::ScatterCounts;
use crate::sampler::RandomNumbers;

/// Most vertices at once.
pub(super) const WAVEFRONT_SIZE: usize = 512;

/// A number of each vertex.
pub(super) type Column = [f32; WAVEFRONT_SIZE];

/// A vector of each vertex.
pub(super) struct Vectors {
    pub(super) x: Column,
    pub(super) y: Column,
    pub(super) z: Column,
}

impl Vectors {
    pub(super) const ZERO: Self = Self {
        x: [0.0; WAVEFRONT_SIZE],
        y: [0.0; WAVEFRONT_SIZE],
        z: [0.0; WAVEFRONT_SIZE],
    };

    #[inline(always)]
    pub(super) fn get(&self, i: usize) -> Vec3<f32> {
        vec3(self.x[i], self.y[i], self.z[i])
    }

    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, v: Vec3<f32>) {
        self.x[i] = v.x;
        self.y[i] = v.y;
        self.z[i] = v.z;
    }

    #[inline(always)]
    pub(super) fn set_array(&mut self, i: usize, [x, y, z]: &[f32; 3]) {
        self.x[i] = *x;
        self.y[i] = *y;
        self.z[i] = *z;
    }

    #[inline(always)]
    pub(super) fn colour(&self, i: usize) -> Rgb<f32> {
        rgb(self.x[i], self.y[i], self.z[i])
    }

    #[inline(always)]
    pub(super) fn set_colour(&mut self, i: usize, c: Rgb<f32>) {
        self.set(i, vec3(c.r, c.g, c.b));
    }

    pub(super) fn directions(&self, from: usize, to: usize) -> Directions<&[f32]> {
        Directions {
            x: &self.x[from..to],
            y: &self.y[from..to],
            z: &self.z[from..to],
        }
    }

    pub(super) fn directions_mut(&mut self, from: usize, to: usize) -> Directions<&mut [f32]> {
        Directions {
            x: &mut self.x[from..to],
            y: &mut self.y[from..to],
            z: &mut self.z[from..to],
        }
    }

    pub(super) fn colours_mut(&mut self, from: usize, to: usize) -> Colours<&mut [f32]> {
        Colours {
            r: &mut self.x[from..to],
            g: &mut self.y[from..to],
            b: &mut self.z[from..to],
        }
    }
}

/// Corners, normals and weights of the triangles that rays met.
pub(super) struct Triangles {
    pub(super) corners: [Vectors; 3],
    /// Those of the corners; zero where the mesh has none.
    pub(super) normals: [Vectors; 3],
    /// Weights of the second and third corner.
    pub(super) weights: [Column; 2],
    /// Whether the surface is still to be made from it.
    pub(super) wanted: [bool; WAVEFRONT_SIZE],
}

/// Surfaces, turned to their viewers.
pub(super) struct Surfaces {
    pub(super) position: Vectors,
    /// Bound on the error of each component of the position.
    pub(super) error: Column,
    /// Geometric normals, towards the outside.
    pub(super) ng: Vectors,
    /// Shading normals; on the viewer's side of the surface after [`turn`].
    pub(super) ns: Vectors,
    pub(super) tangent: Vectors,
    /// 1 where the outside is seen, else -1.
    pub(super) side: Column,
    /// Towards the viewer, unit.
    pub(super) towards: Vectors,
    /// Axes of the shading frame; the third is `ns`.
    pub(super) axes: [Vectors; 2],
    /// `towards`, in the frame.
    pub(super) wo: Vectors,
}

/// Light that could arrive.
pub(super) struct LightSamples {
    /// Towards the light.
    pub(super) towards: Vectors,
    pub(super) radiance: Vectors,
    /// As of `LightSample`; 0 where there is none.
    pub(super) pdf: Column,
    pub(super) delta: [bool; WAVEFRONT_SIZE],
    /// Whether it comes from infinity; else from the target.
    pub(super) far: [bool; WAVEFRONT_SIZE],
    pub(super) target: Vectors,
    /// Bound on the error of each component of the target.
    pub(super) target_error: Column,
    pub(super) target_normal: Vectors,
    /// `towards`, in the frame.
    pub(super) wi: Vectors,
    /// `f |cos|` of the lobe, and its density.
    pub(super) f_cos: Vectors,
    pub(super) lobe_pdf: Column,
    /// Weighed, with the path's throughput, if nothing is in the way; black where nothing arrives.
    pub(super) contribution: Vectors,
    /// The ray to look along.
    pub(super) origin: Vectors,
    pub(super) direction: Vectors,
}

/// Directions sampled, and what they carry.
pub(super) struct ScatterSamples {
    pub(super) wi: Vectors,
    pub(super) weight: Vectors,
    pub(super) pdf: Column,
    pub(super) kind: [SampleOutcome; WAVEFRONT_SIZE],
    /// Throughput, before and after.
    pub(super) throughput: Vectors,
    /// Product of the squared relative indices.
    pub(super) eta_scale: Column,
    pub(super) direction: Vectors,
    pub(super) origin: Vectors,
    pub(super) alive: [bool; WAVEFRONT_SIZE],
}

/// Everything about the vertices of a wavefront.
pub(super) struct VertexBatch {
    /// How many there are.
    pub(super) count: usize,
    /// Of each vertex the number of its path, and its place among those that live.
    pub(super) owners: [u32; WAVEFRONT_SIZE],
    pub(super) places: [u32; WAVEFRONT_SIZE],
    pub(super) triangles: Triangles,
    pub(super) surfaces: Surfaces,
    pub(super) light_samples: LightSamples,
    /// The second, where two are sampled.
    pub(super) second: LightSamples,
    /// Probability with which the light to be sampled is one from infinity.
    pub(super) share_far: Column,
    pub(super) scatter_samples: ScatterSamples,
    /// Of the sequences.
    pub(super) random_numbers: RandomNumbers<WAVEFRONT_SIZE>,
    /// Those of second lights.
    pub(super) second_random_numbers: [Column; 4],
    /// Where camera rays pass the raster.
    pub(super) raster: [Column; 2],
}

/// Of zeros.
pub(super) const ZERO: Column = [0.0; WAVEFRONT_SIZE];

impl VertexBatch {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            count: 0,
            owners: [0; WAVEFRONT_SIZE],
            places: [0; WAVEFRONT_SIZE],
            triangles: Triangles {
                corners: [Vectors::ZERO; 3],
                normals: [Vectors::ZERO; 3],
                weights: [ZERO; 2],
                wanted: [false; WAVEFRONT_SIZE],
            },
            surfaces: Surfaces {
                position: Vectors::ZERO,
                error: ZERO,
                ng: Vectors::ZERO,
                ns: Vectors::ZERO,
                tangent: Vectors::ZERO,
                side: ZERO,
                towards: Vectors::ZERO,
                axes: [Vectors::ZERO; 2],
                wo: Vectors::ZERO,
            },
            light_samples: LightSamples::ZERO,
            second: LightSamples::ZERO,
            share_far: ZERO,
            scatter_samples: ScatterSamples {
                wi: Vectors::ZERO,
                weight: Vectors::ZERO,
                pdf: ZERO,
                kind: [SampleOutcome::Rejected; WAVEFRONT_SIZE],
                throughput: Vectors::ZERO,
                eta_scale: ZERO,
                direction: Vectors::ZERO,
                origin: Vectors::ZERO,
                alive: [false; WAVEFRONT_SIZE],
            },
            random_numbers: RandomNumbers::ZERO,
            second_random_numbers: [ZERO; 4],
            raster: [ZERO; 2],
        })
    }
}

impl LightSamples {
    const ZERO: Self = Self {
        towards: Vectors::ZERO,
        radiance: Vectors::ZERO,
        pdf: ZERO,
        delta: [false; WAVEFRONT_SIZE],
        far: [false; WAVEFRONT_SIZE],
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

    /// Places light that was sampled.
    #[inline]
    pub(super) fn set(&mut self, i: usize, light: Option<LightSample>) {
        let Some(light) = light else {
            self.pdf[i] = 0.0;
            return;
        };
        self.towards.set(i, light.wi);
        self.radiance.set_colour(i, light.radiance);
        self.pdf[i] = light.pdf;
        self.delta[i] = light.delta;
        self.far[i] = light.from.is_none();
        if let Some(target) = light.from {
            self.target.set(i, target.point);
            self.target_error[i] = target.error.x;
            self.target_normal.set(i, target.normal);
        }
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

    /// A vertex as lights are chosen for it.
    #[inline(always)]
    pub(super) fn receiver(&self, i: usize, plain: &Plain) -> Receiver {
        Receiver {
            point: self.position.get(i),
            normal: plain.opaque.then(|| self.ns.get(i)),
        }
    }

    /// The cosine of a direction to the geometric normal on the viewer's side.
    #[inline(always)]
    fn facing(&self, i: usize, w: Vec3<f32>) -> f32 {
        self.side[i] * self.ng.get(i).dot(w)
    }
}

/// Makes surfaces from the triangles of the first `n` vertices that want one.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn make_surfaces(n: usize, t: &Triangles, s: &mut Surfaces) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let [a, b, c] = [&t.corners[0], &t.corners[1], &t.corners[2]].map(|v| v.get(i));
        let [na, nb, nc] = [&t.normals[0], &t.normals[1], &t.normals[2]].map(|v| v.get(i));
        let (u, v) = (t.weights[0][i], t.weights[1][i]);
        let w = 1.0 - u - v;
        let ng = normal([a, b, c]);
        let ns = unit_or(na * w + nb * u + nc * v, ng);
        let position = a * w + b * u + c * v;
        let reach = largest(abs(a), largest(abs(b), abs(c)));
        let error = coupled(reach).x;
        let wanted = t.wanted[i];
        let pick = |new: Vec3<f32>, old: Vec3<f32>| {
            vec3(
                if wanted { new.x } else { old.x },
                if wanted { new.y } else { old.y },
                if wanted { new.z } else { old.z },
            )
        };
        s.position.set(i, pick(position, s.position.get(i)));
        s.ng.set(i, pick(ng, s.ng.get(i)));
        s.ns.set(i, pick(ns, s.ns.get(i)));
        s.error[i] = if wanted { error } else { s.error[i] };
    }
}

/// The geometric normal of a triangle, towards its outside.
#[inline(always)]
pub(super) fn normal([a, b, c]: [Vec3<f32>; 3]) -> Vec3<f32> {
    unit_or((b - a).cross(c - a), Vec3::Z)
}

#[inline(always)]
fn abs(v: Vec3<f32>) -> Vec3<f32> {
    vec3(v.x.abs(), v.y.abs(), v.z.abs())
}

#[inline(always)]
fn largest(a: Vec3<f32>, b: Vec3<f32>) -> Vec3<f32> {
    vec3(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z))
}

/// Turns the first `n` surfaces to their viewers, and makes their frames.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn turn(n: usize, s: &mut Surfaces) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let wo = s.towards.get(i).normalize();
        s.towards.set(i, wo);
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

/// Frames about the geometric normals for vertices of mirrors that are seen from behind their shading
/// normals.
///
/// * `from`, `to`: the vertices of mirrors.
pub(super) fn straighten(from: usize, to: usize, s: &mut Surfaces) {
    for i in from..to {
        if s.wo.z[i] <= 0.0 {
            let n = s.ng.get(i) * s.side[i];
            let frame = Frame::from_normal_tangent(n, s.tangent.get(i));
            s.ns.set(i, n);
            s.axes[0].set(i, frame.s);
            s.axes[1].set(i, frame.t);
            s.wo.set(i, frame.to_local(s.towards.get(i)));
        }
    }
}

/// Samples points of the one light of a scene for the first `n` vertices, as `Area::sample` does.
///
/// * `u`: of the points.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn draw_light(
    n: usize,
    (light, radiance, two_sided): (&Parallelogram, Rgb<f32>, bool),
    u: [&Column; 2],
    s: &Surfaces,
    a: &mut LightSamples,
) {
    let (normal, error) = (light.normal, light.error.x);
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let Seen { point, wi, pdf } = light.sample(s.position.get(i), [u[0][i], u[1][i]]);
        let emits = two_sided | (normal.dot(wi) < 0.0);
        a.pdf[i] = if emits { pdf } else { 0.0 };
        a.towards.set(i, wi);
        a.radiance.set_colour(i, radiance);
        a.delta[i] = false;
        a.far[i] = false;
        a.target.set(i, point);
        a.target_error[i] = error;
        a.target_normal.set(i, normal);
    }
}

/// Turns the light that could arrive into the frames; what comes from the wrong side is taken out.
///
/// * `from`, `to`: at which vertices.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn to_frames(from: usize, to: usize, s: &Surfaces, a: &mut LightSamples) {
    for i in from..to.min(WAVEFRONT_SIZE) {
        let towards = a.towards.get(i);
        let wi = s.frame(i).to_local(towards);
        let through = wi.z * s.facing(i, towards);
        a.wi.set(i, wi);
        a.pdf[i] = if through > 0.0 { a.pdf[i] } else { 0.0 };
    }
}

/// Weighs light that was sampled against the lobe's directions, by the power heuristic.
///
/// * `from`, `to`: at which vertices.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn weigh(from: usize, to: usize, throughput: &Vectors, a: &mut LightSamples) {
    for i in from..to.min(WAVEFRONT_SIZE) {
        let pdf = a.pdf[i];
        let ratio = a.lobe_pdf[i] / pdf;
        let both = power_heuristic(ratio);
        let weight = if a.delta[i] { 1.0 } else { both };
        let arrives = pdf > 0.0;
        let scale = if arrives { weight / pdf } else { 0.0 };
        let contribution =
            throughput.colour(i) * a.f_cos.colour(i) * (a.radiance.colour(i) * scale);
        let pick = |c: f32| if arrives { c } else { 0.0 };
        a.contribution.set_colour(i, contribution.map(pick));
    }
}

/// Keeps one of two lights, which brings as much as both; see `candidates`.
///
/// * `u`: decides, by element.
/// * `a`, `b`: the first, which the kept one takes the place of, and the second.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn keep_one(from: usize, to: usize, u: &Column, a: &mut LightSamples, b: &LightSamples) {
    for i in from..to.min(WAVEFRONT_SIZE) {
        let [x, y] = [a.contribution.colour(i), b.contribution.colour(i)];
        let (keeps_b, scale) = candidates::keeps_second(x, y, u[i]);
        let pick = |a: f32, b: f32| if keeps_b { b } else { a };
        let [of_a, of_b] =
            [&*a, b].map(|a| (a.towards.get(i), a.target.get(i), a.target_normal.get(i)));
        let pick_vector =
            |a: Vec3<f32>, b: Vec3<f32>| vec3(pick(a.x, b.x), pick(a.y, b.y), pick(a.z, b.z));
        let contribution = rgb(pick(x.r, y.r), pick(x.g, y.g), pick(x.b, y.b));
        a.contribution.set_colour(i, contribution * scale);
        a.towards.set(i, pick_vector(of_a.0, of_b.0));
        a.target.set(i, pick_vector(of_a.1, of_b.1));
        a.target_normal.set(i, pick_vector(of_a.2, of_b.2));
        a.target_error[i] = pick(a.target_error[i], b.target_error[i]);
        a.far[i] = (keeps_b & b.far[i]) | (!keeps_b & a.far[i]);
    }
}

/// Aims the rays that look for the light that was sampled.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn aim(n: usize, s: &Surfaces, a: &mut LightSamples) {
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let towards = a.towards.get(i);
        let error = Vec3::splat(s.error[i]);
        let origin = leave(s.position.get(i), error, s.ng.get(i), towards);
        let error = Vec3::splat(a.target_error[i]);
        let end = leave(a.target.get(i), error, a.target_normal.get(i), -towards);
        let along = end - origin;
        let far = a.far[i];
        a.origin.set(i, origin);
        a.direction.x[i] = if far { towards.x } else { along.x };
        a.direction.y[i] = if far { towards.y } else { along.y };
        a.direction.z[i] = if far { towards.z } else { along.z };
    }
}

/// How many directions were sampled, and how many of them rejected.
///
/// * `sides`: 1 or -1 where lobes are black from the inside, from which none is sampled.
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

/// Goes on in the directions that were sampled, by the rules of `PathTracer::scatter`.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
pub(super) fn go_on(n: usize, depth: u32, s: &Surfaces, survival: &Column, o: &mut ScatterSamples) {
    let plays = depth >= ROULETTE_FROM;
    for i in 0..n.min(WAVEFRONT_SIZE) {
        let wi = o.wi.get(i);
        let direction = s.frame(i).to_world(wi).normalize();
        let throughput = o.throughput.colour(i) * o.weight.colour(i);
        let largest = throughput.max_channel() * o.eta_scale[i];
        let probability = survival_probability(largest);
        let thinned = plays & (probability < 0.95);
        let survives = !thinned | (survival[i] < probability);
        let scale = if thinned { 1.0 / probability } else { 1.0 };
        o.alive[i] = (wi.z * s.facing(i, direction) > 0.0) & (largest > 0.0) & survives;
        o.throughput.set_colour(i, throughput * scale);
        o.direction.set(i, direction);
        let error = Vec3::splat(s.error[i]);
        let origin = leave(s.position.get(i), error, s.ng.get(i), direction);
        o.origin.set(i, origin);
    }
}
