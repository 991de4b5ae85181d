//! Flat arrays of everything that rays can hit, and the surface at a hit.
//!
//! Shapes of the world are baked into one group in world space; every object that is instanced is
//! a group of its own. Orientation is baked too: a triangle's winding is such that
//! `(p1 - p0) x (p2 - p0)` points to its outside. The outside is pbrt's: the winding's side,
//! flipped by `ReverseOrientation`, travelling with the shape under mirroring transforms; where the
//! mesh has vertex normals, the side that they point to. Of bilinear patches it is that of `dp/du x dp/dv`, by the same
//! rules. Spheres and disks follow them, too (outwards, and +z). Curves have theirs towards the ray, ribbons towards
//! their normals, unless they are reversed. pbrt itself turns the hits, though not the light samples, of mirrored spheres and
//! disks inside out; Specula does not.

mod bake;
mod curves;
mod flat;
mod footprint;
mod hit;
mod partials;
mod patches;
mod quadric_parts;

use glam::DMat4;
use rayon::prelude::*;
use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::scene::{ColourParam, FloatParam, ObjectInstance, Scene};

use crate::accel::{Accel, AccelError, CurveSegment, Group, Hit, Instance, Quadric, QuadricShape};
use crate::convert::{Affine, id, narrow3, normal_matrix, widen3};
use crate::movement::Movement;
use crate::texture::Textures;
use bake::{Baker, Part};

pub(crate) use bake::has_own_space;
pub(crate) use hit::{Coordinates, PrimitiveLocation, QuadricId, QuadricPoint, Surface};
pub(crate) use partials::Partials;

/// No light.
pub(crate) use crate::codes::NONE;

/// Largest coordinate of a shape: squares of lengths, and their products with areas, are within
/// `f32`.
pub(crate) const FARTHEST: f32 = 1e15;

/// What the primitives of a shape share.
#[derive(Clone, Debug)]
pub(crate) struct ShapeRecord {
    pub(crate) material: u32,
    /// Emitted radiance; black where it does not emit.
    pub(crate) radiance: ColourParam,
    pub(crate) two_sided: bool,
    /// Opacity, where it is not 1 everywhere.
    pub(crate) alpha: Option<FloatParam>,
    /// Whether it is no surface but the boundary of a medium.
    pub(crate) is_interface: bool,
    /// What it is of, where its material is hair, or a mix with hair in it.
    pub(crate) hair: Option<HairShape>,
    has_uvs: bool,
    /// Whether the outside of its patches, where they have no normals, is opposite to `dp/du x dp/dv`; that of curves,
    /// whether they are reversed.
    is_inside_out: bool,
}

/// What a shape of hair is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HairShape {
    /// A tube around a fibre, whose lobe takes light from where it enters to where it leaves: rays within pass.
    Fibre,
    /// Any other shape: every hit is one of a fibre.
    Surface,
}

impl ShapeRecord {
    /// Whether rays that hit it are followed one by one: it may let them pass, or is of hair, which takes no notice of
    /// the sides of its normals.
    #[inline(always)]
    pub(crate) fn is_passable(&self) -> bool {
        self.alpha.is_some() || self.is_interface || self.hair.is_some()
    }

    /// Whether a ray within it passes its surface.
    ///
    /// * `ng`: normal towards its outside.
    pub(crate) fn is_left_by(&self, ng: Vec3<f32>, direction: Vec3<f32>) -> bool {
        self.hair == Some(HairShape::Fibre) && ng.dot(direction) > 0.0
    }
}

/// A sphere, a disk, a cylinder or a part of one in its group.
#[derive(Clone, Debug)]
pub(crate) struct PlacedQuadric {
    pub(crate) shape: QuadricShape,
    pub(crate) to_group: DMat4,
    forward: Affine,
    backward: Affine,
    normals: Affine,
    /// Whether the outside is the inside.
    pub(crate) flipped: bool,
}

