//! Lights: samples and densities of shaders beside those of the renderer on the CPU, at random points of scenes
//! with every kind of light. Faults planted in the shaders are noticed.
//!
//! Where no GPU is found, the tests say that they are skipped; `SPECULA_GPU=require` makes that a
//! failure.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a suite says how much it checked, and its helpers fail loudly"
)]

#[path = "../common/mod.rs"]
mod common;
mod scenes;

use common::gpu;
use scenes::scenes;
use specula_bsdf::math::{Stream, warp};
use specula_gpu::{AdapterKind, ComputeKernel, Gpu, Tree};
use specula_render::{FlatScene, LitPoint, PreparedScene, RenderOptions};
use specula_scene::Scene;

/// Receivers of each scene.
const CASES: u32 = 16_384;
/// Share of answers that may differ where rounding decides between two lights, or at edges.
const STRAYS: f64 = 3e-4;
/// The same on a real GPU, whose roots and quotients are approximate: rectangles of small solid angles magnify their
/// errors (1.5 % on an NVIDIA H100).
const STRAYS_OF_REAL_GPUS: f64 = 0.05;

fn strays(gpu: &Gpu) -> f64 {
    match gpu.adapter.kind {
        AdapterKind::Software => STRAYS,
        _ => STRAYS_OF_REAL_GPUS,
    }
}
/// Words of a case: point, normal (zero: none), four random numbers, a light, a target and its normal, a
/// direction, weights of the target's corners.
const CASE: usize = 22;
/// Words of an answer: the sample (20), the density of the target, the share of lights at infinity, and
/// what arrives from up to three of those.
const ANSWER: usize = 34;
/// Most lights at infinity that are asked.
const FAR: usize = 3;

/// The modules in the order of their imports.
const MODULES: &[(&str, &str)] = &[
    ("world", include_str!("../../wgsl/world.wgsl")),
    ("sequence", include_str!("../../wgsl/sequence.wgsl")),
    ("ray", include_str!("../../wgsl/ray.wgsl")),
    ("angles", include_str!("../../wgsl/angles.wgsl")),
    ("surface", include_str!("../../wgsl/surface.wgsl")),
    (
        "texture_coordinates",
        include_str!("../../wgsl/texture_coordinates.wgsl"),
    ),
    (
        "texture_mapping",
        include_str!("../../wgsl/texture_mapping.wgsl"),
    ),
    (
        "texture_noise",
        include_str!("../../wgsl/texture_noise.wgsl"),
    ),
    (
        "texture_raster",
        include_str!("../../wgsl/texture_raster.wgsl"),
    ),
    (
        "texture_filter",
        include_str!("../../wgsl/texture_filter.wgsl"),
    ),
    (
        "texture_graph",
        include_str!("../../wgsl/texture_graph.wgsl"),
    ),
    ("octahedral", include_str!("../../wgsl/octahedral.wgsl")),
    (
        "parallelogram",
        include_str!("../../wgsl/parallelogram.wgsl"),
    ),
    ("area", include_str!("../../wgsl/area.wgsl")),
    ("piecewise", include_str!("../../wgsl/piecewise.wgsl")),
    ("textured", include_str!("../../wgsl/textured.wgsl")),
    ("spot", include_str!("../../wgsl/spot.wgsl")),
    ("projected", include_str!("../../wgsl/projected.wgsl")),
    ("sun", include_str!("../../wgsl/sun.wgsl")),
    ("delta", include_str!("../../wgsl/delta.wgsl")),
    ("environment", include_str!("../../wgsl/environment.wgsl")),
    ("light_node", include_str!("../../wgsl/light_node.wgsl")),
    ("light_tree", include_str!("../../wgsl/light_tree.wgsl")),
    ("lights", include_str!("../../wgsl/lights.wgsl")),
];

const ENTRY: &str = "
@group(0) @binding(0) var<storage, read> cases: array<f32>;
@group(0) @binding(4) var<storage, read_write> answers: array<f32>;

fn case_vector(at: u32) -> vec3f {
    return vec3f(cases[at], cases[at + 1u], cases[at + 2u]);
}

fn answer_vector(at: u32, v: vec3f) {
    answers[at] = v.x;
    answers[at + 1u] = v.y;
    answers[at + 2u] = v.z;
}

