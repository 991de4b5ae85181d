//! Groups that are built in chunks.

use super::*;
use crate::accel::chunks::CHUNK;

/// Waves over a square, `2 n^2` triangles.
fn waves(n: u32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let at = |i: u32, j: u32| {
        let [x, y] = [i, j].map(|k| k as f32 / n as f32);
        [x, y, 0.1 * (40.0 * x).sin() * (30.0 * y).cos()]
    };
    let positions = (0..=n)
        .flat_map(|j| (0..=n).map(move |i| at(i, j)))
        .collect();
    let squares = (0..n).flat_map(|j| (0..n).map(move |i| j * (n + 1) + i));
    let triangles = squares
        .flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]])
        .collect();
    (positions, triangles)
}

fn rays(count: u32) -> impl Iterator<Item = Ray> {
    let mut random = Random(99);
    (0..count).map(move |_| {
        let at = random.vector() * 0.5;
        ray(vec3(at.x + 0.5, at.y + 0.5, at.z), random.direction())
    })
}

/// One group in chunks, against the same triangles as two groups that are too small for them, and
/// against itself built by other numbers of threads.
#[test]
fn chunks_answer_as_one_tree_does() {
    let (positions, triangles) = waves(400);
    // Two are one item.
    assert!(triangles.len() / 2 > 2 * CHUNK);
    let half = triangles.len() / 2;
    assert!(half / 2 < 2 * CHUNK);
    let group = |triangles| Group {
        positions: &positions,
        triangles,
        ..Group::default()
    };
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads are to be had");
        pool.install(|| Accel::build(&[group(&triangles)], &[Instance::of(0)]).unwrap())
    };
    let (one, three) = (build(1), build(3));
    let halves = [group(&triangles[..half]), group(&triangles[half..])];
    let split = Accel::build(&halves, &[Instance::of(0), Instance::of(1)]).unwrap();
    assert_eq!(one.stats(), three.stats());
    assert_eq!(one.stats().triangles, triangles.len());
    let mut hits = 0;
    for ray in rays(20_000) {
        let found = one.intersect(&ray);
        assert_eq!(found, three.intersect(&ray));
        assert_eq!(one.occluded(&ray), found.is_some());
        let expected = split.intersect(&ray).map(|hit| {
            let first = crate::convert::id(half) * hit.instance;
            (hit.t, hit.u, hit.v, hit.primitive + first)
        });
        assert_eq!(
            found.map(|hit| (hit.t, hit.u, hit.v, hit.primitive)),
            expected
        );
        hits += u32::from(found.is_some());
    }
    assert!(hits > 5000, "{hits}");
}
