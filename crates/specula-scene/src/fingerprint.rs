//! A number that tells scenes apart: whether a half-finished render belongs to a scene.

use core::fmt::{self, Write};
use core::hash::Hasher;

use twox_hash::XxHash3_64;

use crate::image::Image;
use crate::scene::{Mesh, Scene, Settings};

/// Bytes gathered before they are hashed.
const BLOCK: usize = 1 << 16;

impl Scene {
    /// XXH3 of all that shows in a picture: two scenes of the same number render the same, chances of
    /// 2^-64 apart. File names, and the depth and samples
    /// that the file asks for, have no part in it. The number
    /// means nothing to other versions of this crate.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        // In full, so that a field added to the scene is not forgotten here.
        let Self {
            camera,
            film,
            settings:
                Settings {
                    max_depth: _,
                    samples_per_pixel: _,
                    hide_emitters,
                    // A part of the render's settings.
                    energy: _,
                },
            images,
            textures,
            materials,
            meshes,
            shapes,
            objects,
            instances,
            lights,
            // A floor shows by its shape and material.
            floor: _,
        } = self;
        let mut hash = Hash::new();
        hash.text(camera);
        hash.text(film);
        hash.text(hide_emitters);
        hash.text(textures);
        hash.text(materials);
        hash.text(shapes);
        hash.text(objects);
        hash.text(instances);
        hash.text(lights);
        for image in images {
            hash.image(image);
        }
        for mesh in meshes {
            hash.mesh(mesh);
        }
        hash.finish()
    }
}

/// The hash, fed in blocks.
struct Hash {
    state: XxHash3_64,
    block: Vec<u8>,
}

impl Hash {
    fn new() -> Self {
        Self {
            state: XxHash3_64::new(),
            block: Vec::with_capacity(BLOCK),
        }
    }

    /// What `Debug` writes, which for numbers is exact.
    fn text(&mut self, value: &impl fmt::Debug) {
        // This writer never fails.
        let _ = write!(self, "{value:?}");
        self.bytes(&[0]);
    }

    fn image(&mut self, image: &Image) {
        let Image {
            name: _,
            width,
            height,
            pixels,
        } = image;
        self.bytes(&width.to_le_bytes());
        self.bytes(&height.to_le_bytes());
        self.bytes(&(pixels.len() as u64).to_le_bytes());
        for number in pixels.iter().flatten() {
            self.bytes(&number.to_le_bytes());
        }
    }

    fn mesh(&mut self, mesh: &Mesh) {
        let Mesh {
            positions,
            normals,
            uvs,
            second_uvs,
            tangents,
            colours,
            triangles,
        } = mesh;
        self.floats(positions);
        self.floats(normals);
        self.floats(uvs);
        self.floats(second_uvs);
        self.floats(tangents);
        self.floats(colours);
        self.bytes(&(triangles.len() as u64).to_le_bytes());
        for index in triangles.iter().flatten() {
            self.bytes(&index.to_le_bytes());
        }
    }

    /// A list of points, its length first, so that two lists never look like one.
    fn floats<const N: usize>(&mut self, points: &[[f32; N]]) {
        self.bytes(&(points.len() as u64).to_le_bytes());
        for number in points.iter().flatten() {
            self.bytes(&number.to_le_bytes());
        }
    }

    fn bytes(&mut self, bytes: &[u8]) {
        if self.block.len() + bytes.len() > BLOCK {
            self.state.write(&self.block);
            self.block.clear();
        }
        self.block.extend_from_slice(bytes);
    }

    fn finish(mut self) -> u64 {
        self.state.write(&self.block);
        self.state.finish()
    }
}

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.bytes(text.as_bytes());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::builtin;

    #[test]
    fn any_change_that_shows_changes_the_number() {
        let scene = builtin::orbs();
        let number = scene.fingerprint();
        assert_eq!(number, builtin::orbs().fingerprint());

        let changed = |change: fn(&mut crate::Scene)| {
            let mut other = builtin::orbs();
            change(&mut other);
            other.fingerprint() != number
        };
        assert!(changed(|s| s.shapes.swap(0, 1)));
        assert!(changed(|s| s.materials.swap(0, 1)));
        assert!(changed(|s| s.film.resolution[0] += 1));
        assert!(changed(|s| {
            s.lights.pop();
        }));
        assert!(changed(|s| {
            let x = &mut s.meshes[0].positions[0][0];
            *x = x.next_up();
        }));
        assert!(changed(|s| s.meshes[0].triangles[0].swap(0, 1)));
        assert!(!changed(|s| s.settings.samples_per_pixel += 1));
    }
}
