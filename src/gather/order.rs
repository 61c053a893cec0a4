//! The order of records: a tree that takes no memory.
//!
//! What a point asks is "which records reach me?". Records in **runs** answer it by halving:
//!
//! - A run begins with the record that reaches farthest, so that none of it reaches farther.
//! - The second record parts the others along an axis: the first half of them (rounded down) lies
//!   no farther along it, the second half no less far. Both are runs again, along the next axis.
//! - A run of [`SHORT`] records or fewer is in any order.
//!
//! So a half is left out where the point lies beyond the parting record by more than the first one's
//! reach. It is the k-d tree of Bentley ("Multidimensional binary search trees used for associative
//! searching", 1975) laid out in an array, with McCreight's thought ("Priority search trees", 1985)
//! for how far to look. Records are met in the order in which they lie, so a sum over those that
//! reach a point is the same to the bit as that over all.

use super::record::Record;
use crate::math::{Arithmetic, for_each_arithmetic};

/// Runs no longer than this are asked one by one: parting them costs as much as it saves.
pub(super) const SHORT: usize = 10;

/// How many halves can wait while others are looked through: enough for `SHORT·2ᴸᴱⱽᴱᴸˢ` records, two
/// million. 12 bytes each on the stack of a chip.
pub(super) const LEVELS: usize = 18;

/// Shows `each` the records of a run that lie no farther from the point than `limit` says of the run's
/// first, and some others, in the order in which they lie, until it says that it has seen enough.
#[inline(always)]
pub(super) fn near<A: Arithmetic>(
    records: &[Record<A>],
    p: &[A::Length; 3],
    limit: impl Fn(&Record<A>) -> A::Length,
    mut each: impl FnMut(&Record<A>) -> bool,
) {
    let mut waiting: [(&[Record<A>], usize); LEVELS] = [(&[], 0); LEVELS];
    let mut count = 0usize;
    let (mut run, mut axis) = (records, 0usize);
    loop {
        let mut next = None;
        let short = match run {
            [first, parting, rest @ ..] if run.len() > SHORT => {
                if each(first) || each(parting) {
                    return;
                }
                let (low, high) = rest.split_at_checked(rest.len() / 2).unwrap_or((rest, &[]));
                let beyond = beyond::<A>(p, &parting.position, axis);
                axis = if axis == 2 { 0 } else { axis + 1 };
                let limit = limit(first);
                let to_low = beyond <= limit;
                let to_high = -beyond <= limit;
                if to_high {
                    if to_low {
                        if let Some(free) = waiting.get_mut(count) {
                            *free = (high, axis);
                            count += 1;
                        }
                    } else {
                        next = Some(high);
                    }
                }
                if to_low {
                    next = Some(low);
                }
                &[]
            }
            _ => run,
        };
        for record in short {
            if each(record) {
                return;
            }
        }
        run = match next {
            Some(run) => run,
            None => {
                count = count.wrapping_sub(1);
                let Some((high, along)) = waiting.get(count) else { return };
                axis = *along;
                high
            }
        };
    }
}

/// Shows `each` some records that are likely to be near the point: those met on the way to it.
pub(super) fn on_the_way<A: Arithmetic>(
    records: &[Record<A>],
    p: &[A::Length; 3],
    mut each: impl FnMut(&Record<A>),
) {
    let (mut run, mut axis) = (records, 0);
    while let [first, parting, rest @ ..] = run {
        if run.len() <= SHORT {
            break;
        }
        each(first);
        each(parting);
        let (low, high) = rest.split_at_checked(rest.len() / 2).unwrap_or((rest, &[]));
        let is_low = beyond::<A>(p, &parting.position, axis) < A::NO_LENGTH;
        run = if is_low { low } else { high };
        axis = if axis == 2 { 0 } else { axis + 1 };
    }
    run.iter().for_each(each);
}

/// How far a point lies beyond another along an axis.
#[inline(always)]
fn beyond<A: Arithmetic>(p: &[A::Length; 3], q: &[A::Length; 3], axis: usize) -> A::Length {
    match axis {
        0 => p[0] - q[0],
        1 => p[1] - q[1],
        _ => p[2] - q[2],
    }
}

