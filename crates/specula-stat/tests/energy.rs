//! Energy compensation: nothing is lost where nothing is absorbed, and samplers match.

mod common;

use common::{alpha, alpha_f32, both_sides, few_views, plan, prove_all};
use specula_bsdf::bsdf::{Compensated, CompensatedDielectric, RoughConductor};
use specula_bsdf::energy::{DielectricLoss, FmsVariant, Loss, Model, Tabulated};
use specula_bsdf::fresnel::{Conductor, Reflectance, Schlick};
use specula_bsdf::math::{Real, Rgb, Vec3, rgb};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::{Sampler, reflect};
use specula_bsdf::{Bsdf, Transport};
use specula_stat::furnace::sampled_albedo;
use specula_stat::quadrature::{direction, gauss_legendre};
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, Rng, Subject, prove};

const SERIES: Model = Model::Turquin(FmsVariant::AverageSeries);
const MODELS: [Model; 3] = [
    Model::Turquin(FmsVariant::NormalIncidence),
    SERIES,
    Model::KullaConty,
];

/// Widths of the furnace: isotropic and anisotropic, either axis the wider.
const FURNACE: [(f64, f64); 15] = [
    (0.02, 0.02),
    (0.1, 0.1),
    (0.25, 0.25),
    (0.5, 0.5),
    (0.8, 0.8),
    (1.0, 1.0),
    (1.5, 1.5),
    (2.0, 2.0),
    (0.1, 0.2),
    (0.5, 0.05),
    (0.1, 0.5),
    (0.2, 0.8),
    (0.8, 0.2),
    (0.6, 1.0),
    (1.5, 0.4),
];
const COSINES: [f64; 8] = [1.0, 0.9, 0.7, 0.5, 0.3, 0.1, 0.03, 0.005];

fn white<T: Real>() -> Reflectance<T> {
    Reflectance::Constant(Rgb::splat(T::ONE))
}

/// Gold, about.
fn gold<T: Real>() -> Reflectance<T> {
    let colour = |r, g, b| rgb(T::of(r), T::of(g), T::of(b));
    Reflectance::Conductor(Conductor {
        eta: colour(0.143, 0.375, 1.442),
        k: colour(3.983, 2.386, 1.603),
    })
}

/// Single scattering's albedo with `F = 1`, by quadrature over the visible normals' own warp: the
/// integrand is `G2/G1`, bounded.
///
/// Midpoints of a fine grid.
fn exact_albedo<N: Tabulated<f64>>(ndf: N, masking: Masking, wo: Vec3<f64>) -> f64 {
    let mut sum = 0.0;
    for i in 0..GRID {
        for j in 0..GRID {
            let u = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(GRID));
            let wi = reflect(wo, ndf.sample_wm(wo, u));
            if wi.z > 0.0 {
                sum += ndf.projected_area(wo) * ndf.g2_over_cos(masking, wo, wi);
            }
        }
    }
    sum / f64::from(GRID * GRID)
}

const GRID: u32 = 220;

/// `1/pi int loss(wi) cos dwi`, by quadrature.
fn average_loss(loss: impl Fn(Vec3<f64>) -> f64) -> f64 {
    let rule = gauss_legendre(40);
    let mut sum = 0.0;
    for &[x, weight] in &rule {
        let z = 0.5 * (x + 1.0);
        for &[y, azimuth_weight] in &rule {
            let u = 0.5 * (y + 1.0);
            let turn = std::f64::consts::FRAC_PI_2;
            for phi in [turn * u * u, turn * (1.0 - u * u)] {
                let at = loss(direction(z.powi(3), phi));
                sum += 6.0 * z.powi(5) * 0.5 * weight * 0.5 * u * azimuth_weight * at;
            }
        }
    }
    sum
}

