//! Bilinear patches: furnaces, and pictures beside those of fine triangles; bump and normal maps on exact shapes.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::Image;
use specula_scene::scene::*;

/// A closed surface of 24 patches, twice on each side of a cube, whose vertices are moved in and out.
fn pillow() -> PatchMesh {
    let mut mesh = PatchMesh::default();
    let mut known = std::collections::HashMap::new();
    for face in 0..6_usize {
        let (axis, is_far) = (face / 2, face % 2 == 1);
        let mut vertex = |i: u8, j: u8| {
            let mut key = [if is_far { 2 } else { 0 }; 3];
            (key[(axis + 1) % 3], key[(axis + 2) % 3]) = (i, j);
            *known.entry(key).or_insert_with(|| {
                let [x, y, z] = key.map(|k| f32::from(k) - 1.0);
                let bulge = 1.0 + 0.25 * (3.0 * x + 5.0 * y + 7.0 * z).sin();
                mesh.positions.push([x, y, z].map(|c| c * bulge));
                u32::try_from(mesh.positions.len() - 1).expect("few vertices")
            })
        };
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let mut corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
            if !is_far {
                corners.swap(1, 2);
            }
            mesh.patches.push(corners.map(|[i, j]| vertex(i, j)));
        }
    }
    mesh
}

/// One strongly twisted patch, with coordinates that both depend on both of its own.
fn saddle() -> PatchMesh {
    PatchMesh {
        positions: vec![
            [-1.0, -1.0, 0.7],
            [1.0, -1.0, -0.5],
            [-1.0, 1.0, -0.6],
            [1.0, 1.0, 0.8],
        ],
        uvs: vec![[0.0, 0.1], [1.0, 0.0], [0.2, 1.0], [1.3, 1.2]],
        normals: Vec::new(),
        patches: vec![[0, 1, 2, 3]],
        are_polygons: false,
    }
}

/// A strip of two patches with normals of its own, one of them with two corners in one.
fn fan() -> PatchMesh {
    let positions = vec![
        [-1.0, -0.6, 0.0],
        [0.0, -0.9, 0.5],
        [-0.8, 0.9, 0.4],
        [0.1, 0.8, -0.3],
        [1.0, 0.0, 0.1],
    ];
    PatchMesh {
        normals: vec![
            [-0.3, 0.0, 1.0],
            [0.0, -0.2, 1.0],
            [-0.2, 0.2, 1.0],
            [0.1, 0.2, 1.0],
            [0.4, 0.0, 1.0],
        ],
        uvs: positions.iter().map(|p: &[f32; 3]| [p[0], p[1]]).collect(),
        positions,
        patches: vec![[0, 1, 2, 3], [1, 4, 3, 4]],
        are_polygons: false,
    }
}

fn patches(scene: &mut Scene, mesh: PatchMesh) -> Geometry {
    scene.patch_meshes.push(mesh);
    Geometry::Patches(PatchMeshId(scene.patch_meshes.len() - 1))
}

/// White and glass patches vanish in a uniform sky, inside and outside, at every scale and place: no ray is lost at the
/// surface that it leaves, nor between neighbours.
#[test]
fn closed_meshes_of_curved_patches_vanish_in_a_uniform_sky() {
    let kinds = [
        (diffuse(1.0), "diffuse"),
        (mirror_metal(0.0), "mirror"),
        (glass(0.0), "glass"),
    ];
    for (name, mesh) in [("pillow", pillow()), ("saddle", saddle())] {
        for (kind, kind_name) in &kinds {
            // Glass has two sides.
            if (name, *kind_name) == ("saddle", "glass") {
                continue;
            }
            for (scale, shift) in [(1.0, 0.0), (1e-3, 0.0), (1e4, 0.0), (1.0, 300.0)] {
                let centre = [shift, 0.0, 0.0];
                let from = [shift + scale, -3.5 * scale, 2.5 * scale];
                let mut scene = empty(look(from, centre, 35.0), 12);
                let m = material(&mut scene, *kind);
                let place = DMat4::from_translation(centre.into())
                    * DMat4::from_rotation_y(0.4)
                    * DMat4::from_scale(DVec3::splat(scale));
                let geometry = patches(&mut scene, mesh.clone());
                scene.shapes.push(shape(geometry, place, m));
                scene.lights.push(constant_sky(1.0));
                let picture = render(&scene, 32, 200, Strategy::Mis);
                let what = format!("{kind_name} {name} at scale {scale}, shifted {shift}");
                assert_mean(&what, &picture, 1.0, 2e-3);
            }
        }
    }
}

