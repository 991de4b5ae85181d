//! Numbers, colours and textures.

use std::rc::Rc;

use glam::DMat4;
use specula_bsdf::Rgb;

use super::context::Context;
use super::element::{Element, Property};
use super::number;
use super::spectrum::{self, SpectrumUse};
use super::value::{Samples, Value};
use crate::error::{ErrorKind, SceneError};
use crate::image::Encoding;
use crate::num::{f32_of, shorten};
use crate::scene::{
    Channel, ColourParam, FloatParam, Interpolation, Texture, TextureId, TextureMapping, UvMapping,
    Wrap,
};

/// The use of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Role {
    Colour(SpectrumUse),
    Number,
}

/// Whose surface coordinates a texture is read for. Mitsuba's differ from the scene's on spheres
/// and disks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Frame {
    Mesh,
    /// `(phi / 2 pi, theta / pi)`, theta from +z.
    Sphere,
    /// `(r, phi / 2 pi)`.
    Disk,
}

impl Frame {
    /// The scene's surface coordinates to Mitsuba's, as rows.
    fn rows(self) -> Rows {
        match self {
            Self::Mesh => IDENTITY,
            Self::Sphere => [[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]],
            Self::Disk => [[0.0, -1.0, 1.0], [1.0, 0.0, 0.0]],
        }
    }
}

/// Rows of an affine map of the plane.
type Rows = [[f64; 3]; 2];

const IDENTITY: Rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// `after` applied to the result of `first`.
fn compose(after: &Rows, first: &Rows) -> Rows {
    let row = |r: &[f64; 3]| {
        let at = |c: usize| r[0] * first[0][c] + r[1] * first[1][c];
        [at(0), at(1), at(2) + r[2]]
    };
    [row(&after[0]), row(&after[1])]
}

/// A texture, or the one value that it has everywhere.
#[derive(Clone, Copy)]
pub(super) enum ValueOrTexture {
    Value(Rgb<f32>),
    Texture(TextureId),
}

