//! `checkpoint.bin`: its header, whose it is, and how it replaces the one before.

use super::Damage;
use super::bytes::{Reader, Writer};
use super::log::{Tally, compare, open};
use super::standing::{read_standing, write_standing};
use crate::run::Standing;
use crate::{Assembly, Task, results::directory};
use actin_mechanics::State;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

const MAGIC: &[u8; 8] = b"ACTINCKP";
/// Version of the format: to be raised with every change of a byte.
const FORMAT: u32 = 2;
/// Bytes of the header: magic, version, length and checksum of the contents, checksum of these.
const HEADER: usize = 8 + 4 + 8 + 4 + 4;
/// Version of the program.
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Whose checkpoint it is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Identity {
    /// The scene as resolved.
    scene: String,
    /// A state of the assembly, for what time does not change.
    pub(super) like: State,
    /// Number of interactions.
    pub(super) terms: usize,
    /// Whether the scene asks for a motion in time.
    is_motion: bool,
}

/// What a checkpoint says.
#[derive(Debug)]
pub(super) struct Contents {
    pub(super) standing: Standing,
    pub(super) records: Tally,
    pub(super) wall_s: f64,
}

impl Identity {
    /// That of an assembly whose scene has been resolved.
    pub(super) fn of(assembly: &Assembly) -> Self {
        Self {
            scene: assembly.scene.to_ron(),
            like: assembly.system.state().clone(),
            terms: assembly.terms.len(),
            is_motion: matches!(assembly.scene.task, Task::Dynamics(_)),
        }
    }

    /// The bytes of a checkpoint.
    pub(super) fn encode(&self, standing: &Standing, records: Tally, wall_s: f64) -> Vec<u8> {
        let mut body = Writer::default();
        body.text(PROGRAM);
        body.text(&self.scene);
        for size in self.sizes() {
            body.size(size);
        }
        body.number(wall_s);
        body.size(records.count);
        body.checksum(records.checksum);
        write_standing(&mut body, standing);

        let mut file = Writer::default();
        file.bytes.extend_from_slice(MAGIC);
        file.checksum(FORMAT);
        file.size(body.bytes.len());
        file.checksum(crc32fast::hash(&body.bytes));
        file.checksum(crc32fast::hash(&file.bytes));
        file.bytes.append(&mut body.bytes);
        file.bytes
    }

    /// Numbers that a checkpoint must share with the assembly.
    fn sizes(&self) -> [usize; 4] {
        let State {
            points,
            frames,
            controls,
            ..
        } = &self.like;
        [points.len(), frames.len(), controls.len(), self.terms]
    }

    /// Reads the checkpoint at `path`.
    pub(super) fn read(&self, path: &Path) -> Result<Contents, Damage> {
        let body = read_body(path)?;
        let mut reader = Reader::new(&body);
        let program = reader.text()?;
        if program != PROGRAM {
            return Err(Damage::Program {
                found: program,
                here: PROGRAM.to_owned(),
            });
        }
        same_scene(&reader.text()?, &self.scene)?;
        for expected in self.sizes() {
            let found = reader.size()?;
            if found != expected {
                let what = format!("{found} bodies or terms where the scene has {expected}");
                return Err(Damage::Contents(what));
            }
        }
        let wall_s = reader.number()?;
        let records = Tally {
            count: reader.size()?,
            checksum: reader.checksum()?,
        };
        let standing = read_standing(&mut reader, &self.like)?;
        reader.end()?;
        if matches!(standing, Standing::Motion(_)) != self.is_motion {
            return Err(Damage::Contents("a run of another task".into()));
        }
        Ok(Contents {
            standing,
            records,
            wall_s,
        })
    }
}

/// Refuses another scene, with the first line that differs.
pub(super) fn same_scene(kept: &str, given: &str) -> Result<(), Damage> {
    if kept == given {
        return Ok(());
    }
    let (mut old, mut new) = (kept.lines(), given.lines());
    let mut line = 0;
    loop {
        line += 1;
        let (kept, given) = (old.next(), new.next());
        if kept != given || kept.is_none() {
            return Err(Damage::Scene {
                line,
                kept: kept.unwrap_or_default().trim().to_owned(),
                given: given.unwrap_or_default().trim().to_owned(),
            });
        }
    }
}

/// What is behind the header, which is checked first: nothing is read or allocated for a file that
/// is no checkpoint, of another format, or of another length than its header says.
fn read_body(path: &Path) -> Result<Vec<u8>, Damage> {
    let mut file = open(path)?;
    let found = file.metadata()?.len();
    let mut header = [0; HEADER];
    let short = |_| Damage::Length {
        found,
        expected: HEADER as u64,
    };
    file.read_exact(&mut header).map_err(short)?;
    let mut reader = Reader::new(&header);
    if &reader.count()?.to_le_bytes() != MAGIC {
        return Err(Damage::OtherFile {
            expected: "ACTINCKP",
        });
    }
    let format = reader.checksum()?;
    let (length, checksum) = (reader.count()?, reader.checksum()?);
    let of_header = crc32fast::hash(&header[..HEADER - 4]);
    compare("its header".into(), of_header, reader.checksum()?)?;
    if format != FORMAT {
        return Err(Damage::Format {
            found: format,
            known: FORMAT,
        });
    }
    let expected = length.saturating_add(HEADER as u64);
    if found != expected {
        return Err(Damage::Length { found, expected });
    }
    let mut body = Vec::new();
    file.read_to_end(&mut body)?;
    compare("its contents".into(), crc32fast::hash(&body), checksum)?;
    Ok(body)
}

/// Writes `bytes` to `path` so that, whatever happens and even if power is lost, either they or
/// what was there before is there: beside it, to the disk, then renamed, and the directory to the
/// disk.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let unfinished = directory::unfinished(path);
    let written = File::create(&unfinished)
        .and_then(|mut file| {
            file.write_all(bytes)?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&unfinished, path));
    if written.is_err() {
        // The error that led here says more than one about the removal could.
        let _ = fs::remove_file(&unfinished);
    }
    written?;
    path.parent().map_or(Ok(()), sync)
}

/// Waits until a file or directory is on the disk.
pub(super) fn sync(path: &Path) -> io::Result<()> {
    // Some systems cannot open a directory; there a rename is as durable as it gets.
    match File::open(path) {
        Ok(file) => file.sync_all(),
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => Ok(()),
        Err(error) => Err(error),
    }
}
