//! Lights: what shaders draw and look up, beside the renderer on the CPU, at random points of scenes
//! with every kind of light. Faults planted in the shaders are noticed.
//!
//! Where no GPU is found, the tests say that they are skipped; `SPECULA_GPU=require` makes that a
//! failure.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a suite says how much it checked, and its helpers fail loudly"
)]

mod common;

use std::fmt::Write as _;
use std::sync::atomic::{AtomicU32, Ordering};

use common::gpu;
use glam::DMat4;
use specula_bsdf::Rgb;
use specula_bsdf::math::{Stream, rgb, warp};
use specula_gpu::{Gpu, Kernel};
use specula_render::{FlatScene, PreparedScene, RenderOptions};
use specula_scene::scene::{
    Channel, ColourParam, EnvironmentMapping, ImageId, Instance, Interpolation, Light, Object,
    ObjectId, Profile, SpotFalloff, Texture, TextureId, TextureMapping, Throw, Wrap,
};
use specula_scene::{Image, Scene};

/// Receivers of each scene.
const CASES: u32 = 16_384;
/// Share of answers that may differ where rounding decides between two lights, or at edges.
const STRAYS: f64 = 3e-4;
/// Words of a case: point, normal (zero: none), four numbers, a light, a target and its normal, a
/// direction, weights of the target's corners.
const CASE: usize = 22;
/// Words of an answer: the sample (20), the density of the target, the share of lights at infinity, and
/// what arrives from up to three of those.
const ANSWER: usize = 34;
/// Most lights at infinity that are asked.
const FAR: usize = 3;

/// The modules in the order of their imports.
const MODULES: &[(&str, &str)] = &[
    ("world", include_str!("../wgsl/world.wgsl")),
    ("sequence", include_str!("../wgsl/sequence.wgsl")),
    ("traverse", include_str!("../wgsl/traverse.wgsl")),
    ("angles", include_str!("../wgsl/angles.wgsl")),
    ("surface", include_str!("../wgsl/surface.wgsl")),
    ("texture_place", include_str!("../wgsl/texture_place.wgsl")),
    (
        "texture_mapping",
        include_str!("../wgsl/texture_mapping.wgsl"),
    ),
    ("texture_noise", include_str!("../wgsl/texture_noise.wgsl")),
    (
        "texture_raster",
        include_str!("../wgsl/texture_raster.wgsl"),
    ),
    ("texture_graph", include_str!("../wgsl/texture_graph.wgsl")),
    ("octahedral", include_str!("../wgsl/octahedral.wgsl")),
    ("parallelogram", include_str!("../wgsl/parallelogram.wgsl")),
    ("area", include_str!("../wgsl/area.wgsl")),
    ("piecewise", include_str!("../wgsl/piecewise.wgsl")),
    ("textured", include_str!("../wgsl/textured.wgsl")),
    ("spot", include_str!("../wgsl/spot.wgsl")),
    ("thrown", include_str!("../wgsl/thrown.wgsl")),
    ("sun", include_str!("../wgsl/sun.wgsl")),
    ("delta", include_str!("../wgsl/delta.wgsl")),
    ("environment", include_str!("../wgsl/environment.wgsl")),
    ("light_node", include_str!("../wgsl/light_node.wgsl")),
    ("light_tree", include_str!("../wgsl/light_tree.wgsl")),
    ("lights", include_str!("../wgsl/lights.wgsl")),
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
    let drawn = lights_draw(receiver, u);
    answers[to] = f32(drawn.valid);
    answer_vector(to + 1u, drawn.wi);
    answers[to + 4u] = drawn.pdf;
    answer_vector(to + 5u, drawn.radiance);
    answers[to + 8u] = f32(drawn.delta);
    answer_vector(to + 9u, drawn.target_position);
    answer_vector(to + 12u, drawn.target_error);
    answer_vector(to + 15u, drawn.target_normal);
    answers[to + 18u] = f32(drawn.from_infinity);
    let light = bitcast<u32>(cases[at + 10u]);
    let weights = vec2f(cases[at + 20u], cases[at + 21u]);
    answers[to + 20u] = lights_pdf_of_surface(
        receiver, light, case_vector(at + 11u), case_vector(at + 14u), weights);
    answers[to + 21u] = lights_share_from_infinity(receiver);
    for (var i = 0u; i < lights_arriving_count(); i += 1u) {
        let arriving = lights_arriving(i, case_vector(at + 17u));
        answer_vector(to + 22u + 4u * i, arriving.rgb);
        answers[to + 25u + 4u * i] = arriving.w;
    }
}
";

