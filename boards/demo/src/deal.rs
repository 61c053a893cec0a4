//! Rows dealt out to cores, and gathered into bands.
//!
//! Rows differ in what they cost, so a core that has finished one takes the next that nobody has.
//! They are traced into a ring of two bands: while the rows of one are sent, those of the other
//! are traced. A row may be dealt as soon as its place in the ring has been sent. This keeps the
//! account alone; whoever shares it between cores has to lock it.

use core::ops::Range;

/// What a core is to do next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// Trace this row.
    Row(u16),
    /// Wait: the ring is full.
    Wait,
    /// There are no more rows.
    Over,
}

/// The account of a picture's rows, `BAND` to a band, at most 32.
#[derive(Clone, Debug)]
pub struct Deal<const BAND: u16> {
    rows: u16,
    /// The first row that nobody has.
    next: u16,
    /// The first row that hasn't been taken to be sent.
    sending: u16,
    /// The first row whose place isn't free yet.
    freed: u16,
    /// The rows that are finished, by their place in the ring.
    done: u64,
}

impl<const BAND: u16> Deal<BAND> {
    /// Rows in the ring.
    pub const RING: u16 = 2 * BAND;

    /// All rows of a picture.
    #[must_use]
    pub const fn new(rows: u16) -> Self {
        const { assert!(BAND >= 1 && BAND <= 32, "the account has 64 bits") };
        Self { rows, next: 0, sending: 0, freed: 0, done: 0 }
    }

    /// The place of a row in the ring.
    #[must_use]
    pub const fn place(row: u16) -> u16 {
        row % Self::RING
    }

    /// Gives the next row away.
    pub fn claim(&mut self) -> Claim {
        if self.next >= self.rows {
            return Claim::Over;
        }
        if self.next - self.freed >= Self::RING {
            return Claim::Wait;
        }
        self.next += 1;
        Claim::Row(self.next - 1)
    }

    /// Notes that a row that was given away is traced.
    pub fn finish(&mut self, row: u16) {
        self.done |= 1 << Self::place(row);
    }

    /// The next band, if all its rows are traced, to be sent; the last may be shorter. It counts
    /// as taken.
    pub fn take_band(&mut self) -> Option<Range<u16>> {
        let band = self.sending..self.rows.min(self.sending + BAND);
        let mask = band.clone().fold(0, |mask, row| mask | 1 << Self::place(row));
        if band.is_empty() || self.done & mask != mask {
            return None;
        }
        self.done &= !mask;
        self.sending = band.end;
        Some(band)
    }

    /// Notes that a band that was taken has been sent.
    pub fn free(&mut self, band: &Range<u16>) {
        self.freed = band.end;
    }

    /// Deals no more rows: the picture ends with those that have been given away.
    pub fn stop(&mut self) {
        self.rows = self.rows.min(self.next);
    }

    /// Whether every row has been sent.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.freed >= self.rows
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Claim, Deal};
    use std::vec::Vec;

    /// A picture that is given up ends with the rows that somebody has.
    #[test]
    fn stopped_in_the_middle() {
        let mut deal = Deal::<4>::new(40);
        for y in 0..6 {
            assert_eq!(deal.claim(), Claim::Row(y));
            deal.finish(y);
        }
        assert_eq!(deal.take_band(), Some(0..4));
        deal.stop();
        assert_eq!(deal.claim(), Claim::Over);
        deal.free(&(0..4));
        assert!(!deal.is_over(), "two rows are left");
        assert_eq!(deal.take_band(), Some(4..6));
        deal.free(&(4..6));
        assert!(deal.is_over());
        // Nothing is left to give up.
        deal.stop();
        assert!(deal.is_over());
    }

    /// Three workers and a sender that act in a random order: every row is traced once, no row's
    /// place is overwritten before it was sent, and bands come in order.
    #[test]
    fn every_row_once_and_in_order() {
        for seed in 1..200u32 {
            let rows = (seed % 37) as u16;
            let mut random = seed;
            let mut next = || {
                random ^= random << 13;
                random ^= random >> 17;
                random ^= random << 5;
                random
            };
            let mut deal = Deal::<4>::new(rows);
            let mut ring = [None; 8];
            let mut working = [None; 3];
            let mut on_the_way = None;
            let mut sent = Vec::new();
            while !deal.is_over() {
                let who = next() as usize % 4;
                if who == 3 {
                    on_the_way = match on_the_way.take() {
                        None => deal.take_band(),
                        Some(band) => {
                            for row in core::ops::Range::<u16>::clone(&band) {
                                sent.push(ring[usize::from(Deal::<4>::place(row))].take());
                            }
                            deal.free(&band);
                            None
                        }
                    };
                    continue;
                }
                working[who] = match working[who] {
                    Some(row) => {
                        let place = &mut ring[usize::from(Deal::<4>::place(row))];
                        assert_eq!(*place, None);
                        *place = Some(row);
                        deal.finish(row);
                        None
                    }
                    None => match deal.claim() {
                        Claim::Row(row) => Some(row),
                        Claim::Wait | Claim::Over => None,
                    },
                };
            }
            let all: Vec<_> = (0..rows).map(Some).collect();
            assert_eq!(sent, all);
            assert_eq!(deal.claim(), Claim::Over);
        }
    }

    #[test]
    fn a_picture_without_rows_is_over() {
        let mut deal = Deal::<8>::new(0);
        assert!(deal.is_over());
        assert_eq!(deal.take_band(), None);
        assert_eq!(deal.claim(), Claim::Over);
    }
}
