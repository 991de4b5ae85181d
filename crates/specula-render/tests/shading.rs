//! What bends, turns or blackens surfaces, against closed forms.

mod common;

use common::*;
use core::f64::consts::PI;
use glam::{DMat4, DVec3};
use specula_bsdf::{Rgb, Vec3};
use specula_render::Strategy;
use specula_render::picture::Picture;
use specula_scene::Image;
use specula_scene::scene::*;

/// A white floor under parallel light from `to_light`, bent by `bump`: its coordinates are
/// `(x, y) scale`. Returns the mean over the albedo and pi: the cosine at the bent normal.
fn cosine(bump: Option<Bump>, set: impl FnOnce(&mut Scene), to_light: [f64; 3]) -> f64 {
    let mut scene = lit_floor();
    let mesh = &mut scene.meshes[0];
    mesh.uvs = mesh
        .positions
        .iter()
        .map(|p| [p[0] + 3.0, 2.0 * p[1] - 1.0])
        .collect();
    set(&mut scene);
    scene.materials[0].bump = bump;
    scene.lights.push(Light::Distant {
        irradiance: Rgb::splat(1.0),
        to_light,
        half_angle_deg: 0.0,
    });
    mean(&render(&scene, 4, 1, Strategy::Mis)).0 * PI / 0.5
}

/// Heights linear in u and v: `h = a u + b v`, by a bilinear patch.
fn slope(scene: &mut Scene, a: f32, b: f32) -> Bump {
    scene.textures.push(Texture::Bilinear {
        corners: [0.0, b, a, a + b].map(Rgb::splat),
        mapping: TextureMapping::default(),
    });
    Bump::Height(FloatParam::Texture(TextureId(scene.textures.len() - 1)))
}

const LIGHT: [f64; 3] = [0.48, 0.36, 0.8];

fn assert_near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() < 2e-3,
        "{found} instead of {expected}"
    );
}

/// `z = a u + b v` with `u = x + 3`, `v = 2 y - 1`: the plane's normal is `(-a, -2 b, 1)`.
#[test]
fn heights_turn_the_normal_by_their_slope_in_the_scenes_unit() {
    for (a, b) in [(0.0, 0.0), (0.3, 0.0), (0.0, 0.2), (-0.25, 0.15)] {
        let bump = slope(&mut lit_floor(), a, b);
        let sloped = |s: &mut Scene| {
            slope(s, a, b);
        };
        let found = cosine(Some(bump), sloped, LIGHT);
        let n = DVec3::new(-f64::from(a), -2.0 * f64::from(b), 1.0).normalize();
        assert_near(found, n.dot(LIGHT.into()));
    }
}

/// The same through a mirrored and scaled transform, an instance, and a reversed orientation seen
/// from below: what is bent is the surface in the world.
#[test]
fn transforms_carry_bumps_along() {
    let (a, b) = (0.3, 0.2);
    let bump = slope(&mut lit_floor(), a, b);
    // x' = -2 x, z' = z: the slope along x' is -a / 2; heights are in world units.
    let m = DMat4::from_scale(DVec3::new(-2.0, 1.0, 1.0));
    let n = DVec3::new(0.15, -0.4, 1.0).normalize();
    let on_shape = |s: &mut Scene| {
        slope(s, a, b);
        s.shapes[0].to_world = m;
    };
    assert_near(cosine(Some(bump), on_shape, LIGHT), n.dot(LIGHT.into()));
    let in_object = |s: &mut Scene| {
        slope(s, a, b);
        s.objects.push(Object {
            name: "floor".into(),
            shapes: std::mem::take(&mut s.shapes),
        });
        s.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world: m,
            motion: None,
        });
    };
    assert_near(cosine(Some(bump), in_object, LIGHT), n.dot(LIGHT.into()));
    // Reversed, the outside is below, and heights go down.
    let reversed = |s: &mut Scene| {
        slope(s, a, b);
        s.shapes[0].reverse_orientation = true;
    };
    let n = DVec3::new(0.3, 0.4, 1.0).normalize();
    assert_near(cosine(Some(bump), reversed, LIGHT), n.dot(LIGHT.into()));
}

