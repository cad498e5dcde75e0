//! The head of the page: what decides a verdict, and how many expected numbers are met, by where they come
//! from: first what the paper prints, table by table, then what it says, then the rest.

use crate::figures::bounds::RULE;
use actin_draw::page::{Verdicts, escape, name, push};
use actin_draw::report::{Artefact, Origin, Row};

/// Where expected numbers come from, and what the page says of it.
const GROUPS: [(Origin, &str); 6] = [
    (
        Origin::Paper,
        "Numbers that the paper prints, beside simulated ones",
    ),
    (
        Origin::Derived,
        "Numbers that the paper prints, beside what follows from others that it prints (no simulation)",
    ),
    (Origin::Words, "Statements of the paper in words"),
    (Origin::Theory, "Theory"),
    (
        Origin::CrossCheck,
        "Cross-checks: an earlier calculation that shares this code's modelling decisions",
    ),
    (
        Origin::Bound,
        "Checks of the calculation, and bounds set here",
    ),
];

/// Writes the rule and the counts.
pub(super) fn write(page: &mut String, artefacts: &[Artefact]) {
    let mut lines = String::new();
    for (origin, title) in GROUPS {
        group(&mut lines, artefacts, origin, title);
    }
    if lines.is_empty() {
        return;
    }
    page.push_str(
        "<h2>What agrees</h2>\n<p>One rule decides in all figures and tables. A printed number is met \
         within half a unit of its last digit and, where bonds are drawn, twice the standard deviation of a \
         single filament; shapes called alike within 1.8 nm, the radius of the helix; numbers called alike \
         within 10 %, which the paper calls a difference itself; an order by its sign.</p>\n\
         <details><summary>The rule in full, and what is not judged</summary><dl>",
    );
    for (of, bound) in RULE {
        let (of, bound) = (escape(of), escape(bound));
        push(page, format_args!("<dt>{of}</dt><dd>{bound}.</dd>"));
    }
    push(
        page,
        format_args!(
            "</dl><p class=\"soft\">Not judged, and not counted: numbers copied from the paper, variants of its \
             models, what cannot come out otherwise, and twist of 360 deg.</p></details>\n\
             <table class=\"verdicts\"><thead><tr><th>expected</th><th class=\"n\">met</th>\
             <th class=\"n\">of</th><th>not met</th></tr></thead><tbody>\n{lines}</tbody></table>\n"
        ),
    );
}

/// One line for all artefacts and, of what the paper says, one for each.
fn group(page: &mut String, artefacts: &[Artefact], origin: Origin, title: &str) {
    let judged = |a: &Artefact| -> Vec<Row> {
        let rows = a.rows.iter().filter(|row| row.origin == Some(origin));
        rows.filter(|row| row.pass.is_some()).cloned().collect()
    };
    let each: Vec<(&str, Vec<Row>)> = artefacts.iter().map(|a| (a.id, judged(a))).collect();
    let each: Vec<_> = each
        .into_iter()
        .filter(|(_, rows)| !rows.is_empty())
        .collect();
    let all: Vec<Row> = each.iter().flat_map(|(_, rows)| rows.clone()).collect();
    if all.is_empty() {
        return;
    }
    let title = format!("<strong>{}</strong>", escape(title));
    let is_told = matches!(origin, Origin::Paper | Origin::Derived | Origin::Words);
    line(page, &title, &all, !is_told);
    for (id, rows) in each.iter().filter(|_| is_told) {
        line(
            page,
            &format!("<a href=\"#{id}\">{}</a>", name(id)),
            rows,
            true,
        );
    }
}

fn line(page: &mut String, title: &str, rows: &[Row], with_misses: bool) {
    let verdicts = Verdicts::of(rows);
    let missed = rows.iter().filter(|row| row.pass == Some(false));
    let missed: Vec<String> = missed
        .map(|row| {
            format!(
                "<code>{}</code>",
                escape(&row.quantity).replace('/', "/<wbr>")
            )
        })
        .collect();
    push(
        page,
        format_args!(
            "<tr><td class=\"wide\">{title}</td><td class=\"n pass\" data-label=\"met\">{}</td>\
             <td class=\"n\" data-label=\"of\">{}</td><td class=\"wide\">{}</td></tr>\n",
            verdicts.agree,
            verdicts.compared(),
            if with_misses {
                missed.join(", ")
            } else {
                String::new()
            }
        ),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed numbers come first, table by table, with the names of misses; what is not judged is not counted.
    #[test]
    fn printed_numbers_come_first() {
        let row = |quantity: &str| Row::measured("table3", quantity, "", 1.0, "");
        let artefact = Artefact {
            id: "table3",
            title: "",
            settings: String::new(),
            rows: vec![
                row("link").against(1.0, 0.1).of(Origin::Theory),
                row("b3/over/10").against(1.0, 0.1),
                row("b3/over/20").against(2.0, 0.1),
                row("b3/over/220").beside(2.0, Origin::Paper),
            ],
            pictures: Vec::new(),
            views: Vec::new(),
            wall_s: 0.0,
        };
        let mut page = String::new();
        write(&mut page, &[artefact]);
        let place = |text: &str| page.find(text).unwrap();
        assert!(place("the paper prints, beside simulated") < place("Table 3</a>"));
        assert!(place("Table 3</a>") < place("Theory"));
        assert!(page.contains("data-label=\"met\">1</td><td class=\"n\" data-label=\"of\">2</td>"));
        assert!(page.contains("b3/<wbr>over/<wbr>20") && !page.contains("220"));
        let mut none = String::new();
        write(&mut none, &[]);
        assert_eq!(none, "");
    }
}
