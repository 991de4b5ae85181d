//! `cargo xtask profile`: where the instructions of a render go, counted under valgrind.

mod callgrind;
mod parts;
mod report;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;

use crate::versus::scenes::SCENES;
use crate::{Result, workspace};
use parts::{Part, Sources, Totals};

/// Samples per pixel of the two renders whose difference is shown: what both do, loading, building and
/// writing, is in neither.
const SAMPLES: [u32; 2] = [1, 9];

/// Which scenes to profile.
#[derive(Args)]
pub(crate) struct Profile {
    /// Scenes beside the four of `versus` and the built-in one
    #[arg(value_name = "FILE")]
    scenes: Vec<PathBuf>,
    /// These scenes alone
    #[arg(long)]
    only: bool,
    /// Pixels of a side
    #[arg(long, value_name = "N", default_value_t = 64)]
    side: u32,
    /// Specula, with line tables [default: built from this workspace]
    #[arg(long, value_name = "PROGRAM")]
    specula: Option<PathBuf>,
    /// Folder for profiles and scenes
    #[arg(long, value_name = "DIR", default_value = "target/profile")]
    out: PathBuf,
    /// Write docs/profile/README.md
    #[arg(long)]
    publish: bool,
}

/// What one scene's samples take.
struct Row {
    name: String,
    totals: Totals,
    samples: u64,
}

impl Row {
    fn share(&self, part: Part) -> f64 {
        let all: u64 = self.totals.iter().sum();
        self.totals[part as usize] as f64 / all as f64
    }

    fn instructions_per_sample(&self) -> f64 {
        self.totals.iter().sum::<u64>() as f64 / self.samples as f64
    }
}

/// Profiles, prints the table, and writes the document where that is asked for.
pub(crate) fn run(root: &Path, profile: &Profile) -> Result<()> {
    if Command::new("valgrind").arg("--version").output().is_err() {
        return Err("no `valgrind` found (Debian, Ubuntu: apt-get install valgrind)".into());
    }
    let program = workspace::program(root, profile.specula.as_deref())?;
    fs::create_dir_all(&profile.out)?;
    let out = fs::canonicalize(&profile.out)?;
    let mut scenes = Vec::new();
    if !profile.only {
        for scene in &SCENES {
            scenes.push((scene.name.to_owned(), Some(scene.prepare(root, &out)?)));
        }
        scenes.push(("built-in orbs".to_owned(), None));
    }
    for path in &profile.scenes {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        scenes.push((name.into_owned(), Some(path.clone())));
    }
    let mut rows = Vec::new();
    for (name, scene) in scenes {
        let row = measure(&program, &out, name, scene.as_deref(), profile.side)?;
        println!(
            "{}: {:.0} instructions a sample",
            row.name,
            row.instructions_per_sample()
        );
        rows.push(row);
    }
    print!("{}", report::table(&rows));
    if profile.publish {
        let docs = root.join("docs/profile");
        fs::create_dir_all(&docs)?;
        let old = fs::read_to_string(docs.join("README.md")).unwrap_or_default();
        fs::write(docs.join("README.md"), report::publish(&old, &rows))?;
    }
    Ok(())
}

/// The difference of two renders of one scene.
fn measure(
    program: &Path,
    out: &Path,
    name: String,
    scene: Option<&Path>,
    side: u32,
) -> Result<Row> {
    let mut sources = Sources::new(&workspace::root());
    let mut found = Vec::new();
    for spp in SAMPLES {
        let file = out.join(format!("{}-{spp}.callgrind", name.replace(' ', "-")));
        let output = Command::new("valgrind")
            .args(["--tool=callgrind", "--demangle=no"])
            .arg(format!("--callgrind-out-file={}", file.display()))
            .arg(program)
            .args([
                "render",
                "--threads",
                "1",
                "--checkpoint",
                "off",
                "--quiet",
                "--adaptive=off",
            ])
            .args(["--resolution", &format!("{side}x{side}")])
            .args(["--spp", &spp.to_string(), "-o"])
            .arg(out.join("profile.exr"))
            .args(scene)
            .output()?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        let text = fs::read_to_string(&file)?;
        let costs = callgrind::costs(&text).ok_or("callgrind wrote something else")?;
        found.push(parts::totals(&costs, &mut sources));
    }
    let mut totals = found[1];
    for (total, before) in totals.iter_mut().zip(found[0]) {
        *total = total.saturating_sub(before);
    }
    Ok(Row {
        name,
        totals,
        samples: u64::from(side) * u64::from(side) * u64::from(SAMPLES[1] - SAMPLES[0]),
    })
}
