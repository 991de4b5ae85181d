//! What becomes of pbrt-v3's names.

use crate::feature::Feature;

const fn full(class: &'static str, name: &'static str) -> Feature {
    Feature::full(class, name)
}

const fn near(class: &'static str, name: &'static str, how: &'static str) -> Feature {
    Feature::approximated(class, name, how)
}

const AS_TRIANGLES: &str = "triangles within 7.6e-5 radii of the surface";

/// Names of pbrt-v3 that pbrt-v4 has no more, with those that its `--upgrade` gives them.
pub(crate) const FEATURES: &[Feature] = &[
    full("directive", "WorldEnd"),
    full(
        "directive",
        "names that are defined again, each from there on",
    ),
    near("material", "matte", "`diffuse` of `Kd`, without `sigma`"),
    near(
        "material",
        "plastic",
        "`coateddiffuse` of `Kd`, `Ks` left out; `diffuse` where `Ks` is 0",
    ),
    near(
        "material",
        "uber",
        "`coateddiffuse` of `Kd`, `Ks`, `Kr` and `Kt` left out; `diffuse` where `Ks` is 0; \
          `opacity`, which `--upgrade` refuses, is that of the shapes",
    ),
    near(
        "material",
        "substrate",
        "`coateddiffuse` of `Kd`, `Ks` left out",
    ),
    near("material", "metal", "`conductor`, `Kr` left out"),
    near(
        "material",
        "mirror",
        "`conductor` of smooth silver, `Kr` left out",
    ),
    near("material", "glass", "`dielectric`, `Kr` and `Kt` left out"),
    near(
        "material",
        "translucent",
        "`diffusetransmission` with `Kd` as transmittance, `Ks`, `reflect` and \
          `transmit` left out",
    ),
    near("material", "disney", "`diffuse` of `color`"),
    near("material", "kdsubsurface", "`subsurface` of `Kd`, as there"),
    near("material", "fourier", "diffuse grey of 0.5"),
    near(
        "material",
        "mix",
        "`amount` as a number: the mean of its channels",
    ),
    full("material parameter", "bumpmap: displacement"),
    full("material parameter", "index: eta"),
    full("parameter", "\"color\": \"rgb\""),
    full("parameter", "\"blackbody\" with a scale"),
    full("texture", "color: spectrum"),
    full("texture", "scale of tex1 and tex2"),
    full("texture", "imagemap: trilinear, gamma"),
    near("texture", "uv", "0.5 everywhere"),
    full("light", "mapname: filename"),
    near("light", "scale as a colour", "the mean of its channels"),
    near(
        "light",
        "a picture with L or I as a colour",
        "the mean of its channels",
    ),
    full("light", "infinite: pictures by latitude and longitude"),
    full("area light", "area: diffuse"),
    full("camera", "environment: spherical"),
    full("film", "image: rgb"),
    full("film parameter", "scale: iso"),
    full("film parameter", "maxsampleluminance: maxcomponentvalue"),
    full("filter", "xwidth, ywidth: xradius, yradius"),
    full("filter", "gaussian: alpha as sigma"),
    full("integrator", "directlighting: path of depth 1"),
    near("integrator", "whitted", "paths are traced"),
    near("integrator", "ao", "paths are traced"),
    full("sampler", "lowdiscrepancy, 02sequence: paddedsobol"),
    full("sampler", "maxmindist: pmj02bn"),
    full("sampler", "random: independent"),
    near("medium", "heterogeneous", "`uniformgrid`, as there"),
    full("shape", "trianglemesh: st, uv as numbers"),
    full("shape", "loopsubdiv: nlevels"),
    near("shape parameter", "shadowalpha", "`alpha` alone counts"),
    near("shape", "cone", AS_TRIANGLES),
    near("shape", "paraboloid", AS_TRIANGLES),
    near("shape", "hyperboloid", AS_TRIANGLES),
    full("shape", "heightfield"),
    full("shape", "nurbs"),
];
