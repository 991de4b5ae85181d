//! The files of a render: checked before it begins, written when it ends and now and then.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use specula::render::picture::{self, Display, Metadata, Picture, PictureError, check_writable};

use super::Failure;

/// Where a render goes.
pub(crate) struct Outputs {
    paths: Vec<PathBuf>,
    display: Display,
}

impl Outputs {
    /// The files asked for; else the scene's name with both extensions, in the current folder.
    ///
    /// Fails where one of them cannot be written: now, not after an hour.
    pub(crate) fn new(
        asked: &[PathBuf],
        scene_name: &str,
        display: Display,
    ) -> Result<Self, Failure> {
        let paths = if asked.is_empty() {
            // Appended: with_extension would cut `a.b` down to `a`.
            vec![
                PathBuf::from(format!("{scene_name}.exr")),
                PathBuf::from(format!("{scene_name}.png")),
            ]
        } else {
            asked.to_vec()
        };
        let mut seen = HashSet::new();
        for path in &paths {
            if !seen.insert(path) {
                return Err(Failure::bad_input(format_args!(
                    "output '{}' is given twice",
                    path.display()
                )));
            }
            check_writable(path)
                .map_err(|e| Failure::other(format_args!("cannot write the picture: {e}")))?;
        }
        Ok(Self { paths, display })
    }

    /// Writes every file; returns how many values were not finite.
    pub(crate) fn write(
        &self,
        picture: &Picture,
        metadata: &Metadata,
    ) -> Result<usize, PictureError> {
        let mut replaced = 0;
        for path in &self.paths {
            let count = if is_png(path) {
                picture::write_png(path, picture, self.display)?
            } else {
                picture::write_exr(path, picture, metadata)?
            };
            replaced = replaced.max(count);
        }
        Ok(replaced)
    }

    /// The files, for messages.
    pub(crate) fn names(&self) -> String {
        let names: Vec<String> = self.paths.iter().map(|p| p.display().to_string()).collect();
        names.join(" and ")
    }
}

fn is_png(path: &Path) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("png"))
}
