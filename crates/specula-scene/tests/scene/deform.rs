//! glTF's morph targets and skins: where vertices are, and what is said of damaged ones.

use std::f32::consts::FRAC_1_SQRT_2;
use std::time::Duration;

use base64::Engine;
use serde_json::{Value, json};
use specula_scene::scene::{Geometry, Mesh};
use specula_scene::{Exposure, LoadOptions, Loaded, SceneError, load_bytes};

/// A glTF file whose arrays are in one buffer.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl File {
    /// An accessor of floats.
    fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        let n = match kind {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let per = |f: fn(f32, f32) -> f32, from: f32| -> Vec<f32> {
            let column = |k: usize| values.iter().skip(k).step_by(n).copied();
            (0..n).map(|k| column(k).fold(from, f)).collect()
        };
        let (min, max) = (per(f32::min, f32::MAX), per(f32::max, f32::MIN));
        let (view, count) = (self.view(&bytes), values.len() / n);
        self.accessors.push(json!({
            "bufferView": view, "componentType": 5126, "count": count, "type": kind, "min": min, "max": max,
        }));
        self.accessors.len() - 1
    }

    /// An accessor of vectors of four bytes.
    fn joints(&mut self, values: &[u8]) -> usize {
        let view = self.view(values);
        let count = values.len() / 4;
        self.accessors.push(
            json!({ "bufferView": view, "componentType": 5121, "count": count, "type": "VEC4" }),
        );
        self.accessors.len() - 1
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(),
        }));
        self.bytes.extend(bytes);
        self.views.len() - 1
    }

    /// The file with these other members.
    fn with(&self, members: Value) -> Value {
        let data = base64::engine::general_purpose::STANDARD.encode(&self.bytes);
        let mut root = json!({
            "asset": { "version": "2.0" },
            "buffers": [ {
                "byteLength": self.bytes.len(),
                "uri": format!("data:application/octet-stream;base64,{data}"),
            } ],
            "bufferViews": self.views,
            "accessors": self.accessors,
        });
        if let (Some(root), Value::Object(members)) = (root.as_object_mut(), members) {
            root.extend(members);
        }
        root
    }
    /// Another file with the arrays of this one.
    fn arrays_of(&self, mut root: Value) -> Value {
        let own = self.with(json!({}));
        for member in ["bufferViews", "accessors", "buffers"] {
            root[member] = own[member].clone();
        }
        root
    }
}

fn read(file: &Value, exposure: Option<[f64; 2]>) -> Result<Loaded, SceneError> {
    let mut options = LoadOptions::default();
    options.exposure = exposure.map(|[time, shutter]| Exposure {
        time: Duration::from_secs_f64(time),
        shutter: Duration::from_secs_f64(shutter),
    });
    load_bytes("a.gltf".as_ref(), file.to_string().into_bytes(), &options)
}

/// The meshes of a file's own shapes, with their vertices in the world.
fn meshes(loaded: &Loaded) -> Vec<Mesh> {
    let scene = &loaded.scene;
    let own = scene.shapes.iter();
    own.filter(|shape| Some(shape.material) != scene.floor)
        .filter_map(|shape| {
            let Geometry::Mesh(id) = shape.geometry else {
                return None;
            };
            let mut mesh = scene.meshes[id.0].clone();
            for p in &mut mesh.positions {
                let world = shape
                    .to_world
                    .transform_point3(glam::Vec3::from_array(*p).as_dvec3());
                *p = world.as_vec3().to_array();
            }
            Some(mesh)
        })
        .collect()
}

#[track_caller]
fn assert_near(found: &[[f32; 3]], expected: &[[f32; 3]]) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        let near = a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near, "{found:?}, expected {expected:?}");
    }
}

