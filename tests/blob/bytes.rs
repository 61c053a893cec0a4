//! Every byte of a blob, changed.

use super::super::aligned::Aligned;
use super::groups::{grouped, with_groups};
use super::kinds::{content, kinds};
use super::picture::{shown, written};
use super::{A, is_tried};
use whitted::blob::{Blob, BlobError};

#[test]
fn every_change_of_a_byte_and_every_truncation_is_noticed() {
    is_noticed(written(&content(&kinds())));
    is_noticed(with_groups(&grouped(), written));
}

fn is_noticed(mut blob: Aligned) {
    let length = blob.bytes().len();
    for end in 0..length {
        assert!(matches!(
            Blob::<A>::open(&blob.bytes()[..end]).map(drop),
            Err(BlobError::Length { .. })
        ));
    }
    for at in 0..length {
        let right = blob.bytes()[at];
        // The sum finds any change of a byte: one of each bit shows that it is asked.
        for bit in 0..8 {
            blob.set(at, right ^ 1 << bit);
            assert!(Blob::<A>::open(blob.bytes()).is_err(), "{at}");
        }
        blob.set(at, right);
    }
}

/// The same with the checksum made right again: what an enemy would do.
#[test]
fn every_change_of_a_byte_is_refused_or_harmless() {
    is_refused_or_harmless(written(&content(&kinds())));
}

#[test]
fn every_change_of_a_byte_of_groups_is_refused_or_harmless() {
    is_refused_or_harmless(with_groups(&grouped(), written));
}

fn is_refused_or_harmless(mut blob: Aligned) {
    let (mut refused, mut shows) = (0, 0);
    for at in 0..blob.bytes().len() {
        let right = blob.bytes()[at];
        for value in (0..=255).filter(|v| *v != right) {
            if !is_tried([value, right]) {
                continue;
            }
            blob.set(at, value);
            blob.seal();
            match shown(blob.bytes(), 2) {
                Ok(_) => shows += 1,
                Err(_) => refused += 1,
            }
        }
        blob.set(at, right);
    }
    assert!(refused > 1_000 && shows > 0, "{refused} {shows}");
}
