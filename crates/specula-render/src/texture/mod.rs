//! Textures: parameters that vary over surfaces.

mod flat;
mod footprint;
mod graph;
mod mapping;
mod noise;
mod normal_map;
mod raster;

use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::Scene;
use specula_scene::scene::{ColourParam, FloatParam, Texture, TextureId};

use graph::Node;
use normal_map::FilteredNormalMap;
use raster::Raster;

pub(crate) use flat::{colour_parameter, float_parameter};
pub(crate) use footprint::Footprint;
pub(crate) use normal_map::{NormalMoments, moment_pixels};
pub(crate) use raster::pyramid_pixels;

/// Where a texture is evaluated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TextureCoordinates {
    pub(crate) uv: [f32; 2],
    /// Second texture coordinates; 0 where the mesh has none.
    pub(crate) second_uv: [f32; 2],
    /// In the world.
    pub(crate) position: Vec3<f32>,
    /// Geometric normal in the world, unit: pbrt's `directionmix` takes this one, too.
    pub(crate) normal: Vec3<f32>,
    /// Vertex colour, interpolated; white where the mesh has none.
    pub(crate) colour: Rgb<f32>,
    /// What filtered textures are means over; `None`: the point alone.
    pub(crate) footprint: Option<Footprint>,
}

impl Default for TextureCoordinates {
    fn default() -> Self {
        Self {
            uv: [0.0; 2],
            second_uv: [0.0; 2],
            position: Vec3::ZERO,
            normal: vec3(0.0, 0.0, 1.0),
            colour: Rgb::WHITE,
            footprint: None,
        }
    }
}

/// Most nodes of a graph that is evaluated as a tree: each as often as others refer to it.
const LARGEST_TREE: u32 = 256;

/// The part of the graph that the value of a node depends on.
#[derive(Clone, Copy, Debug)]
struct Extent {
    /// Nodes of the tree that it unfolds to, which are evaluated.
    visits: u32,
    /// The first of the nodes that it depends on.
    first: usize,
}

/// All textures of a scene, with the pictures that they use.
#[derive(Clone, Debug, Default)]
pub(crate) struct Textures {
    /// By the scene's indices, then those of filtered normal maps. A node's inputs come before it.
    nodes: Vec<Node>,
    /// Of every node.
    extents: Vec<Extent>,
    /// By the scene's indices, then moments of normal maps; empty where no texture uses the picture.
    rasters: Vec<Raster>,
    /// Whether any depends on footprints.
    is_filtered: bool,
    /// Of normal maps that are filtered into roughness, by texture; may be shorter than the textures.
    normal_maps: Vec<Option<FilteredNormalMap>>,
}

impl Textures {
    /// The scene's textures, folded, with their pictures.
    ///
    /// * `scene`: left without the pixels of the pictures that only textures use.
    pub(crate) fn new(scene: &mut Scene) -> Self {
        let mut textures = Self {
            nodes: Vec::with_capacity(scene.textures.len()),
            extents: Vec::with_capacity(scene.textures.len()),
            rasters: vec![Raster::default(); scene.images.len()],
            is_filtered: false,
            normal_maps: Vec::new(),
        };
        let mut used = vec![false; scene.images.len()];
        let mut has_pyramid = vec![false; scene.images.len()];
        for texture in &scene.textures {
            if let Texture::Image { image, filter, .. } = texture {
                used[image.0] = true;
                has_pyramid[image.0] |= filter.is_filtered();
                textures.is_filtered |= filter.is_filtered();
            }
        }
        for (index, raster) in textures.rasters.iter_mut().enumerate() {
            if used[index] {
                let shared = scene.lights.iter().any(|light| {
                    let image = match light {
                        specula_scene::scene::Light::Infinite { image, .. }
                        | specula_scene::scene::Light::Portal { image, .. } => *image,
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
                if has_pyramid[index] {
                    *raster = std::mem::take(raster).with_pyramid();
                }
            }
        }
        for texture in &scene.textures {
            let node = textures.folded(Node::new(texture));
            textures.add(node);
        }
        textures
    }

    /// Adds a node.
    fn add(&mut self, node: Node) -> TextureId {
        let id = TextureId(self.nodes.len());
        self.extents.push(self.extent(&node));
        self.nodes.push(node);
        id
    }

    /// Of the next node.
    fn extent(&self, node: &Node) -> Extent {
        let alone = Extent {
            visits: 1,
            first: self.nodes.len(),
        };
        node.all_inputs().fold(alone, |extent, input| {
            let input = self.extents[input.0];
            Extent {
                visits: extent.visits.saturating_add(input.visits),
                first: extent.first.min(input.first),
            }
        })
    }

    /// The value of a texture. Small graphs are evaluated as trees, which skips inputs without weight; large ones node by
    /// node.
    #[inline]
    fn at(&self, id: TextureId, place: &TextureCoordinates) -> Rgb<f32> {
        let Extent { visits, first } = self.extents[id.0];
        if visits <= LARGEST_TREE {
            self.node(id.0, place)
        } else {
            self.in_order(first, id.0, place)
        }
    }

    /// A colour parameter at a point; 0 where it is not finite.
    #[inline]
    pub(crate) fn colour(&self, parameter: ColourParam, place: &TextureCoordinates) -> Rgb<f32> {
        let value = match parameter {
            ColourParam::Value(c) => c,
            ColourParam::Texture(id) => self.at(id, place),
        };
        value.map(finite)
    }

    /// A scalar parameter at a point; 0 where it is not finite.
    #[inline]
    pub(crate) fn float(&self, parameter: FloatParam, place: &TextureCoordinates) -> f32 {
        finite(match parameter {
            FloatParam::Value(v) => v,
            FloatParam::Texture(id) => self.at(id, place).r,
        })
    }

    /// The parameter, as a value where its texture is constant.
    pub(crate) fn fold_colour(&self, parameter: ColourParam) -> ColourParam {
        match parameter {
            ColourParam::Texture(id) => match self.nodes[id.0] {
                Node::Constant(c) => ColourParam::Value(c),
                _ => parameter,
            },
            ColourParam::Value(_) => parameter,
        }
    }

    /// The parameter, as a value where its texture is constant.
    pub(crate) fn fold_float(&self, parameter: FloatParam) -> FloatParam {
        match parameter {
            FloatParam::Texture(id) => match self.nodes[id.0] {
                Node::Constant(c) => FloatParam::Value(c.r),
                _ => parameter,
            },
            FloatParam::Value(_) => parameter,
        }
    }

    /// Whether the value of any texture depends on footprints.
    pub(crate) fn is_filtered(&self) -> bool {
        self.is_filtered
    }

    /// Whether any texture uses the colours of vertices.
    pub(crate) fn shows_vertex_colours(&self) -> bool {
        self.nodes.iter().any(|n| matches!(n, Node::VertexColour))
    }
}

#[inline(always)]
fn finite(v: f32) -> f32 {
    if v.is_finite() { v } else { 0.0 }
}
