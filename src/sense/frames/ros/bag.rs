//! ROS 1 bags, version 2.0.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use rosbag::{ChunkRecord, IndexRecord, MessageRecord, RosBag};

use super::super::error::FrameError;
use super::{MOST_BYTES, Message};

const MAGIC: &[u8] = b"#ROSBAG V2.0\n";
/// The first record is padded to this size.
const HEADER: u64 = 4096;

/// Hands every message to `take`, in the order of the file.
pub(super) fn read(path: &Path, take: &mut dyn FnMut(&Message) -> Result<(), FrameError>) -> Result<(), FrameError> {
    let length = check(path)?;
    let broken = |error: rosbag::Error| {
        let text = error.to_string().to_lowercase();
        FrameError::malformed(path, text.trim_start_matches("rosbag::error: "))
    };
    let bag = RosBag::new(path).map_err(|e| FrameError::malformed(path, e.to_string().to_lowercase()))?;
    let mut connections: HashMap<u32, (String, String)> = HashMap::new();
    for record in bag.index_records() {
        if let IndexRecord::Connection(c) = record.map_err(broken)? {
            connections.insert(c.id, (c.storage_topic.to_owned(), c.tp.to_owned()));
        }
    }
    let mut unpacked = 0;
    for record in bag.chunk_records() {
        let ChunkRecord::Chunk(chunk) = record.map_err(broken)? else {
            continue;
        };
        for message in chunk.messages() {
            let MessageRecord::MessageData(message) = message.map_err(broken)? else {
                continue;
            };
            unpacked += message.data.len() as u64;
            if unpacked > MOST_BYTES.max(length) {
                return Err(too_large(path));
            }
            if let Some((topic, kind)) = connections.get(&message.conn_id) {
                let (data, cdr) = (message.data, false);
                take(&Message { topic, kind, cdr, data })?;
            }
        }
    }
    Ok(())
}

/// Refuses what the reader would stumble over: another version, a bag that was
/// cut off or never closed. Returns the length.
fn check(path: &Path) -> Result<u64, FrameError> {
    let failed = |error: std::io::Error| FrameError::unreadable(path, &error);
    let mut file = File::open(path).map_err(failed)?;
    let length = file.metadata().map_err(failed)?.len();
    if length > MOST_BYTES {
        return Err(too_large(path));
    }
    let mut head = Vec::new();
    file.by_ref().take(HEADER).read_to_end(&mut head).map_err(failed)?;
    let wrong = |what: String| FrameError::malformed(path, what);
    if !head.starts_with(MAGIC) {
        return Err(wrong("it does not begin as a ROS bag of version 2.0 does".to_owned()));
    }
    let index = index_of(&head).ok_or_else(|| wrong("its header record is broken".to_owned()))?;
    if index == 0 {
        return Err(wrong(
            "it has no index, as of a recording that was cut off; `rosbag reindex` makes one".to_owned(),
        ));
    }
    if index < MAGIC.len() as u64 || index > length {
        return Err(wrong(format!(
            "its index lies at byte {index}, and it ends at byte {length}: it is cut off"
        )));
    }
    Ok(length)
}

/// Where the index begins, by the field `index_pos` of the header record.
fn index_of(head: &[u8]) -> Option<u64> {
    let name = b"index_pos=";
    let at = head.windows(name.len()).position(|w| w == name)? + name.len();
    let fields = MAGIC.len() + 4;
    // The fields end before the data does, which must not reach past the index.
    let header = u32::from_le_bytes(head.get(MAGIC.len()..fields)?.try_into().ok()?) as usize;
    let end = fields.checked_add(header)?;
    let data = u32::from_le_bytes(head.get(end..end + 4)?.try_into().ok()?) as u64;
    let index = u64::from_le_bytes(head.get(at..at + 8)?.try_into().ok()?);
    (index == 0 || end as u64 + 4 + data <= index).then_some(index)
}

fn too_large(path: &Path) -> FrameError {
    FrameError::TooLarge {
        path: path.to_owned(),
        what: format!(
            "more than {} GiB; cut out the part that is needed, as with `rosbag filter`",
            MOST_BYTES >> 30
        ),
    }
}
