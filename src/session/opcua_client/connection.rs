use std::sync::Arc;
use std::time::Duration;

use opcua::client::transport::{
    SecureChannelEventLoop, StreamConnection, StreamConnector, StreamTransport, TransportConfiguration,
    TransportPollResult,
};
use opcua::client::{AsyncSecureChannel, SessionRetryPolicy};
use opcua::core::ResponseMessage;
use opcua::core::comms::tcp_codec::TcpCodec;
use opcua::crypto::CertificateStore;
use opcua::sync::RwLock;
use opcua::types::{
    ContextOwned, DecodingOptions, EndpointDescription, Error, GetEndpointsRequest, NamespaceMap, RequestHeader,
    StatusCode,
};
use parking_lot::Mutex;
use tokio::io::{ReadHalf, WriteHalf};
use tokio::net::TcpStream;
use tokio_util::codec::FramedRead;

use super::endpoint::Endpoint;
use super::failure::{ConnectFailure, ConnectFailureCause, ConnectStage};
use super::server_location::ServerLocation;
use super::watched_stream::{MAX_BYTES, MAX_FRAME, StreamObservations, WatchedStream};

/// How one connection is made.
pub(super) struct ConnectionSetup {
    pub target: ServerLocation,
    pub store: Arc<RwLock<CertificateStore>>,
    pub connect: Duration,
    /// The step in progress, named in the error of a time-out.
    pub stage: Arc<Mutex<ConnectStage>>,
    pub limits: ReceiveLimits,
}

/// How much a server may send.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ReceiveLimits {
    /// Bytes on the whole connection; `None`: no limit, for a session that stays open.
    pub total_bytes: Option<usize>,
    /// Bytes of one byte string.
    pub byte_string: usize,
    /// Elements of one array.
    pub array: usize,
}

impl ReceiveLimits {
    /// For one try: endpoints, and one value.
    pub const ONE_TRY: Self = Self { total_bytes: Some(MAX_BYTES), byte_string: MAX_FRAME, array: 1_000 };
    /// For a session that reads any node of the address space. One message has at most 2 MiB, as everywhere.
    pub const SESSION: Self = Self { total_bytes: None, byte_string: MAX_BYTES, array: 100_000 };
}

/// An open secure channel.
pub(super) struct ClientChannel {
    pub secure: AsyncSecureChannel,
    pub events: ChannelEvents,
    pub heard: Arc<Mutex<StreamObservations>>,
    stage: Arc<Mutex<ConnectStage>>,
}

/// Must be polled for the channel to make progress.
pub(super) type ChannelEvents = SecureChannelEventLoop<StreamTransport<Reader, WriteHalf<TcpStream>>>;

type Reader = WatchedStream<ReadHalf<TcpStream>>;

impl ConnectionSetup {
    /// Connects, and opens a secure channel as the description wants it.
    pub async fn open(&self, endpoint: EndpointDescription) -> Result<ClientChannel, ConnectFailure> {
        let stream = self.tcp().await?;
        *self.stage.lock() = ConnectStage::Channel;
        let url = endpoint.endpoint_url.to_string();
        let (reader, writer) = tokio::io::split(stream);
        let (reader, heard) = WatchedStream::new(reader, self.limits.total_bytes);
        let secure = AsyncSecureChannel::new(
            self.store.clone(),
            endpoint.into(),
            SessionRetryPolicy::default(),
            // A controller's clock may be off, which is not what this is about.
            true,
            Arc::default(),
            TransportConfiguration {
                send_buffer_size: MAX_FRAME,
                recv_buffer_size: MAX_FRAME,
                max_message_size: MAX_BYTES,
                max_chunk_count: MAX_CHUNKS,
            },
            TOKEN_LIFETIME_MS,
            Arc::new(RwLock::new(ContextOwned::new_default(NamespaceMap::new(), self.limits.decoding()))),
        );
        let once = Mutex::new(Some((reader, writer)));
        let connector = StreamConnector::new(
            |url: String, options: DecodingOptions| {
                let opened = once.lock().take().map(|(reader, writer)| {
                    StreamConnection::new(FramedRead::new(reader, TcpCodec::new(options)), writer, url)
                });
                std::future::ready(opened.ok_or_else(|| Error::new(StatusCode::BadInvalidState, "connected twice")))
            },
            url,
        );
        let events = secure.connect_no_retry(&connector).await;
        let events = events.map_err(|e| ConnectFailure::from_library(ConnectStage::Channel, &e, &heard.lock()))?;
        Ok(ClientChannel { secure, events, heard, stage: self.stage.clone() })
    }

