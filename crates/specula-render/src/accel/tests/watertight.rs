//! No ray from inside a closed mesh gets out.

use super::*;

/// Counts rays from `origins` that miss: in random directions, at vertices, and at edge midpoints.
fn leaks(mesh: &Mesh, origin: impl Fn(&mut Random) -> Vec3<f32>, random_rays: usize) -> usize {
    let accels = [mesh.accel(), mesh.accel().in_tree()];
    let mut random = Random(5);
    let mut missed = 0;
    let mut shoot = |origin: Vec3<f32>, direction: Vec3<f32>| {
        let ray = ray(origin, direction);
        let leaks = |accel: &Accel| accel.intersect(&ray).is_none() || !accel.occluded(&ray);
        missed += usize::from(accels.iter().any(leaks));
    };
    for _ in 0..random_rays {
        let from = origin(&mut random);
        shoot(from, random.direction());
    }
    for index in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(index).map(Vec3::from);
        let from = origin(&mut random);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            shoot(from, p - from);
            shoot(from, (p + q) * 0.5 - from);
            shoot(from, (p + (q - p) * random.signed().abs()) - from);
        }
    }
    missed
}

#[test]
fn a_sphere_holds_a_million_rays() {
    let mesh = Mesh::closed(40, |p| p);
    assert_eq!(mesh.triangles.len(), 8 * 40 * 40);
    let missed = leaks(&mesh, |random| random.vector() * 0.5, 1_000_000);
    assert_eq!(missed, 0);
}

#[test]
fn from_the_centre_along_axes_and_edges() {
    // Vertices, edges and faces' corners all lie exactly on axes and diagonals.
    let mesh = Mesh::closed(16, |p| p);
    assert_eq!(leaks(&mesh, |_| Vec3::ZERO, 1000), 0);
    let accel = mesh.accel();
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for direction in [axis, -axis] {
            assert!(accel.intersect(&ray(Vec3::ZERO, direction)).is_some());
        }
    }
}

#[test]
fn far_from_the_origin_and_out_of_shape() {
    // A long needle of an ellipsoid, and a sphere 1000 radii away from the origin.
    let needle = Mesh::closed(24, |p| vec3(1000.0 * p.x, 0.1 * p.y, p.z));
    let within = |random: &mut Random| {
        let v = random.vector() * 0.5;
        vec3(1000.0 * v.x, 0.1 * v.y, v.z)
    };
    assert_eq!(leaks(&needle, within, 100_000), 0);
    let at = vec3(1000.0, -777.7, 333.3);
    let distant = Mesh::closed(24, |p| p + at);
    assert_eq!(leaks(&distant, |r| r.vector() * 0.5 + at, 100_000), 0);
}

#[test]
fn a_box_of_large_triangles_with_its_edges_along_the_axes() {
    // The boxes of the faces are flat: only their padding holds rays near the edges.
    let sizes = vec3(1000.0, 3.0, 70.0);
    let corner = |i: u32| {
        let side = |bit: u32, s: f32| if i >> bit & 1 == 0 { -s } else { s };
        [side(0, sizes.x), side(1, sizes.y), side(2, sizes.z)]
    };
    let mesh = Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: BOX_FACES
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
    };
    let within = |random: &mut Random| random.vector().hadamard(sizes) * 0.999;
    assert_eq!(leaks(&mesh, within, 200_000), 0);
    let accel = mesh.accel();
    let tree = accel.clone().in_tree();
    let mut random = Random(6);
    for _ in 0..200_000 {
        // At points of the twelve edges, and within a few ulps of them.
        let (from, mut target) = (within(&mut random), random.vector().hadamard(sizes));
        let along = random.below(3);
        let mut snap = |x: f32, s: f32| s.copysign(x) * (1.0 + random.signed() * 3e-7);
        if along != 0 {
            target.x = snap(target.x, sizes.x);
        }
        if along != 1 {
            target.y = snap(target.y, sizes.y);
        }
        if along != 2 {
            target.z = snap(target.z, sizes.z);
        }
        let ray = ray(from, target - from);
        for accel in [&accel, &tree] {
            let hit = accel.intersect(&ray);
            assert!(hit.is_some() && accel.occluded(&ray), "{ray:?}");
        }
    }
}
