//! `samplers.regions`: outlines of where samplers put their reflections.
//!
//! In the stretched space reflections `o` of the stretched view `i` are uniform over a part of the sphere:
//!
//! ```text
//! cap          z > -i.z: all visible normals (half vectors above the horizon)
//! bounded_cap  z > -k i.z
//! exact        the image of {wi.z > 0}: o = reflect(i, m) for m on the edge of the cone of valid half vectors
//! ```
//!
//! For views below the horizon every visible normal reflects upwards, and all three are the cap. On the sphere of `wi`
//! a point `o` of an outline becomes the reflection of `wo` off the normal along `A (i + o)`, `A = diag(ax, ay, 1)`.
//! The edge of `exact` becomes the horizon.

use std::f64::consts::TAU;

use serde_json::json;
use specula_bsdf::Vec3;
use specula_bsdf::math::{Real, vec3};
use specula_bsdf::vndf::reflect;

use super::Surface;
use crate::fields::Fields;
use crate::{Answer, AskError};

/// Most points of an outline.
const LONGEST: u32 = 4096;

/// The outlines; the last point of each is the first.
pub(super) fn regions(mut fields: Fields) -> Result<Answer, AskError> {
    let surface = Surface::of(&mut fields)?;
    let count = fields.count("count", 4, LONGEST)?;
    fields.end()?;

    let z = surface.stretched().z;
    let (_, _, k) = surface.bound();
    let azimuths: Vec<f64> = (0..count)
        .map(|i| TAU * f64::from(i % (count - 1)) / f64::from(count - 1))
        .collect();
    let circle = |z: f64| -> Vec<Vec3<f64>> { azimuths.iter().map(|phi| at(z, *phi)).collect() };
    let (cap, bounded) = (circle(-z), circle(-k * z));
    let exact = match surface.cone() {
        Some(cone) => {
            let edge = |phi: &f64| reflect(surface.stretched(), cone.edge(*phi));
            azimuths.iter().map(edge).collect()
        }
        None => cap.clone(),
    };
    let taken = |outline: &[Vec3<f64>]| -> Vec<Vec3<f64>> {
        let map = |o: &Vec3<f64>| surface.surface_reflection(*o);
        outline.iter().map(map).collect()
    };
    let mut answer = Answer::new(json!({}));
    for (name, outline) in [
        ("cap_wi", taken(&cap)),
        ("bounded_cap_wi", taken(&bounded)),
        ("exact_wi", taken(&exact)),
        ("cap", cap),
        ("bounded_cap", bounded),
        ("exact", exact),
        ("horizon", circle(0.0)),
    ] {
        let values: Vec<f32> = outline
            .iter()
            .flat_map(|w| w.to_array().map(f32::of))
            .collect();
        answer = answer.with_f32(name, &[outline.len(), 3], &values);
    }
    Ok(answer)
}

fn at(z: f64, phi: f64) -> Vec3<f64> {
    let z = z.clamp(-1.0, 1.0);
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    let (sin, cos) = phi.sin_cos();
    vec3(r * cos, r * sin, z)
}
