//! Renders on the GPU: whether they are the processor's pictures, what longer paths cost, and speed.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use specula_bsdf::Rgb;
use specula_bsdf::vndf::Sampler;
use specula_gpu::{AdapterKind, Gpu, Rays, Schedule, Tracer, TracerError, TracerOptions};
use specula_render::{PreparedScene, RenderOptions, Renderer};
use specula_scene::Scene;

use super::scenes::{Subject, metal_room, subjects};
use super::text::{figure, range, row, table};
use super::{Effort, Measured, Result};
use crate::experiments::stopwatch::median;

/// Longest paths of table 3, in reflections.
const DEPTHS: [u32; 4] = [1, 2, 4, 8];
/// Samplers of table 3; the others are compared with the first.
const SAMPLERS: [Sampler; 3] = [Sampler::Cap, Sampler::Bounded, Sampler::Exact];
/// Most samples per pixel of a pass.
const MOST: u32 = 1 << 14;

/// A render on the GPU, or on all threads of the processor where it has no tracer.
struct Render<'a> {
    renderer: Renderer<'a>,
    tracer: Option<Tracer<'a>>,
    pixels: f64,
    /// Of a pass, per pixel.
    samples: u32,
}

/// A pass of a render.
#[derive(Clone, Copy)]
struct Pass {
    seconds: f64,
    /// Seconds of a sample.
    per_sample: f64,
    rays_per_sample: f64,
}

impl<'a> Render<'a> {
    fn new(scene: &'a PreparedScene, options: &RenderOptions, tracer: Option<Tracer<'a>>) -> Self {
        let [width, height] = options.resolution.unwrap_or_default();
        Self {
            renderer: Renderer::new(scene, options.clone()),
            tracer,
            pixels: f64::from(width) * f64::from(height),
            samples: 1,
        }
    }

    /// The next samples of the picture.
    fn pass(&mut self) -> Result<Pass> {
        let go = AtomicBool::new(false);
        let start = Instant::now();
        let report = match &mut self.tracer {
            Some(tracer) => tracer.render_pass(&mut self.renderer, self.samples, &go)?,
            None => self.renderer.render_pass(self.samples, &go),
        };
        let seconds = start.elapsed().as_secs_f64();
        if report.invalid_samples > 0 {
            return Err(format!("{} samples are not finite", report.invalid_samples).into());
        }
        let samples = self.pixels * f64::from(self.samples);
        Ok(Pass {
            seconds,
            per_sample: seconds / samples,
            rays_per_sample: report.rays as f64 / samples,
        })
    }

    /// Doubles the samples of a pass until it lasts as long as is measured.
    fn warm_up(&mut self, seconds: f64) -> Result<()> {
        while self.pass()?.seconds < seconds && self.samples < MOST {
            self.samples *= 2;
        }
        Ok(())
    }

    /// Variance of a sample: mean over pixels and channels.
    fn variance(&self) -> f64 {
        let picture = self.renderer.film().picture();
        let of_pixels = picture.variance.iter().zip(&picture.sample_count);
        let sum: f64 = of_pixels
            .map(|(v, n)| f64::from(v.to_array().iter().sum::<f32>() * n))
            .sum();
        sum / (3.0 * self.pixels)
    }
}

/// A scene on the GPU, or why the GPU does not render it.
fn tracer<'a>(
    gpu: &'a Gpu,
    scene: &PreparedScene,
    options: &RenderOptions,
    on_gpu: TracerOptions,
) -> Result<std::result::Result<Tracer<'a>, String>> {
    use TracerError::{Missing, Queries, TooLarge};
    match Tracer::with_options(gpu, scene, options, on_gpu) {
        Ok(tracer) => Ok(Ok(tracer)),
        Err(error @ (Missing(_) | TooLarge { .. } | Queries(_))) => Ok(Err(error.to_string())),
        Err(error) => Err(error.into()),
    }
}

/// Medians of a quantity over the passes of one render.
fn over(passes: &[Pass], of: impl Fn(&Pass) -> f64) -> f64 {
    median(passes.iter().map(of))
}

