//! A sky with and without a sun, by latitude and longitude and as an equal-area square.

use std::f64::consts::{FRAC_PI_4, PI, TAU};
use std::path::Path;

use exr::prelude::write_rgb_file;

use super::Result;

/// A disc of even radiance.
#[derive(Clone, Copy)]
pub(crate) struct Sun {
    elevation_deg: f64,
    /// Column of the map, as a share of its width.
    across: f64,
    radius_deg: f64,
    radiance: [f64; 3],
}

impl Sun {
    /// About five times the sky's irradiance on the ground, 10^5 times the sky's radiance.
    pub(crate) const LOW: Self = Self {
        elevation_deg: 38.0,
        across: 0.36,
        radius_deg: 0.25,
        radiance: [60_000.0, 54_000.0, 45_000.0],
    };

    /// The share of a small cell of a map that the disc covers.
    ///
    /// * `at`: the direction of a point of the cell, from its centre, in `[-1/2, 1/2]^2`.
    fn coverage(self, at: impl Fn([f64; 2]) -> [f64; 3]) -> f64 {
        const SIDE: u32 = 8;
        let centre = direction(TAU * self.across, PI * (0.5 - self.elevation_deg / 180.0));
        let least = (self.radius_deg * PI / 180.0).cos();
        let cos = |d: [f64; 3]| (0..3).map(|i| d[i] * centre[i]).sum::<f64>();
        if cos(at([0.0; 2])) < 0.999 {
            return 0.0;
        }
        let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
        let inside = |k: &u32| cos(at([offset(k % SIDE), offset(k / SIDE)])) >= least;
        (0..SIDE * SIDE).filter(inside).count() as f64 / f64::from(SIDE * SIDE)
    }
}

pub(super) fn direction(azimuth: f64, polar: f64) -> [f64; 3] {
    [
        polar.sin() * azimuth.sin(),
        polar.cos(),
        -polar.sin() * azimuth.cos(),
    ]
}

/// The direction of a point of the square of equal areas, as pbrt-v4 has it: the centre is +z.
///
/// Source: Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD.
fn square_direction([s, t]: [f64; 2]) -> [f64; 3] {
    let (u, v) = (2.0 * s - 1.0, 2.0 * t - 1.0);
    let d = 1.0 - (u.abs() + v.abs());
    let r = 1.0 - d.abs();
    let phi = match r == 0.0 {
        true => FRAC_PI_4,
        false => FRAC_PI_4 * ((v.abs() - u.abs()) / r + 1.0),
    };
    let planar = r * (2.0 - r * r).sqrt();
    [
        (planar * phi.cos()).copysign(u),
        (planar * phi.sin()).copysign(v),
        (1.0 - r * r).copysign(d),
    ]
}

/// Radiance of a cell of a map.
///
/// * `at`: as [`Sun::coverage`] takes it.
fn radiance(sun: Option<Sun>, at: impl Fn([f64; 2]) -> [f64; 3]) -> (f32, f32, f32) {
    let up = at([0.0; 2])[1];
    let low = (1.0 - up.abs()).powi(4);
    let mut colour = match up > 0.0 {
        true => [0.18 + 0.55 * low, 0.32 + 0.45 * low, 0.62 + 0.25 * low],
        false => [0.16, 0.14, 0.12],
    };
    if let Some(sun) = sun {
        let share = sun.coverage(at);
        (0..3).for_each(|i| colour[i] += share * sun.radiance[i]);
    }
    #[allow(
        clippy::cast_possible_truncation,
        reason = "radiances are stored in single precision"
    )]
    let [r, g, b] = colour.map(|c| c as f32);
    (r, g, b)
}

/// Writes a sky by latitude and longitude, the first and last rows at the poles, as Mitsuba's.
#[allow(
    dead_code,
    reason = "the comparison with other renderers, which shares this file, writes it"
)]
pub(super) fn write(path: &Path, width: u32, sun: Option<Sun>) -> Result<()> {
    let height = width / 2;
    let step = [TAU / f64::from(width), PI / f64::from(height - 1)];
    let pixel = |x: usize, y: usize| {
        let (azimuth, polar) = ((x as f64 + 0.5) * step[0], y as f64 * step[1]);
        radiance(sun, |[i, j]| {
            direction(azimuth + i * step[0], polar + j * step[1])
        })
    };
    write_rgb_file(path, width as usize, height as usize, pixel)?;
    Ok(())
}

/// Writes the same sky as a square of equal areas.
pub(super) fn write_square(path: &Path, side: u32, sun: Option<Sun>) -> Result<()> {
    let step = 1.0 / f64::from(side);
    let pixel = |x: usize, y: usize| {
        let centre = [x, y].map(|i| i as f64 + 0.5);
        radiance(sun, |[i, j]| {
            square_direction([step * (centre[0] + i), step * (centre[1] + j)])
        })
    };
    write_rgb_file(path, side as usize, side as usize, pixel)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_covers_its_solid_angle_in_both_maps() {
        let exact = TAU * (1.0 - (Sun::LOW.radius_deg * PI / 180.0).cos());
        let width = 2048;
        let step = [TAU / f64::from(width), PI / f64::from(width / 2 - 1)];
        let mut covered = 0.0;
        for y in 0..width / 2 {
            let polar = f64::from(y) * step[1];
            for x in 0..width {
                let azimuth = (f64::from(x) + 0.5) * step[0];
                let at = |[i, j]: [f64; 2]| direction(azimuth + i * step[0], polar + j * step[1]);
                covered += Sun::LOW.coverage(at) * polar.sin() * step[0] * step[1];
            }
        }
        assert!((covered / exact - 1.0).abs() < 0.02, "{covered} {exact}");
        let side = 2048;
        let step = 1.0 / f64::from(side);
        let mut covered = 0.0;
        for k in 0..side * side {
            let centre = [k % side, k / side].map(|i| f64::from(i) + 0.5);
            let at = |[i, j]: [f64; 2]| {
                square_direction([step * (centre[0] + i), step * (centre[1] + j)])
            };
            covered += Sun::LOW.coverage(at) * 2.0 * TAU * step * step;
        }
        assert!((covered / exact - 1.0).abs() < 0.02, "{covered} {exact}");
    }
}
