//! The unit disk as a map of the unit square.

/// A point of the unit disk, area-preserving and continuous.
///
/// Source: Shirley and Chiu 1997, in the branch-lean form of Cline (Shirley 2011).
#[inline]
pub(crate) fn concentric_disk(u: [f32; 2]) -> [f32; 2] {
    use core::f32::consts::{FRAC_PI_2, FRAC_PI_4};
    let a = 2.0 * u[0] - 1.0;
    let b = 2.0 * u[1] - 1.0;
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let (r, phi) = if a * a > b * b {
        (a, FRAC_PI_4 * (b / a))
    } else {
        (b, FRAC_PI_2 - FRAC_PI_4 * (a / b))
    };
    [r * phi.cos(), r * phi.sin()]
}
