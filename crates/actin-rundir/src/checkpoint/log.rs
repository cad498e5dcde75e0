//! Format of `records.bin`: consecutive records, each with the checksum of all records up to it.

use super::stored::{Form, Stored};
use super::wire::encode;
use crate::Damage;
use actin_sim::mechanics::State;
use actin_sim::{Record, RecordIter, Records, StoredRecord};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 8] = b"ACTINREC";
/// Bytes before the first record.
const HEADER: u64 = 8;
const CHECKSUM: usize = 4;
/// Buffer size (bytes) at which records are written.
const BUFFER: usize = 1 << 20;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Tally {
    pub(super) count: usize,
    pub(super) checksum: u32,
}

/// Log of the records of a run: an append-only file and a buffer.
///
/// Records that cannot be written stay in the buffer. Writing is repeated when the buffer has
/// doubled and at the next checkpoint.
#[derive(Debug)]
pub(super) struct RecordLog {
    path: PathBuf,
    form: Form,
    /// State of the last record, if the file has no states.
    last: Option<State>,
    /// Bytes of a record and its checksum.
    length: usize,
    file: Option<File>,
    /// Records on the disk.
    written: Tally,
    taken: Tally,
    /// Encoded records that are not in the file.
    buffer: Vec<u8>,
    /// Buffer size (bytes) that triggers the next write.
    patience: usize,
}

impl RecordLog {
    /// Creates the log at `path` with `tally` records on the disk, the last of which is `last`.
    pub(super) fn new(path: PathBuf, tally: Tally, form: &Form, last: Option<&Record>) -> Self {
        Self {
            path,
            form: form.clone(),
            last: last.filter(|_| !form.has_states).map(|r| r.state.clone()),
            length: Stored::length(form) + CHECKSUM,
            file: None,
            written: tally,
            taken: tally,
            buffer: Vec::new(),
            patience: BUFFER,
        }
    }

    /// Adds a record. Write errors are reported by [`sync`](Self::sync).
    pub(super) fn push(&mut self, record: StoredRecord<'_>) {
        let start = self.buffer.len();
        let state = record.state.as_deref().filter(|_| self.form.has_states);
        let stored = Stored::new(&record.row, state);
        self.buffer = encode(&stored, std::mem::take(&mut self.buffer));
        if !self.form.has_states {
            self.last = record.state.map(Cow::into_owned);
        }
        let checksum = follow(self.taken.checksum, &self.buffer[start..]);
        self.buffer.extend(checksum.to_le_bytes());
        self.taken = Tally {
            count: self.taken.count + 1,
            checksum,
        };
        if self.buffer.len() >= self.patience && self.flush().is_err() {
            self.patience = 2 * self.buffer.len();
        }
    }

    /// Waits until all records are on the disk and returns the tally of the first `count`.
    pub(super) fn sync(&mut self, count: usize) -> io::Result<Tally> {
        if !self.buffer.is_empty() || self.taken.count == 0 {
            self.flush()?;
        }
        self.tally_of(count)
    }

    /// Writes the buffer and waits until it is on the disk. After a failure, partial output is
    /// removed.
    fn flush(&mut self) -> io::Result<()> {
        let start = match self.written.count {
            0 => 0,
            _ => self.end(),
        };
        let mut file = match self.file.take() {
            Some(file) => file,
            None => create(&self.path, start)?,
        };
        // A failed sync may lose written data, so the buffer is kept until then.
        let written = append(&mut file, start, &self.buffer).and_then(|()| file.sync_data());
        if let Err(error) = written {
            // Frees space on a full disk; if this fails, the next write overwrites the rest.
            let _ = file.set_len(start);
            return Err(error);
        }
        self.file = Some(file);
        self.written = self.taken;
        self.buffer.clear();
        self.patience = BUFFER;
        Ok(())
    }

    fn tally_of(&self, count: usize) -> io::Result<Tally> {
        let checksum = match count {
            0 => 0,
            _ if count == self.taken.count => self.taken.checksum,
            _ => {
                let mut file = File::open(&self.path)?;
                let end = HEADER + count as u64 * self.length as u64;
                file.seek(SeekFrom::Start(end - CHECKSUM as u64))?;
                let mut bytes = [0; CHECKSUM];
                file.read_exact(&mut bytes)?;
                u32::from_le_bytes(bytes)
            }
        };
        Ok(Tally { count, checksum })
    }

