//! What the run confirms of the paper and what it does not, in three sentences put together from the verdicts.

use super::reasons::{self, Cause};
use actin_draw::report::{Artefact, Row};
use maud::{Markup, html};

/// A statement of the paper that some rows of one artefact decide.
struct Finding {
    artefact: &'static str,
    /// It is confirmed if all of these agree, and not if one of them is missed.
    quantities: &'static [&'static str],
    /// A statement that can be read alone.
    confirmed: &'static str,
    /// The same statement after `that`.
    refuted: &'static str,
}

const FINDINGS: [Finding; 16] = [
    Finding {
        artefact: "table4",
        quantities: &["b1", "b3_min", "b3_max"],
        confirmed: "with the choices named below monomers have the rigidities of Table 4 in bending (at 0.01 \
                 rad/nm) and in twist (the largest of each direction)",
        refuted: "that monomers have the rigidities of Table 4 in bending (at 0.01 rad/nm) and in twist (the \
                largest of each direction)",
    },
    Finding {
        artefact: "table4",
        quantities: &["s3"],
        confirmed: "monomers have the stretching rigidity of Table 4 (at 100 pN)",
        refuted: "that monomers have the stretching rigidity of Table 4 (at 100 pN) to the digits printed",
    },
    Finding {
        artefact: "table3",
        quantities: &["b3_rms", "claim/under_twist_easier"],
        confirmed: "monomers resist over-twist more than under-twist, and from 40 to 200 deg by what Table 3 \
                 says",
        refuted: "that monomers resist over-twist more than under-twist, and from 40 to 200 deg by what \
                Table 3 says",
    },
    Finding {
        artefact: "fig4",
        quantities: &["claim/tips_overlap"],
        confirmed: "tips of mixed cantilevers of every resolution lie within 1.8 nm (Figure 4)",
        refuted: "that tips of mixed cantilevers of every resolution lie within 1.8 nm (Figure 4)",
    },
    Finding {
        artefact: "fig4",
        quantities: &[
            "claim/frequency_spread",
            "claim/decay_spread",
            "claim/theory",
        ],
        confirmed: "cantilevers of every resolution swing alike, and bend as theory has it (Figure 4)",
        refuted: "that cantilevers of every resolution swing alike, and bend as theory has it (Figure 4)",
    },
    Finding {
        artefact: "fig5",
        quantities: &["claim/node_spread", "claim/energies_close"],
        confirmed: "on linkers in a plane filaments of all resolutions take one shape (Figure 5)",
        refuted: "that on linkers in a plane filaments of all resolutions take one shape (Figure 5)",
    },
    Finding {
        artefact: "fig6",
        quantities: &["claim/node_spread", "claim/node_spread_over_fig5"],
        confirmed: "on linkers all round shapes differ more than in a plane, but little (Figure 6)",
        refuted: "that on linkers all round shapes differ more than in a plane, but little (Figure 6)",
    },
    Finding {
        artefact: "fig7",
        quantities: &["half_energy_ratio/ellipsoid"],
        confirmed: "monomers store some 10 % more energy in over-twist than in under-twist (Figure 7)",
        refuted: "that monomers store some 10 % more energy in over-twist than in under-twist (Figure 7)",
    },
    Finding {
        artefact: "fig8",
        quantities: &["claim/height_grows_with_rod/over/180"],
        confirmed: "over-twisted filaments buckle higher the longer their rod is (Figure 8)",
        refuted: "that over-twisted filaments buckle higher the longer their rod is (Figure 8)",
    },
    Finding {
        artefact: "fig10",
        quantities: &[
            "claim/couple_improves/over/180",
            "claim/couple_improves/over/270",
            "claim/couple_improves/under/180",
            "claim/couple_improves/under/270",
            "claim/height_improves/over/180",
        ],
        confirmed: "a rod whose rigidity and length follow its twist brings the couples of all resolutions \
                 together at 180 and 270 deg, and the heights at 180 deg of over-twist (Figure 10)",
        refuted: "that a rod whose rigidity and length follow its twist brings the couples of all \
                resolutions together at 180 and 270 deg, and the heights at 180 deg of over-twist (Figure \
                10)",
    },
    Finding {
        artefact: "fig4",
        quantities: &["claim/printed_deflection"],
        confirmed: "the deflection that is printed with Figure 4 follows from the numbers beside it",
        refuted: "that a cantilever bends by the 10 nm that are printed with Figure 4, which contradict \
                Table 4",
    },
    Finding {
        artefact: "table4",
        quantities: &["s1"],
        confirmed: "monomers have the shearing rigidity of Table 4",
        refuted: "that monomers have the shearing rigidity of Table 4: at rest there is none",
    },
    Finding {
        artefact: "fig8",
        quantities: &["claim/height_grows_with_rod/under/180"],
        confirmed: "under-twisted filaments buckle higher the longer their rod is (Figure 8)",
        refuted: "that under-twisted filaments buckle higher the longer their rod is (Figure 8)",
    },
    Finding {
        artefact: "table5",
        quantities: &["dl_over_l_rms"],
        confirmed: "from 40 to 200 deg twist changes the length of monomers by what Table 5 says",
        refuted: "that from 40 to 200 deg twist changes the length of monomers by as much as Table 5 says",
    },
    Finding {
        artefact: "fig10",
        quantities: &["claim/height_improves/under/270"],
        confirmed: "a rod whose rigidity and length follow its twist brings the heights of all resolutions \
                 together at 270 deg of under-twist (Figure 10)",
        refuted: "that a rod whose rigidity and length follow its twist brings the heights of all \
                resolutions together at 270 deg of under-twist (Figure 10)",
    },
    Finding {
        artefact: "table2",
        quantities: &["area/least", "area/most"],
        confirmed: "the cross-sections of Table 2 follow from its diameters",
        refuted: "that the cross-sections of Table 2 follow from its diameters",
    },
];

