//! Rays through lenses: against traces in f64, pupils, and the thick lens.

use specula_scene::scene::LensInterface;

use super::*;
use crate::sampler::Sampler;

/// Curvature radius, thickness, index, aperture diameter; in millimetres.
fn system(rows: &[[f64; 4]]) -> LensSystem {
    let interface = |&[radius, thickness, eta, diameter]: &[f64; 4]| LensInterface {
        curvature_radius: radius * 1e-3,
        thickness: thickness * 1e-3,
        eta,
        aperture_radius: 0.5e-3 * diameter,
    };
    LensSystem {
        interfaces: rows.iter().map(interface).collect(),
        stop: None,
        film_diagonal: 0.043,
    }
}

/// A double Gauss of 50 mm, f/2: United States patent 2,673,491 (Tronnier 1954), scaled.
fn double_gauss() -> LensSystem {
    system(&[
        [29.475, 3.76, 1.67, 25.2],
        [84.83, 0.12, 1.0, 25.2],
        [19.275, 4.025, 1.67, 23.0],
        [40.77, 3.275, 1.699, 23.0],
        [12.75, 5.705, 1.0, 18.0],
        [0.0, 4.5, 1.0, 17.1],
        [-14.495, 1.18, 1.603, 17.0],
        [40.77, 6.065, 1.658, 20.0],
        [-20.385, 0.19, 1.0, 20.0],
        [437.065, 3.22, 1.717, 20.0],
        [-39.73, 36.8, 1.0, 20.0],
    ])
}

/// A thick singlet of 50 mm with a small stop behind it.
fn singlet() -> LensSystem {
    system(&[
        [60.0, 8.0, 1.5, 40.0],
        [-40.0, 6.0, 1.0, 40.0],
        [0.0, 44.0, 1.0, 4.0],
    ])
}

/// A ray through the lenses in `f64`, by the spheres about their centres and Snell's law as vectors.
fn trace_f64(system: &LensSystem, film: [f32; 2], direction: Vec3<f32>) -> Option<[[f64; 3]; 2]> {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let along = |p: [f64; 3], t: f64, d: [f64; 3]| [0, 1, 2].map(|i| p[i] + t * d[i]);
    let unit = |d: [f64; 3]| d.map(|x| x / dot(d, d).sqrt());
    let mut p = [f64::from(film[0]), f64::from(film[1]), 0.0];
    let mut d = unit(direction.to_array().map(f64::from));
    let mut z = 0.0;
    for (i, of_file) in system.interfaces.iter().enumerate().rev() {
        z += of_file.thickness;
        let r = of_file.curvature_radius;
        if r == 0.0 {
            p = along(p, (z - p[2]) / d[2], d);
        } else {
            // The centre is towards the film where it is convex to the scene.
            let centre = [0.0, 0.0, z - r];
            let o = along(p, -1.0, centre);
            let (b, c) = (dot(o, d), dot(o, o) - r * r);
            let root = (b * b - c).sqrt();
            let t = if r > 0.0 { -b + root } else { -b - root };
            if t.is_nan() || t < 0.0 {
                return None;
            }
            p = along(p, t, d);
            let n = along(p, -1.0, centre).map(|x| x / r);
            let before = i.checked_sub(1).map_or(1.0, |i| system.interfaces[i].eta);
            let eta = of_file.eta / before;
            let cos = dot(n, d);
            let k = 1.0 - eta * eta * (1.0 - cos * cos);
            if k <= 0.0 {
                return None;
            }
            let scale = k.sqrt() - eta * cos;
            d = unit([0, 1, 2].map(|i| eta * d[i] + scale * n[i]));
        }
        if p[0].hypot(p[1]) > of_file.aperture_radius {
            return None;
        }
    }
    Some([p, d])
}

