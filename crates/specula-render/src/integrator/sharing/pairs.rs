//! The pairs of an `x` and a `y` of a group: their connections, and the radiance that `x` receives from `y`.

use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;

use super::super::ray_queue::{RayQueue, index};
use super::super::vertex_batch::{Floats, Vectors, WAVEFRONT_SIZE, ZERO};
use super::super::wavefront::Wavefront;
use super::super::{PathTracer, estimator};
use super::{Shared, connect};
use crate::accel::Ray;
use crate::convert::id;
use crate::material::lobes;
use crate::options::Strategy;

/// Values of lobes: `f |cos|` and density.
pub(super) struct LobeValues {
    pub(super) f: Vectors,
    pub(super) pdf: Floats,
}

/// Pairs of an `x` and a `y` of a group; those of one `y` are consecutive.
pub(super) struct Pairs {
    pub(super) count: usize,
    /// Paths of `x` and of `y`.
    pub(super) x: [u32; WAVEFRONT_SIZE],
    pub(super) y: [u32; WAVEFRONT_SIZE],
    /// Cosine at `y` over squared distance, in the units of `y`'s own path; 0 where the two are too close or
    /// turned away from each other.
    pub(super) g: Floats,
    /// At `x`, local: towards its viewer and towards `y`.
    pub(super) wo_at_x: Vectors,
    pub(super) wi_at_x: Vectors,
    /// At `y`, local: towards `x`.
    pub(super) wo_at_y: Vectors,
    /// The shadow ray between them.
    pub(super) origin: Vectors,
    pub(super) direction: Vectors,
    /// `f |cos|` at `x` times `g`.
    pub(super) f: Vectors,
    /// Density of `y`; 0 where it is occluded.
    pub(super) p: Floats,
    /// Lobe values at `y`: towards the light, and in the sampled direction.
    values_at_y: [LobeValues; 2],
}

/// Buffers of [`PathTracer::share`].
pub(in super::super) struct PairBuffers {
    pairs: Box<Pairs>,
    /// The pairs of each `y`: its path, from, to.
    rows: Vec<(usize, usize, usize)>,
    /// Pairs by the keys of their lobes, and how many there are up to each key.
    order: Vec<u32>,
    ends: Vec<u32>,
    /// In that order: `wo`, `wi`, and the values of the lobes.
    wo: Vectors,
    wi: Vectors,
    values: LobeValues,
    /// Directions to the light and sampled at each `y`, local, by path; 0 where their sides of surface and frame
    /// differ.
    wi_at_y: [Vectors; 2],
    rays: Box<RayQueue>,
    occluded: Vec<bool>,
}

impl LobeValues {
    const ZERO: Self = Self {
        f: Vectors::ZERO,
        pdf: ZERO,
    };
}

impl Pairs {
    const NONE: Self = Self {
        count: 0,
        x: [0; WAVEFRONT_SIZE],
        y: [0; WAVEFRONT_SIZE],
        g: ZERO,
        wo_at_x: Vectors::ZERO,
        wi_at_x: Vectors::ZERO,
        wo_at_y: Vectors::ZERO,
        origin: Vectors::ZERO,
        direction: Vectors::ZERO,
        f: Vectors::ZERO,
        p: ZERO,
        values_at_y: [LobeValues::ZERO; 2],
    };
}

impl PairBuffers {
    pub(in super::super) fn new() -> Self {
        Self {
            pairs: Box::new(Pairs::NONE),
            rows: Vec::new(),
            order: Vec::new(),
            ends: Vec::new(),
            wo: Vectors::ZERO,
            wi: Vectors::ZERO,
            values: LobeValues::ZERO,
            wi_at_y: [Vectors::ZERO; 2],
            rays: RayQueue::new(),
            occluded: Vec::new(),
        }
    }

    /// Sorts the pairs that are wanted by key.
    ///
    /// * `count`: of keys.
    fn sort(
        &mut self,
        count: usize,
        is_wanted: impl Fn(&Pairs, usize) -> bool,
        key: impl Fn(&Pairs, usize) -> u32,
    ) {
        let Self {
            pairs, order, ends, ..
        } = self;
        ends.clear();
        ends.resize(count + 1, 0);
        let wanted = || (0..pairs.count.min(WAVEFRONT_SIZE)).filter(|&k| is_wanted(pairs, k));
        for k in wanted() {
            ends[key(pairs, k) as usize + 1] += 1;
        }
        let mut sum = 0;
        for end in &mut *ends {
            sum += *end;
            *end = sum;
        }
        order.clear();
        order.resize(sum as usize, 0);
        // Where pairs of a key begin becomes where they end.
        for k in wanted() {
            let place = &mut ends[key(pairs, k) as usize];
            order[*place as usize] = id(k);
            *place += 1;
        }
    }

