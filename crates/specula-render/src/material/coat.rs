//! Coats over diffuse bases whose colours alone differ from point to point: what does not depend on the colour is looked
//! up once for the material.

use specula_bsdf::Rgb;
use specula_bsdf::bsdf::{DiffuseCoat, Lobe, Plastic};
use specula_bsdf::ndf::Beckmann;
use specula_scene::scene::{ColourParam, FloatParam, MaterialKind};

use super::bind::PointParameters;
use super::{Models, bind};
use crate::texture::{TextureCoordinates, Textures};

/// A coat, without its base, and the base's colour.
#[derive(Clone, Debug)]
pub(crate) struct ColouredBase {
    pub(crate) colour: ColourParam,
    pub(crate) coat: BaseCoat,
}

/// A coat without its base.
#[derive(Clone, Copy, Debug)]
#[allow(
    clippy::large_enum_variant,
    reason = "there are few, one for each material"
)]
pub(crate) enum BaseCoat {
    Diffuse(DiffuseCoat<f32>),
    Plastic(Plastic<f32>),
    PlasticBeckmann(Plastic<f32, Beckmann<f32>>),
}

impl ColouredBase {
    /// `None` where more than the base's colour differs, or nothing does.
    pub(super) fn new(kind: &MaterialKind, textures: &Textures, models: Models) -> Option<Self> {
        let is_same = |parameters: &[FloatParam]| {
            let mut all = parameters.iter();
            all.all(|p| matches!(p, FloatParam::Value(_)))
        };
        let nowhere = TextureCoordinates::default();
        let at = PointParameters::new(textures, &nowhere, models, None);
        match kind {
            MaterialKind::CoatedDiffuse {
                reflectance: colour @ ColourParam::Texture(_),
                eta,
                roughness,
                medium,
                lossless,
            } if is_same(&[roughness.u, roughness.v, medium.thickness]) && !medium.scatters() => {
                let coat = at.diffuse_coat(*eta, roughness, (medium, *lossless), models);
                Some(Self {
                    colour: *colour,
                    coat: BaseCoat::Diffuse(coat),
                })
            }
            MaterialKind::Plastic {
                diffuse: colour @ ColourParam::Texture(_),
                specular: specular @ ColourParam::Value(_),
                eta,
                roughness,
                nonlinear,
            } if is_same(&[roughness.u, roughness.v]) => {
                let colours = [Rgb::WHITE, at.albedo(*specular)];
                let coat = match at.plastic(colours, *eta, roughness, *nonlinear, models) {
                    Lobe::Plastic(plastic) => BaseCoat::Plastic(plastic),
                    Lobe::PlasticBeckmann(plastic) => BaseCoat::PlasticBeckmann(plastic),
                    _ => return None,
                };
                Some(Self {
                    colour: *colour,
                    coat,
                })
            }
            _ => None,
        }
    }

    /// The lobe at a point.
    #[inline(always)]
    pub(super) fn at(&self, textures: &Textures, place: &TextureCoordinates) -> Lobe<f32> {
        self.coat.over(bind::albedo(textures, self.colour, place))
    }
}

impl BaseCoat {
    /// Over a base.
    #[inline(always)]
    pub(super) fn over(&self, albedo: Rgb<f32>) -> Lobe<f32> {
        match self {
            Self::Diffuse(coat) => coat.over(albedo).into(),
            Self::Plastic(plastic) => plastic.over(albedo).into(),
            Self::PlasticBeckmann(plastic) => plastic.over(albedo).into(),
        }
    }

    /// The albedo of a base with all bounces, as batches take it.
    #[inline(always)]
    pub(crate) fn base(&self, albedo: Rgb<f32>) -> Rgb<f32> {
        match self {
            Self::Diffuse(coat) => coat.over(albedo).base(),
            Self::Plastic(plastic) => plastic.over(albedo).base(),
            Self::PlasticBeckmann(plastic) => plastic.over(albedo).base(),
        }
    }
}
