import fake_machine
from fake_machine import ADC, PWM, Pin
from support import Program

from mcu_runtime.clock import VirtualClock
from mcu_runtime.controller import Controller
from mcu_runtime.process_image import ProcessImage


def image(*channels):
    fake_machine.reset()
    return ProcessImage(channels, fake_machine), Program().V


def test_digital_inputs():
    io, V = image(("din", 8, 2, "up", True), ("din", 9, 3, None, False), ("din", 10, "BUTTON", "down", False))
    assert Pin.log == [(2, Pin.IN, Pin.PULL_UP, None), (3, Pin.IN, None, None), ("BUTTON", Pin.IN, Pin.PULL_DOWN, None)]
    Pin.levels.update({2: 0, 3: 1, "BUTTON": 0})
    io.read(V)
    assert list(V[8:11]) == [1, 1, 0]


def test_digital_outputs_are_made_with_their_safe_value():
    io, V = image(("dout", 8, 5, False, 0), ("dout", 9, 6, True, 0), ("dout", 10, 7, False, 1))
    assert [entry[3] for entry in Pin.log] == [0, 1, 1]
    V[8] = V[9] = 1
    io.write(V)
    assert Pin.levels == {5: 1, 6: 0, 7: 0}
    io.safe(V)
    assert Pin.levels == {5: 0, 6: 1, 7: 1}
    assert V[8] == 1


def test_channels_among_shared_bytes():
    io, V = image(
        ("din", 8, 2, None, False, 3),
        ("din", 8, 3, None, True),
        ("dout", 9, 4, False, 0, 7),
        ("adc", 10, 26, -1000, 1000, True),
        ("pwm", 12, 15, 1000, -100, 100, 0, True),
    )
    Pin.levels.update({2: 1, 3: 1})
    ADC.raw = 0
    V[8], V[9], V[12], V[13] = 0x41, 0x80, 0xCE, 0xFF
    io.read(V)
    assert list(V[8:12]) == [0x48, 0x80, 0x18, 0xFC]
    Pin.levels[2] = 0
    ADC.raw = 65535
    io.read(V)
    assert list(V[8:12]) == [0x40, 0x80, 0xE8, 0x03]
    io.write(V)
    assert Pin.levels[4] == 1
    assert PWM.log[-1] == 65535 // 4


def test_outputs_go_safe_before_inputs_are_made():
    image(("din", 8, 2, None, False), ("dout", 9, 3, False, 0))
    assert [entry[0] for entry in Pin.log] == [3, 2]


def test_adc_is_scaled():
    io, V = image(("adc", 8, 26, 0, 1000), ("adc", 9, 27, -100, 100), ("adc", 10, 28, 100, 0))
    for raw, expected in ((0, [0, -100, 100]), (65535, [1000, 100, 0]), (32768, [500, 0, 50])):
        ADC.raw = raw
        io.read(V)
        assert list(V[8:11]) == expected, list(V[8:11])


def test_pwm_is_clamped_and_written_when_it_changes():
    io, V = image(("pwm", 8, 15, 1000, 0, 100, 20))
    safe = 20 * 65535 // 100
    assert PWM.log == [(15, 1000, safe)]
    for value in (50, 50, 100, 150, -3):
        V[8] = value
        io.write(V)
    assert PWM.log[1:] == [32767, 65535, 0]
    io.safe(V)
    assert PWM.log[-1] == safe


def test_one_broken_output_does_not_keep_the_others_unsafe():
    io, V = image(("dout", 8, 5, False, 0), ("dout", 9, 6, False, 0))
    V[8] = V[9] = 1
    io.write(V)
    Pin.broken = (5,)
    io.safe(V)
    assert Pin.levels == {5: 1, 6: 0}


def test_a_broken_input_stops_the_controller():
    io, _ = image(("din", 8, 2, None, False), ("dout", 9, 3, False, 1))
    program = Program()
    program.TASKS = (("main", 10_000, 1, program.runs("main")),)
    controller = Controller(program, io, VirtualClock())
    controller.scan()
    assert Pin.levels[3] == 0
    Pin.broken = (2,)
    controller.scan()
    assert controller.fault == ("io", 0)
    assert "OSError" in controller.detail
    assert Pin.levels[3] == 1
    assert len(program.log) == 1
