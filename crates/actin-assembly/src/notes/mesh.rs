//! Warnings on segments that are too long for bending, or too short for random stress.

use crate::scene::{Hold, RodLaw, Task};
use crate::{Assembly, COARSE_IN_HEAT, Rod};

/// Largest relative error of displacements without a warning.
const LONG: f64 = 0.1;

/// Relative error of displacements for the proposed segments.
const FINE: f64 = 0.01;

/// Length (nm) of segments below which the random stress of `Brownian` is inaccurate under
/// `Homogenised` at 298 K.
///
/// # Source
/// `docs/measured/heat.md`, "Segment length".
const SHORTEST_IN_WATER_NM: f64 = 15.0;

impl Assembly {
    /// Warning on steps of `Brownian` for rods whose segments bend far in heat.
    pub(super) fn coarse_in_water(&self) -> Option<String> {
        if !matches!(self.scene.task, Task::Brownian(_)) {
            return None;
        }
        let kt = self.scene.thermal()?.energy_pn_nm();
        let rods = self.rods.iter();
        let bent = rods.filter(|rod| rod.layout.segment_lengths().len() > 1);
        let rods = bent.map(|rod| (rod.over_persistence_length(kt), rod.longest_segment()));
        let (ratio, longest) = rods.max_by(|a, b| a.0.total_cmp(&b.0))?;
        (ratio > COARSE_IN_HEAT).then(|| {
            format!(
                "segments of {longest:.1} nm bend by {:.2} rad (rms) against each other: mean bending angles of free rods \
                 have errors of up to {:.0} %, also in shorter steps. Use segments of at most {:.1} nm for 1 %",
                (2.0 * ratio).sqrt(),
                60.0 * ratio,
                longest * COARSE_IN_HEAT / ratio
            )
        })
    }

    pub(super) fn short_segments_in_water(&self) -> Option<String> {
        let is_stressed = matches!(self.scene.task, Task::Brownian(_))
            && self.scene.thermal().is_some()
            && self.counts().bonds == 0;
        let is_heated = |rod: &&Rod| {
            let law = self.rod_model_of(rod.section).law;
            matches!(law, RodLaw::Homogenised | RodLaw::HomogenisedAt298K)
        };
        let rods = self.rods.iter().filter(|_| is_stressed).filter(is_heated);
        let lengths = rods.flat_map(|rod| rod.layout.segment_lengths());
        let shortest = lengths.copied().min_by(f64::total_cmp)?;
        (shortest < SHORTEST_IN_WATER_NM).then(|| {
            format!(
                "overdamped rods with the law Homogenised in segments of {shortest:.1} nm: the random stress of long steps is \
                 not exact for this law. The tension of 60 nm between walls is 11 and 2.4 % too large with segments of 5 and 10 nm, and 0.5 % \
                 too small with 20 nm; use segments of 20 nm or more (docs/measured/heat.md)"
            )
        })
    }

    pub(super) fn long_segments(&self) -> Vec<String> {
        let filaments = 0..self.filaments.len();
        let notes = filaments.filter_map(|filament| {
            let bound = self.bending_error(filament).filter(|bound| *bound > LONG)?;
            let finer = (bound / FINE).sqrt().ceil();
            let longest = self.segments_of(filament).fold(0.0, f64::max);
            Some(format!(
                "filament {filament}: segments of {longest:.1} nm are too long for bending: displacements under a transverse end \
                 force have errors of up to {:.0} %. Use segments {finer:.0} times shorter for errors of 1 %",
                100.0 * bound
            ))
        });
        notes.collect()
    }

    /// Upper bound of the relative error of the end displacement under a transverse force; `None`
    /// without a wall.
    ///
    /// Curvature is sampled at the ends of segments, which is the trapezoidal rule. For segments
    /// `h` of a filament of length `L` the bound is
    ///
    /// ```text
    /// sum h^3 / (2 L^3)    one wall (cantilever)
    /// 2 sum h^3 / L^3      two walls
    /// ```
    ///
    /// Shear has no such error. Measured errors in per cent under `Homogenised` and `Fitted`, at
    /// 0.1 and 1 pN and 100 to 200 nm, with the bound in brackets:
    ///
    /// - cantilevers: 1 segment -23 to +42 (50), 2 segments -3 to +10 (12.5), 4 segments +0.9 to
    ///   +2.7 (3.1);
    /// - between two walls: 1 segment 66 to 165 (200), 4 segments 4 to 9 (12.5);
    /// - a segment of 100 nm before 60 nm of monomers: 9 to 10 (12.2).
    fn bending_error(&self, filament: usize) -> Option<f64> {
        let clamps = self.scene.clamps.iter();
        let walls = clamps.filter(|c| c.filament == filament && c.hold == Hold::Wall);
        let factor = match walls.count() {
            0 => return None,
            1 => 0.5,
            _ => 2.0,
        };
        let length = self.written(filament).length_nm();
        let cubes: f64 = self.segments_of(filament).map(|h| h.powi(3)).sum();
        Some(factor * cubes / length.powi(3))
    }

