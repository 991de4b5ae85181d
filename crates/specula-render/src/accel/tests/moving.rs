//! Instances that move, against instances that stand where they are at a time.

use glam::{DMat4, DQuat, DVec3};
use specula_scene::scene::Motion;

use super::super::{BlockHits, RayBlock};
use super::*;
use crate::movement::Movement;

fn vector(random: &mut Random) -> DVec3 {
    DVec3::from_array(random.vector().to_array().map(f64::from))
}

fn pose(random: &mut Random) -> DMat4 {
    let turn = DQuat::from_axis_angle(vector(random).normalize_or(DVec3::X), 3.0);
    DMat4::from_scale_rotation_translation(vector(random).abs() + 0.3, turn, vector(random) * 3.0)
}

fn movement(random: &mut Random) -> Movement {
    let motion = |random: &mut Random| Motion {
        end: pose(random),
        times: [-0.2, 0.9],
    };
    let inner = motion(random);
    let outer = motion(random);
    let movement = Movement::default().within(pose(random), Some(&inner));
    match random.below(3) {
        0 => movement,
        1 => movement.within(pose(random), None),
        _ => movement.within(pose(random), Some(&outer)),
    }
}

#[test]
fn rays_hit_what_moves_where_it_is_at_their_time() {
    let mut random = Random(21);
    let meshes = [
        Mesh::closed(6, |p| p),
        Mesh::soup(50, &mut random),
        Mesh::closed(3, |p| vec3(p.x, 0.5 * p.y, p.z)),
    ];
    let groups = meshes.each_ref().map(Mesh::group);
    let movements: Vec<Movement> = (0..8).map(|_| movement(&mut random)).collect();
    let group = |i: usize| u32::try_from(i % 3).unwrap();
    let still = Instance {
        group: 1,
        to_world: pose(&mut random),
    };
    let at = |time: f32| {
        let poses = movements.iter().enumerate();
        let moving = poses.map(|(i, m)| Instance {
            group: group(i),
            to_world: m.at(time),
        });
        let mut all: Vec<Instance> = moving.collect();
        all.insert(3, still);
        all
    };
    let indices = (0..).filter(|i| *i != 3);
    let moving: Vec<(u32, &Movement)> = indices.zip(&movements).collect();
    let accel = Accel::build_moving(&groups, &at(0.0), &moving).unwrap();
    let portable = accel.clone().portable();
    assert!(accel.moves());
    let mut hits = 0;
    for step in 0..60_u8 {
        let time = f32::from(step) / 60.0;
        let reference = Accel::build(&groups, &at(time)).unwrap();
        assert!(!reference.moves());
        let rays: Vec<Ray> = (0..300)
            .map(|_| {
                let origin = random.vector() * 5.0;
                ray(origin, random.vector() * 3.0 - origin)
            })
            .collect();
        let (mut found, mut occluded) = (BlockHits::new(), Vec::new());
        let block = RayBlock::of(&rays);
        accel.intersect_block_at((&block, rays.len()), |_| time, &mut found);
        accel.occluded_block_at((&block, rays.len()), |_| time, &mut occluded);
        for (i, ray) in rays.iter().enumerate() {
            let expected = exact(reference.intersect(ray));
            assert_eq!(exact(accel.intersect_at(ray, time)), expected, "{ray:?}");
            assert_eq!(exact(portable.intersect_at(ray, time)), expected);
            assert_eq!(exact(found.get(&accel, i, || *ray)), expected);
            assert_eq!(portable.occluded_at(ray, time), expected.is_some());
            assert_eq!(occluded[i], expected.is_some());
            // Times of rays without one: where the shutter opens.
            if step == 0 {
                assert_eq!(exact(accel.intersect(ray)), expected);
            }
            hits += usize::from(expected.is_some());
        }
        let (around, then) = (accel.bounds().unwrap(), reference.bounds().unwrap());
        assert_eq!(around.union(&then), around);
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn a_lone_moving_group_is_not_taken_for_one_that_stands_still() {
    let mut random = Random(22);
    let mesh = Mesh::closed(4, |p| p);
    let motion = Motion {
        end: DMat4::from_translation(DVec3::new(9.0, 0.0, 0.0)),
        times: [0.0, 1.0],
    };
    let movement = Movement::default().within(DMat4::IDENTITY, Some(&motion));
    let groups = [mesh.group()];
    let accel = Accel::build_moving(&groups, &[Instance::of(0)], &[(0, &movement)]).unwrap();
    for _ in 0..100 {
        let [start, end] = [0.0, 9.0].map(|x| ray(vec3(x, 0.0, 0.0), random.direction()));
        // From inside of the closed mesh every ray hits it.
        assert!(accel.occluded_at(&start, 0.0) && accel.occluded_at(&end, 1.0));
        assert_eq!(
            accel.intersect_at(&end, 0.0).is_some(),
            accel.occluded(&end)
        );
    }
    let right = ray(vec3(9.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0));
    assert!(!accel.occluded(&right) && !accel.occluded_at(&right, 0.5));
}
