//! OpenEXR, through the crate `exr`: the first layer's R, G, B and A, or its single channel.

use std::io::Cursor;

use exr::prelude::{ReadChannels, ReadLayers};

use super::MAX_PIXELS;
use super::read::Decoded;

/// Decodes an OpenEXR picture.
///
/// # Errors
///
/// A message where the file is damaged or has no colour channels.
pub(super) fn decode(bytes: &[u8]) -> Result<Decoded, String> {
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false)
        .map_err(|e| e.to_string())?;
    for header in &meta.headers {
        let size = header.layer_size;
        if size.width() as u64 * size.height() as u64 > MAX_PIXELS {
            return Err(format!(
                "it has too many pixels: {} x {}",
                size.width(),
                size.height()
            ));
        }
    }
    let picture = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| e.to_string())?;
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
    })
}
