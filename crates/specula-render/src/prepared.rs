//! A scene made ready for rendering: flat arrays, trees and tables.

use specula_bsdf::bsdf::Lobe;
use specula_scene::{Scene, scene};
use thiserror::Error;

use crate::accel::AccelError;
use crate::camera::{Camera, screen_window};
use crate::convert::round_u32;
use crate::film::develop::Develop;
use crate::film::filter::FilterSampler;
use crate::geometry::{FARTHEST, Geometry};
use crate::light::Lights;
use crate::material::Materials;
use crate::options::{RenderOptions, Strategy};
use crate::places::Places;
use crate::texture::Textures;

/// Most pixels of a picture.
const MOST_PIXELS: u64 = 1 << 30;

/// Everything that a render reads.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    pub(crate) camera: Camera,
    pub(crate) filter: FilterSampler,
    pub(crate) develop: Develop,
    pub(crate) resolution: [u32; 2],
    pub(crate) crop: [u32; 4],
    pub(crate) geometry: Geometry,
    pub(crate) textures: Textures,
    pub(crate) materials: Materials,
    pub(crate) lights: Lights,
    /// Material of each shape that is shaded in batches, and whether its sides are materials of their own there.
    batch_materials: Vec<Option<(u32, bool)>>,
    /// The same behind rough surfaces; empty where that makes no difference.
    batch_materials_behind_rough: Vec<Option<(u32, bool)>>,
    /// What rays end at, where the scene is small.
    pub(crate) places: Option<Places>,
    /// Whether lights are hidden from the camera.
    pub(crate) hide_emitters: bool,
    /// Whether anything moves: paths have times only then.
    pub(crate) moves: bool,
}

/// Why a scene cannot be rendered.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PrepareError {
    /// The tree over the shapes cannot be built.
    #[error("the scene's shapes cannot be prepared: {0}")]
    Shapes(#[from] AccelError),
    /// A shape is too far away, or too large.
    #[error(
        "a shape reaches farther than {FARTHEST:e} units from the origin: rays are not followed there"
    )]
    TooFar,
    /// Paths of different times cannot share what lies behind their first vertices.
    #[error("paths cannot be shared in a scene that moves: render it without `--share-paths`")]
    SharedMotion,
    /// The picture has no pixels, or too many.
    #[error("a picture of {width} x {height} pixels cannot be rendered")]
    Resolution {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The crop leaves nothing of the picture.
    #[error("the crop {crop:?} (x0, x1, y0, y1) leaves nothing of {width} x {height} pixels")]
    Crop {
        /// The crop.
        crop: [u32; 4],
        /// Columns of the whole picture.
        width: u32,
        /// Rows of the whole picture.
        height: u32,
    },
}

/// What of a prepared scene depends on the camera and the film.
struct View {
    camera: Camera,
    filter: FilterSampler,
    develop: Develop,
    resolution: [u32; 2],
    crop: [u32; 4],
}

impl View {
    fn new(
        camera: &scene::Camera,
        film: &scene::Film,
        options: &RenderOptions,
    ) -> Result<Self, PrepareError> {
        let resolution = options.resolution.unwrap_or(film.resolution);
        let [width, height] = resolution;
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 || pixels > MOST_PIXELS || film.resolution.contains(&0) {
            return Err(PrepareError::Resolution { width, height });
        }
        let asked = asked_crop(film, options);
        let crop = [
            asked[0],
            asked[1].min(width),
            asked[2],
            asked[3].min(height),
        ];
        if crop[0] >= crop[1] || crop[2] >= crop[3] {
            return Err(PrepareError::Crop {
                crop: asked,
                width,
                height,
            });
        }
        let window = screen_window(camera, film.resolution, resolution);
        Ok(Self {
            camera: Camera::new(camera, resolution, window),
            filter: FilterSampler::new(&film.filter),
            develop: Develop::new(film),
            resolution,
            crop,
        })
    }
}

/// The pixels `[x0, x1, y0, y1]` that options and a scene's film ask for, which may lie beyond the picture: the film's
/// crop scales with the resolution.
pub(crate) fn asked_crop(film: &scene::Film, options: &RenderOptions) -> [u32; 4] {
    let resolution = options.resolution.unwrap_or(film.resolution);
    let scaled = |v: u32, axis: usize| {
        round_u32(f64::from(v) * f64::from(resolution[axis]) / f64::from(film.resolution[axis]))
    };
    options.crop.unwrap_or_else(|| {
        let [x0, x1, y0, y1] = film.crop;
        [scaled(x0, 0), scaled(x1, 0), scaled(y0, 1), scaled(y1, 1)]
    })
}

impl PreparedScene {
    /// Prepares a copy of a scene, in parallel in rayon's current pool.
    ///
    /// [`PreparedScene::consume`] needs less memory.
    ///
    /// # Errors
    /// Where the picture is empty, the shapes cannot be prepared, or paths are to be shared and something moves.
    pub fn new(scene: &Scene, options: &RenderOptions) -> Result<Self, PrepareError> {
        Self::consume(scene.clone(), options)
    }

    /// Prepares a scene, in parallel in rayon's current pool. Its meshes and pictures are freed as
    /// soon as they are no longer needed.
    ///
    /// # Errors
    /// Where the picture is empty or the shapes cannot be prepared.
    pub fn consume(scene: Scene, options: &RenderOptions) -> Result<Self, PrepareError> {
        Self::consume_after(scene, options, None)
    }