/// Largest `|albedo - 1|` of the white metal under Kulla and Conty's and under Turquin's model.
///
/// The second lobe's albedo is `L(wo)` times the quotient of two averages; the first's is the
/// quadrature's. `fault` spoils `(L(wo), L_avg)`; nothing does outside of the planted fault.
fn furnace<N: Tabulated<f64>>(
    ndf: N,
    masking: Masking,
    azimuths: &[f64],
    fault: impl Fn(f64, f64) -> (f64, f64),
) -> [f64; 2] {
    let loss = Loss::new(ndf, masking);
    let mean = average_loss(|w| loss.directional(w));
    let mut worst = [0.0_f64; 2];
    for cosine in COSINES {
        for &phi in azimuths {
            let wo = direction(cosine, phi);
            let single = exact_albedo(ndf, masking, wo);
            let (missing, average) = fault(loss.directional(wo), loss.average());
            let kulla_conty = single + missing * mean / average;
            let turquin = single * (1.0 + missing / (1.0 - missing));
            for (worst, albedo) in worst.iter_mut().zip([kulla_conty, turquin]) {
                // f64::max would hide a number that is none.
                assert!(albedo.is_finite());
                *worst = worst.max((albedo - 1.0).abs());
            }
        }
    }
    worst
}

#[test]
fn nothing_is_lost_off_white_metals() {
    let mut worst = [0.0_f64; 2];
    for widths in FURNACE {
        let azimuths: &[f64] = if widths.0 == widths.1 {
            &[0.4]
        } else {
            &[0.0, 0.3, 0.8, 1.2, 1.5]
        };
        for masking in [Masking::HeightCorrelated, Masking::Separable] {
            let found = furnace(Ggx::new(alpha(widths)), masking, azimuths, |l, a| (l, a));
            println!(
                "GGX {masking:?} {widths:?}: Kulla-Conty {:.1e}, Turquin {:.1e}",
                found[0], found[1]
            );
            worst = [worst[0].max(found[0]), worst[1].max(found[1])];
        }
    }
    println!("largest |albedo - 1|, Kulla-Conty and Turquin: {worst:?}");
    assert!(worst[0] < 1e-3, "Kulla and Conty: {worst:?}");
    assert!(worst[1] < 2e-3, "Turquin: {worst:?}");
}

#[test]
fn beckmann_loses_nothing_either() {
    let mut worst = [0.0_f64; 2];
    for widths in [(0.1, 0.1), (0.4, 0.4), (0.7, 0.7), (1.0, 1.0), (0.2, 0.8)] {
        let ndf = Beckmann::new(alpha(widths));
        for masking in [Masking::HeightCorrelated, Masking::Separable] {
            let found = furnace_coarse(ndf, masking);
            println!("Beckmann {masking:?} {widths:?}: {found:?}");
            worst = [worst[0].max(found[0]), worst[1].max(found[1])];
        }
    }
    assert!(worst[0] < 1e-3 && worst[1] < 2e-3, "{worst:?}");
}

/// The furnace by the lobes' own samples: largest `|albedo - 1|` beyond five standard errors.
fn furnace_coarse<N: Tabulated<f64> + Sync>(ndf: N, masking: Masking) -> [f64; 2] {
    [Model::KullaConty, SERIES].map(|model| {
        let lobe = Compensated::new(ndf, white(), model).with_masking(masking);
        beyond_noise(&lobe, Transport::Radiance, &[1.0, 0.6, 0.2, 0.03])
    })
}

/// Largest `|albedo - 1|` beyond five standard errors of its estimate.
fn beyond_noise(lobe: &(impl Bsdf<f64> + Sync), transport: Transport, cosines: &[f64]) -> f64 {
    let subject = Subject::from_bsdf(lobe, transport);
    let mut rng = Rng::new(21);
    cosines
        .iter()
        .zip([0.3, 1.1].into_iter().cycle())
        .fold(0.0, |worst: f64, (&cosine, phi)| {
            let [_, green, _] = sampled_albedo(&subject, direction(cosine, phi), 40_000, &mut rng);
            assert!(green.mean().is_finite());
            let noise = 5.0 * green.variance_of_mean().sqrt();
            worst.max((green.mean() - 1.0).abs() - noise)
        })
}

#[test]
fn samples_of_white_metals_carry_all_light() {
    for widths in [(0.3, 0.3), (1.0, 1.0), (0.2, 0.8), (1.5, 0.4)] {
        let found = furnace_coarse(Ggx::new(alpha(widths)), Masking::HeightCorrelated);
        assert!(found[0] < 1e-3 && found[1] < 2e-3, "{widths:?}: {found:?}");
    }
}

