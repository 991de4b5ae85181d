//! Bakes shapes into groups: applies transforms and orients windings to the outside.

use core::ops::Range;
use std::collections::HashMap;

use glam::{DMat3, DMat4};
use rayon::prelude::*;
use specula_bsdf::Rgb;
use specula_scene::scene::{
    ColourParam, CurveKind, CurveMesh, FloatParam, Geometry as SceneGeometry, Material,
    MaterialKind, Mesh, ObjectInstance, PatchMesh, Scene, Shape,
};

use super::{GroupData, HairShape, NONE, PlacedQuadric, ShapeRecord, parallelogram};
use crate::accel::{CurveSegment, CurveShape, QuadricShape};
use crate::convert::{Affine, id, narrow, narrow3, normal_matrix, transform_point};
use crate::huge_pages;
use crate::movement::Movement;
use crate::texture::Textures;

/// No emission.
const BLACK: ColourParam = ColourParam::Value(Rgb::BLACK);

/// Shapes that are one group: those that stand still, or that move alike, or curves that one transform distorts or
/// mirrors.
pub(super) struct Part {
    pub(super) shapes: Vec<Shape>,
    /// From the group's space to that of the shapes' object, or of the world.
    pub(super) movement: Movement,
}

/// The still shapes first, also where there are none, then those with a space of their own, by that and its motion.
fn parts(shapes: Vec<Shape>) -> Vec<Part> {
    let (moving, still): (Vec<_>, Vec<_>) = shapes.into_iter().partition(has_own_space);
    let mut parts = vec![Part {
        shapes: still,
        movement: Movement::default(),
    }];
    let mut part_of = HashMap::new();
    for shape in moving {
        let (start, motion) = (shape.to_world, shape.motion);
        let numbers = motion.map(|m| (m.end.to_cols_array(), m.times));
        let numbers = numbers.map(|(end, times)| (end.map(f64::to_bits), times.map(f64::to_bits)));
        let key = (start.to_cols_array().map(f64::to_bits), numbers);
        let index = *part_of.entry(key).or_insert_with(|| {
            parts.push(Part {
                shapes: Vec::new(),
                movement: Movement::default().within(start, motion.as_ref()),
            });
            parts.len() - 1
        });
        parts[index].shapes.push(Shape {
            to_world: DMat4::IDENTITY,
            motion: None,
            ..shape
        });
    }
    parts
}

/// Whether a shape moves, or is of curves that are none any more in the space around.
pub(crate) fn has_own_space(shape: &Shape) -> bool {
    let is_curve = matches!(shape.geometry, SceneGeometry::Curves(_));
    shape.motion.is_some() || is_curve && !keeps_curves(&shape.to_world)
}

/// Whether a transform keeps angles, up to rounding, and the sides of curves, to which coordinates grow.
fn keeps_curves(m: &DMat4) -> bool {
    const TOLERANCE: f64 = 1e-5;
    let is_mirroring = mirrors(m);
    let m = DMat3::from_mat4(*m);
    let square = scale(&m).powi(2);
    let error = m.transpose() * m - DMat3::from_diagonal(glam::DVec3::splat(square));
    let largest = error.to_cols_array().into_iter().map(f64::abs);
    !is_mirroring && largest.fold(0.0, f64::max) <= TOLERANCE * square
}

/// By which factor a similarity scales.
fn scale(m: &DMat3) -> f64 {
    m.determinant().abs().cbrt()
}

/// Bakes a scene's geometry. Every mesh is freed once nothing else needs it.
pub(super) struct Baker<'a> {
    textures: &'a Textures,
    meshes: &'a mut [Mesh],
    patch_meshes: &'a [PatchMesh],
    curve_meshes: &'a [CurveMesh],
    /// How many shapes are still to be baked from every mesh.
    uses: Vec<usize>,
    pub(super) world: Vec<Part>,
    pub(super) objects: Vec<Vec<Part>>,
    pub(super) instances: Vec<ObjectInstance>,
    /// Which materials are interfaces: no surfaces but boundaries of media.
    interfaces: Vec<bool>,
    /// Which materials are hair, or have it in them.
    hair: Vec<bool>,
    pub(super) records: Vec<ShapeRecord>,
    with_colours: bool,
}

