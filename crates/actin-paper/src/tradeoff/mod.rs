//! What a user gives up in accuracy for each saving in time.
//!
//! For each scene of `actin_sim::advice::scenes` the settings that a user can vary, one at a time and
//! some together, against the same filament with every monomer resolved; then integrators, steps and
//! damped motion on the cantilever. The advice drawn from it is in `docs/tradeoff.md`.

mod motions;
mod observe;
mod pareto;
mod picture;
mod print;
mod rates;
mod row;
mod solve;
mod statics;
mod study;
#[cfg(test)]
mod tests;

use crate::Tell;
use actin_sim::{Integrator, Task};
use picture::Picture;
use row::Row;
use std::fs;
use std::path::{Path, PathBuf};

/// The name under which rates are measured, which no run of all does.
const RATES: &str = "rates";

/// Time of a short motion (ns).
const SHORT_NS: f64 = 2.0;

/// What is measured, and where it goes.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which: names of scenes, `vibration`, `rest`; all by default. `rates` measures how fast loads
    /// and Newton steps go.
    pub scenes: Vec<String>,
    /// Where to write tables and pictures.
    pub out: PathBuf,
    /// Fewer settings, azimuths and samplings.
    pub quick: bool,
}

/// The scenes of all studies in all their settings, with the first sampling of the bonds, as texts with
/// their names; of the reference a short motion as well.
pub fn scenes(quick: bool) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for study in study::studies(&[], quick) {
        for (factor, setting, resolved) in &study.settings {
            let mut scene = solve::scene(&study, resolved, 0);
            let name = format!("{} {setting}", study.name);
            all.push((name.clone(), scene.to_ron()));
            if matches!(
                factor,
                study::Factor::Reference | study::Factor::ShareHomogenised
            ) {
                let motion = solve::motion(SHORT_NS, Integrator::default(), None);
                scene.path.clear();
                scene.task = Task::Dynamics(motion);
                all.push((format!("{name}, moved"), scene.to_ron()));
            }
        }
    }
    all
}

/// Measures, writes, draws and tells.
///
/// # Errors
/// A scene that is not known or cannot be solved, and a file that cannot be written.
pub fn run(options: &Options, tell: Tell<'_>) -> Result<(), String> {
    let known: Vec<&str> = study::names()
        .into_iter()
        .chain([motions::VIBRATION, motions::REST, RATES])
        .collect();
    if let Some(unknown) = options
        .scenes
        .iter()
        .find(|name| !known.contains(&name.as_str()))
    {
        return Err(format!(
            "no scene `{unknown}`: there is {}",
            known.join(", ")
        ));
    }
    if options.scenes.iter().any(|name| name == RATES) {
        return rates::print(tell);
    }
    let out = &options.out;
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let rows = rows(options, tell)?;
    row::write(&rows, out)?;
    print::write_advice(&rows, out)?;
    tell(format_args!(
        "written: {}",
        out.join("tradeoff.json").display()
    ));
    Ok(())
}

/// All rows that are asked for, printed and drawn scene by scene.
fn rows(options: &Options, tell: Tell<'_>) -> Result<Vec<Row>, String> {
    let names = &options.scenes;
    let wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    let mut all = Vec::new();
    for study in study::studies(names, options.quick) {
        let rows = statics::rows(&study)?;
        show(&rows, &options.out, tell)?;
        all.extend(rows);
    }
    for (name, measure) in [
        (motions::VIBRATION, motions::vibration as fn(bool) -> _),
        (motions::REST, motions::rest),
    ] {
        if wanted(name) {
            let rows: Vec<Row> = measure(options.quick)?;
            show(&rows, &options.out, tell)?;
            all.extend(rows);
        }
    }
    Ok(all)
}

fn show(rows: &[Row], out: &Path, tell: Tell<'_>) -> Result<(), String> {
    print::table(rows, tell);
    let Some(first) = rows.first() else {
        return Ok(());
    };
    let (name, azimuths) = (&first.scene, first.azimuths);
    let title = |what: &str| format!("{name}: {what}, rms over {azimuths} azimuth(s)");
    let displacement = Picture {
        title: &title("error of the displacement"),
        y_label: "relative error of the displacement",
        rows,
        error: |row| row.error_displacement,
        scatter: |row| row.scatter_displacement,
    };
    picture::draw(&displacement, &out.join(format!("{name}.svg")))?;
    let energy = Picture {
        title: &title("error of the energy"),
        y_label: "relative error of the elastic energy",
        error: |row| row.error_energy,
        scatter: |row| row.scatter_energy,
        ..displacement
    };
    picture::draw(&energy, &out.join(format!("{name}_energy.svg")))?;
    let local = Picture {
        title: &title("error of the local field"),
        y_label: "relative error of curvature or twist at the site",
        error: |row| row.error_local,
        scatter: |row| row.scatter_local,
        ..displacement
    };
    picture::draw(&local, &out.join(format!("{name}_local.svg")))
}
