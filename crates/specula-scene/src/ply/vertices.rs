//! The element `vertex`.

use super::header::{Element, Encoding, Scalar};
use super::values::{Values, decode};
use crate::image::Encoding as Transfer;
use crate::num::f32_of;
use crate::scene::Mesh;

/// Names of the surface coordinates in use.
const UV_NAMES: [[&str; 2]; 4] = [
    ["u", "v"],
    ["s", "t"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];

/// Names of vertex colours in use.
const COLOUR_NAMES: [[&str; 3]; 2] = [["red", "green", "blue"], ["r", "g", "b"]];

/// A scalar property of vertices, and its place in a record.
#[derive(Clone, Copy)]
struct Column {
    /// Index among the properties.
    property: usize,
    /// Bytes from the beginning of a record, in binary files.
    offset: usize,
    scalar: Scalar,
}

/// Whether vertices have positions to read.
pub(super) fn has_positions(element: &Element) -> bool {
    columns(element, ["x", "y", "z"]).is_some()
}

/// Reads the vertices and their attributes; the mesh has no triangles yet.
///
/// # Errors
///
/// A message where x, y or z is missing or the data end.
pub(super) fn read(
    element: &Element,
    values: &mut Values<'_>,
    encoding: Encoding,
) -> Result<Mesh, String> {
    let position = columns(element, ["x", "y", "z"])
        .ok_or("expected the properties x, y and z of `vertex`")?;
    let normal = columns(element, ["nx", "ny", "nz"]);
    let uv = UV_NAMES.iter().find_map(|names| columns(element, *names));
    let colour = COLOUR_NAMES.iter().find_map(|n| columns(element, *n));
    let table = Table::read(element, values, encoding)?;
    let mut mesh = Mesh {
        positions: table.attribute(position),
        ..Mesh::default()
    };
    if let Some(normal) = normal {
        mesh.normals = table.attribute(normal);
    }
    if let Some(uv) = uv {
        mesh.uvs = table.attribute(uv);
    }
    if let Some(colour) = colour {
        mesh.colours = table.attribute(colour);
        // Bytes hold sRGB, floats are linear.
        let bytes = colour[0].scalar == Scalar::U8;
        for c in mesh.colours.iter_mut().flatten() {
            let value = f64::from(*c);
            *c = if bytes {
                Transfer::Srgb.decode(value / 255.0)
            } else {
                c.max(0.0)
            };
            if !c.is_finite() {
                *c = 0.0;
            }
        }
    }
    Ok(mesh)
}

fn columns<const N: usize>(element: &Element, names: [&str; N]) -> Option<[Column; N]> {
    let find = |name: &str| {
        let mut offset = 0;
        for (property, p) in element.properties.iter().enumerate() {
            if p.name == name && p.count.is_none() {
                return Some(Column {
                    property,
                    offset,
                    scalar: p.value,
                });
            }
            offset += p.value.size();
        }
        None
    };
    let found = names.map(find);
    if found.iter().any(Option::is_none) {
        return None;
    }
    Some(found.map(|c| {
        c.unwrap_or(Column {
            property: 0,
            offset: 0,
            scalar: Scalar::F32,
        })
    }))
}

/// All numbers of an element.
enum Table<'a> {
    /// Records of one size.
    Records {
        bytes: &'a [u8],
        stride: usize,
        encoding: Encoding,
    },
    /// Rows of numbers, one per property; lists hold their place with 0.
    Rows { numbers: Vec<f64>, width: usize },
}

impl<'a> Table<'a> {
    fn read(
        element: &Element,
        values: &mut Values<'a>,
        encoding: Encoding,
    ) -> Result<Self, String> {
        let scalars = element.properties.iter().all(|p| p.count.is_none());
        if scalars && values.is_binary() {
            let stride = element.properties.iter().map(|p| p.value.size()).sum();
            let bytes = values.records(element.count, stride)?;
            return Ok(Self::Records {
                bytes,
                stride,
                encoding,
            });
        }
        let width = element.properties.len();
        let mut numbers = Vec::with_capacity(element.count.saturating_mul(width));
        for _ in 0..element.count {
            for property in &element.properties {
                match property.count {
                    None => numbers.push(values.next(property.value)?),
                    Some(scalar) => {
                        for _ in 0..values.count(scalar)? {
                            values.next(property.value)?;
                        }
                        numbers.push(0.0);
                    }
                }
            }
        }
        Ok(Self::Rows { numbers, width })
    }

    fn attribute<const N: usize>(&self, columns: [Column; N]) -> Vec<[f32; N]> {
        match self {
            Self::Records {
                bytes,
                stride,
                encoding,
            } => {
                // The common layout: neighbouring little-endian floats.
                let first = columns[0].offset;
                let plain =
                    |(i, c): (usize, &Column)| c.scalar == Scalar::F32 && c.offset == first + 4 * i;
                if *encoding == Encoding::Little && columns.iter().enumerate().all(plain) {
                    let triple = |record: &[u8]| {
                        let mut out = [0.0; N];
                        let floats = record[first..].as_chunks::<4>().0;
                        for (o, b) in out.iter_mut().zip(floats) {
                            *o = f32::from_le_bytes(*b);
                        }
                        out
                    };
                    return bytes.chunks_exact(*stride).map(triple).collect();
                }
                let number = |record: &[u8], c: Column| {
                    let value = &record[c.offset..c.offset + c.scalar.size()];
                    f32_of(decode(value, c.scalar, *encoding))
                };
                bytes
                    .chunks_exact(*stride)
                    .map(|record| columns.map(|c| number(record, c)))
                    .collect()
            }
            Self::Rows { numbers, width } => numbers
                .chunks_exact(*width)
                .map(|row| columns.map(|c| f32_of(row[c.property])))
                .collect(),
        }
    }
}
