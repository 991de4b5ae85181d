//! Goodness of fit: do samples on the sphere follow a density, missing mass included?
//!
//! The sphere is cut at the horizon, at edges that the caller names, and into a grid in theta and
//! phi; then cells are halved until none expects more than its share of the samples, so that a
//! narrow lobe is resolved as well as a wide one. Expected counts are adaptive quadratures.

mod plot;

use std::f64::consts::PI;
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use specula_bsdf::Vec3;
use statrs::function::gamma::{gamma_lr, gamma_ur};

use crate::quadrature::{Patch, Peak, Quadrature, angles};
use crate::report::Check;
use crate::rng::Rng;

/// Options of a chi-square test.
#[derive(Clone, Debug, PartialEq)]
pub struct ChiSquareOptions {
    /// How many samples to take.
    pub samples: u32,
    /// About how many cells hold the samples.
    pub cells: u32,
    /// Where the density is discontinuous besides the horizon, as cosines of the polar angle.
    pub cos_theta_edges: Vec<f64>,
    /// Where the density is sharply peaked.
    pub peaks: Vec<Peak>,
    /// Chance of calling a right sampler wrong. For a suite, see [`sidak`](crate::z_test::sidak).
    pub significance: f64,
}

impl Default for ChiSquareOptions {
    fn default() -> Self {
        Self {
            samples: 100_000,
            cells: 400,
            cos_theta_edges: Vec::new(),
            peaks: Vec::new(),
            significance: 1e-3,
        }
    }
}

/// One cell of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquareCell {
    /// Its part of the sphere.
    pub patch: Patch,
    /// Count expected from the density.
    pub expected: f64,
    /// Estimated error of `expected`.
    pub error: f64,
    /// Count observed.
    pub observed: f64,
}

impl ChiSquareCell {
    /// `(observed - expected) / sqrt(expected)`; one count is the least that is divided by.
    #[must_use]
    pub fn residual(&self) -> f64 {
        (self.observed - self.expected) / self.expected.max(1.0).sqrt()
    }
}

/// The outcome of a chi-square test.
#[derive(Clone, Debug, PartialEq)]
pub struct ChiSquare {
    /// Sum over cells of `(observed - expected)^2 / expected`.
    pub statistic: f64,
    /// Degrees of freedom.
    pub degrees_of_freedom: u32,
    /// Chance of a result at least this bad were the samples right.
    pub p_value: f64,
    /// The significance that `p_value` is compared with.
    pub significance: f64,
    /// How many samples were taken.
    pub samples: u32,
    /// The integral of the density.
    pub integral: f64,
    /// Samples that were rejected.
    pub rejected: u32,
    /// Samples that were not unit vectors.
    pub invalid: u32,
    /// All cells, before pooling.
    pub cells: Vec<ChiSquareCell>,
    /// Whether the expected counts are known well enough for this many samples.
    pub is_converged: bool,
}

/// Takes samples and compares them with a density.
///
/// * `sample`: of three uniform random numbers: a unit direction, or `None` where the sample is rejected.
/// * `pdf`: 1/sr; its integral may fall short of 1 by the share of `None`.
///
/// The fit is tested twice, on the grid and on about thirty groups of neighbouring cells: a fine
/// grid alone is blind to a small bias of a whole region, a coarse one to structure.
///
/// Source: Pearson 1900; cells that expect fewer than five samples are pooled, and where even the
/// pool does, it is tested as a Poisson count (a sample where the density is zero is such a case).
pub fn test(
    mut sample: impl FnMut([f64; 3]) -> Option<Vec3<f64>>,
    pdf: impl Fn(Vec3<f64>) -> f64,
    rng: &mut Rng,
    options: &ChiSquareOptions,
) -> ChiSquare {
    let mut grid = Grid::new(&pdf, options);
    let (mut rejected, mut invalid) = (0, 0);
    for _ in 0..options.samples {
        match sample(rng.triple()) {
            None => rejected += 1,
            Some(w) if (w.length_squared() - 1.0).abs() < 1e-5 => grid.count(w),
            Some(_) => invalid += 1,
        }
    }
    let cells = grid.cells;
    let mass: f64 = cells.iter().map(|c| c.expected).sum();
    let missing = ChiSquareCell {
        patch: Patch::SPHERE,
        expected: (f64::from(options.samples) - mass).max(0.0),
        error: cells.iter().map(|c| c.error).sum(),
        observed: f64::from(rejected),
    };
    let (statistic, degrees_of_freedom, fit, tail) = pearson(&cells, missing);
    let coarse = grouped(&cells, f64::from(options.samples) / COARSE);
    let (.., coarse_fit, _) = pearson(&coarse, missing);
    // Three tests, so each has a third of the chance (Bonferroni).
    let p_value = (3.0 * fit.min(coarse_fit).min(tail)).min(1.0);
    // Errors add to the statistic about (error / sqrt(expected))^2 for each cell.
    let is_converged = cells
        .iter()
        .all(|c| c.error.is_finite() && c.error <= 0.1 * c.expected.max(5.0).sqrt());
    let excess = mass - f64::from(options.samples);
    let is_too_much = excess > missing.error + 1e-6 * f64::from(options.samples);
    let is_wrong = invalid > 0 || is_too_much || !statistic.is_finite() || !mass.is_finite();
    ChiSquare {
        statistic,
        degrees_of_freedom,
        p_value: if is_wrong { 0.0 } else { p_value },
        significance: options.significance,
        samples: options.samples,
        integral: mass / f64::from(options.samples),
        rejected,
        invalid,
        cells,
        is_converged,
    }
}

