//! The test of rays against spheres: of many rays mostly in single precision where no transform squeezes the sphere, else
//! in double.
//!
//! ```text
//! l = (o - c) + (b / a) d                a = d . d,  b = -(o - c) . d        the point nearest to the centre
//! q = b +- sqrt(a (r^2 - l^2))           the sign is that of b
//! t = q / a,  t = ((o - c)^2 - r^2) / q
//! ```
//!
//! Neither root cancels (Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
//! chapter 7). `(o - c)^2 - r^2` does, and is computed in doubles: a camera above a planet sees it as far away as it is, and
//! rays leave spheres freely.

use glam::DAffine3;
use specula_bsdf::Real;

use super::quadric::QuadricShape;
use crate::convert::narrow;

/// By which share squares of the columns of a transform may differ from those of a similarity.
const TOLERANCE: f64 = 4e-7;

/// A sphere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    centre: [f64; 3],
    /// Square of its radius.
    radius2: f64,
}

/// How a line passes a sphere: the terms above, in double precision.
#[derive(Clone, Copy)]
pub(super) struct Approach {
    a: f64,
    over_a: f64,
    b: f64,
    /// `(o - c)^2 - r^2`.
    c: f64,
    /// `r^2 - l^2`.
    square: f64,
}

impl Approach {
    /// * `o`: relative to the centre.
    /// * `radius2`: the square of the radius.
    #[inline(always)]
    pub(super) fn new(o: [f64; 3], d: [f64; 3], radius2: f64) -> Self {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (a, b) = (dot(d, d), -dot(o, d));
        let over_a = 1.0 / a;
        let along = b * over_a;
        let l = [0, 1, 2].map(|k: usize| o[k] + along * d[k]);
        Self {
            a,
            over_a,
            b,
            c: dot(o, o) - radius2,
            square: radius2 - dot(l, l),
        }
    }

    /// Whether the line hits the sphere.
    #[inline(always)]
    pub(super) fn hits(&self) -> bool {
        self.square >= 0.0
    }

    /// The least positive `t` where the line hits; not positive where the sphere lies behind.
    #[inline(always)]
    pub(super) fn t(&self) -> f32 {
        let [near, far] = self.roots();
        f32::of(if near > 0.0 { near } else { far })
    }

    /// Both `t` where the line hits, the lesser first.
    #[inline(always)]
    pub(super) fn roots(&self) -> [f64; 2] {
        let Self {
            a,
            over_a,
            b,
            c,
            square,
        } = *self;
        let q = b + (a * square).sqrt().copysign(b);
        let [s, t] = [c / q, q * over_a];
        if s < t { [s, t] } else { [t, s] }
    }
}

impl Ball {
    /// A quadric, if it is one.
    pub(super) fn of(shape: QuadricShape, to_group: &DAffine3) -> Option<Self> {
        let QuadricShape::Sphere { radius } = shape else {
            return None;
        };
        let [x, y, z] = to_group.matrix3.to_cols_array_2d().map(glam::DVec3::from);
        let square = x.length_squared();
        let is_near = |value: f64, expected: f64| (value - expected).abs() <= TOLERANCE * square;
        let is_similarity = is_near(y.length_squared(), square)
            && is_near(z.length_squared(), square)
            && [x.dot(y), y.dot(z), z.dot(x)]
                .iter()
                .all(|&c| is_near(c, 0.0));
        let radius2 = square * radius * radius;
        (is_similarity && f32::of(radius2).is_normal()).then(|| Self {
            centre: to_group.translation.to_array(),
            radius2,
        })
    }

    /// [`Self::t`] in double precision, for one ray; NaN where the ray's line misses.
    #[inline(always)]
    pub(super) fn t_in_doubles(&self, o: [f32; 3], d: [f32; 3]) -> f32 {
        let near = self.approach(o, d);
        if near.hits() { near.t() } else { f32::NAN }
    }

    /// How a ray's line passes the centre.
    #[inline(always)]
    pub(super) fn approach(&self, o: [f32; 3], d: [f32; 3]) -> Approach {
        let x = [0, 1, 2].map(|k: usize| f64::from(o[k]) - self.centre[k]);
        Approach::new(x, d.map(f64::from), self.radius2)
    }

    /// The least `t > 0` at which a ray hits it; not above 0 where it misses.
    ///
    /// * `a`: the square of the direction's length, and 1 over it.
    #[inline(always)]
    pub(super) fn t(&self, o: [f32; 3], d: [f32; 3], [a, over_a]: [f32; 2]) -> f32 {
        let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let wide = [0, 1, 2].map(|k: usize| f64::from(o[k]) - self.centre[k]);
        let c = wide[0] * wide[0] + wide[1] * wide[1] + wide[2] * wide[2] - self.radius2;
        let (x, c) = (wide.map(narrow), narrow(c));
        let b = -dot(x, d);
        let along = b * over_a;
        let l = [0, 1, 2].map(|k: usize| x[k] + along * d[k]);
        let square = narrow(self.radius2) - dot(l, l);
        let root = (a * square.max(0.0)).sqrt();
        let q = b + root.copysign(b);
        let [s, t] = [c / q, q * over_a];
        let (near, far) = if s < t { (s, t) } else { (t, s) };
        let t = if near > 0.0 { near } else { far };
        if square >= 0.0 { t } else { -1.0 }
    }
}
