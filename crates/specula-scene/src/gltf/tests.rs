//! Small files in memory: what is read, what is refused, and that damage never panics.

use std::io::Cursor;

use base64::Engine;
use specula_bsdf::Rgb;

use super::*;
use crate::Scene;
use crate::scene::{Bump, Channel, ColourParam, FloatParam, Geometry, MaterialKind, Projection};

/// A triangle with positions, coordinates, indices and tangents, in one embedded buffer.
fn triangle(more: &str) -> String {
    let mut bytes = Vec::new();
    for p in [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
        bytes.extend(p.iter().flat_map(|x| x.to_le_bytes()));
    }
    for uv in [[0.0_f32, 0.25], [1.0, 0.5], [0.0, 1.0]] {
        bytes.extend(uv.iter().flat_map(|x| x.to_le_bytes()));
    }
    bytes.extend([0_u8, 1, 2, 0]);
    for tangent in [
        [1.0_f32, 0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0, -1.0],
        [0.0, 1.0, 0.0, 1.0],
    ] {
        bytes.extend(tangent.iter().flat_map(|x| x.to_le_bytes()));
    }
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let length = bytes.len();
    format!(
        r#"{{ "asset": {{ "version": "2.0" }},
 "buffers": [ {{ "byteLength": {length}, "uri": "data:application/octet-stream;base64,{data}" }} ],
 "bufferViews": [ {{ "buffer": 0, "byteLength": 36 }}, {{ "buffer": 0, "byteOffset": 36, "byteLength": 24 }},
   {{ "buffer": 0, "byteOffset": 60, "byteLength": 3 }}, {{ "buffer": 0, "byteOffset": 64, "byteLength": 48 }} ],
 "accessors": [
   {{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0] }},
   {{ "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" }},
   {{ "bufferView": 2, "componentType": 5121, "count": 3, "type": "SCALAR" }},
   {{ "bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC4" }} ],
 {more} }}"#
    )
}

const MESH: &str = r#""meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 },
   "indices": 2, "material": 0 } ] } ]"#;

fn load(more: &str) -> Result<Loaded, SceneError> {
    parse(
        Path::new("t.gltf"),
        triangle(more).as_bytes(),
        &Limits::default(),
    )
}

fn messages(loaded: &Loaded) -> Vec<&str> {
    loaded.warnings.iter().map(Warning::message).collect()
}

/// Shapes that are the file's.
fn shapes(scene: &Scene) -> Vec<&Shape> {
    let is_own = |s: &&Shape| Some(s.material) != scene.floor;
    scene.shapes.iter().filter(is_own).collect()
}

#[test]
fn a_bare_triangle_gets_a_camera_light_and_a_floor() {
    let loaded = load(&format!(
        r#"{MESH}, "materials": [ {{ "name": "m" }} ], "nodes": [ {{ "mesh": 0, "translation": [0,0,5] }} ]"#
    ))
    .unwrap();
    let scene = &loaded.scene;
    assert_eq!((shapes(scene).len(), scene.shapes.len()), (1, 2));
    assert_eq!(scene.shapes[0].to_world.w_axis.z, 5.0);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.uvs, [[0.0, 0.75], [1.0, 0.5], [0.0, 0.0]]);
    assert_eq!(scene.lights.len(), 1);
    let MaterialKind::Gltf(g) = scene.materials[0].kind else {
        panic!("{:?}", scene.materials[0])
    };
    assert_eq!(g.metallic, FloatParam::Value(1.0));
    assert_eq!(g.ior, 1.5);
    let messages = messages(&loaded);
    assert!(messages.iter().any(|m| m.contains("no camera")));
    assert!(messages.iter().any(|m| m.contains("no lights")));
}