/// Tokuyoshi and Eto 2024, table 3.
pub(super) fn longest_paths(gpu: &Gpu, effort: &Effort<'_>) -> Result<String> {
    let subject = metal_room();
    let scene = subject.load()?;
    let side = effort.side;
    let mut rows = vec![row([
        "longest path",
        "sampler",
        "s per million samples",
        "time / cap",
        "in single rounds",
        "rays per sample",
        "rays / cap",
        "variance / cap",
        "time x variance / cap",
    ])];
    let start = Instant::now();
    let mut compilation = 0.0;
    for depth in DEPTHS {
        effort.go_on()?;
        rows.extend(longest_path(gpu, effort, &scene, depth, &mut compilation)?);
    }
    Ok(format!(
        "## Longer paths (Tokuyoshi and Eto 2024, table 3)\n\n\
         A bounded cap rejects fewer reflections, so that paths are longer. The scene `{}`: {}; \
         {side}x{side} pixels.\n\
         The paper: the bounded cap takes 0.2 to 1.3 % more time than the cap up to 1 bounce, 0.3 to 2.9 % up \
         to 2, 0.5 to 6.2 % up to 4, 1.2 to 10.4 % up to 1024.\n\
         The variance is that of a sample, as the film estimates it. The samplers of one longest path have the same expectation.\n\
         Medians of {} rounds; {} shaders compiled in {compilation:.1} s of {:.0} s.\n\n{}",
        subject.name,
        subject.title,
        effort.render_rounds,
        DEPTHS.len() * SAMPLERS.len(),
        start.elapsed().as_secs_f64(),
        table(&rows)
    ))
}

/// The rows of one longest path.
fn longest_path(
    gpu: &Gpu,
    effort: &Effort<'_>,
    scene: &Scene,
    depth: u32,
    compilation: &mut f64,
) -> Result<Vec<Vec<String>>> {
    let options = SAMPLERS.map(|vndf_sampler| RenderOptions {
        max_depth: depth,
        vndf_sampler,
        resolution: Some([effort.side; 2]),
        ..RenderOptions::from_scene(scene)
    });
    let prepared: Vec<PreparedScene> = options
        .iter()
        .map(|options| PreparedScene::new(scene, options))
        .collect::<std::result::Result<_, _>>()?;
    let mut renders = Vec::new();
    for (prepared, options) in prepared.iter().zip(&options) {
        let start = Instant::now();
        let tracer = Tracer::new(gpu, prepared, options)?;
        *compilation += start.elapsed().as_secs_f64();
        let mut render = Render::new(prepared, options, Some(tracer));
        render.warm_up(effort.seconds)?;
        renders.push(render);
    }
    // As many for all: the variance of more samples knows more of its tail.
    let samples = renders.iter().map(|r| r.samples).max().unwrap_or(1);
    renders.iter_mut().for_each(|r| r.samples = samples);
    let mut passes = vec![Vec::new(); renders.len()];
    for _ in 0..effort.render_rounds {
        for (render, passes) in renders.iter_mut().zip(&mut passes) {
            passes.push(render.pass()?);
        }
    }
    let variance = renders.iter().map(Render::variance).collect::<Vec<_>>();
    let cells = |place: usize| {
        let [these, caps] = [&passes[place], &passes[0]];
        let ratios = |of: fn(&Pass) -> f64| -> Vec<f64> {
            let pairs = these.iter().zip(caps);
            pairs.map(|(a, b)| of(a) / of(b)).collect()
        };
        let times = ratios(|p| p.per_sample);
        let [low, high] = range(times.iter().copied());
        let (time, noise) = (median(times), variance[place] / variance[0]);
        let mut cells = vec![depth.to_string(), SAMPLERS[place].to_string()];
        cells.push(figure(1e6 * over(these, |p| p.per_sample)));
        cells.push(format!("{time:.3}"));
        cells.push(format!("{low:.2} to {high:.2}"));
        cells.push(figure(over(these, |p| p.rays_per_sample)));
        cells.push(format!("{:.3}", median(ratios(|p| p.rays_per_sample))));
        cells.push(figure(noise));
        cells.push(figure(time * noise));
        cells
    };
    Ok((0..SAMPLERS.len()).map(cells).collect())
}

