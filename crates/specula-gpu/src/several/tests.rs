//! Films of several GPUs are those of one; tiles go by shares; who fails is left out.

use std::convert::Infallible;

use specula_render::FilmBuffer;
use specula_scene::Scene;

use super::*;
use crate::adapter::AdapterChoice;
use crate::common;

/// A lit room of 10 tiles.
fn room() -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.pbrt");
    let text = "LookAt 0 -1.8 0  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 60\n\
        Film \"rgb\" \"integer xresolution\" 80 \"integer yresolution\" 32\n\
        Integrator \"volpath\" \"integer maxdepth\" 5\nWorldBegin\n\
        LightSource \"point\" \"point3 from\" [0.5 -1 1] \"rgb I\" [2 3 4]\n\
        Material \"diffuse\" \"rgb reflectance\" [0.9 0.7 0.5]\nShape \"sphere\" \"float radius\" 2\n\
        Material \"conductor\" \"float roughness\" 0.3\nShape \"sphere\" \"float radius\" 0.6\n";
    std::fs::write(&file, text).unwrap();
    specula_scene::load(&file).unwrap().scene
}

fn prepared() -> (PreparedScene, RenderOptions) {
    let options = RenderOptions::from_scene(&room());
    (PreparedScene::new(&room(), &options).unwrap(), options)
}

/// Two devices of the adapter of the tests.
fn twins(what: &str) -> Option<[Gpu; 2]> {
    let index = common::gpu(what)?.adapter.index;
    Some([0, 1].map(|_| Gpu::open(&AdapterChoice::Index(index)).unwrap()))
}

fn tracers<'a>(gpus: &'a [Gpu], (scene, options): &(PreparedScene, RenderOptions)) -> Tracers<'a> {
    let tracers = Tracers::new(gpus, scene, options, TracerOptions::default());
    tracers.unwrap_or_else(|(place, error)| panic!("{place}: {error}"))
}

/// The film after passes.
fn film(
    tracers: &mut Tracers<'_>,
    (scene, options): &(PreparedScene, RenderOptions),
    passes: &[u32],
) -> FilmBuffer {
    let mut renderer = Renderer::new(scene, options.clone());
    for samples in passes {
        let report = tracers.render_pass(&mut renderer, *samples, &AtomicBool::new(false));
        assert!(report.unwrap().complete);
    }
    renderer.film().clone()
}

#[test]
fn two_gpus_make_the_film_of_one() {
    let Some(gpus) = twins("two GPUs") else {
        return;
    };
    let scene = prepared();
    let alone = film(&mut tracers(&gpus[..1], &scene), &scene, &[5]);
    assert!(
        alone.picture().colour.iter().all(|c| c.g > 0.0),
        "a lit room"
    );
    let mut both = tracers(&gpus, &scene);
    assert!(film(&mut both, &scene, &[1, 4]) == alone);
    let rates = both.members().iter().map(Tracer::rate);
    assert!(rates.flatten().count() == 2, "both take samples");
    assert!(both.lost().is_empty());
}

#[test]
fn others_go_on_without_a_gpu_that_fails() {
    let Some(gpus) = twins("a GPU that fails") else {
        return;
    };
    let scene = prepared();
    let alone = film(&mut tracers(&gpus[..1], &scene), &scene, &[6]);
    let mut both = tracers(&gpus, &scene);
    let mut renderer = Renderer::new(&scene.0, scene.1.clone());
    let go = AtomicBool::new(false);
    both.render_pass(&mut renderer, 2, &go).unwrap();
    gpus[1].device.destroy();
    both.render_pass(&mut renderer, 4, &go).unwrap();
    assert!(
        *renderer.film() == alone,
        "no sample is lost or taken twice"
    );
    let lost = both.lost();
    assert!(
        lost.len() == 1 && matches!(lost[0].error, GpuError::Lost(_)),
        "{lost:?}"
    );
    assert!(both.lost().is_empty() && both.members().len() == 1);
    gpus[0].device.destroy();
    assert!(
        both.render_pass(&mut renderer, 1, &go).is_err(),
        "the last one"
    );
    assert!(*renderer.film() == alone);
}

/// Keeps what it is asked for, and takes nothing.
struct Asked(Vec<Wanted>);

impl SampleDevice for Asked {
    type Error = Infallible;

    fn most(&self) -> Most {
        Most {
            samples: usize::MAX,
            runs: usize::MAX,
        }
    }

    fn begin(&mut self, wanted: &[Wanted]) -> Result<(), Infallible> {
        self.0.extend_from_slice(wanted);
        Ok(())
    }

    fn finish(&mut self) -> Result<&[RunSums], Infallible> {
        Ok(&[])
    }
}

#[test]
fn tiles_go_by_shares() {
    let (scene, options) = prepared();
    let mut asked = Asked(Vec::new());
    let stop = AtomicBool::new(false);
    let Ok(_) = Renderer::new(&scene, options).render_pass_with(3, &stop, &mut asked);
    let wanted = asked.0;
    let tiles = |shares: &[f64]| {
        parts(&wanted, shares)
            .iter()
            .map(|p| p.len())
            .collect::<Vec<_>>()
    };
    assert_eq!(wanted.len(), 10);
    assert_eq!(tiles(&[1.0]), [10]);
    assert_eq!(tiles(&[0.5, 0.5]), [5, 5]);
    assert_eq!(tiles(&[0.8, 0.2]), [8, 2]);
    assert_eq!(tiles(&[0.04, 0.96]), [0, 10]);
    assert_eq!(tiles(&[0.3, 0.3, 0.4]), [3, 3, 4]);
    assert_eq!(tiles(&[1.0, 0.0]), [10, 0]);
    // In order, and each once.
    let joined: Vec<_> = parts(&wanted, &[0.21, 0.47, 0.32]).concat();
    let runs = |of: &[Wanted]| of.iter().flat_map(Wanted::runs).collect::<Vec<_>>();
    assert_eq!(runs(&joined), runs(&wanted));
}
