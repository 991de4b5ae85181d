//! Lights for many vertices at once: chosen one by one, and sampled in batches where that pays.

#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use multiversion::multiversion;
use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};

use super::area::Area;
use super::environment::{Bundle, Environment, LANES};
use super::node::Node;
use super::{Far, LightSample, Lights, Parallelogram, Receiver, Source, Target};
use crate::geometry::Geometry;
use crate::texture::Textures;

/// Most nodes of a tree that all receivers are compared with at once: those over eight lights.
const NODES: usize = 15;

type Column = [f32; LANES];

/// Room for what waits to be sampled.
pub(crate) struct Waiting {
    receivers: Receivers,
    sky: Group,
    bundle: Bundle,
    /// For the parallelogram of each node.
    facing: [Group; NODES],
}

/// Points that a light is to be chosen for.
struct Receivers {
    lanes: [usize; LANES],
    receivers: [Receiver; LANES],
    point: [Column; 3],
    /// Zero where there is none.
    normal: [Column; 3],
    /// Of each node of the tree.
    importance: [Column; NODES],
    count: usize,
}

/// Points that one light was chosen for.
struct Group {
    lanes: [usize; LANES],
    probabilities: Column,
    point: [Column; 3],
    u: [Column; 2],
    seen: SeenColumns,
    count: usize,
}

/// [`Seen`](super::Seen) of each.
struct SeenColumns {
    point: [Column; 3],
    wi: [Column; 3],
    pdf: Column,
}

const ZERO: Column = [0.0; LANES];
const ZEROS: [Column; 3] = [ZERO; 3];

#[inline(always)]
fn get(columns: &[Column; 3], i: usize) -> Vec3<f32> {
    vec3(columns[0][i], columns[1][i], columns[2][i])
}

#[inline(always)]
fn set(columns: &mut [Column; 3], i: usize, v: Vec3<f32>) {
    columns[0][i] = v.x;
    columns[1][i] = v.y;
    columns[2][i] = v.z;
}

impl Waiting {
    pub(crate) fn new() -> Box<Self> {
        let nowhere = Receiver {
            point: Vec3::ZERO,
            normal: None,
        };
        Box::new(Self {
            receivers: Receivers {
                lanes: [0; LANES],
                receivers: [nowhere; LANES],
                point: ZEROS,
                normal: ZEROS,
                importance: [ZERO; NODES],
                count: 0,
            },
            sky: Group::EMPTY,
            bundle: Bundle::ZERO,
            facing: [const { Group::EMPTY }; NODES],
        })
    }
}

impl Group {
    const EMPTY: Self = Self {
        lanes: [0; LANES],
        probabilities: ZERO,
        point: ZEROS,
        u: [ZERO; 2],
        seen: SeenColumns {
            point: ZEROS,
            wi: ZEROS,
            pdf: ZERO,
        },
        count: 0,
    };

    /// Adds a point; returns whether there is no room for another.
    #[inline(always)]
    fn push(&mut self, lane: usize, probability: f32, p: Vec3<f32>, u: [f32; 2]) -> bool {
        let at = self.count % LANES;
        self.lanes[at] = lane;
        self.probabilities[at] = probability;
        set(&mut self.point, at, p);
        self.u[0][at] = u[0];
        self.u[1][at] = u[1];
        self.count = at + 1;
        self.count == LANES
    }
}

impl Lights {
    /// [`Lights::sample`] for many receivers.
    ///
    /// * `receivers`: with their batches.
    /// * `u`: as of [`Lights::sample`], by element.
    /// * `shares`: takes [`Lights::share_from_infinity`], by element.
    /// * `place`: takes what was sampled for an element, once for each.
    #[inline]
    pub(crate) fn sample_all(
        &self,
        waiting: &mut Waiting,
        receivers: impl Iterator<Item = (usize, Receiver)>,
        world: (&Geometry, &Textures),
        u: [&[f32]; 4],
        shares: &mut [f32],
        mut place: impl FnMut(usize, Option<LightSample>),
    ) {
        for (i, receiver) in receivers {
            let r = &mut waiting.receivers;
            let at = r.count % LANES;
            r.lanes[at] = i;
            r.receivers[at] = receiver;
            set(&mut r.point, at, receiver.point);
            set(&mut r.normal, at, receiver.normal.unwrap_or(Vec3::ZERO));
            r.count = at + 1;
            if r.count == LANES {
                self.choose_all(waiting, world, u, shares, &mut place);
            }
        }
        self.choose_all(waiting, world, u, shares, &mut place);
        self.draw_sky(waiting, &mut place);
        for node in 0..NODES {
            self.draw_parallelogram(waiting, node, &mut place);
        }
    }