#[test]
fn rays_are_refracted_as_by_spheres() {
    for system in [double_gauss(), singlet()] {
        let lenses = Lenses::new(&system);
        let mut through = 0;
        for i in 0..4096 {
            let u = Sampler::new([i, 0], 0, 1).camera();
            let film = [0.02 * (2.0 * u[0] - 1.0), 0.02 * (2.0 * u[1] - 1.0)];
            let [x, y] = [0.01 * (2.0 * u[2] - 1.0), 0.01 * (2.0 * u[3] - 1.0)];
            let towards = vec3(x - film[0], y - film[1], lenses.rear).normalize();
            let expected = trace_f64(&system, film, towards);
            let Some(ray) = lenses.trace(film, towards) else {
                continue;
            };
            // Rays at an edge may fall on either side of it.
            let Some([p, d]) = expected else { continue };
            through += 1;
            let error = |a: Vec3<f32>, b: [f64; 3]| {
                let differences = a.to_array().into_iter().zip(b);
                differences
                    .map(|(a, b)| (f64::from(a) - b).abs())
                    .fold(0.0, f64::max)
            };
            assert!(error(ray.origin, p) < 2e-8, "{:?} and {p:?}", ray.origin);
            assert!(
                error(ray.direction, d) < 2e-6,
                "{:?} and {d:?}",
                ray.direction
            );
        }
        assert!(through > 100, "{through}");
    }
}

/// Vignetting as of the twin, by the share of rays that get through.
#[test]
fn as_many_rays_get_through_as_between_spheres() {
    let system = double_gauss();
    let lenses = Lenses::new(&system);
    let mut counts = [0_i32; 2];
    for i in 0..8192 {
        let u = Sampler::new([i, 3], 0, 1).camera();
        let film = [0.02 * u[0], 0.01 * u[1]];
        let [x, y] = [0.01 * (2.0 * u[2] - 1.0), 0.01 * (2.0 * u[3] - 1.0)];
        let towards = vec3(x - film[0], y - film[1], lenses.rear).normalize();
        counts[0] += i32::from(lenses.trace(film, towards).is_some());
        counts[1] += i32::from(trace_f64(&system, film, towards).is_some());
    }
    assert!(
        counts[1] > 1000 && (counts[0] - counts[1]).abs() < 3,
        "{counts:?}"
    );
}

#[test]
fn pupils_hold_all_rays_that_get_through() {
    let narrow_stop = {
        let mut system = double_gauss();
        system.interfaces[5].aperture_radius = 0.2e-3;
        system
    };
    for system in [double_gauss(), narrow_stop, singlet()] {
        let lenses = Lenses::new(&system);
        let half = 1.5 * lenses.interfaces[0].aperture_radius;
        let [mut through, mut sampled] = [0, 0];
        for i in 0..40_000 {
            let u = Sampler::new([i, 1], 0, 1).camera();
            let r = lenses.film_radius * u[0];
            let part = floor_index(u[0] * RADII as f32);
            // Half of them all over the lens, half around the pupil.
            let pupil = lenses.pupils[part];
            let wide = Pupil {
                x: [-half, half],
                y: half,
            };
            let square = match pupil {
                Some(p) if i % 2 == 0 => {
                    let margin = 0.5 * (p.x[1] - p.x[0]);
                    Pupil {
                        x: [p.x[0] - margin, p.x[1] + margin],
                        y: 2.0 * p.y,
                    }
                }
                _ => wide,
            };
            let x = square.x[0] + u[1] * (square.x[1] - square.x[0]);
            let y = square.y * (2.0 * u[2] - 1.0);
            let towards = vec3(x - r, y, lenses.rear).normalize();
            if lenses.trace([r, 0.0], towards).is_some() {
                let holds = pupil.is_some_and(|p| x >= p.x[0] && x <= p.x[1] && y.abs() <= p.y);
                assert!(holds, "{r}: ({x}, {y}) and {pupil:?}");
                through += 1;
            }
            sampled += i32::from(lenses.sample([r, 0.0], [u[1], u[2]]).is_some());
        }
        assert!(through > 2000, "{through}");
        // A disk fills pi / 4 of its square: rectangles are not much larger than pupils.
        assert!(sampled > 20_000, "{sampled}");
    }
}

