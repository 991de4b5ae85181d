//! Bent normals: every kind of bump map on every kind of primitive.
//!
//! Errors are lengths of differences of vectors. A height's slope divides the difference of two texture
//! values by a step of 0.0005, which multiplies their rounding by 2000.

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::{PreparedScene, PrimitivePoint, RenderOptions};
use specula_scene::builtin;
use specula_scene::scene::{
    Bump, BumpRules, Channel, FloatParam, Geometry, ImageId, Interpolation, Material, MaterialId,
    Mesh, MeshId, NoiseKind, Object, ObjectId, ObjectInstance, Scene, Shape, Texture, TextureId,
    TextureMapping, UvMapping, Wrap,
};
use specula_stat::Rng;

use crate::device::{BUMPS, Device, Fault, Shader};
use crate::{nodes, uniform, unit};

/// Points on each primitive.
const POINTS: usize = 32;

/// The kernel: every material's bump map at every point.
const KERNEL: &str = "
@group(0) @binding(0) var<storage, read> points: array<f32>;
@group(0) @binding(4) var<storage, read_write> results: array<f32>;

fn three(at: u32) -> vec3f {
    return vec3f(points[at], points[at + 1u], points[at + 2u]);
}

@compute @workgroup_size(1)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let at = 16u * id.x;
    let ray = Ray(three(at), vec3f(0.0), 1.0);
    let instance = bitcast<u32>(points[at + 5u]);
    let primitive = bitcast<u32>(points[at + 6u]);
    let s = surface_at(ray, Hit(0.0, points[at + 3u], points[at + 4u], primitive, instance));
    let bump = bump_of_material(id.y);
    let bent = bump_bend(bump, s);
    let wo = three(at + 7u);
    let wi = three(at + 10u);
    let turned = unit_or(three(at + 13u), wo);
    let softened = bump_softened(bump, wo, turned, -wi);
    let to = 10u * (id.x + id.y * arrayLength(&points) / 16u);
    for (var axis = 0u; axis < 3u; axis++) {
        results[to + axis] = bent.normal[axis];
        results[to + 3u + axis] = bent.tangent[axis];
        results[to + 6u + axis] = softened.normal[axis];
    }
    results[to + 9u] = bump_softness(softened.softness, wi);
}
";

/// A primitive of the scene, by name: instance, index in its group, and whether it is a quadric about
/// a point of the world.
const PRIMITIVES: [(&str, u32, u32, Option<[f32; 3]>); 12] = [
    ("bent mesh", 0, 0, None),
    ("bent mesh", 0, 1, None),
    ("bare mesh", 0, 2, None),
    ("bare mesh", 0, 3, None),
    ("mesh with tangents", 0, 4, None),
    ("mesh with tangents", 0, 5, None),
    ("sphere", 0, 6, Some([3.0, 0.5, -0.2])),
    ("disk", 0, 7, Some([-3.0, 0.5, 0.7])),
    ("bent mesh, placed", 1, 0, None),
    ("bent mesh, placed", 1, 1, None),
    ("sphere, placed", 1, 2, Some([0.4, 5.0, 0.3])),
    ("disk, placed", 1, 3, Some([0.4, 5.0, 0.3])),
];

/// Name, bump map, rules, and the largest error of normals and tangents.
fn materials() -> Vec<(&'static str, Option<Bump>, BumpRules, f32)> {
    let height = |texture| Some(Bump::Height(FloatParam::Texture(TextureId(texture))));
    let normal = |scale| Bump::Normal {
        map: TextureId(3),
        scale,
    };
    let mitsuba = |fades| BumpRules::Mitsuba { fades };
    vec![
        ("none", None, BumpRules::Plain, 2e-6),
        ("ramp", height(0), BumpRules::Plain, 2e-3),
        ("noise", height(1), BumpRules::Plain, 2e-3),
        ("picture", height(2), mitsuba(true), 4e-3),
        ("normal map", Some(normal(1.0)), BumpRules::Plain, 2e-5),
        (
            "normal map, Mitsuba's",
            Some(normal(0.7)),
            mitsuba(false),
            2e-5,
        ),
        ("normal map, faded", Some(normal(0.7)), mitsuba(true), 2e-5),
    ]
}

fn textures() -> Vec<Texture> {
    let mapping = TextureMapping::Uv(UvMapping([[0.9, 0.1, 0.05], [-0.2, 1.1, 0.3]]));
    let picture = |scale, mapping| Texture::Image {
        image: ImageId(0),
        mapping,
        wrap: [Wrap::Mirror; 2],
        filter: Interpolation::Bilinear,
        invert: false,
        scale,
        channel: Channel::Rgb,
    };
    vec![
        Texture::Bilinear {
            corners: [0.0, 0.3, -0.2, 0.5].map(Rgb::splat),
            mapping,
        },
        Texture::Noise {
            kind: NoiseKind::Fbm,
            octaves: 2,
            roughness: 0.3,
            to_texture: DMat4::IDENTITY,
        },
        picture(0.2, mapping),
        picture(
            1.0,
            TextureMapping::Uv(UvMapping::scaled([0.2; 2], [0.1; 2])),
        ),
    ]
}

