//! Where in the microsurface a walk collides, given its directions alone: our state without
//! cancellation.
//!
//! Let `l = |Lambda(d)|` be the rate of a flight (see `walk`). The depth of the k-th collision,
//! given `d_0 .. d_{k-1}` and that the walk has not left, is a mixture
//!
//! ```text
//! sum_j c_j Hypoexponential(l_j, .., l_N)          all c_j >= 0,  sum_j c_j = mass not yet left
//! ```
//!
//! of sums of independent exponential layers. Every layer is memoryless, which gives the updates:
//!
//! ```text
//! down (rate l):  one more layer below:       append l, c = 0 ... the depth grows by Exp(l)
//! up (rate L):    climbs Exp(L), topmost layer last. Within the layer j it is met by a facet with
//!                 probability L / (L + l_j), and what is left of the layer is again Exp(l_j):
//!                     r = (c_j + carry) / (L + l_j),   c_j = L r,   carry = l_j r,   j = 1..N
//!                 the last carry is the mass that leaves
//! exit (rate L):  that mass alone:            s = (s + c_j) l_j / (l_j + L)
//! ```
//!
//! All terms are positive: nothing cancels, and equal rates are no special case (Bitterli and
//! d'Eon 2022, whose hyperexponential form has `l_i - l_j` in denominators, and Cui et al. 2023,
//! whose `S_k` times the product of rates is `exit`, need care there).

use crate::math::Real;

/// Layers that the state can hold: one for each downward flight.
pub(crate) const LAYERS: usize = 48;

/// The mixture of the module's text.
#[derive(Clone, Debug)]
pub struct DepthState<T> {
    rates: [T; LAYERS],
    masses: [T; LAYERS],
    layers: usize,
}

impl<T: Real> DepthState<T> {
    /// The first collision of a ray that enters at the rate `rate`: `Exp(rate)`, mass 1.
    #[inline(always)]
    #[must_use]
    pub fn new(rate: T) -> Self {
        let mut state = Self {
            rates: [T::ZERO; LAYERS],
            masses: [T::ZERO; LAYERS],
            layers: 1,
        };
        state.rates[0] = rate;
        state.masses[0] = T::ONE;
        state
    }

    /// The mixture of these layers, rates and masses; at least one, and no more than it can hold.
    #[inline(always)]
    pub(crate) fn of_layers(layers: impl Iterator<Item = (T, T)>) -> Self {
        let mut state = Self::new(T::ONE);
        state.layers = 0;
        for (rate, mass) in layers {
            state.rates[state.layers] = rate;
            state.masses[state.layers] = mass;
            state.layers += 1;
        }
        state
    }

    /// A downward flight to the next collision. Returns `false` where there is no room for it.
    #[inline(always)]
    #[must_use]
    pub fn down(&mut self, rate: T) -> bool {
        if self.layers == LAYERS {
            return false;
        }
        self.rates[self.layers] = rate;
        self.masses[self.layers] = T::ZERO;
        self.layers += 1;
        true
    }

    /// An upward flight to the next collision, if there is one. Returns the mass that leaves.
    #[inline(always)]
    pub fn up(&mut self, rate: T) -> T {
        let mut carry = T::ZERO;
        for (l, c) in self.rates.iter().zip(&mut self.masses).take(self.layers) {
            let r = (*c + carry) / (rate + *l);
            *c = rate * r;
            carry = *l * r;
        }
        carry
    }

    /// The mass that an upward flight would lead out.
    #[inline(always)]
    #[must_use]
    pub fn exit(&self, rate: T) -> T {
        let mut leaving = T::ZERO;
        for (l, c) in self.rates.iter().zip(&self.masses).take(self.layers) {
            leaving = (leaving + *c) * (*l / (*l + rate));
        }
        leaving
    }

    /// Scales all masses.
    #[inline(always)]
    pub fn scale(&mut self, factor: T) {
        for c in self.masses.iter_mut().take(self.layers) {
            *c *= factor;
        }
    }

    /// The mass that has not left.
    #[inline(always)]
    #[must_use]
    pub fn mass(&self) -> T {
        let mut sum = T::ZERO;
        for c in self.masses.iter().take(self.layers) {
            sum += *c;
        }
        sum
    }

