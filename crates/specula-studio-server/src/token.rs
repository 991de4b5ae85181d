//! The secret that tells the user's own browser from everybody else on the machine.

use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;

use crate::ServerError;

/// 256 bits from the system, as text.
pub(crate) struct Token(String);

impl Token {
    /// A new one.
    pub(crate) fn new() -> Result<Self, ServerError> {
        let mut bytes = [0_u8; 32];
        getrandom::fill(&mut bytes).map_err(|e| ServerError::Random(e.to_string()))?;
        Ok(Self(URL_SAFE_NO_PAD.encode(bytes)))
    }

    /// The text, to be shown to the user alone.
    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Whether `given` is the token. The time this takes depends on the length of `given` alone.
    pub(crate) fn is(&self, given: &str) -> bool {
        let own = self.0.as_bytes();
        let given = given.as_bytes();
        let differences = given
            .iter()
            .zip(own.iter().cycle())
            .fold(0_u8, |all, (a, b)| std::hint::black_box(all | (a ^ b)));
        std::hint::black_box(differences) == 0 && given.len() == own.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_whole_token_is_the_token() {
        let token = Token::new().unwrap();
        let text = token.text().to_owned();
        assert_eq!(text.len(), 43);
        assert!(token.is(&text));
        assert!(!token.is(""));
        assert!(!token.is(&text[1..]));
        assert!(!token.is(&text.repeat(2)));
        assert!(!token.is(&text.to_lowercase()));
        assert!(!Token::new().unwrap().is(&text));
    }
}
