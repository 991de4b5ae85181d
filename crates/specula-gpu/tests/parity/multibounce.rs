//! Multiple bounces between microfacets.
//!
//! Values and samples of the walks are estimates from a stream of random numbers. Two proofs: element by
//! element against the Rust twin in `f32` with the same stream, which takes the same walk but where
//! rounding turns a decision; and means over many streams against the twin in `f64`, by z-tests
//! (`means.rs`).

use specula_bsdf::bsdf::Tints;
use specula_bsdf::bsdf::{MultibounceConductor, MultibounceDielectric, MultibounceDiffuse};
use specula_bsdf::fresnel::{Reflectance, Schlick};
use specula_bsdf::math::{Stream, rgb};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel as Model};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Bsdf, BsdfSample, Event, Real, Rgb, Transport, Vec3};

use crate::harness::{
    ABOVE, Case, ETAS, Twin, alpha, assert_covered, both_sides, catch_some, product, prove, r2,
    round, vector, views,
};

mod closed;
mod faults;
pub(crate) mod means;

use closed::closed;
use faults::ELSEWHERE;
pub(crate) use faults::FAULTS;

/// Alphas of the walks.
const ALPHAS: [[f32; 2]; 6] = [
    [1e-4, 1e-4],
    [0.05, 0.05],
    [0.3, 0.3],
    [1.0, 1.0],
    [0.2, 0.8],
    [10.0, 10.0],
];
/// Of a thousand walks, those that may part from their twins where rounding turns a decision. (Measured
/// in software: none to 4 of 3000, over the roughest surfaces, whichever way the samplers round.)
const STRAYS: usize = 2;
/// The error of the others, in ulps of `SCALE` or more: 4.8e-4 of larger values.
const BOUND: f64 = 4000.0;
/// The least value whose digits count.
const SCALE: f64 = 0.01;
/// The high word of all seeds.
const SEED: u64 = 0x5eed;

/// Statements that make a metal's arguments: alphas, view, light (or three values), seed.
macro_rules! metal {
    ($($body:tt)*) => {
        concat!(
            "let normals = NormalsModel(vec2f(x[0], x[1]), DISTRIBUTION_GGX);
             let wo = vec3f(x[2], x[3], x[4]);
             let wi = vec3f(x[5], x[6], x[7]);
             var stream = stream_new(vec2u(u32(x[8]), 0x5eedu));
             let facets = WalkFacets(normals, reflectance_schlick(vec3f(0.9, 0.6, 0.3)));
             ",
            $($body)*
        )
    };
}
use metal;

/// Statements that make a dielectric's arguments: those of a metal, and the index.
macro_rules! glass {
    ($model:literal, $mis:literal, $($body:tt)*) => {
        concat!(
            "let normals = NormalsModel(vec2f(x[0], x[1]), DISTRIBUTION_GGX);
             let wo = vec3f(x[2], x[3], x[4]);
             let wi = vec3f(x[5], x[6], x[7]);
             var stream = stream_new(vec2u(u32(x[8]), 0x5eedu));
             let tints = TintsPair(vec3f(0.9, 1.0, 1.0), vec3f(0.7, 1.0, 1.0));
             let lobe = MultibounceDielectric(normals, x[9], 1u, ",
            $model, ", ", $mis, ", tints);
             ",
            $($body)*
        )
    };
}
use glass;

/// Statements that store a sample.
macro_rules! stored {
    ($($sample:literal),*) => {
        concat!(
            "let sampled = ", $($sample),*, ";
             y[0] = f32(sampled.flags);
             if sampled.flags != 0u {
                 y[1] = sampled.wi.x; y[2] = sampled.wi.y; y[3] = sampled.wi.z;
                 y[4] = sampled.weight.r; y[5] = sampled.weight.b; y[6] = sampled.eta;
             }"
        )
    };
}
pub(crate) use stored;

/// The `f32` twin, and itself as the reference: the streams of `f64` have more digits, so that its
/// walks are others.
macro_rules! walks {
    (|$x:ident| $body:expr) => {{
        fn single($x: &[f32]) -> Vec<f32> {
            $body
        }
        fn double(x: &[f64]) -> Vec<f64> {
            let x: Vec<f32> = x.iter().map(|&v| round(v)).collect();
            single(&x).into_iter().map(f64::from).collect()
        }
        (single as Twin<f32>, double as Twin<f64>)
    }};
}
pub(crate) use walks;

/// The reflectance of [`metal`].
pub(crate) fn reflectance<T: Real>() -> Reflectance<T> {
    let [r, g, b] = [0.9_f32, 0.6, 0.3].map(|v| T::of(f64::from(v)));
    Reflectance::Schlick(Schlick { f0: rgb(r, g, b) })
}

/// The distribution of arguments 0 and 1.
pub(crate) fn ggx<T: Real>(x: &[T]) -> Ggx<T> {
    Ggx::new(alpha(x, 0))
}

/// The stream of argument `at`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "seeds are whole numbers"
)]
pub(crate) fn stream<T: Real>(x: &[T], at: usize) -> Stream {
    Stream::new((SEED << 32) | x[at].to_f64() as u64)
}

