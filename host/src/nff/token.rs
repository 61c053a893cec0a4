//! Words of an NFF file, with their lines.

use std::str::SplitAsciiWhitespace;

use crate::document::{FARTHEST, Point};
use crate::error::{Flaw, Problem, shown};

/// Words one after the other; comments and line breaks are gone.
pub(super) struct Tokens<'t> {
    lines: std::iter::Enumerate<std::str::Lines<'t>>,
    words: SplitAsciiWhitespace<'t>,
    /// The line of the word read last.
    line: usize,
    /// A word that was looked at, and its line.
    next: Option<(&'t str, usize)>,
    current: usize,
}

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        let words = "".split_ascii_whitespace();
        Self { lines: text.lines().enumerate(), words, line: 1, next: None, current: 1 }
    }

    /// The line of the word read last.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    pub(super) fn peek(&mut self) -> Option<&'t str> {
        while self.next.is_none() {
            if let Some(word) = self.words.next() {
                self.next = Some((word, self.current));
            } else {
                let (index, line) = self.lines.next()?;
                self.current = index + 1;
                let text = line.split_once('#').map_or(line, |(before, _)| before);
                self.words = text.split_ascii_whitespace();
            }
        }
        self.next.map(|(word, _)| word)
    }

    pub(super) fn word(&mut self) -> Option<&'t str> {
        self.peek();
        let (word, line) = self.next.take()?;
        self.line = line;
        Some(word)
    }

    /// A finite number; `what` says what it is, for the error.
    pub(super) fn number(&mut self, what: &str) -> Result<f64, Flaw> {
        let Some(word) = self.word() else {
            let wanted = format!("a number ({what})");
            return Err(Problem::Ended { wanted }.at(self.line));
        };
        let wrong = |wanted: String| {
            Err(Problem::Found { found: format!("\"{}\"", shown(word)), wanted }.at(self.line))
        };
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => wrong(format!("a finite number ({what})")),
            Err(_) => wrong(format!("a number ({what})")),
        }
    }

    /// A number between two others, both allowed.
    pub(super) fn number_in(&mut self, what: &str, low: f64, high: f64) -> Result<f64, Flaw> {
        let value = self.number(what)?;
        if value < low || value > high {
            let right = format!("{low} to {high}");
            return Err(Problem::range(what, value, right).at(self.line));
        }
        Ok(value)
    }

    /// Three coordinates.
    pub(super) fn point(&mut self, what: &str) -> Result<Point, Flaw> {
        let mut point = [0.0; 3];
        for (axis, value) in ["x", "y", "z"].iter().zip(&mut point) {
            *value = self.number_in(&format!("{what} {axis}"), -FARTHEST, FARTHEST)?;
        }
        Ok(point)
    }

    /// Three channels, not negative.
    pub(super) fn color(&mut self, what: &str) -> Result<[f64; 3], Flaw> {
        let mut color = [0.0; 3];
        for (channel, value) in ["red", "green", "blue"].iter().zip(&mut color) {
            *value = self.number_in(&format!("{what} {channel}"), 0.0, 1000.0)?;
        }
        Ok(color)
    }

    /// A whole number between two others.
    pub(super) fn count(&mut self, what: &str, low: u32, high: u32) -> Result<u32, Flaw> {
        let value = self.number_in(what, f64::from(low), f64::from(high))?;
        if value.fract() != 0.0 {
            return Err(Problem::range(what, value, "a whole number").at(self.line));
        }
        Ok(value as u32)
    }
}
