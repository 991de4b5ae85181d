//! SPIR-V: a library whose functions can be linked by name.

const OP_NAME: u32 = 5;
const OP_FUNCTION: u32 = 54;
const OP_DECORATE: u32 = 71;
const LINKAGE_ATTRIBUTES: u32 = 41;
const EXPORT: u32 = 0;
/// Words of a module's header.
const HEADER: usize = 5;
/// Instructions of the sections in front of decorations: capabilities, extensions, the memory model,
/// entry points, names (SPIR-V 1.6, 2.4).
const BEFORE_DECORATIONS: [u32; 12] = [3, 4, 5, 6, 7, 8, 10, 11, 14, 15, 16, 17];

/// The module with an export decoration for every function that has a name, so that `spirv-link` finds
/// it.
pub(crate) fn with_exports(words: &[u32]) -> Vec<u32> {
    let functions: Vec<u32> = instructions(words)
        .filter(|(_, i)| opcode(i) == OP_FUNCTION)
        .map(|(_, i)| i[2])
        .collect();
    let named = instructions(words)
        .filter(|(_, i)| opcode(i) == OP_NAME && functions.contains(&i[1]))
        .flat_map(|(_, i)| export(i[1], &i[2..]));
    let at = instructions(words)
        .find(|(_, i)| !BEFORE_DECORATIONS.contains(&opcode(i)))
        .map_or(words.len(), |(at, _)| at);
    let (before, after) = words.split_at(at);
    let mut module = before.to_vec();
    module.extend(named);
    module.extend(after);
    module
}

/// `OpDecorate id LinkageAttributes "name" Export`.
fn export(id: u32, name: &[u32]) -> Vec<u32> {
    let count = u32::try_from(name.len()).unwrap_or(u32::MAX) + 4;
    let mut words = vec![count << 16 | OP_DECORATE, id, LINKAGE_ATTRIBUTES];
    words.extend(name);
    words.push(EXPORT);
    words
}

fn opcode(instruction: &[u32]) -> u32 {
    instruction[0] & 0xffff
}

/// The instructions with where they begin.
fn instructions(words: &[u32]) -> impl Iterator<Item = (usize, &[u32])> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let start = at;
        let length = (*words.get(at)? >> 16) as usize;
        at += length.max(1);
        Some((start, words.get(start..at)?))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_exported_in_front_of_decorations() {
        let name = u32::from_le_bytes(*b"cap\0");
        let head = [0x0723_0203, 0x0001_0300, 0, 20, 0];
        let names = [3 << 16 | OP_NAME, 7, name, 3 << 16 | OP_NAME, 8, name];
        let rest = [
            3 << 16 | OP_DECORATE,
            8,
            0,
            5 << 16 | OP_FUNCTION,
            1,
            7,
            0,
            2,
        ];
        let words = [&head[..], &names, &rest].concat();
        let decoration = [5 << 16 | OP_DECORATE, 7, LINKAGE_ATTRIBUTES, name, EXPORT];
        let expected = [&head[..], &names, &decoration, &rest].concat();
        assert_eq!(with_exports(&words), expected);
    }
}
