//! Trajectories against known motions; boxes that hold them.

use core::f64::consts::{FRAC_PI_2, PI};

use specula_bsdf::math::Stream;

use super::*;
use crate::bounds::BoundingBox;

const SHUTTER: [f64; 2] = [0.0, 1.0];

fn trajectory(start: DMat4, end: DMat4, times: [f64; 2]) -> Trajectory {
    Trajectory::new(&start, &Motion { end, times })
}

fn swept(t: &Trajectory, of: BoundingBox) -> BoundingBox {
    let [min, max] = t.swept([of.min, of.max]);
    BoundingBox { min, max }
}

/// Random affine transforms: rotated, sheared, scaled by 0.03 to 30, mirrored by `sign`.
fn random_transform(random: &mut Stream, sign: f64) -> DMat4 {
    let mut u = || random.next::<f64>() * 2.0 - 1.0;
    let turn = |u: &mut dyn FnMut() -> f64| {
        let axis = DVec3::new(u(), u(), u())
            .try_normalize()
            .unwrap_or(DVec3::X);
        DMat4::from_axis_angle(axis, u() * PI)
    };
    let place = DMat4::from_translation(DVec3::new(u(), u(), u()) * 5.0);
    let scale = DVec3::new(u(), u(), u()).map(|x| 30_f64.powf(x)) * DVec3::new(1.0, 1.0, sign);
    let (a, b) = (turn(&mut u), turn(&mut u));
    place * a * DMat4::from_scale(scale) * b
}

#[test]
fn linear_maps_are_rotations_times_symmetric_stretches() {
    let mut random = Stream::new(1);
    for i in 0..200 {
        let m = random_transform(&mut random, if i % 2 == 0 { 1.0 } else { -1.0 });
        let m = DMat3::from_mat4(m);
        let (rotation, stretch) = polar(&m);
        let product = DMat3::from_quat(rotation) * stretch;
        let size = m
            .to_cols_array()
            .iter()
            .fold(0.0_f64, |a, x| a.max(x.abs()));
        assert!(product.abs_diff_eq(m, 1e-13 * size), "{m}");
        assert!(
            stretch.abs_diff_eq(stretch.transpose(), 1e-11 * size),
            "{stretch}"
        );
        // Positive, or negative where the map mirrors: of one sign on every vector.
        let sign = m.determinant().signum();
        for p in [
            DVec3::X,
            DVec3::Y,
            DVec3::Z,
            DVec3::ONE,
            DVec3::new(1.0, -2.0, 0.5),
        ] {
            assert!(p.dot(stretch * p) * sign > 0.0, "{stretch}");
        }
    }
}

#[test]
fn what_was_given_is_met_at_both_times_and_beyond() {
    let mut random = Stream::new(2);
    for i in 0..50 {
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        let [a, b] = [(), ()].map(|()| random_transform(&mut random, sign));
        let t = trajectory(a, b, [0.25, 0.5]);
        for (time, expected) in [(-1.0, a), (0.25, a), (0.5, b), (0.7, b)] {
            assert_eq!(t.at(time), expected);
        }
        // The interpolated transform runs into them.
        for (s, end) in [(1e-9, a), (1.0 - 1e-9, b)] {
            assert!(
                t.between(s).abs_diff_eq(end, 1e-5),
                "{}\n{end}",
                t.between(s)
            );
        }
    }
}

