//! The same cases in the other languages that the library is exported to, as their own compilers take them: GLSL and
//! HLSL as SPIR-V of glslang and DXC, Slang as that of slangc, the exported SPIR-V linked; Metal as C++. That SPIR-V
//! runs on a Vulkan device, or on the processor by a program that has a statement for each of its instructions.
//!
//! `docs/shaders/parity.md` is made from them. To make it anew:
//! `SPECULA_WRITE=1 cargo test -p specula-gpu --test parity languages::`.
#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod compilers;
mod entries;
mod page;
mod spirv;
mod vulkan;

use std::sync::Mutex;
use std::time::{Duration, Instant};

use specula_gpu::AdapterKind;

use crate::common::gpu;
use crate::cpp::{FAMILIES, Family, OPTIMISED_FLAGS, faults, optimised_outcomes};
use crate::harness::{Case, Fault, Outcome, judge};
use compilers::Target;
use page::{Figure, Setting};
use specula_shaders::Language;
use vulkan::Vulkan;

/// The families of [`FAMILIES`], those that take longest first.
const ORDER: [usize; 8] = [7, 5, 6, 4, 2, 1, 3, 0];
/// Those whose SPIR-V runs on a device: a driver in software takes minutes for lobes, layers and multiple bounces.
const ON_DEVICE: [&str; 4] = ["math", "ndf", "vndf", "fresnel"];

fn is_on_device(family: &str) -> bool {
    ON_DEVICE.contains(&family)
}

/// What the cases of a family give in a language.
fn outcomes(
    target: &Target,
    device: Option<&Vulkan>,
    (family, cases): (&str, &[Case]),
    fault: Option<&Fault>,
) -> Vec<Outcome> {
    let cases: Vec<&Case> = cases.iter().collect();
    let device = device.filter(|_| is_on_device(family));
    let values = target.run(device, &cases, fault);
    let judged = cases.iter().zip(&values);
    judged
        .map(|(case, values)| judge(case, values, case.results(), [Duration::ZERO; 2]))
        .collect()
}

/// Whether a family runs in a language: on a device where there is one, else by g++ where that is installed.
fn is_runnable(targets: &[Target], target: &Target, family: &str, device: Option<&Vulkan>) -> bool {
    match is_on_device(family) && !target.is_program() {
        true => device.is_some(),
        false => targets.iter().any(Target::is_program),
    }
}

/// A Vulkan device that takes SPIR-V as it is, or a line that says what was skipped.
#[track_caller]
fn device(what: &str) -> Option<Vulkan> {
    let gpu = gpu(what)?;
    match Vulkan::open(gpu) {
        Ok(device) => Some(device),
        Err(reason) => {
            specula_testing::not_of_this_machine(what, reason);
            None
        }
    }
}

/// Does each of the jobs once, on as many threads as there are processors.
fn in_parallel<T: Sync>(jobs: &[T], work: impl Fn(&T, Option<&Vulkan>) + Sync) {
    let next = Mutex::new(jobs.iter());
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let device = device("SPIR-V of other compilers");
                loop {
                    let job = next.lock().unwrap().next();
                    let Some(job) = job else { break };
                    work(job, device.as_ref());
                }
            });
        }
    });
}

#[test]
fn every_language_agrees() {
    let what = "GLSL, HLSL and SPIR-V";
    let (targets, probe) = (Target::all(), device(what));
    let is_exact = gpu(what).is_none_or(|g| g.adapter.kind == AdapterKind::Software);
    let families = ORDER.map(|k| &FAMILIES[k]);
    let jobs: Vec<(&Family, &Target)> = families
        .iter()
        .flat_map(|family| targets.iter().map(move |target| (*family, target)))
        .filter(|(family, target)| is_runnable(&targets, target, family.0, probe.as_ref()))
        .collect();
    let figures = Mutex::new(Vec::new());
    let failures = Mutex::new(Vec::new());
    in_parallel(&jobs, |(family, target), device| {
        let start = Instant::now();
        let outcomes = outcomes(target, device, (family.0, &family.1()), None);
        let figure = Figure::of(target.language, family.0, &outcomes);
        println!(
            "{} ({}): {}: {} cases, errors up to {:.2} of their bounds, {:.1} s",
            target.language,
            target.version,
            family.0,
            outcomes.len(),
            figure.error,
            start.elapsed().as_secs_f64()
        );
        figures.lock().unwrap().push(figure);
        let failed = outcomes
            .iter()
            .filter(|o| !o.is_pass(is_exact || target.is_program() || !is_on_device(family.0)));
        let failed = failed.map(|o| format!("{}: {}", target.language, o.failure()));
        failures.lock().unwrap().extend(failed);
    });
    let failures = failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    check_page(&targets, figures.into_inner().unwrap());
}