#[test]
fn materials_cameras_and_lights_are_read() {
    let loaded = load(&format!(
        r#"{MESH},
 "materials": [ {{
   "pbrMetallicRoughness": {{ "baseColorFactor": [0.5, 0.25, 1, 0.5], "metallicFactor": 0.25,
      "baseColorTexture": {{ "index": 0, "extensions": {{ "KHR_texture_transform": {{ "scale": [2, 1] }} }} }},
      "metallicRoughnessTexture": {{ "index": 0 }} }},
   "normalTexture": {{ "index": 0, "scale": 0.5 }},
   "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
   "extensions": {{ "KHR_materials_emissive_strength": {{ "emissiveStrength": 10 }},
     "KHR_materials_clearcoat": {{ "clearcoatFactor": 0.75 }},
     "KHR_materials_anisotropy": {{ "anisotropyStrength": 0.5, "anisotropyRotation": 1.5 }} }} }} ],
 "textures": [ {{ "source": 0, "sampler": 0 }} ],
 "samplers": [ {{ "wrapS": 33071, "wrapT": 33648 }} ],
 "images": [ {{ "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP43+BwAgAGyQKIgvZT8AAAAABJRU5ErkJggg==" }} ],
 "cameras": [ {{ "type": "perspective", "perspective": {{ "yfov": 1.0, "aspectRatio": 0.5, "znear": 0.1 }} }} ],
 "extensionsUsed": ["KHR_lights_punctual"],
 "extensions": {{ "KHR_lights_punctual": {{ "lights": [ {{ "type": "spot", "intensity": 3,
    "spot": {{ "outerConeAngle": 0.5 }} }} ] }} }},
 "nodes": [ {{ "children": [1, 2] }}, {{ "mesh": 0 }},
   {{ "camera": 0, "translation": [0,0,4], "extensions": {{ "KHR_lights_punctual": {{ "light": 0 }} }} }} ],
 "scenes": [ {{ "nodes": [0] }} ]"#
    ))
    .unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    check_surface(&loaded.scene);
    check_view(&loaded.scene);
}

fn check_surface(scene: &Scene) {
    let shape = &scene.shapes[0];
    let emission = shape.emission.unwrap();
    assert_eq!(
        emission.radiance,
        ColourParam::Value(Rgb::from([10.0, 5.0, 0.0]))
    );
    assert!(emission.two_sided);
    let material = &scene.materials[0];
    let MaterialKind::Gltf(g) = material.kind else {
        panic!("{material:?}")
    };
    assert_eq!(g.clearcoat, FloatParam::Value(0.75));
    assert_eq!(
        (g.anisotropy, g.anisotropy_rotation_rad),
        (FloatParam::Value(0.5), 1.5)
    );
    assert!(matches!(
        material.bump,
        Some(Bump::Normal { scale: 0.5, .. })
    ));
    let FloatParam::Texture(roughness) = g.roughness else {
        panic!("{g:?}")
    };
    assert!(matches!(
        scene.textures[roughness.0],
        Texture::Image {
            channel: Channel::Green,
            wrap: [crate::scene::Wrap::Clamp, crate::scene::Wrap::Mirror],
            ..
        }
    ));
    let FloatParam::Texture(alpha) = shape.alpha else {
        panic!("{shape:?}")
    };
    assert!(matches!(
        scene.textures[alpha.0],
        Texture::Threshold { cutoff: 0.25, .. }
    ));
}

fn check_view(scene: &Scene) {
    let camera = &scene.camera;
    let Projection::Perspective { fov_deg } = camera.projection else {
        panic!("{camera:?}")
    };
    // A tall picture: the angle is that of its width.
    let expected = (2.0 * (0.5_f64.tan() * 0.5).atan()).to_degrees();
    assert!((fov_deg - expected).abs() < 1e-9);
    assert_eq!(camera.screen_window, [-1.0, 1.0, -2.0, 2.0]);
    assert_eq!(scene.film.resolution, [1280, 2560]);
    assert_eq!(
        camera.to_world.transform_vector3(glam::DVec3::Z),
        glam::DVec3::NEG_Z
    );
    assert!(matches!(
        scene.lights[..],
        [Light::Spot {
            axis: [0.0, 0.0, -1.0],
            position: [0.0, 0.0, 4.0],
            ..
        }]
    ));
}

