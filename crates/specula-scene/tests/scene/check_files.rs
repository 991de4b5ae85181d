//! All broken files of a scene in one run, and all that is wrong with each.

use std::path::Path;

use specula_scene::{CheckReport, LoadOptions, Severity};

use super::common::Folder;
use super::report::{expect_errors, found};

fn check(path: &Path) -> CheckReport {
    specula_scene::check(path, &LoadOptions::default())
}

#[track_caller]
fn expect(path: &Path, expected: &[(usize, &str)]) {
    let load = specula_scene::load(path).unwrap_err();
    expect_errors(&check(path), &load, expected);
}

const OBJ: &str = "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\nf 1 2\nvt a\nf 1 2 4\n";

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0\n1 0\n0 1 zero\n1 1 1\n3 0 1 2\n2 0 1\n3 1 2 7\n4 0 1 2 3\n";

#[test]
fn each_broken_mesh_and_picture_of_a_scene_is_named() {
    let folder = Folder::new();
    folder.write("a.ply", PLY);
    folder.write("a.obj", OBJ);
    folder.write("a.png", b"\x89PNG but cut off");
    folder.write("a.serialized", [0x1c, 0x04, 9, 0]);
    let path = folder.write(
        "scene.pbrt",
        "WorldBegin
Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"
Material \"diffuse\" \"texture reflectance\" \"t\"
Shape \"plymesh\" \"string filename\" \"a.ply\"
LightSource \"infinite\" \"string filename\" \"no.exr\"
Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 3 0 1 2 0 1 9]
Shape \"plymesh\" \"string filename\" \"no.ply\"
",
    );
    let expected = [
        (2, "a.png"),
        (4, "a.ply: line 11: vertex 1 lacks `z`"),
        (
            4,
            "line 12: vertex 2 has a bad `z`: expected a number, found `zero`",
        ),
        (4, "line 15: face 1 has 2 vertices"),
        (
            4,
            "line 16: face 2 refers to vertex 7, but there are 4 vertices",
        ),
        (5, "no.exr"),
        (6, "index 3 is out of range"),
        (7, "no.ply"),
    ];
    expect(&path, &expected);
    let path = folder.write(
        "scene.xml",
        r#"<scene version="3.0.0"><sensor type="perspective"/>
<shape type="obj"><string name="filename" value="a.obj"/><bsdf type="diffuse">
<texture name="reflectance" type="bitmap"><string name="filename" value="a.png"/></texture></bsdf></shape>
<shape type="serialized"><string name="filename" value="a.serialized"/></shape>
<emitter type="envmap"><string name="filename" value="no.exr"/></emitter>
<shape type="ply"><string name="filename" value="a.ply"/></shape></scene>"#,
    );
    let expected = [
        (2, "a.obj: line 2: expected a finite number, found `x`"),
        (2, "line 5: a face has 2 vertices"),
        (2, "line 6: expected a finite number, found `a`"),
        (2, "line 7: vertex 4 is out of range"),
        (3, "a.png"),
        (4, "a.serialized (0): expected version 3 or 4, found 9"),
        (5, "no.exr"),
        (6, "line 11"),
        (6, "line 12"),
        (6, "line 15"),
        (6, "line 16"),
    ];
    expect(&path, &expected);
}

#[test]
fn mistakes_of_a_mesh_alone_stand_on_their_lines() {
    let folder = Folder::new();
    let path = folder.write("a.obj", OBJ);
    let expected = [
        (2, "found `x`"),
        (5, "2 vertices"),
        (6, "found `a`"),
        (7, "vertex 4"),
    ];
    expect(&path, &expected);
    let path = folder.write("a.ply", PLY);
    expect(
        &path,
        &[
            (11, "`z`"),
            (12, "`z`"),
            (15, "2 vertices"),
            (16, "vertex 7"),
        ],
    );
    let header = "ply\nformat binary 1.0\nelement vertex many\nproperty float x\nproperty real y\n\
        property float x\nfoo\nelement face 0\nend_header\n";
    let path = folder.write("b.ply", header);
    let expected = [
        (2, "binary_little_endian"),
        (3, "a count of elements"),
        (5, "property TYPE NAME"),
        (6, "given twice"),
        (7, "found `foo`"),
    ];
    expect(&path, &expected);
}

