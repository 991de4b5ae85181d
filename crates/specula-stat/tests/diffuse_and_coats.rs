//! Diffuse lobes, sheets, and coats over a base.

mod common;

use common::{ABOVE, ALPHAS, alpha, alpha_f32, few_views, plan, prove_all, views};
use specula_bsdf::bsdf::{
    CoatLayer, CoatScattering, CoatedDiffuse, DiffuseTransmission, Eon, Lambert, Lobe,
};
use specula_bsdf::math::{Real, rgb};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Bsdf, Rgb, Transport};
use specula_stat::quadrature::Quadrature;
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, Report, Subject, furnace, prove};

fn colour<T: Real>() -> Rgb<T> {
    rgb(T::of(0.8), T::of(0.4), T::of(0.1))
}

fn proof(name: &str, lobe: &(impl Bsdf<f64> + Sync), alphas: (f64, f64)) -> Report {
    let subject = Subject::from_bsdf(lobe, Transport::Radiance);
    prove(name, &subject, &few_views(&ABOVE), &plan(alphas))
}

/// Alphas of a coat; `None` is a smooth one.
fn coats() -> Vec<Option<(f64, f64)>> {
    ALPHAS.into_iter().map(Some).chain([None]).collect()
}

#[test]
fn lambert_and_eon() {
    prove_all("diffuse", &[0.0, 0.3, 1.0], |&roughness| {
        let mut report = proof("Eon", &Eon::new(colour(), roughness), (1.0, 1.0));
        report.absorb(proof("Lambert", &Lambert::new(colour()), (1.0, 1.0)));
        report
    });
}

#[test]
fn a_white_eon_returns_all_light() {
    for roughness in [0.0, 0.2, 0.7, 1.0] {
        let lobe = Eon::new(Rgb::splat(1.0_f64), roughness);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        for wo in views(&ABOVE) {
            let albedo = furnace::albedo(&subject, wo, &[], &Quadrature::default());
            assert!(
                (albedo.value[1] - 1.0).abs() < 1e-5,
                "{roughness} {wo:?}: {albedo:?}"
            );
        }
    }
}

#[test]
fn sheets_transmit() {
    let sheets = [(0.5, 0.3), (0.0, 0.7), (0.7, 0.0)];
    prove_all("sheets", &sheets, |&(reflected, transmitted)| {
        let lobe = DiffuseTransmission::new(Rgb::splat(reflected), Rgb::splat(transmitted));
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let plan = Plan {
            reciprocity: if reflected > 0.0 {
                Domain::Above
            } else {
                Domain::Nowhere
            },
            ..plan((1.0, 1.0))
        };
        let name = format!("sheet {reflected} {transmitted}");
        prove(&name, &subject, &few_views(&ABOVE), &plan)
    });
}

#[test]
fn coats_over_diffuse() {
    let cases: Vec<_> = [1.1, 1.5, 2.4]
        .iter()
        .flat_map(|&eta| coats().into_iter().map(move |coat| (eta, coat)))
        .collect();
    prove_all("coated diffuse", &cases, |&(eta, coat)| {
        let ggx = coat.map(|alphas| Ggx::new(alpha(alphas)));
        let name = format!("coated diffuse {eta} {coat:?}");
        proof(
            &name,
            &CoatedDiffuse::new(ggx, eta, colour()),
            coat.unwrap_or((1.0, 1.0)),
        )
    });
}

/// What may lie under a coat: pbrt-v4's default, much that absorbs, few bounces that lose nothing.
fn layers<T: Real>() -> [CoatLayer<T>; 3] {
    [
        (0.01, Some(10), CoatScattering::Single),
        (1.0, None, CoatScattering::Single),
        (0.3, Some(4), CoatScattering::Lossless),
    ]
    .map(|(thickness, max_depth, scattering)| CoatLayer {
        thickness: T::of(thickness),
        max_depth,
        scattering,
    })
}