impl ChiSquare {
    /// Whether the samples agree with the density.
    #[must_use]
    pub fn is_pass(&self) -> bool {
        self.is_converged && self.p_value >= self.significance
    }

    /// Observed, expected and difference as an SVG picture.
    #[must_use]
    pub fn svg(&self, title: &str) -> String {
        plot::svg(title, &self.cells)
    }

    /// Writes the picture into `folder` (made where missing), if the test failed.
    ///
    /// * Returns: where it was written.
    ///
    /// # Errors
    ///
    /// The error of the file system.
    pub fn plot_failure(&self, folder: &Path, name: &str) -> io::Result<Option<PathBuf>> {
        if self.is_pass() {
            return Ok(None);
        }
        let file: String = name
            .chars()
            .map(|c| {
                if c.is_ascii_alphanumeric() || c == '.' || c == '-' {
                    c
                } else {
                    '_'
                }
            })
            .collect();
        fs::create_dir_all(folder)?;
        let path = folder.join(format!("{file}.svg"));
        fs::write(&path, self.svg(name))?;
        Ok(Some(path))
    }

    /// This test as one line of a report.
    #[must_use]
    pub fn check(&self, name: &str) -> Check {
        Check {
            name: format!("chi-square {name}"),
            is_pass: self.is_pass(),
            p_value: Some(self.p_value),
            detail: self.to_string(),
        }
    }
}

impl fmt::Display for ChiSquare {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "p = {:.2e} (chi^2 {:.0} of {} degrees), pdf integrates to {:.5}, {} of {} rejected",
            self.p_value,
            self.statistic,
            self.degrees_of_freedom,
            self.integral,
            self.rejected,
            self.samples
        )?;
        if self.invalid > 0 {
            write!(f, ", {} not unit vectors", self.invalid)?;
        }
        if !self.is_converged {
            write!(f, ", quadrature of the pdf did not converge")?;
        }
        if !self.is_pass() {
            let mut worst: Vec<&ChiSquareCell> = self.cells.iter().collect();
            worst.sort_by(|a, b| b.residual().abs().total_cmp(&a.residual().abs()));
            for cell in worst.into_iter().take(3) {
                let degrees = |range: [f64; 2]| 0.5 * (range[0] + range[1]) * 180.0 / PI;
                write!(
                    f,
                    "; theta {:.1} phi {:.1}: {} for {:.1} +- {:.1}",
                    degrees(cell.patch.theta),
                    degrees(cell.patch.phi),
                    cell.observed,
                    cell.expected,
                    cell.error
                )?;
            }
        }
        Ok(())
    }
}

/// About how many cells the coarse grid has.
const COARSE: f64 = 30.0;

/// Neighbouring cells pooled until each group expects `least`.
fn grouped(cells: &[ChiSquareCell], least: f64) -> Vec<ChiSquareCell> {
    let mut groups: Vec<ChiSquareCell> = Vec::new();
    for cell in cells {
        match groups.last_mut() {
            Some(group) if group.expected < least => {
                group.expected += cell.expected;
                group.error += cell.error;
                group.observed += cell.observed;
            }
            _ => groups.push(*cell),
        }
    }
    groups
}

