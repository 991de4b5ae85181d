//! Parameters that may vary over surfaces, and textures.

use glam::DMat4;
use specula_bsdf::Rgb;

use super::{ImageId, TextureId};

/// A number, or a texture that gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FloatParam {
    /// The same everywhere.
    Value(f32),
    /// The red channel of a texture.
    Texture(TextureId),
}

/// A colour, or a texture that gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColourParam {
    /// The same everywhere.
    Value(Rgb<f32>),
    /// A texture.
    Texture(TextureId),
}

impl ColourParam {
    /// 1 everywhere.
    pub const WHITE: Self = Self::Value(Rgb::WHITE);
}

/// A texture node. Nodes that give a number hold it in all three channels.
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// The same everywhere.
    Constant(Rgb<f32>),
    /// A picture: `scale` times the chosen channel, then `max(0, 1 - it)` where `invert`.
    ///
    /// Pictures are stored from the top, and `(s, t) = mapping(u, v)` has its origin at the lower
    /// left: the value is that of column `s * width` and row `(1 - t) * height`, pixel centres at
    /// halves. (pbrt-v4 flips `t` at every lookup, too.)
    Image {
        /// The picture, already linear.
        image: ImageId,
        /// How surface coordinates become picture coordinates.
        mapping: TextureMapping,
        /// Values outside `[0, 1]^2`, along s and t.
        wrap: [Wrap; 2],
        /// Interpolation between pixels, or a mean over many.
        filter: Interpolation,
        /// Whether the value is replaced by 1 - value.
        invert: bool,
        /// Factor on the value.
        scale: f32,
        /// The channels that are read.
        channel: Channel,
    },
    /// The product of two textures.
    Scale {
        /// First factor.
        a: TextureId,
        /// Second factor.
        b: TextureId,
    },
    /// Interpolation: `(1 - amount) a + amount b`.
    Mix {
        /// At amount 0.
        a: TextureId,
        /// At amount 1.
        b: TextureId,
        /// Between them.
        amount: FloatParam,
    },
    /// Two-dimensional checks of unit size in mapped coordinates.
    Checkerboard {
        /// Where floor(u) + floor(v) is even.
        even: TextureId,
        /// Where it is odd.
        odd: TextureId,
        /// How surface coordinates become check coordinates.
        mapping: TextureMapping,
    },
    /// Three-dimensional checks of unit size.
    Checkerboard3d {
        /// Where the floors of the coordinates have an even sum.
        even: TextureId,
        /// Where it is odd.
        odd: TextureId,
        /// World space to check coordinates.
        to_texture: DMat4,
    },
    /// Bilinear interpolation between four values at the corners of `[0, 1]^2`.
    Bilinear {
        /// At (0, 0), (0, 1), (1, 0) and (1, 1).
        corners: [Rgb<f32>; 4],
        /// How surface coordinates become coordinates of the square.
        mapping: TextureMapping,
    },
    /// Random dots, as pbrt's `dots`.
    Dots {
        /// Within the dots.
        inside: TextureId,
        /// Elsewhere.
        outside: TextureId,
        /// How surface coordinates become coordinates of the cells.
        mapping: TextureMapping,
    },
    /// Gradient noise.
    Noise {
        /// Which sum of octaves.
        kind: NoiseKind,
        /// How many octaves.
        octaves: u32,
        /// Amplitude of an octave over that of the one before.
        roughness: f32,
        /// World space to noise coordinates.
        to_texture: DMat4,
    },
    /// The sum of two textures.
    Sum {
        /// First term.
        a: TextureId,
        /// Second term.
        b: TextureId,
    },
    /// 1 where a texture is at least `cutoff`, else 0 (glTF's alpha mask).
    Threshold {
        /// The texture.
        texture: TextureId,
        /// The bound.
        cutoff: f32,
    },
    /// Interpolation by direction, pbrt's `directionmix`: `t a + (1 - t) b` with `t = |ng . axis|`.
    DirectionMix {
        /// Where the normal is along the axis.
        a: TextureId,
        /// Where it is across.
        b: TextureId,
        /// Unit vector in the world.
        axis: [f32; 3],
    },
    /// The mesh's colours, interpolated; 1 where it has none.
    VertexColour,
}