/// A scene of the shapes in `world`, a piece of a pbrt file.
fn scene(name: &str, world: &str) -> Scene {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let file = format!("specula-lights-{}-{number}.pbrt", std::process::id());
    let path = std::env::temp_dir().join(file);
    std::fs::write(&path, format!("WorldBegin\n{world}")).unwrap();
    let loaded = specula_scene::load(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
    std::fs::remove_file(path).unwrap();
    loaded.scene
}

/// Shapes of every kind, on either side, alone and with lights at infinity and without extent.
const SHAPES: &str = r#"
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [5 4 3]
  Shape "trianglemesh" "point3 P" [-1 -1 3  1 -1 3  0 1 3.5] "integer indices" [0 1 2]
  Shape "trianglemesh" "point3 P" [-3 -1 0  -3 1 0  -3 1 2  -3 -1 2] "integer indices" [0 1 2 0 2 3]
  Shape "trianglemesh" "point3 P" [3 0 0  4 1 0  4 1 1  3 0 1] "integer indices" [0 1 2 0 2 3]
  Shape "trianglemesh" "point3 P" [0 3 0  1 3 0.2  1.5 4 1  0.5 4 0.8]
    "integer indices" [0 1 2 0 2 3]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [1 2 3] "bool twosided" true
  Translate 0 -3 1
  Rotate 40 1 0 0
  Shape "disk" "float radius" 0.7
  Translate 1.5 0 0
  Shape "trianglemesh" "point3 P" [0 0 0  0.6 0 0  0 0.8 0] "integer indices" [0 1 2]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [9 2 2]
  Translate 2 -2 -2
  Shape "sphere" "float radius" 0.5
  Translate -4 0 0
  Rotate 30 1 1 0
  Scale 1 0.5 0.3
  Shape "sphere" "float radius" 0.8
AttributeEnd
AttributeBegin
  ReverseOrientation
  AreaLightSource "diffuse" "rgb L" [0.2 0.2 0.3]
  Shape "sphere" "float radius" 9
AttributeEnd
"#;

/// Shapes that do not shine.
const FLOOR: &str = r#"Shape "disk" "float radius" 1"#;

/// Small triangles of very different strengths all over the place.
fn heap(count: usize) -> String {
    let mut stream = Stream::new(3);
    let mut next = || stream.next::<f64>();
    let mut text = String::new();
    for _ in 0..count {
        let at = [(); 3].map(|()| 8.0 * next() - 4.0);
        let corner = [(); 3].map(|()| at.map(|x| x + 0.3 * next() - 0.15));
        let strength = 10.0_f64.powf(4.0 * next() - 2.0);
        let _ = writeln!(
            text,
            "AreaLightSource \"diffuse\" \"rgb L\" [{strength} 1 {strength}] \"bool twosided\" {}
            Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [{}]",
            next() < 0.3,
            corner
                .as_flattened()
                .iter()
                .map(f64::to_string)
                .collect::<Vec<_>>()
                .join(" "),
        );
    }
    text
}

/// Triangles whose distances fall so fast that trees peel them off one by one, deeper than a word has
/// bits.
fn falling() -> String {
    let shape = |i: i32| {
        let x = 100.0 * 12.01_f64.powi(-i);
        format!(
            "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"bool twosided\" true
            Shape \"trianglemesh\" \"integer indices\" [0 1 2]
              \"point3 P\" [{x} 0 0 {x} 1 0 {x} 0 1]\n"
        )
    };
    (0..36).map(shape).collect()
}

/// A sky with a small sun in it, black pixels beside others.
fn picture(width: u32, height: u32) -> Image {
    let pixel = |i: u32| match (i % width, i / width) {
        (7, 2) => [90.0, 40.0, 10.0],
        (x, _) if x % 3 == 0 => [0.0; 3],
        (x, y) => [0.1 * x as f32, 0.2, 0.05 * y as f32],
    };
    Image {
        name: "sky".into(),
        width,
        height,
        pixels: (0..width * height).map(pixel).collect(),
    }
}

/// Adds a picture to the first infinite light.
fn with_picture(mut scene: Scene, mapping: EnvironmentMapping) -> Scene {
    let size = match mapping {
        EnvironmentMapping::EqualAreaOctahedral => [13, 13],
        _ => [24, 12],
    };
    let id = ImageId(scene.images.len());
    scene.images.push(picture(size[0], size[1]));
    let infinite = scene.lights.iter_mut().find_map(|light| match light {
        Light::Infinite { image, .. } => Some(image),
        _ => None,
    });
    *infinite.expect("the scene has an infinite light") = Some((id, mapping));
    scene
}

/// Shapes whose emission varies, with and without a table, under a mirror, and cut out.
const VARYING: &str = r#"
Texture "holes" "float" "checkerboard" "float uscale" 4 "float vscale" 4
  "float tex1" 1 "float tex2" 0.25
AttributeBegin
  AreaLightSource "diffuse"
  Shape "trianglemesh" "point3 P" [-1 -1 3  1 -1 3  0 1 3.5] "point2 uv" [0 0 1 0 0 1]
    "integer indices" [0 1 2]
  Scale -1 1 1
  Shape "trianglemesh" "point3 P" [-3 -1 0  -3 1 0  -3 1 2  -3 -1 2] "point2 uv" [0 0 1 0 1 1 0 1]
    "integer indices" [0 1 2 0 2 3]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "bool twosided" true
  Translate 0 -3 1
  Shape "disk" "float radius" 0.7
  Translate 0 5 0
  Scale 1 0.5 0.7
  Shape "sphere" "float radius" 0.6
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [1 2 3]
  Shape "trianglemesh" "point3 P" [2 2 -3  4 2 -3  3 4 -3] "point2 uv" [0 0 1 0 0 1]
    "integer indices" [0 1 2] "texture alpha" "holes"
AttributeEnd
"#;

const SKY: &str = r#"
AttributeBegin
  Rotate 50 1 2 0
  LightSource "infinite" "rgb L" [0.5 0.6 0.7]
AttributeEnd
"#;

/// Lights without extent, the falloffs of spots and a sun.
fn with_deltas(mut scene: Scene) -> Scene {
    let falloffs = [
        SpotFalloff::SmoothCosine,
        SpotFalloff::LinearAngle,
        SpotFalloff::SquaredCosine,
    ];
    for (x, falloff) in (0_u8..).zip(falloffs) {
        scene.lights.push(Light::Spot {
            position: [f64::from(x) - 1.0, 2.0, 2.0],
            axis: [0.0, -0.6, -0.8],
            intensity: rgb(3.0, 2.0, 1.0),
            cone_angle_deg: 50.0,
            falloff_start_deg: 10.0,
            falloff,
        });
    }
    scene.lights.push(Light::Point {
        position: [0.5, 0.5, -1.5],
        intensity: rgb(1.0, 2.0, 1.0),
    });
    for half_angle_deg in [0.0, 0.5, 40.0] {
        scene.lights.push(Light::Distant {
            irradiance: rgb(2.0, 1.5, 1.0),
            to_light: [0.36, 0.48, 0.8],
            half_angle_deg,
        });
    }
    scene
}

/// Gives all shapes that shine a radiance that varies, but the last, and adds mirrored copies of the first.
fn with_varying(mut scene: Scene) -> Scene {
    let texture = TextureId(scene.textures.len());
    scene.textures.push(Texture::Bilinear {
        corners: [[0.0; 3], [0.3, 0.2, 0.1], [0.1, 0.2, 0.3], [9.0, 8.0, 7.0]].map(Rgb::from),
        mapping: TextureMapping::default(),
    });
    let count = scene.shapes.len();
    for emission in scene.shapes[..count - 1]
        .iter_mut()
        .filter_map(|s| s.emission.as_mut())
    {
        emission.radiance = ColourParam::Texture(texture);
    }
    let object = ObjectId(scene.objects.len());
    scene.objects.push(Object {
        name: "copied".into(),
        shapes: scene.shapes[..1].to_vec(),
    });
    scene.instances.push(Instance {
        object,
        to_world: DMat4::from_translation([0.0, 0.0, -6.0].into())
            * DMat4::from_scale([-1.0, 1.0, 1.0].into()),
    });
    scene
}

/// Pictures thrown from a point: to all sides, and through windows of every profile.
fn with_thrown(mut scene: Scene) -> Scene {
    let image = ImageId(scene.images.len());
    scene.images.push(picture(12, 12));
    let texture = TextureId(scene.textures.len());
    scene.textures.push(Texture::Image {
        image,
        mapping: TextureMapping::default(),
        wrap: [Wrap::Clamp; 2],
        filter: Interpolation::Bilinear,
        invert: false,
        scale: 2.0,
        channel: Channel::Rgb,
    });
    let window = |profile| Throw::Window {
        half: [0.7, 0.5],
        profile,
    };
    let spot = Profile::Spot {
        cone_angle_deg: 30.0,
        falloff_start_deg: 10.0,
    };
    let throws = [
        Throw::Sphere,
        window(Profile::Intensity),
        window(Profile::Irradiance),
        window(spot),
    ];
    for (x, throw) in (0_u8..).zip(throws) {
        let turned = DMat4::from_rotation_x(0.9 * f64::from(x));
        scene.lights.push(Light::Picture {
            to_world: DMat4::from_translation([f64::from(x) - 1.5, 0.3, 1.0].into()) * turned,
            intensity: ColourParam::Texture(texture),
            throw,
        });
    }
    scene
}

/// Scenes by name.
fn scenes() -> Vec<(&'static str, Scene)> {
    use EnvironmentMapping::{EqualAreaOctahedral, LatitudeLongitude, LatitudeLongitudePoles};
    let lone = r#"AreaLightSource "diffuse" "rgb L" [1 2 3]
        Shape "trianglemesh" "point3 P" [-3 -1 0  -3 1 0  -3 1 2  -3 -1 2]
          "integer indices" [0 1 2 0 2 3]"#;
    let floor_and_sky = format!("{FLOOR}{SKY}");
    let sky = |mapping| with_picture(scene("sky", &floor_and_sky), mapping);
    let all = with_deltas(scene("all", &format!("{SHAPES}{SKY}")));
    let many = scene("many", &format!("{}{SKY}", heap(3000)));
    vec![
        ("a dark scene", scene("dark", FLOOR)),
        ("one rectangle", scene("lone", lone)),
        ("shapes", scene("shapes", SHAPES)),
        ("a constant sky", scene("constant", &floor_and_sky)),
        ("an octahedral sky", sky(EqualAreaOctahedral)),
        ("a sky by latitude", sky(LatitudeLongitude)),
        ("a sky with poles", sky(LatitudeLongitudePoles)),
        ("lights without extent", with_deltas(scene("deltas", FLOOR))),
        ("shapes that vary", with_varying(scene("varying", VARYING))),
        ("thrown pictures", with_thrown(scene("thrown", FLOOR))),
        ("everything", with_picture(all, LatitudeLongitude)),
        ("falling distances", scene("falling", &falling())),
        (
            "many triangles and a sky",
            with_picture(many, EqualAreaOctahedral),
        ),
    ]
}

fn prepared(scene: &Scene) -> PreparedScene {
    PreparedScene::new(scene, &RenderOptions::default()).unwrap()
}

/// A receiver, its numbers, and what the CPU says to them.
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
    if let Some(drawn) = scene.probe_light(lit, u) {
        answer[0] = 1.0;
        answer[1..19].copy_from_slice(&drawn);
        words[17..20].copy_from_slice(&drawn[..3]);
        let is_surface = drawn[7] == 0.0 && drawn[17] == 0.0;
        if is_surface {
            words[11..14].copy_from_slice(&drawn[8..11]);
            words[14..17].copy_from_slice(&drawn[14..17]);
        }
    }
    let triple = |at: usize| [words[at], words[at + 1], words[at + 2]];
    let weights = [words[20], words[21]];
    answer[20] = scene.probe_light_pdf(lit, light, triple(11), triple(14), weights);
    answer[21] = scene.probe_share_from_infinity(lit);
    let arriving = scene.probe_infinity(triple(17));
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
    let mut text = String::from("const STACK_SIZE: u32 = 1u;\n");
    for (name, value) in &flat.constants {
        let _ = writeln!(text, "const {name}: u32 = {value}u;");
    }
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
    let flat = scene.flatten();
    let module = gpu.shader("lights", &source(&flat, fault)).unwrap();
    let kernel = Kernel::new(gpu, &module, "answer_all", 4).unwrap();
    let bytes = |words: &mut dyn Iterator<Item = u32>| -> Vec<u8> {
        words.flat_map(u32::to_le_bytes).collect()
    };
    let cases = bytes(&mut questions.iter().flat_map(|q| q.words).map(f32::to_bits));
    let words = bytes(&mut flat.words.iter().copied());
    let or_one = |array: &[u8]| {
        if array.is_empty() {
            vec![0; 4]
        } else {
            array.to_vec()
        }
    };
    let (nodes, packets) = (or_one(flat.nodes), or_one(flat.packets));
    let size = u64::try_from(4 * ANSWER * questions.len()).unwrap();
    let arrays = kernel
        .upload(gpu, &[&cases, &nodes, &packets, &words], size)
        .unwrap();
    kernel.run(gpu, &arrays, [CASES / 64, 1, 1]).unwrap();
    let output = arrays.output(gpu).unwrap();
    let numbers: Vec<f32> = output
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    let (rows, _) = numbers.as_chunks::<ANSWER>();
    rows.to_vec()
}

