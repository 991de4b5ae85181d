//! Generator of `specula-bsdf/src/energy/tables`: what single scattering loses.

mod digits;
#[cfg(test)]
mod errors;
mod interface;
mod reflection;
mod rule;
mod spline;

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use specula_bsdf::Alpha;
use specula_bsdf::internal::albedo::Tabulated;
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};

use crate::Result;
use crate::generated::Generated;
use digits::Digits;
use rule::{MASKINGS, gauss_legendre};

/// The files of a distribution and masking: the small tables, and one for each large one.
const PATHS: [[&str; 4]; 4] = [
    [
        "crates/specula-bsdf/src/energy/tables/ggx_correlated.txt",
        "crates/specula-bsdf/src/energy/tables/ggx_correlated_anisotropic.txt",
        "crates/specula-bsdf/src/energy/tables/ggx_correlated_interface.txt",
        "crates/specula-bsdf/src/energy/tables/ggx_correlated_interface_anisotropic.txt",
    ],
    [
        "crates/specula-bsdf/src/energy/tables/ggx_separable.txt",
        "crates/specula-bsdf/src/energy/tables/ggx_separable_anisotropic.txt",
        "crates/specula-bsdf/src/energy/tables/ggx_separable_interface.txt",
        "crates/specula-bsdf/src/energy/tables/ggx_separable_interface_anisotropic.txt",
    ],
    [
        "crates/specula-bsdf/src/energy/tables/beckmann_correlated.txt",
        "crates/specula-bsdf/src/energy/tables/beckmann_correlated_anisotropic.txt",
        "crates/specula-bsdf/src/energy/tables/beckmann_correlated_interface.txt",
        "crates/specula-bsdf/src/energy/tables/beckmann_correlated_interface_anisotropic.txt",
    ],
    [
        "crates/specula-bsdf/src/energy/tables/beckmann_separable.txt",
        "crates/specula-bsdf/src/energy/tables/beckmann_separable_anisotropic.txt",
        "crates/specula-bsdf/src/energy/tables/beckmann_separable_interface.txt",
        "crates/specula-bsdf/src/energy/tables/beckmann_separable_interface_anisotropic.txt",
    ],
];

/// The tables' files.
pub(crate) fn generate(_root: &Path) -> Result<Vec<Generated>> {
    let (ggx, beckmann) = (texts(Ggx::new), texts(Beckmann::new));
    Ok(PATHS
        .into_iter()
        .flatten()
        .zip(ggx.into_iter().chain(beckmann).flatten())
        .map(|(path, digits)| Generated {
            path,
            text: digits.text,
        })
        .collect())
}

/// Compares every so manieth knot of the large tables with quadrature: making them takes minutes.
///
/// A coefficient has a share in several hundred knots, so that few escape. Between the knots the
/// tests compare, and they fail where the small tables are wrong.
///
/// # Errors
/// Where a committed table is not what the generator makes.
pub(crate) fn check(_root: &Path) -> Result<()> {
    const STEP: usize = 53;
    for (name, bound, difference) in [
        (
            "GGX",
            ROUNDING,
            reflection::largest_difference(&Ggx::new, STEP),
        ),
        (
            "GGX interface",
            INTERFACE_ROUNDING,
            interface::largest_difference(&Ggx::new, STEP),
        ),
        (
            "Beckmann",
            ROUNDING,
            reflection::largest_difference(&Beckmann::new, STEP),
        ),
        (
            "Beckmann interface",
            INTERFACE_ROUNDING,
            interface::largest_difference(&Beckmann::new, STEP),
        ),
    ] {
        println!("  {name}: largest difference {difference:.1e}");
        if difference > bound {
            return Err(format!(
                "energy tables of {name} are off by {difference:.1e}, expected at most {bound:.1e}; \
                 run `cargo xtask tables` and commit the result"
            )
            .into());
        }
    }
    Ok(())
}

/// Largest difference that rounding to two digits makes, and limits beside the narrowest alphas.
const ROUNDING: f64 = 1e-3;
/// The same of interfaces, whose edges are sharp for the narrowest alphas.
const INTERFACE_ROUNDING: f64 = 1e-2;

/// The larger difference of the root of a loss, of both maskings.
fn difference(albedo: [f64; 2], loss: impl Fn(Masking) -> f64) -> f64 {
    MASKINGS
        .into_iter()
        .zip(albedo)
        .map(|(masking, albedo)| (loss(masking).sqrt() - root(albedo)).abs())
        .fold(0.0, f64::max)
}

/// The files of a distribution, by masking.
fn texts<N: Tabulated<f64>>(ndf: impl Fn(Alpha<f64>) -> N + Sync) -> [[Digits; 4]; 2] {
    let isotropic = reflection::isotropic(&ndf);
    let anisotropic = reflection::anisotropic(&ndf);
    let interface = interface::isotropic(&ndf);
    let stretched = interface::stretched(&ndf);
    [0, 1].map(|m| {
        let (anisotropic, second) = reflection::with_averages(&anisotropic[m]);
        let (interface, third) = interface::with_averages(&interface[m]);
        let (stretched, fourth) = interface::with_stretched_averages(&stretched[m]);
        let mut small = reflection::isotropic_with_averages(&isotropic[m]);
        for more in [second, third, fourth] {
            small.text += &more.text;
        }
        [small, anisotropic, interface, stretched]
    })
}

/// `each` of the indices below `count`, in their order, by as many threads as there are cores.
fn parallel<R: Send>(count: usize, each: impl Fn(usize) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(count));
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    if i >= count {
                        break;
                    }
                    let result = each(i);
                    if let Ok(mut done) = done.lock() {
                        done.push((i, result));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The place in `[0, 1]` at which a rising function has a value.
fn solve(value: f64, rising: impl Fn(f64) -> f64) -> f64 {
    if value <= 0.0 || value >= 1.0 {
        return value.clamp(0.0, 1.0);
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..120 {
        let middle = 0.5 * (low + high);
        if rising(middle) < value {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// `2 int_0^1 loss(mu) mu dmu`, with `mu = z^3`: narrow lobes lose light at the horizon.
fn average(loss: impl Fn(f64) -> f64) -> f64 {
    gauss_legendre(48)
        .iter()
        .map(|&[z, weight]| 6.0 * z.powi(5) * weight * loss(z * z * z))
        .sum()
}

/// The mean over azimuths of `average(cosine, tangent)`, closer together along both axes.
fn azimuthal_average(mean: impl Fn([f64; 2]) -> f64) -> f64 {
    gauss_legendre(24)
        .iter()
        .map(|&[u, weight]| {
            let turn = std::f64::consts::FRAC_PI_2 * u * u * (3.0 - 2.0 * u);
            let (sine, cosine) = turn.sin_cos();
            6.0 * u * (1.0 - u) * weight * mean([cosine, sine])
        })
        .sum()
}

fn root(albedo: f64) -> f64 {
    (1.0 - albedo).max(0.0).sqrt()
}
