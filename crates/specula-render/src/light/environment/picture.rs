//! An image of the sphere of directions: evaluated and sampled by its bilinear interpolation.
//!
//! The four pixels about each cell lie at fixed places of one array, edges and folds included, with what
//! is sampled by beside their colours: one look-up has radiance and density.

use rayon::prelude::*;
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Rgb, Vec3};
use specula_scene::Image;
use specula_scene::scene::EnvironmentMapping;

use super::super::angles::{sin_cos_half_turns, sin_cos_turns, turns};
use super::super::octahedral::{direction_of, square_of};
use super::super::piecewise::Piecewise;
use super::axis::{Axis, AxisKind};
use crate::codes;
use crate::convert::{id, narrow};
use crate::huge_pages;
use crate::layout;
use crate::words::Words;

/// Red, green, blue, and what is sampled by.
pub(super) type Pixel = [f32; 4];

/// Least share of its weight that MIS compensation leaves a pixel darker than the mean: lobes whose density is
/// wrong, or which sample nothing, still get light from there.
pub(super) const LEAST_WEIGHT: f32 = 0.01;

/// A picture, ready to be sampled from.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    pub(super) mapping: EnvironmentMapping,
    pub(super) axes: [Axis; 2],
    /// At the corners of the cells, row by row.
    corners: Vec<Pixel>,
    /// By row of cells: density per solid angle over what is sampled by; for latitude and longitude, times
    /// the sine of the polar angle.
    density: Vec<f32>,
    /// Over the cells: what is sampled by, times sin theta for latitude and longitude.
    pub(super) table: Piecewise,
    /// Mean of the same over the square.
    mean: f64,
}

impl Picture {
    /// `None` where the picture is empty.
    ///
    /// * `beside_lobes`: whether lobes are sampled from as well, weighted against this.
    pub(super) fn new(
        image: &Image,
        mapping: EnvironmentMapping,
        beside_lobes: bool,
    ) -> Option<Self> {
        let size = [image.width as usize, image.height as usize];
        if size[0] == 0 || size[1] == 0 || image.pixels.len() != size[0] * size[1] {
            return None;
        }
        use AxisKind::{Between, Clamped, Wrapped};
        let kinds = match mapping {
            EnvironmentMapping::EqualAreaOctahedral => [Clamped, Clamped],
            EnvironmentMapping::LatitudeLongitude => [Wrapped, Clamped],
            EnvironmentMapping::LatitudeLongitudePoles => [Wrapped, Between],
        };
        let axes = [0, 1].map(|k| Axis::new(kinds[k], size[k]));
        let [width, height] = axes.map(|a| a.cells as usize + 1);
        let mut corners = vec![[0.0; 4]; width * height];
        huge_pages::advise(&corners);
        let rows = corners.par_chunks_mut(width).enumerate();
        rows.for_each(|(y, row)| {
            for (x, corner) in row.iter_mut().enumerate() {
                let c = pixel(image, mapping, [axes[0].pixel(id(x)), axes[1].pixel(id(y))]);
                // A floor of the mean of channels: deep blue has little luminance.
                *corner = [c.r, c.g, c.b, c.luminance().max(c.mean())];
            }
        });
        let mut picture = Self {
            mapping,
            axes,
            corners,
            density: Vec::new(),
            table: Piecewise::new([1, 1], |_, _| 0.0),
            mean: 0.0,
        };
        let sines = picture.sines();
        if beside_lobes {
            picture.leave_to_lobes(&sines);
        }
        picture.tabulate(&sines);
        Some(picture)
    }

    /// Takes the mean over the sphere off what is sampled by: sampling lobes covers what is as bright
    /// everywhere, so that samples of lights do more in what stands out.
    ///
    /// Source: Karlik et al. 2019, "MIS Compensation", for light from a picture (there without a floor).
    fn leave_to_lobes(&mut self, sines: &[f64]) {
        self.mean = self.mean_of(Piecewise::mean_of(self.cells(), self.cell_weight(sines)));
        let mean = narrow(self.integral() / (4.0 * core::f64::consts::PI));
        self.corners.par_iter_mut().for_each(|[.., strength]| {
            *strength = (*strength - mean).max(LEAST_WEIGHT * *strength);
        });
    }

