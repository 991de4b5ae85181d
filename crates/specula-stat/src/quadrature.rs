//! Integrals over the sphere with error estimates: adaptive Gauss-Kronrod on patches in
//! (theta, phi); and Gauss-Legendre nodes of any order.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::PI;

use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;

/// The value of an integral, with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral<const N: usize> {
    /// One value for each component of the integrand.
    pub value: [f64; N],
    /// Estimate of the absolute error, the largest over the components. Infinite where the
    /// integrand was not finite.
    pub error: f64,
    /// How often the integrand was evaluated.
    pub evaluations: usize,
    /// Whether the tolerance was reached.
    pub converged: bool,
}

impl<const N: usize> Integral<N> {
    /// The same integral with other components.
    pub(crate) fn with_value<const M: usize>(&self, value: [f64; M]) -> Integral<M> {
        Integral {
            value,
            error: self.error,
            evaluations: self.evaluations,
            converged: self.converged,
        }
    }
}

/// A rectangle in spherical coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Bounds of the polar angle, radians, in `[0, pi]`.
    pub theta: [f64; 2],
    /// Bounds of the azimuth, radians.
    pub phi: [f64; 2],
}

impl Patch {
    /// The whole sphere.
    pub const SPHERE: Self = Self {
        theta: [0.0, PI],
        phi: [0.0, 2.0 * PI],
    };
    /// Directions with `z > 0`.
    pub const UPPER: Self = Self {
        theta: [0.0, 0.5 * PI],
        phi: [0.0, 2.0 * PI],
    };

    /// Solid angle, sr.
    #[must_use]
    pub fn solid_angle(&self) -> f64 {
        (self.theta[0].cos() - self.theta[1].cos()) * (self.phi[1] - self.phi[0])
    }

    /// The two halves, cut across the side that is longer on the sphere, and the cut's axis
    /// (0: theta, 1: phi) and place.
    #[must_use]
    pub fn bisect(&self) -> ([Self; 2], usize, f64) {
        let [height, width] = self.extent();
        let axis = usize::from(width > height);
        let (halves, at) = self.bisect_along(axis);
        (halves, axis, at)
    }

    fn bisect_along(&self, axis: usize) -> ([Self; 2], f64) {
        let (mut a, mut b) = (*self, *self);
        let at = if axis == 0 {
            0.5 * (self.theta[0] + self.theta[1])
        } else {
            0.5 * (self.phi[0] + self.phi[1])
        };
        if axis == 0 {
            a.theta[1] = at;
            b.theta[0] = at;
        } else {
            a.phi[1] = at;
            b.phi[0] = at;
        }
        ([a, b], at)
    }

    /// Height and width on the unit sphere, radians; the width where it is widest.
    fn extent(&self) -> [f64; 2] {
        let widest = if self.theta[0] < 0.5 * PI && self.theta[1] > 0.5 * PI {
            1.0
        } else {
            self.theta[0].sin().max(self.theta[1].sin())
        };
        [
            self.theta[1] - self.theta[0],
            widest * (self.phi[1] - self.phi[0]),
        ]
    }

    /// Whether the direction (`theta`, `phi`) is within the patch or, nearly, within `margin`
    /// radians of it.
    fn is_near(&self, theta: f64, phi: f64, margin: f64) -> bool {
        let margin_phi = margin / theta.sin().max(margin);
        let centre = 0.5 * (self.phi[0] + self.phi[1]);
        let across = (phi - centre + PI).rem_euclid(2.0 * PI) - PI;
        theta > self.theta[0] - margin
            && theta < self.theta[1] + margin
            && across.abs() < 0.5 * (self.phi[1] - self.phi[0]) + margin_phi
    }
}

/// A direction about which an integrand is sharply peaked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Unit direction.
    pub direction: Vec3<f64>,
    /// Angular width in radians; patches near the peak start no larger than this.
    pub width: f64,
}

