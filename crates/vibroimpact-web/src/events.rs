//! The progress of long work as server-sent events: `progress`, then `done` or `error`.

use crate::refusal::Refusal;
use axum::http::{HeaderMap, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use core::convert::Infallible;
use core::sync::atomic::{AtomicU64, Ordering};
use core::time::Duration;
use serde_json::{Value, json};
use std::sync::Arc;
use tokio::sync::mpsc;

/// Time between two events.
const PAUSE: Duration = Duration::from_millis(100);

/// Called with the number of points done.
pub(crate) type Progress = Box<dyn Fn(u64) + Send + Sync>;

/// Answers with the result of `work`, which reports how many of `total` points are done: by events with the `value` of the result, if the
/// page requests them, or else as it is `shown`.
pub(crate) async fn answered<T, F: Future<Output = Result<T, Refusal>> + Send + 'static>(
    headers: &HeaderMap,
    total: u64,
    work: impl FnOnce(Progress) -> F,
    value: impl FnOnce(T) -> Result<Value, Refusal> + Send + 'static,
    shown: impl FnOnce(T) -> Response,
) -> Result<Response, Refusal> {
    let done = Arc::new(AtomicU64::new(0));
    let reported = done.clone();
    let work = work(Box::new(move |now| reported.store(now, Ordering::Relaxed)));
    if headers.get(header::ACCEPT).is_some_and(|kind| kind.as_bytes().starts_with(b"text/event-stream")) {
        return Ok(stream(total, done, async { value(work.await?) }));
    }
    Ok(shown(work.await?))
}

/// The events of `work`. If the connection ends, the work stops.
fn stream(
    total: u64,
    done: Arc<AtomicU64>,
    work: impl Future<Output = Result<Value, Refusal>> + Send + 'static,
) -> Response {
    let (events, received) = mpsc::channel::<Event>(8);
    tokio::spawn(async move {
        tokio::pin!(work);
        let mut pulse = tokio::time::interval(PAUSE);
        let mut told = None;
        loop {
            tokio::select! {
                result = &mut work => {
                    let (name, data) = match result {
                        Ok(value) => ("done", value),
                        Err(refusal) => ("error", refusal.object()),
                    };
                    let _ = events.send(event(name, &data)).await;
                    break;
                }
                () = events.closed() => break,
                _ = pulse.tick() => {
                    let now = done.load(Ordering::Relaxed).min(total);
                    if told.replace(now) != Some(now) {
                        // if the reader is slow, this event is dropped; it gets a later one
                        let _ = events.try_send(event("progress", &json!({ "done": now, "total": total })));
                    }
                }
            }
        }
    });
    let each = |mut received: mpsc::Receiver<Event>| async {
        received.recv().await.map(|event| (Ok::<_, Infallible>(event), received))
    };
    Sse::new(futures_util::stream::unfold(received, each)).keep_alive(KeepAlive::default()).into_response()
}

fn event(name: &str, data: &Value) -> Event {
    Event::default().event(name).data(data.to_string())
}
