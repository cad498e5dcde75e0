//! The `actin` process: start, signals and end.

use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

const PATH: &str = env!("CARGO_BIN_EXE_actin");

const LOOK: Duration = Duration::from_millis(2);

/// Time within which an interrupted process must end.
const GRACE: Duration = Duration::from_mins(1);

#[derive(Debug)]
pub(super) struct Ending {
    /// Exit code; `None` after a signal.
    pub(super) code: Option<i32>,
    /// Signal that ended the process.
    pub(super) signal: Option<i32>,
    pub(super) stderr: String,
    /// True if the process was interrupted after its time limit.
    pub(super) interrupted: bool,
}

#[derive(Debug)]
pub(super) struct Started {
    child: Child,
    stderr: PathBuf,
}

pub(super) fn start(folder: &Path, arguments: &[&str], threads: u32) -> Result<Started, String> {
    let stderr = folder.join("stderr.txt");
    let create = |path: &Path| File::create(path).map_err(|e| e.to_string());
    let child = Command::new(PATH)
        .args(arguments)
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", threads.to_string())
        .stdout(create(&folder.join("stdout.txt"))?)
        .stderr(create(&stderr)?)
        .spawn()
        .map_err(|error| format!("{PATH}: {error}"))?;
    Ok(Started { child, stderr })
}

/// Starts a process and waits for its end; interrupts it after `patience`.
///
/// # Errors
/// An undocumented end.
pub(super) fn finish(
    folder: &Path,
    arguments: &[&str],
    patience: Duration,
) -> Result<Ending, String> {
    // Cases run in parallel.
    let mut started = start(folder, arguments, 1)?;
    let interrupted = !started.wait(patience)?;
    if interrupted {
        started.signal("INT")?;
        if !started.wait(GRACE)? {
            started.kill()?;
            return Err(format!("{arguments:?} went on after an interrupt"));
        }
    }
    let ending = started.ending(interrupted)?;
    ending.check(arguments)?;
    Ok(ending)
}

impl Started {
    pub(super) fn wait(&mut self, patience: Duration) -> Result<bool, String> {
        let clock = Instant::now();
        loop {
            if self.child.try_wait().map_err(|e| e.to_string())?.is_some() {
                return Ok(true);
            }
            if clock.elapsed() > patience {
                return Ok(false);
            }
            sleep(LOOK);
        }
    }

    pub(super) fn signal(&self, name: &str) -> Result<(), String> {
        let status = Command::new("kill")
            .args(["-s", name, &self.child.id().to_string()])
            .status();
        status.map(drop).map_err(|e| format!("kill: {e}"))
    }

    pub(super) fn kill(&mut self) -> Result<(), String> {
        self.child.kill().map_err(|e| e.to_string())?;
        self.child.wait().map(drop).map_err(|e| e.to_string())
    }

    pub(super) fn ending(mut self, interrupted: bool) -> Result<Ending, String> {
        let status = self.child.wait().map_err(|e| e.to_string())?;
        let stderr = fs::read(&self.stderr).map_err(|e| e.to_string())?;
        Ok(Ending {
            code: status.code(),
            signal: status.signal(),
            stderr: String::from_utf8_lossy(&stderr).into_owned(),
            interrupted,
        })
    }
}

impl Ending {
    fn check(&self, arguments: &[&str]) -> Result<(), String> {
        let shown = || {
            let head: String = self.stderr.chars().take(500).collect();
            format!(
                "{arguments:?}: {:?}, signal {:?}: {head}",
                self.code, self.signal
            )
        };
        let documented = matches!(self.code, Some(0 | 2 | 3 | 130));
        let silent = self.code.is_some_and(|code| code != 0) && self.stderr.trim().is_empty();
        // An interrupt before the handler is installed ends the process without a message.
        let early = self.interrupted && self.signal == Some(2);
        if (documented || early) && !silent && !self.stderr.contains("panicked") {
            return Ok(());
        }
        Err(shown())
    }
}
