//! A server for each test, and a client that sends what it is told to, byte by byte.

#![allow(dead_code, reason = "each test file uses a part of this")]
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]

use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread::JoinHandle;
use std::time::Duration;

use serde_json::Value;
use specula_studio_server::{Options, Server, ServerLimits, Stopper};

/// A sphere of metal in a constant environment, at the side of a mesh and a textured one.
pub(crate) const SCENE: &str = r#"
LookAt 0 -4 1  0 0 0  0 0 1
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
LightSource "infinite" "rgb L" [0.7 0.8 1.0]
Texture "tiles" "spectrum" "imagemap" "string filename" "textures/tiles.png"
Material "diffuse" "texture reflectance" "tiles"
Shape "plymesh" "string filename" "geometry/triangle.ply"
"#;

pub(crate) const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
    property float z\nproperty float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\n\
    end_header\n0 0 0 0 0\n1 0 0 1 0\n0 0 1 0 1\n3 0 1 2\n";

/// One grey pixel.
pub(crate) const PNG: &[u8] = b"\
    \x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x01\
    \x00\x00\x00\x01\x08\x00\x00\x00\x00\x3a\x7e\x9b\x55\x00\x00\x00\x0a\x49\x44\x41\x54\x78\x9c\x63\x68\x00\x00\x00\
    \x82\x00\x81\x77\xcd\x72\xb6\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82";

/// A server that ends with the test.
pub(crate) struct Running {
    pub(crate) port: u16,
    pub(crate) token: String,
    stopper: Stopper,
    thread: Option<JoinHandle<()>>,
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stopper.stop();
        if let Some(thread) = self.thread.take() {
            let ended = thread.join();
            assert!(
                ended.is_ok() || std::thread::panicking(),
                "the server panicked"
            );
        }
    }
}

/// Begins to serve.
pub(crate) fn start(options: Options) -> Running {
    let server = Server::bind(options).unwrap();
    let address = server.address();
    let (place, token) = address.split_once("/?token=").unwrap();
    let port = place.rsplit(':').next().unwrap().parse().unwrap();
    let stopper = server.stopper();
    let thread = std::thread::spawn(move || server.run().unwrap());
    Running {
        port,
        token: token.to_owned(),
        stopper,
        thread: Some(thread),
    }
}

/// A server whose patience is short.
pub(crate) fn impatient() -> Options {
    let limits = ServerLimits {
        head_time: Duration::from_millis(400),
        body_time: Duration::from_millis(400),
        drop_bytes: 1 << 20,
        drop_files: 16,
        scenes: 3,
        ..ServerLimits::default()
    };
    Options {
        limits,
        ..Options::default()
    }
}

/// An answer.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: u16,
    headers: Vec<(String, String)>,
    pub(crate) body: Vec<u8>,
}

impl Reply {
    pub(crate) fn header(&self, name: &str) -> Option<&str> {
        let found = self
            .headers
            .iter()
            .find(|(of, _)| of.eq_ignore_ascii_case(name));
        found.map(|(_, value)| value.as_str())
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|e| panic!("{e}: {}", self.text()))
    }

    fn parse(bytes: &[u8]) -> Option<Self> {
        let end = bytes.windows(4).position(|w| w == b"\r\n\r\n")?;
        let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
        let mut lines = head.split("\r\n");
        let status = lines.next()?.split(' ').nth(1)?.parse().ok()?;
        let pair = |line: &str| {
            line.split_once(':')
                .map(|(n, v)| (n.to_owned(), v.trim().to_owned()))
        };
        let headers = lines.filter_map(pair).collect();
        Some(Self {
            status,
            headers,
            body: bytes[end + 4..].to_vec(),
        })
    }
}

/// A request in the making; by default what a page of the studio sends.
pub(crate) struct Request {
    line: String,
    headers: Vec<(String, String)>,
    body: Vec<u8>,
}

impl Request {
    pub(crate) fn get(path: &str) -> Self {
        Self {
            line: format!("GET {path} HTTP/1.1"),
            headers: Vec::new(),
            body: Vec::new(),
        }
    }

