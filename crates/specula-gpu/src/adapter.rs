//! Finding a GPU and opening it, and what can go wrong with one.

use std::fmt;
use std::str::FromStr;
use std::sync::{Arc, Mutex, PoisonError};

use crate::shader::Shaders;

/// What wgpu calls ray queries.
pub(crate) const RAY_QUERIES: wgpu::Features = wgpu::Features::EXPERIMENTAL_RAY_QUERY;

/// What an adapter is, the better ones first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AdapterKind {
    /// A card with memory of its own.
    Discrete,
    /// Part of the processor, with its memory.
    Integrated,
    /// A share of a card, in a virtual machine.
    Virtual,
    /// Nothing that is known.
    Other,
    /// The processor itself, through a driver such as lavapipe or WARP: right and slow.
    Software,
}

impl fmt::Display for AdapterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Other => "other",
            Self::Software => "software",
        })
    }
}

/// An adapter as reports name it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterDescription {
    /// Its place in [`adapters`].
    pub index: usize,
    /// The name that its driver gives.
    pub name: String,
    /// What it is.
    pub kind: AdapterKind,
    /// The interface through which it is reached: "vulkan", "metal" or "dx12".
    pub backend: String,
    /// The driver and its version.
    pub driver: String,
    /// Whether it offers ray queries.
    pub ray_queries: bool,
    /// Bytes of the largest array that it takes.
    pub largest_array: u64,
}

impl AdapterDescription {
    fn new(index: usize, adapter: &wgpu::Adapter) -> Self {
        let info = adapter.get_info();
        let driver = format!("{} {}", info.driver, info.driver_info);
        let limits = adapter.limits();
        Self {
            index,
            name: info.name,
            kind: match info.device_type {
                wgpu::DeviceType::DiscreteGpu => AdapterKind::Discrete,
                wgpu::DeviceType::IntegratedGpu => AdapterKind::Integrated,
                wgpu::DeviceType::VirtualGpu => AdapterKind::Virtual,
                wgpu::DeviceType::Cpu => AdapterKind::Software,
                wgpu::DeviceType::Other => AdapterKind::Other,
            },
            backend: info.backend.to_string(),
            driver: driver.trim().to_owned(),
            ray_queries: adapter.features().contains(RAY_QUERIES),
            largest_array: limits
                .max_storage_buffer_binding_size
                .min(limits.max_buffer_size),
        }
    }
}

impl fmt::Display for AdapterDescription {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            index,
            name,
            kind,
            backend,
            driver,
            ray_queries,
            largest_array: _,
        } = self;
        write!(f, "{index}: {name} ({kind}, {backend}")?;
        if !driver.is_empty() {
            write!(f, ", {driver}")?;
        }
        if *ray_queries {
            f.write_str(", ray queries")?;
        }
        f.write_str(")")
    }
}

/// Which adapter to open.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The first of the best kind: real ones before software.
    #[default]
    Best,
    /// The one at this place in [`adapters`].
    Index(usize),
    /// The best one whose name contains these letters, whatever their case.
    Name(String),
}

impl FromStr for AdapterChoice {
    type Err = std::convert::Infallible;

    /// A number is an index, "best" the best one, anything else a part of a name.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text.parse() {
            Ok(index) => Self::Index(index),
            Err(_) if text.eq_ignore_ascii_case("best") => Self::Best,
            Err(_) => Self::Name(text.to_owned()),
        })
    }
}

impl AdapterChoice {
    /// The index of the chosen adapter in `all`.
    fn among(&self, all: &[AdapterDescription]) -> Result<usize, GpuError> {
        let best = |wanted: &dyn Fn(&AdapterDescription) -> bool| {
            let kind = |(_, a): &(usize, &AdapterDescription)| a.kind;
            let candidates = all.iter().enumerate().filter(|(_, a)| wanted(a));
            candidates.min_by_key(kind).map(|(place, _)| place)
        };
        let place = match self {
            _ if all.is_empty() => return Err(GpuError::NoAdapter),
            Self::Best => best(&|_| true),
            Self::Index(index) => best(&|a| a.index == *index),
            Self::Name(name) => {
                let name = name.to_lowercase();
                best(&|a| a.name.to_lowercase().contains(&name))
            }
        };
        place.ok_or_else(|| GpuError::NoSuchAdapter {
            wanted: match self {
                Self::Best => "best".to_owned(),
                Self::Index(index) => index.to_string(),
                Self::Name(name) => name.clone(),
            },
            available: all.iter().map(|a| format!("\n  {a}")).collect(),
        })
    }
}

