//! Normal maps filtered into roughness: a metal floor under the sun, seen from afar, against many samples of the
//! normals themselves, and where the option must change nothing.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use glam::DMat4;
use specula_bsdf::Rgb;
use specula_bsdf::math::Stream;
use specula_render::{MemoryEstimate, PreparedScene, RenderOptions, Renderer, TextureFilter};
use specula_scene::scene::*;
use specula_scene::{Energy, Image};

const WIDTH: u32 = 32;
const HEIGHT: u32 = 24;
const SIDE: u32 = 64;
/// Repetitions of the normal map in a unit of length: three or more in a pixel.
const TILES: f32 = 12.0;

/// A periodic normal map: waves along many directions, steeper along u than along v, in bytes as files have them.
fn waves() -> Image {
    let mut random = Stream::new(3);
    let waves: Vec<[f32; 4]> = (0..24)
        .map(|_| {
            let u = |r: &mut Stream| (7.0 * r.next::<f32>()).floor() - 3.0;
            let [a, b] = [u(&mut random) + 2.0, u(&mut random)];
            let phase = random.next::<f32>() * core::f32::consts::TAU;
            [a, b, phase, 0.05 / (a * a + b * b).sqrt().max(1.0)]
        })
        .collect();
    let pixel = |i: u32| {
        let [x, y] = [i % SIDE, i / SIDE].map(|k| (k as f32 + 0.5) / SIDE as f32);
        let mut slope = [0.0; 2];
        for [a, b, phase, height] in &waves {
            let turn = core::f32::consts::TAU * (a * x + b * y) + phase;
            slope[0] += 1.5 * height * a * turn.cos();
            slope[1] += 0.7 * height * b * turn.cos();
        }
        let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
        [slope[0], slope[1], 1.0].map(|n| (255.0 * (0.5 + 0.5 * n / length)).round() / 255.0)
    };
    Image {
        name: "waves".into(),
        width: SIDE,
        height: SIDE,
        pixels: (0..SIDE * SIDE).map(pixel).collect(),
    }
}

/// A floor of metal with waves, under the sun.
fn floor(kind: MaterialKind, filter: Interpolation, bump: bool) -> Scene {
    let mut scene = empty(look([0.0, 4.0, 0.0], [0.0, 0.0, 4.0], 40.0), WIDTH);
    scene.film = Film::new([WIDTH, HEIGHT], Filter::Box { radius: [0.5; 2] });
    scene.camera.screen_window = [-4.0 / 3.0, 4.0 / 3.0, -1.0, 1.0];
    let reach = 60.0;
    let corners = [[-reach, 0.0], [reach, 0.0], [reach, reach], [-reach, reach]];
    scene.meshes.push(Mesh {
        positions: corners.map(|[x, z]: [f32; 2]| [x, 0.0, z]).to_vec(),
        uvs: corners.map(|c| c.map(|x| TILES * x + 0.1)).to_vec(),
        triangles: vec![[0, 2, 1], [0, 3, 2]],
        ..Mesh::default()
    });
    scene.images.push(waves());
    scene.textures.push(Texture::Image {
        image: ImageId(0),
        mapping: TextureMapping::default(),
        wrap: [Wrap::Repeat; 2],
        filter,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    });
    let m = material(&mut scene, kind);
    scene.materials[m.0].bump = bump.then_some(Bump::Normal {
        map: TextureId(0),
        scale: 1.0,
    });
    let mesh = Geometry::Mesh(MeshId(0));
    scene.shapes.push(Shape::new(mesh, DMat4::IDENTITY, m));
    scene.lights.push(Light::Distant {
        irradiance: Rgb::splat(1.0),
        to_light: [0.1, 1.0, 1.0],
        half_angle_deg: 0.0,
    });
    scene
}

fn metal(alphas: [f32; 2], distribution: MicrofacetDistribution) -> MaterialKind {
    let [u, v] = alphas.map(FloatParam::Value);
    MaterialKind::Conductor {
        fresnel: ConductorFresnel::Mirror,
        roughness: Roughness {
            u,
            v,
            distribution,
            ..alpha(0.0)
        },
        tint: ColourParam::WHITE,
    }
}

