//! Pictures of the GPU beside the processor's: the same samples follow the same paths up to rounding,
//! and renders of other seeds have the same expectation.
//!
//! Rays go through the tree, and where the GPU offers ray queries, by these too.
//!
//! Where no GPU is found, or none with ray queries, the tests say what is skipped; `SPECULA_GPU=require`
//! and `SPECULA_RAY_QUERIES=require` make that a failure.
#![allow(clippy::print_stdout, reason = "a suite says how much it checked")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/few.rs"]
mod few;
mod measured;
mod normal_maps;
#[path = "../common/queries.rs"]
mod offered;
mod textures;

use std::sync::atomic::AtomicBool;

use common::gpu;
use few::{renders_all, some};
use offered::gpu_with_queries;
use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;
use specula_bsdf::vndf;
use specula_gpu::{AdapterKind, Gpu, Rays, Tracer, TracerOptions};
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::Scene;
use specula_scene::scene::{
    ColourParam, EnvironmentMapping, Filter, FloatParam, GltfMaterial, MaterialKind,
    PrincipledMaterial, Projection,
};
use specula_stat::image::{NoisyImage, compare};

/// A scene of a pbrt-v4 file with this text after its camera.
fn scene(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.pbrt");
    let head = "LookAt 0 -4 1.6  0 0 0.6  0 0 1\n\
        Camera \"perspective\" \"float fov\" 45\n\
        Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 32\n\
        Sampler \"zsobol\" \"integer pixelsamples\" 16\n\
        Integrator \"volpath\" \"integer maxdepth\" 6\nWorldBegin\n";
    std::fs::write(&file, format!("{head}{text}")).unwrap();
    specula_scene::load(&file).unwrap().scene
}

fn options(scene: &Scene, seed: u32) -> RenderOptions {
    RenderOptions {
        seed,
        ..RenderOptions::from_scene(scene)
    }
}

fn on_processor(scene: &Scene, options: &RenderOptions, samples: u32) -> Picture {
    let prepared = PreparedScene::new(scene, options).unwrap();
    let mut renderer = Renderer::new(&prepared, options.clone());
    renderer.render_pass(samples, &AtomicBool::new(false));
    renderer.film().picture()
}

/// A GPU, and how rays are cast there.
type Device<'a> = (&'a Gpu, Rays);

/// What software renders by ray queries too: it compiles such a shader for half a minute. All with
/// `SPECULA_RAY_QUERIES=all`.
const ON_SOFTWARE: [&str; 1] = ["lights, instances"];

/// The GPU through the tree, and by ray queries where it offers them.
fn devices(what: &str) -> Vec<Device<'static>> {
    let tree = gpu(what).map(|gpu| (gpu, Rays::Tree));
    let all = std::env::var("SPECULA_RAY_QUERIES").is_ok_and(|v| v == "all");
    let quick =
        |gpu: &Gpu| all || gpu.adapter.kind != AdapterKind::Software || ON_SOFTWARE.contains(&what);
    let queries = gpu_with_queries(&format!("{what}, by ray queries"));
    let queries = queries.filter(|gpu| quick(gpu));
    let queries = queries.map(|gpu| (gpu, Rays::Query));
    tree.into_iter().chain(queries).collect()
}

fn on_gpu(
    (gpu, rays): Device<'_>,
    scene: &Scene,
    options: &RenderOptions,
    samples: u32,
) -> Picture {
    let prepared = PreparedScene::new(scene, options).unwrap();
    let mut renderer = Renderer::new(&prepared, options.clone());
    let on_gpu = TracerOptions {
        rays,
        ..TracerOptions::default()
    };
    let tracer = Tracer::with_options(gpu, &prepared, options, on_gpu);
    let mut tracer = tracer.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(tracer.uses_ray_queries(), rays == Rays::Query);
    let go = AtomicBool::new(false);
    let report = tracer.render_pass(&mut renderer, samples, &go).unwrap();
    assert_eq!((report.invalid_samples, report.complete), (0, true));
    assert_eq!(report.samples_done_total, samples);
    renderer.film().picture()
}

