//! Textures and bump maps on the GPU against those of the CPU.
//!
//! Errors are in ulps of the texture's largest value, divided by the largest coordinate of the place
//! where that is above 1: rounding of coordinates grows with them. Where a texture jumps (checks, dots,
//! thresholds, nearest pixels), rounding may put a place on the other side: such a value counts as
//! right where the CPU has it within 4 ulps of the coordinates, and few may need that.
//!
//! Where no GPU is found, the tests say that they are skipped; `SPECULA_GPU=require` makes that a
//! failure.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "tests say what they found, and stop where something is missing"
)]

mod bumps;
#[path = "../common/mod.rs"]
mod common;
mod device;
mod nodes;
mod normal_maps;

use specula_render::{PreparedScene, RenderOptions, TextureFootprint, TexturePoint};
use specula_stat::Rng;

use device::{Device, Fault, Shader};
use nodes::Node;

/// How many places.
const PLACES: usize = 2048;

/// Share of places that may need their coordinates moved.
const MOST_MOVED: f64 = 0.005;

/// The kernel: every texture at every place.
const KERNEL: &str = "
@group(0) @binding(0) var<storage, read> places: array<f32>;
@group(0) @binding(4) var<storage, read_write> results: array<f32>;

fn three(at: u32) -> vec3f {
    return vec3f(places[at], places[at + 1u], places[at + 2u]);
}

fn four(at: u32) -> vec4f {
    return vec4f(three(at), places[at + 3u]);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let at = 27u * id.x;
    let uv = vec2f(places[at], places[at + 1u]);
    let second_uv = vec2f(places[at + 2u], places[at + 3u]);
    let footprint = Footprint(three(at + 13u), three(at + 16u), four(at + 19u), four(at + 23u));
    let place = TextureCoordinates(uv, second_uv, three(at + 4u), three(at + 7u), three(at + 10u), footprint);
    let c = texture_colour(id.y, place);
    let to = 3u * (id.x + id.y * arrayLength(&places) / 27u);
    results[to] = c.x;
    results[to + 1u] = c.y;
    results[to + 2u] = c.z;
}
";

/// Coordinates, second coordinates, position, normal, colour; of a footprint two half axes, then how much coordinates
/// and second coordinates change along each.
type TextureCoordinates = [f32; 27];

/// Where the footprint begins.
const FOOTPRINT: usize = 13;

/// A random number in `[0, 1)`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the nearest number of single precision is meant"
)]
fn uniform(rng: &mut Rng) -> f32 {
    rng.uniform_f32() as f32
}

/// Places: near the origin, then farther away, then some where everything is a whole number.
fn places() -> Vec<TextureCoordinates> {
    let mut rng = Rng::from_name("textures");
    (0..PLACES)
        .map(|i| {
            let reach = if i % 4 == 3 { 40.0 } else { 3.0 };
            let mut place: TextureCoordinates =
                std::array::from_fn(|_| reach * (2.0 * uniform(&mut rng) - 1.0));
            if i % 32 == 31 {
                place = place.map(f32::round);
            }
            let normal = std::array::from_fn(|_| 2.0 * uniform(&mut rng) - 1.0);
            place[7..10].copy_from_slice(&unit(normal));
            for colour in &mut place[10..FOOTPRINT] {
                *colour = uniform(&mut rng);
            }
            // From a hundredth of a pixel to whole pictures, and points.
            let size = if i % 16 == 15 {
                0.0
            } else {
                (10.0 * uniform(&mut rng) - 10.0).exp2()
            };
            for part in &mut place[FOOTPRINT..] {
                *part = size * (2.0 * uniform(&mut rng) - 1.0);
            }
            place
        })
        .collect()
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let size = v.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-3);
    v.map(|x| x / size)
}

/// A texture's value on the CPU.
fn value(scene: &PreparedScene, texture: usize, place: &TextureCoordinates) -> [f32; 3] {
    let two = |i: usize| [place[i], place[i + 1]];
    let three = |i: usize| [place[i], place[i + 1], place[i + 2]];
    let at = TexturePoint {
        uv: [place[0], place[1]],
        second_uv: [place[2], place[3]],
        position: three(4),
        normal: three(7),
        colour: three(10),
        footprint: Some(TextureFootprint {
            axes: [three(13), three(16)],
            uv: [two(19), two(21)],
            second_uv: [two(23), two(25)],
        }),
    };
    scene.texture_value(texture, &at)
}

/// What a texture's values differ by.
#[derive(Debug, Default)]
struct Difference {
    /// Largest error of the values that need no moved coordinates.
    ulps: f64,
    /// How many values are the CPU's at coordinates a few ulps away only.
    moved: usize,
    /// A place with a value that the CPU has nowhere near.
    wrong: Option<(TextureCoordinates, [f32; 3], [f32; 3])>,
}

