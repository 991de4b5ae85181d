//! Normal maps filtered into roughness: mean normals, covariances of slopes and alphas, on every kind of primitive.

use specula_render::{FilteredNormal, PreparedScene, PrimitivePoint, RenderOptions};
use specula_scene::Scene;
use specula_scene::scene::{Bump, BumpRules, Interpolation, Material, Texture, TextureId};
use specula_stat::Rng;

use crate::bumps::{self, Point};
use crate::device::{BUMPS, Device, Fault, Shader};
use crate::uniform;

/// Values of a result.
const VALUES: usize = 9;

/// The kernel: every material's normal map at every point.
const KERNEL: &str = "
@group(0) @binding(0) var<storage, read> points: array<f32>;
@group(0) @binding(4) var<storage, read_write> results: array<f32>;

fn two(at: u32) -> vec2f {
    return vec2f(points[at], points[at + 1u]);
}

@compute @workgroup_size(1)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let at = 13u * id.x;
    let ray = Ray(vec3f(two(at), points[at + 2u]), vec3f(0.0), 1.0);
    let instance = bitcast<u32>(points[at + 5u]);
    let primitive = bitcast<u32>(points[at + 6u]);
    var s = surface_at(ray, Hit(0.0, points[at + 3u], points[at + 4u], primitive, instance));
    s.footprint.changes = vec4f(two(at + 7u), two(at + 9u));
    let alphas = two(at + 11u);
    let bent = bump_bend(bump_of_material(id.y), s);
    let within = slopes_within(bent.spread, frame_from_normal_tangent(bent.normal, bent.tangent));
    let widening = slopes_widening(within, slopes_trace_about(bent.spread, bent.normal), alphas);
    let to = 9u * (id.x + id.y * arrayLength(&points) / 13u);
    for (var axis = 0u; axis < 3u; axis++) {
        results[to + axis] = bent.normal[axis];
        results[to + 3u + axis] = within[axis];
    }
    let alphas_wide = slopes_widened(widening, alphas);
    results[to + 6u] = alphas_wide.x;
    results[to + 7u] = alphas_wide.y;
    results[to + 8u] = slopes_widened_own_coat(widening, alphas.x);
}
";

fn scene() -> Scene {
    let mut scene = bumps::scene();
    let kind = scene.materials[0].kind;
    let map = scene.textures[3].clone();
    let filters = [
        Interpolation::Bilinear,
        Interpolation::Ewa {
            max_anisotropy: 3.0,
        },
        Interpolation::Trilinear,
    ];
    scene.materials.clear();
    for filter in filters {
        let mut map = map.clone();
        if let Texture::Image { filter: of_map, .. } = &mut map {
            *of_map = filter;
        }
        scene.textures.push(map);
        let map = TextureId(scene.textures.len() - 1);
        for (scale, bump_rules) in [
            (1.0, BumpRules::Plain),
            (0.6, BumpRules::Mitsuba { fades: false }),
        ] {
            scene.materials.push(Material {
                bump: Some(Bump::Normal { map, scale }),
                bump_rules,
                ..Material::new(kind)
            });
        }
    }
    scene
}

/// What a point has besides: changes of coordinates along its footprint, and alphas.
struct Case {
    point: Point,
    changes: [[f32; 2]; 2],
    alphas: [f32; 2],
}

fn cases() -> Vec<Case> {
    let mut rng = Rng::from_name("normal maps");
    let points = bumps::points().into_iter();
    points
        .map(|point| {
            // From under a pixel to the whole picture.
            let size = 3.0 * uniform(&mut rng).powi(4);
            let mut change = || [(); 2].map(|()| size * (2.0 * uniform(&mut rng) - 1.0));
            let changes = [change(), change()];
            let alphas = [(); 2].map(|()| 0.5 * uniform(&mut rng));
            Case {
                point,
                changes,
                alphas,
            }
        })
        .collect()
}

impl Case {
    fn inputs(&self) -> [f32; 13] {
        let mut inputs = [0.0; 13];
        inputs[..3].copy_from_slice(&self.point.near);
        inputs[3..5].copy_from_slice(&self.point.weights);
        inputs[5..7].copy_from_slice(&self.point.primitive.map(f32::from_bits));
        inputs[7..11].copy_from_slice(self.changes.as_flattened());
        inputs[11..].copy_from_slice(&self.alphas);
        inputs
    }

