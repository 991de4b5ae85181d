//! Light from infinity that is seen through a portal alone: a rectangle in space, a window.
//!
//! The picture of the sky is rectified: with the portal's sides along x and y, a direction `(X, Y, 1)` is at
//!
//! ```text
//! u = atan(X) / pi + 1/2,   v = atan(Y) / pi + 1/2,
//! dw / (du dv) = pi^2 (1 + X^2) (1 + Y^2) / (1 + X^2 + Y^2)^(3/2)
//! ```
//!
//! where the portal, seen from any point, is a rectangle along the axes, for `X` is the same all along one of its
//! sides. What is seen through it is sampled by the radiance of the pixels times their solid angles: sums over
//! rectangles come from a summed-area table, and the cumulated sums along x, then along y in a pixel's column, are
//! linear between pixels.
//!
//! Source: Bitterli, Novak and Jarosz 2015, "Portal-Masked Environment Map Sampling". The picture has the resolution
//! of the file's, and is constant within pixels, as in pbrt-v4.

use core::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;
use specula_bsdf::{Rgb, Vec3};

use super::environment::Environment;
use crate::convert::{narrow, narrow3, widen3};

/// Side of the table of a light without a picture.
const PLAIN_SIDE: usize = 64;

/// An infinite light behind a portal.
#[derive(Clone, Debug)]
pub(super) struct Portal {
    /// Along the portal's sides, and from its front to where the light is.
    axes: [DVec3; 3],
    /// Two opposite corners.
    corners: [DVec3; 2],
    /// Pixels in a row, and rows, of the rectified picture.
    size: [usize; 2],
    radiance: Vec<Rgb<f32>>,
    /// Of row `y` and column `x` the sum of all weights above and to the left.
    table: Vec<f64>,
}

/// A rectangle of the rectified picture: where it begins and ends along x and along y, in `[0, 1]`.
#[derive(Clone, Copy, Debug)]
struct Window {
    x: [f64; 2],
    y: [f64; 2],
}

impl Portal {
    /// * `sky`: the light without its portal.
    /// * `side`: of the picture in pixels; 0 for a light without.
    /// * `corners`: one after the other; the light is in the direction of `(p3 - p0) x (p1 - p0)`.
    pub(super) fn new(sky: &Environment, side: usize, corners: [[f64; 3]; 4]) -> Self {
        let [p0, p1, p2, p3] = corners.map(DVec3::from);
        let x = (p3 - p0).normalize_or(DVec3::X);
        // Sides that are not quite square to each other, as the reader lets pass.
        let z = x.cross(p1 - p0).normalize_or(DVec3::Z);
        let axes = [x, z.cross(x), z];
        let side = if side == 0 { PLAIN_SIDE } else { side };
        let mut portal = Self {
            axes,
            corners: [p0, p2],
            size: [side; 2],
            radiance: Vec::new(),
            table: Vec::new(),
        };
        let centre = |i: usize| (i as f64 + 0.5) / side as f64;
        let rows: Vec<(Vec<Rgb<f32>>, Vec<f64>)> = (0..side)
            .into_par_iter()
            .map(|y| {
                let row = (0..side).map(|x| {
                    let (w, solid_angle) = portal.direction([centre(x), centre(y)]);
                    let radiance = sky.arriving(w).0;
                    let weight = f64::from(radiance.luminance().max(radiance.mean()));
                    (radiance, weight * solid_angle)
                });
                row.unzip()
            })
            .collect();
        let mut above = vec![0.0; side + 1];
        portal.table.clone_from(&above);
        for (radiance, weights) in rows {
            portal.radiance.extend(radiance);
            let mut run = 0.0;
            for (sum, weight) in above[1..].iter_mut().zip(weights) {
                run += weight;
                *sum += run;
            }
            portal.table.extend_from_slice(&above);
        }
        portal
    }

    /// Direction at a point of the rectified picture, and solid angle over area there.
    fn direction(&self, uv: [f64; 2]) -> (Vec3<f32>, f64) {
        let [x, y] = uv.map(|u| (PI * (u - 0.5)).tan());
        let [a, b, c] = self.axes;
        let w = (a * x + b * y + c).normalize();
        (narrow3(w), solid_angle([x, y]))
    }

    /// Where a direction is in the rectified picture, and solid angle over area there; `None` behind the portal.
    fn place(&self, w: DVec3) -> Option<([f64; 2], f64)> {
        let [x, y, z] = self.axes.map(|a| a.dot(w));
        (z > 0.0).then(|| {
            let tangents = [x / z, y / z];
            (tangents.map(|t| t.atan() / PI + 0.5), solid_angle(tangents))
        })
    }