fn principled(roughness: f32) -> MaterialKind {
    let none = FloatParam::Value(0.0);
    MaterialKind::Principled(PrincipledMaterial {
        base_colour: ColourParam::WHITE,
        roughness: FloatParam::Value(roughness),
        anisotropic: none,
        metallic: FloatParam::Value(1.0),
        spec_trans: none,
        eta: 1.5,
        spec_tint: none,
        sheen: none,
        sheen_tint: none,
        clearcoat: none,
        clearcoat_gloss: none,
        flatness: none,
        diff_trans: none,
        thin: false,
    })
}

/// White metal.
fn gltf(roughness: f32) -> GltfMaterial {
    let none = FloatParam::Value(0.0);
    GltfMaterial {
        base_colour: ColourParam::WHITE,
        metallic: FloatParam::Value(1.0),
        roughness: FloatParam::Value(roughness),
        anisotropy: none,
        anisotropy_rotation_rad: 0.0,
        anisotropy_direction: None,
        ior: 1.5,
        specular: FloatParam::Value(1.0),
        specular_colour: ColourParam::WHITE,
        transmission: none,
        volume: false,
        clearcoat: none,
        clearcoat_roughness: none,
        clearcoat_bump: None,
        sheen_colour: grey(0.0),
        sheen_roughness: none,
    }
}

fn options(seed: u32, texture_filter: TextureFilter, filter_normal_maps: bool) -> RenderOptions {
    RenderOptions {
        seed,
        max_depth: 1,
        energy: Energy::None,
        texture_filter,
        filter_normal_maps,
        ..RenderOptions::default()
    }
}

/// The green of every pixel.
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

/// Root of the mean square difference, over the root of the mean square of the reference.
fn error(found: &[f64], reference: &[f64]) -> f64 {
    let squares = found.iter().zip(reference).map(|(f, r)| (f - r).powi(2));
    let size: f64 = reference.iter().map(|r| r * r).sum();
    (squares.sum::<f64>() / size).sqrt()
}

/// Errors at 16 samples against 1024 of the normals themselves: of
/// averaged normals, and of normals filtered into roughness.
fn errors(kind: MaterialKind) -> [f64; 2] {
    let scene = floor(kind, Interpolation::Bilinear, true);
    let reference = green(&scene, options(0, TextureFilter::Bilinear, false), &[1024]);
    [false, true].map(|filters| {
        let found = green(&scene, options(1, TextureFilter::Ewa, filters), &[16]);
        error(&found, &reference)
    })
}

