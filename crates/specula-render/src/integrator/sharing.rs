//! Paths of a group that share what lies behind their first rough vertices.
//!
//! Bekaert, Sbert and Halton 2002, "Accelerating path tracing by re-using paths". A group is of
//! neighbouring pixels, one sample of each. Let `x_i` be the first vertex of path `i` whose lobe is not
//! perfectly smooth, and `y_i` the next. Every `x_i` that sees `y_j` takes the light that path `j` found
//! there, as if it had sampled `y_j` itself. With `p_k` the density of `y_j` among the points that path `k`
//! draws from `x_k` (area measure, 0 where something stands between) and `q_k` that of the direction
//! sampled at `y_j` seen from `x_k`, the estimates are combined by the balance heuristic (Veach 1997,
//! 9.2.2):
//!
//! * the light sampled at `y_j`: `f_i g_i f(y_j, light) L w_L / (pdf sum_k p_k)`
//! * what the sampled direction found: `f_i g_i f(y_j, direction) L w_B / (sum_k p_k q_k)`
//!
//! As `k = i` is in both sums, what is found is scaled no higher than path `i` would have scaled it, the
//! weight of light at `y_j` aside: sharing makes no fireflies of far-fetched connections. Light that both strategies find at `y_j` is weighed with the mean density of the
//! group, `sum p_k q_k / sum p_k`, the same in both, so that the weights add up to 1. Light of the
//! surfaces at `y_j` themselves, and all that is found beyond vertices that are smooth, textured or
//! estimates, stays with its own path.

use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Frame, Rgb, Vec3};

mod connect;
mod pairs;

pub(super) use pairs::Work;

use super::PathTracer;
use super::vertex_batch::{Column, Vectors, VertexBatch, WAVEFRONT_SIZE, ZERO};
use super::wavefront::{Wavefront, index};
use crate::material::{Plain, lobes};
use crate::offset::leave;

/// How far, in errors of their positions, vertices are from each other at least: the direction from one to
/// the other is then good to a thousandth of what lobes can tell apart. Nearer ones, as in the corners of
/// finely cut meshes, stay with their own paths.
const FAR: f32 = 256.0;

/// How far a path has come.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// It met smooth surfaces only.
    Begins,
    /// The vertex before was its `x`.
    Left,
    /// This vertex, or the one before, is its `y`.
    Arrived,
    /// Its `y` is farther back.
    Beyond,
    /// It has no `y`.
    Apart,
}

/// Vertices by the index of their path.
struct Vertices {
    position: Vectors,
    error: Column,
    /// Geometric normals on the viewers' sides.
    facing: Vectors,
    axes: [Vectors; 3],
    key: [u32; WAVEFRONT_SIZE],
}

/// Light from infinity or of a surface that a direction sampled at a `y` met.
struct Met {
    path: usize,
    radiance: Rgb<f32>,
    /// Density with which lights would have sampled it.
    light_pdf: f32,
}

/// What paths of groups leave for each other, by path index.
pub(super) struct Shared {
    stage: [Stage; WAVEFRONT_SIZE],
    has_x: [bool; WAVEFRONT_SIZE],
    x: Vertices,
    y: Vertices,
    /// Towards the viewers of the `x`, local.
    wo: Vectors,
    /// Up to `x`.
    throughput: Vectors,
    /// What the path had found before its `y`.
    before: Vectors,
    /// The light sampled at `y`, over its density; that density, 0 where nothing arrives.
    light: Vectors,
    towards: Vectors,
    light_pdf: Column,
    light_delta: [bool; WAVEFRONT_SIZE],
    /// The direction sampled at `y`; 0 where the path ends there.
    scatter_samples: Vectors,
    /// Throughput behind `y` before roulette, and what roulette made of it.
    carried: Vectors,
    roulette: Column,
    met: Vec<Met>,
}

impl Vertices {
    const NONE: Self = Self {
        position: Vectors::ZERO,
        error: ZERO,
        facing: Vectors::ZERO,
        axes: [Vectors::ZERO; 3],
        key: [0; WAVEFRONT_SIZE],
    };

