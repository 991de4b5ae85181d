//! Roughness and reflectance of materials as the library's lobes take them.

use specula_bsdf::fresnel::{Conductor, Reflectance, Schlick};
use specula_bsdf::{Alpha, Rgb};
use specula_scene::scene::{ConductorFresnel, Roughness, RoughnessMapping};

use crate::convert::narrow;
use crate::texture::{TextureCoordinates, Textures};

/// The alphas; `None` where the surface is smooth: both are below [`Alpha::SPECULAR_BELOW`]. With
/// one above, the other is raised to that bound.
///
/// * `regularized`: whether it is the material behind a rough surface; it is never smooth then.
pub(super) fn alpha(
    roughness: &Roughness,
    textures: &Textures,
    place: &TextureCoordinates,
    regularized: bool,
) -> Option<Alpha<f32>> {
    let bound = narrow(Alpha::<f32>::SPECULAR_BELOW);
    let [x, y] = [roughness.u, roughness.v].map(|p| {
        let r = textures.float(p, place).max(0.0);
        let alpha = match roughness.mapping {
            RoughnessMapping::Alpha => r,
            RoughnessMapping::Sqrt => r.sqrt(),
            RoughnessMapping::Square => r * r,
        };
        match regularized {
            true => regularized_alpha(alpha),
            false => alpha,
        }
    });
    (x >= bound || y >= bound).then(|| Alpha::clamped(x.max(bound), y.max(bound)))
}

/// Alpha of a surface behind a rough one: pbrt-v4's `TrowbridgeReitzDistribution::Regularize`.
///
/// ```text
/// alpha < 0.3:  clamp(2 alpha, 0.1, 0.3)
/// ```
///
/// * `alpha`: 0 for a smooth surface.
#[inline]
pub(super) fn regularized_alpha(alpha: f32) -> f32 {
    if alpha < 0.3 {
        (2.0 * alpha).clamp(0.1, 0.3)
    } else {
        alpha
    }
}

/// What a metal's facets reflect.
pub(super) fn reflectance(
    fresnel: &ConductorFresnel,
    textures: &Textures,
    place: &TextureCoordinates,
) -> Reflectance<f32> {
    let unit = |colour| textures.colour(colour, place).map(|r| r.clamp(0.0, 1.0));
    match *fresnel {
        ConductorFresnel::Index { eta, k } => Reflectance::Conductor(Conductor {
            eta: textures.colour(eta, place).map(|v| v.max(1e-4)),
            k: textures.colour(k, place).map(|v| v.max(0.0)),
        }),
        // pbrt-v4: the k that gives this reflectance at normal incidence with eta = 1.
        ConductorFresnel::Reflectance(colour) => Reflectance::Conductor(Conductor {
            eta: Rgb::WHITE,
            k: unit(colour).map(|r| {
                let r = r.min(0.9999);
                2.0 * r.sqrt() / (1.0 - r).sqrt()
            }),
        }),
        ConductorFresnel::Schlick(colour) => Reflectance::Schlick(Schlick { f0: unit(colour) }),
        ConductorFresnel::Mirror => Reflectance::Constant(Rgb::WHITE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_scene::scene::{ColourParam, FloatParam};

    #[test]
    fn roughness_becomes_alpha_and_smooth_below_the_bound() {
        let textures = Textures::default();
        let of = |u, v, mapping| {
            let roughness = Roughness {
                v: FloatParam::Value(v),
                ..Roughness::isotropic(FloatParam::Value(u), mapping)
            };
            alpha(&roughness, &textures, &TextureCoordinates::default(), false)
        };
        let expected = |x, y| Some(Alpha::clamped(x, y));
        assert_eq!(of(9e-4, 0.0, RoughnessMapping::Alpha), None);
        assert_eq!(of(f32::NAN, -1.0, RoughnessMapping::Alpha), None);
        assert_eq!(of(0.0, 0.3, RoughnessMapping::Alpha), expected(1e-3, 0.3));
        assert_eq!(of(0.25, 0.04, RoughnessMapping::Sqrt), expected(0.5, 0.2));
        assert_eq!(of(0.5, 0.5, RoughnessMapping::Square), expected(0.25, 0.25));
    }

    #[test]
    fn metals_reflect_what_they_are_given_at_normal_incidence() {
        let given = [0.9, 0.5, 0.1];
        let colour = ColourParam::Value(Rgb::from(given));
        for (fresnel, expected) in [
            (ConductorFresnel::Reflectance(colour), given),
            (ConductorFresnel::Schlick(colour), given),
            (ConductorFresnel::Mirror, [1.0; 3]),
        ] {
            let found = reflectance(
                &fresnel,
                &Textures::default(),
                &TextureCoordinates::default(),
            )
            .eval(1.0);
            for (found, expected) in found.to_array().into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-4, "{found} {expected}");
            }
        }
    }

    #[test]
    fn alphas_are_those_of_pbrt() {
        for (alpha, expected) in [
            (0.0, 0.1),
            (0.04, 0.1),
            (0.05, 0.1),
            (0.1, 0.2),
            (0.2, 0.3),
            (0.3, 0.3),
            (0.7, 0.7),
        ] {
            let found = regularized_alpha(alpha);
            assert!((found - expected).abs() < 1e-7, "{alpha}: {found}");
        }
    }
}
