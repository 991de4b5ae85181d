//! Every sampler of visible normals, alone: normals and reflections, from above and below.

mod common;

use common::{
    alpha, beckmann_is_visible, both_sides, few_views, plan, prove_all, sampler, views, with_alphas,
};
use specula_bsdf::{Alpha, Vec3, vndf};
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, prove};

type Density = fn(Alpha<f64>, Vec3<f64>, Vec3<f64>) -> f64;
type SampleNormal = fn(Alpha<f64>, Vec3<f64>, [f64; 2]) -> Vec3<f64>;
type SampleReflection = fn(Alpha<f64>, Vec3<f64>, [f64; 2]) -> Option<Vec3<f64>>;

#[test]
fn visible_normals_follow_their_density() {
    let samplers: [(&str, Density, SampleNormal); 3] = [
        ("heitz", vndf::heitz::pdf_wm, vndf::heitz::sample_wm),
        ("cap", vndf::cap::pdf_wm, vndf::cap::sample_wm),
        (
            "beckmann",
            vndf::beckmann::pdf_wm,
            vndf::beckmann::sample_wm,
        ),
    ];
    prove_all(
        "visible normals",
        &with_alphas(&samplers),
        |&((name, pdf, sample), alphas)| {
            let alpha = alpha(alphas);
            let subject = sampler(
                move |wo, wm| pdf(alpha, wo, wm),
                move |wo, u| Some(sample(alpha, wo, u)),
            );
            let plan = Plan {
                reciprocity: Domain::Nowhere,
                ..plan(alphas)
            };
            let mut views = few_views(&both_sides());
            if name == "beckmann" {
                views.retain(|wo| beckmann_is_visible(alphas, wo));
            }
            prove(
                &format!("{name} normals {alphas:?}"),
                &subject,
                &views,
                &plan,
            )
        },
    );
}

#[test]
fn reflections_follow_their_density_and_are_rejected_as_it_says() {
    let samplers: [(&str, Density, SampleReflection); 5] = [
        (
            "heitz",
            vndf::heitz::reflection_pdf,
            vndf::heitz::sample_reflection,
        ),
        (
            "cap",
            vndf::cap::reflection_pdf,
            vndf::cap::sample_reflection,
        ),
        (
            "bounded",
            vndf::bounded::reflection_pdf,
            vndf::bounded::sample_reflection,
        ),
        (
            "exact",
            vndf::exact::reflection_pdf,
            vndf::exact::sample_reflection,
        ),
        (
            "beckmann",
            vndf::beckmann::reflection_pdf,
            vndf::beckmann::sample_reflection,
        ),
    ];
    prove_all(
        "reflections",
        &with_alphas(&samplers),
        |&((name, pdf, sample), alphas)| {
            let alpha = alpha(alphas);
            let subject = sampler(
                move |wo, wi| pdf(alpha, wo, wi),
                move |wo, u| sample(alpha, wo, u),
            );
            let plan = Plan {
                reciprocity: Domain::Nowhere,
                ..plan(alphas)
            };
            let mut views = views(&both_sides());
            if name == "beckmann" {
                views.retain(|wo| beckmann_is_visible(alphas, wo));
            }
            prove(
                &format!("{name} reflections {alphas:?}"),
                &subject,
                &views,
                &plan,
            )
        },
    );
}