impl Finding {
    /// Whether it is confirmed; nothing if the run has not all of its rows.
    fn verdict(&self, artefacts: &[Artefact]) -> Option<bool> {
        let artefact = artefacts.iter().find(|a| a.id == self.artefact)?;
        let verdict = |name: &&str| {
            let row = artefact.rows.iter().find(|row| row.quantity == **name)?;
            row.pass
        };
        let verdicts: Option<Vec<bool>> = self.quantities.iter().map(verdict).collect();
        verdicts.map(|all| all.into_iter().all(|pass| pass))
    }
}

/// The sentences; nothing of what was not computed.
pub(super) fn html(artefacts: &[Artefact]) -> Markup {
    let sentences = sentences(artefacts);
    html! {
        @for (title, class, text) in sentences.iter().filter(|(.., text)| !text.is_empty()) {
            p class="lead" { span class=(class) { (title) ":" } " " (text) "." }
        }
    }
}

/// Title, class and text of each sentence.
fn sentences(artefacts: &[Artefact]) -> [(&'static str, &'static str, String); 3] {
    let verdicts = FINDINGS.iter().map(|f| (f, f.verdict(artefacts)));
    let of = |wanted: bool| {
        let chosen = verdicts.clone().filter(move |(_, v)| *v == Some(wanted));
        let words = chosen.map(|(f, _)| if wanted { f.confirmed } else { f.refuted });
        words.collect::<Vec<_>>().join("; ")
    };
    let rows = artefacts.iter().flat_map(|a| &a.rows);
    let missed: Vec<&Row> = rows.filter(|row| row.pass == Some(false)).collect();
    [
        ("Confirmed", "pass", of(true)),
        ("Not confirmed", "miss", of(false)),
        ("Why", "open", causes(&missed)),
    ]
}

