//! Materials by the formulas of formats: Mitsuba's principled ones and glTF's; and the black one.

use specula_bsdf::bsdf::{Gltf, GltfParameters, Lobe, Principled, PrincipledParameters};
use specula_bsdf::{Real, Vec3};

use super::{colour, lobe_cases, rows};
use crate::harness::{Case, both_sides, product, twins};

/// Statements that declare the parameters of a principled material.
macro_rules! principled {
    () => {
        "var p = principled_parameters_default();
         p.base_colour = vec3f(0.9, 0.6, 0.3);
         p.roughness = x[7]; p.anisotropic = x[8]; p.metallic = x[9]; p.spec_trans = x[10]; p.eta = x[11];
         p.spec_tint = x[12]; p.sheen = x[13]; p.sheen_tint = x[14]; p.clearcoat = x[15];
         p.clearcoat_gloss = x[16]; p.flatness = x[17]; p.diff_trans = x[18]; p.outside = u32(x[19]);
         p = principled_parameters_held(p);
         "
    };
}

fn principled<T: Real>(p: &[T], thin: bool) -> Lobe<T> {
    Principled::new(PrincipledParameters {
        base_colour: colour([0.9, 0.6, 0.3]),
        roughness: p[0],
        anisotropic: p[1],
        metallic: p[2],
        spec_trans: p[3],
        eta: p[4],
        spec_tint: p[5],
        sheen: p[6],
        sheen_tint: p[7],
        clearcoat: p[8],
        clearcoat_gloss: p[9],
        flatness: p[10],
        diff_trans: p[11],
        thin,
        outside: p[12] > T::ZERO,
    })
    .into()
}

fn principled_solid<T: Real>(p: &[T]) -> Lobe<T> {
    principled(p, false)
}

fn principled_thin<T: Real>(p: &[T]) -> Lobe<T> {
    principled(p, true)
}

fn gltf<T: Real>(p: &[T]) -> Lobe<T> {
    let colour_of = |x: T| colour::<T>([1.0, 0.5, 0.25]) * x;
    let material = Gltf::new(GltfParameters {
        base_colour: colour([0.9, 0.6, 0.3]),
        metallic: p[0],
        roughness: p[1],
        anisotropy: p[2],
        ior: p[3],
        specular: p[4],
        specular_colour: colour([1.0, 0.9, 0.8]),
        transmission: p[5],
        volume: p[6] > T::ZERO,
        outside: p[7] > T::ZERO,
        clearcoat: p[8],
        clearcoat_roughness: p[9],
        sheen_colour: colour_of(p[10]),
        sheen_roughness: p[11],
        compensated: p[13] > T::ZERO,
    });
    let normal = Vec3 {
        x: p[12],
        y: T::ZERO,
        z: (T::ONE - p[12] * p[12]).sqrt(),
    };
    material.with_coat_normal(normal).into()
}

