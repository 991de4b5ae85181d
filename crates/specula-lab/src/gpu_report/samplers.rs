//! Samplers on the GPU: cost of a sample, alone and with its density and weight.

use std::time::{Duration, Instant};

use specula_bsdf::math::warp::uniform_sphere;
use specula_gpu::{Arrays, ComputeKernel, Gpu};

use super::text::{figure, range, row, table};
use super::{Effort, Result};
use crate::experiments::stopwatch::median;

/// Samples of a thread, as in Dupuy and Benyoub 2023, section 4.
const SAMPLES: usize = 64;
/// Threads of a workgroup, as the shader says.
const WORKGROUP: usize = 64;
/// Different views with their alphas.
const POINTS: u16 = 4096;
/// Threads of the first run.
const FIRST: usize = 1 << 14;
/// Most threads of a run; where that is too short, it is run repeatedly.
const MOST: usize = 1 << 24;
/// Least seconds of a run.
const SECONDS: f64 = 0.1;
/// Most by which two estimates of the same mean may differ.
const DIFFERENCE: f64 = 0.01;

/// What a thread does in a sample: WGSL that reads `alpha`, `wo` and `u`, and adds to `sum`.
struct Work {
    name: &'static str,
    modules: &'static [&'static str],
    code: &'static str,
}

/// What a direction's sample adds.
macro_rules! direction {
    ($sample:literal) => {
        concat!("let w = ", $sample, "; sum += vec4f(w, w.z);")
    };
}

/// The loop alone, two samplers of normals, four of reflections.
const DIRECTIONS: [Work; 7] = [
    Work {
        name: "none",
        modules: &[],
        code: direction!("vec3f(u, wo.x)"),
    },
    Work {
        name: "Heitz 2018",
        modules: &["heitz"],
        code: direction!("heitz_sample_wm(alpha, wo, u)"),
    },
    Work {
        name: "cap",
        modules: &["cap"],
        code: direction!("cap_sample_wm(alpha, wo, u)"),
    },
    Work {
        name: "Heitz 2018",
        modules: &["heitz", "reflection"],
        code: direction!("reflection_mirrored(wo, heitz_sample_wm(alpha, wo, u))"),
    },
    Work {
        name: "cap",
        modules: &["cap"],
        code: direction!("cap_sample_direction(alpha, wo, u)"),
    },
    Work {
        name: "bounded",
        modules: &["bounded"],
        code: direction!("bounded_sample_direction(alpha, wo, u)"),
    },
    Work {
        name: "exact",
        modules: &["exact"],
        code: direction!("exact_sample_direction(alpha, wo, u)"),
    },
];

/// What a reflection with its density and weight adds.
macro_rules! reflection {
    ($strategy:literal) => {
        concat!(
            "let facets = MicrofacetsModel(alpha, DISTRIBUTION_GGX, MASKING_HEIGHT_CORRELATED, ",
            $strategy,
            ");
        let lobe = RoughConductor(facets, reflectance_constant(vec3f(1.0)));
        let sampled = rough_conductor_sample(lobe, wo, vec3f(0.5, u), BSDF_SAMPLE_RADIANCE);
        sum += vec4f(sampled.wi.xy, sampled.pdf, sampled.weight.x);"
        )
    };
}

/// White metal with every sampler.
const REFLECTIONS: [Work; 4] = [
    Work {
        name: "Heitz 2018",
        modules: &["rough_conductor"],
        code: reflection!("SAMPLER_HEITZ"),
    },
    Work {
        name: "cap",
        modules: &["rough_conductor"],
        code: reflection!("SAMPLER_CAP"),
    },
    Work {
        name: "bounded",
        modules: &["rough_conductor"],
        code: reflection!("SAMPLER_BOUNDED"),
    },
    Work {
        name: "exact",
        modules: &["rough_conductor"],
        code: reflection!("SAMPLER_EXACT"),
    },
];

