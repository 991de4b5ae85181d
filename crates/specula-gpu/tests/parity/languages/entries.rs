//! Entry points of SPIR-V, one for each of many functions.

use std::collections::{BTreeMap, BTreeSet};

const OP_SOURCE: u32 = 3;
const OP_NAME: u32 = 5;
const OP_ENTRY_POINT: u32 = 15;
const OP_EXECUTION_MODE: u32 = 16;
const OP_FUNCTION: u32 = 54;
const OP_FUNCTION_END: u32 = 56;
const OP_FUNCTION_CALL: u32 = 57;
const OP_DECORATE: u32 = 71;
const OP_LABEL: u32 = 248;
/// Words of a module's header.
const HEADER: usize = 5;
/// Instructions that declare types.
const TYPES: std::ops::RangeInclusive<u32> = 19..=39;

/// The module with an entry point for each function of a name in place of its only one, which goes; they have its inputs
/// and modes.
///
/// * `names`: of functions without arguments or results.
pub(super) fn with_entries(words: &[u32], names: &[String]) -> Vec<u32> {
    let ids: Vec<u32> = names.iter().map(|name| function(words, name)).collect();
    let entries = instructions(words).filter(|i| i[0] & 0xffff == OP_ENTRY_POINT);
    let old: Vec<u32> = entries.map(|i| i[2]).collect();
    let mut inside_old = false;
    let mut module = words[..HEADER].to_vec();
    for instruction in instructions(words) {
        let operation = instruction[0] & 0xffff;
        // The old one calls the functions, which those of an entry point do not allow.
        inside_old |= operation == OP_FUNCTION && old.contains(&instruction[2]);
        let is_of_old = inside_old || operation == OP_NAME && old.contains(&instruction[1]);
        inside_old &= operation != OP_FUNCTION_END;
        if is_of_old {
            continue;
        }
        match operation {
            OP_ENTRY_POINT => {
                let inputs = &instruction[3 + text_length(&instruction[3..])..];
                for (name, id) in names.iter().zip(&ids) {
                    let mut entry = vec![0, instruction[1], *id];
                    entry.extend(text_words(name));
                    entry.extend(inputs);
                    entry[0] = head(&entry, OP_ENTRY_POINT);
                    module.extend(entry);
                }
            }
            OP_EXECUTION_MODE => {
                for id in &ids {
                    module.extend([instruction[0], *id]);
                    module.extend(&instruction[2..]);
                }
            }
            _ => module.extend(instruction),
        }
    }
    module
}

/// The module with one of its entry points and the functions that it calls: drivers take their time for all of them.
pub(super) fn with_entry(words: &[u32], name: &str) -> Vec<u32> {
    let wanted = text_words(name);
    let mut entries = instructions(words).filter(|i| i[0] & 0xffff == OP_ENTRY_POINT);
    let entry = entries.find(|i| i[3..].starts_with(&wanted));
    let entry = entry.unwrap_or_else(|| panic!("no entry point '{name}'"))[2];
    let needed = called(words, entry);
    let types: BTreeSet<u32> = instructions(words)
        .filter(|i| TYPES.contains(&(i[0] & 0xffff)))
        .map(|i| i[1])
        .collect();
    // What functions that go define: names and decorations of it go too.
    let mut gone = BTreeSet::new();
    let mut is_inside = false;
    let mut body = Vec::new();
    for instruction in instructions(words) {
        let operation = instruction[0] & 0xffff;
        is_inside |= operation == OP_FUNCTION && !needed.contains(&instruction[2]);
        if !is_inside {
            body.push(instruction);
        } else if operation == OP_LABEL {
            gone.insert(instruction[1]);
        } else if instruction.len() > 2 && types.contains(&instruction[1]) {
            gone.insert(instruction[2]);
        }
        is_inside &= operation != OP_FUNCTION_END;
    }
    let is_kept = |i: &&[u32]| match i[0] & 0xffff {
        OP_ENTRY_POINT => i[2] == entry,
        OP_EXECUTION_MODE => i[1] == entry,
        OP_NAME | OP_DECORATE => !gone.contains(&i[1]),
        _ => true,
    };
    let kept = body.into_iter().filter(is_kept).flatten().copied();
    words[..HEADER].iter().copied().chain(kept).collect()
}

