//! Where the bytes of a log come from: as they are, or unpacked.

use std::io::{self, BufRead, BufReader, Chain, Cursor, Read};

use flate2::bufread::MultiGzDecoder;

/// What a gzip file begins with.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// A reader whose first bytes have been looked at.
type Whole<R> = Chain<Cursor<Vec<u8>>, R>;

/// The bytes of a log, unpacked if they begin as gzip does.
#[derive(Debug)]
pub(super) enum Source<R> {
    Plain(Whole<R>),
    Gzip(BufReader<MultiGzDecoder<Whole<R>>>),
}

impl<R: BufRead> Source<R> {
    /// Looks at the first bytes.
    pub(super) fn new(mut reader: R) -> io::Result<Self> {
        let mut start = Vec::new();
        (&mut reader)
            .take(GZIP.len() as u64)
            .read_to_end(&mut start)?;
        let is_gzip = start == GZIP;
        let whole = Cursor::new(start).chain(reader);
        Ok(if is_gzip {
            Self::Gzip(BufReader::new(MultiGzDecoder::new(whole)))
        } else {
            Self::Plain(whole)
        })
    }

    /// What is wrong with the packing and what to do, if that is why reading failed.
    pub(super) fn damage(&self, error: &io::Error) -> Option<(String, &'static str)> {
        if matches!(self, Self::Plain(_)) {
            return None;
        }
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Some((
                "breaks off, as the gzip file ends in the middle".to_owned(),
                "copy the file again, or keep what is before it with --keep-complete",
            )),
            io::ErrorKind::InvalidInput | io::ErrorKind::InvalidData => Some((
                format!("cannot be unpacked, as the gzip file is damaged there ({error})"),
                "copy or pack the file again, or keep what is before it with --keep-complete",
            )),
            _ => None,
        }
    }

    fn inner(&mut self) -> &mut dyn BufRead {
        match self {
            Self::Plain(reader) => reader,
            Self::Gzip(reader) => reader,
        }
    }
}

impl<R: BufRead> Read for Source<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.inner().read(buffer)
    }
}

impl<R: BufRead> BufRead for Source<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.inner().fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.inner().consume(amount);
    }
}
