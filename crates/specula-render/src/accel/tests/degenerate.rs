//! Input that breaks weaker structures.

use super::super::binary::Binary;
use super::super::collapse;
use super::super::kernel::MAX_DEPTH;
use super::super::node::{Child, ChildKind};
use super::*;

#[test]
fn nothing_is_fine() {
    for accel in [
        Accel::build(&[], &[]).unwrap(),
        Accel::build(&[Group::default()], &[Instance::of(0), Instance::of(0)]).unwrap(),
        Mesh::default().accel(),
    ] {
        assert_eq!(accel.bounds(), None);
        assert_eq!(accel.intersect(&ray(Vec3::ZERO, Vec3::X)), None);
        assert!(!accel.occluded(&ray(Vec3::ZERO, Vec3::X)));
    }
}

#[test]
fn rays_that_are_not_rays_hit_nothing() {
    let accel = Mesh::closed(4, |p| p).accel();
    let (nan, inf) = (f32::NAN, f32::INFINITY);
    let sound = ray(Vec3::ZERO, Vec3::X);
    assert!(accel.occluded(&sound));
    for bad in [nan, inf, -inf] {
        for axis in 0..3 {
            let put = |v: Vec3<f32>| {
                let mut v = v.to_array();
                v[axis] = bad;
                Vec3::from(v)
            };
            for ray in [ray(put(Vec3::ZERO), Vec3::X), ray(Vec3::ZERO, put(Vec3::X))] {
                assert_eq!(accel.intersect(&ray), None, "{ray:?}");
                assert!(!accel.occluded(&ray));
            }
        }
    }
    for t_max in [nan, 0.0, -1.0, -inf] {
        assert!(!accel.occluded(&Ray { t_max, ..sound }));
    }
    assert!(!accel.occluded(&ray(Vec3::ZERO, Vec3::ZERO)));
}

#[test]
fn triangles_without_area_are_never_hit() {
    let mut random = Random(12);
    let mut mesh = Mesh::default();
    for i in 0..3000 {
        let (a, b) = (random.vector(), random.vector());
        mesh.push(match i % 4 {
            0 => [a, a, a],
            1 => [a, b, a],
            2 => [a, (a + b) * 0.5, (a + b) * 0.5],
            // Collinear exactly: all multiples of one vector by powers of two.
            _ => [a * 0.25, a * 0.5, a * 2.0],
        });
    }
    assert_eq!(mesh.accel().stats().triangles, 0);
    mesh.push([vec3(f32::NAN, 0.0, 0.0), Vec3::X, Vec3::Y]);
    mesh.push([vec3(f32::INFINITY, 0.0, 0.0), Vec3::X, Vec3::Y]);
    mesh.push([Vec3::X, Vec3::Y, Vec3::Z]);
    let accel = mesh.accel();
    assert_eq!(accel.stats().triangles, 1);
    for index in 0..3000 {
        let at = Vec3::from(mesh.corners(index)[0]);
        let hit = accel.intersect(&ray(Vec3::ZERO, at));
        assert!(hit.is_none_or(|hit| hit.primitive == 3002), "{hit:?}");
    }
}

#[test]
fn thousands_of_identical_triangles() {
    let mut mesh = Mesh::default();
    mesh.push([Vec3::X, Vec3::Y, Vec3::Z]);
    mesh.triangles = vec![[0, 1, 2]; 20_000];
    let accel = mesh.accel();
    assert!(accel.stats().depth <= 16, "{:?}", accel.stats());
    for accel in [accel.clone(), accel.portable()] {
        let hit = accel
            .intersect(&ray(Vec3::ZERO, vec3(1.0, 1.0, 1.0)))
            .unwrap();
        assert_eq!((hit.primitive, hit.instance), (0, 0));
        assert!((hit.t - 1.0 / 3.0).abs() < 1e-6);
    }
}

#[test]
fn sizes_that_double_two_hundred_times() {
    // Nested triangles whose greedy tree is a chain.
    let mut mesh = Mesh::default();
    for exponent in -60..60 {
        for turn in 0..4 {
            let s = 2.0_f32.powi(exponent) * (1.0 + 0.1 * turn as f32);
            mesh.push([vec3(s, 0.0, s), vec3(0.0, s, s), vec3(-s, -s, s)]);
        }
    }
    let accel = mesh.accel();
    assert!(accel.stats().depth <= MAX_DEPTH, "{:?}", accel.stats());
    let mut random = Random(13);
    for _ in 0..2000 {
        let mut direction = random.direction() * 0.1;
        direction.z = 1.0;
        let scale = 2.0_f32.powi(i32::try_from(random.below(100)).unwrap() - 50);
        let ray = ray(vec3(0.0, 0.0, scale), direction);
        let expected = mesh.brute_force(&ray);
        assert_eq!(exact(accel.intersect(&ray)), exact(expected), "{ray:?}");
    }
}

#[test]
fn balanced_trees_are_whole_and_shallow() {
    let mut random = Random(14);
    let mesh = Mesh::soup(3000, &mut random);
    let items: Vec<Bounds> = (0..3000)
        .map(|i| triangle::bounds(&mesh.corners(i)).unwrap())
        .collect();
    let tree = Binary::balanced(&items);
    assert_eq!(tree.0.len(), 2 * 3000 - 1);
    let leaves = tree.0.iter().filter(|node| node.right == 0);
    let mut found: Vec<u32> = leaves.map(|node| node.item).collect();
    found.sort_unstable();
    assert!(found.into_iter().eq(0..3000));
    let (mut nodes, mut seen) = (Vec::new(), 0);
    let tree = collapse::plant(
        tree,
        |_| 1,
        &mut nodes,
        |items| {
            seen += items.len();
            Child::new(ChildKind::Packet, 0)
        },
    );
    assert_eq!(seen, 3000);
    assert!(tree.depth <= 12, "{}", tree.depth);
}

#[test]
fn huge_and_tiny_units() {
    let mut random = Random(15);
    for scale in [1e-15, 1e15, 1e18] {
        let mesh = Mesh::closed(10, |p| p * scale);
        let accel = mesh.accel();
        for _ in 0..5000 {
            let ray = ray(random.vector() * (0.4 * scale), random.direction());
            let hit = accel.intersect(&ray);
            assert!(hit.is_some(), "{ray:?}");
            assert_eq!(exact(hit), exact(mesh.brute_force(&ray)), "{ray:?}");
        }
    }
    // Beyond what the products can hold: anything but a panic.
    let mesh = Mesh::closed(4, |p| p * 3e38);
    let accel = mesh.accel();
    let portable = accel.clone().portable();
    for _ in 0..100 {
        let ray = ray(random.vector() * 1e38, random.direction());
        let hit = accel.intersect(&ray);
        assert_eq!(exact(hit), exact(portable.intersect(&ray)));
    }
}
