//! What a scene costs, measured beside its estimate.

use actin_sim::cost::Cost;
use actin_sim::{Assembly, Plan, RunDirectory, Scene};
use std::fs;
use std::path::Path;
use std::time::Instant;

/// What a scene cost.
pub(super) struct Measured {
    /// Its estimate, as `actin check` prints it.
    pub(super) cost: Cost,
    /// Reading, building, estimating (s).
    pub(super) check_s: f64,
    /// The same, solving, and writing the results (s).
    pub(super) run_s: f64,
    /// The parts of that, as the estimate has them (s).
    pub(super) parts_s: [f64; 3],
    /// Newton steps; those of a motion.
    pub(super) steps: u64,
    /// Records.
    pub(super) records: usize,
    /// The most memory beyond that of the process before (MB); no number where the system does not
    /// say.
    pub(super) peak_mb: f64,
}

/// Checks and runs a scene, into a directory that is removed.
pub(super) fn measure(text: &str, out: &Path) -> Result<Measured, String> {
    let (before_mb, clock) = (reset_peak_mb(), Clock::start());
    let read = |e: &dyn std::fmt::Display| e.to_string();
    let scene = Scene::from_ron(text).map_err(|e| read(&e))?;
    let assembly = Assembly::build(&scene).map_err(|e| read(&e))?;
    let plan = Plan::new(&assembly).map_err(|e| read(&e))?;
    let cost = plan.cost();
    let check_s = clock.seconds();
    let (trajectory, report) = plan.run().map_err(|e| read(&e))?;
    let solved_s = clock.seconds();
    fs::create_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    let directory = RunDirectory::create(out, true).map_err(|e| read(&e))?;
    let written = directory.write(&plan, &trajectory, &report);
    written.map_err(|e| read(&e))?;
    let run_s = clock.seconds();
    let peak_mb = status_mb("VmHWM:") - before_mb;
    fs::remove_dir_all(out).map_err(|e| format!("{}: {e}", out.display()))?;
    Ok(Measured {
        cost,
        check_s,
        run_s,
        parts_s: [check_s, solved_s - check_s, run_s - solved_s],
        steps: report
            .equilibrium
            .map_or(report.steps, |e| e.newton_iterations),
        records: trajectory.records.len(),
        peak_mb,
    })
}

/// Time that this thread spends on a processor, which other work does not prolong; where the system
/// does not say, time on the wall.
struct Clock {
    wall: Instant,
    thread_ns: Option<f64>,
}

impl Clock {
    fn start() -> Self {
        Self {
            wall: Instant::now(),
            thread_ns: thread_ns(),
        }
    }

    fn seconds(&self) -> f64 {
        match (self.thread_ns, thread_ns()) {
            (Some(from), Some(to)) => 1e-9 * (to - from),
            _ => self.wall.elapsed().as_secs_f64(),
        }
    }
}

fn thread_ns() -> Option<f64> {
    // What is read is as old as the last time that the scheduler looked at this thread.
    std::thread::yield_now();
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok()
}

/// Lets the peak begin anew, and says what the process has at present (MB).
fn reset_peak_mb() -> f64 {
    // Where it cannot be reset, the peak is that of an earlier scene: too high, never too low.
    let _ = fs::write("/proc/self/clear_refs", "5");
    status_mb("VmRSS:")
}

fn status_mb(key: &str) -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(key));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb / 1024.0)
}
