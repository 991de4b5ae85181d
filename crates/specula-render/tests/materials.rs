//! Every kind of material of a scene, bound to its lobe: against closed forms and quadrature.

mod common;

use common::*;
use core::cell::RefCell;
use core::f64::consts::PI;
use glam::DMat4;
use specula_bsdf::Rgb;
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::ndf::Masking;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::Energy;
use specula_scene::scene::*;
use std::sync::atomic::AtomicBool;

/// A floor of the material in a uniform sky of radiance 1, also below it, seen from `cos` above:
/// one bounce.
fn floor_of(kind: MaterialKind, cos: f64) -> Scene {
    let mut scene = lit_floor();
    let sin = (1.0 - cos * cos).sqrt();
    scene.camera = look([4.0 * sin, 0.0, 4.0 * cos], [0.0; 3], 0.05);
    scene.materials[0].kind = kind;
    scene.lights.push(constant_sky(1.0));
    scene
}

fn assert_albedo(what: &str, kind: MaterialKind, cos: f64, expected: f64) {
    let picture = render(&floor_of(kind, cos), 1024, 1, Strategy::Mis);
    assert_mean(what, &picture, expected, 2e-3);
}

fn fresnel(cos: f64, eta: f64) -> f64 {
    let sin2 = (1.0 - cos * cos) / (eta * eta);
    if sin2 >= 1.0 {
        return 1.0;
    }
    let t = (1.0 - sin2).sqrt();
    let s = (cos - eta * t) / (cos + eta * t);
    let p = (eta * cos - t) / (eta * cos + t);
    0.5 * (s * s + p * p)
}

#[test]
fn tints_are_factors_on_their_branches() {
    let (r, t) = (0.5, 0.25);
    let f = fresnel(0.8, 1.5);
    let glass = MaterialKind::Dielectric {
        eta: 1.5,
        roughness: Roughness::smooth(),
        reflection_tint: grey(0.5),
        transmission_tint: grey(0.25),
    };
    // Radiance below is squeezed by the square of the index.
    assert_albedo("glass", glass, 0.8, f * r + (1.0 - f) * t / 2.25);
    let pane = MaterialKind::ThinDielectric {
        eta: 1.5,
        reflection_tint: grey(0.5),
        transmission_tint: grey(0.25),
    };
    let both = 2.0 * f / (1.0 + f);
    assert_albedo("pane", pane, 0.8, both * r + (1.0 - both) * t);
    let mirror = |fresnel| MaterialKind::Conductor {
        fresnel,
        roughness: Roughness::smooth(),
        tint: grey(0.5),
    };
    assert_albedo("mirror", mirror(ConductorFresnel::Mirror), 0.8, 0.5);
    let schlick = 0.3 + 0.7 * 0.2_f64.powi(5);
    let metal = mirror(ConductorFresnel::Schlick(grey(0.3)));
    assert_albedo("schlick", metal, 0.8, 0.5 * schlick);
}

/// Beckmann's `Lambda = 1/mu int_mu^inf (m - mu) P(m) dm`, with `mu = cot(theta)` and the slopes' density
/// `P` along one axis.
fn lambda_beckmann(alpha: f64, cot: f64) -> f64 {
    let n = 2000;
    let reach = 6.0 * alpha;
    let sum: f64 = (0..n)
        .map(|i| {
            let m = (f64::from(i) + 0.5) / f64::from(n) * reach;
            m * (-((cot + m) / alpha).powi(2)).exp()
        })
        .sum();
    sum * reach / f64::from(n) / (cot * PI.sqrt() * alpha)
}

/// Heitz 2014, eq. 72.
fn lambda_ggx(alpha: f64, cot: f64) -> f64 {
    0.5 * ((1.0 + (alpha / cot).powi(2)).sqrt() - 1.0)
}

