//! `--device`, `--gpu-rays`, `--gpu-schedule` and `specula devices`. What needs a GPU says that it is skipped
//! where there is none, and fails where `SPECULA_GPU=require`.

use std::io::Write as _;
use std::path::Path;

use crate::common::{small_scene, specula, stderr};
use specula::gpu::{AdapterDescription, AdapterKind, adapters};
use specula::render::picture::{Picture, read_exr};

fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = specula(folder).args(arguments).output().unwrap();
    (output.status.code(), stderr(&output))
}

fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let (code, said) = run(folder, arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {said}");
    said
}

fn picture(folder: &Path, name: &str) -> Picture {
    read_exr(&folder.join(name)).unwrap()
}

/// Whether there is a GPU; else a loud line that `what` is skipped.
#[track_caller]
fn has_gpu(what: &str) -> bool {
    let found = !adapters().is_empty();
    if !found {
        let required = std::env::var("SPECULA_GPU").is_ok_and(|v| v == "require");
        assert!(!required, "SPECULA_GPU=require, but there is none");
        specula_testing::skip(what, "no GPU", "apt-get install mesa-vulkan-drivers");
    }
    found
}

#[test]
fn devices_are_listed() {
    let (folder, _) = small_scene();
    let output = specula(folder.path()).arg("devices").output().unwrap();
    assert!(output.status.success());
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.starts_with("cpu: "), "{said}");
    for adapter in adapters() {
        assert!(said.contains(&format!("gpu:{adapter}")), "{said}");
    }
}

#[test]
fn a_gpu_is_measured() {
    if !has_gpu("the report about a GPU") {
        return;
    }
    let (folder, _) = small_scene();
    let folder = folder.path();
    let report = ["gpu-report", "--quick", "--part", "rays", "-o", "report"];
    let mut command = specula(folder);
    command.env("XDG_CACHE_HOME", folder.join("cache"));
    let output = command.args(report).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let text = std::fs::read_to_string(folder.join("report/README.md")).unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stdout), text);
    for expected in [
        "# ",
        "- GPU: ",
        "driver",
        "## Rays alone",
        "| glass-and-metal | tree | 20 |",
    ] {
        assert!(text.contains(expected), "no '{expected}' in {text}");
    }
    assert!(!text.contains("Not measured"), "{text}");
    // Of the part scenes, on real GPUs. Drivers have caches there, too.
    assert!(!folder.join("cache/specula").exists());
}

#[test]
fn reports_refuse_what_is_no_gpu() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    for (arguments, expected) in [
        (
            &["--device", "cpu"][..],
            "expected gpu, gpu:INDEX or gpu:NAME",
        ),
        (&["--device", "gpu:no such card"], "no GPU"),
        (&["--part", "everything"], "expected pictures, samplers"),
        (&["--scene", "none.pbrt"], "none.pbrt"),
    ] {
        let (code, said) = run(folder, &[&["gpu-report"], arguments].concat());
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(expected), "{said}");
    }
    assert!(!folder.join("gpu-report").exists());
}

#[test]
fn devices_that_are_not_there_are_named_and_nothing_is_written() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let output = ["-o", "a.exr"];
    for (device, expected) in [
        ("tpu", "expected auto, cpu, gpu"),
        ("gpu:99", "no GPU"),
        ("gpu:no such card", "no GPU"),
        ("gpu:0,99", "no GPU"),
    ] {
        let arguments = [&["render", "small.pbrt", "--device", device], &output[..]].concat();
        let (code, said) = run(folder, &arguments);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(expected), "{said}");
    }
    assert!(!folder.join("a.exr").exists());
}

#[test]
fn several_gpus_render_together() {
    if !has_gpu("several GPUs") {
        return;
    }
    let (folder, _) = small_scene();
    let folder = folder.path();
    let (code, said) = run(folder, &["render", "small.pbrt", "--device", "gpu:0,0"]);
    assert!(code == Some(2) && said.contains("is named twice"), "{said}");
    let adapters = adapters();
    if adapters.iter().all(|a| a.kind == AdapterKind::Software) {
        let (code, said) = run(folder, &["render", "small.pbrt", "--device", "gpu:all"]);
        assert!(code == Some(2) && said.contains("no real GPU"), "{said}");
    }
    if adapters.len() < 2 {
        specula_testing::not_of_this_machine("several GPUs", "there is one GPU");
        return;
    }
    let render = |device, name| {
        let mut command = specula(folder);
        // Mesa's lavapipe compiles without optimising.
        command.env("GALLIVM_PERF", "nopt");
        let render = ["render", "small.pbrt", "--spp", "4", "--device", device];
        let output = command.args(render).args(["-o", name]).output().unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
        stderr(&output)
    };
    render("gpu:0", "one.exr");
    let said = render("gpu:0,1", "two.exr");
    assert_eq!(said.matches("rendering on ").count(), 2, "{said}");
    let [one, two] = ["one.exr", "two.exr"].map(|name| picture(folder, name));
    let near = |a: f32, b: f32| (a - b).abs() <= 1e-3 * (1.0 + a);
    let pairs = one.colour.iter().zip(&two.colour);
    let differ = pairs.filter(|(a, b)| !near(a.g, b.g)).count();
    assert!(50 * differ <= one.colour.len(), "{differ} pixels differ");
}

