//! A wavefront: paths that are traced vertex by vertex together.
//!
//! Vertices are sorted by material and shaded in batches (`shade`); those whose lobes differ from vertex to vertex have
//! them bound one after the other there (`bound`). Vertices in media, at their boundaries, and where rays may pass
//! what they hit are shaded singly (`PathTracer::shade`). The scene and the path alone decide which, and a path never
//! depends on the others of its wavefront.

use core::ops::Range;
use core::sync::atomic::{AtomicBool, Ordering};

use specula_bsdf::math::Stream;
use specula_bsdf::{Rgb, Vec3};

use super::bound::BoundVertex;
use super::own_lobes::OwnLobes;
use super::path_states::PathStates;
use super::quadrics::VerticesOnQuadrics;
use super::sharing::{PairBuffers, Shared};
use super::vertex_batch::{self, Floats, VertexBatch, WAVEFRONT_SIZE, ZERO};
use super::{Path, PathTracer, Tally, portal_viewpoint};
use crate::accel::{Hit, Ray};
use crate::convert::id;
use crate::film::PixelSample;
use crate::geometry::NONE;
use crate::light;
use crate::options::Strategy;
use crate::prepared::PreparedScene;
use crate::sampler::{Purpose, Sampler};

/// A hit that is shaded in a batch.
struct QueuedVertex {
    /// Index among the live paths.
    at: u32,
    /// Twice the material, and one more where that is seen from the outside, or its sides are no materials of their
    /// own.
    key: u32,
}

/// Consecutive vertices of a batch with the same key.
pub(super) struct MaterialRun {
    from: usize,
    to: usize,
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
    pub(super) hits: Vec<Option<Hit>>,
    /// Those that continue from there.
    pub(super) next: Box<RayQueue>,
    /// Indices among the live paths, of rays without a hit.
    escaped: Vec<u32>,
    queued: Vec<QueuedVertex>,
    /// How many vertices are queued of each key, then where they begin.
    starts: Vec<u32>,
    pub(super) runs: Vec<MaterialRun>,
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

/// Indices of paths or vertices, each with a ray.
pub(super) struct RayQueue {
    indices: [u32; WAVEFRONT_SIZE],
    rays: [Ray; WAVEFRONT_SIZE],
    len: usize,
}

impl RayQueue {
    pub(super) fn new() -> Box<Self> {
        let nowhere = Ray {
            origin: Vec3::ZERO,
            direction: Vec3::Z,
            t_max: 0.0,
        };
        Box::new(Self {
            indices: [0; WAVEFRONT_SIZE],
            rays: [nowhere; WAVEFRONT_SIZE],
            len: 0,
        })
    }

    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    #[inline(always)]
    pub(super) fn push(&mut self, index: u32, ray: Ray) {
        let at = self.len % WAVEFRONT_SIZE;
        self.indices[at] = index;
        self.rays[at] = ray;
        self.len = at + 1;
    }

    pub(super) fn len(&self) -> usize {
        self.len.min(WAVEFRONT_SIZE)
    }

    /// The index of the path or vertex.
    #[inline(always)]
    pub(super) fn index(&self, k: usize) -> usize {
        index(self.indices[k % WAVEFRONT_SIZE])
    }

    #[inline(always)]
    pub(super) fn ray(&self, k: usize) -> &Ray {
        &self.rays[k % WAVEFRONT_SIZE]
    }

    pub(super) fn rays(&self) -> &[Ray] {
        &self.rays[..self.len()]
    }
}

/// An index below the wavefront's size, which needs no check of bounds.
#[inline(always)]
pub(super) fn index(i: u32) -> usize {
    i as usize % WAVEFRONT_SIZE
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
            hits: Vec::with_capacity(WAVEFRONT_SIZE),
            next: RayQueue::new(),
            escaped: Vec::new(),
            queued: Vec::new(),
            starts: Vec::new(),
            runs: Vec::new(),
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
        self.paths.load(0, *self.live.ray(0))
    }

