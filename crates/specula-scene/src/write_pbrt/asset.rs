//! Files beside the scene file: pictures and meshes.

use std::io::{self, BufWriter, Cursor, Write};
use std::path::Path;

use exr::prelude::{WritableImage, f16};
use specula_bsdf::Rgb;

use super::{WriteError, Writer};
use crate::atomic;
use crate::image::Image;
use crate::scene::{Channel, ImageId, Mesh, MeshId};

/// Largest number of EXR's half floats.
const LARGEST_HALF: f32 = 65_504.0;

/// Writes a file; a failure leaves the old one untouched.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    atomic::replace(path, |out| out.write_all(bytes)).map_err(|source| WriteError {
        path: path.to_owned(),
        source,
    })
}

impl Writer<'_> {
    /// Writes a file into the folder; returns its name as the scene file says it.
    pub(super) fn asset(
        &mut self,
        name: &str,
        bytes: impl FnOnce() -> Result<Vec<u8>, WriteError>,
    ) -> Result<String, WriteError> {
        if self.keeps {
            self.keep(name, &bytes()?)?;
        }
        let folder = self.folder.file_name().unwrap_or_default();
        let folder = folder.to_string_lossy().into_owned();
        if !self.keeps {
            self.note(format!(
                "files in {folder} are named only: `specula convert` writes them"
            ));
        }
        Ok(format!("{folder}/{name}"))
    }

    fn keep(&self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        match std::fs::create_dir(&self.folder) {
            Err(source) if source.kind() != io::ErrorKind::AlreadyExists => {
                let path = self.folder.clone();
                return Err(WriteError { path, source });
            }
            _ => {}
        }
        replace(&self.folder.join(name), bytes)
    }

    /// Writes a channel of a picture, once; returns its name.
    pub(super) fn image(&mut self, id: ImageId, channel: Channel) -> Result<String, WriteError> {
        if let Some(name) = self.images.get(&(id, channel)) {
            return Ok(name.clone());
        }
        let image = &self.scene.images[id.0];
        let (suffix, written) = match channel {
            // pbrt takes the mean of the channels where it wants a number.
            Channel::Rgb | Channel::Mean => ("", Channel::Rgb),
            Channel::Luminance => ("-luminance", channel),
            Channel::Red => ("-red", channel),
            Channel::Green => ("-green", channel),
            Channel::Blue => ("-blue", channel),
        };
        let name = format!("picture-{}{suffix}.exr", id.0);
        let name = self.picture(&name, image, |c| written.of(c))?;
        self.images.insert((id, channel), name.clone());
        Ok(name)
    }

    /// Writes a channel of a picture times a colour; returns its name.
    pub(super) fn tinted_image(
        &mut self,
        id: ImageId,
        channel: Channel,
        inverted: bool,
        tint: Rgb<f32>,
    ) -> Result<String, WriteError> {
        let pick = move |c: Rgb<f32>| {
            let c = channel.of(c);
            let c = if inverted {
                c.map(|v| (1.0 - v).max(0.0))
            } else {
                c
            };
            c * tint
        };
        // The number of textures so far is no other file's.
        let name = format!("picture-{}-tinted-{}.exr", id.0, self.textures.len());
        let image = &self.scene.images[id.0];
        self.picture(&name, image, pick)
    }

    /// Writes a picture; returns its name.
    pub(super) fn picture(
        &mut self,
        name: &str,
        image: &Image,
        pick: impl Fn(Rgb<f32>) -> Rgb<f32> + Sync,
    ) -> Result<String, WriteError> {
        let path = self.folder.join(name);
        self.asset(name, || {
            exr_bytes(image, pick).map_err(|e| WriteError {
                path,
                source: io::Error::other(e),
            })
        })
    }

    /// Writes a mesh; returns its name.
    pub(super) fn mesh(&mut self, id: MeshId) -> Result<String, WriteError> {
        let mesh = &self.scene.meshes[id.0];
        self.asset(&format!("mesh-{}.ply", id.0), || Ok(ply(mesh)))
    }
}

/// Half floats where all values fit, else single precision.
fn exr_bytes(
    image: &Image,
    pick: impl Fn(Rgb<f32>) -> Rgb<f32> + Sync,
) -> Result<Vec<u8>, exr::error::Error> {
    use exr::prelude::{Encoding, Image as Exr, ImageAttributes, Layer, LayerAttributes};
    use exr::prelude::{SpecificChannels, Text};
    let (width, height) = (image.width as usize, image.height as usize);
    let at = |p: exr::math::Vec2<usize>| {
        let index = p.1 * width + p.0;
        let inside = index < image.pixels.len();
        pick(if inside {
            Rgb::from(image.pixels.rgb(index))
        } else {
            Rgb::BLACK
        })
    };
    let mut bytes = Cursor::new(Vec::new());
    let attributes = LayerAttributes::named(Text::from("rgb"));
    let size = (width, height);
    let largest = |p: [f32; 3]| {
        let [r, g, b] = pick(Rgb::from(p)).to_array();
        r.max(g).max(b)
    };
    let fits = image.pixels.iter().all(|p| largest(p) <= LARGEST_HALF);
    if fits {
        let half = SpecificChannels::rgb(|p| {
            let c = at(p);
            (f16::from_f32(c.r), f16::from_f32(c.g), f16::from_f32(c.b))
        });
        let layer = Layer::new(size, attributes, Encoding::FAST_LOSSLESS, half);
        Exr::new(ImageAttributes::with_size(size), layer)
            .write()
            .to_buffered(&mut bytes)?;
    } else {
        let single = SpecificChannels::rgb(|p| {
            let c = at(p);
            (c.r, c.g, c.b)
        });
        let layer = Layer::new(size, attributes, Encoding::FAST_LOSSLESS, single);
        Exr::new(ImageAttributes::with_size(size), layer)
            .write()
            .to_buffered(&mut bytes)?;
    }
    Ok(bytes.into_inner())
}

/// A mesh as binary PLY.
fn ply(mesh: &Mesh) -> Vec<u8> {
    let mut out = BufWriter::new(Vec::new());
    // Writing to memory cannot fail.
    let _ = write_ply(mesh, &mut out);
    out.into_inner().unwrap_or_default()
}

fn write_ply(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    let (normals, uvs) = (!mesh.normals.is_empty(), !mesh.uvs.is_empty());
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
        mesh.positions.len()
    )?;
    let mut names = vec!["x", "y", "z"];
    if normals {
        names.extend(["nx", "ny", "nz"]);
    }
    if uvs {
        names.extend(["u", "v"]);
    }
    for name in names {
        writeln!(out, "property float {name}")?;
    }
    write!(
        out,
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.triangles.len()
    )?;
    let mut floats = |values: &[f32]| {
        values
            .iter()
            .try_for_each(|x| out.write_all(&x.to_le_bytes()))
    };
    for (i, p) in mesh.positions.iter().enumerate() {
        floats(p)?;
        if normals {
            floats(&mesh.normals[i])?;
        }
        if uvs {
            floats(&mesh.uvs[i])?;
        }
    }
    for triangle in &mesh.triangles {
        out.write_all(&[3])?;
        for index in triangle {
            out.write_all(&index.to_le_bytes())?;
        }
    }
    Ok(())
}
