//! Estimates of `f cos` by walks in batches.
//!
//! Each element takes its values in the order of the scalar function, one walk after another: what
//! stands in batches together is the same walk of different elements.

use super::walk_states::{
    BOUNCES, FEW, Index, Metal, NO_STREAMS, PerWalk, WALKS, Walks, next_if, reflect, whole,
};
use crate::batch::slices::{Colours, Directions};
use crate::math::{Real, Stream, Vec3};
use crate::multibounce::stratified_bidirectional::{EvalWalk, SPLIT, goes_on, share, stratum};
use crate::multibounce::walk::{Flight, LEAST_COS, meet, turn};
use crate::ndf::{Ggx, Ndf};

/// Some elements, one a walk, and their walks.
pub(super) struct EvalWalks<T> {
    wo: Directions<PerWalk<T>>,
    wi: Directions<PerWalk<T>>,
    streams: [Stream; WALKS],
    f_cos: Colours<PerWalk<T>>,
    /// Shift of the strata.
    shift: [PerWalk<T>; 2],
    /// What the walk under way, or the last one, has contributed.
    sum: Colours<PerWalk<T>>,
    walks: Walks<T>,
    contribution: Colours<PerWalk<T>>,
    /// What the reflectance of a connection is multiplied by.
    scale: PerWalk<T>,
    /// Probability of going on; negative where there is no walk.
    chance: PerWalk<T>,
}

impl<T: Real> EvalWalks<T> {
    /// No elements.
    pub(super) const NONE: Self = Self {
        wo: Directions::<PerWalk<T>>::NONE,
        wi: Directions::<PerWalk<T>>::NONE,
        streams: NO_STREAMS,
        f_cos: Colours::<PerWalk<T>>::NONE,
        shift: [[T::ZERO; WALKS]; 2],
        sum: Colours::<PerWalk<T>>::NONE,
        walks: Walks::NONE,
        contribution: Colours::<PerWalk<T>>::NONE,
        scale: [T::ZERO; WALKS],
        chance: [T::ZERO; WALKS],
    };

    /// Estimates for [`WALKS`] elements at most; black where `wi.z <= 0`.
    #[inline(always)]
    pub(super) fn eval<S: Real>(
        &mut self,
        facets: &Metal<T>,
        wo: Directions<&[S]>,
        wi: Directions<&[S]>,
        streams: &mut [Stream],
        mut f_cos: Colours<&mut [S]>,
    ) {
        let count = streams.len().min(WALKS);
        for i in 0..count {
            self.wo.put(i, wo.get_as(i));
            self.wi.put(i, wi.get_as(i));
        }
        self.streams[..count].clone_from_slice(&streams[..count]);
        self.start(facets, count);
        for k in 0..SPLIT {
            for reversed in [false, true] {
                self.walk(facets, k, reversed, count);
            }
        }
        streams[..count].clone_from_slice(&self.streams[..count]);
        for i in 0..count {
            f_cos.set_from(i, self.f_cos.at(i));
        }
    }

    /// One bounce in closed form, and the shifts.
    #[inline(always)]
    fn start(&mut self, facets: &Metal<T>, count: usize) {
        let ndf = &facets.ndf;
        for i in 0..whole(count) {
            let arriving = facets.arriving(self.wo.at(i));
            let leaving = Flight::new(ndf, self.wi.at(i));
            let (cos, quarter_d) = turned(ndf, arriving.d, leaving.d);
            let exit = arriving.rate / (arriving.rate + leaving.rate);
            let single = quarter_d / arriving.facing * exit;
            self.walks.cos[i] = cos;
            self.scale[i] = T::select(leaving.d.z > T::ZERO, single, T::ZERO);
        }
        let walks = &mut self.walks;
        reflect(&facets.reflectance, &walks.cos, &mut walks.fresnel, count);
        for i in 0..whole(count) {
            self.f_cos.put(i, walks.fresnel.at(i) * self.scale[i]);
        }
        for shift in &mut self.shift {
            for (i, shift) in shift[..whole(count)].iter_mut().enumerate() {
                *shift = next_if(&mut self.streams[i], self.wi.z[i] > T::ZERO);
            }
        }
    }

