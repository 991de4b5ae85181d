//! Footprints against the differences of neighbouring camera rays, on planes and behind curved mirrors and glass.

use glam::{DMat4, DVec3};
use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::Scene;
use specula_scene::scene::{
    Camera, Film, Filter, Geometry as Shapes, Material, MaterialId, MaterialKind, Mesh, MeshId,
    ObjectId, Settings, Shape,
};

use super::*;
use crate::accel::Ray;
use crate::ray_cone::{Bounce, RayCone};
use crate::{PreparedScene, RenderOptions};

const SIZE: [u32; 2] = [200, 150];

/// A scene without lights, seen from `(0, -6, 2)`.
fn scene(towards: DVec3) -> Scene {
    let film = Film::new(SIZE, Filter::Box { radius: [0.5; 2] });
    let from = DVec3::new(0.0, -6.0, 2.0);
    let camera = Camera::look_at(from, towards, DVec3::Z, 40.0, &film);
    let settings = Settings {
        max_depth: 5,
        samples_per_pixel: 1,
        hide_emitters: false,
        energy: specula_scene::Energy::None,
    };
    let mut scene = Scene::empty(camera, film, settings);
    let nothing = MaterialKind::Diffuse {
        reflectance: specula_scene::scene::ColourParam::WHITE,
        roughness: specula_scene::scene::FloatParam::Value(0.0),
    };
    scene.materials.push(Material::new(nothing));
    scene
}

/// Adds a plane through the origin with coordinates that are sheared, and another set of them.
fn add_plane(scene: &mut Scene, to_world: DMat4) {
    let corners = [[-50.0, -50.0], [50.0, -50.0], [50.0, 50.0], [-50.0, 50.0]];
    scene.meshes.push(Mesh {
        positions: corners.map(|[x, y]: [f32; 2]| [x, y, 0.0]).to_vec(),
        uvs: corners.map(|[x, y]| [0.3 * x + 0.1 * y, 0.7 * y]).to_vec(),
        second_uvs: corners.map(|[x, y]| [y, -2.0 * x]).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    });
    let mesh = Shapes::Mesh(MeshId(scene.meshes.len() - 1));
    scene.shapes.push(Shape::new(mesh, to_world, MaterialId(0)));
}

fn add_sphere(scene: &mut Scene, radius: f32, centre: [f64; 3]) {
    let to_world = DMat4::from_translation(centre.into());
    let sphere = Shapes::Sphere { radius };
    scene
        .shapes
        .push(Shape::new(sphere, to_world, MaterialId(0)));
}

fn prepared(scene: &Scene) -> PreparedScene {
    PreparedScene::new(scene, &RenderOptions::from_scene(scene)).unwrap()
}

fn surface(scene: &PreparedScene, origin: Vec3<f32>, direction: Vec3<f32>) -> Surface {
    let ray = Ray {
        origin,
        direction,
        t_max: f32::INFINITY,
    };
    let hit = scene.geometry.accel.intersect(&ray).unwrap();
    scene.geometry.surface(&ray, &hit, 0.0)
}

/// Squares of the half axes of the ellipse with these conjugate ones.
fn squared_axes([a, b]: [[f32; 2]; 2]) -> [f32; 2] {
    let (xx, yy) = (a[0] * a[0] + b[0] * b[0], a[1] * a[1] + b[1] * b[1]);
    let xy = a[0] * a[1] + b[0] * b[1];
    let root = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    let long = 0.5 * (xx + yy) + root;
    [long, (xx * yy - xy * xy) / long]
}

fn assert_alike(found: [[f32; 2]; 2], expected: [[f32; 2]; 2], tolerance: f32, what: &str) {
    let (f, e) = (squared_axes(found), squared_axes(expected));
    for (f, e) in f.into_iter().zip(e) {
        let ratio = (f / e).sqrt();
        assert!((ratio - 1.0).abs() < tolerance, "{what}: {ratio} of {e:?}");
    }
    // The ellipses, not their axes alone: what each gives along diagonals.
    for [x, y] in [[1.0, 0.0], [0.0, 1.0], [0.7, 0.7], [0.7, -0.7]] {
        let extent = |axes: [[f32; 2]; 2]| {
            axes.map(|a| (a[0] * x + a[1] * y).powi(2))
                .iter()
                .sum::<f32>()
                .sqrt()
        };
        let ratio = extent(found) / extent(expected);
        assert!(
            (ratio - 1.0).abs() < 2.0 * tolerance,
            "{what}, along {x} {y}: {ratio}"
        );
    }
}

