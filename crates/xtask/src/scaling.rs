//! `cargo xtask scaling`: what a second thread gains, what more would, and what a sample costs against the number of
//! triangles.

mod schedule;

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::versus::mesh::write_displaced_sphere;
use crate::versus::renderers::{Engine, Specula};
use crate::versus::scenes::SCENES;
use crate::versus::statistics::median;
use crate::{Result, workspace};

/// The scene whose mesh is replaced.
const SCENE: &str = "two-million-triangles";
/// Segments and rings of the meshes: 2 segments (rings - 1) triangles, 10^4 to 10^7.
const MESHES: [[u32; 2]; 4] = [[100, 51], [250, 201], [1000, 501], [2500, 2001]];
/// What two threads must gain.
const LEAST_GAIN: f64 = 1.9;

/// What to measure, and how.
#[derive(Args)]
pub(crate) struct Scaling {
    /// Rounds, in each of which everything is rendered once
    #[arg(long, default_value_t = 5)]
    rounds: u32,
    /// Samples per pixel, of 512x512
    #[arg(long, default_value_t = 8)]
    spp: u32,
    /// Specula [default: built from this workspace]
    #[arg(long, value_name = "PROGRAM")]
    specula: Option<PathBuf>,
    /// Folder for scenes, meshes (250 MB) and pictures
    #[arg(long, value_name = "DIR", default_value = "target/scaling")]
    out: PathBuf,
    /// Measure the threads alone, and fail below a gain of 1.9: on a machine that does nothing else
    #[arg(long)]
    threads: bool,
    /// Tell instead what up to 64 threads would gain, from the time of each tile on one
    #[arg(long, conflicts_with = "threads")]
    tiles: bool,
    /// Write docs/profile/triangles.svg
    #[arg(long)]
    publish: bool,
}

/// One point of the plot.
#[derive(Clone, Copy, Debug)]
struct Point {
    triangles: u32,
    /// CPU time of a sample, in microseconds.
    cost: f64,
}

/// Measures, prints and samples.
pub(crate) fn run(root: &Path, scaling: &Scaling) -> Result<()> {
    fs::create_dir_all(&scaling.out)?;
    let out = fs::canonicalize(&scaling.out)?;
    if scaling.tiles {
        return tiles(root, scaling, &out);
    }
    let program = workspace::program(root, scaling.specula.as_deref())?;
    if scaling.threads {
        return threads(root, scaling, &program, &out);
    }
    let points = triangles(root, scaling, &program, &out)?;
    println!("| triangles | microseconds of CPU a sample |\n|---|---|");
    for p in &points {
        println!("| {} | {:.3} |", p.triangles, p.cost);
    }
    let [slope, last] = growth(&points);
    println!("a tenfold mesh adds {slope:.3} on average, {last:.3} at the end");
    let svg = draw(&points);
    fs::write(out.join("triangles.svg"), &svg)?;
    if scaling.publish {
        let docs = root.join("docs/profile");
        fs::create_dir_all(&docs)?;
        fs::write(docs.join("triangles.svg"), svg)?;
    }
    Ok(())
}

fn specula(program: &Path, scene: PathBuf, threads: u32) -> Specula {
    Specula {
        program: program.to_owned(),
        scene,
        threads,
        device: "cpu".to_owned(),
        writing: None,
    }
}

/// Wall time of rendering with one thread over that with two, turn by turn.
fn threads(root: &Path, scaling: &Scaling, program: &Path, out: &Path) -> Result<()> {
    let mut least = f64::INFINITY;
    for scene in &SCENES {
        let file = scene.prepare(root, out)?;
        let picture = out.join("threads.exr");
        let mut gains = Vec::new();
        for round in 0..scaling.rounds.max(1) {
            let mut seconds = [0.0; 2];
            for (seconds, threads) in seconds.iter_mut().zip([1, 2]) {
                let mut one = specula(program, file.clone(), threads);
                *seconds = one.render("", 4 * scaling.spp, round, &picture)?.wall;
            }
            gains.push(seconds[0] / seconds[1]);
        }
        let gain = median(&gains);
        println!("{}: two threads gain {gain:.3}", scene.name);
        least = least.min(gain);
    }
    match least >= LEAST_GAIN {
        true => Ok(()),
        false => Err(format!("two threads gain {least:.3}, less than {LEAST_GAIN}").into()),
    }
}

/// What more threads would gain in each scene, in passes as those of a short render.
fn tiles(root: &Path, scaling: &Scaling, out: &Path) -> Result<()> {
    print!("{}", schedule::head());
    for scene in &SCENES {
        let file = scene.prepare(root, out)?;
        let passes = [1, scaling.spp.saturating_sub(1).max(1)];
        let tiles = schedule::Tiles::measure(&file, &passes)?;
        print!("{}", schedule::row(scene.name, &tiles));
    }
    Ok(())
}

