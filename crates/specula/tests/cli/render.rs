//! `specula render`, end to end.

use crate::common::{run, small_scene, specula, stderr, succeed};
use specula::render::picture::read_exr;

/// Width and height in a PNG's header.
fn png_size(bytes: &[u8]) -> (u32, u32) {
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    (number(16), number(20))
}

#[test]
fn a_scene_becomes_exr_and_png_named_after_it() {
    let (folder, scene) = small_scene();
    let run = specula(folder.path())
        .arg("render")
        .arg(&scene)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    assert!(stderr(&run).contains("4 spp"), "{}", stderr(&run));

    let picture = read_exr(&folder.path().join("small.exr")).unwrap();
    assert_eq!((picture.width, picture.height), (24, 16));
    assert!(picture.sample_count.iter().all(|&n| n == 4.0));
    assert_eq!(picture.albedo.len(), 24 * 16);
    assert!(picture.colour.iter().any(|c| c.g > 0.5));
    let png = std::fs::read(folder.path().join("small.png")).unwrap();
    assert_eq!(png_size(&png), (24, 16));
}

#[test]
fn statistics_say_how_vertices_were_shaded() {
    let (folder, scene) = small_scene();
    let run = |extra: &[&str]| {
        let mut command = specula(folder.path());
        command
            .args(["render", "--stats", "--spp", "2"])
            .args(extra);
        command.arg(&scene).output().unwrap()
    };
    let done = run(&[]);
    let said = stderr(&done);
    assert!(done.status.success(), "{said}");
    let line = said.lines().find(|line| line.starts_with("statistics: "));
    let line = line.expect("there is a line");
    assert!(line.contains(" vertices, "), "{line}");
    assert!(
        line.contains("% shaded in batches, ") && line.contains(" 0.00 % singly"),
        "{line}"
    );
    assert_eq!(run(&["--quiet"]).status.code(), Some(2));
}

#[test]
fn options_change_what_is_rendered() {
    let (folder, scene) = small_scene();
    let run = specula(folder.path())
        .args([
            "render",
            "--spp",
            "3",
            "--resolution",
            "40x30",
            "--crop",
            "5,15,10,30",
        ])
        .args([
            "--sampler",
            "cap",
            "--seed",
            "7",
            "--threads",
            "2",
            "--max-depth",
            "2",
        ])
        .args([
            "--quiet",
            "-o",
            "a.exr",
            "-o",
            "b.png",
            "--exposure",
            "-1",
            "--tone",
            "filmic",
        ])
        .arg(&scene)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    assert_eq!(stderr(&run), "");
    let picture = read_exr(&folder.path().join("a.exr")).unwrap();
    assert_eq!((picture.width, picture.height), (10, 20));
    assert_eq!(
        (picture.full_resolution, picture.offset),
        ([40, 30], [5, 10])
    );
    assert!(picture.sample_count.iter().all(|&n| n == 3.0));
    let png = std::fs::read(folder.path().join("b.png")).unwrap();
    assert_eq!(png_size(&png), (10, 20));
    assert!(!folder.path().join("small.exr").exists());
}

#[test]
fn threads_do_not_change_a_bit_and_seeds_do() {
    let (folder, scene) = small_scene();
    for (name, seed, threads) in [
        ("a.exr", "1", "1"),
        ("b.exr", "1", "3"),
        ("c.exr", "2", "1"),
    ] {
        specula(folder.path())
            .args([
                "render",
                "-q",
                "-o",
                name,
                "--seed",
                seed,
                "--threads",
                threads,
            ])
            .arg(&scene)
            .assert()
            .success();
    }
    let read = |name: &str| read_exr(&folder.path().join(name)).unwrap();
    assert_eq!(read("a.exr"), read("b.exr"));
    assert_ne!(read("a.exr").colour, read("c.exr").colour);
}