/// How many misses have which cause, in words; nothing if there are none.
fn causes(missed: &[&Row]) -> String {
    let count = |cause: Option<Cause>| {
        let causes = missed.iter().map(|row| reasons::of(row).map(|r| r.cause));
        causes.filter(|found| *found == cause).count()
    };
    let known = Cause::ALL.map(|cause| (count(Some(cause)), Some(cause)));
    let told = known.into_iter().chain([(count(None), None)]);
    let told: Vec<String> = told
        .filter(|(count, _)| *count > 0)
        .map(|(count, cause)| {
            let unknown = || format!("{count} nobody has looked into yet");
            cause.map_or_else(unknown, |cause| cause.in_words(count))
        })
        .collect();
    match missed.len() {
        0 => String::new(),
        1 => format!("1 comparison failed. {}", told.concat()),
        many => format!("{many} comparisons failed. {}", told.join("; ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace_root;
    use actin_draw::report;

    /// The artefacts of the committed report, with their rows and nothing else.
    fn committed() -> Vec<Artefact> {
        let rows = report::read(&workspace_root().join("docs/report.json")).unwrap();
        let mut artefacts: Vec<Artefact> = Vec::new();
        for row in rows {
            if artefacts.last().is_none_or(|a| a.id != row.artefact) {
                artefacts.push(Artefact {
                    id: row.artefact,
                    title: "",
                    settings: String::new(),
                    rows: Vec::new(),
                    pictures: Vec::new(),
                    views: Vec::new(),
                    wall_s: 0.0,
                });
            }
            artefacts.last_mut().unwrap().rows.push(row);
        }
        artefacts
    }

    /// A full run has a verdict on every finding, and a verdict that changes moves its statement.
    #[test]
    fn statements_follow_the_verdicts() {
        let mut artefacts = committed();
        for finding in &FINDINGS {
            assert!(
                finding.verdict(&artefacts).is_some(),
                "{}",
                finding.confirmed
            );
        }
        let sentences = |artefacts: &[Artefact]| sentences(artefacts).map(|(.., text)| text);
        let before = sentences(&artefacts);
        assert!(before[0].contains("take one shape") && !before[1].contains("take one shape"));
        let fig5 = artefacts.iter_mut().find(|a| a.id == "fig5").unwrap();
        let row = fig5.rows.iter_mut();
        let mut row = row.filter(|row| row.quantity == "claim/node_spread");
        row.next().unwrap().pass = Some(false);
        let after = sentences(&artefacts);
        assert!(!after[0].contains("take one shape") && after[1].contains("take one shape"));
        assert!(after[2].contains("nobody has looked into"));
    }

    /// Symptom of a clause that leans on its neighbours: it begins with "they" or "so does", and a run of
    /// one artefact says what nobody can understand.
    #[test]
    fn every_statement_can_be_read_alone() {
        let artefacts = committed();
        for finding in &FINDINGS {
            let mut own = artefacts
                .iter()
                .find(|a| a.id == finding.artefact)
                .unwrap()
                .clone();
            own.rows
                .retain(|row| finding.quantities.contains(&row.quantity.as_str()));
            for (pass, title, text) in [
                (true, "Confirmed:</span> ", finding.confirmed),
                (false, "Not confirmed:</span> that ", finding.refuted),
            ] {
                own.rows.iter_mut().for_each(|row| row.pass = Some(pass));
                let page = html(std::slice::from_ref(&own)).into_string();
                let shown = html! { (text) }.into_string();
                assert!(page.contains(title) && page.contains(&shown), "{page}");
                let words: Vec<&str> = text.split([' ', ',', ';']).collect();
                for leaning in ["they", "them", "too", "so", "also", "ones", "other"] {
                    assert!(!words.contains(&leaning), "{leaning}: {text}");
                }
                assert!(
                    text.contains(&actin_draw::page::name(finding.artefact)),
                    "{text}"
                );
            }
        }
    }

    #[test]
    fn misses_are_counted_by_their_cause() {
        let artefacts = committed();
        let rows = artefacts.iter().flat_map(|a| &a.rows);
        let missed: Vec<&Row> = rows.filter(|row| row.pass == Some(false)).collect();
        let words = causes(&missed);
        let of_paper = |row: &&&Row| reasons::of(row).is_some_and(|r| r.cause == Cause::Paper);
        let begin = format!(
            "{} comparisons failed. In {} the paper contradicts itself; ",
            missed.len(),
            missed.iter().filter(of_paper).count()
        );
        assert!(words.starts_with(&begin), "{words}");
        let unknown = Row::measured("fig1", "q", "nm", 1.0, "").against(2.0, 0.5);
        assert_eq!(
            causes(&[&unknown]),
            "1 comparison failed. 1 nobody has looked into yet"
        );
        assert_eq!(causes(&[]), "");
    }

    #[test]
    fn what_a_run_has_not_computed_is_not_spoken_of() {
        assert_eq!(html(&[]).into_string(), "");
    }
}
