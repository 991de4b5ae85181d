// A node of the light tree: a set of lights, and an estimate of the irradiance by them at a point.
//
// Words of a node: centre and radius of a sphere around the lights, axis (3), cosines of the angles that bound
// their normals and their emission about those, sum of the peak intensities, whether they emit
// to both sides (bit 0) and whether it is a leaf (bit 1), link: a leaf's light, otherwise the distance
// in nodes to the right child. The left child follows.
//
// Twin of specula-render/src/light/node.rs.

import tracer::world::{number, vector, word};


/// An estimate of the irradiance by the lights of the node at `at`, 0 only where none can contribute.
///
/// ```text
/// I cos(theta') cos(theta_i') / max(d^2, r^2),
/// theta' = max(theta - theta_o - theta_u, 0),   theta_i' = max(theta_i - theta_u, 0)
/// ```
///
/// with the angles `theta` of the axis and `theta_i` of the receiver's normal to the line between the
/// centres, and the half angle `theta_u` of the sphere around the lights; 0 where `theta' > theta_e` or
/// `theta_i' > pi/2`.
///
/// * `normal`: unit; zero where light from every side counts.
/// * Returns: in the unit of the intensities over that of lengths squared; finite.
///
/// Source: Conty Estevez and Kulla 2018, eq. 3; departures as in the twin.
/// Twin: specula-render/src/light/node.rs, Node::importance_at.
fn light_node_importance(at: u32, position: vec3f, normal: vec3f) -> f32 {
    let d = vector(at) - position;
    let radius = number(at + 3u);
    let intensity = number(at + 9u);
    let distance_squared = dot(d, d);
    let radius_squared = radius * radius;
    if distance_squared <= radius_squared {
        return light_node_ratio(intensity, radius_squared);
    }
    let sphere = vec2f(sqrt(max(distance_squared - radius_squared, 0.0)), radius);
    var factor = 1.0;
    if any(normal != vec3f(0.0)) {
        let received = light_node_minus(light_node_angle(dot(normal, d), distance_squared), sphere);
        let cosine = select(received.x / distance_squared, 1.0, received.y < 0.0);
        if cosine <= -LIGHT_NODE_SLACK {
            return 0.0;
        }
        factor = max(cosine, LIGHT_NODE_SLACK);
    }
    let cosine_o = number(at + 7u);
    // Spheres and points emit in every direction alike.
    if cosine_o > -1.0 {
        let along = -dot(vector(at + 4u), d);
        let two_sided = (word(at + 10u) & 1u) != 0u;
        let sine_o = sqrt(max(1.0 - cosine_o * cosine_o, 0.0));
        let angle = light_node_angle(select(along, abs(along), two_sided), distance_squared);
        let outside = light_node_minus(angle, vec2f(cosine_o, sine_o));
        let sent = light_node_minus(outside, sphere);
        let cosine = select(sent.x / distance_squared, 1.0, min(outside.y, sent.y) < 0.0);
        if cosine <= number(at + 8u) - LIGHT_NODE_SLACK {
            return 0.0;
        }
        factor *= max(cosine, LIGHT_NODE_SLACK);
    }
    return light_node_ratio(intensity * factor, distance_squared);
}

/// Cosine and sine of an angle in `[0, pi]`, both times the distance.
fn light_node_angle(cosine: f32, distance_squared: f32) -> vec2f {
    return vec2f(cosine, sqrt(max(distance_squared - cosine * cosine, 0.0)));
}

/// Cosine and sine of `a - b`, of angles in `[0, pi]`, times the factors of both: the sine is negative where `a < b`.
/// Twin: specula-render/src/light/node.rs, minus.
fn light_node_minus(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
}

/// A quotient of two values that are not negative, at most `LIGHT_NODE_MOST`.
fn light_node_ratio(a: f32, b: f32) -> f32 {
    if a >= LIGHT_NODE_MOST * min(b, 1.0) {
        return LIGHT_NODE_MOST;
    }
    return a / b;
}
