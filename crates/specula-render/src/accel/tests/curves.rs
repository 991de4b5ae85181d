//! Curves against the nearest points of sampled ones in double precision; their boxes, parts and joints.

use glam::{DMat4, DVec3};
use specula_scene::scene::ribbon_normal;

use super::super::curve::{CurveSegment, CurveShape, MOST_SPLITS};
use super::*;

fn wide(v: Vec3<f32>) -> DVec3 {
    DVec3::from_array(v.to_array().map(f64::from))
}

/// A segment within about `[-1, 1]^3`, more or less bent.
fn segment(random: &mut Random) -> CurveSegment {
    let (from, to) = (random.vector(), random.vector());
    let bend = random.signed().powi(2);
    let way = to - from;
    let between = |x: f32, random: &mut Random| from + way * x + random.vector() * bend;
    let controls = [from, between(0.3, random), between(0.7, random), to];
    let normal = |random: &mut Random| random.direction().to_array();
    let width = |random: &mut Random| 0.15 * random.signed().abs() + 0.01;
    CurveSegment {
        controls: controls.map(Vec3::to_array),
        width_at_ends: [width(random), width(random)],
        shape: match random.below(3) {
            0 => CurveShape::Flat,
            1 => CurveShape::Cylinder,
            _ => CurveShape::Ribbon([normal(random), normal(random)]),
        },
    }
}

/// Segments of all kinds.
pub(super) fn soup(count: usize, random: &mut Random) -> Vec<CurveSegment> {
    let small = |random: &mut Random| {
        let (own, centre) = (segment(random), random.vector());
        let moved = |p: [f32; 3]| (centre + Vec3::from(p) * 0.3).to_array();
        CurveSegment {
            controls: own.controls.map(moved),
            ..own
        }
    };
    (0..count).map(|_| small(random)).collect()
}

fn accel(curves: &[CurveSegment]) -> Accel {
    let group = Group {
        curves,
        ..Group::default()
    };
    Accel::build(&[group], &[Instance::of(0)]).unwrap()
}

fn point(curve: &CurveSegment, u: f64) -> DVec3 {
    let [a, b, c, d] = curve.controls.map(|p| wide(Vec3::from(p)));
    let v = 1.0 - u;
    a * (v * v * v) + b * (3.0 * v * v * u) + c * (3.0 * v * u * u) + d * (u * u * u)
}

fn width(curve: &CurveSegment, u: f64) -> f64 {
    let [from, to] = curve.width_at_ends.map(f64::from);
    from + u * (to - from)
}

/// Steps along a curve.
const SAMPLES: u32 = 2000;

/// The first minimum of the distance from a ray within the width, with u and v; `Err`: too near an edge, an end or a
/// turning point to tell.
fn sampled(curve: &CurveSegment, ray: &Ray) -> Result<Option<[f64; 3]>, ()> {
    let (o, d) = (wide(ray.origin), wide(ray.direction));
    let (unit, length) = (d.normalize(), d.length());
    let beside = |u: f64| {
        let p = point(curve, u) - o;
        p - unit * unit.dot(p)
    };
    let distance = |u: f64| beside(u).length_squared();
    let step = 1.0 / f64::from(SAMPLES);
    let mut first: Option<[f64; 3]> = None;
    for i in 0..=SAMPLES {
        let u = f64::from(i) * step;
        let [before, here, after] = [u - step, u, u + step].map(distance);
        if here > before || here > after {
            continue;
        }
        let (mut low, mut high) = (u - step, u + step);
        for _ in 0..60 {
            let [a, b] = [1.0 / 3.0, 2.0 / 3.0].map(|x| low + x * (high - low));
            if distance(a) < distance(b) {
                high = b;
            } else {
                low = a;
            }
        }
        let u = 0.5 * (low + high);
        let mut width = width(curve, u);
        if let CurveShape::Ribbon(ends) = curve.shape {
            width *= ribbon_normal(ends, u).dot(unit).abs();
        }
        let (offset, p) = (beside(u), point(curve, u) - o);
        let excess = offset.length() / (0.5 * width) - 1.0;
        let flatness = (before + after - 2.0 * here) / (step * step);
        if excess > 0.01 {
            continue;
        }
        let is_near_end = u.min(1.0 - u).abs() < 1e-3;
        if excess.abs() < 1e-3 || is_near_end || flatness < 0.02 || p.dot(unit).abs() < 1e-3 {
            return Err(());
        }
        if excess > 0.0 || !(0.0..=1.0).contains(&u) || p.dot(unit) < 0.0 {
            continue;
        }
        let tangent = point(curve, u + 1e-5) - point(curve, u - 1e-5);
        let side = -offset.dot(unit.cross(tangent).normalize());
        let t = p.dot(unit) / length;
        if first.is_none_or(|f| t < f[0]) {
            first = Some([t, u, 0.5 + side / width]);
        }
    }
    Ok(first)
}

