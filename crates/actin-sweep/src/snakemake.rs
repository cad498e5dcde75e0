//! A sweep as a workflow for Snakemake, and so for the clusters that it knows.

use crate::files::{self, PROFILE, SNAKEFILE};
use crate::{Opened, Priced, SweepDirectory, SweepError};

/// What the workflow says, but for its numbers.
const WORKFLOW: &str = r#"# A sweep of actin scenes for Snakemake 9, written by `actin sweep --emit snakemake`.
#
#   snakemake --cores all                    here
#   snakemake --executor slurm --jobs 100    on a cluster, with the plugin for it
#
# Each run has a row in parameters.csv and a directory in runs/. Only its summary.json is an output:
# Snakemake deletes outputs before it runs a job again, and the checkpoint has to stay. A run that fails
# in its numbers is a row of the table, not a failed job.
import csv


workdir: workflow.basedir


with open("parameters.csv") as file:
    RUNS = [row["run"] for row in csv.DictReader(file)]


rule all:
    input:
        "table.csv",


rule run:
    output:
        "runs/{run}/summary.json",
    group:
        "runs"
    retries: 2
    threads: 1
    resources:
        mem_mb=@MEMORY@,
        runtime=@MINUTES@,
    shell:
        "actin sweep sweep.ron --out . --only {wildcards.run}"


rule table:
    localrule: True
    input:
        expand("runs/{run}/summary.json", run=RUNS),
    output:
        "table.csv",
        "runs.csv",
    shell:
        "actin sweep sweep.ron --out . --resume"
"#;

/// Settings that Snakemake takes from the folder of a workflow.
const SETTINGS: &str = "# Settings for Snakemake, which finds this file beside the Snakefile.
rerun-incomplete: true
# Every run locks its own directory, also where Snakemake was killed and left its lock.
nolock: true
rerun-triggers: mtime
keep-going: true
# Runs that a cluster gets as one job, by their estimated time.
group-components:
  - runs=@GROUP@
";

/// Time that a job on a cluster should take at least (s): runs are grouped up to it.
const JOB_S: f64 = 600.0;

/// Memory of the program itself (MB).
const PROGRAM_MB: f64 = 100.0;

impl SweepDirectory {
    /// Writes `Snakefile` and its settings into the directory, which Snakemake then runs; nothing is run.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn write_snakemake(&self, opened: &Opened, priced: &Priced) -> Result<(), SweepError> {
        let runs = opened.design.len() as f64;
        // A run of unknown duration gets a separate job.
        let run_s = priced.run_s().unwrap_or(JOB_S).max(1e-3);
        // Of a machine a third as fast, and a minute for what else there is.
        let group = (JOB_S / run_s).clamp(1.0, runs).ceil();
        let minutes = (3.0 * run_s / 60.0 + 1.0).ceil();
        let memory = (2.0 * priced.bytes / 1e6 + PROGRAM_MB).ceil();
        let numbers = [
            ("@MEMORY@", memory),
            ("@MINUTES@", minutes),
            ("@GROUP@", group),
        ];
        let filled = |text: &str| {
            numbers
                .iter()
                .fold(text.to_owned(), |text, (name, number)| {
                    text.replace(name, &format!("{number:.0}"))
                })
        };
        files::replace(self.path(), SNAKEFILE, filled(WORKFLOW).as_bytes())?;
        files::replace(self.path(), PROFILE, filled(SETTINGS).as_bytes())
    }
}
