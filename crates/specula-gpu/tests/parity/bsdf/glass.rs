//! Interfaces between dielectrics: rough, smooth, thin, and compensated ones.

use specula_bsdf::Real;
use specula_bsdf::bsdf::{
    CompensatedDielectric, Lobe, RoughDielectric, SmoothDielectric, ThinDielectric, Tints,
};
use specula_bsdf::ndf::{Beckmann, Ggx};

use super::metals::{facets, masking};
use super::{arguments, colour, lobe_cases, rows, sampler, values};
use crate::harness::{ALPHAS, Case, alpha};

/// The tints of all cases.
macro_rules! tints {
    () => {
        "let tints = TintsPair(vec3f(0.9, 0.8, 1.0), vec3f(0.7, 1.0, 0.5));
         "
    };
}

fn tints<T: Real>() -> Tints<T> {
    Tints {
        reflection: colour([0.9, 0.8, 1.0]),
        transmission: colour([0.7, 1.0, 0.5]),
    }
}

fn rough_dielectric<T: Real>(p: &[T]) -> Lobe<T> {
    let (alpha, masking) = (alpha(p, 0), masking(p[3]));
    if p[2] > T::ZERO {
        let ndf = Beckmann::new(alpha);
        let lobe = if p[6] > T::ZERO {
            RoughDielectric::new(ndf, p[5])
        } else {
            RoughDielectric::facing(ndf, p[5])
        };
        lobe.with_masking(masking).with_tints(tints()).into()
    } else {
        let ndf = Ggx::new(alpha);
        let lobe = if p[6] > T::ZERO {
            RoughDielectric::new(ndf, p[5])
        } else {
            RoughDielectric::facing(ndf, p[5])
        };
        let lobe = lobe.with_masking(masking).with_tints(tints());
        lobe.with_sampler(sampler(p[4])).into()
    }
}

fn compensated_dielectric<T: Real>(p: &[T]) -> Lobe<T> {
    let (alpha, masking) = (alpha(p, 0), masking(p[3]));
    if p[2] > T::ZERO {
        let ndf = Beckmann::new(alpha);
        let lobe = if p[6] > T::ZERO {
            CompensatedDielectric::new(ndf, p[5])
        } else {
            CompensatedDielectric::facing(ndf, p[5])
        };
        lobe.with_masking(masking).with_tints(tints()).into()
    } else {
        let ndf = Ggx::new(alpha);
        let lobe = if p[6] > T::ZERO {
            CompensatedDielectric::new(ndf, p[5])
        } else {
            CompensatedDielectric::facing(ndf, p[5])
        };
        let lobe = lobe.with_masking(masking).with_tints(tints());
        lobe.with_sampler(sampler(p[4])).into()
    }
}

fn smooth_dielectric<T: Real>(p: &[T]) -> Lobe<T> {
    let lobe = if p[1] > T::ZERO {
        SmoothDielectric::new(p[0])
    } else {
        SmoothDielectric::facing(p[0])
    };
    lobe.with_tints(tints()).into()
}

fn thin_dielectric<T: Real>(p: &[T]) -> Lobe<T> {
    ThinDielectric::new(p[0]).with_tints(tints()).into()
}

/// Alphas, distribution, masking, strategy, index and whether it has both sides.
fn interfaces() -> Vec<[f32; 7]> {
    let mut all = vec![[0.3, 0.3, 0.0, 0.0, 1.0, 1.0005, 1.0]];
    for [x, y] in ALPHAS {
        for (k, eta) in [1.5, 1.0 / 1.5].into_iter().enumerate() {
            let two_sided = if k == 0 { 1.0 } else { 0.0 };
            all.push([x, y, 0.0, 0.0, 1.0, eta, two_sided]);
            all.push([x, y, 0.0, 1.0, 1.0, eta, 1.0 - two_sided]);
            if x.min(y) > 1e-2 {
                all.push([x, y, 0.0, 0.0, 3.0, eta, two_sided]);
            }
            if x.max(y) < 2.0 && x.min(y) > 1e-2 {
                all.push([x, y, 1.0, 0.0, 1.0, eta, two_sided]);
            }
        }
    }
    all
}

