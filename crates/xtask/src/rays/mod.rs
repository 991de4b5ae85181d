//! `cargo xtask rays`: our ray casting beside Embree's, and over the number of triangles.

mod meshes;
mod peer;
mod plot;
mod report;
mod sets;

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use specula_render::accel::Accel;

use self::meshes::Mesh;
use self::peer::Peer;
use self::sets::{BATCH, Set};
use crate::Result;
use crate::versus::statistics::median;

/// What is measured.
#[derive(Args)]
pub(crate) struct Rays {
    /// Embree 4's shared library, libembree4.so; without it only our side is measured
    #[arg(long, value_name = "FILE")]
    embree: Option<PathBuf>,
    /// Triangles of the meshes; below a hundred a room with two boxes
    #[arg(
        long,
        value_name = "N",
        value_delimiter = ',',
        default_value = "36,1e4,1e5,1e6,1e7"
    )]
    triangles: Vec<f64>,
    /// Runs of every set of rays, in turns with the peer, of which the median counts
    #[arg(long, value_name = "N", default_value_t = 5)]
    runs: usize,
    /// Also write the figures into docs/rays
    #[arg(long)]
    write: bool,
}

/// What was found of one mesh.
struct Row {
    triangles: usize,
    bytes: f64,
    /// On one thread and on two, by the clock.
    build: [f64; 2],
    /// The same of the peer.
    peer_build: Option<[f64; 2]>,
    peer_bytes: Option<f64>,
    cells: Vec<Cell>,
}

/// What was found of one set of rays; nanoseconds of processor per ray.
struct Cell {
    what: &'static str,
    specula: f64,
    /// In each of [`peer::CALLS`].
    peer: Option<[f64; peer::CALLS.len()]>,
}

impl Cell {
    /// Of the peer with packets of sixteen, whichever hint makes them faster.
    fn in_packets(&self) -> Option<f64> {
        self.peer
            .map(|[_, incoherent, coherent]| incoherent.min(coherent))
    }
}

/// Measures, prints and perhaps writes.
pub(crate) fn run(root: &Path, rays: &Rays) -> Result<()> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or(root.join("target"), PathBuf::from);
    let mut rows = Vec::new();
    for &count in &rays.triangles {
        let folder = target.join(format!("rays/{count:e}"));
        let row = measure(root, rays, count, &folder)?;
        print!("{}", report::row(&row));
        rows.push(row);
    }
    let text = report::tables(&rows);
    println!("\n{text}");
    if rays.write {
        let folder = root.join("docs/rays");
        report::write(&folder.join("README.md"), &text)?;
        plot::draw(&folder.join("cost.svg"), &rows)?;
    }
    Ok(())
}

fn measure(root: &Path, rays: &Rays, count: f64, folder: &Path) -> Result<Row> {
    let mesh = if count < 100.0 {
        Mesh::room()
    } else {
        Mesh::sphere(count)
    };
    let (mut build, mut accel) = ([0.0; 2], None);
    for (seconds, threads) in build.iter_mut().zip(1..) {
        drop(accel.take());
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()?;
        let start = Instant::now();
        accel = Some(pool.install(|| mesh.accel())?);
        *seconds = start.elapsed().as_secs_f64();
    }
    let accel = accel.ok_or("nothing was built")?;
    let sets = sets::sets(&mesh, &accel);
    let mut peer = None;
    let mut peer_build = None;
    if let Some(library) = &rays.embree {
        peer::write(folder, &mesh, &sets)?;
        let program = peer::compile(&peer::source(root), folder)?;
        let single = Peer::start(&program, library, folder, 1)?.build[1];
        let double = Peer::start(&program, library, folder, 2)?;
        peer_build = Some([single, double.build[1]]);
        peer = Some(double);
    }
    let cells = sets
        .iter()
        .map(|set| cell(&accel, set, peer.as_mut(), rays.runs));
    Ok(Row {
        cells: cells.collect::<Result<_>>()?,
        triangles: accel.stats().triangles,
        bytes: accel.stats().bytes as f64,
        build,
        peer_build,
        peer_bytes: peer.map(|p| p.bytes),
    })
}

fn cell(accel: &Accel, set: &Set, mut peer: Option<&mut Peer>, runs: usize) -> Result<Cell> {
    let mut specula = Vec::new();
    let mut theirs = peer::CALLS.map(|_| Vec::new());
    for _ in 0..runs {
        let (seconds, hits) = trace(accel, set);
        specula.push(seconds);
        let Some(peer) = &mut peer else { continue };
        for (call, theirs) in peer::CALLS.iter().zip(&mut theirs) {
            let (seconds, found) = peer.trace(set, call)?;
            theirs.push(seconds);
            // Rays along edges may differ.
            if (hits as f64 - found).abs() > 1e-3 * set.rays.len() as f64 {
                return Err(format!("{}: {hits} hits here, {found} there", set.what).into());
            }
        }
    }
    let per_ray = |seconds: &[f64]| median(seconds) * 1e9 / set.rays.len() as f64;
    Ok(Cell {
        what: set.what,
        specula: per_ray(&specula),
        peer: peer.map(|_| theirs.each_ref().map(|seconds| per_ray(seconds))),
    })
}

/// Seconds of processor for a set in batches, and how many rays hit.
fn trace(accel: &Accel, set: &Set) -> (f64, usize) {
    let (mut hits, mut found) = (Vec::new(), Vec::new());
    let mut count = 0;
    let start = processor_time();
    for batch in set.rays.chunks(BATCH) {
        if set.any {
            accel.occluded_all(batch, &mut found);
            count += black_box(&found).iter().filter(|&&f| f).count();
        } else {
            accel.intersect_all(batch, &mut hits);
            count += black_box(&hits).iter().flatten().count();
        }
    }
    (processor_time() - start, count)
}

/// Seconds that this thread has run, to the nanosecond.
#[cfg(unix)]
pub(crate) fn processor_time() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// The clock's seconds.
#[cfg(not(unix))]
pub(crate) fn processor_time() -> f64 {
    let now = std::time::SystemTime::now();
    now.duration_since(std::time::UNIX_EPOCH)
        .map_or(0.0, |d| d.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_are_closed() {
        for (mesh, triangles) in [(Mesh::sphere(2000.0), 8 * 16 * 16), (Mesh::room(), 36)] {
            let accel = mesh.accel().unwrap();
            assert_eq!(accel.stats().triangles, triangles);
            for set in sets::sets(&mesh, &accel) {
                let (_, hits) = trace(&accel, &set);
                let least = if set.any { 1 } else { set.rays.len() };
                assert!(
                    (least..=set.rays.len()).contains(&hits),
                    "{}: {hits}",
                    set.what
                );
            }
        }
    }
}
