//! Densities for multiple importance sampling of multiple bounces.
#![allow(clippy::cast_precision_loss, reason = "small counts")]

mod common;

use common::{alpha, at};
use rayon::prelude::*;
use specula_bsdf::bsdf::{MultibounceConductor, MultibounceDielectric};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::internal::{normalised_pdf, sample_normalised};
use specula_bsdf::math::warp::uniform_sphere;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_bsdf::vndf::VisibleNormals;
use specula_bsdf::{Alpha, Bsdf, Rgb, Vec3};
use specula_stat::quadrature::{Patch, Peak, Quadrature};

const ALPHAS: [(f64, f64); 9] = [
    (0.1, 0.1),
    (0.15, 0.15),
    (0.2, 0.2),
    (0.3, 0.3),
    (0.5, 0.5),
    (1.0, 1.0),
    (0.2, 0.8),
    (0.1, 0.5),
    (0.8, 0.2),
];
const VIEWS: [f64; 6] = [0.0, 30.0, 60.0, 70.0, 80.0, 85.0];

fn metal<N: VisibleNormals<f64>>(ndf: N, mis: MisPdf) -> MultibounceConductor<f64, N> {
    let white = Reflectance::Constant(Rgb::splat(1.0));
    MultibounceConductor::new(ndf, white, MultibounceModel::StratifiedBidirectional)
        .with_mis_pdf(mis)
}

const CELLS: (usize, usize) = (16, 32);

/// A direction of the hemisphere, equal areas: `mu` and a turn.
fn cell_direction(mu: f64, turn: f64) -> Vec3<f64> {
    let r = (1.0 - mu * mu).sqrt();
    let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
    vec3(r * cos, r * sin, mu)
}

/// Share of samples in each cell.
fn sampled(n: u32, mut sample: impl FnMut(&mut Stream) -> Option<Vec3<f64>>) -> Vec<f64> {
    let mut stream = Stream::new(9);
    let mut cells = vec![0.0; CELLS.0 * CELLS.1];
    for _ in 0..n {
        if let Some(wi) = sample(&mut stream) {
            let turn = wi.y.atan2(wi.x) / std::f64::consts::TAU;
            let pick = |x: f64, n: usize| (0..n).rfind(|i| x * n as f64 >= *i as f64).unwrap_or(0);
            let cell = pick(wi.z, CELLS.0) * CELLS.1 + pick(turn.rem_euclid(1.0), CELLS.1);
            cells[cell] += 1.0 / f64::from(n);
        }
    }
    cells
}

/// Integral of a density over each cell.
fn integrated(pdf: impl Fn(Vec3<f64>) -> f64) -> Vec<f64> {
    const FINE: usize = 8;
    let mut cells = vec![0.0; CELLS.0 * CELLS.1];
    let area = std::f64::consts::TAU / (CELLS.0 * CELLS.1 * FINE * FINE) as f64;
    for (i, cell) in cells.iter_mut().enumerate() {
        for k in 0..FINE * FINE {
            let row = (i / CELLS.1) as f64 + ((k / FINE) as f64 + 0.5) / FINE as f64;
            let column = (i % CELLS.1) as f64 + ((k % FINE) as f64 + 0.5) / FINE as f64;
            let wi = cell_direction(row / CELLS.0 as f64, column / CELLS.1 as f64);
            *cell += pdf(wi) * area;
        }
    }
    cells
}

/// Alphas and a view, in degrees.
type Case = ((f64, f64), f64, f64);

/// Every view of every pair of alphas, along and across the grain; and alphas of any ratio, up to `most`, with views and
/// azimuths of any angle.
fn cases() -> (Vec<Case>, Vec<Case>) {
    let mut listed = Vec::new();
    for alphas in ALPHAS {
        for view in VIEWS {
            let azimuths: &[f64] = if alphas.0 == alphas.1 || view == 0.0 {
                &[25.0]
            } else {
                &[0.0, 90.0]
            };
            listed.extend(azimuths.iter().map(|azimuth| (alphas, view, *azimuth)));
        }
    }
    let mut stream = Stream::new(12);
    let mut any = |most: f64| -> Case {
        let mut alpha = || 0.02 * (most / 0.02_f64).powf(stream.next());
        let alphas = (alpha(), alpha());
        let view = (0.02 + 0.98 * stream.next::<f64>()).acos().to_degrees();
        (alphas, view, 360.0 * stream.next::<f64>())
    };
    let random = (0..80)
        .map(|i| any(if i < 60 { 4.0 } else { 10.0 }))
        .collect();
    listed.extend([((2.0, 2.0), 30.0, 25.0), ((0.05, 1.0), 40.0, 30.0)]);
    listed.extend([((2.0, 0.2), 40.0, 60.0), ((10.0, 10.0), 56.0, 10.0)]);
    (listed, random)
}

