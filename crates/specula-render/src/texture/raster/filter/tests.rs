//! Filters against quadrature over footprints.

use super::*;
use crate::convert::narrow;
use specula_bsdf::math::Stream;
use specula_scene::Pixels;

const EWA: Interpolation = Interpolation::EWA;

/// A random picture with its pyramid.
fn random(width: u32, height: u32) -> Raster {
    let mut random = Stream::new(7);
    let values = (0..width * height).map(|_| random.next::<f32>()).collect();
    Raster::new(width, height, Pixels::floats(values, false)).with_pyramid()
}

fn lookup(filter: Interpolation, wrap: Wrap) -> Lookup {
    Lookup {
        wrap: [wrap; 2],
        filter,
        means_only: false,
    }
}

/// The mean of the picture itself over an ellipse with the weights of `ewa`, by every pixel around.
///
/// * `axes`: half axes, in texture coordinates.
fn reference(raster: &Raster, st: [f32; 2], axes: [[f32; 2]; 2], wrap: Wrap) -> f64 {
    let size = [f64::from(raster.width), -f64::from(raster.height)];
    let axes = axes.map(|a| [f64::from(a[0]) * size[0], f64::from(a[1]) * size[1]]);
    let sum = |i: usize, j: usize| axes[0][i] * axes[0][j] + axes[1][i] * axes[1][j];
    let (xx, xy, yy) = (sum(0, 0) + 1.0, sum(0, 1), sum(1, 1) + 1.0);
    let determinant = xx * yy - xy * xy;
    let x = f64::from(st[0]) * size[0] - 0.5;
    let y = (f64::from(st[1]) - 1.0) * size[1] - 0.5;
    let (mut value, mut total) = (0.0, 0.0);
    for row in floor_i32(narrow(y - yy.sqrt()))..=floor_i32(narrow(y + yy.sqrt())) + 1 {
        for column in floor_i32(narrow(x - xx.sqrt()))..=floor_i32(narrow(x + xx.sqrt())) + 1 {
            let (dx, dy) = (f64::from(column) - x, f64::from(row) - y);
            let squared = (yy * dx * dx - 2.0 * xy * dx * dy + xx * dy * dy) / determinant;
            let weight = ((-2.0 * squared).exp() - (-2.0_f64).exp()).max(0.0);
            value += weight * f64::from(raster.pixel(column, row, [wrap; 2]).r);
            total += weight;
        }
    }
    value / total
}

/// Half axes in pixels, turned, in texture coordinates.
fn axes(raster: &Raster, [long, short]: [f32; 2], turn_rad: f32) -> [[f32; 2]; 2] {
    let (sin, cos) = turn_rad.sin_cos();
    let size = [raster.width as f32, raster.height as f32];
    [[long * cos, long * sin], [-short * sin, short * cos]]
        .map(|a| [a[0] / size[0], a[1] / size[1]])
}

/// Largest and mean absolute difference between the filter and the reference over many places and turns.
fn differences(size: [u32; 2], half_axes: [f32; 2], wrap: Wrap) -> [f64; 2] {
    let raster = random(size[0], size[1]);
    let mut places = Stream::new(3);
    let (mut largest, mut sum) = (0.0_f64, 0.0);
    const COUNT: u32 = 200;
    for i in 0..COUNT {
        let st = [0, 1].map(|_| {
            let place = places.next::<f32>();
            match wrap {
                Wrap::Repeat | Wrap::Mirror => place * 1.4 - 0.2,
                Wrap::Clamp | Wrap::Black => place,
            }
        });
        let axes = axes(&raster, half_axes, i as f32);
        let found = f64::from(raster.filtered(st, axes, lookup(EWA, wrap)).r);
        let difference = (found - reference(&raster, st, axes, wrap)).abs();
        largest = largest.max(difference);
        sum += difference;
    }
    [largest, sum / f64::from(COUNT)]
}

#[test]
fn ellipses_have_their_axes() {
    let c = Ellipse::new([[3.0, 4.0], [-0.8, 0.6]]);
    let [long, short] = c.squared_axes();
    assert!((long - 25.0).abs() < 1e-4 && (short - 1.0).abs() < 1e-4);
    let (wide, squared) = c.widened(2.0);
    let [long, short] = wide.squared_axes();
    assert!((long - 25.0).abs() < 1e-4 && (short - 6.25).abs() < 1e-4 && squared == 6.25);
    // A line.
    let (wide, squared) = Ellipse::new([[0.0, 8.0], [0.0, 2.0]]).widened(4.0);
    assert!((wide.xx - 68.0 / 16.0).abs() < 1e-4 && wide.yy == 68.0 && squared == 68.0 / 16.0);
    // A circle, by diameters that are not perpendicular.
    let (unchanged, squared) = Ellipse::new([[2.0, 0.0], [0.0, 2.0]]).widened(1.0);
    assert_eq!((unchanged.xx, unchanged.xy, squared), (4.0, 0.0, 4.0));
}

/// Where pictures are magnified they are interpolated, and what is between is mixed.
#[test]
fn ellipses_under_half_a_pixel_are_points() {
    let raster = random(32, 21);
    let at = |half_axes, filter| {
        let axes = axes(&raster, half_axes, 0.3);
        raster
            .filtered([0.37, 0.81], axes, lookup(filter, Wrap::Repeat))
            .r
    };
    let unfiltered = at([0.1; 2], Interpolation::Bilinear);
    for half_axes in [[0.01, 0.01], [0.49, 0.1]] {
        assert_eq!(at(half_axes, EWA), unfiltered);
    }
    let mut last = unfiltered;
    for i in 0..200 {
        let next = at([0.45 + 0.003 * i as f32, 0.2], EWA);
        assert!((next - last).abs() < 0.01, "{i}: {last} {next}");
        last = next;
    }
    assert_ne!(last, unfiltered);
}