    /// Chooses a light for all receivers that wait, and samples what is not sampled in batches.
    fn choose_all(
        &self,
        waiting: &mut Waiting,
        world: (&Geometry, &Textures),
        u: [&[f32]; 4],
        shares: &mut [f32],
        place: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        let r = &mut waiting.receivers;
        let n = std::mem::take(&mut r.count);
        let nodes = self.selection.nodes();
        let few = nodes.len() <= NODES;
        if few && self.selection.chooses() {
            for (node, column) in nodes.iter().zip(&mut r.importance) {
                compare(n, node, &r.point, &r.normal, column);
            }
        }
        let sky = self.sky().map(|(_, index)| index);
        for at in 0..n {
            let r = &waiting.receivers;
            let (lane, receiver) = (r.lanes[at], r.receivers[at]);
            let u = u.map(|u| u[lane]);
            let chosen = if few {
                let importance = |node: usize| r.importance[node % NODES][at];
                shares[lane] = self.selection.share(&importance);
                (self.selection).choose(&importance, shares[lane], [u[0], u[3]])
            } else {
                let importance = self.selection.importances(&receiver);
                shares[lane] = self.selection.share(&importance);
                (self.selection).choose(&importance, shares[lane], [u[0], u[3]])
            };
            let Some((light, probability)) = chosen else {
                place(lane, None);
                continue;
            };
            let (p, u) = (receiver.point, [u[1], u[2]]);
            if Some(light) == sky {
                if waiting.sky.push(lane, probability, p, u) {
                    self.draw_sky(waiting, place);
                }
                continue;
            }
            match self.place_of_parallelogram(light) {
                Some(node) => {
                    if waiting.facing[node].push(lane, probability, p, u) {
                        self.draw_parallelogram(waiting, node, place);
                    }
                }
                None => place(lane, self.sample_one((light, probability), p, world, u)),
            }
        }
    }

    /// The group of a parallelogram that is sampled in batches.
    #[inline(always)]
    fn place_of_parallelogram(&self, light: u32) -> Option<usize> {
        let is_one = matches!(
            self.sources[light as usize],
            Source::Area {
                area: Area::Parallelogram(_),
                ..
            }
        );
        (is_one && (light as usize) < NODES).then_some(light as usize)
    }

    /// Samples directions of the sky for all that wait for one.
    fn draw_sky(&self, waiting: &mut Waiting, place: &mut impl FnMut(usize, Option<LightSample>)) {
        let Waiting { sky, bundle, .. } = waiting;
        let n = std::mem::take(&mut sky.count);
        let Some((light, _)) = self.sky().filter(|_| n > 0) else {
            return;
        };
        bundle.u = sky.u;
        light.sample_all(n, bundle);
        for i in 0..n {
            let pdf = bundle.pdf[i];
            let sampled = LightSample {
                wi: bundle.direction(i),
                radiance: bundle.radiance(i),
                pdf: sky.probabilities[i] * pdf,
                delta: false,
                from: None,
            };
            place(sky.lanes[i], (pdf > 0.0).then_some(sampled));
        }
    }

    /// Samples points of a parallelogram for all that wait for one.
    fn draw_parallelogram(
        &self,
        waiting: &mut Waiting,
        node: usize,
        place: &mut impl FnMut(usize, Option<LightSample>),
    ) {
        let group = &mut waiting.facing[node];
        let n = std::mem::take(&mut group.count);
        if n == 0 {
            return;
        }
        let Some(Source::Area {
            area: Area::Parallelogram(light),
            radiance,
            two_sided,
        }) = self.sources.get(node)
        else {
            return;
        };
        look_at(n, light, group);
        for i in 0..n {
            let (wi, pdf) = (get(&group.seen.wi, i), group.seen.pdf[i]);
            let emits = *two_sided || light.normal.dot(wi) < 0.0;
            let sampled = LightSample {
                wi,
                radiance: *radiance,
                pdf: group.probabilities[i] * pdf,
                delta: false,
                from: Some(Target {
                    point: get(&group.seen.point, i),
                    error: light.error,
                    normal: light.normal,
                }),
            };
            place(group.lanes[i], (emits && pdf > 0.0).then_some(sampled));
        }
    }

    /// [`Lights::arriving_from_infinity`] for many directions.
    ///
    /// * `directions`: with indices of any meaning.
    /// * `place`: takes radiance and density of each light from infinity, for each number.
    #[inline]
    pub(crate) fn arriving_from_infinity_all(
        &self,
        waiting: &mut Waiting,
        mut directions: impl Iterator<Item = (usize, Vec3<f32>)>,
        mut place: impl FnMut(usize, Rgb<f32>, f32),
    ) {
        let mut indices = [0; LANES];
        let bundle = &mut waiting.bundle;
        loop {
            let mut n = 0;
            for (number, w) in directions.by_ref().take(LANES) {
                indices[n] = number;
                bundle.set_direction(n, w);
                n += 1;
            }
            if n == 0 {
                return;
            }
            for (place_in_far, (light, index)) in self.far.iter().enumerate() {
                let probability = self.selection.probability_far(*index);
                match light {
                    Far::Environment(sky) if self.sky == Some(place_in_far) => {
                        sky.arriving_all(n, bundle);
                        for (i, &number) in indices[..n].iter().enumerate() {
                            place(number, bundle.radiance(i), probability * bundle.pdf[i]);
                        }
                    }
                    light => {
                        for (i, &number) in indices[..n].iter().enumerate() {
                            let (radiance, pdf) = light.arriving(bundle.direction(i));
                            place(number, radiance, probability * pdf);
                        }
                    }
                }
            }
        }
    }