fn mean(picture: &Picture) -> f64 {
    let sum: f64 = picture
        .colour
        .iter()
        .map(|c| f64::from(c.luminance()))
        .sum();
    sum / picture.colour.len() as f64
}

/// Share of the pixels that differ by more than a thousandth of themselves and of the mean.
fn differing(a: &Picture, b: &Picture) -> f64 {
    let mean = mean(a);
    let differ = a.colour.iter().zip(&b.colour).filter(|(a, b)| {
        (**a - **b)
            .to_array()
            .iter()
            .any(|d| f64::from(d.abs()) > 1e-3 * (mean + f64::from(a.max_channel())))
    });
    differ.count() as f64 / a.colour.len() as f64
}

/// The luminance of a picture's pixels, and the variance of each.
fn luminance(picture: &Picture) -> [Vec<f64>; 2] {
    let mean = picture.colour.iter().map(|c| f64::from(c.luminance()));
    let deviation = |v: &Rgb<f32>| f64::from(v.map(f32::sqrt).luminance());
    let variance = picture.variance.iter().map(|v| deviation(v).powi(2));
    [mean.collect(), variance.collect()]
}

fn image([mean, variance]: &[Vec<f64>; 2]) -> NoisyImage<'_> {
    NoisyImage {
        width: 40,
        mean,
        variance,
    }
}

/// Share of pixels that differ between the devices, of the same samples of two scenes, and the quotient of
/// means.
fn compared(
    device: Device<'_>,
    [processor, other]: [&Scene; 2],
    options: &RenderOptions,
) -> [f64; 2] {
    let a = on_processor(processor, options, 2);
    let b = on_gpu(device, other, options, 2);
    assert!(mean(&a) > 0.0, "a black picture shows nothing");
    [differing(&a, &b), mean(&b) / mean(&a)]
}

/// Largest share of pixels that may differ: paths part where rounding decides otherwise.
///
/// SwiftShader: none in 27 pictures, 2 of 1280 pixels in one. Real GPUs fuse multiplications and additions and have
/// square roots and quotients of their own.
fn most_differing(gpu: &Gpu) -> f64 {
    match gpu.adapter.kind {
        AdapterKind::Software => 0.005,
        _ => 0.02,
    }
}

/// The same samples give the same picture.
fn check(name: &str, scene: &Scene, change: impl Fn(RenderOptions) -> RenderOptions) {
    for (gpu, rays) in devices(name) {
        let [share, ratio] = compared((gpu, rays), [scene; 2], &change(options(scene, 1)));
        println!(
            "{name}, {rays}: {:.2} % of pixels differ, means {ratio:.5}",
            100.0 * share
        );
        let bound = most_differing(gpu);
        assert!(
            share < bound,
            "{name}, {rays}: {:.2} % of pixels differ, bound {:.2} %",
            100.0 * share,
            100.0 * bound
        );
    }
}

const ROOM: &str = "
AttributeBegin
  AreaLightSource \"diffuse\" \"rgb L\" [8 7 6]
  Shape \"bilinearmesh\" \"point3 P\" [-0.5 -0.5 2.4  -0.5 0.5 2.4  0.5 -0.5 2.4  0.5 0.5 2.4]
AttributeEnd
Material \"diffuse\" \"rgb reflectance\" [0.6 0.5 0.4]
Shape \"trianglemesh\" \"point3 P\" [-3 -5 0  3 -5 0  3 3 0  -3 3 0] \"integer indices\" [0 1 2 0 2 3]
Shape \"trianglemesh\" \"point3 P\" [-3 3 0  3 3 0  3 3 3  -3 3 3] \"integer indices\" [0 1 2 0 2 3]
";

