//! Lobes as textbooks print them: in `f64`, by angles and slopes, with none of the library's formulas, so that a
//! fault in one of those is seen, of colour and of index too.
#![allow(dead_code, reason = "each suite uses a part")]

pub(crate) mod energy;
pub(crate) mod fresnel;
pub(crate) mod walks;

use std::f64::consts::PI;

use specula_bsdf::{Rgb, Transport, Vec3};
use specula_stat::quadrature::{direction, gauss_legendre};
use specula_stat::{Check, Rng};
use statrs::function::erf::erfc;

/// A distribution of normals, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    Ggx,
    Beckmann,
}

/// Facets of these alphas under Smith's assumption.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facets {
    pub(crate) shape: Shape,
    pub(crate) alpha: (f64, f64),
}

impl Facets {
    pub(crate) fn new(shape: Shape, alpha: (f64, f64)) -> Self {
        Self { shape, alpha }
    }

    /// Density of normals, from that of slopes (Heitz 2014, eqs. 79 and 85): `P22 / cos^4`.
    pub(crate) fn d(self, m: Vec3<f64>) -> f64 {
        if m.z <= 0.0 {
            return 0.0;
        }
        let (ax, ay) = self.alpha;
        let squared = (m.x / m.z / ax).powi(2) + (m.y / m.z / ay).powi(2);
        let p22 = match self.shape {
            Shape::Ggx => 1.0 / (1.0 + squared).powi(2),
            Shape::Beckmann => (-squared).exp(),
        };
        p22 / (PI * ax * ay * m.z.powi(4))
    }

    /// Smith's Lambda of a direction on its own side (Heitz 2014, eqs. 72, 81 and 86): `alpha tan theta` tells it.
    pub(crate) fn lambda(self, w: Vec3<f64>) -> f64 {
        let (ax, ay) = self.alpha;
        let slope = (ax * w.x).hypot(ay * w.y) / w.z.abs();
        if slope < 1e-12 {
            return 0.0;
        }
        match self.shape {
            Shape::Ggx => 0.5 * ((1.0 + slope * slope).sqrt() - 1.0),
            Shape::Beckmann => {
                let a = 1.0 / slope;
                (-a * a).exp() / (2.0 * a * PI.sqrt()) - 0.5 * erfc(a)
            }
        }
    }

    /// Height-correlated masking and shadowing (Heitz 2014, eq. 99).
    pub(crate) fn g2(self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        1.0 / (1.0 + self.lambda(wo) + self.lambda(wi))
    }

    /// Masking and shadowing one by one.
    pub(crate) fn g1_g1(self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        1.0 / ((1.0 + self.lambda(wo)) * (1.0 + self.lambda(wi)))
    }

    /// `G2 D / (4 |wo.z|)`: the value of a white metal.
    pub(crate) fn white(self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        self.d(half(wo, wi)) * self.g2(wo, wi) / (4.0 * wo.z)
    }

    /// `int value(m, weight)` over normals `m`, by a grid of slopes; the weights are those of `D cos`.
    fn each_normal(self, count: u32, mut value: impl FnMut(Vec3<f64>, f64)) {
        let (ax, ay) = self.alpha;
        let weight = 1.0 / f64::from(count * count);
        for i in 0..count {
            // Midpoints in a variable that is dense where slopes are steep.
            let v = (f64::from(i) + 0.5) / f64::from(count);
            let (u, slope) = (1.0 - v.powi(3), 3.0 * v * v);
            let r = match self.shape {
                Shape::Ggx => (u / (1.0 - u)).sqrt(),
                Shape::Beckmann => (-(1.0 - u).ln()).sqrt(),
            };
            for j in 0..count {
                let phi = 2.0 * PI * (f64::from(j) + 0.5) / f64::from(count);
                let m = Vec3 {
                    x: -ax * r * phi.cos(),
                    y: -ay * r * phi.sin(),
                    z: 1.0,
                };
                value(m.normalize(), slope * weight);
            }
        }
    }

