//! The studio around the stage: a dim gradient with strip lights, as a picture of all directions.

use core::f64::consts::{PI, TAU};

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

/// Narrow strips, whose reflections show anisotropy and roughness. The viewer is at azimuth 270.
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

/// The key light, which casts the shadow on a floor: large enough for soft shadows, high and to the left.
const KEY: Strip = Strip {
    azimuth_deg: 222.0,
    elevation_deg: 58.0,
    half_width_deg: 20.0,
    half_height_deg: 15.0,
    radiance: [8.0, 7.7, 7.3],
};

/// Factor on all light above a floor: white paint, whichever way it faces, stays below 1.
const EXPOSURE: f64 = 0.75;

/// Below this elevation the gradient blends into the floor's radiance.
const HORIZON_DEG: f64 = 24.0;

/// Size of the latitude-longitude map: +z in the first row, azimuth along the columns.
pub(super) fn environment() -> Image {
    picture("studio", |azimuth, elevation| {
        with_strips(ambient(elevation), azimuth, elevation)
    })
}

/// The studio above a floor that reflects `albedo` evenly: with a key light more, and with the
/// radiance of the lit floor from below the horizon, so that the floor has no visible end.
///
/// With `w` the gradient's share, `E_sky` the floor's irradiance by gradient, strips and key, and
/// `E_1` that by a radiance of `1 - w`, the floor's radiance `F` solves `pi F = albedo (E_sky + F E_1)`.
pub(crate) fn above_floor(albedo: f64) -> Image {
    let share = |elevation: f64| smoothstep(elevation / HORIZON_DEG);
    let sky = |azimuth: f64, elevation: f64| {
        if elevation < 0.0 {
            return [0.0; 3];
        }
        let gradient = ambient(elevation).map(|x| share(elevation) * x);
        let with_key = add(gradient, KEY.radiance(azimuth, elevation));
        with_strips(with_key, azimuth, elevation)
    };
    let of_sky = irradiance(sky);
    let [of_one, ..] = irradiance(|_, elevation| [1.0 - share(elevation); 3]);
    let floor = of_sky.map(|e| albedo * e / (PI - albedo * of_one));
    picture("studio above a floor", |azimuth, elevation| {
        let rest = 1.0 - share(elevation);
        add(sky(azimuth, elevation), floor.map(|f| rest * f)).map(|x| EXPOSURE * x)
    })
}

/// A picture of all directions.
///
/// * `radiance`: by azimuth and elevation in degrees.
fn picture(name: &str, radiance: impl Fn(f64, f64) -> [f64; 3]) -> Image {
    let mut pixels = Vec::with_capacity((WIDTH * HEIGHT) as usize);
    for row in 0..HEIGHT {
        let elevation = elevation_deg(row);
        pixels
            .extend((0..WIDTH).map(|column| radiance(azimuth_deg(column), elevation).map(f32_of)));
    }
    Image {
        name: name.to_owned(),
        width: WIDTH,
        height: HEIGHT,
        pixels: pixels.into(),
    }
}

/// Irradiance of a level surface, seen from above.
fn irradiance(radiance: impl Fn(f64, f64) -> [f64; 3]) -> [f64; 3] {
    let pixel = (PI / f64::from(HEIGHT)) * (TAU / f64::from(WIDTH));
    let mut sum = [0.0; 3];
    for row in 0..HEIGHT / 2 {
        let (sin, cos) = elevation_deg(row).to_radians().sin_cos();
        for column in 0..WIDTH {
            let arriving = radiance(azimuth_deg(column), elevation_deg(row));
            sum = add(sum, arriving.map(|x| x * sin * cos * pixel));
        }
    }
    sum
}

fn elevation_deg(row: u32) -> f64 {
    90.0 - 180.0 * (f64::from(row) + 0.5) / f64::from(HEIGHT)
}

fn azimuth_deg(column: u32) -> f64 {
    360.0 * (f64::from(column) + 0.5) / f64::from(WIDTH)
}

/// The gradient: dim below, brighter above.
fn ambient(elevation_deg: f64) -> [f64; 3] {
    let up = 0.5 + 0.5 * elevation_deg.to_radians().sin();
    let ambient = 0.05 + 0.42 * up * up;
    [0.92 * ambient, 0.97 * ambient, 1.1 * ambient]
}

