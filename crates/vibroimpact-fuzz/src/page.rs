//! Requests to the explorer, answered by its router without a socket.

use crate::case::Property;
use crate::command::same;
use crate::plan::{Written, small};
use crate::rules;
use crate::values::number;
use axum::body::{Body, to_bytes};
use axum::http::{Request, header};
use axum::response::Response;
use core::time::Duration;
use proptest::prelude::*;
use std::io;
use tokio::runtime::Runtime;
use tower::ServiceExt;
use vibroimpact_study::Plan;
use vibroimpact_web::{Explorer, app};

const PORT: u16 = 8411;

/// A request.
#[derive(Clone, Debug)]
pub struct PageRequest {
    method: &'static str,
    path: String,
    headers: Vec<(&'static str, String)>,
    plan: Written,
}

/// The family of requests to the explorer.
#[derive(Debug)]
pub struct Page {
    runtime: Runtime,
}

impl Page {
    /// Creates a runtime for the requests.
    pub(crate) fn new() -> io::Result<Self> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        Ok(Self { runtime })
    }

    /// The status, content type and bytes of an answer. A new explorer without a cache is used.
    fn ask(&self, case: &PageRequest) -> Result<Option<(u16, String, Vec<u8>)>, String> {
        let mut request = Request::builder().method(case.method).uri(&case.path);
        for (name, value) in &case.headers {
            request = request.header(*name, value);
        }
        // a malformed request never reaches the explorer
        let Ok(request) = request.body(Body::from(case.plan.json())) else { return Ok(None) };
        self.runtime.block_on(async {
            let asked = async {
                let response: Response = match app(Explorer::new(PORT, 2)).oneshot(request).await {
                    Ok(response) => response,
                    Err(never) => match never {},
                };
                let kind = response.headers().get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok());
                let (status, kind) = (response.status().as_u16(), kind.unwrap_or_default().to_owned());
                let body = to_bytes(response.into_body(), usize::MAX).await.map_err(|why| format!("no body: {why}"))?;
                Ok(Some((status, kind, body.to_vec())))
            };
            let small = case.small();
            let patience = if small { PATIENCE } else { GLANCE };
            let over = || if small { Err(format!("no answer within {} s", PATIENCE.as_secs())) } else { Ok(None) };
            // when the client closes the connection, the request is dropped and its work stops
            tokio::time::timeout(patience, asked).await.unwrap_or_else(|_| over())
        })
    }
}

/// The explorer itself has a limit of two minutes.
const PATIENCE: Duration = Duration::from_secs(180);
/// Time to wait for the answer to a question with a large budget.
const GLANCE: Duration = Duration::from_secs(5);

impl PageRequest {
    /// Whether to wait for the answer. Layers and bifurcation diagrams need many orbits, whatever the plan.
    fn small(&self) -> bool {
        let many = ["/api/layer", "/api/bifurcation"].iter().any(|route| self.path.starts_with(route));
        !many && Plan::from_text(&self.plan.json()).map_or(true, |plan| small(&plan))
    }
}

fn path() -> BoxedStrategy<String> {
    let routes = vec![
        "answer",
        "answer",
        "tile",
        "picture?within=20",
        "table",
        "command",
        "figure",
        "figure",
        "bifurcation",
        "layer",
        "about",
        "nothing",
        "",
    ];
    let keys = prop::sample::select(vec!["kind", "kind", "format", "width", "height", "labels", "x", ""]);
    let words = vec![
        "waveform",
        "phase",
        "multipliers",
        "sections",
        "regions",
        "amplitude",
        "svg",
        "png",
        "exe",
        "1/1",
        "2/1,1/1",
        "1/0",
        "",
        "%00",
        "%ff",
        "500",
        "1e9",
    ];
    let plain = number().prop_map(|text| text.chars().filter(char::is_ascii_graphic).collect::<String>());
    let value = prop_oneof![3 => prop::sample::select(words).prop_map(str::to_owned), 1 => plain];
    let query = prop::collection::vec((keys, value).prop_map(|(key, value)| format!("{key}={value}")), 0..3);
    let pages = prop::sample::select(vec![
        "/",
        "/assets/style.css",
        "/assets/../Cargo.toml",
        "/assets/%2e%2e%2fCargo.toml",
        "/assets/",
        "//",
        "/api",
        "/assets/%00",
        "/é",
    ]);
    prop_oneof![
        14 => (prop::sample::select(routes), query).prop_map(|(route, query)| {
            let query = query.join("&");
            let sign = if query.is_empty() { "" } else if route.contains('?') { "&" } else { "?" };
            format!("/api/{route}{sign}{query}")
        }),
        1 => pages.prop_map(str::to_owned),
    ]
    .boxed()
}

