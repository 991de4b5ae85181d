//! Pictures from OpenEXR, by any program: flat, 16- or 32-bit, any compression the codec knows.

use std::path::Path;

use exr::prelude::{AnyChannels, FlatSamples, Layer, ReadChannels, ReadLayers, Vec2, read};
use specula_bsdf::{Rgb, Vec3, math::rgb, math::vec3};
use specula_scene::image::guarded;

use super::{Picture, PictureError};

/// Reads the colours of an EXR file, and the other layers where they bear
/// [`write_exr`](super::write_exr)'s names.
///
/// The colours are the channels `R`, `G`, `B`; else those of the shortest prefix, as in
/// `beauty.R`; else `Y`, grey. The first part that has them counts.
///
/// # Errors
///
/// Where the file is missing, broken, of an unknown compression, or without colours.
pub fn read_exr(path: &Path) -> Result<Picture, PictureError> {
    let read = || {
        read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_file(path)
    };
    let image = guarded(read).map_err(|e| match e {
        exr::error::Error::Io(source) => PictureError::Io {
            path: path.to_owned(),
            source,
        },
        other => PictureError::Exr {
            path: path.to_owned(),
            message: other.to_string(),
        },
    })?;
    let window = image.attributes.display_window;
    for layer in &image.layer_data {
        if let Some(prefix) = colour_prefix(layer) {
            let full = [clamp_u32(window.size.0), clamp_u32(window.size.1)];
            let Vec2(x, y) = layer.attributes.layer_position - window.position;
            return Ok(picture(layer, &prefix, full, [x, y]));
        }
    }
    let found: Vec<String> = image
        .layer_data
        .iter()
        .flat_map(|l| l.channel_data.list.iter().map(|c| c.name.to_string()))
        .take(24)
        .collect();
    Err(PictureError::NoColour {
        path: path.to_owned(),
        found: found.join(", "),
    })
}

type FlatLayer = Layer<AnyChannels<FlatSamples>>;

fn clamp_u32(size: usize) -> u32 {
    u32::try_from(size).unwrap_or(u32::MAX)
}

/// What stands before `R`, `G` and `B` (or, for grey, all of `Y`) in the names of the colours.
fn colour_prefix(layer: &FlatLayer) -> Option<String> {
    let names: Vec<String> = layer
        .channel_data
        .list
        .iter()
        .map(|c| c.name.to_string())
        .collect();
    let has = |name: String| names.contains(&name);
    let coloured = names
        .iter()
        .filter_map(|name| name.strip_suffix('R'))
        .filter(|p| p.is_empty() || p.ends_with('.'))
        .filter(|p| has(format!("{p}G")) && has(format!("{p}B")))
        .min_by_key(|p| p.len())
        .map(str::to_owned);
    coloured.or_else(|| has("Y".to_owned()).then(|| "Y".to_owned()))
}

fn picture(layer: &FlatLayer, prefix: &str, full: [u32; 2], offset: [i32; 2]) -> Picture {
    let names = if prefix == "Y" {
        ["Y".to_owned(), "Y".to_owned(), "Y".to_owned()]
    } else {
        ["R", "G", "B"].map(|c| format!("{prefix}{c}"))
    };
    Picture {
        width: clamp_u32(layer.size.0),
        height: clamp_u32(layer.size.1),
        full_resolution: full,
        // A data window that starts outside the display window (overscan) is placed at its edge.
        offset: offset.map(|o| u32::try_from(o).unwrap_or(0)),
        colour: colours(layer, &names),
        albedo: colours(
            layer,
            &["albedo.R", "albedo.G", "albedo.B"].map(str::to_owned),
        ),
        normal: normals(layer),
        depth: values(layer, "Z"),
        sample_count: values(layer, "sampleCount"),
        variance: colours(
            layer,
            &["variance.R", "variance.G", "variance.B"].map(str::to_owned),
        ),
    }
}

/// The channel's values, one per pixel; none where it is missing or subsampled.
fn values(layer: &FlatLayer, name: &str) -> Vec<f32> {
    layer
        .channel_data
        .list
        .iter()
        .find(|c| c.name.to_string() == name && c.sampling == Vec2(1, 1))
        .map(|c| c.sample_data.values_as_f32().collect())
        .unwrap_or_default()
}

