//! `<transform>`: operations from top to bottom, each applied after those above it.

use glam::{DMat3, DMat4, DVec3};

use super::number::{number, numbers, triple};

/// One operation inside `<transform>`, by its tag.
///
/// * `attribute`: value of an attribute of the operation.
/// * Returns: `None` where the tag is no operation.
///
/// # Errors
///
/// A message that says what was expected.
pub(super) fn operation<'a>(
    tag: &str,
    attribute: impl Fn(&str) -> Option<&'a str>,
) -> Option<Result<DMat4, String>> {
    Some(match tag {
        "translate" => vector(&attribute, 0.0).map(DMat4::from_translation),
        "scale" => vector(&attribute, 1.0).map(DMat4::from_scale),
        "rotate" => rotate(&attribute),
        "lookat" | "lookAt" | "look_at" => look_at(&attribute),
        "matrix" => matrix(attribute("value")),
        _ => return None,
    })
}

/// `x`, `y` and `z`, or `value`, which holds one number for all or three.
fn vector<'a>(attribute: &impl Fn(&str) -> Option<&'a str>, default: f64) -> Result<DVec3, String> {
    if let Some(value) = attribute("value") {
        return triple(value).map(DVec3::from);
    }
    let mut v = [default; 3];
    for (name, x) in ["x", "y", "z"].iter().zip(&mut v) {
        if let Some(text) = attribute(name) {
            *x = number(text)?;
        }
    }
    Ok(v.into())
}

fn rotate<'a>(attribute: &impl Fn(&str) -> Option<&'a str>) -> Result<DMat4, String> {
    let angle = attribute("angle").ok_or("<rotate> needs an attribute \"angle\", in degrees")?;
    let axis = vector(attribute, 0.0)?
        .try_normalize()
        .ok_or("<rotate> needs an axis: at least one of \"x\", \"y\" and \"z\" that is not 0")?;
    Ok(DMat4::from_axis_angle(axis, number(angle)?.to_radians()))
}

/// Columns: left, up, the view direction and the origin, as Mitsuba's camera space has them.
fn look_at<'a>(attribute: &impl Fn(&str) -> Option<&'a str>) -> Result<DMat4, String> {
    let point = |name: &str| -> Result<Option<DVec3>, String> {
        attribute(name).map_or(Ok(None), |text| match numbers(text)?.as_slice() {
            &[x, y, z] => Ok(Some(DVec3::new(x, y, z))),
            other => Err(format!(
                "\"{name}\": expected three numbers, found {}",
                other.len()
            )),
        })
    };
    let (Some(origin), Some(target)) = (point("origin")?, point("target")?) else {
        return Err("<lookat> needs \"origin\" and \"target\"".to_owned());
    };
    let direction = (target - origin)
        .try_normalize()
        .ok_or("<lookat>: \"origin\" and \"target\" are the same point")?;
    let up = point("up")?
        .filter(|up| *up != DVec3::ZERO)
        .unwrap_or_else(|| direction.any_orthonormal_vector());
    let left = up
        .cross(direction)
        .try_normalize()
        .ok_or("<lookat>: \"up\" points along the view")?;
    let up = direction.cross(left);
    Ok(DMat4::from_cols(
        left.extend(0.0),
        up.extend(0.0),
        direction.extend(0.0),
        origin.extend(1.0),
    ))
}

/// Row by row: a whole matrix, or its upper left 3 by 3.
fn matrix(value: Option<&str>) -> Result<DMat4, String> {
    let numbers = numbers(value.ok_or("<matrix> needs an attribute \"value\"")?)?;
    if let Ok(rows) = <&[f64; 9]>::try_from(numbers.as_slice()) {
        return Ok(DMat4::from_mat3(DMat3::from_cols_array(rows).transpose()));
    }
    let rows = <&[f64; 16]>::try_from(numbers.as_slice()).map_err(|_| {
        format!(
            "<matrix>: expected 9 or 16 numbers, found {}",
            numbers.len()
        )
    })?;
    if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err("<matrix>: expected a last row of 0 0 0 1".to_owned());
    }
    Ok(DMat4::from_cols_array(rows).transpose())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn operate(tag: &str, attributes: &[(&str, &str)]) -> Result<DMat4, String> {
        let find = |name: &str| attributes.iter().find(|(n, _)| *n == name).map(|a| a.1);
        operation(tag, find).unwrap()
    }

    #[test]
    fn lookat_has_left_up_and_view() {
        let m = operate(
            "lookat",
            &[("origin", "-4 0 0"), ("target", "0,0,0"), ("up", "0 0 1")],
        );
        let m = m.unwrap();
        assert_eq!(m.transform_vector3(DVec3::Z), DVec3::X);
        assert_eq!(m.transform_vector3(DVec3::Y), DVec3::Z);
        // Looking along +x with +z up, +y is to the left.
        assert_eq!(m.transform_vector3(DVec3::X), DVec3::Y);
        assert_eq!(m.transform_point3(DVec3::ZERO), DVec3::new(-4.0, 0.0, 0.0));
    }

    #[test]
    fn matrices_are_row_by_row() {
        let m = operate("matrix", &[("value", "1 2 3 4  0 1 0 5  0 0 1 6  0 0 0 1")]).unwrap();
        assert_eq!(m.transform_point3(DVec3::Y), DVec3::new(6.0, 6.0, 6.0));
        let m = operate("matrix", &[("value", "1 2 3  0 1 0  0 0 1")]).unwrap();
        assert_eq!(m.transform_point3(DVec3::Y), DVec3::new(2.0, 1.0, 0.0));
    }

    #[test]
    fn faults_are_named() {
        for (tag, attributes, part) in [
            ("rotate", &[("angle", "90")][..], "an axis"),
            ("rotate", &[("x", "1")], "\"angle\""),
            ("matrix", &[("value", "1 2")], "found 2"),
            (
                "matrix",
                &[("value", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1")],
                "last row",
            ),
            (
                "lookat",
                &[("origin", "0 0 0"), ("target", "0 0 0")],
                "same point",
            ),
            (
                "lookat",
                &[("origin", "0 0 0"), ("target", "0 1 0"), ("up", "0 2 0")],
                "along the view",
            ),
            ("scale", &[("value", "1 2")], "one or three"),
        ] {
            let message = operate(tag, attributes).unwrap_err();
            assert!(message.contains(part), "{message}");
        }
        assert!(operation("shear", |_| None).is_none());
    }
}
