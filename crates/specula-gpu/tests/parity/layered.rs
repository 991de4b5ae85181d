//! Coats over metal and Lambert by random walks: values and samples beside the twin in `f32` with the same
//! stream, densities and mirrors beside that in `f64`, and means against the twin in `f64`.

use specula_bsdf::bsdf::{Base, Layered, Medium};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::rgb;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Real, Rgb, Transport};

use crate::harness::{
    Case, Fault, Twin, assert_covered, catch_some, direction, fault, product, prove, r2, round,
    twins, vector,
};
use crate::multibounce::means::{compare, held, summed};
use crate::multibounce::{ggx, sampled, stored, stream, walks};

/// Modules of the media.
const MODULES: &[&str] = &[
    "layered",
    "reflectance",
    "distribution",
    "masking",
    "reflection",
    "stream",
];
/// Events of a walk that is held against its twin. Each bounce off metal multiplies what rounding has
/// moved, by two and more: of walks of 30 events 4 in 1000 end elsewhere, of these 1 to 5, whichever way the
/// samplers round (allowed: 8).
const EVENTS: u32 = 12;
/// Bound of the walks in ulps of 0.01 or more: 2.4e-4 of larger values.
const BOUND: f64 = 2000.0;

/// Statements that make the arguments: alphas of the coat, view, light (or three values), seed, kind of
/// base, whether the coat is rough, thickness and brightness of the medium.
macro_rules! coat {
    ($($body:tt)*) => {
        concat!(
            "let wo = vec3f(x[2], x[3], x[4]);
             let wi = vec3f(x[5], x[6], x[7]);
             var stream = stream_new(vec2u(u32(x[8]), 0x5eedu));
             let metal = MicrofacetsModel(vec2f(0.2, 0.3), DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, SAMPLER_EXACT);
             let silver = reflectance_conductor(vec3f(0.2, 0.9, 1.1), vec3f(3.9, 2.4, 2.1));
             let base = LayeredBase(u32(x[9]), metal, silver, vec3f(0.8, 0.5, 0.2));
             let medium = LayeredMedium(x[11], vec3f(0.9, 0.5, 0.3) * x[12], 0.4);
             var lobe = layered_new(vec2f(x[0], x[1]), x[10] > 0.5, 1.5, base, medium, SAMPLER_EXACT);
             lobe.max_depth = 12u;
             ",
            $($body)*
        )
    };
}

/// The lobe of [`coat`].
fn lobe<T: Real>(x: &[T]) -> Layered<T> {
    let of = |v: f32| T::of(f64::from(v));
    let colour = |r, g, b| rgb(of(r), of(g), of(b));
    let silver = Reflectance::Conductor(Conductor {
        eta: colour(0.2, 0.9, 1.1),
        k: colour(3.9, 2.4, 2.1),
    });
    let metal = Ggx::new(Alpha {
        x: of(0.2),
        y: of(0.3),
    });
    let base = match x[9].to_f64() {
        k if k < 0.5 => Base::metal(None, silver),
        k if k < 1.5 => Base::metal(Some(metal), silver),
        _ => Base::diffuse(colour(0.8, 0.5, 0.2)),
    };
    let coat = (x[10] > T::HALF).then(|| ggx(x));
    let medium = Medium {
        thickness: x[11],
        albedo: colour(0.9, 0.5, 0.3) * x[12],
        g: of(0.4),
    };
    Layered::new(coat, of(1.5), base)
        .with_medium(medium)
        .with_max_depth(EVENTS)
}

/// Kinds of base, coats, media.
fn configurations() -> Vec<[f32; 4]> {
    let kinds: Vec<[f32; 2]> = product(&[[0.0], [1.0], [2.0]], &[[0.0], [1.0]]);
    product(&kinds, &[[0.0, 0.0], [0.3, 0.0], [0.5, 1.0]])
}

/// Everything with everything; `last` are lights and seeds, or values and seeds.
fn rows(last: &[[f32; 4]]) -> Vec<[f32; 13]> {
    let views = [0.9, 0.3, -0.3].map(|cosine| direction(cosine, 0.4));
    let views: Vec<[f32; 5]> = product(&[[0.1, 0.1], [0.4, 0.8]], &views);
    let pairs: Vec<[f32; 9]> = product(&views, last);
    let mut rows: Vec<[f32; 13]> = product(&pairs, &configurations());
    for (k, row) in (0_u16..).zip(&mut rows) {
        row[8] += f32::from(k);
    }
    rows
}

fn pairs(seeds: &[[f32; 1]]) -> Vec<[f32; 13]> {
    let lights = [
        direction(0.7, 2.0),
        direction(0.8, 3.4),
        direction(0.1, 0.4),
    ];
    let lit: Vec<[f32; 4]> = product(&lights, seeds);
    rows(&lit)
}

