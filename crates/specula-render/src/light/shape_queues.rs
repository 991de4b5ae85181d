//! Vertices that wait for points of lights, each with a shape of its own: spheres, triangles, and parallelograms without a
//! queue of their own. Many are sampled at once.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;
use specula_bsdf::Vec3;

use super::area::{Area, AreaSample};
use super::batch::{Vectors, Waiting, ZERO};
use super::choices::Floats;
use super::environment::BATCH_SIZE;
use super::parallelogram::Parallelogram;
use super::sphere::Sphere;
use super::triangle::Triangle;
use super::{LightSample, Source, from_area};
use crate::simd::simd_levels;

/// Vertices for which such lights were chosen, and the lights.
pub(super) struct ShapeQueues {
    spheres: ShapeQueue<Spheres>,
    triangles: ShapeQueue<Triangles>,
    parallelograms: ShapeQueue<Parallelograms>,
    samples: AreaSamples,
}

/// Vertices for which lights of one shape were chosen.
struct ShapeQueue<L> {
    waiting: Waiting,
    /// The light of each.
    lights: L,
}

/// Lights in columns.
trait LightColumns {
    type Light;

    fn set(&mut self, at: usize, light: &Self::Light);

    /// Samples points for the first `n` receivers.
    fn sample_all(&self, n: usize, waiting: &Waiting, samples: &mut AreaSamples);
}

struct Spheres {
    centre: Vectors,
    radius: Floats,
    side: Floats,
}

struct Triangles {
    corner: Vectors,
    edges: [Vectors; 2],
    normal: Vectors,
    area: Floats,
}

struct Parallelograms {
    corner: Vectors,
    edges: [Vectors; 2],
    normal: Vectors,
    area: Floats,
    axes: [Vectors; 2],
    sides: [Floats; 2],
    least: Floats,
    error: Floats,
}

/// An [`AreaSample`] of each.
struct AreaSamples {
    point: Vectors,
    /// All components of an error are alike.
    error: Floats,
    normal: Vectors,
    wi: Vectors,
    pdf: Floats,
}

impl LightColumns for Spheres {
    type Light = Sphere;

    #[inline(always)]
    fn set(&mut self, at: usize, light: &Sphere) {
        self.centre.set(at, light.centre);
        self.radius[at] = light.radius;
        self.side[at] = light.side;
    }

    fn sample_all(&self, n: usize, waiting: &Waiting, samples: &mut AreaSamples) {
        sample_spheres(n, waiting, self, samples);
    }
}

impl Spheres {
    #[inline(always)]
    fn get(&self, at: usize) -> Sphere {
        Sphere {
            centre: self.centre.get(at),
            radius: self.radius[at],
            side: self.side[at],
        }
    }
}

impl LightColumns for Triangles {
    type Light = Triangle;

    #[inline(always)]
    fn set(&mut self, at: usize, light: &Triangle) {
        self.corner.set(at, light.corner);
        self.edges[0].set(at, light.edges[0]);
        self.edges[1].set(at, light.edges[1]);
        self.normal.set(at, light.normal);
        self.area[at] = light.area;
    }

    fn sample_all(&self, n: usize, waiting: &Waiting, samples: &mut AreaSamples) {
        sample_triangles(n, waiting, self, samples);
    }
}

impl Triangles {
    #[inline(always)]
    fn get(&self, at: usize) -> Triangle {
        Triangle {
            corner: self.corner.get(at),
            edges: [self.edges[0].get(at), self.edges[1].get(at)],
            normal: self.normal.get(at),
            area: self.area[at],
        }
    }
}

impl LightColumns for Parallelograms {
    type Light = Parallelogram;

    #[inline(always)]
    fn set(&mut self, at: usize, light: &Parallelogram) {
        self.corner.set(at, light.corner);
        self.normal.set(at, light.normal);
        self.area[at] = light.area;
        for k in 0..2 {
            self.edges[k].set(at, light.edges[k]);
            self.axes[k].set(at, light.axes[k]);
            self.sides[k][at] = light.sides[k];
        }
        self.least[at] = light.least;
        self.error[at] = light.error.x;
    }

    fn sample_all(&self, n: usize, waiting: &Waiting, samples: &mut AreaSamples) {
        sample_parallelograms(n, waiting, self, samples);
    }
}

impl Parallelograms {
    #[inline(always)]
    fn get(&self, at: usize) -> Parallelogram {
        Parallelogram {
            corner: self.corner.get(at),
            edges: [self.edges[0].get(at), self.edges[1].get(at)],
            normal: self.normal.get(at),
            area: self.area[at],
            axes: [self.axes[0].get(at), self.axes[1].get(at)],
            sides: [self.sides[0][at], self.sides[1][at]],
            least: self.least[at],
            error: Vec3::splat(self.error[at]),
        }
    }
}

