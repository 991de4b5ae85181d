//! `cargo xtask python`: the Python package: built into its sources, its types checked, its tests run; or its wheel.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{Result, workspace};

/// The package's sources, from the workspace's root.
const SOURCES: &str = "crates/specula-py/python";
const TESTS: &str = "crates/specula-py/tests";
/// Those of the farm, which mostly wait for its nodes to start and to end.
const FARM_TESTS: &str = "crates/specula-py/tests/test_farm.py";
/// What runs the notebooks and writes their pages.
const NOTEBOOKS: &str = "crates/specula-py/tools/notebooks.py";

/// What tests need beside NumPy; wheels alone.
const TOOLS: &[&str] = &[
    "ipykernel>=6.29",
    "latex2mathml>=3.77",
    "matplotlib>=3.7",
    "mitsuba==3.9.1",
    "mypy>=1.15",
    "nbclient>=0.10",
    "nbformat>=5.10",
    "numpy>=1.24",
    "openjd-cli>=0.8",
    "pandas>=2.2",
    "pytest>=8",
    "ray[client]>=2.52",
    "scipy>=1.11",
    "trimesh>=4",
];

/// What makes wheels.
const WHEEL_TOOLS: &[&str] = &["maturin[zig]>=1.16,<2"];

/// What to do with the Python package.
#[derive(clap::Args, Default)]
pub(crate) struct Python {
    /// Make a wheel for Linux in `dist` instead: optimised, for glibc 2.17 and CPython 3.10 and newer
    #[arg(long)]
    wheel: bool,
    /// Run the notebooks and write them as pages of the book, with their outputs
    #[arg(long, conflicts_with_all = ["wheel", "build"])]
    notebooks: bool,
    /// Only build the extension module into the package's sources
    #[arg(long, conflicts_with = "wheel")]
    build: bool,
}

/// Does what was asked for.
pub(crate) fn run(root: &Path, python: &Python) -> Result<()> {
    if python.wheel {
        return wheel(root);
    }
    build(root)?;
    if python.build {
        return Ok(());
    }
    if python.notebooks {
        return notebooks(root);
    }
    check(root)
}

/// Measures the farm on two nodes: starts, kills, efficiency, an animation, merging.
///
/// * `scenarios`: all where there are none.
pub(crate) fn farm(root: &Path, scenarios: &[String]) -> Result<()> {
    build(root)?;
    let python = environment(root, "python", TOOLS)?;
    // What users have is optimised: the program of the tests takes longer to begin and to write films.
    let mut program = workspace::cargo(root);
    program.args([
        "build",
        "--release",
        "--quiet",
        "-p",
        "specula",
        "--features",
        "full",
    ]);
    if !program.status()?.success() {
        return Err("the program does not build".into());
    }
    let mut bench = Command::new(&python);
    bench.env("SPECULA_FARM_PROGRAM", root.join("target/release/specula"));
    bench
        .current_dir(root)
        .env("PYTHONPATH", root.join(SOURCES));
    bench
        .arg("crates/specula-py/benches/farm.py")
        .args(scenarios);
    succeed(bench, "the farm")
}

