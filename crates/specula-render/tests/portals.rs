//! Lights behind portals: what a wall with a window lets in of the whole light.

mod common;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::Strategy;
use specula_scene::Image;
use specula_scene::scene::*;

/// The window: `[-0.6, 0.2] x [0.3, 1.1]` along x and z, in the wall y = 1 of a room.
const WINDOW: [[f64; 2]; 2] = [[-0.6, 0.2], [0.3, 1.1]];

/// A rectangle in the plane y = 1, seen from the room.
fn panel(scene: &mut Scene, [x0, x1]: [f64; 2], [z0, z1]: [f64; 2], m: MaterialId) {
    let turn = DMat4::from_rotation_x(core::f64::consts::FRAC_PI_2);
    let half = DVec3::new(0.5 * (x1 - x0), 0.5 * (z1 - z0), 1.0);
    let centre = DVec3::new(0.5 * (x0 + x1), 1.0, 0.5 * (z0 + z1));
    let place = DMat4::from_translation(centre) * turn * DMat4::from_scale(half);
    let panel = square(scene, 1.0, place, m);
    scene.shapes.push(panel);
}

/// A floor, a glossy ball, and the wall around the window, which shades all but what is seen through it.
fn room() -> Scene {
    let mut scene = empty(look([0.3, -2.5, 0.8], [0.0, 0.5, 0.3], 40.0), 24);
    let grey = material(&mut scene, diffuse(0.6));
    // It ends at the wall: what lies outside would bounce light in.
    let inside = DMat4::from_translation(DVec3::new(0.0, -19.0, 0.0));
    let floor = square(&mut scene, 20.0, inside, grey);
    scene.shapes.push(floor);
    let metal = material(&mut scene, mirror_metal(0.2));
    scene.shapes.push(sphere(0.3, [0.2, 0.2, 0.3], metal));
    let black = material(&mut scene, diffuse(0.0));
    let [[x0, x1], [z0, z1]] = WINDOW;
    let far = 60.0;
    panel(&mut scene, [-far, x0], [-1.0, far], black);
    panel(&mut scene, [x1, far], [-1.0, far], black);
    panel(&mut scene, [x0, x1], [-1.0, z0], black);
    panel(&mut scene, [x0, x1], [z1, far], black);
    scene
}

/// Walls behind the camera, above and beside, as far as the one with the window: they the window as the one way in.
fn closed(mut scene: Scene) -> Scene {
    let black = material(&mut scene, diffuse(0.0));
    let behind = DMat4::from_translation(DVec3::new(0.0, -4.0, 0.0));
    let turn = DMat4::from_rotation_x(core::f64::consts::FRAC_PI_2);
    for place in [
        behind * turn,
        DMat4::from_translation(DVec3::new(0.0, -89.0, 30.0)),
    ] {
        let wall = square(&mut scene, 90.0, place, black);
        scene.shapes.push(wall);
    }
    for x in [-50.0, 50.0] {
        let turn = DMat4::from_rotation_y(core::f64::consts::FRAC_PI_2);
        let place = DMat4::from_translation(DVec3::new(x, -89.0, 0.0)) * turn;
        let wall = square(&mut scene, 90.0, place, black);
        scene.shapes.push(wall);
    }
    scene
}

fn corners() -> [[f64; 3]; 4] {
    let [[x0, x1], [z0, z1]] = WINDOW;
    // (p3 - p0) x (p1 - p0) is +y, to the light: z x x.
    [[x0, 1.0, z0], [x1, 1.0, z0], [x1, 1.0, z1], [x0, 1.0, z1]]
}

/// A sky that is brighter on one side, of 64 x 64 pixels.
fn sky() -> Image {
    let side = 64_u32;
    let pixel = |i: u32| {
        let [x, y] = [i % side, i / side].map(|v| v as f32 / side as f32);
        [0.2 + x, 0.3 + y * y, 1.5 * x * (1.0 - y)]
    };
    Image {
        name: "sky".into(),
        width: side,
        height: side,
        pixels: (0..side * side).map(pixel).collect(),
    }
}

fn lit(mut scene: Scene, with_portal: bool, with_picture: bool) -> Scene {
    let image = with_picture.then(|| {
        scene.images.push(sky());
        (ImageId(0), EnvironmentMapping::EqualAreaOctahedral)
    });
    let to_world = DMat4::from_rotation_z(0.4) * DMat4::from_rotation_x(0.8);
    let radiance = Rgb::splat(2.0);
    scene.lights.push(match with_portal {
        true => Light::Portal {
            radiance,
            image,
            to_world,
            corners: corners(),
        },
        false => Light::Infinite {
            radiance,
            image,
            to_world,
        },
    });
    scene
}

#[test]
fn portals_let_in_what_a_window_does() {
    for with_picture in [false, true] {
        let whole = render(
            &lit(closed(room()), false, with_picture),
            256,
            4,
            Strategy::Mis,
        );
        let through = render(
            &lit(closed(room()), true, with_picture),
            64,
            4,
            Strategy::Mis,
        );
        // Without walls, but for the one with the window: all other light is masked by the portal.
        let open = render(&lit(room(), true, with_picture), 64, 4, Strategy::Mis);
        let means = [mean(&through), mean(&whole), mean(&open)];
        assert_agree("a portal", &means, 1, 0.03);
        // Pixels of the picture are blurred there, and constant here.
        assert!((means[0].0 / means[1].0 - 1.0).abs() < 0.03, "{means:?}");
    }
}

/// Light samples through the window alone, and in all directions.
#[test]
fn portals_have_less_noise() {
    let error = |with_portal: bool| {
        let mut scene = lit(closed(room()), with_portal, true);
        // The floor alone: no edges, and no highlight, which lights cannot sample well.
        scene.camera = look([0.0, -1.0, 2.0], [0.0, 0.3, 0.0], 15.0);
        scene
            .shapes
            .retain(|s| matches!(s.geometry, Geometry::Mesh(_)));
        mean(&render(&scene, 64, 1, Strategy::LightsOnly)).1
    };
    let [with, without] = [error(true), error(false)];
    assert!(with < 0.4 * without, "{with} and {without}");
}

#[test]
fn lights_and_lobes_sample_the_same_picture() {
    let scene = lit(room(), true, true);
    let results: Vec<(f64, f64)> = [
        (Strategy::Mis, 64),
        (Strategy::LightsOnly, 64),
        (Strategy::BsdfOnly, 1024),
    ]
    .into_iter()
    .map(|(strategy, spp)| mean(&render(&scene, spp, 2, strategy)))
    .collect();
    assert_agree("strategies", &results, 0, 0.06);
}
