//! Measured materials: values, densities and samples of synthetic tables of every symmetry.

use std::any::Any;
use std::collections::BTreeSet;
use std::sync::LazyLock;

use specula_bsdf::bsdf::{BsdfSample, RoughConductor};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::rgb;
use specula_bsdf::measured::{Measured, MeasuredTables, Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Real, Rgb, Transport, Vec3};
use specula_shaders::{DeclarationKind, MODULES, declarations};

use crate::bsdf::{arguments, names, pair, reached, rows, sampled};
use crate::harness::{Case, Fault, assert_covered, catch_some, fault, prove, round, twins, vector};

/// Alphas and symmetries of the metals that tables are made of.
const METALS: [([f32; 2], Symmetry); 5] = [
    ([0.4, 0.4], Symmetry::Isotropic),
    ([0.1, 0.1], Symmetry::Isotropic),
    ([0.3, 0.6], Symmetry::Turn),
    ([0.6, 0.3], Symmetry::HalfTurn),
    ([0.2, 0.5], Symmetry::QuarterTurn),
];

/// Tables of a metal. Of the last one, colours are not multiplied by `ndf / (4 sigma)`.
fn tables_of(metal: usize) -> MeasuredTables {
    let ([x, y], symmetry) = METALS[metal];
    let ndf = Ggx::new(Alpha::clamped(f64::from(x), f64::from(y)));
    let lobe = RoughConductor::new(ndf, Reflectance::Constant(rgb(0.9, 0.6, 0.3)));
    let size = Resolution {
        theta: 5,
        phi: 4,
        normals: [20, 12],
        colours: 8,
    };
    let tables = tabulate(&ndf, &lobe, symmetry, size);
    MeasuredTables {
        jacobian: metal + 1 < METALS.len(),
        ..tables
    }
}

/// The lobes in a scalar.
struct Lobes<T>(Vec<Measured<T>>);

impl<T: Real> Lobes<T> {
    fn new() -> Self {
        let lobe = |metal| Measured::new(&tables_of(metal)).expect("the tables are sound");
        Self((0..METALS.len()).map(lobe).collect())
    }
}

static LOBES: LazyLock<(Lobes<f32>, Lobes<f64>)> = LazyLock::new(|| (Lobes::new(), Lobes::new()));

/// The energy tables, and behind them the measured lobes.
struct Tables {
    bytes: Vec<u8>,
    /// Where each lobe begins, in numbers.
    starts: Vec<f32>,
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let mut bytes = specula_shaders::tables().to_vec();
    let mut starts = Vec::new();
    for lobe in &LOBES.0.0 {
        let start = u32::try_from(bytes.len() / 4).map_or(0.0, f64::from);
        starts.push(round(start));
        bytes.extend(lobe.packed().iter().flat_map(|x| x.to_le_bytes()));
    }
    Tables { bytes, starts }
});

/// The array that shaders read: the energy tables, and behind them what the cases measure.
pub(crate) fn tables() -> &'static [u8] {
    &TABLES.bytes
}

/// A lobe that lies in the tables.
struct Shared<T: 'static>(&'static Measured<T>);

impl<T: Real> Bsdf<T> for Shared<T> {
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.0.eval(wo, wi, transport)
    }

    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.0.pdf(wo, wi)
    }

    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        self.0.sample(wo, u, transport)
    }

    fn albedo(&self) -> Rgb<T> {
        self.0.albedo()
    }
}

