//! Mitsuba's conventions in the scene model's terms. Numbers named so were read off Mitsuba 3.9.1.

use glam::{DVec3, Vec3};
use specula_bsdf::ndf::Masking;
use specula_scene::scene::*;

use super::common::{Folder, REST, load, load_shape, warnings};

fn close(a: DVec3, b: [f64; 3]) {
    assert!(a.distance(b.into()) < 1e-9, "{a} != {b:?}");
}

fn camera(inside: &str) -> (Camera, Film) {
    let scene = format!(
        r#"<scene version="3.0.0"><sensor {inside}</sensor><emitter type="constant"/>
        <shape type="cube"/></scene>"#
    );
    let loaded = Folder::new().load(scene).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(warnings(&loaded), [""; 0]);
    (loaded.scene.camera, loaded.scene.film)
}

#[test]
fn pictures_are_not_mirrored() {
    let (camera, _) = camera(
        r#"type="perspective"><transform name="to_world">
        <lookat origin="-4,0,0" target="0,0,0" up="0,0,1"/></transform>"#,
    );
    // Looking along +x with +z up, -y is to the right.
    close(
        camera.to_world.transform_vector3(DVec3::X),
        [0.0, -1.0, 0.0],
    );
    close(camera.to_world.transform_vector3(DVec3::Y), [0.0, 0.0, 1.0]);
    close(camera.to_world.transform_vector3(DVec3::Z), [1.0, 0.0, 0.0]);
}

#[test]
fn fields_of_view_are_along_the_axis_that_is_named() {
    let film = r#"<film type="hdrfilm"><integer name="width" value="200"/>
        <integer name="height" value="100"/></film>"#;
    let fov = |what: &str| match camera(&format!("type=\"perspective\">{what}{film}")) {
        (
            Camera {
                projection: Projection::Perspective { fov_deg },
                ..
            },
            _,
        ) => fov_deg,
        other => panic!("{other:?}"),
    };
    let vertical = |half_width: f64| 2.0 * (half_width / 2.0).atan().to_degrees();
    let tan30 = 30_f64.to_radians().tan();
    let with = |axis: &str| {
        fov(&format!(
            r#"<float name="fov" value="60"/><string name="fov_axis" value="{axis}"/>"#
        ))
    };
    for (axis, expected) in [
        ("x", vertical(tan30)),
        ("y", 60.0),
        ("smaller", 60.0),
        ("larger", vertical(tan30)),
        ("diagonal", vertical(tan30 * 2.0 / 5_f64.sqrt())),
    ] {
        assert!(
            (with(axis) - expected).abs() < 1e-9,
            "{axis}: {}",
            with(axis)
        );
    }
    // 50 mm over the diagonal of 36 x 24 mm.
    let diagonal = (36.0_f64 * 36.0 + 24.0 * 24.0).sqrt() / 100.0;
    assert!((fov("") - vertical(diagonal * 2.0 / 5_f64.sqrt())).abs() < 1e-9);
}

#[test]
fn the_principal_point_moves_the_window() {
    let (camera, film) = camera(
        r#"type="perspective"><float name="principal_point_offset_x" value="0.25"/>
        <float name="principal_point_offset_y" value="-0.5"/>
        <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/>
        <integer name="crop_offset_x" value="2"/><integer name="crop_width" value="3"/>
        <rfilter type="catmullrom"/></film>"#,
    );
    assert_eq!(camera.screen_window, [-0.5, 1.5, 0.0, 2.0]);
    assert_eq!(film.crop, [2, 5, 0, 8]);
    assert_eq!(
        film.filter,
        Filter::Mitchell {
            radius: [2.0; 2],
            b: 0.0,
            c: 0.5
        }
    );
}

#[test]
fn environment_maps_have_y_up_and_begin_behind() {
    let folder = Folder::new();
    folder.write("sky.png", include_bytes!("grey.png"));
    let loaded = folder
        .load(
            r#"<scene version="3.0.0"><emitter type="envmap"><string name="filename" value="sky.png"/>
            <float name="scale" value="3"/></emitter><shape type="cube"/>
            <sensor type="perspective"/></scene>"#
        )
        .unwrap();
    let Light::Infinite {
        radiance,
        image: Some((_, EnvironmentMapping::LatitudeLongitudePoles)),
        to_world,
    } = loaded.scene.lights[0]
    else {
        panic!("{:?}", loaded.scene.lights);
    };
    assert_eq!(radiance.to_array(), [3.0; 3]);
    // Mitsuba: u = atan2(x, -z) / 2 pi, v = acos(y) / pi.
    close(to_world.transform_vector3(DVec3::X), [0.0, 0.0, -1.0]);
    close(to_world.transform_vector3(DVec3::Y), [1.0, 0.0, 0.0]);
    close(to_world.transform_vector3(DVec3::Z), [0.0, 1.0, 0.0]);
}

