//! Values of Mitsuba 3.9 (`scalar_rgb`), held against the lobes that follow its formulas.

use specula_bsdf::bsdf::{Plastic, Principled, PrincipledParameters};
use specula_bsdf::math::{Rgb, rgb, vec3};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Alpha, Bsdf, Transport, Vec3};

/// Polar angle and azimuth in degrees of `wo` and of `wi`, and `f |cos|` of each channel.
type Row = ([f64; 2], [f64; 2], [f64; 3]);

fn direction([theta_deg, phi_deg]: [f64; 2]) -> Vec3<f64> {
    let (sin, cos) = theta_deg.to_radians().sin_cos();
    let (y, x) = phi_deg.to_radians().sin_cos();
    vec3(sin * x, sin * y, cos)
}

/// Compares a lobe, made for views from outside or from inside, with rows of values.
fn hold<B: Bsdf<f64>>(name: &str, rows: &[Row], tolerance: f64, lobe: impl Fn(bool) -> B) {
    for &(o, i, expected) in rows {
        let (mut wo, mut wi) = (direction(o), direction(i));
        let outside = wo.z > 0.0;
        if !outside {
            // Lobes are seen from the side of the view.
            (wo.z, wi.z) = (-wo.z, -wi.z);
        }
        let found = lobe(outside).eval(wo, wi, Transport::Radiance);
        for (found, expected) in found.to_array().into_iter().zip(expected) {
            let off = (found - expected).abs() / expected;
            assert!(
                off < tolerance,
                "{name} {o:?} {i:?}: {found}, Mitsuba {expected}"
            );
        }
    }
}

#[test]
fn principled() {
    let metal = PrincipledParameters {
        base_colour: rgb(0.9, 0.6, 0.2),
        roughness: 0.4,
        anisotropic: 0.7,
        metallic: 0.8,
        spec_tint: 0.3,
        clearcoat: 0.6,
        clearcoat_gloss: 0.2,
        ..PrincipledParameters::default()
    };
    hold("metal", &METAL, 1e-4, |_| Principled::new(metal));
    let cloth = PrincipledParameters {
        base_colour: rgb(0.2, 0.3, 0.7),
        roughness: 0.7,
        sheen: 0.9,
        sheen_tint: 0.4,
        flatness: 0.6,
        eta: PrincipledParameters::eta_of_specular(0.7),
        ..PrincipledParameters::default()
    };
    hold("cloth", &CLOTH, 1e-4, |_| Principled::new(cloth));
    let glass = PrincipledParameters {
        base_colour: rgb(0.8, 0.9, 0.4),
        roughness: 0.35,
        spec_trans: 0.7,
        spec_tint: 0.5,
        clearcoat: 0.3,
        clearcoat_gloss: 0.5,
        metallic: 0.1,
        eta: 1.4,
        ..PrincipledParameters::default()
    };
    hold("glass", &GLASS, 1e-4, |outside| {
        Principled::new(PrincipledParameters { outside, ..glass })
    });
}

#[test]
fn principled_thin() {
    let thin = PrincipledParameters {
        base_colour: rgb(0.7, 0.5, 0.3),
        roughness: 0.5,
        anisotropic: 0.4,
        spec_trans: 0.6,
        eta: 1.4,
        spec_tint: 0.3,
        sheen: 0.5,
        sheen_tint: 0.6,
        flatness: 0.3,
        diff_trans: 0.8,
        thin: true,
        ..PrincipledParameters::default()
    };
    hold("thin", &THIN, 1e-4, |outside| {
        Principled::new(PrincipledParameters { outside, ..thin })
    });
}

/// Our tables and Mitsuba's differ by up to 2e-3; its Beckmann masking is a fit, right within
/// 3.5e-3 for each direction.
#[test]
fn plastics() {
    let diffuse = rgb(0.9, 0.3, 0.1);
    let specular = rgb(1.0, 0.8, 0.6);
    let alpha = Alpha::isotropic;
    let separable = Masking::Separable;
    hold("GGX 0.1", &GGX, 2e-3, |_| {
        Plastic::rough(
            Ggx::new(alpha(0.1)),
            separable,
            1.49,
            diffuse,
            specular,
            false,
        )
    });
    hold("GGX 0.4", &GGX_NONLINEAR, 2e-3, |_| {
        Plastic::rough(
            Ggx::new(alpha(0.4)),
            separable,
            1.49,
            diffuse,
            specular,
            true,
        )
    });
    hold("Beckmann 0.3", &BECKMANN, 7e-3, |_| {
        Plastic::rough(
            Beckmann::new(alpha(0.3)),
            separable,
            1.49,
            diffuse,
            specular,
            false,
        )
    });
    hold("smooth", &SMOOTH, 1e-5, |_| {
        Plastic::smooth(1.49, diffuse, Rgb::WHITE, false)
    });
    hold("smooth, nonlinear", &SMOOTH_NONLINEAR, 1e-5, |_| {
        Plastic::smooth(1.49, diffuse, Rgb::WHITE, true)
    });
}

