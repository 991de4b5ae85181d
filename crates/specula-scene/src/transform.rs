//! Checks of transforms.

use glam::DMat4;

/// Whether a transform is finite, in `f32` as well.
///
/// # Errors
///
/// A message saying that it is not.
pub(crate) fn check_finite(m: &DMat4) -> Result<(), &'static str> {
    let limit = f64::from(f32::MAX);
    if m.to_cols_array()
        .iter()
        .any(|x| !x.is_finite() || x.abs() > limit)
    {
        return Err("the transform is not finite in single precision");
    }
    Ok(())
}

/// Determinants of unit columns below this are rounding: that of zero.
const SINGULAR: f64 = 1e-14;

/// Whether a finite transform can be inverted: others press space flat.
pub(crate) fn is_invertible(m: &DMat4) -> bool {
    let determinant = m.determinant();
    let columns = [m.x_axis, m.y_axis, m.z_axis].map(|c| c.truncate().length());
    let is_flat = determinant.abs() <= SINGULAR * columns.iter().product::<f64>();
    !is_flat && determinant.is_finite() && m.inverse().is_finite()
}

/// Whether an affine transform mirrors.
pub(crate) fn mirrors(m: &DMat4) -> bool {
    m.determinant() < 0.0
}

/// Whether a transform is finite (in `f32` as well) and invertible.
///
/// # Errors
///
/// A message saying which it is not.
pub(crate) fn check_transform(m: &DMat4) -> Result<(), &'static str> {
    check_finite(m)?;
    if !is_invertible(m) {
        return Err(
            "the transform cannot be inverted; expected one with a determinant other than 0",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn what_is_flat_but_for_rounding_cannot_be_inverted() {
        let turned = |z| {
            let scale = DMat4::from_scale(DVec3::new(3.0, 1.0, z));
            DMat4::from_rotation_x(0.3) * scale * DMat4::from_rotation_y(0.7)
        };
        assert!(!is_invertible(&turned(0.0)));
        assert!(is_invertible(&turned(1e-12)));
        assert!(is_invertible(&DMat4::from_scale(DVec3::new(
            1.0, 1.0, 1e-30
        ))));
    }

    #[test]
    fn transforms_are_finite_and_invertible() {
        assert!(check_transform(&DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0))).is_err());
        assert!(check_transform(&DMat4::from_scale(DVec3::splat(1e39))).is_err());
        assert!(check_transform(&DMat4::from_scale(DVec3::splat(-1e-6))).is_ok());
    }
}
