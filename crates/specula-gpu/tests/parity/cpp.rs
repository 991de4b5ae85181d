//! The same cases in C++: the modules and the bodies as `specula export --lang cpp` writes them, compiled by g++
//! and clang++ and run on the processor, for which no GPU is needed; and by nvcc for CUDA, where there is a GPU for it.
#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::harness::{Case, Fault, Kept, Outcome, judge, text};
use crate::{bsdf, energy, fresnel, layered, math, measured, multibounce, ndf, vndf};

/// How the cases are compiled.
struct Setting {
    flags: &'static [&'static str],
    /// By which of the compilers.
    compilers: &'static [&'static str],
    /// Whether the arithmetic is that of IEEE. Else bounds are those of real GPUs.
    is_exact: bool,
}

/// Without optimisation; by clang++, [`SANITISED`] is.
const PLAIN: Setting = Setting {
    flags: &["-O0", "-ffp-contract=off"],
    compilers: &["g++"],
    is_exact: true,
};
/// As programs are built.
const OPTIMISED: Setting = Setting {
    flags: &["-O2", "-ffp-contract=off"],
    compilers: &["g++", "clang++"],
    is_exact: true,
};
/// As renderers are built: reciprocals for quotients, no infinities.
const FAST: Setting = Setting {
    flags: &["-O3", "-ffast-math"],
    compilers: &["g++", "clang++"],
    is_exact: false,
};
/// For the processor at hand, whose sums of products may be rounded once.
const FUSED: Setting = Setting {
    flags: &["-O3", "-ffast-math", "-march=native"],
    compilers: &["g++", "clang++"],
    is_exact: false,
};
/// With undefined behaviour and accesses out of range as errors.
const SANITISED: Setting = Setting {
    flags: &[
        "-O0",
        "-ffp-contract=off",
        "-fsanitize=address,undefined,float-cast-overflow",
        "-fno-sanitize-recover=all",
    ],
    compilers: &["clang++"],
    is_exact: true,
};

/// CUDA with the arithmetic of IEEE.
const CUDA_EXACT: Setting = Setting {
    flags: &["-O3", "-arch=native", "-fmad=false"],
    compilers: &["nvcc"],
    is_exact: true,
};
/// As programs for CUDA are built: products and sums are fused.
const CUDA: Setting = Setting {
    flags: &["-O3", "-arch=native"],
    compilers: &["nvcc"],
    is_exact: false,
};
/// As renderers are built: approximate quotients and functions, no denormal numbers.
const CUDA_FAST: Setting = Setting {
    flags: &["-O3", "-arch=native", "--use_fast_math"],
    compilers: &["nvcc"],
    is_exact: false,
};

/// A family's name and its cases.
pub(crate) type Family = (&'static str, fn() -> Vec<Case>);

/// One program has them all; in CUDA each is one.
pub(crate) const FAMILIES: [Family; 9] = [
    ("math", math::cases),
    ("ndf", ndf::cases),
    ("vndf", vndf::cases),
    ("fresnel", fresnel::cases),
    ("energy", energy::cases),
    ("bsdf", bsdf::cases),
    ("layered", layered::cases),
    ("multibounce", multibounce::cases),
    ("measured", measured::cases),
];

/// Where a program runs.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Processor,
    Cuda,
}

impl Side {
    fn of(compiler: &Path) -> Self {
        match compiler.ends_with("nvcc") {
            true => Self::Cuda,
            false => Self::Processor,
        }
    }

    /// Reads the tables and the inputs, calls each case for each of its inputs, and writes the results.
    fn main(self) -> &'static str {
        match self {
            Self::Processor => include_str!("cpp/main.cpp"),
            Self::Cuda => include_str!("cpp/main.cu"),
        }
    }

    /// Tells the library where its tables are.
    fn bind(self) -> &'static str {
        match self {
            Self::Processor => "    specula::specula_tables = tables;\n",
            Self::Cuda => {
                "    const float* on_device = uploaded(tables, tables.size());
    check(cudaMemcpyToSymbol(specula::specula_tables, &on_device, sizeof on_device), \"tables\");\n"
            }
        }
    }

    /// Name of a program's text.
    fn file(self) -> &'static str {
        match self {
            Self::Processor => "parity.cpp",
            Self::Cuda => "parity.cu",
        }
    }
}