/// Samples and rays per second beside the processor's, by both schedules, and by traversal and ray queries.
pub(super) fn speeds(gpu: &Gpu, effort: &Effort<'_>, files: &[PathBuf]) -> Result<Measured> {
    let mut rows = vec![row([
        "scene",
        "schedule",
        "rays",
        "GPU: Msamples/s",
        "Mrays/s",
        "time / paths",
        "in single rounds",
        "processor: Msamples/s",
        "Mrays/s",
        "time to equal error, GPU / processor",
        "in single rounds",
        "compiled",
    ])];
    let mut times = Vec::new();
    for subject in subjects(effort.quick, files) {
        effort.go_on()?;
        let (tree, mut time) = speed(gpu, effort, &subject, Rays::Tree)?;
        rows.extend(tree);
        if gpu.has_ray_queries() {
            let (query, faster) = speed(gpu, effort, &subject, Rays::Query)?;
            rows.extend(query);
            // What renders take by default, where they support the scene.
            time = faster.or(time);
        }
        times.extend(time);
    }
    let queries = match gpu.has_ray_queries() {
        true => "Rays go through Specula's tree, or are cast by the GPU's ray queries.\n",
        false => "This GPU offers no ray queries: rays go through Specula's tree.\n",
    };
    let left_out = match effort.quick {
        true => "`--quick` leaves `two-million-triangles` out.\n",
        false => "",
    };
    let text = format!(
        "## Speed beside the processor's\n\n\
         The scenes of the comparison with other renderers, {0}x{0} pixels, paths as long as they say; rays of \
         cameras, bounces and shadows.\n\
         The samples are the same, and so is their error: time to equal error is the quotient of times.\n\
         `paths`: a thread follows a path to its end. `queues`: a thread takes a path to its next vertex, and \
         paths that continue form a queue (`--gpu-schedule`).\n{queries}{left_out}\
         Medians of {1} rounds.\n\n{2}",
        effort.side,
        effort.render_rounds,
        table(&rows)
    );
    Ok(Measured {
        time_over_processor: geometric_mean(&times),
        ..Measured::table(text)
    })
}

/// `None` of nothing.
fn geometric_mean(values: &[f64]) -> Option<f64> {
    let logarithms: f64 = values.iter().map(|v| v.ln()).sum();
    (!values.is_empty()).then(|| (logarithms / values.len() as f64).exp())
}

/// Schedules of table 4; the second, which is the default, is compared with the first.
const SCHEDULES: [Schedule; 2] = [Schedule::Paths, Schedule::Queues];

/// The row of a scene that is not rendered.
fn row_of_reason(subject: &Subject, rays: Rays, reason: &str) -> Vec<String> {
    let mut cells = vec![String::new(); 12];
    cells[0].clone_from(&subject.name);
    cells[2] = rays.to_string();
    reason.clone_into(&mut cells[3]);
    cells
}

/// The rows of one scene, by traversal or by ray queries, and the time to equal error over the processor's by queues;
/// `None` where the GPU does not render it.
fn speed(
    gpu: &Gpu,
    effort: &Effort<'_>,
    subject: &Subject,
    rays: Rays,
) -> Result<(Vec<Vec<String>>, Option<f64>)> {
    let scene = subject.load()?;
    let options = RenderOptions {
        resolution: Some([effort.side; 2]),
        triangulate_exact_shapes: true,
        ..RenderOptions::from_scene(&scene)
    };
    let prepared = PreparedScene::consume(scene, &options)?;
    let mut renders = vec![Render::new(&prepared, &options, None)];
    let mut compiled = Vec::new();
    for schedule in SCHEDULES {
        let start = Instant::now();
        let on_gpu = TracerOptions { rays, schedule };
        let tracer = match tracer(gpu, &prepared, &options, on_gpu)? {
            Ok(tracer) => tracer,
            Err(reason) => return Ok((vec![row_of_reason(subject, rays, &reason)], None)),
        };
        compiled.push(start.elapsed().as_secs_f64());
        renders.push(Render::new(&prepared, &options, Some(tracer)));
    }
    for render in &mut renders {
        render.warm_up(effort.seconds)?;
    }
    let mut passes = vec![Vec::new(); renders.len()];
    for _ in 0..effort.render_rounds {
        for (render, passes) in renders.iter_mut().zip(&mut passes) {
            passes.push(render.pass()?);
        }
    }
    let [processor, on_gpu @ ..] = passes.as_slice() else {
        return Ok((Vec::new(), None));
    };
    let speed = |passes: &[Pass]| {
        let rays = over(passes, |p| 1e-6 * p.rays_per_sample / p.per_sample);
        [over(passes, |p| 1e-6 / p.per_sample), rays].map(figure)
    };
    // Of times, round by round: the median, and the range.
    let quotients = |a: &[Pass], b: &[Pass]| -> Vec<f64> {
        let rounds = a.iter().zip(b).map(|(a, b)| a.per_sample / b.per_sample);
        rounds.collect()
    };
    let quotient = |a: &[Pass], b: &[Pass]| {
        let rounds = quotients(a, b);
        let [low, high] = range(rounds.iter().copied()).map(figure);
        [figure(median(rounds)), format!("{low} to {high}")]
    };
    let cells = |place: usize| {
        let these = &on_gpu[place];
        let mut cells = row([
            &subject.name,
            &SCHEDULES[place].to_string(),
            &rays.to_string(),
        ]);
        cells.extend(speed(these));
        cells.extend(quotient(these, &on_gpu[0]));
        cells.extend(speed(processor));
        cells.extend(quotient(these, processor));
        cells.push(format!("{:.1} s", compiled[place]));
        cells
    };
    let by_queues = on_gpu
        .get(1)
        .map(|these| median(quotients(these, processor)));
    Ok(((0..SCHEDULES.len()).map(cells).collect(), by_queues))
}

