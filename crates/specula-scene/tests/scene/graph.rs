//! Textures, bump map and lights with pictures.

use glam::DVec3;
use specula_bsdf::Rgb;
use specula_scene::Warning;
use specula_scene::scene::{
    Bump, ColourParam, FloatParam, ImageProjection, Interpolation, Light, MaterialKind, NoiseKind,
    Profile, Scene, Texture, TextureMapping,
};

use super::common::{Folder, load_world, warnings};

fn with_picture() -> Folder {
    let folder = Folder::new();
    let picture = ::image::RgbImage::from_fn(2, 2, |x, _| ::image::Rgb([(x * 255) as u8, 0, 255]));
    picture.save(folder.path().join("a.png")).unwrap();
    folder
}

#[test]
fn procedural_textures_carry_their_space() {
    let loaded = load_world(
        "Translate 1 0 0 Scale 2 2 2
         Texture \"n\" \"float\" \"wrinkled\" \"integer octaves\" 5 \"float roughness\" 0.25
         Texture \"m\" \"spectrum\" \"marble\" \"float variation\" 0.5
         Texture \"c\" \"spectrum\" \"checkerboard\" \"integer dimension\" 3
         Texture \"p\" \"spectrum\" \"bilerp\" \"rgb v00\" [1 0 0] \"string mapping\" \"planar\" \"vector3 v1\" [0 2 0] \"float udelta\" 0.5
         Texture \"d\" \"float\" \"directionmix\" \"vector3 dir\" [0 0 3]
         Identity Material \"diffuse\" \"texture reflectance\" \"m\"",
    )
    .unwrap();
    assert_eq!(warnings(&loaded), [""; 0]);
    let textures = &loaded.scene.textures;
    let Texture::Noise {
        kind: NoiseKind::Turbulence,
        octaves: 5,
        roughness: 0.25,
        to_texture,
    } = textures[0]
    else {
        panic!("{:?}", textures[0])
    };
    assert_eq!(
        to_texture.transform_point3(DVec3::new(3.0, 0.0, 0.0)),
        DVec3::X
    );
    assert!(matches!(
        textures[1],
        Texture::Noise {
            kind: NoiseKind::Marble {
                variation: 0.5,
                scale: 1.0
            },
            octaves: 8,
            ..
        }
    ));
    assert!(
        textures
            .iter()
            .any(|t| matches!(t, Texture::Checkerboard3d { .. }))
    );
    let planar = textures.iter().find_map(|t| match t {
        Texture::Bilinear {
            corners,
            mapping: TextureMapping::Planar { s, t, .. },
        } => Some((corners, s, t)),
        _ => None,
    });
    let (corners, s, t) = planar.expect("a planar bilerp");
    assert_eq!(corners[0].to_array(), [1.0, 0.0, 0.0]);
    assert_eq!((*s, *t), ([0.0, 2.0, 0.0, 0.5], [0.0, 1.0, 0.0, 0.0]));
    let axis = textures.iter().find_map(|t| match t {
        Texture::DirectionMix { axis, .. } => Some(*axis),
        _ => None,
    });
    assert_eq!(axis, Some([0.0, 0.0, 1.0]));
}

#[test]
fn bump_comes_from_normal_maps_before_displacements() {
    let folder = with_picture();
    let loaded = folder
        .load(
            "WorldBegin Texture \"h\" \"float\" \"imagemap\" \"string filename\" \"a.png\"
             Material \"diffuse\" \"texture displacement\" \"h\" Shape \"sphere\"
             Material \"diffuse\" \"texture displacement\" \"h\" \"string normalmap\" \"a.png\" Shape \"sphere\"
             Material \"diffuse\" \"float displacement\" 3 Shape \"sphere\"",
        )
        .unwrap();
    assert_eq!(warnings(&loaded), [""; 0]);
    let bump = |i: usize| loaded.scene.materials[loaded.scene.shapes[i].material.0].bump;
    assert!(matches!(
        bump(0),
        Some(Bump::Height(FloatParam::Texture(_)))
    ));
    let Some(Bump::Normal { map, .. }) = bump(1) else {
        panic!()
    };
    let Texture::Image { image, .. } = loaded.scene.textures[map.0] else {
        panic!()
    };
    // Without a transfer curve: 255 is 1, 0 is 0, and bytes between would be linear.
    assert_eq!(loaded.scene.images[image.0].pixels.rgb(1), [1.0, 0.0, 1.0]);
    assert_eq!(bump(2), None, "the same height everywhere");
}

#[test]
fn area_lights_show_their_picture_and_have_their_power() {
    let folder = with_picture();
    let loaded = folder
        .load(
            "WorldBegin AreaLightSource \"diffuse\" \"string filename\" \"a.png\" \"float power\" 10
             Shape \"disk\" \"float radius\" 2
             AreaLightSource \"diffuse\" \"float power\" 10
             Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"integer indices\" [0 1 2 2 1 3]",
        )
        .unwrap();
    let scene = &loaded.scene;
    let ColourParam::Texture(id) = scene.shapes[0].emission.unwrap().radiance else {
        panic!()
    };
    let Texture::Image { image, scale, .. } = scene.textures[id.0] else {
        panic!()
    };
    let pixels = &scene.images[image.0].pixels;
    let luminance = |p: [f32; 3]| 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    let mean = pixels.iter().map(luminance).sum::<f32>() / pixels.len() as f32;
    let power = mean * scale * std::f32::consts::PI * (4.0 * std::f32::consts::PI);
    assert!((power - 10.0).abs() < 0.01, "{power}");
    // As in pbrt-v4, each of two triangles has the whole power.
    let ColourParam::Value(radiance) = scene.shapes[1].emission.unwrap().radiance else {
        panic!()
    };
    assert!(
        (radiance.g * std::f32::consts::PI - 20.0).abs() < 1e-3,
        "{radiance:?}"
    );
}

