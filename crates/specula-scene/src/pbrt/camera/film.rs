//! `Film` and `PixelFilter`.

use super::OptionEntities;
use crate::error::{ErrorKind, SceneError};
use crate::num::{f32_of, shorten};
use crate::pbrt::context::{Context, Entity};
use crate::pbrt::param::ParamList;
use crate::scene::{Film, Filter};
use crate::spectrum::white_balance;

/// Largest side of a picture.
const MAX_SIDE: u32 = 65_536;

const DEFAULT_FILTER: Filter = Filter::Gaussian {
    radius: [1.5; 2],
    sigma: 0.5,
};

/// Cameras whose sensitivities pbrt-v4 knows. Its sensors are fitted so that the light of the white
/// balance has the luminance that the eye sees: brightness does not depend on them.
pub(in crate::pbrt) const SENSORS: [&str; 17] = [
    "canon_eos_100d",
    "canon_eos_1dx_mkii",
    "canon_eos_200d",
    "canon_eos_200d_mkii",
    "canon_eos_5d",
    "canon_eos_5d_mkii",
    "canon_eos_5d_mkiii",
    "canon_eos_5d_mkiv",
    "canon_eos_5ds",
    "canon_eos_m",
    "hasselblad_l1d_20c",
    "nikon_d810",
    "nikon_d850",
    "sony_ilce_6400",
    "sony_ilce_7m3",
    "sony_ilce_7rm3",
    "sony_ilce_9",
];

/// Diagonal of the film, in millimetres.
pub(super) fn diagonal_mm(options: &OptionEntities) -> Result<f64, SceneError> {
    match options.get("Film") {
        Some(entity) => entity.params.float_above("diagonal", 35.0, 0.0),
        None => Ok(35.0),
    }
}

/// Reads the film. Its exposure lacks the shutter's time.
pub(super) fn read(context: &mut Context, options: &OptionEntities) -> Result<Film, SceneError> {
    let none = ParamList::default();
    let entity = options.get("Film");
    let params = entity.map_or(&none, |e| &e.params);
    match entity.map(|e| (e.name.as_str(), e)) {
        None | Some(("rgb", _)) => {}
        Some((name @ ("gbuffer" | "spectral"), entity)) => {
            params.ignore(&["nbuckets", "lambdamin", "lambdamax", "coordinatesystem"]);
            let message = format!("film \"{name}\" is not supported: \"rgb\" is used");
            context.warn(&entity.place, message);
        }
        Some((other, entity)) => {
            let message = format!("unknown film \"{}\"", shorten(other));
            let error = SceneError::new(ErrorKind::Parameter, &entity.place, message);
            return Err(error.with_help("expected rgb, gbuffer or spectral"));
        }
    }
    // How the file is written is the renderer's affair; the diagonal concerns one camera alone.
    params.ignore(&["savefp16", "diagonal"]);
    let balance = match sensor_kelvin(context, params)? {
        Some(kelvin) => white_balance(kelvin),
        None => Film::NO_BALANCE,
    };
    let resolution = [
        params.integer_within("xresolution", 1280, 1..=MAX_SIDE)?,
        params.integer_within("yresolution", 720, 1..=MAX_SIDE)?,
    ];
    let max_component = match params.find("maxcomponentvalue") {
        Some(_) => Some(f32_of(params.float_above("maxcomponentvalue", 1.0, 0.0)?)),
        None => None,
    };
    let film = Film {
        resolution,
        crop: crop(params, resolution)?,
        filter: match options.get("PixelFilter") {
            Some(entity) => {
                let read = filter(context, entity);
                entity.or(read, || DEFAULT_FILTER)?
            }
            None => DEFAULT_FILTER,
        },
        exposure: f32_of(params.float_above("iso", 100.0, 0.0)? / 100.0),
        max_component: max_component.filter(|m| *m > 0.0),
        balance,
        file_name: params.string("filename")?.map(|(name, _)| name.to_owned()),
    };
    context.warn_unused(params);
    Ok(film)
}

/// The colour temperature that becomes white, or `None` for no balance.
fn sensor_kelvin(context: &mut Context, params: &ParamList) -> Result<Option<f64>, SceneError> {
    let kelvin = params.float_from_zero("whitebalance", 0.0)?;
    if kelvin > 0.0 && !(100.0..=1e6).contains(&kelvin) {
        let message =
            format!("\"whitebalance\": expected 0, or from 100 to 1e6 kelvin, found {kelvin}");
        let place = params.place_of("whitebalance");
        return Err(SceneError::new(ErrorKind::Parameter, &place, message));
    }
    let sensor = params.string("sensor")?;
    match sensor {
        None | Some(("cie1931", _)) => {}
        Some((name, place)) if SENSORS.contains(&name) => {
            let message = format!(
                "sensor \"{name}\": the eye's own curves are used; brightness is the same, saturated \
                 colours may differ"
            );
            context.warn(place, message);
            if kelvin == 0.0 {
                return Ok(Some(6500.0));
            }
        }
        Some((name, place)) => {
            let message = format!("unknown sensor \"{}\"", shorten(name));
            let error = SceneError::new(ErrorKind::Parameter, place, message);
            return Err(error.with_help(format!("expected cie1931, {}", SENSORS.join(", "))));
        }
    }
    Ok((kelvin > 0.0).then_some(kelvin))
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
            let at = |i: usize, w: f64| pixel((w * f64::from(sizes[i])).ceil(), sizes[i]);
            let pair = |i: usize| [at(i, w[i].min(w[i + 1])), at(i, w[i].max(w[i + 1]))];
            let ([x0, x1], [y0, y1]) = (pair(0), pair(2));
            ("cropwindow", [x0, x1, y0, y1])
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

fn filter(context: &mut Context, entity: &Entity) -> Result<Filter, SceneError> {
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
