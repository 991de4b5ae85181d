//! What the server refuses: strangers, other sites' pages, paths that lead away, too much of anything.

mod common;

use std::io::{Read, Write};
use std::time::{Duration, Instant};

use common::{
    PNG, Request, Running, SCENE, connect, dropped, exchange, framed, impatient, receive, start,
};
use serde_json::json;
use specula_studio_server::{Assets, Options, ServerLimits};

const ASK: &str = r#"{"ask": "lobes.kinds"}"#;

#[test]
fn nobody_is_let_in_without_the_token() {
    let server = start(Options::default());
    let cookie = |value: &str| format!("specula_studio_{}={value}", server.port);
    let token = server.token.clone();
    for path in [
        "/",
        "/studio.js",
        "/api/lab",
        "/api/lab/status",
        "/lab/report/",
        "/api/ask",
    ] {
        for wrong in [
            "",
            "x",
            &token[1..],
            &token.to_uppercase(),
            &format!("{token}{token}"),
        ] {
            let reply = Request::get(path)
                .with("Cookie", &cookie(wrong))
                .send(&server);
            assert_eq!(reply.status, 403, "{path} {wrong}");
        }
        assert_eq!(
            Request::get(path).without("Cookie").send(&server).status,
            403,
            "{path}"
        );
    }
    for path in [
        "/api/ask",
        "/api/open",
        "/api/drop",
        "/api/lab/run",
        "/api/lab/stop",
    ] {
        assert_eq!(
            Request::post(path, ASK)
                .without("Cookie")
                .send(&server)
                .status,
            403,
            "{path}"
        );
        // The token in the address is for the first page alone.
        let reply = Request::post(&format!("{path}?token={token}"), ASK)
            .without("Cookie")
            .send(&server);
        assert_eq!(reply.status, 403, "{path}");
    }
    for query in [
        "/?token=",
        "/?token=x",
        "/?Token=",
        &format!("/?x=1&token={token}"),
        &format!("/?token={token}x"),
    ] {
        let reply = Request::get(query).without("Cookie").send(&server);
        assert_eq!(
            (reply.status, reply.header("set-cookie")),
            (403, None),
            "{query}"
        );
    }
    // The cookie of another studio on this machine.
    let other = format!("specula_studio_1={token}");
    assert_eq!(
        Request::get("/")
            .with("Cookie", &other)
            .send(&server)
            .status,
        403
    );
    assert!(token.len() >= 22, "128 bits");
    assert_ne!(start(Options::default()).token, token);
}

#[test]
fn names_that_were_made_to_lead_here_are_refused() {
    let server = start(Options::default());
    let port = server.port;
    for host in [
        format!("evil.example:{port}"),
        format!("127.0.0.1.evil.example:{port}"),
        format!("localhost.evil.example:{port}"),
        format!("192.168.0.1:{port}"),
        format!("user@127.0.0.1:{port}"),
        "127.0.0.1".to_owned(),
        "localhost:1".to_owned(),
        String::new(),
    ] {
        assert_eq!(
            Request::get("/").with("Host", &host).send(&server).status,
            403,
            "{host}"
        );
        assert_eq!(
            Request::post("/api/ask", ASK)
                .with("Host", &host)
                .send(&server)
                .status,
            403,
            "{host}"
        );
        let entry = format!("/?token={}", server.token);
        assert_eq!(
            Request::get(&entry)
                .with("Host", &host)
                .send(&server)
                .status,
            403,
            "{host}"
        );
    }
    assert_eq!(
        Request::get("/")
            .with("Host", &format!("localhost:{port}"))
            .send(&server)
            .status,
        200
    );
    let two = format!("127.0.0.1:{port}\r\nHost: evil.example:{port}");
    assert!((400..500).contains(&Request::get("/").with("Host", &two).send(&server).status));
    let whole = format!("http://evil.example:{port}/");
    assert_eq!(Request::get(&whole).send(&server).status, 403);
    assert_eq!(Request::get("/").without("Host").send(&server).status, 403);
}