fn conductor<T: Real>(x: &[T], model: Model) -> MultibounceConductor<T> {
    MultibounceConductor::new(ggx(x), reflectance(), model)
}

fn colour<T: Real>(value: Rgb<T>) -> Vec<T> {
    value.to_array().to_vec()
}

/// What [`stored`] stores.
pub(crate) fn sampled<T: Real>(sample: Option<BsdfSample<T>>) -> Vec<T> {
    let Some(s) = sample else {
        return vec![T::ZERO; 7];
    };
    let transmitted = if s.event == Event::Transmission {
        2.0
    } else {
        0.0
    };
    let specular = if s.specular { 4.0 } else { 0.0 };
    let flags = T::of(1.0 + transmitted + specular);
    let Vec3 { x, y, z } = s.wi;
    vec![flags, x, y, z, s.weight.r, s.weight.b, s.eta]
}

/// Alphas, views, lights, seeds.
fn pairs() -> Vec<[f32; 9]> {
    let views: Vec<[f32; 5]> = product(&ALPHAS, &both_sides());
    let pairs: Vec<[f32; 8]> = product(&views, &self::views(&ABOVE));
    product(&pairs, &[[11.0], [5_000_021.0], [16_000_033.0]])
}

/// Some of them for the models in turn.
fn of_all_models() -> Vec<[f32; 9]> {
    let seven = |(k, mut row): (usize, [f32; 9])| {
        row[8] = f32::from(u8::try_from(k % 7).unwrap_or(0));
        row
    };
    pairs()
        .into_iter()
        .step_by(4)
        .enumerate()
        .map(seven)
        .collect()
}

/// Alphas, views, three random numbers, seeds.
fn sampling_inputs() -> Vec<[f32; 9]> {
    let views: Vec<[f32; 5]> = product(&ALPHAS, &both_sides());
    let points: Vec<[f32; 4]> = (0..32_u16)
        .map(|i| {
            let [a, b] = r2(usize::from(i));
            [r2(usize::from(i) + 70)[0], a, b, f32::from(i) * 1009.0]
        })
        .collect();
    product(&views, &points)
}

/// The same with indices.
fn with_index<const N: usize, const M: usize>(rows: &[[f32; N]]) -> Vec<[f32; M]> {
    product(rows, &ETAS.map(|eta| [eta]))
}

/// Alphas, views, lights on both sides, seeds, indices.
fn glass_pairs() -> Vec<[f32; 10]> {
    let views: Vec<[f32; 5]> = product(&ALPHAS, &both_sides());
    let lights = self::views(&[0.9, 0.2, -0.1, -0.6]);
    let pairs: Vec<[f32; 8]> = product(&views, &lights);
    let pairs: Vec<[f32; 9]> = product(&pairs, &[[7.0]]);
    with_index(&pairs)
}

/// A case of values.
fn value_case(
    name: &'static str,
    modules: &'static [&'static str],
    body: &'static str,
    twin: (Twin<f32>, Twin<f64>),
) -> Case {
    let case = Case::new(name, modules, body, pairs(), twin, BOUND);
    let strays = case.inputs.len() / case.arguments * STRAYS / 1000;
    case.at_scale(&[SCALE]).with_strays(strays)
}