/// White rough metal at one bounce: the integral of `D G2 / (4 cos_o)` over the hemisphere.
fn single_scattering(
    alpha: f64,
    distribution: MicrofacetDistribution,
    masking: Masking,
    cos_o: f64,
) -> f64 {
    let lambda = |cot| match distribution {
        MicrofacetDistribution::Beckmann => lambda_beckmann(alpha, cot),
        MicrofacetDistribution::Ggx => lambda_ggx(alpha, cot),
    };
    let d = |z: f64| {
        let (z2, tan2) = (z * z, 1.0 / (z * z) - 1.0);
        let p22 = match distribution {
            MicrofacetDistribution::Beckmann => {
                (-tan2 / (alpha * alpha)).exp() / (PI * alpha * alpha)
            }
            MicrofacetDistribution::Ggx => {
                1.0 / (PI * alpha * alpha * (1.0 + tan2 / (alpha * alpha)).powi(2))
            }
        };
        p22 / (z2 * z2)
    };
    let cot = |z: f64| z / (1.0 - z * z).max(1e-12).sqrt();
    let lambda_o = lambda(cot(cos_o));
    let sin_o = (1.0 - cos_o * cos_o).sqrt();
    let (rows, columns) = (160, 320);
    let mut sum = 0.0;
    for i in 0..rows {
        let z = (f64::from(i) + 0.5) / f64::from(rows);
        let lambda_i = lambda(cot(z));
        let g2 = match masking {
            Masking::HeightCorrelated => 1.0 / (1.0 + lambda_o + lambda_i),
            Masking::Separable => 1.0 / ((1.0 + lambda_o) * (1.0 + lambda_i)),
        };
        for j in 0..columns {
            let phi = (f64::from(j) + 0.5) / f64::from(columns) * 2.0 * PI;
            let r = (1.0 - z * z).sqrt();
            let wm = [sin_o + r * phi.cos(), r * phi.sin(), cos_o + z];
            let length = wm.iter().map(|x| x * x).sum::<f64>().sqrt();
            sum += d(wm[2] / length) * g2;
        }
    }
    sum / (4.0 * cos_o) * 2.0 * PI / f64::from(rows * columns)
}

#[test]
fn distributions_and_maskings_are_the_ones_asked_for() {
    let cos = 0.3;
    let mut found = Vec::new();
    for distribution in [
        MicrofacetDistribution::Ggx,
        MicrofacetDistribution::Beckmann,
    ] {
        for masking in [Masking::HeightCorrelated, Masking::Separable] {
            let kind = MaterialKind::Conductor {
                fresnel: ConductorFresnel::Mirror,
                roughness: Roughness {
                    distribution,
                    masking,
                    ..alpha(1.0)
                },
                tint: ColourParam::WHITE,
            };
            let expected = single_scattering(1.0, distribution, masking, cos);
            let picture = render(&floor_of(kind, cos), 2048, 1, Strategy::Mis);
            let what = format!("{distribution:?}, {masking:?}");
            assert_mean(&what, &picture, expected, 4e-3);
            found.push(expected);
        }
    }
    // They differ by more than the test forgives.
    found.sort_by(f64::total_cmp);
    assert!(found.windows(2).all(|w| w[1] / w[0] > 1.01), "{found:?}");
}

/// Compensation knows Beckmann and both maskings: white metal and clear glass lose nothing.
#[test]
fn compensated_surfaces_of_every_distribution_lose_nothing() {
    let energy = Energy::Compensated("kulla-conty".parse().expect("it is known"));
    for distribution in [
        MicrofacetDistribution::Ggx,
        MicrofacetDistribution::Beckmann,
    ] {
        for masking in [Masking::HeightCorrelated, Masking::Separable] {
            let roughness = Roughness {
                distribution,
                masking,
                ..alpha(0.6)
            };
            let metal = MaterialKind::Conductor {
                fresnel: ConductorFresnel::Mirror,
                roughness,
                tint: ColourParam::WHITE,
            };
            let scene = floor_of(metal, 0.6);
            let options = RenderOptions {
                max_depth: 1,
                energy,
                ..RenderOptions::default()
            };
            let prepared = PreparedScene::new(&scene, &options).expect("the scene is sound");
            let mut renderer = Renderer::new(&prepared, options);
            renderer.render_pass(1024, &AtomicBool::new(false));
            let what = format!("{distribution:?}, {masking:?}");
            assert_mean(&what, &renderer.film().picture(), 1.0, 1e-2);
        }
    }
}

