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
    let to_centre = d * (1.0 / sqrt(distance_squared));
    let sine_squared = radius_squared / distance_squared;
    let sine = sqrt(sine_squared);
    let cosine = sqrt(max(1.0 - sine_squared, 0.0));
    var factor = 1.0;
    if any(normal != vec3f(0.0)) {
        let received = light_node_minus(dot(normal, to_centre), sine, cosine);
        if received <= -LIGHT_NODE_SLACK {
            return 0.0;
        }
        factor = max(received, LIGHT_NODE_SLACK);
    }
    let cosine_o = number(at + 7u);
    // Spheres and points emit in every direction alike.
    if cosine_o > -1.0 {
        let along = -dot(vector(at + 4u), to_centre);
        let two_sided = (word(at + 10u) & 1u) != 0u;
        let sine_o = sqrt(max(1.0 - cosine_o * cosine_o, 0.0));
        let outside = light_node_minus(select(along, abs(along), two_sided), sine_o, cosine_o);
        let sent = light_node_minus(outside, sine, cosine);
        if sent <= number(at + 8u) - LIGHT_NODE_SLACK {
            return 0.0;
        }
        factor *= max(sent, LIGHT_NODE_SLACK);
    }
    return light_node_ratio(intensity * factor, distance_squared);
}

/// `cos(max(a - b, 0))` of angles in `[0, pi]`.
/// Twin: specula-render/src/light/node.rs, minus_clamped.
fn light_node_minus(cosine_a: f32, sine_b: f32, cosine_b: f32) -> f32 {
    if cosine_a >= cosine_b {
        return 1.0;
    }
    return cosine_a * cosine_b + sqrt(max(1.0 - cosine_a * cosine_a, 0.0)) * sine_b;
}

/// A quotient of two values that are not negative, at most `LIGHT_NODE_MOST`.
fn light_node_ratio(a: f32, b: f32) -> f32 {
    if a >= LIGHT_NODE_MOST * min(b, 1.0) {
        return LIGHT_NODE_MOST;
    }
    return a / b;
}
