//! Multiple bounces between microfacets: means of values and samples over many streams, against those of
//! the twins in `f64` with other streams, by z-tests.

use specula_bsdf::bsdf::{MultibounceConductor, MultibounceDielectric, MultibounceDiffuse};
use specula_bsdf::math::{Stream, rgb};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};

use super::{ggx, glass, metal, reflectance, tints};
use crate::harness::{direction, evaluate, gpu, product, round, vector};

/// Estimates of each cell, on either side.
const ESTIMATES: usize = 16_384;
/// Streams that one invocation takes.
const STREAMS: usize = 64;
/// Standard deviations beyond which two means differ: by chance once in 150 000 cells.
const LIMIT: f64 = 4.5;

/// Sums of a statistic.
#[derive(Clone, Copy, Default)]
struct Sums {
    first: f64,
    second: f64,
}

impl Sums {
    fn add(&mut self, value: f64) {
        self.first += value;
        self.second += value * value;
    }

    fn mean(self) -> f64 {
        self.first / count()
    }

    /// Of the mean.
    fn variance(self) -> f64 {
        (self.second / count() - self.mean() * self.mean()).max(0.0) / count()
    }
}

fn count() -> f64 {
    ESTIMATES.to_string().parse().unwrap_or(0.0)
}

/// A loop over streams of a cell's estimates: `$estimate` makes `value`, a `vec3f` of statistics.
macro_rules! summed {
    ($($estimate:tt)*) => {
        concat!(
            "var first = vec3f(0.0);
             var second = vec3f(0.0);
             for (var k = 0u; k < 64u; k++) {
                 stream.state = vec2u(u32(x[8]) + k, 0x6eedu);
                 ",
            $($estimate)*,
            "
                 first += value;
                 second += value * value;
             }
             y[0] = first.x; y[1] = first.y; y[2] = first.z;
             y[3] = second.x; y[4] = second.y; y[5] = second.z;"
        )
    };
}
pub(crate) use summed;

/// The statistics of a sample: energy, and where it goes.
macro_rules! moments {
    ($sample:literal) => {
        summed!(
            "let u_lobe = stream_next(&stream);
             let u = vec3f(u_lobe, walk_pair(&stream));
             let sampled = ",
            $sample,
            ";
             var value = vec3f(0.0);
             if sampled.flags != 0u {
                 value = sampled.weight.r * vec3f(1.0, sampled.wi.x, sampled.wi.z);
             }"
        )
    };
}

/// Compares the means of the shader's estimates with the twin's; returns the largest z and a line of the
/// report.
///
/// * `cells`: arguments without the seed's.
/// * `twin`: an estimate of the statistics in `f64`.
pub(crate) fn compare<const N: usize>(
    name: &str,
    modules: &[&str],
    body: &str,
    cells: &[[f32; N]],
    twin: impl Fn(&[f64], &mut Stream) -> [f64; 3],
) -> Option<(f64, String)> {
    let gpu = gpu(&format!("means of {name}"))?;
    let rows = ESTIMATES / STREAMS;
    let mut inputs = Vec::with_capacity(cells.len() * rows);
    for (c, cell) in cells.iter().enumerate() {
        for k in 0..rows {
            let mut row = *cell;
            row[8] = seed((c * rows + k) * STREAMS);
            inputs.push(row);
        }
    }
    let sums = evaluate(gpu, modules, body, &inputs, 6);
    let (mut worst, mut least) = (0.0_f64, Vec::new());
    let mut stream = Stream::new(0x7eed);
    for (cell, sums) in cells.iter().zip(sums.chunks(6 * rows)) {
        let x: Vec<f64> = cell.iter().copied().map(f64::from).collect();
        let (mut shader, mut rust) = ([Sums::default(); 3], [Sums::default(); 3]);
        for row in sums.chunks(6) {
            for (k, sum) in shader.iter_mut().enumerate() {
                sum.first += f64::from(row[k]);
                sum.second += f64::from(row[k + 3]);
            }
        }
        for _ in 0..ESTIMATES {
            let values = twin(&x, &mut stream);
            rust.iter_mut().zip(values).for_each(|(sum, v)| sum.add(v));
        }
        for (a, b) in shader.iter().zip(&rust) {
            let sigma = (a.variance() + b.variance())
                .sqrt()
                .max(1e-7 * b.mean().abs());
            worst = worst.max((a.mean() - b.mean()).abs() / sigma.max(1e-30));
        }
        let sigma = (shader[0].variance() + rust[0].variance()).sqrt();
        // 1.28: nine times out of ten.
        least.push((LIMIT + 1.28) * sigma / rust[0].mean().abs().max(1e-30));
    }
    least.sort_by(f64::total_cmp);
    let power = least[least.len() / 2];
    assert!(power < 0.2, "{name}: a bias of {power} would go unnoticed");
    let line = format!(
        "  {name:24} {:>6} means, largest z {worst:4.2}; notices a bias of {:.2} % (median cell; \
         best {:.2} %) nine times out of ten\n",
        3 * cells.len(),
        100.0 * power,
        100.0 * least[0]
    );
    Some((worst, line))
}

