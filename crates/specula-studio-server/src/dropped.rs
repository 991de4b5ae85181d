//! `POST /api/drop`: the files of a scene that were dropped on a page.
//!
//! ```text
//! 4 bytes   length of the JSON, little-endian
//! JSON      {"files": [{"path": "a/scene.pbrt", "bytes": 123}, ...], "scene": "a/scene.pbrt"}
//! files     their bytes, one after the other in that order
//! ```
//!
//! `scene` may be left out: then it is the only scene among the files, or the one that lies highest.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use serde::Deserialize;
use specula_scene::LoadOptions;
use specula_studio::SceneFrom;
use tokio::io::AsyncWriteExt as _;

use crate::body::Pieces;
use crate::error::{Refusal, json_response};
use crate::places;
use crate::scenes::{self, Reading};
use crate::shared::Shared;

/// Most bytes of the JSON.
const MOST_HEAD: u64 = 4 << 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    files: Vec<Item>,
    scene: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Item {
    path: String,
    bytes: u64,
}

/// Reads the scene from a temporary folder, which is removed: what has been read is in memory.
pub(crate) async fn drop(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    body: Body,
) -> Result<Response, Refusal> {
    let Ok(place) = Arc::clone(&shared.loading).try_acquire_owned() else {
        return Err(Refusal::new(
            StatusCode::TOO_MANY_REQUESTS,
            "another scene is being read",
        ));
    };
    let limits = &shared.limits;
    let most = limits
        .drop_bytes
        .saturating_add(MOST_HEAD)
        .saturating_add(4);
    let mut stream = Stream {
        pieces: Pieces::new(&headers, body, most, limits.body_time)?,
        rest: Bytes::new(),
    };
    let head = head(&mut stream, &shared).await?;
    let folder = tempfile::Builder::new().prefix("specula-studio-").tempdir();
    let folder = folder.map_err(|e| unwritable(&e))?;
    // Error messages and links compare with the folder as the system calls it.
    let root = folder.path().canonicalize().map_err(|e| unwritable(&e))?;
    for item in &head.files {
        write(&mut stream, &root, item).await?;
    }
    if stream.next(1).await?.is_some() {
        return Err(Refusal::bad("there are more bytes than the files have"));
    }
    let path = root.join(main_file(&head)?);
    let options = options(&shared, &root);
    let read = scenes::read(
        shared,
        place,
        Reading {
            folder: root,
            path,
            options,
            from: SceneFrom::Dropped,
        },
    )
    .await;
    // Also where a page has gone away; a folder that cannot be removed is not the page's concern.
    let _ = tokio::task::spawn_blocking(move || folder.close()).await;
    Ok(json_response(&read?))
}

async fn head(stream: &mut Stream, shared: &Shared) -> Result<Head, Refusal> {
    let length = stream.exactly(4).await?;
    let length = length.try_into().map_or(0, u32::from_le_bytes);
    if u64::from(length) > MOST_HEAD {
        return Err(Refusal::too_large("the list of files is too long"));
    }
    let text = stream.exactly(length as usize).await?;
    let head: Head = serde_json::from_slice(&text)
        .map_err(|e| Refusal::bad(format!("not a list of files: {e}")))?;
    let limits = &shared.limits;
    if head.files.len() > limits.drop_files {
        let message = format!(
            "{} files were dropped, and at most {} can be",
            head.files.len(),
            limits.drop_files
        );
        return Err(Refusal::too_large(message));
    }
    let all = head
        .files
        .iter()
        .try_fold(0_u64, |sum, item| sum.checked_add(item.bytes));
    if all.is_none_or(|all| all > limits.drop_bytes) {
        return Err(Refusal::too_large(format!(
            "the files have more than {} bytes",
            limits.drop_bytes
        )));
    }
    if let Some(item) = head
        .files
        .iter()
        .find(|item| places::sanitised(&item.path).is_none())
    {
        return Err(Refusal::bad(format!(
            "'{}' is no path of a file below a folder",
            item.path
        )));
    }
    Ok(head)
}

/// Writes a file that is not there yet.
async fn write(stream: &mut Stream, root: &Path, item: &Item) -> Result<(), Refusal> {
    let path = places::sanitised(&item.path).ok_or_else(|| Refusal::bad("not a path"))?;
    let path = root.join(path);
    if let Some(folder) = path.parent() {
        tokio::fs::create_dir_all(folder)
            .await
            .map_err(|e| unwritable(&e))?;
    }
    let mut file = tokio::fs::OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(&path)
        .await
        .map_err(|e| match e.kind() {
            std::io::ErrorKind::AlreadyExists => {
                Refusal::bad(format!("'{}' was dropped twice", item.path))
            }
            _ => unwritable(&e),
        })?;
    let mut left = item.bytes;
    while left > 0 {
        let piece = stream
            .next(left)
            .await?
            .ok_or_else(|| Refusal::bad("the request ends within a file"))?;
        left -= piece.len() as u64;
        file.write_all(&piece).await.map_err(|e| unwritable(&e))?;
    }
    file.flush().await.map_err(|e| unwritable(&e))
}

