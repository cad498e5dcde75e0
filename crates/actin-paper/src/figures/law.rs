//! Rods compared with filaments of monomers in the load cases of `cargo xtask load-cases`.

use super::draft::{Column, Draft, number, text};
use crate::load_cases;
use actin_draw::report::{Picture, Row};

const LAW: &str = "Homogenised";

const COLUMNS: [Column<(String, String, Row)>; 5] = [
    ("case", |(case, _, _)| case.clone()),
    ("quantity", |(_, quantity, _)| quantity.clone()),
    ("rod", |(_, _, row)| number(row.ours)),
    ("monomers", |(.., row)| text(row.paper.map(number))),
    ("largest_difference", |(.., row)| {
        text(row.tolerance.map(number))
    }),
];

pub(super) fn law(draft: &mut Draft<'_>) -> Result<(), String> {
    let done = || {
        draft.progress.expect(1);
        draft.progress.done();
    };
    let compared = load_cases::compared(LAW, draft.quick, draft.out, &done)?;
    draft.table("law.csv", &compared, &COLUMNS)?;
    draft.describe("law", &[("law", &LAW)])?;
    for (case, quantity, row) in compared {
        let quantity = format!("{}/{}", slug(&case), slug(&quantity));
        draft.compared(Row { quantity, ..row });
    }
    draft.pictures.push(Picture {
        file: "load-cases.svg".to_owned(),
        caption: "Errors of the rod relative to the mean filament, divided by their bounds."
            .to_owned(),
    });
    Ok(())
}

/// Replaces each run of characters other than letters, digits, signs and points by a dash.
fn slug(name: &str) -> String {
    let kept = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
    let words = name.split(|c| !kept(c)).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names of rows are stable paths without spaces.
    #[test]
    fn names_are_paths() {
        let name = slug("160 nm, tension 0 pN") + "/" + &slug("tip at 0.05 pN (nm)");
        assert_eq!(name, "160-nm-tension-0-pN/tip-at-0.05-pN-nm");
    }
}
