//! The 0.6 dialect.

use glam::DVec3;
use specula_scene::scene::{
    ColourParam, ConductorFresnel, Light, MaterialKind, Projection, Texture, TextureMapping,
};

use super::common::{Folder, warnings};

/// A little of everything.
const SCENE: &str = r##"<scene version="0.5.0">
            <integrator type="path"><integer name="maxDepth" value="4"/></integrator>
            <sensor type="thinlens">
              <float name="fov" value="60"/><string name="fovAxis" value="x"/>
              <float name="apertureRadius" value="0.1"/><float name="focusDistance" value="3"/>
              <transform name="toWorld"><lookAt origin="0,0,4" target="0,0,0" up="0,1,0"/></transform>
              <sampler type="ldsampler"><integer name="sampleCount" value="9"/></sampler>
              <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="64"/>
                <boolean name="banner" value="false"/><rfilter type="box"/></film>
            </sensor>
            <bsdf type="diffuse" id="red"><srgb name="diffuseReflectance" value="#ff8000"/></bsdf>
            <bsdf type="dielectric" id="glass"><float name="intIOR" value="1.5"/>
              <float name="extIOR" value="1"/></bsdf>
            <shape type="rectangle"><ref id="red"/></shape>
            <shape type="sphere"><point name="center" x="1" y="2" z="3"/>
              <float name="radius" value="0.5"/><ref id="glass"/></shape>
            <shape type="cube"><bsdf type="conductor"/></shape>
            <shape type="disk"><bsdf type="diffuse"><texture name="reflectance" type="bitmap">
              <string name="filename" value="t.png"/><float name="uscale" value="4"/>
              <float name="voffset" value="0.25"/></texture></bsdf></shape>
            <luminaire type="point"><point name="position" x="1" y="2" z="3"/>
              <spectrum name="intensity" value="2"/></luminaire>
            </scene>"##;

#[test]
fn a_scene_of_the_old_dialect_is_upgraded() {
    let folder = Folder::new();
    folder.write("t.png", png());
    let loaded = folder
        .load(SCENE)
        .unwrap_or_else(|e| panic!("{}: {e}", e.place()));
    let scene = &loaded.scene;
    assert_eq!(warnings(&loaded), [""; 0]);
    assert_eq!(
        (scene.settings.max_depth, scene.settings.samples_per_pixel),
        (3, 9)
    );
    assert!(
        matches!(scene.camera.projection, Projection::Perspective { fov_deg } if (fov_deg - 60.0).abs() < 1e-9)
    );
    assert_eq!(
        (scene.camera.lens_radius, scene.camera.focal_distance),
        (0.1, 3.0)
    );
    let forward = scene.camera.to_world.transform_vector3(DVec3::Z);
    assert!(forward.distance(-DVec3::Z) < 1e-12);
    match scene.materials[0].kind {
        MaterialKind::Diffuse {
            reflectance: ColourParam::Value(c),
            ..
        } => assert!(
            (c.g - 0.215_86).abs() < 1e-4 && c.r == 1.0 && c.b == 0.0,
            "{c:?}"
        ),
        ref other => panic!("{other:?}"),
    }
    assert!(matches!(scene.materials[1].kind, MaterialKind::Dielectric { eta, .. } if eta == 1.5));
    // Its conductors are copper unless they say otherwise.
    assert!(matches!(
        scene.materials[2].kind,
        MaterialKind::Conductor {
            fresnel: ConductorFresnel::Index { .. },
            ..
        }
    ));
    let Light::Point {
        intensity,
        position,
    } = scene.lights[0]
    else {
        panic!("{:?}", scene.lights[0]);
    };
    assert_eq!(
        (intensity.to_array(), position),
        ([2.0; 3], [1.0, 2.0, 3.0])
    );
    // u' = 4 r and v' = phi + 1/4 on a disk, whose own u is phi and whose v is 1 - r; t = 1 - v'.
    let Some(Texture::Image {
        mapping: TextureMapping::Uv(rows),
        ..
    }) = scene.textures.first()
    else {
        panic!("{:?}", scene.textures);
    };
    assert_eq!(rows.0, [[0.0, -4.0, 4.0], [-1.0, 0.0, 0.75]]);
}

#[test]
fn materials_of_the_old_dialect_have_stand_ins() {
    let folder = Folder::new();
    for (plugin, parts) in [
        ("phong", 3),
        ("ward", 3),
        ("roughdiffuse", 1),
        ("difftrans", 1),
    ] {
        let loaded = folder
            .load(format!(
                r#"<scene version="0.6.0"><sensor type="perspective"/><emitter type="constant"/>
                <shape type="cube"><bsdf type="{plugin}"/></shape></scene>"#
            ))
            .unwrap();
        assert_eq!(loaded.scene.materials.len(), parts, "{plugin}");
    }
    let loaded = folder
        .load(
            r#"<scene version="0.6.0"><sensor type="perspective"/><emitter type="constant"/>
            <shape type="cube"><bsdf type="coating"><bsdf type="diffuse"/></bsdf></shape>
            <shape type="cube"><bsdf type="mixturebsdf"><string name="weights" value="1 1 2"/>
            <bsdf type="diffuse"/><bsdf type="conductor"/><bsdf type="plastic"/></bsdf></shape></scene>"#,
        )
        .unwrap();
    let kinds: Vec<_> = loaded.scene.materials.iter().map(|m| m.kind).collect();
    assert!(
        kinds
            .iter()
            .any(|k| matches!(k, MaterialKind::CoatedDiffuse { .. }))
    );
    let shares: Vec<_> = kinds
        .iter()
        .filter_map(|k| match k {
            MaterialKind::Mix { amount, .. } => Some(*amount),
            _ => None,
        })
        .collect();
    assert_eq!(
        shares,
        [0.5, 0.5].map(specula_scene::scene::FloatParam::Value),
        "1 and 1, then both against 2"
    );
}

/// A picture of two grey pixels.
fn png() -> Vec<u8> {
    // 2 x 1, eight-bit grey, values 128 and 255.
    include_bytes!("grey.png").to_vec()
}