    /// Lists the pairs of a group.
    fn list(&mut self, shared: &Shared, group: core::ops::Range<usize>) {
        let pairs = &mut *self.pairs;
        for j in group.clone().filter(|&j| shared.has_y(j)) {
            let from = pairs.count;
            for i in group.clone().filter(|&i| shared.has_x[i]) {
                let k = pairs.count % WAVEFRONT_SIZE;
                pairs.x[k] = id(i);
                pairs.y[k] = id(j);
                pairs.count = k + 1;
            }
            self.rows.push((j, from, pairs.count));
        }
    }
}

impl Shared {
    /// Adds the radiance that each `x` receives from the `y` of its group.
    ///
    /// * `radiance`: of the paths, from behind `y` where they have one.
    fn combine(
        &self,
        work: &PairBuffers,
        radiance: &Vectors,
        sums: &mut [Rgb<f32>; WAVEFRONT_SIZE],
    ) {
        let pairs = &*work.pairs;
        let [light, sampled] = &pairs.values_at_y;
        for &(j, from, to) in &work.rows {
            let row = || (from..to.min(WAVEFRONT_SIZE)).filter(|&k| pairs.p[k] > 0.0);
            let (mut area, mut at_light, mut at_sampled) = (0.0, 0.0, 0.0);
            for k in row() {
                area += pairs.p[k];
                at_light += pairs.p[k] * light.pdf[k];
                at_sampled += pairs.p[k] * sampled.pdf[k];
            }
            if area.is_nan() || area <= 0.0 {
                continue;
            }
            let lit = self.light_at(j, at_light / area) * (1.0 / area);
            let along = if at_sampled > 0.0 {
                self.radiance_along_sample(j, at_sampled / area, radiance) * (1.0 / at_sampled)
            } else {
                Rgb::BLACK
            };
            for k in row() {
                let arrives = light.f.colour(k) * lit + sampled.f.colour(k) * along;
                sums[index(pairs.x[k])] += pairs.f.colour(k) * arrives;
            }
        }
    }

    /// The light sample at a `y`, with its MIS weight.
    ///
    /// * `density`: of its direction, by the lobes of the group.
    fn light_at(&self, j: usize, density: f32) -> Rgb<f32> {
        let pdf = self.light_pdf[j];
        if pdf <= 0.0 {
            return Rgb::BLACK;
        }
        let weight = estimator::light_weight(Strategy::Mis, self.light_delta[j], pdf, density);
        self.light.colour(j) * weight
    }

    /// Radiance along the direction that was sampled at a `y`.
    ///
    /// * `density`: of the direction, by the lobes of the group.
    fn radiance_along_sample(&self, j: usize, density: f32, radiance: &Vectors) -> Rgb<f32> {
        let radiance = radiance.colour(j);
        let throughput = self.throughput_after_y.colour(j);
        let over = |a: f32, b: f32| if b > 0.0 { a / b } else { 0.0 };
        let mut sum = rgb(
            over(radiance.r, throughput.r),
            over(radiance.g, throughput.g),
            over(radiance.b, throughput.b),
        );
        let hits = &self.emission_hits;
        let first = hits.partition_point(|hit| hit.path < j);
        for hit in hits[first..].iter().take_while(|hit| hit.path == j) {
            let weight = estimator::mis_weight(Strategy::Mis, density, hit.light_pdf);
            sum += hit.radiance * (weight * self.roulette[j]);
        }
        sum
    }
}

