//! What pages get from the server: their files, answers, scenes, the laboratory.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]

mod common;

use common::{PLY, PNG, Request, SCENE, answered, dropped, start};
use serde_json::{Value, json};
use specula_studio_server::{Assets, Options, export};

#[test]
fn the_token_lets_a_browser_in_and_pages_come_from_the_program() {
    let server = start(Options::default());
    let entered = Request::get(&format!("/?token={}", server.token))
        .without("Cookie")
        .send(&server);
    assert_eq!(
        (entered.status, entered.header("location")),
        (303, Some("/"))
    );
    let cookie = entered.header("set-cookie").unwrap();
    let expected = format!(
        "specula_studio_{}={}; HttpOnly; SameSite=Strict; Path=/",
        server.port, server.token
    );
    assert_eq!(cookie, expected);
    let page = Request::get("/")
        .with("Cookie", cookie.split(';').next().unwrap())
        .send(&server);
    assert_eq!(page.status, 200);
    assert_eq!(
        page.header("content-type"),
        Some("text/html; charset=utf-8")
    );
    assert!(page.text().contains("<title>Specula studio</title>"));
    let script = Request::get("/studio.js").send(&server);
    assert_eq!(
        script.header("content-type"),
        Some("text/javascript; charset=utf-8")
    );
    let tag = script.header("etag").unwrap().to_owned();
    let again = Request::get("/studio.js")
        .with("If-None-Match", &tag)
        .send(&server);
    assert_eq!((again.status, again.body.len()), (304, 0));
    let packed = Request::get("/studio.js")
        .with("Accept-Encoding", "br, gzip")
        .send(&server);
    assert_eq!(packed.header("content-encoding"), Some("gzip"));
    assert!(packed.body.len() < script.body.len());
    assert_eq!(Request::get("/none.js").send(&server).status, 404);
}

#[test]
fn pages_come_from_a_folder_where_they_are_written() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("index.html"), "one").unwrap();
    let assets = Assets::Folder(folder.path().to_owned());
    let server = start(Options {
        assets,
        ..Options::default()
    });
    assert_eq!(Request::get("/").send(&server).text(), "one");
    std::fs::write(folder.path().join("index.html"), "two").unwrap();
    assert_eq!(Request::get("/").send(&server).text(), "two");
}

#[test]
fn the_library_answers() {
    let server = start(Options::default());
    let ask = |request: Value| {
        let reply = Request::post("/api/ask", request.to_string()).send(&server);
        assert_eq!(reply.status, 200, "{}", reply.text());
        assert_eq!(
            reply.header("content-type"),
            Some("application/octet-stream")
        );
        answered(&reply.body)
    };
    let parsed = ask(json!({"ask": "lobes.parse", "lobe": "conductor Au alpha 0.3"}));
    assert_eq!(parsed["value"]["kind"], "conductor", "{parsed}");
    let grid = ask(json!({
        "ask": "lobes.slice", "lobe": "conductor Au alpha 0.3", "wo": [0, 0, 1], "azimuth": 0, "count": 9
    }));
    assert_eq!(grid["arrays"][0]["shape"], json!([9]), "{grid}");
    let unknown = ask(json!({"ask": "nothing.there"}));
    assert!(unknown["error"].as_str().unwrap().contains("nothing.there"));
    let scenes = ask(json!({"ask": "render.scenes"}));
    assert_eq!(scenes["value"]["opensFiles"], true);
}

/// Writes the scene with its files.
fn scene_folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files() {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    folder
}

fn files() -> [(&'static str, &'static [u8]); 3] {
    [
        ("room/room.pbrt", SCENE.as_bytes()),
        ("room/geometry/triangle.ply", PLY.as_bytes()),
        ("room/textures/tiles.png", PNG),
    ]
}

/// Renders a scene by its name; fails where that cannot be.
fn render(server: &common::Running, name: &Value) {
    let ask = |request: Value| {
        let reply = answered(
            &Request::post("/api/ask", request.to_string())
                .send(server)
                .body,
        );
        assert!(reply["error"].is_null(), "{reply}");
        reply["value"].clone()
    };
    let session = ask(json!({"ask": "render.open", "scene": name}))["session"].clone();
    let advanced = ask(json!({"ask": "render.advance", "session": session, "samples": 1}));
    assert_eq!(advanced["samples"], 1, "{advanced}");
}

#[test]
fn scenes_of_the_folder_are_opened() {
    let folder = scene_folder();
    let server = start(Options {
        folder: folder.path().to_owned(),
        ..Options::default()
    });
    let open =
        |path: &str| Request::post("/api/open", json!({ "path": path }).to_string()).send(&server);
    let opened = open("room/room.pbrt");
    assert_eq!(opened.status, 200, "{}", opened.text());
    let value = opened.json();
    assert_eq!(value["title"], "room/room.pbrt");
    render(&server, &value["name"]);
    let absolute = open(folder.path().join("room/room.pbrt").to_str().unwrap());
    assert_eq!(absolute.json()["name"], value["name"]);
    std::fs::write(
        folder.path().join("bad.pbrt"),
        "WorldBegin\nShape \"dodecahedron\"\n",
    )
    .unwrap();
    let bad = open("bad.pbrt");
    assert_eq!(bad.status, 422);
    let bad = bad.json();
    assert!(
        bad["error"].as_str().unwrap().contains("dodecahedron"),
        "{bad}"
    );
    assert_eq!(
        (&bad["file"], &bad["line"], &bad["column"]),
        (&json!("bad.pbrt"), &json!(2), &json!(7))
    );
}