@compute @workgroup_size(64)
fn answer_all(@builtin(global_invocation_id) id: vec3u) {
    let at = 22u * id.x;
    let to = 34u * id.x;
    let receiver = Receiver(case_vector(at), case_vector(at + 3u));
    let u = vec4f(cases[at + 6u], cases[at + 7u], cases[at + 8u], cases[at + 9u]);
    let sampled = lights_sample(receiver, u);
    answers[to] = f32(sampled.valid);
    answer_vector(to + 1u, sampled.wi);
    answers[to + 4u] = sampled.pdf;
    answer_vector(to + 5u, sampled.radiance);
    answers[to + 8u] = f32(sampled.delta);
    answer_vector(to + 9u, sampled.target_position);
    answer_vector(to + 12u, sampled.target_error);
    answer_vector(to + 15u, sampled.target_normal);
    answers[to + 18u] = f32(sampled.from_infinity);
    let light = bitcast<u32>(cases[at + 10u]);
    let weights = vec2f(cases[at + 20u], cases[at + 21u]);
    answers[to + 20u] = lights_pdf_of_surface(
        receiver, light, case_vector(at + 11u), case_vector(at + 14u), weights);
    answers[to + 21u] = lights_share_from_infinity(receiver);
    for (var i = 0u; i < lights_count_at_infinity(); i += 1u) {
        let arriving = lights_arriving_from_infinity(i, case_vector(at + 17u));
        answer_vector(to + 22u + 4u * i, arriving.rgb);
        answers[to + 25u + 4u * i] = arriving.w;
    }
}
";

fn prepared(scene: &Scene) -> PreparedScene {
    PreparedScene::new(scene, &RenderOptions::default()).unwrap()
}

/// A receiver, its random numbers, and the results of the CPU.
struct Question {
    words: [f32; CASE],
    answer: [f32; ANSWER],
}

fn questions(scene: &PreparedScene) -> Vec<Question> {
    let mut stream = Stream::new(11);
    let mut next = || stream.next::<f32>();
    let lights = u32::try_from(scene.light_count()).unwrap();
    (0..CASES)
        .map(|i| {
            let size = if i % 4 == 0 { 30.0 } else { 8.0 };
            let point = [(); 3].map(|()| size * (next() - 0.5));
            let normal = warp::uniform_sphere([next(), next()]).to_array();
            let normal = (i % 3 != 0).then_some(normal);
            // As samplers have them: multiples of 2^-23.
            let u = [(); 4].map(|()| (next() * 8_388_608.0).floor() / 8_388_608.0);
            question(scene, (point, normal), u, i % lights.max(1))
        })
        .collect()
}

fn question(
    scene: &PreparedScene,
    lit: ([f32; 3], Option<[f32; 3]>),
    u: [f32; 4],
    light: u32,
) -> Question {
    let mut words = [0.0; CASE];
    let mut answer = [0.0; ANSWER];
    words[..3].copy_from_slice(&lit.0);
    words[3..6].copy_from_slice(&lit.1.unwrap_or_default());
    words[6..10].copy_from_slice(&u);
    words[10] = f32::from_bits(light);
    words[11..14].copy_from_slice(&[2.0, 0.3, 0.7]);
    words[14..17].copy_from_slice(&[0.0, 0.6, 0.8]);
    words[17..20].copy_from_slice(&warp::uniform_sphere([u[1], u[2]]).to_array());
    words[20..22].copy_from_slice(&[0.5 * u[1], 0.5 * u[2]]);
    let (position, normal) = lit;
    let lit = LitPoint { position, normal };
    if let Some(sample) = scene.sample_light(&lit, u) {
        answer[0] = 1.0;
        answer[1..4].copy_from_slice(&sample.wi);
        answer[4] = sample.pdf;
        answer[5..8].copy_from_slice(&sample.radiance);
        answer[8] = f32::from(u8::from(sample.is_delta));
        answer[18] = f32::from(u8::from(sample.target.is_none()));
        answer[9..18].copy_from_slice(sample.target.unwrap_or_default().as_flattened());
        words[17..20].copy_from_slice(&sample.wi);
        if let (Some([point, _, normal]), false) = (sample.target, sample.is_delta) {
            words[11..14].copy_from_slice(&point);
            words[14..17].copy_from_slice(&normal);
        }
    }
    let triple = |at: usize| [words[at], words[at + 1], words[at + 2]];
    let weights = [words[20], words[21]];
    answer[20] = scene.light_pdf(&lit, light, [triple(11), triple(14)], weights);
    answer[21] = scene.probability_of_infinity(&lit);
    let arriving = scene.radiance_from_infinity(triple(17));
    assert!(arriving.len() <= FAR);
    answer[22..22 + 4 * arriving.len()].copy_from_slice(arriving.as_flattened());
    Question { words, answer }
}

