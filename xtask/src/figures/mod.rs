//! `cargo xtask reproduce-figures`: artefacts of the paper, computed and compared.
//!
//! Each artefact is a function that runs simulations, writes its pictures and tables into a
//! folder and returns rows that set our number beside the paper's. Nothing here is drawn from
//! anything but a simulation of that run.

mod buckling;
mod figure4;
mod figure7;
mod figure9;
mod html;
mod linked;
pub(crate) mod palette;
pub(crate) mod plot;
pub(crate) mod report;
mod scene3d;
mod schematics;
mod tables;
mod viewer;

pub(crate) use palette::{Palette, choose};
pub(crate) use tables::paper;

use report::Artefact;
use std::fs;
use std::path::Path;

/// An artefact: its name, and what computes it into a folder.
type Recipe = (&'static str, fn(&Path, bool) -> Result<Artefact, String>);

/// The artefacts that exist.
const RECIPES: [Recipe; 15] = [
    ("fig1", schematics::figure1),
    ("fig2", schematics::figure2),
    ("fig3", schematics::figure3),
    ("fig4", figure4::reproduce),
    ("fig5", linked::figure5),
    ("fig6", linked::figure6),
    ("fig7", figure7::reproduce),
    ("fig8", buckling::figure8),
    ("fig9", figure9::reproduce),
    ("fig10", buckling::figure10),
    ("table1", tables::table1),
    ("table2", tables::table2),
    ("table3", tables::table3),
    ("table4", tables::table4),
    ("table5", tables::table5),
];

/// Computes the artefacts named `ids` (all if none is named) into `out`.
pub(crate) fn reproduce(ids: &[String], out: &Path, quick: bool) -> Result<(), String> {
    let known: Vec<&str> = RECIPES.iter().map(|(id, _)| *id).collect();
    if let Some(unknown) = ids.iter().find(|id| !known.contains(&id.as_str())) {
        return Err(format!(
            "no artefact `{unknown}`: there is {}",
            known.join(", ")
        ));
    }
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let chosen = |id: &str| ids.is_empty() || ids.iter().any(|wanted| wanted == id);
    let mut artefacts = Vec::new();
    for (id, recipe) in RECIPES.into_iter().filter(|(id, _)| chosen(id)) {
        println!("{id}:");
        artefacts.push(recipe(out, quick)?);
    }
    report::write(&artefacts, out)?;
    html::write(&artefacts, out, quick)?;
    println!("written: {}", out.join("report.html").display());
    Ok(())
}
