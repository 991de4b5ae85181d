//! What came out of the renders, and how two renderers compare.

use std::rc::Rc;

use specula_bsdf::Rgb;

use super::block::Block;
use super::flip::Flip;
use super::metals::Metals;
use super::reference::Reference;
use super::scenes::Scene;
use super::statistics::{Errors, Metric, equal_error_ratio, median};

/// Most that an error from pairs of seeds may differ from that against the reference, as a share,
/// without a mark.
pub(crate) const AGREEMENT: f64 = 0.05;
/// Most that it may differ at all.
const LEAST_AGREEMENT: f64 = 0.25;

/// Whom a renderer is compared with.
#[derive(Clone, Copy)]
pub(crate) struct Pair {
    /// The form of the scene that Specula reads, as in [`Row::form`].
    pub(crate) specula: &'static str,
    /// Most that the means of the references may differ by, as a share.
    pub(crate) tolerance: f64,
}

/// One render of a round.
#[derive(Clone)]
pub(crate) struct Render {
    /// As the clock of the plan says.
    pub(crate) seconds: f64,
    pub(crate) wall: f64,
    pub(crate) cpu: f64,
    /// Against the reference, less its errors.
    pub(crate) errors: Errors,
}

/// The renders of a round and of the next.
#[derive(Clone)]
pub(crate) struct SeedPair {
    /// The mean of both.
    pub(crate) seconds: f64,
    /// Of one of them, as their difference tells it.
    pub(crate) errors: Errors,
}

/// What came out for one renderer.
pub(crate) struct Row {
    /// The form, and what of Specula it is.
    pub(crate) name: String,
    /// The renderer, of Specula with the format that it reads.
    pub(crate) form: &'static str,
    /// Of Specula: which block it is in.
    pub(crate) block: Option<Block>,
    pub(crate) version: String,
    pub(crate) against: Option<Pair>,
    pub(crate) sampler: &'static str,
    /// As the sampler took them, which may be more than it was asked for.
    pub(crate) spp: u32,
    pub(crate) pixels: usize,
    pub(crate) reference_spp: u32,
    pub(crate) reference_mean: f64,
    pub(crate) warm_up: f64,
    /// The row whose pictures are the same bit for bit, so that its renders stand for those of this one.
    pub(crate) same_as: Option<usize>,
    pub(crate) renders: Vec<Render>,
    /// One fewer than the renders.
    pub(crate) pairs: Vec<SeedPair>,
    /// Of the first round, against the reference of the other of the pair.
    pub(crate) rmse_of_other: Option<f64>,
    /// The exponent of the error's fall, to four times the samples.
    pub(crate) rate: f64,
    /// Of the first round.
    pub(crate) flip: Option<Flip>,
    /// Why the comparison does not hold.
    pub(crate) fault: Option<String>,
}

/// A scene's rows and pictures.
pub(crate) struct Outcome {
    pub(crate) scene: Scene,
    pub(crate) rows: Vec<Row>,
    /// One for each row; those of Specula with one form of the scene have it in common.
    pub(crate) references: Vec<Rc<Reference>>,
    /// The pictures of the first round, one for each row.
    pub(crate) first: Vec<Vec<Rgb<f32>>>,
}

/// What an error is measured with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    References,
    Pairs,
}

impl Row {
    /// Seconds and squared error of each round, or of each pair of rounds.
    fn points(&self, metric: Metric, source: Source) -> Vec<(f64, f64)> {
        let of_round = |r: &Render| (r.seconds, r.errors.get(metric));
        let of_pair = |p: &SeedPair| (p.seconds, p.errors.get(metric));
        match source {
            Source::References => self.renders.iter().map(of_round).collect(),
            Source::Pairs => self.pairs.iter().map(of_pair).collect(),
        }
    }

    /// The median over the rounds, or over pairs of them, of a squared error.
    pub(crate) fn squared_error(&self, metric: Metric, source: Source) -> f64 {
        let points = self.points(metric, source);
        median(&points.iter().map(|p| p.1).collect::<Vec<_>>())
    }

    /// The error from pairs of seeds over that against the reference, root mean square of the same renders:
    /// 1 where seeds are independent and the reference is of the same estimator.
    pub(crate) fn agreement(&self, metric: Metric) -> f64 {
        let squares = self.points(metric, Source::References);
        let of_rounds: f64 = squares.windows(2).map(|p| 0.5 * (p[0].1 + p[1].1)).sum();
        let of_pairs: f64 = self.points(metric, Source::Pairs).iter().map(|p| p.1).sum();
        (of_pairs / of_rounds).sqrt()
    }

    /// The metrics in which pairs of seeds and the reference disagree.
    pub(crate) fn disagreements(&self) -> Vec<Metric> {
        self.apart_by(AGREEMENT)
    }

    /// A fault where pairs of seeds and the reference disagree by more than noise of the errors explains.
    pub(crate) fn check_agreement(&mut self) {
        if let Some(&metric) = self.apart_by(LEAST_AGREEMENT).first() {
            let what = format!(
                "{}: {} from pairs of seeds is {:.2} times that against the reference",
                self.name,
                metric.name(),
                self.agreement(metric)
            );
            self.fault.get_or_insert(what);
        }
    }

    fn apart_by(&self, share: f64) -> Vec<Metric> {
        // A quotient that is not a number is off, too.
        let agree = |metric: &Metric| (self.agreement(*metric) - 1.0).abs() <= share;
        let metrics = [Metric::Rmse, Metric::BlockRmse];
        metrics.into_iter().filter(|m| !agree(m)).collect()
    }