/// A module's text to be replaced.
struct Fault {
    module: &'static str,
    from: &'static str,
    to: &'static str,
}

fn source(flat: &FlatScene<'_>, fault: Option<&Fault>) -> String {
    // No rays are traced: the stack is never used.
    let mut text = flat.declarations();
    text += &specula_shaders::compose(&["frame", "warp"]).unwrap();
    for (name, module) in MODULES {
        let lines = module.lines().filter(|l| !l.starts_with("import "));
        let mut code: String = lines.flat_map(|l| [l, "\n"]).collect();
        if let Some(fault) = fault.filter(|f| f.module == *name) {
            assert_eq!(code.matches(fault.from).count(), 1, "'{}'", fault.from);
            code = code.replace(fault.from, fault.to);
        }
        text += &code;
    }
    text + ENTRY
}

fn answers(
    gpu: &Gpu,
    scene: &PreparedScene,
    questions: &[Question],
    fault: Option<&Fault>,
) -> Vec<[f32; ANSWER]> {
    let mut flat = scene.flatten();
    let tree = Tree::new(&mut flat);
    let module = gpu.shader("lights", &source(&flat, fault)).unwrap();
    let kernel = ComputeKernel::new(gpu, &module, "answer_all", 4).unwrap();
    let bytes = |words: &mut dyn Iterator<Item = u32>| -> Vec<u8> {
        words.flat_map(u32::to_le_bytes).collect()
    };
    let cases = bytes(&mut questions.iter().flat_map(|q| q.words).map(f32::to_bits));
    let words = bytes(&mut flat.words.iter().copied());
    let or_one = |array: &[u8]| {
        if array.is_empty() {
            vec![0; 16]
        } else {
            array.to_vec()
        }
    };
    let (nodes, packets) = (or_one(tree.nodes()), or_one(tree.triangles()));
    let size = u64::try_from(4 * ANSWER * questions.len()).unwrap();
    let arrays = kernel
        .upload(gpu, &[&cases, &nodes, &packets, &words], size)
        .unwrap();
    kernel.run(gpu, &arrays, [CASES / 64, 1, 1]).unwrap();
    let output = arrays.output(gpu).unwrap();
    let floats: Vec<f32> = output
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    let (rows, _) = floats.as_chunks::<ANSWER>();
    rows.to_vec()
}

/// Whether two values are the same up to a share of the greater, or of `scale`.
fn near(a: f32, b: f32, tolerance: f32, scale: f32) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs()).max(scale)
}

/// Which parts of an answer are wrong: the sample, the density of a surface, the share of infinity, what
/// arrives from there.
fn wrong(cpu: &[f32; ANSWER], gpu: &[f32; ANSWER]) -> [bool; 4] {
    let all = |range: std::ops::Range<usize>, tolerance, scale| {
        range
            .into_iter()
            .all(|i| near(cpu[i], gpu[i], tolerance, scale))
    };
    let infinite = cpu[18] != 0.0;
    let target =
        infinite || (all(9..12, 1e-4, 1.0) && all(12..15, 1e-5, 0.0) && all(15..18, 1e-3, 1.0));
    let same = gpu[0] != 0.0
        && all(1..4, 1e-4, 1.0)
        && all(4..5, 1e-3, 0.0)
        && all(5..8, 1e-3, 1e-4)
        && cpu[8] == gpu[8]
        && cpu[18] == gpu[18]
        && target;
    let sample = if cpu[0] == 0.0 { gpu[0] == 0.0 } else { same };
    [
        !sample,
        !all(20..21, 1e-3, 0.0),
        !all(21..22, 1e-4, 0.0),
        !all(22..ANSWER, 1e-3, 1e-4),
    ]
}

