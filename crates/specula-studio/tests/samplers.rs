//! Answers about samplers: against the library's own functions, quadrature and known values.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod common;

use common::{ask, error, floats};
use std::f64::consts::PI;

use serde_json::{Value, json};
use specula_bsdf::math::vec3;
use specula_bsdf::vndf::{Reflections, Sampler, exact};
use specula_bsdf::{Alpha, Vec3};
use specula_studio::Answer;

const SAMPLERS: [Sampler; 4] = [
    Sampler::Heitz,
    Sampler::Cap,
    Sampler::Bounded,
    Sampler::Exact,
];

const ALPHAS: [[f64; 2]; 5] = [[0.3, 0.3], [0.1, 0.8], [1.0, 1.0], [2.0, 1.3], [0.05, 0.02]];

fn views() -> [Vec3<f64>; 5] {
    [
        vec3(0.0, 0.0, 1.0),
        vec3(0.6, 0.0, 0.8),
        vec3(-0.5, 0.8, 0.11_f64.sqrt()),
        vec3(0.0, 0.999, (1.0 - 0.999_f64 * 0.999).sqrt()),
        vec3(0.36, 0.48, -0.8),
    ]
}

fn setup(what: &str, alpha: [f64; 2], wo: Vec3<f64>, more: &Value) -> Value {
    let mut request =
        json!({"ask": format!("samplers.{what}"), "alpha": alpha, "wo": wo.to_array()});
    let fields = request.as_object_mut().unwrap();
    fields.extend(more.as_object().unwrap().clone());
    request
}

fn vectors(answer: &Answer, name: &str) -> Vec<Vec3<f64>> {
    floats(answer, name)
        .chunks(3)
        .map(|v| vec3(v[0].into(), v[1].into(), v[2].into()))
        .collect()
}

fn number(answer: &Answer, name: &str) -> f64 {
    answer.value()[name].as_f64().unwrap()
}

#[test]
fn samples_are_the_librarys() {
    for alpha in ALPHAS {
        for wo in views() {
            for sampler in SAMPLERS {
                let more = json!({"sampler": sampler.to_string(), "count": 500, "seed": 3});
                let answer = ask(&setup("samples", alpha, wo, &more));
                let (wi, wm) = (vectors(&answer, "wi"), vectors(&answer, "wm"));
                let pdf = floats(&answer, "pdf");
                let reflections =
                    Reflections::new(Alpha::new(alpha[0], alpha[1]).unwrap(), wo, sampler);
                let mut stream = specula_bsdf::math::Stream::new(3);
                for i in 0..500 {
                    let direct = reflections.sample_direction([stream.next(), stream.next()]);
                    assert!(
                        (direct - wi[i]).length() < 1e-6,
                        "{sampler} {alpha:?} {wo:?}"
                    );
                    let density = reflections.pdf(direct);
                    assert!((f64::from(pdf[i]) - density).abs() <= 1e-6 * density);
                    let mirrored = wm[i] * (2.0 * wo.dot(wm[i])) - wo;
                    assert!(
                        (mirrored - wi[i]).length() < 1e-4,
                        "{mirrored:?} {:?}",
                        wi[i]
                    );
                }
                let rejected = wi.iter().filter(|w| w.z <= 0.0).count();
                assert_eq!(answer.value()["rejected"], json!(rejected));
            }
        }
    }
}

