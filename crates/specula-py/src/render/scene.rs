//! Scenes: read from files, or built up by calls.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use glam::DMat4;
use numpy::PyReadonlyArray2;
use pyo3::exceptions::{PyKeyError, PyOSError};
use pyo3::prelude::*;
use rayon::ThreadPool;
use specula::render::{PreparedScene, RenderOptions};
use specula::scene::scene::{
    Camera, ColourParam, Emission, EnvironmentMapping, Film, Filter, Geometry, ImageId, Light,
    Material as SceneMaterial, MaterialId, Mesh, MeshId, Object, ObjectId, ObjectInstance,
    Settings, Shape, SpotFalloff,
};
use specula::scene::{ErrorKind, Exposure, LoadOptions, Scene, SceneError, Warning, load_with};
use specula_bsdf::math::Rgb;

use super::geometry::{affine, drop_flat, finite, triangles, unit};
use super::material::Material;
use super::microfacets::single;
use super::paint::{ANY, Paint, SHARE};
use super::{io_error, rows};
use crate::parameters::{Colour, in_range, invalid};

/// A scene, and what was prepared of it for the last render.
#[pyclass(module = "specula_render._native")]
pub(crate) struct SceneData {
    scene: Scene,
    name: String,
    /// Materials that shapes already have, by the object they were made of.
    made: Vec<(Material, MaterialId)>,
    /// The shapes, by their numbers.
    places: Vec<Place>,
    prepared: Option<(RenderOptions, Arc<PreparedScene>)>,
    is_changed: bool,
}

/// Where a shape is.
#[derive(Clone, Copy)]
enum Place {
    /// In the world.
    World(usize),
    /// In an object, which is seen where it has instances.
    Object(usize, usize),
}

/// What a shape is given besides its geometry.
type Surface = (Option<Material>, Option<Colour>, bool);

/// Reads a scene of any format; returns it with the warnings of its reader.
#[pyfunction]
#[pyo3(signature = (path, parameters, search, exposure, animation))]
pub(crate) fn load(
    py: Python<'_>,
    path: PathBuf,
    parameters: Vec<(String, String)>,
    search: Vec<PathBuf>,
    exposure: Option<[f64; 2]>,
    animation: Option<String>,
) -> PyResult<(SceneData, Vec<String>)> {
    std::fs::metadata(&path).map_err(|e| io_error(&path, &e))?;
    let mut options = LoadOptions::default();
    options.parameters = parameters;
    options.folders = search;
    options.exposure = exposure.map(exposed).transpose()?;
    options.animation = animation;
    let loaded = py
        .detach(|| load_with(&path, &options))
        .map_err(|e| scene_error(&e))?;
    let said = |w: &Warning| format!("{}: {}", w.place(), w.message());
    let warnings = loaded.warnings.iter().map(said).collect();
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok((SceneData::of(loaded.scene, name.into_owned()), warnings))
}

/// When the shutter is open, from the seconds of `at` and `shutter`.
fn exposed([at, shutter]: [f64; 2]) -> PyResult<Exposure> {
    let seconds = |name: &str, x: f64| {
        Duration::try_from_secs_f64(x)
            .map_err(|_| invalid(format!("{name}: expected seconds from 0 on, got {x}")))
    };
    Ok(Exposure {
        time: seconds("at", at)?,
        shutter: seconds("shutter", shutter)?,
    })
}

fn scene_error(error: &SceneError) -> PyErr {
    let help = error.help().map_or_else(String::new, |h| format!(" ({h})"));
    let message = format!("{}: {}{help}", error.place(), error.message());
    match error.kind() {
        ErrorKind::Io => PyOSError::new_err(message),
        _ => invalid(message),
    }
}

/// The built-in scene.
#[pyfunction]
pub(crate) fn builtin() -> SceneData {
    SceneData::of(specula::scene::builtin::orbs(), "orbs".to_owned())
}

/// The range of radiances and their like.
const BRIGHT: [f64; 2] = [0.0, f32::MAX as f64];

