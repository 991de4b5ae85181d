//! glTF's extensions as the renderer binds them: directions, coats, second coordinates, absorption.
#![allow(
    clippy::cast_possible_truncation,
    reason = "scenes are in single precision"
)]

mod common;

use common::*;
use core::f64::consts::PI;
use glam::{DMat4, DVec3};
use specula_bsdf::bsdf::{Gltf as GltfLobe, GltfParameters};
use specula_bsdf::math::vec3;
use specula_bsdf::{Bsdf, Frame, Rgb, Transport, Vec3};
use specula_render::Strategy;
use specula_scene::Image;
use specula_scene::scene::*;

fn gltf() -> GltfMaterial {
    let float = FloatParam::Value;
    GltfMaterial {
        base_colour: grey(0.5),
        metallic: float(1.0),
        roughness: float(0.5),
        anisotropy: float(0.0),
        anisotropy_rotation_rad: 0.0,
        anisotropy_direction: None,
        ior: 1.5,
        specular: float(1.0),
        specular_colour: ColourParam::WHITE,
        transmission: float(0.0),
        volume: false,
        clearcoat: float(0.0),
        clearcoat_roughness: float(0.0),
        clearcoat_bump: None,
        sheen_colour: grey(0.0),
        sheen_roughness: float(0.0),
    }
}

const TO_LIGHT: [f64; 3] = [0.36, 0.48, 0.8];

/// What a floor of a material sends to the camera under parallel light, its `(u, v)` being
/// `(x, y)`; `set` adds textures.
fn floor(material: GltfMaterial, set: impl FnOnce(&mut Scene)) -> f64 {
    let mut scene = lit_floor();
    let mesh = &mut scene.meshes[0];
    mesh.uvs = mesh.positions.iter().map(|p| [p[0], p[1]]).collect();
    mesh.normals = vec![[0.0, 0.0, 1.0]; 4];
    scene.materials[0].kind = MaterialKind::Gltf(material);
    set(&mut scene);
    scene.lights.push(Light::Distant {
        irradiance: Rgb::splat(1.0),
        to_light: TO_LIGHT,
        half_angle_deg: 0.0,
    });
    mean(&render(&scene, 4, 1, Strategy::Mis)).0
}

/// The same by the lobe itself, in a frame whose x axis is `angle` from +x.
fn expected(lobe: &GltfLobe<f64>, angle: f64) -> f64 {
    let frame = Frame::from_normal_tangent(Vec3::Z, vec3(angle.cos(), angle.sin(), 0.0));
    let [wo, wi] = [[3.0, 0.0, 3.0], TO_LIGHT].map(|v| frame.to_local(Vec3::from(v).normalize()));
    lobe.eval(wo, wi, Transport::Radiance).g
}

fn assert_near(what: &str, found: f64, expected: f64) {
    assert!(
        (found - expected).abs() < 2e-3 * expected.abs(),
        "{what}: {found} instead of {expected}"
    );
}

/// A picture of one colour, as no texture that could be folded.
fn picture(scene: &mut Scene, colour: [f32; 3], mapping: TextureMapping) -> TextureId {
    scene.images.push(Image {
        name: "colour".into(),
        width: 1,
        height: 1,
        pixels: vec![colour].into(),
    });
    scene.textures.push(Texture::Image {
        image: ImageId(scene.images.len() - 1),
        mapping,
        wrap: [Wrap::Repeat; 2],
        filter: Interpolation::Bilinear,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    });
    TextureId(scene.textures.len() - 1)
}

/// Red and green of a direction.
fn direction(angle: f64) -> [f32; 3] {
    [angle.cos(), angle.sin(), 0.0].map(|x| (0.5 * (x + 1.0)) as f32)
}

fn brushed(rotation: f64, direction: Option<TextureId>) -> GltfMaterial {
    GltfMaterial {
        roughness: FloatParam::Value(0.3),
        anisotropy: FloatParam::Value(0.8),
        anisotropy_rotation_rad: rotation as f32,
        anisotropy_direction: direction,
        ..gltf()
    }
}

