//! The classes of simple lobes.

use pyo3::prelude::*;
use specula_bsdf::bsdf::{self, Lobe, Tints};
use specula_bsdf::energy::EnergyModel;
use specula_bsdf::math::{Real, Rgb};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::vndf::Sampler;

use super::Bsdf;
use crate::parameters::{
    self, Alphas, Colour, Distribution, beckmann, ggx, in_range, invalid, named,
};
use crate::reflectance::AnyReflectance;

/// Indices of refraction that lobes take.
const ETA: [f64; 2] = [1e-3, 1e3];

/// A lobe in both precisions, by a function that is generic over them.
macro_rules! both {
    ($name:expr, $T:ident => $lobe:expr) => {{
        let single = {
            type $T = f32;
            Lobe::<f32>::from($lobe)
        };
        let double = {
            type $T = f64;
            Lobe::<f64>::from($lobe)
        };
        Bsdf::new(single, double, $name)
    }};
}
pub(super) use both;

/// `Name(first, second)`, as Python prints a lobe.
pub(super) fn repr(name: &str, parts: &[String]) -> String {
    format!("{name}({})", parts.join(", "))
}

pub(super) fn rgb(colour: Rgb<f64>) -> String {
    format!("({}, {}, {})", colour.r, colour.g, colour.b)
}

/// A sampler; Beckmann has but its own.
///
/// * `default`: the lobe's.
fn sampler_of(
    distribution: Distribution,
    name: Option<&str>,
    default: Sampler,
) -> PyResult<Sampler> {
    match (distribution, name) {
        (Distribution::Beckmann, Some(name)) => Err(invalid(format!(
            "sampler: '{name}' is of GGX; Beckmann's visible normals have one sampler of their own"
        ))),
        (_, None) => Ok(default),
        (_, Some(name)) => named(name),
    }
}

/// Lambert's diffuse reflection.
///
/// Parameters
/// ----------
/// albedo : float or (3,)
///     In [0, 1].
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct Lambert;

#[pymethods]
impl Lambert {
    #[new]
    #[pyo3(signature = (albedo = Colour::Grey(0.5)))]
    fn new(albedo: Colour) -> PyResult<PyClassInitializer<Self>> {
        let albedo = albedo.share("albedo")?;
        let name = repr("Lambert", &[rgb(albedo)]);
        let lobe = both!(name, T => bsdf::Lambert::<T>::new(albedo.cast()));
        Ok(lobe.derived(Self))
    }
}

/// Rough diffuse reflection: energy-preserving Oren-Nayar (Portsmouth et al. 2025).
///
/// Parameters
/// ----------
/// albedo : float or (3,)
///     In [0, 1].
/// roughness
///     In [0, 1]; 0 is Lambert.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct Eon;

#[pymethods]
impl Eon {
    #[new]
    #[pyo3(signature = (albedo = Colour::Grey(0.5), roughness = 0.5))]
    fn new(albedo: Colour, roughness: f64) -> PyResult<PyClassInitializer<Self>> {
        let albedo = albedo.share("albedo")?;
        let roughness = in_range("roughness", roughness, [0.0, 1.0])?;
        let name = repr("Eon", &[rgb(albedo), roughness.to_string()]);
        let lobe = both!(name, T => bsdf::Eon::<T>::new(albedo.cast(), T::of(roughness)));
        Ok(lobe.derived(Self))
    }
}

/// A sheet that scatters diffusely to both sides.
///
/// Parameters
/// ----------
/// reflectance, transmittance : float or (3,)
///     Shares of each channel, in [0, 1].
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct DiffuseTransmission;

#[pymethods]
impl DiffuseTransmission {
    #[new]
    #[pyo3(signature = (reflectance = Colour::Grey(0.25), transmittance = Colour::Grey(0.25)))]
    fn new(reflectance: Colour, transmittance: Colour) -> PyResult<PyClassInitializer<Self>> {
        let reflectance = reflectance.share("reflectance")?;
        let transmittance = transmittance.share("transmittance")?;
        let name = repr(
            "DiffuseTransmission",
            &[rgb(reflectance), rgb(transmittance)],
        );
        let lobe = both!(name, T => {
            bsdf::DiffuseTransmission::<T>::new(reflectance.cast(), transmittance.cast())
        });
        Ok(lobe.derived(Self))
    }
}

/// A mirror.
///
/// Parameters
/// ----------
/// reflectance : Reflectance, str or colour
///     A Fresnel term, the chemical symbol of a measured metal, or a colour for all angles.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct SmoothConductor;

