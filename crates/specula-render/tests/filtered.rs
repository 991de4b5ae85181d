//! Filtered textures: a checkered floor to the horizon at few samples against many unfiltered ones, and where filters
//! must change nothing.

mod common;

use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;

use common::*;
use glam::DMat4;
use specula_bsdf::Rgb;
use specula_render::{MemoryEstimate, PreparedScene, RenderOptions, Renderer, TextureFilter};
use specula_scene::Image;
use specula_scene::scene::*;

const WIDTH: u32 = 64;
const HEIGHT: u32 = 48;

/// A floor with checks of one unit to the horizon, under parallel light: nothing but the texture makes noise.
fn floor(filter: Interpolation) -> Scene {
    let mut scene = empty(look([0.0, 1.0, 0.0], [0.0, 0.7, 1.0], 60.0), WIDTH);
    scene.film = Film::new([WIDTH, HEIGHT], Filter::Box { radius: [0.5; 2] });
    scene.camera.screen_window = [-4.0 / 3.0, 4.0 / 3.0, -1.0, 1.0];
    let reach = 400.0;
    let corners = [[-reach, 0.0], [reach, 0.0], [reach, reach], [-reach, reach]];
    scene.meshes.push(Mesh {
        positions: corners.map(|[x, z]: [f32; 2]| [x, 0.0, z]).to_vec(),
        // One picture of two by two checks.
        uvs: corners
            .map(|[x, z]| [0.5 * x + 0.1, 0.5 * z + 0.3])
            .to_vec(),
        triangles: vec![[0, 2, 1], [0, 3, 2]],
        ..Mesh::default()
    });
    let checks = (0..64 * 64).map(|i| {
        let odd = (i / 64 / 32 + i % 64 / 32) % 2 == 1;
        [if odd { 0.9 } else { 0.1 }; 3]
    });
    scene.images.push(Image {
        name: "checks".into(),
        width: 64,
        height: 64,
        pixels: checks.collect(),
    });
    scene.textures.push(Texture::Image {
        image: ImageId(0),
        mapping: TextureMapping::default(),
        wrap: [Wrap::Repeat; 2],
        filter,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    });
    scene.materials.push(Material::new(MaterialKind::Diffuse {
        reflectance: ColourParam::Texture(TextureId(0)),
        roughness: FloatParam::Value(0.0),
    }));
    let mesh = Geometry::Mesh(MeshId(0));
    scene
        .shapes
        .push(Shape::new(mesh, DMat4::IDENTITY, MaterialId(0)));
    scene.lights.push(Light::Distant {
        irradiance: Rgb::splat(core::f32::consts::PI),
        to_light: [0.0, 1.0, 0.0],
        half_angle_deg: 0.0,
    });
    scene
}

fn options(seed: u32, texture_filter: TextureFilter) -> RenderOptions {
    RenderOptions {
        seed,
        max_depth: 1,
        texture_filter,
        ..RenderOptions::default()
    }
}

/// The green of every pixel, from passes of so many samples.
fn green(scene: &Scene, options: RenderOptions, passes: &[u32]) -> Vec<f64> {
    let scene = PreparedScene::new(scene, &options).expect("the scene is sound");
    let mut renderer = Renderer::new(&scene, options);
    for &samples in passes {
        let report = renderer.render_pass(samples, &AtomicBool::new(false));
        assert_eq!(report.invalid_samples, 0);
    }
    let picture = renderer.film().picture();
    picture.colour.iter().map(|c| f64::from(c.g)).collect()
}

/// 4096 unfiltered samples of the floor.
fn reference() -> &'static [f64] {
    static REFERENCE: OnceLock<Vec<f64>> = OnceLock::new();
    REFERENCE.get_or_init(|| {
        let scene = floor(Interpolation::Bilinear);
        green(&scene, options(0, TextureFilter::Scene), &[4096])
    })
}

/// Root mean squares over the picture's lower rows, where the floor is: of the difference of the mean of many renders to
/// the reference, without what their noise adds to it, and of their noise.
fn bias_and_noise(scene: &Scene, filter: TextureFilter, spp: u32, reference: &[f64]) -> [f64; 2] {
    const RENDERS: u32 = 16;
    let renders: Vec<Vec<f64>> = (1..=RENDERS)
        .map(|seed| green(scene, options(seed, filter), &[spp]))
        .collect();
    let n = f64::from(RENDERS);
    let (mut bias, mut noise, mut pixels) = (0.0, 0.0, 0.0);
    for (i, expected) in reference.iter().enumerate() {
        if *expected == 0.0 {
            continue;
        }
        let mean = renders.iter().map(|r| r[i]).sum::<f64>() / n;
        let variance = renders.iter().map(|r| (r[i] - mean).powi(2)).sum::<f64>() / (n - 1.0);
        bias += (mean - expected).powi(2) - variance / n;
        noise += variance;
        pixels += 1.0;
    }
    assert!(pixels > 1500.0);
    [bias, noise].map(|sum| (sum.max(0.0) / pixels).sqrt())
}

/// Checks of 0.1 and 0.9: unfiltered, a sample deviates by up to 0.4.
#[test]
fn a_floor_to_the_horizon_has_less_noise_and_little_bias() {
    let scene = floor(Interpolation::EWA);
    let reference = reference();
    let [bilinear, trilinear, ewa] = [
        TextureFilter::Bilinear,
        TextureFilter::Trilinear,
        TextureFilter::Scene,
    ]
    .map(|filter| {
        let [few, more] = [4, 16].map(|spp| bias_and_noise(&scene, filter, spp, reference));
        eprintln!("{filter}: 4 samples {few:.4?}, 16 samples {more:.4?}");
        [few, more]
    });
    let whole = |[bias, noise]: [f64; 2]| bias.hypot(noise);
    for (i, most) in [(0, 0.026), (1, 0.011)] {
        assert!(bilinear[i][0] < 0.004, "unfiltered, nothing is biased");
        assert!(ewa[i][0] < most, "bias");
        assert!(ewa[i][0] < 0.5 * trilinear[i][0], "squares blur");
        assert!(ewa[i][1] < 0.4 * bilinear[i][1], "noise");
        assert!(trilinear[i][1] < 0.4 * bilinear[i][1], "noise");
        assert!(whole(ewa[i]) < 0.5 * whole(bilinear[i]), "both");
    }
}

