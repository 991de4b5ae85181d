//! The container of the RGL database: named arrays of numbers, little endian.
//!
//! ```text
//! "tensor_file\0", u8 1, u8 0, u32 fields
//! each field: u16 length, name, u16 dimensions, u8 type, u64 offset, u64 size of each dimension
//! ```
//!
//! Every size is checked against the file's length before anything is stored.
//!
//! Source: the loader of Dupuy and Jakob 2018 and Mitsuba 3's `TensorFile`.

/// The first bytes of a file.
pub(super) const MAGIC: &[u8; 12] = b"tensor_file\0";

/// Most dimensions of a field.
const MOST_DIMENSIONS: usize = 16;

/// Types of elements by their codes, with their sizes in bytes.
const TYPES: [(u8, &str, usize); 11] = [
    (UINT8, "uint8", 1),
    (2, "int8", 1),
    (3, "uint16", 2),
    (4, "int16", 2),
    (5, "uint32", 4),
    (6, "int32", 4),
    (7, "uint64", 8),
    (8, "int64", 8),
    (9, "float16", 2),
    (FLOAT32, "float32", 4),
    (11, "float64", 8),
];

/// The code of bytes.
pub(super) const UINT8: u8 = 1;
/// The code of `f32`.
pub(super) const FLOAT32: u8 = 10;

/// The fields of a file.
#[derive(Debug)]
pub(super) struct TensorFile<'a> {
    fields: Vec<Field<'a>>,
}

/// A named array.
#[derive(Debug)]
pub(super) struct Field<'a> {
    name: &'a str,
    /// Index into [`TYPES`].
    dtype: usize,
    pub(super) shape: Vec<usize>,
    data: &'a [u8],
}

impl<'a> TensorFile<'a> {
    /// # Errors
    ///
    /// What was expected.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, String> {
        let mut header = Cursor { bytes, at: 0 };
        if header.take(MAGIC.len())? != MAGIC {
            return Err("does not begin with \"tensor_file\"".to_owned());
        }
        let version = header.take(2)?;
        if version != [1, 0] {
            let [major, minor] = [version[0], version[1]];
            return Err(format!("is of version {major}.{minor}; expected 1.0"));
        }
        let count = header.number::<4>()?;
        let mut fields: Vec<Field<'a>> = Vec::new();
        for _ in 0..count {
            let field = Self::field(&mut header)?;
            if fields.iter().any(|f| f.name == field.name) {
                return Err(format!("has the field \"{}\" twice", field.name));
            }
            fields.push(field);
        }
        Ok(Self { fields })
    }

    fn field(header: &mut Cursor<'a>) -> Result<Field<'a>, String> {
        let length = header.size::<2>()?;
        let name = core::str::from_utf8(header.take(length)?)
            .map_err(|_| "has a field whose name is not UTF-8".to_owned())?;
        // A damaged name must not make a long message.
        let name = name.get(..name.len().min(64)).unwrap_or("?");
        let dimensions = header.size::<2>()?;
        if dimensions > MOST_DIMENSIONS {
            return Err(format!(
                "\"{name}\" has {dimensions} dimensions; expected at most {MOST_DIMENSIONS}"
            ));
        }
        let code = header.take(1)?[0];
        let dtype = TYPES.iter().position(|t| t.0 == code);
        let dtype = dtype.ok_or_else(|| format!("\"{name}\" has the unknown type {code}"))?;
        let offset = header.size::<8>()?;
        let shape = (0..dimensions).map(|_| header.size::<8>());
        let shape = shape.collect::<Result<Vec<_>, _>>()?;
        let mut bytes = Some(TYPES[dtype].2);
        for &size in &shape {
            bytes = bytes.and_then(|b| b.checked_mul(size));
        }
        let end = bytes.and_then(|b| offset.checked_add(b));
        let data = end.and_then(|end| header.bytes.get(offset..end));
        let data = data.ok_or_else(|| {
            format!(
                "is shorter than its field \"{name}\" of {} says",
                by(&shape)
            )
        })?;
        Ok(Field {
            name,
            dtype,
            shape,
            data,
        })
    }

    /// A field of a type and number of dimensions.
    ///
    /// # Errors
    ///
    /// Where there is none.
    pub(super) fn get(
        &self,
        name: &str,
        code: u8,
        dimensions: usize,
    ) -> Result<&Field<'a>, String> {
        let field = self.find(name);
        let field = field.ok_or_else(|| format!("has no field \"{name}\""))?;
        let (found, type_name, _) = TYPES[field.dtype];
        if found != code {
            let expected = TYPES.iter().find(|t| t.0 == code).map_or("?", |t| t.1);
            return Err(format!(
                "\"{name}\" has the type {type_name}; expected {expected}"
            ));
        }
        if field.shape.len() != dimensions {
            let found = field.shape.len();
            return Err(format!(
                "\"{name}\" has {found} dimensions; expected {dimensions}"
            ));
        }
        Ok(field)
    }

    pub(super) fn find(&self, name: &str) -> Option<&Field<'a>> {
        self.fields.iter().find(|f| f.name == name)
    }
}

impl Field<'_> {
    /// The elements of a field of `f32`.
    pub(super) fn floats(&self) -> impl ExactSizeIterator<Item = f32> {
        let word = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
        self.data.chunks_exact(4).map(word)
    }

    /// The elements of a field of bytes.
    pub(super) fn bytes(&self) -> &[u8] {
        self.data
    }

    /// # Errors
    ///
    /// Where the shape is another.
    pub(super) fn expect(&self, shape: &[usize]) -> Result<(), String> {
        if self.shape == shape {
            return Ok(());
        }
        let (name, found, expected) = (self.name, by(&self.shape), by(shape));
        Err(format!(
            "\"{name}\" has the shape {found}; expected {expected}"
        ))
    }
}

fn by(shape: &[usize]) -> String {
    let sizes: Vec<String> = shape.iter().map(usize::to_string).collect();
    if sizes.is_empty() {
        return "one number".to_owned();
    }
    sizes.join(" x ")
}

/// A place in the header.
struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let end = self.at.checked_add(count);
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        let taken = taken.ok_or_else(|| "ends within its header".to_owned())?;
        self.at += count;
        Ok(taken)
    }

    fn number<const N: usize>(&mut self) -> Result<u64, String> {
        let mut word = [0; 8];
        word[..N].copy_from_slice(self.take(N)?);
        Ok(u64::from_le_bytes(word))
    }

    fn size<const N: usize>(&mut self) -> Result<usize, String> {
        let number = self.number::<N>()?;
        usize::try_from(number).map_err(|_| format!("has the size {number}: it is too large"))
    }
}
