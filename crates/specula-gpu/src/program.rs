//! The shader of a scene: constants of its arrays, the library's modules, the tracer's modules, and a
//! switch over the kinds of material that it has.

use std::fmt::Write as _;

use specula_render::{FlatScene, LobeKind, RenderOptions};
use specula_shaders::ComposeError;

/// The kernel that adds samples, complete in itself.
pub(crate) const SUMS: &str = include_str!("../wgsl/sums.wgsl");
/// Its entry point.
pub(crate) const SUMS_ENTRY: &str = "sums_main";
/// The kernel between two vertices of paths in queues, complete in itself.
pub(crate) const QUEUE_ADVANCE: &str = include_str!("../wgsl/queue_advance.wgsl");

/// A module of the tracer.
struct Module {
    name: &'static str,
    text: &'static str,
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
    "quadric",
    "surface",
    "texture_coordinates",
    "texture_mapping",
    "texture_noise",
    "texture_raster",
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
    "bump",
    "medium_stack",
    "visibility",
    "bound",
];

/// Ways of rays to what they hit, one of which a shader has: through the tree, by ray queries.
const RAYS: &[Module] = modules!["traverse", "query"];

/// Kinds of material; only those that a scene has are in its shader.
const MATERIALS: &[Module] = modules![
    "metal",
    "glass",
    "material_diffuse",
    "material_sheet",
    "material_conductor",
    "material_compensated_conductor",
    "material_multibounce_conductor",
    "material_dielectric",
    "material_compensated_dielectric",
    "material_multibounce_dielectric",
    "material_thin",
    "material_coated_diffuse",
    "material_plastic",
    "material_principled",
    "material_gltf",
    "material_layered",
];

/// What comes behind the switch over materials.
const AFTER: &[Module] = modules!["path", "queue"];

/// What a kind's module imports of the others.
fn base_of(module: &str) -> Option<&'static str> {
    if module.ends_with("conductor") || module == "material_layered" {
        Some("metal")
    } else if module.ends_with("dielectric") {
        Some("glass")
    } else {
        None
    }
}

/// The module of a kind of material; `None` where shaders do not know it.
fn module_of(kind: LobeKind) -> Option<&'static str> {
    Some(match kind {
        LobeKind::Diffuse => "material_diffuse",
        LobeKind::DiffuseTransmission => "material_sheet",
        LobeKind::Conductor => "material_conductor",
        LobeKind::CompensatedConductor => "material_compensated_conductor",
        LobeKind::MultibounceConductor => "material_multibounce_conductor",
        LobeKind::Dielectric => "material_dielectric",
        LobeKind::CompensatedDielectric => "material_compensated_dielectric",
        LobeKind::MultibounceDielectric => "material_multibounce_dielectric",
        LobeKind::Plastic => "material_plastic",
        LobeKind::ThinDielectric => "material_thin",
        LobeKind::CoatedDiffuse => "material_coated_diffuse",
        LobeKind::Principled => "material_principled",
        LobeKind::Gltf => "material_gltf",
        LobeKind::Layered => "material_layered",
        _ => return None,
    })
}

/// Features of a scene that its shader would lack, in a person's words; none: it can be rendered.
pub(crate) fn missing(flat: &FlatScene<'_>) -> Vec<String> {
    let known = |kind: LobeKind| {
        // The one is a choice among others, the other no surface.
        matches!(kind, LobeKind::Mix | LobeKind::Interface) || module_of(kind).is_some()
    };
    let unknown = |kind: &&LobeKind| !known(**kind);
    let materials = flat.lobes.iter().filter(unknown).map(LobeKind::to_string);
    flat.missing.iter().cloned().chain(materials).collect()
}