#[test]
fn time_and_noise_end_a_render() {
    let (folder, scene) = small_scene();
    let start = std::time::Instant::now();
    specula(folder.path())
        .args(["render", "-q", "--time", "300ms", "-o", "t.exr"])
        .arg(&scene)
        .assert()
        .success();
    assert!(start.elapsed().as_secs() < 20);
    let samples = |name: &str| {
        let picture = read_exr(&folder.path().join(name)).unwrap();
        let (mut fewest, mut most) = (f32::MAX, 0.0_f32);
        for n in picture.sample_count {
            (fewest, most) = (fewest.min(n), most.max(n));
        }
        (fewest, most)
    };
    assert!(samples("t.exr").0 >= 1.0);
    // A noise alone, with an end by samples, with an end by time; and samples alone.
    let noise: [(&[&str], &str); 4] = [
        (&["--noise", "0.01"], " to "),
        (&["--noise", "1e-5", "--spp", "100"], " to "),
        (&["--noise", "1e-5", "--time", "300ms"], "spp"),
        (&["--adaptive", "--spp", "100"], " to "),
    ];
    for (i, (arguments, expected)) in noise.into_iter().enumerate() {
        let name = format!("{i}.exr");
        let run = specula(folder.path())
            .args(["render", "--resolution", "64x48", "-o", &name])
            .args(arguments)
            .arg(&scene)
            .output()
            .unwrap();
        let said = stderr(&run);
        assert!(run.status.success(), "{said}");
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
    let (fewest, most) = samples("0.exr");
    assert!(fewest >= 32.0 && most > fewest, "{fewest} to {most}");
    let mean = |name: &str| {
        let counts = read_exr(&folder.path().join(name)).unwrap().sample_count;
        counts.iter().sum::<f32>() / counts.len() as f32
    };
    // As much work as 100 samples everywhere.
    for name in ["1.exr", "3.exr"] {
        assert!((50.0..200.0).contains(&mean(name)), "{}", mean(name));
    }
    assert_eq!(
        read_exr(&folder.path().join("1.exr")).unwrap(),
        read_exr(&folder.path().join("3.exr")).unwrap()
    );
}

#[test]
fn samples_are_spread_by_the_error_unless_they_are_few_or_it_is_refused() {
    let (folder, _) = small_scene();
    let folder = folder.path();
    let is_even = |arguments: &[&str]| {
        let line = ["render", "small.pbrt", "--resolution", "64x48"];
        succeed(folder, &[&line[..], arguments, &["-o", "a.exr"]].concat());
        let counts = read_exr(&folder.join("a.exr")).unwrap().sample_count;
        counts.iter().all(|n| *n == counts[0])
    };
    assert!(!is_even(&["--spp", "8"]) && !is_even(&["--spp", "40"]));
    assert!(is_even(&["--spp", "7"]));
    assert!(is_even(&["--spp", "40", "--adaptive=off"]));
    assert!(!is_even(&["--spp", "40", "--adaptive=on"]));
    // A film goes on as it began.
    let size = ["--resolution", "64x48"];
    for (from, even) in [("--adaptive=off", true), ("--adaptive", false)] {
        let begin = ["render", "small.pbrt", from, "--spp", "8", "-o", "b.film"];
        succeed(folder, &[&begin[..], &size, &["--restart"]].concat());
        assert_eq!(is_even(&["--spp", "24", "--resume=b.film"]), even);
    }
    let noise = ["render", "small.pbrt", "--noise", "0.1", "--adaptive=off"];
    let (code, said) = run(folder, &noise);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("leave out --adaptive=off"), "{said}");
}

#[test]
fn the_built_in_scene_renders_without_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let run = specula(folder.path())
        .args(["render", "--spp", "1", "--resolution", "96x40"])
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    let picture = read_exr(&folder.path().join("orbs.exr")).unwrap();
    assert_eq!((picture.width, picture.height), (96, 40));
    assert!(folder.path().join("orbs.png").exists());
}

#[test]
fn an_output_that_cannot_be_written_is_told_before_the_render() {
    let (folder, scene) = small_scene();
    let start = std::time::Instant::now();
    let run = specula(folder.path())
        .args(["render", "--spp", "10000000", "-o", "no/such/folder/a.exr"])
        .arg(&scene)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(1));
    assert!(start.elapsed().as_secs() < 20);
    assert!(stderr(&run).contains("cannot write"), "{}", stderr(&run));
}