fn sampling_inputs() -> Vec<[f32; 13]> {
    let points = (0..24_u16).map(|i| {
        let [a, b] = r2(usize::from(i));
        [r2(usize::from(i) + 70)[0], a, b, f32::from(i) * 1009.0]
    });
    rows(&points.collect::<Vec<_>>())
}

fn colour<T: Real>(value: Rgb<T>) -> Vec<T> {
    value.to_array().to_vec()
}

pub(crate) fn cases() -> Vec<Case> {
    let walk = |name, body, inputs: Vec<[f32; 13]>, twin| {
        // Walks part where rounding decides otherwise: by lavapipe 2 of a thousand, by SwiftShader 3.
        let strays = (8 * inputs.len()).div_ceil(1000);
        let case = Case::new(name, MODULES, body, inputs, twin, BOUND);
        case.at_scale(&[0.01]).with_strays(strays)
    };
    vec![
        walk(
            "layered_value",
            coat!(
                "let f = layered_eval(lobe, wo, wi, &stream); y[0] = f.r; y[1] = f.g; y[2] = f.b;"
            ),
            pairs(&[[0.0], [70_001.0], [9_000_011.0]]),
            walks!(|x| {
                let (wo, wi, transport) = (vector(x, 2), vector(x, 5), Transport::Radiance);
                colour(
                    lobe(x)
                        .eval_pdf_random(wo, wi, transport, &mut stream(x, 8))
                        .0,
                )
            }),
        ),
        walk(
            "layered_value_of_three",
            coat!(
                "lobe.walks = 3u; lobe.max_depth = 6u;
                 let value = layered_eval_pdf(lobe, wo, wi, &stream);
                 y[0] = value.r; y[1] = value.g; y[2] = value.b; y[3] = value.a;"
            ),
            pairs(&[[5.0]]),
            walks!(|x| {
                let (wo, wi, transport) = (vector(x, 2), vector(x, 5), Transport::Radiance);
                let lobe = lobe(x).with_walks(3).with_max_depth(6);
                let (f, pdf) = lobe.eval_pdf_random(wo, wi, transport, &mut stream(x, 8));
                vec![f.r, f.g, f.b, pdf]
            }),
        )
        .with_strays(3),
        walk(
            "layered_sample",
            coat!(stored!("layered_sample(lobe, wo, wi, &stream)")),
            sampling_inputs(),
            walks!(|x| {
                let (wo, u, transport) = (vector(x, 2), [x[5], x[6], x[7]], Transport::Radiance);
                sampled(lobe(x).sample_random(wo, u, transport, &mut stream(x, 8)))
            }),
        ),
        Case::new(
            "layered_density",
            MODULES,
            coat!("y[0] = layered_pdf(lobe, wo, wi); y[1] = layered_albedo(lobe).g;"),
            pairs(&[[0.0]]),
            twins!(|x| {
                let lobe = lobe(x);
                vec![lobe.pdf(vector(x, 2), vector(x, 5)), lobe.albedo().g]
            }),
            64.0,
        ),
        Case::new(
            "layered_phase",
            MODULES,
            "let medium = LayeredMedium(1.0, vec3f(0.5), x[0]);
             y[0] = layered_medium_phase(medium, x[1]);
             y[1] = layered_medium_transmittance(x[2], vec3f(0.0, 0.0, x[1]));",
            product::<1, 2, 3>(
                &[-0.9, -0.2, 0.0, 0.5, 0.95].map(|g| [g]),
                &[[-1.0, 0.1], [-0.3, 2.0], [0.2, 0.01], [1.0, 1.0]],
            ),
            twins!(|x| {
                let (g, cos) = (x[0], x[1]);
                let base = T::ONE + g * g - T::TWO * g * cos;
                let phase = (T::ONE - g * g) * T::of(0.25) * T::INV_PI / (base * base.sqrt());
                vec![phase, (-x[2] / cos.abs()).exp()]
            }),
            1000.0, // 1 + g^2 - 2 g cos cancels.
        ),
    ]
}

/// Functions that no body names, with the cases that run them.
const ELSEWHERE: &[(&str, &str)] = &[
    (
        "layered_value",
        "layered_base_is_mirror layered_base_eval_pdf layered_base_sample layered_base_reflectance
         layered_coat_rough layered_coat_reflection layered_coat_below layered_coat_enter
         layered_coat_bounce layered_coat_passes layered_connect_ways layered_connect_share
         layered_connect_at_base layered_connect_sampled_from_light layered_connect_at_particle
         layered_connect_balance layered_connect_arriving layered_connect_back
         layered_lobe_is_mirror layered_lobe_is_base_narrow layered_lobe_echoes
         layered_lobe_series layered_lobe_log layered_medium_scatters
         layered_medium_depth_of_collision layered_medium_turned layered_walk_land
         layered_walk_survives layered_walk_eval",
    ),
    (
        "layered_sample",
        "layered_coat_scatter_above layered_coat_scatter_below layered_lobe_mirrored
         layered_walk_sample",
    ),
    (
        "layered_density",
        "layered_density_pdf layered_density_blurred layered_density_scattered layered_density_coat
         layered_density_quarter",
    ),
];

