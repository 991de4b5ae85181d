//! The pages' files: embedded, or from a folder for those who write them.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::error::Refusal;

/// Names and contents of `web/dist`.
static EMBEDDED: &[(&str, &[u8])] = &include!(concat!(env!("OUT_DIR"), "/embedded.rs"));

/// Embedded files, packed when they are first asked for.
static PACKED: OnceLock<Vec<Option<Bytes>>> = OnceLock::new();

/// Where the pages' files come from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Assets {
    /// The program itself.
    #[default]
    Embedded,
    /// A folder, read again for every request.
    Folder(PathBuf),
}

/// A file, plain and where it helps packed by gzip.
struct File {
    plain: Bytes,
    packed: Option<Bytes>,
}

impl Assets {
    /// All files by name.
    pub(crate) fn all(&self) -> Vec<(String, Vec<u8>)> {
        match self {
            Self::Embedded => EMBEDDED
                .iter()
                .map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec()))
                .collect(),
            Self::Folder(folder) => {
                let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
                let names = entries.map(|e| e.file_name().to_string_lossy().into_owned());
                let mut names: Vec<_> = names.collect();
                names.sort();
                let read = |name: String| {
                    let bytes = within(folder, &name)?;
                    Some((name, bytes))
                };
                names.into_iter().filter_map(read).collect()
            }
        }
    }

    fn file(&self, name: &str) -> Option<File> {
        match self {
            Self::Embedded => {
                let at = EMBEDDED.iter().position(|(of, _)| *of == name)?;
                let pack_all = || {
                    EMBEDDED
                        .iter()
                        .map(|(name, bytes)| packed(name, bytes))
                        .collect()
                };
                let packed = PACKED.get_or_init(pack_all);
                Some(File {
                    plain: Bytes::from_static(EMBEDDED[at].1),
                    packed: packed[at].clone(),
                })
            }
            Self::Folder(folder) => Some(File {
                plain: within(folder, name)?.into(),
                packed: None,
            }),
        }
    }

    /// The answer to a request for `path`, which begins with a slash.
    pub(crate) fn response(&self, path: &str, asked: &HeaderMap) -> Response {
        let name = match path {
            "/" => "index.html",
            _ => path.trim_start_matches('/'),
        };
        let file = is_plain(name).then(|| self.file(name)).flatten();
        let Some(file) = file else {
            return Refusal::new(StatusCode::NOT_FOUND, "there is no such page").into_response();
        };
        let etag = etag(&file.plain);
        let mut headers = HeaderMap::new();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(kind(name)));
        headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-cache"));
        headers.insert(header::VARY, HeaderValue::from_static("accept-encoding"));
        if let Ok(value) = HeaderValue::from_str(&etag) {
            headers.insert(header::ETAG, value);
        }
        let lists = |name, wanted: &str| {
            let given = asked
                .get(name)
                .and_then(|value: &HeaderValue| value.to_str().ok());
            given.is_some_and(|given| given.split(',').any(|one| one.trim() == wanted))
        };
        if lists(header::IF_NONE_MATCH, &etag) {
            return (StatusCode::NOT_MODIFIED, headers).into_response();
        }
        let body = match file.packed {
            Some(packed) if lists(header::ACCEPT_ENCODING, "gzip") => {
                headers.insert(header::CONTENT_ENCODING, HeaderValue::from_static("gzip"));
                packed
            }
            _ => file.plain,
        };
        (headers, Body::from(body)).into_response()
    }
}

/// Whether a name is one that a file of the pages can have: nothing that a file system takes for more than a name.
fn is_plain(name: &str) -> bool {
    let is_part = |part: &str| {
        let is_named = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
        !part.is_empty() && !part.starts_with('.') && part.chars().all(is_named)
    };
    name.len() <= 200 && name.split('/').all(is_part)
}

/// A file of a folder, also by its links; none that lies elsewhere.
fn within(folder: &Path, name: &str) -> Option<Vec<u8>> {
    let root = folder.canonicalize().ok()?;
    let path = root.join(name).canonicalize().ok()?;
    match path.starts_with(&root) && path.is_file() {
        true => std::fs::read(path).ok(),
        false => None,
    }
}

fn etag(bytes: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    format!("W/\"{:x}-{:016x}\"", bytes.len(), hasher.finish())
}

fn packed(name: &str, bytes: &[u8]) -> Option<Bytes> {
    let is_text = !matches!(
        kind(name),
        "application/octet-stream" | "image/png" | "font/woff2"
    );
    if !is_text || bytes.len() < 1024 {
        return None;
    }
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(bytes).ok()?;
    encoder.finish().ok().map(Bytes::from)
}

fn kind(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("txt" | "md") => "text/plain; charset=utf-8",
        Some("json" | "map") => "application/json",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("wasm") => "application/wasm",
        Some("woff2") => "font/woff2",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_no_paths_out_of_the_folder() {
        for good in ["index.html", "studio.js", "fonts/a-b_c.woff2"] {
            assert!(is_plain(good), "{good}");
        }
        for bad in [
            "",
            "..",
            "a/../b",
            "/etc/passwd",
            "a//b",
            ".git",
            "a\\b",
            "%2e%2e",
            "a b",
            "C:",
            "a/.b",
            "a/",
        ] {
            assert!(!is_plain(bad), "{bad}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn links_out_of_the_folder_are_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let web = folder.path().join("web");
        std::fs::create_dir(&web).unwrap();
        std::fs::write(folder.path().join("secret.txt"), "secret").unwrap();
        std::fs::write(web.join("a.txt"), "a").unwrap();
        std::os::unix::fs::symlink(folder.path().join("secret.txt"), web.join("b.txt")).unwrap();
        assert!(within(&web, "a.txt").is_some());
        assert!(within(&web, "b.txt").is_none());
    }
}
