//! Scenes by others, and small ones, written as pbrt-v4 files and read back.

use std::collections::HashSet;

use glam::DMat4;
use specula_scene::scene::{
    ColourParam, FloatParam, Geometry, Light, Material, MaterialKind, Object, Shape, Texture,
    TextureId,
};
use specula_scene::write_pbrt::write_pbrt;
use specula_scene::{Scene, load};

use super::common::Folder;

/// Writes a scene and reads it back, without warnings of the reader but about light and media.
#[track_caller]
fn round_trip(scene: &Scene) -> (Scene, Vec<String>) {
    let folder = Folder::new();
    let path = folder.path().join("out.pbrt");
    let notes = write_pbrt(scene, &path).unwrap();
    let loaded = load(&path).unwrap_or_else(|e| panic!("{}: {e}", e.place()));
    let mut told = loaded.warnings.iter().map(|w| w.message());
    let odd = told.find(|w| !w.contains("no light"));
    assert_eq!(odd, None);
    (loaded.scene, notes)
}

/// What a texture is, without numbers of the scene; pictures by size.
fn texture(scene: &Scene, id: TextureId) -> String {
    let of = |id: &TextureId| texture(scene, *id);
    match &scene.textures[id.0] {
        Texture::Scale { a, b } => format!("({} * {})", of(a), of(b)),
        Texture::Mix { a, b, amount } => {
            format!("mix {} {} {}", of(a), of(b), float(scene, *amount))
        }
        Texture::Checkerboard { even, odd, .. } | Texture::Checkerboard3d { even, odd, .. } => {
            format!("checks {} {}", of(even), of(odd))
        }
        Texture::Image {
            image,
            mapping,
            scale,
            ..
        } => {
            let image = &scene.images[image.0];
            format!("{} x {} {mapping:?} {scale}", image.width, image.height)
        }
        Texture::Constant(c) => format!("{c:?}"),
        other => format!("{other:?}"),
    }
}

fn float(scene: &Scene, p: FloatParam) -> String {
    match p {
        FloatParam::Value(x) => format!("{x}"),
        FloatParam::Texture(id) => texture(scene, id),
    }
}

fn colour(scene: &Scene, p: ColourParam) -> String {
    match p {
        ColourParam::Value(c) => format!("{c:?}"),
        ColourParam::Texture(id) => texture(scene, id),
    }
}

/// What a material is, without numbers of the scene.
fn kind(scene: &Scene, material: &Material) -> String {
    match &material.kind {
        MaterialKind::Diffuse { reflectance, .. } => colour(scene, *reflectance),
        MaterialKind::CoatedDiffuse {
            reflectance,
            eta,
            roughness,
            medium,
            ..
        } => format!(
            "coated {} {eta} {} {} {:?}",
            colour(scene, *reflectance),
            float(scene, roughness.u),
            float(scene, roughness.v),
            medium.max_depth
        ),
        MaterialKind::Mix { materials, amount } => {
            let [a, b] = materials.map(|m| kind(scene, &scene.materials[m.0]));
            format!("mix {a}, {b}, {}", float(scene, *amount))
        }
        other => format!("{other:?}"),
    }
}

fn is_near(a: &DMat4, b: &DMat4) -> bool {
    let size = a
        .to_cols_array()
        .iter()
        .fold(1.0_f64, |m, x| m.max(x.abs()));
    a.abs_diff_eq(*b, 1e-6 * size)
}

fn expect_shapes(what: &str, before: (&Scene, &[Shape]), after: (&Scene, &[Shape])) {
    assert_eq!(before.1.len(), after.1.len(), "{what}");
    for (i, (a, b)) in before.1.iter().zip(after.1).enumerate() {
        let what = format!("{what}, shape {i}");
        assert!(is_near(&a.to_world, &b.to_world), "{what}");
        match (a.geometry, b.geometry) {
            (Geometry::Mesh(a), Geometry::Mesh(b)) => {
                assert!(before.0.meshes[a.0] == after.0.meshes[b.0], "{what}");
            }
            (a, b) => assert_eq!(a, b, "{what}"),
        }
        assert_eq!(a.reverse_orientation, b.reverse_orientation, "{what}");
        let light = |scene: &Scene, shape: &Shape| {
            shape
                .emission
                .map(|e| (colour(scene, e.radiance), e.two_sided))
        };
        assert_eq!(light(before.0, a), light(after.0, b), "{what}");
        assert_eq!(float(before.0, a.alpha), float(after.0, b.alpha), "{what}");
        let [a, b] = [(before.0, a), (after.0, b)].map(|(s, shape)| &s.materials[shape.material.0]);
        assert_eq!(kind(before.0, a), kind(after.0, b), "{what}");
        assert_eq!((a.absorption, a.around), (b.absorption, b.around), "{what}");
        assert_eq!(a.bump.is_some(), b.bump.is_some(), "{what}");
        if a.name.is_some() {
            assert_eq!(a.name, b.name, "{what}");
        }
    }
}

