//! Directions near the horizon, and what can be known there: tests of single samples and of batches sweep the same.

/// Cosines below which values are only finite and bounded: what facets see of each other is regularised there, and so
/// are half vectors shorter than 1e-10 that are not along the normal.
const COMPARED: f64 = 1e-14;

/// A unit direction that `f32` holds, with a cosine whose logarithm is uniform down to 1e-38; three in ten are below
/// the horizon.
///
/// * `u`: of the cosine, of the side; uniform in `[0, 1)`.
/// * `azimuth`: its cosine and sine.
#[must_use]
pub fn direction(u: (f64, f32), azimuth: [f32; 2]) -> [f32; 3] {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
    let z = 10.0_f64.powf(-38.0 * u.0).max(1e-38) as f32;
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    let side = if u.1 < 0.7 { 1.0 } else { -1.0 };
    [r * azimuth[0], r * azimuth[1], side * z]
}

/// Whether values at a view and a light can be held against those of `f64`.
#[must_use]
pub fn is_compared(at: [[f64; 3]; 2]) -> bool {
    let half: [f64; 3] = std::array::from_fn(|i| at[0][i] + at[1][i]);
    let across = half[0].hypot(half[1]);
    let is_regularised = across > 0.0 && across.hypot(half[2]) < 1e-10;
    !is_regularised && at.iter().all(|w| w[2].abs() >= COMPARED)
}

/// A view and a light with one component rounded once more, up or down: values as far apart as theirs are the same to
/// `f32`.
pub fn roundings(at: [[f64; 3]; 2]) -> impl Iterator<Item = [[f64; 3]; 2]> {
    (0..6).flat_map(move |k| {
        [-1.0, 1.0].map(|step| {
            let mut moved = at;
            moved[k / 3][k % 3] *= 1.0 + step * f64::from(f32::EPSILON);
            moved
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_unit_and_on_their_side() {
        for u in [0.0, 1e-3, 0.5, 1.0] {
            for (side, sign) in [(0.69, 1.0), (0.71, -1.0)] {
                let [x, y, z] = direction((u, side), [0.6, -0.8]).map(f64::from);
                assert!((x.hypot(y).hypot(z) - 1.0).abs() < 1e-6);
                assert!(z * sign > 0.9e-38 && (z.abs().log10() + 38.0 * u).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn what_is_regularised_is_not_compared() {
        let above = [0.6, 0.8, 1e-12];
        assert!(is_compared([above, [0.8, 0.6, -1e-12]]));
        assert!(!is_compared([above, [0.8, 0.6, 1e-15]]));
        assert!(!is_compared([above, [-0.6, -0.8 + 1e-13, 1e-12]]));
        assert!(is_compared([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]));
    }

    #[test]
    fn each_component_is_rounded_both_ways() {
        let at = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        let mut counts = [[0; 3]; 2];
        for moved in roundings(at) {
            for (w, i) in [0, 1].into_iter().flat_map(|w| [0, 1, 2].map(|i| (w, i))) {
                counts[w][i] += i32::from(moved[w][i] != at[w][i]);
            }
        }
        assert_eq!(counts, [[2; 3]; 2]);
    }
}