/// The shader's text.
///
/// * `queries`: whether rays are cast by the adapter's ray queries.
pub(crate) fn source(
    flat: &FlatScene<'_>,
    options: &RenderOptions,
    queries: bool,
) -> Result<String, ComposeError> {
    let mut names: Vec<&str> = flat.lobes.iter().filter_map(|&k| module_of(k)).collect();
    let bases: Vec<&str> = names.iter().filter_map(|name| base_of(name)).collect();
    names.extend(bases);
    let used = MATERIALS.iter().filter(|m| names.contains(&m.name));
    let rays = &RAYS[usize::from(queries)];
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
    text += &constants(flat, options);
    text += &specula_shaders::compose(&library)?;
    for module in &tracer {
        text += &code(module.text);
    }
    text += &dispatch(flat);
    for module in AFTER {
        text += &code(module.text);
    }
    Ok(text)
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

fn constants(flat: &FlatScene<'_>, options: &RenderOptions) -> String {
    let find = |name: &str| flat.constants.iter().find(|c| c.0 == name).map(|c| c.1);
    // Eight children a level, of the trees over instances and within them.
    let levels = 2 * find("TREE_DEPTH").unwrap_or(0) + 1;
    let has_many = |kind: &LobeKind| {
        matches!(
            kind,
            LobeKind::Principled | LobeKind::Gltf | LobeKind::Layered
        )
    };
    let kept = if flat.lobes.iter().any(has_many) {
        12
    } else {
        1
    };
    let own = [
        ("STACK_SIZE", 8 * levels),
        ("SEED", options.seed),
        ("MAX_DEPTH", options.max_depth),
        ("STRATEGY", options.strategy as u32),
        ("CLAMPS", u32::from(options.clamp.is_some())),
        ("CLAMP_BITS", options.clamp.unwrap_or(f32::MAX).to_bits()),
        ("KIND_CONDUCTOR", LobeKind::Conductor as u32),
        (
            "KIND_COMPENSATED_CONDUCTOR",
            LobeKind::CompensatedConductor as u32,
        ),
        (
            "KIND_MULTIBOUNCE_CONDUCTOR",
            LobeKind::MultibounceConductor as u32,
        ),
        ("KIND_THIN_PANE", LobeKind::ThinDielectric as u32),
        ("KIND_GLTF", LobeKind::Gltf as u32),
        ("BOUND_KEPT", kept),
    ];
    let mut text = String::from("// Constants of the scene and the render.\n");
    for (name, value) in flat.constants.iter().copied().chain(own) {
        let _ = writeln!(text, "const {name}: u32 = {value}u;");
    }
    text
}

/// The choice of a mix among its materials.
const CHOICE: &str = "\
    for (var level = 0u; level < 16u && word(record + MATERIAL_KIND) == MIXu; level += 1u) {
        let at = record + MATERIAL_PARAMETERS + 1u;
        let amount = parameter_float(at, place);
        let second = sequence_hashed(s, vec3u(depth, level, 0u)) < amount;
        chosen = word(at + select(4u, 5u, second));
        record = word(MATERIALS + chosen);
        one_sided = one_sided || word(record + MATERIAL_ONE_SIDED) != 0u;
    }
";

/// The switch over the scene's kinds of material.
fn dispatch(flat: &FlatScene<'_>) -> String {
    let kinds = || {
        flat.lobes
            .iter()
            .filter_map(|&kind| Some((kind, module_of(kind)?)))
    };
    let arms = |call: &str| -> String {
        let arm = |(kind, module): (LobeKind, &str)| {
            format!(
                "        case {}u: {{ return {module}_{call}; }}\n",
                kind as u32
            )
        };
        kinds().map(arm).collect()
    };
    let bind = |(kind, module): (LobeKind, &str)| {
        let call = "bind(head, p, outside)";
        format!(
            "            case {}u: {{ b = {module}_{call}; }}\n",
            kind as u32
        )
    };
    // Not where there is no mix: every look-up of a texture makes a shader larger.
    let choice = if flat.lobes.contains(&LobeKind::Mix) {
        CHOICE.replace("MIX", &(LobeKind::Mix as u32).to_string())
    } else {
        String::new()
    };
    let turns = flat.constants.contains(&("HAS_DIRECTIONS", 1));
    let turn = if turns {
        "        head.rotation += bound_direction(record, place);\n"
    } else {
        ""
    };
    format!(
        "
/// The material of a surface at a point of it; mixes choose by chance.
///
/// Twin: specula-render/src/material/mod.rs, Materials::at.
fn material_bind(material: u32, place: TextureCoordinates, outside: bool, s: Sequence, depth: u32) -> Bound {{
    var chosen = material;
    var record = word(MATERIALS + chosen);
    var one_sided = word(record + MATERIAL_ONE_SIDED) != 0u;
{choice}    var b = bound_black();
    if outside || !one_sided {{
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

/// A direction.
fn material_draw(b: Bound, wo: vec3f, u: vec3f, stream: vec2u) -> BsdfSample {{
    switch b.kind {{
{draw}        default: {{ return bsdf_sample_none(); }}
    }}
}}

/// A colour for denoisers.
fn material_albedo(b: Bound) -> vec3f {{
    switch b.kind {{
{albedo}        default: {{ return vec3f(0.0); }}
    }}
}}
",
        bind = kinds().map(bind).collect::<String>(),
        eval = arms("eval(b, wo, wi, stream)"),
        draw = arms("draw(b, wo, u, stream)"),
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
            let tracer = BEFORE.iter().chain([rays]).chain(MATERIALS).chain(AFTER);
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
        let every = BEFORE.iter().chain(RAYS).chain(MATERIALS).chain(AFTER);
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
}