fn colours(layer: &FlatLayer, names: &[String; 3]) -> Vec<Rgb<f32>> {
    let [r, g, b] = [0, 1, 2].map(|i| values(layer, &names[i]));
    r.iter()
        .zip(&g)
        .zip(&b)
        .map(|((&r, &g), &b)| rgb(r, g, b))
        .collect()
}

fn normals(layer: &FlatLayer) -> Vec<Vec3<f32>> {
    let [x, y, z] = ["normal.X", "normal.Y", "normal.Z"].map(|n| values(layer, n));
    x.iter()
        .zip(&y)
        .zip(&z)
        .map(|((&x, &y), &z)| vec3(x, y, z))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Metadata, write_exr};
    use super::*;

    fn full() -> Picture {
        let n = 6u16;
        let value = |i: u16| f32::from(i) * 0.1 + 1.0e-7;
        let colours = |k: u16| (0..n).map(|i| rgb(value(i), value(i * k), 1.0e6)).collect();
        Picture {
            width: 3,
            height: 2,
            full_resolution: [10, 8],
            offset: [4, 5],
            colour: colours(2),
            albedo: colours(3),
            normal: (0..n).map(|i| vec3(value(i), -value(i), 0.5)).collect(),
            depth: (0..n).map(value).collect(),
            sample_count: vec![16.0; 6],
            variance: colours(5),
        }
    }

    /// Found by fuzzing; its first byte is the fuzzer's choice of a format.
    #[test]
    fn blocks_of_another_level_are_damage() {
        let seed = include_bytes!("../../tests/data/image-levels.exr");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("levels.exr");
        std::fs::write(&path, &seed[1..]).unwrap();
        let error = read_exr(&path).unwrap_err();
        assert!(matches!(error, PictureError::Exr { .. }), "{error}");
    }

    #[test]
    fn every_layer_and_the_crop_come_back_exactly() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let metadata = Metadata {
            software: Some("specula 0.1".to_owned()),
            scene: Some("Übung\n".to_owned()),
            samples_per_pixel: Some(16),
            seed: Some(u32::MAX),
            render_seconds: Some(1.5),
            bias: Some("regularized".to_owned()),
            missing: Some("a.png".to_owned()),
        };
        assert_eq!(write_exr(&path, &full(), &metadata).unwrap(), 0);
        assert_eq!(read_exr(&path).unwrap(), full());

        let header = exr::meta::MetaData::read_from_file(&path, false).unwrap();
        let own = &header.headers[0].own_attributes;
        assert_eq!(
            own.software_name.as_ref().unwrap().to_string(),
            "specula 0.1"
        );
        assert_eq!(own.other.len(), 6);
    }

    #[test]
    fn values_that_are_not_numbers_are_replaced_and_counted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let mut picture = full();
        picture.colour[1] = rgb(f32::NAN, 2.0, f32::INFINITY);
        picture.depth[0] = f32::INFINITY;
        assert_eq!(write_exr(&path, &picture, &Metadata::default()).unwrap(), 3);
        let back = read_exr(&path).unwrap();
        assert_eq!(back.colour[1], rgb(0.0, 2.0, 0.0));
        assert_eq!(back.non_finite_count(), 0);
    }

    #[test]
    fn a_picture_with_an_alpha_channel_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rgba.exr");
        exr::prelude::write_rgba_file(&path, 2, 2, |x, y| {
            let v = if x == y { 0.25f32 } else { 4.0 };
            (v, v * 2.0, v, 1.0f32)
        })
        .unwrap();
        let picture = read_exr(&path).unwrap();
        assert_eq!(picture.colour[3], rgb(0.25, 0.5, 0.25));
        assert!(picture.albedo.is_empty() && picture.variance.is_empty());
    }

    #[test]
    fn broken_files_are_errors() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        assert!(matches!(read_exr(&path), Err(PictureError::Io { .. })));
        std::fs::write(&path, b"not a picture").unwrap();
        assert!(matches!(read_exr(&path), Err(PictureError::Exr { .. })));
        write_exr(&path, &full(), &Metadata::default()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
        assert!(read_exr(&path).is_err());
    }

    #[test]
    fn a_failed_write_leaves_the_old_picture() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        write_exr(&path, &full(), &Metadata::default()).unwrap();
        // A picture without pixels has no place in a file: the codec refuses it.
        let empty = Picture::default();
        assert!(write_exr(&path, &empty, &Metadata::default()).is_err());
        assert_eq!(read_exr(&path).unwrap(), full());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
