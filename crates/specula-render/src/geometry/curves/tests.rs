//! Surfaces of curves against doubles, and derivatives against differences.

use glam::{DMat3, DMat4, DVec3};
use specula_bsdf::Vec3;
use specula_bsdf::math::{Stream, vec3};
use specula_scene::scene::{
    CurveKind, CurveMesh, CurveMeshId, Geometry as SceneGeometry, Object, ObjectId, ObjectInstance,
    Shape, ribbon_normal,
};

use crate::accel::{CurveSegment, CurveShape, Ray};
use crate::convert::{narrow3, widen3};
use crate::geometry::{Partials, Surface};
use crate::options::RenderOptions;
use crate::prepared::PreparedScene;

const KINDS: [CurveKind; 3] = [CurveKind::Flat, CurveKind::Cylinder, CurveKind::Ribbon];

/// Two bent segments; ribbons turn by some way.
fn curves(kind: CurveKind) -> CurveMesh {
    let segment = |y: f32| {
        [
            [-1.0, y, 0.1],
            [-0.4, y + 0.3, 0.4],
            [0.5, y - 0.4, -0.3],
            [1.0, y, 0.2],
        ]
    };
    let normals = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]];
    CurveMesh {
        kind,
        segments: vec![segment(-0.5), segment(0.5)],
        width_at_ends: vec![[0.2, 0.3], [0.25, 0.1]],
        normals: match kind {
            CurveKind::Ribbon => vec![normals; 2],
            CurveKind::Flat | CurveKind::Cylinder => Vec::new(),
        },
        is_fibre: false,
    }
}

/// The curves under a transform of their own, in an object under another.
fn placed(kind: CurveKind, [own, outer]: [DMat4; 2], is_reversed: bool) -> PreparedScene {
    let mut scene = specula_scene::builtin::orbs();
    scene.curve_meshes.push(curves(kind));
    let material = scene.shapes[0].material;
    let geometry = SceneGeometry::Curves(CurveMeshId(0));
    let mut shape = Shape::new(geometry, own, material);
    shape.reverse_orientation = is_reversed;
    scene.shapes = Vec::new();
    scene.objects = vec![Object {
        name: String::new(),
        shapes: vec![shape],
    }];
    scene.instances = vec![ObjectInstance {
        object: ObjectId(0),
        to_world: outer,
        motion: None,
    }];
    PreparedScene::new(&scene, &RenderOptions::default()).unwrap()
}

/// What is known of a point of a curve, in the curve's own space and in doubles.
struct Reference {
    mesh: CurveMesh,
    segment: usize,
    /// Unit, of the ray.
    d: DVec3,
}

impl Reference {
    fn centre(&self, u: f64) -> DVec3 {
        let [a, b, c, d] = self.mesh.segments[self.segment].map(|p| DVec3::from(p.map(f64::from)));
        let v = 1.0 - u;
        a * (v * v * v) + b * (3.0 * v * v * u) + c * (3.0 * v * u * u) + d * (u * u * u)
    }

    fn slope(&self, u: f64) -> DVec3 {
        (self.centre(u + 1e-5) - self.centre(u - 1e-5)) / 2e-5
    }

    fn width(&self, u: f64) -> f64 {
        let [from, to] = self.mesh.width_at_ends[self.segment].map(f64::from);
        from + u * (to - from)
    }

    fn own_normal(&self, u: f64) -> DVec3 {
        ribbon_normal(self.mesh.normals[self.segment], u)
    }

    /// To the side to which v grows.
    fn across(&self, u: f64) -> DVec3 {
        self.d.cross(self.slope(u)).normalize()
    }

    fn position(&self, [u, v]: [f64; 2]) -> DVec3 {
        let factor = match self.mesh.kind {
            CurveKind::Ribbon => self.own_normal(u).dot(self.d).abs(),
            CurveKind::Flat | CurveKind::Cylinder => 1.0,
        };
        self.centre(u) + self.across(u) * ((v - 0.5) * factor * self.width(u))
    }

