//! Walks between a coat and its base: samples against values, closed forms, furnaces, reciprocity, the
//! density of multiple importance sampling.

mod common;

use common::{alpha, at, in_cells, moments, sampled, sigmas};
use specula_bsdf::bsdf::{Base, CoatedDiffuse, Layered, Medium, RoughConductor, SmoothConductor};
use specula_bsdf::fresnel::{Conductor as Metal, Reflectance, dielectric};
use specula_bsdf::math::{Real, rgb, vec3, warp};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};
use specula_stat::normalisation::integrate_bands;
use specula_stat::quadrature::{Peak, Quadrature};
use specula_stat::z_test::{Moments, sidak, two_sided_p};

/// Largest departure of one comparison, in standard errors.
const SIGMAS: f64 = 4.5;
const RADIANCE: Transport = Transport::Radiance;

type Alphas = Option<(f64, f64)>;

fn ggx<T: Real>(alphas: Alphas) -> Option<Ggx<T>> {
    alphas.map(|(x, y)| Ggx::new(Alpha::clamped(T::of(x), T::of(y))))
}

fn gold<T: Real>() -> Reflectance<T> {
    let colour = |r, g, b| rgb(T::of(r), T::of(g), T::of(b));
    Reflectance::Conductor(Metal {
        eta: colour(0.143, 0.375, 1.442),
        k: colour(3.983, 2.386, 1.603),
    })
}

fn white() -> Reflectance<f64> {
    Reflectance::Constant(Rgb::splat(1.0))
}

fn medium<T: Real>(thickness: f64, albedo: f64, g: f64) -> Medium<T> {
    Medium {
        thickness: T::of(thickness),
        albedo: rgb(T::of(albedo), T::of(0.5 * albedo), T::of(0.2 * albedo)),
        g: T::of(g),
    }
}

fn albedo(lobe: &Layered<f64>, wo: Vec3<f64>, n: u64) -> [Moments; 3] {
    moments(5, n, |s| {
        sampled(lobe, wo, s).map_or([0.0; 3], |x| x.weight.to_array())
    })
}

fn value(lobe: &Layered<f64>, wo: Vec3<f64>, wi: Vec3<f64>, n: u64, seed: u64) -> [Moments; 3] {
    moments(seed, n, |s| {
        lobe.eval_pdf_random(wo, wi, RADIANCE, s).0.to_array()
    })
}

fn against(m: &Moments, truth: f64) -> f64 {
    (m.mean() - truth) / (m.variance_of_mean() + (1e-9 * truth.abs() + 1e-12).powi(2)).sqrt()
}

/// Materials of every kind: coat, index, base, medium, events.
fn materials() -> Vec<(String, Layered<f64>)> {
    let metal = |w: Alphas| Base::metal(ggx(w), gold());
    let isotropic = |a: f64| Some((a, a));
    let diffuse = Base::diffuse(rgb(0.8, 0.4, 0.1));
    let none = Medium::NONE;
    let clear = medium(0.05, 0.0, 0.0);
    let cloudy = medium(0.4, 0.9, 0.5);
    #[rustfmt::skip]
    let materials = [
        ("smooth on rough", None, 1.5, metal(isotropic(0.3)), clear, 10),
        ("smooth on grained", None, 1.3, metal(Some((0.1, 0.6))), none, 1000),
        ("rough on smooth", isotropic(0.15), 1.5, metal(None), clear, 10),
        ("rough on narrow", isotropic(0.5), 2.0, metal(isotropic(0.1)), clear, 7),
        ("grained on rough", Some((0.1, 0.4)), 1.5, metal(isotropic(0.4)), none, 1000),
        ("rough on diffuse", isotropic(0.4), 1.5, diffuse, clear, 12),
        ("cloudy mirror", None, 1.5, metal(None), cloudy, 40),
        ("cloudy, smooth on rough", None, 1.5, metal(isotropic(0.3)), cloudy, 1000),
        ("cloudy, rough on rough", isotropic(0.3), 1.7, metal(isotropic(0.2)), cloudy, 30),
        ("cloudy, rough on diffuse", isotropic(0.2), 1.5, diffuse, medium(1.0, 0.95, -0.4), 50),
    ];
    let each = materials
        .into_iter()
        .map(|(name, coat, eta, base, medium, depth)| {
            let lobe = Layered::new(ggx(coat), eta, base);
            let lobe = lobe.with_medium(medium).with_max_depth(depth);
            (name.to_owned(), lobe)
        });
    each.collect()
}