const SKY: &str = "LightSource \"infinite\" \"rgb L\" [0.4 0.5 0.6]\n";

/// Two spheres of two materials on the floor, one of them squeezed.
fn orbs(materials: [&str; 2]) -> String {
    let orb = |x: f32, material: &str, size: &str| {
        format!(
            "AttributeBegin\n{material}\nTranslate {x} 0 0.6 Scale {size}\n\
             Shape \"sphere\" \"float radius\" 0.6\nAttributeEnd\n"
        )
    };
    orb(-0.75, materials[0], "1 1 1") + &orb(0.75, materials[1], "0.9 0.9 1.2")
}

fn metal(roughness: &str) -> String {
    format!(
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" {roughness}"
    )
}

const NARROW: &str = "\"float uroughness\" 0.05 \"float vroughness\" 0.3";
const WIDE: &str = "\"float roughness\" 0.5";

#[test]
fn diffuse_triangles_under_an_area_light() {
    let triangle = "Shape \"trianglemesh\" \"point3 P\" [-0.5 0 0  0.5 0.3 0  0 0 1] \"integer indices\" [0 1 2]";
    check("diffuse", &scene(&format!("{ROOM}{triangle}")), |o| o);
}

#[test]
fn renders_of_other_seeds_have_the_same_expectation() {
    let scene = scene(&format!(
        "{ROOM}{SKY}{}",
        orbs([&metal(NARROW), &metal(WIDE)])
    ));
    let a = luminance(&on_processor(&scene, &options(&scene, 1), 64));
    for device in devices("other seeds") {
        let b = luminance(&on_gpu(device, &scene, &options(&scene, 2), 64));
        let report = compare(&image(&a), &image(&b), 8, 1e-4);
        assert!(report.is_pass(), "{}: {report}", device.1);
    }
}

#[test]
fn small_differences_are_noticed() {
    let text = |rough| format!("{ROOM}{SKY}{}", orbs([&metal(NARROW), &metal(rough)]));
    let [right, rougher] = [WIDE, "\"float roughness\" 0.505"].map(|rough| scene(&text(rough)));
    let darker = scene(&text(WIDE).replace("[8 7 6]", "[7.92 6.93 5.94]"));
    for device in devices("small differences") {
        let [share, _] = compared(device, [&right, &rougher], &options(&right, 1));
        assert!(share > 0.05, "a width 1 % larger: {share}");
        let [share, _] = compared(device, [&right, &darker], &options(&right, 1));
        assert!(share > 0.05, "a lamp 1 % darker: {share}");
    }
}

#[test]
fn samplers_and_strategies() {
    let glass = "Material \"dielectric\" \"float roughness\" 0.3\n";
    let scene = scene(&format!("{ROOM}{SKY}{}", orbs([&metal(NARROW), glass])));
    let each = [
        (vndf::Sampler::Cap, Strategy::Power),
        (vndf::Sampler::Heitz, Strategy::Balance),
        (vndf::Sampler::Bounded, Strategy::Mis),
    ];
    for (vndf_sampler, strategy) in some(each, 1) {
        let name = format!("{vndf_sampler:?}, {strategy:?}");
        check(&name, &scene, |o| RenderOptions {
            vndf_sampler,
            strategy,
            ..o
        });
    }
}

fn regularized(options: RenderOptions) -> RenderOptions {
    RenderOptions {
        regularize: true,
        ..options
    }
}