    /// Prepares a scene that was changed, as [`PreparedScene::consume`] does: the tree over the shapes of
    /// the one before is taken over where no shape has changed.
    ///
    /// # Errors
    /// Those of [`PreparedScene::consume`].
    pub fn consume_after(
        mut scene: Scene,
        options: &RenderOptions,
        earlier: Option<Self>,
    ) -> Result<Self, PrepareError> {
        let view = View::new(&scene.camera, &scene.film, options)?;
        options.texture_filter.apply(&mut scene);
        // Lights are sampled by triangles.
        let triangulates = options.triangulate_exact_shapes;
        scene.triangulate_exact_shapes(|s| triangulates || s.emission.is_some());
        let mut textures = Textures::new(&mut scene);
        if options.filter_normal_maps {
            textures.filter_normal_maps(&scene);
        }
        let materials = Materials::new(&scene, &textures, options);
        let earlier = earlier.map(|e| e.geometry);
        let geometry = Geometry::after(&mut scene, &textures, earlier)?;
        if !geometry.is_within_reach() {
            return Err(PrepareError::TooFar);
        }
        let moves = geometry.accel.moves() || view.camera.moves();
        if moves && options.share_paths > 1 {
            return Err(PrepareError::SharedMotion);
        }
        let beside_lobes = options.mis_compensation
            && matches!(
                options.strategy,
                Strategy::Mis | Strategy::Balance | Strategy::Power
            );
        let lights = Lights::new(&scene, &geometry, &textures, beside_lobes);
        let known = |rough: bool| -> Vec<Option<(u32, bool)>> {
            let of = |material: u32| {
                let material = materials.on_path(material, rough);
                let sides = materials.plain(material);
                let is_sided = sides.is_some_and(|[plain, _]| plain.is_sided);
                let bounds = materials.boundary(material).is_some();
                (!bounds).then_some((material, is_sided))
            };
            geometry.shapes.iter().map(|s| of(s.material)).collect()
        };
        let batch_materials = known(false);
        let batch_materials_behind_rough = match materials.are_regularized() {
            true => known(true),
            false => Vec::new(),
        };
        // Behind rough surfaces, too, a place has one material.
        let is_one = batch_materials_behind_rough.is_empty()
            || batch_materials_behind_rough == batch_materials;
        let places = is_one.then(|| Places::new(&geometry, &batch_materials));
        Ok(Self {
            places: places.flatten(),
            camera: view.camera,
            filter: view.filter,
            develop: view.develop,
            resolution: view.resolution,
            crop: view.crop,
            batch_materials,
            batch_materials_behind_rough,
            geometry,
            textures,
            materials,
            lights,
            hide_emitters: scene.settings.hide_emitters,
            moves,
        })
    }

    /// Looks at the scene through another camera, or at another size: nothing else is prepared anew. What is
    /// rendered then are, bit for bit, the samples of the scene with this camera and film, prepared afresh.
    ///
    /// * `options`: those of the render; only resolution, crop and path sharing count here.
    ///
    /// # Errors
    /// Where the picture is empty; the scene stays as it was.
    pub fn look(
        &mut self,
        camera: &scene::Camera,
        film: &scene::Film,
        options: &RenderOptions,
    ) -> Result<(), PrepareError> {
        let view = View::new(camera, film, options)?;
        let moves = self.geometry.accel.moves() || view.camera.moves();
        if moves && options.share_paths > 1 {
            return Err(PrepareError::SharedMotion);
        }
        self.moves = moves;
        self.camera = view.camera;
        self.filter = view.filter;
        self.develop = view.develop;
        self.resolution = view.resolution;
        self.crop = view.crop;
        Ok(())
    }

    /// Material of a shape, and whether its sides are materials of their own in batches; `None` where it bounds a
    /// medium, and is shaded singly.
    ///
    /// * `rough`: whether the path was scattered by a lobe that is not perfectly smooth.
    #[inline(always)]
    pub(crate) fn batch_material(&self, shape: u32, rough: bool) -> Option<(u32, bool)> {
        let behind = rough && !self.batch_materials_behind_rough.is_empty();
        let materials = if behind {
            &self.batch_materials_behind_rough
        } else {
            &self.batch_materials
        };
        materials[shape as usize]
    }

    /// Width and height of the whole picture.
    pub fn resolution(&self) -> [u32; 2] {
        self.resolution
    }

    /// Pixels that are rendered, `[x0, x1, y0, y1]`, half open.
    pub fn crop(&self) -> [u32; 4] {
        self.crop
    }

    /// The file's name for a material, by its index in the scene.
    pub fn material_name(&self, material: usize) -> Option<&str> {
        self.materials.name(material)
    }

    /// The lobe of a material, by its index in the scene; `None` where textures make it vary, where it
    /// is a mix, and where it is measured.
    ///
    /// * `outside`: whether it is seen from the outside of its shape.
    pub fn lobe(&self, material: usize, outside: bool) -> Option<Lobe<f32>> {
        self.materials.constant_lobe(material, outside)
    }

    /// Lights, each emitting triangle, parallelogram, sphere and disk counted.
    pub fn light_count(&self) -> usize {
        self.lights.len()
    }
}