    /// Whether the element has a walk from that end: lights below the horizon have none, views below
    /// no other end.
    #[inline(always)]
    fn has_walk(&self, reversed: bool, i: usize) -> bool {
        let is_seen = (self.wo.z[i] > T::ZERO) | !reversed;
        (self.wi.z[i] > T::ZERO) & is_seen
    }

    /// The `k`-th walk of every element, from `wo` or (`reversed`) from `wi`.
    #[inline(always)]
    fn walk(&mut self, facets: &Metal<T>, k: usize, reversed: bool, count: usize) {
        self.first_bounce(facets, k, reversed, count);
        self.connect(facets, count);
        for i in 0..whole(count) {
            self.sum.put(i, self.contribution.at(i));
            self.chance[i] = T::select(self.has_walk(reversed, i), self.chance[i], -T::ONE);
        }
        let Walks { u, goes_on, .. } = &mut self.walks;
        play(&self.chance, &mut self.streams, &mut u[0], goes_on, count);
        let mut going = self.walks.sort::<false>(count);
        for j in 0..going {
            let i = self.walks.order[j];
            self.walks.element[j] = i;
            self.walks.streams[j] = self.streams[usize::from(i)].clone();
        }
        self.walks.move_up::<true>(2, going);
        self.walks.sample_facets(going);
        let mut bounces = 1;
        while going > FEW && bounces < BOUNCES {
            bounces += 1;
            going = self.bounce(facets, bounces, going);
        }
        for i in 0..going {
            self.finish(facets, bounces, i);
        }
        let least = T::of(LEAST_COS);
        for i in 0..whole(count) {
            let back = if reversed {
                self.wi.z[i].at_least(least) / self.wo.z[i].at_least(least)
            } else {
                T::ONE
            };
            let before = self.f_cos.at(i);
            let after = before + self.sum.at(i) * back;
            let has_walk = self.has_walk(reversed, i);
            self.f_cos
                .put(i, after.zip(before, |a, b| T::select(has_walk, a, b)));
        }
    }

    /// The first bounce, with its depths.
    #[inline(always)]
    fn first_bounce(&mut self, facets: &Metal<T>, k: usize, reversed: bool, count: usize) {
        let (from, to) = if reversed {
            (&self.wi, &self.wo)
        } else {
            (&self.wo, &self.wi)
        };
        let walks = &mut self.walks;
        for i in 0..whole(count) {
            walks.d.put(i, -from.at(i));
            walks.target.put(i, to.at(i));
        }
        let [zeroth, first, ..] = &mut walks.rates;
        let [met, none, ..] = &mut walks.masses;
        let ndf = &facets.ndf;
        for i in 0..whole(count) {
            let arriving = Flight::new(ndf, walks.d.at(i));
            let leaving = Flight::new(ndf, walks.target.at(i));
            let u = stratum([self.shift[0][i], self.shift[1][i]], k);
            let (wm, cos, next) = meet(ndf, arriving.d, u);
            walks.cos[i] = cos;
            walks.d.put(i, next.d);
            walks.facing[i] = next.facing;
            walks.target_rate[i] = leaving.rate;
            // 0 where there is no other end: no rivals.
            let step = T::of(4.0) / (ndf.d(wm) * leaving.backing);
            let is_seen = self.wo.z[i] > T::ZERO;
            walks.quotient[i] = T::select(is_seen, arriving.facing * step, T::ZERO);
            let up = next.is_upward();
            let layer = T::select(up, T::ZERO, next.rate);
            let climbing = next.rate * (T::ONE / (next.rate + arriving.rate));
            let mass = T::select(up, climbing, T::ONE);
            (zeroth[i], met[i]) = (arriving.rate, mass);
            (first[i], none[i]) = (layer, T::ZERO);
            walks.mass[i] = mass;
            let exit = mass * (arriving.rate / (arriving.rate + leaving.rate));
            let below = exit * (layer / (layer + leaving.rate));
            walks.exit[i] = T::select(up, exit, below);
        }
        reflect(&facets.reflectance, &walks.cos, &mut walks.fresnel, count);
        for i in 0..whole(count) {
            walks.weight.put(i, share::<T>() * walks.fresnel.at(i));
        }
    }

