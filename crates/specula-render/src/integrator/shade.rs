//! Shading of the vertices of a wavefront that form a batch: from hits to surfaces, direct light and new rays.

use core::ops::Range;

use specula_bsdf::batch::SampleOutcome;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Vec3};

use super::path_states::PathStates;
use super::vertex_batch::{self, VertexBatch, WAVEFRONT_SIZE};
use super::wavefront::{MaterialRun, Wavefront, index};
use super::{PathTracer, candidates, estimator};
use crate::accel::{Hit, Ray};
use crate::convert::id;
use crate::material::{Plain, lobes};
use crate::medium_stack::MediumStack;
use crate::sampler::Purpose;

impl PathTracer<'_> {
    /// Takes the paths of the batch from this vertex to the next.
    pub(super) fn shade_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        self.load_vertices(wavefront);
        let batch = &mut *wavefront.batch;
        let n = batch.count;
        vertex_batch::interpolate_triangles(n, &batch.triangles, &mut batch.surfaces);
        vertex_batch::face_viewers(n, &mut batch.surfaces);
        for (plain, range) in self.material_runs(&wavefront.runs) {
            if plain.specular {
                vertex_batch::use_geometric_normals(range.start, range.end, &mut batch.surfaces);
            }
        }
        if depth == 0 {
            self.store_first_hits(wavefront);
        }
        self.record_shared_vertices(wavefront);
        self.light_batch(wavefront, depth);
        self.scatter_batch(wavefront, depth);
    }

    /// Stores albedo, normal and depth of the first vertices.
    fn store_first_hits(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            paths,
            live,
            runs,
            batch,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            path_indices,
            live_indices,
            ..
        } = &**batch;
        for (plain, range) in self.material_runs(runs) {
            let albedo = plain.lobe.albedo();
            for i in range {
                let path = index(path_indices[i]);
                if !(plain.black_inside && s.side[i] < 0.0) {
                    paths.first.albedo.set_colour(path, albedo);
                }
                paths.first.normal.set(path, s.ns.get(i));
                let ray = live.ray(live_indices[i] as usize);
                paths.first.depth[path] = (s.position.get(i) - ray.origin).length();
            }
        }
    }

    /// The material runs of the batch: materials with ranges of vertices.
    fn material_runs<'s>(
        &'s self,
        runs: &'s [MaterialRun],
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        runs.iter().filter_map(|s| {
            let sides = self.scene.materials.plain(s.key / 2)?;
            Some((
                &sides[(s.key % 2) as usize],
                s.from..s.to.min(WAVEFRONT_SIZE),
            ))
        })
    }

    /// Loads the vertices, sorted by material, into the batch.
    fn load_vertices(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            paths,
            live,
            hits,
            runs,
            batch,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            scatter_samples: scatter,
            random_numbers,
            path_indices,
            live_indices,
            count,
            ..
        } = &mut **batch;
        for i in 0..WAVEFRONT_SIZE.min(*count) {
            let k = live_indices[i] as usize;
            let (path, ray) = (live.index(k), live.ray(k));
            path_indices[i] = id(path);
            random_numbers.set(i, &paths.samplers[path]);
            s.wo_world.set(i, -ray.direction);
            scatter
                .throughput
                .set_colour(i, paths.throughput.colour(path));
            scatter.eta_scale[i] = paths.eta_scale[path];
        }
        for (plain, range) in self.material_runs(runs) {
            for i in range {
                let k = batch.live_indices[i] as usize;
                if let Some(hit) = &hits[k] {
                    let time = || paths.times[live.index(k)];
                    let ray = (live.ray(k), hit, time);
                    self.load_surface(batch, i, ray, !plain.isotropic);
                }
            }
        }
    }

    /// Loads the surface of one vertex.
    #[inline(always)]
    fn load_surface(
        &self,
        batch: &mut VertexBatch,
        i: usize,
        (ray, hit, time): (&Ray, &Hit, impl FnOnce() -> f32),
        needs_tangent: bool,
    ) {
        let geometry = &self.scene.geometry;
        let (t, s) = (&mut batch.triangles, &mut batch.surfaces);
        let mut tangent = Vec3::ZERO;
        if let Some(facet) = geometry.facet(hit) {
            for (c, v) in t.corners.iter_mut().zip(facet.corners) {
                c.set_array(i, v);
            }
            for (c, v) in t.normals.iter_mut().zip(facet.normals) {
                c.set_array(i, v);
            }
            t.weights[0][i] = hit.u;
            t.weights[1][i] = hit.v;
            t.is_triangle[i] = true;
            if needs_tangent {
                tangent = geometry.tangent(hit);
            }
        } else {
            let [position, error, ng, ns, along] = match geometry.quadric(ray, hit) {
                Some([position, error, normal, along]) => [position, error, normal, normal, along],
                None => {
                    let s = geometry.surface(ray, hit, time());
                    [s.position, s.error, s.ng, s.ns, s.tangent]
                }
            };
            t.is_triangle[i] = false;
            s.position.set(i, position);
            s.error[i] = error.x;
            s.ng.set(i, ng);
            s.ns.set(i, ns);
            if needs_tangent {
                tangent = along;
            }
        }
        s.tangent.set(i, tangent);
    }

    /// Adds direct light from one light sample to each path.
    fn light_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        wavefront
            .batch
            .random_numbers
            .generate(wavefront.batch.count, Purpose::Light, depth);
        let twice = self
            .runs_with_two_candidates(&wavefront.runs, depth)
            .next()
            .is_some();
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

    /// The material runs at whose vertices two lights are sampled.
    fn runs_with_two_candidates<'s>(
        &'s self,
        runs: &'s [MaterialRun],
        depth: u32,
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        let two = move |plain: &Plain| self.light_candidates(&plain.lobe, depth) == 2;
        self.material_runs(runs)
            .filter(move |(plain, _)| two(plain))
    }

    /// Makes random numbers for two lights from those for one, where two are sampled.
    fn split_random_numbers(&self, wavefront: &mut Wavefront, depth: u32) {
        let VertexBatch {
            random_numbers,
            second_random_numbers,
            ..
        } = &mut *wavefront.batch;
        let first_numbers = &mut random_numbers.values;
        for (_, range) in self.runs_with_two_candidates(&wavefront.runs, depth) {
            for i in range {
                let u = [0, 1, 2, 3].map(|k| first_numbers[k][i]);
                for (to, nth) in [(&mut *first_numbers, 0), (second_random_numbers, 1)] {
                    let u = estimator::candidate_random_numbers(u, nth, 2);
                    for k in 0..4 {
                        to[k][i] = u[k];
                    }
                }
            }
        }
    }

    /// Chooses one of two light candidates.
    fn choose_candidates(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths, runs, batch, ..
        } = wavefront;
        let VertexBatch {
            light_samples,
            second_light_samples,
            second_random_numbers: [choices, ..],
            path_indices,
            ..
        } = &mut **batch;
        for (_, range) in self.runs_with_two_candidates(runs, depth) {
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
            streams,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            light_samples,
            second_light_samples,
            scatter_samples: scatter,
            path_indices,
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
            fill_streams(
                paths,
                &path_indices[from..to],
                plain,
                (depth, purpose),
                streams,
            );
            lobes::eval_pdf(
                &plain.lobe,
                s.wo.directions(from..to),
                a.wi.directions(from..to),
                streams,
                a.f_cos.colours_mut(from..to),
                &mut a.lobe_pdf[from..to],
            );
            vertex_batch::light_contributions(from, to, &scatter.throughput, a);
        }
    }

    /// Samples a light for each vertex.
    fn sample_lights(&self, wavefront: &mut Wavefront, depth: u32, nth: u32) {
        let Wavefront {
            runs,
            batch,
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
            .map(|(i, plain)| (i, s.receiver(i, plain)));
        let u = [0, 1, 2, 3].map(|k| &random_numbers[k][..]);
        let store = |i, light| a.set(i, light);
        (scene.lights).sample_all(
            lights,
            receivers,
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
            shadow_rays.push(id(i), ray);
        }
        let accel = &self.scene.geometry.accel;
        let time = |k| paths.times[index(batch.path_indices[shadow_rays.index(k)])];
        accel.occluded_all_at(shadow_rays.rays(), time, occluded);
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
                let ray = *shadow_rays.ray(k);
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

    /// Samples the next direction of each path.
    fn scatter_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            runs,
            batch,
            streams,
            tally,
            shared,
            ..
        } = wavefront;
        let n = batch.count;
        batch.random_numbers.generate(n, Purpose::Scatter, depth);
        let VertexBatch {
            surfaces: s,
            scatter_samples: scatter,
            random_numbers,
            path_indices,
            ..
        } = &mut **batch;
        for (plain, range) in self.material_runs(runs) {
            let (from, to) = (range.start, range.end);
            fill_streams(
                paths,
                &path_indices[from..to],
                plain,
                (depth, estimator::STREAM_SCATTER),
                streams,
            );
            let u = [0, 1, 2].map(|k| &random_numbers.values[k][from..to]);
            let samples = specula_bsdf::batch::Samples {
                wi: scatter.wi.directions_mut(from..to),
                weight: scatter.weight.colours_mut(from..to),
                pdf: &mut scatter.pdf[from..to],
                outcome: &mut scatter.outcome[from..to],
            };
            lobes::sample(&plain.lobe, s.wo.directions(from..to), u, streams, samples);
            let sides = plain.black_inside.then(|| &s.side[from..to]);
            let scattered = vertex_batch::count_scattered(&scatter.outcome[from..to], sides);
            tally.scattered = tally.scattered.and(scattered);
            for i in range.filter(|_| !plain.opaque) {
                if matches!(
                    scatter.outcome[i],
                    SampleOutcome::Transmission | SampleOutcome::SpecularTransmission
                ) {
                    scatter.eta_scale[i] =
                        estimator::eta_scale_after(scatter.eta_scale[i], plain.eta);
                }
            }
        }
        if let Some(shared) = shared {
            let n = n.min(WAVEFRONT_SIZE);
            shared.disable_roulette_at_x(&path_indices[..n], &mut random_numbers.values[3][..n]);
        }
        vertex_batch::scatter(n, depth, s, &random_numbers.values[3], scatter);
        self.continue_paths(wavefront, depth);
    }

    /// Stores the paths that continue, with their rays.
    fn continue_paths(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            live,
            hits,
            next,
            runs,
            batch,
            shared,
            ..
        } = wavefront;
        let (s, scatter) = (&batch.surfaces, &batch.scatter_samples);
        for (plain, range) in self.material_runs(runs) {
            for i in range {
                if !scatter.alive[i] || (plain.black_inside && s.side[i] < 0.0) {
                    continue;
                }
                let path_index = batch.path_indices[i];
                let path = index(path_index);
                let ray = Ray {
                    origin: scatter.origin.get(i),
                    direction: scatter.direction.get(i),
                    t_max: f32::INFINITY,
                };
                next.push(path_index, ray);
                let mut throughput = scatter.throughput.colour(i);
                if let Some(shared) = shared {
                    if shared.is_at_y(path) {
                        shared.store_direction(path, batch, i);
                    }
                    let from_x = shared.throughput_from_x(path, scatter.weight.colour(i));
                    throughput = from_x.unwrap_or(throughput);
                }
                paths.throughput.set_colour(path, throughput);
                paths.eta_scale[path] = scatter.eta_scale[i];
                self.spread_cone_of_batch((paths, live, hits), batch, plain, i);
                paths.straight[path] = false;
                paths.rough[path] |= matches!(
                    scatter.outcome[i],
                    SampleOutcome::Reflection | SampleOutcome::Transmission
                );
                if plain.specular {
                    paths.previous_pdf[path] = 0.0;
                } else {
                    let lights = self.light_candidates(&plain.lobe, depth);
                    paths.previous_pdf[path] = estimator::pdf_per_candidate(scatter.pdf[i], lights);
                    paths.previous_share[path] = batch.share_from_infinity[i];
                    paths.previous.set(path, &s.receiver(i, plain));
                }
            }
        }
    }
}

/// Streams for lobes whose values are estimates.
fn fill_streams(
    paths: &PathStates,
    path_indices: &[u32],
    plain: &Plain,
    (depth, purpose): (u32, u32),
    streams: &mut Vec<Stream>,
) {
    streams.clear();
    if lobes::takes_streams(&plain.lobe) {
        let stream = |&p: &u32| paths.samplers[index(p)].stream(depth, purpose);
        streams.extend(path_indices.iter().map(stream));
    }
}
