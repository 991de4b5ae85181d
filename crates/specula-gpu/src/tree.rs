//! The bounding volume hierarchy as shaders traverse it: small nodes, triangles that are read as vectors.
//!
//! Made from the processor's tree, child by child; only packets, here without empty lanes, have other indices. A node of
//! the processor's is 256 bytes in 56 words that a GPU would load one by one; of these, 96 bytes in 6 loads (Ylitie,
//! Karras and Laine 2017, with the children's references stored instead of computed).

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;
use specula_render::FlatScene;

/// The kind of a reference to a packet, in its two highest bits.
const PACKET: u32 = 1;
/// Bits of the index in a reference.
const INDEX: u32 = (1 << 30) - 1;
/// Words of a placement, the first of which refers to its group's root.
const PLACEMENT: usize = 15;

/// Children of a node, triangles of a packet.
const WIDTH: usize = 8;
/// The most steps that a box's planes are apart, less one on either side for margins.
const STEPS: f32 = 253.0;
/// Steps by which a box is larger than what it holds: far more than the rounding of the shader's planes.
const MARGIN: f64 = 1.0 / 1024.0;
/// A step is no smaller than this part of the node's coordinates, so that planes differ from their origin.
const FINEST: f32 = 1.0 / (1 << 20) as f32;

/// A node of the processor's tree: `min x, max x, min y, max y, min z, max z` of its children, and the children.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Wide {
    bounds: [[f32; WIDTH]; 6],
    children: [u32; WIDTH],
    unused: [u32; WIDTH],
}

/// A packet of the processor's: corners by axis and triangle, and the triangles' indices.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Packet {
    corners: [[[f32; WIDTH]; 3]; 3],
    primitives: [u32; WIDTH],
}

/// A node: 6 vectors of 32-bit words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct Node {
    /// Corner from which planes are counted.
    origin: [f32; 3],
    /// Exponents of a step along x, y and z, a byte each, and a bit for each child that is there.
    head: u32,
    /// Planes of the children in steps: low x, y, z, high x, y, z.
    planes: [[u8; WIDTH]; 6],
    /// References as the processor's, by slots: bit 0 of a slot is set on the side of greater x, bit 1 y, bit 2 z.
    children: [u32; WIDTH],
}

/// A triangle: 3 vectors of 32-bit words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct Triangle {
    first: [f32; 3],
    primitive: u32,
    second: [f32; 3],
    /// 1 in the last triangle of a packet.
    is_last: u32,
    third: [f32; 3],
    unused: u32,
}

/// The tree of a scene for shaders: what `world_nodes` and `world_triangles` hold.
#[derive(Clone, Debug)]
pub struct Tree {
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
}

impl Tree {
    /// Converts the tree of a scene, and turns the scene's references to packets into those of this tree.
    #[must_use]
    pub fn new(scene: &mut FlatScene<'_>) -> Self {
        let nodes: &[Wide] = bytemuck::cast_slice(scene.nodes);
        let packets: &[Packet] = bytemuck::cast_slice(scene.packets);
        let mut first = Vec::with_capacity(packets.len());
        let mut count = 0;
        for packet in packets {
            first.push(count);
            count += packet.last() + 1;
        }
        let moved = |reference: u32| match reference >> 30 {
            PACKET => PACKET << 30 | first[(reference & INDEX) as usize],
            _ => reference,
        };
        let nodes = nodes
            .par_iter()
            .map(|node| Node::new(node, moved))
            .collect();
        let triangles = packets.par_iter().flat_map_iter(Packet::triangles);
        let triangles = triangles.collect();
        for (name, root) in &mut scene.constants {
            if *name == "TREE_ROOT" {
                *root = moved(*root);
            }
        }
        let find = |name| scene.constant(name).unwrap_or(0) as usize;
        let (begin, count) = (find("PLACEMENTS"), find("PLACEMENT_COUNT"));
        let placements = &mut scene.words[begin..begin + PLACEMENT * count];
        for placement in placements.chunks_exact_mut(PLACEMENT) {
            placement[0] = moved(placement[0]);
        }
        Self { nodes, triangles }
    }

    /// The nodes, 96 bytes each.
    #[must_use]
    pub fn nodes(&self) -> &[u8] {
        bytemuck::cast_slice(&self.nodes)
    }

    /// The triangles, 48 bytes each.
    #[must_use]
    pub fn triangles(&self) -> &[u8] {
        bytemuck::cast_slice(&self.triangles)
    }