/// `F + (1 - F) (1 - F_avg) / eta^2  rho / (1 - r F_int)`, with `r` 1 or rho.
#[test]
fn plastic_is_its_closed_form_and_black_from_behind() {
    let eta = 1.5;
    let n = 20_000;
    let average: f64 = (0..n)
        .map(|i| {
            let cos2 = (f64::from(i) + 0.5) / f64::from(n);
            fresnel(cos2.sqrt(), eta)
        })
        .sum::<f64>()
        / f64::from(n);
    let internal = 1.0 - (1.0 - average) / (eta * eta);
    let (rho, specular, cos) = (0.6, 0.5, 0.7);
    let f = fresnel(cos, eta);
    for nonlinear in [false, true] {
        let plastic = MaterialKind::Plastic {
            diffuse: grey(0.6),
            specular: grey(0.5),
            eta: 1.5,
            roughness: Roughness::smooth(),
            nonlinear,
        };
        let back = if nonlinear { rho } else { 1.0 };
        let base = rho * (1.0 - f) * (1.0 - average) / (eta * eta) / (1.0 - back * internal);
        assert_albedo("plastic", plastic, cos, specular * f + base);
        let mut behind = floor_of(plastic, cos);
        behind.shapes[0].reverse_orientation = true;
        assert_eq!(mean(&render(&behind, 16, 1, Strategy::Mis)).0, 0.0);
    }
}

fn gltf() -> GltfMaterial {
    GltfMaterial {
        base_colour: grey(0.5),
        metallic: FloatParam::Value(0.0),
        roughness: FloatParam::Value(0.5),
        anisotropy: FloatParam::Value(0.0),
        anisotropy_rotation_rad: 0.0,
        anisotropy_direction: None,
        ior: 1.5,
        specular: FloatParam::Value(1.0),
        specular_colour: ColourParam::WHITE,
        transmission: FloatParam::Value(0.0),
        volume: false,
        clearcoat: FloatParam::Value(0.0),
        clearcoat_roughness: FloatParam::Value(0.0),
        clearcoat_bump: None,
        sheen_colour: grey(0.0),
        sheen_roughness: FloatParam::Value(0.0),
    }
}

fn principled() -> PrincipledMaterial {
    PrincipledMaterial {
        base_colour: grey(0.5),
        roughness: FloatParam::Value(0.5),
        anisotropic: FloatParam::Value(0.0),
        metallic: FloatParam::Value(0.0),
        spec_trans: FloatParam::Value(0.0),
        eta: 1.5,
        spec_tint: FloatParam::Value(0.0),
        sheen: FloatParam::Value(0.0),
        sheen_tint: FloatParam::Value(0.0),
        clearcoat: FloatParam::Value(0.0),
        clearcoat_gloss: FloatParam::Value(0.0),
        flatness: FloatParam::Value(0.0),
        diff_trans: FloatParam::Value(0.0),
        thin: false,
    }
}

/// Limits in which the layered materials are simple: Lambert, and a nearly perfect mirror.
#[test]
fn layered_materials_have_their_limits() {
    let lambert = GltfMaterial {
        specular: FloatParam::Value(0.0),
        ..gltf()
    };
    assert_albedo("glTF, no specular", MaterialKind::Gltf(lambert), 0.8, 0.5);
    let metal = GltfMaterial {
        metallic: FloatParam::Value(1.0),
        roughness: FloatParam::Value(0.1),
        ..gltf()
    };
    let schlick = 0.5 + 0.5 * 0.2_f64.powi(5);
    assert_albedo("glTF metal", MaterialKind::Gltf(metal), 0.8, schlick);
    let sheet = GltfMaterial {
        specular: FloatParam::Value(0.0),
        transmission: FloatParam::Value(1.0),
        roughness: FloatParam::Value(0.1),
        ..gltf()
    };
    assert_albedo("glTF sheet", MaterialKind::Gltf(sheet), 0.8, 0.5);
    let metal = PrincipledMaterial {
        metallic: FloatParam::Value(1.0),
        roughness: FloatParam::Value(0.1),
        ..principled()
    };
    assert_albedo(
        "principled metal",
        MaterialKind::Principled(metal),
        0.8,
        schlick,
    );
}

