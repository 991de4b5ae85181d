//! Meshes in PLY files (Turk 1994), plain or gzipped.
//!
//! The crate `ply-rs-bw` reads the format (text and both binary orders, no allocation on a
//! header's word); this module adds what it lacks: a header that promises more than the file
//! holds is an error before anything is read, and polygons become triangles. Known limit: in text
//! files that crate wants a digit before the point (`0.5`, not `.5`).

use std::path::Path;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    BeginList, ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult,
    PropertyType, ScalarType,
};

use crate::num::f32_of;
use crate::read_file::read_bytes;
use crate::scene::Mesh;

/// Reads a mesh. Triangles of polygons fan out from their first vertex, as pbrt-v4's quads do.
///
/// # Errors
///
/// A message that begins with the file's name.
pub(crate) fn read(path: &Path) -> Result<Mesh, String> {
    let wrong = |message: String| format!("mesh {}: {message}", path.display());
    let bytes = read_bytes(path).map_err(wrong)?;
    parse(&bytes).map_err(wrong)
}

/// Reads a mesh from the bytes of a PLY file.
///
/// # Errors
///
/// A message saying what was expected.
pub(crate) fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    if !bytes.starts_with(b"ply") {
        return Err("it is no PLY file: expected `ply` at its beginning".to_owned());
    }
    let mut reader = Reader::new(bytes);
    let header = Parser::<Skipped>::new()
        .read_header(&mut reader)
        .map_err(|e| tidy(&e))?;
    check_promises(&header, bytes.len())?;
    let mut vertices = None;
    let mut faces = Vec::new();
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => {
                let parser = Parser::<Vertex>::new();
                let read = parser.read_payload_for_element(&mut reader, element, &header);
                vertices = Some((element, read.map_err(|e| tidy(&e))?));
            }
            "face" => {
                let parser = Parser::<Face>::new();
                let read = parser.read_payload_for_element(&mut reader, element, &header);
                faces = read.map_err(|e| tidy(&e))?;
            }
            _ => {
                let parser = Parser::<Skipped>::new();
                let read = parser.read_payload_for_element(&mut reader, element, &header);
                read.map_err(|e| tidy(&e))?;
            }
        }
    }
    let (element, vertices) = vertices.ok_or("it has no element `vertex`")?;
    assemble(element, &vertices, &faces)
}

fn assemble(element: &ElementDef, vertices: &[Vertex], faces: &[Face]) -> Result<Mesh, String> {
    let has = |names: [&str; 2]| names.iter().all(|n| element.properties.contains_key(*n));
    if !(has(["x", "y"]) && has(["y", "z"])) {
        return Err("expected the properties x, y and z of `vertex`".to_owned());
    }
    let mut mesh = Mesh {
        positions: vertices.iter().map(|v| v.position).collect(),
        ..Mesh::default()
    };
    if has(["nx", "ny"]) && has(["ny", "nz"]) {
        mesh.normals = vertices.iter().map(|v| v.normal).collect();
    }
    if UV_NAMES.iter().any(|names| has(*names)) {
        mesh.uvs = vertices.iter().map(|v| v.uv).collect();
    }
    let index = |face: usize, i: i64| {
        u32::try_from(i)
            .ok()
            .filter(|i| (*i as usize) < vertices.len())
            .ok_or_else(|| {
                format!(
                    "face {face} refers to vertex {i}, but there are {} vertices",
                    vertices.len()
                )
            })
    };
    mesh.triangles.reserve(faces.len());
    for (number, face) in faces.iter().enumerate() {
        if face.indices.len() < 3 {
            let found = face.indices.len();
            return Err(format!(
                "face {number} has {found} vertices; expected at least 3"
            ));
        }
        let first = index(number, i64::from(face.indices[0]))?;
        let mut previous = index(number, i64::from(face.indices[1]))?;
        for &i in &face.indices[2..] {
            let next = index(number, i64::from(i))?;
            mesh.triangles.push([first, previous, next]);
            previous = next;
        }
    }
    Ok(mesh)
}

