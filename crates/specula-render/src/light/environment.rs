//! Light from infinity: a constant, or a picture of the sphere of directions.
//!
//! Pictures are interpolated bilinearly, and sampled by just that: a cell between four pixels' centres
//! is drawn by its luminance, and a point in it by the bilinear density (Pharr, Jakob and Humphreys,
//! Physically Based Rendering, 4th edition, A.5). What is drawn divided by its density is the same
//! everywhere, but for colour and the sine of the polar angle within a cell: a sun of a pixel or two
//! adds no noise of its own. (Densities constant over pixels did: a lone bright pixel had a variance
//! of 1.09 of its square.)

use glam::DMat3;
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Real, Rgb, Vec3};
use specula_scene::Image;
use specula_scene::scene::EnvironmentMapping;

use super::octahedral::{direction_of, square_of};
use super::piecewise::Piecewise;
use crate::convert::{Affine, floor_i32, floor_index};

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
    picture: Option<Box<Picture>>,
    to_world: Affine,
    to_light: Affine,
}

#[derive(Clone, Debug)]
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
    mapping: EnvironmentMapping,
    /// How the cells between pixels' centres lie along x and y.
    axes: [Axis; 2],
    /// Over those cells: luminance, times sin theta for latitude and longitude.
    table: Piecewise,
    /// Mean of the same over the square.
    mean: f64,
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
            picture: image.and_then(|(image, mapping)| Picture::new(image, mapping).map(Box::new)),
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
                let uv = p.sample(u);
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
                    EnvironmentMapping::EqualAreaOctahedral => 4.0 * PI * p.mean,
                    EnvironmentMapping::LatitudeLongitude
                    | EnvironmentMapping::LatitudeLongitudePoles => 2.0 * PI * PI * p.mean,
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
        use AxisKind::{Between, Clamped, Wrapped};
        let axes = match mapping {
            EnvironmentMapping::EqualAreaOctahedral => [(Clamped, width), (Clamped, height)],
            EnvironmentMapping::LatitudeLongitude => [(Wrapped, width), (Clamped, height)],
            EnvironmentMapping::LatitudeLongitudePoles => [(Wrapped, width), (Between, height)],
        };
        let axes = axes.map(|(kind, pixels)| Axis { kind, pixels });
        let mut picture = Self {
            width,
            height,
            pixels,
            mapping,
            axes,
            table: Piecewise::new([1, 1], |_, _| 0.0),
            mean: 0.0,
        };
        let cells = axes.map(|a| a.cells());
        let table = Piecewise::new(cells, |x, y| picture.weight([x, y]));
        let steps = axes.map(|a| f64::from(a.steps()));
        picture.mean = table.mean * (cells[0] * cells[1]) as f64 / (steps[0] * steps[1]);
        picture.table = table;
        Some(picture)
    }

    /// Integral over a cell, in pixels, of what is drawn by.
    fn weight(&self, cell: [usize; 2]) -> f64 {
        let corners = self.corners(cell);
        let [x, y] = [0, 1].map(|k| self.axes[k].range(cell[k]));
        let middle = self.axes[1].place(cell[1], 0.5 * (y[0] + y[1]));
        let sine = match self.mapping {
            EnvironmentMapping::EqualAreaOctahedral => 1.0,
            _ => (f64::from(middle) * core::f64::consts::PI).sin(),
        };
        let mean = 0.25 * corners.map(f64::from).iter().sum::<f64>();
        mean * sine * f64::from((x[1] - x[0]) * (y[1] - y[0]))
    }

    /// What is drawn by at the corners of a cell's part of the square: upper row, lower row.
    fn corners(&self, cell: [usize; 2]) -> [f32; 4] {
        let [x, y] = [0, 1].map(|k| self.axes[k].first_pixel(cell[k]));
        let strength = |dx: i32, dy: i32| {
            let c = self.pixel(x + dx, y + dy);
            // A floor of the mean of channels: deep blue has little luminance.
            c.luminance().max(c.mean())
        };
        let pixels = [
            strength(0, 0),
            strength(1, 0),
            strength(0, 1),
            strength(1, 1),
        ];
        let [xs, ys] = [0, 1].map(|k| self.axes[k].range(cell[k]));
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| bilinear_of(pixels, [xs[i], ys[j]]))
    }

    /// A point of the square, drawn with [`Picture::density`].
    #[inline]
    fn sample(&self, u: [f32; 2]) -> [f32; 2] {
        let (cell, [s, t]) = self.table.sample_cell(u);
        let [a, b, c, d] = self.corners(cell);
        let y = sample_linear(t, a + b, c + d);
        let x = sample_linear(s, a + (c - a) * y, b + (d - b) * y);
        let within = [x, y];
        [0, 1].map(|k| {
            let [low, high] = self.axes[k].range(cell[k]);
            self.axes[k].place(cell[k], low + (high - low) * within[k])
        })
    }

    /// Density per area of the square.
    #[inline]
    fn density(&self, uv: [f32; 2]) -> f32 {
        let [(x, s), (y, t)] = [0, 1].map(|k| self.axes[k].cell_of(uv[k]));
        let cell = [x, y];
        let corners = self.corners(cell);
        let within = [(0, s), (1, t)].map(|(k, at)| {
            let [low, high] = self.axes[k].range(cell[k]);
            ((at - low) / (high - low)).clamp(0.0, 1.0)
        });
        let area: f32 = [0, 1]
            .map(|k| {
                let [low, high] = self.axes[k].range(cell[k]);
                (high - low) / self.axes[k].steps() as f32
            })
            .iter()
            .product();
        let mean = 0.25 * corners.iter().sum::<f32>();
        let shape = if mean > 0.0 {
            bilinear_of(corners, within) / mean
        } else {
            1.0
        };
        self.table.share(cell) / area * shape
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
        self.density([u, v]) * jacobian
    }
}

