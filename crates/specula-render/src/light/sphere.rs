//! Spheres that emit light, sampled uniformly within the cone that they are seen in; by area from inside.
//!
//! Source: Pharr, Jakob and Humphreys, 4th edition, 6.2.4. Departure: `1 - cos theta` is sampled instead of `cos theta`,
//! which does not lose digits for spheres far away and needs no second branch.

use specula_bsdf::math::vec3;
use specula_bsdf::{Frame, Real, Vec3};

use super::angles::sin_cos_turns;
use super::area::{AreaSample, by_area};
use crate::convert::abs;
use crate::geometry::unit_or;
use crate::offset::coupled;

/// A sphere, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere {
    pub(super) centre: Vec3<f32>,
    pub(super) radius: f32,
    /// -1 where its normals point inwards, else 1.
    pub(super) side: f32,
}

/// The cone in which a sphere is seen from outside.
struct Cone {
    /// To the centre, unit.
    axis: Vec3<f32>,
    distance: f32,
    /// Square of the sine of the half angle.
    sin2_max: f32,
    /// `1 - cos` of the half angle, without cancellation.
    one_minus_cos: f32,
    /// Whether the point is outside; else there is no cone.
    exists: bool,
}

impl Cone {
    #[inline(always)]
    fn new(p: Vec3<f32>, sphere: &Sphere) -> Self {
        let d = sphere.centre - p;
        let distance_squared = d.length_squared();
        let radius_squared = sphere.radius * sphere.radius;
        let sin2_max = radius_squared / distance_squared;
        let distance = distance_squared.sqrt();
        Self {
            axis: d * (1.0 / distance),
            distance,
            sin2_max,
            one_minus_cos: sin2_max / (1.0 + (1.0 - sin2_max).sqrt()),
            // A margin: next to the surface the cone is a hemisphere and rounding decides.
            exists: distance_squared > radius_squared * 1.0001,
        }
    }

    /// In 1/sr.
    #[inline(always)]
    fn pdf(&self) -> f32 {
        0.5 * f32::INV_PI / self.one_minus_cos
    }
}

impl Sphere {
    /// Surface area.
    pub(super) fn area(&self) -> f32 {
        4.0 * core::f32::consts::PI * self.radius * self.radius
    }

    /// A point as seen from `p`.
    ///
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline(always)]
    pub(super) fn sample(&self, p: Vec3<f32>, u: [f32; 2]) -> AreaSample {
        let &Self {
            centre,
            radius,
            side,
        } = self;
        let reach = abs(centre) + Vec3::splat(radius);
        let cone = Cone::new(p, self);
        let (sin_phi, cos_phi) = sin_cos_turns(u[1]);
        // From outside `1 - cos` is uniform up to that of the cone, from inside up to 2.
        let most = if cone.exists { cone.one_minus_cos } else { 2.0 };
        let t = u[0] * most;
        let sin2 = t * (2.0 - t);
        let sin = sin2.sqrt();
        let local = vec3(sin * cos_phi, sin * sin_phi, 1.0 - t);
        let wi = Frame::from_normal(cone.axis).to_world(local);
        // Depth of the near intersection below the plane through the centre.
        let height = radius * (1.0 - sin2 / cone.sin2_max).max(0.0).sqrt();
        let along = cone.distance * (1.0 - t) - height;
        let normal = unit_or(p + wi * along - centre, -wi);
        let per_area = 0.25 * f32::INV_PI / (radius * radius);
        let within = by_area(p, centre + local * radius, reach, local * side, per_area);
        let pick = |outside: f32, within: f32| if cone.exists { outside } else { within };
        let pick_vector = |outside: Vec3<f32>, within: Vec3<f32>| {
            vec3(
                pick(outside.x, within.x),
                pick(outside.y, within.y),
                pick(outside.z, within.z),
            )
        };
        AreaSample {
            point: pick_vector(centre + normal * radius, within.point),
            error: coupled(reach),
            normal: pick_vector(normal * side, within.normal),
            wi: pick_vector(wi, within.wi),
            pdf: pick(cone.pdf(), within.pdf),
        }
    }

    /// Density in 1/sr with which directions from `p` are sampled; `None` from inside, where points are sampled by area.
    #[inline]
    pub(super) fn pdf(&self, p: Vec3<f32>) -> Option<f32> {
        let cone = Cone::new(p, self);
        cone.exists.then(|| cone.pdf())
    }
}
