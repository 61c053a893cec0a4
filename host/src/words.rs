//! Numbers among the words of a text, for formats whose lines are words.

use crate::document::{FARTHEST, Point};
use crate::error::{Flaw, Problem, shown};

/// Words that are read one after the other. `what` says what is read, for the error.
pub(crate) trait Numbers<'t> {
    /// The next word; an error where there is none.
    fn needed(&mut self, what: &str) -> Result<&'t str, Flaw>;

    /// The line of the word read last.
    fn line(&self) -> usize;

    /// A word, and what should be in its place.
    fn found(&self, word: &str, wanted: impl Into<String>) -> Flaw {
        let found = format!("\"{}\"", shown(word));
        Problem::Found { found, wanted: wanted.into() }.at(self.line())
    }

    /// A finite number.
    fn number(&mut self, what: &str) -> Result<f64, Flaw> {
        let word = self.needed(what)?;
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(self.found(word, format!("a finite number ({what})"))),
            Err(_) => Err(self.found(word, format!("a number ({what})"))),
        }
    }

    /// A number between two others, both allowed.
    fn number_in(&mut self, what: &str, low: f64, high: f64) -> Result<f64, Flaw> {
        let value = self.number(what)?;
        if value < low || value > high {
            let right = format!("{low} to {high}");
            return Err(Problem::range(what, value, right).at(self.line()));
        }
        Ok(value)
    }

    /// Three coordinates.
    fn point(&mut self, what: &str) -> Result<Point, Flaw> {
        let mut axis = |name| self.number_in(&format!("{what} {name}"), -FARTHEST, FARTHEST);
        Ok([axis("x")?, axis("y")?, axis("z")?])
    }
}
