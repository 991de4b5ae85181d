//! Energy tables, compensation and interfaces.

use specula_bsdf::energy::{DielectricLoss, Loss, ggx_average_loss, ggx_loss};
use specula_bsdf::fresnel::{Conductor, F82Tint, Reflectance, Schlick};
use specula_bsdf::internal::coordinates::{
    AlphaPair, alpha_coordinate, average_scale, cosine_coordinate, edge,
    interface_cosine_coordinate,
};
use specula_bsdf::internal::dielectric_albedo::{eta_coordinate, half};
use specula_bsdf::internal::fresnel_average::reflectance_average;
use specula_bsdf::internal::interface_layer::Layer;
use specula_bsdf::internal::model::further_bounces;
use specula_bsdf::internal::pairs::{pair, row};
use specula_bsdf::internal::spline::Spline;
use specula_bsdf::internal::stencil::Stencil;
use specula_bsdf::internal::{interface, interface_single};
use specula_bsdf::math::rgb;
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Real, Rgb};

use crate::harness::{
    ALPHAS, Case, Fault, alpha, assert_covered, both_sides, catch, fault, product, prove, twins,
    vector,
};

/// Values of three channels.
fn channels<T>(colour: Rgb<T>) -> Vec<T> {
    vec![colour.r, colour.g, colour.b]
}

/// A small whole number as a scalar.
fn scalar<T: Real>(x: usize) -> T {
    T::of(u32::try_from(x).map_or(f64::NAN, f64::from))
}

/// A scalar as a small whole number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "inputs are small whole numbers"
)]
fn index<T: Real>(x: T) -> usize {
    x.to_f64() as usize
}

/// Places in and about `[0, 1]`, exact in few digits so that no cell is missed by rounding.
fn places() -> Vec<[f32; 1]> {
    (-8..=136_i16).map(|i| [f32::from(i) / 128.0]).collect()
}

/// Triples of small integers.
fn indices() -> Vec<[f32; 3]> {
    let each = |i: u8, j: u8| (0..12_u8).map(move |k| [i, j, k].map(f32::from));
    let pairs = (0..24_u8).flat_map(|i| (0..24_u8).map(move |j| (i, j)));
    pairs.flat_map(|(i, j)| each(i, j)).collect()
}

/// Both cosines, for every number of the list.
fn cosines() -> Vec<[f32; 1]> {
    [1.0, 0.7, 0.3, 0.05, 0.005, 0.0].map(|c| [c]).to_vec()
}

/// The four tables: 0 to 3, GGX and Beckmann, each with both maskings.
const TABLES: [[f32; 1]; 4] = [[0.0], [1.0], [2.0], [3.0]];
/// Indices of interfaces, within the tables and beyond.
const INDICES: [[f32; 1]; 8] = [
    [1.5],
    [0.666_666_7],
    [1.1],
    [0.9],
    [2.4],
    [0.416_666_7],
    [4.0],
    [0.25],
];

/// Alphas, views and tables.
fn losses() -> Vec<[f32; 6]> {
    product(&product::<2, 3, 5>(&ALPHAS, &both_sides()), &TABLES)
}

/// Masking of a table.
fn masking<T: Real>(table: T) -> Masking {
    if index(table).is_multiple_of(2) {
        Masking::HeightCorrelated
    } else {
        Masking::Separable
    }
}

/// The loss of arguments: alphas, view, table.
fn loss<T: Real>(x: &[T]) -> Loss<T> {
    if index(x[5]) < 2 {
        Loss::new(Ggx::new(alpha(x, 0)), masking(x[5]))
    } else {
        Loss::new(Beckmann::new(alpha(x, 0)), masking(x[5]))
    }
}

/// The loss of an interface of arguments: alphas, view, table, index.
fn dielectric_loss<T: Real>(x: &[T]) -> DielectricLoss<T> {
    if index(x[5]) < 2 {
        DielectricLoss::new(Ggx::new(alpha(x, 0)), masking(x[5]), x[6])
    } else {
        DielectricLoss::new(Beckmann::new(alpha(x, 0)), masking(x[5]), x[6])
    }
}

