//! SPIR-V as a program in C++, instruction by instruction as the specification defines them: what a compiler has
//! written is computed in the arithmetic of IEEE, in its order, without a driver that optimises it.
//!
//! What a module leaves undefined is not-a-number there, so that a case that reads it fails.

mod operations;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::entries::{instructions, text, text_length};
use operations::{function, operation};

const OP_UNDEF: u32 = 1;
const OP_EXT_INST: u32 = 12;
const OP_ENTRY_POINT: u32 = 15;
const OP_CONSTANT: u32 = 43;
const OP_FUNCTION: u32 = 54;
const OP_FUNCTION_PARAMETER: u32 = 55;
const OP_FUNCTION_END: u32 = 56;
const OP_VARIABLE: u32 = 59;
const OP_DECORATE: u32 = 71;
const OP_PHI: u32 = 245;
const OP_LABEL: u32 = 248;
const BUILT_IN: u32 = 11;
const BINDING: u32 = 33;
const GLOBAL_INVOCATION_ID: u32 = 28;
/// Tables, arguments, results and the number of rows, by their bindings.
const ARRAYS: u32 = 4;

/// What a type is made of, by the identifiers of its parts.
enum Kind {
    Void,
    /// A number, a truth value, or a function.
    Plain,
    Vector {
        of: u32,
        count: u32,
    },
    Array {
        of: u32,
    },
    Structure(Vec<u32>),
    Pointer {
        to: u32,
    },
}

/// What is known of a module by identifiers.
struct Module<'a> {
    words: &'a [u32],
    kinds: BTreeMap<u32, Kind>,
    /// Types of values.
    types: BTreeMap<u32, u32>,
    /// Constants of one word.
    numbers: BTreeMap<u32, u32>,
    /// For each block that begins with some, its phis: each with its values and the blocks that they come from.
    phis: BTreeMap<u32, Vec<&'a [u32]>>,
    entries: BTreeMap<String, u32>,
    bindings: Vec<[u32; 2]>,
    /// Variables that hold the thread's place.
    places: Vec<u32>,
}

/// The program of a module.
///
/// * `calls`: its entry points, with the arguments and results of each.
pub(super) fn program(words: &[u32], calls: &[(String, [usize; 2])]) -> String {
    let module = Module::read(words);
    let mut text = include_str!("spirv/head.cpp").to_owned();
    module.write_declarations(&mut text);
    module.write_functions(&mut text);
    text += "static void attach(void* const* arrays) {\n";
    for [id, binding] in &module.bindings {
        let _ = writeln!(text, "    attach_block(s{id}.m0, arrays[{binding}]);");
    }
    text += "}\nstatic void place(uint32_t x, uint32_t y) {\n";
    for id in &module.places {
        let _ = writeln!(text, "    s{id} = {{{{x, y, 0u}}}};");
    }
    text += "}\n";
    let call = |(name, [arguments, results]): &(String, [usize; 2])| {
        let id = module.entries[name];
        format!("    evaluate(f{id}, {arguments}, {results});\n")
    };
    let calls: String = calls.iter().map(call).collect();
    text + &include_str!("spirv/main.cpp").replace("    // CALLS\n", &calls)
}

fn opcode(instruction: &[u32]) -> u32 {
    instruction[0] & 0xffff
}

/// Whether the second word of an instruction is the type of its result, the third.
fn has_result(operation: u32) -> bool {
    match operation {
        OP_UNDEF | OP_EXT_INST => true,
        OP_FUNCTION_END | 62 | 63 | 71..=76 | 246..=255 | 317 | 331.. => operation == 400,
        41.. => true,
        _ => false,
    }
}

