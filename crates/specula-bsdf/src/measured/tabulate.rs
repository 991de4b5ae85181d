//! Tables of a lobe that is known in closed form: synthetic measurements.
//!
//! ```text
//! rgb(u) = f cos(theta_i) 4 sigma(wo) / D(wm)       wm by the warp of visible normals
//! ```

use alloc::vec::Vec;
use core::f64::consts::{FRAC_PI_2, PI, TAU};

use super::warp::{Slices, Warp};
use super::{MeasuredGrid, MeasuredTables};
use crate::bsdf::{Bsdf, Transport};
use crate::math::{Real, Rgb, Vec3, vec3};
use crate::ndf::Ndf;

/// Which views a table has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Symmetry {
    /// The surface looks the same however it is turned: one azimuth.
    #[default]
    Isotropic,
    /// Azimuths of a turn.
    Turn,
    /// Of half a turn: the surface looks the same after one.
    HalfTurn,
    /// Of a quarter of a turn: mirrored along x and along y it looks the same.
    QuarterTurn,
}

/// Sizes of tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Polar angles of views, at least 2.
    pub theta: usize,
    /// Azimuths of views, at least 2; isotropic tables have one.
    pub phi: usize,
    /// Polar angles and azimuths of normals, at least 2 each.
    pub normals: [usize; 2],
    /// Nodes of colours along each axis, at least 2.
    pub colours: usize,
}

impl Default for Resolution {
    /// About that of the RGL database.
    fn default() -> Self {
        Self {
            theta: 16,
            phi: 16,
            normals: [64, 64],
            colours: 32,
        }
    }
}

/// Tables of a lobe of microfacets.
///
/// * `ndf`: its distribution; D is above 0 everywhere, as GGX's is.
/// * `lobe`: black below the horizon; isotropic where `symmetry` says so.
/// * `size`: smaller sizes than allowed are raised.
///
/// Light of the lobe at a polar angle beyond the last cell's middle is interpolated: the tables are the
/// lobe up to their resolution.
pub fn tabulate(
    ndf: &impl Ndf<f64>,
    lobe: &impl Bsdf<f64>,
    symmetry: Symmetry,
    size: Resolution,
) -> MeasuredTables {
    let [nodes_theta, nodes_phi] = size.normals.map(|n| n.max(2));
    let colours = size.colours.max(2);
    let theta_i = steps(size.theta.max(2), 0.0, FRAC_PI_2);
    let azimuths = |end| steps(size.phi.max(3), -PI, end);
    let phi_i = match symmetry {
        Symmetry::Isotropic => alloc::vec![0.0],
        Symmetry::Turn => azimuths(PI),
        Symmetry::HalfTurn => azimuths(0.0),
        Symmetry::QuarterTurn => azimuths(-FRAC_PI_2),
    };
    let normals = [nodes_theta, nodes_phi];
    let views: Vec<Vec3<f64>> = (phi_i.iter())
        .flat_map(|&phi| theta_i.iter().map(move |&theta| view(theta, phi)))
        .collect();
    // Normals of isotropic tables are relative to the view, whose azimuth is 0.
    let ndf_values = over(normals, |u| single(ndf.d(normal(u))));
    let sigma = over(normals, |[x, y]| {
        single(ndf.projected_area(view(x * x * FRAC_PI_2, (2.0 * y - 1.0) * PI)))
    });
    let visible = |wo: Vec3<f64>| {
        over(normals, move |u| {
            let wm = normal(u);
            let sine = Real::sqrt((1.0 - wm.z * wm.z).max(0.0));
            single(ndf.d_visible(wo, wm) * u[0] * sine)
        })
    };
    let vndf: Vec<f32> = views.iter().flat_map(|&wo| visible(wo)).collect();
    let warp = Warp::<f64>::new(normals, &vndf);
    let (mut luminance, mut rgb) = (Vec::new(), Vec::new());
    for (slice, &wo) in views.iter().enumerate() {
        let at = Slices::only(slice);
        let values: Vec<Rgb<f64>> = nodes([colours; 2])
            .map(|u| {
                let (u_m, _) = warp.sample(&at, u);
                let wm = normal(u_m);
                let wi = wm * (2.0 * wo.dot(wm)) - wo;
                let f_cos = lobe.eval(wo, wi.normalize(), Transport::Radiance);
                f_cos * (4.0 * ndf.projected_area(wo) / ndf.d(wm))
            })
            .collect();
        luminance.extend(values.iter().map(|c| single(c.luminance())));
        rgb.extend(values.iter().map(|c| single(c.r)));
        rgb.extend(values.iter().map(|c| single(c.g)));
        rgb.extend(values.iter().map(|c| single(c.b)));
    }
    let grid = |size, values| MeasuredGrid { size, values };
    MeasuredTables {
        theta_i: theta_i.iter().copied().map(single).collect(),
        phi_i: phi_i.iter().copied().map(single).collect(),
        ndf: grid(normals, ndf_values),
        sigma: grid(normals, sigma),
        vndf: grid(normals, vndf),
        luminance: grid([colours; 2], luminance),
        rgb,
        jacobian: true,
    }
}