    /// Length of the file in bytes.
    fn end(&self) -> u64 {
        let records = (self.written.count as u64).saturating_mul(self.length as u64);
        records.saturating_add(HEADER)
    }

    /// Begins to read all records.
    pub(super) fn read(&self) -> Result<Reading<'_>, Damage> {
        let file: Box<dyn Read> = match self.written.count {
            0 => Box::new(io::empty()),
            _ => Box::new(self.read_file()?),
        };
        Ok(Reading {
            log: self,
            source: Box::new(file.chain(&self.buffer[..])),
            tally: Tally::default(),
            bytes: vec![0; self.length],
            has_ended: false,
        })
    }

    fn read_file(&self) -> Result<impl Read + use<>, Damage> {
        let expected = self.end();
        let file = open(&self.path)?;
        let found = file.metadata()?.len();
        if found < expected {
            return Err(Damage::Length { found, expected });
        }
        let mut file = BufReader::with_capacity(1 << 16, file);
        let mut magic = [0; 8];
        file.read_exact(&mut magic)?;
        if &magic != MAGIC {
            return Err(Damage::OtherFile("ACTINREC"));
        }
        Ok(file.take(expected - HEADER))
    }
}

impl Records for RecordLog {
    fn count(&self) -> usize {
        self.taken.count
    }

    fn iter(&self) -> RecordIter<'_> {
        let refused = |damage: Damage| io::Error::other(damage.of(&self.path));
        match self.read() {
            Ok(reading) => Box::new(reading.map(move |record| record.map_err(refused))),
            Err(damage) => Box::new(std::iter::once(Err(refused(damage)))),
        }
    }
}

pub(super) struct Reading<'a> {
    log: &'a RecordLog,
    source: Box<dyn Read + 'a>,
    tally: Tally,
    bytes: Vec<u8>,
    has_ended: bool,
}

impl<'a> Reading<'a> {
    fn next_record(&mut self) -> Result<Option<StoredRecord<'a>>, Damage> {
        let Self { log, tally, .. } = self;
        if tally.count == log.taken.count {
            let part = "all records (possibly of another checkpoint)".into();
            return compare(part, tally.checksum, log.taken.checksum).map(|()| None);
        }
        self.source.read_exact(&mut self.bytes)?;
        let (body, written) = self.bytes.split_at(log.length - CHECKSUM);
        tally.checksum = follow(tally.checksum, body);
        let written = written.try_into().expect("four bytes of checksum");
        let written = u32::from_le_bytes(written);
        compare(format!("record {}", tally.count), tally.checksum, written)?;
        tally.count += 1;
        let mut record = Stored::read(body, &log.form)?.into_record(&log.form);
        if tally.count == log.taken.count {
            let last = log.last.as_ref();
            record.state = record.state.or(last.map(Cow::Borrowed));
        }
        Ok(Some(record))
    }
}

impl<'a> Iterator for Reading<'a> {
    type Item = Result<StoredRecord<'a>, Damage>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.has_ended {
            return None;
        }
        let next = self.next_record().transpose();
        self.has_ended = !matches!(next, Some(Ok(_)));
        next
    }
}

/// Opens or creates a log for writing and truncates it to `end` bytes.
fn create(path: &Path, end: u64) -> io::Result<File> {
    let mut options = OpenOptions::new();
    let file = options
        .write(true)
        .create(true)
        .truncate(false)
        .open(path)?;
    file.set_len(end)?;
    Ok(file)
}

/// Writes records after `start` bytes, with the magic number if the file is empty.
fn append(file: &mut File, start: u64, records: &[u8]) -> io::Result<()> {
    file.seek(SeekFrom::Start(start))?;
    if start == 0 {
        file.write_all(MAGIC)?;
    }
    file.write_all(records)
}

/// Checksum of `bytes` after data with the checksum `chain`.
fn follow(chain: u32, bytes: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new_with_initial(chain);
    hasher.update(bytes);
    hasher.finalize()
}

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

