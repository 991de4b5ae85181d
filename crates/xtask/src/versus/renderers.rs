//! The renderers as programs: one process per picture, or one that serves many.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Text};

use crate::Result;

/// Clock ticks of `/proc` in a second: Linux's fixed unit.
const TICKS: f64 = 100.0;

/// What one picture took, loading apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timing {
    /// Seconds by the clock.
    pub(crate) wall: f64,
    /// Seconds of all threads, of user and system.
    pub(crate) cpu: f64,
    /// Samples per pixel that were taken.
    pub(crate) spp: u32,
}

/// Something that renders the scene it was made for.
pub(crate) trait Engine {
    /// Renders `spp` samples per pixel to the EXR file `target`.
    fn render(&mut self, sampler: &str, spp: u32, seed: u32, target: &Path) -> Result<Timing>;
    /// Name and version.
    fn version(&self) -> String;
}

/// Specula, a process per picture.
pub(crate) struct Specula {
    pub(crate) program: PathBuf,
    pub(crate) scene: PathBuf,
    pub(crate) threads: u32,
    /// As `specula render --device` takes it.
    pub(crate) device: String,
    /// CPU seconds of writing the picture, found by the first render.
    pub(crate) writing: Option<f64>,
}

impl Specula {
    /// No option at all; as many samples everywhere; spread by their error, paths alone and shared between
    /// so many pixels.
    pub(crate) const SAMPLERS: [&'static str; 5] = [
        "default",
        "sobol",
        "adaptive",
        "adaptive, 8 share",
        "adaptive, 16 share",
    ];

    /// The options that a name in [`SAMPLERS`](Self::SAMPLERS) stands for; those but of the first say all
    /// that they can, whatever the defaults are.
    fn options(sampler: &str) -> &'static [&'static str] {
        match sampler {
            "sobol" => &["--adaptive=off", "--share-paths", "1"],
            "adaptive" => &["--adaptive", "--share-paths", "1"],
            "adaptive, 8 share" => &["--adaptive", "--share-paths", "8"],
            "adaptive, 16 share" => &["--adaptive", "--share-paths", "16"],
            _ => &[],
        }
    }

    /// Wall time is the one that the picture holds; CPU time is counted from the line that says that
    /// the scene is ready to the end.
    fn process(&self, sampler: &str, spp: u32, seed: u32, target: &Path) -> Result<Timing> {
        let before = children_cpu()?;
        let mut child = Command::new(&self.program)
            .args(["render", "--checkpoint", "off"])
            .args(["--threads", &self.threads.to_string()])
            .args(["--device", &self.device])
            .args(["--spp", &spp.to_string(), "--seed", &seed.to_string()])
            .args(Self::options(sampler))
            .arg("-o")
            .arg(target)
            .arg(&self.scene)
            .stderr(Stdio::piped())
            .spawn()?;
        let (mut loading, mut said) = (0.0, String::new());
        if let Some(stderr) = child.stderr.take() {
            for line in BufReader::new(stderr).lines() {
                let line = line?;
                if line.contains("ready after") {
                    loading = process_cpu(child.id())?;
                }
                said.push_str(&line);
                said.push('\n');
            }
        }
        if !child.wait()?.success() {
            return Err(format!("specula failed:\n{said}").into());
        }
        Ok(Timing {
            wall: render_seconds(target)?,
            cpu: children_cpu()? - before - loading,
            spp,
        })
    }
}

impl Engine for Specula {
    fn render(&mut self, sampler: &str, spp: u32, seed: u32, target: &Path) -> Result<Timing> {
        let writing = match self.writing {
            Some(writing) => writing,
            None => {
                let one = self.process(sampler, 1, seed, target)?.cpu;
                let two = self.process(sampler, 2, seed, target)?.cpu;
                (2.0 * one - two).clamp(0.0, one)
            }
        };
        self.writing = Some(writing);
        let timing = self.process(sampler, spp, seed, target)?;
        Ok(Timing {
            cpu: timing.cpu - writing,
            ..timing
        })
    }

    fn version(&self) -> String {
        let output = Command::new(&self.program).arg("--version").output();
        let text = output.map(|o| String::from_utf8_lossy(&o.stdout).trim().to_owned());
        text.unwrap_or_default()
    }
}

/// pbrt-v4, a process per picture; pictures of one pixel stand for loading.
pub(crate) struct Pbrt {
    pub(crate) program: PathBuf,
    pub(crate) scene: PathBuf,
    pub(crate) threads: u32,
    pub(crate) loading: Option<[f64; 2]>,
}

impl Pbrt {
    fn process(&self, options: &[&str], target: &Path) -> Result<[f64; 2]> {
        let (before, start) = (children_cpu()?, Instant::now());
        let output = Command::new(&self.program)
            .args(["--quiet", "--nthreads", &self.threads.to_string()])
            .args(options)
            .arg("--outfile")
            .arg(target)
            .arg(&self.scene)
            .output()?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(format!("pbrt failed:\n{said}").into());
        }
        Ok([start.elapsed().as_secs_f64(), children_cpu()? - before])
    }

    /// The least of three: the first may read the program and the scene from the disk.
    fn load(&self, target: &Path) -> Result<[f64; 2]> {
        let mut least = [f64::INFINITY; 2];
        for _ in 0..3 {
            let one = self.process(&["--spp", "1", "--pixelbounds", "0,1,0,1"], target)?;
            least = [least[0].min(one[0]), least[1].min(one[1])];
        }
        Ok(least)
    }
}