    /// By row of cells: sine of the polar angle for latitude and longitude, else 1.
    fn sines(&self) -> Vec<f64> {
        let sine = |y: u32| {
            let [low, high] = self.axes[1].range(y);
            let middle = self.axes[1].place(y, 0.5 * (low + high));
            match self.mapping {
                EnvironmentMapping::EqualAreaOctahedral => 1.0,
                _ => (f64::from(middle) * core::f64::consts::PI).sin(),
            }
        };
        (0..self.axes[1].cells).map(sine).collect()
    }

    fn cells(&self) -> [usize; 2] {
        self.axes.map(|a| a.cells as usize)
    }

    /// What a cell is sampled by.
    fn cell_weight(&self, sines: &[f64]) -> impl Fn(usize, usize) -> f64 + Sync {
        |x, y| self.weight([x, y].map(id)) * sines[y]
    }

    /// The mean over the square.
    ///
    /// * `cells`: that of the cells' weights.
    fn mean_of(&self, cells: f64) -> f64 {
        let [width, height] = self.axes.map(|a| f64::from(a.cells));
        let whole = f64::from(self.axes[0].steps) * f64::from(self.axes[1].steps);
        cells * width * height / whole
    }

    fn tabulate(&mut self, sines: &[f64]) {
        use core::f64::consts::PI;
        let table = Piecewise::new(self.cells(), self.cell_weight(sines));
        self.mean = self.mean_of(table.mean);
        let jacobian = match self.mapping {
            EnvironmentMapping::EqualAreaOctahedral => 0.25 / PI,
            _ => 0.5 / (PI * PI),
        };
        let per_strength = |sine: &f64| {
            let density = sine * jacobian / self.mean;
            narrow(if density.is_finite() { density } else { 0.0 })
        };
        self.density = sines.iter().map(per_strength).collect();
        self.table = table;
    }

    /// Pixels and tables for shaders; returns their places.
    pub(super) fn flatten_tables(&self, to: &mut Words) -> [u32; 4] {
        let corners = to.offset();
        to.floats(self.corners.iter().flatten().copied());
        let density = to.offset();
        to.floats(self.density.iter().copied());
        let [rows, columns] = self.table.flatten(to);
        [corners, density, rows, columns]
    }

    /// Mapping, axes and places of the tables, for shaders.
    ///
    /// * `record`: place of the light's first word.
    pub(super) fn flatten(&self, record: u32, tables: [u32; 4], to: &mut Words) {
        to.field(record, layout::ENVIRONMENT_MAPPING);
        to.id(match self.mapping {
            EnvironmentMapping::EqualAreaOctahedral => codes::ENVIRONMENT_EQUAL_AREA,
            EnvironmentMapping::LatitudeLongitude => codes::ENVIRONMENT_LATITUDE_LONGITUDE,
            EnvironmentMapping::LatitudeLongitudePoles => {
                codes::ENVIRONMENT_LATITUDE_LONGITUDE_POLES
            }
        });
        let axes = [layout::ENVIRONMENT_ACROSS, layout::ENVIRONMENT_DOWN];
        for (axis, field) in self.axes.iter().zip(axes) {
            to.field(record, field);
            axis.flatten(to);
        }
        let fields = [
            layout::ENVIRONMENT_CORNERS,
            layout::ENVIRONMENT_DENSITY,
            layout::ENVIRONMENT_ROWS,
            layout::ENVIRONMENT_COLUMNS,
        ];
        for (table, field) in tables.into_iter().zip(fields) {
            to.field(record, field);
            to.id(table);
        }
    }

