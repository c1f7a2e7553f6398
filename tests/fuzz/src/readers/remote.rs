use opcua_configurator::remote::frame::{self, RequestEvent};
use opcua_configurator::remote::text::{self, Terminator};
use opcua_configurator::remote::{Answer, Command, DecodeError, Request};

/// Both request decoders, with the bytes in pieces of the size that the first byte says: a request that is read is
/// written and read again as the same one; an error lies inside the bytes or at their end.
pub fn remote_request(bytes: &[u8]) {
    let Some((size, bytes)) = bytes.split_first() else { return };
    let size = usize::from(*size).max(1);
    let mut frames = frame::RequestDecoder::default();
    let mut lines = text::RequestDecoder::default();
    let mut events = Vec::new();
    for piece in bytes.chunks(size) {
        frames.add(piece);
        events.extend(std::iter::from_fn(|| frames.next(false)));
        lines.add(piece);
        while let Some(line) = lines.next_line() {
            assert!(line.spelling.to_string().chars().all(|character| character.is_ascii_graphic()));
            match line.request {
                Ok(request) => assert_text_round_trip(&request),
                Err(error) => assert_inside(error, bytes),
            }
        }
    }
    events.extend(std::iter::from_fn(|| frames.next(true)));
    assert!(!frames.is_waiting());
    for event in events {
        match event {
            RequestEvent::Open => {}
            RequestEvent::Request(request) => {
                let Ok(written) = frame::encode_request(&request) else { continue };
                let mut decoder = frame::RequestDecoder::default();
                decoder.add(&written);
                let again = decoder.next(false).or_else(|| decoder.next(true));
                // A number that is no number differs from itself.
                assert_eq!(format!("{again:?}"), format!("{:?}", Some(RequestEvent::Request(request))));
            }
            RequestEvent::Bad { error, .. } => assert_inside(error, bytes),
        }
    }
}

fn assert_text_round_trip(request: &Request) {
    // A text that was Shift-JIS may be too long as UTF-8.
    let Ok(line) = text::encode_request(request, Terminator::CrLf) else { return };
    let mut decoder = text::RequestDecoder::default();
    decoder.add(&line);
    let again = decoder.next_line().expect("a line").request;
    assert_eq!(format!("{again:?}"), format!("{:?}", Ok::<_, DecodeError>(request)));
}

/// Both answer decoders, as the answer to the command that the first byte counts: what is read is written and read again
/// as the same answer.
pub fn remote_answer(bytes: &[u8]) {
    let Some((number, bytes)) = bytes.split_first() else { return };
    let Some(request) = sample(usize::from(*number)) else { return };
    let mut frames = frame::AnswerDecoder::new(&request);
    let mut lines = text::AnswerDecoder::new(&request);
    for piece in bytes.chunks(7) {
        frames.add(piece);
        if let Some(answer) = frames.next(false) {
            assert_frame_round_trip(&request, answer, bytes);
        }
        lines.add(piece);
        while let Some(answer) = lines.next_line() {
            match answer {
                Ok(Answer::Good(reply)) => {
                    let spelling = request.command().into();
                    let Ok(line) = text::encode_reply(&spelling, &request, &reply, Terminator::Lf) else { continue };
                    let mut decoder = text::AnswerDecoder::new(&request);
                    decoder.add(&line);
                    let again = decoder.next_line().expect("a line").expect("an answer");
                    assert_eq!(format!("{again:?}"), format!("{:?}", Answer::Good(reply)));
                }
                Ok(Answer::Refused(code)) => assert!(code.number() <= 99),
                Err(error) => assert_inside(error, bytes),
            }
        }
    }
    while let Some(answer) = frames.next(true) {
        assert_frame_round_trip(&request, answer, bytes);
    }
    assert!(!frames.is_waiting());
}

fn assert_frame_round_trip(request: &Request, answer: Result<Answer, DecodeError>, bytes: &[u8]) {
    match answer {
        Ok(Answer::Good(reply)) => {
            let Ok(written) = frame::encode_reply(request.command(), &reply) else { return };
            let mut decoder = frame::AnswerDecoder::new(request);
            decoder.add(&written);
            let again = decoder.next(false).expect("all of it came").expect("an answer");
            assert_eq!(format!("{again:?}"), format!("{:?}", Answer::Good(reply)));
        }
        Ok(Answer::Refused(code)) => assert!(code.number() <= 99),
        Err(error) => assert_inside(error, bytes),
    }
}

fn assert_inside(error: DecodeError, bytes: &[u8]) {
    assert!(error.offset <= bytes.len(), "{error} of {} bytes", bytes.len());
}

/// A request of every command, as its text form is read; of GetVariable every kind.
fn sample(number: usize) -> Option<Request> {
    const VARIABLES: [&str; 4] = ["g_a,Integer", "g_s$,String", "g_d(1,2,3),Double,3", "g_b(0),Boolean,100"];
    let lines = Command::ALL.iter().filter(|command| **command != Command::GetVariable).map(|command| {
        let parameters = ["", ",1", ",1,1", ",1,1,1", ",\"Print 1\"", ",g_a,1,Byte"];
        parameters.map(|parameters| format!("${command}{parameters}\n"))
    });
    let variables = VARIABLES.map(|variable| [format!("$GetVariable,{variable}\n")].to_vec());
    let requests = lines.map(Vec::from).chain(variables).filter_map(|lines| {
        lines.iter().find_map(|line| {
            let mut decoder = text::RequestDecoder::default();
            decoder.add(line.as_bytes());
            decoder.next_line()?.request.ok()
        })
    });
    let requests: Vec<Request> = requests.collect();
    requests.get(number % requests.len()).cloned()
}
