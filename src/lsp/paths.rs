//! Between the addresses of documents and the paths of files.

use gen_lsp_types::Uri;

/// The path of a document, its folders separated by `/`. What is no file keeps its
/// address, which no file is called.
pub(super) fn path(uri: &Uri) -> String {
    let Some(rest) = uri.0.strip_prefix("file://") else {
        return uri.0.clone();
    };
    let local = rest.find('/').map_or(rest, |at| &rest[at..]);
    let decoded = decoded(local);
    let drive = decoded.as_bytes();
    match drive {
        [b'/', letter, b':', ..] if letter.is_ascii_alphabetic() => decoded[1..].to_owned(),
        _ => decoded,
    }
}

/// The address of a file.
pub(super) fn uri(path: &str) -> Uri {
    if path.contains("://") || path.starts_with("untitled:") {
        return Uri(path.to_owned());
    }
    let mut out = String::from("file://");
    if !path.starts_with('/') {
        out.push('/');
    }
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'_' | b'.' | b'~' | b':' => {
                out.push(char::from(byte));
            }
            _ => out.push_str(&format!("%{byte:02X}")),
        }
    }
    Uri(out)
}

/// Percent signs undone; what is no text then stays as it was.
fn decoded(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let code = (bytes[at] == b'%').then(|| text.get(at + 1..at + 3)).flatten();
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                out.push(byte);
                at += 3;
            }
            None => {
                out.push(bytes[at]);
                at += 1;
            }
        }
    }
    String::from_utf8(out).unwrap_or_else(|_| text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_and_paths_are_each_others_inverse() {
        for path_ in ["/a/b c.vpl", "/ä/100%.vpl", "C:/x/y.vpl", "/a/#1?.vpl"] {
            assert_eq!(path(&uri(path_)), path_);
        }
        assert_eq!(path(&Uri("file://host/a.vpl".into())), "/a.vpl");
        assert_eq!(path(&Uri("file:///c%3A/a.vpl".into())), "c:/a.vpl");
        assert_eq!(path(&Uri("untitled:Untitled-1".into())), "untitled:Untitled-1");
        assert_eq!(path(&Uri("file:///%zz%f".into())), "/%zz%f");
    }
}