/// Shares of wrong answers: see [`wrong`].
fn shares(questions: &[Question], answers: &[[f32; ANSWER]]) -> [f64; 4] {
    let mut counts = [0_u32; 4];
    for (question, answer) in questions.iter().zip(answers) {
        let each = wrong(&question.answer, answer);
        for (count, is_wrong) in counts.iter_mut().zip(each) {
            *count += u32::from(is_wrong);
        }
    }
    counts.map(|count| f64::from(count) / f64::from(CASES))
}

#[test]
fn lights_are_sampled_and_looked_up_as_on_the_cpu() {
    let Some(gpu) = gpu("the comparison of lights") else {
        return;
    };
    for (name, scene) in scenes() {
        let scene = prepared(&scene);
        let questions = questions(&scene);
        let count = |at: usize| questions.iter().filter(|q| q.answer[at] != 0.0).count();
        let (lit, dense) = (count(0), count(20));
        let answers = answers(gpu, &scene, &questions, None);
        let shares = shares(&questions, &answers);
        let [sample, surface, infinite, arriving] = shares;
        println!(
            "{name}: {lit} of {CASES} lit, {dense} densities; wrong: samples {sample:.1e}, densities {surface:.1e}, \
             shares {infinite:.1e}, from infinity {arriving:.1e}"
        );
        assert!(lit > 10_000 || name == "a dark scene", "{name}: {lit} lit");
        let emits = [
            "one rectangle",
            "shapes",
            "shapes that vary",
            "everything",
            "many triangles and a sky",
            "falling distances",
        ];
        assert!(
            dense > 4000 || !emits.contains(&name),
            "{name}: {dense} densities"
        );
        assert!(
            shares.iter().all(|&s| s <= strays(gpu)),
            "{name}: {shares:?}"
        );
    }
}

#[test]
fn planted_faults_are_noticed() {
    let Some(gpu) = gpu("faults in the shaders of lights") else {
        return;
    };
    let everything = [
        ("light_node", "+ a.y * b.y", "+ 1.01 * a.y * b.y"),
        ("light_tree", "/ left[chosen]", "/ few.sum"),
        ("light_tree", "few.weights[trail.x] /", "few.weights[0] /"),
        (
            "area",
            "sqrt(max(1.0 - sine_squared / cone.sine_squared",
            "sqrt(max(1.0 - sine_squared",
        ),
        ("parallelogram", "first + last)", "first - last)"),
        (
            "environment",
            "2.0 * angles_turns(sine, w.z)",
            "angles_turns(sine, w.z)",
        ),
        ("spot", "3.0 - 2.0 * t", "3.0 - 1.9 * t"),
        ("sun", "t * (2.0 - t)", "t * (1.9 - t)"),
        ("lights", "far / (far + near)", "near / (far + near)"),
    ];
    let falling = [
        ("light_tree", "importances.x / (", "importances.y / ("),
        ("light_tree", "trail.y << 31u", "trail.y << 30u"),
    ];
    let varying = [
        ("textured", "sampled.area.pdf *= density;", ""),
        (
            "textured",
            "weights.yx, word(at + 2u) != 0u",
            "weights.yx, false",
        ),
        ("textured", "2.0 * weights.x, sum", "weights.x, sum"),
        ("piecewise", "(cells + 1u) + x", "cells + x"),
    ];
    let projected = [
        ("projected", "1.0 - square.y", "square.y"),
        ("projected", "cosine * cosine * cosine", "cosine * cosine"),
        ("spot", "(last - spot_angle(x))", "spot_angle(x)"),
    ];
    for (name, faults) in [
        ("everything", &everything[..]),
        ("falling distances", &falling),
        ("shapes that vary", &varying),
        ("projected pictures", &projected),
    ] {
        let found = scenes().into_iter().find(|(n, _)| *n == name);
        let scene = prepared(&found.expect("the scene is in the list").1);
        let questions = questions(&scene);
        for &(module, from, to) in faults {
            let fault = Fault { module, from, to };
            let answers = answers(gpu, &scene, &questions, Some(&fault));
            let shares = shares(&questions, &answers);
            println!("{module}: {from} -> {to}: {shares:?}");
            assert!(
                shares.iter().any(|&s| s > strays(gpu)),
                "{module}: {from} -> {to}: {shares:?}"
            );
        }
    }
}
