//! C++ as compilers take it: without warnings, and in several files of one program; and a worked example whose
//! figures are those of Rust. Values are compared by the suite `parity` of specula-gpu.
//!
//! `g++` and `clang++` are skipped, loudly, where they are not installed.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod tools;

use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::internal::interface;
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::{Sampler, bounded};
use specula_bsdf::{Alpha, Bsdf, Frame, Transport};
use specula_shaders::{Export, Language, export};
use std::path::PathBuf;
use tools::{Folder, STRICT};

/// Ways of optimising.
const LEVELS: [&[&str]; 3] = [&["-O0"], &["-O2"], &["-O3", "-ffast-math"]];

/// The compilers that are installed; a line for each that is not.
#[track_caller]
fn compilers(what: &str) -> Vec<PathBuf> {
    let names = ["g++", "clang++"];
    let found = names
        .into_iter()
        .filter_map(|name| tools::program(name, &format!("{what} by {name}")));
    found.collect()
}

#[test]
fn all_of_it_compiles_without_warnings() {
    for compiler in compilers("C++ without warnings") {
        let folder = Folder::with(&export(Language::Cpp, &[]).unwrap());
        folder.write(
            "whole.cpp",
            "#include \"specula.hpp\"\n#include \"specula.hpp\"\nint main() {}\n",
        );
        // Functions that nobody calls are compiled, too.
        let kept: &[&str] = match compiler.ends_with("g++") {
            true => &["-fkeep-inline-functions"],
            false => &[],
        };
        for level in LEVELS {
            folder.accepted(
                &compiler,
                &[STRICT, level, kept, &["-c", "whole.cpp"]].concat(),
            );
        }
        let text = folder.read("specula.hpp");
        folder.write(
            "specula.hpp",
            &text.replacen("return alpha", "return alphas", 1),
        );
        folder.refused(&compiler, &[STRICT, &["-c", "whole.cpp"]].concat());
    }
}

/// The albedo of gold that the example prints, with the same random numbers.
fn albedo() -> String {
    let index = Conductor {
        eta: rgb(0.143, 0.375, 1.442),
        k: rgb(3.983, 2.386, 1.603),
    };
    let gold = RoughConductor::new(
        Ggx::new(Alpha::isotropic(0.3_f32)),
        Reflectance::Conductor(index),
    );
    let gold = gold.with_sampler(Sampler::Bounded);
    let mut state = 1_u32;
    let mut uniform = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f32::from(u16::try_from(state >> 16).unwrap()) * 256.0 * 5.960_464_5e-8
            + f32::from(u8::try_from(state >> 8 & 255).unwrap()) * 5.960_464_5e-8
    };
    let mut lines = String::new();
    for wo in [
        vec3(0.0, 0.0, 1.0),
        vec3(0.8, 0.0, 0.6),
        vec3(0.96, 0.0, 0.28),
    ] {
        let mut sum = [0.0_f64; 3];
        for _ in 0..65_536 {
            let u = [0.0, uniform(), uniform()];
            if let Some(sampled) = gold.sample(wo, u, Transport::Radiance) {
                let weight = sampled.weight.to_array().map(f64::from);
                sum = std::array::from_fn(|c| sum[c] + weight[c]);
            }
        }
        let [r, g, b] = sum.map(|s| s / 65_536.0);
        lines += &format!("{r:.4} {g:.4} {b:.4}\n");
    }
    lines
}

/// Numbers of a text.
fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect()
}

/// Panics unless the numbers of two texts are the same but for `error`.
fn assert_near(printed: &str, expected: &str, error: f64) {
    let (got, known) = (numbers(printed), numbers(expected));
    let near = got.iter().zip(&known).all(|(a, b)| (a - b).abs() <= error);
    assert!(
        got.len() == known.len() && near,
        "{printed}instead of\n{expected}"
    );
}

#[test]
fn the_example_prints_the_albedo_of_gold() {
    for compiler in compilers("the example in C++") {
        let files = export(Language::Cpp, Language::Cpp.example_modules()).unwrap();
        let folder = Folder::with(&files);
        for level in LEVELS {
            let output = ["example.cpp", "-o", "example"];
            folder.accepted(&compiler, &[STRICT, level, &output].concat());
            assert_near(&folder.printed("example"), &albedo(), 2e-4);
        }
        let text = folder.read("specula.hpp");
        folder.write(
            "specula.hpp",
            &text.replacen(
                "return BsdfSample{wi, pdf, weight",
                "return BsdfSample{wi, pdf, 0.99f * weight",
                1,
            ),
        );
        folder.accepted(
            &compiler,
            &[STRICT, &["example.cpp", "-o", "example"]].concat(),
        );
        let printed = numbers(&folder.printed("example"));
        assert!(
            (printed[0] - numbers(&albedo())[0]).abs() > 2e-4,
            "a wrong weight is not noticed"
        );
    }
}

#[test]
fn files_of_a_program_share_the_tables() {
    let local = Frame::from_normal(vec3(0.0, 0.6, 0.8)).to_local(vec3(0.0_f64, 0.6, 0.8));
    let coat = Some(Ggx::new(Alpha::isotropic(0.4)));
    let expected = format!(
        "0 4294967040 2 1065353216\n{:.3} {:.3} {:.3}\n{:.6}\n",
        local.x,
        local.y,
        local.z,
        interface::transmittance(coat, 1.5, 0.5)
    );
    for compiler in compilers("tables in C++") {
        let folder = Folder::with(&export(Language::Cpp, &[]).unwrap());
        folder.write("first.cpp", include_str!("tools/first.cpp"));
        folder.write("second.cpp", include_str!("tools/second.cpp"));
        for level in LEVELS {
            let output = ["first.cpp", "second.cpp", "-o", "program"];
            folder.accepted(&compiler, &[STRICT, level, &output].concat());
            assert_near(&folder.printed("program"), &expected, 2e-6);
        }
    }
}

