//! Densities for multiple importance sampling of multiple bounces.
#![allow(clippy::cast_precision_loss, reason = "small counts")]

mod common;

use common::alpha;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::warp::uniform_sphere;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::multibounce::{Conductor, Dielectric, MisPdf, Model};
use specula_bsdf::ndf::{Beckmann, Ggx, Ndf};
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};
use specula_stat::quadrature::{Patch, Peak, Quadrature};

const WIDTHS: [(f64, f64); 6] = [
    (0.1, 0.1),
    (0.3, 0.3),
    (0.5, 0.5),
    (1.0, 1.0),
    (0.2, 0.8),
    (0.1, 0.4),
];
const VIEWS: [f64; 4] = [0.0, 30.0, 60.0, 80.0];

fn at(degrees: f64, azimuth: f64) -> Vec3<f64> {
    let (s, c) = degrees.to_radians().sin_cos();
    let (sin, cos) = azimuth.to_radians().sin_cos();
    vec3(s * cos, s * sin, c)
}

fn metal<N: Ndf<f64>>(ndf: N, mis: MisPdf) -> Conductor<f64, N> {
    let white = Reflectance::Constant(Rgb::splat(1.0));
    Conductor::new(ndf, white, Model::Ours).with_mis_pdf(mis)
}

const CELLS: (usize, usize) = (16, 32);

/// A direction of the hemisphere, equal areas: `mu` and a turn.
fn cell_direction(mu: f64, turn: f64) -> Vec3<f64> {
    let r = (1.0 - mu * mu).sqrt();
    let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
    vec3(r * cos, r * sin, mu)
}

/// Share of a walk's draws in each cell.
fn drawn(lobe: &Conductor<f64>, wo: Vec3<f64>, n: u32) -> Vec<f64> {
    let mut stream = Stream::new(9);
    let mut cells = vec![0.0; CELLS.0 * CELLS.1];
    for _ in 0..n {
        let u = [stream.next(), stream.next(), stream.next()];
        if let Some(sample) = lobe.sample_random(wo, u, Transport::Radiance, &mut stream) {
            let turn = sample.wi.y.atan2(sample.wi.x) / std::f64::consts::TAU;
            let pick = |x: f64, n: usize| (0..n).rfind(|i| x * n as f64 >= *i as f64).unwrap_or(0);
            let cell = pick(sample.wi.z, CELLS.0) * CELLS.1 + pick(turn.rem_euclid(1.0), CELLS.1);
            cells[cell] += 1.0 / f64::from(n);
        }
    }
    cells
}

/// Integral of a density over each cell.
fn integrated(lobe: &Conductor<f64>, wo: Vec3<f64>) -> Vec<f64> {
    const FINE: usize = 8;
    let mut cells = vec![0.0; CELLS.0 * CELLS.1];
    let area = std::f64::consts::TAU / (CELLS.0 * CELLS.1 * FINE * FINE) as f64;
    for (i, cell) in cells.iter_mut().enumerate() {
        for k in 0..FINE * FINE {
            let row = (i / CELLS.1) as f64 + ((k / FINE) as f64 + 0.5) / FINE as f64;
            let column = (i % CELLS.1) as f64 + ((k % FINE) as f64 + 0.5) / FINE as f64;
            let wi = cell_direction(row / CELLS.0 as f64, column / CELLS.1 as f64);
            *cell += lobe.pdf(wo, wi) * area;
        }
    }
    cells
}

/// As fig. 8 of Cui et al. 2023: distance (L1, over cells of equal solid angle) of each density from
/// that of the walk's draws.
#[test]
fn normalised_density_is_closest_to_the_walks() {
    let mut sums = [0.0; 3];
    for widths in WIDTHS {
        for view in VIEWS {
            let wo = at(view, 25.0);
            let of = |mis| metal(Ggx::new(alpha(widths)), mis);
            let walk = drawn(&of(MisPdf::Normalised), wo, 100_000);
            let distance = MisPdf::ALL.map(|mis| {
                let density = integrated(&of(mis), wo);
                let apart = walk.iter().zip(&density).map(|(a, b)| (a - b).abs());
                apart.sum::<f64>()
            });
            for (sum, d) in sums.iter_mut().zip(distance) {
                *sum += d / 24.0;
            }
            let [lambert, hapke, ours] = distance;
            println!("{widths:?} {view}: lambert {lambert:.3} hapke {hapke:.3} ours {ours:.3}");
            assert!(ours < lambert, "{widths:?} {view}: {distance:?}");
            // Grazing views of smooth or stretched surfaces are Hapke's, by little.
            let slack = if view > 70.0 || widths.0 != widths.1 {
                0.12
            } else {
                0.01
            };
            assert!(ours < hapke + slack, "{widths:?} {view}: {distance:?}");
        }
    }
    println!("mean {sums:.3?}");
    assert!(sums[2] < 0.7 * sums[1], "{sums:?}");
}

/// The integral over the hemisphere of a metal's density, by the midpoint rule in `(theta, phi)`:
/// what is folded about the normal is a narrow wedge there, which adaptive patches miss.
fn total<N: Ndf<f64>>(ndf: N, mis: MisPdf, wo: Vec3<f64>) -> f64 {
    let lobe = metal(ndf, mis);
    if wo.z < 0.0 {
        // From behind, facets are seen at grazing angles only: light goes on nearly straight.
        let quadrature = Quadrature {
            relative_tolerance: 1e-5,
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
    let (rows, columns) = if wo.z < 0.2 { (1000, 4000) } else { (400, 800) };
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
    for widths in WIDTHS {
        for view in [0.0, 30.0, 60.0, 80.0, 89.0, 100.0, 150.0] {
            let wo = at(view, 25.0);
            if wo.z < 0.0 && widths.0 < 0.2 {
                // What smooth facets show to a view from behind is narrower than any grid.
                continue;
            }
            let ggx = total(Ggx::new(alpha(widths)), MisPdf::Normalised, wo);
            let beckmann = total(Beckmann::new(alpha(widths)), MisPdf::Normalised, wo);
            assert!((ggx - 1.0).abs() < 1e-3, "GGX {widths:?} {view}: {ggx}");
            assert!(
                (beckmann - 1.0).abs() < 1e-3,
                "Beckmann {widths:?} {view}: {beckmann}"
            );
        }
    }
}

#[test]
fn sums_of_the_papers_are_no_densities() {
    let of = |width: f64, mis, view| total(Ggx::new(alpha((width, width))), mis, at(view, 0.0));
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
    for widths in [(0.3, 0.3), (1.0, 1.0), (0.2, 0.8)] {
        for view in [10.0, 70.0, 120.0, 175.0] {
            let wo = at(view, 25.0);
            let lobe = Dielectric::new(Ggx::new(alpha(widths)), 1.5, Model::Ours);
            let quadrature = Quadrature {
                relative_tolerance: 1e-4,
                ..Quadrature::default()
            };
            let integral = quadrature.integrate(Patch::SPHERE, |wi| [lobe.pdf(wo, wi)]);
            let value = integral.value[0];
            assert!(
                (value - 1.0).abs() < 1e-3,
                "{widths:?} {view}: {integral:?}"
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
                let lobe = Conductor::new(Ggx::new(alpha), white, Model::Ours).with_mis_pdf(mis);
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
