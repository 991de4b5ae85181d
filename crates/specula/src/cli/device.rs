//! Where samples are taken: `--device`, `--gpu-rays`, `--gpu-schedule`, and `specula devices`.

use std::fmt;
use std::process::ExitCode;
use std::str::FromStr;
use std::sync::atomic::AtomicBool;

use specula::gpu::{
    AdapterChoice, AdapterKind, Gpu, GpuError, Rays, Tracer, TracerError, TracerOptions, adapters,
};
use specula::render::{PassReport, PreparedScene, RenderOptions, Renderer};

use super::{Failure, print};

/// What renders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Device {
    /// A real GPU that knows all of the scene, else the processor.
    Auto,
    /// The processor.
    Cpu,
    /// A GPU, or an error.
    Gpu(AdapterChoice),
}

impl FromStr for Device {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let choice = |text: &str| match text.parse() {
            Ok(choice) => Self::Gpu(choice),
            Err(never) => match never {},
        };
        match text.split_once(':') {
            Some(("gpu", which)) if !which.is_empty() => Ok(choice(which)),
            None if text == "gpu" => Ok(Self::Gpu(AdapterChoice::Best)),
            None if text == "auto" => Ok(Self::Auto),
            None if text == "cpu" => Ok(Self::Cpu),
            _ => Err(
                "expected auto, cpu, gpu, gpu:INDEX or gpu:NAME (`specula devices` lists them)"
                    .to_owned(),
            ),
        }
    }
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Cpu => f.write_str("cpu"),
            Self::Gpu(AdapterChoice::Best) => f.write_str("gpu"),
            Self::Gpu(AdapterChoice::Index(index)) => write!(f, "gpu:{index}"),
            Self::Gpu(AdapterChoice::Name(name)) => write!(f, "gpu:{name}"),
        }
    }
}

/// Lists what `--device gpu:INDEX` can be given.
pub(crate) fn list() -> ExitCode {
    let found = adapters();
    let lines: Vec<String> = found.iter().map(|a| format!("gpu:{a}\n")).collect();
    print(&format!("cpu: {} threads\n", rayon::current_num_threads()));
    print(&lines.concat());
    if found.is_empty() {
        let none = GpuError::NoAdapter;
        print(&format!("{none}\n"));
    }
    ExitCode::SUCCESS
}

/// Opens the GPU that is asked for; `None`: the processor renders.
///
/// # Errors
/// Where a GPU is asked for and cannot be opened, or ray queries are and it offers none.
pub(crate) fn open(device: &Device, rays: Rays) -> Result<Option<Gpu>, Failure> {
    let gpu = opened(device)?;
    let lacks = match &gpu {
        _ if rays != Rays::Query => return Ok(gpu),
        Some(open) if open.has_ray_queries() => return Ok(gpu),
        Some(gpu) => format!("{} offers no ray queries", gpu.adapter),
        None if *device == Device::Cpu => "the processor has no ray queries".to_owned(),
        None => "there is no real GPU".to_owned(),
    };
    Err(Failure::bad_input(format_args!(
        "--device {device} --gpu-rays query: {lacks} (`specula devices` tells who does); \
         --gpu-rays auto goes on without"
    )))
}

fn opened(device: &Device) -> Result<Option<Gpu>, Failure> {
    match device {
        Device::Cpu => Ok(None),
        Device::Auto => {
            let real = adapters()
                .into_iter()
                .find(|a| a.kind != AdapterKind::Software);
            Ok(
                real.and_then(|a| match Gpu::open(&AdapterChoice::Index(a.index)) {
                    Ok(gpu) => Some(gpu),
                    Err(error) => {
                        note(&error);
                        None
                    }
                }),
            )
        }
        Device::Gpu(choice) => match Gpu::open(choice) {
            Ok(gpu) => Ok(Some(gpu)),
            Err(error @ (GpuError::NoAdapter | GpuError::NoSuchAdapter { .. })) => Err(
                Failure::bad_input(format_args!("--device {device}: {error}")),
            ),
            Err(error) => Err(Failure::other(error)),
        },
    }
}

fn note(error: &dyn fmt::Display) {
    eprintln!("note: {error}; the processor renders");
}

/// What takes the samples of a render.
pub(crate) struct Samples<'a> {
    tracer: Option<Tracer<'a>>,
    /// Whether the processor goes on where a GPU fails.
    falls_back: bool,
}

impl<'a> Samples<'a> {
    /// Prepares the GPU for the scene.
    ///
    /// # Errors
    /// Where a GPU is asked for and does not render the scene.
    pub(crate) fn new(
        (device, on_gpu): (&Device, TracerOptions),
        gpu: Option<&'a Gpu>,
        scene: &PreparedScene,
        options: &RenderOptions,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let falls_back = *device == Device::Auto;
        let prepare = |gpu| Tracer::with_options(gpu, scene, options, on_gpu);
        let tracer = match gpu.map(|gpu| (prepare(gpu), gpu)) {
            None => None,
            Some((Ok(tracer), gpu)) => {
                if !quiet {
                    let way = match tracer.uses_ray_queries() {
                        true => "by its ray queries",
                        false => "through Specula's tree",
                    };
                    eprintln!("rendering on {}, rays {way}", gpu.adapter);
                }
                Some(tracer)
            }
            Some((Err(error @ TracerError::Queries(_)), _)) => {
                return Err(Failure::bad_input(format_args!(
                    "--gpu-rays query: {error}; --gpu-rays tree does"
                )));
            }
            Some((Err(error), _)) if falls_back => {
                note(&error);
                None
            }
            Some((Err(error @ TracerError::Missing(_)), _)) => {
                return Err(Failure::bad_input(format_args!(
                    "--device {device}: {error}; --device cpu does"
                )));
            }
            Some((Err(error), _)) => return Err(Failure::other(error)),
        };
        Ok(Self { tracer, falls_back })
    }

    /// Adds samples to the film; where a GPU fails and may be left, the processor takes the rest.
    ///
    /// # Errors
    /// That of a GPU that was asked for. The film keeps what came before.
    pub(crate) fn pass(
        &mut self,
        renderer: &mut Renderer<'_>,
        samples: u32,
        stop: &AtomicBool,
    ) -> Result<PassReport, GpuError> {
        if let Some(tracer) = &mut self.tracer {
            match tracer.render_pass(renderer, samples, stop) {
                Err(error) if self.falls_back => {
                    note(&error);
                    self.tracer = None;
                }
                result => return result,
            }
        }
        Ok(renderer.render_pass(samples, stop))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_read_and_written() {
        for text in ["auto", "cpu", "gpu", "gpu:1", "gpu:llvmpipe"] {
            let device: Device = text.parse().unwrap();
            assert_eq!(device.to_string(), text);
        }
        for text in ["", "gpu:", "tpu", "cpu:1"] {
            assert!(text.parse::<Device>().is_err(), "{text}");
        }
    }
}