/// Statistic, degrees of freedom, p-value of the fit, and p-value of the cells that expect
/// nearly nothing.
fn pearson(cells: &[ChiSquareCell], missing: ChiSquareCell) -> (f64, u32, f64, f64) {
    let (mut statistic, mut terms) = (0.0, 0_u32);
    let (mut pool_expected, mut pool_observed, mut pool_error) = (0.0, 0.0, 0.0);
    let mut add = |expected: f64, observed: f64| {
        statistic += (observed - expected) * (observed - expected) / expected;
        terms += 1;
    };
    for cell in cells.iter().chain([&missing]) {
        if cell.expected < 5.0 {
            pool_expected += cell.expected;
            pool_observed += cell.observed;
            pool_error += cell.error;
        } else {
            add(cell.expected, cell.observed);
        }
    }
    let mut tail = 1.0;
    if pool_expected >= 5.0 {
        add(pool_expected, pool_observed);
    } else {
        tail = poisson_tail(pool_observed, pool_expected, pool_error);
    }
    let degrees = terms.saturating_sub(1);
    let fit = if degrees == 0 {
        1.0
    } else if statistic.is_finite() {
        gamma_ur(0.5 * f64::from(degrees), 0.5 * statistic.max(1e-300))
    } else {
        0.0
    };
    (statistic, degrees, fit, tail)
}

/// Chance of a Poisson count this far out, where the mean is known within `error`.
pub(crate) fn poisson_tail(observed: f64, expected: f64, error: f64) -> f64 {
    let high = expected + error;
    let low = (expected - error).max(0.0);
    let at_least = if observed < 0.5 {
        1.0
    } else if high <= 0.0 {
        0.0
    } else {
        gamma_lr(observed, high)
    };
    let at_most = if low <= 0.0 {
        1.0
    } else {
        gamma_ur(observed + 1.0, low)
    };
    at_least.min(at_most)
}

/// The cells, and a tree that maps a direction to its cell.
struct Grid {
    /// Edges of the rows, in theta.
    rows: Vec<f64>,
    /// Nodes; the first `rows x COLUMNS` are the roots.
    nodes: Vec<Node>,
    cells: Vec<ChiSquareCell>,
}

enum Node {
    Leaf(usize),
    Split {
        axis: usize,
        at: f64,
        halves: [usize; 2],
    },
}

impl Grid {
    const COLUMNS: u32 = 16;

    fn new(pdf: &impl Fn(Vec3<f64>) -> f64, options: &ChiSquareOptions) -> Self {
        let samples = f64::from(options.samples);
        let quadrature = Quadrature {
            relative_tolerance: 1e-4,
            absolute_tolerance: 2e-3 / samples,
            max_patches: 1000,
            peaks: options.peaks.clone(),
            ..Quadrature::default()
        };
        let rows = rows(&options.cos_theta_edges);
        let mut grid = Self {
            rows,
            nodes: Vec::new(),
            cells: Vec::new(),
        };
        let mut pending = Vec::new();
        let width = 2.0 * PI / f64::from(Self::COLUMNS);
        for row in grid.rows.windows(2) {
            for column in 0..Self::COLUMNS {
                let phi = f64::from(column) * width;
                let patch = Patch {
                    theta: [row[0], row[1]],
                    phi: [phi, phi + width],
                };
                grid.nodes.push(Node::Leaf(0));
                pending.push((grid.nodes.len() - 1, patch, 0));
            }
        }
        let most = samples / f64::from(options.cells.max(1));
        while let Some((node, patch, depth)) = pending.pop() {
            let integral = quadrature.integrate(patch, |w| [pdf(w)]);
            let expected = integral.value[0] * samples;
            if expected > most && depth < 40 {
                let (halves, axis, at) = patch.bisect();
                let first = grid.nodes.len();
                for (k, half) in halves.into_iter().enumerate() {
                    grid.nodes.push(Node::Leaf(0));
                    pending.push((first + k, half, depth + 1));
                }
                grid.nodes[node] = Node::Split {
                    axis,
                    at,
                    halves: [first, first + 1],
                };
            } else {
                grid.nodes[node] = Node::Leaf(grid.cells.len());
                grid.cells.push(ChiSquareCell {
                    patch,
                    expected,
                    error: integral.error * samples,
                    observed: 0.0,
                });
            }
        }
        grid
    }

    fn count(&mut self, w: Vec3<f64>) {
        let (theta, phi) = angles(w);
        let row = self.rows.partition_point(|&edge| edge <= theta).max(1) - 1;
        let row = row.min(self.rows.len() - 2);
        let columns = Self::COLUMNS as usize;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the floor of a number in [0, 16]"
        )]
        let column = (phi / (2.0 * PI) * f64::from(Self::COLUMNS)) as usize;
        let mut node = row * columns + column.min(columns - 1);
        loop {
            match self.nodes[node] {
                Node::Leaf(cell) => {
                    self.cells[cell].observed += 1.0;
                    return;
                }
                Node::Split { axis, at, halves } => {
                    let place = if axis == 0 { theta } else { phi };
                    node = halves[usize::from(place >= at)];
                }
            }
        }
    }
}