#[test]
fn lights_emit_along_z() {
    let loaded = load(
        r#"<shape type="cube"/>
        <emitter type="spot"><transform name="to_world"><rotate x="1" angle="90"/>
        <translate x="1"/></transform></emitter>
        <emitter type="directional"><vector name="direction" value="0, 0, -2"/></emitter>
        <emitter type="directional"><transform name="to_world"><rotate y="1" angle="90"/></transform>
        <rgb name="irradiance" value="2"/></emitter>"#,
    )
    .unwrap();
    let Light::Spot {
        position,
        axis,
        cone_angle_deg,
        falloff_start_deg,
        falloff,
        ..
    } = loaded.scene.lights[0]
    else {
        panic!("{:?}", loaded.scene.lights);
    };
    close(position.into(), [1.0, 0.0, 0.0]);
    close(axis.into(), [0.0, -1.0, 0.0]);
    assert_eq!((cone_angle_deg, falloff_start_deg), (20.0, 15.0));
    assert_eq!(falloff, SpotFalloff::LinearAngle);
    for (light, expected) in [(1, [0.0, 0.0, 1.0]), (2, [-1.0, 0.0, 0.0])] {
        let Light::Distant { to_light, .. } = loaded.scene.lights[light] else {
            panic!("{:?}", loaded.scene.lights);
        };
        close(to_light.into(), expected);
    }
}

#[test]
fn transforms_apply_from_top_to_bottom() {
    let loaded = load_shape(
        r#"<transform name="to_world"><translate x="1"/><scale value="2"/>
        <rotate z="1" angle="90"/></transform>"#,
    );
    let to_world = loaded.unwrap().scene.shapes[0].to_world;
    close(to_world.transform_point3(DVec3::ZERO), [0.0, 2.0, 0.0]);
}