/// A picture of one pixel, and textures that show it.
const PICTURE: &str = r#""textures": [ { "source": 0 } ],
 "images": [ { "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP43+BwAgAGyQKIgvZT8AAAAABJRU5ErkJggg==" } ]"#;

/// A triangle with two further sets of coordinates (the same numbers) and tangents.
const SETS: &str = r#""meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "NORMAL": 0,
   "TEXCOORD_0": 1, "TEXCOORD_1": 1, "TEXCOORD_2": 1, "TANGENT": 3 }, "indices": 2, "material": 0 } ] } ],
 "nodes": [ { "mesh": 0 } ]"#;

fn mapping_of(scene: &Scene, texture: crate::scene::TextureId) -> &crate::scene::TextureMapping {
    match &scene.textures[texture.0] {
        Texture::Image { mapping, .. } => mapping,
        other => panic!("{other:?}"),
    }
}

/// The picture of a texture is the extension's, beside another or alone.
#[test]
fn webp_pictures_are_read() {
    let mut bytes = Cursor::new(Vec::new());
    let picture = image::RgbImage::from_pixel(2, 1, image::Rgb([255, 0, 51]));
    picture
        .write_to(&mut bytes, image::ImageFormat::WebP)
        .unwrap();
    let webp = base64::engine::general_purpose::STANDARD.encode(bytes.into_inner());
    let images = format!(
        r#""images": [ {{ "uri": "nowhere.png" }}, {{ "uri": "data:image/webp;base64,{webp}" }} ]"#
    );
    let material =
        r#""materials": [ { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } } ]"#;
    for source in ["", r#""source": 0, "#] {
        let loaded = load(&format!(
            r#"{SETS}, "extensionsRequired": [ "EXT_texture_webp" ], "textures": [ {{ {source}"extensions": {{
   "EXT_texture_webp": {{ "source": 1 }} }} }} ], {images}, {material}"#
        ))
        .unwrap();
        let [r, g, b] = loaded.scene.images[0].pixels.rgb(1);
        assert_eq!((r, g), (1.0, 0.0));
        assert!((b - 0.033_104_77).abs() < 1e-6, "{b}");
    }
    let missing = load(&format!(
        r#"{SETS}, "textures": [ {{}} ], {images}, {material}"#
    ));
    let message = missing.unwrap_err().to_string();
    assert!(
        message.contains("textures[0]: expected a source"),
        "{message}"
    );
}

#[test]
fn directions_coats_and_volumes_are_read() {
    let loaded = load(&format!(
        r#"{SETS}, {PICTURE}, "materials": [ {{ "extensions": {{
   "KHR_materials_anisotropy": {{ "anisotropyStrength": 0.5, "anisotropyRotation": 0.25,
     "anisotropyTexture": {{ "index": 0, "texCoord": 1 }} }},
   "KHR_materials_clearcoat": {{ "clearcoatFactor": 1, "clearcoatNormalTexture": {{ "index": 0, "scale": 0.5 }} }},
   "KHR_materials_transmission": {{ "transmissionFactor": 1 }},
   "KHR_materials_volume": {{ "thicknessFactor": 2, "attenuationDistance": 4, "attenuationColor": [0.5, 1, 0.25] }}
   }} }} ]"#
    ))
    .unwrap();
    assert!(
        messages(&loaded)
            .iter()
            .all(|m| m.contains("file has no") || m.contains("normals are zero")),
        "{:?}",
        loaded.warnings
    );
    let scene = &loaded.scene;
    let material = &scene.materials[0];
    // Light halves over 4 units in red, and is a quarter in blue.
    let per_unit = 2.0_f32.ln() / 4.0;
    let found = material.absorption.to_array();
    for (found, expected) in found.into_iter().zip([per_unit, 0.0, 2.0 * per_unit]) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    let MaterialKind::Gltf(g) = material.kind else {
        panic!("{material:?}")
    };
    let Some(Bump::Normal { map, scale: 0.5 }) = g.clearcoat_bump else {
        panic!("{g:?}")
    };
    // Directions decide which coordinates come first.
    let direction = mapping_of(scene, g.anisotropy_direction.unwrap());
    assert!(matches!(direction, crate::scene::TextureMapping::Uv(_)));
    let coat = mapping_of(scene, map);
    assert!(matches!(coat, crate::scene::TextureMapping::SecondUv(_)));
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.tangents[1], [1.0, 0.0, 0.0, -1.0]);
    assert_eq!(mesh.second_uvs, mesh.uvs);
    assert_eq!(mesh.uvs[0], [0.0, 0.75]);
}

