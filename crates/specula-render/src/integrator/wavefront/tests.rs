//! Paths in wavefronts against the same paths alone.

use super::*;
use crate::options::RenderOptions;
use specula_bsdf::bsdf::Lobe;
use specula_scene::Energy;
use specula_scene::scene::{FloatParam, MaterialKind};

const SIZE: [u32; 2] = [64, 48];

/// A lobe that batches know: how a scene gets it, and how far samples may differ.
struct Case {
    name: &'static str,
    /// Of all surfaces, alternately.
    materials: [MaterialKind; 2],
    energy: Energy,
    /// Whether a lobe is the one that is meant.
    is_meant: fn(&Lobe<f32>) -> bool,
    /// Largest number of samples, among 3072, that differ by more than rounding does.
    most_apart: usize,
}

fn parsed(text: &str) -> MaterialKind {
    specula_scene::material_text::parse_material(text).unwrap()
}

fn rough_diffuse() -> MaterialKind {
    match parsed("diffuse 0.6") {
        MaterialKind::Diffuse { reflectance, .. } => MaterialKind::Diffuse {
            reflectance,
            roughness: FloatParam::Value(0.7),
        },
        other => other,
    }
}

/// Every lobe that batches know.
fn cases() -> Vec<Case> {
    let case = |name, texts: [&str; 2], is_meant, most_apart| Case {
        name,
        materials: texts.map(parsed),
        energy: Energy::None,
        is_meant,
        most_apart,
    };
    let metal = ["conductor Au alpha 0.3", "conductor Cu alpha 0.05 0.4"];
    vec![
        case(
            "Lambert",
            ["diffuse 0.5", "diffuse 0.8"],
            |l| matches!(l, Lobe::Lambert(_)),
            22,
        ),
        Case {
            materials: [rough_diffuse(), parsed("diffuse 0.5")],
            ..case(
                "Eon",
                ["diffuse", "diffuse"],
                |l| matches!(l, Lobe::Eon(_)),
                22,
            )
        },
        case(
            "SmoothConductor",
            ["conductor Au alpha 0", "diffuse 0.5"],
            |l| matches!(l, Lobe::SmoothConductor(_)),
            32,
        ),
        case(
            "RoughConductor",
            metal,
            |l| matches!(l, Lobe::RoughConductor(_)),
            32,
        ),
        Case {
            energy: Energy::DEFAULT,
            ..case(
                "Compensated",
                metal,
                |l| matches!(l, Lobe::Compensated(_)),
                3,
            )
        },
        Case {
            energy: "multibounce".parse().unwrap(),
            ..case(
                "MultibounceConductor",
                metal,
                |l| matches!(l, Lobe::MultibounceConductor(_)),
                30,
            )
        },
        case(
            "CoatedDiffuse",
            ["coateddiffuse 0.6 alpha 0.2", "diffuse 0.5"],
            |l| matches!(l, Lobe::CoatedDiffuse(_)),
            3,
        ),
        case(
            "SmoothDielectric",
            ["dielectric 1.5", "diffuse 0.7"],
            |l| matches!(l, Lobe::SmoothDielectric(_)),
            3,
        ),
        case(
            "RoughDielectric",
            ["dielectric 1.5 alpha 0.2", "diffuse 0.7"],
            |l| matches!(l, Lobe::RoughDielectric(_)),
            6,
        ),
    ]
}

/// Samples of paths in wavefronts, and of the same paths followed one by one.
fn both_ways(case: &Case, options: &RenderOptions) -> (PreparedScene, Vec<[PixelSample; 2]>) {
    let mut scene = specula_scene::builtin::orbs();
    for (i, material) in scene.materials.iter_mut().enumerate() {
        material.kind = case.materials[i % 2];
    }
    let options = RenderOptions {
        resolution: Some(SIZE),
        energy: case.energy,
        ..options.clone()
    };
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let tracer = PathTracer::new(&prepared, &options);
    let sample = |i: u32| {
        let pixel = [i % SIZE[0], i / SIZE[0]];
        (pixel, Sampler::new(pixel, 3, 5))
    };
    let (mut wavefront, mut alone) = (Wavefront::new(), Wavefront::new());
    let mut samples = Vec::new();
    for first in (0..SIZE[0] * SIZE[1]).step_by(Wavefront::SIZE) {
        let indices = first..first + id(Wavefront::SIZE);
        tracer.begin(&mut wavefront, indices.clone().map(sample));
        tracer.follow_all(&mut wavefront);
        assert!(wavefront.take_tally().rays > 0);
        for (k, i) in indices.enumerate() {
            tracer.begin(&mut alone, std::iter::once(sample(i)));
            let mut path = alone.first_path();
            tracer.follow(&mut path);
            alone.paths.store(0, &path);
            samples.push([
                tracer.contribution(&wavefront, k).0,
                tracer.contribution(&alone, 0).0,
            ]);
        }
    }
    (prepared, samples)
}

/// Whether two samples of the same path differ by more than rounding does.
fn are_apart([a, b]: &[PixelSample; 2]) -> bool {
    let scale = b.colour.max_channel().max(1e-3);
    let colour = (a.colour - b.colour).map(f32::abs).max_channel();
    colour > 1e-3 * scale
        || (a.normal - b.normal).length() > 1e-5
        || a.albedo != b.albedo
        || a.depth.is_some() != b.depth.is_some()
}

/// Vector loops round otherwise than scalar code. Rounding grows along a path, and now and then sends one past an
/// edge: at most 0.7 % of samples were apart (AVX2), all others agreed to 2e-4.
#[test]
fn paths_in_wavefronts_are_paths_alone() {
    for case in cases() {
        for (clamp, regularize) in [(None, false), (Some(0.3), true)] {
            let options = RenderOptions {
                max_depth: 6,
                clamp,
                regularize,
                ..RenderOptions::default()
            };
            let what = format!("{}, regularized: {regularize}", case.name);
            let (prepared, samples) = both_ways(&case, &options);
            let count = 0..prepared.materials.count();
            let mut lobes = count
                .filter_map(|m| prepared.materials.plain(id(m)))
                .flatten();
            assert!(lobes.any(|plain| (case.is_meant)(&plain.lobe)), "{what}");
            let apart = samples.iter().filter(|pair| are_apart(pair)).count();
            assert!(apart <= case.most_apart, "{what}: {apart}");
            let mean = |way: usize| -> f64 {
                let means = samples.iter().map(|pair| pair[way].colour.mean());
                means.map(f64::from).sum()
            };
            let ratio = mean(0) / mean(1);
            assert!((ratio - 1.0).abs() < 2e-3, "{what}: {ratio}");
        }
    }
}
