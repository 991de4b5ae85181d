//! Compensated gold and glass by the formulas of the papers, albedos by quadrature.

use std::f64::consts::PI;

use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::{Rgb, Transport, Vec3};

use super::{Facets, cosine_average, fresnel, glass, metal};

/// Gold at normal incidence, and on average.
pub(crate) fn gold() -> [Rgb<f64>; 2] {
    let reflectance = fresnel::of_metal(fresnel::GOLD);
    [reflectance(1.0), fresnel::average(reflectance)]
}

/// Compensated gold by the formulas of Turquin 2019 and Kulla and Conty 2017, the albedos by quadrature.
///
/// * `f0`, `average`: reflectances of the light that is added, those of [`gold`] where it is right.
pub(crate) fn compensated_metal(
    facets: Facets,
    model: EnergyModel,
    [f0, average]: [Rgb<f64>; 2],
) -> impl Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64> {
    let reflectance = fresnel::of_metal(fresnel::GOLD);
    let mean = cosine_average(|w| facets.albedo(w));
    let series = average.map(|f| f * mean / (1.0 - f * (1.0 - mean)));
    move |wo, wi| {
        if wi.z <= 0.0 {
            return Rgb::BLACK;
        }
        let single = metal(facets, &reflectance, wo, wi);
        let albedo = facets.albedo(wo);
        let scaled = |f: f64| 1.0 + f * (1.0 - albedo) / albedo;
        match model {
            EnergyModel::Turquin(FmsVariant::NormalIncidence) => single * f0.map(scaled),
            EnergyModel::Turquin(FmsVariant::AverageSeries) => single * series.map(scaled),
            EnergyModel::KullaConty => {
                let shape = (1.0 - albedo) * (1.0 - facets.albedo(wi)) * wi.z / (PI * (1.0 - mean));
                single + average * series * shape
            }
        }
    }
}

/// Compensated glass by its formulas, the losses by quadrature; without the factor of radiance.
///
/// * `of_share`: factor of the share of the lost light that is transmitted, 1 where it is right.
pub(crate) fn compensated_glass(
    facets: Facets,
    eta: f64,
    of_share: f64,
) -> impl Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64> {
    let loss = move |w: Vec3<f64>, eta: f64| 1.0 - facets.glass_albedo(w, eta).iter().sum::<f64>();
    let average = |eta| fresnel::average(|cos| Rgb::splat(fresnel::dielectric(cos, eta))).g;
    let sides = [eta, 1.0 / eta].map(|eta| (average(eta), cosine_average(|w| loss(w, eta))));
    move |wo, wi| {
        let single = glass(facets, eta, (wo, wi), Transport::Importance);
        let is_above = wo.z > 0.0;
        let (near, far) = if is_above {
            (sides[0], sides[1])
        } else {
            (sides[1], sides[0])
        };
        let eta = if is_above { eta } else { 1.0 / eta };
        let up = |w: Vec3<f64>| Vec3 { z: w.z.abs(), ..w };
        let transmitted = of_share * (1.0 - near.0) * near.1.min(far.1) / near.1;
        let second = if (wi.z > 0.0) == is_above {
            (1.0 - transmitted) * loss(up(wi), eta) / near.1
        } else {
            transmitted * loss(up(wi), 1.0 / eta) / far.1
        };
        Rgb::splat(single + loss(up(wo), eta) * second * wi.z.abs() / PI)
    }
}
