//! samples of the samplers on the GPU against the densities of their `f64` twins, by chi-square tests,
//! and integrals of the shaders' densities.

use specula_bsdf::math::Vec3;
use specula_bsdf::vndf::{beckmann, bounded, cap, exact, heitz, reflect};
use specula_bsdf::{Alpha, Real};
use specula_stat::Rng;
use specula_stat::chi_square::{self, ChiSquare, ChiSquareOptions};
use specula_stat::quadrature::{Patch, Peak, Quadrature};
use specula_stat::z_test::sidak;

use crate::harness::{direction, evaluate, gpu, round};
use crate::ndf::is_visible;

type Density = fn(Alpha<f64>, Vec3<f64>, Vec3<f64>) -> f64;

/// A sampler of the shaders with the density of its twin.
struct Sampler {
    name: &'static str,
    modules: &'static [&'static str],
    /// An expression of `alpha`, `wo` and `u`.
    sample: &'static str,
    density: Density,
    /// Whether samples below the horizon are rejected.
    is_reflection: bool,
}

const SAMPLERS: [Sampler; 8] = [
    Sampler {
        name: "heitz normals",
        modules: &["heitz"],
        sample: "heitz_sample_wm(alpha, wo, u)",
        density: heitz::pdf_wm,
        is_reflection: false,
    },
    Sampler {
        name: "cap normals",
        modules: &["cap"],
        sample: "cap_sample_wm(alpha, wo, u)",
        density: cap::pdf_wm,
        is_reflection: false,
    },
    Sampler {
        name: "beckmann normals",
        modules: &["beckmann_visible"],
        sample: "beckmann_visible_sample_wm(alpha, wo, u)",
        density: beckmann::pdf_wm,
        is_reflection: false,
    },
    Sampler {
        name: "heitz reflections",
        modules: &["reflection", "sampler"],
        sample: "reflection_sample_direction(SAMPLER_HEITZ, alpha, wo, u)",
        density: heitz::reflection_pdf,
        is_reflection: true,
    },
    Sampler {
        name: "cap reflections",
        modules: &["reflection", "sampler"],
        sample: "reflection_sample_direction(SAMPLER_CAP, alpha, wo, u)",
        density: cap::reflection_pdf,
        is_reflection: true,
    },
    Sampler {
        name: "bounded reflections",
        modules: &["reflection", "sampler"],
        sample: "reflection_sample_direction(SAMPLER_BOUNDED, alpha, wo, u)",
        density: bounded::reflection_pdf,
        is_reflection: true,
    },
    Sampler {
        name: "exact reflections",
        modules: &["reflections", "sampler"],
        sample: "reflections_sample_direction(reflections_new(alpha, wo, SAMPLER_EXACT), u)",
        density: exact::reflection_pdf,
        is_reflection: true,
    },
    Sampler {
        name: "beckmann reflections",
        modules: &["reflection", "beckmann_visible"],
        sample: "reflection_mirrored(wo, beckmann_visible_sample_wm(alpha, wo, u))",
        density: beckmann::reflection_pdf,
        is_reflection: true,
    },
];

/// Alphas of the tests.
const ALPHAS: [[f32; 2]; 4] = [[0.05, 0.05], [0.3, 0.3], [0.2, 0.8], [1.2, 3.0]];
/// Views of the tests: above, grazing and below.
const VIEWS: [(f64, f64); 3] = [(0.7, 0.3), (0.05, 2.1), (-0.3, 0.3)];
/// Samples of each test.
const SAMPLES: u32 = 30_000;

/// One pair of alphas and a view.
type AlphasAndView = ([f32; 2], [f32; 3]);

fn places() -> Vec<AlphasAndView> {
    let views = VIEWS.map(|(cosine, azimuth)| direction(cosine, azimuth));
    let at = |alphas| views.map(|wo| (alphas, wo));
    ALPHAS.into_iter().flat_map(at).collect()
}

fn widened([x, y]: [f32; 2], wo: [f32; 3]) -> (Alpha<f64>, Vec3<f64>) {
    let alpha = Alpha {
        x: x.into(),
        y: y.into(),
    };
    let wo: Vec3<f64> = wo.map(f64::from).into();
    (alpha, wo.normalize())
}

/// Where a density of this place is large: half a turn about the normal, and the normal.
fn peaks(alpha: Alpha<f64>, wo: Vec3<f64>) -> Vec<Peak> {
    let width = alpha.x.at_most(alpha.y).at_most(0.3);
    [reflect(wo, Vec3::Z), Vec3::Z]
        .map(|direction| Peak { direction, width })
        .to_vec()
}

/// Directions sampled on the GPU, `SAMPLES` for each place.
fn sampled(device: &specula_gpu::Gpu, sampler: &Sampler, places: &[AlphasAndView]) -> Vec<f32> {
    let mut rng = Rng::from_name(sampler.name);
    let mut inputs = Vec::new();
    for &([ax, ay], [x, y, z]) in places {
        for _ in 0..SAMPLES {
            let u = [rng.uniform_f32(), rng.uniform_f32()].map(round);
            inputs.push([ax, ay, x, y, z, u[0], u[1]]);
        }
    }
    let body = format!(
        "let alpha = vec2f(x[0], x[1]);
         let wo = vec3f(x[2], x[3], x[4]);
         let u = vec2f(x[5], x[6]);
         let w = {};
         y[0] = w.x; y[1] = w.y; y[2] = w.z;",
        sampler.sample
    );
    evaluate(device, sampler.modules, &body, &inputs, 3)
}