    pub(crate) fn post(path: &str, body: impl Into<Vec<u8>>) -> Self {
        Self {
            line: format!("POST {path} HTTP/1.1"),
            headers: Vec::new(),
            body: body.into(),
        }
    }

    /// With a header in the place of the usual one.
    pub(crate) fn with(mut self, name: &str, value: &str) -> Self {
        self.headers.push((name.to_owned(), value.to_owned()));
        self
    }

    /// Without a header that is usual.
    pub(crate) fn without(self, name: &str) -> Self {
        self.with(name, "\0")
    }

    fn bytes(&self, server: &Running) -> Vec<u8> {
        let port = server.port;
        let usual = [
            ("Host", format!("127.0.0.1:{port}")),
            ("Cookie", format!("specula_studio_{port}={}", server.token)),
            ("X-Specula", "1".to_owned()),
            ("Connection", "close".to_owned()),
            ("Content-Length", self.body.len().to_string()),
        ];
        let is_given = |name: &str| {
            self.headers
                .iter()
                .any(|(of, _)| of.eq_ignore_ascii_case(name))
        };
        let mut head = format!("{}\r\n", self.line);
        for (name, value) in usual.iter().filter(|(name, _)| !is_given(name)) {
            head += &format!("{name}: {value}\r\n");
        }
        for (name, value) in self.headers.iter().filter(|(_, value)| value != "\0") {
            head += &format!("{name}: {value}\r\n");
        }
        let mut bytes = (head + "\r\n").into_bytes();
        bytes.extend_from_slice(&self.body);
        bytes
    }

    pub(crate) fn send(&self, server: &Running) -> Reply {
        let reply = exchange(server, &self.bytes(server));
        reply.unwrap_or_else(|| panic!("no answer to {}", self.line))
    }
}

/// Sends bytes; `None` where the server answers nothing.
pub(crate) fn exchange(server: &Running, bytes: &[u8]) -> Option<Reply> {
    let mut stream = connect(server);
    // A server that has refused reads no more.
    let _ = stream.write_all(bytes);
    receive(&mut stream)
}

pub(crate) fn connect(server: &Running) -> TcpStream {
    let stream = TcpStream::connect(("127.0.0.1", server.port)).unwrap();
    stream
        .set_read_timeout(Some(Duration::from_secs(20)))
        .unwrap();
    stream
}

/// All that the server says until it closes the connection.
pub(crate) fn receive(stream: &mut TcpStream) -> Option<Reply> {
    let mut bytes = Vec::new();
    let mut piece = [0; 4096];
    while let Ok(count) = stream.read(&mut piece) {
        if count == 0 {
            break;
        }
        bytes.extend_from_slice(&piece[..count]);
    }
    Reply::parse(&bytes)
}

/// The body of `/api/drop`.
pub(crate) fn dropped(files: &[(&str, &[u8])], scene: Option<&str>) -> Vec<u8> {
    let listed: Vec<Value> = files
        .iter()
        .map(|(path, bytes)| serde_json::json!({"path": path, "bytes": bytes.len()}))
        .collect();
    let mut head = serde_json::json!({ "files": listed });
    if let Some(scene) = scene {
        head["scene"] = scene.into();
    }
    framed(
        &head,
        &files
            .iter()
            .flat_map(|(_, bytes)| bytes.to_vec())
            .collect::<Vec<u8>>(),
    )
}

/// A list and bytes, whether they fit or not.
pub(crate) fn framed(head: &Value, bytes: &[u8]) -> Vec<u8> {
    let head = head.to_string();
    let mut body = u32::try_from(head.len()).unwrap().to_le_bytes().to_vec();
    body.extend_from_slice(head.as_bytes());
    body.extend_from_slice(bytes);
    body
}

/// The JSON of an answer to `/api/ask`.
pub(crate) fn answered(bytes: &[u8]) -> Value {
    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[4..4 + length]).unwrap()
}
