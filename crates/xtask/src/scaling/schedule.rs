//! What more threads would gain than this machine has, from how long each tile takes on one.
//!
//! A render's passes hand out tiles, and each pass waits for its last one. Not told by this: memory and caches that
//! threads share, and clocks that sink where all cores work.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use specula_render::{PreparedScene, RenderOptions, Renderer};

use crate::Result;
use crate::rays::processor_time;
use crate::versus::statistics::median;

/// Side of the tiles that a pass hands out, in pixels.
const TILE: u32 = 16;
/// Threads that are told of.
const THREADS: [u32; 4] = [2, 16, 32, 64];
/// Passes of no samples, of which the median tells what a pass takes beside its tiles.
const EMPTY_PASSES: usize = 21;

/// What was measured of a scene, on one thread.
#[derive(Debug)]
pub(super) struct Tiles {
    /// Seconds of each tile, in each pass.
    passes: Vec<Vec<f64>>,
    /// Seconds beside tiles, which more threads do not make fewer.
    serial: f64,
}

impl Tiles {
    /// Renders a scene tile by tile.
    ///
    /// * `passes`: samples per pixel of each.
    pub(super) fn measure(file: &Path, passes: &[u32]) -> Result<Self> {
        let loaded = specula_scene::load(file)?;
        let options = RenderOptions::from_scene(&loaded.scene);
        let mut prepared = PreparedScene::new(&loaded.scene, &options)?;
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
        let (camera, film) = (&loaded.scene.camera, &loaded.scene.film);
        // Passes in which no tile takes a sample.
        let empty = vec![0; EMPTY_PASSES];
        let idle = pool.install(|| seconds(&prepared, &options, &empty));
        let [x0, x1, y0, y1] = prepared.crop();
        let mut tiles = vec![Vec::new(); passes.len()];
        for y in (y0..y1).step_by(TILE as usize) {
            for x in (x0..x1).step_by(TILE as usize) {
                let crop = Some([x, (x + TILE).min(x1), y, (y + TILE).min(y1)]);
                let options = RenderOptions {
                    crop,
                    ..options.clone()
                };
                prepared.look(camera, film, &options)?;
                let taken = pool.install(|| seconds(&prepared, &options, passes));
                for (tiles, taken) in tiles.iter_mut().zip(taken) {
                    tiles.push(taken);
                }
            }
        }
        Ok(Self {
            passes: tiles,
            serial: passes.len() as f64 * median(&idle),
        })
    }

    fn sum(&self) -> f64 {
        self.passes.iter().flatten().sum()
    }

    /// How many times as fast so many threads are: each tile goes to the thread that is free first.
    fn gain(&self, threads: u32) -> f64 {
        self.gain_of(|tiles| {
            let mut free_at = vec![0.0_f64; threads as usize];
            for &tile in tiles {
                if let Some(first) = free_at.iter_mut().min_by(|a, b| a.total_cmp(b)) {
                    *first += tile;
                }
            }
            free_at.into_iter().fold(0.0, f64::max)
        })
    }

    /// What it is at least, in whatever order tiles are taken (Graham 1966, "Bounds for certain multiprocessing
    /// anomalies", theorem 1).
    fn least_gain(&self, threads: u32) -> f64 {
        let share = 1.0 / f64::from(threads);
        self.gain_of(|tiles| {
            let longest = tiles.iter().copied().fold(0.0, f64::max);
            share * tiles.iter().sum::<f64>() + (1.0 - share) * longest
        })
    }

    fn gain_of(&self, seconds: impl Fn(&[f64]) -> f64) -> f64 {
        let parallel: f64 = self.passes.iter().map(|tiles| seconds(tiles)).sum();
        (self.serial + self.sum()) / (self.serial + parallel)
    }
}

