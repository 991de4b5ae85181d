//! Too much of anything: bytes, files, scenes, headers, time.

use std::io::{Read, Write};
use std::time::{Duration, Instant};

use serde_json::json;
use specula_studio_server::{Options, ServerLimits};

use crate::common::{
    Request, answered, connect, dropped, exchange, framed, impatient, receive, start,
};
use crate::{ASK, drop_on};

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
    assert!((400..500).contains(&most.status), "{}", most.status);
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
    assert!(answered(&reply.body)["error"].is_string());
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

#[test]
fn renders_of_pages_that_went_away_are_closed() {
    let limits = ServerLimits {
        idle_time: Duration::from_millis(400),
        ..impatient().limits
    };
    let server = start(Options {
        limits,
        ..Options::default()
    });
    let ask = |request: serde_json::Value| {
        answered(
            &Request::post("/api/ask", request.to_string())
                .send(&server)
                .body,
        )
    };
    let scenes = ask(json!({"ask": "render.scenes"}));
    let scene = &scenes["value"]["scenes"][0]["name"];
    let opened = ask(json!({"ask": "render.open", "scene": scene, "width": 8, "height": 8}));
    let session = &opened["value"]["session"];
    let advance = || ask(json!({"ask": "render.advance", "session": session, "samples": 1}));
    let begin = Instant::now();
    while begin.elapsed() < Duration::from_secs(1) {
        let advanced = advance();
        assert!(advanced["error"].is_null(), "it is asked for: {advanced}");
        std::thread::sleep(Duration::from_millis(50));
    }
    std::thread::sleep(Duration::from_secs(1));
    assert!(advance()["error"].is_string());
}

#[test]
fn what_is_no_request_is_refused_in_words() {
    let server = start(impatient());
    for body in [
        "",
        "{}",
        "[]",
        "{\"ask\": 1}",
        "{\"ask\": \"files.read\", \"path\": \"/etc/passwd\"}",
    ] {
        let reply = Request::post("/api/ask", body).send(&server);
        assert!(
            answered(&reply.body)["error"].is_string(),
            "{body}: {}",
            reply.text()
        );
    }
}
