//! Films do not depend on batches, passes or schedules, not by a single bit; planted faults show.

use specula_bsdf::Rgb;
use specula_render::FilmBuffer;
use specula_scene::Scene;
use specula_scene::scene::{Interpolation, Light};

use super::*;
use crate::adapter::AdapterChoice;
use crate::common;

mod memory;
#[path = "../../tests/common/painted.rs"]
mod painted;

/// A closed bright room, so that paths are long, with glass in it.
fn room() -> Scene {
    room_with("")
}

/// The same with glass that absorbs, and a pane with a hole.
fn room_of_coloured_glass() -> Scene {
    room_with(
        "MakeNamedMedium \"red\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.1 2 3] \"rgb sigma_s\" [0 0 0]\n\
        AttributeBegin\nMediumInterface \"red\" \"\"\nTranslate 0.9 -0.6 0\n\
        Shape \"sphere\" \"float radius\" 0.4\nAttributeEnd\n\
        Shape \"trianglemesh\" \"point3 P\" [-1 -1 -1  1 -1 -1  1 -1 1] \"integer indices\" [0 1 2] \"float alpha\" 0.5\n",
    )
}

/// The room with a picture on its wall, filtered over footprints, and nothing in it.
fn room_of_stripes() -> Scene {
    painted::painted(room_around(""), Interpolation::Trilinear)
}

/// * `shapes`: more of them, of rough glass.
fn room_with(shapes: &str) -> Scene {
    room_around(&format!(
        "Material \"dielectric\" \"float eta\" 1.5 \"float roughness\" 0.2\n\
        Shape \"sphere\" \"float radius\" 0.6\n{shapes}"
    ))
}

/// * `shapes`: what is in it.
fn room_around(shapes: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.pbrt");
    let text = format!(
        "LookAt 0 -1.8 0  0 0 0  0 0 1\n\
        Camera \"perspective\" \"float fov\" 60\n\
        Film \"rgb\" \"integer xresolution\" 17 \"integer yresolution\" 3\n\
        Integrator \"volpath\" \"integer maxdepth\" 40\nWorldBegin\n\
        LightSource \"point\" \"point3 from\" [0.5 -1 1] \"rgb I\" [2 3 4]\n\
        Material \"diffuse\" \"rgb reflectance\" [0.95 0.9 0.85]\n\
        Shape \"sphere\" \"float radius\" 2\n{shapes}"
    );
    std::fs::write(&file, text).unwrap();
    specula_scene::load(&file).unwrap().scene
}

/// A render by shaders whose text is changed.
struct Render<'a> {
    prepared: &'a PreparedScene,
    options: RenderOptions,
    tracer: Tracer<'a>,
}

impl<'a> Render<'a> {
    fn new(
        gpu: &'a Gpu,
        prepared: &'a PreparedScene,
        options: &RenderOptions,
        schedule: Schedule,
        change: impl Fn(&str) -> String,
    ) -> Self {
        let program = SceneProgram::new(prepared, options).unwrap();
        let text = change(&program.text().unwrap());
        let texts = [text.as_str(), program::SUMS];
        Self {
            prepared,
            options: options.clone(),
            tracer: Tracer::of_texts(gpu, &program, options, (schedule, None), texts).unwrap(),
        }
    }

    /// The film after these passes; where a noise is asked for, after as many as it takes.
    ///
    /// * `first_sample`: the index of the first sample of a pixel.
    /// * `largest`: most samples of a batch.
    fn film(&mut self, first_sample: u32, largest: usize, passes: &[u32]) -> FilmBuffer {
        let options = RenderOptions {
            first_sample,
            ..self.options.clone()
        };
        self.tracer.largest = largest;
        self.tracer.samples = FIRST_BATCH.min(largest);
        let mut renderer = Renderer::new(self.prepared, options);
        let mut passes = passes.iter().copied();
        loop {
            let noise = self.options.noise;
            let needed = noise.and_then(|_| renderer.samples_done());
            let Some(samples) = passes.next().or(needed.map(|_| 1 << 16)) else {
                return renderer.film().clone();
            };
            let go = AtomicBool::new(false);
            let report = self.tracer.render_pass(&mut renderer, samples, &go);
            assert!(report.unwrap().complete);
        }
    }
}