    fn set(&mut self, path: usize, batch: &VertexBatch, lane: usize, key: u32) {
        let s = &batch.surfaces;
        self.position.set(path, s.position.get(lane));
        self.error[path] = s.error[lane];
        self.facing.set(path, s.ng.get(lane) * s.side[lane]);
        self.axes[0].set(path, s.axes[0].get(lane));
        self.axes[1].set(path, s.axes[1].get(lane));
        self.axes[2].set(path, s.ns.get(lane));
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
        let agree = local.z * self.facing.get(path).dot(w) > 0.0;
        let keep = |v: f32| if agree { v } else { 0.0 };
        vec3(keep(local.x), keep(local.y), keep(local.z))
    }

    /// Whether a point is far enough from a vertex for a direction between them.
    #[inline(always)]
    fn is_far(&self, path: usize, point: Vec3<f32>, error: f32) -> bool {
        let away = (point - self.position.get(path)).length();
        away > FAR * (self.error[path] + error)
    }

    /// Where a ray leaves a vertex.
    #[inline(always)]
    fn leave(&self, path: usize, w: Vec3<f32>) -> Vec3<f32> {
        let error = Vec3::splat(self.error[path]);
        leave(self.position.get(path), error, self.facing.get(path), w)
    }
}

impl Shared {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            stage: [Stage::Apart; WAVEFRONT_SIZE],
            has_x: [false; WAVEFRONT_SIZE],
            x: Vertices::NONE,
            y: Vertices::NONE,
            wo: Vectors::ZERO,
            throughput: Vectors::ZERO,
            before: Vectors::ZERO,
            light: Vectors::ZERO,
            towards: Vectors::ZERO,
            light_pdf: ZERO,
            light_delta: [false; WAVEFRONT_SIZE],
            scatter_samples: Vectors::ZERO,
            carried: Vectors::ZERO,
            roulette: ZERO,
            met: Vec::new(),
        })
    }

    /// Makes all paths new ones that will share.
    pub(super) fn begin(&mut self) {
        self.stage.fill(Stage::Begins);
        self.has_x.fill(false);
        self.met.clear();
    }

    /// Whether a path's last vertex was its `y`, or this one is.
    #[inline(always)]
    pub(super) fn is_at_y(&self, path: usize) -> bool {
        self.stage[path] == Stage::Arrived
    }

    /// Keeps what a direction that was sampled at a `y` met.
    pub(super) fn meet(&mut self, path: usize, radiance: Rgb<f32>, light_pdf: f32) {
        if !radiance.is_black() {
            self.met.push(Met {
                path,
                radiance,
                light_pdf,
            });
        }
    }

    /// Says that a path goes a vertex by itself.
    pub(super) fn pass_alone(&mut self, path: usize) {
        let stage = &mut self.stage[path];
        *stage = match stage {
            Stage::Arrived | Stage::Beyond => Stage::Beyond,
            _ => Stage::Apart,
        };
    }

    /// Whether the vertex in an element is far enough from the `x` of its path.
    fn is_far(&self, path: usize, batch: &VertexBatch, lane: usize) -> bool {
        let s = &batch.surfaces;
        self.x.is_far(path, s.position.get(lane), s.error[lane])
    }

    /// Keeps the light sampled at a `y`, which nothing is in the way of.
    pub(super) fn keep_light(&mut self, path: usize, batch: &VertexBatch, lane: usize) {
        let a = &batch.light_samples;
        let scale = 1.0 / a.pdf[lane];
        self.light.set_colour(path, a.radiance.colour(lane) * scale);
        self.towards.set(path, a.towards.get(lane));
        self.light_pdf[path] = a.pdf[lane];
        self.light_delta[path] = a.delta[lane];
    }

    /// Keeps the direction sampled at a `y`, in which the path goes on.
    pub(super) fn keep_direction(&mut self, path: usize, batch: &VertexBatch, lane: usize) {
        let o = &batch.scatter_samples;
        // Until now the throughput without colour with which the path met its `y`.
        let carried = o.weight.colour(lane) * self.roulette[path];
        let throughput = o.throughput.colour(lane).max_channel();
        self.scatter_samples.set(path, o.direction.get(lane));
        self.carried.set_colour(path, carried);
        self.roulette[path] = throughput / carried.max_channel();
    }

    /// What a path carries on from its `x`, where no roulette is played: the density of `y` would have its
    /// probability in it.
    pub(super) fn carried_from_x(&self, path: usize, weight: Rgb<f32>) -> Option<Rgb<f32>> {
        let leaves = self.stage[path] == Stage::Left;
        leaves.then(|| self.throughput.colour(path) * weight)
    }

    /// Sees to it that no path ends at its `x` by roulette.
    ///
    /// * `survival`: the random numbers that decide, by element.
    pub(super) fn let_pass(&self, owners: &[u32], survival: &mut [f32]) {
        for (owner, survival) in owners.iter().zip(survival) {
            if self.stage[index(*owner)] == Stage::Left {
                *survival = 0.0;
            }
        }
    }

    fn has_y(&self, path: usize) -> bool {
        matches!(self.stage[path], Stage::Arrived | Stage::Beyond)
    }
}