/// The models' values, one case each.
fn values() -> Vec<Case> {
    macro_rules! value {
        ($name:literal, $module:literal, $call:literal, $model:expr) => {
            value_case(
                $name,
                &[$module, "reflectance", "distribution"],
                metal!("let f = ", $call, "; y[0] = f.r; y[1] = f.g; y[2] = f.b;"),
                walks!(|x| {
                    let mut stream = stream(x, 8);
                    colour(conductor(x, $model).estimate(vector(x, 2), vector(x, 5), &mut stream))
                }),
            )
        };
    }
    vec![
        value!(
            "heitz_value",
            "heitz2016",
            "heitz2016_eval(facets, true, wo, wi, &stream)",
            Model::Heitz2016
        ),
        value!(
            "bitterli_value",
            "bitterli2022",
            "bitterli2022_eval(facets, wo, wi, &stream)",
            Model::BitterliDeon2022
        ),
        value!(
            "wang_value",
            "wang2022",
            "wang2022_eval(facets, true, wo, wi, &stream)",
            Model::Wang2022 { correlated: true }
        ),
        value!(
            "wang_uncorrelated_value",
            "wang2022",
            "wang2022_eval(facets, false, wo, wi, &stream)",
            Model::Wang2022 { correlated: false }
        ),
        value!(
            "cui_value",
            "cui2023",
            "cui2023_eval(facets, wo, wi, &stream)",
            Model::Cui2023 {
                bidirectional: false
            }
        ),
        value!(
            "stratified_bidirectional_value",
            "stratified_bidirectional",
            "stratified_bidirectional_eval(facets, wo, wi, &stream)",
            Model::StratifiedBidirectional
        ),
    ]
}

/// Values in other forms.
fn other_values() -> Vec<Case> {
    vec![
        value_case(
            "heitz_as_published_value",
            &["heitz2016", "reflectance", "distribution"],
            metal!(
                "let f = heitz2016_eval(facets, false, wo, wi, &stream);
                 y[0] = f.r; y[1] = f.g; y[2] = f.b;"
            ),
            walks!(|x| {
                let lobe = conductor(x, Model::Heitz2016);
                let mut stream = stream(x, 8);
                colour(lobe.estimate_as_heitz(vector(x, 2), vector(x, 5), &mut stream))
            }),
        ),
        value_case(
            "cui_bidirectional_value",
            &["cui2023", "reflectance", "distribution"],
            metal!(
                "var f = vec3f(0.0);
                 if wo.z > 0.0 { f = cui2023_eval_bidirectional(facets, wo, wi, &stream); }
                 y[0] = f.r; y[1] = f.g; y[2] = f.b;"
            ),
            walks!(|x| {
                if x[4] <= 0.0 {
                    return vec![0.0; 3];
                }
                let model = Model::Cui2023 {
                    bidirectional: true,
                };
                let mut stream = stream(x, 8);
                colour(conductor(x, model).estimate(vector(x, 2), vector(x, 5), &mut stream))
            }),
        ),
    ]
}

/// The models' samples, one case each.
fn samples() -> Vec<Case> {
    let case = |name, modules, body, twin| {
        let case = Case::new(name, modules, body, sampling_inputs(), twin, BOUND);
        let strays = case.inputs.len() / case.arguments * STRAYS / 1000;
        case.at_scale(&[SCALE]).with_strays(strays)
    };
    macro_rules! sample {
        ($name:literal, $module:literal, $call:literal, $model:expr) => {
            case(
                $name,
                &[$module, "reflectance", "distribution"],
                metal!(stored!($call)),
                walks!(|x| {
                    let mut stream = stream(x, 8);
                    let walk =
                        conductor(x, $model).sample_walk(vector(x, 2), [x[6], x[7]], &mut stream);
                    sampled(walk.map(|(wi, weight)| BsdfSample {
                        wi,
                        weight,
                        pdf: 0.0,
                        event: Event::Reflection,
                        specular: false,
                        eta: 1.0,
                    }))
                }),
            )
        };
    }
    vec![
        sample!(
            "heitz_sample",
            "heitz2016",
            "heitz2016_sample(facets, wo, wi.yz, &stream)",
            Model::Heitz2016
        ),
        sample!(
            "wang_sample",
            "wang2022",
            "wang2022_sample(facets, true, wo, wi.yz, &stream)",
            Model::Wang2022 { correlated: true }
        ),
        sample!(
            "wang_uncorrelated_sample",
            "wang2022",
            "wang2022_sample(facets, false, wo, wi.yz, &stream)",
            Model::Wang2022 { correlated: false }
        ),
        sample!(
            "cui_sample",
            "cui2023",
            "cui2023_sample(facets, wo, wi.yz, &stream)",
            Model::Cui2023 {
                bidirectional: false
            }
        ),
        sample!(
            "stratified_bidirectional_sample",
            "stratified_bidirectional",
            "stratified_bidirectional_sample(facets, wo, wi.yz, &stream)",
            Model::StratifiedBidirectional
        ),
    ]
}