/// Normals interpolated over the floor, tilted along x: heights bend the tilted ones.
#[test]
fn heights_bend_interpolated_normals() {
    let bump = slope(&mut lit_floor(), 0.0, 0.2);
    let tilted = |s: &mut Scene| {
        slope(s, 0.0, 0.2);
        s.meshes[0].normals = vec![[0.6, 0.0, 0.8]; 4];
    };
    // dp/du and dp/dv made perpendicular: (0.8, 0, -0.6) 0.8 and (0, 1/2, 0); the slope of 0.2 in v
    // moves dp/dv by 0.2 n.
    let n = DVec3::new(0.6, 0.0, 0.8);
    let dv = DVec3::new(0.0, 0.5, 0.0) + n * 0.2;
    let bent = DVec3::new(0.8, 0.0, -0.6).cross(dv).normalize();
    assert_near(cosine(Some(bump), tilted, LIGHT), bent.dot(LIGHT.into()));
}

/// A height that does not vary over a sphere leaves its normals alone; one that rises with v tilts
/// them towards the poles by `dh/dv / (pi (r + h))`.
#[test]
fn spheres_take_heights_by_their_own_coordinates() {
    let radius = 2.0;
    for (a, b) in [(0.0, 0.0), (0.0, 3.0), (2.0, 0.0)] {
        // Seen next to (2, 0, 0), where u = 0 and v = 1/2.
        let mut scene = empty(look([5.0, 0.002, 0.0], [2.0, 0.002, 0.0], 0.05), 2);
        let m = material(&mut scene, diffuse(1.0));
        scene.shapes.push(sphere(radius, [0.0; 3], m));
        let bump = slope(&mut scene, a, b);
        scene.materials[0].bump = Some(bump);
        let to_light = DVec3::new(0.64, 0.48, 0.6);
        scene.lights.push(Light::Distant {
            irradiance: Rgb::splat(1.0),
            to_light: to_light.to_array(),
            half_angle_deg: 0.0,
        });
        let found = mean(&render(&scene, 4, 1, Strategy::Mis)).0 * PI;
        let (a, b) = (f64::from(a), f64::from(b));
        let reach = f64::from(radius) + 0.5 * b;
        let n = DVec3::new(1.0, -a / (2.0 * PI * reach), -b / (PI * reach)).normalize();
        assert_near(found, n.dot(to_light));
    }
}

/// A normal map of one colour tilts everywhere alike, in the frame of dp/du and dp/dv.
#[test]
fn normal_maps_tilt_along_the_coordinates() {
    let tilt = [0.6_f32, 0.3, (1.0_f32 - 0.45).sqrt()];
    let map = |s: &mut Scene| {
        s.textures
            .push(Texture::Constant(Rgb::from(tilt.map(|v| 0.5 * (v + 1.0)))));
    };
    let bump = |scale| {
        Some(Bump::Normal {
            map: TextureId(0),
            scale,
        })
    };
    let n = DVec3::from(tilt.map(f64::from));
    assert_near(cosine(bump(1.0), map, LIGHT), n.dot(LIGHT.into()));
    let flat = DVec3::new(0.5 * n.x, 0.5 * n.y, n.z).normalize();
    assert_near(cosine(bump(0.5), map, LIGHT), flat.dot(LIGHT.into()));
    // Coordinates that run the other way along x: the map follows.
    let mirrored = |s: &mut Scene| {
        map(s);
        for uv in &mut s.meshes[0].uvs {
            uv[0] = -uv[0];
        }
    };
    let across = DVec3::new(-n.x, n.y, n.z);
    assert_near(cosine(bump(1.0), mirrored, LIGHT), across.dot(LIGHT.into()));
    // Coordinates turned by 90 degrees.
    let turned = |s: &mut Scene| {
        map(s);
        for uv in &mut s.meshes[0].uvs {
            *uv = [uv[1], -uv[0]];
        }
    };
    let quarter = DVec3::new(-n.y, n.x, n.z);
    assert_near(cosine(bump(1.0), turned, LIGHT), quarter.dot(LIGHT.into()));
}