#[test]
fn half_of_the_lost_energy_is_caught() {
    let ndf = Ggx::new(alpha((0.5, 0.5)));
    let masking = Masking::default();
    let right = furnace(ndf, masking, &[0.4], |l, a| (l, a));
    assert!(right[0] < 1e-3, "{right:?}");
    let half = furnace(ndf, masking, &[0.4], |l, a| (0.5 * l, a));
    assert!(half[0] > 1e-2 && half[1] > 1e-2, "{half:?}");
    let no_average = furnace(ndf, masking, &[0.4], |l, _| (l, 1.0));
    assert!(no_average[0] > 1e-2, "{no_average:?}");
    let squared = furnace(ndf, masking, &[0.4], |l, a| (l * l, a));
    assert!(squared[0] > 1e-2 && squared[1] > 1e-2, "{squared:?}");
    // The isotropic table for an anisotropic surface is a fault of the same kind.
    let stretched = Ggx::new(alpha((0.1, 0.8)));
    let mean = Loss::new(Ggx::new(alpha((0.08_f64.sqrt(), 0.08_f64.sqrt()))), masking);
    let wo = direction(0.5, 0.2);
    let single = exact_albedo(stretched, masking, wo);
    assert!((single + mean.directional(wo) - 1.0).abs() > 1e-2);
}

fn proof_plan(widths: (f64, f64), model: Model) -> Plan {
    Plan {
        samples: 30_000,
        cells: 200,
        reciprocity: match model {
            Model::Turquin(_) => Domain::Nowhere,
            Model::KullaConty => Domain::Above,
        },
        ..plan(widths)
    }
}

#[test]
fn compensated_metals_are_proven() {
    let mut cases = Vec::new();
    for model in MODELS {
        for widths in [(0.05, 0.05), (0.3, 0.3), (1.0, 1.0), (0.2, 0.8), (1.5, 0.5)] {
            cases.push((model, widths));
        }
    }
    prove_all("compensated", &cases, |&(model, widths)| {
        let ggx = Ggx::new(alpha(widths));
        let lobe = Compensated::new(ggx, gold(), model).with_sampler(Sampler::Bounded);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let views = few_views(&both_sides());
        let name = format!("compensated {model} {widths:?}");
        prove(&name, &subject, &views, &proof_plan(widths, model))
    });
}

#[test]
fn other_distributions_maskings_and_samplers_are_proven() {
    let widths = (0.3, 0.7);
    let views = few_views(&[0.9, 0.3, 0.05]);
    prove_all("compensated Beckmann", &MODELS, |&model| {
        let lobe = Compensated::new(Beckmann::new(alpha(widths)), gold(), model)
            .with_masking(Masking::Separable);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let name = format!("compensated Beckmann {model}");
        prove(&name, &subject, &views, &proof_plan(widths, model))
    });
    prove_all(
        "compensated caps",
        &[Sampler::Heitz, Sampler::Cap],
        |&sampler| {
            let lobe = Compensated::new(Ggx::new(alpha(widths)), gold(), Model::KullaConty)
                .with_sampler(sampler);
            let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
            let name = format!("compensated {sampler}");
            prove(
                &name,
                &subject,
                &views,
                &proof_plan(widths, Model::KullaConty),
            )
        },
    );
}

/// Index, widths, and whether it is two-sided.
const INTERFACES: [(f64, (f64, f64), bool); 6] = [
    (1.5, (0.1, 0.1), true),
    (1.5, (0.5, 0.5), true),
    (1.0 / 1.5, (1.0, 1.0), true),
    (2.4, (0.2, 0.8), true),
    (1.5, (0.5, 0.5), false),
    (1.0 / 1.33, (0.3, 0.6), false),
];

