//! Cameras with lenses in pictures: brightness, vignetting, and what is in focus.

mod common;

use common::*;
use glam::{DMat4, DVec3};
use specula_render::{PreparedScene, RenderOptions, Strategy};
use specula_scene::scene::*;

/// Distance from the film to the plane in focus, in metres.
const FOCUS: f64 = 2.0;

/// A thin singlet of 50 mm with a stop, focused at [`FOCUS`]; the film is as wide as high. In metres.
fn camera(stop: Option<StopPicture>, side: f64, stop_radius: f64) -> Camera {
    let interface = |curvature_radius: f64, thickness, eta, aperture_radius| LensInterface {
        curvature_radius,
        thickness,
        eta,
        aperture_radius,
    };
    // 1 / f = 0.5 (1 / R + 1 / R).
    let radius = 0.05;
    // 1 / (2 - s) + 1 / s = 20.
    let film = 1.0 - (1.0_f64 - 0.1).sqrt();
    let lenses = LensSystem {
        interfaces: vec![
            interface(radius, 1e-6, 1.5, 0.02),
            interface(-radius, 1e-6, 1.0, 0.02),
            interface(0.0, film, 1.0, stop_radius),
        ],
        stop,
        film_diagonal: side * 2.0_f64.sqrt(),
    };
    Camera {
        projection: Projection::Lenses(Box::new(lenses)),
        focal_distance: FOCUS,
        ..look([0.0; 3], [0.0, 1.0, 0.0], 90.0)
    }
}

/// A uniform sky is as bright as the stop is wide, by the fourth power of the cosine.
#[test]
fn skies_are_as_bright_as_the_pupil_is_wide() {
    let mut scene = empty(camera(None, 0.036, 0.01), 9);
    scene.lights.push(constant_sky(2.0));
    // Nothing that is seen, for a scene needs a shape.
    let m = material(&mut scene, diffuse(0.5));
    scene.shapes.push(sphere(0.1, [0.0, -9.0, 0.0], m));
    let picture = render(&scene, 256, 3, Strategy::Mis);
    let d = 1.0 - 0.9_f64.sqrt();
    let a = 0.01_f64;
    for (i, colour) in picture.colour.iter().enumerate() {
        let at = |i: usize| 0.036 * ((i as f64 + 0.5) / 9.0 - 0.5);
        let x2 = at(i % 9).powi(2) + at(i / 9).powi(2);
        // The stop is next to the film's side of the lens: a uniform disk of radiance 2.
        let sum = d * d + x2 + a * a;
        let whole = (sum * sum - 4.0 * a * a * x2).sqrt();
        let expected = core::f64::consts::PI * (1.0 - (d * d + x2 - a * a) / whole);
        let error = f64::from(colour.g) / expected - 1.0;
        assert!(error.abs() < 0.02, "pixel {i}: {} and {expected}", colour.g);
    }
}

/// Side of the film in the pictures of small lights, in metres, and in pixels.
const SIDE: f64 = 0.006;
const PIXELS: u32 = 48;

/// A small light at a distance along the axis, as wide as 8 thousandths of that: centroid and mean square of the
/// distance from there, in pixels to the right and downwards.
fn light_at(distance: f64, stop: Option<StopPicture>) -> ([f64; 2], f64) {
    let mut scene = empty(camera(stop, SIDE, 0.004), PIXELS);
    let m = material(&mut scene, diffuse(0.0));
    #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
    let light = sphere((0.004 * distance) as f32, [0.0, distance, 0.0], m);
    scene.shapes.push(emitting(light, 1.0));
    let picture = render(&scene, 64, 1, Strategy::Mis);
    let width = PIXELS as usize;
    let lit = picture.colour.iter().enumerate().map(|(i, c)| {
        let at = |i: usize| i as f64 + 0.5 - 0.5 * f64::from(PIXELS);
        ([at(i % width), at(i / width)], f64::from(c.g))
    });
    let lit: Vec<([f64; 2], f64)> = lit.collect();
    let mean = |of: &dyn Fn([f64; 2]) -> f64| {
        let sum: f64 = lit.iter().map(|(at, v)| of(*at) * v).sum();
        sum / lit.iter().map(|(_, v)| v).sum::<f64>()
    };
    let centre = [mean(&|[x, _]| x), mean(&|[_, y]| y)];
    let square = mean(&|[x, y]| (x - centre[0]).powi(2) + (y - centre[1]).powi(2));
    (centre, square)
}

