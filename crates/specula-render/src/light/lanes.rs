//! Lights for many vertices at once: chosen one by one, and drawn in lanes where that pays.

use specula_bsdf::{Rgb, Vec3};

use super::environment::{Bundle, Environment, LANES};
use super::{Far, LightSample, Lights, Receiver};
use crate::geometry::Geometry;
use crate::texture::Textures;

/// Vertices that wait for a direction of the sky.
struct Waiting {
    lanes: [usize; LANES],
    probabilities: [f32; LANES],
    count: usize,
    bundle: Bundle,
}

impl Lights {
    /// [`Lights::sample`] for many receivers.
    ///
    /// * `receivers`: with their lanes.
    /// * `u`: as of [`Lights::sample`], by lane.
    /// * `place`: takes what was drawn for a lane, once for each.
    #[inline]
    pub(crate) fn sample_all(
        &self,
        receivers: impl Iterator<Item = (usize, Receiver)>,
        world: (&Geometry, &Textures),
        u: [&[f32]; 4],
        mut place: impl FnMut(usize, Option<LightSample>),
    ) {
        let Some((sky, index)) = self.sky() else {
            for (i, receiver) in receivers {
                place(i, self.sample(&receiver, world, u.map(|u| u[i])));
            }
            return;
        };
        let mut waiting = Waiting {
            lanes: [0; LANES],
            probabilities: [0.0; LANES],
            count: 0,
            bundle: Bundle::ZERO,
        };
        for (i, receiver) in receivers {
            let u = u.map(|u| u[i]);
            match self.selection.sample(&receiver, [u[0], u[3]]) {
                Some((light, probability)) if light == index => {
                    waiting.push(i, probability, [u[1], u[2]]);
                    if waiting.count == LANES {
                        waiting.draw(sky, &mut place);
                    }
                }
                chosen => {
                    let drawn = chosen
                        .and_then(|c| self.sample_one(c, receiver.point, world, [u[1], u[2]]));
                    place(i, drawn);
                }
            }
        }
        waiting.draw(sky, &mut place);
    }

    /// [`Lights::arriving_from_infinity`] for many directions.
    ///
    /// * `directions`: with numbers of any meaning.
    /// * `place`: takes radiance and density of each light from infinity, for each number.
    #[inline]
    pub(crate) fn arriving_from_infinity_all(
        &self,
        mut directions: impl Iterator<Item = (usize, Vec3<f32>)>,
        mut place: impl FnMut(usize, Rgb<f32>, f32),
    ) {
        let mut numbers = [0; LANES];
        let mut bundle = Bundle::ZERO;
        loop {
            let mut n = 0;
            for (number, w) in directions.by_ref().take(LANES) {
                numbers[n] = number;
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
                        sky.arriving_all(n, &mut bundle);
                        for (i, &number) in numbers[..n].iter().enumerate() {
                            place(number, bundle.radiance(i), probability * bundle.pdf[i]);
                        }
                    }
                    light => {
                        for (i, &number) in numbers[..n].iter().enumerate() {
                            let (radiance, pdf) = light.arriving(bundle.direction(i));
                            place(number, radiance, probability * pdf);
                        }
                    }
                }
            }
        }
    }

    /// The light from infinity that is drawn in lanes, and its number among all lights.
    fn sky(&self) -> Option<(&Environment, u32)> {
        match &self.far[self.sky?] {
            (Far::Environment(sky), index) => Some((sky, *index)),
            (Far::Sun(_), _) => None,
        }
    }
}

impl Waiting {
    #[inline(always)]
    fn push(&mut self, lane: usize, probability: f32, u: [f32; 2]) {
        let at = self.count % LANES;
        self.lanes[at] = lane;
        self.probabilities[at] = probability;
        self.bundle.u[0][at] = u[0];
        self.bundle.u[1][at] = u[1];
        self.count = at + 1;
    }

    /// Draws for all that wait.
    #[inline(always)]
    fn draw(&mut self, sky: &Environment, place: &mut impl FnMut(usize, Option<LightSample>)) {
        let n = self.count.min(LANES);
        sky.sample_all(n, &mut self.bundle);
        for i in 0..n {
            let pdf = self.bundle.pdf[i];
            let drawn = LightSample {
                wi: self.bundle.direction(i),
                radiance: self.bundle.radiance(i),
                pdf: self.probabilities[i] * pdf,
                delta: false,
                from: None,
            };
            place(self.lanes[i], (pdf > 0.0).then_some(drawn));
        }
        self.count = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;
    use crate::sampler::Sampler;
    use specula_bsdf::math::{vec3, warp};
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
    fn lanes_draw_what_is_drawn_for_one() {
        const COUNT: usize = 1000;
        for (scene, mixed) in scenes().iter().zip([false, true]) {
            let lights = &scene.lights;
            let world = (&scene.geometry, &scene.textures);
            let u: [Vec<f32>; 4] = [0, 1, 2, 3].map(|k| (0..COUNT).map(|i| number(i)[k]).collect());
            let mut drawn = vec![None; COUNT];
            let receivers = (0..COUNT).filter(|i| i % 7 != 2).map(|i| (i, receiver(i)));
            let columns = [0, 1, 2, 3].map(|k| &u[k][..]);
            lights.sample_all(receivers, world, columns, |i, light| {
                assert!(drawn[i].is_none(), "twice");
                drawn[i] = Some(light);
            });
            let (mut far, mut near) = (0, 0);
            for (i, lane) in drawn.iter().enumerate() {
                let Some(lane) = lane else {
                    assert_eq!(i % 7, 2);
                    continue;
                };
                let one = lights.sample(&receiver(i), world, number(i));
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
            lights.arriving_from_infinity_all(directions, |i, radiance, pdf| {
                found[i].push((radiance, pdf));
            });
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
