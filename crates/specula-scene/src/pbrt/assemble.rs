//! From directives to a scene: materials, meshes, shapes, objects.

use std::collections::{HashMap, HashSet};

use glam::DMat4;
use specula_bsdf::Rgb;

use super::context::{Context, Entity};
use super::directive::{InstanceEntity, MaterialEntity, Reader};
use super::geometry::{self, Meshes, ShapeGeometry};
use super::medium::{self, Sides};
use super::motion::Exposure;
use super::shape::{self, ShapeEntity};
use super::state::MaterialUse;
use super::{camera, light, material};
use crate::bounds::{self, BoundingBox, FARTHEST};
use crate::error::{ErrorKind, Place, SceneError, Warning};
use crate::mesh;
use crate::num::shorten;
use crate::pressed::{Press, Pressed};
use crate::problems::{NoteKind, is_dark};
use crate::scene::{
    Bump, ColourParam, Emission, FloatParam, Geometry, Light, Material, MaterialId, MaterialKind,
    MeshId, Object, ObjectId, ObjectInstance, Scene, Shape, TextureId,
};
use crate::transform::is_invertible;
use crate::{Format, Loaded};

/// What a warning says of a scene without a camera.
const NO_CAMERA: &str = "the scene has no `Camera`: pbrt-v4's own is used, at the origin of the \
                         world, along +z, with a field of view of 90 degrees";

/// Builds the scene.
pub(super) fn assemble(reader: Reader) -> Result<Loaded, SceneError> {
    let Reader {
        mut context,
        options,
        camera_to_world,
        times,
        named_materials,
        end,
        ..
    } = reader;
    let (camera, film, settings, exposure) =
        camera::read(&mut context, &options, camera_to_world, times)?;
    if !options.contains_key("Camera") && !context.problems.has_errors() {
        context.warn(&end, NO_CAMERA);
    }
    let in_objects = reader.objects.iter().flat_map(|o| &o.shapes);
    let all: Vec<&ShapeEntity> = in_objects.chain(&reader.shapes).collect();
    let mut materials = read_materials(&mut context, &reader.materials, &named_materials, &all)?;
    let integrator = options.get("Integrator");
    materials.media = medium::read_all(
        &mut context,
        &reader.media,
        reader.camera_medium,
        integrator,
    )?;
    let is_hair = |shape: &ShapeEntity| materials.is_hair(&shape.material);
    let (geometries, mut meshes) = geometry::read(&mut context, &all, is_hair)?;
    let lights = read_lights(&mut context, &reader.lights)?;
    let mut builder = Builder {
        press: Press::new(context.files.limits()),
        context,
        materials: &mut materials,
        meshes: &mut meshes,
        exposure,
    };
    let mut geometries = geometries.into_iter();
    let objects = (reader.objects.iter())
        .map(|object| {
            let shapes = builder.shapes(&object.shapes, &mut geometries)?;
            let name = object.name.clone();
            Ok(Object { name, shapes })
        })
        .collect::<Result<Vec<_>, SceneError>>()?;
    let mut shapes = builder.shapes(&reader.shapes, &mut geometries)?;
    let (instances, pressed) = builder.instances(&reader.instances, &objects)?;
    shapes.extend(pressed);
    let mut context = builder.context;

    let problems = context.problems.clone();
    if shapes.is_empty() && instances.is_empty() && !problems.has_errors() {
        let error = nothing_left(&context, &end);
        problems.record_warnings(&mut context.warnings);
        return Err(error);
    }
    if !problems.has_errors() {
        context.note_unused_textures();
    }
    let scene = Scene {
        images: std::mem::take(&mut context.images),
        textures: std::mem::take(&mut context.textures),
        materials: materials.list,
        measured: std::mem::take(&mut context.measured),
        meshes: meshes.triangles,
        patch_meshes: meshes.patches,
        curve_meshes: meshes.curves,
        shapes,
        objects,
        instances,
        lights,
        ..Scene::empty(camera, film, settings)
    };
    // What stands in for mistakes need not make a scene.
    if !problems.has_errors() {
        scene.each_fault(|fault| {
            problems.record(SceneError::new(ErrorKind::Limit, &end, fault.to_string()))
        })?;
    }
    if scene.lights.is_empty() && scene.shapes.iter().all(|s| s.emission.is_none()) {
        let message = "the scene has no light: the picture will be black";
        context.warnings.push(Warning::new(&end, message));
    }
    let files = &context.files;
    Ok(Loaded::new(Format::Pbrt, scene, context.warnings, files))
}

