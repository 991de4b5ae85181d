//! Pictures to 8-bit sRGB PNG.

use std::io::{self, Write};
use std::path::Path;

use specula_scene::atomic;

use super::{Display, Picture, PictureError};

/// Writes the colours of `picture` as 8-bit sRGB, whole or not at all.
///
/// * Returns: how many values of the colours were infinite or not a number; they show as white
///   and black.
///
/// # Errors
///
/// Where the file cannot be written; an older file of that name is then still there.
pub fn write_png(path: &Path, picture: &Picture, display: Display) -> Result<usize, PictureError> {
    let pixels: Vec<u8> = picture
        .colour
        .iter()
        .flat_map(|&c| display.to_rgb8(c))
        .collect();
    write_rgb8(path, picture.width, picture.height, &pixels)?;
    let bad = |c: &specula_bsdf::Rgb<f32>| super::count_non_finite(&c.to_array());
    Ok(picture.colour.iter().map(bad).sum())
}

/// The bytes of the file that [`write_png`] writes.
///
/// # Errors
///
/// Where the picture is empty, or its colours are not of its size.
pub fn png_bytes(picture: &Picture, display: Display) -> io::Result<Vec<u8>> {
    let pixels: Vec<u8> = picture
        .colour
        .iter()
        .flat_map(|&c| display.to_rgb8(c))
        .collect();
    let mut bytes = Vec::new();
    encode(&mut bytes, picture.width, picture.height, &pixels).map_err(|e| match e {
        png::EncodingError::IoError(source) => source,
        other => io::Error::other(other.to_string()),
    })?;
    Ok(bytes)
}

/// Writes sRGB bytes, three per pixel, row by row from the top, whole or not at all.
///
/// # Errors
///
/// Where the file cannot be written or `pixels` does not hold `3 * width * height` bytes; an older
/// file of that name is then still there.
pub fn write_rgb8(path: &Path, width: u32, height: u32, pixels: &[u8]) -> Result<(), PictureError> {
    atomic::replace(path, |file| encode(file, width, height, pixels)).map_err(|e| match e {
        png::EncodingError::IoError(source) => PictureError::Io {
            path: path.to_owned(),
            source,
        },
        other => PictureError::Png {
            path: path.to_owned(),
            message: other.to_string(),
        },
    })
}

fn encode(
    file: impl Write,
    width: u32,
    height: u32,
    pixels: &[u8],
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::*;
    use specula_bsdf::{Rgb, math::rgb};

    fn read_back(path: &Path) -> (u32, u32, Vec<u8>) {
        let decoder = png::Decoder::new(std::io::BufReader::new(File::open(path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        bytes.truncate(info.buffer_size());
        (info.width, info.height, bytes)
    }

    #[test]
    fn bytes_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let colours = vec![rgb(0.0, 0.5, 1.0), rgb(0.18, 9.0, f32::NAN)];
        let picture = Picture::from_colour(2, 1, colours);
        let replaced = write_png(&path, &picture, Display::default()).unwrap();
        assert_eq!(replaced, 1);
        assert_eq!(read_back(&path), (2, 1, vec![0, 188, 255, 118, 255, 0]));
        let bytes = png_bytes(&picture, Display::default()).unwrap();
        assert_eq!(bytes, std::fs::read(&path).unwrap());
    }

    #[test]
    fn a_wrong_number_of_bytes_is_an_error_and_keeps_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        write_png(
            &path,
            &Picture::from_colour(1, 1, vec![Rgb::WHITE]),
            Display::default(),
        )
        .unwrap();
        let before = std::fs::read(&path).unwrap();
        assert!(write_rgb8(&path, 4, 4, &[0; 7]).is_err());
        assert_eq!(std::fs::read(&path).unwrap(), before);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
