//! Rays per second, one thread: Specula's (AVX2 and portable) beside obvhs's own traversals.
//!
//! `cargo bench -p specula-render --bench rays`. Medians of alternating runs; about 30 s.
#![allow(clippy::print_stdout, reason = "a bench reports on standard output")]

use std::f32::consts::TAU;
use std::hint::black_box;
use std::time::{Duration, Instant};

use obvhs::BvhBuildParams;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::RayHit;
use obvhs::triangle::Triangle;
use specula_bsdf::{Frame, Vec3, math::vec3};
use specula_render::accel::{Accel, Group, Instance, Ray};

/// Side of the square picture of the primary rays: a million of them.
const SIDE: u16 = 1000;
/// Runs of each kind, of which the median counts.
const RUNS: usize = 5;

fn main() {
    let mesh = Mesh::scene();
    let start = Instant::now();
    let specula = mesh.accel();
    let built = start.elapsed();
    let stats = specula.stats();
    println!(
        "{} triangles; built in {:.2} s; {} nodes, {} packets, depth {}, {:.0} bytes per triangle",
        stats.triangles,
        built.as_secs_f64(),
        stats.nodes,
        stats.packets,
        stats.depth,
        f64::from(u32::try_from(stats.bytes).unwrap_or(u32::MAX))
            / f64::from(u32::try_from(stats.triangles).unwrap_or(u32::MAX)),
    );
    let rays = RaySets::new(&specula);
    let portable = specula.clone().portable();
    let (bvh2, bvh2_triangles) = mesh.bvh2();
    let (cwbvh, cwbvh_triangles) = mesh.cwbvh();
    let tracers: Vec<Tracer<'_>> = vec![
        Tracer {
            name: "specula, AVX2 where there is",
            closest: Box::new(|rays| count(rays, |ray| specula.intersect(ray).is_some())),
            any: Box::new(|rays| count(rays, |ray| specula.occluded(ray))),
        },
        Tracer {
            name: "specula, portable",
            closest: Box::new(|rays| count(rays, |ray| portable.intersect(ray).is_some())),
            any: Box::new(|rays| count(rays, |ray| portable.occluded(ray))),
        },
        Tracer {
            name: "obvhs CWBVH",
            closest: Box::new(|rays| {
                count(rays, |ray| {
                    let test = |ray: &_, id: usize| cwbvh_triangles[id].intersect(ray);
                    cwbvh.ray_traverse(theirs(ray), &mut RayHit::none(), test)
                })
            }),
            any: Box::new(|rays| {
                count(rays, |ray| {
                    let test = |ray: &_, id: usize| cwbvh_triangles[id].intersect(ray);
                    !cwbvh.ray_traverse_miss(theirs(ray), test)
                })
            }),
        },
        Tracer {
            name: "obvhs BVH2",
            closest: Box::new(|rays| {
                count(rays, |ray| {
                    let test = |ray: &_, id: usize| bvh2_triangles[id].intersect(ray);
                    bvh2.ray_traverse(theirs(ray), &mut RayHit::none(), test)
                })
            }),
            any: Box::new(|rays| {
                count(rays, |ray| {
                    let test = |ray: &_, id: usize| bvh2_triangles[id].intersect(ray);
                    !bvh2.ray_traverse_miss(theirs(ray), test)
                })
            }),
        },
    ];
    report(&tracers, &rays);
}

type Trace<'a> = Box<dyn Fn(&[Ray]) -> usize + 'a>;

/// An implementation of ray casting; its functions return how many hit.
pub(crate) struct Tracer<'a> {
    /// What to call it.
    pub(crate) name: &'a str,
    /// Computes the closest hits.
    pub(crate) closest: Trace<'a>,
    /// Tests for any hit.
    pub(crate) any: Trace<'a>,
}

