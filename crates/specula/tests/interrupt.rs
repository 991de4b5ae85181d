//! Ctrl-C during a long render.
#![cfg(unix)]

mod common;

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::small_scene;
use specula::render::picture::read_exr;

#[test]
fn the_first_interrupt_writes_what_there_is() {
    let (folder, scene) = small_scene();
    let mut child = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder.path())
        .args([
            "render",
            "--spp",
            "16000000",
            "--threads",
            "1",
            "-o",
            "a.exr",
        ])
        .arg(&scene)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    assert!(child.try_wait().unwrap().is_none(), "it is still rendering");

    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    let start = Instant::now();
    let output = child.wait_with_output().unwrap();
    assert!(start.elapsed() < Duration::from_secs(20));

    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(message.contains("stopped by Ctrl-C"), "{message}");
    let picture = read_exr(&folder.path().join("a.exr")).unwrap();
    assert!(picture.sample_count.iter().all(|&n| n >= 1.0));
    assert_eq!(picture.non_finite_count(), 0);
}
