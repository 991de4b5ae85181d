// Rays and hits, of traversal (traverse.wgsl) and of ray queries (query.wgsl).
//
// Twin of Ray and Hit of specula-render/src/accel/mod.rs.

/// A ray, `origin + t direction` for `t` in `(0, t_max)`.
struct Ray {
    origin: vec3f,
    direction: vec3f,
    t_max: f32,
}

/// A hit of a ray; `instance` is NONE where it hits nothing.
struct Hit {
    t: f32,
    // Barycentric weights of the second and third corner.
    u: f32,
    v: f32,
    primitive: u32,
    instance: u32,
}