/// How the cells between pixels' centres lie along one axis of a picture.
#[derive(Clone, Copy, Debug)]
struct Axis {
    kind: AxisKind,
    pixels: usize,
}

#[derive(Clone, Copy, Debug)]
enum AxisKind {
    /// As many cells as pixels: the last reaches over the edge.
    Wrapped,
    /// One more: the first and the last are halves.
    Clamped,
    /// One less: the outer centres lie on the edges.
    Between,
}

impl Axis {
    fn cells(self) -> usize {
        match self.kind {
            AxisKind::Wrapped => self.pixels,
            AxisKind::Clamped => self.pixels + 1,
            AxisKind::Between => (self.pixels - 1).max(1),
        }
    }

    /// Whole cells that fit along the axis.
    fn steps(self) -> u32 {
        let steps = match self.kind {
            AxisKind::Wrapped | AxisKind::Clamped => self.pixels,
            AxisKind::Between => (self.pixels - 1).max(1),
        };
        crate::convert::id(steps)
    }

    /// The pixel at a cell's beginning; the next is at its end.
    fn first_pixel(self, cell: usize) -> i32 {
        match self.kind {
            AxisKind::Clamped => signed(cell) - 1,
            AxisKind::Wrapped | AxisKind::Between => signed(cell),
        }
    }

    /// The part of a cell that lies within the picture.
    fn range(self, cell: usize) -> [f32; 2] {
        match self.kind {
            AxisKind::Clamped if cell == 0 => [0.5, 1.0],
            AxisKind::Clamped if cell == self.pixels => [0.0, 0.5],
            _ => [0.0, 1.0],
        }
    }

    /// The coordinate, in `[0, 1]`, of a point in a cell.
    fn place(self, cell: usize, within: f32) -> f32 {
        let at = cell as f32 + within;
        let steps = self.steps() as f32;
        match self.kind {
            AxisKind::Wrapped => {
                let at = at + 0.5;
                (if at >= steps { at - steps } else { at }) / steps
            }
            AxisKind::Clamped => (at - 0.5) / steps,
            AxisKind::Between => at / steps,
        }
    }

    /// The cell of a coordinate, and where in it that lies.
    fn cell_of(self, coordinate: f32) -> (usize, f32) {
        let steps = self.steps() as f32;
        let at = match self.kind {
            AxisKind::Wrapped => {
                let at = coordinate * steps - 0.5;
                if at < 0.0 { at + steps } else { at }
            }
            AxisKind::Clamped => coordinate * steps + 0.5,
            AxisKind::Between => coordinate * steps,
        };
        let cell = floor_index(at).min(self.cells() - 1);
        (cell, at - cell as f32)
    }
}

/// Between the values at the corners of a square: upper row, lower row.
#[inline]
fn bilinear_of([a, b, c, d]: [f32; 4], [x, y]: [f32; 2]) -> f32 {
    (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y
}

/// A point of `[0, 1]` with a density that goes from `a` to `b`, up to a factor.
///
/// Source: Pharr, Jakob and Humphreys, 4th edition, eq. 2.24, in the form that does not cancel.
#[inline]
fn sample_linear(u: f32, a: f32, b: f32) -> f32 {
    let root = (a * a * (1.0 - u) + b * b * u).sqrt();
    let x = u * (a + b) / (a + root);
    if x.is_finite() { x.min(1.0) } else { u }
}

fn signed(x: usize) -> i32 {
    i32::try_from(x).unwrap_or(i32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
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
                let again = sky.pdf(wi);
                assert!((again - pdf).abs() < 0.02 * pdf + 1e-3 || near_an_edge(&sky, wi));
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

    /// Whether a direction is so near the edge of a cell that rounding may choose the other side.
    fn near_an_edge(sky: &Environment, wi: Vec3<f32>) -> bool {
        let Some(p) = &sky.picture else { return false };
        let uv = p.uv(sky.to_light.vector(wi).normalize());
        [(uv[0], p.width), (uv[1], p.height)].iter().any(|&(v, n)| {
            let x = 2.0 * v * n as f32;
            (x - x.round()).abs() < 2e-3
        })
    }

    /// A lone bright pixel, a sun, is drawn in proportion to its light.
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
                pixels,
            };
            let identity = glam::DMat4::IDENTITY;
            let sky = Environment::new(Rgb::WHITE, Some((&image, mapping)), &identity);
            let all = sky.luminous_integral();
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
