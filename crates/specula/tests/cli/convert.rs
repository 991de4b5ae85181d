//! `specula convert`, end to end.

use crate::common::{small_scene, specula, stderr};
use specula::render::picture::read_exr;

#[test]
fn a_converted_scene_renders_the_same_picture() {
    let (folder, scene) = small_scene();
    let run = specula(folder.path())
        .arg("convert")
        .arg(&scene)
        .arg("copy.pbrt")
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    assert!(stderr(&run).contains("wrote copy.pbrt"), "{}", stderr(&run));
    let render = |scene: &std::path::Path, out: &str| {
        specula(folder.path())
            .args(["render", "-q", "--spp", "4", "-o", out])
            .arg(scene)
            .assert()
            .success();
        read_exr(&folder.path().join(out)).unwrap()
    };
    let original = render(&scene, "a.exr");
    let copy = render(std::path::Path::new("copy.pbrt"), "b.exr");
    let difference = (original.colour.iter().zip(&copy.colour))
        .map(|(a, b)| (*a - *b).map(f32::abs).max_channel())
        .fold(0.0, f32::max);
    assert!(difference < 1e-4, "{difference}");
}

#[test]
fn a_scene_is_not_written_over_itself() {
    let (folder, scene) = small_scene();
    let before = std::fs::read(&scene).unwrap();
    let run = specula(folder.path())
        .arg("convert")
        .arg(&scene)
        .arg(&scene)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(stderr(&run).contains("it was read"), "{}", stderr(&run));
    assert_eq!(std::fs::read(&scene).unwrap(), before);
    let other = specula(folder.path())
        .arg("convert")
        .arg(&scene)
        .arg("copy.gltf")
        .output()
        .unwrap();
    assert_eq!(other.status.code(), Some(2));
    assert!(stderr(&other).contains(".pbrt"), "{}", stderr(&other));
}