/// The shader of a thread's work. The view turns before each sample, so that nothing is left to be computed
/// once for all of them.
fn shader(work: &Work) -> Result<String> {
    let modules = match work.modules {
        [] => String::new(),
        wanted => specula_shaders::compose(wanted)?,
    };
    let code = work.code;
    Ok(format!(
        "{modules}
@group(0) @binding(0) var<storage, read> samples_points: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> samples_sums: array<vec4f>;

@compute @workgroup_size({WORKGROUP})
fn samples_main(
    @builtin(global_invocation_id) place: vec3u,
    @builtin(num_workgroups) groups: vec3u,
) {{
    let lane = place.y * groups.x * {WORKGROUP}u + place.x;
    if lane >= arrayLength(&samples_sums) {{
        return;
    }}
    let point = 2u * (lane % {POINTS}u);
    let first = samples_points[point];
    let second = samples_points[point + 1u];
    let alpha = vec2f(first.w, second.x);
    var wo = first.xyz;
    var u = second.yz;
    var sum = vec4f(0.0);
    for (var i = 0u; i < {SAMPLES}u; i += 1u) {{
        wo = vec3f(0.8 * wo.x - 0.6 * wo.y, 0.6 * wo.x + 0.8 * wo.y, wo.z);
        u = fract(u + vec2f(0.7548777, 0.5698403));
        {code}
    }}
    samples_sums[lane] = sum;
}}
"
    ))
}

/// Views over the hemisphere with alphas in [0.05, 1], from the R2 sequence: two vectors each, of the
/// view, the alphas and the first random numbers.
fn points(is_isotropic: bool) -> Vec<[f32; 4]> {
    let at = |i: u16, step: f64| {
        #[allow(clippy::cast_possible_truncation, reason = "a number in [0, 1)")]
        let x = (0.5 + f64::from(i) * step).fract() as f32;
        x.min(0.999_999)
    };
    let point = |i: u16| {
        let w = uniform_sphere([at(i, 0.819_172_5), at(i, 0.671_043_6)]);
        let alpha_x = 0.05 + 0.95 * at(i, 0.754_877_7);
        let alpha_y = 0.05 + 0.95 * at(i, 0.569_840_3);
        let alpha_y = if is_isotropic { alpha_x } else { alpha_y };
        let u = [at(i, 0.856_674_9), at(i, 0.733_891_9)];
        [
            [w.x, w.y, w.z.abs().max(1e-3), alpha_x],
            [alpha_y, u[0], u[1], 0.0],
        ]
    };
    (0..POINTS).flat_map(point).collect()
}

/// A kernel with its arrays, sized to last long enough.
struct Measured {
    kernel: ComputeKernel,
    arrays: Arrays,
    threads: usize,
    runs: usize,
    /// Mean over the samples of what they added last.
    mean: f64,
}

impl Measured {
    fn new(gpu: &Gpu, work: &Work, points: &[[f32; 4]]) -> Result<(Self, Duration)> {
        let start = Instant::now();
        let module = gpu.shader(work.name, &shader(work)?)?;
        let kernel = ComputeKernel::new(gpu, &module, "samples_main", 1)?;
        let arrays = upload(gpu, &kernel, points, WORKGROUP)?;
        kernel.run(gpu, &arrays, workgroups(WORKGROUP))?;
        let compiled = start.elapsed();
        let most = usize::try_from(gpu.adapter.largest_array / 16)?.min(MOST);
        let mut measured = Self {
            kernel,
            arrays,
            threads: FIRST,
            runs: 1,
            mean: 0.0,
        };
        measured.arrays = upload(gpu, &measured.kernel, points, FIRST)?;
        while measured.seconds(gpu)? < SECONDS {
            if 2 * measured.threads <= most {
                measured.threads *= 2;
                measured.arrays = upload(gpu, &measured.kernel, points, measured.threads)?;
            } else {
                measured.runs *= 2;
            }
        }
        measured.mean = measured.mean(gpu)?;
        Ok((measured, compiled))
    }

