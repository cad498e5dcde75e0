//! Parser of YAML: the values of JSON in the notation of YAML 1.2, without anchors.

use super::{Brackets, MOST_DEPTH, Parsed, begins_with_key, number, number_kind};
use crate::tree::{Kind, SceneValue, Source, TextSpan};
use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span, StrInput};

/// Returns `true` if a text begins with a key as YAML does. A line of RON ends with a comma or a bracket.
pub(super) fn is_yaml(text: &str) -> bool {
    let lines = text.lines().map(str::trim);
    let first = lines
        .filter(|line| !line.is_empty())
        .find(|line| !line.starts_with('#') || line.starts_with("#!"));
    first.is_some_and(|line| {
        let is_key = begins_with_key(line)
            || line.starts_with("\"$schema\"")
            || line.starts_with("$schema:");
        line == "---" || (is_key && !line.ends_with([',', '(', '[']))
    })
}

/// Parses a text up to the first syntax error.
pub(super) fn parse_yaml(text: &str) -> Parsed {
    let mut reader = Reader {
        events: Parser::new_from_str(text),
        bytes: text
            .char_indices()
            .map(|(at, _)| at)
            .chain([text.len()])
            .collect(),
        depth: 0,
    };
    let (root, mistakes) = match reader.document() {
        Ok(root) => (root, Vec::new()),
        Err(mistake) => (Kind::Invalid.into(), vec![mistake]),
    };
    // The rest of the text after a mistake is not read.
    let brackets = Brackets {
        has_text_after: !mistakes.is_empty(),
        ..Brackets::default()
    };
    Parsed {
        root,
        mistakes,
        brackets,
    }
}

struct Reader<'a> {
    events: Parser<'a, StrInput<'a>>,
    /// Byte of each character.
    bytes: Vec<usize>,
    depth: usize,
}

/// Position in bytes, and message.
type Mistake = (usize, String);

impl<'a> Reader<'a> {
    fn next(&mut self) -> Result<(Event<'a>, [usize; 2]), Mistake> {
        let place = |bytes: &[usize], index: usize| bytes[index.min(bytes.len() - 1)];
        match self.events.next_event() {
            Some(Ok((event, Span { start, end }))) => {
                let ends = [start, end].map(|mark| place(&self.bytes, mark.index()));
                Ok((event, ends))
            }
            Some(Err(error)) => Err(self.located(&error)),
            None => Ok((Event::StreamEnd, [place(&self.bytes, usize::MAX); 2])),
        }
    }

    fn located(&self, error: &ScanError) -> Mistake {
        let last = self.bytes.len() - 1;
        (
            self.bytes[error.marker().index().min(last)],
            error.info().to_owned(),
        )
    }

    fn document(&mut self) -> Result<SceneValue, Mistake> {
        let mut root = None;
        loop {
            match self.next()? {
                (Event::StreamStart | Event::DocumentStart(_) | Event::DocumentEnd, _) => {}
                (Event::StreamEnd, _) => return Ok(root.unwrap_or_else(|| Kind::Invalid.into())),
                (_, [start, _]) if root.is_some() => {
                    return Err((start, "a file has one YAML document".to_owned()));
                }
                (event, ends) => root = Some(self.value(event, ends)?),
            }
        }
    }

    /// Reads the value that begins with an event.
    fn value(&mut self, event: Event<'a>, [start, end]: [usize; 2]) -> Result<SceneValue, Mistake> {
        self.depth += 1;
        if self.depth > MOST_DEPTH {
            return Err((
                start,
                format!("values are nested more than {MOST_DEPTH} deep here"),
            ));
        }
        let (kind, end) = match event {
            Event::Scalar(text, ScalarStyle::Plain, ..) => (plain(&text), end),
            Event::Scalar(text, ..) => (Kind::Text(text.into_owned()), end),
            Event::SequenceStart(..) => self.list()?,
            Event::MappingStart(..) => self.group()?,
            _ => return Err((start, "anchors and aliases are not supported".to_owned())),
        };
        self.depth -= 1;
        let place = TextSpan {
            source: Source::Json,
            start,
            value: start..end,
            until: end,
            ..TextSpan::default()
        };
        let key = None;
        Ok(SceneValue { key, kind, place })
    }

    fn list(&mut self) -> Result<(Kind, usize), Mistake> {
        let (mut values, mut last) = (Vec::new(), None);
        loop {
            match self.next()? {
                (Event::SequenceEnd, [_, end]) => {
                    return Ok((Kind::List(values), last.unwrap_or(end)));
                }
                (event, ends) => {
                    let value = self.value(event, ends)?;
                    last = Some(value.place.until);
                    values.push(value);
                }
            }
        }
    }

    fn group(&mut self) -> Result<(Kind, usize), Mistake> {
        let (mut values, mut last) = (Vec::new(), None);
        loop {
            let (key, start) = match self.next()? {
                (Event::MappingEnd, [_, end]) => {
                    let kind = Kind::Group(None, values).choice();
                    return Ok((kind, last.unwrap_or(end)));
                }
                (Event::Scalar(key, ..), [start, _]) => (key.into_owned(), start),
                (_, [start, _]) => return Err((start, "a key is expected".to_owned())),
            };
            let (event, ends) = self.next()?;
            let mut value = self.value(event, ends)?.with_key(key);
            value.place.start = start;
            last = Some(value.place.until);
            values.push(value);
        }
    }
}

fn plain(text: &str) -> Kind {
    match text {
        "" | "~" | "null" => Kind::None,
        "true" => Kind::Bool(true),
        "false" => Kind::Bool(false),
        _ if number(text) == text.len() => number_kind(text),
        _ => Kind::Text(text.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use crate::Scene;

    const YAML: &str = "# yaml-language-server: $schema=scene.schema.json
title: φ of a cantilever
filament:
  sections:
    - Ellipsoids: {from_nm: 0, to_nm: 40}
    - Rod:
        from_nm: 40.0
        to_nm: 160.0
clamps:
  - end: Start
loads:
  - EndForce: {end: End, force_pn: [-2.0, 0.0, 1e-1]}
task:
  Equilibrium: {}
";

    #[test]
    fn a_scene_equals_its_ron() {
        let ron = "Scene(
            title: \"φ of a cantilever\",
            filament: Filament(sections: [
                Ellipsoids(from_nm: 0.0, to_nm: 40.0), Rod(from_nm: 40.0, to_nm: 160.0),
            ]),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (-2.0, 0.0, 0.1))],
            task: Equilibrium(),
        )";
        assert_eq!(
            Scene::from_ron(YAML).unwrap(),
            Scene::from_ron(ron).unwrap()
        );
        let with_schema = format!("$schema: scene.schema.json\n{YAML}");
        assert_eq!(
            Scene::from_ron(&with_schema).unwrap(),
            Scene::from_ron(ron).unwrap()
        );
        let json = "{\"$schema\": \"scene.schema.json\", \"filament\": {\"sections\": [{\"Rod\": {\"from_nm\": 0.0, \
                    \"to_nm\": 40.0}}]}, \"clamps\": [{\"end\": \"Start\"}], \"task\": {\"Equilibrium\": {}}}";
        assert!(Scene::from_ron(json).is_ok());
    }
}
