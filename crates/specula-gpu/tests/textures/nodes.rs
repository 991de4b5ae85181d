//! Textures of every kind.

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_bsdf::math::rgb;
use specula_scene::scene::{
    Channel, FloatParam, ImageId, Interpolation, MaterialId, NoiseKind, Scene, Texture, TextureId,
    TextureMapping, UvMapping, Wrap,
};
use specula_scene::{Image, Pixels, builtin};
use specula_stat::Rng;

use crate::device::Fault;
use crate::uniform;

/// A texture of the test.
pub(crate) struct Node {
    pub(crate) name: String,
    pub(crate) texture: Texture,
    /// Largest error, in ulps of the largest value for each unit of the coordinates.
    pub(crate) bound: f64,
}

/// Faults, and what shows them.
pub(crate) const FAULTS: [(Fault, &str); 20] = [
    fault(
        "texture_mapping",
        "0.5 + turn",
        "0.51 + turn",
        "mapping cylindrical",
    ),
    fault(
        "texture_mapping",
        "2.0 * polar",
        "1.99 * polar",
        "mapping spherical",
    ),
    fault(
        "texture_mapping",
        "first + 7u",
        "first + 3u",
        "mapping planar",
    ),
    fault(
        "texture_mapping",
        "place.uv, place.second_uv",
        "place.uv, place.uv",
        "mapping second uv",
    ),
    fault(
        "texture_raster",
        "1.0 - t)",
        "t)",
        "picture of bytes, nearest",
    ),
    fault(
        "texture_raster",
        "place - 0.5",
        "place - 0.49",
        "picture of floats",
    ),
    fault(
        "texture_raster",
        "2 * size - 1 - back",
        "2 * size - back",
        "wrap Mirror",
    ),
    fault(
        "texture_raster",
        "(bytes >> 8u)",
        "(bytes >> 9u)",
        "picture of bytes",
    ),
    fault(
        "texture_noise",
        "*= TEXTURE_NOISE_LACUNARITY;",
        "*= 2.0;",
        "noise fbm",
    ),
    fault(
        "texture_noise",
        "(y + cell.z)",
        "(y + cell.y)",
        "noise turbulence",
    ),
    fault("texture_noise", "0.0019353072", "0.0019", "noise marble"),
    fault(
        "texture_graph",
        "return node.first + last",
        "return node.first",
        "sum of sums",
    ),
    fault(
        "texture_graph",
        "is_second || is_alone",
        "is_second",
        "mix by a picture",
    ),
    fault("texture_graph", "0.7152", "0.7153", "channel Luminance"),
    fault(
        "texture_filter",
        "exp(-2.0 * squared)",
        "exp(-1.9 * squared)",
        "EWA, picture 1",
    ),
    fault(
        "texture_filter",
        "0.5 * log2(max",
        "0.45 * log2(max",
        "EWA, picture 1",
    ),
    fault(
        "texture_filter",
        "e.xy - scale",
        "e.xy + scale",
        "EWA, picture 0",
    ),
    fault(
        "texture_filter",
        "sqrt(max(ellipse.xx, ellipse.yy))",
        "sqrt(ellipse.xx)",
        "trilinear, picture 1",
    ),
    fault(
        "texture_mapping",
        "p.z * outwards - radius",
        "p.z * outwards + radius",
        "EWA, mapping spherical",
    ),
    fault(
        "texture_mapping",
        "footprint.changes, footprint.second_changes",
        "footprint.changes, footprint.changes",
        "EWA, mapping second uv",
    ),
];

const fn fault(
    module: &'static str,
    from: &'static str,
    to: &'static str,
    shown_by: &'static str,
) -> (Fault, &'static str) {
    (Fault { module, from, to }, shown_by)
}

/// A scene of these textures.
pub(crate) fn scene(nodes: &[Node]) -> Scene {
    let mut scene = builtin::orbs();
    scene.lights.clear();
    // One shape, of a material without textures.
    scene.shapes.truncate(1);
    scene.shapes[0].material = MaterialId(0);
    scene.materials = scene.materials.pop().into_iter().collect();
    scene.textures = nodes.iter().map(|n| n.texture.clone()).collect();
    scene.images = images();
    scene
}

/// A picture of bytes and one of floats.
pub(crate) fn images() -> Vec<Image> {
    let mut rng = Rng::from_name("pixels");
    let mut image = |width: u32, height: u32, steps: f32| Image {
        name: format!("{width} x {height}"),
        width,
        height,
        pixels: (0..width * height)
            .map(|_| {
                std::array::from_fn(|_| {
                    let x = uniform(&mut rng);
                    if steps > 0.0 {
                        (x * steps).floor() / steps
                    } else {
                        2.0 * x
                    }
                })
            })
            .collect::<Pixels>()
            .compacted(),
    };
    vec![image(13, 7, 200.0), image(24, 17, 0.0)]
}