/// A view; one at the horizon is a little above it.
fn view(theta: f64, phi: f64) -> Vec3<f64> {
    spherical(theta.min(FRAC_PI_2 - 1e-3), phi)
}

fn normal([x, y]: [f64; 2]) -> Vec3<f64> {
    let wm = spherical(x * x * FRAC_PI_2, y * TAU - PI);
    vec3(wm.x, wm.y, wm.z.max(1e-9))
}

fn spherical(theta: f64, phi: f64) -> Vec3<f64> {
    let sine = Real::sin(theta);
    vec3(
        sine * Real::cos(phi),
        sine * Real::sin(phi),
        Real::cos(theta),
    )
}

#[allow(clippy::cast_precision_loss, reason = "small counts")]
fn steps(count: usize, from: f64, to: f64) -> Vec<f64> {
    let last = (count - 1) as f64;
    (0..count)
        .map(|i| from + (to - from) * i as f64 / last)
        .collect()
}

#[allow(clippy::cast_precision_loss, reason = "small counts")]
fn nodes([w, h]: [usize; 2]) -> impl Iterator<Item = [f64; 2]> {
    (0..w * h).map(move |i| {
        [
            (i % w) as f64 / (w - 1) as f64,
            (i / w) as f64 / (h - 1) as f64,
        ]
    })
}

fn over(size: [usize; 2], value: impl Fn([f64; 2]) -> f32) -> Vec<f32> {
    nodes(size).map(value).collect()
}

#[allow(clippy::cast_possible_truncation, reason = "the tables are f32")]
fn single(v: f64) -> f32 {
    v.clamp(f32::MIN.into(), f32::MAX.into()) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Alpha;
    use crate::bsdf::RoughConductor;
    use crate::fresnel::Reflectance;
    use crate::math::Stream;
    use crate::measured::Measured;
    use crate::ndf::Ggx;

    /// Largest difference from the lobe itself, by its luminance, over the largest value of each view.
    fn error(alpha: (f64, f64), symmetry: Symmetry) -> f64 {
        let ndf = Ggx::new(Alpha::clamped(alpha.0, alpha.1));
        let lobe = RoughConductor::new(ndf, Reflectance::Constant(Rgb::splat(0.8)));
        let size = Resolution {
            theta: 32,
            phi: 24,
            normals: [128, 64],
            colours: 32,
        };
        let tables = tabulate(&ndf, &lobe, symmetry, size);
        let measured = Measured::<f64>::new(&tables).unwrap();
        let mut stream = Stream::new(11);
        let mut worst = 0.0_f64;
        for _ in 0..40 {
            let wo = view(1.3 * stream.next::<f64>(), TAU * stream.next::<f64>());
            let mut pairs = Vec::new();
            for _ in 0..50 {
                let u = [stream.next(), stream.next(), stream.next()];
                let Some(s) = lobe.sample(wo, u, Transport::Radiance) else {
                    continue;
                };
                let expected = lobe.eval(wo, s.wi, Transport::Radiance).g;
                let found = measured.eval(wo, s.wi, Transport::Radiance).g;
                pairs.push([expected, (found - expected).abs()]);
            }
            let most = pairs.iter().map(|p| p[0]).fold(0.0, f64::max);
            worst = worst.max(pairs.iter().map(|p| p[1] / most).fold(0.0, f64::max));
        }
        worst
    }

    #[test]
    fn the_tables_of_ggx_are_ggx() {
        for alpha in [0.15, 0.4] {
            let found = error((alpha, alpha), Symmetry::Isotropic);
            assert!(found < 0.08, "{alpha}: {found}");
        }
        // The same count of azimuths is coarser over a turn: 16 degrees apart, 8, and 4.
        for (symmetry, most) in [
            (Symmetry::Turn, 0.2),
            (Symmetry::HalfTurn, 0.15),
            (Symmetry::QuarterTurn, 0.15),
        ] {
            let found = error((0.2, 0.5), symmetry);
            assert!(found < most, "{symmetry:?}: {found}");
        }
    }
}