/// Whether a scene that was prepared for one of them serves for the other.
fn prepare_alike(a: &RenderOptions, b: &RenderOptions) -> bool {
    let prepared_from = |options: &RenderOptions| RenderOptions {
        samples_per_pixel: 0,
        max_depth: 0,
        seed: 0,
        share_paths: 0,
        first_sample: 0,
        noise: None,
        clamp: None,
        ..options.clone()
    };
    prepared_from(a) == prepared_from(b)
}

impl SceneData {
    fn of(scene: Scene, name: String) -> Self {
        Self {
            places: (0..scene.shapes.len()).map(Place::World).collect(),
            scene,
            name,
            made: Vec::new(),
            prepared: None,
            is_changed: true,
        }
    }

    pub(super) fn scene(&self) -> &Scene {
        &self.scene
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Whether something is kept of an earlier render.
    pub(super) fn is_prepared(&self) -> bool {
        self.prepared.is_some()
    }

    /// The scene made ready for rendering. What has not changed since the last time is taken over: all of
    /// it, or the tree over the shapes where only materials, lights or the camera have.
    pub(super) fn prepare(
        &mut self,
        py: Python<'_>,
        options: &RenderOptions,
        pool: &ThreadPool,
    ) -> PyResult<Arc<PreparedScene>> {
        if let Some((before, prepared)) = &self.prepared
            && !self.is_changed
            && prepare_alike(before, options)
        {
            return Ok(Arc::clone(prepared));
        }
        let earlier = self.prepared.take().map(|(_, earlier)| earlier);
        let scene = &self.scene;
        let prepare = || {
            scene.validate().map_err(invalid)?;
            let earlier = earlier.map(Arc::unwrap_or_clone);
            PreparedScene::consume_after(scene.clone(), options, earlier).map_err(invalid)
        };
        let prepared = py.detach(|| pool.install(prepare))?;
        let prepared = Arc::new(prepared);
        self.prepared = Some((options.clone(), Arc::clone(&prepared)));
        self.is_changed = false;
        Ok(prepared)
    }

    fn material(&mut self, material: Option<Material>) -> MaterialId {
        let material = material.unwrap_or_else(Material::grey);
        if let Some((_, id)) = self.made.iter().find(|(made, _)| made.is(&material)) {
            return *id;
        }
        let mut made = SceneMaterial::new(material.build(&mut self.scene));
        made.absorption = material.absorption;
        made.bump = material.bump(&mut self.scene);
        self.scene.materials.push(made);
        let id = MaterialId(self.scene.materials.len() - 1);
        self.made.push((material, id));
        id
    }

    /// Adds a shape to the world, or to an object; returns its number.
    fn add(
        &mut self,
        geometry: Geometry,
        to_world: DMat4,
        (material, emission, two_sided): Surface,
        object: Option<usize>,
    ) -> PyResult<usize> {
        if let Some(object) = object {
            self.object(object)?;
            if emission.is_some() {
                return Err(invalid(
                    "emission: shapes of an object emit no light; add the lamp to the scene",
                ));
            }
        }
        let radiance = emission
            .map(|radiance| radiance.within("emission", BRIGHT))
            .transpose()?;
        let id = self.material(material);
        let mut shape = Shape::new(geometry, to_world, id);
        shape.emission = radiance.map(|radiance| Emission {
            radiance: ColourParam::Value(radiance.cast()),
            two_sided,
        });
        let shapes = match object {
            None => &mut self.scene.shapes,
            Some(object) => &mut self.scene.objects[object].shapes,
        };
        shapes.push(shape);
        let last = shapes.len() - 1;
        self.places.push(match object {
            None => Place::World(last),
            Some(object) => Place::Object(object, last),
        });
        self.is_changed = true;
        Ok(self.places.len() - 1)
    }

    /// The shape of a number.
    fn shape_mut(&mut self, number: usize) -> Option<&mut Shape> {
        match *self.places.get(number)? {
            Place::World(i) => self.scene.shapes.get_mut(i),
            Place::Object(object, i) => self.scene.objects.get_mut(object)?.shapes.get_mut(i),
        }
    }

    /// Fails where there is no object of this number.
    fn object(&self, object: usize) -> PyResult<()> {
        let count = self.scene.objects.len();
        match object < count {
            true => Ok(()),
            false => Err(invalid(format!(
                "object: there is no {object} among {count} objects"
            ))),
        }
    }
}

#[pymethods]
impl SceneData {
    /// An empty scene, with a camera at (0, -5, 0) that looks along y.
    #[new]
    fn new() -> Self {
        let filter = Filter::Gaussian {
            radius: [1.5; 2],
            sigma: 0.5,
        };
        let film = Film::new([512, 512], filter);
        let (eye, up) = ([0.0, -5.0, 0.0], [0.0, 0.0, 1.0]);
        let camera = Camera::look_at(eye.into(), [0.0; 3].into(), up.into(), 40.0, &film);
        let settings = Settings {
            samples_per_pixel: 64,
            ..Settings::default()
        };
        Self::of(Scene::empty(camera, film, settings), "scene".to_owned())
    }

