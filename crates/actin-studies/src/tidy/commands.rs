//! Commands in the documentation: their tasks, test programs and examples exist.

use super::files;
use clap::CommandFactory;
use std::path::Path;

const TASKS: [&str; 3] = ["check", "trials", "wheel"];

/// Options and folders of programs: `tests/NAME/main.rs` or `tests/NAME.rs`, in the root and in each crate.
const KINDS: [(&str, &str); 3] = [
    ("--test", "tests"),
    ("--example", "examples"),
    ("--bench", "benches"),
];

pub(super) fn findings(root: &Path) -> Result<Vec<String>, String> {
    let arguments = crate::Arguments::command();
    let studies = arguments.get_subcommands().map(clap::Command::get_name);
    let tasks: Vec<&str> = studies.chain(TASKS).collect();
    let mut all = Vec::new();
    for (file, text) in files(root, "md")? {
        let name = file.strip_prefix(root).unwrap_or(&file).display();
        for (kind, named) in commands(&text) {
            let exists = match KINDS.iter().find(|(flag, _)| *flag == kind) {
                Some((_, folder)) => is_program(root, folder, named)?,
                None => tasks.contains(&named),
            };
            if !exists {
                all.push(format!("{name}: {kind} {named} does not exist"));
            }
        }
    }
    Ok(all)
}

/// Returns the words after `cargo xtask`, `--test`, `--example` and `--bench`, except placeholders in capitals.
fn commands(text: &str) -> Vec<(&str, &str)> {
    let is_kind = |word: &str| word == "xtask" || KINDS.iter().any(|(flag, _)| *flag == word);
    let words: Vec<&str> = text.split_whitespace().collect();
    let is_command =
        |three: &&[&str]| is_kind(three[1]) && (three[1] != "xtask" || three[0].ends_with("cargo"));
    let pairs = words.windows(3).filter(is_command);
    let of_name = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    pairs
        .map(|three| (three[1], three[2].trim_end_matches(|c| !of_name(c))))
        .filter(|(_, name)| name.chars().all(|c| of_name(c) && !c.is_ascii_uppercase()))
        .filter(|(_, name)| name.starts_with(|c: char| c.is_ascii_lowercase()))
        .collect()
}

fn is_program(root: &Path, folder: &str, name: &str) -> Result<bool, String> {
    let lies_in = |parent: &Path| {
        let place = parent.join(folder);
        place.join(format!("{name}.rs")).exists() || place.join(name).join("main.rs").exists()
    };
    let crates = std::fs::read_dir(root.join("crates")).map_err(|e| format!("crates: {e}"))?;
    let mut crates = crates.filter_map(Result::ok);
    Ok(lies_in(root) || crates.any(|entry| lies_in(&entry.path())))
}

#[cfg(test)]
mod tests {
    use super::commands;

    #[test]
    fn commands_are_found_in_text() {
        let text = "`cargo xtask docs`: see `cargo test -p a --test waves -- --nocapture`, or \
                    `cargo run --example NAME`; `cargo xtask` and `xtask/src`.";
        let expected = [("xtask", "docs"), ("--test", "waves")];
        assert_eq!(commands(text), expected);
    }
}
