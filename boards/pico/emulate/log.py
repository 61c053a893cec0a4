"""What a firmware has logged with defmt over RTT, while nobody read it."""

import json
import re
import struct

from elftools.elf.elffile import ELFFile


def lines(path, ram, base):
    """The messages in the log's buffer, with their arguments; none of a firmware without a log."""
    with open(path, "rb") as file:
        elf = ELFFile(file)
        table = elf.get_section_by_name(".symtab")
        defmt = [i for i, section in enumerate(elf.iter_sections()) if section.name == ".defmt"]
        control = table.get_symbol_by_name("_SEGGER_RTT")
        if not control or not defmt:
            return []
        words = {
            symbol["st_value"]: json.loads(symbol.name)["data"]
            for symbol in table.iter_symbols()
            if symbol["st_shndx"] == defmt[0] and symbol.name.startswith("{")
        }
    # Behind a name of 16 bytes and the numbers of channels: the first channel's name, its buffer, its
    # size, and how far it is written.
    at = control[0]["st_value"] - base + 24
    _, buffer, _, written = struct.unpack_from("<4I", ram, at)
    buffer -= base
    frames = ram[buffer : buffer + written].split(b"\0")
    return [message(words, unpacked(frame)) for frame in frames if frame]


def unpacked(frame):
    """Undoes rzCOBS, in which no byte is 0, from the end on."""
    data, out = list(frame), []
    while data:
        code = data.pop()
        if code < 0x80:
            for i in range(6, -1, -1):
                if code >> i & 1:
                    out.append(0)
                elif data:
                    out.append(data.pop())
        else:
            if code < 0xFF:
                out.append(0)
            run = 134 if code == 0xFF else (code & 0x7F) + 7
            out += [data.pop() for _ in range(min(run, len(data)))]
    return bytes(reversed(out))


def message(words, frame):
    """A message's text: the address of its words, then its arguments."""
    address, frame = int.from_bytes(frame[:2], "little"), frame[2:]
    sizes = {"u8": 1, "u16": 2, "u32": 4, "usize": 4, "u64": 8}

    def argument(match):
        nonlocal frame
        kind = match.group(1)
        if kind is None:
            # Something with a format of its own, whose words come first; here what `Display` makes of it.
            own, frame = words.get(int.from_bytes(frame[:2], "little")), frame[2:]
            text, _, frame = frame.partition(b"\xff")
            return text.decode(errors="replace") if own == "{=__internal_Display}" else match.group(0)
        if kind != "str" and kind not in sizes:
            # A kind that is not known here: the rest can't be read.
            frame = b""
            return match.group(0)
        size = 4 if kind == "str" else sizes[kind]
        number, frame = int.from_bytes(frame[:size], "little"), frame[size:]
        if kind != "str":
            return str(number)
        text, frame = frame[:number], frame[number:]
        return text.decode(errors="replace")

    return re.sub(r"\{(?:=(\w+))?\}", argument, words.get(address, f"message {address}"))
