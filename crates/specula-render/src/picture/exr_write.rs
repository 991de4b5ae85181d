//! Pictures to OpenEXR: 32-bit floats, ZIP without loss, one part with all layers.

use std::io::{self, Cursor, Seek, Write};
use std::path::Path;

use exr::block::UncompressedBlock;
use exr::block::writer::ChunksWriter;
use exr::image::write::layers::{LayersWriter, WritableLayers};
use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, SmallVec, Text, Vec2,
};
use rayon::prelude::*;
use specula_bsdf::Rgb;

use specula_scene::atomic;

use super::{Picture, PictureError, finite};

/// Blocks that are compressed at once, for each thread.
const GROUP: usize = 2;
/// Rows of a block that ZIP compresses.
const ROWS: u64 = 16;
/// Bytes of a pixel of all channels: 14 floats.
pub(crate) const ALL_CHANNELS: u64 = 14 * 4;

/// Bytes that are held of blocks while they are compressed: as they are, in the order in which they
/// compress best, and compressed.
///
/// * `width`: of the picture, in pixels.
pub(crate) fn blocks_size(width: u32, threads: usize) -> u64 {
    3 * (GROUP * threads) as u64 * ROWS * ALL_CHANNELS * u64::from(width)
}

/// What is written beside the pixels, as attributes of the file; `None` is left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// Name and version of the program: attribute `software`.
    pub software: Option<String>,
    /// Name of the scene: attribute `specula.scene`.
    pub scene: Option<String>,
    /// Samples per pixel, on average where they differ: attribute `specula.samplesPerPixel`.
    pub samples_per_pixel: Option<u32>,
    /// Seed of the random sequences: attribute `specula.seed`.
    pub seed: Option<u32>,
    /// Seconds that the rendering took: attribute `specula.renderSeconds`.
    pub render_seconds: Option<f32>,
    /// What biases the picture, such as a clamp: attribute `specula.bias`.
    pub bias: Option<String>,
    /// Files of the scene that did not exist, where stand-ins were rendered for them: attribute
    /// `specula.missing`.
    pub missing: Option<String>,
}

/// Writes `picture` as OpenEXR, whole or not at all.
///
/// Channels: `R G B`; `albedo.R/G/B`; `normal.X/Y/Z`; `Z` (depth); `sampleCount`;
/// `variance.R/G/B` — those whose layers are not empty. A crop is the data window within the
/// display window of the whole picture.
///
/// * Returns: how many values were infinite or not a number; 0 was written in their place.
///
/// # Errors
///
/// Where the file cannot be written; an older file of that name is then still there.
pub fn write_exr(
    path: &Path,
    picture: &Picture,
    metadata: &Metadata,
) -> Result<usize, PictureError> {
    atomic::replace(path, |file| encode(picture, metadata, file)).map_err(|source| {
        PictureError::Io {
            path: path.to_owned(),
            source,
        }
    })?;
    Ok(picture.non_finite_count())
}

/// The bytes of the file that [`write_exr`] writes.
///
/// # Errors
///
/// Where the picture cannot be encoded, as its layers are not of its size.
pub fn exr_bytes(picture: &Picture, metadata: &Metadata) -> io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    encode(picture, metadata, &mut bytes)?;
    Ok(bytes.into_inner())
}

fn encode(picture: &Picture, metadata: &Metadata, file: impl Write + Seek) -> io::Result<()> {
    let mut attributes = LayerAttributes {
        layer_position: Vec2(signed(picture.offset[0]), signed(picture.offset[1])),
        software_name: metadata.software.as_deref().map(latin),
        ..LayerAttributes::default()
    };
    attributes.other = custom_attributes(metadata);
    let display_window = IntegerBounds::from_dimensions(Vec2(
        picture.full_resolution[0] as usize,
        picture.full_resolution[1] as usize,
    ));
    let layer = Layer::new(
        Vec2(picture.width as usize, picture.height as usize),
        attributes,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels(picture)),
    );
    let image = Image::empty(ImageAttributes::new(display_window)).with_layer(layer);
    write_blocks(&image, file).map_err(|e| match e {
        exr::error::Error::Io(source) => source,
        other => io::Error::other(other.to_string()),
    })
}

