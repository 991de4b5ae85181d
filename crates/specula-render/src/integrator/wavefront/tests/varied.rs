//! Vertices whose lobes differ from point to point, and lobes that batches do not know: in wavefronts and alone.

use super::*;
use crate::options::TextureFilter;
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::measured::{Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Rgb};
use specula_scene::Image;
use specula_scene::measured::{MeasuredBrdf, to_bytes};
use specula_scene::scene::*;

const COLOUR: ColourParam = ColourParam::Texture(TextureId(0));
/// In [0.05, 0.6].
const NUMBER: FloatParam = FloatParam::Texture(TextureId(1));
const NORMALS: TextureId = TextureId(2);

/// Materials of surfaces, alternately, and how many samples may differ.
struct Varied {
    name: &'static str,
    materials: Vec<Material>,
    most_apart: usize,
}

fn grey(v: f32) -> ColourParam {
    ColourParam::Value(Rgb::splat(v))
}

fn value(v: f32) -> FloatParam {
    FloatParam::Value(v)
}

fn alpha(a: FloatParam) -> Roughness {
    Roughness::isotropic(a, RoughnessMapping::Alpha)
}

fn diffuse(reflectance: ColourParam, roughness: f32) -> MaterialKind {
    MaterialKind::Diffuse {
        reflectance,
        roughness: value(roughness),
    }
}

fn metal(roughness: Roughness, tint: ColourParam) -> MaterialKind {
    MaterialKind::Conductor {
        fresnel: ConductorFresnel::Schlick(grey(0.8)),
        roughness,
        tint,
    }
}

fn coated(reflectance: ColourParam, a: FloatParam, medium: CoatMedium) -> MaterialKind {
    MaterialKind::CoatedDiffuse {
        reflectance,
        eta: 1.5,
        roughness: alpha(a),
        medium,
        lossless: false,
    }
}

fn plastic(a: f32, distribution: MicrofacetDistribution) -> MaterialKind {
    MaterialKind::Plastic {
        diffuse: COLOUR,
        specular: grey(1.0),
        eta: 1.5,
        roughness: Roughness {
            distribution,
            ..alpha(value(a))
        },
        nonlinear: true,
    }
}

fn gltf() -> GltfMaterial {
    GltfMaterial {
        base_colour: grey(0.5),
        metallic: value(0.0),
        roughness: value(0.4),
        anisotropy: value(0.0),
        anisotropy_rotation_rad: 0.0,
        anisotropy_direction: None,
        ior: 1.5,
        specular: value(1.0),
        specular_colour: ColourParam::WHITE,
        transmission: value(0.0),
        volume: false,
        clearcoat: value(0.0),
        clearcoat_roughness: value(0.0),
        clearcoat_bump: None,
        sheen_colour: grey(0.0),
        sheen_roughness: value(0.0),
    }
}

fn principled() -> PrincipledMaterial {
    PrincipledMaterial {
        base_colour: COLOUR,
        roughness: value(0.5),
        anisotropic: value(0.0),
        metallic: NUMBER,
        spec_trans: value(0.0),
        eta: 1.5,
        spec_tint: value(0.0),
        sheen: value(0.0),
        sheen_tint: value(0.0),
        clearcoat: value(0.5),
        clearcoat_gloss: value(0.5),
        flatness: value(0.0),
        diff_trans: value(0.0),
        thin: false,
    }
}

fn bent(kind: MaterialKind, bump: Bump, bump_rules: BumpRules) -> Material {
    Material {
        bump: Some(bump),
        bump_rules,
        ..Material::new(kind)
    }
}

fn case(name: &'static str, materials: Vec<Material>, most_apart: usize) -> Varied {
    Varied {
        name,
        materials,
        most_apart,
    }
}

fn plain<const N: usize>(kinds: [MaterialKind; N]) -> Vec<Material> {
    kinds.map(Material::new).to_vec()
}

fn one_sided(kind: MaterialKind) -> Material {
    Material {
        one_sided: true,
        ..Material::new(kind)
    }
}

