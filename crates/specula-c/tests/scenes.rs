//! Scenes, renders and pictures: what they give is what the libraries give.

#![allow(
    unsafe_code,
    reason = "the functions are called as C calls them, with pointers"
)]
#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use std::ffi::{CStr, CString, c_int, c_void};
use std::path::Path;
use std::ptr::null_mut;
use std::sync::atomic::AtomicBool;

use specula_c::abi::{self, PictureHandle, RenderOptions, SceneHandle, Status};
use specula_render::picture::{Picture, read_exr};
use specula_render::{PreparedScene, Renderer, TextureFilter};

fn last() -> String {
    // SAFETY: the message is a text, and valid until the next call.
    let text = unsafe { CStr::from_ptr(abi::specula_last_error()) };
    text.to_str().unwrap().to_owned()
}

fn path(path: &Path) -> CString {
    CString::new(path.to_str().unwrap()).unwrap()
}

fn builtin() -> *mut SceneHandle {
    let mut scene = null_mut();
    // SAFETY: room for a pointer.
    let status = unsafe { abi::specula_scene_builtin(&mut scene) };
    assert_eq!(status, Status::Ok);
    scene
}

fn load(file: &Path) -> Result<*mut SceneHandle, String> {
    let mut scene = null_mut();
    // SAFETY: a text that ends with a zero, and room for a pointer.
    match unsafe { abi::specula_scene_load(path(file).as_ptr(), &mut scene) } {
        Status::Ok => Ok(scene),
        status => {
            assert_eq!(status, Status::Unreadable);
            assert!(scene.is_null());
            Err(last())
        }
    }
}

/// Small and quick.
fn small() -> RenderOptions {
    RenderOptions {
        samples_per_pixel: 3,
        seed: 5,
        width: 24,
        height: 10,
        max_depth: 3,
        ..RenderOptions::default()
    }
}

/// Calls of the progress function.
#[derive(Default)]
struct Calls {
    told: Vec<(f64, f64)>,
    most: usize,
}

impl Calls {
    fn unstopped() -> Self {
        Self {
            most: usize::MAX,
            ..Self::default()
        }
    }
}

extern "C" fn progress(share_done: f64, samples: f64, user: *mut c_void) -> c_int {
    // SAFETY: `render` gives its `Calls`.
    let calls = unsafe { &mut *user.cast::<Calls>() };
    calls.told.push((share_done, samples));
    c_int::from(calls.told.len() >= calls.most)
}

fn render(
    scene: *const SceneHandle,
    options: &RenderOptions,
    calls: &mut Calls,
) -> (Status, *mut PictureHandle) {
    let mut picture = null_mut();
    let user = (&raw mut *calls).cast();
    // SAFETY: a scene of `builtin`, options, and room for a pointer.
    let status = unsafe { abi::specula_render(scene, options, Some(progress), user, &mut picture) };
    (status, picture)
}

fn read(
    picture: *const PictureHandle,
    layer: u32,
    channels: usize,
    strides: [usize; 2],
) -> Vec<f32> {
    let [pixel, row] = [
        strides[0].max(channels),
        strides[1].max(24 * strides[0].max(channels)),
    ];
    let mut to = vec![-9.0; 10 * row];
    // SAFETY: a picture, and an array of so many floats.
    let status = unsafe {
        abi::specula_picture_read(
            picture,
            layer,
            to.as_mut_ptr(),
            to.len(),
            strides[0],
            strides[1],
        )
    };
    assert_eq!(status, Status::Ok, "{}", last());
    let mut values = Vec::new();
    for (k, value) in to.into_iter().enumerate() {
        let is_of_layer = k % row < 24 * pixel && k % row % pixel < channels;
        match is_of_layer {
            true => values.push(value),
            false => assert_eq!(value, -9.0, "{k} was written to"),
        }
    }
    values
}

fn expected() -> Picture {
    let scene = specula_scene::builtin::orbs();
    let options = specula_render::RenderOptions {
        samples_per_pixel: 3,
        seed: 5,
        resolution: Some([24, 10]),
        max_depth: 3,
        ..specula_render::RenderOptions::from_scene(&scene)
    };
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(3, &AtomicBool::new(false));
    renderer.film().picture()
}

