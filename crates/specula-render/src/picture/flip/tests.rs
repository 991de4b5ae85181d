//! FLIP: known properties, and the agreement of its parts with their definitions.

use super::*;
use std::fmt::Write as _;

/// A picture with edges, gradients and colour; the same on every machine.
fn pattern(shift: f32) -> Vec<Rgb<f32>> {
    (0..40 * 30u16)
        .map(|i| {
            let (x, y) = (f32::from(i % 40), f32::from(i / 40));
            let check = f32::from(u8::from((i % 40 / 5 + i / 200) % 2 == 0));
            rgb(
                (x / 39.0) * 0.8 + shift,
                check * 0.6 + 0.1,
                0.5 + 0.5 * (0.3 * y + 9.0 * shift).sin(),
            )
        })
        .collect()
}

fn mean(map: &[f32]) -> f64 {
    let sum: f64 = map.iter().map(|&v| f64::from(v)).sum();
    sum / 1200.0
}

#[test]
fn equal_pictures_do_not_differ() {
    let p = pattern(0.0);
    assert!(flip_map(&p, &p, 40).iter().all(|&v| v == 0.0));
    assert!(hdr_flip_map(&p, &p, 40).iter().all(|&v| v == 0.0));
}

#[test]
fn ldr_is_symmetric() {
    let (a, b) = (pattern(0.0), pattern(0.13));
    assert_eq!(flip_map(&a, &b, 40), flip_map(&b, &a, 40));
}

#[test]
fn larger_differences_give_larger_values_within_bounds() {
    let base = pattern(0.0);
    let mut last = 0.0;
    let mut log = String::new();
    for shift in [0.01, 0.03, 0.1, 0.3] {
        let map = flip_map(&base, &pattern(shift), 40);
        assert!(map.iter().all(|v| (0.0..=1.0).contains(v)));
        let m = mean(&map);
        writeln!(log, "{shift}: {m}").unwrap();
        assert!(m > last, "{log}");
        last = m;
    }
}

#[test]
fn non_finite_values_count_as_black() {
    let mut a = pattern(0.0);
    let mut b = a.clone();
    a[600] = rgb(f32::NAN, f32::NAN, f32::NAN);
    b[600] = Rgb::BLACK;
    assert!(flip_map(&a, &b, 40).iter().all(|&v| v == 0.0));
    a[600] = rgb(f32::INFINITY, f32::NAN, 0.0);
    assert!(hdr_flip_map(&b, &a, 40).iter().all(|v| v.is_finite()));
}
