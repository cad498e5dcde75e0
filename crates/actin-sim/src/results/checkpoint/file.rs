//! `checkpoint.bin`: its header, whose it is, and how it replaces the one before.

use super::Damage;
use super::log::{Tally, compare, open};
use super::stored::{Form, Stored};
use super::wire::{decode, decode_all, encode};
use crate::results::difference::{Difference, first_difference};
use crate::run::{Carried, Recorded, RunPosition, Saved};
use crate::{Plan, Task};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io::Read;
use std::path::Path;

const MAGIC: &[u8; 8] = b"ACTINCKP";
/// Version of the format: to be raised with every change of a byte,
/// those of the records included.
const FORMAT: u32 = 8;
/// Bytes of the header: magic, version, length and checksum of the contents, checksum of these.
const HEADER: usize = 8 + 4 + 8 + 4 + 4;
/// Version of the program.
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Whose checkpoint it is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Identity {
    /// The scene as resolved.
    scene: String,
    /// What its records have in common.
    pub(super) form: Form,
    /// Whether the scene asks for a motion in time.
    is_motion: bool,
}

/// What a checkpoint begins with: other programs may write the rest in another way.
#[derive(Serialize, Deserialize)]
struct Origin<'a> {
    program: &'a str,
    scene: &'a str,
}

/// What a checkpoint says.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Contents<'a> {
    pub(super) wall_s: f64,
    pub(super) records: Tally,
    pub(super) position: Cow<'a, RunPosition>,
    /// What the run carries from record to record, and the last of them.
    pub(super) carried: Cow<'a, Carried>,
    pub(super) last: Option<Stored<'a>>,
}

impl Identity {
    /// That of a plan.
    pub(super) fn of(plan: &Plan<'_>) -> Self {
        let assembly = plan.assembly();
        Self {
            scene: plan.scene().to_ron(),
            form: Form {
                like: assembly.system.state().clone(),
                terms: assembly.terms.len(),
                columns: assembly.observers.columns().len(),
                has_states: assembly.scene.output.needs_states(),
            },
            is_motion: !matches!(assembly.scene.task, Task::Equilibrium(_)),
        }
    }

    /// The bytes of a checkpoint.
    pub(super) fn encode(&self, contents: &Contents<'_>) -> Vec<u8> {
        let origin = Origin {
            program: PROGRAM,
            scene: &self.scene,
        };
        let file = encode(&contents, encode(&origin, vec![0; HEADER]));
        with_header(file)
    }

    /// Reads the checkpoint at `path`.
    pub(super) fn read(&self, path: &Path) -> Result<Contents<'static>, Damage> {
        let body = read_body(path)?;
        let (origin, rest): (Origin<'_>, _) = decode(&body)?;
        if origin.program != PROGRAM {
            return Err(Damage::Program {
                found: origin.program.to_owned(),
                here: PROGRAM.to_owned(),
            });
        }
        same_scene(origin.scene, &self.scene)?;
        let contents: Contents<'static> = decode_all(rest)?;
        if matches!(*contents.position, RunPosition::Motion(_)) != self.is_motion {
            return Err(Damage::Contents("a run of another task".into()));
        }
        if !contents.position.fits(&self.form.like) {
            let what = "other numbers of bodies or controls than the scene has";
            return Err(Damage::Contents(what.into()));
        }
        Ok(contents)
    }
}

/// Refuses another scene, with the first line that differs.
pub(super) fn same_scene(kept: &str, given: &str) -> Result<(), Damage> {
    match first_difference(kept, given) {
        None => Ok(()),
        Some(Difference { line, kept, given }) => Err(Damage::Scene { line, kept, given }),
    }
}

impl Contents<'_> {
    /// The run that was interrupted, which remembers `none` before its first record.
    ///
    /// # Errors
    /// Contents of a run with other numbers of records, bodies or columns.
    pub(super) fn saved(self, none: &Recorded, form: &Form) -> Result<Saved, Damage> {
        let carried = self.carried.into_owned();
        let is_sound = carried.count == self.records.count
            && carried.fits(&none.carried)
            && self.last.is_some() == (carried.count > 0)
            && self.last.as_ref().is_none_or(|last| last.fits(form));
        if !is_sound {
            let what = "other numbers of records, bodies or columns than the run has";
            return Err(Damage::Contents(what.into()));
        }
        let last = self.last.and_then(|last| last.into_record(form));
        Ok(Saved {
            position: self.position.into_owned(),
            recorded: Recorded { carried, last },
            wall_s: self.wall_s,
        })
    }
}

/// Fills in the header of a file, for which there is room.
fn with_header(mut file: Vec<u8>) -> Vec<u8> {
    let (header, body) = file.split_at_mut(HEADER);
    header[..8].copy_from_slice(MAGIC);
    header[8..12].copy_from_slice(&FORMAT.to_le_bytes());
    header[12..20].copy_from_slice(&(body.len() as u64).to_le_bytes());
    header[20..24].copy_from_slice(&crc32fast::hash(body).to_le_bytes());
    let of_header = crc32fast::hash(&header[..24]);
    header[24..].copy_from_slice(&of_header.to_le_bytes());
    file
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
    if &header[..8] != MAGIC {
        return Err(Damage::OtherFile {
            expected: "ACTINCKP",
        });
    }
    let of_header = crc32fast::hash(&header[..24]);
    compare("its header".into(), of_header, word(&header, 24))?;
    let format = word(&header, 8);
    if format != FORMAT {
        return Err(Damage::Format {
            found: format,
            known: FORMAT,
        });
    }
    let length = u64::from(word(&header, 16)) << 32 | u64::from(word(&header, 12));
    let expected = length.saturating_add(HEADER as u64);
    if found != expected {
        return Err(Damage::Length { found, expected });
    }
    let mut body = Vec::new();
    file.read_to_end(&mut body)?;
    let of_body = crc32fast::hash(&body);
    compare("its contents".into(), of_body, word(&header, 20))?;
    Ok(body)
}

/// The little-endian number of four bytes at a place.
fn word(header: &[u8; HEADER], at: usize) -> u32 {
    u32::from_le_bytes(std::array::from_fn(|k| header[at + k]))
}