    /// Integral over a cell, in pixels, of what is sampled by, without the sine.
    fn weight(&self, cell: [u32; 2]) -> f64 {
        let ranges = self.ranges(cell);
        let corners = cut(self.corners(cell).map(|c| c[3]), ranges);
        let mean = 0.25 * corners.map(f64::from).iter().sum::<f64>();
        let area = ranges.map(|[low, high]| f64::from(high - low));
        mean * area[0] * area[1]
    }

    #[inline(always)]
    pub(super) fn ranges(&self, [x, y]: [u32; 2]) -> [[f32; 2]; 2] {
        [self.axes[0].range(x), self.axes[1].range(y)]
    }

    /// The pixels about a cell: upper row, lower row.
    #[inline(always)]
    pub(super) fn corners(&self, [x, y]: [u32; 2]) -> [Pixel; 4] {
        let row = self.axes[0].cells as usize + 1;
        let at = y as usize * row + x as usize;
        let pair = |at: usize| match self.corners.get(at..at + 2) {
            Some(&[a, b]) => [a, b],
            _ => [[0.0; 4]; 2],
        };
        let ([a, b], [c, d]) = (pair(at), pair(at + row));
        [a, b, c, d]
    }

    /// Density per solid angle over what is sampled by, of a row of cells: see [`Picture::pdf`].
    #[inline(always)]
    pub(super) fn density(&self, row: u32) -> f32 {
        self.density.get(row as usize).copied().unwrap_or(0.0)
    }

    /// The cell of a point of the square, and where in it that lies.
    #[inline(always)]
    pub(super) fn cell_of(&self, [u, v]: [f32; 2]) -> ([u32; 2], [f32; 2]) {
        let ((x, s), (y, t)) = (self.axes[0].cell_of(u), self.axes[1].cell_of(v));
        ([x, y], [s, t])
    }

    /// Where in a cell a point lies that is sampled by the corners' strengths.
    ///
    /// * `strengths`: of [`Picture::corners`].
    /// * `u`: uniform in `[0, 1)^2`.
    #[inline(always)]
    pub(super) fn within(&self, cell: [u32; 2], strengths: [f32; 4], u: [f32; 2]) -> [f32; 2] {
        let ranges = self.ranges(cell);
        let [a, b, c, d] = cut(strengths, ranges);
        let y = sample_linear(u[1], a + b, c + d);
        let x = sample_linear(u[0], a + (c - a) * y, b + (d - b) * y);
        let [[left, right], [top, bottom]] = ranges;
        [left + (right - left) * x, top + (bottom - top) * y]
    }

    /// A point of the square sampled in proportion to what is sampled by, the picture there, and the row of
    /// cells.
    #[inline]
    pub(super) fn sample(&self, u: [f32; 2]) -> ([f32; 2], Pixel, u32) {
        let (cell, u) = self.table.sample_cell(u);
        let cell = cell.map(id);
        let corners = self.corners(cell);
        let within = self.within(cell, corners.map(|c| c[3]), u);
        let uv = [0, 1].map(|k| self.axes[k].place(cell[k], within[k]));
        (uv, mix(&corners, within), cell[1])
    }

    /// The picture at a point of the square, and the row of cells.
    #[inline]
    pub(super) fn look_up(&self, uv: [f32; 2]) -> (Pixel, u32) {
        let (cell, within) = self.cell_of(uv);
        (mix(&self.corners(cell), within), cell[1])
    }

    /// Density per solid angle with which a point is sampled.
    ///
    /// * `strength`: what is sampled by, there.
    /// * `density`: of the row of cells.
    /// * `sine`: of the polar angle; 1 where equal areas are equal solid angles.
    #[inline(always)]
    pub(super) fn pdf(strength: f32, density: f32, sine: f32) -> f32 {
        if sine > 0.0 {
            strength * density / sine
        } else {
            0.0
        }
    }

