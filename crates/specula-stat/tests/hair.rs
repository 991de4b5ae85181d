//! Hair: chi-square, normalisation, weights, furnace, symmetry, `f32` and `f64`, rays through a smooth cylinder,
//! extremes.

mod common;

use common::{plan, prove_all};
use specula_bsdf::fresnel::{dielectric, refract};
use specula_bsdf::hair::{Hair, HairParameters, absorption_of_colour, absorption_of_melanin};
use specula_bsdf::math::{Real, Rgb, Vec3, rgb, vec3};
use specula_bsdf::{Bsdf, Transport};
use specula_stat::quadrature::direction;
use specula_stat::reciprocity::Domain;
use specula_stat::{DirectionSample, Plan, Report, Rng, Subject, prove};

const RADIANCE: Transport = Transport::Radiance;

/// A fibre, and the offset of the view where it does not follow from the normal.
#[derive(Clone, Copy, Debug)]
struct Case {
    beta: [f64; 2],
    alpha_deg: f64,
    eta: f64,
    sigma_a: Rgb<f64>,
    h: Option<f64>,
}

fn cases() -> Vec<Case> {
    let brown = absorption_of_melanin(1.3, 0.0);
    let red = absorption_of_colour(rgb(0.9, 0.2, 0.05), 0.6);
    let case = |beta, alpha_deg, eta, sigma_a, h| Case {
        beta,
        alpha_deg,
        eta,
        sigma_a,
        h,
    };
    vec![
        case([0.3, 0.3], 2.0, 1.55, brown, None),
        case([0.3, 0.3], 2.0, 1.55, Rgb::BLACK, Some(0.5)),
        case([0.2, 0.6], -5.0, 1.55, red, Some(-0.9)),
        case([0.8, 0.2], 0.0, 1.3, brown * 0.1, None),
        case([1.0, 1.0], 10.0, 2.0, red, Some(0.99)),
        case([0.5, 0.9], 3.0, 1.55, brown * 20.0, Some(0.0)),
    ]
}

impl Case {
    fn parameters<T: Real>(&self) -> HairParameters<T> {
        HairParameters {
            sigma_a: self.sigma_a.cast(),
            eta: T::of(self.eta),
            beta_m: T::of(self.beta[0]),
            beta_n: T::of(self.beta[1]),
            alpha_deg: T::of(self.alpha_deg),
        }
    }

    fn lobe<T: Real>(&self) -> Hair<T> {
        let hair = Hair::new(&self.parameters());
        self.h.map_or(hair, |h| hair.at_offset(T::of(h)))
    }
}

/// From the grid of the proofs, whose pole is z, to the lobe, whose fibre is x: inclinations and azimuths are its
/// sides.
fn along_x(w: Vec3<f64>) -> Vec3<f64> {
    vec3(w.z, w.x, w.y)
}

fn along_z(w: Vec3<f64>) -> Vec3<f64> {
    vec3(w.y, w.z, w.x)
}

type Pdf<'a> = &'a (dyn Fn(Vec3<f64>, Vec3<f64>) -> f64 + Sync);

/// The lobe with its fibre along z, and another density.
fn subject<'a>(hair: &'a Hair<f64>, pdf: Pdf<'a>) -> Subject<'a> {
    Subject::new(
        |wo, wi| hair.eval(along_x(wo), along_x(wi), RADIANCE),
        move |wo, wi| pdf(along_x(wo), along_x(wi)),
        |wo, u| {
            let s = hair.sample(along_x(wo), u, RADIANCE)?;
            Some(DirectionSample {
                pdf: Some(s.pdf),
                ..DirectionSample::new(along_z(s.wi), s.weight)
            })
        },
    )
}

fn proof(name: &str, subject: &Subject, inclinations: &[f64]) -> Report {
    let views: Vec<_> = (inclinations.iter().zip([0.3, 1.2, 2.8, -2.0]))
        .map(|(&sin, azimuth)| direction(sin, azimuth))
        .collect();
    let plan = Plan {
        reciprocity: Domain::Nowhere,
        samples: 30_000,
        cells: 200,
        ..plan((0.3, 0.3))
    };
    prove(name, subject, &views, &plan)
}