/// Smallest width of a peak that is taken into account, in radians.
const NARROWEST: f64 = 1e-9;
/// Smallest extent of the patches of the start, in radians.
const SMALLEST_START: f64 = 1e-3;

/// Adaptive quadrature over the sphere.
///
/// Patches are integrated by the tensor product of the 7/15-point Gauss-Kronrod rule; the patch of
/// the largest error is cut in half across its worse direction until the tolerance holds. The
/// integrand is taken in (theta, phi), not (cos theta, phi): smooth functions stay smooth at the
/// poles.
///
/// # Examples
///
/// ```
/// use specula_stat::quadrature::{Patch, Quadrature};
///
/// let cosine = Quadrature::default().integrate(Patch::UPPER, |w| [w.z]);
/// assert!((cosine.value[0] - std::f64::consts::PI).abs() < 1e-9);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Quadrature {
    /// Stop where the error falls below this times the largest component.
    pub relative_tolerance: f64,
    /// Or below this.
    pub absolute_tolerance: f64,
    /// Give up at this number of patches (225 evaluations for each).
    pub max_patches: usize,
    /// Patches start no larger than this, in radians: what is narrower than a tenth of it and has
    /// no tails can be missed, unless it is named in `peaks`.
    pub start_extent: f64,
    /// Directions about which the start is finer.
    pub peaks: Vec<Peak>,
}

impl Default for Quadrature {
    fn default() -> Self {
        Self {
            relative_tolerance: 1e-7,
            absolute_tolerance: 1e-12,
            max_patches: 20_000,
            start_extent: PI / 8.0,
            peaks: Vec::new(),
        }
    }
}

impl Quadrature {
    /// `integral over patch of f(w) dw`, per component.
    ///
    /// * `f`: of a unit direction, per steradian.
    #[must_use]
    pub fn integrate<const N: usize>(
        &self,
        patch: Patch,
        f: impl Fn(Vec3<f64>) -> [f64; N],
    ) -> Integral<N> {
        let rule = Rule::new();
        let mut evaluations = 0;
        let mut measure = |patch: Patch| {
            evaluations += Rule::POINTS;
            rule.apply(patch, &f)
        };
        let mut heap: BinaryHeap<Part<N>> =
            self.start(patch).into_iter().map(&mut measure).collect();
        let (mut value, mut error) = totals(&heap);
        loop {
            let magnitude = value.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let goal = self
                .absolute_tolerance
                .max(self.relative_tolerance * magnitude);
            if error <= goal || heap.len() >= self.max_patches || !error.is_finite() {
                break;
            }
            let Some(worst) = heap.pop() else { break };
            let (halves, _) = worst.patch.bisect_along(worst.worse_axis);
            error -= worst.error;
            for (total, part) in value.iter_mut().zip(worst.value) {
                *total -= part;
            }
            for part in halves.map(&mut measure) {
                error += part.error;
                for (total, part) in value.iter_mut().zip(part.value) {
                    *total += part;
                }
                heap.push(part);
            }
        }
        let (value, error) = totals(&heap);
        let magnitude = value.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let goal = self
            .absolute_tolerance
            .max(self.relative_tolerance * magnitude);
        Integral {
            value,
            error,
            evaluations,
            converged: error <= 1.001 * goal,
        }
    }

    /// The patches to start from.
    fn start(&self, whole: Patch) -> Vec<Patch> {
        let peaks: Vec<(f64, f64, f64)> = self
            .peaks
            .iter()
            .map(|p| {
                let (theta, phi) = angles(p.direction);
                (theta, phi, p.width.max(NARROWEST))
            })
            .collect();
        let start_extent = self.start_extent.max(SMALLEST_START);
        let mut pending = vec![whole];
        let mut ready = Vec::new();
        while let Some(patch) = pending.pop() {
            let [height, width] = patch.extent();
            let extent = height.max(width);
            let too_large = extent > 1.001 * start_extent
                || peaks
                    .iter()
                    .any(|&(theta, phi, w)| extent > 1.001 * w && patch.is_near(theta, phi, w));
            if too_large {
                pending.extend(patch.bisect().0);
            } else {
                ready.push(patch);
            }
        }
        ready
    }
}

