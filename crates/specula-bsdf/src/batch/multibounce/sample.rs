//! Directions sampled by walks in batches.

use super::walk_states::{
    BOUNCES, FEW, Index, Metal, NO_STREAMS, PerWalk, WALKS, Walks, index, next_if, whole,
};
use crate::batch::slices::{Colours, Directions};
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::multibounce::stratified_bidirectional::SampleWalk;

/// Some elements, one a walk, and their walks.
pub(super) struct SampleWalks<T> {
    pub(super) wo: Directions<PerWalk<T>>,
    /// `(0, 0, 0)` of a walk that was given up.
    pub(super) wi: Directions<PerWalk<T>>,
    pub(super) weight: Colours<PerWalk<T>>,
    streams: [Stream; WALKS],
    walks: Walks<T>,
    /// What masses are scaled by.
    scale: PerWalk<T>,
}

impl<T: Real> SampleWalks<T> {
    /// No elements.
    pub(super) const NONE: Self = Self {
        wo: Directions::<PerWalk<T>>::NONE,
        wi: Directions::<PerWalk<T>>::NONE,
        weight: Colours::<PerWalk<T>>::NONE,
        streams: NO_STREAMS,
        walks: Walks::NONE,
        scale: [T::ONE; WALKS],
    };

    /// Samples for [`WALKS`] elements at most.
    ///
    /// * `u`: samples the first facets.
    #[inline(always)]
    pub(super) fn sample<S: Real>(
        &mut self,
        facets: &Metal<T>,
        wo: Directions<&[S]>,
        u: [&[S]; 2],
        streams: &mut [Stream],
    ) {
        let mut going = streams.len().min(WALKS);
        let count = going;
        for i in 0..count {
            self.wo.put(i, wo.get_as(i));
            self.walks.d.put(i, -self.wo.at(i));
            self.walks.weight.put(i, Rgb::WHITE);
            self.walks.masses[0][i] = T::ONE;
            self.walks.element[i] = index(i);
        }
        for (own, u) in self.walks.u.iter_mut().zip(u) {
            for (own, u) in own.iter_mut().zip(u) {
                *own = T::of(u.to_f64());
            }
        }
        for i in 0..whole(count) {
            self.walks.rates[0][i] = facets.arriving(self.wo.at(i)).rate;
        }
        self.streams[..count].clone_from_slice(&streams[..count]);
        self.walks.streams[..count].clone_from_slice(&streams[..count]);
        let mut bounces = 0;
        while going > FEW && bounces < BOUNCES {
            bounces += 1;
            going = self.bounce(facets, bounces, going);
        }
        for i in 0..going {
            self.finish(facets, bounces, i);
        }
        streams[..count].clone_from_slice(&self.streams[..count]);
    }

    /// Returns the number of walks that go on.
    #[inline(always)]
    fn bounce(&mut self, facets: &Metal<T>, bounces: usize, count: usize) -> usize {
        let count = count.min(WALKS);
        self.walks.bounce::<false>(facets, bounces, count);
        self.walks.fly::<false>(bounces + 1, count);
        let walks = &mut self.walks;
        for i in 0..whole(count) {
            walks.u[0][i] = next_if(&mut walks.streams[i], walks.climb[i] > T::ZERO);
        }
        for i in 0..whole(count) {
            let (up, left, mass) = (walks.climb[i] > T::ZERO, walks.left[i], walks.mass[i]);
            let leaves = up & (walks.u[0][i] * (left + mass) < left);
            walks.goes_on[i] = Index::from(!leaves);
            // What stays is all there is.
            self.scale[i] = T::select(up, T::ONE / mass, T::ONE);
        }
        for masses in walks.masses.iter_mut().take(bounces + 1) {
            for (mass, scale) in masses[..whole(count)].iter_mut().zip(&self.scale) {
                *mass *= *scale;
            }
        }
        for i in 0..count {
            self.streams[usize::from(walks.element[i])] = walks.streams[i].clone();
        }
        let going = walks.sort::<true>(count);
        for ended in 0..count.saturating_sub(going) {
            let i = usize::from(walks.order[WALKS - 1 - ended]);
            let e = usize::from(walks.element[i]);
            self.wi.put(e, walks.d.at(i));
            self.weight.put(e, walks.weight.at(i));
        }
        for j in 0..going {
            let e = walks.element[usize::from(walks.order[j])];
            walks.element[j] = e;
            walks.streams[j] = self.streams[usize::from(e)].clone();
        }
        walks.move_up::<false>(bounces + 1, going);
        walks.sample_facets(going);
        going
    }

    /// The walk `i` goes on alone.
    #[inline(always)]
    fn finish(&mut self, facets: &Metal<T>, bounces: usize, i: usize) {
        let walks = &mut self.walks;
        let e = usize::from(walks.element[i]);
        let (state, flight) = walks.state(facets, bounces + 1, i);
        let walk = SampleWalk {
            bounces,
            state,
            flight,
            weight: walks.weight.at(i),
        };
        let u = [walks.u[0][i], walks.u[1][i]];
        let sampled = walk.finish(facets, u, &mut walks.streams[i]);
        let (wi, weight) = sampled.unwrap_or((Vec3::ZERO, Rgb::BLACK));
        self.wi.put(e, wi);
        self.weight.put(e, weight);
        self.streams[e] = walks.streams[i].clone();
    }
}
