//! Detection of a scene's format by content; the file's extension decides only where the content does not.

use std::path::Path;

/// A format of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// pbrt-v4.
    Pbrt,
    /// Mitsuba's XML.
    Mitsuba,
    /// glTF 2.0, JSON or binary.
    Gltf,
    /// Wavefront OBJ: a mesh alone.
    Obj,
    /// Stanford PLY: a mesh alone.
    Ply,
}

/// First bytes of a gzip file.
pub(crate) const GZIP: [u8; 2] = [0x1f, 0x8b];
/// First words of lines in OBJ files.
const OBJ_WORDS: [&str; 13] = [
    "v", "vt", "vn", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl", "usemap",
];
/// Bytes in which the first word after comments is searched.
const LONGEST_HEAD: usize = 1 << 16;

impl Format {
    /// By the content, else by the name, else pbrt-v4's.
    ///
    /// * `bytes`: not packed.
    pub(crate) fn of(bytes: &[u8], path: &Path) -> Self {
        Self::of_content(bytes)
            .or_else(|| Self::of_name(path))
            .unwrap_or(Self::Pbrt)
    }

    /// By the extension, before one of `.gz`.
    pub(crate) fn of_name(path: &Path) -> Option<Self> {
        let end = |path: &Path| Some(path.extension()?.to_str()?.to_ascii_lowercase());
        let end = match end(path)? {
            gz if gz == "gz" => end(&path.with_extension(""))?,
            other => other,
        };
        match end.as_str() {
            "pbrt" => Some(Self::Pbrt),
            "xml" => Some(Self::Mitsuba),
            "gltf" | "glb" => Some(Self::Gltf),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            _ => None,
        }
    }

    /// `None`: it may be anything.
    fn of_content(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"glTF") {
            return Some(Self::Gltf);
        }
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            return Some(Self::Ply);
        }
        let head = &bytes[..bytes.len().min(LONGEST_HEAD)];
        let text = String::from_utf8_lossy(head);
        let word = first_word(text.trim_start_matches('\u{feff}'))?;
        match word.chars().next()? {
            '<' => Some(Self::Mitsuba),
            '{' => Some(Self::Gltf),
            _ if OBJ_WORDS.contains(&word) => Some(Self::Obj),
            'A'..='Z' if word.chars().all(|c| c.is_ascii_alphanumeric()) => Some(Self::Pbrt),
            _ => None,
        }
    }
}

/// The first word that is in no comment of pbrt's or OBJ's.
fn first_word(text: &str) -> Option<&str> {
    let mut lines = text.lines().map(str::trim_start);
    let line = lines.find(|l| !l.is_empty() && !l.starts_with('#'))?;
    line.split_whitespace().next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_tells_the_format_and_the_name_what_it_leaves_open() {
        let of = |content: &str, name: &str| Format::of(content.as_bytes(), Path::new(name));
        for (content, format) in [
            ("LookAt 0 0 1  0 0 0  0 1 0", Format::Pbrt),
            ("# made by hand\n\n  Camera \"perspective\"", Format::Pbrt),
            ("\u{feff}<?xml version=\"1.0\"?>\n<scene/>", Format::Mitsuba),
            ("\n<scene version=\"3.0.0\">", Format::Mitsuba),
            ("{ \"asset\": {} }", Format::Gltf),
            ("glTF\u{2}\0\0\0", Format::Gltf),
            ("ply\nformat ascii 1.0", Format::Ply),
            ("# comment\nmtllib a.mtl\nv 0 0 0", Format::Obj),
            ("v 0 0 0\nv 1 0 0", Format::Obj),
        ] {
            for name in ["a", "a.txt", "a.pbrt", "a.xml", "a.glb", "a.obj.gz"] {
                assert_eq!(of(content, name), format, "{content} {name}");
            }
        }
        assert_eq!(of("", "a.gltf"), Format::Gltf);
        assert_eq!(of("# nothing", "a.obj"), Format::Obj);
        assert_eq!(of("what is this", "a.xml.gz"), Format::Mitsuba);
        assert_eq!(of("what is this", "a"), Format::Pbrt);
    }
}
