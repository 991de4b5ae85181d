//! `lobes.code`: a lobe in each language of the library, and in the scenes of others.

mod python;
mod rust;
mod scenes;
mod shaders;

use serde_json::json;
use specula_lobes::{NamedLobe, metal};

use crate::fields::{Fields, wrong};
use crate::{Answer, AskError};

type Text = Result<String, AskError>;

/// The text of a lobe in a language.
pub(super) fn code(mut fields: Fields) -> Result<Answer, AskError> {
    let named = super::lobe(&mut fields)?;
    let language = fields.text("language")?;
    fields.end()?;
    let said = Said(&named);
    let text = match language.as_str() {
        "specula" => format!("{named}\n"),
        "rust" => rust::text(said)?,
        "wgsl" => shaders::text(said, &shaders::WGSL)?,
        "hlsl" => shaders::text(said, &shaders::HLSL)?,
        "glsl" => shaders::text(said, &shaders::GLSL)?,
        "metal" => shaders::text(said, &shaders::METAL)?,
        "cpp" => shaders::text(said, &shaders::CPP)?,
        "c" => c(&named),
        "python" => python::text(said),
        "pbrt" => scenes::pbrt(said)?,
        "mitsuba" => scenes::mitsuba(said)?,
        other => {
            let expected =
                "specula, rust, wgsl, hlsl, glsl, metal, cpp, c, python, pbrt or mitsuba";
            return Err(wrong("language", expected, &format!("'{other}'")));
        }
    };
    Ok(Answer::new(json!({ "text": text })))
}

/// By the text, as `specula-c/include/specula.h` takes it.
fn c(named: &NamedLobe) -> String {
    format!(
        "#include <specula.h>\n\n\
         specula_lobe *lobe;\n\
         if (specula_lobe_parse(\"{named}\", &lobe) != SPECULA_STATUS_OK)\n    \
             puts(specula_last_error());\n\
         /* specula_lobe_eval_pdf_f, specula_lobe_sample_f: see specula.h */\n\
         specula_lobe_free(lobe);\n"
    )
}

/// What is said of a lobe, with defaults for what is not.
#[derive(Clone, Copy)]
struct Said<'a>(&'a NamedLobe);

impl<'a> Said<'a> {
    fn kind(self) -> &'static str {
        self.0.kind().name
    }

    /// What was given.
    fn given(self, key: &str) -> Option<&'a str> {
        self.0
            .given()
            .find(|(k, _)| *k == key)
            .map(|(_, value)| value)
    }

    fn word(self, key: &str) -> Option<&'a str> {
        let default = || self.0.kind().parameter(key)?.default;
        self.given(key).or_else(default)
    }

    fn is(self, key: &str, word: &str) -> bool {
        self.word(key) == Some(word)
    }

    fn number(self, key: &str) -> f64 {
        self.word(key)
            .and_then(|x| x.parse().ok())
            .unwrap_or_default()
    }

    fn numbers(self, key: &str) -> Option<Vec<f64>> {
        self.word(key)?.split(',').map(|x| x.parse().ok()).collect()
    }

    /// Alphas along x and y.
    fn alpha(self, key: &str) -> Option<[f64; 2]> {
        match *self.numbers(key)? {
            [both] => Some([both; 2]),
            [x, y] => Some([x, y]),
            _ => None,
        }
    }

    fn colour(self, key: &str) -> Option<[f64; 3]> {
        match *self.numbers(key)? {
            [grey] => Some([grey; 3]),
            [r, g, b] => Some([r, g, b]),
            _ => None,
        }
    }

    /// A colour that is there, or white.
    fn tint(self, key: &str) -> [f64; 3] {
        self.colour(key).unwrap_or([1.0; 3])
    }

    fn is_white(self, key: &str) -> bool {
        self.tint(key) == [1.0; 3]
    }

    /// The reflectance of a metal; `None`: it has none.
    fn reflectance(self) -> Option<Metal<'a>> {
        if let Some(f0) = self.colour("f0") {
            return Some(match self.colour("f82_tint") {
                Some(tint) => Metal::F82(f0, tint),
                None => Metal::Schlick(f0),
            });
        }
        if let (Some(eta), Some(k)) = (self.colour("conductor_eta"), self.colour("conductor_k")) {
            return Some(Metal::Index(eta, k));
        }
        let word = self.word("reflectance")?;
        if let Some(colour) = self.colour("reflectance") {
            return Some(Metal::Constant(colour));
        }
        metal(word).ok().map(|m| Metal::Measured(word, m.eta, m.k))
    }
}

/// A reflectance of metal.
#[derive(Clone, Copy)]
enum Metal<'a> {
    Constant([f64; 3]),
    Measured(&'a str, [f64; 3], [f64; 3]),
    Index([f64; 3], [f64; 3]),
    Schlick([f64; 3]),
    F82([f64; 3], [f64; 3]),
}

/// A number with a point.
fn real(x: f64) -> String {
    let text = format!("{x}");
    if text.contains('.') {
        text
    } else {
        format!("{text}.0")
    }
}

/// Numbers with a point, between commas.
fn reals(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| real(*x)).collect();
    texts.join(", ")
}

/// That a language has no such lobe.
fn none(language: &str, why: &str) -> AskError {
    AskError::new(format!("language: {language} cannot say this lobe: {why}"))
}
