//! The measured lobe on tables of GGX: chi-square, normalisation, weights, furnace, reciprocity, f32 and f64.

mod common;

use common::{alpha, prove_all};
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Rgb, rgb};
use specula_bsdf::measured::{Measured, MeasuredTables, Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Bsdf, Transport, Vec3};
use specula_stat::chi_square::{self, ChiSquareOptions};
use specula_stat::consistency::{self, ConsistencyOptions};
use specula_stat::quadrature::{Integral, Quadrature, direction};
use specula_stat::{DirectionSample, Report, Rng, Subject, furnace, normalisation};

const CASES: [((f64, f64), Symmetry); 4] = [
    ((0.3, 0.3), Symmetry::Isotropic),
    ((0.3, 0.6), Symmetry::Turn),
    ((0.6, 0.3), Symmetry::HalfTurn),
    ((0.3, 0.6), Symmetry::QuarterTurn),
];

/// Gold, about.
fn lobe(alphas: (f64, f64)) -> RoughConductor<f64> {
    let gold = Reflectance::Conductor(Conductor {
        eta: rgb(0.143, 0.375, 1.442),
        k: rgb(3.983, 2.386, 1.603),
    });
    RoughConductor::new(Ggx::new(alpha(alphas)), gold)
}

fn tables(alphas: (f64, f64), symmetry: Symmetry) -> MeasuredTables {
    let size = Resolution {
        theta: 6,
        phi: 9,
        normals: [12, 8],
        colours: 6,
    };
    tabulate(&Ggx::new(alpha(alphas)), &lobe(alphas), symmetry, size)
}

/// Views in other quadrants, between the tables' views.
fn views() -> Vec<Vec3<f64>> {
    let at = [(0.8, 2.1), (0.3, -2.5)];
    at.iter().map(|&(cos, phi)| direction(cos, phi)).collect()
}

/// The tables with noise, as no formula has them, in the other convention of the Jacobian.
fn noisy(mut tables: MeasuredTables) -> MeasuredTables {
    let mut rng = Rng::new(9);
    let mut noise = |values: &mut [f32]| {
        for v in values {
            #[expect(clippy::cast_possible_truncation, reason = "noise of any precision")]
            let factor = (0.5 + rng.uniform()) as f32;
            *v *= factor;
        }
    };
    noise(&mut tables.vndf.values);
    noise(&mut tables.luminance.values);
    noise(&mut tables.rgb);
    tables.jacobian = false;
    tables
}

/// Densities have a kink at every knot of the tables: cells are few, and integrals are as precise as the samples'.
fn proof(name: &str, subject: &Subject) -> Report {
    let mut report = Report::new(name);
    let mut rng = Rng::from_name(name);
    let significance = 1e-5;
    let samples = 40_000;
    let quadrature = Quadrature {
        relative_tolerance: 1e-4,
        absolute_tolerance: 2e-4,
        max_patches: 16_000,
        ..Quadrature::default()
    };
    for wo in views() {
        let view = format!("wo ({:.3}, {:.3}, {:.3})", wo.x, wo.y, wo.z);
        let fit = chi_square::test(
            |u| subject.sample_density(wo, u).map(|s| s.wi),
            |wi| subject.pdf(wo, wi),
            &mut rng,
            &ChiSquareOptions {
                samples,
                cells: 100,
                significance,
                ..ChiSquareOptions::default()
            },
        );
        report.checks.push(fit.check(&view));
        let all = normalisation::integrate_bands(&[], &quadrature, |wi| {
            let (Rgb { r, g, b }, pdf) = subject.eval_pdf(wo, wi);
            [pdf, r, g, b]
        });
        let Integral {
            value: [mass, r, g, b],
            error,
            evaluations,
            converged,
        } = all;
        let mass = Integral {
            value: [mass],
            error,
            evaluations,
            converged,
        };
        let albedo = Integral {
            value: [r, g, b],
            error,
            evaluations,
            converged,
        };
        let rng = &mut rng;
        let checks = [
            normalisation::test(&view, subject, wo, &mass, samples, significance, rng),
            furnace::test(&view, subject, wo, &albedo, samples, significance, rng),
        ];
        report.checks.extend(checks);
        let at = ConsistencyOptions {
            samples: 4000,
            // Directions carry a normal's angle to half of their digits.
            relative_tolerance: 1e-6,
        };
        let checks = [
            consistency::samples(&view, subject, wo, &at, rng),
            consistency::directions(&view, subject, wo, &at, rng),
        ];
        report.checks.extend(checks);
    }
    report
}

