//! Whether the energy of a damped motion only falls.

use actin_draw::report::Row;

/// The claim that energies decay as motions come to rest: `motions` are energies in time.
///
/// It is shown and not judged: drag takes energy out at every instant, so that nothing else can come out.
pub(super) fn energy_decays<E: Iterator<Item = f64>>(
    artefact: &'static str,
    motions: impl Iterator<Item = E>,
) -> Row {
    let rises: Vec<f64> = motions.map(largest_rise).collect();
    let note = format!(
        "the paper: energies fall as the filaments approach equilibrium; largest rise of kinetic and \
         potential energy (that of loads included) between two records over what the motion loses, \
         {} motions; not judged, since drag leaves nothing else",
        rises.len()
    );
    let ours = rises.into_iter().fold(0.0, f64::max);
    Row::measured(artefact, "claim/energy_decays", "", ours, note)
}

/// Largest rise between neighbours over the difference of first and last.
fn largest_rise(energies: impl Iterator<Item = f64>) -> f64 {
    let all: Vec<f64> = energies.collect();
    let (Some(first), Some(last)) = (all.first(), all.last()) else {
        return 0.0;
    };
    let rises = all.windows(2).map(|pair| pair[1] - pair[0]);
    rises.fold(0.0, f64::max) / (first - last).abs()
}

#[cfg(test)]
mod tests {
    use super::energy_decays;

    /// From 10 to 2 with a rise of 0.4 on the way: 0.05 of the loss. No row is judged.
    #[test]
    fn a_rise_is_seen() {
        let row = energy_decays("fig5", [vec![10.0, 3.0, 3.4, 2.0].into_iter()].into_iter());
        assert!((row.ours - 0.05).abs() < 1e-15);
        assert_eq!(row.pass, None);
        let falls = energy_decays("fig5", [vec![10.0, 3.0, 2.0].into_iter()].into_iter());
        assert_eq!((falls.ours, falls.pass), (0.0, None));
    }
}
