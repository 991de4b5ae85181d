//! Every directive and kind of shape, light, camera and film.

use glam::DVec3;
use specula_scene::scene::{
    Channel, ColourParam, CurveKind, CurveMeshId, EnvironmentMapping, Filter, Geometry, Light,
    MeshId, PatchMeshId, QuadricPart, Texture, TextureMapping, UvMapping, Wrap,
};
use specula_scene::{LoadOptions, Loaded, Summary};

use super::common::{Folder, load, load_world, warnings};

fn center(loaded: &Loaded, shape: usize) -> [f64; 3] {
    let center = loaded.scene.shapes[shape]
        .to_world
        .transform_point3(DVec3::ZERO);
    center.to_array().map(|x| (x * 1e6).round() / 1e6)
}

#[test]
fn transforms() {
    let loaded = load_world(
        "AttributeBegin Translate 1 2 3 Scale 2 2 2 Rotate 90 0 0 1 Translate 1 0 0 Shape \"sphere\" AttributeEnd
         AttributeBegin Transform [1 0 0 0 0 1 0 0 0 0 1 0 4 5 6 1] ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1] Shape \"sphere\" AttributeEnd
         TransformBegin Translate 7 0 0 CoordinateSystem \"here\" Identity CoordSysTransform \"here\" Shape \"sphere\" TransformEnd",
    )
    .unwrap();
    assert_eq!(center(&loaded, 0), [1.0, 4.0, 3.0]);
    assert_eq!(center(&loaded, 1), [5.0, 5.0, 6.0]);
    assert_eq!(center(&loaded, 2), [7.0, 0.0, 0.0]);
    assert_eq!(center(&loaded, 3), [0.0, 0.0, 0.0]);
    assert_eq!(warnings(&loaded), [""; 0]);
}

#[test]
fn camera_film_and_settings() {
    let loaded = load(
        "Option \"seed\" 3 ColorSpace \"srgb\"
         LookAt 0 0 -5  0 0 0  0 1 0
         Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.1 \"float focaldistance\" 5 \"float shutterclose\" 0.5
         Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100 \"float cropwindow\" [0.25 0.5 0 1]
              \"string filename\" \"a.exr\" \"float iso\" 400
         Sampler \"zsobol\" \"integer pixelsamples\" 7 Integrator \"volpath\" \"integer maxdepth\" 9
         PixelFilter \"mitchell\" Accelerator \"bvh\"
         WorldBegin Shape \"sphere\"",
    )
    .unwrap();
    let scene = &loaded.scene;
    assert_eq!(scene.film.resolution, [200, 100]);
    assert_eq!(scene.film.crop, [50, 100, 0, 100]);
    assert_eq!(scene.film.exposure, 2.0);
    assert_eq!(scene.film.file_name.as_deref(), Some("a.exr"));
    assert!(matches!(
        scene.film.filter,
        Filter::Mitchell {
            radius: [2.0, 2.0],
            ..
        }
    ));
    assert_eq!(
        (scene.settings.max_depth, scene.settings.samples_per_pixel),
        (9, 7)
    );
    assert_eq!(scene.camera.screen_window, [-2.0, 2.0, -1.0, 1.0]);
    assert_eq!(
        scene.camera.to_world.transform_point3(DVec3::ZERO),
        DVec3::new(0.0, 0.0, -5.0)
    );
    assert_eq!(scene.camera.to_world.transform_vector3(DVec3::Z), DVec3::Z);
    assert!(warnings(&loaded).is_empty(), "{:?}", loaded.warnings);
    let defaults = load("WorldBegin Shape \"sphere\"").unwrap().scene;
    assert_eq!(
        defaults.film.filter,
        Filter::Gaussian {
            radius: [1.5; 2],
            sigma: 0.5
        }
    );
    assert_eq!(
        (
            defaults.settings.max_depth,
            defaults.settings.samples_per_pixel
        ),
        (5, 16)
    );
    assert_eq!(defaults.film.resolution, [1280, 720]);
}

#[test]
fn objects_are_placed_by_their_instances() {
    let loaded = load(
        "WorldBegin ObjectBegin \"o\" Translate 1 0 0 Shape \"sphere\" Shape \"disk\" ObjectEnd
         Translate 0 5 0 ObjectInstance \"o\" Scale 2 2 2 ObjectInstance \"o\"",
    )
    .unwrap();
    let summary = Summary::of(&loaded.scene);
    assert_eq!((summary.objects, summary.instances), (1, 2));
    assert_eq!(summary.shapes["sphere"], 1);
    assert_eq!(summary.bounds.max, DVec3::new(4.0, 7.0, 2.0));
    assert_eq!(loaded.scene.shapes.len(), 0);
}

