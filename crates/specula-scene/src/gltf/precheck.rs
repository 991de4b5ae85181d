//! Checks what the crate `gltf` relies on.

use gltf::json::camera::Type as CameraType;
use gltf::json::extensions::scene::khr_lights_punctual::Type as LightType;
use gltf::json::image::MimeType;
use gltf::json::validation::Checked;
use gltf::json::{Index, Root, mesh::Semantic};

use super::KNOWN_EXTENSIONS;

/// Completes what has a default, takes away what the crate would refuse without need, and names the
/// first thing that is missing or out of range.
pub(super) fn precheck(root: &mut Root) -> Result<(), String> {
    // It knows fewer extensions than are read here.
    root.extensions_required
        .retain(|name| !KNOWN_EXTENSIONS.contains(&name.as_str()));
    let mut of_positions = Vec::new();
    for (i, mesh) in root.meshes.iter_mut().enumerate() {
        for (j, primitive) in mesh.primitives.iter_mut().enumerate() {
            // Attributes of an application's own (`_NAME`), which say nothing to a renderer.
            primitive.attributes.remove(&Checked::Invalid);
            let positions = primitive
                .attributes
                .get(&Checked::Valid(Semantic::Positions));
            if positions.is_some_and(|a| a.value() >= root.accessors.len()) {
                return Err(format!(
                    "meshes[{i}].primitives[{j}].attributes.POSITION: index out of range"
                ));
            }
            of_positions.extend(positions.map(|a| a.value()));
        }
    }
    for index in of_positions {
        // Bounds that nothing reads here.
        let accessor = &mut root.accessors[index];
        for bound in [&mut accessor.min, &mut accessor.max] {
            bound.get_or_insert_with(|| [0; 3].as_slice().into());
        }
    }
    channels(root)?;
    for (i, image) in root.images.iter_mut().enumerate() {
        match (&image.buffer_view, &image.uri) {
            (None, None) => return Err(format!("images[{i}]: expected a bufferView or a uri")),
            // The format is told by the first bytes.
            (Some(_), _) if image.mime_type.is_none() => {
                image.mime_type = Some(MimeType(String::new()));
            }
            _ => {}
        }
    }
    for (i, texture) in root.textures.iter_mut().enumerate() {
        let webp = texture.extensions.as_ref().and_then(|e| {
            let source = e.others.get("EXT_texture_webp")?.get("source")?.as_u64()?;
            u32::try_from(source).ok()
        });
        if let Some(source) = webp {
            texture.source = Index::new(source);
        }
        // The crate's default.
        if texture.source.value() == u32::MAX as usize {
            return Err(format!("textures[{i}]: expected a source"));
        }
    }
    for (i, camera) in root.cameras.iter().enumerate() {
        let complete = match camera.type_ {
            Checked::Valid(CameraType::Perspective) => camera.perspective.is_some(),
            Checked::Valid(CameraType::Orthographic) => camera.orthographic.is_some(),
            Checked::Invalid => true,
        };
        if !complete {
            return Err(format!("cameras[{i}]: its type's object is missing"));
        }
    }
    let lights = root
        .extensions
        .as_ref()
        .and_then(|e| e.khr_lights_punctual.as_ref());
    for (i, light) in lights.iter().flat_map(|l| &l.lights).enumerate() {
        if light.type_ == Checked::Valid(LightType::Spot) && light.spot.is_none() {
            return Err(format!(
                "KHR_lights_punctual.lights[{i}]: expected a spot object"
            ));
        }
    }
    Ok(())
}

/// What animations move, which the crate does not check. Those of pointers, which it does not know, are taken away: a
/// warning names the extension.
fn channels(root: &mut Root) -> Result<(), String> {
    let nodes = root.nodes.len();
    let points = |name: &String| name == "KHR_animation_pointer";
    let points = root.extensions_used.iter().any(points);
    for (i, animation) in root.animations.iter_mut().enumerate() {
        for (j, channel) in animation.channels.iter().enumerate() {
            let what = format!("animations[{i}].channels[{j}].target");
            if channel.target.node.value() >= nodes {
                return Err(format!("{what}.node: index out of range"));
            }
            if channel.target.path == Checked::Invalid && !points {
                return Err(format!(
                    "{what}.path: expected translation, rotation, scale or weights"
                ));
            }
        }
        let is_known = |path: &Checked<_>| matches!(path, Checked::Valid(_));
        animation.channels.retain(|c| is_known(&c.target.path));
    }
    Ok(())
}
