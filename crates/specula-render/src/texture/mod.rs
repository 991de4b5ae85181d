//! Textures: parameters that vary over surfaces.

mod flat;
mod graph;
mod mapping;
mod noise;
mod raster;

use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::Scene;
use specula_scene::scene::{ColourParam, FloatParam, Texture};

use graph::Node;
use raster::Raster;

pub(crate) use flat::{colour_parameter, float_parameter};

/// Where a texture is evaluated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) uv: [f32; 2],
    /// Of the second set; 0 where the mesh has none.
    pub(crate) second_uv: [f32; 2],
    /// In the world.
    pub(crate) position: Vec3<f32>,
    /// Geometric normal in the world, unit: pbrt's `directionmix` takes this one, too.
    pub(crate) normal: Vec3<f32>,
    /// The mesh's, interpolated; white where it has none.
    pub(crate) colour: Rgb<f32>,
}

impl Default for Place {
    fn default() -> Self {
        Self {
            uv: [0.0; 2],
            second_uv: [0.0; 2],
            position: Vec3::ZERO,
            normal: vec3(0.0, 0.0, 1.0),
            colour: Rgb::WHITE,
        }
    }
}

/// All textures of a scene, with the pictures that they use.
#[derive(Clone, Debug, Default)]
pub(crate) struct Textures {
    /// By the scene's numbers. A node's inputs come before it.
    nodes: Vec<Node>,
    /// By the scene's numbers; empty where no texture uses a picture.
    rasters: Vec<Raster>,
}

impl Textures {
    /// Takes what the scene's textures use.
    ///
    /// * `scene`: left without the pixels of the pictures that only textures use.
    pub(crate) fn new(scene: &mut Scene) -> Self {
        let mut textures = Self {
            nodes: Vec::with_capacity(scene.textures.len()),
            rasters: vec![Raster::default(); scene.images.len()],
        };
        let mut used = vec![false; scene.images.len()];
        for texture in &scene.textures {
            if let Texture::Image { image, .. } = texture {
                used[image.0] = true;
            }
        }
        for (index, raster) in textures.rasters.iter_mut().enumerate() {
            if used[index] {
                let shared = scene.lights.iter().any(|light| {
                    let image = match light {
                        specula_scene::scene::Light::Infinite { image, .. } => *image,
                        _ => None,
                    };
                    image.is_some_and(|(id, _)| id.0 == index)
                });
                let image = &mut scene.images[index];
                let pixels = if shared {
                    image.pixels.clone()
                } else {
                    std::mem::take(&mut image.pixels)
                };
                *raster = Raster::new(image.width, image.height, pixels);
            }
        }
        for texture in &scene.textures {
            let node = textures.folded(Node::new(texture));
            textures.nodes.push(node);
        }
        textures
    }

    /// A colour at a place; 0 where it is no number.
    #[inline]
    pub(crate) fn colour(&self, parameter: ColourParam, place: &Place) -> Rgb<f32> {
        let value = match parameter {
            ColourParam::Value(c) => c,
            ColourParam::Texture(id) => self.node(id.0, place),
        };
        value.map(finite)
    }

    /// A number at a place; 0 where it is none.
    #[inline]
    pub(crate) fn float(&self, parameter: FloatParam, place: &Place) -> f32 {
        finite(match parameter {
            FloatParam::Value(v) => v,
            FloatParam::Texture(id) => self.node(id.0, place).r,
        })
    }

    /// The same parameter, as a value where its texture is the same everywhere.
    pub(crate) fn fold_colour(&self, parameter: ColourParam) -> ColourParam {
        match parameter {
            ColourParam::Texture(id) => match self.nodes[id.0] {
                Node::Constant(c) => ColourParam::Value(c),
                _ => parameter,
            },
            ColourParam::Value(_) => parameter,
        }
    }

    /// The same parameter, as a value where its texture is the same everywhere.
    pub(crate) fn fold_float(&self, parameter: FloatParam) -> FloatParam {
        match parameter {
            FloatParam::Texture(id) => match self.nodes[id.0] {
                Node::Constant(c) => FloatParam::Value(c.r),
                _ => parameter,
            },
            FloatParam::Value(_) => parameter,
        }
    }

    /// Whether any texture shows the colours of vertices.
    pub(crate) fn shows_vertex_colours(&self) -> bool {
        self.nodes.iter().any(|n| matches!(n, Node::VertexColour))
    }
}

/// Whether a texture keeps this picture in a byte for each number: a quarter of the memory.
pub(crate) fn is_of_bytes(image: &specula_scene::Image) -> bool {
    raster::is_of_bytes(&image.pixels)
}

#[inline(always)]
fn finite(v: f32) -> f32 {
    if v.is_finite() { v } else { 0.0 }
}