/// Triangles, quadrics, bilinear patches and segments of curves in one space. Primitives are numbered in this order.
#[derive(Clone, Debug, Default)]
pub(crate) struct GroupData {
    pub(crate) positions: Vec<[f32; 3]>,
    /// Zero where a mesh has none; empty where no mesh has any.
    normals: Vec<[f32; 3]>,
    /// As `normals`.
    uvs: Vec<[f32; 2]>,
    /// As `normals`.
    second_uvs: Vec<[f32; 2]>,
    /// As `normals`: in the group's space, with the sign of `normal x tangent` there.
    tangents: Vec<[f32; 4]>,
    /// White where a mesh has none; empty where no mesh has any or no texture shows them.
    colours: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) quadrics: Vec<PlacedQuadric>,
    /// Vertices `p00`, `p10`, `p01` and `p11` of each.
    pub(crate) patches: Vec<[u32; 4]>,
    pub(crate) curves: Vec<CurveSegment>,
    /// Shape of every primitive.
    pub(crate) shape_of: Vec<u32>,
    /// Index of every primitive among the group's lights, or [`NONE`]; ends with the last light.
    light_of: Vec<u32>,
    /// Primitives that emit, by that index.
    pub(crate) emitters: Vec<u32>,
}

/// Memory of a quadric in its group, with its shape's index.
pub(crate) const BYTES_PER_QUADRIC: u64 =
    (size_of::<PlacedQuadric>() + size_of::<Quadric>() + 8 + size_of::<ShapeRecord>()) as u64;

/// Memory of a patch in its group, without its vertices.
pub(crate) const BYTES_PER_PATCH: u64 = (size_of::<[u32; 4]>() + 4) as u64;

/// Memory of a segment of a curve in its group.
pub(crate) const BYTES_PER_SEGMENT: u64 = (size_of::<CurveSegment>() + 4) as u64;

/// Memory of an instance, with its share of the tree over instances.
pub(crate) const BYTES_PER_INSTANCE: u64 =
    (size_of::<Placement>() + size_of::<Instance>() + 24) as u64;

/// A group, placed in the world: an instance.
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    pub(crate) group: u32,
    /// The group's space to the world's; where the shutter opens, if it moves.
    pub(crate) transform: DMat4,
    pose: Pose,
    identity: bool,
    /// How it moves, if it does.
    movement: Option<Box<Movement>>,
    /// Index of the group's first light in the world's list.
    pub(crate) first_light: u32,
}

/// A transform, ready for surfaces.
#[derive(Clone, Debug)]
struct Pose {
    inverse: DMat4,
    to_world: Affine,
    normals: Affine,
}

/// Everything that rays can hit.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    pub(crate) accel: Accel,
    pub(crate) groups: Vec<GroupData>,
    pub(crate) placements: Vec<Placement>,
    pub(crate) shapes: Vec<ShapeRecord>,
    /// Whether any shape is passable.
    pub(crate) has_passable: bool,
}

impl Geometry {
    /// Bakes the scene's shapes and builds the tree over them.
    ///
    /// * `scene`: left without its shapes, objects, and the meshes that were baked.
    /// * `earlier`: geometry whose tree is taken over, if it is over the same shapes.
    pub(crate) fn after(
        scene: &mut Scene,
        textures: &Textures,
        earlier: Option<Self>,
    ) -> Result<Self, AccelError> {
        let mut baker = Baker::new(scene, textures);
        let mut groups = Vec::new();
        let mut placements = Vec::new();
        for part in std::mem::take(&mut baker.world) {
            placements.push(Placement::new(id(groups.len()), part.movement));
            groups.push(baker.bake(part.shapes));
        }
        let mut groups_of = vec![None; baker.objects.len()];
        for instance in std::mem::take(&mut baker.instances) {
            let ObjectInstance {
                object,
                to_world,
                motion,
            } = instance;
            let own = groups_of[object.0].get_or_insert_with(|| {
                let parts = std::mem::take(&mut baker.objects[object.0]);
                let bake = |part: Part| {
                    groups.push(baker.bake(part.shapes));
                    (id(groups.len() - 1), part.movement)
                };
                parts.into_iter().map(bake).collect::<Vec<_>>()
            });
            for (group, movement) in own {
                let movement = movement.clone().within(to_world, motion.as_ref());
                placements.push(Placement::new(*group, movement));
            }
        }
        let shapes = baker.records;
        // A lone group needs no tree over instances: an empty world group must not make it one of two.
        placements.retain(|p| !groups[p.group as usize].shape_of.is_empty());
        let mut lights = 0;
        for p in &mut placements {
            p.first_light = lights;
            lights += id(groups[p.group as usize].emitters.len());
        }
        let same = earlier.filter(|e| e.has_shapes_of(&groups, &placements));
        let accel = match same {
            Some(earlier) => earlier.accel,
            None => build_accel(&groups, &placements)?,
        };
        let has_passable = shapes.iter().any(ShapeRecord::is_passable);
        Ok(Self {
            accel,
            groups,
            placements,
            shapes,
            has_passable,
        })
    }
}

