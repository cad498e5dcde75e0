//! `checkpoint.bin`: its header, whose it is, and how it replaces the one before.

use super::Damage;
use super::bytes::{Reader, Writer};
use super::log::{Tally, compare, open};
use super::position::{read_position, write_position};
use crate::run::RunPosition;
use crate::{Plan, Task};
use actin_mechanics::State;
use std::io::Read;
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
    pub(super) position: RunPosition,
    pub(super) records: Tally,
    pub(super) wall_s: f64,
}

impl Identity {
    /// That of a plan.
    pub(super) fn of(plan: &Plan<'_>) -> Self {
        let assembly = plan.assembly();
        Self {
            scene: plan.scene().to_ron(),
            like: assembly.system.state().clone(),
            terms: assembly.terms.len(),
            is_motion: matches!(assembly.scene.task, Task::Dynamics(_)),
        }
    }

    /// The bytes of a checkpoint.
    pub(super) fn encode(&self, position: &RunPosition, records: Tally, wall_s: f64) -> Vec<u8> {
        let mut body = Writer::default();
        body.text(PROGRAM);
        body.text(&self.scene);
        for size in self.sizes() {
            body.size(size);
        }
        body.number(wall_s);
        body.size(records.count);
        body.checksum(records.checksum);
        write_position(&mut body, position);

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
        let position = read_position(&mut reader, &self.like)?;
        reader.end()?;
        if matches!(position, RunPosition::Motion(_)) != self.is_motion {
            return Err(Damage::Contents("a run of another task".into()));
        }
        Ok(Contents {
            position,
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
