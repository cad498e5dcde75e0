//! Failed comparisons with their reasons.

use super::texts::{Reason, TEXTS};
use actin_draw::page::{ExplainedMisses, Misses};
use actin_draw::report::Row;

const OPEN: &str = "The reason of the following misses is unknown. A quick run misses more than a full run, because \
                    it has fewer samplings and resolutions.";

pub(super) fn of<'a>(rows: impl Iterator<Item = &'a Row>) -> Misses<'a> {
    let missed: Vec<&Row> = rows.filter(|row| row.pass == Some(false)).collect();
    let chosen = |is_chosen: &dyn Fn(&Row) -> bool| {
        let chosen = missed.iter().copied().filter(|row| is_chosen(row));
        chosen.collect()
    };
    let explained = TEXTS.reasons.iter().map(|reason| ExplainedMisses {
        artefact: &reason.artefact,
        title: &reason.title,
        text: &reason.text,
        rows: chosen(&|row| reason.covers(row)),
    });
    Misses {
        explained: explained.collect(),
        open: chosen(&|row| Reason::from_row(row).is_none()),
        open_note: OPEN,
    }
}

/// Messages for misses without a unique reason, and for reasons without a miss in the computed artefacts.
pub(crate) fn unexplained(rows: &[Row]) -> Vec<String> {
    let missed: Vec<&Row> = rows.iter().filter(|row| row.pass == Some(false)).collect();
    let mut all = Vec::new();
    for row in &missed {
        let count = TEXTS
            .reasons
            .iter()
            .filter(|reason| reason.covers(row))
            .count();
        if count != 1 {
            let (artefact, quantity) = (row.artefact, &row.quantity);
            all.push(format!(
                "{artefact}:{quantity} is missed and has {count} reasons"
            ));
        }
    }
    let is_run = |reason: &&Reason| rows.iter().any(|row| row.artefact == reason.artefact);
    for reason in TEXTS.reasons.iter().filter(is_run) {
        if !missed.iter().any(|row| reason.covers(row)) {
            all.push(format!(
                "{}: no row is missed for the reason: {}",
                reason.artefact, reason.title
            ));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace_root;
    use actin_draw::report;

    #[test]
    fn misses_and_reasons_match() {
        let rows = report::read(&workspace_root().join("docs/report.json")).unwrap();
        let open = unexplained(&rows);
        assert!(open.is_empty(), "{}", open.join("\n"));
        let miss =
            |quantity| Row::measured("fig1", quantity, "nm", 1.0, "").with_paper_value(2.0, 0.5);
        let told = unexplained(&[miss("a"), miss("b")]);
        assert_eq!(told.len(), 2);
        assert_eq!(told[1], "fig1:b is missed and has 0 reasons");
    }

    /// Guards against prefixes: 10 deg must not match 100 deg.
    #[test]
    fn names_are_matched_completely() {
        let row = |artefact, quantity: &str| Row::measured(artefact, quantity, "", 0.0, "");
        assert!(Reason::from_row(&row("table3", "b3/under/10")).is_some());
        assert!(Reason::from_row(&row("table3", "b3/length-14/under/10")).is_none());
        assert!(Reason::from_row(&row("table4", "s3")).is_some());
        assert!(Reason::from_row(&row("table4", "s3_over_ea")).is_none());
        assert!(Reason::from_row(&row("table5", "dl_over_l/under/100")).is_some());
        assert!(Reason::from_row(&row("table4", "s1/secant/0.01")).is_none());
        assert!(Reason::from_row(&row("fig8", "couple/over/180/rod")).is_none());
    }

    #[test]
    fn numbers_in_texts_agree_with_the_report() {
        let rows = report::read(&workspace_root().join("docs/report.json")).unwrap();
        let row = |artefact: &str, quantity: &str| {
            let mut found = rows.iter().filter(|row| row.artefact == artefact);
            found.find(|row| row.quantity == quantity).unwrap()
        };
        let says = |artefact: &str, quantity: &str, text: &str| {
            Reason::from_row(row(artefact, quantity))
                .unwrap()
                .text
                .contains(text)
        };
        let printed = "claim/printed_deflection";
        let text = format!("gives {:.1} nm", row("fig4", printed).ours);
        assert!(says("fig4", printed, &text), "{text}");
        let text = format!("gives {:.0} nm", row("fig4", "tip_drop/rod").ours);
        assert!(says("fig4", printed, &text), "{text}");
        let within = |artefact: &str, path: &str, middle: f64| {
            let is_mixed = |row: &&Row| {
                let name = row.quantity.strip_prefix(path);
                row.artefact == artefact && name.is_some_and(|name| name.starts_with("rod-"))
            };
            let mut mixed = rows.iter().filter(is_mixed).peekable();
            assert!(mixed.peek().is_some());
            mixed.all(|row| (row.ours - middle).abs() <= 1.0)
        };
        assert!(within("fig8", "height/under/180/", 39.0));
        let under = "claim/height_grows_with_rod/under/180";
        assert!(says("fig8", under, "within 1 nm of 39 nm"));
    }

    #[test]
    fn rows_named_in_texts_exist() {
        let rows = report::read(&workspace_root().join("docs/report.json")).unwrap();
        for reason in &TEXTS.reasons {
            let named = reason.text.split(&[' ', '(', ')', ',']);
            for path in named.filter(|word| word.contains('/')) {
                let start = path.trim_end_matches('.');
                let is_there =
                    |row: &Row| row.artefact == reason.artefact && row.quantity.starts_with(start);
                assert!(rows.iter().any(is_there), "{path}: {}", reason.title);
            }
        }
    }
}
