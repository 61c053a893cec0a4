"""A model of the displays' controllers (ST7789, ST7735S, ILI9341), as far as pictures go.

It listens to SPI1 and to the pins for select (9), data/command (8) and reset (12), and refuses what a real
controller would not take or show: commands too soon after reset or waking up, pixels before it is awake, windows
outside of its memory, another pixel format. Whether columns and rows of its memory are exchanged it
has to have been told; else addresses are those that the firmware sends, so a picture is kept as it is seen, however
the controller is told to turn it.
"""

SLEEP_OUT, DISPLAY_ON, COLUMNS, ROWS, WRITE = 0x11, 0x29, 0x2A, 0x2B, 0x2C
MEMORY_ACCESS, FORMAT = 0x36, 0x3A
SELECT_PIN, DATA_PIN, RESET_PIN = 9, 8, 12
# The bit of MEMORY_ACCESS that exchanges columns and rows.
EXCHANGED = 0x20
# By the data sheets of all three: how long reset has to be low, and what is to pass between reset and the first
# command, reset and waking up, waking up and the next command. (Reset's are ten microseconds, but the emulator's alarms
# come up to one early.)
RESET_NS, READY_NS, ASLEEP_NS, AWAKE_NS = 9_000, 5_000_000, 120_000_000, 5_000_000


class Refused(Exception):
    """A controller would not have understood this."""


class Display:
    def __init__(self, width, height, offset, native):
        self.width, self.height, self.offset, self.native = width, height, offset, native
        self.memory = bytearray(width * height * 2)
        self.reset()
        # When reset was taken low, and high; it hasn't been yet.
        self.lowered = self.raised = None
        self.bytes = 0
        # The number of the byte that SPI doesn't get rid of, and whether that is the case now.
        self.stuck_at = None
        self.stuck = False

    def reset(self):
        self.awake = self.on = self.exchanged = False
        self.format = self.command = self.high = None
        self.arguments = []
        self.window = {COLUMNS: None, ROWS: None}
        # What it has to be left alone until.
        self.ready = 0

    def stick(self, more):
        """SPI stands still after so many more bytes, once, until the display is deselected."""
        self.stuck_at = self.bytes + more

    def attach(self, chip):
        spi = chip.spi[1]
        done = chip.clock.create_alarm(lambda: spi.complete_transmit(0))

        def select(value, before):
            if self.stuck and value.value:
                self.stuck = False
                done.schedule(0)

        chip.gpio[SELECT_PIN].add_listener(select)
        self.now = lambda: chip.clock.nanos

        def reset(value, before):
            if not value.value:
                self.reset()
                self.lowered, self.raised = self.now(), None
            elif self.lowered is not None and self.now() - self.lowered >= RESET_NS:
                self.raised = self.now()
                self.ready = self.raised + READY_NS

        chip.gpio[RESET_PIN].add_listener(reset)

        def transmit(value):
            if self.bytes == self.stuck_at:
                self.stuck, self.stuck_at = True, None
                return
            self.bytes += 1
            if not chip.gpio[SELECT_PIN].value.value:
                (self.data if chip.gpio[DATA_PIN].value.value else self.order)(value)
            # A byte takes its time; without that, DMA would gain nothing.
            done.schedule(spi.data_bits * 1e9 / spi.clock_frequency)

        spi.on_transmit = transmit

    def order(self, command):
        if self.raised is None:
            raise Refused(f"the command {command:#x} without a reset")
        if self.now() < self.ready:
            raise Refused(f"the command {command:#x} so soon")
        self.command, self.arguments, self.high = command, [], None
        if command == SLEEP_OUT:
            if self.now() < self.raised + ASLEEP_NS:
                raise Refused("waking up so soon after reset")
            self.awake = True
            self.ready = self.now() + AWAKE_NS
        elif command == DISPLAY_ON:
            self.on = True
        elif command == WRITE:
            if not self.awake or self.format != 5 or None in self.window.values():
                raise Refused("pixels before sleep-out, the pixel format, or a window")
            self.x, self.y = self.window[COLUMNS][0], self.window[ROWS][0]

    def data(self, value):
        if self.command == WRITE:
            self.pixel(value)
            return
        self.arguments.append(value)
        if self.command == FORMAT:
            self.format = value & 7
        elif self.command == MEMORY_ACCESS:
            self.exchanged = bool(value & EXCHANGED)
        elif self.command in self.window and len(self.arguments) == 4:
            first, last = (self.arguments[i] << 8 | self.arguments[i + 1] for i in (0, 2))
            axis = 0 if self.command == COLUMNS else 1
            if last >= self.native[axis ^ self.exchanged]:
                raise Refused(f"a window to {last}, beyond the controller's memory")
            first, last = first - self.offset[axis], last - self.offset[axis]
            if not 0 <= first <= last < (self.width, self.height)[axis]:
                raise Refused(f"a window from {first} to {last}")
            self.window[self.command] = (first, last)

    def pixel(self, value):
        if self.high is None:
            self.high = value
            return
        at = (self.y * self.width + self.x) * 2
        self.memory[at : at + 2] = self.high, value
        self.high = None
        self.x += 1
        if self.x > self.window[COLUMNS][1]:
            self.x = self.window[COLUMNS][0]
            self.y = self.y + 1 if self.y < self.window[ROWS][1] else self.window[ROWS][0]
