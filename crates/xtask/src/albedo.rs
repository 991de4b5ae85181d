//! Generator of `specula-bsdf/src/energy/tables`: what single scattering loses, by quadrature in
//! f64.
//!
//! Normals are written as slopes `(x, y) = r (ax cos psi, ay sin psi)` with the wider distribution
//! of `psi` uniform. Along each `psi`, reflections stay above the horizon for `r` below a root in
//! closed form, so that Gauss's rule meets smooth functions only. Azimuths are counted from the
//! view's and lie closer where the root changes fastest, across the view.
#![allow(
    clippy::needless_range_loop,
    reason = "knots are counted, and one index serves several arrays"
)]

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use specula_bsdf::Alpha;
use specula_bsdf::energy::albedo::{
    self, ANISOTROPIC_ALPHAS, ANISOTROPIC_AZIMUTHS, ANISOTROPIC_COSINES, AnisotropicTable,
    Distribution, ISOTROPIC_ALPHAS, ISOTROPIC_COSINES, Tabulated, alpha_at, azimuth_at,
    azimuth_coordinate, cosine_at, cosine_coordinate,
};
use specula_bsdf::energy::dielectric_albedo::{
    ALPHAS, COSINES, DielectricTable, ETAS, EtaKnots, eta_at, interpolate,
};
use specula_bsdf::energy::stencil::Stencil;
use specula_bsdf::fresnel::{dielectric, refract};
use specula_bsdf::math::{Vec3, vec3};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::vndf::reflect;

use crate::Result;
use crate::generated::Generated;

const PATHS: [[&str; 2]; 2] = [
    [
        "crates/specula-bsdf/src/energy/tables/ggx_correlated.txt",
        "crates/specula-bsdf/src/energy/tables/ggx_separable.txt",
    ],
    [
        "crates/specula-bsdf/src/energy/tables/beckmann_correlated.txt",
        "crates/specula-bsdf/src/energy/tables/beckmann_separable.txt",
    ],
];
/// Correlated and separable, in the order of every pair here.
const MASKINGS: [Masking; 2] = [Masking::HeightCorrelated, Masking::Separable];

/// See [`albedo::AVERAGE_RANGE`].
const RANGE: f64 = albedo::AVERAGE_RANGE as f64;

/// The tables' files.
pub(crate) fn generate(_root: &Path) -> Result<Vec<Generated>> {
    let (ggx, beckmann) = std::thread::scope(|scope| {
        let other = scope.spawn(|| texts(Beckmann::new));
        let ggx = texts(Ggx::new);
        (ggx, other.join())
    });
    let beckmann = beckmann.map_err(|_| "the generator of Beckmann's tables panicked")?;
    let texts = ggx.into_iter().chain(beckmann);
    Ok(PATHS
        .into_iter()
        .flatten()
        .zip(texts)
        .map(|(path, text)| Generated { path, text })
        .collect())
}

/// The two files of a distribution.
fn texts<N: Tabulated<f64>>(ndf: impl Fn(Alpha<f64>) -> N) -> [String; 2] {
    let mut files = [Digits::default(), Digits::default()];
    isotropic(&ndf, &mut files);
    anisotropic(&ndf, &mut files);
    dielectrics(&ndf, &mut files);
    files.map(|file| file.text)
}

/// Numbers in base 94, as `albedo_tables.rs` reads them.
#[derive(Default)]
struct Digits {
    text: String,
}

impl Digits {
    /// Appends a share of 1 and returns it rounded.
    fn push(&mut self, share: f64, digits: u32) -> u32 {
        let value = rounded(share, digits);
        for k in (0..digits).rev() {
            let digit = value / 94_u32.pow(k) % 94;
            self.text.extend(char::from_u32(33 + digit));
        }
        value
    }

    fn end_line(&mut self) {
        self.text.push('\n');
    }
}

fn rounded(share: f64, digits: u32) -> u32 {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the digits"
    )]
    let value = (share.clamp(0.0, 1.0) * f64::from(94_u32.pow(digits) - 1)).round() as u32;
    value
}

fn at(i: usize, count: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "some dozen knots")]
    let x = i as f64 / (count - 1) as f64;
    x
}

