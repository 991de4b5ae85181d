//! Materials of scenes.

use std::sync::Arc;

use pyo3::prelude::*;
use specula::scene::Scene;
use specula::scene::material_text::parse_material;
use specula::scene::scene::{
    Bump, CoatMedium, ColourParam, FloatParam, GltfMaterial, MaterialKind, PrincipledMaterial,
    Roughness, RoughnessMapping,
};
use specula_bsdf::math::Rgb;

use super::microfacets::{BumpMap, Facets, Given, Metal, at_most_one, single};
use super::paint::{ANY, Paint, SHARE, SIGNED};
use crate::parameters::{Alphas, in_range, invalid};

type Blueprint = dyn Fn(&mut Scene) -> MaterialKind + Send + Sync;

/// The surface of a shape.
///
/// Parameters that may vary over a surface are a number, three (linear RGB), or a picture of shape
/// (h, w) or (h, w, 3), in linear light: it covers the unit square of surface coordinates, rows from
/// the top, and repeats. A number takes the first channel of a picture.
///
/// Alphas of microfacets are given by ``alpha``, one or two (along dp/du and across), or by
/// ``roughness``, whose square alpha is. Constructors raise ValueError where a parameter is out of
/// range.
///
/// Examples
/// --------
/// >>> import specula_render as sr
/// >>> sr.Material.conductor("Au", alpha=(0.1, 0.4))
/// <Material conductor>
#[pyclass(frozen, from_py_object, module = "specula_render")]
#[derive(Clone)]
pub(crate) struct Material {
    /// Makes it for a scene: its pictures become textures there.
    blueprint: Arc<Blueprint>,
    /// Absorption within, per scene unit.
    pub(super) absorption: Rgb<f32>,
    /// What bends its normals.
    bump_map: Option<BumpMap>,
    kind: &'static str,
}

impl Material {
    fn new(
        kind: &'static str,
        blueprint: impl Fn(&mut Scene) -> MaterialKind + Send + Sync + 'static,
    ) -> Self {
        Self {
            blueprint: Arc::new(blueprint),
            absorption: Rgb::BLACK,
            bump_map: None,
            kind,
        }
    }

    /// Grey, for shapes of which nothing is said.
    pub(super) fn grey() -> Self {
        Self::new("diffuse", |_| MaterialKind::Diffuse {
            reflectance: ColourParam::Value(Rgb::splat(0.5)),
            roughness: FloatParam::Value(0.0),
        })
    }

    /// As a material of a scene.
    pub(super) fn build(&self, scene: &mut Scene) -> MaterialKind {
        (self.blueprint)(scene)
    }

    /// Its bump or normal map, as of a scene.
    pub(super) fn bump(&self, scene: &mut Scene) -> Option<Bump> {
        self.bump_map.as_ref()?.build(scene)
    }

    /// Whether it is the very same object.
    pub(super) fn is(&self, other: &Self) -> bool {
        let same_map = match (&self.bump_map, &other.bump_map) {
            (None, None) => true,
            (Some(a), Some(b)) => a.is(b),
            _ => false,
        };
        Arc::ptr_eq(&self.blueprint, &other.blueprint) && same_map
    }
}

fn index(name: &str, eta: f64) -> PyResult<f32> {
    match eta > 0.0 && eta.is_finite() {
        true => Ok(single(eta)),
        false => Err(invalid(format!(
            "{name}: expected an index of refraction above 0, got {eta}"
        ))),
    }
}

