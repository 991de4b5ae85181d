//! The classes of lobes that are made of several: coats, layers, plastics, principled, glTF.

use pyo3::prelude::*;
use specula_bsdf::bsdf::{
    self, Base, CoatLayer, CoatScattering, GltfParameters, Lobe, Medium, PrincipledParameters,
};
use specula_bsdf::math::Real;

use super::Bsdf;
use super::lobes::{both, repr, rgb};
use crate::parameters::{self, Alphas, Colour, Distribution, beckmann, ggx, in_range, invalid};
use crate::reflectance::AnyReflectance;

const SHARE: [f64; 2] = [0.0, 1.0];
const ANY: [f64; 2] = [0.0, f64::MAX];

fn alpha_text(alpha: Option<specula_bsdf::Alpha<f64>>) -> String {
    alpha.map_or("None".to_owned(), |a| format!("({}, {})", a.x, a.y))
}

/// Lambert under a dielectric coat, in closed form.
///
/// Parameters
/// ----------
/// alpha : float, (2,) or None
///     Of the coat's facets; ``None`` for a smooth coat.
/// eta
///     Index of refraction of the coat over that outside, in [1, 3].
/// albedo : float or (3,)
///     Of the base, in [0, 1].
/// thickness
///     Optical thickness of an absorbing medium between the two.
/// max_depth
///     Events after which light is lost; ``None`` for no limit.
/// scattering
///     ``"lossless"``, or ``"single"`` where each facet of the coat scatters once.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct CoatedDiffuse;

#[pymethods]
impl CoatedDiffuse {
    #[new]
    #[pyo3(signature = (
        alpha = None,
        eta = 1.5,
        albedo = Colour::Grey(0.5),
        *,
        thickness = 0.0,
        max_depth = None,
        scattering = "lossless",
    ))]
    fn new(
        alpha: Option<Alphas>,
        eta: f64,
        albedo: Colour,
        thickness: f64,
        max_depth: Option<u32>,
        scattering: &str,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = alpha.map(Alphas::checked).transpose()?;
        let eta = in_range("eta", eta, [1.0, 3.0])?;
        let albedo = albedo.share("albedo")?;
        let thickness = in_range("thickness", thickness, ANY)?;
        let facets = match scattering {
            "lossless" => CoatScattering::Lossless,
            "single" => CoatScattering::Single,
            _ => {
                return Err(invalid(format!(
                    "no such scattering: '{scattering}' (expected lossless or single)"
                )));
            }
        };
        let parts = [alpha_text(alpha), eta.to_string(), rgb(albedo)];
        let lobe = both!(repr("CoatedDiffuse", &parts), T => {
            let layer = CoatLayer {
                thickness: T::of(thickness),
                max_depth,
                scattering: facets,
            };
            bsdf::CoatedDiffuse::<T>::over_layer(alpha.map(ggx), T::of(eta), albedo.cast(), layer)
        });
        Ok(lobe.derived(Self))
    }
}

/// A coat over a metal or a diffuse base with a medium between them, by random walks.
///
/// Parameters
/// ----------
/// alpha : float, (2,) or None
///     Of the coat's facets; ``None`` for a smooth coat.
/// eta
///     Index of refraction of the coat over that outside, in [1, 3].
/// albedo : float or (3,)
///     Of a diffuse base.
/// reflectance : Reflectance, str or colour
///     Of a metal base. Exactly one of the two is given.
/// base_alpha : float or (2,), optional
///     Of a metal base; smooth by default.
/// thickness
///     Optical thickness of the medium.
/// medium_albedo : float or (3,)
///     Share of light that the medium scatters instead of absorbing.
/// g
///     Mean cosine of the scattering angle, in [-0.99, 0.99].
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct Layered;