/// Within a closed mesh of white patches that holds a lamp of radiance 1 and reflectance 0.
#[test]
fn no_light_leaves_a_closed_mesh_of_patches() {
    let mut scene = empty(look([0.6, 0.1, 0.0], [-1.0, 0.2, 0.3], 100.0), 16);
    let white = material(&mut scene, diffuse(1.0));
    let black = material(&mut scene, diffuse(0.0));
    let geometry = patches(&mut scene, pillow());
    scene.shapes.push(shape(geometry, DMat4::IDENTITY, white));
    let lamp = sphere(0.35, [-0.2, 0.0, 0.1], black);
    scene.shapes.push(emitting(lamp, 1.0));
    let picture = render(&scene, 64, 2000, Strategy::Mis);
    assert_mean("closed furnace", &picture, 1.0, 1e-3);
}

/// 64 by 64 quadrilaterals for every patch, with its normals and coordinates.
fn fine(mesh: &PatchMesh) -> Mesh {
    const N: u32 = 64;
    let mut out = Mesh::default();
    let wide = |v: &[[f32; 3]], i: u32| DVec3::from(v[i as usize].map(f64::from));
    for patch in &mesh.patches {
        let [a, b, c, d] = patch.map(|i| wide(&mesh.positions, i));
        let first = u32::try_from(out.positions.len()).expect("few vertices");
        for k in 0..(N + 1) * (N + 1) {
            let [u, v] = [k % (N + 1), k / (N + 1)].map(|x| f64::from(x) / f64::from(N));
            let mix = |[a, b, c, d]: [DVec3; 4]| a.lerp(b, u).lerp(c.lerp(d, u), v);
            let narrow = |v: DVec3| v.as_vec3().to_array();
            out.positions.push(narrow(mix([a, b, c, d])));
            let normal = if mesh.normals.is_empty() {
                (b - a).lerp(d - c, v).cross((c - a).lerp(d - b, u))
            } else {
                mix(patch.map(|i| wide(&mesh.normals, i).normalize()))
            };
            out.normals.push(narrow(normal.normalize()));
            let uvs = patch.map(|i| {
                let [s, t] = mesh.uvs[i as usize].map(f64::from);
                DVec3::new(s, t, 0.0)
            });
            let [s, t, _] = narrow(mix(uvs));
            out.uvs.push([s, t]);
        }
        for k in (0..N * N).map(|k| first + k / N * (N + 1) + k % N) {
            let [a, b, c, d] = [k, k + 1, k + N + 1, k + N + 2];
            out.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    out
}

/// The same scene with triangles: fine ones of patches, and those of quadrics' parts.
fn triangulated(mut scene: Scene) -> Scene {
    let Scene {
        meshes,
        patch_meshes,
        shapes,
        objects,
        ..
    } = &mut scene;
    let all = shapes
        .iter_mut()
        .chain(objects.iter_mut().flat_map(|o| &mut o.shapes));
    for shape in all.filter(|s| s.emission.is_none()) {
        let mesh = match shape.geometry {
            Geometry::Patches(id) => fine(&patch_meshes[id.0]),
            Geometry::QuadricPart(part) => part.mesh(),
            _ => continue,
        };
        meshes.push(mesh);
        shape.geometry = Geometry::Mesh(MeshId(meshes.len() - 1));
    }
    scene
}

fn picture(scene: &Scene, triangulate_exact_shapes: bool) -> Picture {
    let options = RenderOptions {
        samples_per_pixel: 16,
        max_depth: 4,
        triangulate_exact_shapes,
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(scene, &options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(16, &AtomicBool::new(false));
    renderer.film().picture()
}

/// Asserts that pictures of 64x64 pixels, of which many errors are common, agree on their mean and on 8x8 tiles.
///
/// * `slack`: relative.
fn assert_same(what: &str, [a, b]: [&Picture; 2], slack: f64) {
    let [(mean_a, error_a), (mean_b, error_b)] = [mean(a), mean(b)];
    let z = (mean_a - mean_b) / error_a.hypot(error_b);
    assert!(
        z.abs() < 3.0 && (mean_a / mean_b - 1.0).abs() < slack,
        "{what}: {mean_a} +- {error_a}, {mean_b} +- {error_b}"
    );
    for tile in 0..64_usize {
        let pixels = (0..64_usize).map(|i| (tile / 8 * 8 + i / 8) * 64 + tile % 8 * 8 + i % 8);
        let (mut sums, mut variance) = ([0.0; 2], 0.0);
        for i in pixels {
            for (sum, picture) in sums.iter_mut().zip([a, b]) {
                *sum += f64::from(picture.colour[i].g);
                variance += f64::from(picture.variance[i].g);
            }
        }
        let difference = sums[0] - sums[1];
        assert!(
            difference.abs() < 4.5 * variance.sqrt() + slack * sums[1],
            "{what}, tile {tile}: {sums:?} +- {}",
            variance.sqrt()
        );
    }
}

#[test]
fn what_shaders_have_not_is_named() {
    let mut scene = empty(look([1.0, -3.5, 2.5], [0.0; 3], 35.0), 8);
    let m = material(&mut scene, diffuse(0.5));
    let geometry = patches(&mut scene, saddle());
    scene.shapes.push(shape(geometry, DMat4::IDENTITY, m));
    scene.lights.push(constant_sky(1.0));
    let missing = |triangulate_exact_shapes| {
        let options = RenderOptions {
            triangulate_exact_shapes,
            ..RenderOptions::default()
        };
        let prepared = PreparedScene::new(&scene, &options).unwrap();
        prepared.flatten().missing
    };
    let named = missing(false);
    assert!(
        matches!(&named[..], [one] if one.contains("bilinear patches")),
        "{named:?}"
    );
    assert!(missing(true).is_empty());
}

fn checks(scene: &mut Scene, [even, odd]: [f32; 2]) -> TextureId {
    let first = scene.textures.len();
    let constant = |x| Texture::Constant(Rgb::splat(x));
    scene.textures.extend([constant(even), constant(odd)]);
    scene.textures.push(Texture::Checkerboard {
        even: TextureId(first),
        odd: TextureId(first + 1),
        mapping: TextureMapping::Uv(UvMapping::scaled([8.0, 4.0], [0.0; 2])),
    });
    TextureId(first + 2)
}

/// Textured, cut out by alpha, reversed, instanced, mirrored and moving patches, one that emits, and brushed metal.
fn gallery(moves: bool) -> Scene {
    let mut scene = empty(look([0.5, -7.0, 4.0], [0.0; 3], 45.0), 64);
    let (pattern, mask) = (
        checks(&mut scene, [0.9, 0.1]),
        checks(&mut scene, [0.0, 1.0]),
    );
    let checked = MaterialKind::Diffuse {
        reflectance: ColourParam::Texture(pattern),
        roughness: FloatParam::Value(0.0),
    };
    let checked = material(&mut scene, checked);
    let brushed = material(&mut scene, brushed());
    let mut closed = pillow();
    closed.uvs = (closed.positions.iter())
        .map(|p| [p[0] + 0.3 * p[2], p[1] - 0.2 * p[2]])
        .collect();
    let mut object = Object::default();
    for (i, mesh) in (0_u8..).zip([saddle(), fan(), closed]) {
        let geometry = patches(&mut scene, mesh);
        let at = |x: f64, z: f64| {
            let mirror = if i == 1 { -1.0 } else { 1.0 };
            DMat4::from_translation(DVec3::new(x, 0.0, z))
                * DMat4::from_rotation_x(0.5)
                * DMat4::from_scale(DVec3::new(mirror * 0.9, 0.9, 0.9))
        };
        let x = 2.4 * f64::from(i) - 2.4;
        let mut whole = shape(geometry, at(x, 1.2), checked);
        whole.reverse_orientation = i % 2 == 0;
        if i == 0 {
            whole.alpha = FloatParam::Texture(mask);
        }
        if moves {
            whole.motion = Some(Motion {
                end: at(x + 0.5, 1.2),
                times: [0.0, 1.0],
            });
        }
        scene.shapes.push(whole);
        object.shapes.push(shape(geometry, at(x, 0.0), brushed));
    }
    scene.objects.push(object);
    scene.instances.push(ObjectInstance {
        object: ObjectId(0),
        to_world: DMat4::from_translation(DVec3::new(0.0, 0.0, -1.2)) * DMat4::from_rotation_z(0.1),
        motion: None,
    });
    let lamp = patches(&mut scene, saddle());
    let place = DMat4::from_translation(DVec3::new(0.0, -3.0, 4.0)) * DMat4::from_rotation_x(3.0);
    let lamp = shape(lamp, place, checked);
    scene.shapes.push(emitting(lamp, 20.0));
    scene.lights.push(constant_sky(0.3));
    scene
}

#[test]
fn pictures_are_those_of_fine_triangles() {
    for moves in [false, true] {
        let scene = gallery(moves);
        let exact = picture(&scene, false);
        let fine = picture(&triangulated(scene.clone()), false);
        assert_same(&format!("fine, {moves}"), [&exact, &fine], 2e-3);
        let for_devices = picture(&scene, true);
        assert_same(&format!("coarse, {moves}"), [&exact, &for_devices], 5e-3);
    }
}

/// Waves as a normal map.
fn waves() -> Image {
    let pixel = |i: u32| {
        let [x, y] = [i % 64, i / 64].map(|k| (k as f32 + 0.5) / 64.0 * core::f32::consts::TAU);
        let slope = [0.5 * (2.0 * x).cos(), 0.4 * (x + 3.0 * y).cos()];
        let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
        [-slope[0], -slope[1], 1.0].map(|n| 0.5 + 0.5 * n / length)
    };
    Image {
        name: "waves".into(),
        width: 64,
        height: 64,
        pixels: (0..64 * 64).map(pixel).collect(),
    }
}

/// Parts of quadrics and patches, glossy, under a small sun and a sky.
fn bent(bump: impl Fn(&mut Scene) -> Bump) -> Scene {
    let mut scene = empty(look([0.5, -7.0, 4.0], [0.0; 3], 45.0), 64);
    let bump = bump(&mut scene);
    let bare = mirror_metal(0.3);
    let m = material(&mut scene, bare);
    scene.materials[m.0].bump = Some(bump);
    let turn = QuadricPart::TURN;
    let parts = [
        QuadricPart::Sphere {
            radius: 0.9,
            z: [-0.6, 0.7],
            phi_max: 4.5,
        },
        QuadricPart::Cylinder {
            radius: 0.8,
            z: [-0.7, 0.7],
            phi_max: turn,
        },
        QuadricPart::Disk {
            radius: 1.0,
            inner: 0.4,
            height: 0.1,
            phi_max: 5.0,
        },
    ];
    let curved = [saddle(), fan()].map(|mesh| patches(&mut scene, mesh));
    let geometries = parts.map(Geometry::QuadricPart).into_iter().chain(curved);
    for (i, geometry) in (0_u8..).zip(geometries) {
        let [x, z] = [i % 3, i / 3].map(f64::from);
        let place = DMat4::from_translation(DVec3::new(2.2 * x - 2.2, 0.0, 1.2 - 2.4 * z))
            * DMat4::from_rotation_x(0.8);
        let mut shape = shape(geometry, place, m);
        shape.reverse_orientation = i % 2 == 1;
        scene.shapes.push(shape);
    }
    scene.lights.push(constant_sky(0.3));
    scene.lights.push(Light::Distant {
        irradiance: Rgb::splat(3.0),
        to_light: [0.0, -0.6, 0.8],
        half_angle_deg: 2.0,
    });
    scene
}

#[test]
fn bump_and_normal_maps_are_those_of_fine_triangles() {
    let heights = bent(|scene| {
        scene.textures.push(Texture::Noise {
            kind: NoiseKind::Fbm,
            octaves: 2,
            roughness: 0.5,
            to_texture: DMat4::from_scale(DVec3::splat(2.0)),
        });
        let tenth = TextureId(scene.textures.len());
        scene.textures.push(Texture::Constant(Rgb::splat(0.15)));
        scene.textures.push(Texture::Scale {
            a: TextureId(tenth.0 - 1),
            b: tenth,
        });
        Bump::Height(FloatParam::Texture(TextureId(tenth.0 + 1)))
    });
    let normals = bent(|scene| {
        scene.images.push(waves());
        scene.textures.push(Texture::Image {
            image: ImageId(scene.images.len() - 1),
            mapping: TextureMapping::Uv(UvMapping::scaled([3.0, 2.0], [0.0; 2])),
            wrap: [Wrap::Repeat; 2],
            filter: Interpolation::Bilinear,
            invert: false,
            scale: 1.0,
            channel: Channel::Rgb,
        });
        Bump::Normal {
            map: TextureId(scene.textures.len() - 1),
            scale: 1.0,
        }
    });
    for (what, scene) in [("heights", heights), ("normals", normals)] {
        let exact = picture(&scene, false);
        let fine = picture(&triangulated(scene.clone()), false);
        assert_same(what, [&exact, &fine], 2e-3);
        // What the maps do is far more than that.
        let mut smooth = scene.clone();
        smooth.materials[0].bump = None;
        let smooth = picture(&smooth, false);
        let difference = (0..exact.colour.len())
            .map(|i| f64::from((exact.colour[i].g - smooth.colour[i].g).abs()))
            .sum::<f64>();
        assert!(
            difference / 4096.0 > 0.05 * mean(&exact).0,
            "{what}: {difference}"
        );
    }
}
