//! Following a program from instruction to instruction: who called whom, and what each spent.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use crate::elf;

/// A call from an address, within the calls before it.
#[derive(Clone, Copy)]
struct Call {
    /// The call that this one is within; the first stands for none, and is within itself.
    within: u32,
    /// The instruction that calls.
    from: u32,
}

/// Learns of each instruction in turn.
pub(crate) struct Follower {
    code: Code,
    calls: Vec<Call>,
    known: HashMap<(u32, u32), u32>,
    /// Calls that haven't returned: their number, and the address that they return to.
    open: Vec<(u32, u32)>,
    last: Option<u32>,
    spent: HashMap<(u32, u32), u64>,
}

impl Follower {
    /// Of a program.
    pub(crate) fn new(image: &Path) -> Result<Self, String> {
        Ok(Self::with(Code::read(image)?))
    }

    fn with(code: Code) -> Self {
        Self {
            code,
            calls: vec![Call { within: 0, from: 0 }],
            known: HashMap::new(),
            open: Vec::new(),
            last: None,
            spent: HashMap::new(),
        }
    }

    /// An instruction that is executed: its address, and what it costs; nothing where that isn't of
    /// interest.
    pub(crate) fn step(&mut self, address: u32, cost: u64) {
        if let Some(last) = self.last
            && !(last < address && address <= last + 4)
        {
            self.jump(last, address);
        }
        self.last = Some(address);
        if cost > 0 {
            let call = self.open.last().map_or(0, |open| open.0);
            *self.spent.entry((call, address)).or_default() += cost;
        }
    }

    /// From one instruction to another that doesn't follow it.
    fn jump(&mut self, from: u32, to: u32) {
        if let Some(next) = self.code.returns_to(from)
            && self.code.begins_function(to)
        {
            let within = self.open.last().map_or(0, |open| open.0);
            let calls = &mut self.calls;
            let number = *self.known.entry((within, from)).or_insert_with(|| {
                calls.push(Call { within, from });
                calls.len() as u32 - 1
            });
            self.open.push((number, next));
        } else if let Some(returned) = self.open.iter().rposition(|open| open.1 == to) {
            // A function that ends with a jump to another leaves the return to that one.
            self.open.truncate(returned);
        }
    }

    /// What was spent: the calling instructions, the outermost first, the address, and the cost.
    pub(crate) fn spent(&self) -> impl Iterator<Item = (Vec<u32>, u32, u64)> {
        self.spent.iter().map(|(&(call, address), &cost)| {
            let mut path = Vec::new();
            let mut number = call;
            while number != 0 {
                let Call { within, from } = self.calls[number as usize];
                path.push(from);
                number = within;
            }
            path.reverse();
            (path, address, cost)
        })
    }
}

/// The instructions themselves.
struct Code {
    riscv: bool,
    segments: Vec<(u32, Vec<u8>)>,
    functions: HashSet<u32>,
}

impl Code {
    fn read(image: &Path) -> Result<Self, String> {
        let segments = elf::segments(image)?;
        let segments = segments.into_iter().map(|s| (s.place as u32, s.data)).collect();
        let functions = elf::functions(image)?.into_iter().map(|start| start as u32).collect();
        Ok(Self { riscv: elf::is_riscv(image)?, segments, functions })
    }

    /// Whether a function begins at an address; so it is with all that isn't in the program, as what a
    /// boot ROM has. (ARMv6-M has no other far jump than that of calls, and within functions there
    /// are such.)
    fn begins_function(&self, address: u32) -> bool {
        self.functions.contains(&address) || self.half(address).is_none()
    }

    /// Two bytes of code.
    fn half(&self, address: u32) -> Option<u32> {
        self.segments.iter().find_map(|(start, bytes)| {
            let at = address.checked_sub(*start)? as usize;
            let &[low, high] = bytes.get(at..at + 2)? else { return None };
            Some(u32::from(high) << 8 | u32::from(low))
        })
    }

    /// Where the call at an address returns to, if it is one.
    fn returns_to(&self, address: u32) -> Option<u32> {
        let first = self.half(address)?;
        let second = || self.half(address + 2);
        let bytes = if self.riscv {
            // c.jal; c.jalr; jal and jalr that keep the address in ra.
            match first {
                _ if first & 0xe003 == 0x2001 => 2,
                _ if first & 0xf07f == 0x9002 && first & 0x0f80 != 0 => 2,
                _ if first & 0x0fff == 0x00ef || first & 0x0fff == 0x00e7 => 4,
                _ => return None,
            }
        } else {
            // BLX of a register; BL.
            match first {
                _ if first & 0xff87 == 0x4780 => 2,
                _ if first & 0xf800 == 0xf000 && second()? & 0xd000 == 0xd000 => 4,
                _ => return None,
            }
        };
        Some(address + bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::{Code, Follower};

    /// At 0x100: BL, something; at 0x200: B, at 0x300: BX lr.
    fn program() -> Code {
        let call = vec![0x00, 0xf0, 0x7e, 0xf8, 0x00, 0xbf];
        let segments = vec![(0x100, call), (0x200, vec![0x7e, 0xe0]), (0x300, vec![0x70, 0x47])];
        Code { riscv: false, segments, functions: [0x100, 0x200].into() }
    }

    #[test]
    fn calls_are_told_from_jumps() {
        let code = program();
        assert_eq!(code.returns_to(0x100), Some(0x104));
        assert_eq!(code.returns_to(0x200), None);
        assert_eq!(code.returns_to(0x300), None);
        let riscv = |half: u16| {
            let segments = vec![(0, vec![half as u8, (half >> 8) as u8])];
            Code { riscv: true, segments, functions: [].into() }.returns_to(0)
        };
        assert_eq!(riscv(0x9082), Some(2), "c.jalr ra");
        assert_eq!(riscv(0x8082), None, "ret");
        assert_eq!(riscv(0x80e7), Some(4), "jalr ra, …(ra)");
        assert_eq!(riscv(0x9002), None, "c.ebreak");
    }

    #[test]
    fn a_callee_and_what_it_jumps_to_belong_to_their_caller() {
        let mut follower = Follower::with(program());
        for address in [0x100, 0x200, 0x300, 0x104, 0x100, 0x200, 0x300, 0x104] {
            follower.step(address, 1);
        }
        let mut spent: Vec<_> = follower.spent().collect();
        spent.sort();
        let callee = vec![0x100];
        assert_eq!(
            spent,
            [
                (vec![], 0x100, 2),
                (vec![], 0x104, 2),
                (callee.clone(), 0x200, 2),
                (callee, 0x300, 2)
            ]
        );
    }

    #[test]
    fn a_far_jump_within_a_function_is_no_call() {
        let mut code = program();
        code.functions.remove(&0x200);
        let mut follower = Follower::with(code);
        follower.step(0x100, 0);
        follower.step(0x200, 1);
        assert_eq!(follower.spent().next(), Some((vec![], 0x200, 1)));
    }
}
