//! Many paths in step, vertex by vertex.
//!
//! Of the surfaces that the paths of a wavefront meet, those with constant materials are sorted by material
//! and dealt with in batch (`shade`); the rest goes the scalar way (`PathTracer::meet`). Which way a
//! vertex goes is a matter of the scene alone, and a path never depends on the others of its wavefront.

use core::sync::atomic::{AtomicBool, Ordering};

use specula_bsdf::Vec3;
use specula_bsdf::math::Stream;

use super::path_states::PathStates;
use super::sharing::{Shared, Work};
use super::vertex_batch::{self, Column, VertexBatch, WAVEFRONT_SIZE, ZERO};
use super::{Path, PathTracer, Tally};
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
    /// Twice the material, and one more where that is seen from the outside or may be seen from either
    /// side.
    key: u32,
}

/// Consecutive vertices of a batch with the same key.
pub(super) struct MaterialRun {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) key: u32,
}

/// The paths of a wavefront, and their buffers.
pub(crate) struct Wavefront {
    pub(super) paths: Box<PathStates>,
    /// Filter weights of the samples.
    weights: Column,
    /// What was counted since it was taken last.
    pub(super) tally: Tally,
    /// The live paths, and the hits of their rays.
    pub(super) live: Box<Queue>,
    pub(super) hits: Vec<Option<Hit>>,
    /// Those that continue from there.
    pub(super) next: Box<Queue>,
    /// Indices among the live paths, of rays without a hit.
    escaped: Vec<u32>,
    waiting: Vec<QueuedVertex>,
    /// How many wait of each key, then where they begin.
    starts: Vec<u32>,
    pub(super) runs: Vec<MaterialRun>,
    pub(super) batch: Box<VertexBatch>,
    pub(super) streams: Vec<Stream>,
    /// Shadow rays, with the indices of their vertices.
    pub(super) shadows: Box<Queue>,
    /// Whether they are occluded.
    pub(super) blocked: Vec<bool>,
    pub(super) lights: Box<light::Waiting>,
    /// Where paths share.
    pub(super) shared: Option<Box<Shared>>,
    pub(super) pairs: Option<Box<Work>>,
}

/// Indices of paths or vertices, each with a ray.
pub(super) struct Queue {
    indices: [u32; WAVEFRONT_SIZE],
    rays: [Ray; WAVEFRONT_SIZE],
    len: usize,
}

impl Queue {
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
    pub(super) fn push(&mut self, number: u32, ray: Ray) {
        let at = self.len % WAVEFRONT_SIZE;
        self.indices[at] = number;
        self.rays[at] = ray;
        self.len = at + 1;
    }

    pub(super) fn len(&self) -> usize {
        self.len.min(WAVEFRONT_SIZE)
    }

