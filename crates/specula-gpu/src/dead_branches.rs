//! Shaders without the branches that constants rule out.
//!
//! A scene's constants say what it lacks. Compilers of drivers inline all calls before they look for branches that are
//! never taken, and their time grows faster than the code; so these branches go first.

use wgpu::naga::compact::{KeepUnused, compact};
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use wgpu::naga::{
    Arena, BinaryOperator, Block, Constant, Expression, Function, Handle, Literal, LocalVariable,
    Module, Statement, UnaryOperator, front,
};

/// The module of a WGSL text, without branches that are never taken; `None` where the text is no valid WGSL.
pub(crate) fn parsed(text: &str) -> Option<Module> {
    let mut module = front::wgsl::parse_str(text).ok()?;
    // Compaction panics where the module is not valid.
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    validator.validate(&module).ok()?;
    let Module {
        functions,
        entry_points,
        constants,
        global_expressions,
        ..
    } = &mut module;
    let entries = entry_points.iter_mut().map(|entry| &mut entry.function);
    for function in functions.iter_mut().map(|(_, f)| f).chain(entries) {
        prune(function, constants, global_expressions);
    }
    // Expressions of branches that are gone.
    compact(&mut module, KeepUnused::Yes);
    Some(module)
}

fn prune(
    function: &mut Function,
    constants: &Arena<Constant>,
    global_expressions: &Arena<Expression>,
) {
    // Names keep the expressions of a branch that is gone.
    function.named_expressions.clear();
    let mut stores = Vec::new();
    // A temporary of `a && b` may be a constant once a branch is gone, and rule out another.
    loop {
        let values = Values {
            expressions: &function.expressions,
            constants,
            global_expressions,
            variables: &function.local_variables,
            stores: &stores,
        };
        let mut kept = Kept::default();
        let body = values.taken(std::mem::take(&mut function.body), &mut kept);
        function.body = body;
        stores = kept.stores;
        if !kept.is_changed {
            return;
        }
    }
}

/// What is known of a function's values before it runs.
struct Values<'a> {
    expressions: &'a Arena<Expression>,
    constants: &'a Arena<Constant>,
    global_expressions: &'a Arena<Expression>,
    variables: &'a Arena<LocalVariable>,
    /// All stores, pointers and values; none in the first round, which does not know of them.
    stores: &'a [Store],
}

/// The pointer and the value.
type Store = (Handle<Expression>, Handle<Expression>);

/// What a round has found.
#[derive(Default)]
struct Kept {
    stores: Vec<Store>,
    is_changed: bool,
}

impl Values<'_> {
    fn value(&self, expression: Handle<Expression>) -> Option<Literal> {
        match self.expressions[expression] {
            Expression::Literal(literal) => Some(literal),
            Expression::Constant(constant) => {
                match self.global_expressions[self.constants[constant].init] {
                    Expression::Literal(literal) => Some(literal),
                    _ => None,
                }
            }
            Expression::Unary {
                op: UnaryOperator::LogicalNot,
                expr,
            } => match self.value(expr)? {
                Literal::Bool(value) => Some(Literal::Bool(!value)),
                _ => None,
            },
            Expression::Binary { op, left, right } => {
                compared(op, self.value(left)?, self.value(right)?)
            }
            Expression::Load { pointer } => self.temporary(pointer),
            _ => None,
        }
    }

    /// The value of a variable without a name, which holds `a && b` or `a || b`, where it is stored once.
    ///
    /// The front end stores it in each branch before it loads it.
    fn temporary(&self, pointer: Handle<Expression>) -> Option<Literal> {
        let variable = |pointer| match self.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            _ => None,
        };
        let loaded = variable(pointer)?;
        let LocalVariable { name, init, .. } = &self.variables[loaded];
        if name.is_some() || init.is_some() {
            return None;
        }
        let mut stores = self.stores.iter().filter(|s| variable(s.0) == Some(loaded));
        let (_, value) = stores.next()?;
        if stores.next().is_some() {
            return None;
        }
        self.value(*value)
    }

    /// The block without what is never run.
    fn taken(&self, block: Block, kept: &mut Kept) -> Block {
        let mut rest = Block::with_capacity(block.len());
        for (mut statement, span) in block.span_into_iter() {
            if let Statement::If {
                condition,
                accept,
                reject,
            } = &mut statement
                && let Some(Literal::Bool(value)) = self.value(*condition)
            {
                kept.is_changed = true;
                let branch = if value { accept } else { reject };
                statement = Statement::Block(std::mem::take(branch));
            }
            let mut within = |inner: &mut Block| *inner = self.taken(std::mem::take(inner), kept);
            match &mut statement {
                Statement::Store { pointer, value } => kept.stores.push((*pointer, *value)),
                Statement::Block(inner) => within(inner),
                Statement::If { accept, reject, .. } => {
                    [accept, reject].into_iter().for_each(within)
                }
                Statement::Switch { cases, .. } => {
                    cases.iter_mut().for_each(|case| within(&mut case.body));
                }
                Statement::Loop {
                    body, continuing, ..
                } => [body, continuing].into_iter().for_each(within),
                _ => {}
            }
            let ends = leaves(&statement);
            rest.push(statement, span);
            if ends {
                break;
            }
        }
        rest
    }
}

