//! The pairs of an `x` and a `y` of a group: what lies between, and what the one gets of the other.

use specula_bsdf::math::rgb;
use specula_bsdf::{Rgb, Vec3};

use super::super::block::{Block, Queue};
use super::super::lanes::{Column, LANES, Vectors, ZERO};
use super::super::passing::TO_LIGHT;
use super::super::{PathTracer, lobes, power_heuristic};
use super::Shared;
use crate::accel::Ray;
use crate::convert::id;

/// Pairs of an `x` and a `y` of a group.
struct Pair {
    /// Those of `x` and of `y`.
    paths: [usize; 2],
    /// Away from `x`.
    direction: Vec3<f32>,
    /// Cosine at `y` over squared distance, in the units of `y`'s own path.
    g: f32,
    /// `f |cos|` at `x` times `g`.
    f: Rgb<f32>,
    /// Density of `y`; 0 where something stands between.
    p: f32,
    /// `f |cos|` and density at `y` towards the light, and in the direction that was drawn.
    behind: [(Rgb<f32>, f32); 2],
}

/// Room for evaluations.
pub(super) struct Work {
    pairs: Vec<Pair>,
    /// Pairs by the keys of their lobes, and how many there are up to each key.
    order: Vec<u32>,
    ends: Vec<u32>,
    wo: Vectors,
    wi: Vectors,
    f: Vectors,
    pdf: Column,
    rays: Box<Queue>,
    blocked: Vec<bool>,
}

impl Work {
    pub(super) fn new() -> Self {
        Self {
            pairs: Vec::new(),
            order: Vec::new(),
            ends: Vec::new(),
            wo: Vectors::ZERO,
            wi: Vectors::ZERO,
            f: Vectors::ZERO,
            pdf: ZERO,
            rays: Queue::new(),
            blocked: Vec::new(),
        }
    }

    /// Sorts the pairs that have a key by it.
    ///
    /// * `count`: of keys.
    fn sort(&mut self, count: usize, key: impl Fn(&Pair) -> Option<u32>) {
        let Self {
            pairs, order, ends, ..
        } = self;
        ends.clear();
        ends.resize(count + 1, 0);
        for key in pairs.iter().filter_map(&key) {
            ends[key as usize + 1] += 1;
        }
        let mut sum = 0;
        for end in &mut *ends {
            sum += *end;
            *end = sum;
        }
        order.clear();
        order.resize(sum as usize, 0);
        // Where pairs of a key begin becomes where they end.
        for (p, pair) in (0..).zip(pairs.iter()) {
            if let Some(key) = key(pair) {
                let place = &mut ends[key as usize];
                order[*place as usize] = p;
                *place += 1;
            }
        }
    }
}

