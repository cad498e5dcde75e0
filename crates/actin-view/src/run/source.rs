//! Records of a run, from its results or its checkpoint.

use super::curves::{self, Curve};
use actin_rundir::{Checkpoints, RunDirectory, RunDirectoryError, StoredStates};
use actin_sim::mechanics::State;
use actin_sim::{Assembly, At, Plan, Records, Row, Status, Summary};
use std::io::ErrorKind::NotFound;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

pub(super) struct Source {
    pub summary: Option<Summary>,
    pub remarks: Vec<String>,
    pub curves: Vec<Curve>,
    /// Time or path parameter of each record.
    pub at: Vec<At>,
    states: States,
}

enum States {
    Stored(StoredStates),
    Checkpoint(Vec<State>),
    None,
}

impl Source {
    pub(super) fn new(path: &Path, assembly: &Assembly) -> Self {
        let mut source = Self {
            summary: None,
            remarks: Vec::new(),
            curves: Vec::new(),
            at: Vec::new(),
            states: States::None,
        };
        let directory = RunDirectory::existing(path);
        source.read_summary(&directory);
        if source.summary.is_none() && directory.has_checkpoint() {
            source.read_checkpoint(&directory, assembly);
        } else {
            source.read_results(path, &directory, assembly);
        }
        source
    }

    fn read_summary(&mut self, directory: &RunDirectory) {
        match directory.summary() {
            Ok(summary) => {
                if summary.status == Status::Interrupted {
                    self.remark(
                        "The run was interrupted: the page shows the records up to then.".into(),
                    );
                }
                if !summary.failure.is_empty() {
                    self.remark(format!("The run failed: {}.", summary.failure));
                }
                self.summary = Some(summary);
            }
            Err(RunDirectoryError::Io { source, .. }) if source.kind() == NotFound => {}
            Err(error) => self.remark(format!("{error}.")),
        }
    }

    fn read_results(&mut self, path: &Path, directory: &RunDirectory, assembly: &Assembly) {
        if self.summary.is_none() {
            self.remark(
                "There is no readable summary.json: the run has not ended, or was stopped before its \
                 first checkpoint."
                    .into(),
            );
        }
        for name in ["energies.csv", "observables.csv"] {
            let file = path.join(name);
            if !file.exists() {
                continue;
            }
            match curves::read(&file) {
                Ok(found) => self.curves.extend(found),
                Err(error) => self.remark(format!("{name} is damaged: {error}.")),
            }
        }
        match directory.stored_states(assembly) {
            Ok(Some(stored)) => {
                self.at = stored.at().to_vec();
                self.states = States::Stored(stored);
            }
            Ok(None) if !assembly.scene.output.states => self.remark(
                "The scene has output: (states: false), so that there are no states. The initial shape is \
                 shown."
                    .into(),
            ),
            Ok(None) => self.remark("states.npz is missing. The initial shape is shown.".into()),
            Err(error) => self.remark(format!("{error}. The initial shape is shown.")),
        }
    }

    fn read_checkpoint(&mut self, directory: &RunDirectory, assembly: &Assembly) {
        match checkpointed(directory, assembly) {
            Ok((at, states, curves)) => {
                self.remark(begun(&at, assembly.scene.output.states));
                (self.at, self.curves) = (at, curves);
                self.states = States::Checkpoint(states);
            }
            Err(reason) => self.remark(format!(
                "The run has not ended, and its checkpoint cannot be read: {reason}. The initial shape is shown."
            )),
        }
    }

    /// Returns the states of records `which`; `None`, with a remark, if they cannot be read.
    pub(super) fn states(&mut self, assembly: &Assembly, which: &[usize]) -> Option<Vec<State>> {
        match std::mem::replace(&mut self.states, States::None) {
            States::Stored(stored) => match stored
                .states(assembly, which.iter().copied())
                .and_then(Iterator::collect)
            {
                Ok(states) => Some(states),
                Err(error) => {
                    self.remark(format!("{error}. The initial shape is shown."));
                    self.at.clear();
                    None
                }
            },
            States::Checkpoint(states) => {
                let chosen = which.iter().filter_map(|&i| states.get(i).cloned());
                let chosen: Vec<State> = chosen.collect();
                (!chosen.is_empty()).then_some(chosen)
            }
            States::None => None,
        }
        .filter(|states| !states.is_empty())
    }

    fn remark(&mut self, text: String) {
        self.remarks.push(text);
    }
}

fn begun(at: &[At], has_states: bool) -> String {
    let Some(last) = at.last() else {
        return "The run has not ended, and has no record yet. The initial shape is shown.".into();
    };
    let place = match last {
        At::Time(time) => format!("{time:.6} ns"),
        At::Path(path) => format!("{path:.6} of its path"),
    };
    if has_states {
        let count = at.len();
        return format!(
            "The run has not ended: these are its {count} record(s) up to its last checkpoint, at {place}."
        );
    }
    format!(
        "The run has not ended: the page shows the last record before its last checkpoint, at {place}. The scene has \
         output: (states: false), so that other records have no states."
    )
}

type Checkpointed = (Vec<At>, Vec<State>, Vec<Curve>);

fn checkpointed(directory: &RunDirectory, assembly: &Assembly) -> Result<Checkpointed, String> {
    let plan = Plan::new(assembly).map_err(|problem| problem.to_string())?;
    let never = Arc::new(AtomicBool::new(false));
    let mut sink = Checkpoints::new(directory, &plan, Duration::MAX, never, |_| {});
    sink.resume(&plan).map_err(|error| error.to_string())?;
    let (mut rows, mut at, mut states) = (Vec::new(), Vec::new(), Vec::new());
    for record in sink.iter() {
        let record = record.map_err(|error| error.to_string())?;
        if let Some(state) = record.state {
            at.push(record.row.at);
            states.push(state.into_owned());
        }
        rows.push(record.row.into_owned());
    }
    Ok((at, states, curves_of(assembly, &rows)))
}

fn curves_of(assembly: &Assembly, rows: &[Row]) -> Vec<Curve> {
    let mut names: Vec<String> = [
        "at",
        "total_pn_nm",
        "potential_pn_nm",
        "kinetic_pn_nm",
        "residual_force_pn",
        "residual_torque_pn_nm",
    ]
    .map(str::to_owned)
    .into();
    names.extend(actin_sim::observed_columns(assembly));
    let numbers = |row: &Row| {
        let first = [
            row.at.value(),
            row.potential_pn_nm() + row.kinetic_pn_nm,
            row.potential_pn_nm(),
            row.kinetic_pn_nm,
            row.residual_force_pn,
            row.residual_torque_pn_nm,
        ];
        first
            .into_iter()
            .chain(row.observed.iter().copied())
            .collect()
    };
    let table: Vec<Vec<f64>> = rows.iter().map(numbers).collect();
    let column = |k: usize| table.iter().map(|row: &Vec<f64>| row[k]).collect();
    let columns = (0..names.len()).map(column).collect();
    curves::of_columns(names, columns)
}
