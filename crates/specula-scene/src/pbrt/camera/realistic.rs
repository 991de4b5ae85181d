//! The camera `realistic`: a stack of lenses, replaced by a thin lens of its focal length.

use crate::error::{ErrorKind, Place, SceneError};
use crate::num::f32_of;
use crate::pbrt::context::{Context, Entity};
use crate::scene::{Camera, Film, Projection};

/// Reads the camera.
///
/// * `camera`, `film`: get the field of view, the lens and the exposure of the stand-in.
pub(super) fn read(
    context: &mut Context,
    entity: &Entity,
    diagonal_mm: f64,
    camera: &mut Camera,
    film: &mut Film,
) -> Result<(), SceneError> {
    let params = &entity.params;
    params.ignore(&["aperture"]);
    let Some((name, place)) = params.string("lensfile")? else {
        let message = "camera \"realistic\" needs its \"string lensfile\"";
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &entity.place,
            message,
        ));
    };
    let wrong = |message: String| SceneError::new(ErrorKind::Parameter, place, message);
    let path = context.resolve(name);
    let bytes = match context.files.plain(&path) {
        Ok(bytes) => bytes,
        Err(message) => {
            let error = wrong(format!("lens file {name} {message}"));
            params.record(error.if_missing(context.search.hint(&path), &path))?;
            // pbrt-v4's perspective camera.
            camera.projection = Projection::Perspective { fov_deg: 90.0 };
            params.ignore(&["aperturediameter", "focusdistance"]);
            return Ok(());
        }
    };
    let elements = elements(&String::from_utf8_lossy(&bytes), place)?;
    let focal_mm = focal_length_mm(&elements)
        .ok_or_else(|| wrong(format!("lens file {name}: its lenses do not focus")))?;
    let message = format!(
        "camera \"realistic\" is not supported: a thin lens of {focal_mm:.1} mm is used, without \
         vignetting and distortion"
    );
    context.warn(&entity.place, message);
    let aspect = f64::from(film.resolution[1]) / f64::from(film.resolution[0]);
    let width_mm = (diagonal_mm * diagonal_mm / (1.0 + aspect * aspect)).sqrt();
    let shorter_mm = width_mm * aspect.min(1.0);
    let asked_mm = params.float_above("aperturediameter", 1.0, 0.0)?;
    let stop_mm = elements.iter().find(|e| e.radius_mm == 0.0);
    let aperture_mm = stop_mm.map_or(asked_mm, |e| asked_mm.min(e.aperture_mm));
    camera.focal_distance = params.float_above("focusdistance", 10.0, 0.0)?;
    // pbrt-v4's unit is the metre. The film lies behind the focal point by the lens equation.
    let film_mm = 1.0 / (1.0 / focal_mm - 1e-3 / camera.focal_distance).max(1e-9);
    let fov_deg = 2.0 * (shorter_mm / 2.0 / film_mm).atan().to_degrees();
    camera.projection = Projection::Perspective { fov_deg };
    camera.lens_radius = aperture_mm / 2.0 * 1e-3;
    // Its film measures irradiance: radiance times the solid angle of the lens.
    let f_number = film_mm / aperture_mm;
    film.exposure *= f32_of(std::f64::consts::PI / (4.0 * f_number * f_number));
    Ok(())
}

/// One interface of the stack, from the front; lengths in millimetres.
#[derive(Debug, PartialEq)]
struct Element {
    /// Radius of curvature; 0 for the stop.
    radius_mm: f64,
    /// Distance to the next interface.
    thickness_mm: f64,
    /// Index of refraction behind it; 0 stands for 1.
    eta: f64,
    aperture_mm: f64,
}

/// Groups of four numbers; `#` begins a comment.
fn elements(text: &str, place: &Place) -> Result<Vec<Element>, SceneError> {
    let wrong = |message: &str| SceneError::new(ErrorKind::Parameter, place, message);
    let words = text
        .lines()
        .flat_map(|l| l.split('#').next().unwrap_or("").split_whitespace());
    let numbers: Option<Vec<f64>> = words
        .map(|w| w.parse().ok().filter(|x: &f64| x.is_finite()))
        .collect();
    let numbers = numbers.ok_or_else(|| wrong("the lens file holds what is no number"))?;
    let (groups, rest) = numbers.as_chunks::<4>();
    if groups.is_empty() || !rest.is_empty() {
        return Err(wrong("the lens file: expected four numbers per interface"));
    }
    let element = |&[radius_mm, thickness_mm, eta, aperture_mm]: &[f64; 4]| Element {
        radius_mm,
        thickness_mm,
        eta,
        aperture_mm,
    };
    Ok(groups.iter().map(element).collect())
}

/// Focal length of the stack by a ray near the axis from far away.
///
/// ```text
/// n' u' = n u - h (n' - n) / R,   h' = h + d u',   f = -h_first / u_last
/// ```
///
/// Source: Born and Wolf, section 4.4 (paraxial refraction and transfer).
fn focal_length_mm(elements: &[Element]) -> Option<f64> {
    let (mut height, mut slope, mut index) = (1.0, 0.0, 1.0);
    for element in elements {
        let behind = if element.eta > 0.0 { element.eta } else { 1.0 };
        if element.radius_mm != 0.0 {
            let bend = height * (behind - index) / element.radius_mm;
            slope = (index * slope - bend) / behind;
            index = behind;
        }
        height += element.thickness_mm * slope;
    }
    let focal = -1.0 / slope;
    (focal.is_finite() && focal > 0.0 && focal < 1e6).then_some(focal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::SourceText;

    #[test]
    fn a_thin_lens_has_the_lensmaker_s_focal_length() {
        let place = Place::start(&SourceText::new("lens", ""));
        let lens = elements("# front\n100 0 1.5 20\n-100 50 1 20 # back\n", &place).unwrap();
        let focal = focal_length_mm(&lens).unwrap();
        assert!((focal - 100.0).abs() < 1e-9, "{focal}");
        assert_eq!(focal_length_mm(&lens[..0]), None);
        assert!(elements("1 2 3", &place).is_err());
        assert!(elements("a b c d", &place).is_err());
    }
}
