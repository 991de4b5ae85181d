//! The same picture for any number of threads, any split into passes, any crop.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use glam::{DMat4, DVec3};
use specula_render::picture::Picture;
use specula_render::{FilmBuffer, MergeError, PreparedScene, RenderOptions, Renderer, ResumeError};
use specula_scene::scene::*;

fn scene() -> Scene {
    let mut scene = empty(look([0.0, -4.0, 2.0], [0.0; 3], 50.0), 40);
    let floor = material(&mut scene, diffuse(0.6));
    let metal = material(&mut scene, mirror_metal(0.3));
    let pane = material(&mut scene, glass(0.0));
    let mixed = MaterialKind::Mix {
        materials: [metal, floor],
        amount: FloatParam::Value(0.4),
    };
    let mixed = material(&mut scene, mixed);
    let ground = square(&mut scene, 10.0, DMat4::IDENTITY, floor);
    scene.shapes.push(ground);
    scene.shapes.push(sphere(0.7, [-1.0, 0.0, 0.7], mixed));
    let mut veil = sphere(0.7, [1.0, 0.0, 0.7], pane);
    veil.alpha = FloatParam::Value(0.5);
    scene.shapes.push(veil);
    scene
        .shapes
        .push(emitting(sphere(0.3, [0.0, 0.0, 3.0], floor), 5.0));
    scene.lights.push(constant_sky(0.2));
    scene.film.filter = Filter::Gaussian {
        radius: [1.5; 2],
        sigma: 0.5,
    };
    scene
}