/// The largest relative error of the densities that `order.cpp` prints, beside Rust in `f64`.
fn error_of_densities(printed: &str) -> f64 {
    let lines: Vec<Vec<f64>> = printed.lines().map(numbers).collect();
    assert_eq!(lines.len(), 3 * 3 * 64);
    let errors = lines.iter().map(|line| {
        let wi = vec3(line[4], line[5], line[6]);
        let alpha = Alpha::isotropic(line[0]);
        let pdf = bounded::reflection_pdf(alpha, vec3(line[1], line[2], line[3]), wi);
        match pdf > 0.0 {
            true => (line[7] / pdf - 1.0).abs(),
            false => line[7],
        }
    });
    errors.fold(0.0, f64::max)
}

/// Densities are those of the directions that are returned. Where sums lose their order, a compiler that has the sampler
/// in view takes the direction before rounding, and is wrong by 0.6 % here.
#[test]
fn sums_keep_their_order_in_short_headers() {
    let export = Export {
        functions: &["bounded_sample_direction", "bounded_reflection_pdf"],
        ..Export::new(Language::Cpp)
    };
    for compiler in compilers("the order of sums in C++") {
        let folder = Folder::with(&export.files().unwrap());
        folder.write("order.cpp", include_str!("tools/order.cpp"));
        let build = [
            STRICT,
            &["-O3", "-ffast-math", "order.cpp", "-o", "order", "-lm"],
        ]
        .concat();
        folder.accepted(&compiler, &build);
        let error = error_of_densities(&folder.printed("order"));
        assert!(error < 1e-5, "{}: {error}", compiler.display());
        let header = folder.read("specula.hpp");
        let (pragmas, lines): (Vec<&str>, Vec<&str>) = header
            .lines()
            .partition(|line| line.starts_with("#pragma "));
        assert_eq!(pragmas.len(), 6);
        folder.write("specula.hpp", &lines.join("\n"));
        folder.accepted(&compiler, &build);
        let error = error_of_densities(&folder.printed("order"));
        assert!(error > 1e-3, "{}: {error}", compiler.display());
    }
}

/// The benchmark compiles without warnings and tells a time for each sampler.
#[test]
fn the_benchmark_runs() {
    for compiler in compilers("the benchmark in C++") {
        let folder = Folder::with(&export(Language::Cpp, &[]).unwrap());
        folder.write("speed.cpp", include_str!("../benches/sample_speed.cpp"));
        folder.accepted(
            &compiler,
            &[STRICT, &["-O2", "speed.cpp", "-o", "speed"]].concat(),
        );
        let printed = folder.printed("speed");
        let mut names = Vec::new();
        for line in printed.lines() {
            let (name, nanoseconds) = line.split_once(' ').unwrap();
            let nanoseconds: f64 = nanoseconds.parse().unwrap();
            assert!(nanoseconds > 0.0 && nanoseconds < 1e5, "{line}");
            names.push(name);
        }
        let expected = ["", "-direction"].map(|end| {
            ["heitz", "cap", "bounded", "exact"].map(|sampler| format!("{sampler}{end}"))
        });
        assert_eq!(names, expected.concat());
    }
}

/// The chi-square tests that go with the header, as users build them; and whether they notice faults.
#[test]
fn samples_follow_their_densities() {
    let Some(make) = tools::program("make", "chi-square tests in C++") else {
        return;
    };
    let folder = Folder::with(&export(Language::Cpp, &[]).unwrap());
    let strict = format!("CXXFLAGS=-O2 {}", STRICT[1..].join(" "));
    for compiler in compilers("chi-square tests in C++") {
        let compiler = format!("CXX={}", compiler.display());
        folder.accepted(&make, &["-B", &compiler, &strict, "check"]);
    }
    let header = folder.read("specula.hpp");
    for (from, to, subject) in [
        // A density a thirtieth too small.
        (
            "bounded_height(alpha, wo, lengths), 2.0f",
            "bounded_height(alpha, wo, lengths), 2.07f",
            "bounded",
        ),
        // Less of the cap.
        (
            "u.x * bounded_height(",
            "0.97f * u.x * bounded_height(",
            "bounded",
        ),
        // Refraction by another index.
        (
            "const RoughDielectric& lobe, vec3f wo, vec3f u, uint32_t transport) {",
            "const RoughDielectric& lobe_, vec3f wo, vec3f u, uint32_t transport) {\n    RoughDielectric lobe = lobe_; lobe.eta *= 1.02f;",
            "rough dielectric",
        ),
    ] {
        assert!(header.matches(from).count() == 1, "{from}");
        folder.write("specula.hpp", &header.replace(from, to));
        folder.accepted(&make, &["-B", "chi_square"]);
        let program = folder.path().join("chi_square");
        folder.accepted(&program, &["energy_tables.bin", "Lambert"]);
        folder.refused(&program, &["energy_tables.bin", subject]);
    }
}
