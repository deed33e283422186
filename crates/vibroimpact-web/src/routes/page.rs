//! The files of the page, which are contained in the program.

use crate::refusal::Refusal;
use axum::body::Bytes;
use axum::extract::Path;
use axum::extract::rejection::PathRejection;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use core::hash::Hasher;
use include_dir::{Dir, include_dir};
use std::hash::DefaultHasher;

static PAGE: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/page");

pub(super) async fn index(headers: HeaderMap) -> Result<Response, Refusal> {
    file("index.html", &headers)
}

pub(super) async fn asset(path: Result<Path<String>, PathRejection>, headers: HeaderMap) -> Result<Response, Refusal> {
    // a path that is not valid text names no file
    let Path(path) = path.map_err(|_| nothing())?;
    file(&path, &headers)
}

fn nothing() -> Refusal {
    Refusal::new(StatusCode::NOT_FOUND, "the page has no such part")
}

fn file(path: &str, headers: &HeaderMap) -> Result<Response, Refusal> {
    let file = PAGE.files().find(|file| file.path().to_str() == Some(path)).ok_or_else(nothing)?;
    let mut hash = DefaultHasher::new();
    hash.write(file.contents());
    let tag = format!("\"{:016x}\"", hash.finish());
    if headers.get(header::IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes()) {
        return Ok(StatusCode::NOT_MODIFIED.into_response());
    }
    let headers = [
        (header::CONTENT_TYPE, kind(path).to_owned()),
        (header::CACHE_CONTROL, "no-cache".into()),
        (header::ETAG, tag),
    ];
    Ok((headers, Bytes::from_static(file.contents())).into_response())
}

fn kind(path: &str) -> &'static str {
    match path.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("json") => "application/json",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_file_is_not_sent_again() {
        let answer = file("index.html", &HeaderMap::new()).unwrap();
        let tag = answer.headers()[header::ETAG].clone();
        assert_eq!(answer.status(), StatusCode::OK);
        let known = |tag| file("index.html", &HeaderMap::from_iter([(header::IF_NONE_MATCH, tag)])).unwrap().status();
        assert_eq!(known(tag), StatusCode::NOT_MODIFIED);
        assert_eq!(known(header::HeaderValue::from_static("\"other\"")), StatusCode::OK);
    }
}
