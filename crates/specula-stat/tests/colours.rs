//! Lobes against textbooks and walks by heights: colour and index, channel by channel.
//!
//! White furnaces see no colour, and two forms of one formula share its faults. `tests/textbook` has neither.

mod common;
mod textbook;

use std::f64::consts::PI;

use common::{at, prove_all};
use specula_bsdf::bsdf::{
    Base, Compensated, CompensatedDielectric, Gltf, GltfParameters, Layered, MultibounceConductor,
    MultibounceDielectric, Plastic, Principled, PrincipledParameters, RoughConductor,
    RoughDielectric, Tints,
};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, Reflectance, Schlick};
use specula_bsdf::math::{Stream, rgb, warp};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};
use specula_stat::Report;
use textbook::fresnel::{GOLD, dielectric, of_metal, schlick};
use textbook::{
    EXACT, Facets, INTERFACE_TABLES, Shape, TABLES, compare, energy, glass, half, metal, walks,
};

const ALPHAS: [(f64, f64); 4] = [(0.1, 0.1), (0.5, 0.5), (1.0, 1.0), (0.2, 0.8)];
const RADIANCE: Transport = Transport::Radiance;

fn gold() -> Reflectance<f64> {
    let [r, g, b] = GOLD;
    Reflectance::Conductor(Conductor {
        eta: rgb(r[0], g[0], b[0]),
        k: rgb(r[1], g[1], b[1]),
    })
}

fn colour() -> Rgb<f64> {
    rgb(0.8, 0.4, 0.1)
}

fn views() -> Vec<Vec3<f64>> {
    vec![
        at(5.0, 20.0),
        at(40.0, 200.0),
        at(70.0, 70.0),
        at(85.0, 130.0),
    ]
}

fn both_sides() -> Vec<Vec3<f64>> {
    let below = views().into_iter().map(|w| Vec3 { z: -w.z, ..w });
    views().into_iter().chain(below).collect()
}

fn alpha((x, y): (f64, f64)) -> Alpha<f64> {
    Alpha::clamped(x, y)
}

/// The values of a lobe.
fn value<B: Bsdf<f64>>(
    lobe: &B,
    transport: Transport,
) -> impl Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64> + '_ {
    move |wo, wi| lobe.eval(wo, wi, transport)
}

/// Every distribution with every pair of alphas.
fn facets() -> Vec<Facets> {
    let shapes = [Shape::Ggx, Shape::Beckmann].into_iter();
    shapes
        .flat_map(|shape| ALPHAS.map(|alpha| Facets::new(shape, alpha)))
        .collect()
}

/// Calls the body with the library's distribution of these facets.
macro_rules! with_ndf {
    ($facets:expr, $ndf:ident => $body:expr) => {
        match $facets.shape {
            Shape::Ggx => {
                let $ndf = Ggx::new(alpha($facets.alpha));
                $body
            }
            Shape::Beckmann => {
                let $ndf = Beckmann::new(alpha($facets.alpha));
                $body
            }
        }
    };
}

#[test]
fn metals_are_the_textbooks() {
    prove_all("metals", &facets(), |&facets| {
        let mut report = Report::new(format!("metal {facets:?}"));
        let gold_book = |wo, wi| metal(facets, of_metal(GOLD), wo, wi);
        with_ndf!(facets, ndf => {
            let lobe = RoughConductor::new(ndf, gold());
            let pair: (textbook::Value<'_>, textbook::Value<'_>) =
                (&value(&lobe, RADIANCE), &gold_book);
            report.checks.push(compare("gold", &views(), 0.0, pair, EXACT));
            let tinted = RoughConductor::new(ndf, gold().tinted(colour()));
            let book = |wo, wi| gold_book(wo, wi) * colour();
            report.checks.push(compare(
                "tinted gold",
                &views(),
                0.0,
                (&value(&tinted, RADIANCE), &book),
                EXACT,
            ));
            let reflectance = Reflectance::Schlick(Schlick { f0: colour() });
            let lobe = RoughConductor::new(ndf, reflectance);
            let book = |wo, wi| metal(facets, |cos| schlick(colour(), cos), wo, wi);
            report.checks.push(compare(
                "Schlick",
                &views(),
                0.0,
                (&value(&lobe, RADIANCE), &book),
                EXACT,
            ));
            let lobe = RoughConductor::new(ndf, gold()).with_masking(Masking::Separable);
            let book = |wo: Vec3<f64>, wi: Vec3<f64>| {
                gold_book(wo, wi) * (facets.g1_g1(wo, wi) / facets.g2(wo, wi))
            };
            report.checks.push(compare(
                "separable masking",
                &views(),
                0.0,
                (&value(&lobe, RADIANCE), &book),
                EXACT,
            ));
        });
        report
    });
}