    /// Of a whole run.
    fn seconds(&self, gpu: &Gpu) -> Result<f64> {
        let start = Instant::now();
        for _ in 0..self.runs {
            self.kernel
                .run(gpu, &self.arrays, workgroups(self.threads))?;
        }
        Ok(start.elapsed().as_secs_f64())
    }

    /// Nanoseconds of a sample.
    fn nanoseconds(&self, gpu: &Gpu) -> Result<f64> {
        Ok(1e9 * self.seconds(gpu)? / (self.threads * self.runs * SAMPLES) as f64)
    }

    /// Of the last component of the sums.
    fn mean(&self, gpu: &Gpu) -> Result<f64> {
        let bytes = self.arrays.output(gpu)?;
        let sums: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        let total: f64 = sums.iter().map(|s| f64::from(s[3])).sum();
        Ok(total / (sums.len() * SAMPLES) as f64)
    }
}

fn upload(
    gpu: &Gpu,
    kernel: &ComputeKernel,
    points: &[[f32; 4]],
    threads: usize,
) -> Result<Arrays> {
    Ok(kernel.upload(gpu, &[bytemuck::cast_slice(points)], 16 * threads as u64)?)
}

/// * `threads`: a power of two.
fn workgroups(threads: usize) -> [u32; 3] {
    let groups = u32::try_from(threads / WORKGROUP).unwrap_or(u32::MAX);
    let across = groups.min(1 << 15);
    [across, groups / across, 1]
}

/// What was measured of a list of works with equal and with different alphas.
struct Outcome {
    /// Of every round: nanoseconds of a sample.
    times: [Vec<Vec<f64>>; 2],
    means: [Vec<f64>; 2],
    compilation: f64,
}

impl Outcome {
    fn new(gpu: &Gpu, works: &[Work], effort: &Effort<'_>) -> Result<Self> {
        let mut compilation = 0.0;
        let mut measured = [Vec::new(), Vec::new()];
        for (of_alphas, is_isotropic) in measured.iter_mut().zip([true, false]) {
            let points = points(is_isotropic);
            for work in works {
                let (kernel, compiled) = Measured::new(gpu, work, &points)?;
                compilation += compiled.as_secs_f64();
                of_alphas.push(kernel);
            }
        }
        let mut times = [(); 2].map(|()| vec![Vec::new(); works.len()]);
        for _ in 0..effort.sample_rounds {
            effort.go_on()?;
            for (kernels, times) in measured.iter().zip(&mut times) {
                for (kernel, times) in kernels.iter().zip(times) {
                    times.push(kernel.nanoseconds(gpu)?);
                }
            }
        }
        Ok(Self {
            times,
            means: measured.map(|kernels| kernels.iter().map(|k| k.mean).collect()),
            compilation,
        })
    }

    /// Median nanoseconds of the work at a place.
    fn nanoseconds(&self, alphas: usize, place: usize) -> f64 {
        median(self.times[alphas][place].clone())
    }

    /// Of every round: the ratio of two works' times.
    fn ratios(&self, alphas: usize, place: usize, to: usize) -> Vec<f64> {
        let [a, b] = [place, to].map(|i| &self.times[alphas][i]);
        a.iter().zip(b).map(|(a, b)| a / b).collect()
    }

    /// Median of the rounds' ratios of two works' times.
    fn ratio(&self, alphas: usize, place: usize, to: usize) -> f64 {
        median(self.ratios(alphas, place, to))
    }

    /// How far single rounds stray from the medians of ratios, as a sentence.
    ///
    /// * `to`: the place that all works but itself are compared with.
    fn strays(&self, to: usize) -> String {
        let places = 0..self.times[0].len();
        let all = places.flat_map(|place| {
            (0..2).flat_map(move |alphas| {
                let middle = self.ratio(alphas, place, to);
                let ratios = self.ratios(alphas, place, to);
                ratios.into_iter().map(move |r| r / middle)
            })
        });
        let [low, high] = range(all);
        format!("Ratios of single rounds are {low:.2} to {high:.2} of their medians.")
    }

