//! The exported library in a language, with a function for each case, as what runs: SPIR-V, or a program.
#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use specula_shaders::Language;

use super::entries::{with_entries, with_entry, without_source};
use super::spirv;
use super::vulkan::{GROUP, ROW, Vulkan};
use crate::cpp::{functions, read_results, write_inputs};
use crate::harness::{Case, Fault, tables_for};

/// How MSL is compiled: as C++14 with a `metal_stdlib` of our own. Metal has no `double`, and C++ would take its
/// constants for some.
const METAL: [&str; 6] = [
    "-std=c++14",
    "-O1",
    "-ffp-contract=off",
    "-fsingle-precision-constant",
    "-xc++",
    "-I.",
];

/// How SPIR-V is compiled that was written in C++.
const PROGRAM: [&str; 5] = [
    "-std=c++14",
    "-O0",
    "-ffp-contract=off",
    "-fno-strict-aliasing",
    "-w",
];

/// How DXC is called; by itself it optimises.
const DXC: [&str; 4] = ["-T", "lib_6_3", "-spirv", "-fspv-target-env=vulkan1.1"];

/// A language and its compiler.
#[derive(Clone, Debug)]
pub(super) struct Target {
    pub(super) language: Language,
    /// The program that compiles it.
    compiler: PathBuf,
    /// The compiler and its version.
    pub(super) version: String,
}

/// What is called by name, or a line that says what was skipped.
#[track_caller]
fn found(name: &str, what: Language, how: &str) -> Option<(PathBuf, String)> {
    let version = Command::new(name).arg("--version").output();
    let Ok(version) = version else {
        specula_testing::skip(
            format!("parity of {what}"),
            format!("{name} is not installed"),
            how,
        );
        return None;
    };
    let said = String::from_utf8_lossy(&version.stdout).into_owned();
    Some((PathBuf::from(name), said))
}

/// The word of a text that looks like a version.
fn number(said: &str) -> String {
    let mut words = said.split(|c: char| c.is_whitespace() || matches!(c, ':' | '(' | ')'));
    let is_version =
        |word: &&str| word.contains('.') && word.chars().all(|c| c.is_ascii_digit() || c == '.');
    words.find(is_version).unwrap_or("").to_owned()
}

impl Target {
    /// How many there are where nothing is missing.
    pub(super) const COUNT: usize = 6;

    /// The languages whose compilers are installed; a line for each that is not.
    #[track_caller]
    pub(super) fn all() -> Vec<Self> {
        let mut all = Vec::new();
        let mut add = |language, compiler: Option<(PathBuf, String)>| {
            all.extend(compiler.map(|(compiler, version)| Self {
                language,
                compiler,
                version,
            }));
        };
        let packages = "apt-get install glslang-tools spirv-tools g++";
        let with = |name: &str, program: &str, language| {
            let (path, said) = found(program, language, packages)?;
            // `SPIRV-Tools v2023.1`.
            let said = said.replace(" v", " ");
            Some((path, format!("{name} {}", number(&said))))
        };
        let linker = with("spirv-link of SPIRV-Tools", "spirv-link", Language::SpirV);
        add(Language::SpirV, linker);
        for language in [Language::Glsl, Language::GlslEs] {
            add(language, with("glslang", "glslangValidator", language));
        }
        add(Language::Hlsl, dxc());
        add(Language::Slang, slangc());
        add(Language::Msl, with("g++", "g++", Language::Msl));
        all
    }

    /// Whether it is compiled for the processor; else for a Vulkan device.
    pub(super) fn is_program(&self) -> bool {
        self.language == Language::Msl
    }

    /// Compiles the cases in Slang to what else it makes, and runs none.
    pub(super) fn compile_slang(&self, cases: &[&Case]) {
        let folder = tempfile::tempdir().unwrap();
        let build = Build {
            folder: folder.path(),
            target: self,
            cases,
            wgsl: functions(cases, None),
            for_device: false,
        };
        let entries = build.names();
        build.write(
            SLANG_FILE,
            build.text() + &build.with_entries(include_str!("main.hlsl")),
        );
        for target in SLANG_PRINTED {
            let printed = build.called(&self.compiler, &[&target[..], &[SLANG_FILE]].concat());
            let text = String::from_utf8_lossy(&printed.stdout);
            let missing = entries.iter().find(|name| !text.contains(name.as_str()));
            assert_eq!(missing, None, "{target:?}");
        }
    }

