//! `cargo xtask gpu-report`: the report about a GPU, published, and the shaders' proofs on that GPU.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;

use crate::{Result, workspace};

/// What to report.
#[derive(Args)]
pub(crate) struct GpuReport {
    /// Specula [default: built from this workspace]
    #[arg(long, value_name = "PROGRAM")]
    specula: Option<PathBuf>,
    /// Publish this report of another machine instead
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
    /// Leave out the parity suite: every shader function beside its twins
    #[arg(long)]
    no_parity: bool,
    /// Passed on to `specula gpu-report`
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

/// Measures the GPU, and writes `docs/gpu`: a folder for each GPU, and a list of them.
pub(crate) fn run(root: &Path, options: &GpuReport) -> Result<()> {
    let report = match &options.from {
        Some(file) => fs::read_to_string(file)?,
        None => measured(root, options)?,
    };
    let docs = root.join("docs/gpu");
    let name = title(&report).ok_or("the report has no title")?;
    let folder = docs.join(folder_name(name));
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("README.md"), &report)?;
    fs::write(docs.join("README.md"), list(&docs)?)?;
    println!("wrote {}", folder.display());
    if options.from.is_none() && !options.no_parity {
        let status = workspace::cargo(root)
            .args(["test", "--package", "specula-gpu", "--test", "parity"])
            .env("SPECULA_GPU", "require")
            .status()?;
        if !status.success() {
            return Err("shader functions differ from their twins".into());
        }
    }
    Ok(())
}

fn measured(root: &Path, options: &GpuReport) -> Result<String> {
    let program = workspace::program_with(root, options.specula.as_deref(), "full")?;
    let folder = root.join("target/gpu-report");
    let status = Command::new(program)
        .arg("gpu-report")
        .arg("-o")
        .arg(&folder)
        .args(&options.arguments)
        .status()?;
    if !status.success() {
        return Err("the report failed".into());
    }
    Ok(fs::read_to_string(folder.join("README.md"))?)
}

fn title(report: &str) -> Option<&str> {
    report.lines().next()?.strip_prefix("# ")
}

/// Letters and digits of a GPU's name, in lower case, with hyphens between its words; without what is in brackets.
fn folder_name(name: &str) -> String {
    let name = name.replace("(R)", "").replace("(TM)", "");
    let name = name.split('(').next().unwrap_or_default().to_lowercase();
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("-")
}

/// The page that lists all reports.
fn list(docs: &Path) -> Result<String> {
    let mut folders: Vec<PathBuf> = fs::read_dir(docs)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.join("README.md").is_file())
        .collect();
    folders.sort();
    let mut text = HEAD.to_owned();
    for folder in folders {
        let report = fs::read_to_string(folder.join("README.md"))?;
        let name = title(&report).unwrap_or_default();
        let place = folder.file_name().unwrap_or_default().to_string_lossy();
        let facts = report.lines().filter_map(|line| line.strip_prefix("- "));
        let facts: Vec<&str> = facts.take(4).collect();
        let _ = writeln!(text, "\n## [{name}]({place}/README.md)\n");
        for fact in facts {
            let _ = writeln!(text, "- {fact}");
        }
    }
    Ok(text)
}

const HEAD: &str = "\
# GPUs that have been measured

    specula gpu-report          a report about yours, to gpu-report/README.md
    cargo xtask gpu-report      the same, published here, and every shader function beside its twins

Whether pictures are the processor's, what samplers cost beside the papers' figures, rays a second, renders a second
beside the processor's.
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_named_after_gpus() {
        assert_eq!(
            folder_name("NVIDIA H100 80GB HBM3"),
            "nvidia-h100-80gb-hbm3"
        );
        assert_eq!(folder_name("llvmpipe (LLVM 15.0.6, 256 bits)"), "llvmpipe");
        assert_eq!(folder_name("Intel(R) Arc(TM) A770"), "intel-arc-a770");
    }
}