    /// Fails where two works that estimate the same do not.
    fn agree(&self, works: &[Work], places: [usize; 2]) -> Result<()> {
        for means in &self.means {
            let [a, b] = places.map(|i| means[i]);
            let is_same = (a - b).abs() <= DIFFERENCE * b.abs();
            if !is_same {
                let [first, second] = places.map(|i| works[i].name);
                return Err(format!("{first} and {second} have the means {a} and {b}").into());
            }
        }
        Ok(())
    }
}

/// Dupuy and Benyoub 2023, section 4, the synthetic benchmark of the GPU.
pub(super) fn normals(gpu: &Gpu, effort: &Effort<'_>) -> Result<String> {
    let rounds = effort.sample_rounds;
    let outcome = Outcome::new(gpu, &DIRECTIONS, effort)?;
    outcome.agree(&DIRECTIONS, [1, 2])?;
    outcome.agree(&DIRECTIONS, [3, 4])?;
    let mut rows = vec![row([
        "sampled",
        "sampler",
        "ax = ay: ns",
        "Heitz / this",
        "ax, ay: ns",
        "Heitz / this",
        "paper: Heitz / this",
    ])];
    for (place, work) in DIRECTIONS.iter().enumerate() {
        let (what, heitz) = match place {
            0 => ("the loop alone", None),
            1 | 2 => ("normals", Some(1)),
            _ => ("reflections", Some(3)),
        };
        let paper = if place == 2 { "1.39, 1.53" } else { "" };
        let mut cells = row([what, work.name]);
        for alphas in 0..2 {
            let ratio = heitz.map(|to| figure(outcome.ratio(alphas, to, place)));
            cells.push(figure(outcome.nanoseconds(alphas, place)));
            cells.push(ratio.unwrap_or_default());
        }
        cells.push(paper.to_owned());
        rows.push(cells);
    }
    Ok(format!(
        "## Cost of a sample (Dupuy and Benyoub 2023, section 4)\n\n\
         Every thread samples {SAMPLES} times and sums. Alphas in [0.05, 1], views over the hemisphere; the view \
         turns before each sample.\n\
         The paper: caps 39.25 % (RTX 2080) and 52.96 % (Arc A770) faster than Heitz 2018, read as \
         quotients of 1.39 and 1.53.\n\
         Medians of {rounds} rounds; {} shaders compiled in {:.1} s. {}\n\n{}",
        2 * DIRECTIONS.len(),
        outcome.compilation,
        outcome.strays(3),
        table(&rows)
    ))
}

/// Tokuyoshi and Eto 2024, section 6, the white furnace on the GPU.
pub(super) fn furnace(gpu: &Gpu, effort: &Effort<'_>) -> Result<String> {
    let rounds = effort.sample_rounds;
    let outcome = Outcome::new(gpu, &REFLECTIONS, effort)?;
    for place in [0, 2, 3] {
        outcome.agree(&REFLECTIONS, [place, 1])?;
    }
    let mut rows = vec![row([
        "sampler",
        "ax = ay: ns",
        "this / cap",
        "albedo",
        "ax, ay: ns",
        "this / cap",
        "albedo",
    ])];
    for (place, work) in REFLECTIONS.iter().enumerate() {
        let mut cells = row([work.name]);
        for alphas in 0..2 {
            cells.push(figure(outcome.nanoseconds(alphas, place)));
            cells.push(figure(outcome.ratio(alphas, place, 1)));
            cells.push(format!("{:.4}", outcome.means[alphas][place]));
        }
        rows.push(cells);
    }
    Ok(format!(
        "## White furnace (Tokuyoshi and Eto 2024, section 6)\n\n\
         As above, of white rough metal: a reflection with its density and weight. The mean weight is the \
         albedo, the same for all samplers.\n\
         The paper: no clear difference on the GPU between the bounded cap and the cap.\n\
         Medians of {rounds} rounds; {} shaders compiled in {:.1} s. {}\n\n{}",
        2 * REFLECTIONS.len(),
        outcome.compilation,
        outcome.strays(1),
        table(&rows)
    ))
}
