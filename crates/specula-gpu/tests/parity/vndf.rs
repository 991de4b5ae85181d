//! Samplers of visible normals and reflections, and their densities.

use specula_bsdf::Alpha;
use specula_bsdf::math::Vec3;
use specula_bsdf::ndf::{Ggx, Ndf};
use specula_bsdf::vndf::{Reflections, Sampler, beckmann, bounded, cap, exact, heitz, reflect};

use crate::harness::{
    ALPHAS, Case, Fault, alpha, assert_covered, both_sides, catch, prove, r2, twins, vector,
};
use crate::ndf::is_visible;

/// Points of the unit square for each pair of alphas and view.
const SAMPLES: usize = 24;

/// Alphas, a view and a point of the unit square.
fn samples() -> Vec<[f32; 7]> {
    let edges = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.6, -0.8, 1e-6]];
    let views = [both_sides(), edges.to_vec()].concat();
    let mut rows = Vec::new();
    for [ax, ay] in ALPHAS {
        for wo in &views {
            for _ in 0..SAMPLES {
                let u = r2(rows.len());
                rows.push([ax, ay, wo[0], wo[1], wo[2], u[0], u[1]]);
            }
        }
    }
    rows
}

/// Alphas, a view and what a sampler reflects it to: where the density is large.
fn pairs() -> Vec<[f32; 8]> {
    let pair = |x: [f32; 7]| {
        let wo = vector(&x, 2);
        let wi = exact::sample_direction(alpha(&x, 0), wo, [x[5], x[6]]);
        [x[0], x[1], x[2], x[3], x[4], wi.x, wi.y, wi.z]
    };
    let mut rows: Vec<[f32; 8]> = samples().into_iter().step_by(5).map(pair).collect();
    for [ax, ay] in ALPHAS {
        for wo in both_sides() {
            let away = both_sides().into_iter().step_by(3);
            rows.extend(away.map(|wi| [ax, ay, wo[0], wo[1], wo[2], wi[0], wi[1], wi[2]]));
        }
    }
    rows
}

/// Statements before those of a sample.
macro_rules! sampling {
    ($($body:literal)*) => {
        concat!(
            "let alpha = vec2f(x[0], x[1]);
             let wo = vec3f(x[2], x[3], x[4]);
             let u = vec2f(x[5], x[6]);
             ",
            $($body),*
        )
    };
}

/// A case's body that stores one direction.
macro_rules! direction_of {
    ($call:literal) => {
        concat!(
            "let alpha = vec2f(x[0], x[1]);
             let wo = vec3f(x[2], x[3], x[4]);
             let u = vec2f(x[5], x[6]);
             let w = ",
            $call,
            "; y[0] = w.x; y[1] = w.y; y[2] = w.z;"
        )
    };
}

/// Statements before those of a density.
macro_rules! density {
    ($($body:literal)*) => {
        concat!(
            "let alpha = vec2f(x[0], x[1]);
             let wo = vec3f(x[2], x[3], x[4]);
             let wi = vec3f(x[5], x[6], x[7]);
             ",
            $($body),*
        )
    };
}

/// Twins of a sample: a function of alphas, view and point.
macro_rules! sampled {
    ($sample:path) => {
        twins!(|x| $sample(alpha(x, 0), vector(x, 2), [x[5], x[6]])
            .to_array()
            .to_vec())
    };
}

fn samplers() -> Vec<Case> {
    vec![
        Case::new(
            "heitz_normals",
            &["heitz"],
            direction_of!("heitz_sample_wm(alpha, wo, u)"),
            samples(),
            sampled!(heitz::sample_wm),
            // Along the surface and alpha 1e-3: the last point of the ellipse is a root of a difference.
            3000.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "cap_normals",
            &["cap"],
            direction_of!("cap_sample_wm(alpha, wo, u)"),
            samples(),
            sampled!(cap::sample_wm),
            256.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "cap_reflections",
            &["cap"],
            direction_of!("cap_sample_direction(alpha, wo, u)"),
            samples(),
            sampled!(cap::sample_direction),
            // Reflections of narrow lobes turn fast with the half vector at grazing views.
            512.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "bounded_reflections",
            &["bounded"],
            direction_of!("bounded_sample_direction(alpha, wo, u)"),
            samples(),
            sampled!(bounded::sample_direction),
            // Reflections of alphas (8, 0.01) turn fast with the half vector.
            512.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "exact_reflections",
            &["exact"],
            direction_of!("exact_sample_direction(alpha, wo, u)"),
            samples(),
            sampled!(exact::sample_direction),
            // The same of alphas (1e-4, 10).
            2000.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "exact_isotropic_reflections",
            &["exact_isotropic"],
            direction_of!("exact_isotropic_sample_direction(alpha.x, wo, u)"),
            samples().into_iter().filter(|x| x[0] == x[1]).collect(),
            sampled!(exact::sample_direction),
            2000.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "beckmann_normals",
            &["beckmann_visible"],
            direction_of!("beckmann_visible_sample_wm(alpha, wo, u)"),
            samples(),
            sampled!(beckmann::sample_wm),
            // The twin finds its roots in f64.
            256.0,
        )
        .at_scale(&[1.0]),
    ]
}

