//! The tree of nodes, and the whole scene.

use std::collections::HashMap;

use glam::{DMat4, DVec3};
use gltf::camera::Projection as GltfProjection;
use gltf::scene::Transform;

use super::Reader;
use super::animation::{matrix, targets};
use super::deform::{Deformation, Pose};
use super::material::Appearance;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::pressed::{Press, Pressed};
use crate::scene::{
    Camera, Geometry, MeshId, Motion, Object, ObjectId, ObjectInstance, Projection, Scene,
    Settings, Shape,
};
use crate::stage::{self, AddedLight};
use crate::transform::{check_transform, is_invertible, mirrors};
use crate::triangulate::ExactMeshes;
use crate::{Exposure, Loaded, bounds};

/// Width of pictures whose file gives no size.
const WIDTH: u32 = 1280;

/// The nodes of a file, and what was found in those of its scene.
#[derive(Default)]
struct VisitedNodes<'a> {
    all: Vec<gltf::Node<'a>>,
    /// By the number of a node that of its parent.
    parents: HashMap<usize, usize>,
    /// Places of every mesh, by its number.
    places: HashMap<usize, Vec<NodePlace>>,
    camera: Option<(Camera, Option<f64>)>,
    nodes: usize,
    /// Where every node is when the shutter opens and when it closes, by its number.
    ends: HashMap<usize, [DMat4; 2]>,
    instances: Vec<ObjectInstance>,
}

/// Where a node is when the shutter opens.
#[derive(Clone, Copy)]
struct NodePlace {
    node: usize,
    to_world: DMat4,
    /// When it closes.
    end: DMat4,
}

