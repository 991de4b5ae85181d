//! What moves in pbrt-v4 scenes: `ActiveTransform`, `TransformTimes` and the shutter.

use glam::{DMat4, DVec3};
use specula_scene::scene::{Motion, ObjectInstance, Trajectory};
use specula_scene::write_pbrt::pbrt_text;
use specula_scene::{Loaded, Scene};

use super::common::{load, warnings};

fn read(text: &str) -> Loaded {
    load(text).unwrap_or_else(|e| panic!("{}: {e}", e.place()))
}

fn moved(x: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(x, 0.0, 0.0))
}

/// Where the origin of something is at a time of the exposure.
fn origin(to_world: &DMat4, motion: Option<&Motion>, time: f64) -> [f64; 3] {
    let m = motion.map_or(*to_world, |m| Trajectory::new(to_world, m).at(time));
    m.w_axis.truncate().to_array()
}

const MOVES: &str = "ActiveTransform EndTime Translate 8 0 0 ActiveTransform All";

#[test]
fn shapes_instances_and_cameras_move_while_the_shutter_is_open() {
    let loaded = read(&format!(
        "TransformTimes 1 5
         ActiveTransform StartTime LookAt 0 0 -5  0 0 0  0 1 0
         ActiveTransform EndTime LookAt 0 0 -9  0 0 0  0 1 0 ActiveTransform All
         Camera \"perspective\" \"float shutteropen\" 2 \"float shutterclose\" 4
         WorldBegin
         AttributeBegin {MOVES} Shape \"sphere\" AttributeEnd
         ObjectBegin \"o\" {MOVES} Shape \"sphere\" ObjectEnd
         AttributeBegin {MOVES} ObjectInstance \"o\" AttributeEnd
         Shape \"sphere\""
    ));
    assert_eq!(warnings(&loaded), [""; 0]);
    let scene = &loaded.scene;
    assert_eq!(scene.film.exposure, 2.0);
    // The shutter opens a quarter into the motion and closes at three quarters.
    let motion = Motion {
        end: moved(8.0),
        times: [-0.5, 1.5],
    };
    assert_eq!(scene.shapes[0].motion, Some(motion));
    assert_eq!(scene.shapes[0].to_world, DMat4::IDENTITY);
    assert_eq!(scene.objects[0].shapes[0].motion, Some(motion));
    assert_eq!(scene.instances[0].motion, Some(motion));
    assert_eq!(scene.shapes[1].motion, None);
    for (time, z) in [(0.0, -6.0), (0.5, -7.0), (1.0, -8.0)] {
        let camera = &scene.camera;
        let eye = origin(&camera.to_world, camera.motion.as_ref(), time);
        assert!((eye[2] - z).abs() < 1e-12, "{eye:?}");
        let shape = &scene.shapes[0];
        let centre = origin(&shape.to_world, shape.motion.as_ref(), time);
        assert!((centre[0] - (2.0 + 4.0 * time)).abs() < 1e-12, "{centre:?}");
    }
}

#[test]
fn what_the_shutter_does_not_see_move_is_still() {
    let with = |options: &str| {
        let text = format!("{options} WorldBegin {MOVES} Shape \"sphere\"");
        read(&text).scene.shapes[0].clone()
    };
    // Over before the shutter opens, or later.
    let after = with(
        "TransformTimes 0 1 Camera \"perspective\" \"float shutteropen\" 1 \"float shutterclose\" 2",
    );
    assert_eq!((after.to_world, after.motion), (moved(8.0), None));
    let before = with("TransformTimes 1 2 Camera \"perspective\"");
    assert_eq!((before.to_world, before.motion), (DMat4::IDENTITY, None));
    // pbrt-v4 swaps a shutter the wrong way round.
    let swapped = with("Camera \"perspective\" \"float shutteropen\" 1 \"float shutterclose\" 0");
    assert_eq!(swapped.motion.map(|m| m.times), Some([0.0, 1.0]));
    // The same transform at both times is none of two.
    let same = read("WorldBegin ActiveTransform All Translate 1 0 0 Shape \"sphere\"").scene;
    assert!(!same.moves());
}

#[test]
fn lights_do_not_move_and_what_presses_flat_stays() {
    let loaded = read(&format!(
        "WorldBegin {MOVES} LightSource \"point\"
         AttributeBegin AreaLightSource \"diffuse\" Shape \"sphere\" AttributeEnd
         AttributeBegin ActiveTransform EndTime Scale 1 1 0 Shape \"sphere\" AttributeEnd
         AttributeBegin ActiveTransform EndTime Scale 1 1 -1 Shape \"disk\" AttributeEnd"
    ));
    let flat = "the shape is pressed flat as it moves: it is rendered where it starts";
    assert_eq!(
        warnings(&loaded),
        [
            "the light moves; it is rendered where it starts",
            "the shape moves and emits light: it is rendered where it starts",
            flat,
            flat,
        ]
    );
    assert!(!loaded.scene.moves());
    assert!(
        loaded
            .scene
            .shapes
            .iter()
            .all(|s| s.to_world == DMat4::IDENTITY)
    );
}

