//! Slang's derivatives of the library: `fwd_diff` and `bwd_diff` by alpha of functions that are marked
//! `[Differentiable]`, beside central differences of Rust in `f64`.
//!
//! slangc writes C++, which g++ compiles; skipped, loudly, where one is not installed.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod tools;

use specula_bsdf::bsdf::{KullaConty, RoughConductor};
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::{Vec3, rgb, vec3};
use specula_bsdf::ndf::{Ggx, Ndf};
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Bsdf, Transport};
use specula_shaders::{Language, export};
use specula_testing::compilers;
use tools::Folder;

/// The view and the light.
const WO: [f64; 3] = [0.6, 0.0, 0.8];
const WI: [f64; 3] = [-0.48, 0.36, 0.8];

/// Alphas, apart from the borders of branches.
const ALPHAS: [f64; 3] = [0.1, 0.35, 0.8];

/// Functions of alpha in Slang, and the same in Rust.
type Case = (&'static str, fn(f64) -> f64);

const CASES: [Case; 8] = [
    ("ggx_d(float2(a), normalize(WO + WI))", |a| {
        ggx(a).d((wo() + wi()).normalize())
    }),
    ("ggx_lambda(float2(a), WO)", |a| ggx(a).lambda(wo())),
    ("ggx_g_correlated(float2(a), WO, WI)", |a| {
        ggx(a).g2_correlated(wo(), wi())
    }),
    ("cap_reflection_pdf(float2(a), WO, WI)", |a| {
        pdf(a, Sampler::Cap)
    }),
    ("bounded_reflection_pdf(float2(a), WO, WI)", |a| {
        pdf(a, Sampler::Bounded)
    }),
    ("exact_reflection_pdf(float2(a), WO, WI)", |a| {
        pdf(a, Sampler::Exact)
    }),
    (
        "kulla_conty_eval(kulla_conty_new(a, gold()), WO, WI, 0u).y",
        |a| {
            let metal = KullaConty::new(a, Reflectance::Conductor(gold()));
            metal.eval(wo(), wi(), Transport::Radiance).to_array()[1]
        },
    ),
    ("rough_conductor_eval(rough(a), WO, WI, 0u).y", |a| {
        let rough = RoughConductor::new(ggx(a), Reflectance::Conductor(gold()));
        rough.eval(wo(), wi(), Transport::Radiance).to_array()[1]
    }),
];

fn wo() -> Vec3<f64> {
    vec3(WO[0], WO[1], WO[2])
}

fn wi() -> Vec3<f64> {
    vec3(WI[0], WI[1], WI[2])
}

fn ggx(alpha: f64) -> Ggx<f64> {
    Ggx::new(Alpha::isotropic(alpha))
}

fn gold() -> Conductor<f64> {
    Conductor {
        eta: rgb(0.143, 0.375, 1.442),
        k: rgb(3.983, 2.386, 1.603),
    }
}

fn pdf(alpha: f64, sampler: Sampler) -> f64 {
    let metal = RoughConductor::new(ggx(alpha), Reflectance::Conductor(gold()));
    metal.with_sampler(sampler).pdf(wo(), wi())
}

/// A compute shader that writes both derivatives of each function at each alpha.
fn program() -> String {
    let vector = |[x, y, z]: [f64; 3]| format!("float3({x}, {y}, {z})");
    let mut text = format!(
        "import specula;\n\nstatic const float3 WO = {};\nstatic const float3 WI = {};\n\
         RWStructuredBuffer<float> results;\n\n{}",
        vector(WO),
        vector(WI),
        include_str!("tools/differentiable.slang")
    );
    let mut body = String::new();
    for (at, (call, _)) in CASES.iter().enumerate() {
        text += &format!("[Differentiable]\nfloat f{at}(float a)\n{{\n    return {call};\n}}\n\n");
        for (row, alpha) in ALPHAS.iter().enumerate() {
            let place = 2 * (at * ALPHAS.len() + row);
            body += &format!(
                "    results[{place}] = fwd_diff(f{at})(diffPair({alpha}, 1.0)).d;\n    \
                 DifferentialPair<float> p{place} = diffPair({alpha});\n    \
                 bwd_diff(f{at})(p{place}, 1.0);\n    results[{}] = p{place}.d;\n",
                place + 1
            );
        }
    }
    text + &format!("[shader(\"compute\")]\n[numthreads(1, 1, 1)]\nvoid derive()\n{{\n{body}}}\n")
}

/// How many derivatives are not those of Rust.
fn faults(printed: &str) -> usize {
    let derivatives: Vec<f64> = printed.lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(derivatives.len(), 2 * CASES.len() * ALPHAS.len());
    let mut faults = 0;
    let mut pairs = derivatives.chunks(2);
    for (_, function) in CASES {
        for alpha in ALPHAS {
            let step = 1e-5 * alpha;
            let expected = (function(alpha + step) - function(alpha - step)) / (2.0 * step);
            let most = 2e-5 * (expected.abs() + function(alpha).abs());
            let pair = pairs.next().unwrap();
            // No NaN is near anything.
            let near = pair.iter().filter(|d| (*d - expected).abs() <= most);
            faults += pair.len() - near.count();
        }
    }
    faults
}

#[test]
fn derivatives_by_alpha_are_those_of_rust() {
    let (Some(slangc), Some(gcc)) = (
        compilers::slangc("Slang's derivatives"),
        tools::program("g++", "Slang's derivatives"),
    ) else {
        return;
    };
    let folder = Folder::with(&export(Language::Slang, &[]).unwrap());
    folder.write("derive.slang", &program());
    folder.write("main.cpp", include_str!("tools/differentiable.cpp"));
    let count = format!("-DDERIVATIVES={}", 2 * CASES.len() * ALPHAS.len());
    let derive = || {
        let slang = "derive.slang -target cpp -entry derive -stage compute -O0 -o derive.cpp";
        folder.accepted(&slangc, &slang.split(' ').collect::<Vec<_>>());
        folder.accepted(
            &gcc,
            &["-std=c++17", "-w", &count, "main.cpp", "-o", "derive"],
        );
        faults(&folder.printed("derive"))
    };
    assert_eq!(derive(), 0);
    // One derivative that is cut off: that of the distribution.
    let library = folder.read("specula.slang");
    let from = "    float area = (alpha.x * alpha.y);";
    assert!(library.contains(from));
    folder.write(
        "specula.slang",
        &library.replacen(from, "    float area = detach(alpha.x * alpha.y);", 1),
    );
    assert!(derive() > 0);
}