#[test]
fn samples_densities_and_values_agree() {
    let mut cases = Vec::new();
    for (i, (alphas, symmetry)) in CASES.into_iter().enumerate() {
        let smooth = tables(alphas, symmetry);
        if i % 2 == 1 {
            let name = format!("noise on {alphas:?} {symmetry:?}");
            cases.push((name, noisy(smooth)));
        } else {
            cases.push((format!("{alphas:?} {symmetry:?}"), smooth));
        }
    }
    prove_all("measured", &cases, |(name, tables)| {
        let measured = Measured::<f64>::new(tables).unwrap();
        proof(name, &Subject::from_bsdf(&measured, Transport::Radiance))
    });
}

/// Values and densities of other tables than those of the samples, a density that is 3 % too high, a lobe that is not
/// turned with an anisotropic view.
#[test]
fn faults_are_noticed() {
    let (alphas, symmetry) = CASES[3];
    let smooth = tables(alphas, symmetry);
    let mut dented = smooth.clone();
    let nodes = dented.luminance.values.len() / 2;
    dented.luminance.values[nodes..]
        .iter_mut()
        .for_each(|v| *v *= 0.9);
    for v in dented.luminance.values.iter_mut().step_by(5) {
        *v *= 1.5;
    }
    let of = |tables| Measured::<f64>::new(tables).unwrap();
    let (right, wrong) = (of(&smooth), of(&dented));
    let r = Transport::Radiance;
    let turned = |w: Vec3<f64>| Vec3 {
        x: -w.y,
        y: w.x,
        z: w.z,
    };
    type Pdf<'a> = &'a (dyn Fn(Vec3<f64>, Vec3<f64>) -> f64 + Sync);
    let pdfs: [(&str, Pdf<'_>); 4] = [
        ("none", &|wo, wi| right.pdf(wo, wi)),
        ("other tables", &|wo, wi| wrong.pdf(wo, wi)),
        ("scale", &|wo, wi| 1.03 * right.pdf(wo, wi)),
        ("turn", &|wo, wi| right.pdf(turned(wo), turned(wi))),
    ];
    for (fault, pdf) in pdfs {
        let subject = Subject::new(
            |wo, wi| right.eval(wo, wi, r),
            pdf,
            |wo, u| {
                let s = right.sample(wo, u, r)?;
                Some(DirectionSample::new(s.wi, s.weight))
            },
        );
        let report = proof(fault, &subject);
        let failed = report.failures().count();
        assert_eq!(failed == 0, fault == "none", "{fault}: {failed}");
    }
}

#[test]
fn single_precision_is_double_precision() {
    prove_all("measured twins", &CASES, |&(alphas, symmetry)| {
        let tables = tables(alphas, symmetry);
        let single = Measured::<f32>::new(&tables).unwrap();
        let double = Measured::<f64>::new(&tables).unwrap();
        common::twins_from(
            &format!("{alphas:?} {symmetry:?}"),
            &single,
            &double,
            Transport::Radiance,
            0.0,
        )
    });
}

/// Albedo by samples of each view.
fn albedo(lobe: &impl Bsdf<f64>, wo: Vec3<f64>) -> Rgb<f64> {
    let mut rng = Rng::new(4);
    let n = 20_000;
    let mut sum = Rgb::splat(0.0);
    for _ in 0..n {
        if let Some(s) = lobe.sample(wo, rng.triple(), Transport::Radiance) {
            sum += s.weight / f64::from(n);
        }
    }
    sum
}

/// A surface that loses nothing but what its facets shadow, and the same as tables.
#[test]
fn furnaces_are_no_brighter_than_the_lobe_s() {
    for alphas in [(0.2, 0.2), (0.6, 0.6)] {
        let ndf = Ggx::new(alpha(alphas));
        let white = RoughConductor::new(ndf, Reflectance::Constant(Rgb::WHITE));
        let tables = tabulate(&ndf, &white, Symmetry::Isotropic, Resolution::default());
        let measured = Measured::<f64>::new(&tables).unwrap();
        for cos in [1.0, 0.7, 0.4] {
            let wo = direction(cos, 0.9);
            let (expected, found) = (albedo(&white, wo).g, albedo(&measured, wo).g);
            assert!(
                (found - expected).abs() < 0.02,
                "{alphas:?}, {cos}: {found} {expected}"
            );
            assert!(found < 1.01, "{alphas:?}, {cos}: {found}");
        }
    }
}

/// As far as the interpolation lets it be.
#[test]
fn tables_of_a_reciprocal_lobe_are_reciprocal() {
    let alphas = (0.4, 0.4);
    let tables = tabulate(
        &Ggx::new(alpha(alphas)),
        &lobe(alphas),
        Symmetry::Isotropic,
        Resolution {
            theta: 32,
            normals: [128, 64],
            ..Resolution::default()
        },
    );
    let measured = Measured::<f64>::new(&tables).unwrap();
    let mut rng = Rng::new(2);
    for _ in 0..400 {
        let mut w = || direction(0.3 + 0.7 * rng.uniform(), 6.0 * rng.uniform());
        let (a, b) = (w(), w());
        let f = |wo, wi: Vec3<f64>| measured.eval(wo, wi, Transport::Radiance).g / wi.z;
        let (ab, ba) = (f(a, b), f(b, a));
        assert!(
            (ab - ba).abs() < 0.03 * ab.max(ba) + 1e-3,
            "{ab} {ba} at {a:?} {b:?}"
        );
    }
}

#[test]
fn nothing_is_seen_from_below_and_nothing_goes_there() {
    let measured = Measured::<f32>::new(&tables((0.5, 0.5), Symmetry::Isotropic)).unwrap();
    let (up, down) = (direction(0.6, 1.0).cast(), direction(-0.6, 1.0).cast());
    for (wo, wi) in [(down, up), (up, down), (down, down)] {
        assert!(measured.eval(wo, wi, Transport::Radiance).is_black());
        assert_eq!(measured.pdf(wo, wi), 0.0);
    }
    assert!(
        measured
            .sample(down, [0.5; 3], Transport::Radiance)
            .is_none()
    );
}

#[test]
fn tables_that_fit_nothing_are_refused() {
    type Change = fn(&mut MeasuredTables);
    let changes: [(Change, &str); 9] = [
        (|t| t.theta_i.clear(), "\"theta_i\" has 0 values"),
        (|t| t.theta_i.swap(0, 1), "\"theta_i\" does not ascend"),
        (|t| t.theta_i[5] = 3.0, "\"theta_i\" has the angle 3"),
        (|t| t.phi_i[8] = -1.2, "\"phi_i\" covers"),
        (|t| t.ndf.size = [1, 96], "\"ndf\" has 96 x 1 nodes"),
        (|t| t.vndf.values.truncate(5), "\"vndf\" has 5 values"),
        (
            |t| t.luminance.values[3] = f32::NAN,
            "\"luminance\" has the value NaN at 3",
        ),
        (|t| t.rgb.truncate(7), "\"rgb\" has 7 values"),
        (|t| t.sigma.size = [usize::MAX; 2], "\"sigma\" has"),
    ];
    for (change, expected) in changes {
        let mut tables = tables((0.2, 0.5), Symmetry::QuarterTurn);
        change(&mut tables);
        let error = Measured::<f64>::new(&tables).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}
