//! Cases of parity: a piece of WGSL, the same in Rust, inputs and a bound; and faults planted in the
//! modules, which the cases must catch.
//!
//! The error of a value is counted in units of the last place (ulps) of `f32` at
//! `max(|value|, scale)`, where the value is that of the `f64` twin at the same `f32` inputs. The
//! scale is 0 where every digit counts, and otherwise says what the value is a part of: a component
//! of a unit vector has the scale 1.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

mod arguments;

pub(crate) use crate::common::gpu;
pub(crate) use arguments::{
    ABOVE, ALPHAS, AZIMUTHS, BELOW, ETAS, alpha, both_sides, direction, product, r2, round, vector,
    views,
};
use specula_gpu::{AdapterKind, ComputeKernel, Gpu, GpuError};
use specula_shaders::{Declaration, DeclarationKind, MODULES, Module, declarations, ordered};

/// Invocations of a workgroup.
const GROUP: usize = 64;
/// Workgroups along x; more inputs go to the next row.
const ROW: usize = 1024;

/// What the names of entry points begin with, so that no module has them.
const PREFIX: &str = "parity_";
/// Name of the array of energy tables.
const TABLES: &str = "specula_tables";

/// A function of the inputs of one evaluation.
pub(crate) type Twin<T> = fn(&[T]) -> Vec<T>;

/// One function (or a few) of the modules beside its twins.
#[derive(Clone)]
pub(crate) struct Case {
    /// Unique, of lower-case letters and underscores: it names the entry point.
    pub(crate) name: &'static str,
    /// Modules that the body names; what they import is there as well.
    pub(crate) modules: &'static [&'static str],
    /// WGSL statements that read `x: array<f32, N>` and write `y: array<f32, M>`.
    pub(crate) body: &'static str,
    /// How many values an evaluation takes, `N`.
    pub(crate) arguments: usize,
    /// The evaluations' arguments, one after the other.
    pub(crate) inputs: Vec<f32>,
    /// The twin in `f32`.
    pub(crate) single: Twin<f32>,
    /// The twin in `f64`.
    pub(crate) double: Twin<f64>,
    /// Largest error of the shader in ulps.
    pub(crate) bound: f64,
    /// The least number whose ulps are counted: one for all results, or one for each.
    pub(crate) scale: &'static [f64],
    /// Evaluations that may miss the bound: where the function jumps, rounding chooses the side.
    pub(crate) strays: usize,
}

/// Both twins of an expression of `x: &[T]`, for any `T: Real`, with a `Vec<T>` as its value.
macro_rules! twins {
    (|$x:ident| $body:expr) => {{
        fn twin<T: specula_bsdf::Real>($x: &[T]) -> Vec<T> {
            $body
        }
        (twin::<f32>, twin::<f64>)
    }};
}
pub(crate) use twins;

impl Case {
    /// A case in which every digit counts.
    ///
    /// * `inputs`: one row for each evaluation, all of the same length.
    /// * `twins`: of the macro `twins`.
    /// * `bound`: in ulps.
    pub(crate) fn new<const N: usize>(
        name: &'static str,
        modules: &'static [&'static str],
        body: &'static str,
        inputs: Vec<[f32; N]>,
        (single, double): (Twin<f32>, Twin<f64>),
        bound: f64,
    ) -> Self {
        Self {
            name,
            modules,
            body,
            arguments: N,
            inputs: inputs.into_flattened(),
            single,
            double,
            bound,
            scale: &[0.0],
            strays: 0,
        }
    }

    /// The same with ulps counted at `scale` or above.
    pub(crate) fn at_scale(self, scale: &'static [f64]) -> Self {
        Self { scale, ..self }
    }

    /// The same where so many evaluations may lie on the other side of a jump.
    pub(crate) fn with_strays(self, strays: usize) -> Self {
        Self { strays, ..self }
    }

    /// How many values an evaluation gives.
    pub(crate) fn results(&self) -> usize {
        let first: Vec<f64> = wide(&self.inputs[..self.arguments]);
        (self.double)(&first).len()
    }
}

/// A text of a module to be replaced, and the case that has to notice.
#[derive(Clone, Copy)]
pub(crate) struct Fault {
    /// Name of the case.
    pub(crate) case: &'static str,
    /// Path of the module.
    pub(crate) module: &'static str,
    /// What is there, exactly once.
    pub(crate) from: &'static str,
    /// What stands there instead.
    pub(crate) to: &'static str,
}