/// Holds the header's counts against the file's length, so that no count is believed that the
/// data cannot bear.
fn check_promises(header: &Header, length: usize) -> Result<(), String> {
    let mut least: u128 = 0;
    for (name, element) in &header.elements {
        if element.count > 0 && element.properties.is_empty() {
            return Err(format!("element `{name}` has no properties"));
        }
        let each: u128 = match header.encoding {
            // One digit and one blank or line end for every value.
            Encoding::Ascii => 2 * element.properties.len() as u128,
            _ => element
                .properties
                .iter()
                .map(|(_, p)| least_bytes(&p.data_type))
                .sum(),
        };
        least += each * element.count as u128;
        // The last line of a text may lack its end.
        if least > length as u128 + 1 {
            return Err(format!(
                "its header promises {} of `{name}`, but the file has only {length} bytes",
                element.count
            ));
        }
    }
    Ok(())
}

fn least_bytes(property: &PropertyType) -> u128 {
    let scalar = |s: &ScalarType| match s {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    };
    match property {
        PropertyType::Scalar(s) | PropertyType::List(s, _) => scalar(s),
    }
}

/// The crate's message on one line, without its long quotes of the data.
fn tidy(error: &ply_rs_bw::parser::ParseError) -> String {
    let text = error.to_string();
    let lines = text
        .lines()
        .map(str::trim)
        .filter(|l| !l.is_empty() && !l.starts_with("String:"));
    let mut short: String = lines
        .collect::<Vec<_>>()
        .join(" ")
        .chars()
        .take(300)
        .collect();
    if error.kind() == std::io::ErrorKind::UnexpectedEof {
        short.insert_str(0, "it is truncated: ");
    }
    short
}

/// Names of the surface coordinates in use.
const UV_NAMES: [[&str; 2]; 4] = [
    ["u", "v"],
    ["s", "t"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];

#[derive(Default)]
struct Vertex {
    position: [f32; 3],
    normal: [f32; 3],
    uv: [f32; 2],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let target = match name {
            "x" => &mut self.position[0],
            "y" => &mut self.position[1],
            "z" => &mut self.position[2],
            "nx" => &mut self.normal[0],
            "ny" => &mut self.normal[1],
            "nz" => &mut self.normal[2],
            "u" | "s" | "texture_u" | "texture_s" => &mut self.uv[0],
            "v" | "t" | "texture_v" | "texture_t" => &mut self.uv[1],
            _ => return PropertyAccessResult::Ignored,
        };
        *target = match value {
            Property::Float(x) => x,
            Property::Double(x) => f32_of(x),
            Property::Char(x) => f32::from(x),
            Property::UChar(x) => f32::from(x),
            Property::Short(x) => f32::from(x),
            Property::UShort(x) => f32::from(x),
            Property::Int(x) => f32_of(f64::from(x)),
            Property::UInt(x) => f32_of(f64::from(x)),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

#[derive(Default)]
struct Face {
    indices: Vec<i32>,
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn begin_list_int(&mut self, name: &str, _: usize) -> BeginList<'_, i32> {
        if is_indices(name) {
            BeginList::Fill(&mut self.indices)
        } else {
            BeginList::UseSetter
        }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if !is_indices(name) {
            return PropertyAccessResult::Ignored;
        }
        self.indices = match value {
            Property::ListChar(v) => v.into_iter().map(i32::from).collect(),
            Property::ListUChar(v) => v.into_iter().map(i32::from).collect(),
            Property::ListShort(v) => v.into_iter().map(i32::from).collect(),
            Property::ListUShort(v) => v.into_iter().map(i32::from).collect(),
            // An index beyond i32 is out of range in any mesh that fits; -1 reports it as such.
            Property::ListUInt(v) => v
                .into_iter()
                .map(|i| i32::try_from(i).unwrap_or(-1))
                .collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

fn is_indices(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

/// An element that is read past.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

#[cfg(test)]
mod tests;
