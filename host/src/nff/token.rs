//! Words of an NFF file, with their lines.

use std::str::SplitAsciiWhitespace;

use crate::error::{Flaw, Problem};
use crate::words::Numbers;

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

impl<'t> Numbers<'t> for Tokens<'t> {
    fn needed(&mut self, what: &str) -> Result<&'t str, Flaw> {
        let wanted = format!("a number ({what})");
        self.word().ok_or_else(|| Problem::Ended { wanted }.at(self.line))
    }

    fn line(&self) -> usize {
        self.line
    }
}
