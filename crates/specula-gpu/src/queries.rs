//! Ray queries: acceleration structures that an adapter builds over a scene, and whether it can.
//!
//! Triangles are taken as they are. Spheres and disks are boxes, whose candidates the shader intersects
//! (`query.wgsl`). A structure of an adapter has triangles or boxes, so that a group with both has two of them, and each
//! of its instances is two instances of the adapter with the same custom index.

use std::fmt;
use std::str::FromStr;

use specula_render::{FlatGroup, FlatInstance, PreparedScene};

use crate::adapter::{AdapterKind, Gpu, GpuError, RAY_QUERIES};
use crate::error::TracerError;
use crate::stage::{RayBindings, filled};

/// How rays are cast on a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rays {
    /// By ray queries where a real GPU offers them and they support the scene, else by traversal of the tree.
    #[default]
    Auto,
    /// By traversal of the same tree as on the processor.
    Tree,
    /// By the adapter's ray queries, or an error.
    Query,
}

impl FromStr for Rays {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "auto" => Ok(Self::Auto),
            "tree" => Ok(Self::Tree),
            "query" => Ok(Self::Query),
            _ => Err("expected auto, tree or query".to_owned()),
        }
    }
}

impl fmt::Display for Rays {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Tree => "tree",
            Self::Query => "query",
        })
    }
}

/// A scene as ray queries search it: the bind group 1 of shaders, with one acceleration structure.
#[derive(Debug)]
pub struct Structures {
    bindings: RayBindings,
}

/// Indices of instances have 24 bits.
const MOST_INSTANCES: usize = 1 << 24;
/// Primitives of the structures that are built at once, unless one has more: building needs memory.
const BATCH: usize = 1 << 22;
/// Absolute values of determinants that an adapter inverts without losing digits.
const DETERMINANTS: std::ops::RangeInclusive<f32> = 1e-30..=1e30;

impl Gpu {
    /// Whether the device was opened with ray queries: it is wherever the adapter offers them.
    #[must_use]
    pub fn has_ray_queries(&self) -> bool {
        self.device.features().contains(RAY_QUERIES)
    }
}

impl Structures {
    /// Builds the structures of a scene.
    ///
    /// # Errors
    /// [`TracerError::Queries`] where the adapter offers none or they do not support the scene; else those of
    /// the device.
    pub fn new(gpu: &Gpu, scene: &PreparedScene) -> Result<Self, TracerError> {
        if !gpu.has_ray_queries() {
            let reason = format!("{} offers none", gpu.adapter);
            return Err(TracerError::Queries(reason));
        }
        let (groups, instances) = scene.groups();
        if let Some(reason) = beyond(&gpu.device.limits(), &groups, &instances) {
            return Err(TracerError::Queries(reason));
        }
        Ok(gpu.caught(|gpu| build(gpu, &groups, &instances))??)
    }

    /// The bind group for shaders.
    pub(crate) fn bindings(&self) -> &RayBindings {
        &self.bindings
    }

    /// The structures where ray queries are chosen, `None` where rays are traversed by the shader.
    pub(crate) fn chosen(
        rays: Rays,
        gpu: &Gpu,
        scene: &PreparedScene,
    ) -> Result<Option<Self>, TracerError> {
        use GpuError::{OutOfMemory, Refused};
        let real = gpu.adapter.kind != AdapterKind::Software;
        if rays == Rays::Tree || (rays == Rays::Auto && !real) {
            return Ok(None);
        }
        match Self::new(gpu, scene) {
            Err(TracerError::Queries(_) | TracerError::Gpu(OutOfMemory(_) | Refused(_)))
                if rays == Rays::Auto =>
            {
                Ok(None)
            }
            other => other.map(Some),
        }
    }
}

