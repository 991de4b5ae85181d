//! Normal maps filtered into roughness, on the GPU beside the processor: every kind of material that has alphas.

use specula_render::RenderOptions;
use specula_scene::scene::{
    Bump, Channel, FloatParam, GltfMaterial, ImageId, Interpolation, MaterialKind,
    PrincipledMaterial, Texture, TextureId, TextureMapping, UvMapping, Wrap,
};
use specula_scene::{Image, Scene};

use super::{
    NARROW, ORANGE, ROOM, SKY, check, colour, differing, metal, on_processor, options, orbs,
    renders_all, scene, with_materials,
};

/// The scene with a normal map of waves, repeated over every surface and every clear coat.
fn wavy(mut scene: Scene, filter: Interpolation) -> Scene {
    const WIDTH: u32 = 32;
    const HEIGHT: u32 = 21;
    let pixel = |i: u32| {
        let [x, y] = [(i % WIDTH) as f32 / 32.0, (i / WIDTH) as f32 / 21.0];
        let turn = |a: f32| (core::f32::consts::TAU * a).sin();
        let [p, q] = [
            0.4 * turn(3.0 * x + y),
            0.2 * turn(x - 4.0 * y) + 0.1 * turn(3.0 * x),
        ];
        let length = (p * p + q * q + 1.0).sqrt();
        [p, q, 1.0].map(|n| 0.5 + 0.5 * n / length)
    };
    let image = ImageId(scene.images.len());
    scene.images.push(Image {
        name: "waves".into(),
        width: WIDTH,
        height: HEIGHT,
        pixels: (0..WIDTH * HEIGHT).map(pixel).collect(),
    });
    let map = TextureId(scene.textures.len());
    scene.textures.push(Texture::Image {
        image,
        mapping: TextureMapping::Uv(UvMapping([[3.0, 0.2, 0.1], [-0.1, 4.0, 0.3]])),
        wrap: [Wrap::Repeat, Wrap::Mirror],
        filter,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    });
    for material in &mut scene.materials {
        material.bump = Some(Bump::Normal { map, scale: 0.8 });
        if let MaterialKind::Gltf(g) = &mut material.kind {
            g.clearcoat_bump = Some(Bump::Normal { map, scale: 0.4 });
        }
    }
    scene
}

fn filtered(options: RenderOptions) -> RenderOptions {
    RenderOptions {
        filter_normal_maps: true,
        ..options
    }
}

#[test]
fn metal_and_glass() {
    let mirror = "Material \"conductor\" \"float roughness\" 0";
    let glass = "Material \"dielectric\" \"float roughness\" 0.1";
    let coated = "Material \"coatedconductor\" \"float interface.roughness\" 0";
    let plastic = "Material \"coateddiffuse\" \"float roughness\" 0.2";
    let around = |material: &str, x: f32| {
        format!(
            "AttributeBegin\n{material}\nTranslate {x} -0.9 0.3\nShape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n"
        )
    };
    let mut text = vec![orbs([mirror, &metal(NARROW)]), around(glass, -0.8)];
    if renders_all() {
        text.extend([around(coated, 0.0), around(plastic, 0.8)]);
    }
    let text = format!("{ROOM}{SKY}{}", text.concat());
    let scene = wavy(scene(&text), Interpolation::Bilinear);
    let plain = options(&scene, 1);
    let [without, with] = [plain.clone(), filtered(plain)].map(|o| on_processor(&scene, &o, 2));
    assert!(
        differing(&without, &with) > 0.2,
        "the option changes nothing"
    );
    check("normal maps into roughness: metal, glass", &scene, filtered);
}

#[test]
fn principled_and_gltf() {
    let value = FloatParam::Value;
    let none = value(0.0);
    let principled = PrincipledMaterial {
        base_colour: ORANGE,
        roughness: value(0.3),
        anisotropic: value(0.5),
        metallic: value(0.6),
        spec_trans: none,
        eta: 1.5,
        spec_tint: none,
        sheen: none,
        sheen_tint: none,
        clearcoat: value(0.6),
        clearcoat_gloss: value(0.9),
        flatness: none,
        diff_trans: none,
        thin: false,
    };
    let gltf = GltfMaterial {
        base_colour: ORANGE,
        metallic: value(0.8),
        roughness: value(0.3),
        anisotropy: value(0.4),
        anisotropy_rotation_rad: 0.6,
        anisotropy_direction: None,
        ior: 1.5,
        specular: value(0.8),
        specular_colour: colour(0.9, 0.8, 0.7),
        transmission: none,
        volume: false,
        clearcoat: value(0.7),
        clearcoat_roughness: value(0.1),
        clearcoat_bump: None,
        sheen_colour: colour(0.0, 0.0, 0.0),
        sheen_roughness: none,
    };
    let principled = MaterialKind::Principled(principled);
    let kinds = match renders_all() {
        true => [principled, MaterialKind::Gltf(gltf)],
        false => [principled; 2],
    };
    let scene = wavy(with_materials(kinds), Interpolation::Trilinear);
    check(
        "normal maps into roughness: principled, glTF",
        &scene,
        filtered,
    );
}
