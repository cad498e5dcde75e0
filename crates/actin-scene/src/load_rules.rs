//! Validation of loads.

use super::rules::{check_exactly_one, check_on_filament, show};
use super::{
    ClampedEnds, Couple, Force, FreeTranslation, Hold, Load, Resultant, Scene, SceneProblem,
};

impl Load {
    pub(super) fn check(
        &self,
        i: usize,
        scene: &Scene,
        held: &ClampedEnds,
    ) -> Result<(), SceneProblem> {
        let key = format!("loads[{i}]");
        let filament = scene.named_filament(&format!("{key}.filament"), self.filament())?;
        let length = filament.length_nm();
        self.factor().check(&format!("{key}.factor"))?;
        self.check_place(&key, length)?;
        if let Some(interval) = self.interval(scene) {
            check_interval(&key, interval, length)?;
        }
        self.check_end(&key, scene, held)
    }

    fn check_place(&self, key: &str, length: f64) -> Result<(), SceneProblem> {
        let (Self::Force(Force { end, at_nm, .. }) | Self::Couple(Couple { end, at_nm, .. })) =
            self
        else {
            return Ok(());
        };
        check_exactly_one(
            key,
            [("end", end.map(show)), ("at_nm", at_nm.map(show))],
            "position",
        )?;
        at_nm.map_or(Ok(()), |at_nm| {
            check_on_filament(&format!("{key}.at_nm"), at_nm, length)
        })
    }

    /// Refuses a force on an end that cannot move and a couple on an end that cannot rotate.
    fn check_end(&self, key: &str, scene: &Scene, held: &ClampedEnds) -> Result<(), SceneProblem> {
        let Some(end) = self.end() else {
            return Ok(());
        };
        let clamp = held.clamp_at(self.filament(), end);
        let Some(clamp) = clamp.map(|c| &scene.clamps[c]) else {
            return Ok(());
        };
        let is_couple = matches!(self, Self::Couple(_));
        let rule = if is_couple && clamp.hold == Hold::Pin {
            return Ok(());
        } else if is_couple {
            "this end is clamped: a couple on it has no effect"
        } else if clamp.slides == FreeTranslation::Nowhere {
            "this end is clamped: a force on it has no effect"
        } else {
            return Ok(());
        };
        Err(SceneProblem::new(format!("{key}.end"), show(end), rule))
    }

    /// Creates the error that the value of load `i` breaks a rule.
    pub fn problem(&self, i: usize, rule: String) -> SceneProblem {
        let (name, size) = self.written();
        SceneProblem::new(format!("loads[{i}].{name}"), show(size), rule)
    }

    /// Smallest force (pN) or torque (pN nm) on a single body, for comparison with tolerances: half of a load at a
    /// point, or the load on 1 nm of an interval.
    pub(super) fn least(&self, scene: &Scene) -> Resultant {
        let part = match self.interval(scene) {
            None => 0.5,
            Some([from, to]) => (1.0 / (to - from)).min(1.0),
        };
        match self.resultant(scene) {
            Resultant::Force(force) => Resultant::Force(force * part),
            Resultant::Couple(couple) => Resultant::Couple(couple * part),
        }
    }
}

fn check_interval(key: &str, [from, to]: [f64; 2], length: f64) -> Result<(), SceneProblem> {
    if !(0.0..length).contains(&from) {
        let rule = format!("must be at least 0 and below the filament's length, {length:?}");
        let key = format!("{key}.from_nm");
        return Err(SceneProblem::new(key, show(from), rule));
    }
    if to > from && to <= length {
        return Ok(());
    }
    let rule = format!(
        "must be greater than from_nm = {from:?}, and at most the filament's length, {length:?}"
    );
    Err(SceneProblem::new(format!("{key}.to_nm"), show(to), rule))
}

/// Checks for `Equilibrium` that loads have a potential and are constant in time.
pub(super) fn check_statics(scene: &Scene) -> Result<(), SceneProblem> {
    for (i, load) in scene.loads.iter().enumerate() {
        if load.follows() {
            let rule = "a load that rotates with the filament has no potential, which Equilibrium requires: \
                        write Dynamics with drag";
            return Err(SceneProblem::new(format!("loads[{i}].follows"), true, rule));
        }
        if !load.factor().is_constant() {
            let rule = "Equilibrium is time-independent: omit the factor, and write LoadFactor in \
                        stages of the path";
            return Err(SceneProblem::new(format!("loads[{i}].factor"), "", rule));
        }
    }
    Ok(())
}
