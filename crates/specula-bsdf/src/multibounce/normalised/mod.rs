//! Specula's density for multiple importance sampling: normalised, with its own sampler.
//!
//! Light that meets one facet is distributed exactly: it flies along `w` with the density
//!
//! ```text
//! p1(w) = D(wm) / (4 sigma(wo)),   wm ~ wo + w,      1 over the sphere
//! ```
//!
//! of which the share `G(w) = l_o / (l_o + Lambda(w))` of an upward `w` leaves and all else meets
//! facets again. What follows is modelled in two ways, both of which move light and neither make nor
//! lose any:
//!
//! - Maps `T` of the sphere to the upper hemisphere send a light that stays along `T(w)` (`maps`).
//! - A flight is sampled with a point `u` of the unit square, of which any sampler `Q` makes a direction
//!   of its own lobe `q`: light that stays is sent along `Q(u)` (`lobes`). The density needs the flight
//!   that the point of `wi` samples, and neither an albedo nor the flight's own density.
//!
//! ```text
//! p(wi) = G p1(wi) + sum_T c_T J_T (1 - G) p1(T^-1(wi)) + sum_Q c_Q q(wi) (1 - G(w(Q^-1(wi)))),
//! J_T = |d T^-1 / d wi|,   sum_T c_T + sum_Q c_Q = 1
//! ```
//!
//! So `p` integrates to 1 for every distribution of normals and every view, with no table and no fit of
//! any albedo. With `M(u; e) = e u / (1 - (1 - e) u)`:
//!
//! | flight | sent | share |
//! |---|---|---|
//! | up | raised: `w.z = M(z^2; e)`; azimuth spread | isotropic part |
//! | up | turned: `1 - w.z = M(z^2; 1.844)` | `a^4 / (a^4 + 0.0097)` of it |
//! | down | raised: `w.z = -wo.z u`, `u = M(z^2; e)`; azimuth spread | isotropic part |
//! | down | turned: as before, with `1 - u` for `u` | `0.49 a^4 / (a^4 + 0.435)` of it |
//! | any | a lobe that is alike in all azimuths | of rough surfaces, `a` above 0.59 |
//! | up | rolled about the grain, on its side; raised and turned, too | `(1 - r^2)^2` |
//! | down | rolled about the grain, to the other side; raised and turned, too | `(1 - r^2)^2` |
//! | any | a lobe about the grain | of rough surfaces |
//!
//! The grain is the axis of less roughness, `r` the ratio of the smaller alpha to the larger, `a^2` their
//! product. The azimuth spreads about the forward direction: `tan(phi / 2) = kappa tan(phi' / 2)`, a
//! wrapped Cauchy distribution where all light goes forward. All depends continuously on alphas and
//! directions.
//!
//! The forms and the constants were chosen by distance (L1) to walks with F = 1, GGX and Beckmann, for
//! alphas up to 10, all views and azimuths: test `normalised_density_is_closest_to_the_walks`.

mod lobes;
mod maps;

use self::lobes::{Cone, Round};
use self::maps::{Rise, Roll, horizontal};
use super::walk::Flight;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, vec3, warp};
use crate::ndf::Ndf;
use crate::vndf::{VisibleNormals, reflect};

/// A cosine lobe's share, so that the density is above 0 where D underflows.
const FLOOR: f64 = 1e-4;
/// Geometric means of the alphas between which the lobe of all azimuths takes the place of maps.
const ROUGH: [f64; 2] = [0.59, 3.26];

/// The density of a reflected `wi` (see the module's text).
///
/// * Returns: 1/sr; 0 where `wi.z <= 0`, above 0 elsewhere.
///
/// Invariant: integrates to 1 (test `normalised_density_integrates_to_one`); is that of
/// [`sample`] (test `the_normalised_density_is_its_samplers`).
#[inline(always)]
pub fn pdf<T: Real, N: VisibleNormals<T>>(ndf: &N, wo: Vec3<T>, wi: Vec3<T>) -> T {
    pdf_of::<T, N, SOME>(ndf, wo, wi)
}

/// Which terms are computed: those whose shares are above 0, all, or the maps that raise flights alone. A batch takes one of the
/// latter, so that its loop does not branch.
pub(crate) const SOME: u8 = 0;
pub(crate) const ALL: u8 = 1;
pub(crate) const RAISED: u8 = 2;

/// The terms of these alphas, of which a batch has one pair.
#[inline(always)]
pub(crate) fn terms<T: Real>(alpha: Alpha<T>) -> u8 {
    let is_smooth = alpha.x * alpha.y <= T::of(ROUGH[0] * ROUGH[0]);
    if alpha.x == alpha.y && is_smooth {
        RAISED
    } else {
        ALL
    }
}

