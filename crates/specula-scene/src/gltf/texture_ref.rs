//! References to textures, from the crate's types or from an extension's JSON.

use gltf::json::Value;

/// A material's reference to a texture: index, set of coordinates and transform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TextureRef {
    pub(super) index: usize,
    pub(super) set: u32,
    pub(super) offset: [f32; 2],
    pub(super) rotation: f32,
    pub(super) scale: [f32; 2],
}

impl TextureRef {
    pub(super) fn plain(index: usize, set: u32) -> Self {
        Self {
            index,
            set,
            offset: [0.0; 2],
            rotation: 0.0,
            scale: [1.0; 2],
        }
    }

    pub(super) fn of(info: &gltf::texture::Info<'_>) -> Self {
        let plain = Self::plain(info.texture().index(), info.tex_coord());
        match info.texture_transform() {
            None => plain,
            Some(t) => Self {
                set: t.tex_coord().unwrap_or(plain.set),
                offset: t.offset(),
                rotation: t.rotation(),
                scale: t.scale(),
                ..plain
            },
        }
    }

    /// The `textureInfo` under a name of an extension's object.
    pub(super) fn in_json(object: &Value, name: &str) -> Option<Self> {
        let info = object.get(name)?;
        let index = usize::try_from(info.get("index")?.as_u64()?).ok()?;
        let plain = Self::plain(index, set(info).unwrap_or(0));
        let extensions = info.get("extensions");
        Some(plain.transformed(extensions.and_then(|e| e.get("KHR_texture_transform"))))
    }

    /// With a `KHR_texture_transform`, if there is one.
    pub(super) fn transformed(self, transform: Option<&Value>) -> Self {
        match transform {
            None => self,
            Some(t) => Self {
                set: set(t).unwrap_or(self.set),
                offset: pair(t, "offset").unwrap_or([0.0; 2]),
                rotation: number(t, "rotation").unwrap_or(0.0),
                scale: pair(t, "scale").unwrap_or([1.0; 2]),
                ..self
            },
        }
    }
}

fn set(object: &Value) -> Option<u32> {
    u32::try_from(object.get("texCoord")?.as_u64()?).ok()
}

fn pair(object: &Value, name: &str) -> Option<[f32; 2]> {
    let [a, b] = numbers(object, name)?;
    Some([a, b])
}

/// A finite number of an extension's object.
pub(super) fn number(object: &Value, name: &str) -> Option<f32> {
    finite(object.get(name)?)
}

/// An array of finite numbers.
pub(super) fn numbers<const N: usize>(object: &Value, name: &str) -> Option<[f32; N]> {
    let list = object.get(name)?.as_array()?;
    let values: Option<Vec<f32>> = list.iter().map(finite).collect();
    values?.try_into().ok()
}

fn finite(value: &Value) -> Option<f32> {
    let x = crate::num::f32_of(value.as_f64()?);
    x.is_finite().then_some(x)
}