#[test]
fn directions_of_textures_turn_brushed_metal_as_rotations_do() {
    let lobe = GltfLobe::new(GltfParameters {
        base_colour: Rgb::splat(0.5),
        roughness: 0.3,
        anisotropy: 0.8,
        ..GltfParameters::default()
    });
    let first = Some(TextureId(0));
    let (turn, more) = (0.7, 0.4);
    let [plain, turned, opposite] = [0.0, turn, -turn].map(|a| expected(&lobe, a));
    // The test can tell them apart.
    assert!((turned / plain - 1.0).abs() > 0.1 && (turned / opposite - 1.0).abs() > 0.1);
    let uv = TextureMapping::default();
    assert_near("none", floor(brushed(0.0, None), |_| ()), plain);
    assert_near("rotation", floor(brushed(turn, None), |_| ()), turned);
    let found = floor(brushed(0.0, first), |s| _ = picture(s, direction(turn), uv));
    assert_near("picture", found, turned);
    let constant = |s: &mut Scene| s.textures.push(Texture::Constant(direction(turn).into()));
    assert_near("constant", floor(brushed(0.0, first), constant), turned);
    let found = floor(brushed(more, first), |s| {
        _ = picture(s, direction(turn), uv)
    });
    assert_near("both", found, expected(&lobe, turn + more));
    let found = floor(brushed(turn, first), |s| {
        _ = picture(s, [0.5, 0.5, 1.0], uv)
    });
    assert_near("no direction", found, turned);
}

/// A mirrored u turns x round, a mirrored v turns y round; a mirrored world is a mirror's picture.
#[test]
fn directions_follow_the_coordinates() {
    let lobe = GltfLobe::new(GltfParameters {
        base_colour: Rgb::splat(0.5),
        roughness: 0.3,
        anisotropy: 0.8,
        ..GltfParameters::default()
    });
    let turn = 0.7;
    let material = brushed(0.0, Some(TextureId(0)));
    let mirrored = |along_u: f32, along_v: f32| {
        floor(material, |s| {
            picture(s, direction(turn), TextureMapping::default());
            let uvs = &mut s.meshes[0].uvs;
            uvs.iter_mut()
                .for_each(|uv| *uv = [along_u * uv[0], along_v * uv[1]]);
        })
    };
    assert_near("u", mirrored(-1.0, 1.0), expected(&lobe, PI - turn));
    assert_near("v", mirrored(1.0, -1.0), expected(&lobe, -turn));
    let tangents = |to_world: DMat4, tangent: [f32; 4]| {
        floor(material, |s| {
            picture(s, direction(turn), TextureMapping::default());
            s.meshes[0].tangents = vec![tangent; 4];
            s.shapes[0].to_world = to_world;
        })
    };
    // At 0.3 from +x, with either side.
    let (y, x) = 0.3_f32.sin_cos();
    let same = DMat4::IDENTITY;
    let found = tangents(same, [x, y, 0.0, 1.0]);
    assert_near("tangent", found, expected(&lobe, 0.3_f64 + turn));
    let found = tangents(same, [x, y, 0.0, -1.0]);
    assert_near("left-handed", found, expected(&lobe, 0.3_f64 - turn));
    let mirror = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
    let found = tangents(mirror, [x, y, 0.0, 1.0]);
    assert_near("mirrored", found, expected(&lobe, -0.3 - turn));
    let in_object = floor(material, |s| {
        picture(s, direction(turn), TextureMapping::default());
        s.meshes[0].tangents = vec![[x, y, 0.0, 1.0]; 4];
        s.objects.push(Object {
            name: "floor".into(),
            shapes: std::mem::take(&mut s.shapes),
        });
        s.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world: mirror,
            motion: None,
        });
    });
    assert_near("in an object", in_object, expected(&lobe, -0.3 - turn));
}

/// The tilted normal of a picture `(2 c - 1)`.
const TILTED: [f32; 3] = [0.66, 0.42, 0.94];

/// A coat over black is a rough mirror of 0.04 in the coat's own frame, whatever bends the base.
#[test]
fn coats_have_their_own_normals() {
    let coat = |bump| GltfMaterial {
        base_colour: grey(0.0),
        specular: FloatParam::Value(0.0),
        metallic: FloatParam::Value(0.0),
        clearcoat: FloatParam::Value(0.8),
        clearcoat_roughness: FloatParam::Value(0.6),
        clearcoat_bump: bump,
        ..gltf()
    };
    let by_formula = |n: Vec3<f64>| {
        let [wo, wi] = [[3.0, 0.0, 3.0], TO_LIGHT].map(|v| Vec3::from(v).normalize());
        let wm = (wo + wi).normalize();
        let [on, in_, mn] = [wo, wi, wm].map(|w| w.dot(n));
        let a2 = 0.36_f64.powi(2);
        let d = a2 / (PI * (mn * mn * (a2 - 1.0) + 1.0).powi(2));
        // Height-correlated: G2 / (4 on in), times the cosine.
        let root = |c: f64| (a2 + (1.0 - a2) * c * c).sqrt();
        let visible = 0.5 / (on * root(in_) + in_ * root(on));
        0.8 * (0.04 + 0.96 * (1.0 - on).powi(5)) * d * visible * in_
    };
    let tilted = TILTED.map(|c| 2.0 * f64::from(c) - 1.0);
    let (plain, bent) = (
        by_formula(Vec3::Z),
        by_formula(Vec3::from(tilted).normalize()),
    );
    assert!((bent / plain - 1.0).abs() > 0.2, "{bent} {plain}");
    let bump = Some(Bump::Normal {
        map: TextureId(0),
        scale: 1.0,
    });
    let with_map = |s: &mut Scene| _ = picture(s, TILTED, TextureMapping::default());
    assert_near("plain", floor(coat(None), |_| ()), plain);
    assert_near("bent", floor(coat(bump), with_map), bent);
    let base_bent = |s: &mut Scene| {
        with_map(s);
        s.materials[0].bump = bump;
    };
    assert_near("base bent", floor(coat(None), base_bent), plain);
    assert_near("both bent", floor(coat(bump), base_bent), bent);
}

