//! Portable float maps: `PF` or `Pf`, width, height, scale (negative: little endian), then floats,
//! the lowest row first.

use std::io::{BufRead, Read};

use super::Pixels;
use super::read::{Content, Decoded, check_size};
use crate::Limits;
use crate::spectrum::ColourSpace;

/// Decodes a portable float map.
///
/// # Errors
///
/// A message where the header or the length is wrong.
pub(super) fn decode(
    mut source: impl BufRead,
    content: Content,
    limits: &Limits,
) -> Result<Decoded, String> {
    let mut bytes = Vec::new();
    source
        .by_ref()
        .take(limits.max_bytes)
        .read_to_end(&mut bytes)
        .map_err(|e| format!("cannot be read: {e}"))?;
    let mut rest = bytes.as_slice();
    let channels = match word(&mut rest) {
        Some("PF") => 3,
        Some("Pf") => 1,
        _ => return Err("expected PF or Pf at its beginning".to_owned()),
    };
    let mut number = |what: &str| {
        word(&mut rest)
            .and_then(|w| w.parse::<f64>().ok())
            .filter(|x| x.is_finite() && *x != 0.0)
            .ok_or_else(|| format!("expected {what} in its header"))
    };
    let (width, height, scale) = (number("a width")?, number("a height")?, number("a scale")?);
    let size = |x: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked to be within 1..=65536"
        )]
        ((1.0..=65536.0).contains(&x) && x.fract() == 0.0).then_some(x as u32)
    };
    let (Some(width), Some(height)) = (size(width), size(height)) else {
        return Err(format!(
            "expected a size from 1 to 65536 pixels, found {width} x {height}"
        ));
    };
    check_size(u64::from(width), u64::from(height), limits)?;
    let row = width as usize * channels;
    let expected = row * height as usize * 4;
    if rest.len() < expected {
        return Err(format!(
            "it is truncated: expected {expected} bytes of pixels, found {}",
            rest.len()
        ));
    }
    let read = if scale < 0.0 {
        f32::from_le_bytes
    } else {
        f32::from_be_bytes
    };
    let factor = crate::num::f32_of(scale.abs());
    let mut values = Vec::with_capacity(row * height as usize);
    for y in (0..height as usize).rev() {
        let stored = rest[y * row * 4..(y + 1) * row * 4].as_chunks::<4>().0;
        values.extend(stored.iter().map(|b| factor * read(*b)));
    }
    let colours = Pixels::floats(values, channels == 3);
    Ok(Decoded {
        width,
        height,
        pixels: match content {
            Content::Colour | Content::Light => colours,
            Content::Number => colours.means(),
            Content::Alpha => Pixels::ones(colours.len()),
        },
        space: ColourSpace::Srgb,
    })
}

/// The next word of the header; one blank after it is consumed.
fn word<'a>(rest: &mut &'a [u8]) -> Option<&'a str> {
    let start = rest.iter().position(|b| !b.is_ascii_whitespace())?;
    let length = rest[start..].iter().position(u8::is_ascii_whitespace)?;
    let word = std::str::from_utf8(&rest[start..start + length]).ok()?;
    *rest = &rest[start + length + 1..];
    Some(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_row_of_the_file_is_the_top() {
        let mut bytes = b"Pf\n1 2\n-1.0\n".to_vec();
        bytes.extend(1f32.to_le_bytes());
        bytes.extend(2f32.to_le_bytes());
        let image = decode(bytes.as_slice(), Content::Light, &Limits::default()).unwrap();
        assert_eq!(image.pixels, vec![[2.0; 3], [1.0; 3]].into());
    }

    #[test]
    fn big_endian_and_scale() {
        let mut bytes = b"PF 1 1 2.0\n".to_vec();
        for v in [1f32, 2.0, 3.0] {
            bytes.extend(v.to_be_bytes());
        }
        assert_eq!(
            decode(bytes.as_slice(), Content::Light, &Limits::default())
                .unwrap()
                .pixels,
            vec![[2.0, 4.0, 6.0]].into()
        );
    }

    #[test]
    fn damage_is_an_error() {
        for bad in [
            "",
            "P6 1 1 1\n",
            "PF 1 1",
            "PF 1e9 1e9 -1\n",
            "PF 1.5 1 -1\n",
            "PF 0 1 -1\n",
            "PF 2 2 -1\nabcd",
        ] {
            assert!(
                decode(bad.as_bytes(), Content::Light, &Limits::default()).is_err(),
                "{bad}"
            );
        }
    }
}