/// Compares the page of figures, or writes it; nothing where a language is missing or the GPU is a real one.
fn check_page(targets: &[Target], mut figures: Vec<Figure>) {
    let Some(gpu) = gpu("the page of figures") else {
        return;
    };
    if targets.len() < Target::COUNT || gpu.adapter.kind != AdapterKind::Software {
        return;
    }
    for family in &FAMILIES {
        let cpp = optimised_outcomes(family);
        figures.push(Figure::of(Language::Cpp, family.0, &cpp));
    }
    let both = format!("{}; the processor, as C++17", gpu.adapter.name);
    let setting = |language, compiler: &str, runs_on: &str| Setting {
        language,
        compiler: compiler.to_owned(),
        runs_on: runs_on.to_owned(),
    };
    let gcc = targets.iter().find(|target| target.is_program());
    let gcc = gcc.map_or("", |target| &target.version);
    let flags = OPTIMISED_FLAGS.join(" ");
    let of_targets = targets.iter().map(|target| match target.is_program() {
        true => setting(target.language, gcc, "the processor, as C++14"),
        false => setting(target.language, &target.version, &both),
    });
    let mut settings: Vec<Setting> = of_targets.collect();
    settings.push(setting(
        Language::Cpp,
        &format!("{gcc}, {flags}"),
        "the processor",
    ));
    let families = FAMILIES.map(|(family, _)| (family, is_on_device(family)));
    let measured = page::page(&families, &settings, &figures);
    println!("{measured}");
    if std::env::var_os("SPECULA_WRITE").is_some() {
        std::fs::write(page::PATH, &measured).unwrap();
    }
    let written = std::fs::read_to_string(page::PATH).unwrap_or_default();
    assert!(
        page::is_current(&written, &measured),
        "docs/shaders/parity.md is not current; run\n\
         SPECULA_WRITE=1 cargo test -p specula-gpu --test parity languages::"
    );
}

/// Slang takes the modules of all families, and makes HLSL and CUDA of them beside SPIR-V.
#[test]
fn slang_takes_every_family() {
    let targets = Target::all();
    let Some(slang) = targets.iter().find(|t| t.language == Language::Slang) else {
        return;
    };
    for (family, cases) in FAMILIES {
        let start = Instant::now();
        let cases = cases();
        slang.compile_slang(&cases.iter().collect::<Vec<_>>());
        let seconds = start.elapsed().as_secs_f64();
        println!("{family}: {} cases, {seconds:.1} s", cases.len());
    }
}

/// A fault of each family is planted in each language, another one in each.
#[test]
fn planted_faults_are_noticed() {
    let probe = device("faults in GLSL, HLSL and SPIR-V");
    let targets = Target::all();
    let faults = faults();
    let jobs: Vec<_> = targets
        .iter()
        .enumerate()
        .flat_map(|(k, target)| {
            let one = move |(family, faults): &(Family, Vec<Fault>)| {
                (target, *family, faults[k % faults.len()])
            };
            faults.iter().map(one)
        })
        .filter(|(target, family, _)| is_runnable(&targets, target, family.0, probe.as_ref()))
        .collect();
    in_parallel(&jobs, |(target, (family, cases), fault), device| {
        let cases = cases();
        let case = cases.iter().find(|c| c.name == fault.case).unwrap();
        let case = std::slice::from_ref(case);
        let error = outcomes(target, device, (family, case), Some(fault))[0].shader;
        let bound = case[0].bound;
        println!(
            "{}: {family}: '{}' for '{}': {error:.3e} ulps of {bound}",
            target.language, fault.to, fault.from
        );
        assert!(
            error > bound,
            "{}: '{}' for '{}' goes unnoticed: {error} ulps",
            target.language,
            fault.to,
            fault.from
        );
    });
}