    /// Integral of what is sampled by over the sphere of directions.
    pub(super) fn integral(&self) -> f64 {
        use core::f64::consts::PI;
        let solid_angle = match self.mapping {
            EnvironmentMapping::EqualAreaOctahedral => 4.0 * PI,
            _ => 2.0 * PI * PI,
        };
        solid_angle * self.mean
    }
}

/// The direction of light space at a point of the square, and the sine of its polar angle where the mapping
/// crowds by it, else 1.
#[inline(always)]
pub(super) fn direction_and_sine(
    mapping: EnvironmentMapping,
    [u, v]: [f32; 2],
) -> (Vec3<f32>, f32) {
    match mapping {
        EnvironmentMapping::EqualAreaOctahedral => (direction_of([u, v]), 1.0),
        EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
            let (sin_phi, cos_phi) = sin_cos_turns(u);
            let (sin, cos) = sin_cos_half_turns(v);
            (vec3(sin * cos_phi, sin * sin_phi, cos), sin)
        }
    }
}

/// Where a direction of light space lies in the picture, from its upper left corner, and the sine as of
/// [`direction_and_sine`].
#[inline(always)]
pub(super) fn uv_and_sine(mapping: EnvironmentMapping, w: Vec3<f32>) -> ([f32; 2], f32) {
    match mapping {
        EnvironmentMapping::EqualAreaOctahedral => (square_of(w), 1.0),
        EnvironmentMapping::LatitudeLongitude | EnvironmentMapping::LatitudeLongitudePoles => {
            let phi = turns(w.y, w.x);
            // The polar angle by its sine too: its cosine alone loses half the digits at the poles.
            let sin = (w.x * w.x + w.y * w.y).sqrt();
            let uv = [
                if phi < 0.0 { phi + 1.0 } else { phi },
                2.0 * turns(sin, w.z),
            ];
            (uv, sin)
        }
    }
}

/// A pixel, continued over the edges of the square as the sphere is.
fn pixel(image: &Image, mapping: EnvironmentMapping, [x, y]: [i32; 2]) -> Rgb<f32> {
    let [w, h] = [image.width, image.height].map(u32::cast_signed);
    let (mut x, mut y) = (x, y);
    match mapping {
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
    let at = |v: i32, n: i32| v.clamp(0, n - 1).cast_unsigned() as usize;
    let [r, g, b] = image.pixels.rgb(at(y, h) * image.width as usize + at(x, w));
    rgb(r, g, b).map(|v| if v.is_finite() { v.max(0.0) } else { 0.0 })
}

/// Between the pixels about a cell.
#[inline(always)]
pub(super) fn mix([a, b, c, d]: &[Pixel; 4], [x, y]: [f32; 2]) -> Pixel {
    let mut mixed = [0.0; 4];
    for k in 0..4 {
        mixed[k] = bilinear_of([a[k], b[k], c[k], d[k]], [x, y]);
    }
    mixed
}

/// Values at the corners of a part of a cell.
#[inline(always)]
fn cut(corners: [f32; 4], [xs, ys]: [[f32; 2]; 2]) -> [f32; 4] {
    let at = |i: usize, j: usize| bilinear_of(corners, [xs[i], ys[j]]);
    [at(0, 0), at(1, 0), at(0, 1), at(1, 1)]
}

/// Bilinear interpolation between the values at the corners of a square: upper row, lower row.
#[inline(always)]
fn bilinear_of([a, b, c, d]: [f32; 4], [x, y]: [f32; 2]) -> f32 {
    (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y
}

/// A point of `[0, 1]` with a density that goes from `a` to `b`, up to a factor.
///
/// Source: Pharr, Jakob and Humphreys, 4th edition, eq. 2.24, in the form that does not cancel.
#[inline(always)]
fn sample_linear(u: f32, a: f32, b: f32) -> f32 {
    let root = (a * a * (1.0 - u) + b * b * u).sqrt();
    let x = u * (a + b) / (a + root);
    let x = if x < 1.0 { x } else { 1.0 };
    if a + root > 0.0 { x } else { u }
}
