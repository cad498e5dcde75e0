//! Linker events read from `events.csv`.

use super::super::RunDirectoryError;
use crate::{Assembly, LinkerEventKind};
use actin_mechanics::State;
use std::path::Path;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Event {
    time_ns: f64,
    linker: usize,
    what: LinkerEventKind,
    at_nm: f64,
}

pub(super) fn read(path: &Path) -> Result<Vec<Event>, RunDirectoryError> {
    let refused = |reason: String| RunDirectoryError::Damaged {
        path: path.to_owned(),
        reason,
    };
    let mut reader = csv::Reader::from_path(path).map_err(|error| refused(error.to_string()))?;
    let mut all = Vec::new();
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(|error| refused(error.to_string()))?;
        let event =
            event(&record).ok_or_else(|| refused(format!("row {} is not an event", row + 1)));
        all.push(event?);
    }
    Ok(all)
}

fn event(record: &csv::StringRecord) -> Option<Event> {
    let all = [
        LinkerEventKind::Broke,
        LinkerEventKind::Formed,
        LinkerEventKind::Stepped,
        LinkerEventKind::Left,
    ];
    let what = record.get(2)?;
    Some(Event {
        time_ns: record.get(0)?.parse().ok()?,
        linker: record.get(1)?.parse().ok()?,
        what: all.into_iter().find(|one| one.to_string() == what)?,
        at_nm: record.get(4)?.parse().ok()?,
    })
}

/// Applies all linker events up to `time_ns` to `state`.
pub(super) fn replay(events: &[Event], assembly: &Assembly, state: &mut State, time_ns: f64) {
    let Some(kinetics) = &assembly.kinetics else {
        return;
    };
    for event in events.iter().take_while(|e| e.time_ns <= time_ns) {
        let Some((linker, places_nm)) = kinetics.linker(event.linker) else {
            continue;
        };
        match event.what {
            LinkerEventKind::Broke | LinkerEventKind::Left => linker.release(state),
            LinkerEventKind::Formed | LinkerEventKind::Stepped => {
                let distance = |place: &usize| (places_nm[*place] - event.at_nm).abs();
                let nearest =
                    (0..places_nm.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
                linker.bind(state, nearest.unwrap_or(0));
            }
        }
    }
}
