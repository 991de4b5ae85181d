//! Advice which sampler to use, in plain words, with figures.

use specula_bsdf::vndf::Sampler;

use super::estimate::Field;
use super::interval::Interval;

/// Of samplers that cannot be told apart, the default is recommended where its efficiency is at least this
/// share of the largest.
const NEARLY: f64 = 0.98;

/// What is recommended for a treatment of energy.
#[derive(Debug, PartialEq)]
pub(super) struct Choice {
    /// Index of the sampler.
    pub(super) taken: usize,
    /// All samplers that cannot be told apart from it, itself included: none is shown to be more efficient.
    pub(super) tied: Vec<usize>,
    /// Why it is recommended.
    pub(super) by: Reason,
}

/// Why a sampler is recommended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reason {
    /// All others are shown to be less efficient.
    Shown,
    /// A tie-break: it is the default.
    Default,
    /// A tie-break: its measured efficiency is the largest.
    Measured,
}

/// The most efficient sampler, and the tie-break where several may be it. `None` where no efficiency is
/// known.
pub(super) fn choice(field: &Field) -> Option<Choice> {
    let all = 0..field.samplers.len();
    let others = |i: usize| all.clone().filter(move |&j| j != i);
    let is_known = |i: usize| others(i).any(|j| field.ratios[i][j].middle.is_finite());
    let known: Vec<usize> = all.clone().filter(|&i| is_known(i)).collect();
    let first = *known.first()?;
    let measured = |i: usize| field.ratios[i][first].middle;
    let best = known
        .iter()
        .copied()
        .max_by(|&a, &b| measured(a).total_cmp(&measured(b)))?;
    let is_beaten = |i: usize| others(i).any(|j| field.ratios[j][i].low > 1.0);
    let tied: Vec<usize> = all.clone().filter(|&i| !is_beaten(i)).collect();
    let default = tied
        .iter()
        .copied()
        .find(|&i| field.samplers[i] == Sampler::default());
    let (taken, by) = match default {
        _ if tied.len() < 2 => (best, Reason::Shown),
        Some(i) if field.ratios[i][best].middle >= NEARLY => (i, Reason::Default),
        _ => (best, Reason::Measured),
    };
    Some(Choice { taken, tied, by })
}

/// The recommendation, in words.
pub(super) fn recommendation(field: &Field) -> String {
    let energy = field.energy;
    if let [only] = field.samplers[..] {
        return format!("With energy {energy}, only {only} was compared.");
    }
    let Some(Choice { taken, tied, by }) = choice(field) else {
        return format!(
            "With energy {energy}, the errors are smaller than the reference can tell: give more time."
        );
    };
    let name = field.samplers[taken];
    let beaten: Vec<usize> = (0..field.samplers.len())
        .filter(|i| !tied.contains(i))
        .collect();
    let needs = |it: &str| {
        let each = beaten.iter().map(|&i| {
            let times = field.ratios[i][taken].text(2);
            format!("{times} of the time of {}", field.samplers[i])
        });
        format!("{it} needs {} for the same error", listed(each))
    };
    if by == Reason::Shown {
        return format!("With energy {energy}, take {name}: {}.", needs("it"));
    }
    let names = listed(tied.iter().map(|&i| field.samplers[i].to_string()));
    let why = match by {
        Reason::Default => "it is the default",
        _ => "it came out most efficient",
    };
    let mut text = format!(
        "With energy {energy}, {names} cannot be told apart. The tie-break: take {name}, as of these {why}; {}.",
        price(field, taken, &tied)
    );
    if !beaten.is_empty() {
        text += &format!(" {}.", needs("It"));
    }
    text
}

/// What a tie-break costs at most.
fn price(field: &Field, taken: usize, tied: &[usize]) -> String {
    let most = tied.iter().map(|&i| field.ratios[i][taken].high);
    let most = most.fold(1.0, f64::max);
    if most.is_finite() {
        format!("that takes at most {most:.2} times the time of the best of them")
    } else {
        "how much more time that may take is not known: give more time".to_owned()
    }
}

