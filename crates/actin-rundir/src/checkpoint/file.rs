//! Format of `checkpoint.bin`.

use super::log::{Tally, compare, open};
use super::stored::{Form, Stored};
use super::wire::{decode, decode_all, encode};
use crate::Damage;
use crate::difference::{Difference, first_difference};
use actin_sim::mechanics::State;
use actin_sim::{
    Plan, RecordSummary, RunPosition, RunStatistics, SavedRun, StoredRecord, Task, observed_columns,
};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::io::Read;
use std::path::Path;

const MAGIC: &[u8; 8] = b"ACTINCKP";
/// Version of the format; increase it with every change, including changes to the records.
const FORMAT: u32 = 13;
/// Length of the header: magic, version, length and checksum of the contents, checksum of the
/// header.
const HEADER: usize = 8 + 4 + 8 + 4 + 4;
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Scene and record layout of a checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Identity {
    pub(super) scene: String,
    /// Checksum of the state that `start` of the scene gave.
    pub(super) start: Option<u32>,
    pub(super) form: Form,
    /// True for motions in time, false for equilibria.
    pub(super) is_motion: bool,
}

/// Beginning of the contents. It is decoded first, since the rest depends on the program version.
#[derive(Serialize, Deserialize)]
struct Origin<'a> {
    program: &'a str,
    scene: &'a str,
    start: Option<u32>,
}

/// Contents of a checkpoint after the origin.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Contents<'a> {
    pub(super) wall_s: f64,
    pub(super) records: Tally,
    pub(super) position: Cow<'a, RunPosition>,
    pub(super) carried: Cow<'a, RunStatistics>,
    pub(super) last: Option<Stored<'a>>,
}

impl Identity {
    pub(super) fn new(plan: &Plan<'_>) -> Self {
        let assembly = plan.assembly();
        Self {
            scene: plan.scene().to_ron(),
            start: assembly
                .scene
                .start
                .as_ref()
                .map(|_| checksum(assembly.system.state())),
            form: Form {
                like: assembly.system.state().clone(),
                terms: assembly.terms.len(),
                columns: observed_columns(assembly).len(),
                has_states: assembly.scene.output.needs_states(),
            },
            is_motion: !matches!(assembly.scene.task, Task::Equilibrium(_)),
        }
    }

    pub(super) fn encode(&self, contents: &Contents<'_>) -> Vec<u8> {
        let origin = Origin {
            program: PROGRAM,
            scene: &self.scene,
            start: self.start,
        };
        let file = encode(&contents, encode(&origin, vec![0; HEADER]));
        with_header(file)
    }

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
        if origin.start != self.start {
            return Err(Damage::Start);
        }
        let contents: Contents<'static> = decode_all(rest)?;
        if matches!(*contents.position, RunPosition::Motion(_)) != self.is_motion {
            return Err(Damage::Contents("a run of another task".into()));
        }
        if !contents.position.fits(&self.form.like) {
            let what = "the numbers of bodies or controls differ from the scene";
            return Err(Damage::Contents(what.into()));
        }
        Ok(contents)
    }
}

/// Checksum of positions and orientations.
fn checksum(state: &State) -> u32 {
    let positions = (0..state.points.len()).map(|i| state.points.position.get(i));
    let orientations = (0..state.frames.len()).map(|i| state.frames.orientation.get(i));
    let numbers = positions.flat_map(<[f64; 3]>::from);
    let numbers = numbers.chain(orientations.flat_map(|q| <[f64; 4]>::from(q.coords)));
    let mut hasher = crc32fast::Hasher::new();
    for number in numbers {
        hasher.update(&number.to_le_bytes());
    }
    hasher.finalize()
}

/// Refuses another scene and reports the first line that differs.
pub(super) fn same_scene(kept: &str, given: &str) -> Result<(), Damage> {
    match first_difference(kept, given) {
        None => Ok(()),
        Some(Difference { line, kept, given }) => Err(Damage::Scene { line, kept, given }),
    }
}

impl Contents<'_> {
    /// Restores the interrupted run; `none` is its state before the first record.
    ///
    /// # Errors
    /// The numbers of records, bodies or columns differ from those of the run.
    pub(super) fn saved(self, none: &RecordSummary, form: &Form) -> Result<SavedRun, Damage> {
        let carried = self.carried.into_owned();
        let is_sound = carried.count == self.records.count
            && carried.fits(&none.carried)
            && self.last.is_some() == (carried.count > 0)
            && self.last.as_ref().is_none_or(|last| last.fits(form));
        if !is_sound {
            let what = "the numbers of records, bodies or columns differ from the run";
            return Err(Damage::Contents(what.into()));
        }
        let last = self.last.map(|last| last.into_record(form));
        let last = last.and_then(StoredRecord::into_record);
        Ok(SavedRun {
            position: self.position.into_owned(),
            recorded: RecordSummary { carried, last },
            wall_s: self.wall_s,
        })
    }
}

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

/// Reads the contents after validating the header.
///
/// Files of another type, version or length are refused before memory is allocated.
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
        return Err(Damage::OtherFile("ACTINCKP"));
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

fn word(header: &[u8; HEADER], at: usize) -> u32 {
    u32::from_le_bytes(std::array::from_fn(|k| header[at + k]))
}
