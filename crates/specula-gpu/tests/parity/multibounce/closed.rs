//! Closed forms of the walks: no values are sampled, and the reference is the twin in `f64`.

use specula_bsdf::fresnel::{dielectric, refract};
use specula_bsdf::internal::{DepthState, normalised_pdf, sample_normalised};
use specula_bsdf::math::Stream;
use specula_bsdf::multibounce::{MisPdf, MultibounceModel as Model};
use specula_bsdf::ndf::{Beckmann, Ggx, Ndf};
use specula_bsdf::vndf::VisibleNormals;
use specula_bsdf::{Bsdf, Real, Vec3};

use super::{
    GLASS, conductor, dielectric_lobe, ggx, glass, glass_pairs, metal, pairs, reflectance,
    sampling_inputs, stream, walks, with_index,
};
use crate::harness::{Case, Twin, alpha, product, round, twins, vector};

/// Every case of this file.
pub(super) fn closed() -> Vec<Case> {
    let mut cases = densities();
    cases.extend(normalised());
    cases.extend(flights());
    cases.extend(depths());
    cases.extend(sides());
    cases
}

fn densities() -> Vec<Case> {
    let modules: &[&str] = &["mis_pdf", "reflectance", "distribution"];
    let interface: &[&str] = GLASS;
    macro_rules! density {
        ($name:literal, $constant:literal, $mis:expr) => {
            Case::new(
                $name,
                modules,
                metal!(
                    "y[0] = mis_pdf_reflection(",
                    $constant,
                    ", normals, wo, wi);"
                ),
                pairs(),
                twins!(|x| {
                    let lobe = conductor(x, Model::StratifiedBidirectional).with_mis_pdf($mis);
                    vec![lobe.pdf(vector(x, 2), vector(x, 5))]
                }),
                256.0,
            )
            .at_scale(&[1e-3])
        };
    }
    macro_rules! interface_density {
        ($name:literal, $constant:literal, $mis:expr) => {
            Case::new(
                $name,
                interface,
                glass!(
                    "MULTIBOUNCE_MODEL_STRATIFIED_BIDIRECTIONAL",
                    $constant,
                    "y[0] = multibounce_dielectric_pdf(lobe, wo, wi);"
                ),
                glass_pairs(),
                twins!(|x| {
                    let lobe = dielectric_lobe(x, Model::StratifiedBidirectional, $mis);
                    vec![lobe.pdf(vector(x, 2), vector(x, 5))]
                }),
                128.0,
            )
        };
    }
    vec![
        density!("mis_lambert", "MIS_PDF_LAMBERT", MisPdf::Lambert),
        density!("mis_hapke", "MIS_PDF_HAPKE", MisPdf::Hapke),
        // The flight of a lobe's point is a difference of nearly equal vectors for some views from below at alpha 10.
        Case {
            bound: 8192.0,
            ..density!("mis_normalised", "MIS_PDF_NORMALISED", MisPdf::Normalised)
        }
        .with_strays(60),
        interface_density!("interface_lambert", "MIS_PDF_LAMBERT", MisPdf::Lambert),
        interface_density!(
            "interface_normalised",
            "MIS_PDF_NORMALISED",
            MisPdf::Normalised
        ),
    ]
}

fn normalised() -> Vec<Case> {
    let modules: &[&str] = &["mis_pdf", "reflectance", "distribution"];
    vec![
        Case::new(
            "normalised_of_beckmann",
            modules,
            "let normals = NormalsModel(vec2f(x[0], x[1]), DISTRIBUTION_BECKMANN);
             y[0] = normalised_pdf(normals, vec3f(x[2], x[3], x[4]), vec3f(x[5], x[6], x[7]));",
            pairs(),
            twins!(|x| {
                let ndf = Beckmann::new(alpha(x, 0));
                vec![normalised_pdf(&ndf, vector(x, 2), vector(x, 5))]
            }),
            16384.0, // Its roots are found in f32.
        )
        .with_strays(60),
        Case::new(
            "normalised_directions",
            modules,
            metal!(
                "let sampled = normalised_sample_direction(normals, wo, wi.yzx);
                 if sampled.z > 0.0 { y[0] = sampled.x; y[1] = sampled.y; y[2] = sampled.z; }"
            ),
            sampling_inputs(),
            twins!(|x| {
                let sampled = sample_normalised(&ggx(x), vector(x, 2), [x[6], x[7], x[5]]);
                sampled.map_or(vec![T::ZERO; 3], |w| w.to_array().to_vec())
            }),
            4096.0, // A height next to 1 has its sine by a root.
        )
        .at_scale(&[1.0])
        .with_strays(3),
    ]
}

