//! Plugins around other plugins: `twosided`, `mask`, `bumpmap`, `normalmap`, `blendbsdf`, and the
//! 0.6 dialect's `coating` and `mixturebsdf`.

use std::rc::Rc;

use specula_bsdf::Rgb;

use super::bsdf::{Surface, smooth};
use super::context::Context;
use super::element::Element;
use super::number::numbers;
use super::spectrum::SpectrumUse;
use super::texture::Role;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::scene::{
    Bump, BumpRules, CoatMedium, FloatParam, Material, MaterialId, MaterialKind, Texture,
};

/// Properties that the plugins around a material give it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wrappers {
    pub(super) two_sided: bool,
    pub(super) bump: Option<Bump>,
    pub(super) bump_rules: BumpRules,
    pub(super) alpha: FloatParam,
}

/// Whether light may pass a material, so that Mitsuba's `twosided` refuses it.
fn lets_light_through(kind: &MaterialKind) -> bool {
    match kind {
        MaterialKind::Dielectric { .. }
        | MaterialKind::ThinDielectric { .. }
        | MaterialKind::DiffuseTransmission { .. }
        | MaterialKind::Interface
        | MaterialKind::Hair(_) => true,
        MaterialKind::Principled(p) => p.thin || p.spec_trans != FloatParam::Value(0.0),
        _ => false,
    }
}

impl Default for Wrappers {
    fn default() -> Self {
        Self {
            two_sided: false,
            bump: None,
            bump_rules: BumpRules::Plain,
            alpha: FloatParam::Value(1.0),
        }
    }
}

