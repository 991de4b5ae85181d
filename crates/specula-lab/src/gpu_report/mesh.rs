//! A mesh too large for the repository: a displaced sphere of any number of triangles.

use std::f64::consts::{PI, TAU};
use std::fs;
use std::io::Write;
use std::path::Path;

use super::Result;
use super::sky::direction;

/// Writes a closed sphere of radius about 0.9, its foot near the ground, as binary PLY without
/// normals: `2 segments (rings - 1)` triangles.
pub(crate) fn write_displaced_sphere(path: &Path, segments: u32, rings: u32) -> Result<()> {
    let mut file = std::io::BufWriter::new(fs::File::create(path)?);
    let (vertices, faces) = (segments * (rings - 1) + 2, 2 * segments * (rings - 1));
    write!(
        file,
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n\
         property float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )?;
    let mut vertex = |azimuth: f64, polar: f64| -> Result<()> {
        let d = direction(azimuth, polar);
        let radius = 0.9 * (1.0 + bump(d));
        for (axis, centre) in d.iter().zip([0.0, 0.98, 0.0]) {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "positions are stored in single precision"
            )]
            let value = (centre + radius * axis) as f32;
            file.write_all(&value.to_le_bytes())?;
        }
        Ok(())
    };
    vertex(0.0, 0.0)?;
    for ring in 1..rings {
        for segment in 0..segments {
            let azimuth = TAU * f64::from(segment) / f64::from(segments);
            vertex(azimuth, PI * f64::from(ring) / f64::from(rings))?;
        }
    }
    vertex(0.0, PI)?;
    let mut face = |corners: [u32; 3]| -> Result<()> {
        file.write_all(&[3])?;
        for corner in corners {
            file.write_all(&corner.to_le_bytes())?;
        }
        Ok(())
    };
    let last = vertices - 1;
    let at = |ring: u32, segment: u32| 1 + (ring - 1) * segments + segment % segments;
    for s in 0..segments {
        face([0, at(1, s + 1), at(1, s)])?;
        for ring in 1..rings - 1 {
            let [a, b] = [at(ring, s), at(ring, s + 1)];
            let [c, d] = [at(ring + 1, s), at(ring + 1, s + 1)];
            face([a, b, c])?;
            face([b, d, c])?;
        }
        face([at(rings - 1, s), at(rings - 1, s + 1), last])?;
    }
    file.flush()?;
    Ok(())
}

/// Waves of five scales, together at most 0.08 of the radius.
fn bump(d: [f64; 3]) -> f64 {
    let mut sum = 0.0;
    let (mut frequency, mut height) = (5.0, 0.04);
    for _ in 0..5 {
        let [x, y, z] = d.map(|c| frequency * c);
        sum += height * (x + 1.3 * (y + 0.7).sin()).sin() * (1.1 * y + 0.9 * z.cos()).cos();
        frequency *= 2.3;
        height *= 0.5;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mesh_is_closed_and_has_two_million_triangles() {
        assert_eq!(2 * 1000 * (1001 - 1), 2_000_000);
        let folder = std::env::temp_dir().join(format!("versus-mesh-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("small.ply");
        write_displaced_sphere(&path, 6, 5).unwrap();
        let bytes = fs::read(&path).unwrap();
        let header = bytes
            .windows(11)
            .position(|w| w == b"end_header\n")
            .unwrap()
            + 11;
        let (vertices, faces) = (6 * 4 + 2, 2 * 6 * 4);
        assert_eq!(bytes.len(), header + 12 * vertices + 13 * faces);
        let corner = |i: usize| u32::from_le_bytes(bytes[i..i + 4].try_into().unwrap());
        let mut edges = std::collections::HashMap::new();
        for face in 0..faces {
            let at = header + 12 * vertices + 13 * face + 1;
            let v = [corner(at), corner(at + 4), corner(at + 8)];
            for i in 0..3 {
                *edges.entry((v[i], v[(i + 1) % 3])).or_insert(0) += 1;
            }
        }
        for (&(a, b), &n) in &edges {
            assert_eq!(n, 1, "edge {a} {b}");
            assert!(edges.contains_key(&(b, a)), "edge {a} {b}");
        }
        fs::remove_dir_all(folder).unwrap();
    }
}
