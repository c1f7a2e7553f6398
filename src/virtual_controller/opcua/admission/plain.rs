use opcua::types::{
    ActivateSessionRequest, BinaryDecodable, BinaryEncodable, ContextOwned, CreateSessionRequest, DecodingOptions,
    ExtensionObject, NamespaceMap, NodeId, ObjectId, StatusCode, UAString, UserNameIdentityToken,
};

use super::fault::Fault;
use super::frame::{Header, SYMMETRIC_HEADER};

/// Where a request's service stands in the first chunk of a message without security, in its longest form.
pub(super) const SERVICE_AT_MOST: usize = SYMMETRIC_HEADER + 7;

/// The service a message without security asks for. `bytes` begin with its first chunk, at least [`SERVICE_AT_MOST`] of
/// it or all.
pub(super) fn service(header: Header, bytes: &[u8]) -> Result<ObjectId, Fault> {
    let end = header.size.min(bytes.len());
    let mut body = bytes.get(SYMMETRIC_HEADER..end).unwrap_or_default();
    let contexts = contexts();
    NodeId::decode(&mut body, &contexts.context())
        .ok()
        .and_then(|id| id.as_object_id().ok())
        .ok_or_else(|| Fault::new(StatusCode::BadServiceUnsupported, "not a service"))
}

/// A request that is not let through as it is: the server, which would grant it, is made to refuse it. So the client
/// gets a proper answer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Objection {
    pub(super) reason: &'static str,
    /// What takes the place of a whole chunk; `None` if there is nothing to object to.
    pub(super) spoil: fn(Header, &[u8]) -> Spoilt,
}

type Spoilt = Result<Option<Vec<u8>>, Fault>;

/// A password that travelled in clear: the server would check it although it asked for an encrypted one. It is taken
/// out of ActivateSession, and what is left is a token that was not offered.
pub(super) const CLEAR_PASSWORD: Objection =
    Objection { reason: "a login whose password was not encrypted", spoil: without_clear_password };

/// A session without security where that is not offered: the server would create it, to refuse its activation, and has
/// room for few. CreateSession is left without the endpoint.
pub(super) const NO_ENDPOINT: Objection =
    Objection { reason: "a session without security, which is not offered", spoil: without_endpoint };

fn without_clear_password(header: Header, chunk: &[u8]) -> Spoilt {
    edit(header, chunk, |request: &mut ActivateSessionRequest| {
        let token = request.user_identity_token.inner_as::<UserNameIdentityToken>();
        let is_clear = token.is_some_and(|token| token.encryption_algorithm.is_empty());
        if is_clear {
            request.user_identity_token = ExtensionObject::from_message(UserNameIdentityToken::default());
        }
        is_clear
    })
}

fn without_endpoint(header: Header, chunk: &[u8]) -> Spoilt {
    edit(header, chunk, |request: &mut CreateSessionRequest| {
        request.endpoint_url = UAString::null();
        true
    })
}

/// The chunk with another request in it, if `change` has changed that.
fn edit<T: BinaryDecodable + BinaryEncodable>(
    header: Header,
    chunk: &[u8],
    change: impl FnOnce(&mut T) -> bool,
) -> Spoilt {
    if header.last != b'F' {
        return Err(Fault::new(StatusCode::BadTcpMessageTooLarge, "a session asked for in more than one chunk"));
    }
    let undecodable = |_| Fault::new(StatusCode::BadDecodingError, "the request cannot be read");
    let contexts = contexts();
    let context = contexts.context();
    let mut body = chunk.get(SYMMETRIC_HEADER..).unwrap_or_default();
    let service = NodeId::decode(&mut body, &context).map_err(undecodable)?;
    let mut request = T::decode(&mut body, &context).map_err(undecodable)?;
    if !change(&mut request) {
        return Ok(None);
    }
    let mut edited = chunk[..SYMMETRIC_HEADER].to_vec();
    service.encode(&mut edited, &context).map_err(undecodable)?;
    request.encode(&mut edited, &context).map_err(undecodable)?;
    let size = edited.len() as u32;
    edited[4..8].copy_from_slice(&size.to_le_bytes());
    Ok(Some(edited))
}

fn contexts() -> ContextOwned {
    ContextOwned::new_default(NamespaceMap::new(), DecodingOptions::default())
}

#[cfg(test)]
mod tests {
    use opcua::types::{AnonymousIdentityToken, ByteString};

    use super::*;

