//! Where samples are taken: `--device`, `--gpu-rays`, `--gpu-schedule`, and `specula devices`.

#[cfg(not(feature = "gpu"))]
mod cpu_only;
#[cfg(feature = "gpu")]
mod gpu;
#[cfg(all(feature = "gpu", feature = "lab"))]
pub(crate) mod measured;

use std::fmt;
use std::str::FromStr;

#[cfg(feature = "gpu")]
pub(crate) use crate::gpu::{Gpu, GpuError};
#[cfg(not(feature = "gpu"))]
pub(crate) use cpu_only::{Gpu, GpuArguments, GpuError, Samples, failed, list, open};
#[cfg(feature = "gpu")]
pub(crate) use gpu::{GpuArguments, Samples, failed, list, open};

/// What renders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Device {
    /// A real GPU that was measured to be faster and renders all of the scene, else the processor.
    Auto,
    /// The processor.
    Cpu,
    /// GPUs, or an error: by their indices or parts of their names, with commas between them; `all`: all real ones.
    /// `None`: the best one.
    Gpu(Option<String>),
}

impl FromStr for Device {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.split_once(':') {
            Some(("gpu", which)) if !which.is_empty() => Ok(Self::Gpu(Some(which.to_owned()))),
            None if text == "gpu" => Ok(Self::Gpu(None)),
            None if text == "auto" => Ok(Self::Auto),
            None if text == "cpu" => Ok(Self::Cpu),
            _ => Err(
                "expected auto, cpu, gpu, gpu:INDEX, gpu:NAME, gpu:0,1 or gpu:all (`specula devices` lists them)"
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
            Self::Gpu(None) => f.write_str("gpu"),
            Self::Gpu(Some(which)) => write!(f, "gpu:{which}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_read_and_written() {
        for text in [
            "auto",
            "cpu",
            "gpu",
            "gpu:1",
            "gpu:llvmpipe",
            "gpu:0,1",
            "gpu:all",
        ] {
            let device: Device = text.parse().unwrap();
            assert_eq!(device.to_string(), text);
        }
        for text in ["", "gpu:", "tpu", "cpu:1"] {
            assert!(text.parse::<Device>().is_err(), "{text}");
        }
    }
}
