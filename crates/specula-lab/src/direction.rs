//! Directions by angles in degrees.

use specula_bsdf::Vec3;

/// A direction by its angle from the normal and its azimuth, degrees; on the other side of the normal where the
/// angle is below 0.
pub(crate) fn direction(theta_deg: f64, phi_deg: f64) -> Vec3<f64> {
    let (sin, cos) = theta_deg.to_radians().sin_cos();
    let (sin_phi, cos_phi) = phi_deg.to_radians().sin_cos();
    Vec3 {
        x: sin * cos_phi,
        y: sin * sin_phi,
        z: cos,
    }
}
