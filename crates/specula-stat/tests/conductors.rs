//! Rough metals: every sampler, masking and distribution, from above and below the horizon.

mod common;

use common::{alpha, alpha_f32, both_sides, few_views, plan, prove_all, views, with_alphas};
use specula_bsdf::bsdf::{RoughConductor, SmoothConductor};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Real, rgb};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Bsdf, Rgb, Transport};
use specula_stat::quadrature::direction;
use specula_stat::{Report, Rng, Subject, prove};

/// Gold, about.
fn gold<T: Real>() -> Reflectance<T> {
    let colour = |r, g, b| rgb(T::of(r), T::of(g), T::of(b));
    Reflectance::Conductor(Conductor {
        eta: colour(0.143, 0.375, 1.442),
        k: colour(3.983, 2.386, 1.603),
    })
}

fn proof(name: &str, lobe: &(impl Bsdf<f64> + Sync), alphas: (f64, f64), few: bool) -> Report {
    let subject = Subject::from_bsdf(lobe, Transport::Radiance);
    let views = if few {
        few_views(&both_sides())
    } else {
        views(&both_sides())
    };
    prove(name, &subject, &views, &plan(alphas))
}

#[test]
fn ggx_with_every_sampler() {
    let samplers = [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ];
    prove_all(
        "rough conductor",
        &with_alphas(&samplers),
        |&(sampler, alphas)| {
            let lobe = RoughConductor::new(Ggx::new(alpha(alphas)), gold()).with_sampler(sampler);
            proof(
                &format!("conductor {sampler} {alphas:?}"),
                &lobe,
                alphas,
                false,
            )
        },
    );
}

#[test]
fn separable_masking() {
    prove_all("separable", &with_alphas(&[()]), |&((), alphas)| {
        let lobe =
            RoughConductor::new(Ggx::new(alpha(alphas)), gold()).with_masking(Masking::Separable);
        proof(&format!("separable {alphas:?}"), &lobe, alphas, true)
    });
}

#[test]
fn beckmann() {
    let maskings = [Masking::HeightCorrelated, Masking::Separable];
    prove_all("beckmann", &with_alphas(&maskings), |&(masking, alphas)| {
        let lobe = RoughConductor::new(Beckmann::new(alpha(alphas)), gold()).with_masking(masking);
        proof(
            &format!("Beckmann {masking:?} {alphas:?}"),
            &lobe,
            alphas,
            true,
        )
    });
}

#[test]
fn f32_is_f64() {
    let samplers = [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ];
    prove_all(
        "conductor twins",
        &with_alphas(&samplers),
        |&(sampler, alphas)| {
            let single = RoughConductor::new(Ggx::new(alpha_f32(alphas)), gold::<f32>())
                .with_sampler(sampler);
            let double =
                RoughConductor::new(Ggx::new(alpha(alphas)), gold::<f64>()).with_sampler(sampler);
            common::twins(
                &format!("{sampler} {alphas:?}"),
                &single,
                &double,
                Transport::Radiance,
            )
        },
    );
}

#[test]
fn a_mirror_is_a_mirror() {
    let mirror = SmoothConductor::new(Reflectance::Constant(Rgb::splat(0.8_f64)));
    let subject = Subject::from_bsdf(&mirror, Transport::Radiance);
    let mut rng = Rng::new(5);
    for cos_theta in common::ABOVE {
        let wo = direction(cos_theta, 2.1);
        let sampled = subject.sample(wo, rng.triple()).unwrap();
        assert!(sampled.is_specular);
        assert_eq!(sampled.wi.to_array(), [-wo.x, -wo.y, wo.z]);
        assert_eq!(sampled.weight, Rgb::splat(0.8));
        assert!(subject.eval(wo, sampled.wi).is_black() && subject.pdf(wo, sampled.wi) == 0.0);
    }
}
