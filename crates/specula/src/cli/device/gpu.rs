//! Devices of a program that is built with the feature `gpu`.

use crate::cli::ExitCode;
use std::fmt;
use std::sync::atomic::AtomicBool;

use crate::gpu::{
    AdapterChoice, AdapterKind, Gpu, GpuError, Rays, Schedule, TracerError, TracerOptions, Tracers,
    adapters,
};
use crate::render::{PassReport, PreparedScene, RenderOptions, Renderer};
use clap::Args;

use super::super::console::say;
use super::super::{Failure, print};
use super::Device;

/// How a GPU renders.
#[derive(Args, Debug, Default)]
pub(crate) struct GpuArguments {
    /// How a GPU follows paths, with the same samples: paths (a thread follows one to its end), queues (a
    /// thread takes one to its next vertex, and those that continue form a queue), or auto:
    /// queues, which take 0.13 to 0.34 of the time on an NVIDIA H100
    #[arg(long, value_name = "NAME", default_value_t = Schedule::Auto)]
    gpu_schedule: Schedule,

    /// How rays are cast on a GPU: tree, by traversal of Specula's own; query, by the GPU's ray
    /// queries, or an error; or auto: queries where a real GPU offers them and they support the scene
    #[arg(long, value_name = "NAME", default_value_t = Rays::Auto)]
    gpu_rays: Rays,
}

impl GpuArguments {
    /// As the library takes it.
    fn options(&self) -> TracerOptions {
        TracerOptions {
            rays: self.gpu_rays,
            schedule: self.gpu_schedule,
        }
    }
}

