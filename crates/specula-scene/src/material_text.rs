//! Materials as a line of text: `conductor Au alpha 0.3`.

use specula_bsdf::Rgb;
use specula_bsdf::metals;

use crate::num::f32_of;
use crate::scene::{
    CoatMedium, ColourParam, ConductorFresnel, FloatParam, Material, MaterialKind,
    MicrofacetDistribution, Roughness, RoughnessMapping, Scene,
};

/// A line that does not describe a material.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("material '{text}': {problem}; expected {EXPECTED}")]
pub struct UnknownMaterial {
    text: String,
    problem: String,
}

/// The words of a metal's index.
const INDEX: [&str; 2] = ["conductor_eta", "conductor_k"];

const EXPECTED: &str = "diffuse R G B, conductor METAL|R G B, dielectric ETA, coateddiffuse R G B, \
    or coatedconductor METAL|R G B, then any of: alpha A, alpha AX AY, roughness R, eta ETA, \
    conductor_eta R G B, conductor_k R G B, distribution ggx|beckmann";

/// Reads a material.
///
/// ```text
/// diffuse         R G B
/// conductor       [METAL | R G B]      METAL: Au, Ag, Cu, ... or a reflectance; or by conductor_eta
/// dielectric      [ETA]                1.5
/// coateddiffuse   R G B
/// coatedconductor [METAL | R G B]
///
/// alpha A | alpha AX AY                alpha of the microfacets; 0 is smooth
/// roughness R                          alpha = R^2
/// eta ETA                              index of the coat or the glass
/// conductor_eta R G B, conductor_k R G B
///                                      index of a metal, in place of METAL
/// distribution ggx | beckmann          of the microfacets
/// ```
///
/// Commas may stand in place of spaces.
///
/// # Errors
///
/// Which word is not understood, and what was expected.
pub fn parse_material(text: &str) -> Result<MaterialKind, UnknownMaterial> {
    let wrong = |problem: String| UnknownMaterial {
        text: text.to_owned(),
        problem,
    };
    let is_between = |c: char| c.is_whitespace() || c == ',';
    let words: Vec<&str> = text.split(is_between).filter(|w| !w.is_empty()).collect();
    let mut words = Words { words: &words };
    let class = words
        .next()
        .ok_or_else(|| wrong("nothing is said".to_owned()))?;
    let metal = matches!(class, "conductor" | "coatedconductor");
    let mut options = Options::new(metal);
    let mut fresnel = ConductorFresnel::Mirror;
    let mut colour = ColourParam::Value(Rgb::splat(0.5));
    match class {
        "conductor" | "coatedconductor" => {
            if !words.is_next(&INDEX) {
                fresnel = words.metal().map_err(wrong)?;
            }
        }
        "diffuse" | "coateddiffuse" => {
            if let Some(c) = words.colour().map_err(wrong)? {
                colour = ColourParam::Value(c);
            }
        }
        "dielectric" => {
            if let Some(x) = words.number() {
                options.eta = x;
            }
        }
        other => return Err(wrong(format!("there is no '{other}'"))),
    }
    while let Some(word) = words.next() {
        options.take(word, &mut words).map_err(wrong)?;
    }
    options.check().map_err(wrong)?;
    if metal {
        fresnel = options.fresnel(fresnel).map_err(wrong)?;
    }
    Ok(kind(
        class,
        colour,
        fresnel,
        options.eta,
        options.roughness(),
    ))
}

/// What may follow a material's class and colour.
struct Options {
    metal: bool,
    eta: f32,
    alpha: [f32; 2],
    mapping: RoughnessMapping,
    distribution: MicrofacetDistribution,
    /// Real and imaginary part.
    index: [Option<ColourParam>; 2],
}

impl Options {
    fn new(metal: bool) -> Self {
        Self {
            metal,
            eta: 1.5,
            alpha: [if metal { 0.1 } else { 0.0 }; 2],
            mapping: RoughnessMapping::Alpha,
            distribution: MicrofacetDistribution::Ggx,
            index: [None; 2],
        }
    }

    /// Reads the values of an option.
    fn take(&mut self, word: &str, words: &mut Words<'_>) -> Result<(), String> {
        let mut value = || {
            words
                .number()
                .ok_or_else(|| format!("'{word}' needs a number"))
        };
        match word {
            "alpha" => {
                let x = value()?;
                self.alpha = [x, words.number().unwrap_or(x)];
                self.mapping = RoughnessMapping::Alpha;
            }
            "roughness" => {
                self.alpha = [value()?; 2];
                self.mapping = RoughnessMapping::Square;
            }
            "eta" => self.eta = value()?,
            "conductor_eta" | "conductor_k" if self.metal => {
                let colour = words.index(word)?;
                self.index[usize::from(word == INDEX[1])] = Some(ColourParam::Value(colour));
            }
            "distribution" => {
                self.distribution = match words.next() {
                    Some("ggx") => MicrofacetDistribution::Ggx,
                    Some("beckmann") => MicrofacetDistribution::Beckmann,
                    _ => return Err("'distribution' needs ggx or beckmann".to_owned()),
                };
            }
            other => return Err(format!("'{other}' is not understood")),
        }
        Ok(())
    }