/// A white sphere of rough metal with waves on it in a uniform sky: never brighter than the sky,
/// never black.
#[test]
fn wavy_metal_neither_emits_nor_blackens() {
    let mut scene = empty(look([0.0, 0.0, -4.0], [0.0; 3], 26.0), 24);
    let m = material(&mut scene, mirror_metal(0.3));
    scene.textures.push(Texture::Noise {
        kind: NoiseKind::Fbm,
        octaves: 3,
        roughness: 0.5,
        to_texture: DMat4::from_scale(DVec3::splat(4.0)),
    });
    scene.textures.push(Texture::Constant(Rgb::splat(0.1)));
    scene.textures.push(Texture::Scale {
        a: TextureId(0),
        b: TextureId(1),
    });
    scene.materials[0].bump = Some(Bump::Height(FloatParam::Texture(TextureId(2))));
    scene.shapes.push(sphere(1.0, [0.0; 3], m));
    scene.lights.push(constant_sky(1.0));
    let picture = render(&scene, 64, 1, Strategy::Mis);
    for (i, c) in picture.colour.iter().enumerate() {
        let error = f64::from(picture.variance[i].g).sqrt();
        assert!(c.g > 0.02, "pixel {i}: {}", c.g);
        assert!(f64::from(c.g) < 1.002 + 5.0 * error, "pixel {i}: {}", c.g);
    }
    scene.materials[0].bump = None;
    let round = render(&scene, 64, 1, Strategy::Mis);
    let differs = |(a, b): (&Vec3<f32>, &Vec3<f32>)| (*a - *b).length() > 0.1;
    let bent = picture
        .normal
        .iter()
        .zip(&round.normal)
        .filter(|&p| differs(p));
    assert!(bent.count() > 100);
}

/// Anisotropic metal: its highlight is as wide along one tangent as it is narrow along the other. A
/// rotation by 90 degrees is the exchange of the alphas, whichever way the coordinates run, and one
/// by an angle is the turn of the whole floor.
#[test]
fn rotation_turns_the_alphas() {
    let seen = |u: f32, v: f32, rotation: f32, turn: f64, flip: f32| {
        let mut scene = lit_floor();
        scene.camera = look([0.0, -3.0, 3.0], [0.0; 3], 0.05);
        let mesh = &mut scene.meshes[0];
        mesh.uvs = mesh.positions.iter().map(|p| [p[0], flip * p[1]]).collect();
        scene.shapes[0].to_world = DMat4::from_rotation_z(turn);
        scene.materials[0].kind = MaterialKind::Conductor {
            fresnel: ConductorFresnel::Mirror,
            roughness: Roughness {
                v: FloatParam::Value(v),
                rotation_rad: rotation,
                ..alpha(u)
            },
            tint: ColourParam::WHITE,
        };
        scene.lights.push(Light::Distant {
            irradiance: Rgb::splat(1.0),
            to_light: DVec3::new(0.3, 0.8, 0.6).normalize().to_array(),
            half_angle_deg: 0.0,
        });
        mean(&render(&scene, 4, 1, Strategy::Mis)).0
    };
    let plain = seen(0.5, 0.1, 0.0, 0.0, 1.0);
    let exchanged = seen(0.1, 0.5, 0.0, 0.0, 1.0);
    assert!(plain > 3.0 * exchanged || exchanged > 3.0 * plain);
    let quarter = 0.5 * core::f32::consts::PI;
    for (found, expected) in [
        (seen(0.5, 0.1, quarter, 0.0, 1.0), exchanged),
        (seen(0.5, 0.1, quarter, 0.0, -1.0), exchanged),
        (seen(0.5, 0.1, 0.4, 0.0, 1.0), seen(0.5, 0.1, 0.0, 0.4, 1.0)),
        // From u towards v, which runs along -y here.
        (
            seen(0.5, 0.1, 0.4, 0.0, -1.0),
            seen(0.5, 0.1, 0.0, -0.4, 1.0),
        ),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }
}