/// What can go wrong on a GPU.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// No driver offers an adapter.
    #[error("no GPU found: no driver for Vulkan, Metal or Direct3D 12 offers one")]
    NoAdapter,
    /// The adapter that was asked for is not there.
    #[error("no GPU '{wanted}'; there are:{available}")]
    NoSuchAdapter {
        /// What was asked for.
        wanted: String,
        /// What there is, a line each.
        available: String,
    },
    /// The adapter is there but cannot be opened.
    #[error("the GPU {adapter} cannot be opened: {reason}")]
    NotOpened {
        /// Its description.
        adapter: String,
        /// What its driver says.
        reason: String,
    },
    /// The driver gave the device up: a crash, a timeout of the system's watchdog, an unplugged card.
    #[error("the GPU was lost: {0}")]
    Lost(String),
    /// The device's memory does not hold what was asked for.
    #[error("the GPU is out of memory: {0}")]
    OutOfMemory(String),
    /// A shader that does not compile.
    #[error("shader '{label}': {text}")]
    Shader {
        /// The shader's name.
        label: String,
        /// What the compiler says.
        text: String,
    },
    /// A use of the device that its rules or its driver refuse.
    #[error("the GPU refused the work: {0}")]
    Refused(String),
}

impl GpuError {
    /// A refusal as that of a shader.
    pub(crate) fn of_shader(self, label: &str) -> Self {
        match self {
            Self::Refused(text) => Self::Shader {
                label: label.to_owned(),
                text,
            },
            other => other,
        }
    }
}

/// Every adapter, real ones before software.
#[must_use]
pub fn adapters() -> Vec<AdapterDescription> {
    described(&instance()).into_iter().map(|(d, _)| d).collect()
}

fn instance() -> wgpu::Instance {
    wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        // Driver layers that check our use are for people who develop, not for those who render.
        flags: wgpu::InstanceFlags::empty(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    })
}

fn described(instance: &wgpu::Instance) -> Vec<(AdapterDescription, wgpu::Adapter)> {
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    let mut all: Vec<_> = adapters
        .into_iter()
        .map(|adapter| (AdapterDescription::new(0, &adapter), adapter))
        .collect();
    all.sort_by_key(|(description, _)| description.kind);
    for (index, (description, _)) in all.iter_mut().enumerate() {
        description.index = index;
    }
    all
}

/// An open GPU.
#[derive(Debug)]
pub struct Gpu {
    /// Which one it is.
    pub adapter: AdapterDescription,
    /// Makes buffers, shaders and pipelines.
    pub device: wgpu::Device,
    /// Takes work.
    pub queue: wgpu::Queue,
    /// What went wrong where no scope caught it; the first report stays.
    failure: Arc<Mutex<Option<GpuError>>>,
    /// What it has compiled.
    pub(crate) shaders: Shaders,
}

impl Gpu {
    /// Opens an adapter with all the limits that it offers, and ray queries where it does.
    ///
    /// # Errors
    /// Where there is no such adapter or its driver does not open it.
    pub fn open(choice: &AdapterChoice) -> Result<Self, GpuError> {
        let all = described(&instance());
        let (descriptions, mut handles): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        let place = choice.among(&descriptions)?;
        let handle = handles.swap_remove(place);
        let adapter = descriptions[place].clone();
        let request = handle.request_device(&wgpu::DeviceDescriptor {
            label: Some("specula"),
            required_features: handle.features() & RAY_QUERIES,
            required_limits: handle.limits(),
            experimental_features: crate::experimental::consent(),
            // Few and large arrays: memory that is taken beforehand is lost to them.
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..wgpu::DeviceDescriptor::default()
        });
        let (device, queue) = pollster::block_on(request).map_err(|error| GpuError::NotOpened {
            adapter: adapter.to_string(),
            reason: error.to_string(),
        })?;
        let failure = Arc::new(Mutex::new(None));
        let lost = Arc::clone(&failure);
        device.set_device_lost_callback(move |reason, message| {
            // Reported too when the device is dropped on purpose; nobody is left to read it then.
            store_first(&lost, lost_because(&format!("{reason:?}"), &message));
        });
        let uncaught = Arc::clone(&failure);
        device.on_uncaptured_error(Arc::new(move |error| {
            store_first(&uncaught, GpuError::from(error));
        }));
        Ok(Self {
            adapter,
            device,
            queue,
            failure,
            shaders: Shaders::default(),
        })
    }

    /// Does `work` and gives its errors back: refusals, exhausted memory, failures of the driver.
    ///
    /// # Errors
    /// What `work` causes, exhausted memory before the refusals that follow from it; or an error that
    /// happened before where nobody asked.
    pub fn caught<T>(&self, work: impl FnOnce(&Self) -> T) -> Result<T, GpuError> {
        use wgpu::ErrorFilter::{Internal, OutOfMemory, Validation};
        self.check()?;
        let scopes = [Internal, OutOfMemory, Validation].map(|f| self.device.push_error_scope(f));
        let done = work(self);
        // A stack: the last scope is popped first.
        let errors = scopes
            .into_iter()
            .rev()
            .filter_map(|scope| pollster::block_on(scope.pop()));
        let error = errors.map(GpuError::from).reduce(cause);
        self.check()?;
        error.map_or(Ok(done), Err)
    }