#[test]
fn coats_over_layers() {
    let coats = [
        None,
        Some((0.05, 0.05)),
        Some((0.3, 0.3)),
        Some((0.2, 0.8)),
        Some((1.5, 1.5)),
    ];
    let cases: Vec<_> = layers()
        .into_iter()
        .flat_map(|layer| coats.map(|coat| (layer, coat)))
        .collect();
    prove_all("coats over layers", &cases, |&(layer, coat)| {
        let ggx = coat.map(|alphas| Ggx::new(alpha(alphas)));
        let name = format!("coated diffuse {layer:?} {coat:?}");
        let lobe = CoatedDiffuse::over_layer(ggx, 1.5, colour(), layer);
        proof(&name, &lobe, coat.unwrap_or((1.0, 1.0)))
    });
}

/// The light that each event adds, and each loss takes.
#[test]
fn more_events_return_more_light_and_thicker_layers_less() {
    let subject_albedo = |layer: CoatLayer<f64>, coat: Option<Ggx<f64>>, albedo: f64| {
        let lobe = CoatedDiffuse::over_layer(coat, 1.5, Rgb::splat(albedo), layer);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let wo = views(&[0.7])[0];
        furnace::albedo(&subject, wo, &[], &Quadrature::default()).value[1]
    };
    for coat in [None, Some(Ggx::new(alpha((0.3, 0.3))))] {
        for scattering in [CoatScattering::Single, CoatScattering::Lossless] {
            let by_depth = [
                Some(1),
                Some(2),
                Some(3),
                Some(10),
                Some(11),
                Some(100),
                None,
            ];
            let by_depth = by_depth.map(|max_depth| CoatLayer {
                max_depth,
                scattering,
                ..CoatLayer::default()
            });
            let [one, two, three, ten, eleven, hundred, all] =
                by_depth.map(|layer| subject_albedo(layer, coat, 1.0));
            // No bounce off the base: the coat alone.
            let black = subject_albedo(CoatLayer::default(), coat, 0.0);
            assert!((one - black).abs() < 1e-7, "{one} {black}");
            // An event that is no bounce off the base adds nothing.
            assert!((two - three).abs() < 1e-7 && (ten - eleven).abs() < 1e-7);
            assert!(one + 0.1 < two && two + 0.1 < ten && ten + 1e-3 < all);
            assert!((hundred - all).abs() < 1e-6, "{hundred} {all}");
            let by_thickness = [0.0, 0.01, 0.1, 1.0, 1e9].map(|thickness| CoatLayer {
                thickness,
                scattering,
                ..CoatLayer::default()
            });
            let shares = by_thickness.map(|layer| subject_albedo(layer, coat, 1.0));
            assert!(shares.is_sorted_by(|a, b| a > b), "{shares:?}");
            assert!((shares[4] - black).abs() < 1e-7, "{shares:?}");
        }
    }
}

#[test]
fn f32_is_f64() {
    prove_all("coat twins", &coats(), |&coat| {
        let single_ggx = coat.map(|w| Ggx::new(alpha_f32(w)));
        let double_ggx = coat.map(|w| Ggx::new(alpha(w)));
        let radiance = Transport::Radiance;
        let name = format!("{coat:?}");
        let mut report = common::twins(
            &name,
            &CoatedDiffuse::new(single_ggx, 1.5, colour::<f32>()),
            &CoatedDiffuse::new(double_ggx, 1.5, colour::<f64>()),
            radiance,
        );
        for (single, double) in layers().into_iter().zip(layers()) {
            report.absorb(common::twins(
                &format!("{name} {double:?}"),
                &CoatedDiffuse::over_layer(single_ggx, 1.5, colour::<f32>(), single),
                &CoatedDiffuse::over_layer(double_ggx, 1.5, colour::<f64>(), double),
                radiance,
            ));
        }
        report.absorb(common::twins(
            &name,
            &Eon::new(colour::<f32>(), 0.7),
            &Eon::new(colour::<f64>(), 0.7),
            radiance,
        ));
        report
    });
}

#[test]
fn a_lobe_is_what_it_holds() {
    let held = CoatedDiffuse::new(Some(Ggx::new(alpha((0.3, 0.3)))), 1.5, colour());
    let lobe = Lobe::from(held);
    let mut rng = specula_stat::Rng::new(4);
    for wo in views(&ABOVE) {
        for _ in 0..100 {
            let u = rng.triple();
            let (a, b) = (
                held.sample(wo, u, Transport::Radiance),
                lobe.sample(wo, u, Transport::Radiance),
            );
            assert_eq!(a, b);
        }
    }
}
