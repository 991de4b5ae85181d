//! Models of multiple bounces against each other, against reference means, and in the furnace.

mod common;

use common::{alpha, at};
use rayon::prelude::*;
use specula_bsdf::bsdf::MultibounceConductor as Conductor;
use specula_bsdf::bsdf::{MultibounceDielectric as Dielectric, MultibounceDiffuse as Diffuse};
use specula_bsdf::fresnel::{Conductor as Metal, Reflectance};
use specula_bsdf::internal::DepthState;
use specula_bsdf::math::{Real, Stream, rgb, vec3};
use specula_bsdf::multibounce::MultibounceModel as Model;
use specula_bsdf::ndf::{Beckmann, Ggx, Ndf};
use specula_bsdf::vndf::VisibleNormals as Normals;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};
use specula_stat::z_test::Moments;

const STRATIFIED: Model = Model::StratifiedBidirectional;
const ALPHAS: [(f64, f64); 5] = [(0.1, 0.1), (0.3, 0.3), (0.5, 0.5), (1.0, 1.0), (0.2, 0.8)];
/// Largest departure of one comparison, in standard errors.
const SIGMAS: f64 = 4.5;

fn white<T: Real>() -> Reflectance<T> {
    Reflectance::Constant(Rgb::splat(T::ONE))
}

fn gold() -> Reflectance<f64> {
    Reflectance::Conductor(Metal {
        eta: rgb(0.143, 0.375, 1.442),
        k: rgb(3.983, 2.386, 1.603),
    })
}

/// Moments of `n` values, sampled in parallel by streams of fixed seeds.
fn moments(seed: u64, n: u64, sample: impl Fn(&mut Stream) -> f64 + Sync) -> Moments {
    (0..16_u64)
        .into_par_iter()
        .map(|chunk| {
            let mut stream = Stream::new((seed << 8 | chunk).wrapping_mul(0x2545_f491_4f6c_dd1d));
            let mut m = Moments::default();
            for _ in 0..n / 16 {
                m.push(sample(&mut stream));
            }
            m
        })
        .collect::<Vec<_>>()
        .into_iter()
        .fold(Moments::default(), Moments::merge)
}

fn f_cos<B: Bsdf<f64> + Sync>(
    lobe: &B,
    wo: Vec3<f64>,
    wi: Vec3<f64>,
    n: u64,
    seed: u64,
) -> Moments {
    moments(seed, n, |s| {
        lobe.eval_pdf_random(wo, wi, Transport::Importance, s).0.g
    })
}

fn sigmas(a: &Moments, b: &Moments) -> f64 {
    // The floor: lobes too narrow for a second bounce have no variance.
    let rounding = 1e-9 * (a.mean().abs() + b.mean().abs());
    (a.mean() - b.mean()) / (a.variance_of_mean() + b.variance_of_mean() + rounding.powi(2)).sqrt()
}

#[test]
fn reference_means() {
    // Isotropic GGX, F = 1, forward in the plane: (theta_i, theta_o, alpha 0.5, alpha 1), with the
    // errors of those values; from 2e5 to 1e6 evaluations of independent code.
    let table = [
        (0.0, 0.0, (0.428_72, 9e-5), (0.366_38, 2e-4)),
        (0.0, 30.0, (0.310_09, 7e-5), (0.303_06, 1e-4)),
        (0.0, 60.0, (0.137_96, 5e-5), (0.147_79, 4e-5)),
        (30.0, 30.0, (0.459_65, 8e-5), (0.294_71, 1e-4)),
        (30.0, 60.0, (0.278_20, 6e-5), (0.152_11, 4e-5)),
        (60.0, 60.0, (0.563_73, 8e-5), (0.165_43, 4e-5)),
    ];
    for (row, (i, o, half, one)) in (0_u64..).zip(table) {
        for (a, (mean, error)) in [(0.5, half), (1.0, one)] {
            for model in Model::ALL.into_iter().filter(|m| m.is_unbiased()) {
                let lobe = Conductor::new(Ggx::new(alpha((a, a))), white(), model);
                let m = f_cos(&lobe, at(i, 0.0), at(o, 180.0), 60_000, row);
                let z = (m.mean() - mean) / (m.variance_of_mean() + error * error).sqrt();
                assert!(z.abs() < SIGMAS, "{model} {a} {i} {o}: {m:?} {mean} z {z}");
            }
        }
    }
}

