//! Whether rays are traversed or cast by queries where that is automatic, with both schedules.

use std::sync::atomic::AtomicBool;

use specula_gpu::{AdapterKind, Rays, Schedule, Tracer, TracerError, TracerOptions};
use specula_render::{PreparedScene, RenderOptions, Renderer};

use crate::common::gpu;
use crate::offered::gpu_with_queries;
use crate::scenes::{closed, instances, loaded, prepared};

fn by(rays: Rays) -> TracerOptions {
    TracerOptions {
        rays,
        ..TracerOptions::default()
    }
}

#[test]
fn auto_takes_queries_on_a_real_gpu_only() {
    let Some(gpu) = gpu("the choice of rays") else {
        return;
    };
    let scene = loaded(&closed(""));
    let options = RenderOptions::from_scene(&scene);
    let prepared = prepared(&closed(""));
    let used = |rays| {
        let tracer = Tracer::with_options(gpu, &prepared, &options, by(rays));
        tracer.map(|tracer| tracer.uses_ray_queries())
    };
    assert_eq!(used(Rays::Tree), Ok(false));
    let real = gpu.adapter.kind != AdapterKind::Software;
    assert_eq!(used(Rays::Auto), Ok(gpu.has_ray_queries() && real));
    assert_eq!(gpu.has_ray_queries(), gpu.adapter.ray_queries);
    match used(Rays::Query) {
        Ok(queries) => assert!(queries && gpu.has_ray_queries()),
        Err(TracerError::Queries(reason)) => {
            assert!(!gpu.has_ray_queries(), "{reason}");
            assert!(reason.contains(&gpu.adapter.name), "{reason}");
        }
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn scenes_that_queries_do_not_take_go_through_the_tree() {
    let Some(gpu) = gpu_with_queries("scenes beyond ray queries") else {
        return;
    };
    let text = closed("Scale 1e-13 1e-13 1e-13\n");
    let scene = loaded(&text);
    let options = RenderOptions::from_scene(&scene);
    let prepared = prepared(&text);
    let tracer = |rays| Tracer::with_options(gpu, &prepared, &options, by(rays));
    assert!(matches!(tracer(Rays::Query), Err(TracerError::Queries(_))));
    assert!(!tracer(Rays::Auto).unwrap().uses_ray_queries());
}

#[test]
fn both_schedules_take_the_same_samples_by_queries() {
    let Some(gpu) = gpu_with_queries("schedules, by ray queries") else {
        return;
    };
    let sky = "LightSource \"infinite\" \"rgb L\" [0.4 0.5 0.6]";
    // Seen from above.
    let place = "Translate 0 0 4 Rotate 180 1 0 0";
    let text = format!("{sky}\n{place}\n{}", instances(1.0));
    let options = RenderOptions {
        resolution: Some([20, 16]),
        max_depth: 6,
        ..RenderOptions::from_scene(&loaded(&text))
    };
    let prepared = PreparedScene::new(&loaded(&text), &options).unwrap();
    let [paths, queues] = [Schedule::Paths, Schedule::Queues].map(|schedule| {
        let rays = Rays::Query;
        let on_gpu = TracerOptions { rays, schedule };
        let tracer = Tracer::with_options(gpu, &prepared, &options, on_gpu);
        let mut tracer = tracer.unwrap_or_else(|e| panic!("{e}"));
        assert!(tracer.uses_ray_queries());
        let mut renderer = Renderer::new(&prepared, options.clone());
        let go = AtomicBool::new(false);
        let report = tracer.render_pass(&mut renderer, 4, &go).unwrap();
        assert_eq!((report.invalid_samples, report.complete), (0, true));
        (renderer.film().clone(), report.rays)
    });
    let mut processor = Renderer::new(&prepared, options.clone());
    let rays = processor.render_pass(4, &AtomicBool::new(false)).rays;
    assert!(rays > 20 * 16 * 4 * 2, "{rays} rays: paths do not go on");
    assert!(rays.abs_diff(paths.1) < rays / 50, "{rays}, {}", paths.1);
    assert_eq!(paths.1, queues.1);
    assert!(paths.0 == queues.0, "schedules give different pictures");
}