#[test]
fn pages_of_other_sites_are_refused_and_told_nothing() {
    let server = start(Options::default());
    let port = server.port;
    let post = || Request::post("/api/ask", ASK);
    for origin in [
        "http://evil.example",
        "null",
        "",
        "https://127.0.0.1",
        "http://127.0.0.1:1",
    ] {
        let reply = post().with("Origin", origin).send(&server);
        assert_eq!(reply.status, 403, "{origin}");
    }
    assert_eq!(
        post()
            .with("Origin", &format!("https://127.0.0.1:{port}"))
            .send(&server)
            .status,
        403
    );
    assert_eq!(
        post()
            .with("Origin", &format!("http://localhost:{port}"))
            .send(&server)
            .status,
        403,
        "not the host"
    );
    for site in ["cross-site", "same-site", "", "Cross-Site"] {
        assert_eq!(
            post().with("Sec-Fetch-Site", site).send(&server).status,
            403,
            "{site}"
        );
        assert_eq!(
            Request::get("/")
                .with("Sec-Fetch-Site", site)
                .send(&server)
                .status,
            403,
            "{site}"
        );
    }
    let own = post()
        .with("Origin", &format!("http://127.0.0.1:{port}"))
        .with("Sec-Fetch-Site", "same-origin");
    assert_eq!(own.send(&server).status, 200);
    for path in [
        "/api/ask",
        "/api/open",
        "/api/drop",
        "/api/lab/run",
        "/api/lab/stop",
    ] {
        assert_eq!(
            Request::post(path, ASK)
                .without("X-Specula")
                .send(&server)
                .status,
            403,
            "{path}"
        );
        assert_eq!(
            Request::post(path, ASK)
                .with("X-Specula", "0")
                .send(&server)
                .status,
            403,
            "{path}"
        );
    }
    for method in ["OPTIONS", "PUT", "DELETE", "TRACE", "CONNECT", "PATCH"] {
        let asked = format!(
            "{method} /api/ask HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://evil.example\r\n\
             Access-Control-Request-Method: POST\r\nConnection: close\r\n\r\n"
        );
        let reply = exchange(&server, asked.as_bytes()).unwrap();
        assert!(
            [400, 403, 405].contains(&reply.status),
            "{method}: {}",
            reply.status
        );
        assert_eq!(reply.header("access-control-allow-origin"), None);
    }
}

#[test]
fn every_answer_has_the_headers_that_keep_pages_in() {
    let server = start(Options::default());
    let replies = [
        Request::get("/").send(&server),
        Request::get("/none").send(&server),
        Request::get("/").without("Cookie").send(&server),
        Request::get(&format!("/?token={}", server.token)).send(&server),
        Request::post("/api/ask", ASK).send(&server),
        Request::post("/api/ask", "no JSON").send(&server),
        Request::post("/none", "").send(&server),
        Request::get("/api/ask").send(&server),
    ];
    for reply in replies {
        let policy = reply.header("content-security-policy").unwrap();
        for part in [
            "default-src 'none'",
            "script-src 'self' 'wasm-unsafe-eval';",
            "style-src 'self';",
            "connect-src 'self'",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
            "worker-src 'self' blob:",
        ] {
            assert!(policy.contains(part), "{part}: {policy}");
        }
        assert!(
            !policy.contains("unsafe-inline")
                && !policy.contains("'unsafe-eval'")
                && !policy.contains('*')
        );
        assert_eq!(reply.header("x-content-type-options"), Some("nosniff"));
        assert_eq!(reply.header("referrer-policy"), Some("no-referrer"));
        assert_eq!(
            reply.header("cross-origin-opener-policy"),
            Some("same-origin")
        );
        assert_eq!(
            reply.header("cross-origin-resource-policy"),
            Some("same-origin")
        );
        assert_eq!(reply.header("access-control-allow-origin"), None);
    }
}

#[test]
fn pages_are_no_way_to_other_files() {
    let folder = tempfile::tempdir().unwrap();
    let web = folder.path().join("web");
    std::fs::create_dir(&web).unwrap();
    std::fs::write(web.join("index.html"), "page").unwrap();
    std::fs::write(folder.path().join("secret.txt"), "secret").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(folder.path().join("secret.txt"), web.join("link.txt")).unwrap();
    let from_folder = Options {
        assets: Assets::Folder(web),
        ..Options::default()
    };
    for server in [start(Options::default()), start(from_folder)] {
        for path in [
            "/../secret.txt",
            "/..%2fsecret.txt",
            "/%2e%2e/secret.txt",
            "/%2E%2E%2Fsecret.txt",
            "/./../secret.txt",
            "//etc/passwd",
            "/etc/passwd",
            "/..\\secret.txt",
            "/..%5csecret.txt",
            "/link.txt",
            "/index.html/",
            "/%00",
            "/index.html%00.js",
            "/.git/config",
            "/C:/secret.txt",
            "/....//secret.txt",
        ] {
            let reply = Request::get(path).send(&server);
            assert!(
                [400, 404].contains(&reply.status),
                "{path}: {}",
                reply.status
            );
            assert!(!reply.text().contains("secret"), "{path}");
        }
    }
}

