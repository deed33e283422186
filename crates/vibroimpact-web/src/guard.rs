//! Access control: only the page of the explorer on this machine may send requests.
//!
//! A foreign page can send requests to a server on this machine. It cannot choose the host name in the request
//! (`Host`), hide its origin (`Origin`, `Sec-Fetch-Site`), or send JSON without permission. All of these are checked.
//! Answers carry a policy that lets the page load only parts from this server.

use crate::refusal::Refusal;
use axum::extract::Request;
use axum::http::header::{CONTENT_TYPE, HOST, HeaderName, HeaderValue, ORIGIN};
use axum::http::{HeaderMap, Method, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// The content security policy of the page.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; \
                      connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const HEADERS: [(HeaderName, &str); 5] = [
    (HeaderName::from_static("content-security-policy"), POLICY),
    (HeaderName::from_static("x-content-type-options"), "nosniff"),
    (HeaderName::from_static("referrer-policy"), "no-referrer"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
];

pub(crate) async fn guard(port: u16, request: Request, next: Next) -> Response {
    let mut response = match refused(port, request.method(), request.headers()) {
        Some(refusal) => refusal.into_response(),
        None => next.run(request).await,
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}

/// The host names of this machine with the port.
fn here(port: u16) -> [String; 3] {
    ["127.0.0.1", "localhost", "[::1]"].map(|name| format!("{name}:{port}"))
}

fn refused(port: u16, method: &Method, headers: &HeaderMap) -> Option<Refusal> {
    let text = |name: HeaderName| headers.get(name).map(|value| value.to_str().unwrap_or("not a text").to_owned());
    let foreign = |what: &str, value: &str| {
        let value: String = value.chars().take(80).collect();
        Refusal::new(
            StatusCode::FORBIDDEN,
            format!("{what} `{value}` is not this explorer\nhint: open http://127.0.0.1:{port}/ on this machine"),
        )
    };
    let host = text(HOST).unwrap_or_default();
    if !here(port).contains(&host) {
        return Some(foreign("the host", &host));
    }
    if let Some(origin) = text(ORIGIN)
        && !here(port).iter().any(|here| origin == format!("http://{here}"))
    {
        return Some(foreign("the origin", &origin));
    }
    if let Some(site) = text(HeaderName::from_static("sec-fetch-site"))
        && method != Method::GET
        && site != "same-origin"
    {
        return Some(foreign("the site", &site));
    }
    let json =
        || text(CONTENT_TYPE).is_some_and(|kind| kind.split(';').next().map(str::trim) == Some("application/json"));
    if method == Method::POST && !json() {
        let sentence = "a plan is sent as application/json";
        return Some(Refusal::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, sentence));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(method: &Method, headers: &[(&'static str, &'static str)]) -> Option<u16> {
        let map = headers.iter().map(|(name, value)| (name.parse().unwrap(), value.parse().unwrap())).collect();
        refused(8411, method, &map).map(|refusal| refusal.status.as_u16())
    }

    #[test]
    fn only_this_page_on_this_machine() {
        let json = ("content-type", "application/json; charset=utf-8");
        let host = ("host", "127.0.0.1:8411");
        assert_eq!(status(&Method::GET, &[host]), None);
        assert_eq!(status(&Method::GET, &[("host", "localhost:8411"), ("origin", "http://localhost:8411")]), None);
        assert_eq!(status(&Method::POST, &[host, json, ("sec-fetch-site", "same-origin")]), None);
        for bad in ["evil.example", "127.0.0.1:8412", "127.0.0.1", "localhost.evil.example:8411", ""] {
            assert_eq!(status(&Method::GET, &[("host", bad)]), Some(403), "{bad}");
        }
        assert_eq!(status(&Method::GET, &[]), Some(403));
        for bad in ["http://evil.example", "null", "https://127.0.0.1:8411", "http://127.0.0.1:84110"] {
            assert_eq!(status(&Method::POST, &[host, json, ("origin", bad)]), Some(403), "{bad}");
        }
        assert_eq!(status(&Method::POST, &[host, json, ("sec-fetch-site", "cross-site")]), Some(403));
        assert_eq!(status(&Method::GET, &[host, ("sec-fetch-site", "none")]), None, "typed into the address bar");
        assert_eq!(status(&Method::POST, &[host]), Some(415));
        assert_eq!(status(&Method::POST, &[host, ("content-type", "text/plain")]), Some(415));
    }
}
