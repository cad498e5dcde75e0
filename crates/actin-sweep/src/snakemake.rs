//! Export of a sweep as a Snakemake workflow.

use crate::files::{self, PROFILE, SNAKEFILE};
use crate::{SweepCost, SweepDirectory, SweepError, ValidatedSweep};

const WORKFLOW: &str = r#"# A sweep of actin scenes for Snakemake 9, written by `actin sweep --emit snakemake`.
#
#   snakemake --cores all                    on this machine
#   snakemake --executor slurm --jobs 100    on a cluster, with the corresponding plugin
#
# Each run has a row in parameters.csv and a directory in runs/. Only its summary.json is declared as an
# output, since Snakemake deletes outputs before it repeats a job, and checkpoints must be kept. A numerical
# failure is a row of the table, not a failed job.
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

/// Template of the Snakemake profile.
const SETTINGS: &str = "# Settings of the workflow, read by Snakemake.
rerun-incomplete: true
# Each run locks its own directory. A killed Snakemake leaves its lock, which would block the next start.
nolock: true
rerun-triggers: mtime
keep-going: true
# Number of runs in one cluster job, from their estimated time.
group-components:
  - runs=@GROUP@
";

/// Minimum time of a cluster job (s); short runs are grouped.
const JOB_S: f64 = 600.0;

/// Memory of the program without the run (MB).
const PROGRAM_MB: f64 = 100.0;

impl SweepDirectory {
    /// Writes the `Snakefile` and its profile into the directory.
    ///
    /// # Errors
    /// If a file system operation fails.
    pub fn write_snakemake(
        &self,
        opened: &ValidatedSweep,
        priced: &SweepCost,
    ) -> Result<(), SweepError> {
        let runs = opened.design.len() as f64;
        // A run of unknown duration is a separate job.
        let run_s = priced.run_s().unwrap_or(JOB_S).max(1e-3);
        // Allows for a machine three times slower, plus one minute.
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
