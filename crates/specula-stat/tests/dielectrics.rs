//! Dielectric interfaces: rough and smooth, from both sides, facing, radiance and importance.

mod common;

use common::{ABOVE, ALPHAS, BELOW, ETAS, alpha, alpha_f32, few_views, plan, prove_all};
use specula_bsdf::bsdf::{RoughDielectric, SmoothDielectric, ThinDielectric};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Bsdf, Event, Transport, Vec3};
use specula_stat::quadrature::direction;
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, Rng, Subject, prove};

/// Above, and the same cosines below: the inside of a two-sided interface.
fn outside_and_inside() -> Vec<Vec3<f64>> {
    let cosines: Vec<f64> = ABOVE.into_iter().chain(ABOVE.map(|c| -c)).collect();
    few_views(&cosines)
}

fn cases() -> Vec<(f64, (f64, f64))> {
    ETAS.iter()
        .flat_map(|&eta| ALPHAS.map(|alphas| (eta, alphas)))
        .collect()
}

fn two_sided(eta: f64, alphas: (f64, f64), transport: Transport) -> Plan {
    Plan {
        eta,
        transport,
        reciprocity: Domain::Everywhere,
        // The half vector of refraction loses digits where the indices are close.
        relative_tolerance: 1e-8,
        samples: 50_000,
        cells: 200,
        ..plan(alphas)
    }
}

#[test]
fn two_sided_ggx_carrying_radiance() {
    prove_all("dielectric", &cases(), |&(eta, alphas)| {
        let lobe = RoughDielectric::new(Ggx::new(alpha(alphas)), eta);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let plan = two_sided(eta, alphas, Transport::Radiance);
        let name = format!("dielectric {eta:.3} {alphas:?}");
        prove(&name, &subject, &outside_and_inside(), &plan)
    });
}

#[test]
fn two_sided_ggx_carrying_importance() {
    let some: Vec<_> = cases().into_iter().step_by(4).collect();
    prove_all("adjoint dielectric", &some, |&(eta, alphas)| {
        let lobe = RoughDielectric::new(Ggx::new(alpha(alphas)), eta);
        let subject = Subject::from_bsdf(&lobe, Transport::Importance);
        let plan = two_sided(eta, alphas, Transport::Importance);
        let name = format!("adjoint dielectric {eta:.3} {alphas:?}");
        prove(&name, &subject, &outside_and_inside(), &plan)
    });
}

#[test]
fn two_sided_with_the_branch_first() {
    let some: Vec<_> = cases().into_iter().step_by(4).collect();
    for (sampler, cases) in [(Sampler::Bounded, &some[..]), (Sampler::Exact, &some[..4])] {
        prove_all("branch first", cases, |&(eta, alphas)| {
            let lobe = RoughDielectric::new(Ggx::new(alpha(alphas)), eta).with_sampler(sampler);
            let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
            let plan = two_sided(eta, alphas, Transport::Radiance);
            let name = format!("{sampler} dielectric {eta:.3} {alphas:?}");
            prove(&name, &subject, &outside_and_inside(), &plan)
        });
    }
}

#[test]
fn two_sided_beckmann_and_separable() {
    let some: Vec<_> = cases().into_iter().step_by(5).collect();
    prove_all("Beckmann dielectric", &some, |&(eta, alphas)| {
        let lobe = RoughDielectric::new(Beckmann::new(alpha(alphas)), eta)
            .with_masking(Masking::Separable);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let plan = two_sided(eta, alphas, Transport::Radiance);
        let name = format!("Beckmann dielectric {eta:.3} {alphas:?}");
        prove(&name, &subject, &outside_and_inside(), &plan)
    });
}

#[test]
fn facing_with_backfacing_views() {
    let cosines: Vec<f64> = [0.7, 0.05].into_iter().chain(BELOW).collect();
    prove_all("facing dielectric", &cases(), |&(eta, alphas)| {
        let lobe = RoughDielectric::facing(Ggx::new(alpha(alphas)), eta);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let plan = Plan {
            // It knows one side: the other side's adjoint is another lobe.
            reciprocity: Domain::Above,
            ..two_sided(eta, alphas, Transport::Radiance)
        };
        let name = format!("facing dielectric {eta:.3} {alphas:?}");
        prove(&name, &subject, &few_views(&cosines), &plan)
    });
}

