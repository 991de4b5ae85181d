//! Shaders without the branches that constants rule out.
//!
//! A scene's constants say what it lacks. Compilers of drivers inline all calls before they look for branches that are
//! never taken, and their time grows faster than the code; so these branches go first.

use wgpu::naga::compact::{KeepUnused, compact};
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use wgpu::naga::{
    Arena, BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, Module,
    Statement, UnaryOperator, front,
};

/// The module of a WGSL text, without branches that are never taken; `None` where the text is no valid WGSL.
pub(crate) fn parsed(text: &str) -> Option<Module> {
    let mut module = front::wgsl::parse_str(text).ok()?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    validator.validate(&module).ok()?;
    prune_all(&mut module);
    // Expressions of branches that are gone.
    compact(&mut module, KeepUnused::Yes);
    Some(module)
}

fn prune_all(module: &mut Module) {
    let Module {
        functions,
        entry_points,
        constants,
        global_expressions,
        ..
    } = module;
    let constant = |expression: &Expression| match *expression {
        Expression::Literal(literal) => Some(literal),
        Expression::Constant(handle) => match global_expressions[constants[handle].init] {
            Expression::Literal(literal) => Some(literal),
            _ => None,
        },
        _ => None,
    };
    let entries = entry_points.iter_mut().map(|entry| &mut entry.function);
    for function in functions.iter_mut().map(|(_, f)| f).chain(entries) {
        prune(function, &constant);
    }
}

fn prune(function: &mut Function, constant: &dyn Fn(&Expression) -> Option<Literal>) {
    // Names keep the expressions of a branch that is gone.
    function.named_expressions.clear();
    // A temporary of `a && b` may be a constant once a branch is gone, and rule out another.
    loop {
        let values = Values {
            expressions: &function.expressions,
            constant,
            temporaries: temporaries(function, constant),
        };
        let mut is_changed = false;
        let body = values.taken(std::mem::take(&mut function.body), &mut is_changed);
        function.body = body;
        if !is_changed {
            return;
        }
    }
}

/// What is known of a function's values before it runs.
struct Values<'a> {
    expressions: &'a Arena<Expression>,
    /// Of literals and the module's constants.
    constant: &'a dyn Fn(&Expression) -> Option<Literal>,
    /// Values of temporaries that are stored once.
    temporaries: Vec<(Handle<LocalVariable>, Literal)>,
}

impl Values<'_> {
    fn value(&self, expression: Handle<Expression>) -> Option<Literal> {
        match self.expressions[expression] {
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
            Expression::Load { pointer } => {
                let Expression::LocalVariable(variable) = self.expressions[pointer] else {
                    return None;
                };
                let mut known = self.temporaries.iter();
                known.find(|(v, _)| *v == variable).map(|(_, value)| *value)
            }
            ref other => (self.constant)(other),
        }
    }

    /// The block without what is never run.
    fn taken(&self, block: Block, is_changed: &mut bool) -> Block {
        let mut kept = Block::with_capacity(block.len());
        for (mut statement, span) in block.span_into_iter() {
            match &mut statement {
                Statement::Block(inner) => *inner = self.taken(std::mem::take(inner), is_changed),
                Statement::If {
                    condition,
                    accept,
                    reject,
                } => {
                    let [accept, reject] =
                        [accept, reject].map(|b| (self.taken(std::mem::take(b), is_changed), b));
                    if let Some(Literal::Bool(value)) = self.value(*condition) {
                        *is_changed = true;
                        statement = Statement::Block(if value { accept.0 } else { reject.0 });
                    } else {
                        *accept.1 = accept.0;
                        *reject.1 = reject.0;
                    }
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        case.body = self.taken(std::mem::take(&mut case.body), is_changed);
                    }
                }
                Statement::Loop {
                    body, continuing, ..
                } => {
                    *body = self.taken(std::mem::take(body), is_changed);
                    *continuing = self.taken(std::mem::take(continuing), is_changed);
                }
                _ => {}
            }
            let ends = leaves(&statement);
            kept.push(statement, span);
            if ends {
                break;
            }
        }
        kept
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

/// Variables without a name, which hold `a && b` and `a || b`, where all that is stored there is one constant.
///
/// The front end stores them in each branch before it loads them.
fn temporaries(
    function: &Function,
    constant: &dyn Fn(&Expression) -> Option<Literal>,
) -> Vec<(Handle<LocalVariable>, Literal)> {
    let mut stores = Vec::new();
    collect_stores(&function.body, &mut stores);
    let unnamed = function.local_variables.iter();
    let unnamed =
        unnamed.filter(|(_, variable)| variable.name.is_none() && variable.init.is_none());
    let stored = |variable| {
        let to = |&&(pointer, _): &&(Handle<Expression>, _)| matches!(function.expressions[pointer], Expression::LocalVariable(v) if v == variable);
        let mut all = stores.iter().filter(to);
        let (_, value) = all.next()?;
        all.next().is_none().then_some(*value)
    };
    unnamed
        .filter_map(|(variable, _)| {
            let value = constant(&function.expressions[stored(variable)?])?;
            Some((variable, value))
        })
        .collect()
}

/// Pointers and values of all stores.
fn collect_stores(block: &Block, stores: &mut Vec<(Handle<Expression>, Handle<Expression>)>) {
    for statement in block {
        match statement {
            Statement::Store { pointer, value } => stores.push((*pointer, *value)),
            Statement::Block(block) => collect_stores(block, stores),
            Statement::If { accept, reject, .. } => {
                collect_stores(accept, stores);
                collect_stores(reject, stores);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    collect_stores(&case.body, stores);
                }
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                collect_stores(body, stores);
                collect_stores(continuing, stores);
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls in a function, in order.
    fn calls(module: &Module, name: &str) -> Vec<String> {
        fn collect(module: &Module, block: &Block, calls: &mut Vec<String>) {
            for statement in block {
                match statement {
                    Statement::Call { function, .. } => {
                        calls.push(module.functions[*function].name.clone().unwrap_or_default());
                    }
                    Statement::Block(block) => collect(module, block, calls),
                    Statement::If { accept, reject, .. } => {
                        collect(module, accept, calls);
                        collect(module, reject, calls);
                    }
                    Statement::Loop { body, .. } => collect(module, body, calls),
                    Statement::Switch { cases, .. } => {
                        for case in cases {
                            collect(module, &case.body, calls);
                        }
                    }
                    _ => {}
                }
            }
        }
        let named = |(_, f): &(_, &Function)| f.name.as_deref() == Some(name);
        let function = module.functions.iter().find(named).unwrap().1;
        let mut all = Vec::new();
        collect(module, &function.body, &mut all);
        all
    }

    fn called(body: &str) -> Vec<String> {
        let text = format!(
            "const NO: u32 = 0u;\nconst THREE: u32 = 3u;\n\
             fn a() -> f32 {{ return 1.0; }}\nfn b() -> f32 {{ return 2.0; }}\n\
             fn f(x: u32) -> f32 {{\n{body}\n}}"
        );
        calls(&parsed(&text).unwrap(), "f")
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