    /// Adds a mesh; returns the shape's index and how many triangles without area were dropped.
    #[pyo3(signature = (vertices, faces, normals, uvs, transform, surface, opacity, object))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn add_mesh(
        &mut self,
        vertices: &Bound<'_, PyAny>,
        faces: &Bound<'_, PyAny>,
        normals: Option<&Bound<'_, PyAny>>,
        uvs: Option<&Bound<'_, PyAny>>,
        transform: Option<[[f64; 4]; 4]>,
        surface: Surface,
        opacity: Option<&Bound<'_, PyAny>>,
        object: Option<usize>,
    ) -> PyResult<(usize, usize)> {
        let positions = rows::<3>("vertices", vertices)?;
        let count = positions.len();
        let faces: PyReadonlyArray2<'_, i64> = faces.extract()?;
        let normals = normals.map(|n| rows::<3>("normals", n)).transpose()?;
        let uvs = uvs.map(|n| rows::<2>("uvs", n)).transpose()?;
        let wanted = |name: &str, given: Option<usize>| match given {
            Some(n) if n != count => Err(invalid(format!(
                "{name}: expected one for each of {count} vertices, got {n}"
            ))),
            _ => Ok(()),
        };
        wanted("normals", normals.as_ref().map(Vec::len))?;
        wanted("uvs", uvs.as_ref().map(Vec::len))?;
        let mut mesh = Mesh {
            positions,
            normals: normals.unwrap_or_default(),
            uvs: uvs.unwrap_or_default(),
            triangles: triangles(&faces, count)?,
            ..Mesh::default()
        };
        if let Some(i) = mesh.normals.iter().position(|n| *n == [0.0; 3]) {
            return Err(invalid(format!(
                "normals[{i}]: expected a direction, got 0"
            )));
        }
        let dropped = drop_flat(&mut mesh);
        if mesh.triangles.is_empty() {
            return Err(invalid("faces: expected a triangle with area"));
        }
        let to_world = affine(transform)?;
        let opacity = Paint::or("opacity", opacity, SHARE, 1.0)?;
        let geometry = Geometry::Mesh(MeshId(self.scene.meshes.len()));
        let number = self.add(geometry, to_world, surface, object)?;
        self.scene.meshes.push(mesh);
        let alpha = opacity.number(&mut self.scene);
        if let Some(shape) = self.shape_mut(number) {
            shape.alpha = alpha;
        }
        Ok((number, dropped))
    }

