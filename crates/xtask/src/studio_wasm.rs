//! `cargo xtask studio-wasm`: the studio for pages without a server, as one WebAssembly module.
//!
//! By the toolchain's own target where it is installed, else by Debian's compiler (`debian`). Where Node is there, the
//! module renders the built-in scene, and its mean is compared with that of this machine's code. Tests of pages have a
//! module of their own, of a profile that compiles faster.

mod debian;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use serde_json::{Value, json};
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::builtin;

use crate::{Result, workspace};

const TARGET: &str = "wasm32-unknown-unknown";
/// Largest difference of means over the mean: compilers round alike, but multiply and add in one step or two.
const NEAR: f64 = 1e-6;
/// Runs the module in Node.
const SCRIPT: &str = include_str!("studio_wasm/run.mjs");

/// What to build.
#[derive(clap::Args)]
pub(crate) struct StudioWasm {
    /// The module
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Do not run the module
    #[arg(long)]
    no_check: bool,
}

pub(crate) fn run(root: &Path, asked: &StudioWasm) -> Result<()> {
    let folder = folder(root);
    let debian = match has_target()? {
        true => None,
        false => {
            println!("no target {TARGET} (rustup target add {TARGET}): by Debian's compiler");
            Some(debian::Compiler::unpacked(&folder.join("debian"))?)
        }
    };
    let built = build(root, "wasm", debian.as_ref())?;
    if let Some(parent) = asked.output.parent() {
        std::fs::create_dir_all(parent)?;
    }
    let output = root.join(&asked.output);
    std::fs::copy(&built, &output)?;
    println!(
        "{}: {} bytes",
        output.display(),
        std::fs::metadata(&output)?.len()
    );
    if !asked.no_check {
        check(&output)?;
    }
    Ok(())
}

/// The module for tests of pages, built where something has changed; `None` where there is no compiler for it.
///
/// # Errors
/// Where it does not build.
pub(crate) fn for_tests(root: &Path) -> Result<Option<PathBuf>> {
    if has_target()? {
        return build(root, "wasm-test", None).map(Some);
    }
    let debian = debian::Compiler::present(&folder(root).join("debian"));
    debian
        .map(|debian| build(root, "wasm-test", Some(&debian)))
        .transpose()
}

/// How to have a compiler for it.
pub(crate) const REMEDY: &str = "rustup target add wasm32-unknown-unknown";

/// Where the modules are built.
fn folder(root: &Path) -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or(root.join("target"), PathBuf::from);
    target.join("studio-wasm")
}

/// Builds the module by a profile of the workspace; returns where it is.
fn build(root: &Path, profile: &str, debian: Option<&debian::Compiler>) -> Result<PathBuf> {
    let folder = folder(root);
    let mut build = workspace::cargo(root);
    build.args(["rustc", "--package", "specula-studio", "--lib", "--quiet"]);
    build.args(["--profile", profile, "--crate-type", "cdylib"]);
    build
        .args(["--target", TARGET, "--target-dir"])
        .arg(&folder);
    if let Some(debian) = debian {
        debian.apply(&mut build, &sysroot()?)?;
    }
    let begin = Instant::now();
    if !build.status()?.success() {
        return Err("specula-studio does not build for WebAssembly".into());
    }
    println!("built in {:.0} s", begin.elapsed().as_secs_f64());
    Ok(folder
        .join(TARGET)
        .join(profile)
        .join("specula_studio.wasm"))
}

/// Whether the toolchain has libraries for WebAssembly.
fn has_target() -> Result<bool> {
    Ok(sysroot()?.join("lib/rustlib").join(TARGET).exists())
}

/// The folder of the toolchain.
fn sysroot() -> Result<PathBuf> {
    let rustc = Command::new("rustc")
        .args(["--print", "sysroot"])
        .output()?;
    Ok(String::from_utf8(rustc.stdout)?.trim().into())
}

/// Size, seed and samples of the picture that is compared.
const SIZE: [u32; 2] = [64, 36];
const SEED: u32 = 1;
const SAMPLES: u32 = 4;

/// Renders in Node and here, and compares.
fn check(module: &Path) -> Result<()> {
    let [width, height] = SIZE;
    let requests = [
        json!({"ask": "render.scenes"}),
        json!({"ask": "render.open", "scene": "orbs", "width": width, "height": height, "seed": SEED}),
        json!({"ask": "render.advance", "session": 1, "samples": SAMPLES}),
    ];
    let mut node = Command::new("node");
    node.args(["--input-type=module", "-e", SCRIPT]).arg(module);
    node.args(requests.iter().map(Value::to_string));
    let Ok(ran) = node.output() else {
        println!("not run: no Node");
        return Ok(());
    };
    if !ran.status.success() {
        return Err(format!("Node: {}", String::from_utf8_lossy(&ran.stderr)).into());
    }
    let told: Value = serde_json::from_slice(&ran.stdout)?;
    let there = &told["answers"][2]["mean"];
    let there = [0, 1, 2].map(|i| there[i].as_f64().unwrap_or(f64::NAN));
    let (here, seconds) = mean()?;
    let off = [0, 1, 2].map(|i| (there[i] - here[i]).abs() / here[i]);
    println!("gzip: {} bytes", told["gzip"]);
    println!("mean {there:?} in Node, {here:?} here");
    let threads = rayon::current_num_threads();
    println!(
        "{SAMPLES} samples: {:.3} s in Node, {seconds:.3} s here by {threads} threads",
        told["seconds"].as_f64().unwrap_or(f64::NAN)
    );
    match off.iter().all(|&off| off <= NEAR) {
        true => Ok(()),
        false => Err(format!("the means differ by more than {NEAR:e}").into()),
    }
}

/// The mean of the same picture by this machine's code, and its seconds.
fn mean() -> Result<([f64; 3], f64)> {
    let scene = builtin::orbs();
    let options = RenderOptions {
        seed: SEED,
        resolution: Some(SIZE),
        crop: Some([0, SIZE[0], 0, SIZE[1]]),
        ..RenderOptions::from_scene(&scene)
    };
    let prepared = PreparedScene::consume(scene, &options)?;
    let begin = Instant::now();
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(SAMPLES, &AtomicBool::new(false));
    let seconds = begin.elapsed().as_secs_f64();
    let colour = renderer.film().colour();
    let sum = |i: usize| {
        colour
            .iter()
            .map(|c| f64::from(c.to_array()[i]))
            .sum::<f64>()
    };
    Ok(([0, 1, 2].map(|i| sum(i) / colour.len() as f64), seconds))
}
