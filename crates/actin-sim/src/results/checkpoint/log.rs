//! `records.bin`: records appended one after the other, each with the checksum of all up to it.

use super::Damage;
use super::wire::{decode_all, encode};
use crate::run::{At, Record, RecordIter, Records};
use actin_mechanics::{Motion, State};
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

/// A record in the log. Those of one run are of one length: their lists are, and numbers of a varying
/// length there are none.
#[derive(Serialize, Deserialize)]
struct Stored<'a> {
    at: At,
    kinetic_pn_nm: f64,
    residual_force_pn: f64,
    residual_torque_pn_nm: f64,
    energies_pn_nm: Cow<'a, [f64]>,
    motion: Motion,
}

impl<'a> Stored<'a> {
    fn new(record: &'a Record) -> Self {
        let Record {
            at,
            state,
            energies_pn_nm,
            kinetic_pn_nm,
            residual_force_pn,
            residual_torque_pn_nm,
        } = record;
        Self {
            at: *at,
            kinetic_pn_nm: *kinetic_pn_nm,
            residual_force_pn: *residual_force_pn,
            residual_torque_pn_nm: *residual_torque_pn_nm,
            energies_pn_nm: energies_pn_nm.into(),
            motion: state.motion(),
        }
    }

    /// The record of a run with states like `like` and `terms` energies.
    fn read(bytes: &'a [u8], like: &State, terms: usize) -> Result<Record, Damage> {
        let stored: Self = decode_all(bytes)?;
        if !stored.motion.fits(like) || stored.energies_pn_nm.len() != terms {
            return Err(Damage::Contents("a record of another scene".into()));
        }
        Ok(Record {
            at: stored.at,
            state: like.in_motion(stored.motion),
            energies_pn_nm: stored.energies_pn_nm.into_owned(),
            kinetic_pn_nm: stored.kinetic_pn_nm,
            residual_force_pn: stored.residual_force_pn,
            residual_torque_pn_nm: stored.residual_torque_pn_nm,
        })
    }

    /// Bytes of a record of such a run.
    fn length(like: &State, terms: usize) -> usize {
        let record = Self {
            at: At::Time(0.0),
            kinetic_pn_nm: 0.0,
            residual_force_pn: 0.0,
            residual_torque_pn_nm: 0.0,
            energies_pn_nm: vec![0.0; terms].into(),
            motion: like.motion(),
        };
        encode(&record, Vec::new()).len()
    }
}

/// The log of the records of a run: a file that is only ever appended to, and a buffer.
///
/// What a disk refuses stays in the buffer, and is tried again when that has doubled and at the next
/// checkpoint.
#[derive(Debug)]
pub(super) struct RecordLog {
    path: PathBuf,
    /// A state of the run, for what time does not change.
    like: State,
    /// Energies of a record.
    terms: usize,
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
    /// The log at `path` of a run with states like `like` and `terms` energies, of which `tally` is
    /// known to be on the disk.
    pub(super) fn new(path: PathBuf, tally: Tally, like: &State, terms: usize) -> Self {
        Self {
            path,
            like: like.clone(),
            terms,
            length: Stored::length(like, terms) + CHECKSUM,
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
        self.buffer = encode(&Stored::new(record), std::mem::take(&mut self.buffer));
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
        let refused = |damage: Damage| io::Error::other(damage.of(&self.path));
        match self.read() {
            Ok(reading) => Box::new(reading.map(move |r| r.map(Cow::Owned).map_err(refused))),
            Err(damage) => Box::new(std::iter::once(Err(refused(damage)))),
        }
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
    fn next_record(&mut self) -> Result<Option<Record>, Damage> {
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
        Stored::read(body, &log.like, log.terms).map(Some)
    }
}

impl Iterator for Reading<'_> {
    type Item = Result<Record, Damage>;

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
    use crate::Trajectory;
    use crate::results::fixture;
    use std::fs;

    /// A log of a made-up run, its folder, and the records that go into it.
    fn log() -> (tempfile::TempDir, RecordLog, Vec<Record>) {
        let assembly = fixture::clamped_start();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("records.bin");
        let log = RecordLog::new(path, Tally::default(), &assembly.rest, assembly.terms.len());
        let records = fixture::trajectory(&assembly).records;
        (folder, log, records)
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
        let (path, terms) = (log.path.clone(), log.terms);
        let mut again = RecordLog::new(path, tallies[2], &log.like, terms);
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
}
