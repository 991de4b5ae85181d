//! How much memory a render will take, before it begins.
//!
//! A bound: a count of the arrays that preparing and rendering make, in the order in which they make and free
//! them; the largest sum is the peak. Sizes of a triangle's share of the tree, and of what building
//! takes besides, are measured (`tests` and the command line's tests hold the estimate against what
//! the system reports). Reading a scene is over when its estimate is made: what that took is measured
//! ([`MemoryEstimate::after_reading`]).

use specula_scene::Scene;
use specula_scene::scene::{
    CurveMesh, Geometry, Light, Mesh, ObjectInstance, PatchMesh, Shape, Texture,
};

use crate::accel::predicted;
use crate::film::{BYTES_PER_TILE, TILE};
use crate::geometry::has_own_space;
use crate::light::{BYTES_PER_EMITTER, BYTES_PER_FAR_PIXEL};
use crate::options::RenderOptions;
use crate::picture::{ALL_CHANNELS, blocks_size};
use crate::prepared::asked_crop;
use crate::texture::{moment_pixels, pyramid_pixels};

/// The program itself, as it is before a scene is read.
const PROGRAM: u64 = 10 << 20;
/// Code and buffers that only rendering and writing load. Code without optimisation is larger.
const LATER: u64 = if cfg!(debug_assertions) { 10 } else { 6 } << 20;
/// Stack and buffers of a thread.
const THREAD: u64 = 1 << 20;

/// Bytes that a render takes, by what takes them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryEstimate {
    /// Shapes, meshes and pictures as they were read; freed while the render is prepared.
    pub scene: u64,
    /// Vertices and triangles in the world.
    pub geometry: u64,
    /// The bounding volume hierarchies over them.
    pub tree: u64,
    /// Pictures of textures, tables of measured materials.
    pub textures: u64,
    /// Lights, the tree over them, and images of environment lights.
    pub lights: u64,
    /// Sums of samples.
    pub film: u64,
    /// The film as a picture, and what is written of it.
    pub pictures: u64,
    /// The program and its threads.
    pub program: u64,
    /// The most that reading the scene took.
    pub reading: u64,
    /// Largest sum while the render is prepared.
    preparing: u64,
    /// What of the scene is freed in small pieces: allocators may not return those.
    loose: u64,
}

impl MemoryEstimate {
    /// The estimate for a scene, as it is before [`PreparedScene::consume`].
    ///
    /// * `threads`: of the pool in which it is prepared and rendered.
    ///
    /// [`PreparedScene::consume`]: crate::PreparedScene::consume
    #[must_use]
    pub fn new(scene: &Scene, options: &RenderOptions, threads: usize) -> Self {
        let mut estimate = Self {
            program: PROGRAM + LATER + THREAD * threads as u64,
            ..Self::default()
        };
        let meshes: u64 = scene.meshes.iter().map(mesh_bytes).sum();
        let patches: u64 = scene.patch_meshes.iter().map(patch_bytes).sum();
        let curves: u64 = scene.curve_meshes.iter().map(curve_bytes).sum();
        let meshes = meshes + patches + curves;
        let pictures: u64 = scene.images.iter().map(|i| i.pixels.size()).sum();
        let objects = scene.objects.iter().map(|o| o.shapes.len());
        let shapes = scene.shapes.len() + objects.sum::<usize>();
        let places =
            shapes * size_of::<Shape>() + scene.instances.len() * size_of::<ObjectInstance>();
        let measured: u64 = scene
            .measured
            .iter()
            .map(|m| m.lobe().size_in_bytes())
            .sum();
        estimate.scene = meshes + pictures + measured + places as u64;
        estimate.loose = meshes + places as u64;
        let mut held = Held {
            now: estimate.program + estimate.scene,
            peak: 0,
        };
        // Materials share them with the scene.
        estimate.textures = measured;
        estimate.add_textures(scene, options, &mut held);
        estimate.add_geometry(scene, options, threads, &mut held);
        estimate.add_lights(scene, &mut held);
        estimate.preparing = held.peak;
        let size = film_size(scene, options);
        let pixels = size.iter().product::<u64>();
        let tiles = size.map(|side| side.div_ceil(u64::from(TILE)));
        estimate.film = BYTES_PER_TILE * tiles.iter().product::<u64>();
        let [width, _] = options.resolution.unwrap_or(scene.film.resolution);
        // A picture's pixel developed, and once more for the file's channels.
        estimate.pictures = 2 * ALL_CHANNELS * pixels + blocks_size(width, threads);
        estimate
    }

