//! Comparison of rod laws with filaments of monomers: the error in each load case and its bound.
//!
//! Equilibria of monomers are cached in the output folder.

mod beyond;
mod case;
mod ends;
mod filament;
mod mixed;
mod quantities;
mod row;
mod solve;
mod thermal;
mod write;

pub(crate) use quantities::compared;

use crate::ProgressSink;
use actin_draw::report::{save, write_atomically};
use actin_sim::{Monomers as Model, RodLaw};
use case::Case;
use filament::FilamentModel;
use rayon::prelude::*;
use row::{Monomers, Rods, Row};
use serde::{Deserialize, Serialize};
use solve::{CaseSolution, solve};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Subject and output of the study: the command line of `cargo xtask load-cases`.
#[expect(clippy::struct_excessive_bools, reason = "flags of a command line")]
#[derive(clap::Args, Clone, Debug)]
pub struct Options {
    /// Names of laws, as in scenes.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "Constant,Fitted,Homogenised"
    )]
    pub laws: Vec<String>,
    /// Output folder of tables and figures; existing equilibria of monomers are reused.
    #[arg(long, default_value = "target/load-cases")]
    pub out: PathBuf,
    /// Uses fewer cases, azimuths and samples.
    #[arg(long)]
    pub quick: bool,
    /// Also writes the committed file: `docs/tables/load-cases.md` or, with `--beyond`, the table of the program.
    #[arg(long, conflicts_with = "quick")]
    pub write: bool,
    /// Measures the length correction at the ends of short spans instead.
    #[arg(long, conflicts_with = "write")]
    pub ends: bool,
    /// Measures errors of cantilevers beyond the range of the law `Homogenised` instead, for its warning.
    #[arg(long, conflicts_with = "ends")]
    pub beyond: bool,
}

const PAGE: &str = "load-cases.md";
const SAMPLINGS: u64 = 8;
const QUICK_SAMPLINGS: u64 = 2;

type Law = (String, RodLaw);

/// Measures, writes and draws.
///
/// # Errors
/// An unknown law, or a file that cannot be written.
pub fn run(options: &Options, tell: ProgressSink<'_>) -> Result<(), String> {
    let named = |name: &String| Ok((name.clone(), filament::law(name)?));
    let laws: Result<Vec<Law>, String> = options.laws.iter().map(named).collect();
    let laws = laws?;
    if options.ends {
        return ends::run(&options.out, &laws, tell);
    }
    if options.beyond {
        return beyond::run(&options.out, options.write, tell);
    }
    let clock = Instant::now();
    let rows = measured(&options.out, &laws, options.quick, tell)?;
    write::csv(&options.out, &rows)?;
    let page = write::page(&rows);
    save(&options.out, PAGE, &page)?;
    write::picture(&options.out, &rows)?;
    if options.write {
        save(&crate::workspace_root().join("docs/tables"), PAGE, &page)?;
    }
    tell(format_args!("{}", write::summary(&rows)));
    let seconds = clock.elapsed().as_secs_f64();
    tell(format_args!(
        "{} rows in {seconds:.0} s: {}",
        rows.len(),
        options.out.display()
    ));
    Ok(())
}

/// The rows of all cases under all laws, in the order of the table.
fn measured(
    out: &Path,
    laws: &[Law],
    quick: bool,
    tell: ProgressSink<'_>,
) -> Result<Vec<Row>, String> {
    let cases = case::all(quick);
    let clock = Instant::now();
    let timed = |name: &str, since: Instant| {
        let seconds = since.elapsed().as_secs_f64();
        tell(format_args!("{name}: {seconds:.0} s"));
    };
    let monomers = monomers(Some(&folder(out)?), &cases, quick, &|error| {
        if let Some(error) = error {
            tell(format_args!("{error}"));
        }
    })?;
    timed("monomers", clock);
    let mut rows = Vec::new();
    for law in laws {
        let clock = Instant::now();
        rows.extend(of_law(law, &cases, &monomers, (quick, false)));
        timed(&law.0, clock);
    }
    // Sorts by group, case and quantity in order of occurrence, then by law.
    let named = |row: &Row| (row.group, row.case.clone(), row.quantity.clone());
    let names: Vec<_> = rows.iter().map(named).collect();
    let first = |row: &Row| names.iter().position(|name| *name == named(row));
    rows.sort_by_key(|row| (row.group, first(row)));
    Ok(rows)
}