    /// Adds a sphere; returns the shape's index.
    #[pyo3(signature = (center, radius, transform, surface, object))]
    fn add_sphere(
        &mut self,
        center: [f64; 3],
        radius: f64,
        transform: Option<[[f64; 4]; 4]>,
        surface: Surface,
        object: Option<usize>,
    ) -> PyResult<usize> {
        let center = finite("center", center)?;
        let rounded = single(radius);
        if !(rounded > 0.0 && rounded.is_finite()) {
            return Err(invalid(format!(
                "radius: expected a number above 0, got {radius}"
            )));
        }
        let to_world = affine(transform)? * DMat4::from_translation(center.into());
        self.add(
            Geometry::Sphere { radius: rounded },
            to_world,
            surface,
            object,
        )
    }

    /// Adds an empty object; returns its number.
    fn add_object(&mut self, name: String) -> usize {
        let shapes = Vec::new();
        self.scene.objects.push(Object { name, shapes });
        self.scene.objects.len() - 1
    }

    /// Places an object in the world.
    fn add_instance(&mut self, object: usize, transform: [[f64; 4]; 4]) -> PyResult<()> {
        self.object(object)?;
        self.scene.instances.push(ObjectInstance {
            object: ObjectId(object),
            to_world: affine(Some(transform))?,
            motion: None,
        });
        self.is_changed = true;
        Ok(())
    }

    /// Sets the camera, and the size of the picture where it is given.
    #[pyo3(signature = (position, look_at, up, fov, resolution, lens_radius))]
    fn set_camera(
        &mut self,
        position: [f64; 3],
        look_at: [f64; 3],
        up: [f64; 3],
        fov: f64,
        resolution: Option<[u32; 2]>,
        lens_radius: f64,
    ) -> PyResult<()> {
        let (eye, target) = (finite("position", position)?, finite("look_at", look_at)?);
        let up = unit("up", up)?;
        let sight = [0, 1, 2].map(|i| target[i] - eye[i]);
        let [x, y, z] = unit("look_at - position", sight)?;
        let along = x * up[0] + y * up[1] + z * up[2];
        if along.abs() > 1.0 - 1e-12 {
            return Err(invalid("up: expected another direction than the camera's"));
        }
        if !(fov > 0.0 && fov < 180.0) {
            return Err(invalid(format!(
                "fov: expected degrees in (0, 180), got {fov}"
            )));
        }
        in_range("lens_radius", lens_radius, [0.0, f64::MAX])?;
        let film = &mut self.scene.film;
        if let Some([width, height]) = resolution {
            if width == 0 || height == 0 {
                return Err(invalid("width, height: expected 1 pixel or more"));
            }
            film.resolution = [width, height];
            film.crop = [0, width, 0, height];
        }
        let mut camera = Camera::look_at(eye.into(), target.into(), up.into(), fov, film);
        camera.lens_radius = lens_radius;
        self.scene.camera = camera;
        self.is_changed = true;
        Ok(())
    }

    /// Replaces the environment lights by one: a colour, or a picture by latitude and longitude.
    fn set_environment(&mut self, radiance: &Bound<'_, PyAny>) -> PyResult<()> {
        let paint = Paint::new("radiance", radiance, ANY)?;
        let scene = &mut self.scene;
        let (radiance, image) = match paint {
            Paint::Value(radiance) => (radiance, None),
            Paint::Picture(image) => {
                scene.images.push(image);
                let id = ImageId(scene.images.len() - 1);
                let mapping = EnvironmentMapping::LatitudeLongitude;
                (Rgb::WHITE, Some((id, mapping)))
            }
        };
        let is_environment = |l: &Light| matches!(l, Light::Infinite { .. });
        scene.lights.retain(|light| !is_environment(light));
        scene.lights.push(Light::Infinite {
            radiance,
            image,
            to_world: Default::default(),
        });
        self.is_changed = true;
        Ok(())
    }

    /// Adds a point light.
    fn add_point_light(&mut self, position: [f64; 3], intensity: Colour) -> PyResult<()> {
        let light = Light::Point {
            position: finite("position", position)?,
            intensity: intensity.within("intensity", BRIGHT)?.cast(),
        };
        self.scene.lights.push(light);
        self.is_changed = true;
        Ok(())
    }

