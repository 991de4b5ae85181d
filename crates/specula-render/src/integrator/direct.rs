//! Direct light at the vertices of a batch: light samples, their contributions, shadow rays.

use core::ops::Range;

use specula_bsdf::math::Stream;

use super::bound::{self, BoundVertex};
use super::ray_queue::index;
use super::shade::fill_streams;
use super::vertex_batch::{self, LightSamples, Surfaces, Vectors, VertexBatch, WAVEFRONT_SIZE};
use super::wavefront::{MaterialRun, Wavefront};
use super::{PathTracer, candidates, estimator};
use crate::accel::Ray;
use crate::convert::id;
use crate::material::{Plain, lobes};
use crate::medium_stack::MediumStack;
use crate::sampler::Purpose;

impl PathTracer<'_> {
    /// Adds direct light from one light sample to each path.
    pub(super) fn light_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        wavefront
            .batch
            .random_numbers
            .generate(wavefront.batch.count, Purpose::Light, depth);
        let plain = self.runs_with_two_candidates(&wavefront.runs, depth).next();
        let twice = plain.is_some() || wavefront.bound.iter().any(|vertex| vertex.lights == 2);
        if twice {
            self.split_random_numbers(wavefront, depth);
        }
        self.sample_candidates(wavefront, depth, 0);
        if twice {
            self.sample_candidates(wavefront, depth, 1);
            self.choose_candidates(wavefront, depth);
        }
        let batch = &mut *wavefront.batch;
        vertex_batch::shadow_rays(batch.count, &batch.surfaces, &mut batch.light_samples);
        self.trace_shadow_rays(wavefront, depth);
    }

    /// The runs of plain materials at whose vertices two lights are sampled.
    fn runs_with_two_candidates<'s>(
        &'s self,
        runs: &'s [MaterialRun],
        depth: u32,
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        let two = move |plain: &Plain| self.light_candidates(&plain.lobe, depth) == 2;
        self.material_runs(runs)
            .filter(move |(plain, _)| two(plain))
    }

    /// The vertices whose lobes are bound, at which two lights are sampled.
    fn bound_with_two_candidates<'s>(
        &'s self,
        runs: &'s [MaterialRun],
        bound: &'s [BoundVertex],
    ) -> impl Iterator<Item = usize> {
        let vertices = self.bound_runs(runs).flat_map(|run| run.bound(bound));
        vertices.filter_map(|(i, vertex)| (vertex.lights == 2).then_some(i))
    }

    /// Makes random numbers for two lights from those for one, where two are sampled.
    fn split_random_numbers(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            runs, batch, bound, ..
        } = wavefront;
        let VertexBatch {
            random_numbers,
            second_random_numbers,
            ..
        } = &mut **batch;
        let first_numbers = &mut random_numbers.values;
        let plain = self.runs_with_two_candidates(runs, depth);
        let of_bound = self.bound_with_two_candidates(runs, bound);
        for i in plain.flat_map(|(_, range)| range).chain(of_bound) {
            let u = [0, 1, 2, 3].map(|k| first_numbers[k][i]);
            for (to, nth) in [(&mut *first_numbers, 0), (second_random_numbers, 1)] {
                let u = estimator::candidate_random_numbers(u, nth, 2);
                for k in 0..4 {
                    to[k][i] = u[k];
                }
            }
        }
    }

    /// Chooses one of two light candidates.
    fn choose_candidates(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            runs,
            batch,
            bound,
            ..
        } = wavefront;
        let VertexBatch {
            light_samples,
            second_light_samples,
            second_random_numbers: [choices, ..],
            path_indices,
            ..
        } = &mut **batch;
        let plain = self.runs_with_two_candidates(runs, depth);
        let of_bound = self.bound_with_two_candidates(runs, bound);
        for range in plain
            .map(|(_, range)| range)
            .chain(of_bound.map(|i| i..i + 1))
        {
            for i in range.clone() {
                choices[i] =
                    candidates::random_number(&paths.samplers[index(path_indices[i])], depth);
            }
            vertex_batch::choose_candidates(
                range.start,
                range.end,
                choices,
                light_samples,
                second_light_samples,
            );
        }
    }

    /// Samples a light for each vertex, and computes its contribution should nothing occlude it.
    ///
    /// * `nth`: 1 for the second of two candidates, else 0.
    fn sample_candidates(&self, wavefront: &mut Wavefront, depth: u32, nth: u32) {
        self.sample_lights(wavefront, depth, nth);
        let Wavefront {
            paths,
            runs,
            batch,
            bound,
            own_lobes,
            streams,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            light_samples,
            second_light_samples,
            scatter_samples: scatter,
            path_indices,
            reflectance,
            base,
            ..
        } = &mut **batch;
        let a = if nth == 0 {
            light_samples
        } else {
            second_light_samples
        };
        for (plain, range) in self.material_runs(runs) {
            let (from, to) = (range.start, range.end);
            let count = self.light_candidates(&plain.lobe, depth);
            if nth >= count {
                continue;
            }
            if plain.specular {
                a.contribution.fill(range, 0.0);
                continue;
            }
            for i in range {
                let black = plain.black_inside && s.side[i] < 0.0;
                a.pdf[i] *= if black { 0.0 } else { count as f32 };
            }
            vertex_batch::lights_to_local(from, to, s, a);
            let purpose = estimator::stream_of_candidate(nth);
            if plain.is_batched {
                let vertices = &path_indices[from..to];
                fill_streams(paths, vertices, plain, (depth, purpose), streams);
                evaluate_plain(plain, from..to, (s, [reflectance, base]), streams, a);
            } else {
                let stream =
                    |i: usize| paths.samplers[index(path_indices[i])].stream(depth, purpose);
                bound::evaluate_run(&plain.lobe, from..to, s, a, stream);
            }
            vertex_batch::light_contributions(from, to, &scatter.throughput, a);
        }
        self.evaluate_bound(
            (paths, &path_indices[..]),
            (runs, bound, own_lobes),
            (s, &scatter.throughput),
            a,
            [depth, nth],
        );
    }

    /// Samples a light for each vertex.
    fn sample_lights(&self, wavefront: &mut Wavefront, depth: u32, nth: u32) {
        let Wavefront {
            runs,
            batch,
            bound,
            lights,
            ..
        } = wavefront;
        let n = batch.count;
        let scene = self.scene;
        let VertexBatch {
            surfaces: s,
            light_samples,
            second_light_samples,
            share_from_infinity,
            random_numbers,
            second_random_numbers,
            ..
        } = &mut **batch;
        let (random_numbers, a) = match nth {
            0 => (&random_numbers.values, light_samples),
            _ => (&*second_random_numbers, second_light_samples),
        };
        if let Some(light) = scene.lights.lone_parallelogram() {
            let [_, u, v, _] = random_numbers;
            vertex_batch::sample_parallelogram(n, light, [u, v], s, a);
            return;
        }
        let world = (&scene.geometry, &scene.textures);
        let is_lit =
            |plain: &Plain| !plain.specular && self.light_candidates(&plain.lobe, depth) > nth;
        let receivers = self
            .material_runs(runs)
            .filter(|(plain, _)| is_lit(plain))
            .flat_map(|(plain, range)| range.map(move |i| (i, plain)))
            .map(|(i, plain)| (i, s.receiver(i, plain.opaque)));
        let of_bound = self
            .bound_runs(runs)
            .flat_map(|run| run.bound(bound))
            .filter(|(_, vertex)| vertex.lights > nth)
            .map(|(i, vertex)| (i, vertex.receiver(s, i)));
        let u = [0, 1, 2, 3].map(|k| &random_numbers[k][..]);
        let store = |i, light| a.set(i, light);
        (scene.lights).sample_all(
            lights,
            receivers.chain(of_bound),
            world,
            u,
            &mut share_from_infinity[..],
            store,
        );
    }

    /// Traces shadow rays, and adds the contributions that are not occluded.
    fn trace_shadow_rays(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            batch,
            shadow_rays,
            occluded,
            tally,
            shared,
            ..
        } = wavefront;
        let a = &batch.light_samples;
        shadow_rays.clear();
        for i in 0..WAVEFRONT_SIZE.min(batch.count) {
            if a.contribution.colour(i).is_black() {
                continue;
            }
            let ray = Ray {
                origin: a.origin.get(i),
                direction: a.direction.get(i),
                t_max: if a.is_infinite[i] {
                    f32::INFINITY
                } else {
                    estimator::SHADOW_RAY_END
                },
            };
            shadow_rays.push(id(i), &ray);
        }
        let accel = &self.scene.geometry.accel;
        let time = |k| paths.times[index(batch.path_indices[shadow_rays.index(k)])];
        accel.occluded_block_at(shadow_rays.rays(), time, occluded);
        tally.rays += shadow_rays.len() as u64;
        for (k, &is_occluded) in occluded.iter().enumerate() {
            let i = shadow_rays.index(k);
            let path = index(batch.path_indices[i]);
            let mut contribution = a.contribution.colour(i);
            if is_occluded {
                if !self.scene.geometry.has_passable {
                    continue;
                }
                // What is in the way may let it pass. It counts its rays.
                tally.rays -= 1;
                let ray = shadow_rays.ray(k);
                let end = (!a.is_infinite[i]).then(|| a.target.get(i));
                let way = (batch.surfaces.position.get(i), end);
                let by_chance = (&paths.samplers[path], depth);
                let rays = &mut tally.rays;
                let none = MediumStack::NONE;
                match self.transmittance_through(ray, way, none, by_chance, rays) {
                    Some(transmittance) => contribution *= transmittance,
                    None => continue,
                }
            }
            match shared {
                Some(shared) if shared.is_at_y(path) => shared.store_light(path, batch, i),
                _ => paths.add(path, contribution, depth + 1),
            }
        }
    }
}

/// Evaluates the lobe of a plain material towards the light samples of a run of vertices.
///
/// * `colours`: reflectances, and those of bases with all bounces.
fn evaluate_plain(
    plain: &Plain,
    range: Range<usize>,
    (s, [reflectance, base]): (&Surfaces, [&Vectors; 2]),
    streams: &mut [Stream],
    a: &mut LightSamples,
) {
    let (from, to) = (range.start, range.end);
    let (wo, wi) = (s.wo.directions(from..to), a.wi.directions(from..to));
    let (f_cos, pdf) = (a.f_cos.colours_mut(from..to), &mut a.lobe_pdf[from..to]);
    if plain.coat.is_some() {
        let bases = lobes::Bases {
            albedo: reflectance.colours(from..to),
            base: base.colours(from..to),
        };
        lobes::eval_pdf_over((&plain.lobe, bases), wo, wi, f_cos, pdf);
        return;
    }
    lobes::eval_pdf(&plain.lobe, wo, wi, streams, f_cos, pdf);
    if plain.reflectance.is_some() {
        vertex_batch::scale_values(from, to, reflectance, &mut a.f_cos);
    }
}