    /// The estimate beside what the process took to read the scene. What it holds beyond the scene
    /// (libraries, tables, what an allocator does not give back) is then measured, not guessed.
    ///
    /// * `now`: bytes that are resident.
    /// * `most`: the most that were.
    #[must_use]
    pub fn after_reading(self, now: u64, most: u64) -> Self {
        let program = self.program.max(now.saturating_sub(self.scene) + LATER);
        Self {
            preparing: self.preparing + (program - self.program),
            program,
            // The system counts by pages of each processor: it may be behind.
            reading: most + (1 << 20),
            ..self
        }
    }

    /// The most that is taken at any time.
    #[must_use]
    pub fn peak(&self) -> u64 {
        self.reading.max(self.preparing).max(self.rendering())
    }

    /// What is taken when a picture is written.
    #[must_use]
    pub fn rendering(&self) -> u64 {
        let lasting = self.geometry + self.tree + self.textures + self.lights;
        self.program + self.loose + lasting + self.film + self.pictures
    }

    /// What is taken at most before the first sample.
    #[must_use]
    pub fn preparing(&self) -> u64 {
        self.preparing
    }

    fn add_textures(&mut self, scene: &Scene, options: &RenderOptions, held: &mut Held) {
        let mut used = vec![false; scene.images.len()];
        let mut has_pyramid = used.clone();
        for texture in &scene.textures {
            if let Texture::Image { image, filter, .. } = texture {
                used[image.0] = true;
                has_pyramid[image.0] |= options.texture_filter.of(*filter).is_filtered();
            }
        }
        for (index, image) in scene.images.iter().enumerate().filter(|(i, _)| used[*i]) {
            // Textures take the pictures over, but for those that lights have as well.
            let size = image.pixels.size();
            if environment_images(scene).any(|id| id == index) {
                held.add(size);
            }
            self.textures += size;
            if has_pyramid[index] {
                let bytes = if image.pixels.is_colour() { 12 } else { 4 };
                let pyramid = bytes * pyramid_pixels([image.width, image.height]);
                held.add(pyramid);
                self.textures += pyramid;
            }
        }
        if options.filter_normal_maps {
            let moments = 24 * moment_pixels(scene);
            held.add(moments);
            self.textures += moments;
        }
    }