impl Context<'_> {
    /// The surface of a plugin that contains others; `None` for other plugins.
    pub(super) fn layered(
        &mut self,
        element: &Rc<Element>,
        wraps: Wrappers,
    ) -> Result<Option<Surface>, SceneError> {
        match element.plugin.as_str() {
            "twosided" => {
                element.ignore(&["allow_transmission"]);
                let sides = self.some_nested(element)?;
                let two_sided = Wrappers {
                    two_sided: true,
                    ..wraps
                };
                match sides.as_slice() {
                    [both] => self.wrapped(both, two_sided).map(Some),
                    [front, back] => self.sided(element, [front, back], two_sided).map(Some),
                    [_, _, third, ..] => {
                        let message = format!("{} has more than two bsdfs", element.title());
                        Err(SceneError::new(ErrorKind::Structure, &third.place, message))
                    }
                    // `some_nested` has at least one.
                    [] => Ok(None),
                }
            }
            "mask" => {
                let opacity = self.float(element, "opacity", 0.5)?;
                let alpha = self.product(wraps.alpha, opacity);
                let inner = self.one_nested(element)?;
                self.wrapped(&inner, Wrappers { alpha, ..wraps }).map(Some)
            }
            "bumpmap" | "normalmap" => self.bump(element, wraps).map(Some),
            "blendbsdf" => self.blend(element, wraps).map(Some),
            "mixturebsdf" => self.mixture(element, wraps).map(Some),
            "coating" | "roughcoating" => self.coating(element, wraps).map(Some),
            _ => Ok(None),
        }
    }

    fn some_nested(&mut self, element: &Element) -> Result<Vec<Rc<Element>>, SceneError> {
        let found = self.children(element, "bsdf")?;
        if found.is_empty() {
            let message = format!("{} needs a bsdf within it", element.title());
            return Err(SceneError::new(
                ErrorKind::Structure,
                &element.place,
                message,
            ));
        }
        Ok(found)
    }

    fn one_nested(&mut self, element: &Element) -> Result<Rc<Element>, SceneError> {
        let mut found = self.some_nested(element)?;
        if let [_, second, ..] = found.as_slice() {
            let message = format!("{} has more than one bsdf within it", element.title());
            return Err(SceneError::new(
                ErrorKind::Structure,
                &second.place,
                message,
            ));
        }
        Ok(found.swap_remove(0))
    }

    fn bump(&mut self, element: &Rc<Element>, wraps: Wrappers) -> Result<Surface, SceneError> {
        if wraps.bump.is_some() {
            let message = format!("{} within another bump is left out", element.title());
            self.warn(&element.place, message);
            let inner = self.one_nested(element)?;
            return self.wrapped(&inner, wraps);
        }
        let role = if element.plugin == "bumpmap" {
            Role::Number
        } else {
            Role::Colour(SpectrumUse::Unbounded)
        };
        let texture = match element.find("normalmap") {
            Some(property) => self.value(element, property, role)?,
            None => {
                let textures = self.children(element, "texture")?;
                let [texture] = textures.as_slice() else {
                    let message = format!("{} needs one texture within it", element.title());
                    return Err(SceneError::new(
                        ErrorKind::Structure,
                        &element.place,
                        message,
                    ));
                };
                self.deeper(element, |context| context.texture(texture, role))?
            }
        };
        let node = self.node(texture);
        let bump = if element.plugin == "bumpmap" {
            let scale = f32_of(element.number("scale", 1.0)?);
            Bump::Height(FloatParam::Texture(self.times(node, Rgb::splat(scale))))
        } else {
            Bump::Normal {
                map: node,
                scale: 1.0,
            }
        };
        element.ignore(&["flip_invalid_normals"]);
        let fades = element.boolean("use_shadowing_function", !element.legacy)?;
        let bump_rules = BumpRules::Mitsuba { fades };
        let inner = self.one_nested(element)?;
        let within = Wrappers {
            bump: Some(bump),
            bump_rules,
            ..wraps
        };
        self.wrapped(&inner, within)
    }

    /// `weight` is the share of the second. A part without a surface makes a mask of the other.
    fn blend(&mut self, element: &Rc<Element>, wraps: Wrappers) -> Result<Surface, SceneError> {
        let parts = self.some_nested(element)?;
        let [first, second] = parts.as_slice() else {
            let message = format!(
                "{} needs two bsdfs within it, found {}",
                element.title(),
                parts.len()
            );
            return Err(SceneError::new(
                ErrorKind::Structure,
                &element.place,
                message,
            ));
        };
        let amount = self.float(element, "weight", 0.5)?;
        let amount = match amount {
            FloatParam::Value(w) => FloatParam::Value(w.min(1.0)),
            texture => texture,
        };
        match (first.plugin.as_str(), second.plugin.as_str()) {
            ("null", _) => {
                let alpha = self.product(wraps.alpha, amount);
                self.wrapped(second, Wrappers { alpha, ..wraps })
            }
            (_, "null") => {
                let rest = self.complement(amount);
                let alpha = self.product(wraps.alpha, rest);
                self.wrapped(first, Wrappers { alpha, ..wraps })
            }
            _ => self.mix(element, first, second, amount, wraps),
        }
    }

    fn mix(
        &mut self,
        element: &Element,
        first: &Rc<Element>,
        second: &Rc<Element>,
        amount: FloatParam,
        wraps: Wrappers,
    ) -> Result<Surface, SceneError> {
        // A bump map belongs to the parts.
        let bare = Wrappers {
            alpha: FloatParam::Value(1.0),
            ..wraps
        };
        let a = self.wrapped(first, bare)?;
        let b = self.wrapped(second, bare)?;
        self.mixed(element, a, b, amount, wraps)
    }

    /// A surface of one bsdf in front and another behind.
    fn sided(
        &mut self,
        element: &Element,
        sides: [&Rc<Element>; 2],
        wraps: Wrappers,
    ) -> Result<Surface, SceneError> {
        let bare = Wrappers {
            alpha: FloatParam::Value(1.0),
            ..wraps
        };
        let [front, back] = sides;
        let parts = [self.wrapped(front, bare)?, self.wrapped(back, bare)?];
        for (side, part) in sides.iter().zip(&parts) {
            if lets_light_through(&self.materials[part.material.0].kind) {
                let message = format!(
                    "{} of two bsdfs cannot hold one that lets light through",
                    element.title()
                );
                return Err(SceneError::new(
                    ErrorKind::Unsupported,
                    &side.place,
                    message,
                ));
            }
        }
        self.joined(element, parts, wraps, MaterialKind::Sided)
    }

    fn mixed(
        &mut self,
        element: &Element,
        a: Surface,
        b: Surface,
        amount: FloatParam,
        wraps: Wrappers,
    ) -> Result<Surface, SceneError> {
        let mix = |materials| MaterialKind::Mix { materials, amount };
        self.joined(element, [a, b], wraps, mix)
    }

    /// A material of two.
    fn joined(
        &mut self,
        element: &Element,
        [a, b]: [Surface; 2],
        wraps: Wrappers,
        kind: impl FnOnce([MaterialId; 2]) -> MaterialKind,
    ) -> Result<Surface, SceneError> {
        let is_whole = |s: &Surface| s.alpha == FloatParam::Value(1.0);
        if !(is_whole(&a) && is_whole(&b)) {
            let message = format!("a mask within {} is left out", element.title());
            self.warn(&element.place, message);
        }
        let ids = [a.material, b.material];
        let part = |i: usize| &self.materials[ids[i].0];
        if [0, 1]
            .iter()
            .any(|i| part(*i).kind == MaterialKind::Interface)
        {
            let message = format!("{} cannot hold a bsdf without surface", element.title());
            return Err(SceneError::new(
                ErrorKind::Unsupported,
                &element.place,
                message,
            ));
        }
        let material = Material {
            name: element.id.clone(),
            one_sided: part(0).one_sided && part(1).one_sided,
            ..Material::new(kind(ids))
        };
        Ok(Surface {
            material: self.add_material(material),
            alpha: wraps.alpha,
        })
    }

    /// Weighted bsdfs as a chain of mixes.
    fn mixture(&mut self, element: &Rc<Element>, wraps: Wrappers) -> Result<Surface, SceneError> {
        let parts = self.some_nested(element)?;
        let place = element.place_of("weights");
        let weights = numbers(element.text("weights")?.unwrap_or(""))
            .map_err(|m| SceneError::new(ErrorKind::Parameter, &place, m))?;
        let total: f64 = weights.iter().sum();
        if weights.len() != parts.len() || weights.iter().any(|w| *w < 0.0) || total <= 0.0 {
            let message = format!(
                "\"weights\": expected {} numbers that are not negative, found {}",
                parts.len(),
                weights.len()
            );
            return Err(SceneError::new(ErrorKind::Parameter, &place, message));
        }
        if (total - 1.0).abs() > 1e-3 {
            self.warn(&place, "the weights are scaled to a sum of 1");
        }
        let bare = Wrappers {
            alpha: FloatParam::Value(1.0),
            ..wraps
        };
        let mut whole = self.wrapped(&parts[0], bare)?;
        let mut sum = weights[0];
        for (part, weight) in parts.iter().zip(&weights).skip(1) {
            let next = self.wrapped(part, bare)?;
            sum += weight;
            let share = if sum > 0.0 { weight / sum } else { 0.0 };
            whole = self.mixed(
                element,
                whole,
                next,
                FloatParam::Value(f32_of(share)),
                wraps,
            )?;
        }
        Ok(Surface {
            alpha: wraps.alpha,
            ..whole
        })
    }

    /// A coat over Lambert or over metal; over anything else it is left out.
    fn coating(&mut self, element: &Rc<Element>, wraps: Wrappers) -> Result<Surface, SceneError> {
        element.ignore(&["thickness", "sigma_a", "specular_reflectance"]);
        let eta = self.relative_index(element, "bk7")?;
        let coat = if element.plugin == "coating" {
            smooth()
        } else {
            self.roughness(element)?
        };
        let inner = self.one_nested(element)?;
        let inside = self.wrapped(&inner, wraps)?;
        let kind = match self.materials[inside.material.0].kind {
            MaterialKind::Diffuse { reflectance, .. } => MaterialKind::CoatedDiffuse {
                reflectance,
                eta,
                roughness: coat,
                medium: CoatMedium::default(),
                lossless: true,
            },
            MaterialKind::Conductor {
                fresnel, roughness, ..
            } => MaterialKind::CoatedConductor {
                coat_eta: eta,
                coat_roughness: coat,
                fresnel,
                roughness,
                medium: CoatMedium::default(),
            },
            _ => {
                let message = format!("{} over {} is left out", element.title(), inner.title());
                self.warn(&element.place, message);
                return Ok(inside);
            }
        };
        let message = "a coat is rendered as pbrt-v4's coated materials are, without absorption";
        self.warn(&element.place, message);
        let two_sided = !self.materials[inside.material.0].one_sided;
        let wraps = Wrappers {
            two_sided,
            alpha: inside.alpha,
            ..wraps
        };
        Ok(self.finish(element, kind, wraps))
    }

    fn product(&mut self, a: FloatParam, b: FloatParam) -> FloatParam {
        match (a, b) {
            (FloatParam::Value(x), other) | (other, FloatParam::Value(x)) if x == 1.0 => other,
            (FloatParam::Value(x), other) | (other, FloatParam::Value(x)) => {
                self.scaled_float(other, x)
            }
            (FloatParam::Texture(a), FloatParam::Texture(b)) => {
                FloatParam::Texture(self.add_texture(Texture::Scale { a, b }))
            }
        }
    }

    /// 1 less a number.
    fn complement(&mut self, param: FloatParam) -> FloatParam {
        match param {
            FloatParam::Value(x) => FloatParam::Value((1.0 - x).max(0.0)),
            texture @ FloatParam::Texture(_) => {
                let a = self.add_texture(Texture::Constant(Rgb::WHITE));
                let b = self.add_texture(Texture::Constant(Rgb::BLACK));
                FloatParam::Texture(self.add_texture(Texture::Mix {
                    a,
                    b,
                    amount: texture,
                }))
            }
        }
    }
}
