//! Tests that studies in buckets have the same objects as in a folder, whatever interrupts the run.
//!
//! The tests start a server by the shell command in `VIBROIMPACT_S3_SERVER`. It must use the port in `$PORT` and ignore
//! signatures, as `moto` does. Without this variable the server from the environment of `cargo xtask s3` is used. If
//! there is none, the tests are skipped.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod common;

use common::{all_plans, control, map, whole};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};
use vibroimpact_store::{Bucket, Part, Shelf, Store, shelf};
use vibroimpact_study::Plan;

/// A server on this machine, with one bucket called `studies`.
struct Server {
    process: Child,
    port: u16,
}

/// Time limit for the start of a server.
const START: Duration = Duration::from_secs(60);

impl Server {
    /// `None` if this machine has no server.
    fn start() -> Option<Self> {
        let command = std::env::var("VIBROIMPACT_S3_SERVER").ok().or_else(|| {
            let python = Path::new(env!("CARGO_TARGET_TMPDIR")).parent()?.join("s3-venv/bin/python");
            python.exists().then(|| format!("'{}' -m moto.server -H 127.0.0.1 -p $PORT", python.display()))
        });
        let Some(command) = command else {
            println!("skipped: there is no server that speaks S3; `cargo xtask s3` installs one");
            return None;
        };
        let log = tempfile::NamedTempFile::new().unwrap();
        // another program may take the port before the server does, so try several times
        for _ in 0..3 {
            let port = free_port();
            let output = || Stdio::from(File::create(log.path()).unwrap());
            let mut shell = Command::new("sh");
            // 50 objects for each page of a listing, so that all listings have several pages
            shell.env("PORT", port.to_string()).env("MOTO_S3_DEFAULT_MAX_KEYS", "50");
            shell.args(["-c", &format!("exec {command}")]).stdin(Stdio::null()).stdout(output()).stderr(output());
            let mut server = Self { process: shell.spawn().unwrap(), port };
            let begin = Instant::now();
            while begin.elapsed() < START && server.process.try_wait().unwrap().is_none() {
                if TcpStream::connect(("127.0.0.1", port)).is_ok() {
                    server.ask("PUT", "/studies");
                    return Some(server);
                }
                std::thread::sleep(Duration::from_millis(50));
            }
        }
        panic!("the server does not start: {command}\n{}", fs::read_to_string(log.path()).unwrap());
    }

