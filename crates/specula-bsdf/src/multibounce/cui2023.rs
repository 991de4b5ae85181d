//! Cui, Pan, Yang, Zhang, Yan and Wang 2023, Multiple-bounce Smith Microfacet BRDFs using the
//! Invariance Principle: unidirectional and bidirectional estimators.
//!
//! A path `d_0 .. d_k` weighs `prod v_i S_k` with `v = F D / (4 |d_z|)` and the segment term of the
//! whole path (eq. 14):
//!
//! ```text
//! S_1 = 1 / (|Lambda_0| + Lambda_1)
//! S_k = (S(0..k-1) + S(1..k)) / (|Lambda_0| + Lambda_k),    0 unless d_0 goes down and d_k up
//! ```
//!
//! computed with the tables e, g, l of algorithm 1 of the supplement. `S_1` too is 0 for ends that
//! do not fit. For facets that reflect diffusely or refract, eqs. 9 and 11 lack the case of a path
//! that ends above and starts again; specular facets have no such paths.
//!
//! Corrected here (the publication against its own derivation, by test):
//! * algorithm 2: the exit probability is `G1 = 1 / (1 + Lambda)`, not `1 / |Lambda|`, and the
//!   bounce is counted before its direction is used;
//! * algorithm 3: roulette of `q = clamp(S_k, 0.3, 0.95)` costs up to five times the variance of a
//!   fixed `q = 0.7`, which is used; the weight is multiplied by `v(d_k, d_{k+1}) / p_k` once
//!   `d_{k+1}` exists;
//! * the released bidirectional code drops pairs whose densities are below 1e-4 (-4 % of energy)
//!   and clamps cosines above 0.9999; neither is needed with the densities in closed form.

use super::state::DepthState;
use super::walk::{Facets, Flight, MAX_BOUNCES};
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::vndf::VisibleNormals;

/// Downward flights that the tables hold.
const LAYERS: usize = 16;
/// Bounces without roulette.
const SURE: usize = 2;
/// Probability of each bounce beyond.
const GOES_ON: f64 = 0.7;

/// The segment term `S_k` of paths that grow at one end (algorithm 1), and the product of their
/// rates. In f64: near grazing angles the one overflows where the other underflows.
struct SegmentTerm {
    l: [f64; LAYERS],
    e: [f64; LAYERS],
    g: [f64; LAYERS],
    n: usize,
    only_down: bool,
    product: f64,
    rates: f64,
    lambda_o: f64,
}

impl SegmentTerm {
    fn new(lambda_o: f64) -> Self {
        Self {
            l: [0.0; LAYERS],
            e: [0.0; LAYERS],
            g: [0.0; LAYERS],
            n: 0,
            only_down: true,
            product: 1.0,
            rates: 1.0,
            lambda_o,
        }
    }

    fn add(&mut self, rate: f64, is_down: bool) -> bool {
        self.rates *= rate;
        // Straight up again and again: nothing is carried, and S overflows.
        if self.rates < 1e-200 || self.rates > 1e200 {
            return false;
        }
        if is_down {
            if self.n == LAYERS {
                return false;
            }
            let e = 1.0 / (self.lambda_o + rate);
            self.l[self.n] = rate;
            self.e[self.n] = e;
            self.g[self.n] = 0.0;
            self.n += 1;
            self.product *= e;
            return true;
        }
        let last = self.n - 1;
        let start = if self.only_down { 1.0 } else { self.g[last] };
        self.only_down = false;
        self.g[last] = start / (rate + self.l[last]);
        for i in (0..last).rev() {
            self.g[i] = (self.g[i] + self.g[i + 1]) / (rate + self.l[i]);
        }
        true
    }

    /// `S_k` times the product of rates.
    fn value(&self) -> f64 {
        let s = if self.only_down {
            self.product
        } else {
            (0..self.n)
                .rev()
                .fold(0.0, |s, i| self.e[i] * (s + self.g[i]))
        };
        s * self.rates
    }
}

