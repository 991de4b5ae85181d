//! Texture graphs, evaluated.

use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;
use specula_scene::scene::{ColourParam, FloatParam, Scene, Texture, UvMapping, Wrap};

use crate::convert::floor_i32;

/// All textures of a scene, with the pictures that they use.
#[derive(Clone, Debug, Default)]
pub(crate) struct Textures {
    nodes: Vec<Texture>,
    /// By the scene's numbers; empty where no texture uses a picture.
    images: Vec<Raster>,
}

/// A picture's pixels, row by row from the top.
#[derive(Clone, Debug, Default)]
struct Raster {
    width: i32,
    height: i32,
    pixels: Vec<[f32; 3]>,
}

impl Textures {
    /// Copies what the scene's textures use.
    pub(crate) fn new(scene: &Scene) -> Self {
        let mut images = vec![Raster::default(); scene.images.len()];
        for texture in &scene.textures {
            if let Texture::Image { image, .. } = texture
                && images[image.0].pixels.is_empty()
            {
                let source = &scene.images[image.0];
                images[image.0] = Raster {
                    width: i32::try_from(source.width).unwrap_or(i32::MAX),
                    height: i32::try_from(source.height).unwrap_or(i32::MAX),
                    pixels: source.pixels.clone(),
                };
            }
        }
        Self {
            nodes: scene.textures.clone(),
            images,
        }
    }

    /// A colour at surface coordinates; 0 where it is no number.
    #[inline]
    pub(crate) fn colour(&self, parameter: ColourParam, uv: [f32; 2]) -> Rgb<f32> {
        let value = match parameter {
            ColourParam::Value(c) => c,
            ColourParam::Texture(id) => self.node(id.0, uv),
        };
        value.map(|v| if v.is_finite() { v } else { 0.0 })
    }

    /// A number at surface coordinates; 0 where it is none.
    #[inline]
    pub(crate) fn float(&self, parameter: FloatParam, uv: [f32; 2]) -> f32 {
        let value = match parameter {
            FloatParam::Value(v) => v,
            FloatParam::Texture(id) => self.node(id.0, uv).r,
        };
        if value.is_finite() { value } else { 0.0 }
    }

    fn node(&self, index: usize, uv: [f32; 2]) -> Rgb<f32> {
        match &self.nodes[index] {
            Texture::Constant(c) => *c,
            Texture::Image {
                image,
                mapping,
                wrap,
                invert,
                scale,
                as_float,
            } => {
                let mut c = self.images[image.0].bilinear(mapped(mapping, uv), *wrap);
                if *as_float {
                    c = Rgb::splat(c.mean());
                }
                if *invert {
                    c = c.map(|v| (1.0 - v).max(0.0));
                }
                c * *scale
            }
            Texture::Scale { a, b } => self.node(a.0, uv) * self.node(b.0, uv),
            Texture::Mix { a, b, amount } => {
                let t = self.float(*amount, uv);
                if t <= 0.0 {
                    self.node(a.0, uv)
                } else if t >= 1.0 {
                    self.node(b.0, uv)
                } else {
                    self.node(a.0, uv) * (1.0 - t) + self.node(b.0, uv) * t
                }
            }
            Texture::Checkerboard { even, odd, mapping } => {
                let [s, t] = mapped(mapping, uv);
                let sum = floor_i32(s).wrapping_add(floor_i32(t));
                self.node(if sum & 1 == 0 { even.0 } else { odd.0 }, uv)
            }
        }
    }
}

#[inline]
fn mapped(m: &UvMapping, uv: [f32; 2]) -> [f32; 2] {
    [
        m.scale[0] * uv[0] + m.offset[0],
        m.scale[1] * uv[1] + m.offset[1],
    ]
}