/// Writes the file, its blocks compressed in rayon's current pool.
///
/// Departure: the crate's own writer starts threads for every picture, as many as there are cores,
/// whatever the render was allowed; each takes memory of its own from the allocator.
fn write_blocks<'a, L: WritableLayers<'a>>(
    image: &'a Image<L>,
    file: impl Write + Seek,
) -> exr::error::UnitResult {
    let headers = image.layer_data.infer_headers(&image.attributes);
    let layers = image.layer_data.create_writer(&headers);
    exr::block::write(file, headers, true, |meta, writer| {
        let blocks: Vec<_> = meta.enumerate_ordered_header_block_indices().collect();
        for group in blocks.chunks(GROUP * rayon::current_num_threads()) {
            let compress = |&(number, index)| {
                let data = layers.extract_uncompressed_block(&meta.headers, index);
                let block = UncompressedBlock { index, data };
                Ok((number, block.compress_to_chunk(&meta.headers)?))
            };
            let chunks: exr::error::Result<Vec<_>> = group.par_iter().map(compress).collect();
            for (number, chunk) in chunks? {
                writer.write_chunk(number, chunk)?;
            }
        }
        Ok(())
    })
}

/// OpenEXR's text is one byte per character: others become question marks.
fn latin(text: &str) -> Text {
    let printable: String = text
        .chars()
        .map(|c| {
            if c.is_ascii() && !c.is_ascii_control() {
                c
            } else {
                '?'
            }
        })
        .collect();
    Text::from(printable.as_str())
}

fn signed(pixel: u32) -> i32 {
    i32::try_from(pixel).unwrap_or(i32::MAX)
}

fn custom_attributes(metadata: &Metadata) -> std::collections::HashMap<Text, AttributeValue> {
    let mut other = std::collections::HashMap::new();
    if let Some(scene) = &metadata.scene {
        other.insert(
            Text::from("specula.scene"),
            AttributeValue::Text(latin(scene)),
        );
    }
    if let Some(bias) = &metadata.bias {
        let bias = AttributeValue::Text(latin(bias));
        other.insert(Text::from("specula.bias"), bias);
    }
    if let Some(missing) = &metadata.missing {
        let missing = AttributeValue::Text(latin(missing));
        other.insert(Text::from("specula.missing"), missing);
    }
    if let Some(samples) = metadata.samples_per_pixel {
        other.insert(
            Text::from("specula.samplesPerPixel"),
            AttributeValue::I32(signed(samples)),
        );
    }
    if let Some(seed) = metadata.seed {
        // Text: an attribute of type int is signed and would not hold every seed.
        other.insert(
            Text::from("specula.seed"),
            AttributeValue::Text(latin(&seed.to_string())),
        );
    }
    if let Some(seconds) = metadata.render_seconds {
        other.insert(
            Text::from("specula.renderSeconds"),
            AttributeValue::F32(seconds),
        );
    }
    other
}

fn channels(picture: &Picture) -> SmallVec<[AnyChannel<FlatSamples>; 4]> {
    let mut list = SmallVec::new();
    push_colour(&mut list, "", &picture.colour);
    push_colour(&mut list, "albedo.", &picture.albedo);
    push_colour(&mut list, "variance.", &picture.variance);
    let normals = &picture.normal;
    push(&mut list, "normal.X", normals.iter().map(|n| n.x));
    push(&mut list, "normal.Y", normals.iter().map(|n| n.y));
    push(&mut list, "normal.Z", normals.iter().map(|n| n.z));
    push(&mut list, "Z", picture.depth.iter().copied());
    push(
        &mut list,
        "sampleCount",
        picture.sample_count.iter().copied(),
    );
    list
}

fn push_colour(
    list: &mut SmallVec<[AnyChannel<FlatSamples>; 4]>,
    prefix: &str,
    layer: &[Rgb<f32>],
) {
    push(list, &format!("{prefix}R"), layer.iter().map(|c| c.r));
    push(list, &format!("{prefix}G"), layer.iter().map(|c| c.g));
    push(list, &format!("{prefix}B"), layer.iter().map(|c| c.b));
}

fn push(
    list: &mut SmallVec<[AnyChannel<FlatSamples>; 4]>,
    name: &str,
    values: impl ExactSizeIterator<Item = f32>,
) {
    if values.len() > 0 {
        list.push(AnyChannel::new(
            name,
            FlatSamples::F32(values.map(finite).collect()),
        ));
    }
}