/// Smooth glass that becomes rough, rough metal that becomes rougher, and a mix of both; bounds that are met.
#[test]
fn renders_with_bias() {
    let mix = "MakeNamedMaterial \"a\" \"string type\" \"dielectric\"\n\
        MakeNamedMaterial \"b\" \"string type\" \"conductor\" \"float roughness\" 0.01\n\
        Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.4";
    let scene = scene(&format!("{ROOM}{SKY}{}", orbs([&metal(NARROW), mix])));
    let clamped = |most, options| RenderOptions {
        clamp: Some(most),
        ..options
    };
    if renders_all() {
        check("regularized", &scene, regularized);
        check("clamped", &scene, |o| clamped(0.2, o));
    }
    check("both", &scene, |o| clamped(0.2, regularized(o)));
    // The test can fail: they do change the picture.
    let plain = on_processor(&scene, &options(&scene, 1), 2);
    let rougher = on_processor(&scene, &regularized(options(&scene, 1)), 2);
    let darker = on_processor(&scene, &clamped(0.2, options(&scene, 1)), 2);
    for changed in [rougher, darker] {
        assert!(differing(&plain, &changed) > 0.05);
    }
}

#[test]
fn metals_by_every_treatment_of_energy() {
    let [narrow, wide] = [NARROW, WIDE].map(metal);
    let scene = scene(&format!("{ROOM}{SKY}{}", orbs([&narrow, &wide])));
    for energy in some(["kulla-conty", "multibounce"], 1) {
        check(&format!("metal, {energy}"), &scene, |o| RenderOptions {
            energy: energy.parse().unwrap(),
            ..o
        });
    }
}

#[test]
fn glass_by_every_treatment_of_energy() {
    let smooth = "Material \"dielectric\" \"float eta\" 1.5";
    let rough = "Material \"dielectric\" \"float eta\" 1.5 \"float roughness\" 0.3";
    let scene = scene(&format!("{ROOM}{SKY}{}", orbs([smooth, rough])));
    for energy in some(["multibounce", "turquin"], 1) {
        check(&format!("glass, {energy}"), &scene, |o| RenderOptions {
            energy: energy.parse().unwrap(),
            ..o
        });
    }
}

#[test]
fn coats_panes_and_sheets() {
    let coated =
        "Material \"coateddiffuse\" \"rgb reflectance\" [0.2 0.5 0.1] \"float roughness\" 0.2";
    let sheet = "Material \"diffusetransmission\" \"rgb reflectance\" [0.3 0.3 0.2] \"rgb transmittance\" [0.2 0.4 0.4]";
    check(
        "coat, sheet",
        &scene(&format!("{ROOM}{SKY}{}", orbs([coated, sheet]))),
        |o| o,
    );
    let pane = "Material \"thindielectric\" \"float eta\" 1.5";
    let mix = "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n\
        MakeNamedMaterial \"b\" \"string type\" \"conductor\" \"rgb reflectance\" [0.9 0.8 0.7]\n\
        Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.4";
    // Seen from either side.
    let cards = "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.25\n\
        Shape \"trianglemesh\" \"point3 P\" [-1.2 -1 0.1  -0.4 -1 0.1  -0.8 -0.9 0.8] \"integer indices\" [0 1 2]\n\
        Shape \"trianglemesh\" \"point3 P\" [0.4 -1 0.1  1.2 -1 0.1  0.8 -0.9 0.8] \"integer indices\" [0 2 1]\n";
    let mut scene = scene(&format!("{ROOM}{SKY}{}{cards}", orbs([pane, mix])));
    let mut sided = 0;
    for material in &mut scene.materials {
        if let MaterialKind::Mix { materials, amount } = material.kind
            && amount == FloatParam::Value(0.25)
        {
            material.kind = MaterialKind::Sided(materials);
            sided += 1;
        }
    }
    assert_eq!(sided, 1);
    check("pane, mix, sides", &scene, |o| o);
}