/// Small ellipses are evaluated in the picture itself.
#[test]
fn small_ellipses_are_exact() {
    for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Black, Wrap::Mirror] {
        for half_axes in [[1.01, 0.2], [1.01, 1.0], [7.5, 1.0]] {
            let [largest, _] = differences([32, 21], half_axes, wrap);
            assert!(largest < 4e-3, "{wrap:?} {half_axes:?}: {largest}");
        }
    }
}

/// Large ones differ by what levels of the pyramid have lost, and by the pixel of a level by which they are widened. White
/// noise, uniform in `[0, 1]` with a deviation of 0.29, has all frequencies: no picture is harder.
#[test]
fn large_ellipses_are_near_quadrature() {
    // Largest and mean difference where pictures go on, and where they end.
    for (half_axes, within, at_edges) in [
        ([1.5, 1.5], [0.2, 0.05], [0.2, 0.05]),
        ([3.0, 3.0], [0.16, 0.045], [0.16, 0.045]),
        ([12.0, 1.6], [0.06, 0.016], [0.09, 0.018]),
        ([20.0, 5.0], [0.05, 0.011], [0.12, 0.016]),
        ([40.0, 30.0], [0.025, 0.009], [0.15, 0.04]),
    ] {
        for (wrap, most) in [
            (Wrap::Repeat, within),
            (Wrap::Mirror, within),
            (Wrap::Clamp, at_edges),
            (Wrap::Black, at_edges),
        ] {
            for size in [[128, 128], [125, 87]] {
                let found = differences(size, half_axes, wrap);
                let is_near = found.iter().zip(most).all(|(f, most)| *f < most);
                assert!(is_near, "{wrap:?} {half_axes:?} {size:?}: {found:?}");
            }
        }
    }
}

/// What is longer than the longest ellipse is filtered over a wider one, of the same length.
#[test]
fn long_ellipses_are_widened() {
    let raster = random(128, 128);
    let wide = axes(&raster, [24.0, 3.0], 0.4);
    let thin = axes(&raster, [24.0, 0.5], 0.4);
    for st in [[0.3, 0.3], [0.71, 0.22]] {
        let at = |axes| raster.filtered(st, axes, lookup(EWA, Wrap::Repeat)).r;
        assert!((at(wide) - at(thin)).abs() < 1e-4);
    }
}

#[test]
fn constant_pictures_stay_constant() {
    let value = 0.3_f32;
    for size in [[64, 64], [63, 17], [1, 9], [1, 1]] {
        let pixels = Pixels::floats(vec![value; (size[0] * size[1]) as usize], false);
        let raster = Raster::new(size[0], size[1], pixels).with_pyramid();
        let mut random = Stream::new(1);
        for i in 0..500 {
            let st = [
                random.next::<f32>() * 8.0 - 4.0,
                random.next::<f32>() * 8.0 - 4.0,
            ];
            let scale = 2.0_f32.powi(i % 40 - 30);
            let axes = [0, 1].map(|_| [0, 1].map(|_| (random.next::<f32>() - 0.5) * scale));
            for filter in [Interpolation::Trilinear, EWA, Interpolation::Bilinear] {
                for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                    let found = raster.filtered(st, axes, lookup(filter, wrap)).r;
                    let ulps = (found - value).abs() / (f32::EPSILON * value);
                    assert!(
                        ulps < 12.0,
                        "{filter:?} {wrap:?} {size:?} {axes:?}: {found}"
                    );
                }
            }
        }
    }
}

/// Trilinear values are continuous in the size of footprints, between the picture itself and its mean.
#[test]
fn trilinear_goes_from_the_picture_to_its_mean() {
    let raster = random(64, 32);
    let at = |radius: f32| {
        let axes = axes(&raster, [radius, radius], 0.3);
        let trilinear = lookup(Interpolation::Trilinear, Wrap::Repeat);
        raster.filtered([0.37, 0.81], axes, trilinear).r
    };
    let unfiltered = lookup(Interpolation::Bilinear, Wrap::Repeat);
    assert_eq!(at(0.4), raster.at([0.37, 0.81], unfiltered).r);
    assert_eq!(at(64.0), raster.smallest().r);
    let mut last = at(0.4);
    for i in 0..2000 {
        let next = at(0.4 * 1.004_f32.powi(i));
        assert!((next - last).abs() < 0.01, "{i}: {last} {next}");
        last = next;
    }
    // By hand: the square around a circle of radius 2 has 4 pixels, level 2.
    let level = raster.level(2).at([0.37, 0.81], unfiltered).r;
    assert!((at(2.0) - level).abs() < 1e-5);
}

#[test]
fn footprints_that_are_no_numbers_do_no_harm() {
    let raster = random(16, 16);
    for filter in [Interpolation::Trilinear, EWA] {
        let at = |x: f32| {
            let axes = [[x, 0.0], [0.0, 0.1]];
            raster
                .filtered([0.5, 0.5], axes, lookup(filter, Wrap::Clamp))
                .r
        };
        for x in [f32::NAN, f32::INFINITY, 1e30] {
            assert_eq!(at(x), raster.smallest().r);
        }
        let far = raster.filtered(
            [1e9, -1e9],
            [[0.1, 0.0], [0.0, 0.1]],
            lookup(filter, Wrap::Clamp),
        );
        assert!(far.r.is_finite());
        let nowhere = raster.filtered([f32::NAN, 0.5], [[0.1; 2]; 2], lookup(filter, Wrap::Clamp));
        assert_eq!(nowhere, Rgb::BLACK);
    }
}