/// From behind, a one-sided material takes all light; from the front it is itself.
#[test]
fn one_sided_materials_are_black_from_behind() {
    for reversed in [false, true] {
        let check = |picture: &Picture| {
            if reversed {
                assert_eq!(mean(picture).0, 0.0);
            } else {
                assert_mean("one-sided", picture, 0.5, 1e-3);
            }
        };
        let mut scene = lit_floor();
        scene.materials[0].one_sided = true;
        scene.shapes[0].reverse_orientation = reversed;
        scene.lights.push(constant_sky(1.0));
        let picture = render(&scene, 256, 3, Strategy::Mis);
        check(&picture);
        // Within a mix too.
        let mix = MaterialKind::Mix {
            materials: [MaterialId(0), MaterialId(0)],
            amount: FloatParam::Value(0.5),
        };
        scene.shapes[0].material = material(&mut scene, mix);
        let picture = render(&scene, 256, 3, Strategy::Mis);
        check(&picture);
    }
}

/// Half of the pixels of a mask in an object: half of the light passes, in shadows and in view.
#[test]
fn masks_by_threshold_let_their_share_through() {
    let mut scene = lit_floor();
    let black = material(&mut scene, diffuse(0.0));
    let (columns, rows) = (64_u32, 64_u32);
    scene.images.push(Image {
        name: "mask".into(),
        width: columns,
        height: rows,
        pixels: (0..columns * rows)
            .map(|i| [if (i + i / columns) % 2 == 0 { 0.9 } else { 0.1 }; 3])
            .collect(),
    });
    scene.textures.push(Texture::Image {
        image: ImageId(0),
        mapping: TextureMapping::default(),
        wrap: [Wrap::Repeat; 2],
        filter: Interpolation::Nearest,
        invert: false,
        scale: 1.0,
        channel: Channel::Red,
    });
    scene.textures.push(Texture::Threshold {
        texture: TextureId(0),
        cutoff: 0.5,
    });
    let mut leaf = square(&mut scene, 40.0, DMat4::IDENTITY, black);
    scene.meshes[1].uvs = vec![[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]];
    leaf.alpha = FloatParam::Texture(TextureId(1));
    scene.objects.push(Object {
        name: "leaf".into(),
        shapes: vec![leaf],
    });
    scene.instances.push(ObjectInstance {
        object: ObjectId(0),
        to_world: DMat4::from_translation(DVec3::new(0.0, 0.0, 1.0)),
        motion: None,
    });
    // Below the leaf.
    scene.camera = look([0.7, 0.0, 0.7], [0.0; 3], 0.05);
    scene.lights.push(constant_sky(1.0));
    let picture = render(&scene, 4096, 1, Strategy::Mis);
    assert_mean("below the mask", &picture, 0.25, 1e-2);
    let by_lobes = render(&scene, 4096, 1, Strategy::BsdfOnly);
    assert_mean("below the mask, by lobes", &by_lobes, 0.25, 1e-2);
    // From above, half of the leaf is seen.
    scene.camera = look([0.0, 0.0, 30.0], [0.0; 3], 20.0);
    scene.shapes.clear();
    scene.lights.clear();
    scene.lights.push(constant_sky(1.0));
    let picture = render(&scene, 1024, 1, Strategy::Mis);
    assert_mean("the mask", &picture, 0.5, 1e-2);
}

/// Colours at the corners, interpolated over the floor.
#[test]
fn vertex_colours_are_interpolated_and_white_where_there_are_none() {
    let mut scene = lit_floor();
    scene.textures.push(Texture::VertexColour);
    scene.materials[0].kind = MaterialKind::Diffuse {
        reflectance: ColourParam::Texture(TextureId(0)),
        roughness: FloatParam::Value(0.0),
    };
    scene.lights.push(constant_sky(1.0));
    let white = render(&scene, 1024, 1, Strategy::Mis);
    assert_mean("white", &white, 1.0, 2e-3);
    // The camera sees the middle of the diagonal between the first and the third corner.
    scene.meshes[0].colours = [0.1, 0.9, 0.4, 0.9].map(|v| [v; 3]).to_vec();
    let seen = render(&scene, 1024, 1, Strategy::Mis);
    assert_mean("coloured", &seen, 0.25, 5e-3);
}