/// One of a list.
pub(crate) const fn fault(
    case: &'static str,
    module: &'static str,
    from: &'static str,
    to: &'static str,
) -> Fault {
    Fault {
        case,
        module,
        from,
        to,
    }
}

/// Errors of a case.
pub(crate) struct Outcome {
    pub(crate) name: &'static str,
    evaluations: usize,
    /// Largest error of the shader in ulps, strays left out.
    pub(crate) shader: f64,
    /// Largest error of the Rust twin in ulps, as many left out.
    single: f64,
    pub(crate) bound: f64,
    /// Evaluations of the shader that miss the bound.
    beyond: usize,
    /// The evaluation with the largest error, for the message.
    worst: String,
    /// Compilation and running.
    pub(crate) time: [Duration; 2],
}

/// Largest share of a case's evaluations that may miss the bound on a real GPU or in fast arithmetic, and by what
/// factor. Bounds are those of IEEE arithmetic; real GPUs fuse, reorder and approximate. On an NVIDIA H100 11 cases
/// miss theirs, in 8.2 % of the evaluations and by a factor of 910 at most: a narrow lobe's density after another
/// rounding of the direction.
const BEYOND: (f64, f64) = (0.1, 2000.0);

impl Outcome {
    /// * `is_exact`: whether the arithmetic is that of IEEE.
    pub(crate) fn is_pass(&self, is_exact: bool) -> bool {
        let within = self.shader <= self.bound;
        let (share, factor) = BEYOND;
        within
            || !is_exact
                && self.beyond as f64 <= share * self.evaluations as f64
                && self.shader <= factor * self.bound
    }

    /// What a failed test says of it.
    pub(crate) fn failure(&self) -> String {
        format!(
            "{}: {} ulps, bound {}, missed by {} of {}: {}",
            self.name, self.shader, self.bound, self.beyond, self.evaluations, self.worst
        )
    }
}

/// The text of the modules named and of all that they import, with a fault where one is given.
pub(crate) fn text(modules: &[&str], fault: Option<&Fault>) -> String {
    let replaced = |module: &Module| match fault {
        Some(fault) if fault.module == module.path => {
            let code = module.code();
            let times = code.matches(fault.from).count();
            assert!(times == 1, "'{}' occurs {times} times", fault.from);
            code.replace(fault.from, fault.to)
        }
        _ => module.code(),
    };
    let all = ordered(modules).unwrap_or_else(|error| panic!("{error}"));
    let parts: Vec<String> = all.iter().map(replaced).collect();
    parts.join("\n")
}

/// WGSL with one entry point for each of the media, `(name, arguments, results, body)`.
fn source(text: &str, media: &[(&str, usize, usize, &str)]) -> String {
    let mut source = text.to_owned();
    if !source.contains(TABLES) {
        source.push_str("@group(0) @binding(0) var<storage, read> unused: array<f32>;\n");
    }
    source.push_str(
        "@group(0) @binding(1) var<storage, read> parity_x: array<f32>;\n\
         @group(0) @binding(2) var<storage, read_write> parity_y: array<f32>;\n",
    );
    for (name, arguments, results, body) in media {
        let _ = write!(
            source,
            "@compute @workgroup_size({GROUP})\n\
             fn {PREFIX}{name}(@builtin(global_invocation_id) place: vec3u) {{\n\
             let parity_i = place.y * {row}u + place.x;\n\
             if parity_i >= arrayLength(&parity_y) / {results}u {{ return; }}\n\
             var x: array<f32, {arguments}>;\n\
             for (var k = 0u; k < {arguments}u; k++) {{ x[k] = parity_x[parity_i * {arguments}u + k]; }}\n\
             var y: array<f32, {results}>;\n\
             {body}\n\
             for (var k = 0u; k < {results}u; k++) {{ parity_y[parity_i * {results}u + k] = y[k]; }}\n\
             }}\n",
            row = GROUP * ROW,
        );
    }
    source
}

