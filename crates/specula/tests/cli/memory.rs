//! The estimate of memory: a bound near what the system reports, and a limit before anything is built.

use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use specula::render::{FilmBuffer, FilmFile, Label, PreparedScene, RenderOptions, Renderer};

use crate::common::{SMALL, small_scene, specula, stderr};

/// Mebibytes of the estimate in a line such as `memory: at most 1.50 GiB (...)`.
fn estimate(text: &str) -> f64 {
    let line = text
        .lines()
        .find_map(|l| l.trim().strip_prefix("memory"))
        .unwrap_or_else(|| panic!("no line of memory: {text}"));
    let mut words = line.trim_start_matches(':').split_whitespace();
    assert_eq!(words.next(), Some("at"), "{text}");
    assert_eq!(words.next(), Some("most"), "{text}");
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
    let mut command = Command::new(env!("CARGO_BIN_EXE_specula"));
    command
        .current_dir(folder)
        .args(["render", scene, "--spp", "1", "-o", "a.exr"])
        .args(if arguments.contains(&"--threads") {
            &[][..]
        } else {
            &["--threads", "2"]
        })
        .args(arguments);
    watched(command)
}

/// Runs a program, which must succeed; what it says, and the most memory that was resident, in mebibytes.
fn watched(mut command: Command) -> (String, Option<f64>) {
    let mut child = command
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

/// That a render took what it said at most, and not much less.
///
/// * `loose`: how many times what is taken may be told, beside 16 MiB.
fn assert_bound(what: &str, messages: &str, peak: Option<f64>, loose: f64) {
    let Some(peak) = peak else {
        assert_ne!(
            std::env::consts::OS,
            "linux",
            "which says what memory was used"
        );
        specula_testing::not_of_this_machine(what, "the system does not say what memory was used");
        return;
    };
    let told = estimate(messages);
    eprintln!("{what}: {peak:.0} MiB of {told:.0}");
    assert!(
        peak <= told && told <= loose * peak + 16.0,
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
fn estimates_are_bounds_near_what_is_used() {
    let (folder, _) = small_scene();
    let path = folder.path();
    let (messages, peak) = measured(path, "small.pbrt", &["--resolution", "2048x1536"]);
    assert_bound("a film of 3 million pixels", &messages, peak, 1.35);

    std::fs::write(path.join("sheet.ply"), sheet(800)).unwrap();
    let mesh = format!("{SMALL}\nShape \"plymesh\" \"string filename\" \"sheet.ply\"\n");
    std::fs::write(path.join("mesh.pbrt"), &mesh).unwrap();
    let (messages, peak) = measured(path, "mesh.pbrt", &[]);
    assert_bound("1.3 million triangles", &messages, peak, 1.35);

    let info = specula(path).args(["info", "mesh.pbrt"]).output().unwrap();
    let info = String::from_utf8(info.stdout).unwrap();
    assert!(info.contains("tree over it"), "{info}");
    assert!(
        (estimate(&info) / estimate(&messages) - 1.0).abs() < 0.7,
        "{info}{messages}"
    );
}

/// A scene whose sphere has the picture, and whose film is small.
fn textured(picture: &str) -> String {
    let texture = format!(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{picture}\"\n\
         Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n"
    );
    format!("{SMALL}\n{texture}")
}

#[test]
fn pictures_take_the_memory_of_their_own_depth() {
    let (folder, _) = small_scene();
    let path = folder.path();
    let bytes = |v: u32| v.to_le_bytes();
    let grey = image::GrayImage::from_fn(16384, 16384, |x, y| image::Luma([bytes(x ^ y)[0]]));
    let colour = image::RgbaImage::from_fn(3000, 3000, |x, y| {
        image::Rgba([bytes(x)[0], bytes(y)[0], bytes(x * y)[0], 200])
    });
    let deep = image::ImageBuffer::from_fn(3000, 3000, |x, y| {
        let [low, high, ..] = bytes(x * y);
        image::Luma([u16::from_le_bytes([low, high])])
    });
    grey.save(path.join("grey.png")).unwrap();
    colour.save(path.join("colour.png")).unwrap();
    image::DynamicImage::from(deep)
        .save(path.join("deep.tiff"))
        .unwrap();
    // In mebibytes, beyond the program's: a byte, three and two for each pixel.
    for (file, pixels) in [
        ("grey.png", 256.0),
        ("colour.png", 25.7),
        ("deep.tiff", 17.2),
    ] {
        std::fs::write(path.join("textured.pbrt"), textured(file)).unwrap();
        let (messages, peak) = measured(path, "textured.pbrt", &["--resolution", "64x64"]);
        assert_bound(file, &messages, peak, 1.35);
        assert!(
            estimate(&messages) < 40.0 + 1.35 * pixels,
            "{file}: {messages}"
        );
        if file == "grey.png" {
            // 300 MB.
            assert!(
                peak.is_none_or(|peak| peak < 300e6 / 1024.0 / 1024.0),
                "{peak:?} MiB"
            );
        }
    }
}

#[test]
fn many_small_meshes_are_bounded_too() {
    let (folder, _) = small_scene();
    let path = folder.path();
    std::fs::write(path.join("sheet.ply"), sheet(40)).unwrap();
    let mut scene = SMALL.to_owned();
    for i in 0..150 {
        scene += &format!(
            "\nAttributeBegin\nTranslate 0 0 {i}\nShape \"plymesh\" \"string filename\" \"sheet.ply\"\nAttributeEnd"
        );
    }
    std::fs::write(path.join("meshes.pbrt"), scene).unwrap();
    // Triangles that are paired take less than others, which is not known beforehand. Threads that each build a
    // tree at once take the most; how often they do is chance.
    for (threads, loose) in [("1", 1.6), ("3", 1.8)] {
        let (messages, peak) = measured(path, "meshes.pbrt", &["--threads", threads]);
        assert_bound("150 meshes", &messages, peak, loose);
    }
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
        stderr(&fits).contains("memory: at most "),
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

/// A thousand films are merged in the memory that sixty take: that of two films.
#[test]
fn merging_takes_the_same_memory_for_any_number_of_films() {
    let (folder, _) = small_scene();
    let path = folder.path();
    // 3.1 MiB of sums each, none of a sample, but for the first: such films overlap with none.
    let (resolution, crop) = ([160, 120], [0, 160, 0, 120]);
    let scene = specula::scene::builtin::orbs();
    let options = RenderOptions {
        resolution: Some(resolution),
        ..RenderOptions::from_scene(&scene)
    };
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(1, &AtomicBool::new(false));
    let label = Label::default();
    FilmFile::write(&path.join("0.film"), &label, renderer.film()).unwrap();
    let empty = FilmBuffer::new(resolution, crop, 1);
    FilmFile::write(&path.join("1.film"), &label, &empty).unwrap();
    let names: Vec<String> = (0..1024).map(|i| format!("{i}.film")).collect();
    for name in &names[2..] {
        std::fs::copy(path.join("1.film"), path.join(name)).unwrap();
    }
    let merge = |count: usize| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_specula"));
        command.current_dir(path).arg("merge").args(&names[..count]);
        command.args(["-o", "sum.exr"]);
        watched(command)
    };
    let (said, few) = merge(64);
    assert!(said.contains("1 spp"), "{said}");
    let (said, many) = merge(1024);
    assert!(said.contains("1 spp"), "{said}");
    let (Some(few), Some(many)) = (few, many) else {
        let what = "merging takes the same memory for any number of films";
        specula_testing::not_of_this_machine(what, "the system does not say what memory was used");
        return;
    };
    eprintln!("64 films: {few:.0} MiB, 1024 films: {many:.0} MiB");
    // To hold them all would take 200 MiB and 3 GiB.
    assert!(few < 100.0 && many < few + 16.0, "{few} and {many} MiB");
}
