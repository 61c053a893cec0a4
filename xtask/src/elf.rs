//! Reading finished programs: how large they are, and who calls what.

use std::path::Path;

use addr2line::Loader;
use object::elf::{PF_X, PT_LOAD};
use object::read::elf::{ElfFile32, ProgramHeader};
use object::{Object, ObjectSection, ObjectSymbol, RelocationTarget, SymbolKind};
use whitted_demo::job::ArithName;

/// Bytes of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sizes {
    /// Code.
    pub(crate) text: u64,
    /// Constants, the scenes among them.
    pub(crate) constants: u64,
}

/// How large a program is.
pub(crate) fn sizes(path: &Path) -> Result<Sizes, String> {
    with(path, |elf| {
        let mut sizes = Sizes::default();
        for section in elf.sections() {
            match section.name().unwrap_or_default() {
                // What is copied to RAM has sections of its own.
                ".text" | ".ram.text" => sizes.text += section.size(),
                ".rodata" | ".ram.rodata" => sizes.constants += section.size(),
                _ => {}
            }
        }
        Ok(sizes)
    })
}

/// Bytes of RAM that hold statics, of a program by cortex-m-rt.
pub(crate) fn static_bytes(path: &Path) -> Result<u64, String> {
    Ok(symbol(path, "__sheap")?.0 - symbol(path, "__sdata")?.0)
}

/// Where a program, linked with its relocations kept, calls the functions that panics start in:
/// the caller and the callee, with the source lines that were inlined there, the innermost first.
/// The lines come from a twin without relocations.
pub(crate) fn panics(path: &Path, twin: &Path) -> Result<Vec<String>, String> {
    let lines = Loader::new(twin).map_err(|error| format!("{}: {error}", twin.display()))?;
    with(path, |elf| {
        let mut functions: Vec<_> =
            elf.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text).collect();
        functions.sort_by_key(ObjectSymbol::address);
        let mut found = Vec::new();
        for section in elf.sections().filter(|section| section.name() == Ok(".text")) {
            for (address, relocation) in section.relocations() {
                let RelocationTarget::Symbol(index) = relocation.target() else { continue };
                let Ok(symbol) = elf.symbol_by_index(index) else { continue };
                let callee = name(symbol.name());
                if !callee.contains("panic") && !callee.ends_with("_fail") {
                    continue;
                }
                let next = functions.partition_point(|function| function.address() <= address);
                let caller =
                    next.checked_sub(1).map_or_else(|| "?".into(), |i| name(functions[i].name()));
                // Panics call each other; who began is of interest.
                if caller.contains("panic") || caller.starts_with("core::") {
                    continue;
                }
                found.push(format!("{caller} calls {callee}{}", inlined(&lines, address)));
            }
        }
        found.sort();
        found.dedup();
        Ok(found)
    })
}

/// The source lines behind an address, the innermost first.
fn inlined(lines: &Loader, address: u64) -> String {
    let mut text = String::new();
    let Ok(mut frames) = lines.find_frames(address) else { return text };
    while let Ok(Some(frame)) = frames.next() {
        if let Some(place) = frame.location {
            let (file, line) = (place.file.unwrap_or("?"), place.line.unwrap_or(0));
            text.push_str(&format!("\n         at {file}:{line}"));
        }
    }
    text
}

/// The functions of a program that compute in double precision in software: by the names that the
/// Arm ABI gives them, and by those of the compiler's library.
pub(crate) fn doubles(path: &Path) -> Result<Vec<String>, String> {
    with(path, |elf| {
        let functions = elf.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text);
        let mut found: Vec<_> = functions
            .map(|function| name(function.name()))
            .filter(|function| is_double(function))
            .collect();
        found.sort();
        found.dedup();
        Ok(found)
    })
}

/// Whether a function is one of double precision's.
fn is_double(function: &str) -> bool {
    let name = function.rsplit("::").next().unwrap_or(function);
    match name.strip_prefix("__aeabi_") {
        // Arithmetic, comparisons, from doubles; to doubles.
        Some(rest) => {
            ["dadd", "dsub", "drsub", "dmul", "ddiv", "dcmp", "cdcmp", "cdrcmp", "dneg", "d2"]
                .iter()
                .any(|operation| rest.starts_with(operation))
                || rest.ends_with("2d")
        }
        // As `__muldf3`, `__ltdf2`, `__extendsfdf2`, `__fixdfsi`, `__floatsidf`.
        None => {
            name.starts_with("__")
                && ["df2", "df3", "dfsi", "dfdi", "dfti", "sidf", "didf", "tidf", "dfsf2"]
                    .iter()
                    .any(|operation| name.ends_with(operation))
        }
    }
}

/// What a program puts into memory.
pub(crate) struct Segment {
    /// Where it is loaded from.
    pub(crate) address: u64,
    /// Where it then is: elsewhere if it is copied to RAM at the start.
    pub(crate) place: u64,
    pub(crate) data: Vec<u8>,
    pub(crate) is_code: bool,
}

