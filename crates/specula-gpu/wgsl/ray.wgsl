// Rays and what they hit, whichever way they find it.
//
// Twin of Ray and Hit of specula-render/src/accel/mod.rs.

/// A ray, `origin + t direction` for `t` in `(0, t_max)`.
struct Ray {
    origin: vec3f,
    direction: vec3f,
    t_max: f32,
}

/// Where a ray first meets a surface; `instance` is NONE where it meets none.
struct Hit {
    t: f32,
    u: f32,
    v: f32,
    primitive: u32,
    instance: u32,
}
