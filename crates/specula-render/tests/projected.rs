//! Lights that project images, against the formats' own renderers and closed forms.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]

mod common;

use std::fs;
use std::path::Path;

use common::*;
use core::f64::consts::PI;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::Strategy;
use specula_render::picture::Picture;
use specula_scene::scene::*;
use specula_scene::{Image, load};

/// The pictures that the references threw, 8-bit sRGB.
const COLOURS: [[u8; 3]; 12] = [
    [255, 0, 0],
    [75, 250, 150],
    [150, 50, 225],
    [225, 125, 25],
    [125, 25, 200],
    [200, 100, 0],
    [0, 175, 75],
    [75, 250, 150],
    [250, 150, 50],
    [50, 225, 125],
    [125, 25, 200],
    [0, 255, 40],
];
const GREYS: [u8; 16] = [
    255, 75, 150, 225, 125, 200, 0, 75, 250, 50, 125, 200, 100, 0, 250, 50,
];

fn write_png(path: &Path, width: u32, pixels: &[[u8; 3]]) {
    let height = u32::try_from(pixels.len()).unwrap() / width;
    let file = fs::File::create(path).unwrap();
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&pixels.concat()).unwrap();
}

/// Loads and renders a file next to the two pictures; nothing of it may be an approximation.
fn rendered(name: &str, text: &str) -> Picture {
    let folder = tempfile::tempdir().unwrap();
    write_png(&folder.path().join("p.png"), 4, &COLOURS);
    write_png(&folder.path().join("g.png"), 4, &GREYS.map(|v| [v; 3]));
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    let loaded = load(&path).unwrap();
    let warnings: Vec<&str> = loaded.warnings.iter().map(|w| w.message()).collect();
    assert!(warnings.is_empty(), "{warnings:?}");
    render(&loaded.scene, 4096, 1, Strategy::Mis)
}

/// Every pixel of 4 x 4 within 4.5 standard errors and a share of the reference's largest channel
/// there, or of the picture's mean where a pixel is nearly dark.
fn assert_same(what: &str, picture: &Picture, reference: &[[f64; 3]; 16], share: f64) {
    let mean = reference.iter().flatten().sum::<f64>() / 48.0;
    for (i, expected) in reference.iter().enumerate() {
        let largest = expected.iter().copied().fold(0.2 * mean, f64::max);
        let found = picture.colour[i].to_array().map(f64::from);
        let variance = picture.variance[i].to_array().map(f64::from);
        for c in 0..3 {
            let bound = 4.5 * variance[c].sqrt() + share * largest;
            let off = (found[c] - expected[c]).abs();
            assert!(off < bound, "{what}, pixel {i}: {found:?} {expected:?}");
        }
    }
}

fn mitsuba(emitter: &str) -> Picture {
    let place = "<transform name=\"to_world\"><lookat origin=\"1, -1.5, 3\" target=\"0, 0.2, 0\" up=\"0, 1, 0\"/></transform>";
    let text = format!(
        "<scene version=\"3.0.0\">
<integrator type=\"path\"><integer name=\"max_depth\" value=\"2\"/></integrator>
<sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/>
<transform name=\"to_world\"><lookat origin=\"0.3, 0.2, 4\" target=\"0.3, 0.2, 0\" up=\"0, 1, 0\"/></transform>
<film type=\"hdrfilm\"><integer name=\"width\" value=\"4\"/><integer name=\"height\" value=\"4\"/>
<rfilter type=\"box\"/></film></sensor>
<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"5\"/></transform>
<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.5\"/></bsdf></shape>
{}</scene>",
        emitter.replace("PLACE", place)
    );
    rendered("a.xml", &text)
}

/// References: Mitsuba 3.9.1, `scalar_rgb`, `path`, 4 x 8192 samples per pixel.
#[test]
fn projectors_and_textured_spots_are_mitsubas() {
    let projector = mitsuba(
        "<emitter type=\"projector\"><texture type=\"bitmap\" name=\"irradiance\">
<string name=\"filename\" value=\"p.png\"/></texture>
<float name=\"fov\" value=\"50\"/><float name=\"scale\" value=\"2\"/>PLACE</emitter>",
    );
    assert_same("projector", &projector, &PROJECTOR, 0.01);
    let spot = mitsuba(
        "<emitter type=\"spot\"><texture type=\"bitmap\" name=\"texture\">
<string name=\"filename\" value=\"p.png\"/></texture>
<float name=\"cutoff_angle\" value=\"35\"/><float name=\"beam_width\" value=\"20\"/>
<rgb name=\"intensity\" value=\"9, 6, 12\"/>PLACE</emitter>",
    );
    assert_same("spot", &spot, &SPOT, 0.01);
}

