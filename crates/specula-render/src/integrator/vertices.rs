//! The vertices of a block that are dealt with in lanes: from hits to lanes, light, and onwards.

use core::ops::Range;

use specula_bsdf::batch::Kind;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Vec3};

use super::block::{Block, Stretch, index};
use super::lanes::{self, LANES, Lanes};
use super::passing::TO_LIGHT;
use super::paths::Paths;
use super::{PathTracer, candidates, lobes};
use crate::accel::{Hit, Ray};
use crate::convert::id;
use crate::material::Plain;
use crate::sampler::Purpose;

impl PathTracer<'_> {
    /// Takes the paths in lanes from this vertex to the next.
    pub(super) fn step_lanes(&self, block: &mut Block, depth: u32) {
        self.load(block);
        let lanes = &mut *block.lanes;
        let n = lanes.count;
        lanes::make_surfaces(n, &lanes.triangles, &mut lanes.surfaces);
        lanes::turn(n, &mut lanes.surfaces);
        for (plain, range) in self.each(&block.stretches) {
            if plain.specular {
                lanes::straighten(range.start, range.end, &mut lanes.surfaces);
            }
        }
        if depth == 0 {
            self.show(block);
        }
        self.note_shared(block);
        self.light_lanes(block, depth);
        self.scatter_lanes(block, depth);
    }

    /// Keeps what the first vertices show.
    fn show(&self, block: &mut Block) {
        let Block {
            paths,
            live,
            stretches,
            lanes,
            ..
        } = block;
        let Lanes {
            surfaces: s,
            owners,
            places,
            ..
        } = &**lanes;
        for (plain, range) in self.each(stretches) {
            let albedo = plain.lobe.albedo();
            for i in range {
                let path = index(owners[i]);
                if !(plain.black_inside && s.side[i] < 0.0) {
                    paths.first.albedo.set_colour(path, albedo);
                }
                paths.first.normal.set(path, s.ns.get(i));
                let ray = live.ray(places[i] as usize);
                paths.first.depth[path] = (s.position.get(i) - ray.origin).length();
            }
        }
    }

    /// Stretches of lanes with their materials.
    fn each<'s>(
        &'s self,
        stretches: &'s [Stretch],
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        stretches.iter().filter_map(|s| {
            let sides = self.scene.materials.plain(s.key / 2)?;
            Some((&sides[(s.key % 2) as usize], s.from..s.to.min(LANES)))
        })
    }

    /// Brings what is sorted into the lanes.
    fn load(&self, block: &mut Block) {
        let Block {
            paths,
            live,
            hits,
            stretches,
            lanes,
            ..
        } = block;
        let Lanes {
            surfaces: s,
            onward: o,
            numbers,
            owners,
            places,
            count,
            ..
        } = &mut **lanes;
        for i in 0..LANES.min(*count) {
            let k = places[i] as usize;
            let (path, ray) = (live.number(k), live.ray(k));
            owners[i] = id(path);
            numbers.place(i, &paths.samplers[path]);
            s.towards.set(i, -ray.direction);
            o.throughput.set_colour(i, paths.throughput.colour(path));
            o.eta_scale[i] = paths.eta_scale[path];
        }
        for (plain, range) in self.each(stretches) {
            for i in range {
                let k = lanes.places[i] as usize;
                if let Some(hit) = &hits[k] {
                    self.load_surface(lanes, i, (live.ray(k), hit), !plain.isotropic);
                }
            }
        }
    }

    /// Brings a surface into its lane.
    #[inline(always)]
    fn load_surface(
        &self,
        lanes: &mut Lanes,
        i: usize,
        (ray, hit): (&Ray, &Hit),
        needs_tangent: bool,
    ) {
        let geometry = &self.scene.geometry;
        let (t, s) = (&mut lanes.triangles, &mut lanes.surfaces);
        let mut tangent = Vec3::ZERO;
        if let Some(facet) = geometry.facet(hit) {
            for (c, v) in t.corners.iter_mut().zip(facet.corners) {
                c.set_array(i, v);
            }
            for (c, v) in t.normals.iter_mut().zip(facet.normals) {
                c.set_array(i, v);
            }
            t.weights[0][i] = hit.u;
            t.weights[1][i] = hit.v;
            t.wanted[i] = true;
            if needs_tangent {
                tangent = geometry.tangent(hit);
            }
        } else {
            let [position, error, ng, ns, along] = match geometry.quadric(ray, hit) {
                Some([position, error, normal, along]) => [position, error, normal, normal, along],
                None => {
                    let s = geometry.surface(ray, hit);
                    [s.position, s.error, s.ng, s.ns, s.tangent]
                }
            };
            t.wanted[i] = false;
            s.position.set(i, position);
            s.error[i] = error.x;
            s.ng.set(i, ng);
            s.ns.set(i, ns);
            if needs_tangent {
                tangent = along;
            }
        }
        s.tangent.set(i, tangent);
    }

    /// Adds light from one sampled light to each path.
    fn light_lanes(&self, block: &mut Block, depth: u32) {
        block
            .lanes
            .numbers
            .draw(block.lanes.count, Purpose::Light, depth);
        let twice = self
            .with_two_lights(&block.stretches, depth)
            .next()
            .is_some();
        if twice {
            self.part_numbers(block, depth);
        }
        self.consider(block, depth, 0);
        if twice {
            self.consider(block, depth, 1);
            self.keep_one(block, depth);
        }
        let lanes = &mut *block.lanes;
        lanes::aim(lanes.count, &lanes.surfaces, &mut lanes.arriving);
        self.add_unblocked(block, depth);
    }

    /// Stretches where two lights are drawn.
    fn with_two_lights<'s>(
        &'s self,
        stretches: &'s [Stretch],
        depth: u32,
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        let two = move |plain: &Plain| self.lights_at(&plain.lobe, depth) == 2;
        self.each(stretches).filter(move |(plain, _)| two(plain))
    }

    /// Makes the numbers of one light those of two where as many are drawn.
    fn part_numbers(&self, block: &mut Block, depth: u32) {
        let Lanes {
            numbers,
            second_numbers,
            ..
        } = &mut *block.lanes;
        let first_numbers = &mut numbers.values;
        for (_, range) in self.with_two_lights(&block.stretches, depth) {
            for i in range {
                let u = [0, 1, 2, 3].map(|k| first_numbers[k][i]);
                for (to, which) in [(&mut *first_numbers, 0), (second_numbers, 1)] {
                    let parted = candidates::numbers(u, which, 2);
                    for k in 0..4 {
                        to[k][i] = parted[k];
                    }
                }
            }
        }
    }

    /// Keeps one of two lights.
    fn keep_one(&self, block: &mut Block, depth: u32) {
        let Block {
            paths,
            stretches,
            lanes,
            ..
        } = block;
        let Lanes {
            arriving,
            second,
            second_numbers: [choices, ..],
            owners,
            ..
        } = &mut **lanes;
        for (_, range) in self.with_two_lights(stretches, depth) {
            for i in range.clone() {
                choices[i] = candidates::choice(&paths.samplers[index(owners[i])], depth);
            }
            lanes::keep_one(range.start, range.end, choices, arriving, second);
        }
    }

    /// Draws a light for each vertex, and weighs what it would bring.
    ///
    /// * `which`: 1 for the second where two are drawn; else 0.
    fn consider(&self, block: &mut Block, depth: u32, which: u32) {
        self.draw_lights(block, depth, which);
        let Block {
            paths,
            stretches,
            lanes,
            streams,
            ..
        } = block;
        let Lanes {
            surfaces: s,
            arriving,
            second,
            onward: o,
            owners,
            ..
        } = &mut **lanes;
        let a = if which == 0 { arriving } else { second };
        for (plain, range) in self.each(stretches) {
            let (from, to) = (range.start, range.end);
            let count = self.lights_at(&plain.lobe, depth);
            if which >= count {
                continue;
            }
            if plain.specular {
                a.brought.x[range.clone()].fill(0.0);
                a.brought.y[range.clone()].fill(0.0);
                a.brought.z[range].fill(0.0);
                continue;
            }
            for i in range {
                let black = plain.black_inside && s.side[i] < 0.0;
                a.pdf[i] *= if black { 0.0 } else { count as f32 };
            }
            lanes::to_frames(from, to, s, a);
            let purpose = candidates::stream(which);
            fill_streams(paths, &owners[from..to], plain, (depth, purpose), streams);
            lobes::eval_pdf(
                &plain.lobe,
                s.wo.directions(from, to),
                a.wi.directions(from, to),
                streams,
                a.f_cos.colours_mut(from, to),
                &mut a.lobe_pdf[from..to],
            );
            lanes::weigh(from, to, &o.throughput, a);
        }
    }

    /// Draws a light for each vertex.
    fn draw_lights(&self, block: &mut Block, depth: u32, which: u32) {
        let Block {
            stretches,
            lanes,
            lights,
            ..
        } = block;
        let n = lanes.count;
        let scene = self.scene;
        let Lanes {
            surfaces: s,
            arriving,
            second,
            share_far,
            numbers,
            second_numbers,
            ..
        } = &mut **lanes;
        let (numbers, a) = match which {
            0 => (&numbers.values, arriving),
            _ => (&*second_numbers, second),
        };
        if let Some(light) = scene.lights.lone_parallelogram() {
            let [_, u, v, _] = numbers;
            lanes::draw_light(n, light, [u, v], s, a);
            return;
        }
        let world = (&scene.geometry, &scene.textures);
        let wanted = |plain: &Plain| !plain.specular && self.lights_at(&plain.lobe, depth) > which;
        let receivers = self
            .each(stretches)
            .filter(|(plain, _)| wanted(plain))
            .flat_map(|(plain, range)| range.map(move |i| (i, plain)))
            .map(|(i, plain)| (i, s.receiver(i, plain)));
        let u = [0, 1, 2, 3].map(|k| &numbers[k][..]);
        let place = |i, light| a.set(i, light);
        (scene.lights).sample_all(lights, receivers, world, u, share_far, place);
    }

    /// Adds the light that nothing is in the way of.
    fn add_unblocked(&self, block: &mut Block, depth: u32) {
        let Block {
            paths,
            lanes,
            shadows,
            blocked,
            tally,
            shared,
            ..
        } = block;
        let a = &lanes.arriving;
        shadows.clear();
        for i in 0..LANES.min(lanes.count) {
            if a.brought.colour(i).is_black() {
                continue;
            }
            let ray = Ray {
                origin: a.origin.get(i),
                direction: a.direction.get(i),
                t_max: if a.far[i] { f32::INFINITY } else { TO_LIGHT },
            };
            shadows.push(id(i), ray);
        }
        let accel = &self.scene.geometry.accel;
        accel.occluded_all(shadows.rays(), blocked);
        tally.rays += shadows.len() as u64;
        for (k, &blocked) in blocked.iter().enumerate() {
            if !blocked {
                let lane = shadows.number(k);
                let path = index(lanes.owners[lane]);
                match shared {
                    Some(shared) if shared.is_at_y(path) => shared.keep_light(path, lanes, lane),
                    _ => paths.add(path, a.brought.colour(lane), depth + 1),
                }
            }
        }
    }

    /// Draws the next direction of each path.
    fn scatter_lanes(&self, block: &mut Block, depth: u32) {
        let Block {
            paths,
            stretches,
            lanes,
            streams,
            tally,
            shared,
            ..
        } = block;
        let n = lanes.count;
        lanes.numbers.draw(n, Purpose::Scatter, depth);
        let Lanes {
            surfaces: s,
            onward: o,
            numbers,
            owners,
            ..
        } = &mut **lanes;
        for (plain, range) in self.each(stretches) {
            let (from, to) = (range.start, range.end);
            fill_streams(paths, &owners[from..to], plain, (depth, 1), streams);
            let u = [0, 1, 2].map(|k| &numbers.values[k][from..to]);
            let samples = specula_bsdf::batch::Samples {
                wi: o.wi.directions_mut(from, to),
                weight: o.weight.colours_mut(from, to),
                pdf: &mut o.pdf[from..to],
                kind: &mut o.kind[from..to],
            };
            lobes::sample(&plain.lobe, s.wo.directions(from, to), u, streams, samples);
            let sides = plain.black_inside.then(|| &s.side[from..to]);
            let scattered = lanes::count_scattered(&o.kind[from..to], sides);
            tally.scattered = tally.scattered.and(scattered);
            for i in range.filter(|_| !plain.opaque) {
                if matches!(o.kind[i], Kind::Transmission | Kind::SpecularTransmission) {
                    o.eta_scale[i] *= plain.eta * plain.eta;
                }
            }
        }
        if let Some(shared) = shared {
            let n = n.min(LANES);
            shared.let_pass(&owners[..n], &mut numbers.values[3][..n]);
        }
        lanes::go_on(n, depth, s, &numbers.values[3], o);
        self.keep(block, depth);
    }

    /// Brings the paths that go on back from the lanes.
    fn keep(&self, block: &mut Block, depth: u32) {
        let Block {
            paths,
            next,
            stretches,
            lanes,
            shared,
            ..
        } = block;
        let (s, o) = (&lanes.surfaces, &lanes.onward);
        for (plain, range) in self.each(stretches) {
            for i in range {
                if !o.alive[i] || (plain.black_inside && s.side[i] < 0.0) {
                    continue;
                }
                let number = lanes.owners[i];
                let path = index(number);
                let ray = Ray {
                    origin: o.origin.get(i),
                    direction: o.direction.get(i),
                    t_max: f32::INFINITY,
                };
                next.push(number, ray);
                let mut throughput = o.throughput.colour(i);
                if let Some(shared) = shared {
                    if shared.is_at_y(path) {
                        shared.keep_direction(path, lanes, i);
                    }
                    let from_x = shared.carried_from_x(path, o.weight.colour(i));
                    throughput = from_x.unwrap_or(throughput);
                }
                paths.throughput.set_colour(path, throughput);
                paths.eta_scale[path] = o.eta_scale[i];
                paths.straight[path] = false;
                paths.rough[path] |= matches!(o.kind[i], Kind::Reflection | Kind::Transmission);
                if plain.specular {
                    paths.previous_pdf[path] = 0.0;
                } else {
                    let lights = self.lights_at(&plain.lobe, depth);
                    paths.previous_pdf[path] = candidates::density(o.pdf[i], lights);
                    paths.previous_share[path] = lanes.share_far[i];
                    paths.previous.set(path, &s.receiver(i, plain));
                }
            }
        }
    }
}

/// Streams for lobes whose values are estimates.
fn fill_streams(
    paths: &Paths,
    owners: &[u32],
    plain: &Plain,
    (depth, purpose): (u32, u32),
    streams: &mut Vec<Stream>,
) {
    streams.clear();
    if lobes::takes_streams(&plain.lobe) {
        let stream = |&p: &u32| paths.samplers[index(p)].stream(depth, purpose);
        streams.extend(owners.iter().map(stream));
    }
}