#[test]
fn a_render_is_that_of_the_library() {
    let scene = builtin();
    let expected = expected();
    for threads in [1, 0] {
        let options = RenderOptions { threads, ..small() };
        let mut calls = Calls::unstopped();
        let (status, picture) = render(scene, &options, &mut calls);
        assert_eq!(status, Status::Ok, "{}", last());
        assert_eq!(calls.told.last(), Some(&(1.0, 3.0)));
        assert!(calls.told.is_sorted(), "{:?}", calls.told);
        let flat = |layer: &[specula_bsdf::Rgb<f32>]| -> Vec<f32> {
            layer.iter().flat_map(|c| c.to_array()).collect()
        };
        let normal: Vec<f32> = (expected.normal.iter())
            .flat_map(|n| n.to_array())
            .collect();
        for strides in [[0, 0], [4, 0], [0, 80], [5, 131]] {
            let layers = [
                (abi::SPECULA_LAYER_COLOUR, 3, flat(&expected.colour)),
                (abi::SPECULA_LAYER_ALBEDO, 3, flat(&expected.albedo)),
                (abi::SPECULA_LAYER_NORMAL, 3, normal.clone()),
                (abi::SPECULA_LAYER_DEPTH, 1, expected.depth.clone()),
                (
                    abi::SPECULA_LAYER_SAMPLE_COUNT,
                    1,
                    expected.sample_count.clone(),
                ),
                (abi::SPECULA_LAYER_VARIANCE, 3, flat(&expected.variance)),
            ];
            for (layer, channels, values) in layers {
                let is_same = read(picture, layer, channels, strides) == values;
                assert!(is_same, "layer {layer}, strides {strides:?}");
            }
        }
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("orbs.EXR");
        // SAFETY: a picture, a text, and nothing of them afterwards.
        unsafe {
            let status = abi::specula_picture_write(picture, path(&file).as_ptr());
            assert_eq!(status, Status::Ok, "{}", last());
            abi::specula_picture_free(picture);
        }
        assert!(read_exr(&file).unwrap().colour == expected.colour);
    }
    // SAFETY: it is not used any more.
    unsafe { abi::specula_scene_free(scene) };
}

#[test]
fn textures_are_filtered_as_asked() {
    let file = specula_testing::scene("mitsuba/textured-roughconductor.xml");
    let scene = load(&file).unwrap();
    let loaded = specula_scene::load(&file).unwrap().scene;
    let mut all: Vec<Vec<f32>> = Vec::new();
    for (code, filter) in [
        (abi::SPECULA_TEXTURE_FILTER_SCENE, TextureFilter::Scene),
        (
            abi::SPECULA_TEXTURE_FILTER_BILINEAR,
            TextureFilter::Bilinear,
        ),
        (
            abi::SPECULA_TEXTURE_FILTER_TRILINEAR,
            TextureFilter::Trilinear,
        ),
        (abi::SPECULA_TEXTURE_FILTER_EWA, TextureFilter::Ewa),
    ] {
        let given = RenderOptions {
            texture_filter: code,
            ..small()
        };
        let (status, picture) = render(scene, &given, &mut Calls::unstopped());
        assert_eq!(status, Status::Ok, "{}", last());
        let options = specula_render::RenderOptions {
            samples_per_pixel: 3,
            seed: 5,
            resolution: Some([24, 10]),
            max_depth: 3,
            texture_filter: filter,
            ..specula_render::RenderOptions::from_scene(&loaded)
        };
        let prepared = PreparedScene::new(&loaded, &options).unwrap();
        let mut renderer = Renderer::new(&prepared, options);
        renderer.render_pass(3, &AtomicBool::new(false));
        let expected = renderer.film().picture().colour;
        let expected: Vec<f32> = expected.iter().flat_map(|c| c.to_array()).collect();
        assert!(
            read(picture, abi::SPECULA_LAYER_COLOUR, 3, [0, 0]) == expected,
            "{filter}"
        );
        all.push(expected);
        // SAFETY: it is not used any more.
        unsafe { abi::specula_picture_free(picture) };
    }
    // Mitsuba's textures are not filtered over footprints.
    assert!(all[0] == all[1] && all[1] != all[2] && all[2] != all[3]);
    let wrong = RenderOptions {
        texture_filter: 4,
        ..small()
    };
    let (status, picture) = render(scene, &wrong, &mut Calls::unstopped());
    assert_eq!(status, Status::InvalidArgument);
    assert!(
        picture.is_null() && last().contains("texture_filter"),
        "{}",
        last()
    );
    let wrong = RenderOptions {
        filter_normal_maps: 2,
        ..small()
    };
    let (status, picture) = render(scene, &wrong, &mut Calls::unstopped());
    assert_eq!(status, Status::InvalidArgument);
    assert!(
        picture.is_null() && last().contains("filter_normal_maps"),
        "{}",
        last()
    );
    // SAFETY: it is not used any more.
    unsafe { abi::specula_scene_free(scene) };
}

