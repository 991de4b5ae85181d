//! Moments beside sums over interpolated pictures.

use super::*;
use crate::texture::raster::Lookup;
use specula_bsdf::math::Stream;
use specula_scene::scene::Interpolation;

/// Normals up to 45 degrees off, as colours.
fn random(width: u32, height: u32) -> Raster {
    let mut random = Stream::new(11);
    let colours = (0..width * height).map(|_| {
        let [x, y] = [(); 2].map(|()| 1.4 * random.next::<f32>() - 0.7);
        [0.5 + 0.5 * x, 0.5 + 0.5 * y, 1.0]
    });
    Raster::new(width, height, colours.collect())
}

fn normal(c: Rgb<f32>) -> [f32; 3] {
    [c.r, c.g, c.b].map(|v| 2.0 * v - 1.0)
}

/// Sums of slopes and of their products over many points of the picture.
fn brute_force(raster: &Raster, wrap: Wrap, side: u32) -> [f64; 5] {
    let lookup = Lookup {
        wrap: [wrap; 2],
        filter: Interpolation::Bilinear,
        means_only: false,
    };
    let mut sums = [0.0; 5];
    for i in 0..side * side {
        let [s, t] = [i % side, i / side].map(|k| (k as f32 + 0.5) / side as f32);
        let [p, q] = slope_of(normal(raster.at([s, t], lookup))).map(f64::from);
        for (sum, v) in sums.iter_mut().zip([p, q, p * p, p * q, q * q]) {
            *sum += v / f64::from(side * side);
        }
    }
    sums
}

/// The moments of the whole picture against sums over a million points of it.
#[test]
fn moments_are_those_of_interpolated_normals() {
    for [width, height] in [[8, 8], [7, 12]] {
        let raster = random(width, height);
        let [slopes, squares] = raster.slope_moments([Wrap::Repeat; 2], normal);
        let [mean, second] = [&slopes, &squares].map(|r| r.level(r.smaller.len()).pixels.rgb(0));
        let found = [mean[0], mean[1], second[0], second[1], second[2]].map(f64::from);
        let expected = brute_force(&raster, Wrap::Repeat, 840);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-4, "{found} {expected}");
        }
        assert!((mean[2] - 1.0).abs() < 1e-6);
        // Those at the pixel centres vary more than twice as much.
        let centres = raster.pixels.iter().map(|c| {
            let [p, _] = slope_of(normal(c.into()));
            f64::from(p * p)
        });
        let at_centres = centres.sum::<f64>() / f64::from(width * height);
        assert!(found[2] < 0.5 * at_centres, "{} {at_centres}", found[2]);
    }
}

/// Of slopes that are linear in the column, the moments of a pixel are known: over the weight `1 - |x|` the mean is the
/// pixel's own and the variance is 1/6.
#[test]
fn pixels_have_the_moments_over_what_they_have_a_share_in() {
    let slope = 0.05;
    let colours = (0..64).map(|i| [0.5 + 0.5 * slope * (i % 8) as f32, 0.5, 1.0]);
    let raster = Raster::new(8, 8, colours.collect());
    let [slopes, squares] = raster.slope_moments([Wrap::Clamp; 2], normal);
    for x in 1..7_u8 {
        let at = 3 * 8 + usize::from(x);
        let expected = slope * f32::from(x);
        let [mean, _, _] = slopes.pixels.rgb(at);
        let [second, mixed, other] = squares.pixels.rgb(at);
        assert!((mean - expected).abs() < 1e-6, "{mean} {expected}");
        let variance = second - mean * mean;
        assert!((variance - slope * slope / 6.0).abs() < 1e-6, "{variance}");
        assert!(mixed.abs() < 1e-6 && other.abs() < 1e-6);
    }
}

#[test]
fn slopes_are_bounded() {
    assert_eq!(slope_of([0.3, -0.6, 0.5]), [0.6, -1.2]);
    assert_eq!(slope_of([0.0, 0.0, -1.0]), [0.0; 2]);
    assert_eq!(slope_of([0.0; 3]), [0.0; 2]);
    for z in [0.0, -0.5, 1e-6] {
        let [p, q] = slope_of([0.6, 0.8, z]);
        assert!((p - 6.0).abs() < 1e-4 && (q - 8.0).abs() < 1e-4, "{p} {q}");
    }
    assert_eq!(slope_of([f32::NAN, 0.0, f32::NAN]), [0.0; 2]);
}
