//! From a document to a scene.

use std::rc::Rc;

use super::context::Context;
use super::document::Document;
use super::element::Element;
use super::shape::{self, Shapes};
use super::texture::unknown;
use crate::bounds::{self, FARTHEST};
use crate::error::{ErrorKind, Place, SceneError};
use crate::scene::{Instance, Light, Object, Scene, Settings};
use crate::{Limits, Loaded};

/// Builds the scene.
pub(super) fn assemble(document: Document, limits: &Limits) -> Result<Loaded, SceneError> {
    let (mut context, root) = Context::new(document, limits);
    root.visited.set(true);
    let mut parts = Parts::default();
    for property in &root.properties {
        if let Some(element) = context.plugin(property)? {
            property.used.set(true);
            parts.add(&mut context, &element)?;
        }
    }
    let Parts {
        shapes,
        lights,
        sensor,
        integrator,
    } = parts;
    let max_depth = context.integrator(integrator.as_ref())?;
    let Some(sensor) = sensor else {
        let message = "the scene has no <sensor>";
        return Err(SceneError::new(ErrorKind::Structure, &root.place, message)
            .with_help("expected one such as <sensor type=\"perspective\">"));
    };
    let film = context.child(&sensor, "film")?;
    let film = context.film(film.as_ref())?;
    let sampler = context.child(&sensor, "sampler")?;
    let samples_per_pixel = context.sampler(sampler.as_ref())?;
    let camera = context.camera(&sensor, film.resolution)?;
    let built = build(&mut context, shapes)?;
    context.warn_unused(&root);
    if built.shapes.is_empty() && built.instances.is_empty() {
        return Err(nothing_left(&context, &root.place));
    }
    let scene = Scene {
        camera,
        film,
        settings: Settings {
            max_depth,
            samples_per_pixel,
        },
        images: std::mem::take(&mut context.images),
        textures: std::mem::take(&mut context.textures),
        materials: std::mem::take(&mut context.materials),
        meshes: built.meshes,
        shapes: built.shapes,
        objects: built.objects,
        instances: built.instances,
        lights,
    };
    scene
        .validate()
        .map_err(|e| SceneError::new(ErrorKind::Limit, &root.place, e.to_string()))?;
    let shines = |objects: &[Object]| {
        let mut shapes = scene
            .shapes
            .iter()
            .chain(objects.iter().flat_map(|o| &o.shapes));
        shapes.any(|s| s.emission.is_some())
    };
    if scene.lights.is_empty() && !shines(&scene.objects) {
        context.warn(
            &root.place,
            "the scene has no light: the picture will be black",
        );
    }
    Ok(Loaded {
        scene,
        warnings: context.warnings,
    })
}

/// What the scene's own plugins describe.
#[derive(Default)]
struct Parts {
    shapes: Shapes,
    lights: Vec<Light>,
    sensor: Option<Rc<Element>>,
    integrator: Option<Rc<Element>>,
}

impl Parts {
    fn add(&mut self, context: &mut Context, element: &Rc<Element>) -> Result<(), SceneError> {
        match element.class {
            "shape" => self.shapes.add(context, element)?,
            "emitter" => self.lights.extend(context.lights(element)?),
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
    meshes: Vec<crate::scene::Mesh>,
    shapes: Vec<crate::scene::Shape>,
    objects: Vec<Object>,
    instances: Vec<Instance>,
}

fn build(context: &mut Context, shapes: Shapes) -> Result<BuiltShapes, SceneError> {
    let (ready, meshes) = shapes.meshes.read(context)?;
    let finished = shape::finish(shapes.world, &ready);
    for (shape, place) in &finished {
        let reach = bounds::of_geometry(&meshes, &shape.geometry).transformed(&shape.to_world);
        if reach.farthest() > FARTHEST {
            return Err(too_far(place));
        }
    }
    let objects: Vec<Object> = shapes
        .objects
        .into_iter()
        .map(|(name, pending)| shape::object(name, pending, &ready))
        .collect();
    let mut instances = Vec::new();
    for (instance, place) in shapes.instances {
        if objects[instance.object.0].shapes.is_empty() {
            context.warn(&place, "the group has no shapes: the instance is left out");
        } else {
            instances.push(instance);
        }
    }
    Ok(BuiltShapes {
        meshes,
        shapes: finished.into_iter().map(|s| s.0).collect(),
        objects,
        instances,
    })
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