/// `f cos` of light that met one facet alone, which is a share of all densities here.
fn single<N: VisibleNormals<f64>>(ndf: &N, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    let wm = (wo + wi).normalize();
    let leaves = 1.0 / (wo.z + ndf.lambda_cos(wo) + wo.z * ndf.lambda(wi));
    0.25 * ndf.d(wm) * leaves
}

/// A walk over facets by depth (Heitz et al. 2016): its last direction, and how many facets it met.
fn walk<N: VisibleNormals<f64>>(
    ndf: &N,
    wo: Vec3<f64>,
    stream: &mut Stream,
) -> Option<(Vec3<f64>, u32)> {
    let mut flight = -wo;
    let mut depth = 0.0;
    for facets in 0..200 {
        let rate = ndf.projected_area(-flight) / flight.z.abs().max(1e-12);
        let step = -(1.0 - stream.next::<f64>()).ln() / rate;
        depth += if flight.z > 0.0 { -step } else { step };
        if depth < 0.0 {
            return Some((flight, facets));
        }
        let wm = ndf.sample_wm(-flight, [stream.next(), stream.next()]);
        flight = flight - wm * (2.0 * flight.dot(wm));
    }
    None
}

/// Distances of the densities from the walks, of light that met two facets or more. The first facet is in all densities
/// exactly; the cells would not resolve its lobe.
fn distances<N: VisibleNormals<f64>>(ndf: N, wo: Vec3<f64>, count: u32) -> [f64; 3] {
    let walks = sampled(count, |stream| {
        let (wi, facets) = walk(&ndf, wo, stream)?;
        (facets > 1).then_some(wi)
    });
    let Alpha { x, y } = ndf.alpha();
    MisPdf::ALL.map(|mis| {
        let density = if mis == MisPdf::Normalised && x.min(y) < 0.12 {
            // Narrower than any cell: from its samples, which another test holds against it.
            sampled(count, |stream| {
                let u = [stream.next(), stream.next(), stream.next()];
                let wm = ndf.sample_wm(wo, [u[0], u[1]]);
                let first = wm * (2.0 * wo.dot(wm)) - wo;
                sample_normalised(&ndf, wo, u).filter(|wi| (*wi - first).length() > 1e-9)
            })
        } else {
            let lobe = metal(ndf, mis);
            integrated(|wi| lobe.pdf(wo, wi) - single(&ndf, wo, wi))
        };
        walks.iter().zip(&density).map(|(a, b)| (a - b).abs()).sum()
    })
}

/// As fig. 8 of Cui et al. 2023: distance (L1, over cells of equal solid angle) of each density from that of the walk's
/// samples, whose noise is in all three. The normalised one is nowhere farther than the nearer of the others, but for
/// that noise, and 0.15 on average where alphas are spread evenly by their logarithm.
#[test]
fn normalised_density_is_closest_to_the_walks() {
    const COUNT: u32 = 60_000;
    let (listed, random) = cases();
    let cases: Vec<Case> = listed.iter().chain(&random).copied().collect();
    // Beckmann's normals are found by iteration: a third of the cases.
    let of = |(i, case): (usize, &Case)| {
        let (alphas, view, azimuth) = *case;
        let wo = at(view, azimuth);
        let ggx = distances(Ggx::new(alpha(alphas)), wo, COUNT);
        let beckmann = (i % 3 == 0).then(|| distances(Beckmann::new(alpha(alphas)), wo, COUNT));
        (ggx, beckmann)
    };
    let all: Vec<_> = cases.par_iter().enumerate().map(of).collect();
    let mut sums = [0.0; 3];
    for (i, (case, (ggx, beckmann))) in cases.iter().zip(&all).enumerate() {
        for (name, distance) in [("GGX", Some(ggx)), ("Beckmann", beckmann.as_ref())] {
            let Some([lambert, hapke, specula]) = distance else {
                continue;
            };
            println!("{name} {case:?}: lambert {lambert:.4} hapke {hapke:.4} specula {specula:.4}");
            assert!(
                *specula < lambert.min(*hapke) + 0.015,
                "{name} {case:?}: {distance:?}"
            );
        }
        if (listed.len()..listed.len() + 60).contains(&i) {
            for (sum, d) in sums.iter_mut().zip(ggx) {
                *sum += d / 60.0;
            }
        }
    }
    println!("mean {sums:.3?}");
    assert!(sums[2] < 0.16, "{sums:?}");
}

/// Density over truth, from `wo` to `wi`.
fn share<N: VisibleNormals<f64>>(ndf: N, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    const COUNT: i32 = 20_000;
    let lobe = metal(ndf, MisPdf::Normalised);
    let mut stream = Stream::new(21);
    let estimates = (0..COUNT).map(|_| lobe.estimate(wo, wi, &mut stream).g);
    let truth = estimates.sum::<f64>() / f64::from(COUNT);
    normalised_pdf(&ndf, wo, wi) / truth
}

