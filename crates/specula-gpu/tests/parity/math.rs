//! Scalars, colours, frames, warps, random numbers and alphas.

use specula_bsdf::math::{Stream, rgb, warp};
use specula_bsdf::{Alpha, Frame, Real, Vec3};

use crate::harness::{
    Case, Fault, assert_covered, both_sides, catch, product, prove, r2, round, twins, vector,
};

/// Evenly from `from` to `to`.
fn evenly(from: f64, to: f64, count: u32) -> Vec<[f32; 1]> {
    let at = |i| from + (to - from) * f64::from(i) / f64::from(count);
    (0..=count).map(|i| [round(at(i))]).collect()
}

/// `y` and `x` of vectors in all directions, long and short, along the axes, and zero.
fn angles() -> Vec<[f32; 2]> {
    let around = (0..4096_u16).map(|i| {
        let angle = f64::from(i) / 4096.0 * std::f64::consts::TAU;
        let length = [1.0, 1e-3, 1e-20, 3e5][usize::from(i % 4)];
        [angle.sin() * length, angle.cos() * length].map(round)
    });
    let axes = [[0.0, 0.0], [0.0, 2.0], [3.0, 0.0], [-3.0, 0.0], [0.0, -2.0]];
    let near = (1..200_u16).map(|i| [round(1e-5 * f64::from(i)), 1.0]);
    around.chain(axes).chain(near).collect()
}

/// Halves of 16 bits of seeds, low ones first.
fn seeds() -> Vec<[f32; 4]> {
    let mut stream = Stream::new(1);
    let mut half = |_| f32::floor(stream.next::<f32>() * 65536.0);
    let ends = [[0.0; 4], [65535.0; 4], [65535.0, 65535.0, 0.0, 0.0]];
    let sampled = (0..1000).map(|_| std::array::from_fn(&mut half));
    ends.into_iter().chain(sampled).collect()
}