/// Runs all tracers in turns and prints medians in Mrays/s, and the ratio of the first to each.
pub(crate) fn report(tracers: &[Tracer<'_>], rays: &RaySets) {
    let kinds = [&rays.primary, &rays.bounce, &rays.shadow];
    let mut times = vec![[const { Vec::new() }; 3]; tracers.len()];
    let mut hits = vec![[0; 3]; tracers.len()];
    for _ in 0..RUNS {
        for (t, tracer) in tracers.iter().enumerate() {
            for (k, set) in kinds.into_iter().enumerate() {
                let start = Instant::now();
                hits[t][k] = black_box(if k == 2 {
                    (tracer.any)(set)
                } else {
                    (tracer.closest)(set)
                });
                times[t][k].push(start.elapsed());
            }
        }
    }
    println!(
        "{:28}{:>26}{:>26}{:>26}",
        "Mrays/s", "primary", "bounce", "shadow"
    );
    let speed = |t: usize, k: usize| {
        let mut sorted: Vec<Duration> = times[t][k].clone();
        sorted.sort_unstable();
        let count = f64::from(u32::try_from(kinds[k].len()).unwrap_or(u32::MAX));
        count / sorted[RUNS / 2].as_secs_f64() / 1e6
    };
    for (t, tracer) in tracers.iter().enumerate() {
        print!("{:28}", tracer.name);
        for (k, hits) in hits[t].iter().enumerate() {
            let ratio = speed(0, k) / speed(t, k);
            print!("{:8.2} (specula x {ratio:4.2}, {hits:6})", speed(t, k));
        }
        println!();
    }
}

/// How many rays of a set hit.
pub(crate) fn count(rays: &[Ray], hit: impl Fn(&Ray) -> bool) -> usize {
    rays.iter().filter(|ray| hit(ray)).count()
}

fn theirs(ray: &Ray) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(
        glam::Vec3A::from_array(ray.origin.to_array()),
        glam::Vec3A::from_array(ray.direction.to_array()),
        0.0,
        ray.t_max,
    )
}

/// The three kinds of rays of a path tracer, from one picture.
pub(crate) struct RaySets {
    /// From the camera, line by line.
    pub(crate) primary: Vec<Ray>,
    /// Cosine-distributed from the first hits.
    pub(crate) bounce: Vec<Ray>,
    /// From the first hits to random points of a square lamp.
    pub(crate) shadow: Vec<Ray>,
}

impl RaySets {
    /// Of the camera in front of the scene's box.
    pub(crate) fn new(accel: &Accel) -> Self {
        let mut random = Random(1);
        let (mut primary, mut bounce, mut shadow) = (Vec::new(), Vec::new(), Vec::new());
        let mesh = Mesh::scene();
        for y in 0..SIDE {
            for x in 0..SIDE {
                let across = |i: u16| (f32::from(i) + 0.5) / f32::from(SIDE) * 2.0 - 1.0;
                let ray = Ray {
                    origin: vec3(0.0, 0.2, 3.4),
                    direction: vec3(0.45 * across(x), -0.45 * across(y), -1.0).normalize(),
                    t_max: f32::INFINITY,
                };
                primary.push(ray);
                let Some(hit) = accel.intersect(&ray) else {
                    continue;
                };
                let [a, b, c] = mesh.triangles[hit.primitive as usize]
                    .map(|v| Vec3::from(mesh.positions[v as usize]));
                let mut normal = (b - a).cross(c - a).normalize();
                if normal.dot(ray.direction) > 0.0 {
                    normal = -normal;
                }
                let point = ray.origin + ray.direction * hit.t + normal * 1e-4;
                let (r, phi) = (random.unit().sqrt(), TAU * random.unit());
                let local = vec3(r * phi.cos(), r * phi.sin(), (1.0 - r * r).sqrt());
                bounce.push(Ray {
                    origin: point,
                    direction: Frame::from_normal(normal).to_world(local),
                    t_max: f32::INFINITY,
                });
                let lamp = vec3(random.unit() - 0.5, 0.99, random.unit() - 0.5);
                shadow.push(Ray {
                    origin: point,
                    direction: lamp - point,
                    t_max: 0.999,
                });
            }
        }
        Self {
            primary,
            bounce,
            shadow,
        }
    }
}

