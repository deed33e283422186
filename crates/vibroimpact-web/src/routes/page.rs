//! The files of the page, which are contained in the program.

use crate::refusal::Refusal;
use axum::body::Bytes;
use axum::extract::Path;
use axum::extract::rejection::PathRejection;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use rust_embed::RustEmbed;

#[derive(RustEmbed)]
#[folder = "page/"]
struct Page;

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
    if path.split(['/', '\\']).any(|part| part == ".." || part.is_empty()) {
        return Err(nothing());
    }
    let file = Page::get(path).ok_or_else(nothing)?;
    let tag =
        file.metadata.sha256_hash().iter().take(8).fold(String::from("\""), |tag, b| format!("{tag}{b:02x}")) + "\"";
    if headers.get(header::IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes()) {
        return Ok(StatusCode::NOT_MODIFIED.into_response());
    }
    let headers = [
        (header::CONTENT_TYPE, kind(path).to_owned()),
        (header::CACHE_CONTROL, "no-cache".into()),
        (header::ETAG, tag),
    ];
    Ok((headers, Bytes::from(file.data.into_owned())).into_response())
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
