//! Albedos by quadrature in f64.
//!
//! Normals are written as slopes `(x, y) = r (ax cos psi, ay sin psi)` with the wider distribution
//! of `psi` uniform. Along each `psi`, reflections stay above the horizon for `r` below a root in
//! closed form, so that Gauss's rule meets smooth functions only. Azimuths are panels between those
//! at which that root changes fast, with points closer together at both ends: the narrow axis, the
//! directions across the view, and where total reflection begins.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use specula_bsdf::Alpha;
use specula_bsdf::fresnel::{dielectric, refract};
use specula_bsdf::internal::albedo::{Tabulated, TabulatedNdf};
use specula_bsdf::math::{Vec3, vec3};
use specula_bsdf::ndf::Masking;
use specula_bsdf::vndf::reflect;

/// Correlated and separable, in the order of every pair here.
pub(super) const MASKINGS: [Masking; 2] = [Masking::HeightCorrelated, Masking::Separable];

/// The view of a cosine, `share = y^2 / (x^2 + y^2)`.
pub(super) fn view(cosine: f64, share: f64) -> Vec3<f64> {
    // The horizon itself is approached.
    let cosine = cosine.max(1e-10);
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    vec3(sine * (1.0 - share).sqrt(), sine * share.sqrt(), cosine)
}

/// Nodes and weights over slopes.
pub(super) struct Rule {
    radii: Vec<[f64; 2]>,
    azimuths: Vec<[f64; 2]>,
}

impl Rule {
    /// * `radii`, `azimuths`: points of each panel.
    pub(super) fn new(radii: u32, azimuths: u32) -> Self {
        Self {
            radii: gauss_legendre(radii),
            azimuths: gauss_legendre(azimuths),
        }
    }

    /// `E(wo)` with `F = 1`, for both maskings.
    pub(super) fn albedo<N: Tabulated<f64>>(&self, ndf: &N, wo: Vec3<f64>) -> [f64; 2] {
        let mut sum = [0.0; 2];
        self.azimuths(ndf, wo, &[], |slope, weight| {
            let end = reflection_end(wo, slope);
            for (m, measure) in self.normals::<N>(slope, [0.0, end]) {
                let wi = reflect(wo, m);
                gather(&mut sum, ndf, wo, wi, weight * measure * wo.dot(m));
            }
        });
        sum
    }

    /// `E(wo)` of an interface, both branches, for both maskings.
    pub(super) fn dielectric_albedo<N: Tabulated<f64>>(
        &self,
        ndf: &N,
        eta: f64,
        wo: Vec3<f64>,
    ) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let critical2 = (1.0 - eta * eta).max(0.0);
        let edges = [critical2, critical2 - wo.z * wo.z].map(|c2| c2.max(0.0).sqrt());
        self.azimuths(ndf, wo, &edges, |slope, weight| {
            let critical = critical_ends(wo, slope, eta);
            for panel in panels(critical, reflection_end(wo, slope)) {
                for (m, measure) in self.normals::<N>(slope, panel) {
                    let cosine = wo.dot(m);
                    let reflected = dielectric(cosine, eta).reflectance;
                    let seen = weight * measure * cosine;
                    gather(&mut sum, ndf, wo, reflect(wo, m), seen * reflected);
                }
            }
            for panel in panels(critical, visible_end(wo, slope)) {
                for (m, measure) in self.normals::<N>(slope, panel) {
                    let cosine = wo.dot(m);
                    let bent = dielectric(cosine, eta);
                    let wi = refract(wo, m, cosine, bent.cos_t, eta);
                    if bent.reflectance < 1.0 && wi.z < 0.0 {
                        let seen = weight * measure * cosine;
                        gather(&mut sum, ndf, wo, wi, seen * (1.0 - bent.reflectance));
                    }
                }
            }
        });
        sum
    }

    /// Every direction of slopes of unit roughness, stretched, with its weight.
    ///
    /// * `edges`: cosines between the view and a direction of slopes, beside which there is no
    ///   smooth function.
    fn azimuths<N: Tabulated<f64>>(
        &self,
        ndf: &N,
        wo: Vec3<f64>,
        edges: &[f64],
        mut each: impl FnMut([f64; 2], f64),
    ) {
        let Alpha { x, y } = ndf.alpha();
        for [start, end] in azimuth_panels(x, y, wo, edges) {
            for &[u, weight] in &self.azimuths {
                let psi = start + (end - start) * u * u * (3.0 - 2.0 * u);
                let (sine, cosine) = psi.sin_cos();
                let measure = (end - start) * 6.0 * u * (1.0 - u);
                each([x * cosine, y * sine], measure * weight);
            }
        }
    }

    /// Unit normals along a direction of slopes, `r` from `start` to `end`, each with `D(wm) dwm`
    /// per azimuth; closer together at both ends.
    fn normals<N: Tabulated<f64>>(
        &self,
        slope: [f64; 2],
        [start, end]: [f64; 2],
    ) -> impl Iterator<Item = (Vec3<f64>, f64)> {
        let (first, last) = (start.atan(), end.atan());
        self.radii.iter().map(move |&[u, weight]| {
            let angle = first + (last - first) * u * u * (3.0 - 2.0 * u);
            let measure = (last - first) * 6.0 * u * (1.0 - u) * weight / PI;
            let r = angle.tan();
            let density = match N::TABLES {
                // p(r) r dr = r dr / (pi (1 + r^2)^2), r = tan(angle).
                TabulatedNdf::Ggx => r / (1.0 + r * r),
                TabulatedNdf::Beckmann => (-r * r).exp() * r * (1.0 + r * r),
            };
            let m = vec3(r * slope[0], r * slope[1], 1.0);
            let length = m.length();
            // D(wm) wm.z dwm = p(slopes) dslopes.
            (m * (1.0 / length), density * length * measure)
        })
    }
}

