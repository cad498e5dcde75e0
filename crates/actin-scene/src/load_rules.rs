//! Validation of loads.

use super::rules::{check_exactly_one, show};
use super::{
    ClampedEnds, Couple, Dynamics, Force, FreeTranslation, Hold, Load, Resultant, Scene,
    SceneProblem,
};

impl Load {
    pub(super) fn check(
        &self,
        i: usize,
        scene: &Scene,
        held: &ClampedEnds,
    ) -> Result<(), SceneProblem> {
        let key = format!("loads[{i}]");
        scene.named_filament(&format!("{key}.filament"), self.filament())?;
        self.factor().check(&format!("{key}.factor"))?;
        self.check_place(&key, scene)?;
        self.check_interval(&key, scene)?;
        self.check_end(&key, scene, held)
    }

    fn check_place(&self, key: &str, scene: &Scene) -> Result<(), SceneProblem> {
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
        let filament = scene.named_filament(&format!("{key}.filament"), self.filament())?;
        let length = filament.length_nm();
        match at_nm.filter(|at| !(0.0..=length).contains(at)) {
            None => Ok(()),
            Some(at) => {
                let rule = format!("must lie on the filament, from 0 to {length:?}");
                Err(SceneProblem::new(format!("{key}.at_nm"), show(at), rule))
            }
        }
    }

    fn check_interval(&self, key: &str, scene: &Scene) -> Result<(), SceneProblem> {
        let Some([from, to]) = self.interval(scene) else {
            return Ok(());
        };
        let filament = scene.named_filament(&format!("{key}.filament"), self.filament())?;
        let length = filament.length_nm();
        if !(0.0..length).contains(&from) {
            let rule = format!("must be at least 0 and below the filament's length, {length:?}");
            return Err(SceneProblem::new(
                format!("{key}.from_nm"),
                show(from),
                rule,
            ));
        }
        if !(to > from && to <= length) {
            let rule = format!(
                "must be greater than from_nm = {from:?}, and at most the filament's length, {length:?}"
            );
            return Err(SceneProblem::new(format!("{key}.to_nm"), show(to), rule));
        }
        Ok(())
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

/// Checks for `stop` and `leave_saddles` that all factors become constant within the duration.
pub(super) fn check_rest(scene: &Scene, dynamics: &Dynamics) -> Result<(), SceneProblem> {
    let key = match dynamics {
        Dynamics { stop: Some(_), .. } => "stop",
        Dynamics {
            leave_saddles: 1.., ..
        } => "leave_saddles",
        _ => return Ok(()),
    };
    let settles = |load: &Load| load.factor().settles_at();
    let late = |load: &Load| settles(load) >= dynamics.duration_ns;
    let Some(i) = scene.loads.iter().position(late) else {
        return Ok(());
    };
    let until = settles(&scene.loads[i]);
    let rule = if until.is_infinite() {
        format!("loads[{i}] has the factor Sine, so the filament never comes to rest: omit {key}")
    } else {
        format!(
            "the factor of loads[{i}] changes until {until:?} ns, so the filament cannot come to rest within \
             duration_ns = {:?}: increase duration_ns, or omit {key}",
            dynamics.duration_ns
        )
    };
    Err(SceneProblem::new(format!("task.{key}"), "", rule))
}
