//! `events.csv`: linker events, one row per event.

use crate::RunDirectoryError;
use crate::names::EVENTS;
use crate::table::{self, Cell};
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

/// Writes one row per event.
pub(crate) fn write(events: &[LinkerEvent], out: &mut impl Write) -> io::Result<()> {
    let rows = events.iter().map(|event| {
        Ok([
            Cell::Number(event.time_ns),
            Cell::Text(event.linker.to_string()),
            Cell::Text(event.what.to_string()),
            Cell::Number(event.force_pn),
            Cell::Number(event.at_nm),
            Cell::Number(event.energy_pn_nm),
            Cell::Text(event.hand.to_string()),
            Cell::Text(event.filament.to_string()),
        ])
    });
    table::write(EVENTS, &COLUMNS.map(str::to_owned), rows, out)
}

/// Reads the events; their step numbers are not stored and are zero.
pub(crate) fn read(path: &Path) -> Result<Vec<LinkerEvent>, RunDirectoryError> {
    let refused = |error: csv::Error| RunDirectoryError::damaged(path, &error);
    let mut reader = csv::Reader::from_path(path).map_err(refused)?;
    let rows = reader.records().enumerate();
    rows.map(|(row, record)| {
        let reason = || format!("row {} is not an event", row + 1);
        let event = event(&record.map_err(refused)?);
        event.ok_or_else(|| RunDirectoryError::damaged(path, &reason()))
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
