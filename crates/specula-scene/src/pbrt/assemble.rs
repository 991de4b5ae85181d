//! From what the directives said to a scene: materials, meshes, shapes, objects.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

use rayon::prelude::*;

use super::context::Context;
use super::directive::{InstanceEntity, MaterialEntity, Reader};
use super::shape::{Prepared, ShapeEntity, prepare};
use super::state::MaterialUse;
use super::token::shorten;
use super::{camera, light, material};
use crate::Loaded;
use crate::bounds::{self, FARTHEST};
use crate::error::{ErrorKind, Place, SceneError, Warning};
use crate::mesh::{self, Cleaning};
use crate::ply;
use crate::scene::{
    FloatParam, Geometry, Instance, Material, MaterialId, MaterialKind, Mesh, MeshId, Object,
    ObjectId, Scene, Shape,
};

/// Builds the scene.
pub(super) fn assemble(reader: Reader) -> Result<Loaded, SceneError> {
    let Reader {
        mut context,
        options,
        camera_to_world,
        named_materials,
        end,
        ..
    } = reader;
    let (camera, film, settings) = camera::read(&mut context, &options, camera_to_world)?;
    let all: Vec<&ShapeEntity> = reader
        .objects
        .iter()
        .flat_map(|o| &o.shapes)
        .chain(&reader.shapes)
        .collect();
    let mut materials = read_materials(&mut context, &reader.materials, &named_materials, &all)?;
    let (geometries, meshes) = read_geometry(&mut context, &all)?;

    let mut builder = Builder {
        context,
        materials: &mut materials,
        meshes: &meshes,
    };
    let mut geometries = geometries.into_iter();
    let mut objects = Vec::new();
    for object in &reader.objects {
        let shapes = builder.shapes(&object.shapes, &mut geometries)?;
        objects.push(Object {
            name: object.name.clone(),
            shapes,
        });
    }
    let shapes = builder.shapes(&reader.shapes, &mut geometries)?;
    let mut context = builder.context;

    let instances = place_instances(&mut context, &reader.instances, &objects)?;
    if shapes.is_empty() && instances.is_empty() {
        return Err(nothing_left(&context, &end));
    }
    let scene = Scene {
        camera,
        film,
        settings,
        images: std::mem::take(&mut context.images),
        textures: std::mem::take(&mut context.textures),
        materials: materials.list,
        meshes,
        shapes,
        objects,
        instances,
        lights: reader.lights,
    };
    scene
        .validate()
        .map_err(|e| SceneError::new(ErrorKind::Limit, &end, e.to_string()))?;
    if scene.lights.is_empty() && scene.shapes.iter().all(|s| s.emission.is_none()) {
        let message = "the scene has no light: the picture will be black";
        context.warnings.push(Warning::new(&end, message));
    }
    Ok(Loaded {
        scene,
        warnings: context.warnings,
    })
}

fn place_instances(
    context: &mut Context,
    entities: &[InstanceEntity],
    objects: &[Object],
) -> Result<Vec<Instance>, SceneError> {
    let ids: HashMap<&str, usize> = objects
        .iter()
        .enumerate()
        .map(|(i, o)| (o.name.as_str(), i))
        .collect();
    let mut instances = Vec::with_capacity(entities.len());
    for instance in entities {
        let Some(&i) = ids.get(instance.name.as_str()) else {
            let message = format!("no object \"{}\" is defined", shorten(&instance.name));
            return Err(SceneError::new(
                ErrorKind::UnknownName,
                &instance.place,
                message,
            ));
        };
        if objects[i].shapes.is_empty() {
            let message = "the object has no shapes: the instance is left out";
            context.warn(&instance.place, message);
        } else {
            instances.push(Instance {
                object: ObjectId(i),
                to_world: instance.to_world,
            });
        }
    }
    Ok(instances)
}

fn nothing_left(context: &Context, end: &Place) -> SceneError {
    let dropped = context
        .warnings
        .iter()
        .find(|w| w.message().contains("is left out"));
    match dropped {
        Some(warning) => {
            let message = format!("no shape is left to render: {}", warning.message());
            SceneError::new(ErrorKind::EmptyScene, warning.place(), message)
        }
        None => SceneError::new(ErrorKind::EmptyScene, end, "the scene has no shapes")
            .with_help("expected at least one `Shape` after `WorldBegin`"),
    }
}

struct Materials {
    list: Vec<Material>,
    /// Ids of the file's materials; those without name or use have none.
    ids: Vec<Option<MaterialId>>,
    default: Option<MaterialId>,
    named: HashMap<String, usize>,
}