impl Geometry {
    /// Whether its acceleration structure is that of these groups and instances.
    fn has_shapes_of(&self, groups: &[GroupData], placements: &[Placement]) -> bool {
        let place = |p: &Placement| (p.group, p.transform, p.movement.clone());
        self.groups.len() == groups.len()
            && (self.placements.iter().map(place)).eq(placements.iter().map(place))
            && (self.groups.iter().zip(groups)).all(|(a, b)| {
                a.positions == b.positions
                    && a.triangles == b.triangles
                    && a.patches == b.patches
                    && a.curves == b.curves
                    && (a.quadrics.iter().map(PlacedQuadric::in_tree))
                        .eq(b.quadrics.iter().map(PlacedQuadric::in_tree))
            })
    }

    /// The group of a hit.
    #[inline(always)]
    pub(crate) fn group_of(&self, hit: &Hit) -> &GroupData {
        let placement = &self.placements[hit.instance as usize];
        &self.groups[placement.group as usize]
    }

    /// Whether there are parts of quadrics, bilinear patches or curves, which shaders have not.
    pub(crate) fn has_exact_shapes(&self) -> bool {
        let is_part = |q: &PlacedQuadric| matches!(q.shape, QuadricShape::Part(_));
        let has_other = |g: &GroupData| !(g.patches.is_empty() && g.curves.is_empty());
        (self.groups.iter()).any(|g| has_other(g) || g.quadrics.iter().any(is_part))
    }

    /// Whether all shapes, in the world and in the space of their group, are near enough for rays.
    pub(crate) fn is_within_reach(&self) -> bool {
        let near = |p: &[f32; 3]| p.iter().all(|x| x.abs() <= FARTHEST);
        let world = self.accel.bounds();
        world.is_none_or(|b| near(&b.min) && near(&b.max))
            && self.groups.iter().all(|g| {
                g.positions.par_iter().with_min_len(1 << 14).all(near)
                    && g.curves.iter().all(|c| c.controls.iter().all(near))
                    && g.quadrics.iter().all(|q| q.reach() <= f64::from(FARTHEST))
            })
    }
}

fn build_accel(groups: &[GroupData], placements: &[Placement]) -> Result<Accel, AccelError> {
    let quadrics: Vec<Vec<Quadric>> = groups
        .iter()
        .map(|g| g.quadrics.iter().map(PlacedQuadric::in_tree).collect())
        .collect();
    let inputs: Vec<Group<'_>> = groups
        .iter()
        .zip(&quadrics)
        .map(|(g, quadrics)| Group {
            positions: &g.positions,
            triangles: &g.triangles,
            quadrics,
            patches: &g.patches,
            curves: &g.curves,
        })
        .collect();
    let instances: Vec<Instance> = placements
        .iter()
        .map(|p| Instance {
            group: p.group,
            to_world: p.transform,
        })
        .collect();
    let movements: Vec<(u32, &Movement)> = (0..)
        .zip(placements)
        .filter_map(|(i, p)| Some((i, p.movement.as_deref()?)))
        .collect();
    Accel::build_moving(&inputs, &instances, &movements)
}

impl GroupData {
    /// Index of a primitive among the group's lights, or [`NONE`].
    #[inline(always)]
    pub(crate) fn light_of(&self, primitive: u32) -> u32 {
        self.light_of
            .get(primitive as usize)
            .copied()
            .unwrap_or(NONE)
    }

    /// The corners of a triangle.
    #[inline(always)]
    pub(crate) fn corners(&self, primitive: u32) -> [Vec3<f32>; 3] {
        self.triangles[primitive as usize].map(|v| Vec3::from(self.positions[v as usize]))
    }
}

impl PlacedQuadric {
    /// The quadric as the acceleration structure takes it.
    fn in_tree(&self) -> Quadric {
        Quadric {
            shape: self.shape,
            to_group: self.to_group,
        }
    }

