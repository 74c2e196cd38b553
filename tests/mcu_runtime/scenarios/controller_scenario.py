from support import IO, Program, raises

from mcu_runtime import faults
from mcu_runtime.clock import RealClock, VirtualClock
from mcu_runtime.controller import Controller
from mcu_runtime.slots import LOOP, NOW, SITE


def build(tasks, untimed=False, retain=((), ())):
    """A controller of tasks (name, interval, priority) that log when they run; with its program, io and clock."""
    program = Program(retain=retain)
    program.TASKS = tuple([(name, interval, priority, program.runs(name)) for name, interval, priority in tasks])
    program.UNTIMED = program.runs("untimed") if untimed else None
    io = IO()
    clock = VirtualClock()
    return Controller(program, io, clock), program, io, clock


def test_scans_are_one_interval_apart():
    controller, program, io, _ = build([("main", 10_000, 1)])
    for _ in range(3):
        controller.scan()
    assert program.log == [("main", 0), ("main", 10), ("main", 20)]
    assert io.log == ["safe"] + ["read", "write"] * 3


def test_a_task_runs_at_its_own_instant_within_a_scan():
    controller, program, _, _ = build([("fast", 10_000, 1), ("slow", 25_000, 1)])
    for _ in range(6):
        controller.scan()
    assert [at for name, at in program.log if name == "slow"] == [0, 25, 50]
    assert program.log[4:6] == [("slow", 25), ("fast", 30)]


def test_tasks_due_together_run_by_priority():
    controller, program, _, _ = build([("late", 10_000, 5), ("first", 10_000, 0), ("second", 10_000, 0)])
    controller.scan()
    assert [name for name, _ in program.log] == ["first", "second", "late"]


def test_untimed_programs_end_the_scan():
    controller, program, _, _ = build([("fast", 10_000, 1), ("slow", 15_000, 1)], untimed=True)
    controller.scan()
    controller.scan()
    assert program.log == [
        ("fast", 0),
        ("slow", 0),
        ("untimed", 0),
        ("fast", 10),
        ("slow", 15),
        ("untimed", 15),
    ]


def test_without_tasks_a_scan_takes_ten_ms():
    controller, program, _, _ = build([], untimed=True)
    controller.scan()
    controller.scan()
    assert program.log == [("untimed", 0), ("untimed", 10)]


def test_intervals_below_a_ms():
    controller, program, _, _ = build([("main", 400, 1)])
    for _ in range(6):
        controller.scan()
    assert [at for _, at in program.log] == [0, 0, 0, 1, 1, 2]


def test_the_time_wraps():
    controller, program, _, _ = build([("main", 3_600_000_000, 1)])
    for _ in range(598):
        controller.scan()
    assert program.log[-2][1] == 596 * 3_600_000
    assert program.log[-1][1] == 597 * 3_600_000 - 0x100000000


def test_cold_restart():
    controller, program, _, _ = build([("main", 10_000, 1)], retain=(((8, 9),), ((1, 2),)))
    controller.scan()
    program.O[1] = 7.0
    controller.restart(True)
    assert program.V[8] == 0 and program.O[1] == 0.5
    controller.scan()
    assert program.log[-1] == ("main", 0)


def test_warm_restart_keeps_retain_and_the_clock():
    controller, program, _, _ = build([("main", 10_000, 1), ("slow", 40_000, 1)], retain=(((8, 9),), ((1, 2),)))
    controller.scan()
    controller.scan()
    program.V[9] = 5
    program.O[1] = 7.0
    program.O[2] = "old"
    controller.restart(False)
    assert (program.V[8], program.V[9], program.O[1], program.O[2]) == (3, 0, 7.0, "new")
    controller.scan()
    assert program.log[-2:] == [("main", 20), ("slow", 20)]  # all tasks are due at once


def faulting(error, site):
    controller, program, io, _ = build([("main", 10_000, 1)])

    def run():
        program.V[8] += 1
        program.V[SITE] = site
        raise error

    controller.tasks[0].run = run
    return controller, program, io


def test_a_fault_stops_with_outputs_safe():
    controller, program, io = faulting(faults.ZERO, 12)
    controller.scan()
    assert controller.fault == ("zero", 12)
    assert io.log == ["safe", "read", "safe"]
    controller.scan()
    assert program.V[8] == 1
    controller.restart(False)
    assert controller.fault is None and program.V[SITE] == 0


def test_what_is_no_fault_stops_too():
    controller, _, _ = faulting(TypeError("bad"), 3)
    controller.scan()
    assert controller.fault == ("internal", 3)
    assert controller.detail == "TypeError: bad"
    controller, _, _ = faulting(MemoryError("full"), 0)
    controller.scan()
    assert controller.fault == ("memory", 0)


def test_a_driver_that_fails_is_a_fault():

    class BrokenIO(IO):
        def write(self, V):
            raise OSError(5)

    program = Program()
    program.TASKS = (("main", 10_000, 1, program.runs("main")),)
    io = BrokenIO()
    controller = Controller(program, io, VirtualClock())
    program.V[SITE] = 9
    controller.scan()
    assert controller.fault == ("io", 0)
    assert io.log[-1] == "safe"


def test_a_loop_ends_in_virtual_time():
    V = Program().V
    faults.refill(V, False)
    passes = V[LOOP]
    assert passes >= 10_000
    V[LOOP] = 0
    raises(faults.LOOP, faults.loop_check, V)


def test_a_loop_may_go_on_in_real_time_until_its_limit():
    V = Program().V
    faults.refill(V, True)
    V[LOOP] = 0
    faults.loop_check(V)
    assert V[LOOP] > 0

    def forever():
        while True:
            V[LOOP] = 0
            faults.loop_check(V)

    clock = RealClock()
    raises(faults.LOOP, forever)
    assert 400_000 < clock.elapsed() < 2_000_000