/// Uneven coordinates, so that no two axes are the same.
fn uv() -> TextureMapping {
    TextureMapping::Uv(UvMapping([[0.9, 0.1, 0.05], [-0.2, 1.1, 0.3]]))
}

fn turned() -> DMat4 {
    DMat4::from_rotation_y(0.7)
        * DMat4::from_rotation_x(0.4)
        * DMat4::from_translation(DVec3::new(0.1, -0.2, 0.3))
        * DMat4::from_scale(DVec3::new(0.8, 0.9, 1.1))
}

/// A picture whose other properties are neutral.
struct Picture {
    image: usize,
    mapping: TextureMapping,
    wrap: [Wrap; 2],
    filter: Interpolation,
    invert: bool,
    scale: f32,
    channel: Channel,
}

impl Picture {
    fn of(image: usize) -> Self {
        Self {
            image,
            mapping: uv(),
            wrap: [Wrap::Repeat; 2],
            filter: Interpolation::Bilinear,
            invert: false,
            scale: 1.0,
            channel: Channel::Rgb,
        }
    }

    fn texture(self) -> Texture {
        Texture::Image {
            image: ImageId(self.image),
            mapping: self.mapping,
            wrap: self.wrap,
            filter: self.filter,
            invert: self.invert,
            scale: self.scale,
            channel: self.channel,
        }
    }
}

fn node(name: impl Into<String>, bound: f64, texture: Texture) -> Node {
    Node {
        name: name.into(),
        texture,
        bound,
    }
}

/// Bound of pictures: rounding of a coordinate, an ulp or two, times 24 pixels whose values are as far
/// apart as they can be.
const PICTURE: f64 = 100.0;

/// Bound of noise of 6 octaves: rounding of a coordinate times `1.99^5` and the noise's slope.
const NOISE: f64 = 100.0;

/// Nodes without inputs and without noise.
pub(crate) fn leaves() -> Vec<Node> {
    let mut nodes = vec![
        node("constant", 0.0, Texture::Constant(rgb(0.25, 0.5, 3.0))),
        node("picture of bytes", PICTURE, Picture::of(0).texture()),
        node("picture of floats", PICTURE, Picture::of(1).texture()),
        node("vertex colour", 0.0, Texture::VertexColour),
    ];
    nodes.push(node(
        "bilinear",
        10.0,
        Texture::Bilinear {
            corners: [
                rgb(1.0, 0.2, 0.1),
                rgb(0.3, 2.0, 0.4),
                rgb(0.5, 0.6, 3.0),
                Rgb::splat(0.7),
            ],
            mapping: uv(),
        },
    ));
    nodes
}

fn pictures(nodes: &mut Vec<Node>) {
    let nearest = Picture {
        filter: Interpolation::Nearest,
        ..Picture::of(0)
    };
    nodes.push(node("picture of bytes, nearest", 0.0, nearest.texture()));
    let wraps = [Wrap::Repeat, Wrap::Black, Wrap::Clamp, Wrap::Mirror];
    for (i, first) in wraps.into_iter().enumerate() {
        let wrap = [first, wraps[(i + 3) % 4]];
        for (filter, suffix) in [
            (Interpolation::Bilinear, ""),
            (Interpolation::Nearest, ", nearest"),
        ] {
            let picture = Picture {
                wrap,
                filter,
                ..Picture::of(1)
            };
            let name = format!("wrap {first:?}{suffix}");
            nodes.push(node(name, PICTURE, picture.texture()));
        }
    }
    for channel in [
        Channel::Mean,
        Channel::Luminance,
        Channel::Red,
        Channel::Green,
        Channel::Blue,
    ] {
        let picture = Picture {
            channel,
            scale: 0.7,
            filter: Interpolation::Nearest,
            ..Picture::of(1)
        };
        nodes.push(node(format!("channel {channel:?}"), 4.0, picture.texture()));
    }
    let inverted = Picture {
        invert: true,
        scale: 3.0,
        ..Picture::of(1)
    };
    nodes.push(node("inverted picture", PICTURE, inverted.texture()));
}

/// Means over footprints: kinds of filter, wraps, odd sizes; every mapping.
fn filtered(nodes: &mut Vec<Node>) {
    let most_anisotropic = Interpolation::Ewa {
        max_anisotropy: 8.0,
    };
    for (filter, name) in [
        (Interpolation::Trilinear, "trilinear"),
        (most_anisotropic, "EWA"),
    ] {
        for image in [0, 1] {
            let picture = Picture {
                filter,
                ..Picture::of(image)
            };
            let name = format!("{name}, picture {image}");
            nodes.push(node(name, PICTURE, picture.texture()));
        }
        for wrap in [Wrap::Black, Wrap::Clamp, Wrap::Mirror] {
            let picture = Picture {
                filter,
                wrap: [wrap; 2],
                ..Picture::of(1)
            };
            nodes.push(node(
                format!("{name}, wrap {wrap:?}"),
                PICTURE,
                picture.texture(),
            ));
        }
        for (mapping, of) in uneven_mappings() {
            let picture = Picture {
                filter,
                mapping,
                ..Picture::of(1)
            };
            nodes.push(node(
                format!("{name}, mapping {of}"),
                PICTURE,
                picture.texture(),
            ));
        }
    }
}