#[test]
fn glass_is_the_textbooks() {
    prove_all("glass", &facets(), |&facets| {
        let mut report = Report::new(format!("glass {facets:?}"));
        for eta in [1.5, 1.0 / 1.5, 1.1, 2.4] {
            for transport in [Transport::Radiance, Transport::Importance] {
                let name = format!("index {eta:.3}, {transport:?}");
                let book = |wo, wi| Rgb::splat(glass(facets, eta, (wo, wi), transport));
                let tints = Tints {
                    reflection: colour(),
                    transmission: rgb(0.3, 0.9, 0.6),
                };
                let tinted = |wo: Vec3<f64>, wi: Vec3<f64>| {
                    let is_reflection = wo.z * wi.z > 0.0;
                    let tint = if is_reflection {
                        tints.reflection
                    } else {
                        tints.transmission
                    };
                    book(wo, wi) * tint
                };
                with_ndf!(facets, ndf => {
                    let lobe = RoughDielectric::new(ndf, eta);
                    report.checks.push(compare(
                        &name,
                        &both_sides(),
                        -1.0,
                        (&value(&lobe, transport), &book),
                        EXACT,
                    ));
                    let lobe = lobe.with_tints(tints);
                    report.checks.push(compare(
                        &format!("tinted {name}"),
                        &both_sides(),
                        -1.0,
                        (&value(&lobe, transport), &tinted),
                        EXACT,
                    ));
                });
            }
        }
        report
    });
}

#[test]
fn compensated_metals_are_the_textbooks() {
    const MODELS: [EnergyModel; 3] = [
        EnergyModel::Turquin(FmsVariant::NormalIncidence),
        EnergyModel::Turquin(FmsVariant::AverageSeries),
        EnergyModel::KullaConty,
    ];
    let cases: Vec<_> = facets()
        .into_iter()
        .filter(|facets| facets.alpha.0 >= 0.2)
        .flat_map(|facets| MODELS.map(|model| (facets, model)))
        .collect();
    prove_all("compensated metals", &cases, |&(facets, model)| {
        let mut report = Report::new(format!("compensated {facets:?}"));
        let book = energy::compensated_metal(facets, model, energy::gold());
        with_ndf!(facets, ndf => {
            let lobe = Compensated::new(ndf, gold(), model);
            report.checks.push(compare(
                &model.to_string(),
                &views(),
                0.0,
                (&value(&lobe, RADIANCE), &book),
                TABLES,
            ));
        });
        report
    });
}

#[test]
fn compensated_glass_is_the_textbooks() {
    let rough = facets().into_iter().filter(|facets| facets.alpha.0 >= 0.2);
    let cases: Vec<_> = rough.map(|facets| (facets, 1.5)).collect();
    prove_all("compensated glass", &cases, |&(facets, eta)| {
        let mut report = Report::new(format!("compensated glass {facets:?}, index {eta}"));
        let book = energy::compensated_glass(facets, eta, 1.0);
        with_ndf!(facets, ndf => {
            let lobe = CompensatedDielectric::new(ndf, eta);
            report.checks.push(compare(
                "both sides",
                &both_sides(),
                -1.0,
                (&value(&lobe, Transport::Importance), &book),
                INTERFACE_TABLES,
            ));
            // Radiance is compressed, in both lobes alike.
            let scaled = |wo: Vec3<f64>, wi: Vec3<f64>| {
                let eta = if wo.z > 0.0 { eta } else { 1.0 / eta };
                let scale = if wo.z * wi.z < 0.0 { 1.0 / (eta * eta) } else { 1.0 };
                lobe.eval(wo, wi, Transport::Importance) * scale
            };
            report.checks.push(compare(
                "radiance",
                &both_sides(),
                -1.0,
                (&value(&lobe, RADIANCE), &scaled),
                EXACT,
            ));
        });
        report
    });
}

