//! Filters over pyramids: means over a point's footprint.
//!
//! A footprint is an ellipse in texture coordinates, given by two half axes `a`, `b` that need not be perpendicular
//! (conjugate diameters). In pixels of a level its matrix is `C = a a^T + b b^T`, and its points are those with
//! `x^T C^-1 x <= 1`.

use std::sync::LazyLock;

use specula_bsdf::Rgb;
use specula_scene::scene::{Interpolation, Wrap};

use super::{Lookup, Raster};
use crate::convert::{floor_i32, floor_index};

/// Entries of [`WEIGHTS`].
const WEIGHT_COUNT: usize = 256;

/// The Gaussian weight over the square of the distance from the middle of an ellipse, 1 at its edge, where it is 0:
/// `exp(-2 r^2) - exp(-2)`, in the middles of `WEIGHT_COUNT` intervals.
static WEIGHTS: LazyLock<[f32; WEIGHT_COUNT]> = LazyLock::new(|| {
    core::array::from_fn(|i| {
        let squared = (i as f64 + 0.5) / WEIGHT_COUNT as f64;
        crate::convert::narrow((-2.0 * squared).exp() - (-2.0_f64).exp())
    })
});

/// The matrix `[[xx, xy], [xy, yy]]` of an ellipse.
#[derive(Clone, Copy)]
struct Ellipse {
    xx: f32,
    xy: f32,
    yy: f32,
}

impl Ellipse {
    /// With these half axes, in pixels.
    fn new([a, b]: [[f32; 2]; 2]) -> Self {
        Self {
            xx: a[0] * a[0] + b[0] * b[0],
            xy: a[0] * a[1] + b[0] * b[1],
            yy: a[1] * a[1] + b[1] * b[1],
        }
    }

    /// Squares of the half axes that are perpendicular, the longer one first.
    fn squared_axes(&self) -> [f32; 2] {
        let half = 0.5 * (self.xx + self.yy);
        let difference = 0.5 * (self.xx - self.yy);
        let root = (difference * difference + self.xy * self.xy).sqrt();
        let long = half + root;
        // Not half - root, which cancels.
        let determinant = self.xx * self.yy - self.xy * self.xy;
        let short = if long > 0.0 { determinant / long } else { 0.0 };
        [long, short.clamp(0.0, long)]
    }

    /// Widened across its longer axis, so that no axis is longer than `ratio` times the other; with the square of the
    /// shorter one.
    fn widened(self, ratio: f32) -> (Self, f32) {
        let [long, short] = self.squared_axes();
        let least = long / (ratio * ratio);
        if short >= least {
            return (self, short);
        }
        // (long - C) / (long - short) projects on the shorter axis.
        let scale = (least - short) / (long - short);
        let widened = Self {
            xx: self.xx + scale * (long - self.xx),
            xy: self.xy - scale * self.xy,
            yy: self.yy + scale * (long - self.yy),
        };
        (widened, least)
    }
}

impl Raster {
    /// The mean around `(s, t)` over a footprint. Black where the coordinates are not finite.
    ///
    /// * `axes`: half axes of the footprint, `(ds, dt)` each.
    pub(in crate::texture) fn filtered(
        &self,
        [s, t]: [f32; 2],
        axes: [[f32; 2]; 2],
        lookup: Lookup,
    ) -> Rgb<f32> {
        if self.width == 0 || !(s.is_finite() && t.is_finite()) {
            return Rgb::BLACK;
        }
        let size = [self.width as f32, -self.height as f32];
        let ellipse = Ellipse::new(axes.map(|a| [a[0] * size[0], a[1] * size[1]]));
        let trace = ellipse.xx + ellipse.yy;
        if !trace.is_finite() {
            return self.smallest();
        }
        if trace <= 0.0 {
            return self.interpolated([s, t], lookup);
        }
        match lookup.filter {
            Interpolation::Trilinear => self.trilinear([s, t], &ellipse, lookup),
            Interpolation::Ewa { max_anisotropy } => {
                self.ewa([s, t], ellipse, max_anisotropy, lookup)
            }
            Interpolation::Bilinear | Interpolation::Nearest => self.interpolated([s, t], lookup),
        }
    }

    /// The picture itself at a point; 0 where it is left out.
    fn interpolated(&self, st: [f32; 2], lookup: Lookup) -> Rgb<f32> {
        if lookup.means_only {
            Rgb::BLACK
        } else {
            self.at(st, lookup)
        }
    }

    /// The only pixel of the last level: the mean of the picture.
    fn smallest(&self) -> Rgb<f32> {
        self.level(self.smaller.len()).pixel(0, 0, [Wrap::Clamp; 2])
    }

    /// Bilinear interpolation in the two levels next to `log2(w)`, with `w` the side of the square around the ellipse,
    /// and linear interpolation between them.
    ///
    /// Source: Williams 1983; pbrt-v4's width, "2 max(..)". Departure: pbrt-v4 goes from level 0 to level 1 at once, and
    /// measures footprints by the largest component of their axes, the same as here for circles.
    fn trilinear(&self, st: [f32; 2], ellipse: &Ellipse, lookup: Lookup) -> Rgb<f32> {
        let side = 2.0 * ellipse.xx.max(ellipse.yy).sqrt();
        self.between_levels(side.log2(), |level| {
            if core::ptr::eq(level, self) {
                self.interpolated(st, lookup)
            } else {
                level.at(st, lookup)
            }
        })
    }

