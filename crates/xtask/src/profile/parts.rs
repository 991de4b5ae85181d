//! Which part of a render an instruction belongs to, by symbol, file and enclosing function.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::callgrind::Cost;

/// A part of a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Closest,
    Any,
    Surfaces,
    Sampling,
    Evaluation,
    Lights,
    RandomNumbers,
    Film,
    /// Clearing, copying and allocating memory.
    Memory,
    Rest,
}

impl Part {
    pub(super) const ALL: [Self; 10] = [
        Self::Closest,
        Self::Any,
        Self::Surfaces,
        Self::Sampling,
        Self::Evaluation,
        Self::Lights,
        Self::RandomNumbers,
        Self::Film,
        Self::Memory,
        Self::Rest,
    ];

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Closest => "closest hits",
            Self::Any => "shadow rays",
            Self::Surfaces => "surfaces, frames",
            Self::Sampling => "BSDF sampling",
            Self::Evaluation => "BSDF evaluation",
            Self::Lights => "lights",
            Self::RandomNumbers => "random numbers",
            Self::Film => "camera, film",
            Self::Memory => "memory",
            Self::Rest => "rest",
        }
    }
}

/// Modules of the renderer that are one part each.
const MODULES: [(&str, Part); 10] = [
    ("bump", Part::Surfaces),
    ("geometry", Part::Surfaces),
    ("material", Part::Surfaces),
    ("offset", Part::Surfaces),
    ("texture", Part::Surfaces),
    ("light", Part::Lights),
    ("sampler", Part::RandomNumbers),
    ("camera", Part::Film),
    ("film", Part::Film),
    ("renderer", Part::Film),
];

/// What a line says of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    /// It is of this part.
    Of(Part),
    /// A helper of BSDFs: of sampling where that is what goes on, of evaluation elsewhere.
    OfBsdf,
    /// It serves whatever goes on: vectors, iterators, arithmetic.
    Neutral,
    /// It packs or writes files.
    Outside,
}

/// Instructions of every part, in the order of [`Part::ALL`].
pub(super) type Totals = [u64; Part::ALL.len()];