#[test]
fn rotations_run_at_constant_speed_the_shorter_way_and_the_rest_linearly() {
    let turned = |angle: f64| DMat4::from_rotation_z(angle);
    let scaled = |x: f64| DMat4::from_scale(DVec3::new(x, 1.0, 2.0));
    let moved = |x: f64| DMat4::from_translation(DVec3::new(x, 3.0, 0.0));
    let start = moved(1.0) * turned(0.2) * scaled(1.0);
    for angle in [1.0, 3.0, -2.5, 1e-9] {
        let end = moved(5.0) * turned(0.2 + angle) * scaled(3.0);
        let t = trajectory(start, end, SHUTTER);
        for s in [0.1, 0.25, 0.5, 0.9] {
            let expected = moved(1.0 + 4.0 * s) * turned(0.2 + s * angle) * scaled(1.0 + 2.0 * s);
            assert!(t.at(s).abs_diff_eq(expected, 1e-12), "{angle} {s}");
        }
    }
    // By 4 radians is by 2 pi - 4 the other way.
    let t = trajectory(DMat4::IDENTITY, turned(4.0), SHUTTER);
    assert!(t.at(0.5).abs_diff_eq(turned(2.0 - PI), 1e-12));
    // A mirrored copy moves as the mirrored original.
    let mirror = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
    let plain = trajectory(turned(0.3), turned(1.4), SHUTTER);
    let mirrored = trajectory(turned(0.3) * mirror, turned(1.4) * mirror, SHUTTER);
    assert!((plain.at(0.4) * mirror).abs_diff_eq(mirrored.at(0.4), 1e-12));
}

#[test]
fn parts_of_a_motion_are_motions_of_their_own() {
    let mut random = Stream::new(3);
    for _ in 0..20 {
        let [a, b] = [(), ()].map(|()| random_transform(&mut random, 1.0));
        let whole = trajectory(a, b, [-1.0, 2.0]);
        let part = trajectory(whole.at(0.0), whole.at(1.0), SHUTTER);
        for s in [0.2, 0.5, 0.9] {
            let size = b
                .to_cols_array()
                .iter()
                .fold(1.0_f64, |a, x| a.max(x.abs()));
            assert!(part.at(s).abs_diff_eq(whole.at(s), 1e-8 * size), "{a}\n{b}");
        }
    }
}

#[test]
fn nothing_is_outside_of_what_a_box_sweeps_over() {
    let mut random = Stream::new(4);
    let box_of = |half: DVec3, centre: DVec3| BoundingBox {
        min: centre - half,
        max: centre + half,
    };
    let mut tightest = f64::INFINITY;
    for i in 0..300 {
        let sign = if i % 3 == 0 { -1.0 } else { 1.0 };
        let [a, b] = [(), ()].map(|()| random_transform(&mut random, sign));
        let mut u = || random.next::<f64>();
        let times = [u() - 0.8, 0.3 + u()];
        let t = trajectory(a, b, times);
        let own = box_of(DVec3::new(u(), u(), u()), DVec3::new(u(), u(), u()));
        let swept = swept(&t, own);
        let mut seen = BoundingBox::EMPTY;
        for k in 0..=1000 {
            let time = f64::from(k) / 1000.0;
            seen = seen.union(own.transformed(&t.at(time)));
            // Corners are farthest; points within must be inside, too.
            let p = own.min + (own.max - own.min) * DVec3::new(u(), u(), u());
            seen = seen.including(t.at(time).transform_point3(p));
        }
        assert!(seen.min.cmpge(swept.min).all() && seen.max.cmple(swept.max).all());
        // And it is not much larger.
        tightest = tightest.min(seen.radius() / swept.radius());
    }
    assert!(tightest > 0.97, "{tightest}");
}

#[test]
fn arcs_reach_beyond_both_ends() {
    // A quarter turn about the origin: x is 1 in between only.
    let own = BoundingBox {
        min: DVec3::new(1.0, 0.0, 0.0),
        max: DVec3::new(1.0, 0.0, 0.0),
    };
    let [a, b] = [-0.5 * FRAC_PI_2, 0.5 * FRAC_PI_2].map(DMat4::from_rotation_z);
    let all = swept(&trajectory(a, b, SHUTTER), own);
    assert!((1.0..1.0004).contains(&all.max.x), "{all:?}");
    // Only what the shutter sees counts.
    let half = swept(&trajectory(a, b, [0.0, 2.0]), own);
    assert!(half.max.y < 1e-3 && half.min.y < -0.7, "{half:?}");
    // After the end it stands still.
    let before = swept(&trajectory(a, b, [-3.0, -1.0]), own);
    assert!(before.radius() < 1e-9 && (before.centre().y - 0.5_f64.sqrt()).abs() < 1e-9);
}
