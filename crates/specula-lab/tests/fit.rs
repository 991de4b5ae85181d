//! Fits of synthetic measurements find the lobe that made them.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use specula_bsdf::bsdf::Lobe;
use specula_bsdf::measured::{MeasuredTables, Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Transport, Vec3};
use specula_lab::Record;
use specula_lab::fit::{Bounces, Distribution, FitOptions, FresnelModel, run};
use specula_lab::output::table::Cell;
use specula_lobes::{Argument, NamedLobe, Value};

const BOTH: [Distribution; 2] = [Distribution::Ggx, Distribution::Beckmann];
const BOUNCES: [Bounces; 2] = [Bounces::Single, Bounces::Compensated];

/// Tables of the lobe of a text; normals as of a GGX distribution.
fn tables(text: &str, alpha: [f64; 2], symmetry: Symmetry) -> MeasuredTables {
    let lobe = specula_lobes::parse(text).expect("a lobe");
    let lobe: &Lobe<f64> = lobe.double();
    let size = Resolution {
        theta: 10,
        phi: 7,
        normals: [64, 64],
        colours: 16,
    };
    tabulate(
        &Ggx::new(Alpha::clamped(alpha[0], alpha[1])),
        lobe,
        symmetry,
        size,
    )
}

/// Fits at draft quality, into a folder.
fn try_fit(
    tables: &MeasuredTables,
    bounces: &[Bounces],
    fresnel: &[FresnelModel],
    folder: &Path,
) -> specula_lab::Result<Record> {
    let options = FitOptions {
        name: "truth.bsdf",
        tables,
        distributions: &BOTH,
        bounces,
        fresnel,
        quality: specula_lab::Quality::Draft,
        seed: 1,
    };
    run(&options, folder, &AtomicBool::new(false), &|_| {})
}

fn fitted(tables: &MeasuredTables, bounces: &[Bounces], fresnel: &[FresnelModel]) -> Record {
    let folder = tempfile::tempdir().expect("a folder");
    try_fit(tables, bounces, fresnel, folder.path()).expect("a fit")
}

/// The chosen lobe's text, its alphas and the share that half of the nodes are within, in percent.
fn chosen(record: &Record) -> (String, [f64; 2], f64) {
    let table = record
        .tables
        .iter()
        .find(|t| t.name == "fits")
        .expect("fits");
    let row = (table.rows.iter())
        .find(|r| r.last() == Some(&Cell::Text("yes".to_owned())))
        .expect("one is chosen");
    let number = |i: usize| match row[i] {
        Cell::Number(Some(v)) => v,
        ref other => panic!("{other:?} is no number"),
    };
    let Cell::Text(text) = &row[0] else {
        panic!("no text")
    };
    (text.clone(), [number(1), number(3)], number(6))
}

fn near(found: f64, expected: f64) {
    assert!(
        (found / expected - 1.0).abs() < 0.02,
        "{found} is not {expected}"
    );
}

/// A mirror of the reflectance of a rough metal.
fn mirror(text: &str) -> NamedLobe {
    let rough = specula_lobes::parse(text).expect("a lobe");
    let arguments: Vec<Argument<'_>> = (rough.given())
        .filter(|(name, _)| {
            [
                "reflectance",
                "conductor_eta",
                "conductor_k",
                "f0",
                "f82_tint",
            ]
            .contains(name)
        })
        .map(|(name, value)| Argument {
            name,
            value: Value::of_text(value),
        })
        .collect();
    specula_lobes::make("smooth-conductor", &arguments).expect("a mirror")
}

/// Reflectances of two metals, from along the normal to 70 degrees.
fn same_reflectance(found: &str, truth: &str) {
    let both = [mirror(found), mirror(truth)];
    for degrees in [1.0_f64, 50.0, 70.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let wo = Vec3 {
            x: sin,
            y: 0.0,
            z: cos,
        };
        let [found, truth] = both.each_ref().map(|lobe| {
            let sample = lobe.double().sample(wo, [0.5; 3], Transport::Radiance);
            sample.expect("a reflection").weight.to_array()
        });
        for (found, truth) in found.into_iter().zip(truth) {
            near(found, truth);
        }
    }
}

