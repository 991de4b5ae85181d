//! Motion blur: a picture of what moves is the mean of pictures of it at all times.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_bsdf::math::{Stream, rgb};
use specula_render::picture::Picture;
use specula_render::{PrepareError, PreparedScene, RenderOptions, Renderer};
use specula_scene::scene::*;

const SIZE: u32 = 16;
/// Pixels along a side of the blocks whose means are compared.
const BLOCK: u32 = 4;
/// Independent pictures of each side of a comparison, from which errors of means are estimated.
const REPEATS: u32 = 10;
/// Times of one mean of still pictures, one in each part of the exposure.
const TIMES: u32 = 16;

fn moved(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(x, y, z))
}

fn motion(end: DMat4) -> Option<Motion> {
    let times = [0.0, 1.0];
    Some(Motion { end, times })
}

/// The scene as it is at a time.
fn still(scene: &Scene, time: f64) -> Scene {
    let mut scene = scene.clone();
    let stop = |to_world: &mut DMat4, motion: &mut Option<Motion>| {
        if let Some(motion) = motion.take() {
            *to_world = Trajectory::new(to_world, &motion).at(time);
        }
    };
    stop(&mut scene.camera.to_world, &mut scene.camera.motion);
    let in_objects = scene.objects.iter_mut().flat_map(|o| &mut o.shapes);
    for shape in scene.shapes.iter_mut().chain(in_objects) {
        stop(&mut shape.to_world, &mut shape.motion);
    }
    for instance in &mut scene.instances {
        stop(&mut instance.to_world, &mut instance.motion);
    }
    scene
}

fn picture(scene: &Scene, samples: u32, seed: u32) -> Picture {
    let options = RenderOptions {
        seed,
        max_depth: 3,
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(scene, &options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options);
    let report = renderer.render_pass(samples, &AtomicBool::new(false));
    assert_eq!(report.invalid_samples, 0);
    renderer.film().picture()
}

/// Means of blocks: colour, albedo, normal.
fn blocks(picture: &Picture) -> Vec<f64> {
    let side = (SIZE / BLOCK) as usize;
    let mut sums = vec![0.0; side * side * 9];
    for (i, at) in (0..SIZE * SIZE).zip(0..) {
        let (x, y) = (i % SIZE, i / SIZE);
        let block = ((y / BLOCK) * (SIZE / BLOCK) + x / BLOCK) as usize;
        let values = picture.colour[at].to_array().into_iter();
        let values = values
            .chain(picture.albedo[at].to_array())
            .chain(picture.normal[at].to_array());
        for (k, value) in values.enumerate() {
            sums[9 * block + k] += f64::from(value) / f64::from(BLOCK * BLOCK);
        }
    }
    sums
}

/// Mean and variance of the mean, per value.
struct Estimate(Vec<[f64; 2]>);

impl Estimate {
    fn of(repeat: impl Fn(u32) -> Vec<f64>) -> Self {
        let all: Vec<Vec<f64>> = (0..REPEATS).map(repeat).collect();
        let n = f64::from(REPEATS);
        let moments = (0..all[0].len()).map(|k| {
            let mean = all.iter().map(|v| v[k]).sum::<f64>() / n;
            let squares = all.iter().map(|v| (v[k] - mean).powi(2)).sum::<f64>();
            [mean, squares / (n - 1.0) / n]
        });
        Self(moments.collect())
    }

    fn moving(scene: &Scene) -> Self {
        Self::of(|seed| blocks(&picture(scene, 64, 1000 + seed)))
    }

    /// Of pictures at random times of `[0, exposure)`, stratified.
    fn stills(scene: &Scene, exposure: f64) -> Self {
        Self::of(|seed| {
            let mut random = Stream::new(u64::from(seed));
            let mut sums = Vec::new();
            for i in 0..TIMES {
                let u: f64 = random.next();
                let time = exposure * (f64::from(i) + u) / f64::from(TIMES);
                let values = blocks(&picture(&still(scene, time), 4, 100 * seed + i));
                sums.resize(values.len(), 0.0);
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum += value / f64::from(TIMES);
                }
            }
            sums
        })
    }

    /// The largest difference in standard errors.
    fn apart(&self, other: &Self) -> f64 {
        let pairs = self.0.iter().zip(&other.0);
        let z = pairs.map(|([m, v], [n, w])| {
            // Rounding of sums of samples.
            let error = (v + w).sqrt() + 1e-5;
            (m - n).abs() / error
        });
        z.fold(0.0, f64::max)
    }
}

