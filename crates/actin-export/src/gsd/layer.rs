//! File layer of GSD, version 2.1: named arrays in frames.
//!
//! The file consists of a header of 256 bytes, the arrays, the list of names, and the index. An index entry holds
//! frame, shape, location, name and type of an array. Entries are sorted by frame and name. Numbers are
//! little-endian.
//!
//! # Source
//! GSD documentation, "File layer", version 2.x (glotzerlab/gsd).

use std::io::{self, Seek, SeekFrom, Write};

const MAGIC: u64 = 0x65DF_65DF_65DF_65DF;
const FILE_VERSION: (u16, u16) = (2, 1);
const HEADER_BYTES: usize = 256;
const ENTRY_BYTES: usize = 32;
/// The size of the list of names is a multiple of this.
const NAME_BYTES: usize = 64;

#[derive(Clone, Copy, Debug)]
pub(super) struct Header {
    /// Name of the writing program, at most 63 bytes.
    pub application: &'static str,
    /// Name of the schema, at most 63 bytes.
    pub schema: &'static str,
    /// Version of the schema.
    pub schema_version: (u16, u16),
}

#[derive(Clone, Debug)]
pub(super) enum Chunk {
    U8(Vec<u8>),
    I8(Vec<u8>),
    U32(Vec<u32>),
    U64(Vec<u64>),
    I64(Vec<i64>),
    F32(Vec<f32>),
    F64(Vec<f64>),
}