/// Holds what makes the picture of two scenes against each other.
fn expect(what: &str, before: &Scene, after: &Scene) {
    expect_shapes(what, (before, &before.shapes), (after, &after.shapes));
    assert_eq!(before.objects.len(), after.objects.len(), "{what}");
    for (a, b) in before.objects.iter().zip(&after.objects) {
        let shapes = |o: &Object| o.shapes.clone();
        expect_shapes(&a.name, (before, &shapes(a)), (after, &shapes(b)));
    }
    for (a, b) in before.instances.iter().zip(&after.instances) {
        assert_eq!(a.object, b.object, "{what}");
        assert!(is_near(&a.to_world, &b.to_world), "{what}");
    }
    assert_eq!(before.instances.len(), after.instances.len(), "{what}");
    assert_eq!(before.settings, after.settings, "{what}");
    assert!(
        is_near(&before.camera.to_world, &after.camera.to_world),
        "{what}"
    );
    assert_eq!(before.camera.projection, after.camera.projection, "{what}");
    assert_eq!(
        before.camera.screen_window, after.camera.screen_window,
        "{what}"
    );
    let film = |s: &Scene| {
        (
            s.film.resolution,
            s.film.crop,
            s.film.filter,
            s.film.max_component,
        )
    };
    assert_eq!(film(before), film(after), "{what}");
    assert!(
        (before.film.exposure / after.film.exposure - 1.0).abs() < 1e-5,
        "{what}"
    );
    assert_eq!(before.lights.len(), after.lights.len(), "{what}");
    for (a, b) in before.lights.iter().zip(&after.lights) {
        match (a, b) {
            // Pictures are multiplied by their colours.
            (Light::Infinite { image: Some(_), .. }, Light::Infinite { image: Some(_), .. })
            | (Light::Picture { .. }, Light::Picture { .. }) => {}
            (Light::Infinite { radiance: a, .. }, Light::Infinite { radiance: b, .. }) => {
                assert_eq!(a, b, "{what}");
            }
            (Light::Point { intensity: a, .. }, Light::Point { intensity: b, .. })
            | (Light::Spot { intensity: a, .. }, Light::Spot { intensity: b, .. })
            | (Light::Distant { irradiance: a, .. }, Light::Distant { irradiance: b, .. }) => {
                assert_eq!(a, b, "{what}");
            }
            _ => panic!("{what}: {a:?} became {b:?}"),
        }
    }
}

#[test]
fn pbrt_scenes_by_others_survive() {
    for name in [
        "cornell-box/cornell-box",
        "cornell-box/cornell-box-specular-volume",
        "cornell-box/cornell-box-specular",
        "cornell-box/cornell-box-volume",
        "staircase2/staircase2",
        "veach-mis/veach-mis",
        "volumetric-caustic/volumetric-caustic",
    ] {
        let path = specula_testing::scene(&format!("{name}.pbrt"));
        let scene = load(&path).unwrap().scene;
        let (back, notes) = round_trip(&scene);
        assert_eq!(notes, [""; 0], "{name}");
        expect(name, &scene, &back);
    }
}

#[test]
fn scenes_of_other_formats_are_written_so_that_they_are_read() {
    for name in [
        "gltf/boombox.glb",
        "gltf/openpbr-viewer-neutral_objects.glb",
        "mitsuba/envmap.xml",
        "mitsuba/principled.xml",
    ] {
        let loaded = load(&specula_testing::scene(name)).unwrap();
        let (back, _) = round_trip(&loaded.scene);
        assert_eq!(back.shapes.len(), loaded.scene.shapes.len(), "{name}");
    }
}

