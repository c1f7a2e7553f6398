mod hostile;
mod round_trips;
mod worked_frames;

use super::*;

/// Bytes from hexadecimal digits with blanks.
fn bytes(digits: &str) -> Vec<u8> {
    hex::decode(digits.replace(' ', "")).unwrap()
}

/// Everything that a controller makes of these bytes, which come in these pieces; then the line is silent.
fn received<'a>(pieces: impl IntoIterator<Item = &'a [u8]>) -> Vec<frame::RequestEvent> {
    let mut decoder = frame::RequestDecoder::default();
    let mut events = Vec::new();
    for piece in pieces {
        decoder.add(piece);
        events.extend(std::iter::from_fn(|| decoder.next(false)));
    }
    events.extend(std::iter::from_fn(|| decoder.next(true)));
    assert!(!decoder.is_waiting());
    events
}

/// What a client makes of these bytes, which come in these pieces; then the line is silent.
fn answer<'a>(request: &Request, pieces: impl IntoIterator<Item = &'a [u8]>) -> Option<Result<Answer, DecodeError>> {
    let mut decoder = frame::AnswerDecoder::new(request);
    for piece in pieces {
        decoder.add(piece);
        if let Some(answer) = decoder.next(false) {
            return Some(answer);
        }
    }
    decoder.next(true)
}

/// What a controller makes of a line.
fn line(text: &[u8]) -> Option<text::TextRequest> {
    let mut decoder = text::RequestDecoder::default();
    decoder.add(text);
    decoder.next_line()
}

/// What a client makes of a line.
fn answer_line(request: &Request, text: &[u8]) -> Option<Result<Answer, DecodeError>> {
    let mut decoder = text::AnswerDecoder::new(request);
    decoder.add(text);
    decoder.next_line()
}

fn read(name: &str, kind: crate::model::SpelType) -> VariableRead {
    VariableRead::scalar(name.parse().unwrap(), kind)
}

fn elements(name: &str, kind: crate::model::SpelType, first: &[u16], count: u16) -> VariableRead {
    let range = ElementRange::new(Element::new(first).unwrap(), count).unwrap();
    VariableRead::elements(name.parse().unwrap(), kind, range).unwrap()
}

fn write(name: &str, kind: crate::model::SpelType, value: crate::model::SpelValue) -> VariableWrite {
    VariableWrite::new(name.parse().unwrap(), kind, value).unwrap()
}
