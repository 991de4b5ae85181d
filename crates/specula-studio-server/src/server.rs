//! The server as a whole.

use std::collections::HashSet;
use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use axum::Router;
use axum::extract::{Request, State};
use axum::http::{Method, StatusCode};
use axum::middleware::from_fn_with_state;
use axum::response::{IntoResponse, Response};
use axum::routing::post;
use specula_scene::LoadOptions;
use specula_studio::{GivenScene, SceneFrom, Studio};
use tokio::net::TcpListener;
use tokio::runtime::Runtime;
use tokio::sync::{Notify, Semaphore};

use crate::core::{self, NewScene};
use crate::error::Refusal;
use crate::guard::guard;
use crate::host::Host;
use crate::shared::{Admit, Shared};
use crate::token::Token;
use crate::{Assets, ServerError, ServerLimits, ask, dropped, scenes, serve};

/// What the server's end waits for answers that are being made.
const GRACE: Duration = Duration::from_millis(500);

/// Where and what a [`Server`] serves.
pub struct Options {
    /// Where it listens.
    pub address: IpAddr,
    /// 0: any free one.
    pub port: u16,
    /// The pages' files.
    pub assets: Assets,
    /// The folder that scenes are opened from.
    pub folder: PathBuf,
    /// How scenes are read.
    pub load: LoadOptions,
    /// Refuses scenes that take too much, in words.
    pub admit: Admit,
    /// Bounds on what pages may ask.
    pub limits: ServerLimits,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            address: Ipv4Addr::LOCALHOST.into(),
            port: 0,
            assets: Assets::default(),
            folder: PathBuf::from("."),
            load: LoadOptions::default(),
            admit: Box::new(|_| Ok(())),
            limits: ServerLimits::default(),
        }
    }
}

/// A server that listens.
pub struct Server {
    shared: Arc<Shared>,
    runtime: Runtime,
    listener: TcpListener,
    stop: Arc<Notify>,
}

/// Ends a [`Server`] that runs.
#[derive(Clone, Debug)]
pub struct Stopper(Arc<Notify>);

impl Stopper {
    /// Lets [`Server::run`] return.
    pub fn stop(&self) {
        self.0.notify_one();
    }
}

impl Server {
    /// Listens; browsers wait for [`Server::run`]. What takes threads runs in rayon's global pool.
    ///
    /// # Errors
    ///
    /// Where the address is in use or not of this machine, or the system has no threads or random numbers.
    pub fn bind(options: Options) -> Result<Self, ServerError> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .thread_name("studio")
            .enable_all()
            .build()
            .map_err(ServerError::Serve)?;
        let wanted = SocketAddr::new(options.address, options.port);
        let listener = runtime
            .block_on(TcpListener::bind(wanted))
            .map_err(|e| match e.kind() {
                ErrorKind::AddrInUse => ServerError::InUse(wanted),
                _ => ServerError::Listen(wanted, e),
            })?;
        let port = listener.local_addr().map_err(ServerError::Serve)?.port();
        let folder = options
            .folder
            .canonicalize()
            .map_err(ServerError::io(&options.folder))?;
        let shared = Shared {
            studio: Studio::default().with_files(true),
            token: Token::new()?,
            host: Host {
                port,
                own: options.address,
                is_open: !options.address.is_loopback(),
            },
            assets: options.assets,
            asking: Arc::new(Semaphore::new(options.limits.asks)),
            loading: Arc::new(Semaphore::new(1)),
            limits: options.limits,
            folder,
            load: options.load,
            admit: options.admit,
            added: Mutex::new(HashSet::new()),
            #[cfg(feature = "lab")]
            lab: crate::desk::Desk::new().map_err(ServerError::Serve)?,
        };
        Ok(Self {
            shared: Arc::new(shared),
            runtime,
            listener,
            stop: Arc::default(),
        })
    }

    /// What the user opens, with the token.
    #[must_use]
    pub fn address(&self) -> String {
        let Host { own, port, .. } = self.shared.host;
        // Every address of the machine is listened on; this one leads to it from here.
        let own = match own.is_unspecified() {
            true => IpAddr::V4(Ipv4Addr::LOCALHOST),
            false => own,
        };
        format!(
            "http://{}/?token={}",
            SocketAddr::new(own, port),
            self.shared.token.text()
        )
    }

    /// Adds a scene that pages find under its title.
    pub fn add_scene(&self, title: &str, scene: impl Into<GivenScene>) {
        let (name, title) = (format!("given:{title}"), title.to_owned());
        let (from, scene) = (SceneFrom::Given, scene.into());
        core::add_scene(
            &self.shared.studio,
            NewScene {
                name,
                title,
                from,
                scene,
            },
        );
    }

    /// Ends [`Server::run`], from another thread.
    #[must_use]
    pub fn stopper(&self) -> Stopper {
        Stopper(Arc::clone(&self.stop))
    }

    /// Serves until it is stopped. What is being answered then may be left unanswered.
    ///
    /// # Errors
    ///
    /// None so far: what goes wrong with a connection ends that one.
    pub fn run(self) -> Result<(), ServerError> {
        let Self {
            shared,
            runtime,
            listener,
            stop,
        } = self;
        runtime.spawn(close_idle(Arc::clone(&shared)));
        let pages = router(Arc::clone(&shared));
        runtime.block_on(serve::serve(&listener, pages, &shared.limits, &stop));
        drop(listener);
        #[cfg(feature = "lab")]
        shared.lab.end();
        runtime.shutdown_timeout(GRACE);
        Ok(())
    }
}

/// Renders of pages that have gone away end.
async fn close_idle(shared: Arc<Shared>) {
    let idle = shared.limits.idle_time;
    loop {
        tokio::time::sleep(idle / 4).await;
        core::close_idle(&shared.studio, idle);
    }
}

fn router(shared: Arc<Shared>) -> Router {
    let pages = Router::new()
        .route("/api/ask", post(ask::ask))
        .route("/api/open", post(scenes::open))
        .route("/api/drop", post(dropped::drop))
        .fallback(page);
    #[cfg(feature = "lab")]
    let pages = pages.merge(crate::lab::routes());
    #[cfg(not(feature = "lab"))]
    let pages = pages
        .route("/api/lab", axum::routing::get(no_laboratory))
        .route("/api/lab/status", axum::routing::get(no_laboratory));
    pages
        .layer(from_fn_with_state(Arc::clone(&shared), guard))
        .with_state(shared)
}

#[cfg(not(feature = "lab"))]
async fn no_laboratory() -> Refusal {
    Refusal::new(
        StatusCode::NOT_FOUND,
        "this program is built without the laboratory",
    )
}

/// A file of the pages.
async fn page(State(shared): State<Arc<Shared>>, request: Request) -> Response {
    match request.method() {
        &Method::GET | &Method::HEAD => shared
            .assets
            .response(request.uri().path(), request.headers()),
        _ => Refusal::new(StatusCode::NOT_FOUND, "nothing takes this").into_response(),
    }
}