/// Builds the extension module as tests are built, all of whose parts it shares, and copies it beside the package's sources.
fn build(root: &Path) -> Result<()> {
    let mut build = workspace::cargo(root);
    build.args(["build", "--workspace", "--tests", "--lib", "--quiet"]);
    build.args(["--profile", "test", "--features", "specula/full"]);
    if !build.status()?.success() {
        return Err("the extension module does not build".into());
    }
    let name = format!(
        "{}_native{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    let built = root.join("target/debug").join(name);
    let ending = if cfg!(windows) { "pyd" } else { "abi3.so" };
    let to = root
        .join(SOURCES)
        .join(format!("specula_render/_native.{ending}"));
    // A new file: a process may have the old one loaded.
    let _ = fs::remove_file(&to);
    fs::copy(&built, &to)?;
    Ok(())
}

/// Pages of the notebooks, in the book.
fn notebooks(root: &Path) -> Result<()> {
    let python = environment(root, "python", TOOLS)?;
    let mut pages = Command::new(&python);
    pages.current_dir(root).arg(NOTEBOOKS);
    pages.env("PYTHONPATH", root.join(SOURCES));
    pages.env("PYTHONDONTWRITEBYTECODE", "1");
    succeed(pages, "notebooks")
}

/// Types, stubs and tests; those of the farm beside the others.
fn check(root: &Path) -> Result<()> {
    let python = environment(root, "python", TOOLS)?;
    let sources = root.join(SOURCES);
    let in_package = |module: &str| {
        let mut command = Command::new(&python);
        command.current_dir(root).args(["-m", module]);
        command
            .env("PYTHONPATH", &sources)
            .env("MYPYPATH", &sources);
        // Caches are in the target folder, not among the sources.
        command.env("PYTHONDONTWRITEBYTECODE", "1");
        command
    };
    let values = values(root)?;
    let pytest = |arguments: &[&str]| {
        let mut tests = in_package("pytest");
        tests.args(["--quiet", "-p", "no:cacheprovider", "--durations", "5"]);
        tests.args(arguments).env("SPECULA_VALUES", &values);
        tests
    };
    let mut farm = pytest(&[FARM_TESTS]);
    std::thread::scope(|scope| {
        let farm = scope.spawn(move || farm.output());
        let others = check_but_farm(&in_package, &pytest);
        let farm = farm
            .join()
            .map_err(|_| "the farm's tests cannot be run")??;
        std::io::stdout().write_all(&farm.stdout)?;
        std::io::stderr().write_all(&farm.stderr)?;
        others?;
        match farm.status.success() {
            true => Ok(()),
            false => Err("Python: tests of the farm fail".into()),
        }
    })
}

/// Types, stubs and tests but for those of the farm.
fn check_but_farm(
    in_package: &dyn Fn(&str) -> Command,
    pytest: &dyn Fn(&[&str]) -> Command,
) -> Result<()> {
    let mut types = in_package("mypy");
    types.args(["--cache-dir", "target/mypy", "--package", "specula_render"]);
    succeed(types, "types")?;
    let mut stubs = in_package("mypy.stubtest");
    stubs.args(["specula_render._native", "--ignore-missing-stub"]);
    succeed(stubs, "stubs")?;
    succeed(pytest(&["--ignore", FARM_TESTS, TESTS]), "tests")
}

/// The file of values that Rust computes, with which tests compare theirs.
fn values(root: &Path) -> Result<PathBuf> {
    let mut run = workspace::cargo(root);
    run.args([
        "run",
        "--quiet",
        "--package",
        "specula-bsdf",
        "--example",
        "values",
    ]);
    let printed = run.output()?;
    if !printed.status.success() {
        return Err(String::from_utf8_lossy(&printed.stderr).into());
    }
    let path = root.join("target/values.txt");
    fs::write(&path, printed.stdout)?;
    Ok(path)
}

fn succeed(mut command: Command, what: &str) -> Result<()> {
    match command.status()?.success() {
        true => Ok(()),
        false => Err(format!("Python: {what} fail").into()),
    }
}

/// An optimised wheel in `dist`, and its size.
fn wheel(root: &Path) -> Result<()> {
    let python = environment(root, "wheel", WHEEL_TOOLS)?;
    let mut build = Command::new(&python);
    build.current_dir(root).args(["-m", "maturin", "build"]);
    build.args(["--release", "--out", "dist"]);
    if cfg!(target_os = "linux") {
        // Zig's linker takes the symbols of an old glibc. It is a package of the environment's interpreter, which need
        // not be the first one on the path.
        build.args(["--zig", "--compatibility", "manylinux2014"]);
        build.env("CARGO_ZIGBUILD_PYTHON_PATH", &python);
    }
    succeed(build, "the wheel")?;
    for entry in fs::read_dir(root.join("dist"))? {
        let entry = entry?;
        let size = entry.metadata()?.len();
        println!("{}: {} kB", entry.path().display(), size / 1000);
    }
    Ok(())
}

/// The interpreter of a virtual environment in the target folder that has these packages.
fn environment(root: &Path, name: &str, packages: &[&str]) -> Result<PathBuf> {
    let folder = root.join("target").join(format!("{name}-environment"));
    let python = match cfg!(windows) {
        true => folder.join("Scripts/python.exe"),
        false => folder.join("bin/python"),
    };
    if !python.exists() {
        let mut make = Command::new("python3");
        make.args(["-m", "venv"]).arg(&folder);
        succeed(make, "the virtual environment")?;
    }
    let mut install = Command::new(&python);
    install.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
    ]);
    install.args(packages);
    succeed(install, "packages")?;
    Ok(python)
}