/// What filters blur falls with the number of samples.
#[test]
fn bias_falls_with_the_number_of_samples() {
    let scene = floor(Interpolation::EWA);
    let reference = reference();
    let error = |spp: u32| {
        let found = green(&scene, options(1, TextureFilter::Scene), &[spp]);
        let squares = found.iter().zip(reference).map(|(a, b)| (a - b).powi(2));
        (squares.sum::<f64>() / reference.len() as f64).sqrt()
    };
    let [few, many] = [16, 1024].map(error);
    eprintln!("{few:.4} {many:.4}");
    assert!(many < 0.4 * few, "{few} {many}");
}

/// Adds a mirror, glass and a lamp over the floor: cones spread at every kind of bounce.
fn furnished(filter: Interpolation) -> Scene {
    let mut scene = floor(filter);
    let mirror = material(&mut scene, mirror_metal(0.0));
    let rough = material(&mut scene, mirror_metal(0.2));
    let pane = material(&mut scene, glass(0.0));
    let wall = material(&mut scene, diffuse(0.6));
    for (material, x) in [(mirror, -1.5), (rough, 0.0), (pane, 1.5)] {
        scene.shapes.push(sphere(0.6, [x, 0.6, 4.0], material));
    }
    let wall = square(
        &mut scene,
        3.0,
        DMat4::from_translation([0.0, 0.0, 9.0].into()),
        wall,
    );
    scene.shapes.push(wall);
    scene.lights.push(constant_sky(0.3));
    scene
}

#[test]
fn pictures_do_not_depend_on_threads_passes_and_plans() {
    let scene = furnished(Interpolation::EWA);
    let run = |threads: usize, planned: u32, passes: &[u32]| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads are to be had");
        let options = RenderOptions {
            samples_per_pixel: planned,
            max_depth: 6,
            ..options(3, TextureFilter::Scene)
        };
        pool.install(|| green(&scene, options, passes))
    };
    let expected = run(1, 12, &[12]);
    assert!(expected == run(3, 12, &[5, 7]));
    assert!(expected == run(2, 100, &[1, 11]));
    let unfiltered = furnished(Interpolation::Bilinear);
    let other = green(&unfiltered, options(3, TextureFilter::Scene), &[12]);
    assert!(expected != other);
}

/// Constant pictures, however they are filtered, are constants.
#[test]
fn constant_pictures_are_rendered_as_constants() {
    let picture = |filter| {
        let mut scene = furnished(filter);
        scene.images[0].pixels = vec![[0.5; 3]; 64 * 64].into();
        let options = RenderOptions {
            max_depth: 4,
            ..options(5, TextureFilter::Scene)
        };
        green(&scene, options, &[8])
    };
    let expected = picture(Interpolation::Bilinear);
    for filter in [Interpolation::Trilinear, Interpolation::EWA] {
        let found = picture(filter);
        for (f, e) in found.iter().zip(&expected) {
            assert!(
                (f - e).abs() < 1e-4 * e.abs() + 1e-6,
                "{filter:?}: {f} and {e}"
            );
        }
    }
}

/// Two scenes that differ in what the option says are one where it says the same.
#[test]
fn the_option_overrules_the_scene() {
    let [a, b] = [Interpolation::Bilinear, Interpolation::Trilinear].map(furnished);
    for filter in [
        TextureFilter::Bilinear,
        TextureFilter::Trilinear,
        TextureFilter::Ewa,
    ] {
        let [a, b] = [&a, &b].map(|scene| green(scene, options(1, filter), &[4]));
        assert!(a == b, "{filter}");
    }
    let nearest = furnished(Interpolation::Nearest);
    let [a, b] = [TextureFilter::Scene, TextureFilter::Ewa]
        .map(|filter| green(&nearest, options(1, filter), &[4]));
    assert!(a == b, "nearest pixels stay");
    assert_ne!(
        options(1, TextureFilter::Ewa).settings(),
        options(1, TextureFilter::Scene).settings()
    );
}

/// Shaders filter over footprints, and leave that out of scenes without.
#[test]
fn shaders_are_told_whether_textures_are_filtered() {
    let told = |filter| {
        let options = options(1, filter);
        let scene = PreparedScene::new(&floor(Interpolation::EWA), &options);
        let scene = scene.expect("the scene is sound");
        let flat = scene.flatten();
        assert_eq!(flat.missing, [""; 0]);
        flat.constant("TEXTURES_ARE_FILTERED")
    };
    assert_eq!(told(TextureFilter::Bilinear), Some(0));
    assert_eq!(told(TextureFilter::Scene), Some(1));
}

/// Levels of 32 x 32 pixels to 1, of three floats.
#[test]
fn pyramids_are_counted() {
    let textures =
        |filter| MemoryEstimate::new(&floor(Interpolation::EWA), &options(1, filter), 1).textures;
    let pyramid = textures(TextureFilter::Scene) - textures(TextureFilter::Bilinear);
    assert_eq!(pyramid, 12 * (1024 + 256 + 64 + 16 + 4 + 1));
    assert_eq!(
        textures(TextureFilter::Trilinear),
        textures(TextureFilter::Ewa)
    );
}
