//! Light from infinity: a constant, or a picture of the sphere of directions.
//!
//! Pictures are interpolated bilinearly and sampled by a piecewise constant distribution over their
//! pixels. A pixel's weight is the mean of the interpolated luminance over it (a tent of weights 1,
//! 6, 1 over 8 along each axis), so that no direction with light has density zero, even next to a
//! lone bright pixel.

use glam::DMat3;
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Real, Rgb, Vec3};
use specula_scene::Image;
use specula_scene::scene::EnvironmentMapping;

use super::octahedral::{direction_of, square_of};
use super::piecewise::Piecewise;
use crate::convert::{Affine, floor_i32};

/// The direction of light space at a point of the picture, from its upper left corner.
pub(crate) fn direction(mapping: EnvironmentMapping, [u, v]: [f32; 2]) -> Vec3<f32> {
    match mapping {
        EnvironmentMapping::EqualAreaOctahedral => direction_of([u, v]),
        EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
            let (sin_phi, cos_phi) = (u * core::f32::consts::TAU).sin_cos();
            let (sin, cos) = (v * core::f32::consts::PI).sin_cos();
            vec3(sin * cos_phi, sin * sin_phi, cos)
        }
    }
}

/// One infinite light.
#[derive(Clone, Debug)]
pub(crate) struct Environment {
    /// Factor on the picture.
    radiance: Rgb<f32>,
    picture: Option<Picture>,
    to_world: Affine,
    to_light: Affine,
}

#[derive(Clone, Debug)]
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
    mapping: EnvironmentMapping,
    /// Over the square; its mean is that of luminance, times sin theta for latitude and longitude.
    table: Piecewise,
}

impl Environment {
    /// * `to_world`: light space to world space; lengths in it do not matter.
    pub(crate) fn new(
        radiance: Rgb<f32>,
        image: Option<(&Image, EnvironmentMapping)>,
        to_world: &glam::DMat4,
    ) -> Self {
        let m = DMat3::from_mat4(*to_world);
        // A scale (of the file's whole world) is no matter of directions.
        let m = m * m.determinant().abs().cbrt().recip();
        Self {
            radiance,
            picture: image.and_then(|(image, mapping)| Picture::new(image, mapping)),
            to_world: Affine::linear(&m),
            to_light: Affine::linear(&m.inverse()),
        }
    }

    /// Radiance from the direction `wi` (unit, world).
    #[inline]
    pub(crate) fn radiance(&self, wi: Vec3<f32>) -> Rgb<f32> {
        match &self.picture {
            None => self.radiance,
            Some(p) => {
                let w = self.to_light.vector(wi).normalize();
                p.bilinear(p.uv(w)) * self.radiance
            }
        }
    }

    /// Density in 1/sr with which [`Environment::sample`] draws `wi`.
    #[inline]
    pub(crate) fn pdf(&self, wi: Vec3<f32>) -> f32 {
        match &self.picture {
            None => 0.25 * f32::INV_PI,
            Some(p) => {
                let w = self.to_light.vector(wi).normalize();
                p.pdf(p.uv(w))
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
                let uv = p.table.sample(u);
                let pdf = p.pdf(uv);
                let wi = self.to_world.vector(direction(p.mapping, uv)).normalize();
                (pdf > 0.0).then(|| (wi, p.bilinear(uv) * self.radiance, pdf))
            }
        }
    }

    /// Integral of luminance over the sphere of directions.
    pub(crate) fn luminous_integral(&self) -> f64 {
        use core::f64::consts::PI;
        let factor = f64::from(self.radiance.luminance().max(self.radiance.mean()));
        factor
            * match &self.picture {
                None => 4.0 * PI,
                Some(p) => match p.mapping {
                    EnvironmentMapping::EqualAreaOctahedral => 4.0 * PI * p.table.mean,
                    EnvironmentMapping::LatitudeLongitude
                    | EnvironmentMapping::LatitudeLongitudePoles => 2.0 * PI * PI * p.table.mean,
                },
            }
    }
}