#[test]
fn scenes_are_opened_from_the_folder_alone() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("in");
    std::fs::create_dir(&inside).unwrap();
    let outside = folder.path().join("out.pbrt");
    std::fs::write(&outside, "WorldBegin\nsecret").unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&outside, inside.join("link.pbrt")).unwrap();
        std::os::unix::fs::symlink(folder.path(), inside.join("up")).unwrap();
        let made = std::process::Command::new("mkfifo")
            .arg(inside.join("pipe.pbrt"))
            .status();
        assert!(made.unwrap().success());
    }
    let server = start(Options {
        folder: inside.clone(),
        ..Options::default()
    });
    for path in [
        "../out.pbrt",
        "link.pbrt",
        "up/out.pbrt",
        "/etc/passwd",
        "/dev/zero",
        "/proc/self/environ",
        "pipe.pbrt",
        "",
        ".",
        "..",
        "in/../../out.pbrt",
        "\0",
        "none.pbrt",
        outside.to_str().unwrap(),
    ] {
        let reply = Request::post("/api/open", json!({ "path": path }).to_string()).send(&server);
        assert_eq!(reply.status, 404, "{path}: {}", reply.text());
        assert!(!reply.text().contains("secret"), "{path}");
    }
    for body in [
        "",
        "[]",
        "{}",
        r#"{"path": 3}"#,
        r#"{"path": "a", "more": 1}"#,
        "{\"path\": \"",
        "\u{fffd}",
    ] {
        assert_eq!(
            Request::post("/api/open", body).send(&server).status,
            400,
            "{body}"
        );
    }
}

/// Sends a drop; its status and words.
fn drop_on(server: &Running, body: Vec<u8>) -> (u16, String) {
    let reply = Request::post("/api/drop", body).send(server);
    (reply.status, reply.text())
}

#[test]
fn dropped_files_are_written_nowhere_else() {
    let server = start(impatient());
    let away = tempfile::tempdir().unwrap();
    let target = away.path().join("written.pbrt");
    for path in [
        "../written.pbrt",
        "a/../../written.pbrt",
        "..",
        ".",
        "",
        "/",
        "a//b.pbrt",
        "a\\..\\..\\b.pbrt",
        "C:\\a.pbrt",
        "C:a.pbrt",
        "a.pbrt/",
        "a\0.pbrt",
        "a\n.pbrt",
        "./a.pbrt",
        "a/./b.pbrt",
        "...",
        "a.",
        "NUL:",
        "a:stream",
        target.to_str().unwrap(),
    ] {
        let (status, text) = drop_on(&server, dropped(&[(path, SCENE.as_bytes())], None));
        assert_eq!(status, 400, "{path:?}: {text}");
    }
    assert!(!target.exists());
    let twice = [("a.pbrt", b"1".as_slice()), ("a.pbrt", b"2")];
    assert_eq!(drop_on(&server, dropped(&twice, None)).0, 400);
    let within = [("a.pbrt", b"1".as_slice()), ("a.pbrt/b.pbrt", b"2")];
    assert!(drop_on(&server, dropped(&within, Some("a.pbrt"))).0 >= 400);
    for scene in ["../a.pbrt", "/etc/passwd", "b.pbrt", ""] {
        assert_eq!(
            drop_on(&server, dropped(&[("a.pbrt", b"")], Some(scene))).0,
            400,
            "{scene}"
        );
    }
}

