"""What the chips of boards can do: the architecture of their machine code, and what each pin is able to.

Facts are from the pages of the vendors, named at each chip; those of MicroPython (architectures, native emitters) are
from its sources and documentation.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Chip:
    """`arch`: what mpy-cross calls the chip's machine code. `native`: whether its MicroPython runs such code.
    `single`: whether its MicroPython computes with floats of 32 bits.

    `pins`: numbers of all GPIOs; the other sets are parts of it. `adc_wifi`: ADC pins that give nothing while WiFi is
    on. `pwm_slices`: how many pairs of PWM outputs there are, where pins 2 n and 2 n + 1 make the pair n modulo this
    number, and a pair has one frequency; 0 where any pin can have any frequency. `pwm_outputs`: how many pins can be
    PWM at once. `strapping`: pins that are read at reset, and decide how the chip starts. Which pins a board needs for
    itself, for its flash memory say, is in its file.
    """

    name: str
    title: str
    arch: str
    native: bool
    single: bool
    pins: frozenset[int]
    adc: frozenset[int]
    pwm_frequency: tuple[int, int]
    pwm_outputs: int
    pwm_slices: int = 0
    input_only: frozenset[int] = frozenset()
    strapping: frozenset[int] = frozenset()
    adc_wifi: frozenset[int] = frozenset()


def _pins(*ranges: int | tuple[int, int]) -> frozenset[int]:
    """Pins from single numbers and (first, last)."""
    spans = ((r, r) if isinstance(r, int) else r for r in ranges)
    return frozenset(p for first, last in spans for p in range(first, last + 1))


CHIPS: Mapping[str, Chip] = {
    chip.name: chip
    for chip in (
        # RP2040 datasheet, 1.4.3 (GPIO functions), 4.5.2 (PWM: GPIO n is slice n/2 mod 8), 4.9 (ADC on GPIO 26 to 29)
        Chip(
            name="rp2040",
            title="RP2040",
            arch="armv6m",
            native=True,
            single=True,
            pins=_pins((0, 29)),
            adc=_pins((26, 29)),
            pwm_frequency=(8, 62_500_000),
            pwm_outputs=16,
            pwm_slices=8,
        ),
        # RP2350A (the 60-pin package of Raspberry Pi Pico 2): RP2350 datasheet, 1.2.3, 12.5 and 12.4
        Chip(
            name="rp2350",
            title="RP2350A",
            arch="armv7emsp",
            native=True,
            single=True,
            pins=_pins((0, 29)),
            adc=_pins((26, 29)),
            pwm_frequency=(8, 75_000_000),
            pwm_outputs=16,
            pwm_slices=8,
        ),
        # https://docs.espressif.com/projects/esp-idf/en/stable/esp32/api-reference/peripherals/gpio.html: GPIO summary
        Chip(
            name="esp32",
            title="ESP32",
            arch="xtensawin",
            native=True,
            single=True,
            pins=_pins((0, 19), (21, 23), (25, 27), (32, 39)),
            adc=_pins(0, 2, 4, (12, 15), (25, 27), (32, 39)),
            pwm_frequency=(1, 40_000_000),
            pwm_outputs=16,
            input_only=_pins((34, 39)),
            strapping=_pins(0, 2, 5, 12, 15),
            adc_wifi=_pins(0, 2, 4, (12, 15), (25, 27)),
        ),
        # https://docs.espressif.com/projects/esp-idf/en/stable/esp32s3/api-reference/peripherals/gpio.html
        Chip(
            name="esp32s3",
            title="ESP32-S3",
            arch="xtensawin",
            native=True,
            single=True,
            pins=_pins((0, 21), (26, 48)),
            adc=_pins((1, 20)),
            pwm_frequency=(1, 40_000_000),
            pwm_outputs=8,
            strapping=_pins(0, 3, 45, 46),
            adc_wifi=_pins((11, 20)),
        ),
        # https://docs.espressif.com/projects/esp-idf/en/stable/esp32c3/api-reference/peripherals/gpio.html
        Chip(
            name="esp32c3",
            title="ESP32-C3",
            arch="rv32imc",
            native=True,
            single=True,
            pins=_pins((0, 21)),
            adc=_pins((0, 5)),
            pwm_frequency=(1, 40_000_000),
            pwm_outputs=6,
            strapping=_pins(2, 8, 9),
            adc_wifi=_pins(5),
        ),
    )
}
