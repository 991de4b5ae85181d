//! Turned vases and statues of metal on a diffuse floor.

use glam::{DVec3, dvec3};
use specula_scene::Scene;
use specula_scene::scene::{MaterialKind, MicrofacetDistribution};

use super::builder::Builder;
use super::lighting::Lighting;

/// A rough metal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Metal {
    /// Chemical symbol.
    pub(crate) symbol: &'static str,
    /// Of its facets' normals.
    pub(crate) distribution: MicrofacetDistribution,
    /// Isotropic.
    pub(crate) alpha: f32,
}

/// The metals of [`vases`], from left to right.
pub(crate) const VASES: [Metal; 3] = [
    ggx("Cu", 0.1),
    Metal {
        symbol: "Al",
        distribution: MicrofacetDistribution::Beckmann,
        alpha: 0.6,
    },
    ggx("Au", 0.5),
];

/// The metals of [`decorative_set`], from left to right.
pub(crate) const SET: [Metal; 5] = [
    ggx("Au", 0.3),
    ggx("Al", 0.8),
    ggx("Cu", 1.0),
    ggx("Ag", 0.5),
    ggx("CuZn", 0.15),
];

const fn ggx(symbol: &'static str, alpha: f32) -> Metal {
    Metal {
        symbol,
        distribution: MicrofacetDistribution::Ggx,
        alpha,
    }
}

/// Three vases, of [`VASES`] from left to right.
pub(crate) fn vases(resolution: [u32; 2], lights: &[Lighting]) -> Scene {
    let mut build = stage(resolution, dvec3(0.0, 0.0, 0.95), 7.4, 20.0);
    for (i, (metal, profile)) in VASES
        .into_iter()
        .zip([&AMPHORA[..], &URN, &BOTTLE])
        .enumerate()
    {
        let material = build.metal(metal.symbol, metal.alpha);
        let x = 1.35 * (i as f64 - 1.0);
        build.lathe(dvec3(x, 0.0, 0.0), &smooth(profile), material);
    }
    lit(build, &VASES, lights)
}

/// Five statues, of [`SET`].
pub(crate) fn decorative_set(resolution: [u32; 2], lights: &[Lighting]) -> Scene {
    let mut build = stage(resolution, dvec3(0.0, 0.2, 0.85), 8.6, 20.0);
    let places = [
        (-2.0, 0.3, &PAWN[..]),
        (-0.95, -0.5, &URN),
        (0.15, 0.6, &KING),
        (1.15, -0.5, &BOTTLE),
        (2.1, 0.4, &AMPHORA),
    ];
    for (metal, (x, y, profile)) in SET.into_iter().zip(places) {
        let material = build.metal(metal.symbol, metal.alpha);
        build.lathe(dvec3(x, y, 0.0), &smooth(profile), material);
    }
    lit(build, &SET, lights)
}

/// A diffuse floor with a wall behind.
fn stage(resolution: [u32; 2], target: DVec3, distance: f64, fov_deg: f64) -> Builder {
    let eye = target + distance * dvec3(0.0, -0.95, 0.31);
    let mut build = Builder::new(resolution, eye, target, fov_deg);
    let floor = build.diffuse("floor", [0.35, 0.33, 0.3]);
    build.quad(
        dvec3(-30.0, -30.0, 0.0),
        dvec3(60.0, 0.0, 0.0),
        dvec3(0.0, 60.0, 0.0),
        floor,
    );
    build
}

/// The finished scene, with the metals' distributions; they follow the floor.
fn lit(build: Builder, metals: &[Metal], lights: &[Lighting]) -> Scene {
    let mut scene = build.finish();
    for (material, metal) in scene.materials.iter_mut().skip(1).zip(metals) {
        if let MaterialKind::Conductor { roughness, .. } = &mut material.kind {
            roughness.distribution = metal.distribution;
        }
    }
    for light in lights {
        light.add_to(&mut scene);
    }
    scene
}

/// A curve through the points (Catmull and Rom 1974), eight parts from point to point.
fn smooth(profile: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const PARTS: u32 = 8;
    let point = |i: usize| profile[i.min(profile.len() - 1)];
    let mut curve = Vec::new();
    for i in 0..profile.len() - 1 {
        let [a, b, c, d] = [
            point(i.saturating_sub(1)),
            point(i),
            point(i + 1),
            point(i + 2),
        ];
        for part in 0..PARTS {
            let t = f64::from(part) / f64::from(PARTS);
            let along = |k: usize| {
                let (p, q, r, s) = (a[k], b[k], c[k], d[k]);
                q + 0.5
                    * t
                    * (r - p + t * (2.0 * p - 5.0 * q + 4.0 * r - s + t * (3.0 * (q - r) + s - p)))
            };
            curve.push([along(0).max(0.0), along(1).max(0.0)]);
        }
    }
    curve.push(point(profile.len() - 1));
    curve
}

/// `(distance from the axis, height)`, from the foot.
const AMPHORA: [[f64; 2]; 10] = [
    [0.001, 0.02],
    [0.26, 0.0],
    [0.28, 0.06],
    [0.14, 0.2],
    [0.3, 0.55],
    [0.46, 1.0],
    [0.4, 1.35],
    [0.17, 1.6],
    [0.16, 1.8],
    [0.28, 1.92],
];
const URN: [[f64; 2]; 9] = [
    [0.001, 0.02],
    [0.32, 0.0],
    [0.34, 0.08],
    [0.2, 0.18],
    [0.48, 0.5],
    [0.55, 0.85],
    [0.42, 1.15],
    [0.36, 1.25],
    [0.46, 1.36],
];
const BOTTLE: [[f64; 2]; 9] = [
    [0.001, 0.02],
    [0.36, 0.0],
    [0.44, 0.12],
    [0.46, 0.5],
    [0.36, 0.85],
    [0.16, 1.15],
    [0.13, 1.5],
    [0.14, 1.65],
    [0.2, 1.74],
];
const PAWN: [[f64; 2]; 11] = [
    [0.001, 0.02],
    [0.38, 0.0],
    [0.4, 0.12],
    [0.26, 0.22],
    [0.17, 0.5],
    [0.15, 0.85],
    [0.3, 0.92],
    [0.18, 1.0],
    [0.29, 1.22],
    [0.2, 1.43],
    [0.001, 1.5],
];
const KING: [[f64; 2]; 13] = [
    [0.001, 0.02],
    [0.44, 0.0],
    [0.46, 0.14],
    [0.3, 0.26],
    [0.2, 0.7],
    [0.18, 1.15],
    [0.34, 1.24],
    [0.2, 1.32],
    [0.26, 1.5],
    [0.36, 1.75],
    [0.14, 1.84],
    [0.12, 1.98],
    [0.001, 2.04],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_valid() {
        let lights = [
            Lighting::Studio(1.0),
            Lighting::Point(dvec3(1.0, -2.0, 3.0), 5.0),
        ];
        for scene in [vases([32, 16], &lights), decorative_set([32, 16], &lights)] {
            scene.validate().unwrap();
            assert_eq!(scene.lights.len(), 2);
        }
    }
}
