//! Textures, bump maps, cut-outs and what lights project, on the GPU beside the processor.

#[path = "../common/painted.rs"]
mod stripes;

use glam::DMat4;
use specula_bsdf::Rgb;
use specula_scene::Scene;
use specula_scene::scene::{
    ColourParam, EnvironmentMapping, ImageProjection, Interpolation, Light, Profile, Projection,
    Texture, TextureId, TextureMapping,
};

use super::{NARROW, ROOM, SKY, check, differing, metal, on_processor, options, orbs, scene};

#[test]
fn lights_that_vary_and_projected_pictures() {
    let room = "
Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 6 \"float vscale\" 6 \"float tex1\" 1 \"float tex2\" 0.2
Material \"diffuse\"
Shape \"disk\" \"float radius\" 4
AttributeBegin
AreaLightSource \"diffuse\"
Shape \"trianglemesh\" \"point3 P\" [-1.5 1 0.2  0.5 1 0.2  0.5 1.4 1.8  -1.5 1.4 1.8] \"point2 uv\" [0 0 1 0 1 1 0 1] \"integer indices\" [0 1 2 0 2 3]
AttributeEnd
AttributeBegin
AreaLightSource \"diffuse\" \"rgb L\" [2 3 4] \"bool twosided\" true
Translate 1 0 0.7
Shape \"sphere\" \"float radius\" 0.4 \"texture alpha\" \"holes\"
AttributeEnd
";
    let painted = |scene: &mut Scene| {
        let texture = TextureId(scene.textures.len());
        scene.textures.push(Texture::Bilinear {
            corners: [[0.0; 3], [4.0, 2.0, 1.0], [1.0, 3.0, 5.0], [9.0; 3]].map(Rgb::from),
            mapping: TextureMapping::default(),
        });
        ColourParam::Texture(texture)
    };
    let mut vary = scene(room);
    let radiance = painted(&mut vary);
    for emission in vary.shapes.iter_mut().filter_map(|s| s.emission.as_mut()) {
        emission.radiance = radiance;
    }
    check("lights that vary", &vary, |o| o);
    let mut projected = scene("Material \"diffuse\" Shape \"disk\" \"float radius\" 4");
    let intensity = painted(&mut projected);
    projected.lights.push(Light::Picture {
        to_world: DMat4::from_translation([0.0, 0.0, 1.5].into())
            * DMat4::from_rotation_x(std::f64::consts::PI),
        intensity,
        image_projection: ImageProjection::Window {
            half: [0.9, 0.6],
            profile: Profile::Intensity,
        },
    });
    check("projected pictures", &projected, |o| o);
}

#[test]
fn textures_bumps_and_cut_outs() {
    let textures = "
Texture \"squares\" \"spectrum\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 8 \"rgb tex1\" [0.1 0.3 0.7] \"rgb tex2\" [0.8 0.7 0.2]
Texture \"spots\" \"float\" \"fbm\" \"integer octaves\" 4
Texture \"rough\" \"float\" \"scale\" \"texture tex\" \"spots\" \"float scale\" 0.4
Texture \"bumps\" \"float\" \"scale\" \"texture tex\" \"spots\" \"float scale\" 0.05
Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 6 \"float vscale\" 6 \"float tex1\" 1 \"float tex2\" 0.2
";
    let painted = "Material \"diffuse\" \"texture reflectance\" \"squares\" \"texture displacement\" \"bumps\"";
    let worn =
        "Material \"conductor\" \"rgb reflectance\" [0.9 0.8 0.7] \"texture roughness\" \"rough\"";
    let text = format!("{ROOM}{SKY}{textures}{}", orbs([painted, worn]));
    check("textures, bumps", &scene(&text), |o| o);
    let veil = "Material \"diffuse\" Shape \"disk\" \"float radius\" 1 \"float height\" 1.4 \"texture alpha\" \"holes\"\n";
    check(
        "cut-outs",
        &scene(&format!("{ROOM}{SKY}{textures}{veil}")),
        |o| o,
    );
}

/// Behind mirrors, smooth and rough glass, and rough metal, seen by every kind of camera.
#[test]
fn filtered_textures() {
    let mirror = "Material \"conductor\" \"float roughness\" 0";
    let frosted = "Material \"dielectric\" \"float roughness\" 0.3";
    let around = |material: &str, x: f32| {
        format!(
            "AttributeBegin\n{material}\nTranslate {x} 0.9 0.4\nShape \"sphere\" \"float radius\" 0.4\nAttributeEnd\n"
        )
    };
    let bumps = "Texture \"spots\" \"float\" \"fbm\" \"integer octaves\" 4\n\
        Texture \"bumps\" \"float\" \"scale\" \"texture tex\" \"spots\" \"float scale\" 0.05\n\
        Material \"diffuse\" \"texture displacement\" \"bumps\"\n\
        Shape \"disk\" \"float radius\" 1 \"float height\" 0.02\n";
    let all = [
        orbs([mirror, "Material \"dielectric\""]),
        around(frosted, 0.5),
        around(&metal(NARROW), -0.5),
        bumps.to_owned(),
    ];
    let scene_of = |text: &str, filter| stripes::painted(scene(text), filter);
    let full = format!("{ROOM}{SKY}{}", all.concat());
    let ewa = Interpolation::EWA;
    check("filtered textures", &scene_of(&full, ewa), |o| o);
    let mut floor = scene_of(ROOM, Interpolation::Trilinear);
    let filtered = on_processor(&floor, &options(&floor, 1), 2);
    let sharp = scene_of(ROOM, Interpolation::Bilinear);
    let sharp = on_processor(&sharp, &options(&sharp, 1), 2);
    assert!(differing(&filtered, &sharp) > 0.2, "filters change nothing");
    floor.camera.projection = Projection::Orthographic;
    floor.camera.screen_window = [-2.0, 2.0, -1.6, 1.6];
    check("filtered, orthographic", &floor, |o| o);
    floor.camera.projection = Projection::Spherical(EnvironmentMapping::LatitudeLongitude);
    check("filtered, all around", &floor, |o| o);
}
