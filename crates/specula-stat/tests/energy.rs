//! Energy compensation: nothing is lost where nothing is absorbed, and samplers match.

mod common;

use std::f64::consts::FRAC_PI_2;

use common::{alpha, alpha_f32, both_sides, few_views, plan, prove_all};
use specula_bsdf::bsdf::{Compensated, CompensatedDielectric, RoughConductor};
use specula_bsdf::energy::{DielectricLoss, EnergyModel, FmsVariant, Loss, Tabulated};
use specula_bsdf::fresnel::{
    Conductor, Reflectance, Schlick, dielectric, dielectric_average, refract,
};
use specula_bsdf::math::{Real, Rgb, Vec3, rgb};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::{Sampler, reflect};
use specula_bsdf::{Bsdf, Transport};
use specula_stat::furnace::sampled_albedo;
use specula_stat::quadrature::{direction, gauss_legendre};
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, Rng, Subject, prove};

const SERIES: EnergyModel = EnergyModel::Turquin(FmsVariant::AverageSeries);
const MODELS: [EnergyModel; 3] = [
    EnergyModel::Turquin(FmsVariant::NormalIncidence),
    SERIES,
    EnergyModel::KullaConty,
];

/// Alphas of the furnace: all pairs of them, and either axis the wider.
const ALPHAS: [f64; 9] = [0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 1.5, 2.0];
const COSINES: [f64; 4] = [0.8, 0.4, 0.08, 0.005];

/// Every pair of alphas, the wider axis x in every other.
fn pairs(alphas: &[f64]) -> Vec<(f64, f64)> {
    let mut pairs = Vec::new();
    for (i, &a) in alphas.iter().enumerate() {
        for (j, &b) in alphas[..=i].iter().enumerate() {
            pairs.push(if (i + j) % 2 == 0 { (a, b) } else { (b, a) });
        }
    }
    pairs
}

/// Views of the furnace: straight, and along and between both axes, twice near the narrow one.
fn furnace_views((x, y): (f64, f64), cosines: &[f64]) -> Vec<Vec3<f64>> {
    let mut views = vec![direction(1.0, 0.4)];
    let near = (x.min(y) / x.max(y)).atan();
    let from_narrow: &[f64] = if x == y {
        &[0.4]
    } else {
        &[0.0, 0.5 * near, 2.0 * near, 0.7, FRAC_PI_2]
    };
    for &cosine in cosines {
        for &turn in from_narrow {
            let phi = if x < y { turn } else { FRAC_PI_2 - turn };
            views.push(direction(cosine, phi.clamp(0.0, FRAC_PI_2)));
        }
    }
    views
}

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

/// Single scattering's albedo with `F = 1` for both maskings, by quadrature over the visible
/// normals' own warp: the integrand is `G2/G1`, bounded.
///
/// A lattice: the horizon is no row of it, as it may be of a grid.
fn exact_albedo<N: Tabulated<f64>>(ndf: N, wo: Vec3<f64>) -> [f64; 2] {
    let mut sum = [0.0; 2];
    each_visible_normal(ndf, wo, |wm| {
        let wi = reflect(wo, wm);
        if wi.z > 0.0 {
            for (sum, masking) in sum.iter_mut().zip(MASKINGS) {
                *sum += ndf.g2_over_cos(masking, wo, wi);
            }
        }
    });
    sum.map(|sum| sum * ndf.projected_area(wo) / f64::from(POINTS))
}

/// The same of an interface, both branches.
fn exact_interface_albedo<N: Tabulated<f64>>(ndf: N, eta: f64, wo: Vec3<f64>) -> [f64; 2] {
    let mut sum = [0.0; 2];
    each_visible_normal(ndf, wo, |wm| {
        let cosine = wo.dot(wm);
        let bent = dielectric(cosine, eta);
        let reflected = reflect(wo, wm);
        let passed = refract(wo, wm, cosine, bent.cos_t, eta);
        for (sum, masking) in sum.iter_mut().zip(MASKINGS) {
            if reflected.z > 0.0 {
                *sum += bent.reflectance * ndf.g2_over_cos(masking, wo, reflected);
            }
            if bent.reflectance < 1.0 && passed.z < 0.0 {
                *sum += (1.0 - bent.reflectance) * ndf.g2_over_cos(masking, wo, passed);
            }
        }
    });
    sum.map(|sum| sum * ndf.projected_area(wo) / f64::from(POINTS))
}

fn each_visible_normal<N: Tabulated<f64>>(ndf: N, wo: Vec3<f64>, mut each: impl FnMut(Vec3<f64>)) {
    for i in 0..POINTS {
        let x = f64::from(i);
        each(ndf.sample_wm(wo, [(x + 0.5) / f64::from(POINTS), (x * GOLDEN).fract()]));
    }
}