#[test]
fn a_floor_from_afar_has_the_highlight_of_its_normals() {
    use MicrofacetDistribution::{Beckmann, Ggx};
    let mut wrong = Vec::new();
    for (name, kind) in [
        ("Beckmann", metal([0.06; 2], Beckmann)),
        ("Beckmann, anisotropic", metal([0.04, 0.15], Beckmann)),
        ("GGX", metal([0.06; 2], Ggx)),
        ("principled", principled(0.25)),
        ("glTF", MaterialKind::Gltf(gltf(0.25))),
    ] {
        let [averaged, filtered] = errors(kind);
        eprintln!("{name}: averaged normals {averaged:.3}, filtered into roughness {filtered:.3}");
        if !(filtered < 0.25 && filtered < 0.15 * averaged) {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Of a smooth metal nothing reflects a sun without extent; seen from afar its normals do.
#[test]
fn smooth_metal_becomes_rough_from_afar() {
    let kind = metal([0.0; 2], MicrofacetDistribution::Beckmann);
    let scene = floor(kind, Interpolation::EWA, true);
    let [without, with] =
        [false, true].map(|f| green(&scene, options(2, TextureFilter::Scene, f), &[4]));
    assert!(without.iter().all(|v| *v == 0.0));
    let mean = with.iter().sum::<f64>() / with.len() as f64;
    // Hardly rough metal, unfiltered, is dark between its sparks.
    let kind = metal([0.02; 2], MicrofacetDistribution::Beckmann);
    let hardly_rough = floor(kind, Interpolation::Bilinear, true);
    let expected = green(
        &hardly_rough,
        options(0, TextureFilter::Scene, false),
        &[1024],
    );
    let expected = expected.iter().sum::<f64>() / expected.len() as f64;
    assert!(
        (mean - expected).abs() < 0.1 * expected,
        "{mean} {expected}"
    );
}

#[test]
fn pictures_do_not_depend_on_threads_and_passes() {
    let scene = floor(
        metal([0.0; 2], MicrofacetDistribution::Ggx),
        Interpolation::EWA,
        true,
    );
    let run = |threads: usize, passes: &[u32]| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.expect("threads are to be had");
        pool.install(|| green(&scene, options(3, TextureFilter::Scene, true), passes))
    };
    let expected = run(1, &[12]);
    assert!(expected == run(3, &[5, 7]));
}

/// Maps that are magnified, nearest pixels, and scenes without normal maps.
#[test]
fn where_nothing_is_averaged_nothing_changes() {
    let kind = metal([0.1; 2], MicrofacetDistribution::Ggx);
    let same = |scene: &Scene, what: &str| {
        let [without, with] =
            [false, true].map(|f| green(scene, options(4, TextureFilter::Scene, f), &[4]));
        assert!(without == with, "{what}");
        assert!(without.iter().any(|v| *v > 0.0), "{what}");
    };
    let mut magnified = floor(kind, Interpolation::EWA, true);
    for uv in &mut magnified.meshes[0].uvs {
        *uv = uv.map(|x| x * 1e-6);
    }
    same(&magnified, "magnified");
    same(&floor(kind, Interpolation::Nearest, true), "nearest");
    same(&floor(kind, Interpolation::EWA, false), "no normal map");
}

/// A map of one normal, filtered or not, is a plane.
#[test]
fn flat_maps_stay_flat() {
    let kind = metal([0.1; 2], MicrofacetDistribution::Ggx);
    let mut flat = floor(kind, Interpolation::EWA, true);
    flat.images[0].pixels = vec![[0.5, 0.5, 1.0]; (SIDE * SIDE) as usize].into();
    let plane = floor(kind, Interpolation::EWA, false);
    let [found, expected] =
        [flat, plane].map(|s| green(&s, options(4, TextureFilter::Scene, true), &[4]));
    assert!(error(&found, &expected) < 1e-5);
}

/// The option is part of what makes films differ, and its pictures are counted.
#[test]
fn the_option_is_a_setting_that_takes_memory() {
    let [without, with] = [false, true].map(|f| options(0, TextureFilter::Scene, f));
    assert_ne!(without.settings(), with.settings());
    let kind = metal([0.1; 2], MicrofacetDistribution::Ggx);
    let scene = floor(kind, Interpolation::Bilinear, true);
    let [without, with] =
        [without, with].map(|options| MemoryEstimate::new(&scene, &options, 1).textures);
    // Two pictures of three floats, of 64 x 64 pixels to 1.
    assert_eq!(with - without, 24 * (4096 + 1024 + 256 + 64 + 16 + 4 + 1));
}

/// A clear coat has a normal map of its own, and grows rough by it alone.
#[test]
fn clear_coats_grow_rough_by_their_own_map() {
    let kind = MaterialKind::Gltf(GltfMaterial {
        base_colour: grey(0.0),
        clearcoat: FloatParam::Value(1.0),
        clearcoat_roughness: FloatParam::Value(0.2),
        clearcoat_bump: Some(Bump::Normal {
            map: TextureId(0),
            scale: 1.0,
        }),
        ..gltf(1.0)
    });
    let scene = floor(kind, Interpolation::Bilinear, false);
    let reference = green(&scene, options(0, TextureFilter::Bilinear, false), &[1024]);
    let [averaged, filtered] = [false, true].map(|f| {
        let found = green(&scene, options(1, TextureFilter::Ewa, f), &[4]);
        error(&found, &reference)
    });
    eprintln!("averaged normals {averaged:.3}, filtered into roughness {filtered:.3}");
    // It has one alpha for both axes.
    assert!(
        filtered < 0.6 && filtered < 0.25 * averaged,
        "{filtered} {averaged}"
    );
}