/// Triangles.
#[derive(Default)]
pub(crate) struct Mesh {
    /// Vertices.
    pub(crate) positions: Vec<[f32; 3]>,
    /// Indices of vertices.
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A box of side 2, open to the front: hilly ground and three dented spheres in it.
    pub(crate) fn scene() -> Self {
        let mut mesh = Self::default();
        mesh.grid(120, 120, |u, v| {
            let (x, z) = (2.0 * u - 1.0, 2.0 * v - 1.0);
            let hill = (7.0 * x).sin() * (5.0 * z).cos() + 0.4 * (31.0 * x + 23.0 * z).sin();
            [x, -0.9 + 0.05 * hill, z]
        });
        for centre in [[-0.45, -0.35, -0.2], [0.5, -0.45, -0.4], [0.05, 0.3, 0.25]] {
            mesh.grid(140, 70, |u, v| {
                let (phi, theta) = (TAU * u, TAU / 2.0 * v);
                let dents = (9.0 * phi).sin() * (11.0 * theta).sin() * theta.sin();
                let r = 0.35 * (1.0 + 0.08 * dents);
                let [x, y, z] = centre;
                [
                    x + r * theta.sin() * phi.cos(),
                    y + r * theta.cos(),
                    z + r * theta.sin() * phi.sin(),
                ]
            });
        }
        mesh.grid(1, 1, |u, v| [2.0 * u - 1.0, 1.0, 2.0 * v - 1.0]);
        mesh.grid(1, 1, |u, v| [2.0 * u - 1.0, 2.0 * v - 1.0, -1.0]);
        mesh.grid(1, 1, |u, v| [-1.0, 2.0 * u - 1.0, 2.0 * v - 1.0]);
        mesh.grid(1, 1, |u, v| [1.0, 2.0 * u - 1.0, 2.0 * v - 1.0]);
        mesh
    }

    /// `2 w h` triangles over the unit square.
    fn grid(&mut self, w: u16, h: u16, point: impl Fn(f32, f32) -> [f32; 3]) {
        let first = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
        for y in 0..=h {
            for x in 0..=w {
                let [u, v] = [f32::from(x) / f32::from(w), f32::from(y) / f32::from(h)];
                self.positions.push(point(u, v));
            }
        }
        let (w, h) = (u32::from(w), u32::from(h));
        for y in 0..h {
            for x in 0..w {
                let a = first + y * (w + 1) + x;
                let (b, c, d) = (a + 1, a + w + 1, a + w + 2);
                self.triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }

    /// Our structure over it.
    pub(crate) fn accel(&self) -> Accel {
        let group = Group {
            positions: &self.positions,
            triangles: &self.triangles,
            ..Group::default()
        };
        Accel::build(&[group], &[Instance::of(0)]).expect("the mesh is sound")
    }

    fn theirs(&self) -> Vec<Triangle> {
        let corner = |v: u32| glam::Vec3A::from_array(self.positions[v as usize]);
        self.triangles
            .iter()
            .map(|&[a, b, c]| Triangle {
                v0: corner(a),
                v1: corner(b),
                v2: corner(c),
            })
            .collect()
    }

    fn bvh2(&self) -> (obvhs::bvh2::Bvh2, Vec<Triangle>) {
        let triangles = self.theirs();
        let parameters = BvhBuildParams::slow_build();
        let tree = build_bvh2_from_tris(&triangles, parameters, &mut Duration::default());
        let order = tree.primitive_indices.iter();
        let ordered = order.map(|&i| triangles[i as usize]).collect();
        (tree, ordered)
    }

    fn cwbvh(&self) -> (obvhs::cwbvh::CwBvh, Vec<Triangle>) {
        let triangles = self.theirs();
        let parameters = BvhBuildParams::slow_build();
        let tree = build_cwbvh_from_tris(&triangles, parameters, &mut Duration::default());
        let order = tree.primitive_indices.iter();
        let ordered = order.map(|&i| triangles[i as usize]).collect();
        (tree, ordered)
    }
}

/// SplitMix64.
struct Random(u64);

impl Random {
    /// In `[0, 1)`.
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        f32::from(u16::try_from(z >> 48).unwrap_or(0)) / 65536.0
    }
}