impl Raster {
    /// Bilinear interpolation between pixel centres; v = 0 is the lower edge of the picture, as in
    /// pbrt.
    fn bilinear(&self, [s, t]: [f32; 2], wrap: Wrap) -> Rgb<f32> {
        if self.pixels.is_empty() || !(s.is_finite() && t.is_finite()) {
            return Rgb::BLACK;
        }
        // Repeated coordinates are reduced first: pixel numbers stay small and exact.
        let (s, t) = if wrap == Wrap::Repeat {
            (s - s.floor(), t - t.floor())
        } else {
            (s, t)
        };
        let x = s * self.width as f32 - 0.5;
        let y = (1.0 - t) * self.height as f32 - 0.5;
        let (x0, y0) = (floor_i32(x), floor_i32(y));
        let (fx, fy) = (x - x.floor(), y - y.floor());
        let at = |dx: i32, dy: i32| self.pixel(x0.saturating_add(dx), y0.saturating_add(dy), wrap);
        (at(0, 0) * (1.0 - fx) + at(1, 0) * fx) * (1.0 - fy)
            + (at(0, 1) * (1.0 - fx) + at(1, 1) * fx) * fy
    }

    #[inline]
    fn pixel(&self, x: i32, y: i32, wrap: Wrap) -> Rgb<f32> {
        let inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        let (x, y) = match wrap {
            _ if inside => (x, y),
            Wrap::Repeat => (x.rem_euclid(self.width), y.rem_euclid(self.height)),
            Wrap::Clamp => (x.clamp(0, self.width - 1), y.clamp(0, self.height - 1)),
            Wrap::Black => return Rgb::BLACK,
        };
        let at = usize::try_from(i64::from(y) * i64::from(self.width) + i64::from(x)).unwrap_or(0);
        let [r, g, b] = self.pixels[at];
        rgb(r, g, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_scene::scene::TextureId;

    fn textures(nodes: Vec<Texture>) -> Textures {
        Textures {
            nodes,
            images: vec![Raster {
                width: 2,
                height: 2,
                // Upper row 0, 1; lower row 2, 3.
                pixels: vec![[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]],
            }],
        }
    }

    fn image(wrap: Wrap) -> Texture {
        Texture::Image {
            image: specula_scene::scene::ImageId(0),
            mapping: UvMapping {
                scale: [1.0; 2],
                offset: [0.0; 2],
            },
            wrap,
            invert: false,
            scale: 1.0,
            as_float: false,
        }
    }

    #[test]
    fn pictures_stand_upright_and_interpolate() {
        let t = textures(vec![image(Wrap::Clamp)]);
        let at = |u, v| t.colour(ColourParam::Texture(TextureId(0)), [u, v]).r;
        assert_eq!(at(0.25, 0.75), 0.0);
        assert_eq!(at(0.75, 0.75), 1.0);
        assert_eq!(at(0.25, 0.25), 2.0);
        assert_eq!(at(0.5, 0.5), 1.5);
        assert_eq!(at(-5.0, -5.0), 2.0);
        assert_eq!(at(f32::NAN, 0.5), 0.0);
    }

    #[test]
    fn wraps_differ_outside() {
        let black = textures(vec![image(Wrap::Black)]);
        let repeat = textures(vec![image(Wrap::Repeat)]);
        let id = ColourParam::Texture(TextureId(0));
        assert_eq!(black.colour(id, [1.75, 0.25]).r, 0.0);
        assert_eq!(repeat.colour(id, [1.75, 0.25]).r, 3.0);
        assert_eq!(repeat.colour(id, [-1.25, -0.75]).r, 3.0);
    }

    #[test]
    fn graphs_combine() {
        let t = textures(vec![
            Texture::Constant(Rgb::splat(2.0)),
            Texture::Constant(Rgb::splat(6.0)),
            Texture::Scale {
                a: TextureId(0),
                b: TextureId(1),
            },
            Texture::Mix {
                a: TextureId(0),
                b: TextureId(1),
                amount: FloatParam::Value(0.25),
            },
            Texture::Checkerboard {
                even: TextureId(0),
                odd: TextureId(1),
                mapping: UvMapping {
                    scale: [2.0; 2],
                    offset: [0.0; 2],
                },
            },
        ]);
        let at = |i, u, v| t.colour(ColourParam::Texture(TextureId(i)), [u, v]).g;
        assert_eq!(at(2, 0.0, 0.0), 12.0);
        assert_eq!(at(3, 0.0, 0.0), 3.0);
        assert_eq!(
            (at(4, 0.1, 0.1), at(4, 0.6, 0.1), at(4, -0.1, 0.1)),
            (2.0, 6.0, 6.0)
        );
    }
}