#[test]
fn shapes() {
    let loaded = load(
        "WorldBegin ReverseOrientation
         Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1 0 0 1 0 0 1] \"point2 uv\" [0 0 1 0 0 1]
         ReverseOrientation
         Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]
         Shape \"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2] \"integer levels\" 2
         Shape \"disk\" \"float radius\" 2 \"float height\" 1
         Shape \"sphere\" \"float zmin\" 0 \"float wobble\" 1
         Shape \"sphere\" \"float zmin\" 0
         Shape \"cylinder\"
         Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 1 0]",
    )
    .unwrap();
    let scene = &loaded.scene;
    assert_eq!(scene.meshes[1].triangles, [[0, 1, 3], [0, 3, 2]]);
    assert!(scene.shapes[0].reverse_orientation && !scene.shapes[1].reverse_orientation);
    assert_eq!(
        scene.shapes[3].geometry,
        Geometry::Disk {
            radius: 2.0,
            height: 1.0
        }
    );
    assert_eq!(scene.shapes.len(), 8);
    let Geometry::Mesh(subdivided) = scene.shapes[2].geometry else {
        panic!()
    };
    assert_eq!(scene.meshes[subdivided.0].triangles.len(), 16);
    assert_eq!(
        scene.shapes[4].geometry, scene.shapes[5].geometry,
        "half spheres of one size"
    );
    let all = warnings(&loaded);
    assert_eq!(all, ["unused parameter \"float wobble\""]);
}

#[test]
fn meshes_from_files_are_stored_once() {
    let folder = Folder::new();
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    folder.write("a.ply", ply);
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    std::io::Write::write_all(&mut packed, ply.as_bytes()).unwrap();
    folder.write("b.ply.gz", packed.finish().unwrap());
    folder.write(
        "more.pbrt",
        "Shape \"plymesh\" \"string filename\" \"a.ply\" Translate 1 0 0",
    );
    let loaded = folder
        .load(
            "WorldBegin Include \"more.pbrt\" Import \"more.pbrt\" Shape \"sphere\"
             Shape \"plymesh\" \"string filename\" \"b.ply.gz\"",
        )
        .unwrap();
    let summary = Summary::of(&loaded.scene);
    assert_eq!(
        (summary.meshes, summary.triangles, summary.triangles_shown),
        (2, 2, 3)
    );
    // `Include` changes the transform, `Import` does not.
    assert_eq!(center(&loaded, 2), [1.0, 0.0, 0.0]);
    assert!(folder.path().join("a.ply").exists());
}

#[test]
fn lights() {
    let loaded = load_world(
        "LightSource \"infinite\" \"rgb L\" [1 2 3] \"float scale\" 2
         LightSource \"distant\" \"point3 from\" [0 0 4] \"point3 to\" [0 0 0] \"float illuminance\" 3
         Translate 1 0 0
         LightSource \"point\" \"rgb I\" [1 1 1] \"float power\" 12.566370614359172
         LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 10
         LightSource \"goniometric\" \"rgb I\" [1 2 3]
         Identity",
    )
    .unwrap();
    let [infinite, distant, point, spot, goniometric] = loaded.scene.lights.as_slice() else {
        panic!()
    };
    assert!(matches!(infinite, Light::Infinite { radiance, image: None, .. } if radiance.b == 6.0));
    assert!(
        matches!(distant, Light::Distant { irradiance, to_light, .. } if irradiance.r == 3.0 && *to_light == [0.0, 0.0, 1.0])
    );
    assert!(
        matches!(point, Light::Point { position: [1.0, 0.0, 0.0], intensity } if (intensity.r - 1.0).abs() < 1e-6)
    );
    assert!(
        matches!(spot, Light::Spot { axis: [0.0, 0.0, 1.0], falloff_start_deg, .. } if *falloff_start_deg == 30.0)
    );
    assert!(matches!(goniometric, Light::Point { intensity, .. } if intensity.b == 3.0));
    assert_eq!(warnings(&loaded).len(), 1);
}

