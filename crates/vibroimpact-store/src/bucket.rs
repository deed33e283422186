//! Buckets of S3-compatible object stores as places for studies.
//!
//! An object in a bucket appears complete or not at all, and listings include it at once. A store requires nothing else
//! of a place.

use crate::StoreError;
use crate::shelf::{Item, Shelf};
use futures_util::TryStreamExt;
use object_store::aws::{AmazonS3, AmazonS3Builder, AmazonS3ConfigKey};
use object_store::path::Path;
use object_store::{BackoffConfig, ClientConfigKey, GetOptions, GetRange, ObjectStore, ObjectStoreExt, RetryConfig};
use std::error::Error;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use std::{fmt, io, iter};
use tokio::runtime::{Builder, Runtime};

/// Time limit for a connection.
const CONNECT: Duration = Duration::from_secs(3);
/// Time limit for a request; chunks are small.
const REQUEST: Duration = Duration::from_secs(30);
/// Time for which a failing request is repeated if the server has never answered. A wrong environment variable is then
/// the likely reason.
const FIRST: Duration = Duration::from_secs(3);
/// The same time after the server has answered once: a run of several days should survive a network failure of a
/// minute.
const LATER: Duration = Duration::from_secs(90);
/// Maximum wait between two attempts.
const PAUSE: Duration = Duration::from_secs(5);
/// Maximum number of attempts; the times above end them long before.
const TRIES: usize = 1000;
/// Number of threads that wait for the network.
const WORKERS: usize = 2;

/// The objects of a bucket whose names begin with a prefix.
///
/// It has its own threads for the network, and its functions block until they have an answer. In a program with a
/// `tokio` runtime, call it from `spawn_blocking`.
pub struct Bucket {
    runtime: Runtime,
    first: AmazonS3,
    later: AmazonS3,
    answered: AtomicBool,
    prefix: Path,
    name: String,
    server: String,
    keyless: bool,
}

impl Bucket {
    /// The bucket and prefix at `s3://bucket/prefix`. Access is configured by the environment variables whose names
    /// begin with `AWS_`: `AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_SESSION_TOKEN`, `AWS_REGION`,
    /// `AWS_ENDPOINT_URL`, `AWS_ALLOW_HTTP` and the others of [`AmazonS3Builder::from_env`]. No request is sent to the
    /// server yet.
    pub(crate) fn new(place: &str) -> Result<Self, StoreError> {
        let words = |(key, value): (std::ffi::OsString, std::ffi::OsString)| {
            Some((key.into_string().ok()?, value.into_string().ok()?))
        };
        Self::with(place, std::env::vars_os().filter_map(words))
    }

    /// As `Bucket::new`, but with the given variables instead of the environment.
    ///
    /// # Errors
    /// As `Bucket::new`.
    pub fn with(place: &str, variables: impl IntoIterator<Item = (String, String)>) -> Result<Self, StoreError> {
        let refused = |why: String| StoreError::Unreachable { place: place.to_owned(), why };
        let rest = place.strip_prefix("s3://").unwrap_or_default();
        let (bucket, prefix) = rest.split_once('/').unwrap_or((rest, ""));
        if bucket.is_empty() {
            return Err(refused("a bucket is named as s3://BUCKET or s3://BUCKET/PREFIX".to_owned()));
        }
        let prefix = Path::parse(prefix).map_err(|error| refused(format!("the prefix cannot be used: {error}")))?;
        let name = format!("s3://{bucket}/{prefix}").trim_end_matches('/').to_owned();

        let limit = |key, time: Duration| (AmazonS3ConfigKey::Client(key), format!("{} seconds", time.as_secs()));
        let mut builder = [limit(ClientConfigKey::ConnectTimeout, CONNECT), limit(ClientConfigKey::Timeout, REQUEST)]
            .into_iter()
            .fold(AmazonS3Builder::new(), |builder, (key, time)| builder.with_config(key, time));
        for (name, value) in variables {
            let known = name.starts_with("AWS_").then(|| name.to_ascii_lowercase().parse::<AmazonS3ConfigKey>());
            if let Some(Ok(key)) = known {
                builder = builder.with_config(key, value);
            }
        }
        let told = |key| builder.get_config_value(&key).filter(|value| !value.is_empty());
        let keyless = told(AmazonS3ConfigKey::AccessKeyId).is_none();
        let server = told(AmazonS3ConfigKey::S3Endpoint).or_else(|| told(AmazonS3ConfigKey::Endpoint));
        let flag = |key| told(key).is_some_and(|value| matches!(value.as_str(), "true" | "1" | "yes" | "on"));
        let open = flag(AmazonS3ConfigKey::Client(ClientConfigKey::AllowHttp));
        if let Some(server) = server.as_ref().filter(|server| server.starts_with("http:") && !open) {
            return Err(refused(format!(
                "the server {server} is asked without encryption\nhint: AWS_ALLOW_HTTP=true allows it, as for a server on this machine"
            )));
        }
        let server = server.unwrap_or_else(|| "of Amazon".to_owned());

        // use one cryptography crate; if the program has already installed another one, keep that
        let _ = rustls::crypto::ring::default_provider().install_default();
        let client = |patience: Duration| {
            let backoff = BackoffConfig { max_backoff: PAUSE.min(patience / 4), ..BackoffConfig::default() };
            let retry = RetryConfig { backoff, max_retries: TRIES, retry_timeout: patience };
            let builder = builder.clone().with_bucket_name(bucket).with_retry(retry);
            builder.build().map_err(|error| refused(format!("{}\nhint: {KEYS}", root_of(&error))))
        };
        let (first, later) = (client(FIRST)?, client(LATER)?);
        let runtime = Builder::new_multi_thread().worker_threads(WORKERS).thread_name("bucket").enable_all().build();
        let runtime = runtime.map_err(|error| refused(format!("its threads cannot be started: {error}")))?;
        Ok(Self { runtime, first, later, answered: AtomicBool::new(false), prefix, name, server, keyless })
    }

