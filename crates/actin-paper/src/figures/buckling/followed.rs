//! A filament that buckles while its resolution follows, for the viewer.

use crate::run::scenario;
use actin_draw::report::View;
use actin_sim::follow::Follower;
use actin_view::{Attitude, Pose, Shown, states};
use std::path::Path;

/// When it is looked at (ns): straight, bent, buckled, at rest.
const TIMES_NS: [f64; 5] = [0.0, 95.0, 125.0, 145.0, 400.0];

/// Records are every 5 ns, at whole steps.
const NEAR_NS: f64 = 1.0;

/// Runs the scene and writes the states for the viewer.
///
/// # Errors
/// A scene that cannot be read, a motion that fails, a file that cannot be written: in words.
pub(super) fn view(out: &Path) -> Result<View, String> {
    let fail = |error: &dyn std::fmt::Display| format!("following.ron: {error}");
    let follower = Follower::new(&scenario("following.ron")?).map_err(|e| fail(&e))?;
    let run = follower.run().map_err(|e| fail(&e))?;
    let shown = TIMES_NS.map(|time_ns| {
        // Behind a switch the later stretch shows what it made.
        let stretches = run.stretches.iter().rev();
        let mut found = stretches.filter_map(|ran| {
            let mut records = ran.trajectory.records.iter();
            let record = records.find(|record| (record.at.value() - time_ns).abs() < NEAR_NS)?;
            let pose = Pose::of(&ran.stretch.assembly, &record.state);
            let cells = &ran.stretch.beginning.is_monomers;
            let monomers = cells.iter().filter(|is_monomers| **is_monomers).count();
            Some((pose, 1.0 - monomers as f64 / cells.len() as f64))
        });
        let (pose, share) = found
            .next()
            .ok_or_else(|| fail(&format!("no state at {time_ns} ns")))?;
        Ok(Shown {
            group: "Pushed together by a fifth in 300 ns".into(),
            name: format!("{time_ns} ns"),
            share,
            pose,
        })
    });
    let shown: Vec<Shown> = shown.into_iter().collect::<Result<_, String>>()?;
    let caption = "A motion in time whose resolution follows it (scenarios/following.ron): cells of the rod become \
        monomers where it bends by more than 0.008 per nm, and rod again below 0.005.";
    states::write(
        "fig10_following",
        Attitude::LYING,
        &shown,
        caption.into(),
        out,
    )
}
