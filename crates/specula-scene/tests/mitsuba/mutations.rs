//! Scenes with bytes changed or cut off: an error or a sound scene, never a panic.

use specula_scene::{Limits, LoadOptions, Severity};

use super::common::Folder;

const SCENE: &str = r##"<scene version="0.6.0"><default name="n" value="8"/><path value="."/>
<integrator type="path"><integer name="maxDepth" value="-1"/></integrator>
<sensor type="thinlens"><float name="apertureRadius" value="0.1"/><string name="focalLength" value="35mm"/>
<transform name="toWorld"><rotate x="1" angle="3"/><lookAt origin="1,2,3" target="0,0,0" up="0,1,0"/>
</transform><film type="hdrfilm"><integer name="width" value="$n"/><rfilter type="tent"/></film></sensor>
<bsdf type="mask" id="m"><texture name="opacity" type="checkerboard"/><bsdf type="twosided">
<bsdf type="roughplastic"><srgb name="diffuseReflectance" value="#336699"/></bsdf></bsdf></bsdf>
<alias id="m" as="k"/><shape type="sphere" id="s"><ref id="k"/><emitter type="area">
<spectrum name="radiance" value="400:1, 700:2"/></emitter></shape>
<shape type="shapegroup" id="g"><shape type="cylinder"/></shape><shape type="instance"><ref id="g"/>
<transform name="toWorld"><matrix value="1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1"/></transform></shape>
<emitter type="sunsky"><float name="turbidity" value="3"/></emitter></scene>"##;

/// A small generator, so that the test's cases never change.
struct Lcg(u64);

impl Lcg {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n
    }
}

#[test]
fn changed_bytes_never_panic() {
    let folder = Folder::new();
    let good = SCENE.as_bytes();
    folder
        .load(good)
        .unwrap_or_else(|e| panic!("{}: {e}", e.place()));
    let options = LoadOptions::from(Limits::strict());
    let mut lcg = Lcg(7);
    let palette = b"<>/\"=$ -0159.eab#:,\\\0\xc3";
    let mut sound = 0;
    for _ in 0..500 {
        let mut bytes = good.to_vec();
        for _ in 0..=lcg.below(3) {
            let at = lcg.below(bytes.len());
            match lcg.below(4) {
                0 => bytes[at] = palette[lcg.below(palette.len())],
                1 => drop(bytes.remove(at)),
                2 => bytes.insert(at, palette[lcg.below(palette.len())]),
                _ => {
                    let end = (at + lcg.below(60)).min(bytes.len());
                    let part = bytes[at..end].to_vec();
                    let to = lcg.below(bytes.len());
                    bytes.splice(to..to, part);
                }
            }
        }
        let loaded = folder.load_with(&bytes, &options);
        let report = specula_scene::check(&folder.path().join("scene.xml"), &options);
        let errors = report.count(Severity::Error);
        match loaded {
            Ok(loaded) => {
                loaded.scene.validate().unwrap();
                assert_eq!(errors, 0, "{:?}", report.problems());
                sound += 1;
            }
            Err(e) => {
                assert!(!e.message().is_empty() && e.line() > 0);
                let mut problems = report.problems().iter();
                let is_known = problems.any(|p| p.message() == e.message());
                assert!(is_known, "{e}: {report:?}");
            }
        }
    }
    assert!(sound > 5 && sound < 480, "{sound} of 500 are sound");
}

#[test]
fn every_beginning_of_a_file_is_an_error() {
    let folder = Folder::new();
    for length in (0..SCENE.len() - 1).step_by(7) {
        assert!(
            folder.load(&SCENE.as_bytes()[..length]).is_err(),
            "{length}"
        );
    }
}
