//! How fast fixed cases run, beside what was aimed at.
//!
//! Every case goes the way of a user: a scene is assembled, and its system is stepped or solved.
//! All but ensembles run on one thread, without linkers, drag or observers. What the cases are is in `cases.rs`,
//! how motions are timed in `motion.rs`, equilibria in `equilibrium.rs`, and ensembles in `ensemble.rs`.

mod cases;
mod ensemble;
mod equilibrium;
mod motion;
mod table;

use crate::Tell;
use cases::{CASES, Case, Work};
use serde::Serialize;

/// Which cases, and how they are printed.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which; all by default.
    pub cases: Vec<String>,
    /// Prints an array of `case`, `rate`, `unit` instead of a table.
    pub json: bool,
}

/// What was measured of a case.
struct Measured {
    /// Best of the repeats: other work on the machine only ever slows one down.
    best: f64,
    /// Median of the repeats.
    median: f64,
    /// What a reader has to know.
    note: String,
}

/// One entry of the machine-readable output.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Entry {
    /// Name of the case.
    pub case: &'static str,
    /// Best of the repeats, in `unit`.
    pub rate: f64,
    /// Elements per second, seconds, or times one thread.
    pub unit: &'static str,
}

/// Measures, tells, and returns what was measured. Rates are those of the profile in which this crate
/// was compiled.
///
/// # Errors
/// A case that is not known or cannot be run.
pub fn run(options: &Options, tell: Tell<'_>) -> Result<Vec<Entry>, String> {
    let mut entries = Vec::new();
    if !options.json {
        table::head(tell);
    }
    for case in chosen(&options.cases)? {
        let measured = match case.work {
            Work::Motion(motion) => motion::measure(&motion),
            Work::Equilibrium { length_nm } => equilibrium::measure(length_nm),
            Work::Ensemble(of) => ensemble::measure(of),
        }
        .map_err(|error| format!("{}: {error}", case.name))?;
        if !options.json {
            table::row(case, &measured, tell);
        }
        entries.push(Entry {
            case: case.name,
            rate: measured.best,
            unit: case.unit(),
        });
    }
    if options.json {
        let text = serde_json::to_string_pretty(&entries).map_err(|error| error.to_string())?;
        tell(format_args!("{text}"));
    }
    Ok(entries)
}

/// The cases of these names, in the order of the list.
fn chosen(names: &[String]) -> Result<Vec<&'static Case>, String> {
    for name in names {
        if !CASES.iter().any(|case| case.name == name) {
            let known: Vec<_> = CASES.iter().map(|case| case.name).collect();
            return Err(format!(
                "no case is called {name:?}; known are {}",
                known.join(", ")
            ));
        }
    }
    let wanted = |case: &&Case| names.is_empty() || names.iter().any(|name| case.name == name);
    Ok(CASES.iter().filter(wanted).collect())
}

/// Median of some numbers.
///
/// # Panics
/// If there are none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_chosen_by_name_in_their_own_order() {
        let names = ["rod-pv-64", "rod-pv-16"].map(str::to_owned);
        let found: Vec<_> = chosen(&names).unwrap().iter().map(|c| c.name).collect();
        assert_eq!(found, ["rod-pv-16", "rod-pv-64"]);
        assert_eq!(chosen(&[]).unwrap().len(), CASES.len());
        assert!(chosen(&["rod-pv-17".to_owned()]).is_err());
    }

    /// Every ensemble has replicas that differ and run.
    #[test]
    fn ensembles_run() {
        for case in &CASES {
            if let Work::Ensemble(of) = case.work {
                let seconds = ensemble::seconds(of, 2, std::num::NonZeroUsize::MIN);
                assert!(seconds.is_ok_and(|s| s > 0.0), "{}", case.name);
            }
        }
    }

    /// What the names promise is what is built: elements of a step, and bonds.
    #[test]
    fn scenes_hold_what_their_names_say() {
        for (name, elements) in [
            ("rod-pv-16", 16),
            ("rod-pv-64x64", 4096),
            ("ellipsoid-pv-60", 1170),
            ("ellipsoid-pv-1000", 19_970),
            ("rod-fitted-pv-16", 16),
        ] {
            let case = CASES.iter().find(|case| case.name == name).unwrap();
            let Work::Motion(motion) = case.work else {
                panic!("{name} is a motion");
            };
            let systems = motion::assemble(&motion).unwrap();
            assert_eq!(motion::elements(&systems), elements, "{name}");
        }
    }
}
