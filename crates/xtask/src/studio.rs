//! `cargo xtask studio`: the studio's pages: their types, the committed bundle, tests in a browser; or a new bundle.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use crate::{Result, studio_wasm, workspace};

/// The pages' sources, from the workspace's root.
const PAGES: &str = "crates/specula-studio-server/web";

/// Where distributions install Chromium; `SPECULA_CHROMIUM` names another.
const BROWSER: &str = "/usr/bin/chromium";

/// What to do with the pages.
#[derive(clap::Args, Default)]
pub(crate) struct Studio {
    /// Only write the bundle from its sources
    #[arg(long)]
    build: bool,
    /// Test exported pages with this module, as `cargo xtask studio-wasm` makes it (also by SPECULA_STUDIO_WASM)
    /// [default: one that is built for tests]
    #[arg(long, value_name = "FILE")]
    wasm: Option<PathBuf>,
}

/// Does what was asked for.
pub(crate) fn run(root: &Path, studio: &Studio) -> Result<()> {
    let pages = root.join(PAGES);
    install(&pages)?;
    if studio.build {
        return npm(&pages, &["run", "--silent", "build"]);
    }
    check(root)?;
    let browser = std::env::var_os("SPECULA_CHROMIUM").map_or(BROWSER.into(), PathBuf::from);
    if !browser.exists() {
        let why = format!("no browser at {}", browser.display());
        specula_testing::skip("the studio's pages", why, "install chromium");
        return Ok(());
    }
    test(root, module(root, studio)?.as_ref())
}

/// The library in WebAssembly: the module that is named, or one for tests; `None` where nothing here compiles it.
fn module(root: &Path, studio: &Studio) -> Result<Option<PathBuf>> {
    let named = std::env::var_os("SPECULA_STUDIO_WASM").map(PathBuf::from);
    if let Some(named) = studio.wasm.clone().or(named) {
        return Ok(Some(named));
    }
    let built = studio_wasm::for_tests(root)?;
    if built.is_none() {
        let why = "no compiler for WebAssembly";
        specula_testing::skip("exported pages that compute", why, studio_wasm::REMEDY);
    }
    Ok(built)
}

/// The tests of every page in a browser: of the program, and of what it exports.
fn test(root: &Path, wasm: Option<&PathBuf>) -> Result<()> {
    let program = program(root)?;
    let site = target(root).join("studio-site");
    if site.exists() {
        std::fs::remove_dir_all(&site)?;
    }
    let mut export = Command::new(&program);
    export.args(["studio", "--export"]).arg(&site);
    if let Some(wasm) = wasm {
        export.arg("--wasm").arg(root.join(wasm));
    }
    succeed(export, "--export")?;
    let server = Server::start(root, &program)?;
    let mut tests = Command::new("npm");
    tests.current_dir(root.join(PAGES));
    tests.args(["run", "--silent", "test"]);
    tests.env("STUDIO", &server.address).env("SITE", &site);
    tests.env("PROGRAM", &program);
    succeed(tests, "tests")
}

/// Types, and whether the bundle is what the sources give.
fn check(root: &Path) -> Result<()> {
    let pages = root.join(PAGES);
    install(&pages)?;
    npm(&pages, &["run", "--silent", "check"])?;
    npm(&pages, &["run", "--silent", "build", "--", "--check"])
}

/// The packages of the lock file.
fn install(pages: &Path) -> Result<()> {
    let lock = pages.join("package-lock.json");
    let installed = pages.join("node_modules/.package-lock.json");
    let modified = |path: &PathBuf| path.metadata().and_then(|m| m.modified()).ok();
    if modified(&installed).is_some_and(|at| modified(&lock).is_some_and(|lock| at >= lock)) {
        return Ok(());
    }
    npm(pages, &["ci", "--silent"])
}

fn npm(pages: &Path, arguments: &[&str]) -> Result<()> {
    let mut command = Command::new("npm");
    command.current_dir(pages).args(arguments);
    succeed(command, &format!("`npm {}`", arguments.join(" ")))
}

fn succeed(mut command: Command, what: &str) -> Result<()> {
    let status = command.status();
    let status = status
        .map_err(|e| format!("{what} cannot be run (pages need Node.js 20 or newer): {e}"))?;
    match status.success() {
        true => Ok(()),
        false => Err(format!("studio: {what} failed").into()),
    }
}

fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or(root.join("target"), PathBuf::from)
}

/// The program, built as tests are built.
fn program(root: &Path) -> Result<PathBuf> {
    let mut build = workspace::cargo(root);
    build.args([
        "build",
        "--workspace",
        "--tests",
        "--lib",
        "--bins",
        "--quiet",
    ]);
    build.args(["--profile", "test", "--features", "specula/full"]);
    if !build.status()?.success() {
        return Err("the program does not build".into());
    }
    let name = format!("specula{}", std::env::consts::EXE_SUFFIX);
    Ok(target(root).join("debug").join(name))
}

/// `specula studio`, until it is dropped.
struct Server {
    process: Child,
    address: String,
}

impl Server {
    fn start(root: &Path, program: &Path) -> Result<Self> {
        let mut command = Command::new(program);
        command.current_dir(root).args(["studio", "--no-open"]);
        let mut process = command.stdout(Stdio::piped()).spawn()?;
        let output = process.stdout.take().ok_or("no output")?;
        // Made before anything can fail, so that the process ends in any case.
        let mut server = Self {
            process,
            address: String::new(),
        };
        let mut lines = BufReader::new(output).lines();
        while let Some(line) = lines.next().transpose()? {
            if let Some(at) = line.find("http://") {
                let address = line[at..].split_whitespace().next();
                server.address = address.unwrap_or_default().to_owned();
                return Ok(server);
            }
        }
        Err("`specula studio` printed no address".into())
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
