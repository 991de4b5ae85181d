//! Motion: transforms that change while the shutter is open.

use glam::{DMat3, DMat4, DQuat, DVec3};

/// How a shape, an instance or a camera moves: the transform beside it is that of the start.
///
/// In between, translation and stretch change linearly and the rotation at constant speed along the shorter way, as
/// pbrt-v4 interpolates ([`Trajectory`]). Before the first time and after the second it stands still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The transform at the end.
    pub end: DMat4,
    /// Times of start and end, ascending; the shutter opens at 0 and closes at 1.
    pub times: [f64; 2],
}

/// A transform that changes with time.
///
/// ```text
/// M(s) = T(s) R(s) S(s),   s = clamp((t - t0) / (t1 - t0), 0, 1)
/// T, S: linear in s;       R(s) = R0 rotated by s times the angle from R0 to R1, of the shorter way
/// ```
///
/// `R` is the rotation of the polar decomposition of `M`'s linear part, and `S`, symmetric, what remains. Of
/// transforms that mirror, `-R S` is decomposed, so that `R` is a rotation.
///
/// Source: Shoemake and Duff 1992, "Matrix Animation and Polar Decomposition"; pbrt-v4's `AnimatedTransform`, which
/// takes mirroring transforms for rotations.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    times: [f64; 2],
    /// The transforms as they were given.
    ends: [DMat4; 2],
    translations: [DVec3; 2],
    /// Unit, at most a quarter turn apart.
    rotations: [DQuat; 2],
    /// Angle between the quaternions, in `[0, pi/2]`: half of that of the rotation.
    angle: f64,
    stretches: [DMat3; 2],
}

impl Trajectory {
    /// The trajectory from a transform on.
    ///
    /// * `start`, `motion.end`: affine and invertible; both mirror or neither does.
    #[must_use]
    pub fn new(start: &DMat4, motion: &Motion) -> Self {
        let ends = [*start, motion.end];
        let [(r0, s0), (r1, s1)] = ends.map(|m| polar(&DMat3::from_mat4(m)));
        // A quaternion and its negative are the same rotation.
        let r1 = if r0.dot(r1) < 0.0 { -r1 } else { r1 };
        Self {
            times: motion.times,
            ends,
            translations: ends.map(|m| m.w_axis.truncate()),
            rotations: [r0, r1],
            // Exact for small angles, too.
            angle: 2.0 * (r1 - r0).length().atan2((r1 + r0).length()),
            stretches: [s0, s1],
        }
    }

    /// The transform at a time.
    #[must_use]
    pub fn at(&self, time: f64) -> DMat4 {
        let s = self.share(time);
        if s <= 0.0 {
            self.ends[0]
        } else if s >= 1.0 {
            self.ends[1]
        } else {
            self.between(s)
        }
    }

    /// The part of the motion that is over at a time.
    fn share(&self, time: f64) -> f64 {
        let [t0, t1] = self.times;
        ((time - t0) / (t1 - t0)).clamp(0.0, 1.0)
    }

    fn between(&self, s: f64) -> DMat4 {
        let [t0, t1] = self.translations;
        let [s0, s1] = self.stretches;
        let linear = DMat3::from_quat(self.rotation(s)) * (s0 * (1.0 - s) + s1 * s);
        DMat4::from_cols(
            linear.x_axis.extend(0.0),
            linear.y_axis.extend(0.0),
            linear.z_axis.extend(0.0),
            (t0 * (1.0 - s) + t1 * s).extend(1.0),
        )
    }

    /// Spherical linear interpolation.
    fn rotation(&self, s: f64) -> DQuat {
        /// Below, the arc is its chord to within rounding.
        const STRAIGHT: f64 = 1e-6;
        let [r0, r1] = self.rotations;
        let sum = if self.angle < STRAIGHT {
            r0 * (1.0 - s) + r1 * s
        } else {
            let sin = |x: f64| (x * self.angle).sin() / self.angle.sin();
            r0 * sin(1.0 - s) + r1 * sin(s)
        };
        sum.normalize()
    }

    /// A box around everything that a box sweeps over while the shutter is open.
    ///
    /// The motion is cut into intervals of `s`, of length `h`. A point `p` moves as `x(s) = T + R S p`, which leaves
    /// the chord of an interval by at most `h^2/8 max |x''|`. With the angular speed `w` of the rotation,
    ///
    /// ```text
    /// x'' = R' ' S p + 2 R' S' p,   |x''| <= w^2 max |S p| + 2 w |(S1 - S0) p|,
    /// ```
    ///
    /// where `T` and `S` are linear and the maxima of convex functions are those at corners. The chords lie within the
    /// box around the poses at the ends of all intervals.
    ///
    /// * `of`: least and greatest coordinates, as are those returned.
    #[must_use]
    pub fn swept(&self, of: [DVec3; 2]) -> [DVec3; 2] {
        /// Largest angle of an interval: chords leave arcs by 3e-4 of their radius.
        const STEP: f64 = core::f64::consts::PI / 64.0;
        let corners = corners(of);
        let [from, to] = [self.share(0.0), self.share(1.0)];
        let speed = 2.0 * self.angle;
        let intervals = ((to - from) * speed / STEP).ceil().max(1.0);
        let h = (to - from) / intervals;
        let greatest = |m: &DMat3| {
            let lengths = corners.map(|p| (*m * p).length());
            lengths.into_iter().fold(0.0, f64::max)
        };
        let [s0, s1] = &self.stretches;
        let reach = greatest(s0).max(greatest(s1));
        let bend = speed * speed * reach + 2.0 * speed * greatest(&(*s1 - *s0));
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut i = 0.0;
        while i <= intervals {
            let s = from + h * i;
            let pose = match s {
                s if s <= 0.0 => self.ends[0],
                s if s >= 1.0 => self.ends[1],
                s => self.between(s),
            };
            for p in corners.map(|p| pose.transform_point3(p)) {
                (low, high) = (low.min(p), high.max(p));
            }
            i += 1.0;
        }
        // And rounding of the poses.
        let farthest = low.abs().max(high.abs()).max_element();
        let pad = h * h / 8.0 * bend + 1e-12 * (reach + farthest);
        [low - pad, high + pad]
    }
}

/// The corners of a box.
fn corners(of: [DVec3; 2]) -> [DVec3; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7]
        .map(|i: usize| DVec3::new(of[i & 1].x, of[(i >> 1) & 1].y, of[i >> 2].z))
}

/// The rotation and the symmetric stretch of an invertible linear map.
///
/// Newton's iteration, `Q' = (Q + Q^-T) / 2`, converges to the nearest orthogonal matrix. Source: Higham 1986,
/// "Computing the Polar Decomposition".
fn polar(m: &DMat3) -> (DQuat, DMat3) {
    let determinant = m.determinant();
    // From a matrix of determinant 1 or -1 on, it needs few steps.
    let mut q = *m * determinant.abs().cbrt().recip();
    for _ in 0..100 {
        let next = (q + q.inverse().transpose()) * 0.5;
        let change = (next - q).abs();
        q = next;
        let columns = [change.x_axis, change.y_axis, change.z_axis];
        if columns.iter().all(|c| c.max_element() < 1e-15) {
            break;
        }
    }
    let rotation = DQuat::from_mat3(&if determinant < 0.0 { -q } else { q }).normalize();
    // By the quaternion's own matrix: their product is the map.
    (rotation, DMat3::from_quat(rotation).transpose() * *m)
}

#[cfg(test)]
mod tests;
