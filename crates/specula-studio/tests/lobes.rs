//! Answers about lobes: against the library's own functions and known values.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod common;

use std::f64::consts::PI;

use common::{ask, error, floats};
use serde_json::{Value, json};
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::{Bsdf, Transport, Vec3};
use specula_studio::Answer;

const WO: [f64; 3] = [0.6, 0.0, 0.8];

/// One lobe of each kind, and of what they choose among.
const LOBES: [&str; 24] = [
    "lambert albedo 0.8,0.2,0.1",
    "eon roughness 0.7",
    "diffuse-transmission reflectance 0.3 transmittance 0.4",
    "smooth-conductor Ag",
    "conductor Au alpha 0.1,0.4",
    "conductor alpha 0.8 energy turquin",
    "conductor alpha 0.8 energy kulla-conty",
    "conductor Cu alpha 0.3 distribution beckmann",
    "conductor Cu alpha 0.3 sampler bounded masking separable",
    "multibounce-conductor Au alpha 0.6",
    "multibounce-conductor Au alpha 0.6 model heitz",
    "smooth-dielectric",
    "thin-dielectric eta 1.3",
    "dielectric alpha 0.3",
    "dielectric alpha 0.3 compensated true",
    "multibounce-dielectric alpha 0.5",
    "coated-diffuse alpha 0.2",
    "coated-diffuse",
    "layered Au alpha 0.2 base_alpha 0.3",
    "layered albedo 0.5 thickness 0.4 medium_albedo 0.5",
    "plastic alpha 0.2",
    "principled metallic 0.3 clearcoat 0.5 roughness 0.6",
    "principled spec_trans 0.9 roughness 0.6",
    "gltf roughness 0.6 metallic 0.3",
];

fn lobes(what: &str, lobe: &str, more: &Value) -> Value {
    let mut request = json!({"ask": format!("lobes.{what}"), "lobe": lobe});
    let fields = request.as_object_mut().unwrap();
    fields.extend(more.as_object().unwrap().clone());
    request
}

fn double(lobe: &str) -> specula_bsdf::bsdf::Lobe<f64> {
    *specula_lobes::parse(lobe).unwrap().double()
}

fn near(found: f32, expected: f64) -> bool {
    (f64::from(found) - expected).abs() <= 1e-5 * expected.abs() + 1e-30
}

#[test]
fn kinds_are_the_librarys() {
    let answer = ask(&json!({"ask": "lobes.kinds"}));
    let kinds = answer.value()["kinds"].as_array().unwrap();
    assert_eq!(kinds.len(), 15);
    for kind in kinds {
        assert!(!kind["doc"].as_str().unwrap().is_empty());
        for parameter in kind["parameters"].as_array().unwrap() {
            assert!(parameter["doc"].as_str().unwrap().len() > 5, "{parameter}");
            assert_eq!(
                parameter["type"] == "choice",
                parameter["choices"].is_array()
            );
            assert_eq!(
                parameter["type"] == "number",
                parameter["low"].is_f64() && parameter["type"] == "number"
            );
        }
    }
    let metals = answer.value()["metals"].as_array().unwrap();
    assert!(metals.contains(&json!({"symbol": "Au", "name": "gold"})));
}

#[test]
fn texts_have_a_normal_form() {
    for (text, normal) in [
        (
            "conductor alpha 0.3,0.1 energy turquin Au",
            "conductor Au alpha 0.3,0.1 energy turquin",
        ),
        (
            "conductor 0.9 0.6 0.2 alpha 0.3 0.1",
            "conductor alpha 0.3,0.1 reflectance 0.9,0.6,0.2",
        ),
        ("conductor alpha 0.2 0.2", "conductor alpha 0.2"),
        (
            "multibounce_conductor mis-pdf hapke alpha .5",
            "multibounce-conductor alpha 0.5 mis_pdf hapke",
        ),
        (
            "dielectric alpha 0.3 compensated 1",
            "dielectric alpha 0.3 compensated true",
        ),
        ("lambert albedo 0.5 0.5 0.5", "lambert albedo 0.5"),
    ] {
        let answer = ask(&lobes("parse", text, &json!({})));
        assert_eq!(answer.value()["lobe"], json!(normal), "{text}");
        let again = ask(&lobes("parse", normal, &json!({})));
        assert_eq!(answer.value(), again.value());
    }
    let value = ask(&lobes("parse", "conductor Au alpha 0.3,0.1", &json!({})));
    let expected = json!({
        "lobe": "conductor Au alpha 0.3,0.1", "kind": "conductor", "given": {"alpha": "0.3,0.1", "reflectance": "Au"},
        "isStochastic": false, "isSpecular": false, "transmits": false,
    });
    assert_eq!(value.value(), &expected);
    for lobe in LOBES {
        let answer = ask(&lobes("parse", lobe, &json!({})));
        let transmits = lobe.contains("dielectric")
            || lobe.contains("transmission")
            || lobe.contains("spec_trans");
        assert_eq!(answer.value()["transmits"], json!(transmits), "{lobe}");
        assert_eq!(
            answer.value()["isSpecular"],
            json!(lobe.starts_with("smooth") || lobe.starts_with("thin"))
        );
        let is_stochastic = lobe.starts_with("multibounce") || lobe.starts_with("layered");
        assert_eq!(
            answer.value()["isStochastic"],
            json!(is_stochastic),
            "{lobe}"
        );
    }
}

