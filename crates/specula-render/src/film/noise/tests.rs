//! Films of known distributions: light tails, Pareto tails, single fireflies.

use specula_bsdf::{Rgb, Vec3};

use super::super::PixelSample;
use super::super::adaptive::PATIENCE;
use super::*;

/// Uniform random in `(0, 1)` (Steele et al. 2014, SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 + 0.5 / (1_u64 << 53) as f64
    }

    /// Of mean 1 and variance 1.
    fn exponential(&mut self) -> f64 {
        -self.next().ln()
    }

    /// Of mean 1, with `P(x > t) ~ t^-tail`; the variance is infinite for tails below 2.
    fn pareto(&mut self, tail: f64) -> f64 {
        (tail - 1.0) / tail * self.next().powf(-1.0 / tail)
    }
}

fn add(pixel: &mut PixelSums, value: f64) {
    let sample = PixelSample {
        colour: Rgb::splat(narrow(value)),
        albedo: Rgb::WHITE,
        normal: Vec3::Z,
        depth: None,
    };
    assert!(pixel.add(&sample, 1.0));
}

fn film(size: u32) -> FilmBuffer {
    FilmBuffer::new([size; 2], [0, size, 0, size], 0)
}

/// Adds samples to every pixel, by its number.
fn fill(film: &mut FilmBuffer, samples: u32, mut value: impl FnMut(usize) -> f64) {
    let pixels = film.tiles.iter_mut().flat_map(|t| t.pixels.iter_mut());
    for (i, p) in pixels.enumerate() {
        for _ in 0..samples {
            add(p, value(i));
        }
    }
}

/// The true squared errors of pixels whose mean is 1, as the estimate weighs them.
fn true_errors(film: &FilmBuffer) -> Vec<f64> {
    film.tiles
        .iter()
        .flat_map(|t| t.pixels.iter())
        .map(|p| (p.luminance_and_deviation()[0] - 1.0).powi(2) / (1.0 + DARKEST))
        .collect()
}

