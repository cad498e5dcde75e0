//! Puts the frames of a junction on a state.

use crate::JunctionError;
use actin_cosserat::CrossSection;
use actin_mechanics::{Frame, Inertia, State, UnitQuaternion};
use std::ops::Range;

/// Appends the junction frames to a state and returns where they stand.
///
/// There is one for each attached monomer, in filament order. `axial_distances` are the distances
/// along the axis from each monomer's centre to the rod's end (nm): with a rise `z` and the rod's
/// end half a rise from the last monomer, `[3 z / 2, z / 2]` before a rod and `[z / 2, 3 z / 2]`
/// after it. Each frame is oriented as the rod's segments are at rest (`orientation`, body to
/// lab), and has the inertia of a piece of rod as long as that distance, twice the rest distance
/// `D_E` over which the bond bends towards the monomer; across the axis more, so that it does not swing
/// faster than monomers.
///
/// # Errors
/// Other than one or two monomers, or a distance that is not positive and finite; the state is
/// then unchanged.
pub fn push_junction_frames(
    state: &mut State,
    orientation: UnitQuaternion,
    axial_distances: &[f64],
    cross_section: &CrossSection,
) -> Result<Range<usize>, JunctionError> {
    check_count(axial_distances.len())?;
    for (monomer, &distance) in axial_distances.iter().enumerate() {
        check_distance(monomer, distance)?;
    }
    let first = state.frames.len();
    for &distance in axial_distances {
        state.frames.push(Frame {
            orientation,
            inertia: inertia(cross_section, distance),
        });
    }
    Ok(first..state.frames.len())
}

/// Length (nm) over which a junction frame swings as a rod's frame does.
///
/// Bent over a distance `D` alone it swings at `sqrt(B / i) / D`, with `i` the transverse inertia of the rod
/// per length: at 870 rad/ns half a rise from its monomer, where bonds have 470. Inertia larger by
/// `(l / D)^2` gives `sqrt(B / i) / l`. The larger `l`, the longer the time step, up to that of the rod, and the
/// more of a short wave comes back: for 80 nm of monomers beside 80 nm of rod in 8 segments the limit is 0.57
/// of the rod's without it, 0.97 with 5.5, 0.98 with 6.1, 0.99 with 7.5 nm (`actin check`), and of an axial pulse 20 nm
/// wide 3.1 % come back without it, 4.1, 4.2 and 4.3 % with it, of one of 40 nm 2.5, 2.6, 2.6, 2.7 %
/// (`cargo test --workspace --test integration waves::pulses -- --nocapture`).
const SWING_NM: f64 = 6.1;

/// Inertia of the junction frame of a monomer at an axial distance (nm).
fn inertia(cross_section: &CrossSection, distance: f64) -> Inertia {
    let piece = cross_section.segment_inertia(distance);
    let transverse = piece.transverse * (SWING_NM / distance).max(1.0).powi(2);
    Inertia {
        transverse,
        ..piece
    }
}

/// Refuses other than one or two attached monomers.
pub(crate) fn check_count(monomers: usize) -> Result<(), JunctionError> {
    match monomers {
        1 | 2 => Ok(()),
        _ => Err(JunctionError::AttachedMonomers(monomers)),
    }
}

/// Refuses monomers that are not on their own side of the rod's end.
pub(crate) fn check_distance(monomer: usize, distance: f64) -> Result<(), JunctionError> {
    if distance.is_finite() && distance > 0.0 {
        Ok(())
    } else {
        Err(JunctionError::AxialDistance { monomer, distance })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Vector3;

    /// About the axis the inertia of a junction frame is that of rod of the given length; across, a frame near
    /// its monomer has that of a longer one.
    #[test]
    fn frames_have_the_inertia_of_a_piece_of_rod() {
        let section = CrossSection::actin();
        let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.3);
        let mut state = State::default();
        let frames = push_junction_frames(&mut state, turn, &[8.2, 1.22], &section).unwrap();
        assert_eq!(frames, 0..2);
        for (frame, (length, scale)) in frames.zip([(8.2, 1.0), (1.22, 25.0)]) {
            assert_eq!(state.frames.orientation.get(frame), turn);
            let inverse = state.frames.inverse_moments(frame);
            let scale = Vector3::new(scale, scale, 1.0);
            let moments = section
                .segment_inertia(length)
                .moments()
                .component_mul(&scale);
            let product = inverse.component_mul(&moments);
            assert!((product - Vector3::from_element(1.0)).norm() < 1e-14);
        }
    }

    #[test]
    fn junctions_without_length_or_monomers_are_refused() {
        let mut state = State::default();
        let mut push = |distances: &[f64]| {
            let section = CrossSection::actin();
            push_junction_frames(&mut state, UnitQuaternion::identity(), distances, &section)
        };
        assert_eq!(push(&[]), Err(JunctionError::AttachedMonomers(0)));
        assert_eq!(push(&[1.0; 3]), Err(JunctionError::AttachedMonomers(3)));
        for distance in [0.0, -1.0, f64::INFINITY] {
            let monomer = 1;
            let expected = JunctionError::AxialDistance { monomer, distance };
            assert_eq!(push(&[1.0, distance]), Err(expected));
        }
        assert!(push(&[f64::NAN]).is_err());
        assert!(state.frames.is_empty());
    }
}
