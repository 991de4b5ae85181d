//! The pairs of an `x` and a `y` of a group: what lies between, and what the one gets of the other.

use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;

use super::super::vertex_batch::{Column, Vectors, WAVEFRONT_SIZE, ZERO};
use super::super::visibility::TO_LIGHT;
use super::super::wavefront::{Queue, Wavefront, index};
use super::super::{PathTracer, bias, power_heuristic};
use super::{Shared, connect};
use crate::accel::Ray;
use crate::convert::id;
use crate::material::lobes;

/// What a lobe makes of a direction: `f |cos|` and density.
pub(super) struct Found {
    pub(super) f: Vectors,
    pub(super) pdf: Column,
}

/// Pairs of an `x` and a `y` of a group, side by side; those of one `y` in a row.
pub(super) struct Pairs {
    pub(super) count: usize,
    /// Paths of `x` and of `y`.
    pub(super) x: [u32; WAVEFRONT_SIZE],
    pub(super) y: [u32; WAVEFRONT_SIZE],
    /// Cosine at `y` over squared distance, in the units of `y`'s own path; 0 where the two are too close or
    /// turned away from each other.
    pub(super) g: Column,
    /// At `x`, local: towards its viewer and towards `y`.
    pub(super) at_x: [Vectors; 2],
    /// At `y`, local: towards `x`.
    pub(super) back: Vectors,
    /// The ray between them.
    pub(super) origin: Vectors,
    pub(super) along: Vectors,
    /// `f |cos|` at `x` times `g`.
    pub(super) f: Vectors,
    /// Density of `y`; 0 where something stands between.
    pub(super) p: Column,
    /// At `y`: towards the light, and in the direction that was sampled.
    behind: [Found; 2],
}

/// Room for evaluations.
pub(in super::super) struct Work {
    pairs: Box<Pairs>,
    /// The pairs of each `y`: its path, from, to.
    rows: Vec<(usize, usize, usize)>,
    /// Pairs by the keys of their lobes, and how many there are up to each key.
    order: Vec<u32>,
    ends: Vec<u32>,
    /// In that order: `wo`, `wi`, and what the lobes make of them.
    wo: Vectors,
    wi: Vectors,
    found: Found,
    /// Directions at each `y`, local, by path; 0 where they are on different sides of surface and frame.
    beyond: [Vectors; 2],
    rays: Box<Queue>,
    blocked: Vec<bool>,
}

impl Found {
    const NONE: Self = Self {
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
        at_x: [Vectors::ZERO; 2],
        back: Vectors::ZERO,
        origin: Vectors::ZERO,
        along: Vectors::ZERO,
        f: Vectors::ZERO,
        p: ZERO,
        behind: [Found::NONE; 2],
    };
}

