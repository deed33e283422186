//! The address and the connections of the server.

use crate::{Explorer, app};
use core::net::{Ipv4Addr, SocketAddr};
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use hyper_util::rt::{TokioExecutor, TokioIo, TokioTimer};
use hyper_util::server::conn::auto::Builder;
use hyper_util::service::TowerToHyperService;
use std::io;
use std::sync::Arc;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;
use tower::Service;

/// The default port.
pub const PORT: u16 = 8411;
/// Number of further ports tried after a busy one, before any free port is taken.
const NEXT: u16 = 20;
/// Time limit for a client to send the head of a request, and for an idle connection.
const PATIENCE: Duration = Duration::from_secs(20);
/// Time limit of a connection, and after that for the reading of its last answer.
const EXCHANGE: Duration = Duration::from_secs(300);
/// Time between two checks of the stop flag.
const PULSE: Duration = Duration::from_millis(50);
/// Maximum number of simultaneous connections; a browser opens six.
const CONNECTIONS: usize = 600;

/// An explorer that has an address but does not answer yet.
#[derive(Debug)]
pub struct BoundServer {
    listener: std::net::TcpListener,
    address: SocketAddr,
}

impl BoundServer {
    /// Binds a port of the loopback interface: the requested one or, if it is busy, one of the next, or any free one. 0
    /// requests any free port.
    ///
    /// # Errors
    /// If no port is available.
    pub fn new(port: u16) -> io::Result<Self> {
        let ports = if port == 0 { vec![0] } else { (port..=port.saturating_add(NEXT)).chain([0]).collect() };
        let mut result = Err(io::Error::from(io::ErrorKind::AddrInUse));
        for port in ports {
            result = std::net::TcpListener::bind((Ipv4Addr::LOCALHOST, port));
            if !matches!(&result, Err(error) if error.kind() == io::ErrorKind::AddrInUse) {
                break;
            }
        }
        let listener = result?;
        listener.set_nonblocking(true)?;
        Ok(Self { address: listener.local_addr()?, listener })
    }

    /// The address of the page.
    #[must_use]
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// Answers requests until `stop` is set; unfinished ones are then aborted. `threads` tiles are computed at a time
    /// (0: one for each processor).
    ///
    /// # Errors
    /// If the operating system withdraws the address or cannot start threads.
    pub fn serve(self, threads: usize, stop: &AtomicBool) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
        let result = runtime.block_on(async {
            tokio::select! {
                result = accept(self, threads) => result,
                () = set(stop) => Ok(()),
            }
        });
        // work that was asked to stop ends without further action
        runtime.shutdown_timeout(Duration::from_millis(500));
        result
    }
}

async fn set(stop: &AtomicBool) {
    while !stop.load(Ordering::Relaxed) {
        tokio::time::sleep(PULSE).await;
    }
}

async fn accept(bound: BoundServer, threads: usize) -> io::Result<()> {
    let listener = TcpListener::from_std(bound.listener)?;
    let service = app(Explorer::new(bound.address.port(), threads));
    let places = Arc::new(Semaphore::new(CONNECTIONS));
    loop {
        let stream = match listener.accept().await {
            Ok((stream, _)) => stream,
            // no more file handles, or a client that is already gone: other clients are still served
            Err(_) => {
                tokio::time::sleep(Duration::from_millis(20)).await;
                continue;
            }
        };
        // a connection above the maximum is closed at once
        let Ok(place) = places.clone().try_acquire_owned() else { continue };
        let mut service = service.clone();
        tokio::spawn(async move {
            let _place = place;
            let mut builder = Builder::new(TokioExecutor::new()).http1_only();
            builder.http1().timer(TokioTimer::new()).header_read_timeout(PATIENCE).max_buf_size(64 << 10);
            let answer = tower::service_fn(move |request: hyper::Request<hyper::body::Incoming>| service.call(request));
            let connection = builder.serve_connection(TokioIo::new(stream), TowerToHyperService::new(answer));
            tokio::pin!(connection);
            tokio::select! {
                // a client that closes the connection is not an error
                _ = &mut connection => {}
                () = tokio::time::sleep(EXCHANGE) => {
                    // the current request is still answered, but with a time limit for the reader
                    connection.as_mut().graceful_shutdown();
                    let _ = tokio::time::timeout(EXCHANGE, connection).await;
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_busy_port_is_followed_by_another() {
        let one = BoundServer::new(0).unwrap();
        assert!(one.url().starts_with("http://127.0.0.1:"));
        let two = BoundServer::new(one.address.port()).unwrap();
        assert_ne!(one.address, two.address);
        assert!(two.address.ip().is_loopback());
    }
}
