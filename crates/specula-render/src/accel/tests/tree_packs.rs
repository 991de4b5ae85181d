//! Packs of rays in trees against rays one by one, bit for bit.

use glam::{DMat4, DVec3};

#[cfg(target_arch = "x86_64")]
use super::super::avx2::Avx2;
use super::super::frame::{GROUP, RayFrame};
use super::super::frustum::Frustum;
use super::super::kernel::{Kernel, Portable};
use super::super::node::{Child, Lanes, Node8, Packet8, WIDTH};
use super::super::pack::Column;
use super::super::{BLOCK, RayBlock, interleaved, tree_packs};
use super::*;

/// Spheres, one in three squeezed, and some twice.
fn spheres(count: usize, random: &mut Random) -> Vec<Quadric> {
    let mut spheres: Vec<Quadric> = (0..count)
        .map(|i| {
            let squeezed = if i % 3 == 0 { 0.6 } else { 1.0 };
            let at = DVec3::from_array(random.vector().to_array().map(f64::from));
            Quadric {
                shape: QuadricShape::Sphere {
                    radius: 0.1 + 0.05 * f64::from(random.signed()),
                },
                to_group: DMat4::from_translation(at)
                    * DMat4::from_scale(DVec3::new(1.0, 1.0, squeezed)),
            }
        })
        .collect();
    spheres.extend_from_within(..count / 4);
    spheres
}

/// Groups of rays: from one point within an angle, some of them no rays.
fn coherent_rays(count: usize, random: &mut Random) -> Vec<Ray> {
    let mut rays = Vec::new();
    while rays.len() < count {
        let spread = [0.0, 1e-3, 0.02, 0.3][random.below(4)];
        let origin = random.direction() * (4.0 * random.signed().abs());
        let towards = random.vector() - origin;
        // Along an axis or in a plane across one, one in eight each.
        let still = [random.below(8), random.below(8)];
        for _ in 0..GROUP {
            let mut direction = (towards + random.vector() * spread).to_array();
            for axis in still.into_iter().filter(|&axis| axis < 3) {
                direction[axis] = 0.0;
            }
            let mut ray = ray(origin, direction.into());
            match random.below(200) {
                0 => ray.t_max = random.signed(),
                1 => ray.t_max = f32::NAN,
                2..30 => ray.t_max = 0.9 + 0.3 * random.signed(),
                _ => {}
            }
            rays.push(ray);
        }
    }
    rays
}

/// Holds packs of all instruction sets against single rays; returns how many rays hit, and how many are in packs.
fn compare(accel: &Accel, rays: &[Ray]) -> [usize; 2] {
    let scene = &accel.scene;
    let mut counts = [0; 2];
    for batch in rays.chunks(BLOCK) {
        let block = RayBlock::of(batch);
        let block = (&block, batch.len());
        let (mut hits, mut found) = (vec![None; batch.len()], vec![false; batch.len()]);
        let groups = tree_packs::intersect(Portable, scene, block, &mut hits);
        let shadow_groups = tree_packs::occluded(Portable, scene, block, &mut found);
        for (i, ray) in batch.iter().enumerate() {
            let is_in = |groups: u32| groups >> (i / GROUP) & 1 == 1;
            if is_in(groups) {
                assert_eq!(exact(hits[i]), exact(accel.intersect(ray)), "{ray:?}");
                counts[0] += usize::from(hits[i].is_some());
                counts[1] += 1;
            }
            if is_in(shadow_groups) {
                assert_eq!(found[i], accel.occluded(ray), "{ray:?}");
            }
        }
        #[cfg(target_arch = "x86_64")]
        if let Some(kernel) = Avx2::detect() {
            for kernel in [kernel, kernel.narrow()] {
                let (mut hits, mut found) = (vec![None; batch.len()], vec![false; batch.len()]);
                kernel.intersect_block(scene, block, &mut hits);
                kernel.occluded_block(scene, block, &mut found);
                for ((ray, hit), found) in batch.iter().zip(hits).zip(found) {
                    assert_eq!(exact(hit), exact(accel.intersect(ray)), "{ray:?}");
                    assert_eq!(found, accel.occluded(ray), "{ray:?}");
                }
            }
        }
    }
    counts
}

