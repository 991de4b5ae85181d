//! From a document to a scene.

use std::rc::Rc;

use super::context::Context;
use super::document::Document;
use super::element::Element;
use super::shape::{self, Shapes};
use super::texture::unknown;
use crate::bounds::{self, BoundingBox, FARTHEST};
use crate::error::{ErrorKind, Place, SceneError};
use crate::pressed::{Press, Pressed};
use crate::problems::{NoteKind, is_dark};
use crate::read_file::Files;
use crate::scene::{Camera, Film, Light, Mesh, Object, ObjectInstance, Scene, Settings, Shape};
use crate::transform::is_invertible;
use crate::triangulate::ExactMeshes;
use crate::{Energy, Format, Loaded, stage};

/// Warning about a scene without light.
const NO_LIGHT: &str = "the scene has no light: the picture will be black";

/// Builds the scene.
pub(super) fn assemble(document: Document, files: &Files) -> Result<Loaded, SceneError> {
    let (mut context, root) = Context::new(document, files);
    root.visited.set(true);
    context.look_for_media(&root)?;
    let mut parts = TopLevel::default();
    let problems = context.problems.clone();
    for property in &root.properties {
        if let Some(element) = context.plugin(property)? {
            property.used.set(true);
            let added = parts.add(&mut context, &element);
            problems.or(element.or(added, || ()), || ())?;
        }
    }
    let TopLevel {
        shapes,
        lights,
        sensor,
        integrator,
    } = parts;
    let max_depth = context.integrator(integrator.as_ref());
    let max_depth = problems.or(max_depth, || Settings::default().max_depth)?;
    if sensor.is_none() {
        // The one with a mistake may have been intended.
        problems.or(root.or(Err(no_sensor(&root)), || ()), || ())?;
    }
    let View {
        camera,
        film,
        samples_per_pixel,
    } = view(&mut context, sensor.as_ref())?;
    let built = build(&mut context, shapes)?;
    context.warn_unused(&root);
    if built.shapes.is_empty() && built.instances.is_empty() && !problems.has_errors() {
        let error = nothing_left(&context, &root.place);
        problems.record_warnings(&mut context.warnings);
        return Err(error);
    }
    if !problems.has_errors() {
        context.note_unused(&root);
    }
    let settings = Settings {
        max_depth,
        samples_per_pixel,
        hide_emitters: context.hide_emitters,
        energy: Energy::None,
    };
    let scene = Scene {
        images: std::mem::take(&mut context.images),
        textures: std::mem::take(&mut context.textures),
        materials: std::mem::take(&mut context.materials),
        measured: std::mem::take(&mut context.measured),
        meshes: built.meshes,
        shapes: built.shapes,
        objects: built.objects,
        instances: built.instances,
        lights,
        ..Scene::empty(camera, film, settings)
    };
    // What stands in for mistakes need not make a scene.
    if !problems.has_errors() {
        scene.each_fault(|fault| {
            let message = fault.to_string();
            problems.record(SceneError::new(ErrorKind::Limit, &root.place, message))
        })?;
    }
    let emits = |objects: &[Object]| {
        let mut shapes = scene
            .shapes
            .iter()
            .chain(objects.iter().flat_map(|o| &o.shapes));
        shapes.any(|s| s.emission.is_some())
    };
    if scene.lights.is_empty() && !emits(&scene.objects) {
        context.warn(&root.place, NO_LIGHT);
    }
    Ok(Loaded::new(Format::Mitsuba, scene, context.warnings, files))
}

fn no_sensor(root: &Element) -> SceneError {
    let message = "the scene has no <sensor>";
    SceneError::new(ErrorKind::Structure, &root.place, message)
        .with_help("expected one such as <sensor type=\"perspective\">")
}

/// Camera and film.
struct View {
    camera: Camera,
    film: Film,
    samples_per_pixel: u32,
}

fn view(context: &mut Context, sensor: Option<&Rc<Element>>) -> Result<View, SceneError> {
    let problems = context.problems.clone();
    let size = [768, 576];
    let Some(sensor) = sensor else {
        // The mistake is recorded already.
        return Ok(View {
            camera: stage::camera(BoundingBox::EMPTY, size),
            film: stage::film(size),
            samples_per_pixel: 1,
        });
    };
    let film = context.child(sensor, "film");
    let film = film.and_then(|film| context.film(film.as_ref()));
    let film = problems.or(film, || stage::film(size))?;
    let sampler = context.child(sensor, "sampler");
    let samples_per_pixel = sampler.and_then(|s| context.sampler(s.as_ref()));
    let camera = context.camera(sensor, film.resolution);
    Ok(View {
        samples_per_pixel: problems.or(samples_per_pixel, || 1)?,
        camera: sensor.or(camera, || {
            stage::camera(BoundingBox::EMPTY, film.resolution)
        })?,
        film,
    })
}

/// The plugins at the top level of a scene.
#[derive(Default)]
struct TopLevel {
    shapes: Shapes,
    lights: Vec<Light>,
    sensor: Option<Rc<Element>>,
    integrator: Option<Rc<Element>>,
}