/// Samples per pixel of pictures that are compared.
const COMPARED: u32 = 4;
/// Share of the pixels that may differ: paths part where rounding decides otherwise.
const MOST_DIFFERING: f64 = 0.02;

/// Pictures of the same samples by the GPU and by the processor; and whether all agree.
pub(super) fn agreement(gpu: &Gpu, effort: &Effort<'_>, files: &[PathBuf]) -> Result<Measured> {
    let mut rows = vec![row([
        "scene",
        "rays",
        "pixels that differ",
        "mean of GPU / processor",
        "agree",
    ])];
    let mut all = true;
    for subject in subjects(effort.quick, files) {
        effort.go_on()?;
        let scene = subject.load()?;
        let options = RenderOptions {
            resolution: Some([128; 2]),
            triangulate_exact_shapes: true,
            ..RenderOptions::from_scene(&scene)
        };
        let prepared = PreparedScene::consume(scene, &options)?;
        let mut processor = Render::new(&prepared, &options, None);
        processor.samples = COMPARED;
        processor.pass()?;
        for rays in [Rays::Tree, Rays::Query] {
            // Software compiles shaders with queries for a minute each.
            let is_software = gpu.adapter.kind == AdapterKind::Software;
            if rays == Rays::Query && (is_software || !gpu.has_ray_queries()) {
                continue;
            }
            let on_gpu = TracerOptions {
                rays,
                ..TracerOptions::default()
            };
            let tracer = match tracer(gpu, &prepared, &options, on_gpu)? {
                Ok(tracer) => tracer,
                Err(reason) => {
                    rows.push(row([&subject.name, &rays.to_string(), &reason, "", ""]));
                    continue;
                }
            };
            let mut render = Render::new(&prepared, &options, Some(tracer));
            render.samples = COMPARED;
            render.pass()?;
            let [share, ratio] = difference(&processor, &render);
            let agree = share <= MOST_DIFFERING && (ratio - 1.0).abs() <= MOST_DIFFERING;
            all &= agree;
            rows.push(row([
                &subject.name,
                &rays.to_string(),
                &format!("{:.2} %", 100.0 * share),
                &format!("{ratio:.5}"),
                if agree { "yes" } else { "**no**" },
            ]));
        }
    }
    let text = format!(
        "## Pictures beside the processor's\n\n\
         The same {COMPARED} samples of 128x128 pixels. Pixels differ by more than a thousandth of themselves and of the \
         mean: where rounding decides otherwise, a path parts. At most {:.0} % may.\n\n{}",
        100.0 * MOST_DIFFERING,
        table(&rows)
    );
    Ok(Measured {
        agrees: all,
        ..Measured::table(text)
    })
}

/// Share of the pixels that differ, and the quotient of means.
fn difference(processor: &Render<'_>, gpu: &Render<'_>) -> [f64; 2] {
    let [a, b] = [processor, gpu].map(|render| render.renderer.film().picture().colour);
    let mean = |colours: &[Rgb<f32>]| {
        let sum: f64 = colours.iter().map(|c| f64::from(c.luminance())).sum();
        sum / colours.len() as f64
    };
    let [mean_a, mean_b] = [&a, &b].map(|c| mean(c));
    let differ = a.iter().zip(&b).filter(|(a, b)| {
        let bound = 1e-3 * (mean_a + f64::from(a.max_channel()));
        let apart = (**a - **b).to_array();
        // Written so that NaN differs.
        !apart.iter().all(|d| f64::from(d.abs()) <= bound)
    });
    [differ.count() as f64 / a.len() as f64, mean_b / mean_a]
}