fn compare(scene: &PreparedScene, texture: usize, bound: f64, found: &[f32]) -> Difference {
    let places = places();
    let cpu: Vec<[f32; 3]> = places
        .iter()
        .map(|place| value(scene, texture, place))
        .collect();
    let largest = cpu.iter().flatten().fold(0.0_f32, |m, v| m.max(v.abs()));
    let ulp = f64::from(largest * f32::EPSILON).max(f64::MIN_POSITIVE);
    let error = |place: &TextureCoordinates, gpu: &[f32], cpu: &[f32; 3]| {
        let apart = gpu.iter().zip(cpu).map(|(g, c)| (g - c).abs());
        let error = f64::from(apart.fold(0.0, f32::max)) / ulp;
        // NaN is no small error.
        if gpu.iter().all(|g| g.is_finite()) {
            error / f64::from(reach(place))
        } else {
            f64::INFINITY
        }
    };
    let mut difference = Difference::default();
    for ((place, gpu), cpu) in places.iter().zip(found.chunks(3)).zip(&cpu) {
        let here = error(place, gpu, cpu);
        if here <= bound {
            difference.ulps = difference.ulps.max(here);
            continue;
        }
        difference.moved += 1;
        let near =
            |there: TextureCoordinates| error(place, gpu, &value(scene, texture, &there)) <= bound;
        if !moved(place).any(near) && difference.wrong.is_none() {
            difference.wrong = Some((*place, [gpu[0], gpu[1], gpu[2]], *cpu));
        }
    }
    difference
}

/// The largest coordinate, at least 1.
fn reach(place: &TextureCoordinates) -> f32 {
    place[..7].iter().fold(1.0_f32, |m, x| m.max(x.abs()))
}

/// Places a few ulps of the coordinates away.
fn moved(place: &TextureCoordinates) -> impl Iterator<Item = TextureCoordinates> {
    let mut rng = Rng::from_name("moved");
    let place = *place;
    let reach = reach(&place);
    (0..64).map(move |_| {
        let mut there = place;
        for x in &mut there[..10] {
            *x += 4.0 * reach * f32::EPSILON * (2.0 * uniform(&mut rng) - 1.0);
        }
        there
    })
}

fn prepared(nodes: &[Node]) -> PreparedScene {
    PreparedScene::consume(nodes::scene(nodes), &RenderOptions::default()).unwrap()
}

/// Values of every texture at every place.
fn on_device(
    device: &Device,
    scene: &PreparedScene,
    count: usize,
    fault: Option<Fault>,
) -> Vec<f32> {
    let places = places();
    let shader = Shader {
        kernel: KERNEL,
        modules: &device::TEXTURES,
        fault,
    };
    let groups = [PLACES / 64, count, 1].map(|n| u32::try_from(n).unwrap());
    device.run(
        scene,
        &shader,
        places.as_flattened(),
        3 * PLACES * count,
        groups,
    )
}

#[test]
fn every_texture_is_the_cpus() {
    let Some(device) = Device::open("every_texture_is_the_cpus") else {
        return;
    };
    let nodes = nodes::all();
    let scene = prepared(&nodes);
    assert_eq!(
        scene
            .flatten()
            .missing
            .iter()
            .filter(|m| m.contains("textures that"))
            .count(),
        0
    );
    let found = on_device(&device, &scene, nodes.len(), None);
    let mut wrong = Vec::new();
    for (i, (node, found)) in nodes.iter().zip(found.chunks(3 * PLACES)).enumerate() {
        let difference = compare(&scene, i, node.bound, found);
        println!(
            "{:36} {:8.1} ulps of {:6}, {:3} moved",
            node.name, difference.ulps, node.bound, difference.moved
        );
        let share = difference.moved as f64 / PLACES as f64;
        if difference.wrong.is_some() || share > MOST_MOVED {
            wrong.push((node.name.clone(), difference));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// One wrong token of a shader, and the texture that shows it.
#[test]
fn planted_faults_are_found() {
    let Some(device) = Device::open("planted_faults_are_found") else {
        return;
    };
    let nodes = nodes::all();
    let scene = prepared(&nodes);
    for (fault, shown_by) in nodes::FAULTS {
        let found = on_device(&device, &scene, nodes.len(), Some(fault));
        let wrong: Vec<&str> = nodes
            .iter()
            .zip(found.chunks(3 * PLACES))
            .enumerate()
            .filter(|(i, (node, found))| compare(&scene, *i, node.bound, found).wrong.is_some())
            .map(|(_, (node, _))| node.name.as_str())
            .collect();
        assert!(wrong.contains(&shown_by), "{fault:?}: wrong are {wrong:?}");
    }
}

/// Shaders without the parts that a scene does not need: no textures, no inputs, no noise.
#[test]
fn what_a_scene_lacks_is_left_out() {
    let Some(device) = Device::open("what_a_scene_lacks_is_left_out") else {
        return;
    };
    let leaves = nodes::leaves();
    for nodes in [&leaves[..], &leaves[..1], &[]] {
        let scene = prepared(nodes);
        let found = on_device(&device, &scene, nodes.len().max(1), None);
        for (i, (node, found)) in nodes.iter().zip(found.chunks(3 * PLACES)).enumerate() {
            let difference = compare(&scene, i, node.bound, found);
            assert!(difference.wrong.is_none(), "{}: {difference:?}", node.name);
        }
    }
}

#[test]
fn too_deep_graphs_are_named() {
    let missing = |depth| prepared(&nodes::nested(depth)).flatten().missing;
    let named = |depth| {
        missing(depth)
            .iter()
            .any(|m| m.contains("nested more than 32 deep"))
    };
    assert!(!named(32));
    assert!(named(33));
}