/// The lobe that begins where the argument says.
fn lobe<T: Real>(p: &[T]) -> Shared<T> {
    let (single, double) = &*LOBES;
    let all: [&'static dyn Any; 2] = [single, double];
    let lobes = all.into_iter().find_map(|l| l.downcast_ref::<Lobes<T>>());
    let mut starts = TABLES.starts.iter();
    let place = starts.position(|&start| T::of(start.into()) == p[0]);
    let lobes = lobes.expect("scalars are f32 and f64");
    Shared(&lobes.0[place.expect("a lobe begins there")])
}

fn alphas(p: &[f32; 1]) -> ([f32; 2], Option<f32>) {
    let place = TABLES.starts.iter().position(|start| *start == p[0]);
    (METALS[place.unwrap_or(0)].0, None)
}

/// The number at a place, by its four bytes.
fn number(place: f64) -> f64 {
    let numbers = tables().as_chunks().0;
    let mut places = (0_u32..).zip(numbers);
    let found = places.find(|(i, _)| f64::from(*i) == place);
    found.map_or(f64::NAN, |(_, bytes)| f32::from_le_bytes(*bytes).into())
}

pub(crate) fn cases() -> Vec<Case> {
    let starts: Vec<[f32; 1]> = TABLES.starts.iter().map(|&start| [start]).collect();
    let last = u32::try_from(tables().len() / 4 - 1).map_or(0.0, f64::from);
    let few: Vec<[f32; 1]> = starts.iter().copied().chain([[round(last)]]).collect();
    let mut all = vec![
        Case::new(
            "measured_numbers",
            &["measured_table"],
            "y[0] = measured_table(u32(x[0]));",
            few,
            twins!(|x| vec![T::of(number(x[0].to_f64()))]),
            0.0,
        ),
        Case::new(
            "measured_albedo",
            &["measured"],
            "let albedo = measured_of(u32(x[0])).albedo;
             y[0] = albedo.r; y[1] = albedo.g; y[2] = albedo.b;",
            starts.clone(),
            twins!(|x| lobe(x).albedo().to_array().to_vec()),
            64.0,
        ),
    ];
    // The azimuth of the pole is 0 in shaders, whatever the signs of its zeros.
    let plain = |mut rows: Vec<Vec<f32>>| {
        rows.iter_mut().flatten().for_each(|x| *x += 0.0);
        rows
    };
    let [values, _] = rows(&starts, alphas, |_| false).map(plain);
    // At many more random numbers.
    let [_, samples] = rows(&starts.repeat(8), alphas, |_| false).map(plain);
    all.extend(pair(
        ["measured_values", "measured_samples"],
        &["measured", "bsdf_sample"],
        [VALUES, SAMPLES],
        [
            twins!(|x| {
                let (wo, wi) = (vector(x, 0), vector(x, 3));
                let (f, pdf) = lobe(&x[7..]).eval_pdf(wo, wi, Transport::Radiance);
                vec![f.r, f.g, f.b, pdf]
            }),
            twins!(|x| sampled(&lobe(&x[7..]), x)),
        ],
        [values, samples],
        // Where both directions are within half a degree of the horizon, 1.5e-4 of a density.
        [256.0, 2048.0],
        &[1e-3],
    ));
    all
}

/// Values and densities by the functions of one alone, which compile in half the time of all three.
const VALUES: &str = arguments!(
    "let lobe = measured_of(u32(x[7]));
     let value = measured_eval(lobe, wo, wi, transport);
     y[0] = value.r; y[1] = value.g; y[2] = value.b;
     y[3] = measured_pdf(lobe, wo, wi);"
);

/// Samples, and by how much their weights and densities miss those of `measured_eval_pdf`.
const SAMPLES: &str = arguments!(
    "let lobe = measured_of(u32(x[7]));
     let sampled = measured_sample(lobe, wo, u, transport);
     y[0] = f32(sampled.flags);
     if sampled.flags != 0u {
         y[1] = sampled.wi.x; y[2] = sampled.wi.y; y[3] = sampled.wi.z;
         y[4] = sampled.weight.r; y[5] = sampled.weight.g; y[6] = sampled.weight.b;
         y[7] = sampled.eta;
         let value = measured_eval_pdf(lobe, wo, sampled.wi, transport);
         let largest = max(max(value.r, value.g), max(value.b, 1e-30));
         let missing = abs(sampled.weight * value.a - value.rgb) / largest;
         y[8] = sampled.pdf / value.a - 1.0;
         y[9] = max(max(missing.r, missing.g), missing.b);
     }"
);

/// One for every module, and a wrong mirror.
pub(crate) const FAULTS: &[Fault] = &[
    fault(
        "measured_numbers",
        "measured/measured_table",
        "energy_table(index)",
        "energy_table(index + 1u)",
    ),
    fault(
        "measured_samples",
        "measured/measured_warp",
        "2.0 * (b - a) * area",
        "(b - a) * area",
    ),
    fault(
        "measured_values",
        "measured/measured",
        "lobe.symmetry == 4u",
        "lobe.symmetry == 2u",
    ),
    fault(
        "measured_values",
        "measured/measured_slices",
        "min(j + 1u, polar.count - 1u)",
        "min(j + 1u, polar.count - 2u)",
    ),
    fault(
        "measured_albedo",
        "measured/measured",
        "MEASURED_ALBEDO: u32 = 13u",
        "MEASURED_ALBEDO: u32 = 12u",
    ),
    fault(
        "measured_values",
        "measured/measured_grid",
        "min(u32(y), size.y - 2u)",
        "min(u32(y), size.y - 3u)",
    ),
];

#[test]
fn cases_hold() {
    prove("measured", &cases());
}

#[test]
fn every_function_is_covered() {
    let cases = cases();
    let called: BTreeSet<&str> = cases.iter().flat_map(|case| names(case.body)).collect();
    let steps = reached(&cases);
    let modules = MODULES.iter().filter(|m| m.folder() == "measured");
    let elsewhere: Vec<(&str, &str)> = modules
        .flat_map(|m| declarations(m.text))
        .filter(|d| d.kind == DeclarationKind::Function && !called.contains(d.name))
        .filter(|d| steps.contains(d.name))
        .map(|d| (d.name, "a step of the lobe"))
        .collect();
    assert_covered("measured", &cases, &elsewhere);
}

#[test]
fn planted_faults_are_caught() {
    catch_some("measured", &cases(), FAULTS);
}