    /// The results of each case.
    ///
    /// * `device`: where SPIR-V runs; without one, on the processor.
    pub(super) fn run(
        &self,
        device: Option<&Vulkan>,
        cases: &[&Case],
        fault: Option<&Fault>,
    ) -> Vec<Vec<f32>> {
        let folder = tempfile::tempdir().unwrap();
        let build = Build {
            folder: folder.path(),
            target: self,
            cases,
            wgsl: functions(cases, fault),
            for_device: device.is_some(),
        };
        if self.is_program() {
            return build.metal();
        }
        let (words, entries) = build.spirv();
        let Some(device) = device else {
            return build.on_processor(&words, entries);
        };
        let tables = tables_for(&build.wgsl);
        let run = |(case, entry): (&&Case, &String)| {
            let bytes: Vec<u8> = case.inputs.iter().flat_map(|v| v.to_le_bytes()).collect();
            let rows = [case.inputs.len() / case.arguments, case.results()];
            let shader = device.shader(&with_entry(&words, entry), entry);
            device.run(&shader, entry, [tables, &bytes], rows)
        };
        cases.iter().zip(&entries).map(run).collect()
    }
}

/// A Python that has DXC, or a line that says what was skipped.
#[track_caller]
fn dxc() -> Option<(PathBuf, String)> {
    let python = specula_testing::compilers::dxc_python("parity of HLSL");
    python.map(|python| (python, "DXC 3.7".to_owned()))
}

/// Slang's compiler, or a line that says what was skipped.
#[track_caller]
fn slangc() -> Option<(PathBuf, String)> {
    let program = specula_testing::compilers::slangc("parity of Slang")?;
    // It says its version as an error.
    let said = Command::new(&program).arg("-v").output().unwrap();
    let said = [said.stdout, said.stderr].concat();
    let version = number(&String::from_utf8_lossy(&said));
    Some((program, format!("slangc {version}")))
}

/// The shader in Slang.
const SLANG_FILE: &str = "parity.slang";

/// What slangc is asked for beside SPIR-V, where several entry points have no file but are printed.
const SLANG_PRINTED: [[&str; 4]; 2] = [
    ["-target", "hlsl", "-profile", "sm_6_0"],
    ["-target", "cuda", "-O0", "-g0"],
];

/// Cases of a language in a folder.
struct Build<'a> {
    folder: &'a Path,
    target: &'a Target,
    cases: &'a [&'a Case],
    /// The modules with a function for each case.
    wgsl: String,
    /// Whether a device runs it.
    for_device: bool,
}

