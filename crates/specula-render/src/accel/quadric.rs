//! Spheres, disks, cylinders and parts of them under any affine transform, intersected in double precision.

use glam::{DAffine3, DMat4, DVec3};
use specula_bsdf::{Real, Vec3};
use specula_scene::scene::QuadricPart;

use super::ball::{Approach, Ball};
use super::input::invertible;
use super::{Bounds, Ray};

/// A quadric in its own space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum QuadricShape {
    /// A full sphere about the origin.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A full disk about the z axis.
    Disk {
        /// Radius.
        radius: f64,
        /// Its z.
        height: f64,
    },
    /// A part of either, or a cylinder.
    Part(QuadricPart),
}

impl QuadricShape {
    /// A bound on the coordinates of its points.
    pub(crate) fn reach(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => radius,
            Self::Disk { radius, height } => radius.max(height.abs()),
            Self::Part(QuadricPart::Sphere { radius, .. }) => f64::from(radius),
            Self::Part(QuadricPart::Cylinder { radius, z, .. }) => {
                f64::from(z[0].abs().max(z[1].abs()).max(radius))
            }
            Self::Part(QuadricPart::Disk { radius, height, .. }) => {
                f64::from(height.abs().max(radius))
            }
        }
    }
}

/// A quadric in the space of its group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric {
    /// Its shape.
    pub shape: QuadricShape,
    /// Its own space to the group's; affine and invertible, so that spheres may be ellipsoids.
    pub to_group: DMat4,
}

impl Quadric {
    /// Whether it can be intersected: finite, of positive radius, under an invertible transform.
    pub(super) fn is_regular(&self) -> bool {
        let (radius, height) = match self.shape {
            QuadricShape::Sphere { radius } => (radius, 0.0),
            QuadricShape::Disk { radius, height } => (radius, height),
            QuadricShape::Part(
                QuadricPart::Sphere { radius, .. }
                | QuadricPart::Cylinder { radius, .. }
                | QuadricPart::Disk { radius, .. },
            ) => (f64::from(radius), self.shape.reach()),
        };
        radius.is_finite() && radius > 0.0 && height.is_finite() && invertible(&self.to_group)
    }

    /// A box around it in the group's space, padded for the rounding of the traversal.
    ///
    /// The extent of the image of a ball under `A` along axis `i` is the radius times the length of
    /// row `i` of `A`; of a disk, without the row's z.
    pub(crate) fn bounds(&self) -> Bounds {
        let to_group = DAffine3::from_mat4(self.to_group);
        let (radius, height, flat) = match self.shape {
            QuadricShape::Sphere { radius } => (radius, 0.0, 1.0),
            QuadricShape::Disk { radius, height } => (radius, height, 0.0),
            QuadricShape::Part(part) => return bounds_of_part(&part, &to_group),
        };
        let centre = to_group.transform_point3(DVec3::new(0.0, 0.0, height));
        let rows = to_group.matrix3.transpose();
        let weights = DVec3::new(1.0, 1.0, flat);
        let extent = DVec3::new(
            (rows.x_axis * weights).length(),
            (rows.y_axis * weights).length(),
            (rows.z_axis * weights).length(),
        ) * radius;
        let pad = extent.max_element() * 1e-6;
        Bounds {
            min: (centre - extent - pad).to_array().map(f32::of),
            max: (centre + extent + pad).to_array().map(f32::of),
        }
        .padded(0.0)
    }
}

/// The least and the greatest coordinates, padded by a millionth of the size.
fn bounds_of_part(part: &QuadricPart, to_group: &DAffine3) -> Bounds {
    let rows = to_group.matrix3.transpose();
    let rows = [rows.x_axis, rows.y_axis, rows.z_axis];
    let least = to_group.translation + DVec3::from(rows.map(|row| part.least_along(row)));
    let greatest = to_group.translation - DVec3::from(rows.map(|row| part.least_along(-row)));
    let pad = 1e-6 * (greatest - least).max_element();
    Bounds {
        min: (least - pad).to_array().map(f32::of),
        max: (greatest + pad).to_array().map(f32::of),
    }
    .padded(0.0)
}

/// A quadric, ready to be intersected.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedQuadric {
    /// Set where it is one.
    ball: Option<Ball>,
    shape: QuadricShape,
    to_object: DAffine3,
    /// Index within the group.
    pub(super) primitive: u32,
}

impl PreparedQuadric {
    /// `quadric` must be regular.
    pub(super) fn new(quadric: &Quadric, primitive: u32) -> Self {
        let to_group = DAffine3::from_mat4(quadric.to_group);
        Self {
            ball: Ball::of(quadric.shape, &to_group),
            shape: quadric.shape,
            to_object: to_group.inverse(),
            primitive,
        }
    }