impl TopLevel {
    fn add(&mut self, context: &mut Context, element: &Rc<Element>) -> Result<(), SceneError> {
        match element.class {
            "shape" => self.shapes.add(context, element)?,
            "emitter" => {
                let lights = context.lights(element)?;
                let is_dark = |l: &Light| is_dark(l, &context.images);
                if !lights.is_empty() && lights.iter().all(is_dark) {
                    context.problems.note(NoteKind::Dark, &element.place, || {
                        format!("this {} has no power", element.title())
                    });
                }
                self.lights.extend(lights);
            }
            "sensor" if self.sensor.is_none() => self.sensor = Some(Rc::clone(element)),
            "sensor" => context.warn(&element.place, "the first sensor is rendered, not this one"),
            "integrator" if self.integrator.is_none() => {
                self.integrator = Some(Rc::clone(element));
            }
            "integrator" => {
                let message = "the scene has more than one integrator";
                return Err(SceneError::new(
                    ErrorKind::Structure,
                    &element.place,
                    message,
                ));
            }
            // Named plugins that others refer to; those that no one refers to change nothing.
            "bsdf" | "texture" | "medium" | "volume" | "phase" | "sampler" | "film" | "rfilter" => {
            }
            class => return Err(unknown(class, &element.plugin, &element.place)),
        }
        Ok(())
    }
}

struct BuiltShapes {
    meshes: Vec<Mesh>,
    shapes: Vec<Shape>,
    objects: Vec<Object>,
    instances: Vec<ObjectInstance>,
}

fn build(context: &mut Context, shapes: Shapes) -> Result<BuiltShapes, SceneError> {
    let (ready, mut meshes) = shapes.meshes.read(context)?;
    let mut press = Press::new(context.limits);
    let mut finish = |context: &mut Context, pending| {
        let finished = shape::finish(pending, &ready);
        pressed(context, &mut press, &mut meshes, finished)
    };
    let mut finished = finish(context, shapes.world)?;
    let mut objects = Vec::new();
    for (name, pending) in shapes.objects {
        let shapes = finish(context, pending)?.into_iter().map(|s| s.0).collect();
        objects.push(Object { name, shapes });
    }
    for (shape, place) in &finished {
        let reach = bounds::of_geometry(&meshes, ExactMeshes::default(), &shape.geometry)
            .transformed(&shape.to_world);
        if reach.farthest() > FARTHEST {
            context.problems.record(too_far(place))?;
        }
    }
    let mut instances = Vec::new();
    for (instance, place) in shapes.instances {
        let is_empty = objects[instance.object.0].shapes.is_empty();
        if is_empty && context.problems.has_errors() {
            // Its shapes may have mistakes.
        } else if is_empty {
            context.warn(&place, "the group has no shapes: the instance is left out");
        } else {
            let is_flat = !is_invertible(&instance.to_world);
            if is_flat {
                let shapes = &objects[instance.object.0].shapes;
                let placed = |s: &Shape| Shape {
                    to_world: instance.to_world * s.to_world,
                    ..s.clone()
                };
                let placed = shapes.iter().map(|s| (placed(s), place.clone())).collect();
                finished.append(&mut pressed(context, &mut press, &mut meshes, placed)?);
            } else {
                instances.push(instance);
            }
        }
    }
    Ok(BuiltShapes {
        meshes,
        shapes: finished.into_iter().map(|s| s.0).collect(),
        objects,
        instances,
    })
}

/// Shapes, without those that their transforms press to nothing.
fn pressed(
    context: &mut Context,
    press: &mut Press,
    meshes: &mut Vec<Mesh>,
    shapes: Vec<(Shape, Place)>,
) -> Result<Vec<(Shape, Place)>, SceneError> {
    let mut left = Vec::with_capacity(shapes.len());
    for (shape, place) in shapes {
        if is_invertible(&shape.to_world) {
            let reach = bounds::of_geometry(meshes, ExactMeshes::default(), &shape.geometry)
                .transformed(&shape.to_world);
            match reach.is_speck() {
                true => context.warn(&place, bounds::SPECK),
                false => left.push((shape, place)),
            }
            continue;
        }
        let pressed = press.shape(&shape, &shape.to_world, meshes, ExactMeshes::default());
        let pressed = pressed.map_err(|m| SceneError::new(ErrorKind::Limit, &place, m))?;
        context.warn(&place, pressed.message());
        if let Pressed::Flat(shape) = pressed {
            left.push((*shape, place));
        }
    }
    Ok(left)
}

fn too_far(place: &Place) -> SceneError {
    let message = format!("the shape reaches beyond {FARTHEST:e} from the origin");
    SceneError::new(ErrorKind::Limit, place, message)
}

fn nothing_left(context: &Context, place: &Place) -> SceneError {
    let dropped = context
        .warnings
        .iter()
        .find(|w| w.message().contains("is left out"));
    match dropped {
        Some(warning) => {
            let message = format!("no shape is left to render: {}", warning.message());
            SceneError::new(ErrorKind::EmptyScene, warning.place(), message)
        }
        None => SceneError::new(ErrorKind::EmptyScene, place, "the scene has no shapes")
            .with_help("expected at least one <shape>"),
    }
}
