//! A prepared scene under other cameras and sizes, what a pixel shows, a film that goes on.

use glam::DVec3;
use specula_render::{FilmBuffer, PreparedScene, RenderOptions, Renderer};
use specula_scene::scene::Camera;
use specula_scene::{Scene, load_bytes};

fn scene(shapes: &str) -> Scene {
    let text = format!(
        "LookAt 0 -4 0  0 0 0  0 0 1\n\
        Camera \"perspective\" \"float fov\" 40\n\
        Film \"rgb\" \"integer xresolution\" 20 \"integer yresolution\" 16\nWorldBegin\n\
        LightSource \"point\" \"point3 from\" [2 -3 4] \"rgb I\" [20 20 20]\n\
        LightSource \"infinite\" \"rgb L\" [0.2 0.3 0.4]\n{shapes}"
    );
    let loaded = load_bytes("look.pbrt".as_ref(), text.into(), &Default::default());
    loaded.expect("a scene").scene
}

const BALL: &str =
    "Material \"conductor\" \"float roughness\" 0.2\nShape \"sphere\" \"float radius\" 1\n";

fn film(prepared: &PreparedScene, options: &RenderOptions) -> FilmBuffer {
    let mut renderer = Renderer::new(prepared, options.clone());
    renderer.render_pass(3, &false.into());
    renderer.into_film()
}

#[test]
fn another_look_is_that_of_a_scene_prepared_afresh() {
    let mut scene = scene(BALL);
    let options = RenderOptions::from_scene(&scene);
    let mut prepared = PreparedScene::new(&scene, &options).unwrap();
    let first = film(&prepared, &options);
    let own = scene.camera.clone();
    let eye = DVec3::new(2.0, -3.0, 1.5);
    scene.camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Z, 50.0, &scene.film);
    let larger = RenderOptions {
        resolution: Some([30, 11]),
        crop: Some([3, 30, 0, 9]),
        ..options.clone()
    };
    for options in [&options, &larger] {
        prepared.look(&scene.camera, &scene.film, options).unwrap();
        let fresh = PreparedScene::new(&scene, options).unwrap();
        assert!(film(&prepared, options) == film(&fresh, options));
    }
    let empty = RenderOptions {
        resolution: Some([0, 11]),
        ..options.clone()
    };
    assert!(prepared.look(&own, &scene.film, &empty).is_err());
    assert_eq!(prepared.resolution(), [30, 11], "as it was");
    prepared.look(&own, &scene.film, &options).unwrap();
    assert!(film(&prepared, &options) == first);
}

#[test]
fn a_film_that_is_taken_goes_on_bit_for_bit() {
    let scene = scene(BALL);
    let options = RenderOptions::from_scene(&scene);
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let mut whole = Renderer::new(&prepared, options.clone());
    whole.render_pass(5, &false.into());
    let begun = film(&prepared, &options);
    let mut rest = Renderer::resume(&prepared, options, begun).unwrap();
    rest.render_pass(2, &false.into());
    assert!(rest.into_film() == *whole.film());
}

#[test]
fn a_pixel_shows_the_first_surface_that_is_opaque() {
    let seen = |shapes: &str, raster| {
        let scene = scene(shapes);
        let options = RenderOptions::from_scene(&scene);
        PreparedScene::new(&scene, &options).unwrap().seen(raster)
    };
    let middle = [10.0, 8.0];
    let ball = seen(BALL, middle).unwrap();
    assert!((ball.distance - 3.0).abs() < 1e-5, "{ball:?}");
    assert!((ball.position[1] + 1.0).abs() < 1e-5 && (ball.normal[1] + 1.0).abs() < 1e-5);
    assert_eq!(seen(BALL, [0.5, 0.5]), None);
    let before = |how: &str| {
        format!(
            "{BALL}AttributeBegin\nTranslate 0 -2 0\nRotate 90 1 0 0\nMaterial \"diffuse\"\n{how}\nAttributeEnd\n"
        )
    };
    let disk = seen(&before("Shape \"disk\" \"float radius\" 1"), middle).unwrap();
    assert!(
        (disk.distance - 2.0).abs() < 1e-5 && disk.material != ball.material,
        "{disk:?}"
    );
    for passable in [
        "Shape \"disk\" \"float radius\" 1 \"float alpha\" 0.4",
        "Material \"interface\"\nShape \"disk\" \"float radius\" 1",
    ] {
        let behind = seen(&before(passable), middle).unwrap();
        assert!(
            (behind.distance - 3.0).abs() < 1e-4,
            "{passable}: {behind:?}"
        );
    }
}
