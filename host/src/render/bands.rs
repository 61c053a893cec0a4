//! A picture in bands of rows, traced by threads that take the next band as they finish one.

use std::num::NonZeroUsize;
use std::sync::{Mutex, mpsc};
use std::thread;

use whitted::frame::{Output, Rgb888, Settings};
use whitted::scene::{Camera, Scene};
use whitted::tally::Counts;

use super::with_renderer;
use crate::bake::Construct;
use crate::error::Flaw;
use crate::picture::Picture;

/// Bands a thread gets, on average: rows differ in what they cost.
const BANDS_PER_THREAD: usize = 4;
/// Bands begin at multiples of this, as blocks of pixels do.
const ALIGNED: usize = 16;

/// Some rows of the picture, and the number of the first.
type Band<'p> = (u16, Vec<&'p mut [[u8; 3]]>);

/// Paints the picture and returns the rays it took; `progress` is told how many rows are done.
pub(super) fn paint<A: Construct>(
    scene: &Scene<'_, A>,
    camera: &Camera<A>,
    settings: Settings,
    threads: NonZeroUsize,
    picture: &mut Picture,
    progress: &mut impl FnMut(u32),
) -> Result<Counts, Flaw> {
    let rows = usize::from(settings.height);
    let threads = threads.get().min(rows).max(1);
    let side = match threads {
        1 => rows.max(1),
        _ => rows.div_ceil(threads * BANDS_PER_THREAD).next_multiple_of(ALIGNED),
    };
    let mut bands: Vec<Band<'_>> = Vec::new();
    for (y, row) in (0..settings.height).zip(picture.rows_mut()) {
        match bands.last_mut() {
            Some((_, band)) if band.len() < side => band.push(row),
            _ => bands.push((y, vec![row])),
        }
    }
    let queue = Mutex::new(bands.into_iter());
    let (sender, finished) = mpsc::channel();
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|_| {
                let (queue, sender) = (&queue, sender.clone());
                scope.spawn(move || work(scene, camera, settings, queue, &sender))
            })
            .collect();
        drop(sender);
        for (done, ()) in (1..).zip(finished) {
            progress(done);
        }
        let mut counts = Counts::default();
        for worker in workers {
            counts += worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
        }
        Ok(counts)
    })
}

/// Traces bands until there are no more.
fn work<'p, A: Construct>(
    scene: &Scene<'_, A>,
    camera: &Camera<A>,
    settings: Settings,
    queue: &Mutex<impl Iterator<Item = Band<'p>>>,
    finished: &mpsc::Sender<()>,
) -> Result<Counts, Flaw> {
    // Not held while a band is traced.
    let next = || queue.lock().ok()?.next();
    with_renderer(scene, camera, settings, |renderer| {
        let mut line = vec![Rgb888::default(); usize::from(settings.width)];
        let mut end = 0;
        while let Some((first, band)) = next() {
            if first != end && settings.sampling.samples(settings.width) > 0 {
                // What the row above leaves behind has been counted by another.
                let counts = *renderer.tally();
                renderer.line(first - 1, &Output::SRGB, &mut line);
                *renderer.tally_mut() = counts;
            }
            end = first;
            for row in band {
                renderer.line(end, &Output::SRGB, &mut line);
                row.iter_mut().zip(&line).for_each(|(to, from)| *to = from.0);
                end += 1;
                // Nobody may be listening.
                let _ = finished.send(());
            }
        }
        *renderer.tally()
    })
}
