//! A material of hair at a point.

use specula_bsdf::hair::{Hair, HairParameters, absorption_of_colour, absorption_of_melanin};
use specula_scene::scene::{ColourParam, FloatParam, HairMaterial, HairPigment};

use crate::texture::{TextureCoordinates, Textures};

/// The fibre around its normal.
pub(super) fn lobe(
    hair: &HairMaterial,
    textures: &Textures,
    place: &TextureCoordinates,
) -> Hair<f32> {
    let float = |parameter: FloatParam| textures.float(parameter, place);
    let colour = |parameter: ColourParam| textures.colour(parameter, place);
    let beta_n = float(hair.beta_n);
    let sigma_a = match hair.pigment {
        HairPigment::Absorption(sigma_a) => colour(sigma_a),
        HairPigment::Reflectance(reflectance) => absorption_of_colour(colour(reflectance), beta_n),
        HairPigment::Melanin {
            eumelanin,
            pheomelanin,
        } => absorption_of_melanin(float(eumelanin), float(pheomelanin)),
    };
    let parameters = HairParameters {
        sigma_a,
        eta: float(hair.eta),
        beta_m: float(hair.beta_m),
        beta_n,
        alpha_deg: float(hair.alpha_deg),
    };
    Hair::new(&parameters)
}
