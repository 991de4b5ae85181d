//! OpenEXR, through the crate `exr`: the first layer's R, G, B and A, or its single channel.

use std::io::{BufRead, Seek};
use std::panic::{AssertUnwindSafe, UnwindSafe};
use std::sync::{Arc, LazyLock};

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, f16};

use super::Pixels;
use super::read::{Content, Decoded, check_size};
use crate::Limits;
use crate::spectrum::{ColourSpace, Primaries};

/// Decodes an OpenEXR picture.
///
/// # Errors
///
/// A message where the file is damaged or has no colour channels.
pub(super) fn decode(
    mut source: impl BufRead + Seek,
    content: Content,
    limits: &Limits,
) -> Result<Decoded, String> {
    let meta =
        exr::meta::MetaData::read_from_buffered(&mut source, false).map_err(|e| e.to_string())?;
    for header in &meta.headers {
        let size = header.layer_size;
        check_size(size.width() as u64, size.height() as u64, limits)?;
    }
    source.rewind().map_err(|e| e.to_string())?;
    // A reader that stops half-way is not used again.
    let read = AssertUnwindSafe(|| {
        exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(source)
    });
    let picture = guarded(read).map_err(|e| e.to_string())?;
    let layer = picture.layer_data;
    let channels = &layer.channel_data.list;
    let names: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
    let layer_name = colour_layer(&names)?;
    let channel = |name: &str| {
        let name = format!("{layer_name}{name}");
        let found = names.iter().position(|n| n.eq_ignore_ascii_case(&name))?;
        Some(&channels[found].sample_data)
    };
    let colours = match (channel("R"), channel("G"), channel("B")) {
        (Some(r), Some(g), Some(b)) => vec![r, g, b],
        _ if channels.len() == 1 => vec![&channels[0].sample_data],
        _ => vec![channel("Y").ok_or_else(|| not_a_picture(&names))?],
    };
    let (Ok(width), Ok(height)) = (
        layer.size.width().try_into(),
        layer.size.height().try_into(),
    ) else {
        return Err("its size does not fit 32 bits".to_owned());
    };
    let is_opaque = |alpha: &&FlatSamples| alpha.values_as_f32().all(|a| a == 1.0);
    let alpha = channel("A").filter(|alpha| !is_opaque(alpha));
    Ok(Decoded {
        width,
        height,
        pixels: match (content, alpha) {
            (Content::Colour | Content::Light, _) => interleaved(&colours),
            (Content::Number | Content::Alpha, Some(alpha)) => interleaved(&[alpha]),
            (Content::Number, None) => interleaved(&colours).means(),
            (Content::Alpha, None) => Pixels::ones(colours[0].len()),
        },
        space: picture
            .attributes
            .chromaticities
            .and_then(space)
            .unwrap_or_default(),
    })
}

/// One or three channels as pixels: of 16 bits where they are half floats.
fn interleaved(channels: &[&FlatSamples]) -> Pixels {
    fn of<T: Copy>(channels: &[&Vec<T>]) -> Vec<T> {
        let count = channels.iter().map(|c| c.len()).min().unwrap_or(0);
        let pixel = |i: usize| channels.iter().map(move |c| c[i]);
        (0..count).flat_map(pixel).collect()
    }
    let is_colour = channels.len() == 3;
    let halves: Option<Vec<&Vec<f16>>> = channels
        .iter()
        .map(|c| match c {
            FlatSamples::F16(values) => Some(values),
            FlatSamples::F32(_) | FlatSamples::U32(_) => None,
        })
        .collect();
    if let Some(halves) = halves {
        let bits = of(&halves).into_iter().map(f16::to_bits).collect();
        return Pixels::words(Arc::clone(&HALVES), bits, is_colour);
    }
    let floats: Vec<Vec<f32>> = channels
        .iter()
        .map(|c| c.values_as_f32().collect())
        .collect();
    let floats: Vec<&Vec<f32>> = floats.iter().collect();
    Pixels::floats(of(&floats), is_colour)
}

