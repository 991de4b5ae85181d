//! `Camera` and the other directives before `WorldBegin`.

mod film;
mod realistic;
mod settings;

use std::collections::HashMap;

use glam::{DMat4, DVec4};

use super::context::{Context, Entity};
use super::motion::Exposure;
use super::param::ParamList;
use crate::bounds::BoundingBox;
use crate::error::{ErrorKind, SceneError};
use crate::num::{f32_of, shorten};
use crate::scene::{Camera, EnvironmentMapping, Film, Motion, Projection, Settings};
use crate::stage;

/// Entities by directive.
pub(super) type OptionEntities = HashMap<&'static str, Entity>;

/// Reads camera, film and settings; the shutter becomes part of the film's exposure.
///
/// * `camera_to_world`: at the start, and at the end where it moves; `times`: of both.
pub(super) fn read(
    context: &mut Context,
    options: &OptionEntities,
    camera_to_world: (DMat4, Option<DMat4>),
    times: [f64; 2],
) -> Result<(Camera, Film, Settings, Exposure), SceneError> {
    let film = film::read(context, options);
    let mut film = or(options.get("Film"), film, || stage::film([1280, 720]))?;
    let entity = options.get("Camera");
    let shutter = or(entity, shutter(entity), || [0.0, 1.0])?;
    film.exposure *= f32_of(shutter[1] - shutter[0]);
    let exposure = Exposure::new(times, shutter);
    let mut placed = (camera_to_world.0, None);
    if let Some(Entity { place, .. }) = entity {
        let (start, end) = camera_to_world;
        placed = exposure.place(context, ("camera", place), start, end);
    }
    let camera = lens(context, options, placed, film.resolution);
    let camera = or(options.get("Camera"), camera, || {
        stage::camera(BoundingBox::EMPTY, film.resolution)
    })?;
    Ok((camera, film, settings::read(context, options)?, exposure))
}

/// What was read of a directive, if there is one, or a stand-in where its mistakes are recorded.
fn or<T>(
    entity: Option<&Entity>,
    read: Result<T, SceneError>,
    stand_in: impl FnOnce() -> T,
) -> Result<T, SceneError> {
    match entity {
        Some(entity) => entity.or(read, stand_in),
        None => read,
    }
}

/// Reads the camera.
fn lens(
    context: &mut Context,
    options: &OptionEntities,
    (to_world, motion): (DMat4, Option<Motion>),
    resolution: [u32; 2],
) -> Result<Camera, SceneError> {
    let none = ParamList::default();
    let entity = options.get("Camera");
    let params = entity.map_or(&none, |e| &e.params);
    let name = entity.map_or("perspective", |e| e.name.as_str());
    // A stack of lenses has no parameters of a thin one.
    let of_thin = if name == "realistic" { &none } else { params };
    let mut camera = Camera {
        to_world,
        motion,
        projection: Projection::Orthographic,
        lens_radius: of_thin.float_from_zero("lensradius", 0.0)?,
        focal_distance: of_thin.float_above("focaldistance", 1e6, 0.0)?,
        screen_window: screen_window(of_thin, resolution)?,
    };
    match (name, entity) {
        ("perspective", _) => camera.projection = perspective(params)?,
        ("orthographic", _) => {}
        ("spherical", _) => {
            camera.projection = Projection::Spherical(mapping(params)?);
            camera.lens_radius = 0.0;
            // Maps have their pole at +z, pbrt-v4's camera has it at +y.
            let swap = DMat4::from_cols(DVec4::X, DVec4::Z, DVec4::Y, DVec4::W);
            camera.to_world *= swap;
            if let Some(motion) = &mut camera.motion {
                motion.end *= swap;
            }
        }
        ("realistic", Some(entity)) => {
            let diagonal_mm = film::diagonal_mm(options)?;
            realistic::read(context, entity, diagonal_mm, &mut camera)?;
        }
        (other, entity) => {
            let message = format!("unknown camera \"{}\"", shorten(other));
            let place = entity.map_or_else(|| params.place_of("type"), |e| e.place.clone());
            let error = SceneError::new(ErrorKind::Unsupported, &place, message);
            return Err(
                error.with_help("expected perspective, orthographic, spherical or realistic")
            );
        }
    }
    context.warn_unused(params);
    Ok(camera)
}

/// When the shutter opens and closes.
fn shutter(entity: Option<&Entity>) -> Result<[f64; 2], SceneError> {
    let Some(Entity { params, place, .. }) = entity else {
        return Ok([0.0, 1.0]);
    };
    let open = params.float("shutteropen", 0.0)?;
    let close = params.float("shutterclose", 1.0)?;
    if close != open {
        // pbrt-v4 swaps times that are the wrong way round.
        return Ok([open.min(close), open.max(close)]);
    }
    let message = "expected a shutter that closes after it opens";
    Err(SceneError::new(ErrorKind::Parameter, place, message))
}

fn screen_window(params: &ParamList, [width, height]: [u32; 2]) -> Result<[f64; 4], SceneError> {
    let own = f64::from(width) / f64::from(height);
    let aspect = params.float_above("frameaspectratio", own, 0.0)?;
    match params.array::<4>("screenwindow", &["float"])? {
        Some([x0, x1, y0, y1]) if x0 < x1 && y0 < y1 => Ok([x0, x1, y0, y1]),
        Some(_) => {
            let place = params.place_of("screenwindow");
            let message = "\"screenwindow\": expected x0 < x1 and y0 < y1";
            Err(SceneError::new(ErrorKind::Parameter, &place, message))
        }
        None if aspect > 1.0 => Ok([-aspect, aspect, -1.0, 1.0]),
        None => Ok([-1.0, 1.0, -1.0 / aspect, 1.0 / aspect]),
    }
}

fn perspective(params: &ParamList) -> Result<Projection, SceneError> {
    let fov_deg = params.float_above("fov", 90.0, 0.0)?;
    if fov_deg < 180.0 {
        return Ok(Projection::Perspective { fov_deg });
    }
    let message = format!("\"fov\": expected an angle below 180 degrees, found {fov_deg}");
    let place = params.place_of("fov");
    Err(SceneError::new(ErrorKind::Parameter, &place, message))
}

fn mapping(params: &ParamList) -> Result<EnvironmentMapping, SceneError> {
    match params.string("mapping")? {
        None | Some(("equalarea", _)) => Ok(EnvironmentMapping::EqualAreaOctahedral),
        Some(("equirectangular", _)) => Ok(EnvironmentMapping::LatitudeLongitude),
        Some((other, place)) => {
            let message = format!(
                "expected mapping \"equalarea\" or \"equirectangular\", found \"{}\"",
                shorten(other)
            );
            Err(SceneError::new(ErrorKind::Parameter, place, message))
        }
    }
}