#[test]
fn samples_densities_and_values_agree() {
    prove_all("hair", &cases(), |case| {
        let hair = case.lobe::<f64>();
        let pdf = |wo, wi| hair.pdf(wo, wi);
        proof(&format!("{case:?}"), &subject(&hair, &pdf), &[0.0, -0.8])
    });
}

/// A density that is 3 % too high, one of another fibre, of a fibre whose scales lie flat, and of the mirrored offset.
#[test]
fn faults_are_noticed() {
    let case = cases()[0];
    let hair = case.lobe::<f64>();
    let of = |case: Case| case.lobe::<f64>();
    let rougher = of(Case {
        beta: [0.32, 0.3],
        ..case
    });
    let flat = of(Case {
        alpha_deg: 0.0,
        ..case
    });
    let mirrored = |w: Vec3<f64>| vec3(w.x, -w.y, w.z);
    let pdfs: [(&str, Pdf<'_>); 5] = [
        ("none", &|wo, wi| hair.pdf(wo, wi)),
        ("scale", &|wo, wi| 1.03 * hair.pdf(wo, wi)),
        ("roughness", &|wo, wi| rougher.pdf(wo, wi)),
        ("tilt", &|wo, wi| flat.pdf(wo, wi)),
        ("offset", &|wo, wi| hair.pdf(mirrored(wo), wi)),
    ];
    for (fault, pdf) in pdfs {
        let report = proof(fault, &subject(&hair, pdf), &[0.4]);
        let failed = report.failures().count();
        assert_eq!(failed == 0, fault == "none", "{fault}: {failed}");
    }
}

#[test]
fn single_precision_is_double_precision() {
    prove_all("hair twins", &cases(), |case| {
        let (single, double) = (case.lobe::<f32>(), case.lobe::<f64>());
        common::twins(&format!("{case:?}"), &single, &double, RADIANCE)
    });
}

/// Without absorption every sample has weight 1, from the smoothest fibre to the roughest, over all offsets.
#[test]
fn white_fibres_lose_nothing() {
    let mut rng = Rng::new(5);
    for beta in [0.0, 0.05, 0.3, 1.0] {
        for h in [None, Some(-1.0), Some(-0.999), Some(0.3), Some(1.0)] {
            let case = Case {
                beta: [beta, 1.0 - beta],
                alpha_deg: 2.0,
                eta: 1.55,
                sigma_a: Rgb::BLACK,
                h,
            };
            let (single, double) = (case.lobe::<f32>(), case.lobe::<f64>());
            for _ in 0..200 {
                let wo = along_x(direction(2.0 * rng.uniform() - 1.0, 7.0 * rng.uniform()));
                let u = rng.triple();
                let s = double.sample(wo, u, RADIANCE).expect("nothing is rejected");
                assert!(
                    (s.weight - Rgb::WHITE).map(f64::abs).max_channel() < 1e-9,
                    "{case:?}"
                );
                #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
                let s = single.sample(wo.cast(), u.map(|u| u as f32), RADIANCE);
                let weight = s.expect("nothing is rejected").weight.cast::<f64>();
                assert!(
                    (weight - Rgb::WHITE).map(f64::abs).max_channel() < 1e-5,
                    "{case:?}"
                );
            }
        }
    }
}

/// Albedo at most 1 and falling with the absorption; weights at most 3, also of colours that hardly share a lobe.
#[test]
fn energy_and_weights_are_bounded() {
    let mut rng = Rng::new(6);
    let albedo = |hair: &Hair<f64>, wo, rng: &mut Rng| {
        let n = 4000;
        let mut sum = Rgb::BLACK;
        for _ in 0..n {
            if let Some(s) = hair.sample(wo, rng.triple(), RADIANCE) {
                assert!(s.weight.max_channel() <= 3.0 + 1e-9, "{s:?}");
                sum += s.weight / f64::from(n);
            }
        }
        sum
    };
    for case in cases() {
        let mut before = 1.01;
        for scale in [0.0, 0.3, 1.0, 10.0, 1e6] {
            let sigma_a = rgb(2.0, 0.05, 0.3) * scale;
            let hair = Case { sigma_a, ..case }.lobe();
            let found = albedo(&hair, along_x(direction(0.4, 1.0)), &mut rng);
            assert!(found.r < before + 0.02, "{case:?}, {scale}: {found:?}");
            before = found.r;
        }
    }
}

/// Mirrored at the plane of the fibre and the normal, with its offset: the same. Without a tilt and averaged over
/// offsets, that is reciprocity between directions of one inclination. With a tilt there is none.
#[test]
fn mirror_images_are_the_same_and_scales_are_one_way() {
    let mut rng = Rng::new(7);
    let mirrored = |w: Vec3<f64>| vec3(w.x, -w.y, w.z);
    for case in cases() {
        let hair = case.lobe::<f64>();
        let other = case.h.map_or(hair, |h| hair.at_offset(-h));
        for _ in 0..100 {
            let mut any = || along_x(direction(2.0 * rng.uniform() - 1.0, 7.0 * rng.uniform()));
            let (wo, wi) = (any(), any());
            let (a, b) = (
                hair.eval(wo, wi, RADIANCE).g,
                other.eval(mirrored(wo), mirrored(wi), RADIANCE).g,
            );
            assert!((a - b).abs() <= 1e-9 * a.max(1e-9), "{case:?}: {a} {b}");
        }
    }
    let over_offsets = |alpha_deg, wo, wi| {
        let fibre = Case {
            alpha_deg,
            h: None,
            ..cases()[0]
        };
        let at = |i: i32| f64::from(i) / 500.0 - 0.999;
        let of = |i| {
            fibre
                .lobe::<f64>()
                .at_offset(at(i))
                .eval(wo, wi, RADIANCE)
                .g
        };
        (0..1000).map(of).sum::<f64>() / 1000.0
    };
    let (a, b) = (along_x(direction(0.5, 0.4)), along_x(direction(0.5, 2.1)));
    let (there, back) = (over_offsets(0.0, a, b), over_offsets(0.0, b, a));
    assert!((there / back - 1.0).abs() < 1e-9, "{there} {back}");
    let c = along_x(direction(-0.6, 2.1));
    let (there, back) = (over_offsets(4.0, a, c), over_offsets(4.0, c, a));
    assert!((there / back - 1.0).abs() > 0.02, "{there} {back}");
}

/// Where light leaves a smooth cylinder about x after 0, 1 and 2 passages, and how much of it: vectors refracted and
/// reflected at points of the cylinder.
fn traced(wo: Vec3<f64>, eta: f64, sigma: f64) -> [(Vec3<f64>, f64); 3] {
    let mirror = |w: Vec3<f64>, n: Vec3<f64>| w - n * (2.0 * w.dot(n));
    let n = Vec3::Z;
    let at = dielectric(wo.dot(n), eta);
    let outside = mirror(-wo, n);
    let mut within = refract(wo, n, wo.dot(n), at.cos_t, eta);
    let mut power = at.transmittance;
    let mut normal = n;
    let mut leaving = [(outside, at.reflectance); 3];
    for exit in &mut leaving[1..] {
        // From one point of the unit circle to the other: |p + t d| = 1 across x.
        let across = within.y * within.y + within.z * within.z;
        let t = -2.0 * (normal.y * within.y + normal.z * within.z) / across;
        power *= (-sigma * t).exp();
        normal = vec3(0.0, normal.y + t * within.y, normal.z + t * within.z);
        let cos = within.dot(normal);
        let surface = dielectric(cos, 1.0 / eta);
        let out = refract(-within, -normal, cos, surface.cos_t, 1.0 / eta);
        *exit = (out, power * surface.transmittance);
        power *= surface.reflectance;
        within = mirror(within, normal);
    }
    leaving
}

/// The smoothest fibre without a tilt sends light where rays through a cylinder leave it, and as much.
#[test]
fn smooth_fibres_are_cylinders() {
    let (eta, sigma) = (1.55, 0.4);
    let hair = Hair::new(&HairParameters {
        sigma_a: Rgb::splat(sigma),
        eta,
        beta_m: 0.01,
        beta_n: 0.01,
        alpha_deg: 0.0,
    });
    let mut rng = Rng::new(8);
    let n = 40_000;
    for wo in [
        vec3(0.0, 0.35, 0.9),
        vec3(0.6, -0.5, 0.4),
        vec3(-0.3, 0.1, 0.9),
    ] {
        let wo = wo.normalize();
        let exits = traced(wo, eta, sigma);
        let mut found = [0.0; 3];
        for _ in 0..n {
            let s = hair.sample(wo, rng.triple(), RADIANCE).expect("smooth");
            // 0.05 is 9 deviations of the widest lobe; the residue is spread over the turn.
            if let Some(p) = exits.iter().position(|e| (e.0 - s.wi).length() < 0.05) {
                found[p] += s.weight.g / f64::from(n);
            }
        }
        for (found, (wi, expected)) in found.iter().zip(exits) {
            let sigma = (expected / f64::from(n)).sqrt();
            assert!(
                (found - expected).abs() < 5.0 * sigma + 2e-3,
                "{wi:?}: {found} {expected}"
            );
        }
    }
}

/// Whatever the parameters and directions, values are finite and not negative.
fn hold_extremes<T: Real>() {
    let of = |xs: &[f64]| xs.iter().map(|&x| T::of(x)).collect::<Vec<_>>();
    let tiny = f64::from(f32::MIN_POSITIVE);
    let directions = [
        vec3(1.0, 0.0, 0.0),
        vec3(-1.0, 0.0, 0.0),
        vec3(1.0, tiny, -tiny),
        vec3(0.0, 1.0, 0.0),
        vec3(0.0, 0.0, -1.0),
        vec3(-0.6, 0.0, 0.8),
        vec3(0.6, -0.8, 1e-20),
    ]
    .map(|w| w.cast::<T>());
    let us = [[0.0; 3], [1.0 - 1e-7; 3], [0.5; 3]].map(|u: [f64; 3]| u.map(T::of));
    let odd = [f64::NAN, f64::INFINITY, -1.0, 0.0];
    for beta in of(&[&odd[..], &[0.3, 1.0, 9.0]].concat()) {
        for eta in of(&[&odd[..], &[0.5, 1.0, 1.55, 1e9]].concat()) {
            for sigma in of(&[&odd[..], &[0.3, 1e30]].concat()) {
                for h in [None, Some(1.0), Some(-1.0), Some(0.2), Some(f64::NAN)] {
                    let hair = Hair::new(&HairParameters {
                        sigma_a: rgb(sigma, T::ZERO, T::ONE),
                        eta,
                        beta_m: beta,
                        beta_n: beta,
                        alpha_deg: beta * T::of(30.0),
                    });
                    let hair = h.map_or(hair, |h| hair.at_offset(T::of(h)));
                    hold(&hair, &directions, &us);
                }
            }
        }
    }
}

fn hold<T: Real>(hair: &Hair<T>, directions: &[Vec3<T>], us: &[[T; 3]]) {
    let is_good = |value: Rgb<T>, pdf: T| {
        let least = value.to_array().into_iter().all(|v| v >= T::ZERO);
        value.is_finite() && pdf.is_finite() && least && pdf >= T::ZERO
    };
    for &wo in directions {
        for &wi in directions {
            let (value, pdf) = hair.eval_pdf(wo, wi, RADIANCE);
            assert!(
                is_good(value, pdf),
                "{hair:?} {wo:?} {wi:?}: {value:?} {pdf:?}"
            );
        }
        for &u in us {
            if let Some(s) = hair.sample(wo, u, RADIANCE) {
                assert!(is_good(s.weight, s.pdf), "{hair:?} {wo:?} {u:?}: {s:?}");
                assert!(
                    s.pdf > T::ZERO && s.wi.is_finite(),
                    "{hair:?} {wo:?} {u:?}: {s:?}"
                );
            }
        }
    }
}

#[test]
fn extremes_are_finite() {
    hold_extremes::<f32>();
    hold_extremes::<f64>();
}
