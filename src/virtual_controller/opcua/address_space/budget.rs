use std::time::Duration;

use opcua::server::node_manager::RequestContext;
use opcua::types::StatusCode;

/// The longest message that the client of a secure channel takes, by the channel's number; `None` without a limit.
pub(in super::super) type LongestResponse = dyn Fn(u32) -> Option<usize> + Send + Sync;

/// How many bytes of packets the response to a read of `items` values may have, so that it fits what the client takes, by
/// its Hello and by MaxResponseMessageSize of its session (OPC 10000-4 §5.7.2), and the server's own limits.
pub(super) fn of_response(
    context: &RequestContext,
    longest: &LongestResponse,
    items: usize,
) -> Result<usize, StatusCode> {
    let session = context.session().try_read_for(STEP_LIMIT).ok_or(StatusCode::BadTooManyOperations)?;
    let limits = &context.info.config.limits;
    let of_session = match session.max_response_message_size() {
        0 => usize::MAX,
        size => usize::try_from(size).unwrap_or(usize::MAX),
    };
    let of_channel = longest(session.secure_channel_id()).unwrap_or(usize::MAX);
    let message = of_session.min(of_channel).min(limits.max_message_size);
    Ok(message.saturating_sub(HEAD + items.saturating_mul(ITEM)).min(limits.max_byte_string_length))
}

/// As long as the server may hold the session.
const STEP_LIMIT: Duration = Duration::from_secs(1);
/// More than a response's headers.
const HEAD: usize = 512;
/// More than one value that is no packet.
const ITEM: usize = 64;
