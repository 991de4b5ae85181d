//! Many paths in step, vertex by vertex.
//!
//! Of the surfaces that the paths of a block meet, those with constant opaque materials are sorted by
//! material and dealt with in lanes (`lanes`); the rest goes the scalar way (`PathTracer::meet`).
//! Which way a vertex goes is a matter of the scene alone, and a path never depends on the others of
//! its block.

use core::ops::Range;

use specula_bsdf::batch::Kind;
use specula_bsdf::math::Stream;
use specula_bsdf::{Bsdf, Vec3};

use super::lanes::{self, LANES, Lanes};
use super::passing::TO_LIGHT;
use super::{Path, PathTracer, Previous, lobes};
use crate::accel::{Hit, Ray};
use crate::convert::id;
use crate::geometry::NONE;
use crate::material::Plain;
use crate::options::Strategy;
use crate::sampler::Purpose;

/// A surface in waiting for its lanes.
struct Waiting {
    path: u32,
    /// Twice the material, and one more where that is seen from the outside or may be seen from either
    /// side.
    key: u32,
    hit: Hit,
}

/// A stretch of lanes of one key.
struct Stretch {
    from: usize,
    to: usize,
    key: u32,
}

/// Paths in step, and the room that they need.
pub(crate) struct Block {
    pub(crate) paths: Vec<Path>,
    live: Vec<u32>,
    next: Vec<u32>,
    waiting: Vec<Waiting>,
    /// How many wait of each key, then where they begin.
    starts: Vec<u32>,
    order: Vec<u32>,
    stretches: Vec<Stretch>,
    lanes: Box<Lanes>,
    owners: Vec<u32>,
    streams: Vec<Stream>,
}

impl Block {
    /// Most paths of a block.
    pub(crate) const SIZE: usize = LANES;

    /// An empty one.
    pub(crate) fn new() -> Self {
        Self {
            paths: Vec::with_capacity(Self::SIZE),
            live: Vec::new(),
            next: Vec::new(),
            waiting: Vec::new(),
            starts: Vec::new(),
            order: Vec::new(),
            stretches: Vec::new(),
            lanes: Lanes::new(),
            owners: Vec::new(),
            streams: Vec::new(),
        }
    }
}

