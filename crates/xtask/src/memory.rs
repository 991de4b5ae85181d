//! `cargo xtask memory`: what renders said that they would take of memory, and what they took.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use clap::Args;

use crate::soak::field;
use crate::{Result, workspace};

/// Between two readings.
const EVERY: Duration = Duration::from_millis(2);

/// What is rendered.
#[derive(Args)]
pub(crate) struct Memory {
    /// Scenes, each rendered with one sample at its own resolution
    #[arg(value_name = "FILE", required = true)]
    scenes: Vec<PathBuf>,
    /// Threads of the renders
    #[arg(long, value_name = "N", default_value_t = 2)]
    threads: u32,
    /// Specula [default: built from this workspace]
    #[arg(long, value_name = "PROGRAM")]
    specula: Option<PathBuf>,
    /// Write the table to docs/memory.md
    #[arg(long)]
    publish: bool,
}

/// A render's memory, in mebibytes.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    scene: String,
    /// At most, by what it said before it began.
    told: f64,
    taken: f64,
}

/// Renders every scene, prints the table, and fails where one took more than it said.
pub(crate) fn run(root: &Path, memory: &Memory) -> Result<()> {
    let program = workspace::program(root, memory.specula.as_deref())?;
    let output = root.join("target/memory.exr");
    let mut rows = Vec::new();
    for scene in &memory.scenes {
        let row = measured(&program, scene, &output, memory.threads)?;
        println!("{:>8.0} {:>8.0}  {}", row.told, row.taken, row.scene);
        rows.push(row);
    }
    if memory.publish {
        let path = root.join("docs/memory.md");
        std::fs::write(&path, page(&rows, memory.threads))?;
        println!("wrote {}", path.display());
    }
    match rows.iter().find(|row| row.taken > row.told) {
        Some(row) => Err(format!("{} took more than it said", row.scene).into()),
        None => Ok(()),
    }
}

fn measured(program: &Path, scene: &Path, output: &Path, threads: u32) -> Result<Row> {
    let name = scene.file_name().unwrap_or(scene.as_os_str());
    let scene_name = name.to_string_lossy().into_owned();
    let log = output.with_extension("log");
    let mut child = Command::new(program)
        .args(["render", "--spp", "1", "--restart", "--threads"])
        .arg(threads.to_string())
        .arg("-o")
        .args([output, scene])
        .stderr(std::fs::File::create(&log)?)
        .stdout(Stdio::null())
        .spawn()?;
    let status = format!("/proc/{}/status", child.id());
    let mut taken = None;
    while child.try_wait()?.is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        taken = field(&text, "VmHWM:").or(taken);
        std::thread::sleep(EVERY);
    }
    let messages = std::fs::read_to_string(&log)?;
    if !child.wait()?.success() {
        return Err(format!("{scene_name} was not rendered:\n{messages}").into());
    }
    Ok(Row {
        told: told(&messages).ok_or_else(|| format!("{scene_name} said nothing:\n{messages}"))?,
        taken: taken.ok_or("the system does not tell what a process takes")?,
        scene: scene_name,
    })
}

/// Mebibytes of a line such as `memory: at most 1.50 GiB (...)`.
fn told(messages: &str) -> Option<f64> {
    let mut lines = messages.lines();
    let line = lines.find_map(|l| l.strip_prefix("memory: at most "))?;
    let mut words = line.split_whitespace();
    let value: f64 = words.next()?.parse().ok()?;
    match words.next()? {
        "MiB" => Some(value),
        "GiB" => Some(value * 1024.0),
        _ => None,
    }
}

fn page(rows: &[Row], threads: u32) -> String {
    let mut text = format!(
        "# Memory, told and taken\n\n\
         Before it begins, a render says how much memory it takes at most; `--max-memory` holds it to \
         that. The table has what\nit said and the most that was resident, at the scene's own \
         resolution, with one sample a pixel and {threads} threads.\nMade by \
         `cargo xtask memory --publish FILE...`, which fails where one took more than it said.\n\n\
         | scene | told (MiB) | taken (MiB) | taken of told |\n|---|---:|---:|---:|\n"
    );
    for row in rows {
        let share = 100.0 * row.taken / row.told;
        // Writing to a text cannot fail.
        let _ = writeln!(
            text,
            "| {} | {:.0} | {:.0} | {share:.0} % |",
            row.scene, row.told, row.taken
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_and_written() {
        let messages = "x\nmemory: at most 1.50 GiB (film 1 GiB)\ny";
        assert_eq!(told(messages), Some(1536.0));
        assert_eq!(told("memory: at most 15.5 MiB (film)"), Some(15.5));
        assert_eq!(told("memory: much"), None);
        let row = Row {
            scene: "a.pbrt".to_owned(),
            told: 200.0,
            taken: 190.0,
        };
        let page = page(&[row], 2);
        assert!(page.ends_with("| a.pbrt | 200 | 190 | 95 % |\n"), "{page}");
    }
}