/// Kinds of noise, by how octaves are summed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoiseKind {
    /// Fractional Brownian motion.
    Fbm,
    /// The sum of absolute values.
    Turbulence,
    /// pbrt's `windy`: waves whose strength is another noise.
    Windy,
    /// pbrt's `marble`: a colour ramp along y, disturbed by fractional Brownian motion.
    Marble {
        /// Factor on coordinates.
        scale: f32,
        /// Strength of the disturbance.
        variation: f32,
    },
}

/// The channels of a picture that a texture reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Channel {
    /// All three.
    Rgb,
    /// The mean of the three, as a number.
    Mean,
    /// The luminance, as a number.
    Luminance,
    /// The first, as a number.
    Red,
    /// The second, as a number.
    Green,
    /// The third, as a number.
    Blue,
}

impl Channel {
    /// The channel of a pixel, in all three where it is a number.
    #[must_use]
    #[inline]
    pub fn of(self, pixel: Rgb<f32>) -> Rgb<f32> {
        match self {
            Self::Rgb => pixel,
            Self::Mean => Rgb::splat(pixel.mean()),
            Self::Luminance => Rgb::splat(pixel.luminance()),
            Self::Red => Rgb::splat(pixel.r),
            Self::Green => Rgb::splat(pixel.g),
            Self::Blue => Rgb::splat(pixel.b),
        }
    }
}

/// How a value is taken from the pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interpolation {
    /// Bilinear interpolation between pixel centres.
    Bilinear,
    /// The pixel around the point.
    Nearest,
    /// The mean over a square around the point's footprint: bilinear interpolation within two levels of a pyramid of
    /// smaller pictures, and linear interpolation between them (Williams 1983).
    Trilinear,
    /// The Gaussian mean over the ellipse that is the point's footprint, on such a pyramid (Heckbert 1989).
    Ewa {
        /// The longest ellipse, as the ratio of its axes, in `[1, MOST_ANISOTROPY]`; longer ones are widened.
        max_anisotropy: f32,
    },
}

impl Interpolation {
    /// [`Interpolation::Ewa`] with the longest ellipses of pbrt-v4's default.
    pub const EWA: Self = Self::Ewa {
        max_anisotropy: 8.0,
    };
    /// Largest `max_anisotropy`: the work of a value grows with its square.
    pub const MOST_ANISOTROPY: f32 = 64.0;

    /// Whether values depend on footprints, and come from a pyramid.
    #[must_use]
    pub const fn is_filtered(self) -> bool {
        matches!(self, Self::Trilinear | Self::Ewa { .. })
    }
}

/// A mapping from a point on a surface to texture coordinates `(s, t)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextureMapping {
    /// From the surface coordinates.
    Uv(UvMapping),
    /// From the second set of surface coordinates; 0 where a mesh has none.
    SecondUv(UvMapping),
    /// From the position: `s = vs . p + ds`, `t = vt . p + dt` in texture space.
    Planar {
        /// World space to texture space.
        to_texture: DMat4,
        /// Vector of s and its offset.
        s: [f32; 4],
        /// Vector of t and its offset.
        t: [f32; 4],
    },
    /// From the direction to the position: `(theta / pi, phi / (2 pi))`.
    Spherical {
        /// World space to texture space.
        to_texture: DMat4,
    },
    /// From the azimuth and the height: `((pi + phi) / (2 pi), z)`.
    Cylindrical {
        /// World space to texture space.
        to_texture: DMat4,
    },
}

impl Default for TextureMapping {
    fn default() -> Self {
        Self::Uv(UvMapping::default())
    }
}

/// An affine map of surface coordinates.
///
/// ```text
/// s = m[0][0] u + m[0][1] v + m[0][2]
/// t = m[1][0] u + m[1][1] v + m[1][2]
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvMapping(pub [[f32; 3]; 2]);

impl UvMapping {
    /// `(su u + du, sv v + dv)`.
    #[must_use]
    pub fn scaled([su, sv]: [f32; 2], [du, dv]: [f32; 2]) -> Self {
        Self([[su, 0.0, du], [0.0, sv, dv]])
    }
}

impl Default for UvMapping {
    fn default() -> Self {
        Self::scaled([1.0; 2], [0.0; 2])
    }
}

/// Values of a picture outside `[0, 1]^2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// It repeats.
    Repeat,
    /// It is black.
    Black,
    /// Its border extends.
    Clamp,
    /// It repeats, every other copy mirrored.
    Mirror,
}