fn pbrt(light: &str) -> Picture {
    let text = format!(
        "LookAt 0.3 0.2 4  0.3 0.2 0  0 1 0
Camera \"perspective\" \"float fov\" 60
Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4 \"float iso\" 100
PixelFilter \"box\" \"float xradius\" .5 \"float yradius\" .5
Integrator \"path\" \"integer maxdepth\" 1
WorldBegin
Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]
Shape \"trianglemesh\" \"point3 P\" [-5 -5 0 5 -5 0 5 5 0 -5 5 0] \"integer indices\" [0 1 2 0 2 3]
{light}\n"
    );
    rendered("a.pbrt", &text)
}

/// References: pbrt-v4, `path`, 65536 samples per pixel. Its spectra of saturated colours are not
/// RGB: 3 % of the largest channel.
#[test]
fn goniometric_lights_and_projections_are_pbrts() {
    let goniometric = pbrt(
        "Translate 0.5 -0.4 2 Rotate 70 1 0 0 Rotate 25 0 0 1
LightSource \"goniometric\" \"string filename\" \"g.png\" \"rgb I\" [9 6 12]",
    );
    assert_same("goniometric", &goniometric, &GONIOMETRIC, 0.01);
    let projection = pbrt(
        "Translate 0.4 -0.3 3 Rotate 172 1 .1 0 Rotate 20 0 0 1
LightSource \"projection\" \"string filename\" \"p.png\" \"float fov\" 50 \"float power\" 9",
    );
    assert_same("projection", &projection, &PROJECTION, 0.03);
}

/// A light over the floor at the height 2 that projects `image_projection` downwards, its picture one row of
/// values.
fn over_floor(values: &[f32], image_projection: ImageProjection, turn: DMat4) -> Scene {
    let mut scene = lit_floor();
    scene.images.push(Image {
        name: "row".into(),
        width: u32::try_from(values.len()).unwrap(),
        height: 1,
        pixels: values.iter().map(|v| [*v; 3]).collect(),
    });
    scene.textures.push(Texture::Image {
        image: ImageId(0),
        mapping: TextureMapping::default(),
        wrap: [Wrap::Clamp; 2],
        filter: Interpolation::Nearest,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    });
    scene.lights.push(Light::Picture {
        to_world: DMat4::from_translation(DVec3::new(0.0, 0.0, 2.0))
            * DMat4::from_rotation_x(PI)
            * turn,
        intensity: ColourParam::Texture(TextureId(0)),
        image_projection,
    });
    scene
}

/// The window's left and right half, its edge, and what lies behind; next to a point light, for
/// the choice between the two must not leave any of it out.
#[test]
fn windows_throw_intensities_and_irradiances() {
    let image_projection = |profile| ImageProjection::Window {
        half: [0.5, 0.25],
        profile,
    };
    let spot = Profile::Spot {
        cone_angle_deg: 40.0,
        falloff_start_deg: 10.0,
    };
    let tilt = 0.3_f64;
    let profiles = [
        (Profile::Intensity, 1.0),
        (Profile::Irradiance, tilt.cos().powi(-3)),
        (spot, (40.0 - tilt.to_degrees()) / 30.0),
    ];
    for (profile, factor) in profiles {
        // Turned about y, the floor's middle is at x = tan(turn) in the window.
        for (turn, value) in [(tilt, 5.0), (-tilt, 1.0), (0.6, 0.0), (PI, 0.0)] {
            let turned = DMat4::from_rotation_y(-turn);
            let mut scene = over_floor(&[1.0, 5.0], image_projection(profile), turned);
            scene.lights.push(Light::Point {
                position: [0.0, 0.0, 3.0],
                intensity: Rgb::splat(0.9),
            });
            let expected = (value * factor / 4.0 + 0.1) * 0.5 / PI;
            let what = format!("{profile:?} {turn}");
            assert_mean(
                &what,
                &render(&scene, 512, 1, Strategy::Mis),
                expected,
                2e-3,
            );
        }
    }
}

/// One bright pixel of many, next to a point light: its light must not be forgotten.
#[test]
fn a_lone_bright_pixel_is_projected() {
    let mut values = [0.0; 1024];
    values[513] = 7.0;
    let image_projection = ImageProjection::Window {
        half: [5.0, 0.25],
        profile: Profile::Intensity,
    };
    let turn = (5.0 * (2.0 * 513.5 / 1024.0 - 1.0_f64)).atan();
    let mut scene = over_floor(&values, image_projection, DMat4::from_rotation_y(-turn));
    scene.lights.push(Light::Point {
        position: [0.0, 0.0, 3.0],
        intensity: Rgb::splat(0.9),
    });
    let picture = render(&scene, 1024, 1, Strategy::Mis);
    assert_mean("pixel", &picture, (7.0 / 4.0 + 0.1) * 0.5 / PI, 2e-3);
}