const METAL: [Row; 4] = [
    (
        [10.0, 20.0],
        [25.0, 190.0],
        [1.551_217, 1.042_685, 0.364_642_6],
    ),
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [1.116_872, 0.755_177_7, 0.272_918],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [1.88502, 1.34623, 0.627_843_1],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.030_317_75, 0.020_334_91, 0.007_024_468],
    ),
];

const CLOTH: [Row; 4] = [
    (
        [10.0, 20.0],
        [25.0, 190.0],
        [0.062_673_07, 0.085_653_76, 0.177_576_5],
    ),
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.066_606_46, 0.087_662_02, 0.171_884_2],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.152_166, 0.173_107_2, 0.256_871_8],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.033_242_71, 0.048_473_25, 0.109_395_4],
    ),
];

const GLASS: [Row; 8] = [
    (
        [10.0, 20.0],
        [25.0, 190.0],
        [0.190_112_9, 0.21117, 0.105_884_4],
    ),
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.423_361_6, 0.468_143_4, 0.244_234_3],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.882_128_5, 0.931_162_6, 0.685_991_9],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.035_253_67, 0.039_632_65, 0.017_737_76],
    ),
    ([20.0, 10.0], [165.0, 195.0], [28.97752, 30.73529, 20.4902]),
    (
        [50.0, 250.0],
        [150.0, 60.0],
        [0.855_148_6, 0.907_021_9, 0.604_681_3],
    ),
    (
        [160.0, 10.0],
        [150.0, 200.0],
        [0.042_573_65, 0.042_573_65, 0.042_573_65],
    ),
    ([155.0, 100.0], [30.0, 290.0], [2.280_759, 2.41911, 1.61274]),
];

const THIN: [Row; 8] = [
    (
        [10.0, 20.0],
        [25.0, 190.0],
        [0.060_947_34, 0.046_711_29, 0.032_475_24],
    ),
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.062_422_38, 0.049_501_85, 0.036_581_31],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.189_558, 0.17808, 0.166_602],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.026_438_74, 0.018_916_81, 0.011_394_88],
    ),
    (
        [20.0, 10.0],
        [165.0, 195.0],
        [3.826_571, 2.733_265, 1.639_959],
    ),
    (
        [50.0, 250.0],
        [150.0, 60.0],
        [0.115_265_4, 0.082_332_45, 0.049_399_47],
    ),
    (
        [160.0, 10.0],
        [150.0, 200.0],
        [0.061_134_23, 0.047_172_28, 0.033_210_33],
    ),
    (
        [155.0, 100.0],
        [30.0, 290.0],
        [2.478_074, 1.770_053, 1.062_032],
    ),
];

const GGX: [Row; 4] = [
    (
        [10.0, 20.0],
        [25.0, 190.0],
        [0.278_920_2, 0.112_397_5, 0.051_340_17],
    ),
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.360_050_1, 0.200_273_7, 0.124_084_3],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.724_133_9, 0.540_003_4, 0.393_305],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.123_730_5, 0.041_310_13, 0.013_817_62],
    ),
];

const GGX_NONLINEAR: [Row; 4] = [
    (
        [10.0, 20.0],
        [25.0, 190.0],
        [0.167_258_4, 0.051_819_1, 0.021_783_55],
    ),
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.141_868_9, 0.050_516_71, 0.024_767_01],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.178_616_9, 0.11479, 0.080_237_6],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.077_471_57, 0.020_743_79, 0.006_967_518],
    ),
];

const BECKMANN: [Row; 4] = [
    (
        [10.0, 20.0],
        [25.0, 190.0],
        [0.255_853_1, 0.099_109_48, 0.042_911_56],
    ),
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.227_666_4, 0.098_879_85, 0.049_382_13],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.411_471_6, 0.291_113_7, 0.207_006_9],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.117_091_2, 0.039_031_86, 0.013_011_67],
    ),
];

const SMOOTH: [Row; 3] = [
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.210_045_5, 0.070_015_18, 0.023_338_39],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.093_020_22, 0.031_006_74, 0.010_335_58],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.138_062_1, 0.046_020_7, 0.015_340_23],
    ),
];

const SMOOTH_NONLINEAR: [Row; 3] = [
    (
        [40.0, 0.0],
        [43.0, 170.0],
        [0.183_551_8, 0.034_826_96, 0.010_151_32],
    ),
    (
        [70.0, 300.0],
        [66.0, 125.0],
        [0.081_287_29, 0.015_423_38, 0.004_495_585],
    ),
    (
        [30.0, 60.0],
        [60.0, 80.0],
        [0.120_647_9, 0.022_891_62, 0.006_672_42],
    ),
];
