//! Meshes in Mitsuba's `.serialized` files, versions 3 and 4.
//!
//! A file holds several meshes, each a header (magic 0x041C and a version, little endian) before a
//! zlib stream, and at its end a table of their offsets. The stream holds flags, from version 4 on
//! a name that ends in zero, the numbers of vertices and of triangles (64 bits), positions,
//! normals, coordinates and colours, each a run of its own in single or double precision, and the
//! triangles' indices (32 bits).
//!
//! Source: Mitsuba's documentation of the plugin `serialized`.

use std::io::Read;
use std::path::Path;

use crate::Limits;
use crate::num::f32_of;
use crate::read_file::Files;
use crate::scene::Mesh;

/// A mesh, and whether its file wants the triangles' own normals.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Serialized {
    pub(crate) mesh: Mesh,
    pub(crate) face_normals: bool,
}

const MAGIC: u16 = 0x041C;
const HAS_NORMALS: u32 = 0x0001;
const HAS_UVS: u32 = 0x0002;
const HAS_COLOURS: u32 = 0x0008;
const FACE_NORMALS: u32 = 0x0010;
const DOUBLE_PRECISION: u32 = 0x2000;

/// Reads mesh `index` of a file.
///
/// # Errors
///
/// A message without the file's name.
pub(crate) fn read(path: &Path, index: u32, files: &Files) -> Result<Serialized, String> {
    let bytes = files.plain(path)?;
    parse(&bytes, index, files.limits())
}

/// Reads mesh `index` from the bytes of a file.
///
/// # Errors
///
/// A message saying what was expected.
pub(crate) fn parse(bytes: &[u8], index: u32, limits: &Limits) -> Result<Serialized, String> {
    let version = version(bytes)?;
    let start = offset(bytes, index, version)?;
    let body = bytes
        .get(start..)
        .ok_or("its table of meshes leads beyond its end")?;
    let version = self::version(body)?;
    let mut stream = Stream {
        // A stream that unpacks to more is taken for a bomb.
        inner: flate2::read::ZlibDecoder::new(&body[4..]).take(limits.max_bytes),
    };
    mesh(&mut stream, version, limits)
}

fn version(bytes: &[u8]) -> Result<u16, String> {
    let Some(&[a, b, c, d]) = bytes.first_chunk::<4>() else {
        return Err("it is truncated: expected a header of 4 bytes".to_owned());
    };
    if u16::from_le_bytes([a, b]) != MAGIC {
        return Err("it is no serialized mesh: expected 0x041C at its beginning".to_owned());
    }
    match u16::from_le_bytes([c, d]) {
        version @ (3 | 4) => Ok(version),
        other => Err(format!("expected version 3 or 4, found {other}")),
    }
}

/// Where mesh `index` begins, by the table at the end of the file.
fn offset(bytes: &[u8], index: u32, version: u16) -> Result<usize, String> {
    if index == 0 {
        return Ok(0);
    }
    let Some(&count) = bytes.last_chunk::<4>() else {
        return Err("it is truncated".to_owned());
    };
    let count = u32::from_le_bytes(count);
    if index >= count {
        return Err(format!("there is no such mesh: the file has {count}"));
    }
    let each = if version == 3 { 4 } else { 8 };
    let back = 4 + each * (count as usize - index as usize);
    let entry = bytes
        .len()
        .checked_sub(back)
        .and_then(|at| bytes.get(at..at + each))
        .ok_or("it is truncated: its table of meshes is missing")?;
    let mut full = [0; 8];
    full[..each].copy_from_slice(entry);
    usize::try_from(u64::from_le_bytes(full)).map_err(|_| "its table of meshes is damaged".into())
}

fn mesh(
    stream: &mut Stream<impl Read>,
    version: u16,
    limits: &Limits,
) -> Result<Serialized, String> {
    let flags = stream.u32()?;
    if version >= 4 {
        // The name.
        while stream.array::<1>()? != [0] {}
    }
    let (vertices, triangles) = (stream.u64()?, stream.u64()?);
    for (count, what) in [(vertices, "vertices"), (triangles, "triangles")] {
        if count > limits.max_vertices.min(u64::from(u32::MAX)) {
            let most = limits.max_vertices;
            return Err(format!(
                "it has {count} {what}; at most {most} are read (`max_vertices`)"
            ));
        }
    }
    let double = flags & DOUBLE_PRECISION != 0;
    let mut out = Mesh {
        positions: stream.floats::<3>(vertices, double)?,
        ..Mesh::default()
    };
    if flags & HAS_NORMALS != 0 {
        out.normals = stream.floats::<3>(vertices, double)?;
    }
    if flags & HAS_UVS != 0 {
        out.uvs = stream.floats::<2>(vertices, double)?;
    }
    if flags & HAS_COLOURS != 0 {
        let colours = stream.floats::<3>(vertices, double)?;
        let tame = |x: f32| if x.is_finite() { x.max(0.0) } else { 0.0 };
        out.colours = colours.into_iter().map(|c| c.map(tame)).collect();
    }
    for _ in 0..triangles {
        let bytes = stream.array::<12>()?;
        let (corners, _) = bytes.as_chunks::<4>();
        let corner = |i: usize| u32::from_le_bytes(corners[i]);
        out.triangles.push([corner(0), corner(1), corner(2)]);
    }
    Ok(Serialized {
        mesh: out,
        face_normals: flags & FACE_NORMALS != 0,
    })
}

struct Stream<R> {
    inner: std::io::Take<R>,
}

impl<R: Read> Stream<R> {
    fn array<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut bytes = [0; N];
        self.inner
            .read_exact(&mut bytes)
            .map_err(|e| format!("it is truncated or damaged: {e}"))?;
        Ok(bytes)
    }

    fn u32(&mut self) -> Result<u32, String> {
        self.array().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Result<u64, String> {
        self.array().map(u64::from_le_bytes)
    }

    /// Allocates as data are read: a header's count is not trusted.
    fn floats<const N: usize>(
        &mut self,
        count: u64,
        double: bool,
    ) -> Result<Vec<[f32; N]>, String> {
        let mut out = Vec::new();
        for _ in 0..count {
            let mut group = [0.0; N];
            for x in &mut group {
                *x = if double {
                    f32_of(f64::from_le_bytes(self.array()?))
                } else {
                    f32::from_le_bytes(self.array()?)
                };
            }
            out.push(group);
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests;
