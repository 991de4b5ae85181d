//! Scenes with every kind of light.

use std::fmt::Write as _;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::DMat4;
use specula_bsdf::Rgb;
use specula_bsdf::math::{Stream, rgb};
use specula_scene::scene::{
    Channel, ColourParam, EnvironmentMapping, ImageId, ImageProjection, Interpolation, Light,
    Object, ObjectId, ObjectInstance, Profile, SpotFalloff, Texture, TextureId, TextureMapping,
    Wrap,
};
use specula_scene::{Image, Scene};

/// A scene of the shapes in `world`, a piece of a pbrt file.
fn scene(name: &str, world: &str) -> Scene {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let file = format!("specula-lights-{}-{number}.pbrt", std::process::id());
    let path = std::env::temp_dir().join(file);
    std::fs::write(&path, format!("WorldBegin\n{world}")).unwrap();
    let loaded = specula_scene::load(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
    std::fs::remove_file(path).unwrap();
    loaded.scene
}

/// Shapes of every kind, on either side, alone and with lights at infinity and without extent.
const SHAPES: &str = r#"
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [5 4 3]
  Shape "trianglemesh" "point3 P" [-1 -1 3  1 -1 3  0 1 3.5] "integer indices" [0 1 2]
  Shape "trianglemesh" "point3 P" [-3 -1 0  -3 1 0  -3 1 2  -3 -1 2] "integer indices" [0 1 2 0 2 3]
  Shape "trianglemesh" "point3 P" [3 0 0  4 1 0  4 1 1  3 0 1] "integer indices" [0 1 2 0 2 3]
  Shape "trianglemesh" "point3 P" [0 3 0  1 3 0.2  1.5 4 1  0.5 4 0.8]
    "integer indices" [0 1 2 0 2 3]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [1 2 3] "bool twosided" true
  Translate 0 -3 1
  Rotate 40 1 0 0
  Shape "disk" "float radius" 0.7
  Translate 1.5 0 0
  Shape "trianglemesh" "point3 P" [0 0 0  0.6 0 0  0 0.8 0] "integer indices" [0 1 2]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [9 2 2]
  Translate 2 -2 -2
  Shape "sphere" "float radius" 0.5
  Translate -4 0 0
  Rotate 30 1 1 0
  Scale 1 0.5 0.3
  Shape "sphere" "float radius" 0.8
AttributeEnd
AttributeBegin
  ReverseOrientation
  AreaLightSource "diffuse" "rgb L" [0.2 0.2 0.3]
  Shape "sphere" "float radius" 9
AttributeEnd
"#;

/// Shapes that do not emit.
const FLOOR: &str = r#"Shape "disk" "float radius" 1"#;

/// Small triangles of very different strengths all over the place.
fn heap(count: usize) -> String {
    let mut stream = Stream::new(3);
    let mut next = || stream.next::<f64>();
    let mut text = String::new();
    for _ in 0..count {
        let at = [(); 3].map(|()| 8.0 * next() - 4.0);
        let corner = [(); 3].map(|()| at.map(|x| x + 0.3 * next() - 0.15));
        let strength = 10.0_f64.powf(4.0 * next() - 2.0);
        let _ = writeln!(
            text,
            "AreaLightSource \"diffuse\" \"rgb L\" [{strength} 1 {strength}] \"bool twosided\" {}
            Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [{}]",
            next() < 0.3,
            corner
                .as_flattened()
                .iter()
                .map(f64::to_string)
                .collect::<Vec<_>>()
                .join(" "),
        );
    }
    text
}

/// Triangles whose distances fall so fast that trees peel them off one by one, deeper than a word has
/// bits.
fn falling() -> String {
    let shape = |i: i32| {
        let x = 100.0 * 12.01_f64.powi(-i);
        format!(
            "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"bool twosided\" true
            Shape \"trianglemesh\" \"integer indices\" [0 1 2]
              \"point3 P\" [{x} 0 0 {x} 1 0 {x} 0 1]\n"
        )
    };
    (0..36).map(shape).collect()
}

/// A sky with a small sun in it, black pixels beside others.
fn picture(width: u32, height: u32) -> Image {
    let pixel = |i: u32| match (i % width, i / width) {
        (7, 2) => [90.0, 40.0, 10.0],
        (x, _) if x % 3 == 0 => [0.0; 3],
        (x, y) => [0.1 * x as f32, 0.2, 0.05 * y as f32],
    };
    Image {
        name: "sky".into(),
        width,
        height,
        pixels: (0..width * height).map(pixel).collect(),
    }
}

/// Adds a picture to the first infinite light.
fn with_picture(mut scene: Scene, mapping: EnvironmentMapping) -> Scene {
    let size = match mapping {
        EnvironmentMapping::EqualAreaOctahedral => [13, 13],
        _ => [24, 12],
    };
    let id = ImageId(scene.images.len());
    scene.images.push(picture(size[0], size[1]));
    let infinite = scene.lights.iter_mut().find_map(|light| match light {
        Light::Infinite { image, .. } => Some(image),
        _ => None,
    });
    *infinite.expect("the scene has an infinite light") = Some((id, mapping));
    scene
}

/// Shapes whose emission varies, with and without a table, under a mirror, and cut out.
const VARYING: &str = r#"
Texture "holes" "float" "checkerboard" "float uscale" 4 "float vscale" 4
  "float tex1" 1 "float tex2" 0.25
AttributeBegin
  AreaLightSource "diffuse"
  Shape "trianglemesh" "point3 P" [-1 -1 3  1 -1 3  0 1 3.5] "point2 uv" [0 0 1 0 0 1]
    "integer indices" [0 1 2]
  Scale -1 1 1
  Shape "trianglemesh" "point3 P" [-3 -1 0  -3 1 0  -3 1 2  -3 -1 2] "point2 uv" [0 0 1 0 1 1 0 1]
    "integer indices" [0 1 2 0 2 3]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "bool twosided" true
  Translate 0 -3 1
  Shape "disk" "float radius" 0.7
  Translate 0 5 0
  Scale 1 0.5 0.7
  Shape "sphere" "float radius" 0.6
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [1 2 3]
  Shape "trianglemesh" "point3 P" [2 2 -3  4 2 -3  3 4 -3] "point2 uv" [0 0 1 0 0 1]
    "integer indices" [0 1 2] "texture alpha" "holes"
AttributeEnd
"#;

const SKY: &str = r#"
AttributeBegin
  Rotate 50 1 2 0
  LightSource "infinite" "rgb L" [0.5 0.6 0.7]
AttributeEnd
"#;

/// Lights without extent, the falloffs of spots and a sun.
fn with_deltas(mut scene: Scene) -> Scene {
    let falloffs = [
        SpotFalloff::SmoothCosine,
        SpotFalloff::LinearAngle,
        SpotFalloff::SquaredCosine,
    ];
    for (x, falloff) in (0_u8..).zip(falloffs) {
        scene.lights.push(Light::Spot {
            position: [f64::from(x) - 1.0, 2.0, 2.0],
            axis: [0.0, -0.6, -0.8],
            intensity: rgb(3.0, 2.0, 1.0),
            cone_angle_deg: 50.0,
            falloff_start_deg: 10.0,
            falloff,
        });
    }
    scene.lights.push(Light::Point {
        position: [0.5, 0.5, -1.5],
        intensity: rgb(1.0, 2.0, 1.0),
    });
    for half_angle_deg in [0.0, 0.5, 40.0] {
        scene.lights.push(Light::Distant {
            irradiance: rgb(2.0, 1.5, 1.0),
            to_light: [0.36, 0.48, 0.8],
            half_angle_deg,
        });
    }
    scene
}

/// Gives all shapes that emit a radiance that varies, but the last, and adds mirrored copies of the first.
fn with_varying(mut scene: Scene) -> Scene {
    let texture = TextureId(scene.textures.len());
    scene.textures.push(Texture::Bilinear {
        corners: [[0.0; 3], [0.3, 0.2, 0.1], [0.1, 0.2, 0.3], [9.0, 8.0, 7.0]].map(Rgb::from),
        mapping: TextureMapping::default(),
    });
    let count = scene.shapes.len();
    for emission in scene.shapes[..count - 1]
        .iter_mut()
        .filter_map(|s| s.emission.as_mut())
    {
        emission.radiance = ColourParam::Texture(texture);
    }
    let object = ObjectId(scene.objects.len());
    scene.objects.push(Object {
        name: "copied".into(),
        shapes: scene.shapes[..1].to_vec(),
    });
    scene.instances.push(ObjectInstance {
        object,
        to_world: DMat4::from_translation([0.0, 0.0, -6.0].into())
            * DMat4::from_scale([-1.0, 1.0, 1.0].into()),
        motion: None,
    });
    scene
}

/// Pictures projected from a point: to all sides, and through windows of every profile.
fn with_projected(mut scene: Scene) -> Scene {
    let image = ImageId(scene.images.len());
    scene.images.push(picture(12, 12));
    let texture = TextureId(scene.textures.len());
    scene.textures.push(Texture::Image {
        image,
        mapping: TextureMapping::default(),
        wrap: [Wrap::Clamp; 2],
        filter: Interpolation::Bilinear,
        invert: false,
        scale: 2.0,
        channel: Channel::Rgb,
    });
    let window = |profile| ImageProjection::Window {
        half: [0.7, 0.5],
        profile,
    };
    let spot = Profile::Spot {
        cone_angle_deg: 30.0,
        falloff_start_deg: 10.0,
    };
    let image_projections = [
        ImageProjection::Sphere,
        window(Profile::Intensity),
        window(Profile::Irradiance),
        window(spot),
    ];
    for (x, image_projection) in (0_u8..).zip(image_projections) {
        let turned = DMat4::from_rotation_x(0.9 * f64::from(x));
        scene.lights.push(Light::Picture {
            to_world: DMat4::from_translation([f64::from(x) - 1.5, 0.3, 1.0].into()) * turned,
            intensity: ColourParam::Texture(texture),
            image_projection,
        });
    }
    scene
}

/// Scenes by name.
pub(crate) fn scenes() -> Vec<(&'static str, Scene)> {
    use EnvironmentMapping::{EqualAreaOctahedral, LatitudeLongitude, LatitudeLongitudePoles};
    let lone = r#"AreaLightSource "diffuse" "rgb L" [1 2 3]
        Shape "trianglemesh" "point3 P" [-3 -1 0  -3 1 0  -3 1 2  -3 -1 2]
          "integer indices" [0 1 2 0 2 3]"#;
    let floor_and_sky = format!("{FLOOR}{SKY}");
    let sky = |mapping| with_picture(scene("sky", &floor_and_sky), mapping);
    let all = with_deltas(scene("all", &format!("{SHAPES}{SKY}")));
    let many = scene("many", &format!("{}{SKY}", heap(3000)));
    vec![
        ("a dark scene", scene("dark", FLOOR)),
        ("one rectangle", scene("lone", lone)),
        ("shapes", scene("shapes", SHAPES)),
        ("a constant sky", scene("constant", &floor_and_sky)),
        ("an octahedral sky", sky(EqualAreaOctahedral)),
        ("a sky by latitude", sky(LatitudeLongitude)),
        ("a sky with poles", sky(LatitudeLongitudePoles)),
        ("lights without extent", with_deltas(scene("deltas", FLOOR))),
        ("shapes that vary", with_varying(scene("varying", VARYING))),
        (
            "projected pictures",
            with_projected(scene("projected", FLOOR)),
        ),
        ("everything", with_picture(all, LatitudeLongitude)),
        ("falling distances", scene("falling", &falling())),
        (
            "many triangles and a sky",
            with_picture(many, EqualAreaOctahedral),
        ),
    ]
}
