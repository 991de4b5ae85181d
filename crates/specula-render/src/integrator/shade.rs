//! The vertices of a wavefront that are dealt with in batch: from hits to batch, light, and onwards.

use core::ops::Range;

use specula_bsdf::batch::SampleOutcome;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Vec3};

use super::path_states::PathStates;
use super::vertex_batch::{self, VertexBatch, WAVEFRONT_SIZE};
use super::visibility::TO_LIGHT;
use super::wavefront::{MaterialRun, Wavefront, index};
use super::{PathTracer, candidates};
use crate::accel::{Hit, Ray};
use crate::convert::id;
use crate::material::{Plain, lobes};
use crate::sampler::Purpose;

impl PathTracer<'_> {
    /// Takes the paths in batch from this vertex to the next.
    pub(super) fn shade_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        self.load(wavefront);
        let batch = &mut *wavefront.batch;
        let n = batch.count;
        vertex_batch::make_surfaces(n, &batch.triangles, &mut batch.surfaces);
        vertex_batch::turn(n, &mut batch.surfaces);
        for (plain, range) in self.each(&wavefront.runs) {
            if plain.specular {
                vertex_batch::straighten(range.start, range.end, &mut batch.surfaces);
            }
        }
        if depth == 0 {
            self.show(wavefront);
        }
        self.note_shared(wavefront);
        self.light_batch(wavefront, depth);
        self.scatter_batch(wavefront, depth);
    }

    /// Keeps what the first vertices show.
    fn show(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            paths,
            live,
            runs,
            batch,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            owners,
            places,
            ..
        } = &**batch;
        for (plain, range) in self.each(runs) {
            let albedo = plain.lobe.albedo();
            for i in range {
                let path = index(owners[i]);
                if !(plain.black_inside && s.side[i] < 0.0) {
                    paths.first.albedo.set_colour(path, albedo);
                }
                paths.first.normal.set(path, s.ns.get(i));
                let ray = live.ray(places[i] as usize);
                paths.first.depth[path] = (s.position.get(i) - ray.origin).length();
            }
        }
    }

    /// Runs of the batch with their materials.
    fn each<'s>(
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

    /// Brings what is sorted into the batch.
    fn load(&self, wavefront: &mut Wavefront) {
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
            scatter_samples: o,
            random_numbers,
            owners,
            places,
            count,
            ..
        } = &mut **batch;
        for i in 0..WAVEFRONT_SIZE.min(*count) {
            let k = places[i] as usize;
            let (path, ray) = (live.number(k), live.ray(k));
            owners[i] = id(path);
            random_numbers.place(i, &paths.samplers[path]);
            s.towards.set(i, -ray.direction);
            o.throughput.set_colour(i, paths.throughput.colour(path));
            o.eta_scale[i] = paths.eta_scale[path];
        }
        for (plain, range) in self.each(runs) {
            for i in range {
                let k = batch.places[i] as usize;
                if let Some(hit) = &hits[k] {
                    self.load_surface(batch, i, (live.ray(k), hit), !plain.isotropic);
                }
            }
        }
    }

    /// Brings a surface into its element.
    #[inline(always)]
    fn load_surface(
        &self,
        batch: &mut VertexBatch,
        i: usize,
        (ray, hit): (&Ray, &Hit),
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
            t.wanted[i] = true;
            if needs_tangent {
                tangent = geometry.tangent(hit);
            }
        } else {
            let [position, error, ng, ns, along] = match geometry.quadric(ray, hit) {
                Some([position, error, normal, along]) => [position, error, normal, normal, along],
                None => {
                    let s = geometry.surface(ray, hit);
                    [s.position, s.error, s.ng, s.ns, s.tangent]
                }
            };
            t.wanted[i] = false;
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

    /// Adds light from one sampled light to each path.
    fn light_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        wavefront
            .batch
            .random_numbers
            .draw(wavefront.batch.count, Purpose::Light, depth);
        let twice = self
            .with_two_lights(&wavefront.runs, depth)
            .next()
            .is_some();
        if twice {
            self.part_numbers(wavefront, depth);
        }
        self.consider(wavefront, depth, 0);
        if twice {
            self.consider(wavefront, depth, 1);
            self.keep_one(wavefront, depth);
        }
        let batch = &mut *wavefront.batch;
        vertex_batch::aim(batch.count, &batch.surfaces, &mut batch.light_samples);
        self.add_unblocked(wavefront, depth);
    }

    /// MaterialRuns where two lights are sampled.
    fn with_two_lights<'s>(
        &'s self,
        runs: &'s [MaterialRun],
        depth: u32,
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        let two = move |plain: &Plain| self.lights_at(&plain.lobe, depth) == 2;
        self.each(runs).filter(move |(plain, _)| two(plain))
    }

    /// Makes the random numbers of one light those of two where as many are sampled.
    fn part_numbers(&self, wavefront: &mut Wavefront, depth: u32) {
        let VertexBatch {
            random_numbers,
            second_random_numbers,
            ..
        } = &mut *wavefront.batch;
        let first_random_numbers = &mut random_numbers.values;
        for (_, range) in self.with_two_lights(&wavefront.runs, depth) {
            for i in range {
                let u = [0, 1, 2, 3].map(|k| first_random_numbers[k][i]);
                for (to, which) in [(&mut *first_random_numbers, 0), (second_random_numbers, 1)] {
                    let parted = candidates::random_numbers(u, which, 2);
                    for k in 0..4 {
                        to[k][i] = parted[k];
                    }
                }
            }
        }
    }

    /// Keeps one of two lights.
    fn keep_one(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths, runs, batch, ..
        } = wavefront;
        let VertexBatch {
            light_samples,
            second,
            second_random_numbers: [choices, ..],
            owners,
            ..
        } = &mut **batch;
        for (_, range) in self.with_two_lights(runs, depth) {
            for i in range.clone() {
                choices[i] = candidates::choice(&paths.samplers[index(owners[i])], depth);
            }
            vertex_batch::keep_one(range.start, range.end, choices, light_samples, second);
        }
    }

    /// Samples a light for each vertex, and weighs what it would bring.
    ///
    /// * `which`: 1 for the second where two are sampled; else 0.
    fn consider(&self, wavefront: &mut Wavefront, depth: u32, which: u32) {
        self.draw_lights(wavefront, depth, which);
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
            second,
            scatter_samples: o,
            owners,
            ..
        } = &mut **batch;
        let a = if which == 0 { light_samples } else { second };
        for (plain, range) in self.each(runs) {
            let (from, to) = (range.start, range.end);
            let count = self.lights_at(&plain.lobe, depth);
            if which >= count {
                continue;
            }
            if plain.specular {
                a.contribution.x[range.clone()].fill(0.0);
                a.contribution.y[range.clone()].fill(0.0);
                a.contribution.z[range].fill(0.0);
                continue;
            }
            for i in range {
                let black = plain.black_inside && s.side[i] < 0.0;
                a.pdf[i] *= if black { 0.0 } else { count as f32 };
            }
            vertex_batch::to_frames(from, to, s, a);
            let purpose = candidates::stream(which);
            fill_streams(paths, &owners[from..to], plain, (depth, purpose), streams);
            lobes::eval_pdf(
                &plain.lobe,
                s.wo.directions(from, to),
                a.wi.directions(from, to),
                streams,
                a.f_cos.colours_mut(from, to),
                &mut a.lobe_pdf[from..to],
            );
            vertex_batch::weigh(from, to, &o.throughput, a);
        }
    }

    /// Samples a light for each vertex.
    fn draw_lights(&self, wavefront: &mut Wavefront, depth: u32, which: u32) {
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
            second,
            share_far,
            random_numbers,
            second_random_numbers,
            ..
        } = &mut **batch;
        let (random_numbers, a) = match which {
            0 => (&random_numbers.values, light_samples),
            _ => (&*second_random_numbers, second),
        };
        if let Some(light) = scene.lights.lone_parallelogram() {
            let [_, u, v, _] = random_numbers;
            vertex_batch::draw_light(n, light, [u, v], s, a);
            return;
        }
        let world = (&scene.geometry, &scene.textures);
        let wanted = |plain: &Plain| !plain.specular && self.lights_at(&plain.lobe, depth) > which;
        let receivers = self
            .each(runs)
            .filter(|(plain, _)| wanted(plain))
            .flat_map(|(plain, range)| range.map(move |i| (i, plain)))
            .map(|(i, plain)| (i, s.receiver(i, plain)));
        let u = [0, 1, 2, 3].map(|k| &random_numbers[k][..]);
        let place = |i, light| a.set(i, light);
        (scene.lights).sample_all(lights, receivers, world, u, share_far, place);
    }

    /// Adds the light that nothing is in the way of.
    fn add_unblocked(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            batch,
            shadows,
            blocked,
            tally,
            shared,
            ..
        } = wavefront;
        let a = &batch.light_samples;
        shadows.clear();
        for i in 0..WAVEFRONT_SIZE.min(batch.count) {
            if a.contribution.colour(i).is_black() {
                continue;
            }
            let ray = Ray {
                origin: a.origin.get(i),
                direction: a.direction.get(i),
                t_max: if a.far[i] { f32::INFINITY } else { TO_LIGHT },
            };
            shadows.push(id(i), ray);
        }
        let accel = &self.scene.geometry.accel;
        accel.occluded_all(shadows.rays(), blocked);
        tally.rays += shadows.len() as u64;
        for (k, &blocked) in blocked.iter().enumerate() {
            if !blocked {
                let lane = shadows.number(k);
                let path = index(batch.owners[lane]);
                match shared {
                    Some(shared) if shared.is_at_y(path) => shared.keep_light(path, batch, lane),
                    _ => paths.add(path, a.contribution.colour(lane), depth + 1),
                }
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
        batch.random_numbers.draw(n, Purpose::Scatter, depth);
        let VertexBatch {
            surfaces: s,
            scatter_samples: o,
            random_numbers,
            owners,
            ..
        } = &mut **batch;
        for (plain, range) in self.each(runs) {
            let (from, to) = (range.start, range.end);
            fill_streams(paths, &owners[from..to], plain, (depth, 1), streams);
            let u = [0, 1, 2].map(|k| &random_numbers.values[k][from..to]);
            let samples = specula_bsdf::batch::Samples {
                wi: o.wi.directions_mut(from, to),
                weight: o.weight.colours_mut(from, to),
                pdf: &mut o.pdf[from..to],
                kind: &mut o.kind[from..to],
            };
            lobes::sample(&plain.lobe, s.wo.directions(from, to), u, streams, samples);
            let sides = plain.black_inside.then(|| &s.side[from..to]);
            let scattered = vertex_batch::count_scattered(&o.kind[from..to], sides);
            tally.scattered = tally.scattered.and(scattered);
            for i in range.filter(|_| !plain.opaque) {
                if matches!(
                    o.kind[i],
                    SampleOutcome::Transmission | SampleOutcome::SpecularTransmission
                ) {
                    o.eta_scale[i] *= plain.eta * plain.eta;
                }
            }
        }
        if let Some(shared) = shared {
            let n = n.min(WAVEFRONT_SIZE);
            shared.let_pass(&owners[..n], &mut random_numbers.values[3][..n]);
        }
        vertex_batch::go_on(n, depth, s, &random_numbers.values[3], o);
        self.keep(wavefront, depth);
    }

    /// Brings the paths that go on back from the batch.
    fn keep(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            next,
            runs,
            batch,
            shared,
            ..
        } = wavefront;
        let (s, o) = (&batch.surfaces, &batch.scatter_samples);
        for (plain, range) in self.each(runs) {
            for i in range {
                if !o.alive[i] || (plain.black_inside && s.side[i] < 0.0) {
                    continue;
                }
                let number = batch.owners[i];
                let path = index(number);
                let ray = Ray {
                    origin: o.origin.get(i),
                    direction: o.direction.get(i),
                    t_max: f32::INFINITY,
                };
                next.push(number, ray);
                let mut throughput = o.throughput.colour(i);
                if let Some(shared) = shared {
                    if shared.is_at_y(path) {
                        shared.keep_direction(path, batch, i);
                    }
                    let from_x = shared.carried_from_x(path, o.weight.colour(i));
                    throughput = from_x.unwrap_or(throughput);
                }
                paths.throughput.set_colour(path, throughput);
                paths.eta_scale[path] = o.eta_scale[i];
                paths.straight[path] = false;
                paths.rough[path] |= matches!(
                    o.kind[i],
                    SampleOutcome::Reflection | SampleOutcome::Transmission
                );
                if plain.specular {
                    paths.previous_pdf[path] = 0.0;
                } else {
                    let lights = self.lights_at(&plain.lobe, depth);
                    paths.previous_pdf[path] = candidates::density(o.pdf[i], lights);
                    paths.previous_share[path] = batch.share_far[i];
                    paths.previous.set(path, &s.receiver(i, plain));
                }
            }
        }
    }
}

/// Streams for lobes whose values are estimates.
fn fill_streams(
    paths: &PathStates,
    owners: &[u32],
    plain: &Plain,
    (depth, purpose): (u32, u32),
    streams: &mut Vec<Stream>,
) {
    streams.clear();
    if lobes::takes_streams(&plain.lobe) {
        let stream = |&p: &u32| paths.samplers[index(p)].stream(depth, purpose);
        streams.extend(owners.iter().map(stream));
    }
}
