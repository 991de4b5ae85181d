//! Cameras with lenses in pictures: brightness, vignetting, and what is in focus.

mod common;

use common::*;
use glam::{DMat4, DVec3};
use specula_render::{PreparedScene, RenderOptions, Strategy};
use specula_scene::scene::*;

/// Distance from the film to the plane in focus, in metres.
const FOCUS: f64 = 2.0;

/// A biconvex singlet: radius of curvature and thickness in metres, and index.
const RADIUS: f64 = 0.05;
const THICKNESS: f64 = 0.004;
const ETA: f64 = 1.5;

/// Its focal length, and the distance of its principal planes from its vertices (lensmaker's equation for thick
/// lenses).
fn singlet() -> [f64; 2] {
    let power = (ETA - 1.0) * (2.0 / RADIUS - (ETA - 1.0) * THICKNESS / (ETA * RADIUS * RADIUS));
    let focal = 1.0 / power;
    [focal, focal * (ETA - 1.0) * THICKNESS / (ETA * RADIUS)]
}

/// From the rear principal plane to the film, where the plane at [`FOCUS`] from the film is in focus.
fn image_distance() -> f64 {
    let [focal, plane] = singlet();
    let reach = FOCUS - (THICKNESS - 2.0 * plane);
    0.5 * (reach - (reach * (reach - 4.0 * focal)).sqrt())
}

/// The singlet with a stop at its rear vertex, focused at [`FOCUS`]; the film is as wide as high. In metres.
fn camera(stop: Option<StopPicture>, side: f64, stop_radius: f64) -> Camera {
    let interface = |curvature_radius: f64, thickness, eta, aperture_radius| LensInterface {
        curvature_radius,
        thickness,
        eta,
        aperture_radius,
    };
    let lenses = LensSystem {
        interfaces: vec![
            interface(RADIUS, THICKNESS, ETA, 0.014),
            interface(-RADIUS, 0.0, 1.0, 0.014),
            interface(0.0, stop_distance(), 1.0, stop_radius),
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

/// From the stop to the film.
fn stop_distance() -> f64 {
    image_distance() - singlet()[1]
}

/// A uniform sky is as bright as the stop is wide, by the fourth power of the cosine.
#[test]
fn skies_are_as_bright_as_the_pupil_is_wide() {
    let mut scene = empty(camera(None, 0.02, 0.01), 9);
    scene.lights.push(constant_sky(2.0));
    // Nothing that is seen, for a scene needs a shape.
    let m = material(&mut scene, diffuse(0.5));
    scene.shapes.push(sphere(0.1, [0.0, -9.0, 0.0], m));
    let picture = render(&scene, 4096, 3, Strategy::Mis);
    let d = stop_distance();
    let a = 0.01_f64;
    for (i, colour) in picture.colour.iter().enumerate() {
        let at = |i: usize| 0.02 * ((i as f64 + 0.5) / 9.0 - 0.5);
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

/// Radius of the stop there: so narrow that spherical aberration does not show.
const STOP: f64 = 0.002;

/// A small light at a distance along the axis, as wide as 8 thousandths of that: centroid and mean square of the
/// distance from there, in pixels to the right and downwards.
fn light_at(distance: f64, stop: Option<StopPicture>) -> ([f64; 2], f64) {
    let mut scene = empty(camera(stop, SIDE, STOP), PIXELS);
    let m = material(&mut scene, diffuse(0.0));
    #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
    let light = sphere((0.004 * distance) as f32, [0.0, distance, 0.0], m);
    scene.shapes.push(emitting(light, 1.0));
    let picture = render(&scene, 256, 1, Strategy::Mis);
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
/// Similar triangles behind the stop: of a radius `a`, and the film at `s` where the image is at `s'` from it, the
/// blur's radius is `a |s' - s| / s'`.
fn radii(distance: f64) -> [f64; 2] {
    let [focal, plane] = singlet();
    let film = image_distance();
    let object = distance - film - (THICKNESS - 2.0 * plane);
    let image = 1.0 / (1.0 / focal - 1.0 / object);
    let pixel = SIDE / f64::from(PIXELS);
    let blur = STOP * (1.0 - (film - plane) / (image - plane)).abs();
    [blur / pixel, 0.004 * distance * film / object / pixel]
}

#[test]
fn lights_are_sharp_in_focus_and_as_wide_as_the_stop_elsewhere() {
    for distance in [FOCUS, 0.2, 0.12] {
        let ([x, y], square) = light_at(distance, None);
        // Uniform disks have half the squares of their radii, pixels a sixth.
        let [blur, light] = radii(distance);
        let expected = 0.5 * (blur * blur + light * light) + 1.0 / 6.0;
        let error = (square - expected).abs();
        assert!(
            error < 0.05 * expected + 0.06,
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
    let ([x, y], _) = light_at(0.12, Some(half));
    // The picture is a square around the stop: its lower half has its middle half a radius below.
    let [blur, _] = radii(0.12);
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
    // A quarter of the film, by the ratio of the distances from the principal planes.
    let (film, plane) = (image_distance(), singlet()[1]);
    let expected = 0.009 * (FOCUS - film - (THICKNESS - 2.0 * plane)) / film;
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