#[test]
fn dropped_scenes_read_no_files_of_the_machine() {
    let server = start(impatient());
    let folder = tempfile::tempdir().unwrap();
    let secret = folder.path().join("secret.ply");
    std::fs::write(&secret, common::PLY).unwrap();
    let texture = folder.path().join("secret.png");
    std::fs::write(&texture, PNG).unwrap();
    let up = format!("../../../../../../../../..{}", secret.display());
    for named in [
        secret.to_str().unwrap(),
        &up,
        "/etc/passwd",
        "../../etc/passwd",
        "/none/there.ply",
    ] {
        let scene = format!("WorldBegin\nShape \"plymesh\" \"string filename\" \"{named}\"\n");
        let (status, text) = drop_on(&server, dropped(&[("a.pbrt", scene.as_bytes())], None));
        assert_eq!(status, 422, "{named}: {text}");
        let scene = format!("WorldBegin\nInclude \"{named}\"\nShape \"sphere\"\n");
        let (status, text) = drop_on(&server, dropped(&[("a.pbrt", scene.as_bytes())], None));
        assert_eq!(status, 422, "{named}: {text}");
        assert!(!text.contains("root:"), "{text}");
    }
    let scene = format!(
        "WorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{}\"\n\
         Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n",
        texture.display()
    );
    let (status, text) = drop_on(&server, dropped(&[("a.pbrt", scene.as_bytes())], None));
    assert_eq!(status, 422, "{text}");
    let scene = format!(
        r#"<scene version="3.0.0"><shape type="ply"><string name="filename" value="{}"/></shape></scene>"#,
        secret.display()
    );
    let (status, text) = drop_on(&server, dropped(&[("a.xml", scene.as_bytes())], None));
    assert_eq!(status, 422, "{text}");
    let bomb =
        format!(r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":4,"uri":"{up}"}}]}}"#);
    let (status, text) = drop_on(&server, dropped(&[("a.gltf", bomb.as_bytes())], None));
    assert_eq!(status, 422, "{text}");
}

#[test]
fn drops_that_lie_about_themselves_are_refused() {
    let server = start(impatient());
    let item = |bytes: u64| json!({"files": [{"path": "a.pbrt", "bytes": bytes}]});
    assert_eq!(drop_on(&server, framed(&item(10), b"short")).0, 400);
    assert_eq!(drop_on(&server, framed(&item(1), b"longer")).0, 400);
    assert_eq!(drop_on(&server, framed(&item(2 << 20), b"")).0, 413);
    assert_eq!(drop_on(&server, framed(&item(u64::MAX), b"")).0, 413);
    let two =
        json!({"files": [{"path": "a", "bytes": u64::MAX}, {"path": "b", "bytes": u64::MAX}]});
    assert_eq!(drop_on(&server, framed(&two, b"")).0, 413);
    let many: Vec<_> = (0..17)
        .map(|i| json!({"path": format!("{i}.pbrt"), "bytes": 0}))
        .collect();
    assert_eq!(
        drop_on(&server, framed(&json!({ "files": many }), b"")).0,
        413
    );
    assert_eq!(drop_on(&server, framed(&json!({"files": []}), b"")).0, 400);
    assert_eq!(
        drop_on(&server, framed(&json!({"files": [], "more": 1}), b"")).0,
        400
    );
    for body in [
        &b""[..],
        b"\0",
        &[255; 8],
        &[4, 0, 0, 0],
        &[2, 0, 0, 0, b'{', b'}'],
        &[1, 0, 0, 0, 0xff],
    ] {
        assert!(
            [400, 413].contains(&drop_on(&server, body.to_vec()).0),
            "{body:?}"
        );
    }
    // Bytes that unpack to far more than may be dropped.
    let mut bomb = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    bomb.write_all(&vec![b' '; 32 << 20]).unwrap();
    let bomb = bomb.finish().unwrap();
    let (status, text) = drop_on(&server, dropped(&[("a.pbrt.gz", &bomb)], None));
    assert_eq!(status, 422, "{text}");
}

#[test]
fn no_more_scenes_are_kept_than_allowed() {
    let server = start(impatient());
    let scene = b"Camera \"perspective\"\nWorldBegin\nShape \"sphere\"\n";
    let add = |name: &str| drop_on(&server, dropped(&[(name, scene)], None));
    for name in ["a.pbrt", "b.pbrt", "c.pbrt", "a.pbrt"] {
        let (status, text) = add(name);
        assert_eq!(status, 200, "{text}");
    }
    assert_eq!(add("d.pbrt").0, 409);
    assert_eq!(add("b.pbrt").0, 200, "in the place of the earlier one");
}

#[test]
fn what_is_too_long_is_not_read() {
    let server = start(impatient());
    let huge = Request::post("/api/ask", "")
        .with("Content-Length", &(2_u64 << 20).to_string())
        .send(&server);
    assert_eq!(huge.status, 413);
    let most = Request::post("/api/ask", "")
        .with("Content-Length", &u64::MAX.to_string())
        .send(&server);
    assert!([400, 413].contains(&most.status));
    let drop = Request::post("/api/drop", "")
        .with("Content-Length", &(1_u64 << 40).to_string())
        .send(&server);
    assert_eq!(drop.status, 413);
    for bad in ["-1", "x", "1, 2", "1\r\nContent-Length: 2"] {
        let reply = Request::post("/api/ask", "")
            .with("Content-Length", bad)
            .send(&server);
        assert!(
            (400..500).contains(&reply.status),
            "{bad}: {}",
            reply.status
        );
    }
    // In pieces, whose sum nobody has promised.
    let mut pieces = String::new();
    for _ in 0..33 {
        pieces += &format!("8000\r\n{}\r\n", " ".repeat(0x8000));
    }
    let chunked = Request::post("/api/ask", pieces + "0\r\n\r\n").without("Content-Length");
    assert_eq!(
        chunked
            .with("Transfer-Encoding", "chunked")
            .send(&server)
            .status,
        413
    );
    let deep = "[".repeat(1 << 19);
    let reply = Request::post("/api/ask", deep).send(&server);
    assert!(common::answered(&reply.body)["error"].is_string());
    assert_eq!(Request::post("/api/ask", ASK).send(&server).status, 200);
}

#[test]
fn floods_of_headers_are_cut() {
    let server = start(impatient());
    let head = format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n", server.port);
    let many: String = (0..1000).map(|i| format!("X-{i}: 1\r\n")).collect();
    let long = format!("X-Long: {}\r\n", "a".repeat(1 << 20));
    let target = format!("GET /{} HTTP/1.1\r\n\r\n", "a".repeat(1 << 20));
    for flood in [
        format!("{head}{many}\r\n"),
        format!("{head}{long}\r\n"),
        target,
    ] {
        let reply = exchange(&server, flood.as_bytes());
        assert!(reply.is_none_or(|r| (400..500).contains(&r.status)));
    }
    for noise in [
        &b"\x16\x03\x01\x02\x00\x01\x00"[..],
        b"\0\0\0\0\r\n\r\n",
        b"GET\r\n\r\n",
        b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
    ] {
        assert!(exchange(&server, noise).is_none_or(|r| (400..500).contains(&r.status)));
    }
    assert_eq!(Request::get("/").send(&server).status, 200);
}

#[test]
fn slow_clients_lose_their_places() {
    let limits = ServerLimits {
        connections: 2,
        ..impatient().limits
    };
    let server = start(Options {
        limits,
        ..Options::default()
    });
    let begin = Instant::now();
    // One says nothing, one begins a head and never ends it.
    let mut silent = connect(&server);
    let mut slow = connect(&server);
    slow.write_all(b"GET / HTTP/1.1\r\nHo").unwrap();
    // Both places are taken: this one waits until they are free.
    assert_eq!(Request::get("/").send(&server).status, 200);
    assert!(begin.elapsed() < Duration::from_secs(5));
    let mut byte = [0];
    for stream in [&mut silent, &mut slow] {
        while stream.read(&mut byte).is_ok_and(|count| count > 0) {}
    }
    for (path, body) in [("/api/ask", "{\"ask\""), ("/api/drop", "\u{1}")] {
        let begin = Instant::now();
        let reply = Request::post(path, body)
            .with("Content-Length", "1000")
            .send(&server);
        assert_eq!(reply.status, 408, "{path}");
        assert!(begin.elapsed() < Duration::from_secs(5));
    }
}

#[test]
fn one_scene_is_read_at_a_time() {
    let limits = ServerLimits {
        body_time: Duration::from_secs(5),
        ..impatient().limits
    };
    let server = start(Options {
        limits,
        ..Options::default()
    });
    let body = dropped(&[("a.pbrt", b"WorldBegin\nShape \"sphere\"\n")], None);
    // A page that has sent all but the last byte.
    let mut first = connect(&server);
    let head = format!(
        "POST /api/drop HTTP/1.1\r\nHost: 127.0.0.1:{0}\r\nCookie: specula_studio_{0}={1}\r\nX-Specula: 1\r\n\
         Connection: close\r\nContent-Length: {2}\r\n\r\n",
        server.port,
        server.token,
        body.len()
    );
    first.write_all(head.as_bytes()).unwrap();
    first.write_all(&body[..body.len() - 1]).unwrap();
    let begin = Instant::now();
    while drop_on(&server, body.clone()).0 != 429 {
        assert!(begin.elapsed() < Duration::from_secs(3));
    }
    first.write_all(&body[body.len() - 1..]).unwrap();
    assert_eq!(receive(&mut first).unwrap().status, 200);
    assert_eq!(drop_on(&server, body).0, 200);
}