    /// The mean over the ellipse with Gaussian weights, in the levels where its shorter axis is 1 to 2 pixels.
    ///
    /// ```text
    /// sum w(r^2) x / sum w(r^2),   r^2 = d^T (C + 1)^-1 d,   w = exp(-2 r^2) - exp(-2)
    /// ```
    ///
    /// with `d` the distance of a pixel's centre from the point. Adding 1 to the matrix is a convolution with the
    /// reconstruction of pixels, so that ellipses are never smaller than one.
    ///
    /// Where the longer axis is under half a pixel, there is nothing to average: the picture is interpolated bilinearly,
    /// as without a filter, and up to one pixel both are mixed.
    ///
    /// Source: Heckbert 1989, "Fundamentals of texture mapping and image warping", 3.5.8; Pharr, Jakob and Humphreys,
    /// 4th edition, 10.4.4. Departures: axes are those of the ellipse, not those by which it is given; pbrt-v4 has
    /// Gaussians of a pixel where pictures are magnified.
    fn ewa(&self, st: [f32; 2], ellipse: Ellipse, max_anisotropy: f32, lookup: Lookup) -> Rgb<f32> {
        let [longer, _] = ellipse.squared_axes();
        let share = (2.0 * longer.sqrt() - 1.0).min(1.0);
        if share <= 0.0 {
            return self.interpolated(st, lookup);
        }
        let mean = self.mean_over_levels(st, ellipse, max_anisotropy, lookup);
        if share < 1.0 {
            self.interpolated(st, lookup) * (1.0 - share) + mean * share
        } else {
            mean
        }
    }

    /// The mean over an ellipse in the levels where its shorter axis is 1 to 2 pixels.
    fn mean_over_levels(
        &self,
        st: [f32; 2],
        ellipse: Ellipse,
        max_anisotropy: f32,
        lookup: Lookup,
    ) -> Rgb<f32> {
        let (ellipse, shorter) = ellipse.widened(max_anisotropy);
        let size = [self.width as f32, self.height as f32];
        self.between_levels(0.5 * shorter.log2(), |level| {
            // A pixel's size is that of the level, which odd sizes round.
            let [x, y] = [level.width as f32 / size[0], level.height as f32 / size[1]];
            let within = Ellipse {
                xx: ellipse.xx * (x * x) + 1.0,
                xy: ellipse.xy * (x * y),
                yy: ellipse.yy * (y * y) + 1.0,
            };
            level.mean_over(level.position(st, lookup.wrap), &within, lookup.wrap)
        })
    }

    /// Linear interpolation between what two levels give.
    ///
    /// * `level`: with a fraction; what is below 0 is 0.
    fn between_levels(&self, level: f32, at: impl Fn(&Self) -> Rgb<f32>) -> Rgb<f32> {
        let last = self.smaller.len();
        let level = level.max(0.0);
        let whole = floor_index(level);
        if whole >= last {
            return self.smallest();
        }
        let fraction = level - whole as f32;
        let near = at(self.level(whole));
        if fraction <= 0.0 {
            return near;
        }
        let far = if whole + 1 == last {
            self.smallest()
        } else {
            at(self.level(whole + 1))
        };
        near * (1.0 - fraction) + far * fraction
    }

    /// The weighted mean of the pixels with their centres in an ellipse around a point. Its half axes are 1 or longer:
    /// some pixel is in it.
    fn mean_over(&self, [x, y]: [f32; 2], ellipse: &Ellipse, wrap: [Wrap; 2]) -> Rgb<f32> {
        let (x, y) = (x - 0.5, y - 0.5);
        let Ellipse { xx, xy, yy } = *ellipse;
        // Rows: |dy| < sqrt(yy). In one of them dx is around the slope times dy.
        let slope = xy / yy;
        let across = xx - slope * xy;
        let [top, bottom] = [-1.0, 1.0].map(|side| y + side * yy.sqrt());
        let weights = &*WEIGHTS;
        let (mut sum, mut total) = (Rgb::BLACK, 0.0);
        for row in floor_i32(top).saturating_add(1)..=floor_i32(bottom) {
            let dy = row as f32 - y;
            let of_row = dy * dy / yy;
            let half = (across * (1.0 - of_row).max(0.0)).sqrt();
            let middle = x + slope * dy;
            let from = floor_i32(middle - half).saturating_add(1);
            for column in from..=floor_i32(middle + half) {
                let dx = column as f32 - middle;
                let squared = of_row + dx * dx / across;
                let index = floor_index(squared * WEIGHT_COUNT as f32);
                let Some(&weight) = weights.get(index) else {
                    continue;
                };
                sum += self.pixel(column, row, wrap) * weight;
                total += weight;
            }
        }
        if total > 0.0 {
            sum * (1.0 / total)
        } else {
            // Far away neighbouring columns have the same coordinate.
            self.pixel(floor_i32(x), floor_i32(y), wrap)
        }
    }
}

#[cfg(test)]
mod tests;
