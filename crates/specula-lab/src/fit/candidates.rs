//! Lobes that are fitted: their parameters as numbers without bounds of their own.

use specula_lobes::{Argument, NamedLobe, Value};

use super::FitOptions;

/// A distribution of normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// Trowbridge and Reitz.
    Ggx,
    /// Beckmann and Spizzichino.
    Beckmann,
}

/// What becomes of light that facets reflect onto facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounces {
    /// It is lost.
    Single,
    /// It is made up for (Kulla and Conty 2017).
    Compensated,
    /// It is followed by random walks.
    All,
}

/// The reflectance of a facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FresnelModel {
    /// Index of refraction `eta + i k` per channel.
    Index,
    /// Reflectance along the normal and the tint at 82 degrees per channel.
    F82,
}

/// A lobe without its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Candidate {
    pub(super) distribution: Distribution,
    pub(super) bounces: Bounces,
    pub(super) fresnel: FresnelModel,
    pub(super) is_isotropic: bool,
}

/// Smallest and largest alpha.
const ALPHA: [f64; 2] = [1e-3, 1.0];
/// Of the real part of the index.
const ETA: [f64; 2] = [0.01, 12.0];
/// Of the imaginary part.
const K: [f64; 2] = [0.0, 20.0];

impl Candidate {
    /// From simple to costly, in whatever order the options name them.
    pub(super) fn all(options: &FitOptions<'_>) -> Vec<Self> {
        let is_isotropic = options.tables.is_isotropic();
        let mut all = Vec::new();
        for &bounces in options.bounces {
            for &fresnel in options.fresnel {
                for &distribution in options.distributions {
                    all.push(Self {
                        distribution,
                        bounces,
                        fresnel,
                        is_isotropic,
                    });
                }
            }
        }
        all.sort_by_key(|c: &Self| (c.bounces as u8, c.fresnel as u8, c.distribution as u8));
        all
    }

    pub(super) fn name(&self) -> String {
        let distribution = match self.distribution {
            Distribution::Ggx => "GGX",
            Distribution::Beckmann => "Beckmann",
        };
        let bounces = match self.bounces {
            Bounces::Single => "",
            Bounces::Compensated => ", compensated",
            Bounces::All => ", all bounces",
        };
        let fresnel = match self.fresnel {
            FresnelModel::Index => "index",
            FresnelModel::F82 => "F82",
        };
        format!("{distribution}, {fresnel}{bounces}")
    }

    /// How many of the parameters are alphas: they come first, as logarithms.
    pub(super) fn alphas(&self) -> usize {
        if self.is_isotropic { 1 } else { 2 }
    }

    /// The alphas among parameters.
    pub(super) fn alpha(&self, parameters: &[f64]) -> [f64; 2] {
        let x = parameters[0].exp();
        let y = if self.is_isotropic {
            x
        } else {
            parameters[1].exp()
        };
        [x, y]
    }

    /// The imaginary parts of the index among parameters.
    pub(super) fn k<'a>(&self, parameters: &'a [f64]) -> &'a [f64] {
        match self.fresnel {
            FresnelModel::Index => &parameters[self.alphas() + 3..],
            FresnelModel::F82 => &[],
        }
    }

    /// Lowest and highest value of each parameter.
    pub(super) fn bounds(&self) -> Vec<[f64; 2]> {
        let mut bounds = vec![ALPHA.map(f64::ln); self.alphas()];
        let [first, second] = match self.fresnel {
            FresnelModel::Index => [ETA, K],
            FresnelModel::F82 => [[0.0, 1.0], [0.0, 1.0]],
        };
        bounds.extend([first; 3]);
        bounds.extend([second; 3]);
        bounds
    }

    /// Parameters to begin with.
    ///
    /// * `f0`: reflectance along the normal per channel.
    /// * `eta`: real part of the index.
    pub(super) fn start(&self, alpha: f64, f0: [f64; 3], eta: f64) -> Vec<f64> {
        let mut start = vec![alpha.ln(); self.alphas()];
        match self.fresnel {
            FresnelModel::Index => {
                start.extend([eta; 3]);
                start.extend(f0.map(|f0| absorption(f0, eta)));
            }
            FresnelModel::F82 => {
                start.extend(f0);
                start.extend([0.95; 3]);
            }
        }
        start
    }

    /// The lobe without more than one bounce where they are simulated, else as it is.
    pub(super) fn analytic(&self, parameters: &[f64]) -> Option<NamedLobe> {
        let bounces = match self.bounces {
            Bounces::All => Bounces::Single,
            other => other,
        };
        Self { bounces, ..*self }.lobe(parameters)
    }

    /// The lobe of parameters.
    pub(super) fn lobe(&self, parameters: &[f64]) -> Option<NamedLobe> {
        self.of_values(self.alpha(parameters), &parameters[self.alphas()..])
    }

    /// The lobe of parameters with four digits, as it is printed.
    pub(super) fn printed(&self, parameters: &[f64]) -> Option<NamedLobe> {
        let alpha = self.alpha(parameters).map(four_digits);
        let colours = &parameters[self.alphas()..];
        let colours: Vec<f64> = colours.iter().copied().map(four_digits).collect();
        self.of_values(alpha, &colours)
    }

    /// The lobe of alphas and the numbers of its reflectance.
    fn of_values(&self, [x, y]: [f64; 2], colours: &[f64]) -> Option<NamedLobe> {
        let alpha = if self.is_isotropic {
            Value::One(x)
        } else {
            Value::Two([x, y])
        };
        let triple = |i: usize| Value::Three([colours[i], colours[i + 1], colours[i + 2]]);
        let [first, second] = match self.fresnel {
            FresnelModel::Index => ["conductor_eta", "conductor_k"],
            FresnelModel::F82 => ["f0", "f82_tint"],
        };
        let mut arguments = vec![
            argument("alpha", alpha),
            argument(first, triple(0)),
            argument(second, triple(3)),
        ];
        if self.distribution == Distribution::Beckmann {
            arguments.push(argument("distribution", Value::Word("beckmann")));
        }
        let kind = match self.bounces {
            Bounces::All => "multibounce-conductor",
            Bounces::Single => "conductor",
            Bounces::Compensated => {
                arguments.push(argument("energy", Value::Word("kulla-conty")));
                "conductor"
            }
        };
        specula_lobes::make(kind, &arguments).ok()
    }
}

/// The number of four digits that is nearest.
pub(super) fn four_digits(v: f64) -> f64 {
    format!("{v:.3e}").parse().unwrap_or(v)
}

fn argument<'a>(name: &'a str, value: Value<'a>) -> Argument<'a> {
    Argument { name, value }
}

/// k of a reflectance along the normal.
///
/// ```text
/// F0 = ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2)
/// ```
fn absorption(f0: f64, eta: f64) -> f64 {
    let squared = (f0 * (eta + 1.0).powi(2) - (eta - 1.0).powi(2)) / (1.0 - f0);
    squared.max(0.01).sqrt().min(K[1])
}
