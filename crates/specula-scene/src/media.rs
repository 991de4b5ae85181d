//! Measured scattering media by name, and the warning about media that are not simulated.

use specula_bsdf::Rgb;

use crate::num::f32_of;

/// Reduced scattering and absorption per millimetre. Source: Jensen et al. 2001, figure 5.
pub(crate) const MEDIA: [(&str, [f64; 3], [f64; 3]); 12] = [
    ("Apple", [2.29, 2.39, 1.97], [0.0030, 0.0034, 0.046]),
    ("Chicken1", [0.15, 0.21, 0.38], [0.015, 0.077, 0.19]),
    ("Chicken2", [0.19, 0.25, 0.32], [0.018, 0.088, 0.20]),
    ("Cream", [7.38, 5.47, 3.15], [0.0002, 0.0028, 0.0163]),
    ("Ketchup", [0.18, 0.07, 0.03], [0.061, 0.97, 1.45]),
    ("Marble", [2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071]),
    ("Potato", [0.68, 0.70, 0.55], [0.0024, 0.0090, 0.12]),
    ("Skimmilk", [0.70, 1.22, 1.90], [0.0014, 0.0025, 0.0142]),
    ("Skin1", [0.74, 0.88, 1.01], [0.032, 0.17, 0.48]),
    ("Skin2", [1.09, 1.59, 1.79], [0.013, 0.070, 0.145]),
    ("Spectralon", [11.6, 20.4, 14.9], [0.0, 0.0, 0.0]),
    ("Wholemilk", [2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014]),
];

/// Coefficients of absorption and of scattering.
pub(crate) type Coefficients = (Rgb<f32>, Rgb<f32>);

/// Absorption and reduced scattering of a medium of [`MEDIA`], whatever its capitals.
pub(crate) fn named(name: &str) -> Option<Coefficients> {
    let find = |m: &&(&str, _, _)| m.0.eq_ignore_ascii_case(name);
    let (_, scattering, absorption) = MEDIA.iter().find(find)?;
    let rgb = |c: &[f64; 3]| {
        let [r, g, b] = c.map(f32_of);
        Rgb { r, g, b }
    };
    Some((rgb(absorption), rgb(scattering)))
}

/// A homogeneous medium, per scene unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Homogeneous {
    /// Coefficient of absorption.
    pub(crate) absorption: Rgb<f32>,
    /// Coefficient of scattering times `1 - g`, `g` the mean cosine.
    pub(crate) reduced_scattering: Rgb<f32>,
}

impl Homogeneous {
    /// What is left out of it, as a warning.
    ///
    /// Absorption alone is simulated: light that would be scattered goes straight on, as if `g`
    /// were 1. The reduced coefficient says how far that is from the truth: its inverse is the
    /// distance after which light has forgotten its direction.
    pub(crate) fn left_out(&self, title: &str) -> Option<String> {
        let [r, g, b] = self.reduced_scattering.to_array();
        (r.max(g).max(b) > 0.0).then(|| {
            format!(
                "{title} absorbs but does not scatter here: what it would scatter goes straight \
                 on (reduced coefficient {r}, {g}, {b} per unit)"
            )
        })
    }
}