impl Picture {
    /// `None` where the picture is empty or all black.
    fn new(image: &Image, mapping: EnvironmentMapping) -> Option<Self> {
        let (width, height) = (image.width as usize, image.height as usize);
        let pixels: Vec<[f32; 3]> = image
            .pixels
            .iter()
            .map(|p| p.map(|v| if v.is_finite() { v.max(0.0) } else { 0.0 }))
            .collect();
        if width == 0 || height == 0 || pixels.len() != width * height {
            return None;
        }
        let mut picture = Self {
            width,
            height,
            pixels,
            mapping,
            table: Piecewise::new([1, 1], |_, _| 0.0),
        };
        // Rows on the poles have cells between them.
        let cells = if mapping == EnvironmentMapping::LatitudeLongitudePoles {
            (height - 1).max(1)
        } else {
            height
        };
        picture.table = Piecewise::new([width, cells], |x, y| {
            let area = match mapping {
                EnvironmentMapping::EqualAreaOctahedral => 1.0,
                EnvironmentMapping::LatitudeLongitude
                | EnvironmentMapping::LatitudeLongitudePoles => {
                    ((y as f64 + 0.5) / cells as f64 * core::f64::consts::PI).sin()
                }
            };
            picture.tent(x, y) * area
        });
        Some(picture)
    }

    /// Mean over a pixel, or over a cell between rows, of the interpolated luminance.
    fn tent(&self, x: usize, y: usize) -> f64 {
        let rows: &[(i32, f64)] = match self.mapping {
            EnvironmentMapping::LatitudeLongitudePoles => &[(0, 0.5), (1, 0.5)],
            _ => &[(-1, 0.125), (0, 0.75), (1, 0.125)],
        };
        let mut sum = 0.0;
        for &(dy, wy) in rows {
            for (dx, wx) in [(-1, 0.125), (0, 0.75), (1, 0.125)] {
                let c = self.pixel(signed(x) + dx, signed(y) + dy);
                // A floor of the mean of channels: deep blue has little luminance.
                sum += wx * wy * f64::from(c.luminance().max(c.mean()));
            }
        }
        sum
    }

    /// A pixel, continued over the edges of the square as the sphere is.
    #[inline]
    fn pixel(&self, x: i32, y: i32) -> Rgb<f32> {
        let (w, h) = (signed(self.width), signed(self.height));
        let (mut x, mut y) = (x, y);
        match self.mapping {
            EnvironmentMapping::EqualAreaOctahedral => {
                // Each edge of the square is folded about its middle.
                if x < 0 || x >= w {
                    x = if x < 0 { -1 - x } else { 2 * w - 1 - x };
                    y = h - 1 - y;
                }
                if y < 0 || y >= h {
                    y = if y < 0 { -1 - y } else { 2 * h - 1 - y };
                    x = w - 1 - x;
                }
            }
            EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
                y = y.clamp(0, h - 1);
                x = x.rem_euclid(w);
            }
        }
        let at = |v: i32, n: i32| usize::try_from(v.clamp(0, n - 1)).unwrap_or(0);
        let [r, g, b] = self.pixels[at(y, h) * self.width + at(x, w)];
        rgb(r, g, b)
    }

    fn bilinear(&self, [u, v]: [f32; 2]) -> Rgb<f32> {
        let x = u * self.width as f32 - 0.5;
        let y = match self.mapping {
            EnvironmentMapping::LatitudeLongitudePoles => v * (self.height - 1) as f32,
            _ => v * self.height as f32 - 0.5,
        };
        let (x0, y0) = (floor_i32(x), floor_i32(y));
        let (fx, fy) = (x - x.floor(), y - y.floor());
        (self.pixel(x0, y0) * (1.0 - fx) + self.pixel(x0 + 1, y0) * fx) * (1.0 - fy)
            + (self.pixel(x0, y0 + 1) * (1.0 - fx) + self.pixel(x0 + 1, y0 + 1) * fx) * fy
    }

    /// Where a direction of light space lies in the picture, from its upper left corner.
    fn uv(&self, w: Vec3<f32>) -> [f32; 2] {
        match self.mapping {
            EnvironmentMapping::EqualAreaOctahedral => square_of(w),
            EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
                let phi = w.y.atan2(w.x) * (0.5 * f32::INV_PI);
                // The polar angle by atan2: acos loses half the digits at the poles.
                let theta = (w.x * w.x + w.y * w.y).sqrt().atan2(w.z);
                [if phi < 0.0 { phi + 1.0 } else { phi }, theta * f32::INV_PI]
            }
        }
    }

    /// Density per solid angle at a point of the square.
    fn pdf(&self, [u, v]: [f32; 2]) -> f32 {
        let jacobian = match self.mapping {
            EnvironmentMapping::EqualAreaOctahedral => 0.25 * f32::INV_PI,
            EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
                let sin = (v * core::f32::consts::PI).sin();
                if sin <= 0.0 {
                    return 0.0;
                }
                0.5 * f32::INV_PI * f32::INV_PI / sin
            }
        };
        self.table.density([u, v]) * jacobian
    }
}

