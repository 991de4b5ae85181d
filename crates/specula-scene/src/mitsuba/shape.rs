//! `<shape>`: geometry with its material and emission, groups and instances.

use std::collections::HashMap;
use std::rc::Rc;

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;

use super::bsdf::{Surface, grey};
use super::context::Context;
use super::element::Element;
use super::geometry::{BuiltGeometry, Format, MeshSource, Meshes};
use super::hair;
use super::primitive;
use super::texture::{Frame, unknown};
use crate::curves::CurveBasis;
use crate::error::{ErrorKind, Place, SceneError};
use crate::num::f32_of;
use crate::problems::NoteKind;
use crate::scene::{
    ColourParam, Emission, FloatParam, Geometry, Material, MaterialKind, ObjectId, ObjectInstance,
    QuadricPart, Shape,
};

/// A shape before meshes are read.
pub(super) struct PendingShape {
    geometry: PendingGeometry,
    to_world: DMat4,
    surface: Surface,
    emission: Option<Emission>,
    flip: bool,
    pub(super) place: Place,
}

#[derive(Clone, Copy)]
enum PendingGeometry {
    Ready(Geometry),
    Mesh(usize),
}

/// A shape's geometry and place.
struct PlacedGeometry {
    geometry: PendingGeometry,
    to_world: DMat4,
    flip: bool,
    frame: Frame,
}

/// All shapes of a scene.
#[derive(Default)]
pub(super) struct Shapes {
    pub(super) meshes: Meshes,
    pub(super) world: Vec<PendingShape>,
    pub(super) objects: Vec<(String, Vec<PendingShape>)>,
    pub(super) instances: Vec<(ObjectInstance, Place)>,
    object_ids: HashMap<usize, ObjectId>,
    surfaces: HashMap<(usize, Frame), Surface>,
    /// Materials of shapes that have none: without light, and with light.
    defaults: [Option<Surface>; 2],
}

impl Shapes {
    /// Adds a shape of the scene.
    pub(super) fn add(
        &mut self,
        context: &mut Context,
        element: &Rc<Element>,
    ) -> Result<(), SceneError> {
        match element.plugin.as_str() {
            "shapegroup" => self.object(context, element).map(|_| ()),
            "instance" | "animatedinstance" => self.instance(context, element),
            _ => {
                let mut found = Vec::new();
                self.gather(context, element, &mut found)?;
                self.world.append(&mut found);
                Ok(())
            }
        }
    }

    fn object(
        &mut self,
        context: &mut Context,
        element: &Rc<Element>,
    ) -> Result<ObjectId, SceneError> {
        let key = Rc::as_ptr(element) as usize;
        if let Some(id) = self.object_ids.get(&key) {
            return Ok(*id);
        }
        let mut found = Vec::new();
        for child in context.children(element, "shape")? {
            self.gather(context, &child, &mut found)?;
        }
        let id = ObjectId(self.objects.len());
        let name = element.id.clone().unwrap_or_default();
        self.objects.push((name, found));
        self.object_ids.insert(key, id);
        Ok(id)
    }

    fn instance(&mut self, context: &mut Context, element: &Rc<Element>) -> Result<(), SceneError> {
        let group = context
            .child(element, "shape")?
            .filter(|g| g.plugin == "shapegroup")
            .ok_or_else(|| element.error("shape \"instance\" needs a \"shapegroup\" within it"))?;
        let object = context.deeper(element, |context| self.object(context, &group))?;
        if element.plugin == "animatedinstance" {
            let message = "\"animatedinstance\" stands still here";
            element.properties.iter().for_each(|p| p.used.set(true));
            context.warn(&element.place, message);
        }
        let instance = ObjectInstance {
            object,
            to_world: transform(element)?,
            motion: None,
        };
        self.instances.push((instance, element.place.clone()));
        Ok(())
    }