/// Holds samples against a density.
fn fit(
    name: &str,
    samples: &[f32],
    is_reflection: bool,
    (alphas, wo): AlphasAndView,
    density: Density,
    tests: usize,
) -> ChiSquare {
    let (alpha, wo) = widened(alphas, wo);
    let mut samples = samples.as_chunks::<3>().0.iter();
    let options = ChiSquareOptions {
        samples: SAMPLES,
        cells: 150,
        cos_theta_edges: vec![wo.z, -wo.z],
        peaks: peaks(alpha, wo),
        significance: sidak(0.01, tests),
    };
    chi_square::test(
        |_| {
            let w: Vec3<f64> = samples.next()?.map(f64::from).into();
            (!is_reflection || w.z > 0.0).then_some(w)
        },
        |w| density(alpha, wo, w),
        &mut Rng::from_name(name),
        &options,
    )
}

fn prove_samples(samplers: &[Sampler]) {
    let places = places();
    let tests = SAMPLERS.len() * places.len();
    let Some(device) = gpu(&format!("chi-square tests of {} samplers", samplers.len())) else {
        return;
    };
    let mut failures = Vec::new();
    for sampler in samplers {
        let is_beckmann = sampler.name.starts_with("beckmann");
        let is_seen = |&([x, y], wo): &AlphasAndView| !is_beckmann || is_visible(x, y, wo);
        let places: Vec<AlphasAndView> = places.iter().copied().filter(is_seen).collect();
        let samples = sampled(device, sampler, &places);
        let mut least = 1.0_f64;
        for (place, samples) in places.iter().zip(samples.chunks(3 * SAMPLES as usize)) {
            let name = format!("{} {place:?}", sampler.name);
            let fit = fit(
                &name,
                samples,
                sampler.is_reflection,
                *place,
                sampler.density,
                tests,
            );
            least = least.min(fit.p_value);
            if !fit.is_pass() {
                failures.push(format!("{name}: {fit}"));
            }
        }
        println!(
            "{}: {} tests, least p {least:.2e}",
            sampler.name,
            places.len()
        );
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn normals_follow_their_density() {
    prove_samples(&SAMPLERS[..3]);
}

#[test]
fn reflections_follow_their_density() {
    prove_samples(&SAMPLERS[3..]);
}

#[test]
fn samples_of_another_sampler_are_noticed() {
    let Some(device) = gpu("the planted fault of the chi-square tests") else {
        return;
    };
    let place = places()[3];
    let sampler = &SAMPLERS[5];
    let samples = sampled(device, sampler, &[place]);
    let density: Density = cap::reflection_pdf;
    let wrong = fit("bounded for cap", &samples, true, place, density, 1);
    assert!(!wrong.is_pass(), "{wrong}");
}

/// Densities of the shaders, in the order of `y`.
const DENSITIES: [Density; 6] = [
    heitz::pdf_wm,
    beckmann::pdf_wm,
    cap::reflection_pdf,
    bounded::reflection_pdf,
    exact::reflection_pdf,
    beckmann::reflection_pdf,
];

#[test]
fn densities_integrate_as_their_twins() {
    /// Directions along a meridian, and round the axis.
    const GRID: u32 = 200;
    let Some(device) = gpu("integrals of densities") else {
        return;
    };
    let body = "let alpha = vec2f(x[0], x[1]);
         let wo = vec3f(x[2], x[3], x[4]);
         let w = vec3f(x[5], x[6], x[7]);
         y[0] = heitz_pdf_wm(alpha, wo, w);
         y[1] = beckmann_visible_pdf_wm(alpha, wo, w);
         y[2] = cap_reflection_pdf(alpha, wo, w);
         y[3] = bounded_reflection_pdf(alpha, wo, w);
         y[4] = exact_reflection_pdf(alpha, wo, w);
         y[5] = beckmann_visible_reflection_pdf(alpha, wo, w);";
    let modules = ["beckmann_visible", "reflection"];
    for alphas in &ALPHAS[1..] {
        for (cosine, azimuth) in [(0.7, 0.3), (0.3, 2.1)] {
            let wo = direction(cosine, azimuth);
            let (mut inputs, mut weights) = (Vec::new(), Vec::new());
            for i in 0..GRID {
                // Substituted so that the horizon, where D may peak, is resolved.
                let s = (f64::from(i) + 0.5) / f64::from(GRID);
                let (z, dz) = (s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s));
                for j in 0..GRID {
                    let w = direction(z, std::f64::consts::TAU * f64::from(j) / f64::from(GRID));
                    let [ax, ay] = *alphas;
                    inputs.push([ax, ay, wo[0], wo[1], wo[2], w[0], w[1], w[2]]);
                    weights.push(dz * std::f64::consts::TAU / f64::from(GRID * GRID));
                }
            }
            let values = evaluate(device, &modules, body, &inputs, DENSITIES.len());
            let (alpha, view) = widened(*alphas, wo);
            for (k, density) in DENSITIES.iter().enumerate() {
                let rows = values.chunks(DENSITIES.len()).zip(&weights);
                let sum: f64 = rows.map(|(row, weight)| f64::from(row[k]) * weight).sum();
                let quadrature = Quadrature {
                    relative_tolerance: 1e-5,
                    peaks: peaks(alpha, view),
                    ..Quadrature::default()
                };
                let expected = quadrature.integrate(Patch::UPPER, |w| [density(alpha, view, w)]);
                let expected = expected.value[0];
                assert!(
                    (sum - expected).abs() < 1e-3 && expected < 1.0 + 1e-4,
                    "density {k}, {alphas:?} {wo:?}: {sum} {expected}"
                );
            }
        }
    }
}
