//! Data URIs: base64 (RFC 4648) and percent-encoded names (RFC 3986).

/// The bytes of a `data:…;base64,…` URI; `None` where it is none.
pub(super) fn data_uri(uri: &str) -> Option<Vec<u8>> {
    let (kind, payload) = uri.strip_prefix("data:")?.split_once(',')?;
    kind.ends_with(";base64").then(|| decode(payload)).flatten()
}

/// Bytes from base64, padded or not; `None` where a character is foreign.
pub(super) fn decode(text: &str) -> Option<Vec<u8>> {
    let digits = text.trim_end_matches('=').as_bytes();
    let mut bytes = Vec::with_capacity(digits.len() * 3 / 4);
    for group in digits.chunks(4) {
        let mut word = 0_u32;
        for &digit in group {
            word = word << 6 | value(digit)?;
        }
        word <<= 6 * (4 - group.len() as u32);
        let [_, a, b, c] = word.to_be_bytes();
        match group.len() {
            4 => bytes.extend([a, b, c]),
            3 => bytes.extend([a, b]),
            2 => bytes.push(a),
            _ => return None,
        }
    }
    Some(bytes)
}

/// A name with its `%20` and the like resolved; broken ones are kept as they are.
pub(super) fn percent_decoded(name: &str) -> String {
    let bytes = name.as_bytes();
    let (mut out, mut k) = (Vec::with_capacity(bytes.len()), 0);
    while k < bytes.len() {
        let escaped = (bytes[k] == b'%').then(|| name.get(k + 1..k + 3)).flatten();
        match escaped.and_then(|h| u8::from_str_radix(h, 16).ok()) {
            Some(byte) => {
                out.push(byte);
                k += 3;
            }
            None => {
                out.push(bytes[k]);
                k += 1;
            }
        }
    }
    String::from_utf8_lossy(&out).into_owned()
}

fn value(digit: u8) -> Option<u32> {
    let v = match digit {
        b'A'..=b'Z' => digit - b'A',
        b'a'..=b'z' => digit - b'a' + 26,
        b'0'..=b'9' => digit - b'0' + 52,
        b'+' | b'-' => 62,
        b'/' | b'_' => 63,
        _ => return None,
    };
    Some(u32::from(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vectors_of_rfc_4648_decode() {
        for (text, bytes) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg", "foob"),
            ("Zm9vYmFy", "foobar"),
        ] {
            assert_eq!(decode(text).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(decode("Zm9*"), None);
        assert_eq!(decode("Zm9vY"), None);
    }

    #[test]
    fn uris_give_their_payload_and_names_their_spaces() {
        assert_eq!(
            data_uri("data:application/octet-stream;base64,AAEC"),
            Some(vec![0, 1, 2])
        );
        assert_eq!(data_uri("body.bin"), None);
        assert_eq!(percent_decoded("a%20b%C3%A9%"), "a bé%");
    }
}