#[test]
fn gold_is_found() {
    for (truth, alpha) in [
        ("conductor Au alpha 0.3", 0.3),
        ("conductor Cu alpha 0.08", 0.08),
    ] {
        let tables = tables(truth, [alpha; 2], Symmetry::Isotropic);
        let (text, found, within) = chosen(&fitted(&tables, &BOUNCES, &[FresnelModel::Index]));
        assert!(
            !text.contains("beckmann") && !text.contains("energy"),
            "{text}"
        );
        near(found[0], alpha);
        same_reflectance(&text, truth);
        assert!(within < 2.0, "{within} %");
    }
}

#[test]
fn both_alphas_of_brushed_metal_are_found() {
    let truth = "conductor Ag alpha 0.1,0.3";
    let tables = tables(truth, [0.1, 0.3], Symmetry::QuarterTurn);
    let (text, found, _) = chosen(&fitted(&tables, &[Bounces::Single], &[FresnelModel::Index]));
    near(found[0], 0.1);
    near(found[1], 0.3);
    same_reflectance(&text, truth);
}

#[test]
fn distribution_and_bounces_are_told_apart() {
    let truth = "conductor Au alpha 0.5 distribution beckmann";
    let made = tables(truth, [0.5; 2], Symmetry::Isotropic);
    let (text, found, _) = chosen(&fitted(&made, &BOUNCES, &[FresnelModel::Index]));
    assert!(
        text.contains("beckmann") && !text.contains("energy"),
        "{text}"
    );
    near(found[0], 0.5);

    let truth = "conductor Au alpha 0.6 energy kulla-conty";
    let made = tables(truth, [0.6; 2], Symmetry::Isotropic);
    let (text, found, _) = chosen(&fitted(&made, &BOUNCES, &[FresnelModel::Index]));
    assert!(
        text.contains("energy kulla-conty") && !text.contains("beckmann"),
        "{text}"
    );
    near(found[0], 0.6);
}

#[test]
fn the_f82_reflectance_is_found() {
    let truth = "conductor f0 0.9,0.6,0.3 f82_tint 0.8,0.9,1 alpha 0.4";
    let made = tables(truth, [0.4; 2], Symmetry::Isotropic);
    let fresnel = [FresnelModel::Index, FresnelModel::F82];
    let (text, found, _) = chosen(&fitted(&made, &[Bounces::Single], &fresnel));
    assert!(text.contains("f82_tint"), "{text}");
    near(found[0], 0.4);
    same_reflectance(&text, truth);
}

#[test]
fn simulated_bounces_are_found() {
    // Compensation stands for the truth: what is simulated must come nearer to it than one bounce does.
    let truth = "conductor Cu alpha 0.7 energy kulla-conty";
    let made = tables(truth, [0.7; 2], Symmetry::Isotropic);
    let both = [Bounces::Single, Bounces::All];
    let (text, found, _) = chosen(&fitted(&made, &both, &[FresnelModel::Index]));
    assert!(text.starts_with("multibounce-conductor"), "{text}");
    assert!((found[0] / 0.7 - 1.0).abs() < 0.1, "{found:?}");
}

#[test]
fn black_measurements_are_refused() {
    let mut made = tables("conductor Au alpha 0.3", [0.3; 2], Symmetry::Isotropic);
    made.rgb.fill(0.0);
    let folder = tempfile::tempdir().unwrap();
    let fit = try_fit(&made, &BOUNCES, &[FresnelModel::Index], folder.path());
    let error = fit.unwrap_err();
    assert!(error.to_string().contains("no value above 0"), "{error}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
