//! What stands and what does not, in three sentences put together from the verdicts of the run.

use super::reasons::{self, Cause};
use super::{escape, push};
use crate::figures::report::{Artefact, Row};

/// A statement of the paper that rests on some rows of one artefact.
struct Finding {
    artefact: &'static str,
    /// It stands if all of these agree, and does not if one of them is missed.
    quantities: &'static [&'static str],
    stands: &'static str,
    fails: &'static str,
}

const FINDINGS: [Finding; 14] = [
    Finding {
        artefact: "table4",
        quantities: &["s3", "b1", "b3_min", "b3_max"],
        stands: "with the choices named below and nothing fitted, monomers and their bonds have the \
                 rigidities in stretch, bending and twist that the paper states (Table 4)",
        fails: "the rigidities of the monomers in stretch, bending and twist (Table 4)",
    },
    Finding {
        artefact: "table3",
        quantities: &["b3_rms", "claim/under_twist_easier"],
        stands: "they resist over-twist more than under-twist, angle by angle as Table 3 says",
        fails: "how the resistance to twist depends on its angle (Table 3)",
    },
    Finding {
        artefact: "fig4",
        quantities: &[
            "claim/tips_overlap",
            "claim/frequency_spread",
            "claim/decay_spread",
            "claim/theory",
        ],
        stands: "cantilevers of every resolution bend and swing alike, as theory has it (Figure 4)",
        fails: "that cantilevers of every resolution bend and swing alike (Figure 4)",
    },
    Finding {
        artefact: "fig5",
        quantities: &["claim/node_spread", "claim/energies_close"],
        stands: "on linkers in a plane all resolutions take one shape (Figure 5)",
        fails: "that on linkers in a plane all resolutions take one shape (Figure 5)",
    },
    Finding {
        artefact: "fig6",
        quantities: &["claim/node_spread", "claim/node_spread_over_fig5"],
        stands: "on linkers all round they differ more, but little (Figure 6)",
        fails: "that on linkers all round the shapes differ little, but more than in a plane (Figure 6)",
    },
    Finding {
        artefact: "fig7",
        quantities: &["half_energy_ratio/ellipsoid"],
        stands: "monomers store more energy in over-twist than in under-twist (Figure 7)",
        fails: "that monomers store more energy in over-twist than in under-twist (Figure 7)",
    },
    Finding {
        artefact: "fig8",
        quantities: &["claim/height_grows_with_rod/over/180"],
        stands: "over-twisted filaments buckle higher the more of them is rod (Figure 8)",
        fails: "that over-twisted filaments buckle higher the more of them is rod (Figure 8)",
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
        stands: "a rod whose rigidity and length follow its twist brings resolutions together (Figure 10)",
        fails: "that a rod whose rigidity and length follow its twist brings resolutions together \
                (Figure 10)",
    },
    Finding {
        artefact: "fig4",
        quantities: &["claim/printed_deflection"],
        stands: "the printed deflection follows from the numbers beside it",
        fails: "the deflection of 10 nm that the text of Figure 4 gives, which contradicts Table 4",
    },
    Finding {
        artefact: "table4",
        quantities: &["s1"],
        stands: "so does their shearing rigidity",
        fails: "a shearing rigidity: monomers at rest have none (Table 4)",
    },
    Finding {
        artefact: "fig8",
        quantities: &["claim/height_grows_with_rod/under/180"],
        stands: "under-twisted ones, too",
        fails: "that under-twisted filaments, too, buckle higher the more of them is rod (Figure 8)",
    },
    Finding {
        artefact: "table5",
        quantities: &["dl_over_l_rms"],
        stands: "twist shortens them by what Table 5 says",
        fails: "how much, though not in which way, twist shortens a filament (Table 5)",
    },
    Finding {
        artefact: "fig10",
        quantities: &["claim/height_improves/under/270"],
        stands: "also in the height of under-twisted filaments at 270 deg",
        fails: "closer heights at 270 deg of under-twist (Figure 10)",
    },
    Finding {
        artefact: "table2",
        quantities: &["area/least", "area/most"],
        stands: "cross-sections follow from diameters (Table 2)",
        fails: "the cross-sections of Table 2, which are not those of its diameters",
    },
];

impl Finding {
    /// Whether it stands; nothing if the run has not all of its rows.
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

/// Writes the sentences.
pub(super) fn write(page: &mut String, artefacts: &[Artefact]) {
    let verdicts = FINDINGS.iter().map(|f| (f, f.verdict(artefacts)));
    let of = |wanted: bool| {
        let chosen = verdicts.clone().filter(move |(_, v)| *v == Some(wanted));
        let words = chosen.map(|(f, _)| if wanted { f.stands } else { f.fails });
        words.collect::<Vec<_>>().join("; ")
    };
    let rows = artefacts.iter().flat_map(|a| &a.rows);
    let missed: Vec<&Row> = rows.filter(|row| row.pass == Some(false)).collect();
    let sentences = [
        ("What stands", "pass", of(true)),
        ("What does not", "miss", of(false)),
        ("Why", "open", causes(&missed)),
    ];
    for (title, class, text) in sentences {
        if !text.is_empty() {
            push(
                page,
                format_args!(
                    "<p class=\"lead\"><span class=\"{class}\">{title}:</span> {}.</p>\n",
                    escape(&text)
                ),
            );
        }
    }
}

/// How many misses have which cause, in words; nothing if there are none.
fn causes(missed: &[&Row]) -> String {
    let count = |cause: Option<Cause>| {
        let causes = missed.iter().map(|row| reasons::of(row).map(|r| r.cause));
        causes.filter(|found| *found == cause).count()
    };
    let known = Cause::ALL.map(|cause| (count(Some(cause)), cause.in_words()));
    let unknown = (count(None), "what nobody has looked into yet");
    let told = known.into_iter().chain([unknown]);
    let told: Vec<String> = told
        .filter(|(count, _)| *count > 0)
        .map(|(count, words)| format!("{count} {words}"))
        .collect();
    if told.is_empty() {
        return String::new();
    }
    format!(
        "of {} comparisons that failed this many concern: {}",
        missed.len(),
        told.join("; ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::workspace_root;
    use crate::figures::report;

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
            assert!(finding.verdict(&artefacts).is_some(), "{}", finding.stands);
        }
        let sentences = |artefacts: &[Artefact]| {
            let mut page = String::new();
            write(&mut page, artefacts);
            let lines: Vec<String> = page.lines().map(str::to_owned).collect();
            lines
        };
        let before = sentences(&artefacts);
        assert_eq!(before.len(), 3);
        assert!(before[0].contains("take one shape") && !before[1].contains("take one shape"));
        let fig5 = artefacts.iter_mut().find(|a| a.id == "fig5").unwrap();
        let row = fig5.rows.iter_mut();
        let mut row = row.filter(|row| row.quantity == "claim/node_spread");
        row.next().unwrap().pass = Some(false);
        let after = sentences(&artefacts);
        assert!(!after[0].contains("take one shape") && after[1].contains("take one shape"));
        assert!(after[2].contains("nobody has looked into"));
    }

    #[test]
    fn what_a_run_has_not_computed_is_not_spoken_of() {
        let mut page = String::new();
        write(&mut page, &[]);
        assert_eq!(page, "");
    }
}
