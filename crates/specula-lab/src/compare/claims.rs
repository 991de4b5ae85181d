//! Claims about a comparison: yes, no, or undecided, by intervals of confidence.

use specula_bsdf::vndf::Sampler;

use super::estimate::{Field, Judged, both_rounds};
use super::interval::{Estimate, Interval};
use crate::{Answer, Claim};

/// Two means are called the same where they are known to be within this share of each other.
const SAME: f64 = 0.01;
/// Standard errors beyond which means are called different: a chance of 1e-4 each, as a wrong "no" would
/// accuse a sampler of bias.
const DIFFERENT: f64 = 3.9;

/// All samplers converge to the same picture.
pub(super) fn same_mean(judged: &[Judged]) -> Claim {
    let worst = judged
        .iter()
        .max_by(|a, b| deviations(a.shift).total_cmp(&deviations(b.shift)));
    let measured = worst.map_or_else(String::new, |j| {
        let [shift, error] = j.shift.map(|v| 100.0 * v);
        format!(
            "farthest from the reference: {}, by {shift:+.2} % with a standard error of {error:.2} %",
            j.label
        )
    });
    Claim::measured(
        "All samplers converge to the same mean brightness, to 1 %",
        "equal",
        measured,
        Answer::all(judged.iter().map(|j| is_same(j.shift))),
    )
}

fn deviations([shift, error]: [f64; 2]) -> f64 {
    shift.abs() / error.max(f64::MIN_POSITIVE)
}

/// Of a mean that is `shift` off, with a standard error.
fn is_same(shift: [f64; 2]) -> Answer {
    if deviations(shift) > DIFFERENT {
        Answer::No
    } else if shift[0].abs() + DIFFERENT * shift[1] <= SAME {
        Answer::Yes
    } else {
        Answer::Undecided
    }
}

/// Each of the papers' samplers rejects at most as many directions as the one before it.
pub(super) fn fewer_rejected(judged: &[Judged]) -> Option<Claim> {
    let order = [Sampler::Cap, Sampler::Bounded, Sampler::Exact];
    let last = judged.iter().map(|j| j.reference).max()?;
    let mut pairs = Vec::new();
    let mut measured = Vec::new();
    for reference in 0..=last {
        let find = |s: Sampler| {
            let is_it = |j: &&Judged| j.sampler == s && j.reference == reference;
            judged.iter().find(is_it)
        };
        let there: Vec<&Judged> = order.into_iter().filter_map(find).collect();
        pairs.extend(there.windows(2).map(|w| [w[0], w[1]]));
        let words = there
            .iter()
            .map(|j| format!("{} {:.2} %", j.sampler, 100.0 * j.rejected_share));
        measured.push(words.collect::<Vec<_>>().join(", "));
    }
    let more = |[before, after]: [&Judged; 2]| {
        let rounds = both_rounds(before, after);
        Estimate::of_mean(rounds.map(|[x, y]| y.rejected_share - x.rejected_share))
    };
    let answers = pairs
        .iter()
        .map(|&pair| is_at_most(more(pair).interval(pairs.len()), 0.0));
    (!pairs.is_empty()).then(|| {
        Claim::measured(
            "Bounded caps reject at most as many directions as caps, and the exact sampler at most as many \
             as either",
            "at most as many",
            measured.join("; "),
            Answer::all(answers),
        )
    })
}

/// Whether the whole interval of a figure is at most `bound`.
fn is_at_most(figure: Interval, bound: f64) -> Answer {
    if figure.high <= bound {
        Answer::Yes
    } else if figure.low > bound {
        Answer::No
    } else {
        Answer::Undecided
    }
}

/// The exact sampler's error in the same time.
pub(super) fn exact_is_best(fields: &[Field]) -> Option<Claim> {
    let mut answers = Vec::new();
    let mut measured = Vec::new();
    for field in fields {
        let exact = field.samplers.iter().position(|&s| s == Sampler::Exact);
        let Some(exact) = exact else { continue };
        for (other, sampler) in field.samplers.iter().enumerate() {
            if other == exact {
                continue;
            }
            let treatment = if fields.len() > 1 {
                format!(" with energy {}", field.energy)
            } else {
                String::new()
            };
            let ratio = field.ratios[exact][other];
            measured.push(format!(
                "{} times that of {sampler}{treatment}",
                ratio.text(2)
            ));
            answers.push(is_at_most(ratio.inverse(), 1.0));
        }
    }
    (!answers.is_empty()).then(|| {
        Claim::measured(
            "The exact sampler is at least as efficient as any other",
            "1 / (MSE x time) at least as large",
            measured.join("; "),
            Answer::all(answers),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::advice::tests::field;
    use Sampler::{Bounded, Cap, Exact, Heitz};

    #[test]
    fn the_exact_samplers_claim_follows_from_the_figures() {
        let behind = [
            (Heitz, 1.0),
            (Cap, 1.0 / 0.86),
            (Bounded, 1.0 / 0.88),
            (Exact, 1.0),
        ];
        let ahead = [(Heitz, 0.6), (Cap, 0.8), (Exact, 1.0)];
        for (all, width, expected) in [
            (&behind[..], 0.02, Answer::No),
            // 0.86 may be 1 where it is uncertain by a factor of 1.3.
            (&behind, 0.3, Answer::Undecided),
            (&ahead, 0.1, Answer::Yes),
            (&ahead, 0.3, Answer::Undecided),
        ] {
            let claim = exact_is_best(&[field(all, width)]).unwrap();
            assert_eq!(claim.holds, expected, "{all:?} {width}: {}", claim.measured);
        }
        let claim = exact_is_best(&[field(&behind, 0.02)]).unwrap();
        assert!(
            claim
                .measured
                .contains("0.86 [0.84, 0.88] times that of cap; 0.88 [0.86, 0.90]"),
            "{}",
            claim.measured
        );
        assert!(exact_is_best(&[field(&[(Exact, 1.0)], 0.1)]).is_none());
        assert!(exact_is_best(&[field(&[(Heitz, 1.0), (Cap, 1.0)], 0.1)]).is_none());
    }

    #[test]
    fn an_efficiency_that_is_not_known_decides_nothing() {
        let mut unknown = field(&[(Heitz, 0.5), (Exact, 1.0)], 0.1);
        unknown.ratios[1][0] = Interval::unknown(f64::NAN).exp();
        let claim = exact_is_best(&[unknown]).unwrap();
        assert_eq!(claim.holds, Answer::Undecided);
        assert_eq!(claim.measured, "unknown times that of heitz");
    }

    #[test]
    fn means_are_the_same_where_that_is_known() {
        for (shift, expected) in [
            ([0.001, 0.001], Answer::Yes),
            ([0.009, 0.001], Answer::No),
            ([0.0, 0.01], Answer::Undecided),
            ([0.004, 0.0005], Answer::No),
        ] {
            assert_eq!(is_same(shift), expected, "{shift:?}");
        }
    }

    #[test]
    fn bounds_are_held_missed_or_undecided() {
        let interval = |low, high| Interval {
            middle: 0.0,
            low,
            high,
        };
        assert_eq!(is_at_most(interval(-0.2, -0.1), 0.0), Answer::Yes);
        assert_eq!(is_at_most(interval(0.0, 0.0), 0.0), Answer::Yes);
        assert_eq!(is_at_most(interval(-0.2, 0.1), 0.0), Answer::Undecided);
        assert_eq!(is_at_most(interval(0.1, 0.2), 0.0), Answer::No);
        assert_eq!(
            is_at_most(Interval::unknown(f64::NAN), 0.0),
            Answer::Undecided
        );
    }
}