#[test]
fn bent_coats_agree_by_all_strategies() {
    let mut scene = lit_floor();
    scene.camera = look([0.0, -2.5, 3.0], [0.0; 3], 6.0);
    picture(&mut scene, TILTED, TextureMapping::default());
    let mesh = &mut scene.meshes[0];
    mesh.uvs = mesh.positions.iter().map(|p| [p[0], p[1]]).collect();
    scene.materials[0].kind = MaterialKind::Gltf(GltfMaterial {
        clearcoat: FloatParam::Value(1.0),
        clearcoat_roughness: FloatParam::Value(0.5),
        clearcoat_bump: Some(Bump::Normal {
            map: TextureId(0),
            scale: 1.0,
        }),
        ..gltf()
    });
    let lamp = material(&mut scene, diffuse(0.0));
    let lamp = emitting(sphere(0.7, [0.0, 2.5, 3.0], lamp), 2.0);
    scene.shapes.push(lamp);
    let results = [
        (Strategy::Mis, 1024),
        (Strategy::LightsOnly, 1024),
        (Strategy::BsdfOnly, 4096),
    ]
    .map(|(strategy, spp)| mean(&render(&scene, spp, 3, strategy)));
    assert_agree("bent coat", &results, 0, 0.02);
}

#[test]
fn textures_take_the_set_of_coordinates_that_they_ask_for() {
    let lambert = GltfMaterial {
        metallic: FloatParam::Value(0.0),
        specular: FloatParam::Value(0.0),
        base_colour: ColourParam::Texture(TextureId(0)),
        ..gltf()
    };
    // A ramp over u: 0.2 at 0, 0.6 at 1. Where the camera looks, the first set is (0, 0), the
    // second (3/4, 0).
    let albedo = |mapping: TextureMapping, with_second: bool| {
        let found = floor(lambert, |s| {
            s.textures.push(Texture::Bilinear {
                corners: [0.2, 0.2, 0.6, 0.6].map(Rgb::splat),
                mapping,
            });
            let mesh = &mut s.meshes[0];
            if with_second {
                mesh.second_uvs = mesh.uvs.iter().map(|uv| [uv[0] + 0.75, uv[1]]).collect();
            }
        });
        found * PI / TO_LIGHT[2]
    };
    let half = UvMapping::scaled([0.5, 1.0], [0.0; 2]);
    let both = [TextureMapping::default(), TextureMapping::SecondUv(half)];
    assert_near("first", albedo(both[0], true), 0.2);
    assert_near("second", albedo(both[1], true), 0.2 + 0.4 * 0.375);
    assert_near("none", albedo(both[1], false), 0.2);
}

/// What passes a body without an index of its own: nothing bends, nothing is reflected.
fn clear_body() -> GltfMaterial {
    GltfMaterial {
        base_colour: grey(1.0),
        metallic: FloatParam::Value(0.0),
        roughness: FloatParam::Value(0.0),
        ior: 1.0,
        transmission: FloatParam::Value(1.0),
        volume: true,
        ..gltf()
    }
}

/// `exp(-sigma t)` through a clear slab; through glass, the series of its inner reflections, with
/// the same white sky on both sides.
#[test]
fn slabs_absorb_by_their_thickness() {
    let (sigma, thickness) = (0.4_f64, 1.7_f64);
    let passed = (-sigma * thickness).exp();
    let r = (0.5_f64 / 2.5).powi(2);
    let inner = (1.0 - r).powi(2) * passed / (1.0 - r * r * passed * passed);
    let glass_slab = r + inner * (1.0 + r * passed);
    let clear = MaterialKind::Gltf(clear_body());
    for (what, kind, expected) in [("clear", clear, passed), ("glass", glass(0.0), glass_slab)] {
        let mut scene = empty(look([0.0, 0.0, 9.0], [0.0; 3], 0.05), 8);
        let m = absorbing(&mut scene, kind, sigma as f32);
        body(&mut scene, 20.0, [0.0, thickness], m);
        scene.lights.push(constant_sky(1.0));
        for strategy in [Strategy::Mis, Strategy::BsdfOnly] {
            let picture = render(&scene, 4096, 64, strategy);
            assert_mean(what, &picture, expected, 1e-3);
        }
    }
}

