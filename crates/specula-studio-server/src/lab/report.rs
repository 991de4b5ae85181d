//! The laboratory's report: a page of its own, which can do nothing but show itself.
//!
//! It is sandboxed: its scripts run without the studio's cookie and origin. Of scripts, only the one that has the
//! answer's nonce runs, which is the report's own, the last of the page.

use std::sync::Arc;

use axum::extract::State;
use axum::http::{HeaderName, StatusCode, header};
use axum::response::{IntoResponse, Response};
use specula_lab::report::PAGE;

use crate::error::Refusal;
use crate::shared::Shared;
use crate::token::Token;

/// `GET /lab/report/`.
pub(super) async fn page(State(shared): State<Arc<Shared>>) -> Result<Response, Refusal> {
    let path = shared.lab.folder().join(PAGE);
    let Ok(text) = tokio::fs::read_to_string(path).await else {
        return Err(Refusal::new(
            StatusCode::NOT_FOUND,
            "there are no results yet",
        ));
    };
    let nonce = Token::new().map_err(|e| Refusal::internal(e.to_string()))?;
    let text = with_nonce(&text, nonce.text());
    let policy = format!(
        "default-src 'none'; script-src 'nonce-{}'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; \
         form-action 'none'; frame-ancestors 'self'; sandbox allow-scripts allow-downloads",
        nonce.text()
    );
    // A sandboxed page that claims an opener policy is not shown at all.
    let opener = HeaderName::from_static("cross-origin-opener-policy");
    let headers = [
        (header::CONTENT_TYPE, "text/html; charset=utf-8".to_owned()),
        (header::CACHE_CONTROL, "no-store".to_owned()),
        (header::CONTENT_SECURITY_POLICY, policy),
        (opener, "unsafe-none".to_owned()),
    ];
    Ok((headers, text).into_response())
}

/// Lets the report's script run: texts of results are escaped, so the last element is the template's.
fn with_nonce(text: &str, nonce: &str) -> String {
    match text.rsplit_once("<script>") {
        Some((before, after)) => format!("{before}<script nonce=\"{nonce}\">{after}"),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_script_gets_the_nonce() {
        let page = with_nonce("<p><script>a</script><script>b</script>", "N");
        assert_eq!(page, "<p><script>a</script><script nonce=\"N\">b</script>");
        assert_eq!(with_nonce("<p>", "N"), "<p>");
    }
}
