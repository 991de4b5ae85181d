//! Flat arrays of everything that rays can hit, and the way back from a hit to its surface.
//!
//! Shapes of the world are baked into one group in world space; every object that is instanced is
//! a group of its own. Orientation is baked too: a triangle's winding is such that
//! `(p1 - p0) x (p2 - p0)` points to its outside. The outside is pbrt's: the winding's side,
//! flipped by `ReverseOrientation`, travelling with the shape under mirroring transforms; where the
//! mesh has vertex normals, the side that they point to. Spheres and disks follow the same rule
//! (outwards, and +z). pbrt itself turns the hits, though not the light samples, of mirrored
//! spheres and disks inside out; here they stay as they are.

use glam::{DMat3, DMat4};
use specula_bsdf::math::vec3;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{
    FloatParam, Geometry as SceneGeometry, MaterialKind, Mesh, Scene, Shape,
};

use crate::accel::{Accel, AccelError, Group, Instance, Quadric, QuadricShape};
use crate::convert::{Affine, id, narrow3, normal_matrix, transform_point};

/// No light.
pub(crate) const NONE: u32 = u32::MAX;

/// What the primitives of a shape share.
#[derive(Clone, Debug)]
pub(crate) struct ShapeRecord {
    pub(crate) material: u32,
    /// Black where it sends out nothing.
    pub(crate) radiance: Rgb<f32>,
    pub(crate) two_sided: bool,
    /// Opacity, where it is not 1 everywhere.
    pub(crate) alpha: Option<FloatParam>,
    has_uvs: bool,
}

/// A sphere or a disk in its group.
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

/// Triangles and quadrics in one space. Primitives are numbered triangles first.
#[derive(Clone, Debug, Default)]
pub(crate) struct GroupData {
    pub(crate) positions: Vec<[f32; 3]>,
    /// Zero where a mesh has none; empty where no mesh has any.
    normals: Vec<[f32; 3]>,
    /// As `normals`.
    uvs: Vec<[f32; 2]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) quadrics: Vec<PlacedQuadric>,
    /// Shape of every primitive.
    pub(crate) shape_of: Vec<u32>,
    /// Number of every primitive among the group's lights, or [`NONE`].
    light_of: Vec<u32>,
    /// Primitives that send out light, by that number.
    pub(crate) emitters: Vec<u32>,
}

/// A group's place in the world.
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    pub(crate) group: u32,
    pub(crate) transform: DMat4,
    inverse: DMat4,
    to_world: Affine,
    normals: Affine,
    identity: bool,
    /// Number of the group's first light in the world's list.
    pub(crate) first_light: u32,
}

/// Everything that rays can hit.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    pub(crate) accel: Accel,
    pub(crate) groups: Vec<GroupData>,
    pub(crate) placements: Vec<Placement>,
    pub(crate) shapes: Vec<ShapeRecord>,
    /// Whether any shape has an opacity.
    pub(crate) has_alpha: bool,
}

impl Geometry {
    /// Bakes the scene's shapes and builds the tree over them.
    pub(crate) fn new(scene: &Scene) -> Result<Self, AccelError> {
        let mut shapes = Vec::new();
        let mut groups = vec![bake(scene, &scene.shapes, &mut shapes)];
        let mut group_of = vec![None; scene.objects.len()];
        let mut placements = vec![Placement::new(0, DMat4::IDENTITY)];
        for instance in &scene.instances {
            let object = instance.object.0;
            let group = *group_of[object].get_or_insert_with(|| {
                groups.push(bake(scene, &scene.objects[object].shapes, &mut shapes));
                id(groups.len() - 1)
            });
            placements.push(Placement::new(group, instance.to_world));
        }
        // Rays go straight into a lone group: an empty world group must not stand in the way.
        placements.retain(|p| !groups[p.group as usize].shape_of.is_empty());
        let mut lights = 0;
        for p in &mut placements {
            p.first_light = lights;
            lights += id(groups[p.group as usize].emitters.len());
        }
        let accel = build_accel(&groups, &placements)?;
        let has_alpha = shapes.iter().any(|s: &ShapeRecord| s.alpha.is_some());
        Ok(Self {
            accel,
            groups,
            placements,
            shapes,
            has_alpha,
        })
    }
}

fn build_accel(groups: &[GroupData], placements: &[Placement]) -> Result<Accel, AccelError> {
    let quadrics: Vec<Vec<Quadric>> = groups
        .iter()
        .map(|g| {
            let quadric = |q: &PlacedQuadric| Quadric {
                shape: q.shape,
                to_group: q.to_group,
            };
            g.quadrics.iter().map(quadric).collect()
        })
        .collect();
    let inputs: Vec<Group<'_>> = groups
        .iter()
        .zip(&quadrics)
        .map(|(g, quadrics)| Group {
            positions: &g.positions,
            triangles: &g.triangles,
            quadrics,
        })
        .collect();
    let instances: Vec<Instance> = placements
        .iter()
        .map(|p| Instance {
            group: p.group,
            to_world: p.transform,
        })
        .collect();
    Accel::build(&inputs, &instances)
}