/// Asserts that a scene's picture is the mean over times, and that this would tell half an exposure from a whole.
fn assert_is_mean_over_times(name: &str, scene: &Scene) {
    scene.validate().expect("the scene is sound");
    let moving = Estimate::moving(scene);
    let apart = moving.apart(&Estimate::stills(scene, 1.0));
    // Of 144 values with about 18 degrees of freedom each, one is beyond 7 by chance in ten thousand tests.
    assert!(apart < 7.0, "{name}: {apart}");
    let fault = moving.apart(&Estimate::stills(scene, 0.5));
    assert!(
        fault > 12.0,
        "{name}: half an exposure is only {fault} apart"
    );
}

fn coloured(r: f32, g: f32, b: f32) -> MaterialKind {
    MaterialKind::Diffuse {
        reflectance: ColourParam::Value(rgb(r, g, b)),
        roughness: FloatParam::Value(0.0),
    }
}

/// A floor under a small lamp and a dim sky, seen from the front and above.
fn floor() -> Scene {
    let mut scene = empty(look([0.0, 3.0, -5.0], [0.0, 0.3, 0.0], 45.0), SIZE);
    let ground = material(&mut scene, coloured(0.6, 0.5, 0.4));
    let turn = DMat4::from_rotation_x(-core::f64::consts::FRAC_PI_2);
    let ground = square(&mut scene, 8.0, turn, ground);
    scene.shapes.push(ground);
    scene.lights.push(Light::Point {
        position: [1.0, 4.0, -1.0],
        intensity: rgb(14.0, 12.0, 10.0),
    });
    scene.lights.push(constant_sky(0.3));
    scene
}

/// A material that is shaded one by one.
fn checked(scene: &mut Scene) -> MaterialId {
    scene.textures.push(Texture::Constant(Rgb::WHITE));
    scene.textures.push(Texture::Constant(Rgb::splat(0.1)));
    scene.textures.push(Texture::Checkerboard {
        even: TextureId(0),
        odd: TextureId(1),
        mapping: TextureMapping::Uv(UvMapping([[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]])),
    });
    let checked = MaterialKind::Diffuse {
        reflectance: ColourParam::Texture(TextureId(2)),
        roughness: FloatParam::Value(0.0),
    };
    material(scene, checked)
}

#[test]
fn moving_shapes_and_their_shadows_are_means_over_times() {
    let mut scene = floor();
    let checked = checked(&mut scene);
    // Shadows fall on what is shaded one by one on the right, in batches on the left.
    let right = moved(8.0, 1e-3, 0.0) * scene.shapes[0].to_world;
    let right = square(&mut scene, 8.0, right, checked);
    scene.shapes.push(right);
    let red = material(&mut scene, coloured(0.9, 0.2, 0.1));
    let metal = material(&mut scene, mirror_metal(0.4));
    let mut ball = sphere(0.6, [-1.6, 0.9, 0.0], red);
    ball.motion = motion(moved(0.8, 1.3, 0.5));
    let place = moved(1.3, 1.0, 0.0);
    let mut plate = square(&mut scene, 0.8, place, metal);
    // Turned about its own axes, sheared and larger at the end.
    let shear = DMat4::from_cols_array(&[
        1.0, 0.3, 0.0, 0.0, 0.0, 1.2, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    ]);
    plate.motion = motion(place * DMat4::from_axis_angle(DVec3::new(0.6, 0.8, 0.0), 2.0) * shear);
    scene.shapes.extend([ball, plate]);
    assert_is_mean_over_times("shapes", &scene);
}