#[test]
fn plastics_are_the_textbooks() {
    let rough: Vec<_> = facets()
        .into_iter()
        .filter(|f| f.alpha.0 == f.alpha.1)
        .collect();
    prove_all("plastics", &rough, |&facets| {
        let mut report = Report::new(format!("plastic {facets:?}"));
        let eta = 1.5;
        let (diffuse, specular) = (colour(), rgb(0.5, 0.9, 0.7));
        // From inside: a rectangle rule with both its ends, as Mitsuba's.
        let internal = (0..64).map(|k| {
            let mu = (f64::from(k) / 63.0).max(1e-6);
            let wo = at(mu.acos().to_degrees(), 0.0);
            2.0 / 64.0 * mu * facets.glass_albedo_separable(wo, 1.0 / eta)[0]
        });
        let internal: f64 = internal.sum();
        for nonlinear in [false, true] {
            let base = diffuse.map(|rho| {
                let absorbed = if nonlinear { rho } else { 1.0 };
                rho / (1.0 - absorbed * internal)
            });
            let book = |wo: Vec3<f64>, wi: Vec3<f64>| {
                if wi.z <= 0.0 {
                    return Rgb::BLACK;
                }
                let masked = facets.g1_g1(wo, wi) / facets.g2(wo, wi);
                let fresnel = dielectric(wo.dot(half(wo, wi)), eta);
                let passed = |w| facets.glass_albedo_separable(w, eta)[1];
                let under = passed(wo) * passed(wi);
                specular * (fresnel * facets.white(wo, wi) * masked)
                    + base * (under / (eta * eta) * wi.z / PI)
            };
            with_ndf!(facets, ndf => {
                let lobe =
                    Plastic::rough(ndf, Masking::Separable, eta, diffuse, specular, nonlinear);
                report.checks.push(compare(
                    &format!("nonlinear {nonlinear}"),
                    &views(),
                    0.0,
                    (&value(&lobe, RADIANCE), &book),
                    TABLES,
                ));
            });
        }
        report
    });
}

#[test]
fn principled_and_gltf_are_the_textbooks() {
    let mut report = Report::new("artists' materials");
    let roughness = 0.6_f64;
    let facets = Facets::new(Shape::Ggx, (roughness * roughness, roughness * roughness));
    // Principled: separable masking; Fresnel's equations for the dielectric, Schlick's for the metal.
    for metallic in [0.0, 0.4, 1.0] {
        for spec_tint in [0.0, 0.7] {
            let lobe = Principled::new(PrincipledParameters {
                base_colour: colour(),
                roughness,
                metallic,
                spec_tint,
                spec_trans: 0.0,
                eta: 1.5,
                sheen: 0.0,
                clearcoat: 0.0,
                flatness: 0.0,
                anisotropic: 0.0,
                ..PrincipledParameters::default()
            });
            let book = |wo: Vec3<f64>, wi: Vec3<f64>| {
                let cos = wo.dot(half(wo, wi));
                let masked = facets.g1_g1(wo, wi) / facets.g2(wo, wi);
                let white = facets.white(wo, wi) * masked;
                let luminance = 0.2126 * 0.8 + 0.7152 * 0.4 + 0.0722 * 0.1;
                let tinted_f0 = colour() * (0.04 / luminance);
                let dielectrics = Rgb::splat(dielectric(cos, 1.5) * (1.0 - spec_tint))
                    + schlick(tinted_f0, cos) * spec_tint;
                // Burley 2012, section 5.3.
                let weight = |cos: f64| (1.0 - cos).powi(5);
                let f90 = 0.5 + 2.0 * roughness * cos * cos;
                let burley =
                    (1.0 + (f90 - 1.0) * weight(wo.z)) * (1.0 + (f90 - 1.0) * weight(wi.z));
                schlick(colour(), cos) * (metallic * white)
                    + dielectrics * ((1.0 - metallic) * white)
                    + colour() * ((1.0 - metallic) * burley * wi.z / PI)
            };
            report.checks.push(compare(
                &format!("principled, metallic {metallic}, spec_tint {spec_tint}"),
                &views(),
                0.0,
                (&value(&lobe, RADIANCE), &book),
                EXACT,
            ));
        }
    }
    for metallic in [0.0, 0.4, 1.0] {
        let tint = rgb(0.9, 0.5, 0.3);
        let lobe = Gltf::new(GltfParameters {
            base_colour: colour(),
            metallic,
            roughness,
            specular: 0.8,
            specular_colour: tint,
            ..GltfParameters::default()
        });
        // Views and lights above 45 degrees of elevation: below, the layer's albedo limits its base.
        let high = [at(5.0, 20.0), at(40.0, 200.0)];
        let book = |wo: Vec3<f64>, wi: Vec3<f64>| {
            let cos = wo.dot(half(wo, wi));
            let white = facets.white(wo, wi);
            let layer = schlick(tint * 0.04, cos) * 0.8;
            let base = colour() * ((1.0 - layer.max_channel()) * wi.z / PI);
            schlick(colour(), cos) * (metallic * white) + (layer * white + base) * (1.0 - metallic)
        };
        report.checks.push(compare(
            &format!("glTF, metallic {metallic}"),
            &high,
            0.75,
            (&value(&lobe, RADIANCE), &book),
            EXACT,
        ));
    }
    assert!(report.is_pass(), "{report}");
}

