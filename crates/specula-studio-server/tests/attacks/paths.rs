//! Paths that lead away: of pages, of scenes that are opened, of files that are dropped.

use serde_json::json;
use specula_studio_server::{Assets, Options};

use crate::common::{self, PNG, Request, SCENE, dropped, impatient, start};
use crate::drop_on;

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
