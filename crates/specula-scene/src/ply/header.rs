//! The header of a PLY file.

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

/// A kind of thing that the file holds.
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
/// A message with the line where the header is wrong, or where it promises more than the file
/// holds.
pub(super) fn read(bytes: &[u8]) -> Result<(Header, &[u8]), String> {
    let mut rest = bytes;
    if line(&mut rest)?.trim_end() != "ply" {
        return Err("it is no PLY file: expected `ply` at its beginning".to_owned());
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    for number in 2..MOST_LINES {
        let text = line(&mut rest)?;
        let wrong = |expected: &str| {
            let found: String = text.chars().take(60).flat_map(char::escape_debug).collect();
            Err(format!(
                "header, line {number}: expected {expected}, found `{found}`"
            ))
        };
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match words.as_slice() {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", name, _version] => {
                encoding = Some(match *name {
                    "ascii" => Encoding::Text,
                    "binary_little_endian" => Encoding::Little,
                    "binary_big_endian" => Encoding::Big,
                    _ => return wrong("ascii, binary_little_endian or binary_big_endian"),
                });
            }
            ["element", name, count] => {
                let Ok(count) = count.parse() else {
                    return wrong("a count of elements");
                };
                elements.push(Element {
                    name: (*name).to_owned(),
                    count,
                    properties: Vec::new(),
                });
            }
            ["property", rest @ ..] => {
                let (Some(property), Some(element)) = (property(rest), elements.last_mut()) else {
                    return wrong("`property TYPE NAME` or `property list TYPE TYPE NAME`");
                };
                if element.properties.iter().any(|p| p.name == property.name) {
                    return wrong("another name: this property is given twice");
                }
                element.properties.push(property);
            }
            ["end_header"] => {
                let Some(encoding) = encoding else {
                    return wrong("a line `format` before the end");
                };
                let header = Header { encoding, elements };
                header.check_promises(rest.len())?;
                return Ok((header, rest));
            }
            _ => return wrong("format, element, property, comment or end_header"),
        }
    }
    Err("its header does not end".to_owned())
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
    /// Holds the counts against the file's length, so that no count is believed that the data
    /// cannot bear.
    fn check_promises(&self, length: usize) -> Result<(), String> {
        let mut least: u128 = 0;
        for element in &self.elements {
            let (name, count) = (&element.name, element.count);
            if count > 0 && element.properties.is_empty() {
                return Err(format!("element `{name}` has no properties"));
            }
            least += element.least_bytes(self.encoding) * count as u128;
            // The last line of a text may lack its end.
            if least > length as u128 + 1 {
                return Err(format!(
                    "its header promises {count} of `{name}`, but only {length} bytes follow"
                ));
            }
        }
        Ok(())
    }
}