/// A ray near a point of a curve.
fn aimed(curve: &CurveSegment, random: &mut Random) -> Ray {
    let target = point(curve, 0.5 * f64::from(random.signed()) + 0.5);
    let target = Vec3::from(target.as_vec3().to_array()) + random.vector() * 0.06;
    let from = random.vector() * 2.0;
    ray(from, (target - from) * (0.2 + random.signed().abs()))
}

#[test]
fn hits_are_the_nearest_points_of_sampled_curves() {
    let mut random = Random(41);
    let (mut hits, mut misses, mut unsure) = (0, 0, 0);
    for _ in 0..80 {
        let curve = segment(&mut random);
        let accel = accel(&[curve]);
        for _ in 0..60 {
            let ray = aimed(&curve, &mut random);
            let hit = accel.intersect(&ray);
            assert_eq!(accel.occluded(&ray), hit.is_some());
            match (sampled(&curve, &ray), hit) {
                (Err(()), _) => unsure += 1,
                (Ok(None), None) => misses += 1,
                (Ok(Some(expected)), Some(hit)) => {
                    hits += 1;
                    let found = [hit.t, hit.u, hit.v].map(f64::from);
                    let scale = [1.0 + expected[0], 1.0, 1.0];
                    for i in 0..3 {
                        let error = (found[i] - expected[i]).abs() / scale[i];
                        // Places of minima are known by the root of what distances are.
                        assert!(error < 2e-6, "{curve:?} {ray:?} {hit:?} {expected:?}");
                    }
                }
                (expected, found) => panic!("{curve:?} {ray:?}: {expected:?} {found:?}"),
            }
        }
    }
    assert!(
        hits > 1500 && misses > 1000 && unsure < 600,
        "{hits} {misses} {unsure}"
    );
}

#[test]
fn boxes_of_parts_hold_them_and_their_width() {
    let mut random = Random(42);
    for _ in 0..200 {
        let curve = segment(&mut random);
        let mut covered = 0.0;
        curve.parts(&mut |bounds, part| {
            let parts = 1_u32 << part.ilog2();
            assert!(parts <= 1 << MOST_SPLITS);
            let first = f64::from(part - parts) / f64::from(parts);
            assert_eq!(first, covered, "parts come in order");
            covered = first + 1.0 / f64::from(parts);
            for i in 0..=20 {
                let u = first + (covered - first) * f64::from(i) / 20.0;
                let turned = wide(random.direction()) * (0.5 * width(&curve, u));
                let p = (point(&curve, u) + turned).as_vec3().to_array();
                let ends = bounds.min.iter().zip(&bounds.max);
                let is_within = (p.iter().zip(ends)).all(|(x, (min, max))| min <= x && x <= max);
                assert!(is_within, "{curve:?} {u}");
            }
        });
        assert_eq!(covered, 1.0);
    }
}

/// A spline: segments that continue each other, with rounded control points.
fn spline(random: &mut Random) -> Vec<CurveSegment> {
    let points: Vec<DVec3> = (0..9)
        .map(|i| DVec3::new(0.4 * f64::from(i) - 1.6, 0.0, 0.0) + wide(random.vector()) * 0.3)
        .collect();
    let bezier = |p: &[DVec3]| {
        let (bc, cb) = (p[1].lerp(p[2], 1.0 / 3.0), p[2].lerp(p[1], 1.0 / 3.0));
        let (ba, cd) = (p[1].lerp(p[0], 1.0 / 3.0), p[2].lerp(p[3], 1.0 / 3.0));
        [ba.midpoint(bc), bc, cb, cb.midpoint(cd)]
    };
    let narrow = |p: DVec3| p.as_vec3().to_array();
    let segments = points.windows(4).map(|p| CurveSegment {
        controls: bezier(p).map(narrow),
        width_at_ends: [0.04; 2],
        shape: CurveShape::Flat,
    });
    segments.collect()
}

