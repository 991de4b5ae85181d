//! `lobes.prove`: the proofs of `specula-stat` for one lobe at one view.
//!
//! * A lobe with a density: chi-square, integral of the density, `weight = f cos / pdf`, values finite, furnace,
//!   reciprocity.
//! * A lobe whose values are estimates: samples against values, integral of the density, energy, reciprocity, by means.
//! * A lobe of Dirac deltas: its samples, energy.
//!
//! Reciprocity is left out where it is not promised: Turquin's factor depends on the view alone, and the model of Wang
//! et al. is one of its own.

mod grid;
mod means;

use serde_json::{Value, json};
use specula_bsdf::bsdf::Lobe;
use specula_bsdf::math::vec3;
use specula_bsdf::{Transport, Vec3};
use specula_lobes::NamedLobe;
use specula_stat::consistency::{self, ConsistencyOptions};
use specula_stat::quadrature::Peak;
use specula_stat::reciprocity::Domain;
use specula_stat::{Check, Plan, Rng, Subject, prove};

use crate::fields::Fields;
use crate::{Answer, AskError};

/// Most samples of a proof; each check takes so many.
const MOST: u32 = 1_000_000;
/// Chance of a false alarm, over all checks.
const SIGNIFICANCE: f64 = 1e-4;
const RADIANCE: Transport = Transport::Radiance;

/// A lobe at a view, with what proofs must know of it.
struct Case<'a> {
    named: &'a NamedLobe,
    wo: Vec3<f64>,
    samples: u32,
    seed: u64,
    /// Index of refraction below the surface; 1 where nothing refracts.
    eta: f64,
    transmits: bool,
    /// Least alpha.
    sharpness: f64,
    reciprocity: Domain,
}

/// Checks, and the grid of the chi-square where there is one.
pub(super) fn prove_lobe(mut fields: Fields) -> Result<Answer, AskError> {
    let named = super::lobe(&mut fields)?;
    let wo = fields.direction("wo")?;
    let samples = fields.count("samples", 100, MOST)?;
    let seed = fields.seed()?;
    fields.end()?;
    let case = Case::new(&named, wo, samples, seed);
    if named.is_specular() {
        return Ok(answer(case.deltas()));
    }
    if named.is_stochastic() {
        return Ok(answer(case.means()));
    }
    let (counts, expected) = case.grid();
    let shape = [grid::ROWS, grid::COLUMNS];
    Ok(answer(case.densities())
        .with_f32("counts", &shape, &counts)
        .with_f32("expected", &shape, &expected))
}

fn answer(checks: Vec<Check>) -> Answer {
    let said = |check: Check| -> Value {
        // The view, which the asker knows, stands behind the name.
        let name = check.name.split(" wo (").next().unwrap_or_default().trim();
        let mut said = json!({"name": name, "holds": check.is_pass, "text": check.detail});
        if let Some(p) = check.p_value {
            said["p"] = json!(p);
        }
        said
    };
    let checks: Vec<Value> = checks.into_iter().map(said).collect();
    Answer::new(json!({ "checks": checks }))
}

impl<'a> Case<'a> {
    fn new(named: &'a NamedLobe, wo: Vec3<f64>, samples: u32, seed: u64) -> Self {
        let transmits = super::describe::transmits(named);
        // Of sheets light goes straight on.
        let is_interface = matches!(named.kind().name, "dielectric" | "multibounce-dielectric");
        let eta = if is_interface {
            number(named, "eta")
        } else {
            None
        };
        let reciprocity = match named.double() {
            _ if word(named, "energy").is_some_and(|e| e.starts_with("turquin"))
                || word(named, "model").is_some_and(|m| m.starts_with("wang")) =>
            {
                Domain::Nowhere
            }
            _ if is_interface => Domain::Everywhere,
            _ => Domain::Above,
        };
        Self {
            named,
            wo,
            samples,
            seed,
            eta: eta.unwrap_or(1.0),
            transmits,
            sharpness: sharpness(named),
            reciprocity,
        }
    }

    fn lobe(&self) -> &Lobe<f64> {
        self.named.double()
    }

    /// A name for each seed: proofs take their random numbers by it.
    fn name(&self) -> String {
        format!("{} {}", self.named, self.seed)
    }

    fn densities(&self) -> Vec<Check> {
        let subject = Subject::from_bsdf(self.lobe(), RADIANCE);
        let plan = Plan {
            samples: self.samples,
            significance: SIGNIFICANCE,
            relative_tolerance: 1e-7,
            eta: self.eta,
            reciprocity: self.reciprocity,
            sharpness: self.sharpness,
            ..Plan::default()
        };
        prove(&self.name(), &subject, &[self.wo], &plan).checks
    }

    fn deltas(&self) -> Vec<Check> {
        let subject = Subject::from_bsdf(self.lobe(), RADIANCE);
        let options = ConsistencyOptions {
            samples: self.samples,
            relative_tolerance: 1e-7,
        };
        let mut rng = Rng::from_name(&self.name());
        vec![
            consistency::samples("", &subject, self.wo, &options, &mut rng),
            self.energy(),
        ]
    }

    /// Where the lobe may be sharp.
    fn peaks(&self) -> Vec<Peak> {
        let width = self.sharpness;
        let wo = self.wo;
        let mut peaks = vec![Peak {
            direction: vec3(-wo.x, -wo.y, wo.z),
            width,
        }];
        if self.transmits || wo.z < 0.0 {
            let direction = -wo;
            peaks.push(Peak { direction, width });
        }
        if self.eta != 1.0 {
            let eta = if wo.z < 0.0 { 1.0 / self.eta } else { self.eta };
            let (x, y) = (-wo.x / eta, -wo.y / eta);
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            let direction = vec3(x, y, if wo.z < 0.0 { z } else { -z }).normalize();
            let width = width * (eta - 1.0).abs().min(1.0);
            peaks.push(Peak { direction, width });
        }
        peaks
    }
}

/// What is given of a parameter, or its default.
fn word<'a>(named: &'a NamedLobe, key: &str) -> Option<&'a str> {
    let given = named.given().find(|(k, _)| *k == key).map(|(_, v)| v);
    given.or_else(|| named.kind().parameter(key)?.default)
}

fn number(named: &NamedLobe, key: &str) -> Option<f64> {
    word(named, key)?.parse().ok()
}

/// The least of the alphas that are given; of kinds by roughness, its square.
fn sharpness(named: &NamedLobe) -> f64 {
    let alphas = ["alpha", "base_alpha"]
        .into_iter()
        .filter_map(|key| word(named, key));
    let values = alphas.flat_map(|value| value.split(',').filter_map(|x| x.parse().ok()));
    let mut least = values.fold(0.3_f64, f64::min);
    let kind = named.kind().name;
    if matches!(kind, "principled" | "gltf") {
        let roughness = number(named, "roughness").unwrap_or(0.5);
        // Anisotropy narrows one alpha; coats have their own.
        least = least.min(0.3 * roughness * roughness);
        if word(named, "clearcoat").is_some_and(|c| c != "0") {
            least = least.min(0.01);
        }
    }
    least.max(1e-4)
}