/// The rows of all cases under one law. `only_coarse` computes only segments of 10 nm against the mean
/// filament, without trajectories in a quick run.
fn of_law(
    (name, law): &Law,
    cases: &[Case],
    monomers: &[Monomers],
    (quick, only_coarse): (bool, bool),
) -> Vec<Row> {
    let rods = |case: &Case| -> Rods {
        let coarse = solve(case, &FilamentModel::coarse(law));
        if only_coarse {
            let missing = || Err("not computed".to_owned());
            return [coarse, missing(), missing()];
        }
        // Only these laws depend on the bonds.
        let of_drawn = match law {
            RodLaw::Homogenised | RodLaw::HomogenisedAthermal => {
                solve(case, &FilamentModel::rod_of_sampled_bonds(law))
            }
            _ => coarse.clone(),
        };
        [coarse, solve(case, &FilamentModel::fine(law)), of_drawn]
    };
    let rods: Vec<Rods> = cases.par_iter().map(rods).collect();
    let mut rows = Vec::new();
    for ((case, monomers), rods) in cases.iter().zip(monomers).zip(&rods) {
        rows.extend(row::rows(case.group, &case.name, name, monomers, rods));
    }
    rows.extend(mixed::rows(name, law, quick));
    if !(quick && only_coarse) {
        rows.extend(thermal::rows(name, law, quick));
    }
    rows
}

/// Computes filaments of monomers under all cases in parallel, with cached equilibria. `done` is
/// called for each, with the error of a new one without an equilibrium.
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
    let jobs: Vec<(usize, FilamentModel)> = jobs.collect();
    let solved = jobs.par_iter().map(|(i, made)| {
        let (outcome, was_there) = cached(folder, &cases[*i], made)?;
        let new_error = outcome.as_ref().err().filter(|_| !was_there);
        done(new_error.map(String::as_str));
        Ok(outcome)
    });
    let solved = solved.collect::<Result<Vec<_>, String>>()?;
    let mut all = vec![Monomers::default(); cases.len()];
    for ((i, made), outcome) in jobs.into_iter().zip(solved) {
        let own = &mut all[i];
        match outcome {
            Ok(found) if made.is_drawn() => own.drawn.push(found),
            Ok(found) => own.mean.push(found),
            Err(error) => own.failures.push(error),
        }
    }
    Ok(all)
}

/// The mean filament at its azimuths, and samplings at theirs, rotated by an offset for each
/// sampling.
fn filaments(case: &Case, samplings: u64, quick: bool) -> Vec<FilamentModel> {
    let [mean, drawn] = case.azimuths_deg(quick);
    let drawn = (0..samplings).flat_map(|seed| {
        let turned = seed as f64 * 360.0 / samplings as f64;
        let azimuths = drawn.clone().into_iter();
        let azimuths = azimuths.map(move |azimuth| (azimuth + turned) % 360.0);
        azimuths.map(move |azimuth| FilamentModel::with_sampled_bonds(seed, azimuth))
    });
    let mean = mean.into_iter().map(FilamentModel::mean);
    mean.chain(drawn).collect()
}

/// Folder of the cached equilibria of monomers.
fn folder(out: &Path) -> Result<PathBuf, String> {
    let folder = out.join("monomers");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    Ok(folder)
}

/// Version of the cache; raise it if results of the same parameters change.
const VERSION: u32 = 3;

/// Cached equilibrium, or the error of a filament without one.
#[derive(Deserialize, Serialize)]
struct CachedSolution {
    key: String,
    outcome: Result<CaseSolution, String>,
}

/// Returns the equilibria of monomers from the cache, or computes them, and whether they were
/// cached. Without a folder they are computed.
fn cached(
    folder: Option<&Path>,
    case: &Case,
    made: &FilamentModel,
) -> Result<(Result<CaseSolution, String>, bool), String> {
    let Some(folder) = folder else {
        return Ok((solve(case, made), false));
    };
    let key = format!(
        "version {VERSION}, {case:?}, {made:?}, {:?}",
        Model::default()
    );
    let path = folder.join(format!("{}-{}.json", case.file(), made.name));
    let text = fs::read_to_string(&path).ok();
    let there = text.and_then(|text| serde_json::from_str::<CachedSolution>(&text).ok());
    if let Some(there) = there.filter(|there| there.key == key) {
        return Ok((there.outcome, true));
    }
    let outcome = solve(case, made);
    let cached = CachedSolution { key, outcome };
    let text = serde_json::to_string(&cached).map_err(|e| e.to_string())?;
    write_atomically(&path, &text)?;
    Ok((cached.outcome, false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use case::Group;

    #[test]
    fn cached_outcomes_are_bit_identical() {
        let folder = tempfile::tempdir().unwrap();
        let mut case = Case::guided(Group::Beside, 9.0, 5.0);
        let made = FilamentModel::mean(0.0);
        let (first, was_there) = cached(Some(folder.path()), &case, &made).unwrap();
        assert!(!was_there && first.as_ref().unwrap().values.len() == 2);
        let (again, was_there) = cached(Some(folder.path()), &case, &made).unwrap();
        assert!(was_there);
        assert_eq!(again, first);
        if let case::Loading::Forces { forces_pn, .. } = &mut case.loading {
            forces_pn.truncate(1);
        }
        let (other, was_there) = cached(Some(folder.path()), &case, &made).unwrap();
        assert!(!was_there);
        assert_eq!(other.unwrap().values, first.unwrap().values[..1]);
    }
}