    /// A request without a valid signature, which the server does not check.
    fn ask(&self, method: &str, path: &str) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let key = "AWS4-HMAC-SHA256 Credential=key/20260101/us-east-1/s3/aws4_request, SignedHeaders=host, Signature=0";
        let host = format!("Host: 127.0.0.1:{}\r\nAuthorization: {key}", self.port);
        write!(stream, "{method} {path} HTTP/1.1\r\n{host}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n").unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let status = answer.split(' ').nth(1).unwrap();
        assert!(status.starts_with('2'), "{method} {path}: {answer}");
    }

    fn variables(&self) -> Vec<(String, String)> {
        variables(&format!("http://127.0.0.1:{}", self.port))
    }

    fn shelf(&self, place: &str) -> Arc<dyn Shelf> {
        Arc::new(Bucket::with(place, self.variables()).unwrap())
    }

    /// The store of a plan as opened by another process.
    fn open(&self, place: &str, plan: &Plan) -> Store {
        Store::create(self.shelf(place), plan).unwrap()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn free_port() -> u16 {
    TcpListener::bind(("127.0.0.1", 0)).unwrap().local_addr().unwrap().port()
}

fn variables(server: &str) -> Vec<(String, String)> {
    let names = ["AWS_ENDPOINT_URL", "AWS_ALLOW_HTTP", "AWS_REGION", "AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"];
    let values = [server, "true", "eu-central-1", "key", "secret"];
    names.into_iter().zip(values).map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
}

/// A place for each of all plans.
const PLACES: [&str; 4] =
    ["s3://studies/basin", "s3://studies/deep/in/it", "s3://studies/sharded/basin", "s3://studies/sharded/map"];

/// All objects of a place.
fn objects(shelf: &dyn Shelf) -> BTreeMap<String, Vec<u8>> {
    shelf.list("").unwrap().into_iter().map(|item| (item.key.clone(), shelf.get(&item.key).unwrap().unwrap())).collect()
}

#[test]
fn a_bucket_is_a_place_like_a_folder() {
    let Some(server) = Server::start() else { return };
    // another prefix that begins with the same letters
    server.shelf("s3://studies/ab").put("a/c/0/0", b"another's").unwrap();
    let shelf = server.shelf("s3://studies/a/");
    assert_eq!(shelf.name(), "s3://studies/a");
    assert_eq!((shelf.get("a/zarr.json").unwrap(), shelf.list("").unwrap()), (None, vec![]));
    for bytes in [b"first".as_slice(), b"second", b""] {
        shelf.put("a/zarr.json", bytes).unwrap();
        assert_eq!(shelf.get("a/zarr.json").unwrap().as_deref(), Some(bytes));
    }
    for k in 0..120 {
        shelf.put(&format!("a/c/{k}/0"), b"chunk").unwrap();
    }
    shelf.put("ab", b"").unwrap();
    shelf.sweep().unwrap();
    let items = shelf.list("").unwrap();
    assert_eq!(items.len(), 122, "three pages");
    assert!(items.is_sorted_by(|a, b| a.key < b.key));
    assert!(items.iter().all(|item| item.modified.elapsed().is_ok_and(|age| age < Duration::from_secs(600))));
    let count = |prefix| shelf.list(prefix).unwrap().len();
    assert_eq!((count("a"), count("a/"), count("a/c/"), count("a/c/1"), count("b")), (122, 121, 120, 31, 0));
    assert_eq!(shelf.list("a/c/119/").unwrap()[0].size, 5);
    shelf.remove("a/c/119/0").unwrap();
    assert_eq!((shelf.get("a/c/119/0").unwrap(), count("a/c/")), (None, 119));
    // the bucket as a whole
    let bucket = server.shelf("s3://studies");
    assert_eq!(bucket.get("a/a/c/7/0").unwrap().as_deref(), Some(b"chunk".as_slice()));
    assert_eq!(bucket.list("ab/").unwrap().len(), 1);
}

#[test]
fn the_same_bytes_as_in_a_folder() {
    let Some(server) = Server::start() else { return };
    for (plan, place) in all_plans().into_iter().zip(PLACES) {
        let (_kept, want) = whole(&plan);
        let store = server.open(place, &plan);
        let tiles = store.study().grid().tiles();
        for index in [3, 1, 2] {
            let ran = server.open(place, &plan).run(Part::new(index, 3).unwrap(), &control(4)).unwrap();
            assert_eq!(ran.left == 0, index == 2);
        }
        assert!(objects(server.shelf(place).as_ref()) == want, "{place}");
        let progress = store.progress().unwrap();
        assert_eq!((progress.done, progress.complete), (tiles, true));
        let again = Store::open(server.shelf(place)).unwrap();
        assert_eq!(again.run(Part::ALL, &control(2)).unwrap().computed, 0);
        assert_eq!(again.verify(3, 0, &control(2)).unwrap().damage, []);
    }
}

#[test]
fn two_at_once_do_no_harm() {
    let Some(server) = Server::start() else { return };
    for (plan, place) in all_plans().into_iter().zip(PLACES) {
        let (_kept, want) = whole(&plan);
        std::thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| server.open(place, &plan).run(Part::ALL, &control(2)).unwrap());
            }
        });
        assert!(objects(server.shelf(place).as_ref()) == want, "{place}");
    }
}