    fn cpu(&self, scene: &PreparedScene, material: u32) -> [f32; VALUES] {
        let at = PrimitivePoint {
            primitive: self.point.primitive,
            weights: self.point.weights,
            near: self.point.near,
        };
        let FilteredNormal {
            normal,
            covariance,
            alphas,
            coat_alpha,
            ..
        } = scene.filtered_normal(material, &at, self.changes, self.alphas);
        let mut all = [0.0; VALUES];
        all[..3].copy_from_slice(&normal);
        all[3..6].copy_from_slice(&covariance);
        all[6..8].copy_from_slice(&alphas);
        all[8] = coat_alpha;
        all
    }
}

/// Largest difference of any value, relative to values above 1, the primitive where it is, and the share of points
/// where slopes vary.
fn largest(device: &Device, fault: Option<Fault>) -> (f32, String, f64) {
    let options = RenderOptions {
        filter_normal_maps: true,
        ..RenderOptions::default()
    };
    let scene = scene();
    let count = scene.materials.len();
    let scene = PreparedScene::consume(scene, &options).unwrap();
    let cases = cases();
    let inputs: Vec<f32> = cases.iter().flat_map(Case::inputs).collect();
    let shader = Shader {
        kernel: KERNEL,
        modules: &BUMPS,
        fault,
    };
    let groups = [cases.len(), count, 1].map(|n| u32::try_from(n).unwrap());
    let found = device.run(
        &scene,
        &shader,
        &inputs,
        VALUES * cases.len() * count,
        groups,
    );
    let (mut most, mut vary) = ((0.0, String::new()), 0.0);
    for (m, material) in (0_u32..).zip(0..count) {
        for (i, case) in cases.iter().enumerate() {
            let at = VALUES * (i + material * cases.len());
            let (gpu, cpu) = (&found[at..at + VALUES], case.cpu(&scene, m));
            vary += f64::from(u8::from(cpu[3] + cpu[5] > 0.0));
            for (k, (g, c)) in gpu.iter().zip(cpu).enumerate() {
                let apart = (g - c).abs() / c.abs().max(1.0);
                // `f32::max` would hide NaN.
                if apart > most.0 || apart.is_nan() {
                    let name = case.point.name;
                    most = (
                        apart,
                        format!("value {k} of material {m} on {name}: {g} {c}"),
                    );
                }
            }
        }
    }
    (most.0, most.1, vary / (cases.len() * count) as f64)
}

/// Alphas are roots of what rounding leaves, 1e-7 of squares.
const BOUND: f32 = 1e-3;

#[test]
fn every_filtered_normal_is_the_cpus() {
    let Some(device) = Device::open("every_filtered_normal_is_the_cpus") else {
        return;
    };
    let (apart, place, vary) = largest(&device, None);
    println!("{apart:.1e}, {place}; {vary:.2} vary");
    assert!(apart <= BOUND * device.rounding(), "{apart}, {place}");
    assert!((0.3..0.99).contains(&vary), "{vary}");
}

#[test]
fn planted_faults_of_filtered_normals_are_found() {
    let Some(device) = Device::open("planted_faults_of_filtered_normals_are_found") else {
        return;
    };
    for [module, from, to] in [
        ["slopes", "squares.y - mean.x * mean.y", "squares.y"],
        ["slopes", "1.0 / (1.0 + dot(mean, mean) * squared)", "1.0"],
        ["slopes", "+ mixed + squares.y", "- mixed + squares.y"],
        ["slopes", "length(n.xy) / SLOPES_STEEPEST", "0.0"],
        ["bump", "values[1].xy + rest * p", "values[1].xy"],
        ["texture_filter", "mean.level == 0u && last > 0u", "false"],
    ] {
        let (apart, _, _) = largest(&device, Some(Fault { module, from, to }));
        let is_found = apart > 2.0 * BOUND || apart.is_nan();
        assert!(is_found, "{module}: {from} to {to}");
    }
}
