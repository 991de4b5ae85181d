//! Broken scenes: each a located error, none a panic.

use super::common::{self, Folder, load, load_world};
use specula_scene::{ErrorKind, SceneError};

#[track_caller]
fn expect(
    result: Result<specula_scene::Loaded, SceneError>,
    kind: ErrorKind,
    line: usize,
    column: usize,
    part: &str,
) {
    let error = result.expect_err("the scene is broken");
    assert_eq!(error.kind(), kind, "{error}");
    assert_eq!((error.line(), error.column()), (line, column), "{error}");
    assert!(error.message().contains(part), "{error}");
    assert!(error.file().ends_with(".pbrt"), "{}", error.file());
}

#[test]
fn missing_mesh() {
    let result = load("WorldBegin\nShape \"plymesh\" \"string filename\" \"none.ply\"");
    expect(result, ErrorKind::Mesh, 2, 35, "none.ply");
}

#[test]
fn nan_in_a_transform() {
    expect(
        load("Scale 1 nan 1\nWorldBegin"),
        ErrorKind::Syntax,
        1,
        9,
        "finite",
    );
    expect(
        load("Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0]"),
        ErrorKind::Syntax,
        1,
        41,
        "number 16",
    );
    expect(
        load("Scale 1 0 1\nCamera \"perspective\""),
        ErrorKind::Transform,
        2,
        1,
        "inverted",
    );
    expect(
        load("Scale 1e38 1 1\nScale 1e38 1 1"),
        ErrorKind::Transform,
        2,
        1,
        "finite",
    );
    expect(
        load("LookAt 0 0 0 0 0 0 0 1 0"),
        ErrorKind::Transform,
        1,
        1,
        "apart",
    );
    expect(load("Rotate 10 0 0 0"), ErrorKind::Transform, 1, 1, "axis");
}

#[test]
fn unknown_directive() {
    let error = load("WorldBegin\n  Shpae \"sphere\"").unwrap_err();
    assert_eq!(error.help(), Some("did you mean `Shape`?"));
    expect(Err(error), ErrorKind::UnknownDirective, 2, 3, "Shpae");
}

#[test]
fn truncated_ply() {
    let folder = Folder::new();
    folder.write(
        "a.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
         property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0123456789abc",
    );
    let result = folder.load("WorldBegin\nShape \"plymesh\"\n \"string filename\" \"a.ply\"");
    expect(result, ErrorKind::Mesh, 3, 20, "truncated");
}

#[test]
fn recursive_include() {
    let folder = Folder::new();
    folder.write("b.pbrt", "# back again\n Include \"scene.pbrt\"");
    let error = folder.load("WorldBegin\nInclude \"b.pbrt\"").unwrap_err();
    assert!(error.file().ends_with("b.pbrt"), "{}", error.file());
    expect(
        Err(error),
        ErrorKind::RecursiveInclude,
        2,
        10,
        "includes itself",
    );
}

#[test]
fn negative_roughness() {
    let result = load_world("Material \"conductor\" \"float roughness\" -0.1");
    expect(result, ErrorKind::Parameter, 2, 22, "not negative");
}

#[test]
fn triangles_without_area() {
    let mesh = |indices: &str| {
        load(format!(
            "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 2 0 0] \"integer indices\" [{indices}]"
        ))
    };
    expect(mesh("0 1 3 1 1 2"), ErrorKind::EmptyScene, 2, 7, "no area");
    let loaded = mesh("0 1 2 0 1 3").unwrap();
    assert_eq!(loaded.scene.meshes[0].triangles, [[0, 1, 2]]);
    assert_eq!(
        common::warnings(&loaded),
        ["1 triangles without area are dropped"]
    );
}

#[test]
fn empty_scene() {
    expect(
        load("WorldBegin\n"),
        ErrorKind::EmptyScene,
        1,
        11,
        "no shapes",
    );
    expect(load(""), ErrorKind::Structure, 1, 1, "WorldBegin");
    expect(load("Identity"), ErrorKind::Structure, 1, 9, "WorldBegin");
}

