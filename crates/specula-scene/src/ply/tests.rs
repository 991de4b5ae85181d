//! Tests of the PLY reader.

use crate::{Limits, scene::Mesh};

fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    polygons(bytes).map(|polygons| polygons.mesh)
}

fn polygons(bytes: &[u8]) -> Result<super::Polygons, String> {
    super::parse(bytes, &Limits::default(), false).map_err(|faults| faults[0].to_string())
}

const TEXT: &str = "ply\nformat ascii 1.0\ncomment a quad and a triangle\nelement vertex 5\n\
    property float x\nproperty float y\nproperty float z\nproperty float u\nproperty float v\n\
    element face 2\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n0 0 1 0.5 5e-1\n4 0 1 2 3\n3 0 1 4\n";

fn binary(little: bool, count: usize) -> Vec<u8> {
    let order = if little { "little" } else { "big" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 3\nproperty float x\n\
         property double y\nproperty float z\nproperty uchar red\nelement face {count}\n\
         property list uchar uint vertex_index\nproperty int face_indices\nend_header\n"
    )
    .into_bytes();
    for (x, y) in [(0f32, 0f64), (1.0, 0.0), (0.0, 1.0)] {
        let z = 2f32;
        if little {
            bytes.extend(x.to_le_bytes());
            bytes.extend(y.to_le_bytes());
            bytes.extend(z.to_le_bytes());
        } else {
            bytes.extend(x.to_be_bytes());
            bytes.extend(y.to_be_bytes());
            bytes.extend(z.to_be_bytes());
        }
        bytes.push(7);
    }
    bytes.push(3);
    for i in [0u32, 1, 2, 9] {
        bytes.extend(if little {
            i.to_le_bytes()
        } else {
            i.to_be_bytes()
        });
    }
    bytes
}

#[test]
fn text_with_polygons() {
    let mesh = parse(TEXT.as_bytes()).unwrap();
    assert_eq!(mesh.positions.len(), 5);
    assert_eq!(mesh.uvs[4], [0.5, 0.5]);
    assert!(mesh.normals.is_empty());
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 4]]);
}

#[test]
fn quadrilaterals_that_are_no_parallelograms_are_patches() {
    let (mesh, patches) = polygons(TEXT.as_bytes()).unwrap().split();
    assert!(mesh.triangles.len() == 3 && patches.is_none());
    let bent = TEXT.replace("1 1 0 1 1", "1 1 0.5 1 1");
    let (mesh, patches) = polygons(bent.as_bytes()).unwrap().split();
    let patches = patches.unwrap();
    // In the order of patches.
    assert_eq!(patches.patches, [[0, 1, 3, 2]]);
    assert_eq!(mesh.triangles, [[0, 1, 4]]);
    assert_eq!((patches.uvs[4], mesh.uvs.len()), ([0.5; 2], 5));
    // Where there must be triangles, they are those of the polygon.
    assert_eq!(patches.mesh().triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(patches.triangle_count(), 2);
    let alone = bent.replace("face 2", "face 1").replace("3 0 1 4\n", "");
    let (mesh, patches) = polygons(alone.as_bytes()).unwrap().split();
    assert!(mesh.positions.is_empty() && patches.unwrap().positions.len() == 5);
}

#[test]
fn both_binary_orders() {
    for little in [true, false] {
        let mesh = parse(&binary(little, 1)).unwrap();
        assert_eq!(
            mesh.positions,
            [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]]
        );
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
    }
}

#[test]
fn a_header_that_promises_too_much_is_an_error_at_once() {
    let error = parse(&binary(true, 1_000_000_000)).unwrap_err();
    assert!(error.contains("promises 1000000000"), "{error}");
    let text = TEXT.replace("element face 2", "element face 1000000000");
    assert!(parse(text.as_bytes()).unwrap_err().contains("promises"));
    let empty = "ply\nformat ascii 1.0\nelement vertex 99999999999\nend_header\n";
    assert!(
        parse(empty.as_bytes())
            .unwrap_err()
            .contains("no properties")
    );
    let overflow = TEXT.replace("element face 2", "element face 99999999999999999999999");
    assert!(parse(overflow.as_bytes()).is_err());
}

#[test]
fn every_truncation_is_an_error() {
    let whole = binary(true, 1);
    for length in 0..whole.len() {
        assert!(parse(&whole[..length]).is_err(), "{length} bytes");
    }
    let error = parse(&whole[..whole.len() - 1]).unwrap_err();
    assert!(error.contains("truncated"), "{error}");
}

#[test]
fn indices_must_exist() {
    let error = parse(TEXT.replace("3 0 1 4", "3 0 1 5").as_bytes()).unwrap_err();
    let message = "line 19: face 1 refers to vertex 5, but there are 5 vertices";
    assert_eq!(error, message);
    assert!(parse(TEXT.replace("3 0 1 4", "3 0 1 -4").as_bytes()).is_err());
    assert!(parse(TEXT.replace("3 0 1 4", "2 0 1").as_bytes()).is_err());
}

#[test]
fn a_list_with_a_huge_count_is_an_error() {
    let mut bytes = binary(true, 1);
    let at = bytes.len() - 17;
    bytes[at] = 255;
    assert!(parse(&bytes).unwrap_err().contains("truncated"));
}
