//! Coats over Lambert.

use specula_bsdf::Real;
use specula_bsdf::bsdf::{CoatLayer, CoatScattering, CoatedDiffuse, Lobe, Plastic};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};

use super::{colour, lobe_cases, rows};
use crate::harness::{Case, alpha};

fn coated_diffuse<T: Real>(p: &[T]) -> Lobe<T> {
    let coat = (p[2] > T::ZERO).then(|| Ggx::new(alpha(p, 0)));
    let depth = [None, Some(4), Some(11)]
        .into_iter()
        .find(|d| p[5] == T::of(f64::from(d.unwrap_or(0))));
    let layer = CoatLayer {
        thickness: p[4],
        max_depth: depth.flatten(),
        scattering: if p[6] > T::ZERO {
            CoatScattering::Lossless
        } else {
            CoatScattering::Single
        },
    };
    CoatedDiffuse::over_layer(coat, p[3], colour([0.9, 0.6, 0.3]), layer).into()
}

fn plastic<T: Real>(p: &[T]) -> Lobe<T> {
    let (diffuse, specular) = (colour([0.9, 0.6, 0.3]), colour([1.0, 0.8, 0.5]));
    let nonlinear = p[5] > T::ZERO;
    if p[3] == T::ZERO {
        return Plastic::smooth(p[4], diffuse, specular, nonlinear).into();
    }
    let masking = Masking::Separable;
    if p[2] > T::ZERO {
        let ndf = Beckmann::new(alpha(p, 0));
        Plastic::rough(ndf, masking, p[4], diffuse, specular, nonlinear).into()
    } else {
        let ndf = Ggx::new(alpha(p, 0));
        Plastic::rough(ndf, masking, p[4], diffuse, specular, nonlinear).into()
    }
}

/// Alphas of coats.
const ALPHAS: [[f32; 2]; 5] = [
    [1e-3, 1e-3],
    [0.05, 0.05],
    [0.3, 0.3],
    [0.2, 0.8],
    [1.5, 1.5],
];

/// Alphas, whether rough, index, thickness, depth and what the coat's facets do.
fn coated() -> Vec<[f32; 7]> {
    let mut all = Vec::new();
    for [x, y] in ALPHAS {
        for lossless in [0.0, 1.0] {
            all.push([x, y, 1.0, 1.5, 0.0, 0.0, lossless]);
            all.push([x, y, 1.0, 1.3, 0.2, 4.0, lossless]);
        }
    }
    all.extend([
        [0.3, 0.3, 0.0, 1.5, 0.0, 0.0, 1.0],
        [0.3, 0.3, 0.0, 1.5, 0.5, 11.0, 0.0],
        [0.3, 0.3, 0.0, 2.4, 0.1, 4.0, 1.0],
        [0.3, 0.3, 1.0, 4.0, 3.0, 11.0, 1.0],
    ]);
    all
}

/// Alphas, distribution, whether rough, index and whether the series takes the base's colour.
fn plastics() -> Vec<[f32; 6]> {
    let mut all = vec![
        [0.3, 0.3, 0.0, 0.0, 1.5, 0.0],
        [0.3, 0.3, 0.0, 0.0, 1.9, 1.0],
        [0.3, 0.3, 0.0, 0.0, 0.75, 1.0],
    ];
    for [x, y] in ALPHAS {
        all.push([x, y, 0.0, 1.0, 1.5, 0.0]);
        all.push([x, y, 0.0, 1.0, 1.9, 1.0]);
        if x > 1e-2 {
            all.push([x, y, 1.0, 1.0, 1.5, 1.0]);
        }
    }
    all
}

pub(super) fn cases() -> Vec<Case> {
    [
        lobe_cases!(
            "coated_diffuse",
            "coated_diffuse",
            "let facets = MicrofacetsModel(vec2f(x[7], x[8]), DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER_EXACT);
             let depth = select(u32(x[12]), COATED_DIFFUSE_UNLIMITED, x[12] == 0.0);
             let lobe = coated_diffuse_new(facets, x[9] > 0.0, x[10], vec3f(0.9, 0.6, 0.3), x[11], depth, u32(x[13]));\n",
            coated_diffuse,
            rows(&coated(), |p| ([p[0], p[1]], None), |_| false),
            [64.0, 1024.0],
            &[1e-20]
        ),
        lobe_cases!(
            "plastic",
            "plastic",
            "let facets = MicrofacetsModel(vec2f(x[7], x[8]), u32(x[9]), MASKING_SEPARABLE, SAMPLER_EXACT);
             let diffuse = vec3f(0.9, 0.6, 0.3);
             let specular = vec3f(1.0, 0.8, 0.5);
             var lobe = plastic_smooth(x[11], diffuse, specular, x[12] > 0.0);
             if x[10] > 0.0 { lobe = plastic_rough(facets, x[11], diffuse, specular, x[12] > 0.0); }\n",
            plastic,
            rows(&plastics(), |p| ([p[0], p[1]], None), |p| p[2] > 0.0),
            [64.0, 512.0],
            &[1e-20]
        ),
    ]
    .concat()
}
