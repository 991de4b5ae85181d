// The absorbing bodies that a path is in.
//
// Twin of specula-render/src/bodies.rs.

import tracer::world::{word, vector};

/// How many bodies are remembered; those entered first are forgotten.
const BODIES_DEEPEST: u32 = 4u;
/// Words of a material's boundary.
const BOUNDARY_SIZE: u32 = 7u;

/// What a path is in.
struct Bodies {
    // What absorbs where the path is, per scene unit; zero where nothing does.
    absorption: vec3f,
    count: u32,
    // Materials of the bodies entered, the first `count` of these.
    materials: vec4u,
}

/// What a body's material absorbs inside.
fn bodies_inside(material: u32) -> vec3f {
    return vector(BOUNDARIES + material * BOUNDARY_SIZE + 1u);
}

/// Passes a surface: what the path is in changes where that bounds a body.
///
/// * `inwards`: whether from its outside to its inside.
///
/// Twin: specula-render/src/bodies.rs, Bodies::cross.
fn bodies_cross(bodies: ptr<function, Bodies>, material: u32, inwards: bool) {
    if HAS_BOUNDARIES == 0u {
        return;
    }
    let at = BOUNDARIES + material * BOUNDARY_SIZE;
    let known = word(at);
    if known == 0u {
        return;
    }
    if inwards {
        (*bodies).absorption = vector(at + 1u);
        if known == 1u {
            if (*bodies).count == BODIES_DEEPEST {
                let m = (*bodies).materials;
                (*bodies).materials = vec4u(m.y, m.z, m.w, 0u);
                (*bodies).count -= 1u;
            }
            (*bodies).materials[(*bodies).count] = material;
            (*bodies).count += 1u;
        }
    } else if known == 2u {
        (*bodies).absorption = vector(at + 4u);
    } else {
        bodies_leave(bodies, material);
    }
}

/// Forgets the body of that material that was entered last.
///
/// Twin: specula-render/src/bodies.rs, Bodies::leave.
fn bodies_leave(bodies: ptr<function, Bodies>, material: u32) {
    let count = (*bodies).count;
    var found = count;
    for (var i = 0u; i < count; i += 1u) {
        if (*bodies).materials[i] == material {
            found = i;
        }
    }
    if found < count {
        for (var i = found; i + 1u < count; i += 1u) {
            (*bodies).materials[i] = (*bodies).materials[i + 1u];
        }
        (*bodies).count = count - 1u;
    }
    (*bodies).absorption = vec3f(0.0);
    if (*bodies).count > 0u {
        (*bodies).absorption = bodies_inside((*bodies).materials[(*bodies).count - 1u]);
    }
}

/// What absorption leaves over a distance (Beer and Lambert).
///
/// Twin: specula-render/src/bodies.rs, transmittance.
fn bodies_transmittance(absorption: vec3f, distance: f32) -> vec3f {
    return exp(-absorption * distance);
}