impl Build<'_> {
    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.folder.join(name), bytes).unwrap();
    }

    fn called(&self, program: &Path, arguments: &[&str]) -> Output {
        let mut command = Command::new(program);
        let output = command.current_dir(self.folder).args(arguments).output();
        let output = output.unwrap();
        let [out, err] = [&output.stdout, &output.stderr].map(|o| String::from_utf8_lossy(o));
        let lines = out.lines().chain(err.lines()).take(20);
        let said = lines.collect::<Vec<_>>().join("\n");
        assert!(output.status.success(), "{arguments:?}:\n{said}");
        output
    }

    /// The library as it is exported.
    fn library(&self, wgsl: &str) -> Vec<u8> {
        let language = self.target.language;
        specula_shaders::translated(wgsl, language).unwrap_or_else(|e| panic!("{language}: {e}"))
    }

    fn text(&self) -> String {
        String::from_utf8(self.library(&self.wgsl)).unwrap()
    }

    /// A line of a language for each case.
    fn calls(&self, line: impl Fn(&Case) -> String) -> String {
        self.cases.iter().map(|case| line(case)).collect()
    }

    /// A shader and its entry points, in the order of the cases.
    fn spirv(&self) -> (Vec<u32>, Vec<String>) {
        match self.target.language {
            Language::SpirV => self.linked(),
            Language::Hlsl => self.hlsl(),
            Language::Slang => self.slang(),
            _ => self.glsl(),
        }
    }

    fn names(&self) -> Vec<String> {
        let name = |case: &&Case| format!("run_{}", case.name);
        self.cases.iter().map(name).collect()
    }

    /// A text whose middle is repeated for each case.
    fn with_entries(&self, text: &str) -> String {
        let parts: Vec<&str> = text.split("// FOR EACH CASE\n").collect();
        let (middle, end) = parts[1].split_once("// END\n").unwrap();
        let entry = |case: &Case| {
            middle
                .replace("NAME", case.name)
                .replace("ARGUMENTS", &format!("{}u", case.arguments))
                .replace("RESULTS", &format!("{}u", case.results()))
        };
        parts[0].to_owned() + &self.calls(entry) + end
    }

    fn glsl(&self) -> (Vec<u32>, Vec<String>) {
        let head = match self.target.language {
            Language::GlslEs => "#version 310 es\nprecision highp float;\nprecision highp int;\n",
            _ => "#version 450\n",
        };
        let called = self.names().join("();\n    ") + "();\n";
        let main = self.with_entries(include_str!("main.comp"));
        let main = main.replace("// NAMES\n", &called);
        self.write("parity.comp", format!("{head}{}{main}", self.text()));
        let arguments = [
            "-V",
            "--target-env",
            "vulkan1.1",
            "parity.comp",
            "-o",
            "parity.spv",
        ];
        self.called(&self.target.compiler, &arguments);
        let names = self.names();
        let words = with_entries(&self.words("parity.spv"), &names);
        (self.valid(words), names)
    }

    fn hlsl(&self) -> (Vec<u32>, Vec<String>) {
        let main = self.with_entries(include_str!("main.hlsl"));
        self.write("parity.hlsl", self.text() + &main);
        self.write("dxc.py", include_str!("dxc.py"));
        let files = ["dxc.py", "parity.hlsl", "parity.spv"];
        // Optimised, each entry point has all that it calls within it.
        let plain: &[&str] = if self.for_device { &[] } else { &["-O0"] };
        self.called(&self.target.compiler, &[&files[..], &DXC, plain].concat());
        (self.valid(self.words("parity.spv")), self.names())
    }

    fn slang(&self) -> (Vec<u32>, Vec<String>) {
        let main = self.with_entries(include_str!("main.hlsl"));
        self.write(SLANG_FILE, self.text() + &main);
        // Without optimisation it needs no second library.
        let to_spirv = ["-target", "spirv", "-profile", "spirv_1_3", "-O0"];
        let files = [SLANG_FILE, "-fvk-use-entrypoint-name", "-o", "parity.spv"];
        self.called(&self.target.compiler, &[&to_spirv[..], &files].concat());
        let words = without_source(&self.words("parity.spv"));
        (self.valid(words), self.names())
    }

    /// The library that is exported, linked with a module that has entry points alone.
    fn linked(&self) -> (Vec<u32>, Vec<String>) {
        let mut wgsl = self.wgsl.clone() + include_str!("arrays.wgsl");
        for case in self.cases {
            let (name, arguments, results) = (case.name, case.arguments, case.results());
            let _ = write!(
                wgsl,
                "fn run_{name}(row: u32) {{\n\
                 if row >= parity_rows[0] {{ return; }}\n\
                 var x: array<f32, {arguments}>;\n\
                 for (var k = 0u; k < {arguments}u; k++) {{ x[k] = parity_arguments[row * {arguments}u + k]; }}\n\
                 var y: array<f32, {results}>;\n\
                 parity_{name}(&x, &y);\n\
                 for (var k = 0u; k < {results}u; k++) {{ parity_results[row * {results}u + k] = y[k]; }}\n}}\n"
            );
        }
        self.write("library.spv", self.library(&wgsl));
        self.write("caller.spvasm", self.caller());
        let assembler = Path::new("spirv-as");
        let environment = ["--target-env", "spv1.3"];
        let files = ["caller.spvasm", "-o", "caller.spv"];
        self.called(assembler, &[&environment[..], &files].concat());
        let files = ["caller.spv", "library.spv", "-o", "parity.spv"];
        self.called(&self.target.compiler, &[&environment[..], &files].concat());
        let names = self.names();
        (self.valid(self.words("parity.spv")), names)
    }

    /// A module with an entry point for each case, which calls the library's function for its row.
    fn caller(&self) -> String {
        let mut parts = [const { String::new() }; 4];
        for name in self.names() {
            let [entries, names, imports, bodies] = &mut parts;
            let _ = writeln!(
                entries,
                "OpEntryPoint GLCompute %main_{name} \"{name}\" %place"
            );
            let _ = writeln!(names, "OpExecutionMode %main_{name} LocalSize {GROUP} 1 1");
            let _ = writeln!(
                imports,
                "OpDecorate %{name} LinkageAttributes \"{name}\" Import"
            );
            let _ = writeln!(
                bodies,
                "%main_{name} = OpFunction %void None %main_type\n%at_{name} = OpLabel\n\
                 %id_{name} = OpLoad %uint3 %place\n%x_{name} = OpCompositeExtract %uint %id_{name} 0\n\
                 %y_{name} = OpCompositeExtract %uint %id_{name} 1\n%r_{name} = OpIMul %uint %y_{name} %row\n\
                 %i_{name} = OpIAdd %uint %r_{name} %x_{name}\n\
                 %call_{name} = OpFunctionCall %void %{name} %i_{name}\nOpReturn\nOpFunctionEnd"
            );
        }
        let [entries, modes, imports, bodies] = parts;
        let declared = self.names().into_iter().map(|name| {
            format!("%{name} = OpFunction %void None %row_type\n%row_{name} = OpFunctionParameter %uint\nOpFunctionEnd\n")
        });
        let declared: String = declared.collect();
        let row = GROUP * ROW;
        format!(
            "OpCapability Shader\nOpCapability Linkage\nOpMemoryModel Logical GLSL450\n{entries}{modes}\
             OpDecorate %place BuiltIn GlobalInvocationId\n{imports}\
             %void = OpTypeVoid\n%main_type = OpTypeFunction %void\n%uint = OpTypeInt 32 0\n\
             %uint3 = OpTypeVector %uint 3\n%row = OpConstant %uint {row}\n\
             %input = OpTypePointer Input %uint3\n%place = OpVariable %input Input\n\
             %row_type = OpTypeFunction %void %uint\n{declared}{bodies}"
        )
    }

    fn words(&self, name: &str) -> Vec<u32> {
        let bytes = std::fs::read(self.folder.join(name)).unwrap();
        let words = bytes.as_chunks().0.iter();
        words.map(|bytes| u32::from_le_bytes(*bytes)).collect()
    }

    /// The words, which SPIRV-Tools find no fault with where a driver gets them.
    fn valid(&self, words: Vec<u32>) -> Vec<u32> {
        if !self.for_device {
            return words;
        }
        let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
        self.write("valid.spv", bytes);
        let arguments = [
            "--target-env",
            "vulkan1.1",
            "--scalar-block-layout",
            "valid.spv",
        ];
        self.called(Path::new("spirv-val"), &arguments);
        words
    }

    /// Runs SPIR-V as a program in C++.
    fn on_processor(&self, words: &[u32], entries: Vec<String>) -> Vec<Vec<f32>> {
        let sizes = self
            .cases
            .iter()
            .map(|case| [case.arguments, case.results()]);
        let calls: Vec<_> = entries.into_iter().zip(sizes).collect();
        self.write("parity.cpp", spirv::program(words, &calls));
        self.write("tables", crate::measured::tables());
        let files = ["parity.cpp", "-o", "parity"];
        self.called(Path::new("g++"), &[&PROGRAM[..], &files].concat());
        write_inputs(self.folder, self.cases);
        self.called(&self.folder.join("parity"), &[]);
        read_results(self.folder, self.cases)
    }

    fn metal(&self) -> Vec<Vec<f32>> {
        std::fs::create_dir(self.folder.join("simd")).unwrap();
        let library = include_str!("metal/metal_stdlib");
        self.write("metal_stdlib", library);
        self.write("simd/simd.h", include_str!("metal/simd/simd.h"));
        self.write("tables", crate::measured::tables());
        let line = |case: &Case| format!("    evaluate(parity_{});\n", case.name);
        let main = include_str!("metal/main.cpp");
        let main = main.replace("    // CALLS\n", &self.calls(line));
        self.write("parity.metal", self.text() + &main);
        let files = ["parity.metal", "-o", "parity"];
        self.called(&self.target.compiler, &[&METAL[..], &files].concat());
        write_inputs(self.folder, self.cases);
        self.called(&self.folder.join("parity"), &[]);
        read_results(self.folder, self.cases)
    }
}