    /// Adds a light at infinity.
    fn add_distant_light(
        &mut self,
        direction: [f64; 3],
        irradiance: Colour,
        half_angle: f64,
    ) -> PyResult<()> {
        if !(0.0..90.0).contains(&half_angle) {
            return Err(invalid(format!(
                "half_angle: expected degrees in [0, 90), got {half_angle}"
            )));
        }
        let light = Light::Distant {
            irradiance: irradiance.within("irradiance", BRIGHT)?.cast(),
            to_light: unit("direction", direction)?.map(|x| -x),
            half_angle_deg: half_angle,
        };
        self.scene.lights.push(light);
        self.is_changed = true;
        Ok(())
    }

    /// Adds a spot light, smooth in the cosine between the two angles.
    fn add_spot_light(
        &mut self,
        position: [f64; 3],
        look_at: [f64; 3],
        intensity: Colour,
        cone_angle: f64,
        falloff_start: f64,
    ) -> PyResult<()> {
        let position = finite("position", position)?;
        let target = finite("look_at", look_at)?;
        let is_cone = cone_angle > 0.0 && cone_angle < 180.0;
        if !(is_cone && (0.0..=cone_angle).contains(&falloff_start)) {
            return Err(invalid(format!(
                "expected degrees 0 <= falloff_start <= cone_angle < 180, got {falloff_start} and {cone_angle}"
            )));
        }
        let axis = [0, 1, 2].map(|i| target[i] - position[i]);
        self.scene.lights.push(Light::Spot {
            position,
            axis: unit("look_at - position", axis)?,
            intensity: intensity.within("intensity", BRIGHT)?.cast(),
            cone_angle_deg: cone_angle,
            falloff_start_deg: falloff_start,
            falloff: SpotFalloff::SmoothCosine,
        });
        self.is_changed = true;
        Ok(())
    }

    /// Gives a material to the shape of an index.
    fn set_material(&mut self, shape: usize, material: Material) -> PyResult<()> {
        let id = self.material(Some(material));
        let count = self.places.len();
        let Some(given) = self.shape_mut(shape) else {
            return Err(invalid(format!(
                "shape: there is no {shape} among {count} shapes"
            )));
        };
        given.material = id;
        self.is_changed = true;
        Ok(())
    }

    /// Replaces the materials of a name; `None`: all, as the command line's `--material` does.
    fn replace_material(&mut self, name: Option<&str>, material: &Material) -> PyResult<()> {
        let is_named = |m: &SceneMaterial| m.name.as_deref() == name;
        if name.is_some() && !self.scene.materials.iter().any(is_named) {
            let name = name.unwrap_or_default();
            return Err(PyKeyError::new_err(format!(
                "no material is named '{name}'"
            )));
        }
        let kind = material.build(&mut self.scene);
        if let (Some(bump), Some(_)) = (material.bump(&mut self.scene), name) {
            for m in self.scene.materials.iter_mut().filter(|m| is_named(m)) {
                m.bump = Some(bump);
            }
        }
        match name {
            None => self.scene.replace_materials(kind),
            Some(name) => {
                self.scene.replace_materials_named(|n| n == name, kind);
            }
        }
        self.is_changed = true;
        Ok(())
    }

    /// The names of materials, in order; `None` of those without.
    fn material_names(&self) -> Vec<Option<String>> {
        self.scene
            .materials
            .iter()
            .map(|m| m.name.clone())
            .collect()
    }

    /// Shapes, instances not counted.
    fn shape_count(&self) -> usize {
        let in_objects = self.scene.objects.iter().map(|o| o.shapes.len());
        self.scene.shapes.len() + in_objects.sum::<usize>()
    }

    /// The name: that of the file without its extension.
    #[getter(name)]
    fn scene_name(&self) -> &str {
        &self.name
    }

    /// Width and height of the picture.
    #[getter]
    fn resolution(&self) -> [u32; 2] {
        self.scene.film.resolution
    }
}
