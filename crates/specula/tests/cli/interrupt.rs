//! Ctrl-C, SIGTERM and SIGHUP during a long render.

use std::io::{BufRead, BufReader};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, ChildStderr, Command, ExitStatus, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crate::common::{heeding_signals, send, small_scene, specula};
use specula::render::FilmFile;
use specula::render::picture::{Picture, read_exr};

/// A closed sphere that loses nothing, so that every path has a thousand vertices: a pass of one sample
/// takes about a second on one core.
const CLOSED: &str = r#"
LookAt 0 0 0  0 1 0  0 0 1
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 64 "integer yresolution" 48
Sampler "halton" "integer pixelsamples" 4
Integrator "path" "integer maxdepth" 1000
WorldBegin
AttributeBegin
AreaLightSource "diffuse" "rgb L" [1 1 1]
Translate 0 0 3
Shape "sphere" "float radius" 0.1
AttributeEnd
Material "diffuse" "rgb reflectance" [1 1 1]
Shape "sphere" "float radius" 4
"#;

/// A render that was begun, and what it says.
struct Render {
    child: Child,
    said: BufReader<ChildStderr>,
    text: String,
}

impl Render {
    fn start(folder: &Path, scene: &Path, arguments: &[&str]) -> Self {
        let mut child = heeding_signals()
            .current_dir(folder)
            .args(["render", "--threads", "1", "-o", "a.exr"])
            .args(arguments)
            .arg(scene)
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let said = BufReader::new(child.stderr.take().expect("a pipe"));
        Self {
            child,
            said,
            text: String::new(),
        }
    }

    fn interrupt(&self) {
        send("INT", self.child.id());
    }

    /// Reads until it has said `wanted`.
    fn wait_for(&mut self, wanted: &str) {
        while !self.text.contains(wanted) {
            let read = self.said.read_line(&mut self.text).expect("text");
            assert!(read > 0, "ended without `{wanted}`:\n{}", self.text);
        }
    }

    /// Its end. After a minute it is killed.
    fn end(mut self) -> (ExitStatus, String) {
        let start = Instant::now();
        let id = self.child.id();
        let (ended, end) = channel::<()>();
        let watch = std::thread::spawn(move || {
            if end.recv_timeout(Duration::from_secs(60)) == Err(RecvTimeoutError::Timeout) {
                send("KILL", id);
            }
        });
        while self.said.read_line(&mut self.text).expect("text") > 0 {}
        let status = self.child.wait().expect("it ends");
        drop(ended);
        watch.join().expect("the watch ends");
        assert!(start.elapsed() < Duration::from_secs(60), "{}", self.text);
        (status, self.text)
    }
}

/// The least and the most samples of a pixel.
fn counts(picture: &Picture) -> [f32; 2] {
    let counts = picture.sample_count.iter();
    let fold = |[a, b]: [f32; 2], &n: &f32| [a.min(n), b.max(n)];
    counts.fold([f32::INFINITY, 0.0], fold)
}

/// A folder with the closed scene.
fn closed_scene() -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = folder.path().join("closed.pbrt");
    std::fs::write(&scene, CLOSED).expect("a writable folder");
    (folder, scene)
}

#[test]
fn the_first_interrupt_finishes_the_pass_and_writes() {
    let (folder, scene) = closed_scene();
    let mut render = Render::start(folder.path(), &scene, &["--spp", "1000"]);
    render.wait_for("ready after");
    std::thread::sleep(Duration::from_millis(50));
    render.interrupt();
    render.wait_for("finishing the ");
    let (status, text) = render.end();
    assert_eq!(status.code(), Some(130), "{text}");
    assert!(text.contains("Ctrl-C again to stop at once"), "{text}");
    assert!(text.contains("stopped by Ctrl-C"), "{text}");
    let picture = read_exr(&folder.path().join("a.exr")).unwrap();
    let [least, most] = counts(&picture);
    assert!(least >= 1.0 && least == most, "{least} {most}\n{text}");
    assert_eq!(picture.non_finite_count(), 0);
}

#[test]
fn many_short_passes_end_with_the_first_interrupt() {
    let (folder, scene) = small_scene();
    let mut render = Render::start(
        folder.path(),
        &scene,
        &["--spp", "16000000", "--adaptive=off"],
    );
    std::thread::sleep(Duration::from_millis(1500));
    assert!(render.child.try_wait().unwrap().is_none());
    render.interrupt();
    let (status, text) = render.end();
    assert_eq!(status.code(), Some(130), "{text}");
    assert!(text.contains("stopped by Ctrl-C"), "{text}");
    let [least, most] = counts(&read_exr(&folder.path().join("a.exr")).unwrap());
    assert!(least >= 1.0 && least == most, "{least} {most}\n{text}");
}

