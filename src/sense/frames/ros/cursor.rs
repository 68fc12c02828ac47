//! Fields of a serialised message, of ROS 1 or in CDR (ROS 2).
//!
//! ROS 1 packs fields, little-endian, strings as length and bytes. CDR begins
//! with four bytes that name the byte order, aligns every number to its size
//! from there on, and counts a string's closing zero.

/// A message ends before its fields do.
#[derive(Debug)]
pub(super) struct Ended;

pub(super) struct Cursor<'a> {
    data: &'a [u8],
    at: usize,
    cdr: bool,
    big: bool,
}

type Result<T> = std::result::Result<T, Ended>;

impl<'a> Cursor<'a> {
    pub fn new(data: &'a [u8], cdr: bool) -> Result<Self> {
        let (big, data) = match (cdr, data) {
            (false, data) => (false, data),
            (true, [0, order, _, _, rest @ ..]) => (*order & 1 == 0, rest),
            _ => return Err(Ended),
        };
        Ok(Self { data, at: 0, cdr, big })
    }

    /// The next `n` bytes.
    pub fn bytes(&mut self, n: usize) -> Result<&'a [u8]> {
        let end = self.at.checked_add(n).ok_or(Ended)?;
        let bytes = self.data.get(self.at..end).ok_or(Ended)?;
        self.at = end;
        Ok(bytes)
    }

    fn number<const N: usize>(&mut self) -> Result<[u8; N]> {
        if self.cdr {
            self.at = self.at.next_multiple_of(N);
        }
        let mut bytes: [u8; N] = self.bytes(N)?.try_into().map_err(|_| Ended)?;
        if self.big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    pub fn u8(&mut self) -> Result<u8> {
        Ok(self.number::<1>()?[0])
    }

    pub fn u32(&mut self) -> Result<u32> {
        self.number().map(u32::from_le_bytes)
    }

    pub fn f64(&mut self) -> Result<f64> {
        self.number().map(f64::from_le_bytes)
    }

    /// A string; what is no UTF-8 is replaced.
    pub fn string(&mut self) -> Result<String> {
        let length = self.u32()? as usize;
        let bytes = self.bytes(length)?;
        let bytes = match bytes {
            [text @ .., 0] if self.cdr => text,
            all => all,
        };
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }

    /// A list of bytes.
    pub fn blob(&mut self) -> Result<&'a [u8]> {
        let length = self.u32()? as usize;
        self.bytes(length)
    }

    /// A list of numbers.
    pub fn f64s(&mut self) -> Result<Vec<f64>> {
        let count = self.u32()? as usize;
        if count > self.data.len() / 8 + 1 {
            return Err(Ended);
        }
        (0..count).map(|_| self.f64()).collect()
    }

    /// Whether fields come before the time stamp of a header.
    pub fn counts_headers(&self) -> bool {
        !self.cdr
    }
}
