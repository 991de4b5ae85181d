//! Lobes: values, densities and samples.
//!
//! Every lobe has two cases. One holds `eval`, `pdf` and `eval_pdf` at directions about the mirrored and
//! the refracted one, where narrow lobes have their light, and away from them. The other holds its
//! samples: flags, direction, weight and index against the twin, and, on the GPU alone, that density and
//! weight are those of `eval_pdf` at the direction sampled.

mod coats;
mod formats;
mod glass;
mod metals;

use std::collections::{BTreeMap, BTreeSet};

use specula_bsdf::fresnel::{dielectric, refract};
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::vndf::{Sampler, reflect};
use specula_bsdf::{Bsdf, Event, Real, Rgb, Transport, Vec3};
use specula_shaders::{DeclarationKind, MODULES, declarations};

use crate::harness::{
    Case, Fault, Twin, assert_covered, both_sides, catch_some, direction, evaluate, gpu, prove, r2,
    round, vector,
};

/// Statements that begin every body.
macro_rules! arguments {
    ($($rest:expr),*) => {
        concat!(
            "let wo = vec3f(x[0], x[1], x[2]);
             let wi = vec3f(x[3], x[4], x[5]);
             let u = wi;
             let transport = u32(x[6]);
             ",
            $($rest),*
        )
    };
}
pub(crate) use arguments;

/// The two cases of a lobe.
///
/// * `make`: statements that declare `lobe`, from `x[7]` on; `twin`: `fn(&[T]) -> impl Bsdf<T>` of the same
///   values from 0 on; `inputs`: those of values and of samples; `bounds`, in ulps; `floor`, the
///   least value whose ulps are counted.
macro_rules! lobe_cases {
    ($name:literal, $module:literal, $make:expr, $twin:ident, $inputs:expr, $bounds:expr, $floor:expr) => {{
        let values = $crate::bsdf::arguments!(
            $make,
            "let value = ",
            $module,
            "_eval_pdf(lobe, wo, wi, transport);
             y[0] = value.r; y[1] = value.g; y[2] = value.b; y[3] = value.a;
             y[4] = ",
            $module,
            "_pdf(lobe, wo, wi);
             y[5] = ",
            $module,
            "_eval(lobe, wo, wi, transport).g;"
        );
        let samples = $crate::bsdf::arguments!(
            $make,
            "let sampled = ",
            $module,
            "_sample(lobe, wo, u, transport);
             y[0] = f32(sampled.flags);
             if sampled.flags != 0u {
                 y[1] = sampled.wi.x; y[2] = sampled.wi.y; y[3] = sampled.wi.z;
                 y[4] = sampled.weight.r; y[5] = sampled.weight.g; y[6] = sampled.weight.b;
                 y[7] = sampled.eta; y[8] = sampled.pdf;
             }
             if sampled.flags != 0u && (sampled.flags & BSDF_SAMPLE_SPECULAR) == 0u {
                 let value = ",
            $module,
            "_eval_pdf(lobe, wo, sampled.wi, transport);
                 let largest = max(max(value.r, value.g), max(value.b, 1e-30));
                 let missing = abs(sampled.weight * value.a - value.rgb) / largest;
                 y[8] = sampled.pdf / value.a - 1.0;
                 y[9] = max(max(missing.r, missing.g), missing.b);
             }"
        );
        $crate::bsdf::pair(
            [concat!($name, "_values"), concat!($name, "_samples")],
            &[$module, "bsdf_sample"],
            [values, samples],
            [
                $crate::harness::twins!(|x| $crate::bsdf::values(&$twin(&x[7..]), x)),
                $crate::harness::twins!(|x| $crate::bsdf::sampled(&$twin(&x[7..]), x)),
            ],
            $inputs,
            $bounds,
            $floor,
        )
    }};
}
pub(crate) use lobe_cases;