/// Puts records in order; returns how many are in order, which is all but where there are too many to look through.
pub(super) fn arrange<A: Arithmetic>(all: &mut [Record<A>]) -> usize {
    let mut waiting = [(0usize, 0usize, 0usize); LEVELS];
    let mut count = 0usize;
    let (mut from, mut to, mut axis) = (0, all.len(), 0);
    if to > SHORT << LEVELS {
        return 0;
    }
    loop {
        if to.wrapping_sub(from) > SHORT {
            if let Some(run) = all.get_mut(from..to) {
                farthest_first(run);
                part(run.get_mut(1..).unwrap_or(&mut []), axis);
            }
            let low = from.wrapping_add(2);
            let high = low.wrapping_add(to.wrapping_sub(low) / 2);
            axis = if axis == 2 { 0 } else { axis + 1 };
            if let Some(free) = waiting.get_mut(count) {
                *free = (high, to, axis);
                count += 1;
            }
            (from, to) = (low, high);
        } else {
            count = count.wrapping_sub(1);
            let Some(&next) = waiting.get(count) else { return all.len() };
            (from, to, axis) = next;
        }
    }
}

/// Puts the record that reaches farthest first; of several the first.
fn farthest_first<A: Arithmetic>(run: &mut [Record<A>]) {
    let mut best = 0;
    let mut farthest = A::NO_LENGTH;
    for (i, record) in run.iter().enumerate() {
        if record.reach > farthest {
            (best, farthest) = (i, record.reach);
        }
    }
    swap(run, 0, best);
}

/// Puts first the record that half of the others, rounded down, lie before along an axis, and then
/// those (Hoare, "Find", 1961).
fn part<A: Arithmetic>(run: &mut [Record<A>], axis: usize) {
    let along = |run: &[Record<A>], i: usize| {
        let place = run.get(i).map(|record| record.position);
        place.map_or(A::NO_LENGTH, |p| {
            if axis == 0 {
                p[0]
            } else if axis == 1 {
                p[1]
            } else {
                p[2]
            }
        })
    };
    let wanted = run.len().saturating_sub(1) / 2;
    let (mut low, mut high) = (0usize, run.len().saturating_sub(1));
    while low < high {
        // of the first, middle and last the middle one
        let (a, b, c) = (along(run, low), along(run, (low + high) / 2), along(run, high));
        let (a, b) = if a < b { (a, b) } else { (b, a) };
        let pivot = if c < a {
            a
        } else if c < b {
            c
        } else {
            b
        };
        let (mut i, mut j) = (low, high);
        while i <= j {
            while i < high && along(run, i) < pivot {
                i += 1;
            }
            while j > low && along(run, j) > pivot {
                j -= 1;
            }
            if i > j {
                break;
            }
            swap(run, i, j);
            i += 1;
            if j == 0 {
                break;
            }
            j -= 1;
        }
        if wanted <= j && j < high {
            high = j;
        } else if wanted >= i {
            low = i;
        } else {
            break;
        }
    }
    swap(run, 0, wanted);
}

fn swap<A: Arithmetic>(run: &mut [Record<A>], i: usize, j: usize) {
    let (Some(&a), Some(&b)) = (run.get(i), run.get(j)) else { return };
    if let Some(to) = run.get_mut(i) {
        *to = b;
    }
    if let Some(to) = run.get_mut(j) {
        *to = a;
    }
}

