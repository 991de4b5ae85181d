//! Against trying every triangle, and the kernels against each other, bit for bit.

#[cfg(target_arch = "x86_64")]
use super::super::avx2::Avx2;
use super::super::frame::{FrameGroup, GROUP};
use super::super::kernel::{EntryStack, KEY_BITS, Kernel, Portable, is_within};
use super::super::node::{Child, ChildKind, Lanes, Node8, WIDTH};
use super::super::traverse::child_of;
use super::super::{BLOCK, RayBlock};
use super::*;

/// Rays of all kinds: random, along axes, with zeros and negative zeros, limited, from a vertex.
fn rays(count: usize, mesh: &Mesh, random: &mut Random) -> Vec<Ray> {
    (0..count)
        .map(|i| {
            let mut origin = random.vector() * 1.5;
            let mut direction = random.direction();
            match i % 8 {
                1 => direction.x = 0.0,
                2 => direction = vec3(0.0, -0.0, direction.z),
                3 => direction = vec3(-0.0, direction.y, 0.0),
                4 => origin = Vec3::from(mesh.positions[random.below(mesh.positions.len())]),
                5 => {
                    let target = mesh.positions[random.below(mesh.positions.len())];
                    direction = Vec3::from(target) - origin;
                }
                _ => {}
            }
            let t_max = if i % 3 == 0 {
                random.signed().abs()
            } else {
                f32::INFINITY
            };
            Ray {
                origin,
                direction,
                t_max,
            }
        })
        .collect()
}

#[test]
fn hits_are_those_of_brute_force() {
    let mut random = Random(1);
    for count in [1, 2, 7, 8, 9, 60, 500] {
        let mesh = Mesh::soup(count, &mut random);
        let accel = mesh.accel();
        let mut hits = 0;
        for ray in rays(4000, &mesh, &mut random) {
            let expected = mesh.brute_force(&ray);
            assert_eq!(exact(accel.intersect(&ray)), exact(expected), "{ray:?}");
            assert_eq!(accel.occluded(&ray), expected.is_some(), "{ray:?}");
            hits += usize::from(expected.is_some());
        }
        assert!(hits > 100, "{hits} hits of {count} triangles show nothing");
    }
}

#[test]
fn kernels_agree_bit_for_bit() {
    let mut random = Random(2);
    let mesh = Mesh::soup(20_000, &mut random);
    let accel = mesh.accel();
    if accel.instructions() == Instructions::Portable {
        specula_testing::not_of_this_machine("the kernel for AVX2", "no AVX2");
        return;
    }
    let portable = accel.clone().portable();
    assert_eq!(portable.instructions(), Instructions::Portable);
    let mut hits = 0;
    for ray in rays(100_000, &mesh, &mut random) {
        let hit = accel.intersect(&ray);
        assert_eq!(exact(hit), exact(portable.intersect(&ray)), "{ray:?}");
        assert_eq!(accel.occluded(&ray), hit.is_some(), "{ray:?}");
        assert_eq!(portable.occluded(&ray), hit.is_some(), "{ray:?}");
        hits += usize::from(hit.is_some());
    }
    assert!((30_000..100_000).contains(&hits), "{hits}");
}

#[test]
fn equal_distances_go_to_the_smallest_index() {
    // Eight copies of each of 40 triangles, in another order: the copies share every `t`.
    let mut random = Random(3);
    let base = Mesh::soup(40, &mut random);
    let mut mesh = base.clone();
    for _ in 0..7 {
        mesh.triangles.extend(base.triangles.iter().rev());
    }
    let accel = mesh.accel();
    let mut hits = 0;
    for ray in rays(4000, &mesh, &mut random) {
        let expected = base.brute_force(&ray);
        assert_eq!(exact(accel.intersect(&ray)), exact(expected), "{ray:?}");
        hits += usize::from(expected.is_some());
    }
    assert!(hits > 200, "{hits}");
}

#[test]
fn equal_distances_in_a_plane_go_to_the_smallest_index() {
    // Triangles of all shapes in one plane: many hits share `t`, met in any order of boxes.
    let mut random = Random(16);
    let mut mesh = Mesh::default();
    for _ in 0..400 {
        let mut corner = || vec3(random.signed(), random.signed(), 1.0);
        mesh.push([corner(), corner(), corner()]);
    }
    let accel = mesh.accel();
    let portable = accel.clone().portable();
    for _ in 0..4000 {
        let ray = ray(vec3(random.signed(), random.signed(), 0.0), Vec3::Z);
        let expected = exact(mesh.brute_force(&ray));
        assert_eq!(exact(accel.intersect(&ray)), expected, "{ray:?}");
        assert_eq!(exact(portable.intersect(&ray)), expected, "{ray:?}");
    }
}