fn read_lights(
    context: &mut Context,
    entities: &[(Entity, DMat4)],
) -> Result<Vec<Light>, SceneError> {
    let mut lights = Vec::with_capacity(entities.len());
    for (entity, to_world) in entities {
        let read = light::read(context, entity, *to_world).map(Some);
        let Some(light) = entity.or(read, || None)? else {
            continue;
        };
        note_dark(context, entity, is_dark(&light, &context.images));
        lights.push(light);
        context.warn_unused(&entity.params);
    }
    Ok(lights)
}

/// Notes a light without power.
fn note_dark(context: &Context, entity: &Entity, is_dark: bool) {
    if is_dark {
        context.problems.note(NoteKind::Dark, &entity.place, || {
            format!("this light \"{}\" has no power", shorten(&entity.name))
        });
    }
}

fn place_instances<'a>(
    context: &mut Context,
    exposure: &Exposure,
    entities: &'a [InstanceEntity],
    objects: &[Object],
) -> Result<Vec<(ObjectInstance, &'a Place)>, SceneError> {
    let ids: HashMap<&str, usize> = objects
        .iter()
        .enumerate()
        .map(|(i, o)| (o.name.as_str(), i))
        .collect();
    let mut instances = Vec::with_capacity(entities.len());
    for instance in entities {
        let Some(&i) = ids.get(instance.name.as_str()) else {
            let message = format!("no object \"{}\" is defined", shorten(&instance.name));
            let error = SceneError::new(ErrorKind::UnknownName, &instance.place, message);
            context.problems.record(error)?;
            continue;
        };
        if objects[i].shapes.is_empty() && context.problems.has_errors() {
            // Its shapes may have mistakes.
        } else if objects[i].shapes.is_empty() {
            let message = "the object has no shapes: the instance is left out";
            context.warn(&instance.place, message);
        } else {
            let InstanceEntity {
                place,
                to_world,
                end,
                ..
            } = instance;
            let (to_world, motion) = exposure.place(context, ("instance", place), *to_world, *end);
            let placed = ObjectInstance {
                object: ObjectId(i),
                to_world,
                motion,
            };
            instances.push((placed, place));
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
    /// Copies with a height, by the texture of the height.
    displaced: HashMap<(MaterialId, TextureId), MaterialId>,
    /// Copies with other media on their sides.
    bounding: HashMap<(MaterialId, Sides), MaterialId>,
    /// Absorption of the file's media.
    media: Vec<Rgb<f32>>,
    /// Ids of the file's materials; those without name or use have none.
    ids: Vec<Option<MaterialId>>,
    default: Option<MaterialId>,
    named: HashMap<String, usize>,
    /// Opacities of the file's materials, which those of shapes override.
    opacities: Vec<Option<FloatParam>>,
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
    note_unused_names(context, entities, shapes);
    let mut list: Vec<Material> = Vec::new();
    let mut ids = Vec::new();
    let mut opacities = vec![None; entities.len()];
    let mut before: HashMap<&str, MaterialId> = HashMap::new();
    for (i, MaterialEntity { name, entity }) in entities.iter().enumerate() {
        if name.is_none() && !used.contains(&i) {
            context.problems.note(NoteKind::Unused, &entity.place, || {
                format!("no shape uses this material \"{}\"", shorten(&entity.name))
            });
            ids.push(None);
            continue;
        }
        let read = material::read(context, entity, &before);
        let material = entity.or(read, || Material::new(material::DEFAULT))?;
        if let MaterialKind::Mix { materials, .. } = material.kind
            && materials
                .iter()
                .any(|m| list[m.0].kind == MaterialKind::Interface)
        {
            let message = "an \"interface\" cannot be part of a \"mix\"";
            let error = SceneError::new(ErrorKind::Unsupported, &entity.place, message);
            context.problems.record(error)?;
        }
        let opacity = material::opacity(context, &entity.params);
        opacities[i] = entity.or(opacity, || None)?;
        let id = MaterialId(list.len());
        if let Some(name) = name {
            before.insert(name, id);
        }
        list.push(Material {
            name: name.clone(),
            ..material
        });
        ids.push(Some(id));
    }
    Ok(Materials {
        list,
        displaced: HashMap::new(),
        bounding: HashMap::new(),
        media: Vec::new(),
        ids,
        default: None,
        named: named.clone(),
        opacities,
    })
}

/// Notes named materials that neither shapes nor mixes refer to.
fn note_unused_names(context: &Context, entities: &[MaterialEntity], shapes: &[&ShapeEntity]) {
    if !context.problems.is_check() {
        return;
    }
    let mut used: HashSet<&str> = HashSet::new();
    for shape in shapes {
        if let MaterialUse::Named(name, _) = &shape.material {
            used.insert(name);
        }
    }
    for MaterialEntity { entity, .. } in entities {
        let parts = entity.params.texts("materials", "string").unwrap_or(&[]);
        used.extend(parts.iter().map(|(name, _)| name.as_str()));
    }
    for MaterialEntity { name, entity } in entities {
        if let Some(name) = name.as_ref().filter(|n| !used.contains(n.as_str())) {
            context.problems.note(NoteKind::Unused, &entity.place, || {
                format!("nothing uses the material \"{}\"", shorten(name))
            });
        }
    }
}

impl Materials {
    /// A copy of a material that is bumpy; its own bump map, if it has one, takes precedence.
    fn displaced(&mut self, material: MaterialId, height: FloatParam) -> MaterialId {
        let FloatParam::Texture(texture) = height else {
            return material;
        };
        let plain = &self.list[material.0];
        if plain.bump.is_some() || plain.kind == MaterialKind::Interface {
            return material;
        }
        *self
            .displaced
            .entry((material, texture))
            .or_insert_with(|| {
                let bumpy = Material {
                    bump: Some(Bump::Height(height)),
                    ..self.list[material.0].clone()
                };
                self.list.push(bumpy);
                MaterialId(self.list.len() - 1)
            })
    }

    /// A copy of a material that bounds media.
    fn bounding(&mut self, material: MaterialId, sides: Sides) -> MaterialId {
        let absorbs = self.media.iter().any(|a| !a.is_black());
        let passes = medium::lets_pass(&self.list[material.0].kind);
        // As in pbrt-v4, the same medium on both sides is no boundary.
        if sides[0] == sides[1] || !absorbs || !passes {
            return material;
        }
        *self.bounding.entry((material, sides)).or_insert_with(|| {
            let [inside, around] = sides.map(|s| s.map_or(Rgb::BLACK, |i| self.media[i]));
            let copy = Material {
                absorption: inside,
                around: Some(around),
                ..self.list[material.0].clone()
            };
            self.list.push(copy);
            MaterialId(self.list.len() - 1)
        })
    }

    /// Whether a shape's material is hair, or a mix with hair in it.
    fn is_hair(&self, wanted: &MaterialUse) -> bool {
        let index = match wanted {
            MaterialUse::Defined(i) => Some(*i),
            MaterialUse::Named(name, _) => self.named.get(name).copied(),
            MaterialUse::Default => None,
        };
        let id = index.and_then(|i| self.ids[i]);
        id.is_some_and(|id| self.list[id.0].holds_hair(&self.list))
    }

    /// The opacity that a material gives its shapes.
    fn opacity(&self, wanted: &MaterialUse) -> Option<FloatParam> {
        let index = match wanted {
            MaterialUse::Defined(i) => Some(*i),
            MaterialUse::Named(name, _) => self.named.get(name).copied(),
            MaterialUse::Default => None,
        };
        index.and_then(|i| self.opacities[i])
    }

    fn id(&mut self, wanted: &MaterialUse) -> Result<MaterialId, SceneError> {
        let index = match wanted {
            MaterialUse::Defined(i) => Some(*i),
            MaterialUse::Named(name, _) => self.named.get(name).copied(),
            MaterialUse::Default => {
                let list = &mut self.list;
                return Ok(*self.default.get_or_insert_with(|| {
                    list.push(Material::new(material::DEFAULT));
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

struct Builder<'a> {
    context: Context,
    materials: &'a mut Materials,
    meshes: &'a mut Meshes,
    press: Press,
    exposure: Exposure,
}

impl Builder<'_> {
    /// Shapes, without those that are left out.
    fn shapes(
        &mut self,
        entities: &[ShapeEntity],
        geometries: &mut impl Iterator<Item = ShapeGeometry>,
    ) -> Result<Vec<Shape>, SceneError> {
        let mut shapes = Vec::with_capacity(entities.len());
        for (shape, geometry) in entities.iter().zip(geometries) {
            let built = self.shape(shape, &geometry);
            shapes.extend(shape.entity.or(built, Vec::new)?);
        }
        Ok(shapes)
    }

    /// What a shape of the file is: two where its mesh has triangles and patches, none where it is left out.
    fn shape(
        &mut self,
        shape: &ShapeEntity,
        read: &ShapeGeometry,
    ) -> Result<Vec<Shape>, SceneError> {
        // Its other faults count even where it is left out.
        let found = self.materials.id(&shape.material).map(Some);
        let mut material = match self.context.problems.or(found, || None)? {
            Some(id) => id,
            None => self.materials.id(&MaterialUse::Default)?,
        };
        if let Some(height) = shape::displacement(&mut self.context, &shape.entity)? {
            material = self.materials.displaced(material, height);
        }
        material = self.materials.bounding(material, shape.media);
        let alpha = self
            .context
            .float_from_zero_or_none(&shape.entity.params, "alpha")?
            .or(self.materials.opacity(&shape.material))
            .unwrap_or(FloatParam::Value(1.0));
        let geometries = [read.geometry, read.beside].into_iter().flatten();
        let geometries: Vec<Geometry> = geometries.collect();
        if geometries.is_empty() {
            return Ok(Vec::new());
        }
        self.context.warn_unused(&shape.entity.params);
        let place = &shape.entity.place;
        let (to_world, motion) = self.exposure.place(
            &mut self.context,
            ("shape", place),
            shape.to_world,
            shape.end,
        );
        let (triangles, exact) = self.meshes.split();
        let reach = (geometries.iter())
            .map(|g| bounds::of_geometry(triangles, exact, g))
            .fold(BoundingBox::EMPTY, BoundingBox::union);
        let reach = reach.placed(&to_world, motion.as_ref());
        if reach.farthest() > FARTHEST {
            let message = format!("the shape reaches beyond {FARTHEST:e} from the origin");
            return Err(SceneError::new(ErrorKind::Limit, place, message));
        }
        if reach.is_speck() && is_invertible(&to_world) {
            self.context.warn(place, bounds::SPECK);
            return Ok(Vec::new());
        }
        let mut emission = None;
        if let Some(entity) = &shape.area_light {
            if self.materials.list[material.0].kind == MaterialKind::Interface {
                let message = "an \"interface\" emits nothing, as in pbrt-v4";
                self.context.warn(place, message);
            } else {
                emission = self.emission(entity, shape, read.pieces, &geometries)?;
            }
        }
        let made = geometries.into_iter().map(|geometry| Shape {
            geometry,
            to_world,
            motion,
            material,
            emission,
            // What is within a fibre does not depend on it.
            reverse_orientation: shape.reverse_orientation && !self.is_fibre(&geometry),
            alpha,
        });
        let made: Vec<Shape> = made.collect();
        if is_invertible(&to_world) {
            return Ok(made);
        }
        let mut flat = Vec::new();
        for shape in &made {
            flat.extend(self.pressed(shape, &to_world, place)?);
        }
        Ok(flat)
    }

    fn is_fibre(&self, geometry: &Geometry) -> bool {
        matches!(geometry, Geometry::Curves(id) if self.meshes.curves[id.0].is_fibre)
    }

    /// A shape under a transform that cannot be inverted, if area is left of it.
    fn pressed(
        &mut self,
        shape: &Shape,
        to_world: &DMat4,
        place: &Place,
    ) -> Result<Option<Shape>, SceneError> {
        let (triangles, exact) = self.meshes.split();
        let pressed = self.press.shape(shape, to_world, triangles, exact);
        let pressed = pressed.map_err(|m| SceneError::new(ErrorKind::Limit, place, m))?;
        self.context.warn(place, pressed.message());
        Ok(match pressed {
            Pressed::Flat(shape) => Some(*shape),
            Pressed::Nothing => None,
        })
    }

    /// Instances, and the shapes of those that are pressed flat.
    fn instances(
        &mut self,
        entities: &[InstanceEntity],
        objects: &[Object],
    ) -> Result<(Vec<ObjectInstance>, Vec<Shape>), SceneError> {
        let (mut instances, mut shapes) = (Vec::new(), Vec::new());
        for (instance, place) in
            place_instances(&mut self.context, &self.exposure, entities, objects)?
        {
            if is_invertible(&instance.to_world) {
                instances.push(instance);
                continue;
            }
            for shape in &objects[instance.object.0].shapes {
                // At its start.
                let to_world = instance.to_world * shape.to_world;
                shapes.extend(self.pressed(shape, &to_world, place)?);
            }
        }
        Ok((instances, shapes))
    }

    /// The light of a shape.
    ///
    /// * `pieces`: as of [`ShapeGeometry`].
    fn emission(
        &mut self,
        entity: &Entity,
        shape: &ShapeEntity,
        pieces: Option<usize>,
        geometries: &[Geometry],
    ) -> Result<Option<Emission>, SceneError> {
        let areas = geometries.iter().map(|g| self.area(g, shape));
        let area = areas.sum::<Result<f64, SceneError>>()?;
        let triangles = |id: MeshId| self.meshes.triangles[id.0].triangles.len();
        let pieces_of = |geometry: &Geometry| match *geometry {
            Geometry::Mesh(id) => pieces.unwrap_or_else(|| triangles(id)),
            Geometry::Patches(id) => self.meshes.patches[id.0].patches.len(),
            Geometry::Curves(id) => self.meshes.curves[id.0].segments.len(),
            Geometry::Sphere { .. } | Geometry::Disk { .. } | Geometry::QuadricPart(_) => 1,
        };
        let pieces = geometries.iter().map(pieces_of).sum();
        let read = light::area(&mut self.context, entity, area, pieces).map(Some);
        let emission = entity.or(read, || None)?;
        let is_dark = emission.is_some_and(|e| e.radiance == ColourParam::Value(Rgb::BLACK));
        note_dark(&self.context, entity, is_dark);
        Ok(emission)
    }

    /// Area of a shape that emits; quadrics before their transform, as pbrt-v4 takes it. Patches and curves that emit
    /// become triangles.
    fn area(&self, geometry: &Geometry, shape: &ShapeEntity) -> Result<f64, SceneError> {
        use std::f64::consts::PI;
        let limits = self.context.files.limits();
        let bounded = |triangles: u64| {
            shape::bounded((), triangles, limits)
                .map_err(|m| SceneError::new(ErrorKind::Mesh, &shape.entity.place, m))
        };
        Ok(match *geometry {
            Geometry::Mesh(id) => mesh::area(&self.meshes.triangles[id.0], &shape.to_world),
            Geometry::Patches(id) => {
                let patches = &self.meshes.patches[id.0];
                bounded(patches.triangle_count())?;
                mesh::area(&patches.mesh(), &shape.to_world)
            }
            Geometry::Curves(id) => {
                let curves = &self.meshes.curves[id.0];
                bounded(curves.triangle_count())?;
                mesh::area(&curves.mesh(), &shape.to_world)
            }
            Geometry::Sphere { radius } => 4.0 * PI * f64::from(radius).powi(2),
            Geometry::Disk { radius, .. } => PI * f64::from(radius).powi(2),
            Geometry::QuadricPart(part) => part.area(),
        })
    }
}