/// An arm along y with a joint at its foot and one at its middle, which turns about z by a right angle within one
/// second. The mesh's node is moved: skins do not care.
fn arm() -> (File, Value) {
    let mut file = File::default();
    let positions = file.floats(
        "VEC3",
        &[
            0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 2.0, 0.0, 1.0, 2.0, 0.0, 5.0, 5.0, 5.0,
        ],
    );
    let normals = file.floats("VEC3", &[1.0, 0.0, 0.0].repeat(5));
    // The second vertex by halves, whose weights are not normalised; the last by none.
    let joints = file.joints(&[0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0]);
    let weights = file.floats(
        "VEC4",
        &[
            1.0, 0.0, 0.0, 0.0, 0.25, 0.25, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
            0.0, 0.0, 0.0,
        ],
    );
    let identity = [
        1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    ];
    let mut binding = [identity, identity].concat();
    binding[16 + 13] = -1.0;
    let binding = file.floats("MAT4", &binding);
    let times = file.floats("SCALAR", &[0.0, 1.0]);
    let half = FRAC_1_SQRT_2;
    let turns = file.floats("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half]);
    let root = file.with(json!({
        "scenes": [ { "nodes": [ 0, 1 ] } ],
        "nodes": [
            { "mesh": 0, "skin": 0, "translation": [ 7, 0, 0 ] },
            { "children": [ 2 ] },
            { "translation": [ 0, 1, 0 ] },
        ],
        "skins": [ { "joints": [ 1, 2 ], "inverseBindMatrices": binding } ],
        "meshes": [ { "primitives": [ { "attributes": {
            "POSITION": positions, "NORMAL": normals, "JOINTS_0": joints, "WEIGHTS_0": weights,
        }, "mode": 5 } ] } ],
        "animations": [ {
            "channels": [ { "sampler": 0, "target": { "node": 2, "path": "rotation" } } ],
            "samplers": [ { "input": times, "output": turns } ],
        } ],
    }));
    (file, root)
}

#[test]
fn skins_follow_their_joints() {
    let (_, root) = arm();
    let still = meshes(&read(&root, Some([0.0, 0.0])).unwrap());
    let bound = [
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 2.0, 0.0],
        [1.0, 2.0, 0.0],
        [12.0, 5.0, 5.0],
    ];
    assert_near(&still[0].positions, &bound);
    let bent = meshes(&read(&root, Some([1.0, 0.0])).unwrap());
    let expected = [
        [0.0, 0.0, 0.0],
        [0.5, 1.5, 0.0],
        [-1.0, 1.0, 0.0],
        [-1.0, 2.0, 0.0],
        [12.0, 5.0, 5.0],
    ];
    assert_near(&bent[0].positions, &expected);
    let h = FRAC_1_SQRT_2;
    let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_near(&bent[0].normals, &[x, [h, h, 0.0], y, y, x]);
}

#[test]
fn joints_may_stand_outside_of_the_scene() {
    let (_, mut root) = arm();
    root["scenes"][0]["nodes"] = json!([0]);
    root["nodes"][1]["scale"] = json!([2, 2, 2]);
    let bent = meshes(&read(&root, Some([1.0, 0.0])).unwrap());
    let [foot, half, end] = [0, 1, 2].map(|i| bent[0].positions[i]);
    assert_near(
        &[foot, half, end],
        &[[0.0; 3], [1.0, 3.0, 0.0], [-2.0, 2.0, 0.0]],
    );
}

#[test]
fn what_deforms_during_the_exposure_is_told() {
    let (_, root) = arm();
    let loaded = read(&root, Some([0.0, 1.0])).unwrap();
    let told = loaded.warnings.iter().any(|w| {
        w.message()
            .starts_with("nodes[0]: its mesh deforms during the exposure")
    });
    assert!(told, "{:?}", loaded.warnings);
    assert_near(&meshes(&loaded)[0].positions[2..3], &[[0.0, 2.0, 0.0]]);
    assert!(!format!("{:?}", read(&root, Some([0.5, 0.0])).unwrap().warnings).contains("deforms"));
}

#[test]
fn damaged_skins_are_named() {
    let (mut file, root) = arm();
    let short = file.floats("MAT4", &[1.0; 16]);
    let few = file.joints(&[0; 16]);
    let beyond = file.joints(&[2; 20]);
    let attributes = "/meshes/0/primitives/0/attributes";
    for (pointer, value, expected) in [
        (
            "/skins/0/inverseBindMatrices",
            json!(short),
            "skins[0].inverseBindMatrices: expected 2 matrices, found 1",
        ),
        (
            "/skins/0/inverseBindMatrices",
            json!(0),
            "skins[0].inverseBindMatrices: expected matrices of 4 x 4 floats",
        ),
        (
            &format!("{attributes}/JOINTS_0"),
            json!(few),
            "JOINTS_0: expected 5 elements, found 4",
        ),
        (
            &format!("{attributes}/JOINTS_0"),
            json!(beyond),
            "JOINTS_0: joint 2 does not exist, of 2",
        ),
        (
            &format!("{attributes}/WEIGHTS_0"),
            Value::Null,
            "JOINTS_0: expected WEIGHTS_0 with it",
        ),
    ] {
        let mut damaged = file.arrays_of(root.clone());
        if value.is_null() {
            let all = damaged.pointer_mut(attributes).unwrap();
            all.as_object_mut().unwrap().remove("WEIGHTS_0");
        } else {
            *damaged.pointer_mut(pointer).unwrap() = value;
        }
        let error = read(&damaged, Some([0.0, 0.0])).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}; expected {expected}");
    }
}