impl Reader<'_> {
    /// The scene of the file's default scene, else of its first, else of all its nodes.
    pub(super) fn assemble(mut self) -> Result<Loaded, SceneError> {
        let document = self.document;
        self.read_animations()?;
        let mut found = VisitedNodes {
            all: document.nodes().collect(),
            ..VisitedNodes::default()
        };
        let scene = document
            .default_scene()
            .or_else(|| document.scenes().next());
        let nodes: Vec<gltf::Node<'_>> = match &scene {
            Some(scene) => scene.nodes().collect(),
            None => document.nodes().collect(),
        };
        for node in &nodes {
            self.node(node, [DMat4::IDENTITY; 2], 0, &mut found)?;
        }
        let mut press = Press::new(self.limits);
        for mesh in document.meshes() {
            let mut rigid = Vec::new();
            for place in found.places.remove(&mesh.index()).unwrap_or_default() {
                let deformation = self.deformation(&mesh, &place, &mut found);
                match self.problems.or(deformation, || None)? {
                    None => rigid.push(place),
                    Some(deformation) => {
                        let parts = self.primitives(&mesh, Some(&deformation))?;
                        // Skins take vertices to the world.
                        let place = match deformation.pose {
                            None => place,
                            Some(_) => NodePlace {
                                to_world: DMat4::IDENTITY,
                                end: DMat4::IDENTITY,
                                ..place
                            },
                        };
                        self.put(&mesh, &parts, vec![place], &mut press, &mut found)?;
                    }
                }
            }
            if !rigid.is_empty() {
                let parts = self.primitives(&mesh, None)?;
                self.put(&mesh, &parts, rigid, &mut press, &mut found)?;
            }
        }
        let is_empty = self.shapes.is_empty() && found.instances.is_empty();
        if is_empty && !self.problems.has_errors() {
            let mut warnings = std::mem::take(&mut self.warnings);
            self.problems.record_warnings(&mut warnings);
            return Err(self.error(ErrorKind::EmptyScene, "there is nothing to render"));
        }
        self.finish(found.camera, found.instances)
    }

    /// Puts the parts of a mesh in their places.
    fn put(
        &mut self,
        mesh: &gltf::Mesh<'_>,
        parts: &[(MeshId, Appearance)],
        places: Vec<NodePlace>,
        press: &mut Press,
        found: &mut VisitedNodes<'_>,
    ) -> Result<(), SceneError> {
        let own = parts.iter().map(|(id, _)| Geometry::Mesh(*id));
        let own = own.map(|g| bounds::of_geometry(&self.meshes, ExactMeshes::default(), &g));
        let own = own.fold(bounds::BoundingBox::EMPTY, bounds::BoundingBox::union);
        let (places, flat): (Vec<_>, Vec<_>) =
            places.into_iter().partition(|p| is_invertible(&p.to_world));
        let (specks, places): (Vec<_>, Vec<_>) = places
            .into_iter()
            .partition(|p| own.transformed(&p.to_world).is_speck());
        for NodePlace { node, .. } in specks {
            self.warn(format!("nodes[{node}]: {}", bounds::SPECK));
        }
        for NodePlace { node, to_world, .. } in flat {
            self.pressed(press, parts, &to_world, node)?;
        }
        let emits = parts.iter().any(|(_, look)| look.emission.is_some());
        let places = places
            .into_iter()
            .map(|p| (p.to_world, self.motion(&p, emits)));
        let places: Vec<(DMat4, Option<Motion>)> = places.collect();
        match places.as_slice() {
            [] => {}
            [(place, motion)] => {
                let shapes = parts.iter().map(|part| Shape {
                    motion: *motion,
                    ..shape(*part, *place)
                });
                self.shapes.extend(shapes);
            }
            places if !parts.is_empty() => {
                let shapes = parts.iter().map(|part| shape(*part, DMat4::IDENTITY));
                let object = Object {
                    name: mesh.name().unwrap_or_default().to_owned(),
                    shapes: shapes.collect(),
                };
                self.objects.push(object);
                let object = ObjectId(self.objects.len() - 1);
                let instances = places.iter().map(|(to_world, motion)| ObjectInstance {
                    object,
                    to_world: *to_world,
                    motion: *motion,
                });
                found.instances.extend(instances);
            }
            _ => {}
        }
        Ok(())
    }

    /// What deforms a mesh in a node when the shutter opens; `None`: nothing.
    fn deformation(
        &mut self,
        mesh: &gltf::Mesh<'_>,
        place: &NodePlace,
        found: &mut VisitedNodes<'_>,
    ) -> Result<Option<Deformation>, SceneError> {
        let Some(node) = found.all.get(place.node).cloned() else {
            return Ok(None);
        };
        if node.skin().is_none() && targets(mesh) == 0 {
            return Ok(None);
        }
        let own = node.weights().or(mesh.weights()).unwrap_or_default();
        let times = self.exposure.map_or([0.0; 2], times);
        let [weights, later] = times.map(|time| {
            let weight = |k: usize| {
                let own = own.get(k).copied().map_or(0.0, f64::from);
                let animated = self.animations.weight(place.node, k, time);
                animated.unwrap_or(own)
            };
            (0..targets(mesh)).map(weight).collect::<Vec<_>>()
        });
        let mut deforms = weights != later;
        let pose = match node.skin() {
            None => None,
            Some(skin) => {
                let binding = self.binding(&skin)?;
                let mut joints = Vec::new();
                for (joint, to_joint) in skin.joints().zip(binding) {
                    let [start, end] = self.ends_of(&joint, found);
                    deforms |= start != end;
                    joints.push(start * to_joint);
                }
                let node = place.to_world;
                Some(Pose { joints, node })
            }
        };
        if deforms {
            self.warn(format!(
                "nodes[{}]: its mesh deforms during the exposure: it has the form of when the shutter opens",
                place.node
            ));
        }
        let deformation = Deformation { weights, pose };
        Ok((!deformation.is_none()).then_some(deformation))
    }

    /// Where a node is when the shutter opens and when it closes, also where it is not in the scene.
    fn ends_of(&mut self, node: &gltf::Node<'_>, found: &mut VisitedNodes<'_>) -> [DMat4; 2] {
        if found.parents.is_empty() {
            let children = |n: &gltf::Node<'_>| {
                let parent = n.index();
                n.children()
                    .map(|c| (c.index(), parent))
                    .collect::<Vec<_>>()
            };
            found.parents = found.all.iter().flat_map(children).collect();
        }
        // Up to a node whose place is known; nodes that contain themselves end at one of them.
        let mut way = vec![node.index()];
        while let Some(last) = way.last()
            && !found.ends.contains_key(last)
            && let Some(parent) = found.parents.get(last)
            && way.len() <= found.all.len()
        {
            way.push(*parent);
        }
        let mut ends = [DMat4::IDENTITY; 2];
        while let Some(index) = way.pop() {
            if let Some(known) = found.ends.get(&index) {
                ends = *known;
            } else if let Some(node) = found.all.get(index).cloned() {
                let own = self.own_ends(&node);
                ends = [ends[0] * own[0], ends[1] * own[1]];
                found.ends.insert(index, ends);
            }
        }
        ends
    }

    /// The transform of a node to its parent's space when the shutter opens and when it closes.
    fn own_ends(&mut self, node: &gltf::Node<'_>) -> [DMat4; 2] {
        let own = self.transform(node);
        let animated = |time| self.animations.transform(node.index(), &own, time);
        match self.exposure {
            None => [matrix(&own); 2],
            Some(exposure) => times(exposure).map(animated),
        }
    }

    /// Adds the parts of a mesh under a transform that cannot be inverted.
    fn pressed(
        &mut self,
        press: &mut Press,
        parts: &[(MeshId, Appearance)],
        to_world: &DMat4,
        node: usize,
    ) -> Result<(), SceneError> {
        for part in parts {
            let shape = shape(*part, *to_world);
            let pressed = press.shape(&shape, to_world, &mut self.meshes, ExactMeshes::default());
            let pressed =
                pressed.map_err(|m| self.error(ErrorKind::Limit, format!("nodes[{node}]: {m}")))?;
            self.warn(format!("nodes[{node}]: {}", pressed.message()));
            if let Pressed::Flat(shape) = pressed {
                self.shapes.push(*shape);
            }
        }
        Ok(())
    }

    fn finish(
        mut self,
        camera: Option<(Camera, Option<f64>)>,
        instances: Vec<ObjectInstance>,
    ) -> Result<Loaded, SceneError> {
        let aspect = camera.as_ref().and_then(|(_, aspect)| *aspect);
        let aspect = aspect.unwrap_or(16.0 / 9.0).clamp(0.05, 20.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 64 and 25600"
        )]
        let height = (f64::from(WIDTH) / aspect).round() as u32;
        let empty = Scene::empty(
            stage::camera(bounds::BoundingBox::EMPTY, [WIDTH, height]),
            stage::film([WIDTH, height]),
            Settings::default(),
        );
        let mut scene = Scene {
            images: core::mem::take(&mut self.images),
            textures: core::mem::take(&mut self.textures),
            materials: core::mem::take(&mut self.materials),
            meshes: core::mem::take(&mut self.meshes),
            shapes: core::mem::take(&mut self.shapes),
            objects: core::mem::take(&mut self.objects),
            instances,
            lights: core::mem::take(&mut self.lights),
            ..empty
        };
        let bounds = bounds::of_scene(&scene);
        match camera {
            Some((mut camera, _)) => {
                stage::fit_screen(&mut camera, [WIDTH, height]);
                scene.camera = camera;
            }
            None => {
                scene.camera = stage::camera(bounds, [WIDTH, height]);
                self.warn("the file has no camera: one that frames everything is used");
            }
        }
        let lit = !scene.lights.is_empty() || self.has_lamps;
        if !lit {
            self.warn(match stage::light(&mut scene, bounds) {
                AddedLight::OverFloor => {
                    "the file has no lights: the built-in studio's and a floor are used"
                }
                AddedLight::Alone => "the file has no lights: the built-in studio's are used",
            });
        }
        // What stands in for mistakes need not make a scene.
        if !self.problems.has_errors() {
            scene.each_fault(|fault| {
                let error = self.error(ErrorKind::Structure, fault.to_string());
                self.problems.record(error)
            })?;
        }
        Ok(Loaded {
            format: crate::Format::Gltf,
            scene,
            warnings: self.warnings,
            files: self.files.list(),
            missing: Vec::new(),
        })
    }

    fn node(
        &mut self,
        node: &gltf::Node<'_>,
        parent: [DMat4; 2],
        depth: usize,
        found: &mut VisitedNodes<'_>,
    ) -> Result<(), SceneError> {
        let what = format!("nodes[{}]", node.index());
        found.nodes += 1;
        let most = self.document.nodes().len();
        if depth > self.limits.max_depth || found.nodes > most {
            let message =
                format!("{what}: nodes are nested too deeply, or contain themselves (`max_depth`)");
            return Err(self.error(ErrorKind::Limit, message));
        }
        let own = self.own_ends(node);
        let ends = [parent[0] * own[0], parent[1] * own[1]];
        found.ends.insert(node.index(), ends);
        let [place, end] = ends;
        if let Some(mesh) = node.mesh() {
            match crate::transform::check_finite(&place) {
                Ok(()) => {
                    let places = found.places.entry(mesh.index()).or_default();
                    places.push(NodePlace {
                        node: node.index(),
                        to_world: place,
                        end,
                    });
                }
                Err(problem) => self.warn(format!("{what}: {problem}; its mesh is left out")),
            }
        }
        if let Some(camera) = node.camera() {
            match found.camera {
                Some(_) => self.warn("the file has several cameras: the first is used"),
                None => found.camera = self.camera(&camera, &ends)?,
            }
        }
        if let Some(light) = node.light() {
            if place != end {
                self.warn(format!(
                    "{what}: the light moves; it is rendered where it starts"
                ));
            }
            self.light(&light, &place);
        }
        for child in node.children() {
            self.node(&child, ends, depth + 1, found)?;
        }
        Ok(())
    }

    /// Reads the animations, where a moment of them is asked for.
    fn read_animations(&mut self) -> Result<(), SceneError> {
        if self.exposure.is_some() {
            if self.document.animations().next().is_none() {
                self.warn("the file has no animation: it is the same at all times");
            }
            self.animations = self.animations()?;
        } else if let Some(animated) = self.animated() {
            self.warn(format!(
                "animations are left out: {animated}; `--at SECONDS` renders a moment of them"
            ));
        }
        Ok(())
    }

    /// How a mesh moves that a node shows.
    fn motion(&mut self, place: &NodePlace, emits: bool) -> Option<Motion> {
        let what = format!("nodes[{}]", place.node);
        if emits && place.end != place.to_world {
            self.warn(format!(
                "{what}: it moves and emits light: it is rendered where it starts"
            ));
            return None;
        }
        self.motion_to(&what, &place.to_world, place.end)
    }

    /// The motion from where something is when the shutter opens to where it is when it closes.
    fn motion_to(&mut self, what: &str, start: &DMat4, end: DMat4) -> Option<Motion> {
        if *start == end {
            return None;
        }
        if check_transform(&end).is_err() || mirrors(start) != mirrors(&end) {
            let message = "it is pressed flat as it moves: it is rendered where it starts";
            self.warn(format!("{what}: {message}"));
            return None;
        }
        let times = [0.0, 1.0];
        Some(Motion { end, times })
    }

    /// A camera and its aspect.
    fn camera(
        &mut self,
        camera: &gltf::Camera<'_>,
        [place, end]: &[DMat4; 2],
    ) -> Result<Option<(Camera, Option<f64>)>, SceneError> {
        let Some(to_world) = camera_space(place) else {
            self.warn("a camera without extent is left out");
            return Ok(None);
        };
        let what = format!("cameras[{}]", camera.index());
        let motion = self.motion_to(&what, &to_world, camera_space(end).unwrap_or(to_world));
        let (projection, window, aspect) = match camera.projection() {
            GltfProjection::Perspective(p) => {
                let aspect = p.aspect_ratio().map(f64::from).filter(|aspect| {
                    if *aspect <= 0.0 {
                        self.warn(format!(
                            "{what}.perspective.aspectRatio: expected a number above 0, found \
                             {aspect}: it is left out"
                        ));
                    }
                    *aspect > 0.0
                });
                let yfov = p.yfov();
                if !(yfov > 0.0 && yfov < std::f32::consts::PI) {
                    let message = format!(
                        "{what}.perspective.yfov: expected an angle above 0 and below pi, found {yfov}"
                    );
                    return self.lost(message);
                }
                let yfov = f64::from(yfov).clamp(1e-3, 3.1);
                // The angle belongs to the picture's shorter side.
                let shorter = aspect.unwrap_or(1.0).min(1.0);
                let fov_deg = (2.0 * ((0.5 * yfov).tan() * shorter).atan()).to_degrees();
                (Projection::Perspective { fov_deg }, None, aspect)
            }
            GltfProjection::Orthographic(o) => {
                let [x, y] = [o.xmag(), o.ymag()].map(|m| f64::from(m).abs());
                if !(x > 0.0 && y > 0.0 && (x + y).is_finite()) {
                    let message = format!(
                        "{what}.orthographic: expected an \"xmag\" and a \"ymag\" other than 0, \
                         found {x} and {y}"
                    );
                    return self.lost(message);
                }
                let window = Some([-x, x, -y, y]);
                (Projection::Orthographic, window, Some(x / y))
            }
        };
        let camera = Camera {
            to_world,
            motion,
            projection,
            lens_radius: 0.0,
            focal_distance: 1.0,
            // Perspective windows are set when the picture's size is known.
            screen_window: window.unwrap_or([0.0; 4]),
        };
        Ok(Some((camera, aspect)))
    }

    /// A camera with a mistake: in a check the file is taken for one without.
    fn lost<T>(&self, message: String) -> Result<Option<T>, SceneError> {
        let error = self.error(ErrorKind::Parameter, message);
        self.problems.record(error).map(|()| None)
    }

    /// The transform of a node, whose rotation has length 1.
    fn transform(&mut self, node: &gltf::Node<'_>) -> Transform {
        let transform = node.transform();
        let Transform::Decomposed {
            translation,
            rotation,
            scale,
        } = transform
        else {
            return transform;
        };
        let length = rotation
            .map(f64::from)
            .map(|x| x * x)
            .iter()
            .sum::<f64>()
            .sqrt();
        // Exporters round, and quantise.
        if (length - 1.0).abs() < 1e-2 {
            return transform;
        }
        let what = format!(
            "nodes[{}].rotation: expected a quaternion of length 1, found one of length {length}",
            node.index()
        );
        let is_none = !(length > 1e-6 && length.is_finite());
        self.warn(match is_none {
            true => format!("{what}: the node is not turned"),
            false => format!("{what}: it is scaled to 1"),
        });
        let rotation = match is_none {
            true => [0.0, 0.0, 0.0, 1.0],
            false => rotation.map(|x| f32_of(f64::from(x) / length)),
        };
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        }
    }
}

/// When the shutter opens and when it closes, in seconds.
fn times(exposure: Exposure) -> [f64; 2] {
    let Exposure { time, shutter } = exposure;
    [time, time + shutter].map(|t| t.as_secs_f64())
}

/// The space of a camera in a node: cameras look along -z with y up. `None` where the node has no extent.
fn camera_space(node: &DMat4) -> Option<DMat4> {
    // Scale along the axes of a camera has no effect.
    let axis = |v: DVec3| node.transform_vector3(v).try_normalize();
    Some(DMat4::from_cols(
        axis(DVec3::X)?.extend(0.0),
        axis(DVec3::Y)?.extend(0.0),
        axis(DVec3::NEG_Z)?.extend(0.0),
        node.transform_point3(DVec3::ZERO).extend(1.0),
    ))
}

fn shape((mesh, look): (MeshId, Appearance), to_world: DMat4) -> Shape {
    Shape {
        emission: look.emission,
        alpha: look.alpha,
        ..Shape::new(Geometry::Mesh(mesh), to_world, look.material)
    }
}
