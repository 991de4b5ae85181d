//! Checks of transforms.

use glam::DMat4;

/// Whether a transform is finite (in `f32` as well) and invertible.
///
/// # Errors
///
/// A message saying which it is not.
pub(crate) fn check_transform(m: &DMat4) -> Result<(), &'static str> {
    let limit = f64::from(f32::MAX);
    if m.to_cols_array()
        .iter()
        .any(|x| !x.is_finite() || x.abs() > limit)
    {
        return Err("the transform is not finite in single precision");
    }
    let determinant = m.determinant();
    if determinant == 0.0 || !determinant.is_finite() || !m.inverse().is_finite() {
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
    fn transforms_are_finite_and_invertible() {
        assert!(check_transform(&DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0))).is_err());
        assert!(check_transform(&DMat4::from_scale(DVec3::splat(1e39))).is_err());
        assert!(check_transform(&DMat4::from_scale(DVec3::splat(-1e-6))).is_ok());
    }
}
