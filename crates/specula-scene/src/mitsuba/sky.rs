//! `sunsky`, `sky` and `sun`: Preetham's sky, as bright as Mitsuba's, and a round sun.
//!
//! Mitsuba's sky is the model of Hosek and Wilkie 2012, a fit with a large table of coefficients
//! for which no maintained crate exists. Here the sky is that of Preetham et al. 1999, painted into
//! a picture and scaled channel by channel such that the ground receives what Mitsuba's sky (ground
//! albedo 0.3) gives it; the sun's irradiance is Mitsuba's, too (`sky_table`). What differs is how
//! light is spread over the sky, most around the sun and at the horizon. `albedo` is not used.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;

use super::context::Context;
use super::element::Element;
use super::sky_table::{TABLE, TURBIDITY, ZENITH_DEG};
use super::sun;
use crate::error::SceneError;
use crate::image::Image;
use crate::num::f32_of;
use crate::scene::{EnvironmentMapping, ImageId, Light};

/// Size of the sky's picture. The horizon falls between two rows.
const SIZE: [u32; 2] = [512, 256];
/// Angular diameter of the sun, in degrees.
const APERTURE_DEG: f64 = 0.5338;

impl Context<'_> {
    /// The lights of `sunsky`, of `sky` or of `sun`.
    pub(super) fn sunsky(&mut self, element: &Element) -> Result<Vec<Light>, SceneError> {
        // Names of the 0.6 dialect, and parameters of sampling.
        element.ignore(&["resolution", "stretch", "extend", "complex_sun", "albedo"]);
        let mut to_world = element.transform("to_world")?;
        let to_sun = sun::direction(element, &to_world)?;
        if element.legacy {
            // Its sky has y up.
            to_world *= DMat4::from_rotation_x(-FRAC_PI_2);
        }
        let local = to_world.inverse().transform_vector3(to_sun).normalize();
        let turbidity = element.number("turbidity", 3.0)?.clamp(1.0, 10.0);
        let scale = element.not_negative("scale", 1.0)?;
        let sky_scale = scale * element.not_negative("sky_scale", 1.0)?;
        let sun_scale = scale * element.not_negative("sun_scale", 1.0)?;
        let radius_scale = element.not_negative("sun_radius_scale", 1.0)?;
        let aperture = element.not_negative("sun_aperture", APERTURE_DEG)? * radius_scale;
        let mut lights = Vec::new();
        if local.z < 0.0 {
            self.warn(&element.place, "the sun is below the horizon: it is night");
            return Ok(lights);
        }
        let message =
            "the sky is Preetham's (1999), scaled to the irradiance of Hosek and Wilkie's";
        if element.plugin != "sun" {
            self.warn(&element.place, message);
        }
        let [sky, sun] = irradiances(turbidity, local.z.clamp(0.0, 1.0).acos());
        if element.plugin != "sun" && sky_scale > 0.0 {
            let image = self.sky_picture(turbidity, local, sky);
            lights.push(Light::Infinite {
                radiance: Rgb::splat(f32_of(sky_scale)),
                image: Some((image, EnvironmentMapping::LatitudeLongitude)),
                to_world,
            });
        }
        if element.plugin != "sky" && sun_scale > 0.0 {
            let [r, g, b] = sun.map(|x| f32_of(x * sun_scale));
            lights.push(Light::Distant {
                irradiance: Rgb { r, g, b },
                to_light: to_sun.to_array(),
                half_angle_deg: (0.5 * aperture).min(89.0),
            });
        }
        Ok(lights)
    }

    /// The sky over the upper half of a map, black below.
    fn sky_picture(&mut self, turbidity: f64, sun: DVec3, irradiance: [f64; 3]) -> ImageId {
        let model = Preetham::new(turbidity, sun);
        let [width, height] = SIZE;
        let mut pixels = vec![[0.0_f64; 3]; (width * height / 2) as usize];
        let mut sums = [0.0; 3];
        for (y, row) in (0_u32..).zip(pixels.chunks_mut(width as usize)) {
            let theta = PI * (f64::from(y) + 0.5) / f64::from(height);
            let (sin, cos) = theta.sin_cos();
            for (x, pixel) in (0_u32..).zip(row) {
                let phi = TAU * (f64::from(x) + 0.5) / f64::from(width);
                *pixel = model.rgb(DVec3::new(sin * phi.cos(), sin * phi.sin(), cos));
                for (sum, c) in sums.iter_mut().zip(*pixel) {
                    *sum += c * cos * sin;
                }
            }
        }
        let area = TAU * PI / (f64::from(width) * f64::from(height));
        let factors: [f64; 3] = std::array::from_fn(|c| {
            if sums[c] > 0.0 {
                irradiance[c] / (sums[c] * area)
            } else {
                0.0
            }
        });
        let scaled = |p: &[f64; 3]| std::array::from_fn(|c| f32_of(p[c] * factors[c]));
        let mut pixels: Vec<[f32; 3]> = pixels.iter().map(scaled).collect();
        pixels.resize((width * height) as usize, [0.0; 3]);
        self.images.push(Image {
            name: "sky".to_owned(),
            width,
            height,
            pixels: pixels.into(),
        });
        ImageId(self.images.len() - 1)
    }
}

