//! Modules and all that they import, in the order of their dependencies, as one WGSL text.
//!
//! Modules are concatenated as they are, so that comments and names survive. Nothing is renamed: names
//! begin with their module's, and are unique.

use crate::error::ComposeError;
use crate::modules::{MODULES, Module};
use crate::names::nearest;

/// The wanted modules and all that they import, each behind what it imports; all modules where none
/// is named.
///
/// * `wanted`: names such as `bounded`, or paths such as `vndf/bounded`.
///
/// # Errors
///
/// A name that no module has.
pub fn ordered(wanted: &[&str]) -> Result<Vec<Module<'static>>, ComposeError> {
    order(MODULES, wanted)
}

/// One WGSL text of what [`ordered`] lists: the files as they are, without their imports.
///
/// # Errors
///
/// A name that no module has.
pub fn compose(wanted: &[&str]) -> Result<String, ComposeError> {
    let parts: Vec<String> = ordered(wanted)?.iter().map(Module::code).collect();
    Ok(parts.join("\n"))
}

fn order(
    modules: &[Module<'static>],
    wanted: &[&str],
) -> Result<Vec<Module<'static>>, ComposeError> {
    let mut visit = Visit {
        modules,
        done: Vec::new(),
        open: Vec::new(),
    };
    for module in modules.iter().filter(|_| wanted.is_empty()) {
        visit.module(module)?;
    }
    for name in wanted {
        let named = |m: &&Module| m.name() == *name || m.path == *name;
        let module = modules.iter().find(named).ok_or_else(|| {
            let names = modules.iter().map(Module::name);
            ComposeError::UnknownModule {
                name: (*name).to_owned(),
                nearest: nearest(name, names),
            }
        })?;
        visit.module(module)?;
    }
    Ok(visit.done)
}

/// A depth-first walk along imports.
struct Visit<'a> {
    modules: &'a [Module<'static>],
    /// Modules whose imports are in front of them.
    done: Vec<Module<'static>>,
    /// The modules that led here.
    open: Vec<&'static str>,
}

impl Visit<'_> {
    fn module(&mut self, module: &Module<'static>) -> Result<(), ComposeError> {
        if self.done.contains(module) {
            return Ok(());
        }
        let seen = self.open.iter().position(|p| *p == module.path);
        self.open.push(module.path);
        if let Some(first) = seen {
            let cycle = &self.open[first..];
            return Err(ComposeError::Cycle(
                cycle.iter().map(|&p| p.to_owned()).collect(),
            ));
        }
        for import in module.imports()? {
            let modules = self.modules;
            let Some(imported) = modules.iter().find(|m| m.path == import.path) else {
                return Err(ComposeError::UnknownImport {
                    module: module.path.to_owned(),
                    path: import.path,
                });
            };
            self.module(imported)?;
        }
        self.open.pop();
        self.done.push(*module);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHAIN: [Module<'static>; 4] = [
        module("vndf/bounded", "import package::vndf::cap::cap_f;\n"),
        module(
            "vndf/cap",
            "import package::alpha::a;\nimport package::ndf::ggx::{d, e};\n",
        ),
        module("ndf/ggx", "import package::alpha::a;\n"),
        module("alpha", "\n"),
    ];

    const fn module(path: &'static str, text: &'static str) -> Module<'static> {
        Module { path, text }
    }

    fn paths(modules: &[Module<'static>], wanted: &[&str]) -> Vec<&'static str> {
        let ordered = order(modules, wanted).unwrap();
        ordered.iter().map(|m| m.path).collect()
    }

    #[test]
    fn what_is_imported_comes_first_and_once() {
        let all = ["alpha", "ndf/ggx", "vndf/cap", "vndf/bounded"];
        assert_eq!(paths(&CHAIN, &[]), all);
        assert_eq!(paths(&CHAIN, &["bounded"]), all);
        assert_eq!(paths(&CHAIN, &["vndf/cap", "ggx"]), all[..3]);
        assert_eq!(paths(&CHAIN, &["alpha"]), ["alpha"]);
    }

    #[test]
    fn unknown_modules_are_told_with_their_neighbours() {
        let error = order(&CHAIN, &["bound"]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "there is no module `bound`; did you mean `bounded`?"
        );
        let error = order(&CHAIN, &["microflake"]).unwrap_err();
        assert_eq!(error.to_string(), "there is no module `microflake`");
    }

    #[test]
    fn unknown_imports_and_cycles_are_told() {
        let lost = [module("a", "import package::ndf::b::c;\n")];
        assert_eq!(
            order(&lost, &[]).unwrap_err().to_string(),
            "module `a` imports from `ndf/b`, which does not exist"
        );
        let round = [
            module("a", "import package::b::x;\n"),
            module("b", "import package::c::x;\n"),
            module("c", "import package::b::x;\n"),
        ];
        assert_eq!(
            order(&round, &[]).unwrap_err().to_string(),
            "modules import each other: b -> c -> b"
        );
        let odd = [module("a", "import b;\n")];
        assert_eq!(
            order(&odd, &[]).unwrap_err().to_string(),
            "module `a`: expected `import package::folder::module::{name};`, found `import b;`"
        );
    }
}