    fn chunk(service: ObjectId, body: &[u8]) -> Vec<u8> {
        let contexts = contexts();
        let mut chunk = b"MSGF".to_vec();
        chunk.extend([0; SYMMETRIC_HEADER - 4]);
        NodeId::from(service).encode(&mut chunk, &contexts.context()).unwrap();
        chunk.extend(body);
        let size = chunk.len() as u32;
        chunk[4..8].copy_from_slice(&size.to_le_bytes());
        chunk
    }

    fn login(token: ExtensionObject) -> Vec<u8> {
        let contexts = contexts();
        let mut body = Vec::new();
        let request = ActivateSessionRequest { user_identity_token: token, ..Default::default() };
        request.encode(&mut body, &contexts.context()).unwrap();
        chunk(ObjectId::ActivateSessionRequest_Encoding_DefaultBinary, &body)
    }

    fn header(chunk: &[u8]) -> Header {
        Header::parse(chunk, 65_535).unwrap().unwrap()
    }

    fn password(algorithm: &str) -> ExtensionObject {
        ExtensionObject::from_message(UserNameIdentityToken {
            policy_id: "userpass_rsa_oaep".into(),
            user_name: "operator1".into(),
            password: ByteString::from(b"Passw0rd"),
            encryption_algorithm: algorithm.into(),
        })
    }

    #[test]
    fn a_service_is_known_by_its_number_however_that_is_written() {
        let short = chunk(ObjectId::GetEndpointsRequest_Encoding_DefaultBinary, b"");
        let read = service(header(&short), &short).unwrap();
        assert_eq!(read, ObjectId::GetEndpointsRequest_Encoding_DefaultBinary);
        // The long form of the same node id.
        let mut long = chunk(ObjectId::RootFolder, b"");
        long.truncate(SYMMETRIC_HEADER);
        long.extend([2, 0, 0]);
        long.extend(467_u32.to_le_bytes());
        long[4] = long.len() as u8;
        let read = service(header(&long), &long).unwrap();
        assert_eq!(read, ObjectId::ActivateSessionRequest_Encoding_DefaultBinary);
        for no_service in [&[][..], &[1], &[0xff, 0, 0, 0, 0, 0, 0]] {
            let mut chunk = chunk(ObjectId::RootFolder, b"");
            chunk.truncate(SYMMETRIC_HEADER);
            chunk.extend(no_service);
            chunk[4] = chunk.len() as u8;
            assert_eq!(service(header(&chunk), &chunk).unwrap_err().status, StatusCode::BadServiceUnsupported);
        }
    }

    #[test]
    fn a_clear_password_does_not_get_through_and_everything_else_does() {
        let clear = login(password(""));
        let rewritten = without_clear_password(header(&clear), &clear).unwrap().unwrap();
        assert_eq!(header(&rewritten).size, rewritten.len());
        assert!(!rewritten.windows(8).any(|w| w == b"Passw0rd"));
        let contexts = contexts();
        let mut body = &rewritten[SYMMETRIC_HEADER + 4..];
        let request = ActivateSessionRequest::decode(&mut body, &contexts.context()).unwrap();
        let token = request.user_identity_token.inner_as::<UserNameIdentityToken>().unwrap();
        assert!(token.policy_id.is_empty() && body.is_empty());

        let anonymous = ExtensionObject::from_message(AnonymousIdentityToken { policy_id: "anonymous".into() });
        for fine in [password("http://www.w3.org/2001/04/xmlenc#rsa-oaep"), anonymous, ExtensionObject::null()] {
            let fine = login(fine);
            assert_eq!(without_clear_password(header(&fine), &fine), Ok(None));
        }
        let mut pieces = clear.clone();
        pieces[3] = b'C';
        assert!(without_clear_password(header(&pieces), &pieces).is_err());
        let create = CreateSessionRequest { endpoint_url: "opc.tcp://robot".into(), ..Default::default() };
        let mut body = Vec::new();
        create.encode(&mut body, &contexts.context()).unwrap();
        let create = chunk(ObjectId::CreateSessionRequest_Encoding_DefaultBinary, &body);
        let spoilt = without_endpoint(header(&create), &create).unwrap().unwrap();
        let mut body = &spoilt[SYMMETRIC_HEADER + 4..];
        assert!(CreateSessionRequest::decode(&mut body, &contexts.context()).unwrap().endpoint_url.is_null());
        let cut = &clear[..40];
        assert!(without_clear_password(header(&clear), cut).is_err());
    }
}
