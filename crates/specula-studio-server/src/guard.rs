//! Who may ask: the user's own browser, with a page of this server.
//!
//! Every page of the web can make a browser send requests to this machine, and every program on this machine can send
//! them itself. So the token must be known, the name that the browser looked up must be this machine's (DNS
//! rebinding), and nothing may come from another site's page.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::error::Refusal;
use crate::shared::Shared;

/// What the pages may load and run: their own files, WebAssembly among them, and nothing from elsewhere.
pub(crate) const PAGE_POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; \
    worker-src 'self' blob:; style-src 'self'; img-src 'self' blob: data:; font-src 'self' data:; \
    connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");
const SPECULA: HeaderName = HeaderName::from_static("x-specula");
const OPENER_POLICY: HeaderName = HeaderName::from_static("cross-origin-opener-policy");
const RESOURCE_POLICY: HeaderName = HeaderName::from_static("cross-origin-resource-policy");

/// Refuses what does not come from a page of this server in the user's browser; puts safe headers on all answers.
pub(crate) async fn guard(
    State(shared): State<Arc<Shared>>,
    request: Request,
    next: Next,
) -> Response {
    let mut response = match admit(&shared, &request) {
        Ok(Entry::Page) => next.run(request).await,
        Ok(Entry::Token) => enter(&shared),
        Err(refusal) => refusal.into_response(),
    };
    harden(response.headers_mut());
    response
}

/// By what a request is let in.
enum Entry {
    /// The address with the token in it.
    Token,
    /// The cookie.
    Page,
}

fn admit(shared: &Shared, request: &Request) -> Result<Entry, Refusal> {
    let headers = request.headers();
    if ![Method::GET, Method::HEAD, Method::POST].contains(request.method()) {
        return Err(Refusal::new(
            StatusCode::METHOD_NOT_ALLOWED,
            "only GET, HEAD and POST are answered",
        ));
    }
    let host = only(headers, &header::HOST).filter(|host| shared.host.is(host));
    let named = request
        .uri()
        .authority()
        .is_none_or(|a| shared.host.is(a.as_str()));
    let Some(host) = host.filter(|_| named) else {
        return Err(Refusal::forbidden(
            "this is not the address that the studio listens on",
        ));
    };
    let is_this_site = |origin: &str| {
        origin
            .strip_prefix("http://")
            .is_some_and(|o| o.eq_ignore_ascii_case(host))
    };
    if headers.contains_key(header::ORIGIN)
        && !only(headers, &header::ORIGIN).is_some_and(is_this_site)
    {
        return Err(Refusal::forbidden("a page from elsewhere may not ask"));
    }
    let is_own_site = |site: &str| matches!(site, "same-origin" | "none");
    if headers.contains_key(&FETCH_SITE) && !only(headers, &FETCH_SITE).is_some_and(is_own_site) {
        return Err(Refusal::forbidden("a page from elsewhere may not ask"));
    }
    let uri = request.uri();
    let token = uri.query().and_then(|query| query.strip_prefix("token="));
    if let (Some(token), "/", &Method::GET) = (token, uri.path(), request.method()) {
        return match shared.token.is(token) {
            true => Ok(Entry::Token),
            false => Err(Refusal::forbidden(
                "the token is wrong: `specula studio` prints the address to open",
            )),
        };
    }
    if !has_cookie(shared, headers) {
        return Err(Refusal::forbidden(
            "open the address that `specula studio` printed, with its token",
        ));
    }
    if request.method() == Method::POST && only(headers, &SPECULA) != Some("1") {
        return Err(Refusal::forbidden("a POST needs the header `X-Specula: 1`"));
    }
    Ok(Entry::Page)
}

/// A header that is there once, as text.
fn only<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    let mut values = headers.get_all(name).iter();
    let value = values.next()?;
    value.to_str().ok().filter(|_| values.next().is_none())
}

fn cookie_name(shared: &Shared) -> String {
    format!("specula_studio_{}", shared.host.port)
}

fn has_cookie(shared: &Shared, headers: &HeaderMap) -> bool {
    let name = cookie_name(shared);
    let all = headers
        .get_all(header::COOKIE)
        .iter()
        .filter_map(|value| value.to_str().ok());
    let pairs = all
        .flat_map(|line| line.split(';'))
        .filter_map(|pair| pair.trim().split_once('='));
    pairs
        .filter(|(of, _)| *of == name)
        .any(|(_, value)| shared.token.is(value))
}

/// The token goes from the address into a cookie.
fn enter(shared: &Shared) -> Response {
    let cookie = format!(
        "{}={}; HttpOnly; SameSite=Strict; Path=/",
        cookie_name(shared),
        shared.token.text()
    );
    let headers = [
        (header::SET_COOKIE, cookie),
        (header::LOCATION, "/".to_owned()),
        (header::CACHE_CONTROL, "no-store".to_owned()),
    ];
    (StatusCode::SEE_OTHER, headers).into_response()
}

/// Headers of every answer; where an answer has a policy of its own, that one stays.
fn harden(headers: &mut HeaderMap) {
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, PAGE_POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (OPENER_POLICY, "same-origin"),
        (RESOURCE_POLICY, "same-origin"),
    ] {
        headers
            .entry(name)
            .or_insert(HeaderValue::from_static(value));
    }
}