#[pymethods]
impl SmoothConductor {
    #[new]
    #[pyo3(signature = (reflectance = AnyReflectance::Constant(Colour::WHITE)))]
    fn new(reflectance: AnyReflectance) -> PyResult<PyClassInitializer<Self>> {
        let reflectance = reflectance.resolved()?;
        let name = repr("SmoothConductor", &[reflectance.to_string()]);
        let lobe = both!(name, T => bsdf::SmoothConductor::<T>::new(reflectance.cast()));
        Ok(lobe.derived(Self))
    }
}

/// Rough metal, single scattering, or with the energy of its other bounces compensated.
///
/// Parameters
/// ----------
/// alpha : float or (2,)
///     Of the distribution, in [1e-4, 10]: one, or those along x and y.
/// reflectance : Reflectance, str or colour
///     A Fresnel term, the chemical symbol of a measured metal, or a colour for all angles.
/// distribution
///     ``"ggx"`` or ``"beckmann"``.
/// sampler
///     Of GGX: ``"exact"`` (the default; rejects nothing), ``"bounded"`` (Tokuyoshi and Eto
///     2024), ``"cap"`` (Dupuy and Benyoub 2023) or ``"heitz"`` (Heitz 2018).
/// masking
///     ``"height-correlated"`` (pbrt-v4, Cycles) or ``"separable"`` (Mitsuba).
/// energy
///     ``None``, ``"turquin"`` (Turquin 2019), ``"turquin-series"`` or ``"kulla-conty"`` (Kulla
///     and Conty 2017).
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct RoughConductor;

#[pymethods]
impl RoughConductor {
    #[new]
    #[pyo3(signature = (
        alpha,
        reflectance = AnyReflectance::Constant(Colour::WHITE),
        *,
        distribution = "ggx",
        sampler = None,
        masking = "height-correlated",
        energy = None,
    ))]
    fn new(
        alpha: Alphas,
        reflectance: AnyReflectance,
        distribution: &str,
        sampler: Option<&str>,
        masking: &str,
        energy: Option<&str>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = alpha.checked()?;
        let reflectance = reflectance.resolved()?;
        let distribution_of = Distribution::named(distribution)?;
        let sampler = sampler_of(distribution_of, sampler, Sampler::default())?;
        let smith = parameters::masking(masking)?;
        let model = energy.map(named::<EnergyModel>).transpose()?;
        let name = repr(
            "RoughConductor",
            &[
                format!("({}, {})", alpha.x, alpha.y),
                reflectance.to_string(),
                format!("distribution='{distribution}'"),
                format!("sampler='{sampler}'"),
                format!("masking='{masking}'"),
                format!(
                    "energy={}",
                    energy.map_or("None".to_owned(), |e| format!("'{e}'"))
                ),
            ],
        );
        let lobe = match (distribution_of, model) {
            (Distribution::Ggx, None) => both!(name, T => {
                bsdf::RoughConductor::<T>::new(ggx(alpha), reflectance.cast())
                    .with_masking(smith)
                    .with_sampler(sampler)
            }),
            (Distribution::Ggx, Some(model)) => both!(name, T => {
                bsdf::Compensated::<T>::new(ggx(alpha), reflectance.cast(), model)
                    .with_masking(smith)
                    .with_sampler(sampler)
            }),
            (Distribution::Beckmann, None) => both!(name, T => {
                bsdf::RoughConductor::new(beckmann::<T>(alpha), reflectance.cast())
                    .with_masking(smith)
            }),
            (Distribution::Beckmann, Some(model)) => both!(name, T => {
                bsdf::Compensated::new(beckmann::<T>(alpha), reflectance.cast(), model)
                    .with_masking(smith)
            }),
        };
        Ok(lobe.derived(Self))
    }
}

/// Rough metal with all bounces between its facets. Its values are unbiased estimates.
///
/// Parameters
/// ----------
/// alpha : float or (2,)
///     Of the distribution, in [1e-4, 10]: one, or those along x and y.
/// reflectance : Reflectance, str or colour
///     A Fresnel term, the chemical symbol of a measured metal, or a colour for all angles.
/// distribution
///     ``"ggx"`` or ``"beckmann"``.
/// model
///     ``"specula"`` (stratified bidirectional walks), ``"heitz"`` (Heitz et al. 2016),
///     ``"bitterli"`` (Bitterli and d'Eon 2022), ``"wang"``, ``"wang-uncorrelated"`` (Wang et al.
///     2022, biased), ``"cui"``, ``"cui-bidirectional"`` (Cui et al. 2023).
/// mis_pdf
///     Density for multiple importance sampling: ``"normalised"`` (the default), ``"hapke"`` or
///     ``"lambert"``.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct MultibounceConductor;

