//! Which bonds the monomers have. The shortest bond that is accepted, and
//! weighted bonds beside drawn ones, on the paper's tables, on some of its figures, in motion and in
//! heat: as tables, and as the page `docs/tables/bonds.md`.

mod figures;
mod heat;
mod motion;
mod page;
mod study;
mod tables;
mod variant;

pub(crate) use heat::persistence_length_um;

use crate::{Tell, workspace_root};
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

/// What is computed, and where it goes.
#[derive(Clone, Debug)]
pub struct Options {
    /// Where to write tables.
    pub out: PathBuf,
    /// Four samplings instead of 16, and a tenth of the motion.
    pub quick: bool,
    /// Samplings of drawn bonds.
    pub samplings: Option<u64>,
    /// Parts to compute, all if none is named.
    pub parts: Vec<Part>,
    /// Also into `docs/tables/bonds.md`.
    pub write: bool,
}

/// A part of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Tables 3 to 5 against the shortest bond, the number of bonds, rise and radius.
    Shortest,
    /// Tables 3 to 5 against the number of weighted bonds.
    Weighted,
    /// Some of the paper's figures against the number of weighted bonds.
    Figures,
    /// Time step and energy drift.
    Motion,
    /// Stiffness at room temperature.
    Heat,
}

impl Part {
    const ALL: [Self; 5] = [
        Self::Shortest,
        Self::Weighted,
        Self::Figures,
        Self::Motion,
        Self::Heat,
    ];

    /// Name in files and in the marks of the page.
    fn name(self) -> &'static str {
        match self {
            Self::Shortest => "shortest",
            Self::Weighted => "weighted",
            Self::Figures => "figures",
            Self::Motion => "motion",
            Self::Heat => "heat",
        }
    }
}

/// How much is computed.
#[derive(Clone, Copy, Debug)]
struct Effort {
    /// Samplings of drawn bonds.
    samplings: u64,
    /// Motion and samples are divided by this.
    fraction: u32,
}

/// Computes the parts, prints their tables and writes them.
///
/// # Errors
/// A file that cannot be written, and a filament that has no equilibrium.
pub fn run(options: &Options, tell: Tell<'_>) -> Result<(), String> {
    let out = &options.out;
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let usual = if options.quick { 4 } else { 16 };
    let effort = Effort {
        samplings: options.samplings.unwrap_or(usual),
        fraction: if options.quick { 10 } else { 1 },
    };
    let is_wanted = |part: &Part| options.parts.is_empty() || options.parts.contains(part);
    for part in Part::ALL.into_iter().filter(is_wanted) {
        let clock = Instant::now();
        let table = match part {
            Part::Shortest => study::shortest(effort)?,
            Part::Weighted => study::weighted(effort)?,
            Part::Figures => figures::table(effort)?,
            Part::Motion => motion::table(effort)?,
            Part::Heat => heat::table(effort)?,
        };
        tell(format_args!("{}", table.markdown()));
        tell(format_args!(
            "{}: {:.0} s\n",
            part.name(),
            clock.elapsed().as_secs_f64()
        ));
        table.write_csv(out, part.name())?;
        if options.write {
            let document = workspace_root().join("docs/tables/bonds.md");
            page::replace(&document, part.name(), &table.markdown())?;
        }
    }
    Ok(())
}
