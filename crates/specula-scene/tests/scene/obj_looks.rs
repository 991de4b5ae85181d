//! OBJ files with libraries of materials.

use specula_bsdf::Rgb;
use specula_scene::scene::{
    Bump, ColourParam, FloatParam, GltfMaterial, Material, MaterialKind, Shape, Texture,
};
use specula_scene::{Loaded, Scene, load};

use super::common::Folder;

const MESH: &str = "mtllib look s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n\
                    usemtl paint\nf 1/1 2/2 3/3\nusemtl gold\nf 2/1 3/2 4/3\nusemtl paint\nf 1/1 3/2 4/3\n\
                    usemtl nowhere\nf 1/1 2/2 4/3\n";

/// A picture of one colour.
fn picture(colour: [f32; 3]) -> Vec<u8> {
    let mut bytes = b"PF\n1 1\n-1.0\n".to_vec();
    bytes.extend(colour.iter().flat_map(|x| x.to_le_bytes()));
    bytes
}

fn read(library: &str) -> Loaded {
    let folder = Folder::new();
    folder.write("look s.mtl", library);
    folder.write("a b.pfm", picture([0.1, 0.2, 0.3]));
    folder.write("normal.pfm", picture([0.5, 0.5, 1.0]));
    load(&folder.write("a.obj", MESH)).unwrap()
}

/// Shapes and materials that are the file's.
fn parts(scene: &Scene) -> Vec<(&Shape, &Material)> {
    let own = scene.shapes.iter();
    own.filter(|s| Some(s.material) != scene.floor)
        .map(|s| (s, &scene.materials[s.material.0]))
        .collect()
}

fn told(loaded: &Loaded) -> Vec<&str> {
    loaded
        .warnings
        .iter()
        .skip(1)
        .map(|w| w.message())
        .collect()
}

fn gltf(material: &Material) -> &GltfMaterial {
    let MaterialKind::Gltf(gltf) = &material.kind else {
        panic!("{:?}", material.kind)
    };
    gltf
}

#[test]
fn faces_are_parted_by_material() {
    let loaded = read("newmtl paint\nKd 0.5 0.1 0.1\nnewmtl gold\nKd 0 0 0\nKs 1 0.8 0.3\nNs 98\n");
    assert_eq!(told(&loaded), [""; 0]);
    let message = loaded.warnings[0].message();
    assert!(
        message.contains("the materials of its libraries"),
        "{message}"
    );
    let scene = &loaded.scene;
    let parts = parts(scene);
    // Before any `usemtl`, paint, gold, and one that no library has.
    let counts: Vec<_> = scene.meshes.iter().map(|m| m.triangles.len()).collect();
    assert_eq!(counts[..4], [1, 2, 1, 1]);
    let paint = &scene.meshes[1];
    assert_eq!(paint.positions.len(), 5);
    assert_eq!(paint.uvs.len(), 5);
    assert_eq!(paint.triangles, [[0, 1, 2], [0, 3, 4]]);
    for (part, grey) in [(0, true), (1, false), (3, true)] {
        let MaterialKind::Diffuse { reflectance, .. } = &parts[part].1.kind else {
            panic!("{:?}", parts[part].1)
        };
        let expected = match grey {
            true => Rgb::splat(0.5),
            false => Rgb {
                r: 0.5,
                g: 0.1,
                b: 0.1,
            },
        };
        assert_eq!(*reflectance, ColourParam::Value(expected), "{part}");
    }
    let gold = gltf(parts[2].1);
    assert_eq!(parts[2].1.name.as_deref(), Some("gold"));
    assert_eq!(gold.metallic, FloatParam::Value(1.0));
    assert_eq!(
        gold.base_colour,
        ColourParam::Value(Rgb {
            r: 1.0,
            g: 0.8,
            b: 0.3
        })
    );
    let FloatParam::Value(roughness) = gold.roughness else {
        panic!("{:?}", gold.roughness)
    };
    // alpha = sqrt(2 / 100), and alpha is the square of the roughness.
    assert!((roughness.powi(4) - 0.02).abs() < 1e-6, "{roughness}");
}