/// Whether vertices of a material can be shared.
fn is_shared(plain: &Plain) -> bool {
    !plain.specular && !lobes::takes_streams(&plain.lobe)
}

impl PathTracer<'_> {
    /// Notes which of the vertices in batch are the `x` and `y` of their paths.
    pub(super) fn note_shared(&self, wavefront: &mut Wavefront) {
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
        let sides = runs.iter().filter_map(|s| {
            let sides = self.scene.materials.plain(s.key / 2)?;
            Some((&sides[(s.key % 2) as usize], s))
        });
        for (plain, run) in sides {
            for lane in run.from..run.to.min(WAVEFRONT_SIZE) {
                let path = index(batch.owners[lane]);
                let black = plain.black_inside && batch.surfaces.side[lane] < 0.0;
                let usable = is_shared(plain) && !black;
                let after = match (shared.stage[path], usable) {
                    (Stage::Begins, true) => {
                        shared.x.set(path, batch, lane, run.key);
                        shared.wo.set(path, batch.surfaces.wo.get(lane));
                        let throughput = batch.scatter_samples.throughput.colour(lane);
                        shared.throughput.set_colour(path, throughput);
                        shared.has_x[path] = true;
                        Stage::Left
                    }
                    (Stage::Left, true) if shared.is_far(path, batch, lane) => {
                        shared.y.set(path, batch, lane, run.key);
                        shared.before.set_colour(path, paths.radiance.colour(path));
                        paths.radiance.set_colour(path, Rgb::BLACK);
                        // What others take is bounded when they take it.
                        paths.bound[path] = f32::INFINITY;
                        shared.light_pdf[path] = 0.0;
                        shared.scatter_samples.set(path, Vec3::ZERO);
                        let o = &mut batch.scatter_samples;
                        // Without colour: others may have another.
                        let scale = o.throughput.colour(lane).max_channel();
                        shared.roulette[path] = scale;
                        o.throughput.set_colour(lane, rgb(scale, scale, scale));
                        Stage::Arrived
                    }
                    (Stage::Begins, false) if plain.specular => Stage::Begins,
                    (Stage::Arrived | Stage::Beyond, _) => Stage::Beyond,
                    _ => Stage::Apart,
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
    fn a_group_of_one_is_a_path_alone() {
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

    /// In an element of its own, as where nothing is shared.
    #[test]
    fn mirrors_are_no_vertices_to_share() {
        let mut scene = specula_scene::builtin::orbs();
        let mirror = specula_scene::material_text::parse_material("conductor Au alpha 0").unwrap();
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
        let before: Vec<_> = (0..WAVEFRONT_SIZE).map(|i| wavefront.seen(i).0).collect();
        tracer.share(&mut wavefront, &[4; Wavefront::SIZE / 4]);
        let after: Vec<_> = (0..WAVEFRONT_SIZE).map(|i| wavefront.seen(i).0).collect();
        let colours = |samples: &[crate::film::PixelSample]| -> Vec<_> {
            samples.iter().map(|s| s.colour).collect()
        };
        assert_eq!(colours(&before), colours(&after));
        assert!((0..WAVEFRONT_SIZE).all(|i| !wavefront.shared.as_ref().unwrap().has_x[i]));
    }
}
