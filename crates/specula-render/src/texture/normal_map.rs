//! Normal maps that are filtered into roughness: their textures, and the moments of slopes over a footprint.
//!
//! A normal map that is a picture gets three textures: its own, interpolated bilinearly, and the pictures of its moments
//! ([`Raster::slope_moments`](super::raster::Raster)), of which means over footprints alone are taken.

use specula_bsdf::Rgb;
use specula_scene::Scene;
use specula_scene::scene::{
    Bump, Channel, ColourParam, Interpolation, MaterialKind, Texture, TextureId, Wrap,
};

use super::graph::{Node, Picture};
use super::raster::{Lookup, pyramid_pixels, slope_of};
use super::{TextureCoordinates, Textures};

/// The textures of a normal map that is filtered into roughness.
#[derive(Clone, Copy, Debug)]
pub(super) struct FilteredNormalMap {
    /// The map, interpolated bilinearly.
    pub(super) normals: TextureId,
    /// Mean slopes over what is averaged, then the share that is: `(s B, s)`.
    pub(super) slopes: TextureId,
    /// Their second moments `(xx, xy, yy)`, times the share.
    pub(super) squares: TextureId,
}

/// Moments of the slopes `(x, y) / z` of normals over a footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NormalMoments {
    /// Mean.
    pub(crate) mean: [f32; 2],
    /// Of `x^2`, `x y` and `y^2`.
    pub(crate) squares: [f32; 3],
}

/// What pictures of moments depend on.
#[derive(Clone, Copy, PartialEq)]
struct MomentKey {
    image: usize,
    wrap: [Wrap; 2],
    channel: Channel,
    invert: bool,
    scale: f32,
}

impl Textures {
    /// Prepares the scene's normal maps for [`Textures::filtered_normal`].
    pub(crate) fn filter_normal_maps(&mut self, scene: &Scene) {
        let mut made: Vec<(MomentKey, usize)> = Vec::new();
        for (map, key) in filtered_normal_maps(scene) {
            if self.normal_maps.len() <= map.0 {
                self.normal_maps.resize(map.0 + 1, None);
            }
            let Node::Image(picture) = Node::new(&scene.textures[map.0]) else {
                continue;
            };
            let known = made.iter().find(|(k, _)| *k == key);
            let image = known.map(|(_, image)| *image).unwrap_or_else(|| {
                let normal = |pixel| normal_of(picture.value(pixel));
                let moments = self.rasters[picture.image].slope_moments(key.wrap, normal);
                let image = self.rasters.len();
                self.rasters.extend(moments);
                made.push((key, image));
                image
            });
            let filter = match picture.lookup.filter {
                Interpolation::Bilinear => Interpolation::EWA,
                other => other,
            };
            let means = |image| Picture {
                image,
                mapping: picture.mapping,
                lookup: Lookup {
                    wrap: key.wrap,
                    filter,
                    means_only: true,
                },
                channel: Channel::Rgb,
                invert: false,
                scale: 1.0,
            };
            let [slopes, squares] = [image, image + 1].map(means);
            let mut normals = picture.clone();
            normals.lookup.filter = Interpolation::Bilinear;
            self.normal_maps[map.0] = Some(FilteredNormalMap {
                normals: self.add(Node::Image(normals)),
                slopes: self.add(Node::Image(slopes)),
                squares: self.add(Node::Image(squares)),
            });
            self.is_filtered = true;
        }
    }

    /// The textures of a normal map; `None` where it is not filtered into roughness.
    pub(super) fn filtered_normal_map(&self, map: TextureId) -> Option<&FilteredNormalMap> {
        self.normal_maps.get(map.0)?.as_ref()
    }

    /// The texture of a filtered map's normals, behind which those of its moments are.
    pub(crate) fn filtered_normals(&self, map: TextureId) -> Option<TextureId> {
        self.filtered_normal_map(map).map(|map| map.normals)
    }

    /// The normal of a map at a point, not unit, and the moments over its footprint; `None` where nothing is averaged.
    #[inline]
    pub(crate) fn normal(
        &self,
        map: TextureId,
        place: &TextureCoordinates,
    ) -> ([f32; 3], Option<NormalMoments>) {
        let colour = |id| self.colour(ColourParam::Texture(id), place);
        let Some(filtered) = self.filtered_normal_map(map) else {
            return (normal_of(colour(map)), None);
        };
        let slopes = colour(filtered.slopes);
        let share = slopes.b.min(1.0);
        if share <= 0.0 {
            return (normal_of(colour(filtered.normals)), None);
        }
        let squares = colour(filtered.squares);
        let mut mean = [slopes.r, slopes.g];
        let mut second = squares.to_array();
        if share < 1.0 {
            let [p, q] = slope_of(normal_of(colour(filtered.normals)));
            let rest = 1.0 - share;
            mean = [mean[0] + rest * p, mean[1] + rest * q];
            for (sum, of_point) in second.iter_mut().zip([p * p, p * q, q * q]) {
                *sum += rest * of_point;
            }
        }
        let moments = NormalMoments {
            mean,
            squares: second,
        };
        ([mean[0], mean[1], 1.0], Some(moments))
    }
}

/// The normal that a colour of a normal map stands for.
fn normal_of(c: Rgb<f32>) -> [f32; 3] {
    [c.r, c.g, c.b].map(|v| 2.0 * v - 1.0)
}

/// The normal maps that can be filtered, each once: pictures that are interpolated.
fn filtered_normal_maps(scene: &Scene) -> Vec<(TextureId, MomentKey)> {
    let mut found: Vec<(TextureId, MomentKey)> = Vec::new();
    for material in &scene.materials {
        let coat = match &material.kind {
            MaterialKind::Gltf(g) => g.clearcoat_bump,
            _ => None,
        };
        for bump in [material.bump, coat].into_iter().flatten() {
            let Bump::Normal { map, .. } = bump else {
                continue;
            };
            if let Some(key) = MomentKey::of(&scene.textures[map.0])
                && found.iter().all(|(known, _)| *known != map)
            {
                found.push((map, key));
            }
        }
    }
    found
}

impl MomentKey {
    fn of(texture: &Texture) -> Option<Self> {
        match *texture {
            Texture::Image {
                image,
                wrap,
                filter,
                invert,
                scale,
                channel,
                ..
            } if filter != Interpolation::Nearest => Some(Self {
                image: image.0,
                wrap,
                channel,
                invert,
                scale,
            }),
            _ => None,
        }
    }
}

/// Pixels of the pictures of moments of a scene's normal maps, each six floats, with their pyramids.
pub(crate) fn moment_pixels(scene: &Scene) -> u64 {
    let mut counted: Vec<MomentKey> = Vec::new();
    let mut pixels = 0;
    for (_, key) in filtered_normal_maps(scene) {
        if !counted.contains(&key) {
            counted.push(key);
            let image = &scene.images[key.image];
            let size = [image.width, image.height];
            pixels += u64::from(size[0]) * u64::from(size[1]) + pyramid_pixels(size);
        }
    }
    pixels
}

#[cfg(test)]
mod tests;