/// A triangle with two morph targets, in three nodes, whose weights an animation moves in the last.
fn smiles() -> Value {
    let mut file = File::default();
    let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    let up = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    let aside = file.floats("VEC3", &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let turned = file.floats("VEC3", &[1.0, 0.0, -1.0].repeat(3));
    let times = file.floats("SCALAR", &[0.0, 2.0]);
    let weights = file.floats("SCALAR", &[0.0, 0.0, 1.0, 0.5]);
    file.with(json!({
        "scenes": [ { "nodes": [ 0, 1, 2 ] } ],
        "nodes": [
            { "mesh": 0 },
            { "mesh": 0, "weights": [ 0, 0 ], "translation": [ 10, 0, 0 ] },
            { "mesh": 0, "translation": [ 20, 0, 0 ] },
        ],
        "meshes": [ { "weights": [ 0.5, 0 ], "primitives": [ {
            "attributes": { "POSITION": positions, "NORMAL": normals },
            "targets": [ { "POSITION": up }, { "POSITION": aside, "NORMAL": turned } ],
        } ] } ],
        "animations": [ {
            "channels": [ { "sampler": 0, "target": { "node": 2, "path": "weights" } } ],
            "samplers": [ { "input": times, "output": weights } ],
        } ],
    }))
}

#[test]
fn morph_targets_add_by_their_weights() {
    let root = smiles();
    let at = |time| {
        let mut found = meshes(&read(&root, Some([time, 0.0])).unwrap());
        found.sort_by(|a, b| a.positions[0][0].total_cmp(&b.positions[0][0]));
        found
    };
    let found = at(2.0);
    assert_near(
        &found[0].positions,
        &[[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [0.0, 1.0, 0.5]],
    );
    assert_near(
        &found[1].positions,
        &[[10.0, 0.0, 0.0], [11.0, 0.0, 0.0], [10.0, 1.0, 0.0]],
    );
    assert_near(
        &found[2].positions,
        &[[20.0, 0.0, 1.0], [22.0, 0.0, 1.0], [20.0, 1.0, 1.0]],
    );
    assert_near(&found[2].normals, &[[0.5, 0.0, 0.5]; 3]);
    assert_near(&found[0].normals, &[[0.0, 0.0, 1.0]; 3]);
    let half = at(1.0);
    assert_near(&half[2].positions[1..2], &[[21.5, 0.0, 0.5]]);
    // Without a moment the weights are the file's.
    let mut still = meshes(&read(&root, None).unwrap());
    still.sort_by(|a, b| a.positions[0][0].total_cmp(&b.positions[0][0]));
    assert_near(&still[2].positions[..1], &[[20.0, 0.0, 0.5]]);
}

#[test]
fn morph_targets_come_before_the_skin() {
    let (mut file, mut root) = arm();
    let moves = file.floats("VEC3", &[0.0, 1.0, 0.0].repeat(5));
    root = file.arrays_of(root);
    root["meshes"][0]["primitives"][0]["targets"] = json!([ { "POSITION": moves } ]);
    root["meshes"][0]["weights"] = json!([1]);
    let bent = meshes(&read(&root, Some([1.0, 0.0])).unwrap());
    assert_near(&bent[0].positions[2..3], &[[-2.0, 1.0, 0.0]]);
}

#[test]
fn damaged_targets_are_named() {
    for (pointer, value, expected) in [
        (
            "/meshes/0/primitives/0/targets/0/POSITION",
            json!(6),
            "meshes[0].primitives[0].targets[0].POSITION: expected vectors of 3 numbers",
        ),
        (
            "/accessors/2/count",
            json!(2),
            "meshes[0].primitives[0].targets[0].POSITION: expected 3 elements, found 2",
        ),
        (
            "/accessors/6/count",
            json!(3),
            "expected 2 values for 2 times, found 1",
        ),
    ] {
        let mut root = smiles();
        *root.pointer_mut(pointer).unwrap() = value;
        let error = read(&root, Some([0.0, 0.0])).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}; expected {expected}");
    }
}
