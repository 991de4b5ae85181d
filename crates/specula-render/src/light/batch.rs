//! Light samples of many vertices at once: choices (`choices`), then points of parallelograms, spheres and triangles and
//! directions to the environment in queues of 64. Other lights are sampled vertex by vertex.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use macro_rules_attribute::apply;
use specula_bsdf::{Rgb, Vec3};

use super::area::{Area, AreaSample};
use super::choices::{Choices, Floats, NO_LIGHT};
use super::environment::{BATCH_SIZE, DirectionBatch, Environment};
use super::node::Node;
use super::select::Selection;
use super::shape_queues::ShapeQueues;
use super::{Far, LightSample, Lights, Parallelogram, Receiver, Source, from_area};
use crate::geometry::Geometry;
use crate::simd::simd_levels;
use crate::soa;
use crate::texture::Textures;

/// Most parallelograms that are sampled in batches: as many as are chosen among at once.
const MOST_QUEUES: u8 = 16;
/// The queue of the environment, behind those.
const ENVIRONMENT: u8 = MOST_QUEUES;
/// In place of a queue: the light is sampled at once.
const NO_QUEUE: u8 = u8::MAX;

pub(super) type Vectors = soa::Vectors<BATCH_SIZE>;

/// Vertices that wait until a batch of them is full.
pub(crate) struct LightQueues {
    receivers: ReceiverQueue,
    /// Of parallelograms, and of the environment.
    lights: [LightQueue; ENVIRONMENT as usize + 1],
    /// Of spheres, triangles and other parallelograms.
    shapes: ShapeQueues,
    directions: DirectionBatch,
}

/// Receivers that a light is to be chosen for.
struct ReceiverQueue {
    vertices: [usize; BATCH_SIZE],
    point: Vectors,
    /// Zero where there is none.
    normal: Vectors,
    choices: Choices,
    count: usize,
}

/// Receivers that wait for a sample of the light that was chosen for them.
pub(super) struct Waiting {
    pub(super) vertices: [usize; BATCH_SIZE],
    pub(super) lights: [u32; BATCH_SIZE],
    pub(super) probabilities: Floats,
    pub(super) point: Vectors,
    pub(super) u: [Floats; 2],
    count: usize,
}

/// Receivers that one light was chosen for.
struct LightQueue {
    waiting: Waiting,
    samples: ParallelogramSamples,
}

/// A [`ParallelogramSample`](super::ParallelogramSample) of each.
struct ParallelogramSamples {
    point: Vectors,
    wi: Vectors,
    pdf: Floats,
}

pub(super) const ZERO: Floats = Floats::of(0.0);

impl LightQueues {
    pub(crate) fn new() -> Box<Self> {
        Box::new(Self {
            receivers: ReceiverQueue {
                vertices: [0; BATCH_SIZE],
                point: Vectors::ZERO,
                normal: Vectors::ZERO,
                choices: Choices::ZERO,
                count: 0,
            },
            lights: [const { LightQueue::EMPTY }; ENVIRONMENT as usize + 1],
            shapes: ShapeQueues::EMPTY,
            directions: DirectionBatch::ZERO,
        })
    }
}

impl LightQueue {
    const EMPTY: Self = Self {
        waiting: Waiting::EMPTY,
        samples: ParallelogramSamples {
            point: Vectors::ZERO,
            wi: Vectors::ZERO,
            pdf: ZERO,
        },
    };
}

impl Waiting {
    pub(super) const EMPTY: Self = Self {
        vertices: [0; BATCH_SIZE],
        lights: [0; BATCH_SIZE],
        probabilities: ZERO,
        point: Vectors::ZERO,
        u: [ZERO; 2],
        count: 0,
    };

    /// Where the next receiver is added.
    #[inline(always)]
    pub(super) fn next(&self) -> usize {
        self.count % BATCH_SIZE
    }

    /// Adds a receiver; returns whether the queue is full.
    ///
    /// * `chosen`: the light and its probability.
    #[inline(always)]
    pub(super) fn push(
        &mut self,
        vertex: usize,
        chosen: (u32, f32),
        p: Vec3<f32>,
        u: [f32; 2],
    ) -> bool {
        let at = self.next();
        self.vertices[at] = vertex;
        (self.lights[at], self.probabilities[at]) = chosen;
        self.point.set(at, p);
        self.u[0][at] = u[0];
        self.u[1][at] = u[1];
        self.count = at + 1;
        self.count == BATCH_SIZE
    }

    /// How many wait, all of which are about to be sampled.
    #[inline(always)]
    pub(super) fn take_count(&mut self) -> usize {
        std::mem::take(&mut self.count)
    }
}