/// Kinds with one or two lobes, with textures.
fn textured() -> Vec<Varied> {
    let glass = MaterialKind::Dielectric {
        eta: 1.5,
        roughness: alpha(value(0.0)),
        reflection_tint: COLOUR,
        transmission_tint: grey(1.0),
    };
    let sheet = MaterialKind::DiffuseTransmission {
        reflectance: COLOUR,
        transmittance: grey(0.3),
    };
    let absorbing = CoatMedium {
        thickness: value(0.1),
        ..CoatMedium::default()
    };
    let none = CoatMedium::default();
    let two_sided = Material::new(diffuse(COLOUR, 0.0));
    vec![
        case(
            "diffuse",
            vec![one_sided(diffuse(COLOUR, 0.0)), two_sided],
            30,
        ),
        case(
            "rough diffuse, sheets",
            plain([diffuse(COLOUR, 0.7), sheet]),
            30,
        ),
        case(
            "metal",
            plain([
                metal(alpha(NUMBER), grey(1.0)),
                metal(alpha(value(0.1)), COLOUR),
            ]),
            30,
        ),
        case(
            "coats",
            plain([
                coated(COLOUR, value(0.2), absorbing),
                coated(COLOUR, value(0.0), none),
            ]),
            30,
        ),
        case(
            "coats of textured alpha",
            plain([coated(grey(0.7), NUMBER, absorbing)]),
            30,
        ),
        case("glass", plain([glass, diffuse(COLOUR, 0.0)]), 30),
    ]
}

/// Kinds whose lobes are gathered from all vertices that have one: none in one piece.
fn own_lobes() -> Vec<Material> {
    let gltf = MaterialKind::Gltf(GltfMaterial {
        base_colour: COLOUR,
        metallic: NUMBER,
        roughness: NUMBER,
        ..gltf()
    });
    let normals = Bump::Normal {
        map: NORMALS,
        scale: 0.7,
    };
    let glass = MaterialKind::Dielectric {
        eta: 1.5,
        roughness: alpha(NUMBER),
        reflection_tint: grey(1.0),
        transmission_tint: grey(1.0),
    };
    let of_principled = MaterialKind::Principled(principled());
    vec![
        Material::new(gltf),
        bent(gltf, normals, BumpRules::Plain),
        bent(of_principled, normals, BumpRules::Plain),
        Material::new(of_principled),
        bent(metal(alpha(NUMBER), grey(1.0)), normals, BumpRules::Plain),
        Material::new(glass),
        Material::new(metal(alpha(NUMBER), grey(0.8))),
    ]
}

/// Kinds with many lobes, with textures.
fn textured_layers() -> Vec<Varied> {
    let grey = diffuse(grey(0.6), 0.0);
    let everything = GltfMaterial {
        base_colour: COLOUR,
        metallic: NUMBER,
        roughness: NUMBER,
        clearcoat: NUMBER,
        clearcoat_roughness: value(0.2),
        sheen_colour: COLOUR,
        sheen_roughness: value(0.5),
        ..gltf()
    };
    let glass = GltfMaterial {
        transmission: NUMBER,
        base_colour: COLOUR,
        ..gltf()
    };
    let plastics = plain([
        MaterialKind::Principled(principled()),
        plastic(0.2, MicrofacetDistribution::Ggx),
        plastic(0.0, MicrofacetDistribution::Ggx),
        plastic(0.3, MicrofacetDistribution::Beckmann),
    ]);
    vec![
        case("glTF", plain([MaterialKind::Gltf(everything), grey]), 30),
        case("metallic and rough", own_lobes(), 40),
        case("glTF glass", plain([MaterialKind::Gltf(glass), grey]), 30),
        case("principled, plastic", plastics, 30),
    ]
}