/// Rays at the ends of parts and of segments, and everywhere else, within the width.
#[test]
fn no_ray_leaks_between_parts_and_segments() {
    let mut random = Random(43);
    let mut count = 0;
    for _ in 0..40 {
        let curves = spline(&mut random);
        let accel = accel(&curves);
        for (i, curve) in curves.iter().enumerate() {
            for k in 0..=8 {
                // Not near the ends of all.
                if (i == 0 && k < 4) || (i == curves.len() - 1 && k > 4) {
                    continue;
                }
                for _ in 0..20 {
                    let u = f64::from(k) / 8.0 + f64::from(random.signed()) * 1e-9;
                    let from = wide(random.direction()) * 6.0;
                    let target = point(curve, u);
                    let tangent = point(curve, u + 1e-4) - point(curve, u - 1e-4);
                    let sine = (target - from).normalize().cross(tangent.normalize());
                    if sine.length() < 0.5 {
                        continue;
                    }
                    let across = sine.normalize();
                    let target = target + across * (0.0199 * f64::from(random.signed()));
                    let [from, to] = [from, target].map(|p| Vec3::from(p.as_vec3().to_array()));
                    let ray = ray(from, to - from);
                    assert!(accel.occluded(&ray), "{curve:?} {u} {ray:?}");
                    count += 1;
                }
            }
        }
    }
    assert!(count > 20_000, "{count}");
}

#[test]
fn degenerate_curves_give_no_nonsense() {
    let straight = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let [a, b, c, d] = straight;
    let bent = [0.5, 1.0, 0.0];
    let cases = [
        // All control points in one, some, and back and forth.
        ([a; 4], [0.1; 2]),
        ([a, a, d, d], [0.1; 2]),
        ([a, a, a, d], [0.1; 2]),
        ([a, d, d, d], [0.1; 2]),
        ([a, d, a, d], [0.1; 2]),
        ([a, b, b, a], [0.1; 2]),
        ([bent, a, a, bent], [0.1; 2]),
        (straight, [0.0; 2]),
        (straight, [0.0, 0.1]),
        (straight, [1e-30; 2]),
        ([a, b, c, [f32::NAN; 3]], [0.1; 2]),
        ([a, b, c, [f32::INFINITY; 3]], [0.1; 2]),
        (straight, [f32::NAN, 0.1]),
        (straight, [f32::INFINITY, 0.1]),
        (straight.map(|p| p.map(|x| x * 1e15)), [1e14; 2]),
        (straight.map(|p| p.map(|x| x * 1e-20)), [1e-21; 2]),
    ];
    let shapes = [
        CurveShape::Flat,
        CurveShape::Cylinder,
        CurveShape::Ribbon([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]),
        CurveShape::Ribbon([[1.0, 0.0, 0.0]; 2]),
    ];
    let mut random = Random(44);
    let mut hits = 0;
    for (controls, width_at_ends) in cases {
        for shape in shapes {
            let accel = accel(&[CurveSegment {
                controls,
                width_at_ends,
                shape,
            }]);
            for i in 0..200 {
                let target = vec3(1.5 + 1.5 * random.signed(), 0.0, 0.0) * (controls[3][0] / 3.0);
                let from = match i {
                    // Along the curve.
                    0 => vec3(-2.0, 0.0, 0.0),
                    1 => vec3(5.0, 0.0, 0.0),
                    _ => vec3(1.5, 0.0, 0.0) + random.direction() * 4.0,
                };
                let from = from * (controls[3][0].abs().max(1.0) / 3.0);
                if let Some(hit) = accel.intersect(&ray(from, target - from)) {
                    hits += 1;
                    assert!(hit.t > 0.0 && hit.t.is_finite(), "{hit:?}");
                    let is_within = |x: f32| (0.0..=1.0).contains(&x);
                    assert!(is_within(hit.u) && is_within(hit.v), "{hit:?}");
                }
            }
        }
    }
    assert!(hits > 2000, "{hits}");
}

