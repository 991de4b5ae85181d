//! Numbers in base 94, as `specula-bsdf` reads them.

/// A text of numbers.
#[derive(Clone, Default)]
pub(super) struct Digits {
    pub(super) text: String,
}

impl Digits {
    /// Appends how far a value lies between two limits, most significant digit first.
    pub(super) fn push(&mut self, value: f64, digits: u32, [low, high]: [f64; 2]) {
        let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the digits"
        )]
        let number = (share * f64::from(94_u32.pow(digits) - 1)).round() as u32;
        for k in (0..digits).rev() {
            let digit = number / 94_u32.pow(k) % 94;
            self.text.extend(char::from_u32(33 + digit));
        }
    }

    /// Appends a line.
    pub(super) fn line(&mut self, values: &[f64], digits: u32, limits: [f64; 2]) {
        for &value in values {
            self.push(value, digits, limits);
        }
        self.text.push('\n');
    }
}
