//! Dupuy and Benyoub 2023, section 4: the synthetic benchmark of the GPU.

use std::time::Instant;

use specula_gpu::{AdapterChoice, AdapterKind, Arrays, ComputeKernel, Gpu, GpuError};

use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Answer, Claim, Experiment, Lab, LabError, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "dupuy23-gpu-benchmark",
    source: Source::Dupuy23,
    item: "section 4, GPU",
    title: "time of a visible normal by the cap and by Heitz 2018, GPU",
    statement: "In a shader that samples 64 normals per thread the cap is 52.96 % (Intel Arc A770) and \
                39.25 % (NVIDIA RTX 2080) faster than Heitz 2018, consistently across roughness values \
                and incident directions.",
    run,
};

/// Samples of a thread.
const SAMPLES: usize = 64;
/// Threads of a workgroup, as the shader says.
const WORKGROUP: usize = 64;
/// Threads of the first run.
const FIRST: usize = 1 << 12;
/// Most threads of a run; where that is too short, it is repeated.
const MOST: usize = 1 << 22;

const ALPHAS: [f32; 3] = [0.1, 0.5, 1.0];
const THETAS_DEG: [f32; 3] = [0.0, 45.0, 80.0];

/// Samplers as modules of the shader library, with the functions that sample a normal.
const SAMPLERS: [(&str, &str); 2] = [("heitz", "heitz_sample_wm"), ("cap", "cap_sample_wm")];

const HEADS: [&str; 7] = [
    "adapter",
    "kind",
    "alpha",
    "theta [deg]",
    "Heitz 2018 [ns]",
    "cap [ns]",
    "quotient",
];
const CAPTION: &str = "Median times per sample, 64 samples per thread.";

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    lab.step(0.0, "opening the GPU")?;
    let gpu = match Gpu::open(&AdapterChoice::Best) {
        Ok(gpu) => gpu,
        Err(GpuError::NoAdapter) => return without_gpu(lab),
        Err(error) => return Err(error.into()),
    };
    let rounds = lab.pick(11, 100);
    let seconds = lab.pick(0.005, 0.01);
    let kernels = SAMPLERS.map(|(module, function)| kernel(&gpu, module, function));
    let [heitz, cap] = kernels;
    let kernels = [heitz?, cap?];
    let mut table = Table::new("times", CAPTION, &HEADS);
    let mut lines = Vec::new();
    let mut quotients = Vec::new();
    let mut farthest: f64 = 0.0;
    for (i, theta) in THETAS_DEG.into_iter().enumerate() {
        let mut points = Vec::new();
        for (j, alpha) in ALPHAS.into_iter().enumerate() {
            lab.step((3 * i + j) as f64 / 9.0, "timing samples")?;
            let mut works = Vec::new();
            for kernel in &kernels {
                works.push(Work::new(&gpu, kernel, alpha, theta, seconds)?);
            }
            let mut times = [Vec::new(), Vec::new()];
            for _ in 0..rounds {
                for (work, times) in works.iter().zip(&mut times) {
                    times.push(work.nanoseconds(&gpu)?);
                }
            }
            farthest = farthest.max((works[0].mean / works[1].mean - 1.0).abs());
            let ratio = median(times[0].iter().zip(&times[1]).map(|(a, b)| a / b));
            let [heitz, cap] = times.map(median);
            quotients.push(ratio);
            points.push([f64::from(alpha), ratio]);
            table.push([
                gpu.adapter.name.as_str().into(),
                gpu.adapter.kind.to_string().into(),
                alpha.into(),
                theta.into(),
                heitz.into(),
                cap.into(),
                ratio.into(),
            ]);
        }
        lines.push(Series::new(&format!("theta = {theta} deg"), i, points));
    }
    lab.table(table)?;
    plot(lab, lines)?;
    Ok(verdict(&gpu, &quotients, farthest))
}