    /// Whether the device still works.
    ///
    /// # Errors
    /// That it was lost, or what went wrong outside [`caught`](Self::caught).
    pub fn check(&self) -> Result<(), GpuError> {
        // A loss is told when the device is asked; what fails because of it may be told before.
        let _ = self.device.poll(wgpu::PollType::Poll);
        let failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
        match failure.as_ref() {
            Some(error) => Err(error.clone()),
            None => Ok(()),
        }
    }

    /// Waits until all submitted work is done.
    ///
    /// # Errors
    /// Where the device was lost meanwhile.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.wait_for(None)
    }

    /// Waits until a submission is done; `None`: all.
    pub(crate) fn wait_for(
        &self,
        submission_index: Option<wgpu::SubmissionIndex>,
    ) -> Result<(), GpuError> {
        let waited = self.device.poll(wgpu::PollType::Wait {
            submission_index,
            timeout: None,
        });
        self.check()?;
        waited
            .map(|_| ())
            .map_err(|error| GpuError::Lost(error.to_string()))
    }
}

/// Stores the error that others follow from: see [`cause`].
fn store_first(failure: &Mutex<Option<GpuError>>, error: GpuError) {
    let mut failure = failure.lock().unwrap_or_else(PoisonError::into_inner);
    *failure = Some(match failure.take() {
        Some(first) => cause(first, error),
        None => error,
    });
}

/// Which of two errors is told: exhausted memory, else that the device was lost, else the first.
fn cause(first: GpuError, second: GpuError) -> GpuError {
    let weight = |error: &GpuError| match error {
        GpuError::OutOfMemory(_) => 2,
        GpuError::Lost(_) => 1,
        _ => 0,
    };
    if weight(&second) > weight(&first) {
        second
    } else {
        first
    }
}

/// wgpu gives a device up where memory ends in the midst of work, and says why in words alone.
fn lost_because(reason: &str, message: &str) -> GpuError {
    let text = format!("{reason}: {message}");
    if message.to_lowercase().contains("out of memory") {
        GpuError::OutOfMemory(text)
    } else {
        GpuError::Lost(text)
    }
}

impl From<wgpu::Error> for GpuError {
    fn from(error: wgpu::Error) -> Self {
        match error {
            wgpu::Error::OutOfMemory { source } => Self::OutOfMemory(source.to_string()),
            wgpu::Error::Validation { description, .. }
            | wgpu::Error::Internal { description, .. } => Self::Refused(description),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn described(kinds: &[(&str, AdapterKind)]) -> Vec<AdapterDescription> {
        let one = |(index, &(name, kind)): (usize, &(&str, AdapterKind))| AdapterDescription {
            index,
            name: name.to_owned(),
            kind,
            backend: "vulkan".to_owned(),
            driver: String::new(),
            ray_queries: kind == AdapterKind::Discrete,
            largest_array: 1 << 30,
        };
        kinds.iter().enumerate().map(one).collect()
    }

    #[test]
    fn real_adapters_come_before_software() {
        let all = described(&[
            ("llvmpipe", AdapterKind::Software),
            ("Arc 140V", AdapterKind::Integrated),
            ("RTX 4090", AdapterKind::Discrete),
        ]);
        let place = |text: &str| text.parse::<AdapterChoice>().unwrap().among(&all);
        assert_eq!(place("best"), Ok(2));
        assert_eq!(place("0"), Ok(0));
        assert_eq!(place("arc"), Ok(1));
        assert_eq!(place("LLVM"), Ok(0));
        assert_eq!(AdapterChoice::Best.among(&[]), Err(GpuError::NoAdapter));
        let error = place("7").unwrap_err().to_string();
        assert!(
            error.contains("'7'") && error.contains("2: RTX 4090 (discrete, vulkan, ray queries)")
        );
    }

    #[test]
    fn what_other_errors_follow_from_is_told() {
        let memory = || GpuError::OutOfMemory(String::new());
        let lost = || lost_because("Unknown", "the driver crashed");
        let refused = || GpuError::Refused("buffer '' is invalid".to_owned());
        assert!(matches!(lost(), GpuError::Lost(_)));
        // In wgpu's words.
        let ended = lost_because("Unknown", "Out of memory");
        assert!(matches!(ended, GpuError::OutOfMemory(_)), "{ended}");
        for (first, second, told) in [
            (refused(), memory(), memory()),
            (memory(), refused(), memory()),
            (memory(), lost(), memory()),
            (refused(), lost(), lost()),
            (lost(), refused(), lost()),
        ] {
            assert_eq!(cause(first, second), told);
        }
    }
}
