//! Cameras, films, sensors and colour spaces.

use glam::DVec3;
use specula_bsdf::Rgb;
use specula_scene::scene::{
    ColourParam, EnvironmentMapping, Film, Light, MaterialKind, Projection,
};
use specula_scene::{Loaded, SceneError};

use super::common::{Folder, load, load_world, warnings};

fn with_options(text: &str) -> Loaded {
    load(format!("{text}\nWorldBegin Shape \"sphere\"")).unwrap()
}

#[test]
fn cameras() {
    let parallel = with_options("Camera \"orthographic\" \"float screenwindow\" [-2 2 -1 1]").scene;
    assert_eq!(parallel.camera.projection, Projection::Orthographic);
    assert_eq!(parallel.camera.screen_window, [-2.0, 2.0, -1.0, 1.0]);
    let round = with_options("Camera \"spherical\" \"string mapping\" \"equirectangular\"").scene;
    let Projection::Spherical(EnvironmentMapping::LatitudeLongitude) = round.camera.projection
    else {
        panic!("{:?}", round.camera)
    };
    // The pole of the map is the camera's up.
    assert_eq!(round.camera.to_world.transform_vector3(DVec3::Z), DVec3::Y);
    assert_eq!(round.camera.to_world.transform_vector3(DVec3::X), DVec3::X);
}

/// 100 mm by the lensmaker's equation; the stop is 20 mm wide.
const LENS: &str = "# lens\n100 0 1.5 40\n-100 5 1 40\n0 90 0 20\n";

fn with_lens(parameters: &str) -> Result<Loaded, SceneError> {
    let folder = Folder::new();
    folder.write("lens.dat", LENS);
    let stop = ::image::GrayImage::from_fn(2, 2, |x, y| ::image::Luma([u8::from(x + y > 0) * 255]));
    stop.save(folder.path().join("stop.png")).unwrap();
    folder.load(format!(
        "Film \"rgb\" \"integer xresolution\" 300 \"integer yresolution\" 200 \"float diagonal\" 43
         Camera \"realistic\" \"string lensfile\" \"lens.dat\" {parameters}
         WorldBegin Shape \"sphere\""
    ))
}

#[test]
fn lenses_are_read_and_focused() {
    let loaded = with_lens("\"float aperturediameter\" 12 \"float focusdistance\" 3").unwrap();
    assert_eq!(warnings(&loaded), Vec::<String>::new());
    let Projection::Lenses(lenses) = &loaded.scene.camera.projection else {
        panic!()
    };
    assert_eq!(loaded.scene.camera.focal_distance, 3.0);
    assert_eq!(loaded.scene.film.exposure, 1.0);
    assert!((lenses.film_diagonal - 0.043).abs() < 1e-12);
    let [front, _, stop] = lenses.interfaces[..] else {
        panic!()
    };
    assert_eq!(front.curvature_radius, 0.1);
    assert_eq!([front.aperture_radius, stop.aperture_radius], [0.02, 0.006]);
    // 1 / (3 - s) + 1 / s = 10 for a thin lens; the stop is 5 mm nearer to the film.
    let film = 1.5 - (2.25_f64 - 0.3).sqrt() - 0.005;
    assert!((stop.thickness - film).abs() < 1e-9, "{}", stop.thickness);
}

#[test]
fn stops_are_as_wide_as_the_lens_file_at_most() {
    let loaded = with_lens("\"float aperturediameter\" 25").unwrap();
    let found = warnings(&loaded);
    assert!(
        found.len() == 1 && found[0].contains("20 is used"),
        "{found:?}"
    );
}

#[test]
fn stops_have_shapes() {
    for name in ["gaussian", "square", "pentagon", "star", "stop.png"] {
        let loaded = with_lens(&format!("\"string aperture\" \"{name}\"")).unwrap();
        let Projection::Lenses(lenses) = &loaded.scene.camera.projection else {
            panic!()
        };
        let stop = lenses.stop.as_ref().unwrap();
        let mean =
            stop.values.iter().map(|v| f64::from(*v)).sum::<f64>() / stop.values.len() as f64;
        assert!(
            (mean - std::f64::consts::FRAC_PI_4).abs() < 1e-4,
            "{name}: {mean}"
        );
        if name == "stop.png" {
            // Dark at the upper left.
            assert!(
                stop.values[2] == 0.0 && stop.values[3] > 1.0,
                "{:?}",
                stop.values
            );
        }
    }
}

