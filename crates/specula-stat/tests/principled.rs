//! Mitsuba's principled materials, solid and thin.

mod common;

use common::{ABOVE, few_views, plan, prove_all, views};
use specula_bsdf::bsdf::{Principled, PrincipledParameters};
use specula_bsdf::math::{Real, rgb, vec3};
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};
use specula_stat::quadrature::Quadrature;
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, Subject, furnace, prove};

fn base<T: Real>() -> PrincipledParameters<T> {
    PrincipledParameters {
        base_colour: rgb(T::of(0.8), T::of(0.4), T::of(0.1)),
        ..PrincipledParameters::default()
    }
}

/// Opaque materials, each with something of its own.
fn opaque<T: Real>() -> Vec<(&'static str, PrincipledParameters<T>)> {
    let t = T::of;
    vec![
        ("default", base()),
        (
            "metal",
            PrincipledParameters {
                metallic: t(0.9),
                roughness: t(0.4),
                anisotropic: t(0.8),
                ..base()
            },
        ),
        (
            "cloth",
            PrincipledParameters {
                sheen: T::ONE,
                sheen_tint: t(0.5),
                flatness: t(0.7),
                roughness: t(0.8),
                ..base()
            },
        ),
        (
            "paint",
            PrincipledParameters {
                clearcoat: T::ONE,
                clearcoat_gloss: t(0.3),
                metallic: t(0.3),
                spec_tint: t(0.6),
                eta: t(1.8),
                ..base()
            },
        ),
    ]
}

/// Materials that refract.
fn refracting<T: Real>() -> Vec<(&'static str, PrincipledParameters<T>)> {
    let t = T::of;
    let glass = PrincipledParameters {
        spec_trans: T::ONE,
        roughness: t(0.5),
        ..base()
    };
    let mixed = PrincipledParameters {
        spec_trans: t(0.6),
        roughness: t(0.6),
        spec_tint: t(0.4),
        metallic: t(0.2),
        clearcoat: t(0.5),
        eta: t(1.3),
        ..base()
    };
    vec![("glass", glass), ("mixed", mixed)]
}

/// Sheets.
fn sheets<T: Real>() -> Vec<(&'static str, PrincipledParameters<T>)> {
    let t = T::of;
    let thin = PrincipledParameters {
        thin: true,
        roughness: t(0.6),
        spec_trans: t(0.7),
        spec_tint: t(0.3),
        diff_trans: t(0.8),
        sheen: t(0.5),
        anisotropic: t(0.5),
        ..base()
    };
    let paper = PrincipledParameters {
        spec_trans: T::ZERO,
        diff_trans: T::ONE,
        flatness: T::ONE,
        ..thin
    };
    vec![("sheet", thin), ("paper", paper)]
}

fn narrowest(p: &PrincipledParameters<f64>) -> (f64, f64) {
    let alpha = p.roughness * p.roughness * 0.5;
    if p.clearcoat > 0.0 {
        (0.03, 0.03)
    } else {
        (alpha, alpha)
    }
}

#[test]
fn opaque_materials() {
    prove_all("principled", &opaque::<f64>(), |&(name, p)| {
        let lobe = Principled::new(p);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        prove(name, &subject, &few_views(&ABOVE), &plan(narrowest(&p)))
    });
}

#[test]
fn refracting_materials_from_both_sides() {
    let of = |transport| {
        refracting::<f64>()
            .into_iter()
            .flat_map(move |(name, p)| [true, false].map(|side| (name, side, p, transport)))
    };
    let cases: Vec<_> = of(Transport::Radiance)
        .chain(of(Transport::Importance).take(1))
        .collect();
    prove_all(
        "principled glass",
        &cases,
        |&(name, outside, p, transport)| {
            let lobe = Principled::new(PrincipledParameters { outside, ..p });
            let subject = Subject::from_bsdf(&lobe, transport);
            let plan = Plan {
                eta: if outside { p.eta } else { 1.0 / p.eta },
                transport,
                ..plan(narrowest(&p))
            };
            let name = format!("principled {name}, outside {outside}, {transport:?}");
            prove(&name, &subject, &few_views(&[1.0, 0.3, 0.005]), &plan)
        },
    );
}