#[test]
fn films_are_the_same_however_samples_are_cut() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let options = RenderOptions::from_scene(&room());
    let prepared = PreparedScene::new(&room(), &options).unwrap();
    let render = |schedule| Render::new(gpu, &prepared, &options, schedule, str::to_owned);
    let mut paths = render(Schedule::Paths);
    let whole = paths.film(0, LARGEST_BATCH, &[70]);
    let lit = whole.picture();
    assert!(lit.colour.iter().all(|c| c.g > 0.0), "a lit room");
    assert!(paths.film(0, 1 << 10, &[70]) == whole, "batches");
    assert!(paths.film(0, 200, &[1, 2, 67]) == whole, "passes");
    let mut merged = paths.film(41, LARGEST_BATCH, &[29]);
    merged.merge(&paths.film(0, LARGEST_BATCH, &[41])).unwrap();
    assert!(merged.picture() == lit, "parts");
    let mut queues = render(Schedule::Queues);
    assert!(queues.film(0, LARGEST_BATCH, &[70]) == whole, "queues");
    assert!(queues.film(0, 1 << 10, &[33, 37]) == whole, "queues, cut");
}

#[test]
fn queues_take_paths_through_media_and_holes() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let options = RenderOptions::from_scene(&room_of_coloured_glass());
    let prepared = PreparedScene::new(&room_of_coloured_glass(), &options).unwrap();
    let constant = |name| prepared.flatten().constant(name);
    assert_eq!(
        ["HAS_BOUNDARIES", "HAS_PASSABLE"].map(constant),
        [Some(1); 2]
    );
    let film = |schedule| {
        let mut render = Render::new(gpu, &prepared, &options, schedule, str::to_owned);
        render.film(0, LARGEST_BATCH, &[16])
    };
    assert!(film(Schedule::Queues) == film(Schedule::Paths));
}

/// Cones are part of a path's state.
#[test]
fn queues_take_paths_through_filtered_textures() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let options = RenderOptions::from_scene(&room_of_stripes());
    let prepared = PreparedScene::new(&room_of_stripes(), &options).unwrap();
    let film = |schedule, change: &dyn Fn(&str) -> String| {
        let mut render = Render::new(gpu, &prepared, &options, schedule, change);
        render.film(0, LARGEST_BATCH, &[16])
    };
    let right = film(Schedule::Paths, &str::to_owned);
    assert!(film(Schedule::Queues, &str::to_owned) == right);
    let from = "queue_state_write(slot, QUEUE_CONE, vec3f(state.cone, 0.0), 0u);";
    let wrong = film(Schedule::Queues, &|text| {
        assert!(text.contains(from));
        text.replace(from, "")
    });
    assert!(wrong != right, "cones that are lost");
}

#[test]
fn adaptive_films_are_the_same_however_samples_are_cut() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let options = RenderOptions {
        noise: Some(0.1),
        samples_per_pixel: 1 << 12,
        ..RenderOptions::from_scene(&room())
    };
    let prepared = PreparedScene::new(&room(), &options).unwrap();
    let mut render = Render::new(gpu, &prepared, &options, Schedule::Auto, str::to_owned);
    let whole = render.film(0, LARGEST_BATCH, &[]);
    assert!(whole.is_adaptive() && whole.most_and_mean_samples().0 > 32);
    assert!(render.film(0, 300, &[20, 33, 2]) == whole);
}

