//! A session: a scene with its changes, prepared, and the samples so far.

use serde::Deserialize;
use serde_json::{Value, json};
use specula_render::{FilmBuffer, PreparedScene, RenderOptions, Renderer, screen_window};
use specula_scene::Scene;
use specula_scene::scene::Camera;
use specula_scene::summary::Summary;

use super::catalogue::Named;
use super::changes::{Asked, Changes, ENERGIES, MaterialEdit, check_depth, check_seed};
use super::view::View;
use super::{gpu, materials};
use crate::{Answer, AskError};

/// `render.open`
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Open {
    pub(super) scene: String,
    width: Option<u32>,
    height: Option<u32>,
    seed: Option<u64>,
    max_depth: Option<u32>,
    camera: Option<View>,
    #[serde(default)]
    edits: Vec<MaterialEdit>,
    energy: Option<String>,
    sampler: Option<String>,
}

/// `render.change`
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Change {
    pub(super) session: u64,
    camera: Option<View>,
    #[serde(default)]
    edits: Vec<MaterialEdit>,
    energy: Option<String>,
    sampler: Option<String>,
    width: Option<u32>,
    height: Option<u32>,
}

/// A render that is open.
#[derive(Debug)]
pub(super) struct Session {
    pub(super) scene: Named,
    pub(super) changes: Changes,
    pub(super) options: RenderOptions,
    /// `None`: preparing it failed, or was interrupted.
    prepared: Option<PreparedScene>,
    /// What WebGPU cannot render of it: of its textures and its size, which no change touches.
    missing: Vec<String>,
    /// `None`: no sample was taken yet.
    film: Option<FilmBuffer>,
    /// The view of the scene's own camera; `None`: it has no perspective.
    own_view: Option<View>,
    triangles: u64,
    pub(super) progress: Progress,
}

/// What was done for the film.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    /// Spent on samples.
    pub(super) seconds: f64,
    pub(super) rays: u64,
    /// Seconds that a sample of every pixel took lately; stays when a render begins anew.
    pub(super) per_sample: Option<f64>,
}

impl Session {
    pub(super) fn open(scene: Named, asked: Open) -> Result<Self, AskError> {
        let own = &scene.given.scene;
        let first = Changes {
            seed: check_seed(asked.seed)?,
            max_depth: check_depth(asked.max_depth)?,
            ..Changes::default()
        };
        let wanted = Asked {
            camera: None,
            edits: asked.edits,
            energy: asked.energy,
            sampler: asked.sampler,
            width: asked.width,
            height: asked.height,
        };
        let changes = first.with(wanted, own)?;
        let options = options(own, &changes);
        let mut changed = own.clone();
        changes.apply(&mut changed)?;
        let triangles = Summary::of(own).triangles_shown;
        let prepared = PreparedScene::consume(changed, &options).map_err(unprepared)?;
        let mut session = Self {
            own_view: own_view(&scene.given.scene, &prepared),
            missing: gpu::missing(&prepared, &options),
            scene,
            changes,
            options,
            prepared: Some(prepared),
            film: None,
            triangles,
            progress: Progress::default(),
        };
        if let Some(camera) = asked.camera {
            let more = Asked {
                camera: Some(camera),
                ..Asked::default()
            };
            session.apply(more)?;
        }
        Ok(session)
    }

    /// Answers `render.change`.
    pub(super) fn change(&mut self, id: u64, asked: Change) -> Result<Answer, AskError> {
        self.apply(Asked {
            camera: asked.camera,
            edits: asked.edits,
            energy: asked.energy,
            sampler: asked.sampler,
            width: asked.width,
            height: asked.height,
        })?;
        Ok(Answer::new(self.described(id)))
    }

    /// Changes the render, which begins anew. Where it fails, all is as before.
    fn apply(&mut self, asked: Asked) -> Result<(), AskError> {
        let given = self.scene.given.clone();
        let own = &given.scene;
        let changes = self.changes.with(asked, own)?;
        let camera = self.camera(&changes)?;
        let options = options(own, &changes);
        if changes.differ_in_surfaces(&self.changes) || self.prepared.is_none() {
            let mut changed = own.clone();
            changed.camera = camera;
            changes.apply(&mut changed)?;
            let earlier = self.prepared.take();
            let prepared = PreparedScene::consume_after(changed, &options, earlier);
            let prepared = prepared.map_err(unprepared)?;
            self.prepared = Some(prepared);
        } else if let Some(prepared) = &mut self.prepared {
            prepared
                .look(&camera, &own.film, &options)
                .map_err(unprepared)?;
        }
        self.changes = changes;
        self.options = options;
        self.film = None;
        self.progress = Progress {
            per_sample: self.progress.per_sample,
            ..Progress::default()
        };
        Ok(())
    }

