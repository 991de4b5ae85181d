//! The examples and a program of wrong calls: compiled without warnings, run against the libraries of this build.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod tools;

use std::fs;

use specula_bsdf::batch::{Directions, Level, Samples};
use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::vec3;
use specula_bsdf::metals::by_symbol;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Rgb, Transport};
use tools::{Library, Program, here, text};

/// What `furnace.c` prints, by the library itself.
fn albedo() -> String {
    let gold = by_symbol("Au").unwrap();
    let index = Conductor {
        eta: Rgb::from(gold.eta).cast(),
        k: Rgb::from(gold.k).cast(),
    };
    let alpha = Alpha::isotropic(0.3_f32);
    let lobe = RoughConductor::new(Ggx::new(alpha), Reflectance::Conductor(index));
    let n = 65_536;
    let mut state = 1_u32;
    let mut uniform = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    };
    let mut lines = String::new();
    for wo in [
        vec3(0.0, 0.0, 1.0),
        vec3(0.8, 0.0, 0.6),
        vec3(0.96, 0.0, 0.28),
    ] {
        let mut u = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
        for i in 0..n {
            u.iter_mut().for_each(|u| u[i] = uniform());
        }
        let views: Directions<Vec<f32>> = (0..n).map(|_| wo).collect();
        let mut samples = Samples::rejected(n);
        let u = u.each_ref().map(|u| &u[..]);
        let (transport, to) = (Transport::Radiance, samples.as_mut_slices());
        (Level::best().sample(&lobe, views.as_slices(), u, transport, to)).unwrap();
        let weights = &samples.weight;
        let [r, g, b] = [&weights.r, &weights.g, &weights.b]
            .map(|w| w.iter().map(|&w| f64::from(w) / 65_536.0).sum::<f64>());
        lines += &format!("{r:.9} {g:.9} {b:.9}\n");
    }
    lines
}

#[test]
fn the_furnace_prints_what_the_library_computes() {
    let expected = albedo();
    for library in [Library::Shared, Library::Static] {
        if let Some(program) = Program::compiled("examples/furnace.c", library) {
            assert_eq!(program.printed(&[]), expected);
        }
    }
    let gold: Vec<f64> = (expected.split_whitespace())
        .map(|n| n.parse().unwrap())
        .collect();
    assert!(gold[0] > 0.8 && gold[2] < 0.4, "{gold:?}");
}

#[test]
fn the_render_writes_a_picture() {
    let Some(program) = Program::compiled("examples/render.cpp", Library::Shared) else {
        return;
    };
    assert_eq!(program.printed(&["orbs.png"]), "100 %\n");
    let png = fs::read(program.folder().join("orbs.png")).unwrap();
    assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n");
    // Width and height of the first chunk.
    assert_eq!(png[16..24], [0, 0, 0, 96, 0, 0, 0, 40]);
    let colours: std::collections::HashSet<u8> = png[100..].iter().copied().collect();
    assert!(colours.len() > 100, "the picture is of one colour");
    for (arguments, said) in [(vec![], "usage: render FILE"), (vec!["no/a.png"], "no/")] {
        let output = program.run(&arguments);
        assert!(!output.status.success());
        assert!(text(&output).contains(said), "{}", text(&output));
    }
}

#[test]
fn wrong_calls_get_a_status_and_a_message() {
    let source = "tests/c/wrong_calls.c";
    let program = fs::read_to_string(here().join(source)).unwrap();
    let header = fs::read_to_string(here().join("include/specula.h")).unwrap();
    for declared in header.lines().filter(|l| !l.starts_with([' ', '/', '#'])) {
        let name = declared.split('(').next().unwrap();
        let Some(start) = name.find("specula_").filter(|_| declared.contains('(')) else {
            continue;
        };
        let name = name[start..].rsplit(' ').next().unwrap().trim_matches('*');
        assert!(
            declared.starts_with("typedef") || program.contains(&format!("{name}(")),
            "{source} does not call {name}"
        );
    }
    for source in [source, "tests/c/whole.cpp"] {
        if let Some(program) = Program::compiled(source, Library::Shared) {
            assert!(program.printed(&[]).ends_with("all as expected\n"));
        }
    }
}
