//! The numbers of a summary, from the last record of a run.

use super::{
    AccuracySummary, EnergySummary, FilamentSummary, LinkerSummary, ResidualSummary,
    StabilitySummary, StatesSummary, Summary, ThermalSummary, WorkSummary,
};
use crate::observe::{Averages, Memory, View, observed_values};
use crate::{Assembly, At, Outcome, Record, Row, Status, Task};
use actin_equilibrium::Certificate;
use actin_mechanics::Residual;

impl Summary {
    /// Creates the summary of an assembly as built, with the keys of a run's summary but without
    /// results.
    pub fn as_built(assembly: &Assembly) -> Self {
        let at = match assembly.scene.task {
            Task::Dynamics(_) | Task::Brownian(_) => At::Time(0.0),
            Task::Equilibrium(_) => At::Path(0.0),
        };
        let state = assembly.rest.clone();
        let energies_pn_nm = vec![0.0; assembly.terms.len()];
        let view = View::new(assembly, (at, &state), (&energies_pn_nm, 0.0));
        let observed = observed_values(&view, &mut Memory::new(assembly));
        let row = Row {
            observed,
            ..Row::new(at, 0.0, Residual::default(), energies_pn_nm)
        };
        let record = Record { row, state };
        Self::new(assembly, &record, &Outcome::new(Status::Interrupted, 0.0))
    }

    /// Creates the summary of a run of `assembly` that ended with the record `last`.
    pub fn new(assembly: &Assembly, last: &Record, outcome: &Outcome) -> Self {
        Self::without_derived_warnings(assembly, last, outcome).with_derived_warnings()
    }

    /// Creates the summary without the warnings that follow from other keys.
    #[expect(clippy::too_many_lines, reason = "a line for each key")]
    pub(super) fn without_derived_warnings(
        assembly: &Assembly,
        last: &Record,
        outcome: &Outcome,
    ) -> Self {
        let of_plan = outcome.plan_notes.clone();
        let notes = [assembly.notes(), of_plan, outcome.notes(assembly, last)].concat();
        let filaments = FilamentSummary::all(assembly, last);
        let first = &filaments[0];
        Self {
            scene: assembly.scene.title.clone(),
            status: outcome.status,
            failure: outcome.failure.clone(),
            counts: assembly.counts(),
            time_ns: last.at.time_ns(),
            path: last.at.path(),
            time_step_ns: outcome.time_step_ns,
            largest_frequency_rad_per_ns: outcome.largest_frequency_rad_per_ns,
            stability: outcome.certificate().map(StabilitySummary::new),
            saddles_left: outcome.saddles_left,
            pushes: outcome.pushes.clone(),
            jumps: outcome.jumps,
            energy_pn_nm: EnergySummary::new(assembly, last),
            tip_nm: first.tip_nm,
            tip_displacement_nm: first.tip_displacement_nm,
            end_reactions: first.end_reactions,
            notes: notes.iter().map(|note| note.message.clone()).collect(),
            warnings: notes.into_iter().filter(|n| n.code.is_some()).collect(),
            beyond_range: assembly.beyond_range_over([&last.state]),
            unstable_twist: assembly.unstable_twist_over([&last.state]),
            step_errors: outcome.step_errors.clone(),
            beyond_use: outcome.beyond_use.clone(),
            linkers: LinkerSummary::all(assembly, &last.state),
            observables: Averages::of_one(assembly, (last.at, &last.observed)),
            smallest_gap_nm: assembly.smallest_gap_nm(&last.state),
            shape: first.shape,
            residual: ResidualSummary::new(last),
            residual_floor: outcome.residual_floor().map(Into::into),
            thermal: ThermalSummary::new(assembly, (last.kinetic_pn_nm, 1)),
            following: None,
            lowest_stiffness_eigenvalue: outcome.lowest_eigenvalue(),
            states: StatesSummary::from_outcome(assembly, outcome),
            accuracy: AccuracySummary::new(assembly, outcome),
            work: WorkSummary::new(outcome),
            wall_s: outcome.wall_s,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            format: Self::FORMAT,
            seed: first.seed,
            filaments,
        }
    }
}

impl WorkSummary {
    fn new(outcome: &Outcome) -> Self {
        let equilibrium = outcome.equilibrium.as_ref();
        Self {
            steps: outcome.steps,
            force_evaluations: outcome.force_evaluations,
            newton_iterations: equilibrium.map_or(0, |e| e.newton_iterations),
        }
    }
}

impl StabilitySummary {
    fn new(certificate: &Certificate) -> Self {
        Self {
            stable: certificate.negative == 0 && certificate.unresolved == 0,
            negative_eigenvalues: certificate.negative,
            unresolved_eigenvalues: certificate.unresolved,
            resolution_pn_per_nm: certificate.resolution,
        }
    }
}