/// Irradiance of the ground under Mitsuba's sky, and of a surface that faces its sun.
fn irradiances(turbidity: f64, zenith_rad: f64) -> [[f64; 3]; 2] {
    let (i, s) = cell(&TURBIDITY, turbidity);
    let (j, t) = cell(&ZENITH_DEG, zenith_rad.to_degrees());
    let at = |c: usize| {
        let log = |i: usize, j: usize| TABLE[i][j][c].ln();
        let near = log(i, j) * (1.0 - t) + log(i, j + 1) * t;
        let far = log(i + 1, j) * (1.0 - t) + log(i + 1, j + 1) * t;
        (near * (1.0 - s) + far * s).exp()
    };
    [[at(0), at(1), at(2)], [at(3), at(4), at(5)]]
}

/// The cell of a grid in which `x` lies, and where within it, in `[0, 1]`.
fn cell(grid: &[f64], x: f64) -> (usize, f64) {
    let i = grid.partition_point(|g| *g <= x).clamp(1, grid.len() - 1) - 1;
    (i, ((x - grid[i]) / (grid[i + 1] - grid[i])).clamp(0.0, 1.0))
}

/// The sky of Preetham, Shirley and Smits 1999: Perez's distribution (their eq. 3) of luminance and
/// chromaticity, with the coefficients of their appendix A.2.
struct Preetham {
    sun: DVec3,
    /// A to E of luminance Y, x and y.
    perez: [[f64; 5]; 3],
    /// Value at the zenith over Perez's there.
    scale: [f64; 3],
}

impl Preetham {
    /// * `sun`: unit, z up.
    fn new(turbidity: f64, sun: DVec3) -> Self {
        let t = turbidity;
        let perez = [
            [
                0.1787 * t - 1.4630,
                -0.3554 * t + 0.4275,
                -0.0227 * t + 5.3251,
                0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703,
            ],
            [
                -0.0193 * t - 0.2592,
                -0.0665 * t + 0.0008,
                -0.0004 * t + 0.2125,
                -0.0641 * t - 0.8989,
                -0.0033 * t + 0.0452,
            ],
            [
                -0.0167 * t - 0.2608,
                -0.0950 * t + 0.0092,
                -0.0079 * t + 0.2102,
                -0.0441 * t - 1.6537,
                -0.0109 * t + 0.0529,
            ],
        ];
        let zenith_rad = sun.z.clamp(-1.0, 1.0).acos();
        let zenith = zenith_values(t, zenith_rad);
        let scale = std::array::from_fn(|i| zenith[i] / distribution(&perez[i], 1.0, zenith_rad));
        Self { sun, perez, scale }
    }

    /// Linear sRGB in a direction above the horizon, in an arbitrary unit.
    fn rgb(&self, direction: DVec3) -> [f64; 3] {
        let cosine = direction.z.max(1e-3);
        let gamma = direction.dot(self.sun).clamp(-1.0, 1.0).acos();
        let at = |i: usize| self.scale[i] * distribution(&self.perez[i], cosine, gamma);
        let (luminance, x, y) = (at(0).max(0.0), at(1), at(2).max(1e-3));
        let (big_x, big_z) = (luminance * x / y, luminance * (1.0 - x - y) / y);
        // IEC 61966-2-1.
        [
            3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z,
            -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z,
            0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z,
        ]
        .map(|c| c.max(0.0))
    }
}

/// Perez et al. 1993: `(1 + A exp(B / cos)) (1 + C exp(D gamma) + E cos^2 gamma)`.
fn distribution(&[a, b, c, d, e]: &[f64; 5], cosine: f64, gamma: f64) -> f64 {
    (1.0 + a * (b / cosine).exp()) * (1.0 + c * (d * gamma).exp() + e * gamma.cos().powi(2))
}

/// Y in kcd/m^2, x and y at the zenith.
fn zenith_values(t: f64, sun: f64) -> [f64; 3] {
    let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * sun);
    let luminance = (4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192;
    let cubic = |rows: [[f64; 4]; 3]| {
        let row = |r: [f64; 4]| ((r[0] * sun + r[1]) * sun + r[2]) * sun + r[3];
        (row(rows[0]) * t + row(rows[1])) * t + row(rows[2])
    };
    let x = cubic([
        [0.001_66, -0.003_75, 0.002_09, 0.0],
        [-0.029_03, 0.063_77, -0.032_02, 0.003_94],
        [0.116_93, -0.211_96, 0.060_52, 0.258_86],
    ]);
    let y = cubic([
        [0.002_75, -0.006_10, 0.003_17, 0.0],
        [-0.042_14, 0.089_70, -0.041_53, 0.005_16],
        [0.153_46, -0.267_56, 0.066_70, 0.266_88],
    ]);
    [luminance.max(1e-3), x, y]
}
