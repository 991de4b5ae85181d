//! The random walk between facets by heights, as printed (Heitz et al. 2016, algorithms 1 to 3), for any reflectance.
//!
//! Facets are sampled by the library, whose visible normals have their own proofs; heights, masking and reflectance
//! are the textbook's.

use specula_bsdf::math::Stream;
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_bsdf::vndf::VisibleNormals;
use specula_bsdf::{Alpha, Rgb, Vec3};
use specula_stat::Check;
use specula_stat::z_test::{Moments, sidak, two_sided_p};

use super::{Facets, Shape, fresnel};
use crate::common::{SUITE_TESTS, in_cells, moments, sigmas};

/// Bounces after which a walk is given up: none gets there.
const MOST: usize = 10_000;

/// A visible normal seen from `w`.
fn normal(facets: Facets, w: Vec3<f64>, stream: &mut Stream) -> Vec3<f64> {
    let u = [stream.next(), stream.next()];
    let alpha = Alpha::clamped(facets.alpha.0, facets.alpha.1);
    match facets.shape {
        Shape::Ggx => Ggx::new(alpha).sample_wm(w, u),
        Shape::Beckmann => Beckmann::new(alpha).sample_wm(w, u),
    }
}

/// The height at which a flight along `w` meets a facet, from the height `c`; `None` where it leaves.
///
/// Heights are shares of the surface below them, in `[0, 1]`.
fn flight(facets: Facets, c: f64, w: Vec3<f64>, u: f64) -> Option<f64> {
    let lambda = facets.lambda(w);
    if w.z > 0.0 {
        let met = c / (1.0 - u).powf(1.0 / lambda);
        (met < 1.0).then_some(met)
    } else {
        Some(c * (1.0 - u).powf(1.0 / (1.0 + lambda)))
    }
}

fn turned(w: Vec3<f64>) -> Vec3<f64> {
    Vec3 { z: -w.z, ..w }
}

/// Where light along `wo` leaves a rough metal, and what is left of it.
///
/// * `fresnel`: reflectance by the count of facets met before, the cosine there, and the facet.
pub(crate) fn metal(
    facets: Facets,
    fresnel: impl Fn(usize, f64, Vec3<f64>) -> Rgb<f64>,
    wo: Vec3<f64>,
    stream: &mut Stream,
) -> Option<(Vec3<f64>, Rgb<f64>)> {
    let (mut w, mut c, mut weight) = (-wo, 1.0, Rgb::WHITE);
    for bounce in 0..MOST {
        match flight(facets, c, w, stream.next()) {
            None => return Some((w, weight)),
            Some(met) => c = met,
        }
        let m = normal(facets, -w, stream);
        let cos = -w.dot(m);
        weight *= fresnel(bounce, cos, m);
        w += m * (2.0 * cos);
    }
    None
}

/// Where light along `wo`, from either side, leaves rough glass.
///
/// * `eta`: index below over the index above.
/// * `reflectance`: of a facet by the cosine and the index beyond over that before it.
pub(crate) fn glass(
    facets: Facets,
    eta: f64,
    reflectance: impl Fn(f64, f64) -> f64,
    wo: Vec3<f64>,
    stream: &mut Stream,
) -> Option<(Vec3<f64>, Rgb<f64>)> {
    // Directions and heights are those of the side that the light is on, turned upwards.
    let mut is_below = wo.z < 0.0;
    let up = |w: Vec3<f64>, is_below: bool| if is_below { turned(w) } else { w };
    let (mut w, mut c) = (-up(wo, is_below), 1.0);
    for _ in 0..MOST {
        match flight(facets, c, w, stream.next()) {
            None => return Some((up(w, is_below), Rgb::WHITE)),
            Some(met) => c = met,
        }
        let m = normal(facets, -w, stream);
        let eta = if is_below { 1.0 / eta } else { eta };
        let cos = -w.dot(m);
        let passes = stream.next::<f64>() >= reflectance(cos, eta);
        match fresnel::refracted(-w, m, eta).filter(|_| passes) {
            None => w += m * (2.0 * cos),
            Some(through) => {
                (w, c, is_below) = (turned(through), 1.0 - c, !is_below);
            }
        }
    }
    None
}

const RINGS: usize = 3;
const SECTORS: usize = 4;
const CELLS: usize = 2 * RINGS * SECTORS;
/// Red, green, blue and luminance, of each cell and of each side.
const MEANS: usize = 4 * (CELLS + 2);
const COUNT: u64 = 40_000;

/// A way to sample a direction and its weight.
pub(crate) type Sample<'a> = &'a (dyn Fn(&mut Stream) -> Option<(Vec3<f64>, Rgb<f64>)> + Sync);

/// Light in cells of the sphere, and above and below.
pub(crate) struct Light([Moments; MEANS]);

/// The light of a way to sample it.
///
/// * `seed`: of its random numbers; others are independent.
pub(crate) fn light(seed: u64, sample: Sample<'_>) -> Light {
    Light(moments(seed, COUNT, |stream| {
        let placed = sample(stream);
        let mut all = [0.0; MEANS];
        let Some((w, c)) = placed else { return all };
        for (k, x) in [c.r, c.g, c.b, c.luminance()].into_iter().enumerate() {
            let cells: [f64; CELLS] = in_cells(Some((w, x)), [RINGS, SECTORS]);
            all[k * CELLS..(k + 1) * CELLS].copy_from_slice(&cells);
            all[4 * CELLS + 2 * k + usize::from(w.z < 0.0)] = x;
        }
        all
    }))
}

/// Compares the light of two ways to sample it, per channel and in luminance.
pub(crate) fn compare(name: &str, Light(got): &Light, Light(expected): &Light) -> Check {
    let pairs = got.iter().zip(expected).enumerate();
    // Of a cell with less light some thousand samples tell nothing.
    let worst = pairs
        .filter(|(_, (a, b))| a.mean().max(b.mean()) > 2e-3)
        .map(|(k, (a, b))| (two_sided_p(sigmas(a, b)), k, a.mean(), b.mean()))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let (p, k, a, b) = worst.unwrap_or((0.0, 0, 0.0, 0.0));
    let lit = expected.iter().any(|m| m.mean() > 0.01);
    Check {
        name: format!("walk {name}"),
        is_pass: lit && p > sidak(sidak(0.01, SUITE_TESTS), MEANS),
        p_value: Some(p),
        detail: format!("p {p:.1e}: mean {k} is {a:.5}, by heights {b:.5}"),
    }
}