/// Curves among all other shapes, in two groups, one of which is instanced: by every way to cast rays.
#[test]
fn all_ways_to_cast_rays_agree_on_curves() {
    let mut random = Random(45);
    let mut mesh = Mesh::soup(60, &mut random);
    let patches = super::patches::soup(10, &mut mesh.positions, &mut random);
    let quadrics = [Quadric {
        shape: QuadricShape::Sphere { radius: 0.2 },
        to_group: DMat4::from_translation(DVec3::new(0.3, -0.4, 0.2)),
    }];
    let curves = soup(300, &mut random);
    let all = Group {
        positions: &mesh.positions,
        triangles: &mesh.triangles,
        quadrics: &quadrics,
        patches: &patches,
        curves: &curves,
    };
    let alone = Group {
        curves: &curves[..40],
        ..Group::default()
    };
    let placed = DMat4::from_rotation_x(0.7) * DMat4::from_scale(DVec3::new(1.0, -0.5, 2.0));
    let instances = [
        Instance::of(1),
        Instance::of(0),
        Instance {
            group: 1,
            to_world: placed,
        },
    ];
    let first_curve = u32::try_from(mesh.triangles.len() + 1 + patches.len()).unwrap();
    for (groups, instances) in [(&[all][..], &instances[..1]), (&[all, alone], &instances)] {
        let instances: Vec<_> = (instances.iter())
            .map(|i| Instance {
                group: i.group.min(u32::try_from(groups.len()).unwrap() - 1),
                ..*i
            })
            .collect();
        let accel = Accel::build(groups, &instances).unwrap();
        let portable = accel.clone().portable();
        let rays: Vec<Ray> = (0..3000)
            .map(|_| {
                let from = random.direction() * 3.0;
                ray(from, random.vector() - from)
            })
            .collect();
        let (mut hits, mut occluded) = (Vec::new(), Vec::new());
        accel.intersect_all(&rays, &mut hits);
        accel.occluded_all(&rays, &mut occluded);
        let mut of_curves = 0;
        for ((ray, hit), occluded) in rays.iter().zip(&hits).zip(&occluded) {
            let alone = accel.intersect(ray);
            assert_eq!(exact(*hit), exact(alone));
            assert_eq!(exact(portable.intersect(ray)), exact(alone));
            assert_eq!(*occluded, alone.is_some());
            assert_eq!(portable.occluded(ray), alone.is_some());
            of_curves += usize::from(hit.is_some_and(|h| h.primitive >= first_curve));
        }
        assert!(of_curves > 200, "{of_curves}");
    }
}

/// More parts than a chunk of the builder holds: hits are those of the segments one by one.
#[test]
fn large_sets_of_curves_are_found_in_chunks() {
    let mut random = Random(46);
    let curves = soup(40_000, &mut random);
    let curves: Vec<_> = (curves.into_iter())
        .map(|c| CurveSegment {
            controls: c.controls.map(|p| p.map(|x| 4.0 * x)),
            ..c
        })
        .collect();
    let large = accel(&curves);
    let stats = large.stats();
    assert_eq!(stats.curves, curves.len());
    assert!(stats.curve_parts > 2 * super::super::chunks::CHUNK);
    for _ in 0..20 {
        let from = random.direction() * 9.0;
        let ray = ray(from, random.vector() - from);
        let alone = (0..)
            .zip(&curves)
            .filter_map(|(i, curve)| {
                let mut first: Option<f32> = None;
                curve.parts(&mut |_, part| {
                    let t = curve.hit(part, &ray).t;
                    if t > 0.0 && first.is_none_or(|f| t < f) {
                        first = Some(t);
                    }
                });
                Some((first?, i))
            })
            .min_by(|a, b| a.partial_cmp(b).unwrap());
        let found = large.intersect(&ray).map(|h| (h.t, h.primitive));
        assert_eq!(found, alone);
    }
    // Incoherent rays are interleaved in large trees.
    let rays: Vec<Ray> = (0..500)
        .map(|_| ray(random.vector() * 4.0, random.direction()))
        .collect();
    let (mut hits, mut occluded) = (Vec::new(), Vec::new());
    large.intersect_all(&rays, &mut hits);
    large.occluded_all(&rays, &mut occluded);
    for ((ray, hit), occluded) in rays.iter().zip(hits).zip(occluded) {
        assert_eq!(exact(hit), exact(large.intersect(ray)));
        assert_eq!(occluded, hit.is_some());
    }
}
