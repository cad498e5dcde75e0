//! Error of bending of cantilevers in few segments.

use crate::common::ran;
use actin_sim::End;

/// The error of `n` segments of constant rigidity is `1 / (2 n^2)`, the bound of the warning, less the relative shear
/// displacement 3 B/(S L^2), 4.6 %.
#[test]
fn the_bound_is_the_error_of_bending() {
    let tip = |segments: usize| {
        let (assembly, trajectory, _) = ran(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: 400.0, segments: {segments})],
                    rod: RodModel(law: Constant),
                ),
                clamps: [Clamp(end: Start)],
                loads: [EndForce(end: End, force_pn: (0.01, 0.0, 0.01))],
                task: Equilibrium(),
            )"
        ));
        let last = trajectory.records.last().unwrap();
        assembly.tip_nm(&last.state, End::End).x
    };
    let fine = tip(64);
    for segments in [1, 2, 4] {
        let bound = 0.5 / (segments * segments) as f64;
        let error = tip(segments) / fine - 1.0;
        assert!(
            0.9 * bound < error && error < bound,
            "{segments}: {error} of {bound}"
        );
    }
}
