//! Measured materials in pictures, beside the metal that their tables are of.

mod common;

use common::*;
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::measured::{Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Rgb};
use specula_render::{MaterialShader, PreparedScene, RenderOptions, Strategy};
use specula_scene::measured::{MeasuredBrdf, to_bytes};
use specula_scene::scene::*;

const ETA: [f32; 3] = [0.2, 0.9, 1.4];
const K: [f32; 3] = [3.9, 2.4, 1.9];
/// Pixels along a side.
const SIZE: u32 = 32;

fn tables_of(alpha: [f64; 2], symmetry: Symmetry) -> MeasuredBrdf {
    let ndf = Ggx::new(Alpha::clamped(alpha[0], alpha[1]));
    let colour = |c: [f32; 3]| Rgb::from(c.map(f64::from));
    let metal = Reflectance::Conductor(Conductor {
        eta: colour(ETA),
        k: colour(K),
    });
    let size = Resolution {
        theta: 24,
        phi: 13,
        normals: [96, 48],
        colours: 24,
    };
    let lobe = RoughConductor::new(ndf, metal);
    let bytes = to_bytes(&tabulate(&ndf, &lobe, symmetry, size), "test");
    MeasuredBrdf::from_bytes("test.bsdf", &bytes).expect("the tables are sound")
}

fn metal([u, v]: [f32; 2]) -> MaterialKind {
    let colour = |c: [f32; 3]| ColourParam::Value(Rgb::from(c));
    MaterialKind::Conductor {
        fresnel: ConductorFresnel::Index {
            eta: colour(ETA),
            k: colour(K),
        },
        roughness: Roughness {
            u: FloatParam::Value(u),
            v: FloatParam::Value(v),
            ..Roughness::smooth()
        },
        tint: ColourParam::WHITE,
    }
}

/// A sphere in a sky that is brighter on one side.
fn scene_of(kind: MaterialKind, measured: Vec<MeasuredBrdf>) -> Scene {
    let mut scene = empty(look([0.0, -4.0, 2.0], [0.0; 3], 30.0), SIZE);
    let id = material(&mut scene, kind);
    scene.measured = measured;
    scene.shapes.push(sphere(1.0, [0.0; 3], id));
    scene.lights.push(constant_sky(0.5));
    scene.lights.push(Light::Distant {
        irradiance: Rgb {
            r: 1.0,
            g: 2.0,
            b: 3.0,
        },
        to_light: [0.6, -0.64, 0.48],
        half_angle_deg: 0.0,
    });
    scene
}

/// Means of tiles of 4 x 4, by channel.
fn tiles(scene: &Scene, strategy: Strategy) -> Vec<f64> {
    let picture = render(scene, 128, 2, strategy);
    let mut sums = vec![0.0; 3 * 8 * 8];
    for (i, c) in picture.colour.iter().enumerate() {
        let (x, y) = (i % SIZE as usize / 4, i / SIZE as usize / 4);
        for (channel, v) in c.to_array().into_iter().enumerate() {
            sums[3 * (8 * y + x) + channel] += f64::from(v) / 16.0;
        }
    }
    sums
}

#[test]
fn tables_of_a_metal_look_like_it() {
    for (alpha, symmetry) in [
        ([0.3, 0.3], Symmetry::Isotropic),
        ([0.25, 0.5], Symmetry::Turn),
        ([0.25, 0.5], Symmetry::QuarterTurn),
    ] {
        #[expect(clippy::cast_possible_truncation, reason = "exact")]
        let expected = tiles(
            &scene_of(metal(alpha.map(|a| a as f32)), Vec::new()),
            Strategy::Mis,
        );
        let kind = MaterialKind::Measured(MeasuredId(0));
        let scene = scene_of(kind, vec![tables_of(alpha, symmetry)]);
        let found = tiles(&scene, Strategy::Mis);
        let most = expected.iter().copied().fold(0.0, f64::max);
        for (i, (f, e)) in found.iter().zip(&expected).enumerate() {
            assert!(
                (f - e).abs() < 0.05 * e + 0.02 * most,
                "{symmetry:?}, tile {i}: {f} {e}"
            );
        }
        // The sampler and the lights' alone agree on it.
        let by_lobe = tiles(&scene, Strategy::BsdfOnly);
        for (i, (f, e)) in by_lobe.iter().zip(&found).enumerate() {
            assert!(
                (f - e).abs() < 0.05 * e + 0.02 * most,
                "{symmetry:?}, tile {i}: {f} {e}"
            );
        }
    }
}

#[test]
fn shaders_are_given_each_file_once() {
    let kind = MaterialKind::Measured(MeasuredId(0));
    let mut scene = scene_of(kind, vec![tables_of([0.3, 0.3], Symmetry::Isotropic)]);
    let words = |scene: &Scene| {
        let prepared = PreparedScene::new(scene, &RenderOptions::default()).unwrap();
        assert_eq!(prepared.lobe(0, true), None);
        let flat = prepared.flatten();
        assert_eq!(flat.missing, Vec::<String>::new());
        assert!(flat.shaders.contains(&MaterialShader::Measured));
        flat.words
    };
    let packed: Vec<u32> = scene.measured[0]
        .lobe()
        .packed()
        .iter()
        .map(|x| x.to_bits())
        .collect();
    let times = |words: &[u32]| words.windows(packed.len()).filter(|w| *w == packed).count();
    let once = words(&scene);
    assert_eq!(times(&once), 1);
    material(&mut scene, kind);
    let twice = words(&scene);
    assert_eq!(times(&twice), 1);
    assert!(twice.len() < once.len() + 100, "a second material is small");
    scene
        .measured
        .push(tables_of([0.4, 0.4], Symmetry::Isotropic));
    material(&mut scene, MaterialKind::Measured(MeasuredId(1)));
    assert!(words(&scene).len() > twice.len() + packed.len());
}
