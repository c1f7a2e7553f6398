use std::fmt;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::Response;
use crate::model::RevisionToken;

/// One request of the protocol. Method, path, body and response belong to the type: a client sends a value of it, a controller
/// registers its handler under [`Request::METHOD`] and [`Request::PATH`] of the same type.
///
/// The table of all requests is [`REQUESTS`](super::REQUESTS).
pub trait Request: Serialize + DeserializeOwned + fmt::Debug + Send + Sync {
    /// The HTTP method.
    const METHOD: Method;
    /// Begins with `/v1/`. At most one part stands for a value: `{id}`.
    const PATH: &'static str;
    /// What the request must carry.
    const NEEDS: RequestNeeds;
    /// The request is the JSON body. Otherwise the request has no body, and its fields are in the path or the query.
    const HAS_BODY: bool;
    /// The body of the answer to a request that succeeded.
    type Response: Response;

    /// Path and query of this request: [`Request::PATH`] with the value filled in.
    fn target(&self) -> String;

    /// The revision that the change is based on. `None` unless [`Request::NEEDS`] is [`RequestNeeds::Revision`].
    fn revision(&self) -> Option<RevisionToken>;
}

/// The HTTP method of a request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Method {
    /// Changes nothing.
    Get,
    /// Replaces a value as a whole.
    Put,
    /// Does something.
    Post,
}

impl Method {
    /// As in a request line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Get => "GET",
            Self::Put => "PUT",
            Self::Post => "POST",
        }
    }
}

/// What a request must carry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RequestNeeds {
    /// Nothing: it is answered without a session.
    Nothing,
    /// The token of a session.
    Session,
    /// The token of a session, and in the body the revision that the change is based on.
    Revision,
}

/// One row of a table of requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RequestRow {
    /// The name of the type.
    pub request: &'static str,
    /// The HTTP method.
    pub method: Method,
    /// The path, which begins with `/v1/`; `{name}` stands for a parameter.
    pub path: &'static str,
    /// What the request must carry.
    pub needs: RequestNeeds,
    /// Whether the request has a JSON body.
    pub has_body: bool,
}

impl RequestRow {
    pub(super) const fn of<R: Request>(request: &'static str) -> Self {
        Self { request, method: R::METHOD, path: R::PATH, needs: R::NEEDS, has_body: R::HAS_BODY }
    }
}

/// Defines a table of requests: implements [`Request`] for each row, and makes the table's documentation of the same rows.
///
/// A row is `METHOD "path" Type { json | none } needs -> Response, "what else has to be known"`. The word `at` and a function
/// of the request follow where the fields of the request are in the path or the query.
macro_rules! requests {
    (
        $(#[$doc:meta])*
        $table:ident
        $(
            $method:ident $path:literal $request:ident { $body:ident } $needs:ident -> $response:ty, $note:literal
            $(, at $target:expr)?;
        )*
    ) => {
        $(#[$doc])*
        ///
        /// | method and path | request | needs | response | |
        /// |---|---|---|---|---|
        $(
            #[doc = concat!(
                "| `", stringify!($method), " ", $path, "` | [`", stringify!($request), "`], body: ", stringify!($body), " | ",
                stringify!($needs), " | `", stringify!($response), "` | ", $note, " |"
            )]
        )*
        pub const $table: &[$crate::protocol::RequestRow] =
            &[$($crate::protocol::RequestRow::of::<$request>(stringify!($request)),)*];

        $(
            impl $crate::protocol::Request for $request {
                const METHOD: $crate::protocol::Method = requests!(@method $method);
                const PATH: &'static str = $path;
                const NEEDS: $crate::protocol::RequestNeeds = requests!(@needs $needs);
                const HAS_BODY: bool = requests!(@body $body);
                type Response = $response;

                fn target(&self) -> String {
                    requests!(@target self $($target)?)
                }

                fn revision(&self) -> Option<$crate::model::RevisionToken> {
                    requests!(@revision self $needs)
                }
            }
        )*
    };
    (@method GET) => { $crate::protocol::Method::Get };
    (@method PUT) => { $crate::protocol::Method::Put };
    (@method POST) => { $crate::protocol::Method::Post };
    (@needs nothing) => { $crate::protocol::RequestNeeds::Nothing };
    (@needs session) => { $crate::protocol::RequestNeeds::Session };
    (@needs revision) => { $crate::protocol::RequestNeeds::Revision };
    (@body json) => { true };
    (@body none) => { false };
    (@target $request:ident) => { Self::PATH.to_owned() };
    (@target $request:ident $target:expr) => { $target($request) };
    (@revision $request:ident revision) => { Some($request.revision) };
    (@revision $request:ident $needs:ident) => { None };
}

pub(super) use requests;
