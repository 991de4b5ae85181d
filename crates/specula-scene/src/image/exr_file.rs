//! OpenEXR, through the crate `exr`: the first layer's R, G, B and A, or its single channel.

use std::io::Cursor;
use std::panic::UnwindSafe;

use exr::prelude::{ReadChannels, ReadLayers};

use super::read::{Decoded, check_size};
use crate::Limits;
use crate::spectrum::{ColourSpace, Primaries};

/// Decodes an OpenEXR picture.
///
/// # Errors
///
/// A message where the file is damaged or has no colour channels.
pub(super) fn decode(bytes: &[u8], limits: &Limits) -> Result<Decoded, String> {
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false)
        .map_err(|e| e.to_string())?;
    for header in &meta.headers {
        let size = header.layer_size;
        check_size(size.width() as u64, size.height() as u64, limits)?;
    }
    let read = || {
        exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
    };
    let picture = guarded(read).map_err(|e| e.to_string())?;
    let layer = picture.layer_data;
    let channels = &layer.channel_data.list;
    let channel = |name: &str| {
        let found = channels
            .iter()
            .find(|c| c.name.to_string().eq_ignore_ascii_case(name))?;
        Some(found.sample_data.values_as_f32().collect::<Vec<f32>>())
    };
    let pixels: Vec<[f32; 3]> = match (channel("R"), channel("G"), channel("B")) {
        (Some(r), Some(g), Some(b)) => r
            .into_iter()
            .zip(g)
            .zip(b)
            .map(|((r, g), b)| [r, g, b])
            .collect(),
        _ if channels.len() == 1 => channels[0]
            .sample_data
            .values_as_f32()
            .map(|v| [v; 3])
            .collect(),
        _ => channel("Y")
            .ok_or("expected channels R, G and B, or one channel")?
            .into_iter()
            .map(|v| [v; 3])
            .collect(),
    };
    let (Ok(width), Ok(height)) = (
        layer.size.width().try_into(),
        layer.size.height().try_into(),
    ) else {
        return Err("its size does not fit 32 bits".to_owned());
    };
    Ok(Decoded {
        width,
        height,
        pixels,
        alpha: channel("A"),
        space: picture
            .attributes
            .chromaticities
            .and_then(space)
            .unwrap_or_default(),
    })
}

/// What the crate `exr` reads. It asserts what a damaged file may break: that a block is of the level
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

    /// Its first byte is the fuzzer's choice of a format.
    #[test]
    fn blocks_of_another_level_are_damage() {
        let seed = include_bytes!("../../fuzz/findings/image-levels.exr");
        let message = decode(&seed[1..], &Limits::default()).err().unwrap();
        assert!(message.contains("damaged"), "{message}");
    }
}
