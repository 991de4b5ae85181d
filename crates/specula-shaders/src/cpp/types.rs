//! Types of WGSL, and how C++ writes them.

use std::collections::BTreeMap;

/// A type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Bool,
    Float,
    Word,
    /// A number without a point or a suffix.
    Integer,
    /// Two to four floats.
    Floats(usize),
    /// Two or three words.
    Words(usize),
    /// What a comparison of vectors gives.
    Bools(usize),
    Structure(String),
    /// Elements and their number, as it is written.
    Array(Box<Type>, String),
    Pointer(Box<Type>),
    /// What a function gives that gives nothing.
    Nothing,
}

impl Type {
    /// The type of this name, where it needs no more words.
    pub(super) fn plain(name: &str) -> Option<Self> {
        Some(match name {
            "bool" => Self::Bool,
            "f32" => Self::Float,
            "u32" => Self::Word,
            "vec2f" => Self::Floats(2),
            "vec3f" => Self::Floats(3),
            "vec4f" => Self::Floats(4),
            "vec2u" => Self::Words(2),
            "vec3u" => Self::Words(3),
            _ => return None,
        })
    }

    /// In C++; arrays and pointers have a form of their own where they are declared.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Bool => "bool".to_owned(),
            Self::Float => "float".to_owned(),
            Self::Word => "uint32_t".to_owned(),
            Self::Integer => "int".to_owned(),
            Self::Floats(n) => format!("vec{n}f"),
            Self::Words(n) => format!("vec{n}u"),
            Self::Bools(n) => format!("vec{n}b"),
            Self::Structure(name) => name.clone(),
            Self::Array(element, _) | Self::Pointer(element) => element.name(),
            Self::Nothing => "void".to_owned(),
        }
    }

    /// A declaration of this type: `float rates[4]`.
    pub(super) fn declared(&self, name: &str) -> String {
        match self {
            Self::Array(element, count) => element.declared(&format!("{name}[{count}]")),
            Self::Pointer(target) => match &**target {
                Self::Array(..) => target.declared(&format!("(&{name})")),
                target => format!("{}& {name}", target.name()),
            },
            other => format!("{} {name}", other.name()),
        }
    }

    /// What a pointer points at, and any other type itself.
    pub(super) fn target(&self) -> &Self {
        match self {
            Self::Pointer(target) => target,
            other => other,
        }
    }
}

/// A function's arguments and what it gives.
#[derive(Clone, Debug)]
pub(super) struct Signature {
    pub(super) arguments: Vec<(String, Type)>,
    pub(super) result: Type,
}

/// What has been declared at module scope.
#[derive(Clone, Debug, Default)]
pub(super) struct Scope {
    pub(super) structures: BTreeMap<String, Vec<(String, Type)>>,
    pub(super) functions: BTreeMap<String, Signature>,
    pub(super) values: BTreeMap<String, Type>,
}

impl Scope {
    /// Whether a value of a type is or holds one of another.
    pub(super) fn holds(&self, outer: &Type, inner: &Type) -> bool {
        outer == inner
            || match outer {
                Type::Structure(name) => {
                    let fields = self.structures.get(name);
                    fields.is_some_and(|f| f.iter().any(|(_, field)| self.holds(field, inner)))
                }
                Type::Array(element, _) => self.holds(element, inner),
                _ => false,
            }
    }
}

/// Swizzles that the prelude has, by the letters of WGSL and those of C++.
const SWIZZLES: [(&str, &str); 8] = [
    ("xy", "xy"),
    ("yx", "yx"),
    ("yz", "yz"),
    ("xyz", "xyz"),
    ("yxz", "yxz"),
    ("yzx", "yzx"),
    ("rgb", "xyz"),
    ("rg", "xy"),
];

/// Some components of a vector: the type and how C++ writes them.
pub(super) fn components(vector: &Type, letters: &str) -> Option<(Type, String)> {
    let (size, scalar) = match vector {
        Type::Floats(n) => (*n, Type::Float),
        Type::Words(n) => (*n, Type::Word),
        _ => return None,
    };
    let place = |letter: char| "xyzw".find(letter).or_else(|| "rgba".find(letter));
    let mut places = letters.chars().map(place);
    if !places.all(|p| p.is_some_and(|p| p < size)) {
        return None;
    }
    if letters.len() == 1 {
        let at = letters.chars().next().and_then(place)?;
        return Some((scalar, "xyzw"[at..=at].to_owned()));
    }
    let (_, name) = SWIZZLES.iter().find(|(wgsl, _)| *wgsl == letters)?;
    let is_float = scalar == Type::Float;
    is_float.then(|| (Type::Floats(letters.len()), format!("{name}()")))
}

