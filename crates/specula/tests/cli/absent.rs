//! What a program lacks that is built without a feature: it says so, names the feature, and does nothing.
//! Where all features are built in there is nothing to test.

use crate::common::{run, small_scene};

/// Runs a command that needs an absent feature.
#[allow(dead_code, reason = "of programs that lack a feature")]
fn names_the_feature(arguments: &[&str], feature: &str) {
    let (folder, _) = small_scene();
    let (code, said) = run(folder.path(), arguments);
    assert_eq!(code, Some(2), "{arguments:?}: {said}");
    let words = said.split_whitespace().filter(|word| *word != "│");
    let said = words.collect::<Vec<_>>().join(" ");
    let flag = format!("--features {feature}");
    assert!(said.contains(&flag), "{arguments:?}: {said}");
    assert!(!folder.path().join("a.exr").exists());
}

#[test]
#[cfg(not(feature = "gpu"))]
fn a_gpu() {
    let render = ["render", "small.pbrt", "-o", "a.exr"];
    for option in [
        &["--device", "gpu"],
        &["--device", "gpu:0"],
        &["--gpu-rays", "tree"],
        &["--gpu-schedule", "auto"],
    ] {
        names_the_feature(&[&render[..], option].concat(), "gpu");
    }
    let (folder, _) = small_scene();
    let auto = ["render", "small.pbrt", "-o", "a.exr", "--device", "auto"];
    let (code, said) = run(folder.path(), &auto);
    assert_eq!(code, Some(0), "{said}");
    let devices = crate::common::specula(folder.path())
        .arg("devices")
        .output();
    let listed = String::from_utf8_lossy(&devices.unwrap().stdout).into_owned();
    assert!(listed.starts_with("cpu: "), "{listed}");
    assert!(listed.contains("--features gpu"), "{listed}");
}

#[test]
#[cfg(not(feature = "lab"))]
fn the_laboratory() {
    for rest in [&[][..], &["list"], &["run", "--seed", "3"], &["--help"]] {
        names_the_feature(&[&["lab"], rest].concat(), "lab");
        names_the_feature(&[&["gpu-report"], rest].concat(), "lab");
    }
}

#[test]
#[cfg(not(feature = "studio"))]
fn the_studio() {
    for rest in [&[][..], &["small.pbrt"], &["--export", "a"], &["--help"]] {
        names_the_feature(&[&["studio"], rest].concat(), "studio");
    }
}

#[test]
#[cfg(not(feature = "shaders"))]
fn the_shaders() {
    for rest in [&[][..], &["--list"], &["-o", "a"], &["--help"]] {
        names_the_feature(&[&["shaders"], rest].concat(), "shaders");
    }
}

#[test]
#[cfg(not(feature = "tev"))]
fn the_live_view() {
    let to = ["--display-server", "localhost", "-o", "a.exr"];
    names_the_feature(&[&["render", "small.pbrt"], &to[..]].concat(), "tev");
}