#[test]
fn single_precision_has_the_same_means() {
    let pairs = [
        (at(0.0, 0.0), at(30.0, 180.0), 0.303_06, 1e-4),
        (at(30.0, 0.0), at(60.0, 180.0), 0.152_11, 4e-5),
        (at(60.0, 0.0), at(60.0, 180.0), 0.165_43, 4e-5),
    ];
    for (wo, wi, mean, error) in pairs {
        for model in Model::ALL.into_iter().filter(|m| m.is_unbiased()) {
            let ndf = Ggx::new(Alpha::isotropic(1.0_f32));
            let lobe = Conductor::new(ndf, white(), model);
            let m = moments(91, 60_000, |s| {
                f64::from(lobe.estimate(wo.cast(), wi.cast(), s).r)
            });
            let z = (m.mean() - mean) / (m.variance_of_mean() + error * error).sqrt();
            assert!(z.abs() < SIGMAS, "{model} {wo:?}: {m:?} {mean} z {z}");
        }
    }
}

fn models_agree<N: Normals<f64> + Sync>(ndf: impl Fn(Alpha<f64>) -> N, n: u64) {
    let views = [
        (at(20.0, 10.0), at(50.0, 200.0)),
        (at(65.0, 40.0), at(35.0, 100.0)),
    ];
    let mut seed = 100;
    for alphas in ALPHAS {
        for reflectance in [white(), gold()] {
            for (wo, wi) in views {
                let mean_of = |model| {
                    let lobe = Conductor::new(ndf(alpha(alphas)), reflectance, model);
                    f_cos(&lobe, wo, wi, n, seed)
                };
                let truth = mean_of(Model::Heitz2016);
                for model in Model::ALL {
                    if model == Model::Heitz2016 || !model.is_unbiased() {
                        continue;
                    }
                    let m = mean_of(model);
                    let z = sigmas(&m, &truth);
                    assert!(
                        z.abs() < SIGMAS,
                        "{model} {alphas:?} {wo:?}: {m:?} {truth:?}"
                    );
                }
                seed += 1;
            }
        }
    }
}

#[test]
fn models_agree_on_ggx() {
    models_agree(Ggx::new, 30_000);
}

#[test]
fn models_agree_on_beckmann() {
    models_agree(Beckmann::new, 8_000);
}

/// Albedo for F = 1 by uniform directions and by the model's own samples.
fn furnace<N: Normals<f64> + Sync>(ndf: N, model: Model, wo: Vec3<f64>, n: u64) -> [Moments; 2] {
    let lobe = Conductor::new(ndf, white(), model);
    let evaluated = moments(7, n, |s| {
        // Half by the single-scattering lobe's normals, half by cosine: the balance heuristic.
        let u = [s.next(), s.next()];
        let wi = if s.next::<f64>() < 0.5 {
            specula_bsdf::math::warp::cosine_hemisphere(u)
        } else {
            let wm = ndf.sample_wm(wo, u);
            wm * (2.0 * wo.dot(wm)) - wo
        };
        if wi.z <= 0.0 {
            return 0.0;
        }
        let wm = (wo + wi).normalize();
        let first = ndf.d(wm) / (4.0 * ndf.projected_area(wo));
        let density = 0.5 * (first + wi.z / std::f64::consts::PI);
        lobe.eval_pdf_random(wo, wi, Transport::Radiance, s).0.r / density
    });
    let sampled = moments(8, n, |s| {
        let u = [s.next(), s.next(), s.next()];
        lobe.sample_random(wo, u, Transport::Radiance, s)
            .map_or(0.0, |sample| sample.weight.r)
    });
    [evaluated, sampled]
}