/// `a, b and c`.
fn listed(all: impl Iterator<Item = String>) -> String {
    let all: Vec<String> = all.collect();
    match all.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

/// The efficiency of the first of a pair, in words.
pub(super) fn decided(ratio: Interval) -> &'static str {
    if ratio.low > 1.0 {
        "more efficient"
    } else if ratio.high < 1.0 {
        "less efficient"
    } else {
        "not told apart"
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::compare::estimate::square;
    use Sampler::{Bounded, Cap, Exact, Heitz};
    use specula_scene::Energy;
    use specula_stat::Rng;

    /// Samplers with their efficiencies; every ratio is uncertain by a factor of `1 + width`.
    pub(in crate::compare) fn field(all: &[(Sampler, f64)], width: f64) -> Field {
        Field {
            energy: Energy::None,
            samplers: all.iter().map(|a| a.0).collect(),
            ratios: square(all.len(), |a, b| {
                let middle = all[a].1 / all[b].1;
                Interval {
                    middle,
                    low: middle / (1.0 + width),
                    high: middle * (1.0 + width),
                }
            }),
        }
    }

    fn taken(all: &[(Sampler, f64)], width: f64) -> (Sampler, Reason, usize) {
        let choice = choice(&field(all, width)).unwrap();
        (all[choice.taken].0, choice.by, choice.tied.len())
    }

    #[test]
    fn the_most_efficient_is_taken() {
        let all = [(Heitz, 1.0), (Cap, 1.16), (Bounded, 1.14), (Exact, 0.98)];
        assert_eq!(taken(&all, 0.01), (Cap, Reason::Shown, 1));
        // Cap and bounded within 2 %, exact behind both.
        assert_eq!(taken(&all, 0.05), (Cap, Reason::Measured, 2));
        // The default takes 1.18 times as long: not even a tie-break takes it.
        assert_eq!(taken(&all, 0.5), (Cap, Reason::Measured, 4));
        let even = [(Heitz, 1.0), (Cap, 1.01), (Bounded, 1.0), (Exact, 1.0)];
        assert_eq!(taken(&even, 0.05), (Exact, Reason::Default, 4));
    }

    #[test]
    fn words_say_tie_breaks_and_what_they_cost() {
        let all = [(Heitz, 0.5), (Bounded, 1.01), (Exact, 1.0)];
        let text = recommendation(&field(&all, 0.05));
        assert_eq!(
            text,
            "With energy none, bounded and exact cannot be told apart. The tie-break: take exact, as of these \
             it is the default; that takes at most 1.06 times the time of the best of them. It needs \
             0.50 [0.48, 0.53] of the time of heitz for the same error."
        );
        let text = recommendation(&field(&[(Heitz, 0.5), (Cap, 1.0)], 0.05));
        assert_eq!(
            text,
            "With energy none, take cap: it needs 0.50 [0.48, 0.53] of the time of heitz for the same error."
        );
    }

    #[test]
    fn what_is_not_known_is_not_behind() {
        let mut unknown = field(&[(Heitz, 1.0), (Cap, 2.0), (Exact, 1.0)], 0.05);
        for other in 0..2 {
            unknown.ratios[2][other] = Interval::unknown(f64::NAN).exp();
            unknown.ratios[other][2] = Interval::unknown(f64::NAN).exp();
        }
        let found = choice(&unknown).unwrap();
        assert_eq!((found.taken, found.tied), (1, vec![1, 2]));
        assert!(recommendation(&unknown).contains("is not known: give more time"));
        let nothing = field(&[(Heitz, f64::NAN), (Cap, f64::NAN)], 0.05);
        assert_eq!(choice(&nothing), None);
        assert!(recommendation(&nothing).contains("smaller than the reference can tell"));
        let alone = recommendation(&field(&[(Cap, 1.0)], 0.0));
        assert_eq!(alone, "With energy none, only cap was compared.");
    }

    /// Whatever the figures.
    #[test]
    fn advice_never_names_one_that_is_shown_to_be_behind() {
        let mut rng = Rng::new(3);
        for case in 0..2000 {
            let all = [Heitz, Cap, Bounded, Exact].map(|s| (s, (0.6 * rng.uniform()).exp()));
            let field = field(&all, 0.5 * rng.uniform());
            let found = choice(&field).unwrap();
            let ratios = (0..4).map(|other| field.ratios[other][found.taken]);
            for ratio in ratios {
                assert!(ratio.low <= 1.0, "case {case}: {all:?}, {found:?}");
                // Nor is it measured to take much longer.
                assert!(
                    ratio.middle <= 1.0 / NEARLY,
                    "case {case}: {all:?}, {found:?}"
                );
            }
            assert_eq!(found.by == Reason::Shown, found.tied.len() == 1);
            assert!(found.tied.contains(&found.taken));
        }
    }
}