fn chosen_samplers() -> Vec<Case> {
    const CHOSEN: [Sampler; 4] = [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ];
    vec![
        Case::new(
            "chosen_reflections",
            &["reflection"],
            sampling!(
                "for (var k = 0u; k < 4u; k++) {
                     let w = reflection_sample_direction(k, alpha, wo, u);
                     y[3u * k] = w.x; y[3u * k + 1u] = w.y; y[3u * k + 2u] = w.z;
                 }
                 let w = reflection_mirrored(wo, vec3f(0.36, 0.48, 0.8));
                 y[12] = w.x; y[13] = w.y; y[14] = w.z;"
            ),
            samples(),
            twins!(|x| {
                let (ggx, wo) = (Ggx::new(alpha(x, 0)), vector(x, 2));
                let sample = |s| ggx.sample_reflection(s, wo, [x[5], x[6]]).to_array();
                let wm = [0.36_f32, 0.48, 0.8].map(|c| T::of(c.into()));
                let mirrored = reflect(wo, wm.into()).to_array();
                [CHOSEN.map(sample).as_flattened(), &mirrored[..]].concat()
            }),
            // As of Heitz.
            4000.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "stored_reflections",
            &["reflections"],
            sampling!(
                "for (var k = 0u; k < 4u; k++) {
                     let reflections = reflections_new(alpha, wo, k);
                     let w = reflections_sample_direction(reflections, u);
                     y[3u * k] = w.x; y[3u * k + 1u] = w.y; y[3u * k + 2u] = w.z;
                 }"
            ),
            samples(),
            twins!(|x| {
                let (alpha, wo): (Alpha<T>, Vec3<T>) = (alpha(x, 0), vector(x, 2));
                let sample = |s| Reflections::new(alpha, wo, s).sample_direction([x[5], x[6]]);
                CHOSEN.map(|s| sample(s).to_array()).concat()
            }),
            // As of Heitz.
            4000.0,
        )
        .at_scale(&[1.0]),
    ]
}

fn densities() -> Vec<Case> {
    vec![
        Case::new(
            "norms",
            &["reflection"],
            density!(
                "let quotient = reflection_norm_quotient(0u, alpha, wo);
                 y[0] = quotient.x / quotient.y;
                 y[1] = bounded_norm(alpha, wo);
                 y[2] = exact_norm(alpha, wo);"
            ),
            pairs(),
            twins!(|x| {
                let (alpha, wo): (Alpha<T>, Vec3<T>) = (alpha(x, 0), vector(x, 2));
                let whole = Ggx::new(alpha).projected_area(wo);
                vec![whole, bounded::norm(alpha, wo), exact::norm(alpha, wo)]
            }),
            64.0,
        ),
        Case::new(
            "densities_of_normals",
            &["heitz", "cap"],
            density!("y[0] = heitz_pdf_wm(alpha, wo, wi); y[1] = cap_pdf_wm(alpha, wo, wi);"),
            pairs(),
            twins!(|x| {
                let (alpha, wo, wm) = (alpha(x, 0), vector(x, 2), vector(x, 5));
                vec![heitz::pdf_wm(alpha, wo, wm), cap::pdf_wm(alpha, wo, wm)]
            }),
            // The cosine between view and normal cancels.
            2000.0,
        )
        .at_scale(&[1e-6]),
        Case::new(
            "densities_of_reflections",
            &["reflections"],
            density!(
                "y[0] = heitz_reflection_pdf(alpha, wo, wi);
                 y[1] = cap_reflection_pdf(alpha, wo, wi);
                 y[2] = bounded_reflection_pdf(alpha, wo, wi);
                 y[3] = exact_reflection_pdf(alpha, wo, wi);
                 y[12] = exact_isotropic_reflection_pdf(alpha.x, wo, wi);
                 for (var k = 0u; k < 4u; k++) {
                     y[k + 4u] = reflection_pdf(k, alpha, wo, wi);
                     y[k + 8u] = reflections_pdf(reflections_new(alpha, wo, k), wi);
                 }"
            ),
            pairs(),
            twins!(|x| {
                let (alpha, wo, wi) = (alpha(x, 0), vector(x, 2), vector(x, 5));
                let four = [
                    heitz::reflection_pdf(alpha, wo, wi),
                    cap::reflection_pdf(alpha, wo, wi),
                    bounded::reflection_pdf(alpha, wo, wi),
                    exact::reflection_pdf(alpha, wo, wi),
                ];
                let round = Alpha { x: x[0], y: x[0] };
                let isotropic = exact::reflection_pdf(round, wo, wi);
                [&[four, four, four].concat()[..], &[isotropic]].concat()
            }),
            64.0,
        )
        .at_scale(&[1e-6]),
    ]
}