    /// A bound on its coordinates.
    fn reach(&self) -> f64 {
        let m = &self.to_group;
        let axes = [m.x_axis, m.y_axis, m.z_axis].map(|a| a.truncate().length());
        m.w_axis.truncate().length() + axes.iter().sum::<f64>() * self.shape.reach()
    }
}

impl Placement {
    fn new(group: u32, movement: Movement) -> Self {
        let transform = movement.at(0.0);
        let movement = movement.moves().then(|| Box::new(movement));
        Self {
            group,
            transform,
            pose: Pose::new(&transform),
            identity: movement.is_none() && transform == DMat4::IDENTITY,
            movement,
            first_light: 0,
        }
    }
}

impl Pose {
    fn new(transform: &DMat4) -> Self {
        Self {
            inverse: transform.inverse(),
            to_world: Affine::new(transform),
            normals: Affine::linear(&normal_matrix(transform)),
        }
    }
}

/// The corner of a parallelogram and its two neighbours, where two triangles of the same winding make
/// one: in winding order about the outside.
pub(crate) fn parallelogram([one, other]: [[Vec3<f32>; 3]; 2]) -> Option<[Vec3<f32>; 3]> {
    let lone = (0..3).find(|&i| !other.contains(&one[i]))?;
    let [corner, next, last] = [0, 1, 2].map(|i| one[(lone + i) % 3]);
    let opposite = (0..3).find(|&i| other[i] != next && other[i] != last)?;
    // The two triangles traverse the shared edge in opposite directions.
    if other[(opposite + 1) % 3] != last || other[(opposite + 2) % 3] != next {
        return None;
    }
    let gap = (other[opposite] - last) - (next - corner);
    let size = (next - corner).length().max((last - corner).length());
    (gap.length() <= 1e-6 * size).then_some([corner, next, last])
}

/// The geometric normal of a triangle, towards its outside.
#[inline(always)]
pub(crate) fn triangle_normal([a, b, c]: [Vec3<f32>; 3]) -> Vec3<f32> {
    unit_or((b - a).cross(c - a), Vec3::Z)
}

/// The unit vector along `v`, without overflow or underflow; `fallback` for the zero vector and for
/// what is not finite.
#[inline(always)]
pub(crate) fn unit_or(v: Vec3<f32>, fallback: Vec3<f32>) -> Vec3<f32> {
    let largest = v.x.abs().max(v.y.abs()).max(v.z.abs());
    if !(largest > 0.0 && largest.is_finite()) {
        return fallback;
    }
    // Two steps: the reciprocal of a subnormal number overflows.
    let v = vec3(v.x / largest, v.y / largest, v.z / largest);
    v.normalize()
}