    /// The camera of changes: the scene's own where they have none, or its very view.
    fn camera(&self, changes: &Changes) -> Result<Camera, AskError> {
        let own = &self.scene.given.scene;
        match (changes.camera, self.own_view) {
            (None, _) => Ok(own.camera.clone()),
            (Some(view), Some(of_scene)) if view == of_scene => Ok(own.camera.clone()),
            (Some(view), _) => view.camera(&own.camera, &own.film),
        }
    }

    /// The value that answers `render.open`.
    pub(super) fn described(&self, id: u64) -> Value {
        let given = &self.scene.given;
        let [width, height] = self.resolution();
        json!({
            "session": id,
            "width": width,
            "height": height,
            "camera": self.changes.camera.or(self.own_view),
            "materials": materials::list(&given.scene, &self.changes),
            "warnings": given.warnings,
            "energies": ENERGIES,
            "missing": self.missing,
            "triangles": self.triangles,
        })
    }

    /// The scene as it is rendered: with its changes.
    pub(super) fn changed_scene(&self) -> Result<Scene, AskError> {
        let mut scene = self.scene.given.scene.clone();
        scene.camera = self.camera(&self.changes)?;
        self.changes.apply(&mut scene)?;
        let (resolution, file) = (self.resolution(), scene.film.resolution);
        scene.camera.screen_window = screen_window(&scene.camera, file, resolution);
        scene.film.resolution = resolution;
        scene.film.crop = [0, resolution[0], 0, resolution[1]];
        scene.settings.max_depth = self.options.max_depth;
        scene.settings.energy = self.options.energy;
        Ok(scene)
    }

    pub(super) fn resolution(&self) -> [u32; 2] {
        self.changes.resolution(&self.scene.given.scene)
    }

    pub(super) fn prepared(&self) -> Result<&PreparedScene, AskError> {
        let lost = || AskError::new("the scene could not be prepared: open it anew");
        self.prepared.as_ref().ok_or_else(lost)
    }

    /// The film; `None`: no sample was taken yet.
    pub(super) fn film(&self) -> Option<&FilmBuffer> {
        self.film.as_ref()
    }

    /// Goes on with the render; what it gathers stays.
    pub(super) fn with_renderer<T>(
        &mut self,
        act: impl FnOnce(&mut Renderer<'_>, &mut Progress) -> T,
    ) -> Result<T, AskError> {
        let film = self.film.take();
        let mut progress = self.progress;
        let (prepared, options) = (self.prepared()?, self.options.clone());
        let mut renderer = match film {
            Some(film) => Renderer::resume(prepared, options, film)
                .map_err(|e| AskError::new(format!("the render cannot go on: {e}")))?,
            None => Renderer::new(prepared, options),
        };
        let done = act(&mut renderer, &mut progress);
        let film = renderer.into_film();
        self.film = Some(film);
        self.progress = progress;
        Ok(done)
    }
}

/// The options of a render: the whole picture, and what the changes say.
fn options(scene: &Scene, changes: &Changes) -> RenderOptions {
    let [width, height] = changes.resolution(scene);
    let asked = RenderOptions::from_scene(scene);
    RenderOptions {
        seed: changes.seed,
        max_depth: changes.max_depth.unwrap_or(asked.max_depth),
        energy: changes.energy.unwrap_or(asked.energy),
        vndf_sampler: changes.sampler.unwrap_or(asked.vndf_sampler),
        resolution: Some([width, height]),
        crop: Some([0, width, 0, height]),
        // Pages render the same arrays by WebGPU.
        triangulate_exact_shapes: true,
        ..asked
    }
}

/// The view of the scene's camera, its target where the middle of the picture meets a surface.
fn own_view(scene: &Scene, prepared: &PreparedScene) -> Option<View> {
    let [width, height] = prepared.resolution();
    let middle = [0.5 * width as f32, 0.5 * height as f32];
    let distance = prepared.seen(middle).map(|seen| f64::from(seen.distance));
    let distance = distance.filter(|&d| d > 0.0).unwrap_or(1.0);
    View::of(&scene.camera, distance)
}

fn unprepared(error: specula_render::PrepareError) -> AskError {
    AskError::new(format!("the scene cannot be rendered: {error}"))
}