    fn add_geometry(
        &mut self,
        scene: &Scene,
        options: &RenderOptions,
        threads: usize,
        held: &mut Held,
    ) {
        let mut shown = vec![false; scene.objects.len()];
        for instance in &scene.instances {
            shown[instance.object.0] = true;
        }
        let objects = scene.objects.iter().zip(shown).filter(|(_, shown)| *shown);
        let groups: Vec<&[Shape]> = std::iter::once(scene.shapes.as_slice())
            .chain(objects.map(|(o, _)| o.shapes.as_slice()))
            .collect();
        let mut uses = vec![0_u32; scene.meshes.len()];
        for mesh in groups.iter().copied().flatten().filter_map(mesh_of) {
            uses[mesh] += 1;
        }
        let mut sizes = Vec::new();
        for group in groups {
            let mut size = [0; 4];
            for shape in group {
                let is_cut = options.triangulate_exact_shapes || shape.emission.is_some();
                if let Some((primitives, baked)) = of_exact(scene, shape, is_cut) {
                    size = [0, 1, 2, 3].map(|k: usize| size[k] + primitives[k]);
                    held.add(baked);
                    self.geometry += baked;
                    continue;
                }
                let Some(index) = mesh_of(shape) else {
                    size[1] += 1;
                    continue;
                };
                let mesh = &scene.meshes[index];
                let triangles = mesh.triangles.len();
                size[0] += triangles;
                // The shape of every triangle, and its light.
                let per_triangle = if shape.emission.is_some() { 12 } else { 4 };
                let baked = mesh_bytes(mesh) + (per_triangle * triangles) as u64;
                held.add(baked);
                self.geometry += baked;
                uses[index] -= 1;
                if uses[index] == 0 {
                    held.free(mesh_bytes(mesh));
                }
            }
            sizes.push(size);
        }
        let quadrics: usize = sizes.iter().map(|s| s[1]).sum();
        let moving = own_placements(scene);
        let placements = scene.instances.len() + moving;
        let placed = crate::geometry::BYTES_PER_QUADRIC * quadrics as u64
            + crate::geometry::BYTES_PER_INSTANCE * placements as u64
            + crate::movement::BYTES * moving as u64;
        held.add(placed);
        self.geometry += placed;
        let tree = predicted(&sizes, placements, threads);
        held.add(tree.finished + tree.building);
        held.free(tree.building);
        self.tree = tree.finished;
    }

    fn add_lights(&mut self, scene: &Scene, held: &mut Held) {
        let objects = scene.instances.iter().map(|i| &scene.objects[i.object.0]);
        let shapes = scene.shapes.iter().chain(objects.flat_map(|o| &o.shapes));
        let emitters: u64 = shapes
            .filter(|s| s.emission.is_some())
            .map(|s| match s.geometry {
                Geometry::Mesh(id) => scene.meshes[id.0].triangles.len() as u64,
                Geometry::Patches(id) => scene.patch_meshes[id.0].triangle_count(),
                Geometry::Curves(id) => scene.curve_meshes[id.0].triangle_count(),
                Geometry::Sphere { .. } | Geometry::Disk { .. } | Geometry::QuadricPart(_) => 1,
            })
            .sum();
        self.lights = BYTES_PER_EMITTER * emitters;
        for id in environment_images(scene) {
            self.lights += BYTES_PER_FAR_PIXEL * pixels(&scene.images[id]);
        }
        held.add(self.lights);
    }
}

/// Bytes that are allocated, and the most that were.
struct Held {
    now: u64,
    peak: u64,
}

impl Held {
    fn add(&mut self, bytes: u64) {
        self.now += bytes;
        self.peak = self.peak.max(self.now);
    }

    fn free(&mut self, bytes: u64) {
        self.now = self.now.saturating_sub(bytes);
    }
}

/// At most so many placements move, or are of curves that a transform distorts.
fn own_placements(scene: &Scene) -> usize {
    let among = |shapes: &[Shape]| (shapes.iter()).filter(|s| has_own_space(s)).count();
    let objects: Vec<usize> = scene.objects.iter().map(|o| among(&o.shapes)).collect();
    let of = |i: &ObjectInstance| objects[i.object.0] + usize::from(i.motion.is_some());
    among(&scene.shapes) + scene.instances.iter().map(of).sum::<usize>()
}

fn mesh_of(shape: &Shape) -> Option<usize> {
    match shape.geometry {
        Geometry::Mesh(mesh) => Some(mesh.0),
        Geometry::Sphere { .. }
        | Geometry::Disk { .. }
        | Geometry::QuadricPart(_)
        | Geometry::Patches(_)
        | Geometry::Curves(_) => None,
    }
}