/// An estimate of `f cos` from one end; `wi.z > 0`.
#[inline]
pub(crate) fn eval<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let mut flight = facets.arriving(wo);
    let leaving = Flight::new(&facets.ndf, wi);
    let mut segment = SegmentTerm::new(leaving.rate.to_f64());
    let mut is_down = true;
    let mut weight = Rgb::WHITE;
    let mut sum = Rgb::BLACK;
    for bounce in 0..MAX_BOUNCES {
        if !segment.add(flight.rate.to_f64(), is_down) {
            break;
        }
        // v / p = F |Lambda(d)|, and of the last v: 1 / |d_z| = |Lambda(d)| / sigma(-d).
        let (fresnel, quarter_d) = facets.connection(flight.d, leaving.d);
        sum += weight * fresnel * (quarter_d / flight.facing * T::of(segment.value()));
        if bounce >= SURE {
            if stream.next::<T>() >= T::of(GOES_ON) {
                break;
            }
            weight *= T::of(1.0 / GOES_ON);
        }
        let (_, fresnel, next) = facets.bounce(flight.d, [stream.next(), stream.next()]);
        weight *= fresnel;
        flight = next;
        is_down = !flight.is_upward();
    }
    sum
}

/// A direction and its weight: leaves with probability `G1`, whatever came before, and makes up
/// for it (algorithm 2).
///
/// * `u`: samples the first facet.
#[inline]
pub(crate) fn sample<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    mut u: [T; 2],
    stream: &mut Stream,
) -> Option<(Vec3<T>, Rgb<T>)> {
    let mut flight = facets.arriving(wo);
    let mut state = DepthState::new(flight.rate);
    let mut weight = Rgb::WHITE;
    for _ in 0..MAX_BOUNCES {
        let (_, fresnel, next) = facets.bounce(flight.d, u);
        weight *= fresnel;
        flight = next;
        if flight.is_upward() {
            let g1 = T::ONE / (T::ONE + flight.rate);
            // prod |Lambda| S_k over the probability of this path.
            let leaving = state.up(flight.rate);
            if stream.next::<T>() < g1 {
                return Some((flight.d, weight * (leaving / g1)));
            }
            state.scale(T::ONE / (T::ONE - g1));
        } else if !state.down(flight.rate) {
            break;
        }
        u = [stream.next(), stream.next()];
    }
    None
}

/// Flights of one end's walk.
struct Subpath<T> {
    flights: [Flight<T>; SUBPATH],
    /// Fresnel terms and roulette up to each flight.
    weights: [Rgb<T>; SUBPATH],
    /// `D / 4` of the facet that each flight left.
    quarter_d: [T; SUBPATH],
    length: usize,
}

/// Flights that a subpath can hold. Roulette leaves 0.7^10 of the walks that get there, and each
/// end covers for the other.
const SUBPATH: usize = 12;

impl<T: Real> Subpath<T> {
    fn sample<N: VisibleNormals<T>>(
        facets: &Facets<T, N>,
        start: Flight<T>,
        stream: &mut Stream,
    ) -> Self {
        let mut path = Self {
            flights: [start; SUBPATH],
            weights: [Rgb::WHITE; SUBPATH],
            quarter_d: [T::ZERO; SUBPATH],
            length: 1,
        };
        while path.length < SUBPATH {
            let last = path.length - 1;
            let mut weight = path.weights[last];
            if path.length > SURE {
                if stream.next::<T>() >= T::of(GOES_ON) {
                    break;
                }
                weight *= T::of(1.0 / GOES_ON);
            }
            let u = [stream.next(), stream.next()];
            let (wm, fresnel, next) = facets.bounce(path.flights[last].d, u);
            path.flights[path.length] = next;
            path.weights[path.length] = weight * fresnel;
            path.quarter_d[path.length] = T::of(0.25) * facets.ndf.d(wm);
            path.length += 1;
        }
        path
    }
}