fn run(scene: &Scene, threads: usize, passes: &[u32], crop: Option<[u32; 4]>) -> Picture {
    let options = RenderOptions {
        crop,
        max_depth: 6,
        ..RenderOptions::default()
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads are to be had");
    pool.install(|| {
        let prepared = PreparedScene::new(scene, &options).expect("the scene is sound");
        let mut renderer = Renderer::new(&prepared, options);
        let go = AtomicBool::new(false);
        for &samples in passes {
            assert_eq!(renderer.render_pass(samples, &go).invalid_samples, 0);
        }
        renderer.film().picture()
    })
}

#[test]
fn threads_and_passes_do_not_change_a_bit() {
    let scene = scene();
    let reference = run(&scene, 1, &[8], None);
    for (threads, passes) in [(2, &[8][..]), (3, &[1, 2, 5]), (2, &[7, 1])] {
        assert_eq!(run(&scene, threads, passes, None), reference);
    }
    assert_ne!(run(&scene, 1, &[7], None).colour, reference.colour);
}

/// Goes on with a film until `noise`, at most the work of 512 samples per pixel, resumed after every pass
/// of `samples`.
fn adaptive(
    scene: &Scene,
    noise: f32,
    samples: u32,
    threads: usize,
    film: &mut Option<FilmBuffer>,
) {
    let options = RenderOptions {
        max_depth: 6,
        noise: Some(noise),
        samples_per_pixel: 512,
        ..RenderOptions::default()
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads are to be had");
    pool.install(|| {
        let prepared = PreparedScene::new(scene, &options).expect("the scene is sound");
        loop {
            let mut renderer = match film.take() {
                Some(film) => Renderer::resume(&prepared, options.clone(), film)
                    .expect("the film is of this render"),
                None => Renderer::new(&prepared, options.clone()),
            };
            let is_done = renderer.samples_done().is_none();
            if !is_done {
                renderer.render_pass(samples, &AtomicBool::new(false));
            }
            *film = Some(renderer.film().clone());
            if is_done {
                break;
            }
        }
    });
}

/// By threads, passes and interruptions after every pass, and by way of a larger noise.
#[test]
fn adaptive_renders_are_the_same_bit_for_bit_however_they_are_made() {
    let scene = scene();
    let mut whole = None;
    adaptive(&scene, 0.035, 512, 1, &mut whole);
    let counts = whole.as_ref().unwrap().picture().sample_count;
    let (fewest, most) = counts
        .iter()
        .fold((f32::MAX, 0.0), |(a, b): (f32, f32), c| {
            (a.min(*c), b.max(*c))
        });
    assert!(fewest >= 32.0 && most >= 2.0 * fewest, "{fewest} to {most}");
    for (threads, samples) in [(2, 1), (3, 7), (2, 100)] {
        let mut film = None;
        adaptive(&scene, 0.035, samples, threads, &mut film);
        assert!(
            film == whole,
            "{threads} threads, {samples} samples in a pass"
        );
    }
    let mut film = None;
    adaptive(&scene, 0.1, 64, 2, &mut film);
    assert!(film != whole);
    adaptive(&scene, 0.035, 64, 2, &mut film);
    assert!(film == whole, "by way of a larger noise");
}

/// Stopping by what has been seen must not make the picture darker.
#[test]
fn adaptive_renders_keep_the_mean() {
    let scene = scene();
    let mut film = None;
    adaptive(&scene, 0.06, 512, 2, &mut film);
    let (found, error) = mean(&film.unwrap().picture());
    let (expected, other) = mean(&run(&scene, 2, &[512], None));
    let apart = (found - expected).abs();
    assert!(apart < 4.5 * error.hypot(other), "{found} {expected}");
    assert!(apart < 0.005 * expected, "{found} {expected}");
}

/// Rounds of adaptive sampling in three shares each, as machines of a farm take them.
fn in_shares(scene: &Scene, aim: &RenderOptions) -> FilmBuffer {
    let prepared = PreparedScene::new(scene, aim).expect("the scene is sound");
    let mut base: Option<FilmBuffer> = None;
    loop {
        let shares = [[2, 3, 3], [0, 1, 3], [1, 2, 3]].map(|share| {
            let options = RenderOptions {
                round_share: Some(share),
                ..aim.clone()
            };
            let mut renderer = match base.clone() {
                None => Renderer::new(&prepared, options),
                Some(film) => {
                    Renderer::resume(&prepared, options, film).expect("the film is of this render")
                }
            };
            while renderer.samples_done().is_some() {
                renderer.render_pass(8, &AtomicBool::new(false));
            }
            renderer.into_film()
        });
        let [mut whole, second, third] = shares;
        whole.merge(&second).expect("shares of one round");
        whole.merge(&third).expect("shares of one round");
        if let Some(before) = &base {
            // What came before is in it.
            let same = whole.clone();
            whole.merge(before).expect("shares of one round");
            assert!(whole == same);
        }
        if base.as_ref() == Some(&whole) {
            return whole;
        }
        base = Some(whole);
    }
}

#[test]
fn rounds_in_shares_are_those_of_one_render() {
    let scene = scene();
    for noise in [0.06, 0.035] {
        let aim = RenderOptions {
            max_depth: 6,
            noise: Some(noise),
            samples_per_pixel: 512,
            ..RenderOptions::default()
        };
        let mut whole = None;
        adaptive(&scene, noise, 512, 2, &mut whole);
        assert!(whole == Some(in_shares(&scene, &aim)), "{noise}");
    }
}

#[test]
fn adaptive_films_that_are_no_shares_are_not_merged() {
    let scene = scene();
    let prepared = PreparedScene::new(&scene, &RenderOptions::default()).unwrap();
    let film = |options: &RenderOptions| {
        let mut renderer = Renderer::new(&prepared, options.clone());
        renderer.render_pass(32, &AtomicBool::new(false));
        renderer.into_film()
    };
    let asked = |samples_per_pixel| RenderOptions {
        noise: Some(0.0),
        samples_per_pixel,
        ..RenderOptions::default()
    };
    let (even, some) = (film(&RenderOptions::default()), film(&asked(16)));
    for (a, b) in [(&even, &some), (&some, &even)] {
        assert_eq!(a.clone().merge(b), Err(MergeError::Adaptive));
    }
}

#[test]
fn adaptive_and_even_films_are_not_mixed() {
    let scene = scene();
    let even = RenderOptions::default();
    let asked = RenderOptions {
        noise: Some(0.1),
        ..even.clone()
    };
    let prepared = PreparedScene::new(&scene, &even).unwrap();
    for (made, resumed) in [(&even, &asked), (&asked, &even)] {
        let mut renderer = Renderer::new(&prepared, made.clone());
        for samples in [32, 1] {
            renderer.render_pass(samples, &AtomicBool::new(false));
        }
        let film = renderer.film().clone();
        assert!(Renderer::resume(&prepared, made.clone(), film.clone()).is_ok());
        let error = Renderer::resume(&prepared, resumed.clone(), film).err();
        assert_eq!(error, Some(ResumeError::Adaptive));
    }
}

#[test]
fn a_crop_is_a_window_of_the_whole() {
    let scene = scene();
    let whole = run(&scene, 2, &[2], None);
    let window = run(&scene, 2, &[2], Some([3, 21, 10, 30]));
    assert_eq!(
        (window.width, window.height, window.offset),
        (18, 20, [3, 10])
    );
    for y in 0..20 {
        for x in 0..18 {
            assert_eq!(
                window.colour[y * 18 + x],
                whole.colour[(y + 10) * 40 + x + 3]
            );
        }
    }
}

#[test]
fn a_stopped_pass_leaves_a_film_that_the_next_pass_completes() {
    let scene = scene();
    let options = RenderOptions {
        max_depth: 6,
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let mut renderer = Renderer::new(&prepared, options);
    let report = renderer.render_pass(4, &AtomicBool::new(true));
    assert!(!report.complete && report.samples_done_total == 0);

    let stop = AtomicBool::new(false);
    std::thread::scope(|s| {
        s.spawn(|| {
            std::thread::sleep(std::time::Duration::from_millis(5));
            stop.store(true, std::sync::atomic::Ordering::Relaxed);
        });
        renderer.render_pass(8, &stop);
    });
    let go = AtomicBool::new(false);
    let done = renderer.film().complete_samples();
    let report = renderer.render_pass(8 - done, &go);
    assert!(report.complete && report.samples_done_total == 8);
    assert_eq!(renderer.film().picture(), run(&scene, 1, &[8], None));
}

#[test]
fn impossible_pictures_are_refused() {
    let scene = scene();
    for options in [
        RenderOptions {
            resolution: Some([0, 10]),
            ..RenderOptions::default()
        },
        RenderOptions {
            crop: Some([10, 10, 0, 5]),
            ..RenderOptions::default()
        },
        RenderOptions {
            crop: Some([50, 60, 0, 5]),
            ..RenderOptions::default()
        },
    ] {
        assert!(PreparedScene::new(&scene, &options).is_err());
    }
}

#[test]
fn an_empty_scene_is_its_sky_and_half_a_veil_is_half_seen() {
    let mut sky = empty(look([0.0; 3], [0.0, 0.0, 1.0], 60.0), 8);
    sky.lights.push(constant_sky(0.75));
    assert!(run(&sky, 1, &[1], None).colour.iter().all(|c| c.g == 0.75));

    let m = material(&mut sky, diffuse(0.0));
    let place = DMat4::from_translation(DVec3::new(0.0, 0.0, 2.0));
    let mut veil = square(&mut sky, 10.0, place, m);
    veil.alpha = FloatParam::Value(0.5);
    sky.shapes.push(veil);
    assert_mean("veil", &run(&sky, 1, &[4096], None), 0.375, 0.0);
}

/// Every one of very many emitting triangles is a light, and a hit knows its light at once.
#[test]
fn two_hundred_thousand_lights_are_no_obstacle() {
    let mut scene = empty(look([0.0, 0.0, 1.0], [0.0, 0.1, 0.0], 60.0), 8);
    let m = material(&mut scene, diffuse(0.5));
    let ground = square(&mut scene, 100.0, DMat4::IDENTITY, m);
    scene.shapes.push(ground);
    // A ceiling of 316 x 316 squares, 10 wide in all, its outside down.
    let n = 316_u32;
    let at = |i: u32| (i as f32 / n as f32 - 0.5) * 40.0;
    let mut mesh = Mesh::default();
    for j in 0..=n {
        for i in 0..=n {
            mesh.positions.push([at(i), at(j), 2.0]);
        }
    }
    for j in 0..n {
        for i in 0..n {
            let a = j * (n + 1) + i;
            let (b, c, d) = (a + 1, a + n + 1, a + n + 2);
            mesh.triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    scene.meshes.push(mesh);
    let ceiling = shape(Geometry::Mesh(MeshId(1)), DMat4::IDENTITY, m);
    scene.shapes.push(emitting(ceiling, 1.0));
    let options = RenderOptions::default();
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    assert_eq!(prepared.light_count(), 99_856);
    let a = render(&scene, 1024, 1, specula_render::Strategy::Mis);
    let b = render(&scene, 1024, 1, specula_render::Strategy::BsdfOnly);
    let ((ma, ea), (mb, eb)) = (mean(&a), mean(&b));
    assert!(
        (ma - mb).abs() < 4.5 * (ea * ea + eb * eb).sqrt(),
        "{ma} {mb}"
    );
    assert!(ea < 0.01 * ma && eb < 0.01 * mb);
}