fn beckmann_densities() -> Vec<Case> {
    vec![
        Case::new(
            "beckmann_densities",
            &["beckmann_visible"],
            density!(
                "y[0] = beckmann_visible_pdf_wm(alpha, wo, wi);
                 y[1] = beckmann_visible_reflection_pdf(alpha, wo, wi);"
            ),
            pairs()
                .into_iter()
                .filter(|x| is_visible(x[0], x[1], [x[2], x[3], x[4]]))
                .collect(),
            twins!(|x| {
                let (alpha, wo, w) = (alpha(x, 0), vector(x, 2), vector(x, 5));
                vec![
                    beckmann::pdf_wm(alpha, wo, w),
                    beckmann::reflection_pdf(alpha, wo, w),
                ]
            }),
            200.0,
        )
        .at_scale(&[1e-6]),
    ]
}

pub(crate) fn cases() -> Vec<Case> {
    [
        samplers(),
        chosen_samplers(),
        densities(),
        beckmann_densities(),
    ]
    .concat()
}

pub(crate) const FAULTS: [Fault; 7] = [
    Fault {
        case: "heitz_normals",
        module: "vndf/heitz",
        from: "0.5 * (lengths.y / lengths.x) * (chord",
        to: "0.501 * (lengths.y / lengths.x) * (chord",
    },
    Fault {
        case: "cap_reflections",
        module: "vndf/cap",
        from: "2.0 * lengths.x - height",
        to: "1.999 * lengths.x - height",
    },
    Fault {
        case: "bounded_reflections",
        module: "vndf/bounded",
        from: "select(-sine, sine, a <= 1.0)",
        to: "sine",
    },
    Fault {
        case: "densities_of_reflections",
        module: "vndf/exact_isotropic",
        from: "q * q + 4.0 * p",
        to: "q * q + 4.001 * p",
    },
    Fault {
        case: "exact_reflections",
        module: "vndf/exact_chords",
        from: "select(1.0, -1.0, walked - c * slide_along > far)",
        to: "1.0",
    },
    Fault {
        case: "norms",
        module: "vndf/exact_cone",
        from: "cone.lambda * cone.lambda * area",
        to: "cone.lambda * area",
    },
    Fault {
        case: "beckmann_normals",
        module: "vndf/beckmann_visible",
        from: "0.5 * cosine * erf_scaled_complement(-x)",
        to: "0.501 * cosine * erf_scaled_complement(-x)",
    },
];

#[test]
fn samplers_agree_with_their_twins() {
    prove("vndf", &cases());
}

#[test]
fn faults_in_samplers_are_noticed() {
    catch("vndf", &cases(), &FAULTS);
}

#[test]
fn every_function_of_samplers_has_a_case() {
    let sample = "part of its sampler, private in Rust too";
    let norm = "part of the norm and the density";
    let elsewhere = [
        ("stretched_lengths", sample),
        ("half_vector_mirrored", sample),
        ("half_vector_density", norm),
        ("half_vector_unit", "part of the lobes, private in Rust too"),
        ("cap_half_vector", sample),
        ("cap_half_vector_towards", sample),
        ("bounded_height", sample),
        ("bounded_norm_quotient", norm),
        ("exact_cone_new", sample),
        ("exact_cone_root", sample),
        ("exact_cone_norm", norm),
        ("exact_chords_half_vector", sample),
        ("exact_chords_lift", sample),
        ("exact_isotropic_roots", sample),
        ("exact_isotropic_norm", norm),
        ("exact_isotropic_norm_quotient", norm),
        ("exact_isotropic_half_vector", sample),
        ("exact_norm_quotient", norm),
        ("beckmann_visible_slope_along", sample),
        ("beckmann_visible_slope_away", sample),
        ("beckmann_visible_slope_towards", sample),
        ("beckmann_visible_excess_below", sample),
    ];
    assert_covered("vndf", &cases(), &elsewhere);
}