#[test]
fn auto_renders_everywhere() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    succeed(folder, &["render", "small.pbrt", "-o", "cpu.exr"]);
    let auto = ["render", "small.pbrt", "--device", "auto", "-o", "auto.exr"];
    succeed(folder, &auto);
    // What `gpu-report` keeps is read, and may be damaged.
    std::fs::create_dir_all(folder.join("cache/specula")).unwrap();
    std::fs::write(folder.join("cache/specula/gpus.json"), "[{").unwrap();
    let mut command = specula(folder);
    command.env("XDG_CACHE_HOME", folder.join("cache"));
    let output = command.args(auto).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let real = adapters().iter().any(|a| a.kind != AdapterKind::Software);
    if !real {
        assert_eq!(picture(folder, "auto.exr"), picture(folder, "cpu.exr"));
    }
}

#[test]
fn a_gpu_renders_the_processors_picture_and_resumes() {
    if !has_gpu("rendering on a GPU") {
        return;
    }
    let (folder, _) = small_scene();
    let folder = folder.path();
    succeed(folder, &["render", "small.pbrt", "-o", "cpu.exr"]);
    let gpu = ["render", "small.pbrt", "--device", "gpu"];
    let on_gpu = |rest: &[&str]| succeed(folder, &[&gpu[..], rest].concat());
    let said = on_gpu(&["-o", "gpu.exr"]);
    assert!(said.contains("rendering on "), "{said}");
    let [a, b] = ["cpu.exr", "gpu.exr"].map(|name| picture(folder, name));
    let far = a.colour.iter().zip(&b.colour);
    let far = far.filter(|(a, b)| (**a - **b).to_array().iter().any(|d| d.abs() > 1e-3));
    assert!(far.count() < 8, "of 384 pixels");

    on_gpu(&["--spp", "6", "-o", "whole.exr"]);
    on_gpu(&["--samples", "0..4", "-o", "part.film"]);
    on_gpu(&[
        "--spp",
        "6",
        "--resume",
        "-o",
        "part.film",
        "-o",
        "part.exr",
    ]);
    assert_eq!(picture(folder, "part.exr"), picture(folder, "whole.exr"));

    on_gpu(&["--gpu-schedule", "paths", "-o", "paths.exr"]);
    on_gpu(&["--gpu-schedule", "queues", "-o", "queues.exr"]);
    assert_eq!(picture(folder, "paths.exr"), picture(folder, "queues.exr"));
}

#[test]
fn schedules_that_are_not_there_are_named() {
    let (folder, _) = small_scene();
    let arguments = ["render", "small.pbrt", "--gpu-schedule", "threads"];
    let (code, said) = run(folder.path(), &arguments);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("expected auto, paths or queues"), "{said}");
}

#[test]
fn ray_queries_that_are_not_there_are_named_before_anything_is_done() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let render = |device: &str, rays: &str| {
        let arguments = [
            "render",
            "small.pbrt",
            "--device",
            device,
            "--gpu-rays",
            rays,
        ];
        let (code, said) = run(folder, &[&arguments[..], &["-o", "a.exr"]].concat());
        // Reports are broken into lines with a bar before each.
        let words = said.split_whitespace().filter(|word| *word != "│");
        (code, words.collect::<Vec<_>>().join(" "))
    };
    let (code, said) = render("cpu", "query");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("the processor has no ray queries"), "{said}");
    let (code, said) = render("cpu", "some");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("expected auto, tree or query"), "{said}");
    if has_gpu("ray queries") {
        let offered = adapters()[0].ray_queries;
        let (code, said) = render("gpu", "query");
        if !offered {
            assert_eq!(code, Some(2), "{said}");
            assert!(said.contains("offers no ray queries"), "{said}");
            assert!(!folder.join("a.exr").exists());
        } else {
            assert_eq!(code, Some(0), "{said}");
            assert!(said.contains("rays by its ray queries"), "{said}");
            for schedule in ["paths", "queues"] {
                let output = format!("{schedule}.exr");
                let ways = ["--gpu-rays", "query", "--gpu-schedule", schedule];
                let render = ["render", "small.pbrt", "--device", "gpu", "-o", &output];
                succeed(folder, &[&render[..], &ways].concat());
            }
            assert_eq!(picture(folder, "paths.exr"), picture(folder, "queues.exr"));
        }
        let (code, said) = render("gpu", "tree");
        assert_eq!(code, Some(0), "{said}");
        assert!(said.contains("rays through Specula's tree"), "{said}");
    }
}

