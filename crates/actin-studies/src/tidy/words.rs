//! Words that are forbidden in a crate.

const FORBIDDEN: [(&str, &[&str]); 6] = [
    (
        "crates/actin-mechanics/src",
        &["monomer", "filament", "cosserat", "helix", "bond"],
    ),
    (
        "crates/actin-integrate/src",
        &["monomer", "filament", "cosserat", "helix"],
    ),
    (
        "crates/actin-equilibrium/src",
        &["monomer", "actin ", "cosserat", "helix"],
    ),
    (
        "crates/actin-brownian/src",
        &["monomer", "filament", "cosserat", "helix", "linker"],
    ),
    (
        "crates/actin-fit/src",
        &[
            "monomer", "actin ", "filament", "cosserat", "helix", "rigidity",
        ],
    ),
    (
        "crates/actin-draw/src",
        &[
            "monomer", "actin ", "filament", "cosserat", "helix", "bond", "linker", "rigidity",
        ],
    ),
];

pub(super) fn findings(name: &str, text: &str) -> Vec<String> {
    let forbidden: Vec<&str> = FORBIDDEN
        .iter()
        .filter(|(folder, _)| name.starts_with(folder))
        .flat_map(|(_, words)| words.iter().copied())
        .collect();
    let mut all = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let line = line.to_lowercase();
        for word in forbidden.iter().filter(|word| line.contains(**word)) {
            all.push(format!(
                "{name}:{}: the word {word} is forbidden in this crate",
                i + 1
            ));
        }
    }
    all
}
