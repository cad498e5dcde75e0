//! Keys of the text that generate filaments and linkers.

use super::Arrangement;
use super::scene_file::SceneFile;

/// Keys of linkers of pools and the keys of [`Crosslinkers`](super::Crosslinkers) that set them.
const POOL_KEYS: [(&str, &str); 6] = [
    (".kinetics.breaks", ".unbinds"),
    (".kinetics.forms.rate_per_ns", ".bind_per_ns"),
    (".kinetics.forms", ""),
    (".kinetics.roams", ""),
    (".kinetics", ""),
    (".to", ""),
];

impl SceneFile {
    /// Returns the key that generates the filament or linker of `key`, such as `crosslinkers[0].unbinds`; `None` if it
    /// is written itself.
    pub(super) fn generating_key(&self, key: &str) -> Option<String> {
        if let Some((index, rest)) = element(key, "linkers") {
            let arranged = self.arrangements.iter().map(Arrangement::count);
            let filaments = arranged.fold(self.count_written_filaments(), usize::saturating_add);
            let sets = self.linker_sets.iter().map(|set| set.count(filaments));
            let pools = self.crosslinkers.iter().map(|pool| pool.count);
            let group = group(
                index,
                std::iter::once(self.linkers.len()).chain(sets).chain(pools),
            )?
            .checked_sub(1)?;
            return Some(match group.checked_sub(self.linker_sets.len()) {
                None => format!("linker_sets[{group}]{rest}"),
                Some(pool) => format!("crosslinkers[{pool}]{}", pool_key(rest)),
            });
        }
        let first = key
            .strip_prefix("filament")
            .filter(|rest| rest.is_empty() || rest.starts_with('.'));
        let (index, rest) = first
            .map(|rest| (0, rest))
            .or_else(|| element(key, "filaments"))?;
        let arranged = self.arrangements.iter().map(Arrangement::count);
        let group = group(
            index,
            std::iter::once(self.count_written_filaments()).chain(arranged),
        )?
        .checked_sub(1)?;
        Some(format!("arrangements[{group}].filament{rest}"))
    }
}

/// Splits `list[index]rest`.
fn element<'a>(key: &'a str, list: &str) -> Option<(usize, &'a str)> {
    let (index, rest) = key.strip_prefix(list)?.strip_prefix('[')?.split_once(']')?;
    Some((index.parse().ok()?, rest))
}

/// Returns the group of the element `index` of consecutive groups.
fn group(index: usize, counts: impl Iterator<Item = usize>) -> Option<usize> {
    let mut ends = counts.scan(0, |end, count| {
        // Counts may be out of range here.
        *end = usize::saturating_add(*end, count);
        Some(*end)
    });
    ends.position(|end| index < end)
}

fn pool_key(rest: &str) -> String {
    let known = POOL_KEYS
        .iter()
        .find_map(|(long, short)| Some((rest.strip_prefix(long)?, short)));
    known.map_or_else(|| rest.to_owned(), |(rest, short)| format!("{short}{rest}"))
}

#[cfg(test)]
mod tests {
    use crate::{SceneProblem, SceneText};

    const SCENE: &str = "Scene(
    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 1000.0)]),
    arrangements: [
        Copies(filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 900.0)]), count: 3, shift_nm: (0.0, 9.0, 0.0)),
    ],
    linkers: [Linker(filament: 0, at_nm: 5.0, stiffness_pn_per_nm: 1.0)],
    linker_sets: [LinkersBetween(per_filament: 0.5, reach_nm: 50.0, stiffness_pn_per_nm: 0.1, seed: 1)],
    crosslinkers: [
        Crosslinkers(
            count: 2, stiffness_pn_per_nm: 0.2, rest_length_nm: 30.0, attach_per_ns: 1e-5,
            bind_per_ns: 2e-6, unbinds: Breaking(rate_per_ns: 1e-7), seed: 1,
        ),
    ],
    task: Brownian(duration_ms: 1.0, temperature_k: 298.0),
)";

    #[test]
    fn problems_of_generated_elements_have_the_place_of_their_origin() {
        let text = SceneText::new(SCENE);
        let places = [
            ("filament.sections", "2:24: filament.sections: "),
            ("filaments[0].sections", "2:24: filaments[0].sections: "),
            (
                "filaments[1].sections",
                "4:35: arrangements[0].filament.sections: ",
            ),
            (
                "filaments[3].sections[0].to_nm",
                "4:64: arrangements[0].filament.sections[0].to_nm: ",
            ),
            ("linkers[0].at_nm", "6:35: linkers[0].at_nm: "),
            ("linkers[2].to", "7:19: linker_sets[0].to: "),
            ("linkers[3].kinetics", "9:9: crosslinkers[0]: "),
            (
                "linkers[4].kinetics.breaks.rate_per_ns",
                "11:50: crosslinkers[0].unbinds.rate_per_ns: ",
            ),
            (
                "linkers[4].kinetics.forms.reach_nm",
                "9:9: crosslinkers[0].reach_nm: ",
            ),
            ("linkers[5].kinetics", "6:5: linkers[5].kinetics: "),
        ];
        for (key, expected) in places {
            let error = text.locate(&SceneProblem::new(key, "", "")).to_string();
            assert_eq!(error, expected, "{key}");
        }
    }
}