impl Engine for Pbrt {
    fn render(&mut self, _: &str, spp: u32, seed: u32, target: &Path) -> Result<Timing> {
        let loading = match self.loading {
            Some(loading) => loading,
            None => self.load(target)?,
        };
        self.loading = Some(loading);
        let options = ["--spp", &spp.to_string(), "--seed", &seed.to_string()];
        let [wall, cpu] = self.process(&options, target)?;
        Ok(Timing {
            wall: wall - loading[0],
            cpu: cpu - loading[1],
            spp,
        })
    }

    fn version(&self) -> String {
        "pbrt-v4".to_owned()
    }
}

/// A program that loads the scene once and renders on demand, as the scripts of `data/versus` do.
pub(crate) struct Served {
    name: &'static str,
    version: String,
    child: Child,
    /// Closed first, so that the program ends.
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Served {
    /// Starts `command` and waits until the scene is loaded.
    pub(crate) fn start(name: &'static str, command: &mut Command) -> Result<Self> {
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|e| format!("{name}: {e}"))?;
        let requests = child.stdin.take();
        let answers = child.stdout.take().ok_or("no pipe")?;
        let mut served = Self {
            name,
            version: String::new(),
            child,
            requests,
            answers: BufReader::new(answers),
        };
        let words = served.answer("ready")?;
        served.version = words.first().cloned().unwrap_or_default();
        Ok(served)
    }

    /// The words after `key` of the next line that begins with it; the renderer's own lines pass.
    fn answer(&mut self, key: &str) -> Result<Vec<String>> {
        let mut line = String::new();
        loop {
            line.clear();
            if self.answers.read_line(&mut line)? == 0 {
                return Err(format!("{} ended early", self.name).into());
            }
            let mut words = line.split_whitespace().map(str::to_owned);
            if words.next().is_some_and(|word| word == key) {
                return Ok(words.collect());
            }
        }
    }
}

impl Engine for Served {
    fn render(&mut self, sampler: &str, spp: u32, seed: u32, target: &Path) -> Result<Timing> {
        let requests = self.requests.as_mut().ok_or("closed")?;
        writeln!(requests, "{sampler} {spp} {seed} {}", target.display())?;
        requests.flush()?;
        match self.answer("done")?.as_slice() {
            [wall, cpu, spp] => Ok(Timing {
                wall: wall.parse()?,
                cpu: cpu.parse()?,
                spp: spp.parse()?,
            }),
            other => Err(format!("{}: unexpected answer {other:?}", self.name).into()),
        }
    }

    fn version(&self) -> String {
        format!("{} {}", self.name, self.version)
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.requests = None;
        let mut rest = Vec::new();
        // What a program says while it ends is of no interest.
        let _ = self.answers.read_to_end(&mut rest);
        let _ = self.child.wait();
    }
}

/// The attribute that Specula writes, in seconds.
fn render_seconds(picture: &Path) -> Result<f64> {
    let meta = MetaData::read_from_file(picture, false)?;
    let name = Text::from("specula.renderSeconds");
    let found = meta
        .headers
        .iter()
        .find_map(|h| h.own_attributes.other.get(&name));
    match found {
        Some(AttributeValue::F32(seconds)) => Ok(f64::from(*seconds)),
        _ => Err(format!("{} does not say how long it took", picture.display()).into()),
    }
}

/// CPU seconds of all children that have ended and were waited for.
fn children_cpu() -> Result<f64> {
    cpu_of("/proc/self/stat", [15, 16])
}

/// CPU seconds of a process that runs.
fn process_cpu(id: u32) -> Result<f64> {
    cpu_of(&format!("/proc/{id}/stat"), [13, 14])
}

/// The sum of two fields of a `stat` file, counted from 0, in seconds.
fn cpu_of(path: &str, fields: [usize; 2]) -> Result<f64> {
    let text = fs::read_to_string(path)?;
    ticks(&text, fields)
        .map(|t| t / TICKS)
        .ok_or_else(|| format!("{path} cannot be read").into())
}

/// The program's name, field 1, stands in brackets and may hold anything.
fn ticks(text: &str, fields: [usize; 2]) -> Option<f64> {
    let rest: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let field = |i: usize| rest.get(i - 2)?.parse::<f64>().ok();
    Some(field(fields[0])? + field(fields[1])?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samplers_have_options_of_their_own_and_the_default_none() {
        let options = Specula::SAMPLERS.map(Specula::options);
        assert_eq!(options[0], [""; 0]);
        for (i, one) in options.iter().enumerate() {
            assert!(!options[..i].contains(one), "{one:?}");
        }
    }

    #[test]
    fn ticks_are_found_behind_any_name() {
        let text = "7 (a ) b) S 1 2 3 4 5 6 7 8 9 10 100 20 300 40 20 0";
        assert_eq!(ticks(text, [13, 14]), Some(120.0));
        assert_eq!(ticks(text, [15, 16]), Some(340.0));
        assert_eq!(ticks("7 (a) S 1", [13, 14]), None);
    }

    #[test]
    fn a_served_renderer_answers_and_ends() {
        let script = "echo noise; echo ready 1.2 0.5; \
                      while read a b c d; do echo Fra:1; echo done 2.5 4.5 $b; done";
        let mut served = Served::start("sh", Command::new("sh").args(["-c", script])).unwrap();
        assert_eq!(served.version(), "sh 1.2");
        let timing = served.render("x", 16, 1, Path::new("y.exr")).unwrap();
        assert_eq!((timing.wall, timing.cpu, timing.spp), (2.5, 4.5, 16));
        drop(served);
        assert!(Served::start("sh", Command::new("sh").args(["-c", "exit 1"])).is_err());
    }
}