    /// Entries that a ray's traversal needs on its stack: of each level of the trees over instances and within them, and
    /// one to leave an instance.
    ///
    /// * `depth`: levels of the deepest tree.
    #[must_use]
    pub fn stack_size(depth: u32) -> u32 {
        2 * depth + 2
    }
}

impl Node {
    /// * `moved`: from a reference of the processor's tree to one of this tree.
    fn new(wide: &Wide, moved: impl Fn(u32) -> u32) -> Self {
        let [low_x, high_x] = [&wide.bounds[0], &wide.bounds[1]];
        let occupied: Vec<usize> = (0..WIDTH).filter(|&i| low_x[i] <= high_x[i]).collect();
        let mut node = Self::default();
        if occupied.is_empty() {
            return node;
        }
        let mut centres = [[0.0; 3]; WIDTH];
        let mut middle = [0.0; 3];
        let mut grids = [Grid::default(); 3];
        for axis in 0..3 {
            let [low, high] = [&wide.bounds[2 * axis], &wide.bounds[2 * axis + 1]];
            let least = occupied
                .iter()
                .map(|&i| low[i])
                .fold(f32::INFINITY, f32::min);
            let most = occupied
                .iter()
                .map(|&i| high[i])
                .fold(f32::NEG_INFINITY, f32::max);
            grids[axis] = Grid::new(least, most);
            middle[axis] = 0.5 * (f64::from(least) + f64::from(most));
            for &i in &occupied {
                centres[i][axis] = 0.5 * (f64::from(low[i]) + f64::from(high[i]));
            }
            node.origin[axis] = grids[axis].origin;
            node.head |= grids[axis].exponent << (8 * axis);
        }
        for (child, slot) in slots(&occupied, &centres, middle) {
            node.head |= 1 << (24 + slot);
            node.children[slot] = moved(wide.children[child]);
            for (axis, grid) in grids.iter().enumerate() {
                let [low, high] = [0, 1].map(|side| wide.bounds[2 * axis + side][child]);
                let [low, high] = grid.planes(low, high);
                node.planes[axis][slot] = low;
                node.planes[3 + axis][slot] = high;
            }
        }
        node
    }
}

/// Each child with its slot: a child on the side of greater x, y or z in a slot with that bit, as far as slots are free.
fn slots(occupied: &[usize], centres: &[[f64; 3]; WIDTH], middle: [f64; 3]) -> Vec<(usize, usize)> {
    let along = |child: usize, slot: usize| -> f64 {
        let signed = |axis: usize| {
            let offset = centres[child][axis] - middle[axis];
            if slot >> axis & 1 == 1 {
                offset
            } else {
                -offset
            }
        };
        signed(0) + signed(1) + signed(2)
    };
    let mut pairs: Vec<(f64, usize, usize)> = occupied
        .iter()
        .flat_map(|&child| (0..WIDTH).map(move |slot| (child, slot)))
        .map(|(child, slot)| (along(child, slot), child, slot))
        .collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut placed, mut taken) = ([false; WIDTH], [false; WIDTH]);
    let mut found = Vec::with_capacity(occupied.len());
    for (_, child, slot) in pairs {
        if !placed[child] && !taken[slot] {
            (placed[child], taken[slot]) = (true, true);
            found.push((child, slot));
        }
    }
    found
}

/// The planes along an axis that boxes of a node can have: `origin + i 2^(exponent - 127)`, `i` from 0 to 255.
#[derive(Clone, Copy, Debug, Default)]
struct Grid {
    origin: f32,
    exponent: u32,
}

impl Grid {
    /// A grid that holds all between two coordinates, with a step left on either side.
    fn new(least: f32, most: f32) -> Self {
        let size = least.abs().max(most.abs());
        let coarse = ((most - least) / STEPS).max(size * FINEST);
        let step = coarse.max(f32::MIN_POSITIVE);
        // Rounded up to a power of two.
        let exponent = (step.to_bits() + 0x7f_ffff) >> 23;
        let step = f32::from_bits(exponent << 23);
        Self {
            origin: least - step,
            exponent,
        }
    }

    /// The planes about a box.
    fn planes(self, low: f32, high: f32) -> [u8; 2] {
        let step = f64::from(f32::from_bits(self.exponent << 23));
        let steps = |x: f32| (f64::from(x) - f64::from(self.origin)) / step;
        let whole = |x: f64| {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a whole number of 0 to 255"
            )]
            let plane = x.clamp(0.0, 255.0) as u8;
            plane
        };
        [
            whole((steps(low) - MARGIN).floor()),
            whole((steps(high) + MARGIN).ceil()),
        ]
    }
}