#[test]
fn importance_is_the_adjoint_of_radiance() {
    let lobe = RoughDielectric::new(Ggx::new(alpha((0.3, 0.6))), 1.5);
    let mut rng = Rng::new(11);
    let mut compared = 0;
    for _ in 0..10_000 {
        let mut any = || {
            direction(
                2.0 * rng.uniform() - 1.0,
                std::f64::consts::TAU * rng.uniform(),
            )
        };
        let (wo, wi) = (any(), any());
        let there = lobe.eval(wo, wi, Transport::Radiance).r / wi.z.abs();
        let back = lobe.eval(wi, wo, Transport::Importance).r / wo.z.abs();
        assert!(
            (there - back).abs() <= 1e-8 * there.max(back) + 1e-12,
            "{wo:?} {wi:?}"
        );
        compared += u32::from(there > 0.0);
    }
    assert!(compared > 1000);
}

#[test]
fn no_side_of_an_interface_makes_light() {
    for &(eta, alphas) in &cases() {
        let lobe = RoughDielectric::new(Ggx::new(alpha(alphas)), eta);
        let mut rng = Rng::new(12);
        for wo in outside_and_inside() {
            for _ in 0..500 {
                if let Some(sample) = lobe.sample(wo, rng.triple(), Transport::Importance) {
                    assert!(
                        sample.weight.max_channel() <= 1.0 + 1e-12,
                        "{wo:?} {sample:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn f32_is_f64() {
    prove_all("dielectric twins", &cases(), |&(eta, alphas)| {
        #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
        let single = RoughDielectric::new(Ggx::new(alpha_f32(alphas)), eta as f32);
        let double = RoughDielectric::new(Ggx::new(alpha(alphas)), eta);
        common::twins(
            &format!("{eta:.3} {alphas:?}"),
            &single,
            &double,
            Transport::Radiance,
        )
    });
}

/// Reflectance of an interface, by the formulas of a textbook (Born and Wolf, section 1.5.2).
fn textbook_reflectance(cos: f64, eta: f64) -> f64 {
    let sin_t = (1.0 - cos * cos).sqrt() / eta;
    if sin_t >= 1.0 {
        return 1.0;
    }
    let (i, t) = (cos.acos(), sin_t.asin());
    if i < 1e-9 {
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let s = ((i - t).sin() / (i + t).sin()).powi(2);
    let p = ((i - t).tan() / (i + t).tan()).powi(2);
    0.5 * (s + p)
}

#[test]
fn smooth_interfaces_split_light_as_fresnel_says() {
    for eta in ETAS {
        let lobe = SmoothDielectric::new(eta);
        for wo in outside_and_inside() {
            let seen = if wo.z < 0.0 { 1.0 / eta } else { eta };
            let reflectance = textbook_reflectance(wo.z.abs(), seen);
            let mut reflected = 0.0;
            let sample_count = 1000;
            for k in 0..sample_count {
                let u = [(f64::from(k) + 0.5) / f64::from(sample_count), 0.5, 0.5];
                let Some(sample) = lobe.sample(wo, u, Transport::Importance) else {
                    panic!("a smooth interface rejects nothing: {wo:?}")
                };
                assert!(sample.specular);
                assert!((sample.wi.length() - 1.0).abs() < 1e-9);
                // Importance: all light goes on, whichever branch.
                assert!((sample.weight.r - 1.0).abs() < 1e-9, "{sample:?}");
                let side = sample.wi.z * wo.z;
                assert_eq!(sample.event == Event::Reflection, side > 0.0);
                reflected += f64::from(u8::from(sample.event == Event::Reflection));
            }
            let share = reflected / f64::from(sample_count);
            assert!(
                (share - reflectance).abs() < 1.1e-3,
                "{wo:?} {eta}: {share}"
            );
        }
    }
}

#[test]
fn thin_panes_reflect_as_a_pile_of_two() {
    for eta in ETAS {
        let lobe = ThinDielectric::new(eta);
        for wo in outside_and_inside() {
            let f = textbook_reflectance(wo.z.abs(), eta);
            let expected = if f >= 1.0 { 1.0 } else { 2.0 * f / (1.0 + f) };
            let sample_count = 1000;
            let mut reflected = 0.0;
            for k in 0..sample_count {
                let u = [(f64::from(k) + 0.5) / f64::from(sample_count), 0.5, 0.5];
                let sample = lobe.sample(wo, u, Transport::Radiance).unwrap();
                assert!((sample.weight.r - 1.0).abs() < 1e-9);
                let through = sample.event == Event::Transmission;
                assert!(!through || (sample.wi + wo).length() < 1e-12);
                reflected += f64::from(u8::from(!through));
            }
            assert!(
                (reflected / f64::from(sample_count) - expected).abs() < 1.1e-3,
                "{wo:?} {eta}"
            );
        }
    }
}