/// A function and those that it calls, and so on.
fn called(words: &[u32], first: u32) -> BTreeSet<u32> {
    let mut calls: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let mut caller = 0;
    for instruction in instructions(words) {
        match instruction[0] & 0xffff {
            OP_FUNCTION => caller = instruction[2],
            OP_FUNCTION_CALL => calls.entry(caller).or_default().push(instruction[3]),
            _ => {}
        }
    }
    let mut found = BTreeSet::from([first]);
    let mut open = vec![first];
    while let Some(caller) = open.pop() {
        let callees = calls.get(&caller).into_iter().flatten();
        open.extend(callees.filter(|callee| found.insert(**callee)));
    }
    found
}

/// The module without what it was compiled from: older SPIRV-Tools do not know of Slang.
pub(super) fn without_source(words: &[u32]) -> Vec<u32> {
    let kept = instructions(words).filter(|i| i[0] & 0xffff != OP_SOURCE);
    let kept = kept.flat_map(|i| i.iter().copied());
    words[..HEADER].iter().copied().chain(kept).collect()
}

/// The function of a name; glslang adds its arguments.
fn function(words: &[u32], name: &str) -> u32 {
    let wanted = format!("{name}(");
    let named = instructions(words).find(|i| {
        let bytes = i[2.min(i.len())..].iter().flat_map(|w| w.to_le_bytes());
        i[0] & 0xffff == OP_NAME && bytes.take(wanted.len()).eq(wanted.bytes())
    });
    named.unwrap_or_else(|| panic!("no function '{name}'"))[1]
}

fn head(instruction: &[u32], operation: u32) -> u32 {
    u32::try_from(instruction.len()).unwrap_or(0) << 16 | operation
}

/// How many words a text takes that ends in a zero.
pub(super) fn text_length(words: &[u32]) -> usize {
    let last = words.iter().position(|w| w.to_le_bytes().contains(&0));
    last.map_or(words.len(), |at| at + 1)
}

fn text_words(text: &str) -> Vec<u32> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize(4 * (text.len() / 4 + 1), 0);
    let words = bytes.as_chunks().0.iter();
    words.map(|bytes| u32::from_le_bytes(*bytes)).collect()
}

/// The text of words, up to its zero.
pub(super) fn text(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|w| w.to_le_bytes());
    let bytes: Vec<u8> = bytes.take_while(|b| *b != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The instructions of a module.
pub(super) fn instructions(words: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let start = at;
        at += (words.get(at)? >> 16).max(1) as usize;
        words.get(start..at)
    })
}

#[test]
fn an_entry_point_keeps_what_it_calls() {
    let instruction = |operation: u32, operands: &[u32]| {
        let mut words = vec![0];
        words.extend(operands);
        words[0] = head(&words, operation);
        words
    };
    let [void, one, other, helper, unused] = [1, 11, 12, 13, 14];
    let entry = |id, name| instruction(OP_ENTRY_POINT, &[&[5, id], &text_words(name)[..]].concat());
    let function = |id: u32, callee: Option<u32>| {
        let call = callee.map(|c| instruction(OP_FUNCTION_CALL, &[void, 100 + id, c]));
        let begin = instruction(OP_FUNCTION, &[void, id, 0, 2]);
        let label = instruction(OP_LABEL, &[200 + id]);
        [
            begin,
            label,
            call.unwrap_or_default(),
            instruction(OP_FUNCTION_END, &[]),
        ]
        .concat()
    };
    let named = |id: u32| instruction(OP_NAME, &[id, 0]);
    let header = [0x0723_0203, 0x0001_0300, 0, 300, 0];
    let module = |entries: &[Vec<u32>], names: &[u32], functions: &[Vec<u32>]| {
        let names: Vec<u32> = names.iter().flat_map(|id| named(*id)).collect();
        let void = instruction(*TYPES.start(), &[void]);
        [
            &header[..],
            &entries.concat(),
            &names,
            &void,
            &functions.concat(),
        ]
        .concat()
    };
    let entries = [entry(one, "one"), entry(other, "other")];
    let functions = [
        function(unused, None),
        function(helper, None),
        function(one, Some(helper)),
        function(other, Some(unused)),
    ];
    let whole = module(
        &entries,
        &[helper, unused, 100 + other, 100 + one],
        &functions,
    );
    let expected = module(&entries[..1], &[helper, 100 + one], &functions[1..3]);
    assert_eq!(with_entry(&whole, "one"), expected);
}