for_each_arithmetic! {
    impl Record<A> {
        /// Whether records are in the order that [`near`] takes for granted. Each is held against the
        /// box and the reach that the runs leave it, so this takes a few comparisons a record.
        pub(super) const fn are_arranged(records: &[Self]) -> bool {
            type Length = <A as Arithmetic>::Length;
            #[derive(Clone, Copy)]
            struct Run<'r> {
                records: &'r [Record<A>],
                axis: usize,
                low: [Length; 3],
                high: [Length; 3],
                reach: Length,
            }

            const fn between(low: Length, x: Length, high: Length) -> bool {
                !make::below(x, low) && !make::below(high, x)
            }

            const fn holds(run: &Run<'_>, record: &Record<A>) -> bool {
                let p = &record.position;
                between(run.low[0], p[0], run.high[0])
                    && between(run.low[1], p[1], run.high[1])
                    && between(run.low[2], p[2], run.high[2])
                    && !make::below(run.reach, record.reach)
            }

            if records.len() > SHORT << LEVELS {
                return false;
            }
            let all = Run {
                records,
                axis: 0,
                low: [make::LEAST; 3],
                high: [make::MOST; 3],
                reach: make::MOST,
            };
            let mut waiting = [Run { records: &[], ..all }; LEVELS];
            let mut count = 0;
            let mut run = all;
            loop {
                let mut short = run.records;
                if let [first, parting, rest @ ..] = short && short.len() > SHORT {
                    if !holds(&run, first) {
                        return false;
                    }
                    run.reach = first.reach;
                    if !holds(&run, parting) {
                        return false;
                    }
                    let Some((before, behind)) = rest.split_at_checked(rest.len() / 2) else {
                        return false;
                    };
                    let axis = if run.axis > 2 { 0 } else { run.axis };
                    let mut high = run;
                    high.records = behind;
                    high.axis = if axis == 2 { 0 } else { axis + 1 };
                    let mut low = high;
                    low.records = before;
                    let middle = parting.position[axis];
                    high.low[axis] = middle;
                    low.high[axis] = middle;
                    if count >= LEVELS {
                        return false;
                    }
                    waiting[count] = high;
                    count += 1;
                    run = low;
                    continue;
                }
                while let [record, rest @ ..] = short {
                    if !holds(&run, record) {
                        return false;
                    }
                    short = rest;
                }
                if count == 0 || count > LEVELS {
                    return true;
                }
                count -= 1;
                run = waiting[count];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::RecordSpec;
    use super::*;
    use crate::math::Fixed;
    use proptest::prelude::*;
    extern crate std;
    use std::vec::Vec;

    /// Records on a coarse grid, so that many lie at the same place along an axis.
    fn records(seeds: &[(u8, u8, u8, u8)]) -> Vec<Record<Fixed>> {
        let record = |&(x, y, z, reach): &(u8, u8, u8, u8)| {
            Record::<Fixed>::new(RecordSpec {
                position: [x, y, z].map(|x| f64::from(x % 32) * 0.25),
                normal: [0.0, 1.0, 0.0],
                reach: 0.1 + f64::from(reach % 16) * 0.125,
                irradiance: [1.0; 3],
                translation: [0.0; 3],
                rotation: [0.0; 3],
            })
        };
        seeds.iter().map(record).collect()
    }

    fn reaches(record: &Record<Fixed>, p: &[<Fixed as Arithmetic>::Length; 3]) -> bool {
        (0..3).all(|i| (p[i] - record.position[i]).abs() < record.reach)
    }

    proptest! {
        #[test]
        fn arranged_ones_are_found_as_they_lie(
            seeds in prop::collection::vec(any::<(u8, u8, u8, u8)>(), 0..300),
            points in prop::collection::vec(any::<(u8, u8, u8, u8)>(), 20),
        ) {
            let mut records = records(&seeds);
            let mut before: Vec<_> = seeds.clone();
            prop_assert_eq!(arrange::<Fixed>(&mut records), seeds.len());
            prop_assert!(Record::<Fixed>::are_arranged(&records));
            // the same ones
            let key = |r: &Record<Fixed>| (r.position.map(|x| x.to_bits()), r.reach.to_bits());
            let mut now: Vec<_> = records.iter().map(key).collect();
            let mut then: Vec<_> = self::records(&before).iter().map(key).collect();
            now.sort();
            then.sort();
            prop_assert_eq!(now, then);
            before.clear();
            for (x, y, z, _) in points {
                let p = [x, y, z].map(|x| Fixed::length_q16(i32::from(x) << 11));
                let mut found = Vec::new();
                let mut asked = 0;
                near(&records, &p, |r| r.reach, |record| {
                    asked += 1;
                    if reaches(record, &p) {
                        found.push(key(record));
                    }
                    false
                });
                let all: Vec<_> = records.iter().filter(|r| reaches(r, &p)).map(key).collect();
                prop_assert_eq!(found, all);
                prop_assert!(asked <= records.len());
            }
        }

        #[test]
        fn what_is_out_of_order_is_found_out(
            seeds in prop::collection::vec(any::<(u8, u8, u8, u8)>(), 2 + SHORT..300),
            (i, far) in (any::<prop::sample::Index>(), any::<bool>()),
        ) {
            let mut records = records(&seeds);
            arrange::<Fixed>(&mut records);
            let len = records.len();
            let record = &mut records[1 + i.index(len - 1)];
            // no record's reach, nor half of their places
            if far {
                record.reach = Fixed::length_q16(3 << 16);
                prop_assert!(!Record::<Fixed>::are_arranged(&records));
            } else if records[1].position[0] < records[2 + (len - 2) / 2..][..1][0].position[0] {
                records.swap(1, len - 1);
                let ordered = Record::<Fixed>::are_arranged(&records);
                // found in any case, whatever they are taken for
                let p = records[0].position;
                if ordered {
                    let mut found = 0;
                    near(&records, &p, |r| r.reach, |record| {
                        found += usize::from(reaches(record, &p));
                        false
                    });
                    prop_assert_eq!(found, records.iter().filter(|r| reaches(r, &p)).count());
                }
            }
        }
    }
}