/// The lobes' values and samples with their densities.
fn lobes() -> Vec<Case> {
    let walks_of = |name, modules, body, inputs: Vec<[f32; 9]>, twin| {
        let case = Case::new(name, modules, body, inputs, twin, BOUND);
        let strays = case.inputs.len() / case.arguments * STRAYS / 1000;
        case.at_scale(&[SCALE]).with_strays(strays)
    };
    let of_metal: &[&str] = &[
        "multibounce_conductor",
        "mis_pdf",
        "reflectance",
        "distribution",
    ];
    let diffuse: &[&str] = &["multibounce_diffuse", "reflectance", "walk", "distribution"];
    vec![
        walks_of(
            "conductor_value",
            of_metal,
            metal!(
                "let lobe = MultibounceConductor(facets, u32(x[8]) % 7u, MIS_PDF_HAPKE);
                 let value = multibounce_conductor_eval_pdf(lobe, wo, wi, &stream);
                 y[0] = value.r; y[1] = value.g; y[2] = value.b; y[3] = value.a;"
            ),
            of_all_models(),
            walks!(|x| {
                let lobe = conductor(x, of_seed(x[8])).with_mis_pdf(MisPdf::Hapke);
                let (wo, wi, transport) = (vector(x, 2), vector(x, 5), Transport::Radiance);
                let (f, pdf) = lobe.eval_pdf_random(wo, wi, transport, &mut stream(x, 8));
                vec![f.r, f.g, f.b, pdf]
            }),
        ),
        walks_of(
            "conductor_sample",
            of_metal,
            metal!(
                "let lobe = MultibounceConductor(facets, u32(x[8]) % 7u, MIS_PDF_NORMALISED);",
                stored!("multibounce_conductor_sample(lobe, wo, wi, &stream)")
            ),
            sampling_inputs(),
            walks!(|x| {
                let lobe = conductor(x, of_seed(x[8]));
                let u = [x[5], x[6], x[7]];
                let transport = Transport::Radiance;
                sampled(lobe.sample_random(vector(x, 2), u, transport, &mut stream(x, 8)))
            }),
        ),
        walks_of(
            "diffuse_value",
            diffuse,
            metal!(
                "let lobe = MultibounceDiffuse(normals, vec3f(0.9, 0.5, 0.1));
                 let value = multibounce_diffuse_eval_pdf(lobe, wo, wi, &stream);
                 y[0] = value.r; y[1] = value.g; y[2] = value.b; y[3] = value.a;"
            ),
            pairs(),
            walks!(|x| {
                let lobe = MultibounceDiffuse::new(ggx(x), rgb(0.9, 0.5, 0.1));
                let (wo, wi, transport) = (vector(x, 2), vector(x, 5), Transport::Radiance);
                let (f, pdf) = lobe.eval_pdf_random(wo, wi, transport, &mut stream(x, 8));
                vec![f.r, f.g, f.b, pdf]
            }),
        ),
        walks_of(
            "diffuse_sample",
            diffuse,
            metal!(
                "let lobe = MultibounceDiffuse(normals, vec3f(0.9, 0.5, 0.1));",
                stored!("multibounce_diffuse_sample(lobe, wo, wi, &stream)")
            ),
            sampling_inputs(),
            walks!(|x| {
                let lobe = MultibounceDiffuse::new(ggx(x), rgb(0.9, 0.5, 0.1));
                let u = [x[5], x[6], x[7]];
                let transport = Transport::Radiance;
                sampled(lobe.sample_random(vector(x, 2), u, transport, &mut stream(x, 8)))
            }),
        ),
    ]
}

