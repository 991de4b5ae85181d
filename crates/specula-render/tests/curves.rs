//! Curves in pictures: outlines, no shadows of their own, furnaces, and hair on them.

mod common;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::{PreparedScene, RenderOptions, Strategy};
use specula_scene::scene::*;

const KINDS: [CurveKind; 3] = [CurveKind::Flat, CurveKind::Cylinder, CurveKind::Ribbon];

/// A straight curve along x, about the origin, of width 0.2. Normals of ribbons lean by 60 degrees from z.
fn straight(kind: CurveKind, half: f32) -> CurveMesh {
    let at = |x: f32| [half * x, 0.0, 0.0];
    let normal = [0.0, 0.75_f32.sqrt(), 0.5];
    CurveMesh {
        kind,
        segments: vec![[at(-1.0), at(-1.0 / 3.0), at(1.0 / 3.0), at(1.0)]],
        width_at_ends: vec![[0.2; 2]],
        normals: match kind {
            CurveKind::Ribbon => vec![[normal; 2]],
            CurveKind::Flat | CurveKind::Cylinder => Vec::new(),
        },
        is_fibre: true,
    }
}

/// Locks that cross each other: bent segments in two rows that continue each other.
fn lock(kind: CurveKind) -> CurveMesh {
    let mut curves = CurveMesh {
        kind,
        is_fibre: true,
        ..CurveMesh::default()
    };
    for i in 0..24_u8 {
        let i = f32::from(i);
        let centre = [(1.7 * i).sin(), (2.3 * i).cos(), (0.9 * i).sin()].map(|x| 0.6 * x);
        let way = [(0.8 * i).cos(), (0.8 * i).sin(), (1.1 * i).sin()];
        let at = |s: f32, bend: f32| {
            let bend = bend * (5.0 * i).sin();
            [0, 1, 2].map(|k: usize| centre[k] + s * way[k] + bend * way[(k + 1) % 3])
        };
        curves.segments.extend([
            [at(-1.0, 0.0), at(-0.7, 0.4), at(-0.3, 0.2), at(0.0, 0.0)],
            [at(0.0, 0.0), at(0.3, -0.2), at(0.7, 0.1), at(1.0, 0.5)],
        ]);
        curves.width_at_ends.extend([[0.12, 0.09], [0.09, 0.02]]);
        if kind == CurveKind::Ribbon {
            let normals = [[0.0, 0.6, 0.8], [0.8, 0.0, 0.6], [0.0, 0.0, 1.0]];
            curves.normals.push([normals[0], normals[1]]);
            curves.normals.push([normals[1], normals[2]]);
        }
    }
    curves
}

fn place(scene: &mut Scene, curves: CurveMesh, to_world: DMat4, m: MaterialId) {
    scene.curve_meshes.push(curves);
    let geometry = Geometry::Curves(CurveMeshId(scene.curve_meshes.len() - 1));
    scene.shapes.push(shape(geometry, to_world, m));
}

/// White hair and other white fibres vanish in a uniform sky, at every scale, and distorted.
#[test]
fn white_curves_vanish_in_a_uniform_sky() {
    let kinds = [
        (hair([0.0; 3]), "hair"),
        (diffuse(1.0), "diffuse"),
        (mirror_metal(0.0), "mirror"),
    ];
    for kind in KINDS {
        for (material_kind, name) in &kinds {
            for (size, y) in [(1.0, 1.0), (1e-3, 1.0), (1e4, -1.0), (1.0, 0.4)] {
                let mut scene = empty(
                    look([0.3 * size, 0.4 * size, 4.0 * size], [0.0; 3], 40.0),
                    12,
                );
                let m = material(&mut scene, *material_kind);
                let to_world =
                    DMat4::from_rotation_y(0.4) * DMat4::from_scale(size * DVec3::new(1.0, y, 1.0));
                place(&mut scene, lock(kind), to_world, m);
                scene.lights.push(constant_sky(1.0));
                let what = format!("{kind:?} of {name}, {size} large, {y}");
                let by_lobe = render(&scene, 16, 300, Strategy::BsdfOnly);
                for c in &by_lobe.colour {
                    assert!((c.g - 1.0).abs() < 2e-3, "{what}: {c:?}");
                }
                assert_mean(&what, &render(&scene, 32, 300, Strategy::Mis), 1.0, 2e-3);
            }
        }
    }
}

/// A grey curve under a uniform sky is as bright as its albedo everywhere: it does not shadow itself.
#[test]
fn curves_do_not_shadow_themselves() {
    for kind in [CurveKind::Flat, CurveKind::Cylinder] {
        for from in [[0.0, 0.0, 1.0], [0.9, 0.1, 0.4]] {
            let mut scene = empty(look(from, [0.0; 3], 3.0), 12);
            let m = material(&mut scene, diffuse(0.5));
            place(&mut scene, straight(kind, 4.0), DMat4::IDENTITY, m);
            scene.lights.push(constant_sky(1.0));
            let picture = render(&scene, 64, 8, Strategy::BsdfOnly);
            for c in &picture.colour {
                assert_eq!(c.g, 0.5, "{kind:?} from {from:?}");
            }
        }
    }
}

