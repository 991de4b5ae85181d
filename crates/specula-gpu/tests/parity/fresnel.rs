//! Fresnel reflectance.

use specula_bsdf::fresnel::{
    Conductor, F82Tint, Reflectance, Schlick, dielectric, dielectric_average, refract,
};
use specula_bsdf::math::{Vec3, rgb};
use specula_bsdf::{Real, Rgb};

use crate::harness::{
    ABOVE, Case, ETAS, Fault, assert_covered, catch, product, prove, round, twins, vector, views,
};

/// Cosines: of the grid, and evenly from grazing to normal.
fn cosines() -> Vec<[f32; 1]> {
    let evenly = (0..=64).map(|i| f64::from(i) / 64.0);
    let all = ABOVE.into_iter().chain(evenly).chain([1e-6, 0.999_999]);
    all.map(|c| [round(c)]).collect()
}

/// Indices of the grid, their ends, and hardly any interface.
fn etas() -> Vec<[f32; 1]> {
    let ends = [0.25, 4.0, 1.0, 1.0005, 1.01, 0.99];
    ETAS.into_iter().chain(ends).map(|e| [e]).collect()
}

/// `(eta, k)` per channel: gold, an index without absorption, extremes.
const METALS: [[f32; 6]; 4] = [
    [0.14, 0.37, 1.44, 3.98, 2.38, 1.60],
    [1.5, 2.4, 1.0, 0.0, 0.0, 0.0],
    [0.02, 10.0, 3000.0, 5.0, 0.01, 0.0],
    [1.0, 1.1, 0.05, 2000.0, 1e-3, 12.0],
];

/// `F0` and a tint.
const COLOURS: [[f32; 6]; 4] = [
    [0.9, 0.5, 0.2, 0.7, 0.9, 1.0],
    [0.0, 0.04, 1.0, 0.0, 0.5, 0.3],
    [0.99, 0.95, 0.02, 0.0, 0.0, 1.0],
    [0.5, 0.6, 0.7, 1.0, 1.0, 1.0],
];

fn colour<T: Real>(x: &[T], at: usize) -> Rgb<T> {
    rgb(x[at], x[at + 1], x[at + 2])
}

fn metal<T: Real>(x: &[T]) -> Conductor<T> {
    Conductor {
        eta: colour(x, 0),
        k: colour(x, 3),
    }
}

fn dielectrics() -> Vec<Case> {
    // Facets met by a view, on its side.
    let met = views(&ABOVE)
        .into_iter()
        .map(|wm| [0.48, 0.36, 0.8, wm[0], wm[1], wm[2]])
        .filter(|x| x[0] * x[3] + x[1] * x[4] + x[2] * x[5] > 0.0);
    vec![
        Case::new(
            "dielectric",
            &["dielectric"],
            "let r = dielectric(x[0], x[1]);
             y[0] = r.reflectance; y[1] = r.transmittance; y[2] = r.cos_t;
             y[3] = dielectric_refraction(x[0], x[0] * x[0] - 0.25, x[1]).reflectance;",
            product::<1, 1, 2>(&cosines(), &etas()),
            twins!(|x| {
                let r = dielectric(x[0], x[1]);
                let cos2_t = x[0] * x[0] - T::of(0.25);
                let beyond = cos2_t <= T::ZERO;
                let cos_t = cos2_t.safe_sqrt();
                let s = (x[0] - x[1] * cos_t) / (x[0] + x[1] * cos_t);
                let p = (x[1] * x[0] - cos_t) / (x[1] * x[0] + cos_t);
                let known = T::select(beyond, T::ONE, T::HALF * (s * s + p * p));
                vec![r.reflectance, r.transmittance, r.cos_t, known]
            }),
            24.0,
        )
        .at_scale(&[0.05, 0.05, 1.0, 0.05]),
        Case::new(
            "refracted",
            &["dielectric"],
            "let wo = vec3f(x[0], x[1], x[2]);
             let wm = vec3f(x[3], x[4], x[5]);
             let wi = dielectric_refract(wo, wm, dot(wo, wm), 0.6, x[6]);
             y[0] = wi.x; y[1] = wi.y; y[2] = wi.z;",
            product::<6, 1, 7>(&met.collect::<Vec<_>>(), &etas()),
            twins!(|x| {
                let (wo, wm): (Vec3<T>, Vec3<T>) = (vector(x, 0), vector(x, 3));
                let cos_t = T::of(0.6_f32.into());
                refract(wo, wm, wo.dot(wm), cos_t, x[6]).to_array().to_vec()
            }),
            16.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "dielectric_average",
            &["dielectric"],
            "y[0] = dielectric_average(x[0]);",
            (0..=600)
                .map(|i| [round(0.1 * 100_f64.powf(f64::from(i) / 600.0))])
                .chain(etas())
                .collect(),
            twins!(|x| vec![dielectric_average(x[0])]),
            128.0,
        )
        .at_scale(&[0.01]),
    ]
}