/// Edges in theta: poles, eight equal steps, the horizon among them, and the caller's.
fn rows(cos_theta_edges: &[f64]) -> Vec<f64> {
    let mut rows: Vec<f64> = (0..=8).map(|k| PI * f64::from(k) / 8.0).collect();
    rows.extend(
        cos_theta_edges
            .iter()
            .filter(|c| c.abs() < 1.0)
            .map(|c| c.acos()),
    );
    rows.sort_by(f64::total_cmp);
    rows.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::direction;

    fn cosine_sample(u: [f64; 3]) -> Option<Vec3<f64>> {
        Some(direction((1.0 - u[1]).sqrt(), 2.0 * PI * u[2]))
    }

    #[test]
    fn right_samples_pass_and_p_is_uniform() {
        let mut low = 0;
        for seed in 100..220 {
            let options = ChiSquareOptions {
                samples: 20_000,
                cells: 100,
                ..ChiSquareOptions::default()
            };
            let found = test(
                cosine_sample,
                |w| w.z.max(0.0) / PI,
                &mut Rng::new(seed),
                &options,
            );
            assert!(found.is_pass(), "{found}");
            low += u32::from(found.p_value < 0.25);
        }
        // Bonferroni's p-values are no smaller than uniform ones, and not much larger.
        assert!((8..=42).contains(&low), "{low} of 120");
    }

    #[test]
    fn one_per_cent_too_many_upwards_fails() {
        let found = test(
            |u| {
                if u[0] < 0.01 {
                    Some(direction(1.0 - 0.05 * u[1], 2.0 * PI * u[2]))
                } else {
                    cosine_sample(u)
                }
            },
            |w| w.z.max(0.0) / PI,
            &mut Rng::new(3),
            &ChiSquareOptions::default(),
        );
        assert!(!found.is_pass(), "{found}");
    }

    #[test]
    fn one_sample_where_the_density_is_zero_fails() {
        let mut first = true;
        let found = test(
            |u| {
                let w = cosine_sample(u)?;
                let sign = if std::mem::take(&mut first) {
                    -1.0
                } else {
                    1.0
                };
                Some(direction(sign * w.z, 1.0 + u[2]))
            },
            |w| w.z.max(0.0) / PI,
            &mut Rng::new(3),
            &ChiSquareOptions::default(),
        );
        assert!(!found.is_pass(), "{found}");
    }

    #[test]
    fn rejections_that_the_pdf_omits_fail_and_are_plotted() {
        let found = test(
            |u| if u[0] < 0.01 { None } else { cosine_sample(u) },
            |w| w.z.max(0.0) / PI,
            &mut Rng::new(4),
            &ChiSquareOptions::default(),
        );
        assert!(!found.is_pass(), "{found}");
        let svg = found.svg("a < b");
        assert_eq!(svg.matches("<rect").count(), 3 * found.cells.len() + 1);
        assert!(svg.contains("a &lt; b"));
    }

    #[test]
    fn poisson_tails() {
        assert!((poisson_tail(1.0, 0.1, 0.0) - (1.0 - f64::exp(-0.1))).abs() < 1e-12);
        assert!((poisson_tail(0.0, 3.0, 0.0) - f64::exp(-3.0)).abs() < 1e-12);
        assert_eq!(poisson_tail(1.0, 0.0, 0.0), 0.0);
        assert_eq!(poisson_tail(0.0, 0.0, 0.0), 1.0);
    }

    #[test]
    fn gamma_has_the_tabulated_chi_square_quantiles() {
        // Upper 5 % points (Abramowitz and Stegun, table 26.8).
        for (degrees, point) in [(1.0, 3.841_46), (10.0, 18.3070), (100.0, 124.342)] {
            let p = gamma_ur(0.5 * degrees, 0.5 * point);
            assert!((p - 0.05).abs() < 1e-6, "{degrees}: {p}");
        }
        // Wilson and Hilferty's approximation where tables end.
        let (k, x) = (600.0_f64, 700.0_f64);
        let z = ((x / k).cbrt() - (1.0 - 2.0 / (9.0 * k))) / (2.0 / (9.0 * k)).sqrt();
        let approximate = 0.5 * crate::z_test::two_sided_p(z);
        assert!((gamma_ur(0.5 * k, 0.5 * x) / approximate - 1.0).abs() < 0.02);
    }
}