#[test]
fn packs_are_rays_one_by_one() {
    let mut random = Random(31);
    for (triangles, balls, patches) in [
        (300, 0, 0),
        (0, 70, 0),
        (40, 60, 12),
        (5000, 90, 40),
        (60_000, 0, 0),
    ] {
        let mut mesh = Mesh::soup(triangles, &mut random);
        // Some twice, so that distances are equal.
        mesh.triangles.extend_from_within(..triangles / 8);
        let quadrics = spheres(balls, &mut random);
        let patches = patches::soup(patches, &mut mesh.positions, &mut random);
        let group = Group {
            quadrics: &quadrics,
            patches: &patches,
            ..mesh.group()
        };
        let accel = Accel::build(&[group], &[Instance::of(0)]).unwrap();
        let coherent = coherent_rays(12_000, &mut random);
        let [hits, in_packs] = compare(&accel, &coherent);
        let least = match interleaved::gains(&accel.scene) {
            // Rays that part are left to others.
            true => [2000, 500],
            false => [6000, 1000],
        };
        assert!(in_packs > least[0] && hits > least[1], "{in_packs} {hits}");
        // Of a few nodes: any rays go in packs.
        let any: Vec<Ray> = (0..6016)
            .map(|_| ray(random.vector() * 1.5, random.direction()))
            .collect();
        let [_, in_packs] = compare(&accel, &any);
        let is_small = accel.stats().nodes <= tree_packs::MOST_NODES;
        assert_eq!(in_packs == any.len(), is_small, "{in_packs}");
    }
}

/// A number of few digits, so that many are equal.
fn coarse(random: &mut Random) -> f32 {
    [-1.0, -0.5, 0.0, 0.25, 1.0][random.below(5)] * 0.75
}

/// Rays of one octant, some without a direction along an axis, some from one plane.
fn one_octant(random: &mut Random) -> Vec<Ray> {
    let signs = [0, 1, 2].map(|_| if random.below(2) == 0 { 1.0 } else { -1.0 });
    let plane = coarse(random);
    let spread = [0.0, 0.1, 1.0][random.below(3)];
    (0..GROUP)
        .map(|_| {
            let direction = signs.map(|sign| match random.below(9) {
                0 => 0.0_f32.copysign(sign),
                1 => f32::MIN_POSITIVE.copysign(sign),
                _ => sign * (1.0 + spread * random.signed().abs()),
            });
            let origin = [0, 1, 2].map(|axis| {
                if axis == 0 {
                    plane
                } else {
                    coarse(random) * (1.0 + spread * random.signed())
                }
            });
            ray(origin.into(), direction.into())
        })
        .collect()
}

#[test]
fn bounds_of_a_pack_reach_all_that_its_rays_do() {
    let mut random = Random(57);
    let mut counts = [0; 3];
    for _ in 0..4000 {
        let rays = one_octant(&mut random);
        let frames: Vec<RayFrame> = rays.iter().filter_map(RayFrame::new).collect();
        if frames.len() < GROUP {
            continue;
        }
        let columns = |value: &dyn Fn(&RayFrame, usize) -> f32| {
            [0, 1, 2].map(|axis| Column(std::array::from_fn(|k| value(&frames[k], axis))))
        };
        let origin = columns(&|frame, axis| frame.ray.origin.to_array()[axis]);
        let scale = columns(&|frame, axis| frame.near_scale[axis]);
        let frustum = Frustum::new(frames[0].near.map(usize::from), &origin, &scale);
        let (mut node, mut packet) = (Node8::EMPTY, Packet8::EMPTY);
        for slot in 0..WIDTH {
            let corners = [0, 1, 2].map(|_| [0, 1, 2].map(|_| coarse(&mut random)));
            packet.set(slot, corners, 0);
            node.set(slot, &Bounds::around(&corners), Child(0));
        }
        let t_most = 2.0;
        let mut entry = Lanes::default();
        let reached = frustum.boxes(Portable, &node, t_most, &mut entry);
        assert_eq!(frustum.triangles(Portable, &packet, t_most), reached);
        let mut by_any = 0;
        for frame in &frames {
            let mut entries = Lanes::default();
            let set = Portable.boxes(&node, frame, t_most, &mut entries);
            assert_eq!(set & !reached, 0, "{rays:?} {node:?}");
            for slot in (0..WIDTH).filter(|slot| set >> slot & 1 == 1) {
                assert!(entry.0[slot] <= entries.0[slot], "{rays:?} {node:?}");
            }
            by_any |= set;
        }
        counts[0] += by_any.count_ones();
        counts[1] += reached.count_ones();
        counts[2] += 8;
    }
    // What is told must also be worth something.
    let [by_any, reached, all] = counts;
    assert!(by_any > all / 8, "{counts:?}");
    assert!(reached - by_any < (all - by_any) / 3, "{counts:?}");
}
