// A binary tree over the lights within the scene: sampling a light by its importance at a point.
//
// From the root down, either child is taken with the probability of its share of the importance of both. A trail of
// bits is stored for every light, the way to its leaf, so that the probability of a light that a ray hits by chance
// is the same product. Where lights are few, all nodes are leaves, and a light is taken in proportion to its
// importance; its trail is its place.
//
// LIGHT_NODES has LIGHT_NODE_COUNT nodes, LIGHT_TRAILS two words for each light: the lower and the upper
// bits of its trail, from the root on; 1 for right.
//
// Source: Conty Estevez and Kulla 2018, section 5.4; Pharr, Jakob and Humphreys, 4th edition, 12.6.3.
// Twin of specula-render/src/light/tree.rs and specula-render/src/light/few.rs.

import tracer::light_node::{light_node_importance};
import tracer::world::{word};

/// Trail of a light that is not in the tree.
const LIGHT_TREE_ABSENT: vec2u = vec2u(0xffffffffu, 0xffffffffu);
/// The largest number below 1.
const LIGHT_TREE_BELOW_ONE: f32 = 0.99999994;

/// A light and its probability; 0: there is no light.
struct LightChoice {
    /// Its index.
    light: u32,
    /// In (0, 1].
    probability: f32,
}

/// A random number in `[0, 1)` with more digits than `f32` holds: `coarse + spacing * digits`.
///
/// A decision at a threshold rescales the part of the range on its side to `[0, 1)`: `coarse` loses digits, and
/// `spacing` grows. `digits` stays. The twins use `f64`; a decision differs from theirs where the random number is
/// within a rounding of `f32` (2^-24) of the threshold.
struct LightRandomNumber {
    /// A multiple of `spacing`, but for a shift; below 0 where a threshold lies within a step.
    coarse: f32,
    /// Distance of two values of `coarse`.
    spacing: f32,
    /// In `[0, 1)`.
    digits: f32,
}

/// Offset of a node.
fn light_tree_place(node: u32) -> u32 {
    return LIGHT_NODES + LIGHT_NODE_SIZE * node;
}

/// Whether a node is a leaf.
fn light_tree_is_leaf(node: u32) -> bool {
    return (word(light_tree_place(node) + 10u) & 2u) != 0u;
}

/// A leaf's light, or the distance in nodes to the right child.
fn light_tree_link(node: u32) -> u32 {
    return word(light_tree_place(node) + 11u);
}

/// Importances of the children of a node.
fn light_tree_children(node: u32, position: vec3f, normal: vec3f) -> vec2f {
    let right = node + light_tree_link(node);
    return vec2f(
        light_node_importance(light_tree_place(node + 1u), position, normal),
        light_node_importance(light_tree_place(right), position, normal),
    );
}

/// Share of the first of two importances; 0 or 1 only where just one of them is 0. One half where both are 0:
/// no light arrives then, but the probabilities still add up to 1.
/// Twin: specula-render/src/light/node.rs, share.
fn light_tree_share(importances: vec2f) -> f32 {
    if importances.x <= 0.0 {
        return select(0.5, 0.0, importances.y > 0.0);
    }
    if importances.y <= 0.0 {
        return 1.0;
    }
    let share = importances.x / (importances.x + importances.y);
    return clamp(share, LIGHT_TREE_LEAST_SHARE, 1.0 - LIGHT_TREE_LEAST_SHARE);
}

/// Weights of few lights at a point.
struct LightWeights {
    /// Of each; then 0.
    weights: array<f32, LIGHT_TREE_MOST_IN_LIST>,
    /// The sum of the importances.
    total: f32,
    /// The sum of the weights.
    sum: f32,
}

/// The weights of few lights: their importances, off 0 unless they are 0; the same for all where nothing arrives from
/// any, so that the probabilities still add up to 1.
/// Twin: specula-render/src/light/few.rs, Weights::new.
fn light_tree_weights(position: vec3f, normal: vec3f) -> LightWeights {
    var few = LightWeights();
    for (var k = 0u; k < LIGHT_NODE_COUNT; k += 1u) {
        few.weights[k] = light_node_importance(light_tree_place(k), position, normal);
        few.total += few.weights[k];
    }
    let least = LIGHT_TREE_LEAST_SHARE * few.total;
    for (var k = 0u; k < LIGHT_NODE_COUNT; k += 1u) {
        let importance = few.weights[k];
        let weight = select(0.0, max(importance, least), importance > 0.0);
        few.weights[k] = select(1.0, weight, few.total > 0.0);
        few.sum += few.weights[k];
    }
    return few;
}