    /// Directional albedo of the white metal, by quadrature.
    pub(crate) fn albedo(self, wo: Vec3<f64>) -> f64 {
        let mut sum = 0.0;
        self.each_normal(80, |m, weight| {
            let cos = wo.dot(m);
            let wi = m * (2.0 * cos) - wo;
            if cos > 0.0 && wi.z > 0.0 {
                sum += weight * cos / (m.z * wo.z) * self.g2(wo, wi);
            }
        });
        sum
    }

    /// What glass of this index reflects and transmits of the light from `wo`, scattered once, by quadrature.
    pub(crate) fn glass_albedo(self, wo: Vec3<f64>, eta: f64) -> [f64; 2] {
        self.glass_albedo_masked(wo, eta, |wi| self.g2(wo, wi))
    }

    /// The same with separable masking.
    pub(crate) fn glass_albedo_separable(self, wo: Vec3<f64>, eta: f64) -> [f64; 2] {
        self.glass_albedo_masked(wo, eta, |wi| self.g1_g1(wo, wi))
    }

    fn glass_albedo_masked(
        self,
        wo: Vec3<f64>,
        eta: f64,
        masking: impl Fn(Vec3<f64>) -> f64,
    ) -> [f64; 2] {
        let mut sums = [0.0; 2];
        self.each_normal(80, |m, weight| {
            let cos = wo.dot(m);
            if cos <= 0.0 {
                return;
            }
            let share = fresnel::dielectric(cos, eta);
            let measure = weight * cos / (m.z * wo.z);
            let wi = m * (2.0 * cos) - wo;
            if wi.z > 0.0 {
                sums[0] += share * measure * masking(wi);
            }
            if let Some(wi) = fresnel::refracted(wo, m, eta).filter(|wi| wi.z < 0.0) {
                sums[1] += (1.0 - share) * measure * masking(wi);
            }
        });
        sums
    }
}

/// The unit half vector.
pub(crate) fn half(wo: Vec3<f64>, wi: Vec3<f64>) -> Vec3<f64> {
    (wo + wi).normalize()
}

/// `1/pi int value(w) cos dw` over the upper hemisphere, for values that are even in x and y.
pub(crate) fn cosine_average(value: impl Fn(Vec3<f64>) -> f64) -> f64 {
    let mut sum = 0.0;
    for [x, x_weight] in gauss_legendre(16) {
        let z = 0.5 * (x + 1.0);
        for [y, y_weight] in gauss_legendre(6) {
            let phi = 0.25 * PI * (y + 1.0);
            // The cosine as a square: values bend near the horizon.
            let at = value(direction(z * z, phi));
            sum += 4.0 * z.powi(3) * 0.5 * x_weight * 0.5 * y_weight * at;
        }
    }
    sum
}

/// A rough metal of any reflectance: Cook and Torrance's `F G2 D / (4 |wo.z|)`.
pub(crate) fn metal(
    facets: Facets,
    fresnel: impl Fn(f64) -> Rgb<f64>,
    wo: Vec3<f64>,
    wi: Vec3<f64>,
) -> Rgb<f64> {
    if wi.z <= 0.0 {
        return Rgb::BLACK;
    }
    fresnel(wo.dot(half(wo, wi))) * facets.white(wo, wi)
}