fn read_materials(
    context: &mut Context,
    entities: &[MaterialEntity],
    named: &HashMap<String, usize>,
    shapes: &[&ShapeEntity],
) -> Result<Materials, SceneError> {
    let used: HashSet<usize> = shapes
        .iter()
        .filter_map(|s| {
            if let MaterialUse::Defined(i) = s.material {
                Some(i)
            } else {
                None
            }
        })
        .collect();
    let mut list: Vec<Material> = Vec::new();
    let mut ids = Vec::new();
    let mut before: HashMap<&str, MaterialId> = HashMap::new();
    for (i, MaterialEntity { name, entity }) in entities.iter().enumerate() {
        if name.is_none() && !used.contains(&i) {
            ids.push(None);
            continue;
        }
        let energy = material::energy(&entity.params)?;
        let kind = material::read(context, entity, &before)?;
        if let MaterialKind::Mix { materials, .. } = kind
            && materials
                .iter()
                .any(|m| list[m.0].kind == MaterialKind::Interface)
        {
            let message = "an \"interface\" cannot be part of a \"mix\"";
            return Err(SceneError::new(
                ErrorKind::Unsupported,
                &entity.place,
                message,
            ));
        }
        let id = MaterialId(list.len());
        if let Some(name) = name {
            before.insert(name, id);
        }
        list.push(Material {
            name: name.clone(),
            kind,
            energy,
        });
        ids.push(Some(id));
    }
    Ok(Materials {
        list,
        ids,
        default: None,
        named: named.clone(),
    })
}

impl Materials {
    fn id(&mut self, wanted: &MaterialUse) -> Result<MaterialId, SceneError> {
        let index = match wanted {
            MaterialUse::Defined(i) => Some(*i),
            MaterialUse::Named(name, _) => self.named.get(name).copied(),
            MaterialUse::Default => {
                let list = &mut self.list;
                return Ok(*self.default.get_or_insert_with(|| {
                    list.push(Material {
                        name: None,
                        kind: material::DEFAULT,
                        energy: None,
                    });
                    MaterialId(list.len() - 1)
                }));
            }
        };
        match (index.and_then(|i| self.ids[i]), wanted) {
            (Some(id), _) => Ok(id),
            (None, MaterialUse::Named(name, place)) => {
                let message = format!("no material \"{}\" is defined", shorten(name));
                Err(SceneError::new(ErrorKind::UnknownName, place, message))
            }
            (None, _) => self.id(&MaterialUse::Default),
        }
    }
}

/// Geometry of a shape, or `None` where it is left out.
type Kept = Option<Geometry>;

/// A mesh to be read or checked, and the first place that asks for it.
struct Job {
    source: Result<Mesh, PathBuf>,
    place: Place,
}

/// Reads and checks all meshes, in parallel; each file once.
fn read_geometry(
    context: &mut Context,
    shapes: &[&ShapeEntity],
) -> Result<(Vec<Kept>, Vec<Mesh>), SceneError> {
    enum Slot {
        Job(usize),
        Ready(Kept),
    }
    let mut jobs: Vec<Job> = Vec::new();
    let mut files: HashMap<PathBuf, usize> = HashMap::new();
    let mut slots = Vec::with_capacity(shapes.len());
    for shape in shapes {
        let entity = &shape.entity;
        slots.push(match prepare(context, entity)? {
            Prepared::Sphere { radius } => Slot::Ready(Some(Geometry::Sphere { radius })),
            Prepared::Disk { radius, height } => {
                Slot::Ready(Some(Geometry::Disk { radius, height }))
            }
            Prepared::LeftOut => Slot::Ready(None),
            Prepared::Mesh(mesh) => {
                jobs.push(Job {
                    source: Ok(mesh),
                    place: entity.place.clone(),
                });
                Slot::Job(jobs.len() - 1)
            }
            Prepared::File(path) => Slot::Job(*files.entry(path.clone()).or_insert_with(|| {
                let place = match entity.params.string("filename") {
                    Ok(Some((_, place))) => place.clone(),
                    _ => entity.place.clone(),
                };
                jobs.push(Job {
                    source: Err(path),
                    place,
                });
                jobs.len() - 1
            })),
        });
    }
    let places: Vec<Place> = jobs.iter().map(|j| j.place.clone()).collect();
    let read = |source: Result<Mesh, PathBuf>| -> Result<(Mesh, Cleaning), String> {
        match source {
            Ok(mut mesh) => mesh::clean(&mut mesh).map(|c| (mesh, c)),
            Err(path) => {
                let mut mesh = ply::read(&path)?;
                let cleaning =
                    mesh::clean(&mut mesh).map_err(|e| format!("mesh {}: {e}", path.display()))?;
                Ok((mesh, cleaning))
            }
        }
    };
    // The order of results is that of the jobs, whatever the threads do.
    let sources: Vec<_> = jobs.into_iter().map(|j| j.source).collect();
    let results: Vec<_> = sources.into_par_iter().map(read).collect();
    let mut meshes = Vec::new();
    let mut ids = Vec::new();
    for (result, place) in results.into_iter().zip(&places) {
        let (mesh, cleaning) = result.map_err(|m| SceneError::new(ErrorKind::Mesh, place, m))?;
        report(context, place, &cleaning, mesh.triangles.is_empty());
        ids.push((!mesh.triangles.is_empty()).then_some(Geometry::Mesh(MeshId(meshes.len()))));
        if !mesh.triangles.is_empty() {
            meshes.push(mesh);
        }
    }
    let kept = slots.into_iter().map(|slot| match slot {
        Slot::Job(i) => ids[i],
        Slot::Ready(kept) => kept,
    });
    Ok((kept.collect(), meshes))
}

