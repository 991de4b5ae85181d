//! The sRGB transfer function.

/// Linear `[0, 1]` to sRGB-encoded `[0, 1]`. Source: IEC 61966-2-1.
pub(super) fn encode(linear: f32) -> f32 {
    let v = linear.clamp(0.0, 1.0);
    if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    }
}

/// `[0, 1]` to the nearest of 256 steps; NaN to 0.
pub(super) fn to_byte(value: f32) -> u8 {
    // The cast saturates and maps NaN to 0, which is what is wanted.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturating quantisation"
    )]
    let byte = (value * 255.0 + 0.5) as u8;
    byte
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert_eq!(to_byte(encode(0.0)), 0);
        assert_eq!(to_byte(encode(1.0)), 255);
        assert_eq!(to_byte(encode(7.0)), 255);
        assert_eq!(to_byte(encode(-1.0)), 0);
        // 18 % grey is 118 in 8-bit sRGB, 50 % is 188.
        assert_eq!(to_byte(encode(0.18)), 118);
        assert_eq!(to_byte(encode(0.5)), 188);
        assert_eq!(to_byte(f32::NAN), 0);
    }
}
