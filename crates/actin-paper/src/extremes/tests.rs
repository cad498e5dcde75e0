//! The short rows of the table as tests, with what each kind of row must come to.

use super::row::{Outcome, Row};
use super::stability::{INTEGRATORS, MODELS, SHARES, energy_error, free};
use super::text::with_number;
use super::verdict::Verdict;
use super::{
    certificates, compression, contrast, directories, drag, drift, fields, forces, guards, lengths,
    origin, sizes, stability, straight, turns,
};

/// Prints the rows and refuses any that is neither right nor says that it is not.
fn assert_sound(rows: &[Row]) {
    for row in rows {
        let line = format!("{}, {}: {}", row.varied, row.case, row.outcome.words());
        println!("{line}");
        assert!(row.outcome.is_sound(), "{line}");
    }
}

fn is_correct(row: &Row) -> bool {
    let held = matches!(
        row.outcome,
        Outcome::Correct { .. } | Outcome::Bounded { .. }
    );
    held && row.outcome.is_sound()
}

fn is_refused(row: &Row) -> bool {
    matches!(row.outcome, Outcome::Refused(_))
}

/// A wrong mass, a frequency that misses the stiffest term or a table with a wrong limit would each
/// move one of the two.
#[test]
fn motion_grows_where_the_limit_says() {
    let rows = stability::rows(&INTEGRATORS);
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

/// All methods on all filaments: a wrong coefficient costs an order, which shows at small steps.
#[test]
fn energy_fluctuates_within_its_bound_at_every_step() {
    let rows = stability::below(&INTEGRATORS);
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

/// Below the limit the energy fluctuates, less the shorter the step: 81 times less at a third of it,
/// for a method of order four.
#[test]
fn energy_fluctuates_with_the_order_of_the_method() {
    for (model, sections) in MODELS {
        let mut system = free(sections).unwrap();
        let [.., coarse, _, _, _, _, _] = SHARES;
        let [pefrl, vefrl] = [1, 2].map(|i| {
            let (_, integrator) = INTEGRATORS[i];
            let [a, b] = [coarse, coarse / 3.0].map(|s| energy_error(&mut system, integrator, s));
            println!("{model}: {a:e} and {b:e}");
            (a / b).log(3.0)
        });
        // The next order takes part, and the largest of 100 samples scatters.
        assert!(
            pefrl > 3.0 && vefrl > 3.0,
            "{model}: orders {pefrl} and {vefrl}"
        );
    }
}

/// A step above the limit is refused, and breaks with a report if it is insisted on.
#[test]
fn steps_above_the_limit_are_refused_or_break() {
    let rows = stability::asked_for(&INTEGRATORS);
    assert_sound(&rows);
    for row in &rows {
        let (above, allowed) = (!row.case.contains("0.001"), row.case.contains("allowed"));
        let expected = match (above, allowed) {
            (false, _) => is_correct(row),
            (true, false) => is_refused(row),
            (true, true) => matches!(row.outcome, Outcome::Fails(_)),
        };
        assert!(expected, "{row:?}");
    }
}

#[test]
fn stiffness_apart_by_a_million_is_solved() {
    let rows = contrast::rows();
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

/// Up to half a turn in a joint everything is right, past it nothing pretends to be. Two turns over
/// 75 nm are 90 deg in a joint.
#[test]
fn turns_are_right_up_to_half_a_turn_of_a_joint() {
    let rows = turns::twist(false);
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
    let rows = turns::one_segment();
    assert_sound(&rows);
    for row in &rows {
        let degrees: f64 = row.case.split(' ').next().unwrap().parse().unwrap();
        assert_eq!(is_correct(row), degrees < 180.0, "{row:?}");
    }
}

/// Six segments that are turned by less than half a turn each are right; all else is refused or an
/// error. Twist that slips without a word would be wrong by whole turns.
#[test]
fn twist_that_is_lost_is_said() {
    let rows = turns::slipping();
    assert_sound(&rows);
    assert!(is_correct(&rows[0]), "{:?}", rows[0]);
    assert!(rows[1..3].iter().all(is_refused));
    let fails =
        |row: &Row| matches!(&row.outcome, Outcome::Fails(message) if message.contains("lost"));
    assert!(rows[3..].iter().all(fails), "{rows:?}");
}

/// Below the critical load a straight rod is right. Beyond, a motion that keeps it straight fails and
/// names the saddle, and both ways off lead to the buckled state.
#[test]
fn straight_rods_buckle_or_are_said_to_be_saddles() {
    let rows = straight::rows();
    assert_sound(&rows);
    for row in &rows {
        let is_saddle =
            matches!(&row.outcome, Outcome::Fails(message) if message.contains("saddle"));
        let stays = row.case.ends_with("as it is") && !row.case.contains("by 0.001 ");
        assert_eq!((is_saddle, is_correct(row)), (stays, !stays), "{row:?}");
    }
}

/// From a tenth of a nm to a micrometre. Bonds that the gap between surfaces allows are drawn,
/// shorter ones refused.
#[test]
fn segments_of_all_lengths_bend_as_they_should() {
    let rows = lengths::segments();
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
    let bonds = lengths::bonds();
    assert_sound(&bonds);
    let (possible, too_short) = bonds.split_at(2);
    assert!(possible.iter().all(is_correct));
    assert!(too_short.iter().all(is_refused));
}

/// From 1e-8 to 1e2 pN all is right, and across the rod from 1e-12 pN on; below, what rounding
/// hides is said to be hidden. Of 1e4 pN what is not right is said to be beyond any use or a saddle, and above
/// nothing is of any use.
#[test]
fn forces_over_eighteen_decades_are_right_or_said_to_be_lost() {
    let rows = forces::rows();
    assert_sound(&rows);
    for row in &rows {
        let (_, size) = row.case.rsplit_once(", ").unwrap();
        let size: f64 = size.strip_suffix(" pN").unwrap().parse().unwrap();
        let across = row.case.starts_with("across the rod");
        if (if across { 1e-12 } else { 1e-8 }..=1e2).contains(&size) {
            assert!(is_correct(row), "{row:?}");
        }
        if size >= 1e4 {
            let is_said = |words: &str| row.outcome.words().contains(words);
            let is_beyond = ["model does not apply", "ends on a saddle"]
                .into_iter()
                .any(is_said)
                || (across && is_said("no equilibrium"));
            assert!(is_beyond != is_correct(row), "{row:?}");
            assert!(is_beyond || size < 1e5, "{row:?}");
        }
    }
}

/// A zero of the stiffness that passed for a positive eigenvalue would certify what floats as stable.
#[test]
fn modes_without_stiffness_are_counted() {
    let rows = certificates::rows();
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

/// Below the bound of its twist a pushed rod is stable, above it as unstable as its mesh allows, and
/// the run says which.
#[test]
fn pushed_rods_say_when_their_twist_is_unstable() {
    let rows = compression::rows();
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

#[test]
fn the_smallest_filaments_move_and_smaller_ones_are_refused() {
    let rows = sizes::smallest();
    assert_sound(&rows);
    assert_eq!(rows.iter().map(is_correct).filter(|is| *is).count(), 3);
    let mut rows = sizes::largest(1000);
    rows.extend(sizes::stages(1000));
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

/// From none to far beyond what a step resolves: momentum, terminal velocity, creep, rest, diffusion and
/// temperature.
#[test]
fn drag_does_what_it_should_at_any_rate() {
    let rows = drag::rows();
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

/// Of the ten million steps of the table two hundred thousandths.
#[test]
fn undamped_motion_keeps_energy_and_momenta() {
    let rows = drift::rows(50_000);
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

/// The same over all the steps of the table.
#[test]
#[ignore = "takes minutes; run by hand with --ignored --nocapture"]
fn undamped_motion_of_ten_million_steps() {
    assert_sound(&drift::rows(10_000_000));
}

/// Loads depend on differences of places alone: what the origin costs is their rounding.
#[test]
fn the_origin_costs_no_more_than_rounding() {
    let rows = origin::rows();
    assert_sound(&rows);
    assert!(rows.iter().all(is_correct));
}

#[test]
fn what_no_machine_holds_is_refused_at_once() {
    let rows = guards::rows();
    assert_sound(&rows);
    assert!(rows.iter().all(is_refused));
}

/// Nothing goes that a run has not written, and results are written together or not at all.
#[test]
fn files_of_others_and_results_of_before_stay() {
    let rows = directories::rows();
    assert_sound(&rows);
    let (others, results) = rows.split_at(7);
    assert!(others.iter().all(is_refused));
    assert!(
        results
            .iter()
            .all(|row| matches!(row.outcome, Outcome::Fails(_)))
    );
}

/// What is not finite, overflows or is denormal is refused wherever it stands, with its key and the
/// line and column of that key; 0, -1 and large and small numbers are refused or run to finite
/// results. Data without bound are data: their range may be infinite.
#[test]
fn no_field_takes_what_is_no_number() {
    let refused_anywhere = ["NaN", "inf", "-inf", "1e400", "1e308", "-1e308", "1e-310"];
    for text in fields::scenes() {
        for value in fields::VALUES {
            for trial in fields::trials(&text, value) {
                let (key, verdict) = (&trial.number.key, &trial.verdict);
                assert!(
                    !matches!(verdict, Verdict::NotFinite(_)),
                    "{key} = {value}: {verdict:?}"
                );
                let unbounded = key == "range_per_nm" && ["inf", "1e400"].contains(&value);
                let Verdict::Refused(error) = verdict else {
                    assert!(
                        unbounded || !refused_anywhere.contains(&value),
                        "{key} = {value}: {verdict:?}"
                    );
                    continue;
                };
                let text = with_number(&text, &trial.number, value);
                let line = text.lines().nth(error.line - 1).unwrap();
                assert!(error.column <= line.chars().count() + 1, "{error}");
                if refused_anywhere.contains(&value) {
                    // Of a whole number RON says what it expected, at the number itself.
                    let says = error.message.contains(key.as_str()) || line.contains(value);
                    assert!(says, "{key} = {value}: {error}");
                }
            }
        }
    }
}