    /// The name of an object in the bucket.
    fn path(&self, key: &str) -> Path {
        key.split('/').fold(self.prefix.clone(), |path, part| path.join(part))
    }

    /// Sends a request and waits for its answer; `None` if there is no such object.
    fn ask<T>(&self, question: impl AsyncFnOnce(&AmazonS3) -> object_store::Result<T>) -> io::Result<Option<T>> {
        let client = if self.answered.load(Ordering::Relaxed) { &self.later } else { &self.first };
        let answer = match self.runtime.block_on(question(client)) {
            Ok(answer) => Some(answer),
            Err(object_store::Error::NotFound { ref source, .. }) if !source.to_string().contains("NoSuchBucket") => {
                None
            }
            Err(error) => return Err(io::Error::other(self.sentence(&error))),
        };
        self.answered.store(true, Ordering::Relaxed);
        Ok(answer)
    }

    /// An error message that states the cause and the remedy.
    fn sentence(&self, error: &object_store::Error) -> String {
        let (text, server) = (error.to_string(), &self.server);
        let within = |tag: &str| {
            let (_, after) = text.split_once(&format!("<{tag}>"))?;
            Some(after.split_once('<')?.0)
        };
        if let Some(code) = within("Code") {
            let hint = if code == "NoSuchBucket" { "make the bucket first; AWS_ENDPOINT_URL says where" } else { KEYS };
            return format!(
                "the server {server} refuses: {code}: {}\nhint: {hint}",
                within("Message").unwrap_or_default()
            );
        }
        // without a key, the credentials of the role of the machine were requested from its metadata service
        if self.keyless && text.contains("/latest/") {
            return format!("there is no key to ask the server {server} with\nhint: {KEYS}");
        }
        let why = root_of(error);
        if chain(error).any(|error| error.is::<object_store::client::HttpError>()) {
            return format!("the server {server} does not answer: {why}\nhint: AWS_ENDPOINT_URL names another server");
        }
        format!("the server {server} gives no answer of use: {why}\nhint: {KEYS}")
    }
}

/// A hint that fits most refused requests.
const KEYS: &str = "AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY say who asks, AWS_REGION and AWS_ENDPOINT_URL where";

/// An error followed by its chain of causes.
fn chain<'a>(error: &'a (dyn Error + 'static)) -> impl Iterator<Item = &'a (dyn Error + 'static)> {
    iter::successors(Some(error), |&error| error.source())
}

/// The message of the last cause of the chain.
fn root_of(error: &(dyn Error + 'static)) -> String {
    let words = chain(error).last().map(ToString::to_string).unwrap_or_default();
    words.trim_end_matches([':', ' ']).to_owned()
}

impl fmt::Debug for Bucket {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Bucket").field("name", &self.name).field("server", &self.server).finish_non_exhaustive()
    }
}

impl Shelf for Bucket {
    fn get(&self, key: &str) -> io::Result<Option<Vec<u8>>> {
        let path = self.path(key);
        self.ask(async |client| Ok(client.get(&path).await?.bytes().await?.to_vec()))
    }

    fn put(&self, key: &str, bytes: &[u8]) -> io::Result<()> {
        let (path, bytes) = (self.path(key), bytes.to_vec());
        let written = self.ask(async |client| client.put(&path, bytes.into()).await)?;
        written.map(drop).ok_or_else(|| io::Error::other(format!("the server {} says it is not found", self.server)))
    }

    fn tail(&self, key: &str, count: usize) -> io::Result<Option<(Vec<u8>, u64)>> {
        let path = self.path(key);
        let end = GetOptions::new().with_range(Some(GetRange::Suffix(count as u64)));
        self.ask(async |client| {
            let found = client.get_opts(&path, end).await?;
            let length = found.meta.size;
            Ok((found.bytes().await?.to_vec(), length))
        })
    }

    fn range(&self, key: &str, from: u64, count: u64) -> io::Result<Option<Vec<u8>>> {
        if count == 0 {
            return Ok(Some(Vec::new()));
        }
        let path = self.path(key);
        self.ask(async |client| Ok(client.get_range(&path, from..from.saturating_add(count)).await?.to_vec()))
    }

    fn remove(&self, key: &str) -> io::Result<()> {
        let path = self.path(key);
        self.ask(async |client| client.delete(&path).await).map(drop)
    }

    fn list(&self, prefix: &str) -> io::Result<Vec<Item>> {
        // the server lists objects below a name that ends at a slash
        let below = prefix.rfind('/').map_or(self.prefix.clone(), |end| self.path(&prefix[..end]));
        let found: Vec<_> = self.ask(async |client| client.list(Some(&below)).try_collect().await)?.unwrap_or_default();
        let start = if self.prefix.as_ref().is_empty() { 0 } else { self.prefix.as_ref().len() + 1 };
        let item = |object: object_store::ObjectMeta| {
            // some programs create an object with the name of the prefix to represent a folder; it is skipped
            let key = object.location.as_ref().get(start..).filter(|key| !key.is_empty() && key.starts_with(prefix))?;
            Some(Item { key: key.to_owned(), size: object.size, modified: object.last_modified.into() })
        };
        let mut items: Vec<Item> = found.into_iter().filter_map(item).collect();
        items.sort_by(|a, b| a.key.cmp(&b.key));
        Ok(items)
    }

    fn sweep(&self) -> io::Result<()> {
        // an upload that was not completed leaves no object, so there is nothing to remove
        Ok(())
    }

    fn name(&self) -> String {
        self.name.clone()
    }
}