#[test]
fn sheets_on_both_sides() {
    prove_all("principled thin", &sheets::<f64>(), |&(name, p)| {
        let lobe = Principled::new(p);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        prove(name, &subject, &few_views(&ABOVE), &plan(narrowest(&p)))
    });
}

#[test]
fn backfacing_views_follow_the_density() {
    let cases = [opaque::<f64>()[3], refracting()[1], sheets()[0]];
    prove_all("principled from below", &cases, |&(name, p)| {
        let lobe = Principled::new(p);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let plan = Plan {
            eta: if p.spec_trans > 0.0 && !p.thin {
                p.eta
            } else {
                1.0
            },
            reciprocity: Domain::Nowhere,
            ..plan(narrowest(&p))
        };
        let name = format!("{name} from below");
        prove(&name, &subject, &few_views(&[-0.05, -0.3]), &plan)
    });
}

#[test]
fn f32_is_f64() {
    fn all<T: Real>() -> Vec<(&'static str, PrincipledParameters<T>)> {
        let mut all = opaque();
        all.extend(refracting());
        all.extend(sheets());
        all
    }
    let cases: Vec<_> = all::<f32>().into_iter().zip(all::<f64>()).collect();
    prove_all(
        "principled twins",
        &cases,
        |&((name, single), (_, double))| {
            common::twins(
                name,
                &Principled::new(single),
                &Principled::new(double),
                Transport::Radiance,
            )
        },
    );
}

fn albedo(p: PrincipledParameters<f64>, wo: Vec3<f64>) -> f64 {
    let lobe = Principled::new(p);
    let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
    furnace::albedo(&subject, wo, &[], &Quadrature::default()).value[1]
}

/// The documentation of the lobe states these values.
#[test]
fn the_energy_that_principled_makes_is_as_stated() {
    let white = PrincipledParameters {
        base_colour: Rgb::WHITE,
        ..PrincipledParameters::default()
    };
    let everything = PrincipledParameters {
        sheen: 1.0,
        clearcoat: 1.0,
        ..white
    };
    let mut plain = 0.0_f64;
    let mut most = 0.0_f64;
    for wo in views(&[1.0, 0.7, 0.5, 0.3, 0.15, 0.05]) {
        plain = plain.max(albedo(white, wo));
        most = most.max(albedo(everything, wo));
        let metal = PrincipledParameters {
            metallic: 1.0,
            ..white
        };
        let energy = albedo(metal, wo);
        assert!(energy <= 1.0 + 1e-6, "a white metal: {energy}");
        let glass = PrincipledParameters {
            spec_trans: 1.0,
            ..white
        };
        let lobe = Principled::new(glass);
        let subject = Subject::from_bsdf(&lobe, Transport::Importance);
        let edges = [wo.z, -wo.z];
        let energy = furnace::albedo(&subject, wo, &edges, &Quadrature::default()).value[1];
        assert!(energy <= 1.0 + 1e-4, "white glass: {energy}");
    }
    assert!((1.0..PLAIN).contains(&plain), "{plain}");
    assert!((plain..EVERYTHING).contains(&most), "{most}");
}

/// Largest albedos of a white base over all views.
const PLAIN: f64 = 1.2;
const EVERYTHING: f64 = 1.28;

#[test]
fn opaque_materials_are_black_from_inside() {
    for (name, p) in opaque::<f64>() {
        let inside = Principled::new(PrincipledParameters {
            outside: false,
            ..p
        });
        let (wo, wi) = (vec3(0.6, 0.0, 0.8), vec3(-0.6, 0.0, 0.8));
        let (f_cos, _) = inside.eval_pdf(wo, wi, Transport::Radiance);
        assert!(f_cos.is_black(), "{name}");
        assert!(
            inside.sample(wo, [0.5; 3], Transport::Radiance).is_none(),
            "{name}"
        );
    }
}