/// An estimate of `f cos` from both ends; both directions above the horizon.
///
/// Flights `e_0 .. e_s` of the walk from `wo` and `r_t .. r_0` of that from `wi` meet at one facet:
/// a path of `s + t + 1` bounces. Balance heuristic over all ways of splitting it.
#[inline]
pub(crate) fn eval_bidirectional<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let arriving = facets.arriving(wo);
    let leaving = Flight::new(&facets.ndf, wi);
    let eye = Subpath::sample(facets, arriving, stream);
    let light = Subpath::sample(facets, leaving.reversed(), stream);
    let mut sum = facets.single(&arriving, &leaving);
    for s in 0..eye.length {
        for t in usize::from(s == 0)..light.length {
            let end = light.flights[t];
            let (fresnel, quarter_d) = facets.connection(eye.flights[s].d, -end.d);
            if quarter_d <= T::ZERO {
                continue;
            }
            let throughput = eye.weights[s] * light.weights[t] * fresnel;
            let rivals = rivals(&eye, &light, s, t, quarter_d);
            let density = path_over_density(&eye, &light, s, t, leaving.rate);
            sum += throughput * (quarter_d * density / rivals);
        }
    }
    sum
}

/// `prod D / (4 |d_z|) S` over the density of both subpaths, without the connecting `D / 4`.
fn path_over_density<T: Real>(
    eye: &Subpath<T>,
    light: &Subpath<T>,
    s: usize,
    t: usize,
    exit_rate: T,
) -> T {
    let mut state = DepthState::new(eye.flights[0].rate);
    // The state holds the factor prod |Lambda(d_i)|, i < k. The walk from wi sampled with sigma(d_i), i > s + 1.
    let mut factor = T::ONE / eye.flights[s].facing;
    let mut step = |up: bool, rate: T| {
        if up {
            state.up(rate);
            true
        } else {
            state.down(rate)
        }
    };
    for flight in &eye.flights[1..=s] {
        if !step(flight.is_upward(), flight.rate) {
            return T::ZERO;
        }
    }
    for flight in light.flights[1..=t].iter().rev() {
        let back = flight.reversed();
        if !step(back.is_upward(), back.rate) {
            return T::ZERO;
        }
        factor *= T::ONE / flight.backing;
    }
    for flight in &light.flights[..t] {
        factor *= flight.facing;
    }
    state.exit(exit_rate) * factor
}

/// Sum of the densities of all ways to split the path, over that of this one.
///
/// With the path's flights `d_0 .. d_k` and facets `h_0 .. h_{k-1}`, moving the connection from
/// `h_i` to `h_{i+1}` multiplies the density by
/// `D(h_i) / sigma(-d_i)  sigma(d_{i+2}) / D(h_{i+1})`.
fn rivals<T: Real>(eye: &Subpath<T>, light: &Subpath<T>, s: usize, t: usize, quarter_d: T) -> T {
    let mut sum = T::ONE;
    // Towards wi: the facets of the light's walk, from its last.
    let mut quotient = T::ONE;
    let mut here = quarter_d;
    let mut facing = eye.flights[s].facing;
    for j in (1..=t).rev() {
        let next = light.quarter_d[j];
        quotient *= here / facing * light.flights[j - 1].facing / next;
        // A finite cap: an infinite quotient times the roulette's 0 would be NaN.
        quotient = quotient.at_most(T::of(1e30)) * roulette::<T>(s + t - j + 1);
        quotient /= roulette::<T>(j);
        sum += quotient;
        here = next;
        facing = light.flights[j].backing;
    }
    // Towards wo.
    let mut quotient = T::ONE;
    let mut here = quarter_d;
    let mut facing = light.flights[t].facing;
    for j in (1..=s).rev() {
        let next = eye.quarter_d[j];
        quotient *= here / facing * eye.flights[j - 1].facing / next;
        // A finite cap: an infinite quotient times the roulette's 0 would be NaN.
        quotient = quotient.at_most(T::of(1e30)) * roulette::<T>(s + t - j + 1);
        quotient /= roulette::<T>(j);
        sum += quotient;
        here = next;
        facing = eye.flights[j].backing;
    }
    sum
}

/// Probability that a subpath makes its `bounce`-th bounce once it has come so far.
#[inline(always)]
fn roulette<T: Real>(bounce: usize) -> T {
    match bounce {
        0..=SURE => T::ONE,
        SUBPATH.. => T::ZERO,
        _ => T::of(GOES_ON),
    }
}