    fn normal(&self, [u, v]: [f64; 2]) -> DVec3 {
        let tangent = self.slope(u).normalize();
        match self.mesh.kind {
            CurveKind::Flat => self.across(u).cross(tangent),
            CurveKind::Cylinder => {
                // Turned about the tangent from the side towards the ray.
                let turn = glam::DQuat::from_axis_angle(tangent, core::f64::consts::PI * (v - 0.5));
                turn * self.across(u).cross(tangent)
            }
            CurveKind::Ribbon => self.own_normal(u).reject_from(tangent).normalize(),
        }
    }
}

fn near(found: Vec3<f32>, expected: DVec3, slack: f64, what: &str) {
    let error = (widen3(found) - expected).length();
    assert!(
        error < slack,
        "{what}: {found:?} instead of {expected}, {error}"
    );
}

/// Rays from random directions at a place of a curve, under both transforms.
fn compare(kind: CurveKind, transforms: [DMat4; 2], is_reversed: bool, random: &mut Stream) {
    let to_world = transforms[1] * transforms[0];
    let linear = DMat3::from_mat4(to_world);
    let scene = placed(kind, transforms, is_reversed);
    let geometry = &scene.geometry;
    let mut count = 0;
    for _ in 0..400 {
        let mut number = || f64::from(random.next::<f32>());
        let uv = [0.02 + 0.96 * number(), 0.03 + 0.94 * number()];
        let d = DVec3::new(number(), number(), number()) * 2.0 - 1.0;
        let reference = Reference {
            mesh: curves(kind),
            segment: usize::from(number() < 0.5),
            d: d.normalize(),
        };
        let target = reference.position(uv);
        let origin = to_world.transform_point3(target - reference.d * 2.0);
        let ray = Ray {
            origin: narrow3(origin),
            direction: narrow3(linear * reference.d),
            t_max: f32::INFINITY,
        };
        let Some(hit) = geometry.accel.intersect(&ray) else {
            // Seen from its edge.
            continue;
        };
        if (f64::from(hit.t) - 2.0).abs() > 1e-3 || hit.primitive as usize != reference.segment {
            continue;
        }
        let surface = geometry.surface(&ray, &hit, 0.0);
        // Rays are rounded, which matters where they go along the curve, and where they see the edge of a ribbon.
        let sine = (reference.slope(uv[0]).normalize().cross(reference.d)).length();
        let is_edge =
            kind == CurveKind::Ribbon && reference.own_normal(uv[0]).dot(reference.d).abs() < 0.1;
        if sine < 0.2 || is_edge {
            continue;
        }
        let what = format!("{kind:?} at {uv:?} from {d}");
        for (found, expected) in surface.uv.into_iter().zip(uv) {
            let error = (f64::from(found) - expected).abs();
            assert!(error < 5e-5, "{what}: {found} {expected}");
        }
        let uv = surface.uv.map(f64::from);
        near(
            surface.position,
            to_world.transform_point3(target),
            6e-5,
            &what,
        );
        let sign = if is_reversed { -1.0 } else { 1.0 };
        let n = (linear.inverse().transpose() * reference.normal(uv)).normalize() * sign;
        near(surface.ng, n, 3e-4, &what);
        near(surface.ns, n, 3e-4, &what);
        let partials = geometry.partials(&surface);
        let along = linear * reference.slope(uv[0]);
        near(surface.tangent, along, 1e-4, &what);
        near(partials.dp[0], along, 1e-4, &what);
        let own = reference.normal(uv);
        let mut across = reference.slope(uv[0]).cross(own).normalize();
        if across.dot(reference.across(uv[0])) < 0.0 {
            across = -across;
        }
        if (uv[1] - 0.5).abs() > 0.01 {
            let expected = linear * across * reference.width(uv[0]);
            near(partials.dp[1], expected, 2e-4, &what);
        }
        let least = surface.error.x.min(surface.error.y).min(surface.error.z);
        let half = linear * (target - reference.centre(uv[0]));
        assert!(f64::from(least) > half.length(), "{what}");
        if to_world == DMat4::IDENTITY {
            curvature(&reference, &surface, partials, sign);
        }
        count += 1;
    }
    assert!(count > 200, "{kind:?} {transforms:?}: {count}");
}

