//! Serves the studio to a browser: its pages, the library's answers, scenes, the laboratory.
//!
//! ```no_run
//! use specula_studio_server::{Options, Server};
//!
//! let server = Server::bind(Options::default())?;
//! println!("{}", server.address());
//! server.run()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! All that a page can ask for:
//!
//! | request | what |
//! |---|---|
//! | `GET /?token=T` | lets the browser in, by a cookie |
//! | `GET /`, `/studio.js`, ... | the pages' files |
//! | `POST /api/ask` | an answer of [`specula_studio::Studio`] |
//! | `POST /api/open` | `{"path"}`: opens a scene of the folder |
//! | `POST /api/drop` | opens a scene whose files are sent: `src/dropped.rs` |
//! | `GET /api/lab`, `GET /api/lab/status` | experiments; how far their run is |
//! | `POST /api/lab/run`, `POST /api/lab/stop` | `{"ids", "quality", "seed"}`: runs experiments; ends the run |
//! | `GET /lab/report/` | the report of what was run |
#![forbid(unsafe_code)]

mod ask;
mod assets;
mod body;
mod core;
#[cfg(feature = "lab")]
mod desk;
mod dropped;
mod error;
mod export;
mod guard;
mod host;
#[cfg(feature = "lab")]
mod lab;
mod limits;
mod places;
mod scenes;
mod serve;
mod server;
mod shared;
mod token;

pub use assets::Assets;
pub use error::ServerError;
pub use export::export;
pub use limits::ServerLimits;
pub use server::{Options, Server, Stopper};
pub use shared::Admit;
pub use specula_studio::GivenScene;