#[pymethods]
impl MultibounceConductor {
    #[new]
    #[pyo3(signature = (
        alpha,
        reflectance = AnyReflectance::Constant(Colour::WHITE),
        *,
        distribution = "ggx",
        model = "specula",
        mis_pdf = None,
    ))]
    fn new(
        alpha: Alphas,
        reflectance: AnyReflectance,
        distribution: &str,
        model: &str,
        mis_pdf: Option<&str>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = alpha.checked()?;
        let reflectance = reflectance.resolved()?;
        let distribution_of = Distribution::named(distribution)?;
        let estimator = named::<MultibounceModel>(model)?;
        let mis = mis_pdf
            .map(named::<MisPdf>)
            .transpose()?
            .unwrap_or_default();
        let name = repr(
            "MultibounceConductor",
            &[
                format!("({}, {})", alpha.x, alpha.y),
                reflectance.to_string(),
                format!("distribution='{distribution}'"),
                format!("model='{model}'"),
                format!("mis_pdf='{mis}'"),
            ],
        );
        let lobe = match distribution_of {
            Distribution::Ggx => both!(name, T => {
                bsdf::MultibounceConductor::<T>::new(ggx(alpha), reflectance.cast(), estimator)
                    .with_mis_pdf(mis)
            }),
            Distribution::Beckmann => both!(name, T => {
                bsdf::MultibounceConductor::new(
                    beckmann::<T>(alpha),
                    reflectance.cast(),
                    estimator,
                )
                .with_mis_pdf(mis)
            }),
        };
        Ok(lobe.derived(Self))
    }
}

/// Tints of a dielectric in a precision.
fn tints<T: Real>([reflection, transmission]: [Rgb<f64>; 2]) -> Tints<T> {
    Tints {
        reflection: reflection.cast(),
        transmission: transmission.cast(),
    }
}

/// Tints as Python gives them.
fn shares(reflection: Colour, transmission: Colour) -> PyResult<[Rgb<f64>; 2]> {
    Ok([
        reflection.share("reflection_tint")?,
        transmission.share("transmission_tint")?,
    ])
}

/// A smooth interface between two media.
///
/// Parameters
/// ----------
/// eta
///     Index of refraction inside over that outside; ``wo.z < 0`` looks from inside.
/// reflection_tint, transmission_tint : float or (3,)
///     Factors in [0, 1]; white in nature.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct SmoothDielectric;

#[pymethods]
impl SmoothDielectric {
    #[new]
    #[pyo3(signature = (
        eta = 1.5, *, reflection_tint = Colour::WHITE, transmission_tint = Colour::WHITE
    ))]
    fn new(
        eta: f64,
        reflection_tint: Colour,
        transmission_tint: Colour,
    ) -> PyResult<PyClassInitializer<Self>> {
        let eta = in_range("eta", eta, ETA)?;
        let colours = shares(reflection_tint, transmission_tint)?;
        let name = repr("SmoothDielectric", &[eta.to_string()]);
        let lobe = both!(name, T => {
            bsdf::SmoothDielectric::<T>::new(T::of(eta)).with_tints(tints(colours))
        });
        Ok(lobe.derived(Self))
    }
}

/// A pane: two parallel interfaces, with all reflections between them.
///
/// Parameters
/// ----------
/// eta
///     Index of refraction of the pane over that around it.
/// reflection_tint, transmission_tint : float or (3,)
///     Factors in [0, 1]; white in nature.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct ThinDielectric;

#[pymethods]
impl ThinDielectric {
    #[new]
    #[pyo3(signature = (
        eta = 1.5, *, reflection_tint = Colour::WHITE, transmission_tint = Colour::WHITE
    ))]
    fn new(
        eta: f64,
        reflection_tint: Colour,
        transmission_tint: Colour,
    ) -> PyResult<PyClassInitializer<Self>> {
        let eta = in_range("eta", eta, ETA)?;
        let colours = shares(reflection_tint, transmission_tint)?;
        let name = repr("ThinDielectric", &[eta.to_string()]);
        let lobe = both!(name, T => {
            bsdf::ThinDielectric::<T>::new(T::of(eta)).with_tints(tints(colours))
        });
        Ok(lobe.derived(Self))
    }
}

/// Rough glass, single scattering, or with the energy of its other bounces compensated.
///
/// Parameters
/// ----------
/// alpha : float or (2,)
///     Of the distribution, in [1e-4, 10]: one, or those along x and y.
/// eta
///     Index of refraction inside over that outside; ``wo.z < 0`` looks from inside.
/// distribution, masking
///     As for `RoughConductor`.
/// sampler
///     Of GGX, as for `RoughConductor`; ``"cap"`` by default, since visible normals serve
///     refraction, too.
/// compensated
///     Whether what single scattering loses is given back.
/// reflection_tint, transmission_tint : float or (3,)
///     Factors in [0, 1]; white in nature.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct RoughDielectric;