    /// The least `t > 0` at which the ray hits the surface; NaN or not positive where it misses.
    #[inline(never)]
    pub(super) fn t(&self, ray: &Ray) -> f32 {
        if let Some(ball) = &self.ball {
            return ball.t_in_doubles(ray.origin.to_array(), ray.direction.to_array());
        }
        self.t_in_own_space(ray)
    }

    /// [`Self::t`] whatever the shape.
    #[inline(always)]
    pub(super) fn t_in_own_space(&self, ray: &Ray) -> f32 {
        let wide = |v: Vec3<f32>| v.to_array().map(f64::from);
        let (o, d) = self.enter(wide(ray.origin), wide(ray.direction));
        match self.shape {
            QuadricShape::Disk { radius, height } => disk(o, d, radius, height),
            QuadricShape::Part(part) => part_distance(o, d, &part),
            QuadricShape::Sphere { radius } => {
                let near = Approach::new(o, d, radius * radius);
                if near.hits() { near.t() } else { f32::NAN }
            }
        }
    }

    /// It as a sphere that no transform squeezes, if it is one.
    pub(super) fn ball(&self) -> Option<Ball> {
        self.ball
    }

    /// Affine map from the group's space to its own.
    pub(super) fn own_space(&self) -> &DAffine3 {
        &self.to_object
    }

    /// Its shape, in its own space.
    #[inline(always)]
    pub(super) fn shape(&self) -> QuadricShape {
        self.shape
    }

    /// Transforms a ray's origin and direction to its own space.
    #[inline(always)]
    pub(super) fn enter(&self, origin: [f64; 3], direction: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let (origin, direction) = (DVec3::from_array(origin), DVec3::from_array(direction));
        let o = self.to_object.transform_point3(origin);
        let d = self.to_object.transform_vector3(direction);
        (o.to_array(), d.to_array())
    }
}

/// `t` at which a ray hits the disk; NaN or not positive where it misses.
#[inline(always)]
pub(super) fn disk(o: [f64; 3], d: [f64; 3], radius: f64, height: f64) -> f32 {
    let t = (height - o[2]) / d[2];
    let (x, y) = (o[0] + t * d[0], o[1] + t * d[1]);
    let inside = x * x + y * y <= radius * radius;
    f32::of(if inside { t } else { f64::NAN })
}

/// The least `t > 0` at which a ray hits a part of a quadric; NaN where it misses.
///
/// A hit is on the part where pbrt-v4 says so: between the heights, and at an azimuth up to the greatest.
#[inline(never)]
pub(super) fn part_distance(o: [f64; 3], d: [f64; 3], part: &QuadricPart) -> f32 {
    let roots = match *part {
        QuadricPart::Disk { height, .. } => {
            let t = (f64::from(height) - o[2]) / d[2];
            [t, t]
        }
        QuadricPart::Sphere { radius, .. } => {
            let radius = f64::from(radius);
            roots(o, d, radius)
        }
        QuadricPart::Cylinder { radius, .. } => {
            let flat = |v: [f64; 3]| [v[0], v[1], 0.0];
            roots(flat(o), flat(d), f64::from(radius))
        }
    };
    for t in roots {
        let [x, y, z] = [0, 1, 2].map(|k: usize| o[k] + t * d[k]);
        if t > 0.0 && is_on_part(part, x, y, z) {
            return f32::of(t);
        }
    }
    f32::NAN
}

/// Both roots in order; NaN where there are none.
fn roots(o: [f64; 3], d: [f64; 3], radius: f64) -> [f64; 2] {
    let near = Approach::new(o, d, radius * radius);
    if near.hits() {
        near.roots()
    } else {
        [f64::NAN; 2]
    }
}

/// Whether a point of the whole quadric is on the part.
fn is_on_part(part: &QuadricPart, x: f64, y: f64, z: f64) -> bool {
    let (phi_max, is_within) = match *part {
        QuadricPart::Sphere {
            radius,
            z: [low, high],
            phi_max,
        } => {
            let above = low <= -radius || z >= f64::from(low);
            let below = high >= radius || z <= f64::from(high);
            (phi_max, above && below)
        }
        QuadricPart::Cylinder {
            z: [low, high],
            phi_max,
            ..
        } => (phi_max, z >= f64::from(low) && z <= f64::from(high)),
        QuadricPart::Disk {
            radius,
            inner,
            phi_max,
            ..
        } => {
            let squared = x * x + y * y;
            let [inner, radius] = [inner, radius].map(|r| f64::from(r) * f64::from(r));
            (phi_max, squared >= inner && squared <= radius)
        }
    };
    if !is_within || phi_max >= QuadricPart::TURN {
        return is_within;
    }
    let phi = y.atan2(x);
    let phi = if phi < 0.0 {
        phi + core::f64::consts::TAU
    } else {
        phi
    };
    phi <= f64::from(phi_max)
}