/// Derivatives of the normal against differences.
fn curvature(reference: &Reference, surface: &Surface, partials: Partials, sign: f64) {
    let uv = surface.uv.map(f64::from);
    let h = 1e-4;
    let slope = |step: [f64; 2]| {
        let [after, before] =
            [h, -h].map(|h| reference.normal([uv[0] + h * step[0], uv[1] + h * step[1]]));
        (after - before) * (sign / (2.0 * h))
    };
    let tangent = reference.slope(uv[0]).normalize();
    let [along, around] = partials.dn.map(widen3);
    // Without the twist.
    let expected = tangent * tangent.dot(slope([1.0, 0.0]));
    let scale = 1.0 + expected.length();
    assert!(
        (along - expected).length() < 2e-3 * scale,
        "{along} {expected}"
    );
    let expected = slope([0.0, 1.0]);
    assert!((around - expected).length() < 1e-3, "{around} {expected}");
}

#[test]
fn surfaces_and_derivatives_are_those_of_doubles() {
    let mut random = Stream::new(8);
    let turned = DMat4::from_translation(DVec3::new(0.3, -0.2, 1.0)) * DMat4::from_rotation_x(0.7);
    let similar = turned * DMat4::from_scale(DVec3::new(-1.2, 1.2, 1.2));
    let distorted = turned * DMat4::from_scale(DVec3::new(1.0, 0.6, 1.4));
    for kind in KINDS {
        for is_reversed in [false, true] {
            for own in [DMat4::IDENTITY, similar, distorted] {
                for outer in [DMat4::IDENTITY, distorted] {
                    compare(kind, [own, outer], is_reversed, &mut random);
                }
            }
        }
    }
}

/// Curves that a transform distorts or mirrors have a space of their own, others not.
#[test]
fn only_distorted_curves_are_placed_on_their_own() {
    let scale = |x: f64| DMat4::from_scale(DVec3::new(x, 1.0, 1.0)) * DMat4::from_rotation_y(0.3);
    for (own, identity) in [
        (scale(1.0), true),
        (scale(-1.0), false),
        (scale(0.5), false),
    ] {
        let scene = placed(CurveKind::Flat, [own, DMat4::IDENTITY], false);
        let placements = &scene.geometry.placements;
        assert_eq!(placements.len(), 1);
        assert_eq!(placements[0].identity, identity);
    }
}

/// Where control points coincide the tangent is that of the chord, and nothing is not a number.
#[test]
fn degenerate_curves_have_surfaces() {
    let [a, b] = [[0.0_f32; 3], [1.0, 2.0, 3.0]];
    let shapes = [
        CurveShape::Flat,
        CurveShape::Cylinder,
        CurveShape::Ribbon([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]),
    ];
    for controls in [
        [a, a, b, b],
        [a, b, a, b],
        [a, a, a, b],
        [a; 4],
        [b, a, a, b],
    ] {
        for shape in shapes {
            for width_at_ends in [[0.1, 0.2], [0.0, 0.1]] {
                let curve = CurveSegment {
                    controls,
                    width_at_ends,
                    shape,
                };
                for uv in [[0.0, 0.0], [0.5, 0.5], [1.0, 1.0], [0.0, 0.5]] {
                    for direction in [vec3(1.0, 2.0, 3.0), Vec3::X, Vec3::ZERO] {
                        let surface = curve.surface(uv, direction, false);
                        let own = [surface.position, surface.ng];
                        let (_, partials) = curve.partials(uv, own, false);
                        let all = partials.dp.into_iter().chain(partials.dn).chain(own);
                        for v in all.chain([surface.tangent, surface.error]) {
                            assert!(v.length().is_finite(), "{curve:?} {uv:?} {surface:?}");
                        }
                        assert!((surface.ng.length() - 1.0).abs() < 1e-5);
                        assert!(surface.tangent.length() > 0.0);
                    }
                }
            }
        }
    }
}