impl Lights {
    /// [`Lights::sample`] for many receivers.
    ///
    /// * `receivers`: with the indices of their vertices.
    /// * `u`: as of [`Lights::sample`], by vertex.
    /// * `shares`: receives [`Lights::share_from_infinity`], by vertex.
    /// * `store`: receives the light sample of a vertex, once for each.
    #[inline]
    pub(crate) fn sample_all(
        &self,
        queues: &mut LightQueues,
        receivers: impl Iterator<Item = (usize, Receiver)>,
        world: (&Geometry, &Textures),
        u: [&[f32]; 4],
        shares: &mut [f32],
        mut store: impl FnMut(usize, Option<LightSample>),
    ) {
        // Not a `for` loop: chained iterators are fastest from within.
        receivers.for_each(|(i, receiver)| {
            let r = &mut queues.receivers;
            let at = r.count % BATCH_SIZE;
            r.vertices[at] = i;
            r.point.set(at, receiver.point);
            r.normal.set(at, receiver.normal.unwrap_or(Vec3::ZERO));
            r.count = at + 1;
            if r.count == BATCH_SIZE {
                self.choose_all(queues, world, u, shares, &mut store);
            }
        });
        self.choose_all(queues, world, u, shares, &mut store);
        for queue in 0..=ENVIRONMENT {
            self.sample_queue(queues, queue, &mut store);
        }
        queues.shapes.sample_rest(&self.sources, &mut store);
    }

    /// Of each light its queue.
    pub(super) fn assigned_queues(&self) -> Vec<u8> {
        let environment = self.environment().map(|(_, light)| light as usize);
        let queue = |(light, source): (usize, &Source)| {
            let is_parallelogram = matches!(
                source,
                Source::Area {
                    area: Area::Parallelogram(_),
                    ..
                }
            );
            match u8::try_from(light) {
                _ if Some(light) == environment => ENVIRONMENT,
                Ok(queue) if is_parallelogram && queue < MOST_QUEUES => queue,
                _ => NO_QUEUE,
            }
        };
        self.sources.iter().enumerate().map(queue).collect()
    }

    /// Chooses lights for the queued receivers, and samples those lights that have no queue.
    fn choose_all(
        &self,
        queues: &mut LightQueues,
        world: (&Geometry, &Textures),
        u: [&[f32]; 4],
        shares: &mut [f32],
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        let r = &mut queues.receivers;
        let n = std::mem::take(&mut r.count);
        for (at, &vertex) in r.vertices[..n].iter().enumerate() {
            r.choices.u[0][at] = u[0][vertex];
            r.choices.u[1][at] = u[3][vertex];
        }
        if self.selection.by_treelets() {
            choose_by_treelets(n, &self.selection, r);
        } else {
            if self.selection.chooses() {
                let nodes = self.selection.nodes().iter();
                for (node, column) in nodes.zip(&mut r.choices.importance) {
                    node_importances(n, node, &r.point, &r.normal, column);
                }
            }
            self.selection.choose_all(n, &mut r.choices);
        }
        for at in 0..n {
            let r = &queues.receivers;
            let vertex = r.vertices[at];
            let light = r.choices.light[at];
            let chosen = (light, r.choices.probability[at]);
            shares[vertex] = r.choices.share[at];
            let (p, u) = (r.point.get(at), [u[1][vertex], u[2][vertex]]);
            let queue = self.queues.get(light as usize).copied().unwrap_or(NO_QUEUE);
            if let Some(own) = queues.lights.get_mut(usize::from(queue)) {
                if own.waiting.push(vertex, chosen, p, u) {
                    self.sample_queue(queues, queue, store);
                }
            } else if light == NO_LIGHT {
                store(vertex, None);
            } else if !(queues.shapes).push(&self.sources, vertex, chosen, (p, u), store) {
                store(vertex, self.sample_one(chosen, p, world, u));
            }
        }
    }

    /// Samples the light of a queue for all that wait there.
    fn sample_queue(
        &self,
        queues: &mut LightQueues,
        queue: u8,
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        match queue {
            ENVIRONMENT => self.sample_environment_queue(queues, store),
            _ => self.sample_parallelogram_queue(queues, usize::from(queue), store),
        }
    }

    /// Samples the environment light for its queue.
    fn sample_environment_queue(
        &self,
        queues: &mut LightQueues,
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        let LightQueues {
            lights, directions, ..
        } = queues;
        let environment = &mut lights[usize::from(ENVIRONMENT)].waiting;
        let n = environment.take_count();
        let Some((light, _)) = self.environment().filter(|_| n > 0) else {
            return;
        };
        directions.u = environment.u;
        light.sample_all(n, directions);
        for i in 0..n {
            let pdf = directions.pdf[i];
            let sampled = LightSample {
                wi: directions.direction.get(i),
                radiance: directions.radiance.colour(i),
                pdf: environment.probabilities[i] * pdf,
                delta: false,
                target: None,
            };
            store(environment.vertices[i], (pdf > 0.0).then_some(sampled));
        }
    }

