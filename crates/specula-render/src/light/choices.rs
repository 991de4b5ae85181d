//! Choices among few lights for many receivers at once.
//!
//! The lights are passed in order, all receivers at a time: there is no branch that a receiver decides, which no
//! processor could foresee.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;

use super::environment::BATCH_SIZE;
use super::few::{MOST_LIGHTS, weight};
use super::node::Node;
use super::select::{Class, Selection};
use crate::convert::{id, narrow};
use crate::simd::simd_levels;
use crate::soa;

/// In place of a light: there is none.
pub(super) const NO_LIGHT: u32 = u32::MAX;

pub(super) type Floats = soa::Floats<BATCH_SIZE>;
type Doubles = soa::Column<f64, BATCH_SIZE>;
type Indices = soa::Column<u32, BATCH_SIZE>;

/// Lights of many receivers, and what they were chosen by.
pub(super) struct Choices {
    /// Uniform in `[0, 1)`: as of [`Selection::sample`].
    pub(super) u: [Floats; 2],
    /// The importance of each of few lights; then its weight.
    pub(super) importance: [Floats; MOST_LIGHTS],
    /// The sum of the importances.
    total: Floats,
    /// Probability of the class of lights from infinity.
    pub(super) share: Floats,
    /// The light with its probability; [`NO_LIGHT`] where there is none.
    pub(super) light: Indices,
    pub(super) probability: Floats,
    /// Whether a light from infinity is chosen.
    is_far: [bool; BATCH_SIZE],
    /// What is left of the random number for the choice within the class; for lights in the scene, times the sum of the
    /// weights.
    rest: Doubles,
    /// The sum of the weights, and of those of the lights passed so far.
    sum: Doubles,
    below: Doubles,
    /// The place of the light in the list.
    place: Indices,
    /// The weight of the light.
    weight: Floats,
}

impl Choices {
    pub(super) const ZERO: Self = Self {
        u: [Floats::of(0.0); 2],
        importance: [Floats::of(0.0); MOST_LIGHTS],
        total: Floats::of(0.0),
        share: Floats::of(0.0),
        light: Indices::of(NO_LIGHT),
        probability: Floats::of(0.0),
        is_far: [false; BATCH_SIZE],
        rest: Doubles::of(0.0),
        sum: Doubles::of(0.0),
        below: Doubles::of(0.0),
        place: Indices::of(0),
        weight: Floats::of(0.0),
    };

    /// Stores the choice for one receiver.
    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, (share, chosen): (f32, Option<(u32, f32)>)) {
        let (light, probability) = chosen.unwrap_or((NO_LIGHT, 0.0));
        self.share[i] = share;
        self.light[i] = light;
        self.probability[i] = probability;
    }
}

impl Selection {
    /// [`Selection::choose`] for the first `n` receivers, by the importances of the lights in the scene.
    pub(super) fn choose_all(&self, n: usize, c: &mut Choices) {
        if let Some(light) = self.only {
            c.light.fill(light);
            c.probability.fill(1.0);
            c.share.fill(self.share_of(0.0));
            return;
        }
        choose_classes(n, self, c);
        // Without one that is always taken, a choice among lights from infinity looks into a table.
        match self.only_far {
            Some(light) => choose_in_list(self.nodes(), light, c),
            None => {
                choose_in_list(self.nodes(), NO_LIGHT, c);
                for i in (0..n.min(BATCH_SIZE)).filter(|&i| c.is_far[i]) {
                    let (light, probability) =
                        self.far.sample(c.rest[i]).unwrap_or((NO_LIGHT, 0.0));
                    c.light[i] = light;
                    c.probability[i] *= probability;
                }
            }
        }
    }
}

/// Chooses between lights from infinity and those in the scene.
#[apply(simd_levels)]
fn choose_classes(n: usize, selection: &Selection, c: &mut Choices) {
    c.total.fill(0.0);
    for importance in c.importance.iter().take(selection.nodes().len()) {
        for i in 0..BATCH_SIZE {
            c.total[i] += importance[i];
        }
    }
    for i in 0..n.min(BATCH_SIZE) {
        let share = selection.share_of(c.total[i]);
        let class = Class::of(share, [c.u[0][i], c.u[1][i]]);
        c.share[i] = share;
        c.is_far[i] = class.is_far;
        c.probability[i] = class.probability;
        c.rest[i] = class.u;
    }
}

