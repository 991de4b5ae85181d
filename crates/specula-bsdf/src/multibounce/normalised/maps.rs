//! Maps of the sphere to the upper hemisphere: where light that stays is sent, by its first flight.

use crate::math::{Real, Vec3, vec3};

/// `u = M(s; e) = e s / (1 - (1 - e) s)` and `du / ds`.
#[inline(always)]
fn odds<T: Real>(s: T, e: T) -> (T, T) {
    let up = e * s;
    let sum = (up + (T::ONE - s)).at_least(T::TINY);
    (up / sum, (e / sum) / sum)
}

/// The `s` of `M(s; e) = u`, and `1 - s`.
#[inline(always)]
fn odds_inverse<T: Real>(u: T, e: T) -> [T; 2] {
    let rest = e * (T::ONE - u);
    let inverse = T::ONE / (u + rest).at_least(T::TINY);
    [u * inverse, rest * inverse]
}

/// The direction of height `z` towards a horizontal unit vector.
#[inline(always)]
pub(super) fn at<T: Real>(towards: [T; 2], z: T) -> Vec3<T> {
    let r = ((T::ONE - z) * (T::ONE + z)).safe_sqrt();
    Vec3 {
        x: towards[0] * r,
        y: towards[1] * r,
        z,
    }
}

/// The unit vector along the horizontal part of `w`; `otherwise` where it has none.
#[inline(always)]
pub(super) fn horizontal<T: Real>(w: Vec3<T>, otherwise: [T; 2]) -> [T; 2] {
    let length = (w.x * w.x + w.y * w.y).sqrt();
    if length > T::of(1e-6) {
        [w.x / length, w.y / length]
    } else {
        otherwise
    }
}

/// Raises flights, and spreads their azimuths about the forward direction.
#[derive(Clone, Copy)]
pub(super) struct Rise<T> {
    /// Horizontal, unit: away from the viewer.
    pub(super) forward: [T; 2],
    /// `wo.z`, above 0: downward flights are above `-mu`.
    pub(super) mu: T,
    /// `tan(phi / 2) = kappa tan(phi' / 2)`.
    pub(super) kappa: T,
    /// `e` of upward and of downward flights.
    pub(super) up: T,
    pub(super) down: T,
    /// Shares of upward and of downward flights whose order is turned: the highest end lowest.
    pub(super) turned: [T; 2],
}

/// `e` of turned upward flights; of downward ones, times `wo.z`.
const TURNED_UP: f64 = 1.844;
const TURNED_DOWN: f64 = 0.65;

impl<T: Real> Rise<T> {
    /// The flights that are sent along `wi`, with their shares times Jacobians: up, up turned, down, down turned.
    #[inline(always)]
    pub(super) fn back(&self, wi: Vec3<T>) -> [(Vec3<T>, T); 4] {
        let (towards, spread) = self.turn(wi, self.kappa);
        let s = wi.z * wi.z;
        let jacobian = T::TWO * wi.z * spread;
        let [turned_up, turned_down] = self.turned;
        let mu = self.mu;
        let (up, up_slope) = odds(s, self.up);
        let (up_turned, up_turned_slope) = odds(s, T::of(TURNED_UP));
        let (down, down_slope) = odds(s, self.down);
        let (down_turned, down_turned_slope) = odds(s, T::of(TURNED_DOWN) / mu);
        [
            (at(towards, up), jacobian * up_slope * (T::ONE - turned_up)),
            (
                at(towards, T::ONE - up_turned),
                jacobian * up_turned_slope * turned_up,
            ),
            (
                at(towards, -mu * down),
                jacobian * down_slope * (T::ONE - turned_down) * mu,
            ),
            (
                at(towards, -mu * (T::ONE - down_turned)),
                jacobian * down_turned_slope * turned_down * mu,
            ),
        ]
    }