impl<'a> Baker<'a> {
    pub(super) fn new(scene: &'a mut Scene, textures: &'a Textures) -> Self {
        let Scene {
            materials,
            meshes,
            patch_meshes,
            curve_meshes,
            shapes,
            objects,
            instances,
            ..
        } = scene;
        let visible = |shapes: &mut Vec<Shape>| {
            let mut shapes = std::mem::take(shapes);
            for s in &mut shapes {
                s.alpha = textures.fold_float(s.alpha);
            }
            shapes.retain(|s| {
                let material = &materials[s.material.0];
                (!is_interface(material) || material.bounds_absorption())
                    && !matches!(s.alpha, FloatParam::Value(a) if a <= 0.0)
            });
            // Indices of triangles come first and those of curves last, whatever the order of the shapes.
            shapes.sort_by_key(|s| match s.geometry {
                SceneGeometry::Mesh(_) => 0,
                SceneGeometry::Patches(_) => 2,
                SceneGeometry::Curves(_) => 3,
                _ => 1,
            });
            shapes
        };
        let world = visible(shapes);
        let instances = std::mem::take(instances);
        let mut shown = vec![false; objects.len()];
        for instance in &instances {
            shown[instance.object.0] = true;
        }
        let objects: Vec<_> = std::mem::take(objects)
            .iter_mut()
            .zip(shown)
            .map(|(o, shown)| {
                if shown {
                    visible(&mut o.shapes)
                } else {
                    Vec::new()
                }
            })
            .collect();
        let mut uses = vec![0; meshes.len()];
        for shape in world.iter().chain(objects.iter().flatten()) {
            if let SceneGeometry::Mesh(mesh) = shape.geometry {
                uses[mesh.0] += 1;
            }
        }
        Self {
            interfaces: materials.iter().map(is_interface).collect(),
            hair: (materials.iter())
                .map(|m| m.holds_hair(materials))
                .collect(),
            textures,
            meshes,
            patch_meshes,
            curve_meshes,
            uses,
            world: parts(world),
            objects: objects.into_iter().map(parts).collect(),
            instances,
            records: Vec::new(),
            with_colours: textures.shows_vertex_colours(),
        }
    }

    pub(super) fn bake(&mut self, shapes: Vec<Shape>) -> GroupData {
        let mut group = GroupData::default();
        self.reserve(&mut group, &shapes);
        for shape in &shapes {
            let record = id(self.records.len());
            let hair = self.hair_shape(shape);
            let has_uvs = match shape.geometry {
                SceneGeometry::Mesh(mesh) => self.add_mesh(&mut group, mesh.0, shape),
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
                SceneGeometry::QuadricPart(part) => {
                    group.add_quadric(QuadricShape::Part(part), shape);
                    true
                }
                SceneGeometry::Patches(id) => group.add_patches(&self.patch_meshes[id.0], shape),
                SceneGeometry::Curves(id) => group.add_curves(&self.curve_meshes[id.0], shape),
            };
            let radiance = shape
                .emission
                .map_or(BLACK, |e| self.textures.fold_colour(e.radiance));
            let emits = !matches!(radiance, ColourParam::Value(c) if c.is_black());
            let first = group.shape_of.len();
            let count = group.primitive_count();
            group.shape_of.resize(count, record);
            if emits {
                group.light_of.resize(first, NONE);
            }
            if emits {
                let is_whole = matches!(shape.alpha, FloatParam::Value(a) if a >= 1.0);
                let whole = is_whole && matches!(radiance, ColourParam::Value(_));
                add_lights(&mut group, first..count, whole);
            }
            self.records.push(ShapeRecord {
                material: id(shape.material.0),
                radiance,
                two_sided: shape.emission.is_some_and(|e| e.two_sided),
                alpha: match shape.alpha {
                    FloatParam::Value(a) if a >= 1.0 => None,
                    alpha => Some(alpha),
                },
                is_interface: self.interfaces[shape.material.0],
                hair,
                has_uvs,
                is_inside_out: is_inside_out(shape),
            });
        }
        group
    }

    fn hair_shape(&self, shape: &Shape) -> Option<HairShape> {
        let is_fibre = match shape.geometry {
            SceneGeometry::Mesh(mesh) => self.meshes[mesh.0].is_fibre,
            SceneGeometry::Sphere { .. }
            | SceneGeometry::Disk { .. }
            | SceneGeometry::QuadricPart(_)
            | SceneGeometry::Patches(_)
            | SceneGeometry::Curves(_) => false,
        };
        self.hair[shape.material.0].then_some(match is_fibre {
            true => HairShape::Fibre,
            false => HairShape::Surface,
        })
    }

