//! The estimate of memory: near what the system reports, and a limit before anything is built.

mod common;

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use common::{SMALL, small_scene, specula, stderr};

/// Mebibytes of the estimate in a line such as `memory: about 1.50 GiB at most (...)`.
fn estimate(text: &str) -> f64 {
    let line = text
        .lines()
        .find_map(|l| l.trim().strip_prefix("memory"))
        .unwrap_or_else(|| panic!("no line of memory: {text}"));
    let mut words = line.trim_start_matches(':').split_whitespace();
    assert_eq!(words.next(), Some("about"), "{text}");
    let value: f64 = words
        .next()
        .expect("a program that runs and answers")
        .parse()
        .expect("a program that runs and answers");
    match words.next() {
        Some("MiB") => value,
        Some("GiB") => value * 1024.0,
        unit => panic!("{unit:?} in {text}"),
    }
}

/// Renders a sample per pixel; the messages, and the most memory that was resident, in mebibytes.
/// `None` where the system does not tell.
fn measured(folder: &Path, scene: &str, arguments: &[&str]) -> (String, Option<f64>) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder)
        .args([
            "render",
            scene,
            "--spp",
            "1",
            "--threads",
            "2",
            "-o",
            "a.exr",
        ])
        .args(arguments)
        .stderr(Stdio::piped())
        .spawn()
        .expect("a program that runs and answers");
    let status = format!("/proc/{}/status", child.id());
    let mut peak = None;
    while child
        .try_wait()
        .expect("a program that runs and answers")
        .is_none()
    {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        let kibibytes = line.and_then(|l| l.trim().strip_suffix(" kB")?.trim().parse::<f64>().ok());
        peak = kibibytes.map(|k| k / 1024.0).or(peak);
        std::thread::sleep(Duration::from_millis(2));
    }
    let output = child
        .wait_with_output()
        .expect("a program that runs and answers");
    assert!(output.status.success(), "{}", stderr(&output));
    (stderr(&output), peak)
}

fn assert_near(what: &str, messages: &str, peak: Option<f64>) {
    let Some(peak) = peak else {
        eprintln!("skipped: {what}: the system does not say what memory was used");
        return;
    };
    let ratio = estimate(messages) / peak;
    eprintln!("{what}: {peak:.0} MiB, estimated {ratio:.2} of it");
    assert!(
        (0.9..=1.25).contains(&ratio),
        "{what}: {peak} MiB: {messages}"
    );
}

/// A wavy sheet of `2 n^2` triangles, in binary PLY.
fn sheet(n: u32) -> Vec<u8> {
    let side = n + 1;
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n\
         property float y\nproperty float z\nelement face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        side * side,
        2 * n * n
    )
    .into_bytes();
    for i in 0..side * side {
        let (x, y) = ((i % side) as f32 / n as f32, (i / side) as f32 / n as f32);
        for v in [
            x * 4.0 - 2.0,
            y * 4.0 - 2.0,
            (9.0 * x).sin() * (7.0 * y).cos() * 0.2,
        ] {
            bytes.extend(v.to_le_bytes());
        }
    }
    for i in 0..n * n {
        let p = i / n * side + i % n;
        for corners in [[p, p + 1, p + side], [p + 1, p + side + 1, p + side]] {
            bytes.push(3);
            corners.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        }
    }
    bytes
}

#[test]
fn estimates_are_near_what_is_used() {
    let (folder, _) = small_scene();
    let path = folder.path();
    let (messages, peak) = measured(path, "small.pbrt", &["--resolution", "2048x1536"]);
    assert_near("a film of 3 million pixels", &messages, peak);

    std::fs::write(path.join("sheet.ply"), sheet(800)).unwrap();
    let mesh = format!("{SMALL}\nShape \"plymesh\" \"string filename\" \"sheet.ply\"\n");
    std::fs::write(path.join("mesh.pbrt"), &mesh).unwrap();
    let (messages, peak) = measured(path, "mesh.pbrt", &[]);
    assert_near("1.3 million triangles", &messages, peak);

    let info = specula(path).args(["info", "mesh.pbrt"]).output().unwrap();
    let info = String::from_utf8(info.stdout).unwrap();
    assert!(info.contains("tree over it"), "{info}");
    assert!(
        (estimate(&info) / estimate(&messages) - 1.0).abs() < 0.7,
        "{info}{messages}"
    );
}

#[test]
fn a_limit_refuses_before_anything_is_built() {
    let (folder, scene) = small_scene();
    let run = |size: &str| {
        specula(folder.path())
            .args([
                "render",
                "--resolution",
                "30000x30000",
                "--max-memory",
                size,
            ])
            .arg(&scene)
            .output()
            .unwrap()
    };
    let refused = run("4GiB");
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
    let message = stderr(&refused);
    for part in ["--max-memory 4.00 GiB", "film 141 GiB", "writing pictures"] {
        assert!(message.contains(part), "{message}");
    }
    assert!(!folder.path().join("small.exr").exists());
    for bad in ["4 apples", "-3GB", "0", "GiB", "1e3MB"] {
        let wrong = run(bad);
        assert_eq!(wrong.status.code(), Some(2), "{bad}");
        assert!(stderr(&wrong).contains("expected a"), "{}", stderr(&wrong));
    }
    let fits = specula(folder.path())
        .args(["render", "--max-memory", "1GiB"])
        .arg(&scene)
        .output()
        .unwrap();
    assert!(fits.status.success(), "{}", stderr(&fits));
    assert!(
        stderr(&fits).contains("memory: about 1"),
        "{}",
        stderr(&fits)
    );
}

#[test]
fn threads_may_leave_cores_free_and_give_way() {
    let (folder, scene) = small_scene();
    let render = |arguments: &[&str], file: &str| {
        let run = specula(folder.path())
            .arg("render")
            .args(arguments)
            .args(["-o", file])
            .arg(&scene)
            .output()
            .unwrap();
        (run.status.code(), stderr(&run))
    };
    assert_eq!(render(&["--threads", "-1"], "a.exr").0, Some(0));
    for bad in ["0", "5000", "many"] {
        let (code, message) = render(&["--threads", bad], "b.exr");
        assert_eq!(code, Some(2));
        assert!(
            message.contains("expected a number of threads"),
            "{message}"
        );
    }
    let (code, message) = render(&["--nice"], "b.exr");
    if cfg!(unix) {
        assert_eq!(code, Some(0), "{message}");
        let [a, b] = ["a.exr", "b.exr"]
            .map(|f| specula::render::picture::read_exr(&folder.path().join(f)).unwrap());
        assert_eq!(a, b);
    } else {
        assert_eq!(code, Some(2), "{message}");
    }
}

/// The threads that render have the lowest priority, as the system reports it.
#[cfg(target_os = "linux")]
#[test]
fn nice_reaches_every_thread() {
    let (folder, scene) = small_scene();
    let mut child = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder.path())
        .args([
            "render",
            "--time",
            "3s",
            "--threads",
            "2",
            "--nice",
            "--quiet",
        ])
        .arg(&scene)
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    let tasks = std::fs::read_dir(format!("/proc/{}/task", child.id())).unwrap();
    let niceness = tasks.flatten().filter_map(|task| {
        let text = std::fs::read_to_string(task.path().join("stat")).ok()?;
        // Behind the name in brackets: state, then 15 numbers, then this one.
        let (_, rest) = text.rsplit_once(')')?;
        rest.split_whitespace().nth(16)?.parse::<i32>().ok()
    });
    let low = niceness.filter(|n| *n == 19).count();
    assert!(child.wait().unwrap().success());
    assert!(low >= 2, "{low} threads with low priority");
}