/// Seconds of the processor for each pass, on a pool of one thread. One comes before, in which memory is got.
fn seconds(prepared: &PreparedScene, options: &RenderOptions, passes: &[u32]) -> Vec<f64> {
    let mut renderer = Renderer::new(prepared, options.clone());
    let stop = AtomicBool::new(false);
    renderer.render_pass(1, &stop);
    let pass = |&samples: &u32| {
        let start = processor_time();
        renderer.render_pass(samples, &stop);
        processor_time() - start
    };
    passes.iter().map(pass).collect()
}

/// The head of a table of [`row`]s.
pub(super) fn head() -> String {
    let threads = THREADS.map(|n| format!(" {n} threads |")).concat();
    let lines = "---|".repeat(4 + THREADS.len());
    format!("| scene | tiles | a tile, ms: mean, longest | serial, % |{threads}\n|{lines}\n")
}

/// What was found of a scene: simulated gains, and what they are at least.
pub(super) fn row(name: &str, tiles: &Tiles) -> String {
    let count = tiles.passes.first().map_or(0, Vec::len);
    let each = tiles.passes.iter().flatten();
    let longest = each.fold(0.0_f64, |most, &tile| most.max(tile));
    let mean = tiles.sum() / (count * tiles.passes.len()).max(1) as f64;
    let serial = tiles.serial / (tiles.serial + tiles.sum());
    let mut row = format!(
        "| {name} | {count} | {:.2}, {:.2} | {:.2} |",
        1e3 * mean,
        1e3 * longest,
        100.0 * serial
    );
    for threads in THREADS {
        let (gain, least) = (tiles.gain(threads), tiles.least_gain(threads));
        let _ = write!(row, " {gain:.1}, at least {least:.1} |");
    }
    row + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tiles(passes: &[&[f64]], serial: f64) -> Tiles {
        Tiles {
            passes: passes.iter().map(|p| p.to_vec()).collect(),
            serial,
        }
    }

    #[test]
    fn equal_tiles_gain_what_there_are_threads() {
        let even = tiles(&[&[0.5; 64]], 0.0);
        for threads in [1, 2, 16, 64] {
            assert!((even.gain(threads) - f64::from(threads)).abs() < 1e-12);
        }
        // A part of a tenth that is not shared: Amdahl's law.
        let amdahl = tiles(&[&[0.5; 64]], 32.0 / 9.0);
        let expected = 1.0 / (0.1 + 0.9 / 16.0);
        assert!((amdahl.gain(16) - expected).abs() < 1e-12);
    }

    #[test]
    fn a_pass_waits_for_its_last_tile() {
        let late = tiles(&[&[1.0, 1.0, 1.0, 3.0], &[2.0, 2.0]], 0.0);
        // One thread takes the long tile when the other has had two.
        assert!((late.gain(2) - 10.0 / (4.0 + 2.0)).abs() < 1e-12);
        for threads in [1, 2, 3, 5] {
            assert!(late.least_gain(threads) <= late.gain(threads) + 1e-12);
        }
        assert!((late.least_gain(2) - 10.0 / (3.0 + 1.5 + 2.0 + 1.0)).abs() < 1e-12);
        assert!(row("late", &late).starts_with("| late | 4 |"), "{late:?}");
        let columns = |line: &str| line.matches('|').count();
        let head = head();
        assert!(
            head.lines()
                .all(|l| columns(l) == columns(&row("late", &late)))
        );
    }

    #[test]
    fn tiles_of_a_scene_are_its_picture() {
        let folder = std::env::temp_dir().join(format!("specula-tiles-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join("small.pbrt");
        let text = "LookAt 0 -4 1 0 0 0 0 0 1\nCamera \"perspective\"\n\
            Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 24\nWorldBegin\n\
            LightSource \"infinite\"\nMaterial \"conductor\"\nShape \"sphere\"\n";
        std::fs::write(&file, text).unwrap();
        let found = Tiles::measure(&file, &[1, 3]).unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(found.passes.iter().map(Vec::len).eq([6, 6]));
        assert!(found.passes.iter().flatten().all(|&s| s > 0.0) && found.serial > 0.0);
        assert!(found.gain(16) <= 6.0 + 1e-9 && found.gain(16) >= 1.0);
    }
}
