//! `records.bin`: records appended one after the other, each with the checksum of all up to it.

use super::Damage;
use super::stored::{Form, Stored};
use super::wire::encode;
use crate::run::{Record, RecordIter, Records, RowIter};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 8] = b"ACTINREC";
/// Bytes before the first record.
const HEADER: u64 = 8;
/// Bytes of a checksum.
const CHECKSUM: usize = 4;
/// So many bytes of records wait until they are written together.
const BUFFER: usize = 1 << 20;

/// How many records there are, and the checksum of all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Tally {
    pub(super) count: usize,
    pub(super) checksum: u32,
}

/// The log of the records of a run: a file that is only ever appended to, and a buffer.
///
/// What a disk refuses stays in the buffer, and is tried again when that has doubled and at the next
/// checkpoint.
#[derive(Debug)]
pub(super) struct RecordLog {
    path: PathBuf,
    form: Form,
    /// The last record, where the log has no states.
    last: Option<Record>,
    /// Bytes of a record with its checksum.
    length: usize,
    /// Open from the first time that it is written to.
    file: Option<File>,
    /// What is on the disk.
    written: Tally,
    /// All records.
    taken: Tally,
    /// Those that are not in the file, as bytes.
    buffer: Vec<u8>,
    /// How many bytes the buffer is to hold before it is written.
    patience: usize,
}

impl RecordLog {
    /// The log at `path` of a run with records of this form, of which `tally` is known to be on the disk and
    /// `last` is the last.
    pub(super) fn new(path: PathBuf, tally: Tally, form: &Form, last: Option<&Record>) -> Self {
        Self {
            path,
            form: form.clone(),
            last: last.filter(|_| !form.has_states).cloned(),
            length: Stored::length(form) + CHECKSUM,
            file: None,
            written: tally,
            taken: tally,
            buffer: Vec::new(),
            patience: BUFFER,
        }
    }

    /// Adds a record. Where the disk refuses, [`sync`](Self::sync) will tell.
    pub(super) fn push(&mut self, record: &Record) {
        let start = self.buffer.len();
        let stored = Stored::new(record, self.form.has_states);
        self.buffer = encode(&stored, std::mem::take(&mut self.buffer));
        if !self.form.has_states {
            self.last = Some(record.clone());
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

    /// Waits until all records are on the disk, and returns the tally of the first `count` of them.
    pub(super) fn sync(&mut self, count: usize) -> io::Result<Tally> {
        if !self.buffer.is_empty() || self.taken.count == 0 {
            self.flush()?;
        }
        self.tally_of(count)
    }

    /// Writes what is in the buffer and waits until it is on the disk. What a failure leaves behind the known records is cut off again.
    fn flush(&mut self) -> io::Result<()> {
        let start = match self.written.count {
            0 => 0,
            _ => self.end(),
        };
        let mut file = match self.file.take() {
            Some(file) => file,
            None => create(&self.path, start)?,
        };
        // A failed sync may drop what was written: the buffer is kept until the disk has it.
        let written = append(&mut file, start, &self.buffer).and_then(|()| file.sync_data());
        if let Err(error) = written {
            // Room for other files on a disk that is full; without it the rest is overwritten next time.
            let _ = file.set_len(start);
            return Err(error);
        }
        self.file = Some(file);
        self.written = self.taken;
        self.buffer.clear();
        self.patience = BUFFER;
        Ok(())
    }

    /// The tally of the first `count` records, which are in the file.
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

    /// Where the records that are in the file end.
    fn end(&self) -> u64 {
        HEADER + self.written.count as u64 * self.length as u64
    }

    fn checked_end(&self) -> Option<u64> {
        let records = (self.written.count as u64).checked_mul(self.length as u64)?;
        records.checked_add(HEADER)
    }

    /// What the log holds from the first record on.
    fn stored(&self) -> Box<dyn Iterator<Item = io::Result<Stored<'static>>> + '_> {
        let refused = |damage: Damage| io::Error::other(damage.of(&self.path));
        match self.read() {
            Ok(reading) => Box::new(reading.map(move |stored| stored.map_err(refused))),
            Err(damage) => Box::new(std::iter::once(Err(refused(damage)))),
        }
    }

    /// Reads the records from the first on.
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

    /// The records that are in the file.
    fn read_file(&self) -> Result<impl Read + use<>, Damage> {
        let Some(expected) = self.checked_end() else {
            let count = self.written.count;
            return Err(Damage::Contents(format!("{count} records")));
        };
        let file = open(&self.path)?;
        let found = file.metadata()?.len();
        if found < expected {
            return Err(Damage::Length { found, expected });
        }
        let mut file = BufReader::with_capacity(1 << 16, file);
        let mut magic = [0; 8];
        file.read_exact(&mut magic)?;
        if &magic != MAGIC {
            return Err(Damage::OtherFile {
                expected: "ACTINREC",
            });
        }
        Ok(file.take(expected - HEADER))
    }
}

impl Records for RecordLog {
    fn count(&self) -> usize {
        self.taken.count
    }

    fn iter(&self) -> RecordIter<'_> {
        if !self.form.has_states {
            return Box::new(self.last.iter().map(|record| Ok(Cow::Borrowed(record))));
        }
        let whole = |stored: Stored<'_>| stored.into_record(&self.form).map(Cow::Owned);
        Box::new(self.stored().filter_map(move |r| r.map(whole).transpose()))
    }

    fn rows(&self) -> RowIter<'_> {
        Box::new(self.stored().map(|stored| stored.map(Stored::into_row)))
    }
}

