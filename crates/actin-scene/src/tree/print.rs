//! Output of values as RON.

use super::{Kind, SceneValue};
use std::fmt::Write as _;

/// Value as RON. Structures at a depth below `depth` have one line for each key.
pub(crate) fn print(value: &SceneValue, depth: usize) -> String {
    let mut printer = Printer {
        text: String::new(),
        depth,
    };
    printer.value(value, 0);
    printer.text
}

struct Printer {
    text: String,
    depth: usize,
}

impl Printer {
    fn value(&mut self, value: &SceneValue, level: usize) {
        // Writing to a string does not fail.
        let _ = match &value.kind {
            Kind::None => write!(self.text, "None"),
            Kind::Bool(value) => write!(self.text, "{value}"),
            Kind::Whole(value) => write!(self.text, "{value}"),
            Kind::Number(value) => write!(self.text, "{value:?}"),
            Kind::Text(value) => write!(self.text, "{value:?}"),
            Kind::Name(name) => write!(self.text, "{name}"),
            Kind::Invalid | Kind::Removed => Ok(()),
            Kind::List(values) => {
                self.text.push('[');
                self.inline(values, level);
                self.text.push(']');
                Ok(())
            }
            Kind::Group(name, values) => {
                self.text.push_str(name.as_deref().unwrap_or_default());
                self.text.push('(');
                let is_vector = values.iter().all(|value| value.key.is_none());
                if is_vector || level >= self.depth {
                    self.inline(values, level + 1);
                } else {
                    self.lines(values, level + 1);
                }
                self.text.push(')');
                Ok(())
            }
        };
    }

    fn inline(&mut self, values: &[SceneValue], level: usize) {
        for (i, value) in values.iter().enumerate() {
            if i > 0 {
                self.text.push_str(", ");
            }
            self.entry(value, level);
        }
    }

    fn lines(&mut self, values: &[SceneValue], level: usize) {
        for value in values {
            self.line(level);
            self.entry(value, level);
            self.text.push(',');
        }
        self.line(level - 1);
    }

    fn line(&mut self, level: usize) {
        self.text.push('\n');
        self.text.push_str(&"    ".repeat(level));
    }

    fn entry(&mut self, value: &SceneValue, level: usize) {
        if let Some(key) = &value.key {
            self.text.extend([key, ": "]);
        }
        self.value(value, level);
    }
}