#[test]
fn values_are_the_lobes() {
    let wo = vec3(0.6, 0.0, 0.8);
    for text in LOBES {
        let lobe = double(text);
        let slice = ask(&lobes(
            "slice",
            text,
            &json!({"wo": WO, "azimuth": 0.3, "count": 65, "samples": 4}),
        ));
        let (theta, f_cos, pdf) = (
            floats(&slice, "theta"),
            floats(&slice, "f_cos"),
            floats(&slice, "pdf"),
        );
        assert!(near(theta[0], -PI) && near(theta[32], 0.0) && near(theta[64], PI));
        let grid = ask(&lobes(
            "grid",
            text,
            &json!({"wo": WO, "rows": 9, "columns": 13, "sphere": true}),
        ));
        let (grid_theta, phi) = (floats(&grid, "theta"), floats(&grid, "phi"));
        let (grid_f, grid_pdf) = (floats(&grid, "f_cos"), floats(&grid, "pdf"));
        assert!(near(grid_theta[8], PI) && near(phi[12], 2.0 * PI));
        for i in 0..65 {
            let (sin, cos) = (-PI + 2.0 * PI * f64::from(i) / 64.0).sin_cos();
            let wi = vec3(sin * 0.3_f64.cos(), sin * 0.3_f64.sin(), cos);
            let i = usize::try_from(i).unwrap();
            check(&lobe, wo, wi, &f_cos[3 * i..][..3], pdf[i], text);
        }
        for row in 0..9 {
            for column in 0..13 {
                let (theta, phi) = (
                    PI * f64::from(row) / 8.0,
                    2.0 * PI * f64::from(column) / 12.0,
                );
                let wi = vec3(
                    theta.sin() * phi.cos(),
                    theta.sin() * phi.sin(),
                    theta.cos(),
                );
                let i = usize::try_from(row * 13 + column).unwrap();
                check(&lobe, wo, wi, &grid_f[3 * i..][..3], grid_pdf[i], text);
            }
        }
    }
}

fn check(lobe: &impl Bsdf<f64>, wo: Vec3<f64>, wi: Vec3<f64>, f_cos: &[f32], pdf: f32, text: &str) {
    if wi.z.abs() < 1e-6 {
        // Rounding decides on which side of the horizon it is.
        return;
    }
    assert!(
        (f64::from(pdf) - lobe.pdf(wo, wi)).abs() <= 1e-5 * lobe.pdf(wo, wi) + 1e-12,
        "{text} {wi:?}"
    );
    let expected = lobe.eval(wo, wi, Transport::Radiance).to_array();
    for (found, expected) in f_cos.iter().zip(expected) {
        assert!(found.is_finite() && *found >= 0.0);
        assert!(
            lobe.is_stochastic() || near(*found, expected) || expected < 1e-12,
            "{text} {wi:?}: {found} {expected}"
        );
    }
}

/// Estimates are means: more of them are nearer to the truth, by Heitz's reference of both ends.
#[test]
fn estimates_are_averaged() {
    // `f cos` of all bounces at normal incidence, light at 30 degrees, alpha 1, F 1: 0.30306 (Heitz et al. 2016 by
    // 10^6 walks).
    let text = "multibounce-conductor alpha 1";
    let request = json!({"wo": [0.0, 0.0, 1.0], "azimuth": 0.0, "count": 13, "samples": 100_000});
    let answer = ask(&lobes("slice", text, &request));
    let f_cos = floats(&answer, "f_cos");
    for i in [5, 7] {
        assert!(
            (f64::from(f_cos[3 * i]) - 0.30306).abs() < 2e-3,
            "{}",
            f_cos[3 * i]
        );
    }
}

