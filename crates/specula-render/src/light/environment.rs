//! Light from infinity: a constant, or a picture of the sphere of directions.
//!
//! Pictures are interpolated bilinearly, and sampled by just that: a cell between four pixels' centres
//! is sampled by its luminance, and a point in it by the bilinear density (Pharr, Jakob and Humphreys,
//! Physically Based Rendering, 4th edition, A.5). What is sampled divided by its density is the same
//! everywhere, but for colour and the sine of the polar angle within a cell: a sun of a pixel or two
//! adds no noise of its own. (Densities constant over pixels did: a lone bright pixel had a variance
//! of 1.09 of its square.)
//!
//! The density is computed from the interpolated picture. The cells' shares of the table are the same
//! up to rounding, which moves their borders by 2^-25 of all light at most.

mod axis;
mod batch;
mod picture;

use glam::DMat3;
use specula_bsdf::math::rgb;
use specula_bsdf::{Real, Rgb, Vec3};
use specula_scene::Image;
use specula_scene::scene::EnvironmentMapping;

use crate::convert::Affine;
use crate::layout;
use crate::words::Words;
pub(super) use batch::{BATCH_SIZE, DirectionBatch};
use picture::{LEAST_WEIGHT, Picture, Pixel, direction_and_sine, uv_and_sine};

/// A pixel of the picture: itself with what it is sampled by, and its place in the table.
pub(super) const BYTES_PER_PIXEL: u64 = (size_of::<Pixel>() + size_of::<f32>()) as u64;

/// The direction of light space at a point of the picture, from its upper left corner.
pub(crate) fn direction(mapping: EnvironmentMapping, uv: [f32; 2]) -> Vec3<f32> {
    direction_and_sine(mapping, uv).0
}

/// One infinite light.
#[derive(Clone, Debug)]
pub(crate) struct Environment {
    /// Factor on the picture.
    radiance: Rgb<f32>,
    picture: Option<Box<Picture>>,
    /// Share of a constant light that is not left to lobes.
    least_weight: f32,
    to_world: Affine,
    to_light: Affine,
}

impl Environment {
    /// * `to_world`: light space to world space; lengths in it do not matter.
    /// * `beside_lobes`: whether lobes are sampled from as well, weighted against this.
    pub(crate) fn new(
        radiance: Rgb<f32>,
        image: Option<(&Image, EnvironmentMapping)>,
        to_world: &glam::DMat4,
        beside_lobes: bool,
    ) -> Self {
        let m = DMat3::from_mat4(*to_world);
        // A scale (of the file's whole world) is no matter of directions.
        let m = m * m.determinant().abs().cbrt().recip();
        Self {
            radiance,
            picture: image.and_then(|(image, mapping)| {
                Picture::new(image, mapping, beside_lobes).map(Box::new)
            }),
            least_weight: if beside_lobes { LEAST_WEIGHT } else { 1.0 },
            to_world: Affine::linear(&m),
            to_light: Affine::linear(&m.inverse()),
        }
    }

    /// Factor, maps and picture, for shaders; `prefix` goes in front. Returns the place of that.
    pub(super) fn flatten(&self, prefix: u32, to: &mut Words) -> u32 {
        let tables = self.picture.as_ref().map(|p| p.flatten_tables(to));
        let place = to.offset();
        to.id(prefix);
        let record = to.offset();
        to.colour(self.radiance);
        to.field(record, layout::ENVIRONMENT_TO_WORLD);
        to.affine(&self.to_world);
        to.field(record, layout::ENVIRONMENT_TO_LIGHT);
        to.affine(&self.to_light);
        to.field(record, layout::ENVIRONMENT_IS_PICTURE);
        to.flag(self.picture.is_some());
        if let (Some(picture), Some(tables)) = (&self.picture, tables) {
            picture.flatten(record, tables, to);
        }
        place
    }