/// Numbers of triangles, quadrics, patches and segments, and bytes, of patches or curves; `None` of other shapes.
///
/// * `is_cut`: whether they become triangles.
fn of_exact(scene: &Scene, shape: &Shape, is_cut: bool) -> Option<([usize; 4], u64)> {
    let (triangles, whole) = match shape.geometry {
        Geometry::Patches(id) => {
            let mesh = &scene.patch_meshes[id.0];
            let own = crate::geometry::BYTES_PER_PATCH * mesh.patches.len() as u64;
            let whole = ([0, 0, mesh.patches.len(), 0], patch_bytes(mesh) + own);
            (mesh.triangle_count(), whole)
        }
        Geometry::Curves(id) => {
            let curves = &scene.curve_meshes[id.0];
            let count = curves.segments.len();
            let own = crate::geometry::BYTES_PER_SEGMENT * count as u64;
            (curves.triangle_count(), ([0, 0, 0, count], own))
        }
        _ => return None,
    };
    if !is_cut {
        return Some(whole);
    }
    // They have fewer vertices than triangles. Indices, shape and light of each; position, normal, coordinates.
    let bytes = triangles * (12 + 12 + 32);
    let triangles = usize::try_from(triangles).unwrap_or(usize::MAX);
    Some(([triangles, 0, 0, 0], bytes))
}

fn curve_bytes(curves: &CurveMesh) -> u64 {
    (56 * curves.segments.len() + 24 * curves.normals.len()) as u64
}

fn patch_bytes(mesh: &PatchMesh) -> u64 {
    let triples = mesh.positions.len() + mesh.normals.len();
    (12 * triples + 8 * mesh.uvs.len() + 16 * mesh.patches.len()) as u64
}

fn mesh_bytes(mesh: &Mesh) -> u64 {
    let triples =
        mesh.positions.len() + mesh.normals.len() + mesh.colours.len() + mesh.triangles.len();
    let pairs = mesh.uvs.len() + mesh.second_uvs.len();
    (12 * triples + 8 * pairs + 16 * mesh.tangents.len()) as u64
}

fn pixels(image: &specula_scene::Image) -> u64 {
    image.pixels.len() as u64
}

/// Pictures of infinite lights.
fn environment_images(scene: &Scene) -> impl Iterator<Item = usize> {
    scene.lights.iter().filter_map(|light| match light {
        Light::Infinite { image, .. } | Light::Portal { image, .. } => image.map(|(id, _)| id.0),
        _ => None,
    })
}

