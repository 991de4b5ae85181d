//! Scenes written and read back.

use super::*;
use crate::image::Image;
use crate::scene::{
    Bump, CoatMedium, ColourParam, ConductorFresnel, EnvironmentMapping, FloatParam,
    ImageProjection, Interpolation, Light, Material, MaterialKind, Profile, Roughness,
    RoughnessMapping, Texture, TextureMapping, Wrap,
};

/// Writes a scene and reads it back.
fn round_trip(scene: &Scene) -> (Scene, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.pbrt");
    let notes = write_pbrt(scene, &path).unwrap();
    let loaded = crate::load(&path).unwrap();
    let warnings: Vec<_> = loaded.warnings.iter().map(|w| w.message()).collect();
    assert!(warnings.is_empty(), "{warnings:?}");
    (loaded.scene, notes)
}

#[test]
fn lenses_survive() {
    let interface =
        |curvature_radius, thickness, eta, aperture_radius| crate::scene::LensInterface {
            curvature_radius,
            thickness,
            eta,
            aperture_radius,
        };
    let mut lenses = crate::scene::LensSystem {
        interfaces: vec![
            interface(0.1, 0.0031, 1.5168, 0.02),
            interface(-0.08, 0.0045, 1.0, 0.02),
            interface(0.0, 0.09, 1.0, 0.0033),
        ],
        stop: crate::scene::StopPicture::new(2, &[1.0, 2.0, 0.0, 3.0]),
        film_diagonal: 0.0345,
    };
    let mut scene = crate::builtin::orbs();
    scene.camera.focal_distance = 3.0;
    let film = lenses
        .thick_lens()
        .and_then(|l| l.film_distance(3.0))
        .unwrap();
    lenses.interfaces[2].thickness = film;
    scene.camera.projection = Projection::Lenses(Box::new(lenses.clone()));
    let (back, notes) = round_trip(&scene);
    assert!(notes.is_empty(), "{notes:?}");
    let Projection::Lenses(read) = &back.camera.projection else {
        panic!("{:?}", back.camera)
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 + 1e-9 * b.abs(), "{a} and {b}");
    for (a, b) in read.interfaces.iter().zip(&lenses.interfaces) {
        near(a.curvature_radius, b.curvature_radius);
        near(a.thickness, b.thickness);
        near(a.eta, b.eta);
        near(a.aperture_radius, b.aperture_radius);
    }
    near(read.film_diagonal, lenses.film_diagonal);
    let (a, b) = (read.stop.as_ref().unwrap(), lenses.stop.as_ref().unwrap());
    assert_eq!([a.width, a.height], [2, 2]);
    // Half floats.
    let errors = a.values.iter().zip(&b.values).map(|(a, b)| (a - b).abs());
    assert!(errors.fold(0.0, f32::max) < 2e-3, "{a:?} and {b:?}");
}

#[test]
fn the_built_in_scene_survives() {
    let scene = crate::builtin::orbs();
    let (back, notes) = round_trip(&scene);
    assert!(notes.is_empty(), "{notes:?}");
    assert_eq!(back.film.resolution, scene.film.resolution);
    // pbrt's scenes scatter singly: here every metal asks for compensation itself.
    let single = crate::scene::Settings {
        energy: crate::Energy::None,
        ..scene.settings.clone()
    };
    assert_eq!(back.settings, single);
    let is_metal = |m: &&Material| matches!(m.kind, MaterialKind::Conductor { .. });
    let mut metals = back.materials.iter().filter(is_metal).peekable();
    assert!(metals.peek().is_some());
    assert!(metals.all(|m| m.energy == Some(scene.settings.energy)));
    assert_eq!(back.camera.projection, scene.camera.projection);
    assert!(
        back.camera
            .to_world
            .abs_diff_eq(scene.camera.to_world, 1e-5)
    );
    assert_eq!(back.shapes.len(), scene.shapes.len());
    for (a, b) in scene.shapes.iter().zip(&back.shapes) {
        let mesh = |scene: &Scene, shape: &crate::scene::Shape| match shape.geometry {
            crate::scene::Geometry::Mesh(id) => scene.meshes[id.0].clone(),
            other => panic!("{other:?}"),
        };
        assert_eq!(mesh(&scene, a), mesh(&back, b));
        assert!(a.to_world.abs_diff_eq(b.to_world, 1e-5));
        assert_eq!(a.emission, b.emission);
        assert_eq!(
            summary_of(&scene, a.material),
            summary_of(&back, b.material)
        );
    }
}