impl PathTracer<'_> {
    /// Follows all paths of a block to their ends.
    pub(crate) fn follow_all(&self, block: &mut Block) {
        block.live.clear();
        block.live.extend(0..id(block.paths.len()));
        let mut depth = 0;
        while !block.live.is_empty() {
            block.next.clear();
            block.waiting.clear();
            self.meet_all(block, depth);
            if !block.waiting.is_empty() {
                self.sort(block);
                self.step_lanes(block, depth);
            }
            std::mem::swap(&mut block.live, &mut block.next);
            depth += 1;
        }
    }

    /// Finds what all rays meet; what is for lanes is left waiting.
    fn meet_all(&self, block: &mut Block, depth: u32) {
        let Block {
            paths,
            live,
            next,
            waiting,
            ..
        } = block;
        let geometry = &self.scene.geometry;
        let hides = self.scene.hide_emitters && depth == 0;
        let straight = !geometry.has_passable && !hides && !self.scene.materials.has_boundaries();
        let in_lanes = straight && self.strategy == Strategy::Mis && self.max_depth > 0;
        for &index in live.iter() {
            let path = &mut paths[index as usize];
            if !in_lanes {
                if self.step(path, depth) {
                    next.push(index);
                }
                continue;
            }
            path.state.rays += 1;
            let Some(hit) = geometry.accel.intersect(&path.ray) else {
                self.meet(path, None, depth);
                continue;
            };
            if let Some(key) = self.key(&path.ray, &hit) {
                if depth < self.max_depth {
                    waiting.push(Waiting {
                        path: index,
                        key,
                        hit,
                    });
                }
                continue;
            }
            let surface = geometry.surface(&path.ray, &hit);
            if self.meet(path, Some(surface), depth) {
                next.push(index);
            }
        }
    }

    /// The key of a surface for lanes, which sends out no light.
    #[inline]
    fn key(&self, ray: &Ray, hit: &Hit) -> Option<u32> {
        let geometry = &self.scene.geometry;
        let placement = &geometry.placements[hit.instance as usize];
        let group = &geometry.groups[placement.group as usize];
        if group.light_of(hit.primitive) != NONE {
            return None;
        }
        let shape = group.shape_of[hit.primitive as usize];
        let material = geometry.shapes[shape as usize].material;
        let [plain, _] = self.scene.materials.plain(material)?;
        let outside = !plain.is_sided || self.meets_outside(ray, hit);
        Some(2 * material + u32::from(outside))
    }

    fn meets_outside(&self, ray: &Ray, hit: &Hit) -> bool {
        let geometry = &self.scene.geometry;
        match geometry.corners(hit) {
            Some(([a, b, c], _)) => lanes::normal([a, b, c]).dot(ray.direction) < 0.0,
            None => geometry.surface(ray, hit).ng.dot(ray.direction) < 0.0,
        }
    }

    /// Sorts what waits by key into stretches of lanes.
    ///
    /// Even a lone vertex has a stretch: its numbers must not depend on what else there is.
    fn sort(&self, block: &mut Block) {
        let Block {
            waiting,
            starts,
            order,
            stretches,
            ..
        } = block;
        starts.clear();
        starts.resize(2 * self.scene.materials.count(), 0);
        for w in waiting.iter() {
            starts[w.key as usize] += 1;
        }
        stretches.clear();
        let mut at = 0;
        for (key, count) in (0..).zip(starts.iter_mut()) {
            let to = at + *count as usize;
            if *count > 0 {
                stretches.push(Stretch { from: at, to, key });
            }
            *count = id(at);
            at = to;
        }
        order.clear();
        order.resize(at, 0);
        for (i, w) in (0..).zip(waiting.iter()) {
            let place = &mut starts[w.key as usize];
            order[*place as usize] = i;
            *place += 1;
        }
    }

    /// Takes the paths in lanes from this vertex to the next.
    fn step_lanes(&self, block: &mut Block, depth: u32) {
        self.load(block);
        let Block {
            paths,
            stretches,
            lanes,
            owners,
            ..
        } = block;
        let n = owners.len();
        lanes::make_surfaces(n, &lanes.triangles, &mut lanes.surfaces);
        lanes::turn(n, &mut lanes.surfaces);
        for (plain, range) in self.each(stretches) {
            if plain.specular {
                lanes::straighten(range.start, range.end, &mut lanes.surfaces);
            }
        }
        if depth == 0 {
            for (plain, range) in self.each(stretches) {
                for i in range {
                    let s = &lanes.surfaces;
                    let path = &mut paths[owners[i] as usize];
                    if !(plain.black_inside && s.side[i] < 0.0) {
                        path.first.albedo = plain.lobe.albedo();
                    }
                    path.first.normal = s.ns.get(i);
                    path.first.depth = Some((s.position.get(i) - path.ray.origin).length());
                }
            }
        }
        self.light_lanes(block, depth);
        self.scatter_lanes(block, depth);
    }

    /// Stretches of lanes with their materials.
    fn each<'s>(
        &'s self,
        stretches: &'s [Stretch],
    ) -> impl Iterator<Item = (&'s Plain, Range<usize>)> {
        stretches.iter().filter_map(|s| {
            let sides = self.scene.materials.plain(s.key / 2)?;
            Some((&sides[(s.key % 2) as usize], s.from..s.to))
        })
    }

    /// Brings what is sorted into the lanes.
    fn load(&self, block: &mut Block) {
        let Block {
            paths,
            waiting,
            order,
            stretches,
            lanes,
            owners,
            ..
        } = block;
        let geometry = &self.scene.geometry;
        owners.clear();
        let Lanes {
            triangles: t,
            surfaces: s,
            onward: o,
            numbers,
            ..
        } = &mut **lanes;
        for (plain, range) in self.each(stretches) {
            let needs_tangent = !plain.isotropic;
            for i in range {
                let w = &waiting[order[i] as usize];
                owners.push(w.path);
                let path = &paths[w.path as usize];
                numbers.place(i, &path.sampler);
                s.towards.set(i, -path.ray.direction);
                o.throughput.set_colour(i, path.state.throughput);
                o.eta_scale[i] = path.state.eta_scale;
                let corners = if needs_tangent {
                    None
                } else {
                    geometry.corners(&w.hit)
                };
                t.wanted[i] = corners.is_some();
                if let Some((corners, normals)) = corners {
                    for (c, v) in t.corners.iter_mut().zip(corners) {
                        c.set(i, v);
                    }
                    for (c, v) in t.normals.iter_mut().zip(normals) {
                        c.set(i, v);
                    }
                    t.weights[0][i] = w.hit.u;
                    t.weights[1][i] = w.hit.v;
                    s.tangent.set(i, Vec3::ZERO);
                } else {
                    let surface = geometry.surface(&path.ray, &w.hit);
                    s.position.set(i, surface.position);
                    s.error[i] = surface.error.x;
                    s.ng.set(i, surface.ng);
                    s.ns.set(i, surface.ns);
                    let tangent = if needs_tangent {
                        surface.tangent
                    } else {
                        Vec3::ZERO
                    };
                    s.tangent.set(i, tangent);
                }
            }
        }
    }

    /// Adds light from one sampled light to each path.
    fn light_lanes(&self, block: &mut Block, depth: u32) {
        let Block {
            paths,
            stretches,
            lanes,
            owners,
            streams,
            ..
        } = block;
        let n = owners.len();
        let scene = self.scene;
        lanes.numbers.draw(n, Purpose::Light, depth);
        let Lanes {
            surfaces: s,
            arriving: a,
            onward: o,
            numbers,
            ..
        } = &mut **lanes;
        if let Some(light) = scene.lights.lone_parallelogram() {
            let [_, u, v, _] = &numbers.values;
            lanes::draw_light(n, &light, [u, v], s, a);
        } else {
            let world = (&scene.geometry, &scene.textures);
            for (plain, range) in self.each(stretches).filter(|(plain, _)| !plain.specular) {
                for i in range {
                    let u = [0, 1, 2, 3].map(|k| numbers.values[k][i]);
                    a.set(i, scene.lights.sample(&s.receiver(i, plain), world, u));
                }
            }
        }
        lanes::to_frames(n, s, a);
        for (plain, range) in self.each(stretches) {
            let (from, to) = (range.start, range.end);
            if plain.specular {
                a.pdf[range].fill(0.0);
                continue;
            }
            if plain.black_inside {
                for i in range {
                    a.pdf[i] = if s.side[i] < 0.0 { 0.0 } else { a.pdf[i] };
                }
            }
            self.fill_streams(paths, &owners[from..to], plain, (depth, 0), streams);
            lobes::eval_pdf(
                &plain.lobe,
                s.wo.directions(from, to),
                a.wi.directions(from, to),
                streams,
                a.f_cos.colours_mut(from, to),
                &mut a.lobe_pdf[from..to],
            );
        }
        lanes::weigh(n, s, &o.throughput, a);
        for i in 0..n {
            let brought = a.brought.colour(i);
            if brought.is_black() {
                continue;
            }
            let path = &mut paths[owners[i] as usize];
            let ray = Ray {
                origin: a.origin.get(i),
                direction: a.direction.get(i),
                t_max: if a.far[i] { f32::INFINITY } else { TO_LIGHT },
            };
            path.state.rays += 1;
            if !scene.geometry.accel.occluded(&ray) {
                path.state.radiance += brought;
            }
        }
    }

    /// Streams for lobes whose values are estimates.
    fn fill_streams(
        &self,
        paths: &[Path],
        owners: &[u32],
        plain: &Plain,
        (depth, purpose): (u32, u32),
        streams: &mut Vec<Stream>,
    ) {
        streams.clear();
        if lobes::takes_streams(&plain.lobe) {
            let stream = |&p: &u32| paths[p as usize].sampler.stream(depth, purpose);
            streams.extend(owners.iter().map(stream));
        }
    }

    /// Draws the next direction of each path.
    fn scatter_lanes(&self, block: &mut Block, depth: u32) {
        let Block {
            paths,
            next,
            stretches,
            lanes,
            owners,
            streams,
            ..
        } = block;
        let n = owners.len();
        lanes.numbers.draw(n, Purpose::Scatter, depth);
        let Lanes {
            surfaces: s,
            onward: o,
            numbers,
            ..
        } = &mut **lanes;
        for (plain, range) in self.each(stretches) {
            let (from, to) = (range.start, range.end);
            self.fill_streams(paths, &owners[from..to], plain, (depth, 1), streams);
            let u = [0, 1, 2].map(|k| &numbers.values[k][from..to]);
            let samples = specula_bsdf::batch::Samples {
                wi: o.wi.directions_mut(from, to),
                weight: o.weight.colours_mut(from, to),
                pdf: &mut o.pdf[from..to],
                kind: &mut o.kind[from..to],
            };
            lobes::sample(&plain.lobe, s.wo.directions(from, to), u, streams, samples);
            for i in range.filter(|_| !plain.opaque) {
                if matches!(o.kind[i], Kind::Transmission | Kind::SpecularTransmission) {
                    o.eta_scale[i] *= plain.eta * plain.eta;
                }
            }
        }
        lanes::go_on(n, depth, s, &numbers.values[3], o);
        for (plain, range) in self.each(stretches) {
            for i in range {
                if !o.alive[i] || (plain.black_inside && s.side[i] < 0.0) {
                    continue;
                }
                let path = &mut paths[owners[i] as usize];
                path.ray = Ray {
                    origin: o.origin.get(i),
                    direction: o.direction.get(i),
                    t_max: f32::INFINITY,
                };
                path.state.throughput = o.throughput.colour(i);
                path.state.eta_scale = o.eta_scale[i];
                path.state.straight = false;
                path.state.previous = (!plain.specular).then(|| Previous {
                    receiver: s.receiver(i, plain),
                    pdf: o.pdf[i],
                });
                next.push(owners[i]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::PixelSample;
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;
    use crate::sampler::Sampler;

    /// What paths bring in blocks and one by one.
    fn both_ways(scene: &specula_scene::Scene) -> (PreparedScene, Vec<[PixelSample; 2]>) {
        let options = RenderOptions {
            max_depth: 6,
            resolution: Some([64, 48]),
            ..RenderOptions::default()
        };
        let prepared = PreparedScene::new(scene, &options).unwrap();
        let tracer = PathTracer::new(&prepared, &options);
        let path = |i: u32| {
            let sampler = Sampler::new([i % 64, i / 64], 3, 5);
            let raster = [(i % 64) as f32 + 0.3, (i / 64) as f32 + 0.6];
            let (origin, direction) = prepared.camera.ray(raster, [0.4, 0.7]);
            Path::new(sampler, origin, direction)
        };
        let mut block = Block::new();
        let mut found = Vec::new();
        for first in (0..64 * 48).step_by(Block::SIZE) {
            let numbers = first..first + id(Block::SIZE);
            block.paths.clear();
            block.paths.extend(numbers.clone().map(path));
            tracer.follow_all(&mut block);
            for (path_of_block, i) in block.paths.iter().zip(numbers) {
                let mut alone = path(i);
                tracer.follow(&mut alone);
                let (a, rays) = tracer.brought(path_of_block);
                let (b, rays_alone) = tracer.brought(&alone);
                assert!(rays > 0 && rays_alone > 0);
                found.push([a, b]);
            }
        }
        (prepared, found)
    }

    /// Paths in step are the paths one by one, up to rounding, which now and then sends one elsewhere.
    #[test]
    fn paths_in_blocks_are_paths_alone() {
        let metal = "conductor Au alpha 0.3";
        let brushed = "conductor Cu alpha 0.05 0.4";
        for texts in [
            [metal, "diffuse 0.5"],
            [brushed, "conductor 0.9"],
            ["coateddiffuse 0.6 alpha 0.2", "dielectric 1.5"],
            ["dielectric 1.5 alpha 0.2", "diffuse 0.7"],
        ] {
            let mut scene = specula_scene::builtin::orbs();
            let kinds = texts.map(|t| specula_scene::material_text::parse_material(t).unwrap());
            let mut in_lanes = 0;
            for (i, material) in scene.materials.iter_mut().enumerate() {
                material.kind = kinds[i % 2];
            }
            let (prepared, found) = both_ways(&scene);
            for material in 0..prepared.materials.count() {
                in_lanes += usize::from(prepared.materials.plain(id(material)).is_some());
            }
            assert!(in_lanes > 0, "{texts:?}");
            let apart = |[a, b]: &[PixelSample; 2]| {
                let scale = b.colour.max_channel().max(1e-3);
                let colour = (a.colour - b.colour).map(f32::abs).max_channel();
                colour > 1e-3 * scale
                    || (a.normal - b.normal).length() > 1e-4
                    || (a.albedo - b.albedo).map(f32::abs).max_channel() > 1e-6
                    || a.depth.is_some() != b.depth.is_some()
            };
            let count = found.iter().filter(|p| apart(p)).count();
            assert!(count * 100 < found.len(), "{texts:?}: {count}");
            let mean = |k: usize| found.iter().map(|p| p[k].colour.mean()).sum::<f32>();
            assert!((mean(0) / mean(1) - 1.0).abs() < 0.02, "{texts:?}");
        }
    }
}