fn bent_mesh() -> Mesh {
    Mesh {
        positions: vec![
            [-1.0, -1.0, 0.0],
            [1.2, -0.9, 0.1],
            [1.0, 1.1, -0.1],
            [-1.0, 1.0, 0.2],
        ],
        normals: vec![
            [-0.2, 0.1, 1.0],
            [0.3, -0.1, 1.1],
            [0.1, 0.2, 0.8],
            [0.0, -0.3, 1.0],
        ],
        uvs: vec![[0.1, 0.2], [1.9, 0.1], [2.0, 0.9], [0.0, 1.1]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

pub(crate) fn scene() -> Scene {
    let mut scene = builtin::orbs();
    let kind = scene.materials.pop().unwrap().kind;
    scene.materials = materials()
        .into_iter()
        .map(|(_, bump, bump_rules, _)| Material {
            bump,
            bump_rules,
            ..Material::new(kind)
        })
        .collect();
    scene.lights.clear();
    scene.textures = textures();
    scene.images = nodes::images();
    let bare = Mesh {
        positions: vec![
            [2.0, -1.0, 0.5],
            [3.2, -0.9, 0.1],
            [3.0, 1.1, -0.1],
            [2.0, 1.0, 0.2],
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    };
    let tangents = Mesh {
        tangents: vec![
            [1.0, 0.1, 0.0, -1.0],
            [0.9, -0.3, 0.1, -1.0],
            [1.1, 0.2, 0.3, -1.0],
            [0.8, 0.0, -0.1, -1.0],
        ],
        ..bent_mesh()
    };
    scene.meshes = vec![bent_mesh(), bare, tangents];
    let shape = |geometry, to_world| Shape {
        geometry,
        to_world,
        material: MaterialId(0),
        emission: None,
        reverse_orientation: false,
        alpha: FloatParam::Value(1.0),
        motion: None,
    };
    let mesh = |i| shape(Geometry::Mesh(MeshId(i)), DMat4::IDENTITY);
    let turned = DMat4::from_rotation_y(0.7) * DMat4::from_scale(DVec3::new(0.8, 0.9, 1.1));
    let sphere = Shape {
        reverse_orientation: true,
        ..shape(Geometry::Sphere { radius: 0.9 }, turned)
    };
    let disk = shape(
        Geometry::Disk {
            radius: 1.1,
            height: 0.2,
        },
        turned,
    );
    let moved = |shape: &Shape, by| Shape {
        to_world: DMat4::from_translation(by) * shape.to_world,
        ..shape.clone()
    };
    scene.shapes = vec![
        mesh(0),
        mesh(1),
        mesh(2),
        moved(&sphere, DVec3::new(3.0, 0.5, -0.2)),
        moved(&disk, DVec3::new(-3.0, 0.5, 0.7)),
    ];
    scene.objects = vec![Object {
        name: "placed".to_owned(),
        shapes: vec![mesh(0), sphere, disk],
    }];
    scene.instances = vec![ObjectInstance {
        object: ObjectId(0),
        to_world: DMat4::from_translation(DVec3::new(0.4, 5.0, 0.3))
            * DMat4::from_rotation_x(0.4)
            * DMat4::from_scale(DVec3::new(1.2, 0.7, 0.9)),
        motion: None,
    }];
    scene
}

/// A point of a primitive, and three directions.
pub(crate) struct Point {
    pub(crate) name: &'static str,
    pub(crate) primitive: [u32; 2],
    pub(crate) near: [f32; 3],
    pub(crate) weights: [f32; 2],
    /// Unbent, towards the light, bent.
    directions: [[f32; 3]; 3],
}

pub(crate) fn points() -> Vec<Point> {
    let mut rng = Rng::from_name("bumps");
    let mut points = Vec::new();
    for (name, instance, primitive, middle) in PRIMITIVES {
        for _ in 0..POINTS {
            let mut direction = || unit(std::array::from_fn(|_| 2.0 * uniform(&mut rng) - 1.0));
            let directions = [direction(), direction(), direction()];
            let away = direction();
            let [u, v] = [uniform(&mut rng), uniform(&mut rng)];
            let weights = if u + v > 1.0 {
                [1.0 - u, 1.0 - v]
            } else {
                [u, v]
            };
            points.push(Point {
                name,
                primitive: [instance, primitive],
                near: middle.map_or([0.0; 3], |m| std::array::from_fn(|i| m[i] + away[i])),
                weights,
                directions,
            });
        }
    }
    points
}

impl Point {
    fn inputs(&self) -> [f32; 16] {
        let mut inputs = [0.0; 16];
        inputs[..3].copy_from_slice(&self.near);
        inputs[3..5].copy_from_slice(&self.weights);
        inputs[5..7].copy_from_slice(&self.primitive.map(f32::from_bits));
        inputs[7..].copy_from_slice(self.directions.as_flattened());
        inputs
    }

    /// What the CPU has: normal, tangent, softened normal, factor.
    fn cpu(&self, scene: &PreparedScene, material: u32) -> [f32; 10] {
        let at = PrimitivePoint {
            primitive: self.primitive,
            weights: self.weights,
            near: self.near,
        };
        let [normal, tangent] = scene.bumped_frame(material, &at);
        let [unbent, wi, bent] = self.directions;
        let softened = scene.softened_normal(material, [unbent, bent, wi.map(|x| -x), wi]);
        let mut all = [0.0; 10];
        all[..9].copy_from_slice([normal, tangent, softened.normal].as_flattened());
        all[9] = softened.factor;
        all
    }
}

/// Largest errors by material and primitive: of normals, tangents, softened normals and factors.
fn errors(device: &Device, fault: Option<Fault>) -> Vec<(String, f32, [f32; 4])> {
    let scene = PreparedScene::consume(scene(), &RenderOptions::default()).unwrap();
    let points = points();
    let materials = materials();
    let inputs: Vec<f32> = points.iter().flat_map(Point::inputs).collect();
    let shader = Shader {
        kernel: KERNEL,
        modules: &BUMPS,
        fault,
    };
    let groups = [points.len(), materials.len(), 1].map(|n| u32::try_from(n).unwrap());
    let count = 10 * points.len() * materials.len();
    let found = device.run(&scene, &shader, &inputs, count, groups);
    let mut errors: Vec<(String, f32, [f32; 4])> = Vec::new();
    for (m, (material, _, _, bound)) in (0_u32..).zip(&materials) {
        for (i, point) in points.iter().enumerate() {
            let at = 10 * (i + m as usize * points.len());
            let (gpu, cpu) = (&found[at..at + 10], point.cpu(&scene, m));
            let apart = |from: usize, to: usize| {
                let squares = (from..to).map(|i| (gpu[i] - cpu[i]).powi(2));
                let size = cpu[from..to].iter().map(|x| x * x).sum::<f32>().max(1.0);
                (squares.sum::<f32>() / size).sqrt()
            };
            let here = [apart(0, 3), apart(3, 6), apart(6, 9), apart(9, 10)];
            let name = format!("{material} on {}", point.name);
            match errors.last_mut().filter(|e| e.0 == name) {
                Some((_, _, most)) => {
                    for (most, here) in most.iter_mut().zip(here) {
                        // `f32::max` would hide NaN.
                        *most = if here <= *most { *most } else { here };
                    }
                }
                None => errors.push((name, *bound, here)),
            }
        }
    }
    errors
}

/// Softened normals and factors are within this.
const SOFTNESS: f32 = 1e-5;

/// * `bound`: of software; differences of noise magnify the rounding of a real GPU more.
fn is_wrong(
    device: &Device,
    (_, bound, [normal, tangent, softened, factor]): &(String, f32, [f32; 4]),
) -> bool {
    let bound = &(bound * device.rounding());
    let sound = normal <= bound && tangent <= bound;
    !(sound && *softened <= SOFTNESS && *factor <= SOFTNESS)
}

#[test]
fn every_bump_is_the_cpus() {
    let Some(device) = Device::open("every_bump_is_the_cpus") else {
        return;
    };
    let errors = errors(&device, None);
    for (name, bound, all) in &errors {
        let [normal, tangent, softened, factor] = all;
        println!(
            "{name:42} {normal:.1e} {tangent:.1e} of {bound:.0e}, {softened:.1e} {factor:.1e}"
        );
    }
    let wrong: Vec<_> = errors.iter().filter(|e| is_wrong(&device, e)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn planted_faults_of_bumps_are_found() {
    let Some(device) = Device::open("planted_faults_of_bumps_are_found") else {
        return;
    };
    let fault = |module, from, to| Fault { module, from, to };
    for (fault, shown_by) in [
        (
            fault(
                "bump",
                "partials.along_u * wanted.x",
                "partials.along_v * wanted.x",
            ),
            "noise on sphere",
        ),
        (
            fault("bump", "2.0 * values[0]", "1.9 * values[0]"),
            "normal map on disk",
        ),
        (
            fault("bump", "0.125 *", "0.12 *"),
            "normal map, faded on bare mesh",
        ),
        (
            fault("partials", "(0.5 * turn)", "turn"),
            "ramp on sphere, placed",
        ),
        (
            fault("partials", "rows.x - along", "rows.y - along"),
            "noise on bent mesh",
        ),
        (
            fault(
                "partials",
                "cross(ns, tangent) * side",
                "cross(ns, tangent)",
            ),
            "normal map on mesh with tangents",
        ),
    ] {
        let errors = errors(&device, Some(fault));
        let wrong: Vec<&str> = errors
            .iter()
            .filter(|e| is_wrong(&device, e))
            .map(|e| e.0.as_str())
            .collect();
        assert!(wrong.contains(&shown_by), "{fault:?}: wrong are {wrong:?}");
    }
}