    /// Adds one shape, or those within `merge`.
    fn gather(
        &mut self,
        context: &mut Context,
        element: &Rc<Element>,
        found: &mut Vec<PendingShape>,
    ) -> Result<(), SceneError> {
        if element.plugin == "merge" {
            for child in context.children(element, "shape")? {
                context.deeper(element, |context| self.gather(context, &child, found))?;
            }
            return Ok(());
        }
        let Some(PlacedGeometry {
            geometry,
            to_world,
            flip,
            frame,
        }) = self.placed(context, element)?
        else {
            return Ok(());
        };
        crate::transform::check_finite(&to_world)
            .map_err(|m| SceneError::new(ErrorKind::Transform, &element.place_of("to_world"), m))?;
        element.ignore(&["silhouette_sampling_weight", "collapse", "srgb"]);
        subsurface(context, element)?;
        let emission = match context.child(element, "emitter")? {
            Some(emitter) => {
                context.frame = frame;
                let read = context.emission(&emitter).map(Some);
                context.frame = Frame::Mesh;
                let emission = emitter.or(read, || None)?;
                let black = ColourParam::Value(Rgb::BLACK);
                // A beam has its own warning.
                let is_beam = emitter.plugin == "directionalarea";
                if emission.is_some_and(|e| e.radiance == black) && !is_beam {
                    context.problems.note(NoteKind::Dark, &emitter.place, || {
                        format!("this {} has no power", emitter.title())
                    });
                }
                emission
            }
            None => None,
        };
        let surface = self.surface(context, element, frame, emission.is_some())?;
        let surface = context.bounded(element, surface)?;
        let is_interface = context.materials[surface.material.0].kind == MaterialKind::Interface;
        if emission.is_some() && is_interface {
            let message = "a shape without surface emits nothing here";
            context.warn(&element.place, message);
        }
        found.push(PendingShape {
            geometry,
            to_world,
            surface,
            emission: emission.filter(|_| !is_interface),
            flip,
            place: element.place.clone(),
        });
        Ok(())
    }

    /// Geometry and place of a shape; `None` where it is left out.
    fn placed(
        &mut self,
        context: &mut Context,
        element: &Rc<Element>,
    ) -> Result<Option<PlacedGeometry>, SceneError> {
        let mut to_world = transform(element)?;
        let mirrored = to_world.determinant() < 0.0;
        let mut flip = element.boolean("flip_normals", false)?;
        let mut frame = Frame::Mesh;
        let is_hair = hair::is_of_hair(context, element)?;
        if is_hair && element.plugin != "bsplinecurve" {
            context.warn(&element.place, hair::NO_FIBRE);
        }
        let geometry = match element.plugin.as_str() {
            "sphere" => {
                let centre = element.vector("center")?.unwrap_or(DVec3::ZERO);
                let radius = f32_of(element.above_zero("radius", 1.0)?);
                to_world *= DMat4::from_translation(centre);
                // A mirrored sphere of Mitsuba's is inside out.
                flip ^= mirrored;
                frame = Frame::Sphere;
                if !is_similarity(&to_world) {
                    let message = "Mitsuba does not scale spheres differently along their axes";
                    context.warn(&element.place, message);
                }
                PendingGeometry::Ready(Geometry::Sphere { radius })
            }
            "disk" => {
                frame = Frame::Disk;
                PendingGeometry::Ready(Geometry::Disk {
                    radius: 1.0,
                    height: 0.0,
                })
            }
            "cylinder" => {
                let p0 = element.vector("p0")?.unwrap_or(DVec3::ZERO);
                let p1 = element.vector("p1")?.unwrap_or(DVec3::Z);
                let radius = element.above_zero("radius", 1.0)?;
                let place = primitive::cylinder_placement(p0, p1, radius)
                    .ok_or_else(|| element.error("\"p0\" and \"p1\" are the same point"))?;
                to_world *= place;
                PendingGeometry::Ready(Geometry::QuadricPart(QuadricPart::Cylinder {
                    radius: 1.0,
                    z: [0.0, 1.0],
                    phi_max: QuadricPart::TURN,
                }))
            }
            "rectangle" => {
                PendingGeometry::Mesh(self.meshes.ask(MeshSource::Rectangle, &element.place))
            }
            "cube" => PendingGeometry::Mesh(self.meshes.ask(MeshSource::Cube, &element.place)),
            "obj" | "ply" | "serialized" => {
                let (source, place) = file(context, element)?;
                PendingGeometry::Mesh(self.meshes.ask(source, &place))
            }
            "linearcurve" | "bsplinecurve" => {
                let (source, place) = curves(context, element, &to_world, is_hair)?;
                // Control points are moved there; radii stay as they are.
                to_world = DMat4::IDENTITY;
                // What is within a fibre does not depend on it.
                flip &= !is_hair;
                PendingGeometry::Mesh(self.meshes.ask(source, &place))
            }
            "shapegroup" | "instance" | "animatedinstance" => {
                let message = format!("{} cannot be part of a group", element.title());
                return Err(SceneError::new(
                    ErrorKind::Structure,
                    &element.place,
                    message,
                ));
            }
            "sdfgrid" | "ellipsoids" | "ellipsoidsmesh" | "hair" | "heightfield" | "deformable" => {
                let message = format!("{} is not supported: it is left out", element.title());
                element.properties.iter().for_each(|p| p.used.set(true));
                context.warn(&element.place, message);
                return Ok(None);
            }
            other => return Err(unknown("shape", other, &element.place)),
        };
        Ok(Some(PlacedGeometry {
            geometry,
            to_world,
            flip,
            frame,
        }))
    }

