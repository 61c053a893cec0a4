//! A table of the file, read key by key: each value is checked where it is asked for, and what
//! nobody asked for is an unknown key.

use std::cell::RefCell;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::document::{FARTHEST, Point, Rgb};
use crate::error::{Flaw, Problem, shown};

/// Where the lines of a text start, to turn a place into a line.
pub(super) struct Lines(Vec<usize>);

impl Lines {
    pub(super) fn of(text: &str) -> Self {
        let breaks = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1);
        Self(std::iter::once(0).chain(breaks).collect())
    }

    pub(super) fn at(&self, place: usize) -> usize {
        self.0.partition_point(|&start| start <= place).max(1)
    }
}

/// A value and where it stands.
#[derive(Clone, Copy)]
pub(super) struct Value<'d> {
    value: &'d DeValue<'d>,
    lines: &'d Lines,
    pub(super) line: usize,
}

/// A table, what it is called, and the keys that have been asked for.
pub(super) struct Table<'d> {
    table: &'d DeTable<'d>,
    lines: &'d Lines,
    /// What the table describes, in the singular.
    pub(super) name: &'d str,
    /// The line it starts on.
    pub(super) line: usize,
    asked: RefCell<Vec<&'static str>>,
}

impl<'d> Table<'d> {
    pub(super) fn new(
        table: &'d DeTable<'d>,
        lines: &'d Lines,
        name: &'d str,
        line: usize,
    ) -> Self {
        Self { table, lines, name, line, asked: RefCell::default() }
    }

    /// The value of a key, if it is there.
    pub(super) fn get(&self, key: &'static str) -> Option<Value<'d>> {
        self.asked.borrow_mut().push(key);
        let found = self.table.get(key)?;
        Some(Value { value: found.get_ref(), lines: self.lines, line: self.start(found.span()) })
    }

    /// The value of a key that must be there.
    pub(super) fn need(&self, key: &'static str) -> Result<Value<'d>, Flaw> {
        self.get(key).ok_or_else(|| self.missing(&format!("key \"{key}\"")))
    }

    pub(super) fn missing(&self, what: &str) -> Flaw {
        let name = self.name;
        let of = if name.is_empty() { "the scene".into() } else { format!("this {name}") };
        Problem::Missing { what: format!("{what} of {of}") }.at(self.line)
    }

    /// An error if the table has a key that was never asked for.
    pub(super) fn done(&self) -> Result<(), Flaw> {
        let asked = self.asked.borrow();
        let strange = |key: &&Spanned<_>| {
            let key: &Spanned<toml::de::DeString<'_>> = key;
            !asked.iter().any(|a| *a == key.get_ref().as_ref())
        };
        match self.table.keys().filter(strange).min_by_key(|key| key.span().start) {
            None => Ok(()),
            Some(key) => {
                let what = "key";
                let line = self.start(key.span());
                Err(Problem::unknown(what, key.get_ref(), &asked).at(line))
            }
        }
    }

    /// A switch, or its default.
    pub(super) fn flag(&self, key: &'static str, default: bool) -> Result<bool, Flaw> {
        self.get(key).map_or(Ok(default), |v| v.flag(key))
    }

    /// A number within a range, or its default.
    pub(super) fn number(
        &self,
        key: &'static str,
        range: Range<f64>,
        default: f64,
    ) -> Result<f64, Flaw> {
        self.get(key).map_or(Ok(default), |v| v.number_in(key, range))
    }

    /// A coefficient per channel, or its default.
    pub(super) fn color(&self, key: &'static str, most: f64, default: Rgb) -> Result<Rgb, Flaw> {
        self.get(key).map_or(Ok(default), |v| v.color(key, most))
    }

    /// The corners of a polygon: three points or more.
    pub(super) fn corners(&self) -> Result<Vec<Point>, Flaw> {
        let value = self.need("corners")?;
        let corners = value.points("corners", "a list of points [[x, y, z], …]")?;
        if corners.len() < 3 {
            return value.wrong("corners", "three points or more");
        }
        Ok(corners)
    }

    fn start(&self, span: Range<usize>) -> usize {
        self.lines.at(span.start)
    }
}

impl<'d> Value<'d> {
    fn wrong<T>(&self, key: &str, wanted: &str) -> Result<T, Flaw> {
        let found = match self.value {
            DeValue::String(s) => format!("\"{}\"", shown(s)),
            DeValue::Integer(i) => shown(i.as_str()),
            DeValue::Float(x) => shown(x.as_str()),
            DeValue::Boolean(b) => b.to_string(),
            DeValue::Datetime(_) => "a date".into(),
            DeValue::Array(a) => format!("a list of {}", a.len()),
            DeValue::Table(_) => "a table".into(),
        };
        let found = format!("{found} for \"{key}\"");
        Err(Problem::Found { found, wanted: wanted.into() }.at(self.line))
    }

    pub(super) fn number(&self, key: &str) -> Result<f64, Flaw> {
        let value = match self.value {
            DeValue::Float(x) => x.as_str().parse::<f64>().ok(),
            DeValue::Integer(i) => {
                i64::from_str_radix(i.as_str(), i.radix()).ok().map(|i| i as f64)
            }
            _ => None,
        };
        match value.filter(|v| v.is_finite()) {
            Some(value) => Ok(value),
            None => self.wrong(key, "a finite number"),
        }
    }

    /// A number within a range whose ends are allowed.
    pub(super) fn number_in(&self, key: &str, range: Range<f64>) -> Result<f64, Flaw> {
        let value = self.number(key)?;
        if value < range.start || value > range.end {
            let right = format!("{} to {}", range.start, range.end);
            return Err(Problem::range(key, value, right).at(self.line));
        }
        Ok(value)
    }

    /// A number larger than 0.
    pub(super) fn positive(&self, key: &str) -> Result<f64, Flaw> {
        let value = self.number_in(key, -FARTHEST..FARTHEST)?;
        if value <= 0.0 {
            return Err(Problem::range(key, value, "larger than 0").at(self.line));
        }
        Ok(value)
    }

    /// A whole number within a range whose ends are allowed.
    pub(super) fn count(&self, key: &str, low: u32, high: u32) -> Result<u32, Flaw> {
        let value = self.number_in(key, f64::from(low)..f64::from(high))?;
        if value.fract() != 0.0 {
            return Err(Problem::range(key, value, "a whole number").at(self.line));
        }
        Ok(value as u32)
    }

    pub(super) fn flag(&self, key: &str) -> Result<bool, Flaw> {
        match self.value {
            DeValue::Boolean(flag) => Ok(*flag),
            _ => self.wrong(key, "true or false"),
        }
    }

    pub(super) fn text(&self, key: &str) -> Result<&'d str, Flaw> {
        match self.value {
            DeValue::String(text) => Ok(text),
            _ => self.wrong(key, "a text in quotes"),
        }
    }

    /// One of several words.
    pub(super) fn word<T: Copy>(&self, key: &str, known: &[(&str, T)]) -> Result<T, Flaw> {
        let found = self.text(key)?;
        match known.iter().find(|(word, _)| *word == found) {
            Some((_, meaning)) => Ok(*meaning),
            None => {
                let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
                Err(Problem::unknown("word", found, &words).at(self.line))
            }
        }
    }

    /// The values of a list.
    pub(super) fn list(&self, key: &str, wanted: &str) -> Result<Vec<Value<'d>>, Flaw> {
        let DeValue::Array(items) = self.value else { return self.wrong(key, wanted) };
        let item = |v: &'d Spanned<DeValue<'d>>| Value {
            value: v.get_ref(),
            lines: self.lines,
            line: self.lines.at(v.span().start),
        };
        Ok(items.iter().map(item).collect())
    }

