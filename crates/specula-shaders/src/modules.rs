//! The modules: the files of `wgsl/`.

use crate::error::ComposeError;

/// A file of `wgsl/`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Module<'a> {
    /// Where it is in `wgsl/`, without its extension: `vndf/bounded`.
    pub path: &'a str,
    /// The file.
    pub text: &'a str,
}

/// All modules, by folder: one for each file of `wgsl/`, listed by `build.rs`.
pub const MODULES: &[Module<'static>] = include!(concat!(env!("OUT_DIR"), "/modules.rs"));

/// Names that a module takes from another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Import {
    /// The other module's path: `ndf/ggx`.
    pub path: String,
    /// What is taken.
    pub names: Vec<String>,
}

impl<'a> Module<'a> {
    /// The file's stem, by which users ask for it: `bounded`.
    #[must_use]
    pub fn name(&self) -> &'a str {
        self.path.rsplit('/').next().unwrap_or(self.path)
    }

    /// The folder within `wgsl/`: `vndf`, `bsdf/layered`, or nothing.
    #[must_use]
    pub fn folder(&self) -> &'a str {
        self.path.rsplit_once('/').map_or("", |(folder, _)| folder)
    }

    /// What it is: the first sentence of the file.
    #[must_use]
    pub fn summary(&self) -> String {
        let lines = self.text.lines().map_while(|l| l.strip_prefix("//"));
        let head = lines.map(str::trim).take_while(|l| !l.is_empty());
        let head = head.collect::<Vec<_>>().join(" ");
        let end = sentence_end(&head).unwrap_or(head.len());
        head[..end].to_owned()
    }

    /// The statements that begin with `import`.
    ///
    /// # Errors
    ///
    /// One that is not `import package::folder::module::{name, name};`, on one line or several, or the
    /// same with one name and no braces.
    pub fn imports(&self) -> Result<Vec<Import>, ComposeError> {
        let mut imports = Vec::new();
        let mut statement = String::new();
        for (line, part) in self.lines() {
            if part == Part::Code {
                continue;
            }
            statement += line;
            if part == Part::Import {
                continue;
            }
            let import = parse_import(&statement).ok_or_else(|| ComposeError::Syntax {
                module: self.path.to_owned(),
                statement: statement.clone(),
            })?;
            imports.push(import);
            statement.clear();
        }
        Ok(imports)
    }

    /// The file without its imports and the empty lines that they would leave behind.
    #[must_use]
    pub fn code(&self) -> String {
        let mut code = String::with_capacity(self.text.len());
        let mut after_import = false;
        for (line, part) in self.lines() {
            if part != Part::Code {
                after_import = true;
            } else if !(after_import && line.is_empty() && code.ends_with("\n\n")) {
                code += line;
                code.push('\n');
                after_import = false;
            }
        }
        code
    }

    /// Lines with what they are part of.
    fn lines(&self) -> impl Iterator<Item = (&'a str, Part)> + use<'a> {
        let mut inside = false;
        self.text.lines().map(move |line| {
            let import = inside || line.starts_with("import ");
            inside = import && !line.ends_with(';');
            let part = match (import, inside) {
                (false, _) => Part::Code,
                (true, true) => Part::Import,
                (true, false) => Part::ImportEnd,
            };
            (line, part)
        })
    }
}

/// What a line is part of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// No import.
    Code,
    /// An import that goes on on the next line.
    Import,
    /// An import's last line.
    ImportEnd,
}

fn parse_import(statement: &str) -> Option<Import> {
    let path = statement
        .strip_prefix("import package::")?
        .strip_suffix(';')?;
    let (module, names) = path.rsplit_once("::")?;
    let names = match names.strip_prefix('{') {
        Some(list) => {
            let list = list.strip_suffix('}')?.trim_end();
            list.strip_suffix(',').unwrap_or(list)
        }
        None => names,
    };
    let names: Vec<String> = names.split(',').map(|n| n.trim().to_owned()).collect();
    let sound = |word: &str| {
        !word.is_empty() && word.chars().all(|c| c == '_' || c.is_ascii_alphanumeric())
    };
    (names.iter().all(|n| sound(n)) && module.split("::").all(sound)).then(|| Import {
        path: module.replace("::", "/"),
        names,
    })
}

/// Where the first sentence ends: behind a full stop that white space follows, but not `et al.`.
fn sentence_end(text: &str) -> Option<usize> {
    let mut stops = text.match_indices(". ").map(|(at, _)| at);
    stops
        .find(|&at| !text[..at].ends_with(" et al"))
        .map(|at| at + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLE: Module<'static> = Module {
        path: "bsdf/layered/walk",
        text: "// Walks (Guo et al. 2018) between layers. And\n// more.\n//\n// Source: none.\n\n\
               import package::ndf::ggx::{\n    ggx_d, ggx_lambda,\n};\n\
               import package::alpha::alpha_stretch;\n\n\
               /// F.\nfn walk_f() -> f32 {\n    return ggx_d();\n}\n",
    };

    #[test]
    fn names_folders_and_summaries() {
        assert_eq!(SAMPLE.name(), "walk");
        assert_eq!(SAMPLE.folder(), "bsdf/layered");
        assert_eq!(SAMPLE.summary(), "Walks (Guo et al. 2018) between layers.");
        let root = Module {
            path: "alpha",
            text: "// Alphas\n// of lobes\n",
        };
        assert_eq!(
            (root.name(), root.folder(), root.summary().as_str()),
            ("alpha", "", "Alphas of lobes")
        );
    }

    #[test]
    fn imports_are_read_and_dropped() {
        let imports = SAMPLE.imports().unwrap();
        assert_eq!(imports[0].path, "ndf/ggx");
        assert_eq!(imports[0].names, ["ggx_d", "ggx_lambda"]);
        assert_eq!(imports[1].path, "alpha");
        assert_eq!(imports[1].names, ["alpha_stretch"]);
        let code = SAMPLE.code();
        assert!(
            !code.contains("import") && !code.contains("lambda"),
            "{code}"
        );
        assert!(code.contains("// Source: none.\n\n/// F.\n"), "{code}");
    }

    #[test]
    fn other_import_lines_are_errors() {
        for line in [
            "import super::ggx::ggx_d;",
            "import package::ggx_d;",
            "import package::ndf::ggx::{ggx_d,, ggx_e};",
            "import package::ndf::ggx::{};",
            "import package::ndf::ggx::ggx_d as d;",
            "import package::ndf::ggx::ggx_d",
            "import package::ndf::{ggx::ggx_d};",
        ] {
            assert_eq!(parse_import(line), None, "{line}");
        }
    }
}