    /// Radiance from the direction `wi` (unit, world), and the density in 1/sr with which
    /// [`Environment::sample`] samples it.
    #[inline]
    pub(crate) fn arriving(&self, wi: Vec3<f32>) -> (Rgb<f32>, f32) {
        match &self.picture {
            None => (self.radiance, 0.25 * f32::INV_PI),
            Some(p) => {
                let w = self.to_light.vector(wi).normalize();
                let (uv, sine) = uv_and_sine(p.mapping, w);
                let ([r, g, b, strength], row) = p.look_up(uv);
                let pdf = Picture::pdf(strength, p.density(row), sine);
                (rgb(r, g, b) * self.radiance, pdf)
            }
        }
    }

    /// A direction (unit, world), its radiance and its density.
    #[inline]
    pub(crate) fn sample(&self, u: [f32; 2]) -> Option<(Vec3<f32>, Rgb<f32>, f32)> {
        match &self.picture {
            None => Some((
                specula_bsdf::math::warp::uniform_sphere(u),
                self.radiance,
                0.25 * f32::INV_PI,
            )),
            Some(p) => {
                let (uv, [r, g, b, strength], row) = p.sample(u);
                let (w, sine) = direction_and_sine(p.mapping, uv);
                let pdf = Picture::pdf(strength, p.density(row), sine);
                let wi = self.to_world.vector(w).normalize();
                (pdf > 0.0).then(|| (wi, rgb(r, g, b) * self.radiance, pdf))
            }
        }
    }

