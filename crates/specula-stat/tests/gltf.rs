//! glTF's metallic-roughness material and its extensions.

mod common;

use common::{ABOVE, few_views, plan, prove_all};
use specula_bsdf::bsdf::{Gltf, GltfParameters};
use specula_bsdf::math::{Real, rgb, vec3};
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};
use specula_stat::quadrature::Quadrature;
use specula_stat::reciprocity::{self, Domain, ReciprocityOptions};
use specula_stat::{DirectionSample, Plan, Rng, Subject, furnace, prove};

type Case<T> = (&'static str, GltfParameters<T>);

fn base<T: Real>() -> GltfParameters<T> {
    GltfParameters {
        base_colour: rgb(T::of(0.8), T::of(0.4), T::of(0.1)),
        metallic: T::ZERO,
        roughness: T::of(0.5),
        ..GltfParameters::default()
    }
}

/// Reciprocal materials that let nothing pass.
fn opaque<T: Real>() -> Vec<Case<T>> {
    let t = T::of;
    vec![
        ("plain", base()),
        (
            "brushed metal",
            GltfParameters {
                metallic: T::ONE,
                anisotropy: t(0.7),
                ..base()
            },
        ),
        (
            "half metal, smooth",
            GltfParameters {
                metallic: t(0.5),
                roughness: t(0.25),
                specular: t(0.6),
                specular_colour: rgb(T::ONE, t(0.5), T::TWO),
                ior: t(1.8),
                ..base()
            },
        ),
        (
            "velvet",
            GltfParameters {
                roughness: T::ONE,
                sheen_colour: rgb(T::ONE, t(0.5), t(0.2)),
                sheen_roughness: t(0.4),
                ..base()
            },
        ),
    ]
}

/// Materials that let light pass.
fn passing<T: Real>() -> Vec<Case<T>> {
    let t = T::of;
    vec![
        (
            "thin",
            GltfParameters {
                transmission: t(0.7),
                ..base()
            },
        ),
        (
            "body",
            GltfParameters {
                transmission: t(0.8),
                volume: true,
                ior: t(1.4),
                ..base()
            },
        ),
    ]
}

fn coated<T: Real>() -> Case<T> {
    let t = T::of;
    let coated = GltfParameters {
        clearcoat: t(0.8),
        clearcoat_roughness: t(0.3),
        sheen_colour: rgb(t(0.4), t(0.2), T::ZERO),
        sheen_roughness: t(0.8),
        metallic: t(0.3),
        ..base()
    };
    ("coated", coated)
}

/// Metals that give back what they lose by scattering once.
fn compensated<T: Real>() -> Vec<Case<T>> {
    let t = T::of;
    let rough = GltfParameters {
        metallic: T::ONE,
        roughness: t(0.9),
        compensated: true,
        ..base()
    };
    let half = GltfParameters {
        metallic: t(0.5),
        anisotropy: t(0.7),
        roughness: t(0.7),
        ..rough
    };
    vec![("compensated", rough), ("compensated half metal", half)]
}

fn narrowest(p: &GltfParameters<f64>) -> (f64, f64) {
    let of = |r: f64| r * r;
    let alpha = if p.clearcoat > 0.0 {
        of(p.roughness).min(of(p.clearcoat_roughness))
    } else {
        of(p.roughness)
    };
    (alpha, alpha)
}

fn bends(p: &GltfParameters<f64>) -> f64 {
    match (p.volume, p.outside) {
        (false, _) => 1.0,
        (true, true) => p.ior,
        (true, false) => 1.0 / p.ior,
    }
}

fn plan_of(p: &GltfParameters<f64>) -> Plan {
    Plan {
        eta: bends(p),
        reciprocity: if p.clearcoat > 0.0 || p.compensated {
            Domain::Nowhere
        } else {
            Domain::Above
        },
        ..plan(narrowest(p))
    }
}

#[test]
fn every_material_from_above() {
    let mut cases = opaque::<f64>();
    cases.extend(passing());
    cases.push(coated());
    cases.push((
        "inside a body",
        GltfParameters {
            outside: false,
            ..passing()[1].1
        },
    ));
    cases.extend(compensated());
    prove_all("gltf", &cases, |&(name, p)| {
        let lobe = Gltf::new(p);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        prove(name, &subject, &few_views(&ABOVE), &plan_of(&p))
    });
}

#[test]
fn backfacing_views_follow_the_density() {
    let cases = [opaque::<f64>()[0], passing()[1], coated()];
    prove_all("gltf from below", &cases, |&(name, p)| {
        let lobe = Gltf::new(p);
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let name = format!("{name} from below");
        let plan = Plan {
            reciprocity: Domain::Nowhere,
            ..plan_of(&p)
        };
        prove(&name, &subject, &few_views(&[-0.05, -0.3]), &plan)
    });
}

/// A coat with a normal map: its own frame, whose horizon is not the base's.
#[test]
fn bent_coats_follow_their_own_frame() {
    let (_, p) = coated::<f64>();
    let cases = [("bent coat", [-0.6, 0.3, 0.74])];
    prove_all("gltf bent coat", &cases, |&(name, [x, y, z])| {
        let lobe = Gltf::new(p).with_coat_normal(vec3(x, y, z).normalize());
        let subject = Subject::from_bsdf(&lobe, Transport::Radiance);
        let name = format!("{name} {x}");
        let views = few_views(&[0.4, -0.05]);
        prove(&name, &subject, &views, &plan_of(&p))
    });
}

/// The two lobes of a body as one subject with both sides.
fn both_sides(p: GltfParameters<f64>) -> Subject<'static> {
    let lobes = [false, true].map(|outside| Gltf::new(GltfParameters { outside, ..p }));
    let seen = move |wo: Vec3<f64>, w: Vec3<f64>| {
        let turn = 1.0_f64.copysign(wo.z);
        (lobes[usize::from(wo.z > 0.0)], vec3(w.x, w.y, w.z * turn))
    };
    let t = Transport::Radiance;
    Subject::new(
        move |wo, wi| seen(wo, wo).0.eval(seen(wo, wo).1, seen(wo, wi).1, t),
        move |wo, wi| seen(wo, wo).0.pdf(seen(wo, wo).1, seen(wo, wi).1),
        move |wo, u| {
            let (lobe, upright) = seen(wo, wo);
            let sample = lobe.sample(upright, u, t)?;
            Some(DirectionSample::new(seen(wo, sample.wi).1, sample.weight))
        },
    )
}

