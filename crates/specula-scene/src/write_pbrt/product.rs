//! Products of textures. pbrt-v4 multiplies a colour by a number only: colours are multiplied into the leaves
//! of the other factor.

use specula_bsdf::Rgb;

use super::texture::TextureNode;
use super::{TextureType, WriteError, Writer, quoted, rgb_list};
use crate::scene::{Channel, NoiseKind, Scene, Texture, TextureId};
use crate::validate::surface::inputs;

/// Whether the textures of a scene have no colours, by their indices.
pub(super) fn greys(scene: &Scene) -> Vec<bool> {
    let is_grey = |[r, g, b]: &[f32; 3]| r == g && g == b;
    let pictures: Vec<bool> = scene
        .images
        .iter()
        .map(|image| image.pixels.is_grey())
        .collect();
    let mut greys: Vec<bool> = Vec::with_capacity(scene.textures.len());
    for texture in &scene.textures {
        let own = match texture {
            Texture::Constant(c) => is_grey(&c.to_array()),
            Texture::Image { image, channel, .. } => *channel != Channel::Rgb || pictures[image.0],
            Texture::Bilinear { corners, .. } => corners.iter().all(|c| is_grey(&c.to_array())),
            Texture::Noise { kind, .. } => !matches!(kind, NoiseKind::Marble { .. }),
            Texture::VertexColour => false,
            _ => true,
        };
        let inputs = inputs(texture);
        greys.push(own && inputs.iter().flatten().all(|input| greys[input.0]));
    }
    greys
}

impl Writer<'_> {
    /// The product of two textures and a colour.
    pub(super) fn product(
        &mut self,
        [a, b]: [TextureId; 2],
        wanted: TextureType,
        tint: Rgb<f32>,
    ) -> Result<TextureNode, WriteError> {
        let constant = |id: TextureId| match self.scene.textures[id.0] {
            Texture::Constant(c) => Some(c),
            _ => None,
        };
        if wanted == TextureType::Spectrum {
            for (colour, other) in [(b, a), (a, b)] {
                if let Some(c) = constant(colour).filter(|_| !self.greys[colour.0]) {
                    return self.node(other, wanted, tint * c);
                }
            }
        }
        // The second is a number.
        let (a, b) = match (self.greys[a.0], self.greys[b.0]) {
            (true, false) => (b, a),
            (false, false) if wanted == TextureType::Spectrum => {
                self.note("of products of two coloured textures the second is written grey");
                (a, b)
            }
            _ => (a, b),
        };
        let mut params = self.input("tex", a, wanted, tint)?;
        params += &self.input("scale", b, TextureType::Float, Rgb::WHITE)?;
        Ok(TextureNode::new("scale", params))
    }

    /// A noise times a colour: pbrt-v4 has marble in colours, and the others as numbers.
    pub(super) fn noise(
        &mut self,
        id: TextureId,
        node: TextureNode,
        wanted: TextureType,
        tint: Rgb<f32>,
    ) -> Result<TextureNode, WriteError> {
        let is_number = self.greys[id.0];
        match wanted {
            TextureType::Float if is_number && tint == Rgb::WHITE => Ok(node),
            TextureType::Spectrum if !is_number && tint == Rgb::WHITE => Ok(node),
            TextureType::Float if !is_number => {
                self.note("marble cannot be a number: its mean is written");
                let params = Self::value("value", Rgb::splat(0.5) * tint, wanted);
                Ok(TextureNode::new("constant", params))
            }
            TextureType::Float => {
                let mut params = format!(" \"float tex\" [ {} ]", tint.r);
                params += &self.input("scale", id, TextureType::Float, Rgb::WHITE)?;
                Ok(TextureNode::new("scale", params))
            }
            TextureType::Spectrum if is_number => {
                let mut params = format!(" \"rgb tex\" [ {} ]", rgb_list(tint));
                params += &self.input("scale", id, TextureType::Float, Rgb::WHITE)?;
                Ok(TextureNode::new("scale", params))
            }
            TextureType::Spectrum => {
                let factor = tint.mean();
                if tint != Rgb::splat(factor) {
                    self.note("coloured factors on marble are written as their mean");
                }
                let marble = self.tinted(id, TextureType::Spectrum, Rgb::WHITE)?;
                let params = format!(
                    " \"texture tex\" [ {} ] \"float scale\" [ {factor} ]",
                    quoted(&marble)
                );
                Ok(TextureNode::new("scale", params))
            }
        }
    }
}
