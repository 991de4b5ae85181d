//! Operators between operands: which are applied first, and what they give.

use super::error::Failure;
use super::printer::Printer;
use super::types::Type;

/// Operators of two operands, those that bind first in front.
const PRECEDENCE: [&[&str]; 10] = [
    &["*", "/", "%"],
    &["+", "-"],
    &["<<", ">>"],
    &["<", "<=", ">", ">="],
    &["==", "!="],
    &["&"],
    &["^"],
    &["|"],
    &["&&"],
    &["||"],
];

/// Whether a sign stands between operands; a shift to the right is `>>`.
pub(super) fn is_operator(sign: &str) -> bool {
    PRECEDENCE.iter().any(|level| level.contains(&sign))
}

/// Types of operands, and the signs between them.
pub(super) struct Operands<'a> {
    types: Vec<Type>,
    signs: Vec<&'a str>,
}

impl<'a> Operands<'a> {
    pub(super) fn new(first: Type) -> Self {
        Self {
            types: vec![first],
            signs: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, sign: &'a str, operand: Type) {
        self.signs.push(sign);
        self.types.push(operand);
    }

    /// The type of all of it; notes the operators that the prelude has.
    pub(super) fn folded(mut self, printer: &mut Printer<'_>) -> Result<Type, Failure> {
        for level in PRECEDENCE {
            while let Some(at) = self.signs.iter().position(|sign| level.contains(sign)) {
                let sign = self.signs.remove(at);
                let right = self.types.remove(at + 1);
                let left = self.types[at].clone();
                let Some(found) = given(sign, &left, &right) else {
                    return Err(printer.failure("words of vectors are not compared"));
                };
                printer.take(&format!("operator{sign}"), &[left, right]);
                self.types[at] = found;
            }
        }
        Ok(self.types.swap_remove(0))
    }
}

/// What an operator gives; nothing where it compares vectors of words.
fn given(sign: &str, left: &Type, right: &Type) -> Option<Type> {
    let both = [left, right];
    let is_vector = |t: &&&Type| matches!(t, Type::Floats(_) | Type::Words(_) | Type::Bools(_));
    let vector = both.iter().find(is_vector).copied();
    let is_comparison = PRECEDENCE[3..5].concat().contains(&sign);
    Some(match vector {
        _ if matches!(sign, "&&" | "||") => Type::Bool,
        None if is_comparison => Type::Bool,
        Some(Type::Floats(n)) if is_comparison => Type::Bools(*n),
        Some(_) if is_comparison => return None,
        Some(vector) => vector.clone(),
        None if *left == Type::Integer => right.clone(),
        None => left.clone(),
    })
}
