//! What 32 threads in lockstep execute while they traverse the tree for shaders: the divergence of rays, by counting.
//!
//! `cargo bench -p specula-gpu --bench warps -- scene.xml...`. Each ray's steps are those of `traverse.wgsl`; the loops
//! differ in when the threads of a warp wait for each other. Figures are in docs/decisions/gpu-tree.md.
#![allow(clippy::print_stdout, reason = "a bench reports on standard output")]

use std::array;
use std::path::Path;

use bytemuck::{Pod, Zeroable};
use specula_bsdf::math::Stream;
use specula_gpu::Tree;
use specula_render::{FlatGroup, FlatInstance, FlatScene, PreparedScene, RenderOptions};

/// Threads in lockstep.
const WARP: usize = 32;
/// Warps of rays of a kind.
const WARPS: usize = 2000;
/// Operations of a node, a triangle, a sphere or disk, an instance, and of finding the next child: counted in traverse.wgsl.
const NODE: u64 = 230;
const TRIANGLE: u64 = 60;
const QUADRIC: u64 = 70;
const INSTANCE: u64 = 70;
const NEXT: u64 = 20;

type Error = Box<dyn std::error::Error>;

/// A node of the tree for shaders.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Node {
    origin: [f32; 3],
    head: u32,
    planes: [[u8; 8]; 6],
    children: [u32; 8],
}

/// A triangle of the tree for shaders.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Triangle {
    first: [f32; 3],
    primitive: u32,
    second: [f32; 3],
    is_last: u32,
    third: [f32; 3],
    unused: u32,
}

/// What a ray does next.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    Node,
    /// So many triangles.
    Packet(u64),
    Quadric,
    Instance,
}

#[derive(Clone, Copy)]
struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
}

/// The arrays that shaders read.
struct World<'a> {
    nodes: &'a [Node],
    triangles: &'a [Triangle],
    words: &'a [u32],
    root: u32,
    quadrics: usize,
    placements: usize,
}

fn main() -> Result<(), Error> {
    println!(
        "| scene | rays | operations of a ray alone | in lockstep, a step a turn | node loop within | node, then a packet \
         | node, then two triangles |\n|---|---|---|---|---|---|---|"
    );
    for argument in std::env::args().skip(1).filter(|a| !a.starts_with("--")) {
        report(Path::new(&argument))?;
    }
    Ok(())
}

fn report(file: &Path) -> Result<(), Error> {
    let scene = specula_scene::load(file)?.scene;
    let prepared = PreparedScene::new(&scene, &RenderOptions::from_scene(&scene))?;
    let mut flat = prepared.flatten();
    let tree = Tree::new(&mut flat);
    let world = World::new(&flat, &tree);
    let (groups, instances) = prepared.groups();
    let mut stream = Stream::new(1);
    let mut points = || point(&groups, &instances, &mut stream);
    let random: Vec<Ray> = (0..WARP * WARPS)
        .map(|_| between(points(), points()))
        .collect();
    // Neighbours begin at one point and end near each other.
    let fans = (0..WARPS).flat_map(|_| fan(points(), points()));
    let fans: Vec<Ray> = fans.collect();
    let name = file
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    for (kind, rays) in [("between random points", random), ("fans", fans)] {
        for any in [false, true] {
            let steps: Vec<Vec<Step>> = rays.iter().map(|ray| world.steps(*ray, any)).collect();
            let alone: u64 = steps.iter().map(|s| cost_alone(s)).sum();
            let loops = [one_step, node_loop_within, turns::<8>, turns::<2>];
            let costs = loops.map(|cost| {
                let warps = steps.chunks(WARP).map(cost);
                WARP as u64 * warps.sum::<u64>()
            });
            let per_ray = |cost: u64| cost as f64 / rays.len() as f64;
            let share = |i: usize| costs[i] as f64 / costs[0] as f64;
            println!(
                "| {name} | {kind}, {} | {:.0} | {:.0} | {:.2} | {:.2} | {:.2} |",
                if any { "any hit" } else { "first hits" },
                per_ray(alone),
                per_ray(costs[0]),
                share(1),
                share(2),
                share(3),
            );
        }
    }
    Ok(())
}

fn cost_of(step: Step) -> u64 {
    NEXT + match step {
        Step::Node => NODE,
        Step::Packet(triangles) => triangles * TRIANGLE,
        Step::Quadric => QUADRIC,
        Step::Instance => INSTANCE,
    }
}

/// Operations of one ray.
fn cost_alone(steps: &[Step]) -> u64 {
    steps.iter().map(|step| cost_of(*step)).sum()
}

/// Operations where a step of each ray is one turn of a loop: the kinds of steps take their turns.
fn one_step(warp: &[Vec<Step>]) -> u64 {
    let longest = warp.iter().map(Vec::len).max().unwrap_or(0);
    let turn = |i: usize| NEXT + kinds(warp.iter().filter_map(|steps| steps.get(i)));
    (0..longest).map(turn).sum()
}

