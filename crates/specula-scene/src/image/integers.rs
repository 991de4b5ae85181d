//! Formats of the crate `image`: PNG, JPEG, TGA, TIFF, BMP, WebP and HDR, in the depth of the file.

use std::io::{BufRead, Seek};
use std::sync::Arc;

use image::{ColorType, ImageDecoder, ImageFormat, ImageReader};

use super::Pixels;
use super::pixels::take_channels;
use super::read::{Content, Decoded, Encoding, check_size};
use crate::Limits;
use crate::spectrum::ColourSpace;

/// Decodes a picture through the crate `image`.
///
/// # Errors
///
/// A message where the file is damaged or too large.
pub(super) fn decode(
    source: impl BufRead + Seek,
    format: ImageFormat,
    encoding: Encoding,
    content: Content,
    limits: &Limits,
) -> Result<Decoded, String> {
    let mut reader = ImageReader::with_format(source, format);
    let mut memory = image::Limits::no_limits();
    // 4 channels of 4 bytes, and as much again for the decoder.
    memory.max_alloc = Some(limits.max_pixels.saturating_mul(32));
    reader.limits(memory);
    let decoder = reader.into_decoder().map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions();
    check_size(u64::from(width), u64::from(height), limits)?;
    let layout = decoder.color_type();
    let samples = width as usize * height as usize * usize::from(layout.channel_count());
    let pixels = match layout {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => {
            let mut bytes = vec![0_u8; samples];
            decoder.read_image(&mut bytes).map_err(|e| e.to_string())?;
            let table = |encoding: Encoding| {
                let value = |i: usize| encoding.decode(i as f64 / 255.0);
                Box::new(std::array::from_fn(value))
            };
            select(
                bytes,
                layout,
                content,
                u8::MAX,
                &|bytes, is_colour, is_alpha| {
                    let table = table(encoding.unless(is_alpha));
                    Pixels::bytes(table, bytes, is_colour)
                },
            )
        }
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
            let mut words = vec![0_u16; samples];
            decoder
                .read_image(bytemuck::cast_slice_mut(&mut words))
                .map_err(|e| e.to_string())?;
            select(
                words,
                layout,
                content,
                u16::MAX,
                &|words, is_colour, is_alpha| {
                    let encoding = encoding.unless(is_alpha);
                    let value = |i: u16| encoding.decode(f64::from(i) / 65535.0);
                    let table: Box<[f32]> = (0..=u16::MAX).map(value).collect();
                    let table = table.try_into().unwrap_or_else(|_| Box::new([0.0; 65536]));
                    Pixels::words(Arc::from(table), words, is_colour)
                },
            )
        }
        ColorType::Rgb32F | ColorType::Rgba32F => {
            let mut floats = vec![0.0_f32; samples];
            decoder
                .read_image(bytemuck::cast_slice_mut(&mut floats))
                .map_err(|e| e.to_string())?;
            select(floats, layout, content, 1.0, &|floats, is_colour, _| {
                Pixels::floats(floats, is_colour)
            })
        }
        other => return Err(format!("its pixels are {other:?}, which is not read")),
    };
    Ok(Decoded {
        width,
        height,
        pixels,
        space: ColourSpace::Srgb,
    })
}

/// The channels that are wanted.
///
/// * `opaque`: the sample of alpha 1.
/// * `pixels`: of samples, whether there are three for each pixel, and whether they are alpha.
fn select<T: Copy + PartialEq>(
    mut samples: Vec<T>,
    layout: ColorType,
    content: Content,
    opaque: T,
    pixels: &dyn Fn(Vec<T>, bool, bool) -> Pixels,
) -> Pixels {
    let stride = usize::from(layout.channel_count());
    let (is_colour, last) = (layout.has_color(), stride - 1);
    let wants_alpha = matches!(content, Content::Number | Content::Alpha);
    if wants_alpha && layout.has_alpha() && samples.chunks(stride).any(|p| p[last] != opaque) {
        take_channels(&mut samples, stride, last..stride);
        return pixels(samples, false, true);
    }
    if content == Content::Alpha {
        return Pixels::ones(samples.len() / stride);
    }
    if layout.has_alpha() {
        take_channels(&mut samples, stride, 0..last);
    }
    let colours = pixels(samples, is_colour, false);
    if content == Content::Number {
        colours.means()
    } else {
        colours
    }
}
