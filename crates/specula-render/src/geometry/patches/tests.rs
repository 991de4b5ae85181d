//! Surfaces of patches against doubles, and derivatives against differences.

use glam::{DMat2, DMat4, DVec2};
use specula_scene::scene::{
    Geometry as SceneGeometry, Object, ObjectId, ObjectInstance, PatchMesh, PatchMeshId, Shape,
};

use super::*;
use crate::accel::Ray;
use crate::convert::{normal_matrix, widen3};
use crate::options::RenderOptions;
use crate::prepared::PreparedScene;

/// A patch in the world, in doubles.
struct Reference {
    mesh: PatchMesh,
    /// From the shape's space to that of its group, and from there to the world.
    own: DMat4,
    outer: DMat4,
    sign: f64,
}

fn mix([a, b, c, d]: [DVec3; 4], [u, v]: [f64; 2]) -> DVec3 {
    a.lerp(b, u).lerp(c.lerp(d, u), v)
}

fn turned(m: &DMat4, n: DVec3) -> DVec3 {
    (normal_matrix(m) * n).normalize()
}

impl Reference {
    fn values(&self, of: &[[f32; 3]]) -> [DVec3; 4] {
        self.mesh.patches[0].map(|i| DVec3::from(of[i as usize].map(f64::from)))
    }

    fn position(&self, uv: [f64; 2]) -> DVec3 {
        let p = mix(self.values(&self.mesh.positions), uv);
        (self.outer * self.own).transform_point3(p)
    }

    /// The normal of the surface, on the side of `dp/du x dp/dv`, or on the other of a reversed shape.
    fn own_normal(&self, [u, v]: [f64; 2]) -> DVec3 {
        let [a, b, c, d] = self.values(&self.mesh.positions);
        let n = (b - a).lerp(d - c, v).cross((c - a).lerp(d - b, u));
        turned(&(self.outer * self.own), n) * self.sign
    }

    fn shading_normal(&self, uv: [f64; 2]) -> DVec3 {
        if self.mesh.normals.is_empty() {
            return self.own_normal(uv);
        }
        // They are interpolated in the group.
        let normals = self.values(&self.mesh.normals);
        let n = mix(normals.map(|n| turned(&self.own, n)), uv);
        turned(&self.outer, n) * self.sign
    }

    fn texture(&self, uv: [f64; 2]) -> DVec2 {
        if self.mesh.uvs.is_empty() {
            return uv.into();
        }
        let corners = self.mesh.patches[0].map(|i| {
            let [s, t] = self.mesh.uvs[i as usize].map(f64::from);
            DVec3::new(s, t, 0.0)
        });
        mix(corners, uv).truncate()
    }

    /// Where the texture coordinates are `wanted`, near a point: Newton's method with differences.
    fn find(&self, wanted: DVec2, near: [f64; 2]) -> [f64; 2] {
        let h = 1e-6;
        let mut at = DVec2::from(near);
        for _ in 0..8 {
            let slope = |d: DVec2| {
                let [before, after] = [at - d * h, at + d * h].map(|p| self.texture(p.into()));
                (after - before) / (2.0 * h)
            };
            let slopes = DMat2::from_cols(slope(DVec2::X), slope(DVec2::Y));
            at += slopes.inverse() * (wanted - self.texture(at.into()));
        }
        at.into()
    }
}

fn mesh(with_uvs: bool, with_normals: bool) -> PatchMesh {
    let mut mesh = PatchMesh {
        // The first is of no patch.
        positions: vec![
            [5.0; 3],
            [-0.9, -1.1, 0.3],
            [1.0, -0.8, -0.4],
            [-1.2, 0.9, -0.3],
            [0.8, 1.1, 0.7],
        ],
        uvs: vec![[9.0; 2], [0.1, 2.0], [0.4, -0.5], [1.9, 1.8], [2.3, 0.2]],
        normals: vec![
            [1.0, 0.0, 0.0],
            [0.1, 0.2, 2.0],
            [-0.3, 0.0, 1.0],
            [0.0, 0.4, 1.0],
            [0.2, -0.3, 0.9],
        ],
        patches: vec![[1, 2, 3, 4]],
        are_polygons: false,
    };
    if !with_uvs {
        mesh.uvs.clear();
    }
    if !with_normals {
        mesh.normals.clear();
    }
    mesh
}

/// A scene of the patch alone: in the world, or in an instance where the outer transform is not the identity.
fn prepared(reference: &Reference) -> PreparedScene {
    let mut scene = specula_scene::builtin::orbs();
    let material = scene.shapes[0].material;
    scene.patch_meshes = vec![reference.mesh.clone()];
    let geometry = SceneGeometry::Patches(PatchMeshId(0));
    let mut shape = Shape::new(geometry, reference.own, material);
    shape.reverse_orientation = reference.sign < 0.0;
    scene.shapes = vec![shape];
    if reference.outer != DMat4::IDENTITY {
        scene.objects = vec![Object {
            name: String::new(),
            shapes: std::mem::take(&mut scene.shapes),
        }];
        scene.instances = vec![ObjectInstance {
            object: ObjectId(0),
            to_world: reference.outer,
            motion: None,
        }];
    }
    PreparedScene::new(&scene, &RenderOptions::default()).unwrap()
}