/// Strategies must agree: a layered material that claimed to be opaque and is not would lose the
/// lights below it when they are chosen.
#[test]
fn layered_materials_agree_by_all_strategies() {
    let kinds = [
        MaterialKind::Gltf(GltfMaterial {
            transmission: FloatParam::Value(0.7),
            clearcoat: FloatParam::Value(0.5),
            ..gltf()
        }),
        MaterialKind::Gltf(GltfMaterial {
            sheen_colour: grey(0.4),
            sheen_roughness: FloatParam::Value(0.5),
            ..gltf()
        }),
        MaterialKind::Principled(PrincipledMaterial {
            spec_trans: FloatParam::Value(0.5),
            ..principled()
        }),
        MaterialKind::Principled(PrincipledMaterial {
            thin: true,
            diff_trans: FloatParam::Value(1.0),
            ..principled()
        }),
        MaterialKind::Principled(PrincipledMaterial {
            clearcoat: FloatParam::Value(1.0),
            sheen: FloatParam::Value(0.5),
            ..principled()
        }),
    ];
    for (i, kind) in kinds.into_iter().enumerate() {
        let mut scene = floor_of(kind, 0.7);
        scene.lights.clear();
        let lamp = material(&mut scene, diffuse(0.0));
        for (x, z) in [(-1.0, 2.0), (-1.0, -2.0), (1.0, -1.5)] {
            scene
                .shapes
                .push(emitting(sphere(0.5, [x, 0.5, z], lamp), 5.0));
        }
        let results = [
            (Strategy::Mis, 2048),
            (Strategy::LightsOnly, 2048),
            (Strategy::BsdfOnly, 8192),
        ]
        .map(|(strategy, spp)| mean(&render(&scene, spp, 1, strategy)));
        assert_agree(&format!("kind {i}"), &results, 0, 0.03);
    }
}

/// A constant parameter.
type Float<'a> = &'a dyn Fn(f32) -> FloatParam;
/// A grey as a parameter.
type Grey<'a> = &'a dyn Fn(f32) -> ColourParam;

/// Every parameter as a texture that is the same everywhere, yet is not folded: what is rendered in
/// batches there and one by one here differs by rounding.
#[test]
fn textures_and_values_bind_alike() {
    let textures = RefCell::new(vec![Texture::VertexColour]);
    let textured = |v: f32| {
        let mut textures = textures.borrow_mut();
        textures.push(Texture::Constant(Rgb::splat(v)));
        let b = TextureId(textures.len() - 1);
        textures.push(Texture::Scale { a: TextureId(0), b });
        TextureId(textures.len() - 1)
    };
    let all = |f: Float, c: Grey| [simple_kinds(f, c), layered_kinds(f, c)].concat();
    let values = all(&FloatParam::Value, &grey);
    let maps = all(&|v| FloatParam::Texture(textured(v)), &|v| {
        ColourParam::Texture(textured(v))
    });
    for (i, (value, map)) in values.into_iter().zip(maps).enumerate() {
        let [a, b] = [value, map].map(|kind| {
            let mut scene = floor_of(kind, 0.7);
            scene.textures.clone_from(&textures.borrow());
            render(&scene, 16, 1, Strategy::Mis).colour
        });
        let apart = |(a, b): &(&Rgb<f32>, &Rgb<f32>)| (a.g - b.g).abs() > 1e-4 * a.g;
        let count = a.iter().zip(&b).filter(apart).count();
        assert!(count * 50 <= a.len(), "kind {i}: {count} of {}", a.len());
        assert!(a.iter().any(|c| c.g > 0.0), "kind {i} is black");
    }
}

fn rough(f: Float, roughness: f32) -> Roughness {
    Roughness::isotropic(f(roughness), RoughnessMapping::Square)
}

fn simple_kinds(f: Float, c: Grey) -> Vec<MaterialKind> {
    vec![
        MaterialKind::Diffuse {
            reflectance: c(0.4),
            roughness: f(0.3),
        },
        MaterialKind::DiffuseTransmission {
            reflectance: c(0.4),
            transmittance: c(0.3),
        },
        MaterialKind::Conductor {
            fresnel: ConductorFresnel::Index {
                eta: c(0.4),
                k: c(3.0),
            },
            roughness: rough(f, 0.6),
            tint: c(0.7),
        },
        MaterialKind::Conductor {
            fresnel: ConductorFresnel::Schlick(c(0.4)),
            roughness: rough(f, 0.0),
            tint: c(0.7),
        },
        MaterialKind::Dielectric {
            eta: 1.4,
            roughness: rough(f, 0.5),
            reflection_tint: c(0.8),
            transmission_tint: c(0.7),
        },
        MaterialKind::ThinDielectric {
            eta: 1.4,
            reflection_tint: c(0.8),
            transmission_tint: c(0.7),
        },
    ]
}