#[test]
fn compensated_interfaces_are_proven() {
    prove_all(
        "compensated dielectric",
        &INTERFACES,
        |&(eta, widths, two_sided)| {
            let ggx = Ggx::new(alpha(widths));
            let (lobe, domain) = if two_sided {
                (CompensatedDielectric::new(ggx, eta), Domain::Everywhere)
            } else {
                (CompensatedDielectric::facing(ggx, eta), Domain::Above)
            };
            let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
            let plan = Plan {
                eta,
                reciprocity: domain,
                relative_tolerance: 1e-8,
                samples: 30_000,
                cells: 200,
                ..plan(widths)
            };
            let name = format!("compensated dielectric {eta:.3} {widths:?} {two_sided}");
            let views = few_views(&[0.9, 0.3, 0.05, -0.05, -0.6]);
            prove(&name, &subject, &views, &plan)
        },
    );
}

#[test]
fn interfaces_keep_their_light() {
    let mut worst = 0.0_f64;
    for eta in [1.5, 2.4, 1.33] {
        for width in [0.1, 0.3, 0.6, 1.0] {
            let ggx = Ggx::new(alpha((width, width)));
            let lobe = CompensatedDielectric::new(ggx, eta);
            let cosines = [1.0, 0.6, 0.2, 0.05, -1.0, -0.6, -0.2, -0.05];
            let found = beyond_noise(&lobe, Transport::Importance, &cosines);
            println!("interface {eta} {width}: {found:.1e}");
            worst = worst.max(found);
            let loss = DielectricLoss::new(ggx, Masking::default(), eta);
            let mean = average_loss(|w| loss.directional(w));
            assert!((mean / loss.average() - 1.0).abs() < 1e-2, "{eta} {width}");
        }
    }
    assert!(worst < 5e-3, "{worst}");
}

#[test]
fn f32_is_f64() {
    prove_all("compensated twins", &MODELS, |&model| {
        let widths = (0.3, 0.7);
        let single = Compensated::new(Ggx::new(alpha_f32(widths)), gold::<f32>(), model);
        let double = Compensated::new(Ggx::new(alpha(widths)), gold::<f64>(), model);
        common::twins(&model.to_string(), &single, &double, Transport::Radiance)
    });
    prove_all("interface twins", &[1.5_f64, 1.0 / 1.5], |&eta| {
        let widths = (0.4, 0.4);
        #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
        let single = CompensatedDielectric::new(Ggx::new(alpha_f32(widths)), eta as f32);
        let double = CompensatedDielectric::new(Ggx::new(alpha(widths)), eta);
        common::twins(&format!("{eta:.3}"), &single, &double, Transport::Radiance)
    });
}

#[test]
fn views_pass_through_the_horizon_without_a_step() {
    for model in MODELS {
        let lobe = Compensated::new(Ggx::new(alpha((0.2, 0.6))), gold(), model);
        let wi = direction(0.4, 2.0);
        let at = |z: f64| lobe.eval(direction(z, 0.3), wi, Transport::Radiance).g;
        let (above, below) = (at(1e-7), at(-1e-7));
        assert!(
            above > 0.0 && (above / below - 1.0).abs() < 1e-3,
            "{model} {above} {below}"
        );
        for wo in [
            direction(-1.0, 0.0),
            direction(-0.3, 1.0),
            direction(0.0, 1.0),
        ] {
            assert!(lobe.eval(wo, wi, Transport::Radiance).is_finite());
        }
    }
}

#[test]
fn colours_follow_the_number_of_bounces() {
    // A dark metal gains little: the series lies below one more bounce at F0 for Schlick's F0.
    let dark = Reflectance::Schlick(Schlick {
        f0: Rgb::splat(0.3_f64),
    });
    let ggx = Ggx::new(alpha((0.8, 0.8)));
    let (wo, wi) = (direction(0.8, 0.2), direction(0.6, 2.5));
    let plain = RoughConductor::new(ggx, dark)
        .eval(wo, wi, Transport::Radiance)
        .g;
    for model in MODELS {
        let got = Compensated::new(ggx, dark, model)
            .eval(wo, wi, Transport::Radiance)
            .g;
        assert!(got > plain && got < 1.5 * plain, "{model}: {got} {plain}");
    }
    let black = Compensated::new(ggx, Reflectance::Constant(Rgb::BLACK), Model::KullaConty);
    assert!(black.eval(wo, wi, Transport::Radiance).is_black());
    assert!(
        black
            .sample(wo, [0.3, 0.4, 0.5], Transport::Radiance)
            .is_some()
    );
}