/// Changes of a point's coordinates by a pixel to the right and one down.
fn differences(raster: [f32; 2], coordinates: impl Fn([f32; 2]) -> [f32; 2]) -> [[f32; 2]; 2] {
    const STEP: f32 = 0.25;
    [[STEP, 0.0], [0.0, STEP]].map(|[dx, dy]| {
        let a = coordinates([raster[0] - dx, raster[1] - dy]);
        let b = coordinates([raster[0] + dx, raster[1] + dy]);
        [0, 1].map(|i| (b[i] - a[i]) / (2.0 * STEP))
    })
}

#[test]
fn planes_are_covered_as_neighbouring_rays_cover_them() {
    for (tilt_deg, in_object) in [(0.0, false), (35.0, true), (-60.0, false), (-70.0, true)] {
        let mut file = scene(DVec3::ZERO);
        let tilt = DMat4::from_rotation_x(f64::to_radians(tilt_deg))
            * DMat4::from_rotation_z(0.4)
            * DMat4::from_scale(DVec3::new(1.5, 0.8, 1.0));
        add_plane(&mut file, if in_object { DMat4::IDENTITY } else { tilt });
        if in_object {
            let shapes = std::mem::take(&mut file.shapes);
            file.objects.push(specula_scene::scene::Object {
                name: "plane".into(),
                shapes,
            });
            file.instances.push(specula_scene::scene::ObjectInstance {
                object: ObjectId(0),
                to_world: tilt,
                motion: None,
            });
        }
        let scene = prepared(&file);
        for raster in [[100.0, 75.0], [60.0, 95.0], [150.0, 130.0]] {
            let hit = |raster: [f32; 2]| {
                let (origin, direction) = scene.camera.ray(raster, [0.5; 2]);
                (surface(&scene, origin, direction), origin, direction)
            };
            let (here, origin, direction) = hit(raster);
            let distance = (here.position - origin).length();
            let cone = scene.camera.cone(0.0, raster).at(distance);
            let footprint = (scene.geometry).footprint(&here, direction, cone.radius);
            let what = format!("tilted by {tilt_deg}, {raster:?}");
            // A pixel 20 degrees off the axis is an ellipse of ratio 1.06.
            let of_uv = differences(raster, |r| hit(r).0.uv);
            assert_alike(footprint.uv, of_uv, 0.04, &what);
            let of_second = differences(raster, |r| hit(r).0.second_uv);
            assert_alike(footprint.second_uv, of_second, 0.04, &what);
        }
    }
}

#[test]
fn spheres_are_covered_as_neighbouring_rays_cover_them() {
    let mut file = scene(DVec3::new(0.0, 0.0, 0.5));
    add_sphere(&mut file, 1.7, [0.0, 0.0, 0.5]);
    let scene = prepared(&file);
    for raster in [[100.0, 75.0], [72.0, 60.0], [115.0, 105.0]] {
        let hit = |raster: [f32; 2]| {
            let (origin, direction) = scene.camera.ray(raster, [0.5; 2]);
            (surface(&scene, origin, direction), origin, direction)
        };
        let (here, origin, direction) = hit(raster);
        let distance = (here.position - origin).length();
        let cone = scene.camera.cone(0.0, raster).at(distance);
        let footprint = (scene.geometry).footprint(&here, direction, cone.radius);
        let expected = differences(raster, |r| hit(r).0.uv);
        assert_alike(footprint.uv, expected, 0.04, &format!("{raster:?}"));
        let curvature = scene.geometry.mean_curvature(&here);
        assert!((curvature * 1.7 - 1.0).abs() < 1e-3, "{curvature}");
    }
}