fn headers() -> BoxedStrategy<Vec<(&'static str, String)>> {
    let or = |usual: &'static str, odd: Vec<&'static str>| {
        prop_oneof![30 => Just(usual), 1 => prop::sample::select(odd)].prop_map(str::to_owned)
    };
    let host = or("127.0.0.1:8411", vec!["evil.example", "", "localhost:8411", "[::1]:8411", "127.0.0.1:84110"]);
    let kind = or("application/json", vec!["text/plain", "", "application/json; charset=x", "multipart/form-data"]);
    let more = prop::option::weighted(
        0.15,
        prop::sample::select(vec![
            ("accept", "text/event-stream"),
            ("origin", "http://127.0.0.1:8411"),
            ("origin", "http://evil.example"),
            ("sec-fetch-site", "cross-site"),
            ("if-none-match", "\"\""),
            ("content-length", "99999999999"),
            ("accept", "\u{7f}"),
        ]),
    );
    (host, kind, more)
        .prop_map(|(host, kind, more)| {
            let more = more.map(|(name, value)| (name, value.to_owned()));
            [("host", host), ("content-type", kind)].into_iter().chain(more).collect()
        })
        .boxed()
}

impl Property for Page {
    type Case = PageRequest;

    fn strategy(&self) -> BoxedStrategy<PageRequest> {
        let method = prop_oneof![14 => Just("POST"), 2 => Just("GET"), 1 => prop::sample::select(vec!["HEAD", "PUT", "DELETE", "OPTIONS", "BREW"])];
        (method, path(), headers(), Written::strategy())
            .prop_map(|(method, path, headers, plan)| PageRequest { method, path, headers, plan })
            .boxed()
    }

    fn describe(&self, case: &PageRequest) -> String {
        let headers: Vec<String> = case.headers.iter().map(|(name, value)| format!("{name}: {value}")).collect();
        let body: String = case.plan.json().chars().take(4000).collect();
        format!("{} {}\n{}\n\n{body}", case.method, case.path, headers.join("\n"))
    }

    fn check(&mut self, case: &PageRequest) -> Result<(), String> {
        let Some((status, kind, body)) = self.ask(case)? else { return Ok(()) };
        let events = kind.starts_with("text/event-stream");
        match status {
            200 | 304 => {}
            400 | 403 | 404 | 405 | 408 | 413 | 415 | 422 => {
                // the answer to HEAD has no body
                if case.method != "HEAD" {
                    let refusal = rules::object(&body).map_err(|why| format!("{status}: {why}"))?;
                    return rules::sentence(refusal["error"].as_str().unwrap_or_default());
                }
                return Ok(());
            }
            other => return Err(format!("status {other}: {}", String::from_utf8_lossy(&body))),
        }
        if case.method != "POST" || status != 200 || events {
            return Ok(());
        }
        match kind.as_str() {
            "application/json" => drop(rules::object(&body)?),
            "image/svg+xml" => rules::figure(&String::from_utf8_lossy(&body))?,
            kind if kind.starts_with("text/csv") => rules::table(&body)?,
            _ => {}
        }
        let Some(again) = self.ask(case)? else { return Ok(()) };
        same(&body, &again.2).map_err(|why| format!("the same request has another answer: {why}"))
    }
}