/// One for every module.
pub(crate) const FAULTS: &[Fault] = &[
    fault(
        "layered_value",
        "bsdf/layered/layered",
        "let share = 1.0 / f32(lobe.walks);",
        "let share = 1.001 / f32(lobe.walks);",
    ),
    fault(
        "layered_value",
        "bsdf/layered/layered_base",
        "base.kind == LAYERED_BASE_MIRROR;",
        "base.kind == LAYERED_BASE_DIFFUSE;",
    ),
    fault(
        "layered_sample",
        "bsdf/layered/layered_coat",
        "u.x < bent.reflectance",
        "u.x < 2.0 * bent.reflectance",
    ),
    fault(
        "layered_value",
        "bsdf/layered/layered_connect",
        "select(first * from_wi, 0.0, mirror)",
        "select(1.01 * first * from_wi, 0.0, mirror)",
    ),
    fault(
        "layered_density",
        "bsdf/layered/layered_density",
        "clamp(rough * 0.5, 0.02, 0.3)",
        "clamp(rough * 0.501, 0.02, 0.3)",
    ),
    fault(
        "layered_density",
        "bsdf/layered/layered_density",
        "0.5 * bend * bend",
        "0.51 * bend * bend",
    ),
    fault(
        "layered_value",
        "bsdf/layered/layered_lobe",
        "(events + 1u) / 2u",
        "events / 2u",
    ),
    fault(
        "layered_phase",
        "bsdf/layered/layered_medium",
        "* 0.25 * 0.31830987",
        "* 0.25 * 0.3184",
    ),
    fault(
        "layered_value",
        "bsdf/layered/layered_walk",
        "ROULETTE_BELOW: f32 = 0.25;",
        "ROULETTE_BELOW: f32 = 0.26;",
    ),
];

#[test]
fn cases_hold() {
    prove("layered", &cases());
}

#[test]
fn every_function_is_covered() {
    let mut elsewhere = Vec::new();
    for (reason, names) in ELSEWHERE {
        elsewhere.extend(names.split_whitespace().map(|name| (name, *reason)));
    }
    assert_covered("bsdf/layered", &cases(), &elsewhere);
}

#[test]
fn planted_faults_are_caught() {
    catch_some("layered", &cases(), FAULTS);
}

#[test]
fn values_and_samples_have_the_means_of_the_twins() {
    const VALUE: &str = coat!(
        "lobe.max_depth = 40u;",
        summed!("let value = layered_eval(lobe, wo, wi, &stream);")
    );
    const SAMPLE: &str = coat!(
        "lobe.max_depth = 40u;",
        summed!(
            "let u_lobe = stream_next(&stream);
         let other = stream_next(&stream);
         let sampled = layered_sample(lobe, wo, vec3f(u_lobe, other, stream_next(&stream)), &stream);
         var value = vec3f(0.0);
         if sampled.flags != 0u { value = sampled.weight.r * vec3f(1.0, sampled.wi.x, sampled.wi.z); }"
        )
    );
    // Some of each configuration; a mirror has no values.
    let is_mirror = |x: &[f32; 13]| x[9] < 0.5 && x[10] < 0.5 && x[12] < 0.5;
    let all = pairs(&[[0.0]]).into_iter().filter(|x| !is_mirror(x));
    let some: Vec<[f32; 13]> = all.step_by(11).collect();
    let mut report = held(compare(
        "layered values",
        MODULES,
        VALUE,
        &some,
        |x, stream| {
            let (wo, wi) = (vector(x, 2), vector(x, 5));
            let value =
                lobe(x)
                    .with_max_depth(40)
                    .eval_pdf_random(wo, wi, Transport::Radiance, stream);
            value.0.to_array()
        },
    ));
    report += &held(compare(
        "layered samples",
        MODULES,
        SAMPLE,
        &some,
        |x, stream| {
            let u = [stream.next(), stream.next(), stream.next()];
            let sampled = lobe(x).with_max_depth(40).sample_random(
                vector(x, 2),
                u,
                Transport::Radiance,
                stream,
            );
            sampled.map_or([0.0; 3], |s| {
                [s.weight.r, s.weight.r * s.wi.x, s.weight.r * s.wi.z]
            })
        },
    ));
    println!("means of layered\n{report}");
}
