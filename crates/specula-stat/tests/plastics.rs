//! Mitsuba's plastics: a dielectric coat over Lambert.

mod common;

use common::{ABOVE, alpha, alpha_f32, few_views, plan, prove_all, views};
use specula_bsdf::bsdf::Plastic;
use specula_bsdf::math::{Real, rgb};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Bsdf, Rgb, Transport};
use specula_stat::quadrature::Quadrature;
use specula_stat::{Report, Subject, furnace, prove};

const ALPHAS: [(f64, f64); 4] = [(0.05, 0.05), (0.3, 0.3), (1.0, 1.0), (0.1, 0.4)];

fn diffuse<T: Real>() -> Rgb<T> {
    rgb(T::of(0.8), T::of(0.4), T::of(0.1))
}

fn specular<T: Real>() -> Rgb<T> {
    rgb(T::ONE, T::of(0.7), T::ZERO)
}

fn proof(name: &str, lobe: &(impl Bsdf<f64> + Sync), alphas: (f64, f64)) -> Report {
    let subject = Subject::from_bsdf(lobe, Transport::Radiance);
    prove(name, &subject, &few_views(&ABOVE), &plan(alphas))
}

#[test]
fn rough_coats_of_either_distribution_and_masking() {
    prove_all("plastics", &ALPHAS, |&w| {
        let (eta, nonlinear) = (1.5, w.0 > 0.2);
        let ggx = Ggx::new(alpha(w));
        let separable = Masking::Separable;
        let ggx = Plastic::rough(ggx, separable, eta, diffuse(), specular(), nonlinear);
        let beckmann = Beckmann::new(alpha(w));
        let correlated = Masking::HeightCorrelated;
        let beckmann = Plastic::rough(beckmann, correlated, eta, diffuse(), specular(), nonlinear);
        let mut report = proof(&format!("plastic {w:?}"), &ggx, w);
        report.absorb(proof(&format!("Beckmann plastic {w:?}"), &beckmann, w));
        report
    });
}

#[test]
fn smooth_coats() {
    prove_all("smooth plastics", &[0.7, 1.5], |&eta| {
        let lobe = Plastic::smooth(eta, diffuse(), specular(), eta > 1.4);
        proof(&format!("smooth plastic {eta}"), &lobe, (1.0, 1.0))
    });
}

#[test]
fn backfacing_views_follow_the_density() {
    prove_all("plastics from below", &ALPHAS, |&w| {
        let ggx = Ggx::new(alpha(w));
        let lobe = Plastic::rough(ggx, Masking::Separable, 1.5, diffuse(), specular(), true);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let name = format!("plastic from below {w:?}");
        prove(&name, &subject, &few_views(&[-0.05, -0.3]), &plan(w))
    });
}

/// What a mirror-like coat sends back, and the rest.
fn albedo(lobe: &(impl Bsdf<f64> + Sync), cos_theta: f64, mirror: f64) -> f64 {
    let subject = Subject::from_bsdf(lobe, Transport::Radiance);
    views(&[cos_theta])
        .into_iter()
        .map(|wo| furnace::albedo(&subject, wo, &[], &Quadrature::default()).value[1] + mirror)
        .fold(0.0, f64::max)
}

#[test]
fn no_plastic_makes_light() {
    let mut brightest = 0.0_f64;
    for eta in [1.1, 1.5, 2.4] {
        for cos_theta in ABOVE {
            for nonlinear in [false, true] {
                for a in [0.1, 0.3, 1.0] {
                    let ggx = Ggx::new(alpha((a, a)));
                    let masking = Masking::HeightCorrelated;
                    let lobe = Plastic::rough(ggx, masking, eta, Rgb::WHITE, Rgb::WHITE, nonlinear);
                    let all = albedo(&lobe, cos_theta, 0.0);
                    assert!(all < 1.0 + 2e-3, "{eta} {a} {cos_theta}: {all}");
                    brightest = brightest.max(all);
                }
                let smooth = Plastic::smooth(eta, Rgb::WHITE, Rgb::WHITE, nonlinear);
                let f = specula_bsdf::fresnel::dielectric(cos_theta, eta).reflectance;
                let all = albedo(&smooth, cos_theta, f);
                // The fit of the internal reflectance that `plastic` takes is of low indices.
                let most = if eta > 2.0 { 1.03 } else { 1.003 };
                assert!(all < most, "smooth {eta} {cos_theta}: {all}");
            }
        }
    }
    assert!(brightest > 0.9, "{brightest}");
}

#[test]
fn f32_is_f64() {
    prove_all("plastic twins", &ALPHAS, |&w| {
        let masking = Masking::Separable;
        let mut report = common::twins(
            &format!("GGX {w:?}"),
            &Plastic::rough(
                Ggx::new(alpha_f32(w)),
                masking,
                1.5,
                diffuse::<f32>(),
                specular(),
                true,
            ),
            &Plastic::rough(
                Ggx::new(alpha(w)),
                masking,
                1.5,
                diffuse::<f64>(),
                specular(),
                true,
            ),
            Transport::Radiance,
        );
        report.absorb(common::twins(
            "smooth",
            &Plastic::smooth(1.5, diffuse::<f32>(), specular(), false),
            &Plastic::smooth(1.5, diffuse::<f64>(), specular(), false),
            Transport::Radiance,
        ));
        report
    });
}
