//! The verdict of a comparison: advice, effects of the treatments of energy, claims.

use super::CompareOptions;
use super::advice::recommendation;
use super::claims::{exact_is_best, fewer_rejected, same_mean};
use super::estimate::{Field, Judged};
use super::interval::Estimate;
use super::reference::Reference;
use super::results::gain;
use crate::Verdict;

/// The recommendation with its reason, and the claims.
pub(super) fn verdict(
    options: &CompareOptions<'_>,
    judged: &[Judged],
    fields: &[Field],
    references: &[Reference],
) -> Verdict {
    let mut sentences: Vec<String> = fields.iter().map(recommendation).collect();
    sentences.extend(treatments(options, references));
    let mut claims = vec![same_mean(judged)];
    claims.extend(fewer_rejected(judged));
    claims.extend(exact_is_best(fields));
    let origin = if options.reference.is_some() {
        "The reference is as given: what is wrong with it counts as error of all. "
    } else {
        ""
    };
    Verdict {
        summary: sentences.join(" "),
        claims,
        caveat: format!(
            "{origin}In brackets: intervals that all hold together at 95 % confidence, from the pixels' errors \
             and from how much times differ between rounds. \"Undecided\" and \"cannot be told apart\" say \
             that an interval has both answers in it: more time makes it narrower. Fireflies are counted \
             against the reference with its own noise. Times are this machine's."
        ),
    }
}

/// Effects of the treatments of energy.
fn treatments(options: &CompareOptions<'_>, references: &[Reference]) -> Option<String> {
    let first = options.energies.first()?;
    let others = references.len().saturating_sub(1);
    let changes: Vec<String> = (options.energies.iter().zip(references).skip(1))
        .map(|(energy, reference)| {
            let [value, error] = gain(&references[0], reference).map(|v| 100.0 * v);
            let change = Estimate {
                value,
                error,
                freedom: f64::INFINITY,
            };
            format!("{energy} by {} %", change.interval(others).text(2))
        })
        .collect();
    (!changes.is_empty()).then(|| {
        format!(
            "Energy is a matter of what is shown, not of noise: over {first}, the mean brightness \
             changes with {}.",
            changes.join(", ")
        )
    })
}
