//! The rod's law against filaments of monomers: what `cargo xtask load-cases` measures, as rows with verdicts.

use super::{Run, surface};
use crate::load_cases;
use actin_draw::report::{Artefact, Picture, Row, write_csv};
use std::time::Instant;

/// The artefact.
const ID: &str = "law";
/// The law that is judged.
const LAW: &str = "Homogenised";

/// All load cases under the law.
pub(super) fn reproduce(run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let done = || {
        run.progress.expect(1);
        run.progress.done();
    };
    let compared = load_cases::compared(LAW, run.quick, run.out, &done)?;
    let columns = ["case", "quantity", "rod", "monomers", "largest_difference"];
    let cells = compared.iter().map(|(case, quantity, row)| {
        let number = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:.6e}"));
        let numbers = [Some(row.ours), row.paper, row.tolerance].map(number);
        [vec![case.clone(), quantity.clone()], numbers.into()].concat()
    });
    write_csv(run.out, "law.csv", &columns, cells)?;
    let mut pictures = vec![Picture {
        file: "load-cases.svg".to_owned(),
        caption: "Errors of the rod against the mean filament, over their bounds.".to_owned(),
    }];
    pictures.extend(surface::draw(run.out)?);
    Ok(Artefact {
        id: ID,
        title: "The law of the rod in load cases that entered nothing",
        settings: format!(
            "law {LAW}, segments of 10 nm, beside the mean filament and, in notes, filaments of 64 drawn bonds; \
             equilibria at the end of the same path; bounds as in docs/tables/load-cases.md"
        ),
        rows: compared.into_iter().map(named).collect(),
        pictures,
        views: Vec::new(),
        wall_s: started.elapsed().as_secs_f64(),
    })
}

fn named((case, quantity, row): (String, String, Row)) -> Row {
    Row {
        quantity: format!("{}/{}", slug(&case), slug(&quantity)),
        ..row
    }
}

/// A name of letters, digits, signs and points in which anything else is one dash.
fn slug(name: &str) -> String {
    let kept = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
    let words = name.split(|c| !kept(c)).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names of rows are contracts: paths without blanks.
    #[test]
    fn names_are_paths() {
        let name = slug("160 nm, tension 0 pN") + "/" + &slug("tip at 0.05 pN (nm)");
        assert_eq!(name, "160-nm-tension-0-pN/tip-at-0.05-pN-nm");
    }
}