fn isotropic<N: Tabulated<f64>>(ndf: &impl Fn(Alpha<f64>) -> N, files: &mut [Digits; 2]) {
    let rule = Rule::new(64, 32);
    let mut tables = [[[0.0_f32; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS]; 2];
    for i in 0..ISOTROPIC_ALPHAS {
        let width = alpha_at(at(i, ISOTROPIC_ALPHAS));
        for k in 0..ISOTROPIC_COSINES {
            let cosine = cosine_at(at(k, ISOTROPIC_COSINES), width);
            let albedo = rule.albedo(&ndf(Alpha { x: width, y: width }), view(cosine, 0.0));
            for m in 0..2 {
                let value = files[m].push(root(albedo[m]), 3);
                #[allow(clippy::cast_precision_loss, reason = "three digits fit")]
                let share = value as f32 / (94_u32.pow(3) - 1) as f32;
                tables[m][i][k] = share;
            }
        }
        files.iter_mut().for_each(Digits::end_line);
    }
    for m in 0..2 {
        for i in 0..ISOTROPIC_ALPHAS {
            let t = at(i, ISOTROPIC_ALPHAS);
            let (stencil, width) = (Stencil::new(t, ISOTROPIC_ALPHAS), alpha_at(t));
            let loss = average(|cosine| {
                let place = cosine_coordinate(cosine, width);
                albedo::isotropic(
                    &tables[m],
                    &stencil,
                    &Stencil::new(place, ISOTROPIC_COSINES),
                )
                .powi(2)
            });
            files[m].push(loss.sqrt() / albedo::average_scale(width, width) / RANGE, 4);
        }
        files[m].end_line();
    }
}

fn anisotropic<N: Tabulated<f64>>(ndf: &impl Fn(Alpha<f64>) -> N, files: &mut [Digits; 2]) {
    let rule = Rule::new(40, 20);
    let mut tables = [
        Box::new([[[0; ANISOTROPIC_COSINES]; ANISOTROPIC_AZIMUTHS]; albedo::ANISOTROPIC_PAIRS]),
        Box::new([[[0; ANISOTROPIC_COSINES]; ANISOTROPIC_AZIMUTHS]; albedo::ANISOTROPIC_PAIRS]),
    ];
    for (i, j) in pairs() {
        let (low, high) = widths(i, j);
        for v in 0..ANISOTROPIC_AZIMUTHS {
            let (share, along) = azimuth_at(low, high, at(v, ANISOTROPIC_AZIMUTHS));
            for k in 0..ANISOTROPIC_COSINES {
                let cosine = cosine_at(at(k, ANISOTROPIC_COSINES), along);
                let albedo = rule.albedo(&ndf(Alpha { x: low, y: high }), view(cosine, share));
                for m in 0..2 {
                    let value = files[m].push(root(albedo[m]), 2);
                    tables[m][albedo::pair(i, j).0][v][k] =
                        u16::try_from(value).unwrap_or(u16::MAX);
                }
            }
        }
        files.iter_mut().for_each(Digits::end_line);
    }
    for m in 0..2 {
        for (i, j) in pairs() {
            let loss = anisotropic_average(&tables[m], i, j);
            let scale = albedo::average_scale(widths(i, j).0, widths(i, j).1);
            files[m].push(loss.sqrt() / scale / RANGE, 4);
        }
        files[m].end_line();
    }
}

/// Pairs of widths, the lower first, in the order of the rows.
fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..ANISOTROPIC_ALPHAS).flat_map(|j| (0..=j).map(move |i| (i, j)))
}

fn widths(i: usize, j: usize) -> (f64, f64) {
    let width = |i| alpha_at(at(i, ANISOTROPIC_ALPHAS));
    (width(i), width(j))
}

/// The average loss of the interpolated table at a pair of its widths.
fn anisotropic_average(table: &AnisotropicTable, i: usize, j: usize) -> f64 {
    let (low, high) = widths(i, j);
    let stencils = [i, j].map(|i| Stencil::new(at(i, ANISOTROPIC_ALPHAS), ANISOTROPIC_ALPHAS));
    gauss_legendre(16)
        .iter()
        .map(|&[u, weight]| {
            // Closer together along the narrow axis, where the width along the view changes fast.
            let (y, x) = (FRAC_PI_2 * u * u).sin_cos();
            let (along, v) = azimuth_coordinate(low, high, x, y);
            let azimuth = Stencil::new(v, ANISOTROPIC_AZIMUTHS);
            let loss = average(|cosine| {
                let place = Stencil::new(cosine_coordinate(cosine, along), ANISOTROPIC_COSINES);
                albedo::anisotropic(table, [&stencils[0], &stencils[1]], &azimuth, &place).powi(2)
            });
            2.0 * u * weight * loss
        })
        .sum()
}

