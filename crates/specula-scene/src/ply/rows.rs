//! Lists the wrong rows of a text file, after reading it failed.

use super::faces::is_indices;
use super::header::{Element, Header};
use super::values::number;
use crate::faults::{Fault, Faults};
use crate::num::f32_of;

/// Checks each line against its row. Nothing is listed for texts that do not have a row
/// on each line, which the format does not ask for.
///
/// * `text`: what follows the header.
/// * `first_line`: the number of its first line.
///
/// # Errors
///
/// The first bad row, in an ordinary load.
pub(super) fn name(
    header: &Header,
    text: &[u8],
    first_line: usize,
    faults: &mut Faults,
) -> Result<(), Fault> {
    let vertices = header.elements.iter().find(|e| e.name == "vertex");
    let vertices = vertices.map_or(0, |e| e.count);
    let mut lines = (first_line..)
        .zip(text.split(|b| *b == b'\n'))
        .filter(|(_, line)| !line.trim_ascii().is_empty());
    let mut found = Faults::new(true);
    let (mut good, mut bad) = (0_usize, 0_usize);
    'elements: for element in &header.elements {
        for index in 0..element.count {
            let Some((line, text)) = lines.next() else {
                let (name, count) = (&element.name, element.count);
                found.record(format!("it ends after {index} of {count} of `{name}`"))?;
                break 'elements;
            };
            match row(element, text, vertices) {
                Ok(()) => good += 1,
                Err(message) => {
                    bad += 1;
                    let name = &element.name;
                    found.record(Fault::at_line(line, format!("{name} {index} {message}")))?;
                }
            }
        }
    }
    if bad > good {
        return Ok(());
    }
    faults.append(found)
}

/// What is wrong with a row, after its name.
fn row(element: &Element, line: &[u8], vertices: usize) -> Result<(), String> {
    let mut words = line
        .split(u8::is_ascii_whitespace)
        .filter(|w| !w.is_empty());
    let mut next = |scalar, name: &str| {
        let word = words.next().ok_or_else(|| {
            format!("lacks `{name}`: expected a number, found the end of the line")
        })?;
        number(word, scalar).map_err(|message| format!("has a bad `{name}`: {message}"))
    };
    for property in &element.properties {
        let name = property.name.as_str();
        let is_face = element.name == "face" && is_indices(property);
        let is_position = element.name == "vertex" && matches!(name, "x" | "y" | "z");
        let mut count = 1.0;
        if let Some(scalar) = property.count {
            count = next(scalar, name)?;
            if is_face && count < 3.0 {
                return Err(format!("has {count} vertices; expected at least 3"));
            }
            if count < 0.0 {
                return Err(format!("has a list of {count} values"));
            }
        }
        let mut read = 0.0;
        while read < count {
            let value = next(property.value, name)?;
            if is_face && !(0.0..vertices as f64).contains(&value) {
                return Err(format!(
                    "refers to vertex {value}, but there are {vertices} vertices"
                ));
            }
            if is_position && !f32_of(value).is_finite() {
                return Err(format!("is not finite: `{name}` is {value}"));
            }
            read += 1.0;
        }
    }
    match words.next() {
        None => Ok(()),
        Some(word) => {
            let word = String::from_utf8_lossy(&word[..word.len().min(40)]);
            Err(format!(
                "has too many values: expected the end of the line, found `{}`",
                word.escape_debug()
            ))
        }
    }
}