fn metals_and_schlick() -> Vec<Case> {
    vec![
        Case::new(
            "conductor",
            &["conductor"],
            "let metal = ConductorIor(vec3f(x[0], x[1], x[2]), vec3f(x[3], x[4], x[5]));
             let f = conductor_eval(metal, x[6]);
             let under = conductor_eval(conductor_under(metal, 1.5), x[6]);
             for (var k = 0u; k < 3u; k++) { y[k] = f[k]; y[k + 3u] = under[k]; }",
            product::<6, 1, 7>(&METALS, &cosines()),
            twins!(|x| {
                let under = metal(x).under(T::of(1.5)).eval(x[6]);
                [metal(x).eval(x[6]), under].map(Rgb::to_array).concat()
            }),
            64.0,
        )
        .at_scale(&[0.1]),
        Case::new(
            "schlick",
            &["f82"],
            "let normal = vec3f(x[0], x[1], x[2]);
             let tint = vec3f(x[3], x[4], x[5]);
             let f = schlick_eval(normal, x[6]);
             let f_tint = f82_eval(normal, f82_hump(normal, tint), x[6]);
             for (var k = 0u; k < 3u; k++) { y[k] = f[k]; y[k + 3u] = f_tint[k]; }",
            product::<6, 1, 7>(&COLOURS, &cosines()),
            twins!(|x| {
                let schlick = Schlick { f0: colour(x, 0) };
                let tinted = F82Tint::new(colour(x, 0), colour(x, 3));
                [schlick.eval(x[6]), tinted.eval(x[6])].map(Rgb::to_array).concat()
            }),
            8.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "reflectances",
            &["reflectance"],
            "let first = vec3f(x[0], x[1], x[2]);
             let second = vec3f(x[3], x[4], x[5]);
             let metal = reflectance_tinted(reflectance_conductor(first, 5.0 * second), second);
             var all: array<vec3f, 6>;
             all[0] = reflectance_eval(reflectance_constant(first), x[6]);
             all[1] = reflectance_eval(reflectance_schlick(first), x[6]);
             all[2] = reflectance_eval(reflectance_tinted(reflectance_f82_tint(first, second), first), x[6]);
             all[3] = reflectance_eval(metal, x[6]);
             all[4] = reflectance_eval(reflectance_under(metal, 1.5), x[6]);
             all[5] = reflectance_eval(reflectance_under(reflectance_schlick(second), 1.5), x[6]);
             for (var k = 0u; k < 18u; k++) { y[k] = all[k / 3u][k % 3u]; }",
            product::<6, 1, 7>(&COLOURS, &cosines()),
            twins!(|x| {
                let (first, second) = (colour(x, 0), colour(x, 3));
                let index = Conductor {
                    eta: first,
                    k: second * T::of(5.0),
                };
                let metal = Reflectance::Conductor(index).tinted(second);
                let f82 = Reflectance::F82Tint(F82Tint::new(first, second));
                let eta = T::of(1.5);
                let all = [
                    Reflectance::Constant(first),
                    Reflectance::Schlick(Schlick { f0: first }),
                    f82.tinted(first),
                    metal,
                    metal.under(eta),
                    Reflectance::Schlick(Schlick { f0: second }).under(eta),
                ];
                all.map(|f| f.eval(x[6]).to_array()).concat()
            }),
            64.0,
        )
        .at_scale(&[0.1]),
    ]
}

pub(crate) fn cases() -> Vec<Case> {
    [dielectrics(), metals_and_schlick()].concat()
}

pub(crate) const FAULTS: [Fault; 5] = [
    Fault {
        case: "dielectric",
        module: "fresnel/dielectric",
        from: "min(2.0 * eta * cosine * cos_t * fluxes, 1.0)",
        to: "min(2.0 * cosine * cos_t * fluxes, 1.0)",
    },
    Fault {
        case: "dielectric_average",
        module: "fresnel/dielectric",
        from: "0.521863671",
        to: "0.521963671",
    },
    Fault {
        case: "conductor",
        module: "fresnel/conductor",
        from: "4.0 * eta_squared * k * k",
        to: "3.99 * eta_squared * k * k",
    },
    Fault {
        case: "schlick",
        module: "fresnel/f82",
        from: "0.14285715",
        to: "0.14385715",
    },
    Fault {
        case: "reflectances",
        module: "fresnel/reflectance",
        from: "f.tint * tint",
        to: "tint * tint",
    },
];

#[test]
fn reflectances_agree_with_their_twins() {
    prove("fresnel", &cases());
}

#[test]
fn faults_in_reflectances_are_noticed() {
    catch("fresnel", &cases(), &FAULTS);
}

#[test]
fn every_function_of_reflectances_has_a_case() {
    assert_covered(
        "fresnel",
        &cases(),
        &[("dielectric_walsh", "all of dielectric_average")],
    );
}