/// A body within a body, and a clear one within an absorbing one: each absorbs where it is.
#[test]
fn medium_stack_within_medium_stack_absorb_where_they_are() {
    for (inner, expected) in [(0.5_f64, -0.2 * 3.0 - 0.5), (0.0, -0.2 * 3.0)] {
        let mut scene = empty(look([0.0, 0.0, 9.0], [0.0; 3], 0.05), 8);
        let clear = MaterialKind::Gltf(clear_body());
        let outer = absorbing(&mut scene, clear, 0.2);
        body(&mut scene, 20.0, [0.0, 4.0], outer);
        let inner = absorbing(&mut scene, clear, inner as f32);
        body(&mut scene, 20.0, [1.0, 2.0], inner);
        scene.lights.push(constant_sky(1.0));
        for strategy in [Strategy::Mis, Strategy::BsdfOnly] {
            let picture = render(&scene, 4096, 64, strategy);
            assert_mean("nested", &picture, f64::exp(expected), 1e-3);
        }
    }
}

/// In a white world, glass without absorption is at most white, and with it darker.
#[test]
fn absorbing_glass_keeps_within_the_furnace() {
    let seen = |absorption: f32, a: f32| {
        let mut scene = empty(look([0.0, -5.0, 0.0], [0.0; 3], 20.0), 8);
        let m = absorbing(&mut scene, glass(a), absorption);
        scene.shapes.push(sphere(1.0, [0.0; 3], m));
        scene.lights.push(constant_sky(1.0));
        [Strategy::Mis, Strategy::BsdfOnly].map(|s| mean(&render(&scene, 256, 100, s)))
    };
    for (clear, dark) in [0.0, 0.2].map(|a| (seen(0.0, a), seen(0.7, a))) {
        // Rough glass loses some.
        assert!(clear[0].0 > 0.8 && clear[0].0 < 1.0 + 1e-4, "{clear:?}");
        assert!(dark[0].0 < 0.7 * clear[0].0, "{dark:?} {clear:?}");
        assert_agree("absorbing glass", &dark, 0, 0.01);
    }
}

/// A lit floor within a body: shadow rays to lights inside lose light on their way, too.
#[test]
fn lights_within_a_body_are_dimmed_by_their_distance() {
    let (sigma, radius, height) = (0.3_f32, 0.5_f32, 2.0_f64);
    let mut scene = empty(look([1.5, 0.0, 9.0], [1.5, 0.0, 0.5], 0.05), 8);
    let m = absorbing(&mut scene, MaterialKind::Gltf(clear_body()), sigma);
    body(&mut scene, 5.0, [0.0, 4.0], m);
    let white = material(&mut scene, diffuse(0.5));
    let at = DMat4::from_translation(DVec3::new(0.0, 0.0, 0.5));
    let floor = square(&mut scene, 4.0, at, white);
    scene.shapes.push(floor);
    let lamp = material(&mut scene, diffuse(0.0));
    let centre = [0.0, 0.0, 0.5 + height];
    let with_lamp = Scene {
        shapes: [
            &scene.shapes[..],
            &[emitting(sphere(radius, centre, lamp), 3.0)],
        ]
        .concat(),
        ..scene.clone()
    };
    let results = [
        (Strategy::Mis, 1024),
        (Strategy::LightsOnly, 1024),
        (Strategy::BsdfOnly, 8192),
    ]
    .map(|(strategy, spp)| mean(&render(&with_lamp, spp, 4, strategy)));
    assert_agree("lamp in a body", &results, 0, 0.02);
    // A point: along the view 3.5 within the body, and the distance to the light.
    scene.lights.push(Light::Point {
        position: centre,
        intensity: Rgb::splat(1.0),
    });
    let distance = (1.5_f64.powi(2) + height * height).sqrt();
    let unabsorbed = 0.5 / PI * (height / distance) / (distance * distance);
    let expected = unabsorbed * (-f64::from(sigma) * (3.5 + distance)).exp();
    let picture = render(&scene, 256, 4, Strategy::Mis);
    assert_mean("point in a body", &picture, expected, 5e-3);
}