fn signed(x: usize) -> i32 {
    i32::try_from(x).unwrap_or(i32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::floor_index;
    use crate::sampler::Sampler;

    fn sky(mapping: EnvironmentMapping) -> Environment {
        let (width, height) = (12_u32, 12_u32);
        let pixels = (0..width * height)
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
            pixels,
        };
        let turn = glam::DMat4::from_rotation_x(0.7) * glam::DMat4::from_rotation_z(2.0);
        Environment::new(Rgb::WHITE, Some((&image, mapping)), &turn)
    }

    const MAPPINGS: [EnvironmentMapping; 3] = [
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
        for mapping in MAPPINGS {
            let sky = sky(mapping);
            let mut expected = vec![0.0_f64; cells];
            let fine = 96;
            for i in 0..rows * fine {
                for j in 0..columns * fine {
                    let z = (i as f32 + 0.5) / (rows * fine) as f32 * 2.0 - 1.0;
                    let phi = (j as f32 + 0.5) / (columns * fine) as f32 * core::f32::consts::TAU;
                    let r = (1.0 - z * z).sqrt();
                    let pdf = sky.pdf(vec3(r * phi.cos(), r * phi.sin(), z));
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
                assert!((sky.pdf(wi) / pdf - 1.0).abs() < 0.02 || near_an_edge(&sky, wi));
                assert!((sky.radiance(wi) - radiance).max_channel().abs() < 1e-3);
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

    /// Whether a direction is so near the edge of a pixel that rounding may choose the other side.
    fn near_an_edge(sky: &Environment, wi: Vec3<f32>) -> bool {
        let Some(p) = &sky.picture else { return false };
        let uv = p.uv(sky.to_light.vector(wi).normalize());
        [(uv[0], p.width), (uv[1], p.height)].iter().any(|&(v, n)| {
            let x = v * n as f32;
            (x - x.round()).abs() < 1e-3
        })
    }

    #[test]
    fn no_light_has_density_zero() {
        for mapping in MAPPINGS {
            let sky = sky(mapping);
            for i in 0..20_000 {
                let u = Sampler::new([i, 2], 0, 5).camera();
                let wi = specula_bsdf::math::warp::uniform_sphere([u[0], u[1]]);
                assert!(sky.pdf(wi) > 0.0 || sky.radiance(wi).is_black(), "{wi:?}");
            }
        }
    }

    #[test]
    fn interpolation_is_continuous_over_the_edges_of_the_square() {
        let sky = sky(EnvironmentMapping::EqualAreaOctahedral);
        let p = sky.picture.as_ref().unwrap();
        for i in 0..1000 {
            // Neighbouring directions on either side of the seams.
            let t = i as f32 / 1000.0;
            let w = direction(p.mapping, [t, 1e-4]);
            let (a, b) = (w, (w + vec3(2e-4, -3e-4, 0.0)).normalize());
            let step = p.bilinear(p.uv(a)) - p.bilinear(p.uv(b));
            let jump = step.map(f32::abs).max_channel();
            assert!(jump < 0.1, "at {t}: {jump}");
        }
    }
}