/// The families whose cases are shown to notice faults, and the faults.
pub(crate) fn faults() -> [(Family, Vec<Fault>); 9] {
    let of = |family: usize, faults: &[Fault]| (FAMILIES[family], faults.to_vec());
    [
        of(0, &math::FAULTS),
        of(1, &ndf::FAULTS),
        of(2, &vndf::FAULTS),
        of(3, &fresnel::FAULTS),
        of(4, &energy::FAULTS),
        of(5, &bsdf::faults()),
        of(6, layered::FAULTS),
        of(7, multibounce::FAULTS),
        of(8, measured::FAULTS),
    ]
}

/// Faults of a family that are planted in C++: of lobes and walks those that [`crate::harness::catch_some`] leaves out,
/// of others one in four.
fn planted(family: &str, faults: Vec<Fault>) -> Vec<Fault> {
    let (first, step) = match SHARED.contains(&family) {
        true => (1, 2),
        false => (0, 4),
    };
    faults.into_iter().skip(first).step_by(step).collect()
}

/// Families whose faults are planted in shaders or in C++.
const SHARED: [&str; 4] = ["bsdf", "layered", "multibounce", "measured"];

/// The modules that cases need and, for each case, a function `parity_NAME(x, y)` of its body.
pub(crate) fn functions(cases: &[&Case], fault: Option<&Fault>) -> String {
    let modules: BTreeSet<&str> = cases.iter().flat_map(|c| c.modules).copied().collect();
    let mut wgsl = text(&modules.into_iter().collect::<Vec<_>>(), fault);
    for case in cases {
        let (name, arguments, results) = (case.name, case.arguments, case.results());
        wgsl += &format!(
            "\nfn parity_{name}(x: ptr<function, array<f32, {arguments}>>, y: ptr<function, array<f32, {results}>>) {{\n\
             {}\n}}\n",
            case.body
        );
    }
    wgsl
}

/// Cases as a program.
fn source(side: Side, cases: &[&Case], fault: Option<&Fault>) -> String {
    let wgsl = functions(cases, fault);
    let call = |case: &&Case| {
        let (name, arguments, results) = (case.name, case.arguments, case.results());
        format!("    evaluate<specula::parity_{name}, {arguments}, {results}>(inputs, results);\n")
    };
    let calls: String = cases.iter().map(call).collect();
    let library = specula_shaders::to_cpp(&wgsl).unwrap_or_else(|error| panic!("{error}\n{wgsl}"));
    let bind = if wgsl.contains("var<storage, read> specula_tables") {
        side.bind()
    } else {
        ""
    };
    let main = side.main().replace("    // BIND\n", bind);
    library + &main.replace("    // CALLS\n", &calls)
}

/// Writes the arguments of cases for a program: for each their number of rows, then the rows.
pub(crate) fn write_inputs(folder: &Path, cases: &[&Case]) {
    let mut bytes = Vec::new();
    for case in cases {
        let count = u32::try_from(case.inputs.len() / case.arguments).unwrap();
        bytes.extend(count.to_le_bytes());
        bytes.extend(case.inputs.iter().flat_map(|v| v.to_le_bytes()));
    }
    std::fs::write(folder.join("inputs"), bytes).unwrap();
}

/// What a program has written for each case.
pub(crate) fn read_results(folder: &Path, cases: &[&Case]) -> Vec<Vec<f32>> {
    let bytes = std::fs::read(folder.join("results")).unwrap();
    let mut values = bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b));
    let lengths = cases
        .iter()
        .map(|case| case.inputs.len() / case.arguments * case.results());
    lengths
        .map(|length| values.by_ref().take(length).collect())
        .collect()
}

/// A compiled program in a folder of its own.
struct Program {
    folder: tempfile::TempDir,
}

impl Program {
    fn compile(compiler: &Path, flags: &[&str], cases: &[&Case], fault: Option<&Fault>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let side = Side::of(compiler);
        let text = source(side, cases, fault);
        std::fs::write(folder.path().join(side.file()), text).unwrap();
        std::fs::write(folder.path().join("tables"), measured::tables()).unwrap();
        let output = Command::new(compiler)
            .current_dir(folder.path())
            .args(["-std=c++17", side.file(), "-o", "parity"])
            .args(flags)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        let first = said.lines().take(20).collect::<Vec<_>>().join("\n");
        assert!(output.status.success(), "{first}");
        Self { folder }
    }

