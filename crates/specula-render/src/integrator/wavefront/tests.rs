//! Paths in wavefronts against the same paths alone.

mod varied;

use super::*;
use crate::film::VertexCounts;
use crate::options::RenderOptions;
use specula_bsdf::bsdf::Lobe;
use specula_scene::Energy;
use specula_scene::Scene;
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
            ["coateddiffuse 0.6 alpha 0.2", "coateddiffuse 0.7 alpha 0"],
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

/// Samples of paths in wavefronts, and of the same paths followed one by one; of both, the rays and the vertices.
struct BothWays {
    prepared: PreparedScene,
    samples: Vec<[PixelSample; 2]>,
    rays: [u64; 2],
    vertices: [VertexCounts; 2],
}

/// The built-in scene with the materials of a case.
fn scene_of(case: &Case) -> Scene {
    let mut scene = specula_scene::builtin::orbs();
    for (i, material) in scene.materials.iter_mut().enumerate() {
        material.kind = case.materials[i % 2];
    }
    scene
}

fn both_ways(scene: &Scene, options: &RenderOptions) -> BothWays {
    let options = RenderOptions {
        resolution: Some(SIZE),
        ..options.clone()
    };
    let prepared = PreparedScene::new(scene, &options).unwrap();
    let tracer = PathTracer::new(&prepared, &options);
    let sample = |i: u32| {
        let pixel = [i % SIZE[0], i / SIZE[0]];
        (pixel, Sampler::new(pixel, 3, 5))
    };
    let (mut wavefront, mut alone) = (Wavefront::new(), Wavefront::new());
    let (mut samples, mut tallies) = (Vec::new(), [Tally::default(); 2]);
    for first in (0..SIZE[0] * SIZE[1]).step_by(Wavefront::SIZE) {
        let indices = first..first + id(Wavefront::SIZE);
        tracer.begin(&mut wavefront, indices.clone().map(sample));
        tracer.follow_all(&mut wavefront);
        tallies[0] = tallies[0].and(wavefront.take_tally());
        for (k, i) in indices.enumerate() {
            tracer.begin(&mut alone, std::iter::once(sample(i)));
            let mut path = alone.first_path();
            tracer.follow(&mut path);
            tallies[1] = tallies[1].and(alone.paths.store(0, &path));
            samples.push([
                tracer.contribution(&wavefront, k).0,
                tracer.contribution(&alone, 0).0,
            ]);
        }
    }
    BothWays {
        prepared,
        samples,
        rays: tallies.map(|tally| tally.rays),
        vertices: tallies.map(|tally| tally.vertices),
    }
}

/// The quotient of the means.
fn ratio(samples: &[[PixelSample; 2]]) -> f64 {
    let mean = |way: usize| -> f64 {
        let means = samples.iter().map(|pair| pair[way].colour.mean());
        means.map(f64::from).sum()
    };
    mean(0) / mean(1)
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
                energy: case.energy,
                ..RenderOptions::default()
            };
            let what = format!("{}, regularized: {regularize}", case.name);
            let BothWays {
                prepared,
                samples,
                rays,
                ..
            } = both_ways(&scene_of(&case), &options);
            assert!(rays[0] > 0);
            let count = 0..prepared.materials.count();
            let mut lobes = count
                .filter_map(|m| prepared.materials.plain(id(m)))
                .flatten();
            assert!(lobes.any(|plain| (case.is_meant)(&plain.lobe)), "{what}");
            let apart = samples.iter().filter(|pair| are_apart(pair)).count();
            assert!(apart <= case.most_apart, "{what}: {apart}");
            let ratio = ratio(&samples);
            assert!((ratio - 1.0).abs() < 2e-3, "{what}: {ratio}");
        }
    }
}

/// Plain metal and diffuse surfaces beside what lets rays pass: cut-outs, a boundary of an absorbing medium that is no
/// surface, glass that absorbs, lights that the camera does not see.
const PASSABLE: &str = "LookAt 0 -4 1.6  0 0 0.6  0 0 1
Camera \"perspective\" \"float fov\" 45
Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 48
Integrator \"volpath\" \"integer maxdepth\" 6
WorldBegin
MakeNamedMedium \"red\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.1 1 2] \"rgb sigma_s\" [0 0 0]
LightSource \"infinite\" \"rgb L\" [0.2 0.3 0.4]
AttributeBegin
AreaLightSource \"diffuse\" \"rgb L\" [8 7 6]
Translate 0 0 3
Shape \"sphere\" \"float radius\" 0.4
AttributeEnd
Material \"diffuse\" \"rgb reflectance\" [0.6 0.5 0.4]
Shape \"bilinearmesh\" \"point3 P\" [-4 -4 0  4 -4 0  -4 4 0  4 4 0]
Material \"conductor\" \"float roughness\" 0.3
AttributeBegin
Translate -0.9 0 0.6
Shape \"sphere\" \"float radius\" 0.6
AttributeEnd
AttributeBegin
Translate 0 -1.5 1
Rotate 70 1 0 0
Shape \"disk\" \"float radius\" 0.8 \"float alpha\" 0.5
AttributeEnd
AttributeBegin
MediumInterface \"red\" \"\"
Material \"dielectric\" \"float eta\" 1.5
Translate 0.8 0 0.5
Shape \"sphere\" \"float radius\" 0.5
AttributeEnd
AttributeBegin
MediumInterface \"red\" \"\"
Material \"interface\"
Translate 0 0.6 1.4
Shape \"sphere\" \"float radius\" 0.5
AttributeEnd
";

#[test]
fn paths_in_wavefronts_pass_what_paths_alone_pass() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.pbrt");
    std::fs::write(&file, PASSABLE).unwrap();
    let mut scene = specula_scene::load(&file).unwrap().scene;
    for hides in [false, true] {
        scene.settings.hide_emitters = hides;
        let options = RenderOptions::from_scene(&scene);
        let both = both_ways(&scene, &options);
        assert!(both.prepared.geometry.has_passable && both.prepared.materials.has_boundaries());
        let batched = both.prepared.geometry.shapes.iter();
        let batched = (0..)
            .zip(batched)
            .filter(|(shape, _)| both.prepared.batch_material(*shape, false).is_some());
        assert!(batched.count() >= 3, "floor, metal, veil");
        let apart = both.samples.iter().filter(|pair| are_apart(pair)).count();
        assert!(apart <= 12, "hides: {hides}: {apart}");
        assert!((ratio(&both.samples) - 1.0).abs() < 2e-3, "hides: {hides}");
        let [together, alone] = both.rays;
        assert!(
            together.abs_diff(alone) * 1000 < alone,
            "{together} rays, {alone}"
        );
    }
}
