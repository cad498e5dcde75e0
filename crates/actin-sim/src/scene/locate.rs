//! Finds the line and column of a key in the text of a scene, and the key at a line and column.
//!
//! A reader of its own that knows just enough of RON (brackets, keys, strings, comments) to say
//! where `filament.sections[1].to_nm` stands. It never refuses a text: that is for RON to do.

/// One step of a path: a key of a structure or an index of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Step {
    Key(String),
    Index(usize),
}

/// Line and column (from 1) of the key `path`, or of the innermost key above it that is written.
pub(super) fn position(text: &str, path: &str) -> (usize, usize) {
    let mut search = Search::new(text, steps(path));
    search.scan();
    search.best.1
}

/// Whether the key `path` is written.
pub(super) fn is_written(text: &str, path: &str) -> bool {
    let mut search = Search::new(text, steps(path));
    search.scan();
    search.best.0 == search.target.len()
}

/// Path of the innermost key or list element that begins at or before a line and column and is
/// not closed before it; empty outside of all.
pub(super) fn path_at(text: &str, place: (usize, usize)) -> String {
    let mut search = Search::new(text, Vec::new());
    search.until = Some(place);
    search.scan();
    written(&search.here())
}

/// The text behind a byte-order mark, which takes no column.
pub(super) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

fn written(path: &[Step]) -> String {
    let steps = path.iter().enumerate().map(|(i, step)| match step {
        Step::Key(key) if i == 0 => key.clone(),
        Step::Key(key) => format!(".{key}"),
        Step::Index(index) => format!("[{index}]"),
    });
    steps.collect()
}

fn steps(path: &str) -> Vec<Step> {
    path.split(['.', '['])
        .map(|step| match step.strip_suffix(']') {
            Some(index) => index.parse().map_or(Step::Key(index.into()), Step::Index),
            None => Step::Key(step.into()),
        })
        .collect()
}

/// What stands between an opening bracket and its closing one.
struct Level {
    is_list: bool,
    index: usize,
    key: Option<String>,
    element_begins: bool,
}

struct Search<'a> {
    rest: std::iter::Peekable<std::str::Chars<'a>>,
    place: (usize, usize),
    levels: Vec<Level>,
    target: Vec<Step>,
    /// Number of steps of the target that were found, and where the last of them stands.
    best: (usize, (usize, usize)),
    /// Where to stop reading.
    until: Option<(usize, usize)>,
}

impl<'a> Search<'a> {
    fn new(text: &'a str, target: Vec<Step>) -> Self {
        Self {
            rest: without_mark(text).chars().peekable(),
            place: (1, 1),
            levels: Vec::new(),
            target,
            best: (0, (1, 1)),
            until: None,
        }
    }

    fn next(&mut self) -> Option<char> {
        let c = self.rest.next()?;
        if c == '\n' {
            self.place = (self.place.0 + 1, 1);
        } else {
            self.place.1 += 1;
        }
        Some(c)
    }

    fn scan(&mut self) {
        loop {
            let start = self.place;
            if self.until.is_some_and(|until| start > until) {
                return;
            }
            let Some(c) = self.next() else { return };
            match c {
                c if c.is_whitespace() => {}
                '/' => self.skip_comment(),
                ')' | ']' | '}' => drop(self.levels.pop()),
                ',' => self.end_element(),
                _ => {
                    self.begin_element(start);
                    self.read_token(c, start);
                }
            }
        }
    }

    fn read_token(&mut self, first: char, start: (usize, usize)) {
        match first {
            '(' | '[' | '{' => self.levels.push(Level {
                is_list: first == '[',
                index: 0,
                key: None,
                element_begins: true,
            }),
            '"' => self.skip_string(),
            c if c.is_alphabetic() || c == '_' => self.read_word(c, start),
            _ => {}
        }
    }