#[test]
fn emission_of_shapes() {
    let loaded = load_world(
        "Attribute \"light\" \"float scale\" 3
         AreaLightSource \"diffuse\" \"rgb L\" [1 1 2] \"bool twosided\" true Shape \"sphere\"
         AreaLightSource \"diffuse\" \"blackbody L\" 6500 Shape \"sphere\"
         AreaLightSource \"diffuse\" \"spectrum L\" [400 1 700 1] Shape \"sphere\"
         AreaLightSource \"diffuse\" \"float power\" 2 Shape \"sphere\"
         Material \"interface\" Shape \"sphere\"
         ObjectBegin \"o\" Shape \"sphere\" ObjectEnd",
    )
    .unwrap();
    let radiance_of = |i: usize| match loaded.scene.shapes[i].emission.unwrap().radiance {
        ColourParam::Value(c) => c,
        ColourParam::Texture(_) => panic!(),
    };
    assert!(loaded.scene.shapes[0].emission.unwrap().two_sided);
    assert_eq!(radiance_of(0).b, 6.0);
    for i in [1, 2] {
        let luminance = radiance_of(i).luminance();
        assert!((luminance - 3.0).abs() < 0.06, "{luminance}");
    }
    let radiance = 3.0 * 2.0 / (4.0 * std::f32::consts::PI.powi(2));
    assert!((radiance_of(3).g - radiance).abs() < 1e-5);
    assert!(loaded.scene.shapes[4].emission.is_none());
    let all = warnings(&loaded);
    assert!(
        all.iter().any(|w| w.contains("area lights in objects")),
        "{all:?}"
    );
}

#[test]
fn textures() {
    let folder = Folder::new();
    let picture = ::image::RgbImage::from_fn(2, 2, |x, y| {
        ::image::Rgb([(x * 255) as u8, (y * 255) as u8, 0])
    });
    picture.save(folder.path().join("a.png")).unwrap();
    let loaded = folder
        .load(
            "WorldBegin
             Texture \"n\" \"float\" \"imagemap\" \"string filename\" \"a.png\" \"string encoding\" \"linear\"
             Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" \"string wrap\" \"clamp\" \"float uscale\" 2 \"bool invert\" true
             Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [0.1 0.2 0.3]
             Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"i\" \"texture scale\" \"n\"
             Texture \"m\" \"spectrum\" \"mix\" \"texture tex1\" \"s\" \"texture tex2\" \"c\" \"float amount\" 0.25
             Texture \"k\" \"spectrum\" \"checkerboard\" \"texture tex1\" \"m\" \"float vscale\" 8 \"float udelta\" 0.5
             Texture \"x\" \"float\" \"fbm\" \"integer octaves\" 3
             Material \"diffuse\" \"texture reflectance\" \"k\" Shape \"sphere\" \"texture alpha\" \"n\"",
        )
        .unwrap();
    let scene = &loaded.scene;
    assert_eq!(
        scene.images.len(),
        2,
        "the same file, read as number and as colour"
    );
    assert_eq!(scene.images[0].pixels.rgb(3), [2.0 / 3.0; 3]);
    assert_eq!(
        scene.images[1].pixels.rgb(2),
        [0.0, 1.0, 0.0],
        "rows from the top"
    );
    assert!(
        matches!(scene.textures[1], Texture::Image { wrap: [Wrap::Clamp, _], invert: true, channel: Channel::Rgb, mapping, .. }
            if mapping == TextureMapping::Uv(UvMapping::scaled([2.0, 1.0], [0.0; 2])))
    );
    let summary = Summary::of(scene);
    assert_eq!(
        (
            summary.textures["imagemap"],
            summary.textures["mix"],
            summary.textures["checkerboard"]
        ),
        (2, 1, 1)
    );
    assert_eq!(warnings(&loaded), [""; 0]);
}

#[test]
fn environments_are_square_or_latitude_longitude() {
    let folder = Folder::new();
    for (name, width) in [("square.png", 4), ("long.png", 8)] {
        ::image::RgbImage::new(width, 4)
            .save(folder.path().join(name))
            .unwrap();
    }
    let loaded = folder
        .load(
            "WorldBegin Shape \"sphere\" LightSource \"infinite\" \"string filename\" \"square.png\"
             LightSource \"infinite\" \"string filename\" \"long.png\"",
        )
        .unwrap();
    let mappings: Vec<_> = loaded
        .scene
        .lights
        .iter()
        .map(|l| {
            if let Light::Infinite {
                image: Some((_, m)),
                ..
            } = l
            {
                *m
            } else {
                panic!()
            }
        })
        .collect();
    assert_eq!(
        mappings,
        [
            EnvironmentMapping::EqualAreaOctahedral,
            EnvironmentMapping::LatitudeLongitude
        ]
    );
    assert_eq!(warnings(&loaded).len(), 1);
}