/// The cost of a sample for each mesh, median of the rounds.
fn triangles(root: &Path, scaling: &Scaling, program: &Path, out: &Path) -> Result<Vec<Point>> {
    let scene = SCENES.iter().find(|s| s.name == SCENE);
    scene.ok_or("no such scene")?.prepare(root, out)?;
    let text = fs::read_to_string(out.join(format!("{SCENE}.pbrt")))?;
    let mut engines = Vec::new();
    for [segments, rings] in MESHES {
        let triangles = 2 * segments * (rings - 1);
        let mesh = format!("sphere-{triangles}.ply");
        if !out.join(&mesh).exists() {
            write_displaced_sphere(&out.join(&mesh), segments, rings)?;
        }
        let file = out.join(format!("sphere-{triangles}.pbrt"));
        fs::write(&file, text.replace("displaced-sphere.ply", &mesh))?;
        engines.push((triangles, specula(program, file, 1), Vec::new()));
    }
    let picture = out.join("triangles.exr");
    for round in 0..scaling.rounds.max(1) {
        for (triangles, engine, seconds) in &mut engines {
            let timing = engine.render("", scaling.spp, round, &picture)?;
            println!("{round} {triangles}: {:.2} s of CPU", timing.cpu);
            seconds.push(timing.cpu);
        }
    }
    let samples = f64::from(scaling.spp) * 512.0 * 512.0;
    let point = |(triangles, _, seconds): &(u32, Specula, Vec<f64>)| Point {
        triangles: *triangles,
        cost: 1e6 * median(seconds) / samples,
    };
    Ok(engines.iter().map(point).collect())
}

/// Microseconds that a tenfold mesh adds: over all points, and from the last but one to the last. Equal
/// where the cost grows with the logarithm.
fn growth(points: &[Point]) -> [f64; 2] {
    let between = |a: &Point, b: &Point| {
        (b.cost - a.cost) / (f64::from(b.triangles) / f64::from(a.triangles)).log10()
    };
    match points {
        [first, .., before, last] => [between(first, last), between(before, last)],
        _ => [f64::NAN; 2],
    }
}

/// The cost over the logarithm of the triangles, where logarithmic growth is a line.
fn draw(points: &[Point]) -> String {
    const SIZE: [f64; 2] = [640.0, 400.0];
    const LEFT: f64 = 70.0;
    const BOTTOM: f64 = 340.0;
    const TOP: f64 = 50.0;
    let most = points.iter().map(|p| p.cost).fold(0.0, f64::max);
    let step = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]
        .into_iter()
        .find(|step| most / step <= 6.0)
        .unwrap_or(100.0);
    let highest = (most / step).ceil().max(1.0) * step;
    let x = |triangles: u32| LEFT + 40.0 + 155.0 * (f64::from(triangles).log10() - 4.0);
    let y = |cost: f64| BOTTOM - (BOTTOM - TOP) * cost / highest;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" \
         font-family=\"sans-serif\" font-size=\"14\">\n\
         <rect width=\"{}\" height=\"{}\" fill=\"white\"/>\n\
         <text x=\"{LEFT}\" y=\"28\">Cost per sample against triangles, microseconds of one core</text>\n",
        SIZE[0], SIZE[1], SIZE[0], SIZE[1]
    );
    let right = SIZE[0] - 40.0;
    let mut cost = 0.0;
    while cost <= highest * 1.001 {
        let at = y(cost);
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {at:.1}H{right}\" stroke=\"#ddd\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{cost:.1}</text>",
            LEFT - 8.0,
            at + 5.0
        );
        cost += step;
    }
    for (exponent, label) in [(4, "10⁴"), (5, "10⁵"), (6, "10⁶"), (7, "10⁷")] {
        let at = x(10_u32.pow(exponent));
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.1} {TOP}V{BOTTOM}\" stroke=\"#ddd\"/>\
             <text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{label}</text>",
            BOTTOM + 24.0
        );
    }
    if let [first, .., last] = points {
        let _ = writeln!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#999\" stroke-dasharray=\"5 4\"/>",
            x(first.triangles),
            y(first.cost),
            x(last.triangles),
            y(last.cost)
        );
    }
    for p in points {
        let (x, y) = (x(p.triangles), y(p.cost));
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\" fill=\"#1f5fa8\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{:.2}</text>",
            y - 12.0,
            p.cost
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.0}\" y=\"{}\" text-anchor=\"middle\">triangles</text>\n</svg>",
        0.5 * (LEFT + right),
        SIZE[1] - 12.0
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_are_powers_of_ten() {
        let counts = MESHES.map(|[segments, rings]| 2 * segments * (rings - 1));
        assert_eq!(counts, [10_000, 100_000, 1_000_000, 10_000_000]);
    }

    #[test]
    fn growth_tells_a_line_from_a_bend() {
        let points = |cost: fn(f64) -> f64| {
            [4, 5, 6, 7].map(|e| Point {
                triangles: 10_u32.pow(e),
                cost: cost(f64::from(e)),
            })
        };
        let [all, last] = growth(&points(|e| 1.0 + 0.25 * e));
        assert!((all - 0.25).abs() < 1e-12 && (last - 0.25).abs() < 1e-12);
        let [all, last] = growth(&points(|e| e * e));
        assert!(last > all);
        assert_eq!(draw(&points(|e| e)).matches("<circle").count(), 4);
    }
}