/// A run survives a server that is unreachable for some time; a server that has never answered is given up within
/// seconds.
#[test]
fn patience_comes_with_the_first_answer() {
    let port = free_port();
    let place = Bucket::with("s3://studies/x", variables(&format!("http://127.0.0.1:{port}"))).unwrap();
    let refused = || {
        let why = place.get("zarr.json").unwrap_err().to_string();
        assert!(why.starts_with(&format!("the server http://127.0.0.1:{port} does not answer: ")), "{why}");
        assert!(why.ends_with("\nhint: AWS_ENDPOINT_URL names another server"), "{why}");
    };
    refused();
    // a server that answers one request, if one comes, and has no objects
    let answer = || {
        let listener = TcpListener::bind(("127.0.0.1", port)).unwrap();
        listener.set_nonblocking(true).unwrap();
        let begin = Instant::now();
        let mut stream = loop {
            match listener.accept() {
                Ok((stream, _)) => break stream,
                Err(_) if begin.elapsed() < Duration::from_secs(20) => std::thread::sleep(Duration::from_millis(10)),
                Err(_) => return,
            }
        };
        stream.set_nonblocking(false).unwrap();
        let mut request = [0; 4096];
        let _ = stream.read(&mut request).unwrap();
        stream.write_all(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n").unwrap();
    };
    std::thread::scope(|scope| {
        scope.spawn(answer);
        assert_eq!(place.get("zarr.json").unwrap(), None);
    });
    std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_secs(8));
            answer();
        });
        assert_eq!(place.get("zarr.json").unwrap(), None);
    });
}

#[test]
fn refusals() {
    let Some(server) = Server::start() else { return };
    let without = |name: &str| server.variables().into_iter().filter(|(key, _)| key != name).collect::<Vec<_>>();
    let refused = |place: &str, variables| Bucket::with(place, variables).unwrap_err().to_string();
    assert!(refused("s3://", server.variables()).contains("s3://BUCKET/PREFIX"));
    assert!(refused("s3://studies/a//b", server.variables()).contains("the prefix cannot be used: "));
    let open = refused("s3://studies", without("AWS_ALLOW_HTTP"));
    assert!(open.contains("is asked without encryption\nhint: AWS_ALLOW_HTTP=true allows it"), "{open}");
    let half = refused("s3://studies", without("AWS_SECRET_ACCESS_KEY"));
    assert!(half.contains("Missing SecretAccessKey\nhint: AWS_ACCESS_KEY_ID and"), "{half}");
    // a bucket that does not exist
    let none = Store::create(server.shelf("s3://nobody/x"), &map()).err().unwrap().to_string();
    assert!(none.contains("refuses: NoSuchBucket: ") && none.contains("\nhint: make the bucket first"), "{none}");
    let none = Store::open(server.shelf("s3://nobody/x")).err().unwrap().to_string();
    assert!(none.contains("refuses: NoSuchBucket: "), "{none}");
    // a place that contains something else
    server.shelf("s3://studies/mine").put("thesis.tex", b"years of work").unwrap();
    let foreign = Store::create(server.shelf("s3://studies/mine"), &map()).err().unwrap().to_string();
    assert!(foreign.starts_with("s3://studies/mine is not empty, and no store"), "{foreign}");
    let other = shelf("gs://studies/x").err().unwrap().to_string();
    assert_eq!(other, "gs://studies/x: a store lies in a folder or at s3://BUCKET/PREFIX");
}

/// The environment of a process can only be set by its parent, so this test starts this program again for the test
/// below.
#[test]
fn the_environment_leads_to_the_server() {
    let Some(server) = Server::start() else { return };
    server.shelf("s3://studies/x").put("word", b"found").unwrap();
    let run = |variables: Vec<(String, String)>| {
        let mut child = Command::new(std::env::current_exe().unwrap());
        for (name, _) in std::env::vars_os().filter(|(name, _)| name.to_string_lossy().starts_with("AWS_")) {
            child.env_remove(name);
        }
        child.envs(variables).env("VIBROIMPACT_S3_PLACE", "s3://studies/x");
        let output = child.args(["--exact", "what_the_environment_leads_to", "--nocapture"]).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let found = run(server.variables());
    assert!(found.contains("Ok(Some([102, 111, 117, 110, 100]))"), "{found}");
    // without a key, the metadata service of the machine is asked for credentials; here it never answers
    let mut keyless: Vec<_> = server.variables();
    keyless.retain(|(name, _)| !name.contains("KEY"));
    keyless.push(("AWS_METADATA_ENDPOINT".to_owned(), format!("http://127.0.0.1:{}", free_port())));
    let none = run(keyless);
    assert!(none.contains("there is no key to ask the server http://127.0.0.1:"), "{none}");
}

#[test]
fn what_the_environment_leads_to() {
    if let Ok(place) = std::env::var("VIBROIMPACT_S3_PLACE") {
        println!("{:?}", shelf(&place).unwrap().get("word"));
    }
}
