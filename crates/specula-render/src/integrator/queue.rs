//! What becomes of the hits of a wavefront: vertices that are queued, and sorted into runs of a material.
//!
//! In small scenes hits are known by their place ([`Places`]), which tells the material. Elsewhere the shape does.

use core::ops::Range;

use super::PathTracer;
use super::faces::FaceRun;
use super::ray_queue::index;
use super::wavefront::{MaterialRun, Wavefront};
use crate::accel::{Hit, Ray};
use crate::convert::id;
use crate::geometry::{NONE, triangle_normal};
use crate::places::Places;
use specula_bsdf::Vec3;

/// A hit that is shaded in a batch.
pub(super) struct QueuedVertex {
    /// Index among the live paths.
    at: u32,
    /// Twice the material, and one more where that is seen from the outside, or its sides are no materials of their
    /// own. In small scenes the side of its place instead, as of [`Places`].
    key: u32,
}

impl PathTracer<'_> {
    /// Queues the hits that are shaded in a batch, and shades others.
    pub(super) fn queue_hits(&self, wavefront: &mut Wavefront, depth: u32) {
        wavefront.queued.clear();
        wavefront.escaped.clear();
        if let Some(places) = &self.scene.places {
            return self.queue_by_place(wavefront, places, depth);
        }
        let accel = &self.scene.geometry.accel;
        let some_go_alone = self.goes_beyond_hits(depth);
        for k in 0..wavefront.live.len() {
            let hit = wavefront.hits.get(accel, k, || wavefront.live.ray(k));
            if let Some(key) = self.take_hit(wavefront, k, hit, (depth, some_go_alone)) {
                wavefront.queued.push(QueuedVertex { at: id(k), key });
            }
        }
    }

    /// Queues the hits of a small scene's rays.
    fn queue_by_place(&self, wavefront: &mut Wavefront, places: &Places, depth: u32) {
        let accel = &self.scene.geometry.accel;
        let some_go_alone = self.goes_beyond_hits(depth);
        for k in 0..wavefront.live.len() {
            let Some((place, at)) = places.at(&wavefront.hits, k) else {
                wavefront.escaped.push(id(k));
                continue;
            };
            let outside = match (at.material, &at.face) {
                (Some((_, false)), _) => Some(true),
                (Some((_, true)), Some(face)) => {
                    Some(face.normal.dot(wavefront.live.direction(k)) < 0.0)
                }
                _ => None,
            };
            let outside = match outside.filter(|_| !some_go_alone && !at.emits) {
                Some(outside) if depth < self.max_depth => outside,
                Some(_) => continue,
                None => {
                    let hit = wavefront.hits.get(accel, k, || wavefront.live.ray(k));
                    let at = (depth, some_go_alone);
                    let Some(key) = self.take_hit(wavefront, k, hit, at) else {
                        continue;
                    };
                    key % 2 == 1
                }
            };
            wavefront.queued.push(QueuedVertex {
                at: id(k),
                key: 2 * place + u32::from(outside),
            });
        }
    }

    /// Adds the emission at a hit; returns the material key of a vertex that is shaded in a batch, and shades others.
    ///
    /// * `k`: index among the live paths.
    /// * `some_go_alone`: [`Self::goes_beyond_hits`].
    #[inline(always)]
    fn take_hit(
        &self,
        wavefront: &mut Wavefront,
        k: usize,
        hit: Option<Hit>,
        (depth, some_go_alone): (u32, bool),
    ) -> Option<u32> {
        let Some(hit) = hit else {
            wavefront.escaped.push(id(k));
            return None;
        };
        let i = wavefront.live.index(k);
        if some_go_alone && self.is_followed_alone(&wavefront.paths, i, &hit, depth) {
            // The step counts its rays.
            wavefront.tally.rays -= 1;
            self.step_scalar(wavefront, k, |path| self.step(path, depth));
            return None;
        }
        if let Some((key, emits)) = self.material_key(wavefront, k, &hit) {
            if emits {
                self.add_emission(wavefront, k, &hit, depth);
            }
            return (depth < self.max_depth).then_some(key);
        }
        let time = wavefront.paths.times[i];
        let ray = wavefront.live.ray(k);
        let surface = self.scene.geometry.surface(&ray, &hit, time);
        if wavefront.is_at_y(k) {
            self.add_emission(wavefront, k, &hit, depth);
            self.step_scalar(wavefront, k, |path| {
                self.shade_surface(path, surface, depth)
            });
        } else {
            self.step_scalar(wavefront, k, |path| self.shade(path, Some(surface), depth));
        }
        None
    }

    /// The material key of a surface, and whether it may emit; `None`: it is shaded singly.
    ///
    /// * `k`: index among the live paths.
    #[inline(always)]
    fn material_key(&self, wavefront: &Wavefront, k: usize, hit: &Hit) -> Option<(u32, bool)> {
        let paths = &wavefront.paths;
        let i = wavefront.live.index(k);
        let rough = paths.rough[i];
        let geometry = &self.scene.geometry;
        let group = geometry.group_of(hit);
        let shape = group.shape_of[hit.primitive as usize];
        let (material, is_sided) = self.scene.batch_material(shape, rough)?;
        let outside =
            !is_sided || self.hits_outside(&wavefront.live.ray(k), hit, || paths.times[i]);
        let emits = group.light_of(hit.primitive) != NONE;
        Some((2 * material + u32::from(outside), emits))
    }

    /// Whether a ray hits the outside of a surface.
    ///
    /// * `time`: of the path.
    fn hits_outside(&self, ray: &Ray, hit: &Hit, time: impl FnOnce() -> f32) -> bool {
        let geometry = &self.scene.geometry;
        let normal = if let Some(facet) = geometry.facet(hit) {
            triangle_normal(facet.corners.map(|&c| Vec3::from(c)))
        } else if let Some(at) = geometry.quadric(hit) {
            let near = ray.origin + ray.direction * hit.t;
            return (geometry.placed_quadric(at)).is_met_outside(near, ray.direction);
        } else {
            geometry.surface(ray, hit, time()).ng
        };
        normal.dot(ray.direction) < 0.0
    }

    /// Sorts the queued vertices by key into material runs, and into runs on faces.
    ///
    /// Even a single vertex is a run: its values must not depend on other vertices.
    pub(super) fn sort_by_material(&self, wavefront: &mut Wavefront) {
        let Wavefront {
            queued,
            starts,
            runs,
            face_runs,
            batch,
            ..
        } = wavefront;
        let places = self.scene.places.as_ref();
        let keys = match places {
            Some(places) => places.order().len(),
            None => 2 * self.scene.materials.count(),
        };
        starts.clear();
        starts.resize(keys, 0);
        for vertex in queued.iter() {
            starts[vertex.key as usize] += 1;
        }
        runs.clear();
        face_runs.clear();
        let mut from = 0;
        let mut begin = |count: &mut u32, key: u32| {
            let to = from + *count as usize;
            if *count > 0 {
                match runs.last_mut() {
                    Some(run) if run.key == key => run.to = to,
                    _ => runs.push(MaterialRun {
                        from,
                        to,
                        key,
                        first_bound: 0,
                    }),
                }
            }
            *count = id(from);
            let begun = from..to;
            from = to;
            begun
        };
        if let Some(places) = places {
            for &side in places.order() {
                let place = places.of_side(side);
                let key = place.key(side % 2 == 1).unwrap_or(0);
                let Range {
                    start: from,
                    end: to,
                } = begin(&mut starts[side as usize], key);
                if place.face.is_some() && to > from {
                    face_runs.push(FaceRun { from, to, side });
                }
            }
        } else {
            for (key, count) in (0..).zip(starts.iter_mut()) {
                begin(count, key);
            }
        }
        batch.count = from;
        for vertex in queued.iter() {
            let place = &mut starts[vertex.key as usize];
            batch.live_indices[index(*place)] = vertex.at;
            *place += 1;
        }
    }
}