/// [`pdf`] by these terms.
#[inline(always)]
pub(crate) fn pdf_of<T: Real, N: VisibleNormals<T>, const TERMS: u8>(
    ndf: &N,
    wo: Vec3<T>,
    wi: Vec3<T>,
) -> T {
    let view = View::new(ndf, wo);
    let has = |share: T| TERMS == ALL || (TERMS == SOME && share > T::ZERO);
    let mut sum = (T::ONE - view.stays(ndf, wi)) * met(ndf, wo, wi);
    // Without loops, which would not become vectors.
    let sent = |(w, weight): (Vec3<T>, T)| weight * view.stays(ndf, w) * met(ndf, wo, w);
    let maps = (T::ONE - view.grain) * (T::ONE - view.round);
    if TERMS == RAISED || has(maps) {
        let [a, b, c, d] = view.rise.back(wi);
        sum += maps * (sent(a) + sent(b) + (sent(c) + sent(d)));
    }
    let parts = view.to_grain(wi);
    let rolled = view.grain * (T::ONE - view.cone);
    if has(rolled) {
        let [a, b, c, d] = view.roll.back(parts);
        let sent = |(parts, weight)| sent((view.of_grain(parts), weight));
        sum += rolled * (sent(a) + sent(b) + (sent(c) + sent(d)));
    }
    let mut lobes = T::ZERO;
    let round = (T::ONE - view.grain) * view.round;
    if has(round) {
        let (density, u) = Round::new(view.scale, view.mu).density(wi);
        let here = view.stays(ndf, flight(ndf, wo, u));
        let there = view.stays(ndf, flight(ndf, wo, opposite(u)));
        lobes += round * density * T::HALF * (here + there);
    }
    let cone = view.grain * view.cone;
    if has(cone) {
        let (density, u) = view.cone_lobe(wo).density(parts);
        lobes += cone * density * view.stays(ndf, flight(ndf, wo, u));
    }
    let floor = T::of(FLOOR);
    let sum = sum / (T::of(4.0) * view.sigma) + lobes;
    let density = (T::ONE - floor) * sum + floor * wi.z * T::INV_PI;
    T::select(wi.z > T::ZERO, density, T::ZERO)
}

/// A direction of the density [`pdf`].
///
/// * `u`: uniform in `[0, 1)`; two sample a facet, the third what follows.
/// * Returns: unit, above the horizon; `None` in the rare case that rounding leaves it on it.
#[inline]
pub fn sample<T: Real, N: VisibleNormals<T>>(ndf: &N, wo: Vec3<T>, u: [T; 3]) -> Option<Vec3<T>> {
    let view = View::new(ndf, wo);
    let mut choice = u[2];
    // Takes a part of [0, 1), and stretches what it falls in to [0, 1).
    let mut takes = |share: T| {
        let is_taken = choice < share;
        choice = if is_taken {
            choice / share
        } else {
            (choice - share) / (T::ONE - share)
        };
        is_taken
    };
    let point = [u[0], u[1]];
    let wi = if takes(T::of(FLOOR)) {
        warp::cosine_hemisphere(point)
    } else {
        let w = flight(ndf, wo, point);
        if !takes(view.stays(ndf, w)) {
            w
        } else if takes(view.grain) {
            view.of_grain(if takes(view.cone) {
                view.cone_lobe(wo).direction(point)
            } else {
                view.roll.send(view.to_grain(w), &mut takes)
            })
        } else if takes(view.round) {
            let point = if takes(T::HALF) {
                opposite(point)
            } else {
                point
            };
            Round::new(view.scale, view.mu).direction(point)
        } else {
            view.rise.send(w, takes)
        }
    };
    (wi.z > T::ZERO).then_some(wi)
}

/// The point of the other end of the height and of the other side. Light that leaves at once is missing from a lobe where
/// its points lie; half of the lobe misses it here, half there.
#[inline(always)]
fn opposite<T: Real>([height, turn]: [T; 2]) -> [T; 2] {
    let other = T::select(turn < T::HALF, turn + T::HALF, turn - T::HALF);
    [T::ONE - height, other]
}

/// The flight after the first facet, of a point of the unit square.
#[inline(always)]
fn flight<T: Real, N: VisibleNormals<T>>(ndf: &N, wo: Vec3<T>, u: [T; 2]) -> Vec3<T> {
    let inside = |u: T| u.within(T::ZERO, T::ONE - T::EPSILON);
    reflect(wo, ndf.sample_wm(wo, [inside(u[0]), inside(u[1])]))
}

/// `D` of the facet that turns `wo` to `w`.
#[inline(always)]
fn met<T: Real, N: Ndf<T>>(ndf: &N, wo: Vec3<T>, w: Vec3<T>) -> T {
    let wm = wo + w;
    let length = wm.length();
    if wm.z > T::ZERO && length > T::of(1e-6) {
        ndf.d(wm * (T::ONE / length))
    } else {
        T::ZERO
    }
}

