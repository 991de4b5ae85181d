//! Rays by the adapter's queries beside rays through the tree, hit by hit: closest and any, at edges and
//! corners, from inside, at instances that turn, stretch and mirror. Faults planted in the shader are
//! noticed.
//!
//! Where the GPU offers no ray queries, the tests say that they are skipped; `SPECULA_RAY_QUERIES=require`
//! makes that a failure.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a suite says how much it checked, and its helpers fail loudly"
)]

mod choice;
#[path = "../common/mod.rs"]
mod common;
mod device;
#[path = "../common/queries.rs"]
mod offered;
mod rays;
mod scenes;

use device::{Fault, Hit, RayCasting, hits};
use offered::gpu_with_queries;
use rays::{Aim, Ray, from_within, towards};
use scenes::{closed, instances, prepared};
use specula_gpu::Gpu;
use specula_render::PreparedScene;

/// Rays of each scene, of either aim.
const RAYS: usize = 8192;
/// Share of rays at faces that may hit another surface, or none: some pass an edge.
const STRAYS: f64 = 1e-3;
/// The same of rays at edges and corners, where either answer is right.
const STRAYS_AT_EDGES: f64 = 0.12;
/// Share of rays that may be farther apart than [`ERROR`]: those that graze.
const APART: f64 = 1e-3;
/// Error of `t`, relative, and of barycentrics. A ray that grazes a triangle magnifies the rounding of
/// both.
const ERROR: f64 = 1e-4;
/// Share of rays at edges and corners that may leave a closed mesh. (Vulkan asks for none as far as
/// possible. The boxes of Mesa's software are no larger than what they hold.)
const LEAKS: f64 = 1e-2;

/// How far two lists of hits are apart, in shares of all rays.
#[derive(Debug, Default)]
struct Difference {
    /// One hits and the other does not, or they hit different primitives at different distances.
    strays: f64,
    /// Different primitives at the same distance: neighbours.
    neighbours: f64,
    /// The same primitive, but farther apart than [`ERROR`].
    apart: f64,
    /// The largest error of `t`, and of barycentrics.
    largest: [f64; 2],
    hits: f64,
}

fn difference(rays: &[Ray], a: &[Hit], b: &[Hit]) -> Difference {
    let mut found = Difference::default();
    let one = 1.0 / rays.len() as f64;
    for ((ray, a), b) in rays.iter().zip(a).zip(b) {
        found.hits += if a.is_there() { one } else { 0.0 };
        if a.is_there() != b.is_there() {
            found.strays += one;
        }
        if !a.is_there() || !b.is_there() || ray.any {
            continue;
        }
        let t = f64::from((a.t - b.t).abs() / a.t);
        if (a.primitive, a.instance) == (b.primitive, b.instance) {
            let weights = f64::from((a.u - b.u).abs().max((a.v - b.v).abs()));
            if t.max(weights) > ERROR {
                found.apart += one;
            }
            found.largest = [found.largest[0].max(t), found.largest[1].max(weights)];
        } else if t < ERROR {
            found.neighbours += one;
        } else {
            found.strays += one;
        }
    }
    found
}

/// Casts the rays by traversal and by queries.
fn compared(gpu: &Gpu, scene: &PreparedScene, rays: &[Ray], fault: Option<Fault>) -> Difference {
    let tree = hits(gpu, scene, rays, RayCasting::Tree);
    let query = hits(gpu, scene, rays, RayCasting::Query(fault));
    difference(rays, &tree, &query)
}

fn check(name: &str, scene: &PreparedScene, seed: u64) {
    let Some(gpu) = gpu_with_queries(name) else {
        return;
    };
    for (aim, strays) in [(Aim::Faces, STRAYS), (Aim::Edges, STRAYS_AT_EDGES)] {
        let found = compared(gpu, scene, &towards(scene, aim, RAYS, seed), None);
        println!("{name}, {aim:?}: {found:?}");
        assert!(found.hits > 0.25, "{name}: {found:?}");
        assert!(found.strays < strays, "{name}: {found:?}");
        assert!(
            found.neighbours < strays || aim == Aim::Edges,
            "{name}: {found:?}"
        );
        assert!(found.apart < APART, "{name}: {found:?}");
    }
}

