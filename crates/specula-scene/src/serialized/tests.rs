//! Tests of serialized meshes, on files that are written here.

use std::io::Write;

use super::*;

/// A file of triangles, one mesh for each x; coordinates only in the second.
fn file(version: u16, double: bool, xs: &[f32]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut offsets = Vec::new();
    for (number, &x) in xs.iter().enumerate() {
        offsets.push(bytes.len());
        bytes.extend(MAGIC.to_le_bytes());
        bytes.extend(version.to_le_bytes());
        let mut body = Vec::new();
        let precision = if double { DOUBLE_PRECISION } else { 0x1000 };
        let uvs = if number == 1 { HAS_UVS } else { 0 };
        body.extend((precision | uvs | HAS_NORMALS).to_le_bytes());
        if version == 4 {
            body.extend(b"name\0");
        }
        body.extend(3_u64.to_le_bytes());
        body.extend(1_u64.to_le_bytes());
        let positions = [x, 0.0, 0.0, x + 1.0, 0.0, 0.0, x, 1.0, 0.0];
        let normals = [0.0, 0.0, 1.0].repeat(3);
        let coordinates = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
        let mut floats = positions.to_vec();
        floats.extend(normals);
        floats.extend(coordinates.iter().filter(|_| number == 1));
        for v in floats {
            if double {
                body.extend(f64::from(v).to_le_bytes());
            } else {
                body.extend(v.to_le_bytes());
            }
        }
        for i in [0_u32, 1, 2] {
            body.extend(i.to_le_bytes());
        }
        let mut packer =
            flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        packer.write_all(&body).unwrap();
        bytes.extend(packer.finish().unwrap());
    }
    for offset in &offsets {
        if version == 3 {
            bytes.extend(u32::try_from(*offset).unwrap().to_le_bytes());
        } else {
            bytes.extend((*offset as u64).to_le_bytes());
        }
    }
    bytes.extend(u32::try_from(offsets.len()).unwrap().to_le_bytes());
    bytes
}

#[test]
fn both_versions_and_precisions_are_read() {
    for (version, double) in [(3, false), (3, true), (4, false), (4, true)] {
        let bytes = file(version, double, &[5.0, 7.0, 9.0]);
        for (index, x) in [(0, 5.0), (1, 7.0), (2, 9.0)] {
            let read = parse(&bytes, index, &Limits::default()).unwrap();
            assert_eq!(read.mesh.positions[1], [x + 1.0, 0.0, 0.0], "{version}");
            assert_eq!(read.mesh.normals, [[0.0, 0.0, 1.0]; 3]);
            assert_eq!(read.mesh.uvs.len(), if index == 1 { 3 } else { 0 });
            assert_eq!(read.mesh.triangles, [[0, 1, 2]]);
            assert!(!read.face_normals);
        }
    }
}

#[test]
fn faults_are_named() {
    let good = file(4, false, &[0.0, 1.0]);
    let message = |bytes: &[u8], index| parse(bytes, index, &Limits::default()).unwrap_err();
    assert!(message(&good, 2).contains("the file has 2"));
    assert!(message(&good[..3], 0).contains("header of 4 bytes"));
    assert!(message(b"ply\nformat", 0).contains("0x041C"));
    assert!(message(&[0x1c, 0x04, 5, 0], 0).contains("found 5"));
    assert!(message(&good[..20], 0).contains("truncated"));
    for length in 0..good.len() {
        // Shorter files may still hold the first mesh whole; none may panic.
        let _ = parse(&good[..length], 1, &Limits::default());
        let _ = parse(&good[..length], 0, &Limits::default());
    }
    let strict = Limits {
        max_vertices: 2,
        ..Limits::default()
    };
    let error = parse(&good, 0, &strict).unwrap_err();
    assert!(error.contains("at most 2"), "{error}");
}