/// Lists what `--device gpu:INDEX` can be given.
pub(crate) fn list() -> Result<ExitCode, Failure> {
    let adapters = adapters();
    let lines: Vec<String> = adapters.iter().map(|a| format!("gpu:{a}\n")).collect();
    print(&format!("cpu: {} threads\n", rayon::current_num_threads()))?;
    print(&lines.concat())?;
    if adapters.is_empty() {
        let none = GpuError::NoAdapter;
        print(&format!("{none}\n"))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Opens the GPUs that are asked for; none: the processor renders.
///
/// # Errors
/// Where a GPU is asked for and cannot be opened, or ray queries are and it offers none.
pub(crate) fn open(device: &Device, arguments: &GpuArguments) -> Result<Vec<Gpu>, Failure> {
    let gpus = opened(device)?;
    if arguments.gpu_rays != Rays::Query {
        return Ok(gpus);
    }
    let lacks = match gpus.iter().find(|gpu| !gpu.has_ray_queries()) {
        Some(gpu) => format!("{} offers no ray queries", gpu.adapter),
        None if !gpus.is_empty() => return Ok(gpus),
        None if *device == Device::Cpu => "the processor has no ray queries".to_owned(),
        None => "there is no real GPU".to_owned(),
    };
    Err(Failure::bad_input(format_args!(
        "--device {device} --gpu-rays query: {lacks} (`specula devices` tells who does); \
         --gpu-rays auto goes on without"
    )))
}

/// The adapters that are meant by what follows `gpu:`.
///
/// # Errors
/// Where one is named twice.
fn choices(which: &str) -> Result<Vec<AdapterChoice>, String> {
    if which.eq_ignore_ascii_case("all") {
        let real = adapters().into_iter();
        let real = real.filter(|adapter| adapter.kind != AdapterKind::Software);
        let all: Vec<_> = real.map(|a| AdapterChoice::Index(a.index)).collect();
        return match all.is_empty() {
            true => Err("there is no real GPU".to_owned()),
            false => Ok(all),
        };
    }
    let choice = |name: &str| match name.trim().parse() {
        Ok(choice) => choice,
        Err(never) => match never {},
    };
    Ok(which.split(',').map(choice).collect())
}

fn opened(device: &Device) -> Result<Vec<Gpu>, Failure> {
    let which = match device {
        Device::Cpu => return Ok(Vec::new()),
        Device::Auto => {
            let gpu = faster().and_then(|index| {
                let gpu = Gpu::open(&AdapterChoice::Index(index));
                gpu.inspect_err(|error| note(error)).ok()
            });
            return Ok(gpu.into_iter().collect());
        }
        Device::Gpu(which) => which.as_deref().unwrap_or("best"),
    };
    let refused =
        |error: &dyn fmt::Display| Failure::bad_input(format_args!("--device {device}: {error}"));
    let mut gpus: Vec<Gpu> = Vec::new();
    for choice in choices(which).map_err(|error| refused(&error))? {
        let gpu = Gpu::open(&choice).map_err(|error| match error {
            GpuError::NoAdapter | GpuError::NoSuchAdapter { .. } => refused(&error),
            _ => Failure::other(error),
        })?;
        if gpus.iter().any(|other| other.adapter == gpu.adapter) {
            return Err(refused(&format_args!("{} is named twice", gpu.adapter)));
        }
        gpus.push(gpu);
    }
    Ok(gpus)
}

/// The index of a real GPU that `gpu-report` has measured to be faster than the processor; says so, or why the processor
/// renders.
#[cfg(feature = "lab")]
fn faster() -> Option<usize> {
    use super::measured::{self, Choice};
    let adapters = adapters();
    let machine = crate::lab::Machine::here();
    match measured::choose(&adapters, &measured::all(), &machine) {
        Choice::Gpu(adapter, measurement) => {
            say!("note: by `specula gpu-report`, {measurement} to equal error");
            Some(adapter.index)
        }
        Choice::Slower(measurement) => {
            note(&format_args!(
                "by `specula gpu-report`, {measurement} to equal error"
            ));
            None
        }
        Choice::NotMeasured(adapter) => {
            note(&format_args!(
                "{} has not been measured: `specula gpu-report --part scenes` compares it with the processor, and \
                 --device gpu renders on it",
                adapter.name
            ));
            None
        }
        Choice::NoGpu => None,
    }
}

/// Without the laboratory nothing is measured.
#[cfg(not(feature = "lab"))]
fn faster() -> Option<usize> {
    note(&"this program was built without `gpu-report`, by which --device auto chooses");
    None
}

/// A device that fails under the scene.
///
/// * `saved`: where the samples so far are, after a semicolon.
pub(crate) fn failed(error: &GpuError, saved: &str) -> Failure {
    match error {
        GpuError::OutOfMemory(_) => Failure::bad_input(format_args!(
            "{error}; --device cpu renders in the processor's memory{saved}"
        )),
        _ => Failure::other(format_args!("{error}{saved}")),
    }
}

fn note(error: &dyn fmt::Display) {
    say!("note: {error}; the processor renders");
}

/// What takes the samples of a render.
pub(crate) struct Samples<'a> {
    tracers: Option<Tracers<'a>>,
    /// Whether the processor goes on where a GPU fails.
    falls_back: bool,
}

impl<'a> Samples<'a> {
    /// Prepares the GPUs for the scene.
    ///
    /// # Errors
    /// Where a GPU is asked for and does not render the scene.
    pub(crate) fn new(
        (device, arguments): (&Device, &GpuArguments),
        gpus: &'a [Gpu],
        scene: &PreparedScene,
        options: &RenderOptions,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let falls_back = *device == Device::Auto;
        if gpus.is_empty() {
            return Ok(Self {
                tracers: None,
                falls_back,
            });
        }
        // Of several, which one.
        let of = |place: usize| match gpus {
            [_] => String::new(),
            _ => format!("{}: ", gpus[place].adapter),
        };
        let tracers = match Tracers::new(gpus, scene, options, arguments.options()) {
            Ok(tracers) => Some(tracers),
            Err((place, error @ TracerError::Queries(_))) => {
                return Err(Failure::bad_input(format_args!(
                    "--gpu-rays query: {}{error}; --gpu-rays tree does",
                    of(place)
                )));
            }
            Err((_, error)) if falls_back => {
                note(&error);
                None
            }
            Err((place, error @ (TracerError::Missing(_) | TracerError::TooLarge { .. }))) => {
                return Err(Failure::bad_input(format_args!(
                    "--device {device}: {}{error}; --device cpu does",
                    of(place)
                )));
            }
            Err((_, TracerError::Gpu(error))) => return Err(failed(&error, "")),
            Err((_, error)) => return Err(Failure::other(error)),
        };
        for tracer in tracers.iter().flat_map(Tracers::members).filter(|_| !quiet) {
            let casting = match tracer.uses_ray_queries() {
                true => "by its ray queries",
                false => "through Specula's tree",
            };
            say!("rendering on {}, rays {casting}", tracer.gpu().adapter);
        }
        Ok(Self {
            tracers,
            falls_back,
        })
    }

    /// Adds samples to the film; without GPUs that fail others go on, and at last, where it may, the processor.
    ///
    /// # Errors
    /// That of a GPU that was asked for. Earlier samples stay in the film.
    pub(crate) fn pass(
        &mut self,
        renderer: &mut Renderer<'_>,
        samples: u32,
        stop: &AtomicBool,
    ) -> Result<PassReport, GpuError> {
        if let Some(tracers) = &mut self.tracers {
            let result = tracers.render_pass(renderer, samples, stop);
            for lost in tracers.lost() {
                say!("note: {}: {}; the others go on", lost.adapter, lost.error);
            }
            match result {
                Err(error) if self.falls_back => {
                    note(&error);
                    self.tracers = None;
                }
                result => return result,
            }
        }
        Ok(renderer.render_pass(samples, stop))
    }
}

#[cfg(test)]
#[path = "../../../../specula-gpu/tests/common/limited.rs"]
mod limited;

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::limited::{Limit, MIB, is_alone};
    use super::*;

    /// The GPU of the tests; without one a loud line that `what` is skipped.
    #[track_caller]
    fn gpu(what: &str) -> Option<Gpu> {
        let gpu = Gpu::open(&AdapterChoice::Best);
        if let Err(error) = &gpu {
            let required = std::env::var("SPECULA_GPU").is_ok_and(|v| v == "require");
            assert!(!required, "SPECULA_GPU=require, but: {error}");
            specula_testing::skip(what, error, "apt-get install mesa-vulkan-drivers");
        }
        gpu.ok()
    }

    /// A lit disk with a texture of so many pixels along each side.
    fn textured(side: u64) -> (PreparedScene, RenderOptions) {
        let folder = tempfile::tempdir().unwrap();
        let header = format!("Pf\n{side} {side}\n-1.0\n");
        let mut file = std::fs::File::create(folder.path().join("t.pfm")).unwrap();
        file.write_all(header.as_bytes()).unwrap();
        // Too many values for a palette; black else, and the file takes no room.
        for i in 0..u16::try_from(side.min(300)).unwrap() {
            let value = f32::from(i) * 1e-3;
            file.write_all(&value.to_le_bytes()).unwrap();
        }
        file.set_len(header.len() as u64 + 4 * side * side).unwrap();
        let text = "LookAt 0 0 4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\n\
            Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\nWorldBegin\n\
            LightSource \"infinite\" \"rgb L\" [0.7 0.8 1.0]\n\
            Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.pfm\"\n\
            Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"disk\"\n";
        let path = folder.path().join("scene.pbrt");
        std::fs::write(&path, text).unwrap();
        let scene = crate::scene::load(&path).unwrap().scene;
        let options = RenderOptions::from_scene(&scene);
        (PreparedScene::new(&scene, &options).unwrap(), options)
    }

    /// `auto` on a GPU that is there, in software too.
    fn auto<'a>(gpu: &'a Gpu, scene: &PreparedScene, options: &RenderOptions) -> Samples<'a> {
        let arguments = GpuArguments::default();
        let gpus = std::slice::from_ref(gpu);
        let samples = Samples::new((&Device::Auto, &arguments), gpus, scene, options, true);
        samples.unwrap_or_else(|_| panic!("auto fails"))
    }

    /// Takes samples, which must be the processor's.
    fn is_the_processors(mut samples: Samples<'_>, scene: &PreparedScene, options: &RenderOptions) {
        let go = AtomicBool::new(false);
        let mut renderer = Renderer::new(scene, options.clone());
        let report = samples.pass(&mut renderer, 4, &go).unwrap();
        assert!(report.complete);
        assert!(samples.tracers.is_none(), "the GPU goes on");
        let mut processor = Renderer::new(scene, options.clone());
        processor.render_pass(4, &go);
        assert!(renderer.film() == processor.film());
    }

    #[test]
    fn auto_goes_on_where_a_device_is_lost_or_does_not_hold_the_scene() {
        let Some(gpu) = gpu("what auto does") else {
            return;
        };
        let software = adapters()
            .into_iter()
            .filter(|a| a.kind == AdapterKind::Software);
        if let Some(smallest) = software.min_by_key(|a| a.largest_array) {
            let (scene, options) = textured((smallest.largest_array / 12).isqrt() + 1);
            let small = Gpu::open(&AdapterChoice::Index(smallest.index)).unwrap();
            is_the_processors(auto(&small, &scene, &options), &scene, &options);
        }
        let (scene, options) = textured(4);
        let samples = auto(&gpu, &scene, &options);
        assert!(samples.tracers.is_some());
        gpu.device.destroy();
        is_the_processors(samples, &scene, &options);
        is_the_processors(auto(&gpu, &scene, &options), &scene, &options);
    }

    #[test]
    fn where_memory_ends_auto_goes_on_and_a_gpu_that_is_asked_for_is_an_error() {
        let what = "where_memory_ends_auto_goes_on_and_a_gpu_that_is_asked_for_is_an_error";
        let Some(gpu) = gpu(what) else { return };
        if !is_alone(&gpu, &format!("cli::device::gpu::tests::{what}")) {
            return;
        }
        let side = 3300;
        let (scene, options) = textured(side);
        assert!(auto(&gpu, &scene, &options).tracers.is_some());
        gpu.wait().unwrap();
        // For the scene as an array here, which grows by doubling, and for what else the driver takes;
        // not for another array there.
        let limit = Limit::new(2 * 12 * side * side + 96 * MIB);
        let samples = auto(&gpu, &scene, &options);
        let (device, arguments) = (Device::Gpu(None), GpuArguments::default());
        let chosen = (&device, &arguments);
        let refused = Samples::new(chosen, std::slice::from_ref(&gpu), &scene, &options, true);
        limit.lift();
        let (code, said) = refused
            .err()
            .map(|failure| failure.told())
            .unwrap_or_default();
        assert_eq!(code, 2, "{said}");
        assert!(said.contains("the GPU is out of memory"), "{said}");
        assert!(said.contains("--device cpu renders"), "{said}");
        is_the_processors(samples, &scene, &options);
    }
}
