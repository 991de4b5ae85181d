//! The tables of one scene: its renders, their errors, and the pairs.

use std::fmt::Write;

use super::block::Block;
use super::outcome::{AGREEMENT, Outcome, Row, Source, ratios, time_to_equal};
use super::statistics::{Metric, median};

/// Both tables, notes on rows, and a line for each pair of each block.
pub(crate) fn scene(outcome: &Outcome) -> String {
    let mut text = renders(&outcome.rows);
    text.push('\n');
    text.push_str(&errors(&outcome.rows));
    text.push('\n');
    for row in &outcome.rows {
        notes(&mut text, row, &outcome.rows);
    }
    for block in Block::ALL {
        for (specula, theirs) in outcome.pairs(block) {
            if specula.fault.is_none() && theirs.fault.is_none() {
                pair(&mut text, specula, theirs);
            }
        }
    }
    text
}

fn renders(rows: &[Row]) -> String {
    let mut text = String::from(
        "| renderer | sampler | samples (reference) | wall s | CPU s | Msamples/s | mean | rate | warm-up s |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let _ = writeln!(
            text,
            "| {} | {} | {} ({}) | {:.2} | {:.2} | {:.2} | {:.4} | {:.2} | {:.1} |",
            row.name,
            row.sampler,
            row.spp,
            row.reference_spp,
            row.over_rounds(|r| r.wall),
            row.over_rounds(|r| r.cpu),
            1e-6 * row.samples_per_second(),
            row.reference_mean,
            row.rate,
            row.warm_up,
        );
    }
    text
}

fn errors(rows: &[Row]) -> String {
    let mut text = String::from(
        "| renderer | RMSE | block RMSE | trimmed RMSE | relMSE | RMSE to the other's \
         | RMSE from pairs | block RMSE from pairs | FLIP | FLIP denoised |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let square = |metric| row.squared_error(metric, Source::References);
        let cell = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:.4}"));
        let _ = writeln!(
            text,
            "| {} | {:.4} | {:.4} | {:.4} | {:.4} | {} | {} | {} | {} | {} |",
            row.name,
            square(Metric::Rmse).sqrt(),
            square(Metric::BlockRmse).sqrt(),
            square(Metric::TrimmedRmse).sqrt(),
            square(Metric::RelMse),
            cell(row.rmse_of_other),
            from_pairs(row, Metric::Rmse),
            from_pairs(row, Metric::BlockRmse),
            cell(row.flip.map(|f| f.rendered)),
            cell(row.flip.and_then(|f| f.denoised)),
        );
    }
    text
}

/// The error from pairs of seeds, over that against the reference in brackets, and the mark where they
/// disagree.
fn from_pairs(row: &Row, metric: Metric) -> String {
    let error = row.squared_error(metric, Source::Pairs).sqrt();
    let agreement = row.agreement(metric);
    format!("{error:.4} ({agreement:.2}){}", mark(&[row], metric))
}

/// What stands behind a figure where pairs of seeds disagree with the reference of one of the rows.
pub(crate) fn mark(rows: &[&Row], metric: Metric) -> &'static str {
    let apart = rows.iter().any(|r| r.disagreements().contains(&metric));
    if apart { " apart" } else { "" }
}

fn notes(text: &mut String, row: &Row, rows: &[Row]) {
    if let Some(fault) = &row.fault {
        let _ = writeln!(text, "- error: {fault}.");
    }
    if let Some(same) = row.same_as {
        let _ = writeln!(
            text,
            "- {} renders the same pictures as {}, bit for bit: rendered once.",
            row.name, rows[same].name
        );
    }
    for metric in row.disagreements() {
        let _ = writeln!(
            text,
            "- {}: {} from pairs of seeds is {:.2} times that against the reference, more than {:.0} % apart.",
            row.name,
            metric.name(),
            row.agreement(metric),
            100.0 * AGREEMENT
        );
    }
}