impl Packet {
    fn corner(&self, lane: usize, i: usize) -> [f32; 3] {
        [0, 1, 2].map(|axis| self.corners[i][axis][lane])
    }

    /// The last lane that holds a triangle; empty lanes hold a point.
    fn last(&self) -> u32 {
        let is_triangle = |lane: &u32| {
            let [a, b, c] = [0, 1, 2].map(|i| self.corner(*lane as usize, i));
            a != b || b != c
        };
        (0..8).rev().find(is_triangle).unwrap_or(0)
    }

    fn triangles(&self) -> impl Iterator<Item = Triangle> {
        let last = self.last();
        (0..=last).map(move |lane| {
            let place = lane as usize;
            Triangle {
                first: self.corner(place, 0),
                primitive: self.primitives[place],
                second: self.corner(place, 1),
                is_last: u32::from(lane == last),
                third: self.corner(place, 2),
                unused: 0,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_hold_their_boxes() {
        for (least, most) in [
            (0.0, 1.0),
            (-3.0, 5.5),
            (7.0, 7.0),
            (0.0, 0.0),
            (1e15, 1.001e15),
            (-2e-20, 1e-20),
            (-1e15, 1e15),
            (12345.678, 12345.68),
        ] {
            let grid = Grid::new(least, most);
            let step = f64::from(f32::from_bits(grid.exponent << 23));
            let at = |plane: u8| f64::from(grid.origin) + f64::from(plane) * step;
            for i in 0..=32_u8 {
                let x = least + (most - least) * (f32::from(i) / 32.0);
                let [low, high] = grid.planes(x, x);
                let x = f64::from(x);
                assert!(at(low) < x && x < at(high), "{x} in {least} to {most}");
                assert!(x - at(low) <= 1.01 * step && at(high) - x <= 1.01 * step);
            }
            let size = f64::from(most.abs().max(least.abs()));
            let fair = f64::from(most - least) / 120.0 + size * 2e-6 + 1e-37;
            assert!(step <= fair, "{step} of {least} to {most}");
        }
    }

    /// A node with these boxes, `[min, max]` of each.
    fn wide(boxes: &[[[f32; 3]; 2]]) -> Wide {
        let mut wide = Wide::zeroed();
        for axis in 0..3 {
            wide.bounds[2 * axis] = [f32::INFINITY; WIDTH];
            wide.bounds[2 * axis + 1] = [f32::NEG_INFINITY; WIDTH];
        }
        for (i, bounds) in boxes.iter().enumerate() {
            for (side, corner) in bounds.iter().enumerate() {
                for (axis, x) in corner.iter().enumerate() {
                    wide.bounds[2 * axis + side][i] = *x;
                }
            }
            wide.children[i] = 100 + u32::try_from(i).unwrap();
        }
        wide
    }

    #[test]
    fn children_are_in_the_slots_of_their_octants() {
        let boxes: Vec<[[f32; 3]; 2]> = (0..8)
            .map(|i: u8| {
                let low = [i & 1, i >> 1 & 1, i >> 2].map(|bit| 2.0 * f32::from(bit));
                [low, low.map(|x| x + 1.0)]
            })
            .collect();
        let node = Node::new(&wide(&boxes), |r| r);
        assert_eq!(node.head >> 24, 0xff);
        assert_eq!(node.children, [100, 101, 102, 103, 104, 105, 106, 107]);
    }

    #[test]
    fn nodes_hold_the_boxes_of_all_children() {
        let boxes = [
            [[0.0, 0.0, 0.0], [1.0, 0.1, 0.3]],
            [[0.5, -2.0, 0.0], [0.5, 4.0, 0.0]],
            [[-7.0, 0.2, 0.1], [3.0, 0.2, 0.4]],
        ];
        let node = Node::new(&wide(&boxes), |r| r);
        assert_eq!((node.head >> 24).count_ones(), 3);
        for slot in (0..WIDTH).filter(|slot| node.head >> (24 + slot) & 1 == 1) {
            let [low, high] = boxes[node.children[slot] as usize - 100];
            for (axis, (low, high)) in low.into_iter().zip(high).enumerate() {
                let exponent = node.head >> (8 * axis) & 0xff;
                let step = f32::from_bits(exponent << 23);
                let plane = |i: usize| node.origin[axis] + f32::from(node.planes[i][slot]) * step;
                assert!(plane(axis) < low && plane(3 + axis) > high);
            }
        }
        assert_eq!(Node::new(&wide(&[]), |r| r), Node::default());
    }

    #[test]
    fn packets_end_with_their_last_triangle() {
        let mut packet = Packet::zeroed();
        packet.primitives = [7, 9, 0, 0, 0, 0, 0, 0];
        packet.corners[1][0][..2].fill(1.0);
        packet.corners[2][1][..2].fill(2.0);
        let found: Vec<Triangle> = packet.triangles().collect();
        assert_eq!(found.iter().map(|t| t.is_last).collect::<Vec<_>>(), [0, 1]);
        let second = found[1];
        let corners = (second.first, second.second, second.third);
        assert_eq!(corners, ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]));
        assert_eq!(second.primitive, 9);
        let empty: Vec<Triangle> = Packet::zeroed().triangles().collect();
        assert_eq!((empty.len(), empty[0].is_last), (1, 1));
    }

    #[cfg(feature = "device")]
    mod edges {
        /// What a fused product and sum is, where software rounds twice: the product's rounding error by Dekker's splitting.
        const FUSED: &str = "
fn halves(x: f32) -> vec2f {
    let high = bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
    return vec2f(high, x - high);
}

fn fused(a: f32, b: f32, c: f32) -> f32 {
    let p = a * b;
    let x = halves(a);
    let y = halves(b);
    let error = ((x.x * y.x - p) + x.x * y.y + x.y * y.x) + x.y * y.y;
    let sum = p + c;
    let rest = (p - (sum - (sum - p))) + (c - (sum - p));
    return sum + (error + rest);
}
";

        const EDGES: &str = "
@group(0) @binding(0) var<storage, read> points: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> edges: array<vec4f>;

@compute @workgroup_size(64)
fn edges_main(@builtin(global_invocation_id) id: vec3u) {
    let p = points[id.x];
    let a = vec3f(p.xy, 0.0);
    let b = vec3f(p.zw, 0.0);
    edges[id.x] = vec4f(traverse_edge(a, b), traverse_edge(b, a), traverse_edge(a, a), naive(a, b) + naive(b, a));
}
";

        /// Whether edges of random points have exact signs on a GPU that fuses, and whether a formula would have them that
        /// leaves the fusing to the compiler.
        fn signs(gpu: &crate::Gpu) -> [bool; 2] {
            let module = include_str!("../wgsl/traverse.wgsl");
            let begin = module.find("fn traverse_edge").unwrap();
            let end = begin + module[begin..].find("\n}").unwrap() + 2;
            let edge = module[begin..end].replace("fma(", "fused(");
            assert_eq!(edge.matches("fused(").count(), 2);
            let naive =
                "fn naive(a: vec3f, b: vec3f) -> f32 { return fused(a.x, b.y, -(a.y * b.x)); }\n";
            let text = format!("{FUSED}{edge}\n{naive}{EDGES}");
            let shader = gpu.shader("edges", &text).unwrap();
            let kernel = crate::ComputeKernel::new(gpu, &shader, "edges_main", 1).unwrap();
            let mut stream = specula_bsdf::math::Stream::new(1);
            let mut point = || -> [f32; 4] { [(); 4].map(|()| 2.0 * stream.next::<f32>() - 1.0) };
            let points: Vec<[f32; 4]> = (0..4096).map(|_| point()).collect();
            let size = 16 * points.len() as u64;
            let arrays = kernel
                .upload(gpu, &[bytemuck::cast_slice(&points)], size)
                .unwrap();
            kernel.run(gpu, &arrays, [64, 1, 1]).unwrap();
            let edges: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&arrays.output(gpu).unwrap());
            let holds = points.iter().zip(&edges).all(|(p, e)| {
                let [ax, ay, bx, by] = p.map(f64::from);
                let exact = ax * by - ay * bx;
                let is_right = |got: f32, sign: f64| f64::from(got) * sign > 0.0 || exact == 0.0;
                is_right(e[0], exact) && is_right(e[1], -exact) && e[2] == 0.0
            });
            [holds, edges.iter().all(|e| e[3] == 0.0)]
        }

        #[test]
        fn edges_have_exact_signs_where_products_fuse() {
            let Some(gpu) = crate::common::gpu("edges of triangles") else {
                return;
            };
            assert_eq!(signs(gpu), [true, false]);
        }
    }
}