/// Samples one of few lights, with its probability: one after the other is taken or left, by its share of the weights
/// from there on.
/// Twin: specula-render/src/light/few.rs, Weights::sample.
fn light_tree_sample_few(position: vec3f, normal: vec3f, u: LightRandomNumber) -> LightChoice {
    let few = light_tree_weights(position, normal);
    // Summed from the last on, such that no digits are lost where little is left.
    var left = array<f32, LIGHT_TREE_MOST_IN_LIST>();
    var last = 0u;
    var sum = 0.0;
    for (var i = 0u; i < LIGHT_NODE_COUNT; i += 1u) {
        let k = LIGHT_NODE_COUNT - 1u - i;
        if sum <= 0.0 {
            last = k;
        }
        sum += few.weights[k];
        left[k] = sum;
    }
    var rest = u;
    var chosen = 0u;
    while chosen < last {
        let share = few.weights[chosen] / left[chosen];
        if light_tree_value(rest) < share {
            break;
        }
        rest = light_tree_within(rest, share, 1.0 - share);
        chosen += 1u;
    }
    let light = light_tree_link(chosen);
    return LightChoice(light, few.weights[chosen] / few.sum);
}

/// An estimate of the irradiance by all lights: the sum over the root's children, or over few lights. 0 only where no
/// light can contribute.
/// Twin: specula-render/src/light/tree.rs, LightTree::total.
fn light_tree_total(position: vec3f, normal: vec3f) -> f32 {
    if LIGHT_NODE_COUNT == 0u {
        return 0.0;
    }
    if light_tree_is_leaf(0u) {
        return light_tree_weights(position, normal).total;
    }
    let importances = light_tree_children(0u, position, normal);
    return importances.x + importances.y;
}

/// The random number, rounded to `f32`.
fn light_tree_value(u: LightRandomNumber) -> f32 {
    return clamp(u.coarse + u.spacing * u.digits, 0.0, LIGHT_TREE_BELOW_ONE);
}

/// The random number within the part of its range that starts at `begin`, rescaled by `1 / size` to `[0, 1)`.
fn light_tree_within(u: LightRandomNumber, begin: f32, size: f32) -> LightRandomNumber {
    return LightRandomNumber((u.coarse - begin) / size, u.spacing / size, u.digits);
}

/// Samples a light, with its probability.
///
/// * `u`: uniform in `[0, 1)`.
///
/// Twin: specula-render/src/light/tree.rs, LightTree::sample.
fn light_tree_sample(position: vec3f, normal: vec3f, u: LightRandomNumber) -> LightChoice {
    if LIGHT_NODE_COUNT == 0u {
        return LightChoice(0u, 0.0);
    }
    if light_tree_is_leaf(0u) {
        return light_tree_sample_few(position, normal, u);
    }
    var rest = u;
    var node = 0u;
    var probability = 1.0;
    while !light_tree_is_leaf(node) {
        let left = light_tree_share(light_tree_children(node, position, normal));
        if light_tree_value(rest) < left {
            rest = light_tree_within(rest, 0.0, left);
            probability *= left;
            node += 1u;
        } else {
            rest = light_tree_within(rest, left, 1.0 - left);
            probability *= 1.0 - left;
            node += light_tree_link(node);
        }
    }
    return LightChoice(light_tree_link(node), probability);
}

/// Probability with which `light_tree_sample` samples a light.
/// Twin: specula-render/src/light/tree.rs, LightTree::probability.
fn light_tree_probability(position: vec3f, normal: vec3f, light: u32) -> f32 {
    let at = LIGHT_TRAILS + 2u * light;
    var trail = vec2u(word(at), word(at + 1u));
    if all(trail == LIGHT_TREE_ABSENT) {
        return 0.0;
    }
    if light_tree_is_leaf(0u) {
        let few = light_tree_weights(position, normal);
        return few.weights[trail.x] / few.sum;
    }
    var node = 0u;
    var probability = 1.0;
    while !light_tree_is_leaf(node) {
        let left = light_tree_share(light_tree_children(node, position, normal));
        if (trail.x & 1u) == 0u {
            probability *= left;
            node += 1u;
        } else {
            probability *= 1.0 - left;
            node += light_tree_link(node);
        }
        trail = vec2u((trail.x >> 1u) | (trail.y << 31u), trail.y >> 1u);
    }
    return probability;
}
