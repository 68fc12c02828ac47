//! Messages in their frames: a header with the length, then JSON.
//!
//! What cannot be read is passed over: the next header line begins anew. Nothing that
//! a client sends makes the server allocate more than [`MOST_BYTES`].

use std::io::{self, BufRead, Read};

use lsp_server::Message;

/// Largest message, bytes.
const MOST_BYTES: u64 = 64 << 20;
/// Longest line of a header, bytes.
const LONGEST_LINE: u64 = 4 << 10;

/// What was read.
#[derive(Debug)]
pub(super) enum Frame {
    Message(Box<Message>),
    /// Something that is no message, and why.
    Malformed(String),
}

/// The next frame; `None` at the end of the input.
pub(super) fn read(input: &mut impl BufRead) -> io::Result<Option<Frame>> {
    let mut length = None;
    loop {
        let Some(line) = header_line(input)? else {
            return Ok(None);
        };
        match line.split_once(':') {
            _ if line.is_empty() => break,
            Some((name, value)) if name.eq_ignore_ascii_case("content-length") => length = value.trim().parse().ok(),
            Some(_) => {}
            None => return Ok(Some(Frame::Malformed(format!("no header: {line:?}")))),
        }
    }
    match length {
        Some(length) => body(input, length),
        None => Ok(Some(Frame::Malformed("a header without Content-Length".into()))),
    }
}

fn header_line(input: &mut impl BufRead) -> io::Result<Option<String>> {
    let mut line = Vec::new();
    if input.take(LONGEST_LINE).read_until(b'\n', &mut line)? == 0 {
        return Ok(None);
    }
    Ok(Some(String::from_utf8_lossy(&line).trim_end().to_owned()))
}

fn body(input: &mut impl BufRead, length: u64) -> io::Result<Option<Frame>> {
    if length > MOST_BYTES {
        io::copy(&mut input.take(length), &mut io::sink())?;
        return Ok(Some(Frame::Malformed(format!("a message of {length} bytes"))));
    }
    let mut bytes = Vec::new();
    if (input.take(length).read_to_end(&mut bytes)? as u64) < length {
        return Ok(None);
    }
    Ok(Some(match serde_json::from_slice(&bytes) {
        Ok(message) => Frame::Message(Box::new(message)),
        Err(error) => Frame::Malformed(error.to_string()),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(mut input: &[u8]) -> Vec<String> {
        let mut found = Vec::new();
        while let Some(frame) = read(&mut input).unwrap() {
            found.push(match frame {
                Frame::Message(message) => match *message {
                    Message::Notification(n) => n.method,
                    other => format!("{other:?}"),
                },
                Frame::Malformed(_) => "malformed".to_owned(),
            });
        }
        found
    }

    fn framed(body: &str) -> String {
        format!("Content-Length: {}\r\n\r\n{body}", body.len())
    }

    #[test]
    fn what_is_no_message_is_passed_over() {
        let good = framed("{\"jsonrpc\":\"2.0\",\"method\":\"exit\"}");
        assert_eq!(all(good.as_bytes()), ["exit"]);
        for bad in [
            framed("{"),
            framed("[]"),
            framed("{\"id\":1.5,\"result\":0}"),
            "garbage\r\n".into(),
            "X: y\r\n\r\n".into(),
        ] {
            assert_eq!(all(format!("{bad}{good}").as_bytes()), ["malformed", "exit"], "{bad}");
        }
    }

    #[test]
    fn a_length_that_lies_ends_cleanly() {
        assert_eq!(all(b"Content-Length: 99\r\n\r\n{}"), [""; 0]);
        assert_eq!(all(b"Content-Length: 18446744073709551615\r\n\r\n{}"), ["malformed"]);
        assert_eq!(all(&vec![b'x'; 10_000]), ["malformed"; 3]);
    }
}