#[test]
fn moving_instances_and_shapes_within_them_are_means_over_times() {
    let mut scene = floor();
    let green = material(&mut scene, coloured(0.2, 0.8, 0.3));
    let checked = checked(&mut scene);
    scene.materials[checked.0].bump = Some(Bump::Height(FloatParam::Texture(TextureId(2))));
    let mut wing = square(&mut scene, 0.5, moved(0.8, 0.0, 0.0), checked);
    wing.alpha = FloatParam::Value(0.7);
    let mut moon = sphere(0.3, [0.0, 0.0, 0.0], green);
    moon.motion = motion(moved(0.0, 0.9, 0.0));
    scene.objects.push(Object {
        name: "bird".into(),
        shapes: vec![wing, moon],
    });
    let start = moved(-1.0, 1.0, 0.0);
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.2));
    scene.instances = vec![
        ObjectInstance {
            object: ObjectId(0),
            to_world: start,
            motion: motion(start * DMat4::from_rotation_y(1.8)),
        },
        ObjectInstance {
            object: ObjectId(0),
            to_world: moved(0.9, 0.8, 0.2) * mirror,
            motion: motion(moved(1.2, 1.0, -0.4) * DMat4::from_rotation_z(-1.5) * mirror),
        },
        ObjectInstance {
            object: ObjectId(0),
            to_world: moved(0.0, 0.6, 1.5),
            motion: None,
        },
    ];
    assert_is_mean_over_times("instances", &scene);
}

#[test]
fn moving_cameras_are_means_over_times() {
    let mut scene = floor();
    let blue = material(&mut scene, coloured(0.1, 0.3, 0.9));
    scene.shapes.push(sphere(0.7, [0.3, 0.7, 0.2], blue));
    scene.camera.lens_radius = 0.05;
    scene.camera.focal_distance = 5.0;
    let end = look([2.5, 2.0, -4.0], [0.3, 0.7, 0.2], 45.0);
    scene.camera.motion = motion(end.to_world);
    assert_is_mean_over_times("camera", &scene);
}

/// Something of everything that moves.
fn moving() -> Scene {
    let mut scene = floor();
    let red = material(&mut scene, coloured(0.9, 0.2, 0.1));
    let mut ball = sphere(0.6, [-1.0, 0.9, 0.0], red);
    ball.motion = motion(moved(1.0, 0.9, 0.0));
    let mut pane = square(&mut scene, 0.9, moved(0.0, 1.5, -1.0), red);
    pane.alpha = FloatParam::Value(0.5);
    pane.motion = motion(moved(0.0, 1.0, -1.0) * DMat4::from_rotation_y(1.0));
    scene.shapes.extend([ball, pane]);
    scene.camera.motion = motion(moved(0.5, 0.0, 0.0) * scene.camera.to_world);
    scene
}

#[test]
fn threads_and_passes_do_not_change_a_bit() {
    let scene = moving();
    let run = |threads: usize, passes: &[u32]| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().expect("threads are to be had").install(|| {
            let options = RenderOptions::default();
            let prepared = PreparedScene::new(&scene, &options).expect("the scene is sound");
            let mut renderer = Renderer::new(&prepared, options);
            for &samples in passes {
                renderer.render_pass(samples, &AtomicBool::new(false));
            }
            renderer.film().picture()
        })
    };
    let reference = run(1, &[8]);
    for (threads, passes) in [(2, &[8][..]), (3, &[1, 2, 5])] {
        assert_eq!(run(threads, passes), reference);
    }
}

#[test]
fn what_paths_of_other_times_cannot_give_is_refused_and_devices_know() {
    let options = RenderOptions {
        share_paths: 4,
        ..RenderOptions::default()
    };
    let scene = moving();
    let error = PreparedScene::new(&scene, &options).unwrap_err();
    assert_eq!(error, PrepareError::SharedMotion);
    assert!(error.to_string().contains("--share-paths"), "{error}");
    PreparedScene::new(&still(&scene, 0.0), &options).unwrap();

    let alone = RenderOptions::default();
    let mut prepared = PreparedScene::new(&scene, &alone).unwrap();
    assert_eq!(prepared.flatten().missing, ["motion blur"]);
    // A camera that moves is one that devices do not know, too.
    let stopped = still(&scene, 0.0);
    let mut only_camera = stopped.clone();
    only_camera.camera.motion = scene.camera.motion;
    let mut looked = PreparedScene::new(&stopped, &alone).unwrap();
    assert_eq!(looked.flatten().missing, [""; 0]);
    looked
        .look(&only_camera.camera, &only_camera.film, &alone)
        .unwrap();
    assert_eq!(looked.flatten().missing, ["motion blur"]);
    assert_eq!(
        looked.look(&only_camera.camera, &only_camera.film, &options),
        Err(PrepareError::SharedMotion)
    );
    // The shapes still move under a camera that does not.
    prepared
        .look(&stopped.camera, &stopped.film, &alone)
        .unwrap();
    assert_eq!(prepared.flatten().missing, ["motion blur"]);
}