/// The value of the untinted interface, and two values that vanish.
fn branch_values<T: Real>(x: &[T]) -> Vec<T> {
    let p = &x[7..];
    let ndf = Ggx::new(alpha(p, 0));
    let lobe = if p[6] > T::ZERO {
        RoughDielectric::new(ndf, p[5])
    } else {
        RoughDielectric::facing(ndf, p[5])
    };
    let lobe = Lobe::from(lobe.with_masking(masking(p[3])));
    vec![values(&lobe, x)[0], T::ZERO, T::ZERO]
}

/// Samples of one branch, for walks: on the GPU, weight and density are those of `eval_branch`.
fn branch_cases() -> Vec<Case> {
    let body = arguments!(
        facets!(),
        "let white = TintsPair(vec3f(1.0), vec3f(1.0));
         let lobe = RoughDielectric(facets, x[12], u32(x[13]), white);
         y[0] = rough_dielectric_eval_branch(lobe, wo, wi, transport).x;
         // One branch a row: a loop over both is unrolled, and takes drivers long to compile.
         let reflects = fract(64.0 * abs(wi.y)) < 0.5;
         let sampled = rough_dielectric_sample_branch(lobe, wo, fract(abs(wi.xy)), reflects, transport);
         if sampled.flags != 0u {
             let value = rough_dielectric_eval_branch(lobe, wo, sampled.wi, transport);
             // Nothing passes where all is reflected.
             if sampled.weight.g > 0.0 {
                 y[1] = abs(sampled.pdf / value.y - 1.0);
                 y[2] = abs(sampled.weight.g * value.y / value.x - 1.0);
             }
         }"
    );
    let some: Vec<[f32; 7]> = interfaces()
        .into_iter()
        .filter(|p| p[2] == 0.0 && p[4] == 1.0 && p[5] != 1.0005)
        .collect();
    let [inputs, _] = rows(&some, |p| ([p[0], p[1]], Some(p[5])), |_| false);
    vec![Case {
        name: "rough_dielectric_branches",
        modules: &["rough_dielectric", "bsdf_sample"],
        body,
        arguments: inputs[0].len(),
        inputs: inputs.concat(),
        single: branch_values,
        double: branch_values,
        bound: 512.0,
        scale: &[1e-20, 1.0, 1.0],
        strays: 0,
    }]
}

pub(super) fn cases() -> Vec<Case> {
    let caps: Vec<[f32; 7]> = interfaces().into_iter().filter(|p| p[4] == 1.0).collect();
    let smooth = [[1.5, 1.0], [1.5, 0.0], [1.0 / 1.5, 1.0], [1.0 / 1.5, 0.0]];
    [
        lobe_cases!(
            "rough_dielectric",
            "rough_dielectric",
            concat!(
                facets!(),
                tints!(),
                "let lobe = RoughDielectric(facets, x[12], u32(x[13]), tints);\n"
            ),
            rough_dielectric,
            rows(
                &interfaces(),
                |p| ([p[0], p[1]], Some(p[5])),
                |p| p[2] > 0.0
            ),
            [512.0, 8192.0],
            &[1e-20]
        ),
        lobe_cases!(
            "compensated_dielectric",
            "compensated_dielectric",
            concat!(
                facets!(),
                tints!(),
                "let lobe = compensated_dielectric_new(facets, x[12], u32(x[13]), tints);\n"
            ),
            compensated_dielectric,
            rows(&caps, |p| ([p[0], p[1]], Some(p[5])), |p| p[2] > 0.0),
            [2048.0, 8192.0],
            &[1e-3]
        ),
        lobe_cases!(
            "smooth_dielectric",
            "smooth_dielectric",
            concat!(
                tints!(),
                "let lobe = SmoothDielectric(x[7], u32(x[8]), tints);\n"
            ),
            smooth_dielectric,
            rows(&smooth, |p| ([0.3, 0.3], Some(p[0])), |_| false),
            [0.0, 8.0],
            &[1e-20]
        ),
        lobe_cases!(
            "thin_dielectric",
            "thin_dielectric",
            concat!(tints!(), "let lobe = ThinDielectric(x[7], tints);\n"),
            thin_dielectric,
            rows(
                &[[1.5], [1.0 / 1.5]],
                |p| ([0.3, 0.3], Some(p[0])),
                |_| false
            ),
            [0.0, 8.0],
            &[1e-20]
        ),
    ]
    .concat()
    .into_iter()
    .chain(branch_cases())
    .collect()
}