    async fn tcp(&self) -> Result<TcpStream, ConnectFailure> {
        let connect = TcpStream::connect(self.target.authority());
        match tokio::time::timeout(self.connect, connect).await {
            Ok(Ok(stream)) => Ok(stream),
            Ok(Err(e)) => {
                Err(ConnectFailure::of(ConnectStage::Connect, ConnectFailureCause::NotReachable(e.to_string())))
            }
            Err(_) => Err(ConnectFailure::of(ConnectStage::Connect, ConnectFailureCause::TimedOut)),
        }
    }

    /// GetEndpoints over a channel without security.
    pub async fn endpoints(&self) -> Result<Vec<Endpoint>, ConnectFailure> {
        let url = format!("{}/", self.target.url());
        let mut channel = self.open(EndpointDescription::from(url.as_str())).await?;
        let request = GetEndpointsRequest {
            request_header: RequestHeader {
                timestamp: opcua::types::DateTime::now(),
                request_handle: channel.secure.request_handle(),
                timeout_hint: REQUEST.as_millis() as u32,
                ..Default::default()
            },
            endpoint_url: url.into(),
            locale_ids: None,
            profile_uris: None,
        };
        let response =
            channel.drive(ConnectStage::Endpoints, async |secure| secure.send(request, REQUEST).await).await?;
        channel.close().await;
        match response {
            ResponseMessage::GetEndpoints(response) if response.response_header.service_result.is_good() => {
                Ok(response.endpoints.into_iter().flatten().filter_map(Endpoint::new).collect())
            }
            ResponseMessage::GetEndpoints(response) => Err(ConnectFailure::of(
                ConnectStage::Endpoints,
                super::failure::status(response.response_header.service_result, ""),
            )),
            ResponseMessage::ServiceFault(fault) => Err(ConnectFailure::of(
                ConnectStage::Endpoints,
                super::failure::status(fault.response_header.service_result, ""),
            )),
            _ => Err(ConnectFailure::of(
                ConnectStage::Endpoints,
                ConnectFailureCause::NotOpcUa("its answer is not what was asked for".to_owned()),
            )),
        }
    }
}

impl ClientChannel {
    /// Runs a request to its answer while the connection is served.
    pub async fn drive<R>(
        &mut self,
        stage: ConnectStage,
        request: impl AsyncFnOnce(&AsyncSecureChannel) -> Result<R, Error>,
    ) -> Result<R, ConnectFailure> {
        let Self { secure, events, heard, stage: at } = self;
        *at.lock() = stage;
        let request = request(secure);
        tokio::pin!(request);
        let error = loop {
            tokio::select! {
                answer = &mut request => match answer {
                    Ok(answer) => return Ok(answer),
                    Err(error) => break error,
                },
                event = events.poll() => if let TransportPollResult::Closed(status) = event {
                    break Error::new(status, "closed");
                },
            }
        };
        Err(ConnectFailure::from_library(stage, &error, &heard.lock()))
    }

    /// Closes the session. A server that does not answer is disconnected.
    pub async fn close(mut self) {
        let goodbye = async {
            self.secure.close_channel().await;
            while !matches!(self.events.poll().await, TransportPollResult::Closed(_)) {}
        };
        let _late = tokio::time::timeout(CLOSE_LIMIT, goodbye).await;
    }
}

impl ReceiveLimits {
    fn decoding(self) -> DecodingOptions {
        DecodingOptions {
            max_message_size: MAX_BYTES,
            max_chunk_count: MAX_CHUNKS,
            max_string_length: MAX_FRAME,
            max_byte_string_length: self.byte_string,
            max_array_length: self.array,
            ..Default::default()
        }
    }
}

/// Nothing takes a request longer than the whole try has time.
pub(super) const REQUEST: Duration = Duration::from_secs(60);
const CLOSE_LIMIT: Duration = Duration::from_secs(1);
const MAX_CHUNKS: usize = 64;
const TOKEN_LIFETIME_MS: u32 = 60_000;
