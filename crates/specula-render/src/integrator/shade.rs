//! Shading of the vertices of a wavefront that form a batch: from hits to surfaces, direct light and new rays.
//!
//! The loops over plain materials are here; `bound` has those over lobes that differ from vertex to vertex.

use core::ops::Range;

use specula_bsdf::batch::SampleOutcome;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Vec3};

use super::bound::{self, Exit};
use super::path_states::PathStates;
use super::quadrics::VerticesOnQuadrics;
use super::ray_queue::{RayQueue, index};
use super::sharing::Shared;
use super::vertex_batch::{self, VertexBatch, WAVEFRONT_SIZE};
use super::wavefront::{MaterialRun, Wavefront};
use super::{PathTracer, estimator};
use crate::accel::{BlockHits, Hit, Ray};
use crate::convert::id;
use crate::material::{Plain, lobes};
use crate::sampler::Purpose;

impl PathTracer<'_> {
    /// Takes the paths of the batch from this vertex to the next.
    pub(super) fn shade_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        wavefront.quadrics.clear();
        wavefront.batch.triangles.count = 0;
        self.load_faces(wavefront);
        self.load_vertices(wavefront);
        self.load_bound(wavefront);
        let batch = &mut *wavefront.batch;
        let n = batch.count;
        let geometry = &self.scene.geometry;
        wavefront.quadrics.locate(geometry, &mut batch.surfaces);
        if batch.triangles.count > 0 {
            vertex_batch::interpolate_triangles(n, &batch.triangles, &mut batch.surfaces);
        }
        vertex_batch::face_viewers(n, &mut batch.surfaces);
        for (plain, range) in self.material_runs(&wavefront.runs) {
            if plain.specular {
                vertex_batch::use_geometric_normals(range.start, range.end, &mut batch.surfaces);
            }
        }
        self.bind_vertices(wavefront, depth);
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
            bound,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            path_indices,
            live_indices,
            reflectance,
            count,
            ..
        } = &**batch;
        let albedos = &mut paths.first.albedo;
        for (plain, range) in self.material_runs(runs) {
            let albedo = plain.lobe.albedo();
            for i in range {
                let path = index(path_indices[i]);
                if !(plain.black_inside && s.side[i] < 0.0) {
                    let scale = plain.reflectance.map(|_| reflectance.colour(i));
                    albedos.set_colour(path, scale.map_or(albedo, |scale| scale * albedo));
                }
            }
        }
        for (i, vertex) in self.bound_runs(runs).flat_map(|run| run.bound(bound)) {
            let albedo = vertex.albedo(&self.scene.materials);
            albedos.set_colour(index(path_indices[i]), albedo);
        }
        for i in 0..WAVEFRONT_SIZE.min(*count) {
            let path = index(path_indices[i]);
            paths.first.normal.set(path, s.ns.get(i));
            let ray = live.ray(live_indices[i] as usize);
            paths.first.depth[path] = (s.position.get(i) - ray.origin).length();
        }
    }

    /// The runs of plain materials of the batch: materials with ranges of vertices.
    pub(super) fn material_runs<'s>(
        &'s self,
        runs: &'s [MaterialRun],
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        runs.iter().filter_map(|s| {
            let sides = self.scene.materials.plain(s.key / 2)?;
            Some((&sides[(s.key % 2) as usize], s.range()))
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
            quadrics,
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
            let path = live.index(k);
            path_indices[i] = id(path);
            random_numbers.set(i, &paths.samplers[path]);
            s.wo_world.set(i, -live.direction(k));
            scatter
                .throughput
                .set_colour(i, paths.throughput.colour(path));
            scatter.eta_scale[i] = paths.eta_scale[path];
        }
        for (plain, range) in self.material_runs(runs) {
            for i in range {
                if batch.on_face[i] {
                    continue;
                }
                let k = batch.live_indices[i] as usize;
                if let Some(hit) = hits.get(&self.scene.geometry.accel, k, || live.ray(k)) {
                    let time = || paths.times[live.index(k)];
                    let ray = (|| live.ray(k), &hit, time);
                    self.load_surface((batch, quadrics), i, ray, !plain.isotropic);
                }
            }
        }
    }

    /// Loads the surface of one vertex.
    #[inline(always)]
    pub(super) fn load_surface(
        &self,
        (batch, quadrics): (&mut VertexBatch, &mut VerticesOnQuadrics),
        i: usize,
        (ray, hit, time): (impl FnOnce() -> Ray, &Hit, impl FnOnce() -> f32),
        needs_tangent: bool,
    ) {
        let geometry = &self.scene.geometry;
        let (t, s) = (&mut batch.triangles, &mut batch.surfaces);
        let mut tangent = Vec3::ZERO;
        if let Some(facet) = geometry.facet(hit) {
            for (c, v) in t.corners.iter_mut().zip(facet.corners) {
                c.set_array(i, v);
            }
            t.has_normals[i] = facet.normals.is_some();
            if let Some(normals) = facet.normals {
                for (c, v) in t.normals.iter_mut().zip(normals) {
                    c.set_array(i, v);
                }
            }
            t.weights[0][i] = hit.u;
            t.weights[1][i] = hit.v;
            t.is_triangle[i] = true;
            t.count += 1;
            if needs_tangent {
                tangent = geometry.tangent(hit);
            }
        } else if let Some(quadric) = geometry.quadric(hit) {
            t.is_triangle[i] = false;
            let ray = ray();
            let near = ray.origin + ray.direction * hit.t;
            s.position.set(i, near);
            if !quadrics.push(i, quadric, needs_tangent) {
                let point = geometry.placed_quadric(quadric).point_near(near);
                s.set_quadric(i, &point);
                tangent = if needs_tangent {
                    point.tangent
                } else {
                    tangent
                };
            }
        } else {
            let surface = geometry.surface(&ray(), hit, time());
            t.is_triangle[i] = false;
            s.position.set(i, surface.position);
            s.error[i] = surface.error.x;
            s.ng.set(i, surface.ng);
            s.ns.set(i, surface.ns);
            tangent = if needs_tangent {
                surface.tangent
            } else {
                tangent
            };
        }
        s.tangent.set(i, tangent);
    }

    /// Samples the next direction of each path.
    fn scatter_batch(&self, wavefront: &mut Wavefront, depth: u32) {
        let n = wavefront.batch.count;
        let batch = &mut *wavefront.batch;
        batch.random_numbers.generate(n, Purpose::Scatter, depth);
        self.sample_plain(wavefront, depth);
        let Wavefront {
            paths,
            runs,
            batch,
            bound,
            own_lobes,
            tally,
            shared,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            scatter_samples: scatter,
            random_numbers,
            path_indices,
            ..
        } = &mut **batch;
        let u = [0, 1, 2].map(|k| &random_numbers.values[k][..]);
        let of_paths = (&**paths, &path_indices[..]);
        let scattered =
            self.sample_bound(of_paths, (runs, bound, own_lobes), (s, u), scatter, depth);
        tally.scattered = tally.scattered.and(scattered);
        if let Some(shared) = shared {
            let n = n.min(WAVEFRONT_SIZE);
            shared.disable_roulette_at_x(&path_indices[..n], &mut random_numbers.values[3][..n]);
        }
        vertex_batch::scatter(n, depth, s, &random_numbers.values[3], scatter);
        self.continue_paths(wavefront, depth);
    }

    /// Samples the lobes of plain materials.
    fn sample_plain(&self, wavefront: &mut Wavefront, depth: u32) {
        let Wavefront {
            paths,
            runs,
            batch,
            streams,
            tally,
            ..
        } = wavefront;
        let VertexBatch {
            surfaces: s,
            scatter_samples: scatter,
            random_numbers,
            path_indices,
            reflectance,
            base,
            ..
        } = &mut **batch;
        for (plain, range) in self.material_runs(runs) {
            let (from, to) = (range.start, range.end);
            let purpose = estimator::STREAM_SCATTER;
            if plain.is_batched {
                let vertices = &path_indices[from..to];
                fill_streams(paths, vertices, plain, (depth, purpose), streams);
                let u = [0, 1, 2].map(|k| &random_numbers.values[k][from..to]);
                let samples = specula_bsdf::batch::Samples {
                    wi: scatter.wi.directions_mut(from..to),
                    weight: scatter.weight.colours_mut(from..to),
                    pdf: &mut scatter.pdf[from..to],
                    outcome: &mut scatter.outcome[from..to],
                };
                let wo = s.wo.directions(from..to);
                if plain.coat.is_some() {
                    let bases = lobes::Bases {
                        albedo: reflectance.colours(from..to),
                        base: base.colours(from..to),
                    };
                    lobes::sample_over((&plain.lobe, bases), wo, u, samples);
                } else {
                    lobes::sample(&plain.lobe, wo, u, streams, samples);
                }
                if plain.reflectance.is_some() && plain.coat.is_none() {
                    vertex_batch::scale_values(from, to, reflectance, &mut scatter.weight);
                }
            } else {
                let u = [0, 1, 2].map(|k| &random_numbers.values[k][..]);
                let sampler = |i: usize| &paths.samplers[index(path_indices[i])];
                let stream = |i: usize| sampler(i).stream(depth, purpose);
                bound::sample_run(plain, range.clone(), (s, u), scatter, stream);
            }
            let sides = plain.black_inside.then(|| &s.side[from..to]);
            let scattered = vertex_batch::count_scattered(&scatter.outcome[from..to], sides);
            tally.scattered = tally.scattered.and(scattered);
            for i in range.filter(|_| plain.is_batched && !plain.opaque) {
                if matches!(
                    scatter.outcome[i],
                    SampleOutcome::Transmission | SampleOutcome::SpecularTransmission
                ) {
                    scatter.eta_scale[i] =
                        estimator::eta_scale_after(scatter.eta_scale[i], plain.eta);
                }
            }
        }
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
            bound,
            shared,
            ..
        } = wavefront;
        let mut onward = Onward {
            paths,
            live,
            hits,
            next,
            batch,
            shared: shared.as_deref_mut(),
            has_cones: self.scene.textures.is_filtered(),
        };
        let (s, scatter) = (&batch.surfaces, &batch.scatter_samples);
        for (plain, range) in self.material_runs(runs) {
            let exit = Exit::of_plain(plain, self.light_candidates(&plain.lobe, depth));
            for i in range {
                let is_black = plain.black_inside && s.side[i] < 0.0;
                if scatter.alive[i] && !is_black {
                    self.continue_path(&mut onward, i, exit);
                }
            }
        }
        for (i, vertex) in self.bound_runs(runs).flat_map(|run| run.bound(bound)) {
            if scatter.alive[i] {
                self.continue_path(&mut onward, i, vertex.exit());
            }
        }
    }

    /// Stores a path that continues, with its ray.
    ///
    /// * `i`: index of its vertex.
    #[inline(always)]
    fn continue_path(&self, onward: &mut Onward<'_>, i: usize, exit: Exit) {
        let Onward {
            paths,
            live,
            hits,
            next,
            batch,
            shared,
            has_cones,
        } = onward;
        let (s, scatter) = (&batch.surfaces, &batch.scatter_samples);
        let path_index = batch.path_indices[i];
        let path = index(path_index);
        let ray = Ray {
            origin: scatter.origin.get(i),
            direction: scatter.direction.get(i),
            t_max: f32::INFINITY,
        };
        next.push(path_index, &ray);
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
        if *has_cones {
            let eta = exit.eta.unwrap_or(scatter.eta[i]);
            self.spread_cone_of_batch((paths, live, hits), batch, i, eta);
        }
        let outcome = scatter.outcome[i];
        if exit.is_pane {
            paths.straight[path] &= outcome == SampleOutcome::SpecularTransmission;
        } else {
            paths.straight[path] = false;
        }
        let is_rough = matches!(
            outcome,
            SampleOutcome::Reflection | SampleOutcome::Transmission
        );
        paths.rough[path] |= is_rough;
        if is_rough {
            let pdf = estimator::pdf_per_candidate(scatter.pdf[i], exit.lights);
            paths.previous_pdf[path] = pdf;
            paths.previous_share[path] = batch.share_from_infinity[i];
            paths.previous.set(path, &s.receiver(i, exit.opaque));
        } else {
            paths.previous_pdf[path] = 0.0;
        }
    }
}

/// Where paths that continue are stored, and what they come from.
struct Onward<'a> {
    paths: &'a mut PathStates,
    live: &'a RayQueue,
    hits: &'a BlockHits,
    next: &'a mut RayQueue,
    batch: &'a VertexBatch,
    shared: Option<&'a mut Shared>,
    /// Whether textures are filtered over the paths' cones.
    has_cones: bool,
}

/// Streams for lobes whose values are estimates.
pub(super) fn fill_streams(
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
