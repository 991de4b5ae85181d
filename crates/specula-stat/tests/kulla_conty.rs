//! Kulla and Conty's lobe without tables: its samples and densities, and its albedo beside quadrature and beside the
//! lobe that has the tables.

mod common;

use common::{alpha, few_views, plan, prove_all};
use specula_bsdf::bsdf::{Compensated, KullaConty, RoughConductor};
use specula_bsdf::energy::EnergyModel;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Rgb, Vec3, rgb};
use specula_bsdf::ndf::{Ggx, Masking, Ndf};
use specula_bsdf::vndf::{VisibleNormals, reflect};
use specula_bsdf::{Bsdf, Transport};
use specula_stat::quadrature::{direction, gauss_legendre};
use specula_stat::reciprocity::Domain;
use specula_stat::{Plan, Subject, prove};

const ALPHAS: [f64; 9] = [1e-3, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0];
const COSINES: [f64; 8] = [1.0, 0.8, 0.5, 0.3, 0.15, 0.08, 0.02, 0.005];

fn white() -> Reflectance<f64> {
    Reflectance::Constant(Rgb::splat(1.0))
}

/// Metals about gold, silver and chromium.
fn metals() -> [Reflectance<f64>; 3] {
    let metal = |eta: [f64; 3], k: [f64; 3]| {
        let colour = |[r, g, b]: [f64; 3]| rgb(r, g, b);
        Reflectance::Conductor(Conductor {
            eta: colour(eta),
            k: colour(k),
        })
    };
    [
        metal([0.143, 0.375, 1.442], [3.983, 2.386, 1.603]),
        metal([0.155, 0.117, 0.138], [4.828, 3.122, 2.147]),
        metal([3.181, 3.178, 2.326], [3.309, 3.329, 2.939]),
    ]
}

/// What `more` reflects beyond `less`, of which single scattering is the same: a function of the cosine alone.
fn beyond(more: &impl Bsdf<f64>, less: &impl Bsdf<f64>, wo: Vec3<f64>) -> Rgb<f64> {
    gauss_legendre(80)
        .iter()
        .fold(Rgb::BLACK, |sum, &[x, weight]| {
            // With z = t^4, dwi = 2 pi 4 t^3 dt.
            let t = 0.5 * (x + 1.0);
            let wi = direction(t.powi(4), 2.0);
            let [more, less] = [
                more.eval(wo, wi, Transport::Radiance),
                less.eval(wo, wi, Transport::Radiance),
            ];
            let share = core::f64::consts::TAU * 4.0 * t.powi(3) * 0.5 * weight;
            sum + (more - less) * share
        })
}

/// Single scattering's albedo with `F = 1`, over a lattice of visible normals.
fn single_albedo(ggx: Ggx<f64>, wo: Vec3<f64>) -> f64 {
    const POINTS: u32 = 50_000;
    let sum: f64 = (0..POINTS)
        .map(|i| {
            let x = f64::from(i);
            let u = [
                (x + 0.5) / f64::from(POINTS),
                (x * 0.618_033_988_749_894_8).fract(),
            ];
            let wi = reflect(wo, ggx.sample_wm(wo, u));
            let seen = ggx.g2_over_cos(Masking::HeightCorrelated, wo, wi);
            if wi.z > 0.0 { seen } else { 0.0 }
        })
        .sum();
    sum * ggx.projected_area(wo) / f64::from(POINTS)
}

/// Largest `|albedo - 1|` of the white metal.
fn furnace(fault: f64) -> f64 {
    let mut worst = 0.0_f64;
    for a in ALPHAS {
        let ggx = Ggx::new(alpha((a, a)));
        let lobe = KullaConty::new(a, white());
        let single = RoughConductor::new(ggx, white());
        for cosine in COSINES {
            let wo = direction(cosine, 0.4);
            let albedo = single_albedo(ggx, wo) + fault * beyond(&lobe, &single, wo).g;
            worst = worst.max((albedo - 1.0).abs());
        }
    }
    worst
}

#[test]
fn white_metals_keep_their_light() {
    let found = furnace(1.0);
    println!("largest |albedo - 1| {found:.2e}");
    assert!(found < 2e-3, "{found}");
    let faulty = furnace(0.98);
    assert!(faulty > 5e-3, "two hundredths less are off by {faulty}");
}

#[test]
fn coloured_metals_are_those_of_the_tables() {
    let mut worst = 0.0_f64;
    for reflectance in metals() {
        for a in ALPHAS {
            let ggx = Ggx::new(alpha((a, a)));
            let lobe = KullaConty::new(a, reflectance);
            let tables = Compensated::new(ggx, reflectance, EnergyModel::KullaConty);
            for cosine in COSINES {
                let difference = beyond(&lobe, &tables, direction(cosine, 0.4));
                worst = worst.max(difference.map(f64::abs).max_channel());
            }
        }
    }
    println!("largest difference of albedos {worst:.2e}");
    assert!(worst < 2e-3, "{worst}");
    assert!(worst > 1e-5, "the comparison compares nothing");
}

#[test]
fn samples_follow_their_density() {
    let cases: Vec<(usize, f64)> = [(0, 0.05), (0, 0.3), (1, 0.6), (2, 1.0)].to_vec();
    prove_all("Kulla-Conty", &cases, |&(metal, a)| {
        let lobe = KullaConty::new(a, metals()[metal]);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let plan = Plan {
            samples: 30_000,
            cells: 200,
            reciprocity: Domain::Above,
            ..plan((a, a))
        };
        let name = format!("Kulla-Conty {metal} {a}");
        prove(&name, &subject, &few_views(&common::ABOVE), &plan)
    });
}

#[test]
fn nothing_is_seen_from_below() {
    let lobe = KullaConty::new(0.3, white());
    let (above, below) = (direction(0.5, 1.0), direction(-0.2, 0.4));
    for (wo, wi) in [(below, above), (above, below)] {
        let (value, density) = lobe.eval_pdf(wo, wi, Transport::Radiance);
        assert!(value == Rgb::BLACK && density == 0.0);
    }
    assert!(
        lobe.sample(below, [0.9, 0.5, 0.5], Transport::Radiance)
            .is_none()
    );
    // Alphas beyond the fit are held.
    assert_eq!(KullaConty::new(3.0, white()), KullaConty::new(1.0, white()));
}