/// Whether two numbers are the same up to a share of the greater, or of `scale`.
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
fn lights_are_drawn_and_looked_up_as_on_the_cpu() {
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
        let shines = [
            "one rectangle",
            "shapes",
            "shapes that vary",
            "everything",
            "many triangles and a sky",
            "falling distances",
        ];
        assert!(
            dense > 4000 || !shines.contains(&name),
            "{name}: {dense} densities"
        );
        assert!(shares.iter().all(|&s| s <= STRAYS), "{name}: {shares:?}");
    }
}

#[test]
fn planted_faults_are_noticed() {
    let Some(gpu) = gpu("faults in the shaders of lights") else {
        return;
    };
    let everything = [
        ("light_node", "* sine_b", "* 1.01 * sine_b"),
        ("light_tree", "importances.x / (", "importances.y / ("),
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
    let falling = [("light_tree", "trail.y << 31u", "trail.y << 30u")];
    let varying = [
        ("textured", "drawn.area.pdf *= density;", ""),
        (
            "textured",
            "weights.yx, word(at + 2u) != 0u",
            "weights.yx, false",
        ),
        ("textured", "2.0 * weights.x, sum", "weights.x, sum"),
        ("piecewise", "(cells + 1u) + x", "cells + x"),
    ];
    let thrown = [
        ("thrown", "1.0 - square.y", "square.y"),
        ("thrown", "cosine * cosine * cosine", "cosine * cosine"),
        ("spot", "(last - spot_angle(x))", "spot_angle(x)"),
    ];
    for (name, faults) in [
        ("everything", &everything[..]),
        ("falling distances", &falling),
        ("shapes that vary", &varying),
        ("thrown pictures", &thrown),
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
                shares.iter().any(|&s| s > STRAYS),
                "{module}: {from} -> {to}: {shares:?}"
            );
        }
    }
}