#[test]
fn compensated_metal_is_white_in_the_furnace() {
    for (text, least) in [
        ("conductor alpha 0.8 energy turquin", 0.99),
        ("conductor alpha 0.8 energy kulla-conty", 0.99),
        ("multibounce-conductor alpha 0.8", 0.99),
        ("smooth-conductor", 1.0),
        ("smooth-dielectric", 0.4),
    ] {
        let answer = ask(&lobes(
            "albedo",
            text,
            &json!({"count": 9, "samples": 20_000, "seed": 1}),
        ));
        let (cos, albedo, sigma) = (
            floats(&answer, "cos"),
            floats(&answer, "albedo"),
            floats(&answer, "error"),
        );
        assert!(near(cos[8], 1.0) && near(cos[0], 1e-3) && near(cos[4], 0.5));
        // Near grazing, tables of lost energy have their error.
        for i in 2..9 {
            let slack = 5.0 * sigma[3 * i] + 2e-3;
            assert!(
                albedo[3 * i] > least - slack && albedo[3 * i] < 1.0 + slack,
                "{text} {}: {}",
                cos[i],
                albedo[3 * i]
            );
        }
    }
    let lost = ask(&lobes(
        "albedo",
        "conductor alpha 1",
        &json!({"count": 2, "samples": 200_000}),
    ));
    // 1 - ln 2, in closed form.
    let albedo = f64::from(floats(&lost, "albedo")[3]);
    assert!((albedo - (1.0 - 2.0_f64.ln())).abs() < 3e-3, "{albedo}");
}

#[test]
fn samples_are_the_lobes() {
    let wo = vec3(0.6, 0.0, 0.8);
    for text in LOBES {
        let lobe = double(text);
        let request = json!({"wo": WO, "count": 4000, "seed": 5});
        let answer = ask(&lobes("samples", text, &request));
        let again = ask(&lobes("samples", text, &request));
        assert_eq!(
            floats(&answer, "weight"),
            floats(&again, "weight"),
            "{text}"
        );
        let (wi, pdf) = (floats(&answer, "wi"), floats(&answer, "pdf"));
        let (weight, u) = (floats(&answer, "weight"), floats(&answer, "u"));
        assert!(u.iter().all(|u| (0.0..=1.0).contains(u)));
        let failed = wi.chunks(3).filter(|w| **w == [0.0; 3]).count();
        assert_eq!(answer.value()["failed"], json!(failed), "{text}");
        for i in 0..4000 {
            let w: Vec3<f64> = vec3(wi[3 * i].into(), wi[3 * i + 1].into(), wi[3 * i + 2].into());
            if pdf[i] == 0.0 || w.z.abs() < 1e-3 {
                continue;
            }
            let density = lobe.pdf(wo, w);
            assert!(
                (f64::from(pdf[i]) - density).abs() < 2e-3 * density,
                "{text} {w:?}: {} {density}",
                pdf[i]
            );
        }
        let mean: f64 = weight.chunks(3).map(|w| f64::from(w[1])).sum::<f64>() / 4000.0;
        let said = answer.value()["albedo"][1].as_f64().unwrap();
        assert!(
            (mean - said).abs() < 1e-5 * said.max(1e-6),
            "{text}: {mean} {said}"
        );
        assert!(answer.value()["variance"].as_f64().unwrap() >= 0.0);
    }
}

#[test]
fn every_lobe_is_proven() {
    for text in LOBES {
        let answer = ask(&lobes(
            "prove",
            text,
            &json!({"wo": WO, "samples": 20_000, "seed": 1}),
        ));
        let checks = answer.value()["checks"].as_array().unwrap();
        assert!(checks.len() >= 2);
        for check in checks {
            assert_eq!(check["holds"], json!(true), "{text}: {check}");
        }
        let is_tested = checks.iter().any(|c| c["name"] == "chi-square");
        assert_eq!(answer.array("counts").is_some(), is_tested);
        if is_tested {
            agrees(&answer, text);
        }
    }
}