/// Runs an entry point over `inputs`, `results` values for every `arguments`.
fn run(
    gpu: &Gpu,
    kernel: &ComputeKernel,
    tables: &[u8],
    inputs: &[f32],
    [arguments, results]: [usize; 2],
) -> Result<Vec<f32>, GpuError> {
    let count = inputs.len() / arguments;
    let bytes: Vec<u8> = inputs.iter().flat_map(|v| v.to_le_bytes()).collect();
    let output = 4 * u64::try_from(count * results).unwrap_or(u64::MAX);
    let arrays = kernel.upload(gpu, &[tables, &bytes], output)?;
    let groups = count.div_ceil(GROUP);
    let rows = [groups.min(ROW), groups.div_ceil(ROW), 1];
    kernel.run(gpu, &arrays, rows.map(|n| u32::try_from(n).unwrap_or(0)))?;
    let bytes = arrays.output(gpu)?;
    let number = |b: &[u8; 4]| f32::from_le_bytes(*b);
    Ok(bytes.as_chunks().0.iter().map(number).collect())
}

/// Bytes of the tables where `text` reads them, else next to nothing: an empty array cannot be.
pub(crate) fn tables_for(text: &str) -> &'static [u8] {
    if text.contains(TABLES) {
        crate::measured::tables()
    } else {
        &[0; 4]
    }
}

/// Evaluates a body on the GPU: for sums and statistics over its results.
///
/// * `modules`, `body`: as of a [`Case`]; `results` is the length of `y`.
pub(crate) fn evaluate<const N: usize>(
    gpu: &Gpu,
    modules: &[&str],
    body: &str,
    inputs: &[[f32; N]],
    results: usize,
) -> Vec<f32> {
    let text = text(modules, None);
    let source = source(&text, &[("evaluate", N, results, body)]);
    let done = gpu.shader("evaluate", &source).and_then(|module| {
        let kernel = ComputeKernel::new(gpu, &module, &format!("{PREFIX}evaluate"), 2)?;
        let tables = tables_for(&text);
        run(gpu, &kernel, tables, inputs.as_flattened(), [N, results])
    });
    done.unwrap_or_else(|error| panic!("{error}"))
}

/// What was computed once, by its name.
pub(crate) struct Kept<T>(Mutex<BTreeMap<String, Arc<OnceLock<T>>>>);

impl<T: Clone> Kept<T> {
    pub(crate) const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The value of a name. Who asks while it is computed waits.
    pub(crate) fn get(&self, name: &str, compute: impl FnOnce() -> T) -> T {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = Arc::clone(kept.entry(name.to_owned()).or_default());
        drop(kept);
        place.get_or_init(compute).clone()
    }
}

/// Proves all cases of a family: prints a table of errors and panics with those beyond their bounds.
pub(crate) fn prove(family: &str, cases: &[Case]) {
    let Some(gpu) = gpu(&format!("{} cases of {family}", cases.len())) else {
        return;
    };
    let start = Instant::now();
    let outcomes = outcomes(gpu, cases, None).unwrap_or_else(|error| panic!("{family}: {error}"));
    let mut report = String::new();
    for o in &outcomes {
        let _ = writeln!(
            report,
            "  {:34} {:>10.2} {:>10.2} {:>8} {:>8}  {:>5.0} {:>5.0}",
            o.name,
            o.shader,
            o.single,
            o.bound,
            o.evaluations,
            1e3 * o.time[0].as_secs_f64(),
            1e3 * o.time[1].as_secs_f64()
        );
    }
    println!(
        "{family}: {} cases, {:.1} s\n  {:34} {:>10} {:>10} {:>8} {:>8}  {:>5} {:>5}\n{report}",
        cases.len(),
        start.elapsed().as_secs_f64(),
        "largest error in ulps of",
        "shader",
        "Rust f32",
        "bound",
        "count",
        "ms",
        "ms",
    );
    let failures: Vec<String> = outcomes
        .iter()
        .filter(|o| !o.is_pass(gpu.adapter.kind == AdapterKind::Software))
        .map(Outcome::failure)
        .collect();
    assert!(failures.is_empty(), "{family}:\n{}", failures.join("\n"));
}

/// Plants each fault and panics with those that their case does not notice.
pub(crate) fn catch(family: &str, cases: &[Case], faults: &[Fault]) {
    let Some(gpu) = gpu(&format!("{} planted faults of {family}", faults.len())) else {
        return;
    };
    for fault in faults {
        let case = cases.iter().find(|c| c.name == fault.case);
        let case = case.unwrap_or_else(|| panic!("no case '{}'", fault.case));
        let outcome = outcomes(gpu, std::slice::from_ref(case), Some(fault));
        let error = outcome.unwrap_or_else(|error| panic!("{}: {error}", fault.case))[0].shader;
        println!(
            "{family}: '{}' for '{}' in {}: {error:.3e} ulps of {}",
            fault.to, fault.from, fault.module, case.bound
        );
        assert!(
            error > case.bound,
            "{}: '{}' for '{}' in {} goes unnoticed: {error} ulps",
            fault.case,
            fault.to,
            fault.from,
            fault.module
        );
    }
}