#[test]
fn a_render_ends_by_noise_or_time() {
    let scene = builtin();
    let by_time = RenderOptions {
        samples_per_pixel: 0,
        seconds: 0.2,
        ..small()
    };
    let by_noise = RenderOptions {
        samples_per_pixel: 0,
        noise: 0.5,
        ..small()
    };
    for options in [by_time, by_noise] {
        let mut calls = Calls::unstopped();
        let (status, picture) = render(scene, &options, &mut calls);
        assert_eq!(status, Status::Ok, "{}", last());
        let (share, samples) = calls.told.last().copied().unwrap();
        assert!(
            share > 0.9 && (1.0..65_536.0).contains(&samples),
            "{share}, {samples}"
        );
        // SAFETY: it is not used any more.
        unsafe { abi::specula_picture_free(picture) };
    }
    // SAFETY: it is not used any more.
    unsafe { abi::specula_scene_free(scene) };
}

#[test]
fn a_cancelled_render_gives_the_picture_so_far() {
    let scene = builtin();
    let options = RenderOptions {
        samples_per_pixel: 1 << 20,
        ..small()
    };
    let mut calls = Calls {
        most: 30,
        ..Calls::default()
    };
    let (status, picture) = render(scene, &options, &mut calls);
    assert_eq!((status, calls.told.len()), (Status::Cancelled, 30));
    assert!(calls.told[29].0 < 1.0, "{:?}", calls.told);
    let counts = read(picture, 4, 1, [0, 0]);
    assert!(counts.iter().all(|n| (1.0..1e6).contains(n)), "{counts:?}");
    let colours = read(picture, 0, 3, [0, 0]);
    assert!(colours.iter().all(|c| c.is_finite()) && colours.iter().any(|&c| c > 0.0));
    // SAFETY: they are not used any more.
    unsafe {
        abi::specula_picture_free(picture);
        abi::specula_scene_free(scene);
    }
}

#[test]
fn pictures_that_are_too_large_are_refused() {
    let scene = builtin();
    for size in [1 << 16, u32::MAX] {
        let options = RenderOptions {
            width: size,
            height: size,
            ..small()
        };
        let (status, picture) = render(scene, &options, &mut Calls::default());
        assert_eq!(status, Status::InvalidArgument, "{}", last());
        assert_eq!(
            last(),
            format!("a picture of {size} x {size} pixels cannot be rendered")
        );
        assert!(picture.is_null());
    }
    // SAFETY: it is not used any more.
    unsafe { abi::specula_scene_free(scene) };
}

#[test]
fn a_scene_with_an_error_gives_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.pbrt");
    let text = "Camera \"perspective\"\nWorldBegin\n\nMaterial \"copper\"\nShape \"sphere\"\n";
    std::fs::write(&file, text).unwrap();
    let message = load(&file).unwrap_err();
    let place = format!("{}:4:10: ", file.display());
    assert!(message.starts_with(&place), "{message}");
    assert!(message.contains("copper"), "{message}");
    std::fs::write(&file, text.replace("copper", "conductor")).unwrap();
    let scene = load(&file).unwrap();
    // SAFETY: it is not used any more.
    unsafe { abi::specula_scene_free(scene) };
    let none = folder.path().join("none.xml");
    let message = load(&none).unwrap_err();
    assert!(
        message.starts_with(&none.display().to_string()),
        "{message}"
    );
}

#[test]
fn scenes_have_a_size_and_warnings() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.pbrt");
    let text = "Film \"rgb\" \"integer xresolution\" 30 \"integer yresolution\" 20\n\
        Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\nShape \"sphere\" \"float none\" 1\n";
    std::fs::write(&file, text).unwrap();
    let scene = load(&file).unwrap();
    let (mut width, mut height, mut count, mut warning) = (0, 0, 0, std::ptr::null());
    // SAFETY: a scene, and room for the results; the warning is copied before the scene is freed.
    let warning = unsafe {
        abi::specula_scene_resolution(scene, &mut width, &mut height);
        abi::specula_scene_warning_count(scene, &mut count);
        assert_eq!(
            abi::specula_scene_warning(scene, 0, &mut warning),
            Status::Ok
        );
        let text = CStr::from_ptr(warning).to_str().unwrap().to_owned();
        abi::specula_scene_free(scene);
        text
    };
    assert_eq!((width, height, count), (30, 20, 1));
    assert!(
        warning.contains("scene.pbrt:5:") && warning.contains("none"),
        "{warning}"
    );
}