impl<'a> Module<'a> {
    fn read(words: &'a [u32]) -> Self {
        let mut module = Self {
            words,
            kinds: BTreeMap::new(),
            types: BTreeMap::new(),
            numbers: BTreeMap::new(),
            phis: BTreeMap::new(),
            entries: BTreeMap::new(),
            bindings: Vec::new(),
            places: Vec::new(),
        };
        let mut block = 0;
        for i in instructions(words) {
            let operation = opcode(i);
            if let Some(kind) = kind(i) {
                module.kinds.insert(i[1], kind);
            }
            if has_result(operation) {
                module.types.insert(i[2], i[1]);
            }
            match operation {
                OP_CONSTANT => {
                    module.numbers.insert(i[2], i[3]);
                }
                OP_ENTRY_POINT => {
                    let name = &i[3..3 + text_length(&i[3..])];
                    module.entries.insert(text(name), i[2]);
                }
                // DXC counts what a buffer is appended, behind the arrays.
                OP_DECORATE if i[2] == BINDING && i[3] < ARRAYS => {
                    module.bindings.push([i[1], i[3]]);
                }
                OP_DECORATE if i[2..] == [BUILT_IN, GLOBAL_INVOCATION_ID] => {
                    module.places.push(i[1]);
                }
                OP_LABEL => block = i[1],
                OP_PHI => module.phis.entry(block).or_default().push(i),
                _ => {}
            }
        }
        module
    }

    /// Types, constants, and variables outside of functions.
    fn write_declarations(&self, text: &mut String) {
        let globals = instructions(self.words).take_while(|i| opcode(i) != OP_FUNCTION);
        for i in globals {
            let typed = |value: &str| format!("static const T{} v{} = {value};", i[1], i[2]);
            let line = match opcode(i) {
                19 => format!("typedef void T{};", i[1]),
                20 => format!("typedef bool T{};", i[1]),
                21 => format!("typedef uint32_t T{};", i[1]),
                22 => format!("typedef float T{};", i[1]),
                23 => format!("typedef Several<T{}, {}> T{};", i[2], i[3], i[1]),
                28 => {
                    let count = self.numbers[&i[3]];
                    format!("typedef Several<T{}, {count}> T{};", i[2], i[1])
                }
                29 => format!("typedef Runtime<T{}> T{};", i[2], i[1]),
                30 => {
                    let members = (0..).zip(&i[2..]);
                    let members = members.map(|(k, of): (u32, _)| format!("T{of} m{k};"));
                    let members: String = members.collect();
                    format!("struct T{} {{ {members} }};", i[1])
                }
                32 => format!("typedef T{}* T{};", i[3], i[1]),
                41 => typed("true"),
                42 => typed("false"),
                OP_CONSTANT => typed(&format!("same_bits<T{}>(0x{:x}u)", i[1], i[3])),
                44 => typed(&self.braced(i[1], i[3..].iter().map(|id| format!("v{id}")))),
                46 | OP_UNDEF => typed(&format!("T{}()", i[1])),
                OP_VARIABLE => {
                    let (ty, id) = (i[1], i[2]);
                    let to = self.pointee(ty);
                    let value = i
                        .get(4)
                        .map_or(String::new(), |value| format!(" = v{value}"));
                    format!("static T{to} s{id}{value};\nstatic T{ty} const v{id} = &s{id};")
                }
                _ => continue,
            };
            let _ = writeln!(text, "{line}");
        }
    }

    /// The functions, all declared in front of the first.
    fn write_functions(&self, text: &mut String) {
        let mut functions: Vec<Vec<&[u32]>> = Vec::new();
        for i in instructions(self.words) {
            match opcode(i) {
                OP_FUNCTION => functions.push(vec![i]),
                _ => functions.iter_mut().rev().take(1).for_each(|f| f.push(i)),
            }
        }
        for function in &functions {
            let _ = writeln!(text, "{};", self.signature(function));
        }
        for function in &functions {
            let _ = writeln!(text, "{} {{", self.signature(function));
            for i in &function[1..] {
                self.write_variables(i, text);
            }
            let mut block = 0;
            for i in &function[1..] {
                if opcode(i) == OP_LABEL {
                    block = i[1];
                }
                let statement = self.statement(i, block);
                if !statement.is_empty() {
                    let _ = writeln!(text, "    {statement}");
                }
            }
        }
    }