/// Radii on the film, in pixels: of the blur of a point at a distance, and of the light's own image.
///
/// Similar triangles behind the lens: of a stop of radius `a`, and the film at `s` where the image is at `s'`, the
/// blur's radius is `a |s' - s| / s'`.
fn radii(distance: f64) -> [f64; 2] {
    let film = 1.0 - 0.9_f64.sqrt();
    let object = distance - film;
    let image = 1.0 / (20.0 - 1.0 / object);
    let pixel = SIDE / f64::from(PIXELS);
    let blur = 0.004 * (1.0 - film / image).abs();
    [blur / pixel, 0.004 * distance * film / object / pixel]
}

#[test]
fn lights_are_sharp_in_focus_and_as_wide_as_the_stop_elsewhere() {
    for distance in [FOCUS, 0.4, 0.25] {
        let ([x, y], square) = light_at(distance, None);
        // Uniform disks have half the squares of their radii, pixels a sixth.
        let [blur, light] = radii(distance);
        let expected = 0.5 * (blur * blur + light * light) + 1.0 / 6.0;
        assert!(
            (square / expected - 1.0).abs() < 0.05,
            "{distance}: {square} and {expected}"
        );
        assert!(x.abs() < 0.2 && y.abs() < 0.2, "{distance}: ({x}, {y})");
        assert!(distance < FOCUS || blur < 1e-6);
    }
}

/// Half a stop lets the half of a blurred light arrive: nearer than in focus, light meets behind the film, and arrives
/// on the side that it passed. The film's picture is turned: what passed below is seen above.
#[test]
fn blurred_lights_have_the_shape_of_the_stop() {
    let rows = (0..64).map(|row| f32::from(u8::from(row < 32)));
    let half = StopPicture {
        width: 2,
        height: 64,
        values: rows.flat_map(|v| [v; 2]).collect(),
    };
    let ([x, y], _) = light_at(0.25, Some(half));
    // The picture is a square around the stop: its lower half has its middle half a radius below.
    let [blur, _] = radii(0.25);
    assert!(x.abs() < 0.3, "{x}");
    assert!((y + 0.5 * blur).abs() < 0.05 * blur, "{y} and {blur}");
}

#[test]
fn pixels_show_what_the_middle_of_the_pupil_sees() {
    let mut scene = empty(camera(None, 0.036, 0.01), 64);
    let m = material(&mut scene, diffuse(0.5));
    let wall = DMat4::from_translation(DVec3::new(0.0, FOCUS, 0.0))
        * DMat4::from_rotation_x(core::f64::consts::FRAC_PI_2);
    let wall = square(&mut scene, 5.0, wall, m);
    scene.shapes.push(wall);
    let prepared = PreparedScene::new(&scene, &RenderOptions::default()).expect("sound");
    let seen = prepared.seen([48.0, 16.0]).expect("the wall");
    // A quarter of the film, by the ratio of the distances from the lens.
    let film = 1.0 - 0.9_f64.sqrt();
    let expected = 0.009 * (FOCUS - film) / film;
    let [x, y, z] = seen.position.map(f64::from);
    assert!((y - FOCUS).abs() < 1e-4, "{:?}", seen.position);
    assert!(
        (x.abs() - expected).abs() < 0.01 * expected,
        "{x} and {expected}"
    );
    assert!((z - expected).abs() < 0.01 * expected, "{z} and {expected}");
}

#[test]
fn lenses_are_in_the_way_of_no_other_option() {
    let mut scene = empty(camera(None, 0.036, 0.01), 16);
    scene.lights.push(constant_sky(1.0));
    let m = material(&mut scene, diffuse(0.5));
    scene.shapes.push(sphere(0.3, [0.0, FOCUS, 0.0], m));
    let mean_of = |options: RenderOptions| {
        let prepared = PreparedScene::new(&scene, &options).expect("sound");
        let mut renderer = specula_render::Renderer::new(&prepared, options);
        renderer.render_pass(64, &std::sync::atomic::AtomicBool::new(false));
        mean(&renderer.film().picture())
    };
    let alone = RenderOptions {
        samples_per_pixel: 64,
        ..RenderOptions::default()
    };
    let shared = RenderOptions {
        share_paths: 4,
        ..alone.clone()
    };
    let [a, b] = [mean_of(alone), mean_of(shared)];
    assert!((a.0 / b.0 - 1.0).abs() < 0.01, "{a:?} and {b:?}");
}