/// The inverse error function by bisection.
fn erf_inverse(x: f64) -> f64 {
    let (mut low, mut high) = (-6.0, 6.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        let is_below = if middle < 0.0 {
            Real::erfc(-middle) < 1.0 + x
        } else {
            1.0 - x < Real::erfc(middle)
        };
        if is_below {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// `1 - sqrt(pi) x exp(x^2) erfc(x)`.
fn deficit(x: f64) -> f64 {
    1.0 - std::f64::consts::PI.sqrt() * x * (x * x).exp() * Real::erfc(x)
}

/// A twin that is computed in `f64` only.
macro_rules! wide {
    (|$x:ident| $body:expr) => {
        (
            |x: &[f32]| {
                let $x: f64 = x[0].into();
                vec![round($body)]
            },
            |x: &[f64]| {
                let $x = x[0];
                vec![$body]
            },
        )
    };
}

fn scalars() -> Vec<Case> {
    vec![
        Case::new(
            "turns",
            &["turns"],
            "let s = turns_sin_cos(x[0]); y[0] = s.x; y[1] = s.y;",
            evenly(0.0, 1.0, 4096),
            twins!(|x| {
                let (sine, cosine) = x[0].sin_cos_turns();
                vec![sine, cosine]
            }),
            8.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "arc_cosine",
            &["arccosine"],
            "y[0] = arccosine(x[0]);",
            evenly(0.0, 1.0, 4096),
            (|x| vec![x[0].acos()], |x| vec![x[0].acos()]),
            4.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "arc_tangent",
            &["arctangent"],
            "y[0] = arctangent(x[0], x[1]);",
            angles(),
            twins!(|x| vec![x[0].atan2(x[1])]),
            8.0,
        ),
        Case::new(
            "quarter_turns",
            &["quarter"],
            "y[0] = quarter_sine(x[0]);",
            evenly(0.0, 1.0, 4096),
            twins!(|x| vec![(x[0] * T::PI * T::HALF).sin()]),
            8.0,
        ),
        Case::new(
            "complement",
            &["erf"],
            "y[0] = erf_complement(x[0]);",
            evenly(-9.0, 9.0, 4096),
            twins!(|x| vec![x[0].erfc()]),
            // What the exponential of a rounded square loses: its argument times half an ulp.
            400.0,
        ),
        Case::new(
            "scaled_complement",
            &["erf"],
            "y[0] = erf_scaled_complement(x[0]);",
            evenly(0.0, 20.0, 4096),
            wide!(|x| (x * x).exp() * Real::erfc(x)),
            4.0,
        ),
        Case::new(
            "deficit",
            &["erf"],
            "y[0] = erf_deficit(x[0]);",
            evenly(0.0, 20.0, 4096),
            wide!(|x| deficit(x)),
            6.0,
        ),
        Case::new(
            "inverse_error_function",
            &["erf"],
            "y[0] = erf_inverse_uniform(x[0]);",
            (1..4096)
                .map(|i| [r2(i)[0]])
                .chain([[5.9604645e-8], [0.99999994]])
                .collect(),
            wide!(|x| erf_inverse(2.0 * x - 1.0)),
            16.0,
        )
        .at_scale(&[0.01]),
    ]
}

fn streams_and_colours() -> Vec<Case> {
    vec![
        Case::new(
            "stream",
            &["stream"],
            "var stream = stream_new(
                 vec2u(u32(x[0]) | (u32(x[1]) << 16u), u32(x[2]) | (u32(x[3]) << 16u)));
             for (var k = 0u; k < 4u; k++) { y[k] = stream_next(&stream); }
             let bits = stream_next_bits(&stream);
             y[4] = f32(bits.y >> 8u) * 5.9604645e-8;",
            seeds(),
            twins!(|x| {
                let seed = x.iter().rev().fold(0, |seed, half| {
                    (seed << 16)
                        | (0..16).rev().fold(0, |bits, k| {
                            let is_set = (half.to_f64() / f64::from(1 << k)).floor() % 2.0 > 0.5;
                            (bits << 1) | u64::from(is_set)
                        })
                });
                let mut stream = Stream::new(seed);
                (0..5)
                    .map(|_| T::of(stream.next::<f32>().to_f64()))
                    .collect()
            }),
            0.0,
        ),
        Case::new(
            "colours",
            &["rgb"],
            "let colour = vec3f(x[0], x[1], x[2]);
             y[0] = rgb_luminance(colour);
             y[1] = rgb_mean(colour);
             y[2] = rgb_max_channel(colour);
             y[3] = select(0.0, 1.0, rgb_is_black(colour));",
            vec![
                [0.0, 0.0, 0.0],
                [0.9, 0.5, 0.2],
                [0.0, 7.0, 1e-3],
                [1e6, 0.0, 3.0],
            ],
            twins!(|x| {
                let colour = rgb(x[0], x[1], x[2]);
                let black = T::select(colour.is_black(), T::ONE, T::ZERO);
                vec![
                    colour.luminance(),
                    colour.mean(),
                    colour.max_channel(),
                    black,
                ]
            }),
            4.0,
        ),
        Case::new(
            "alphas",
            &["alpha"],
            "let clamped = alpha_clamped(vec2f(x[0], x[1]));
             let stretched = alpha_stretch(clamped, vec3f(x[2], x[3], x[4]));
             y[0] = clamped.x; y[1] = clamped.y;
             y[2] = stretched.x; y[3] = stretched.y; y[4] = stretched.z;",
            product::<2, 3, 5>(
                &[[0.3, 1.2], [-1.0, 20.0], [0.0, 1e-4], [1e-5, 10.0]],
                &both_sides(),
            ),
            twins!(|x| {
                let clamped = Alpha::clamped(x[0], x[1]);
                let w = clamped.stretch(vector(x, 2));
                vec![clamped.x, clamped.y, w.x, w.y, w.z]
            }),
            2.0,
        ),
    ]
}

fn frames_and_warps() -> Vec<Case> {
    let normals = [
        both_sides(),
        vec![[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
    ]
    .concat();
    let tangents = [
        [1.0, 0.0, 0.0],
        [0.2, -3.0, 0.7],
        [0.0, 0.0, 0.0],
        [1e-3, 2e-3, -1e-3],
    ];
    vec![
        Case::new(
            "frames",
            &["frame"],
            "let frame = frame_from_normal(vec3f(x[0], x[1], x[2]));
             let v = vec3f(x[3], x[4], x[5]);
             let local = frame_to_local(frame, v);
             let world = frame_to_world(frame, v);
             for (var k = 0u; k < 3u; k++) {
                 y[k] = frame.s[k]; y[k + 3u] = frame.t[k]; y[k + 6u] = frame.n[k];
                 y[k + 9u] = local[k]; y[k + 12u] = world[k];
             }",
            product::<3, 3, 6>(&normals, &both_sides()),
            twins!(|x| {
                let frame = Frame::from_normal(vector(x, 0));
                let v = vector(x, 3);
                let rows = [frame.s, frame.t, frame.n, frame.to_local(v), frame.to_world(v)];
                rows.map(Vec3::to_array).concat()
            }),
            8.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "frames_of_tangents",
            &["frame"],
            "let frame = frame_from_normal_tangent(vec3f(x[0], x[1], x[2]), vec3f(x[3], x[4], x[5]));
             for (var k = 0u; k < 3u; k++) {
                 y[k] = frame.s[k]; y[k + 3u] = frame.t[k]; y[k + 6u] = frame.n[k];
             }",
            product::<3, 3, 6>(&normals, &tangents),
            twins!(|x| {
                let frame = Frame::from_normal_tangent(vector(x, 0), vector(x, 3));
                [frame.s, frame.t, frame.n].map(Vec3::to_array).concat()
            }),
            8.0,
        )
        .at_scale(&[1.0]),
        Case::new(
            "warps",
            &["warp"],
            "let u = vec2f(x[0], x[1]);
             let cosine = warp_cosine_hemisphere(u);
             let sphere = warp_uniform_sphere(u);
             for (var k = 0u; k < 3u; k++) { y[k] = cosine[k]; y[k + 3u] = sphere[k]; }
             y[6] = warp_cosine_hemisphere_pdf(cosine);
             y[7] = warp_cosine_hemisphere_pdf(-cosine);",
            (0..2000).map(r2).chain([[0.0, 0.0], [0.99999994, 0.99999994]]).collect(),
            twins!(|x| {
                let u = [x[0], x[1]];
                let (cosine, sphere) = (warp::cosine_hemisphere(u), warp::uniform_sphere(u));
                let pdf = warp::cosine_hemisphere_pdf(cosine);
                let below = warp::cosine_hemisphere_pdf(-cosine);
                let mut row = [cosine, sphere].map(Vec3::to_array).concat();
                row.extend([pdf, below]);
                row
            }),
            16.0,
        )
        .at_scale(&[1.0]),
    ]
}

pub(crate) fn cases() -> Vec<Case> {
    [scalars(), streams_and_colours(), frames_and_warps()].concat()
}

pub(crate) const FAULTS: [Fault; 8] = [
    Fault {
        case: "turns",
        module: "math/turns",
        from: "4.058709",
        to: "4.0588",
    },
    Fault {
        case: "arc_cosine",
        module: "math/arccosine",
        from: "0.0889740993",
        to: "0.0899740993",
    },
    Fault {
        case: "arc_tangent",
        module: "math/arctangent",
        from: "0.10618371",
        to: "0.10628371",
    },
    Fault {
        case: "quarter_turns",
        module: "math/quarter",
        from: "0.07968992",
        to: "0.07978992",
    },
    Fault {
        case: "deficit",
        module: "math/erf",
        from: "0.100104405",
        to: "0.100114405",
    },
    Fault {
        case: "stream",
        module: "math/stream",
        from: "0xbf58476du",
        to: "0xbf58476eu",
    },
    Fault {
        case: "frames",
        module: "math/frame",
        from: "sign + n.y * n.y * a",
        to: "1.0 + n.y * n.y * a",
    },
    Fault {
        case: "alphas",
        module: "alpha",
        from: "const ALPHA_MIN: f32 = 1e-4",
        to: "const ALPHA_MIN: f32 = 1e-3",
    },
];

#[test]
fn math_agrees_with_its_twins() {
    prove("math", &cases());
}

#[test]
fn faults_in_math_are_noticed() {
    catch("math", &cases(), &FAULTS);
}

#[test]
fn every_function_of_math_has_a_case() {
    let parts = "part of stream_next_bits";
    let elsewhere = [
        ("stream_add", parts),
        ("stream_multiply", parts),
        ("stream_fold", parts),
    ];
    assert_covered("math", &cases(), &elsewhere);
    assert_covered("", &cases(), &[]);
}