#[test]
fn projections_keep_their_power() {
    let folder = with_picture();
    let loaded = folder
        .load("WorldBegin Shape \"sphere\" LightSource \"projection\" \"string filename\" \"a.png\" \"float fov\" 60 \"float power\" 5")
        .unwrap();
    let scene = &loaded.scene;
    let Light::Picture {
        intensity: ColourParam::Texture(intensity),
        image_projection:
            ImageProjection::Window {
                half,
                profile: Profile::Intensity,
            },
        ..
    } = scene.lights[0]
    else {
        panic!("{:?}", scene.lights)
    };
    let Texture::Scale { a, b } = scene.textures[intensity.0] else {
        panic!()
    };
    let (Texture::Image { image, filter, .. }, Texture::Constant(factor)) =
        (&scene.textures[a.0], &scene.textures[b.0])
    else {
        panic!()
    };
    assert_eq!(*filter, Interpolation::Nearest);
    // The shorter side spans the angle; dw = cos^3 dA, over the middles of pixels.
    let image = &scene.images[image.0];
    let (width, height) = (image.width as usize, image.height as usize);
    let short = 30.0_f64.to_radians().tan();
    let aspect = width as f64 / height as f64;
    assert!(
        (half[0].min(half[1]) - short).abs() < 1e-9 && (half[0] / half[1] - aspect).abs() < 1e-9
    );
    let mut power = 0.0;
    for (i, p) in image.pixels.iter().enumerate() {
        let at = |k: usize, n: usize, half: f64| half * (2.0 * (k as f64 + 0.5) / n as f64 - 1.0);
        let (x, y) = (
            at(i % width, width, half[0]),
            at(i / width, height, half[1]),
        );
        let area = 4.0 * half[0] * half[1] / (width * height) as f64;
        let colour = Rgb::from(p) * *factor;
        power += f64::from(colour.luminance()) * area * (1.0 + x * x + y * y).powf(-1.5);
    }
    assert!((power - 5.0).abs() < 1e-3, "{power}");
}

/// pbrt's filters, with the ratio of EWA's ellipses, as read and as written.
#[test]
fn filters_are_those_of_the_file() {
    let folder = with_picture();
    let read = |parameters: &str| {
        folder.load(format!(
            "WorldBegin Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" {parameters}
             Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\" LightSource \"infinite\""
        ))
    };
    for (parameters, expected) in [
        ("", Interpolation::Bilinear),
        ("\"string filter\" \"point\"", Interpolation::Nearest),
        ("\"string filter\" \"trilinear\"", Interpolation::Trilinear),
        ("\"string filter\" \"ewa\"", Interpolation::EWA),
        (
            "\"string filter\" \"EWA\" \"float maxanisotropy\" 16",
            Interpolation::Ewa {
                max_anisotropy: 16.0,
            },
        ),
    ] {
        let loaded = read(parameters).unwrap();
        let filter = |scene: &Scene| match scene.textures[0] {
            Texture::Image { filter, .. } => filter,
            ref other => panic!("{other:?}"),
        };
        assert_eq!(filter(&loaded.scene), expected, "{parameters}");
        let said: Vec<_> = loaded.warnings.iter().map(Warning::message).collect();
        assert!(said.iter().all(|w| !w.contains("anisotropy")), "{said:?}");
    }
    let clamped = read("\"string filter\" \"ewa\" \"float maxanisotropy\" 1000").unwrap();
    let told = |w: &Warning| w.message().contains("64 is used");
    assert!(clamped.warnings.iter().any(told));
    for wrong in ["\"float maxanisotropy\" 0.5", "\"string filter\" \"cubic\""] {
        assert!(read(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn meshes_with_displacement_are_bumpy() {
    let folder = with_picture();
    folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    );
    let loaded = folder
        .load(
            "WorldBegin Texture \"h\" \"float\" \"imagemap\" \"string filename\" \"a.png\"
             Material \"conductor\"
             Shape \"plymesh\" \"string filename\" \"a.ply\" \"texture displacement\" \"h\"
             Shape \"plymesh\" \"string filename\" \"a.ply\" \"texture displacement\" \"h\" Shape \"sphere\"",
        )
        .unwrap();
    let scene = &loaded.scene;
    let material = |i: usize| scene.shapes[i].material;
    assert_eq!(material(0), material(1));
    assert_ne!(material(0), material(2));
    let bumpy = &scene.materials[material(0).0];
    assert!(matches!(bumpy.bump, Some(Bump::Height(_))));
    assert!(matches!(bumpy.kind, MaterialKind::Conductor { .. }));
    assert_eq!(warnings(&loaded).len(), 2);
}

#[test]
fn scaled_and_inverted_pictures_are_inverted_last() {
    let folder = with_picture();
    let loaded = folder
        .load(
            "WorldBegin Texture \"h\" \"float\" \"imagemap\" \"string filename\" \"a.png\" \"bool invert\" true \"float scale\" 0.5
             Material \"diffuse\" Shape \"sphere\" \"texture alpha\" \"h\"",
        )
        .unwrap();
    let FloatParam::Texture(id) = loaded.scene.shapes[0].alpha else {
        panic!()
    };
    let Texture::Sum { a, b } = loaded.scene.textures[id.0] else {
        panic!()
    };
    assert!(matches!(loaded.scene.textures[a.0], Texture::Constant(c) if c.r == 1.0));
    assert!(matches!(
        loaded.scene.textures[b.0],
        Texture::Image {
            scale: -0.5,
            invert: false,
            ..
        }
    ));
}
