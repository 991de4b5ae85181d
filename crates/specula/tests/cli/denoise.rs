//! Denoising: a clear refusal without the library, less error with it.

use crate::common::{small_scene, specula, stderr};

#[test]
#[cfg(not(feature = "oidn"))]
fn without_the_library_it_is_refused_at_once() {
    let (folder, _) = small_scene();
    std::fs::write(folder.path().join("a.exr"), "").unwrap();
    let lines: [&[&str]; 2] = [
        &["denoise", "a.exr", "-o", "b.exr"],
        &["render", "small.pbrt", "--denoise", "--spp", "10000000"],
    ];
    for line in lines {
        let run = specula(folder.path()).args(line).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{line:?}");
        let said = stderr(&run);
        assert!(said.contains("--features oidn"), "{said}");
    }
    assert!(!folder.path().join("b.exr").exists());
}

#[test]
#[cfg(feature = "oidn")]
fn a_denoised_picture_is_closer_to_the_truth() {
    use specula::render::picture::{Metadata, compare, read_exr, write_exr};

    let (folder, _) = small_scene();
    let folder = folder.path();
    let run = |line: &[&str]| {
        let output = specula(folder).args(line).output().unwrap();
        assert!(output.status.success(), "{line:?}: {}", stderr(&output));
    };
    let read = |name: &str| read_exr(&folder.join(name)).unwrap();
    let render = ["render", "small.pbrt", "--resolution", "192x128", "-q"];
    let with = |more: &[&str]| run(&[&render[..], more].concat());
    with(&["--spp", "1024", "-o", "truth.exr"]);
    with(&["--spp", "1", "-o", "noisy.exr"]);
    with(&["--spp", "1", "--denoise", "-o", "smooth.exr"]);
    run(&["denoise", "noisy.exr", "-o", "again.exr", "-o", "again.png"]);
    let rmse = |name: &str| compare(&read("truth.exr"), &read(name)).unwrap().rmse;
    let (noisy, smooth) = (rmse("noisy.exr"), rmse("smooth.exr"));
    assert!(smooth < 0.5 * noisy, "{noisy} before, {smooth} after");
    assert_eq!(read("smooth.exr").colour, read("again.exr").colour);
    assert!(read("smooth.exr").variance.is_empty());
    assert_eq!(read("smooth.exr").normal, read("noisy.exr").normal);

    // Without guides it works, too, and otherwise.
    let mut bare = read("noisy.exr");
    bare.albedo.clear();
    bare.normal.clear();
    write_exr(&folder.join("bare.exr"), &bare, &Metadata::default()).unwrap();
    run(&["denoise", "bare.exr", "-o", "unguided.exr"]);
    assert_ne!(read("unguided.exr").colour, read("smooth.exr").colour);
    assert!(rmse("unguided.exr") < noisy);
}
