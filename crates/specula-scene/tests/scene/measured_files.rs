//! Measured materials: their files, whole and broken, and the scenes that name them.

use specula_bsdf::measured::{Measured, MeasuredTables};
use specula_bsdf::{Bsdf, Transport, Vec3};
use specula_scene::ErrorKind;
use specula_scene::measured::{MeasuredBrdf, tables, to_bytes};
use specula_scene::scene::{MaterialKind, MeasuredId};
use specula_scene::spectrum::{Spectrum, reflectance_to_rgb};

use super::common::{Folder, warnings};
use super::measured;

/// A field as a file has it: name, type, shape, bytes.
type Field = (&'static str, u8, Vec<u64>, Vec<u8>);

fn floats(name: &'static str, shape: &[usize], values: &[f32]) -> Field {
    let shape = shape.iter().map(|&s| s as u64).collect();
    (
        name,
        10,
        shape,
        values.iter().flat_map(|v| v.to_le_bytes()).collect(),
    )
}

/// The fields of tables, by the description of the format.
fn fields(t: &MeasuredTables) -> Vec<Field> {
    let (phi, theta) = (t.phi_i.len(), t.theta_i.len());
    let [[nw, nh], [sw, sh], [vw, vh], [lw, lh]] =
        [&t.ndf, &t.sigma, &t.vndf, &t.luminance].map(|g| g.size);
    vec![
        floats("rgb", &[phi, theta, 3, lh, lw], &t.rgb),
        floats("luminance", &[phi, theta, lh, lw], &t.luminance.values),
        floats("vndf", &[phi, theta, vh, vw], &t.vndf.values),
        floats("sigma", &[sh, sw], &t.sigma.values),
        floats("ndf", &[nh, nw], &t.ndf.values),
        floats("theta_i", &[theta], &t.theta_i),
        floats("phi_i", &[phi], &t.phi_i),
        ("jacobian", 1, vec![1], vec![u8::from(t.jacobian)]),
    ]
}

/// The bytes of a file, written by the description of the format.
fn assembled(fields: &[Field]) -> Vec<u8> {
    let mut bytes = b"tensor_file\0\x01\0".to_vec();
    bytes.extend((fields.len() as u32).to_le_bytes());
    let header = |f: &Field| 13 + f.0.len() + 8 * f.2.len();
    let mut offset = bytes.len() + fields.iter().map(header).sum::<usize>();
    for (name, dtype, shape, data) in fields {
        bytes.extend((name.len() as u16).to_le_bytes());
        bytes.extend(name.as_bytes());
        bytes.extend((shape.len() as u16).to_le_bytes());
        bytes.push(*dtype);
        bytes.extend((offset as u64).to_le_bytes());
        shape.iter().for_each(|s| bytes.extend(s.to_le_bytes()));
        offset += data.len();
    }
    fields.iter().for_each(|f| bytes.extend(&f.3));
    bytes
}

#[test]
fn what_is_written_is_read_again() {
    let expected = measured::tables();
    assert_eq!(tables(&to_bytes(&expected, "any")).unwrap(), expected);
    assert_eq!(tables(&assembled(&fields(&expected))).unwrap(), expected);
}

#[test]
fn spectra_become_colours_as_reflectances_do() {
    let of_rgb = measured::tables();
    let nodes = of_rgb.luminance.values.len();
    let per_view = of_rgb.luminance.size[0] * of_rgb.luminance.size[1];
    let nm = [400.0_f32, 500.0, 550.0, 700.0];
    // Node n of view v at wavelength k.
    let value = |v: usize, n: usize, k: usize| ((7 * v + 3 * n + 5 * k) % 11) as f32 / 10.0;
    let views = nodes / per_view;
    let spectra: Vec<f32> = (0..views)
        .flat_map(|v| (0..4).flat_map(move |k| (0..per_view).map(move |n| value(v, n, k))))
        .collect();
    let mut all = fields(&of_rgb);
    let [w, h] = of_rgb.luminance.size;
    all[0] = floats(
        "spectra",
        &[of_rgb.phi_i.len(), of_rgb.theta_i.len(), 4, h, w],
        &spectra,
    );
    all.push(floats("wavelengths", &[4], &nm));
    let found = tables(&assembled(&all)).unwrap().rgb;
    for v in 0..views {
        for n in 0..per_view {
            let samples = (0..4).map(|k| (f64::from(nm[k]), f64::from(value(v, n, k))));
            let colour = reflectance_to_rgb(&Spectrum::new(samples.collect()).unwrap());
            for (c, expected) in colour.to_array().into_iter().enumerate() {
                let f = found[(3 * v + c) * per_view + n];
                assert!((f - expected).abs() < 1e-5, "{v} {n} {c}: {f} {expected}");
            }
        }
    }
}

#[test]
fn damaged_files_say_what_was_expected() {
    let good = fields(&measured::tables());
    let changed = |change: &dyn Fn(&mut Vec<Field>)| {
        let mut all = good.clone();
        change(&mut all);
        assembled(&all)
    };
    let whole = assembled(&good);
    let mut other_version = whole.clone();
    other_version[12] = 2;
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "ends within its header"),
        (
            b"not a tensor file".to_vec(),
            "does not begin with \"tensor_file\"",
        ),
        (other_version, "is of version 2.0; expected 1.0"),
        (whole[..100].to_vec(), "is shorter than its field \"rgb\""),
        (whole[..40].to_vec(), "ends within its header"),
        (
            whole[..whole.len() - 1].to_vec(),
            "is shorter than its field \"jacobian\"",
        ),
        (changed(&|f| drop(f.remove(2))), "has no field \"vndf\""),
        (
            changed(&|f| drop(f.remove(0))),
            "has neither a field \"rgb\" nor \"spectra\"",
        ),
        (
            changed(&|f| f[4].1 = 5),
            "\"ndf\" has the type uint32; expected float32",
        ),
        (changed(&|f| f[4].1 = 77), "\"ndf\" has the unknown type 77"),
        (
            changed(&|f| f[3].2 = vec![48]),
            "\"sigma\" has 1 dimensions; expected 2",
        ),
        (
            changed(&|f| f[1].2.swap(0, 1)),
            "\"luminance\" has the shape 4 x 1 x 4 x 4; expected 1 x 4 x 4 x 4",
        ),
        (
            changed(&|f| f[0].2 = vec![1, 4, 3, 2, 8]),
            "\"rgb\" has the shape",
        ),
        (
            changed(&|f| f[2].2[0] = u64::MAX),
            "is shorter than its field \"vndf\"",
        ),
        (
            changed(&|f| f[2].2[0] = 1 << 40),
            "is shorter than its field \"vndf\"",
        ),
        (
            changed(&|f| f[6].0 = "theta_i"),
            "has the field \"theta_i\" twice",
        ),
        (
            changed(&|f| f[1].3[0..4].copy_from_slice(&f32::NAN.to_le_bytes())),
            "\"luminance\" has the value NaN at 0",
        ),
        (changed(&|f| f[5].3.reverse()), "\"theta_i\""),
    ];
    for (bytes, expected) in cases {
        let error = MeasuredBrdf::from_bytes("a", &bytes)
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "expected {expected}: {error}");
    }
}