#[pymethods]
impl RoughDielectric {
    #[new]
    #[pyo3(signature = (
        alpha,
        eta = 1.5,
        *,
        distribution = "ggx",
        sampler = None,
        masking = "height-correlated",
        compensated = false,
        reflection_tint = Colour::WHITE,
        transmission_tint = Colour::WHITE,
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        alpha: Alphas,
        eta: f64,
        distribution: &str,
        sampler: Option<&str>,
        masking: &str,
        compensated: bool,
        reflection_tint: Colour,
        transmission_tint: Colour,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = alpha.checked()?;
        let eta = in_range("eta", eta, ETA)?;
        let distribution_of = Distribution::named(distribution)?;
        let sampler = sampler_of(distribution_of, sampler, Sampler::Cap)?;
        let smith = parameters::masking(masking)?;
        let colours = shares(reflection_tint, transmission_tint)?;
        let name = repr(
            "RoughDielectric",
            &[
                format!("({}, {})", alpha.x, alpha.y),
                eta.to_string(),
                format!("distribution='{distribution}'"),
                format!("sampler='{sampler}'"),
                format!("masking='{masking}'"),
                format!("compensated={}", if compensated { "True" } else { "False" }),
            ],
        );
        let lobe = match (distribution_of, compensated) {
            (Distribution::Ggx, false) => both!(name, T => {
                bsdf::RoughDielectric::<T>::new(ggx(alpha), T::of(eta))
                    .with_masking(smith)
                    .with_tints(tints(colours))
                    .with_sampler(sampler)
            }),
            (Distribution::Ggx, true) => both!(name, T => {
                bsdf::CompensatedDielectric::<T>::new(ggx(alpha), T::of(eta))
                    .with_masking(smith)
                    .with_tints(tints(colours))
                    .with_sampler(sampler)
            }),
            (Distribution::Beckmann, false) => both!(name, T => {
                bsdf::RoughDielectric::new(beckmann::<T>(alpha), T::of(eta))
                    .with_masking(smith)
                    .with_tints(tints(colours))
            }),
            (Distribution::Beckmann, true) => both!(name, T => {
                bsdf::CompensatedDielectric::new(beckmann::<T>(alpha), T::of(eta))
                    .with_masking(smith)
                    .with_tints(tints(colours))
            }),
        };
        Ok(lobe.derived(Self))
    }
}

/// Rough glass with all bounces between its facets. Its values are unbiased estimates.
///
/// Parameters
/// ----------
/// alpha : float or (2,)
///     Of the distribution, in [1e-4, 10]: one, or those along x and y.
/// eta
///     Index of refraction inside over that outside.
/// distribution, mis_pdf
///     As for `MultibounceConductor`.
/// model
///     ``"specula"`` or ``"heitz"``.
/// reflection_tint, transmission_tint : float or (3,)
///     Factors in [0, 1]; white in nature.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct MultibounceDielectric;

#[pymethods]
impl MultibounceDielectric {
    #[new]
    #[pyo3(signature = (
        alpha,
        eta = 1.5,
        *,
        distribution = "ggx",
        model = "specula",
        mis_pdf = None,
        reflection_tint = Colour::WHITE,
        transmission_tint = Colour::WHITE,
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        alpha: Alphas,
        eta: f64,
        distribution: &str,
        model: &str,
        mis_pdf: Option<&str>,
        reflection_tint: Colour,
        transmission_tint: Colour,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = alpha.checked()?;
        let eta = in_range("eta", eta, ETA)?;
        let distribution_of = Distribution::named(distribution)?;
        let estimator = match model {
            "heitz" | "specula" => named::<MultibounceModel>(model)?,
            _ => {
                return Err(invalid(format!(
                    "model: '{model}' is of metals (expected heitz or specula)"
                )));
            }
        };
        let mis = mis_pdf
            .map(named::<MisPdf>)
            .transpose()?
            .unwrap_or_default();
        let colours = shares(reflection_tint, transmission_tint)?;
        let name = repr(
            "MultibounceDielectric",
            &[
                format!("({}, {})", alpha.x, alpha.y),
                eta.to_string(),
                format!("distribution='{distribution}'"),
                format!("model='{model}'"),
            ],
        );
        let lobe = match distribution_of {
            Distribution::Ggx => both!(name, T => {
                bsdf::MultibounceDielectric::<T>::new(ggx(alpha), T::of(eta), estimator)
                    .with_mis_pdf(mis)
                    .with_tints(tints(colours))
            }),
            Distribution::Beckmann => both!(name, T => {
                bsdf::MultibounceDielectric::new(beckmann::<T>(alpha), T::of(eta), estimator)
                    .with_mis_pdf(mis)
                    .with_tints(tints(colours))
            }),
        };
        Ok(lobe.derived(Self))
    }
}
