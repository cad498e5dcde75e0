//! `records.bin`: records appended one after the other, each with the checksum of all up to it.

use super::Damage;
use super::bytes::{Reader, Writer};
use super::position::{read_record, record_length, write_record};
use crate::run::Record;
use actin_mechanics::State;
use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 8] = b"ACTINREC";
/// Bytes before the first record.
const HEADER: u64 = 8;
/// Bytes of a checksum.
const CHECKSUM: usize = 4;

/// How many records there are, and the checksum of all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    pub(super) count: usize,
    pub(super) checksum: u32,
}

/// The file.
#[derive(Debug)]
pub(super) struct RecordLog {
    path: PathBuf,
    /// What is known to be on the disk.
    pub(super) tally: Tally,
    /// Bytes of a record with its checksum.
    length: usize,
}

impl RecordLog {
    /// The log at `path` of a run with states like `like` and `terms` energies, of which `tally` is
    /// known to be on the disk.
    pub(super) fn new(path: PathBuf, tally: Tally, like: &State, terms: usize) -> Self {
        Self {
            path,
            tally,
            length: record_length(like, terms) + CHECKSUM,
        }
    }

    /// Appends what is missing of `records`, of which the first are on the disk already, and waits
    /// until it is there. What a failure leaves behind the known records is cut off again.
    pub(super) fn append(&mut self, records: &[Record]) -> io::Result<()> {
        let Tally { count, checksum } = self.tally;
        let new = records.get(count..).unwrap_or_default();
        if new.is_empty() && count > 0 {
            return Ok(());
        }
        let mut options = OpenOptions::new();
        let file = options
            .write(true)
            .create(true)
            .truncate(false)
            .open(&self.path)?;
        let offset = if count == 0 { 0 } else { self.end() };
        let checksum = write_from(&file, offset, new, checksum).inspect_err(|_| {
            // Room for other files on a disk that is full; without it the rest is overwritten next time.
            let _ = file.set_len(offset);
        })?;
        self.tally = Tally {
            count: records.len(),
            checksum,
        };
        Ok(())
    }

    /// Where the known records end.
    fn end(&self) -> u64 {
        HEADER + self.tally.count as u64 * self.length as u64
    }

    /// Reads the known records.
    pub(super) fn read(&self, like: &State, terms: usize) -> Result<Vec<Record>, Damage> {
        let Some(expected) = self.checked_end() else {
            let count = self.tally.count;
            return Err(Damage::Contents(format!("{count} records")));
        };
        let file = open(&self.path)?;
        let found = file.metadata()?.len();
        if found < expected {
            return Err(Damage::Length { found, expected });
        }
        let mut file = BufReader::new(file);
        let mut magic = [0; 8];
        file.read_exact(&mut magic)?;
        if &magic != MAGIC {
            return Err(Damage::OtherFile {
                expected: "ACTINREC",
            });
        }
        let mut chain = 0;
        let mut bytes = vec![0; self.length];
        let mut records = Vec::with_capacity(self.tally.count);
        for i in 0..self.tally.count {
            file.read_exact(&mut bytes)?;
            let (body, written) = bytes.split_at(self.length - CHECKSUM);
            chain = follow(chain, body);
            let written = Reader::new(written).checksum()?;
            compare(format!("record {i}"), chain, written)?;
            records.push(read_record(&mut Reader::new(body), like, terms)?);
        }
        let part = "all records, which belong to another checkpoint,".into();
        compare(part, chain, self.tally.checksum)?;
        Ok(records)
    }

    fn checked_end(&self) -> Option<u64> {
        let records = (self.tally.count as u64).checked_mul(self.length as u64)?;
        records.checked_add(HEADER)
    }
}

/// Writes records at `offset` and waits until they are on the disk; returns the checksum of all.
fn write_from(file: &File, offset: u64, records: &[Record], chain: u32) -> io::Result<u32> {
    let mut out = BufWriter::new(file);
    out.seek(SeekFrom::Start(offset))?;
    if offset == 0 {
        out.write_all(MAGIC)?;
    }
    let chain = append_all(&mut out, records, chain)?;
    out.flush()?;
    file.sync_data()?;
    Ok(chain)
}

/// Writes records behind others of checksum `chain`; returns the checksum of all.
fn append_all(out: &mut impl Write, records: &[Record], mut chain: u32) -> io::Result<u32> {
    for record in records {
        let mut writer = Writer::default();
        write_record(&mut writer, record);
        chain = follow(chain, &writer.bytes);
        writer.checksum(chain);
        out.write_all(&writer.bytes)?;
    }
    Ok(chain)
}

/// The checksum of `bytes` behind others of checksum `chain`.
fn follow(chain: u32, bytes: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new_with_initial(chain);
    hasher.update(bytes);
    hasher.finalize()
}

/// Refuses a checksum other than the one that was written.
pub(super) fn compare(part: String, found: u32, expected: u32) -> Result<(), Damage> {
    if found == expected {
        return Ok(());
    }
    Err(Damage::Checksum {
        part,
        found,
        expected,
    })
}

/// Opens a file to read it.
pub(super) fn open(path: &Path) -> Result<File, Damage> {
    File::open(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => Damage::Missing,
        _ => error.into(),
    })
}