/// `sigma(-d)`, `sigma(d)` and `|Lambda(d)|`: what a flight knows.
fn flight<T: Real>(ndf: &Ggx<T>, d: Vec3<T>) -> [T; 3] {
    let below = ndf.lambda_cos(d).at_least(T::of(1e-24));
    let facing = below + (-d.z).at_least(T::ZERO);
    let backing = below + d.z.at_least(T::ZERO);
    [facing, backing, facing / d.z.abs().at_least(T::of(1e-12))]
}

/// `D / 4` of the facet that turns `d` to `wi`, and the cosine on it.
fn turn<T: Real>(ndf: &Ggx<T>, d: Vec3<T>, wi: Vec3<T>) -> [T; 2] {
    let between = wi - d;
    if between.z <= T::ZERO {
        return [T::ZERO; 2];
    }
    let wm = between.normalize();
    [wi.dot(wm), T::of(0.25) * ndf.d(wm)]
}

fn flights() -> Vec<Case> {
    let modules: &[&str] = &["walk", "reflectance", "distribution"];
    vec![
        Case::new(
            "flights",
            modules,
            metal!(
                "let flight = walk_flight(normals, wo);
                 let back = walk_reversed(flight);
                 let arriving = walk_arriving(facets, wo);
                 y[0] = flight.facing; y[1] = flight.backing; y[2] = flight.rate;
                 y[3] = back.facing; y[4] = back.backing; y[5] = back.rate;
                 y[6] = arriving.facing; y[7] = f32(walk_is_upward(flight));"
            ),
            pairs(),
            twins!(|x| {
                let w = vector(x, 2);
                let [facing, backing, rate] = flight(&ggx(x), w);
                let [back, _, back_rate] = flight(&ggx(x), -w);
                let up = T::select(w.z > T::ZERO, T::ONE, T::ZERO);
                vec![facing, backing, rate, back, facing, back_rate, back, up]
            }),
            16.0,
        ),
        Case::new(
            "meetings",
            modules,
            metal!(
                "let met = walk_meet(normals, -wo, wi.yz);
                 let bounce = walk_bounce(facets, -wo, wi.yz);
                 y[0] = met.wm.x; y[1] = met.wm.y; y[2] = met.wm.z; y[3] = met.cos_m;
                 y[4] = met.next.d.x; y[5] = met.next.d.y; y[6] = met.next.d.z;
                 y[7] = bounce.fresnel.r; y[8] = bounce.next.d.z - met.next.d.z;"
            ),
            sampling_inputs(),
            twins!(|x| {
                let wo = vector(x, 2);
                let wm = ggx(x).sample_wm(wo, [x[6], x[7]]);
                let cos = wo.dot(wm);
                let next = wm * (T::TWO * cos) - wo;
                let f = reflectance::<T>().eval(cos).r;
                vec![wm.x, wm.y, wm.z, cos, next.x, next.y, next.z, f, T::ZERO]
            }),
            64.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "connections",
            modules,
            metal!(
                "let met = walk_turn(normals, -wo, wi);
                 let end = walk_connection(facets, -wo, wi);
                 y[0] = met.quarter_d; y[1] = end.quarter_d * end.fresnel.g;
                 y[2] = walk_single(facets, walk_arriving(facets, wo), walk_flight(normals, wi)).b;"
            ),
            pairs(),
            twins!(|x| {
                let (ndf, wo, wi) = (ggx(x), vector(x, 2), vector(x, 5));
                let [cos, quarter_d] = turn(&ndf, -wo, wi);
                let f = reflectance::<T>().eval(cos);
                let [facing, _, rate] = flight(&ndf, -wo);
                let [_, _, leaving] = flight(&ndf, wi);
                let single = f.b * (quarter_d / facing * (rate / (rate + leaving)));
                vec![quarter_d, quarter_d * f.g, single]
            }),
            64.0,
        ),
        normals(modules),
    ]
}

