//! Bitterli and d'Eon 2022, A Position-Free Path Integral for Homogeneous Slabs and Multiple
//! Scattering on Smith Microfacets: the unidirectional estimator.
//!
//! Heights are integrated in closed form. The density of the depth of a collision is
//! hyperexponential, `sum_j a_j exp(-b_j tau)`:
//!
//! ```text
//! start:           a_1 = b_1 = |Lambda_0|
//! down, rate l:    a_j *= l / (l - b_j),  a_{N+1} = -sum_j a_j,  b_{N+1} = l
//! up, rate L:      a_j *= L / (L + b_j)
//! exit, rate L:    p = sum_j a_j / (b_j + L)
//! ```
//!
//! (algorithm 5 of Cui et al. 2023 prints it with its signs lost.) A walk goes on after an upward
//! flight with the probability that a facet meets it, and connects with `f_p p`.
//!
//! Departures: coefficients are in f64, and rates within 1e-5 of each other are moved apart:
//! `l - b_j` is 0/0 at equal rates (views along the normal) and cancels in f32. The paper gives no
//! sampling of directions: that of Heitz 2016 is used.
//!
//! Known limitation, the model's: as for Heitz 2016, the variance diverges for `wi` along the
//! normal.

use super::walk::{Facets, Flight, MAX_BOUNCES};
use crate::math::{Real, Rgb, Stream, Vec3};
use crate::vndf::VisibleNormals;

/// Terms that the density can hold.
const TERMS: usize = 16;
/// Least relative distance of two rates.
const APART: f64 = 1e-5;

/// `sum_j a_j exp(-b_j tau)`.
struct HeightDistribution {
    a: [f64; TERMS],
    b: [f64; TERMS],
    terms: usize,
}

impl HeightDistribution {
    fn new(rate: f64) -> Self {
        let mut distribution = Self {
            a: [0.0; TERMS],
            b: [0.0; TERMS],
            terms: 1,
        };
        distribution.a[0] = rate;
        distribution.b[0] = rate;
        distribution
    }

    fn terms(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let a = self.a.iter().copied();
        a.zip(self.b.iter().copied()).take(self.terms)
    }

    fn down(&mut self, rate: f64) -> bool {
        if self.terms == TERMS {
            return false;
        }
        let mut l = rate;
        while self.terms().any(|(_, b)| (l - b).abs() < APART * l) {
            l *= 1.0 + 2.0 * APART;
        }
        let mut sum = 0.0;
        for (a, b) in self.a.iter_mut().zip(&self.b).take(self.terms) {
            *a *= l / (l - b);
            sum += *a;
        }
        self.a[self.terms] = -sum;
        self.b[self.terms] = l;
        self.terms += 1;
        true
    }

    fn up(&mut self, rate: f64) {
        for (a, b) in self.a.iter_mut().zip(&self.b).take(self.terms) {
            *a *= rate / (rate + b);
        }
    }

    /// The mass that leaves along a rate; the whole mass for 0.
    fn exit(&self, rate: f64) -> f64 {
        self.terms().map(|(a, b)| a / (b + rate)).sum()
    }

    fn scale(&mut self, factor: f64) {
        for a in self.a.iter_mut().take(self.terms) {
            *a *= factor;
        }
    }
}

/// An estimate of `f cos`; `wi.z > 0`.
#[inline]
pub(crate) fn eval<T: Real, N: VisibleNormals<T>>(
    facets: &Facets<T, N>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let mut flight = facets.arriving(wo);
    let leaving = Flight::new(&facets.ndf, wi);
    let mut heights = HeightDistribution::new(flight.rate.to_f64());
    let mut weight = Rgb::WHITE;
    let mut sum = Rgb::BLACK;
    for _ in 0..MAX_BOUNCES {
        let (fresnel, quarter_d) = facets.connection(flight.d, leaving.d);
        let exit = T::of(heights.exit(leaving.rate.to_f64()));
        sum += weight * fresnel * (quarter_d / flight.facing * exit);
        let (_, fresnel, next) = facets.bounce(flight.d, [stream.next(), stream.next()]);
        weight *= fresnel;
        flight = next;
        if flight.is_upward() {
            heights.up(flight.rate.to_f64());
            let staying = heights.exit(0.0);
            if stream.next::<T>().to_f64() >= staying {
                break;
            }
            heights.scale(1.0 / staying);
        } else if !heights.down(flight.rate.to_f64()) {
            break;
        }
    }
    sum
}
