//! Paths of a group that share what lies behind their first rough vertices.
//!
//! Bekaert, Sbert and Halton 2002, "Accelerating path tracing by re-using paths". A group is of
//! neighbouring pixels, one sample of each. Let `x_i` be the first vertex of path `i` whose lobe is not
//! perfectly smooth, and `y_i` the next. Every `x_i` that sees `y_j` takes the radiance that path `j` estimated
//! there, as if it had sampled `y_j` itself. With `p_k` the density with which path `k` samples `y_j` from `x_k`
//! (area measure, 0 where `y_j` is occluded) and `q_k` that of the direction sampled at `y_j` seen from `x_k`,
//! the estimates are combined by the balance heuristic (Veach 1997, 9.2.2):
//!
//! * the light sampled at `y_j`: `f_i g_i f(y_j, light) L w_L / (pdf sum_k p_k)`
//! * radiance along the sampled direction: `f_i g_i f(y_j, direction) L w_B / (sum_k p_k q_k)`
//!
//! As `k = i` is in both sums, radiance is scaled no higher than path `i` would have scaled it, the weight of
//! light at `y_j` aside: sharing makes no fireflies. MIS at `y_j` takes the mean density of the group,
//! `sum p_k q_k / sum p_k`, for both strategies, so that their weights add up to 1. Emission of the surfaces at
//! `y_j`, and light beyond vertices that are smooth, textured or stochastic, stays with its own path.

use specula_bsdf::bsdf::Lobe;
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Frame, Rgb, Vec3};

mod connect;
mod pairs;

pub(super) use pairs::PairBuffers;

use super::ray_queue::index;
use super::vertex_batch::{Floats, Vectors, VertexBatch, WAVEFRONT_SIZE, ZERO};
use super::wavefront::Wavefront;
use super::{PathTracer, estimator};
use crate::material::{Plain, lobes};
use crate::offset::SurfacePoint;

/// Least distance of two vertices that are connected, in errors of their positions. The direction between them
/// is then exact enough for lobes. Nearer vertices, as in corners of fine meshes, are not shared.
const LEAST_DISTANCE: f32 = 256.0;

/// How far a path has come.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// All vertices were perfectly smooth.
    BeforeX,
    /// The last vertex is its `x`.
    AtX,
    /// The last vertex is its `y`.
    AtY,
    /// Its `y` is farther back.
    AfterY,
    /// It has no `y`.
    Unshared,
}

/// Vertices by the index of their path.
struct Vertices {
    position: Vectors,
    error: Floats,
    /// Geometric normals on the viewers' sides.
    facing: Vectors,
    axes: [Vectors; 3],
    key: [u32; WAVEFRONT_SIZE],
}

/// Emission, of a surface or from infinity, that a direction sampled at a `y` hit.
struct EmissionHit {
    path: usize,
    radiance: Rgb<f32>,
    /// Density with which light sampling takes the direction.
    light_pdf: f32,
}

/// The vertices that paths share, by path index.
pub(super) struct Shared {
    stage: [Stage; WAVEFRONT_SIZE],
    has_x: [bool; WAVEFRONT_SIZE],
    x: Vertices,
    y: Vertices,
    /// Towards the viewers of the `x`, local.
    wo: Vectors,
    /// Up to `x`.
    throughput: Vectors,
    /// Radiance of the path from before its `y`.
    radiance_before_y: Vectors,
    /// The light sample at `y`: radiance over density, direction, density (0 where it is occluded).
    light: Vectors,
    light_wi: Vectors,
    light_pdf: Floats,
    light_delta: [bool; WAVEFRONT_SIZE],
    /// The direction sampled at `y`; 0 where the path ends there.
    sampled_wi: Vectors,
    /// Throughput after `y` without Russian roulette, and the factor of roulette.
    throughput_after_y: Vectors,
    roulette: Floats,
    emission_hits: Vec<EmissionHit>,
}

impl Vertices {
    const NONE: Self = Self {
        position: Vectors::ZERO,
        error: ZERO,
        facing: Vectors::ZERO,
        axes: [Vectors::ZERO; 3],
        key: [0; WAVEFRONT_SIZE],
    };

