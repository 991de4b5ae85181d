//! Parameters written and read back, by the feature `serde`.
#![cfg(feature = "serde")]

use serde::Serialize;
use serde::de::DeserializeOwned;
use specula_bsdf::bsdf::{CoatLayer, GltfParameters, Medium, PrincipledParameters, Tints};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::fresnel::{Conductor, Schlick};
use specula_bsdf::math::{Rgb, rgb, vec3};
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::ndf::Masking;
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Event, Frame, Transport};

fn back<V: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: V) {
    let text = serde_json::to_string(&value).expect("written");
    assert_eq!(
        serde_json::from_str::<V>(&text).expect("read"),
        value,
        "{text}"
    );
}

#[test]
fn what_is_written_is_read_back() {
    back(vec3(0.5_f32, -0.25, 8.0));
    back(rgb(0.5_f64, 0.25, 0.125));
    back(Frame::from_normal(vec3(0.0_f64, 0.0, 1.0)));
    back(Alpha::clamped(0.5_f32, 0.25));
    back(Masking::Separable);
    back(EnergyModel::Turquin(FmsVariant::AverageSeries));
    back((Transport::Importance, Event::Transmission));
    back(GltfParameters::<f32>::default());
    back(PrincipledParameters::<f64>::default());
    back(CoatLayer::<f32>::default());
    back(Medium::<f64>::NONE);
    back(Tints {
        reflection: rgb(0.5_f32, 1.0, 0.25),
        transmission: Rgb::WHITE,
    });
    back(Schlick {
        f0: rgb(0.5_f32, 0.25, 1.0),
    });
    back(Conductor {
        eta: rgb(0.5_f64, 0.25, 1.0),
        k: rgb(4.0, 2.0, 1.5),
    });
    MisPdf::ALL.into_iter().for_each(back);
    MultibounceModel::ALL.into_iter().for_each(back);
    [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ]
    .into_iter()
    .for_each(back);
}

#[test]
fn an_alpha_out_of_range_is_refused() {
    let read = serde_json::from_str::<Alpha<f32>>;
    assert!(read(r#"{"x": 0.5, "y": 0.25}"#).is_ok());
    let error = read(r#"{"x": 0.5, "y": 20.0}"#).unwrap_err().to_string();
    assert!(error.contains("[1e-4, 10]"), "{error}");
}