#[test]
fn textures_of_a_material_may_use_two_sets() {
    let material = |third: u32| {
        format!(
            r#"{SETS}, {PICTURE}, "materials": [ {{ "emissiveFactor": [1, 1, 1],
   "emissiveTexture": {{ "index": 0, "texCoord": {third} }},
   "pbrMetallicRoughness": {{ "baseColorTexture": {{ "index": 0, "texCoord": 1,
      "extensions": {{ "KHR_texture_transform": {{ "texCoord": 2 }} }} }},
     "metallicRoughnessTexture": {{ "index": 0, "texCoord": 1 }} }} }} ]"#
        )
    };
    let loaded = load(&material(2)).unwrap();
    let scene = &loaded.scene;
    let MaterialKind::Gltf(g) = scene.materials[0].kind else {
        panic!("{:?}", scene.materials[0])
    };
    let (ColourParam::Texture(base), FloatParam::Texture(rough)) = (g.base_colour, g.roughness)
    else {
        panic!("{g:?}")
    };
    let second = |id| {
        matches!(
            mapping_of(scene, id),
            crate::scene::TextureMapping::SecondUv(_)
        )
    };
    assert!(!second(base) && second(rough));
    assert!(
        scene.meshes[0].tangents.is_empty(),
        "nothing has a direction"
    );
    let sets = |m: &&str| m.contains("set of coordinates");
    assert!(!messages(&loaded).iter().any(sets));
    // One warning says which texture a third set would lay.
    let three = load(&material(0)).unwrap();
    let told: Vec<_> = messages(&three).into_iter().filter(sets).collect();
    assert!(
        matches!(told[..], [m] if m.starts_with("textures[0] lies by TEXCOORD_1")
            && m.ends_with("TEXCOORD_2 stands in for it")),
        "{told:?}"
    );
}

#[test]
fn meshes_in_several_places_are_instances() {
    let loaded = load(&format!(
        r#"{MESH}, "materials": [ {{}} ],
 "nodes": [ {{ "mesh": 0 }}, {{ "mesh": 0, "scale": [2,2,2] }}, {{ "mesh": 0, "scale": [0,1,1] }} ]"#
    ))
    .unwrap();
    assert_eq!(loaded.scene.instances.len(), 2);
    assert!(shapes(&loaded.scene).is_empty());
    assert!(matches!(
        loaded.scene.objects[0].shapes[0].geometry,
        Geometry::Mesh(_)
    ));
    assert!(messages(&loaded).iter().any(|m| m.contains("nodes[2]")));
}

