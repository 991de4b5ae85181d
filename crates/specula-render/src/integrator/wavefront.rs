//! A wavefront: paths that are traced vertex by vertex together.
//!
//! Vertices are sorted by material and shaded in batches (`shade`); those whose lobes differ from vertex to vertex have
//! them bound one after the other there (`bound`). Vertices in media, at their boundaries, and where rays may pass
//! what they hit are shaded singly (`PathTracer::shade`). The scene and the path alone decide which, and a path never
//! depends on the others of its wavefront.

use core::ops::Range;
use core::sync::atomic::{AtomicBool, Ordering};

use specula_bsdf::Rgb;
use specula_bsdf::math::Stream;

use super::bound::BoundVertex;
use super::faces::FaceRun;
use super::own_lobes::OwnLobes;
use super::path_states::PathStates;
use super::quadrics::VerticesOnQuadrics;
use super::queue::QueuedVertex;
use super::ray_queue::RayQueue;
use super::sharing::{PairBuffers, Shared};
use super::vertex_batch::{Floats, VertexBatch, WAVEFRONT_SIZE, ZERO};
use super::{Path, PathTracer, Tally, portal_viewpoint};
use crate::accel::{BlockHits, Hit, Ray};
use crate::convert::id;
use crate::film::PixelSample;
use crate::geometry::NONE;
use crate::light;
use crate::options::Strategy;
use crate::prepared::PreparedScene;
use crate::sampler::{Purpose, Sampler};

/// Consecutive vertices of a batch with the same key.
pub(super) struct MaterialRun {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) key: u32,
    /// Index of the first of its bound vertices, where its lobes are bound.
    pub(super) first_bound: usize,
}

impl MaterialRun {
    /// The vertices' indices.
    #[inline(always)]
    pub(super) fn range(&self) -> Range<usize> {
        self.from..self.to.min(WAVEFRONT_SIZE)
    }

    /// The vertices' indices, and their lobes.
    ///
    /// * `all`: those of the batch.
    #[inline(always)]
    pub(super) fn bound<'s>(
        &self,
        all: &'s [BoundVertex],
    ) -> impl Iterator<Item = (usize, &'s BoundVertex)> + use<'s> {
        self.range().zip(&all[self.first_bound..])
    }
}

/// The paths of a wavefront, and their buffers.
pub(crate) struct Wavefront {
    pub(super) paths: Box<PathStates>,
    /// Filter weights of the samples.
    weights: Floats,
    /// Factors on their radiance, where cameras have lenses.
    lens_weights: Option<Box<Floats>>,
    /// Counts since they were taken last.
    pub(super) tally: Tally,
    /// The live paths, and the hits of their rays.
    pub(super) live: Box<RayQueue>,
    pub(super) hits: Box<BlockHits>,
    /// Those that continue from there.
    pub(super) next: Box<RayQueue>,
    /// Indices among the live paths, of rays without a hit.
    pub(super) escaped: Vec<u32>,
    pub(super) queued: Vec<QueuedVertex>,
    /// How many vertices are queued of each key, then where they begin.
    pub(super) starts: Vec<u32>,
    pub(super) runs: Vec<MaterialRun>,
    pub(super) face_runs: Vec<FaceRun>,
    pub(super) batch: Box<VertexBatch>,
    pub(super) quadrics: Box<VerticesOnQuadrics>,
    /// Of the runs whose lobes are bound, one after the other.
    pub(super) bound: Vec<BoundVertex>,
    /// Those of them that are evaluated and sampled at once.
    pub(super) own_lobes: OwnLobes,
    pub(super) streams: Vec<Stream>,
    /// Shadow rays, with the indices of their vertices.
    pub(super) shadow_rays: Box<RayQueue>,
    /// Whether they are occluded.
    pub(super) occluded: Vec<bool>,
    pub(super) lights: Box<light::LightQueues>,
    /// Where paths share.
    pub(super) shared: Option<Box<Shared>>,
    pub(super) pairs: Option<Box<PairBuffers>>,
}

impl Wavefront {
    /// Most paths of a wavefront.
    pub(crate) const SIZE: usize = WAVEFRONT_SIZE;

    /// An empty one.
    pub(crate) fn new() -> Self {
        Self {
            paths: PathStates::new(),
            weights: ZERO,
            lens_weights: None,
            tally: Tally::default(),
            live: RayQueue::new(),
            hits: Box::new(BlockHits::new()),
            next: RayQueue::new(),
            escaped: Vec::new(),
            queued: Vec::new(),
            starts: Vec::new(),
            runs: Vec::new(),
            face_runs: Vec::new(),
            batch: VertexBatch::new(),
            quadrics: Box::new(VerticesOnQuadrics::EMPTY),
            bound: Vec::new(),
            own_lobes: OwnLobes::default(),
            streams: Vec::new(),
            shadow_rays: RayQueue::new(),
            occluded: Vec::new(),
            lights: light::LightQueues::new(),
            shared: None,
            pairs: None,
        }
    }

