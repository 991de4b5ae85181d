//! `hair`: pbrt-v4's parameters, which of them take precedence, and its defaults.

use crate::error::{ErrorKind, SceneError};
use crate::pbrt::colour::{self, Colour};
use crate::pbrt::context::{Context, Entity};
use crate::pbrt::param::ParamList;
use crate::scene::{FloatParam, HairMaterial, HairPigment};

/// Reads the material `hair`.
pub(super) fn read(context: &mut Context, entity: &Entity) -> Result<HairMaterial, SceneError> {
    let params = &entity.params;
    let pigment = pigment(context, params)?;
    let eta = context.float(params, "eta", 1.55)?;
    if let FloatParam::Value(eta) = eta
        && !(eta > 0.0 && eta.is_finite())
    {
        let message = format!("\"eta\": expected an index of refraction above 0, found {eta}");
        let place = params.place_of("eta");
        return Err(SceneError::new(ErrorKind::Parameter, &place, message));
    }
    Ok(HairMaterial {
        pigment,
        eta,
        beta_m: roughness(context, params, "beta_m")?,
        beta_n: roughness(context, params, "beta_n")?,
        alpha_deg: context.float(params, "alpha", 2.0)?,
    })
}

/// Absorption before reflectance before concentrations; brown without any.
fn pigment(context: &mut Context, params: &ParamList) -> Result<HairPigment, SceneError> {
    let sigma_a = colour::colour(context, params, "sigma_a")?;
    let reflectance = match colour::albedo_or_none(context, params, "reflectance")? {
        None => colour::albedo_or_none(context, params, "color")?,
        some => some,
    };
    let eumelanin = concentration(context, params, "eumelanin")?;
    let pheomelanin = concentration(context, params, "pheomelanin")?;
    if let Some(sigma_a) = sigma_a.as_ref().map(Colour::under_white) {
        let others = ["reflectance", "color", "eumelanin", "pheomelanin"];
        warn_of_ignored(context, params, &others, "sigma_a");
        return Ok(HairPigment::Absorption(sigma_a));
    }
    if let Some(reflectance) = reflectance {
        let others = ["eumelanin", "pheomelanin"];
        warn_of_ignored(context, params, &others, "reflectance");
        return Ok(HairPigment::Reflectance(reflectance));
    }
    let none = eumelanin.is_none() && pheomelanin.is_none();
    let absent = FloatParam::Value(if none { 1.3 } else { 0.0 });
    Ok(HairPigment::Melanin {
        eumelanin: eumelanin.unwrap_or(absent),
        pheomelanin: pheomelanin.unwrap_or(FloatParam::Value(0.0)),
    })
}

fn warn_of_ignored(context: &mut Context, params: &ParamList, names: &[&str], by: &str) {
    for name in names.iter().filter(|name| params.find(name).is_some()) {
        let message = format!("\"{name}\" has no effect beside \"{by}\"");
        context.warn(&params.place_of(name), message);
    }
}

/// A concentration of pigment: negative ones are 0, as in pbrt-v4.
fn concentration(
    context: &mut Context,
    params: &ParamList,
    name: &str,
) -> Result<Option<FloatParam>, SceneError> {
    let value = context.float_or_none(params, name)?;
    if let Some(FloatParam::Value(x)) = value
        && x < 0.0
    {
        let message = format!("\"{name}\" is below 0: 0 is used");
        context.warn(&params.place_of(name), message);
        return Ok(Some(FloatParam::Value(0.0)));
    }
    Ok(value)
}

/// A roughness of hair: within `[0, 1]`, as in pbrt-v4.
fn roughness(
    context: &mut Context,
    params: &ParamList,
    name: &str,
) -> Result<FloatParam, SceneError> {
    let value = context.float(params, name, 0.3)?;
    if let FloatParam::Value(x) = value
        && !(0.0..=1.0).contains(&x)
    {
        let within = x.clamp(0.0, 1.0);
        let message = format!("\"{name}\" is {x}, not from 0 to 1: {within} is used");
        context.warn(&params.place_of(name), message);
        return Ok(FloatParam::Value(within));
    }
    Ok(value)
}