#[test]
fn coats_are_the_textbooks() {
    let mut report = Report::new("coats");
    let eta = 1.5;
    for alpha in [(0.2, 0.2), (0.2, 0.6)] {
        let facets = Facets::new(Shape::Ggx, alpha);
        let ggx = Ggx::new(Alpha::clamped(alpha.0, alpha.1));
        let lobe = Layered::new(Some(ggx), eta, Base::diffuse(Rgb::BLACK));
        let book = |wo, wi| Rgb::splat(glass(facets, eta, (wo, wi), RADIANCE));
        let values = |wo: Vec3<f64>, wi: Vec3<f64>| {
            lobe.eval_pdf_random(wo, wi, RADIANCE, &mut Stream::new(1))
                .0
        };
        let name = format!("coat over black {alpha:?}");
        report
            .checks
            .push(compare(&name, &views(), 0.0, (&values, &book), EXACT));
    }
    assert!(report.is_pass(), "{report}");
    // Smooth on smooth: what leaves along the mirror direction, in all.
    let lobe = Layered::new(None, eta, Base::metal(None, gold()));
    for wo in views() {
        let mut sum = Rgb::BLACK;
        let count = 20_000;
        let mut stream = Stream::new(5);
        for _ in 0..count {
            let u = [stream.next(), stream.next(), stream.next()];
            let sample = lobe.sample_random(wo, u, RADIANCE, &mut stream);
            sum += sample.map_or(Rgb::BLACK, |s| s.weight) * (1.0 / f64::from(count));
        }
        let r = dielectric(wo.z, eta);
        let below = (1.0 - (1.0 - wo.z * wo.z) / (eta * eta)).sqrt();
        let under_coat = of_metal(GOLD.map(|[n, k]| [n / eta, k / eta]))(below);
        let expected = under_coat.map(|f| r + (1.0 - r) * (1.0 - r) * f / (1.0 - f * r));
        let off = (sum - expected).map(f64::abs).max_channel();
        assert!(off < 1e-3, "{wo:?}: {sum:?}, not {expected:?}");
    }
}