    /// The pixel sample of a path, not yet developed, and its filter weight.
    #[inline(always)]
    pub(crate) fn pixel_sample(&self, i: usize) -> (PixelSample, f32) {
        let mut sample = self.paths.pixel_sample(i);
        if let Some(weights) = &self.lens_weights {
            sample.colour *= weights[i];
        }
        (sample, self.weights[i])
    }

    /// The first path, which has just begun.
    pub(super) fn first_path(&self) -> Path {
        self.paths.load(0, self.live.ray(0))
    }

    /// Whether the vertex before is the one that a path shares with others.
    ///
    /// * `k`: index among the live paths.
    pub(super) fn is_at_y(&self, k: usize) -> bool {
        let i = self.live.index(k);
        (self.shared.as_ref()).is_some_and(|shared| shared.is_at_y(i))
    }

    /// Counts since they were taken last.
    pub(crate) fn take_tally(&mut self) -> Tally {
        std::mem::take(&mut self.tally)
    }
}

impl PathTracer<'_> {
    /// Begins a path for each sample, at most [`Wavefront::SIZE`]: its pixel and its sampler.
    pub(crate) fn begin(
        &self,
        wavefront: &mut Wavefront,
        samples: impl Iterator<Item = ([u32; 2], Sampler)>,
    ) {
        let PreparedScene {
            filter,
            camera,
            materials,
            ..
        } = self.scene;
        let Wavefront {
            paths,
            weights,
            lens_weights,
            live,
            batch,
            shared,
            pairs,
            ..
        } = wavefront;
        if self.shares {
            shared.get_or_insert_with(Shared::new).begin();
            pairs.get_or_insert_with(|| Box::new(PairBuffers::new()));
        }
        let VertexBatch {
            random_numbers,
            raster,
            ..
        } = &mut **batch;
        let mut n = 0;
        for (i, (pixel, sampler)) in samples.take(WAVEFRONT_SIZE).enumerate() {
            paths.samplers[i] = sampler;
            random_numbers.set(i, &sampler);
            raster[0][i] = pixel[0] as f32 + 0.5;
            raster[1][i] = pixel[1] as f32 + 0.5;
            n = i + 1;
        }
        paths.begin(n, materials.has_boundaries(), self.bound);
        random_numbers.generate(n, Purpose::Camera, 0);
        let [lens_x, filter_x, filter_y, lens_y] = &random_numbers.values;
        let [x, y] = raster;
        filter.sample_all(
            [&filter_x[..n], &filter_y[..n]],
            [&mut x[..n], &mut y[..n]],
            &mut weights[..n],
        );
        self.begin_cones(paths, [&x[..n], &y[..n]]);
        live.clear();
        if camera.has_lenses() {
            let factors = lens_weights.get_or_insert_with(|| Box::new(ZERO));
            let raster = [&x[..n], &y[..n]];
            self.begin_in_lenses(paths, live, factors, raster, [lens_x, lens_y]);
            return;
        }
        if self.scene.moves {
            for i in 0..n {
                let time = paths.samplers[i].time();
                paths.times[i] = time;
                let (origin, direction) = camera.ray_at(time, [x[i], y[i]], [lens_x[i], lens_y[i]]);
                let t_max = f32::INFINITY;
                let ray = Ray {
                    origin,
                    direction,
                    t_max,
                };
                live.push(id(i), &ray);
            }
            return;
        }
        camera.rays(
            [&x[..n], &y[..n]],
            [&lens_x[..n], &lens_y[..n]],
            |i, ray| live.push(id(i), &ray),
        );
    }

    /// Follows all paths of a wavefront to their ends.
    #[cfg(test)]
    pub(crate) fn follow_all(&self, wavefront: &mut Wavefront) {
        self.follow_until(wavefront, &AtomicBool::new(false));
    }

    /// Follows all paths of a wavefront to their ends; returns whether it came to that.
    ///
    /// * `stop`: read before every vertex.
    pub(crate) fn follow_until(&self, wavefront: &mut Wavefront, stop: &AtomicBool) -> bool {
        let mut depth = 0;
        while wavefront.live.len() > 0 {
            if stop.load(Ordering::Relaxed) {
                return false;
            }
            wavefront.next.clear();
            if self.uses_batches(depth) {
                self.shade_all(wavefront, depth);
            } else {
                for k in 0..wavefront.live.len() {
                    self.step_scalar(wavefront, k, |path| self.step(path, depth));
                }
            }
            std::mem::swap(&mut wavefront.live, &mut wavefront.next);
            depth += 1;
        }
        true
    }

    /// Whether vertices are shaded in batches. Paths share where every ray ends at its first hit.
    fn uses_batches(&self, depth: u32) -> bool {
        let goes_beyond = self.goes_beyond_hits(depth);
        self.strategy == Strategy::Mis && self.max_depth > 0 && !(self.shares && goes_beyond)
    }

    /// Whether rays pass some surfaces, or media absorb on their way.
    #[inline(always)]
    pub(super) fn goes_beyond_hits(&self, depth: u32) -> bool {
        let scene = self.scene;
        let hides = scene.hide_emitters && depth == 0;
        scene.geometry.has_passable || scene.materials.has_boundaries() || hides
    }

    /// Whether a ray may go on beyond its first hit, or is absorbed on its way there.
    ///
    /// * `i`: index of the path.
    pub(super) fn is_followed_alone(
        &self,
        paths: &PathStates,
        i: usize,
        hit: &Hit,
        depth: u32,
    ) -> bool {
        let geometry = &self.scene.geometry;
        let group = geometry.group_of(hit);
        let shape = group.shape_of[hit.primitive as usize];
        let hides = self.scene.hide_emitters && depth == 0;
        geometry.shapes[shape as usize].is_passable()
            || (hides && group.light_of(hit.primitive) != NONE)
            || (self.scene.materials.has_boundaries() && paths.is_in_a_medium(i))
    }

    /// Takes one path to its next vertex, by itself.
    ///
    /// * `step`: returns whether the path continues.
    pub(super) fn step_scalar(
        &self,
        wavefront: &mut Wavefront,
        k: usize,
        step: impl FnOnce(&mut Path) -> bool,
    ) {
        let i = wavefront.live.index(k);
        let mut path = wavefront.paths.load(i, wavefront.live.ray(k));
        if step(&mut path) {
            wavefront.next.push(id(i), &path.ray);
        }
        wavefront.tally = wavefront.tally.and(wavefront.paths.store(i, &path));
        if let Some(shared) = &mut wavefront.shared {
            shared.pass_unshared(i);
        }
    }

    /// Takes all live paths from one vertex to the next.
    fn shade_all(&self, wavefront: &mut Wavefront, depth: u32) {
        let geometry = &self.scene.geometry;
        let Wavefront {
            paths, live, hits, ..
        } = &mut *wavefront;
        let time = |k| paths.times[live.index(k)];
        geometry.accel.intersect_block_at(live.rays(), time, hits);
        wavefront.tally.rays += wavefront.live.len() as u64;
        self.queue_hits(wavefront, depth);
        self.add_background(wavefront, depth);
        if !wavefront.queued.is_empty() {
            self.sort_by_material(wavefront);
            self.shade_batch(wavefront, depth);
        }
    }

    /// Adds the emission of the surface that the ray of a live path hit.
    #[inline(never)]
    pub(super) fn add_emission(&self, wavefront: &mut Wavefront, k: usize, hit: &Hit, depth: u32) {
        let ray = wavefront.live.ray(k);
        let i = wavefront.live.index(k);
        let time = wavefront.paths.times[i];
        let surface = self.scene.geometry.surface(&ray, hit, time);
        let previous = wavefront.paths.previous(i);
        if let (Some(shared), Some(previous)) = (&mut wavefront.shared, previous)
            && shared.is_at_y(i)
        {
            let radiance = self.emission(None, &surface, ray.direction);
            let lights = &self.scene.lights;
            let light_pdf = lights.pdf_of_surface(&previous.receiver, &surface);
            shared.record_emission(i, radiance, light_pdf);
            return;
        }
        let radiance = self.emission(previous, &surface, ray.direction);
        let throughput = wavefront.paths.throughput.colour(i);
        wavefront.paths.add(i, throughput * radiance, depth);
    }

    /// Adds light from infinity on the rays that hit nothing.
    fn add_background(&self, wavefront: &mut Wavefront, depth: u32) {
        if wavefront.escaped.is_empty() {
            return;
        }
        let Wavefront {
            paths,
            live,
            escaped,
            lights: queues,
            shared,
            ..
        } = wavefront;
        let lights = &self.scene.lights;
        let directions = escaped
            .iter()
            .map(|&k| (k as usize, live.direction(k as usize)));
        let mut add = |paths: &mut PathStates, k: usize, radiance: Rgb<f32>, pdf: f32| {
            let i = live.index(k);
            if paths.straight[i] && self.scene.hide_emitters {
                return;
            }
            let previous = paths.previous(i);
            if let (Some(shared), Some(previous)) = (&mut *shared, previous)
                && shared.is_at_y(i)
            {
                let share = paths.share_from_infinity(i, lights, &previous.receiver);
                shared.record_emission(i, radiance, share * pdf);
                return;
            }
            let weight = self.emission_weight(previous, |receiver| {
                paths.share_from_infinity(i, lights, receiver) * pdf
            });
            let throughput = paths.throughput.colour(i);
            paths.add(i, throughput * radiance * weight, depth);
        };
        lights.arriving_from_infinity_all(queues, directions, |k, radiance, pdf| {
            add(paths, k, radiance, pdf);
        });
        if lights.has_portals() {
            for k in escaped.iter().map(|&k| k as usize) {
                let ray = live.ray(k);
                let from = portal_viewpoint(paths.previous(live.index(k)).as_ref(), &ray);
                for (radiance, pdf) in lights.arriving_through_portals(from, ray.direction) {
                    add(paths, k, radiance, pdf);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