/// Bent surfaces and mixtures.
fn bent_and_mixed() -> Vec<Varied> {
    let heights = Bump::Height(NUMBER);
    let normals = Bump::Normal {
        map: NORMALS,
        scale: 0.7,
    };
    let mitsuba = |fades| BumpRules::Mitsuba { fades };
    let metal_of = |a: f32| metal(alpha(value(a)), grey(1.0));
    let clearcoat = MaterialKind::Gltf(GltfMaterial {
        clearcoat: value(0.7),
        clearcoat_roughness: value(0.3),
        anisotropy: value(0.6),
        anisotropy_rotation_rad: 0.6,
        metallic: value(1.0),
        ..gltf()
    });
    let mixed = |amount| {
        Material::new(MaterialKind::Mix {
            materials: [MaterialId(2), MaterialId(3)],
            amount,
        })
    };
    let bumps = vec![
        bent(diffuse(COLOUR, 0.0), heights, BumpRules::Plain),
        bent(metal_of(0.2), normals, BumpRules::Plain),
        bent(metal_of(0.0), heights, mitsuba(false)),
        bent(diffuse(grey(0.7), 0.0), normals, mitsuba(true)),
    ];
    let coats = vec![
        bent(clearcoat, normals, BumpRules::Plain),
        Material::new(clearcoat),
    ];
    let mixtures = vec![
        mixed(NUMBER),
        mixed(value(0.3)),
        Material::new(metal_of(0.3)),
        one_sided(diffuse(COLOUR, 0.0)),
    ];
    vec![
        case("bump maps", bumps, 40),
        case("bent clear coats", coats, 40),
        case("mixtures", mixtures, 30),
    ]
}

/// Constant lobes, most of which batches do not know.
fn unknown() -> Vec<Varied> {
    let pane = MaterialKind::ThinDielectric {
        eta: 1.5,
        reflection_tint: grey(1.0),
        transmission_tint: grey(1.0),
    };
    let layered = MaterialKind::CoatedConductor {
        coat_eta: 1.5,
        coat_roughness: alpha(value(0.1)),
        fresnel: ConductorFresnel::Schlick(grey(0.8)),
        roughness: alpha(value(0.3)),
        medium: CoatMedium::default(),
    };
    let hazy = CoatMedium {
        thickness: value(0.3),
        albedo: grey(0.8),
        ..CoatMedium::default()
    };
    let beckmann = Roughness {
        distribution: MicrofacetDistribution::Beckmann,
        ..alpha(value(0.3))
    };
    let gltf = GltfMaterial {
        transmission: value(0.5),
        volume: true,
        ..gltf()
    };
    let principled = PrincipledMaterial {
        base_colour: grey(0.6),
        metallic: value(0.4),
        spec_trans: value(0.3),
        ..principled()
    };
    let smooth = coated(grey(0.7), value(0.0), CoatMedium::default());
    let measured = MaterialKind::Measured(MeasuredId(0));
    vec![
        case(
            "layers",
            plain([layered, coated(grey(0.7), value(0.2), hazy)]),
            60,
        ),
        case("panes, smooth coats", plain([pane, smooth]), 30),
        case(
            "Beckmann, measured",
            plain([metal(beckmann, grey(1.0)), measured]),
            40,
        ),
        case(
            "constant glTF, principled",
            plain([
                MaterialKind::Gltf(gltf),
                MaterialKind::Principled(principled),
            ]),
            40,
        ),
    ]
}

fn tables() -> MeasuredBrdf {
    let ndf = Ggx::new(Alpha::clamped(0.4, 0.4));
    let metal = Reflectance::Constant(Rgb::splat(0.8));
    let size = Resolution {
        theta: 12,
        phi: 1,
        normals: [48, 24],
        colours: 12,
    };
    let lobe = RoughConductor::new(ndf, metal);
    let bytes = to_bytes(&tabulate(&ndf, &lobe, Symmetry::Isotropic, size), "test");
    MeasuredBrdf::from_bytes("test.bsdf", &bytes).unwrap()
}

