//! What files without light stand on: it ends nowhere, and it is dark where it is touched.

mod common;

use common::*;
use specula_render::Strategy;
use specula_scene::scene::{Camera, Scene};
use specula_scene::{LoadOptions, load_bytes};

/// A cube of side 2.
const CUBE: &str = "v -1 0 -1\nv 1 0 -1\nv -1 2 -1\nv 1 2 -1\nv -1 0 1\nv 1 0 1\nv -1 2 1\nv 1 2 1\n\
    f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

fn staged() -> Scene {
    let text = CUBE.as_bytes().to_vec();
    let loaded = load_bytes("cube.obj".as_ref(), text, &LoadOptions::default());
    loaded.expect("a cube").scene
}

/// The mean of what a camera sees, and its standard error.
fn seen(scene: &Scene, camera: Camera) -> (f64, f64) {
    let film = empty(camera.clone(), 8).film;
    let scene = Scene {
        camera,
        film,
        ..scene.clone()
    };
    mean(&render(&scene, 1024, 8, Strategy::Mis))
}

#[test]
fn the_floor_has_no_rim() {
    let scene = staged();
    let eye = [0.0, 5.0, 20.0];
    // The rim lies 1.6 degrees below the horizon.
    let [floor, beyond] = [4.0, 0.8].map(|below: f64| {
        let down = below.to_radians().sin();
        seen(
            &scene,
            look(eye, [-20.0, eye[1] - 20.0 * down, eye[2]], 0.2),
        )
    });
    let expected = beyond.0;
    assert!(floor.1 < 0.005 * floor.0, "{floor:?}");
    assert!(
        (floor.0 / expected - 1.0).abs() < 0.03,
        "{floor:?} {beyond:?}"
    );
}

#[test]
fn shadows_are_dark_at_the_object_and_soft_away_from_it() {
    let scene = staged();
    // Away from the key light, which is in front to the left.
    let at = |distance: f64| {
        let x = 1.0 + distance;
        seen(&scene, look([x, 4.0, 6.0], [x, 0.0, 0.5], 0.1)).0
    };
    let open = at(12.0);
    let shadow = [0.02, 0.3, 0.6, 0.9, 1.2, 2.0].map(|d| at(d) / open);
    assert!(shadow[0] < 0.5, "{shadow:?}");
    assert!(shadow[5] > 0.85, "{shadow:?}");
    // A hard edge would be one step.
    let steepest = shadow.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    assert!(steepest < 0.4, "{shadow:?}");
}