impl Chunk {
    fn code(&self) -> u8 {
        match self {
            Self::U8(_) => 1,
            Self::U32(_) => 3,
            Self::U64(_) => 4,
            Self::I8(_) => 5,
            Self::I64(_) => 8,
            Self::F32(_) => 9,
            Self::F64(_) => 10,
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::U8(values) | Self::I8(values) => values.len(),
            Self::U32(values) => values.len(),
            Self::U64(values) => values.len(),
            Self::I64(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::F64(values) => values.len(),
        }
    }

    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::U8(values) | Self::I8(values) => values.clone(),
            Self::U32(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::U64(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::I64(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::F32(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::F64(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    frame: u64,
    rows: u64,
    location: u64,
    columns: u32,
    name: u16,
    code: u8,
}

impl Entry {
    fn bytes(&self) -> [u8; ENTRY_BYTES] {
        let mut bytes = [0; ENTRY_BYTES];
        bytes[..8].copy_from_slice(&self.frame.to_le_bytes());
        bytes[8..16].copy_from_slice(&self.rows.to_le_bytes());
        bytes[16..24].copy_from_slice(&self.location.to_le_bytes());
        bytes[24..28].copy_from_slice(&self.columns.to_le_bytes());
        bytes[28..30].copy_from_slice(&self.name.to_le_bytes());
        bytes[30] = self.code;
        bytes
    }
}

#[derive(Debug)]
pub(super) struct Writer<W> {
    out: W,
    location: u64,
    frame: u64,
    names: Vec<String>,
    index: Vec<Entry>,
}

impl<W: Write + Seek> Writer<W> {
    /// Writes a preliminary header at the start of `out`.
    ///
    /// # Errors
    /// If `out` returns an error.
    pub(super) fn new(mut out: W, header: &Header) -> io::Result<Self> {
        // The offsets are filled in by `finish`.
        out.write_all(&header_bytes(header, [0; 4]))?;
        Ok(Self {
            out,
            location: HEADER_BYTES as u64,
            frame: 0,
            names: Vec::new(),
            index: Vec::new(),
        })
    }

    /// Writes an array with a number of `columns` to the current frame.
    ///
    /// # Errors
    /// If `out` returns an error.
    ///
    /// # Panics
    /// If the length is no multiple of `columns`, or there are 2^16 names or 2^32 columns.
    pub(super) fn write(&mut self, name: &str, chunk: &Chunk, columns: usize) -> io::Result<()> {
        assert!(
            chunk.len().is_multiple_of(columns),
            "{name}: the length must be a multiple of the number of columns"
        );
        let bytes = chunk.bytes();
        self.out.write_all(&bytes)?;
        let entry = Entry {
            frame: self.frame,
            rows: (chunk.len() / columns) as u64,
            location: self.location,
            columns: u32::try_from(columns).expect("fewer than 2^32 columns"),
            name: self.number(name),
            code: chunk.code(),
        };
        self.index.push(entry);
        self.location += bytes.len() as u64;
        Ok(())
    }

    fn number(&mut self, name: &str) -> u16 {
        let known = self.names.iter().position(|known| known == name);
        let number = known.unwrap_or_else(|| {
            self.names.push(name.to_owned());
            self.names.len() - 1
        });
        u16::try_from(number).expect("fewer than 2^16 names")
    }

    pub(super) fn end_frame(&mut self) {
        self.frame += 1;
    }

    /// Writes the list of names, the index and the header.
    ///
    /// # Errors
    /// If `out` returns an error.
    pub(super) fn finish(mut self, header: &Header) -> io::Result<()> {
        let mut names: Vec<u8> = Vec::new();
        for name in &self.names {
            names.extend(name.as_bytes());
            names.push(0);
        }
        // The list ends with an empty name.
        names.resize((names.len() + 1).next_multiple_of(NAME_BYTES), 0);
        self.out.write_all(&names)?;
        self.index.sort_by_key(|entry| (entry.frame, entry.name));
        for entry in &self.index {
            self.out.write_all(&entry.bytes())?;
        }
        // The index ends with an empty entry.
        self.out.write_all(&[0; ENTRY_BYTES])?;
        let places = [
            self.location + names.len() as u64,
            self.index.len() as u64 + 1,
            self.location,
            (names.len() / NAME_BYTES) as u64,
        ];
        self.out.seek(SeekFrom::Start(0))?;
        self.out.write_all(&header_bytes(header, places))?;
        self.out.seek(SeekFrom::End(0))?;
        self.out.flush()
    }
}

/// Returns the header: magic number, offset and number of index entries, offset and size of the list of names,
/// versions, program and schema.
fn header_bytes(header: &Header, places: [u64; 4]) -> [u8; HEADER_BYTES] {
    let version = |(major, minor): (u16, u16)| (u32::from(major) << 16) | u32::from(minor);
    let mut bytes = [0; HEADER_BYTES];
    bytes[..8].copy_from_slice(&MAGIC.to_le_bytes());
    for (place, at) in places.into_iter().zip([8, 16, 24, 32]) {
        bytes[at..at + 8].copy_from_slice(&place.to_le_bytes());
    }
    bytes[40..44].copy_from_slice(&version(header.schema_version).to_le_bytes());
    bytes[44..48].copy_from_slice(&version(FILE_VERSION).to_le_bytes());
    // Texts are null-terminated.
    for (text, at) in [(header.application, 48), (header.schema, 112)] {
        let length = text.len().min(NAME_BYTES - 1);
        bytes[at..at + length].copy_from_slice(&text.as_bytes()[..length]);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    const HEADER: Header = Header {
        application: "test 1",
        schema: "own",
        schema_version: (1, 4),
    };

    fn u64_at(bytes: &[u8], at: usize) -> u64 {
        u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
    }

    #[test]
    fn header_names_and_index_are_where_the_specification_has_them() {
        let mut out = Cursor::new(Vec::new());
        let mut writer = Writer::new(&mut out, &HEADER).unwrap();
        writer
            .write("b", &Chunk::F32(vec![1.0, 2.0, 3.0, 4.0]), 2)
            .unwrap();
        writer.end_frame();
        // Written before a name of lower index.
        writer.write("a", &Chunk::U8(vec![7]), 1).unwrap();
        writer.write("b", &Chunk::F32(vec![5.0, 6.0]), 2).unwrap();
        writer.end_frame();
        writer.finish(&HEADER).unwrap();
        let bytes = out.into_inner();
        assert_eq!(u64_at(&bytes, 0), 0x65DF_65DF_65DF_65DF);
        assert_eq!(bytes[40..48], [4, 0, 1, 0, 1, 0, 2, 0]);
        assert_eq!(&bytes[48..55], b"test 1\0");
        assert_eq!(&bytes[112..116], b"own\0");
        // The arrays have 16, 1 and 8 bytes.
        let (index, names) = (u64_at(&bytes, 8), u64_at(&bytes, 24));
        assert_eq!(names, 256 + 25);
        assert_eq!(&bytes[281..286], b"b\0a\0\0");
        assert_eq!((u64_at(&bytes, 32), index), (1, names + 64));
        assert_eq!(u64_at(&bytes, 16), 4);
        let entries: Vec<_> = (0..4).map(|i| &bytes[345 + 32 * i..377 + 32 * i]).collect();
        assert_eq!(bytes.len(), 345 + 4 * 32);
        // Frame, rows, location; columns, name, type.
        let shape = |e: &[u8]| [u64_at(e, 0), u64_at(e, 8), u64_at(e, 16)];
        assert_eq!(shape(entries[0]), [0, 2, 256]);
        assert_eq!(entries[0][24..], [2, 0, 0, 0, 0, 0, 9, 0]);
        assert_eq!(shape(entries[1]), [1, 1, 273]);
        assert_eq!(shape(entries[2]), [1, 1, 272]);
        assert_eq!(entries[2][24..], [1, 0, 0, 0, 1, 0, 1, 0]);
        assert_eq!(entries[3], [0; 32]);
        assert_eq!(bytes[272], 7);
        assert_eq!(bytes[273..277], 5.0_f32.to_le_bytes());
    }
}
