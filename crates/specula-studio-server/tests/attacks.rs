//! Attacks on the server, each refused.

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::Duration;

use specula_studio_server::{Options, Server, Stopper};

struct Running {
    port: u16,
    token: String,
    stopper: Stopper,
    thread: Option<std::thread::JoinHandle<()>>,
    folder: tempfile::TempDir,
}

impl Running {
    fn start() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .expect("threads");
        let options = Options {
            folder: folder.path().join("scenes"),
            ..Options::default()
        };
        std::fs::create_dir(folder.path().join("scenes")).expect("a folder");
        let server = Server::bind(options, pool).expect("a free port");
        let address = server.address();
        let (host, token) = address.split_once("/?token=").expect("a token");
        let port = host
            .rsplit(':')
            .next()
            .and_then(|p| p.parse().ok())
            .expect("a port");
        let (token, stopper) = (token.to_owned(), server.stopper());
        let thread = Some(std::thread::spawn(move || server.run().expect("served")));
        Self {
            port,
            token,
            stopper,
            thread,
            folder,
        }
    }

    /// Sends bytes; the status and the whole answer.
    fn send(&self, bytes: &[u8]) -> (u16, String) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("connected");
        stream
            .set_read_timeout(Some(Duration::from_secs(20)))
            .expect("a time-out");
        // A refusal may come before all has been sent.
        let _ = stream.write_all(bytes);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let status = answer
            .split(' ')
            .nth(1)
            .and_then(|s| s.parse().ok())
            .unwrap_or(0);
        (status, answer)
    }

    /// A request with these headers in place of the honest ones of their names; an empty value leaves one out.
    fn ask(&self, method: &str, path: &str, body: &str, other: &[(&str, &str)]) -> (u16, String) {
        let host = format!("127.0.0.1:{}", self.port);
        let cookie = format!("specula_studio_{}={}", self.port, self.token);
        let origin = format!("http://{host}");
        let honest = [
            ("Host", host.as_str()),
            ("Cookie", cookie.as_str()),
            ("Origin", origin.as_str()),
            ("X-Specula", "1"),
            ("Content-Type", "application/json"),
            ("Connection", "close"),
        ];
        let mut text = format!(
            "{method} {path} HTTP/1.1\r\nContent-Length: {}\r\n",
            body.len()
        );
        for (name, value) in honest {
            let changed = other.iter().find(|(n, _)| *n == name).map(|(_, v)| *v);
            let value = changed.unwrap_or(value);
            if !value.is_empty() {
                text += &format!("{name}: {value}\r\n");
            }
        }
        for (name, value) in other
            .iter()
            .filter(|(n, _)| !honest.iter().any(|(h, _)| h == n))
        {
            text += &format!("{name}: {value}\r\n");
        }
        self.send(format!("{text}\r\n{body}").as_bytes())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stopper.stop();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

const ASK: &str = r#"{"ask": "render.scenes"}"#;

#[test]
fn who_is_honest_is_answered() {
    let studio = Running::start();
    let (status, answer) = studio.ask("POST", "/api/ask", ASK, &[]);
    assert_eq!(status, 200, "{answer}");
    assert!(answer.contains("orbs"), "{answer}");
    let (status, answer) = studio.ask(
        "GET",
        &format!("/?token={}", studio.token),
        "",
        &[("Cookie", "")],
    );
    assert!((300..400).contains(&status), "{answer}");
    let answer = answer.to_ascii_lowercase();
    assert!(
        answer.contains("httponly") && answer.contains("samesite=strict"),
        "{answer}"
    );
}

#[test]
fn without_the_token_nothing_is_answered() {
    let studio = Running::start();
    for cookie in ["", "specula_studio=1", "specula_studio_1=x"] {
        let (status, answer) = studio.ask("POST", "/api/ask", ASK, &[("Cookie", cookie)]);
        assert_eq!(status, 403, "{cookie}: {answer}");
    }
    let wrong = format!(
        "specula_studio_{}={}",
        studio.port,
        "A".repeat(studio.token.len())
    );
    assert_eq!(
        studio.ask("POST", "/api/ask", ASK, &[("Cookie", &wrong)]).0,
        403
    );
    assert_eq!(
        studio.ask("GET", "/?token=guess", "", &[("Cookie", "")]).0,
        403
    );
}

#[test]
fn names_that_were_bound_to_this_machine_are_refused() {
    let studio = Running::start();
    for host in [
        "evil.example",
        "evil.example:80",
        "127.0.0.1.evil.example",
        "127.0.0.1:1",
    ] {
        let (status, answer) = studio.ask("POST", "/api/ask", ASK, &[("Host", host)]);
        assert_eq!(status, 403, "{host}: {answer}");
        assert_eq!(
            studio.ask("GET", "/", "", &[("Host", host)]).0,
            403,
            "{host}"
        );
    }
}

#[test]
fn other_sites_are_refused_and_never_allowed_to_read() {
    let studio = Running::start();
    for origin in [
        "http://evil.example",
        "null",
        "http://127.0.0.1:1",
        "https://127.0.0.1",
    ] {
        let (status, answer) = studio.ask("POST", "/api/ask", ASK, &[("Origin", origin)]);
        assert_eq!(status, 403, "{origin}: {answer}");
        assert!(
            !answer.to_ascii_lowercase().contains("access-control"),
            "{answer}"
        );
    }
    assert_eq!(
        studio
            .ask("POST", "/api/ask", ASK, &[("Sec-Fetch-Site", "cross-site")])
            .0,
        403
    );
    assert_eq!(
        studio.ask("POST", "/api/ask", ASK, &[("X-Specula", "")]).0,
        403
    );
    let (status, answer) = studio.ask(
        "OPTIONS",
        "/api/ask",
        "",
        &[("Origin", "http://evil.example")],
    );
    assert!(
        status >= 400 && !answer.to_ascii_lowercase().contains("access-control"),
        "{answer}"
    );
}

#[test]
fn pages_come_with_a_strict_policy() {
    let studio = Running::start();
    let (status, answer) = studio.ask("GET", "/", "", &[]);
    assert_eq!(status, 200, "{answer}");
    let head = answer.to_ascii_lowercase();
    for held in [
        "content-security-policy: default-src 'none'",
        "frame-ancestors 'none'",
        "x-content-type-options: nosniff",
        "referrer-policy: no-referrer",
    ] {
        assert!(head.contains(held), "{held}: {head}");
    }
    let scripts = head
        .split("script-src")
        .nth(1)
        .and_then(|s| s.split(';').next());
    assert!(
        !scripts.unwrap_or_default().contains("unsafe-inline"),
        "{head}"
    );
}

#[test]
fn paths_lead_nowhere_else() {
    let studio = Running::start();
    std::fs::write(studio.folder.path().join("secret.pbrt"), "Film \"rgb\"").expect("written");
    for path in [
        "/../Cargo.toml",
        "/%2e%2e/Cargo.toml",
        "/..%2fCargo.toml",
        "//etc/passwd",
        "/etc/passwd",
    ] {
        let (status, answer) = studio.ask("GET", path, "", &[]);
        assert!(
            status == 404 || status == 400 || status == 403,
            "{path}: {answer}"
        );
    }
    let folder = studio.folder.path();
    let absolute = folder.join("secret.pbrt").display().to_string();
    #[cfg(unix)]
    std::os::unix::fs::symlink(&absolute, folder.join("scenes/link.pbrt")).expect("a link");
    for path in [
        "../secret.pbrt",
        "/etc/passwd",
        "./../secret.pbrt",
        &absolute,
        "link.pbrt",
        "..",
    ] {
        let body = format!(r#"{{"path": "{path}"}}"#);
        let (status, answer) = studio.ask("POST", "/api/open", &body, &[]);
        assert!((400..500).contains(&status), "{path}: {answer}");
        assert!(!answer.contains("rgb"), "{path}: {answer}");
    }
}

#[test]
fn floods_are_cut_off() {
    let studio = Running::start();
    let large = format!(r#"{{"ask": "{}"}}"#, "x".repeat(2 << 20));
    let (status, answer) = studio.ask("POST", "/api/ask", &large, &[]);
    assert_eq!(status, 413, "{}", &answer[..answer.len().min(300)]);
    let mut heads = format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n", studio.port);
    for i in 0..500 {
        heads += &format!("X-{i}: y\r\n");
    }
    let (status, _) = studio.send(format!("{heads}\r\n").as_bytes());
    assert!(status == 431 || status == 400 || status == 0, "{status}");
    let (status, _) = studio.send(b"\x00\xff\x16\x03 nonsense\r\n\r\n");
    assert!(status == 400 || status == 0, "{status}");
    // It still answers.
    assert_eq!(studio.ask("POST", "/api/ask", ASK, &[]).0, 200);
}

#[test]
fn what_is_no_request_is_refused_in_words() {
    let studio = Running::start();
    for body in [
        "",
        "{}",
        "[]",
        "{\"ask\": 1}",
        "{\"ask\": \"files.read\", \"path\": \"/etc/passwd\"}",
    ] {
        let (status, answer) = studio.ask("POST", "/api/ask", body, &[]);
        assert!(status == 200 || status == 400, "{answer}");
        assert!(answer.contains("error") || status == 400, "{answer}");
    }
}
