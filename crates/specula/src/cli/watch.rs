//! `render --watch`: renders again whenever a file of the scene changes.
//!
//! Files are checked several times a second by name, length and time of change: that works with editors
//! that replace files and on network folders, which tell nobody of changes.

use crate::cli::ExitCode;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, SystemTime};

use crate::render::PreparedScene;

use super::Failure;
use super::console::say;
use super::live_view::LiveView;
use super::outputs;
use super::render::{Context, connect, load};
use super::stop::{Signal, Stop};

/// Between two pictures of a render that is watched.
pub(crate) const PICTURE_EVERY: Duration = Duration::from_secs(2);
/// Between two checks of the files.
const LOOK_EVERY: Duration = Duration::from_millis(200);
/// A file that was changed must stay the same for so long: editors write in steps.
const SETTLED: Duration = Duration::from_millis(100);

/// Renders until Ctrl-C.
pub(crate) fn run(context: &Context<'_>) -> Result<ExitCode, Failure> {
    let arguments = context.arguments;
    let Some(path) = arguments.scene.as_ref().filter(|p| p.is_file()) else {
        return Err(Failure::bad_input(
            "--watch needs the file of a scene: the built-in one does not change, and a pipe is read once",
        ));
    };
    if let Some(film) = arguments.output.iter().find(|o| outputs::is_film(o)) {
        return Err(Failure::bad_input(format_args!(
            "--watch writes pictures only: '{}' is a .film, which goes with one scene",
            film.display()
        )));
    }
    let mut rounds = Rounds {
        context,
        files: vec![path.clone()],
        seen: Snapshot::default(),
        prepared: None,
        live_view: None,
    };
    loop {
        context.stop.begin_again();
        let failed = match rounds.round() {
            Ok(()) => false,
            Err(failure) => {
                failure.print();
                true
            }
        };
        if !context.stop.asked() && !context.stop.changed() {
            rounds.wait(failed);
        }
        if context.stop.asked() {
            let code = context.stop.signal().map_or(0, Signal::exit_code);
            return Ok(ExitCode::from(code));
        }
        say!("the scene has changed");
    }
}

/// What lasts from one render to the next.
struct Rounds<'a> {
    context: &'a Context<'a>,
    /// Of the scene, as it was read last.
    files: Vec<PathBuf>,
    /// How they were when they were read.
    seen: Snapshot,
    prepared: Option<PreparedScene>,
    live_view: Option<LiveView>,
}

impl Rounds<'_> {
    /// Reads the scene and renders it, until that is done or a file changes.
    fn round(&mut self) -> Result<(), Failure> {
        let context = self.context;
        let before = SystemTime::now();
        // First: where reading fails, a change since then counts.
        self.seen = Snapshot::of(&self.files);
        let loaded = load(context.arguments)?;
        self.files.clone_from(&loaded.files);
        self.seen = Snapshot::of(&self.files);
        let seen = &self.seen;
        if self.live_view.is_none() {
            self.live_view = connect(context.arguments, &loaded.name)?;
        }
        let ready = context.ready(loaded)?;
        let done = AtomicBool::new(false);
        let earlier = self.prepared.take();
        std::thread::scope(|scope| {
            scope.spawn(|| interrupt_on_change(seen, before, context.stop, &done));
            let result = context
                .prepare(ready.scene, &ready.options, earlier)
                .and_then(|prepared| {
                    let view = self.live_view.as_mut();
                    let result = context.render(&prepared, ready.rest, view);
                    self.prepared = Some(prepared);
                    result
                });
            done.store(true, Ordering::Relaxed);
            result.map(drop)
        })
    }

    /// Returns when a file has changed, or the program is to end.
    ///
    /// * `failed`: whether the scene could not be read; then files that appear count, too.
    fn wait(&self, failed: bool) {
        let mut folders = Vec::new();
        if failed {
            let of_files = self.files.iter().filter_map(|f| f.parent());
            folders.extend(of_files.map(|f| Path::new(".").join(f)));
            folders.extend_from_slice(&self.context.arguments.loading.search);
        }
        let around = Snapshot::of(&folders);
        let count = self.files.len();
        say!("waiting for changes of {count} files; Ctrl-C ends");
        while !self.context.stop.asked() {
            std::thread::sleep(LOOK_EVERY);
            if self.seen.has_changed() || around.has_changed() {
                std::thread::sleep(SETTLED);
                return;
            }
        }
    }
}

/// Ends the render when a file changes.
///
/// * `before`: when reading began: what is newer was perhaps read as it was.
fn interrupt_on_change(seen: &Snapshot, before: SystemTime, stop: &Stop, done: &AtomicBool) {
    let mut is_stale = seen.is_newer_than(before);
    while !done.load(Ordering::Relaxed) {
        if is_stale {
            std::thread::sleep(SETTLED);
            return stop.scene_changes();
        }
        std::thread::sleep(LOOK_EVERY);
        is_stale = seen.has_changed();
    }
}

/// Files as they were.
#[derive(Default)]
struct Snapshot(Vec<(PathBuf, Option<(SystemTime, u64)>)>);

impl Snapshot {
    fn of(files: &[PathBuf]) -> Self {
        Self(files.iter().map(|f| (f.clone(), state(f))).collect())
    }

    fn has_changed(&self) -> bool {
        self.0.iter().any(|(file, then)| state(file) != *then)
    }

    fn is_newer_than(&self, time: SystemTime) -> bool {
        let newer = |(changed, _): (SystemTime, u64)| changed > time;
        self.0.iter().any(|(_, then)| then.is_some_and(newer))
    }
}

/// When a file was changed last, and its length; `None` where it is gone.
fn state(file: &Path) -> Option<(SystemTime, u64)> {
    let metadata = std::fs::metadata(file).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_seen() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.pbrt");
        std::fs::write(&file, "one").unwrap();
        let files = [file.clone()];
        let seen = Snapshot::of(&files);
        assert!(!seen.has_changed());
        assert!(seen.is_newer_than(SystemTime::UNIX_EPOCH));
        assert!(!seen.is_newer_than(SystemTime::now() + Duration::from_secs(60)));
        std::fs::write(&file, "longer").unwrap();
        assert!(seen.has_changed());
        let seen = Snapshot::of(&files);
        // Replaced, as editors do, by a file of the same length.
        let other = folder.path().join("b");
        std::fs::write(&other, "shorte").unwrap();
        let later = SystemTime::now() + Duration::from_secs(5);
        std::fs::File::options()
            .write(true)
            .open(&other)
            .unwrap()
            .set_modified(later)
            .unwrap();
        std::fs::rename(&other, &file).unwrap();
        assert!(seen.has_changed());
        let seen = Snapshot::of(&files);
        std::fs::remove_file(&file).unwrap();
        assert!(seen.has_changed());
    }
}
