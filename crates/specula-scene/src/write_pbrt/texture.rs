//! Texture nodes, each written where it is first used.

use std::collections::HashMap;

use glam::DMat4;
use specula_bsdf::Rgb;

use super::{TextureType, WriteError, Writer, list, quoted, rgb_list, transform};
use crate::scene::{
    Channel, ColourParam, FloatParam, Interpolation, NoiseKind, Texture, TextureId, TextureMapping,
    UvMapping, Wrap,
};
use crate::validate::surface::inputs;

/// Deepest recursion over a texture's inputs; deeper graphs are written node by node.
const DEEPEST: usize = 500;

/// A texture's class and parameters, and the space that it lives in.
pub(super) struct TextureNode {
    class: &'static str,
    params: String,
    space: DMat4,
}

impl TextureNode {
    pub(super) fn new(class: &'static str, params: String) -> Self {
        Self {
            class,
            params,
            space: DMat4::IDENTITY,
        }
    }
}

impl Writer<'_> {
    /// ` "float NAME" [ x ]`, or a texture's name.
    pub(super) fn float_param(&mut self, name: &str, p: FloatParam) -> Result<String, WriteError> {
        Ok(match p {
            FloatParam::Value(x) => format!(" \"float {name}\" [ {x} ]"),
            FloatParam::Texture(id) => {
                let texture = self.texture(id, TextureType::Float)?;
                format!(" \"texture {name}\" [ {} ]", quoted(&texture))
            }
        })
    }

    /// ` "rgb NAME" [ r g b ]`, or a texture's name.
    pub(super) fn colour_param(
        &mut self,
        name: &str,
        p: ColourParam,
    ) -> Result<String, WriteError> {
        Ok(match p {
            ColourParam::Value(c) => format!(" \"rgb {name}\" [ {} ]", rgb_list(c)),
            ColourParam::Texture(id) => {
                let texture = self.texture(id, TextureType::Spectrum)?;
                format!(" \"texture {name}\" [ {} ]", quoted(&texture))
            }
        })
    }

    /// Writes a texture and those that it refers to, once; returns its name.
    pub(super) fn texture(
        &mut self,
        id: TextureId,
        wanted: TextureType,
    ) -> Result<String, WriteError> {
        let needed = self.needed(id);
        if needed.len() > DEEPEST {
            // Textures that are written are not visited again.
            for input in needed {
                self.tinted(input, wanted, Rgb::WHITE)?;
            }
        }
        self.tinted(id, wanted, Rgb::WHITE)
    }

    /// A texture and all that it depends on, inputs first.
    fn needed(&self, id: TextureId) -> Vec<TextureId> {
        let mut is_needed = vec![false; id.0 + 1];
        is_needed[id.0] = true;
        for i in (0..=id.0).rev() {
            if is_needed[i] {
                for input in inputs(&self.scene.textures[i]).into_iter().flatten() {
                    is_needed[input.0] = true;
                }
            }
        }
        let indices = (0..=id.0).filter(|i| is_needed[*i]);
        indices.map(TextureId).collect()
    }

    /// Writes a texture times a colour.
    pub(super) fn tinted(
        &mut self,
        id: TextureId,
        wanted: TextureType,
        tint: Rgb<f32>,
    ) -> Result<String, WriteError> {
        let key = (id, wanted, tint.to_array().map(f32::to_bits));
        if let Some(name) = self.textures.get(&key) {
            return Ok(name.clone());
        }
        let node = self.node(id, wanted, tint)?;
        let kind = match wanted {
            TextureType::Float => "float",
            TextureType::Spectrum => "spectrum",
        };
        let mut name = format!("texture-{}-{kind}", id.0);
        if tint != Rgb::WHITE {
            name += &format!("-{}", self.textures.len());
        }
        let directive = format!(
            "Texture {} \"{kind}\" \"{}\"{}",
            quoted(&name),
            node.class,
            node.params
        );
        if node.space == DMat4::IDENTITY {
            self.line(&directive);
        } else {
            // Names of textures outlive the attributes that they are made in.
            let place = transform(&node.space.inverse());
            self.line(&format!(
                "AttributeBegin\n{place}\n{directive}\nAttributeEnd"
            ));
        }
        self.textures.insert(key, name.clone());
        Ok(name)
    }

    /// ` "texture NAME" [ "..." ]`.
    pub(super) fn input(
        &mut self,
        name: &str,
        id: TextureId,
        wanted: TextureType,
        tint: Rgb<f32>,
    ) -> Result<String, WriteError> {
        let texture = self.tinted(id, wanted, tint)?;
        Ok(format!(" \"texture {name}\" [ {} ]", quoted(&texture)))
    }

    pub(super) fn value(name: &str, c: Rgb<f32>, wanted: TextureType) -> String {
        match wanted {
            TextureType::Float => format!(" \"float {name}\" [ {} ]", c.r),
            TextureType::Spectrum => format!(" \"rgb {name}\" [ {} ]", rgb_list(c)),
        }
    }

    fn pair(
        &mut self,
        class: &'static str,
        names: [&str; 2],
        ids: [TextureId; 2],
        (wanted, tint): (TextureType, Rgb<f32>),
    ) -> Result<TextureNode, WriteError> {
        let mut params = self.input(names[0], ids[0], wanted, tint)?;
        params += &self.input(names[1], ids[1], wanted, tint)?;
        Ok(TextureNode::new(class, params))
    }

    /// The node of a texture times a colour.
    pub(super) fn node(
        &mut self,
        id: TextureId,
        wanted: TextureType,
        tint: Rgb<f32>,
    ) -> Result<TextureNode, WriteError> {
        let (scene, kind) = (self.scene, (wanted, tint));
        Ok(match &scene.textures[id.0] {
            Texture::Constant(c) => {
                TextureNode::new("constant", Self::value("value", *c * tint, wanted))
            }
            image @ Texture::Image { .. } => self.image_map(image, tint)?,
            Texture::Scale { a, b } => return self.product([*a, *b], wanted, tint),
            Texture::Mix { a, b, amount } => {
                let mut node = self.pair("mix", ["tex1", "tex2"], [*a, *b], kind)?;
                node.params += &self.float_param("amount", *amount)?;
                node
            }
            Texture::DirectionMix { a, b, axis } => {
                let mut node = self.pair("directionmix", ["tex1", "tex2"], [*a, *b], kind)?;
                node.params += &format!(" \"vector3 dir\" [ {} ]", list(axis));
                node
            }
            Texture::Checkerboard { even, odd, mapping } => {
                let mut node = self.pair("checkerboard", ["tex1", "tex2"], [*even, *odd], kind)?;
                self.mapping(&mut node, mapping);
                node
            }
            Texture::Checkerboard3d {
                even,
                odd,
                to_texture,
            } => {
                let mut node = self.pair("checkerboard", ["tex1", "tex2"], [*even, *odd], kind)?;
                node.params += " \"integer dimension\" [ 3 ]";
                node.space = *to_texture;
                node
            }
            Texture::Dots {
                inside,
                outside,
                mapping,
            } => {
                let ids = [*inside, *outside];
                let mut node = self.pair("dots", ["inside", "outside"], ids, kind)?;
                self.mapping(&mut node, mapping);
                node
            }
            Texture::Bilinear { corners, mapping } => {
                let mut params = String::new();
                for (name, c) in ["v00", "v01", "v10", "v11"].into_iter().zip(corners) {
                    params += &Self::value(name, *c * tint, wanted);
                }
                let mut node = TextureNode::new("bilerp", params);
                self.mapping(&mut node, mapping);
                node
            }
            Texture::Noise {
                kind,
                octaves,
                roughness,
                to_texture,
            } => {
                let node = noise(*kind, *octaves, *roughness, to_texture);
                return self.noise(id, node, wanted, tint);
            }
            Texture::Sum { a, b: _ } => {
                self.note("sums of textures cannot be said: the first term is written");
                return self.node(*a, wanted, tint);
            }
            Texture::Threshold { texture, .. } => {
                self.note("thresholds of textures cannot be said: the texture itself is written");
                return self.node(*texture, wanted, tint);
            }
            Texture::VertexColour => {
                self.note("colours of vertices cannot be said: white is written");
                TextureNode::new("constant", Self::value("value", tint, wanted))
            }
        })
    }

    fn image_map(&mut self, texture: &Texture, tint: Rgb<f32>) -> Result<TextureNode, WriteError> {
        let Texture::Image {
            image,
            mapping,
            wrap,
            filter,
            invert,
            scale,
            channel,
        } = texture
        else {
            return Ok(TextureNode::new("constant", String::new()));
        };
        let (mut invert, mut scale) = (*invert, *scale);
        let file = match tint {
            // A file has one factor for all channels.
            Rgb { r, g, b } if r == g && g == b => {
                scale *= r;
                self.image(*image, *channel)?
            }
            _ => {
                let inverted = std::mem::replace(&mut invert, false);
                self.tinted_image(*image, *channel, inverted, tint)?
            }
        };
        if wrap[0] != wrap[1] {
            self.note("pictures that wrap differently along u and v wrap along both as along u");
        }
        let wrap = match wrap[0] {
            Wrap::Repeat => "repeat",
            Wrap::Black => "black",
            Wrap::Clamp => "clamp",
            Wrap::Mirror => {
                self.note("pictures cannot be mirrored where they repeat: they repeat plainly");
                "repeat"
            }
        };
        let filter = match filter {
            Interpolation::Bilinear => quoted("bilinear"),
            Interpolation::Nearest => quoted("point"),
            Interpolation::Trilinear => quoted("trilinear"),
            Interpolation::Ewa { max_anisotropy } => {
                format!("\"ewa\" ] \"float maxanisotropy\" [ {max_anisotropy}")
            }
        };
        let mut node = TextureNode::new(
            "imagemap",
            format!(
                " \"string filename\" [ {} ] \"string wrap\" [ \"{wrap}\" ] \
                 \"string filter\" [ {filter} ] \"bool invert\" [ {invert} ] \
                 \"float scale\" [ {scale} ]",
                quoted(&file)
            ),
        );
        self.mapping(&mut node, mapping);
        Ok(node)
    }

    fn mapping(&mut self, node: &mut TextureNode, mapping: &TextureMapping) {
        match mapping {
            TextureMapping::Uv(m) | TextureMapping::SecondUv(m) => {
                if matches!(mapping, TextureMapping::SecondUv(_)) {
                    self.note("second sets of surface coordinates become the first");
                }
                let UvMapping([[su, across, du], [along, sv, dv]]) = *m;
                if across != 0.0 || along != 0.0 {
                    self.note("rotated and sheared surface coordinates are written unrotated");
                }
                if *m != UvMapping::default() {
                    node.params += &format!(
                        " \"float uscale\" [ {su} ] \"float vscale\" [ {sv} ] \
                         \"float udelta\" [ {du} ] \"float vdelta\" [ {dv} ]"
                    );
                }
            }
            TextureMapping::Planar { to_texture, s, t } => {
                node.space = *to_texture;
                node.params += &format!(
                    " \"string mapping\" [ \"planar\" ] \"vector3 v1\" [ {} ] \
                     \"vector3 v2\" [ {} ] \"float udelta\" [ {} ] \"float vdelta\" [ {} ]",
                    list(&s[..3]),
                    list(&t[..3]),
                    s[3],
                    t[3]
                );
            }
            TextureMapping::Spherical { to_texture } => {
                node.space = *to_texture;
                node.params += " \"string mapping\" [ \"spherical\" ]";
            }
            TextureMapping::Cylindrical { to_texture } => {
                node.space = *to_texture;
                node.params += " \"string mapping\" [ \"cylindrical\" ]";
            }
        }
    }

    /// The picture behind a colour, and a factor on it, where it is laid plainly over the surface.
    pub(super) fn plain_picture(
        &self,
        p: ColourParam,
    ) -> Option<(crate::scene::ImageId, Rgb<f32>)> {
        let ColourParam::Texture(id) = p else {
            return None;
        };
        match &self.scene.textures[id.0] {
            Texture::Image {
                image,
                mapping,
                invert: false,
                scale,
                channel: Channel::Rgb,
                ..
            } if *mapping == TextureMapping::default() => Some((*image, Rgb::splat(*scale))),
            Texture::Scale { a, b } => {
                let constant = |id: &TextureId| match self.scene.textures[id.0] {
                    Texture::Constant(c) => Some(c),
                    _ => None,
                };
                let (inner, factor) = match (constant(a), constant(b)) {
                    (_, Some(c)) => (*a, c),
                    (Some(c), None) => (*b, c),
                    (None, None) => return None,
                };
                let (image, scale) = self.plain_picture(ColourParam::Texture(inner))?;
                Some((image, scale * factor))
            }
            _ => None,
        }
    }

    /// A texture's mean, as far as its nodes determine it.
    pub(super) fn mean(&self, p: ColourParam) -> Rgb<f32> {
        let id = match p {
            ColourParam::Value(c) => return c,
            ColourParam::Texture(id) => id,
        };
        // Once for each that it depends on, however often others refer to it.
        let mut means = HashMap::new();
        for input in self.needed(id) {
            let of = |id: TextureId| means.get(&id).copied().unwrap_or(Rgb::BLACK);
            let mean = self.mean_of(&self.scene.textures[input.0], of);
            means.insert(input, mean);
        }
        means.get(&id).copied().unwrap_or(Rgb::BLACK)
    }

    /// * `of`: the means of its inputs.
    fn mean_of(&self, texture: &Texture, of: impl Fn(TextureId) -> Rgb<f32>) -> Rgb<f32> {
        match texture {
            Texture::Constant(c) => *c,
            Texture::Image { image, scale, .. } => {
                let pixels = &self.scene.images[image.0].pixels;
                let mut sum = [0.0_f64; 3];
                for pixel in pixels.iter() {
                    for (s, x) in sum.iter_mut().zip(pixel) {
                        *s += f64::from(x);
                    }
                }
                let count = f64::from(u32::try_from(pixels.len()).unwrap_or(u32::MAX)).max(1.0);
                Rgb::from(sum.map(|s| s / count)).cast() * *scale
            }
            Texture::Scale { a, b } => of(*a) * of(*b),
            Texture::Sum { a, b } => of(*a) + of(*b),
            Texture::Mix { a, b, .. }
            | Texture::Checkerboard {
                even: a, odd: b, ..
            }
            | Texture::Checkerboard3d {
                even: a, odd: b, ..
            }
            | Texture::DirectionMix { a, b, .. }
            | Texture::Dots {
                inside: a,
                outside: b,
                ..
            } => (of(*a) + of(*b)) * 0.5,
            Texture::Bilinear { corners, .. } => {
                let [a, b, c, d] = *corners;
                (a + b + c + d) * 0.25
            }
            Texture::Threshold { .. } | Texture::VertexColour => Rgb::WHITE,
            Texture::Noise { .. } => Rgb::splat(0.5),
        }
    }
}

fn noise(kind: NoiseKind, octaves: u32, roughness: f32, to_texture: &DMat4) -> TextureNode {
    let waves = format!(" \"integer octaves\" [ {octaves} ] \"float roughness\" [ {roughness} ]");
    let (class, params) = match kind {
        NoiseKind::Fbm => ("fbm", waves),
        NoiseKind::Turbulence => ("wrinkled", waves),
        NoiseKind::Windy => ("windy", String::new()),
        NoiseKind::Marble { scale, variation } => (
            "marble",
            format!("{waves} \"float scale\" [ {scale} ] \"float variation\" [ {variation} ]"),
        ),
    };
    TextureNode {
        space: *to_texture,
        ..TextureNode::new(class, params)
    }
}