    /// A later bounce. Returns the number of walks that go on.
    #[inline(always)]
    fn bounce(&mut self, facets: &Metal<T>, bounces: usize, count: usize) -> usize {
        let count = count.min(WALKS);
        self.walks.bounce::<true>(facets, bounces, count);
        self.walks.fly::<true>(bounces + 1, count);
        self.connect(facets, count);
        let Walks {
            streams,
            u,
            goes_on,
            ..
        } = &mut self.walks;
        play(&self.chance, streams, &mut u[0], goes_on, count);
        for i in 0..count {
            let e = usize::from(self.walks.element[i]);
            self.sum.r[e] += self.contribution.r[i];
            self.sum.g[e] += self.contribution.g[i];
            self.sum.b[e] += self.contribution.b[i];
            self.streams[e] = self.walks.streams[i].clone();
        }
        let going = self.walks.sort::<false>(count);
        for j in 0..going {
            let e = self.walks.element[usize::from(self.walks.order[j])];
            self.walks.element[j] = e;
            self.walks.streams[j] = self.streams[usize::from(e)].clone();
        }
        self.walks.move_up::<true>(bounces + 1, going);
        self.walks.sample_facets(going);
        going
    }

    /// Contributions, and the chances of going on.
    #[inline(always)]
    fn connect(&mut self, facets: &Metal<T>, count: usize) {
        let walks = &mut self.walks;
        for i in 0..whole(count) {
            let (cos, quarter_d) = turned(&facets.ndf, walks.d.at(i), walks.target.at(i));
            let rivals = T::ONE + quarter_d * walks.quotient[i];
            walks.cos[i] = cos;
            self.scale[i] = quarter_d * walks.exit[i] / (walks.facing[i] * rivals);
        }
        reflect(&facets.reflectance, &walks.cos, &mut walks.fresnel, count);
        for i in 0..whole(count) {
            let weight = walks.weight.at(i);
            let contribution = weight * walks.fresnel.at(i) * self.scale[i];
            self.contribution.put(i, contribution);
            let chance = goes_on(weight, walks.mass[i]);
            self.chance[i] = chance;
            let factor = T::select(chance < T::ONE, T::ONE / chance, T::ONE);
            walks.weight.put(i, weight * factor);
        }
    }

    /// The walk `i` goes on alone.
    #[inline(always)]
    fn finish(&mut self, facets: &Metal<T>, bounces: usize, i: usize) {
        let walks = &mut self.walks;
        let e = usize::from(walks.element[i]);
        let (state, flight) = walks.state(facets, bounces + 1, i);
        let walk = EvalWalk {
            bounces,
            state,
            flight,
            weight: walks.weight.at(i),
            quotient: walks.quotient[i],
            sum: self.sum.at(e),
        };
        let leaving = Flight::new(&facets.ndf, walks.target.at(i));
        let u = [walks.u[0][i], walks.u[1][i]];
        let sum = walk.finish::<_, true>(facets, &leaving, u, &mut walks.streams[i]);
        self.sum.put(e, sum);
        self.streams[e] = walks.streams[i].clone();
    }
}

/// [`turn`] as values: 0 where no facet turns `d` to `wi`.
#[inline(always)]
fn turned<T: Real>(ndf: &Ggx<T>, d: Vec3<T>, wi: Vec3<T>) -> (T, T) {
    turn(ndf, d, wi).unwrap_or((T::ZERO, T::ZERO))
}

/// Roulette, where it is played.
#[inline(always)]
fn play<T: Real>(
    chance: &PerWalk<T>,
    streams: &mut [Stream; WALKS],
    u: &mut PerWalk<T>,
    goes_on: &mut PerWalk<Index>,
    count: usize,
) {
    for i in 0..whole(count) {
        let p = chance[i];
        u[i] = next_if(&mut streams[i], (p >= T::ZERO) & (p < T::ONE));
    }
    for i in 0..whole(count) {
        let p = chance[i];
        goes_on[i] = Index::from((p >= T::ONE) | (u[i] < p));
    }
}
