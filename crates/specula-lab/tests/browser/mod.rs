//! Pages in a Chromium, where there is one.

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
];
/// A browser that has not answered by then is stuck.
const PATIENCE: Duration = Duration::from_secs(120);

fn program() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    NAMES
        .iter()
        .flat_map(|name| folders.iter().map(move |f| f.join(name)))
        .find(|file| file.is_file())
}

/// What a page's own check says in a window of so many pixels' width; `None` where there is no browser.
pub(crate) fn check(page: &Path, width: u32) -> Option<String> {
    let Some(program) = program() else {
        let why = format!("no Chromium is on the PATH ({NAMES:?})");
        specula_testing::skip("the page in a browser", why, "apt-get install chromium");
        return None;
    };
    let profile = tempfile::tempdir().expect("a temporary folder");
    let mut child = Command::new(program)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--hide-scrollbars",
            "--virtual-time-budget=20000",
            "--dump-dom",
        ])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("--window-size={width},1200"))
        .arg(format!("file://{}#check", page.display()))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the browser starts");
    let mut out = child.stdout.take().expect("a pipe");
    let reader = std::thread::spawn(move || {
        let mut text = String::new();
        out.read_to_string(&mut text).map(|_| text)
    });
    let start = Instant::now();
    while child.try_wait().expect("its state").is_none() {
        if start.elapsed() > PATIENCE {
            child.kill().expect("it can be ended");
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    let text = reader.join().expect("no panic").expect("text");
    let said = text.split("data-check=\"").nth(1);
    let outcome = said.and_then(|rest| rest.split('"').next());
    Some(outcome.unwrap_or("the page's check did not run").to_owned())
}