#[test]
fn bodies_are_reciprocal_across_their_surface() {
    let (name, p) = passing::<f64>()[1];
    let options = ReciprocityOptions {
        domain: Domain::Everywhere,
        eta: p.ior,
        relative_tolerance: 1e-8,
        ..ReciprocityOptions::default()
    };
    let check = reciprocity::test(name, &both_sides(p), &options, &mut Rng::new(8));
    assert!(check.is_pass, "{check}");
}

#[test]
fn f32_is_f64() {
    fn all<T: Real>() -> Vec<Case<T>> {
        let mut all = opaque();
        all.extend(passing());
        all.push(coated());
        all
    }
    let cases: Vec<_> = all::<f32>().into_iter().zip(all::<f64>()).collect();
    prove_all("gltf twins", &cases, |&((name, single), (_, double))| {
        let transport = Transport::Radiance;
        common::twins(name, &Gltf::new(single), &Gltf::new(double), transport)
    });
}

fn energy(p: GltfParameters<f64>, wo: Vec3<f64>) -> f64 {
    let lobe = Gltf::new(p);
    let subject = Subject::from_bsdf(&lobe, Transport::Importance);
    let edges = [wo.z, -wo.z];
    let albedo = furnace::albedo(&subject, wo, &edges, &Quadrature::default());
    albedo.value.into_iter().fold(0.0, f64::max)
}

#[test]
fn gltf_makes_no_light() {
    let white = GltfParameters {
        base_colour: Rgb::WHITE,
        metallic: 0.0,
        ..GltfParameters::default()
    };
    let mut materials = vec![];
    for roughness in [0.3, 0.6, 1.0] {
        let plain = GltfParameters { roughness, ..white };
        let bright = GltfParameters {
            specular_colour: Rgb::splat(8.0),
            ..plain
        };
        let velvet = GltfParameters {
            sheen_colour: Rgb::WHITE,
            sheen_roughness: roughness,
            ..plain
        };
        let coated = GltfParameters {
            clearcoat: 1.0,
            clearcoat_roughness: roughness,
            ..plain
        };
        let half = GltfParameters {
            metallic: 0.5,
            anisotropy: 0.8,
            ..plain
        };
        let pane = GltfParameters {
            transmission: 0.5,
            ..plain
        };
        let body = GltfParameters {
            volume: true,
            ..pane
        };
        let inside = GltfParameters {
            outside: false,
            ..body
        };
        let compensated = GltfParameters {
            metallic: 1.0,
            compensated: true,
            ..half
        };
        let compensated_half = GltfParameters {
            metallic: 0.5,
            anisotropy: 0.0,
            ..compensated
        };
        materials.extend([plain, bright, velvet, coated, half, pane, body, inside]);
        materials.extend([compensated, compensated_half]);
    }
    let mut brightest = 0.0_f64;
    for wo in few_views(&[1.0, 0.6, 0.2, 0.05]) {
        for &p in &materials {
            let all = energy(p, wo);
            assert!(all <= 1.0 + 1e-3, "{all} from {wo:?}: {p:?}");
            brightest = brightest.max(all);
        }
    }
    assert!(brightest > 0.95, "{brightest}");
}

