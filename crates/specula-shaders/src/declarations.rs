//! What a module declares, with its doc comments.
//!
//! Read line by line: in these files declarations of module scope begin in the first column, and
//! nothing else but comments, imports, attributes and closing brackets does. A test holds that every
//! name that naga finds is found here.

/// A declaration of module scope.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declaration<'a> {
    /// What is declared.
    pub kind: DeclarationKind,
    /// Its name.
    pub name: &'a str,
    /// The lines of its doc comment, without `/// `.
    pub docs: Vec<&'a str>,
}

/// What a declaration declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeclarationKind {
    /// `fn`
    Function,
    /// `struct`
    Struct,
    /// `const`
    Constant,
    /// `alias`
    Alias,
    /// `var`
    Variable,
}

/// The declarations of a WGSL text, in order.
#[must_use]
pub fn declarations(text: &str) -> Vec<Declaration<'_>> {
    let mut found = Vec::new();
    let mut docs = Vec::new();
    for line in text.lines() {
        if let Some(doc) = line.strip_prefix("///") {
            docs.push(doc.strip_prefix(' ').unwrap_or(doc));
        } else if let Some((kind, name)) = declared(line) {
            found.push(Declaration {
                kind,
                name,
                docs: std::mem::take(&mut docs),
            });
        } else if !line.starts_with('@') {
            docs.clear();
        }
    }
    found
}

/// A field of a structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field<'a> {
    /// The structure.
    pub structure: &'a str,
    /// Its name.
    pub name: &'a str,
    /// The lines of its doc comment, without `/// `.
    pub docs: Vec<&'a str>,
}

/// The fields of all structures of a WGSL text, in order; each on a line of its own.
#[must_use]
pub fn fields(text: &str) -> Vec<Field<'_>> {
    let mut found = Vec::new();
    let mut docs = Vec::new();
    let mut structure = None;
    for line in text.lines() {
        if let Some((DeclarationKind::Struct, name)) = declared(line) {
            structure = Some(name);
            docs.clear();
        } else if line.starts_with('}') {
            structure = None;
        }
        let (Some(structure), inner) = (structure, line.trim_start()) else {
            continue;
        };
        if let Some(doc) = inner.strip_prefix("///") {
            docs.push(doc.strip_prefix(' ').unwrap_or(doc));
        } else if let Some((name, _)) = without_attributes(inner).split_once(':')
            && !inner.starts_with("//")
        {
            found.push(Field {
                structure,
                name: name.trim(),
                docs: std::mem::take(&mut docs),
            });
        }
    }
    found
}

/// The kind and the name of what begins on this line.
pub(crate) fn declared(line: &str) -> Option<(DeclarationKind, &str)> {
    let declaration = without_attributes(line);
    let (keyword, rest) = declaration.split_at_checked(declaration.find([' ', '<'])?)?;
    let kind = match keyword {
        "fn" => DeclarationKind::Function,
        "struct" => DeclarationKind::Struct,
        "const" => DeclarationKind::Constant,
        "alias" => DeclarationKind::Alias,
        "var" => DeclarationKind::Variable,
        _ => return None,
    };
    let rest = match rest.strip_prefix('<') {
        Some(space) => space.split_once('>')?.1,
        None => rest,
    };
    let rest = rest.trim_start();
    let end = rest.find(|c: char| c != '_' && !c.is_ascii_alphanumeric());
    Some((kind, &rest[..end.unwrap_or(rest.len())]))
}

/// A line behind its attributes, such as `@group(0) @binding(0) `.
fn without_attributes(line: &str) -> &str {
    let mut rest = line;
    while let Some(attribute) = rest.strip_prefix('@') {
        let end = attribute.find(' ').unwrap_or(attribute.len());
        rest = attribute[end..].trim_start();
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_found_with_its_documentation() {
        let text = "// Head.\n\n/// Half.\nconst A_B: f32 = 0.5;\n/// Lost.\n\nstruct Pair {\n\
                    \x20   /// First.\n    a: f32,\n}\n\n/// F.\n///\n///     code\n@must_use\n\
                    fn f_g(pair: Pair) -> f32 {\n    const c = 1.0;\n    return c;\n}\n\
                    /// T.\n@group(0) @binding(0) var<storage, read> t: array<f32>;\nalias W = f32;\n\
                    @compute @workgroup_size(64)\nfn main() {\n}\n";
        let found = declarations(text);
        let rows: Vec<(DeclarationKind, &str, usize)> = found
            .iter()
            .map(|d| (d.kind, d.name, d.docs.len()))
            .collect();
        assert_eq!(
            rows,
            [
                (DeclarationKind::Constant, "A_B", 1),
                (DeclarationKind::Struct, "Pair", 0),
                (DeclarationKind::Function, "f_g", 3),
                (DeclarationKind::Variable, "t", 1),
                (DeclarationKind::Alias, "W", 0),
                (DeclarationKind::Function, "main", 0),
            ]
        );
        assert_eq!(found[2].docs, ["F.", "", "    code"]);
    }

    #[test]
    fn fields_are_found_with_their_documentation() {
        let text = "/// Pair.\nstruct Pair {\n    /// First.\n    a: f32,\n    // Aside: no.\n\
                    \x20   @align(16) b: vec3f,\n}\nfn f() {\n    let c: f32 = 1.0;\n}\n";
        let rows: Vec<_> = fields(text)
            .into_iter()
            .map(|f| (f.structure, f.name, f.docs))
            .collect();
        assert_eq!(
            rows,
            [("Pair", "a", vec!["First."]), ("Pair", "b", Vec::new())]
        );
    }
}