impl Work {
    pub(in super::super) fn new() -> Self {
        Self {
            pairs: Box::new(Pairs::NONE),
            rows: Vec::new(),
            order: Vec::new(),
            ends: Vec::new(),
            wo: Vectors::ZERO,
            wi: Vectors::ZERO,
            found: Found::NONE,
            beyond: [Vectors::ZERO; 2],
            rays: Queue::new(),
            blocked: Vec::new(),
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

    /// The rows and columns of a group.
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
    /// Adds what each `x` gets from the `y` of its group.
    ///
    /// * `radiance`: of the paths, that with a `y` behind it.
    fn combine(&self, work: &Work, radiance: &Vectors, sums: &mut [Rgb<f32>; WAVEFRONT_SIZE]) {
        let pairs = &*work.pairs;
        let [light, sampled] = &pairs.behind;
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
            let beyond = if at_sampled > 0.0 {
                self.found_beyond(j, at_sampled / area, radiance) * (1.0 / at_sampled)
            } else {
                Rgb::BLACK
            };
            for k in row() {
                let arrives = light.f.colour(k) * lit + sampled.f.colour(k) * beyond;
                sums[index(pairs.x[k])] += pairs.f.colour(k) * arrives;
            }
        }
    }

    /// The light that was sampled at a `y`, weighed.
    ///
    /// * `density`: of its direction among the group's.
    fn light_at(&self, j: usize, density: f32) -> Rgb<f32> {
        let pdf = self.light_pdf[j];
        if pdf <= 0.0 {
            return Rgb::BLACK;
        }
        let weight = if self.light_delta[j] {
            1.0
        } else {
            power_heuristic(density / pdf)
        };
        self.light.colour(j) * weight
    }

    /// What came along the direction that was sampled at a `y`.
    ///
    /// * `density`: of the direction among the group's.
    fn found_beyond(&self, j: usize, density: f32, radiance: &Vectors) -> Rgb<f32> {
        let (found, carried) = (radiance.colour(j), self.carried.colour(j));
        let over = |a: f32, b: f32| if b > 0.0 { a / b } else { 0.0 };
        let mut sum = rgb(
            over(found.r, carried.r),
            over(found.g, carried.g),
            over(found.b, carried.b),
        );
        let first = self.met.partition_point(|met| met.path < j);
        for met in self.met[first..].iter().take_while(|met| met.path == j) {
            let weight = power_heuristic(met.light_pdf / density);
            sum += met.radiance * (weight * self.roulette[j]);
        }
        sum
    }
}

impl PathTracer<'_> {
    /// Lets the paths of a wavefront that have ended share what they found.
    ///
    /// * `sizes`: of the groups, one behind the other.
    pub(crate) fn share(&self, wavefront: &mut Wavefront, sizes: &[usize]) {
        let (Some(mut shared), Some(mut work)) = (wavefront.shared.take(), wavefront.pairs.take())
        else {
            return;
        };
        let mut sums = [Rgb::BLACK; WAVEFRONT_SIZE];
        let mut begin = 0;
        shared.met.sort_by_key(|met| met.path);
        let all = sizes.iter().sum::<usize>().min(WAVEFRONT_SIZE);
        for (local, w) in (work.beyond.iter_mut()).zip([&shared.towards, &shared.scatter_samples]) {
            connect::turn(all, &shared.y, w, local);
        }
        // As many groups at once as have pairs for the batch.
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
            wavefront.tally.rays += self.look(&mut work);
            self.evaluate_y(&shared, &mut work);
            shared.combine(&work, &wavefront.paths.radiance, &mut sums);
        }
        for (path, sum) in sums.iter().enumerate().take(begin) {
            let own = if shared.has_y(path) {
                shared.before.colour(path)
            } else {
                wavefront.paths.radiance.colour(path)
            };
            // Light at a `y` was scattered there and at `x` at least.
            let got = bias::bounded(shared.throughput.colour(path) * *sum, 2, self.bound);
            let sum = if shared.has_x[path] { own + got } else { own };
            wavefront.paths.radiance.set_colour(path, sum);
        }
        wavefront.shared = Some(shared);
        wavefront.pairs = Some(work);
    }

    /// Evaluates the lobes of the `x`.
    fn evaluate_x(&self, shared: &Shared, work: &mut Work) {
        let key = |pairs: &Pairs, k: usize| shared.x.key[index(pairs.x[k])];
        work.sort(self.key_count(), |pairs, k| pairs.g[k] > 0.0, key);
        let Work {
            pairs,
            order,
            wo,
            wi,
            found,
            ..
        } = work;
        connect::bring(order, &pairs.at_x[0], wo);
        connect::bring(order, &pairs.at_x[1], wi);
        self.evaluate(&work.ends, wo, wi, found);
        connect::hand_back(order, wi, found, (&mut pairs.f, &mut pairs.p));
        connect::weigh(&shared.throughput, pairs);
    }

    /// Evaluates the lobes of the `y`.
    fn evaluate_y(&self, shared: &Shared, work: &mut Work) {
        let key = |pairs: &Pairs, k: usize| shared.y.key[index(pairs.y[k])];
        work.sort(self.key_count(), |pairs, k| pairs.p[k] > 0.0, key);
        let Work {
            pairs,
            order,
            wo,
            wi,
            found,
            beyond,
            ..
        } = work;
        let Pairs {
            y, back, behind, ..
        } = &mut **pairs;
        connect::bring(order, back, wo);
        for (beyond, behind) in beyond.iter().zip(behind) {
            connect::bring_of(order, y, beyond, wi);
            self.evaluate(&work.ends, wo, wi, found);
            connect::hand_back(order, wi, found, (&mut behind.f, &mut behind.pdf));
        }
    }

    /// How many keys of lobes there are.
    fn key_count(&self) -> usize {
        2 * self.scene.materials.count()
    }

    /// Evaluates lobes of sorted pairs.
    ///
    /// * `ends`: of each key.
    fn evaluate(&self, ends: &[u32], wo: &Vectors, wi: &Vectors, found: &mut Found) {
        let mut from = 0;
        for (key, &end) in (0..).zip(&ends[..self.key_count()]) {
            let to = (end as usize).min(WAVEFRONT_SIZE);
            if to == from {
                continue;
            }
            if let Some(sides) = self.scene.materials.plain(key / 2) {
                lobes::eval_pdf(
                    &sides[(key % 2) as usize].lobe,
                    wo.directions(from, to),
                    wi.directions(from, to),
                    &mut [],
                    found.f.colours_mut(from, to),
                    &mut found.pdf[from..to],
                );
            }
            from = to;
        }
    }

    /// Takes out the pairs that do not see each other; returns how many rays that took.
    fn look(&self, work: &mut Work) -> u64 {
        let Work {
            pairs,
            rays,
            blocked,
            ..
        } = work;
        rays.clear();
        for k in 0..pairs.count.min(WAVEFRONT_SIZE) {
            if pairs.x[k] != pairs.y[k] && pairs.p[k] > 0.0 {
                let ray = Ray {
                    origin: pairs.origin.get(k),
                    direction: pairs.along.get(k),
                    t_max: TO_LIGHT,
                };
                rays.push(id(k), ray);
            }
        }
        self.scene.geometry.accel.occluded_all(rays.rays(), blocked);
        for (r, _) in blocked.iter().enumerate().filter(|(_, blocked)| **blocked) {
            pairs.p[rays.number(r)] = 0.0;
        }
        rays.len() as u64
    }
}