impl Context<'_> {
    /// A colour or a texture of colours.
    pub(super) fn colour(
        &mut self,
        element: &Element,
        name: &str,
        default: f32,
        wanted: SpectrumUse,
    ) -> Result<ColourParam, SceneError> {
        let Some(property) = element.find(name) else {
            return Ok(ColourParam::Value(Rgb::splat(default)));
        };
        let read = self.value(element, property, Role::Colour(wanted));
        Ok(
            match element.or(read, || ValueOrTexture::Value(Rgb::splat(default)))? {
                ValueOrTexture::Value(c) => ColourParam::Value(c),
                ValueOrTexture::Texture(id) => ColourParam::Texture(id),
            },
        )
    }

    /// A number or a texture of numbers.
    pub(super) fn float(
        &mut self,
        element: &Element,
        name: &str,
        default: f32,
    ) -> Result<FloatParam, SceneError> {
        let Some(property) = element.find(name) else {
            return Ok(FloatParam::Value(default));
        };
        let read = self.value(element, property, Role::Number);
        let built = element.or(read, || ValueOrTexture::Value(Rgb::splat(default)))?;
        Ok(match built {
            ValueOrTexture::Value(c) => FloatParam::Value(c.r),
            ValueOrTexture::Texture(id) => FloatParam::Texture(id),
        })
    }

    /// A colour that does not vary over a surface.
    pub(super) fn even_colour(
        &mut self,
        element: &Element,
        name: &str,
        default: f32,
        wanted: SpectrumUse,
    ) -> Result<Rgb<f32>, SceneError> {
        match self.colour(element, name, default, wanted)? {
            ColourParam::Value(c) => Ok(c),
            ColourParam::Texture(_) => {
                let message = format!(
                    "\"{name}\" of {}: expected a colour, found a texture",
                    element.title()
                );
                Err(SceneError::new(
                    ErrorKind::Parameter,
                    &element.place_of(name),
                    message,
                ))
            }
        }
    }

    /// The value of a property in a role.
    pub(super) fn value(
        &mut self,
        element: &Element,
        property: &Property,
        role: Role,
    ) -> Result<ValueOrTexture, SceneError> {
        let wanted = match role {
            Role::Colour(wanted) => wanted,
            Role::Number => SpectrumUse::Unbounded,
        };
        let mut colour = match &property.value {
            Value::Number(x) => Rgb::splat(f32_of(*x)),
            #[expect(clippy::cast_precision_loss, reason = "far beyond any sensible value")]
            Value::Integer(x) => Rgb::splat(f32_of(*x as f64)),
            Value::Colour([r, g, b]) => Rgb {
                r: f32_of(*r),
                g: f32_of(*g),
                b: f32_of(*b),
            },
            Value::Vector(v) => Rgb {
                r: f32_of(v.x),
                g: f32_of(v.y),
                b: f32_of(v.z),
            },
            Value::Spectrum(samples) => spectrum::to_rgb(samples, wanted, element.legacy),
            Value::Element(_) | Value::Reference(_) => {
                let Some(texture) = self.plugin(property)?.filter(|e| e.class == "texture") else {
                    return Err(property.wrong("a texture"));
                };
                return self.deeper(element, |context| context.texture(&texture, role));
            }
            _ => return Err(property.wrong("a number, a colour, a spectrum or a texture")),
        };
        if role == Role::Number && !matches!(property.value, Value::Number(_) | Value::Integer(_)) {
            colour = Rgb::splat(colour.luminance());
        }
        let [r, g, b] = colour.to_array();
        if r.min(g).min(b) < 0.0 {
            return Err(property.error(format!(
                "\"{}\": expected values that are not negative",
                property.name
            )));
        }
        if role == Role::Colour(SpectrumUse::Reflectance) && r.max(g).max(b) > 1.0 {
            let message = format!("\"{}\": a share above 1 is taken for 1", property.name);
            self.warn(&property.place, message);
            colour = colour.map(|c| c.min(1.0));
        }
        Ok(ValueOrTexture::Value(colour))
    }

    /// A texture as a node, even where it is one value.
    pub(super) fn node(&mut self, built: ValueOrTexture) -> TextureId {
        match built {
            ValueOrTexture::Value(c) => self.add_texture(Texture::Constant(c)),
            ValueOrTexture::Texture(id) => id,
        }
    }

    /// Reads a texture plugin, once for each role and frame.
    pub(super) fn texture(
        &mut self,
        element: &Rc<Element>,
        role: Role,
    ) -> Result<ValueOrTexture, SceneError> {
        let key = (Rc::as_ptr(element) as usize, role, self.frame);
        if let Some(&built) = self.built_textures.get(&key) {
            return Ok(built);
        }
        let read = self.new_texture(element, role);
        let built = element.or(read, || ValueOrTexture::Value(Rgb::splat(0.5)))?;
        self.built_textures.insert(key, built);
        Ok(built)
    }

    fn new_texture(&mut self, element: &Element, role: Role) -> Result<ValueOrTexture, SceneError> {
        let inner = |context: &mut Self, name: &str, default: f32| match element.find(name) {
            Some(property) => context.value(element, property, role),
            None => Ok(ValueOrTexture::Value(Rgb::splat(default))),
        };
        match element.plugin.as_str() {
            "bitmap" => self.bitmap(element, role).map(ValueOrTexture::Texture),
            "checkerboard" => {
                let first = inner(self, "color0", 0.4)?;
                let second = inner(self, "color1", 0.2)?;
                self.checkerboard(element, role, [first, second])
                    .map(ValueOrTexture::Texture)
            }
            "mesh_attribute" | "vertexcolors" => {
                self.mesh_attribute(element).map(ValueOrTexture::Texture)
            }
            "uniform" | "rawconstant" => {
                element.ignore(&["wavelength_min", "wavelength_max"]);
                inner(self, "value", 1.0)
            }
            "srgb" => {
                element.ignore(&["unbounded"]);
                inner(self, "color", 1.0)
            }
            "d65" | "scale" => self.scaled(element, role),
            "blackbody" | "regular" | "irregular" => {
                let samples = samples(element)?;
                let wanted = match role {
                    Role::Colour(wanted) => wanted,
                    Role::Number => SpectrumUse::Unbounded,
                };
                let colour = spectrum::to_rgb(&samples, wanted, element.legacy);
                Ok(ValueOrTexture::Value(colour))
            }
            "gridtexture" => {
                element.ignore(&["color1", "line_width", "to_uv"]);
                self.warn(&element.place, "texture \"gridtexture\" has no lines here");
                inner(self, "color0", 0.2)
            }
            other @ ("volume" | "curvature" | "wireframe") => {
                let message = format!("texture \"{other}\" is not supported: 0.5 stands in");
                element.properties.iter().for_each(|p| p.used.set(true));
                self.warn(&element.place, message);
                Ok(ValueOrTexture::Value(Rgb::splat(0.5)))
            }
            other => Err(unknown("texture", other, &element.place)),
        }
    }

    /// Mitsuba's surface coordinates to `element`'s own, from the scene's.
    fn rows(&self, element: &Element) -> Result<Rows, SceneError> {
        let m = element.transform("to_uv")?;
        Ok(compose(&rows_of(&m), &self.frame.rows()))
    }

    fn bitmap(&mut self, element: &Element, role: Role) -> Result<TextureId, SceneError> {
        // Storage formats do not matter here.
        element.ignore(&["format", "accel", "cache", "max_anisotropy"]);
        let (path, place) = self.needed_file(element, "filename")?;
        let encoding = encoding(element)?;
        let image = self.image(&path, &place, encoding)?;
        let filter = match element.text("filter_type")? {
            Some("nearest") => Interpolation::Nearest,
            Some("bilinear" | "trilinear" | "ewa") | None => Interpolation::Bilinear,
            Some(other) => {
                return Err(bad_choice(
                    element,
                    "filter_type",
                    other,
                    "bilinear or nearest",
                ));
            }
        };
        let rows = self.rows(element)?;
        // Rows of the picture run with v, and against the scene's t.
        let flipped = compose(&[[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]], &rows);
        let wrap = self.wraps(element)?;
        Ok(self.add_texture(Texture::Image {
            image,
            mapping: mapping(&flipped),
            wrap,
            filter,
            invert: false,
            scale: 1.0,
            channel: if role == Role::Number {
                Channel::Luminance
            } else {
                Channel::Rgb
            },
        }))
    }

    fn wraps(&mut self, element: &Element) -> Result<[Wrap; 2], SceneError> {
        let both = self.wrap(element, "wrap_mode", Wrap::Repeat)?;
        Ok([
            self.wrap(element, "wrap_mode_u", both)?,
            self.wrap(element, "wrap_mode_v", both)?,
        ])
    }

    fn wrap(&mut self, element: &Element, name: &str, default: Wrap) -> Result<Wrap, SceneError> {
        Ok(match element.text(name)? {
            None => default,
            Some("repeat") => Wrap::Repeat,
            Some("mirror") => Wrap::Mirror,
            Some("clamp") => Wrap::Clamp,
            Some("zero") => Wrap::Black,
            Some("one") => {
                self.warn(&element.place_of(name), "\"one\" is read as \"clamp\"");
                Wrap::Clamp
            }
            Some(other) => return Err(bad_choice(element, name, other, "repeat, mirror or clamp")),
        })
    }

    /// Mitsuba's checks have two to the unit, and its numbers the other phase than its colours.
    fn checkerboard(
        &mut self,
        element: &Element,
        role: Role,
        [first, second]: [ValueOrTexture; 2],
    ) -> Result<TextureId, SceneError> {
        element.ignore(&["line_width"]);
        let double = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        let rows = compose(&double, &self.rows(element)?);
        let (first, second) = (self.node(first), self.node(second));
        let (even, odd) = if role == Role::Number {
            (second, first)
        } else {
            (first, second)
        };
        Ok(self.add_texture(Texture::Checkerboard {
            even,
            odd,
            mapping: mapping(&rows),
        }))
    }

    fn mesh_attribute(&mut self, element: &Element) -> Result<TextureId, SceneError> {
        let name = element.text("name")?.unwrap_or("vertex_color").to_owned();
        if name != "vertex_color" {
            let message = format!(
                "mesh attribute \"{}\" is not read: \"vertex_color\" stands in",
                shorten(&name)
            );
            self.warn(&element.place, message);
        }
        let scale = f32_of(element.not_negative("scale", 1.0)?);
        let colours = self.add_texture(Texture::VertexColour);
        Ok(self.times(colours, Rgb::splat(scale)))
    }

    /// `texture` times a factor.
    pub(super) fn times(&mut self, texture: TextureId, factor: Rgb<f32>) -> TextureId {
        if factor == Rgb::WHITE {
            return texture;
        }
        let factor = self.add_texture(Texture::Constant(factor));
        self.add_texture(Texture::Scale {
            a: texture,
            b: factor,
        })
    }

    /// `d65`, and the 0.6 dialect's `scale`: a factor on a colour or on a nested texture.
    fn scaled(&mut self, element: &Element, role: Role) -> Result<ValueOrTexture, SceneError> {
        let factor = match element.find("scale") {
            None => Rgb::WHITE,
            Some(property) => {
                match self.value(element, property, Role::Colour(SpectrumUse::Unbounded))? {
                    ValueOrTexture::Value(c) => c,
                    ValueOrTexture::Texture(_) => return Err(property.wrong("a float")),
                }
            }
        };
        let inner = match self.child(element, "texture")? {
            Some(nested) => self.deeper(element, |context| context.texture(&nested, role))?,
            None => match element.find("color").or_else(|| element.find("value")) {
                Some(property) => self.value(element, property, role)?,
                None => ValueOrTexture::Value(Rgb::WHITE),
            },
        };
        Ok(match inner {
            ValueOrTexture::Value(c) => ValueOrTexture::Value(c.zip(factor, |a, b| a * b)),
            ValueOrTexture::Texture(id) => ValueOrTexture::Texture(self.times(id, factor)),
        })
    }
}