#[test]
fn parts_of_quadrics_are_read_exactly_and_written_again() {
    let loaded = load(
        "WorldBegin
         Shape \"sphere\" \"float radius\" 2 \"float zmin\" 1.5 \"float zmax\" -0.5 \"float phimax\" 90
         Shape \"cylinder\" \"float radius\" 0.25 \"float zmax\" 3
         Shape \"disk\" \"float radius\" 2 \"float innerradius\" 0.5 \"float height\" -1 \"float phimax\" 400
         Shape \"sphere\" \"float radius\" 2 \"float zmin\" -9 \"float zmax\" 9",
    )
    .unwrap();
    let found: Vec<Geometry> = loaded.scene.shapes.iter().map(|s| s.geometry).collect();
    let expected = [
        Geometry::QuadricPart(QuadricPart::Sphere {
            radius: 2.0,
            z: [-0.5, 1.5],
            phi_max: core::f32::consts::FRAC_PI_2,
        }),
        Geometry::QuadricPart(QuadricPart::Cylinder {
            radius: 0.25,
            z: [-1.0, 3.0],
            phi_max: QuadricPart::TURN,
        }),
        Geometry::QuadricPart(QuadricPart::Disk {
            radius: 2.0,
            inner: 0.5,
            height: -1.0,
            phi_max: QuadricPart::TURN,
        }),
        Geometry::Sphere { radius: 2.0 },
    ];
    assert_eq!(found, expected);
    assert!(loaded.scene.validate().is_ok());
    let path = std::path::Path::new("parts.pbrt");
    let (text, _) = specula_scene::write_pbrt::pbrt_text(&loaded.scene, path).unwrap();
    let again = load(&text).unwrap().scene;
    let again: Vec<Geometry> = again.shapes.iter().map(|s| s.geometry).collect();
    assert_eq!(again, expected);
    let mut triangles = loaded.scene;
    triangles.triangulate_exact_shapes(|_| true);
    assert_eq!((triangles.meshes.len(), triangles.shapes.len()), (3, 4));
    assert!(triangles.validate().is_ok());
}

#[test]
fn curved_patches_are_read_exactly_and_written_again() {
    let loaded = load(
        "WorldBegin
         Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0.5 2 0 0 2 1 0 2 2 0]
           \"integer indices\" [0 1 2 3 1 4 3 5 4 4 4 4] \"point2 uv\" [0 0 1 0 0 1 1 1 2 0 2 1 3 3]
         Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"normal N\" [0 0 1 0 0 1 0 0 1 0 0 1]
         AreaLightSource \"diffuse\" \"float power\" 3
         Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 1 0 1 1 1 1 0]",
    )
    .unwrap();
    let messages = warnings(&loaded);
    assert_eq!(messages, ["1 patches without area are dropped"]);
    let scene = &loaded.scene;
    assert!(scene.validate().is_ok());
    let found: Vec<Geometry> = scene.shapes.iter().map(|s| s.geometry).collect();
    let expected = [
        Geometry::Patches(PatchMeshId(0)),
        // A parallelogram.
        Geometry::Mesh(MeshId(0)),
        Geometry::Patches(PatchMeshId(1)),
    ];
    assert_eq!(found, expected);
    assert_eq!(scene.patch_meshes[0].patches, [[0, 1, 2, 3], [1, 4, 3, 5]]);
    // Over the area of the saddle, 1.280789, and pi.
    let Some(emission) = scene.shapes[2].emission else {
        panic!()
    };
    let ColourParam::Value(radiance) = emission.radiance else {
        panic!()
    };
    assert!((radiance.g - 3.0 / (1.280_789 * core::f32::consts::PI)).abs() < 2e-3);
    let bounds = Summary::of(scene).bounds;
    assert_eq!(bounds.max, DVec3::new(2.0, 1.0, 1.0));
    let path = std::path::Path::new("patches.pbrt");
    let (text, _) = specula_scene::write_pbrt::pbrt_text(scene, path).unwrap();
    let again = load(&text).unwrap().scene;
    assert_eq!(again.patch_meshes, scene.patch_meshes);
    let geometries: Vec<Geometry> = again.shapes.iter().map(|s| s.geometry).collect();
    assert_eq!(geometries, expected);
    let mut bent = scene.clone();
    bent.patch_meshes[1].positions[3][2] = 0.25;
    assert_ne!(bent.fingerprint(), scene.fingerprint());
    bent.patch_meshes[1].patches[0][3] = 4;
    let fault = bent.validate().unwrap_err().to_string();
    assert!(fault.contains("patch mesh 1: a patch refers"), "{fault}");
    let mut triangles = scene.clone();
    triangles.triangulate_exact_shapes(|s| s.emission.is_some());
    assert_eq!((triangles.meshes.len(), triangles.shapes.len()), (2, 3));
    triangles.triangulate_exact_shapes(|_| true);
    assert_eq!((triangles.meshes.len(), triangles.shapes.len()), (3, 3));
    assert!(triangles.validate().is_ok());
}