fn plot(lab: &mut Lab<'_>, mut lines: Vec<Series>) -> Result<()> {
    for (name, style, value) in [
        ("paper, Arc A770: 1.53", 6, 1.5296),
        ("paper, RTX 2080: 1.39", 7, 1.3925),
    ] {
        lines.push(Series::new(name, style, vec![[0.0, value], [1.0, value]]));
    }
    let points = lines.iter().flat_map(|line| &line.points);
    let highest = points.map(|p| p[1]).fold(0.0, f64::max);
    let panel = Panel {
        title: "64 normals per thread".to_owned(),
        x: Axis::linear("alpha").from_to(0.0, 1.0),
        y: Axis::linear("time of Heitz 2018 / time of the cap").from_to(0.0, 1.1 * highest),
        content: Content::Lines(lines),
    };
    let caption = "How many times faster the cap samples than Heitz 2018.";
    lab.plot("speed-up", caption, &Figure::single(panel))
}

/// A sampler's kernel. The view turns before each sample, so that nothing is left to be computed once for
/// all of them.
fn kernel(gpu: &Gpu, module: &str, function: &str) -> Result<ComputeKernel> {
    let library = specula_shaders::compose(&[module])
        .map_err(|e| LabError::Output(format!("the shader of '{module}': {e}")))?;
    let text = format!(
        "{library}
@group(0) @binding(0) var<storage, read> samples_view: array<f32>;
@group(0) @binding(1) var<storage, read_write> samples_sums: array<f32>;

@compute @workgroup_size({WORKGROUP})
fn samples_main(
    @builtin(global_invocation_id) place: vec3u,
    @builtin(num_workgroups) groups: vec3u,
) {{
    let thread = place.y * groups.x * {WORKGROUP}u + place.x;
    if thread >= arrayLength(&samples_sums) {{
        return;
    }}
    let alpha = vec2f(samples_view[3]);
    var wo = vec3f(samples_view[0], samples_view[1], samples_view[2]);
    var u = fract(vec2f(0.5) + f32(thread % 8191u) * vec2f(0.8191725, 0.6710436));
    var sum = 0.0;
    for (var sample = 0u; sample < {SAMPLES}u; sample += 1u) {{
        wo = vec3f(0.8 * wo.x - 0.6 * wo.y, 0.6 * wo.x + 0.8 * wo.y, wo.z);
        u = fract(u + vec2f(0.7548777, 0.5698403));
        let wm = {function}(alpha, wo, u);
        sum += wm.z + 0.25 * dot(wm, wo);
    }}
    samples_sums[thread] = sum;
}}
"
    );
    let shader = gpu.shader(module, &text)?;
    Ok(ComputeKernel::new(gpu, &shader, "samples_main", 1)?)
}

/// A kernel with its arrays, sized to last long enough.
struct Work<'a> {
    kernel: &'a ComputeKernel,
    arrays: Arrays,
    threads: usize,
    runs: usize,
    /// Mean over the samples of what they added.
    mean: f64,
}

