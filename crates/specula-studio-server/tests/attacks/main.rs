//! What the server refuses: strangers, other sites' pages, paths that lead away, too much of anything.

#[path = "../common/mod.rs"]
mod common;
mod excess;
mod paths;
mod strangers;

use common::{Request, Running};

const ASK: &str = r#"{"ask": "lobes.kinds"}"#;

/// Sends a drop; its status and words.
fn drop_on(server: &Running, body: Vec<u8>) -> (u16, String) {
    let reply = Request::post("/api/drop", body).send(server);
    (reply.status, reply.text())
}
