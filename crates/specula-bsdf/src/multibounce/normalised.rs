//! Specula's density for multiple importance sampling: normalised, with its own sampler.
//!
//! Light that meets one facet is distributed exactly: it flies along `w` with the density
//!
//! ```text
//! p1(w) = D(wm) / (4 sigma(wo)),   wm ~ wo + w,      1 over the sphere
//! ```
//!
//! of which the share `G(w) = l_o / (l_o + Lambda(w))` of an upward `w` leaves and all else meets
//! facets again. What follows is modelled by maps of the sphere to the upper hemisphere: a light
//! that stays is sent along `T(w)`. As a map moves light and neither makes nor loses any,
//!
//! ```text
//! p(wi) = G p1(wi) + sum_T c_T J_T (1 - G) p1(T^-1(wi)),    J_T = |d T^-1 / d wi|,   sum_T c_T = 1
//! ```
//!
//! integrates to 1 for every distribution of normals and every view, with no table and no fit of
//! any albedo. The maps, with `M(u; e) = e u / (1 - (1 - e) u)`:
//!
//! | flight | map | taken |
//! |---|---|---|
//! | up | raised: `w.z = M(z^2; 0.25)`; azimuth spread | isotropic part |
//! | up | rolled: about the axis of less roughness, `sin = 1 - sin'^2` | `1 - r^2` |
//! | down | raised: `w.z = -wo.z u`, `u = M(z^2; 0.65 / wo.z)`; azimuth spread | isotropic part |
//! | down | turned up: as before, with `1 - u` for `u` | `0.8 a^4 / (a^4 + 0.15)` of it |
//! | down | rolled on, to the other side of the axis | `0.45 (1 - r^2)` |
//!
//! `r` is the ratio of the smaller alpha to the larger, `a^2` their product. The azimuth spreads
//! about the forward direction: `tan(phi / 2) = kappa tan(phi' / 2)` (a wrapped Cauchy
//! distribution, where all light goes forward), `kappa = 1 / (1 + 2 (1 - a^2) sin^2 theta_o)`. All
//! depends continuously on alphas and directions.
//!
//! The forms and the constants were chosen by distance (L1) to walks with F = 1, GGX and Beckmann,
//! nine pairs of alphas, views from 0 to 85 degrees along and across the grain: test
//! `normalised_density_is_closest_to_the_walks`.

use super::walk::Flight;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, warp};
use crate::ndf::Ndf;
use crate::vndf::VisibleNormals;

/// A cosine lobe's share, so that the density is above 0 where D underflows.
const FLOOR: f64 = 1e-4;
/// `e` of upward flights; of downward ones, times `wo.z`.
const RISE: f64 = 0.25;
const RISE_BELOW: f64 = 0.65;

/// The density of a reflected `wi` (see the module's text).
///
/// * Returns: 1/sr; 0 where `wi.z <= 0`, above 0 elsewhere.
///
/// Invariant: integrates to 1 (test `normalised_density_integrates_to_one`); is that of
/// [`sample`] (test `the_normalised_density_is_its_samplers`).
#[inline(always)]
pub fn pdf<T: Real, N: Ndf<T>>(ndf: &N, wo: Vec3<T>, wi: Vec3<T>) -> T {
    if wi.z <= T::ZERO {
        return T::ZERO;
    }
    let maps = Maps::new(ndf, wo);
    let below = maps.below_turned;
    let mut sum = (T::ONE - maps.stays(ndf, wi)) * met(ndf, wo, wi);
    let mut add = |share: T, (w, jacobian): (Vec3<T>, T)| {
        let stays = if w.z > T::ZERO {
            maps.stays(ndf, w)
        } else {
            T::ONE
        };
        sum += share * jacobian * stays * met(ndf, wo, w);
    };
    let (round_up, round_down) = (T::ONE - maps.rolled_up, T::ONE - maps.rolled_down);
    let (towards, spread) = maps.gather(wi);
    let (u, slope) = slow(wi.z, T::of(RISE), T::ONE);
    add(round_up, (at(towards, u), slope * spread));
    let (u, slope) = slow(wi.z, T::of(RISE_BELOW), maps.mu);
    let jacobian = slope * spread * maps.mu;
    let (raised, turned) = (-maps.mu * u, maps.mu * (u - T::ONE));
    add(
        round_down * (T::ONE - below),
        (at(towards, raised), jacobian),
    );
    add(round_down * below, (at(towards, turned), jacobian));
    if maps.rolled_up > T::ZERO {
        let [up, down] = maps.roll_back(wi);
        add(maps.rolled_up, up);
        add(maps.rolled_down, down);
    }
    let floor = T::of(FLOOR);
    (T::ONE - floor) * sum / (T::of(4.0) * maps.sigma) + floor * wi.z * T::INV_PI
}

