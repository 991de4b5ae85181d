//! Reflectances of metals out of parameters.

use specula_bsdf::fresnel::{self, Conductor, F82Tint, Schlick};
use specula_bsdf::math::{Real, Rgb};
use specula_bsdf::metals::{METALS, Metal, by_symbol};

use crate::LobeError;
use crate::given::{Given, Value};

#[derive(Clone, Copy)]
enum Model {
    Constant(Rgb<f64>),
    Conductor(Rgb<f64>, Rgb<f64>),
    Schlick(Rgb<f64>),
    F82Tint(Rgb<f64>, Rgb<f64>),
}

/// A reflectance in double precision.
#[derive(Clone, Copy)]
pub(crate) struct Reflectance {
    model: Model,
    tint: Rgb<f64>,
}

/// A measured metal.
///
/// # Errors
/// Where there is none of this symbol.
pub fn metal(symbol: &str) -> Result<&'static Metal, LobeError> {
    by_symbol(symbol).ok_or_else(|| {
        let known = symbols().join(", ");
        LobeError(format!(
            "no such metal: '{symbol}' (expected one of {known})"
        ))
    })
}

/// The symbols of the measured metals.
pub(crate) fn symbols() -> Vec<&'static str> {
    METALS.iter().map(|m| m.symbol).collect()
}

impl Reflectance {
    /// What is given; `None`: nothing is.
    pub(crate) fn given(given: Given<'_>) -> Result<Option<Self>, String> {
        let f0 = given.colour("f0")?;
        let f82 = given.colour("f82_tint")?;
        let eta = given.colour("conductor_eta")?;
        let k = given.colour("conductor_k")?;
        let named = match given.get("reflectance") {
            None => None,
            Some(Value::Word(symbol)) => {
                let metal = metal(symbol).map_err(|e| e.to_string())?;
                Some(Model::Conductor(metal.eta.into(), metal.k.into()))
            }
            Some(_) => given.colour("reflectance")?.map(Model::Constant),
        };
        let schlick = match (f0, f82) {
            (None, None) => None,
            (Some(f0), None) => Some(Model::Schlick(f0)),
            (Some(f0), Some(tint)) => Some(Model::F82Tint(f0, tint)),
            (None, Some(_)) => return Err("f82_tint: expected f0, too".to_owned()),
        };
        let exact = match (eta, k) {
            (None, None) => None,
            (Some(eta), Some(k)) => Some(Model::Conductor(eta, k)),
            _ => return Err("expected both conductor_eta and conductor_k".to_owned()),
        };
        let mut models = [named, schlick, exact].into_iter().flatten();
        let model = models.next();
        if models.next().is_some() {
            return Err(
                "expected one of reflectance, f0, or conductor_eta and conductor_k".to_owned(),
            );
        }
        let tint = given.colour("tint")?;
        match (model, tint) {
            (None, Some(_)) => Err("tint: expected a reflectance, too".to_owned()),
            (model, tint) => Ok(model.map(|model| Self {
                model,
                tint: tint.unwrap_or(Rgb::WHITE),
            })),
        }
    }

    /// What is given, or a mirror's.
    pub(crate) fn or_white(given: Given<'_>) -> Result<Self, String> {
        let white = Self {
            model: Model::Constant(Rgb::WHITE),
            tint: Rgb::WHITE,
        };
        Ok(Self::given(given)?.unwrap_or(white))
    }

    /// In a precision.
    pub(crate) fn cast<T: Real>(&self) -> fresnel::Reflectance<T> {
        let untinted = match self.model {
            Model::Constant(colour) => fresnel::Reflectance::Constant(colour.cast()),
            Model::Conductor(eta, k) => fresnel::Reflectance::Conductor(Conductor {
                eta: eta.cast(),
                k: k.cast(),
            }),
            Model::Schlick(f0) => fresnel::Reflectance::Schlick(Schlick { f0: f0.cast() }),
            Model::F82Tint(f0, tint) => {
                fresnel::Reflectance::F82Tint(F82Tint::new(f0.cast(), tint.cast()))
            }
        };
        untinted.tinted(self.tint.cast())
    }
}