    /// The median over the rounds.
    pub(crate) fn over_rounds(&self, of: impl Fn(&Render) -> f64) -> f64 {
        median(&self.renders.iter().map(of).collect::<Vec<_>>())
    }

    /// The mean over the rounds.
    pub(crate) fn mean_over_rounds(&self, of: impl Fn(&Render) -> f64) -> f64 {
        self.renders.iter().map(of).sum::<f64>() / self.renders.len() as f64
    }

    /// Samples a second of all pixels together.
    pub(crate) fn samples_per_second(&self) -> f64 {
        self.pixels as f64 * f64::from(self.spp) / self.over_rounds(|r| r.seconds)
    }
}

impl Outcome {
    /// A block's pairs, Specula first.
    pub(crate) fn pairs(&self, block: Block) -> impl Iterator<Item = (&Row, &Row)> {
        self.rows.iter().filter_map(move |theirs| {
            let form = theirs.against?.specula;
            let in_block = |r: &&Row| r.form == form && r.block == Some(block);
            Some((self.rows.iter().find(in_block)?, theirs))
        })
    }

    /// Whether the report shows its pictures: not those of the same scene in other metals.
    pub(crate) fn is_shown(&self) -> bool {
        self.scene.metals == Metals::Own
    }

    /// What is wrong with any row.
    pub(crate) fn faults(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().filter_map(|row| row.fault.as_deref())
    }
}

/// Our time over theirs to an equal error, round by round, or pair by pair of rounds.
pub(crate) fn ratios(specula: &Row, theirs: &Row, metric: Metric, source: Source) -> Vec<f64> {
    let theirs = theirs.points(metric, source);
    let rounds = specula.points(metric, source).into_iter().zip(theirs);
    rounds.map(|(a, b)| equal_error_ratio(a, b)).collect()
}

/// The median of [`ratios`].
pub(crate) fn time_to_equal(specula: &Row, theirs: &Row, metric: Metric, source: Source) -> f64 {
    median(&ratios(specula, theirs, metric, source))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A row of errors that fit each other, all squares the same.
    pub(crate) fn row(name: &str, block: Option<Block>, seconds: &[f64], mse: f64) -> Row {
        let errors = Errors {
            mse,
            block_mse: 2.0 * mse,
            trimmed_mse: 0.5 * mse,
            rel_mse: mse,
        };
        let render = |&seconds: &f64| Render {
            seconds,
            wall: seconds,
            cpu: 2.0 * seconds,
            errors,
        };
        let pair = |s: &[f64]| SeedPair {
            seconds: 0.5 * (s[0] + s[1]),
            errors,
        };
        Row {
            name: name.to_owned(),
            form: if block.is_some() { "specula" } else { "peer" },
            block,
            version: format!("{name} 1"),
            against: block.is_none().then_some(Pair {
                specula: "specula",
                tolerance: 0.005,
            }),
            sampler: "s",
            spp: 16,
            pixels: 4_000_000,
            reference_spp: 256,
            reference_mean: 1.0,
            warm_up: 0.0,
            same_as: None,
            renders: seconds.iter().map(render).collect(),
            pairs: seconds.windows(2).map(pair).collect(),
            rmse_of_other: None,
            rate: 0.5,
            flip: None,
            fault: None,
        }
    }

    #[test]
    fn agreement_compares_the_same_renders() {
        let mut row = row("any", None, &[1.0; 3], 0.01);
        assert!((row.agreement(Metric::Rmse) - 1.0).abs() < 1e-12);
        // A firefly in the second round is in both pairs.
        row.renders[1].errors.mse = 0.09;
        row.pairs.iter_mut().for_each(|p| p.errors.mse = 0.05);
        assert!((row.agreement(Metric::Rmse) - 1.0).abs() < 1e-12);
        assert_eq!(row.disagreements(), []);
    }

    #[test]
    fn a_disagreement_is_noted_and_a_large_one_is_a_fault() {
        for (quotient, noted, faulty) in [
            (0.96, false, false),
            (1.06, true, false),
            (0.94, true, false),
            (1.3, true, true),
            (0.7, true, true),
            (f64::NAN, true, true),
        ] {
            let mut row = row("any", None, &[1.0; 3], 0.01);
            for pair in &mut row.pairs {
                pair.errors.block_mse *= quotient * quotient;
            }
            row.check_agreement();
            let noted_metrics = if noted {
                vec![Metric::BlockRmse]
            } else {
                vec![]
            };
            assert_eq!(row.disagreements(), noted_metrics, "{quotient}");
            assert_eq!(row.fault.is_some(), faulty, "{quotient}: {:?}", row.fault);
        }
    }

    #[test]
    fn the_time_to_equal_error_is_the_median_of_rounds_or_of_pairs() {
        let specula = row("a", Some(Block::Defaults), &[1.0, 2.0, 9.0], 0.01);
        let theirs = row("b", None, &[2.0, 2.0, 2.0], 0.02);
        let of = |source| time_to_equal(&specula, &theirs, Metric::BlockRmse, source);
        assert_eq!(of(Source::References), 0.5);
        // Of 1.5 and 5.5 seconds to 2.
        assert_eq!(of(Source::Pairs), 0.5 * (0.375 + 1.375));
    }
}