#[test]
fn small_meshes_are_within_a_text_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("alone.pbrt");
    let given = "WorldBegin\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \
                 \"point3 P\" [ 0 0 0.1 1 0 0 1 1 0 0 1 1e-7 ] \"point2 uv\" [ 0 0 1 0 1 1 0 1 ]";
    std::fs::write(&path, given).unwrap();
    let mut scene = crate::load(&path).unwrap().scene;
    let (text, notes) = pbrt_text(&scene, &path).unwrap();
    assert!(notes.is_empty() && !text.contains("plymesh"), "{notes:?}");
    std::fs::write(&path, text).unwrap();
    assert_eq!(crate::load(&path).unwrap().scene.meshes, scene.meshes);
    let triangles = &mut scene.meshes[0].triangles;
    *triangles = triangles.repeat(10_001);
    let (text, notes) = pbrt_text(&scene, &path).unwrap();
    assert!(
        text.contains("plymesh") && notes[0].contains("specula convert"),
        "{notes:?}"
    );
}

/// What a material is, without the indices of its textures.
fn summary_of(scene: &Scene, id: crate::scene::MaterialId) -> String {
    match scene.materials[id.0].kind {
        MaterialKind::Diffuse { .. } => "diffuse".to_owned(),
        // pbrt-v4's walks have a limit.
        MaterialKind::CoatedDiffuse {
            reflectance,
            eta,
            roughness,
            medium,
            lossless,
        } => format!(
            "{reflectance:?} {eta} {roughness:?} {:?} {lossless}",
            medium.thickness
        ),
        ref kind => format!("{kind:?}"),
    }
}

#[test]
fn squared_roughness_displacement_and_energy_survive() {
    let mut scene = crate::builtin::orbs();
    scene.textures.push(Texture::Constant(Rgb::splat(0.5)));
    let texture = crate::scene::TextureId(scene.textures.len() - 1);
    let mut material = Material::new(MaterialKind::CoatedDiffuse {
        reflectance: ColourParam::Value(Rgb::from([0.25, 0.5, 0.75])),
        eta: 1.5,
        roughness: Roughness {
            v: FloatParam::Texture(texture),
            ..Roughness::isotropic(FloatParam::Value(0.5), RoughnessMapping::Square)
        },
        medium: CoatMedium {
            thickness: FloatParam::Value(0.25),
            max_depth: Some(7),
            ..CoatMedium::default()
        },
        lossless: false,
    });
    material.bump = Some(Bump::Height(FloatParam::Texture(texture)));
    material.energy = Some(crate::Energy::Multibounce(Default::default()));
    scene.materials.push(material);
    let last = crate::scene::MaterialId(scene.materials.len() - 1);
    scene.shapes[0].material = last;
    let (back, notes) = round_trip(&scene);
    assert!(notes.is_empty(), "{notes:?}");
    let found = &back.materials[back.shapes[0].material.0];
    let MaterialKind::CoatedDiffuse {
        eta,
        roughness,
        medium,
        ..
    } = found.kind
    else {
        panic!("{found:?}")
    };
    assert_eq!((eta, roughness.u), (1.5, FloatParam::Value(0.25)));
    assert_eq!(medium.thickness, FloatParam::Value(0.25));
    assert_eq!(medium.max_depth, Some(7));
    let FloatParam::Texture(v) = roughness.v else {
        panic!("{roughness:?}")
    };
    assert!(matches!(back.textures[v.0], Texture::Scale { a, b } if a == b));
    assert!(matches!(found.bump, Some(Bump::Height(_))));
    assert_eq!(found.energy, scene.materials[last.0].energy);
}

