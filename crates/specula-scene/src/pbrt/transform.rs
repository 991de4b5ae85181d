//! Directives that change the transform.

use glam::{DMat4, DVec3};

use super::directive::Reader;
use super::state::look_at;
use super::token::{TokenKind, Tokens, describe};
use crate::error::{ErrorKind, Place, SceneError};
use crate::num::shorten;

impl Reader {
    /// Follows a directive that changes the transform; returns whether `word` is one.
    pub(super) fn transform_directive(
        &mut self,
        word: &str,
        place: &Place,
        tokens: &mut Tokens<'_>,
    ) -> Result<bool, SceneError> {
        match word {
            "Identity" => self.state.transform(place, |_| DMat4::IDENTITY)?,
            "Translate" | "Scale" => {
                let v = DVec3::from(numbers::<3>(tokens, word)?);
                let by = if word == "Scale" {
                    DMat4::from_scale(v)
                } else {
                    DMat4::from_translation(v)
                };
                self.state.transform(place, |m| m * by)?;
            }
            "Rotate" => {
                let [angle, x, y, z] = numbers::<4>(tokens, word)?;
                let axis = DVec3::new(x, y, z).try_normalize().ok_or_else(|| {
                    let message = "expected an axis of rotation that is not zero";
                    SceneError::new(ErrorKind::Transform, place, message)
                })?;
                let by = DMat4::from_axis_angle(axis, angle.to_radians());
                self.state.transform(place, |m| m * by)?;
            }
            "LookAt" => {
                let by = look_at(numbers::<9>(tokens, word)?).ok_or_else(|| {
                    let message =
                        "expected a target apart from the eye and an up vector across the view";
                    SceneError::new(ErrorKind::Transform, place, message)
                })?;
                self.state.transform(place, |m| m * by)?;
            }
            "Transform" | "ConcatTransform" => {
                // The file lists columns.
                let by = DMat4::from_cols_array(&bracketed::<16>(tokens, word)?);
                if by.row(3) != glam::DVec4::W {
                    let message =
                        "expected an affine transform: numbers 4, 8, 12 are 0 and number 16 is 1";
                    return Err(SceneError::new(ErrorKind::Transform, place, message));
                }
                let concatenates = word == "ConcatTransform";
                self.state
                    .transform(place, |m| if concatenates { m * by } else { by })?;
            }
            "CoordinateSystem" => {
                let (name, _) = tokens.expect_text("the name of a coordinate system")?;
                self.coordinate_systems.insert(name, self.state.transforms);
            }
            "CoordSysTransform" => {
                let (name, place) = tokens.expect_text("the name of a coordinate system")?;
                match self.coordinate_systems.get(&name) {
                    Some(transforms) => self.state.transforms = *transforms,
                    None => self.context.warn(
                        &place,
                        format!(
                            "no coordinate system \"{}\": the transform stays",
                            shorten(&name)
                        ),
                    ),
                }
            }
            "TransformTimes" => {
                let times = numbers::<2>(tokens, word)?;
                self.transform_times(place, times)?;
            }
            "ActiveTransform" => self.state.active = active(tokens)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// `TransformTimes`, which holds for the whole file.
    fn transform_times(&mut self, place: &Place, times: [f64; 2]) -> Result<(), SceneError> {
        if self.in_world {
            let message = "`TransformTimes` after `WorldBegin`; expected it before";
            return Err(SceneError::new(ErrorKind::Structure, place, message));
        }
        let [start, end] = times;
        if start >= end {
            let message = format!(
                "`TransformTimes`: expected a start before the end, found {start} and {end}"
            );
            return Err(SceneError::new(ErrorKind::Parameter, place, message));
        }
        self.times = times;
        Ok(())
    }
}

/// Which of the transforms at the start and the end of the exposure are changed.
fn active(tokens: &mut Tokens<'_>) -> Result<[bool; 2], SceneError> {
    let what = "All, StartTime or EndTime";
    let token = tokens.expect(what)?;
    match token.kind {
        TokenKind::Word("All") => Ok([true, true]),
        TokenKind::Word("StartTime") => Ok([true, false]),
        TokenKind::Word("EndTime") => Ok([false, true]),
        ref other => {
            let message = format!("expected {what}, found {}", describe(other));
            Err(SceneError::new(
                ErrorKind::Syntax,
                &tokens.place(&token),
                message,
            ))
        }
    }
}

fn numbers<const N: usize>(tokens: &mut Tokens<'_>, word: &str) -> Result<[f64; N], SceneError> {
    let mut values = [0.0; N];
    for (i, value) in values.iter_mut().enumerate() {
        *value = tokens.expect_number(&format!("number {} of {N} of `{word}`", i + 1))?;
    }
    Ok(values)
}

fn bracketed<const N: usize>(tokens: &mut Tokens<'_>, word: &str) -> Result<[f64; N], SceneError> {
    let bracket = |tokens: &mut Tokens<'_>, kind: TokenKind<'_>| {
        let what = format!("{} of `{word}`", describe(&kind));
        let token = tokens.expect(&what)?;
        if token.kind == kind {
            return Ok(());
        }
        let message = format!("expected {what}, found {}", describe(&token.kind));
        Err(SceneError::new(
            ErrorKind::Syntax,
            &tokens.place(&token),
            message,
        ))
    };
    bracket(tokens, TokenKind::Open)?;
    let values = numbers(tokens, word)?;
    bracket(tokens, TokenKind::Close)?;
    Ok(values)
}
