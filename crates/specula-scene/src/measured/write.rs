//! Tables as a file of the RGL database.

use specula_bsdf::measured::{MeasuredGrid, MeasuredTables};

use super::tensor::{FLOAT32, MAGIC, UINT8};

/// A field to be written.
struct Field {
    name: &'static str,
    dtype: u8,
    shape: Vec<usize>,
    data: Vec<u8>,
}

impl Field {
    fn floats(name: &'static str, shape: &[usize], values: &[f32]) -> Self {
        Self {
            name,
            dtype: FLOAT32,
            shape: shape.to_vec(),
            data: values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }

    fn bytes(name: &'static str, data: &[u8]) -> Self {
        Self {
            name,
            dtype: UINT8,
            shape: vec![data.len()],
            data: data.to_vec(),
        }
    }

    /// Bytes of its part of the header.
    fn header_size(&self) -> usize {
        2 + self.name.len() + 2 + 1 + 8 + 8 * self.shape.len()
    }
}

/// The file of a measurement, with its colours as `rgb`: what Mitsuba reads in its RGB modes.
///
/// * `description`: any text.
#[must_use]
pub fn to_bytes(tables: &MeasuredTables, description: &str) -> Vec<u8> {
    let views = [tables.phi_i.len(), tables.theta_i.len()];
    let of_views = |name, grid: &MeasuredGrid| {
        let [w, h] = grid.size;
        Field::floats(name, &[views[0], views[1], h, w], &grid.values)
    };
    let of_square = |name, grid: &MeasuredGrid| {
        let [w, h] = grid.size;
        Field::floats(name, &[h, w], &grid.values)
    };
    let [w, h] = tables.luminance.size;
    let fields = [
        Field::bytes("description", description.as_bytes()),
        Field::floats("theta_i", &views[1..], &tables.theta_i),
        Field::floats("phi_i", &views[..1], &tables.phi_i),
        of_square("ndf", &tables.ndf),
        of_square("sigma", &tables.sigma),
        of_views("vndf", &tables.vndf),
        of_views("luminance", &tables.luminance),
        Field::floats("rgb", &[views[0], views[1], 3, h, w], &tables.rgb),
        Field::bytes("jacobian", &[u8::from(tables.jacobian)]),
    ];
    assemble(&fields)
}

fn assemble(fields: &[Field]) -> Vec<u8> {
    let header = MAGIC.len() + 6 + fields.iter().map(Field::header_size).sum::<usize>();
    let mut bytes = MAGIC.to_vec();
    bytes.extend([1, 0]);
    bytes.extend(word(fields.len())[..4].iter());
    let mut offset = header;
    for field in fields {
        bytes.extend(&word(field.name.len())[..2]);
        bytes.extend(field.name.as_bytes());
        bytes.extend(&word(field.shape.len())[..2]);
        bytes.push(field.dtype);
        bytes.extend(word(offset));
        for &size in &field.shape {
            bytes.extend(word(size));
        }
        offset += field.data.len();
    }
    for field in fields {
        bytes.extend(&field.data);
    }
    bytes
}

fn word(size: usize) -> [u8; 8] {
    (size as u64).to_le_bytes()
}