/// The unit normal of a triangle by two of its edges; `+z` where it has no area.
#[inline(always)]
pub(crate) fn normal_of(e1: Vec3<f32>, e2: Vec3<f32>) -> Vec3<f32> {
    /// Below, components lose digits.
    const LEAST: f32 = 1e-30;
    let n = e1.cross(e2);
    let largest = n.x.abs().max(n.y.abs()).max(n.z.abs());
    if largest > LEAST && largest.is_finite() {
        return unit_or(n, Vec3::Z);
    }
    let n = widen3(e1).cross(widen3(e2)).normalize_or_zero();
    unit_or(narrow3(n), Vec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bumpy sheet with its own normals and texture coordinates beside a sphere and a curve, as a moving instance.
    fn moving_scene() -> Scene {
        use specula_scene::scene::*;
        let film = Film::new([8; 2], Filter::Box { radius: [0.5; 2] });
        let camera = Camera::look_at(
            glam::DVec3::X,
            glam::DVec3::ZERO,
            glam::DVec3::Z,
            40.0,
            &film,
        );
        let mut scene = Scene::empty(camera, film, Settings::default());
        scene.materials.push(Material::new(MaterialKind::Interface));
        scene.materials[0].kind = MaterialKind::Diffuse {
            reflectance: ColourParam::WHITE,
            roughness: FloatParam::Value(0.0),
        };
        let at = |i: u8| {
            [
                f32::from(i % 4) - 1.5,
                f32::from(i / 4) - 1.5,
                f32::from(i % 3) * 0.3,
            ]
        };
        let mesh = Mesh {
            positions: (0..16).map(at).collect(),
            normals: (0..16)
                .map(|i| [at(i)[0] * 0.2, at(i)[1] * 0.1, 1.0])
                .collect(),
            uvs: (0..16).map(|i| [at(i)[1], at(i)[0] * 2.0]).collect(),
            triangles: [0, 1, 2, 4, 5, 6, 8, 9, 10]
                .into_iter()
                .flat_map(|i| [[i, i + 1, i + 5], [i, i + 5, i + 4]])
                .collect(),
            ..Mesh::default()
        };
        scene.meshes.push(mesh);
        let arc = [-1.5, -0.5, 0.5, 1.5].map(|x: f32| [x, x * x - 1.0, x]);
        scene.curve_meshes.push(CurveMesh {
            segments: vec![arc],
            width_at_ends: vec![[0.3, 0.5]],
            ..CurveMesh::default()
        });
        let sphere = Geometry::Sphere { radius: 0.7 };
        let beside = DMat4::from_translation(glam::DVec3::new(0.0, 0.0, 2.0));
        scene.objects.push(Object {
            name: String::new(),
            shapes: vec![
                Shape::new(Geometry::Mesh(MeshId(0)), DMat4::IDENTITY, MaterialId(0)),
                Shape::new(sphere, beside, MaterialId(0)),
                Shape::new(Geometry::Curves(CurveMeshId(0)), beside, MaterialId(0)),
            ],
        });
        let start = DMat4::from_scale(glam::DVec3::new(1.0, -1.0, 0.5));
        let end = DMat4::from_translation(glam::DVec3::X) * DMat4::from_rotation_x(1.0) * start;
        let times = [0.0, 1.0];
        scene.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world: start,
            motion: Some(Motion { end, times }),
        });
        scene
    }

    #[test]
    fn surfaces_of_what_moves_are_those_of_where_it_is_at_their_time() {
        use specula_scene::scene::Trajectory;
        let geometry = |mut scene: Scene| {
            let textures = Textures::new(&mut scene);
            Geometry::after(&mut scene, &textures, None).unwrap()
        };
        let moving = geometry(moving_scene());
        let mut random = specula_bsdf::math::Stream::new(5);
        let (mut sheet, mut sphere, mut curve) = (0, 0, 0);
        for time in [0.0, 0.3, 0.5, 0.9, 1.0] {
            let mut scene = moving_scene();
            let instance = &mut scene.instances[0];
            let motion = instance.motion.take().unwrap();
            instance.to_world = Trajectory::new(&instance.to_world, &motion).at(f64::from(time));
            let still = geometry(scene);
            for _ in 0..200 {
                let mut u = || random.next::<f32>() - 0.5;
                let ray = crate::accel::Ray {
                    origin: vec3(4.0 * u(), 4.0 * u(), 9.0),
                    direction: vec3(0.2 * u(), 0.2 * u(), -1.0),
                    t_max: f32::INFINITY,
                };
                let hit = moving.accel.intersect_at(&ray, time);
                assert_eq!(hit, still.accel.intersect(&ray));
                let Some(hit) = hit else { continue };
                let surface = moving.surface(&ray, &hit, time);
                let expected = still.surface(&ray, &hit, time);
                assert_eq!(format!("{surface:?}"), format!("{expected:?}"));
                let partials = [&moving, &still].map(|g| format!("{:?}", g.partials(&surface)));
                assert_eq!(partials[0], partials[1]);
                let group = &moving.groups[1];
                match (
                    group.triangles.get(hit.primitive as usize),
                    group.curve_at(hit.primitive),
                ) {
                    (Some(_), _) => sheet += 1,
                    (None, None) => sphere += 1,
                    (None, Some(_)) => curve += 1,
                }
            }
        }
        assert!(
            sheet > 200 && sphere > 30 && curve > 20,
            "{sheet} {sphere} {curve}"
        );
    }

    #[test]
    fn triangles_of_every_size_have_a_normal() {
        let (a, b) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 0.6, 0.8));
        for scale in [1e-37, 1e-25, 1e-12, 1.0, 1e12, 1e25, 1e37] {
            let n = normal_of(a * scale, b * scale);
            assert!((n - vec3(0.0, -0.8, 0.6)).length() < 1e-6, "{scale}: {n:?}");
        }
        assert_eq!(normal_of(a, a), Vec3::Z);
        assert_eq!(normal_of(Vec3::ZERO, b), Vec3::Z);
    }
}
