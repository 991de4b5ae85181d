//! Devices of a program that is built without the feature `gpu`: the processor.

use crate::cli::ExitCode;
use std::marker::PhantomData;
use std::sync::atomic::AtomicBool;

use crate::render::{PassReport, PreparedScene, RenderOptions, Renderer};
use clap::Args;

use super::super::{Failure, absent, print};
use super::Device;

/// There is none.
pub(crate) enum Gpu {}

/// There is none to fail.
pub(crate) enum GpuError {}

/// Options of a GPU: each says which feature it needs.
#[derive(Args, Debug)]
pub(crate) struct GpuArguments {
    #[arg(long, hide = true, value_parser = absent_option)]
    gpu_schedule: Option<String>,

    #[arg(long, hide = true, value_parser = absent_option)]
    gpu_rays: Option<String>,
}

fn absent_option(_: &str) -> Result<String, String> {
    Err(absent::message("a GPU", "gpu"))
}

/// Lists the processor.
pub(crate) fn list() -> Result<ExitCode, Failure> {
    print(&format!("cpu: {} threads\n", rayon::current_num_threads()))?;
    print(&format!("gpu: {}\n", absent::message("a GPU", "gpu")))?;
    Ok(ExitCode::SUCCESS)
}

/// No GPU.
///
/// # Errors
/// Where a GPU is asked for.
pub(crate) fn open(device: &Device, _: &GpuArguments) -> Result<Vec<Gpu>, Failure> {
    match device {
        Device::Cpu | Device::Auto => Ok(Vec::new()),
        Device::Gpu(_) => Err(Failure::bad_input(format_args!(
            "--device {device}: {}",
            absent::message("a GPU", "gpu")
        ))),
    }
}

/// Never called.
pub(crate) fn failed(error: &GpuError, _: &str) -> Failure {
    match *error {}
}

/// What takes the samples of a render: the processor.
pub(crate) struct Samples<'a>(PhantomData<&'a Gpu>);

impl<'a> Samples<'a> {
    /// Prepares nothing.
    ///
    /// # Errors
    /// None.
    #[allow(
        clippy::unnecessary_wraps,
        reason = "as with the feature `gpu`, where it can fail"
    )]
    pub(crate) fn new(
        _: (&Device, &GpuArguments),
        gpus: &'a [Gpu],
        _: &PreparedScene,
        _: &RenderOptions,
        _: bool,
    ) -> Result<Self, Failure> {
        match gpus.first() {
            None => Ok(Self(PhantomData)),
            Some(gpu) => match *gpu {},
        }
    }

    /// Adds samples to the film.
    ///
    /// # Errors
    /// None.
    #[allow(
        clippy::unnecessary_wraps,
        clippy::unused_self,
        reason = "as with the feature `gpu`, where it can fail"
    )]
    pub(crate) fn pass(
        &mut self,
        renderer: &mut Renderer<'_>,
        samples: u32,
        stop: &AtomicBool,
    ) -> Result<PassReport, GpuError> {
        Ok(renderer.render_pass(samples, stop))
    }
}
