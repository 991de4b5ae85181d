//! Instances against the same geometry transformed by hand.

use glam::{DMat4, DQuat, DVec3};

use super::*;

/// Rotations, scales and a mirroring.
fn transforms(random: &mut Random) -> Vec<DMat4> {
    (0..12)
        .map(|i| {
            let v =
                |random: &mut Random| DVec3::from_array(random.vector().to_array().map(f64::from));
            let axis = DVec3::from_array(random.direction().to_array().map(f64::from));
            let mut scale = v(random).abs() + 0.3;
            if i % 3 == 0 {
                scale.x = -scale.x;
            }
            let turn = DQuat::from_axis_angle(axis.normalize(), f64::from(random.signed()) * 3.0);
            DMat4::from_scale_rotation_translation(scale, turn, v(random) * 3.0)
        })
        .collect()
}

#[test]
fn instances_are_flattened_geometry() {
    let mut random = Random(7);
    let meshes = [
        Mesh::closed(6, |p| p),
        Mesh::soup(50, &mut random),
        Mesh::closed(3, |p| vec3(p.x, 0.5 * p.y, p.z)),
    ];
    let groups = meshes.each_ref().map(Mesh::group);
    let instances: Vec<Instance> = transforms(&mut random)
        .into_iter()
        .enumerate()
        .map(|(i, to_world)| Instance {
            group: u32::try_from(i % 3).unwrap(),
            to_world,
        })
        .chain([Instance::of(0)])
        .collect();
    let accel = Accel::build(&groups, &instances).unwrap();
    let portable = accel.clone().portable();
    let mut flat = Mesh::default();
    let mut origins = Vec::new();
    for (i, instance) in instances.iter().enumerate() {
        let mesh = &meshes[instance.group as usize];
        for t in 0..mesh.triangles.len() {
            flat.push(mesh.corners(t).map(|p| {
                let p = DVec3::from_array(p.map(f64::from));
                Vec3::from(instance.to_world.transform_point3(p).as_vec3().to_array())
            }));
            origins.push((i, t));
        }
    }
    let reference = flat.accel();
    let (mut hits, mut other) = (0, 0);
    for _ in 0..50_000 {
        let ray = ray(random.vector() * 4.0, random.direction());
        let (specula, theirs) = (accel.intersect(&ray), reference.intersect(&ray));
        assert_eq!(accel.occluded(&ray), specula.is_some());
        assert_eq!(exact(specula), exact(portable.intersect(&ray)), "{ray:?}");
        match (specula, theirs) {
            (Some(a), Some(b)) if (a.t - b.t).abs() <= 2e-5 * (1.0 + b.t) => {
                hits += 1;
                let named = (a.instance as usize, a.primitive as usize);
                other += usize::from(named != origins[b.primitive as usize]);
            }
            (None, None) => {}
            // Rounding at silhouettes.
            _ => other += 1,
        }
    }
    assert!(hits > 5000, "{hits}");
    assert!(other < 50, "{other} of {hits} differ");
}

#[test]
fn ties_between_instances_go_to_the_first() {
    let mesh = Mesh::closed(4, |p| p);
    let moved = Instance {
        group: 0,
        to_world: DMat4::from_translation(DVec3::new(10.0, 0.0, 0.0)),
    };
    let list = [moved, Instance::of(0), Instance::of(0), Instance::of(0)];
    let accel = Accel::build(&[mesh.group()], &list).unwrap();
    let single = mesh.accel();
    let mut random = Random(8);
    for _ in 0..2000 {
        let ray = ray(Vec3::ZERO, random.direction());
        let expected = single.intersect(&ray).map(|hit| Hit { instance: 1, ..hit });
        assert_eq!(exact(accel.intersect(&ray)), exact(expected));
    }
}

#[test]
fn bounds_hold_everything() {
    let mesh = Mesh::closed(8, |p| p);
    let mut random = Random(9);
    for to_world in transforms(&mut random) {
        let instance = Instance { group: 0, to_world };
        let bounds = Accel::build(&[mesh.group()], &[instance])
            .unwrap()
            .bounds()
            .unwrap();
        for p in &mesh.positions {
            let p = to_world.transform_point3(DVec3::from_array(p.map(f64::from)));
            for (axis, x) in p.to_array().into_iter().enumerate() {
                assert!(x >= f64::from(bounds.min[axis]) && x <= f64::from(bounds.max[axis]));
            }
        }
        let size: f32 = (0..3).map(|a| bounds.max[a] - bounds.min[a]).sum();
        assert!(size < 30.0, "{bounds:?} is not tight");
    }
}

#[test]
fn what_cannot_be_built_is_said() {
    let mesh = Mesh::closed(1, |p| p);
    let group = mesh.group();
    let missing = Accel::build(&[group], &[Instance::of(1)]).unwrap_err();
    assert!(matches!(
        missing,
        AccelError::GroupOutOfRange {
            group: 1,
            groups: 1,
            ..
        }
    ));
    let flat = Instance {
        group: 0,
        to_world: DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)),
    };
    let singular = Accel::build(&[group], &[Instance::of(0), flat]).unwrap_err();
    assert_eq!(singular, AccelError::SingularInstance { instance: 1 });
    let bad = Group {
        triangles: &[[0, 1, 2], [0, 1, 6]],
        ..group
    };
    let vertex = Accel::build(&[bad], &[]).unwrap_err();
    assert!(matches!(
        vertex,
        AccelError::VertexOutOfRange {
            triangle: 1,
            vertex: 6,
            ..
        }
    ));
}
