//! Connections: not too many, none that holds its place without asking.

use std::sync::Arc;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Notify, Semaphore};

use crate::ServerLimits;

/// Most headers of a request.
const MOST_HEADERS: usize = 64;
/// Most bytes of a request's head, and of what is read at once.
const MOST_HEAD: usize = 64 << 10;

/// Answers until it is told to stop.
pub(crate) async fn serve(
    listener: &TcpListener,
    pages: Router,
    limits: &ServerLimits,
    stop: &Notify,
) {
    let places = Arc::new(Semaphore::new(limits.connections));
    let builder = builder(limits);
    let accept = async {
        loop {
            let Ok(place) = Arc::clone(&places).acquire_owned().await else {
                return;
            };
            match listener.accept().await {
                Ok((stream, _)) => {
                    let connection = connection(builder.clone(), stream, pages.clone());
                    tokio::spawn(async move {
                        let _place = place;
                        connection.await;
                    });
                }
                // Too many open files, say: others may be closed soon.
                Err(_) => tokio::time::sleep(std::time::Duration::from_millis(100)).await,
            }
        }
    };
    tokio::select! {
        () = accept => {}
        () = stop.notified() => {}
    }
}

fn builder(limits: &ServerLimits) -> http1::Builder {
    let mut builder = http1::Builder::new();
    builder
        .timer(TokioTimer::new())
        .header_read_timeout(limits.head_time)
        .max_headers(MOST_HEADERS)
        .max_buf_size(MOST_HEAD);
    builder
}

/// A connection's end is no event: browsers go away as they like.
async fn connection(builder: http1::Builder, stream: TcpStream, pages: Router) {
    let _ = stream.set_nodelay(true);
    let service = TowerToHyperService::new(pages);
    let _ = builder
        .serve_connection(TokioIo::new(stream), service)
        .await;
}