#[test]
fn two_bsdfs_are_two_sides() {
    let text = r#"<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="conductor"/></bsdf>"#;
    let loaded = load_shape(text).unwrap();
    assert_eq!(loaded.warnings.len(), 0, "{:?}", loaded.warnings);
    let scene = &loaded.scene;
    let sided = &scene.materials[scene.shapes[0].material.0];
    let MaterialKind::Sided([front, back]) = sided.kind else {
        panic!("{sided:?}")
    };
    let [front, back] = [front, back].map(|m| &scene.materials[m.0]);
    assert!(matches!(front.kind, MaterialKind::Diffuse { .. }));
    assert!(matches!(back.kind, MaterialKind::Conductor { .. }));
    assert!(!(sided.one_sided || front.one_sided || back.one_sided));
    for (more, what) in [
        ("plastic", "more than two"),
        ("dielectric", "lets light through"),
    ] {
        let more = format!(r#"<bsdf type="{more}"/>"#);
        let wrong = match what {
            "more than two" => text.replace("</bsdf>", &format!("{more}</bsdf>")),
            _ => text.replace(r#"<bsdf type="conductor"/>"#, &more),
        };
        let error = load_shape(&wrong).unwrap_err();
        assert!(error.message().contains(what), "{error}");
    }
}

#[test]
fn opaque_materials_have_one_side_unless_they_are_told() {
    for (bsdf, one_sided) in [
        (r#"<bsdf type="diffuse"/>"#, true),
        (
            r#"<bsdf type="twosided"><bsdf type="diffuse"/></bsdf>"#,
            false,
        ),
        (
            r#"<bsdf type="mask"><bsdf type="twosided"><bsdf type="plastic"/></bsdf></bsdf>"#,
            false,
        ),
        (r#"<bsdf type="roughconductor"/>"#, true),
        (r#"<bsdf type="dielectric"/>"#, false),
        ("", true),
    ] {
        let loaded = load_shape(bsdf).unwrap();
        let material = loaded.scene.shapes[0].material.0;
        assert_eq!(
            loaded.scene.materials[material].one_sided, one_sided,
            "{bsdf}"
        );
    }
}

#[test]
fn roughness_is_beckmanns_and_separable_unless_it_says_ggx() {
    for (inside, distribution) in [
        ("", MicrofacetDistribution::Beckmann),
        (
            r#"<string name="distribution" value="ggx"/>"#,
            MicrofacetDistribution::Ggx,
        ),
    ] {
        let loaded = load_shape(&format!(
            r#"<bsdf type="roughdielectric">{inside}<float name="alpha_u" value="0.2"/>
            <float name="alpha_v" value="0.4"/></bsdf>"#
        ));
        let MaterialKind::Dielectric { roughness, eta, .. } =
            loaded.unwrap().scene.materials[0].kind
        else {
            panic!();
        };
        assert_eq!(roughness.distribution, distribution);
        assert_eq!(roughness.masking, Masking::Separable);
        assert_eq!(roughness.mapping, RoughnessMapping::Alpha);
        assert_eq!(
            (roughness.u, roughness.v),
            (FloatParam::Value(0.2), FloatParam::Value(0.4))
        );
        assert!((f64::from(eta) - 1.5046 / 1.000_277).abs() < 1e-6);
    }
}

/// Two checks to the unit; numbers have the other phase than colours.
#[test]
fn checkerboards_are_as_mitsuba_has_them() {
    let board = r#"type="checkerboard"><float name="color0" value="0.1"/>
        <float name="color1" value="0.9"/><transform name="to_uv"><scale x="3" y="5"/></transform>"#;
    let loaded = load_shape(&format!(
        r#"<bsdf type="principled"><texture name="base_color" {board}</texture>
        <texture name="roughness" {board}</texture></bsdf>"#
    ))
    .unwrap();
    let textures = &loaded.scene.textures;
    let boards: Vec<_> = textures
        .iter()
        .filter_map(|t| match t {
            Texture::Checkerboard { even, mapping, .. } => {
                assert_eq!(
                    *mapping,
                    TextureMapping::Uv(UvMapping::scaled([6.0, 10.0], [0.0; 2]))
                );
                Some(textures[even.0].clone())
            }
            _ => None,
        })
        .collect();
    let constant = |x: f32| Texture::Constant(specula_bsdf::Rgb::splat(x));
    assert_eq!(boards, [constant(0.1), constant(0.9)]);
}

#[test]
fn pictures_run_down_with_v_and_coordinates_of_obj_are_flipped() {
    let folder = Folder::new();
    folder.write("t.png", include_bytes!("grey.png"));
    folder.write(
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 0.75\nf 1/1 2/2 3/3\n",
    );
    let loaded = folder
        .load(format!(
            r#"<scene version="3.0.0"><shape type="obj"><string name="filename" value="a.obj"/>
            <bsdf type="diffuse"><texture name="reflectance" type="bitmap">
            <string name="filename" value="t.png"/><string name="wrap_mode" value="mirror"/>
            <string name="filter_type" value="nearest"/></texture></bsdf></shape>{REST}</scene>"#
        ))
        .unwrap();
    assert_eq!(loaded.scene.meshes[0].uvs[2], [0.0, 0.25]);
    let Texture::Image {
        mapping,
        wrap,
        filter,
        channel,
        ..
    } = &loaded.scene.textures[0]
    else {
        panic!("{:?}", loaded.scene.textures);
    };
    assert_eq!(
        *mapping,
        TextureMapping::Uv(UvMapping([[1.0, 0.0, 0.0], [0.0, -1.0, 1.0]]))
    );
    assert_eq!(
        (*wrap, *filter, *channel),
        ([Wrap::Mirror; 2], Interpolation::Nearest, Channel::Rgb)
    );
}

/// Mitsuba gives meshes without normals smooth ones, of the triangles' own side.
#[test]
fn meshes_without_normals_get_some_and_mirrors_turn_them_over() {
    let folder = Folder::new();
    folder.write("flat.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
    folder.write(
        "own.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n",
    );
    let shape = |file: &str, more: &str| {
        let loaded = folder
            .load(format!(
                r#"<scene version="3.0.0"><shape type="obj"><string name="filename" value="{file}"/>
                {more}</shape>{REST}</scene>"#
            ))
            .unwrap();
        (
            loaded.scene.meshes[0].clone(),
            loaded.scene.shapes[0].reverse_orientation,
        )
    };
    let mirror = r#"<transform name="to_world"><scale x="-1"/></transform>"#;
    let flip = r#"<boolean name="flip_normals" value="true"/>"#;
    let faces = r#"<boolean name="face_normals" value="true"/>"#;
    assert_eq!(shape("flat.obj", "").0.normals, [[0.0, 0.0, 1.0]; 3]);
    assert!(shape("flat.obj", faces).0.normals.is_empty());
    assert!(shape("own.obj", faces).0.normals.is_empty());
    for (file, more, reversed) in [
        ("flat.obj", mirror.to_owned(), true),
        ("flat.obj", format!("{mirror}{flip}"), false),
        ("flat.obj", format!("{mirror}{faces}"), true),
        ("own.obj", mirror.to_owned(), false),
        ("own.obj", flip.to_owned(), true),
    ] {
        assert_eq!(shape(file, &more).1, reversed, "{file} {more}");
    }
}

#[test]
fn groups_are_copied() {
    let loaded = load(
        r#"<shape type="shapegroup" id="g"><shape type="sphere"/><shape type="merge">
        <shape type="cube"/><shape type="rectangle"/></shape></shape>
        <shape type="instance"><ref id="g"/><transform name="to_world"><translate x="2"/></transform>
        </shape><shape type="instance"><ref id="g"/></shape>"#,
    )
    .unwrap();
    assert_eq!(loaded.scene.objects[0].shapes.len(), 3);
    assert_eq!(loaded.scene.instances.len(), 2);
    assert!(loaded.scene.shapes.is_empty());
}

#[test]
fn emitters_without_a_bsdf_are_black() {
    let loaded =
        load_shape(r#"<emitter type="area"><rgb name="radiance" value="1 2 3"/></emitter>"#);
    let loaded = loaded.unwrap();
    let shape = &loaded.scene.shapes[0];
    assert!(matches!(
        loaded.scene.materials[shape.material.0].kind,
        MaterialKind::Diffuse { reflectance: ColourParam::Value(c), .. } if c.is_black()
    ));
    let emission = shape.emission.unwrap();
    assert!(!emission.two_sided);
    assert!(matches!(emission.radiance, ColourParam::Value(c) if c.to_array() == [1.0, 2.0, 3.0]));
}

#[test]
fn the_sky_is_as_bright_as_mitsubas() {
    let loaded = load(
        r#"<shape type="cube"/><emitter type="sunsky"><vector name="sun_direction" value="0.6 0 0.8"/>
        <float name="sun_aperture" value="1"/></emitter>"#,
    )
    .unwrap();
    let scene = &loaded.scene;
    let Light::Distant {
        half_angle_deg,
        irradiance,
        ..
    } = scene.lights[1]
    else {
        panic!("{:?}", scene.lights);
    };
    assert_eq!(half_angle_deg, 0.5);
    assert!(irradiance.r > irradiance.g && irradiance.g > irradiance.b);
    // Irradiance of the ground, from the picture: rows run from the zenith.
    let image = &scene.images[0];
    let mut sum = Vec3::ZERO;
    for (y, row) in image.pixels.rows(image.width).enumerate() {
        let theta = std::f32::consts::PI * (y as f32 + 0.5) / image.height as f32;
        let weight = theta.sin() * theta.cos().max(0.0);
        sum += row.map(Vec3::from).sum::<Vec3>() * weight;
    }
    let cell = 2.0 * std::f32::consts::PI.powi(2) / (image.width * image.height) as f32;
    let found = sum * cell;
    // Between Mitsuba's values for 30 and 45 degrees at turbidity 3.
    assert!(
        found.x > 0.15 && found.x < 0.19 && found.z > 0.40 && found.z < 0.48,
        "{found}"
    );
    assert!(
        image.pixels.rgb(image.pixels.len() - 1) == [0.0; 3],
        "nothing below the horizon"
    );
}

#[test]
fn shapes_are_pressed_flat() {
    let flat = "<transform name=\"to_world\"><scale x=\"1\" y=\"1\" z=\"0\"/></transform>";
    let loaded = load(&format!(
        "<shape type=\"cube\">{flat}</shape><shape type=\"sphere\">{flat}</shape>\
         <shape type=\"shapegroup\" id=\"g\"><shape type=\"rectangle\"/></shape>\
         <shape type=\"instance\"><ref id=\"g\"/>{flat}</shape>\
         <shape type=\"cylinder\">{flat}</shape>"
    ))
    .unwrap();
    let scene = &loaded.scene;
    assert_eq!((scene.shapes.len(), scene.instances.len()), (3, 0));
    let triangles: Vec<usize> = scene.meshes.iter().map(|m| m.triangles.len()).collect();
    assert!(
        triangles.contains(&4),
        "two of a cube's six faces: {triangles:?}"
    );
    let pressed = |part: &str| {
        loaded
            .warnings
            .iter()
            .filter(|w| w.message().contains(part))
            .count()
    };
    assert_eq!((pressed("rendered flat"), pressed("no area")), (3, 1));
    assert!(scene.validate().is_ok());
}
