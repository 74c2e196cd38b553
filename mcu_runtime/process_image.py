"""The process image: what connects slots of V with the pins of a board.

`board.py` of a deployed folder holds the table, one tuple a channel:

    CHANNELS = (
        ("din", slot, pin, pull, invert),             # pull: "up", "down" or None
        ("dout", slot, pin, invert, safe),            # safe: 0 or 1, as the program sees it
        ("adc", slot, pin, low, high),                # what the lowest and the highest voltage mean
        ("pwm", slot, pin, freq, low, high, safe),    # low: always off, high: always on
    )

Where variables share bytes, each in a slot of V, a row has one value more: of a digital channel the number of its bit
in the slot, of an analog one True, as its high byte is in the next slot.
"""

_FULL = 65535


class DigitalInput:
    def __init__(self, machine, slot, pin, pull, invert, bit=0):
        self.slot = slot
        self._bit = bit
        self._invert = 1 if invert else 0
        pulls = {"up": "PULL_UP", "down": "PULL_DOWN"}
        self._pin = machine.Pin(pin, machine.Pin.IN, getattr(machine.Pin, pulls[pull]) if pull else None)

    def read(self, V):
        V[self.slot] = V[self.slot] & ~(1 << self._bit) | (self._pin.value() ^ self._invert) << self._bit


class DigitalOutput:
    def __init__(self, machine, slot, pin, invert, safe, bit=0):
        self.slot = slot
        self._mask = 1 << bit
        self._invert = 1 if invert else 0
        self._safe = safe ^ self._invert
        # With its value from the first: between two calls a relay would click.
        self._pin = machine.Pin(pin, machine.Pin.OUT, value=self._safe)

    def write(self, V):
        self._pin.value((1 if V[self.slot] & self._mask else 0) ^ self._invert)

    def safe(self):
        self._pin.value(self._safe)


class AnalogInput:
    def __init__(self, machine, slot, pin, low, high, in_bytes=False):
        self.slot = slot
        self._in_bytes = in_bytes
        self._low = low
        self._span = high - low
        self._adc = machine.ADC(machine.Pin(pin))
        if hasattr(machine.ADC, "ATTN_11DB"):  # ESP32: without it, the range ends at about 1 V
            self._adc.atten(machine.ADC.ATTN_11DB)

    def read(self, V):
        value = self._low + (self._adc.read_u16() * self._span + _FULL // 2) // _FULL
        if self._in_bytes:
            V[self.slot + 1] = value >> 8 & 0xFF
            value &= 0xFF
        V[self.slot] = value


class PwmOutput:
    def __init__(self, machine, slot, pin, freq, low, high, safe, in_bytes=False):
        self.slot = slot
        self._in_bytes = in_bytes
        self._low = low
        self._span = high - low
        self._safe = safe
        self._written = self._duty(safe)
        self._pwm = machine.PWM(machine.Pin(pin), freq=freq, duty_u16=self._written)

    def _duty(self, value):
        duty = (value - self._low) * _FULL // self._span
        return 0 if duty < 0 else _FULL if duty > _FULL else duty

    def _put(self, duty):
        if duty != self._written:  # setting it anew may disturb the running period
            self._pwm.duty_u16(duty)
            self._written = duty

    def write(self, V):
        value = V[self.slot]
        if self._in_bytes:
            value |= V[self.slot + 1] << 8
            if self._low < 0 and value > 0x7FFF:
                value -= 0x10000
        self._put(self._duty(value))

    def safe(self):
        self._put(self._duty(self._safe))


_INPUTS = {"din": DigitalInput, "adc": AnalogInput}
_OUTPUTS = {"dout": DigitalOutput, "pwm": PwmOutput}


class ProcessImage:
    """`io` of a controller. `machine` is MicroPython's module, or what behaves like it; outputs go safe at once."""

    def __init__(self, channels, machine):
        # Outputs first: a soft reset leaves pins as they were.
        self._outputs = [_OUTPUTS[c[0]](machine, *c[1:]) for c in channels if c[0] in _OUTPUTS]
        self._inputs = [_INPUTS[c[0]](machine, *c[1:]) for c in channels if c[0] in _INPUTS]

    def read(self, V):
        for channel in self._inputs:
            channel.read(V)

    def write(self, V):
        for channel in self._outputs:
            channel.write(V)

    def safe(self, V):
        """Every output gets its safe value; one that fails does not keep the others from theirs."""
        for channel in self._outputs:
            try:
                channel.safe()
            except Exception:
                pass