    fn signature(&self, function: &[&[u32]]) -> String {
        let parameters = function
            .iter()
            .filter(|i| opcode(i) == OP_FUNCTION_PARAMETER)
            .map(|i| format!("T{} v{}", i[1], i[2]));
        let parameters: Vec<String> = parameters.collect();
        let [_, result, id, ..] = *function[0] else {
            panic!("a function without a name");
        };
        format!("static T{result} f{id}({})", parameters.join(", "))
    }

    /// Declares what an instruction of a function computes: C++ allows no jump past a declaration with a value.
    fn write_variables(&self, i: &[u32], text: &mut String) {
        let operation = opcode(i);
        let is_value = has_result(operation) && operation != OP_FUNCTION_PARAMETER;
        if !is_value || self.is_void(i[1]) {
            return;
        }
        let (ty, id) = (i[1], i[2]);
        let _ = writeln!(text, "    T{ty} v{id};");
        if operation == OP_VARIABLE {
            let _ = writeln!(text, "    T{} s{id};", self.pointee(ty));
        } else if operation == OP_PHI {
            let _ = writeln!(text, "    T{ty} t{id};");
        }
    }

    /// The statements of an instruction of a block.
    fn statement(&self, i: &[u32], block: u32) -> String {
        match opcode(i) {
            0 | 8 | OP_FUNCTION_PARAMETER | OP_PHI | 246 | 247 | 317 => String::new(),
            OP_FUNCTION_END => "}".to_owned(),
            OP_LABEL => {
                let mut statement = format!("L{block}:;");
                for phi in self.phis.get(&block).into_iter().flatten() {
                    let _ = write!(statement, " v{0} = t{0};", phi[2]);
                }
                statement
            }
            249 => self.jump(block, i[1]),
            250 => {
                let [yes, no] = [i[2], i[3]].map(|to| self.jump(block, to));
                format!("if (v{}) {{ {yes} }} else {{ {no} }}", i[1])
            }
            251 => {
                let mut statement = format!("switch (v{}) {{", i[1]);
                for case in i[3..].as_chunks::<2>().0 {
                    let _ = write!(
                        statement,
                        " case {}u: {}",
                        case[0],
                        self.jump(block, case[1])
                    );
                }
                format!("{statement} default: {} }}", self.jump(block, i[2]))
            }
            252 | 255 => "__builtin_trap();".to_owned(),
            253 => "return;".to_owned(),
            254 => format!("return v{};", i[1]),
            62 => format!("*v{} = v{};", i[1], i[2]),
            63 => format!("*v{} = *v{};", i[1], i[2]),
            _ => self.computation(i),
        }
    }

    /// From a block to another, whose phis take their values.
    fn jump(&self, from: u32, to: u32) -> String {
        let mut statement = String::new();
        for phi in self.phis.get(&to).into_iter().flatten() {
            let sources = phi[3..].as_chunks::<2>().0.iter();
            for [value, _] in sources.filter(|[_, source]| *source == from) {
                let _ = write!(statement, "t{} = v{value}; ", phi[2]);
            }
        }
        format!("{statement}goto L{to};")
    }