/// Roughness, anisotropy, metal, transmission, index, tint, sheen and its tint, coat and its gloss,
/// flatness, diffuse transmission, and whether it is seen from outside.
#[rustfmt::skip]
const PRINCIPLED: [[f32; 13]; 12] = [
    [0.5, 0.0, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [0.1, 0.0, 1.0, 0.0, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [0.4, 0.8, 0.5, 0.0, 1.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [0.7, 0.0, 0.0, 0.0, 1.3, 1.0, 1.0, 0.5, 0.0, 0.0, 0.5, 0.0, 1.0],
    [0.5, 0.3, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [0.5, 0.0, 0.2, 0.0, 1.5, 0.0, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 1.0],
    [0.3, 0.0, 0.0, 1.0, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [0.3, 0.0, 0.0, 1.0, 1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.6, 0.5, 0.3, 0.5, 1.5, 0.3, 0.5, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0],
    [0.6, 0.5, 0.3, 0.5, 1.5, 0.3, 0.5, 0.5, 0.5, 0.5, 1.0, 1.0, 0.0],
    [1.0, 0.0, 0.0, 0.3, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3, 2.0, 1.0],
    [0.2, 1.0, 0.0, 0.7, 1.2, 0.0, 0.2, 1.0, 0.0, 0.0, 0.0, 0.5, 1.0],
];

/// Metal, roughness, anisotropy, index, specular, transmission, volume, outside, coat and its roughness,
/// sheen and its roughness, how far the coat's normal leans, and whether the metal is compensated.
#[rustfmt::skip]
const GLTF: [[f32; 14]; 17] = [
    [1.0, 1.0, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 0.2, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.5, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.5, 0.4, 0.7, 1.8, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.3, 0.0, 1.5, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.4, 0.0, 1.5, 1.0, 0.6, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.4, 0.0, 1.5, 1.0, 0.6, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.4, 0.0, 1.0, 1.0, 0.6, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.6, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 1.0, 0.2, 0.0, 0.0, 0.0, 0.0],
    [0.3, 0.6, 0.3, 1.5, 1.0, 0.0, 0.0, 1.0, 0.7, 0.4, 0.0, 0.0, 0.2, 0.0],
    [0.0, 0.8, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.3, 0.0, 0.0],
    [0.2, 0.5, 0.2, 1.4, 0.8, 0.3, 0.0, 1.0, 0.5, 0.3, 0.6, 0.8, 0.1, 0.0],
    [1.0, 1.0, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [1.0, 0.2, 0.0, 1.5, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [0.5, 0.4, 0.7, 1.8, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [0.3, 0.6, 0.3, 1.5, 1.0, 0.0, 0.0, 1.0, 0.7, 0.4, 0.3, 0.5, 0.2, 1.0],
];

pub(super) fn cases() -> Vec<Case> {
    let black = Case::new(
        "black",
        &["black"],
        "let wo = vec3f(x[0], x[1], x[2]);
         let wi = vec3f(x[3], x[4], x[5]);
         let value = black_eval_pdf(wo, wi, 0u);
         y[0] = dot(value, value) + dot(black_eval(wo, wi, 0u), wo) + black_pdf(wo, wi);
         y[1] = f32(black_sample(wo, wi, 0u).flags);",
        product::<3, 3, 6>(&both_sides(), &both_sides()),
        twins!(|_x| vec![T::ZERO, T::ZERO]),
        0.0,
    );
    let index = Case::new(
        "principled_index",
        &["principled_parameters"],
        "y[0] = principled_parameters_eta_of_specular(x[0]);",
        vec![[0.0], [0.25], [0.5], [1.0]],
        twins!(|x| vec![PrincipledParameters::eta_of_specular(x[0])]),
        8.0,
    );
    let mut cases = vec![black, index];
    cases.extend(lobe_cases!(
        "principled_solid",
        "principled_solid",
        concat!(principled!(), "let lobe = principled_solid_new(p);\n"),
        principled_solid,
        rows(
            &PRINCIPLED,
            |p| (
                [p[0] * p[0], p[0] * p[0]],
                (p[3] > 0.0).then_some(p[4].max(1.001))
            ),
            |_| false
        ),
        [1024.0, 256.0],
        &[1e-20]
    ));
    cases.extend(lobe_cases!(
        "principled_thin",
        "principled_thin",
        concat!(principled!(), "let lobe = principled_thin_new(p);\n"),
        principled_thin,
        rows(
            &PRINCIPLED,
            |p| ([p[0] * p[0], p[0] * p[0]], None),
            |_| false
        ),
        [32.0, 128.0],
        &[1e-20]
    ));
    cases.extend(lobe_cases!(
        "gltf",
        "gltf",
        "var p = gltf_parameters_default();
         p.base_colour = vec3f(0.9, 0.6, 0.3); p.metallic = x[7]; p.roughness = x[8]; p.anisotropy = x[9];
         p.ior = x[10]; p.specular = x[11]; p.specular_colour = vec3f(1.0, 0.9, 0.8); p.transmission = x[12];
         p.volume = u32(x[13]); p.outside = u32(x[14]); p.clearcoat = x[15]; p.clearcoat_roughness = x[16];
         p.sheen_colour = vec3f(1.0, 0.5, 0.25) * x[17]; p.sheen_roughness = x[18];
         p.compensated = u32(x[20]);
         let lobe = gltf_new(p, vec3f(x[19], 0.0, sqrt(1.0 - x[19] * x[19])));\n",
        gltf,
        rows(&GLTF, |p| ([p[1] * p[1], p[1] * p[1]], (p[6] > 0.0).then_some(p[3].max(1.001))), |_| false),
        // Weights of compensated metals near the horizon are as exact as `wi.z` in f32, where shader and Rust
        // agree bit for bit: 6,800.
        [128.0, 8192.0],
            &[1e-20]
    ));
    cases
}
