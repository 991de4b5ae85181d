//! Tints, the black lobe, and every distribution and masking behind the one type of lobe.

mod common;

use common::{ABOVE, alpha, few_views, plan, prove_all, views};
use specula_bsdf::bsdf::{
    Black, Compensated, CompensatedDielectric, Lobe, MultibounceConductor, MultibounceDielectric,
    Plastic, RoughConductor, RoughDielectric, SmoothConductor, SmoothDielectric, ThinDielectric,
    Tints,
};
use specula_bsdf::energy;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Rgb, Stream, rgb};
use specula_bsdf::multibounce;
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Bsdf, Event, Transport};
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, Rng, Subject, prove};

const TINTS: Tints<f64> = Tints {
    reflection: Rgb {
        r: 1.0,
        g: 0.5,
        b: 0.0,
    },
    transmission: Rgb {
        r: 0.25,
        g: 0.75,
        b: 1.0,
    },
};

fn copper() -> Reflectance<f64> {
    Reflectance::Conductor(Conductor {
        eta: rgb(0.2, 0.9, 1.1),
        k: rgb(3.9, 2.4, 2.1),
    })
}

/// `tinted` is `plain` times the colours, value for value and sample for sample.
fn hold(name: &str, plain: &Lobe<f64>, tinted: &Lobe<f64>, colours: Tints<f64>) {
    let mut rng = Rng::from_name(name);
    let mut compared = 0;
    for wo in views(&[0.9, 0.4, 0.05, -0.2]) {
        for _ in 0..200 {
            let u = rng.triple();
            for transport in [Transport::Radiance, Transport::Importance] {
                let (mut one, mut two) = (Stream::new(compared), Stream::new(compared));
                let a = plain.sample_random(wo, u, transport, &mut one);
                let b = tinted.sample_random(wo, u, transport, &mut two);
                assert_eq!(a.map(|s| (s.wi, s.pdf)), b.map(|s| (s.wi, s.pdf)), "{name}");
                let (Some(a), Some(b)) = (a, b) else { continue };
                let tint = colours.on(a.event);
                let close = |x: Rgb<f64>, y: Rgb<f64>| {
                    let off = (x - y).map(f64::abs).max_channel();
                    off <= 1e-12 * (1.0 + x.max_channel())
                };
                assert!(close(a.weight * tint, b.weight), "{name}: {a:?} {b:?}");
                let (mut one, mut two) = (Stream::new(compared), Stream::new(compared));
                let (f, pdf) = plain.eval_pdf_random(wo, a.wi, transport, &mut one);
                let (g, same) = tinted.eval_pdf_random(wo, a.wi, transport, &mut two);
                assert!(close(f * tint, g) && pdf == same, "{name}: {f:?} {g:?}");
                compared += 1;
            }
        }
    }
    assert!(compared > 500, "{name}: {compared}");
}

#[test]
fn tints_are_factors_on_either_branch() {
    let glass = |tints: Tints<f64>| -> Vec<(&str, Lobe<f64>)> {
        let (ggx, beckmann) = (
            Ggx::new(alpha((0.3, 0.5))),
            Beckmann::new(alpha((0.3, 0.5))),
        );
        let model = multibounce::MultibounceModel::default();
        vec![
            (
                "smooth",
                SmoothDielectric::new(1.5).with_tints(tints).into(),
            ),
            (
                "facing",
                SmoothDielectric::facing(1.5).with_tints(tints).into(),
            ),
            ("thin", ThinDielectric::new(1.5).with_tints(tints).into()),
            (
                "rough",
                RoughDielectric::facing(ggx, 1.5).with_tints(tints).into(),
            ),
            (
                "Beckmann",
                RoughDielectric::facing(beckmann, 1.5)
                    .with_tints(tints)
                    .into(),
            ),
            (
                "matched",
                RoughDielectric::facing(ggx, 1.0).with_tints(tints).into(),
            ),
            (
                "compensated",
                CompensatedDielectric::facing(ggx, 1.5)
                    .with_tints(tints)
                    .into(),
            ),
            (
                "compensated Beckmann",
                CompensatedDielectric::facing(beckmann, 1.5)
                    .with_tints(tints)
                    .into(),
            ),
            (
                "bounces",
                MultibounceDielectric::facing(ggx, 1.5, model)
                    .with_tints(tints)
                    .into(),
            ),
            (
                "Beckmann's bounces",
                MultibounceDielectric::facing(beckmann, 1.5, model)
                    .with_tints(tints)
                    .into(),
            ),
        ]
    };
    for ((name, plain), (_, tinted)) in glass(Tints::WHITE).iter().zip(&glass(TINTS)) {
        hold(name, plain, tinted, TINTS);
    }
}