    /// The light from infinity that is sampled in batches, and its number among all lights.
    fn sky(&self) -> Option<(&Environment, u32)> {
        match &self.far[self.sky?] {
            (Far::Environment(sky), index) => Some((sky, *index)),
            (Far::Sun(_), _) => None,
        }
    }
}

/// [`Node::importance`] of a node for the first `n` receivers.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
fn compare(
    n: usize,
    node: &Node,
    point: &[Column; 3],
    normal: &[Column; 3],
    importance: &mut Column,
) {
    for i in 0..n.min(LANES) {
        importance[i] = node.importance_at(get(point, i), get(normal, i));
    }
}

/// Points of a parallelogram as the first `n` of a group see them.
#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
    "x86_64+avx2+fma+bmi1+bmi2"
))]
fn look_at(n: usize, light: &Parallelogram, group: &mut Group) {
    for i in 0..n.min(LANES) {
        let seen = light.sample(get(&group.point, i), [group.u[0][i], group.u[1][i]]);
        set(&mut group.seen.point, i, seen.point);
        set(&mut group.seen.wi, i, seen.wi);
        group.seen.pdf[i] = seen.pdf;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;
    use crate::sampler::Sampler;
    use specula_bsdf::math::warp;
    use specula_scene::scene::Light;

    /// The orbs under their picture alone, and with a sun, a point and their own lamps beside it.
    fn scenes() -> [PreparedScene; 2] {
        [false, true].map(|mixed| {
            let mut scene = specula_scene::builtin::orbs();
            if mixed {
                scene.lights.push(Light::Distant {
                    irradiance: Rgb::splat(2.0),
                    to_light: [0.6, 0.0, 0.8],
                    half_angle_deg: 3.0,
                });
                scene.lights.push(Light::Point {
                    position: [1.0, 2.0, 5.0],
                    intensity: Rgb::splat(40.0),
                });
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

    fn number(i: usize) -> [f32; 4] {
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
    fn lanes_draw_what_is_sampled_for_one() {
        const COUNT: usize = 1000;
        for (scene, mixed) in scenes().iter().zip([false, true]) {
            let lights = &scene.lights;
            let world = (&scene.geometry, &scene.textures);
            let u: [Vec<f32>; 4] = [0, 1, 2, 3].map(|k| (0..COUNT).map(|i| number(i)[k]).collect());
            let mut sampled = vec![None; COUNT];
            let receivers = (0..COUNT).filter(|i| i % 7 != 2).map(|i| (i, receiver(i)));
            let columns = [0, 1, 2, 3].map(|k| &u[k][..]);
            let mut shares = vec![-1.0; COUNT];
            lights.sample_all(
                &mut Waiting::new(),
                receivers,
                world,
                columns,
                &mut shares,
                |i, light| {
                    assert!(sampled[i].is_none(), "twice");
                    sampled[i] = Some(light);
                },
            );
            let (mut far, mut near) = (0, 0);
            for (i, lane) in sampled.iter().enumerate() {
                let Some(lane) = lane else {
                    assert_eq!(i % 7, 2);
                    continue;
                };
                let one = lights.sample(&receiver(i), world, number(i));
                assert_eq!(shares[i], lights.share_from_infinity(&receiver(i)));
                let (Some(a), Some(b)) = (lane, one) else {
                    assert!(lane.is_none() && one.is_none());
                    continue;
                };
                assert!((a.wi - b.wi).length() < 1e-6 && !apart(a.pdf, b.pdf));
                assert!(!apart(a.radiance.r, b.radiance.r) && !apart(a.radiance.b, b.radiance.b));
                assert_eq!((a.delta, a.from.is_none()), (b.delta, b.from.is_none()));
                *(if a.from.is_none() {
                    &mut far
                } else {
                    &mut near
                }) += 1;
            }
            assert!(far > 100 && (near > 100) == mixed, "{far} {near}");
        }
    }

    #[test]
    fn lanes_look_up_what_is_looked_up_for_one() {
        for scene in &scenes() {
            let lights = &scene.lights;
            let direction = |i: usize| {
                let u = number(i);
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
                &mut Waiting::new(),
                directions,
                |i, radiance, pdf| {
                    found[i].push((radiance, pdf));
                },
            );
            for (i, found) in found.iter().enumerate() {
                let expected: Vec<_> = lights.arriving_from_infinity(direction(i)).collect();
                assert_eq!(found.len(), expected.len());
                for ((c, p), (radiance, pdf)) in found.iter().zip(expected) {
                    assert!(!apart(*p, pdf) && !apart(c.r, radiance.r) && !apart(c.b, radiance.b));
                }
            }
        }
    }
}