/// Columns and rows that are rendered.
fn film_size(scene: &Scene, options: &RenderOptions) -> [u64; 2] {
    let [width, height] = options.resolution.unwrap_or(scene.film.resolution);
    let [x0, x1, y0, y1] = asked_crop(&scene.film, options);
    let [columns, rows] = [(x0, x1.min(width)), (y0, y1.min(height))];
    [columns, rows].map(|(from, to)| u64::from(to.saturating_sub(from)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_scene::builtin;

    fn of(scene: &Scene) -> MemoryEstimate {
        MemoryEstimate::new(scene, &RenderOptions::from_scene(scene), 4)
    }

    #[test]
    fn films_count_the_pixels_that_are_rendered() {
        let scene = builtin::orbs();
        let options = |resolution, crop| RenderOptions {
            resolution,
            crop,
            ..RenderOptions::from_scene(&scene)
        };
        let film = |options| MemoryEstimate::new(&scene, &options, 1).film;
        let whole = film(options(Some([4096, 4096]), None));
        assert_eq!(whole / 4096 / 4096, 168);
        // Of tiles whose pixels are partly beyond the picture, all.
        assert_eq!(film(options(Some([17, 16]), None)), 2 * BYTES_PER_TILE);
        let part = film(options(Some([4096, 4096]), Some([0, 1024, 0, 1024])));
        assert_eq!(whole, 16 * part);
    }

    #[test]
    fn meshes_count_once_as_read_and_once_as_baked() {
        let mut scene = builtin::orbs();
        let before = of(&scene);
        let mesh = Mesh {
            positions: vec![[0.0; 3]; 500],
            triangles: vec![[0, 1, 2]; 1000],
            ..Mesh::default()
        };
        scene.meshes.push(mesh);
        let unused = of(&scene);
        assert_eq!(unused.scene - before.scene, 18_000);
        assert_eq!(unused.geometry, before.geometry);
        let mut shape = scene.shapes[0].clone();
        shape.geometry = Geometry::Mesh(specula_scene::scene::MeshId(scene.meshes.len() - 1));
        shape.emission = None;
        scene.shapes.push(shape);
        assert_eq!(of(&scene).geometry - unused.geometry, 18_000 + 4_000);
        assert!(of(&scene).tree > unused.tree);
        assert!(of(&scene).peak() > unused.peak());
    }

    #[test]
    fn trees_are_as_large_as_predicted() {
        let scene = builtin::orbs();
        let options = RenderOptions::from_scene(&scene);
        let estimate = of(&scene);
        let prepared = crate::PreparedScene::new(&scene, &options).unwrap();
        let built = prepared.geometry.accel.stats().bytes as f64;
        let ratio = estimate.tree as f64 / built;
        // Packets of its smooth surfaces are full.
        assert!((0.9..1.5).contains(&ratio), "{ratio}");
    }

    #[test]
    fn patches_are_counted_as_what_they_become() {
        let n = 60_u16;
        let at = |i: u16| {
            let [x, y] = [i % (n + 1), i / (n + 1)].map(f32::from);
            [x, y, (0.1 * x * y).sin()]
        };
        let corners = |k: u16| {
            let i = k / n * (n + 1) + k % n;
            [i, i + 1, i + n + 1, i + n + 2].map(u32::from)
        };
        let mut scene = builtin::orbs();
        scene.patch_meshes.push(PatchMesh {
            positions: (0..(n + 1) * (n + 1)).map(at).collect(),
            patches: (0..n * n).map(corners).collect(),
            ..PatchMesh::default()
        });
        scene.shapes.truncate(1);
        scene.shapes[0].emission = None;
        scene.shapes[0].geometry = Geometry::Patches(specula_scene::scene::PatchMeshId(0));
        let mut options = RenderOptions::from_scene(&scene);
        for (triangulates, expected) in [(false, 0.8..1.5), (true, 0.9..1.5)] {
            options.triangulate_exact_shapes = triangulates;
            let estimate = MemoryEstimate::new(&scene, &options, 4);
            let prepared = crate::PreparedScene::new(&scene, &options).unwrap();
            let stats = prepared.geometry.accel.stats();
            assert_eq!(stats.patches, if triangulates { 0 } else { 3600 });
            let ratio = estimate.tree as f64 / stats.bytes as f64;
            assert!(expected.contains(&ratio), "{triangulates}: {ratio}");
        }
    }

    #[test]
    fn curves_are_counted_as_what_they_become() {
        let lock = |i: u16| {
            let at = |k: u16| {
                let (i, k) = (f32::from(i), f32::from(k));
                [
                    (0.9 * i).sin() + 0.1 * k,
                    (1.3 * i).cos(),
                    (0.3 * k * i).sin(),
                ]
            };
            [0, 1, 2, 3].map(at)
        };
        let mut scene = builtin::orbs();
        scene.curve_meshes.push(CurveMesh {
            segments: (0..2000).map(lock).collect(),
            width_at_ends: vec![[0.01, 0.005]; 2000],
            ..CurveMesh::default()
        });
        scene.shapes.truncate(1);
        scene.shapes[0].emission = None;
        scene.shapes[0].geometry = Geometry::Curves(specula_scene::scene::CurveMeshId(0));
        let mut options = RenderOptions::from_scene(&scene);
        // Packets of tubes are full.
        for (triangulates, expected) in [(false, 0.8..1.5), (true, 0.9..2.0)] {
            options.triangulate_exact_shapes = triangulates;
            let estimate = MemoryEstimate::new(&scene, &options, 4);
            let prepared = crate::PreparedScene::new(&scene, &options).unwrap();
            let stats = prepared.geometry.accel.stats();
            assert_eq!(stats.curves, if triangulates { 0 } else { 2000 });
            let ratio = estimate.tree as f64 / stats.bytes as f64;
            assert!(expected.contains(&ratio), "{triangulates}: {ratio}");
        }
    }
}
