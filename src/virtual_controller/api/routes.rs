//! Handlers registered under the method and path of the request type that they answer.

use std::any::TypeId;
use std::sync::Arc;

use axum::body::Body;
use axum::extract::rejection::PathRejection;
use axum::extract::{Extension, Path, RawQuery};
use axum::http::StatusCode;
use axum::response::{IntoResponse as _, Response};
use axum::routing::{MethodFilter, MethodRouter, on};
use axum::{Json, Router};

use super::body::{MalformedBody, read};
use super::caller::{Caller, ClientConnection, unknown_method, unknown_path};
use super::failed::FailedRequest;
use super::request_error::RequestError;
use crate::protocol::{Method, Request};

/// A router in the making, and what was registered.
#[derive(Default)]
pub(super) struct Routes {
    router: Router,
    #[cfg(test)]
    pub(super) registered: Vec<(Method, &'static str)>,
}

type Answer = Result<Response, FailedRequest>;

impl Routes {
    /// A request without a session and without a body.
    pub(super) fn open<R, F, A>(self, handler: F) -> Self
    where
        R: Request<Response: 'static>,
        F: Fn() -> A + Clone + Send + Sync + 'static,
        A: Future<Output = Result<R::Response, FailedRequest>> + Send,
    {
        self.add::<R>(on(filter::<R>(), async move || -> Answer { Ok(respond(handler().await?)) }))
    }

    /// A request without a session and with a body.
    pub(super) fn open_with_body<R, F, A>(self, malformed: MalformedBody, handler: F) -> Self
    where
        R: Request<Response: 'static> + 'static,
        F: Fn(ClientConnection, R) -> A + Clone + Send + Sync + 'static,
        A: Future<Output = Result<R::Response, FailedRequest>> + Send,
    {
        let handler = async move |Extension(connection): Extension<ClientConnection>, body: Body| -> Answer {
            Ok(respond(handler(connection, read(body, malformed).await?).await?))
        };
        self.add::<R>(on(filter::<R>(), handler))
    }

    /// A request in a session, without a body.
    pub(super) fn plain<R, F, A>(self, handler: F) -> Self
    where
        R: Request<Response: 'static>,
        F: Fn(Arc<Caller>) -> A + Clone + Send + Sync + 'static,
        A: Future<Output = Result<R::Response, FailedRequest>> + Send,
    {
        let handler = async move |caller: Caller| -> Answer { Ok(respond(handler(Arc::new(caller)).await?)) };
        self.add::<R>(on(filter::<R>(), handler))
    }

    /// A request in a session, with a body.
    pub(super) fn with_body<R, F, A>(self, malformed: MalformedBody, handler: F) -> Self
    where
        R: Request<Response: 'static> + 'static,
        F: Fn(Arc<Caller>, R) -> A + Clone + Send + Sync + 'static,
        A: Future<Output = Result<R::Response, FailedRequest>> + Send,
    {
        let handler = async move |caller: Caller, body: Body| -> Answer {
            Ok(respond(handler(Arc::new(caller), read(body, malformed).await?).await?))
        };
        self.add::<R>(on(filter::<R>(), handler))
    }

    /// A request in a session, with a value in its path.
    pub(super) fn with_path<R, F, A>(self, handler: F) -> Self
    where
        R: Request<Response: 'static>,
        F: Fn(Arc<Caller>, String) -> A + Clone + Send + Sync + 'static,
        A: Future<Output = Result<R::Response, FailedRequest>> + Send,
    {
        let handler = async move |caller: Caller, value: Result<Path<String>, PathRejection>| -> Answer {
            let Path(value) = value.map_err(|_| RequestError::UnknownPath)?;
            Ok(respond(handler(Arc::new(caller), value).await?))
        };
        self.add::<R>(on(filter::<R>(), handler))
    }

    /// A request in a session, with a query.
    pub(super) fn with_query<R, F, A>(self, handler: F) -> Self
    where
        R: Request<Response: 'static>,
        F: Fn(Arc<Caller>, Option<String>) -> A + Clone + Send + Sync + 'static,
        A: Future<Output = Result<R::Response, FailedRequest>> + Send,
    {
        let handler = async move |caller: Caller, RawQuery(query): RawQuery| -> Answer {
            Ok(respond(handler(Arc::new(caller), query).await?))
        };
        self.add::<R>(on(filter::<R>(), handler))
    }

    /// The router; other paths and methods get 404 and 405.
    pub(super) fn router(self) -> Router {
        self.router.fallback(unknown_path).method_not_allowed_fallback(unknown_method)
    }

    fn add<R: Request>(mut self, route: MethodRouter) -> Self {
        #[cfg(test)]
        self.registered.push((R::METHOD, R::PATH));
        self.router = self.router.route(R::PATH, route);
        self
    }
}

fn filter<R: Request>() -> MethodFilter {
    match R::METHOD {
        Method::Get => MethodFilter::GET,
        Method::Put => MethodFilter::PUT,
        Method::Post => MethodFilter::POST,
    }
}

fn respond<T: crate::protocol::Response + 'static>(response: T) -> Response {
    if TypeId::of::<T>() == TypeId::of::<()>() {
        StatusCode::NO_CONTENT.into_response()
    } else {
        Json(response).into_response()
    }
}
