//! The choice among lights: samples, densities, contributions.

use specula_bsdf::Vec3;
use specula_bsdf::math::{vec3, warp::uniform_sphere};

use super::area::Area;
use super::build::Emitter;
use super::cone::EmissionCone;
use super::node::Receiver;
use super::select::Selection;
use crate::accel::{Bounds, QuadricShape};
use crate::sampler::Sampler;

/// Random numbers in `[0, 1)`.
fn random_numbers(key: u32) -> impl FnMut() -> f32 {
    let sampler = Sampler::new([7, 11], 0, 5);
    let mut count = 0;
    move || {
        count += 1;
        sampler.hashed([key, count, 0])
    }
}

fn point(next: &mut impl FnMut() -> f32, size: f32) -> Vec3<f32> {
    vec3(next() - 0.5, next() - 0.5, next() - 0.5) * size
}

/// Triangles, disks, spheres and ellipsoids, one- and two-sided, of very different strengths.
fn areas(count: u32) -> Vec<(Area, bool)> {
    let mut next = random_numbers(1);
    (0..count)
        .map(|i| {
            let at = point(&mut next, 10.0);
            let size = 0.01 + next() * next();
            let turn = glam::DMat4::from_rotation_x(f64::from(next() * 6.0))
                * glam::DMat4::from_scale(glam::DVec3::new(1.0, 2.0, 0.5) * f64::from(size));
            let at64 = crate::convert::widen3(at);
            let place = |m| glam::DMat4::from_translation(at64) * m;
            let sphere = QuadricShape::Sphere { radius: 1.0 };
            let disk = QuadricShape::Disk {
                radius: 1.0,
                height: 0.1,
            };
            let area = match i % 5 {
                0 => Area::quadric(disk, &place(turn), false),
                1 => Area::quadric(sphere, &place(turn), false),
                2 => {
                    let m = glam::DMat4::from_scale(glam::DVec3::splat(f64::from(size)));
                    Area::quadric(sphere, &place(m), false)
                }
                _ => Area::triangle([0; 3].map(|_| at + point(&mut next, size))),
            };
            (area, next() < 0.3)
        })
        .collect()
}

fn emitters(areas: &[(Area, bool)]) -> Vec<Emitter> {
    let mut next = random_numbers(2);
    let emitter = |(i, (area, two_sided)): (usize, &(Area, bool))| Emitter {
        light: crate::convert::id(i),
        bounds: area.bounds(),
        cone: area.cone(*two_sided),
        intensity: f64::from(area.projected_area()) * f64::from(10.0_f32.powf(3.0 * next())),
    };
    areas.iter().enumerate().map(emitter).collect()
}

/// Anywhere, next to lights, behind them and within their bounds, with a normal and without.
fn receivers(areas: &[(Area, bool)]) -> Vec<Receiver> {
    let mut next = random_numbers(3);
    (0..300)
        .map(|i| {
            let point = match i % 3 {
                0 => point(&mut next, 30.0),
                1 => point(&mut next, 8.0),
                _ => {
                    let (area, _) = &areas[i % areas.len()];
                    let on = area.sample(vec3(50.0, 0.0, 0.0), [next(), next()]);
                    let on = on.map_or(Vec3::ZERO, |s| s.point);
                    on + uniform_sphere([next(), next()]) * (next() * next() * 0.2)
                }
            };
            let normal = uniform_sphere([next(), next()]);
            Receiver {
                point,
                normal: (i % 4 != 0).then_some(normal),
            }
        })
        .collect()
}

#[test]
fn probabilities_sum_to_one_and_miss_no_light_that_contributes() {
    let areas = areas(150);
    for far in [&[][..], &[(150, 3.0), (151, 1.0)]] {
        let selection = Selection::new(emitters(&areas), far, 152);
        let mut next = random_numbers(4);
        let mut left_out = 0;
        for r in receivers(&areas) {
            let p: Vec<f32> = (0..150)
                .map(|i| selection.probability_near(&r, i))
                .collect();
            let share = f64::from(selection.share_far(&r));
            let sum = p.iter().copied().map(f64::from).sum::<f64>() + share;
            for (i, (area, two_sided)) in areas.iter().enumerate() {
                left_out += usize::from(p[i] == 0.0);
                for _ in 0..16 {
                    let Some(s) = area.sample(r.point, [next(), next()]) else {
                        continue;
                    };
                    let emits = *two_sided || s.normal.dot(s.wi) < 0.0;
                    let lit = emits && r.normal.is_none_or(|n| n.dot(s.wi) > 0.0);
                    assert!(!lit || p[i] > 0.0, "{r:?} {area:?}");
                }
            }
            assert!((sum - 1.0).abs() < 1e-4, "{sum}");
            assert!(far.is_empty() || share >= 0.1);
        }
        // Bounds that leave nothing out would pass the above.
        assert!(left_out > 3000, "{left_out}");
    }
}

