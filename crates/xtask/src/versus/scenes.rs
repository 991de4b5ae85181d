//! The scenes of the comparison: their files, and the mesh and skies that are too large to keep.

use std::f64::consts::{PI, TAU};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use exr::prelude::write_rgb_file;

use crate::Result;

/// One scene.
pub(crate) struct SceneFile {
    /// The name of `data/versus/NAME.xml`.
    pub(crate) name: &'static str,
    /// What it holds.
    pub(crate) title: &'static str,
    /// First column and row of the detail that the sheet shows.
    pub(crate) detail: [usize; 2],
    /// What it needs beside its file.
    needs: &'static [&'static str],
}

/// All scenes.
pub(crate) const SCENES: [SceneFile; 4] = [
    SceneFile {
        name: "metal-room",
        title: "rough metal in a room of metal, one lamp, 12 bounces",
        detail: [90, 230],
        needs: &[],
    },
    SceneFile {
        name: "orbs-in-the-sun",
        title: "anisotropic orbs under a sky with a sun of half a degree",
        detail: [130, 250],
        needs: &["sky-sun.exr"],
    },
    SceneFile {
        name: "glass-and-metal",
        title: "smooth and rough glass, rough metal, two lamps",
        detail: [90, 230],
        needs: &[],
    },
    SceneFile {
        name: "two-million-triangles",
        title: "a displaced sphere of 2 million triangles, sky and a lamp",
        detail: [150, 150],
        needs: &["sky.exr", "displaced-sphere.ply"],
    },
];

impl SceneFile {
    /// Copies the scene into `folder`, makes what it needs there, and returns its file.
    pub(crate) fn prepare(&self, root: &Path, folder: &Path) -> Result<PathBuf> {
        fs::create_dir_all(folder)?;
        let name = format!("{}.xml", self.name);
        let file = folder.join(&name);
        fs::copy(root.join("data/versus").join(&name), &file)?;
        for need in self.needs {
            let path = folder.join(need);
            if path.exists() {
                continue;
            }
            match *need {
                "sky.exr" => write_sky(&path, 1024, None)?,
                "sky-sun.exr" => write_sky(&path, 2048, Some(Sun::LOW))?,
                _ => write_displaced_sphere(&path, 1000, 1001)?,
            }
        }
        Ok(file)
    }
}

/// A disc of even radiance.
#[derive(Clone, Copy)]
struct Sun {
    elevation_deg: f64,
    /// Column of the map, as a share of its width.
    across: f64,
    radius_deg: f64,
    radiance: [f64; 3],
}

impl Sun {
    /// About five times the sky's irradiance on the ground, 10^5 times the sky's radiance.
    const LOW: Self = Self {
        elevation_deg: 38.0,
        across: 0.36,
        radius_deg: 0.25,
        radiance: [60_000.0, 54_000.0, 45_000.0],
    };

    /// The share of a small square of the map, by latitude and azimuth, that the disc covers.
    fn coverage(self, azimuth: f64, polar: f64, [width, height]: [f64; 2]) -> f64 {
        const SIDE: u32 = 8;
        let centre = direction(TAU * self.across, PI * (0.5 - self.elevation_deg / 180.0));
        let least = (self.radius_deg * PI / 180.0).cos();
        let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
        let inside = |x: u32, y: u32| {
            let at = direction(azimuth + offset(x) * width, polar + offset(y) * height);
            (0..3).map(|i| at[i] * centre[i]).sum::<f64>() >= least
        };
        let near = direction(azimuth, polar);
        if (0..3).map(|i| near[i] * centre[i]).sum::<f64>() < 0.999 {
            return 0.0;
        }
        let hits = (0..SIDE * SIDE).filter(|k| inside(k % SIDE, k / SIDE));
        hits.count() as f64 / f64::from(SIDE * SIDE)
    }
}

fn direction(azimuth: f64, polar: f64) -> [f64; 3] {
    [
        polar.sin() * azimuth.sin(),
        polar.cos(),
        -polar.sin() * azimuth.cos(),
    ]
}

/// Writes a sky by latitude and longitude, the first and last rows at the poles, as Mitsuba's.
fn write_sky(path: &Path, width: u32, sun: Option<Sun>) -> Result<()> {
    let height = width / 2;
    let step = [TAU / f64::from(width), PI / f64::from(height - 1)];
    #[allow(
        clippy::cast_possible_truncation,
        reason = "radiances are stored in single precision"
    )]
    let pixel = |x: usize, y: usize| {
        let (azimuth, polar) = ((x as f64 + 0.5) * step[0], y as f64 * step[1]);
        let up = polar.cos();
        let low = (1.0 - up.abs()).powi(4);
        let mut colour = match up > 0.0 {
            true => [0.18 + 0.55 * low, 0.32 + 0.45 * low, 0.62 + 0.25 * low],
            false => [0.16, 0.14, 0.12],
        };
        if let Some(sun) = sun {
            let share = sun.coverage(azimuth, polar, step);
            (0..3).for_each(|i| colour[i] += share * sun.radiance[i]);
        }
        let [r, g, b] = colour.map(|c| c as f32);
        (r, g, b)
    };
    write_rgb_file(path, width as usize, height as usize, pixel)?;
    Ok(())
}

/// Writes a closed sphere of radius about 0.9, its foot near the ground, as binary PLY without
/// normals: `2 segments (rings - 1)` triangles.
fn write_displaced_sphere(path: &Path, segments: u32, rings: u32) -> Result<()> {
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
        let radius = 0.9 * (1.0 + relief(d));
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
fn relief(d: [f64; 3]) -> f64 {
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
    use crate::workspace;

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("versus-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn scenes_load_without_warnings() {
        let folder = scratch("scenes");
        for scene in &SCENES {
            let file = scene.prepare(&workspace::root(), &folder).unwrap();
            let loaded = specula_scene::load(&file).unwrap();
            assert!(
                loaded.warnings.is_empty(),
                "{}: {:?}",
                scene.name,
                loaded.warnings
            );
            let film = &loaded.scene.film;
            assert_eq!(film.resolution, [512, 512], "{}", scene.name);
            assert!(matches!(
                film.filter,
                specula_scene::scene::Filter::Box { radius: [0.5, 0.5] }
            ));
        }
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn the_mesh_is_closed_and_has_two_million_triangles() {
        assert_eq!(2 * 1000 * (1001 - 1), 2_000_000);
        let folder = scratch("mesh");
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

    #[test]
    fn the_sun_covers_its_solid_angle() {
        let width = 2048;
        let step = [TAU / f64::from(width), PI / f64::from(width / 2 - 1)];
        let mut covered = 0.0;
        for y in 0..width / 2 {
            let polar = f64::from(y) * step[1];
            for x in 0..width {
                let azimuth = (f64::from(x) + 0.5) * step[0];
                covered +=
                    Sun::LOW.coverage(azimuth, polar, step) * polar.sin() * step[0] * step[1];
            }
        }
        let exact = TAU * (1.0 - (Sun::LOW.radius_deg * PI / 180.0).cos());
        assert!((covered / exact - 1.0).abs() < 0.02, "{covered} {exact}");
    }
}