/// The report's line where no mean differs.
pub(crate) fn held(compared: Option<(f64, String)>) -> String {
    let Some((worst, line)) = compared else {
        return String::new();
    };
    assert!(worst < LIMIT, "{line}");
    line
}

fn seed(number: usize) -> f32 {
    u32::try_from(number).map_or(0.0, |n| round(f64::from(n)))
}

/// Alphas, views and lights at some distance from each other, with a place for the seed.
fn cells(lights: &[[f32; 3]]) -> Vec<[f32; 9]> {
    let alphas = [[0.1, 0.1], [1.0, 1.0], [0.2, 0.8]];
    let wos = [0.9, 0.3, -0.3].map(|cosine| direction(cosine, 0.4));
    let pairs: Vec<[f32; 5]> = product(&alphas, &wos);
    let pairs: Vec<[f32; 8]> = product(&pairs, lights);
    product(&pairs, &[[0.0]])
}

/// Views alone.
fn views() -> Vec<[f32; 9]> {
    cells(&[[0.0, 0.0, 1.0]])
}

fn conductor(x: &[f64], model: MultibounceModel) -> MultibounceConductor<f64> {
    MultibounceConductor::new(ggx(x), reflectance(), model)
}

/// The statistics of an estimate.
fn of_value(f: Rgb<f64>) -> [f64; 3] {
    f.to_array()
}

/// The statistics of a sample.
fn of_sample(sampled: Option<(Vec3<f64>, Rgb<f64>)>) -> [f64; 3] {
    sampled.map_or([0.0; 3], |(wi, weight)| {
        [weight.r, weight.r * wi.x, weight.r * wi.z]
    })
}

const METALS: &[&str] = &[
    "multibounce_conductor",
    "mis_pdf",
    "walk",
    "reflectance",
    "distribution",
];

const METAL_VALUE: &str = metal!(
    "let lobe = MultibounceConductor(facets, u32(x[9]), MIS_PDF_LAMBERT);
     ",
    summed!("let value = multibounce_conductor_eval(lobe, wo, wi, &stream);")
);

const METAL_SAMPLE: &str = metal!(
    "let lobe = MultibounceConductor(facets, u32(x[9]), MIS_PDF_LAMBERT);
     ",
    moments!("multibounce_conductor_walk(lobe, wo, u.yz, &stream)")
);