    /// What of the picture is seen from a point, with the sum of its weights; `None`: nothing.
    fn window(&self, from: Vec3<f32>) -> Option<(Window, f64)> {
        let from = widen3(from);
        let [a, b] = [
            self.place(self.corners[0] - from)?.0,
            self.place(self.corners[1] - from)?.0,
        ];
        let sorted = |k: usize| [a[k].min(b[k]), a[k].max(b[k])];
        let window = Window {
            x: sorted(0),
            y: sorted(1),
        };
        let sum = self.sum(window);
        (sum > 0.0).then_some((window, sum))
    }

    /// The summed-area table between its entries: the sum of all weights up to a point, in pixels.
    fn cumulated(&self, [x, y]: [f64; 2]) -> f64 {
        let (i, s) = split(x, self.size[0]);
        let (j, t) = split(y, self.size[1]);
        let stride = self.size[0] + 1;
        let row = |j: usize| {
            let at = j * stride + i;
            self.table[at] * (1.0 - s) + self.table[at + 1] * s
        };
        row(j) * (1.0 - t) + row(j + 1) * t
    }

    /// Sum of the weights in a rectangle.
    fn sum(&self, w: Window) -> f64 {
        let [x0, x1] = w.x.map(|x| x * self.size[0] as f64);
        let [y0, y1] = w.y.map(|y| y * self.size[1] as f64);
        let sum = self.cumulated([x1, y1]) - self.cumulated([x0, y1]) - self.cumulated([x1, y0])
            + self.cumulated([x0, y0]);
        // What rounding leaves of nothing.
        let least = 1e-12 * self.table.last().copied().unwrap_or(0.0) * (w.x[1] - w.x[0]);
        if sum > least * (w.y[1] - w.y[0]) {
            sum
        } else {
            0.0
        }
    }

    fn pixel(&self, uv: [f64; 2]) -> usize {
        let [x, y] = [0, 1].map(|k| split(uv[k] * self.size[k] as f64, self.size[k]).0);
        y * self.size[0] + x
    }

    /// Radiance from the direction `wi` (unit, world) at a point, and the density in 1/sr with which
    /// [`Portal::sample`] samples it there.
    pub(super) fn arriving(&self, from: Vec3<f32>, wi: Vec3<f32>) -> (Rgb<f32>, f32) {
        let nothing = (Rgb::BLACK, 0.0);
        let Some((uv, solid_angle)) = self.place(widen3(wi)) else {
            return nothing;
        };
        match self.window(from) {
            Some((window, sum)) if window.holds(uv) => (
                self.radiance[self.pixel(uv)],
                self.pdf(uv, sum, solid_angle),
            ),
            _ => nothing,
        }
    }

    fn pdf(&self, uv: [f64; 2], sum: f64, solid_angle: f64) -> f32 {
        let [width, height] = self.size;
        let pixel = self.pixel(uv);
        let (x, y) = (pixel % width, pixel / width);
        let at = y * (width + 1) + x;
        let below = at + width + 1;
        let t = &self.table;
        let weight = (t[below + 1] - t[below]) - (t[at + 1] - t[at]);
        // Of a dark pixel, rounding may leave less than nothing.
        narrow((weight / (sum * solid_angle)).max(0.0) * (width * height) as f64)
    }

    /// A direction (unit, world) through the portal, its radiance and its density.
    pub(super) fn sample(
        &self,
        from: Vec3<f32>,
        u: [f32; 2],
    ) -> Option<(Vec3<f32>, Rgb<f32>, f32)> {
        let (window, sum) = self.window(from)?;
        let [y0, y1] = window.y.map(|y| y * self.size[1] as f64);
        let x = invert(window.x, self.size[0], f64::from(u[0]), |x| {
            self.cumulated([x, y1]) - self.cumulated([x, y0])
        });
        let column = split(x * self.size[0] as f64, self.size[0]).0 as f64;
        let y = invert(window.y, self.size[1], f64::from(u[1]), |y| {
            self.cumulated([column + 1.0, y]) - self.cumulated([column, y])
        });
        let (wi, solid_angle) = self.direction([x, y]);
        let pdf = self.pdf([x, y], sum, solid_angle);
        let sound = pdf > 0.0 && pdf.is_finite() && wi.is_finite();
        sound.then(|| (wi, self.radiance[self.pixel([x, y])], pdf))
    }

    /// Integral over the sphere of directions of what is sampled by, for the choice between lights: as from a point
    /// that sees all of the portal's side.
    pub(super) fn sampled_integral(&self) -> f64 {
        let pixels = (self.size[0] * self.size[1]) as f64;
        self.table.last().copied().unwrap_or(0.0) / pixels
    }
}

impl Window {
    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        self.x[0] <= x && x <= self.x[1] && self.y[0] <= y && y <= self.y[1]
    }
}