/// Half floats by their bits; those below 0 are 0, as they are in pictures.
static HALVES: LazyLock<Arc<[f32; 65536]>> = LazyLock::new(|| {
    let mut table = Box::new([0.0_f32; 65536]);
    for (bits, value) in (0..=u16::MAX).zip(table.iter_mut()) {
        let half = f16::from_bits(bits).to_f32();
        // Infinity and what is no number are refused where a pixel has them.
        *value = if half <= 0.0 && half.is_finite() {
            0.0
        } else {
            half
        };
    }
    Arc::from(table)
});

/// Names of channels that are a picture alone: luminance, a colour, coverage, depth, a value.
const ALONE: [&str; 8] = ["Y", "L", "V", "R", "G", "B", "A", "Z"];

/// What the names of a picture's channels begin with: nothing, or the first layer that has a colour.
///
/// # Errors
///
/// Where the channels are no picture.
fn colour_layer(names: &[String]) -> Result<&str, String> {
    let has = |layer: &str, channel: &str| {
        let name = format!("{layer}{channel}");
        names.iter().any(|n| n.eq_ignore_ascii_case(&name))
    };
    let split = |name: &'_ str| name.rfind('.').map_or(0, |dot| dot + 1);
    let layers = names.iter().map(|name| &name[..split(name)]);
    let has_colour =
        |layer: &&str| ["R", "G", "B"].iter().all(|c| has(layer, c)) || has(layer, "Y");
    if let Some(layer) = std::iter::once("").chain(layers).find(has_colour) {
        return Ok(layer);
    }
    match names {
        [name]
            if ALONE
                .iter()
                .any(|a| name[split(name)..].eq_ignore_ascii_case(a)) =>
        {
            Ok("")
        }
        _ => Err(not_a_picture(names)),
    }
}

fn not_a_picture(names: &[String]) -> String {
    let mut found: Vec<String> = names.iter().take(8).map(|n| format!("\"{n}\"")).collect();
    if names.len() > found.len() {
        found.push("...".to_owned());
    }
    format!(
        "expected channels R, G and B, or Y; found {}",
        found.join(", ")
    )
}

/// Runs a reader of the crate `exr`, whose panics become errors. The crate asserts what a damaged file may break: that a block is of the level
/// that the table of blocks says.
///
/// # Errors
///
/// Those of `read`, and one where it panics.
pub fn guarded<T>(
    read: impl FnOnce() -> exr::error::Result<T> + UnwindSafe,
) -> exr::error::Result<T> {
    std::panic::catch_unwind(read).unwrap_or_else(|_| {
        let message = "damaged: its blocks are not those of its table";
        Err(exr::error::Error::Invalid(message.into()))
    })
}

/// The space of a file's chromaticities; Rec. 709 where they make no sense.
fn space(c: exr::meta::attribute::Chromaticities) -> Option<ColourSpace> {
    let pair = |v: exr::math::Vec2<f32>| [f64::from(v.x()), f64::from(v.y())];
    ColourSpace::of(Primaries {
        red: pair(c.red),
        green: pair(c.green),
        blue: pair(c.blue),
        white: pair(c.white),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_that_are_no_picture_are_named() {
        let layer = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|n| (*n).to_owned()).collect();
            colour_layer(&names).map(str::to_owned)
        };
        for sound in [
            &["A", "B", "G", "R"][..],
            &["Y"],
            &["y"],
            &["r"],
            &["Z"],
            &["a.Z"],
        ] {
            assert_eq!(layer(sound).as_deref(), Ok(""), "{sound:?}");
        }
        assert_eq!(layer(&["x.A", "x.B", "x.G", "x.R"]).as_deref(), Ok("x."));
        assert_eq!(layer(&["R", "x.Y"]).as_deref(), Ok("x."));
        for (broken, part) in [
            (&["foo.X"][..], "found \"foo.X\""),
            (&["X", "Y1"], "\"X\", \"Y1\""),
            (&["R", "G"], "\"R\", \"G\""),
        ] {
            let message = layer(broken).unwrap_err();
            assert!(message.contains(part), "{message}");
        }
    }

    /// Its first byte is the fuzzer's choice of a format.
    #[test]
    fn blocks_of_another_level_are_damage() {
        let seed = include_bytes!("../../tests/findings/image-levels.exr");
        let message = decode(
            std::io::Cursor::new(&seed[1..]),
            Content::Light,
            &Limits::default(),
        )
        .err()
        .unwrap();
        assert!(message.contains("damaged"), "{message}");
    }
}