/// A direction of the density [`pdf`].
///
/// * `u`: uniform in `[0, 1)`; two sample a facet, the third what follows.
/// * Returns: unit, above the horizon; `None` in the rare case that rounding leaves it on it.
#[inline]
pub fn sample<T: Real, N: VisibleNormals<T>>(ndf: &N, wo: Vec3<T>, u: [T; 3]) -> Option<Vec3<T>> {
    let maps = Maps::new(ndf, wo);
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
    let wi = if takes(T::of(FLOOR)) {
        warp::cosine_hemisphere([u[0], u[1]])
    } else {
        let wm = ndf.sample_wm(wo, [u[0], u[1]]);
        let w = wm * (T::TWO * wo.dot(wm)) - wo;
        if w.z > T::ZERO {
            if !takes(maps.stays(ndf, w)) {
                w
            } else if takes(maps.rolled_up) {
                maps.roll(w)
            } else {
                at(maps.scatter(w), fast(w.z, T::of(RISE), T::ONE))
            }
        } else if takes(maps.rolled_down) {
            maps.roll(w)
        } else {
            let u = (-w.z / maps.mu).within(T::ZERO, T::ONE);
            let u = if takes(maps.below_turned) {
                T::ONE - u
            } else {
                u
            };
            at(maps.scatter(w), fast(u, T::of(RISE_BELOW), maps.mu))
        }
    };
    (wi.z > T::ZERO).then_some(wi)
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

/// `u = M(z^2; e / m)` and `du / dz`.
#[inline(always)]
fn slow<T: Real>(z: T, e: T, m: T) -> (T, T) {
    let up = e * z * z;
    let sum = (up + m * (T::ONE - z * z)).at_least(T::TINY);
    (up / sum, T::TWO * z * (e / sum) * (m / sum))
}

/// The inverse of [`slow`].
#[inline(always)]
fn fast<T: Real>(u: T, e: T, m: T) -> T {
    let up = m * u;
    ((up / (up + e * (T::ONE - u)).at_least(T::TINY)).safe_sqrt()).at_most(T::ONE)
}

/// The direction of height `z` towards a horizontal unit vector.
#[inline(always)]
fn at<T: Real>(towards: [T; 2], z: T) -> Vec3<T> {
    let r = ((T::ONE - z) * (T::ONE + z)).safe_sqrt();
    Vec3 {
        x: towards[0] * r,
        y: towards[1] * r,
        z,
    }
}

/// What the maps of one view share.
struct Maps<T> {
    /// Downward flights of the first facet are above `-mu`.
    mu: T,
    /// `sigma(wo)`.
    sigma: T,
    /// `|Lambda_o|`.
    rate: T,
    /// Horizontal, unit: away from the viewer.
    forward: [T; 2],
    kappa: T,
    /// Shares of the maps.
    below_turned: T,
    rolled_up: T,
    rolled_down: T,
    /// The axis of less roughness is x.
    is_smooth_along_x: bool,
}

impl<T: Real> Maps<T> {
    #[inline(always)]
    fn new<N: Ndf<T>>(ndf: &N, wo: Vec3<T>) -> Self {
        let view = Flight::new(ndf, -wo);
        let Alpha { x, y } = ndf.alpha();
        let a2 = x * y;
        let a4 = a2 * a2;
        let ratio = x.at_most(y) / x.at_least(y);
        let rolled = T::ONE - ratio * ratio;
        let sin2 = wo.x * wo.x + wo.y * wo.y;
        let smooth = (T::ONE - a2).at_least(T::ZERO);
        Self {
            mu: wo.z.at_least(T::of(1e-6)),
            sigma: view.facing,
            rate: view.rate,
            forward: horizontal(-wo, [T::ONE, T::ZERO]),
            kappa: T::ONE / (T::ONE + T::TWO * smooth * sin2),
            below_turned: T::of(0.8) * a4 / (a4 + T::of(0.15)),
            rolled_up: rolled,
            rolled_down: T::of(0.45) * rolled,
            is_smooth_along_x: x < y,
        }
    }

    /// Share of an upward flight that meets a facet.
    #[inline(always)]
    fn stays<N: Ndf<T>>(&self, ndf: &N, w: Vec3<T>) -> T {
        let lambda_cos = ndf.lambda_cos(w);
        lambda_cos / (lambda_cos + self.rate * w.z).at_least(T::TINY)
    }

    /// The horizontal direction that [`scatter`](Self::scatter) sends to that of `wi`, and
    /// `dphi / dphi'`.
    #[inline(always)]
    fn gather(&self, wi: Vec3<T>) -> ([T; 2], T) {
        self.turn(wi, self.kappa)
    }

    /// The horizontal direction of `w`, spread about the forward one.
    #[inline(always)]
    fn scatter(&self, w: Vec3<T>) -> [T; 2] {
        self.turn(w, T::ONE / self.kappa).0
    }

    /// The half-angle from the forward direction, its tangent times `k`; with the derivative of the
    /// angle.
    #[inline(always)]
    fn turn(&self, w: Vec3<T>, k: T) -> ([T; 2], T) {
        let [fx, fy] = self.forward;
        let [x, y] = horizontal(w, self.forward);
        let (cos, sin) = (x * fx + y * fy, y * fx - x * fy);
        let (near, far) = (T::ONE + cos, k * k * (T::ONE - cos));
        let scale = T::ONE / (near + far);
        let (cos, sin) = ((near - far) * scale, T::TWO * k * sin * scale);
        (
            [cos * fx - sin * fy, cos * fy + sin * fx],
            T::TWO * k * scale,
        )
    }

    /// `(along, across)` the axis of less roughness.
    #[inline(always)]
    fn to_axis(&self, w: Vec3<T>) -> (T, T) {
        if self.is_smooth_along_x {
            (w.x, w.y)
        } else {
            (w.y, w.x)
        }
    }

    #[inline(always)]
    fn of_axis(&self, along: T, across: T, z: T) -> Vec3<T> {
        let (x, y) = if self.is_smooth_along_x {
            (along, across)
        } else {
            (across, along)
        };
        Vec3 { x, y, z }
    }

    /// The flights up and down that [`roll`](Self::roll) sends along `wi`, with their Jacobians.
    ///
    /// With the sine `s` of the elevation about the axis, `d omega = d along d s / sqrt(1 - s^2)`.
    #[inline(always)]
    fn roll_back(&self, wi: Vec3<T>) -> [(Vec3<T>, T); 2] {
        let (along, across) = self.to_axis(wi);
        let radius = ((across * across + wi.z * wi.z).sqrt()).at_least(T::of(1e-12));
        let (cos, sin) = (across / radius, wi.z / radius);
        // The sine of the flight's elevation.
        let t = cos * cos;
        let side = (wi.z * (T::ONE + t).sqrt()).copysign(across);
        let up = self.of_axis(along, side, radius * t);
        let up_jacobian = T::TWO * (t / (T::ONE + t)).sqrt();
        let top = (self.mu / radius).at_most(T::ONE);
        let low = top * t;
        // 1 - low, without cancellation.
        let rest = (T::ONE - top + top * sin * sin) * (T::ONE + low);
        let side = -(radius * rest.safe_sqrt()).copysign(across);
        let down = self.of_axis(along, side, -radius * low);
        let down_jacobian = T::TWO * top * sin * (t / rest.at_least(T::TINY)).sqrt();
        [(up, up_jacobian), (down, down_jacobian)]
    }

    /// Rolls a flight about the axis of less roughness: an upward one rises on its side, a downward
    /// one goes on to the other.
    #[inline(always)]
    fn roll(&self, w: Vec3<T>) -> Vec3<T> {
        let (along, across) = self.to_axis(w);
        let radius = ((across * across + w.z * w.z).sqrt()).at_least(T::of(1e-12));
        let (t, side) = if w.z > T::ZERO {
            (w.z / radius, across)
        } else {
            let top = (self.mu / radius).at_most(T::ONE);
            (-w.z / (radius * top), -across)
        };
        let t = t.within(T::ZERO, T::ONE);
        let z = radius * (T::ONE - t).safe_sqrt();
        self.of_axis(along, (radius * t.sqrt()).copysign(side), z)
    }
}

/// The unit vector along the horizontal part of `w`; `otherwise` where it has none.
#[inline(always)]
fn horizontal<T: Real>(w: Vec3<T>, otherwise: [T; 2]) -> [T; 2] {
    let length = (w.x * w.x + w.y * w.y).sqrt();
    if length > T::of(1e-6) {
        [w.x / length, w.y / length]
    } else {
        otherwise
    }
}