/// Radiance of the environments, pixel by pixel.
fn skies(scene: &Scene) -> Vec<Vec<Rgb<f32>>> {
    let sky = |light: &Light| match light {
        Light::Infinite {
            radiance,
            image: Some((id, EnvironmentMapping::EqualAreaOctahedral)),
            ..
        } => {
            let pixels = scene.images[id.0].pixels.iter();
            pixels.map(|p| Rgb::from(p) * *radiance).collect()
        }
        other => panic!("{other:?}"),
    };
    scene.lights.iter().map(sky).collect()
}

#[test]
fn every_environment_keeps_its_own_light() {
    let mut scene = crate::builtin::orbs();
    scene.lights.clear();
    for (low, width) in [(0.5, 4_u8), (8.0, 2)] {
        let pixels = (0..width * width).map(|i| [low, 2.0 * low, f32::from(i) * 0.25]);
        scene.images.push(Image {
            name: "sky".to_owned(),
            width: u32::from(width),
            height: u32::from(width),
            pixels: pixels.collect(),
        });
    }
    let last = scene.images.len() - 1;
    // One picture twice, in two colours, and another.
    for (image, radiance) in [
        (last, [1.0, 1.0, 1.0]),
        (last - 1, [0.5, 4.0, 1.0]),
        (last, [0.25, 2.0, 3.0]),
    ] {
        scene.lights.push(Light::Infinite {
            radiance: Rgb::from(radiance),
            image: Some((ImageId(image), EnvironmentMapping::EqualAreaOctahedral)),
            to_world: DMat4::IDENTITY,
        });
    }
    let (back, notes) = round_trip(&scene);
    assert!(notes.is_empty(), "{notes:?}");
    // All values are exact in half floats.
    assert_eq!(skies(&back), skies(&scene));
}

#[test]
fn what_cannot_be_said_is_noted_once() {
    let mut scene = crate::builtin::orbs();
    for material in &mut scene.materials {
        material.one_sided = true;
    }
    let (_, notes) = round_trip(&scene);
    assert_eq!(notes.len(), 1, "{notes:?}");
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let scene = crate::builtin::orbs();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("absent").join("out.pbrt");
    let error = write_pbrt(&scene, &path).unwrap_err();
    assert!(error.to_string().contains("absent"), "{error}");
}

#[test]
fn strings_are_escaped() {
    assert_eq!(quoted("a\"b\\c\n"), "\"a\\\"b\\\\c_\"");
}

#[test]
fn filters_survive() {
    for filter in [
        Interpolation::Bilinear,
        Interpolation::Nearest,
        Interpolation::Trilinear,
        Interpolation::EWA,
        Interpolation::Ewa {
            max_anisotropy: 2.5,
        },
    ] {
        let mut scene = crate::builtin::orbs();
        scene.images.push(crate::Image {
            name: "p".into(),
            width: 2,
            height: 1,
            pixels: vec![[1.0, 0.5, 0.25], [0.0, 0.5, 2.0]].into(),
        });
        scene.textures.push(Texture::Image {
            image: crate::scene::ImageId(scene.images.len() - 1),
            mapping: TextureMapping::default(),
            wrap: [Wrap::Repeat; 2],
            filter,
            invert: false,
            scale: 1.0,
            channel: Channel::Rgb,
        });
        let texture = crate::scene::TextureId(scene.textures.len() - 1);
        let used = scene.shapes[0].material.0;
        scene.materials[used] = Material::new(MaterialKind::Diffuse {
            reflectance: ColourParam::Texture(texture),
            roughness: FloatParam::Value(0.0),
        });
        let (back, _) = round_trip(&scene);
        let is_same = |t: &Texture| matches!(t, Texture::Image { filter: f, .. } if *f == filter);
        assert!(
            back.textures.iter().any(is_same),
            "{filter:?}: {:?}",
            back.textures
        );
    }
}