#[pymethods]
impl Layered {
    #[new]
    #[pyo3(signature = (
        alpha = None,
        eta = 1.5,
        *,
        albedo = None,
        reflectance = None,
        base_alpha = None,
        thickness = 0.0,
        medium_albedo = Colour::Grey(0.0),
        g = 0.0,
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        alpha: Option<Alphas>,
        eta: f64,
        albedo: Option<Colour>,
        reflectance: Option<AnyReflectance>,
        base_alpha: Option<Alphas>,
        thickness: f64,
        medium_albedo: Colour,
        g: f64,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = alpha.map(Alphas::checked).transpose()?;
        let eta = in_range("eta", eta, [1.0, 3.0])?;
        let base_alpha = base_alpha.map(Alphas::checked).transpose()?;
        let diffuse = albedo.map(|a| a.share("albedo")).transpose()?;
        let metal = reflectance.map(AnyReflectance::resolved).transpose()?;
        if diffuse.is_some() == metal.is_some() {
            return Err(invalid(
                "expected the base's albedo (diffuse) or its reflectance (metal), one of the two",
            ));
        }
        if diffuse.is_some() && base_alpha.is_some() {
            return Err(invalid("base_alpha: a diffuse base has none"));
        }
        let thickness = in_range("thickness", thickness, ANY)?;
        let scattered = medium_albedo.share("medium_albedo")?;
        let g = in_range("g", g, [-0.99, 0.99])?;
        let base = diffuse.map_or_else(
            || metal.map_or_else(String::new, |m| format!("reflectance={m}")),
            |a| format!("albedo={}", rgb(a)),
        );
        let parts = [alpha_text(alpha), eta.to_string(), base];
        let lobe = both!(repr("Layered", &parts), T => {
            let base = match (diffuse, metal) {
                (Some(albedo), _) => Base::<T>::diffuse(albedo.cast()),
                (None, Some(metal)) => Base::metal(base_alpha.map(ggx), metal.cast()),
                (None, None) => Base::diffuse(specula_bsdf::Rgb::BLACK),
            };
            let medium = Medium {
                thickness: T::of(thickness),
                albedo: scattered.cast(),
                g: T::of(g),
            };
            bsdf::Layered::<T>::new(alpha.map(ggx), T::of(eta), base).with_medium(medium)
        });
        Ok(lobe.derived(Self))
    }
}

/// Mitsuba's plastic and rough plastic.
///
/// Parameters
/// ----------
/// alpha : float, (2,) or None
///     Of the coat's facets; ``None`` for a smooth coat.
/// eta
///     Index of refraction of the coat over that outside, in [1, 3].
/// diffuse, specular : float or (3,)
///     Albedo of the base, factor on the coat's reflection; in [0, 1].
/// nonlinear
///     Whether light between coat and base takes the base's colour at every bounce.
/// distribution, masking
///     As for `RoughConductor`.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct Plastic;

#[pymethods]
impl Plastic {
    #[new]
    #[pyo3(signature = (
        alpha = None,
        eta = 1.49,
        diffuse = Colour::Grey(0.5),
        *,
        specular = Colour::WHITE,
        nonlinear = false,
        distribution = "ggx",
        masking = "separable",
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        alpha: Option<Alphas>,
        eta: f64,
        diffuse: Colour,
        specular: Colour,
        nonlinear: bool,
        distribution: &str,
        masking: &str,
    ) -> PyResult<PyClassInitializer<Self>> {
        let alpha = alpha.map(Alphas::checked).transpose()?;
        let eta = in_range("eta", eta, [1.0, 3.0])?;
        let diffuse = diffuse.share("diffuse")?;
        let specular = specular.share("specular")?;
        let smith = parameters::masking(masking)?;
        let parts = [alpha_text(alpha), eta.to_string(), rgb(diffuse)];
        let name = repr("Plastic", &parts);
        let lobe = match (alpha, Distribution::named(distribution)?) {
            (None, _) => both!(name, T => {
                bsdf::Plastic::<T>::smooth(T::of(eta), diffuse.cast(), specular.cast(), nonlinear)
            }),
            (Some(alpha), Distribution::Ggx) => both!(name, T => {
                let (diffuse, specular) = (diffuse.cast(), specular.cast());
                let ndf = ggx::<T>(alpha);
                bsdf::Plastic::rough(ndf, smith, T::of(eta), diffuse, specular, nonlinear)
            }),
            (Some(alpha), Distribution::Beckmann) => both!(name, T => {
                let (diffuse, specular) = (diffuse.cast(), specular.cast());
                let ndf = beckmann::<T>(alpha);
                bsdf::Plastic::rough(ndf, smith, T::of(eta), diffuse, specular, nonlinear)
            }),
        };
        Ok(lobe.derived(Self))
    }
}

/// Mitsuba's principled and principledthin: Burley 2012 and 2015.
///
/// Parameters are Mitsuba's. Shares are in [0, 1], ``diff_trans`` in [0, 2], and alpha is
/// ``roughness**2``. ``outside`` says from which side the surface is seen.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct Principled;