    /// The statements of an instruction with a result.
    fn computation(&self, i: &[u32]) -> String {
        let operation = opcode(i);
        let (ty, id) = (i[1], i[2]);
        let is = |value: String| format!("v{id} = {value};");
        match operation {
            OP_UNDEF => format!("undefine(v{id});"),
            57 => {
                let arguments: Vec<String> = i[4..].iter().map(|a| format!("v{a}")).collect();
                let call = format!("f{}({})", i[3], arguments.join(", "));
                match self.is_void(ty) {
                    true => format!("{call};"),
                    false => is(call),
                }
            }
            OP_VARIABLE => {
                let value = i.get(4).map(|value| format!("s{id} = v{value};"));
                let value = value.unwrap_or_else(|| format!("undefine(s{id});"));
                format!("v{id} = &s{id}; {value}")
            }
            61 => is(format!("*v{}", i[3])),
            65 | 66 => {
                let to = self.pointee(self.types[&i[3]]);
                let path = i[4..]
                    .iter()
                    .map(|index| (format!("v{index}"), self.numbers.get(index)));
                is(format!("&(*v{}){}", i[3], self.path(to, path)))
            }
            77 => is(format!("v{}.c[v{}]", i[3], i[4])),
            78 => format!("v{id} = v{}; v{id}.c[v{}] = v{};", i[3], i[5], i[4]),
            79 => {
                let first = self.count(i[3]);
                let part = |&k: &u32| match k {
                    k if k < first => format!("v{}.c[{k}]", i[3]),
                    u32::MAX => "{}".to_owned(),
                    k => format!("v{}.c[{}]", i[4], k - first),
                };
                is(format!(
                    "{{{{{}}}}}",
                    i[5..].iter().map(part).collect::<Vec<_>>().join(", ")
                ))
            }
            80 => is(self.braced(ty, i[3..].iter().flat_map(|&part| self.parts_of(ty, part)))),
            81 => is(format!(
                "v{}{}",
                i[3],
                self.literal_path(self.types[&i[3]], &i[4..])
            )),
            82 => {
                let path = self.literal_path(ty, &i[5..]);
                format!("v{id} = v{}; v{id}{path} = v{};", i[4], i[3])
            }
            124 | 400 => is(format!("same_bits<T{ty}>(v{})", i[3])),
            148 => is(self.dot(i[3], i[4])),
            154 => is(self.joined(i[3], " || ")),
            155 => is(self.joined(i[3], " && ")),
            OP_EXT_INST => self.extended(i),
            _ => {
                let expression = operation_of(operation);
                self.each(ty, id, expression, &i[3..])
            }
        }
    }

    /// The statements of an instruction of `GLSL.std.450`.
    fn extended(&self, i: &[u32]) -> String {
        let (ty, id, operands) = (i[1], i[2], &i[5..]);
        let is = |value: String| format!("v{id} = {value};");
        let a = operands[0];
        match i[4] {
            66 => is(format!("sqrtf({})", self.dot(a, a))),
            68 => {
                let b = operands[1];
                let turn = |[k, l]: [u32; 2]| {
                    format!("v{a}.c[{k}] * v{b}.c[{l}] - v{a}.c[{l}] * v{b}.c[{k}]")
                };
                let parts = [[1, 2], [2, 0], [0, 1]].map(turn);
                is(format!("{{{{{}}}}}", parts.join(", ")))
            }
            69 => {
                let length = format!("sqrtf({})", self.dot(a, a));
                let parts: Vec<String> = (0..self.count(a))
                    .map(|k| format!("v{a}.c[{k}] / {length}"))
                    .collect();
                is(format!("{{{{{}}}}}", parts.join(", ")))
            }
            number => {
                let expression = function(number);
                let expression =
                    expression.unwrap_or_else(|| panic!("instruction {number} of GLSL.std.450"));
                self.each(ty, id, expression, operands)
            }
        }
    }

    /// An expression for each component of a result; operands that are no vectors hold for all.
    fn each(&self, ty: u32, id: u32, expression: &str, operands: &[u32]) -> String {
        let filled = |k: u32| {
            let mut text = expression.to_owned();
            for (mark, &operand) in ["$a", "$b", "$c"].into_iter().zip(operands) {
                text = text.replace(mark, &self.part(operand, k));
            }
            text
        };
        match self.kinds[&ty] {
            Kind::Vector { count, .. } => {
                let parts = (0..count).map(|k| format!("v{id}.c[{k}] = {};", filled(k)));
                parts.collect::<Vec<_>>().join(" ")
            }
            _ => format!("v{id} = {};", filled(0)),
        }
    }