/// Solid angle over area of the rectified picture.
fn solid_angle([x, y]: [f64; 2]) -> f64 {
    let square = 1.0 + x * x + y * y;
    PI * PI * (1.0 + x * x) * (1.0 + y * y) / (square * square.sqrt())
}

/// The pixel of a coordinate in pixels, and where in it that lies.
fn split(x: f64, size: usize) -> (usize, f64) {
    let pixel = crate::convert::floor_index(narrow(x)).min(size - 1);
    // Narrowed to f32, a coordinate may round up to the next pixel.
    let pixel = if pixel as f64 > x {
        pixel.saturating_sub(1)
    } else {
        pixel
    };
    (pixel, (x - pixel as f64).clamp(0.0, 1.0))
}

/// Where the share `u` of a sum that grows, linearly within pixels, from one end of a window to the other is reached.
///
/// * `cumulated`: the sum up to a coordinate in pixels, less any constant.
fn invert(ends: [f64; 2], size: usize, u: f64, cumulated: impl Fn(f64) -> f64) -> f64 {
    let [from, to] = ends.map(|x| x * size as f64);
    let (first, last) = (cumulated(from), cumulated(to));
    let target = first + u * (last - first);
    // The last border of pixels that is not beyond.
    let (mut low, mut high) = (split(from, size).0, split(to, size).0 + 1);
    while high - low > 1 {
        let middle = usize::midpoint(low, high);
        if cumulated(middle as f64) <= target {
            low = middle;
        } else {
            high = middle;
        }
    }
    let [left, right] = [(low as f64).max(from), (high as f64).min(to)];
    let [below, above] = [cumulated(left), cumulated(right)];
    let share = if above > below {
        ((target - below) / (above - below)).clamp(0.0, 1.0)
    } else {
        0.5
    };
    (left + share * (right - left)) / size as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;
    use specula_scene::Image;
    use specula_scene::scene::EnvironmentMapping;

    const SIDE: u32 = 16;

    /// A portal over `[-1, 1] x [-0.5, 0.5]` in a plane that is turned, and the middle of it.
    fn portal(pixels: impl Fn(u32, u32) -> [f32; 3]) -> (Portal, DVec3) {
        let pixels: Vec<[f32; 3]> = (0..SIDE * SIDE)
            .map(|i| pixels(i % SIDE, i / SIDE))
            .collect();
        let image = Image {
            name: "sky".into(),
            width: SIDE,
            height: SIDE,
            pixels: pixels.into(),
        };
        let mapping = EnvironmentMapping::EqualAreaOctahedral;
        let turn = glam::DMat4::from_rotation_x(0.7) * glam::DMat4::from_rotation_z(2.0);
        let sky = Environment::new(Rgb::WHITE, Some((&image, mapping)), &turn, false);
        let centre = DVec3::new(0.3, 2.0, -1.0);
        let at =
            |x: f64, y: f64| (centre + turn.transform_vector3(DVec3::new(x, y, 0.0))).to_array();
        let corners = [at(-1.0, -0.5), at(-1.0, 0.5), at(1.0, 0.5), at(1.0, -0.5)];
        (Portal::new(&sky, SIDE as usize, corners), centre)
    }

    fn varied(x: u32, y: u32) -> [f32; 3] {
        match (x, y) {
            (7, 8) => [9.0, 4.0, 1.0],
            _ if x.is_multiple_of(3) => [0.0; 3],
            _ => [0.1 * x as f32, 0.2, 0.05 * y as f32],
        }
    }

    /// Points before the portal: near, far, aside.
    fn points(portal: &Portal, centre: DVec3) -> Vec<Vec3<f32>> {
        let [x, y, z] = portal.axes;
        let at = |a: f64, b: f64, c: f64| narrow3(centre + x * a + y * b - z * c);
        vec![at(0.2, 0.1, 0.5), at(-1.5, 0.7, 0.2), at(0.4, -2.0, 6.0)]
    }

    /// Solid angle of the portal, by the formula for rectangles from a point over their corner.
    fn solid_angle_of(portal: &Portal, from: Vec3<f32>) -> f64 {
        let [x, y, z] = portal.axes;
        let to = |p: DVec3| {
            let d = p - widen3(from);
            [d.dot(x), d.dot(y), d.dot(z)]
        };
        let ([x0, y0, z0], [x1, y1, _]) = (to(portal.corners[0]), to(portal.corners[1]));
        let part = |x: f64, y: f64| (x * y / (z0 * (x * x + y * y + z0 * z0).sqrt())).atan();
        (part(x1, y1) - part(x0, y1) - part(x1, y0) + part(x0, y0)).abs()
    }

    /// The portal is cut into cells; densities are summed over each, samples counted.
    #[test]
    fn densities_integrate_to_one_and_match_where_samples_fall() {
        let (portal, centre) = portal(varied);
        for from in points(&portal, centre) {
            let (cells, fine) = (8, 60);
            let side = cells * fine;
            let mut expected = vec![0.0_f64; cells * cells];
            let [p0, p2] = portal.corners;
            let (a, b) = ((p2 - p0).dot(portal.axes[0]), (p2 - p0).dot(portal.axes[1]));
            let mut seen = 0.0;
            for i in 0..side * side {
                let at = |k: usize| (k as f64 + 0.5) / side as f64;
                let [s, t] = [at(i % side), at(i / side)];
                let p = p0 + portal.axes[0] * (a * s) + portal.axes[1] * (b * t);
                let d = p - widen3(from);
                let w = d.normalize();
                let cell = (a * b).abs() / (side * side) as f64;
                let solid_angle = cell * w.dot(portal.axes[2]) / d.length_squared();
                let (_, pdf) = portal.arriving(from, narrow3(w));
                expected[i / side / fine * cells + i % side / fine] += f64::from(pdf) * solid_angle;
                seen += solid_angle;
            }
            assert!((seen / solid_angle_of(&portal, from) - 1.0).abs() < 1e-3);
            let integral: f64 = expected.iter().sum();
            assert!((integral - 1.0).abs() < 3e-3, "{from:?}: {integral}");

            let n = 100_000_u32;
            let mut found = vec![0.0_f64; cells * cells];
            for i in 0..n {
                let u = Sampler::new([i, 1], 0, 5).camera();
                let (wi, radiance, pdf) = portal.sample(from, [u[0], u[1]]).unwrap();
                let (looked_up, again) = portal.arriving(from, wi);
                // Rounding moves directions over the borders of pixels, and of the portal.
                if looked_up == radiance {
                    assert!((again / pdf - 1.0).abs() < 1e-3, "{again} and {pdf}");
                }
                let w = widen3(wi);
                let distance = (p0 - widen3(from)).dot(portal.axes[2]) / w.dot(portal.axes[2]);
                let at = widen3(from) + w * distance - p0;
                let cell = |k: usize, length: f64| {
                    let share = at.dot(portal.axes[k]) / length * cells as f64;
                    crate::convert::floor_index(narrow(share)).min(cells - 1)
                };
                found[cell(1, b) * cells + cell(0, a)] += 1.0;
            }
            let pairs = expected.iter().map(|e| e * f64::from(n)).zip(&found);
            let (mut chi_square, mut freedom) = (0.0, -1.0);
            for (e, f) in pairs {
                if e > 5.0 {
                    chi_square += (f - e) * (f - e) / e;
                    freedom += 1.0;
                } else {
                    assert!(*f < 40.0, "{f} where {e} were expected");
                }
            }
            let most = freedom + 5.0 * f64::sqrt(2.0 * freedom);
            assert!(
                freedom > 10.0 && chi_square < most,
                "{from:?}: {chi_square} of {freedom}"
            );
        }
    }

    /// A white sky: its irradiance over solid angle, by samples.
    #[test]
    fn samples_of_a_white_sky_have_the_portal_s_solid_angle() {
        let (portal, centre) = portal(|_, _| [1.0; 3]);
        for from in points(&portal, centre) {
            let n = 4096_u32;
            let mut mean = 0.0;
            for i in 0..n {
                let u = Sampler::new([0, 0], i, 5).camera();
                let (_, radiance, pdf) = portal.sample(from, [u[0], u[1]]).unwrap();
                mean += f64::from(radiance.g / pdf) / f64::from(n);
            }
            let expected = solid_angle_of(&portal, from);
            assert!(
                (mean / expected - 1.0).abs() < 5e-3,
                "{mean} and {expected}"
            );
        }
    }

    #[test]
    fn nothing_is_seen_beside_the_portal_or_from_behind() {
        let (portal, centre) = portal(|_, _| [1.0; 3]);
        let [x, _, z] = portal.axes;
        let before = narrow3(centre - z);
        let towards = |a: f64| narrow3((x * a + z).normalize());
        assert_eq!(portal.arriving(before, towards(0.99)).0, Rgb::WHITE);
        assert_eq!(portal.arriving(before, towards(1.01)), (Rgb::BLACK, 0.0));
        assert_eq!(portal.arriving(before, -towards(0.0)), (Rgb::BLACK, 0.0));
        let behind = narrow3(centre + z);
        assert_eq!(portal.arriving(behind, towards(0.0)), (Rgb::BLACK, 0.0));
        assert!(portal.sample(behind, [0.5; 2]).is_none());
        // Next to its plane.
        let aside = portal.sample(narrow3(centre + x * 4.0), [0.5; 2]);
        assert!(aside.is_none_or(|(_, _, pdf)| pdf.is_finite()));
    }
}
