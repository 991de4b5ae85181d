//! Surfaces and derivatives of curves.
//!
//! Source: pbrt-v4's `Curve`. At `c(u)`, with the unit tangent `T` and the unit direction `d` of the ray:
//!
//! ```text
//! e = d x T / |d x T|,   p = c + (v - 1/2) w e                        the point, in the plane through c across the ray
//! n = (T (T . d) - d) / |T (T . d) - d|                                of a flat curve: towards the ray
//! n cos(pi (v - 1/2)) + e sin(pi (v - 1/2))                            of a cylinder
//! N(u) - T (T . N), as a unit vector;   w |N . d| instead of w         of a ribbon
//! dp/du = c',   dp/dv = w times the direction across T and the normal, towards e
//! ```
//!
//! Rays leave from beyond the width: as in pbrt-v4 it is the bound on the point's error.
//!
//! Departures: pbrt-v4's normals point away from the ray, so that those of cylinders lean to the side opposite to that
//! of a cylinder's, and fibres of hair are lit from the other side. Its derivatives of normals are 0; here they are
//! those of a curve that does not twist. Where the tangent is 0, at coinciding control points, it is the chord.

use core::f64::consts::PI;

use glam::DVec3;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::ribbon_normal;

use super::hit::PrimitiveLocation;
use super::{GroupData, NONE, Partials, Surface};
use crate::accel::{CurveSegment, CurveShape};
use crate::convert::{narrow, narrow3, widen3};
use crate::offset::coupled;

/// The centre line at a place.
struct Centre {
    point: DVec3,
    /// `c'`; the chord where that is 0.
    along: DVec3,
    /// `c''`.
    bend: DVec3,
    width: f64,
}

impl GroupData {
    /// The segment of a curve that a primitive is; `None` of others.
    pub(super) fn curve_at(&self, primitive: u32) -> Option<&CurveSegment> {
        let first = self.triangles.len() + self.quadrics.len() + self.patches.len();
        self.curves.get((primitive as usize).checked_sub(first)?)
    }
}

impl CurveSegment {
    fn centre(&self, u: f64) -> Centre {
        let [a, b, c, d] = self.controls.map(|p| DVec3::from(p.map(f64::from)));
        let (ab, bc, cd) = (a.lerp(b, u), b.lerp(c, u), c.lerp(d, u));
        let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
        let along = 3.0 * (bcd - abc);
        let chord = || {
            [d - a, c - a, b - a]
                .into_iter()
                .find(|v| *v != DVec3::ZERO)
        };
        let [from, to] = self.width_at_ends.map(f64::from);
        Centre {
            point: abc.lerp(bcd, u),
            along: match along == DVec3::ZERO {
                true => chord().unwrap_or(DVec3::X),
                false => along,
            },
            bend: 6.0 * ((cd - bc) - (bc - ab)),
            width: (1.0 - u) * from + u * to,
        }
    }

    /// The surface where a ray hits.
    ///
    /// * `direction`: of the ray.
    /// * `is_reversed`: whether the outside is the other side.
    pub(super) fn surface(
        &self,
        [u, v]: [f32; 2],
        direction: Vec3<f32>,
        is_reversed: bool,
    ) -> Surface {
        let [at_u, at_v] = [u, v].map(f64::from);
        let centre = self.centre(at_u);
        let tangent = centre.along.normalize();
        let d = widen3(direction).normalize_or(DVec3::Z);
        let across = (d.cross(tangent))
            .try_normalize()
            .unwrap_or_else(|| tangent.any_orthonormal_vector());
        // It is at right angles to both, and against the ray.
        let facing = across.cross(tangent);
        let mut width = centre.width;
        let normal = match self.shape {
            CurveShape::Flat => facing,
            CurveShape::Cylinder => {
                let (sin, cos) = (PI * (at_v - 0.5)).sin_cos();
                facing * cos + across * sin
            }
            CurveShape::Ribbon(ends) => {
                let own = ribbon_normal(ends, at_u);
                width *= own.dot(d).abs();
                (own - tangent * tangent.dot(own)).normalize_or(facing)
            }
        };
        let position = centre.point + across * ((at_v - 0.5) * width);
        let normal = narrow3(if is_reversed { -normal } else { normal });
        Surface {
            position: narrow3(position),
            error: coupled(narrow3(position.abs())) + Vec3::splat(narrow(width)),
            ng: normal,
            ns: normal,
            tangent: narrow3(centre.along),
            uv: [u, v],
            second_uv: [0.0; 2],
            colour: Rgb::WHITE,
            shape: 0,
            light: NONE,
            at: PrimitiveLocation::default(),
            footprint: None,
        }
    }

    /// The unit normal and the derivatives at a point.
    ///
    /// * `position`, `normal`: of its surface.
    pub(super) fn partials(
        &self,
        [u, v]: [f32; 2],
        [position, normal]: [Vec3<f32>; 2],
        is_reversed: bool,
    ) -> (Vec3<f32>, Partials) {
        let centre = self.centre(f64::from(u));
        let tangent = centre.along.normalize();
        let sign = if is_reversed { -1.0 } else { 1.0 };
        let outwards = widen3(normal);
        let mut across = tangent.cross(outwards * sign).normalize_or_zero();
        if matches!(self.shape, CurveShape::Ribbon(_)) {
            // v grows towards the same side of the ray, whichever side of the ribbon is seen.
            let beside = (widen3(position) - centre.point) * (f64::from(v) - 0.5);
            if beside.dot(across) < 0.0 {
                across = -across;
            }
        }
        let turning = (centre.bend - tangent * tangent.dot(centre.bend)) / centre.along.length();
        let around = match self.shape {
            CurveShape::Cylinder => across * (PI * sign),
            CurveShape::Flat | CurveShape::Ribbon(_) => DVec3::ZERO,
        };
        let partials = Partials {
            dp: [centre.along, across * centre.width].map(narrow3),
            dn: [tangent * -outwards.dot(turning), around].map(narrow3),
        };
        (normal, partials)
    }
}

#[cfg(test)]
mod tests;