#[test]
fn frames_of_groups_are_those_of_rays() {
    let mut random = Random(72);
    let mesh = Mesh::soup(50, &mut random);
    let mut rays = rays(BLOCK - 3, &mesh, &mut random);
    for (k, ray) in rays.iter_mut().enumerate() {
        match k % 31 {
            3 => ray.direction.y = f32::NAN,
            5 => ray.direction = Vec3::ZERO,
            9 => ray.t_max = 0.0,
            12 => ray.origin.z = f32::INFINITY,
            17 => ray.direction = vec3(0.25, -0.25, 0.25),
            _ => {}
        }
    }
    let block = RayBlock::of(&rays);
    for first in (0..rays.len()).step_by(GROUP) {
        let group = FrameGroup::new(&block, first);
        for (index, ray) in rays.iter().enumerate().skip(first).take(GROUP) {
            let [one, other] = [RayFrame::new(ray), group.get(index)];
            assert_eq!(format!("{one:?}"), format!("{other:?}"));
        }
    }
    assert!(rays.iter().any(|ray| RayFrame::new(ray).is_none()));
}

/// What each kernel that there is pushes onto its stack for a node: distances, the farthest first, and children.
fn pushed(node: &Node8, ray: &Ray, t_cull: f32) -> Vec<Vec<(u32, Child)>> {
    fn of<K: Kernel>(kernel: K, node: &Node8, frame: &RayFrame, t_cull: f32) -> Vec<(u32, Child)> {
        let mut stack = kernel.stack();
        // Not at the bottom, as for most nodes.
        let first = kernel.push_children(node, frame, t_cull, &mut stack, 0);
        let top = kernel.push_children(node, frame, t_cull, &mut stack, first);
        let mut entries = Lanes::default();
        let mask = kernel.boxes(node, frame, t_cull, &mut entries);
        let entries: Vec<u64> = (first..top).map(|at| stack.get(at)).collect();
        assert!(entries.iter().all(|&entry| is_within(entry, t_cull)));
        let lanes = (0..WIDTH).filter(|lane| mask >> lane & 1 == 1);
        let met: Vec<u32> = lanes.map(|lane| node.children[lane].0).collect();
        let mut children: Vec<u32> = entries.iter().map(|&e| child_of(e).0).collect();
        children.sort_unstable();
        assert_eq!(children, met);
        let parts = entries.iter().map(|&e| ((e >> 32) as u32, child_of(e)));
        parts.collect()
    }
    let frame = RayFrame::new(ray).unwrap();
    let mut all = vec![of(Portable, node, &frame, t_cull)];
    #[cfg(target_arch = "x86_64")]
    if let Some(kernel) = Avx2::detect() {
        all.push(of(kernel, node, &frame, t_cull));
    }
    all
}

/// Children that a ray meets, as bits, by each kernel that there is.
fn boxes_met(bounds: &Bounds, ray: &Ray) -> Vec<u32> {
    let mut node = Node8::EMPTY;
    node.set(3, bounds, Child::new(ChildKind::Node, 3));
    let all = pushed(&node, ray, f32::INFINITY);
    let bits = |entries: &Vec<(u32, Child)>| {
        let children = entries.iter().map(|entry| 1 << entry.1.index());
        children.fold(0, |bits: u32, bit: u32| bits | bit)
    };
    all.iter().map(bits).collect()
}

#[test]
fn children_are_pushed_by_their_distance() {
    let mut random = Random(71);
    let mut counts = [0; WIDTH + 1];
    for _ in 0..4000 {
        let origin = random.direction() * 2.0;
        let ray = ray(origin, random.vector() * 0.4 - origin);
        let mut node = Node8::EMPTY;
        for lane in 0..WIDTH {
            if random.signed() > 0.8 {
                continue;
            }
            let corners = [(); 2].map(|()| random.direction().to_array());
            let child = Child::new(ChildKind::Packet, 100 + lane);
            node.set(lane, &Bounds::around(&corners), child);
        }
        let t_cull = if random.signed() > 0.0 {
            0.9
        } else {
            f32::INFINITY
        };
        let all = pushed(&node, &ray, t_cull);
        counts[all[0].len()] += 1;
        for entries in &all {
            assert!(entries.is_sorted_by(|a, b| a.0 >= b.0), "{entries:?}");
            // The same children, at the same distances but for the bits that order nothing.
            let by_child = |entries: &[(u32, Child)]| {
                let mut list: Vec<_> = entries.iter().map(|e| (e.1.0, e.0 >> KEY_BITS)).collect();
                list.sort_unstable();
                list
            };
            assert_eq!(by_child(entries), by_child(&all[0]));
        }
    }
    assert!(counts[..6].iter().all(|&n| n > 20), "{counts:?}");
}