#[test]
fn glass_opacity_emission_and_pictures_are_read() {
    let loaded = read(
        "newmtl paint\nKd 0.5 0.5 0.5\nKs 0.5\nd 0.25\nmap_Kd a b.pfm\nmap_Bump -bm 0.5 normal.pfm\nKe 1 2 3\n\
         newmtl gold\nillum 7\nNi 1.33\nTf 1 0.5 0\nd 0.1\n",
    );
    assert_eq!(told(&loaded), [""; 0]);
    let scene = &loaded.scene;
    let parts = parts(scene);
    let (shape, paint) = parts[1];
    assert_eq!(shape.alpha, FloatParam::Value(0.25));
    let emission = shape.emission.unwrap();
    assert_eq!(
        emission.radiance,
        ColourParam::Value(Rgb {
            r: 1.0,
            g: 2.0,
            b: 3.0
        })
    );
    let ColourParam::Texture(base) = gltf(paint).base_colour else {
        panic!("{:?}", paint.kind)
    };
    let Texture::Scale { a, b } = &scene.textures[base.0] else {
        panic!("{:?}", scene.textures[base.0])
    };
    assert!(matches!(scene.textures[a.0], Texture::Image { .. }));
    assert_eq!(scene.textures[b.0], Texture::Constant(Rgb::splat(0.5)));
    assert_eq!(gltf(paint).specular_colour, ColourParam::Value(Rgb::WHITE));
    assert!(matches!(paint.bump, Some(Bump::Normal { scale: 0.5, .. })));
    let (shape, glass) = parts[2];
    assert_eq!(shape.alpha, FloatParam::Value(1.0));
    let MaterialKind::Dielectric {
        eta,
        transmission_tint,
        ..
    } = &glass.kind
    else {
        panic!("{:?}", glass.kind)
    };
    assert_eq!(*eta, 1.33);
    assert_eq!(
        *transmission_tint,
        ColourParam::Value(Rgb {
            r: 1.0,
            g: 0.5,
            b: 0.0
        })
    );
}

#[test]
fn pictures_of_roughness_and_metallic_need_no_factor() {
    let loaded = read("newmtl paint\nmap_Pr a b.pfm\nmap_Pm a b.pfm\n");
    let parts = parts(&loaded.scene);
    let physical = gltf(parts[1].1);
    for value in [physical.roughness, physical.metallic] {
        let FloatParam::Texture(texture) = value else {
            panic!("{value:?}")
        };
        // Not a product with 0.
        assert!(matches!(
            loaded.scene.textures[texture.0],
            Texture::Image { .. }
        ));
    }
}

#[test]
fn what_is_left_out_is_told() {
    let loaded = read(
        "newmtl paint\nKd 1 x 1\nmap_Kd none.png\nmap_Bump a b.pfm\nnewmtl gold\nPr 0.4\nPm 0.5\nKd 0.3\n",
    );
    let told = told(&loaded);
    assert_eq!(told.len(), 3, "{told:?}");
    assert!(told[0].starts_with("look s.mtl, line 2: Kd: expected three finite numbers"));
    assert!(told[1].contains("material \"paint\": picture") && told[1].contains("none.png"));
    assert!(told[2].contains("heights of unknown unit"), "{}", told[2]);
    let parts = parts(&loaded.scene);
    let physical = gltf(parts[2].1);
    assert_eq!(physical.roughness, FloatParam::Value(0.4));
    assert_eq!(physical.metallic, FloatParam::Value(0.5));
    assert_eq!(physical.specular_colour, ColourParam::Value(Rgb::WHITE));
}

#[test]
fn without_its_library_a_mesh_is_grey() {
    let folder = Folder::new();
    let loaded = load(&folder.write("a.obj", MESH)).unwrap();
    let told = told(&loaded);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].starts_with("the library of materials look s.mtl "),
        "{}",
        told[0]
    );
    assert_eq!(parts(&loaded.scene).len(), 4);
}
