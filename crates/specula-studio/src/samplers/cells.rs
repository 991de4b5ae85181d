//! Integrals of a density of directions over cells of the unit disk.
//!
//! A direction above the horizon is `(x, y)` of the disk, and `dw = dx dy / z`. With `c = sqrt(1 - y^2)` and
//! `x = c sin t`, `z = c cos t` and `dx = z dt`: the integral over a cell is
//!
//! ```text
//! int dy int dt pdf(c sin t, y, c cos t),   t from asin(x0 / c) to asin(x1 / c)
//! ```
//!
//! which has no singularity at the rim, where the cell is clipped.

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_stat::quadrature::gauss_legendre;

/// A rectangle of the disk: ranges of x and y.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
}

impl Cell {
    fn quarters(&self) -> [Self; 4] {
        let middle = |r: [f64; 2]| 0.5 * (r[0] + r[1]);
        let (mx, my) = (middle(self.x), middle(self.y));
        let [left, right] = [[self.x[0], mx], [mx, self.x[1]]];
        let [low, high] = [[self.y[0], my], [my, self.y[1]]];
        [(left, low), (right, low), (left, high), (right, high)].map(|(x, y)| Self { x, y })
    }

    /// Whether a point is within it, or no farther from it than it is wide.
    fn is_near(&self, [x, y]: [f64; 2]) -> bool {
        let margin = self.x[1] - self.x[0];
        let within = |r: [f64; 2], p: f64| p >= r[0] - margin && p <= r[1] + margin;
        within(self.x, x) && within(self.y, y)
    }

    fn is_outside(&self) -> bool {
        let nearest = |r: [f64; 2]| 0.0_f64.clamp(r[0], r[1]);
        let (x, y) = (nearest(self.x), nearest(self.y));
        x * x + y * y >= 1.0
    }
}

/// Adaptive quadrature over cells.
pub(super) struct Cells<F> {
    nodes: Vec<[f64; 2]>,
    pdf: F,
    /// Where the density is sharpest, on the disk, and how sharp.
    peak: [f64; 2],
    width: f64,
    /// Error of a cell.
    tolerance: f64,
}

/// Halvings of a cell.
const DEEPEST: u32 = 14;

impl<F: Fn(Vec3<f64>) -> f64> Cells<F> {
    pub(super) fn new(pdf: F, peak: [f64; 2], width: f64, tolerance: f64) -> Self {
        let nodes = gauss_legendre(6);
        Self {
            nodes,
            pdf,
            peak,
            width,
            tolerance,
        }
    }

    /// The integral over a cell.
    pub(super) fn integral(&self, cell: Cell) -> f64 {
        if cell.is_outside() {
            return 0.0;
        }
        self.refined(cell, self.rule(cell), 0)
    }

    fn refined(&self, cell: Cell, coarse: f64, depth: u32) -> f64 {
        let quarters = cell.quarters().map(|quarter| (quarter, self.rule(quarter)));
        let fine: f64 = quarters.iter().map(|(_, value)| value).sum();
        let is_sharp = cell.x[1] - cell.x[0] > self.width && cell.is_near(self.peak);
        let is_done = (fine - coarse).abs() <= self.tolerance && !is_sharp;
        if is_done || depth >= DEEPEST {
            return fine;
        }
        let refine = |(quarter, value)| self.refined(quarter, value, depth + 1);
        quarters.into_iter().map(refine).sum()
    }

    /// Gauss-Legendre in `y` and `t`.
    fn rule(&self, cell: Cell) -> f64 {
        if cell.is_outside() {
            return 0.0;
        }
        let closest = 0.0_f64.clamp(cell.x[0], cell.x[1]);
        let rim = ((1.0 - closest) * (1.0 + closest)).max(0.0).sqrt();
        let [low, high] = [cell.y[0].max(-rim), cell.y[1].min(rim)];
        let mut sum = 0.0;
        for [node, weight] in &self.nodes {
            let y = 0.5 * ((high + low) + (high - low) * node);
            let c = ((1.0 - y) * (1.0 + y)).sqrt();
            let [from, to] = cell.x.map(|x| (x / c).clamp(-1.0, 1.0).asin());
            for [inner, inner_weight] in &self.nodes {
                let (sin, cos) = (0.5 * ((to + from) + (to - from) * inner)).sin_cos();
                let value = (self.pdf)(vec3(c * sin, y, c * cos));
                sum += value * weight * inner_weight * 0.25 * (high - low) * (to - from);
            }
        }
        sum
    }
}