impl PathTracer<'_> {
    /// Lets the paths of a wavefront that have ended share their `y`.
    ///
    /// * `sizes`: of the groups, one behind the other.
    pub(crate) fn share(&self, wavefront: &mut Wavefront, sizes: &[usize]) {
        let (Some(mut shared), Some(mut work)) = (wavefront.shared.take(), wavefront.pairs.take())
        else {
            return;
        };
        let mut sums = [Rgb::BLACK; WAVEFRONT_SIZE];
        let mut begin = 0;
        shared.emission_hits.sort_by_key(|hit| hit.path);
        let all = sizes.iter().sum::<usize>().min(WAVEFRONT_SIZE);
        for (local, w) in (work.wi_at_y.iter_mut()).zip([&shared.light_wi, &shared.sampled_wi]) {
            connect::to_local(all, &shared.y, w, local);
        }
        // As many groups at once as the batch has room for pairs.
        let mut rest = sizes;
        while !rest.is_empty() {
            work.pairs.count = 0;
            work.rows.clear();
            let (mut pairs, mut taken) = (0, 0);
            while let Some(&size) = rest.get(taken) {
                if taken > 0 && pairs + size * size > WAVEFRONT_SIZE {
                    break;
                }
                pairs += size * size;
                work.list(&shared, begin..begin + size);
                begin += size;
                taken += 1;
            }
            rest = &rest[taken..];
            connect::connect(&shared.x, &shared.y, &shared.wo, &mut work.pairs);
            self.evaluate_x(&shared, &mut work);
            wavefront.tally.rays += self.trace_pairs(&mut work);
            self.evaluate_y(&shared, &mut work);
            shared.combine(&work, &wavefront.paths.radiance, &mut sums);
        }
        for (path, sum) in sums.iter().enumerate().take(begin) {
            let own = if shared.has_y(path) {
                shared.radiance_before_y.colour(path)
            } else {
                wavefront.paths.radiance.colour(path)
            };
            // Light at a `y` was scattered there and at `x` at least.
            let received =
                estimator::clamp_indirect(shared.throughput.colour(path) * *sum, 2, self.bound);
            let sum = if shared.has_x[path] {
                own + received
            } else {
                own
            };
            wavefront.paths.radiance.set_colour(path, sum);
        }
        wavefront.shared = Some(shared);
        wavefront.pairs = Some(work);
    }

    /// Evaluates the lobes of the `x`.
    fn evaluate_x(&self, shared: &Shared, work: &mut PairBuffers) {
        let key = |pairs: &Pairs, k: usize| shared.x.key[index(pairs.x[k])];
        work.sort(self.key_count(), |pairs, k| pairs.g[k] > 0.0, key);
        let PairBuffers {
            pairs,
            order,
            wo,
            wi,
            values,
            ..
        } = work;
        connect::gather(order, &pairs.wo_at_x, wo);
        connect::gather(order, &pairs.wi_at_x, wi);
        self.evaluate(&work.ends, wo, wi, values);
        connect::store_values(order, wi, values, (&mut pairs.f, &mut pairs.p));
        connect::to_area_measure(&shared.throughput, pairs);
    }

    /// Evaluates the lobes of the `y`.
    fn evaluate_y(&self, shared: &Shared, work: &mut PairBuffers) {
        let key = |pairs: &Pairs, k: usize| shared.y.key[index(pairs.y[k])];
        work.sort(self.key_count(), |pairs, k| pairs.p[k] > 0.0, key);
        let PairBuffers {
            pairs,
            order,
            wo,
            wi,
            values,
            wi_at_y,
            ..
        } = work;
        let Pairs {
            y,
            wo_at_y,
            values_at_y,
            ..
        } = &mut **pairs;
        connect::gather(order, wo_at_y, wo);
        for (wi_at_y, at_y) in wi_at_y.iter().zip(values_at_y) {
            connect::gather_by_path(order, y, wi_at_y, wi);
            self.evaluate(&work.ends, wo, wi, values);
            connect::store_values(order, wi, values, (&mut at_y.f, &mut at_y.pdf));
        }
    }

    /// How many keys of lobes there are.
    fn key_count(&self) -> usize {
        2 * self.scene.materials.count()
    }

    /// Evaluates lobes of sorted pairs.
    ///
    /// * `ends`: of each key.
    fn evaluate(&self, ends: &[u32], wo: &Vectors, wi: &Vectors, values: &mut LobeValues) {
        let mut from = 0;
        for (key, &end) in (0..).zip(&ends[..self.key_count()]) {
            let to = (end as usize).min(WAVEFRONT_SIZE);
            if to == from {
                continue;
            }
            if let Some(sides) = self.scene.materials.plain(key / 2) {
                lobes::eval_pdf(
                    &sides[(key % 2) as usize].lobe,
                    wo.directions(from..to),
                    wi.directions(from..to),
                    &mut [],
                    values.f.colours_mut(from..to),
                    &mut values.pdf[from..to],
                );
            }
            from = to;
        }
    }

    /// Removes the pairs that are occluded from each other; returns how many rays were traced.
    fn trace_pairs(&self, work: &mut PairBuffers) -> u64 {
        let PairBuffers {
            pairs,
            rays,
            occluded,
            ..
        } = work;
        rays.clear();
        for k in 0..pairs.count.min(WAVEFRONT_SIZE) {
            if pairs.x[k] != pairs.y[k] && pairs.p[k] > 0.0 {
                let ray = Ray {
                    origin: pairs.origin.get(k),
                    direction: pairs.direction.get(k),
                    t_max: estimator::SHADOW_RAY_END,
                };
                rays.push(id(k), &ray);
            }
        }
        self.scene
            .geometry
            .accel
            .occluded_block(rays.rays(), occluded);
        for (r, _) in occluded
            .iter()
            .enumerate()
            .filter(|(_, occluded)| **occluded)
        {
            pairs.p[rays.index(r)] = 0.0;
        }
        rays.len() as u64
    }
}