    fn check(&self) -> Result<(), String> {
        if self.eta <= 0.0 {
            return Err(format!("an index of {}", self.eta));
        }
        if self.alpha.iter().any(|a| *a < 0.0) {
            return Err("a negative width".to_owned());
        }
        Ok(())
    }

    /// A metal's reflectance: `given`, or by its index.
    fn fresnel(&self, given: ConductorFresnel) -> Result<ConductorFresnel, String> {
        let is_given = given != ConductorFresnel::Mirror;
        match self.index {
            [None, None] if is_given => Ok(given),
            [None, None] => Err("which metal is not said".to_owned()),
            [Some(_), Some(_)] if is_given => Err("a metal and an index".to_owned()),
            [Some(eta), Some(k)] => Ok(ConductorFresnel::Index { eta, k }),
            _ => Err("conductor_eta and conductor_k go together".to_owned()),
        }
    }

    fn roughness(&self) -> Roughness {
        let [u, v] = self.alpha.map(FloatParam::Value);
        Roughness {
            v,
            distribution: self.distribution,
            ..Roughness::isotropic(u, self.mapping)
        }
    }
}

fn kind(
    class: &str,
    reflectance: ColourParam,
    fresnel: ConductorFresnel,
    eta: f32,
    roughness: Roughness,
) -> MaterialKind {
    match class {
        "diffuse" => MaterialKind::Diffuse {
            reflectance,
            roughness: FloatParam::Value(0.0),
        },
        "conductor" => MaterialKind::Conductor {
            fresnel,
            roughness,
            tint: ColourParam::WHITE,
        },
        "dielectric" => MaterialKind::Dielectric {
            eta,
            roughness,
            reflection_tint: ColourParam::WHITE,
            transmission_tint: ColourParam::WHITE,
        },
        "coateddiffuse" => MaterialKind::CoatedDiffuse {
            reflectance,
            eta,
            roughness,
            medium: CoatMedium::default(),
            lossless: false,
        },
        _ => MaterialKind::CoatedConductor {
            coat_eta: eta,
            coat_roughness: Roughness::smooth(),
            fresnel,
            roughness,
            medium: CoatMedium::default(),
        },
    }
}

impl Scene {
    /// Gives every shape this material, except for interfaces, shapes that emit light, and a
    /// floor that is not the file's ([`Scene::floor`]).
    pub fn replace_materials(&mut self, kind: MaterialKind) {
        let floor = self.floor.map(|id| id.0);
        self.replace_where(|i, _| Some(i) != floor, kind);
    }

    /// Gives this material to every shape whose material's name in the file `matches`, except for those that
    /// are interfaces or emit light. Returns how many materials have such a name.
    pub fn replace_materials_named(
        &mut self,
        matches: impl Fn(&str) -> bool,
        kind: MaterialKind,
    ) -> usize {
        let named = |m: &Material| m.name.as_deref().is_some_and(&matches);
        let count = self.materials.iter().filter(|m| named(m)).count();
        self.replace_where(|_, m| named(m), kind);
        count
    }

    fn replace_where(&mut self, chosen: impl Fn(usize, &Material) -> bool, kind: MaterialKind) {
        let shining: Vec<usize> = (self.shapes.iter())
            .chain(self.objects.iter().flat_map(|o| &o.shapes))
            .filter(|s| s.emission.is_some())
            .map(|s| s.material.0)
            .collect();
        for (i, material) in self.materials.iter_mut().enumerate() {
            let is_surface = material.kind != MaterialKind::Interface && !shining.contains(&i);
            if is_surface && chosen(i, material) {
                material.kind = kind;
                material.bump = None;
                material.one_sided = false;
            }
        }
    }
}