#[test]
fn instances_that_turn_stretch_and_mirror() {
    check("instances", &prepared(&instances(1.0)), 1);
}

#[test]
fn a_mesh_that_is_closed() {
    check("a closed mesh", &prepared(&closed("")), 2);
}

#[test]
fn large_and_small_units() {
    check("large", &prepared(&instances(1e9)), 3);
    check("small", &prepared(&instances(1e-9)), 4);
}

#[test]
fn nothing_leaks_out_of_a_closed_mesh() {
    let Some(gpu) = gpu_with_queries("leaks") else {
        return;
    };
    for (name, placed) in [
        ("in the world", ""),
        (
            "placed",
            "Translate 0.3 -2 7 Rotate 33 1 2 3 Scale -1 2 0.5\n",
        ),
    ] {
        let scene = prepared(&closed(placed));
        for aim in [Aim::Faces, Aim::Edges] {
            let rays = from_within(&scene, aim, 4 * RAYS, 5);
            for (casting, most) in [(RayCasting::Tree, 0.0), (RayCasting::Query(None), LEAKS)] {
                let found = hits(gpu, &scene, &rays, casting);
                let leaks = found.iter().filter(|hit| !hit.is_there()).count();
                println!(
                    "{name}, {aim:?}, {casting:?}: {leaks} of {} rays leak",
                    rays.len()
                );
                let most = if aim == Aim::Edges { most } else { 0.0 };
                assert!(
                    leaks as f64 <= most * rays.len() as f64,
                    "{name}, {aim:?}, {casting:?}: {leaks} leaks"
                );
            }
        }
    }
}

#[test]
fn faults_are_noticed() {
    let Some(gpu) = gpu_with_queries("planted faults") else {
        return;
    };
    let scene = prepared(&instances(1.0));
    let rays = towards(&scene, Aim::Faces, RAYS / 4, 6);
    for (from, to) in [
        // u and v exchanged.
        (
            "hit.barycentrics.x, hit.barycentrics.y",
            "hit.barycentrics.y, hit.barycentrics.x",
        ),
        // An instance's transform instead of its inverse.
        (
            "affine_point(placement + 27u, origin)",
            "affine_point(placement + 3u, origin)",
        ),
        (
            "affine_vector(placement + 27u, direction)",
            "normalize(affine_vector(placement + 27u, direction))",
        ),
        // Quadrics are never hit; not the nearest of them; before where the ray begins, too.
        ("t > 0.0 && t < best.t", "t > 0.0 && t < 0.0"),
        ("t > 0.0 && t < best.t", "t > 0.0 && t < ray.t_max"),
        ("t > 0.0 && t < best.t", "t < best.t"),
        // Their indices begin at 0 again.
        (
            "triangles + candidate.primitive_index",
            "candidate.primitive_index",
        ),
        // Closest hits end with the first one.
        (
            "select(RAY_FLAG_NONE, RAY_FLAG_TERMINATE_ON_FIRST_HIT, any)",
            "select(RAY_FLAG_NONE, RAY_FLAG_TERMINATE_ON_FIRST_HIT, true)",
        ),
        // Rays have no end.
        ("var best = Hit(ray.t_max", "var best = Hit(FARTHEST"),
        // Triangles behind quadrics come before them, and the other way round.
        ("TRIANGLE && hit.t < best.t", "TRIANGLE"),
        (
            "TRIANGLE && hit.t < best.t",
            "TRIANGLE && best.instance == NONE",
        ),
        // Quadrics are never intersected.
        ("QUADRIC_COUNT == 0u", "QUADRIC_COUNT != 0u"),
        // Back faces are not there.
        ("select(RAY_FLAG_NONE,", "select(RAY_FLAG_CULL_BACK_FACING,"),
        // Instances by their index in the adapter's list.
        (
            "let instance = hit.instance_custom_data",
            "let instance = hit.instance_index",
        ),
    ] {
        let found = compared(gpu, &scene, &rays, Some(Fault { from, to }));
        println!("{to}: {found:?}");
        let noticed = found.strays.max(found.neighbours).max(found.apart);
        assert!(noticed > 2.0 * STRAYS.max(APART), "{to}: {found:?}");
    }
}