fn unwritable(error: &std::io::Error) -> Refusal {
    Refusal::internal(format!("the dropped files cannot be written: {error}"))
}

/// Nothing outside of the folder is read, and nothing that a few files should not unpack to.
fn options(shared: &Shared, root: &Path) -> LoadOptions {
    let mut options = shared.load.clone();
    let limits = &mut options.limits;
    limits.max_bytes = limits.max_bytes.min(shared.limits.drop_bytes);
    limits.max_pixels = limits.max_pixels.min(1 << 26);
    limits.max_vertices = limits.max_vertices.min(1 << 26);
    limits.max_files = limits.max_files.min(shared.limits.drop_files);
    options.folders.clear();
    options.confined_to = Some(root.to_owned());
    options
}

/// The path of the scene among the files.
fn main_file(head: &Head) -> Result<PathBuf, Refusal> {
    let paths = || head.files.iter().map(|item| item.path.as_str());
    if let Some(scene) = &head.scene {
        let is_there = paths().any(|path| path == scene);
        let path = places::sanitised(scene).filter(|_| is_there);
        return path.ok_or_else(|| Refusal::bad(format!("'{scene}' is not among the files")));
    }
    let ends = |path: &str, ends: &[&str]| {
        let lower = path.to_ascii_lowercase();
        let lower = lower.strip_suffix(".gz").unwrap_or(&lower);
        ends.iter().any(|end| lower.ends_with(end))
    };
    let scenes: Vec<&str> = paths()
        .filter(|p| ends(p, &[".pbrt", ".xml", ".gltf", ".glb"]))
        .collect();
    let candidates = match scenes.is_empty() {
        false => scenes,
        true => paths().filter(|p| ends(p, &[".obj", ".ply"])).collect(),
    };
    let depth = |path: &&str| path.matches('/').count();
    let highest = candidates.iter().map(depth).min();
    let mut highest = candidates
        .iter()
        .filter(|path| Some(depth(path)) == highest);
    match (highest.next(), highest.next()) {
        (Some(scene), None) => Ok(PathBuf::from(scene)),
        (Some(a), Some(b)) => Err(Refusal::bad(format!(
            "there are several scenes, such as '{a}' and '{b}': name one"
        ))),
        _ => Err(Refusal::bad(
            "there is no scene among the files: expected .pbrt, .xml, .gltf, .glb, .obj or .ply",
        )),
    }
}

/// Bytes, however they were cut into pieces.
struct Stream {
    pieces: Pieces,
    rest: Bytes,
}

impl Stream {
    /// At least one byte and at most `most`; `None` at the end.
    async fn next(&mut self, most: u64) -> Result<Option<Bytes>, Refusal> {
        while self.rest.is_empty() {
            match self.pieces.next().await? {
                Some(piece) => self.rest = piece,
                None => return Ok(None),
            }
        }
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        Ok(Some(self.rest.split_to(most.min(self.rest.len()))))
    }

    async fn exactly(&mut self, count: usize) -> Result<Vec<u8>, Refusal> {
        let mut all = Vec::new();
        while all.len() < count {
            let piece = self.next((count - all.len()) as u64).await?;
            all.extend_from_slice(
                &piece.ok_or_else(|| Refusal::bad("the request ends too early"))?,
            );
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_is_found_among_the_files() {
        let find = |paths: &[&str], scene: Option<&str>| {
            let files = paths
                .iter()
                .map(|p| Item {
                    path: (*p).to_owned(),
                    bytes: 0,
                })
                .collect();
            main_file(&Head {
                files,
                scene: scene.map(str::to_owned),
            })
            .ok()
        };
        let some = |path: &str| Some(PathBuf::from(path));
        assert_eq!(
            find(&["a/b.ply", "a/s.pbrt", "a/t.png"], None),
            some("a/s.pbrt")
        );
        assert_eq!(
            find(&["a/s.pbrt", "a/geometry/m.pbrt"], None),
            some("a/s.pbrt")
        );
        assert_eq!(find(&["s.PBRT.gz"], None), some("s.PBRT.gz"));
        assert_eq!(find(&["m.ply"], None), some("m.ply"));
        assert_eq!(find(&["a.pbrt", "b.pbrt"], None), None);
        assert_eq!(find(&["a.pbrt", "b.pbrt"], Some("b.pbrt")), some("b.pbrt"));
        assert_eq!(find(&["a.pbrt"], Some("../a.pbrt")), None);
        assert_eq!(find(&["a.png"], None), None);
    }
}