#[test]
fn curves_are_read_exactly_and_written_again() {
    let loaded = load(
        "WorldBegin
         Shape \"curve\" \"point3 P\" [0 0 0 0 1 0 1 1 0 1 0 0] \"float width0\" 0.5 \"float width1\" 0.25
         Shape \"curve\" \"string type\" \"cylinder\" \"string basis\" \"bspline\" \"float width\" 0.125
           \"point3 P\" [0 0 0 6 0 0 12 6 0 18 0 6 24 0 0]
         Shape \"curve\" \"string type\" \"ribbon\" \"integer degree\" 2 \"normal N\" [0 0 2 0 0 1 0 0 0]
           \"point3 P\" [0 0 0 3 3 0 6 0 0 6 0 0 6 0 0] \"float width1\" 3
         Shape \"curve\" \"point3 P\" [1 1 1 1 1 1 1 1 1 1 1 1]
         AreaLightSource \"diffuse\" \"float power\" 3
         Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"float width\" 0.1",
    )
    .unwrap();
    let messages = warnings(&loaded);
    assert_eq!(
        messages,
        [
            "1 segments without length or width are dropped",
            "no segment of the curve has a length and a width: it is left out",
        ]
    );
    let scene = &loaded.scene;
    assert!(scene.validate().is_ok());
    let found: Vec<Geometry> = scene.shapes.iter().map(|s| s.geometry).collect();
    assert_eq!(
        found,
        [0, 1, 2, 3].map(|i| Geometry::Curves(CurveMeshId(i)))
    );
    let [arc, spline, ribbon, _] = &scene.curve_meshes[..] else {
        panic!("{:?}", scene.curve_meshes);
    };
    assert_eq!(
        (arc.kind, arc.width_at_ends[0]),
        (CurveKind::Flat, [0.5, 0.25])
    );
    assert_eq!(
        (spline.kind, spline.segments.len()),
        (CurveKind::Cylinder, 2)
    );
    // De Boor: the ends of a uniform cubic segment are (1, 4, 1)/6.
    assert_eq!(spline.segments[0][0], [6.0, 1.0, 0.0]);
    assert_eq!(spline.segments[0][3], spline.segments[1][0]);
    assert_eq!(
        (ribbon.kind, ribbon.width_at_ends[0]),
        (CurveKind::Ribbon, [1.0, 2.0])
    );
    assert_eq!(
        ribbon.segments,
        [[[0.0; 3], [2.0, 2.0, 0.0], [4.0, 2.0, 0.0], [6.0, 0.0, 0.0]]]
    );
    assert_eq!(ribbon.normals, [[[0.0, 0.0, 1.0]; 2]]);
    let path = std::path::Path::new("curves.pbrt");
    let (text, _) = specula_scene::write_pbrt::pbrt_text(scene, path).unwrap();
    let again = load(&text).unwrap().scene;
    // A shape for each segment.
    assert_eq!(again.curve_meshes.len(), 5);
    assert_eq!(
        (&again.curve_meshes[0], &again.curve_meshes[3]),
        (arc, ribbon)
    );
    assert_eq!(again.curve_meshes[2].segments[0], spline.segments[1]);
    let mut bent = scene.clone();
    bent.curve_meshes[0].width_at_ends[0][1] = 0.375;
    assert_ne!(bent.fingerprint(), scene.fingerprint());
    bent.curve_meshes[0].normals.push([[0.0, 0.0, 1.0]; 2]);
    let fault = bent.validate().unwrap_err().to_string();
    assert!(fault.contains("curves 0: ribbons have not"), "{fault}");
    let mut triangles = scene.clone();
    triangles.triangulate_exact_shapes(|s| s.emission.is_some());
    assert_eq!((triangles.meshes.len(), triangles.shapes.len()), (1, 4));
    assert!(triangles.validate().is_ok());
}