/// A hole without lenses: the irradiance of a uniform disk, on its axis and off it.
///
/// ```text
/// E / L = pi / 2 (1 - (d^2 + x^2 - a^2) / sqrt((d^2 + x^2 + a^2)^2 - 4 a^2 x^2))
/// ```
///
/// Source: Foote 1915; Howell's catalogue of configuration factors, B-12.
#[test]
fn samples_of_a_hole_have_the_irradiance_of_a_disk() {
    let lenses = Lenses::new(&system(&[[0.0, 20.0, 1.0, 24.0]]));
    for film in [[0.0, 0.0], [0.005, 0.0], [0.008, -0.012], [-0.015, 0.015]] {
        let mut mean = 0.0;
        let n = 1 << 14;
        for i in 0..n {
            let u = Sampler::new([0, 0], i, 1).camera();
            let ray = lenses.sample(film, [u[0], u[3]]);
            mean += ray.map_or(0.0, |ray| f64::from(ray.weight)) / f64::from(n);
        }
        let (a, d) = (0.012_f64, 0.02_f64);
        let x2 = film.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>();
        let sum = d * d + x2 + a * a;
        let whole = (sum * sum - 4.0 * a * a * x2).sqrt();
        let expected = core::f64::consts::FRAC_PI_2 * (1.0 - (d * d + x2 - a * a) / whole);
        assert!(
            (mean / expected - 1.0).abs() < 2e-3,
            "{film:?}: {mean} and {expected}"
        );
    }
}

/// Irradiances through lenses against sums over a grid of the twin's rays.
#[test]
fn samples_through_lenses_have_the_irradiance_of_the_twin() {
    let system = double_gauss();
    let lenses = Lenses::new(&system);
    let rear = f64::from(lenses.rear);
    for film in [[0.0_f32, 0.0], [0.007, 0.003], [-0.012, 0.009]] {
        let n = 1 << 14;
        let mut mean = 0.0;
        for i in 0..n {
            let u = Sampler::new([0, 0], i, 2).camera();
            let ray = lenses.sample(film, [u[0], u[3]]);
            mean += ray.map_or(0.0, |ray| f64::from(ray.weight)) / f64::from(n);
        }
        let (side, half) = (400, 0.015_f64);
        let mut expected = 0.0;
        for i in 0..side * side {
            let at = |i: u32| half * (2.0 * (f64::from(i) + 0.5) / f64::from(side) - 1.0);
            let [x, y] = [at(i % side), at(i / side)];
            let d = [x - f64::from(film[0]), y - f64::from(film[1]), rear];
            let towards = vec3(narrow(d[0]), narrow(d[1]), narrow(d[2])).normalize();
            if trace_f64(&system, film, towards).is_some() {
                let cos2 = d[2] * d[2] / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                let cell = (2.0 * half / f64::from(side)).powi(2);
                expected += cos2 * cos2 * cell / (rear * rear);
            }
        }
        assert!(
            (mean / expected - 1.0).abs() < 5e-3,
            "{film:?}: {mean} and {expected}"
        );
    }
}

#[test]
fn chief_rays_have_the_spread_of_their_neighbours() {
    for system in [double_gauss(), singlet()] {
        let lenses = Lenses::new(&system);
        for film in [[0.0_f32, 0.0], [0.004, 0.0], [-0.006, 0.009]] {
            let step = 2e-4;
            let direction = |dx: f32, dy: f32| lenses.chief([film[0] + dx, film[1] + dy]).0;
            let across = (direction(step, 0.0) - direction(-step, 0.0)) / (2.0 * step);
            let down = (direction(0.0, step) - direction(0.0, -step)) / (2.0 * step);
            let expected = across.cross(down).length().sqrt();
            let (centre, spread) = lenses.chief(film);
            assert!(
                (spread / expected - 1.0).abs() < 0.02,
                "{film:?}: {spread} and {expected}"
            );
            // Upside down, and some 20 per metre: one over the focal length.
            assert!(centre.x * film[0] <= 0.0 && centre.y * film[1] <= 0.0);
            assert!(spread > 10.0 && spread < 25.0, "{spread}");
        }
    }
}

#[test]
fn pictures_of_stops_are_interpolated() {
    let stop = StopPicture {
        width: 2,
        height: 2,
        values: vec![0.0, 1.0, 2.0, 4.0],
    };
    let at = |u: f32, v: f32| transmittance(&stop, [u, v]);
    assert_eq!(
        [at(0.75, 0.25), at(0.25, 0.75), at(0.75, 0.75)],
        [1.0, 2.0, 4.0]
    );
    assert_eq!(at(0.5, 0.5), 1.75);
    // Half a pixel beyond the middle of the outermost one, half of it is left.
    assert_eq!(at(1.0, 0.75), 2.0);
    assert_eq!(at(1.3, 0.75), 0.0);
    assert_eq!(at(-9.0, 0.75), 0.0);
}