/// Flights near the normal leave at once. Where the others were sent in the same order, few came near it: 0.75 of the
/// truth, one facet included, at alpha 1 and 60 degrees.
#[test]
fn normalised_density_has_no_notch_at_the_normal() {
    for a in [0.3, 0.5, 1.0, 2.0] {
        // The lobes of rough surfaces are too bright there from low views.
        let most = if a < 2.0 { 1.35 } else { 3.0 };
        for view in [0.0, 30.0, 60.0, 80.0] {
            let wo = at(view, 0.0);
            for light in [0.1, 3.0, 10.0] {
                let wi = at(light, 40.0);
                let ndf = alpha((a, a));
                let ggx = share(Ggx::new(ndf), wo, wi);
                assert!((0.85..most).contains(&ggx), "GGX {a} {view} {light}: {ggx}");
                if a == 1.0 {
                    let beckmann = share(Beckmann::new(ndf), wo, wi);
                    let is_held = (0.65..most).contains(&beckmann);
                    assert!(is_held, "Beckmann {a} {view} {light}: {beckmann}");
                }
            }
        }
    }
}

/// The sampler knows nothing of the density's Jacobians: that the two agree is their proof.
#[test]
fn the_normalised_density_is_its_samplers() {
    const N: u32 = 100_000;
    let check = |((alphas, view, azimuth), is_ggx): ((_, f64, f64), bool)| {
        let wo = at(view, azimuth);
        let (ggx, beckmann) = (Ggx::new(alpha(alphas)), Beckmann::new(alpha(alphas)));
        let cells = sampled(N, |stream| {
            let u = [stream.next(), stream.next(), stream.next()];
            if is_ggx {
                sample_normalised(&ggx, wo, u)
            } else {
                sample_normalised(&beckmann, wo, u)
            }
        });
        let density = integrated(|wi| {
            if is_ggx {
                normalised_pdf(&ggx, wo, wi)
            } else {
                normalised_pdf(&beckmann, wo, wi)
            }
        });
        // Cells are integrated to 2 %; a seventh standard error of the largest of 500 cells passes.
        let far = cells.iter().zip(&density).map(|(sampled, p)| {
            let sigma = (p / f64::from(N)).sqrt() + 1e-5;
            ((sampled - p).abs() - 0.02 * p) / sigma
        });
        let worst = far.fold(0.0, f64::max);
        assert!(
            worst < 7.0,
            "GGX {is_ggx} {alphas:?} {view} {azimuth}: {worst}"
        );
    };
    for alphas in [
        (0.3, 0.3),
        (1.0, 1.0),
        (0.2, 0.8),
        (0.8, 0.3),
        (2.0, 0.5_f64),
    ] {
        for (view, azimuth) in [(0.0, 0.0), (40.0, 25.0), (75.0, 100.0), (100.0, 25.0)] {
            if view > 90.0 && (alphas.0 < 0.5 || alphas.1 < 0.5) {
                // From behind, light goes on nearly straight: too narrow for cells.
                continue;
            }
            check(((alphas, view, azimuth), true));
            check(((alphas, view, azimuth), false));
        }
    }
}

/// Textures vary the alphas: no step where a constant would change.
#[test]
fn normalised_density_is_continuous_in_the_alphas() {
    let mut stream = Stream::new(3);
    for _ in 0..2000 {
        let (x, ratio) = (0.05 * 40.0_f64.powf(stream.next()), stream.next::<f64>());
        // Half of the alphas are close to equal, where the smooth axis changes.
        let y = if ratio < 0.5 {
            x
        } else {
            x * 4.0_f64.powf(4.0 * ratio - 3.0)
        };
        let cap =
            |stream: &mut Stream| cell_direction(0.05 + 0.95 * stream.next::<f64>(), stream.next());
        let (wo, wi) = (cap(&mut stream), cap(&mut stream));
        let of = |factor: f64| normalised_pdf(&Ggx::new(alpha((x * factor, y))), wo, wi);
        let (less, more) = (of(1.0 - 1e-7), of(1.0 + 1e-7));
        assert!(
            (less / more - 1.0).abs() < 1e-4,
            "{x} {y} {wo:?} {wi:?}: {less} {more}"
        );
    }
}