#[test]
fn pictures_of_all_directions_reach_all_directions() {
    // s < 1/2 has x < 0 in light space.
    for (turn, value) in [(0.4, 5.0), (-0.4, 1.0), (2.0, 5.0), (-3.0, 1.0)] {
        let scene = over_floor(
            &[1.0, 5.0],
            ImageProjection::Sphere,
            DMat4::from_rotation_y(-turn),
        );
        let picture = render(&scene, 16, 1, Strategy::Mis);
        assert_mean("sphere", &picture, value / 4.0 * 0.5 / PI, 1e-3);
    }
}

const PROJECTOR: [[f64; 3]; 16] = [
    [0.017556, 0.00764601, 0.00269785],
    [0.00329786, 0.0136762, 0.00812474],
    [0.00387854, 0.00252014, 0.00555832],
    [0.000307876, 0.000294501, 9.05625e-06],
    [0.0163009, 0.00620668, 0.0129443],
    [0.0148333, 0.0195618, 0.0117461],
    [0.02355, 0.0206064, 0.0188723],
    [0.00903132, 0.00381229, 0.000923342],
    [0.0326684, 0.0178514, 0.00771112],
    [0.0182247, 0.0328663, 0.0179342],
    [0.0134885, 0.0598657, 0.0241157],
    [0.000432564, 0.000868928, 0.000667328],
    [2.99053e-06, 2.35601e-06, 6.1571e-07],
    [0.000489376, 0.00140753, 0.00124001],
    [0.00329733, 0.00385241, 0.0019026],
    [0.0, 0.0, 0.0],
];
const SPOT: [[f64; 3]; 16] = [
    [0.00260309, 0.00758148, 0.0112024],
    [0.00615726, 0.0076634, 0.0167624],
    [0.00739344, 0.0120342, 0.00808588],
    [0.00310228, 0.00136983, 0.000848743],
    [0.00230662, 0.0178795, 0.0121769],
    [0.0121403, 0.0146251, 0.0127504],
    [0.0301979, 0.0149687, 0.0143811],
    [0.00850648, 0.00241854, 0.00698751],
    [0.0118271, 0.015292, 0.0183526],
    [0.0218251, 0.0227594, 0.035113],
    [0.0482123, 0.0206221, 0.0289132],
    [0.00573669, 0.00101654, 0.00952902],
    [0.00492074, 0.00129345, 0.00523006],
    [0.0110224, 0.0111907, 0.0341531],
    [0.0115779, 0.0147461, 0.0112421],
    [0.000289483, 1.1096e-05, 8.12398e-05],
];
const GONIOMETRIC: [[f64; 3]; 16] = [
    [0.0264, 0.0176, 0.0353],
    [0.01514, 0.01009, 0.02019],
    [0.00643, 0.00428, 0.00859],
    [0.00925, 0.00617, 0.01228],
    [0.09326, 0.06213, 0.1243],
    [0.1119, 0.07446, 0.1497],
    [0.1466, 0.0977, 0.1946],
    [0.05054, 0.0337, 0.06775],
    [0.134, 0.08923, 0.1797],
    [0.3118, 0.2078, 0.415],
    [0.2261, 0.1506, 0.3022],
    [0.02753, 0.01834, 0.03674],
    [0.02403, 0.016, 0.03204],
    [0.0656, 0.0437, 0.0878],
    [0.08167, 0.0544, 0.1087],
    [0.0885, 0.05893, 0.1182],
];
const PROJECTION: [[f64; 3]; 16] = [
    [0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0],
    [0.00071716, 0.049194, 0.0034809],
    [0.019882, 0.033478, 0.061401],
    [0.090576, 0.095093, 0.021133],
    [0.044525, 0.014206, 0.0014973],
    [0.0078812, 0.25854, 0.038025],
    [0.056183, 0.12756, 0.11493],
    [0.17859, 0.10291, 0.075073],
    [0.048584, 0.0082321, 0.071228],
    [0.090515, 0.11548, 0.030701],
    [0.090454, 0.068848, 0.17029],
    [0.091858, 0.23694, 0.079895],
    [0.15515, 0.0, 0.0011692],
];