    fn surface(
        &mut self,
        context: &mut Context,
        element: &Element,
        frame: Frame,
        emits: bool,
    ) -> Result<Surface, SceneError> {
        let Some(bsdf) = context.child(element, "bsdf")? else {
            // Mitsuba's own default, which is black where there is light.
            let slot = &mut self.defaults[usize::from(emits)];
            return Ok(*slot.get_or_insert_with(|| Surface {
                material: context.add_material(Material {
                    one_sided: true,
                    ..Material::new(grey(if emits { 0.0 } else { 0.5 }))
                }),
                alpha: FloatParam::Value(1.0),
            }));
        };
        let key = (Rc::as_ptr(&bsdf) as usize, frame);
        if let Some(surface) = self.surfaces.get(&key) {
            return Ok(*surface);
        }
        context.frame = frame;
        let surface = context.surface(&bsdf);
        context.frame = Frame::Mesh;
        let surface = surface?;
        self.surfaces.insert(key, surface);
        Ok(surface)
    }
}

/// Shapes whose meshes are read.
pub(super) fn finish(pending: Vec<PendingShape>, ready: &[BuiltGeometry]) -> Vec<(Shape, Place)> {
    pending
        .into_iter()
        .filter_map(|p| {
            let (geometry, own_normals) = match p.geometry {
                PendingGeometry::Ready(geometry) => (geometry, false),
                PendingGeometry::Mesh(i) => (ready[i].geometry?, ready[i].own_normals),
            };
            // Normals of triangles turn over where the transform mirrors; in the scene they do not.
            let turned = own_normals && p.to_world.determinant() < 0.0;
            let shape = Shape {
                geometry,
                to_world: p.to_world,
                motion: None,
                material: p.surface.material,
                emission: p.emission,
                reverse_orientation: p.flip != turned,
                alpha: p.surface.alpha,
            };
            Some((shape, p.place))
        })
        .collect()
}

/// The curves of a file.
fn curves(
    context: &mut Context,
    element: &Element,
    to_world: &DMat4,
    is_hair: bool,
) -> Result<(MeshSource, Place), SceneError> {
    let (path, place) = context.needed_file(element, "filename")?;
    let source = MeshSource::Curves {
        path,
        basis: match element.plugin.as_str() {
            "linearcurve" => CurveBasis::Linear,
            _ => CurveBasis::Spline,
        },
        to_world: to_world.to_cols_array().map(f64::to_bits),
        is_hair,
    };
    Ok((source, place))
}

fn transform(element: &Element) -> Result<DMat4, SceneError> {
    let m = element.transform("to_world")?;
    crate::transform::check_finite(&m)
        .map_err(|e| SceneError::new(ErrorKind::Transform, &element.place_of("to_world"), e))?;
    Ok(m)
}

/// Whether a transform scales all directions alike.
fn is_similarity(m: &DMat4) -> bool {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|c| c.truncate());
    let size = x.length_squared();
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-4 * size;
    close(y.length_squared(), size)
        && close(z.length_squared(), size)
        && [x.dot(y), y.dot(z), z.dot(x)]
            .into_iter()
            .all(|d| close(d, 0.0))
}

fn file(context: &mut Context, element: &Element) -> Result<(MeshSource, Place), SceneError> {
    let (path, place) = context.needed_file(element, "filename")?;
    let is_obj = element.plugin == "obj";
    let format = match element.plugin.as_str() {
        "obj" => Format::Obj,
        "ply" => Format::Ply,
        _ => Format::Serialized(element.integer_within("shape_index", 0, 0..=u32::MAX)?),
    };
    if element.has("max_smooth_angle") {
        let place = element.place_of("max_smooth_angle");
        element.ignore(&["max_smooth_angle"]);
        context.warn(&place, "normals are not split at sharp edges");
    }
    let source = MeshSource::File {
        path,
        format,
        face_normals: element.boolean("face_normals", false)?,
        // Mitsuba flips the coordinates of OBJ files unless told otherwise.
        flip_v: element.boolean("flip_tex_coords", is_obj)?,
    };
    Ok((source, place))
}

/// Warns of volumes below a surface, which are not rendered.
fn subsurface(context: &mut Context, element: &Element) -> Result<(), SceneError> {
    if let Some(first) = context.children(element, "subsurface")?.first() {
        let message = format!("{} is not rendered", first.title());
        context.warn(&first.place, message);
    }
    Ok(())
}