/// Both distributions.
fn normals(modules: &'static [&'static str]) -> Case {
    Case::new(
        "normals_of_both",
        modules,
        metal!(
            "let other = NormalsModel(normals.alpha, DISTRIBUTION_BECKMANN);
             let wm = normalize(vec3f(wo.x, wo.y, 0.3 + abs(wo.z)));
             y[0] = normals_projected_area(normals, wo);
             y[1] = normals_d(other, wm) * min(normals.alpha.x, 1.0) * min(normals.alpha.y, 1.0);
             y[2] = normals_lambda_cos(other, wo); y[3] = normals_projected_area(other, wo);
             let sampled = normals_sample_wm(other, wo, wi.yz);
             y[4] = sampled.x; y[5] = sampled.y; y[6] = sampled.z;
             let first = walk_pair(&stream); y[7] = first.x; y[8] = first.y;"
        ),
        sampling_inputs(),
        twins!(|x| {
            let (one, other, wo) = (ggx(x), Beckmann::new(alpha(x, 0)), vector(x, 2));
            let wm = Vec3 {
                z: T::of(f64::from(0.3_f32)) + wo.z.abs(),
                ..wo
            };
            let narrow = x[0].at_most(T::ONE) * x[1].at_most(T::ONE);
            let sampled = other.sample_wm(wo, [x[6], x[7]]);
            let mut stream = stream(x, 8);
            let mut next = || T::of(f64::from(stream.next::<f32>()));
            let (first, second) = (next(), next());
            vec![
                one.projected_area(wo),
                other.d(wm.normalize()) * narrow,
                other.lambda_cos(wo),
                other.projected_area(wo),
                sampled.x,
                sampled.y,
                sampled.z,
                first,
                second,
            ]
        }),
        64.0,
    )
    .at_scale(&[1.0])
}

/// Rates of seven flights, below 0 for upward ones; a rate of leaving; a random number; a seed.
fn walks_of_rates() -> Vec<[f32; 10]> {
    let mut stream = Stream::new(3);
    let mut next = || stream.next::<f32>();
    let mut rows = Vec::new();
    for pattern in 0..512_u16 {
        let mut row = [0.0; 10];
        row[0] = 1.0 + next();
        for (k, rate) in row[1..7].iter_mut().enumerate() {
            let scale = [1e-3, 1.0, 40.0][usize::from(pattern) % 3];
            let up = pattern >> k & 1 == 1;
            *rate = if up {
                -(scale * next()).max(1e-6)
            } else {
                1.0 + scale * next()
            };
        }
        row[7] = 0.01 + 3.0 * next();
        row[8] = next();
        row[9] = f32::from(pattern);
        rows.push(row);
    }
    rows
}

/// The state after the flights of a row, and the mass that the last upward one let out.
fn state<T: Real>(x: &[T]) -> (DepthState<T>, T) {
    let mut state = DepthState::new(x[0]);
    let mut left = T::ZERO;
    for &rate in &x[1..7] {
        if rate < T::ZERO {
            left = state.up(-rate);
        } else {
            assert!(state.down(rate), "there is room for seven");
        }
    }
    (state, left)
}

/// `ln Gamma` by Stirling's series, for the reference.
fn log_gamma(x: f64) -> f64 {
    let mut y = x;
    let mut product = 1.0;
    while y < 20.0 {
        product *= y;
        y += 1.0;
    }
    let s = 1.0 / (y * y);
    let series = (1.0 / 12.0 - s * (1.0 / 360.0 - s * (1.0 / 1260.0 - s / 1680.0))) / y;
    (y - 0.5) * y.ln() - y + 0.5 * std::f64::consts::TAU.ln() + series - product.ln()
}

