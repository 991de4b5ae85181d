//! All checks of one BSDF over a list of views.

use std::path::PathBuf;

use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Transport, Vec3};

use crate::chi_square::ChiSquareOptions;
use crate::consistency::ConsistencyOptions;
use crate::quadrature::{Peak, Quadrature};
use crate::reciprocity::ReciprocityOptions;
use crate::report::Report;
use crate::rng::Rng;
use crate::subject::Subject;
use crate::z_test::sidak;
use crate::{chi_square, consistency, furnace, normalisation, reciprocity};

/// Options of [`prove`].
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Samples for each check of each view.
    pub samples: u32,
    /// Cells of the chi-square test.
    pub cells: u32,
    /// Chance of a false alarm over the whole report, or over all of `tests`.
    pub significance: f64,
    /// How many statistical tests share `significance`; `None`: those of this report.
    pub tests: Option<usize>,
    /// Largest relative difference where values should be equal: 1e-9 suits `f64`.
    pub relative_tolerance: f64,
    /// Index of refraction below the surface (z < 0) over that above it; 1 where nothing refracts.
    pub eta: f64,
    /// Whether `eval` transports radiance or importance.
    pub transport: Transport,
    /// For which directions reciprocity is required.
    pub reciprocity: reciprocity::Domain,
    /// Angular width of the sharpest lobe, radians, such as alpha: quadrature starts this fine about
    /// the mirror direction and about the directions of straight and refracted transmission.
    pub sharpness: f64,
    /// Where the pdf has steps, besides those of half vectors at the horizon: cosines of polar angles.
    pub cos_theta_edges: Vec<f64>,
    /// Folder for plots of failed chi-square tests, if they are to be written.
    pub plot_folder: Option<PathBuf>,
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            samples: 100_000,
            cells: 400,
            significance: 0.01,
            tests: None,
            relative_tolerance: 1e-9,
            eta: 1.0,
            transport: Transport::Radiance,
            reciprocity: reciprocity::Domain::default(),
            sharpness: 0.1,
            cos_theta_edges: Vec::new(),
            plot_folder: None,
        }
    }
}

impl Plan {
    /// Statistical tests for each view: chi-square, normalisation, furnace.
    pub const TESTS_PER_VIEW: usize = 3;
}

/// Runs every check of `subject` for each of the views `wo`.
///
/// * `views`: unit directions, local frame; below the horizon too, where the subject supports it.
/// * Returns: one line for each check and view; plots of failed chi-square tests are in
///   `plan.plot_folder`.
#[must_use]
pub fn prove(name: &str, subject: &Subject, views: &[Vec3<f64>], plan: &Plan) -> Report {
    let mut report = Report::new(name);
    let tests = plan.tests.unwrap_or(Plan::TESTS_PER_VIEW * views.len());
    let significance = sidak(plan.significance, tests);
    for &wo in views {
        let view = format!("wo ({:.3}, {:.3}, {:.3})", wo.x, wo.y, wo.z);
        prove_view(&mut report, &view, subject, wo, significance, plan);
    }
    if plan.reciprocity != reciprocity::Domain::Nowhere {
        let options = ReciprocityOptions {
            relative_tolerance: plan.relative_tolerance,
            domain: plan.reciprocity,
            eta: plan.eta,
            transport: plan.transport,
            ..ReciprocityOptions::default()
        };
        let mut rng = Rng::from_name(&format!("{name} reciprocity"));
        report
            .checks
            .push(reciprocity::test("", subject, &options, &mut rng));
    }
    report
}

fn prove_view(
    report: &mut Report,
    view: &str,
    subject: &Subject,
    wo: Vec3<f64>,
    significance: f64,
    plan: &Plan,
) {
    let name = report.subject.clone();
    let mut rng = Rng::from_name(&format!("{name} {view}"));
    let mut edges = plan.cos_theta_edges.clone();
    // Where the half vector of reflection, and that of refraction, crosses the horizon.
    edges.extend([1.0, plan.eta, 1.0 / plan.eta].map(|e| wo.z * e));
    edges.extend([1.0, plan.eta, 1.0 / plan.eta].map(|e| -wo.z * e));
    let peaks = peaks(wo, plan);
    let quadrature = Quadrature {
        relative_tolerance: 1e-5,
        absolute_tolerance: 1e-7,
        peaks: peaks.clone(),
        ..Quadrature::default()
    };
    let fit = chi_square::test(
        |u| subject.sample_density(wo, u).map(|sampled| sampled.wi),
        |wi| subject.pdf(wo, wi),
        &mut rng,
        &ChiSquareOptions {
            samples: plan.samples,
            cells: plan.cells,
            cos_theta_edges: edges.clone(),
            peaks,
            significance,
        },
    );
    let mut check = fit.check(view);
    if let Some(folder) = &plan.plot_folder {
        match fit.plot_failure(folder, &format!("{name} {view}")) {
            Ok(None) => {}
            Ok(Some(path)) => check.detail += &format!("; plot: {}", path.display()),
            Err(error) => check.detail += &format!("; no plot: {error}"),
        }
    }
    report.checks.push(check);
    // The pdf and the three channels of f cos are integrated together.
    let all = normalisation::integrate_bands(&edges, &quadrature, |wi| {
        let (Rgb { r, g, b }, pdf) = subject.eval_pdf(wo, wi);
        [pdf, r, g, b]
    });
    let [mass, r, g, b] = all.value;
    let integral = all.with_value([mass]);
    let albedo = all.with_value([r, g, b]);
    report.checks.push(normalisation::test(
        view,
        subject,
        wo,
        &integral,
        plan.samples,
        significance,
        &mut rng,
    ));
    let at = ConsistencyOptions {
        samples: plan.samples / 10,
        relative_tolerance: plan.relative_tolerance,
    };
    report
        .checks
        .push(consistency::samples(view, subject, wo, &at, &mut rng));
    report
        .checks
        .push(consistency::directions(view, subject, wo, &at, &mut rng));
    report.checks.push(furnace::test(
        view,
        subject,
        wo,
        &albedo,
        plan.samples,
        significance,
        &mut rng,
    ));
}

/// Where microfacet lobes are sharp: about the mirror direction, the direction of straight transmission
/// and the refracted direction.
fn peaks(wo: Vec3<f64>, plan: &Plan) -> Vec<Peak> {
    let width = plan.sharpness;
    let mut peaks = vec![Peak {
        direction: vec3(-wo.x, -wo.y, wo.z),
        width,
    }];
    if wo.z < 0.0 {
        // Only the steepest facets are visible from below. They are nearly edge on, so light goes
        // nearly straight on; the normals themselves are those at a right angle to the view.
        let steepest = vec3(-wo.x * wo.z, -wo.y * wo.z, 1.0 - wo.z * wo.z).normalize();
        for direction in [-wo, steepest] {
            let width = 0.1 * width;
            peaks.push(Peak { direction, width });
        }
    }
    if plan.eta != 1.0 {
        let eta = if wo.z < 0.0 { 1.0 / plan.eta } else { plan.eta };
        // A lobe of refracted rays is narrower, by the bend, than one of reflected rays.
        let width = width * (eta - 1.0).abs().min(1.0);
        let (x, y) = (-wo.x / eta, -wo.y / eta);
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let refracted = vec3(x, y, if wo.z < 0.0 { z } else { -z });
        for direction in [refracted.normalize(), -wo] {
            peaks.push(Peak { direction, width });
        }
    }
    peaks
}
