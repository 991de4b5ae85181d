//! The page of figures, and whether the one that is written is current.

use std::fmt::Write as _;

use specula_shaders::Language;

use crate::harness::Outcome;

/// The page.
pub(super) const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/shaders/parity.md");

/// By how much a figure may differ from what is written, measured with the same compilers: processors differ.
const TOLERANCE: f64 = 0.1;

const HEAD: &str = "\
# Parity by language

Written by `SPECULA_WRITE=1 cargo test -p specula-gpu --test parity languages::`, which else compares it with what it
measures. Every function runs in every language over the grid of the Rust proofs. A figure is the largest error of a
family's cases, in units of the case's bound: so many units of the last place of `f32`, beside the `f64` twin in Rust.
Above 1 the test fails.

Metal and C++ run on the processor. What the other compilers write is SPIR-V: that of the families of a *device* is
handed to a Vulkan driver, that of a *processor* is computed instruction by instruction in the arithmetic of IEEE.
";

const MIDDLE: &str = "
How each language is compiled and run:

| language | compiler | on |
|---|---|---|
";

/// The largest error of a family's cases in a language.
pub(super) struct Figure {
    pub(super) language: Language,
    pub(super) family: &'static str,
    pub(super) cases: usize,
    /// In units of the bound of its case.
    pub(super) error: f64,
}

impl Figure {
    pub(super) fn of(language: Language, family: &'static str, outcomes: &[Outcome]) -> Self {
        let errors = outcomes.iter().map(|o| o.shader / o.bound);
        Self {
            language,
            family,
            cases: outcomes.len(),
            error: errors.fold(0.0, f64::max),
        }
    }
}

/// A language with what compiles it and what it runs on.
pub(super) struct Setting {
    pub(super) language: Language,
    pub(super) compiler: String,
    pub(super) runs_on: String,
}

/// A family and whether its SPIR-V runs on a device.
pub(super) type Row = (&'static str, bool);

/// The page of figures.
///
/// * `families`: in the order of the rows; `settings`: in that of the columns.
pub(super) fn page(families: &[Row], settings: &[Setting], figures: &[Figure]) -> String {
    let mut text = HEAD.to_owned();
    let names: Vec<&str> = settings.iter().map(|s| title(s.language)).collect();
    let lines = "|---".repeat(names.len() + 3);
    let _ = writeln!(
        text,
        "\n| family | cases | SPIR-V runs on | {} |\n{lines}|",
        names.join(" | ")
    );
    for &(family, on_device) in families {
        let of = |language| {
            let mut all = figures.iter();
            all.find(|f| f.family == family && f.language == language)
        };
        let cases = figures.iter().filter(|f| f.family == family);
        let cases = cases.map(|f| f.cases).max().unwrap_or(0);
        let place = if on_device { "device" } else { "processor" };
        let _ = write!(text, "| {family} | {cases} | {place} |");
        for setting in settings {
            let error = of(setting.language).map_or(f64::NAN, |f| f.error);
            let _ = write!(text, " {error:.2} |");
        }
        text.push('\n');
    }
    text += MIDDLE;
    for setting in settings {
        let (compiler, runs_on) = (&setting.compiler, &setting.runs_on);
        let _ = writeln!(
            text,
            "| {} | {compiler} | {runs_on} |",
            title(setting.language)
        );
    }
    text
}

fn title(language: Language) -> &'static str {
    match language {
        Language::Wgsl => "WGSL",
        Language::Hlsl => "HLSL",
        Language::Glsl => "GLSL",
        Language::GlslEs => "GLSL ES",
        Language::Msl => "Metal",
        Language::SpirV => "SPIR-V",
        Language::Cpp => "C++",
        Language::Slang => "Slang",
    }
}

/// Whether a page has the lines of another: figures nearly, where they were measured with the same compilers.
pub(super) fn is_current(written: &str, measured: &str) -> bool {
    let settings = |page: &str| page.split_once(MIDDLE).map(|(_, rest)| rest.to_owned());
    let same_compilers = settings(written) == settings(measured);
    written.lines().count() == measured.lines().count()
        && written
            .lines()
            .zip(measured.lines())
            .all(|(old, new)| is_same(old, new, same_compilers))
}

fn is_same(old: &str, new: &str, same_compilers: bool) -> bool {
    let (cells, others): (Vec<&str>, Vec<&str>) =
        (old.split(" | ").collect(), new.split(" | ").collect());
    let near = |(a, b): (&&str, &&str)| {
        let number = |cell: &str| cell.trim_end_matches([' ', '|']).parse::<f64>();
        match (number(a), number(b)) {
            (Ok(a), Ok(b)) => !same_compilers || (a - b).abs() <= TOLERANCE,
            _ => !same_compilers && a.is_empty() == b.is_empty(),
        }
    };
    // The first three are the family, its number of cases and where it runs; or the first is a language.
    let heads = if cells.len() > 3 { 3 } else { 1 };
    old == new
        || old.starts_with("| ")
            && cells.len() == others.len()
            && cells.len() > 1
            && cells[..heads] == others[..heads]
            && cells[heads..].iter().zip(&others[heads..]).all(near)
}

#[test]
fn a_page_is_current_where_its_figures_are_near() {
    let of = |error: f64, cases, compiler: &str| {
        let settings = [Language::Glsl, Language::Hlsl].map(|language| Setting {
            language,
            compiler: compiler.to_owned(),
            runs_on: "a driver".to_owned(),
        });
        let figures = [Language::Glsl, Language::Hlsl].map(|language| Figure {
            language,
            family: "ndf",
            cases,
            error,
        });
        page(&[("ndf", true)], &settings, &figures)
    };
    let written = of(0.5, 7, "one 1.0");
    for (measured, expected) in [
        (of(0.5, 7, "one 1.0"), true),
        (of(0.58, 7, "one 1.0"), true),
        (of(0.62, 7, "one 1.0"), false),
        (of(0.9, 7, "one 1.1"), true),
        (of(0.5, 8, "one 1.0"), false),
        (of(0.5, 8, "one 1.1"), false),
    ] {
        assert_eq!(is_current(&written, &measured), expected, "{measured}");
    }
    assert!(!is_current("", &written));
}