fn report(context: &mut Context, place: &Place, cleaning: &Cleaning, empty: bool) {
    let Cleaning {
        dropped_triangles,
        replaced_normals,
        dropped_uvs,
    } = *cleaning;
    if empty {
        let message = if dropped_triangles > 0 {
            format!("all {dropped_triangles} triangles of the mesh have no area: it is left out")
        } else {
            "the mesh has no triangles: it is left out".to_owned()
        };
        context.warn(place, message);
        return;
    }
    if dropped_triangles > 0 {
        context.warn(
            place,
            format!("{dropped_triangles} triangles without area are dropped"),
        );
    }
    if replaced_normals > 0 {
        let message =
            format!("{replaced_normals} normals are zero or not finite: geometric ones are used");
        context.warn(place, message);
    }
    if dropped_uvs {
        context.warn(
            place,
            "surface coordinates are dropped: some are not finite",
        );
    }
}

struct Builder<'a> {
    context: Context,
    materials: &'a mut Materials,
    meshes: &'a [Mesh],
}

impl Builder<'_> {
    fn shapes(
        &mut self,
        entities: &[ShapeEntity],
        geometries: &mut impl Iterator<Item = Kept>,
    ) -> Result<Vec<Shape>, SceneError> {
        let mut shapes = Vec::with_capacity(entities.len());
        for (shape, geometry) in entities.iter().zip(geometries) {
            // Its other faults count even where it is left out.
            let material = self.materials.id(&shape.material)?;
            let alpha = self
                .context
                .float_from_zero_or_none(&shape.entity.params, "alpha")?
                .unwrap_or(FloatParam::Value(1.0));
            let Some(geometry) = geometry else { continue };
            self.context.warn_unused(&shape.entity.params);
            let place = &shape.entity.place;
            let reach = bounds::of_geometry(self.meshes, &geometry).transformed(&shape.to_world);
            if reach.farthest() > FARTHEST {
                let message = format!("the shape reaches beyond {FARTHEST:e} from the origin");
                return Err(SceneError::new(ErrorKind::Limit, place, message));
            }
            let mut emission = None;
            if let Some(entity) = &shape.area_light {
                if self.materials.list[material.0].kind == MaterialKind::Interface {
                    let message = "an \"interface\" emits nothing, as in pbrt-v4";
                    self.context.warn(place, message);
                } else {
                    let area = self.area(&geometry, shape);
                    emission = Some(light::area(&mut self.context, entity, area)?);
                }
            }
            shapes.push(Shape {
                geometry,
                to_world: shape.to_world,
                material,
                emission,
                reverse_orientation: shape.reverse_orientation,
                alpha,
            });
        }
        Ok(shapes)
    }

    /// Area of a shape; spheres and disks before their transform, as pbrt-v4 takes it.
    fn area(&self, geometry: &Geometry, shape: &ShapeEntity) -> f64 {
        use std::f64::consts::PI;
        match *geometry {
            Geometry::Mesh(id) => mesh::area(&self.meshes[id.0], &shape.to_world),
            Geometry::Sphere { radius } => 4.0 * PI * f64::from(radius).powi(2),
            Geometry::Disk { radius, .. } => PI * f64::from(radius).powi(2),
        }
    }
}