const MASKINGS: [Masking; 2] = [Masking::HeightCorrelated, Masking::Separable];
const POINTS: u32 = 50_000;
/// The golden section, whose multiples fill `[0, 1)` evenly.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// `1/pi int loss(wi) cos dwi`, by quadrature.
fn average_loss(loss: impl Fn(Vec3<f64>) -> f64) -> f64 {
    let rule = gauss_legendre(40);
    let mut sum = 0.0;
    for &[x, weight] in &rule {
        let z = 0.5 * (x + 1.0);
        for &[y, azimuth_weight] in &rule {
            let u = 0.5 * (y + 1.0);
            let turn = FRAC_PI_2;
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
    views: &[Vec3<f64>],
    fault: impl Fn(f64, f64) -> (f64, f64),
) -> [f64; 2] {
    let losses = MASKINGS.map(|masking| Loss::new(ndf, masking));
    let means = losses.map(|loss| average_loss(|w| loss.directional(w)));
    let mut worst = [0.0_f64; 2];
    for &wo in views {
        let single = exact_albedo(ndf, wo);
        for ((loss, mean), single) in losses.iter().zip(means).zip(single) {
            let (missing, average) = fault(loss.directional(wo), loss.average());
            let kulla_conty = single + missing * mean / average;
            let turquin = single * (1.0 + missing / (1.0 - missing));
            for (worst, albedo) in worst.iter_mut().zip([kulla_conty, turquin]) {
                // f64::max would hide a NaN.
                assert!(
                    albedo.is_finite(),
                    "metal {:?} at {wo:?}: {albedo}",
                    ndf.alpha()
                );
                *worst = worst.max((albedo - 1.0).abs());
            }
        }
    }
    worst
}

/// Holds `|albedo - 1|` of a white surface against its bound.
fn expect_white(what: &str, off: f64, bound: f64) {
    assert!(
        off < bound,
        "{what}: its albedo is off by {off:.2e} where nothing is absorbed; expected 1 within {bound:.0e}"
    );
}

#[test]
fn nothing_is_lost_off_white_metals() {
    let mut worst = [0.0_f64; 2];
    for alphas in pairs(&ALPHAS) {
        let views = furnace_views(alphas, &COSINES);
        let found = furnace(Ggx::new(alpha(alphas)), &views, |l, a| (l, a));
        println!(
            "GGX {alphas:?}: Kulla-Conty {:.1e}, Turquin {:.1e}",
            found[0], found[1]
        );
        worst = [worst[0].max(found[0]), worst[1].max(found[1])];
        expect_white(
            &format!("GGX metal {alphas:?}, Kulla-Conty"),
            found[0],
            1e-3,
        );
        expect_white(&format!("GGX metal {alphas:?}, Turquin"), found[1], 2e-3);
    }
    println!("largest |albedo - 1|, Kulla-Conty and Turquin: {worst:?}");
}

#[test]
fn beckmann_loses_nothing_either() {
    for alphas in pairs(&[0.05, 0.2, 0.7, 2.0]) {
        let views = furnace_views(alphas, &[0.5, 0.08]);
        let found = furnace(Beckmann::new(alpha(alphas)), &views, |l, a| (l, a));
        println!("Beckmann {alphas:?}: {found:?}");
        expect_white(
            &format!("Beckmann metal {alphas:?}, Kulla-Conty"),
            found[0],
            1e-3,
        );
        expect_white(
            &format!("Beckmann metal {alphas:?}, Turquin"),
            found[1],
            3e-3,
        );
    }
}

/// Largest `|albedo - 1|` of the compensated interface, seen from the side where the index is 1.
fn interface_furnace<N: Tabulated<f64>>(ndf: N, eta: f64, views: &[Vec3<f64>]) -> f64 {
    let sides =
        MASKINGS.map(|masking| [eta, 1.0 / eta].map(|eta| DielectricLoss::new(ndf, masking, eta)));
    let mut worst = 0.0_f64;
    let quotients =
        sides.map(|sides| sides.map(|loss| average_loss(|w| loss.directional(w)) / loss.average()));
    for &wo in views {
        let single = exact_interface_albedo(ndf, eta, wo);
        for (([near, far], quotients), single) in sides.iter().zip(quotients).zip(single) {
            let common = near.average().min(far.average());
            let passed = (1.0 - dielectric_average(eta)) * common / near.average();
            let scale = (1.0 - passed) * quotients[0] + passed * quotients[1];
            let albedo = single + near.directional(wo) * scale;
            assert!(
                albedo.is_finite(),
                "interface {eta}, {:?} at {wo:?}: {albedo}",
                ndf.alpha()
            );
            worst = worst.max((albedo - 1.0).abs());
        }
    }
    worst
}

#[test]
fn stretched_interfaces_keep_their_light() {
    let mut worst = 0.0_f64;
    for alphas in pairs(&[0.05, 0.15, 0.5, 1.5]) {
        let views = furnace_views(alphas, &[0.6, 0.15]);
        for eta in [1.5, 1.0 / 1.5, 1.0 / 1.15, 2.4, 1.0 / 2.4] {
            let found = interface_furnace(Ggx::new(alpha(alphas)), eta, &views);
            println!("interface {eta:.3} {alphas:?}: {found:.1e}");
            expect_white(&format!("GGX interface {eta:.3} {alphas:?}"), found, 2e-2);
            worst = worst.max(found);
        }
    }
    let views = furnace_views((0.1, 0.8), &[0.6, 0.15]);
    for eta in [1.4, 1.0 / 1.4] {
        let found = interface_furnace(Beckmann::new(alpha((0.1, 0.8))), eta, &views);
        expect_white(
            &format!("Beckmann interface {eta:.3} (0.1, 0.8)"),
            found,
            2e-2,
        );
        worst = worst.max(found);
    }
    println!("largest |albedo - 1|: {worst:.1e}");
}

/// The furnace by the lobes' own samples: largest `|albedo - 1|` beyond five standard errors.
fn furnace_coarse<N: Tabulated<f64> + Sync>(ndf: N, masking: Masking) -> [f64; 2] {
    [EnergyModel::KullaConty, SERIES].map(|model| {
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
            assert!(green.mean().is_finite(), "cosine {cosine}: {green:?}");
            let noise = 5.0 * green.variance_of_mean().sqrt();
            worst.max((green.mean() - 1.0).abs() - noise)
        })
}

#[test]
fn samples_of_white_metals_carry_all_light() {
    for alphas in [(0.3, 0.3), (1.0, 1.0), (0.2, 0.8), (1.5, 0.4)] {
        let found = furnace_coarse(Ggx::new(alpha(alphas)), Masking::HeightCorrelated);
        expect_white(
            &format!("samples of {alphas:?}, Kulla-Conty"),
            found[0],
            1e-3,
        );
        expect_white(&format!("samples of {alphas:?}, Turquin"), found[1], 2e-3);
    }
}

#[test]
fn half_of_the_lost_energy_is_caught() {
    let ndf = Ggx::new(alpha((0.5, 0.5)));
    let views = furnace_views((0.5, 0.5), &COSINES);
    let right = furnace(ndf, &views, |l, a| (l, a));
    expect_white("GGX metal (0.5, 0.5), Kulla-Conty", right[0], 1e-3);
    let half = furnace(ndf, &views, |l, a| (0.5 * l, a));
    assert!(
        half[0] > 1e-2 && half[1] > 1e-2,
        "half of the loss is off by {half:?}, expected more than 1e-2"
    );
    let no_average = furnace(ndf, &views, |l, _| (l, 1.0));
    assert!(
        no_average[0] > 1e-2,
        "an average of 1 is off by {no_average:?}, expected more than 1e-2"
    );
    let squared = furnace(ndf, &views, |l, a| (l * l, a));
    assert!(
        squared[0] > 1e-2 && squared[1] > 1e-2,
        "the squared loss is off by {squared:?}, expected more than 1e-2"
    );
    // The isotropic table for an anisotropic surface is a fault of the same kind.
    let stretched = Ggx::new(alpha((0.1, 0.8)));
    let mean = Ggx::new(alpha((0.08_f64.sqrt(), 0.08_f64.sqrt())));
    let wo = direction(0.5, 0.2);
    let [single, _] = exact_albedo(stretched, wo);
    let loss = |ndf| Loss::new(ndf, Masking::default()).directional(wo);
    let off = |ndf| (single + loss(ndf) - 1.0).abs();
    assert!(
        off(mean) > 1e-2,
        "the isotropic table is off by {}, expected more than 1e-2",
        off(mean)
    );
    expect_white("GGX metal (0.1, 0.8)", off(stretched), 1e-3);
}

fn proof_plan(alphas: (f64, f64), model: EnergyModel) -> Plan {
    Plan {
        samples: 30_000,
        cells: 200,
        reciprocity: match model {
            EnergyModel::Turquin(_) => Domain::Nowhere,
            EnergyModel::KullaConty => Domain::Above,
        },
        ..plan(alphas)
    }
}

#[test]
fn compensated_metals_are_proven() {
    let mut cases = Vec::new();
    for model in MODELS {
        for alphas in [(0.05, 0.05), (0.3, 0.3), (1.0, 1.0), (0.2, 0.8), (1.5, 0.5)] {
            cases.push((model, alphas));
        }
    }
    prove_all("compensated", &cases, |&(model, alphas)| {
        let ggx = Ggx::new(alpha(alphas));
        let lobe = Compensated::new(ggx, gold(), model).with_sampler(Sampler::Bounded);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let views = few_views(&both_sides());
        let name = format!("compensated {model} {alphas:?}");
        prove(&name, &subject, &views, &proof_plan(alphas, model))
    });
}

#[test]
fn other_distributions_maskings_and_samplers_are_proven() {
    let alphas = (0.3, 0.7);
    let views = few_views(&[0.9, 0.3, 0.05]);
    prove_all("compensated Beckmann", &MODELS, |&model| {
        let lobe = Compensated::new(Beckmann::new(alpha(alphas)), gold(), model)
            .with_masking(Masking::Separable);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let name = format!("compensated Beckmann {model}");
        prove(&name, &subject, &views, &proof_plan(alphas, model))
    });
    prove_all(
        "compensated caps",
        &[Sampler::Heitz, Sampler::Cap],
        |&sampler| {
            let lobe = Compensated::new(Ggx::new(alpha(alphas)), gold(), EnergyModel::KullaConty)
                .with_sampler(sampler);
            let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
            let name = format!("compensated {sampler}");
            prove(
                &name,
                &subject,
                &views,
                &proof_plan(alphas, EnergyModel::KullaConty),
            )
        },
    );
}

/// Index, alphas, and whether it is two-sided.
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
        |&(eta, alphas, two_sided)| {
            let ggx = Ggx::new(alpha(alphas));
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
                ..plan(alphas)
            };
            let name = format!("compensated dielectric {eta:.3} {alphas:?} {two_sided}");
            let views = few_views(&[0.9, 0.3, 0.05, -0.05, -0.6]);
            prove(&name, &subject, &views, &plan)
        },
    );
}

