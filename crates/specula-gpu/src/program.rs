//! The shader of a scene: constants of its arrays, the library's modules, the tracer's modules, and a
//! switch over the kinds of material that it has.

use std::fmt::Write as _;

use specula_render::{FlatScene, MaterialShader, RenderOptions};
use specula_shaders::ComposeError;

use crate::tree::Tree;

/// The kernel that sums samples, complete in itself.
#[cfg(feature = "device")]
pub(crate) const SUMS: &str = include_str!("../wgsl/sums.wgsl");
/// Its entry point.
#[cfg(feature = "device")]
pub(crate) const SUMS_ENTRY: &str = "sums_main";
/// The kernel between two vertices of a wavefront, complete in itself.
#[cfg(feature = "device")]
pub(crate) const QUEUE_ADVANCE: &str = include_str!("../wgsl/queue_advance.wgsl");

/// Stands for a bound of indirect light where there is none; as a float it is not a number.
const UNCLAMPED: u32 = u32::MAX;

/// What a render asks of the shader, as `path_requests` in path.wgsl has it: seed, maximum depth, strategy, bound of
/// indirect light. Not constants: renders that differ by these share what is compiled.
pub(crate) fn settings(options: &RenderOptions) -> [u32; 4] {
    [
        options.seed,
        options.max_depth,
        options.strategy.code(),
        options.clamp.map_or(UNCLAMPED, f32::to_bits),
    ]
}

/// A module of the tracer.
struct Module {
    name: &'static str,
    text: &'static str,
}

impl Module {
    /// Whether it imports from another module of the tracer.
    fn imports_from(&self, module: &str) -> bool {
        let from = format!("import tracer::{module}::");
        self.text.lines().any(|line| line.starts_with(&from))
    }

    /// Whether it stores all parameters of a material.
    fn stores_parameters(&self) -> bool {
        self.text.contains("bound_store(")
    }
}

macro_rules! modules {
    ($($name:literal),* $(,)?) => {
        &[$(Module { name: $name, text: include_str!(concat!("../wgsl/", $name, ".wgsl")) }),*]
    };
}

/// Modules that every scene has, those that are imported before those that import.
const BEFORE: &[Module] = modules![
    "world",
    "sequence",
    "camera",
    "film",
    "ray",
    "ray_cone",
    "quadric",
    "texture_coordinates",
    "surface",
    "texture_mapping",
    "texture_noise",
    "texture_raster",
    "texture_filter",
    "texture_graph",
    "angles",
    "octahedral",
    "parallelogram",
    "area",
    "piecewise",
    "textured",
    "spot",
    "projected",
    "sun",
    "delta",
    "environment",
    "light_node",
    "light_tree",
    "lights",
    "partials",
    "footprint",
    "slopes",
    "bump",
    "medium_stack",
    "visibility",
    "bound",
    "widened",
];

/// How rays are cast, one of which a shader has: by traversal of the tree, by ray queries.
const RAYS: &[Module] = modules!["traverse", "query"];

/// What modules of several kinds of material import.
const MATERIAL_PARTS: &[Module] = modules!["metal", "glass"];

