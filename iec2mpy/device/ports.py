"""The serial ports that boards may be behind."""

from __future__ import annotations

from serial.tools import list_ports


def usb_ports() -> list[str]:
    """Names of the ports that are on USB, as all boards are; not those of the computer's own."""
    return sorted(port.device for port in list_ports.comports() if port.vid is not None)