/// The same project, place and colours by pixel.
#[test]
fn projected_pictures_keep_their_places() {
    let mut scene = crate::builtin::orbs();
    scene.lights.clear();
    let pixels = [[1.0, 0.5, 0.25], [0.0, 0.5, 2.0]].repeat(2);
    scene.images.push(crate::Image {
        name: "p".into(),
        width: 2,
        height: 2,
        pixels: pixels.into(),
    });
    let image = crate::scene::ImageId(scene.images.len() - 1);
    let window = ImageProjection::Window {
        half: [0.5, 0.5],
        profile: Profile::Intensity,
    };
    let to_world = DMat4::from_rotation_translation(
        glam::DQuat::from_rotation_x(0.5),
        glam::DVec3::new(1.0, 2.0, 3.0),
    );
    for (image_projection, channel) in [
        (ImageProjection::Sphere, Channel::Mean),
        (window, Channel::Rgb),
    ] {
        scene.textures.push(Texture::Image {
            image,
            mapping: TextureMapping::default(),
            wrap: [Wrap::Clamp; 2],
            filter: Interpolation::Nearest,
            invert: false,
            scale: 3.0,
            channel,
        });
        let texture = crate::scene::TextureId(scene.textures.len() - 1);
        scene.lights.push(Light::Picture {
            to_world,
            intensity: ColourParam::Texture(texture),
            image_projection,
        });
    }
    let (back, notes) = round_trip(&scene);
    assert!(notes.is_empty(), "{notes:?}");
    for (before, after) in scene.lights.iter().zip(&back.lights) {
        let (
            Light::Picture {
                to_world: a,
                image_projection: t,
                intensity: i,
            },
            Light::Picture {
                to_world: b,
                image_projection: u,
                intensity: j,
            },
        ) = (before, after)
        else {
            panic!("{after:?}")
        };
        assert!(a.abs_diff_eq(*b, 1e-6), "{a} {b}");
        match (t, u) {
            (ImageProjection::Window { half: a, .. }, ImageProjection::Window { half: b, .. }) => {
                assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9);
            }
            _ => assert_eq!(t, u),
        }
        assert_eq!(first_pixel(&scene, *i), first_pixel(&back, *j));
    }
}

/// The first pixel of a picture behind factors, by its channel.
fn first_pixel(scene: &Scene, p: ColourParam) -> [f32; 3] {
    let ColourParam::Texture(id) = p else {
        panic!("{p:?}")
    };
    match &scene.textures[id.0] {
        Texture::Constant(c) => c.to_array(),
        Texture::Scale { a, b } => {
            let [a, b] = [a, b].map(|t| first_pixel(scene, ColourParam::Texture(*t)));
            [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
        }
        Texture::Image {
            image,
            scale,
            channel,
            ..
        } => {
            let pixel = Rgb::from(scene.images[image.0].pixels.rgb(0));
            let pixel = match channel {
                Channel::Mean => Rgb::splat(pixel.mean()),
                _ => pixel,
            };
            (pixel * *scale).to_array()
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_lies_under_a_coat_survives() {
    let cloud = CoatMedium {
        thickness: FloatParam::Value(0.25),
        max_depth: Some(7),
        samples: 3,
        albedo: ColourParam::Value(Rgb::from([0.25, 0.5, 0.75])),
        g: FloatParam::Value(-0.5),
    };
    let unlimited = CoatMedium {
        max_depth: Some(1000),
        ..CoatMedium::default()
    };
    for (medium, expected) in [(cloud, cloud), (CoatMedium::default(), unlimited)] {
        let mut scene = crate::builtin::orbs();
        let used = scene.shapes[0].material.0;
        scene.materials[used] = Material::new(MaterialKind::CoatedConductor {
            coat_eta: 1.5,
            coat_roughness: Roughness::smooth(),
            fresnel: ConductorFresnel::Reflectance(ColourParam::Value(Rgb::splat(0.5))),
            roughness: Roughness::isotropic(FloatParam::Value(0.25), RoughnessMapping::Alpha),
            medium,
        });
        let (back, notes) = round_trip(&scene);
        let found = &back.materials[back.shapes[0].material.0].kind;
        let MaterialKind::CoatedConductor { medium, .. } = found else {
            panic!("{found:?} {notes:?}")
        };
        assert_eq!(*medium, expected);
    }
}