#[pymethods]
impl Material {
    /// Read a material as the command line writes it: ``conductor Au alpha 0.3``.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        let kind = parse_material(text).map_err(invalid)?;
        Ok(Self::new("text", move |_| kind))
    }

    /// Return the same material with a bump map.
    ///
    /// Parameters
    /// ----------
    /// heights
    ///     Picture of heights along the normal, in scene units, of shape (h, w).
    fn with_bump_map(&self, heights: &Bound<'_, PyAny>) -> PyResult<Self> {
        let heights = Paint::new("heights", heights, SIGNED)?;
        if matches!(heights, Paint::Value(_)) {
            return Err(invalid("heights: expected a picture of shape (h, w)"));
        }
        Ok(Self {
            bump_map: Some(BumpMap::Heights(Arc::new(heights))),
            ..self.clone()
        })
    }

    /// Return the same material with a normal map.
    ///
    /// Parameters
    /// ----------
    /// normals
    ///     Picture of shape (h, w, 3), in [0, 1]: ``2 c - 1`` is the normal in the frame of dp/du, dp/dv and the
    ///     shading normal. No transfer curve is applied.
    /// scale
    ///     Factor on x and y of the normal.
    #[pyo3(signature = (normals, scale = 1.0))]
    fn with_normal_map(&self, normals: &Bound<'_, PyAny>, scale: f64) -> PyResult<Self> {
        let normals = Paint::new("normals", normals, SHARE)?;
        if matches!(normals, Paint::Value(_)) {
            return Err(invalid("normals: expected a picture of shape (h, w, 3)"));
        }
        let scale = single(in_range("scale", scale, [0.0, 1e3])?);
        Ok(Self {
            bump_map: Some(BumpMap::Normals(Arc::new(normals), scale)),
            ..self.clone()
        })
    }

    /// Make Lambert, or energy-preserving Oren-Nayar where ``roughness`` is not 0.
    ///
    /// Parameters
    /// ----------
    /// reflectance
    ///     Albedo.
    /// roughness
    ///     Of Oren and Nayar, in [0, 1].
    #[staticmethod]
    #[pyo3(signature = (reflectance = None, *, roughness = None))]
    fn diffuse(reflectance: Given<'_, '_>, roughness: Given<'_, '_>) -> PyResult<Self> {
        let reflectance = Paint::or("reflectance", reflectance, SHARE, 0.5)?;
        let roughness = Paint::or("roughness", roughness, SHARE, 0.0)?;
        Ok(Self::new("diffuse", move |scene| MaterialKind::Diffuse {
            reflectance: reflectance.colour(scene),
            roughness: roughness.number(scene),
        }))
    }

    /// Make Lambert on both sides.
    ///
    /// Parameters
    /// ----------
    /// reflectance, transmittance
    ///     Albedos of the parts that are reflected and transmitted.
    #[staticmethod]
    #[pyo3(signature = (reflectance = None, transmittance = None))]
    fn diffuse_transmission(
        reflectance: Given<'_, '_>,
        transmittance: Given<'_, '_>,
    ) -> PyResult<Self> {
        let reflectance = Paint::or("reflectance", reflectance, SHARE, 0.25)?;
        let transmittance = Paint::or("transmittance", transmittance, SHARE, 0.25)?;
        Ok(Self::new("diffuse_transmission", move |scene| {
            MaterialKind::DiffuseTransmission {
                reflectance: reflectance.colour(scene),
                transmittance: transmittance.colour(scene),
            }
        }))
    }

    /// Make a metal, gold by default.
    ///
    /// Parameters
    /// ----------
    /// metal
    ///     Chemical symbol of a measured one, such as ``"Cu"``.
    /// eta, k
    ///     In its place: the complex index of refraction.
    /// reflectance
    ///     In its place: the reflectance at normal incidence, by pbrt's rule.
    /// f0
    ///     In its place: the reflectance at normal incidence, by Schlick's approximation.
    /// alpha, roughness
    ///     Width of the microfacets; by default alpha is 0.1.
    /// distribution
    ///     ``"ggx"`` or ``"beckmann"``.
    /// tint
    ///     Factor on what is reflected; 1 in nature.
    #[staticmethod]
    #[pyo3(signature = (metal = None, *, eta = None, k = None, reflectance = None, f0 = None, alpha = None,
        roughness = None, distribution = "ggx", tint = None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn conductor(
        metal: Option<&str>,
        eta: Given<'_, '_>,
        k: Given<'_, '_>,
        reflectance: Given<'_, '_>,
        f0: Given<'_, '_>,
        alpha: Option<Alphas>,
        roughness: Given<'_, '_>,
        distribution: &str,
        tint: Given<'_, '_>,
    ) -> PyResult<Self> {
        let metal = Metal::new(metal, eta, k, reflectance, f0)?;
        let facets = Facets::new(alpha, roughness, distribution, 0.1)?;
        let tint = Paint::or("tint", tint, SHARE, 1.0)?;
        Ok(Self::new("conductor", move |scene| {
            MaterialKind::Conductor {
                fresnel: metal.build(scene),
                roughness: facets.build(scene),
                tint: tint.colour(scene),
            }
        }))
    }

    /// Make glass.
    ///
    /// Parameters
    /// ----------
    /// eta
    ///     Index of refraction, inside over outside.
    /// alpha, roughness
    ///     Width of the microfacets; by default it is smooth.
    /// distribution
    ///     ``"ggx"`` or ``"beckmann"``.
    /// reflection_tint, transmission_tint
    ///     Factors on what is reflected and on what passes; 1 in nature.
    /// absorption
    ///     Per scene unit within: light loses ``1 - exp(-absorption distance)``.
    #[staticmethod]
    #[pyo3(signature = (eta = 1.5, *, alpha = None, roughness = None, distribution = "ggx", reflection_tint = None,
        transmission_tint = None, absorption = None))]
    fn dielectric(
        eta: f64,
        alpha: Option<Alphas>,
        roughness: Given<'_, '_>,
        distribution: &str,
        reflection_tint: Given<'_, '_>,
        transmission_tint: Given<'_, '_>,
        absorption: Given<'_, '_>,
    ) -> PyResult<Self> {
        let eta = index("eta", eta)?;
        let facets = Facets::new(alpha, roughness, distribution, 0.0)?;
        let reflection = Paint::or("reflection_tint", reflection_tint, SHARE, 1.0)?;
        let transmission = Paint::or("transmission_tint", transmission_tint, SHARE, 1.0)?;
        let Paint::Value(absorption) = Paint::or("absorption", absorption, ANY, 0.0)? else {
            return Err(invalid("absorption: expected a number or three"));
        };
        let glass = Self::new("dielectric", move |scene| MaterialKind::Dielectric {
            eta,
            roughness: facets.build(scene),
            reflection_tint: reflection.colour(scene),
            transmission_tint: transmission.colour(scene),
        });
        Ok(Self {
            absorption,
            ..glass
        })
    }

    /// Make a thin pane: both interfaces in one surface, no refraction.
    ///
    /// Parameters
    /// ----------
    /// eta
    ///     Index of refraction of the pane.
    /// reflection_tint, transmission_tint
    ///     Factors on what is reflected and on what passes; 1 in nature.
    #[staticmethod]
    #[pyo3(signature = (eta = 1.5, *, reflection_tint = None, transmission_tint = None))]
    fn thin_dielectric(
        eta: f64,
        reflection_tint: Given<'_, '_>,
        transmission_tint: Given<'_, '_>,
    ) -> PyResult<Self> {
        let eta = index("eta", eta)?;
        let reflection = Paint::or("reflection_tint", reflection_tint, SHARE, 1.0)?;
        let transmission = Paint::or("transmission_tint", transmission_tint, SHARE, 1.0)?;
        Ok(Self::new("thin_dielectric", move |scene| {
            MaterialKind::ThinDielectric {
                eta,
                reflection_tint: reflection.colour(scene),
                transmission_tint: transmission.colour(scene),
            }
        }))
    }

    /// Make a dielectric coat over Lambert.
    ///
    /// Parameters
    /// ----------
    /// reflectance
    ///     Albedo of the base.
    /// eta
    ///     Index of refraction of the coat.
    /// alpha, roughness, distribution
    ///     Microfacets of the coat; by default it is smooth.
    #[staticmethod]
    #[pyo3(signature = (reflectance = None, *, eta = 1.5, alpha = None, roughness = None, distribution = "ggx"))]
    fn coated_diffuse(
        reflectance: Given<'_, '_>,
        eta: f64,
        alpha: Option<Alphas>,
        roughness: Given<'_, '_>,
        distribution: &str,
    ) -> PyResult<Self> {
        let reflectance = Paint::or("reflectance", reflectance, SHARE, 0.5)?;
        let eta = index("eta", eta)?;
        let facets = Facets::new(alpha, roughness, distribution, 0.0)?;
        Ok(Self::new("coated_diffuse", move |scene| {
            MaterialKind::CoatedDiffuse {
                reflectance: reflectance.colour(scene),
                eta,
                roughness: facets.build(scene),
                medium: CoatMedium::default(),
                lossless: false,
            }
        }))
    }

    /// Make a dielectric coat over metal.
    ///
    /// Parameters
    /// ----------
    /// metal, reflectance
    ///     Of the metal, as for `conductor`.
    /// eta, coat_alpha
    ///     Index of refraction and width of the microfacets of the coat.
    /// alpha, roughness, distribution
    ///     Microfacets of the metal; by default alpha is 0.1.
    #[staticmethod]
    #[pyo3(signature = (metal = None, *, reflectance = None, eta = 1.5, coat_alpha = 0.0, alpha = None,
        roughness = None, distribution = "ggx"))]
    fn coated_conductor(
        metal: Option<&str>,
        reflectance: Given<'_, '_>,
        eta: f64,
        coat_alpha: f64,
        alpha: Option<Alphas>,
        roughness: Given<'_, '_>,
        distribution: &str,
    ) -> PyResult<Self> {
        let metal = Metal::new(metal, None, None, reflectance, None)?;
        let coat_eta = index("eta", eta)?;
        let coat_alpha = at_most_one("coat_alpha", coat_alpha)?;
        let facets = Facets::new(alpha, roughness, distribution, 0.1)?;
        Ok(Self::new("coated_conductor", move |scene| {
            MaterialKind::CoatedConductor {
                coat_eta,
                coat_roughness: Roughness::isotropic(
                    FloatParam::Value(coat_alpha),
                    RoughnessMapping::Alpha,
                ),
                fresnel: metal.build(scene),
                roughness: facets.build(scene),
                medium: CoatMedium::default(),
            }
        }))
    }

    /// Make glTF's metallic-roughness material with its ``KHR_materials_*`` extensions.
    ///
    /// Parameters are glTF's without "Factor": ``base_color`` is ``baseColorFactor``. ``volume`` says
    /// whether there is a thickness, so that light bends.
    #[staticmethod]
    #[pyo3(signature = (base_color = None, metallic = None, roughness = None, *, anisotropy = None, ior = 1.5,
        specular = None, specular_color = None, transmission = None, volume = false, clearcoat = None,
        clearcoat_roughness = None, sheen_color = None, sheen_roughness = None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn gltf(
        base_color: Given<'_, '_>,
        metallic: Given<'_, '_>,
        roughness: Given<'_, '_>,
        anisotropy: Given<'_, '_>,
        ior: f64,
        specular: Given<'_, '_>,
        specular_color: Given<'_, '_>,
        transmission: Given<'_, '_>,
        volume: bool,
        clearcoat: Given<'_, '_>,
        clearcoat_roughness: Given<'_, '_>,
        sheen_color: Given<'_, '_>,
        sheen_roughness: Given<'_, '_>,
    ) -> PyResult<Self> {
        let base_color = Paint::or("base_color", base_color, SHARE, 1.0)?;
        let metallic = Paint::or("metallic", metallic, SHARE, 1.0)?;
        let roughness = Paint::or("roughness", roughness, SHARE, 1.0)?;
        let anisotropy = Paint::or("anisotropy", anisotropy, SHARE, 0.0)?;
        let ior = index("ior", ior)?;
        let specular = Paint::or("specular", specular, SHARE, 1.0)?;
        let specular_color = Paint::or("specular_color", specular_color, ANY, 1.0)?;
        let transmission = Paint::or("transmission", transmission, SHARE, 0.0)?;
        let clearcoat = Paint::or("clearcoat", clearcoat, SHARE, 0.0)?;
        let coat_roughness = Paint::or("clearcoat_roughness", clearcoat_roughness, SHARE, 0.0)?;
        let sheen_color = Paint::or("sheen_color", sheen_color, SHARE, 0.0)?;
        let sheen_roughness = Paint::or("sheen_roughness", sheen_roughness, SHARE, 0.0)?;
        Ok(Self::new("gltf", move |scene| {
            MaterialKind::Gltf(GltfMaterial {
                base_colour: base_color.colour(scene),
                metallic: metallic.number(scene),
                roughness: roughness.number(scene),
                anisotropy: anisotropy.number(scene),
                anisotropy_rotation_rad: 0.0,
                anisotropy_direction: None,
                ior,
                specular: specular.number(scene),
                specular_colour: specular_color.colour(scene),
                transmission: transmission.number(scene),
                volume,
                clearcoat: clearcoat.number(scene),
                clearcoat_roughness: coat_roughness.number(scene),
                clearcoat_bump: None,
                sheen_colour: sheen_color.colour(scene),
                sheen_roughness: sheen_roughness.number(scene),
            })
        }))
    }

    /// Make Mitsuba's ``principled`` (Burley 2012 and 2015), its parameters named as there.
    #[staticmethod]
    #[pyo3(signature = (base_color = None, roughness = None, *, anisotropic = None, metallic = None,
        spec_trans = None, eta = 1.5, spec_tint = None, sheen = None, sheen_tint = None, clearcoat = None,
        clearcoat_gloss = None, flatness = None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn principled(
        base_color: Given<'_, '_>,
        roughness: Given<'_, '_>,
        anisotropic: Given<'_, '_>,
        metallic: Given<'_, '_>,
        spec_trans: Given<'_, '_>,
        eta: f64,
        spec_tint: Given<'_, '_>,
        sheen: Given<'_, '_>,
        sheen_tint: Given<'_, '_>,
        clearcoat: Given<'_, '_>,
        clearcoat_gloss: Given<'_, '_>,
        flatness: Given<'_, '_>,
    ) -> PyResult<Self> {
        let base_color = Paint::or("base_color", base_color, SHARE, 0.5)?;
        let roughness = Paint::or("roughness", roughness, SHARE, 0.5)?;
        let anisotropic = Paint::or("anisotropic", anisotropic, SHARE, 0.0)?;
        let metallic = Paint::or("metallic", metallic, SHARE, 0.0)?;
        let spec_trans = Paint::or("spec_trans", spec_trans, SHARE, 0.0)?;
        let eta = index("eta", eta)?;
        let spec_tint = Paint::or("spec_tint", spec_tint, SHARE, 0.0)?;
        let sheen = Paint::or("sheen", sheen, SHARE, 0.0)?;
        let sheen_tint = Paint::or("sheen_tint", sheen_tint, SHARE, 0.0)?;
        let clearcoat = Paint::or("clearcoat", clearcoat, SHARE, 0.0)?;
        let clearcoat_gloss = Paint::or("clearcoat_gloss", clearcoat_gloss, SHARE, 0.0)?;
        let flatness = Paint::or("flatness", flatness, SHARE, 0.0)?;
        Ok(Self::new("principled", move |scene| {
            MaterialKind::Principled(PrincipledMaterial {
                base_colour: base_color.colour(scene),
                roughness: roughness.number(scene),
                anisotropic: anisotropic.number(scene),
                metallic: metallic.number(scene),
                spec_trans: spec_trans.number(scene),
                eta,
                spec_tint: spec_tint.number(scene),
                sheen: sheen.number(scene),
                sheen_tint: sheen_tint.number(scene),
                clearcoat: clearcoat.number(scene),
                clearcoat_gloss: clearcoat_gloss.number(scene),
                flatness: flatness.number(scene),
                diff_trans: FloatParam::Value(0.0),
                thin: false,
            })
        }))
    }

    fn __repr__(&self) -> String {
        format!("<Material {}>", self.kind)
    }
}