fn near(found: Vec3<f32>, expected: DVec3, slack: f64, what: &str) {
    let error = (widen3(found) - expected).length();
    assert!(
        error < slack,
        "{what}: {found:?} instead of {expected}, {error}"
    );
}

/// The surface and the derivatives at a point, from both sides.
fn compare(reference: &Reference, scene: &PreparedScene, uv: [f64; 2], what: &str) {
    let geometry = &scene.geometry;
    let (target, n) = (reference.position(uv), reference.own_normal(uv));
    let ns = reference.shading_normal(uv);
    let ng = if n.dot(ns) > 0.0 { n } else { -n };
    for side in [1.0, -1.0] {
        let ray = Ray {
            origin: narrow3(target + n * (0.05 * side)),
            direction: narrow3(n * -side),
            t_max: f32::INFINITY,
        };
        let hit = geometry.accel.intersect(&ray).expect("it is met");
        assert!(geometry.quadric(&hit).is_none() && geometry.coordinates(&hit).is_none());
        let surface = geometry.surface(&ray, &hit, 0.0);
        near(surface.position, target, 3e-6, what);
        near(surface.ng, ng, 5e-6, what);
        near(surface.ns, ns, 5e-6, what);
        let st = reference.texture(uv);
        let found = DVec2::from(surface.uv.map(f64::from));
        assert!((found - st).length() < 5e-6, "{what}: {found} {st}");
        let partials = geometry.partials(&surface);
        for (k, axis) in [DVec2::X, DVec2::Y].into_iter().enumerate() {
            let h = 1e-4;
            let [before, after] = [-h, h].map(|h| reference.find(st + axis * h, uv));
            let slope = |f: &dyn Fn([f64; 2]) -> DVec3| (f(after) - f(before)) / (2.0 * h);
            let dp = slope(&|uv| reference.position(uv));
            let dn = slope(&|uv| reference.shading_normal(uv));
            near(partials.dp[k], dp, 2e-5 * (1.0 + dp.length()), what);
            near(partials.dn[k], dn, 2e-4 * (1.0 + dn.length()), what);
            if k == 0 {
                let unit = unit_or(surface.tangent, Vec3::ZERO);
                near(unit, dp.normalize(), 2e-5, what);
            }
        }
    }
}

#[test]
fn surfaces_and_derivatives_are_those_of_doubles() {
    let place = DMat4::from_translation(DVec3::new(0.3, -0.2, 2.0))
        * DMat4::from_rotation_x(0.7)
        * DMat4::from_scale(DVec3::new(1.0, 0.6, 1.4));
    for case in 0..32_u8 {
        let [
            with_uvs,
            with_normals,
            is_reversed,
            is_mirrored,
            is_instanced,
        ] = [0, 1, 2, 3, 4].map(|bit| case >> bit & 1 == 1);
        let x = if is_mirrored { -1.0 } else { 1.0 };
        let mirror = DMat4::from_scale(DVec3::new(x, 1.0, 1.0));
        let [own, outer] = if is_instanced {
            [mirror, place]
        } else {
            [place * mirror, DMat4::IDENTITY]
        };
        let reference = Reference {
            mesh: mesh(with_uvs, with_normals),
            own,
            outer,
            sign: if is_reversed { -1.0 } else { 1.0 },
        };
        let scene = prepared(&reference);
        for i in 0..25 {
            let uv = [i % 5, i / 5].map(|k| 0.02 + 0.24 * f64::from(k));
            let what = format!("case {case} at {uv:?}");
            compare(&reference, &scene, uv, &what);
        }
    }
}

#[test]
fn collapsed_edges_have_the_normals_next_to_them() {
    for corners in [[1, 1, 3, 4], [1, 2, 3, 3], [1, 2, 1, 4], [2, 1, 4, 1]] {
        let reference = Reference {
            mesh: PatchMesh {
                patches: vec![corners],
                ..mesh(false, false)
            },
            own: DMat4::IDENTITY,
            outer: DMat4::IDENTITY,
            sign: 1.0,
        };
        let scene = prepared(&reference);
        let (group, shape) = (&scene.geometry.groups[0], &scene.geometry.shapes[0]);
        for weights in [
            [0.0, 0.0],
            [1.0, 0.0],
            [0.0, 1.0],
            [1.0, 1.0],
            [0.5, 0.0],
            [0.0, 0.5],
        ] {
            let at = PrimitiveLocation {
                weights,
                ..PrimitiveLocation::default()
            };
            let surface = group.patch_surface(&at, shape);
            let inner = weights.map(|x| f64::from(x) + (0.5 - f64::from(x)) * 1e-3);
            near(surface.ng, reference.own_normal(inner), 2e-3, "normal");
            let (_, partials) = group.patch_partials(&at, shape);
            let all = partials.dp.iter().chain(&partials.dn);
            assert!(all.into_iter().all(|d| d.length().is_finite()));
        }
    }
}
