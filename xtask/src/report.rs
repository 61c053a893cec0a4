//! Counting what passed and what failed.

use std::time::Instant;

/// The checks so far.
#[derive(Default)]
pub(crate) struct Report {
    passed: u64,
    failed: u64,
    /// What failed, to be named again at the end.
    names: Vec<String>,
}

impl Report {
    /// Runs one check and says how it went.
    pub(crate) fn check<T>(
        &mut self,
        name: &str,
        check: impl FnOnce() -> Result<T, String>,
    ) -> Option<T> {
        println!("     {name} …");
        let start = Instant::now();
        match check() {
            Ok(value) => {
                println!("ok   {name} ({:.1} s)", start.elapsed().as_secs_f32());
                self.passed += 1;
                Some(value)
            }
            Err(reason) => {
                println!("FAIL {name}: {reason}");
                self.failed += 1;
                self.names.push(name.into());
                None
            }
        }
    }

    /// Adds the numbers of a test runner of its own.
    pub(crate) fn add(&mut self, name: &str, passed: u64, failed: u64) {
        self.passed += passed;
        self.failed += failed;
        if failed > 0 {
            self.names.push(format!("{failed} of {name}"));
        }
    }

    /// Adds another report's numbers.
    pub(crate) fn merge(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.names.extend(other.names);
    }

    /// Prints the summary; an error if anything failed.
    pub(crate) fn finish(self) -> Result<(), String> {
        for name in &self.names {
            println!("failed: {name}");
        }
        println!("{} passed, {} failed", self.passed, self.failed);
        if self.failed == 0 { Ok(()) } else { Err("not everything passed".into()) }
    }
}
