//! Items of the papers that are not results: diagrams, notations, listings; and what is nearest to them here.

use crate::Source;

/// A table or figure that no experiment reproduces.
pub(super) struct Item {
    /// The source.
    pub(super) source: Source,
    /// Which table or figure.
    pub(super) item: &'static str,
    /// What it shows or states.
    pub(super) shows: &'static str,
    /// Why no experiment has it, and what is nearest to it here.
    pub(super) instead: &'static str,
}

const fn item(
    source: Source,
    item: &'static str,
    shows: &'static str,
    instead: &'static str,
) -> Item {
    Item {
        source,
        item,
        shows,
        instead,
    }
}

/// All of them.
pub(super) const ITEMS: &[Item] = &[
    item(
        Source::Tokuyoshi24,
        "fig. 2",
        "How a spherical cap is sampled: a diagram.",
        "`specula-bsdf/src/vndf/cap.rs`, with its derivation; the regions to scale are in tokuyoshi24-fig3.",
    ),
    item(
        Source::Tokuyoshi24,
        "fig. 11",
        "The bound serves neither refraction nor random walks: a diagram of a limitation.",
        "By construction here: `bsdf/dielectric.rs` and `multibounce/walk.rs` sample visible normals; \
         their chi-square tests include directions below the horizon.",
    ),
    item(
        Source::Tokuyoshi24,
        "table 1",
        "Notations.",
        "The papers' i is our `wo`, their o our `wi`: `specula-bsdf/src/bsdf/mod.rs`.",
    ),
    item(
        Source::Tokuyoshi24,
        "section 6, white furnace on a GPU",
        "No clear difference in time with and without the bound.",
        "Needs a GPU; `specula gpu-report` measures it on any adapter, `docs/gpu` has what was measured.",
    ),
    item(
        Source::Dupuy23,
        "fig. 2",
        "The three steps of sampling visible normals: a diagram.",
        "`specula-bsdf/src/vndf/heitz.rs`.",
    ),
    item(
        Source::Dupuy23,
        "fig. 3",
        "Sampling the visible hemisphere by its cross section: a diagram.",
        "`specula-bsdf/src/vndf/heitz.rs`.",
    ),
    item(
        Source::Dupuy23,
        "fig. 4",
        "A hemispherical mirror reflects parallel rays into a cap: a diagram.",
        "Tested as a law: chi-square of `vndf/cap.rs` in `specula-stat/tests/samplers.rs`.",
    ),
    item(
        Source::Dupuy23,
        "fig. 5",
        "Sampling the visible hemisphere by caps: a diagram.",
        "`specula-bsdf/src/vndf/cap.rs`.",
    ),
    item(
        Source::Cui23,
        "table 1",
        "Notations.",
        "`specula-bsdf/src/multibounce/mod.rs`.",
    ),
    item(
        Source::Cui23,
        "fig. 2",
        "Path spaces of four models: a diagram.",
        "One file per model in `specula-bsdf/src/multibounce`.",
    ),
    item(
        Source::Cui23,
        "fig. 3",
        "Four cases of light in a thin layer: a diagram of the derivation.",
        "`specula-bsdf/src/multibounce/cui2023.rs`.",
    ),
    item(
        Source::Cui23,
        "fig. 4",
        "Which terms of the recursion exist for a path: a diagram.",
        "`specula-bsdf/src/multibounce/cui2023.rs`, which has the case that the diagram omits too.",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments;

    /// Every table and figure of the papers, by source: each is an experiment or an [`Item`].
    const CONTENTS: &[(Source, &[&str])] = &[
        (
            Source::Tokuyoshi24,
            &[
                "fig. 1", "fig. 2", "fig. 3", "fig. 4", "fig. 5", "fig. 6", "fig. 7", "fig. 8",
                "fig. 9", "fig. 10", "fig. 11", "table 1", "table 2", "table 3",
            ],
        ),
        (Source::Eto23, &["fig. 1"]),
        (
            Source::Dupuy23,
            &[
                "fig. 1",
                "fig. 2",
                "fig. 3",
                "fig. 4",
                "fig. 5",
                "table 1",
                "section 4, CPU",
                "section 4, GPU",
            ],
        ),
        (
            Source::Cui23,
            &[
                "fig. 1",
                "fig. 2",
                "fig. 3",
                "fig. 4",
                "fig. 5",
                "fig. 6",
                "fig. 7",
                "fig. 8",
                "fig. 9",
                "fig. 10",
                "table 1",
                "supplement, fig. 1",
            ],
        ),
    ];

    /// `fig. 1` is not `fig. 10`; `fig. 10, left` is of `fig. 10`.
    fn answers_for(answer: &str, item: &str) -> bool {
        answer
            .strip_prefix(item)
            .is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
    }

    #[test]
    fn every_table_and_figure_has_an_answer() {
        for &(source, items) in CONTENTS {
            for &item in items {
                let experiments = experiments::ALL
                    .iter()
                    .filter(|e| e.source == source)
                    .map(|e| e.item);
                let others = ITEMS.iter().filter(|i| i.source == source).map(|i| i.item);
                let count = experiments
                    .chain(others)
                    .filter(|answer| answers_for(answer, item))
                    .count();
                assert!(count > 0, "{} {item}", source.cite());
            }
        }
        assert!(!answers_for("fig. 10", "fig. 1"));
        assert!(answers_for("fig. 10, left", "fig. 10"));
    }
}