/// A wall behind the camera in a convex mirror: the cone spreads by the curvature.
#[test]
fn mirrors_spread_cones_by_their_curvature() {
    let mut file = scene(DVec3::new(0.0, 0.0, 2.0));
    add_sphere(&mut file, 1.5, [0.0, 0.0, 2.0]);
    let wall = DMat4::from_translation(DVec3::new(0.0, -9.0, 0.0))
        * DMat4::from_rotation_x(-core::f64::consts::FRAC_PI_2);
    add_plane(&mut file, wall);
    let scene = prepared(&file);
    let reflect = |raster: [f32; 2], cone: RayCone| {
        let (origin, direction) = scene.camera.ray(raster, [0.5; 2]);
        let mirror = surface(&scene, origin, direction);
        let cone = cone.at((mirror.position - origin).length());
        let cone = cone.after(Bounce::Mirror, || scene.geometry.mean_curvature(&mirror), 0);
        let n = mirror.ns;
        let reflected = direction - n * (2.0 * n.dot(direction));
        let start = mirror.position + n * 1e-4;
        let wall = surface(&scene, start, reflected);
        let cone = cone.at((wall.position - start).length());
        (
            scene.geometry.footprint(&wall, reflected, cone.radius),
            wall.uv,
        )
    };
    for raster in [[100.0, 75.0], [104.0, 75.0], [98.0, 70.0]] {
        let (footprint, _) = reflect(raster, scene.camera.cone(0.0, raster));
        let expected = differences(raster, |r| reflect(r, RayCone::NONE).1);
        assert_alike(footprint.uv, expected, 0.03, &format!("{raster:?}"));
    }
}

/// The floor through a ball of glass, in its middle: two refractions, the second one out of glass.
#[test]
fn glass_balls_focus_cones() {
    let mut file = scene(DVec3::new(0.0, 0.0, 2.0));
    add_sphere(&mut file, 1.0, [0.0, -2.0, 2.0]);
    let wall = DMat4::from_translation(DVec3::new(0.0, 4.0, 2.0))
        * DMat4::from_rotation_x(core::f64::consts::FRAC_PI_2);
    add_plane(&mut file, wall);
    let scene = prepared(&file);
    let eta = 1.5_f32;
    let refract = |d: Vec3<f32>, n: Vec3<f32>, eta: f32| {
        let cosine = -n.dot(d);
        let inner = (1.0 - (1.0 - cosine * cosine) / (eta * eta)).sqrt();
        d * (1.0 / eta) + n * (cosine / eta - inner)
    };
    let through = |raster: [f32; 2], cone: RayCone| {
        let (origin, direction) = scene.camera.ray(raster, [0.5; 2]);
        let front = surface(&scene, origin, direction);
        let curvature = scene.geometry.mean_curvature(&front);
        let cone = cone.at((front.position - origin).length());
        let cone = cone.after(Bounce::Refraction { eta }, || curvature, 0);
        let inside = refract(direction, front.ns, eta);
        let start = front.position - front.ns * 1e-4;
        let back = surface(&scene, start, inside);
        let cone = cone.at((back.position - start).length());
        let leaving = Bounce::Refraction { eta: 1.0 / eta };
        let cone = cone.after(leaving, || -scene.geometry.mean_curvature(&back), 0);
        let outside = refract(inside, -back.ns, 1.0 / eta);
        let start = back.position + back.ns * 1e-4;
        let wall = surface(&scene, start, outside);
        let cone = cone.at((wall.position - start).length());
        (
            scene.geometry.footprint(&wall, outside, cone.radius),
            wall.uv,
        )
    };
    for raster in [[100.0, 75.0], [103.0, 77.0]] {
        let (footprint, _) = through(raster, scene.camera.cone(0.0, raster));
        let expected = differences(raster, |r| through(r, RayCone::NONE).1);
        assert_alike(footprint.uv, expected, 0.05, &format!("{raster:?}"));
    }
}

#[test]
fn weights_are_those_of_the_nearest_combination() {
    let (a, b) = (vec3(1.0_f32, 2.0, 0.0), vec3(0.5, -1.0, 3.0));
    let [x, y] = weights_of(a * 0.3 - b * 2.0 + a.cross(b) * 5.0, [a, b]);
    assert!((x - 0.3).abs() < 1e-5 && (y + 2.0).abs() < 1e-5);
    assert_eq!(weights_of(a, [a, a * 2.0]), [0.0; 2]);
}