/// The two cases of a lobe; see [`lobe_cases`].
pub(crate) fn pair(
    names: [&'static str; 2],
    modules: &'static [&'static str],
    media: [&'static str; 2],
    twins: [(Twin<f32>, Twin<f64>); 2],
    inputs: [Vec<Vec<f32>>; 2],
    bounds: [f64; 2],
    floor: &'static [f64],
) -> [Case; 2] {
    let [values, samples] = inputs;
    let one = |k: usize, inputs: &[Vec<f32>], scale| Case {
        name: names[k],
        modules,
        body: media[k],
        arguments: inputs[0].len(),
        inputs: inputs.concat(),
        single: twins[k].0,
        double: twins[k].1,
        bound: bounds[k],
        scale,
        strays: 0,
    };
    [one(0, &values, floor), one(1, &samples, &[1.0])]
}

/// `eval_pdf`, `pdf` and the green of `eval`.
pub(crate) fn values<T: Real>(lobe: &impl Bsdf<T>, x: &[T]) -> Vec<T> {
    let (wo, wi) = (vector(x, 0), vector(x, 3));
    let transport = transport(x[6]);
    let (f, pdf) = lobe.eval_pdf(wo, wi, transport);
    let other = lobe.eval(wo, wi, transport);
    vec![f.r, f.g, f.b, pdf, lobe.pdf(wo, wi), other.g]
}

/// Flags, direction, weight, index, and the probability where it is specular; zeros where the sample
/// failed.
pub(crate) fn sampled<T: Real>(lobe: &impl Bsdf<T>, x: &[T]) -> Vec<T> {
    let u = [x[3], x[4], x[5]];
    let Some(s) = lobe.sample(vector(x, 0), u, transport(x[6])) else {
        return vec![T::ZERO; 10];
    };
    let transmits = s.event == Event::Transmission;
    let flags = 1 + 2 * i32::from(transmits) + 4 * i32::from(s.specular);
    let probability = T::select(s.specular, s.pdf, T::ZERO);
    let mut y = vec![T::of(f64::from(flags)), s.wi.x, s.wi.y, s.wi.z];
    y.extend([
        s.weight.r,
        s.weight.g,
        s.weight.b,
        s.eta,
        probability,
        T::ZERO,
    ]);
    y
}

/// The transport of a code.
fn transport<T: Real>(x: T) -> Transport {
    if x > T::ZERO {
        Transport::Importance
    } else {
        Transport::Radiance
    }
}

/// The colour of three `f32`.
pub(crate) fn colour<T: Real>(channels: [f32; 3]) -> Rgb<T> {
    let [r, g, b] = channels.map(|v| T::of(f64::from(v)));
    rgb(r, g, b)
}

/// The sampler of a code.
pub(crate) fn sampler<T: Real>(x: T) -> Sampler {
    let all = [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ];
    let which = all
        .iter()
        .enumerate()
        .find(|(i, _)| T::of(f64::from(u8::try_from(*i).unwrap_or(0))) == x);
    which.map_or(Sampler::Exact, |(_, sampler)| *sampler)
}

/// Directions about the one that a facet of the width sends `wo` to, reflected and, with an index,
/// refracted; and two others.
fn lights(alpha: [f32; 2], eta: Option<f32>, wo: [f32; 3]) -> Vec<[f32; 3]> {
    let [x, y, z] = wo.map(f64::from);
    let up = vec3(x, y, z.abs());
    let turn = if eta.is_some() { z.signum() } else { 1.0 };
    let seen = if eta.is_some() { up } else { vec3(x, y, z) };
    let mut all = vec![direction(0.6, 4.0), direction(-0.4, 1.0)];
    for (i, slope) in [0.3, 1.2, 4.0].into_iter().enumerate() {
        let azimuth = 1.0 + 2.2 * f64::from(u8::try_from(i).unwrap_or(0));
        let [ax, ay] = alpha.map(f64::from);
        let slopes = [slope * ax * azimuth.cos(), slope * ay * azimuth.sin()];
        let wm = vec3(-slopes[0], -slopes[1], 1.0).normalize();
        let cos_o = seen.dot(wm);
        if cos_o <= 0.0 {
            continue;
        }
        let mut push = |w: Vec3<f64>| {
            let w = w.normalize();
            all.push([w.x, w.y, w.z * turn].map(round));
        };
        push(reflect(seen, wm));
        if let Some(eta) = eta.map(f64::from) {
            let eta = if z < 0.0 { 1.0 / eta } else { eta };
            let bent = dielectric(cos_o, eta);
            if bent.cos_t > 0.0 {
                push(refract(seen, wm, cos_o, bent.cos_t, eta));
            }
        }
    }
    all
}

/// Rows of arguments for values and for samples.
///
/// * `parameters`: of the lobe; `facets`: alphas and, where light is refracted, the index of a row of them.
pub(crate) fn rows<const N: usize>(
    parameters: &[[f32; N]],
    facets: impl Fn(&[f32; N]) -> ([f32; 2], Option<f32>),
    is_beckmann: impl Fn(&[f32; N]) -> bool,
) -> [Vec<Vec<f32>>; 2] {
    let mut inputs = [Vec::new(), Vec::new()];
    for (i, p) in parameters.iter().enumerate() {
        let (alpha, eta) = facets(p);
        let mode = if i % 3 == 1 { 1.0 } else { 0.0 };
        let row = |wo: [f32; 3], other: [f32; 3]| [&wo[..], &other[..], &[mode], &p[..]].concat();
        // In f32 Beckmann's area seen from deep below is lost to cancellation.
        let lowest = if is_beckmann(p) { -0.1 } else { -1.0 };
        let views = both_sides().into_iter().filter(|wo| wo[2] > lowest);
        for (k, wo) in views.enumerate() {
            inputs[0].extend(lights(alpha, eta, wo).into_iter().map(|wi| row(wo, wi)));
            inputs[1].extend((0..4).map(|n| {
                let place = 64 * i + 4 * k + n;
                let [first, _] = r2(7 * place + 3);
                let [second, third] = r2(place);
                row(wo, [first, second, third])
            }));
        }
    }
    inputs
}

pub(crate) fn cases() -> Vec<Case> {
    [
        metals::cases(),
        glass::cases(),
        coats::cases(),
        formats::cases(),
    ]
    .concat()
}

#[test]
fn metals_hold() {
    prove("metals and diffuse surfaces", &metals::cases());
}

#[test]
fn glass_holds() {
    prove("dielectrics", &glass::cases());
}

#[test]
fn coats_hold() {
    prove("coats", &coats::cases());
}

#[test]
fn formats_hold() {
    prove("materials of formats", &formats::cases());
}

/// Names in a text, of functions and of others.
pub(crate) fn names(text: &str) -> BTreeSet<&str> {
    text.split(|c: char| c != '_' && !c.is_alphanumeric())
        .collect()
}

/// Functions that cases call, and functions that those call.
pub(crate) fn reached(cases: &[Case]) -> BTreeSet<&'static str> {
    let functions: BTreeMap<&str, &str> = MODULES
        .iter()
        .flat_map(|module| module.text.split("\nfn ").skip(1))
        .filter_map(|text| Some((text.split_once('(')?.0, text.split_once("\n}")?.0)))
        .collect();
    let mut found: BTreeSet<&str> = BTreeSet::new();
    let mut texts: Vec<&str> = cases.iter().map(|case| case.body).collect();
    while let Some(text) = texts.pop() {
        for name in names(text) {
            if let Some((name, text)) = functions.get_key_value(name)
                && found.insert(name)
            {
                texts.push(text);
            }
        }
    }
    found
}

