//! Entry points of SPIR-V, one for each of many functions.

const OP_SOURCE: u32 = 3;
const OP_NAME: u32 = 5;
const OP_ENTRY_POINT: u32 = 15;
const OP_EXECUTION_MODE: u32 = 16;
const OP_FUNCTION: u32 = 54;
const OP_FUNCTION_END: u32 = 56;
const OP_DECORATE: u32 = 71;
const BINDING: u32 = 33;
/// Words of a module's header.
const HEADER: usize = 5;

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

/// The module with one of its entry points: drivers take their time for all of them.
pub(super) fn with_entry(words: &[u32], name: &str) -> Vec<u32> {
    let wanted = text_words(name);
    let mut entries = instructions(words).filter(|i| i[0] & 0xffff == OP_ENTRY_POINT);
    let entry = entries.find(|i| i[3..].starts_with(&wanted));
    let entry = entry.unwrap_or_else(|| panic!("no entry point '{name}'"))[2];
    let of_others = |i: &&[u32]| match i[0] & 0xffff {
        OP_ENTRY_POINT => i[2] != entry,
        OP_EXECUTION_MODE => i[1] != entry,
        _ => false,
    };
    let kept = instructions(words).filter(|i| !of_others(i));
    let kept = kept.flat_map(|i| i.iter().copied());
    words[..HEADER].iter().copied().chain(kept).collect()
}

/// The module with what is bound at `from` bound at `to`.
pub(super) fn with_binding(words: &[u32], from: u32, to: u32) -> Vec<u32> {
    let mut module = words[..HEADER].to_vec();
    for instruction in instructions(words) {
        let is_it = instruction[0] & 0xffff == OP_DECORATE && instruction[2..] == [BINDING, from];
        let last = instruction.len() - 1;
        module.extend(&instruction[..last]);
        module.push(if is_it { to } else { instruction[last] });
    }
    module
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
fn text_length(words: &[u32]) -> usize {
    let last = words.iter().position(|w| w.to_le_bytes().contains(&0));
    last.map_or(words.len(), |at| at + 1)
}

fn text_words(text: &str) -> Vec<u32> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize(4 * (text.len() / 4 + 1), 0);
    let words = bytes.as_chunks().0.iter();
    words.map(|bytes| u32::from_le_bytes(*bytes)).collect()
}

fn instructions(words: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let start = at;
        at += (words.get(at)? >> 16).max(1) as usize;
        words.get(start..at)
    })
}