impl AreaSamples {
    #[inline(always)]
    fn set(&mut self, at: usize, sample: &AreaSample) {
        self.point.set(at, sample.point);
        self.error[at] = sample.error.x;
        self.normal.set(at, sample.normal);
        self.wi.set(at, sample.wi);
        self.pdf[at] = sample.pdf;
    }

    #[inline(always)]
    fn get(&self, at: usize) -> AreaSample {
        AreaSample {
            point: self.point.get(at),
            error: Vec3::splat(self.error[at]),
            normal: self.normal.get(at),
            wi: self.wi.get(at),
            pdf: self.pdf[at],
        }
    }
}

impl<L> ShapeQueue<L> {
    const fn new(lights: L) -> Self {
        Self {
            waiting: Waiting::EMPTY,
            lights,
        }
    }
}

impl<L: LightColumns> ShapeQueue<L> {
    /// Adds a receiver of a light; samples the queue if it is full.
    ///
    /// * `chosen`: the light with its index and probability.
    #[inline(always)]
    fn push(
        &mut self,
        vertex: usize,
        (light, chosen): (&L::Light, (u32, f32)),
        (p, u): (Vec3<f32>, [f32; 2]),
        out: (&mut AreaSamples, &[Source]),
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        self.lights.set(self.waiting.next(), light);
        if self.waiting.push(vertex, chosen, p, u) {
            self.sample(out, store);
        }
    }

    /// Samples lights for all that wait.
    fn sample(
        &mut self,
        (samples, sources): (&mut AreaSamples, &[Source]),
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        let n = self.waiting.take_count();
        self.lights.sample_all(n, &self.waiting, samples);
        store_samples(n, sources, &self.waiting, samples, store);
    }
}

impl ShapeQueues {
    pub(super) const EMPTY: Self = Self {
        spheres: ShapeQueue::new(Spheres {
            centre: Vectors::ZERO,
            radius: ZERO,
            side: ZERO,
        }),
        triangles: ShapeQueue::new(Triangles {
            corner: Vectors::ZERO,
            edges: [Vectors::ZERO; 2],
            normal: Vectors::ZERO,
            area: ZERO,
        }),
        parallelograms: ShapeQueue::new(Parallelograms {
            corner: Vectors::ZERO,
            edges: [Vectors::ZERO; 2],
            normal: Vectors::ZERO,
            area: ZERO,
            axes: [Vectors::ZERO; 2],
            sides: [ZERO; 2],
            least: ZERO,
            error: ZERO,
        }),
        samples: AreaSamples {
            point: Vectors::ZERO,
            error: ZERO,
            normal: Vectors::ZERO,
            wi: Vectors::ZERO,
            pdf: ZERO,
        },
    };

    /// Adds a receiver of a light, if that has a queue here; samples the queue if it is full.
    ///
    /// * `chosen`: the light and its probability.
    #[inline(always)]
    pub(super) fn push(
        &mut self,
        sources: &[Source],
        vertex: usize,
        chosen: (u32, f32),
        (p, u): (Vec3<f32>, [f32; 2]),
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) -> bool {
        let Some(Source::Area { area, .. }) = sources.get(chosen.0 as usize) else {
            return false;
        };
        let (receiver, out) = ((p, u), (&mut self.samples, sources));
        match area {
            Area::Sphere(light) => {
                (self.spheres).push(vertex, (light, chosen), receiver, out, store);
            }
            Area::Triangle(light) => {
                (self.triangles).push(vertex, (light, chosen), receiver, out, store);
            }
            Area::Parallelogram(light) => {
                (self.parallelograms).push(vertex, (light, chosen), receiver, out, store);
            }
            Area::Disk { .. } | Area::Ellipsoid { .. } => return false,
        }
        true
    }

    /// Samples lights for all that wait.
    pub(super) fn sample_rest(
        &mut self,
        sources: &[Source],
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        self.spheres.sample((&mut self.samples, sources), store);
        self.triangles.sample((&mut self.samples, sources), store);
        (self.parallelograms).sample((&mut self.samples, sources), store);
    }
}

/// Stores the samples of the first `n` receivers of a queue.
#[inline(always)]
fn store_samples(
    n: usize,
    sources: &[Source],
    waiting: &Waiting,
    samples: &AreaSamples,
    store: &mut impl FnMut(usize, Option<LightSample>),
) {
    for i in 0..n.min(BATCH_SIZE) {
        let Some(Source::Area {
            radiance,
            two_sided,
            ..
        }) = sources.get(waiting.lights[i] as usize)
        else {
            continue;
        };
        let sample = samples.get(i);
        let sampled = from_area(&sample, *radiance, *two_sided, waiting.probabilities[i]);
        store(waiting.vertices[i], sampled);
    }
}

