//! A rod's laws against filaments of monomers, load case by load case: how far each is off, and whether that
//! is within what is asked of a law.
//!
//! Cases, bounds and protocols are fixed before any law is looked at (`bound.rs`, `case.rs`). Equilibria of
//! monomers are kept in the folder of results, so that another law costs its rods only.

mod beyond;
mod bound;
mod case;
mod compared;
mod ends;
mod filament;
mod junctions;
mod mixed;
mod picture;
mod row;
mod solve;
mod store;
mod thermal;
mod write;

pub(crate) use compared::{Compared, compared};

use crate::Tell;
use actin_sim::RodLaw;
use bound::Group;
use case::Case;
use filament::{Made, Rod};
use rayon::prelude::*;
use row::{Monomers, Rods, Row};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What is measured, and where it goes.
#[derive(Clone, Debug)]
pub struct Options {
    /// Where to write tables and pictures, and to keep equilibria of monomers.
    pub out: PathBuf,
    /// Fewer cases, azimuths and samplings.
    pub quick: bool,
    /// Laws by the names that scenes use.
    pub laws: Vec<String>,
    /// Also into `docs/tables/load-cases.md`.
    pub write: bool,
    /// What is measured.
    pub subject: Subject,
}

/// Subject of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Subject {
    /// All load cases.
    Cases,
    /// Length that is missing at the ends of short spans.
    Ends,
    /// Errors of cantilevers that leave the data of `Homogenised`.
    BeyondData,
}

/// Samplings of drawn bonds.
const SAMPLINGS: u64 = 8;
const QUICK_SAMPLINGS: u64 = 2;

/// A law with its name.
type Law = (String, RodLaw);

/// Measures, writes, draws and tells.
///
/// # Errors
/// A law that scenes do not know, and a file that cannot be written.
pub fn run(options: &Options, tell: Tell<'_>) -> Result<(), String> {
    let named = |name: &String| Ok((name.clone(), filament::law(name)?));
    let laws: Vec<Law> = options
        .laws
        .iter()
        .map(named)
        .collect::<Result<_, String>>()?;
    if options.subject == Subject::Ends {
        return ends::run(&options.out, &laws, tell);
    }
    if options.subject == Subject::BeyondData {
        return beyond::run(&options.out, options.write, tell);
    }
    let clock = Instant::now();
    let rows = measured(&options.out, &laws, options.quick, tell)?;
    write::csv(&options.out, &rows)?;
    let page = write::page(&rows);
    write::page_into(&options.out, &page)?;
    picture::draw(&options.out, &rows)?;
    if options.write {
        write::page_into(&crate::workspace_root().join("docs/tables"), &page)?;
    }
    write::tell_summary(&rows, tell);
    let seconds = clock.elapsed().as_secs_f64();
    tell(format_args!(
        "{} rows in {seconds:.0} s: {}",
        rows.len(),
        options.out.display()
    ));
    Ok(())
}

/// The rows of all cases under all laws, in the order of the table.
fn measured(out: &Path, laws: &[Law], quick: bool, tell: Tell<'_>) -> Result<Vec<Row>, String> {
    let folder = out.join("monomers");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let cases = case::all(quick);
    let clock = Instant::now();
    let monomers = monomers(Some(&folder), &cases, quick, &|error| {
        if let Some(error) = error {
            tell(format_args!("{error}"));
        }
    })?;
    tell(format_args!(
        "monomers: {:.0} s",
        clock.elapsed().as_secs_f64()
    ));
    let mut rows = Vec::new();
    for (name, law) in laws {
        let clock = Instant::now();
        let rods: Vec<Rods> = cases.par_iter().map(|case| of_rods(case, law)).collect();
        for ((case, monomers), rods) in cases.iter().zip(&monomers).zip(&rods) {
            rows.extend(row::rows(case.group, &case.name, name, monomers, rods));
        }
        rows.extend(mixed::rows(name, law, quick));
        rows.extend(thermal::rows(name, law, quick));
        tell(format_args!(
            "{name}: {:.0} s",
            clock.elapsed().as_secs_f64()
        ));
    }
    // By group, case and quantity, in the order in which they came, laws beside each other.
    let place = |row: &Row| Group::ALL.iter().position(|group| *group == row.group);
    let names: Vec<(String, String)> = rows.iter().map(named).collect();
    let first = |row: &Row| names.iter().position(|name| *name == named(row));
    rows.sort_by_key(|row| (place(row), first(row)));
    Ok(rows)
}

fn named(row: &Row) -> (String, String) {
    (
        format!("{:?} {}", row.group, row.case),
        row.quantity.clone(),
    )
}

fn of_rods(case: &Case, law: &RodLaw) -> Rods {
    let solved = |rod: Rod| solve::solve(case, &Made::Rod(rod));
    let coarse = solved(Rod::coarse(law));
    // Other laws know nothing of bonds.
    let of_drawn = match law {
        RodLaw::Homogenised | RodLaw::HomogenisedAthermal => solved(Rod::of_drawn(law)),
        _ => coarse.clone(),
    };
    [coarse, solved(Rod::fine(law)), of_drawn]
}

/// Filaments of monomers under all cases, side by side; what is in the folder is not computed again. `done` is
/// told of each, and of new ones without an equilibrium why.
fn monomers(
    folder: Option<&Path>,
    cases: &[Case],
    quick: bool,
    done: &(dyn Fn(Option<&str>) + Sync),
) -> Result<Vec<Monomers>, String> {
    let samplings = if quick { QUICK_SAMPLINGS } else { SAMPLINGS };
    let jobs = cases.iter().enumerate().flat_map(|(i, case)| {
        let filaments = filaments(case, samplings, quick).into_iter();
        filaments.map(move |made| (i, made))
    });
    let jobs: Vec<(usize, Made)> = jobs.collect();
    let solved = jobs.par_iter().map(|(i, made)| {
        let (outcome, was_there) = store::kept(folder, &cases[*i], made)?;
        let new_error = outcome.as_ref().err().filter(|_| !was_there);
        done(new_error.map(String::as_str));
        Ok(outcome)
    });
    let solved = solved.collect::<Result<Vec<_>, String>>()?;
    let mut all = vec![
        Monomers {
            mean: Vec::new(),
            drawn: Vec::new(),
            failures: Vec::new(),
        };
        cases.len()
    ];
    for ((i, made), outcome) in jobs.into_iter().zip(solved) {
        let own = &mut all[i];
        match (outcome, made) {
            (Ok(found), Made::Mean { .. }) => own.mean.push(found),
            (Ok(found), _) => own.drawn.push(found),
            (Err(error), _) => own.failures.push(error),
        }
    }
    Ok(all)
}

/// The mean filament at its azimuths, and samplings at theirs, each sampling turned further round.
fn filaments(case: &Case, samplings: u64, quick: bool) -> Vec<Made> {
    let [mean, drawn] = case.azimuths_deg(quick);
    let mean = mean
        .into_iter()
        .map(|azimuth_deg| Made::Mean { azimuth_deg });
    let drawn = (0..samplings).flat_map(|seed| {
        let turned = seed as f64 * 360.0 / samplings as f64;
        let azimuths = drawn.clone().into_iter();
        azimuths.map(move |azimuth| Made::Drawn {
            seed,
            azimuth_deg: (azimuth + turned) % 360.0,
        })
    });
    mean.chain(drawn).collect()
}
