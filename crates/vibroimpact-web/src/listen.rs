//! The address, connections and their end.

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
/// Ports tried after a busy one, before any free one is taken.
const NEXT: u16 = 20;
/// How long a client may take to send its head, and a connection rest between two requests.
const PATIENCE: Duration = Duration::from_secs(20);
/// How long a connection lasts, and then how long its last answer may take to be read.
const EXCHANGE: Duration = Duration::from_secs(300);
/// Between two looks whether it is to end.
const PULSE: Duration = Duration::from_millis(50);
/// Connections at a time; a browser opens six.
const CONNECTIONS: usize = 600;

/// An explorer with its address, not yet answering.
#[derive(Debug)]
pub struct BoundServer {
    listener: std::net::TcpListener,
    address: SocketAddr,
}

impl BoundServer {
    /// Takes a port of the loopback interface: the one asked for or, if that is busy, one of the next, or any. 0 is any.
    ///
    /// # Errors
    /// When no port can be had.
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

    /// Where the page is.
    #[must_use]
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// Answers until `stop` is set; what is under way is then broken off. `threads` tiles are made at a time, as many as there are
    /// processors for 0.
    ///
    /// # Errors
    /// When the operating system takes the address or refuses threads.
    pub fn serve(self, threads: usize, stop: &AtomicBool) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build()?;
        let result = runtime.block_on(async {
            tokio::select! {
                result = accept(self, threads) => result,
                () = set(stop) => Ok(()),
            }
        });
        // work that was asked to stop ends by itself
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
            // no more files, or a client that is gone already: others are still served
            Err(_) => {
                tokio::time::sleep(Duration::from_millis(20)).await;
                continue;
            }
        };
        // one too many is hung up on at once
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
                // a client that breaks off is no fault
                _ = &mut connection => {}
                () = tokio::time::sleep(EXCHANGE) => {
                    // what is under way is still answered, but no reader may take for ever
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