/// The intervals of `psi` within which the roots along `r` change smoothly.
fn azimuth_panels(
    x: f64,
    y: f64,
    wo: Vec3<f64>,
    edges: &[f64],
) -> impl Iterator<Item = [f64; 2]> + use<> {
    let (along_x, along_y) = (x * wo.x, y * wo.y);
    let across = along_y.atan2(along_x) + FRAC_PI_2;
    let narrow = if x > y { FRAC_PI_2 } else { 0.0 };
    let mut ends = vec![narrow, narrow + PI, across, across + PI];
    for &c in edges.iter().filter(|&&c| c > 0.0) {
        // (wo . slope)^2 = c^2 |slope|^2 is quadratic in tan psi.
        let square = wo.x * wo.x + wo.y * wo.y - c * c;
        if square > 0.0 {
            let root = c * x * y * square.sqrt();
            let bottom = (along_y - c * y) * (along_y + c * y);
            for root in [-root, root] {
                let psi = (root - along_x * along_y).atan2(bottom);
                ends.extend([psi, psi + PI]);
            }
        }
    }
    for end in &mut ends {
        *end = end.rem_euclid(TAU);
    }
    ends.sort_by(f64::total_cmp);
    ends.push(ends[0] + TAU);
    (1..ends.len())
        .map(move |i| [ends[i - 1], ends[i]])
        .filter(|[start, end]| end - start > 1e-12)
}

/// Adds `G2 / |wo.z|` times what is seen, for both maskings.
fn gather<N: Tabulated<f64>>(sum: &mut [f64; 2], ndf: &N, wo: Vec3<f64>, wi: Vec3<f64>, seen: f64) {
    for (sum, masking) in sum.iter_mut().zip(MASKINGS) {
        *sum += seen * ndf.g2_over_cos(masking, wo, wi);
    }
}

/// The `r` at which the reflection off the normal along `r slope` meets the horizon.
///
/// `wi.z |m|^2 = z + 2 r b - z s^2 r^2` with `b = wo . slope` and `s = |slope|`.
fn reflection_end(wo: Vec3<f64>, slope: [f64; 2]) -> f64 {
    let b = wo.x * slope[0] + wo.y * slope[1];
    let s2 = slope[0] * slope[0] + slope[1] * slope[1];
    let q = (b * b + wo.z * wo.z * s2).sqrt();
    if b > 0.0 {
        (q + b) / (wo.z * s2)
    } else {
        wo.z / (q - b)
    }
}

/// The `r` at which the facet along `r slope` turns away from the view.
fn visible_end(wo: Vec3<f64>, slope: [f64; 2]) -> f64 {
    let b = wo.x * slope[0] + wo.y * slope[1];
    if b < 0.0 { -wo.z / b } else { f64::INFINITY }
}

/// The values of `r` at which total reflection begins or ends, 0 where it does not.
///
/// `(z + r b)^2 = c^2 (1 + r^2 s^2)` with the critical cosine `c`.
fn critical_ends(wo: Vec3<f64>, slope: [f64; 2], eta: f64) -> [f64; 2] {
    if eta >= 1.0 {
        return [0.0; 2];
    }
    let c2 = (1.0 - eta) * (1.0 + eta);
    let b = wo.x * slope[0] + wo.y * slope[1];
    let s2 = slope[0] * slope[0] + slope[1] * slope[1];
    let (square, half) = (b * b - c2 * s2, wo.z * b);
    let root = (half * half - square * (wo.z * wo.z - c2)).max(0.0).sqrt();
    let mut ends = [(-half - root) / square, (-half + root) / square];
    ends.sort_by(f64::total_cmp);
    ends.map(|r| if r.is_finite() { r.max(0.0) } else { 0.0 })
}

/// The intervals between 0, the values inside and `end`.
fn panels(inside: [f64; 2], end: f64) -> impl Iterator<Item = [f64; 2]> {
    let [a, b] = inside.map(|r| r.min(end));
    [[0.0, a], [a, b], [b, end]]
        .into_iter()
        .filter(|[start, end]| start < end)
}

/// Nodes and weights of Gauss and Legendre's rule on `[0, 1]`, by Newton's method.
pub(super) fn gauss_legendre(count: u32) -> Vec<[f64; 2]> {
    let n = f64::from(count);
    (0..count)
        .map(|i| {
            let mut x = -(PI * (f64::from(i) + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..12 {
                let (mut p, mut before) = (1.0, 0.0);
                for k in 0..count {
                    let k = f64::from(k);
                    (p, before) = (((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0), p);
                }
                slope = n * (x * p - before) / (x * x - 1.0);
                x -= p / slope;
            }
            [0.5 * (x + 1.0), 1.0 / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}