fn root_mean(squares: &[f64]) -> f64 {
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// The true error of all but the worst so many.
fn all_but_worst(film: &FilmBuffer, count: usize) -> f64 {
    let mut squares = true_errors(film);
    squares.sort_by(f64::total_cmp);
    root_mean(&squares[..squares.len() - count])
}

#[test]
fn estimates_are_true_where_tails_are_light() {
    let mut random = Random(1);
    for samples in [8, 32, 256] {
        let mut film = film(64);
        // Noise that differs from pixel to pixel by factors of up to 16.
        fill(&mut film, samples, |i| {
            let spread = [1.0, 0.25, 0.0625][i % 3];
            1.0 + spread * (random.exponential() - 1.0)
        });
        let (found, expected) = (f64::from(film.noise()), root_mean(&true_errors(&film)));
        assert!(
            (found / expected - 1.0).abs() < 0.1,
            "{samples} samples: {found}, {expected}"
        );
        let estimate = film.noise_estimate();
        assert!(estimate.left_out <= 64 * 64 / ONE_IN);
        assert!(
            samples < 32 || (estimate.left_out == 0 && estimate.relative == estimate.of_all),
            "{estimate:?}"
        );
    }
}

/// However large a sample is, it moves the estimate neither up nor, by the picture's brightness, down.
#[test]
fn one_sample_does_not_move_the_estimate() {
    let mut random = Random(2);
    let mut quiet = film(48);
    fill(&mut quiet, 64, |_| random.exponential());
    let before = quiet.noise_estimate();
    for value in [10.0, 1e2, 1e4, 1e6, 1e9, 1e18] {
        let mut film = quiet.clone();
        add(&mut film.tiles[4].pixels[100], value);
        let after = film.noise_estimate();
        let ratio = after.relative / before.relative;
        assert!((0.99..1.02).contains(&ratio), "{value}: {ratio}");
        // The test can fail: that of all pixels does jump.
        if value >= 1e4 {
            assert!(after.of_all > 2.0 * before.of_all, "{after:?}");
            assert_eq!(after.left_out, 1);
            assert!(after.share_left_out > 0.7, "{after:?}");
        }
    }
}

/// A few pixels in a thousand are met by rare light without variance, as caustics have.
#[test]
fn estimates_fall_where_some_pixels_have_heavy_tails() {
    let mut random = Random(3);
    let mut film = film(96);
    let (mut last, mut largest_jump, mut largest_rise) = ([f64::INFINITY; 2], 1.0, 1.0_f64);
    let mut count = 0;
    for total in [16, 32, 64, 128, 256, 512, 1024, 2048] {
        fill(&mut film, total - count, |i| {
            if i % 333 == 7 && random.next() < 2e-4 {
                1e5 * random.pareto(1.2)
            } else {
                random.exponential()
            }
        });
        count = total;
        let estimate = film.noise_estimate();
        let now = [estimate.relative, estimate.of_all].map(f64::from);
        largest_rise = largest_rise.max(now[0] / last[0]);
        largest_jump = f64::max(largest_jump, now[1] / last[1]);
        last = now;
        let expected = 1.0 / f64::from(count).sqrt();
        let ratio = now[0] / expected;
        assert!((0.9..1.15).contains(&ratio), "{count}: {ratio}");
    }
    assert!(largest_rise <= 1.0, "{largest_rise}");
    // The test can fail.
    assert!(largest_jump > 1.5, "{largest_jump}");
}

/// Where all pixels have tails without variance, what is left out is little, and the rest is not said to be
/// better than it is.
#[test]
fn pictures_that_are_noisy_all_over_are_said_to_be() {
    let mut random = Random(4);
    for tail in [1.3, 1.6] {
        let mut film = film(96);
        let mut count = 0;
        for total in [16, 64, 256, 1024] {
            fill(&mut film, total - count, |_| random.pareto(tail));
            count = total;
            let estimate = film.noise_estimate();
            assert!(estimate.left_out <= 96 * 96 / ONE_IN, "{estimate:?}");
            // The worst are left out of both.
            let expected = all_but_worst(&film, 96 * 96 / ONE_IN);
            let ratio = f64::from(estimate.relative) / expected;
            assert!((0.5..2.0).contains(&ratio), "{tail}, {count}: {ratio}");
        }
    }
    // A light that one sample in a hundred finds: every pixel is carried by too few samples.
    let mut film = film(96);
    fill(&mut film, 64, |_| {
        if random.next() < 0.01 { 100.0 } else { 0.0 }
    });
    let estimate = film.noise_estimate();
    assert_eq!(estimate.left_out, 96 * 96 / ONE_IN);
    let expected = root_mean(&true_errors(&film));
    let ratio = f64::from(estimate.relative) / expected;
    // Where none was found, the variance of zeros is zero.
    assert!((0.6..1.4).contains(&ratio), "{ratio}");
}

#[test]
fn what_is_left_out_is_told() {
    let mut random = Random(5);
    let mut film = film(64);
    fill(&mut film, 64, |i| {
        if i < 300 {
            random.pareto(1.02) * 10.0
        } else {
            1.0
        }
    });
    let estimate = film.noise_estimate();
    assert_eq!((estimate.left_out, estimate.pixels), (20, 64 * 64));
    assert!(estimate.share_left_out > 0.5, "{estimate:?}");
    let whole = f64::from(estimate.of_all).powi(2) * 4096.0;
    let counted = f64::from(estimate.relative).powi(2) * (4096.0 - 20.0);
    let share = 1.0 - counted / whole;
    assert!((f64::from(estimate.share_left_out) - share).abs() < 1e-4);
    // The worst, not any.
    let survey = film.survey();
    let least = (film.tiles.iter().zip(&survey.left_out))
        .flat_map(|(t, out)| {
            let left_out = t.pixels.iter().enumerate().filter(|(i, _)| out.has(*i));
            left_out.map(|(_, p)| PixelNoise::new(p).squared_error(survey.brightness))
        })
        .fold(f64::INFINITY, f64::min);
    let most = (film.tiles.iter().zip(&survey.left_out))
        .flat_map(|(t, out)| {
            let counted = t.pixels.iter().enumerate().filter(|(i, _)| !out.has(*i));
            counted
                .filter(|(_, p)| PixelNoise::new(p).is_unknown())
                .map(|(_, p)| p)
        })
        .map(|p| PixelNoise::new(p).squared_error(survey.brightness))
        .fold(0.0, f64::max);
    assert!(most <= least && least < f64::INFINITY, "{most} {least}");
}

#[test]
fn films_without_light_or_samples_have_their_limits() {
    let empty = film(32);
    assert_eq!(empty.noise(), f32::INFINITY);
    assert_eq!(empty.noise_estimate().share_left_out, 0.0);
    let mut one = film(32);
    fill(&mut one, 2, |_| 1.0);
    one.tiles[0].pixels[3] = PixelSums::default();
    add(&mut one.tiles[0].pixels[3], 1.0);
    assert_eq!(one.noise(), f32::INFINITY);
    let mut black = film(32);
    fill(&mut black, 8, |_| 0.0);
    assert_eq!(black.noise(), 0.0);
}

/// What is not known is looked into, but not for ever.
#[test]
fn fireflies_do_not_attract_all_samples() {
    let wish = |samples: u32, value: Option<f64>| -> f64 {
        let mut random = Random(6);
        let mut film = film(48);
        fill(&mut film, samples, |_| random.exponential());
        for tile in &mut film.tiles {
            tile.rays = 3 * 256 * u64::from(samples);
        }
        if let Some(value) = value {
            for place in [10, 100, 200] {
                add(&mut film.tiles[4].pixels[place], value);
            }
        }
        let wishes = film.wishes();
        wishes[4] / wishes[0]
    };
    for value in [1e5, 1e7, 1e12] {
        let [few, without] = [Some(value), None].map(|v| wish(64, v));
        assert!(few > 2.0 * without, "{value}: {few} {without}");
        let [many, without] = [Some(value), None].map(|v| wish(PATIENCE, v));
        assert!(
            (many / without - 1.0).abs() < 0.05,
            "{value}: {many} {without}"
        );
    }
}