macro_rules! material_modules {
    ($($(#[$doc:meta])* $name:ident = $code:literal, [$($module:literal)?];)*) => {
        &[$($(Module {
            name: $module,
            text: include_str!(concat!("../wgsl/", $module, ".wgsl")),
        },)?)*]
    };
}

/// Kinds of material; only those that a scene has are in its shader.
const MATERIALS: &[Module] = specula_render::material_shader_table!(material_modules);

/// What comes behind the switch over materials.
const AFTER: &[Module] = modules!["path", "queue_state", "queue"];

/// The shader's text.
///
/// * `queries`: whether rays are cast by the adapter's ray queries.
pub(crate) fn source(flat: &FlatScene<'_>, queries: bool) -> Result<String, ComposeError> {
    let named = |m: &&Module| flat.shaders.iter().any(|s| s.module() == Some(m.name));
    let kinds: Vec<&Module> = MATERIALS.iter().filter(named).collect();
    let parts = MATERIAL_PARTS
        .iter()
        .filter(|part| kinds.iter().any(|kind| kind.imports_from(part.name)));
    let rays = &RAYS[usize::from(queries)];
    let used = parts.chain(kinds.iter().copied());
    let tracer: Vec<&Module> = BEFORE.iter().chain([rays]).chain(used).collect();
    let imports = tracer
        .iter()
        .copied()
        .chain(AFTER)
        .flat_map(|m| library_modules(m.text));
    let mut library: Vec<&str> = imports.collect();
    library.sort_unstable();
    library.dedup();
    let mut text = String::new();
    if queries {
        text += "enable wgpu_ray_query;\n";
    }
    text += &constants(flat, &kinds);
    text += &composed(&library)?;
    for module in &tracer {
        text += &code(module.text);
    }
    text += &dispatch(flat);
    for module in AFTER {
        text += &code(module.text);
    }
    Ok(text)
}

/// The library's module that reads measured materials, and what reads them from the scene's words in its place.
const MEASURED_TABLE: (&str, &str) = (
    "measured/measured_table",
    include_str!("../wgsl/measured_words.wgsl"),
);

/// The library's modules with what they import.
fn composed(library: &[&str]) -> Result<String, ComposeError> {
    let modules = specula_shaders::ordered(library)?;
    let parts = modules.iter().map(|module| match MEASURED_TABLE {
        (path, text) if path == module.path => code(text),
        _ => module.code(),
    });
    Ok(parts.collect::<Vec<_>>().join("\n"))
}

/// Modules of rays alone, besides those that cast them.
#[cfg(feature = "device")]
const OF_RAYS: [&str; 6] = [
    "world",
    "ray",
    "quadric",
    "angles",
    "texture_coordinates",
    "surface",
];

/// The text of a shader that casts rays and nothing else.
///
/// * `queries`: whether rays are cast by the adapter's ray queries.
#[cfg(feature = "device")]
pub(crate) fn rays(flat: &FlatScene<'_>, queries: bool) -> String {
    let mut text = String::new();
    if queries {
        text += "enable wgpu_ray_query;\n";
    }
    text += &constants(flat, &[]);
    let named = |name: &&str| BEFORE.iter().find(|module| module.name == *name);
    for module in OF_RAYS.iter().filter_map(named) {
        text += &code(module.text);
    }
    text += &code(RAYS[usize::from(queries)].text);
    text += &code(include_str!("../wgsl/cast.wgsl"));
    text
}

/// A module without its imports.
fn code(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.starts_with("import "));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// Paths (`ndf/ggx`) of the library's modules that a module imports from.
fn library_modules(text: &'static str) -> impl Iterator<Item = &'static str> {
    let imports = text
        .lines()
        .filter_map(|l| l.strip_prefix("import package::"));
    // The last part but the braces is the module's name, unique over all folders.
    imports.filter_map(|path| path.split("::{").next()?.rsplit("::").next())
}

/// * `kinds`: the modules of the scene's kinds of material.
fn constants(flat: &FlatScene<'_>, kinds: &[&Module]) -> String {
    let stored = match kinds.iter().any(|kind| kind.stores_parameters()) {
        true => 12,
        false => 1,
    };
    let own = [
        (
            "STACK_SIZE",
            Tree::stack_size(flat.constant("TREE_DEPTH").unwrap_or(0)),
        ),
        ("BOUND_STORED", stored),
        ("UNCLAMPED", UNCLAMPED),
    ];
    let mut text = String::from("// Constants of the scene.\n");
    text += &flat.declarations();
    for (name, value) in own {
        let _ = writeln!(text, "const {name}: u32 = {value}u;");
    }
    for &shader in MaterialShader::ALL {
        let _ = writeln!(
            text,
            "const {}: u32 = {}u;",
            code_name(shader),
            shader as u32
        );
    }
    text
}

/// The constant that holds a material's code: `KIND_COATED_DIFFUSE`.
fn code_name(shader: MaterialShader) -> String {
    let mut name = String::from("KIND");
    for c in format!("{shader:?}").chars() {
        if c.is_ascii_uppercase() {
            name.push('_');
        }
        name.push(c.to_ascii_uppercase());
    }
    name
}

/// The choice of a mix among its materials.
const CHOICE: &str = "\
    for (var level = 0u; level < 16u && word(record + MATERIAL_KIND) == KIND_MIX; level += 1u) {
        let at = record + MATERIAL_PARAMETERS + 1u;
        let amount = parameter_float(at, place);
        let by_chance = sequence_hashed(s, vec3u(depth, level, 0u)) < amount;
        let by_side = word(at + 6u) != 0u;
        let second = select(by_chance, !outside, by_side);
        seen_outside = seen_outside || by_side;
        chosen = word(at + select(4u, 5u, second));
        record = word(MATERIALS + chosen);
        one_sided = one_sided || word(record + MATERIAL_ONE_SIDED) != 0u;
    }
";

/// The switch over the scene's kinds of material.
fn dispatch(flat: &FlatScene<'_>) -> String {
    let kinds = || {
        let shaders = flat.shaders.iter();
        shaders.filter_map(|&shader| Some((code_name(shader), shader.module()?)))
    };
    let arms = |call: &str| -> String {
        kinds()
            .map(|(code, module)| format!("        case {code}: {{ return {module}_{call}; }}\n"))
            .collect()
    };
    let bind = |(code, module): (String, &str)| {
        format!("            case {code}: {{ b = {module}_bind(head, p, seen_outside); }}\n")
    };
    // Not where there is no mix: every evaluation of a texture makes a shader larger.
    let has_mix = flat.shaders.contains(&MaterialShader::Mix);
    let choice = if has_mix { CHOICE } else { "" };
    let turns = flat.constants.contains(&("HAS_DIRECTIONS", 1));
    let turn = if turns {
        "        head.rotation += bound_direction(record, place);\n"
    } else {
        ""
    };
    format!(
        "
/// The material of a surface at a point; mixes choose by chance, others by the side.
///
/// Twin: specula-render/src/material/mod.rs, Materials::at.
fn material_bind(material: u32, place: TextureCoordinates, outside: bool, s: Sequence, depth: u32) -> Bound {{
    var chosen = material;
    var record = word(MATERIALS + chosen);
    var one_sided = word(record + MATERIAL_ONE_SIDED) != 0u;
    // Materials of sides are seen as from their own outsides.
    var seen_outside = outside;
{choice}    var b = bound_black();
    if seen_outside || !one_sided {{
        var head = bound_head(record);
{turn}        let p = bound_parameters(record, place);
        switch word(record + MATERIAL_KIND) {{
{bind}            default: {{}}
        }}
    }}
    b.material = chosen;
    return b;
}}

/// `f |cos|` and its density, in 1/sr.
fn material_eval(b: Bound, wo: vec3f, wi: vec3f, stream: vec2u) -> vec4f {{
    switch b.kind {{
{eval}        default: {{ return vec4f(0.0); }}
    }}
}}

/// Samples a direction.
fn material_sample(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {{
    switch b.kind {{
{sample}        default: {{ return bsdf_sample_none(); }}
    }}
}}

/// Albedo, as a feature for denoisers.
fn material_albedo(b: Bound) -> vec3f {{
    switch b.kind {{
{albedo}        default: {{ return vec3f(0.0); }}
    }}
}}
",
        bind = kinds().map(bind).collect::<String>(),
        eval = arms("eval(b, wo, wi, stream)"),
        sample = arms("sample(b, wo, u, stream)"),
        albedo = arms("albedo(b)"),
    )
}

#[cfg(test)]
mod tests {
    use specula_shaders::{MODULES, declarations};

    use super::*;

    #[test]
    fn names_are_unique_over_the_tracer_and_the_library() {
        for rays in RAYS {
            let materials = MATERIAL_PARTS.iter().chain(MATERIALS);
            let tracer = BEFORE.iter().chain([rays]).chain(materials).chain(AFTER);
            let own =
                tracer.flat_map(|m| declarations(m.text).into_iter().map(|d| (d.name, m.name)));
            let library = MODULES
                .iter()
                .flat_map(|m| declarations(m.text).into_iter().map(|d| (d.name, m.path)));
            let mut all: Vec<(&str, &str)> = own.chain(library).collect();
            all.sort_unstable();
            for pair in all.windows(2) {
                assert_ne!(pair[0].0, pair[1].0, "{pair:?}");
            }
            assert!(all.len() > 500);
        }
    }

    #[test]
    fn modules_import_what_is_there() {
        let materials = MATERIAL_PARTS.iter().chain(MATERIALS);
        let every = BEFORE.iter().chain(RAYS).chain(materials).chain(AFTER);
        let tracer: Vec<&Module> = every.collect();
        for module in &tracer {
            for line in module.text.lines() {
                let Some(path) = line.strip_prefix("import tracer::") else {
                    continue;
                };
                let (from, names) = path.split_once("::{").unwrap_or((path, ""));
                // What is written for each scene.
                if from == "material" {
                    continue;
                }
                let other = tracer.iter().find(|m| m.name == from);
                let text = other.map_or("", |m| m.text);
                for name in names.trim_end_matches("};").split(", ") {
                    let there = declarations(text).iter().any(|d| d.name == name);
                    assert!(there, "{}: {line}: no {name}", module.name);
                }
            }
        }
    }

    /// The lobe that no material's module imports: `bound_black` stands for it.
    const WITHOUT_MATERIAL: &str = "Black";

    macro_rules! shaders_of_lobes {
        ($($(#[$doc:meta])* $name:ident: $lobe:ty, $sides:ident, $batch:ident, $shader:literal;)*) => {
            &[$((stringify!($name), $shader)),*]
        };
    }

    #[test]
    fn every_lobe_has_a_material_that_imports_it() {
        let lobes: &[(&str, &str)] = specula_bsdf::lobe_table!(shaders_of_lobes);
        for (lobe, shader) in lobes {
            let import = format!("import package::{}::", shader.replace('/', "::"));
            let mut materials = MATERIAL_PARTS.iter().chain(MATERIALS);
            let is_there = materials.any(|m| m.text.contains(&import));
            assert!(
                is_there || *lobe == WITHOUT_MATERIAL,
                "lobe {lobe}: no specula-gpu/wgsl/material_*.wgsl imports {shader}"
            );
        }
    }

    #[test]
    fn only_mixes_interfaces_and_hair_have_no_module() {
        for &shader in MaterialShader::ALL {
            let is_none = matches!(
                shader,
                MaterialShader::Mix | MaterialShader::Interface | MaterialShader::Hair
            );
            assert_eq!(shader.module().is_none(), is_none, "{shader:?}");
        }
    }
}