#[test]
fn the_second_interrupt_stops_between_tiles_and_the_render_can_be_resumed() {
    let (folder, scene) = closed_scene();
    let mut render = Render::start(folder.path(), &scene, &["--spp", "2"]);
    render.wait_for("ready after");
    // A few tiles of twelve.
    std::thread::sleep(Duration::from_millis(300));
    render.interrupt();
    render.wait_for("finishing the first pass");
    render.interrupt();
    render.wait_for("stopping within the pass");
    let (status, text) = render.end();
    assert_eq!(status.code(), Some(130), "{text}");
    let [least, most] = counts(&read_exr(&folder.path().join("a.exr")).unwrap());
    assert!(
        least < most,
        "{least} {most}: the pass was finished\n{text}"
    );
    assert!(FilmFile::read(&folder.path().join("a.film")).is_ok());

    let resumed = ["render", "--resume", "--spp", "2", "-o", "a.exr"];
    specula(folder.path())
        .args(resumed)
        .arg(&scene)
        .assert()
        .success();
    let whole = ["render", "--spp", "2", "-o", "b.exr"];
    specula(folder.path())
        .args(whole)
        .arg(&scene)
        .assert()
        .success();
    let [a, b] = ["a.exr", "b.exr"].map(|name| read_exr(&folder.path().join(name)).unwrap());
    assert_eq!(counts(&a), [2.0, 2.0]);
    assert_eq!(a.colour, b.colour);
}

#[test]
fn the_second_interrupt_does_not_wait_for_a_tile() {
    let (folder, scene) = closed_scene();
    // A tile takes longer than the test may.
    let size = ["--spp", "1000", "--max-depth", "60000"];
    let mut render = Render::start(folder.path(), &scene, &size);
    render.wait_for("ready after");
    std::thread::sleep(Duration::from_millis(50));
    render.interrupt();
    render.wait_for("finishing the first pass");
    let start = Instant::now();
    render.interrupt();
    let (status, text) = render.end();
    assert_eq!(status.code(), Some(130), "{text}");
    assert!(start.elapsed() < Duration::from_secs(5), "{text}");
    assert!(text.contains("stopped by Ctrl-C; wrote"), "{text}");
    assert!(folder.path().join("a.exr").exists());
}

/// Schedulers and lost terminals: the picture and the film are written within seconds, whatever the pass.
#[test]
fn sigterm_and_sighup_write_what_there_is() {
    for (signal, code, name) in [("TERM", 143, "SIGTERM"), ("HUP", 129, "SIGHUP")] {
        let (folder, scene) = closed_scene();
        // A pass takes minutes, a tile many seconds.
        let size = ["--spp", "1000", "--max-depth", "60000"];
        let mut render = Render::start(folder.path(), &scene, &size);
        render.wait_for("ready after");
        std::thread::sleep(Duration::from_millis(300));
        let start = Instant::now();
        send(signal, render.child.id());
        let (status, text) = render.end();
        assert_eq!(status.code(), Some(code), "{text}");
        assert!(start.elapsed() < Duration::from_secs(5), "{text}");
        assert!(
            text.contains(&format!("stopped by {name}; wrote")),
            "{text}"
        );
        assert!(read_exr(&folder.path().join("a.exr")).is_ok());
        assert!(FilmFile::read(&folder.path().join("a.film")).is_ok());
    }
}

#[test]
fn before_the_first_sample_a_signal_ends_the_program() {
    let folder = tempfile::tempdir().unwrap();
    // A scene that never comes.
    let mut child = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder.path())
        .args(["render", "-", "-o", "a.exr"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Waiting closes the input, and a scene that ends is an error.
    let input = child.stdin.take();
    std::thread::sleep(Duration::from_millis(300));
    send("TERM", child.id());
    // By the program, or on a busy machine by the system before the program has begun: a shell calls both 143.
    let status = child.wait().unwrap();
    drop(input);
    assert!(
        status.code() == Some(143) || status.signal() == Some(15),
        "{status}"
    );
}

/// `nohup`, and jobs that a script starts in the background, are not to be stopped by what they ignore.
#[test]
fn signals_that_are_ignored_from_the_start_stay_so() {
    let (folder, _) = small_scene();
    let script = "trap '' HUP; exec \"$0\" render small.pbrt --time 1500ms -o a.exr";
    let child = Command::new("sh")
        .current_dir(folder.path())
        .args(["-c", script, env!("CARGO_BIN_EXE_specula")])
        .stderr(Stdio::null())
        .spawn();
    let mut child = child.unwrap();
    std::thread::sleep(Duration::from_millis(700));
    send("HUP", child.id());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(folder.path().join("a.exr").exists());
}
