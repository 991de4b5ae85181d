//! Distributions of microfacet normals and their masking.

use specula_bsdf::ndf::{Beckmann, Ggx, Masking, Ndf};

use crate::harness::{
    ABOVE, ALPHAS, AZIMUTHS, BELOW, Case, Fault, alpha, assert_covered, both_sides, catch, prove,
    round, twins, vector, views,
};

/// Views of the grid, along the normal against it, and along the surface.
fn all_views() -> Vec<[f32; 3]> {
    let edges = [
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
        [1.0, 0.0, 0.0],
        [0.6, -0.8, 1e-6],
    ];
    [both_sides(), edges.to_vec()].concat()
}

/// Alphas, then normals: of the grid, and of slopes about as large as the alphas.
fn alphas_and_normals() -> Vec<[f32; 5]> {
    let mut rows = Vec::new();
    for [ax, ay] in ALPHAS {
        for wm in [views(&ABOVE), views(&BELOW)].concat() {
            rows.push([ax, ay, wm[0], wm[1], wm[2]]);
        }
        for radius in [0.0, 0.1, 0.5, 1.0, 2.0, 6.0] {
            for azimuth in AZIMUTHS {
                let x = radius * f64::from(ax) * azimuth.cos();
                let y = radius * f64::from(ay) * azimuth.sin();
                let inverse = 1.0 / (x * x + y * y + 1.0).sqrt();
                let wm = [x * inverse, y * inverse, inverse].map(round);
                rows.push([ax, ay, wm[0], wm[1], wm[2]]);
            }
        }
    }
    rows
}

/// Alphas and a view.
fn alphas_and_views() -> Vec<[f32; 5]> {
    let of = |[ax, ay]: [f32; 2]| {
        all_views()
            .into_iter()
            .map(move |w| [ax, ay, w[0], w[1], w[2]])
    };
    ALPHAS.into_iter().flat_map(of).collect()
}

/// Alphas and two directions; of `wo` straight from below only the masking is asked.
fn alphas_and_pairs() -> Vec<[f32; 8]> {
    let pair = |[ax, ay, x, y, z]: [f32; 5]| {
        let lights = all_views().into_iter();
        lights.map(move |wi| [ax, ay, x, y, z, wi[0], wi[1], wi[2]])
    };
    alphas_and_views().into_iter().flat_map(pair).collect()
}

/// Statements of a case about masking, for `ggx` or `beckmann`.
macro_rules! masking_body {
    ($name:literal) => {
        concat!(
            "let alpha = vec2f(x[0], x[1]);
             let wo = vec3f(x[2], x[3], x[4]);
             let wi = vec3f(x[5], x[6], x[7]);
             y[0] = ",
            $name,
            "_g_single(alpha, wo);
             y[1] = ",
            $name,
            "_g_correlated(alpha, wo, wi);
             y[2] = ",
            $name,
            "_g_separable(alpha, wo, wi);
             y[3] = ",
            $name,
            "_g2_over_cos(MASKING_HEIGHT_CORRELATED, alpha, wo, wi)
                 * ",
            $name,
            "_projected_area(alpha, wo);
             y[4] = ",
            $name,
            "_g2_over_cos(MASKING_SEPARABLE, alpha, wo, wi)
                 * ",
            $name,
            "_projected_area(alpha, wo);"
        )
    };
}

/// Masking and shadowing; `G2 / |cos|` as a share of its largest value `1 / sigma(wo)`.
macro_rules! masking_twins {
    ($ndf:ident) => {
        twins!(|x| {
            let ndf = $ndf::new(alpha(x, 0));
            let (wo, wi) = (vector(x, 2), vector(x, 5));
            let over_cos = |masking| ndf.g2_over_cos(masking, wo, wi) * ndf.projected_area(wo);
            vec![
                ndf.g1(wo),
                ndf.g2_correlated(wo, wi),
                ndf.g2_separable(wo, wi),
                over_cos(Masking::HeightCorrelated),
                over_cos(Masking::Separable),
            ]
        })
    };
}

fn ggx() -> Vec<Case> {
    vec![
        Case::new(
            "ggx_density",
            &["ggx"],
            "let alpha = vec2f(x[0], x[1]);
             let wm = vec3f(x[2], x[3], x[4]);
             y[0] = ggx_d(alpha, wm);
             y[1] = ggx_d_along(alpha, 3.0 * wm, 9.0);",
            alphas_and_normals(),
            twins!(|x| {
                let d = Ggx::new(alpha(x, 0)).d(vector(x, 2));
                vec![d, d]
            }),
            24.0,
        ),
        Case::new(
            "ggx_areas",
            &["ggx"],
            "let alpha = vec2f(x[0], x[1]);
             let w = vec3f(x[2], x[3], x[4]);
             let quotient = ggx_projected_area_quotient(alpha, w);
             y[0] = ggx_projected_area(alpha, w);
             y[1] = quotient.x / quotient.y;
             y[2] = ggx_lambda_cos(alpha, w);",
            alphas_and_views(),
            twins!(|x| {
                let (ggx, w) = (Ggx::new(alpha(x, 0)), vector(x, 2));
                vec![
                    ggx.projected_area(w),
                    ggx.projected_area(w),
                    ggx.lambda_cos(w),
                ]
            }),
            12.0,
        ),
        Case::new(
            "ggx_lambdas",
            &["ggx"],
            "let alpha = vec2f(x[0], x[1]);
             let w = vec3f(x[2], x[3], x[4]);
             y[0] = ggx_lambda(alpha, w);
             y[1] = ggx_d_visible(alpha, w, vec3f(0.36, 0.48, 0.8));
             let length = ggx_stretched_length(alpha, w);
             y[2] = length.x / (length.y * length.y);",
            alphas_and_views()
                .into_iter()
                .filter(|x| x[4] != 0.0)
                .collect(),
            twins!(|x| {
                let (ggx, w) = (Ggx::new(alpha(x, 0)), vector(x, 2));
                let wm = [0.36_f32, 0.48, 0.8].map(|c| T::of(c.into()));
                let s = ggx.alpha().stretch(w);
                let radius = (s.x * s.x + s.y * s.y).at_least(T::of(1e-24));
                let share = radius / (radius + s.z * s.z);
                vec![ggx.lambda(w), ggx.d_visible(w, wm.into()), share]
            }),
            24.0,
        )
        .at_scale(&[0.0, 1e-12, 0.0]),
        Case::new(
            "ggx_masking",
            &["ggx"],
            masking_body!("ggx"),
            alphas_and_pairs(),
            masking_twins!(Ggx),
            12.0,
        )
        .at_scale(&[1e-20]),
    ]
}