fn pair(text: &mut String, specula: &Row, theirs: &Row) {
    let spread = ratios(specula, theirs, Metric::Rmse, Source::References);
    let (least, most) = spread
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(a, b), &r| (a.min(r), b.max(r)));
    let to_equal = |metric, source| time_to_equal(specula, theirs, metric, source);
    let _ = writeln!(
        text,
        "- {} against {}: time to equal RMSE {:.3} ({least:.3} to {most:.3}), block RMSE {:.3}, trimmed RMSE \
         {:.3}, relMSE {:.3}; from pairs of seeds RMSE {:.3}, block RMSE {:.3}; time per sample {:.3}; means \
         {:+.2} %.",
        specula.name,
        theirs.name,
        median(&spread),
        to_equal(Metric::BlockRmse, Source::References),
        to_equal(Metric::TrimmedRmse, Source::References),
        to_equal(Metric::RelMse, Source::References),
        to_equal(Metric::Rmse, Source::Pairs),
        to_equal(Metric::BlockRmse, Source::Pairs),
        theirs.samples_per_second() / specula.samples_per_second(),
        100.0 * (specula.reference_mean / theirs.reference_mean - 1.0),
    );
}

#[cfg(test)]
mod tests {
    use super::super::flip::Flip;
    use super::super::outcome::tests::row;
    use super::super::scenes::tests::scene as some_scene;
    use super::*;

    fn outcome() -> Outcome {
        Outcome {
            scene: some_scene(),
            rows: vec![
                row(
                    "specula-defaults",
                    Some(Block::Defaults),
                    &[1.0, 2.0, 9.0],
                    0.01,
                ),
                row("specula-alone", Some(Block::Alone), &[1.0, 2.0, 9.0], 0.01),
                row("theirs", None, &[2.0, 2.0, 2.0], 0.02),
            ],
            references: Vec::new(),
            first: Vec::new(),
        }
    }

    #[test]
    fn a_pair_is_told_by_every_error() {
        let text = scene(&outcome());
        assert!(
            text.contains(
                "- specula-defaults against theirs: time to equal RMSE 0.500 (0.250 to 2.250), block RMSE 0.500, \
                 trimmed RMSE 0.500, relMSE 0.500; from pairs of seeds RMSE 0.875, block RMSE 0.875; \
                 time per sample 1.000; means +0.00 %.\n"
            ),
            "{text}"
        );
        // Roots of 0.01, 0.02 and 0.005, and from pairs.
        let line = "| specula-defaults | 0.1000 | 0.1414 | 0.0707 | 0.0100 |  | 0.1000 (1.00) | 0.1414 (1.00) |  |  |";
        assert!(text.contains(line), "{text}");
        assert!(text.contains(
            "| specula-defaults | s | 16 (256) | 2.00 | 4.00 | 32.00 | 1.0000 | 0.50 | 0.0 |"
        ));
        assert!(!text.contains("apart"), "{text}");
    }

    #[test]
    fn a_disagreement_is_marked_and_what_is_the_same_is_said() {
        let mut outcome = outcome();
        outcome.rows[1].same_as = Some(0);
        for pair in &mut outcome.rows[2].pairs {
            pair.errors.mse *= 1.21;
        }
        outcome.rows[2].flip = Some(Flip {
            rendered: 0.25,
            denoised: Some(0.125),
        });
        let text = scene(&outcome);
        let cells = "| 0.1556 (1.10) apart | 0.2000 (1.00) | 0.2500 | 0.1250 |";
        assert!(text.contains(cells), "{text}");
        let note = "- theirs: RMSE from pairs of seeds is 1.10 times that against the reference, more than 5 % apart.";
        assert!(text.contains(note), "{text}");
        let same = "- specula-alone renders the same pictures as specula-defaults, bit for bit: rendered once.";
        assert!(text.contains(same), "{text}");
    }

    #[test]
    fn a_fault_of_either_hides_the_pair() {
        for faulty in [0, 2] {
            let mut outcome = outcome();
            outcome.rows[faulty].fault = Some("dark".to_owned());
            let text = scene(&outcome);
            assert!(text.contains("- error: dark."), "{text}");
            assert!(
                !text.contains("- specula-defaults against theirs"),
                "{text}"
            );
        }
    }
}
