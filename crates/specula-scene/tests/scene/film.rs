//! Cameras, films, sensors and colour spaces.

use glam::DVec3;
use specula_bsdf::Rgb;
use specula_scene::scene::{
    ColourParam, EnvironmentMapping, Film, Light, MaterialKind, Projection,
};

use super::common::{Folder, load, load_world, warnings};

fn with_options(text: &str) -> specula_scene::Loaded {
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

#[test]
fn lenses_become_a_thin_lens() {
    let folder = Folder::new();
    // 100 mm by the lensmaker's equation; the stop is 20 mm wide.
    folder.write("lens.dat", "# lens\n100 0 1.5 40\n-100 5 1 40\n0 90 0 20\n");
    let loaded = folder
        .load(
            "Film \"rgb\" \"integer xresolution\" 300 \"integer yresolution\" 200 \"float diagonal\" 43.267
             Camera \"realistic\" \"string lensfile\" \"lens.dat\" \"float aperturediameter\" 25 \"float focusdistance\" 1000
             WorldBegin Shape \"sphere\"",
        )
        .unwrap();
    let Projection::Perspective { fov_deg } = loaded.scene.camera.projection else {
        panic!()
    };
    // The shorter side of a film of 36 x 24 mm.
    let expected = 2.0 * (12.0f64 / 100.0).atan().to_degrees();
    assert!((fov_deg - expected).abs() < 1e-2, "{fov_deg}");
    assert!((loaded.scene.camera.lens_radius - 0.01).abs() < 1e-9);
    // f/5: pi / (4 * 25) of the radiance.
    let exposure = std::f32::consts::PI / 100.0;
    assert!((loaded.scene.film.exposure / exposure - 1.0).abs() < 1e-3);
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
