//! The progress of long work as server-sent events: `progress`, then `done` or `error`.

use crate::refusal::Refusal;
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

/// Number of points done, as reported by the work.
pub(crate) type Done = Arc<AtomicU64>;

/// Answers with the events of `work`, which reports how many of `total` points are done. If the connection ends, the
/// work stops.
pub(crate) fn stream(
    total: u64,
    done: Done,
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
