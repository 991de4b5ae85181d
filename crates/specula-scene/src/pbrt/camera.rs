//! Camera, film, filter, sampler and integrator: what stands before `WorldBegin`.

use std::collections::HashMap;

use glam::DMat4;

use super::context::{Context, Entity};
use super::param::ParamList;
use super::token::shorten;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::scene::{Camera, Film, Filter, Settings};

/// Entities by directive.
pub(super) type Options = HashMap<&'static str, Entity>;

/// Largest side of a picture.
const MAX_SIDE: u32 = 65_536;

/// Reads camera, film and settings.
pub(super) fn read(
    context: &mut Context,
    options: &Options,
    camera_to_world: DMat4,
) -> Result<(Camera, Film, Settings), SceneError> {
    let mut film = film(context, options)?;
    let (camera, exposure_time) = camera(context, options, film.resolution, camera_to_world)?;
    film.exposure *= exposure_time;
    let settings = settings(context, options)?;
    Ok((camera, film, settings))
}

fn camera(
    context: &mut Context,
    options: &Options,
    [width, height]: [u32; 2],
    to_world: DMat4,
) -> Result<(Camera, f32), SceneError> {
    let none = ParamList::default();
    let entity = options.get("Camera");
    let params = entity.map_or(&none, |e| &e.params);
    if let Some(entity) = entity.filter(|e| e.name != "perspective") {
        let message = format!(
            "camera \"{}\" is not supported: a picture by another camera would not be the one asked for",
            shorten(&entity.name)
        );
        return Err(
            SceneError::new(ErrorKind::Unsupported, &entity.place, message)
                .with_help("expected \"perspective\""),
        );
    }
    let own = f64::from(width) / f64::from(height);
    let aspect = params.float_above("frameaspectratio", own, 0.0)?;
    let screen_window = match params.array::<4>("screenwindow", &["float"])? {
        Some([x0, x1, y0, y1]) if x0 < x1 && y0 < y1 => [x0, x1, y0, y1],
        Some(_) => {
            let place = params.place_of("screenwindow");
            let message = "\"screenwindow\": expected x0 < x1 and y0 < y1";
            return Err(SceneError::new(ErrorKind::Parameter, &place, message));
        }
        None if aspect > 1.0 => [-aspect, aspect, -1.0, 1.0],
        None => [-1.0, 1.0, -1.0 / aspect, 1.0 / aspect],
    };
    let fov_deg = params.float_above("fov", 90.0, 0.0)?;
    if fov_deg >= 180.0 {
        let message = format!("\"fov\": expected an angle below 180 degrees, found {fov_deg}");
        return Err(SceneError::new(
            ErrorKind::Parameter,
            &params.place_of("fov"),
            message,
        ));
    }
    let (open, close) = (
        params.float("shutteropen", 0.0)?,
        params.float("shutterclose", 1.0)?,
    );
    if close <= open {
        let place = entity.map_or_else(|| params.place_of("shutterclose"), |e| e.place.clone());
        let message = "expected a shutter that closes after it opens";
        return Err(SceneError::new(ErrorKind::Parameter, &place, message));
    }
    let camera = Camera {
        to_world,
        fov_deg,
        lens_radius: params.float_from_zero("lensradius", 0.0)?,
        focal_distance: params.float_above("focaldistance", 1e6, 0.0)?,
        screen_window,
    };
    context.warn_unused(params);
    Ok((camera, f32_of(close - open)))
}

fn film(context: &mut Context, options: &Options) -> Result<Film, SceneError> {
    let none = ParamList::default();
    let entity = options.get("Film");
    let params = entity.map_or(&none, |e| &e.params);
    if let Some(entity) = entity.filter(|e| e.name != "rgb") {
        let message = format!(
            "film \"{}\" is not supported: \"rgb\" is used",
            shorten(&entity.name)
        );
        params.ignore(&["nbuckets", "lambdamin", "lambdamax", "coordinatesystem"]);
        context.warn(&entity.place, message);
    }
    // How the file is written is the renderer's affair.
    params.ignore(&["savefp16", "diagonal", "maxcomponentvalue"]);
    if let Some((sensor, place)) = params.string("sensor")?
        && sensor != "cie1931"
    {
        let message = format!(
            "sensor \"{}\" is not supported: \"cie1931\" is used",
            shorten(sensor)
        );
        context.warn(place, message);
    }
    let resolution = [
        params.integer_within("xresolution", 1280, 1..=MAX_SIDE)?,
        params.integer_within("yresolution", 720, 1..=MAX_SIDE)?,
    ];
    let film = Film {
        resolution,
        crop: crop(params, resolution)?,
        filter: filter(context, options.get("PixelFilter"))?,
        exposure: f32_of(params.float_above("iso", 100.0, 0.0)? / 100.0),
        file_name: params.string("filename")?.map(|(name, _)| name.to_owned()),
    };
    context.warn_unused(params);
    Ok(film)
}