/// A file of the seeds.
fn seed(name: &str) -> Vec<u8> {
    let path = format!(
        "{}/tests/seeds/measured/{name}.bsdf",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read(path).unwrap()
}

#[test]
fn seeds_are_what_the_generator_makes() {
    for (name, expected) in [
        ("isotropic", measured::tables()),
        ("anisotropic", measured::anisotropic_tables()),
    ] {
        let found = tables(&seed(name)).unwrap();
        assert_eq!(
            (found.vndf.size, found.phi_i.len()),
            (expected.vndf.size, expected.phi_i.len())
        );
        let both = [
            (&found.vndf.values, &expected.vndf.values),
            (&found.sigma.values, &expected.sigma.values),
            (&found.rgb, &expected.rgb),
        ];
        for (found, expected) in both {
            for (f, e) in found.iter().zip(expected) {
                assert!((f - e).abs() <= 1e-4 * e.abs() + 1e-6, "{name}: {f} {e}");
            }
        }
    }
}

/// Views and lights: cosine of the polar angle, azimuth in radians.
const VIEWS: [[f64; 2]; 4] = [[0.95, 0.4], [0.7, 2.1], [0.3, -2.5], [0.15, -0.4]];
const LIGHTS: [[f64; 2]; 4] = [[0.9, 1.0], [0.6, -1.2], [0.35, 3.0], [0.7, 5.2]];

/// Mitsuba 3.9.1 (`scalar_rgb`), `eval` in red and `pdf` of its `measured`, for each light of each view.
const ISOTROPIC: [[f64; 2]; 16] = [
    [1.717120e-01, 2.110625e-01],
    [8.942949e-02, 1.217700e-01],
    [8.624661e-02, 1.165819e-01],
    [1.173817e-01, 1.467047e-01],
    [1.048361e-01, 1.508629e-01],
    [4.891831e-01, 7.881855e-01],
    [1.716354e-02, 2.486734e-02],
    [5.775509e-01, 1.330697e+00],
    [3.135836e-01, 4.731251e-01],
    [3.934987e-02, 7.448418e-02],
    [1.609755e-02, 3.085341e-02],
    [5.711060e-02, 1.086399e-01],
    [1.046269e-01, 2.015497e-01],
    [3.310681e-02, 6.621948e-02],
    [1.657351e-01, 2.919425e-01],
    [4.479587e-02, 8.235349e-02],
];

/// The same of the anisotropic file, which is symmetric: views of all quadrants are mirrored.
const ANISOTROPIC: [[f64; 2]; 16] = [
    [1.730846e-01, 2.267128e-01],
    [1.088923e-01, 1.499076e-01],
    [3.574194e-02, 4.987832e-02],
    [1.200056e-01, 1.541817e-01],
    [1.572934e-01, 2.170375e-01],
    [4.467744e-01, 6.709200e-01],
    [2.369572e-02, 3.262613e-02],
    [4.857240e-01, 1.043300e+00],
    [2.223886e-01, 2.363412e-01],
    [1.106041e-01, 1.427023e-01],
    [1.189365e-02, 1.531305e-02],
    [1.321666e-01, 1.714315e-01],
    [3.327628e-02, 4.251348e-02],
    [6.322826e-02, 5.997446e-02],
    [4.179268e-01, 6.201604e-01],
    [7.572339e-02, 6.760364e-02],
];

#[test]
fn values_and_densities_are_those_of_mitsuba() {
    let direction = |[cos, phi]: [f64; 2]| {
        let sin = (1.0 - cos * cos).sqrt();
        Vec3 {
            x: sin * phi.cos(),
            y: sin * phi.sin(),
            z: cos,
        }
    };
    for (name, expected) in [("isotropic", ISOTROPIC), ("anisotropic", ANISOTROPIC)] {
        let tables = tables(&seed(name)).unwrap();
        let lobe = Measured::<f64>::new(&tables).unwrap();
        let pairs = VIEWS
            .iter()
            .flat_map(|v| LIGHTS.iter().map(move |l| (*v, *l)));
        for ((v, l), [value, density]) in pairs.zip(expected) {
            let (wo, wi) = (direction(v), direction(l));
            let (f_cos, pdf) = lobe.eval_pdf(wo, wi, Transport::Radiance);
            let apart = (f_cos.r / value - 1.0)
                .abs()
                .max((pdf / density - 1.0).abs());
            assert!(
                apart < 2e-4,
                "{name} {v:?} {l:?}: {} {value}, {pdf} {density}",
                f_cos.r
            );
        }
    }
}

fn scene(file: &str) -> String {
    format!(
        "WorldBegin Material \"measured\" \"string filename\" \"{file}\"
         Shape \"sphere\" Material \"measured\" \"string filename\" \"{file}\" Shape \"sphere\""
    )
}

#[test]
fn scenes_name_files_once_or_often() {
    let folder = Folder::new();
    folder.write("a.bsdf", measured::file());
    let loaded = folder.load(scene("a.bsdf")).unwrap();
    assert!(warnings(&loaded).is_empty());
    assert_eq!(loaded.scene.measured.len(), 1, "the file is stored once");
    assert_eq!(loaded.files.len(), 2, "the file is listed");
    let kinds = loaded.scene.materials.iter().map(|m| m.kind);
    let id = MaterialKind::Measured(MeasuredId(0));
    assert_eq!(kinds.filter(|k| *k == id).count(), 2);
    let lobe = loaded.scene.measured[0].lobe();
    let wo = Vec3 {
        x: 0.6,
        y: 0.0,
        z: 0.8,
    };
    let mirrored = Vec3 {
        x: -0.6,
        y: 0.0,
        z: 0.8,
    };
    let f_cos = lobe.eval(wo, mirrored, Transport::Radiance);
    assert!((f_cos.r / f_cos.b - 3.0).abs() < 1e-3, "{f_cos:?}");

    let other = Folder::new();
    let mut tables = measured::tables();
    tables.rgb[0] += 0.125;
    other.write("a.bsdf", to_bytes(&tables, "another"));
    let changed = other.load(scene("a.bsdf")).unwrap().scene.fingerprint();
    assert_ne!(changed, loaded.scene.fingerprint());
}

#[test]
fn scenes_without_their_files_are_refused() {
    let folder = Folder::new();
    let error = folder.load(scene("none.bsdf")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Measured);
    assert!(error.message().contains("none.bsdf"), "{error}");
    let nameless = folder
        .load("WorldBegin Material \"measured\" Shape \"sphere\"")
        .unwrap_err();
    assert!(
        nameless.message().contains("needs its \"string filename\""),
        "{nameless}"
    );
    folder.write("a.bsdf", &measured::file()[..300]);
    let cut = folder.load(scene("a.bsdf")).unwrap_err();
    assert_eq!(cut.place().line(), 1);
    assert!(cut.message().contains("a.bsdf: is shorter"), "{cut}");
}
