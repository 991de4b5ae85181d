//! Puts a BSDF of one's own, given by three closures, through every check and prints the report:
//! a Phong lobe, once right and once with the usual mistake.
//!
//! `cargo run --release --example prove_your_bsdf`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::PI;
use std::path::PathBuf;

use specula_bsdf::math::vec3;
use specula_bsdf::{Frame, Rgb, Vec3};
use specula_stat::quadrature::direction;
use specula_stat::{DirectionSample, Plan, Report, Subject, prove};

const EXPONENT: f64 = 30.0;
const ALBEDO: f64 = 0.8;

fn mirrored(w: Vec3<f64>) -> Vec3<f64> {
    vec3(-w.x, -w.y, w.z)
}

/// Cosine between `wi` and the mirror direction; 0 below the horizon.
fn lobe_cosine(wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    if wi.z > 0.0 {
        mirrored(wo).dot(wi).max(0.0)
    } else {
        0.0
    }
}

/// `f |cos theta_i|` of the normalised Phong lobe (Lafortune and Willems 1994).
fn eval(wo: Vec3<f64>, wi: Vec3<f64>) -> Rgb<f64> {
    let f = ALBEDO * (EXPONENT + 2.0) / (2.0 * PI) * lobe_cosine(wo, wi).powf(EXPONENT);
    Rgb::splat(f * wi.z.max(0.0))
}

/// Density of `sample`; its missing mass is what falls below the horizon.
fn pdf(wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    (EXPONENT + 1.0) / (2.0 * PI) * lobe_cosine(wo, wi).powf(EXPONENT)
}

/// The density as often mistyped: normalised for `cos^n cos`, not `cos^n`.
fn mistyped_pdf(wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
    (EXPONENT + 2.0) / (2.0 * PI) * lobe_cosine(wo, wi).powf(EXPONENT)
}

fn sample(wo: Vec3<f64>, u: [f64; 3]) -> Option<DirectionSample> {
    let cosine = (1.0 - u[1]).powf(1.0 / (EXPONENT + 1.0));
    let local = direction(cosine, 2.0 * PI * u[2]);
    let wi = Frame::from_normal(mirrored(wo)).to_world(local);
    if wi.z <= 0.0 {
        return None;
    }
    let weight = ALBEDO * (EXPONENT + 2.0) / (EXPONENT + 1.0) * wi.z;
    Some(DirectionSample::new(wi, Rgb::splat(weight)))
}

/// Checks from five views; plots of what fails go to the folder for temporary files.
fn report(name: &str, subject: &Subject) -> Report {
    let views = [1.0, 0.7, 0.3, 0.05, 0.005].map(|cos_theta| direction(cos_theta, 0.3));
    let plan = Plan {
        sharpness: 0.2,
        plot_folder: Some(plot_folder()),
        ..Plan::default()
    };
    prove(name, subject, &views, &plan)
}

fn plot_folder() -> PathBuf {
    std::env::temp_dir().join("prove_your_bsdf")
}

fn main() {
    let right = Subject::new(eval, pdf, sample);
    println!("{}", report("Phong", &right));
    let wrong = Subject::new(eval, mistyped_pdf, sample);
    println!("{}", report("Phong with a mistyped pdf", &wrong));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_right_lobe_passes_and_the_mistyped_one_does_not() {
        assert!(report("Phong", &Subject::new(eval, pdf, sample)).is_pass());
        assert!(!report("Phong", &Subject::new(eval, mistyped_pdf, sample)).is_pass());
    }
}
