//! Chores of the Specula workspace: `cargo xtask help`.
#![forbid(unsafe_code)]
#![allow(clippy::print_stdout, reason = "a command line reports on stdout")]

mod albedo;
mod bench;
mod book;
mod c_library;
mod energy_fit;
mod exact;
mod feature_sets;
mod features;
mod generated;
mod gltf;
mod gpu_report;
mod instructions;
mod interface;
mod interface_single;
mod lint;
mod memory;
mod metals;
mod msrv;
mod mutants;
mod no_std;
mod plastic;
mod profile;
mod python;
mod rays;
mod scaling;
mod soak;
mod studio;
mod studio_wasm;
mod suite;
mod tables;
mod tidy;
mod versus;
mod workspace;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// What a chore returns: any error is printed and makes the exit code 1.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Chores of the Specula workspace.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Write the tables of measured metals from data/metals
    Metals {
        /// Write nothing; fail where a committed table differs
        #[arg(long, conflicts_with = "extract")]
        check: bool,
        /// Write data/metals first, from a folder of the refractiveindex.info database (the one
        /// that holds `database/data`)
        #[arg(long, value_name = "DIR")]
        extract: Option<PathBuf>,
    },
    /// Write every generated table
    Tables {
        /// Write nothing; fail where a committed table differs
        #[arg(long)]
        check: bool,
    },
    /// Everything that must pass: tests, format, lints, documentation, tables, tidiness
    Test(suite::Suite),
    /// Check the format, lints, documentation, and some sets of features
    Lint,
    /// Check that every set of features that users choose compiles
    Features,
    /// Try faults made by machine in `specula-bsdf`: which do its tests notice?
    Mutants(mutants::Sample),
    /// Build the Python package into its sources, check its types, run its tests; or make its wheel
    Python(python::Python),
    /// Measure the farm on two nodes of Ray in a network namespace: starts, kills, efficiency, an animation, merging
    Farm {
        /// tasks, animation, kills, efficiency, merging [default: all]
        scenarios: Vec<String>,
    },
    /// Check the studio's pages: types, the committed bundle, tests in a browser; or write the bundle
    Studio(studio::Studio),
    /// Build the C interface and lay it out below a prefix: header, libraries, pkg-config, CMake
    CLibrary(c_library::CLibrary),
    /// Run the benches
    Bench {
        /// Passed on to `cargo bench --workspace`
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Print what the sampler of exact reflections rejects and saves
    Exact {
        /// Sample this many reflections in f32 instead [default: 10^9], and fail if more than one in
        /// 10^6 lies below the surface
        #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "1000000000")]
        fuzz: Option<u64>,
        /// Write the figure of the document instead
        #[arg(long, conflicts_with = "fuzz")]
        figure: bool,
    },
    /// Count the kernels' instructions under valgrind, and record the counts
    Instructions {
        /// Write nothing; fail where a count is off by more than 5 %
        #[arg(long)]
        check: bool,
    },
    /// Check `specula-bsdf` with the oldest compiler that its manifest names
    Msrv,
    /// Check `specula-bsdf` for a machine without a standard library
    NoStd,
    /// Measure a GPU, prove its shaders, and write docs/gpu
    GpuReport(gpu_report::GpuReport),
    /// Compare with other renderers: time to equal error
    Versus(Box<versus::Versus>),
    /// Count where the instructions of a render go, under valgrind
    Profile(profile::Profile),
    /// Measure the gain of a second thread, and the cost of a sample against the triangles
    Scaling(scaling::Scaling),
    /// Compare ray casting with Embree, and with itself over the number of triangles
    Rays(rays::Rays),
    /// Compare the memory that renders say they take with what they take
    Memory(memory::Memory),
    /// Render for an hour, and fail where its memory grows
    Soak(soak::Soak),
    /// Build the studio for pages without a server as a WebAssembly module, and compare a render of it
    StudioWasm(studio_wasm::StudioWasm),
    /// Build the guide as a book in target/book, and fail where a link is dead
    Book(book::Book),
    /// Check what no compiler checks: file heads, lengths, leftovers, trailing spaces
    Tidy,
}

fn main() -> ExitCode {
    match run(&Arguments::parse().chore) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(chore: &Chore) -> Result<()> {
    let root = workspace::root();
    match chore {
        Chore::Metals { check, extract } => {
            if let Some(folder) = extract {
                metals::extract(&root, folder)?;
            }
            generated::apply(&root, &metals::generate(&root)?, *check)
        }
        Chore::Tables { check } => tables::run(&root, *check),
        Chore::Test(suite) => suite::run(&root, suite),
        Chore::Python(python) => python::run(&root, python),
        Chore::Farm { scenarios } => python::farm(&root, scenarios),
        Chore::Features => feature_sets::run(&root, feature_sets::Which::All),
        Chore::Lint => lint::run(&root),
        Chore::Studio(studio) => studio::run(&root, studio),
        Chore::CLibrary(arguments) => c_library::run(&root, arguments),
        Chore::Mutants(sample) => mutants::run(&root, sample),
        Chore::Bench { arguments } => bench::run(&root, arguments),
        Chore::Exact { figure: true, .. } => {
            generated::apply(&root, &exact::generate(&root)?, false)
        }
        Chore::Exact { fuzz, .. } => exact::run(*fuzz),
        Chore::Instructions { check } => instructions::run(&root, *check),
        Chore::Msrv => msrv::run(&root),
        Chore::NoStd => no_std::run(&root),
        Chore::GpuReport(report) => gpu_report::run(&root, report),
        Chore::Versus(versus) => versus::run(&root, versus),
        Chore::Profile(profile) => profile::run(&root, profile),
        Chore::Scaling(scaling) => scaling::run(&root, scaling),
        Chore::Rays(rays) => rays::run(&root, rays),
        Chore::Memory(memory) => memory::run(&root, memory),
        Chore::Soak(soak) => soak::run(&root, soak),
        Chore::StudioWasm(arguments) => studio_wasm::run(&root, arguments),
        Chore::Book(book) => book::run(&root, book),
        Chore::Tidy => tidy::run(&root),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
        assert!(Arguments::try_parse_from(["x", "metals", "--check", "--extract", "d"]).is_err());
        assert!(Arguments::try_parse_from(["x", "bench", "--bench", "samplers"]).is_ok());
    }
}
