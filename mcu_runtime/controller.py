"""The controller: runs a program's tasks by priority and interval, in virtual or in real time.

Times are kept as what is left until a task is due, in microseconds: such numbers stay small, so nothing wraps and (for
intervals below 17 minutes) nothing is allocated on a 32-bit board.
"""

from mcu_runtime.faults import forget_tracebacks, kind_of, refill
from mcu_runtime.slots import NOW, NOW_US, SITE, WRAPS

DEFAULT_PERIOD_US = 10_000


class Task:
    """`wait`: us until it is due; negative: how late it is. `last`, `shortest`, `longest`: us that it ran."""

    def __init__(self, name, interval, priority, run):
        self.name = name
        self.interval = interval
        self.priority = priority
        self.run = run
        self.restart()

    def restart(self):
        self.wait = 0
        self.ran = False
        self.count = 0
        self.overruns = 0
        self.last = 0
        self.shortest = 0
        self.longest = 0

    def begin(self):
        """The next deadline is whole intervals after this one; those that are past are counted, and skipped."""
        missed = -self.wait // self.interval if self.wait < 0 else 0
        self.overruns += missed
        self.wait += (missed + 1) * self.interval
        self.ran = True

    def took(self, us):
        self.last = us
        if us > self.longest:
            self.longest = us
        if us < self.shortest or not self.count:
            self.shortest = us
        self.count += 1