    /// The results of each case.
    fn run(&self, cases: &[&Case]) -> Vec<Vec<f32>> {
        let folder = self.folder.path();
        write_inputs(folder, cases);
        let output = Command::new(folder.join("parity"))
            .current_dir(folder)
            // The sanitizer of leaks cannot run where processes may not be traced.
            .env("ASAN_OPTIONS", "detect_leaks=0")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{said}");
        read_results(folder, cases)
    }
}

/// The compilers that are installed, or a line that says what was skipped without g++.
#[track_caller]
fn compilers(what: &str) -> Vec<PathBuf> {
    let is_there = |name: &&str| Command::new(name).arg("--version").output().is_ok();
    let found = ["g++", "clang++"].into_iter().filter(is_there);
    let found: Vec<PathBuf> = found.map(PathBuf::from).collect();
    if !found.iter().any(|compiler| compiler.ends_with("g++")) {
        specula_testing::skip(what, "g++ is not installed", "apt-get install g++");
    }
    found
}

fn outcomes(
    compiler: &Path,
    setting: &Setting,
    cases: &[Case],
    fault: Option<&Fault>,
) -> Vec<Outcome> {
    let cases: Vec<&Case> = cases.iter().collect();
    let start = Instant::now();
    let program = Program::compile(compiler, setting.flags, &cases, fault);
    let compiled = start.elapsed();
    let values = program.run(&cases);
    let time = [compiled, start.elapsed().saturating_sub(compiled)];
    let judged = cases.iter().zip(&values);
    judged
        .map(|(case, values)| judge(case, values, case.results(), time))
        .collect()
}

/// Errors of each of some families.
type Outcomes = Arc<Vec<Vec<Outcome>>>;

/// By compiler, setting and families.
static KEPT: Kept<Outcomes> = Kept::new();

/// Errors of families, which are run once for a compiler and its flags, as one program.
fn family_outcomes(compiler: &Path, setting: &Setting, families: &[Family]) -> Outcomes {
    let names: Vec<&str> = families.iter().map(|family| family.0).collect();
    let name = format!(
        "{} {} {}",
        compiler.display(),
        setting.flags.join(" "),
        names.join(" ")
    );
    KEPT.get(&name, || {
        let cases: Vec<Vec<Case>> = families.iter().map(|family| family.1()).collect();
        let outcomes = outcomes(compiler, setting, &cases.concat(), None);
        Arc::new(by_family(&cases, outcomes))
    })
}

/// What was computed for the cases of families, one family after the other.
pub(crate) fn by_family<T>(families: &[Vec<Case>], values: Vec<T>) -> Vec<Vec<T>> {
    let mut values = values.into_iter();
    let of_family = |cases: &Vec<Case>| values.by_ref().take(cases.len()).collect();
    families.iter().map(of_family).collect()
}

/// Flags of [`optimised_outcomes`].
pub(crate) const OPTIMISED_FLAGS: &[&str] = OPTIMISED.flags;

/// Errors of the families as g++ compiles programs.
pub(crate) fn optimised_outcomes() -> Outcomes {
    family_outcomes(Path::new("g++"), &OPTIMISED, &FAMILIES)
}

/// Proves all cases in a setting.
fn prove(setting: &Setting) {
    let what = setting.flags.join(" ");
    let found = compilers(&format!("C++ with {what}"));
    let is_meant = |path: &&PathBuf| setting.compilers.iter().any(|name| path.ends_with(name));
    let meant: Vec<&PathBuf> = found.iter().filter(is_meant).collect();
    let others = found.iter().take(usize::from(meant.is_empty()));
    for compiler in meant.iter().copied().chain(others) {
        let what = format!("{} {what}", compiler.display());
        prove_by(compiler, setting, &what);
    }
}

