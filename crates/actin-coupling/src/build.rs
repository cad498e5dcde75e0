use crate::JunctionError;
use actin_cosserat::CrossSection;
use actin_mechanics::{Frame, Inertia, State, UnitQuaternion};
use std::ops::Range;

/// Appends the junction frames of a junction to a state and returns their indices.
///
/// `axial_distances` (nm) are measured from the centre of each monomer to the end of the rod along
/// the axis, in filament order. With a rise `z` and the rod end half a rise from the last monomer
/// they are `[3 z / 2, z / 2]` before a rod and `[z / 2, 3 z / 2]` after it. `orientation` (body to
/// lab) is the rest orientation of the segments. Each frame has the inertia of a piece of rod of
/// its axial distance, with a larger transverse inertia next to the monomer.
///
/// # Errors
/// If there are not one or two monomers, or a distance is not positive and finite. The state is
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

/// Length (nm) that limits the frequency of junction frames.
///
/// A junction frame at the distance `D` from its monomer has the frequency `sqrt(B / i) / D`. `B`
/// is the bending rigidity and `i` the transverse inertia per length of the rod. At half a rise
/// this is 870 rad/ns, above the highest frequency of the bonds (470 rad/ns). An inertia larger by
/// `(l / D)^2` reduces it to `sqrt(B / i) / l`. Larger `l` increases the time step and the
/// reflection of short waves.
///
/// Table for 80 nm of monomers next to 80 nm of rod in 8 segments. The time step limit is relative
/// to the limit of the rod (`actin check`). Axial pulses have widths of 20 and 40 nm (`cargo test
/// --workspace --test integration waves::pulses -- --nocapture`).
///
/// | `l` (nm) | time step limit | reflection, 20 nm | reflection, 40 nm |
/// | --- | --- | --- | --- |
/// | 0 (off) | 0.57 | 3.1 % | 2.5 % |
/// | 5.5 | 0.97 | 4.1 % | 2.6 % |
/// | 6.1 | 0.98 | 4.2 % | 2.6 % |
/// | 7.5 | 0.99 | 4.3 % | 2.7 % |
const SWING_NM: f64 = 6.1;

fn inertia(cross_section: &CrossSection, distance: f64) -> Inertia {
    let piece = cross_section.segment_inertia(distance);
    let transverse = piece.transverse * (SWING_NM / distance).max(1.0).powi(2);
    Inertia {
        transverse,
        ..piece
    }
}

pub(crate) fn check_count(monomers: usize) -> Result<(), JunctionError> {
    match monomers {
        1 | 2 => Ok(()),
        _ => Err(JunctionError::AttachedMonomers(monomers)),
    }
}

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

    /// The axial inertia equals the inertia of a piece of rod; the transverse inertia has a lower
    /// limit.
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
