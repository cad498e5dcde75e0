//! `events.csv`: linker events, one row per event.

use super::names::EVENTS;
use super::{RunDirectoryError, finite::ensure_finite};
use crate::LinkerEvent;
use std::io::{self, Write};

const COLUMNS: [&str; 6] = [
    "time_ns",
    "linker",
    "what",
    "force_pn",
    "at_nm",
    "energy_pn_nm",
];

pub(super) fn ensure_all_finite(events: &[LinkerEvent]) -> Result<(), RunDirectoryError> {
    let numbers = |e: &LinkerEvent| [e.time_ns, e.force_pn, e.at_nm, e.energy_pn_nm];
    let names = ["time_ns", "force_pn", "at_nm", "energy_pn_nm"];
    for (column, name) in names.into_iter().enumerate() {
        let values = events.iter().map(|event| numbers(event)[column]);
        ensure_finite(EVENTS, name, &[events.len()], values)?;
    }
    Ok(())
}

/// Writes a header and one row per event. Numbers have enough digits for an exact round trip.
pub(super) fn write(events: &[LinkerEvent], out: &mut impl Write) -> io::Result<()> {
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
        ])?;
    }
    writer.flush()
}