    fn triple(&self, key: &str, wanted: &str) -> Result<[Value<'d>; 3], Flaw> {
        let list = self.list(key, wanted)?;
        list.try_into().or_else(|_| self.wrong(key, wanted))
    }

    /// Three coordinates.
    pub(super) fn point(&self, key: &str) -> Result<Point, Flaw> {
        let [x, y, z] = self.triple(key, "[x, y, z]")?;
        let axis = |v: Value<'_>| v.number_in(key, -FARTHEST..FARTHEST);
        Ok([axis(x)?, axis(y)?, axis(z)?])
    }

    /// Three coordinates that aren't all 0.
    pub(super) fn direction(&self, key: &str) -> Result<Point, Flaw> {
        let v = self.point(key)?;
        if v == [0.0; 3] {
            return Err(Problem::degenerate(key, "0 0 0 is no direction").at(self.line));
        }
        Ok(v)
    }

    /// A list of points.
    pub(super) fn points(&self, key: &str, wanted: &str) -> Result<Vec<Point>, Flaw> {
        self.list(key, wanted)?.iter().map(|v| v.point(key)).collect()
    }

    /// Three points.
    pub(super) fn corners(&self, key: &str) -> Result<[Point; 3], Flaw> {
        let wanted = "a list of three points [[x, y, z], …]";
        let points = self.points(key, wanted)?;
        points.try_into().or_else(|_| self.wrong(key, wanted))
    }

    /// A number for all channels, `[red, green, blue]`, both linear, or "#rrggbb" in sRGB.
    pub(super) fn color(&self, key: &str, most: f64) -> Result<Rgb, Flaw> {
        const WANTED: &str = "a number, [red, green, blue] or \"#rrggbb\"";
        match self.value {
            DeValue::Array(_) => {
                let [r, g, b] = self.triple(key, WANTED)?;
                let channel = |v: Value<'_>| v.number_in(key, 0.0..most);
                Ok([channel(r)?, channel(g)?, channel(b)?])
            }
            DeValue::String(text) => match hex(text) {
                Some(color) => Ok(color),
                None => self.wrong(key, WANTED),
            },
            DeValue::Integer(_) | DeValue::Float(_) => Ok([self.number_in(key, 0.0..most)?; 3]),
            _ => self.wrong(key, WANTED),
        }
    }

    /// The table that this is.
    pub(super) fn table(&self, name: &'d str) -> Result<Table<'d>, Flaw> {
        match self.value {
            DeValue::Table(table) => Ok(Table::new(table, self.lines, name, self.line)),
            _ => self.wrong(name, "a table"),
        }
    }
}

/// "#rrggbb", from sRGB to linear.
fn hex(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let channel = |i| u8::from_str_radix(digits.get(i..i + 2)?, 16).ok().map(linear);
    Some([channel(0)?, channel(2)?, channel(4)?])
}

/// IEC 61966-2-1, from a display's value to light.
fn linear(byte: u8) -> f64 {
    let v = f64::from(byte) / 255.0;
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}
