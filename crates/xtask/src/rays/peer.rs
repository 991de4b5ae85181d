//! Embree from its shared library, through a small C program that answers.

use std::fs::{self, File};
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use super::meshes::Mesh;
use super::sets::Set;
use crate::Result;

/// A running peer, which ends when its input does.
pub(super) struct Peer {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    /// Seconds of processor and of the clock that its tree took.
    pub(super) build: [f64; 2],
    /// Bytes that its tree added to its memory.
    pub(super) bytes: f64,
}

/// Writes what the peer reads.
pub(super) fn write(folder: &Path, mesh: &Mesh, sets: &[Set]) -> Result<()> {
    fs::create_dir_all(folder)?;
    let create = |name: &str| -> Result<BufWriter<File>> {
        Ok(BufWriter::new(File::create(
            folder.join(format!("{name}.bin")),
        )?))
    };
    let mut file = create("positions")?;
    for x in mesh.positions.iter().flatten() {
        file.write_all(&x.to_le_bytes())?;
    }
    file.flush()?;
    let mut file = create("triangles")?;
    for index in mesh.triangles.iter().flatten() {
        file.write_all(&index.to_le_bytes())?;
    }
    file.flush()?;
    for set in sets {
        let mut file = create(set.name)?;
        for ray in &set.rays {
            let [a, b, c] = ray.origin.to_array();
            let [d, e, f] = ray.direction.to_array();
            for x in [a, b, c, d, e, f, ray.t_max] {
                file.write_all(&x.to_le_bytes())?;
            }
        }
        file.flush()?;
    }
    Ok(())
}

/// How rays are handed to Embree: how many a call, and what it is told of them.
pub(super) const CALLS: [&str; 3] = ["1 incoherent", "16 incoherent", "16 coherent"];

/// Compiles the program, with optimisation, into `folder`.
pub(super) fn compile(source: &Path, folder: &Path) -> Result<PathBuf> {
    fs::create_dir_all(folder)?;
    let program = folder.join("embree_peer");
    let status = Command::new("cc")
        .args(["-std=c11", "-O3", "-march=native", "-Wall", "-Wextra", "-o"])
        .args([&program, source])
        .arg("-ldl")
        .status()
        .map_err(|e| format!("cc: {e}"))?;
    if status.success() {
        Ok(program)
    } else {
        Err(format!("cc: {status}").into())
    }
}

impl Peer {
    /// Starts it on what [`write()`] left in `folder`; its tree is built by `threads`.
    ///
    /// * `library`: Embree 4, `libembree4.so`.
    pub(super) fn start(
        program: &Path,
        library: &Path,
        folder: &Path,
        threads: usize,
    ) -> Result<Self> {
        let mut child = Command::new(program)
            .args([library, folder])
            .arg(threads.to_string())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|e| format!("{}: {e}", program.display()))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("the peer has no pipes".into());
        };
        let mut peer = Self {
            child,
            input: Some(input),
            output: BufReader::new(output),
            build: [0.0; 2],
            bytes: 0.0,
        };
        let [processor, clock, bytes] = peer.answer()?;
        peer.build = [processor, clock];
        peer.bytes = bytes;
        Ok(peer)
    }

    /// Seconds of processor for a set, and how many rays hit.
    ///
    /// * `call`: one of [`CALLS`].
    pub(super) fn trace(&mut self, set: &Set, call: &str) -> Result<(f64, f64)> {
        let query = if set.any { "any" } else { "closest" };
        self.ask(&format!("{} {query} {call}", set.name))
    }

    fn ask(&mut self, question: &str) -> Result<(f64, f64)> {
        let input = self.input.as_mut().ok_or("the peer has ended")?;
        writeln!(input, "{question}")?;
        input.flush()?;
        let [seconds, hits] = self.answer()?;
        Ok((seconds, hits))
    }

    fn answer<const N: usize>(&mut self) -> Result<[f64; N]> {
        let mut line = String::new();
        self.output.read_line(&mut line)?;
        let numbers: std::result::Result<Vec<f64>, _> =
            line.split_whitespace().map(str::parse).collect();
        numbers
            .ok()
            .and_then(|n| n.try_into().ok())
            .ok_or_else(|| format!("the peer answered `{}`", line.trim()).into())
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        drop(self.input.take());
        let _ = self.child.wait();
    }
}

/// Where the program's source is.
pub(super) fn source(root: &Path) -> PathBuf {
    root.join("data/rays/embree_peer.c")
}