#[test]
fn rays_within_a_face_meet_the_box() {
    // Where the direction is 0, the slab distance is 0 * inf, not a number.
    let bounds = Bounds {
        min: [-1.0, 2.0, 3.0],
        max: [5.0, 7.0, 3.0],
    };
    for zero in [0.0, -0.0] {
        for x in [-1.0, 0.0, 5.0] {
            for y in [2.0, 4.0, 7.0] {
                let ray = ray(vec3(x, y, -10.0), vec3(zero, zero, 1.0));
                assert!(boxes_met(&bounds, &ray).iter().all(|&m| m == 8), "{ray:?}");
            }
        }
        for (x, y) in [
            (-1.0_f32.next_up(), 1.9),
            (5.1, 3.0),
            (-1.1, 3.0),
            (0.0, 7.1),
        ] {
            let ray = ray(vec3(x, y, -10.0), vec3(zero, zero, 1.0));
            assert!(boxes_met(&bounds, &ray).iter().all(|&m| m == 0), "{ray:?}");
        }
        let within = ray(vec3(-9.0, 2.0, 3.0), vec3(1.0, zero, zero));
        assert!(boxes_met(&bounds, &within).iter().all(|&m| m == 8));
    }
}

#[test]
fn builds_do_not_depend_on_the_number_of_threads() {
    let mut random = Random(4);
    let meshes: Vec<Mesh> = (0..5).map(|_| Mesh::soup(3000, &mut random)).collect();
    let groups: Vec<Group<'_>> = meshes.iter().map(Mesh::group).collect();
    let instances: Vec<Instance> = (0..5).map(Instance::of).collect();
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let accel = pool
            .unwrap()
            .install(|| Accel::build(&groups, &instances).unwrap());
        format!("{:?}", accel.scene)
    };
    assert_eq!(build(1), build(4));
}

#[test]
fn t_max_is_exclusive() {
    let mut mesh = Mesh::default();
    mesh.push([
        vec3(-1.0, -1.0, 2.0),
        vec3(3.0, -1.0, 2.0),
        vec3(-1.0, 3.0, 2.0),
    ]);
    let accel = mesh.accel();
    for (t_max, hit) in [(2.0, false), (2.0_f32.next_up(), true), (1.0, false)] {
        let ray = Ray {
            t_max,
            ..ray(Vec3::ZERO, Vec3::Z)
        };
        assert_eq!(accel.intersect(&ray).is_some(), hit, "{t_max}");
        assert_eq!(accel.occluded(&ray), hit, "{t_max}");
    }
    // Nor does a ray that begins on the triangle hit it.
    assert!(!accel.occluded(&ray(vec3(0.0, 0.0, 2.0), Vec3::Z)));
}

/// A triangle that is told to be apart has no hit within the ray, whatever the scale; one that is a thousandth apart is
/// told so.
#[test]
fn triangles_apart_have_no_hits() {
    let mut random = Random(31);
    let (mut near, mut far) = (0, 0);
    for i in 0..600_000 {
        let scale = 10.0_f32.powi(i % 25 - 12);
        let [a, b, c, o] = [(); 4].map(|()| random.vector() * scale);
        // Weights of a point: half of them on an edge or outside.
        let weights = [(); 2].map(|()| 0.6 * random.signed() + 0.3);
        let target = a + (b - a) * weights[0] + (c - a) * weights[1];
        let along = [1.0, -1.0, 0.3, 1e-7][random.below(4)];
        let mut ray = ray(o, (target - o) * along);
        let frame = RayFrame::new(&ray).unwrap();
        let p = [a, b, c].map(|p| {
            let p = frame.axes.map(|axis| p.to_array()[usize::from(axis)]);
            triangle::shear(p, frame.sheared_origin, frame.shear)
        });
        let uvw = triangle::edge_functions(p[0], p[1], p[2]);
        let z = p.map(|p| p[2]);
        let (t, _, _) = triangle::distance(uvw, z, frame.shear[2]);
        if !triangle::inside(uvw) || !t.is_finite() {
            continue;
        }
        let nearly = 1.0 + random.signed() * 1e-6;
        ray.t_max = [1.001, 0.999, nearly, f32::INFINITY][random.below(4)] * t.abs();
        let farthest = z.iter().fold(0.0, |m: f32, z| m.max(z.abs()));
        let apart = triangle::is_apart(uvw, z, frame.shear[2], (ray.t_max, farthest));
        if t > 0.0 && t < ray.t_max {
            assert!(!apart, "{ray:?} {t}");
            near += 1;
        } else if farthest * frame.shear[2].abs() < 100.0 * t.abs() && scale > 1e-9 {
            // Below, products of small numbers are too near the least one to tell.
            let surely = t < 0.0 || ray.t_max < 0.9995 * t;
            assert!(apart || !surely, "{ray:?} {t}");
            far += usize::from(surely);
        }
    }
    assert!(near > 50_000 && far > 50_000, "{near} {far}");
}