    /// The number at a place, as an index.
    #[inline(always)]
    pub(super) fn number(&self, k: usize) -> usize {
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

/// A path's number as an index that needs no check.
#[inline(always)]
pub(super) fn index(number: u32) -> usize {
    number as usize % WAVEFRONT_SIZE
}

impl Wavefront {
    /// Most paths of a wavefront.
    pub(crate) const SIZE: usize = WAVEFRONT_SIZE;

    /// An empty one.
    pub(crate) fn new() -> Self {
        Self {
            paths: PathStates::new(),
            weights: ZERO,
            tally: Tally::default(),
            live: Queue::new(),
            hits: Vec::with_capacity(WAVEFRONT_SIZE),
            next: Queue::new(),
            escaped: Vec::new(),
            waiting: Vec::new(),
            starts: Vec::new(),
            runs: Vec::new(),
            batch: VertexBatch::new(),
            streams: Vec::new(),
            shadows: Queue::new(),
            blocked: Vec::new(),
            lights: light::Waiting::new(),
            shared: None,
            pairs: None,
        }
    }

    /// What the path of a sample contributed, and the sample's weight, before the film has developed it.
    #[inline(always)]
    pub(crate) fn seen(&self, i: usize) -> (PixelSample, f32) {
        (self.paths.seen(i), self.weights[i])
    }

    /// The first path, which has just begun.
    pub(super) fn first(&self) -> Path {
        self.paths.take(0, *self.live.ray(0))
    }

    /// Whether the vertex before was what a path shares with others; `k`: among those that live.
    fn is_at_y(&self, k: usize) -> bool {
        let number = self.live.number(k);
        (self.shared.as_ref()).is_some_and(|shared| shared.is_at_y(number))
    }

    /// What was counted since this was asked last.
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
            live,
            batch,
            shared,
            pairs,
            ..
        } = wavefront;
        if self.shares {
            shared.get_or_insert_with(Shared::new).begin();
            pairs.get_or_insert_with(|| Box::new(Work::new()));
        }
        let VertexBatch {
            random_numbers,
            raster,
            ..
        } = &mut **batch;
        let mut n = 0;
        for (i, (pixel, sampler)) in samples.take(WAVEFRONT_SIZE).enumerate() {
            paths.samplers[i] = sampler;
            random_numbers.place(i, &sampler);
            raster[0][i] = pixel[0] as f32 + 0.5;
            raster[1][i] = pixel[1] as f32 + 0.5;
            n = i + 1;
        }
        paths.begin(n, materials.has_boundaries(), self.bound);
        random_numbers.draw(n, Purpose::Camera, 0);
        let [lens_x, filter_x, filter_y, lens_y] = &random_numbers.values;
        let [x, y] = raster;
        filter.sample_all(
            [&filter_x[..n], &filter_y[..n]],
            [&mut x[..n], &mut y[..n]],
            &mut weights[..n],
        );
        live.clear();
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
    /// * `stop`: looked at before every vertex.
    pub(crate) fn follow_until(&self, wavefront: &mut Wavefront, stop: &AtomicBool) -> bool {
        let mut depth = 0;
        while wavefront.live.len() > 0 {
            if stop.load(Ordering::Relaxed) {
                return false;
            }
            wavefront.next.clear();
            if self.uses_batches(depth) {
                self.meet_all(wavefront, depth);
            } else {
                for k in 0..wavefront.live.len() {
                    self.alone(wavefront, k, |path| self.step(path, depth));
                }
            }
            std::mem::swap(&mut wavefront.live, &mut wavefront.next);
            depth += 1;
        }
        true
    }

    /// Whether rays stop at what they meet.
    fn uses_batches(&self, depth: u32) -> bool {
        let hides = self.scene.hide_emitters && depth == 0;
        let straight = !self.scene.geometry.has_passable && !hides;
        straight
            && !self.scene.materials.has_boundaries()
            && self.strategy == Strategy::Mis
            && self.max_depth > 0
    }

    /// Takes one path a step by itself.
    ///
    /// * `step`: whether it goes on.
    fn alone(&self, wavefront: &mut Wavefront, k: usize, step: impl FnOnce(&mut Path) -> bool) {
        let number = wavefront.live.number(k);
        let mut path = wavefront.paths.take(number, *wavefront.live.ray(k));
        if step(&mut path) {
            wavefront.next.push(id(number), path.ray);
        }
        wavefront.tally = wavefront.tally.and(wavefront.paths.put(number, &path));
        if let Some(shared) = &mut wavefront.shared {
            shared.pass_alone(number);
        }
    }

    /// Takes all paths from one vertex to the next.
    fn meet_all(&self, wavefront: &mut Wavefront, depth: u32) {
        let geometry = &self.scene.geometry;
        geometry
            .accel
            .intersect_all(wavefront.live.rays(), &mut wavefront.hits);
        wavefront.tally.rays += wavefront.live.len() as u64;
        wavefront.waiting.clear();
        wavefront.escaped.clear();
        for k in 0..wavefront.live.len() {
            let Some(hit) = wavefront.hits[k] else {
                wavefront.escaped.push(id(k));
                continue;
            };
            let ray = wavefront.live.ray(k);
            let rough = wavefront.paths.rough[wavefront.live.number(k)];
            match self.key(ray, &hit, rough) {
                Some((key, sends_light)) => {
                    if sends_light {
                        self.add_emission_of(wavefront, k, &hit, depth);
                    }
                    if depth < self.max_depth {
                        wavefront.waiting.push(QueuedVertex { at: id(k), key });
                    }
                }
                None => {
                    let surface = geometry.surface(ray, &hit);
                    if wavefront.is_at_y(k) {
                        self.add_emission_of(wavefront, k, &hit, depth);
                        self.alone(wavefront, k, |path| self.pass_on(path, surface, depth));
                    } else {
                        self.alone(wavefront, k, |path| self.meet(path, Some(surface), depth));
                    }
                }
            }
        }
        self.add_background_of(wavefront, depth);
        if !wavefront.waiting.is_empty() {
            self.sort(wavefront);
            self.shade_batch(wavefront, depth);
        }
    }

    /// Light that a surface sends out along the ray of a path that lives.
    #[inline(never)]
    fn add_emission_of(&self, wavefront: &mut Wavefront, k: usize, hit: &Hit, depth: u32) {
        let ray = wavefront.live.ray(k);
        let surface = self.scene.geometry.surface(ray, hit);
        let number = wavefront.live.number(k);
        let previous = wavefront.paths.previous(number);
        if let (Some(shared), Some(previous)) = (&mut wavefront.shared, previous)
            && shared.is_at_y(number)
        {
            let radiance = self.emission(None, &surface, ray.direction);
            let lights = &self.scene.lights;
            let light_pdf = lights.pdf_of_surface(&previous.receiver, &surface);
            shared.meet(number, radiance, light_pdf);
            return;
        }
        let radiance = self.emission(previous, &surface, ray.direction);
        let throughput = wavefront.paths.throughput.colour(number);
        wavefront.paths.add(number, throughput * radiance, depth);
    }

    /// Light from infinity on the rays that meet nothing.
    fn add_background_of(&self, wavefront: &mut Wavefront, depth: u32) {
        if wavefront.escaped.is_empty() {
            return;
        }
        let Wavefront {
            paths,
            live,
            escaped,
            lights: waiting,
            shared,
            ..
        } = wavefront;
        let lights = &self.scene.lights;
        let directions = escaped
            .iter()
            .map(|&k| (k as usize, live.ray(k as usize).direction));
        lights.arriving_from_infinity_all(waiting, directions, |k, radiance, pdf| {
            let number = live.number(k);
            if paths.straight[number] && self.scene.hide_emitters {
                return;
            }
            let previous = paths.previous(number);
            if let (Some(shared), Some(previous)) = (&mut *shared, previous)
                && shared.is_at_y(number)
            {
                let share = paths.share_from_infinity(number, lights, &previous.receiver);
                shared.meet(number, radiance, share * pdf);
                return;
            }
            let weight = self.lobe_weight(previous, |receiver| {
                paths.share_from_infinity(number, lights, receiver) * pdf
            });
            let throughput = paths.throughput.colour(number);
            paths.add(number, throughput * radiance * weight, depth);
        });
    }

    /// The key of a surface for batches, and whether it sends out light.
    ///
    /// * `rough`: as of `State`.
    #[inline(always)]
    fn key(&self, ray: &Ray, hit: &Hit, rough: bool) -> Option<(u32, bool)> {
        let geometry = &self.scene.geometry;
        let group = geometry.group_of(hit);
        let shape = group.shape_of[hit.primitive as usize];
        let (material, is_sided) = self.scene.lanes_of(shape, rough)?;
        let outside = !is_sided || self.meets_outside(ray, hit);
        let sends_light = group.light_of(hit.primitive) != NONE;
        Some((2 * material + u32::from(outside), sends_light))
    }

    fn meets_outside(&self, ray: &Ray, hit: &Hit) -> bool {
        let geometry = &self.scene.geometry;
        let normal = if let Some(facet) = geometry.facet(hit) {
            vertex_batch::normal(facet.corners.map(|&c| Vec3::from(c)))
        } else if let Some([_, _, normal, _]) = geometry.quadric(ray, hit) {
            normal
        } else {
            geometry.surface(ray, hit).ng
        };
        normal.dot(ray.direction) < 0.0
    }

    /// Sorts what waits by key into runs of batch.
    ///
    /// Even a lone vertex is a run: its values must not depend on other vertices.
    fn sort(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            waiting,
            starts,
            runs,
            batch,
            ..
        } = wavefront;
        starts.clear();
        starts.resize(2 * self.scene.materials.count(), 0);
        for w in waiting.iter() {
            starts[w.key as usize] += 1;
        }
        runs.clear();
        let mut at = 0;
        for (key, count) in (0..).zip(starts.iter_mut()) {
            let to = at + *count as usize;
            if *count > 0 {
                runs.push(MaterialRun { from: at, to, key });
            }
            *count = id(at);
            at = to;
        }
        batch.count = at;
        for w in waiting.iter() {
            let place = &mut starts[w.key as usize];
            batch.places[index(*place)] = w.at;
            *place += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::RenderOptions;

    /// What paths bring in wavefronts and one by one.
    fn both_ways(
        scene: &specula_scene::Scene,
        biased: bool,
    ) -> (PreparedScene, Vec<[PixelSample; 2]>) {
        let options = RenderOptions {
            max_depth: 6,
            resolution: Some([64, 48]),
            clamp: biased.then_some(0.3),
            regularize: biased,
            ..RenderOptions::default()
        };
        let prepared = PreparedScene::new(scene, &options).unwrap();
        let tracer = PathTracer::new(&prepared, &options);
        let sample = |i: u32| {
            let pixel = [i % 64, i / 64];
            (pixel, Sampler::new(pixel, 3, 5))
        };
        let (mut wavefront, mut lone) = (Wavefront::new(), Wavefront::new());
        let mut found = Vec::new();
        for first in (0..64 * 48).step_by(Wavefront::SIZE) {
            let indices = first..first + id(Wavefront::SIZE);
            tracer.begin(&mut wavefront, indices.clone().map(sample));
            tracer.follow_all(&mut wavefront);
            assert!(wavefront.take_tally().rays > 0);
            for (k, i) in indices.enumerate() {
                tracer.begin(&mut lone, std::iter::once(sample(i)));
                let mut path = lone.first();
                tracer.follow(&mut path);
                lone.paths.put(0, &path);
                found.push([
                    tracer.contribution(&wavefront, k).0,
                    tracer.contribution(&lone, 0).0,
                ]);
            }
        }
        (prepared, found)
    }

    /// Paths in a wavefront are those traced one by one, up to rounding, which now and then sends one elsewhere.
    #[test]
    fn paths_in_blocks_are_paths_alone() {
        let metal = "conductor Au alpha 0.3";
        let brushed = "conductor Cu alpha 0.05 0.4";
        let coated = ["coateddiffuse 0.6 alpha 0.2", "dielectric 1.5"];
        for (texts, biased) in [
            ([metal, "diffuse 0.5"], false),
            ([brushed, "conductor 0.9"], false),
            (coated, false),
            (["dielectric 1.5 alpha 0.2", "diffuse 0.7"], false),
            ([brushed, "conductor 0.9"], true),
            (coated, true),
        ] {
            let mut scene = specula_scene::builtin::orbs();
            let kinds = texts.map(|t| specula_scene::material_text::parse_material(t).unwrap());
            let mut in_lanes = 0;
            for (i, material) in scene.materials.iter_mut().enumerate() {
                material.kind = kinds[i % 2];
            }
            let (prepared, found) = both_ways(&scene, biased);
            for material in 0..prepared.materials.count() {
                in_lanes += usize::from(prepared.materials.plain(id(material)).is_some());
            }
            assert!(in_lanes > 0, "{texts:?}");
            let apart = |[a, b]: &[PixelSample; 2]| {
                let scale = b.colour.max_channel().max(1e-3);
                let colour = (a.colour - b.colour).map(f32::abs).max_channel();
                colour > 1e-3 * scale
                    || (a.normal - b.normal).length() > 1e-4
                    || (a.albedo - b.albedo).map(f32::abs).max_channel() > 1e-6
                    || a.depth.is_some() != b.depth.is_some()
            };
            let count = found.iter().filter(|p| apart(p)).count();
            assert!(count * 50 < found.len(), "{texts:?}: {count}");
            let mean = |k: usize| found.iter().map(|p| p[k].colour.mean()).sum::<f32>();
            assert!((mean(0) / mean(1) - 1.0).abs() < 0.02, "{texts:?}");
        }
    }
}