/// Adds up the costs of a profile. Neutral code counts for what stands before it in the same symbol, or
/// after it where nothing does.
pub(super) fn totals(costs: &[Cost<'_>], sources: &mut Sources) -> Totals {
    let mut totals = Totals::default();
    for symbol in costs.chunk_by(|a, b| a.symbol == b.symbol) {
        let origins: Vec<Origin> = symbol
            .iter()
            .map(|c| origin(c.symbol, c.file, &sources.function(c.file, c.line)))
            .collect();
        if let Some(part) = kernel(&origins) {
            totals[part as usize] += symbol.iter().map(|c| c.instructions).sum::<u64>();
            continue;
        }
        let first = origins.iter().find(|o| **o != Origin::Neutral);
        let mut going_on = part(*first.unwrap_or(&Origin::Of(Part::Rest)), None);
        for (cost, origin) in symbol.iter().zip(origins) {
            going_on = part(origin, going_on);
            if let Some(part) = going_on {
                totals[part as usize] += cost.instructions;
            }
        }
    }
    totals
}

/// The part of a symbol that is BSDFs alone, as the kernels of batches are: sampling where any of it is.
fn kernel(origins: &[Origin]) -> Option<Part> {
    let (sampling, evaluation) = (Origin::Of(Part::Sampling), Origin::Of(Part::Evaluation));
    let of_bsdf = |o: &Origin| [sampling, evaluation, Origin::OfBsdf].contains(o);
    let alone = origins.iter().all(|o| of_bsdf(o) || *o == Origin::Neutral);
    if !alone || !origins.iter().any(of_bsdf) {
        return None;
    }
    Some(match origins.contains(&sampling) {
        true => Part::Sampling,
        false => Part::Evaluation,
    })
}

/// The part of an origin where `going_on` is what stands before.
fn part(origin: Origin, going_on: Option<Part>) -> Option<Part> {
    match origin {
        Origin::Of(part) => Some(part),
        Origin::OfBsdf if going_on == Some(Part::Sampling) => going_on,
        Origin::OfBsdf => Some(Part::Evaluation),
        Origin::Neutral => going_on,
        Origin::Outside => None,
    }
}

/// What the symbol, the file and the function around a line tell.
fn origin(symbol: &str, file: &str, function: &str) -> Origin {
    let file = file.replace('\\', "/");
    let within = |crate_name: &str| file.split_once(crate_name).map(|(_, rest)| rest);
    if ["miniz_oxide", "zlib", "/exr-", "/png-", "fdeflate"]
        .iter()
        .any(|name| file.contains(name))
    {
        return Origin::Outside;
    }
    if ["/malloc/", "memset", "memmove", "memcpy"]
        .iter()
        .any(|name| file.contains(name))
    {
        return Origin::Of(Part::Memory);
    }
    if file.contains("sobol_burley") {
        return Origin::Of(Part::RandomNumbers);
    }
    let lobes = ["specula-bsdf/src/", "specula-lobes/src/"];
    if let Some(rest) = lobes.iter().find_map(|name| within(name)) {
        return of_bsdf(rest, function);
    }
    let Some(rest) = within("specula-render/src/") else {
        return Origin::Neutral;
    };
    let starts = |names: &[&str]| names.iter().any(|name| rest.starts_with(name));
    if starts(&["accel"]) {
        // Of small scenes: `brute_force::any`, mangled or not.
        let is_any = ["occluded", "brute_force::any", "brute_force3any"];
        return Origin::Of(match is_any.iter().any(|name| symbol.contains(name)) {
            true => Part::Any,
            false => Part::Closest,
        });
    }
    if let Some((_, part)) = MODULES.iter().find(|(name, _)| rest.starts_with(name)) {
        return Origin::Of(*part);
    }
    if starts(&["integrator"]) {
        return of_integrator(rest, function);
    }
    if starts(&["picture", "prepared"]) {
        return Origin::Outside;
    }
    Origin::Neutral
}

/// A file of the library of BSDFs.
fn of_bsdf(rest: &str, function: &str) -> Origin {
    let is = |names: &[&str]| names.iter().any(|name| function.contains(name));
    if rest.starts_with("math") {
        return Origin::Neutral;
    }
    if is(&["sample"]) {
        return Origin::Of(Part::Sampling);
    }
    if is(&["eval", "pdf", "albedo"]) {
        return Origin::Of(Part::Evaluation);
    }
    match rest.starts_with("batch") {
        true => Origin::Neutral,
        false => Origin::OfBsdf,
    }
}

/// A file of the integrator: what its functions do, by their names.
fn of_integrator(rest: &str, function: &str) -> Origin {
    let is = |names: &[&str]| names.iter().any(|name| function.contains(name));
    if rest.contains("lobes") && is(&["sample"]) {
        return Origin::Of(Part::Sampling);
    }
    if rest.contains("lobes") && is(&["eval"]) {
        return Origin::Of(Part::Evaluation);
    }
    if is(&["surface", "turn", "straighten", "normal"]) {
        return Origin::Of(Part::Surfaces);
    }
    if is(&["light", "emission", "background"]) {
        return Origin::Of(Part::Lights);
    }
    Origin::Of(Part::Rest)
}

/// The sources, read when they are first asked for.
pub(super) struct Sources {
    root: PathBuf,
    functions: HashMap<String, Vec<(u32, String)>>,
}

impl Sources {
    /// Those of the workspace at `root`.
    pub(super) fn new(root: &Path) -> Self {
        Self {
            root: root.to_owned(),
            functions: HashMap::new(),
        }
    }

    /// The name of the function that a line stands in: that of the last `fn` at or above it; empty where
    /// the file is not of the workspace.
    fn function(&mut self, file: &str, line: u32) -> String {
        let Some(at) = file.find("crates/specula-") else {
            return String::new();
        };
        let functions = self.functions.entry(file.to_owned()).or_insert_with(|| {
            let text = fs::read_to_string(self.root.join(&file[at..])).unwrap_or_default();
            functions(&text)
        });
        let after = functions.partition_point(|(first, _)| *first <= line);
        match after.checked_sub(1) {
            Some(i) => functions[i].1.clone(),
            None => String::new(),
        }
    }
}

/// Line and name of every function of a source.
fn functions(text: &str) -> Vec<(u32, String)> {
    let named = |line: &str| {
        let (before, rest) = line.split_once("fn ")?;
        let heads = before.split_whitespace().all(|word| {
            word.starts_with("pub") || ["const", "unsafe", "extern", "super)"].contains(&word)
        });
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
        let name = &rest[..end.unwrap_or(rest.len())];
        (heads && !name.is_empty()).then(|| name.to_owned())
    };
    (1..)
        .zip(text.lines())
        .filter_map(|(number, line)| Some((number, named(line)?)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::callgrind::{costs, tests::EXCERPT};
    use super::*;

    #[test]
    fn functions_are_found_by_line() {
        let text = "//! fn no\nstruct A;\n    pub(super) fn sample<T>(\n  x\n) {}\nfn eval() {}\n";
        let found = functions(text);
        assert_eq!(found, [(3, "sample".to_owned()), (6, "eval".to_owned())]);
    }

    #[test]
    fn every_instruction_of_the_render_has_its_part() {
        let costs = costs(EXCERPT).unwrap();
        let mut sources = Sources::new(Path::new("/nowhere"));
        // Lines 11 and 21 of the conductor are of two functions.
        let conductor = "/w/crates/specula-bsdf/src/bsdf/conductor.rs";
        let lines = vec![(5, "sample".to_owned()), (20, "eval_pdf".to_owned())];
        sources.functions.insert(conductor.to_owned(), lines);
        let totals = totals(&costs, &mut sources);
        let of = |part: Part| totals[part as usize];
        assert_eq!(of(Part::Closest), 200);
        assert_eq!(of(Part::Any), 111);
        // The tree's, and the arithmetic after it.
        assert_eq!(of(Part::Lights), 107);
        assert_eq!(of(Part::Sampling), 50);
        assert_eq!(of(Part::Evaluation), 39);
        // The block's own, and what is called of the system.
        assert_eq!(of(Part::Rest), 55 + 600);
        let all = 200 + 111 + 107 + 50 + 39 + 655;
        assert_eq!(totals.iter().sum::<u64>(), all);
        let clearing = Cost {
            symbol: "__memset_avx2",
            file: "memset-vec.S",
            line: 1,
            instructions: 9,
        };
        let memory = super::totals(&[clearing], &mut sources)[Part::Memory as usize];
        assert_eq!(memory, 9);
        let small = |symbol| Cost {
            symbol,
            file: "/w/crates/specula-render/src/accel/brute_force.rs",
            ..clearing
        };
        let costs = [
            small("accel::brute_force::any::v3"),
            small("accel11brute_force7closest"),
        ];
        let found = super::totals(&costs, &mut sources);
        assert_eq!(
            [found[Part::Any as usize], found[Part::Closest as usize]],
            [9, 9]
        );
    }

    #[test]
    fn modules_are_those_of_the_renderer() {
        let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specula-render/src");
        let others = ["accel", "integrator", "picture", "prepared"];
        for name in MODULES.iter().map(|(name, _)| *name).chain(others) {
            assert!(
                sources.join(format!("{name}.rs")).exists() || sources.join(name).exists(),
                "{name}"
            );
        }
        let small = fs::read_to_string(sources.join("accel/brute_force.rs")).unwrap();
        assert!(small.contains("\nfn any("), "shadow rays of small scenes");
    }

    #[test]
    fn lobes_of_their_own_crate_are_bsdfs() {
        assert!(
            Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("../specula-lobes/src")
                .exists()
        );
        let lobe = Cost {
            symbol: "of",
            file: "/w/crates/specula-lobes/src/glass.rs",
            line: 3,
            instructions: 7,
        };
        let mut sources = Sources::new(Path::new("/nowhere"));
        let lines = vec![(1, "sample".to_owned())];
        sources.functions.insert(lobe.file.to_owned(), lines);
        assert_eq!(
            super::totals(&[lobe], &mut sources)[Part::Sampling as usize],
            7
        );
    }

    #[test]
    fn kernels_of_batches_are_one_part() {
        let cost = |symbol, file, line| Cost {
            symbol,
            file,
            line,
            instructions: 4,
        };
        let (arithmetic, ggx) = (
            "/rustc/core/ops/arith.rs",
            "/w/crates/specula-bsdf/src/ndf/ggx.rs",
        );
        let cap = "/w/crates/specula-bsdf/src/vndf/cap.rs";
        let costs = [
            cost("a", arithmetic, 1),
            cost("a", ggx, 1),
            cost("a", cap, 30),
            cost("b", arithmetic, 1),
            cost("b", ggx, 1),
            // Neutral code at the head of others counts for what follows.
            cost("c", arithmetic, 1),
            cost("c", "/w/crates/specula-render/src/light/tree.rs", 1),
        ];
        let mut sources = Sources::new(Path::new("/nowhere"));
        let lines = vec![(20, "sample_wm".to_owned())];
        sources.functions.insert(cap.to_owned(), lines);
        let totals = totals(&costs, &mut sources);
        assert_eq!(totals[Part::Sampling as usize], 12);
        assert_eq!(totals[Part::Evaluation as usize], 8);
        assert_eq!(totals[Part::Lights as usize], 8);
    }

    #[test]
    fn helpers_of_lobes_count_for_what_goes_on() {
        let helper = origin("x", "/w/crates/specula-bsdf/src/fresnel/mod.rs", "f");
        assert_eq!(part(helper, Some(Part::Sampling)), Some(Part::Sampling));
        assert_eq!(part(helper, Some(Part::Lights)), Some(Part::Evaluation));
        let packing = origin("x", "/r/miniz_oxide-0.8/src/core.rs", "f");
        assert_eq!(part(packing, Some(Part::Film)), None);
    }
}
