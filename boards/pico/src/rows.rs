//! The rows of a frame, in memory that both cores and the DMA share: who may touch which is kept
//! by a [`Deal`].

use core::cell::{RefCell, UnsafeCell};
use core::ops::Range;

use critical_section::Mutex;
use whitted_demo::deal::{Claim, Deal};

use crate::panel;

/// Rows in a band.
pub(crate) const BAND_ROWS: u16 = 8;
/// Bytes a row may have.
const LINE: usize = {
    let (width, height) = panel::SIZE;
    (if width > height { width } else { height }) as usize * 2
};
/// Bytes in a band.
pub(crate) const BAND: usize = LINE * BAND_ROWS as usize;

/// Two bands.
#[repr(align(4))]
struct Ring(UnsafeCell<[u8; 2 * BAND]>);

// SAFETY: its bytes are only reached through rows that a deal has given to one core, or through a
// band that it has given to the sender.
unsafe impl Sync for Ring {}

static RING: Ring = Ring(UnsafeCell::new([0; 2 * BAND]));

/// The frame that is being drawn. The critical section holds on both cores.
static DEAL: Mutex<RefCell<Deal<BAND_ROWS>>> = Mutex::new(RefCell::new(Deal::new(0)));

fn deal<T>(act: impl FnOnce(&mut Deal<BAND_ROWS>) -> T) -> T {
    critical_section::with(|token| act(&mut DEAL.borrow_ref_mut(token)))
}

/// Begins a frame of so many rows. No core may be at work on another.
pub(crate) fn begin(rows: u16) {
    deal(|deal| *deal = Deal::new(rows));
}

/// Deals no more rows of the frame.
pub(crate) fn stop() {
    deal(Deal::stop);
}

/// Whether every row has been sent.
pub(crate) fn is_over() -> bool {
    deal(|deal| deal.is_over())
}

/// The next band to be sent, if all of its rows are traced.
pub(crate) fn take_band() -> Option<Range<u16>> {
    deal(Deal::take_band)
}

/// Says that a band has been sent.
pub(crate) fn free(band: &Range<u16>) {
    deal(|deal| deal.free(band));
}

/// A row that this core has to trace. It counts as traced when it is dropped.
pub(crate) struct Row {
    /// Which, from the top.
    pub(crate) y: u16,
    /// Its pixels.
    pub(crate) bytes: &'static mut [u8],
}

impl Drop for Row {
    fn drop(&mut self) {
        deal(|deal| deal.finish(self.y));
    }
}

/// Where a core gets rows from.
pub(crate) trait Source {
    /// The next one, as soon as there is one; the one before has been dropped.
    fn next(&mut self) -> Option<Row>;
}

/// Takes the next row, of `line` bytes, unless there is none now.
pub(crate) fn claim(line: usize) -> Result<Row, Empty> {
    match deal(Deal::claim) {
        Claim::Row(y) => {
            let place = usize::from(Deal::<BAND_ROWS>::place(y)) * line.min(LINE);
            // SAFETY: the place lies in the ring, and the deal has given this row to nobody else
            // until it is finished, nor its place to the sender until then.
            let bytes = unsafe {
                core::slice::from_raw_parts_mut(
                    RING.0.get().cast::<u8>().add(place),
                    line.min(LINE),
                )
            };
            Ok(Row { y, bytes })
        }
        Claim::Wait => Err(Empty::Now),
        Claim::Over => Err(Empty::Forever),
    }
}

/// Why there is no row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Empty {
    /// A band has to be sent first.
    Now,
    /// All have been taken.
    Forever,
}

/// A band's bytes on their way, or half of the ring as a buffer.
pub(crate) struct Band {
    start: usize,
    len: usize,
}

impl Band {
    /// The bytes of rows that the deal has given to the sender.
    pub(crate) fn of(rows: &Range<u16>, line: usize) -> Self {
        let start = usize::from(Deal::<BAND_ROWS>::place(rows.start)) * line.min(LINE);
        Self { start, len: usize::from(rows.end - rows.start) * line.min(LINE) }
    }

    /// Shows the bytes.
    pub(crate) fn read<T>(&self, look: impl FnOnce(&[u8]) -> T) -> T {
        // SAFETY: as for sending them.
        let (start, len) = unsafe { embedded_dma::ReadBuffer::read_buffer(self) };
        // SAFETY: they lie in the ring, and nobody writes them until they are freed.
        look(unsafe { core::slice::from_raw_parts(start, len) })
    }

    /// One of the two halves of the ring, while no frame is dealt; empty.
    pub(crate) fn half(second: bool) -> Self {
        Self { start: if second { BAND } else { 0 }, len: 0 }
    }

    /// Has the whole half filled by `fill`, which says how many bytes it wrote; returns that.
    pub(crate) fn fill(&mut self, fill: impl FnOnce(&mut [u8]) -> usize) -> usize {
        // SAFETY: a half is made by the link alone, once each, while no frame is dealt, and isn't
        // being sent as long as the link holds it.
        let bytes = unsafe {
            core::slice::from_raw_parts_mut(RING.0.get().cast::<u8>().add(self.start), BAND)
        };
        self.len = fill(bytes).min(BAND);
        self.len
    }
}

// SAFETY: the bytes are static, and `start` and `len` stay within them: a band of rows ends with
// the ring, since the ring is a multiple of it.
unsafe impl embedded_dma::ReadBuffer for Band {
    type Word = u8;

    unsafe fn read_buffer(&self) -> (*const u8, usize) {
        // SAFETY: within the ring.
        (unsafe { RING.0.get().cast::<u8>().add(self.start) }, self.len)
    }
}