#[test]
fn what_a_gpu_does_not_render_is_named_before_anything_is_done() {
    if !has_gpu("what a GPU does not render") {
        return;
    }
    let (folder, scene) = small_scene();
    let folder = folder.path();
    let shared = ["--device", "gpu", "--share-paths", "4", "-o", "a.exr"];
    let (code, said) = run(folder, &[&["render", "small.pbrt"], &shared[..]].concat());
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("paths that share"), "{said}");
    let text = std::fs::read_to_string(&scene).unwrap();
    let mut nested = String::from("Texture \"t0\" \"spectrum\" \"checkerboard\"\n");
    for i in 1..40 {
        nested += &format!(
            "Texture \"t{i}\" \"spectrum\" \"mix\" \"texture tex1\" \"t{}\" \"texture tex2\" \"t0\"\n",
            i - 1
        );
    }
    nested += "Material \"diffuse\" \"texture reflectance\" \"t39\"\nShape \"sphere\"\n";
    std::fs::write(&scene, text + &nested).unwrap();
    let (code, said) = run(
        folder,
        &["render", "small.pbrt", "--device", "gpu", "-o", "a.exr"],
    );
    assert_eq!(code, Some(2), "{said}");
    let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("textures that are nested more than"),
        "{said}"
    );
    assert!(!folder.join("a.exr").exists());
}

/// Drivers that are not there, or are no drivers, as far as Vulkan's loader is told.
#[test]
#[cfg(target_os = "linux")]
fn without_a_driver_gpus_are_refused_and_auto_goes_on() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    std::fs::write(folder.join("junk.so"), "no library").unwrap();
    let manifest = r#"{"file_format_version": "1.0.0", "ICD": {"library_path": "./junk.so", "api_version": "1.3.0"}}"#;
    std::fs::write(folder.join("junk.json"), manifest).unwrap();
    succeed(folder, &["render", "small.pbrt", "-o", "cpu.exr"]);
    for drivers in ["none.json", "junk.json"] {
        let drivers = folder.join(drivers);
        let run = |arguments: &[&str]| {
            let mut command = specula(folder);
            command.env("VK_DRIVER_FILES", &drivers);
            command.env("VK_ICD_FILENAMES", &drivers);
            let output = command.args(arguments).output().unwrap();
            let listed = String::from_utf8_lossy(&output.stdout).into_owned();
            (output.status.code(), listed + &stderr(&output))
        };
        let (code, said) = run(&["devices"]);
        assert_eq!(code, Some(0), "{said}");
        assert!(said.contains("no GPU found: no driver"), "{said}");
        std::fs::write(folder.join("a.exr"), "good").unwrap();
        let render = |device| run(&["render", "small.pbrt", "--device", device, "-o", "a.exr"]);
        let (code, said) = render("gpu");
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains("no GPU found: no driver"), "{said}");
        assert_eq!(std::fs::read(folder.join("a.exr")).unwrap(), b"good");
        let (code, said) = render("auto");
        assert_eq!(code, Some(0), "{said}");
        assert_eq!(picture(folder, "a.exr"), picture(folder, "cpu.exr"));
    }
}

/// A texture of so many pixels along each side, of three words each on a GPU. The file takes no room.
fn with_large_texture(folder: &Path, scene: &Path, side: u64) {
    let header = format!("Pf\n{side} {side}\n-1.0\n");
    let mut file = std::fs::File::create(folder.join("large.pfm")).unwrap();
    file.write_all(header.as_bytes()).unwrap();
    // Too many values for a palette.
    for i in 0..300_u16 {
        let value = f32::from(i) * 1e-3;
        file.write_all(&value.to_le_bytes()).unwrap();
    }
    file.set_len(header.len() as u64 + 4 * side * side).unwrap();
    let text = std::fs::read_to_string(scene).unwrap()
        + "Texture \"large\" \"spectrum\" \"imagemap\" \"string filename\" \"large.pfm\"\n\
           Material \"diffuse\" \"texture reflectance\" \"large\"\nShape \"disk\"\n";
    std::fs::write(scene, text).unwrap();
}

/// The software GPU that takes the smallest arrays; else a line that `what` is skipped.
#[track_caller]
fn smallest_software(what: &str) -> Option<AdapterDescription> {
    let software = |a: &AdapterDescription| a.kind == AdapterKind::Software;
    let found = adapters()
        .into_iter()
        .filter(software)
        .min_by_key(|a| a.largest_array);
    if has_gpu(what) && found.is_none() {
        specula_testing::not_of_this_machine(what, "the GPU's memory is its own");
    }
    found
}

#[test]
fn scenes_larger_than_a_gpu_takes_are_named_and_nothing_is_written() {
    let Some(gpu) = smallest_software("scenes larger than a GPU takes") else {
        return;
    };
    let (folder, scene) = small_scene();
    let folder = folder.path();
    with_large_texture(folder, &scene, (gpu.largest_array / 12).isqrt() + 1);
    std::fs::write(folder.join("a.exr"), "good").unwrap();
    let device = format!("gpu:{}", gpu.index);
    let render = ["render", "small.pbrt", "--device", &device, "-o", "a.exr"];
    let (code, said) = run(folder, &render);
    assert_eq!(code, Some(2), "{said}");
    let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("the GPU does not hold the scene"), "{said}");
    assert!(said.contains("--device cpu does"), "{said}");
    assert_eq!(std::fs::read(folder.join("a.exr")).unwrap(), b"good");
}
