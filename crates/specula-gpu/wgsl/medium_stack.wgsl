// The absorbing media that a path is in.
//
// Twin of specula-render/src/medium_stack.rs.

import tracer::world::{word, vector};


/// The media that a path is in.
struct MediumStack {
    // Absorption coefficient where the path is, per scene unit; zero where nothing absorbs.
    absorption: vec3f,
    count: u32,
    // Materials of the media entered, the first `count` of these.
    materials: vec4u,
}

/// Absorption coefficient of the medium inside of a material's surface.
fn medium_stack_inside(material: u32) -> vec3f {
    return vector(BOUNDARIES + material * BOUNDARY_SIZE + 1u);
}

/// Updates the media where a path passes a surface that bounds one.
///
/// * `inwards`: whether the path passes from outside to inside.
///
/// Twin: specula-render/src/medium_stack.rs, MediumStack::cross.
fn medium_stack_cross(media: ptr<function, MediumStack>, material: u32, inwards: bool) {
    if HAS_BOUNDARIES == 0u {
        return;
    }
    let at = BOUNDARIES + material * BOUNDARY_SIZE;
    let known = word(at);
    if known == BOUNDARY_NONE {
        return;
    }
    if inwards {
        (*media).absorption = vector(at + 1u);
        if known == BOUNDARY_INSIDE {
            if (*media).count == MOST_MEDIA {
                let m = (*media).materials;
                (*media).materials = vec4u(m.y, m.z, m.w, 0u);
                (*media).count -= 1u;
            }
            (*media).materials[(*media).count] = material;
            (*media).count += 1u;
        }
    } else if known == BOUNDARY_BOTH {
        (*media).absorption = vector(at + 4u);
    } else {
        medium_stack_leave(media, material);
    }
}

/// Removes the medium of that material that was entered last.
///
/// Twin: specula-render/src/medium_stack.rs, MediumStack::leave.
fn medium_stack_leave(media: ptr<function, MediumStack>, material: u32) {
    let count = (*media).count;
    var last = count;
    for (var i = 0u; i < count; i += 1u) {
        if (*media).materials[i] == material {
            last = i;
        }
    }
    if last < count {
        for (var i = last; i + 1u < count; i += 1u) {
            (*media).materials[i] = (*media).materials[i + 1u];
        }
        (*media).count = count - 1u;
    }
    (*media).absorption = vec3f(0.0);
    if (*media).count > 0u {
        (*media).absorption = medium_stack_inside((*media).materials[(*media).count - 1u]);
    }
}

/// Transmittance over a distance, `exp(-absorption distance)` (Beer and Lambert).
///
/// Twin: specula-render/src/medium_stack.rs, transmittance.
fn medium_stack_transmittance(absorption: vec3f, distance: f32) -> vec3f {
    return exp(-absorption * distance);
}
