//! Who may not ask: strangers, and pages of other sites.

use specula_studio_server::Options;

use crate::ASK;
use crate::common::{Request, exchange, start};

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
}

#[test]
fn other_methods_are_refused_and_told_nothing() {
    let server = start(Options::default());
    let port = server.port;
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