#[test]
fn faults_of_queues_show_in_films() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let options = RenderOptions {
        max_depth: 6,
        ..RenderOptions::from_scene(&room())
    };
    let prepared = PreparedScene::new(&room(), &options).unwrap();
    let film = |schedule, change: &dyn Fn(&str) -> String| {
        Render::new(gpu, &prepared, &options, schedule, change).film(0, LARGEST_BATCH, &[3])
    };
    let right = film(Schedule::Paths, &str::to_owned);
    let text = include_str!("../../wgsl/queue.wgsl");
    for (from, to) in [
        // A path that is not followed.
        (
            "return queue_slots[queue_entry(place)];",
            "let slot = queue_slots[queue_entry(place)];
            return select(slot, NONE, slot == 50u && queue_slots[0] > 0u);",
        ),
        // A path with the state of its neighbour.
        (
            "var state = queue_state_to_shade(slot);",
            "var state = queue_state_to_shade(slot ^ 1u);",
        ),
        // A path with the shadow ray of its neighbour.
        (
            "path_connect(&state, queue_state_shadow(slot),",
            "path_connect(&state, queue_state_shadow(slot ^ 1u),",
        ),
        // A shadow ray that is lost where the path ends.
        (
            "if (state.flags & PATH_ENDS) != 0u && all(shadow.contribution == vec3f(0.0)) {",
            "if (state.flags & PATH_ENDS) != 0u {",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let wrong = film(Schedule::Queues, &|text| text.replace(from, to));
        assert!(wrong != right, "{to}");
    }
}

#[test]
fn samples_that_are_not_finite_are_counted_and_named() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let mut scene = room();
    scene.lights.clear();
    for i in 0..64 {
        scene.lights.push(Light::Point {
            position: [0.0, -1.0, 1.0 + 0.01 * f64::from(i)],
            intensity: Rgb::splat(2e37),
        });
    }
    let options = RenderOptions::from_scene(&scene);
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let mut renderer = Renderer::new(&prepared, options.clone());
    let mut tracer = Tracer::new(gpu, &prepared, &options).unwrap();
    let go = AtomicBool::new(false);
    let report = tracer.render_pass(&mut renderer, 8, &go).unwrap();
    assert!(report.invalid_samples > 0, "nothing overflows");
    let one = report.invalid.unwrap();
    assert!(one.sample < 8 && one.material.is_some(), "{one:?}");
    let picture = renderer.film().picture();
    let finite = |c: &Rgb<f32>| c.is_finite();
    assert!(picture.colour.iter().all(finite));
    // The processor has the same ones, but for paths that round otherwise.
    let mut processor = Renderer::new(&prepared, options);
    let there = processor.render_pass(8, &go).invalid_samples;
    assert!(
        there.abs_diff(report.invalid_samples) <= 1 + there / 20,
        "{there}, {}",
        report.invalid_samples
    );
}

/// A device that goes away in the midst of a render is an error, and earlier samples stay in the film.
#[test]
fn a_lost_device_is_an_error_and_the_film_stays() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let options = RenderOptions::from_scene(&room());
    let prepared = PreparedScene::new(&room(), &options).unwrap();
    for schedule in [Schedule::Paths, Schedule::Queues] {
        let Ok(gpu) = Gpu::open(&AdapterChoice::Name(gpu.adapter.name.clone())) else {
            continue;
        };
        let mut render = Render::new(&gpu, &prepared, &options, schedule, str::to_owned);
        let mut renderer = Renderer::new(&prepared, options.clone());
        let go = AtomicBool::new(false);
        render.tracer.render_pass(&mut renderer, 2, &go).unwrap();
        let before = renderer.film().clone();
        gpu.device.destroy();
        let error = render
            .tracer
            .render_pass(&mut renderer, 2, &go)
            .unwrap_err();
        assert!(matches!(error, GpuError::Lost(_)), "{schedule}: {error:?}");
        assert!(*renderer.film() == before, "{schedule}");
    }
}

