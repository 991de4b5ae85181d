//! What all requests share.

use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use specula_scene::{LoadOptions, Scene};
use specula_studio::Studio;
use tokio::sync::Semaphore;

use crate::host::Host;
use crate::token::Token;
use crate::{Assets, ServerLimits};

/// Refuses a scene, in words.
pub type Admit = Box<dyn Fn(&Scene) -> Result<(), String> + Send + Sync>;

/// What all requests share.
pub(crate) struct Shared {
    pub(crate) studio: Studio,
    pub(crate) token: Token,
    pub(crate) host: Host,
    pub(crate) assets: Assets,
    pub(crate) limits: ServerLimits,
    /// Places of requests that are being answered.
    pub(crate) asking: Arc<Semaphore>,
    /// The place of the one scene that is read at a time.
    pub(crate) loading: Arc<Semaphore>,
    /// The folder that scenes are opened from.
    pub(crate) folder: PathBuf,
    pub(crate) load: LoadOptions,
    pub(crate) admit: Admit,
    /// Names of scenes that were opened or dropped.
    pub(crate) added: Mutex<HashSet<String>>,
    #[cfg(feature = "lab")]
    pub(crate) lab: crate::desk::Desk,
}
