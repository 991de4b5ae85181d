//! What `specula gpu-report` has measured on this machine: `--device auto` chooses by it.
//!
//! A file of the user's cache folder, `specula/gpus.json`: for each GPU, driver and processor the time to equal error.

use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::gpu::{AdapterDescription, AdapterKind};
use crate::lab::Machine;
use crate::scene::atomic;

/// What a measurement is of.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Hardware {
    gpu: String,
    driver: String,
    processor: String,
}

impl Hardware {
    fn new(adapter: &AdapterDescription, machine: &Machine) -> Self {
        Self {
            gpu: adapter.name.clone(),
            driver: adapter.driver.clone(),
            processor: machine.processor.clone(),
        }
    }
}

/// A GPU beside the processor of its machine.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measurement {
    hardware: Hardware,
    threads: u64,
    /// Time to equal error over the processor's.
    time: f64,
}

impl Measurement {
    /// * `time`: to equal error, over the processor's.
    pub(crate) fn new(adapter: &AdapterDescription, machine: &Machine, time: f64) -> Self {
        Self {
            hardware: Hardware::new(adapter, machine),
            threads: machine.threads as u64,
            time,
        }
    }

    fn read(value: &Value) -> Option<Self> {
        let text = |name: &str| Some(value.get(name)?.as_str()?.to_owned());
        let time = value.get("time_over_processor")?.as_f64()?;
        Some(Self {
            hardware: Hardware {
                gpu: text("gpu")?,
                driver: text("driver")?,
                processor: text("processor")?,
            },
            threads: value.get("threads")?.as_u64()?,
            time: Some(time).filter(|t| *t > 0.0)?,
        })
    }

    fn write(&self) -> Value {
        json!({
            "gpu": self.hardware.gpu,
            "driver": self.hardware.driver,
            "processor": self.hardware.processor,
            "threads": self.threads,
            "time_over_processor": self.time,
        })
    }
}

/// What `--device auto` takes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Choice<'a> {
    /// A GPU that was faster.
    Gpu(&'a AdapterDescription, Measurement),
    /// The best GPU that was measured was slower.
    Slower(Measurement),
    /// There are GPUs, and none was measured.
    NotMeasured(&'a AdapterDescription),
    /// There is no GPU but in software.
    NoGpu,
}

/// The fastest of the real GPUs that were measured on a machine, if it is faster than the processor.
pub(crate) fn choose<'a>(
    adapters: &'a [AdapterDescription],
    measurements: &[Measurement],
    machine: &Machine,
) -> Choice<'a> {
    let real = || (adapters.iter()).filter(|a| a.kind != AdapterKind::Software);
    let best = real()
        .filter_map(|adapter| {
            let hardware = Hardware::new(adapter, machine);
            let known = measurements.iter().find(|m| m.hardware == hardware)?;
            Some((adapter, known))
        })
        .min_by(|(_, a), (_, b)| a.time.total_cmp(&b.time));
    match (best, real().next()) {
        (Some((adapter, known)), _) if known.time < 1.0 => Choice::Gpu(adapter, known.clone()),
        (Some((_, known)), _) => Choice::Slower(known.clone()),
        (None, Some(adapter)) => Choice::NotMeasured(adapter),
        (None, None) => Choice::NoGpu,
    }
}

impl std::fmt::Display for Measurement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Hardware { gpu, processor, .. } = &self.hardware;
        let Self { threads, time, .. } = self;
        write!(
            f,
            "{gpu} took {time:.2} of the time of {processor} with {threads} threads"
        )
    }
}

/// All measurements that are kept; none where the file is missing or damaged.
pub(crate) fn all() -> Vec<Measurement> {
    let text = file().and_then(|file| std::fs::read(file).ok());
    text.map_or_else(Vec::new, |text| parse(&text))
}

fn parse(text: &[u8]) -> Vec<Measurement> {
    let value: Value = serde_json::from_slice(text).unwrap_or_default();
    let list = value.as_array().map_or(&[][..], Vec::as_slice);
    list.iter().filter_map(Measurement::read).collect()
}

