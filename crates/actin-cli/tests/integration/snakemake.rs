//! A sweep as a Snakemake workflow, killed and run again.
#![cfg(unix)]

use crate::common::{Workplace, pushed, with_actin};
use std::fs;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const SWEEP: &str = "Sweep(
    scene: \"scene.ron\",
    vary: [List(key: \"loads[0].force_pn[2]\", values: [0.0, -1.5, inf])],
    samples: Samples(number: 4),
    results: [\"tip_displacement_nm[0]\", \"energy_pn_nm.total\"],
)";

/// Returns the Snakemake command with the built `actin` on its path, if Snakemake is installed.
fn snakemake(folder: &Path) -> Option<Command> {
    let program = std::env::var("SNAKEMAKE").unwrap_or_else(|_| "snakemake".into());
    let is_there = Command::new(&program).arg("--version").output();
    if !is_there.is_ok_and(|output| output.status.success()) {
        let required = std::env::var_os("ACTIN_REQUIRE_SNAKEMAKE").is_some();
        assert!(!required, "snakemake is missing (SNAKEMAKE or on the path)");
        println!("SKIPPED: snakemake is missing");
        return None;
    }
    let mut command = with_actin(&program, &folder.join("workflow"));
    command
        .args(["--cores", "2", "--quiet", "all"])
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .stdout(Stdio::null());
    Some(command)
}

fn has(place: &Workplace, name: &str) -> bool {
    let runs = fs::read_dir(place.path("workflow/runs"));
    let mut runs = runs.into_iter().flatten();
    runs.any(|run| run.unwrap().path().join(name).exists())
}

fn kill_half_way(place: &Workplace, command: &mut Command) {
    let mut child = command.process_group(0).spawn().unwrap();
    let patience = Instant::now();
    while !(has(place, "checkpoint.bin") && has(place, "summary.json")) {
        assert!(patience.elapsed() < Duration::from_mins(2), "no run begins");
        assert!(
            child.try_wait().unwrap().is_none(),
            "done before it was killed"
        );
        std::thread::sleep(Duration::from_millis(2));
    }
    let group = format!("-{}", child.id());
    let killed = Command::new("kill")
        .args(["-9", "--", &group])
        .status()
        .unwrap();
    assert!(killed.success());
    child.wait().unwrap();
    assert!(!place.path("workflow/table.csv").exists());
    assert!(
        has(place, "checkpoint.bin"),
        "Snakemake leaves checkpoints alone"
    );
}

#[test]
fn a_workflow_that_is_killed_ends_with_the_same_table() {
    let place = Workplace::with(&pushed(60.0));
    let folder = place.path("");
    place.write("sweep.ron", SWEEP);
    let emit = "sweep sweep.ron --out workflow --emit snakemake";
    let emit: Vec<&str> = emit.split(' ').collect();
    let output = place.succeed(&emit);
    assert!(output.ends_with("cd workflow && snakemake --cores all\n"));
    // A short interval, so that there is a checkpoint when the workflow is killed.
    let workflow = place.read("workflow/Snakefile");
    let quick = workflow.replace("--only", "--checkpoint-every 0.01 --only");
    place.write("workflow/Snakefile", quick);
    let Some(mut command) = snakemake(&folder) else {
        return;
    };
    kill_half_way(&place, &mut command);
    let again = snakemake(&folder).unwrap().status().unwrap();
    assert!(again.success());
    place.succeed(&["sweep", "sweep.ron", "--out", "whole"]);
    place.assert_same(["workflow", "whole"], &["table.csv", "runs.csv"]);
    assert!(!has(&place, "checkpoint.bin"));
}