#[test]
fn white_furnaces_are_invisible() {
    for alphas in ALPHAS {
        for model in Model::ALL {
            for wo in [at(0.0, 0.0), at(60.0, 30.0), at(85.0, 70.0)] {
                for [evaluated, sampled] in [
                    furnace(Ggx::new(alpha(alphas)), model, wo, 20_000),
                    furnace(Beckmann::new(alpha(alphas)), model, wo, 4_000),
                ] {
                    let z = (evaluated.mean() - 1.0) / evaluated.variance_of_mean().sqrt();
                    assert!(z.abs() < SIGMAS, "{model} {alphas:?} {wo:?} {evaluated:?}");
                    let slack = SIGMAS * sampled.variance_of_mean().sqrt() + 1e-4;
                    assert!(
                        (sampled.mean() - 1.0).abs() < slack,
                        "{model} {alphas:?} {wo:?} {sampled:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn samples_weigh_exactly_the_fresnel_terms() {
    for model in [STRATIFIED, Model::Heitz2016] {
        let lobe = Conductor::new(Ggx::new(alpha((0.7, 0.7))), white(), model);
        let m = moments(3, 16_000, |s| {
            let u = [s.next(), s.next(), s.next()];
            let sample = lobe.sample_random(at(70.0, 0.0), u, Transport::Radiance, s);
            sample.map_or(1.0, |sample| sample.weight.b)
        });
        assert_eq!((m.mean(), m.variance()), (1.0, 0.0), "{model}");
    }
}

/// Samples and evaluations must put the same energy into the same half of the hemisphere.
#[test]
fn samples_follow_what_is_evaluated() {
    let wo = at(50.0, 20.0);
    let wo_part = |wi: Vec3<f64>| (wi.x * 0.3 + wi.y + 0.5 * wi.z).max(0.0);
    for model in Model::ALL {
        for alphas in [(0.5, 0.5), (0.2, 0.8), (1.0, 1.0)] {
            let lobe = Conductor::new(Ggx::new(alpha(alphas)), gold(), model);
            let sampled = moments(21, 60_000, |s| {
                let u = [s.next(), s.next(), s.next()];
                lobe.sample_random(wo, u, Transport::Radiance, s)
                    .map_or(0.0, |x| x.weight.r * wo_part(x.wi))
            });
            let evaluated = moments(22, 60_000, |s| {
                let wi = specula_bsdf::math::warp::cosine_hemisphere([s.next(), s.next()]);
                let f = lobe.eval_pdf_random(wo, wi, Transport::Radiance, s).0.r;
                f * wo_part(wi) * std::f64::consts::PI / wi.z
            });
            let z = sigmas(&sampled, &evaluated);
            assert!(
                z.abs() < SIGMAS,
                "{model} {alphas:?}: {sampled:?} {evaluated:?}"
            );
        }
    }
}

#[test]
fn means_are_reciprocal() {
    let (a, b) = (at(25.0, 15.0), at(70.0, 250.0));
    for model in Model::ALL {
        for alphas in [(0.5, 0.5), (0.2, 0.8), (1.0, 1.0)] {
            let lobe = Conductor::new(Ggx::new(alpha(alphas)), gold(), model);
            let there = moments(31, 40_000, |s| {
                lobe.eval_pdf_random(a, b, Transport::Radiance, s).0.g / b.z
            });
            let back = moments(32, 40_000, |s| {
                lobe.eval_pdf_random(b, a, Transport::Radiance, s).0.g / a.z
            });
            let z = sigmas(&there, &back);
            // Of the published models one is not reciprocal.
            let is_reciprocal = model != Model::Wang2022 { correlated: true };
            assert_eq!(
                z.abs() < SIGMAS,
                is_reciprocal,
                "{model} {alphas:?}: {there:?} {back:?}"
            );
        }
    }
}

#[test]
fn wang_is_biased_as_its_model_says() {
    let bias = |correlated, i, o| {
        let ndf = Ggx::new(alpha((1.0, 1.0)));
        let mean_of = |model, seed| {
            let lobe = Conductor::new(ndf, white(), model);
            f_cos(&lobe, at(i, 0.0), at(o, 180.0), 100_000, seed)
        };
        let truth = mean_of(STRATIFIED, 41);
        let wang = mean_of(Model::Wang2022 { correlated }, 42);
        (wang.mean() / truth.mean() - 1.0, sigmas(&wang, &truth))
    };
    // Measured; the signs are the model's.
    for (correlated, i, o, expected) in [
        (true, 0.0, 0.0, -0.033),
        (true, 30.0, 60.0, 0.083),
        (false, 0.0, 0.0, -0.132),
        (false, 60.0, 60.0, -0.036),
    ] {
        let (relative, z) = bias(correlated, i, o);
        let what = format!("correlated {correlated}, {i} to {o}: {relative:+.4}, z {z:.1}");
        assert!(z * expected > 0.0 && z.abs() > 2.0 * SIGMAS, "{what}");
        assert!((relative - expected).abs() < 0.01, "{what}");
    }
}

/// That of stratified bidirectional walks is bounded for `wi` along the normal, where those that leave first and
/// connect then have rare, huge values.
#[test]
fn values_along_the_normal_are_bounded() {
    let largest = |model| {
        let lobe = Conductor::new(Ggx::new(alpha((0.5, 0.5))), white(), model);
        let mut stream = Stream::new(81);
        let samples = (0..200_000).map(|_| {
            let f = lobe.eval_pdf_random(at(60.0, 0.0), Vec3::Z, Transport::Radiance, &mut stream);
            f.0.r
        });
        samples.fold(0.0, f64::max)
    };
    let (specula, heitz) = (largest(STRATIFIED), largest(Model::Heitz2016));
    assert!(specula < 2.0 && heitz > 8.0, "{specula} {heitz}");
}

#[test]
fn dielectrics_agree_from_both_sides() {
    let pairs = [
        (at(40.0, 10.0), at(30.0, 150.0)),
        (at(40.0, 10.0), at(160.0, 150.0)),
        (at(75.0, 10.0), at(125.0, 200.0)),
        (at(130.0, 10.0), at(140.0, 80.0)),
        (at(150.0, 10.0), at(55.0, 170.0)),
    ];
    let mut seed = 300;
    for alphas in ALPHAS {
        for (wo, wi) in pairs {
            let ggx = |model| Dielectric::new(Ggx::new(alpha(alphas)), 1.5, model);
            let beckmann = |model| Dielectric::new(Beckmann::new(alpha(alphas)), 1.5, model);
            let specula = f_cos(&ggx(STRATIFIED), wo, wi, 40_000, seed);
            let truth = f_cos(&ggx(Model::Heitz2016), wo, wi, 40_000, seed + 1);
            let z = sigmas(&specula, &truth);
            assert!(
                z.abs() < SIGMAS,
                "{alphas:?} {wo:?} {wi:?}: {specula:?} {truth:?}"
            );
            let specula = f_cos(&beckmann(STRATIFIED), wo, wi, 8_000, seed);
            let truth = f_cos(&beckmann(Model::Heitz2016), wo, wi, 8_000, seed + 1);
            let z = sigmas(&specula, &truth);
            assert!(
                z.abs() < SIGMAS,
                "{alphas:?} {wo:?} {wi:?}: {specula:?} {truth:?}"
            );
            seed += 2;
        }
    }
}

/// Walks start at the better end, whichever is asked for: single estimates are reciprocal.
#[test]
fn glass_is_estimated_from_one_end() {
    let pairs = [
        (at(20.0, 10.0), at(70.0, 150.0)),
        (at(30.0, 10.0), at(130.0, 150.0)),
        (at(75.0, 10.0), at(150.0, 200.0)),
        (at(110.0, 10.0), at(140.0, 80.0)),
    ];
    for alphas in ALPHAS {
        let lobe = Dielectric::new(Ggx::new(alpha(alphas)), 1.5, STRATIFIED);
        for (a, b) in pairs {
            for seed in 0..50 {
                // f / eta^2 of the side that is reached.
                let f = |a: Vec3<f64>, b: Vec3<f64>| {
                    let mut s = Stream::new(seed);
                    let f = lobe.eval_pdf_random(a, b, Transport::Importance, &mut s);
                    let reached = if b.z > 0.0 { 1.0 } else { 1.5 };
                    f.0.g / b.z.abs() / (reached * reached)
                };
                let (there, back) = (f(a, b), f(b, a));
                let alike = (there - back).abs() <= 1e-9 * there;
                assert!(alike, "{alphas:?} {a:?} {b:?}: {there} {back}");
            }
        }
    }
    // And it is the better one.
    let variance = |model| {
        let lobe = Dielectric::new(Ggx::new(alpha((1.0, 1.0))), 1.5, model);
        f_cos(&lobe, at(10.0, 0.0), at(80.0, 180.0), 20_000, 7).variance()
    };
    let (specula, heitz) = (variance(STRATIFIED), variance(Model::Heitz2016));
    assert!(specula < 0.03 * heitz, "{specula} {heitz}");
}

#[test]
fn dielectrics_are_reciprocal_and_lose_nothing() {
    let mut stream = Stream::new(77);
    for model in [STRATIFIED, Model::Heitz2016] {
        for alphas in ALPHAS {
            let lobe = Dielectric::new(Ggx::new(alpha(alphas)), 1.5, model);
            for wo in [
                at(30.0, 20.0),
                at(80.0, 20.0),
                at(120.0, 20.0),
                at(170.0, 20.0),
            ] {
                for _ in 0..200 {
                    let u = [stream.next(), stream.next(), stream.next()];
                    let sample = lobe.sample_random(wo, u, Transport::Importance, &mut stream);
                    assert_eq!(sample.map(|s| s.weight.g), Some(1.0), "{model} {alphas:?}");
                }
                let all = moments(51, 20_000, |s| sphere_integral(&lobe, alphas, wo, s));
                let z = (all.mean() - 1.0) / all.variance_of_mean().sqrt();
                assert!(z.abs() < SIGMAS, "{model} {alphas:?} {wo:?}: {all:?}");
            }
            // f(a, b) / eta_b^2 is symmetric: light from the denser side is spread.
            let (a, b) = (at(35.0, 10.0), at(130.0, 150.0));
            let there = f_cos(&lobe, a, b, 40_000, 52);
            let back = moments(53, 40_000, |s| {
                let f = lobe.eval_pdf_random(b, a, Transport::Importance, s).0.g;
                f / a.z * b.z.abs() * 1.5 * 1.5
            });
            let z = sigmas(&there, &back);
            assert!(z.abs() < SIGMAS, "{model} {alphas:?}: {there:?} {back:?}");
        }
    }
}

/// One-sample estimate of the integral of `f |cos|` over the sphere, for light, half the
/// directions sampled as of one bounce.
fn sphere_integral(
    lobe: &Dielectric<f64>,
    alphas: (f64, f64),
    wo: Vec3<f64>,
    s: &mut Stream,
) -> f64 {
    let single = specula_bsdf::bsdf::RoughDielectric::new(Ggx::new(alpha(alphas)), 1.5);
    let u = [s.next(), s.next(), s.next()];
    let uniform = 0.5 / (4.0 * std::f64::consts::PI);
    let wi = if s.next::<f64>() < 0.5 {
        specula_bsdf::math::warp::uniform_sphere([u[0], u[1]])
    } else {
        match single.sample(wo, u, Transport::Importance) {
            Some(sample) => sample.wi,
            None => return 0.0,
        }
    };
    let density = uniform + 0.5 * single.pdf(wo, wi);
    lobe.eval_pdf_random(wo, wi, Transport::Importance, s).0.g / density
}

#[test]
fn diffuse_facets_keep_energy_and_are_reciprocal() {
    let (a, b) = (at(25.0, 15.0), at(70.0, 250.0));
    for alphas in ALPHAS {
        let lobe = Diffuse::new(Ggx::new(alpha(alphas)), Rgb::splat(1.0));
        for wo in [at(0.0, 0.0), at(60.0, 40.0), at(85.0, 40.0)] {
            let evaluated = moments(61, 40_000, |s| {
                let wi = specula_bsdf::math::warp::cosine_hemisphere([s.next(), s.next()]);
                let f = lobe.eval_pdf_random(wo, wi, Transport::Radiance, s).0.r;
                f * std::f64::consts::PI / wi.z
            });
            let z = (evaluated.mean() - 1.0) / evaluated.variance_of_mean().sqrt();
            assert!(z.abs() < SIGMAS, "{alphas:?} {wo:?}: {evaluated:?}");
        }
        let grey = Diffuse::new(Ggx::new(alpha(alphas)), Rgb::splat(0.6));
        let there = moments(62, 40_000, |s| {
            grey.eval_pdf_random(a, b, Transport::Radiance, s).0.g / b.z
        });
        let back = moments(63, 40_000, |s| {
            grey.eval_pdf_random(b, a, Transport::Radiance, s).0.g / a.z
        });
        let z = sigmas(&there, &back);
        assert!(z.abs() < SIGMAS, "{alphas:?}: {there:?} {back:?}");
    }
    // Flat facets are a Lambertian surface.
    let flat = Diffuse::new(Ggx::new(alpha((1e-3, 1e-3))), Rgb::splat(0.6));
    let m = f_cos(&flat, a, b, 16_000, 64);
    let lambert = 0.6 / std::f64::consts::PI * b.z;
    assert!((m.mean() / lambert - 1.0).abs() < 0.01, "{m:?} {lambert}");
}

/// Faults that are planted in a walk by depth state; the sound walk must pass the same test.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    /// Flights upward leave the state as it is.
    UpwardForgotten,
    /// Flights downward are taken for upward ones.
    WrongSign,
    /// What climbs past a layer is dropped: only the first layer's mass leaves.
    LastLayerOnly,
    /// Facets are sampled among all, not the visible ones: `sigma(d)` for `sigma(-d)`.
    WrongSide,
}

fn by_state(fault: Fault, wo: Vec3<f64>, wi: Vec3<f64>, s: &mut Stream) -> f64 {
    let ndf = Ggx::new(alpha((1.0, 1.0)));
    let rate = |d: Vec3<f64>| ndf.projected_area(-d) / d.z.abs();
    let mut d = -wo;
    let mut state = DepthState::new(rate(d));
    let (mut sum, mut newest) = (0.0, rate(d));
    for _ in 0..30 {
        let sigma = if fault == Fault::WrongSide {
            ndf.projected_area(d)
        } else {
            ndf.projected_area(-d)
        };
        let exit = if fault == Fault::LastLayerOnly {
            state.mass() * newest / (newest + ndf.lambda(wi))
        } else {
            state.exit(ndf.lambda(wi))
        };
        sum += ndf.d((wi - d).normalize()) / (4.0 * sigma) * exit;
        let wm = ndf.sample_wm(-d, [s.next(), s.next()]);
        d = d - wm * (2.0 * d.dot(wm));
        if d.z < 0.0 && fault != Fault::WrongSign {
            newest = rate(d);
            if !state.down(newest) {
                break;
            }
        } else if fault != Fault::UpwardForgotten {
            state.up(rate(d));
        }
    }
    sum
}

#[test]
fn planted_faults_are_caught() {
    let (wo, wi) = (at(30.0, 0.0), at(60.0, 180.0));
    let lobe = Conductor::new(Ggx::new(alpha((1.0, 1.0))), white(), Model::Heitz2016);
    let truth = f_cos(&lobe, wo, wi, 100_000, 71);
    for fault in [
        Fault::None,
        Fault::UpwardForgotten,
        Fault::WrongSign,
        Fault::LastLayerOnly,
        Fault::WrongSide,
    ] {
        let m = moments(72, 40_000, |s| by_state(fault, wo, wi, s));
        let z = sigmas(&m, &truth);
        let is_sound = fault == Fault::None;
        assert_eq!(
            z.abs() < SIGMAS,
            is_sound,
            "{fault:?}: z {z}, {m:?} {truth:?}"
        );
    }
}

#[test]
fn single_precision_stays_finite_everywhere() {
    let mut stream = Stream::new(5);
    let alphas = [1e-4_f32, 1e-3, 0.03, 0.5, 1.0, 10.0];
    let cosines = [
        1.0_f32, 0.9, 0.3, 1e-2, 1e-4, 1e-7, 0.0, -1e-7, -1e-3, -0.4, -1.0,
    ];
    let direction = |s: &mut Stream, z: f32| {
        let (sin, cos) = s.next::<f32>().sin_cos_turns();
        let r = (1.0 - z * z).max(0.0).sqrt();
        vec3(r * cos, r * sin, z)
    };
    for model in Model::ALL {
        for ax in alphas {
            for ay in alphas {
                let alpha = Alpha::clamped(ax, ay);
                let ggx = Conductor::new(Ggx::new(alpha), white(), model);
                let beckmann = Conductor::new(Beckmann::new(alpha), white(), model);
                let glass = Dielectric::new(Ggx::new(alpha), 1.5, model);
                let facing = Dielectric::facing(Beckmann::new(alpha), 0.7, model);
                let diffuse = Diffuse::new(Ggx::new(alpha), Rgb::splat(0.8));
                for zo in cosines {
                    for zi in cosines {
                        let (wo, wi) = (direction(&mut stream, zo), direction(&mut stream, zi));
                        finite(&ggx, wo, wi, &mut stream);
                        finite(&beckmann, wo, wi, &mut stream);
                        finite(&glass, wo, wi, &mut stream);
                        finite(&facing, wo, wi, &mut stream);
                        finite(&diffuse, wo, wi, &mut stream);
                    }
                }
            }
        }
    }
}

fn finite<B: Bsdf<f32> + std::fmt::Debug>(lobe: &B, wo: Vec3<f32>, wi: Vec3<f32>, s: &mut Stream) {
    let (f, pdf) = lobe.eval_pdf_random(wo, wi, Transport::Radiance, s);
    let good = |c: Rgb<f32>| c.is_finite() && c.r >= 0.0 && c.g >= 0.0 && c.b >= 0.0;
    assert!(
        good(f) && pdf.is_finite() && pdf >= 0.0,
        "{lobe:?} {wo:?} {wi:?}: {f:?} {pdf}"
    );
    let u = [s.next(), s.next(), s.next()];
    if let Some(sample) = lobe.sample_random(wo, u, Transport::Radiance, s) {
        assert!(good(sample.weight), "{lobe:?} {wo:?}: {sample:?}");
        assert!(
            sample.pdf.is_finite() && sample.pdf > 0.0,
            "{lobe:?} {wo:?}: {sample:?}"
        );
        let length = sample.wi.length();
        assert!((length - 1.0).abs() < 1e-3, "{lobe:?} {wo:?}: {sample:?}");
    }
}