#[pymethods]
impl Principled {
    #[new]
    #[pyo3(signature = (
        base_color = Colour::Grey(0.5),
        roughness = 0.5,
        *,
        anisotropic = 0.0,
        metallic = 0.0,
        spec_trans = 0.0,
        eta = 1.5,
        spec_tint = 0.0,
        sheen = 0.0,
        sheen_tint = 0.0,
        clearcoat = 0.0,
        clearcoat_gloss = 0.0,
        flatness = 0.0,
        diff_trans = 0.0,
        thin = false,
        outside = true,
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        base_color: Colour,
        roughness: f64,
        anisotropic: f64,
        metallic: f64,
        spec_trans: f64,
        eta: f64,
        spec_tint: f64,
        sheen: f64,
        sheen_tint: f64,
        clearcoat: f64,
        clearcoat_gloss: f64,
        flatness: f64,
        diff_trans: f64,
        thin: bool,
        outside: bool,
    ) -> PyResult<PyClassInitializer<Self>> {
        let base = base_color.share("base_color")?;
        for (name, share) in [
            ("roughness", roughness),
            ("anisotropic", anisotropic),
            ("metallic", metallic),
            ("spec_trans", spec_trans),
            ("spec_tint", spec_tint),
            ("sheen", sheen),
            ("sheen_tint", sheen_tint),
            ("clearcoat", clearcoat),
            ("clearcoat_gloss", clearcoat_gloss),
            ("flatness", flatness),
        ] {
            in_range(name, share, SHARE)?;
        }
        in_range("diff_trans", diff_trans, [0.0, 2.0])?;
        in_range("eta", eta, [1e-3, 1e3])?;
        let name = repr("Principled", &[rgb(base), roughness.to_string()]);
        let lobe = both!(name, T => bsdf::Principled::<T>::new(PrincipledParameters {
            base_colour: base.cast(),
            roughness: T::of(roughness),
            anisotropic: T::of(anisotropic),
            metallic: T::of(metallic),
            spec_trans: T::of(spec_trans),
            eta: T::of(eta),
            spec_tint: T::of(spec_tint),
            sheen: T::of(sheen),
            sheen_tint: T::of(sheen_tint),
            clearcoat: T::of(clearcoat),
            clearcoat_gloss: T::of(clearcoat_gloss),
            flatness: T::of(flatness),
            diff_trans: T::of(diff_trans),
            thin,
            outside,
        }));
        Ok(lobe.derived(Self))
    }
}

/// glTF 2.0's metallic-roughness material with its extensions.
///
/// Parameters are those of the specification and of ``KHR_materials_ior``, ``_specular``,
/// ``_anisotropy``, ``_transmission``, ``_volume``, ``_clearcoat`` and ``_sheen``. Shares are in
/// [0, 1], and alpha is ``roughness**2``. ``outside`` says from which side a volume is seen;
/// ``compensated`` gives back what the metal's facets lose by scattering once.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct Gltf;

#[pymethods]
impl Gltf {
    #[new]
    #[pyo3(signature = (
        base_color = Colour::WHITE,
        metallic = 1.0,
        roughness = 1.0,
        *,
        anisotropy = 0.0,
        ior = 1.5,
        specular = 1.0,
        specular_color = Colour::WHITE,
        transmission = 0.0,
        volume = false,
        outside = true,
        clearcoat = 0.0,
        clearcoat_roughness = 0.0,
        sheen_color = Colour::Grey(0.0),
        sheen_roughness = 0.0,
        compensated = false,
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        base_color: Colour,
        metallic: f64,
        roughness: f64,
        anisotropy: f64,
        ior: f64,
        specular: f64,
        specular_color: Colour,
        transmission: f64,
        volume: bool,
        outside: bool,
        clearcoat: f64,
        clearcoat_roughness: f64,
        sheen_color: Colour,
        sheen_roughness: f64,
        compensated: bool,
    ) -> PyResult<PyClassInitializer<Self>> {
        let base = base_color.share("base_color")?;
        let specular_colour = specular_color.within("specular_color", ANY)?;
        let sheen = sheen_color.share("sheen_color")?;
        for (name, share) in [
            ("metallic", metallic),
            ("roughness", roughness),
            ("anisotropy", anisotropy),
            ("specular", specular),
            ("transmission", transmission),
            ("clearcoat", clearcoat),
            ("clearcoat_roughness", clearcoat_roughness),
            ("sheen_roughness", sheen_roughness),
        ] {
            in_range(name, share, SHARE)?;
        }
        in_range("ior", ior, [0.0, 1e3])?;
        let parts = [rgb(base), metallic.to_string(), roughness.to_string()];
        let lobe = both!(repr("Gltf", &parts), T => bsdf::Gltf::<T>::new(GltfParameters {
            base_colour: base.cast(),
            metallic: T::of(metallic),
            roughness: T::of(roughness),
            anisotropy: T::of(anisotropy),
            ior: T::of(ior),
            specular: T::of(specular),
            specular_colour: specular_colour.cast(),
            transmission: T::of(transmission),
            volume,
            outside,
            clearcoat: T::of(clearcoat),
            clearcoat_roughness: T::of(clearcoat_roughness),
            sheen_colour: sheen.cast(),
            sheen_roughness: T::of(sheen_roughness),
            compensated,
        }));
        Ok(lobe.derived(Self))
    }
}
