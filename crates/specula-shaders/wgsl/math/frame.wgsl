// Orthonormal frames: from world to a surface's local frame and back.

/// A right-handed orthonormal frame; `n` is the local z.
///
/// Twin: specula-bsdf/src/math/frame.rs, Frame.
struct FrameBasis {
    /// Local x (along `alpha_x`).
    s: vec3f,
    /// Local y (along `alpha_y`).
    t: vec3f,
    /// Local z, the shading normal.
    n: vec3f,
}

/// A frame about the unit vector `n`, continuous but for the sign of `n.z`.
///
/// Source: Duff et al. 2017, Building an Orthonormal Basis, Revisited, listing 3.
///
/// Twin: specula-bsdf/src/math/frame.rs, Frame::from_normal.
fn frame_from_normal(n: vec3f) -> FrameBasis {
    let sign = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    return FrameBasis(
        vec3f(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        vec3f(b, sign + n.y * n.y * a, -n.y),
        n,
    );
}

/// A frame about the unit vector `n` whose x is `tangent` made perpendicular to it; any frame about `n`
/// where `tangent` is parallel to it or zero.
///
/// Twin: specula-bsdf/src/math/frame.rs, Frame::from_normal_tangent.
fn frame_from_normal_tangent(n: vec3f, tangent: vec3f) -> FrameBasis {
    let s = tangent - n * dot(n, tangent);
    let length_squared = dot(s, s);
    let enough = dot(tangent, tangent) * 1.1920929e-7;
    if length_squared > enough && length_squared > 1.1754944e-38 {
        let unit = s * (1.0 / sqrt(length_squared));
        return FrameBasis(unit, cross(n, unit), n);
    }
    return frame_from_normal(n);
}

/// World to local.
///
/// Twin: specula-bsdf/src/math/frame.rs, Frame::to_local.
fn frame_to_local(frame: FrameBasis, v: vec3f) -> vec3f {
    return vec3f(dot(frame.s, v), dot(frame.t, v), dot(frame.n, v));
}

/// Local to world.
///
/// Twin: specula-bsdf/src/math/frame.rs, Frame::to_world.
fn frame_to_world(frame: FrameBasis, v: vec3f) -> vec3f {
    return frame.s * v.x + frame.t * v.y + frame.n * v.z;
}