/// A model for a seed.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "seeds are whole numbers"
)]
fn of_seed(seed: f32) -> Model {
    Model::ALL[seed as usize % 7]
}

const GLASS: &[&str] = &[
    "multibounce_dielectric",
    "multibounce_model",
    "mis_pdf",
    "distribution",
    "tints",
];

fn dielectric_lobe<T: Real>(x: &[T], model: Model, mis: MisPdf) -> MultibounceDielectric<T> {
    let lobe = MultibounceDielectric::new(ggx(x), x[9], model);
    lobe.with_mis_pdf(mis).with_tints(tints())
}

/// The factors of [`glass`].
pub(crate) fn tints<T: Real>() -> Tints<T> {
    let tint = |red: f32| rgb(T::of(f64::from(red)), T::ONE, T::ONE);
    Tints {
        reflection: tint(0.9),
        transmission: tint(0.7),
    }
}

/// Dielectrics by both of their models.
fn interfaces() -> Vec<Case> {
    let case = |name, body, inputs: Vec<[f32; 10]>, twin| {
        let case = Case::new(name, GLASS, body, inputs, twin, BOUND);
        let strays = case.inputs.len() / case.arguments * STRAYS / 1000;
        case.at_scale(&[SCALE]).with_strays(strays)
    };
    macro_rules! interface {
        ($name:literal, $sample:literal, $constant:literal, $model:expr) => {
            [
                case(
                    $name,
                    glass!(
                        $constant,
                        "MIS_PDF_NORMALISED",
                        "let f = multibounce_dielectric_eval(lobe, wo, wi, 0u, &stream);
                         y[0] = f.r; y[1] = f.g; y[2] = f.b;"
                    ),
                    glass_pairs(),
                    walks!(|x| {
                        let lobe = dielectric_lobe(x, $model, MisPdf::Normalised);
                        let (wo, wi, transport) = (vector(x, 2), vector(x, 5), Transport::Radiance);
                        colour(lobe.eval_pdf_random(wo, wi, transport, &mut stream(x, 8)).0)
                    }),
                ),
                case(
                    $sample,
                    glass!(
                        $constant,
                        "MIS_PDF_NORMALISED",
                        stored!("multibounce_dielectric_sample(lobe, wo, wi, 1u, &stream)")
                    ),
                    with_index(&sampling_inputs()),
                    walks!(|x| {
                        let lobe = dielectric_lobe(x, $model, MisPdf::Normalised);
                        let u = [x[5], x[6], x[7]];
                        let transport = Transport::Importance;
                        sampled(lobe.sample_random(vector(x, 2), u, transport, &mut stream(x, 8)))
                    }),
                ),
            ]
        };
    }
    let mut cases = interface!(
        "heitz_interface_value",
        "heitz_interface_sample",
        "MULTIBOUNCE_MODEL_HEITZ",
        Model::Heitz2016
    )
    .to_vec();
    cases.extend(interface!(
        "stratified_bidirectional_interface_value",
        "stratified_bidirectional_interface_sample",
        "MULTIBOUNCE_MODEL_STRATIFIED_BIDIRECTIONAL",
        Model::StratifiedBidirectional
    ));
    cases
}

pub(crate) fn cases() -> Vec<Case> {
    let mut cases = values();
    cases.extend(other_values());
    cases.extend(samples());
    cases.extend(lobes());
    cases.extend(interfaces());
    cases.extend(closed());
    cases
}

#[test]
fn closed_forms_hold() {
    prove("multibounce, closed forms", &closed());
}

#[test]
fn walks_of_metals_are_the_twins() {
    let mut cases = values();
    cases.extend(other_values());
    cases.extend(samples());
    cases.extend(lobes());
    prove("multibounce, metals", &cases);
}

#[test]
fn walks_of_dielectrics_are_the_twins() {
    prove("multibounce, dielectrics", &interfaces());
}

#[test]
fn every_function_is_covered() {
    let mut elsewhere = Vec::new();
    for (reason, names) in ELSEWHERE {
        elsewhere.extend(names.split_whitespace().map(|name| (name, *reason)));
    }
    assert_covered("multibounce", &cases(), &elsewhere);
}

#[test]
fn planted_faults_are_caught() {
    catch_some("multibounce", &cases(), FAULTS);
}
