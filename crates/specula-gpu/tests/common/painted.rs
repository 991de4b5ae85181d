//! Scenes whose diffuse surfaces have a picture.

use specula_scene::scene::{
    Channel, ColourParam, ImageId, Interpolation, MaterialKind, Texture, TextureId, TextureMapping,
    UvMapping, Wrap,
};
use specula_scene::{Image, Scene};

/// The scene with a picture of coloured stripes and checks, repeated over every diffuse surface.
pub(crate) fn painted(mut scene: Scene, filter: Interpolation) -> Scene {
    const WIDTH: u32 = 48;
    const HEIGHT: u32 = 37;
    let image = ImageId(scene.images.len());
    let pixel = |i: u32| {
        let (x, y) = (i % WIDTH, i / WIDTH);
        let bright = |odd: bool| if odd { 0.9 } else { 0.15 };
        [
            bright(x / 4 % 2 == 1),
            bright((x / 6 + y / 5) % 2 == 1),
            bright(y % 2 == 1),
        ]
    };
    scene.images.push(Image {
        name: "stripes".into(),
        width: WIDTH,
        height: HEIGHT,
        pixels: (0..WIDTH * HEIGHT).map(pixel).collect(),
    });
    let texture = TextureId(scene.textures.len());
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
        if let MaterialKind::Diffuse { reflectance, .. } = &mut material.kind {
            *reflectance = ColourParam::Texture(texture);
        }
    }
    scene
}