    /// A component of a vector; of others the value.
    fn part(&self, value: u32, k: u32) -> String {
        match self.kinds[&self.types[&value]] {
            Kind::Vector { .. } => format!("v{value}.c[{k}]"),
            _ => format!("v{value}"),
        }
    }

    fn dot(&self, a: u32, b: u32) -> String {
        let products = (0..self.count(a)).map(|k| format!("v{a}.c[{k}] * v{b}.c[{k}]"));
        products.collect::<Vec<_>>().join(" + ")
    }

    /// All components of a vector with something between them.
    fn joined(&self, vector: u32, between: &str) -> String {
        let parts = (0..self.count(vector)).map(|k| format!("v{vector}.c[{k}]"));
        parts.collect::<Vec<_>>().join(between)
    }

    /// What a part of a composite of a type contributes: a vector's vectors are taken apart.
    fn parts_of(&self, ty: u32, part: u32) -> Vec<String> {
        match (&self.kinds[&ty], &self.kinds[&self.types[&part]]) {
            (Kind::Vector { .. }, Kind::Vector { count, .. }) => {
                (0..*count).map(|k| self.part(part, k)).collect()
            }
            _ => vec![format!("v{part}")],
        }
    }

    /// A value of a type by its parts.
    fn braced(&self, ty: u32, parts: impl Iterator<Item = String>) -> String {
        let parts = parts.collect::<Vec<_>>().join(", ");
        match self.kinds[&ty] {
            Kind::Structure(_) => format!("{{{parts}}}"),
            _ => format!("{{{{{parts}}}}}"),
        }
    }

    fn literal_path(&self, ty: u32, indices: &[u32]) -> String {
        self.path(
            ty,
            indices.iter().map(|index| (index.to_string(), Some(index))),
        )
    }

    /// What indices select of a value of a type: each with how it is written and, where it is constant, its value.
    fn path<'i>(
        &self,
        ty: u32,
        indices: impl Iterator<Item = (String, Option<&'i u32>)>,
    ) -> String {
        let mut ty = ty;
        let mut path = String::new();
        for (index, number) in indices {
            ty = match &self.kinds[&ty] {
                Kind::Structure(members) => {
                    let k = number
                        .copied()
                        .unwrap_or_else(|| panic!("a member that is not constant"));
                    let _ = write!(path, ".m{k}");
                    members[k as usize]
                }
                Kind::Vector { of, .. } | Kind::Array { of } => {
                    let _ = write!(path, ".c[{index}]");
                    *of
                }
                _ => panic!("an index of what has no parts"),
            };
        }
        path
    }

    /// Components of a vector.
    fn count(&self, value: u32) -> u32 {
        match self.kinds[&self.types[&value]] {
            Kind::Vector { count, .. } => count,
            _ => panic!("no vector"),
        }
    }

    fn pointee(&self, pointer: u32) -> u32 {
        match self.kinds[&pointer] {
            Kind::Pointer { to } => to,
            _ => panic!("no pointer"),
        }
    }

    fn is_void(&self, ty: u32) -> bool {
        matches!(self.kinds[&ty], Kind::Void)
    }
}

fn operation_of(number: u32) -> &'static str {
    operation(number).unwrap_or_else(|| panic!("instruction {number} of SPIR-V"))
}

/// The type that an instruction declares.
fn kind(i: &[u32]) -> Option<Kind> {
    Some(match opcode(i) {
        19 => Kind::Void,
        20..=22 | 33 => Kind::Plain,
        23 => Kind::Vector {
            of: i[2],
            count: i[3],
        },
        28 | 29 => Kind::Array { of: i[2] },
        30 => Kind::Structure(i[2..].to_vec()),
        32 => Kind::Pointer { to: i[3] },
        _ => return None,
    })
}