/// What the directions of one view share.
struct View<T> {
    /// `wo.z`, above 0.
    mu: T,
    /// `sigma(wo)`.
    sigma: T,
    /// `|Lambda_o|`.
    rate: T,
    /// Geometric mean of the alphas.
    scale: T,
    /// The smaller alpha, and the larger.
    alphas: [T; 2],
    /// The axis of less roughness is x.
    is_smooth_along_x: bool,
    /// Share of light that goes by the grain.
    grain: T,
    /// Of that, share of its lobe; of the rest, share of the lobe of all azimuths.
    cone: T,
    round: T,
    rise: Rise<T>,
    roll: Roll<T>,
}

impl<T: Real> View<T> {
    #[inline(always)]
    fn new<N: Ndf<T>>(ndf: &N, wo: Vec3<T>) -> Self {
        let view = Flight::new(ndf, -wo);
        let Alpha { x, y } = ndf.alpha();
        let (low, high) = (x.at_most(y), x.at_least(y));
        let ratio = low / high;
        let unequal = T::ONE - ratio * ratio;
        let a2 = x * y;
        let a4 = a2 * a2;
        let scale = a2.sqrt();
        let mu = wo.z.at_least(T::of(1e-6));
        let sin2 = wo.x * wo.x + wo.y * wo.y;
        let forward = horizontal(-wo, [T::ONE, T::ZERO]);
        // The roughness that the view sees, and how low it is by that measure.
        let [rx, ry] = [x * forward[0], y * forward[1]];
        let seen = (rx * rx + ry * ry).sqrt();
        let low_by = |mu: T, alpha: T, k: f64| {
            let heights = mu / (T::of(k) * alpha);
            T::ONE / (alpha * (T::ONE + heights * heights))
        };
        let smooth = (T::ONE - a2).at_least(T::ZERO);
        let spread = T::of(1.72) * smooth * sin2 + T::of(0.0214) * low_by(mu, seen, 3.16);
        let is_smooth_along_x = x < y;
        let across = if is_smooth_along_x { wo.y } else { wo.x };
        let side = (mu * mu + across * across).sqrt();
        let mu_across = mu / side;
        let low_across = low_by(mu_across, high, 1.64);
        let high4 = high * high * high * high;
        let ramp = |x: T, [from, to]: [f64; 2]| {
            ((x - T::of(from)) * T::of(1.0 / (to - from))).within(T::ZERO, T::ONE)
        };
        Self {
            mu,
            sigma: view.facing,
            rate: view.rate,
            scale,
            alphas: [low, high],
            is_smooth_along_x,
            grain: unequal * unequal,
            cone: ramp(high, [0.0, 4.07]),
            round: ramp(scale, ROUGH),
            rise: Rise {
                forward,
                mu,
                kappa: T::ONE / (T::ONE + spread),
                up: T::of(0.281) + T::of(0.0262) * low_by(mu, seen, 2.804),
                down: (T::of(0.353) + T::of(0.157) * low_by(mu, seen, 2.23)) / mu,
                turned: [
                    a4 / (a4 + T::of(0.0097)),
                    T::of(0.49) * a4 / (a4 + T::of(0.435)),
                ],
            },
            roll: Roll {
                mu,
                up: T::of(0.263) + T::of(0.032) * low_across,
                down: T::of(0.319) / mu_across,
                turned: T::of(0.917) * high4 / (high4 + T::of(0.0154)),
            },
        }
    }

    /// The lobe about the grain.
    #[inline(always)]
    fn cone_lobe(&self, wo: Vec3<T>) -> Cone<T> {
        let [along, across, _] = self.to_grain(wo);
        Cone::new(self.alphas, [along, across], self.mu)
    }

    /// Share of a flight that meets a facet.
    #[inline(always)]
    fn stays<N: Ndf<T>>(&self, ndf: &N, w: Vec3<T>) -> T {
        let lambda_cos = ndf.lambda_cos(w);
        let share = lambda_cos / (lambda_cos + self.rate * w.z).at_least(T::TINY);
        T::select(w.z > T::ZERO, share, T::ONE)
    }

    /// `[along, across, z]` of the grain.
    #[inline(always)]
    fn to_grain(&self, w: Vec3<T>) -> [T; 3] {
        if self.is_smooth_along_x {
            [w.x, w.y, w.z]
        } else {
            [w.y, w.x, w.z]
        }
    }

    #[inline(always)]
    fn of_grain(&self, [along, across, z]: [T; 3]) -> Vec3<T> {
        if self.is_smooth_along_x {
            vec3(along, across, z)
        } else {
            vec3(across, along, z)
        }
    }
}
