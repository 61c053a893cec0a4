//! The words of a line.

use crate::error::{Flaw, Problem};
use crate::words::Numbers;

/// Lines with their numbers, without comments; one that ends in a backslash goes on in the next.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, String)> + '_ {
    let mut rest = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (index, first) = rest.next()?;
        let mut all = without_comment(first).to_owned();
        while all.ends_with('\\') {
            all.pop();
            let Some((_, more)) = rest.next() else { break };
            all.push(' ');
            all.push_str(without_comment(more));
        }
        Some((index + 1, all))
    })
}

fn without_comment(line: &str) -> &str {
    line.split_once('#').map_or(line, |(before, _)| before).trim_end()
}

/// What follows a keyword.
pub(super) struct Words<'t> {
    words: std::str::SplitWhitespace<'t>,
    pub(super) line: usize,
}

impl<'t> Words<'t> {
    pub(super) fn new(text: &'t str, line: usize) -> Self {
        Self { words: text.split_whitespace(), line }
    }

    pub(super) fn next(&mut self) -> Option<&'t str> {
        self.words.next()
    }

    /// All that is left, as one name: names may have spaces.
    pub(super) fn name(&mut self, what: &str) -> Result<String, Flaw> {
        let name = self.words.by_ref().collect::<Vec<_>>().join(" ");
        if name.is_empty() { Err(self.missing(what)) } else { Ok(name) }
    }

    pub(super) fn missing(&self, what: &str) -> Flaw {
        Problem::Missing { what: format!("a number or name ({what}) on this line") }.at(self.line)
    }
}

impl<'t> Numbers<'t> for Words<'t> {
    fn needed(&mut self, what: &str) -> Result<&'t str, Flaw> {
        self.next().ok_or_else(|| self.missing(what))
    }

    fn line(&self) -> usize {
        self.line
    }
}