#[test]
fn dropped_scenes_are_rendered_and_leave_no_files() {
    let server = start(Options::default());
    let reply = Request::post("/api/drop", dropped(&files(), None)).send(&server);
    assert_eq!(reply.status, 200, "{}", reply.text());
    let value = reply.json();
    assert_eq!(value["title"], "room/room.pbrt");
    render(&server, &value["name"]);
    let broken = [(
        "a.pbrt",
        "WorldBegin\nShape \"plymesh\" \"string filename\" \"none.ply\"\n".as_bytes(),
    )];
    let reply = Request::post("/api/drop", dropped(&broken, None)).send(&server);
    assert_eq!(reply.status, 422);
    let bad = reply.json();
    assert_eq!(
        (&bad["file"], &bad["line"]),
        (&json!("a.pbrt"), &json!(2)),
        "{bad}"
    );
    let prefix = std::env::temp_dir().join("specula-studio-");
    assert!(!bad.to_string().contains(prefix.to_str().unwrap()), "{bad}");
}

#[test]
#[cfg(feature = "lab")]
fn the_laboratory_runs_and_reports() {
    let server = start(Options::default());
    let get = |path: &str| Request::get(path).send(&server);
    let listed = get("/api/lab").json();
    let all = listed["experiments"].as_array().unwrap();
    assert!(
        all.iter()
            .any(|e| e["id"] == "tokuyoshi24-fig3" && e["source"] == "tokuyoshi24"),
        "{listed}"
    );
    assert_eq!(get("/api/lab/status").json()["running"], Value::Null);
    assert_eq!(get("/lab/report/").status, 404);
    let run = |ids: &[&str]| {
        let request = json!({"ids": ids, "quality": "draft", "seed": 1});
        Request::post("/api/lab/run", request.to_string()).send(&server)
    };
    assert_eq!(run(&["none"]).status, 400);
    assert_eq!(run(&[]).status, 400);
    assert_eq!(run(&["tokuyoshi24-fig3"]).status, 200);
    let status = loop {
        let status = get("/api/lab/status").json();
        if status["running"].is_null() {
            break status;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    };
    assert_eq!(status["error"], Value::Null);
    assert_eq!(status["results"][0]["id"], "tokuyoshi24-fig3");
    assert!(
        status["results"][0]["claims"][0]["holds"].is_boolean(),
        "{status}"
    );
    assert_eq!(status["report"], "/lab/report/");
    let report = get("/lab/report/");
    let policy = report.header("content-security-policy").unwrap();
    let nonce = policy
        .split("'nonce-")
        .nth(1)
        .unwrap()
        .split('\'')
        .next()
        .unwrap();
    let text = report.text();
    assert!(text.contains(&format!("<script nonce=\"{nonce}\">")));
    assert!(
        policy.contains("sandbox allow-scripts") && !policy.contains("allow-same-origin"),
        "{policy}"
    );
    assert!(!policy.contains("connect-src"), "{policy}");
}

#[test]
#[cfg(feature = "lab")]
fn one_run_of_the_laboratory_at_a_time() {
    let server = start(Options::default());
    let request = json!({"ids": ["tokuyoshi24-fig1"], "quality": "paper", "seed": 1}).to_string();
    assert_eq!(
        Request::post("/api/lab/run", request.clone())
            .send(&server)
            .status,
        200
    );
    assert_eq!(
        Request::post("/api/lab/run", request).send(&server).status,
        409
    );
    assert_eq!(
        Request::post("/api/lab/stop", "{}").send(&server).status,
        200
    );
}

#[test]
fn an_export_is_a_site_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site");
    let module = folder.path().join("a.wasm");
    std::fs::write(&module, b"\0asm\x01\0\0\0").unwrap();
    let assets = Assets::Embedded;
    let names = export(&site, &assets, Some(&module)).unwrap();
    assert!(
        names.contains(&"specula-studio.wasm.js".to_owned()),
        "{names:?}"
    );
    let page = std::fs::read_to_string(site.join("index.html")).unwrap();
    let policy = page.find("http-equiv=\"Content-Security-Policy\"").unwrap();
    let first = page
        .find("<script src=\"specula-studio.wasm.js\"></script>")
        .unwrap();
    assert!(
        policy < first && first < page.find("studio.js").unwrap(),
        "{page}"
    );
    let script = std::fs::read_to_string(site.join("specula-studio.wasm.js")).unwrap();
    assert!(
        script.starts_with("globalThis.SPECULA_WASM = \"H4sI"),
        "{script}"
    );
    // Again, without the module: the old one goes.
    export(&site, &assets, None).unwrap();
    assert!(!site.join("specula-studio.wasm.js").exists());
    std::fs::write(site.join("thesis.tex"), "").unwrap();
    let error = export(&site, &assets, None).unwrap_err().to_string();
    assert!(error.contains("thesis.tex"), "{error}");
    let other = folder.path().join("other");
    std::fs::create_dir(&other).unwrap();
    std::fs::write(other.join("index.html"), "mine").unwrap();
    export(&other, &assets, None).unwrap_err();
    assert_eq!(
        std::fs::read_to_string(other.join("index.html")).unwrap(),
        "mine"
    );
}