impl<'a> Work<'a> {
    fn new(
        gpu: &Gpu,
        kernel: &'a ComputeKernel,
        alpha: f32,
        theta: f32,
        least: f64,
    ) -> Result<Self> {
        let (sine, cosine) = theta.to_radians().sin_cos();
        let view = [sine, 0.0, cosine, alpha];
        let bytes: Vec<u8> = view.iter().flat_map(|x: &f32| x.to_le_bytes()).collect();
        let upload = |threads: usize| kernel.upload(gpu, &[&bytes], 4 * threads as u64);
        let mut work = Self {
            kernel,
            arrays: upload(FIRST)?,
            threads: FIRST,
            runs: 1,
            mean: 0.0,
        };
        // The first run may still compile.
        work.seconds(gpu)?;
        while work.seconds(gpu)? < least {
            if 2 * work.threads <= MOST {
                work.threads *= 2;
                work.arrays = upload(work.threads)?;
            } else {
                work.runs *= 2;
            }
        }
        let bytes = work.arrays.output(gpu)?;
        let sums = bytes.chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]);
        let total: f64 = sums.map(|b| f64::from(f32::from_le_bytes(b))).sum();
        work.mean = total / (work.threads * SAMPLES) as f64;
        Ok(work)
    }

    /// Of all runs.
    fn seconds(&self, gpu: &Gpu) -> Result<f64> {
        let groups = u32::try_from(self.threads / WORKGROUP).unwrap_or(u32::MAX);
        // Powers of two.
        let across = groups.min(1 << 15);
        let begin = Instant::now();
        for _ in 0..self.runs {
            self.kernel
                .run(gpu, &self.arrays, [across, groups / across, 1])?;
        }
        Ok(begin.elapsed().as_secs_f64())
    }

    /// Of a sample.
    fn nanoseconds(&self, gpu: &Gpu) -> Result<f64> {
        Ok(1e9 * self.seconds(gpu)? / (self.threads * self.runs * SAMPLES) as f64)
    }
}

/// The verdict where there is no adapter.
fn without_gpu(lab: &mut Lab<'_>) -> Result<Verdict> {
    let mut table = Table::new("times", CAPTION, &HEADS);
    let nothing = || f64::NAN.into();
    table.push([
        "no GPU".into(),
        "none".into(),
        nothing(),
        nothing(),
        nothing(),
        nothing(),
        nothing(),
    ]);
    lab.table(table)?;
    plot(lab, Vec::new())?;
    Ok(Verdict {
        summary: "Not measured: no GPU here.".to_owned(),
        claims: vec![faster("no GPU here".to_owned(), Answer::Undecided)],
        caveat:
            "No adapter of Vulkan, Metal or Direct3D 12 was found; dupuy23-cpu-benchmark measures \
                 the same on the processor."
                .to_owned(),
    })
}

fn faster(measured: String, holds: Answer) -> Claim {
    Claim::measured(
        "The cap samples a visible normal faster than Heitz 2018",
        "52.96 % and 39.25 % (read as 1.53 and 1.39 times)",
        measured,
        holds,
    )
}

fn verdict(gpu: &Gpu, quotients: &[f64], farthest: f64) -> Verdict {
    let is_software = gpu.adapter.kind == AdapterKind::Software;
    let middle = median(quotients.iter().copied());
    let low = quotients.iter().copied().fold(f64::INFINITY, f64::min);
    let high = quotients.iter().copied().fold(0.0, f64::max);
    let where_measured = if is_software {
        format!("{}, which is software and no GPU", gpu.adapter.name)
    } else {
        gpu.adapter.name.clone()
    };
    // Times of a software adapter are not those of a GPU.
    let of_gpu = |holds: bool| {
        if is_software {
            Answer::Undecided
        } else {
            holds.into()
        }
    };
    let spread = format!("{middle:.2} times ({low:.2} to {high:.2}) on {where_measured}");
    Verdict {
        summary: format!("Heitz 2018 takes {spread}; paper 1.53 and 1.39."),
        claims: vec![
            faster(spread.clone(), of_gpu(middle > 1.1)),
            Claim::measured(
                "Consistently across roughness values and incident directions",
                "consistent",
                format!("quotients from {low:.2} to {high:.2} on {where_measured}"),
                of_gpu(low > 1.0 && high < 1.5 * low),
            ),
            Claim::law(
                "Both sample the same distribution",
                "the same quality",
                format!("means differ by at most {:.2} %", 100.0 * farthest),
                farthest < 0.01,
            ),
        ],
        caveat: if is_software {
            "The adapter is software on the processor: its times tell nothing of a GPU, and the claims \
             about times are undecided."
                .to_owned()
        } else {
            "Another GPU than the paper's; times are the clock's around whole runs.".to_owned()
        },
    }
}