#[test]
fn lights_of_every_kind_and_instances() {
    let lights = "
LightSource \"point\" \"rgb I\" [2 1 1] \"point3 from\" [-2 -2 2]
LightSource \"spot\" \"rgb I\" [9 9 3] \"point3 from\" [2 -2 2] \"point3 to\" [0 0 0] \"float coneangle\" 40
LightSource \"distant\" \"rgb L\" [0.5 0.6 1] \"point3 from\" [1 1 3] \"point3 to\" [0 0 0]
AttributeBegin
AreaLightSource \"diffuse\" \"rgb L\" [3 9 3]
Translate 1.5 0.4 1.6
Shape \"sphere\" \"float radius\" 0.15
AttributeEnd
AttributeBegin
AreaLightSource \"diffuse\" \"rgb L\" [9 3 3] \"bool twosided\" true
Translate -1.5 0.4 1.6 Rotate 40 1 1 0
Shape \"disk\" \"float radius\" 0.2
AttributeEnd
ObjectBegin \"thing\"
Material \"conductor\" \"rgb reflectance\" [0.8 0.8 0.9] \"float roughness\" 0.2
Shape \"trianglemesh\" \"point3 P\" [-0.5 0 0  0.5 0.3 0  0 0 1  0.2 0.9 0.3] \"integer indices\" [0 1 2 1 3 2]
Shape \"sphere\" \"float radius\" 0.25
ObjectEnd
AttributeBegin Translate -1 0 0.3 Rotate 30 0 0 1 ObjectInstance \"thing\" AttributeEnd
AttributeBegin Translate 0.8 0 0.3 Scale 0.8 0.8 1.2 ObjectInstance \"thing\" AttributeEnd
";
    let scene = scene(&format!("{ROOM}{SKY}{lights}"));
    check("lights, instances", &scene, |o| o);
    check("lights only", &scene, |o| RenderOptions {
        strategy: Strategy::LightsOnly,
        ..o
    });
    check("lobes only", &scene, |o| RenderOptions {
        strategy: Strategy::BsdfOnly,
        ..o
    });
}

#[test]
fn lenses_filters_and_views() {
    let text = format!("{ROOM}{SKY}{}", orbs(["Material \"diffuse\""; 2]));
    let mut lens = scene(&text);
    lens.camera.lens_radius = 0.1;
    lens.camera.focal_distance = 4.0;
    lens.film.filter = Filter::Mitchell {
        radius: [2.0; 2],
        b: 1.0 / 3.0,
        c: 1.0 / 3.0,
    };
    check("lens, Mitchell", &lens, |o| o);
    let mut flat = scene(&text);
    flat.camera.projection = Projection::Orthographic;
    flat.camera.screen_window = [-2.0, 2.0, -1.6, 1.6];
    check("orthographic", &flat, |o| o);
    let mapping = EnvironmentMapping::EqualAreaOctahedral;
    flat.camera.projection = Projection::Spherical(mapping);
    check("all around", &flat, |o| o);
}

#[test]
fn films_that_expose_bound_and_balance() {
    let mut scene = scene(&format!("{ROOM}{SKY}"));
    scene.film.exposure = 1.7;
    scene.film.max_component = Some(0.6);
    scene.film.balance = [[0.9, 0.2, -0.1], [0.1, 1.1, 0.0], [0.0, -0.2, 1.3]];
    check("films", &scene, |o| o);
}

#[test]
fn medium_stack_that_absorb_and_hidden_lights() {
    let media = "
MakeNamedMedium \"dark\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.4 1.2 2] \"rgb sigma_s\" [0 0 0]
MakeNamedMedium \"light\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1.5 0.2 0.3] \"rgb sigma_s\" [0 0 0]
AttributeBegin
MediumInterface \"dark\" \"\"
Material \"dielectric\" \"float eta\" 1.4
Translate -0.7 0 0.6
Shape \"sphere\" \"float radius\" 0.6
AttributeEnd
AttributeBegin
MediumInterface \"light\" \"\"
Material \"interface\"
Translate 0.7 0 0.6
Shape \"sphere\" \"float radius\" 0.6
AttributeEnd
AttributeBegin
Material \"conductor\" \"rgb reflectance\" [0.9 0.9 0.9] \"float roughness\" 0.1
Translate 0.7 0 0.6
Shape \"sphere\" \"float radius\" 0.25
AttributeEnd
";
    let mut scene = scene(&format!("{ROOM}{SKY}{media}"));
    if renders_all() {
        check("media", &scene, |o| o);
    }
    scene.settings.hide_emitters = true;
    check("media, hidden lights", &scene, |o| o);
}

