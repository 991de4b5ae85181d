//! The ball of the guide's glTF scene: a sphere of radius 1 as the buffer that the scene names.

use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::Path;

use crate::Result;

/// Its name, beside the scene.
pub(super) const FILE: &str = "ball.bin";

/// Steps about the axis and along a meridian.
const AROUND: u16 = 80;
const ALONG: u16 = 40;

/// Writes positions (which are the normals too) as `f32`, then triangles as `u16`, little endian.
pub(super) fn write(path: &Path) -> Result<()> {
    fs::write(path, bytes()).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(())
}

fn bytes() -> Vec<u8> {
    let mut bytes = Vec::new();
    for row in 0..=ALONG {
        let (sine, height) = (PI * f64::from(row) / f64::from(ALONG)).sin_cos();
        for column in 0..=AROUND {
            let (y, x) = (TAU * f64::from(column) / f64::from(AROUND)).sin_cos();
            for value in [sine * x, height, -sine * y] {
                #[allow(clippy::cast_possible_truncation, reason = "rounded to f32")]
                bytes.extend((value as f32).to_le_bytes());
            }
        }
    }
    for row in 0..ALONG {
        for column in 0..AROUND {
            let a = row * (AROUND + 1) + column;
            let below = a + AROUND + 1;
            // At the poles one triangle of the two has no area.
            let first = (row + 1 < ALONG).then_some([a, below, below + 1]);
            let second = (row > 0).then_some([a, below + 1, a + 1]);
            for corner in first.into_iter().chain(second).flatten() {
                bytes.extend(corner.to_le_bytes());
            }
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace;

    #[test]
    fn the_committed_ball_is_this_one() {
        let path = workspace::root().join("docs/guide/scenes").join(FILE);
        assert!(
            fs::read(path).unwrap() == bytes(),
            "cargo xtask book --pictures ball"
        );
    }
}
