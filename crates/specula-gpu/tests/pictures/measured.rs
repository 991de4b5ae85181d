//! Measured materials on the GPU beside the processor.

use specula_bsdf::Alpha;
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::rgb;
use specula_bsdf::measured::{Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_render::Strategy;
use specula_scene::measured::{MeasuredBrdf, to_bytes};
use specula_scene::scene::{MaterialKind, MeasuredId};

use super::{ROOM, RenderOptions, SKY, check, orbs, scene};

/// The file of a metal.
fn file([x, y]: [f64; 2], symmetry: Symmetry) -> MeasuredBrdf {
    let ndf = Ggx::new(Alpha::clamped(x, y));
    let gold = Reflectance::Conductor(Conductor {
        eta: rgb(0.14, 0.37, 1.44),
        k: rgb(3.98, 2.38, 1.6),
    });
    let size = Resolution {
        theta: 8,
        phi: 5,
        normals: [32, 16],
        colours: 12,
    };
    let lobe = RoughConductor::new(ndf, gold);
    let bytes = to_bytes(&tabulate(&ndf, &lobe, symmetry, size), "gold");
    MeasuredBrdf::from_bytes("gold.bsdf", &bytes).unwrap()
}

#[test]
fn measured_materials() {
    let placeholders = orbs(["Material \"conductor\"", "Material \"diffuse\""]);
    let mut scene = scene(&format!("{ROOM}{SKY}{placeholders}"));
    let last = scene.shapes.len() - 2;
    for (file, shape) in scene.shapes[last..].iter().enumerate() {
        let kind = MaterialKind::Measured(MeasuredId(file));
        scene.materials[shape.material.0].kind = kind;
    }
    scene.measured = vec![
        file([0.3, 0.3], Symmetry::Isotropic),
        file([0.15, 0.5], Symmetry::QuarterTurn),
    ];
    check("measured", &scene, |o| o);
    let by_lobe = |options| RenderOptions {
        strategy: Strategy::BsdfOnly,
        ..options
    };
    check("measured, by the lobe alone", &scene, by_lobe);
}
