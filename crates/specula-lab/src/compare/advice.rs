//! Which sampler to take, in plain words, with figures.

use specula_bsdf::vndf::Sampler;
use specula_stat::z_test::{sidak, two_sided_p};

use super::CompareOptions;
use super::estimate::Judged;
use super::reference::Reference;
use super::results::gain;
use crate::output::table::significant;
use crate::{Claim, Verdict};

/// Standard errors within which two efficiencies are called even.
const EVEN: f64 = 2.0;
/// Chance of calling right samplers wrong.
const SIGNIFICANCE: f64 = 1e-3;

/// What is recommended and why, and what must hold.
pub(super) fn verdict(
    options: &CompareOptions<'_>,
    judged: &[Judged],
    references: &[Reference],
) -> Verdict {
    let mut sentences = Vec::new();
    for number in 0..references.len() {
        let own: Vec<&Judged> = judged.iter().filter(|j| j.reference == number).collect();
        sentences.push(recommendation(&own));
    }
    sentences.extend(treatments(options, references));
    let mut claims = vec![same_mean(judged)];
    claims.extend(fewer_rejected(judged));
    claims.extend(gains(judged));
    let origin = if options.reference.is_some() {
        "The reference is as given: what is wrong with it counts as error of all. "
    } else {
        ""
    };
    Verdict {
        summary: sentences.join(" "),
        claims,
        caveat: format!(
            "{origin}Fireflies are counted against the reference with its own noise. Times are this \
             machine's; uncertainties are one standard error."
        ),
    }
}

/// Which sampler is best for one treatment of energy.
fn recommendation(own: &[&Judged]) -> String {
    let known: Vec<&&Judged> = own.iter().filter(|j| j.efficiency[0].is_finite()).collect();
    let Some(best) = best(&known) else {
        return "The errors are smaller than the reference can tell: give more time.".to_owned();
    };
    let energy = best.energy;
    let others: Vec<&Judged> = known
        .iter()
        .filter(|j| j.sampler != best.sampler)
        .map(|j| **j)
        .collect();
    let [even, behind]: [Vec<&Judged>; 2] = [true, false].map(|wanted| {
        let is_wanted = |j: &&&Judged| is_even(j, best) == wanted;
        others.iter().filter(is_wanted).copied().collect()
    });
    let mut text = format!("With energy {energy}, take {}", best.sampler);
    if others.is_empty() {
        return text + ": nothing else was compared.";
    }
    let needs = |all: &[&Judged]| {
        let each: Vec<String> = all.iter().map(|j| factor(j, best)).collect();
        format!("it needs {} for the same error", each.join(", "))
    };
    if !behind.is_empty() {
        text += &format!(": {}", needs(&behind));
    }
    if !even.is_empty() {
        let names: Vec<String> = even.iter().map(|j| j.sampler.to_string()).collect();
        let others = names.join(", ");
        text += &format!("; it is not told apart from {others} ({})", needs(&even));
    }
    text + "."
}

/// The most efficient one; of those that are even with it, the one that rejects least.
fn best<'a>(known: &[&&'a Judged]) -> Option<&'a Judged> {
    let most = known
        .iter()
        .max_by(|a, b| a.efficiency[0].total_cmp(&b.efficiency[0]))?;
    known
        .iter()
        .filter(|j| is_even(j, most))
        .min_by(|a, b| a.rejected_share.total_cmp(&b.rejected_share))
        .map(|j| **j)
}

fn is_even(a: &Judged, b: &Judged) -> bool {
    let error = a.efficiency[1].hypot(b.efficiency[1]);
    (a.efficiency[0] - b.efficiency[0]).abs() <= EVEN * error
}

/// `0.78 +- 0.02 of the time of cap`.
fn factor(other: &Judged, best: &Judged) -> String {
    let ratio = other.efficiency[0] / best.efficiency[0];
    let [a, b] = [other, best].map(|j| j.efficiency[1] / j.efficiency[0]);
    format!(
        "{ratio:.2} +- {:.2} of the time of {}",
        ratio * a.hypot(b),
        other.sampler
    )
}

/// What treatments of energy change.
fn treatments(options: &CompareOptions<'_>, references: &[Reference]) -> Option<String> {
    let first = options.energies.first()?;
    let changes: Vec<String> = (options.energies.iter().zip(references).skip(1))
        .map(|(energy, reference)| {
            let [change, error] = gain(&references[0], reference).map(|v| 100.0 * v);
            format!("{energy} by {change:+.2} +- {error:.2} %")
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

/// All samplers converge to the same picture.
fn same_mean(judged: &[Judged]) -> Claim {
    let worst = judged.iter().map(|j| j.z.abs()).fold(0.0, f64::max);
    let p = two_sided_p(worst);
    Claim::measured(
        "All samplers converge to the same mean brightness",
        "equal",
        format!(
            "at most {worst:.1} standard errors from the reference (p = {})",
            significant(p, 2)
        ),
        p >= sidak(SIGNIFICANCE, judged.len().max(1)),
    )
}

/// Each of the papers' samplers rejects at most as many directions as the one before it.
fn fewer_rejected(judged: &[Judged]) -> Option<Claim> {
    let share = |sampler: Sampler, reference: usize| {
        let own = judged
            .iter()
            .find(|j| j.sampler == sampler && j.reference == reference);
        own.map(|j| j.rejected_share)
    };
    let order = [Sampler::Cap, Sampler::Bounded, Sampler::Exact];
    let last = judged.iter().map(|j| j.reference).max()?;
    let (mut holds, mut measured) = (true, Vec::new());
    for reference in 0..=last {
        let shares = order.map(|s| share(s, reference).map(|v| (s, v)));
        let there: Vec<(Sampler, f64)> = shares.into_iter().flatten().collect();
        if there.len() < 2 {
            return None;
        }
        // Shares are estimates: a thousandth is not told apart.
        holds &= there.windows(2).all(|w| w[1].1 <= w[0].1 + 1e-3);
        let words: Vec<String> = there
            .iter()
            .map(|(s, v)| format!("{s} {:.2} %", 100.0 * v))
            .collect();
        measured.push(words.join(", "));
    }
    Some(Claim::measured(
        "Bounded caps reject fewer directions than caps, and the exact sampler fewer still",
        "at most as many",
        measured.join("; "),
        holds,
    ))
}

/// The exact sampler's error in the same time.
fn gains(judged: &[Judged]) -> Option<Claim> {
    let exact: Vec<&Judged> = judged
        .iter()
        .filter(|j| j.sampler == Sampler::Exact)
        .collect();
    let others = judged.iter().filter(|j| j.sampler != Sampler::Exact);
    let (mut holds, mut measured) = (true, Vec::new());
    for other in others {
        let own = exact.iter().find(|e| e.reference == other.reference)?;
        if own.efficiency[0].is_finite() && other.efficiency[0].is_finite() {
            holds &= own.efficiency[0] >= other.efficiency[0] || is_even(own, other);
            let ratio = own.efficiency[0] / other.efficiency[0];
            measured.push(format!("{ratio:.2} x {}", other.label));
        }
    }
    (!measured.is_empty()).then(|| {
        Claim::measured(
            "The exact sampler is at least as efficient as any other",
            "1 / (MSE x time)",
            measured.join("; "),
            holds,
        )
    })
}