fn beckmann() -> Vec<Case> {
    let seen: Vec<[f32; 8]> = alphas_and_pairs();
    vec![
        Case::new(
            "beckmann_density",
            &["beckmann"],
            "y[0] = beckmann_d(vec2f(x[0], x[1]), vec3f(x[2], x[3], x[4]));",
            alphas_and_normals(),
            twins!(|x| vec![Beckmann::new(alpha(x, 0)).d(vector(x, 2))]),
            // The exponent, up to 80, times half an ulp.
            200.0,
        )
        .at_scale(&[1e-20]),
        Case::new(
            "beckmann_areas",
            &["beckmann"],
            "let alpha = vec2f(x[0], x[1]);
             let w = vec3f(x[2], x[3], x[4]);
             y[0] = beckmann_projected_area(alpha, w);
             y[1] = beckmann_lambda_cos(alpha, w);",
            alphas_and_views(),
            twins!(|x| {
                let (ndf, w) = (Beckmann::new(alpha(x, 0)), vector(x, 2));
                vec![ndf.projected_area(w), ndf.lambda_cos(w)]
            }),
            100.0,
        )
        .at_scale(&[1e-20]),
        Case::new(
            "beckmann_lambdas",
            &["beckmann"],
            "let alpha = vec2f(x[0], x[1]);
             let w = vec3f(x[2], x[3], x[4]);
             y[0] = beckmann_lambda(alpha, w);
             y[1] = beckmann_d_visible(alpha, w, vec3f(0.36, 0.48, 0.8));",
            alphas_and_views()
                .into_iter()
                .filter(|x| x[4] > 0.0)
                .collect(),
            twins!(|x| {
                let (ndf, w) = (Beckmann::new(alpha(x, 0)), vector(x, 2));
                let wm = [0.36_f32, 0.48, 0.8].map(|c| T::of(c.into()));
                vec![ndf.lambda(w), ndf.d_visible(w, wm.into())]
            }),
            200.0,
        )
        .at_scale(&[1e-12]),
        Case::new(
            "beckmann_masking",
            &["beckmann"],
            masking_body!("beckmann"),
            seen.into_iter()
                .filter(|x| is_visible(x[0], x[1], [x[2], x[3], x[4]]))
                .collect(),
            masking_twins!(Beckmann),
            100.0,
        )
        .at_scale(&[1e-12]),
    ]
}

/// Whether a Beckmann surface shows any facet to `w`, to the precision of values.
pub(crate) fn is_visible(ax: f32, ay: f32, w: [f32; 3]) -> bool {
    let a = w[2] / (ax * w[0]).hypot(ay * w[1]);
    w[2] >= 0.0 || a * a < 40.0
}

pub(crate) fn cases() -> Vec<Case> {
    [ggx(), beckmann()].concat()
}

pub(crate) const FAULTS: [Fault; 5] = [
    Fault {
        case: "ggx_density",
        module: "ndf/ggx",
        from: "0.31830987",
        to: "0.31831987",
    },
    Fault {
        case: "ggx_areas",
        module: "ndf/ggx",
        from: "max(s.x * s.x + s.y * s.y, 1e-24)",
        to: "max(s.x * s.x + s.y * s.y, 1e-8)",
    },
    Fault {
        case: "ggx_masking",
        module: "ndf/ggx",
        from: "abs(wo.z) * (length.x * area.y)",
        to: "wo.z * (length.x * area.y)",
    },
    Fault {
        case: "beckmann_areas",
        module: "ndf/beckmann",
        from: "0.2820948",
        to: "0.2821948",
    },
    Fault {
        case: "beckmann_masking",
        module: "ndf/masking",
        from: "cosines.y * lambda_cos.x + cosines.x * lambda_cos.y",
        to: "cosines.x * lambda_cos.x + cosines.y * lambda_cos.y",
    },
];

#[test]
fn distributions_agree_with_their_twins() {
    prove("ndf", &cases());
}

#[test]
fn faults_in_distributions_are_noticed() {
    catch("ndf", &cases(), &FAULTS);
}

#[test]
fn every_function_of_distributions_has_a_case() {
    let quotient = "g2_over_cos is its quotient";
    let shared = "part of the functions of ggx and beckmann of the same name";
    let elsewhere = [
        ("ggx_g2_over_cos_quotient", quotient),
        ("beckmann_g2_over_cos_quotient", quotient),
        ("masking_g_single", shared),
        ("masking_g_correlated", shared),
        ("masking_over_cos_quotient", shared),
        ("masking_divided", shared),
    ];
    assert_covered("ndf", &cases(), &elsewhere);
}