    /// Samples points of a parallelogram for its queue.
    fn sample_parallelogram_queue(
        &self,
        queues: &mut LightQueues,
        light: usize,
        store: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        let queue = &mut queues.lights[light];
        let n = queue.waiting.take_count();
        if n == 0 {
            return;
        }
        let Some(Source::Area {
            area: Area::Parallelogram(light),
            radiance,
            two_sided,
        }) = self.sources.get(light)
        else {
            return;
        };
        sample_points(n, light, queue);
        for i in 0..n {
            let sample = AreaSample {
                point: queue.samples.point.get(i),
                error: light.error,
                normal: light.normal,
                wi: queue.samples.wi.get(i),
                pdf: queue.samples.pdf[i],
            };
            let probability = queue.waiting.probabilities[i];
            let sampled = from_area(&sample, *radiance, *two_sided, probability);
            store(queue.waiting.vertices[i], sampled);
        }
    }

    /// [`Lights::arriving_from_infinity`] for many directions.
    ///
    /// * `directions`: with indices of any meaning.
    /// * `store`: receives radiance and density of each light from infinity, for each index.
    #[inline]
    pub(crate) fn arriving_from_infinity_all(
        &self,
        queues: &mut LightQueues,
        mut directions: impl Iterator<Item = (usize, Vec3<f32>)>,
        mut store: impl FnMut(usize, Rgb<f32>, f32),
    ) {
        let mut indices = [0; BATCH_SIZE];
        let batch = &mut queues.directions;
        loop {
            let mut n = 0;
            for (index, w) in directions.by_ref().take(BATCH_SIZE) {
                indices[n] = index;
                batch.direction.set(n, w);
                n += 1;
            }
            if n == 0 {
                return;
            }
            for (nth, (light, light_index)) in self.far.iter().enumerate() {
                let probability = self.selection.probability_far(*light_index);
                match light {
                    Far::Environment(light) if self.environment == Some(nth) => {
                        light.arriving_all(n, batch);
                        for (i, &index) in indices[..n].iter().enumerate() {
                            let radiance = batch.radiance.colour(i);
                            store(index, radiance, probability * batch.pdf[i]);
                        }
                    }
                    light => {
                        for (i, &index) in indices[..n].iter().enumerate() {
                            let (radiance, pdf) = light.arriving(batch.direction.get(i));
                            store(index, radiance, probability * pdf);
                        }
                    }
                }
            }
        }
    }

    /// The environment light that is sampled in batches, and its index among all lights.
    fn environment(&self) -> Option<(&Environment, u32)> {
        match &self.far[self.environment?] {
            (Far::Environment(light), index) => Some((light, *index)),
            (Far::Sun(_), _) => None,
        }
    }
}

/// [`Node::importance`] of a node for the first `n` receivers.
#[apply(simd_levels)]
fn node_importances(
    n: usize,
    node: &Node,
    point: &Vectors,
    normal: &Vectors,
    importance: &mut Floats,
) {
    for i in 0..n.min(BATCH_SIZE) {
        importance[i] = node.importance_at(point.get(i), normal.get(i));
    }
}

/// Chooses lights for the first `n` receivers.
#[apply(simd_levels)]
fn choose_by_treelets(n: usize, selection: &Selection, receivers: &mut ReceiverQueue) {
    for i in 0..n.min(BATCH_SIZE) {
        let receiver = (receivers.point.get(i), receivers.normal.get(i));
        let c = &mut receivers.choices;
        c.set(
            i,
            selection.sample_by_treelets(receiver, [c.u[0][i], c.u[1][i]]),
        );
    }
}

/// Samples points of a parallelogram for the first `n` receivers of its queue.
#[apply(simd_levels)]
fn sample_points(n: usize, light: &Parallelogram, queue: &mut LightQueue) {
    for i in 0..n.min(BATCH_SIZE) {
        let waiting = &queue.waiting;
        let u = [waiting.u[0][i], waiting.u[1][i]];
        let sample = light.sample(waiting.point.get(i), u);
        queue.samples.point.set(i, sample.point);
        queue.samples.wi.set(i, sample.wi);
        queue.samples.pdf[i] = sample.pdf;
    }
}

#[cfg(test)]
mod tests {
    use super::super::few::MOST_LIGHTS;
    use super::*;
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;
    use crate::sampler::Sampler;
    use specula_bsdf::math::{rgb, vec3, warp};
    use specula_scene::scene::Light;

