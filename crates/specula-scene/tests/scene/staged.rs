//! Files without light: what they are given to be seen by, and on what they stand.

use std::path::Path;

use glam::DVec3;
use specula_scene::material_text::parse_material;
use specula_scene::scene::{ColourParam, Geometry, MaterialKind, Projection, Shape, Texture};
use specula_scene::write_pbrt::write_pbrt;
use specula_scene::{LoadOptions, Loaded, Scene, Summary, check, load, load_bytes};

use super::common::Folder;

/// A box from `low` to `high`, standing on its edge: turned by 45 degrees about z beforehand where
/// `turned`.
fn obj(low: DVec3, high: DVec3, turned: bool) -> String {
    let corner = |i: usize| {
        let pick = |axis: usize| {
            if i >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        };
        let p = DVec3::new(pick(0), pick(1), pick(2));
        let p = if turned {
            DVec3::new(p.x - p.y, p.x + p.y, p.z)
        } else {
            p
        };
        format!("v {} {} {}\n", p.x, p.y, p.z)
    };
    let faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    (0..8).map(corner).collect::<String>() + faces
}

fn load_text(name: &str, text: &str) -> Loaded {
    load_bytes(
        Path::new(name),
        text.as_bytes().to_vec(),
        &LoadOptions::default(),
    )
    .unwrap()
}

/// A triangle in the plane of x and y, from y = 0 to 1, in nodes and with materials of a test's choice.
fn gltf(more: &str) -> Loaded {
    let positions: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let bytes: Vec<u8> = positions.iter().flat_map(|x| x.to_le_bytes()).collect();
    use base64::Engine;
    let data = base64::engine::general_purpose::STANDARD.encode(bytes);
    let text = format!(
        r#"{{ "asset": {{ "version": "2.0" }}, "extensionsUsed": ["KHR_lights_punctual"],
 "buffers": [ {{ "byteLength": 36, "uri": "data:application/octet-stream;base64,{data}" }} ],
 "bufferViews": [ {{ "buffer": 0, "byteLength": 36 }} ],
 "accessors": [ {{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
   "min": [0,0,0], "max": [1,1,0] }} ],
 "meshes": [ {{ "primitives": [ {{ "attributes": {{ "POSITION": 0 }}, "material": 0 }} ] }} ],
 {more} }}"#
    );
    load_text("scene.gltf", &text)
}

fn floor(scene: &Scene) -> Option<&Shape> {
    let material = scene.floor?;
    scene.shapes.iter().find(|s| s.material == material)
}

/// Where the floor is and how far it reaches.
#[track_caller]
fn place(scene: &Scene) -> (DVec3, f64) {
    let shape = floor(scene).expect("a floor");
    let Geometry::Disk {
        radius,
        height: 0.0,
    } = shape.geometry
    else {
        panic!("{shape:?}")
    };
    // Level, and seen from above.
    let up = shape.to_world.transform_vector3(DVec3::Z);
    assert_eq!(up, DVec3::Y);
    (shape.to_world.w_axis.truncate(), f64::from(radius))
}

#[track_caller]
fn camera_sees(scene: &Scene, corners: &[DVec3]) {
    let Projection::Perspective { fov_deg } = scene.camera.projection else {
        panic!("{:?}", scene.camera)
    };
    let spread = (0.5 * fov_deg.to_radians()).tan();
    let [x0, x1, y0, y1] = scene.camera.screen_window;
    for corner in corners {
        let p = scene.camera.to_world.inverse().transform_point3(*corner);
        let (x, y) = (p.x / p.z / spread, p.y / p.z / spread);
        assert!(p.z > 0.0 && x0 <= x && x <= x1 && y0 <= y && y <= y1, "{p}");
        // And from no farther away than the whole object needs.
        assert!(x.abs().max(y.abs()) > 0.1, "{p}");
    }
}

#[test]
fn a_mesh_of_any_size_anywhere_stands_on_a_floor() {
    for (size, offset) in [
        (1.0, DVec3::ZERO),
        (1e-3, DVec3::ZERO),
        (1e6, DVec3::ZERO),
        (1e-12, DVec3::ZERO),
        (1e16, DVec3::ZERO),
        (1.0, DVec3::new(1e4, -2e4, 3e4)),
        (1e-3, DVec3::new(0.0, 50.0, 0.0)),
    ] {
        let (low, high) = (offset, offset + size * DVec3::new(1.0, 2.0, 3.0));
        let scene = load_text("box.obj", &obj(low, high, false)).scene;
        scene.validate().unwrap();
        let (centre, reach) = place(&scene);
        let rounding = 1e-6 * (low.abs().max(high.abs())).max_element();
        let gap = low.y - centre.y;
        assert!(
            gap > 0.0 && gap < 0.01 * size + rounding,
            "{size} {offset}: {gap}"
        );
        assert!((centre - 0.5 * (low + high)).with_y(0.0).length() < 1e-3 * size + rounding);
        assert!(reach > 20.0 * size, "{size}: {reach}");
        let corners = (0..8).map(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        });
        camera_sees(&scene, &corners.collect::<Vec<_>>());
        // The size that is told is the object's.
        let bounds = Summary::of(&scene).bounds;
        assert!((bounds.max - bounds.min).max_element() < 3.1 * size + rounding);
    }
}