/// Chooses among the lights in the scene: [`Weights::sample`](super::few::Weights::sample).
///
/// * `far`: the light from infinity.
#[apply(simd_levels)]
fn choose_in_list(nodes: &[Node], far: u32, c: &mut Choices) {
    c.sum.fill(0.0);
    for column in c.importance.iter_mut().take(nodes.len()) {
        for i in 0..BATCH_SIZE {
            let weight = weight(column[i], c.total[i]);
            column[i] = weight;
            c.sum[i] += f64::from(weight);
        }
    }
    for i in 0..BATCH_SIZE {
        let is_far = c.is_far[i];
        c.rest[i] *= if is_far { 1.0 } else { c.sum[i] };
        c.below[i] = 0.0;
        c.weight[i] = 0.0;
        c.light[i] = if is_far { far } else { NO_LIGHT };
        // No place of the list where lights from infinity are chosen.
        c.place[i] = if is_far { id(BATCH_SIZE) } else { 0 };
    }
    for column in c.importance.iter().take(nodes.len()) {
        for i in 0..BATCH_SIZE {
            let end = c.below[i] + f64::from(column[i]);
            c.below[i] = end;
            c.place[i] += u32::from(c.rest[i] >= end);
        }
    }
    for (k, (node, column)) in (0..).zip(nodes.iter().zip(&c.importance)) {
        let light = node.link;
        for i in 0..BATCH_SIZE {
            let is_here = c.place[i] == k;
            c.light[i] = if is_here { light } else { c.light[i] };
            // Not one of two elements, which would be loaded one by one.
            c.weight[i] += if is_here { column[i] } else { 0.0 };
        }
    }
    for i in 0..BATCH_SIZE {
        let within = c.weight[i] / narrow(c.sum[i]);
        c.probability[i] *= if c.is_far[i] { 1.0 } else { within };
    }
}

#[cfg(test)]
mod tests {
    use specula_bsdf::Vec3;
    use specula_bsdf::math::vec3;

    use super::super::build::Emitter;
    use super::super::cone::EmissionCone;
    use super::super::node::Receiver;
    use super::*;
    use crate::accel::Bounds;

    /// Lamps on a line that look up or to all sides.
    fn emitters(count: u16) -> Vec<Emitter> {
        let emitter = |i: u16| {
            let x = f32::from(i);
            Emitter {
                light: u32::from(i),
                bounds: Bounds {
                    min: [x, 0.0, 1.0],
                    max: [x + 0.2, 0.1, 1.0],
                },
                cone: match i % 2 {
                    0 => EmissionCone::SPHERE,
                    _ => EmissionCone::flat(-Vec3::Z, false),
                },
                intensity: f64::from(1 + i % 3),
            }
        };
        (0..count).map(emitter).collect()
    }

    #[test]
    fn many_receivers_are_given_the_lights_of_single_ones() {
        for count in [0, 1, 2, 3, 9, 16] {
            let id = u32::from(count);
            let classes = [vec![], vec![(id, 2.0)], vec![(id, 0.3), (id + 1, 4.0)]];
            for far in classes {
                let what = format!("{count} lamps, {} from infinity", far.len());
                let lights = usize::from(count) + far.len();
                let selection = Selection::new(emitters(count), &far, lights);
                assert!(!selection.by_treelets());
                let mut chosen = vec![0; lights + 1];
                let mut c = Choices::ZERO;
                for batch in 0..32_u16 {
                    let receiver = |i: u16| {
                        let t = f32::from(64 * batch + i) / 2048.0;
                        let point =
                            vec3(18.0 * t - 1.0, (5.0 * t).fract(), 1.5 * (9.0 * t).fract());
                        let normals = [
                            None,
                            Some(Vec3::Z),
                            Some(vec3(0.6, 0.0, 0.8)),
                            Some(-Vec3::Z),
                        ];
                        let normal = normals[usize::from(i % 4)];
                        Receiver { point, normal }
                    };
                    // Fewer in the last one.
                    let n = if batch == 31 { 13 } else { BATCH_SIZE };
                    let numbers = |i: u16| {
                        let u = f32::from(64 * batch + i) * 0.618_034;
                        [u.fract(), (u * 7.0).fract()]
                    };
                    for i in (0..64).take(n) {
                        let at = usize::from(i);
                        let [first, second] = numbers(i);
                        c.u[0][at] = first;
                        c.u[1][at] = second;
                        for (node, column) in selection.nodes().iter().zip(&mut c.importance) {
                            column[at] = node.importance(&receiver(i));
                        }
                    }
                    selection.choose_all(n, &mut c);
                    for i in (0..64).take(n) {
                        let at = usize::from(i);
                        let one = selection.sample(&receiver(i), numbers(i));
                        let found = (c.light[at], c.probability[at]);
                        let none = c.light[at] == NO_LIGHT;
                        assert_eq!((!none).then_some(found), one, "{what}");
                        assert_eq!(c.share[at], selection.share_far(&receiver(i)), "{what}");
                        chosen[one.map_or(lights, |(light, _)| light as usize)] += 1;
                    }
                }
                let met = chosen[..lights].iter().filter(|&&n| n > 0).count();
                assert_eq!(met, lights, "{what}: {chosen:?}");
                assert_eq!(chosen[lights] > 0, lights == 0, "{what}");
            }
        }
    }
}
