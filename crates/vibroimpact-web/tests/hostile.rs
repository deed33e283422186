//! Hostile requests over a real socket: each is refused with a clear message, and the page continues to work.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;
use vibroimpact_web::BoundServer;

/// A server with its own port.
struct Server {
    host: String,
    stop: &'static AtomicBool,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    fn begin() -> Self {
        let bound = BoundServer::new(0).unwrap();
        let host = bound.url().trim_start_matches("http://").trim_end_matches('/').to_owned();
        let stop: &'static AtomicBool = Box::leak(Box::default());
        let thread = Some(std::thread::spawn(move || bound.serve(2, stop).unwrap()));
        Self { host, stop, thread }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream
    }

    /// Sends bytes unchanged, and returns the status and the rest of the answer.
    fn raw(&self, request: &[u8]) -> (u16, String) {
        let mut stream = self.connect();
        // a server that has already refused the request may close the connection
        let _ = stream.write_all(request);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok());
        (status.unwrap_or_else(|| panic!("no status in {answer:?}")), answer)
    }

    fn get(&self, path: &str, headers: &str) -> (u16, String) {
        self.raw(format!("GET {path} HTTP/1.1\r\nhost: {}\r\n{headers}connection: close\r\n\r\n", self.host).as_bytes())
    }

    /// The text of a request with a plan.
    fn posting(&self, path: &str, headers: &str, body: &str) -> String {
        let (host, length) = (&self.host, body.len());
        let head = format!("POST {path} HTTP/1.1\r\nhost: {host}\r\ncontent-type: application/json\r\n");
        format!("{head}content-length: {length}\r\n{headers}\r\n{body}")
    }

    fn post(&self, path: &str, body: &str) -> (u16, String) {
        self.raw(self.posting(path, "connection: close\r\n", body).as_bytes())
    }

    /// Checks that the page and an answer are still served.
    fn works(&self) {
        assert_eq!(self.get("/", "").0, 200);
        let (status, text) = self.post("/api/answer", &plan(r#""settle":{"start":{}}"#));
        assert_eq!(status, 200, "{text}");
        assert!(text.contains(r#""kind":"periodic""#), "{text}");
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

fn plan(task: &str) -> String {
    format!(r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{{task}}}}}"#)
}

fn map(x: &str, y: &str, starts: &str) -> String {
    plan(&format!(
        r#""map":{{"axes":[{{"vary":"inverse_beta","over":"{x}"}},{{"vary":"gap","over":"{y}"}}],"starts":{starts},"impacts":200}}"#
    ))
}

#[test]
fn foreign_names_are_refused() {
    let server = Server::begin();
    for foreign in ["evil.example", "127.0.0.1", "localhost:1", "127.0.0.1:80@evil.example"] {
        let (status, text) =
            server.raw(format!("GET / HTTP/1.1\r\nhost: {foreign}\r\nconnection: close\r\n\r\n").as_bytes());
        assert_eq!(status, 403, "{text}");
        assert!(text.contains("is not this explorer"), "{text}");
    }
    let (status, text) = server.get("/api/about", "origin: http://evil.example\r\n");
    assert_eq!(status, 403, "{text}");
    assert!(!text.to_lowercase().contains("access-control-allow"), "{text}");
    let head = server.get("/", "").1.to_lowercase();
    assert!(head.contains("content-security-policy: default-src 'none'") && head.contains("nosniff"), "{head}");
    server.works();
}

#[test]
fn no_way_out_of_the_page() {
    let server = Server::begin();
    for path in [
        "/assets/../Cargo.toml",
        "/assets/..%2fCargo.toml",
        "/assets/%2e%2e/Cargo.toml",
        "/assets/%2e%2e%5cCargo.toml",
        "/assets//etc/passwd",
        "/assets/%2fetc%2fpasswd",
        "/../../etc/passwd",
        "/assets/index.html%00",
        "/assets/./index.html",
        "/assets/index.html/",
        "/assets/none.js",
        "/assets/",
        "/nothing",
    ] {
        let (status, text) = server.get(path, "");
        assert!((400..=404).contains(&status), "{path}: {text}");
        assert!(!text.contains("[package]") && !text.contains("root:"), "{path}: {text}");
    }
    server.works();
}

#[test]
fn bodies_that_are_none() {
    let server = Server::begin();
    let post = |headers: &str, body: &str| {
        server.raw(format!("POST /api/tile HTTP/1.1\r\nhost: {}\r\n{headers}\r\n{body}", server.host).as_bytes())
    };
    let json = "content-type: application/json\r\nconnection: close\r\n";
    // a gigabyte announced, and a body without end
    assert_eq!(post(&format!("{json}content-length: 1000000000\r\n"), &"x".repeat(200_000)).0, 413);
    let chunk = format!("10000\r\n{}\r\n", " ".repeat(0x10000));
    assert_eq!(post(&format!("{json}transfer-encoding: chunked\r\n"), &chunk.repeat(8)).0, 413);
    assert_eq!(post("content-type: text/plain\r\nconnection: close\r\ncontent-length: 2\r\n", "{}").0, 415);
    for body in ["", "{", "[]", "null", "\u{0}", "{\"version\":1}"] {
        let (status, text) = server.post("/api/tile", body);
        assert_eq!(status, 400, "{text}");
        assert!(text.contains("this is no plan"), "{text}");
    }
    assert_eq!(server.get("/api/tile", "").0, 405);
    assert_eq!(server.raw(b"nonsense\r\n\r\n").0, 400);
    let long = format!("GET /{} HTTP/1.1\r\nhost: {}\r\n\r\n", "a".repeat(300_000), server.host);
    assert!((400..500).contains(&server.raw(long.as_bytes()).0));
    server.works();
}

#[test]
fn plans_that_make_no_sense_or_are_too_much() {
    let server = Server::begin();
    for (status, body, sentence) in [
        (400, map("NaN:1:10", "0:1:10", "1"), "NaN"),
        (400, map("0.5:1:10", "0:1:10", "-1"), "-1"),
        (422, map("0.5:1:1000", "0:1:1000", "1"), "points = 1000000 is more than the explorer computes at once"),
        (422, map("0.5:1:1000000", "0:1:1000000", "10000000"), "`vibro run`"),
        (400, plan(r#""settle":{"start":{"x":5}}"#), "beyond the stop"),
        (400, plan(r#""settle":{"start":{"x":NaN}}"#), "this is no plan"),
        (400, plan(r#""settle":{"start":{"y":1}}"#), "unknown field `y`"),
        (422, plan(r#""attractors":{"starts":900000000,"seed":1}"#), "starts = 900000000"),
    ] {
        for path in
            ["/api/tile", "/api/whole?within=10", "/api/picture?within=10", "/api/answer", "/api/figure", "/api/table"]
        {
            let (got, text) = server.post(path, &body);
            // a plan that is no plane is refused as a tile for this reason, if it is valid
            assert_eq!(got, status, "{path} {body}: {text}");
            assert!(text.contains(sentence), "{path} {body}: {text}");
        }
    }
    for path in ["/api/figure?width=NaN", "/api/figure?width=1e9", "/api/figure?format=exe", "/api/layer?kind=all"] {
        let (status, text) = server.post(path, &plan(r#""settle":{"start":{}}"#));
        assert!((400..=422).contains(&status), "{path}: {text}");
    }
    server.works();
}

/// Many clients that send or read nothing do not block the page.
#[test]
fn a_crowd_that_does_nothing() {
    let server = Server::begin();
    let crowd: Vec<TcpStream> = (0..500)
        .map(|k| {
            let mut stream = server.connect();
            match k % 3 {
                0 => {}
                1 => stream.write_all(b"GET / HTTP/1.1\r\nhost: ").unwrap(),
                // sends a large request and never reads the answer
                _ => {
                    let request = format!("GET /assets/style.css HTTP/1.1\r\nhost: {}\r\n\r\n", server.host);
                    for _ in 0..20 {
                        let _ = stream.write_all(request.as_bytes());
                    }
                }
            }
            stream
        })
        .collect();
    server.works();
    drop(crowd);
    server.works();
}

/// If a page closes its connection, its work stops: the next tile does not wait for it.
#[test]
fn work_of_a_page_that_is_gone_ends() {
    let server = Server::begin();
    // some minutes of work for the two places
    let long = map("0.02:0.3:800", "0:0.4:800", "2").replace("\"impacts\":200", "\"impacts\":20000");
    let gone: Vec<TcpStream> = (0..6)
        .map(|_| {
            let mut stream = server.connect();
            stream.write_all(server.posting("/api/tile", "", &long).as_bytes()).unwrap();
            stream
        })
        .collect();
    std::thread::sleep(Duration::from_millis(300));
    drop(gone);
    let (status, text) = server.post("/api/tile", &map("0.5:2:16", "0:2:16", "1"));
    assert_eq!(status, 200, "{text}");
}

/// Progress events, and the same answer at the end.
#[test]
fn long_work_is_told() {
    let server = Server::begin();
    let headers = "accept: text/event-stream\r\nconnection: close\r\n";
    let request = server.posting("/api/answer", headers, &map("0.5:2:40", "0:2:40", "2"));
    let (status, text) = server.raw(request.as_bytes());
    assert_eq!(status, 200, "{text}");
    assert!(text.contains("text/event-stream") && text.contains("event: progress"), "{text}");
    assert!(text.contains(r#""total":1600"#) && text.contains("event: done"), "{text}");
    let refused = request.replace("\"starts\":2", "\"starts\":0");
    assert_eq!(server.raw(refused.as_bytes()).0, 400);
}
