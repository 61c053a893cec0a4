//! How large programs are.

use std::path::Path;

use super::Table;
use crate::elf;
use crate::machine;
use crate::shell::boards;

/// Boards with a display of their own, or a scene: the directory, which the program is named after, and the target.
const OTHERS: [(&str, &str); 7] = [
    ("pico", "thumbv6m-none-eabi"),
    ("pico-async", "thumbv6m-none-eabi"),
    ("pico2", "thumbv8m.main-none-eabihf"),
    ("stm32f4", "thumbv7em-none-eabihf"),
    ("microbit-v2", "thumbv7em-none-eabihf"),
    ("room", "thumbv7m-none-eabi"),
    ("baked", "thumbv7m-none-eabi"),
];

/// The programs that are nothing but a tracer.
pub(super) fn kernels(table: &mut Table) -> Result<(), String> {
    for target in ["thumbv6m-none-eabi", "thumbv7em-none-eabihf"] {
        for bin in ["limit-fixed", "limit-f32"] {
            let program = machine::build(&boards().join("size"), bin, target)?;
            image(table, bin, target, &program, None)?;
        }
    }
    Ok(())
}

/// The boards that QEMU counts nothing on.
pub(super) fn others(table: &mut Table) -> Result<(), String> {
    for (board, target) in OTHERS {
        println!("{board} …");
        let program = machine::build(&boards().join(board), board, target)?;
        let memory = elf::static_bytes(&program)?;
        image(table, &format!("firmware {board}"), target, &program, Some(memory))?;
    }
    Ok(())
}

/// Adds a program's row.
pub(super) fn image(
    table: &mut Table,
    name: &str,
    target: &str,
    program: &Path,
    memory: Option<u64>,
) -> Result<(), String> {
    let sizes = elf::sizes(program)?;
    table.rows.push(vec![
        name.into(),
        target.into(),
        sizes.text.to_string(),
        String::new(),
        sizes.constants.to_string(),
        memory.map_or_else(String::new, |bytes| bytes.to_string()),
    ]);
    Ok(())
}