#[test]
fn interfaces_keep_their_light() {
    for eta in [1.5, 2.4, 1.33] {
        for a in [0.1, 0.3, 0.6, 1.0] {
            let ggx = Ggx::new(alpha((a, a)));
            let lobe = CompensatedDielectric::new(ggx, eta);
            let cosines = [1.0, 0.6, 0.2, 0.05, -1.0, -0.6, -0.2, -0.05];
            let found = beyond_noise(&lobe, Transport::Importance, &cosines);
            println!("interface {eta} {a}: {found:.1e}");
            expect_white(
                &format!("samples of an interface {eta}, alpha {a}"),
                found,
                5e-3,
            );
            let loss = DielectricLoss::new(ggx, Masking::default(), eta);
            let (mean, average) = (average_loss(|w| loss.directional(w)), loss.average());
            assert!(
                (mean / average - 1.0).abs() < 1e-2,
                "interface {eta}, alpha {a}: the table's average loss is {average}, that of its directions {mean}"
            );
        }
    }
}

#[test]
fn f32_is_f64() {
    prove_all("compensated twins", &MODELS, |&model| {
        let alphas = (0.3, 0.7);
        let single = Compensated::new(Ggx::new(alpha_f32(alphas)), gold::<f32>(), model);
        let double = Compensated::new(Ggx::new(alpha(alphas)), gold::<f64>(), model);
        common::twins(&model.to_string(), &single, &double, Transport::Radiance)
    });
    prove_all("interface twins", &[1.5_f64, 1.0 / 1.5], |&eta| {
        let alphas = (0.4, 0.4);
        #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
        let single = CompensatedDielectric::new(Ggx::new(alpha_f32(alphas)), eta as f32);
        let double = CompensatedDielectric::new(Ggx::new(alpha(alphas)), eta);
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
            "compensated metal (0.2, 0.6), {model}: {above} just above the horizon, {below} just below, \
             expected the same"
        );
        for wo in [
            direction(-1.0, 0.0),
            direction(-0.3, 1.0),
            direction(0.0, 1.0),
        ] {
            let value = lobe.eval(wo, wi, Transport::Radiance);
            assert!(value.is_finite(), "{model} at {wo:?}: {value:?}");
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
        assert!(
            got > plain && got < 1.5 * plain,
            "dark metal, alpha 0.8, {model}: f cos {got}; expected {plain} to {}",
            1.5 * plain
        );
    }
    let black = Compensated::new(
        ggx,
        Reflectance::Constant(Rgb::BLACK),
        EnergyModel::KullaConty,
    );
    let value = black.eval(wo, wi, Transport::Radiance);
    assert!(value.is_black(), "a metal that reflects nothing: {value:?}");
    assert!(
        black
            .sample(wo, [0.3, 0.4, 0.5], Transport::Radiance)
            .is_some(),
        "a metal that reflects nothing has samples all the same"
    );
}