    fn set(&mut self, path: usize, batch: &VertexBatch, i: usize, key: u32) {
        let s = &batch.surfaces;
        self.position.set(path, s.position.get(i));
        self.error[path] = s.error[i];
        self.facing.set(path, s.ng.get(i) * s.side[i]);
        self.axes[0].set(path, s.axes[0].get(i));
        self.axes[1].set(path, s.axes[1].get(i));
        self.axes[2].set(path, s.ns.get(i));
        self.key[path] = key;
    }

    #[inline(always)]
    fn frame(&self, path: usize) -> Frame<f32> {
        let [s, t, n] = [0, 1, 2].map(|k| self.axes[k].get(path));
        Frame { s, t, n }
    }

    /// A direction in the frame; zero where it is on different sides of surface and frame.
    #[inline(always)]
    fn local(&self, path: usize, w: Vec3<f32>) -> Vec3<f32> {
        let local = self.frame(path).to_local(w);
        let agree = estimator::sides_agree(local.z, self.facing.get(path).dot(w));
        let or_zero = |v: f32| if agree { v } else { 0.0 };
        vec3(or_zero(local.x), or_zero(local.y), or_zero(local.z))
    }

    /// Whether a point is far enough from a vertex to be connected with it.
    #[inline(always)]
    fn is_connectable(&self, path: usize, point: Vec3<f32>, error: f32) -> bool {
        let away = (point - self.position.get(path)).length();
        away > LEAST_DISTANCE * (self.error[path] + error)
    }

    /// A vertex as rays leave it.
    #[inline(always)]
    fn point(&self, path: usize) -> SurfacePoint {
        SurfacePoint {
            position: self.position.get(path),
            error: Vec3::splat(self.error[path]),
            normal: self.facing.get(path),
        }
    }
}

impl Shared {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            stage: [Stage::Unshared; WAVEFRONT_SIZE],
            has_x: [false; WAVEFRONT_SIZE],
            x: Vertices::NONE,
            y: Vertices::NONE,
            wo: Vectors::ZERO,
            throughput: Vectors::ZERO,
            radiance_before_y: Vectors::ZERO,
            light: Vectors::ZERO,
            light_wi: Vectors::ZERO,
            light_pdf: ZERO,
            light_delta: [false; WAVEFRONT_SIZE],
            sampled_wi: Vectors::ZERO,
            throughput_after_y: Vectors::ZERO,
            roulette: ZERO,
            emission_hits: Vec::new(),
        })
    }

    /// Begins all paths anew.
    pub(super) fn begin(&mut self) {
        self.stage.fill(Stage::BeforeX);
        self.has_x.fill(false);
        self.emission_hits.clear();
    }

    /// Whether a path's last vertex is its `y`.
    #[inline(always)]
    pub(super) fn is_at_y(&self, path: usize) -> bool {
        self.stage[path] == Stage::AtY
    }

    /// Records emission that the direction sampled at a `y` hit.
    pub(super) fn record_emission(&mut self, path: usize, radiance: Rgb<f32>, light_pdf: f32) {
        if !radiance.is_black() {
            self.emission_hits.push(EmissionHit {
                path,
                radiance,
                light_pdf,
            });
        }
    }

    /// Records that a vertex of a path cannot be shared.
    pub(super) fn pass_unshared(&mut self, path: usize) {
        let stage = &mut self.stage[path];
        *stage = match stage {
            Stage::AtY | Stage::AfterY => Stage::AfterY,
            _ => Stage::Unshared,
        };
    }

    /// Whether vertex `i` of the batch is far enough from the `x` of its path.
    fn is_connectable(&self, path: usize, batch: &VertexBatch, i: usize) -> bool {
        let s = &batch.surfaces;
        self.x.is_connectable(path, s.position.get(i), s.error[i])
    }

    /// Stores the light sample at a `y`, which is not occluded.
    pub(super) fn store_light(&mut self, path: usize, batch: &VertexBatch, i: usize) {
        let a = &batch.light_samples;
        let scale = 1.0 / a.pdf[i];
        self.light.set_colour(path, a.radiance.colour(i) * scale);
        self.light_wi.set(path, a.wi_world.get(i));
        self.light_pdf[path] = a.pdf[i];
        self.light_delta[path] = a.delta[i];
    }

    /// Stores the direction sampled at a `y`, in which the path continues.
    pub(super) fn store_direction(&mut self, path: usize, batch: &VertexBatch, i: usize) {
        let scatter = &batch.scatter_samples;
        // Until here `roulette` holds the colourless throughput up to `y`.
        let throughput_after_y = scatter.weight.colour(i) * self.roulette[path];
        let throughput = scatter.throughput.colour(i).max_channel();
        self.sampled_wi.set(path, scatter.direction.get(i));
        self.throughput_after_y.set_colour(path, throughput_after_y);
        self.roulette[path] = throughput / throughput_after_y.max_channel();
    }

    /// Throughput after `x`, where roulette is not played: its probability would be part of the density of `y`.
    pub(super) fn throughput_from_x(&self, path: usize, weight: Rgb<f32>) -> Option<Rgb<f32>> {
        let is_at_x = self.stage[path] == Stage::AtX;
        is_at_x.then(|| self.throughput.colour(path) * weight)
    }

    /// Lets every path survive Russian roulette at its `x`.
    ///
    /// * `survival`: the random numbers that decide.
    pub(super) fn disable_roulette_at_x(&self, path_indices: &[u32], survival: &mut [f32]) {
        for (owner, survival) in path_indices.iter().zip(survival) {
            if self.stage[index(*owner)] == Stage::AtX {
                *survival = 0.0;
            }
        }
    }

    fn has_y(&self, path: usize) -> bool {
        matches!(self.stage[path], Stage::AtY | Stage::AfterY)
    }
}