pub(super) fn open(path: &Path) -> Result<File, Damage> {
    File::open(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => Damage::Missing,
        _ => error.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture;
    use actin_sim::{Row, Trajectory};
    use std::fs;

    fn log_of(has_states: bool) -> (tempfile::TempDir, RecordLog, Vec<Record>) {
        let assembly = fixture::clamped_start();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("records.bin");
        let form = Form {
            like: assembly.rest.clone(),
            terms: assembly.terms.len(),
            columns: 0,
            has_states,
        };
        let log = RecordLog::new(path, Tally::default(), &form, None);
        let records = fixture::trajectory(&assembly).records;
        (folder, log, records)
    }

    fn log() -> (tempfile::TempDir, RecordLog, Vec<Record>) {
        log_of(true)
    }

    /// Memory holds less than a buffer and one record. Reading continues from the file to the
    /// buffer.
    #[test]
    fn records_are_written_during_the_run() {
        let (_folder, mut log, records) = log();
        let count = 3 * BUFFER.div_ceil(log.length) + 2;
        for i in 0..count {
            log.push(records[i % 3].as_stored());
            assert!(log.buffer.len() < BUFFER + log.length);
            let written = fs::metadata(&log.path).map_or(HEADER, |data| data.len());
            let all = written + log.buffer.len() as u64;
            assert_eq!(all, HEADER + ((i + 1) * log.length) as u64);
        }
        assert!(log.written.count > 0 && !log.buffer.is_empty());
        let read = Trajectory::read(&log).unwrap().records;
        assert_eq!((read.len(), log.count()), (count, count));
        for (i, record) in read.iter().enumerate() {
            assert_eq!(record.state, records[i % 3].state);
        }
    }

    #[test]
    fn a_checkpoint_may_count_fewer_records() {
        let (_folder, mut log, records) = log();
        let tallies = [0, 1, 2].map(|count| {
            let tally = log.sync(count).unwrap();
            log.push(records[count].as_stored());
            tally
        });
        for (count, tally) in tallies.into_iter().enumerate() {
            assert_eq!(log.sync(count).unwrap(), tally);
        }
        let mut again = RecordLog::new(log.path.clone(), tallies[2], &log.form, None);
        assert_eq!(Trajectory::read(&again).unwrap().records.len(), 2);
        // The first write after resuming truncates the file to these records.
        again.push(records[2].as_stored());
        again.sync(3).unwrap();
        assert_eq!(Trajectory::read(&again).unwrap().records.len(), 3);
        let length = fs::metadata(&again.path).unwrap().len();
        assert_eq!(length, HEADER + 3 * again.length as u64);
    }

    #[test]
    fn write_errors_lose_no_records() {
        let (_folder, mut log, records) = log();
        fs::create_dir(&log.path).unwrap();
        for record in &records {
            log.push(record.as_stored());
        }
        assert!(log.sync(3).is_err());
        assert_eq!(Trajectory::read(&log).unwrap().records.len(), 3);
        fs::remove_dir(&log.path).unwrap();
        log.sync(3).unwrap();
        assert!(log.buffer.is_empty());
        assert_eq!(Trajectory::read(&log).unwrap().records.len(), 3);
    }

    /// The length of a record does not depend on the number of bodies. Only the last state is kept.
    #[test]
    fn without_states_records_are_rows() {
        let (_folder, mut log, records) = log_of(false);
        for record in &records {
            log.push(record.as_stored());
        }
        log.sync(3).unwrap();
        // Tagged time, six numbers, energies of the terms, two list lengths and a flag without
        // state.
        let expected = 9 + 6 * 8 + 8 * log.form.terms + 3;
        assert_eq!(log.length, expected + CHECKSUM);
        let rows = log.iter().map(|record| record.unwrap().row.into_owned());
        let rows: Vec<Row> = rows.collect();
        let expected: Vec<Row> = records.iter().map(|record| record.row.clone()).collect();
        assert_eq!((rows, log.count()), (expected, 3));
        let kept = Trajectory::read(&log).unwrap().records;
        assert_eq!((kept.len(), &kept[0].state), (1, &records[2].state));
    }
}