    /// A word that a colon follows is a key; any other (a variant, a number's exponent) is not.
    fn read_word(&mut self, first: char, start: (usize, usize)) {
        let mut word = String::from(first);
        while let Some(&c) = self.rest.peek() {
            if !(c.is_alphanumeric() || c == '_') {
                break;
            }
            word.push(c);
            self.next();
        }
        while self.rest.peek().is_some_and(|c| c.is_whitespace()) {
            self.next();
        }
        if self.rest.peek() == Some(&':') {
            if let Some(level) = self.levels.last_mut() {
                level.key = Some(word);
            }
            self.compare(start);
        }
    }

    fn begin_element(&mut self, start: (usize, usize)) {
        let Some(level) = self.levels.last_mut() else {
            return;
        };
        if std::mem::take(&mut level.element_begins) && level.is_list {
            self.compare(start);
        }
    }

    fn end_element(&mut self) {
        if let Some(level) = self.levels.last_mut() {
            level.index += 1;
            level.key = None;
            level.element_begins = true;
        }
    }

    /// The path of the present place.
    fn here(&self) -> Vec<Step> {
        self.levels
            .iter()
            .filter_map(|level| match (&level.key, level.is_list) {
                (_, true) => Some(Step::Index(level.index)),
                (Some(key), false) => Some(Step::Key(key.clone())),
                (None, false) => None,
            })
            .collect()
    }

    /// Notes the present place if it lies deeper on the way to the target than the best so far.
    fn compare(&mut self, start: (usize, usize)) {
        let here = self.here();
        if here.len() > self.best.0 && self.target.starts_with(&here) {
            self.best = (here.len(), start);
        }
    }

    fn skip_comment(&mut self) {
        match self.rest.peek() {
            Some('/') => while self.next().is_some_and(|c| c != '\n') {},
            Some('*') => {
                self.next();
                self.skip_block_comment();
            }
            _ => {}
        }
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 1;
        while depth > 0 {
            let Some(c) = self.next() else { return };
            match (c, self.rest.peek()) {
                ('*', Some('/')) => depth -= 1,
                ('/', Some('*')) => depth += 1,
                _ => continue,
            }
            self.next();
        }
    }

    fn skip_string(&mut self) {
        while let Some(c) = self.next() {
            match c {
                '\\' => drop(self.next()),
                '"' => return,
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{path_at, position};

    const TEXT: &str = r#"// a: comment (
Scene(
    title: "x: ( \" [",
    filament: (
        sections: [
            Rod(from_nm: 0.0, to_nm: 1e1),
            Rod(
                from_nm: 10.0, /* nested /* to_nm: */ */
                to_nm: 5.0,
            ),
        ],
    ),
    loads: [EndForce(end: End, force_pn: (0.0, inf, 0.0))],
)"#;

    #[test]
    fn keys_are_found_behind_comments_strings_and_lists() {
        assert_eq!(position(TEXT, "filament"), (4, 5));
        assert_eq!(position(TEXT, "filament.sections[1]"), (7, 13));
        assert_eq!(position(TEXT, "filament.sections[1].to_nm"), (9, 17));
        assert_eq!(position(TEXT, "filament.sections[0].to_nm"), (6, 31));
        assert_eq!(position(TEXT, "loads[0].force_pn"), (13, 32));
    }

    #[test]
    fn a_key_that_is_not_written_is_placed_at_the_one_above() {
        assert_eq!(position(TEXT, "loads[0].force_pn[1]"), (13, 32));
        assert_eq!(position(TEXT, "filament.monomers.seed"), (4, 5));
        assert_eq!(position(TEXT, "absent"), (1, 1));
    }

    #[test]
    fn a_place_belongs_to_the_innermost_key() {
        assert_eq!(path_at(TEXT, (6, 31)), "filament.sections[0].to_nm");
        assert_eq!(path_at(TEXT, (9, 24)), "filament.sections[1].to_nm");
        assert_eq!(path_at(TEXT, (5, 9)), "filament.sections");
        assert_eq!(path_at(TEXT, (13, 47)), "loads[0].force_pn");
        assert_eq!(path_at(TEXT, (1, 1)), "");
        assert_eq!(path_at(TEXT, (99, 1)), "");
    }
}