#[test]
fn every_function_is_covered() {
    let cases = cases();
    let called: BTreeSet<&str> = cases.iter().flat_map(|case| names(case.body)).collect();
    let steps = reached(&cases);
    let modules = MODULES.iter().filter(|m| m.folder() == "bsdf");
    let elsewhere: Vec<(&str, &str)> = modules
        .flat_map(|m| declarations(m.text))
        .filter(|d| d.kind == DeclarationKind::Function && !called.contains(d.name))
        .filter(|d| steps.contains(d.name))
        .map(|d| (d.name, "a step of a lobe"))
        .collect();
    assert_covered("bsdf", &cases, &elsewhere);
}

#[test]
fn wrong_terms_are_caught() {
    catch_some("bsdf", &cases(), &faults());
}

/// One wrong term for each family of lobes, and more for those with many: case, module, what is there and
/// what stands there instead.
#[rustfmt::skip]
const FAULTS: [[&str; 4]; 29] = [
    ["rough_conductor_values", "rough_conductor", "let quarter = 0.25 * facet.x", "let quarter = 0.2501 * facet.x"],
    ["rough_conductor_samples", "rough_conductor", "norm * norm * quotient.x", "norm * quotient.x"],
    ["smooth_conductor_samples", "smooth_conductor", "vec3f(-wo.x, -wo.y", "vec3f(-wo.x, wo.y"],
    ["lambert_values", "lambert", "lobe.albedo * pdf, pdf", "lobe.albedo * pdf, 1.00001 * pdf"],
    ["eon_values", "eon", "0.28779340921080643", "0.2878"],
    ["diffuse_transmission_values", "diffuse_transmission", "select(1.0 - p, p", "select(p, p"],
    ["compensated_values", "compensated", "lobe.colour * shape", "lobe.average * shape"],
    ["compensated_samples", "compensated", "max(1.0 - loss, 1e-5)", "max(1.01 - loss, 1e-5)"],
    ["kulla_conty_values", "kulla_conty", "+ lobe.colour * shape", "+ lobe.average * shape"],
    ["kulla_conty_samples", "kulla_conty", "u.x < share", "u.x > share"],
    ["rough_dielectric_values", "rough_dielectric", "cos_o * abs(cos_i) * inverse_squared", "cos_o * inverse_squared"],
    ["rough_dielectric_samples", "rough_dielectric", "select(1.0, side.inverse_eta * side.inverse_eta", "select(1.0, side.inverse_eta"],
    ["rough_dielectric_values", "tints", "tints.transmission, tints.reflection", "tints.reflection, tints.transmission"],
    ["rough_conductor_values", "microfacets", "return masking_divided(", "return 1.001 * masking_divided("],
    ["smooth_dielectric_samples", "smooth_dielectric", "select(lobe.eta, 1.0 / lobe.eta", "select(lobe.eta, lobe.eta"],
    ["thin_dielectric_samples", "thin_dielectric", "2.0 * single / (1.0 + single)", "2.0 * single / (1.001 + single)"],
    ["compensated_dielectric_values", "compensated_dielectric", "== reflects", "!= reflects"],
    ["coated_diffuse_values", "coated_diffuse", "power *= square", "power *= q"],
    ["plastic_values", "plastic", "back * internal", "internal"],
    ["plastic_values", "plastic_interface", "0.7099 - 1.4399", "0.7099 - 1.4499"],
    ["principled_solid_values", "principled_solid", "front * 0.25 *", "front * 0.26 *"],
    ["principled_solid_values", "principled_terms", "1.25 *", "1.26 *"],
    ["principled_solid_values", "principled_coat", "0.0625", "0.0725"],
    ["principled_thin_values", "principled_thin", "0.65 * p.eta", "0.651 * p.eta"],
    ["principled_thin_values", "principled_parameters", "clamp(p.diff_trans, 0.0, 2.0)", "clamp(p.diff_trans, 0.0, 0.9)"],
    ["gltf_values", "gltf", "lobe.clearcoat * (0.04 + 0.96", "lobe.clearcoat * (0.04 + 0.95"],
    ["gltf_values", "gltf", "lobe.base * (lost / max(1.0 - lost", "lobe.base * (lost / max(1.001 - lost"],
    ["gltf_values", "gltf_sheen", "3.82987 + (3", "3.83987 + (3"],
    ["gltf_values", "gltf_albedo", "0.086456", "0.096456"],
];