#[test]
fn wrong_arguments_end_with_code_2_and_say_what_was_expected() {
    let (folder, scene) = small_scene();
    let cases: [(&[&str], &str); 11] = [
        (&["--spp", "0"], "0 is not in"),
        (&["--spp", "4", "--time", "3s"], "cannot be used with"),
        (
            &["--noise", "0.1", "--samples", "0..4"],
            "cannot be used with",
        ),
        (&["--time", "soon"], "30s, 5m, 1.5h"),
        (&["--noise=-1"], "above 0"),
        (&["--sampler", "best"], "possible values"),
        (&["--crop", "5,1,0,1"], "x0 < x1"),
        (&["--crop", "0,9999,0,1"], "beyond the picture"),
        (&["--resolution", "0x0"], "1280x720"),
        (&["-o", "a.jpg"], ".exr, .png or .film"),
        (&["-o", "a.exr", "-o", "a.exr"], "given twice"),
    ];
    for (arguments, expected) in cases {
        let run = specula(folder.path())
            .arg("render")
            .arg(&scene)
            .args(arguments)
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        assert!(
            stderr(&run).contains(expected),
            "{arguments:?}: {}",
            stderr(&run)
        );
    }
}

/// Where a picture is biased by an option, the help, the summary and the file say so.
#[test]
fn bias_is_named() {
    let (folder, scene) = small_scene();
    let help = specula(folder.path()).args(["render", "--help"]).output();
    let help = String::from_utf8(help.unwrap().stdout).unwrap();
    assert_eq!(help.matches("Bias: ").count(), 2, "{help}");
    let render = |arguments: &[&str], name: &str| {
        let run = specula(folder.path())
            .args(["render", "--resolution", "12x8", "--spp", "2", "-o", name])
            .args(arguments)
            .arg(&scene)
            .output()
            .unwrap();
        assert!(run.status.success(), "{}", stderr(&run));
        let file = std::fs::read(folder.path().join(name)).unwrap();
        let named = file.windows(12).any(|w| w == b"specula.bias");
        (stderr(&run), named)
    };
    let (said, named) = render(&[], "plain.exr");
    assert!(!said.contains("biased") && !named, "{said}");
    let (said, named) = render(&["--clamp", "2.5", "--regularize"], "biased.exr");
    let expected = "biased (indirect light clamped to 2.5, regularized)";
    assert!(said.contains(expected) && named, "{said}");
    for wrong in ["0", "-1", "inf", "much"] {
        let clamp = format!("--clamp={wrong}");
        let run = specula(folder.path())
            .args(["render", &clamp])
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(2));
        assert!(stderr(&run).contains("above 0"), "{}", stderr(&run));
    }
}

/// A smooth metal floor far below with waves on it: of a sun without extent its mean normals reflect nothing.
#[test]
fn normal_maps_are_filtered_into_roughness_on_demand() {
    let (folder, _) = small_scene();
    let path = folder.path();
    let waves = image::RgbImage::from_fn(32, 32, |x, y| {
        let byte = |i: u32| if i % 8 < 4 { 110 } else { 145 };
        image::Rgb([byte(x), byte(y), 250])
    });
    waves.save(path.join("waves.png")).unwrap();
    let scene = "LookAt 0 9 0  0 0 9  0 1 0\nCamera \"perspective\" \"float fov\" 30\n\
        Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 16 \"string filename\" \"floor.exr\"\n\
        WorldBegin\nLightSource \"distant\" \"point3 from\" [0 1 1] \"point3 to\" [0 0 0]\n\
        Material \"conductor\" \"float roughness\" 0 \"string normalmap\" \"waves.png\"\n\
        Shape \"trianglemesh\" \"point3 P\" [-60 0 -60  60 0 -60  60 0 60  -60 0 60]\n\
        \"point2 uv\" [0 0  1200 0  1200 1200  0 1200] \"integer indices\" [0 2 1  0 3 2]\n";
    std::fs::write(path.join("floor.pbrt"), scene).unwrap();
    let light = |options: &[&str]| {
        let mut arguments = vec!["render", "floor.pbrt", "--spp", "4", "-o", "floor.exr"];
        arguments.extend(options);
        succeed(path, &arguments);
        let picture = read_exr(&path.join("floor.exr")).unwrap();
        std::fs::remove_file(path.join("floor.exr")).unwrap();
        picture.colour.iter().map(|c| c.g).sum::<f32>()
    };
    assert_eq!(light(&["--texture-filter", "ewa"]), 0.0);
    let filtered = light(&["--filter-normal-maps"]);
    assert!(filtered > 1.0, "{filtered}");
    // Whatever the filter is: a pixel covers the whole map.
    let squares = light(&["--filter-normal-maps", "--texture-filter", "trilinear"]);
    assert_eq!(squares, filtered);
}