    /// Whether the vertex before is the one that a path shares with others.
    ///
    /// * `k`: index among the live paths.
    fn is_at_y(&self, k: usize) -> bool {
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
                live.push(
                    id(i),
                    Ray {
                        origin,
                        direction,
                        t_max,
                    },
                );
            }
            return;
        }
        camera.rays(
            [&x[..n], &y[..n]],
            [&lens_x[..n], &lens_y[..n]],
            |i, ray| live.push(id(i), ray),
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
    fn goes_beyond_hits(&self, depth: u32) -> bool {
        let scene = self.scene;
        let hides = scene.hide_emitters && depth == 0;
        scene.geometry.has_passable || scene.materials.has_boundaries() || hides
    }

    /// Whether a ray may go on beyond its first hit, or is absorbed on its way there.
    ///
    /// * `i`: index of the path.
    fn is_followed_alone(&self, paths: &PathStates, i: usize, hit: &Hit, depth: u32) -> bool {
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
    fn step_scalar(
        &self,
        wavefront: &mut Wavefront,
        k: usize,
        step: impl FnOnce(&mut Path) -> bool,
    ) {
        let i = wavefront.live.index(k);
        let mut path = wavefront.paths.load(i, *wavefront.live.ray(k));
        if step(&mut path) {
            wavefront.next.push(id(i), path.ray);
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
        geometry.accel.intersect_all_at(live.rays(), time, hits);
        wavefront.tally.rays += wavefront.live.len() as u64;
        wavefront.queued.clear();
        wavefront.escaped.clear();
        let some_go_alone = self.goes_beyond_hits(depth);
        for k in 0..wavefront.live.len() {
            let Some(hit) = wavefront.hits[k] else {
                wavefront.escaped.push(id(k));
                continue;
            };
            if some_go_alone {
                let i = wavefront.live.index(k);
                if self.is_followed_alone(&wavefront.paths, i, &hit, depth) {
                    // The step counts its rays.
                    wavefront.tally.rays -= 1;
                    self.step_scalar(wavefront, k, |path| self.step(path, depth));
                    continue;
                }
            }
            let ray = wavefront.live.ray(k);
            match self.material_key(&wavefront.paths, wavefront.live.index(k), ray, &hit) {
                Some((key, emits)) => {
                    if emits {
                        self.add_emission(wavefront, k, &hit, depth);
                    }
                    if depth < self.max_depth {
                        wavefront.queued.push(QueuedVertex { at: id(k), key });
                    }
                }
                None => {
                    let time = wavefront.paths.times[wavefront.live.index(k)];
                    let surface = geometry.surface(ray, &hit, time);
                    if wavefront.is_at_y(k) {
                        self.add_emission(wavefront, k, &hit, depth);
                        self.step_scalar(wavefront, k, |path| {
                            self.shade_surface(path, surface, depth)
                        });
                    } else {
                        self.step_scalar(wavefront, k, |path| {
                            self.shade(path, Some(surface), depth)
                        });
                    }
                }
            }
        }
        self.add_background(wavefront, depth);
        if !wavefront.queued.is_empty() {
            self.sort_by_material(wavefront);
            self.shade_batch(wavefront, depth);
        }
    }

    /// Adds the emission of the surface that the ray of a live path hit.
    #[inline(never)]
    fn add_emission(&self, wavefront: &mut Wavefront, k: usize, hit: &Hit, depth: u32) {
        let ray = wavefront.live.ray(k);
        let i = wavefront.live.index(k);
        let time = wavefront.paths.times[i];
        let surface = self.scene.geometry.surface(ray, hit, time);
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
            .map(|&k| (k as usize, live.ray(k as usize).direction));
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
                let from = portal_viewpoint(paths.previous(live.index(k)).as_ref(), ray);
                for (radiance, pdf) in lights.arriving_through_portals(from, ray.direction) {
                    add(paths, k, radiance, pdf);
                }
            }
        }
    }

    /// The material key of a surface, and whether it may emit; `None`: it is shaded singly.
    ///
    /// * `i`: index of the path.
    #[inline(always)]
    fn material_key(
        &self,
        paths: &PathStates,
        i: usize,
        ray: &Ray,
        hit: &Hit,
    ) -> Option<(u32, bool)> {
        let rough = paths.rough[i];
        let geometry = &self.scene.geometry;
        let group = geometry.group_of(hit);
        let shape = group.shape_of[hit.primitive as usize];
        let (material, is_sided) = self.scene.batch_material(shape, rough)?;
        let outside = !is_sided || self.hits_outside(ray, hit, || paths.times[i]);
        let emits = group.light_of(hit.primitive) != NONE;
        Some((2 * material + u32::from(outside), emits))
    }

    /// Whether a ray hits the outside of a surface.
    ///
    /// * `time`: of the path.
    fn hits_outside(&self, ray: &Ray, hit: &Hit, time: impl FnOnce() -> f32) -> bool {
        let geometry = &self.scene.geometry;
        let normal = if let Some(facet) = geometry.facet(hit) {
            vertex_batch::normal(facet.corners.map(|&c| Vec3::from(c)))
        } else if let Some(at) = geometry.quadric(hit) {
            let near = ray.origin + ray.direction * hit.t;
            return (geometry.placed_quadric(at)).is_met_outside(near, ray.direction);
        } else {
            geometry.surface(ray, hit, time()).ng
        };
        normal.dot(ray.direction) < 0.0
    }

    /// Sorts the queued vertices by key into material runs.
    ///
    /// Even a single vertex is a run: its values must not depend on other vertices.
    fn sort_by_material(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            queued,
            starts,
            runs,
            batch,
            ..
        } = wavefront;
        starts.clear();
        starts.resize(2 * self.scene.materials.count(), 0);
        for vertex in queued.iter() {
            starts[vertex.key as usize] += 1;
        }
        runs.clear();
        let mut at = 0;
        for (key, count) in (0..).zip(starts.iter_mut()) {
            let to = at + *count as usize;
            if *count > 0 {
                runs.push(MaterialRun {
                    from: at,
                    to,
                    key,
                    first_bound: 0,
                });
            }
            *count = id(at);
            at = to;
        }
        batch.count = at;
        for vertex in queued.iter() {
            let place = &mut starts[vertex.key as usize];
            batch.live_indices[index(*place)] = vertex.at;
            *place += 1;
        }
    }
}

#[cfg(test)]
mod tests;