/// Reads the records of a log one by one.
pub(super) struct Reading<'a> {
    log: &'a RecordLog,
    source: Box<dyn Read + 'a>,
    /// What was read.
    tally: Tally,
    /// Of one record.
    bytes: Vec<u8>,
    has_ended: bool,
}

impl Reading<'_> {
    fn next_record(&mut self) -> Result<Option<Stored<'static>>, Damage> {
        let Self { log, tally, .. } = self;
        if tally.count == log.taken.count {
            let part = "all records, which belong to another checkpoint,".into();
            return compare(part, tally.checksum, log.taken.checksum).map(|()| None);
        }
        self.source.read_exact(&mut self.bytes)?;
        let (body, written) = self.bytes.split_at(log.length - CHECKSUM);
        tally.checksum = follow(tally.checksum, body);
        let written = written.try_into().expect("as many bytes as a checksum has");
        let written = u32::from_le_bytes(written);
        compare(format!("record {}", tally.count), tally.checksum, written)?;
        tally.count += 1;
        Stored::read(body, &log.form).map(Some)
    }
}

impl Iterator for Reading<'_> {
    type Item = Result<Stored<'static>, Damage>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.has_ended {
            return None;
        }
        let next = self.next_record().transpose();
        self.has_ended = !matches!(next, Some(Ok(_)));
        next
    }
}

/// Opens a log to write it, and makes it if need be. What is behind `end` goes: no checkpoint counts it.
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

/// Writes records behind `start` bytes; a log begins with what it is.
fn append(file: &mut File, start: u64, records: &[u8]) -> io::Result<()> {
    file.seek(SeekFrom::Start(start))?;
    if start == 0 {
        file.write_all(MAGIC)?;
    }
    file.write_all(records)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::fixture;
    use crate::{Row, Trajectory};
    use std::fs;

    /// A log of a made-up run, its folder, and the records that go into it.
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

    /// However many records there are, less than a buffer and a record of them wait in memory; the rest is
    /// in the file. All come back, first from the file and then from the buffer.
    #[test]
    fn records_go_to_the_disk_as_they_are_taken() {
        let (_folder, mut log, records) = log();
        let count = 3 * BUFFER.div_ceil(log.length) + 2;
        for i in 0..count {
            log.push(&records[i % 3]);
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

    /// The tally of a checkpoint is that of the records which it counts: a log that has no more of them
    /// has the same.
    #[test]
    fn a_checkpoint_may_count_fewer_records() {
        let (_folder, mut log, records) = log();
        let tallies = [0, 1, 2].map(|count| {
            let tally = log.sync(count).unwrap();
            log.push(&records[count]);
            tally
        });
        for (count, tally) in tallies.into_iter().enumerate() {
            assert_eq!(log.sync(count).unwrap(), tally);
        }
        let mut again = RecordLog::new(log.path.clone(), tallies[2], &log.form, None);
        assert_eq!(Trajectory::read(&again).unwrap().records.len(), 2);
        // Resumed, the file ends behind them, until there are more.
        again.push(&records[2]);
        again.sync(3).unwrap();
        assert_eq!(Trajectory::read(&again).unwrap().records.len(), 3);
        let length = fs::metadata(&again.path).unwrap().len();
        assert_eq!(length, HEADER + 3 * again.length as u64);
    }

    /// What cannot be written waits, and is read back all the same.
    #[test]
    fn a_disk_that_refuses_loses_nothing() {
        let (_folder, mut log, records) = log();
        fs::create_dir(&log.path).unwrap();
        for record in &records {
            log.push(record);
        }
        assert!(log.sync(3).is_err());
        assert_eq!(Trajectory::read(&log).unwrap().records.len(), 3);
        fs::remove_dir(&log.path).unwrap();
        log.sync(3).unwrap();
        assert!(log.buffer.is_empty());
        assert_eq!(Trajectory::read(&log).unwrap().records.len(), 3);
    }

    /// Without states a record takes the bytes of its numbers, however many bodies there are; all rows come
    /// back, and of the states that of the last.
    #[test]
    fn without_states_records_are_rows() {
        let (_folder, mut log, records) = log_of(false);
        for record in &records {
            log.push(record);
        }
        log.sync(3).unwrap();
        // A time with its kind, six numbers, as many energies as terms, two lengths, no state.
        let expected = 9 + 6 * 8 + 8 * log.form.terms + 3;
        assert_eq!(log.length, expected + CHECKSUM);
        let rows: Vec<Row> = log.rows().map(Result::unwrap).collect();
        let expected: Vec<Row> = records.iter().map(Record::row).collect();
        assert_eq!((rows, log.count()), (expected, 3));
        let kept = Trajectory::read(&log).unwrap().records;
        assert_eq!((kept.len(), &kept[0].state), (1, &records[2].state));
    }
}
