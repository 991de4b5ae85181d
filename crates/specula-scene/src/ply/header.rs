//! The header of a PLY file.

use super::{faces, vertices};
use crate::Limits;
use crate::faults::{Fault, Faults};

/// How values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Little,
    Big,
}

/// A number's type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of one value in binary files.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// One property of an element; a list where it has a type for its counts.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) count: Option<Scalar>,
    pub(super) value: Scalar,
}

/// An element: a kind of record in the file.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Fewest bytes that one of it takes.
    fn least_bytes(&self, encoding: Encoding) -> u128 {
        let each = |p: &Property| match encoding {
            // One digit and one blank or line end.
            Encoding::Text => 2,
            Encoding::Little | Encoding::Big => p.count.unwrap_or(p.value).size() as u128,
        };
        self.properties.iter().map(each).sum()
    }
}

/// A header, and what follows it.
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

/// Most lines and properties of a header: no file of use comes near them.
const MOST_LINES: usize = 10_000;

/// Reads a header; returns what follows it.
///
/// # Errors
///
/// Where the header is wrong, or does not end.
pub(super) fn read<'a>(bytes: &'a [u8], faults: &mut Faults) -> Result<(Header, &'a [u8]), Fault> {
    let mut rest = bytes;
    if line(&mut rest)?.trim_end() != "ply" {
        return Err("it is no PLY file: expected `ply` at its beginning".into());
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    for number in 2..MOST_LINES {
        let text = line(&mut rest)?;
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        if words.as_slice() == ["end_header"] {
            if encoding.is_none() {
                faults.record(wrong(number, text, "a line `format` before the end"))?;
            }
            let encoding = encoding.unwrap_or(Encoding::Text);
            return Ok((Header { encoding, elements }, rest));
        }
        if let Err(expected) = read_line(&words, &mut encoding, &mut elements) {
            faults.record(wrong(number, text, expected))?;
        }
    }
    Err("its header does not end".into())
}

fn wrong(number: usize, text: &str, expected: &str) -> Fault {
    let found: String = text.chars().take(60).flat_map(char::escape_debug).collect();
    let message = format!("expected {expected} in the header, found `{found}`");
    Fault::at_line(number, message)
}

/// Adds a line of the header; the error says what was expected.
fn read_line(
    words: &[&str],
    encoding: &mut Option<Encoding>,
    elements: &mut Vec<Element>,
) -> Result<(), &'static str> {
    match words {
        [] | ["comment" | "obj_info", ..] => {}
        ["format", name, _version] => {
            // A stand-in, if it is none of the three: one mistake is not two.
            let known = encoding.insert(Encoding::Text);
            *known = match *name {
                "ascii" => Encoding::Text,
                "binary_little_endian" => Encoding::Little,
                "binary_big_endian" => Encoding::Big,
                _ => return Err("ascii, binary_little_endian or binary_big_endian"),
            };
        }
        ["element", name, count] => {
            let parsed = count.parse();
            elements.push(Element {
                name: (*name).to_owned(),
                count: *parsed.as_ref().unwrap_or(&0),
                properties: Vec::new(),
            });
            parsed.map_err(|_| "a count of elements")?;
        }
        ["property", rest @ ..] => {
            let (Some(property), Some(element)) = (property(rest), elements.last_mut()) else {
                return Err("`property TYPE NAME` or `property list TYPE TYPE NAME`");
            };
            if element.properties.iter().any(|p| p.name == property.name) {
                return Err("another name, as this property is given twice,");
            }
            element.properties.push(property);
        }
        _ => return Err("format, element, property, comment or end_header"),
    }
    Ok(())
}

fn property(words: &[&str]) -> Option<Property> {
    let (count, value, name) = match words {
        ["list", count, value, name] => (Some(Scalar::named(count)?), *value, *name),
        [value, name] => (None, *value, *name),
        _ => return None,
    };
    let whole = count.is_none_or(Scalar::is_integer);
    whole.then_some(Property {
        name: name.to_owned(),
        count,
        value: Scalar::named(value)?,
    })
}

/// The next line without its end.
fn line<'a>(rest: &mut &'a [u8]) -> Result<&'a str, String> {
    // Lines of headers are short; binary data may have no line end for gigabytes.
    let window = &rest[..rest.len().min(4096)];
    let end = window
        .iter()
        .position(|b| *b == b'\n')
        .ok_or("its header is truncated")?;
    let text = std::str::from_utf8(&rest[..end]).map_err(|_| "its header is not text")?;
    *rest = &rest[end + 1..];
    Ok(text)
}

impl Header {
    /// Checks the header against the required properties, the limits, and the file's
    /// length: a count that exceeds the data is an error.
    ///
    /// * `length`: of the data, in bytes.
    ///
    /// # Errors
    ///
    /// Those of [`Faults::record`].
    pub(super) fn check(
        &self,
        length: usize,
        limits: &Limits,
        faults: &mut Faults,
    ) -> Result<(), Fault> {
        // What is missing may be on a line with a mistake.
        let is_whole = faults.is_empty();
        let most = limits.max_vertices;
        let mut least: u128 = 0;
        let mut has_vertices = false;
        for element in &self.elements {
            let (name, count) = (&element.name, element.count);
            if count > 0 && element.properties.is_empty() && is_whole {
                faults.record(format!("element `{name}` has no properties"))?;
            }
            match name.as_str() {
                "vertex" => {
                    has_vertices = true;
                    if is_whole && !vertices::has_positions(element) {
                        faults.record("expected the properties x, y and z of `vertex`")?;
                    }
                }
                "face" if is_whole && !faces::has_indices(element) => {
                    faults.record("expected a list of integers `vertex_indices` of `face`")?;
                }
                _ => {}
            }
            let needed = element.least_bytes(self.encoding) * count as u128;
            least += needed;
            // The last line of a text may lack its end.
            let most_bytes = length as u128 + 1;
            if least > most_bytes {
                if least - needed <= most_bytes {
                    faults.record(format!(
                        "its header promises {count} of `{name}`, but only {length} bytes follow"
                    ))?;
                }
            } else if count as u64 > most {
                faults.record(format!(
                    "it has {count} of `{name}`; at most {most} are read (`max_vertices`)"
                ))?;
            }
        }
        if !has_vertices && is_whole {
            faults.record("it has no element `vertex`")?;
        }
        Ok(())
    }
}