impl PathTracer<'_> {
    /// Lets the paths of a block that have ended share what they found.
    ///
    /// * `sizes`: of the groups, one behind the other.
    pub(crate) fn share(&self, block: &mut Block, sizes: &[usize]) {
        let Some(mut shared) = block.shared.take() else {
            return;
        };
        let mut sums = [Rgb::BLACK; LANES];
        let mut begin = 0;
        shared.met.sort_by_key(|met| met.path);
        // As many groups at once as have pairs for the lanes.
        let mut rest = sizes;
        while !rest.is_empty() {
            shared.work.pairs.clear();
            let (mut pairs, mut taken) = (0, 0);
            while let Some(&size) = rest.get(taken) {
                if taken > 0 && pairs + size * size > LANES {
                    break;
                }
                pairs += size * size;
                self.pair(&mut shared, begin..begin + size);
                begin += size;
                taken += 1;
            }
            rest = &rest[taken..];
            self.evaluate_x(&mut shared);
            block.tally.rays += self.look(&mut shared);
            for towards in [Towards::Light, Towards::Drawn] {
                self.evaluate_y(&mut shared, towards);
            }
            self.combine(&shared, &block.paths.radiance, &mut sums);
        }
        for (path, sum) in sums.iter().enumerate().take(begin) {
            let own = if shared.has_y(path) {
                shared.before.colour(path)
            } else {
                block.paths.radiance.colour(path)
            };
            block.paths.radiance.set_colour(path, own + *sum);
        }
        block.shared = Some(shared);
    }

    /// Adds all pairs of a group that may see each other, those of one `y` in a row.
    fn pair(&self, shared: &mut Shared, group: core::ops::Range<usize>) {
        for j in group.clone() {
            if !shared.has_y(j) {
                continue;
            }
            let y = shared.y.position.get(j);
            let own = (y - shared.x.position.get(j)).length();
            for i in group.clone() {
                if !shared.has_x[i] || !shared.x.is_far(i, y, shared.y.error[j]) {
                    continue;
                }
                // In units of the own distance: squares of lengths overflow.
                let between = (y - shared.x.position.get(i)) * (1.0 / own);
                let squared = between.dot(between);
                if !(squared > 0.0 && squared < f32::INFINITY) {
                    continue;
                }
                let direction = between * (1.0 / squared.sqrt());
                let cos = -shared.y.facing.get(j).dot(direction);
                if cos <= 0.0 {
                    continue;
                }
                shared.work.pairs.push(Pair {
                    paths: [i, j],
                    direction,
                    g: cos / squared,
                    f: Rgb::BLACK,
                    p: 0.0,
                    behind: [(Rgb::BLACK, 0.0); 2],
                });
            }
        }
    }

    /// Evaluates the lobes of the `x`.
    fn evaluate_x(&self, shared: &mut Shared) {
        let Shared {
            x,
            wo,
            throughput,
            work,
            ..
        } = shared;
        let keys = |pair: &Pair| Some(x.key[pair.paths[0]]);
        let ways = |pair: &Pair| {
            let i = pair.paths[0];
            [wo.get(i), x.local(i, pair.direction)]
        };
        self.evaluate(work, keys, ways, |pair, f, pdf| {
            pair.f = f * pair.g;
            // Paths that carry nothing end, and never reach the point.
            let ends = (throughput.colour(pair.paths[0]) * f).is_black();
            pair.p = if ends { 0.0 } else { pdf * pair.g };
        });
    }

    /// Evaluates the lobes of the `y`.
    fn evaluate_y(&self, shared: &mut Shared, towards: Towards) {
        let Shared {
            y,
            work,
            towards: light,
            light_pdf,
            onward,
            ..
        } = shared;
        let wanted = |pair: &Pair| {
            let j = pair.paths[1];
            let is_there = match towards {
                Towards::Light => light_pdf[j] > 0.0,
                Towards::Drawn => onward.get(j) != Vec3::ZERO,
            };
            (pair.p > 0.0 && is_there).then(|| y.key[j])
        };
        let ways = |pair: &Pair| {
            let j = pair.paths[1];
            let wi = match towards {
                Towards::Light => light.get(j),
                Towards::Drawn => onward.get(j),
            };
            [y.frame(j).to_local(-pair.direction), y.local(j, wi)]
        };
        self.evaluate(work, wanted, ways, |pair, f, pdf| {
            pair.behind[towards as usize] = (f, pdf);
        });
    }

    /// Evaluates lobes of pairs, many of one key at once.
    ///
    /// * `key`: of the lobe; `None`: not wanted.
    /// * `ways`: `wo` and `wi` there, local.
    fn evaluate(
        &self,
        work: &mut Work,
        key: impl Fn(&Pair) -> Option<u32>,
        ways: impl Fn(&Pair) -> [Vec3<f32>; 2],
        mut done: impl FnMut(&mut Pair, Rgb<f32>, f32),
    ) {
        let count = 2 * self.scene.materials.count();
        work.sort(count, key);
        let Work {
            pairs,
            order,
            ends,
            wo,
            wi,
            f,
            pdf,
            ..
        } = work;
        let mut from = 0;
        for (key, &end) in (0..).zip(&ends[..count]) {
            let alike = &order[from..end as usize];
            from = end as usize;
            let Some(sides) = self.scene.materials.plain(key / 2) else {
                continue;
            };
            let lobe = &sides[(key % 2) as usize].lobe;
            for some in alike.chunks(LANES) {
                let n = some.len();
                for (lane, &p) in some.iter().enumerate() {
                    let [o, i] = ways(&pairs[p as usize]);
                    wo.set(lane, o);
                    wi.set(lane, i);
                }
                lobes::eval_pdf(
                    lobe,
                    wo.directions(0, n),
                    wi.directions(0, n),
                    &mut [],
                    f.colours_mut(0, n),
                    &mut pdf[..n],
                );
                for (lane, &p) in some.iter().enumerate() {
                    // Zero is no direction.
                    let there = wi.get(lane) != Vec3::ZERO && pdf[lane] > 0.0;
                    let found = if there { f.colour(lane) } else { Rgb::BLACK };
                    let density = if there { pdf[lane] } else { 0.0 };
                    done(&mut pairs[p as usize], found, density);
                }
            }
        }
    }

    /// Takes out the pairs that do not see each other; returns how many rays that took.
    fn look(&self, shared: &mut Shared) -> u64 {
        let Shared { x, y, work, .. } = shared;
        let Work {
            pairs,
            order,
            rays,
            blocked,
            ..
        } = work;
        order.clear();
        let apart = |pair: &Pair| pair.paths[0] != pair.paths[1] && pair.p > 0.0;
        order.extend((0..id(pairs.len())).filter(|&p| apart(&pairs[p as usize])));
        let mut count = 0;
        for some in order.chunks(LANES) {
            rays.clear();
            for &p in some {
                let Pair {
                    paths: [i, j],
                    direction,
                    ..
                } = pairs[p as usize];
                let origin = x.leave(i, direction);
                let ray = Ray {
                    origin,
                    direction: y.leave(j, -direction) - origin,
                    t_max: TO_LIGHT,
                };
                rays.push(p, ray);
            }
            count += some.len() as u64;
            self.scene.geometry.accel.occluded_all(rays.rays(), blocked);
            for (&p, &blocked) in some.iter().zip(blocked.iter()) {
                if blocked {
                    pairs[p as usize].p = 0.0;
                }
            }
        }
        count
    }

    /// Adds what each `x` gets from the `y` of its group.
    ///
    /// * `radiance`: of the paths, that with a `y` behind it.
    fn combine(&self, shared: &Shared, radiance: &Vectors, sums: &mut [Rgb<f32>; LANES]) {
        let pairs = &shared.work.pairs;
        for row in pairs.chunk_by(|a, b| a.paths[1] == b.paths[1]) {
            let (mut area, mut at_light, mut at_drawn) = (0.0, 0.0, 0.0);
            for pair in row {
                area += pair.p;
                at_light += pair.p * pair.behind[0].1;
                at_drawn += pair.p * pair.behind[1].1;
            }
            let Some(j) = row.first().map(|pair| pair.paths[1]) else {
                continue;
            };
            if area.is_nan() || area <= 0.0 {
                continue;
            }
            let light = self.shared_light(shared, j, at_light / area) * (1.0 / area);
            let drawn = if at_drawn > 0.0 {
                self.shared_beyond(shared, j, at_drawn / area, radiance) * (1.0 / at_drawn)
            } else {
                Rgb::BLACK
            };
            for pair in row.iter().filter(|pair| pair.p > 0.0) {
                let i = pair.paths[0];
                let arrives = pair.behind[0].0 * light + pair.behind[1].0 * drawn;
                sums[i] += shared.throughput.colour(i) * pair.f * arrives;
            }
        }
    }

    /// The light that was drawn at a `y`, weighed.
    ///
    /// * `density`: of its direction among the group's.
    fn shared_light(&self, shared: &Shared, j: usize, density: f32) -> Rgb<f32> {
        let pdf = shared.light_pdf[j];
        if pdf <= 0.0 {
            return Rgb::BLACK;
        }
        let weight = if shared.light_delta[j] {
            1.0
        } else {
            power_heuristic(density / pdf)
        };
        shared.light.colour(j) * weight
    }

    /// What came along the direction that was drawn at a `y`.
    ///
    /// * `density`: of the direction among the group's.
    fn shared_beyond(
        &self,
        shared: &Shared,
        j: usize,
        density: f32,
        radiance: &Vectors,
    ) -> Rgb<f32> {
        let (found, carried) = (radiance.colour(j), shared.carried.colour(j));
        let over = |a: f32, b: f32| if b > 0.0 { a / b } else { 0.0 };
        let mut sum = rgb(
            over(found.r, carried.r),
            over(found.g, carried.g),
            over(found.b, carried.b),
        );
        let first = shared.met.partition_point(|met| met.path < j);
        for met in shared.met[first..].iter().take_while(|met| met.path == j) {
            let weight = power_heuristic(met.light_pdf / density);
            sum += met.radiance * (weight * shared.roulette[j]);
        }
        sum
    }
}

/// Which direction at a `y`.
#[derive(Clone, Copy)]
enum Towards {
    Light,
    Drawn,
}