#[test]
fn a_header_of_a_milliard_triangles() {
    let folder = Folder::new();
    folder.write(
        "a.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\n\
         property float z\nelement face 1000000000\nproperty list uchar int vertex_indices\nend_header\n",
    );
    let result = folder.load("WorldBegin\nShape \"plymesh\" \"string filename\" \"a.ply\"");
    expect(result, ErrorKind::Mesh, 2, 35, "promises 1000000000");
}

#[test]
fn binary_garbage() {
    let bytes: Vec<u8> = (0..4096u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
        .collect();
    let error = load(&bytes).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Encoding, "{error}");
    expect(
        load(b"WorldBegin\n\xff\xfe"),
        ErrorKind::Encoding,
        2,
        1,
        "UTF-8",
    );
    expect(
        load(b"WorldBegin\n\0\0"),
        ErrorKind::Encoding,
        2,
        1,
        "binary",
    );
}

#[test]
fn missing_files() {
    let error = specula_scene::load(std::path::Path::new("no/such/scene.pbrt")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    expect(
        load("Include \"none.pbrt\""),
        ErrorKind::Io,
        1,
        9,
        "none.pbrt",
    );
    let texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"none.png\"";
    expect(load_world(texture), ErrorKind::Image, 2, 53, "none.png");
}

#[test]
fn blocks_that_do_not_match() {
    expect(
        load("WorldBegin\nAttributeEnd"),
        ErrorKind::Structure,
        2,
        1,
        "without",
    );
    expect(
        load("WorldBegin\nAttributeBegin\n"),
        ErrorKind::Structure,
        2,
        1,
        "never closed",
    );
    expect(
        load("WorldBegin\nAttributeBegin\nObjectEnd"),
        ErrorKind::Structure,
        3,
        1,
        "close",
    );
    expect(
        load("Shape \"sphere\"\nWorldBegin"),
        ErrorKind::Structure,
        1,
        1,
        "before `WorldBegin`",
    );
    expect(
        load_world("Camera \"perspective\""),
        ErrorKind::Structure,
        2,
        1,
        "after `WorldBegin`",
    );
    expect(
        load_world("ObjectBegin \"a\"\nObjectBegin \"b\""),
        ErrorKind::Structure,
        3,
        13,
        "within",
    );
}

#[test]
fn names_that_are_not_defined_or_twice() {
    let twice = "Texture \"t\" \"float\" \"constant\"\n";
    expect(
        load_world(&twice.repeat(2)),
        ErrorKind::Duplicate,
        3,
        9,
        "twice",
    );
    let twice = "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"\n";
    expect(
        load_world(&twice.repeat(2)),
        ErrorKind::Duplicate,
        3,
        19,
        "twice",
    );
    expect(
        load_world("ObjectBegin \"a\" ObjectEnd\nObjectBegin \"a\""),
        ErrorKind::Duplicate,
        3,
        13,
        "twice",
    );
    expect(
        load_world("NamedMaterial \"m\""),
        ErrorKind::UnknownName,
        2,
        15,
        "\"m\"",
    );
    expect(
        load_world("ObjectInstance \"o\""),
        ErrorKind::UnknownName,
        2,
        16,
        "\"o\"",
    );
    let texture = "Material \"diffuse\" \"texture reflectance\" \"t\"";
    expect(load_world(texture), ErrorKind::UnknownName, 2, 42, "\"t\"");
    expect(
        load_world("MediumInterface \"fog\" \"\""),
        ErrorKind::UnknownName,
        2,
        17,
        "fog",
    );
}

#[test]
fn meshes_that_are_wrong() {
    let mesh = |parameters: &str| load(format!("WorldBegin\nShape \"trianglemesh\"\n{parameters}"));
    let points = "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1]";
    expect(
        mesh(&format!("{points}\n\"integer indices\" [0 1 4]")),
        ErrorKind::Mesh,
        4,
        1,
        "index 4",
    );
    expect(
        mesh(&format!("{points}\n\"integer indices\" [0 -1 2]")),
        ErrorKind::Mesh,
        4,
        1,
        "index -1",
    );
    expect(
        mesh(&format!("{points}\n\"integer indices\" [0 1]")),
        ErrorKind::Mesh,
        4,
        1,
        "multiple of 3",
    );
    expect(mesh(points), ErrorKind::Mesh, 2, 7, "indices");
    expect(
        mesh("\"integer indices\" [0 1 2]"),
        ErrorKind::Mesh,
        2,
        7,
        "vertices",
    );
    expect(
        mesh("\"point3 P\" [0 0 inf]"),
        ErrorKind::Syntax,
        3,
        17,
        "finite",
    );
    expect(
        mesh("\"point3 P\" [0 0]"),
        ErrorKind::Syntax,
        3,
        1,
        "multiple of 3",
    );
    let far = "\"point3 P\" [0 0 0 1e30 0 0 0 1e30 0] \"integer indices\" [0 1 2]";
    expect(mesh(far), ErrorKind::Limit, 2, 7, "beyond");
}

#[test]
fn cameras_that_are_unknown_or_incomplete() {
    let camera = |text: &str| load(format!("Camera {text}\nWorldBegin Shape \"sphere\""));
    expect(
        camera("\"fisheye\""),
        ErrorKind::Unsupported,
        1,
        8,
        "fisheye",
    );
    expect(
        camera("\"realistic\""),
        ErrorKind::Parameter,
        1,
        8,
        "lensfile",
    );
}

#[test]
fn values_that_mean_nothing() {
    let camera = |text: &str| load(format!("Camera {text}\nWorldBegin Shape \"sphere\""));
    expect(
        camera("\"perspective\" \"float fov\" 180"),
        ErrorKind::Parameter,
        1,
        22,
        "180",
    );
    expect(
        camera("\"perspective\" \"float focaldistance\" 0"),
        ErrorKind::Parameter,
        1,
        22,
        "above 0",
    );
    let film = "Film \"rgb\" \"integer xresolution\" 0\nWorldBegin";
    expect(load(film), ErrorKind::Parameter, 1, 12, "xresolution");
    expect(
        load_world("Shape \"sphere\" \"float radius\" -1"),
        ErrorKind::Parameter,
        2,
        16,
        "above 0",
    );
    expect(
        load_world("Material \"dielectric\" \"float eta\" -1"),
        ErrorKind::Parameter,
        2,
        23,
        "above 0",
    );
    expect(
        load_world("Material \"plastik\""),
        ErrorKind::Parameter,
        2,
        10,
        "plastik",
    );
    expect(
        load_world("Material \"diffuse\" \"rgb reflectance\" [-1 0 0]"),
        ErrorKind::Parameter,
        2,
        20,
        "negative",
    );
    expect(
        load_world("Material \"conductor\" \"spectrum eta\" \"none.spd\""),
        ErrorKind::Spectrum,
        2,
        37,
        "none.spd",
    );
    expect(
        load_world("Material \"conductor\" \"spectrum eta\" [400 1 300 1]"),
        ErrorKind::Spectrum,
        2,
        22,
        "eta",
    );
    let spot = "LightSource \"spot\" \"float coneangle\" 200";
    expect(load_world(spot), ErrorKind::Parameter, 2, 13, "coneangle");
    let distant = "LightSource \"distant\" \"point3 from\" [0 0 1]";
    expect(
        load_world(distant),
        ErrorKind::Parameter,
        2,
        13,
        "same point",
    );
    let mix = "Material \"mix\" \"string materials\" [\"a\" \"b\"]";
    expect(load_world(mix), ErrorKind::UnknownName, 2, 36, "\"a\"");
}

#[test]
fn a_spectrum_file_is_located_within_itself() {
    let folder = Folder::new();
    folder.write("bad.spd", "400 1\n500 two\n");
    let error = folder
        .load("WorldBegin Material \"conductor\" \"spectrum k\" \"bad.spd\" Shape \"sphere\"")
        .unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Spectrum);
    assert!(error.file().ends_with("bad.spd"));
    assert_eq!(error.line(), 2);
}
