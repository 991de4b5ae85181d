//! Detection of a picture's format by its first bytes; the extension decides only where those do not.

use std::path::Path;

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Exr,
    Pfm,
    Hdr,
    Png,
    Tga,
    Jpeg,
    Tiff,
    Bmp,
    WebP,
}

/// The formats of [`Format`], for messages.
pub(super) const EXPECTED: &str = "OpenEXR, PFM, HDR, PNG, TGA, JPEG, TIFF, BMP or WebP";

impl Format {
    /// By the content, else by the name.
    ///
    /// * `head`: at least the first 12 bytes, where there are as many.
    pub(crate) fn of(head: &[u8], path: &Path) -> Option<Self> {
        Self::of_content(head).or_else(|| Self::of_name(path))
    }

    /// By the content. `None` also for TGA, whose files begin with nothing of their own.
    pub(crate) fn of_content(head: &[u8]) -> Option<Self> {
        const STARTS: [(&[u8], Format); 11] = [
            (b"\x76\x2f\x31\x01", Format::Exr),
            (b"PF\n", Format::Pfm),
            (b"Pf\n", Format::Pfm),
            (b"PF ", Format::Pfm),
            (b"Pf ", Format::Pfm),
            (b"#?", Format::Hdr),
            (b"\x89PNG", Format::Png),
            (b"\xff\xd8", Format::Jpeg),
            (b"II*\0", Format::Tiff),
            (b"MM\0*", Format::Tiff),
            (b"BM", Format::Bmp),
        ];
        if head.starts_with(b"RIFF") && head.get(8..12) == Some(b"WEBP") {
            return Some(Self::WebP);
        }
        let (_, format) = STARTS.iter().find(|(start, _)| head.starts_with(start))?;
        Some(*format)
    }

    /// By the end of a file's name.
    pub(crate) fn of_name(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "exr" => Some(Self::Exr),
            "pfm" => Some(Self::Pfm),
            "hdr" => Some(Self::Hdr),
            "png" => Some(Self::Png),
            "tga" => Some(Self::Tga),
            "jpg" | "jpeg" => Some(Self::Jpeg),
            "tif" | "tiff" => Some(Self::Tiff),
            "bmp" => Some(Self::Bmp),
            "webp" => Some(Self::WebP),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_goes_before_the_name() {
        let of = |head: &[u8], name: &str| Format::of(head, Path::new(name));
        assert_eq!(of(b"\x89PNG\r\n", "a.jpg"), Some(Format::Png));
        assert_eq!(of(b"RIFF\0\0\0\0WEBPVP8 ", "a"), Some(Format::WebP));
        assert_eq!(of(b"RIFF\0\0\0\0WAVE", "a"), None);
        assert_eq!(of(b"\0\0\x02\0", "a.TGA"), Some(Format::Tga));
        assert_eq!(of(b"", "a.exr"), Some(Format::Exr));
    }
}