/// Samples points of spheres for the first `n` receivers.
#[apply(simd_levels)]
fn sample_spheres(n: usize, waiting: &Waiting, lights: &Spheres, samples: &mut AreaSamples) {
    for i in 0..n.min(BATCH_SIZE) {
        let u = [waiting.u[0][i], waiting.u[1][i]];
        samples.set(i, &lights.get(i).sample(waiting.point.get(i), u));
    }
}

/// Samples points of triangles for the first `n` receivers.
#[apply(simd_levels)]
fn sample_triangles(n: usize, waiting: &Waiting, lights: &Triangles, samples: &mut AreaSamples) {
    for i in 0..n.min(BATCH_SIZE) {
        let u = [waiting.u[0][i], waiting.u[1][i]];
        samples.set(i, &lights.get(i).sample(waiting.point.get(i), u));
    }
}

/// Samples points of parallelograms for the first `n` receivers.
#[apply(simd_levels)]
fn sample_parallelograms(
    n: usize,
    waiting: &Waiting,
    lights: &Parallelograms,
    samples: &mut AreaSamples,
) {
    for i in 0..n.min(BATCH_SIZE) {
        let u = [waiting.u[0][i], waiting.u[1][i]];
        let light = lights.get(i);
        samples.set(i, &light.area_sample(waiting.point.get(i), u));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::QuadricShape;
    use crate::sampler::Sampler;
    use glam::{DMat4, DVec3};
    use specula_bsdf::math::vec3;

    /// Spheres, triangles, rectangles, skewed parallelograms and disks, some of them two-sided.
    fn sources(count: u32, sampler: &Sampler) -> Vec<Source> {
        (0..count)
            .map(|i| {
                let next = |k: u32| sampler.hashed([1, i, k]) - 0.5;
                let at = |k: u32| vec3(next(k), next(k + 1), next(k + 2));
                let centre = at(0) * 8.0;
                let [a, b] = [at(3), at(6)];
                let across = a.cross(b);
                let place = DMat4::from_translation(crate::convert::widen3(centre))
                    * DMat4::from_scale(DVec3::splat(f64::from(next(9)) + 0.6));
                let sphere = QuadricShape::Sphere { radius: 1.0 };
                let disk = QuadricShape::Disk {
                    radius: 0.4,
                    height: 0.0,
                };
                let area = match i % 5 {
                    0 => Area::quadric(sphere, &place, i % 2 == 0),
                    1 => Area::triangle([centre, centre + a, centre + b]),
                    2 => Area::parallelogram([centre, centre + a, centre + across]),
                    3 => Area::parallelogram([centre, centre + a, centre + b]),
                    _ => Area::quadric(disk, &place, false),
                };
                Source::Area {
                    area,
                    radiance: (at(10) + Vec3::splat(1.0)).to_array().into(),
                    two_sided: i % 3 == 0,
                }
            })
            .collect()
    }

    #[test]
    fn queues_sample_what_each_light_does() {
        let sampler = Sampler::new([3, 5], 1, 7);
        let sources = sources(60, &sampler);
        let mut queues = Box::new(ShapeQueues::EMPTY);
        let count = 3000;
        let mut found = vec![None; count];
        let vertex = |i: usize| {
            let i = crate::convert::id(i);
            let next = |k: u32| sampler.hashed([2, i, k]);
            let p = vec3(next(0), next(1), next(2)) * 8.0 - Vec3::splat(4.0);
            ((i * 7) % 61, next(3) + 0.1, p, [next(4), next(5)])
        };
        let mut taken = 0;
        {
            let mut store = |i: usize, light: Option<LightSample>| {
                assert!(found[i].is_none(), "twice");
                found[i] = Some(light);
            };
            for i in 0..count {
                let (light, probability, p, u) = vertex(i);
                let chosen = (light, probability);
                if queues.push(&sources, i, chosen, (p, u), &mut store) {
                    taken += 1;
                }
            }
            queues.sample_rest(&sources, &mut store);
        }
        assert!(taken * 5 > count * 3 && taken < count, "{taken}");
        let mut lit = 0;
        for (i, found) in found.iter().enumerate() {
            let (light, probability, p, u) = vertex(i);
            let Some(Source::Area {
                area,
                radiance,
                two_sided,
            }) = sources.get(light as usize)
            else {
                assert!(found.is_none());
                continue;
            };
            let has_queue = !matches!(area, Area::Disk { .. });
            assert_eq!(found.is_some(), has_queue, "{area:?}");
            let Some(found) = found else { continue };
            let expected = area
                .sample(p, u)
                .filter(|s| *two_sided || s.normal.dot(s.wi) < 0.0)
                .and_then(|s| from_area(&s, *radiance, *two_sided, probability));
            assert_eq!(format!("{found:?}"), format!("{expected:?}"));
            lit += usize::from(found.is_some());
        }
        assert!(lit > 800, "{lit}");
    }
}