    /// Makes room for the meshes of shapes, so that arrays of many need not grow.
    fn reserve(&self, group: &mut GroupData, shapes: &[Shape]) {
        let (mut vertices, mut triangles, mut normals, mut uvs) = (0, 0, 0, 0);
        for shape in shapes {
            if let SceneGeometry::Mesh(mesh) = shape.geometry {
                let mesh = &self.meshes[mesh.0];
                triangles += mesh.triangles.len();
                vertices += mesh.positions.len();
                // They end with the last mesh that has any.
                for (most, own) in [
                    (&mut normals, mesh.normals.len()),
                    (&mut uvs, mesh.uvs.len()),
                ] {
                    if own > 0 {
                        *most = vertices;
                    }
                }
            }
        }
        group.positions.reserve_exact(vertices);
        group.triangles.reserve_exact(triangles);
        group.normals.reserve_exact(normals);
        group.uvs.reserve_exact(uvs);
        group.shape_of.reserve_exact(triangles + shapes.len());
        huge_pages::advise(&group.positions);
        huge_pages::advise(&group.triangles);
        huge_pages::advise(&group.normals);
        huge_pages::advise(&group.uvs);
        huge_pages::advise(&group.shape_of);
    }

    /// Adds a mesh; returns whether it has texture coordinates.
    fn add_mesh(&mut self, group: &mut GroupData, index: usize, shape: &Shape) -> bool {
        self.uses[index] -= 1;
        let last;
        let mesh = if self.uses[index] == 0 {
            last = std::mem::take(&mut self.meshes[index]);
            &last
        } else {
            &self.meshes[index]
        };
        group.add_mesh(mesh, shape);
        let per_vertex = |count: usize| count == mesh.positions.len();
        if self.with_colours && per_vertex(mesh.colours.len()) {
            let first = group.positions.len() - mesh.positions.len();
            group.colours.resize(first, [1.0; 3]);
            group.colours.extend(&mesh.colours);
        }
        per_vertex(mesh.uvs.len())
    }
}

impl GroupData {
    /// Adds vertices with their attributes; returns the index of the first.
    fn add_vertices(
        &mut self,
        [positions, normals]: [&[[f32; 3]]; 2],
        uvs: &[[f32; 2]],
        shape: &Shape,
    ) -> u32 {
        let first = id(self.positions.len());
        let m = &shape.to_world;
        extend(&mut self.positions, positions, |p| transform_point(m, *p));
        if normals.len() == positions.len() {
            self.normals.resize(first as usize, [0.0; 3]);
            let sign = if shape.reverse_orientation { -1.0 } else { 1.0 };
            let matrix = normal_matrix(m) * sign;
            let turned = |n: &[f32; 3]| {
                let n = matrix * glam::DVec3::from(n.map(f64::from));
                narrow3(n.normalize_or_zero()).to_array()
            };
            extend(&mut self.normals, normals, turned);
        }
        if uvs.len() == positions.len() {
            self.uvs.resize(first as usize, [0.0; 2]);
            self.uvs.extend(uvs);
        }
        first
    }

    /// Adds patches; returns whether they have texture coordinates.
    fn add_patches(&mut self, mesh: &PatchMesh, shape: &Shape) -> bool {
        let vertices = [&mesh.positions[..], &mesh.normals[..]];
        let first = self.add_vertices(vertices, &mesh.uvs, shape);
        let patches = mesh.patches.iter();
        self.patches.extend(patches.map(|p| p.map(|v| v + first)));
        mesh.uvs.len() == mesh.positions.len()
    }