/// Operations where a turn of the loop is a node, and then so many triangles of a packet at most, or another step.
fn turns<const AT_ONCE: u64>(warp: &[Vec<Step>]) -> u64 {
    let cut = |step: &Step| match *step {
        Step::Packet(count) => (0..count.div_ceil(AT_ONCE))
            .map(|part| Step::Packet(AT_ONCE.min(count - part * AT_ONCE)))
            .collect(),
        step => vec![step],
    };
    let cut = warp
        .iter()
        .map(|steps| steps.iter().flat_map(cut).collect());
    let mut rest: Vec<Vec<Step>> = cut.collect();
    rest.iter_mut().for_each(|steps| steps.reverse());
    let mut cost = 0;
    while rest.iter().any(|steps| !steps.is_empty()) {
        let is_node = |step: &mut Step| *step == Step::Node;
        let nodes: Vec<_> = rest.iter_mut().filter_map(|s| s.pop_if(is_node)).collect();
        let others = rest
            .iter_mut()
            .filter_map(|s| s.pop_if(|step| !is_node(step)));
        let others: Vec<_> = others.collect();
        for taken in [&nodes, &others] {
            cost += kinds(taken.iter()) + if taken.is_empty() { 0 } else { NEXT };
        }
    }
    cost
}

/// Operations of the kinds of steps that some ray takes.
fn kinds<'s>(steps: impl Iterator<Item = &'s Step>) -> u64 {
    let mut costs = [0; 4];
    for step in steps {
        let place = match step {
            Step::Node => 0,
            Step::Packet(_) => 1,
            Step::Quadric => 2,
            Step::Instance => 3,
        };
        costs[place] = costs[place].max(cost_of(*step) - NEXT);
    }
    costs.iter().sum()
}

/// Operations where rays go through nodes in a loop of its own, until each has something else to do.
fn node_loop_within(warp: &[Vec<Step>]) -> u64 {
    let mut rest: Vec<&[Step]> = warp.iter().map(Vec::as_slice).collect();
    let mut cost = 0;
    while rest.iter().any(|steps| !steps.is_empty()) {
        let nodes = |steps: &&[Step]| steps.iter().take_while(|s| **s == Step::Node).count();
        let most = rest.iter().map(nodes).max().unwrap_or(0);
        cost += most as u64 * (NODE + NEXT);
        for steps in &mut rest {
            *steps = &steps[nodes(steps)..];
        }
        if rest.iter().any(|steps| !steps.is_empty()) {
            cost += NEXT + kinds(rest.iter().filter_map(|steps| steps.first()));
        }
        for steps in &mut rest {
            *steps = steps.get(1..).unwrap_or_default();
        }
    }
    cost
}

impl<'a> World<'a> {
    fn new(flat: &'a FlatScene<'_>, tree: &'a Tree) -> Self {
        let constant = |name| flat.constant(name).unwrap_or(0);
        Self {
            nodes: bytemuck::cast_slice(tree.nodes()),
            triangles: bytemuck::cast_slice(tree.triangles()),
            words: &flat.words,
            root: constant("TREE_ROOT"),
            quadrics: constant("QUADRICS") as usize,
            placements: constant("PLACEMENTS") as usize,
        }
    }

    /// The steps of a ray, as `traverse` in traverse.wgsl takes them.
    fn steps(&self, ray: Ray, any: bool) -> Vec<Step> {
        let (mut steps, mut stack, mut frame) = (Vec::new(), Vec::new(), ray);
        let (mut current, mut node, mut rest, mut t) = (self.root, 0, 0_u32, f32::INFINITY);
        loop {
            let index = (current & 0x3fff_ffff) as usize;
            if matches!(current >> 30, 0 | 3) && rest != 0 {
                stack.push(Some((node, rest)));
                rest = 0;
            }
            match current >> 30 {
                0 => {
                    steps.push(Step::Node);
                    node = index;
                    rest = self.nodes[index].entered(frame, t);
                }
                1 => {
                    let last = self.triangles[index..].iter().position(|t| t.is_last != 0);
                    let packet = &self.triangles[index..=index + last.unwrap_or(0)];
                    steps.push(Step::Packet(packet.len() as u64));
                    t = packet.iter().filter_map(|p| p.hit(frame)).fold(t, f32::min);
                }
                2 => {
                    steps.push(Step::Quadric);
                    t = self.quadric(index, frame).map_or(t, |hit| t.min(hit));
                }
                _ => {
                    steps.push(Step::Instance);
                    let at = self.placements + 15 * index;
                    if self.words[at + 2] == 0 {
                        frame = self.moved(at + 3, ray);
                        stack.push(None);
                    }
                    current = self.words[at];
                    continue;
                }
            }
            if any && t < f32::INFINITY {
                return steps;
            }
            while rest == 0 {
                match stack.pop() {
                    None => return steps,
                    Some(None) => frame = ray,
                    Some(Some(entry)) => (node, rest) = entry,
                }
            }
            let slot = rest.trailing_zeros() ^ octant(frame);
            rest &= rest - 1;
            current = self.nodes[node].children[slot as usize];
        }
    }

    fn number(&self, at: usize) -> f32 {
        f32::from_bits(self.words[at])
    }