/// The faults with the paths of their modules.
pub(crate) fn faults() -> Vec<Fault> {
    let paths = MODULES.iter().map(|m| (m.name(), m.path));
    let paths: BTreeMap<&str, &'static str> = paths.collect();
    let fault = |[case, module, from, to]: [&'static str; 4]| Fault {
        case,
        module: paths[module],
        from,
        to,
    };
    FAULTS.into_iter().map(fault).collect()
}

/// Samples of each view of a furnace.
const SAMPLES: u16 = 8192;

/// Arguments of the samples of one view: `wo`, `u`, alphas and model.
fn furnace_samples(cosine: f64, [x, y]: [f32; 2], model: f32) -> impl Iterator<Item = [f32; 9]> {
    let [a, b, c] = direction(cosine, 0.4);
    (0..usize::from(SAMPLES)).map(move |i| {
        let ([second, third], [first, _]) = (r2(i), r2(7 * i + 3));
        [a, b, c, first, second, third, x, y, model]
    })
}

/// The mean and its standard error.
fn mean(weights: &[f32]) -> [f64; 2] {
    let sum = |of: fn(f64) -> f64| weights.iter().map(|&w| of(f64::from(w))).sum::<f64>();
    let count = f64::from(SAMPLES);
    let mean = sum(|w| w) / count;
    let variance = sum(|w| w * w) / count - mean * mean;
    [mean, (variance.max(0.0) / count).sqrt()]
}

#[test]
fn white_metal_keeps_all_light() {
    let Some(gpu) = gpu("the furnace of compensated metal") else {
        return;
    };
    let mut views = Vec::new();
    for alpha in [[0.3, 0.3], [0.2, 0.8], [1.0, 1.0]] {
        for model in [0.0, 1.0, 2.0] {
            views.extend([1.0, 0.7, 0.3, 0.05].map(|cosine| (cosine, alpha, model)));
        }
    }
    let samples = |&(cosine, alpha, model): &_| furnace_samples(cosine, alpha, model);
    let inputs: Vec<[f32; 9]> = views.iter().flat_map(samples).collect();
    let body = "let facets = MicrofacetsModel(vec2f(x[6], x[7]), DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER_EXACT);
         let lobe = compensated_new(facets, reflectance_constant(vec3f(1.0)), u32(x[8]));
         let sampled = compensated_sample(lobe, vec3f(x[0], x[1], x[2]), vec3f(x[3], x[4], x[5]), 0u);
         y[0] = select(0.0, sampled.weight.g, sampled.flags != 0u);";
    let weights = evaluate(gpu, &["compensated"], body, &inputs, 1);
    let mut worst = 0.0_f64;
    for (view, weights) in views.iter().zip(weights.chunks(usize::from(SAMPLES))) {
        let [mean, error] = mean(weights);
        let missing = (mean - 1.0).abs();
        worst = worst.max(missing);
        assert!(
            missing < 4.0 * error + 1e-3,
            "(cosine, alpha, model) {view:?}: {mean} +- {error}"
        );
    }
    let count = views.len();
    println!("furnace of compensated metal: {count} views, largest difference to 1: {worst:.1e}");
}