fn dielectrics<N: Tabulated<f64>>(ndf: &impl Fn(Alpha<f64>) -> N, files: &mut [Digits; 2]) {
    let rule = Rule::new(32, 16);
    let mut tables: [DielectricTable; 2] = [[[[0; COSINES]; ALPHAS]; ETAS]; 2];
    for i in 0..ETAS {
        let eta = eta_at(i);
        for j in 0..ALPHAS {
            let width = alpha_at(at(j, ALPHAS));
            for k in 0..COSINES {
                let wo = view(cosine_at(at(k, COSINES), width), 0.0);
                let albedo = rule.dielectric_albedo(&ndf(Alpha { x: width, y: width }), eta, wo);
                for m in 0..2 {
                    let value = files[m].push(root(albedo[m]), 2);
                    tables[m][i][j][k] = u16::try_from(value).unwrap_or(u16::MAX);
                }
            }
        }
        files.iter_mut().for_each(Digits::end_line);
    }
    for m in 0..2 {
        for i in 0..ETAS {
            for j in 0..ALPHAS {
                let width = alpha_at(at(j, ALPHAS));
                let alpha = Stencil::new(at(j, ALPHAS), ALPHAS);
                let loss = average(|cosine| {
                    let place = Stencil::new(cosine_coordinate(cosine, width), COSINES);
                    interpolate(&tables[m], &EtaKnots::new(eta_at(i)), &alpha, &place).powi(2)
                });
                files[m].push(loss.sqrt() / albedo::average_scale(width, width) / RANGE, 4);
            }
            files[m].end_line();
        }
    }
}

/// `2 int_0^1 loss(mu) mu dmu`, with `mu = z^3`: narrow lobes lose light at the horizon.
fn average(loss: impl Fn(f64) -> f64) -> f64 {
    gauss_legendre(64)
        .iter()
        .map(|&[z, weight]| 6.0 * z.powi(5) * weight * loss(z * z * z))
        .sum()
}

fn root(albedo: f64) -> f64 {
    (1.0 - albedo).max(0.0).sqrt()
}

/// The view of a cosine, `share = y^2 / (x^2 + y^2)`.
fn view(cosine: f64, share: f64) -> Vec3<f64> {
    // The horizon itself is approached.
    let cosine = cosine.max(1e-10);
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    vec3(sine * (1.0 - share).sqrt(), sine * share.sqrt(), cosine)
}

/// Nodes and weights over slopes.
struct Rule {
    radii: Vec<[f64; 2]>,
    azimuths: Vec<[f64; 2]>,
}

impl Rule {
    /// * `radii`, `azimuths`: points, the latter in each quarter turn.
    fn new(radii: u32, azimuths: u32) -> Self {
        Self {
            radii: gauss_legendre(radii),
            azimuths: gauss_legendre(azimuths),
        }
    }

    /// `E(wo)` with `F = 1`, for both maskings.
    fn albedo<N: Tabulated<f64>>(&self, ndf: &N, wo: Vec3<f64>) -> [f64; 2] {
        let mut sum = [0.0; 2];
        self.azimuths(ndf, wo, |slope, weight| {
            let end = reflection_end(wo, slope);
            for (m, measure) in self.normals::<N>(slope, [0.0, end]) {
                let wi = reflect(wo, m);
                gather(&mut sum, ndf, wo, wi, weight * measure * wo.dot(m));
            }
        });
        sum
    }