/// The coat of two alphas; none where the first is 0.
fn coat<T: Real>(x: &[T]) -> Option<Ggx<T>> {
    (x[0] > T::ZERO).then(|| Ggx::new(alpha(x, 0)))
}

/// Coats, smooth and rough, with an index and a cosine.
fn coats() -> Vec<[f32; 4]> {
    let mut alphas = vec![[0.0, 0.0]];
    alphas.extend(ALPHAS);
    let etas = [[1.05], [1.1], [1.5], [2.4], [3.0]];
    product(&product::<2, 1, 3>(&alphas, &etas), &cosines())
}

/// Reflectances by number: a constant, gold, Schlick, F82.
fn reflectance<T: Real>(which: T) -> Reflectance<T> {
    let colour = |r: f32, g: f32, b: f32| {
        let [r, g, b] = [r, g, b].map(|v| T::of(f64::from(v)));
        rgb(r, g, b)
    };
    match index(which) {
        0 => Reflectance::Constant(colour(0.9, 0.6, 0.3)),
        1 => Reflectance::Conductor(Conductor {
            eta: colour(0.14, 0.37, 1.44),
            k: colour(3.98, 2.38, 1.6),
        }),
        2 => Reflectance::Schlick(Schlick {
            f0: colour(0.9, 0.6, 0.04),
        }),
        _ => Reflectance::F82Tint(F82Tint::new(colour(0.9, 0.6, 0.3), colour(0.8, 0.9, 1.0))),
    }
}

fn axis_cases() -> Vec<Case> {
    vec![
        Case::new(
            "spline_weights",
            &["spline"],
            "let cell = spline_cell(x[0], 7u);
             let cubic = spline_cubic(x[0], 10u);
             let quadratic = spline_quadratic(x[0], 9u);
             y[0] = cell.x; y[1] = cell.y; y[2] = f32(cubic.first); y[3] = f32(quadratic.first);
             for (var k = 0u; k < 4u; k++) { y[4u + k] = cubic.weights[k]; }
             for (var k = 0u; k < 3u; k++) { y[8u + k] = quadratic.weights[k]; }",
            places(),
            twins!(|x| {
                let (cubic, quadratic) = (Spline::cubic(x[0], 10), Spline::quadratic(x[0], 9));
                let first = scalar(cubic.first());
                let place = x[0].within(T::ZERO, T::ONE) * T::of(7.0) - first;
                let mut y = vec![first, place, first, scalar(quadratic.first())];
                y.extend(cubic.weights());
                y.extend(quadratic.weights());
                y
            }),
            2.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "stencil_sums",
            &["stencil"],
            "let stencil = stencil_at(x[0], 10u);
             for (var k = 0u; k < 4u; k++) {
                 let i = f32(stencil.first + k);
                 let weight = stencil.weights[k];
                 y[0] += weight; y[1] += weight * i; y[2] += weight * i * i; y[3] += weight * i * i * i * i;
             }",
            places(),
            twins!(|x| {
                let stencil = Stencil::new(x[0], 10);
                let power = |n: i32| stencil.sum(|i| T::of(scalar::<f64>(i).powi(n)));
                vec![power(0), power(1), power(2), power(4)]
            }),
            3.0,
        )
        .at_scale(&[1.0, 9.0, 81.0, 6561.0]),
        Case::new(
            "pairs_rows",
            &["pairs"],
            "let i = u32(x[0]); let j = u32(x[1]);
             y[0] = f32(pairs_pair(i, j));
             y[1] = f32(pairs_row(i, j, u32(x[2]), 12u));",
            indices(),
            twins!(|x| {
                let [i, j, azimuth] = [0, 1, 2].map(|k| index(x[k]));
                vec![scalar(pair(i, j).0), scalar(row(i, j, azimuth, 12))]
            }),
            0.0,
        ),
    ]
}

