//! `events.csv`: linker events, one row per event.

use crate::RunDirectoryError;
use crate::finite::ensure_finite;
use crate::names::EVENTS;
use actin_sim::{LinkerEvent, LinkerEventKind};
use std::io::{self, Write};
use std::path::Path;

const COLUMNS: [&str; 8] = [
    "time_ns",
    "linker",
    "what",
    "force_pn",
    "at_nm",
    "energy_pn_nm",
    "hand",
    "filament",
];

pub(crate) fn ensure_all_finite(events: &[LinkerEvent]) -> Result<(), RunDirectoryError> {
    let numbers = |e: &LinkerEvent| [e.time_ns, e.force_pn, e.at_nm, e.energy_pn_nm];
    let names = ["time_ns", "force_pn", "at_nm", "energy_pn_nm"];
    for (column, name) in names.into_iter().enumerate() {
        let values = events.iter().map(|event| numbers(event)[column]);
        ensure_finite(EVENTS, name, &[events.len()], values)?;
    }
    Ok(())
}

/// Writes a header and one row per event. Numbers have enough digits for an exact round trip.
pub(crate) fn write(events: &[LinkerEvent], out: &mut impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(COLUMNS)?;
    for event in events {
        writer.write_record([
            format!("{:?}", event.time_ns),
            event.linker.to_string(),
            event.what.to_string(),
            format!("{:?}", event.force_pn),
            format!("{:?}", event.at_nm),
            format!("{:?}", event.energy_pn_nm),
            event.hand.to_string(),
            event.filament.to_string(),
        ])?;
    }
    writer.flush()
}

/// Reads the events; their step numbers are not stored and are zero.
pub(crate) fn read(path: &Path) -> Result<Vec<LinkerEvent>, RunDirectoryError> {
    let refused = |reason: String| RunDirectoryError::Damaged {
        path: path.to_owned(),
        reason,
    };
    let mut reader = csv::Reader::from_path(path).map_err(|error| refused(error.to_string()))?;
    let rows = reader.records().enumerate();
    rows.map(|(row, record)| {
        let record = record.map_err(|error| refused(error.to_string()))?;
        event(&record).ok_or_else(|| refused(format!("row {} is not an event", row + 1)))
    })
    .collect()
}

fn event(record: &csv::StringRecord) -> Option<LinkerEvent> {
    let kind = record.get(2)?;
    let number = |column: usize| record.get(column)?.parse().ok();
    Some(LinkerEvent {
        step: 0,
        time_ns: number(0)?,
        linker: record.get(1)?.parse().ok()?,
        what: LinkerEventKind::ALL
            .into_iter()
            .find(|one| one.to_string() == kind)?,
        force_pn: number(3)?,
        at_nm: number(4)?,
        energy_pn_nm: number(5)?,
        // Files of earlier versions lack the last two columns.
        hand: record.get(6).map_or(Some(0), |hand| hand.parse().ok())?,
        filament: record
            .get(7)
            .map_or(Some(0), |filament| filament.parse().ok())?,
    })
}