fn depths() -> Vec<Case> {
    let states: &[&str] = &["state"];
    macro_rules! flown {
        ($($body:literal),*) => {
            concat!(
                "var state = state_new(x[0]);
                 var left = 0.0;
                 for (var k = 1u; k < 7u; k++) {
                     if x[k] < 0.0 { left = state_up(&state, -x[k]); } else { state_down(&state, x[k]); }
                 }
                 ",
                $($body),*
            )
        };
    }
    vec![
        Case::new(
            "states",
            states,
            flown!(
                "y[0] = left; y[1] = state_exit(&state, x[7]); y[2] = state_mass(&state);
                 state_scale(&state, 3.0); y[3] = state_mass(&state);"
            ),
            walks_of_rates(),
            twins!(|x| {
                let (mut state, left) = state(x);
                let (exit, mass) = (state.exit(x[7]), state.mass());
                state.scale(T::of(3.0));
                vec![left, exit, mass, state.mass()]
            }),
            64.0,
        ),
        Case::new(
            "state_depths",
            states,
            flown!(
                "var stream = stream_new(vec2u(u32(x[9]), 0x5eedu));
                 y[0] = state_sample_depth(&state, x[8], &stream);"
            ),
            walks_of_rates(),
            walks!(|x| {
                let mut stream = stream(x, 9);
                vec![state(x).0.sample_depth(x[8], || stream.next())]
            }),
            64.0,
        )
        .at_scale(&[0.1]),
    ]
}

/// What separates the two sides of a dielectric.
fn sides() -> Vec<Case> {
    let interface: &[&str] = &["multibounce_interface", "distribution"];
    let exponents: Vec<[f32; 1]> = [1.0, 1.01, 1.5, 2.0, 4.0, 30.0, 400.0, 1e4]
        .map(|l| [l])
        .into();
    let lambdas: Vec<[f32; 1]> = [0.0, 1e-6, 0.01, 0.3, 1.0, 2.0, 9.0, 300.0, 1e4, 1e6]
        .map(|l| [l])
        .into();
    vec![
        Case::new(
            "interface_depths",
            interface,
            "y[0] = multibounce_interface_depth_beyond(x[0]);
             y[1] = multibounce_interface_depth_beyond(x[0] * 1e-3);",
            lambdas.clone(),
            twins!(|x| {
                let beyond = |tau: T| {
                    let share = -(-tau.to_f64()).exp_m1();
                    T::of((-share.max(f64::from(f32::MIN_POSITIVE)).ln()).max(0.0))
                };
                vec![beyond(x[0]), beyond(x[0] * T::of(f64::from(1e-3_f32)))]
            }),
            2000.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "interface_masking",
            interface,
            "y[0] = multibounce_interface_leaves_beyond(x[0], x[1]);",
            product::<1, 1, 2>(&exponents, &lambdas),
            twins!(|x| {
                let (l, lambda) = (x[0].to_f64(), x[1].to_f64());
                let log = log_gamma(l + 1.0) + log_gamma(lambda + 1.0) - log_gamma(l + lambda + 1.0);
                vec![T::of(log.exp())]
            }),
            64.0,
        )
        .at_scale(&[1e-6]),
        Case::new(
            "interface_bounces",
            interface,
            "let normals = NormalsModel(vec2f(x[0], x[1]), DISTRIBUTION_GGX);
             let facets = multibounce_interface_beyond(MultibounceInterface(normals, 1.0 / x[9]));
             let bent = multibounce_interface_bounce(facets, -vec3f(x[2], x[3], x[4]), vec3f(x[5], x[6], x[7]));
             y[0] = bent.d.x; y[1] = bent.d.y; y[2] = bent.d.z; y[3] = f32(bent.crosses);
             let turned = multibounce_interface_turned(bent.d);
             y[4] = turned.z + bent.d.z;",
            with_index::<9, 10>(&sampling_inputs()),
            twins!(|x| {
                let wo = vector(x, 2);
                let eta = T::ONE / (T::ONE / x[9]);
                let wm = ggx(x).sample_wm(wo, [x[6], x[7]]);
                let cos = wo.dot(wm);
                let bent = dielectric(cos, eta);
                let crosses = x[5] >= bent.reflectance;
                let d = if crosses {
                    let wt = refract(wo, wm, cos, bent.cos_t, eta);
                    Vec3 { z: -wt.z, ..wt }
                } else {
                    wm * (T::TWO * cos) - wo
                };
                let side = T::select(crosses, T::ONE, T::ZERO);
                vec![d.x, d.y, d.z, side, T::ZERO]
            }),
            256.0,
        )
        .at_scale(&[1.0])
        .with_strays(4),
    ]
}