/// A black curve across a picture covers its width; a ribbon, what its normal leaves of it.
#[test]
fn outlines_have_the_width_of_the_curve() {
    for kind in KINDS {
        for (turn_rad, scale) in [(0.0, 1.0), (0.4, 1.0), (0.4, 2.0)] {
            let mut camera = look([0.0, 0.0, 5.0], [0.0; 3], 40.0);
            camera.projection = Projection::Orthographic;
            let mut scene = empty(camera, 32);
            let m = material(&mut scene, diffuse(0.0));
            let to_world =
                DMat4::from_rotation_z(turn_rad) * DMat4::from_scale(DVec3::splat(scale));
            place(&mut scene, straight(kind, 3.0), to_world, m);
            scene.lights.push(constant_sky(1.0));
            let (mean, _) = mean(&render(&scene, 256, 2, Strategy::BsdfOnly));
            let factor = if kind == CurveKind::Ribbon { 0.5 } else { 1.0 };
            // Of a window of 2 by 2.
            let covered = 0.2 * scale * factor / turn_rad.cos() / 2.0;
            assert!(
                (1.0 - mean - covered).abs() < 4e-4,
                "{kind:?}: {mean} {covered}"
            );
        }
    }
}

/// A light from the right brightens the right side of cylinders, and hair on the side of the light reflects it.
#[test]
fn cylinders_and_hair_are_lit_from_where_the_light_is() {
    let strong = MaterialKind::Hair(HairMaterial {
        pigment: HairPigment::Absorption(ColourParam::Value(Rgb::splat(50.0))),
        eta: FloatParam::Value(1.55),
        beta_m: FloatParam::Value(0.3),
        beta_n: FloatParam::Value(0.1),
        alpha_deg: FloatParam::Value(0.0),
    });
    for (kind, material_kind) in [
        (CurveKind::Cylinder, diffuse(0.5)),
        (CurveKind::Cylinder, strong),
        (CurveKind::Flat, strong),
        (CurveKind::Ribbon, strong),
    ] {
        // From both sides of a ribbon.
        for side in [1.0, -1.0] {
            let mut scene = empty(look([0.0, 0.0, side], [0.0; 3], 12.0), 24);
            let m = material(&mut scene, material_kind);
            let mut curves = straight(kind, 4.0);
            if kind == CurveKind::Ribbon {
                curves.normals[0] = [[0.0, 0.0, 1.0]; 2];
            }
            place(&mut scene, curves, DMat4::IDENTITY, m);
            let black = material(&mut scene, diffuse(0.0));
            let lamp = sphere(1.0, [0.0, 8.0, side], black);
            scene.shapes.push(emitting(lamp, 30.0));
            let picture = render(&scene, 64, 2, Strategy::Mis);
            let half = picture.colour.len() / 2;
            let sum = |part: &[Rgb<f32>]| part.iter().map(|c| f64::from(c.g)).sum::<f64>();
            // Rows begin at the top, where y is greatest.
            let (upper, lower) = (sum(&picture.colour[..half]), sum(&picture.colour[half..]));
            assert!(upper > 2.0 * lower, "{kind:?} {side}: {upper} {lower}");
        }
    }
}

/// What passes a flat curve of hair is scattered once, with offsets that are even over its width.
#[test]
fn strategies_agree_on_hair_of_curves() {
    for kind in KINDS {
        assert_strategies_agree_on_hair(|scene, m| place(scene, lock(kind), DMat4::IDENTITY, m));
    }
}

/// Curves as triangles look alike; those that emit always are, and shaders are told to lack the others.
#[test]
fn curves_become_triangles_where_they_must() {
    let mut scene = empty(look([0.0, 0.0, 5.0], [0.0; 3], 40.0), 12);
    let m = material(&mut scene, diffuse(0.6));
    place(&mut scene, lock(CurveKind::Cylinder), DMat4::IDENTITY, m);
    scene.lights.push(constant_sky(1.0));
    let exact = mean(&render(&scene, 128, 6, Strategy::Mis));
    let cut = RenderOptions {
        triangulate_exact_shapes: true,
        ..RenderOptions::default()
    };
    let whole = RenderOptions::default();
    let missing = |scene: &Scene, options: &RenderOptions| {
        let prepared = PreparedScene::new(scene, options).unwrap();
        prepared.flatten().missing.join(", ")
    };
    assert!(missing(&scene, &whole).contains("curves"));
    assert_eq!(missing(&scene, &cut), "");
    let mut triangles = scene.clone();
    triangles.triangulate_exact_shapes(|_| true);
    assert!(matches!(triangles.shapes[0].geometry, Geometry::Mesh(_)));
    let tubes = mean(&render(&triangles, 128, 6, Strategy::Mis));
    assert!((exact.0 - tubes.0).abs() < 0.01, "{exact:?} {tubes:?}");
    let lamp = scene.shapes[0].clone();
    scene.shapes[0] = emitting(lamp, 1.0);
    assert_eq!(missing(&scene, &whole), "");
    let lit = mean(&render(&scene, 64, 6, Strategy::Mis));
    assert!((lit.0 - 1.0).abs() > 0.02, "{lit:?}");
}
