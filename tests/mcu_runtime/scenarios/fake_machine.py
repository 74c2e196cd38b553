"""A `machine` for scenarios: pins with levels, an ADC, PWM and a timer that the test fires."""


class Pin:
    IN = 0
    OUT = 1
    PULL_UP = 2
    PULL_DOWN = 3
    broken = ()

    def __init__(self, pin, mode=None, pull=None, value=None):
        self.pin = pin
        if mode is not None:
            Pin.log.append((pin, mode, pull, value))
        if value is not None:
            Pin.levels[pin] = value

    def value(self, level=None):
        if self.pin in Pin.broken:
            raise OSError(5)
        if level is None:
            return Pin.levels.get(self.pin, 0)
        Pin.levels[self.pin] = level
        return None


class ADC:
    ATTN_11DB = 3
    raw = 0

    def __init__(self, pin):
        self.attenuation = None

    def atten(self, attenuation):
        self.attenuation = attenuation

    def read_u16(self):
        return ADC.raw


class PWM:
    def __init__(self, pin, freq=0, duty_u16=0):
        PWM.log.append((pin.pin, freq, duty_u16))

    def duty_u16(self, duty):
        PWM.log.append(duty)


class Timer:
    """As on RP2: only virtual timers."""

    PERIODIC = 1
    running = None

    def __init__(self, number):
        if number != -1:
            raise ValueError("Timer doesn't exist")

    def init(self, mode, period, callback):
        self.period = period
        self.callback = callback
        Timer.running = self

    def deinit(self):
        Timer.running = None


def reset():
    Pin.levels = {}
    Pin.log = []
    Pin.broken = ()
    PWM.log = []
    ADC.raw = 0
    Timer.running = None


reset()