#[test]
fn a_tinted_metal_reflects_its_tint() {
    let tint = TINTS.reflection;
    let colours = Tints {
        reflection: tint,
        transmission: Rgb::WHITE,
    };
    let metals = |reflectance: Reflectance<f64>| -> Vec<(&str, Lobe<f64>)> {
        let (ggx, beckmann) = (
            Ggx::new(alpha((0.2, 0.4))),
            Beckmann::new(alpha((0.2, 0.4))),
        );
        vec![
            ("mirror", SmoothConductor::new(reflectance).into()),
            ("rough", RoughConductor::new(ggx, reflectance).into()),
            (
                "Beckmann",
                RoughConductor::new(beckmann, reflectance)
                    .with_masking(Masking::Separable)
                    .into(),
            ),
        ]
    };
    let plain = metals(copper());
    for ((name, plain), (_, tinted)) in plain.iter().zip(&metals(copper().tinted(tint))) {
        hold(name, plain, tinted, colours);
    }
}

#[test]
fn tinted_glass_of_either_masking() {
    let cases: Vec<_> = [(0.1, 0.5), (0.6, 0.6)]
        .into_iter()
        .flat_map(|w| [(w, Masking::HeightCorrelated), (w, Masking::Separable)])
        .collect();
    prove_all("tinted glass", &cases, |&(w, masking)| {
        let ggx = RoughDielectric::new(Ggx::new(alpha(w)), 1.5)
            .with_masking(masking)
            .with_tints(TINTS);
        let beckmann = RoughDielectric::new(Beckmann::new(alpha(w)), 1.5)
            .with_masking(masking)
            .with_tints(TINTS);
        let plan = Plan {
            eta: 1.5,
            reciprocity: Domain::Everywhere,
            ..plan(w)
        };
        let views = few_views(&[0.7, -0.4]);
        let proof = |kind: &str, lobe: Lobe<f64>| {
            let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
            prove(
                &format!("{kind} {masking:?} {w:?}"),
                &subject,
                &views,
                &plan,
            )
        };
        let mut report = proof("tinted GGX", ggx.into());
        report.absorb(proof("tinted Beckmann", beckmann.into()));
        report
    });
}

#[test]
fn lobes_of_beckmann_are_what_they_hold() {
    fn same(held: &impl Bsdf<f64>, lobe: &Lobe<f64>) {
        let mut rng = Rng::new(4);
        for wo in views(&ABOVE) {
            for _ in 0..50 {
                let u = rng.triple();
                let sample = held.sample(wo, u, Transport::Radiance);
                assert_eq!(sample, lobe.sample(wo, u, Transport::Radiance));
                assert!(sample.is_none_or(|s| s.event == Event::Reflection || s.wi.z < 0.0));
            }
        }
    }
    let ndf = Beckmann::new(alpha((0.3, 0.6)));
    let conductor = RoughConductor::new(ndf, copper());
    same(&conductor, &conductor.into());
    let dielectric = RoughDielectric::new(ndf, 1.5);
    same(&dielectric, &dielectric.into());
    let compensated = Compensated::new(ndf, copper(), energy::EnergyModel::KullaConty);
    same(&compensated, &compensated.into());
    let compensated = CompensatedDielectric::new(ndf, 1.5);
    same(&compensated, &compensated.into());
    let bounces =
        MultibounceConductor::new(ndf, copper(), multibounce::MultibounceModel::default());
    same(&bounces, &bounces.into());
    let bounces = MultibounceDielectric::new(ndf, 1.5, multibounce::MultibounceModel::default());
    same(&bounces, &bounces.into());
    let white = Rgb::WHITE;
    let plastic = Plastic::rough(ndf, Masking::Separable, 1.5, white, white, true);
    same(&plastic, &plastic.into());
}

#[test]
fn black_gives_nothing() {
    let lobe = Lobe::<f64>::from(Black);
    let mut rng = Rng::new(4);
    for wo in views(&[1.0, 0.1, -0.5]) {
        assert_eq!(lobe.sample(wo, rng.triple(), Transport::Radiance), None);
        for wi in views(&[0.7, -0.7]) {
            let (f_cos, pdf) = lobe.eval_pdf(wo, wi, Transport::Radiance);
            assert!(f_cos.is_black() && pdf == 0.0);
        }
    }
    assert!(Bsdf::<f64>::is_specular(&lobe));
}