/// Rough glass seen from either side (Walter et al. 2007, eqs. 20 and 21).
///
/// * `eta`: index below over the index above.
pub(crate) fn glass(
    facets: Facets,
    eta: f64,
    (wo, wi): (Vec3<f64>, Vec3<f64>),
    transport: Transport,
) -> f64 {
    if wo.z < 0.0 {
        let turned = |w: Vec3<f64>| Vec3 { z: -w.z, ..w };
        return glass(facets, 1.0 / eta, (turned(wo), turned(wi)), transport);
    }
    if wi.z > 0.0 {
        return fresnel::dielectric(wo.dot(half(wo, wi)), eta) * facets.white(wo, wi);
    }
    // Indices n_o = 1 on the side of the view and n_i = eta on that of the light.
    let sum = wo + wi * eta;
    let m = sum * (1.0_f64.copysign(sum.z) / sum.length());
    let (cos_o, cos_i) = (wo.dot(m), wi.dot(m));
    if cos_o <= 0.0 || cos_i >= 0.0 {
        return 0.0;
    }
    let passed = 1.0 - fresnel::dielectric(cos_o, eta);
    let radiance = passed * facets.d(m) * facets.g2(wo, wi) * cos_o * -cos_i
        / (wo.z * (cos_o + eta * cos_i).powi(2));
    match transport {
        Transport::Radiance => radiance,
        Transport::Importance => radiance * eta * eta,
    }
}

/// How far values may be from their textbook.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    pub(crate) relative: f64,
    pub(crate) absolute: f64,
}

/// Formulas, in two forms.
pub(crate) const EXACT: Tolerance = Tolerance {
    relative: 1e-7,
    absolute: 1e-9,
};

/// Values that come out of tables.
pub(crate) const TABLES: Tolerance = Tolerance {
    relative: 1.5e-2,
    absolute: 2e-4,
};

/// Losses of interfaces: their tables' error is 2e-2 of the light, of which the cosine's lobe has 1/pi along the normal.
pub(crate) const INTERFACE_TABLES: Tolerance = Tolerance {
    relative: 1e-2,
    absolute: 7e-3,
};

/// A function of two directions, per channel.
pub(crate) type Value<'a> = &'a dyn Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64>;

/// Compares values with the textbook's, channel by channel, for lights everywhere and near the mirror directions.
///
/// * `lowest`: the lowest cosine of lights; -1 for interfaces.
pub(crate) fn compare(
    name: &str,
    views: &[Vec3<f64>],
    lowest: f64,
    (value, textbook): (Value<'_>, Value<'_>),
    tolerance: Tolerance,
) -> Check {
    let mut rng = Rng::from_name(name);
    let (mut worst, mut where_) = (0.0_f64, String::new());
    let mut lit = 0;
    for &wo in views {
        for k in 0..200 {
            let around = |axis: Vec3<f64>, rng: &mut Rng| {
                let mut off = || 0.3 * (rng.uniform() - 0.5);
                (axis
                    + Vec3 {
                        x: off(),
                        y: off(),
                        z: off(),
                    })
                .normalize()
            };
            let mirror = Vec3 {
                x: -wo.x,
                y: -wo.y,
                z: wo.z,
            };
            let wi = match k % 3 {
                0 => around(mirror, &mut rng),
                1 if lowest < 0.0 => around(-wo, &mut rng),
                _ => direction(
                    lowest + (1.0 - lowest) * rng.uniform(),
                    2.0 * PI * rng.uniform(),
                ),
            };
            if wi.z < lowest || wi.z.abs() < 1e-3 {
                continue;
            }
            let (got, expected) = (value(wo, wi).to_array(), textbook(wo, wi).to_array());
            for (channel, (a, b)) in got.into_iter().zip(expected).enumerate() {
                lit += u32::from(b > 0.0);
                let off = (a - b).abs() / (tolerance.relative * b.abs() + tolerance.absolute);
                let off = if off.is_nan() { f64::INFINITY } else { off };
                if off > worst {
                    worst = off;
                    let channel = ["red", "green", "blue"][channel];
                    where_ = format!("{channel} {a:e}, textbook {b:e}, wo {wo:?}, wi {wi:?}");
                }
            }
        }
    }
    Check {
        name: format!("textbook {name}"),
        is_pass: worst <= 1.0 && lit > 100,
        p_value: None,
        detail: format!("{worst:.3} of the tolerance: {where_}; {lit} values"),
    }
}