/// A texture's transform with its third row and column left out.
fn rows_of(m: &DMat4) -> Rows {
    let row = |i: usize| {
        let r = m.row(i);
        [r.x, r.y, r.w]
    };
    [row(0), row(1)]
}

fn mapping(rows: &Rows) -> TextureMapping {
    TextureMapping::Uv(UvMapping(rows.map(|r| r.map(f32_of))))
}

/// `raw`, or the 0.6 dialect's `gamma`, in which -1 means the format's own.
fn encoding(element: &Element) -> Result<Encoding, SceneError> {
    let raw = element.boolean("raw", false)?;
    let gamma = element.number("gamma", -1.0)?;
    Ok(if raw || gamma == 1.0 {
        Encoding::Linear
    } else if gamma > 0.0 {
        Encoding::Gamma(f32_of(gamma))
    } else {
        Encoding::Srgb
    })
}

fn samples(element: &Element) -> Result<Samples, SceneError> {
    if element.plugin == "blackbody" {
        element.ignore(&["wavelength_min", "wavelength_max"]);
        let kelvin = element.above_zero("temperature", 6500.0)?;
        return Ok(Samples::BlackBody(
            kelvin,
            element.not_negative("scale", 1.0)?,
        ));
    }
    if let Some(Property {
        value: Value::Spectrum(samples),
        ..
    }) = element.find("value")
    {
        return Ok(samples.clone());
    }
    let list = |name: &str| -> Result<Vec<f64>, SceneError> {
        let text = element
            .text(name)?
            .ok_or_else(|| element.error(format!("{} needs its \"{name}\"", element.title())))?;
        number::numbers(text)
            .map_err(|m| SceneError::new(ErrorKind::Spectrum, &element.place_of(name), m))
    };
    let values = list("values")?;
    let wavelengths = if element.plugin == "irregular" {
        list("wavelengths")?
    } else {
        let least = element.above_zero("wavelength_min", 360.0)?;
        let most = element.above_zero("wavelength_max", 830.0)?;
        let last = values.len().saturating_sub(1).max(1) as f64;
        (0..values.len())
            .map(|i| least + (most - least) * i as f64 / last)
            .collect()
    };
    if wavelengths.len() != values.len() {
        let message = format!(
            "{} has {} wavelengths and {} values",
            element.title(),
            wavelengths.len(),
            values.len()
        );
        return Err(SceneError::new(
            ErrorKind::Spectrum,
            &element.place,
            message,
        ));
    }
    spectrum::ordered(wavelengths.into_iter().zip(values).collect())
        .map_err(|m| SceneError::new(ErrorKind::Spectrum, &element.place, m))
}

/// The error for a word that is none of those expected.
pub(super) fn bad_choice(element: &Element, name: &str, found: &str, expected: &str) -> SceneError {
    let message = format!(
        "\"{name}\": expected {expected}, found \"{}\"",
        shorten(found)
    );
    SceneError::new(ErrorKind::Parameter, &element.place_of(name), message)
}

/// The error for a plugin that Mitsuba does not have, or that nothing can stand in for.
pub(super) fn unknown(class: &'static str, name: &str, place: &crate::Place) -> SceneError {
    let message = format!("unknown {class} \"{}\"", shorten(name));
    let known: Vec<&str> = super::FEATURES
        .iter()
        .filter(|f| f.class == class && !matches!(f.support, crate::feature::Support::Refused(_)))
        .map(|f| f.name)
        .collect();
    SceneError::new(ErrorKind::Unsupported, place, message)
        .with_help(format!("expected {}", known.join(", ")))
}