    /// The direction that the flight `w` is sent to.
    #[inline(always)]
    pub(super) fn send(&self, w: Vec3<T>, mut takes: impl FnMut(T) -> bool) -> Vec3<T> {
        let towards = self.turn(w, T::ONE / self.kappa).0;
        let is_up = w.z > T::ZERO;
        let [turned_up, turned_down] = self.turned;
        let (u, share, plain, turned) = if is_up {
            (w.z, turned_up, self.up, T::of(TURNED_UP))
        } else {
            let turned = T::of(TURNED_DOWN) / self.mu;
            (-w.z / self.mu, turned_down, self.down, turned)
        };
        let u = u.within(T::ZERO, T::ONE);
        let s = if takes(share) {
            odds_inverse(T::ONE - u, turned)
        } else {
            odds_inverse(u, plain)
        };
        let [z, r] = s.map(T::safe_sqrt);
        vec3(towards[0] * r, towards[1] * r, z)
    }

    /// The horizontal direction of `w`, the tangent of its half-angle from the forward one times `k`; with the derivative of
    /// the angle.
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
}

/// Rolls flights about the grain: an upward one stays on its side, a downward one goes on to the other.
#[derive(Clone, Copy)]
pub(super) struct Roll<T> {
    /// `wo.z`.
    pub(super) mu: T,
    /// `e` of upward and of downward flights.
    pub(super) up: T,
    pub(super) down: T,
    /// Share of flights whose order is turned: the highest end lowest.
    pub(super) turned: T,
}

/// `e` of turned flights, upward and downward.
const ROLLED_UP: f64 = 0.88;
const ROLLED_DOWN: f64 = 0.23;

impl<T: Real> Roll<T> {
    /// The flights that are sent along `[along, across, z]`, with their shares times Jacobians: up, up turned, down, down
    /// turned.
    ///
    /// With the sine `t` of the elevation about the grain, `d omega = d along d t / sqrt(1 - t^2)`.
    #[inline(always)]
    pub(super) fn back(&self, [along, across, z]: [T; 3]) -> [([T; 3], T); 4] {
        let radius = (across * across + z * z).sqrt().at_least(T::of(1e-12));
        let (cos, sin) = (across / radius, z / radius);
        let jacobian = T::TWO * sin * cos.abs();
        // Downward flights are above `-mu`.
        let bottom = (self.mu / radius).at_most(T::ONE);
        let flight = |e: T, share: T, is_turned: bool, is_up: bool| {
            let (u, slope) = odds(sin * sin, e);
            let top = T::select(is_up, T::ONE, bottom);
            // t, and 1 - t without cancellation where the top is 1.
            let (t, rest) = if is_turned {
                (top * (T::ONE - u), T::ONE - top + top * u)
            } else {
                (top * u, T::ONE - top + top * (T::ONE - u))
            };
            let side = (rest * (T::ONE + t)).at_least(T::of(1e-12)).sqrt();
            let weight = share * jacobian * slope * top / side;
            let t = T::select(is_up, t, -t);
            let across = (radius * side).copysign(T::select(is_up, across, -across));
            ([along, across, radius * t], weight)
        };
        let raised = T::ONE - self.turned;
        [
            flight(self.up, raised, false, true),
            flight(T::of(ROLLED_UP), self.turned, true, true),
            flight(self.down, raised, false, false),
            flight(T::of(ROLLED_DOWN), self.turned, true, false),
        ]
    }

    /// The direction that the flight `[along, across, z]` is sent to.
    #[inline(always)]
    pub(super) fn send(
        &self,
        [along, across, z]: [T; 3],
        mut takes: impl FnMut(T) -> bool,
    ) -> [T; 3] {
        let radius = (across * across + z * z).sqrt().at_least(T::of(1e-12));
        let (t, side, raised, turned) = if z > T::ZERO {
            (z / radius, across, self.up, T::of(ROLLED_UP))
        } else {
            let bottom = (self.mu / radius).at_most(T::ONE);
            (
                -z / (radius * bottom),
                -across,
                self.down,
                T::of(ROLLED_DOWN),
            )
        };
        let t = t.within(T::ZERO, T::ONE);
        let s = if takes(self.turned) {
            odds_inverse(T::ONE - t, turned)
        } else {
            odds_inverse(t, raised)
        };
        let [sin, cos] = s.map(T::safe_sqrt);
        [along, (radius * cos).copysign(side), radius * sin]
    }
}