/// Polar angle and azimuth of `w`, radians, in `[0, pi]` and `[0, 2 pi)`.
#[must_use]
pub fn angles(w: Vec3<f64>) -> (f64, f64) {
    // By atan2, which is accurate for small angles from the poles, unlike acos.
    let theta = w.x.hypot(w.y).atan2(w.z);
    let phi = w.y.atan2(w.x);
    let phi = if phi < 0.0 { phi + 2.0 * PI } else { phi };
    (theta, if phi >= 2.0 * PI { 0.0 } else { phi })
}

/// The unit direction of a polar angle's cosine and an azimuth in radians.
#[must_use]
pub fn direction(cos_theta: f64, phi: f64) -> Vec3<f64> {
    let sin_theta = ((1.0 - cos_theta) * (1.0 + cos_theta)).max(0.0).sqrt();
    vec3(sin_theta * phi.cos(), sin_theta * phi.sin(), cos_theta)
}

/// Nodes and weights of the `n`-point Gauss-Legendre rule on `[-1, 1]`, ascending: exact for
/// polynomials up to degree `2 n - 1`.
///
/// Newton's method on the three-term recurrence of the Legendre polynomials.
#[must_use]
pub fn gauss_legendre(n: usize) -> Vec<[f64; 2]> {
    #[expect(clippy::cast_precision_loss, reason = "orders are small")]
    let real = |k: usize| k as f64;
    (0..n)
        .map(|i| {
            let mut x = -(PI * (real(i) + 0.75) / (real(n) + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let (mut p, mut before) = (1.0, 0.0);
                for k in 0..n {
                    let next = ((2.0 * real(k) + 1.0) * x * p - real(k) * before) / real(k + 1);
                    before = p;
                    p = next;
                }
                slope = real(n) * (x * p - before) / (x * x - 1.0);
                let step = p / slope;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            [x, 2.0 / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}

/// One patch and its integral.
struct Part<const N: usize> {
    patch: Patch,
    value: [f64; N],
    error: f64,
    worse_axis: usize,
}

impl<const N: usize> PartialEq for Part<N> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl<const N: usize> Eq for Part<N> {}
impl<const N: usize> PartialOrd for Part<N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<const N: usize> Ord for Part<N> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error)
    }
}

fn totals<const N: usize>(parts: &BinaryHeap<Part<N>>) -> ([f64; N], f64) {
    let mut value = [0.0; N];
    let mut error = 0.0;
    for part in parts {
        error += part.error;
        for (total, v) in value.iter_mut().zip(part.value) {
            *total += v;
        }
    }
    (value, error)
}

/// Positive nodes of the 15-point Kronrod rule (Piessens et al. 1983, QUADPACK, `qk15`).
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
/// Their Kronrod weights.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_83,
];
/// Gauss weights of every second node.
const GAUSS: [f64; 4] = [
    0.129_484_966_168_869_7,
    0.279_705_391_489_276_64,
    0.381_830_050_505_118_9,
    0.417_959_183_673_469_4,
];

/// The nested 7/15-point rule, written out over `[-1, 1]`.
struct Rule {
    /// Node, Kronrod weight, Gauss weight.
    points: [[f64; 3]; 15],
}

impl Rule {
    const POINTS: usize = 225;

    fn new() -> Self {
        let points = std::array::from_fn(|i| {
            let k = i.min(14 - i);
            let sign = if i < 7 { -1.0 } else { 1.0 };
            let gauss = if k % 2 == 1 { GAUSS[k / 2] } else { 0.0 };
            [sign * NODES[k], KRONROD[k], gauss]
        });
        Self { points }
    }

    fn apply<const N: usize>(&self, patch: Patch, f: &impl Fn(Vec3<f64>) -> [f64; N]) -> Part<N> {
        let map =
            |range: [f64; 2], x: f64| 0.5 * ((range[0] + range[1]) + (range[1] - range[0]) * x);
        let azimuths = self.points.map(|p| map(patch.phi, p[0]).sin_cos());
        let scale = 0.25 * (patch.theta[1] - patch.theta[0]) * (patch.phi[1] - patch.phi[0]);
        // Kronrod in both directions; Gauss in theta; Gauss in phi.
        let (mut both, mut in_theta, mut in_phi) = ([0.0; N], [0.0; N], [0.0; N]);
        let mut squares = 0.0;
        for [x, kronrod, gauss] in self.points {
            let (sin_theta, cos_theta) = map(patch.theta, x).sin_cos();
            let (mut row, mut row_gauss) = ([0.0; N], [0.0; N]);
            for ([_, weight, weight_gauss], (sin_phi, cos_phi)) in self.points.iter().zip(azimuths)
            {
                let w = vec3(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta);
                let values = f(w);
                for n in 0..N {
                    row[n] += weight * values[n];
                    row_gauss[n] += weight_gauss * values[n];
                    squares += kronrod * weight * (values[n] * sin_theta * scale).powi(2);
                }
            }
            for n in 0..N {
                both[n] += kronrod * row[n] * sin_theta * scale;
                in_theta[n] += gauss * row[n] * sin_theta * scale;
                in_phi[n] += kronrod * row_gauss[n] * sin_theta * scale;
            }
        }
        let mut errors = [0.0_f64; 2];
        let mut spread = 0.0_f64;
        for n in 0..N {
            errors[0] = errors[0].max((both[n] - in_theta[n]).abs());
            errors[1] = errors[1].max((both[n] - in_phi[n]).abs());
            spread = spread.max(both[n].abs());
        }
        let spread = spread.max((4.0 * squares).sqrt());
        let error = errors.map(|e| sharpen(e, spread));
        let finite = both.iter().all(|v| v.is_finite());
        Part {
            patch,
            value: both,
            error: if finite {
                error[0] + error[1]
            } else {
                f64::INFINITY
            },
            worse_axis: usize::from(errors[1] > errors[0]),
        }
    }
}

/// A bound of the 15-point rule's error, from its difference to the 7-point rule.
///
/// QUADPACK's bound, which is the lower one where the integrand is smooth; at kinks ten times the difference, because
/// once is too little where a kink makes both rules err alike.
fn sharpen(difference: f64, spread: f64) -> f64 {
    if spread == 0.0 {
        return 0.0;
    }
    let smooth = spread * (200.0 * difference / spread).powf(1.5);
    smooth.min(10.0 * difference).max(1e-16 * spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_legendre_is_exact_to_its_degree() {
        for n in [1, 2, 5, 16, 64] {
            let nodes = gauss_legendre(n);
            for degree in 0..2 * n {
                let sum: f64 = nodes
                    .iter()
                    .map(|[x, w]| w * x.powi(i32::try_from(degree).unwrap()))
                    .sum();
                #[expect(clippy::cast_precision_loss, reason = "degrees are small")]
                let expected = if degree % 2 == 0 {
                    2.0 / (degree as f64 + 1.0)
                } else {
                    0.0
                };
                assert!(
                    (sum - expected).abs() < 1e-13,
                    "n {n}, degree {degree}: {sum}"
                );
            }
        }
    }

    #[test]
    fn kronrod_is_exact_to_degree_22_and_gauss_to_13() {
        let rule = Rule::new();
        for degree in (0..=22).step_by(2) {
            let sum = |column: usize| -> f64 {
                rule.points
                    .iter()
                    .map(|p| p[column] * p[0].powi(degree))
                    .sum()
            };
            let expected = 2.0 / (f64::from(degree) + 1.0);
            assert!(
                (sum(1) - expected).abs() < 1e-15,
                "degree {degree}: {}",
                sum(1)
            );
            if degree <= 13 {
                assert!(
                    (sum(2) - expected).abs() < 1e-15,
                    "degree {degree}: {}",
                    sum(2)
                );
            }
        }
    }

    #[test]
    fn narrow_von_mises_fisher_lobe_integrates_to_one() {
        for (cos_theta, kappa) in [(1.0, 1e3), (0.3, 1e4), (0.0, 1e5), (-1.0, 50.0)] {
            let mean = direction(cos_theta, 2.1);
            let quadrature = Quadrature {
                peaks: vec![Peak {
                    direction: mean,
                    width: 3.0 / f64::sqrt(kappa),
                }],
                ..Quadrature::default()
            };
            let norm = kappa / (2.0 * PI * (1.0 - f64::exp(-2.0 * kappa)));
            let integral = quadrature.integrate(Patch::SPHERE, |w| {
                [norm * f64::exp(-0.5 * kappa * (w - mean).length_squared())]
            });
            let off = (integral.value[0] - 1.0).abs();
            assert!(
                integral.converged && off < 1e-7,
                "kappa {kappa}: {integral:?}"
            );
            assert!(off <= integral.error + 1e-12, "bound too low: {integral:?}");
        }
    }

    #[test]
    fn a_step_is_found_and_its_error_admitted() {
        let quadrature = Quadrature {
            relative_tolerance: 1e-4,
            ..Quadrature::default()
        };
        let axis = direction(0.4, 1.0);
        let cap = quadrature.integrate(Patch::SPHERE, |w| [f64::from(u8::from(w.dot(axis) > 0.8))]);
        let off = (cap.value[0] - 2.0 * PI * 0.2).abs();
        assert!(off < 1e-4 * 2.0 * PI, "{cap:?}");
    }

    #[test]
    fn errors_at_kinks_are_admitted() {
        // Functions of the distance from a plane with their integrals over x in -1..1, times 2 pi.
        type Kink = (fn(f64) -> f64, f64);
        let kinks: [Kink; 3] = [
            (f64::abs, 1.0),
            (|x| (x - 0.3).max(0.0), 0.5 * 0.49),
            (
                |x| (x - 0.3).max(0.0).sqrt(),
                2.0 / 3.0 * 0.7 * 0.7_f64.sqrt(),
            ),
        ];
        for (k, (f, integral)) in kinks.into_iter().enumerate() {
            for (cos_theta, phi) in [(0.4, 1.0), (0.93, 2.0), (-0.05, 4.0), (1.0, 0.0)] {
                let axis = direction(cos_theta, phi);
                for relative_tolerance in [1e-4, 1e-5, 1e-6] {
                    let quadrature = Quadrature {
                        relative_tolerance,
                        ..Quadrature::default()
                    };
                    let found = quadrature.integrate(Patch::SPHERE, |w| [f(w.dot(axis))]);
                    let off = (found.value[0] - 2.0 * PI * integral).abs();
                    assert!(
                        found.converged && off <= found.error + 1e-13,
                        "kink {k}, axis {axis:?}: off by {off:.1e}, {found:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn not_a_number_is_reported() {
        let integral = Quadrature::default()
            .integrate(Patch::UPPER, |w| [if w.z > 0.99 { f64::NAN } else { 1.0 }]);
        assert!(!integral.converged && integral.error.is_infinite());
    }

    #[test]
    fn angles_invert_direction() {
        for (z, phi) in [(1.0 - 1e-12, 0.5), (0.2, 6.2), (-0.9, 3.0), (0.0, 0.0)] {
            let (theta, phi_back) = angles(direction(z, phi));
            assert!((theta.cos() - z).abs() < 1e-14 && (phi - phi_back).abs() < 1e-9);
        }
    }
}