fn bake(scene: &Scene, shapes: &[Shape], records: &mut Vec<ShapeRecord>) -> GroupData {
    let mut group = GroupData::default();
    // Triangles come first in the numbering, whatever the order of the shapes.
    let visible = |s: &&Shape| {
        !matches!(scene.materials[s.material.0].kind, MaterialKind::Interface)
            && s.alpha != FloatParam::Value(0.0)
    };
    let is_mesh = |s: &&Shape| matches!(s.geometry, SceneGeometry::Mesh(_));
    let meshes = shapes.iter().filter(visible).filter(is_mesh);
    let others = shapes.iter().filter(visible).filter(|s| !is_mesh(s));
    for shape in meshes.chain(others) {
        let record = id(records.len());
        let has_uvs = match shape.geometry {
            SceneGeometry::Mesh(mesh) => {
                let mesh = &scene.meshes[mesh.0];
                let has_uvs = mesh.uvs.len() == mesh.positions.len();
                group.add_mesh(mesh, shape);
                has_uvs
            }
            SceneGeometry::Sphere { radius } => {
                let radius = f64::from(radius);
                group.add_quadric(QuadricShape::Sphere { radius }, shape);
                true
            }
            SceneGeometry::Disk { radius, height } => {
                let (radius, height) = (f64::from(radius), f64::from(height));
                group.add_quadric(QuadricShape::Disk { radius, height }, shape);
                true
            }
        };
        let emits = shape.emission.is_some_and(|e| !e.radiance.is_black());
        let first = group.shape_of.len();
        let count = group.triangles.len() + group.quadrics.len();
        group.shape_of.resize(count, record);
        for primitive in first..count {
            if emits {
                group.light_of.push(id(group.emitters.len()));
                group.emitters.push(id(primitive));
            } else {
                group.light_of.push(NONE);
            }
        }
        records.push(ShapeRecord {
            material: id(shape.material.0),
            radiance: shape.emission.map_or(Rgb::BLACK, |e| e.radiance),
            two_sided: shape.emission.is_some_and(|e| e.two_sided),
            // Emitters are opaque: the sampling of lights knows no opacity.
            alpha: match shape.alpha {
                FloatParam::Value(a) if a >= 1.0 => None,
                _ if emits => None,
                alpha => Some(alpha),
            },
            has_uvs,
        });
    }
    group
}

impl GroupData {
    fn add_mesh(&mut self, mesh: &Mesh, shape: &Shape) {
        let first = id(self.positions.len());
        let m = &shape.to_world;
        let positions = mesh.positions.iter().map(|&p| transform_point(m, p));
        self.positions.extend(positions);
        let has_normals = mesh.normals.len() == mesh.positions.len();
        if has_normals {
            self.normals.resize(first as usize, [0.0; 3]);
            let sign = if shape.reverse_orientation { -1.0 } else { 1.0 };
            let matrix = normal_matrix(m) * sign;
            let normals = mesh.normals.iter().map(|n| {
                let n = matrix * glam::DVec3::from(n.map(f64::from));
                narrow3(n.normalize_or_zero()).to_array()
            });
            self.normals.extend(normals);
        }
        if mesh.uvs.len() == mesh.positions.len() {
            self.uvs.resize(first as usize, [0.0; 2]);
            self.uvs.extend(&mesh.uvs);
        }
        let mirrored = DMat3::from_mat4(*m).determinant() < 0.0;
        let flip = mirrored != shape.reverse_orientation;
        for &t in &mesh.triangles {
            let t = t.map(|v| v + first);
            let flip = if has_normals {
                self.disagrees(t).unwrap_or(flip)
            } else {
                flip
            };
            self.triangles
                .push(if flip { [t[0], t[2], t[1]] } else { t });
        }
    }

    /// Whether the winding's side is not the one that the vertex normals point to; `None` where
    /// they do not say.
    fn disagrees(&self, t: [u32; 3]) -> Option<bool> {
        let [a, b, c] = t.map(|v| glam::DVec3::from(self.positions[v as usize].map(f64::from)));
        let [na, nb, nc] = t.map(|v| glam::DVec3::from(self.normals[v as usize].map(f64::from)));
        let agreement = (b - a).cross(c - a).dot(na + nb + nc);
        (agreement != 0.0).then_some(agreement < 0.0)
    }

    fn add_quadric(&mut self, quadric: QuadricShape, shape: &Shape) {
        self.quadrics.push(PlacedQuadric {
            shape: quadric,
            to_group: shape.to_world,
            forward: Affine::new(&shape.to_world),
            backward: Affine::new(&shape.to_world.inverse()),
            normals: Affine::linear(&normal_matrix(&shape.to_world)),
            flipped: shape.reverse_orientation,
        });
    }

    /// The corners of a triangle.
    #[inline(always)]
    pub(crate) fn corners(&self, primitive: u32) -> [Vec3<f32>; 3] {
        self.triangles[primitive as usize].map(|v| Vec3::from(self.positions[v as usize]))
    }
}

impl Placement {
    fn new(group: u32, transform: DMat4) -> Self {
        Self {
            group,
            transform,
            inverse: transform.inverse(),
            to_world: Affine::new(&transform),
            normals: Affine::linear(&normal_matrix(&transform)),
            identity: transform == DMat4::IDENTITY,
            first_light: 0,
        }
    }
}

mod hit;
pub(crate) use hit::Surface;

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