fn coordinate_cases() -> Vec<Case> {
    vec![
        Case::new(
            "coordinates_of_a_view",
            &["coordinates"],
            "let alphas = coordinates_alpha_pair(x[0], x[1]);
             let edge = coordinates_edge(x[5]);
             let azimuth = coordinates_azimuth(alphas, x[2], x[3]);
             y[0] = alphas.low; y[1] = alphas.high; y[2] = edge;
             y[3] = azimuth.alpha; y[4] = azimuth.v; y[5] = azimuth.narrow;
             y[6] = coordinates_interface_azimuth(azimuth, edge);
             y[7] = coordinates_cosine(abs(x[4]), azimuth.alpha);
             y[8] = coordinates_interface_cosine(abs(x[4]), azimuth.alpha, edge);",
            stretched_views(),
            twins!(|x| {
                let alphas = AlphaPair::new(x[0], x[1]);
                let (low, high) = alphas.ordered();
                let azimuth = alphas.azimuth(x[2], x[3]);
                let (edge, cosine) = (edge(x[5]), x[4].abs());
                vec![
                    low,
                    high,
                    edge,
                    azimuth.alpha,
                    azimuth.v,
                    azimuth.narrow,
                    azimuth.interface(edge),
                    cosine_coordinate(cosine, azimuth.alpha),
                    interface_cosine_coordinate(cosine, azimuth.alpha, edge),
                ]
            }),
            4.0,
        )
        .at_scale(&[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0]),
        Case::new(
            "coordinates_of_alpha_pair",
            &["coordinates"],
            "y[0] = coordinates_alpha(x[0]);
             y[1] = coordinates_average_scale(x[0], x[1]);",
            ALPHAS.to_vec(),
            twins!(|x| vec![alpha_coordinate(x[0]), average_scale(x[0], x[1])]),
            4.0,
        )
        .at_scale(&[1.0, 0.0]),
    ]
}

/// anisotropic alpha, views and indices.
fn stretched_views() -> Vec<[f32; 6]> {
    let alphas: Vec<[f32; 2]> = ALPHAS.into_iter().filter(|[x, y]| x != y).collect();
    let views: Vec<[f32; 3]> = both_sides()
        .into_iter()
        .filter(|w| w[2].abs() < 1.0)
        .collect();
    product(&product::<2, 3, 5>(&alphas, &views), &INDICES)
}

fn loss_cases() -> Vec<Case> {
    vec![
        Case::new(
            "albedo_losses",
            &["albedo"],
            "let masking = u32(x[5]) % 2u;
             let loss = albedo_loss(u32(x[5]) / 2u, masking, vec2f(x[0], x[1]));
             y[0] = loss.average;
             y[1] = albedo_directional_loss(loss, vec3f(x[2], x[3], x[4]));",
            losses(),
            twins!(|x| {
                let loss = loss(x);
                vec![loss.average(), loss.directional(vector(x, 2))]
            }),
            12.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "dielectric_albedo_losses",
            &["dielectric_albedo"],
            "let masking = u32(x[5]) % 2u;
             let loss = dielectric_albedo_loss(u32(x[5]) / 2u, masking, vec2f(x[0], x[1]), x[6]);
             y[0] = loss.average;
             y[1] = dielectric_albedo_directional_loss(loss, vec3f(x[2], x[3], x[4]));",
            product::<6, 1, 7>(&losses(), &INDICES),
            twins!(|x| {
                let loss = dielectric_loss(x);
                vec![loss.average(), loss.directional(vector(x, 2))]
            }),
            12.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "dielectric_albedo_indices",
            &["dielectric_albedo"],
            "y[0] = f32(dielectric_albedo_half_start(x[0], 12u));
             y[1] = dielectric_albedo_eta_coordinate(x[0]);",
            INDICES.to_vec(),
            twins!(|x| vec![scalar(half(x[0], 12)), eta_coordinate(x[0])]),
            3.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "energy_table_values",
            &["energy_table"],
            "y[0] = energy_table(u32(x[0]));",
            (0..924).map(|i: u16| [f32::from(i) * 1000.0]).collect(),
            twins!(|x| {
                let bytes = specula_shaders::tables()[4 * index(x[0])..].as_chunks().0[0];
                vec![T::of(f64::from(f32::from_le_bytes(bytes)))]
            }),
            0.0,
        ),
    ]
}

