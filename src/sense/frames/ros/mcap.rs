//! MCAP files with ROS messages, of ROS 2 (CDR) or ROS 1.

use std::path::Path;

use mcap::{McapError, MessageStream};

use super::super::error::FrameError;
use super::super::files;
use super::{MOST_BYTES, Message};

/// Hands every message to `take`, in the order of the file. Messages in other
/// encodings are passed over.
pub(super) fn read(path: &Path, take: &mut dyn FnMut(&Message) -> Result<(), FrameError>) -> Result<(), FrameError> {
    let bytes = files::bytes_up_to(path, MOST_BYTES)?;
    let broken = |error: McapError| FrameError::malformed(path, why(&error));
    for message in MessageStream::new(&bytes).map_err(broken)? {
        let message = message.map_err(broken)?;
        let cdr = match message.channel.message_encoding.as_str() {
            "cdr" => true,
            "ros1" => false,
            _ => continue,
        };
        let Some(schema) = &message.channel.schema else {
            continue;
        };
        take(&Message {
            topic: &message.channel.topic,
            kind: &schema.name.replace("/msg/", "/"),
            cdr,
            data: &message.data,
        })?;
    }
    Ok(())
}

fn why(error: &McapError) -> String {
    match error {
        McapError::UnsupportedCompression(name) => {
            format!("its chunks are compressed with {name}, which is not read; `mcap decompress` unpacks them")
        }
        McapError::BadMagic => "it does not begin and end as an MCAP file does".to_owned(),
        McapError::UnexpectedEof => "it ends within a record; was it cut off? `mcap recover` mends it".to_owned(),
        other => other.to_string().to_lowercase(),
    }
}