/// The same for lobes and walks, whose shaders take a driver in software long: there every second fault, from the
/// first; the others are planted in C++.
pub(crate) fn catch_some(family: &str, cases: &[Case], faults: &[Fault]) {
    let Some(gpu) = gpu(&format!("planted faults of {family}")) else {
        return;
    };
    let is_software = gpu.adapter.kind == AdapterKind::Software;
    let step = if is_software { 2 } else { 1 };
    let some: Vec<Fault> = faults.iter().copied().step_by(step).collect();
    catch(family, cases, &some);
}

/// Runs cases: one shader module for those of the same modules, one pipeline each.
fn outcomes(gpu: &Gpu, cases: &[Case], fault: Option<&Fault>) -> Result<Vec<Outcome>, GpuError> {
    let mut groups: BTreeMap<&[&str], Vec<&Case>> = BTreeMap::new();
    for case in cases {
        groups.entry(case.modules).or_default().push(case);
    }
    let mut outcomes = Vec::new();
    for (modules, cases) in groups {
        let media: Vec<_> = cases
            .iter()
            .map(|c| (c.name, c.arguments, c.results(), c.body))
            .collect();
        let label = modules.join(" ");
        let text = text(modules, fault);
        let module = gpu.shader(&label, &source(&text, &media))?;
        let tables = tables_for(&text);
        for (case, (_, arguments, results, _)) in cases.into_iter().zip(media) {
            let start = Instant::now();
            let kernel = ComputeKernel::new(gpu, &module, &format!("{PREFIX}{}", case.name), 2)?;
            let compiled = start.elapsed();
            let values = run(gpu, &kernel, tables, &case.inputs, [arguments, results])?;
            let time = [compiled, start.elapsed().saturating_sub(compiled)];
            outcomes.push(judge(case, &values, results, time));
        }
    }
    Ok(outcomes)
}

/// What the twins give for the inputs of a case.
struct Expected {
    inputs: Vec<f32>,
    doubles: Vec<Vec<f64>>,
    singles: Vec<Vec<f32>>,
    /// Largest error of the twin in `f32`, strays left out.
    single: f64,
}

/// The same for every language and compiler.
static EXPECTED: Kept<Arc<Expected>> = Kept::new();

impl Expected {
    fn of(case: &Case) -> Arc<Self> {
        let expected = EXPECTED.get(case.name, || Arc::new(Self::computed(case)));
        match expected.inputs == case.inputs {
            true => expected,
            // Another case of that name.
            false => Arc::new(Self::computed(case)),
        }
    }

    fn computed(case: &Case) -> Self {
        let rows = || case.inputs.chunks(case.arguments);
        let doubles: Vec<Vec<f64>> = rows().map(|x| (case.double)(&wide(x))).collect();
        let singles: Vec<Vec<f32>> = rows().map(|x| (case.single)(x)).collect();
        let pairs = singles.iter().zip(&doubles);
        let errors = pairs.map(|(single, double)| largest_error(case, single, double));
        Self {
            inputs: case.inputs.clone(),
            single: without_strays(case, errors.collect()).0,
            doubles,
            singles,
        }
    }
}

/// The largest error of an evaluation's results in ulps.
fn largest_error(case: &Case, got: &[f32], expected: &[f64]) -> f64 {
    let pairs = got.iter().zip(expected).enumerate();
    let errors = pairs.map(|(k, (&g, &e))| {
        let scale = case.scale[k.min(case.scale.len() - 1)];
        error_in_ulps(f64::from(g), e, scale)
    });
    errors.fold(0.0, f64::max)
}

/// The largest of the errors of a case's evaluations, strays left out, and its evaluation.
fn without_strays(case: &Case, errors: Vec<f64>) -> (f64, usize) {
    let mut ranked: Vec<(f64, usize)> = errors.into_iter().zip(0..).collect();
    let at = case.strays.min(ranked.len() - 1);
    *ranked
        .select_nth_unstable_by(at, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)))
        .1
}