/// In the stretched space samples fill their region and no more.
#[test]
fn samples_lie_within_their_regions() {
    for alpha in ALPHAS {
        for wo in views() {
            let regions = ask(&setup("regions", alpha, wo, &json!({"count": 1025})));
            for (sampler, name) in [
                (Sampler::Cap, "cap"),
                (Sampler::Bounded, "bounded_cap"),
                (Sampler::Exact, "exact"),
            ] {
                let more = json!({"sampler": sampler.to_string(), "count": 2000});
                let answer = ask(&setup("samples", alpha, wo, &more));
                let space = [
                    ("", vectors(&answer, "stretched")),
                    ("_wi", vectors(&answer, "wi")),
                ];
                for (suffix, samples) in space {
                    let outline = vectors(&regions, &format!("{name}{suffix}"));
                    for w in &outline {
                        assert!((w.length() - 1.0).abs() < 1e-6);
                    }
                    assert!((outline[0] - outline[1024]).length() < 1e-6, "it is closed");
                    if suffix.is_empty() || name != "exact" || wo.z < 0.0 {
                        continue;
                    }
                    // The horizon: outline and samples.
                    assert!(outline.iter().all(|w| w.z.abs() < 1e-5), "{alpha:?} {wo:?}");
                    assert!(samples.iter().all(|w| w.z > -1e-6));
                }
                let outline = vectors(&regions, name);
                let samples = vectors(&answer, "stretched");
                let inside = samples.iter().filter(|o| is_inside(&outline, **o)).count();
                // Those within rounding and the polygon's sagitta of the edge may be outside.
                assert!(inside >= 1990, "{name} {alpha:?} {wo:?}: {inside}");
                if name == "exact" && wo.z > 0.0 {
                    let cap = ask(&setup(
                        "samples",
                        alpha,
                        wo,
                        &json!({"sampler": "cap", "count": 2000}),
                    ));
                    let wi = vectors(&cap, "wi");
                    for (o, wi) in vectors(&cap, "stretched").iter().zip(&wi) {
                        let agrees = is_inside(&outline, *o) == (wi.z > 0.0);
                        assert!(agrees || wi.z.abs() < 1e-3, "{alpha:?} {wo:?} {wi:?}");
                    }
                }
            }
        }
    }
}

/// Whether a direction is within a closed outline: above a level one, else by the winding number in the
/// stereographic projection from the nadir, which is in no region.
fn is_inside(outline: &[Vec3<f64>], o: Vec3<f64>) -> bool {
    if outline.iter().all(|w| w.z == outline[0].z) {
        return o.z >= outline[0].z - 1e-6;
    }
    let project = |w: &Vec3<f64>| {
        let scale = 1.0 / (1.0 + w.z).max(1e-12);
        [w.x * scale, w.y * scale]
    };
    let [x, y] = project(&o);
    let angle = |w: &Vec3<f64>| {
        let [a, b] = project(w);
        (b - y).atan2(a - x)
    };
    let mut turns = 0.0;
    for pair in outline.windows(2) {
        let step = angle(&pair[1]) - angle(&pair[0]);
        turns += (step + PI).rem_euclid(2.0 * PI) - PI;
    }
    turns.abs() > PI
}

#[test]
fn acceptance_is_that_of_samples_and_norms() {
    for alpha in ALPHAS {
        for wo in views() {
            let shares = SAMPLERS.map(|sampler| {
                let more = json!({"sampler": sampler.to_string()});
                let answer = ask(&setup("describe", alpha, wo, &more));
                number(&answer, "acceptance")
            });
            assert!((shares[3] - 1.0).abs() < 1e-4, "exact: {shares:?}");
            assert!(shares[2] >= shares[1] - 1e-4, "bounded, cap: {shares:?}");
            assert!(
                (shares[0] - shares[1]).abs() < 1e-4,
                "heitz, cap: {shares:?}"
            );
            for (sampler, share) in SAMPLERS.into_iter().zip(shares) {
                let alpha = Alpha::new(alpha[0], alpha[1]).unwrap();
                let norm = Reflections::new(alpha, wo, sampler).norm();
                let expected = exact::norm(alpha, wo) / norm;
                assert!(
                    (share - expected).abs() < 1e-4,
                    "{sampler} {alpha:?} {wo:?}: {share} {expected}"
                );
            }
        }
    }
}

#[test]
fn formulas_are_the_librarys_numbers() {
    for alpha in ALPHAS {
        for wo in views() {
            for sampler in SAMPLERS {
                let more = json!({"sampler": sampler.to_string()});
                let answer = ask(&setup("describe", alpha, wo, &more));
                let formulas = answer.value()["formulas"].as_array().unwrap();
                let alpha = Alpha::new(alpha[0], alpha[1]).unwrap();
                let norm = Reflections::new(alpha, wo, sampler).norm();
                let said = formulas
                    .iter()
                    .find(|f| f["id"] == "N" || f["id"] == "sigma")
                    .unwrap_or_else(|| panic!("{sampler} {wo:?}: no norm"));
                let value = said["value"].as_f64().unwrap();
                assert!(
                    (value - norm).abs() < 1e-9 * norm,
                    "{sampler} {alpha:?} {wo:?}: {value} {norm}"
                );
                for formula in formulas {
                    assert!(formula["value"].as_f64().is_some(), "{formula}");
                    for text in ["id", "name", "tex", "numbers", "source"] {
                        assert!(!formula[text].as_str().unwrap().is_empty(), "{formula}");
                    }
                }
            }
        }
    }
}

