//! Every invariant is checked: a scene that breaks it is found.

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;

use crate::image::Image;
use crate::scene::*;
use crate::summary::Summary;

fn scene() -> Scene {
    let grey = ColourParam::Value(Rgb::splat(0.5));
    let diffuse = MaterialKind::Diffuse {
        reflectance: grey,
        roughness: FloatParam::Value(0.0),
    };
    let shape = Shape {
        emission: Some(Emission {
            radiance: ColourParam::WHITE,
            two_sided: false,
        }),
        ..Shape::new(
            Geometry::Mesh(MeshId(0)),
            DMat4::from_translation(DVec3::X),
            MaterialId(0),
        )
    };
    let film = Film::new([4, 4], Filter::Box { radius: [0.5; 2] });
    let camera = Camera::look_at(DVec3::ZERO, DVec3::Z, DVec3::Y, 90.0, &film);
    let settings = Settings {
        samples_per_pixel: 1,
        ..Settings::default()
    };
    Scene {
        images: vec![Image {
            name: "i".into(),
            width: 1,
            height: 1,
            pixels: vec![[1.0; 3]].into(),
        }],
        textures: vec![
            Texture::Constant(Rgb::WHITE),
            Texture::Scale {
                a: TextureId(0),
                b: TextureId(0),
            },
        ],
        materials: vec![Material::new(diffuse)],
        meshes: vec![Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        }],
        shapes: vec![shape.clone()],
        objects: vec![Object {
            name: "o".into(),
            shapes: vec![shape.clone(), shape],
        }],
        instances: vec![ObjectInstance {
            object: ObjectId(0),
            to_world: DMat4::IDENTITY,
            motion: None,
        }],
        lights: vec![Light::Distant {
            irradiance: Rgb::WHITE,
            to_light: [0.0, 0.0, 1.0],
            half_angle_deg: 0.0,
        }],
        ..Scene::empty(camera, film, settings)
    }
}

#[test]
fn a_good_scene_is_valid_and_counted() {
    let scene = scene();
    scene.validate().unwrap();
    let summary = Summary::of(&scene);
    assert_eq!(
        (
            summary.triangles,
            summary.triangles_shown,
            summary.instances
        ),
        (1, 3, 1)
    );
    assert_eq!(summary.shapes["mesh"], 3);
    assert_eq!(summary.lights["area"], 3);
    assert_eq!(summary.lights["distant"], 1);
    assert_eq!(summary.bounds.max, DVec3::new(2.0, 1.0, 0.0));
}

/// Breaks one invariant.
type Fault = fn(&mut Scene);

#[test]
fn every_broken_invariant_is_found() {
    let faults: [(&str, Fault); 20] = [
        ("film", |s| s.film.crop = [0, 5, 0, 4]),
        ("film", |s| s.film.exposure = 0.0),
        ("filter", |s| {
            s.film.filter = Filter::Gaussian {
                radius: [1.0; 2],
                sigma: 0.0,
            }
        }),
        ("camera", |s| {
            s.camera.projection = Projection::Perspective { fov_deg: 180.0 }
        }),
        ("camera", |s| s.camera.to_world = DMat4::ZERO),
        ("settings", |s| s.settings.samples_per_pixel = 0),
        ("image 0 (i)", |s| {
            s.images[0].pixels = vec![[1.0, f32::NAN, 1.0]].into()
        }),
        ("image 0 (i)", |s| s.images[0].width = 2),
        ("texture 1", |s| {
            s.textures[1] = Texture::Scale {
                a: TextureId(1),
                b: TextureId(0),
            }
        }),
        ("material 0", |s| {
            s.materials[0].kind = MaterialKind::ThinDielectric {
                eta: 0.0,
                reflection_tint: ColourParam::WHITE,
                transmission_tint: ColourParam::WHITE,
            }
        }),
        ("material 0", |s| {
            let amount = FloatParam::Value(0.5);
            s.materials[0].kind = MaterialKind::Mix {
                materials: [MaterialId(0); 2],
                amount,
            };
        }),
        ("mesh 0", |s| s.meshes[0].triangles[0][2] = 3),
        ("mesh 0", |s| s.meshes[0].normals = vec![[0.0; 3]; 3]),
        ("mesh 0", |s| s.meshes[0].uvs = vec![[0.0; 2]; 2]),
        ("shape 0", |s| {
            s.shapes[0].geometry = Geometry::Sphere { radius: -1.0 }
        }),
        ("shape 1 of object o", |s| {
            s.objects[0].shapes[1].material = MaterialId(1)
        }),
        ("instance 0", |s| s.instances[0].object = ObjectId(1)),
        ("light 0", |s| {
            let to_light = [0.0, 0.0, 2.0];
            s.lights[0] = Light::Distant {
                irradiance: Rgb::WHITE,
                to_light,
                half_angle_deg: 0.0,
            };
        }),
        ("scene", |s| s.floor = Some(MaterialId(1))),
        ("scene", |s| {
            s.shapes[0].to_world = DMat4::from_translation(DVec3::splat(1e19))
        }),
    ];
    for (what, fault) in faults {
        let mut scene = scene();
        fault(&mut scene);
        let error = scene.validate().expect_err(what);
        assert_eq!(error.what(), what, "{error}");
    }
}

#[test]
fn broken_lenses_and_portals_are_found() {
    let faults: [(&str, Fault); 2] = [
        ("camera", |s| {
            s.camera.projection = Projection::Lenses(Box::new(LensSystem {
                interfaces: Vec::new(),
                stop: None,
                film_diagonal: 1.0,
            }));
        }),
        ("light 0", |s| {
            s.lights[0] = Light::Portal {
                radiance: Rgb::WHITE,
                image: None,
                to_world: DMat4::IDENTITY,
                corners: [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 2.0, 0.0]],
            };
        }),
    ];
    for (what, fault) in faults {
        let mut scene = scene();
        fault(&mut scene);
        let error = scene.validate().expect_err(what);
        assert_eq!(error.what(), what, "{error}");
    }
}

#[test]
fn all_broken_parts_are_found_at_once() {
    let mut scene = scene();
    scene.film.exposure = 0.0;
    scene.meshes[0].triangles[0][2] = 3;
    scene.instances[0].object = ObjectId(1);
    let mut found = Vec::new();
    let all: Result<(), ()> = scene.each_fault(|fault| {
        found.push(fault.what().to_owned());
        Ok(())
    });
    assert_eq!(all, Ok(()));
    assert_eq!(found, ["film", "mesh 0", "instance 0"]);
}