/// Compares what a shader, or a program in C++, computed with the twins.
pub(crate) fn judge(case: &Case, values: &[f32], results: usize, time: [Duration; 2]) -> Outcome {
    assert!(
        case.scale.len() == 1 || case.scale.len() == results,
        "{}: {} scales for {results} results",
        case.name,
        case.scale.len()
    );
    let inputs: Vec<&[f32]> = case.inputs.chunks(case.arguments).collect();
    let shaders: Vec<&[f32]> = values.chunks(results).collect();
    assert_eq!(values.len(), inputs.len() * results, "{}", case.name);
    let expected = Expected::of(case);
    let (doubles, singles) = (&expected.doubles, &expected.singles);
    let pairs = shaders.iter().zip(doubles);
    let errors = pairs.map(|(shader, double)| largest_error(case, shader, double));
    let errors: Vec<f64> = errors.collect();
    let beyond = errors.iter().filter(|error| **error > case.bound).count();
    let (shader, at) = without_strays(case, errors);
    Outcome {
        name: case.name,
        evaluations: inputs.len(),
        shader,
        single: expected.single,
        bound: case.bound,
        beyond,
        worst: format!(
            "x {:?}: shader {:?}, f64 {:?}, f32 {:?}",
            inputs[at], shaders[at], doubles[at], singles[at]
        ),
        time,
    }
}

/// `|got - expected|` in units of the last place of `f32` at `max(|expected|, scale)`; infinite where
/// `got` is no number.
pub(crate) fn error_in_ulps(got: f64, expected: f64, scale: f64) -> f64 {
    let error = (got - expected).abs();
    if error == 0.0 {
        return 0.0;
    }
    // Below the normal values digits are lost, and a GPU may take them for 0.
    let magnitude = expected.abs().max(scale).max(f64::from(f32::MIN_POSITIVE));
    let ulps = error / (magnitude.log2().floor() - 23.0).exp2();
    if ulps.is_nan() { f64::INFINITY } else { ulps }
}

fn wide(x: &[f32]) -> Vec<f64> {
    x.iter().copied().map(f64::from).collect()
}

/// Panics unless every function of a folder's modules is named by the body of a case, or listed in
/// `elsewhere` with the reason; and unless every name listed is one of theirs.
pub(crate) fn assert_covered(folder: &str, cases: &[Case], elsewhere: &[(&str, &str)]) {
    let modules = MODULES.iter().filter(|m| m.folder() == folder);
    let functions: Vec<Declaration<'_>> = modules
        .flat_map(|m| declarations(m.text))
        .filter(|d| d.kind == DeclarationKind::Function)
        .collect();
    assert!(!functions.is_empty(), "no modules in '{folder}'");
    let is_called = |name: &str| {
        let call = format!("{name}(");
        cases.iter().any(|case| {
            let ends =
                |at: usize| case.body[..at].ends_with(|c: char| c == '_' || c.is_alphanumeric());
            case.body.match_indices(&call).any(|(at, _)| !ends(at))
        })
    };
    let listed = |name: &str| elsewhere.iter().any(|(n, _)| *n == name);
    let bare: Vec<&str> = functions
        .iter()
        .map(|d| d.name)
        .filter(|name| !is_called(name) && !listed(name))
        .collect();
    assert!(
        bare.is_empty(),
        "no case of crates/specula-gpu/tests/parity/{folder} calls {}",
        bare.join(", ")
    );
    for (name, reason) in elsewhere {
        let known = functions.iter().any(|d| d.name == *name);
        assert!(
            known && !reason.is_empty(),
            "'{name}' is no function of '{folder}'"
        );
        assert!(!is_called(name), "'{name}' is listed and called by a case");
    }
}

#[test]
fn ulps_are_counted_at_the_scale_or_above() {
    let ulp = f64::from(f32::EPSILON);
    assert_eq!(error_in_ulps(1.0 + 3.0 * ulp, 1.0, 0.0), 3.0);
    assert_eq!(error_in_ulps(1.0 - ulp, 1.0, 0.0), 1.0);
    assert_eq!(error_in_ulps(2e-3 + 5.0 * ulp, 2e-3, 1.0).round(), 5.0);
    assert!(error_in_ulps(2e-3 + 5.0 * ulp, 2e-3, 0.0) > 1000.0);
    assert_eq!(error_in_ulps(f64::NAN, 1.0, 0.0), f64::INFINITY);
    assert_eq!(
        error_in_ulps(1e-40, 0.0, 0.0),
        1e-40 / f64::from(f32::MIN_POSITIVE) * 8_388_608.0
    );
}