fn with_strips(radiance: [f64; 3], azimuth_deg: f64, elevation_deg: f64) -> [f64; 3] {
    let each = STRIPS
        .iter()
        .map(|s| s.radiance(azimuth_deg, elevation_deg));
    each.fold(radiance, add)
}

impl Strip {
    fn radiance(&self, azimuth_deg: f64, elevation_deg: f64) -> [f64; 3] {
        let around = (azimuth_deg - self.azimuth_deg + 540.0).rem_euclid(360.0) - 180.0;
        let share = soft_box(around, self.half_width_deg)
            * soft_box(elevation_deg - self.elevation_deg, self.half_height_deg);
        self.radiance.map(|r| share * r)
    }
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// 1 within `half_width`, 0 a degree and a half beyond, smooth between.
fn soft_box(x: f64, half_width: f64) -> f64 {
    smoothstep((half_width + 1.5 - x.abs()) / 1.5)
}

/// 0 up to 0, 1 from 1 on, smooth between.
fn smoothstep(x: f64) -> f64 {
    let t = x.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn strips_stand_out_of_the_gradient() {
        let whole = |azimuth, elevation| with_strips(ambient(elevation), azimuth, elevation)[1];
        let (strip, beside) = (whole(225.0, 35.0), whole(232.0, 35.0));
        assert!(strip > 10.0 * beside, "{strip} {beside}");
        assert!(whole(0.0, 80.0) > whole(0.0, -80.0));
    }

    #[test]
    fn white_paint_above_a_floor_stays_below_1() {
        let image = above_floor(0.2);
        let direction = |row: u32, column: u32| {
            let (z, horizontal) = elevation_deg(row).to_radians().sin_cos();
            let (y, x) = azimuth_deg(column).to_radians().sin_cos();
            DVec3::new(horizontal * x, horizontal * y, z)
        };
        let every = |step: usize, end: u32| (0..end).step_by(step);
        let mut most: f64 = 0.0;
        for (row, column) in every(16, HEIGHT).flat_map(|r| every(16, WIDTH).map(move |c| (r, c))) {
            let normal = direction(row, column);
            let mut sum = [0.0; 3];
            for (row, column) in every(2, HEIGHT).flat_map(|r| every(2, WIDTH).map(move |c| (r, c)))
            {
                let cos = normal.dot(direction(row, column)).max(0.0);
                let area = elevation_deg(row).to_radians().cos();
                let arriving = image
                    .pixels
                    .rgb((row * WIDTH + column) as usize)
                    .map(f64::from);
                sum = add(sum, arriving.map(|x| cos * area * x));
            }
            let reflected = 4.0 * TAU / f64::from(HEIGHT) / f64::from(WIDTH);
            most = sum.into_iter().fold(most, |m, x| m.max(reflected * x));
        }
        assert!((0.9..1.0).contains(&most), "{most}");
    }

    #[test]
    fn a_floor_reflects_as_much_as_comes_from_its_horizon_and_from_below() {
        let image = above_floor(0.2);
        let at = |row: u32, column: u32| image.pixels.rgb((row * WIDTH + column) as usize);
        let mut lit = [0.0_f64; 3];
        for row in 0..HEIGHT / 2 {
            // The integral of the cosine over a pixel's solid angle.
            let [top, bottom] =
                [row, row + 1].map(|r| (TAU * f64::from(r) / f64::from(HEIGHT)).cos());
            let weight = (top - bottom) * PI / 2.0 / f64::from(WIDTH);
            for column in 0..WIDTH {
                let arriving = at(row, column).map(f64::from);
                lit = add(lit, arriving.map(|x| weight * x));
            }
        }
        for (channel, e) in lit.into_iter().enumerate() {
            let floor = 0.2 * e / PI;
            for row in [HEIGHT / 2 - 1, HEIGHT / 2, HEIGHT - 1] {
                let seen = f64::from(at(row, 384)[channel]);
                assert!((seen / floor - 1.0).abs() < 2e-3, "{row}: {seen} {floor}");
            }
        }
    }
}