#[test]
fn metals_have_the_means_of_the_twins() {
    let lights = [direction(0.7, 2.0), direction(0.1, 0.4)];
    let mut report = String::new();
    for (number, model) in [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
        .into_iter()
        .zip(MultibounceModel::ALL)
    {
        let of_model = |cells: Vec<[f32; 9]>| product::<9, 1, 10>(&cells, &[[number]]);
        report += &held(compare(
            &format!("{model} values"),
            METALS,
            METAL_VALUE,
            &of_model(cells(&lights)),
            |x, stream| of_value(conductor(x, model).estimate(vector(x, 2), vector(x, 5), stream)),
        ));
        report += &held(compare(
            &format!("{model} samples"),
            METALS,
            METAL_SAMPLE,
            &of_model(views()),
            |x, stream| {
                let u = [stream.next(), stream.next()];
                of_sample(conductor(x, model).sample_walk(vector(x, 2), u, stream))
            },
        ));
    }
    println!("means of metals\n{report}");
}

#[test]
fn means_of_another_model_are_told_apart() {
    let light = [direction(0.7, 2.0)];
    let wang: Vec<[f32; 10]> = product(&cells(&light), &[[2.0]]);
    let model = MultibounceModel::Heitz2016;
    let compared = compare("wang for heitz", METALS, METAL_VALUE, &wang, |x, stream| {
        of_value(conductor(x, model).estimate(vector(x, 2), vector(x, 5), stream))
    });
    if let Some((worst, _)) = compared {
        println!("wang for heitz: largest z {worst:.1}");
        assert!(worst > LIMIT, "{worst}");
    }
}

#[test]
fn dielectrics_have_the_means_of_the_twins() {
    const MODULES: &[&str] = &[
        "multibounce_dielectric",
        "mis_pdf",
        "walk",
        "reflectance",
        "distribution",
        "tints",
    ];
    const GLASS: &str = glass!(
        "u32(x[10])",
        "MIS_PDF_LAMBERT",
        summed!("let value = multibounce_dielectric_eval(lobe, wo, wi, 0u, &stream);")
    );
    const GLASS_SAMPLE: &str = glass!(
        "u32(x[10])",
        "MIS_PDF_LAMBERT",
        moments!("multibounce_dielectric_sample(lobe, wo, u, 0u, &stream)")
    );
    let lights = [direction(0.7, 2.0), direction(-0.5, 3.5)];
    let mut report = String::new();
    for (number, model) in [
        (0.0, MultibounceModel::Heitz2016),
        (6.0, MultibounceModel::StratifiedBidirectional),
    ] {
        let of_model = |cells: Vec<[f32; 9]>| product::<9, 2, 11>(&cells, &[[1.5, number]]);
        let lobe = |x: &[f64]| {
            MultibounceDielectric::new(ggx(x), x[9], model)
                .with_mis_pdf(MisPdf::Lambert)
                .with_tints(tints())
        };
        report += &held(compare(
            &format!("dielectric {model} values"),
            MODULES,
            GLASS,
            &of_model(cells(&lights)),
            |x, stream| {
                let (wo, wi) = (vector(x, 2), vector(x, 5));
                of_value(
                    lobe(x)
                        .eval_pdf_random(wo, wi, Transport::Radiance, stream)
                        .0,
                )
            },
        ));
        report += &held(compare(
            &format!("dielectric {model} samples"),
            MODULES,
            GLASS_SAMPLE,
            &of_model(views()),
            |x, stream| {
                let u = [stream.next(), stream.next(), stream.next()];
                let sampled = lobe(x).sample_random(vector(x, 2), u, Transport::Radiance, stream);
                of_sample(sampled.map(|s| (s.wi, s.weight)))
            },
        ));
    }
    println!("means of dielectrics\n{report}");
}

#[test]
fn diffuse_facets_have_the_means_of_the_twins() {
    const MODULES: &[&str] = &["multibounce_diffuse", "walk", "reflectance", "distribution"];
    const DIFFUSE: &str = metal!(
        "let lobe = MultibounceDiffuse(normals, vec3f(0.9, 0.5, 0.1));
         ",
        summed!("let value = multibounce_diffuse_eval(lobe, wo, wi, &stream);")
    );
    const DIFFUSE_SAMPLE: &str = metal!(
        "let lobe = MultibounceDiffuse(normals, vec3f(0.9, 0.5, 0.1));
         ",
        moments!("multibounce_diffuse_sample(lobe, wo, u, &stream)")
    );
    let lobe = |x: &[f64]| MultibounceDiffuse::new(ggx(x), rgb(0.9, 0.5, 0.1));
    let above = [direction(0.7, 2.0), direction(0.1, 0.4)];
    let mut report = held(compare(
        "diffuse values",
        MODULES,
        DIFFUSE,
        &cells(&above),
        |x, stream| {
            let (wo, wi) = (vector(x, 2), vector(x, 5));
            of_value(
                lobe(x)
                    .eval_pdf_random(wo, wi, Transport::Radiance, stream)
                    .0,
            )
        },
    ));
    report += &held(compare(
        "diffuse samples",
        MODULES,
        DIFFUSE_SAMPLE,
        &views(),
        |x, stream| {
            let u = [stream.next(), stream.next(), stream.next()];
            let sampled = lobe(x).sample_random(vector(x, 2), u, Transport::Radiance, stream);
            of_sample(sampled.map(|s| (s.wi, s.weight)))
        },
    ));
    println!("means of diffuse facets\n{report}");
}