    fn segments_of(&self, filament: usize) -> impl Iterator<Item = f64> + '_ {
        let rods = self.rods.iter();
        let own = rods.filter(move |rod| self.filament_of_section(rod.section) == filament);
        own.flat_map(|rod| rod.layout.segment_lengths().iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use crate::Assembly;
    use crate::scene::Scene;

    fn scene(sections: &str, clamps: &str) -> Assembly {
        let text = format!(
            "Scene(filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)), clamps: [{clamps}],
                loads: [EndForce(end: End, force_pn: (0.01, 0.0, 0.01))], task: Equilibrium())"
        );
        Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
    }

    fn cantilever(segments: usize) -> Assembly {
        let rod = format!("Rod(from_nm: 0.0, to_nm: 400.0, segments: {segments})");
        scene(&rod, "Clamp(end: Start)")
    }

    #[test]
    fn short_segments_in_water_are_noted() {
        let noted = |law: &str, segments: usize, kelvin: f64| {
            let text = format!(
                "Scene(
                    filament: Filament(
                        sections: [Rod(from_nm: 0.0, to_nm: 60.0, segments: {segments})],
                        rod: RodModel(law: {law}),
                    ),
                    task: Brownian(duration_ms: 1e-3, temperature_k: {kelvin:?}),
                )"
            );
            let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
            assembly.short_segments_in_water()
        };
        let note = noted("Homogenised", 6, 298.0).unwrap();
        assert!(note.contains("in segments of 10.0 nm"), "{note}");
        assert_eq!(noted("Homogenised", 3, 298.0), None);
        assert_eq!(noted("Homogenised", 6, 0.0), None);
        assert_eq!(noted("Constant", 6, 298.0), None);
        assert_eq!(noted("HomogenisedAthermal", 6, 298.0), None);
    }

    #[test]
    fn coarse_segments_in_water_are_noted() {
        let noted = |segments: usize| {
            let text = format!(
                "Scene(
                    filament: Filament(
                        sections: [Rod(from_nm: 0.0, to_nm: 3000.0, segments: {segments})],
                        rod: RodModel(law: Constant),
                    ),
                    task: Brownian(duration_ms: 1.0, temperature_k: 298.0),
                )"
            );
            let assembly = Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap();
            assembly.coarse_in_water()
        };
        let note = noted(3).unwrap();
        assert!(note.contains("errors of up to 6 %"), "{note}");
        assert_eq!(noted(30), None);
    }

    #[test]
    fn long_segments_at_walls_are_noted() {
        let one = "Rod(from_nm: 0.0, to_nm: 100.0, segments: 1)";
        let found = scene(one, "Clamp(end: Start)").long_segments();
        assert!(
            found[0].contains("errors of up to 50 %. Use segments 8 times shorter"),
            "{found:?}"
        );
        let mixed = format!("{one}, Ellipsoids(from_nm: 100.0, to_nm: 160.0)");
        let found = scene(&mixed, "Clamp(end: Start)").long_segments();
        assert!(found[0].contains("errors of up to 12 %"), "{found:?}");
        let both = "Clamp(end: Start), Clamp(end: End, slides: Freely)";
        assert!(scene(one, both).long_segments()[0].contains("200 %"));
        let pinned = "Clamp(end: Start, hold: Pin), Clamp(end: End, hold: Pin, slides: AlongAxis)";
        assert_eq!(scene(one, pinned).long_segments(), [""; 0]);
        assert_eq!(cantilever(3).long_segments(), [""; 0]);
    }

    /// The sum of the cubes of `n` equal segments over 2 L^3.
    #[test]
    fn the_bound_is_quadratic() {
        for segments in [1, 2, 4] {
            let bound = cantilever(segments).bending_error(0).unwrap();
            let expected = 0.5 / (segments * segments) as f64;
            assert!(
                (bound / expected - 1.0).abs() < 1e-12,
                "{segments}: {bound}"
            );
        }
    }
}