    /// Integral over the sphere of directions of what is sampled by, for the choice between lights.
    pub(crate) fn sampled_integral(&self) -> f64 {
        let factor = f64::from(self.radiance.luminance().max(self.radiance.mean()));
        factor
            * match &self.picture {
                None => f64::from(self.least_weight) * 4.0 * core::f64::consts::PI,
                Some(p) => p.integral(),
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::floor_index;
    use crate::sampler::Sampler;
    use specula_bsdf::math::vec3;

    pub(super) fn sky(mapping: EnvironmentMapping, beside_lobes: bool) -> Environment {
        let (width, height) = (12_u32, 12_u32);
        let pixels: Vec<[f32; 3]> = (0..width * height)
            .map(|i| match (i % width, i / width) {
                (7, 2) => [9.0, 4.0, 1.0],
                (x, _) if x % 3 == 0 => [0.0; 3],
                (x, y) => [0.1 * x as f32, 0.2, 0.05 * y as f32],
            })
            .collect();
        let image = Image {
            name: "sky".into(),
            width,
            height,
            pixels: pixels.into(),
        };
        let turn = glam::DMat4::from_rotation_x(0.7) * glam::DMat4::from_rotation_z(2.0);
        Environment::new(Rgb::WHITE, Some((&image, mapping)), &turn, beside_lobes)
    }

    pub(super) const MAPPINGS: [EnvironmentMapping; 3] = [
        EnvironmentMapping::EqualAreaOctahedral,
        EnvironmentMapping::LatitudeLongitude,
        EnvironmentMapping::LatitudeLongitudePoles,
    ];

    /// Cells of equal solid angle, `z` by `phi`.
    const CELLS: [u32; 2] = [8, 16];

    #[test]
    fn densities_integrate_to_one_and_match_where_samples_fall() {
        let [rows, columns] = CELLS;
        let cells = (rows * columns) as usize;
        for (mapping, beside_lobes) in MAPPINGS.into_iter().flat_map(|m| [(m, false), (m, true)]) {
            let sky = sky(mapping, beside_lobes);
            let mut expected = vec![0.0_f64; cells];
            let fine = 96;
            for i in 0..rows * fine {
                for j in 0..columns * fine {
                    let z = (i as f32 + 0.5) / (rows * fine) as f32 * 2.0 - 1.0;
                    let phi = (j as f32 + 0.5) / (columns * fine) as f32 * core::f32::consts::TAU;
                    let r = (1.0 - z * z).sqrt();
                    let pdf = sky.arriving(vec3(r * phi.cos(), r * phi.sin(), z)).1;
                    expected[(i / fine * columns + j / fine) as usize] += f64::from(pdf);
                }
            }
            let solid_angle = 4.0 * core::f64::consts::PI;
            let per_point = solid_angle / f64::from(rows * columns * fine * fine);
            let integral: f64 = expected.iter().sum::<f64>() * per_point;
            assert!((integral - 1.0).abs() < 2e-3, "{mapping:?}: {integral}");

            let n = 200_000_u32;
            let mut found = vec![0.0_f64; cells];
            for i in 0..n {
                let u = Sampler::new([i, 1], 0, 5).camera();
                let (wi, radiance, pdf) = sky.sample([u[0], u[1]]).unwrap();
                let (looked_up, again) = sky.arriving(wi);
                assert!((again - pdf).abs() < 0.02 * pdf + 1e-3 || near_an_edge(&sky, wi));
                assert!((looked_up - radiance).max_channel().abs() < 1e-3);
                let row = floor_index((wi.z + 1.0) / 2.0 * rows as f32).min(rows as usize - 1);
                let turn = (wi.y.atan2(wi.x) / core::f32::consts::TAU).rem_euclid(1.0);
                let column = floor_index(turn * columns as f32).min(columns as usize - 1);
                found[row * columns as usize + column] += 1.0;
            }
            let chi_square: f64 = expected
                .iter()
                .zip(&found)
                .map(|(e, f)| {
                    let e = e * per_point * f64::from(n);
                    (f - e) * (f - e) / e
                })
                .sum();
            // 127 degrees of freedom: mean 127, standard deviation 16.
            assert!(chi_square < 127.0 + 5.0 * 16.0, "{mapping:?}: {chi_square}");
        }
    }

    /// Whether a direction is so near the edge of a cell that rounding may choose the other side.
    fn near_an_edge(sky: &Environment, wi: Vec3<f32>) -> bool {
        let Some(p) = &sky.picture else { return false };
        let (uv, _) = uv_and_sine(p.mapping, sky.to_light.vector(wi).normalize());
        [0, 1].iter().any(|&k| {
            let x = 2.0 * uv[k] * p.axes[k].steps;
            (x - x.round()).abs() < 2e-3
        })
    }

    /// A lone bright pixel, a sun, is sampled in proportion to its light.
    #[test]
    fn a_sun_of_one_pixel_adds_no_noise() {
        for mapping in MAPPINGS {
            let (width, height) = (64, 48);
            let mut pixels = vec![[0.01; 3]; 64 * 48];
            pixels[20 * 64 + 31] = [5e4; 3];
            let name = "sun".into();
            let image = Image {
                name,
                width,
                height,
                pixels: pixels.into(),
            };
            let identity = glam::DMat4::IDENTITY;
            let sky = Environment::new(Rgb::WHITE, Some((&image, mapping)), &identity, false);
            let all = sky.sampled_integral();
            for i in 0..2000 {
                let u = Sampler::new([i, 1], 0, 5).camera();
                let (_, radiance, pdf) = sky.sample([u[0], u[1]]).unwrap();
                let ratio = f64::from(radiance.g / pdf) / all;
                assert!((ratio - 1.0).abs() < 0.05, "{mapping:?}: {ratio}");
            }
        }
    }

    #[test]
    fn no_light_has_density_zero() {
        for (mapping, beside_lobes) in MAPPINGS.into_iter().flat_map(|m| [(m, false), (m, true)]) {
            let sky = sky(mapping, beside_lobes);
            for i in 0..20_000 {
                let u = Sampler::new([i, 2], 0, 5).camera();
                let wi = specula_bsdf::math::warp::uniform_sphere([u[0], u[1]]);
                let (radiance, pdf) = sky.arriving(wi);
                assert!(pdf > 0.0 || radiance.is_black(), "{wi:?}");
            }
        }
    }

    #[test]
    fn interpolation_is_continuous_over_the_edges_of_the_square() {
        let sky = sky(EnvironmentMapping::EqualAreaOctahedral, false);
        let p = sky.picture.as_ref().unwrap();
        for i in 0..1000 {
            // Neighbouring directions on either side of the seams.
            let t = i as f32 / 1000.0;
            let w = direction(p.mapping, [t, 1e-4]);
            let (a, b) = (w, (w + vec3(2e-4, -3e-4, 0.0)).normalize());
            let [a, b] = [a, b].map(|w| p.look_up(uv_and_sine(p.mapping, w).0).0);
            let jump = (0..4).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max);
            assert!(jump < 0.1, "at {t}: {jump}");
        }
    }
}
