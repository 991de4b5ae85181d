//! A hash of a scene, by which a checkpoint is matched with its scene.

mod parts;

use core::hash::Hasher;

use twox_hash::XxHash3_64;

use crate::scene::{Scene, Settings};
use parts::Part;

/// Version of the bytes that `parts` feeds. Whoever changes them raises it, and the version of the format of films.
const ENCODING: u32 = 1;

/// Bytes gathered before they are hashed.
const BLOCK: usize = 1 << 16;

impl Scene {
    /// A hash (XXH3) of everything in the scene that affects a picture: scenes with the same number render
    /// the same, but for a chance of 2^-64. Names, and the depth and samples that the file asks for, are
    /// not part of it. The number depends on
    /// neither machine nor compiler, but on the version of its encoding.
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
            measured,
            meshes,
            patch_meshes,
            curve_meshes,
            shapes,
            objects,
            instances,
            lights,
            // Its shape and material are hashed.
            floor: _,
        } = self;
        let mut hash = BlockHasher::new();
        ENCODING.feed(&mut hash);
        camera.feed(&mut hash);
        film.feed(&mut hash);
        hide_emitters.feed(&mut hash);
        textures.feed(&mut hash);
        materials.feed(&mut hash);
        shapes.feed(&mut hash);
        objects.feed(&mut hash);
        instances.feed(&mut hash);
        lights.feed(&mut hash);
        images.feed(&mut hash);
        meshes.feed(&mut hash);
        // Without a length: scenes that have none have the numbers that they had before there were any.
        for brdf in measured {
            brdf.content.feed(&mut hash);
        }
        for patches in patch_meshes {
            patches.feed(&mut hash);
        }
        for curves in curve_meshes {
            curves.feed(&mut hash);
        }
        for (i, _) in meshes.iter().enumerate().filter(|(_, m)| m.is_fibre) {
            i.feed(&mut hash);
        }
        // Likewise what does not move.
        for (part, motion) in self.motions() {
            part.feed(&mut hash);
            motion.feed(&mut hash);
        }
        hash.finish()
    }
}

/// The hash, fed in blocks.
struct BlockHasher {
    state: XxHash3_64,
    block: Vec<u8>,
}

impl BlockHasher {
    fn new() -> Self {
        Self {
            state: XxHash3_64::new(),
            block: Vec::with_capacity(BLOCK),
        }
    }

    #[inline(always)]
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

#[cfg(test)]
mod tests {
    use specula_bsdf::Rgb;

    use super::parts::Part;
    use super::*;
    use crate::builtin;
    use crate::scene::{
        ColourParam, ConductorFresnel, FloatParam, Light, Material, MaterialKind, Roughness,
        RoughnessMapping, SpotFalloff, TextureId,
    };

    /// A change of these numbers is one of `ENCODING` and of the version of the format of films.
    #[test]
    fn the_encoding_is_pinned() {
        let hash_of = |part: &dyn Part| {
            let mut hash = BlockHasher::new();
            part.feed(&mut hash);
            hash.finish()
        };
        let light = Light::Spot {
            position: [1.0, 2.0, 3.0],
            axis: [0.0, 0.0, -1.0],
            intensity: Rgb::splat(4.0),
            cone_angle_deg: 30.0,
            falloff_start_deg: 25.0,
            falloff: SpotFalloff::SquaredCosine,
        };
        let material = Material::new(MaterialKind::Conductor {
            fresnel: ConductorFresnel::Schlick(ColourParam::WHITE),
            roughness: Roughness::isotropic(FloatParam::Value(0.25), RoughnessMapping::Square),
            tint: ColourParam::Texture(TextureId(3)),
        });
        let numbers = [hash_of(&-0.5_f32), hash_of(&light), hash_of(&material)];
        let expected = [
            9_050_541_880_367_011_843,
            13_737_838_858_724_066_537,
            5_838_357_727_180_731_617,
        ];
        assert_eq!(numbers, expected);
    }

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
        assert!(changed(|s| s.camera.lens_radius = 0.1));
        assert!(changed(|s| s.materials[0].one_sided = true));
        assert!(changed(|s| s.shapes[0].reverse_orientation = true));
        assert!(!changed(|s| s.settings.samples_per_pixel += 1));
        assert!(!changed(|s| s.materials[0].name = None));
        assert!(!changed(|s| s.film.file_name = Some("a.exr".to_owned())));
    }
}