/// Whether nothing that follows the statement is run.
fn leaves(statement: &Statement) -> bool {
    let last = |block: &Block| block.last().is_some_and(leaves);
    match statement {
        Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill => true,
        Statement::Block(block) => last(block),
        Statement::If { accept, reject, .. } => last(accept) && last(reject),
        _ => false,
    }
}

fn compared(op: BinaryOperator, a: Literal, b: Literal) -> Option<Literal> {
    let (Literal::U32(a), Literal::U32(b)) = (a, b) else {
        return None;
    };
    Some(Literal::Bool(match op {
        BinaryOperator::Equal => a == b,
        BinaryOperator::NotEqual => a != b,
        BinaryOperator::Less => a < b,
        BinaryOperator::LessEqual => a <= b,
        BinaryOperator::Greater => a > b,
        BinaryOperator::GreaterEqual => a >= b,
        _ => return None,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which of the functions `a` and `b` are called by a function with this body.
    fn called(body: &str) -> Vec<String> {
        let text = format!(
            "const NO: u32 = 0u;\nconst THREE: u32 = 3u;\n\
             fn a() -> f32 {{ return 1.0; }}\nfn b() -> f32 {{ return 2.0; }}\n\
             fn f(x: u32) -> f32 {{\n{body}\n}}\n\
             @compute @workgroup_size(1)\n\
             fn main(@builtin(local_invocation_index) x: u32) {{ _ = f(x); }}"
        );
        let mut module = parsed(&text).unwrap();
        compact(&mut module, KeepUnused::No);
        let functions = module.functions.iter();
        let names = functions.filter_map(|(_, function)| function.name.clone());
        names.filter(|name| name != "f").collect()
    }

    #[test]
    fn branches_that_are_never_taken_go() {
        assert_eq!(called("if NO != 0u { return a(); } return b();"), ["b"]);
        assert_eq!(called("if NO == 0u { return a(); } return b();"), ["a"]);
        assert_eq!(
            called("if !(THREE >= 4u) { return a(); } return b();"),
            ["a"]
        );
        assert_eq!(
            called("for (var i = 0u; i < x; i++) { if THREE < 2u { return a(); } } return b();"),
            ["b"]
        );
        assert_eq!(
            called("switch x { case 1u: { if NO != 0u { return a(); } } default: {} } return b();"),
            ["b"]
        );
    }

    #[test]
    fn conditions_of_a_constant_and_a_value_go_where_the_constant_decides() {
        assert_eq!(
            called("if NO != 0u && x == 1u { return a(); } return b();"),
            ["b"]
        );
        assert_eq!(
            called("if NO == 0u || x == 1u { return a(); } return b();"),
            ["a"]
        );
        assert_eq!(
            called("if NO != 0u && x == 1u && x != 2u { return a(); } return b();"),
            ["b"]
        );
    }

    #[test]
    fn what_may_be_taken_stays() {
        assert_eq!(called("if x != 0u { return a(); } return b();"), ["a", "b"]);
        assert_eq!(
            called("if NO == 0u && x == 1u { return a(); } return b();"),
            ["a", "b"]
        );
        assert_eq!(
            called("if NO != 0u || x == 1u { return a(); } return b();"),
            ["a", "b"]
        );
        assert_eq!(
            called("var y = false; if x == 7u { y = true; } if y { return a(); } return b();"),
            ["a", "b"]
        );
    }

    #[test]
    fn what_is_no_shader_is_left_to_the_device() {
        assert!(parsed("fn main() { undefined(); }").is_none());
    }
}
