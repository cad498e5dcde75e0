//! The documents agree with the committed report, and what does not is found.

use super::*;
use actin_draw::report::Row;

fn report() -> Report {
    let row = |quantity: &str, ours| Row::measured("fig8", quantity, "", ours, "");
    by_name(vec![
        row("height/rod", 36.7449).against(36.0, 1.0),
        row("height/ellipsoids", 34.53),
        row("spread", 0.029_16),
    ])
}

const TEXT: &str = "\
At most 36.74 nm <!-- fig8:height/rod --> (the paper: 36 <!-- fig8:height/rod@paper -->), by
2.9 % <!-- fig8:spread --> of nm^2; `1.0` is not marked.
<!-- columns: rod, _, ellipsoids; in 1e1 -->
| height | rod | seeds | monomers |
|---|---|---|---|
| all <!-- fig8:height/* --> | 3.674 ± 0.1 | 8 | **3.453** |
| some <!-- fig8:height/* --> | | | 3.5 |

<!-- columns: , @paper, @verdict -->
| one <!-- fig8:height/rod* --> | 37 | 36 | **yes** |
";

fn wrong(text: &str) -> Vec<String> {
    let marks = marks("a.md", text).unwrap();
    let found = marks.iter();
    found
        .filter_map(|m| finding("a.md", m, &report()))
        .collect()
}

/// Every kind of mark is read and holds; changed digits are told with their place.
#[test]
fn marks_are_held_to_the_report() {
    assert_eq!(marks("a.md", TEXT).unwrap().len(), 9);
    assert_eq!(wrong(TEXT), Vec::<String>::new());
    let stale = TEXT.replace("36.74", "36.75").replace("3.453", "3.461");
    let stale = stale.replace("**yes**", "no");
    assert_eq!(
        wrong(&stale),
        [
            "a.md:1: fig8:height/rod reads 36.75, the report says 36.74",
            "a.md:6: fig8:height/ellipsoids reads 3.461, the report says 3.453",
            "a.md:10: fig8:height/rod@verdict reads no, the report says yes",
        ]
    );
    let unknown = "1 <!-- fig8:height/none -->";
    assert_eq!(
        wrong(unknown),
        ["a.md:1: fig8:height/none: no such row in the report"]
    );
}

#[test]
fn marks_that_mark_nothing_are_errors() {
    assert!(marks("a.md", "none <!-- fig8:spread -->").is_err());
    assert!(marks("a.md", "| a <!-- fig8:height/* --> | 1 |").is_err());
    let cells = "<!-- columns: rod -->\n| a <!-- fig8:height/* --> | 1 | 2 |";
    assert!(marks("a.md", cells).is_err());
    assert_eq!(marks("a.md", "1 <!-- a remark: no mark -->").unwrap(), []);
}

/// Writing replaces what is stale and nothing else.
#[test]
fn stale_numbers_are_replaced() {
    let stale = TEXT.replace("36.74", "99.99").replace("**yes**", "**no**");
    assert_eq!(updated("a.md", &stale, &report()).unwrap(), TEXT);
}

/// The documents of this workspace are what its report says.
#[test]
fn the_documents_agree_with_the_report() {
    let root = workspace_root();
    let rows = by_name(report::read(&root.join(REFERENCE)).unwrap());
    let (checked, findings) = findings(&root, &rows).unwrap();
    assert!(findings.is_empty(), "{}", findings.join("\n"));
    assert!(checked > 300, "only {checked} numbers are marked");
}