fn mappings(nodes: &mut Vec<Node>) {
    for (mapping, name) in uneven_mappings() {
        let picture = Picture {
            mapping,
            ..Picture::of(1)
        };
        nodes.push(node(format!("mapping {name}"), PICTURE, picture.texture()));
    }
}

/// All but that of surface coordinates.
fn uneven_mappings() -> [(TextureMapping, &'static str); 4] {
    let to_texture = turned();
    let planar = TextureMapping::Planar {
        to_texture,
        s: [0.3, 0.1, -0.2, 0.4],
        t: [0.1, -0.3, 0.25, -0.1],
    };
    let second = UvMapping([[0.5, 0.2, 0.1], [0.1, 0.6, -0.3]]);
    [
        (TextureMapping::SecondUv(second), "second uv"),
        (planar, "planar"),
        (TextureMapping::Spherical { to_texture }, "spherical"),
        (TextureMapping::Cylindrical { to_texture }, "cylindrical"),
    ]
}

fn noises(nodes: &mut Vec<Node>) {
    let marble = NoiseKind::Marble {
        scale: 1.7,
        variation: 0.6,
    };
    for (name, kind, bound) in [
        ("fbm", NoiseKind::Fbm, NOISE),
        ("turbulence", NoiseKind::Turbulence, NOISE),
        ("windy", NoiseKind::Windy, NOISE),
        ("marble", marble, NOISE),
    ] {
        let texture = Texture::Noise {
            kind,
            octaves: 6,
            roughness: 0.55,
            to_texture: turned(),
        };
        nodes.push(node(format!("noise {name}"), bound, texture));
    }
}

/// Every kind of node, mapping, wrap, filter and channel, and graphs of them.
pub(crate) fn all() -> Vec<Node> {
    let mut nodes = leaves();
    let [constant, bytes, floats] = [0, 1, 2].map(TextureId);
    pictures(&mut nodes);
    filtered(&mut nodes);
    mappings(&mut nodes);
    noises(&mut nodes);
    let mut add = |name: &str, bound: f64, texture: Texture| {
        nodes.push(node(name, bound, texture));
        TextureId(nodes.len() - 1)
    };
    let checks = |even, odd| Texture::Checkerboard {
        even,
        odd,
        mapping: uv(),
    };
    let product = add(
        "product",
        PICTURE,
        Texture::Scale {
            a: bytes,
            b: floats,
        },
    );
    let sum = add(
        "sum",
        PICTURE,
        Texture::Sum {
            a: product,
            b: bytes,
        },
    );
    add("sum of sums", PICTURE, Texture::Sum { a: sum, b: sum });
    let flat = add("checkerboard", PICTURE, checks(constant, product));
    let solid = Texture::Checkerboard3d {
        even: flat,
        odd: sum,
        to_texture: turned(),
    };
    let solid = add("checkerboard of checkerboards", PICTURE, solid);
    let dots = Texture::Dots {
        inside: solid,
        outside: bytes,
        mapping: uv(),
    };
    let dots = add("dots", PICTURE, dots);
    let threshold = Texture::Threshold {
        texture: sum,
        cutoff: 0.6,
    };
    let mask = add("threshold", 0.0, threshold);
    let mix = |a, b, amount| Texture::Mix { a, b, amount };
    add("mix", PICTURE, mix(dots, floats, FloatParam::Value(0.3)));
    add(
        "mix by a threshold",
        PICTURE,
        mix(dots, floats, FloatParam::Texture(mask)),
    );
    let by_picture = mix(floats, constant, FloatParam::Texture(floats));
    let mixed = add("mix by a picture", PICTURE, by_picture);
    let by_mix = mix(mask, mixed, FloatParam::Texture(mixed));
    let deep = add("mix by a mix", 4.0 * PICTURE, by_mix);
    let direction = Texture::DirectionMix {
        a: deep,
        b: constant,
        axis: [0.6, 0.0, 0.8],
    };
    add("mix by direction", 4.0 * PICTURE, direction);
    nodes
}

/// A chain of so many sums.
pub(crate) fn nested(depth: usize) -> Vec<Node> {
    let mut nodes = vec![node("picture", PICTURE, Picture::of(0).texture())];
    for i in 0..depth {
        let sum = Texture::Sum {
            a: TextureId(0),
            b: TextureId(i),
        };
        nodes.push(node("sum", PICTURE, sum));
    }
    nodes
}