    /// A depth `tau` of the mixture (its mass taken as 1).
    ///
    /// * `choice`: uniform in `[0, 1)`, chooses the component.
    /// * `next`: uniform random numbers in `[0, 1)`, one for each layer.
    #[inline]
    pub fn sample_depth(&self, choice: T, mut next: impl FnMut() -> T) -> T {
        let mut left = choice * self.mass();
        let mut depth = T::ZERO;
        let mut inside = false;
        for j in 0..self.layers {
            left -= self.masses[j];
            inside = inside || left < T::ZERO || j + 1 == self.layers;
            if inside {
                depth -= (T::ONE - next()).ln() / self.rates[j];
            }
        }
        depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Stream;

    /// Share of walks with given rates (`true`: down) that are met by facets at every flight and
    /// leave along the last one, by sampled heights.
    fn brute_force(flights: &[(bool, f64)], n: u32, stream: &mut Stream) -> f64 {
        let mut left = 0_u32;
        for _ in 0..n {
            let mut tau = 0.0_f64;
            let mut out = None;
            for (i, (down, rate)) in flights.iter().enumerate() {
                let step = -(1.0 - stream.next::<f64>()).ln() / rate;
                tau += if *down { step } else { -step };
                if tau < 0.0 {
                    out = Some(i);
                    break;
                }
            }
            left += u32::from(out == Some(flights.len() - 1));
        }
        f64::from(left) / f64::from(n)
    }

    fn by_state(flights: &[(bool, f64)]) -> f64 {
        let mut state = DepthState::new(flights[0].1);
        let (last, middle) = flights[1..].split_last().unwrap();
        for (down, rate) in middle {
            if *down {
                assert!(state.down(*rate));
            } else {
                state.up(*rate);
            }
        }
        state.exit(last.1)
    }

    #[test]
    fn exit_probabilities_are_those_of_sampled_heights() {
        const N: u32 = 200_000;
        let mut stream = Stream::new(11);
        for pattern in 0..64_u32 {
            let mut flights = vec![(true, 1.0 + stream.next::<f64>())];
            for bit in 0..6 {
                let down = pattern >> bit & 1 == 1;
                let rate = 0.1 + 2.0 * stream.next::<f64>() + f64::from(u8::from(down));
                flights.push((down, rate));
            }
            flights.push((false, 0.5));
            let exact = by_state(&flights);
            let sampled = brute_force(&flights, N, &mut stream);
            let sigma = (exact * (1.0 - exact) / f64::from(N)).sqrt();
            assert!(
                (sampled - exact).abs() < 4.5 * sigma + 1e-9,
                "{flights:?}: {sampled} {exact} +- {sigma}"
            );
        }
    }

    #[test]
    fn what_leaves_and_what_stays_are_all() {
        let mut state = DepthState::new(1.3_f64);
        let would = state.exit(0.7);
        let left = state.up(0.7);
        assert!((would - left).abs() < 1e-15);
        assert!((state.mass() + left - 1.0).abs() < 1e-15);
        assert!(state.down(2.0));
        let before = state.mass();
        let left = state.up(0.2);
        assert!((state.mass() + left - before).abs() < 1e-15);
    }

    #[test]
    fn sampled_depths_leave_as_the_state_says() {
        let mut state = DepthState::new(1.3_f64);
        assert!(state.down(1.1));
        state.up(0.6);
        assert!(state.down(1.1));
        let mut stream = Stream::new(3);
        let n = 200_000;
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..n {
            let choice = stream.next();
            let tau = state.sample_depth(choice, || stream.next());
            let out = (-0.9 * tau).exp();
            sum += out;
            squares += out * out;
        }
        let n = f64::from(n);
        let mean = sum / n;
        let sigma = ((squares / n - mean * mean) / n).sqrt();
        let expected = state.exit(0.9) / state.mass();
        assert!((mean - expected).abs() < 4.5 * sigma, "{mean} {expected}");
    }

    #[test]
    fn equal_rates_and_single_precision_cancel_nothing() {
        let flights: Vec<(bool, f64)> = [1.0, 1.0, 1.0, 0.3, 1.0, 1.0, 0.3, 0.2]
            .iter()
            .map(|l| (*l >= 1.0, *l))
            .collect();
        let mut state = DepthState::new(1.0_f32);
        for (down, rate) in &flights[1..flights.len() - 1] {
            #[allow(clippy::cast_possible_truncation, reason = "the f32 twin")]
            let rate = *rate as f32;
            if *down {
                assert!(state.down(rate));
            } else {
                state.up(rate);
            }
        }
        let twin = f64::from(state.exit(0.2));
        assert!((twin / by_state(&flights) - 1.0).abs() < 1e-6);
    }
}