    /// The orbs under their picture alone, and with a sun, a point and their own lamps beside it.
    fn scenes() -> [PreparedScene; 2] {
        [false, true].map(|mixed| {
            let mut scene = specula_scene::builtin::orbs();
            if mixed {
                scene.lights.push(Light::Distant {
                    irradiance: rgb(2.0, 1.5, 3.0),
                    to_light: [0.6, 0.0, 0.8],
                    half_angle_deg: 3.0,
                });
                // As many as choose among sixteen in batches.
                for i in 0_u8..10 {
                    scene.lights.push(Light::Point {
                        position: [1.0, 2.0 - f64::from(i), 5.0],
                        intensity: rgb(4.0, 5.0, 2.0),
                    });
                }
            } else {
                for shape in &mut scene.shapes {
                    shape.emission = None;
                }
            }
            PreparedScene::new(&scene, &RenderOptions::default()).expect("it is sound")
        })
    }

    fn apart(a: f32, b: f32) -> bool {
        (a - b).abs() > 1e-5 * a.abs().max(b.abs())
    }

    fn differ(a: Rgb<f32>, b: Rgb<f32>) -> bool {
        let pairs = a.to_array().into_iter().zip(b.to_array());
        pairs.into_iter().any(|(a, b)| apart(a, b))
    }

    fn random_numbers(i: usize) -> [f32; 4] {
        Sampler::new([crate::convert::id(i), 1], 3, 5).light(0)
    }

    fn receiver(i: usize) -> Receiver {
        let [x, y, z, w] = Sampler::new([crate::convert::id(i), 2], 3, 5).light(0);
        Receiver {
            point: vec3(6.0 * x - 3.0, 6.0 * y - 3.0, 2.0 * z),
            normal: (w < 0.7).then(|| warp::uniform_sphere([z, w])),
        }
    }

    #[test]
    fn batches_sample_what_is_sampled_for_one() {
        const COUNT: usize = 1000;
        for (scene, mixed) in scenes().iter().zip([false, true]) {
            let lights = &scene.lights;
            let nodes = lights.selection.nodes().len();
            assert_eq!(nodes > 8 && nodes <= MOST_LIGHTS, mixed, "{nodes}");
            let world = (&scene.geometry, &scene.textures);
            let u: [Vec<f32>; 4] =
                [0, 1, 2, 3].map(|k| (0..COUNT).map(|i| random_numbers(i)[k]).collect());
            let mut sampled = vec![None; COUNT];
            let receivers = (0..COUNT).filter(|i| i % 7 != 2).map(|i| (i, receiver(i)));
            let slices = [0, 1, 2, 3].map(|k| &u[k][..]);
            let mut shares = vec![-1.0; COUNT];
            lights.sample_all(
                &mut LightQueues::new(),
                receivers,
                world,
                slices,
                &mut shares,
                |i, light| {
                    assert!(sampled[i].is_none(), "twice");
                    sampled[i] = Some(light);
                },
            );
            let (mut far, mut near) = (0, 0);
            for (i, batch) in sampled.iter().enumerate() {
                let Some(batch) = batch else {
                    assert_eq!(i % 7, 2);
                    continue;
                };
                let one = lights.sample(&receiver(i), world, random_numbers(i));
                assert_eq!(shares[i], lights.share_from_infinity(&receiver(i)));
                let (Some(a), Some(b)) = (batch, one) else {
                    assert!(batch.is_none() && one.is_none());
                    continue;
                };
                assert!((a.wi - b.wi).length() < 1e-6 && !apart(a.pdf, b.pdf));
                assert!(!differ(a.radiance, b.radiance));
                assert_eq!((a.delta, a.target.is_none()), (b.delta, b.target.is_none()));
                *(if a.target.is_none() {
                    &mut far
                } else {
                    &mut near
                }) += 1;
            }
            assert!(far > 100 && (near > 100) == mixed, "{far} {near}");
        }
    }

    #[test]
    fn batches_evaluate_what_is_evaluated_for_one() {
        for scene in &scenes() {
            let lights = &scene.lights;
            let direction = |i: usize| {
                let u = random_numbers(i);
                let near = i.is_multiple_of(3);
                let w: Vec3<f32> = warp::uniform_sphere([u[0], u[1]]);
                let w = if near {
                    vec3(0.6, 0.0, 0.8) + w * 0.05
                } else {
                    w
                };
                w.normalize()
            };
            let mut found = vec![Vec::new(); 500];
            let directions = (0..500).map(|i| (i, direction(i)));
            lights.arriving_from_infinity_all(
                &mut LightQueues::new(),
                directions,
                |i, radiance, pdf| {
                    found[i].push((radiance, pdf));
                },
            );
            for (i, found) in found.iter().enumerate() {
                let expected: Vec<_> = lights.arriving_from_infinity(direction(i)).collect();
                assert_eq!(found.len(), expected.len());
                for ((c, p), (radiance, pdf)) in found.iter().zip(expected) {
                    assert!(!apart(*p, pdf) && !differ(*c, radiance));
                }
            }
        }
    }
}