/// Whether vertices of a material can be shared: others evaluate its lobe in batches, and every direction of it has a
/// density.
fn is_shared(plain: &Plain) -> bool {
    let is_partly_mirror = match &plain.lobe {
        Lobe::CoatedDiffuse(lobe) => lobe.is_smooth(),
        Lobe::Plastic(lobe) => lobe.is_smooth(),
        _ => false,
    };
    plain.is_batched
        && plain.reflectance.is_none()
        && !(plain.specular || is_partly_mirror || lobes::takes_streams(&plain.lobe))
}

impl PathTracer<'_> {
    /// Records which vertices of the batch are the `x` and `y` of their paths.
    pub(super) fn record_shared_vertices(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            paths,
            runs,
            batch,
            shared: Some(shared),
            ..
        } = wavefront
        else {
            return;
        };
        for run in runs.iter() {
            let Some(sides) = self.scene.materials.plain(run.key / 2) else {
                for i in run.range() {
                    shared.pass_unshared(index(batch.path_indices[i]));
                }
                continue;
            };
            let plain = &sides[(run.key % 2) as usize];
            for i in run.range() {
                let path = index(batch.path_indices[i]);
                let black = plain.black_inside && batch.surfaces.side[i] < 0.0;
                let usable = is_shared(plain) && !black;
                let after = match (shared.stage[path], usable) {
                    (Stage::BeforeX, true) => {
                        shared.x.set(path, batch, i, run.key);
                        shared.wo.set(path, batch.surfaces.wo.get(i));
                        let throughput = batch.scatter_samples.throughput.colour(i);
                        shared.throughput.set_colour(path, throughput);
                        shared.has_x[path] = true;
                        Stage::AtX
                    }
                    (Stage::AtX, true) if shared.is_connectable(path, batch, i) => {
                        shared.y.set(path, batch, i, run.key);
                        shared
                            .radiance_before_y
                            .set_colour(path, paths.radiance.colour(path));
                        paths.radiance.set_colour(path, Rgb::BLACK);
                        // Contributions to other paths are clamped there.
                        paths.bound[path] = f32::INFINITY;
                        shared.light_pdf[path] = 0.0;
                        shared.sampled_wi.set(path, Vec3::ZERO);
                        let scatter = &mut batch.scatter_samples;
                        // Without colour: others may have another.
                        let scale = scatter.throughput.colour(i).max_channel();
                        shared.roulette[path] = scale;
                        scatter.throughput.set_colour(i, rgb(scale, scale, scale));
                        Stage::AtY
                    }
                    (Stage::BeforeX, false) if plain.specular => Stage::BeforeX,
                    (Stage::AtY | Stage::AfterY, _) => Stage::AfterY,
                    _ => Stage::Unshared,
                };
                shared.stage[path] = after;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::id;
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;
    use crate::sampler::Sampler;

    /// Before roulette, which is another, a path that shares with none is the path alone up to rounding.
    #[test]
    fn a_group_of_one_is_an_unshared_path() {
        let mut scene = specula_scene::builtin::orbs();
        let texts = [
            "conductor Au alpha 0.3",
            "dielectric 1.5 alpha 0.2",
            "diffuse 0.6",
        ];
        let kinds = texts.map(|t| specula_scene::material_text::parse_material(t).unwrap());
        for (material, kind) in scene.materials.iter_mut().zip(kinds.iter().cycle()) {
            material.kind = *kind;
        }
        let options = |share_paths| RenderOptions {
            max_depth: 3,
            resolution: Some([64, 48]),
            share_paths,
            ..RenderOptions::default()
        };
        let prepared = PreparedScene::new(&scene, &options(1)).unwrap();
        let [alone, shares] = [1, 2].map(|n| PathTracer::new(&prepared, &options(n)));
        let [mut a, mut b] = [Wavefront::new(), Wavefront::new()];
        let (mut arrived, mut off) = (0, 0);
        for first in (0..64 * 48).step_by(Wavefront::SIZE) {
            let sample = |i| {
                let pixel = [i % 64, i / 64];
                (pixel, Sampler::new(pixel, 3, 5))
            };
            let indices = first..first + id(Wavefront::SIZE);
            alone.begin(&mut a, indices.clone().map(sample));
            alone.follow_all(&mut a);
            shares.begin(&mut b, indices.map(sample));
            shares.follow_all(&mut b);
            shares.share(&mut b, &[1; Wavefront::SIZE]);
            let shared = b.shared.as_ref().unwrap();
            arrived += (0..WAVEFRONT_SIZE).filter(|&i| shared.has_y(i)).count();
            for i in 0..WAVEFRONT_SIZE {
                let [own, other] = [alone.contribution(&a, i).0, shares.contribution(&b, i).0];
                let scale = own.colour.max_channel().max(1e-2);
                let difference = (own.colour - other.colour).map(f32::abs).max_channel();
                off += usize::from(difference > 3e-3 * scale);
            }
        }
        assert!(arrived > 500, "{arrived}");
        // Directions from point to point round otherwise at grazing angles.
        assert!(off < 8, "{off} of {}", 64 * 48);
    }

    /// In an element of its own, as where nothing is shared: of a smooth coat, too, some directions have no density.
    #[test]
    fn mirrors_are_no_vertices_to_share() {
        for text in ["conductor Au alpha 0", "coateddiffuse 0.5 alpha 0"] {
            let mut scene = specula_scene::builtin::orbs();
            let mirror = specula_scene::material_text::parse_material(text).unwrap();
            for material in &mut scene.materials {
                material.kind = mirror;
            }
            let options = RenderOptions {
                resolution: Some([64, 48]),
                share_paths: 4,
                ..RenderOptions::default()
            };
            let prepared = PreparedScene::new(&scene, &options).unwrap();
            let tracer = PathTracer::new(&prepared, &options);
            let mut wavefront = Wavefront::new();
            let sample = |i| ([i % 64, i / 64], Sampler::new([i % 64, i / 64], 0, 0));
            tracer.begin(&mut wavefront, (0..id(Wavefront::SIZE)).map(sample));
            tracer.follow_all(&mut wavefront);
            let colours = |wavefront: &Wavefront| -> Vec<_> {
                (0..WAVEFRONT_SIZE)
                    .map(|i| wavefront.pixel_sample(i).0.colour)
                    .collect()
            };
            let before = colours(&wavefront);
            tracer.share(&mut wavefront, &[4; Wavefront::SIZE / 4]);
            assert_eq!(before, colours(&wavefront), "{text}");
            let shared = wavefront.shared.as_ref().unwrap();
            assert!(shared.has_x.iter().all(|has_x| !has_x), "{text}");
        }
    }
}
