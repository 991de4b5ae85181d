//! The camera `realistic`: rays through a stack of lenses, from pbrt-v4's files of these.

mod stop;

use std::sync::Arc;

use crate::error::{ErrorKind, Place, SceneError, SourceText};
use crate::pbrt::context::{Context, Entity};
use crate::scene::{Camera, LensInterface, LensSystem, Projection};

/// Most interfaces: more than any lens has, and few enough to be traced before the render begins.
const MOST_INTERFACES: usize = 256;

/// pbrt-v4's unit is the metre, that of lens files the millimetre.
const MM: f64 = 1e-3;

/// Reads the camera.
///
/// * `camera`: gets the lenses and the distance in focus.
pub(super) fn read(
    context: &mut Context,
    entity: &Entity,
    diagonal_mm: f64,
    camera: &mut Camera,
) -> Result<(), SceneError> {
    let params = &entity.params;
    let Some((name, place)) = params.string("lensfile")? else {
        let message = "camera \"realistic\" needs its \"string lensfile\"";
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &entity.place,
            message,
        ));
    };
    let path = context.resolve(name);
    let bytes = match context.files.plain(&path) {
        Ok(bytes) => bytes,
        Err(message) => {
            let message = format!("lens file {name} {message}");
            let error = SceneError::new(ErrorKind::Parameter, place, message);
            params.record(error.if_missing(context.search.hint(&path), &path))?;
            // pbrt-v4's perspective camera.
            camera.projection = Projection::Perspective { fov_deg: 90.0 };
            params.ignore(&["aperturediameter", "aperture", "focusdistance"]);
            return Ok(());
        }
    };
    let text = SourceText::new(path.display().to_string(), String::from_utf8_lossy(&bytes));
    let mut lenses = LensSystem {
        interfaces: interfaces(&text)?,
        stop: stop::read(context, params)?,
        film_diagonal: diagonal_mm * MM,
    };
    let asked = params.float_above("aperturediameter", 1.0, 0.0)? * MM / 2.0;
    for stop in lenses
        .interfaces
        .iter_mut()
        .filter(|i| i.curvature_radius == 0.0)
    {
        if asked > stop.aperture_radius * (1.0 + 1e-9) {
            let message = format!(
                "\"aperturediameter\" {} is beyond that of the lens file: {} is used",
                asked * 2.0 / MM,
                stop.aperture_radius * 2.0 / MM
            );
            context.warn(&params.place_of("aperturediameter"), message);
        }
        stop.aperture_radius = stop.aperture_radius.min(asked);
    }
    camera.focal_distance = params.float_above("focusdistance", 10.0, 0.0)?;
    focus(&mut lenses, camera.focal_distance).map_err(|message| {
        let message = format!("lens file {name}: {message}");
        SceneError::new(
            ErrorKind::Parameter,
            &params.place_of("focusdistance"),
            message,
        )
    })?;
    camera.projection = Projection::Lenses(Box::new(lenses));
    Ok(())
}

/// Puts the film where a plane is in focus.
fn focus(lenses: &mut LensSystem, distance: f64) -> Result<(), String> {
    let thick = (lenses.thick_lens()).ok_or("its lenses do not focus")?;
    let film = thick.film_distance(distance).ok_or_else(|| {
        let nearest = thick.nearest();
        format!("\"focusdistance\" {distance} is too near; its lenses focus from {nearest} on")
    })?;
    if film <= 0.0 {
        return Err(format!(
            "for \"focusdistance\" {distance} the film would be within its lenses"
        ));
    }
    if let Some(last) = lenses.interfaces.last_mut() {
        last.thickness = film;
    }
    Ok(())
}

/// Groups of four numbers, in millimetres; `#` begins a comment.
fn interfaces(text: &Arc<SourceText>) -> Result<Vec<LensInterface>, SceneError> {
    let all = text.text();
    let place = |word: &str| {
        Place::new(
            text,
            word.as_ptr() as usize - all.as_ptr() as usize,
            word.len(),
        )
    };
    let wrong = |word: &str, message: &str| {
        let message = format!("lens file: expected {message}");
        SceneError::new(ErrorKind::Parameter, &place(word), message)
    };
    let words = all
        .lines()
        .flat_map(|l| l.split('#').next().unwrap_or("").split_whitespace());
    let numbers = words
        .map(|word| match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok((x, word)),
            _ => Err(wrong(word, "a number")),
        })
        .collect::<Result<Vec<_>, _>>()?;
    let (rows, rest) = numbers.as_chunks::<4>();
    if rows.is_empty() || !rest.is_empty() {
        let last = numbers.last().map_or(&all[..0], |n| n.1);
        let message = "rows of four numbers: curvature radius, thickness, eta, aperture diameter";
        return Err(wrong(last, message));
    }
    if rows.len() > MOST_INTERFACES {
        let message = format!("at most {MOST_INTERFACES} rows, found {}", rows.len());
        return Err(wrong(rows[MOST_INTERFACES][0].1, &message));
    }
    let interface = |&[radius, thickness, eta, diameter]: &[(f64, &str); 4]| {
        // The last one is replaced when the film is focused.
        if thickness.0 < 0.0 {
            return Err(wrong(thickness.1, "a thickness of 0 or more"));
        }
        if eta.0 < 0.0 {
            return Err(wrong(eta.1, "an index of refraction, or 0 for that of air"));
        }
        if diameter.0 <= 0.0 {
            return Err(wrong(diameter.1, "an aperture diameter above 0"));
        }
        Ok(LensInterface {
            curvature_radius: radius.0 * MM,
            thickness: thickness.0 * MM,
            eta: if eta.0 == 0.0 { 1.0 } else { eta.0 },
            aperture_radius: diameter.0 * MM / 2.0,
        })
    };
    rows.iter().map(interface).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_in_lens_files_are_located() {
        let read = |text: &str| interfaces(&SourceText::new("lens", text));
        let lens = read("# front\n100 0 1.5 20\n0 2 0 8 # stop\n-100 50 1 20\n").unwrap();
        assert_eq!(lens.len(), 3);
        assert_eq!(lens[1].curvature_radius, 0.0);
        assert_eq!([lens[1].eta, lens[1].aperture_radius], [1.0, 0.004]);
        let many = "1 1 1 1\n".repeat(MOST_INTERFACES + 1);
        for (text, line, column, what) in [
            ("", 1, 1, "four numbers"),
            ("1 2 1.5", 1, 5, "four numbers"),
            ("100 0 1.5 20\n-100 x 1 20", 2, 6, "a number"),
            ("100 0 nan 20", 1, 7, "a number"),
            ("100 -1 1.5 20", 1, 5, "thickness"),
            ("100 0 1.5 20\n1 1 -1 2", 2, 5, "index"),
            ("100 0 1.5 0", 1, 11, "aperture"),
            (&many, MOST_INTERFACES + 1, 1, "at most 256"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.message().contains(what), "{text}: {error}");
            assert_eq!([error.line(), error.column()], [line, column], "{error}");
        }
    }
}
