//! Scenes that pages open by path, and what reading one answers.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, MutexGuard, PoisonError};

use axum::body::Body;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use serde::Deserialize;
use serde_json::{Value, json};
use specula_scene::{LoadOptions, SceneError, Warning};
use specula_studio::{GivenScene, SceneFrom};
use tokio::sync::OwnedSemaphorePermit;

use crate::core::{self, NewScene};
use crate::error::{Refusal, json_response};
use crate::shared::Shared;
use crate::{body, places};

/// Most warnings that pages are told.
const MOST_WARNINGS: usize = 100;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Open {
    /// Relative to the folder that scenes are opened from, or absolute and in it.
    path: String,
}

/// `POST /api/open`: a scene of the folder.
pub(crate) async fn open(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    body: Body,
) -> Result<Response, Refusal> {
    let Open { path } = body::json(&headers, body, shared.limits.body_time).await?;
    let folder = shared.folder.clone();
    let Some(path) = places::file_within(&folder, Path::new(&path)) else {
        let message = format!(
            "'{path}' is no file in the folder of the studio, {}",
            folder.display()
        );
        return Err(Refusal::new(StatusCode::NOT_FOUND, message));
    };
    let place = Arc::clone(&shared.loading).acquire_owned().await;
    let place = place.map_err(|_| Refusal::internal("the studio is ending"))?;
    let options = shared.load.clone();
    let value = read(
        shared,
        place,
        Reading {
            folder,
            path,
            options,
            from: SceneFrom::Given,
        },
    )
    .await?;
    Ok(json_response(&value))
}

/// A scene that is about to be read.
pub(crate) struct Reading {
    /// What names are relative to.
    pub(crate) folder: PathBuf,
    pub(crate) path: PathBuf,
    pub(crate) options: LoadOptions,
    pub(crate) from: SceneFrom,
}

/// Reads a scene and adds it; its name, title and warnings.
pub(crate) async fn read(
    shared: Arc<Shared>,
    place: OwnedSemaphorePermit,
    reading: Reading,
) -> Result<Value, Refusal> {
    let work = move || {
        let _place = place;
        read_now(&shared, &reading)
    };
    let read = tokio::task::spawn_blocking(work).await;
    read.map_err(|_| {
        Refusal::internal("this scene met a fault in Specula; its terminal says more")
    })?
}

fn read_now(shared: &Shared, reading: &Reading) -> Result<Value, Refusal> {
    let title = places::shown(&reading.folder, &reading.path);
    let prefix = match reading.from {
        SceneFrom::Dropped => "dropped",
        SceneFrom::Given | SceneFrom::BuiltIn => "given",
    };
    let name = format!("{prefix}:{title}");
    ensure_room(shared, &name)?;
    let loaded = specula_scene::load_with(&reading.path, &reading.options)
        .map_err(|error| located(&reading.folder, &error))?;
    (shared.admit)(&loaded.scene).map_err(|e| Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, e))?;
    let said = |w: &Warning| {
        let file = places::shown(&reading.folder, Path::new(w.file()));
        let message = places::without(&reading.folder, w.message());
        format!("{file}:{}:{}: {message}", w.line(), w.column())
    };
    let warnings: Vec<String> = loaded
        .warnings
        .iter()
        .take(MOST_WARNINGS)
        .map(said)
        .collect();
    let value = json!({ "name": name, "title": title, "warnings": warnings });
    let scene = GivenScene {
        scene: loaded.scene,
        warnings,
    };
    added(shared).insert(name.clone());
    core::add_scene(
        &shared.studio,
        NewScene {
            name,
            title,
            from: reading.from,
            scene,
        },
    );
    Ok(value)
}

fn added(shared: &Shared) -> MutexGuard<'_, HashSet<String>> {
    shared.added.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Fails where no further scene is kept; one of the same name is replaced. Scenes are read one at a time.
fn ensure_room(shared: &Shared, name: &str) -> Result<(), Refusal> {
    let added = added(shared);
    if added.len() < shared.limits.scenes || added.contains(name) {
        return Ok(());
    }
    let message = format!(
        "{} scenes are open, and no more can be: start the studio anew",
        added.len()
    );
    Err(Refusal::new(StatusCode::CONFLICT, message))
}

/// A scene's error with its place.
fn located(folder: &Path, error: &SceneError) -> Refusal {
    // Options of the command line are no help to a page.
    let help = error.help().filter(|help| !help.contains("--"));
    let value = json!({
        "error": places::without(folder, error.message()),
        "file": places::shown(folder, Path::new(error.file())),
        "line": error.line(),
        "column": error.column(),
        "help": help.map(|help| places::without(folder, help)),
    });
    Refusal::of(StatusCode::UNPROCESSABLE_ENTITY, value)
}
