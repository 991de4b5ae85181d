//! The parameter `aperture`: what the stop lets pass, by pbrt-v4's names or from a picture.

use std::f64::consts::{PI, TAU};

use crate::error::{ErrorKind, Place, SceneError};
use crate::image::{self, Content, Encoding};
use crate::pbrt::context::Context;
use crate::pbrt::param::ParamList;
use crate::scene::StopPicture;

/// Side of pictures of the names, in pixels; as pbrt-v4 has them.
const SIDE: u32 = 256;

/// Reads what the stop lets pass; `None`: all of a circle.
pub(super) fn read(
    context: &Context,
    params: &ParamList,
) -> Result<Option<StopPicture>, SceneError> {
    let Some((name, place)) = params.string("aperture")? else {
        return Ok(None);
    };
    let named = match name {
        "" => return Ok(None),
        "gaussian" => picture(|x, y| ((-x * x - y * y).exp() - (-1.0_f64).exp()).max(0.0)),
        "square" => picture(|x, y| f64::from(u8::from(x.abs() < 0.5 && y.abs() < 0.5))),
        "pentagon" => polygon(&corners(5, |_| 0.8, 0.25 * TAU)),
        "star" => {
            // The inner corners lie where the sides of the outer pentagon's star cross.
            let inner = (TAU / 5.0).cos() / (TAU / 10.0).cos();
            polygon(&corners(10, |i| if i % 2 == 1 { 1.0 } else { inner }, 0.0))
        }
        _ => return from_file(context, params, (name, place)),
    };
    Ok(StopPicture::new(SIDE, &named))
}

/// Reads a picture: the mean of its colours.
fn from_file(
    context: &Context,
    params: &ParamList,
    (name, place): (&str, &Place),
) -> Result<Option<StopPicture>, SceneError> {
    let path = context.resolve(name);
    let read = image::read(&path, Encoding::Srgb, Content::Light, &context.files);
    let picture = match read {
        Ok(picture) => picture,
        Err(message) => {
            let help = "names of apertures are gaussian, square, pentagon and star";
            let error = SceneError::new(ErrorKind::Image, place, message).with_help(help);
            let hint = context.search.hint(&path);
            params.record(error.if_missing(hint, &path))?;
            return Ok(None);
        }
    };
    let values: Vec<f32> = (picture.pixels.iter())
        .map(|[r, g, b]| (r + g + b) / 3.0)
        .collect();
    StopPicture::new(picture.width, &values)
        .map(Some)
        .ok_or_else(|| {
            let message = format!("\"aperture\": the picture {name} lets no light pass");
            SceneError::new(ErrorKind::Image, place, message)
        })
}

/// Values at the middles of pixels over `[-1, 1]^2`, row by row; y rises with the rows, as in pbrt-v4.
fn picture(value: impl Fn(f64, f64) -> f64) -> Vec<f32> {
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
    (0..SIDE)
        .flat_map(|y| (0..SIDE).map(move |x| (middle(x), middle(y))))
        .map(|(x, y)| crate::num::f32_of(value(x, y)))
        .collect()
}

/// Corners of a polygon around the origin.
fn corners(count: usize, radius: impl Fn(usize) -> f64, first_rad: f64) -> Vec<[f64; 2]> {
    let corner = |i: usize| {
        let (sin, cos) = (first_rad + 2.0 * PI * i as f64 / count as f64).sin_cos();
        [radius(i) * cos, radius(i) * sin]
    };
    (0..count).map(corner).collect()
}

/// 1 within a polygon, by whether a ray along +x crosses its sides an odd number of times.
fn polygon(corners: &[[f64; 2]]) -> Vec<f32> {
    picture(|x, y| {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        let crossings = sides.filter(|([ax, ay], [bx, by])| {
            (*ay <= y) != (*by <= y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
        });
        f64::from(u8::from(crossings.count() % 2 == 1))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_the_areas_of_their_shapes() {
        let mean = |v: &[f32]| f64::from(v.iter().sum::<f32>()) / v.len() as f64;
        // Five triangles of radius 0.8; ten of radii 1 and that of the inner corners.
        let pentagon = 0.5 * 5.0 * 0.64 * (TAU / 5.0).sin() / 4.0;
        let inner = (TAU / 5.0).cos() / (TAU / 10.0).cos();
        let star = 0.5 * 10.0 * inner * (TAU / 10.0).sin() / 4.0;
        let found = mean(&polygon(&corners(5, |_| 0.8, 0.25 * TAU)));
        assert!((found - pentagon).abs() < 2e-3, "{found} and {pentagon}");
        let radius = |i: usize| if i % 2 == 1 { 1.0 } else { inner };
        let found = mean(&polygon(&corners(10, radius, 0.0)));
        assert!((found - star).abs() < 2e-3, "{found} and {star}");
    }
}
