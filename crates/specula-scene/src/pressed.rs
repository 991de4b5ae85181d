//! Shapes under transforms that cannot be inverted: what keeps area stays, as geometry in the outer space.

use glam::{DMat4, DVec3};

use crate::Limits;
use crate::mesh;
use crate::num::f32_of;
use crate::scene::{Geometry, Mesh, MeshId, Shape};
use crate::transform::is_invertible;
use crate::triangulate::ExactMeshes;

/// Sines of angles below this are rounding: what they span has no area.
const FLAT: f64 = 1e-10;

/// What becomes of a shape.
#[derive(Debug)]
pub(crate) enum Pressed {
    /// A flat shape, whose transform can be inverted.
    Flat(Box<Shape>),
    /// Nothing is left of its area.
    Nothing,
}

impl Pressed {
    /// What a warning says.
    pub(crate) fn message(&self) -> &'static str {
        match self {
            Self::Flat(_) => "the transform presses the shape flat: it is rendered flat",
            Self::Nothing => "the transform presses the shape to no area: it is left out",
        }
    }
}

/// Presses shapes flat, as their transforms say.
pub(crate) struct Press {
    /// Vertices that meshes may still get.
    vertices: u64,
    most: u64,
}

impl Press {
    pub(crate) fn new(limits: &Limits) -> Self {
        Self {
            vertices: limits.max_vertices,
            most: limits.max_vertices,
        }
    }

    /// The shape under a transform that cannot be inverted.
    ///
    /// * `to_world`: leads from the shape's own space to that of the result.
    /// * `meshes`, `exact`: those of the scene; what is left of a shape may become a new mesh.
    ///
    /// # Errors
    ///
    /// A message where the meshes of all pressed shapes together exceed the limit of one mesh.
    pub(crate) fn shape(
        &mut self,
        shape: &Shape,
        to_world: &DMat4,
        meshes: &mut Vec<Mesh>,
        exact: ExactMeshes<'_>,
    ) -> Result<Pressed, String> {
        let Some(normal) = plane(to_world) else {
            return Ok(Pressed::Nothing);
        };
        let mut pressed = shape.clone();
        pressed.motion = None;
        let flat = match (shape.geometry, exact.mesh(&shape.geometry)) {
            (_, Some(mesh)) => self.flat(&mesh, to_world)?,
            (Geometry::Mesh(MeshId(i)), None) => self.flat(&meshes[i], to_world)?,
            (_, None) => None,
        };
        let is_kept = match shape.geometry {
            Geometry::Mesh(_)
            | Geometry::QuadricPart(_)
            | Geometry::Patches(_)
            | Geometry::Curves(_) => {
                pressed.to_world = DMat4::IDENTITY;
                pressed.geometry = Geometry::Mesh(MeshId(meshes.len()));
                flat.map(|mesh| meshes.push(mesh)).is_some()
            }
            Geometry::Sphere { radius } => {
                // The sphere's image is that of its disk across the direction that is pressed.
                let across = plane(&to_world.transpose()).unwrap_or(DVec3::Z);
                let (x, y) = across.any_orthonormal_pair();
                pressed.geometry = Geometry::Disk {
                    radius,
                    height: 0.0,
                };
                pressed.to_world = disk(to_world, [x, y], normal, DVec3::ZERO);
                // Both halves lie in the disk, and look to either side.
                if let Some(emission) = &mut pressed.emission {
                    emission.two_sided = true;
                }
                is_invertible(&pressed.to_world)
            }
            Geometry::Disk { radius, height } => {
                let centre = DVec3::Z * f64::from(height);
                pressed.geometry = Geometry::Disk {
                    radius,
                    height: 0.0,
                };
                pressed.to_world = disk(to_world, [DVec3::X, DVec3::Y], normal, centre);
                is_invertible(&pressed.to_world) && spans(&pressed.to_world)
            }
        };
        Ok(match is_kept {
            true => Pressed::Flat(Box::new(pressed)),
            false => Pressed::Nothing,
        })
    }

    /// A mesh pressed flat, its vertices taken from those that may be; `None` where it has no area.
    fn flat(&mut self, mesh: &Mesh, to_world: &DMat4) -> Result<Option<Mesh>, String> {
        let count = mesh.positions.len() as u64;
        self.vertices = self.vertices.checked_sub(count).ok_or_else(|| {
            let most = self.most;
            format!("meshes pressed flat have more than {most} vertices (`max_vertices`)")
        })?;
        Ok(flat_mesh(mesh, to_world))
    }
}

/// Unit normal of the plane that a transform presses space into; `None` where it is a line or a point.
fn plane(m: &DMat4) -> Option<DVec3> {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|c| c.truncate());
    let largest = [x, y, z]
        .iter()
        .map(|c| c.length_squared())
        .fold(0.0, f64::max);
    let normals = [x.cross(y), y.cross(z), z.cross(x)];
    let normal = normals
        .into_iter()
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    if normal.length() <= FLAT * largest {
        return None;
    }
    normal.try_normalize()
}

/// Whether the disk across z has area under a transform.
fn spans(m: &DMat4) -> bool {
    let [x, y] = [m.x_axis, m.y_axis].map(|c| c.truncate());
    x.cross(y).length() > FLAT * x.length_squared().max(y.length_squared())
}