# ------------------------------------------------------------------------------------------ real time


def test_poll_runs_what_is_due():
    controller, program, io, clock = build([("main", 10_000, 1)])
    controller.resume()
    controller.poll()
    clock.advance(4_000)
    controller.poll()
    assert program.log == [("main", 0)]
    assert controller.until_due() == 6_000
    clock.advance(7_000)
    controller.poll()
    assert program.log == [("main", 0), ("main", 11)]
    assert io.log == ["safe", "read", "write", "read", "write"]


def test_deadlines_do_not_drift():
    controller, _, _, clock = build([("main", 10_000, 1)])
    controller.resume()
    controller.poll()
    for late in (300, 900, 100, 500):
        clock.advance(controller.until_due() + late)
        controller.poll()
    assert controller.until_due() == 10_000 - 500
    assert controller.tasks[0].overruns == 0


def test_a_little_early_is_in_time():
    controller, program, _, clock = build([("main", 10_000, 1)])
    controller.resume()
    controller.poll()
    clock.advance(9_990)
    controller.poll(5_000)
    assert len(program.log) == 2
    assert controller.tasks[0].wait == 10_010


def test_missed_deadlines_are_counted_and_skipped():
    controller, program, _, clock = build([("main", 10_000, 1)])
    controller.resume()
    controller.poll()
    clock.advance(47_000)
    controller.poll()
    controller.poll()
    assert [at for _, at in program.log] == [0, 47]
    assert controller.tasks[0].overruns == 3
    assert controller.until_due() == 3_000


def test_a_task_that_takes_too_long_leaves_room():
    controller, program, _, clock = build([("main", 10_000, 1)])
    run = controller.tasks[0].run

    def slow():
        run()
        clock.advance(35_000)

    controller.tasks[0].run = slow
    controller.resume()
    controller.poll()
    assert len(program.log) == 1
    task = controller.tasks[0]
    assert (task.last, task.shortest, task.longest, task.count) == (35_000, 35_000, 35_000, 1)
    controller.poll()
    assert program.log[-1] == ("main", 35)
    assert task.overruns == 2


def test_priority_before_waiting_time():
    controller, program, _, clock = build([("low", 10_000, 2), ("high", 20_000, 1), ("other", 15_000, 2)])
    controller.resume()
    controller.poll()
    assert [name for name, _ in program.log] == ["high", "low", "other"]
    clock.advance(22_000)
    controller.poll()
    # low has been due since 10, other since 15, high since 20
    assert [name for name, _ in program.log[3:]] == ["high", "low", "other"]
    clock.advance(16_000)
    controller.poll()
    # at 38: other is due since 30, and so is low; high is not
    assert [name for name, _ in program.log[6:]] == ["low", "other"]


def test_a_tasks_time_is_fixed_at_its_start():
    controller, program, _, clock = build([("first", 10_000, 1), ("second", 10_000, 2)])
    run = controller.tasks[0].run

    def slow():
        clock.advance(3_000)
        run()

    controller.tasks[0].run = slow
    controller.resume()
    controller.poll()
    assert program.log == [("first", 0), ("second", 3)]


def test_ctrl_c_breaks_one_task_and_no_other():
    controller, program, io, clock = build([("first", 10_000, 1), ("second", 10_000, 2)], untimed=True)

    def interrupted():
        raise KeyboardInterrupt

    controller.tasks[0].run = interrupted
    controller.resume()
    controller.poll()
    assert controller.interrupted == 1
    assert controller.fault is None
    assert [name for name, _ in program.log] == ["second", "untimed"]
    assert io.log == ["safe", "read", "write"]
    clock.advance(10_000)
    controller.poll()
    assert controller.interrupted == 2


def test_time_does_not_count_while_stopped():
    controller, program, _, clock = build([("main", 10_000, 1)])
    controller.resume()
    controller.poll()
    clock.advance(60_000)
    controller.resume()
    controller.poll()
    assert program.log == [("main", 0)]


def test_untimed_programs_run_once_a_period_in_real_time():
    controller, program, _, clock = build([("main", 10_000, 1)], untimed=True)
    controller.resume()
    for _ in range(4):
        controller.poll()
        clock.advance(5_000)
    assert program.log == [("main", 0), ("untimed", 0), ("main", 10), ("untimed", 10)]


def test_tick():
    assert build([("a", 10_000, 1), ("b", 25_000, 1)])[0].tick() == 5_000
    assert build([("a", 10_000, 1)])[0].tick() == 10_000


def test_real_clock_counts_microseconds():
    clock = RealClock()
    clock.elapsed()
    from mcu_runtime.ports import sleep_us

    sleep_us(20_000)
    assert 19_000 < clock.elapsed() < 200_000
    assert clock.elapsed() < 10_000


def test_slots():
    assert (NOW, LOOP, SITE) == (1, 2, 3)


def test_the_scheduler_allocates_nothing():
    try:
        from gc import collect, disable, enable, mem_alloc
    except ImportError:  # CPython
        return

    class NoIO(IO):
        def read(self, V):
            pass

        write = safe = read

    program = Program()
    program.TASKS = (("a", 10_000, 1, program.reset), ("b", 20_000, 1, program.reset))
    program.UNTIMED = program.reset
    clock = VirtualClock()
    controller = Controller(program, NoIO(), clock)
    controller.resume()
    collect()
    disable()
    before = mem_alloc()
    for _ in range(100):
        clock.advance(10_000)
        controller.poll(5_000)
        controller.until_due()
        controller.scan()
    grown = mem_alloc() - before
    enable()
    assert controller.scans == 200
    assert grown < 100, grown