#[test]
fn media_and_interfaces_survive() {
    let folder = Folder::new();
    let scene = folder
        .load(
            "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n\
             MakeNamedMedium \"red\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.1 2 3] \"rgb sigma_s\" [0 0 0]\n\
             MakeNamedMedium \"blue\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [4 3 0.5] \"rgb sigma_s\" [0 0 0]\n\
             MakeNamedMaterial \"glass\" \"string type\" \"dielectric\"\n\
             AttributeBegin MediumInterface \"red\" \"\" NamedMaterial \"glass\" Shape \"sphere\" AttributeEnd\n\
             AttributeBegin MediumInterface \"blue\" \"red\" NamedMaterial \"glass\" Shape \"sphere\" \"float radius\" 0.5 AttributeEnd\n\
             AttributeBegin MediumInterface \"\" \"blue\" Material \"interface\" Shape \"sphere\" \"float radius\" 0.2 AttributeEnd\n\
             NamedMaterial \"glass\" Shape \"disk\"\n",
        )
        .unwrap()
        .scene;
    let (back, notes) = round_trip(&scene);
    assert_eq!(notes, [""; 0]);
    expect("media", &scene, &back);
    let bounding = |s: &Scene| s.materials.iter().filter(|m| m.bounds_absorption()).count();
    assert_eq!((bounding(&scene), bounding(&back)), (3, 3));
    // What comes back is written to the same text.
    let text = |scene: &Scene| {
        let folder = Folder::new();
        write_pbrt(scene, &folder.path().join("out.pbrt")).unwrap();
        std::fs::read_to_string(folder.path().join("out.pbrt")).unwrap()
    };
    let shapes = |text: String| text.split("Shape").count();
    assert_eq!(shapes(text(&scene)), shapes(text(&back)));
    let first = text(&scene);
    assert_eq!(
        first.matches("MakeNamedMaterial \"glass\"").count(),
        1,
        "{first}"
    );
}

#[test]
fn names_of_materials_are_kept_each_once() {
    let mut scene = specula_scene::builtin::orbs();
    let plain = scene.materials[0].clone();
    let named = |name: Option<&str>, eta: f32| Material {
        name: name.map(str::to_owned),
        ..Material::new(MaterialKind::ThinDielectric {
            eta,
            reflection_tint: ColourParam::WHITE,
            transmission_tint: ColourParam::WHITE,
        })
    };
    scene.materials = vec![
        plain,
        named(Some("glass \"A\" \\ ü"), 1.1),
        named(Some("same"), 1.2),
        named(Some("same"), 1.3),
        named(Some("same-2"), 1.4),
        named(None, 1.5),
        named(Some("material-5"), 1.6),
        named(Some("same"), 1.2),
    ];
    scene.textures.clear();
    scene.materials[0] = named(Some("0"), 1.7);
    scene.shapes.truncate(1);
    let one = scene.shapes[0].clone();
    scene.shapes = (0..scene.materials.len())
        .map(|i| Shape {
            material: specula_scene::scene::MaterialId(i),
            ..one.clone()
        })
        .collect();
    let (back, _) = round_trip(&scene);
    let eta = |scene: &Scene, shape: &Shape| match scene.materials[shape.material.0].kind {
        MaterialKind::ThinDielectric { eta, .. } => eta,
        ref other => panic!("{other:?}"),
    };
    for (a, b) in scene.shapes.iter().zip(&back.shapes) {
        assert_eq!(eta(&scene, a), eta(&back, b));
    }
    let names: Vec<&str> = back
        .materials
        .iter()
        .filter_map(|m| m.name.as_deref())
        .collect();
    let expected = [
        "0",
        "glass \"A\" \\ ü",
        "same",
        "same-3",
        "same-2",
        "material-5-2",
        "material-5",
    ];
    assert_eq!(names, expected);
    assert_eq!(names.iter().collect::<HashSet<_>>().len(), names.len());
}