/// The grid's counts follow their expectation.
fn agrees(answer: &Answer, text: &str) {
    let pairs = floats(answer, "counts")
        .into_iter()
        .zip(floats(answer, "expected"));
    let (mut statistic, mut cells) = (0.0, 0.0_f64);
    for (counted, expected) in pairs.filter(|(_, expected)| *expected >= 5.0) {
        statistic += f64::from((counted - expected) * (counted - expected) / expected);
        cells += 1.0;
    }
    let deviations = (statistic - cells) / (2.0 * cells).max(1.0).sqrt();
    assert!(deviations < 5.0, "{text}: {statistic} of {cells}");
}

#[test]
fn walks_are_those_of_the_library() {
    let text = "multibounce-conductor Au alpha 0.7 model heitz";
    let answer = ask(&lobes(
        "walks",
        text,
        &json!({"wo": WO, "count": 20_000, "seed": 3}),
    ));
    let (shape, bytes) = answer.array("offsets").unwrap();
    assert_eq!(shape, [20_001]);
    let offsets: Vec<usize> = bytes
        .chunks(4)
        .map(|b| usize::try_from(u32::from_le_bytes(b.try_into().unwrap())).unwrap())
        .collect();
    let (height, direction) = (floats(&answer, "height"), floats(&answer, "direction"));
    let weight = floats(&answer, "weight");
    assert_eq!(*offsets.last().unwrap(), height.len());
    let (mut sum, mut rise) = (0.0, 0.0);
    for pair in offsets.windows(2) {
        let (first, last) = (pair[0], pair[1] - 1);
        assert!(last > first && height[first].is_infinite() && direction[3 * first + 2] < 0.0);
        assert!(height[first + 1..=last].iter().all(|h| h.is_finite()));
        assert!(direction[3 * last + 2] > 0.0);
        sum += f64::from(weight[3 * last + 2]);
        rise += f64::from(weight[3 * last + 2] * direction[3 * last + 2]);
    }
    // The library's walks: mean blue weight, and its mean with the cosine.
    let lobe = double(text);
    let mut stream = Stream::new(9);
    let (mut expected, mut expected_rise) = (0.0, 0.0);
    for _ in 0..20_000 {
        let u = [stream.next(), stream.next(), stream.next()];
        let sample = lobe.sample_random(vec3(0.6, 0.0, 0.8), u, Transport::Radiance, &mut stream);
        if let Some(s) = sample {
            expected += s.weight.b;
            expected_rise += s.weight.b * s.wi.z;
        }
    }
    for (found, expected) in [(sum, expected), (rise, expected_rise)] {
        assert!((found / expected - 1.0).abs() < 0.015, "{found} {expected}");
    }
    let shares: Vec<f64> = serde_json::from_value(answer.value()["bounces"].clone()).unwrap();
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9 && shares[0] > 0.5 && shares[1] > 0.05);
    let refused = error(&lobes("walks", "lambert", &json!({"wo": WO, "count": 1})));
    assert!(
        refused.starts_with("lobe: expected a rough metal"),
        "{refused}"
    );
}

#[test]
fn errors_name_what_is_wrong() {
    let request = |more| error(&lobes("slice", "lambert", &more));
    let whole = json!({"wo": WO, "azimuth": 0.0, "count": 9});
    for (field, value, message) in [
        (
            "wo",
            json!([0.0, 0.0]),
            "wo: expected a unit vector [x, y, z], got [0.0,0.0]",
        ),
        (
            "wo",
            json!([0.0, 0.0, 2.0]),
            "wo: expected a unit vector [x, y, z], got [0.0,0.0,2.0]",
        ),
        (
            "count",
            json!(1),
            "count: expected a whole number in [2, 4096], got 1",
        ),
        (
            "count",
            json!(9.5),
            "count: expected a whole number in [2, 4096], got 9.5",
        ),
        (
            "count",
            json!(null),
            "count: is missing (expected a whole number in [2, 4096])",
        ),
        (
            "azimuth",
            json!("x"),
            "azimuth: expected a finite number, got \"x\"",
        ),
        (
            "seed",
            json!(-1),
            "seed: expected a whole number in [0, 2^53), got -1",
        ),
        (
            "samples",
            json!(4_000_000),
            "samples: expected at most 444444 for 9 directions, got 4000000",
        ),
        ("more", json!(1), "'more' is no field of this request"),
    ] {
        let mut fields = whole.clone();
        fields[field] = value;
        assert_eq!(request(fields), message);
    }
    let unknown = error(&lobes("parse", "metal", &json!({})));
    assert!(unknown.starts_with("no such lobe: 'metal' (expected one of lambert"));
    assert_eq!(
        error(&json!({"ask": "lobes.paint"})),
        "nothing answers to 'lobes.paint'"
    );
}
