//! How textures of two dimensions lie on surfaces.

use super::TextureNode;
use crate::error::{ErrorKind, SceneError};
use crate::num::{f32_of, shorten};
use crate::scene::{TextureMapping, UvMapping};

/// Reads the mapping of a texture.
pub(super) fn mapping(node: &TextureNode<'_>) -> Result<TextureMapping, SceneError> {
    let params = node.params();
    let number = |name: &str, default: f64| params.float(name, default).map(f32_of);
    match params.string("mapping")? {
        None | Some(("uv", _)) => Ok(TextureMapping::Uv(UvMapping::scaled(
            [number("uscale", 1.0)?, number("vscale", 1.0)?],
            [number("udelta", 0.0)?, number("vdelta", 0.0)?],
        ))),
        Some(("spherical", _)) => Ok(TextureMapping::Spherical {
            to_texture: node.to_texture()?,
        }),
        Some(("cylindrical", _)) => Ok(TextureMapping::Cylindrical {
            to_texture: node.to_texture()?,
        }),
        Some(("planar", _)) => {
            let row = |vector: &str, default: [f64; 3], delta: &str| {
                let [x, y, z] = params.array(vector, &["vector3"])?.unwrap_or(default);
                Ok([f32_of(x), f32_of(y), f32_of(z), number(delta, 0.0)?])
            };
            Ok(TextureMapping::Planar {
                to_texture: node.to_texture()?,
                s: row("v1", [1.0, 0.0, 0.0], "udelta")?,
                t: row("v2", [0.0, 1.0, 0.0], "vdelta")?,
            })
        }
        Some((other, place)) => {
            let message = format!("unknown mapping \"{}\"", shorten(other));
            let error = SceneError::new(ErrorKind::Parameter, place, message);
            Err(error.with_help("expected uv, spherical, cylindrical or planar"))
        }
    }
}