const RINGS: usize = 4;
const SECTORS: usize = 6;
const CELLS: usize = RINGS * SECTORS;

/// The walk's samples, weighed, and its values put the same light into every cell of the hemisphere;
/// values are asked at samples of the walk and at cosines, weighed by the density.
#[test]
fn samples_follow_values() {
    let views = [at(15.0, 20.0), at(62.0, 200.0), at(84.0, 70.0)];
    let materials = materials();
    let significance = sidak(0.01, materials.len() * views.len() * CELLS);
    for (name, lobe) in &materials {
        for wo in views {
            let density = |wi: Vec3<f64>| wi.z / core::f64::consts::PI;
            let samples = moments(31, 60_000, |s| {
                let x = sampled(lobe, wo, s).filter(|x| !x.specular);
                in_cells::<CELLS>(x.map(|x| (x.wi, x.weight.r)), [RINGS, SECTORS])
            });
            let values = moments(32, 60_000, |s| {
                // samples of the walk are common where the density is high: both together are seen
                // by the balance heuristic, with the density for the samples.
                let placed = if s.next::<f64>() < 0.5 {
                    let wi = warp::cosine_hemisphere([s.next(), s.next()]);
                    let (f, pdf) = lobe.eval_pdf_random(wo, wi, RADIANCE, s);
                    Some((wi, 2.0 * f.r / (pdf + density(wi))))
                } else {
                    let x = sampled(lobe, wo, s).filter(|x| !x.specular);
                    x.map(|x| (x.wi, 2.0 * x.weight.r * x.pdf / (x.pdf + density(x.wi))))
                };
                in_cells::<CELLS>(placed, [RINGS, SECTORS])
            });
            for (i, (a, b)) in samples.iter().zip(&values).enumerate() {
                let p = two_sided_p(sigmas(a, b));
                assert!(p > significance, "{name} {wo:?} cell {i}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn values_are_reciprocal() {
    let (a, b) = (at(20.0, 15.0), at(66.0, 215.0));
    for (name, lobe) in &materials() {
        let there = value(lobe, a, b, 60_000, 41).map(|m| (m, b.z));
        let back = value(lobe, b, a, 60_000, 42).map(|m| (m, a.z));
        for ((x, cos), (y, other)) in there.into_iter().zip(back) {
            let apart = x.mean() / cos - y.mean() / other;
            let variance =
                x.variance_of_mean() / (cos * cos) + y.variance_of_mean() / (other * other);
            assert!(
                apart.abs() < SIGMAS * variance.sqrt() + 1e-9,
                "{name}: {x:?} {y:?}"
            );
        }
    }
}

/// A series of bounces between two smooth surfaces, term by term.
#[test]
fn smooth_on_smooth_is_its_series() {
    for (eta, thickness, depth) in [(1.5, 0.01, 10), (1.2, 0.5, 3), (2.0, 0.0, 2), (1.5, 0.2, 1)] {
        let lobe = Layered::new(None, eta, Base::metal(None, gold()))
            .with_medium(medium(thickness, 0.0, 0.0))
            .with_max_depth(depth);
        assert!(lobe.is_specular());
        for degrees in [0.0, 40.0, 80.0, 89.9] {
            let wo = at(degrees, 30.0);
            let coat = dielectric(wo.z, eta);
            let metal = match gold::<f64>() {
                Reflectance::Conductor(m) => m.under(eta).eval(coat.cos_t).r,
                _ => unreachable!("gold has an index"),
            };
            let passing = (-thickness / coat.cos_t).exp();
            let mut expected = coat.reflectance;
            let mut carried = coat.transmittance;
            for _ in 0..depth / 2 {
                carried *= passing * metal * passing;
                expected += carried * coat.transmittance;
                carried *= coat.reflectance;
            }
            let sample = lobe.sample(wo, [0.3, 0.1, 0.9], RADIANCE).unwrap();
            assert!(sample.specular);
            let found = sample.weight.r;
            assert!(
                (found - expected).abs() < 1e-9,
                "{eta} {degrees}: {found} {expected}"
            );
        }
    }
}

/// Without an index the coat is not there; an event for the base and one to leave are all there is.
#[test]
fn a_coat_of_no_index_leaves_the_metal() {
    let (wo, wi) = (at(50.0, 10.0), at(35.0, 160.0));
    for alphas in [(0.3, 0.3), (0.1, 0.6)] {
        let plain = RoughConductor::new(Ggx::new(alpha(alphas)), gold());
        let base = Base::metal(ggx(Some(alphas)), gold());
        for coat in [None, Some((0.4, 0.4))] {
            let lobe = Layered::new(ggx(coat), 1.0, base).with_max_depth(2);
            let (found, truth) = (lobe.eval(wo, wi, RADIANCE), plain.eval(wo, wi, RADIANCE));
            assert!(
                (found.r / truth.r - 1.0).abs() < 1e-12,
                "{found:?} {truth:?}"
            );
            let none = lobe.with_max_depth(1).eval(wo, wi, RADIANCE);
            assert_eq!(none, Rgb::BLACK);
        }
    }
    let mirror = SmoothConductor::new(gold())
        .sample(wo, [0.0; 3], RADIANCE)
        .unwrap();
    let lobe = Layered::new(None, 1.0, Base::metal(None, gold()));
    let found = lobe.sample(wo, [0.0; 3], RADIANCE).unwrap();
    assert!((found.weight.g / mirror.weight.g - 1.0).abs() < 1e-12);
}

/// The first bounce under a smooth coat: `T(wo) T(wi) f_metal exp(..) |wi.z| / (eta^2 |wi'.z|)`.
#[test]
fn a_first_bounce_under_a_smooth_coat_is_no_estimate() {
    let (wo, wi) = (at(50.0, 10.0), at(35.0, 160.0));
    let (eta, thickness) = (1.5, 0.3);
    let reflectance = match gold::<f64>() {
        Reflectance::Conductor(m) => Reflectance::Conductor(m.under(eta)),
        other => other,
    };
    let metal = RoughConductor::new(Ggx::new(alpha((0.2, 0.4))), reflectance);
    let lobe = Layered::new(None, eta, Base::metal(ggx(Some((0.2, 0.4))), gold()))
        .with_medium(medium(thickness, 0.0, 0.0))
        .with_max_depth(2);
    let below = |w: Vec3<f64>| {
        let (x, y) = (w.x / eta, w.y / eta);
        vec3(x, y, (1.0 - x * x - y * y).sqrt())
    };
    let (bo, bi) = (below(wo), below(wi));
    let passed = dielectric(wo.z, eta).transmittance * dielectric(wi.z, eta).transmittance;
    let passing = (-thickness / bo.z - thickness / bi.z).exp();
    let truth = metal.eval(bo, bi, RADIANCE).r * passed * passing * wi.z / (eta * eta * bi.z);
    let found = lobe.eval(wo, wi, RADIANCE).r;
    assert!((found / truth - 1.0).abs() < 1e-12, "{found} {truth}");
}

#[test]
fn a_clear_smooth_coat_over_lambert_is_the_closed_form() {
    let colour = rgb(0.8, 0.4, 0.1);
    for eta in [1.2, 1.5, 2.0] {
        let closed = CoatedDiffuse::new(None, eta, colour);
        let lobe = Layered::new(None, eta, Base::diffuse(colour));
        for (wo, wi) in [
            (at(30.0, 0.0), at(70.0, 90.0)),
            (at(80.0, 0.0), at(10.0, 50.0)),
        ] {
            let truth = closed.eval(wo, wi, RADIANCE).to_array();
            for (m, truth) in value(&lobe, wo, wi, 40_000, 51).iter().zip(truth) {
                assert!(
                    against(m, truth).abs() < SIGMAS,
                    "{eta} {wo:?}: {m:?} {truth}"
                );
            }
        }
    }
}

/// Smooth surfaces lose nothing, nor does a medium that absorbs nothing; rough ones lose what they
/// scatter twice, and no walk makes light.
#[test]
fn white_furnaces() {
    let cloud = |thickness, g| Medium {
        thickness,
        albedo: Rgb::WHITE,
        g,
    };
    let mirror = Base::metal(None, white());
    let diffuse = Base::diffuse(Rgb::WHITE);
    let lossless = [
        Layered::new(None, 1.5, mirror).with_medium(cloud(0.5, 0.6)),
        Layered::new(None, 1.3, diffuse).with_medium(cloud(1.5, -0.5)),
        Layered::new(None, 2.0, diffuse),
    ];
    for (i, lobe) in lossless.iter().enumerate() {
        for wo in [at(10.0, 0.0), at(75.0, 40.0)] {
            let m = albedo(lobe, wo, 16_000)[0];
            assert!(against(&m, 1.0).abs() < SIGMAS, "{i} {wo:?}: {m:?}");
        }
    }
    for (coat, base) in [
        (None, 0.3),
        (Some((0.3, 0.3)), 0.1),
        (Some((0.1, 0.6)), 0.6),
    ] {
        let lobe = Layered::new(
            ggx(coat),
            1.5,
            Base::metal(ggx(Some((base, base))), white()),
        );
        for wo in [at(10.0, 0.0), at(60.0, 0.0), at(86.0, 40.0)] {
            let m = albedo(&lobe, wo, 16_000)[0];
            let sigma = m.variance_of_mean().sqrt();
            assert!(
                m.mean() < 1.0 + SIGMAS * sigma,
                "{coat:?} {base} {wo:?}: {m:?}"
            );
            assert!(m.mean() > 0.3, "{coat:?} {base} {wo:?}: {m:?}");
        }
    }
}

/// What pbrt-v4 (5f7a6068) makes of a plane in a furnace of radiance 1, by a million of its walks each:
/// coat and base, and views at 10, 60 and 80 degrees.
#[test]
fn furnaces_of_pbrt() {
    let metal = |w: f64| {
        let index = Metal {
            eta: Rgb::splat(1.2),
            k: Rgb::splat(7.0),
        };
        let alphas = (w > 0.0).then_some((w, w));
        Base::metal(ggx(alphas), Reflectance::Conductor(index))
    };
    let cloud = |thickness, albedo, g| Medium {
        thickness,
        albedo: Rgb::splat(albedo),
        g,
    };
    let (clear, cloudy) = (cloud(0.01, 0.0, 0.0), cloud(0.4, 0.9, 0.5));
    let white = Base::diffuse(Rgb::splat(0.8));
    let same = |a: f64| Some((a, a));
    #[rustfmt::skip]
    let table = [
        (None, 1.5, metal(0.2), clear, 10, [0.71605, 0.61607, 0.70845]),
        (None, 1.5, metal(0.5), clear, 10, [0.40741, 0.41412, 0.60065]),
        (same(0.15), 1.5, metal(0.0), clear, 10, [0.82098, 0.62700, 0.48103]),
        (same(0.5), 2.0, metal(0.1), clear, 10, [0.37687, 0.29231, 0.28459]),
        (same(0.3), 1.5, metal(0.3), clear, 10, [0.50809, 0.42257, 0.40247]),
        (Some((0.1, 0.4)), 1.5, metal(0.4), clear, 5, [0.40754, 0.37359, 0.44262]),
        (None, 1.5, metal(0.0), cloudy, 40, [0.65992, 0.62609, 0.70962]),
        (same(0.3), 1.5, metal(0.2), cloudy, 40, [0.48199, 0.40938, 0.40204]),
        (same(0.2), 1.5, white, cloud(1.0, 0.95, -0.4), 50, [0.46740, 0.47162, 0.50053]),
    ];
    for (coat, eta, base, medium, depth, expected) in table {
        let lobe = Layered::new(ggx(coat), eta, base)
            .with_medium(medium)
            .with_max_depth(depth);
        for (degrees, theirs) in [10.0, 60.0, 80.0].into_iter().zip(expected) {
            let m = albedo(&lobe, at(degrees, 0.0), 200_000)[0];
            // Their standard error, and that of their white.
            let slack = SIGMAS * (m.variance_of_mean() + 5e-4_f64.powi(2)).sqrt() + 5e-4;
            let apart = m.mean() - theirs;
            assert!(
                apart.abs() < slack,
                "{coat:?} {base:?} {degrees}: {m:?} {theirs}"
            );
        }
    }
}

/// 1 in all, less the share of a smooth coat's mirrored light, and of light that a cloud over a mirror
/// leaves alone.
#[test]
fn the_density_is_normalised() {
    for (name, lobe) in &materials() {
        for wo in [at(20.0, 20.0), at(70.0, 200.0)] {
            let is_smooth = name.contains("smooth on") || name.contains("mirror");
            let passing = if is_smooth {
                dielectric(wo.z, 1.5).transmittance
            } else {
                1.0
            };
            let expected = match name.as_str() {
                "cloudy mirror" => passing * (1.0 - f64::exp(-0.8)),
                "smooth on grained" => dielectric(wo.z, 1.3).transmittance,
                _ => passing,
            };
            let quadrature = Quadrature {
                relative_tolerance: 1e-5,
                peaks: vec![Peak {
                    direction: vec3(-wo.x, -wo.y, wo.z),
                    width: 0.05,
                }],
                ..Quadrature::default()
            };
            let found = integrate_bands(&[], &quadrature, |wi| [lobe.pdf(wo, wi)]).value[0];
            assert!(
                (found - expected).abs() < 1e-4,
                "{name} {wo:?}: {found} {expected}"
            );
        }
    }
}

#[test]
fn single_precision_has_the_same_means() {
    let (wo, wi) = (at(55.0, 10.0), at(30.0, 170.0));
    for (coat, base, cloud) in [
        (None, Some((0.2, 0.4)), medium(0.1, 0.0, 0.0)),
        (Some((0.2, 0.2)), None, medium(0.1, 0.0, 0.0)),
        (Some((0.3, 0.1)), Some((0.05, 0.05)), medium(0.3, 0.8, 0.3)),
    ] {
        let double = Layered::new(ggx(coat), 1.5, Base::metal(ggx(base), gold()))
            .with_medium(cloud)
            .with_max_depth(10);
        let cloud = Medium {
            thickness: f32::of(cloud.thickness),
            albedo: cloud.albedo.cast(),
            g: f32::of(cloud.g),
        };
        let single = Layered::<f32>::new(ggx(coat), 1.5, Base::metal(ggx(base), gold()))
            .with_medium(cloud)
            .with_max_depth(10);
        let truth = value(&double, wo, wi, 60_000, 61);
        let found = moments(62, 60_000, |s| {
            let f = single.eval_pdf_random(wo.cast(), wi.cast(), RADIANCE, s).0;
            f.cast::<f64>().to_array()
        });
        for (a, b) in found.iter().zip(&truth) {
            assert!(
                sigmas(a, b).abs() < SIGMAS,
                "{coat:?} {base:?}: {a:?} {b:?}"
            );
        }
        let (p, q) = (single.pdf(wo.cast(), wi.cast()), double.pdf(wo, wi));
        assert!((f64::from(p) / q - 1.0).abs() < 1e-3, "{p} {q}");
        let samples = moments(63, 60_000, |s| {
            let u = [s.next(), s.next(), s.next()];
            let x = single.sample_random(wo.cast(), u, RADIANCE, s);
            x.map_or([0.0; 3], |x| x.weight.cast::<f64>().to_array())
        });
        for (a, b) in samples.iter().zip(&albedo(&double, wo, 60_000)) {
            assert!(
                sigmas(a, b).abs() < SIGMAS,
                "{coat:?} {base:?}: {a:?} {b:?}"
            );
        }
    }
}
