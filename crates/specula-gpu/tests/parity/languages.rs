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
use crate::cpp::{FAMILIES, Family, OPTIMISED_FLAGS, by_family, faults, optimised_outcomes};
use crate::harness::{Case, Fault, Outcome, judge};
use compilers::Target;
use page::{Figure, Setting};
use specula_shaders::Language;
use vulkan::Vulkan;

/// The families whose SPIR-V runs on a device: a driver in software takes minutes for lobes, layers and walks.
const ON_DEVICE: [&str; 4] = ["math", "ndf", "vndf", "fresnel"];

fn is_on_device(family: &str) -> bool {
    ON_DEVICE.contains(&family)
}

/// What cases give in a language; on a device where it is given one.
fn outcomes(
    target: &Target,
    device: Option<&Vulkan>,
    cases: &[Case],
    fault: Option<&Fault>,
) -> Vec<Outcome> {
    let cases: Vec<&Case> = cases.iter().collect();
    let values = target.run(device, &cases, fault);
    let judged = cases.iter().zip(&values);
    judged
        .map(|(case, values)| judge(case, values, case.results(), [Duration::ZERO; 2]))
        .collect()
}

/// Whether something runs here: on a device where there is one, or by g++ where that is installed.
fn is_runnable(targets: &[Target], on_device: bool, device: Option<&Vulkan>) -> bool {
    match on_device {
        true => device.is_some(),
        false => targets.iter().any(Target::is_program),
    }
}

/// Families of a language that are one program or one shader module.
struct Job<'a> {
    target: &'a Target,
    families: Vec<Family>,
    on_device: bool,
}

impl<'a> Job<'a> {
    /// What is to be done in a language.
    fn of(target: &'a Target) -> Vec<Self> {
        let job = |families: Vec<Family>, on_device| Self {
            target,
            families,
            on_device,
        };
        let (on_device, others): (Vec<Family>, Vec<Family>) =
            FAMILIES.iter().partition(|family| is_on_device(family.0));
        match target.is_program() {
            true => vec![job(FAMILIES.to_vec(), false)],
            false => vec![job(others, false), job(on_device, true)],
        }
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
    let jobs: Vec<Job<'_>> = targets
        .iter()
        .flat_map(Job::of)
        .filter(|job| is_runnable(&targets, job.on_device, probe.as_ref()))
        .collect();
    let figures = Mutex::new(Vec::new());
    let failures = Mutex::new(Vec::new());
    in_parallel(&jobs, |job, device| {
        let start = Instant::now();
        let target = job.target;
        let cases: Vec<Vec<Case>> = job.families.iter().map(|family| family.1()).collect();
        let device = device.filter(|_| job.on_device);
        let outcomes = by_family(&cases, outcomes(target, device, &cases.concat(), None));
        for ((family, _), outcomes) in job.families.iter().zip(&outcomes) {
            let figure = Figure::of(target.language, family, outcomes);
            println!(
                "{} ({}): {family}: {} cases, errors up to {:.2} of their bounds",
                target.language, target.version, figure.cases, figure.error
            );
            figures.lock().unwrap().push(figure);
            let failed = outcomes
                .iter()
                .filter(|o| !o.is_pass(is_exact || !job.on_device));
            let failed = failed.map(|o| format!("{}: {}", target.language, o.failure()));
            failures.lock().unwrap().extend(failed);
        }
        println!(
            "{}: {:.1} s",
            target.language,
            start.elapsed().as_secs_f64()
        );
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
    for ((family, _), outcomes) in FAMILIES.iter().zip(optimised_outcomes().iter()) {
        figures.push(Figure::of(Language::Cpp, family, outcomes));
    }
    let both = format!("{}; the processor, as C++14", gpu.adapter.name);
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
    let start = Instant::now();
    let cases: Vec<Case> = FAMILIES.iter().flat_map(|family| family.1()).collect();
    slang.compile_slang(&cases.iter().collect::<Vec<_>>());
    let seconds = start.elapsed().as_secs_f64();
    println!("{} cases in Slang, {seconds:.1} s", cases.len());
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
        .filter(|(target, family, _)| {
            let on_device = is_on_device(family.0) && !target.is_program();
            is_runnable(&targets, on_device, probe.as_ref())
        })
        .collect();
    in_parallel(&jobs, |(target, (family, cases), fault), device| {
        let cases = cases();
        let case = cases.iter().find(|c| c.name == fault.case).unwrap();
        let case = std::slice::from_ref(case);
        let device = device.filter(|_| is_on_device(family));
        let error = outcomes(target, device, case, Some(fault))[0].shader;
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