    /// A ray by an affine map in the words.
    fn moved(&self, at: usize, ray: Ray) -> Ray {
        let row = |i: usize, v: [f32; 3]| -> f32 {
            (0..3).map(|j| self.number(at + 4 * i + j) * v[j]).sum()
        };
        Ray {
            origin: array::from_fn(|i| row(i, ray.origin) + self.number(at + 4 * i + 3)),
            direction: array::from_fn(|i| row(i, ray.direction)),
        }
    }

    /// A sphere; a disk counts as one.
    fn quadric(&self, index: usize, ray: Ray) -> Option<f32> {
        let at = self.quadrics + 16 * index;
        let local = self.moved(at + 4, ray);
        let radius = self.number(at + 1);
        let [a, b, c] = [
            dot(local.direction, local.direction),
            dot(local.origin, local.direction),
            dot(local.origin, local.origin) - radius * radius,
        ];
        let root = (b * b - a * c).sqrt();
        [(-b - root) / a, (-b + root) / a]
            .into_iter()
            .find(|t| *t > 0.0)
    }
}

impl Node {
    /// The children whose boxes a ray enters before `end`, in its order.
    fn entered(&self, ray: Ray, end: f32) -> u32 {
        let mut mask = 0;
        for slot in (0..8_u32).filter(|slot| self.head >> (24 + slot) & 1 == 1) {
            let (mut first, mut last) = (0.0_f32, end);
            for axis in 0..3 {
                let step = f32::from_bits((self.head >> (8 * axis) & 0xff) << 23);
                let at = |side: usize| {
                    let plane = f32::from(self.planes[3 * side + axis][slot as usize]);
                    (self.origin[axis] + plane * step - ray.origin[axis]) / ray.direction[axis]
                };
                first = first.max(at(0).min(at(1)));
                last = last.min(at(0).max(at(1)));
            }
            if first <= last {
                mask |= 1 << (slot ^ octant(ray));
            }
        }
        mask
    }
}

impl Triangle {
    /// Where a ray hits it (Möller and Trumbore 1997).
    fn hit(&self, ray: Ray) -> Option<f32> {
        let [e1, e2] = [
            minus(self.second, self.first),
            minus(self.third, self.first),
        ];
        let p = cross(ray.direction, e2);
        let s = minus(ray.origin, self.first);
        let q = cross(s, e1);
        let scale = 1.0 / dot(e1, p);
        let [u, v, t] = [dot(s, p), dot(ray.direction, q), dot(e2, q)].map(|x| x * scale);
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    }
}

fn octant(ray: Ray) -> u32 {
    let bit = |i: usize| u32::from(ray.direction[i] < 0.0) << i;
    bit(0) | bit(1) | bit(2)
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    array::from_fn(|i| a[i] - b[i])
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    array::from_fn(|i| {
        let [j, k] = [(i + 1) % 3, (i + 2) % 3];
        a[j] * b[k] - a[k] * b[j]
    })
}

/// A ray from beside a point to another.
fn between(a: [f32; 3], b: [f32; 3]) -> Ray {
    let direction = minus(b, a);
    let origin = array::from_fn(|i| a[i] + 1e-3 * direction[(i + 1) % 3]);
    Ray { origin, direction }
}

/// A warp of rays from a point, to places about another, a hundredth of the way apart.
fn fan(a: [f32; 3], b: [f32; 3]) -> [Ray; WARP] {
    let middle = between(a, b);
    array::from_fn(|i| {
        let [x, y] = [i % 8, i / 8].map(|n| 0.01 * n as f32);
        let d = middle.direction;
        Ray {
            direction: array::from_fn(|j| d[j] + x * d[(j + 1) % 3] + y * d[(j + 2) % 3]),
            ..middle
        }
    })
}

/// A point of a triangle, or of a box about a sphere or disk, in the world.
fn point(groups: &[FlatGroup<'_>], instances: &[FlatInstance], stream: &mut Stream) -> [f32; 3] {
    let instance = &instances[below(instances.len(), stream)];
    let group = &groups[instance.group as usize];
    let at = below(group.triangles.len() + group.boxes.len(), stream);
    let [u, v, w]: [f32; 3] = [(); 3].map(|()| stream.next());
    let local: [f32; 3] = match group.triangles.get(at) {
        Some(triangle) => {
            let [a, b, c] = triangle.map(|corner| group.positions[corner as usize]);
            let weights = [1.0 - u.sqrt(), u.sqrt() * (1.0 - v), u.sqrt() * v];
            array::from_fn(|i| dot(weights, [a[i], b[i], c[i]]))
        }
        None => {
            let bounds = &group.boxes[at - group.triangles.len()];
            let share = [u, v, w];
            array::from_fn(|i| bounds.min[i] + share[i] * (bounds.max[i] - bounds.min[i]))
        }
    };
    let to_world = instance.to_world;
    to_world.map(|[x, y, z, d]| dot([x, y, z], local) + d)
}

fn below(count: usize, stream: &mut Stream) -> usize {
    let share: f64 = stream.next();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "below `count`"
    )]
    let place = (share * count as f64) as usize;
    place.min(count - 1)
}