fn formula_cases() -> Vec<Case> {
    vec![
        Case::new(
            "fit_loss",
            &["fit"],
            "y[0] = fit_ggx_loss(x[0], x[1]);
             y[1] = fit_ggx_average_loss(x[0]);",
            product::<1, 1, 2>(&ALPHAS.map(|[a, _]| [a]), &cosines()),
            twins!(|x| vec![ggx_loss(x[0], x[1]), ggx_average_loss(x[0])]),
            64.0,
        )
        .at_scale(&[1e-2, 0.0]),
        Case::new(
            "model_bounces",
            &["model"],
            "let further = model_further_bounces(vec3f(x[0], 0.5, 1.0), x[1]);
             y[0] = further.r; y[1] = further.g; y[2] = further.b;",
            product::<1, 1, 2>(&cosines(), &[[0.0], [0.3], [0.9], [1.0]]),
            twins!(|x| channels(further_bounces(rgb(x[0], T::HALF, T::ONE), x[1]))),
            3.0,
        ),
        Case::new(
            "fresnel_average_channels",
            &["fresnel_average"],
            "let colour = vec3f(0.9, 0.6, 0.3);
             var reflectance = reflectance_constant(colour);
             if x[0] == 1.0 { reflectance = reflectance_conductor(vec3f(0.14, 0.37, 1.44), vec3f(3.98, 2.38, 1.6)); }
             if x[0] == 2.0 { reflectance = reflectance_schlick(vec3f(0.9, 0.6, 0.04)); }
             if x[0] == 3.0 { reflectance = reflectance_f82_tint(colour, vec3f(0.8, 0.9, 1.0)); }
             reflectance = reflectance_tinted(reflectance, vec3f(x[1], 1.0, 0.25));
             let average = fresnel_average_of(reflectance);
             y[0] = average.r; y[1] = average.g; y[2] = average.b;
             let metal = ConductorIor(vec3f(0.14, 0.37, 1.44), vec3f(3.98, 2.38, 1.6));
             y[3] = fresnel_average_conductor(metal).g;",
            product::<1, 1, 2>(&[[0.0], [1.0], [2.0], [3.0]], &[[1.0], [0.5]]),
            twins!(|x| {
                let tint = rgb(x[1], T::ONE, T::of(0.25));
                let mut values = channels(reflectance_average(&reflectance(x[0]).tinted(tint)));
                values.push(reflectance_average(&reflectance(T::ONE)).g);
                values
            }),
            4.0,
        ),
    ]
}

fn interface_cases() -> Vec<Case> {
    vec![
        Case::new(
            "interface_shares",
            &["interface", "interface_single"],
            "let width = interface_mean_alpha(vec2f(x[0], x[1]));
             y[0] = interface_transmittance(width, x[2], x[3]);
             y[1] = interface_internal_reflectance(width, x[2]);
             y[2] = interface_effective_cosine(x[3], width);
             y[3] = interface_single_transmittance(width, x[2], x[3]);
             y[4] = interface_single_internal_reflectance(width, x[2]);
             y[5] = interface_single_reflectance_estimate(width, x[2], x[3]);",
            coats(),
            twins!(|x| {
                let (coat, eta, mu) = (coat(x), x[2], x[3]);
                let width = (x[0] * x[1]).sqrt();
                vec![
                    interface::transmittance(coat, eta, mu),
                    interface::internal_reflectance(coat, eta),
                    interface::effective_cosine(mu, width),
                    interface_single::transmittance(coat, eta, mu),
                    interface_single::internal_reflectance(coat, eta),
                    interface_single::reflectance_estimate(coat, eta, mu),
                ]
            }),
            6.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "interface_layer_shares",
            &["interface_layer"],
            "let width = sqrt(x[0] * x[1]);
             let layer = interface_layer_new(x[4]);
             y[0] = interface_layer_crossing(layer, width, x[2], x[3]);
             y[1] = interface_layer_there_and_back(layer, width, x[2]);",
            product::<4, 1, 5>(&coats(), &[[0.0], [0.01], [0.1], [1.0], [20.0]]),
            twins!(|x| {
                let layer = Layer::new(x[4]);
                let coat = coat(x);
                vec![
                    layer.crossing(coat, x[2], x[3]),
                    layer.there_and_back(coat, x[2]),
                ]
            }),
            6.0,
        )
        .at_scale(&[1.0]),
    ]
}