/// Pixels to render. pbrt-v4 lets `cropwindow` win over `pixelbounds`.
fn crop(params: &ParamList, [width, height]: [u32; 2]) -> Result<[u32; 4], SceneError> {
    let empty = |name: &str| {
        let message = format!(
            "\"{name}\": no pixel is left; expected x0 < x1 and y0 < y1 within the picture"
        );
        SceneError::new(ErrorKind::Parameter, &params.place_of(name), message)
    };
    let sizes = [width, width, height, height];
    let bounds = params.array::<4>("pixelbounds", &["integer"])?;
    let window = params.array::<4>("cropwindow", &["float"])?;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=size first"
    )]
    let pixel = |x: f64, size: u32| x.clamp(0.0, f64::from(size)) as u32;
    let (name, crop) = match (window, bounds) {
        (Some(w), _) => {
            let at = |i: usize| pixel((w[i] * f64::from(sizes[i])).ceil(), sizes[i]);
            ("cropwindow", [at(0), at(1), at(2), at(3)])
        }
        (None, Some(b)) => {
            let at = |i: usize| pixel(b[i], sizes[i]);
            ("pixelbounds", [at(0), at(1), at(2), at(3)])
        }
        (None, None) => return Ok([0, width, 0, height]),
    };
    if crop[0] < crop[1] && crop[2] < crop[3] {
        Ok(crop)
    } else {
        Err(empty(name))
    }
}

fn filter(context: &mut Context, entity: Option<&Entity>) -> Result<Filter, SceneError> {
    let Some(entity) = entity else {
        return Ok(Filter::Gaussian {
            radius: [1.5; 2],
            sigma: 0.5,
        });
    };
    let params = &entity.params;
    let radius = |default: f64| -> Result<[f32; 2], SceneError> {
        let side = |name: &str| -> Result<f32, SceneError> {
            let r = params.float_above(name, default, 0.0)?;
            if r <= 64.0 {
                return Ok(f32_of(r));
            }
            let message = format!("\"{name}\": expected at most 64 pixels, found {r}");
            Err(SceneError::new(
                ErrorKind::Parameter,
                &params.place_of(name),
                message,
            ))
        };
        Ok([side("xradius")?, side("yradius")?])
    };
    let filter = match entity.name.as_str() {
        "box" => Filter::Box {
            radius: radius(0.5)?,
        },
        "triangle" => Filter::Triangle {
            radius: radius(2.0)?,
        },
        "gaussian" => Filter::Gaussian {
            radius: radius(1.5)?,
            sigma: f32_of(params.float_above("sigma", 0.5, 0.0)?),
        },
        "mitchell" => Filter::Mitchell {
            radius: radius(2.0)?,
            b: f32_of(params.float("B", 1.0 / 3.0)?),
            c: f32_of(params.float("C", 1.0 / 3.0)?),
        },
        "sinc" => Filter::LanczosSinc {
            radius: radius(4.0)?,
            tau: f32_of(params.float_above("tau", 3.0, 0.0)?),
        },
        other => {
            let message = format!("unknown filter \"{}\"", shorten(other));
            return Err(
                SceneError::new(ErrorKind::Parameter, &entity.place, message)
                    .with_help("expected box, triangle, gaussian, mitchell or sinc"),
            );
        }
    };
    context.warn_unused(params);
    Ok(filter)
}

fn settings(context: &mut Context, options: &Options) -> Result<Settings, SceneError> {
    let mut settings = Settings {
        max_depth: 5,
        samples_per_pixel: 16,
    };
    if let Some(entity) = options.get("Integrator") {
        let params = &entity.params;
        if !matches!(entity.name.as_str(), "path" | "volpath") {
            let message = format!(
                "integrator \"{}\" is not supported: paths are traced",
                shorten(&entity.name)
            );
            context.warn(&entity.place, message);
        }
        settings.max_depth = params.integer_within("maxdepth", 5, 0..=1_000_000)?;
        if params.bool("regularize", false)? {
            context.warn(&params.place_of("regularize"), "paths are not regularized");
        }
        // How lights are chosen and paths ended is the renderer's affair.
        params.ignore(&["lightsampler", "rrthreshold"]);
        context.warn_unused(params);
    }
    if let Some(entity) = options.get("Sampler") {
        let params = &entity.params;
        const MOST: u32 = 1 << 24;
        settings.samples_per_pixel = if entity.name == "stratified" {
            let side = |name: &str| params.integer_within(name, 4, 1..=4096);
            side("xsamples")? * side("ysamples")?
        } else {
            params.integer_within("pixelsamples", 16, 1..=MOST)?
        };
        // Every sampler of pbrt's gives the same picture in the limit; seeds are the user's.
        params.ignore(&["seed", "randomization", "jitter"]);
        context.warn_unused(params);
    }
    Ok(settings)
}