    /// `E(wo)` of an interface, both branches, for both maskings.
    fn dielectric_albedo<N: Tabulated<f64>>(&self, ndf: &N, eta: f64, wo: Vec3<f64>) -> [f64; 2] {
        let mut sum = [0.0; 2];
        self.azimuths(ndf, wo, |slope, weight| {
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
    fn azimuths<N: Tabulated<f64>>(
        &self,
        ndf: &N,
        wo: Vec3<f64>,
        mut each: impl FnMut([f64; 2], f64),
    ) {
        let Alpha { x, y } = ndf.alpha();
        let start = (y * wo.y).atan2(x * wo.x);
        for &[u, weight] in &self.azimuths {
            for turn in [-1.0, 1.0] {
                for side in [-1.0, 1.0] {
                    let psi = start + side * FRAC_PI_2 * (1.0 + turn * u * u);
                    let (sine, cosine) = psi.sin_cos();
                    each([x * cosine, y * sine], PI * u * weight);
                }
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
            let density = match N::DISTRIBUTION {
                // p(r) r dr = r dr / (pi (1 + r^2)^2), r = tan(angle).
                Distribution::Ggx => r / (1.0 + r * r),
                Distribution::Beckmann => (-r * r).exp() * r * (1.0 + r * r),
            };
            let m = vec3(r * slope[0], r * slope[1], 1.0);
            let length = m.length();
            // D(wm) wm.z dwm = p(slopes) dslopes.
            (m * (1.0 / length), density * length * measure)
        })
    }
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
fn gauss_legendre(count: u32) -> Vec<[f64; 2]> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::energy::{DielectricLoss, Loss};
    use specula_bsdf::math::Stream;

    /// Largest and root of the mean squared difference.
    #[derive(Default)]
    struct Errors {
        largest: f64,
        squares: f64,
        count: f64,
        at: String,
    }

    impl Errors {
        fn push(&mut self, got: f64, expected: f64, at: impl Fn() -> String) {
            let error = (got - expected).abs();
            assert!(error.is_finite(), "{}", at());
            self.squares += error * error;
            self.count += 1.0;
            if error > self.largest {
                self.largest = error;
                self.at = at();
            }
        }

        fn rms(&self) -> f64 {
            (self.squares / self.count).sqrt()
        }

        /// Prints and holds the bounds of the largest and of the mean error.
        fn hold(&self, name: &str, largest: f64, rms: f64) {
            println!(
                "{name}: largest {:.2e} at {}, rms {:.2e}",
                self.largest,
                self.at,
                self.rms()
            );
            assert!(
                self.count > 100.0 && self.largest > 1e-9,
                "{name} compares nothing"
            );
            assert!(self.largest < largest && self.rms() < rms, "{name}");
        }
    }

    /// A width, half the time uniform and half the time uniform in its logarithm.
    fn width(stream: &mut Stream, [low, high]: [f64; 2]) -> f64 {
        let (kind, u): (f64, f64) = (stream.next(), stream.next());
        if kind < 0.5 {
            low + u * (high - low)
        } else {
            low * (high / low).powf(u)
        }
    }

    /// A cosine, half the time about as small as the width.
    fn cosine(stream: &mut Stream, width: f64) -> f64 {
        let (kind, u): (f64, f64) = (stream.next(), stream.next());
        let cosine = if kind < 0.5 { u } else { 3.0 * u * u * width };
        cosine.clamp(1e-6, 1.0)
    }

    fn losses<N: Tabulated<f64>>(ndf: N, wo: Vec3<f64>) -> [f64; 2] {
        MASKINGS.map(|masking| Loss::new(ndf, masking).directional(wo))
    }

    fn isotropic_errors<N: Tabulated<f64>>(
        ndf: impl Fn(Alpha<f64>) -> N,
        range: [f64; 2],
    ) -> Errors {
        let (rule, mut stream, mut errors) = (Rule::new(96, 40), Stream::new(1), Errors::default());
        for _ in 0..2000 {
            let a = width(&mut stream, range);
            let wo = view(cosine(&mut stream, a), 0.3);
            let ndf = ndf(Alpha { x: a, y: a });
            let exact = rule.albedo(&ndf, wo);
            for (loss, albedo) in losses(ndf, wo).into_iter().zip(exact) {
                errors.push(1.0 - loss, albedo, || {
                    format!("alpha {a:.4}, mu {:.5}", wo.z)
                });
            }
        }
        errors
    }

    #[test]
    fn isotropic_tables_hold_their_bounds() {
        let (usual, whole) = ([1e-4, 2.0], [1e-4, 10.0]);
        let ggx = |range| isotropic_errors(Ggx::new, range);
        ggx(usual).hold("GGX, usual widths", 3e-4, 2e-5);
        ggx(whole).hold("GGX, all widths", 2e-3, 1e-4);
        let beckmann = |range| isotropic_errors(Beckmann::new, range);
        beckmann(usual).hold("Beckmann, usual widths", 1e-4, 2e-5);
        beckmann(whole).hold("Beckmann, all widths", 2e-4, 2e-5);
    }

    /// Errors of the anisotropic tables, and of the isotropic ones at `sqrt(ax ay)`.
    fn anisotropic_errors<N: Tabulated<f64>>(
        ndf: impl Fn(Alpha<f64>) -> N,
        range: [f64; 2],
    ) -> [Errors; 2] {
        let (rule, mut stream) = (Rule::new(48, 24), Stream::new(2));
        let mut errors = [Errors::default(), Errors::default()];
        for _ in 0..2000 {
            let (x, y) = (width(&mut stream, range), width(&mut stream, range));
            let azimuth: f64 = stream.next();
            let share = (FRAC_PI_2 * azimuth).sin().powi(2);
            let along = (x * x * (1.0 - share) + y * y * share).sqrt();
            let wo = view(cosine(&mut stream, along), share);
            let g = (x * y).sqrt();
            let (one, mean) = (ndf(Alpha { x, y }), ndf(Alpha { x: g, y: g }));
            let exact = rule.albedo(&one, wo);
            for (got, errors) in [losses(one, wo), losses(mean, wo)]
                .into_iter()
                .zip(&mut errors)
            {
                for (loss, albedo) in got.into_iter().zip(exact) {
                    errors.push(1.0 - loss, albedo, || format!("({x:.4}, {y:.4}), {wo:.4?}"));
                }
            }
        }
        errors
    }

    #[test]
    fn anisotropic_tables_hold_their_bounds() {
        let (usual, whole) = ([0.05, 1.5], [1e-4, 10.0]);
        let [ours, mean] = anisotropic_errors(Ggx::new, usual);
        ours.hold("GGX, usual widths", 5e-3, 3e-4);
        mean.hold("GGX, usual widths, isotropic table", 1.0, 1.0);
        assert!(mean.rms() > 100.0 * ours.rms());
        let [ours, _] = anisotropic_errors(Ggx::new, whole);
        ours.hold("GGX, all widths", 6e-2, 2e-3);
        let [ours, mean] = anisotropic_errors(Beckmann::new, usual);
        ours.hold("Beckmann, usual widths", 5e-3, 7e-4);
        mean.hold("Beckmann, usual widths, isotropic table", 1.0, 1.0);
        let [ours, _] = anisotropic_errors(Beckmann::new, whole);
        ours.hold("Beckmann, all widths", 6e-2, 2e-3);
    }

    fn dielectric_errors<N: Tabulated<f64>>(
        ndf: impl Fn(Alpha<f64>) -> N,
        isotropic: bool,
    ) -> Errors {
        let (rule, mut stream, mut errors) = (Rule::new(40, 24), Stream::new(3), Errors::default());
        for _ in 0..600 {
            let (a, b) = (
                width(&mut stream, [0.02, 1.5]),
                width(&mut stream, [0.02, 1.5]),
            );
            let alpha = Alpha {
                x: a,
                y: if isotropic { a } else { b },
            };
            let (u, azimuth): (f64, f64) = (stream.next(), stream.next());
            let eta = if u < 0.5 {
                1.05 + 2.8 * u
            } else {
                1.0 / (1.05 + 2.8 * (u - 0.5))
            };
            let wo = view(cosine(&mut stream, a), azimuth);
            let ndf = ndf(alpha);
            let exact = rule.dielectric_albedo(&ndf, eta, wo);
            for (masking, albedo) in MASKINGS.into_iter().zip(exact) {
                let loss = DielectricLoss::new(ndf, masking, eta).directional(wo);
                errors.push(1.0 - loss, albedo, || {
                    format!("{alpha:.3?} eta {eta:.3} {wo:.4?}")
                });
            }
        }
        errors
    }

    #[test]
    fn dielectric_tables_hold_their_bounds() {
        dielectric_errors(Ggx::new, true).hold("GGX interface", 1.5e-2, 1.5e-3);
        dielectric_errors(Beckmann::new, true).hold("Beckmann interface", 2e-2, 2e-3);
        dielectric_errors(Ggx::new, false).hold("anisotropic interface", 0.7, 0.1);
    }
}