#[test]
fn what_lenses_cannot_do_is_located() {
    for (parameters, column, what) in [
        ("\"float focusdistance\" 0.3", 58, "focus from 0.4"),
        ("\"string aperture\" \"none.png\"", 76, "none.png"),
        ("\"float lensradius\" 0.1", 58, "lensradius"),
    ] {
        let (message, place) = match with_lens(parameters) {
            Err(error) => (error.message().to_owned(), [error.line(), error.column()]),
            Ok(loaded) => {
                let warning = &loaded.warnings[0];
                (
                    warning.message().to_owned(),
                    [warning.line(), warning.column()],
                )
            }
        };
        assert!(message.contains(what), "{message}");
        assert_eq!(place, [2, column], "{message}");
    }
}

#[test]
fn sensors_keep_brightness_and_balance_white() {
    let plain = with_options("Film \"rgb\" \"float maxcomponentvalue\" 10")
        .scene
        .film;
    assert_eq!(plain.max_component, Some(10.0));
    assert_eq!(plain.balance, Film::NO_BALANCE);
    let text = "Film \"rgb\" \"string sensor\" \"canon_eos_100d\" \"float iso\" 150";
    let sensor = with_options(text);
    assert_eq!(sensor.scene.film.exposure, 1.5);
    assert_eq!(
        sensor.scene.film.balance,
        Film::NO_BALANCE,
        "balanced for 6500 K"
    );
    assert_eq!(warnings(&sensor).len(), 1);
    let warm = with_options("Film \"rgb\" \"float whitebalance\" 3500")
        .scene
        .film;
    assert!(
        warm.balance[0][0] < 1.0 && warm.balance[2][2] > 1.0,
        "{:?}",
        warm.balance
    );
    assert!(
        load("Film \"rgb\" \"string sensor\" \"brownie\"\nWorldBegin Shape \"sphere\"").is_err()
    );
    let reversed = with_options("Film \"rgb\" \"float cropwindow\" [0.5 0.25 1 0]")
        .scene
        .film;
    assert_eq!(reversed.crop, [320, 640, 0, 720]);
}

#[test]
fn colour_spaces_are_converted_where_they_are_read() {
    let loaded = load_world(
        "AttributeBegin ColorSpace \"rec2020\" Attribute \"light\" \"rgb I\" [0.5 0.5 0.5]
         LightSource \"point\" ColorSpace \"srgb\" LightSource \"point\" \"rgb I\" [1 0 0] AttributeEnd
         ColorSpace \"aces2065-1\" LightSource \"point\" \"rgb I\" [1 1 1]
         Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]",
    )
    .unwrap();
    let intensity = |i: usize| match loaded.scene.lights[i] {
        Light::Point { intensity, .. } => intensity,
        _ => panic!(),
    };
    for (found, expected) in [(intensity(0), [0.5; 3]), (intensity(1), [1.0, 0.0, 0.0])] {
        for (f, e) in found.to_array().into_iter().zip(expected) {
            assert!((f - e).abs() < 2e-3, "{found:?}");
        }
    }
    let white = intensity(2);
    assert!(
        white.r > white.g && white.g > white.b,
        "ACES is warmer: {white:?}"
    );
    let id = loaded.scene.shapes[0].material;
    let MaterialKind::Diffuse {
        reflectance: ColourParam::Value(grey),
        ..
    } = loaded.scene.materials[id.0].kind
    else {
        panic!()
    };
    let Rgb { r, g, b } = grey;
    assert!(
        [r, g, b].iter().all(|x| (x - 0.5).abs() < 1e-3),
        "grey stays grey: {grey:?}"
    );
}
