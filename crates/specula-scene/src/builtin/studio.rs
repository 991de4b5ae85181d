//! The studio around the stage: a dim gradient with strip lights, as a picture of all directions.

use crate::Image;
use crate::num::f32_of;

const WIDTH: u32 = 512;
const HEIGHT: u32 = 256;

/// A strip light: radiance within a soft rectangle of azimuth and elevation, in degrees.
struct Strip {
    azimuth_deg: f64,
    elevation_deg: f64,
    half_width_deg: f64,
    half_height_deg: f64,
    radiance: [f64; 3],
}

/// Narrow strips: what anisotropy stretches and roughness blurs. The viewer stands at azimuth 270.
const STRIPS: [Strip; 4] = [
    Strip {
        azimuth_deg: 225.0,
        elevation_deg: 35.0,
        half_width_deg: 3.0,
        half_height_deg: 30.0,
        radiance: [7.0, 6.3, 5.4],
    },
    Strip {
        azimuth_deg: 240.0,
        elevation_deg: 35.0,
        half_width_deg: 1.5,
        half_height_deg: 30.0,
        radiance: [7.0, 6.3, 5.4],
    },
    Strip {
        azimuth_deg: 310.0,
        elevation_deg: 28.0,
        half_width_deg: 4.0,
        half_height_deg: 24.0,
        radiance: [4.2, 5.0, 6.4],
    },
    Strip {
        azimuth_deg: 180.0,
        elevation_deg: 20.0,
        half_width_deg: 8.0,
        half_height_deg: 12.0,
        radiance: [2.4, 2.5, 2.8],
    },
];

/// Latitude and longitude, +z in the first row, azimuth along the columns.
pub(crate) fn environment() -> Image {
    let mut pixels = Vec::with_capacity((WIDTH * HEIGHT) as usize);
    for row in 0..HEIGHT {
        let elevation = 90.0 - 180.0 * (f64::from(row) + 0.5) / f64::from(HEIGHT);
        for column in 0..WIDTH {
            let azimuth = 360.0 * (f64::from(column) + 0.5) / f64::from(WIDTH);
            pixels.push(radiance(azimuth, elevation).map(f32_of));
        }
    }
    Image {
        name: "studio".to_owned(),
        width: WIDTH,
        height: HEIGHT,
        pixels,
    }
}

fn radiance(azimuth_deg: f64, elevation_deg: f64) -> [f64; 3] {
    let up = 0.5 + 0.5 * elevation_deg.to_radians().sin();
    let ambient = 0.05 + 0.42 * up * up;
    let mut sum = [0.92 * ambient, 0.97 * ambient, 1.1 * ambient];
    for strip in &STRIPS {
        let around = (azimuth_deg - strip.azimuth_deg + 540.0).rem_euclid(360.0) - 180.0;
        let share = soft_box(around, strip.half_width_deg)
            * soft_box(elevation_deg - strip.elevation_deg, strip.half_height_deg);
        for (s, r) in sum.iter_mut().zip(strip.radiance) {
            *s += share * r;
        }
    }
    sum
}

/// 1 within `half_width`, 0 a degree and a half beyond, smooth between.
fn soft_box(x: f64, half_width: f64) -> f64 {
    let t = ((half_width + 1.5 - x.abs()) / 1.5).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_stand_out_of_the_gradient() {
        let strip = radiance(225.0, 35.0)[1];
        let beside = radiance(232.0, 35.0)[1];
        assert!(strip > 10.0 * beside, "{strip} {beside}");
        assert!(radiance(0.0, 80.0)[1] > radiance(0.0, -80.0)[1]);
    }
}
