//! Small files that ask for much: an answer in little time, with the name of what is exceeded.

use std::fmt::Write;
use std::path::Path;
use std::sync::mpsc;
use std::time::Duration;

use specula_scene::scene::{ColourParam, Texture};
use specula_scene::{ErrorKind, Limits, LoadOptions, Loaded, SceneError, Severity};

use super::common::Folder;

/// Loads and checks a scene within a minute: that it ends at all is what counts.
fn in_time(path: &Path) -> Result<Loaded, SceneError> {
    let (sender, receiver) = mpsc::channel();
    let owned = path.to_owned();
    std::thread::spawn(move || {
        let loaded = specula_scene::load(&owned);
        let report = specula_scene::check(&owned, &LoadOptions::default());
        assert_eq!(loaded.is_ok(), report.count(Severity::Error) == 0);
        // Nobody may wait for it any more.
        drop(sender.send(loaded));
    });
    receiver.recv_timeout(Duration::from_secs(60)).unwrap()
}

#[test]
fn files_that_include_each_other_twice() {
    let folder = Folder::new();
    for level in 0..20 {
        let next = format!("Include \"{}.pbrt\"\n", level + 1);
        folder.write(&format!("{level}.pbrt"), next.repeat(2));
    }
    folder.write("20.pbrt", "Shape \"sphere\"");
    let path = folder.write("scene.pbrt", "WorldBegin\nInclude \"0.pbrt\"");
    let mut limits = Limits::default();
    limits.max_files = 100;
    let error = specula_scene::load_with(&path, &limits.into()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    assert!(error.message().contains("more than 100 files"), "{error}");
    let mut one = Limits::default();
    one.max_files = 1;
    let path = folder.write("scene.pbrt", "WorldBegin\nInclude \"20.pbrt\"");
    assert!(specula_scene::load_with(&path, &one.into()).is_ok());
    // Bytes count together.
    let path = folder.write(
        "scene.pbrt",
        "WorldBegin\nInclude \"20.pbrt\"\nInclude \"20.pbrt\"",
    );
    let mut few = Limits::default();
    few.max_bytes = 60;
    let error = specula_scene::load_with(&path, &few.into()).unwrap_err();
    assert!(
        error.message().contains("together (`max_bytes`)"),
        "{error}"
    );
}

#[test]
fn textures_that_share_their_inputs() {
    let mut text =
        "WorldBegin\nTexture \"t0\" \"float\" \"checkerboard\" \"float tex1\" 0.5\n".to_owned();
    for level in 1..=40 {
        let before = level - 1;
        writeln!(
            text,
            "Texture \"t{level}\" \"float\" \"scale\" \"texture tex\" \"t{before}\" \"texture scale\" \"t{before}\""
        )
        .unwrap();
    }
    text += "Material \"conductor\" \"texture roughness\" \"t40\" Shape \"sphere\"";
    let folder = Folder::new();
    let path = folder.write("scene.pbrt", text);
    let loaded = in_time(&path).unwrap();
    let scales = |t: &&Texture| matches!(t, Texture::Scale { .. });
    assert_eq!(loaded.scene.textures.iter().filter(scales).count(), 40);
    // What is written is no longer, and no picture behind the factors is looked for twice.
    let written = folder.path().join("written.pbrt");
    let mut scene = loaded.scene;
    let last = specula_scene::scene::TextureId(scene.textures.len() - 1);
    scene.shapes[0].emission = Some(specula_scene::scene::Emission {
        radiance: ColourParam::Texture(last),
        two_sided: false,
    });
    let (sender, receiver) = mpsc::channel();
    let target = written.clone();
    std::thread::spawn(move || {
        specula_scene::write_pbrt::write_pbrt(&scene, &target).unwrap();
        let _ = sender.send(());
    });
    receiver.recv_timeout(Duration::from_secs(60)).unwrap();
    assert!(std::fs::metadata(&written).unwrap().len() < 20_000);
}

#[test]
fn subdivision_without_end() {
    let folder = Folder::new();
    let mesh =
        "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] \"integer indices\" [0 2 1 0 1 3 1 2 3 0 3 2]";
    let scene = |levels: u32| {
        format!("WorldBegin\nShape \"loopsubdiv\" {mesh} \"integer levels\" {levels}")
    };
    let error = in_time(&folder.write("scene.pbrt", scene(12))).unwrap_err();
    assert!(
        error.message().contains("12 levels would make 67108864"),
        "{error}"
    );
    assert!(error.message().contains("(`max_subdivided`)"), "{error}");
    assert_eq!((error.kind(), error.line()), (ErrorKind::Mesh, 2));
    assert!(in_time(&folder.write("scene.pbrt", scene(5))).is_ok());
}

/// What each may be, all may not be together.
#[test]
fn fifty_subdivisions() {
    let folder = Folder::new();
    let mesh =
        "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] \"integer indices\" [0 2 1 0 1 3 1 2 3 0 3 2]";
    let shape = format!("Shape \"loopsubdiv\" {mesh} \"integer levels\" 10\n");
    let path = folder.write("scene.pbrt", format!("WorldBegin\n{}", shape.repeat(50)));
    let start = std::time::Instant::now();
    let error = in_time(&path).unwrap_err();
    assert!(
        start.elapsed() < Duration::from_secs(20),
        "{:?}",
        start.elapsed()
    );
    assert_eq!((error.kind(), error.line()), (ErrorKind::Mesh, 6));
    let message = error.message();
    assert!(
        message.contains("4194304 triangles of it, 16777216 of others; at most 16777216"),
        "{message}"
    );
    assert!(message.contains("(`max_subdivided`)"), "{message}");
}

#[test]
fn names_of_megabytes_end_at_once_and_are_cut() {
    let folder = Folder::new();
    let long = "x".repeat(8 << 20);
    for (world, part) in [
        (format!("Shape \"{long}\""), "unknown shape \"x"),
        (
            format!("Material \"{long}\" Shape \"sphere\""),
            "unknown material",
        ),
        (format!("{long} \"sphere\""), "unknown directive"),
        (
            format!("Shape \"plymesh\" \"string filename\" \"{long}\""),
            "cannot be read",
        ),
        (
            format!("Shape \"sphere\" \"float {long}\" \"x\""),
            "expected",
        ),
    ] {
        let path = folder.write("scene.pbrt", format!("WorldBegin\n{world}"));
        let start = std::time::Instant::now();
        let error = in_time(&path).unwrap_err();
        assert!(
            start.elapsed() < Duration::from_secs(20),
            "{part}: {:?}",
            start.elapsed()
        );
        assert!(error.message().contains(part), "{}", error.message());
        assert!(error.message().len() < 2000, "{}", error.message().len());
    }
}

/// A small file that unpacks to a large one.
#[test]
fn a_bomb_ends_at_the_limit() {
    let folder = Folder::new();
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    for _ in 0..64 {
        std::io::Write::write_all(&mut packer, &vec![b' '; 1 << 20]).unwrap();
    }
    let packed = packer.finish().unwrap();
    assert!(packed.len() < 100_000);
    let mut options = LoadOptions::default();
    options.limits.max_bytes = 16 << 20;
    for name in ["scene.pbrt.gz", "scene.pbrt"] {
        let path = folder.write(name, &packed);
        let error = specula_scene::load_with(&path, &options).unwrap_err();
        assert!(
            error
                .message()
                .contains("unpacks to more than 16777216 bytes (`max_bytes`)"),
            "{error}"
        );
        assert!(error.help().unwrap().contains("--limit-bytes"));
    }
}

/// What is no ordinary file must not be waited for.
#[cfg(unix)]
#[test]
fn pipes_sockets_folders_and_devices() {
    let folder = Folder::new();
    let at = |name: &str| folder.path().join(name);
    let made = std::process::Command::new("mkfifo")
        .arg(at("pipe"))
        .status();
    assert!(made.is_ok_and(|status| status.success()), "mkfifo");
    for name in ["pipe.png", "pipe.ply", "pipe.pbrt", "pipe.spd"] {
        std::fs::hard_link(at("pipe"), at(name)).unwrap();
    }
    let _socket = std::os::unix::net::UnixListener::bind(at("socket.png")).unwrap();
    std::fs::create_dir(at("folder.png")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", at("zero.png")).unwrap();
    let picture = |name: &str| {
        format!(
            "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"{name}\" Shape \"sphere\""
        )
    };
    for (world, part) in [
        (picture("pipe.png"), "is a pipe"),
        (picture("socket.png"), "a socket"),
        (picture("folder.png"), "is a folder"),
        (picture("zero.png"), "a device"),
        (
            "Shape \"plymesh\" \"string filename\" \"pipe.ply\"".to_owned(),
            "is a pipe",
        ),
        ("Include \"pipe.pbrt\"".to_owned(), "is a pipe"),
        (
            "Material \"conductor\" \"spectrum eta\" \"pipe.spd\" Shape \"sphere\"".to_owned(),
            "is a pipe",
        ),
    ] {
        let path = folder.write("scene.pbrt", format!("WorldBegin\n{world}"));
        let error = in_time(&path).unwrap_err();
        assert!(error.message().contains(part), "{world}: {error}");
        assert_eq!(error.line(), 2);
    }
    let error = specula_scene::load(&at("folder.png")).unwrap_err();
    assert!(error.message().contains("is a folder"), "{error}");
}