#[test]
fn the_floor_is_under_points_not_under_boxes() {
    // Rotated by 45 degrees about z, and by -45 in the node: the box around the box reaches deeper.
    let turned = obj(DVec3::splat(-1.0), DVec3::ONE, true);
    let (centre, _) = place(&load_text("box.obj", &turned).scene);
    assert!((centre.y + 2.0).abs() < 0.01, "{centre}");
    let half = std::f64::consts::FRAC_PI_8;
    let nodes = format!(
        r#""materials": [ {{}} ], "nodes": [ {{ "mesh": 0, "rotation": [0, 0, {}, {}] }},
           {{ "mesh": 0, "rotation": [0, 0, {}, {}], "translation": [0, 0.5, 0] }} ]"#,
        half.sin(),
        half.cos(),
        half.sin(),
        half.cos()
    );
    let scene = gltf(&nodes).scene;
    assert_eq!(scene.instances.len(), 2);
    let (centre, _) = place(&scene);
    // The corner at the origin is the lowest point.
    assert!((-0.01..0.0).contains(&centre.y), "{centre}");
}

#[test]
fn light_of_the_file_is_left_alone() {
    let lamp = r#""extensions": { "KHR_lights_punctual": { "lights": [ { "type": "point" } ] } },
 "materials": [ {} ],
 "nodes": [ { "mesh": 0 }, { "extensions": { "KHR_lights_punctual": { "light": 0 } } } ]"#;
    let glowing = r#""materials": [ { "emissiveFactor": [1, 1, 1],
   "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 4 } } } ], "nodes": [ { "mesh": 0 } ]"#;
    for (text, lights) in [(lamp, 1), (glowing, 0)] {
        let loaded = gltf(text);
        let scene = &loaded.scene;
        assert!(scene.floor.is_none());
        assert_eq!((scene.shapes.len(), scene.lights.len()), (1, lights));
        let told: Vec<&str> = loaded.warnings.iter().map(|w| w.message()).collect();
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].contains("no camera"), "{told:?}");
    }
}

#[test]
fn meshes_alone_have_the_colours_of_their_vertices() {
    let text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
    let scene = load_text("colours.obj", text).scene;
    let MaterialKind::Diffuse { reflectance, .. } = &scene.materials[0].kind else {
        panic!("{:?}", scene.materials[0].kind)
    };
    let ColourParam::Texture(texture) = reflectance else {
        panic!("{reflectance:?}")
    };
    assert_eq!(scene.textures[texture.0], Texture::VertexColour);
}

#[test]
fn screens_and_labels_are_no_lamps() {
    let label = r#""materials": [ { "emissiveFactor": [1, 1, 1] } ], "nodes": [ { "mesh": 0 } ]"#;
    let unlit = r#""materials": [ { "extensions": { "KHR_materials_unlit": {} } } ], "nodes": [ { "mesh": 0 } ]"#;
    for text in [label, unlit] {
        let scene = gltf(text).scene;
        assert!(scene.floor.is_some() && scene.shapes[0].emission.is_some());
        assert_eq!(scene.lights.len(), 1);
    }
}

#[test]
fn a_camera_of_the_file_from_below_sees_the_object() {
    let from = |y: f64| {
        gltf(&format!(
            r#""materials": [ {{}} ],
 "cameras": [ {{ "type": "perspective", "perspective": {{ "yfov": 1.0, "znear": 0.1 }} }} ],
 "nodes": [ {{ "mesh": 0 }}, {{ "camera": 0, "translation": [0, {y}, 4] }} ]"#
        ))
    };
    let below = from(-1.0);
    assert!(below.scene.floor.is_none());
    assert_eq!(below.scene.lights.len(), 1);
    assert!(!below.warnings[0].message().contains("floor"));
    let above = from(0.5);
    assert!(above.scene.floor.is_some());
    assert!(above.warnings[0].message().contains("floor"));
    assert_eq!(above.scene.camera.to_world.w_axis.y, 0.5);
}

#[test]
fn the_floor_has_a_name_of_its_own_and_its_own_material() {
    let loaded = gltf(r#""materials": [ { "name": "floor" } ], "nodes": [ { "mesh": 0 } ]"#);
    let mut scene = loaded.scene;
    let id = scene.floor.expect("a floor").0;
    assert_eq!(scene.materials[id].name.as_deref(), Some("floor-2"));
    let before = scene.materials[id].kind;
    let gold = parse_material("conductor Au alpha 0.2").unwrap();
    scene.replace_materials(gold);
    assert_eq!(scene.materials[0].kind, gold);
    assert_eq!(scene.materials[id].kind, before, "gold is for the object");
    assert_eq!(scene.replace_materials_named(|n| n == "floor-2", gold), 1);
    assert_eq!(scene.materials[id].kind, gold);
}

#[test]
fn what_is_staged_is_told_and_kept() {
    let folder = Folder::new();
    let path = folder.write("box.obj", obj(DVec3::ZERO, DVec3::ONE, false));
    let report = check(&path, &LoadOptions::default());
    let told: Vec<String> = report.problems().iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("a floor"), "{told:?}");
    let scene = load(&path).unwrap().scene;
    let copy = folder.path().join("copy.pbrt");
    assert_eq!(write_pbrt(&scene, &copy).unwrap(), Vec::<String>::new());
    let copy = load(&copy).unwrap();
    assert!(copy.warnings.is_empty(), "{:?}", copy.warnings);
    assert_eq!((copy.scene.shapes.len(), copy.scene.lights.len()), (2, 1));
    let disk = copy
        .scene
        .shapes
        .iter()
        .find(|s| matches!(s.geometry, Geometry::Disk { .. }));
    let disk = disk.expect("the floor");
    assert_eq!(disk.to_world, floor(&scene).unwrap().to_world);
    let material = &copy.scene.materials[disk.material.0];
    assert_eq!(material.name.as_deref(), Some("floor"));
}