#[test]
fn what_is_looked_up_is_what_is_sampled() {
    let areas = areas(20);
    let selection = Selection::new(emitters(&areas), &[(20, 3.0), (21, 1.0)], 22);
    let mut next = random_numbers(5);
    let (mut without_normal, mut sampled) = (0, 0);
    for r in receivers(&areas) {
        for _ in 0..32 {
            let Some((light, p)) = selection.sample(&r, [next(), next()]) else {
                continue;
            };
            sampled += 1;
            if light >= 20 {
                let far = selection.share_far(&r) * selection.probability_far(light);
                assert_eq!(p, far);
                continue;
            }
            assert_eq!(p, selection.probability_near(&r, light));
            let blind = Receiver { normal: None, ..r };
            without_normal += i32::from(p != selection.probability_near(&blind, light));
        }
    }
    // A lookup that forgets the normal is another function: the equality above would show it.
    assert!(
        without_normal > sampled / 4 && sampled > 9000,
        "{without_normal} {sampled}"
    );
}

#[test]
fn lights_are_sampled_as_often_as_their_probabilities_say() {
    let areas = areas(20);
    let selection = Selection::new(emitters(&areas), &[(20, 3.0)], 21);
    for r in receivers(&areas).iter().step_by(37) {
        let mut counts = [0.0_f64; 21];
        let n = 1 << 16;
        for i in 0..n {
            let u = (f64::from(i) + 0.5) / f64::from(n);
            let u = crate::convert::narrow(u);
            if let Some((light, _)) = selection.sample(r, [u, 0.5]) {
                counts[light as usize] += 1.0 / f64::from(n);
            }
        }
        for (light, count) in (0_u32..20).zip(counts) {
            let p = f64::from(selection.probability_near(r, light));
            assert!((count - p).abs() < 1e-3, "{r:?} {light}: {count} {p}");
        }
        assert!((counts[20] - f64::from(selection.share_far(r))).abs() < 1e-3);
    }
}

fn dot(light: u32, x: f32) -> Emitter {
    Emitter {
        light,
        bounds: Bounds {
            min: [x, 0.0, 0.0],
            max: [x, 0.0, 0.0],
        },
        cone: EmissionCone::SPHERE,
        intensity: 1.0,
    }
}

/// Coinciding lights, and lights at distances that halve, which bucketing peels off one by one.
#[test]
fn lights_on_a_heap_keep_their_chance() {
    let heaps: [Vec<Emitter>; 2] = [
        (0..3000).map(|i| dot(i, 1.0)).collect(),
        (0..120_u16)
            .map(|i| dot(u32::from(i), 2.0_f32.powi(-i32::from(i))))
            .collect(),
    ];
    for heap in heaps {
        let count = crate::convert::id(heap.len());
        let selection = Selection::new(heap, &[], count as usize);
        for point in [vec3(0.0, 3.0, 0.0), vec3(1.0, 0.0, 0.0)] {
            let r = Receiver {
                point,
                normal: None,
            };
            let p = (0..count).map(|i| f64::from(selection.probability_near(&r, i)));
            let (sum, least) = p.fold((0.0, 1.0_f64), |(s, m), p| (s + p, m.min(p)));
            assert!((sum - 1.0).abs() < 1e-3 && least > 0.0, "{sum} {least}");
        }
    }
}

#[test]
fn black_and_broken_lights_are_never_sampled() {
    let mut heap: Vec<Emitter> = (0..4).map(|i| dot(i, 1.0)).collect();
    for (e, intensity) in heap.iter_mut().zip([0.0, f64::NAN, f64::INFINITY, 1e-200]) {
        e.intensity = intensity;
    }
    let selection = Selection::new(heap, &[(4, f64::NAN), (5, 0.0)], 6);
    let r = Receiver {
        point: Vec3::ZERO,
        normal: None,
    };
    assert_eq!(selection.sample(&r, [0.9, 0.5]), Some((3, 1.0)));
    assert_eq!(selection.probability_near(&r, 0), 0.0);
    assert_eq!(selection.share_far(&r), 0.0);
    let nothing = Selection::new(Vec::new(), &[], 0);
    assert_eq!(nothing.sample(&r, [0.5, 0.5]), None);
}

#[test]
fn trees_do_not_depend_on_the_number_of_threads() {
    let areas = areas(12_000);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads are to be had");
        pool.install(|| Selection::new(emitters(&areas), &[], areas.len()))
    });
    assert_eq!(format!("{one:?}"), format!("{three:?}"));
}