/// The integral over the hemisphere of a metal's density, by the midpoint rule in `(theta, phi)`:
/// what is folded about the normal is a narrow wedge there, which adaptive patches miss.
fn total<N: VisibleNormals<f64>>(ndf: N, mis: MisPdf, wo: Vec3<f64>) -> f64 {
    let lobe = metal(ndf, mis);
    if wo.z < 0.0 {
        // From behind, facets are seen at grazing angles only: light goes on nearly straight.
        let quadrature = Quadrature {
            relative_tolerance: 1e-5,
            start_extent: 0.06,
            peaks: vec![Peak {
                direction: -wo,
                width: 0.01,
            }],
            ..Quadrature::default()
        };
        return quadrature
            .integrate(Patch::UPPER, |wi| [lobe.pdf(wo, wi)])
            .value[0];
    }
    // Near grazing views the lobe is as narrow as its facets' slopes times the elevation.
    let (rows, columns) = if wo.z < 0.2 { (500, 1600) } else { (300, 600) };
    let step = std::f64::consts::FRAC_PI_2 / rows as f64;
    let mut sum = 0.0;
    for i in 0..rows * columns {
        let theta = step * ((i / columns) as f64 + 0.5);
        let turn = ((i % columns) as f64 + 0.5) / columns as f64;
        sum += lobe.pdf(wo, cell_direction(theta.cos(), turn)) * theta.sin();
    }
    sum * step * std::f64::consts::TAU / columns as f64
}

#[test]
fn normalised_density_integrates_to_one() {
    ALPHAS.par_iter().for_each(|alphas| {
        for view in [0.0, 60.0, 80.0, 89.0, 100.0, 150.0] {
            let wo = at(view, 25.0);
            if wo.z < 0.0 && alphas.0 < 0.2 {
                // What smooth facets show to a view from behind is narrower than any grid, for
                // Beckmann's, whose tails are thin, sooner.
                continue;
            }
            let ggx = total(Ggx::new(alpha(*alphas)), MisPdf::Normalised, wo);
            assert!((ggx - 1.0).abs() < 1e-3, "GGX {alphas:?} {view}: {ggx}");
            if wo.z > 0.0 || alphas.0 >= 0.3 {
                let beckmann = total(Beckmann::new(alpha(*alphas)), MisPdf::Normalised, wo);
                let off = (beckmann - 1.0).abs();
                assert!(off < 1e-3, "Beckmann {alphas:?} {view}: {beckmann}");
            }
        }
    });
}

#[test]
fn sums_of_the_papers_are_no_densities() {
    let of = |a: f64, mis, view| total(Ggx::new(alpha((a, a))), mis, at(view, 0.0));
    let hapke = of(1.0, MisPdf::Hapke, 0.0);
    assert!((hapke - 1.41).abs() < 0.01, "{hapke}");
    let most = of(1.0, MisPdf::Hapke, 80.0);
    assert!(most > 1.3 && most < 1.72, "{most}");
    // Nearly all visible normals of a smooth surface reflect upward, and the cosine adds 1.
    let lambert = of(0.1, MisPdf::Lambert, 30.0);
    assert!((lambert - 2.0).abs() < 0.02, "{lambert}");
}

#[test]
fn dielectric_density_integrates_to_one() {
    for alphas in [(0.3, 0.3), (1.0, 1.0), (0.2, 0.8)] {
        for view in [10.0, 70.0, 120.0, 175.0] {
            let wo = at(view, 25.0);
            let lobe = MultibounceDielectric::new(
                Ggx::new(alpha(alphas)),
                1.5,
                MultibounceModel::StratifiedBidirectional,
            );
            let quadrature = Quadrature {
                relative_tolerance: 1e-4,
                ..Quadrature::default()
            };
            let integral = quadrature.integrate(Patch::SPHERE, |wi| [lobe.pdf(wo, wi)]);
            let value = integral.value[0];
            assert!(
                (value - 1.0).abs() < 1e-3,
                "{alphas:?} {view}: {integral:?}"
            );
        }
    }
}

#[test]
fn densities_are_positive_and_finite_in_single_precision() {
    let mut stream = Stream::new(4);
    for mis in MisPdf::ALL {
        for ax in [1e-4_f32, 0.01, 0.1, 1.0, 10.0] {
            for ay in [1e-4_f32, 0.1, 1.0] {
                let white = Reflectance::Constant(Rgb::splat(1.0_f32));
                let alpha = Alpha::clamped(ax, ay);
                let lobe = MultibounceConductor::new(
                    Ggx::new(alpha),
                    white,
                    MultibounceModel::StratifiedBidirectional,
                )
                .with_mis_pdf(mis);
                for _ in 0..2000 {
                    let sphere = |s: &mut Stream| uniform_sphere([s.next(), s.next()]);
                    let (wo, wi) = (sphere(&mut stream), sphere(&mut stream));
                    let pdf = lobe.pdf(wo, wi);
                    assert!(pdf.is_finite(), "{lobe:?} {wo:?} {wi:?} {pdf}");
                    assert_eq!(pdf > 0.0, wi.z > 0.0, "{lobe:?} {wo:?} {wi:?} {pdf}");
                }
            }
        }
    }
}