fn layered_kinds(f: Float, c: Grey) -> Vec<MaterialKind> {
    vec![
        MaterialKind::CoatedDiffuse {
            reflectance: c(0.6),
            eta: 1.5,
            roughness: rough(f, 0.4),
            medium: CoatMedium {
                thickness: f(0.2),
                max_depth: Some(6),
                ..CoatMedium::default()
            },
            lossless: false,
        },
        MaterialKind::CoatedConductor {
            coat_eta: 1.5,
            coat_roughness: rough(f, 0.3),
            fresnel: ConductorFresnel::Reflectance(c(0.8)),
            roughness: rough(f, 0.5),
            medium: CoatMedium {
                thickness: f(0.2),
                max_depth: Some(10),
                samples: 2,
                albedo: c(0.4),
                g: f(0.3),
            },
        },
        MaterialKind::Plastic {
            diffuse: c(0.6),
            specular: c(0.9),
            eta: 1.5,
            roughness: rough(f, 0.4),
            nonlinear: true,
        },
        MaterialKind::Principled(PrincipledMaterial {
            base_colour: c(0.6),
            roughness: f(0.4),
            anisotropic: f(0.3),
            metallic: f(0.2),
            spec_trans: f(0.3),
            spec_tint: f(0.4),
            sheen: f(0.3),
            sheen_tint: f(0.2),
            clearcoat: f(0.5),
            clearcoat_gloss: f(0.6),
            flatness: f(0.3),
            diff_trans: f(1.2),
            ..principled()
        }),
        MaterialKind::Gltf(GltfMaterial {
            base_colour: c(0.7),
            metallic: f(0.3),
            roughness: f(0.5),
            anisotropy: f(0.4),
            specular: f(0.8),
            specular_colour: c(0.9),
            transmission: f(0.2),
            clearcoat: f(0.3),
            clearcoat_roughness: f(0.2),
            sheen_colour: c(0.3),
            sheen_roughness: f(0.5),
            ..gltf()
        }),
    ]
}

/// The lobe of a material can be had where it is the same everywhere.
#[test]
fn constant_materials_have_a_lobe() {
    let mut scene = floor_of(glass(0.3), 1.0);
    let mix = MaterialKind::Mix {
        materials: [MaterialId(0); 2],
        amount: FloatParam::Value(0.5),
    };
    let mixed = material(&mut scene, mix);
    let prepared = PreparedScene::new(&scene, &RenderOptions::default()).unwrap();
    let [outside, inside] = [true, false].map(|side| prepared.lobe(0, side));
    assert!(matches!(outside, Some(Lobe::RoughDielectric(_))));
    assert!(inside.is_some() && inside != outside);
    assert_eq!(prepared.lobe(mixed.0, true), None);
    assert_eq!(prepared.lobe(99, true), None);
}

/// A card of one material outside and another inside looks, from either side, as one of that material from outside.
#[test]
fn sides_have_their_own_materials() {
    let principled = MaterialKind::Principled(PrincipledMaterial {
        base_colour: grey(0.5),
        roughness: FloatParam::Value(0.4),
        ..principled()
    });
    let sides = [diffuse(0.3), principled];
    let card = |height: f64, make: &dyn Fn(&mut Scene) -> MaterialId| {
        let mut scene = empty(look([3.0, 0.0, height], [0.0; 3], 5.0), 8);
        scene.lights.push(constant_sky(1.0));
        let m = make(&mut scene);
        let card = square(&mut scene, 5.0, DMat4::IDENTITY, m);
        scene.shapes.push(card);
        mean(&render(&scene, 64, 3, Strategy::Mis))
    };
    for (height, seen) in [(3.0, 0), (-3.0, 1)] {
        let found = card(height, &|scene| {
            let both = sides.map(|kind| material(scene, kind));
            material(scene, MaterialKind::Sided(both))
        });
        let expected = card(3.0, &|scene| material(scene, sides[seen]));
        assert_agree("a side", &[found, expected], 1, 0.02);
        assert!(
            (found.0 / expected.0 - 1.0).abs() < 0.02,
            "{found:?} {expected:?}"
        );
    }
}