#[test]
fn histograms_agree_with_densities() {
    let mut least = 1.0_f64;
    for alpha in ALPHAS {
        for wo in views() {
            for (i, sampler) in SAMPLERS.into_iter().enumerate() {
                let more = json!({"sampler": sampler.to_string(), "size": 32, "count": 50_000, "seed": 10 + i});
                let answer = ask(&setup("histogram", alpha, wo, &more));
                let counts: f32 = floats(&answer, "counts").iter().sum();
                let expected: f32 = floats(&answer, "expected").iter().sum();
                let rejected = number(&answer, "rejected");
                assert!((f64::from(counts) + rejected - 50_000.0).abs() < 0.5);
                let missing = number(&answer, "expectedRejected");
                assert!(
                    (f64::from(expected) + missing - 50_000.0).abs() < 5.0,
                    "{sampler} {alpha:?} {wo:?} {expected} {missing}"
                );
                let p = number(&answer, "p");
                assert!(
                    p > 1e-5,
                    "{sampler} {alpha:?} {wo:?}: p {p}, {}",
                    answer.value()
                );
                least = least.min(p);
            }
        }
    }
    // A hundred tests: the least p is about 1 %.
    assert!(
        least < 0.2,
        "p-values that are never small test nothing: {least}"
    );
}

#[test]
fn estimates_of_all_samplers_agree() {
    for lamp in [json!({}), json!({"towards": [0.0, 0.0, 1.0], "angle": 0.4})] {
        let more = json!({"lamp": lamp, "count": 100_000, "seed": 2});
        let answer = ask(&setup("compare", [0.3, 0.6], vec3(0.6, 0.0, 0.8), &more));
        let rows = answer.value()["rows"].as_array().unwrap();
        assert_eq!(rows.len(), 4);
        let of = |i: usize, name: &str| rows[i][name].as_f64().unwrap();
        for i in 0..3 {
            let apart = (of(i, "mean") - of(3, "mean")).abs();
            assert!(
                apart < 4.5 * of(i, "error").hypot(of(3, "error")),
                "{rows:?}"
            );
            assert!(of(i, "nanoseconds") > 0.0);
        }
        assert_eq!(of(3, "acceptance"), 1.0);
        assert!(of(2, "acceptance") > of(1, "acceptance"));
        assert!(of(3, "variance") < of(1, "variance"));
    }
}

#[test]
fn errors_name_the_field() {
    let wo = [0.6, 0.0, 0.8];
    for (request, message) in [
        (
            json!({"ask": "samplers.describe", "sampler": "best", "alpha": [0.3, 0.3], "wo": wo}),
            "sampler: expected heitz, cap, bounded or exact, got 'best'",
        ),
        (
            json!({"ask": "samplers.describe", "sampler": "cap", "alpha": [0.0, 0.3], "wo": wo}),
            "alpha: alpha must lie in [1e-4, 10], not (0, 0.3)",
        ),
        (
            json!({"ask": "samplers.describe", "sampler": "cap", "alpha": [0.3], "wo": wo}),
            "alpha: expected 2 finite numbers, got [0.3]",
        ),
        (
            json!({"ask": "samplers.describe", "sampler": "cap", "alpha": [0.3, 0.3], "wo": [1, 1, 1]}),
            "wo: expected a unit vector [x, y, z], got [1,1,1]",
        ),
        (
            json!({"ask": "samplers.samples", "sampler": "cap", "alpha": [0.3, 0.3], "wo": wo, "count": 1e9}),
            "count: expected a whole number in [1, 1000000], got 1000000000.0",
        ),
        (
            json!({"ask": "samplers.regions", "alpha": [0.3, 0.3], "wo": wo}),
            "count: is missing (expected a whole number in [4, 4096])",
        ),
        (
            json!({"ask": "samplers.regions", "alpha": [0.3, 0.3], "wo": wo, "count": 8, "size": 1}),
            "'size' is no field of this request",
        ),
        (
            json!({"ask": "samplers.compare", "alpha": [0.3, 0.3], "wo": wo, "count": 8, "lamp": {"angle": 1}}),
            "towards: is missing (expected a unit vector [x, y, z])",
        ),
    ] {
        assert_eq!(error(&request), message);
    }
}