/// The room with orbs of these two materials.
fn with_materials(materials: [MaterialKind; 2]) -> Scene {
    let textures = "Texture \"slight\" \"float\" \"bilerp\" \"float v00\" 0 \"float v01\" 0.2 \
        \"float v10\" 0.4 \"float v11\" -0.3\n";
    let diffuse = format!(
        "{textures}Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5] \"texture displacement\" \"slight\""
    );
    let glossy = "Material \"conductor\"";
    let mut scene = scene(&format!("{ROOM}{SKY}{}", orbs([&diffuse, glossy])));
    let count = scene.shapes.len();
    for (shape, kind) in scene.shapes[count - 2..].iter().zip(materials) {
        scene.materials[shape.material.0].kind = kind;
    }
    scene
}

const ORANGE: ColourParam = ColourParam::Value(rgb(0.8, 0.4, 0.2));

fn colour(r: f32, g: f32, b: f32) -> ColourParam {
    ColourParam::Value(rgb(r, g, b))
}

#[test]
fn principled_materials() {
    let value = FloatParam::Value;
    let solid = PrincipledMaterial {
        base_colour: ORANGE,
        roughness: value(0.4),
        anisotropic: value(0.5),
        metallic: value(0.3),
        spec_trans: value(0.3),
        eta: 1.5,
        spec_tint: value(0.3),
        sheen: value(0.4),
        sheen_tint: value(0.5),
        clearcoat: value(0.6),
        clearcoat_gloss: value(0.7),
        flatness: value(0.2),
        diff_trans: value(0.7),
        thin: false,
    };
    let thin = PrincipledMaterial {
        thin: true,
        ..solid
    };
    let scene = with_materials([solid, thin].map(MaterialKind::Principled));
    check("principled, regularized", &scene, regularized);
    if renders_all() {
        check("principled", &scene, |o| o);
    }
}

#[test]
fn gltf_materials() {
    let value = FloatParam::Value;
    let coated = GltfMaterial {
        base_colour: ORANGE,
        metallic: value(0.4),
        roughness: value(0.5),
        anisotropy: value(0.5),
        anisotropy_rotation_rad: 0.6,
        anisotropy_direction: None,
        ior: 1.5,
        specular: value(0.8),
        specular_colour: colour(0.9, 0.8, 0.7),
        transmission: value(0.0),
        volume: false,
        clearcoat: value(0.7),
        clearcoat_roughness: value(0.2),
        clearcoat_bump: None,
        sheen_colour: colour(0.3, 0.2, 0.4),
        sheen_roughness: value(0.5),
    };
    let clear = GltfMaterial {
        transmission: value(0.8),
        volume: true,
        metallic: value(0.0),
        roughness: value(0.3),
        clearcoat: value(0.0),
        ..coated
    };
    let scene = with_materials([coated, clear].map(MaterialKind::Gltf));
    check("glTF", &scene, |o| o);
    if renders_all() {
        check("glTF, regularized", &scene, regularized);
    }
}

#[test]
fn layers_between_which_light_walks() {
    let metal = "Material \"coatedconductor\" \"float interface.roughness\" 0.1 \"float conductor.roughness\" 0.3";
    let cloudy = "Material \"coateddiffuse\" \"rgb reflectance\" [0.2 0.5 0.1] \"float roughness\" 0.2 \"rgb albedo\" [0.6 0.4 0.2] \"float g\" 0.4 \"float thickness\" 0.4";
    check(
        "layers",
        &scene(&format!("{ROOM}{SKY}{}", orbs([metal, cloudy]))),
        |o| o,
    );
}