/// The place of a disk: two axes of it and its centre, under `m`.
fn disk(m: &DMat4, axes: [DVec3; 2], normal: DVec3, centre: DVec3) -> DMat4 {
    let [x, y] = axes.map(|axis| m.transform_vector3(axis));
    // Its normal is on the side that its axes tell.
    let up = if x.cross(y).dot(normal) < 0.0 {
        -normal
    } else {
        normal
    };
    DMat4::from_cols(
        x.extend(0.0),
        y.extend(0.0),
        up.extend(0.0),
        m.transform_point3(centre).extend(1.0),
    )
}

/// A mesh in the outer space; `None` where none of its triangles has area.
fn flat_mesh(mesh: &Mesh, m: &DMat4) -> Option<Mesh> {
    let place = |p: &[f32; 3]| {
        m.transform_point3(DVec3::from(p.map(f64::from)))
            .to_array()
            .map(f32_of)
    };
    let mut flat = Mesh {
        positions: mesh.positions.iter().map(place).collect(),
        // All directions across the plane are one: the triangles' own normals are left.
        normals: Vec::new(),
        tangents: Vec::new(),
        is_fibre: false,
        ..mesh.clone()
    };
    mesh::clean(&mut flat).ok()?;
    (!flat.triangles.is_empty()).then_some(flat)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::MaterialId;

    fn press(geometry: Geometry, m: DMat4, meshes: &mut Vec<Mesh>) -> Option<Shape> {
        let shape = Shape::new(geometry, m, MaterialId(0));
        match Press::new(&Limits::default())
            .shape(&shape, &m, meshes, ExactMeshes::default())
            .unwrap()
        {
            Pressed::Flat(shape) => Some(*shape),
            Pressed::Nothing => None,
        }
    }

    /// Turned, pressed along z, and turned back elsewhere.
    fn pressing() -> DMat4 {
        let at = DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0));
        at * DMat4::from_rotation_x(0.7)
            * DMat4::from_scale(DVec3::new(2.0, 3.0, 0.0))
            * DMat4::from_rotation_y(0.4)
    }

    #[test]
    fn the_disk_of_a_sphere_has_the_outline_of_its_image() {
        let m = pressing();
        let shape = press(Geometry::Sphere { radius: 1.5 }, m, &mut Vec::new()).unwrap();
        assert_eq!(
            shape.geometry,
            Geometry::Disk {
                radius: 1.5,
                height: 0.0
            }
        );
        let to_disk = shape.to_world.inverse();
        let mut farthest: f64 = 0.0;
        for i in 0..2000 {
            let (z, phi) = (f64::from(i) / 1000.0 - 1.0, f64::from(i) * 2.4);
            let r = (1.0 - z * z).max(0.0).sqrt();
            let p = 1.5 * DVec3::new(r * phi.cos(), r * phi.sin(), z);
            let on_disk = to_disk.transform_point3(m.transform_point3(p));
            assert!(on_disk.z.abs() < 1e-12 && on_disk.length() < 1.5 + 1e-12);
            farthest = farthest.max(on_disk.length());
        }
        assert!(farthest > 1.4999, "{farthest}");
    }

    #[test]
    fn meshes_keep_the_triangles_that_have_area() {
        let mut meshes = vec![Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            normals: vec![[0.0, 0.0, 1.0]; 4],
            triangles: vec![[0, 1, 2], [0, 1, 3]],
            ..Mesh::default()
        }];
        let m = DMat4::from_scale(DVec3::new(2.0, 3.0, 0.0));
        let shape = press(Geometry::Mesh(MeshId(0)), m, &mut meshes).unwrap();
        assert_eq!(shape.geometry, Geometry::Mesh(MeshId(1)));
        assert_eq!(shape.to_world, DMat4::IDENTITY);
        assert_eq!(meshes[1].triangles, [[0, 1, 2]]);
        assert_eq!(mesh::area(&meshes[1], &DMat4::IDENTITY), 3.0);
        assert!(meshes[1].normals.is_empty());
    }

    #[test]
    fn what_has_no_area_is_nothing() {
        let line = pressing() * DMat4::from_rotation_y(-0.4) * DMat4::from_scale(DVec3::X);
        let meshes = &mut Vec::new();
        for m in [
            line,
            DMat4::from_scale(DVec3::ZERO),
            DMat4::from_scale(DVec3::splat(1e-120)),
        ] {
            assert!(
                press(Geometry::Sphere { radius: 1.0 }, m, meshes).is_none(),
                "{m}"
            );
        }
        // A disk that is seen from its edge.
        let edge = DMat4::from_scale(DVec3::new(0.0, 1.0, 1.0));
        let disk = Geometry::Disk {
            radius: 1.0,
            height: 1.0,
        };
        assert!(press(disk, edge, meshes).is_none());
        let flat = press(disk, pressing() * DMat4::from_rotation_y(-0.4), meshes).unwrap();
        let centre = flat.to_world.transform_point3(DVec3::ZERO);
        assert!(
            (centre - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-12,
            "{centre}"
        );
    }

    #[test]
    fn pressed_meshes_have_a_limit_together() {
        let mut meshes = vec![Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        }];
        let limits = Limits {
            max_vertices: 5,
            ..Limits::default()
        };
        let mut press = Press::new(&limits);
        let m = DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0));
        let shape = Shape::new(Geometry::Mesh(MeshId(0)), m, MaterialId(0));
        press
            .shape(&shape, &m, &mut meshes, ExactMeshes::default())
            .unwrap();
        let error = press
            .shape(&shape, &m, &mut meshes, ExactMeshes::default())
            .unwrap_err();
        assert!(error.contains("`max_vertices`"), "{error}");
    }
}