/// All that a program puts into memory.
pub(crate) fn segments(path: &Path) -> Result<Vec<Segment>, String> {
    with(path, |elf| {
        let endian = elf.endian();
        let mut segments = Vec::new();
        for header in elf.elf_program_headers() {
            if header.p_type(endian) != PT_LOAD || header.p_filesz(endian) == 0 {
                continue;
            }
            let data = header.data(endian, elf.data()).map_err(|()| "a segment is cut off")?;
            segments.push(Segment {
                address: header.p_paddr(endian).into(),
                place: header.p_vaddr(endian).into(),
                data: data.to_vec(),
                is_code: (header.p_flags(endian) & PF_X) == PF_X,
            });
        }
        Ok(segments)
    })
}

/// Address and size of a symbol.
pub(crate) fn symbol(path: &Path, name: &str) -> Result<(u64, u64), String> {
    with(path, |elf| {
        let symbol = elf.symbols().find(|symbol| symbol.name() == Ok(name));
        let symbol = symbol.ok_or_else(|| format!("{}: no symbol {name}", path.display()))?;
        Ok((symbol.address(), symbol.size()))
    })
}

/// What a program with `boards/ram.x` has of the library and the scenes is in RAM, functions and statics
/// alike, and so is what they call, but for panics and the log; how many of either. It draws in an arithmetic.
pub(crate) fn in_ram(path: &Path, arith: ArithName) -> Result<[usize; 2], String> {
    /// Where RAM begins on the chips that have such a program.
    const RAM: u64 = 0x2000_0000;
    /// Some of what has to be there: code, a table, a tree; the tables of fixed point.
    const HOT: [&str; 5] = [
        "whitted::trace::",
        "whitted::frame::tone::CURVE",
        "::bathroom::WORDS",
        "whitted::math::root::RECIPROCAL",
        "whitted::math::root::RECIPROCAL_ROOT",
    ];
    /// What may stay in flash: panics, with what formats their messages, and the log, where a frame has failed;
    /// embassy, and the bus that is part of it.
    const COLD: [&str; 6] = [
        "core::option::",
        "core::result::",
        "core::panicking::",
        "core::fmt::",
        "defmt",
        "pico_async::bus",
    ];
    let hot = if arith == ArithName::Fixed { &HOT[..] } else { &HOT[..3] };
    with(path, |elf| {
        let (mut found, mut count) = (vec![false; hot.len()], [0; 2]);
        for symbol in elf.symbols() {
            let name = name(symbol.name());
            let kind = match symbol.kind() {
                SymbolKind::Text => 0,
                SymbolKind::Data => 1,
                _ => continue,
            };
            // From one to the other, functions are called by way of a piece of code with the callee's name.
            if let Some((kind, callee)) = name.split_once("LongThunk_")
                && kind.starts_with("__Thumb")
            {
                let callee = demangled(callee);
                if symbol.address() >= RAM && !COLD.iter().any(|cold| callee.contains(cold)) {
                    return Err(format!("code in RAM calls {callee}, which is in flash"));
                }
                continue;
            }
            if !name.contains("whitted") {
                continue;
            }
            if symbol.address() < RAM {
                return Err(format!("{name} is at {:#x}", symbol.address()));
            }
            count[kind] += 1;
            hot.iter().zip(&mut found).for_each(|(hot, found)| *found |= name.contains(hot));
        }
        match hot.iter().zip(found).find(|(_, found)| !found) {
            Some((hot, _)) => Err(format!("no {hot}")),
            None => Ok(count),
        }
    })
}

/// Where a program's functions begin.
pub(crate) fn functions(path: &Path) -> Result<Vec<u64>, String> {
    with(path, |elf| {
        let functions = elf.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text);
        // On Arm the lowest bit tells the instruction set.
        Ok(functions.map(|function| function.address() & !1).collect())
    })
}

/// Whether it is a program for RISC-V.
pub(crate) fn is_riscv(path: &Path) -> Result<bool, String> {
    with(path, |elf| Ok(elf.architecture() == object::Architecture::Riscv32))
}

fn name(raw: Result<&str, object::Error>) -> String {
    demangled(raw.unwrap_or("?"))
}

/// A symbol as it was written.
pub(crate) fn demangled(symbol: &str) -> String {
    format!("{:#}", rustc_demangle::demangle(symbol))
}

fn with<T>(
    path: &Path,
    read: impl FnOnce(&ElfFile32<'_>) -> Result<T, String>,
) -> Result<T, String> {
    let place = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let data = std::fs::read(path).map_err(|error| place(&error))?;
    let elf = ElfFile32::<object::Endianness>::parse(&*data).map_err(|error| place(&error))?;
    read(&elf)
}

#[cfg(test)]
mod tests {
    use super::is_double;

    #[test]
    fn double_precision_is_told_by_its_names() {
        for name in
            ["__aeabi_dmul", "__aeabi_dcmplt", "__aeabi_f2d", "__aeabi_ui2d", "__aeabi_d2iz"]
        {
            assert!(is_double(name), "{name}");
        }
        for name in ["compiler_builtins::float::mul::__muldf3", "__floatunsidf", "__truncdfsf2"] {
            assert!(is_double(name), "{name}");
        }
        for name in
            ["__aeabi_fmul", "__aeabi_idiv0", "__aeabi_memcpy", "__mulsf3", "__udivmoddi4", "draw"]
        {
            assert!(!is_double(name), "{name}");
        }
    }
}
