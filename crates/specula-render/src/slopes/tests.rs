//! Alphas beside covariances of slopes that are sampled.

use specula_bsdf::math::{Stream, vec3};

use super::*;

fn covariance(xx: f32, xy: f32, yy: f32) -> SlopeCovariance {
    SlopeCovariance { xx, xy, yy }
}

fn near(found: [f32; 2], expected: [f32; 2]) -> bool {
    (0..2).all(|i| (found[i] - expected[i]).abs() < 1e-5 * (1.0 + expected[i]))
}

/// Slopes of normals about their mean, by sums over many normals.
#[test]
fn spreads_are_those_of_normals_in_a_frame_about_the_mean() {
    let mut random = Stream::new(4);
    let mean = [0.7_f32, -0.4];
    let spread = 0.03;
    let slopes: Vec<[f32; 2]> = (0..20_000)
        .map(|_| {
            let [a, b] = [(); 2].map(|()| spread * (random.next::<f32>() - 0.5));
            [mean[0] + a, mean[1] + 0.4 * a + b]
        })
        .collect();
    let n = slopes.len() as f64;
    let sum = |f: &dyn Fn(f64, f64) -> f64| {
        let terms = slopes.iter().map(|[p, q]| f(f64::from(*p), f64::from(*q)));
        narrow(terms.sum::<f64>() / n)
    };
    let moments = NormalMoments {
        mean: [sum(&|p, _| p), sum(&|_, q| q)],
        squares: [sum(&|p, _| p * p), sum(&|p, q| p * q), sum(&|_, q| q * q)],
    };
    let axes = [vec3(0.6, 0.8, 0.0), vec3(-0.8, 0.6, 0.0)];
    let world = |[p, q]: [f32; 2]| (axes[0] * p + axes[1] * q + vec3(0.0, 0.0, 1.0)).normalize();
    let normal = world(moments.mean);
    let frame = Frame::from_normal_tangent(normal, vec3(1.0, 0.2, 0.0));
    let found = SlopeSpread::new(&moments, 1.0, axes).expect("they vary");
    let within = found.within(&frame);
    let mut expected = [0.0_f64; 3];
    for slope in &slopes {
        let m = frame.to_local(world(*slope));
        let [p, q] = [m.x / m.z, m.y / m.z].map(f64::from);
        for (sum, v) in expected.iter_mut().zip([p * p, p * q, q * q]) {
            *sum += v / n;
        }
    }
    for (found, expected) in [within.xx, within.xy, within.yy].into_iter().zip(expected) {
        let error = (f64::from(found) - expected).abs();
        assert!(
            error < 0.03 * expected.abs().max(2e-5),
            "{found} {expected}"
        );
    }
    let trace = found.trace_about(-normal);
    assert!((trace - within.trace()).abs() < 1e-3 * trace);
    let doubled = NormalMoments {
        mean: moments.mean.map(|v| 0.5 * v),
        squares: moments.squares.map(|v| 0.25 * v),
    };
    let scaled = SlopeSpread::new(&doubled, 2.0, axes).expect("they vary");
    let scaled = scaled.within(&frame);
    assert!((scaled.xx - within.xx).abs() < 1e-3 * within.xx);
}

#[test]
fn what_rounding_leaves_is_no_covariance() {
    let [p, q] = [3.1_f32, -0.123];
    let moments = NormalMoments {
        mean: [p, q],
        squares: [p * p * (1.0 + 3e-7), p * q, q * q * (1.0 - 3e-7)],
    };
    assert!(SlopeSpread::new(&moments, 1.0, [Vec3::X, vec3(0.0, 1.0, 0.0)]).is_none());
}

#[test]
fn alphas_grow_by_twice_the_variance() {
    let (widening, turn) = Widening::new(covariance(0.02, 0.0, 0.005), 0.0, [0.1; 2]);
    assert_eq!(turn, 0.0);
    assert!(near(
        widening.of([0.1; 2]),
        [0.05_f32.sqrt(), 0.02_f32.sqrt()]
    ));
    assert!(near(widening.of([0.0; 2]), [0.2, 0.1]));
    let isotropic = widening.of_isotropic(0.1);
    assert!(near([isotropic; 2], [0.035_f32.sqrt(); 2]));
    let smooth = widening.of_rough(None).expect("it is rough now");
    assert!(near([smooth.x, smooth.y], [0.2, 0.1]));
    let (hardly, _) = Widening::new(covariance(4e-7, 0.0, 0.0), 0.0, [0.0; 2]);
    assert_eq!(hardly.of_rough(None), None);
}

/// The eigenvalues and the direction of the longer axis, against the matrix that they were made of.
#[test]
fn axes_are_the_principal_ones() {
    for (turn, alphas, map) in [
        (0.3_f32, [0.1_f32, 0.1_f32], [0.04_f32, 0.01_f32]),
        (-1.2, [0.0, 0.0], [0.03, 0.0]),
        (1.0, [0.3, 0.05], [0.08, 0.001]),
        (0.4, [0.05, 0.3], [0.0004, 0.0001]),
    ] {
        let (sin, cos) = turn.sin_cos();
        let [long, short] = map;
        let map = covariance(
            cos * cos * long + sin * sin * short,
            sin * cos * (long - short),
            sin * sin * long + cos * cos * short,
        );
        let (widening, found) = Widening::new(map, 0.0, alphas);
        let [x, y] = alphas.map(|a| 0.5 * a * a);
        let sum = covariance(map.xx + x, map.xy, map.yy + y);
        let [along, across] = widening.of(alphas).map(|a| 0.5 * a * a);
        assert!(along >= across);
        let trace = sum.trace();
        assert!((along + across - trace).abs() < 1e-5 * trace);
        let determinant = sum.xx * sum.yy - sum.xy * sum.xy;
        assert!((along * across - determinant).abs() < 1e-5 * trace * trace);
        // The longer axis is an eigenvector.
        let (sin, cos) = found.sin_cos();
        let to = [sum.xx * cos + sum.xy * sin, sum.xy * cos + sum.yy * sin];
        assert!((to[0] - along * cos).abs() < 1e-5 && (to[1] - along * sin).abs() < 1e-5);
    }
}