/// The value of a texture at the pixel at the upper left of its pictures.
fn value(scene: &Scene, id: TextureId) -> [f32; 3] {
    let pair = |a: TextureId, b: TextureId| (value(scene, a), value(scene, b));
    match &scene.textures[id.0] {
        Texture::Constant(c) => c.to_array(),
        Texture::Scale { a, b } => {
            let (a, b) = pair(*a, *b);
            [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
        }
        Texture::Mix {
            a,
            b,
            amount: FloatParam::Value(t),
        } => {
            let (a, b) = pair(*a, *b);
            [0, 1, 2].map(|i| a[i] * (1.0 - t) + b[i] * t)
        }
        Texture::Image {
            image,
            scale,
            invert,
            ..
        } => {
            let p = scene.images[image.0].pixels.rgb(0);
            p.map(|v| scale * if *invert { 1.0 - v } else { v })
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn products_of_textures_keep_their_colours() {
    use specula_bsdf::Rgb;
    use specula_scene::scene::{Channel, ImageId, Interpolation, TextureMapping, Wrap};
    let mut scene = specula_scene::builtin::orbs();
    let id = |i: usize| TextureId(i);
    scene.images.push(specula_scene::Image {
        name: "p".into(),
        width: 2,
        height: 1,
        pixels: vec![[0.5, 0.25, 0.125], [0.75, 0.5, 1.0]].into(),
    });
    let image = ImageId(scene.images.len() - 1);
    let picture = |invert| Texture::Image {
        image,
        mapping: TextureMapping::default(),
        wrap: [Wrap::Repeat; 2],
        filter: Interpolation::Bilinear,
        invert,
        scale: 1.0,
        channel: Channel::Rgb,
    };
    let first = scene.textures.len();
    let at = |i: usize| id(first + i);
    scene.textures.extend([
        picture(false),
        Texture::Constant(Rgb::from([0.5, 1.0, 0.25])),
        Texture::Constant(Rgb::splat(0.5)),
        picture(true),
        Texture::Scale { a: at(0), b: at(1) },
        Texture::Scale { a: at(1), b: at(0) },
        Texture::Scale { a: at(0), b: at(2) },
        Texture::Scale { a: at(3), b: at(1) },
        Texture::Mix {
            a: at(0),
            b: at(2),
            amount: FloatParam::Value(0.25),
        },
        Texture::Scale { a: at(8), b: at(1) },
        Texture::Scale { a: at(1), b: at(1) },
        Texture::Scale { a: at(2), b: at(9) },
    ]);
    let one = scene.shapes[0].clone();
    scene.shapes.clear();
    for i in 4..12 {
        scene.materials.push(Material::new(MaterialKind::Diffuse {
            reflectance: ColourParam::Texture(at(i)),
            roughness: FloatParam::Value(0.0),
        }));
        scene.shapes.push(Shape {
            material: specula_scene::scene::MaterialId(scene.materials.len() - 1),
            ..one.clone()
        });
    }
    let (back, notes) = round_trip(&scene);
    assert_eq!(notes, [""; 0]);
    let shown = |scene: &Scene, shape: &Shape| match scene.materials[shape.material.0].kind {
        MaterialKind::Diffuse {
            reflectance: ColourParam::Texture(id),
            ..
        } => value(scene, id),
        MaterialKind::Diffuse {
            reflectance: ColourParam::Value(c),
            ..
        } => c.to_array(),
        ref other => panic!("{other:?}"),
    };
    for (a, b) in scene.shapes.iter().zip(&back.shapes) {
        let (a, b) = (shown(&scene, a), shown(&back, b));
        let near = a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3);
        assert!(near, "{a:?} became {b:?}");
    }
}

/// Parameters of hair survive, and curves of it. Fibres that are triangles do not, and a note says so.
#[test]
fn hair_survives() {
    let read = |curve: &str| {
        let folder = Folder::new();
        let world = format!(
            "WorldBegin LightSource \"infinite\"
             Texture \"t\" \"float\" \"constant\" \"float value\" .25
             Material \"hair\" \"rgb sigma_a\" [.5 1.5 20] \"float alpha\" -4 Shape \"sphere\"
             Material \"hair\" \"rgb reflectance\" [.5 .25 .125] \"float eta\" 1.25 Shape \"sphere\"
             Material \"hair\" \"float eumelanin\" .5 \"float beta_n\" .75 Shape \"sphere\" {curve}"
        );
        folder.load(world).unwrap().scene
    };
    let before = read("");
    let (after, notes) = round_trip(&before);
    assert_eq!(notes, [""; 0]);
    let hair = |scene: &Scene| -> Vec<MaterialKind> {
        let used = scene.shapes.iter().map(|s| s.material.0);
        used.map(|m| scene.materials[m].kind).collect()
    };
    assert_eq!(hair(&after), hair(&before));
    let fibre = read("Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"float width\" .1");
    let (after, notes) = round_trip(&fibre);
    assert_eq!(notes, [""; 0]);
    assert_eq!(after.curve_meshes, fibre.curve_meshes);
    let mut triangles = fibre;
    triangles.triangulate_exact_shapes(|_| true);
    let (_, notes) = round_trip(&triangles);
    assert!(notes.len() == 1 && notes[0].contains("fibres"), "{notes:?}");
}