class Controller:
    """Executes `program` (a module as the compiler makes it).

    `io` has `read(V)`, `write(V)` and `safe(V)`; `clock` has `elapsed()`. After a fault, `fault` is (kind, site) and
    `detail` may say more in English; nothing runs until `restart`. `tasks` are in order of their priority.
    """

    def __init__(self, program, io, clock):
        self._program = program
        self._read = io.read  # taken once: a bound method is an object
        self._write = io.write
        self._safe = io.safe
        self._clock = clock
        self.tasks = []
        for task in program.TASKS:
            self._insert(Task(*task))
        self.period = min([task.interval for task in self.tasks]) if self.tasks else DEFAULT_PERIOD_US
        self._untimed = Task("", self.period, 0, program.UNTIMED) if program.UNTIMED else None
        self._all = list(self.tasks)
        if self._untimed:
            self._all.append(self._untimed)
        self._now = 0  # ms, as in slot NOW
        self._wraps = 0  # how often it has come to its highest value
        self._rest = 0  # us that are no whole ms yet
        self.restart(True)

    def _insert(self, task):
        """By priority, then as declared. MicroPython's `sorted` keeps no order among equals."""
        at = len(self.tasks)
        while at and self.tasks[at - 1].priority > task.priority:
            at -= 1
        self.tasks.insert(at, task)

    def restart(self, cold):
        """Every variable gets its initial value, and the tasks are due at once. Warm: RETAIN variables keep theirs, and
        the clock goes on."""
        self._safe(self._program.V)
        self._now = 0 if cold else self._now
        self._wraps = 0 if cold else self._wraps
        self._rest = 0 if cold else self._rest
        self.fault = None
        self.detail = ""
        self.scans = 0
        self.interrupted = 0
        for task in self._all:
            task.restart()
        kept = [] if cold else self._retained()
        self._program.reset()
        for array, start, values in kept:
            for i in range(len(values)):
                array[start + i] = values[i]
        self._program.V[NOW] = self._now
        self._program.V[SITE] = 0
        self._end_poll()

    def _retained(self):
        program = self._program
        kept = [(program.V, start, list(program.V[start:end])) for start, end in program.RETAIN[0]]
        return kept + [(program.O, start, program.O[start:end]) for start, end in program.RETAIN[1]]

    # ------------------------------------------------------------------------------------- virtual time

    def scan(self):
        """One scan: a period of the fastest task. Tasks that become due inside it run at their own instants."""
        if self.fault:
            return
        left = self.period
        self._exchange(self._read)
        while not self.fault:
            task = self._first_within(left)
            if task is None:
                break
            if task.wait > 0:
                left -= task.wait
                self._advance(task.wait)
            self._run(task, False)
        if self._untimed and not self.fault:
            self._run(self._untimed, False)
        self._advance(left)
        if self._untimed:
            self._untimed.wait = 0  # it has no instant of its own: it ends each scan
        self._end_scan()

    def align(self):
        """After real time, before `scan`: the next task is due at once. Its deadline may be more than a period away."""
        soonest = min([task.wait for task in self._all]) if self._all else 0
        for task in self._all:
            task.wait -= soonest

    def _first_within(self, us):
        """The task that is due first in the next `us`; of those due together the most urgent."""
        first = None
        for task in self.tasks:
            if task.wait < us and (first is None or task.wait < first.wait):
                first = task
        return first

    # ---------------------------------------------------------------------------------------- real time

    def resume(self):
        """Before the first `poll` after a pause: the time that has passed does not count."""
        self._clock.elapsed()
        self._end_poll()

    def poll(self, early=0):
        """Run what is due by the clock, or will be within `early` us; each task at most once.

        Ctrl-C breaks only what just runs: it is counted, and the rest is done.
        """
        while True:
            try:
                self._poll(early)
                return
            except KeyboardInterrupt:
                self.interrupted += 1

    def tick(self):
        """How often to poll, in us: the greatest number that divides every interval."""
        tick = self.period
        for task in self._all:
            other = task.interval
            while other:
                tick, other = other, tick % other
        return tick

    def until_due(self):
        """Microseconds until the next task is due, at most a period; 0 or less if one is."""
        soonest = self.period
        for task in self._all:
            if task.wait < soonest:
                soonest = task.wait
        return soonest

    def _poll(self, early):
        """A poll, or, after an interrupt, the rest of it."""
        self._advance(self._clock.elapsed())
        while not self.fault:
            task = self._most_urgent(early)
            if task is None:
                break
            if self._reading:
                self._exchange(self._read)
                self._reading = False
            else:
                self._run(task, True)
        if not self._reading:
            self._end_scan()
        self._end_poll()

    def _end_poll(self):
        self._reading = True
        for task in self._all:
            task.ran = False

    def _most_urgent(self, early):
        """Of the tasks that are due: by priority, then the one that has waited longest (6.8.2)."""
        best = None
        for task in self.tasks:
            if task.wait > early or task.ran:
                continue
            if best is None:
                best = task
            elif task.priority > best.priority:
                break
            elif task.wait < best.wait:
                best = task
        untimed = self._untimed
        if best is None and untimed and untimed.wait <= early and not untimed.ran:
            return untimed
        return best

    # --------------------------------------------------------------------------------------------- both

    def stop(self):
        """Outputs go safe."""
        self._safe(self._program.V)

    def _advance(self, us):
        for task in self._all:
            task.wait -= us
        us += self._rest
        self._now += us // 1000
        if self._now > 0x7FFFFFFF:
            self._now -= 0x100000000
            self._wraps += 1
        self._rest = us % 1000

    def _run(self, task, real):
        """Run a task. Its time is fixed at its start."""
        V = self._program.V
        passed = self._clock.elapsed()
        if real:
            self._advance(passed)
        V[NOW] = self._now
        V[NOW_US] = self._rest
        V[WRAPS] = self._wraps
        refill(V, real)
        task.begin()
        try:
            task.run()
        except Exception as error:
            self._fail(error, "internal")
        us = self._clock.elapsed()
        task.took(us)
        if real:
            self._advance(us)

    def _exchange(self, transfer):
        """Read inputs or write outputs."""
        try:
            transfer(self._program.V)
        except Exception as error:
            self._program.V[SITE] = 0
            self._fail(error, "io")

    def _end_scan(self):
        if not self.fault:
            self._exchange(self._write)
        self.scans += 1

    def _fail(self, error, otherwise):
        """Stop for a fault, or for an exception that is none: lack of memory, or of the kind `otherwise`."""
        kind = kind_of(error)
        if kind is not None:
            forget_tracebacks()
        elif isinstance(error, MemoryError):
            kind = "memory"
        else:
            kind = otherwise
            self.detail = "%s: %s" % (type(error).__name__, error)
        self.fault = (kind, self._program.V[SITE])
        self._safe(self._program.V)
