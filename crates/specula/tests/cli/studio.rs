//! `specula studio`: from the line that it prints to Ctrl-C.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use crate::common::{heeding_signals, names, run, send, small_scene, succeed};

/// A studio that was started.
struct Studio {
    child: Child,
    port: u16,
    token: String,
}

impl Drop for Studio {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Studio {
    /// Waits for the line with the address.
    fn start(folder: &Path, arguments: &[&str]) -> Self {
        let mut child = heeding_signals()
            .current_dir(folder)
            .env("TMPDIR", folder)
            .args(["studio", "--no-open", "--threads", "1"])
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("a pipe");
        BufReader::new(out).read_line(&mut line).expect("a line");
        let rest = line.strip_prefix("studio: http://127.0.0.1:");
        let (port, token) = rest
            .and_then(|r| r.trim().split_once("/?token="))
            .unwrap_or_else(|| panic!("{line}"));
        let (port, token) = (port.parse().expect("a port"), token.to_owned());
        Self { child, port, token }
    }

    /// The answer to a request of a page.
    fn ask(&self, line: &str, body: &str) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("it listens");
        let request = format!(
            "{line} HTTP/1.1\r\nHost: 127.0.0.1:{0}\r\nCookie: specula_studio_{0}={1}\r\nX-Specula: 1\r\n\
             Connection: close\r\nContent-Length: {2}\r\n\r\n{body}",
            self.port,
            self.token,
            body.len()
        );
        stream.write_all(request.as_bytes()).expect("it reads");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("it answers");
        String::from_utf8_lossy(&answer).into_owned()
    }
}

#[test]
fn it_serves_until_it_is_interrupted() {
    let (folder, _) = small_scene();
    let mut studio = Studio::start(folder.path(), &["small.pbrt"]);
    assert!(studio.ask("GET /", "").starts_with("HTTP/1.1 200"));
    let scenes = studio.ask("POST /api/ask", r#"{"ask": "render.scenes"}"#);
    assert!(scenes.contains(r#""title":"small""#), "{scenes}");
    let opened = studio.ask("POST /api/open", r#"{"path": "small.pbrt"}"#);
    assert!(opened.contains(r#""name":"given:small.pbrt""#), "{opened}");
    send("INT", studio.child.id());
    let ended = studio.child.wait().expect("it ends");
    assert_eq!(ended.code(), Some(130));
    assert_eq!(names(folder.path()), ["small.pbrt"], "nothing is left");
}

#[test]
fn a_scene_that_cannot_be_read_is_named_with_its_place() {
    let (folder, scene) = small_scene();
    let (code, said) = run(folder.path(), &["studio", "--no-open", "none.pbrt"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("none.pbrt"), "{said}");
    std::fs::write(&scene, "WorldBegin\nShape \"dodecahedron\"\n").expect("a writable folder");
    let (code, said) = run(folder.path(), &["studio", "--no-open", "small.pbrt"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("small.pbrt:2:7"), "{said}");
    std::fs::write(&scene, crate::common::SMALL).expect("a writable folder");
    let (code, said) = run(
        folder.path(),
        &["studio", "--no-open", "small.pbrt", "--max-memory", "1kB"],
    );
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("--max-memory"), "{said}");
}

#[test]
fn addresses_that_cannot_be_had_are_named() {
    let (folder, _) = small_scene();
    let taken = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let port = taken.local_addr().expect("an address").port().to_string();
    let (code, said) = run(folder.path(), &["studio", "--no-open", "--port", &port]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains(&port) && said.contains("in use"), "{said}");
    let (code, said) = run(
        folder.path(),
        &["studio", "--no-open", "--listen", "203.0.113.7"],
    );
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("203.0.113.7"), "{said}");
    for bad in [
        ["--port", "70000"],
        ["--port", "x"],
        ["--listen", "evil.example"],
        ["--wasm", "a.wasm"],
    ] {
        let (code, said) = run(folder.path(), &[&["studio"], &bad[..]].concat());
        assert_eq!(code, Some(2), "{bad:?}: {said}");
    }
}

#[test]
fn others_are_let_in_with_a_warning() {
    let (folder, _) = small_scene();
    let mut child = Command::new(env!("CARGO_BIN_EXE_specula"))
        .current_dir(folder.path())
        .args(["studio", "--no-open", "--listen", "0.0.0.0"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut said = String::new();
    let read = BufReader::new(child.stderr.take().expect("a pipe")).read_line(&mut said);
    send("TERM", child.id());
    let ended = child.wait().expect("it ends");
    read.expect("a line");
    assert!(
        said.contains("warning") && said.contains("0.0.0.0"),
        "{said}"
    );
    assert_eq!(ended.code(), Some(143));
}

#[test]
fn the_pages_are_exported() {
    let (folder, _) = small_scene();
    std::fs::write(folder.path().join("a.wasm"), b"\0asm\x01\0\0\0").expect("a writable folder");
    succeed(
        folder.path(),
        &["studio", "--export", "site", "--wasm", "a.wasm"],
    );
    let site = names(&folder.path().join("site"));
    for name in [
        "index.html",
        "licences.txt",
        "specula-studio.wasm.js",
        "studio.css",
        "studio.js",
    ] {
        assert!(site.iter().any(|of| of == name), "{site:?}");
    }
    succeed(folder.path(), &["studio", "--export", "site"]);
    let (code, said) = run(folder.path(), &["studio", "--export", "."]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("other files"), "{said}");
    let (code, said) = run(
        folder.path(),
        &["studio", "--export", "new", "--wasm", "none.wasm"],
    );
    assert_eq!(code, Some(2), "{said}");
    assert!(
        said.contains("none.wasm") && !folder.path().join("new").exists(),
        "{said}"
    );
}
