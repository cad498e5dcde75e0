//! The same filament with sections that the program chose for a wanted error, beside all monomers and beside
//! resolutions that were fixed beforehand.
//!
//! All are the mean filament, held by `Wall`, of one length; rods are under `Homogenised`, as a choice makes them.

use super::case::Case;
use super::group::Group;
use super::lists::Plan;
use super::outcome::{Measured, measure};
use super::resolved::Resolved;
use super::results::{OBSERVABLES, Observable};
use crate::run::run_to_end;
use actin_draw::report::{Origin, Row};
use actin_sim::adapt::Chosen;
use actin_sim::{Adaptive, Assembly, Hold, RodLaw, Scene, Section, Want};

/// What is wanted (relative error), and the share of monomers under which it is to be met.
const WANTED: f64 = 0.02;
const MOST_MONOMERS: f64 = 0.5;
/// Turns (deg) up to which filaments are compared.
const MOST_DEG: i32 = 270;
/// Length of the filament: 110 rises (nm).
const LENGTH_NM: f64 = 110.0 * 71.2 / 26.0;
/// Parts that are rod in the fixed resolutions, half at each end, as shares of the length.
const FIXED: [f64; 5] = [1.0, 0.75, 0.5, 0.25, 0.0];

/// One turn: fixed resolutions, all monomers last, and what was chosen for each number.
pub(super) struct Turned {
    turn_deg: i32,
    fixed: Vec<Measured>,
    chosen: Vec<(Observable, Chosen, Measured)>,
}

/// The turns of a plan at which filaments are compared.
pub(super) fn turns(plan: &Plan) -> Vec<i32> {
    let turns = plan.turns.iter().copied();
    turns.filter(|turn| turn.abs() <= MOST_DEG).collect()
}

/// Solves all resolutions at one turn.
///
/// # Errors
/// A path that ends early, a choice that is refused: in words.
pub(super) fn solve(plan: &Plan, turn_deg: i32) -> Result<Turned, String> {
    let group = Group {
        mean: true,
        hold: Hold::Wall,
        ..plan.main()
    };
    let case = Case::new(group, Resolved::Mixed(140), turn_deg, 0);
    let mut scene = case.scene()?;
    scene.filament.rod.law = RodLaw::Homogenised;
    scene
        .linkers
        .iter_mut()
        .for_each(|linker| linker.at_nm = 0.5 * LENGTH_NM);
    let fixed = FIXED.map(|share| {
        let scene = with_sections(&scene, fixed(share));
        Ok(solved(&case, &scene)?.0)
    });
    let chosen = wants().map(|(observable, want)| {
        let mut scene = scene.clone();
        scene.filament.sections = Adaptive {
            length_nm: LENGTH_NM,
            want,
            monomers: None,
        }
        .into();
        let (measured, chosen) = solved(&case, &scene)?;
        let chosen = chosen.ok_or("nothing was chosen")?;
        Ok((observable, chosen, measured))
    });
    Ok(Turned {
        turn_deg,
        fixed: fixed.into_iter().collect::<Result<_, String>>()?,
        chosen: chosen.into_iter().collect::<Result<_, String>>()?,
    })
}

/// Height, couple and thrust, as they are observed and as they are wanted.
fn wants() -> [(Observable, Want); 3] {
    let [height, couple, force, _] = OBSERVABLES;
    let error = WANTED;
    [
        (height, Want::Height { error }),
        (couple, Want::EndCouple { error }),
        (force, Want::EndForce { error }),
    ]
}

/// Rod at both ends, monomers between.
fn fixed(rod_share: f64) -> Vec<Section> {
    let half = 0.5 * rod_share * LENGTH_NM;
    let monomers = Section::Ellipsoids {
        from_nm: half,
        to_nm: LENGTH_NM - half,
        altered: None,
    };
    match rod_share {
        0.0 => vec![monomers],
        1.0 => vec![Section::rod(0.0, LENGTH_NM, None)],
        _ => vec![
            Section::rod(0.0, half, None),
            monomers,
            Section::rod(LENGTH_NM - half, LENGTH_NM, None),
        ],
    }
}

fn with_sections(scene: &Scene, sections: Vec<Section>) -> Scene {
    let mut scene = scene.clone();
    scene.filament.sections = sections.into();
    scene
}

/// The equilibrium at the end of the path.
fn solved(case: &Case, scene: &Scene) -> Result<(Measured, Option<Chosen>), String> {
    let fail = |error: &dyn std::fmt::Display| format!("{}, chosen: {error}", case.name());
    let mut assembly = Assembly::build(scene).map_err(|e| fail(&e))?;
    let chosen = assembly.chosen.clone();
    run_to_end(&mut assembly).map_err(|e| fail(&e))?;
    Ok((measure(case, &mut assembly), chosen))
}

/// The value, and the share of monomers, of every choice.
pub(super) fn rows(plan: &Plan, all: &[Turned]) -> Vec<Row> {
    let of_turn = |turned| of_turn(plan.figure.id(), turned);
    all.iter().flat_map(of_turn).collect()
}

fn of_turn(id: &'static str, turned: &Turned) -> Vec<Row> {
    let name = Case::turn_name(turned.turn_deg);
    let Some((truth, coarser)) = turned.fixed.split_last() else {
        return Vec::new();
    };
    let of_choice = |(observable, chosen, found): &(Observable, Chosen, Measured)| {
        let &Observable {
            name: what,
            unit,
            of,
        } = observable;
        let truth = of(truth);
        let off = |m: &Measured| 100.0 * (of(m) / truth - 1.0);
        let beside = coarser.iter().zip(FIXED);
        let beside = beside.map(|(m, rod)| format!("{:.0} % rod {:+.1} %", 100.0 * rod, off(m)));
        let share = share_of_monomers(chosen);
        let value = format!(
            "chosen for {} %: {:.0} % monomers, {:+.2} % off all monomers, {:.2} % estimated; fixed resolutions, monomers \
             in the middle: {}",
            100.0 * WANTED,
            100.0 * share,
            off(found),
            100.0 * chosen.relative_error,
            beside.collect::<Vec<_>>().join(", ")
        );
        let value = Row::measured(id, format!("chosen/{what}/{name}"), unit, of(found), value);
        let share = Row::measured(
            id,
            format!("chosen/share_of_monomers/{what}/{name}"),
            "",
            share,
            "of the length, of the choice for that number",
        );
        [
            value.against(truth, WANTED * truth.abs()).of(Origin::Bound),
            share.against(0.0, MOST_MONOMERS).of(Origin::Bound),
        ]
    };
    turned.chosen.iter().flat_map(of_choice).collect()
}

fn share_of_monomers(chosen: &Chosen) -> f64 {
    let stretches = chosen.monomers_nm.iter();
    stretches.fold(0.0, |sum, [from, to]| sum + to - from) / LENGTH_NM
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::buckling::group::Figure;

    /// Fixed resolutions go from all rod to all monomers.
    #[test]
    fn fixed_resolutions_cover_the_length() {
        for share in FIXED {
            let sections = fixed(share);
            let last = sections.last().map(|section| section.span_nm().1);
            assert_eq!((sections[0].span_nm().0, last), (0.0, Some(LENGTH_NM)));
        }
    }

    /// Far turns have several states, of which a choice would compare different ones.
    #[test]
    fn far_turns_are_left_out() {
        let plan = Plan::ten(false);
        assert_eq!(plan.figure, Figure::Ten);
        assert_eq!(turns(&plan), [180, -180, 270, -270]);
    }
}