struct Words<'a> {
    words: &'a [&'a str],
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a str> {
        let (first, rest) = self.words.split_first()?;
        self.words = rest;
        Some(first)
    }

    fn is_next(&self, any: &[&str]) -> bool {
        self.words.first().is_some_and(|w| any.contains(w))
    }

    /// Three numbers of at least 0, or one for all three.
    fn index(&mut self, name: &str) -> Result<Rgb<f32>, String> {
        let values = [self.number(), self.number(), self.number()];
        let colour = match values {
            [Some(r), None, None] => Rgb::splat(r),
            [Some(r), Some(g), Some(b)] => Rgb { r, g, b },
            _ => return Err(format!("'{name}' needs one number or three")),
        };
        if colour.to_array().iter().any(|x| *x < 0.0) {
            return Err(format!("'{name}' below 0"));
        }
        Ok(colour)
    }

    /// The next word, where it is a finite number.
    fn number(&mut self) -> Option<f32> {
        let value = self.words.first()?.parse::<f64>().ok().map(f32_of)?;
        if !value.is_finite() {
            return None;
        }
        self.next();
        Some(value)
    }

    /// Three numbers in `[0, 1]`, or one for all three; `None` where there is none.
    fn colour(&mut self) -> Result<Option<Rgb<f32>>, String> {
        let Some(r) = self.number() else {
            return Ok(None);
        };
        let colour = match (self.number(), self.number()) {
            (None, None) => Rgb::splat(r),
            (Some(g), Some(b)) => Rgb { r, g, b },
            _ => return Err("a colour has one number or three".to_owned()),
        };
        if colour.to_array().iter().any(|x| !(0.0..=1.0).contains(x)) {
            return Err("a colour outside of [0, 1]".to_owned());
        }
        Ok(Some(colour))
    }

    fn metal(&mut self) -> Result<ConductorFresnel, String> {
        if let Some(colour) = self.colour()? {
            return Ok(ConductorFresnel::Reflectance(ColourParam::Value(colour)));
        }
        let symbol = self.next().ok_or("which metal is not said")?;
        let metal = metals::by_symbol(symbol).ok_or_else(|| {
            let all: Vec<&str> = metals::METALS.iter().map(|m| m.symbol).collect();
            format!("no metal '{symbol}' (there are {})", all.join(", "))
        })?;
        let index = |channel: [f64; 3]| ColourParam::Value(Rgb::from(channel).cast());
        Ok(ConductorFresnel::Index {
            eta: index(metal.eta),
            k: index(metal.k),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_become_materials() {
        let MaterialKind::Conductor {
            fresnel, roughness, ..
        } = parse_material("conductor Au alpha 0.3").unwrap()
        else {
            panic!("no conductor")
        };
        assert!(matches!(fresnel, ConductorFresnel::Index { .. }));
        assert_eq!(
            [roughness.u, roughness.v],
            [FloatParam::Value(0.3), FloatParam::Value(0.3)]
        );
        let MaterialKind::CoatedDiffuse {
            reflectance,
            eta,
            roughness,
            ..
        } = parse_material("coateddiffuse 0.5 0.25 0 eta 1.6 alpha 0.1 0.2").unwrap()
        else {
            panic!("no coat")
        };
        assert_eq!(reflectance, ColourParam::Value(Rgb::from([0.5, 0.25, 0.0])));
        assert_eq!((eta, roughness.v), (1.6, FloatParam::Value(0.2)));
        assert!(matches!(
            parse_material("dielectric 1.33 roughness 0.5").unwrap(),
            MaterialKind::Dielectric { eta: 1.33, roughness, .. }
                if roughness.mapping == RoughnessMapping::Square
        ));
        assert!(parse_material("conductor 0.9").is_ok());
        // As lobes are printed.
        let MaterialKind::Conductor {
            fresnel, roughness, ..
        } = parse_material(
            "conductor conductor_eta 0.2,0.9,1.1 conductor_k 3.9,2.4,2.2 alpha 0.1,0.4 distribution beckmann",
        )
        .unwrap()
        else {
            panic!("no conductor")
        };
        let colour = |c: [f32; 3]| ColourParam::Value(Rgb::from(c));
        let (eta, k) = (colour([0.2, 0.9, 1.1]), colour([3.9, 2.4, 2.2]));
        assert_eq!(fresnel, ConductorFresnel::Index { eta, k });
        assert_eq!(roughness.distribution, MicrofacetDistribution::Beckmann);
        assert_eq!(roughness.v, FloatParam::Value(0.4));
    }

    #[test]
    fn what_is_not_understood_is_named() {
        for (text, expected) in [
            ("", "nothing is said"),
            ("gold", "no 'gold'"),
            ("conductor", "which metal"),
            ("conductor Xx", "no metal 'Xx' (there are"),
            ("diffuse 0.5 0.5", "one number or three"),
            ("diffuse 2", "outside of"),
            ("conductor Au alpha", "'alpha' needs a number"),
            ("conductor Au shiny", "'shiny' is not understood"),
            ("dielectric -1", "index of -1"),
            ("conductor Au alpha -0.1", "negative"),
            ("conductor alpha 0.1", "no metal 'alpha'"),
            ("conductor conductor_eta 1", "go together"),
            (
                "conductor Au conductor_eta 1 conductor_k 2",
                "a metal and an index",
            ),
            ("conductor conductor_eta 1 2", "one number or three"),
            (
                "conductor conductor_k -1 conductor_eta 1",
                "'conductor_k' below 0",
            ),
            (
                "diffuse 0.5 conductor_k 1",
                "'conductor_k' is not understood",
            ),
            ("conductor Au distribution phong", "needs ggx or beckmann"),
        ] {
            let error = parse_material(text).unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