/// A shader that does not compile is an error with its name, and the device goes on.
#[test]
fn shaders_that_do_not_compile_are_errors() {
    let Some(gpu) = common::gpu("the tracer") else {
        return;
    };
    let options = RenderOptions::from_scene(&room());
    let prepared = PreparedScene::new(&room(), &options).unwrap();
    let program = SceneProgram::new(&prepared, &options).unwrap();
    let right = program.text().unwrap();
    let wrong = right.replace("fn path_shade(", "fn path_stop(");
    assert!(wrong != right);
    let tracer = |texts| {
        let how = (Schedule::Queues, None);
        Tracer::of_texts(gpu, &program, &options, how, texts)
    };
    for (texts, name) in [
        ([wrong.as_str(), program::SUMS], "path tracer"),
        ([right.as_str(), "fn sums_main() {}"], "sums_main"),
    ] {
        let error = tracer(texts).unwrap_err();
        let TracerError::Gpu(GpuError::Shader { label, text }) = &error else {
            panic!("{error:?}");
        };
        assert_eq!(label, name, "{text}");
    }
    assert!(tracer([right.as_str(), program::SUMS]).is_ok());
}

#[test]
fn states_have_the_size_that_shaders_give_them() {
    for scene in [room(), room_of_coloured_glass(), room_of_stripes()] {
        let options = RenderOptions::from_scene(&scene);
        let prepared = PreparedScene::new(&scene, &options).unwrap();
        let program = SceneProgram::new(&prepared, &options).unwrap();
        let text = program.text().unwrap();
        let module = wgpu::naga::front::wgsl::parse_str(&text).unwrap();
        let mut constants = module.constants.iter().map(|(_, one)| one);
        let fields = constants.find(|one| one.name.as_deref() == Some("QUEUE_FIELDS"));
        let value = fields.map(|one| &module.global_expressions[one.init]);
        let Some(wgpu::naga::Expression::Literal(wgpu::naga::Literal::U32(fields))) = value else {
            panic!("{value:?}");
        };
        assert_eq!(
            u64::from(*fields) * 16,
            crate::path_kernels::state_size(&program.flat)
        );
    }
}

/// A page takes the samples of the tracer's own text, by nothing that WebGPU lacks.
#[test]
fn the_program_of_a_scene_is_that_of_the_tracer_and_plain() {
    use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
    for scene in [
        room(),
        room_of_coloured_glass(),
        room_of_stripes(),
        specula_scene::builtin::orbs(),
    ] {
        let options = RenderOptions::from_scene(&scene);
        let prepared = PreparedScene::new(&scene, &options).unwrap();
        let program = SceneProgram::new(&prepared, &options).unwrap();
        let text = program.text().unwrap();
        assert!(
            text.lines().all(|l| !l.starts_with("enable ")),
            "an extension"
        );
        let module = wgpu::naga::front::wgsl::parse_str(&text).unwrap();
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator.validate(&module).unwrap();
        let entries = &module.entry_points;
        let place = entries.iter().position(|e| e.name == SceneProgram::ENTRY);
        let place = place.unwrap();
        let threads = [u32::try_from(crate::stage::WORKGROUP).unwrap(), 1, 1];
        assert_eq!(entries[place].workgroup_size, threads);
        let uses = info.get_entry_point(place);
        let used = module
            .global_variables
            .iter()
            .filter(|(v, _)| !uses[*v].is_empty());
        let mut bindings: Vec<u32> = used
            .filter_map(|(_, v)| v.binding.map(|b| b.binding))
            .collect();
        bindings.sort_unstable();
        assert!(
            bindings.iter().all(|&b| b < 6) && bindings.ends_with(&[4, 5]),
            "{bindings:?}"
        );
        assert_eq!(program.settings(), program::settings(&options));
        assert_eq!(u64::from(SceneProgram::WORKGROUP), u64::from(threads[0]));
    }
}