impl ResidualSummary {
    fn new(record: &Record) -> Self {
        Self {
            force_pn: record.residual_force_pn,
            torque_pn_nm: record.residual_torque_pn_nm,
        }
    }
}

impl From<Residual> for ResidualSummary {
    fn from(residual: Residual) -> Self {
        Self {
            force_pn: residual.force,
            torque_pn_nm: residual.torque,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::summary::tests;
    use actin_mechanics::Vector3;

    fn last_summary(assembly: &Assembly) -> (Record, Summary) {
        let last = tests::trajectory(assembly).records.pop().unwrap();
        let summary = Summary::new(assembly, &last, &tests::outcome());
        (last, summary)
    }

    /// The displacement of the clamped end would be zero.
    #[test]
    fn the_tip_is_the_free_end() {
        let at_end = tests::clamped_start();
        let (last, summary) = last_summary(&at_end);
        let tip = last.state.points.position.get(at_end.points.len() - 1);
        assert_eq!(Vector3::from(summary.tip_nm), tip);
        let built = at_end.rest.points.position.get(at_end.points.len() - 1);
        let moved = Vector3::from(summary.tip_displacement_nm);
        assert_eq!(moved, tip - built);

        let at_start = tests::clamped_end();
        let (last, summary) = last_summary(&at_start);
        let tip = last.state.points.position.get(0);
        assert_eq!(Vector3::from(summary.tip_nm), tip);
        assert!(summary.end_reactions.start.is_none() && summary.end_reactions.end.is_some());
    }

    /// The force is extension times stiffness and points from the site to the anchor.
    #[test]
    fn linkers_are_reported() {
        let assembly = tests::linked();
        let (last, summary) = last_summary(&assembly);
        let [linker] = &summary.linkers[..] else {
            panic!("one linker, found {}", summary.linkers.len());
        };
        let reach = Vector3::from(linker.anchor_nm) - Vector3::from(linker.site_nm);
        assert!((reach.norm() - 0.4 - linker.extension_nm).abs() < 1e-14);
        let expected = reach.normalize() * (3.0 * linker.extension_nm);
        assert!((Vector3::from(linker.force_pn) - expected).norm() < 1e-13);
        let energy = summary.energy_pn_nm.terms["linker"];
        assert!((energy - 1.5 * linker.extension_nm.powi(2)).abs() < 1e-13);
        // The random state has moved the site and strained the rod.
        let at_rest = assembly.linkers[0].site().position(&assembly.rest);
        assert!((Vector3::from(linker.site_nm) - at_rest).norm() > 1e-3);
        assert!(last.energies_pn_nm.len() == assembly.terms.len());
    }

    /// Energies of linkers belong to no filament. Top-level keys describe filament 0.
    #[test]
    fn filaments_are_reported_one_by_one() {
        let assembly = tests::pair();
        let (last, summary) = last_summary(&assembly);
        let [first, second] = &summary.filaments[..] else {
            panic!("two filaments, found {}", summary.filaments.len());
        };
        let tip = last.state.points.position.get(assembly.points.len() - 1);
        assert_eq!(Vector3::from(second.tip_nm), tip);
        assert_eq!((summary.tip_nm, summary.shape), (first.tip_nm, first.shape));
        assert!(first.end_reactions.start.is_some() && second.end_reactions.start.is_none());
        let (all, one, other) = (summary.counts, first.counts, second.counts);
        assert_eq!(all.monomers, one.monomers + other.monomers);
        assert_eq!(all.bonds, one.bonds + other.bonds);
        assert_eq!(all.segments, one.segments + other.segments);
        assert_eq!(all.junctions, one.junctions + other.junctions);
        assert_eq!(all.dofs, one.dofs + other.dofs);
        let energy = &summary.energy_pn_nm;
        let parts = first.elastic_pn_nm + second.elastic_pn_nm + energy.terms["linker"];
        // Round-off of sums in different order.
        assert!((parts / energy.elastic - 1.0).abs() < 1e-13);
        let linker = &summary.linkers[0];
        assert_eq!((linker.filament, linker.to_filament), (1, Some(0)));
    }

    #[test]
    fn energies_are_those_of_the_last_record() {
        let assembly = tests::clamped_start();
        let (last, summary) = last_summary(&assembly);
        let energy = &summary.energy_pn_nm;
        let potential: f64 = last.energies_pn_nm.iter().sum();
        assert_eq!(energy.potential.to_bits(), potential.to_bits());
        let total = potential + last.state.kinetic_energy();
        assert_eq!(energy.total.to_bits(), total.to_bits());
        let terms: f64 = energy.terms.values().sum();
        let scale: f64 = energy.terms.values().map(|e| e.abs()).sum();
        // Round-off of sums in different order.
        assert!((terms - potential).abs() <= 1e-14 * scale);
        assert!((energy.elastic + energy.terms["load"] - potential).abs() <= 1e-14 * scale);
    }
}