    /// Adds segments of curves, which their transform keeps; returns that they have texture coordinates.
    fn add_curves(&mut self, curves: &CurveMesh, shape: &Shape) -> bool {
        let m = &shape.to_world;
        let scale = narrow(scale(&DMat3::from_mat4(*m)));
        let normals = normal_matrix(m);
        let turned = |n: [f32; 3]| {
            let n = normals * glam::DVec3::from(n.map(f64::from));
            narrow3(n.normalize_or(glam::DVec3::Z)).to_array()
        };
        let segments = curves
            .segments
            .iter()
            .zip(&curves.width_at_ends)
            .enumerate();
        self.curves
            .extend(segments.map(|(i, (controls, width_at_ends))| {
                let controls = controls.map(|p| transform_point(m, p));
                let shape = match (curves.kind, curves.normals.get(i)) {
                    (CurveKind::Ribbon, Some(ends)) => CurveShape::Ribbon(ends.map(turned)),
                    (CurveKind::Cylinder, _) => CurveShape::Cylinder,
                    (CurveKind::Flat | CurveKind::Ribbon, _) => CurveShape::Flat,
                };
                CurveSegment {
                    controls,
                    width_at_ends: width_at_ends.map(|w| scale * w),
                    shape,
                }
            }));
        true
    }

    /// How many primitives there are.
    fn primitive_count(&self) -> usize {
        self.triangles.len() + self.quadrics.len() + self.patches.len() + self.curves.len()
    }

    fn add_mesh(&mut self, mesh: &Mesh, shape: &Shape) {
        let m = &shape.to_world;
        let first = self.add_vertices([&mesh.positions, &mesh.normals], &mesh.uvs, shape);
        let has_normals = mesh.normals.len() == mesh.positions.len();
        if mesh.second_uvs.len() == mesh.positions.len() {
            self.second_uvs.resize(first as usize, [0.0; 2]);
            self.second_uvs.extend(&mesh.second_uvs);
        }
        let mirrored = mirrors(m);
        if mesh.tangents.len() == mesh.positions.len() {
            self.tangents.resize(first as usize, [0.0; 4]);
            // Reversed normals and mirroring transforms reverse the cross product.
            let turned = mirrored != shape.reverse_orientation;
            let linear = DMat3::from_mat4(*m);
            self.tangents
                .extend(mesh.tangents.iter().map(|&[x, y, z, side]| {
                    let t = linear * glam::DVec3::from([x, y, z].map(f64::from));
                    let t = narrow3(t.normalize_or_zero());
                    [t.x, t.y, t.z, if turned { -side } else { side }]
                }));
        }
        let flip = mirrored != shape.reverse_orientation;
        let mut triangles = std::mem::take(&mut self.triangles);
        extend(&mut triangles, &mesh.triangles, |t| {
            let t = t.map(|v| v + first);
            let disagrees = if has_normals { self.disagrees(t) } else { None };
            if disagrees.unwrap_or(flip) {
                [t[0], t[2], t[1]]
            } else {
                t
            }
        });
        self.triangles = triangles;
    }

    /// Whether the vertex normals point to the side opposite to that of the winding; `None` where they are
    /// perpendicular to it.
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
}

/// Gives indices to the lights of a shape: every primitive, or every parallelogram of two triangles.
///
/// * `whole`: whether parallelograms may be lights.
fn add_lights(group: &mut GroupData, primitives: Range<usize>, whole: bool) {
    let mut at = primitives.start;
    while at < primitives.end {
        let light = id(group.emitters.len());
        group.emitters.push(id(at));
        group.light_of.push(light);
        at += 1;
        if whole && at < primitives.end.min(group.triangles.len()) {
            let pair = [id(at - 1), id(at)].map(|t| group.corners(t));
            if parallelogram(pair).is_some() {
                group.light_of.push(light);
                at += 1;
            }
        }
    }
}

/// As of [`ShapeRecord`].
fn is_inside_out(shape: &Shape) -> bool {
    match shape.geometry {
        SceneGeometry::Curves(_) => shape.reverse_orientation,
        _ => mirrors(&shape.to_world) != shape.reverse_orientation,
    }
}

/// Whether a transform turns left into right.
fn mirrors(m: &DMat4) -> bool {
    DMat3::from_mat4(*m).determinant() < 0.0
}

fn is_interface(material: &Material) -> bool {
    matches!(material.kind, MaterialKind::Interface)
}

/// Appends elements, turned into others; those of large arrays on all cores.
fn extend<T: Sync, U: Send>(
    to: &mut Vec<U>,
    elements: &[T],
    turned: impl Fn(&T) -> U + Send + Sync,
) {
    /// Elements that one thread reads: a call into the pool takes longer than so many.
    const SERIAL: usize = 1 << 14;
    if elements.len() <= SERIAL {
        return to.extend(elements.iter().map(turned));
    }
    to.par_extend(elements.par_iter().with_min_len(SERIAL).map(turned));
}