#[test]
fn a_header_of_the_wrong_things_names_them_all() {
    let folder = Folder::new();
    let header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
        element face 9\nproperty list uchar float vertex_indices\nend_header\n0 0\n";
    let report = check(&folder.write("a.ply", header));
    let errors = found(&report, Severity::Error);
    let has = |word: &str| errors.iter().any(|e| e.1.contains(word));
    assert!(
        has("x, y and z") && has("list of integers") && has("promises 9"),
        "{errors:?}"
    );
    assert_eq!(errors.len(), 3);
}

#[test]
fn texts_without_rows_have_their_first_mistake() {
    let folder = Folder::new();
    let header = PLY.find("0 0 0").unwrap();
    // What is sound on one line is no mistake.
    let flat = PLY[..header].to_owned() + "0 0 0 1 0 0 0 1 0 1 1 1 3 0 1 2 3 0 1 2 3 0 1 2 3 1 2 3";
    let path = folder.write("a.ply", &flat);
    assert!(specula_scene::load(&path).is_ok());
    assert_eq!(check(&path).count(Severity::Error), 0);
    let path = folder.write("a.ply", flat.replace("1 1 1", "1 x 1"));
    expect(&path, &[(1, "expected a number, found `x`")]);
}

#[test]
fn binary_data_are_followed_as_far_as_they_can_be() {
    let folder = Folder::new();
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n\
        property float y\nproperty float z\nelement face 4\n\
        property list uchar int vertex_indices\nend_header\n"
        .to_vec();
    for x in [0.0_f32, 0.0, 0.0, 1.0, f32::NAN, 0.0, 0.0, 1.0, 0.0] {
        bytes.extend(x.to_le_bytes());
    }
    for face in [&[0, 1, 5][..], &[0, 1], &[0, -1, 2], &[0, 1, 2]] {
        bytes.push(u8::try_from(face.len()).unwrap());
        face.iter()
            .for_each(|i: &i32| bytes.extend(i.to_le_bytes()));
    }
    let path = folder.write("a.ply", &bytes);
    let expected = [
        (1, "face 1 has 2 vertices"),
        (1, "face 2 refers to vertex -1"),
        (1, "vertex 1 is not finite"),
        (1, "triangle 0 refers to vertices 0, 1, 5"),
    ];
    expect(&path, &expected);
    // The end is missing: what is before it is named all the same.
    let path = folder.write("a.ply", &bytes[..bytes.len() - 1]);
    let errors = found(&check(&path), Severity::Error);
    assert!(
        errors.iter().any(|e| e.1.contains("truncated")),
        "{errors:?}"
    );
    assert!(
        errors.iter().any(|e| e.1.contains("vertex -1")),
        "{errors:?}"
    );
}

#[test]
fn one_broken_file_does_not_hide_another() {
    let folder = Folder::new();
    folder.write("a.ply", PLY);
    folder.write("a.obj", "v 0 0 x\n".repeat(1000));
    let path = folder.write(
        "scene.xml",
        r#"<scene version="3.0.0"><sensor type="perspective"/>
<shape type="obj"><string name="filename" value="a.obj"/></shape>
<shape type="ply"><string name="filename" value="a.ply"/></shape></scene>"#,
    );
    let errors = found(&check(&path), Severity::Error);
    let lines: Vec<usize> = errors.iter().map(|e| e.0).collect();
    assert_eq!(lines, [[2; 21].as_slice(), &[3; 4]].concat(), "{errors:#?}");
    assert!(errors[20].1.contains("and 980 more mistakes"), "{errors:?}");
}