#[test]
fn times_are_those_of_the_whole_file_and_ascend() {
    let error = |text: &str| {
        let error = load(text).unwrap_err();
        (error.to_string(), error.place().line())
    };
    let (message, line) = error("Camera \"perspective\"\nTransformTimes 2 2\nWorldBegin");
    assert!(
        message.contains("expected a start before the end, found 2 and 2"),
        "{message}"
    );
    assert_eq!(line, 2);
    let (message, line) = error("WorldBegin\n\nTransformTimes 0 1\nShape \"sphere\"");
    assert!(
        message.contains("`TransformTimes` after `WorldBegin`"),
        "{message}"
    );
    assert_eq!(line, 3);
}

#[test]
fn faults_of_motions_are_told() {
    let scene = || read(&format!("WorldBegin {MOVES} Shape \"sphere\"")).scene;
    scene().validate().unwrap();
    let fault = |change: &dyn Fn(&mut Motion)| {
        let mut scene = scene();
        change(scene.shapes[0].motion.as_mut().unwrap());
        scene.validate().unwrap_err().to_string()
    };
    assert!(fault(&|m| m.times = [1.0, 1.0]).contains("do not ascend"));
    assert!(fault(&|m| m.times = [0.0, f64::INFINITY]).contains("do not ascend"));
    assert!(
        fault(&|m| m.end = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0))).contains("inside out")
    );
    assert!(fault(&|m| m.end = DMat4::ZERO).contains("end of the motion of shape 0"));
    assert!(fault(&|m| m.end = moved(1e30)).contains("beyond 1e18"));
    let mut emits = scene();
    emits.shapes[0].emission = Some(specula_scene::scene::Emission {
        radiance: specula_scene::scene::ColourParam::Value(specula_bsdf::Rgb::WHITE),
        two_sided: false,
    });
    assert!(
        emits
            .validate()
            .unwrap_err()
            .to_string()
            .contains("it moves and emits")
    );
}

#[test]
fn motions_are_written_and_part_of_the_fingerprint() {
    let moving = format!(
        "TransformTimes -1 3
         {MOVES} Camera \"perspective\" WorldBegin
         AttributeBegin {MOVES} Rotate 90 0 0 1 Shape \"sphere\" AttributeEnd
         ObjectBegin \"o\" Shape \"sphere\" ObjectEnd
         AttributeBegin {MOVES} ObjectInstance \"o\" AttributeEnd"
    );
    let scene = read(&moving).scene;
    let back = |scene: &Scene| {
        let (text, notes) = pbrt_text(scene, "out.pbrt".as_ref()).unwrap();
        (read(&text).scene, notes)
    };
    let (again, notes) = back(&scene);
    assert_eq!(notes, [""; 0]);
    assert_eq!(again.shapes[0].motion, scene.shapes[0].motion);
    assert_eq!(again.instances, scene.instances);
    let eye = |scene: &Scene, time| {
        let camera = &scene.camera;
        origin(&camera.to_world, camera.motion.as_ref(), time)
    };
    for time in [0.0, 0.4, 1.0] {
        let (a, b) = (eye(&scene, time), eye(&again, time));
        assert!((a[0] - b[0]).abs() < 1e-9, "{a:?} {b:?}");
    }
    // Other times than those of the rest: as far as the shutter sees.
    let mut odd = scene.clone();
    odd.instances.push(ObjectInstance {
        motion: Some(Motion {
            end: moved(4.0),
            times: [-2.0, 2.0],
        }),
        ..odd.instances[0].clone()
    });
    let (again, notes) = back(&odd);
    assert_eq!(notes, [""; 0]);
    for (a, b) in odd.instances.iter().zip(&again.instances) {
        for time in [0.0, 0.3, 1.0] {
            let [a, b] = [a, b].map(|i| origin(&i.to_world, i.motion.as_ref(), time));
            assert!((a[0] - b[0]).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
    odd.instances[1].motion.as_mut().unwrap().times = [0.25, 0.5];
    assert!(back(&odd).1[0].contains("as if they took the whole exposure"));

    // Every motion counts, and where it is.
    let mut prints = vec![scene.fingerprint(), odd.fingerprint()];
    let mut still = scene.clone();
    still.camera.motion = None;
    prints.push(still.fingerprint());
    still.shapes[0].motion = None;
    prints.push(still.fingerprint());
    still.instances[0].motion = None;
    prints.push(still.fingerprint());
    prints.sort_unstable();
    prints.dedup();
    assert_eq!(prints.len(), 5);
}