pub(crate) fn cases() -> Vec<Case> {
    [
        axis_cases(),
        coordinate_cases(),
        loss_cases(),
        formula_cases(),
        interface_cases(),
    ]
    .concat()
}

#[test]
fn cases_hold() {
    prove("energy", &cases());
}

#[test]
fn every_function_is_covered() {
    let losses = "a step of albedo_loss and albedo_directional_loss";
    let interfaces = "a step of dielectric_albedo_loss and its directional loss";
    let coats = "a step of the shares of interfaces";
    assert_covered(
        "energy",
        &cases(),
        &[
            ("albedo_table_start", losses),
            ("albedo_row", losses),
            ("albedo_isotropic", losses),
            ("albedo_anisotropic", losses),
            ("coordinates_bend", "a step of coordinates_interface_cosine"),
            ("dielectric_albedo_isotropic_average", interfaces),
            ("dielectric_albedo_anisotropic_average", interfaces),
            ("dielectric_albedo_isotropic", interfaces),
            ("dielectric_albedo_row", interfaces),
            ("dielectric_albedo_anisotropic", interfaces),
            ("interface_knot", coats),
            ("interface_eta_knot", coats),
            ("interface_alpha_knot", coats),
            ("interface_cosine_knot", coats),
            ("interface_along", coats),
            ("interface_plane", coats),
            ("interface_quotient", coats),
            ("interface_layer_left", coats),
        ],
    );
}

/// One at least for every module.
pub(crate) const FAULTS: [Fault; 13] = [
    fault(
        "spline_weights",
        "energy/spline",
        "two_thirds = 2.0 / 3.0",
        "two_thirds = 0.6667",
    ),
    fault(
        "stencil_sums",
        "energy/stencil",
        "let c = a - 2.0",
        "let c = a - 2.0001",
    ),
    fault(
        "coordinates_of_alpha_pair",
        "energy/coordinates",
        "= 0.007070891041799",
        "= 0.00708",
    ),
    fault(
        "albedo_losses",
        "energy/albedo",
        "START: u32 = 1968u",
        "START: u32 = 1969u",
    ),
    fault("albedo_losses", "energy/pairs", "high + 1u", "high"),
    fault(
        "dielectric_albedo_losses",
        "energy/dielectric_albedo",
        "= 0.1414213562373",
        "= 0.1415",
    ),
    fault("fit_loss", "energy/fit", "-0.377557", "-0.377657"),
    fault("fit_loss", "energy/fit", "95.985019", "95.985119"),
    fault(
        "model_bounces",
        "energy/model",
        "(1.0 - loss)",
        "(1.0001 - loss)",
    ),
    fault(
        "fresnel_average_channels",
        "energy/fresnel_average",
        "0.801986582126392) * 0.334349276188739\n        + reflectance_eval",
        "0.801986582126392) * 0.3344\n        + reflectance_eval",
    ),
    fault(
        "interface_shares",
        "energy/interface",
        "(10.0 / 11.0)",
        "0.91",
    ),
    fault(
        "interface_shares",
        "energy/interface_single",
        "= 902051u",
        "= 902052u",
    ),
    fault(
        "interface_layer_shares",
        "energy/interface_layer",
        "= 902476u",
        "= 902475u",
    ),
];

#[test]
fn wrong_constants_are_caught() {
    catch("energy", &cases(), &FAULTS);
}