/// `f` by the appendix's formulas, written plainly: with the diffuse base, and without it.
fn appendix(p: &GltfParameters<f64>, wo: Vec3<f64>, wi: Vec3<f64>) -> [Rgb<f64>; 2] {
    let h = (wo + wi).normalize();
    let s = (1.0 - wo.dot(h)).powi(5);
    let a2 = p.roughness.powi(4);
    let d = a2 / (std::f64::consts::PI * (h.z * h.z * (a2 - 1.0) + 1.0).powi(2));
    let long = |a: f64, b: f64| a * (a2 + (1.0 - a2) * b * b).sqrt();
    let v = 0.5 / (long(wi.z, wo.z) + long(wo.z, wi.z));
    let f0 = p.specular_colour * ((p.ior - 1.0) / (p.ior + 1.0)).powi(2);
    let f = f0.map(|f0| p.specular * (f0.min(1.0) + (1.0 - f0.min(1.0)) * s));
    let metal = p.base_colour.map(|b| (b + (1.0 - b) * s) * v * d);
    let diffuse = p.base_colour * ((1.0 - f.max_channel()) / std::f64::consts::PI);
    let facets = metal * p.metallic + f * (v * d * (1.0 - p.metallic));
    [facets + diffuse * (1.0 - p.metallic), facets]
}

#[test]
fn the_formulas_are_the_appendixs() {
    let (wo, wi) = (vec3(0.28, 0.0, 0.96), vec3(-0.36, 0.48, 0.8));
    let mixed = GltfParameters {
        metallic: 0.4,
        roughness: 0.7,
        ior: 1.6,
        specular: 0.5,
        specular_colour: rgb(1.0, 0.5, 0.25),
        ..base()
    };
    let metal = GltfParameters {
        metallic: 1.0,
        ..mixed
    };
    let black = GltfParameters {
        base_colour: Rgb::BLACK,
        ..mixed
    };
    for p in [mixed, metal, black] {
        let [expected, facets] = appendix(&p, wo, wi);
        let found = Gltf::new(p).eval(wo, wi, Transport::Radiance) / wi.z;
        for channel in 0..3 {
            let of = |colour: Rgb<f64>| colour.to_array()[channel];
            let (found, expected, facets) = (of(found), of(expected), of(facets));
            // Facets are exact; the base may be limited, by less than a hundredth here.
            let base = expected - facets;
            let off = expected - found;
            assert!(
                off >= -1e-12 && off <= 0.01 * base + 1e-12,
                "{found} {expected}"
            );
        }
    }
}

/// A white metal loses nothing once it is compensated, and a coloured one has Turquin's albedo: the single
/// scattering of each channel times `1 + b L / (1 - L)`, by the uncompensated lobes alone.
#[test]
fn compensated_metals_keep_their_energy_and_their_colour() {
    for roughness in [0.4, 0.7, 1.0] {
        let metal = |base_colour, compensated| {
            Gltf::new(GltfParameters::<f64> {
                base_colour,
                roughness,
                compensated,
                ..GltfParameters::default()
            })
        };
        let gold = rgb(1.0, 0.7, 0.3);
        let lobes = [
            metal(Rgb::WHITE, false),
            metal(Rgb::WHITE, true),
            metal(gold, false),
            metal(gold, true),
        ];
        for cos in [0.95_f64, 0.5, 0.1] {
            let wo = vec3((1.0 - cos * cos).sqrt(), 0.0, cos);
            let [white, whole, plain, full] = lobes.map(|lobe| mean_weight(&lobe, wo));
            let lost = 1.0 - white.r;
            assert!(lost > 5e-4, "{roughness} {cos}: nothing is lost");
            assert!((whole.r - 1.0).abs() < 3e-3, "{roughness} {cos}: {whole:?}");
            let expected = [plain.r, plain.g, plain.b];
            let base = gold.to_array();
            for ((got, single), b) in full.to_array().iter().zip(expected).zip(base) {
                let wanted = single * (1.0 + b * lost / (1.0 - lost));
                assert!(
                    (got - wanted).abs() < 3e-3,
                    "{roughness} {cos}: {got} {wanted}"
                );
            }
        }
    }
}

/// Directional albedo: the mean weight of samples on a grid.
fn mean_weight(lobe: &Gltf<f64>, wo: Vec3<f64>) -> Rgb<f64> {
    const SIDE: u32 = 400;
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    let mut sum = Rgb::BLACK;
    for i in 0..SIDE * SIDE {
        let choice = (f64::from(i) * 0.618_033_988_749_895).fract();
        let u = [choice, place(i % SIDE), place(i / SIDE)];
        if let Some(sample) = lobe.sample(wo, u, Transport::Radiance) {
            sum += sample.weight;
        }
    }
    sum * (1.0 / f64::from(SIDE * SIDE))
}