#[test]
fn damage_is_named() {
    let cases = [
        (r#""nodes": []"#.to_owned(), "nothing to render"),
        (
            format!(r#"{MESH}, "materials": [ {{}} ], "nodes": [ {{ "mesh": 4 }} ]"#),
            "nodes[0].mesh",
        ),
        (
            format!(
                r#"{MESH}, "materials": [ {{}} ], "nodes": [ {{ "mesh": 0, "children": [0] }} ]"#
            ),
            "contain themselves",
        ),
        (
            format!(
                r#"{MESH}, "materials": [ {{}} ], "nodes": [ {{ "mesh": 0 }} ],
                "extensionsUsed": ["KHR_draco_mesh_compression"],
                "extensionsRequired": ["KHR_draco_mesh_compression"]"#
            ),
            "KHR_draco_mesh_compression",
        ),
        (
            MESH.replace("\"indices\": 2", "\"indices\": 1")
                + r#", "materials": [ {} ], "nodes": [ { "mesh": 0 } ]"#,
            "unsigned",
        ),
    ];
    for (more, expected) in cases {
        let error = load(&more).expect_err(expected);
        assert!(error.message().contains(expected), "{}", error.message());
    }
    let limits = Limits::default();
    let error = parse(Path::new("t.gltf"), b"{\n \"asset\": 3", &limits).unwrap_err();
    assert_eq!(error.line(), 2, "{}", error.message());
    let short = triangle(&format!(
        r#"{MESH}, "materials": [ {{}} ], "nodes": [ {{ "mesh": 0 }} ]"#
    ))
    .replace(
        "\"byteOffset\": 36, \"byteLength\": 24",
        "\"byteOffset\": 100, \"byteLength\": 24",
    );
    let error = parse(Path::new("t.gltf"), short.as_bytes(), &limits).unwrap_err();
    assert!(
        error.message().contains("bufferViews[1]"),
        "{}",
        error.message()
    );
}

#[test]
fn attributes_and_extensions_that_the_crate_refuses_are_read() {
    let mesh = MESH.replace("\"POSITION\": 0", "\"POSITION\": 0, \"_BATCH\": 0");
    let loaded = load(&format!(
        r#"{mesh}, "materials": [ {{}} ], "nodes": [ {{ "mesh": 0 }} ],
 "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"]"#
    ))
    .unwrap();
    assert_eq!(shapes(&loaded.scene).len(), 1);
}

#[test]
fn damaged_bytes_never_panic() {
    let good = triangle(&format!(
        r#"{MESH}, "materials": [ {{}} ], "nodes": [ {{ "mesh": 0 }} ]"#
    ))
    .into_bytes();
    let mut state = 1_u64;
    let mut random = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        usize::try_from(state >> 33).unwrap_or(0)
    };
    let limits = Limits::strict();
    for _ in 0..3000 {
        let mut bytes = good.clone();
        for _ in 0..1 + random() % 4 {
            let at = random() % bytes.len();
            match random() % 3 {
                0 => bytes[at] = b"0123456789-.\"[]{},"[random() % 18],
                1 => drop(bytes.remove(at)),
                _ => bytes.insert(at, b"0123456789-\"[]"[random() % 14]),
            }
        }
        if let Ok(loaded) = parse(Path::new("t.gltf"), &bytes, &limits) {
            loaded.scene.validate().unwrap();
        }
    }
}

#[test]
fn positions_need_no_bounds() {
    let nodes = r#""meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ], "nodes": [ { "mesh": 0 } ]"#;
    let whole = triangle(nodes);
    let bare = whole.replace(r#", "min": [0,0,0], "max": [1,1,0]"#, "");
    assert_ne!(whole, bare);
    let read = |text: &str| parse(Path::new("t.gltf"), text.as_bytes(), &Limits::default());
    let (a, b) = (read(&whole).unwrap(), read(&bare).unwrap());
    assert_eq!(a.scene.meshes[0].positions, b.scene.meshes[0].positions);
    let wrong = whole.replace(r#""min": [0,0,0]"#, r#""min": ["a"]"#);
    let error = read(&wrong).unwrap_err().to_string();
    assert!(
        error.contains("positions need a `min` of 3 numbers"),
        "{error}"
    );
}