/// CUDA's compiler, or a line that says what was skipped.
#[track_caller]
fn cuda_compiler(what: &str) -> Option<PathBuf> {
    let answers = |program: &Path, argument| {
        let output = Command::new(program).arg(argument).output();
        output.is_ok_and(|output| output.status.success())
    };
    if !answers(Path::new("nvidia-smi"), "-L") {
        specula_testing::not_of_this_machine(what, "no GPU for CUDA");
        return None;
    }
    let places = ["nvcc", "/usr/local/cuda/bin/nvcc"].map(PathBuf::from);
    let found = places.into_iter().find(|place| answers(place, "--version"));
    if found.is_none() {
        specula_testing::skip(what, "nvcc is not installed", "NVIDIA's CUDA toolkit");
    }
    found
}

/// Proves all cases on a GPU by CUDA.
fn prove_by_cuda(setting: &Setting) {
    let what = format!("CUDA with {}", setting.flags.join(" "));
    if let Some(compiler) = cuda_compiler(&what) {
        prove_by(&compiler, setting, &what);
    }
}

fn prove_by(compiler: &Path, setting: &Setting, what: &str) {
    let some = |families: &[Family]| failures(compiler, setting, families, what);
    // nvcc takes most of a minute for the largest family.
    let failures: Vec<String> = match Side::of(compiler) {
        Side::Processor => some(&FAMILIES),
        Side::Cuda => std::thread::scope(|scope| {
            let begun = FAMILIES
                .each_ref()
                .map(|family| scope.spawn(move || some(std::slice::from_ref(family))));
            begun.into_iter().flat_map(|t| t.join().unwrap()).collect()
        }),
    };
    assert!(failures.is_empty(), "{what}:\n{}", failures.join("\n"));
}

/// What fails of families of cases, which are one program.
fn failures(compiler: &Path, setting: &Setting, families: &[Family], what: &str) -> Vec<String> {
    let start = Instant::now();
    let outcomes = family_outcomes(compiler, setting, families);
    let mut failures = Vec::new();
    for ((family, _), outcomes) in families.iter().zip(outcomes.iter()) {
        let errors = outcomes.iter().map(|o| o.shader / o.bound);
        println!(
            "{what}: {family}: {} cases, errors up to {:.2} of their bounds",
            outcomes.len(),
            errors.fold(0.0, f64::max)
        );
        let failed = outcomes.iter().filter(|o| !o.is_pass(setting.is_exact));
        failures.extend(failed.map(|o| format!("{family}: {}", o.failure())));
    }
    let [compiled, run]: [Duration; 2] = outcomes[0][0].time;
    println!(
        "{what}: compiled in {:.1} s, run in {:.1} s, all in {:.1} s",
        compiled.as_secs_f64(),
        run.as_secs_f64(),
        start.elapsed().as_secs_f64()
    );
    failures
}

#[test]
fn plain_code_agrees() {
    prove(&PLAIN);
}

#[test]
fn optimised_code_agrees() {
    prove(&OPTIMISED);
}

#[test]
fn fast_arithmetic_agrees() {
    prove(&FAST);
}

#[test]
fn fused_arithmetic_agrees() {
    prove(&FUSED);
}

#[test]
fn nothing_is_undefined() {
    prove(&SANITISED);
}

#[test]
fn cuda_of_ieee_agrees() {
    prove_by_cuda(&CUDA_EXACT);
}

#[test]
fn cuda_agrees() {
    prove_by_cuda(&CUDA);
}

#[test]
fn fast_cuda_agrees() {
    prove_by_cuda(&CUDA_FAST);
}

#[test]
fn planted_faults_are_noticed() {
    let Some(compiler) = compilers("planted faults in C++").into_iter().next() else {
        return;
    };
    for ((family, cases), faults) in faults() {
        let cases = cases();
        for fault in planted(family, faults) {
            let case = cases.iter().find(|c| c.name == fault.case).unwrap();
            let case = std::slice::from_ref(case);
            let bound = case[0].bound;
            let outcome = outcomes(&compiler, &PLAIN, case, Some(&fault));
            let error = outcome[0].shader;
            println!(
                "{family}: '{}' for '{}': {error:.3e} ulps of {}",
                fault.to, fault.from, bound
            );
            assert!(
                error > bound,
                "{}: '{}' goes unnoticed: {error} ulps",
                fault.case,
                fault.to
            );
        }
    }
}
