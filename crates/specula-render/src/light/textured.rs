//! Shapes whose emission varies over them, by textures or by opacity.

use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{ColourParam, FloatParam};

use super::area::{Area, AreaSample};
use super::piecewise::Piecewise;
use crate::geometry::{Geometry, PrimitiveLocation, Surface};
use crate::layout;
use crate::texture::{TextureCoordinates, Textures};
use crate::words::Words;

/// Cells along the sides of a triangle's table.
const MOST_CELLS: usize = 32;
/// With fewer, no table is made: points are sampled uniformly.
const LEAST_CELLS: usize = 4;
/// Share of points of a table that are sampled uniformly: what the table missed is sampled too.
const UNIFORM_SHARE: f64 = 0.1;
/// A table pays where its largest density is this much above the uniform one.
const WORTH_IT: f64 = 1.5;

/// How many cells along a side a scene with so many varying emitters can afford.
pub(super) fn cells_for(emitters: usize) -> usize {
    let budget = (1_usize << 20) / emitters.max(1);
    budget.isqrt().clamp(2, MOST_CELLS)
}

/// The weights of a square grid with a share of their neighbours': evaluated in its middle only, a
/// cell next to a bright one may be partly bright.
fn blurred(weights: &[f64], cells: usize) -> Vec<f64> {
    let at = |x: usize, y: usize| {
        let near = |i: usize| [i.saturating_sub(1), i, (i + 1).min(cells - 1)];
        let row = |y: usize| {
            let [a, b, c] = near(x).map(|x| weights[y * cells + x]);
            a + 2.0 * b + c
        };
        let [a, b, c] = near(y).map(row);
        (a + 2.0 * b + c) / 16.0
    };
    (0..cells * cells)
        .map(|i| at(i % cells, i / cells))
        .collect()
}

/// Emission that varies over a shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Varying {
    pub(super) radiance: ColourParam,
    /// Share that is there at all, where it is not 1 everywhere.
    pub(super) alpha: Option<FloatParam>,
}

impl Varying {
    pub(super) fn radiance(&self, textures: &Textures, place: &TextureCoordinates) -> Rgb<f32> {
        let radiance = textures.colour(self.radiance, place).map(|v| v.max(0.0));
        match self.alpha {
            None => radiance,
            Some(alpha) => radiance * textures.float(alpha, place).clamp(0.0, 1.0),
        }
    }
}

/// An emitting primitive whose emission varies.
#[derive(Clone, Debug)]
pub(super) struct Textured {
    pub(super) area: Area,
    pub(super) emits: Varying,
    pub(super) two_sided: bool,
    instance: u32,
    primitive: u32,
    /// Whether the area's second and third corner are the primitive's third and second.
    swapped: bool,
    table: Option<Piecewise>,
    /// Mean over the area of `max(luminance, mean)`.
    pub(super) mean: f64,
}

impl Textured {
    /// * `cells`: along each side of the grid on which the emission is evaluated.
    pub(super) fn new(
        area: Area,
        emits: Varying,
        two_sided: bool,
        (instance, primitive, swapped): (u32, u32, bool),
        (geometry, textures): (&Geometry, &Textures),
        cells: usize,
    ) -> Self {
        let mut light = Self {
            area,
            emits,
            two_sided,
            instance,
            primitive,
            swapped,
            table: None,
            mean: 0.0,
        };
        let weight = |x: usize, y: usize| {
            let u = [x, y].map(|i| (i as f32 + 0.5) / cells as f32);
            let surface = light.surface(geometry, u, light.area.point(u));
            let c = emits.radiance(textures, &surface.place());
            f64::from(c.luminance().max(c.mean()))
        };
        let weights: Vec<f64> = (0..cells * cells)
            .map(|i| weight(i % cells, i / cells))
            .collect();
        let mean = weights.iter().sum::<f64>() / weights.len() as f64;
        let weights = blurred(&weights, cells);
        let largest = weights.iter().copied().fold(0.0, f64::max);
        let is_triangle = matches!(light.area, Area::Triangle(_));
        if is_triangle && cells >= LEAST_CELLS && largest > WORTH_IT * mean {
            let floor = mean * UNIFORM_SHARE / (1.0 - UNIFORM_SHARE);
            let table = Piecewise::new([cells; 2], |x, y| weights[y * cells + x] + floor);
            light.table = Some(table);
        }
        light.mean = mean;
        light
    }

    /// The surface at the point that `u` leads to.
    fn surface(&self, geometry: &Geometry, u: [f32; 2], point: Vec3<f32>) -> Surface {
        let [b, c] = Area::weights(u);
        let at = PrimitiveLocation {
            instance: self.instance,
            primitive: self.primitive,
            weights: if self.swapped { [c, b] } else { [b, c] },
            // Lights do not move.
            time: 0.0,
        };
        geometry.surface_at(&at, || [point, Vec3::ZERO])
    }

    /// Samples a point of the light, as seen from `p`; returns it with its radiance.
    pub(super) fn sample(
        &self,
        p: Vec3<f32>,
        u: [f32; 2],
        (geometry, textures): (&Geometry, &Textures),
    ) -> Option<(AreaSample, Rgb<f32>)> {
        let (u, density) = match &self.table {
            None => (u, 1.0),
            Some(table) => {
                let u = table.sample(u);
                (u, table.density(u))
            }
        };
        let mut sample = self.area.sample(p, u)?;
        sample.pdf *= density;
        let surface = self.surface(geometry, u, sample.point);
        let radiance = self.emits.radiance(textures, &surface.place());
        (sample.pdf > 0.0 && !radiance.is_black()).then_some((sample, radiance))
    }

    /// Cells along the sides of the table, 0 where there is none, and the places of its shares.
    pub(super) fn flatten_table(&self, to: &mut Words) -> [u32; 3] {
        match &self.table {
            None => [0; 3],
            Some(table) => {
                let [rows, columns] = table.flatten(to);
                [table.width(), rows, columns]
            }
        }
    }

    /// Parameters, for shaders; radiance and opacity are those of the shape.
    pub(super) fn flatten(&self, table: [u32; 3], to: &mut Words) {
        let record = to.offset();
        to.ids([self.instance, self.primitive, u32::from(self.swapped)]);
        to.ids(table);
        to.field(record, layout::TEXTURED_AREA);
        self.area.flatten(to);
    }

    /// Density in 1/sr with which [`Textured::sample`] samples the direction from `p` to `s`.
    pub(super) fn pdf(&self, p: Vec3<f32>, s: &Surface) -> f32 {
        let density = match &self.table {
            None => 1.0,
            Some(table) => {
                let [b, c] = s.at.weights;
                let weights = if self.swapped { [c, b] } else { [b, c] };
                table.density(Area::square_of(weights))
            }
        };
        density * self.area.pdf(p, s.position, s.ng)
    }
}