/// Curves that are pressed flat are triangles, as are those that emit, within the limit of meshes.
#[test]
fn curves_that_are_pressed_flat_are_triangles_and_lamps_have_limits() {
    let curve = "\"curve\" \"point3 P\" [0 0 0 0 1 0 1 1 0 1 0 0] \"float width\" 0.01";
    let flat = load(format!("WorldBegin Scale 1 1 0 Shape {curve}")).unwrap();
    assert!(matches!(flat.scene.shapes[0].geometry, Geometry::Mesh(_)));
    let mut options = LoadOptions::default();
    options.limits.max_vertices = 30;
    let read = |light: &str| {
        let text = format!("WorldBegin {light} Shape {curve}");
        specula_scene::load_bytes(std::path::Path::new("a.pbrt"), text.into_bytes(), &options)
    };
    assert!(read("").is_ok());
    let error = read("AreaLightSource \"diffuse\"").unwrap_err().to_string();
    assert!(error.contains("max_vertices"), "{error}");
}

/// A file with a bent quadrilateral beside a triangle is two shapes of one material, also where it is pressed flat.
#[test]
fn quadrilaterals_of_ply_files_are_patches() {
    let folder = Folder::new();
    let ply = |z: f64, more: &str| {
        let count = 1 + more.lines().count();
        format!(
            "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n\
             property float z\nelement face {count}\nproperty list uchar int vertex_indices\n\
             end_header\n0 0 0\n1 0 0\n1 1 {z}\n0 1 0\n2 0 1\n4 0 1 2 3\n{more}"
        )
    };
    folder.write("flat.ply", ply(0.0, "3 1 4 2\n"));
    folder.write("bent.ply", ply(0.5, ""));
    folder.write("both.ply", ply(0.5, "3 1 4 2\n"));
    let loaded = folder
        .load(
            "WorldBegin Shape \"plymesh\" \"string filename\" \"flat.ply\"
             Shape \"plymesh\" \"string filename\" \"bent.ply\"
             AreaLightSource \"diffuse\" \"float power\" 3
             Shape \"plymesh\" \"string filename\" \"both.ply\"
             Scale 1 1 0 Shape \"plymesh\" \"string filename\" \"both.ply\"",
        )
        .unwrap();
    let scene = &loaded.scene;
    assert!(scene.validate().is_ok());
    let kinds: Vec<&str> = (scene.shapes.iter())
        .map(|s| match s.geometry {
            Geometry::Mesh(_) => "mesh",
            Geometry::Patches(_) => "patches",
            _ => "other",
        })
        .collect();
    let expected = ["mesh", "patches", "mesh", "patches", "mesh", "mesh"];
    assert_eq!(kinds, expected);
    assert_eq!(scene.meshes[0].triangles.len(), 3);
    assert_eq!(scene.patch_meshes[0].patches, [[0, 1, 3, 2]]);
    // Both parts emit alike.
    assert_eq!(scene.shapes[2].emission, scene.shapes[3].emission);
    assert!(scene.shapes[2].emission.is_some());
    let mut triangles = scene.clone();
    triangles.triangulate_exact_shapes(|_| true);
    let Geometry::Mesh(id) = triangles.shapes[1].geometry else {
        panic!()
    };
    assert_eq!(triangles.meshes[id.0].triangles, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn patches_that_are_pressed_flat_are_triangles_and_lamps_have_limits() {
    let saddle = "\"bilinearmesh\" \"point3 P\" [0 0 0 1 0 1 0 1 1 1 1 0]";
    let flat = load(format!("WorldBegin Scale 1 1 0 Shape {saddle}")).unwrap();
    let [Geometry::Mesh(id)] = flat
        .scene
        .shapes
        .iter()
        .map(|s| s.geometry)
        .collect::<Vec<_>>()[..]
    else {
        panic!("{:?}", flat.scene.shapes);
    };
    let mesh = &flat.scene.meshes[id.0];
    assert!(mesh.triangles.len() > 16 && mesh.positions.iter().all(|p| p[2] == 0.0));
    let mut options = LoadOptions::default();
    options.limits.max_vertices = 30;
    let read = |light: &str| {
        let text = format!("WorldBegin {light} Shape {saddle}");
        specula_scene::load_bytes(std::path::Path::new("a.pbrt"), text.into_bytes(), &options)
    };
    assert!(read("").is_ok());
    let error = read("AreaLightSource \"diffuse\"").unwrap_err().to_string();
    assert!(error.contains("max_vertices"), "{error}");
}
