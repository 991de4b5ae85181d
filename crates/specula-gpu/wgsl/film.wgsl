// Develops a sample: from radiance to picture values, by exposure, largest value and white balance.
//
// Twin of specula-render/src/film/develop.rs.

import tracer::world::{number, vector};

/// Picture values of a radiance. One that is not finite stays as it is: sums.wgsl counts it as invalid.
///
/// Twin: specula-render/src/film/develop.rs, Develop::of.
fn film_developed(radiance: vec3f) -> vec3f {
    // By the bits: compilers may assume that values are finite.
    let exponents = bitcast<vec3u>(radiance) & vec3u(0x7f800000u);
    if any(exponents == vec3u(0x7f800000u)) {
        return radiance;
    }
    var c = radiance * number(FILM);
    if FILM_BOUNDED != 0u {
        let most = number(FILM + 1u);
        let largest = max(c.x, max(c.y, c.z));
        if largest > most {
            c *= most / largest;
        }
    }
    if FILM_BALANCED == 0u {
        return c;
    }
    return vec3f(
        dot(vector(FILM + 2u), c), dot(vector(FILM + 5u), c), dot(vector(FILM + 8u), c));
}