/// Why a scene is beyond a device's ray queries; `None`: they support it.
fn beyond(
    limits: &wgpu::Limits,
    groups: &[FlatGroup<'_>],
    instances: &[FlatInstance],
) -> Option<String> {
    let primitives =
        |g: &FlatGroup<'_>| g.positions.len().max(g.triangles.len()).max(g.boxes.len());
    let largest = groups.iter().map(primitives).max().unwrap_or(0);
    let most = limits.max_blas_primitive_count as usize;
    if largest > most {
        return Some(format!(
            "an object has {largest} triangles or vertices; they take {most}"
        ));
    }
    let places = instances.iter().map(|i| &groups[i.group as usize]);
    let placed: usize = places
        .map(|g| usize::from(!g.triangles.is_empty()) + usize::from(!g.boxes.is_empty()))
        .sum();
    let most = MOST_INSTANCES.min(limits.max_tlas_instance_count as usize);
    if placed.max(1) > most {
        return Some(format!("there are {placed} instances; they take {most}"));
    }
    let bytes = largest.saturating_mul(size_of::<[f32; 6]>()) as u64;
    if bytes > limits.max_buffer_size {
        return Some(format!(
            "an object has {bytes} bytes; they take {}",
            limits.max_buffer_size
        ));
    }
    let flat = |i: &FlatInstance| !DETERMINANTS.contains(&determinant(&i.to_world).abs());
    instances.iter().position(flat).map(|i| {
        format!("instance {i} scales so much that its transform cannot be inverted in f32")
    })
}

/// Of the linear part of an affine map.
fn determinant([a, b, c]: &[[f32; 4]; 3]) -> f32 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The geometry of one structure.
enum Geometry {
    Triangles {
        size: wgpu::BlasTriangleGeometrySizeDescriptor,
        positions: wgpu::Buffer,
        indices: wgpu::Buffer,
    },
    Boxes {
        size: wgpu::BlasAABBGeometrySizeDescriptor,
        boxes: wgpu::Buffer,
    },
}

/// A structure that waits to be built.
struct Pending {
    blas: wgpu::Blas,
    geometry: Geometry,
}

fn build(
    gpu: &Gpu,
    groups: &[FlatGroup<'_>],
    instances: &[FlatInstance],
) -> Result<Structures, GpuError> {
    let mut pending: Vec<Pending> = Vec::new();
    let mut waiting = 0;
    let mut structures: Vec<Vec<wgpu::Blas>> = Vec::new();
    for group in groups {
        let made: Vec<Pending> = [triangles(gpu, group)?, boxes(gpu, group)?]
            .into_iter()
            .flatten()
            .collect();
        structures.push(made.iter().map(|p| p.blas.clone()).collect());
        pending.extend(made);
        waiting += group.triangles.len() + group.boxes.len();
        if waiting >= BATCH {
            submit(gpu, &std::mem::take(&mut pending), None);
            waiting = 0;
        }
    }
    submit(gpu, &pending, None);
    let placed: Vec<wgpu::TlasInstance> = (0..)
        .zip(instances)
        .flat_map(|(index, instance)| {
            let of_group = &structures[instance.group as usize];
            of_group.iter().map(move |blas| {
                let mut rows = [0.0; 12];
                rows.copy_from_slice(instance.to_world.as_flattened());
                wgpu::TlasInstance::new(blas, rows, index, 0xff)
            })
        })
        .collect();
    let mut tlas = gpu.device.create_tlas(&wgpu::CreateTlasDescriptor {
        label: Some("scene"),
        max_instances: u32::try_from(placed.len().max(1)).unwrap_or(u32::MAX),
        flags: wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE,
        update_mode: wgpu::AccelerationStructureUpdateMode::Build,
    });
    for (place, instance) in placed.into_iter().enumerate() {
        tlas[place] = Some(instance);
    }
    submit(gpu, &[], Some(&tlas));
    Ok(bound(gpu, &tlas))
}

/// The group of triangles as a structure; `None` where there are none.
fn triangles(gpu: &Gpu, group: &FlatGroup<'_>) -> Result<Option<Pending>, GpuError> {
    if group.triangles.is_empty() {
        return Ok(None);
    }
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let size = wgpu::BlasTriangleGeometrySizeDescriptor {
        vertex_format: wgpu::VertexFormat::Float32x3,
        vertex_count: count(group.positions.len()),
        index_format: Some(wgpu::IndexFormat::Uint32),
        index_count: Some(count(3 * group.triangles.len())),
        flags: wgpu::AccelerationStructureGeometryFlags::OPAQUE,
    };
    let descriptors = vec![size.clone()];
    let blas = create(
        gpu,
        wgpu::BlasGeometrySizeDescriptors::Triangles { descriptors },
    );
    let geometry = Geometry::Triangles {
        size,
        positions: input(gpu, bytemuck::cast_slice(group.positions))?,
        indices: input(gpu, bytemuck::cast_slice(&group.triangles))?,
    };
    Ok(Some(Pending { blas, geometry }))
}

/// The group of spheres and disks as a structure; `None` where there are none.
fn boxes(gpu: &Gpu, group: &FlatGroup<'_>) -> Result<Option<Pending>, GpuError> {
    if group.boxes.is_empty() {
        return Ok(None);
    }
    let size = wgpu::BlasAABBGeometrySizeDescriptor {
        primitive_count: u32::try_from(group.boxes.len()).unwrap_or(u32::MAX),
        flags: wgpu::AccelerationStructureGeometryFlags::OPAQUE,
    };
    let descriptors = vec![size.clone()];
    let blas = create(
        gpu,
        wgpu::BlasGeometrySizeDescriptors::AABBs { descriptors },
    );
    let corners: Vec<[[f32; 3]; 2]> = group.boxes.iter().map(|b| [b.min, b.max]).collect();
    let geometry = Geometry::Boxes {
        size,
        boxes: input(gpu, bytemuck::cast_slice(&corners))?,
    };
    Ok(Some(Pending { blas, geometry }))
}

fn create(gpu: &Gpu, sizes: wgpu::BlasGeometrySizeDescriptors) -> wgpu::Blas {
    let descriptor = wgpu::CreateBlasDescriptor {
        label: Some("object"),
        flags: wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE,
        update_mode: wgpu::AccelerationStructureUpdateMode::Build,
    };
    gpu.device.create_blas(&descriptor, sizes)
}

fn input(gpu: &Gpu, contents: &[u8]) -> Result<wgpu::Buffer, GpuError> {
    filled(gpu, "object", contents, wgpu::BufferUsages::BLAS_INPUT)
}

/// Submits the build of structures.
fn submit(gpu: &Gpu, pending: &[Pending], tlas: Option<&wgpu::Tlas>) {
    let entries: Vec<wgpu::BlasBuildEntry<'_>> = pending.iter().map(Pending::entry).collect();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.build_acceleration_structures(&entries, tlas);
    gpu.queue.submit([encoder.finish()]);
}

impl Pending {
    fn entry(&self) -> wgpu::BlasBuildEntry<'_> {
        let geometry = match &self.geometry {
            Geometry::Triangles {
                size,
                positions,
                indices,
            } => wgpu::BlasGeometries::TriangleGeometries(vec![wgpu::BlasTriangleGeometry {
                size,
                vertex_buffer: positions,
                first_vertex: 0,
                vertex_stride: size_of::<[f32; 3]>() as u64,
                index_buffer: Some(indices),
                first_index: Some(0),
                transform_buffer: None,
                transform_buffer_offset: None,
            }]),
            Geometry::Boxes { size, boxes } => {
                wgpu::BlasGeometries::AabbGeometries(vec![wgpu::BlasAabbGeometry {
                    size,
                    stride: size_of::<[f32; 6]>() as u64,
                    aabb_buffer: boxes,
                    primitive_offset: 0,
                }])
            }
        };
        wgpu::BlasBuildEntry {
            blas: &self.blas,
            geometry,
        }
    }
}

fn bound(gpu: &Gpu, tlas: &wgpu::Tlas) -> Structures {
    let layout = gpu
        .device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("ray queries"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::AccelerationStructure {
                    vertex_return: false,
                },
                count: None,
            }],
        });
    // The bind group owns the structure, and that its parts.
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("ray queries"),
        layout: &layout,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: tlas.as_binding(),
        }],
    });
    Structures {
        bindings: RayBindings { layout, group },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    fn limits() -> wgpu::Limits {
        wgpu::Limits {
            max_blas_primitive_count: 8,
            max_tlas_instance_count: 4,
            ..wgpu::Limits::default()
        }
    }

    fn scaled(by: f32) -> FlatInstance {
        let row = |axis: usize| std::array::from_fn(|i| if i == axis { by } else { 0.0 });
        FlatInstance {
            group: 0,
            to_world: [row(0), row(1), row(2)],
        }
    }

    fn group(triangles: usize, boxes: usize) -> FlatGroup<'static> {
        let bounds = specula_render::accel::Bounds {
            min: [-1.0; 3],
            max: [1.0; 3],
        };
        FlatGroup {
            positions: &TRIANGLE,
            triangles: vec![[0, 1, 2]; triangles],
            boxes: vec![bounds; boxes],
        }
    }

    #[test]
    fn what_is_beyond_a_devices_limits_is_named() {
        let reason = |group, instances: &[FlatInstance]| beyond(&limits(), &[group], instances);
        let one = [scaled(1.0)];
        assert_eq!(reason(group(8, 8), &one), None);
        assert_eq!(reason(group(0, 0), &one), None);
        assert_eq!(reason(group(1, 0), &[scaled(1.0); 4]), None);
        let too_many = [
            (group(9, 0), 1, "9 triangles"),
            (group(0, 9), 1, "they take 8"),
            (group(1, 0), 5, "5 instances"),
            // Two structures each.
            (group(1, 1), 3, "6 instances"),
        ];
        for (group, count, expected) in too_many {
            let said = reason(group, &vec![scaled(1.0); count]).unwrap();
            assert!(said.contains(expected), "{said}");
        }
        for by in [1e-12, 1e12] {
            let said = reason(group(1, 0), &[scaled(1.0), scaled(by)]).unwrap();
            assert!(said.contains("instance 1 scales"), "{said}");
        }
        let small = wgpu::Limits {
            max_buffer_size: 64,
            ..limits()
        };
        assert!(beyond(&small, &[group(8, 0)], &one).is_some());
        // What devices without ray queries say.
        assert!(beyond(&wgpu::Limits::default(), &[group(1, 0)], &one).is_some());
    }

    #[test]
    fn choices_are_read_and_written() {
        for rays in [Rays::Auto, Rays::Tree, Rays::Query] {
            assert_eq!(rays.to_string().parse(), Ok(rays));
        }
        assert!("none".parse::<Rays>().is_err());
    }
}