/// Samples and values of the unbiased models, against walks by heights.
#[test]
fn bounces_have_the_walks_colours() {
    let cases = [
        (Facets::new(Shape::Ggx, (0.5, 0.5)), at(15.0, 20.0)),
        (Facets::new(Shape::Ggx, (1.0, 1.0)), at(40.0, 20.0)),
        (Facets::new(Shape::Ggx, (0.2, 0.8)), at(75.0, 70.0)),
        (Facets::new(Shape::Beckmann, (0.6, 0.6)), at(60.0, 70.0)),
    ];
    prove_all("bounces off gold", &cases, |&(facets, wo)| {
        let mut report = Report::new(format!("{facets:?}, {wo:?}"));
        let fresnel = of_metal(GOLD);
        let walk = |s: &mut Stream| walks::metal(facets, |_, cos, _| fresnel(cos), wo, s);
        let truth = walks::light(2, &walk);
        for model in MultibounceModel::ALL {
            if !model.is_unbiased() {
                continue;
            }
            with_ndf!(facets, ndf => {
                let lobe = MultibounceConductor::new(ndf, gold(), model);
                let samples =
                    |s: &mut Stream| common::sampled(&lobe, wo, s).map(|x| (x.wi, x.weight));
                let values = by_values(&lobe, wo);
                let ways: [(&str, walks::Sample<'_>); 2] =
                    [("samples", &samples), ("values", &values)];
                for (name, sample) in ways {
                    let name = format!("{name} of {}", model.name());
                    let light = walks::light(1, sample);
                    report.checks.push(walks::compare(&name, &light, &truth));
                }
            });
        }
        report
    });
}

/// Directions by the cosine, weighed by the lobe's values.
fn by_values<B: Bsdf<f64> + Sync>(
    lobe: &B,
    wo: Vec3<f64>,
) -> impl Fn(&mut Stream) -> Option<(Vec3<f64>, Rgb<f64>)> + Sync + '_ {
    move |s| {
        let wi = warp::cosine_hemisphere([s.next(), s.next()]);
        let f_cos = lobe.eval_pdf_random(wo, wi, RADIANCE, s).0;
        Some((wi, f_cos * (PI / wi.z)))
    }
}

#[test]
fn rough_glass_splits_light_as_walks_do() {
    let cases: Vec<_> = [
        Facets::new(Shape::Ggx, (0.5, 0.5)),
        Facets::new(Shape::Ggx, (1.0, 1.0)),
        Facets::new(Shape::Beckmann, (0.3, 0.8)),
    ]
    .into_iter()
    .flat_map(|facets| [1.5, 2.4].map(|eta| (facets, eta)))
    .collect();
    prove_all("bounces in glass", &cases, |&(facets, eta)| {
        let mut report = Report::new(format!("glass {facets:?}, index {eta}"));
        for wo in [at(20.0, 20.0), at(75.0, 70.0), at(140.0, 30.0)] {
            let truth = |s: &mut Stream| walks::glass(facets, eta, dielectric, wo, s);
            with_ndf!(facets, ndf => {
                let lobe = MultibounceDielectric::new(ndf, eta, MultibounceModel::default());
                let samples = |s: &mut Stream| {
                    let u = [s.next(), s.next(), s.next()];
                    let sample = lobe.sample_random(wo, u, Transport::Importance, s);
                    sample.map(|x| (x.wi, x.weight))
                };
                let (got, expected) = (walks::light(1, &samples), walks::light(2, &truth));
                report.checks.push(walks::compare("samples", &got, &expected));
            });
        }
        report
    });
}

/// How far compensation is from simulated bounces, which a white furnace cannot see: albedo of gold, green.
///
/// Alphas, degrees from the normal along x; walks by heights, Turquin, Turquin with the series, Kulla and Conty.
const DISTANCES: [((f64, f64), f64, [f64; 4]); 6] = [
    ((0.3, 0.3), 0.0, [0.782, 0.783, 0.781, 0.781]),
    ((0.6, 0.6), 60.0, [0.742, 0.746, 0.725, 0.727]),
    ((1.0, 1.0), 0.0, [0.634, 0.692, 0.599, 0.602]),
    ((1.0, 1.0), 75.0, [0.728, 0.739, 0.684, 0.685]),
    ((0.2, 0.8), 60.0, [0.742, 0.742, 0.721, 0.722]),
    ((0.02, 1.0), 85.0, [0.901, 0.841, 0.801, 0.761]),
];

#[test]
fn compensations_are_as_far_from_walks_as_documents_say() {
    let mut off = Vec::new();
    for (alphas, degrees, documented) in DISTANCES {
        let facets = Facets::new(Shape::Ggx, alphas);
        let ggx = Ggx::new(alpha(alphas));
        let wo = at(degrees, 0.0);
        let fresnel = of_metal(GOLD);
        let green = |sample: &(dyn Fn(&mut Stream) -> Option<Rgb<f64>> + Sync)| {
            let moments = common::moments(3, 200_000, |s| [sample(s).map_or(0.0, |c| c.g)]);
            moments[0].mean()
        };
        let truth = green(&|s| Some(walks::metal(facets, |_, cos, _| fresnel(cos), wo, s)?.1));
        let by = |model| {
            let lobe = Compensated::new(ggx, gold(), model);
            green(&|s| common::sampled(&lobe, wo, s).map(|x| x.weight))
        };
        let [zero, one, two] = [
            EnergyModel::Turquin(FmsVariant::NormalIncidence),
            EnergyModel::Turquin(FmsVariant::AverageSeries),
            EnergyModel::KullaConty,
        ]
        .map(by);
        let measured = [truth, zero, one, two];
        let pairs = measured.iter().zip(documented);
        if pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) > 3e-3 {
            off.push(format!(
                "{alphas:?}, {degrees}: {measured:.3?}, documented {documented:?}"
            ));
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}