/// A function by its name and the types of its arguments, as the prelude's declarations have them:
/// `operator*(vec3f,float)`.
pub(super) fn signature(name: &str, arguments: &[Type]) -> String {
    let known = arguments.iter().find(|a| **a != Type::Integer);
    // A number without a point is what stands beside it.
    let number = match known {
        Some(Type::Word | Type::Words(_)) => Type::Word,
        _ => Type::Float,
    };
    let plain = |argument: &Type| match argument {
        Type::Integer => number.name(),
        other => other.target().name(),
    };
    let arguments: Vec<String> = arguments.iter().map(plain).collect();
    format!("{name}({})", arguments.join(","))
}

/// What a function of WGSL gives for the types of its arguments; the prelude has it under the same name.
pub(super) fn builtin(name: &str, arguments: &[Type]) -> Option<Type> {
    let floats = arguments.iter().find(|a| matches!(a, Type::Floats(_)));
    match name {
        "abs" | "clamp" | "cross" | "exp" | "floor" | "fract" | "log" | "max" | "min"
        | "normalize" | "select" | "sqrt" => {
            let known = arguments.iter().find(|a| **a != Type::Integer);
            floats.or(known).cloned()
        }
        "dot" | "length" => Some(Type::Float),
        "any" => Some(Type::Bool),
        _ => None,
    }
}

/// The function of C for one float; the prelude has the others under the names of WGSL.
pub(super) fn of_floats(name: &str, arguments: &[Type]) -> Option<&'static str> {
    let functions = [
        ("abs", "fabsf"),
        ("exp", "expf"),
        ("floor", "floorf"),
        ("log", "logf"),
        ("sqrt", "sqrtf"),
    ];
    let found = functions.iter().find(|(wgsl, _)| *wgsl == name)?;
    matches!(arguments, [Type::Float]).then_some(found.1)
}

/// Names that C++ keeps for itself, and two that headers of Windows define as macros.
const RESERVED: &str = " alignas alignof and asm auto bitand bitor bool case catch char class compl const constexpr \
    const_cast continue decltype default delete do double dynamic_cast else enum explicit export extern false far \
    float for friend goto if inline int long mutable namespace near new noexcept not nullptr operator or private \
    protected public register reinterpret_cast return short signed sizeof static static_assert static_cast struct \
    switch template this thread_local throw true try typedef typeid typename union unsigned using virtual void \
    volatile while xor ";

/// A name of WGSL as C++ has it: with an underscore where it is reserved.
pub(super) fn name(wgsl: &str) -> String {
    if RESERVED.contains(&format!(" {wgsl} ")) {
        format!("{wgsl}_")
    } else {
        wgsl.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_read_as_in_cpp() {
        let four = Type::Array(Box::new(Type::Float), "FOUR".to_owned());
        assert_eq!(four.declared("a"), "float a[FOUR]");
        assert_eq!(
            Type::Pointer(Box::new(four)).declared("a"),
            "float (&a)[FOUR]"
        );
        let stream = Type::Structure("StreamState".to_owned());
        assert_eq!(
            Type::Pointer(Box::new(stream)).declared("s"),
            "StreamState& s"
        );
        assert_eq!(name("long"), "long_");
        assert_eq!(name("lon"), "lon");
    }

    #[test]
    fn components_are_members_or_functions() {
        let written =
            |size, letters| components(&Type::Floats(size), letters).map(|(_, text)| text);
        assert_eq!(written(3, "b").as_deref(), Some("z"));
        assert_eq!(written(4, "rgb").as_deref(), Some("xyz()"));
        assert_eq!(written(3, "w"), None);
        assert_eq!(written(3, "zzz"), None);
        assert_eq!(components(&Type::Words(2), "yx"), None);
    }

    #[test]
    fn the_prelude_has_every_swizzle() {
        let prelude = include_str!("prelude.hpp");
        for (_, name) in SWIZZLES {
            assert!(prelude.contains(&format!(" {name}() const")), "{name}");
        }
    }
}