/// Keeps a measurement in place of an earlier one; returns the file, or `None` where the user has no cache folder.
///
/// # Errors
/// Where the file cannot be written.
pub(crate) fn keep(measurement: &Measurement) -> io::Result<Option<PathBuf>> {
    let Some(file) = file() else {
        return Ok(None);
    };
    let mut kept = all();
    kept.retain(|other| other.hardware != measurement.hardware);
    kept.push(measurement.clone());
    write(&file, &kept)?;
    Ok(Some(file))
}

fn write(file: &Path, measurements: &[Measurement]) -> io::Result<()> {
    if let Some(folder) = file.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let list: Value = measurements.iter().map(Measurement::write).collect();
    atomic::replace(file, |to| to.write_all(format!("{list:#}\n").as_bytes()))
}

/// Where they are kept; `None` where the environment names no folder.
fn file() -> Option<PathBuf> {
    let variable = |name: &str| {
        let value = std::env::var_os(name).map(PathBuf::from);
        value.filter(|folder| folder.is_absolute())
    };
    let home = || std::env::home_dir().filter(|folder| folder.is_absolute());
    let folder = if cfg!(windows) {
        variable("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        home().map(|home| home.join("Library/Caches"))
    } else {
        variable("XDG_CACHE_HOME").or_else(|| home().map(|home| home.join(".cache")))
    };
    Some(folder?.join("specula").join("gpus.json"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adapter(index: usize, name: &str, kind: AdapterKind) -> AdapterDescription {
        AdapterDescription {
            index,
            name: name.to_owned(),
            kind,
            backend: "vulkan".to_owned(),
            driver: "driver 1".to_owned(),
            ray_queries: false,
            largest_array: 1 << 30,
        }
    }

    fn machine(processor: &str) -> Machine {
        Machine {
            processor: processor.to_owned(),
            threads: 16,
            system: "linux".to_owned(),
        }
    }

    #[test]
    fn the_fastest_gpu_that_was_measured_here_is_chosen() {
        let here = machine("A");
        let adapters = [
            adapter(0, "large", AdapterKind::Discrete),
            adapter(1, "small", AdapterKind::Integrated),
            adapter(2, "software", AdapterKind::Software),
        ];
        let measured = |place: usize, time| Measurement::new(&adapters[place], &here, time);
        let of = |known: &[Measurement], machine: &Machine| choose(&adapters, known, machine);
        let (large, small) = (measured(0, 0.05), measured(1, 0.7));
        let both = [small.clone(), large.clone()];
        assert_eq!(of(&both, &here), Choice::Gpu(&adapters[0], large));
        assert_eq!(of(&both[..1], &here), Choice::Gpu(&adapters[1], small));
        let slow = measured(1, 1.3);
        assert_eq!(
            of(std::slice::from_ref(&slow), &here),
            Choice::Slower(slow.clone())
        );
        // Other machines, drivers and software tell nothing.
        assert_eq!(of(&both, &machine("B")), Choice::NotMeasured(&adapters[0]));
        let mut old = measured(0, 0.1);
        "driver 0".clone_into(&mut old.hardware.driver);
        let software = measured(2, 0.1);
        assert_eq!(
            of(&[old, software.clone()], &here),
            Choice::NotMeasured(&adapters[0])
        );
        assert_eq!(choose(&adapters[2..], &[software], &here), Choice::NoGpu);
    }

    #[test]
    fn measurements_are_written_and_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("new/gpus.json");
        let card = adapter(0, "a \"card\"", AdapterKind::Discrete);
        let list = ["A", "B"].map(|name| Measurement::new(&card, &machine(name), 0.25));
        write(&file, &list).unwrap();
        let read = parse(&std::fs::read(&file).unwrap());
        assert_eq!(read, list);
        assert!(read[0].hardware == list[0].hardware && read[0].hardware != list[1].hardware);
        for damaged in ["", "{", "{}", "[1, {\"gpu\": 2}]", "[[]]"] {
            assert_eq!(parse(damaged.as_bytes()), [], "{damaged}");
        }
        let negative = list[0].write().to_string().replace("0.25", "-1");
        assert_eq!(parse(format!("[{negative}]").as_bytes()), []);
    }
}