/// The built-in scene with these materials, a sphere, an instance, and a point light beside its lamps.
fn scene_with(materials: &[Material]) -> Scene {
    let mut scene = specula_scene::builtin::orbs();
    scene.measured = vec![tables()];
    let pixels = (0..16 * 16).map(|i| {
        let wave = |k: f32| 0.5 + 0.4 * (0.37 * k * i as f32).sin();
        [wave(1.0), wave(1.7), wave(2.9)]
    });
    scene.images.push(Image {
        name: "waves".into(),
        width: 16,
        height: 16,
        pixels: pixels.collect(),
    });
    scene.textures.push(Texture::Image {
        image: ImageId(scene.images.len() - 1),
        mapping: TextureMapping::Uv(UvMapping::scaled([2.0, 3.0], [0.1, 0.2])),
        wrap: [Wrap::Repeat; 2],
        filter: Interpolation::Bilinear,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    });
    let bilinear = |corners| Texture::Bilinear {
        corners,
        mapping: TextureMapping::default(),
    };
    scene
        .textures
        .push(bilinear([0.05, 0.2, 0.6, 0.4].map(Rgb::splat)));
    let tilted = |x, y| specula_bsdf::math::rgb(x, y, 0.95);
    scene.textures.push(bilinear([
        tilted(0.3, 0.5),
        tilted(0.5, 0.7),
        tilted(0.6, 0.4),
        tilted(0.5, 0.5),
    ]));
    for (i, material) in scene.materials.iter_mut().enumerate() {
        let name = material.name.take();
        *material = Material {
            name,
            ..materials[i % materials.len()].clone()
        };
    }
    let whole = scene.shapes.len();
    scene.shapes[whole - 1].geometry = Geometry::Sphere { radius: 1.0 };
    let orb = scene.shapes.remove(whole - 3);
    scene.objects.push(Object {
        name: String::new(),
        shapes: vec![orb],
    });
    scene.instances.push(ObjectInstance {
        object: ObjectId(scene.objects.len() - 1),
        to_world: glam::DMat4::from_translation(glam::DVec3::new(0.3, -0.4, 0.2)),
        motion: None,
    });
    scene.lights.push(Light::Point {
        position: [1.0, -4.0, 6.0],
        intensity: Rgb::splat(40.0),
    });
    scene
}

/// Nothing is shaded singly, as many vertices are shaded both ways, and their values are the same.
fn assert_same(case: &Varied, options: &RenderOptions, what: &str) {
    let both = both_ways(&scene_with(&case.materials), options);
    let what = format!("{}, {what}", case.name);
    let [together, alone] = both.vertices;
    assert_eq!(
        (together.single, alone.batched, alone.bound),
        (0, 0, 0),
        "{what}"
    );
    let lengths = together.total().abs_diff(alone.total());
    assert!(
        lengths * 500 < alone.total(),
        "{what}: {together:?} {alone:?}"
    );
    let apart = both.samples.iter().filter(|pair| are_apart(pair)).count();
    assert!(apart <= case.most_apart, "{what}: {apart}");
    let ratio = ratio(&both.samples);
    assert!((ratio - 1.0).abs() < 2e-3, "{what}: {ratio}");
    let [together, alone] = both.rays;
    assert!(
        together.abs_diff(alone) * 500 < alone,
        "{what}: {together} rays, {alone}"
    );
}

fn options(energy: Energy) -> RenderOptions {
    RenderOptions {
        max_depth: 6,
        energy,
        ..RenderOptions::default()
    }
}

#[test]
fn textured_paths_in_wavefronts_are_paths_alone() {
    for (i, case) in textured().iter().chain(&textured_layers()).enumerate() {
        let filtered = RenderOptions {
            texture_filter: TextureFilter::Ewa,
            regularize: i % 2 == 0,
            clamp: (i % 3 == 0).then_some(0.5),
            ..options(Energy::DEFAULT)
        };
        assert_same(case, &options(Energy::None), "single scattering");
        assert_same(case, &filtered, "filtered");
    }
}

#[test]
fn bent_mixed_and_unknown_paths_in_wavefronts_are_paths_alone() {
    for (i, case) in bent_and_mixed().iter().chain(&unknown()).enumerate() {
        let filtered = RenderOptions {
            texture_filter: TextureFilter::Trilinear,
            regularize: i % 2 == 0,
            ..options(Energy::DEFAULT)
        };
        assert_same(case, &options(Energy::None), "single scattering");
        assert_same(case, &filtered, "filtered");
    }
}

/// What batches know whole is not bound.
#[test]
fn diffuse_textures_are_shaded_in_batches() {
    let kinds = [diffuse(COLOUR, 0.0), metal(alpha(value(0.3)), grey(1.0))];
    let both = both_ways(
        &scene_with(&kinds.map(Material::new)),
        &options(Energy::None),
    );
    let [together, _] = both.vertices;
    assert_eq!((together.bound, together.single), (0, 0));
    assert_eq!(together.shares(), [1.0, 0.0, 0.0]);
}

#[test]
fn own_lobes_are_shaded_in_batches() {
    let both = both_ways(&scene_with(&own_lobes()), &options(Energy::None));
    let [together, _] = both.vertices;
    assert_eq!((together.bound, together.single), (0, 0));
}
