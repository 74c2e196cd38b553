"""A program as viper code, written by hand, and 56 scans of it: the level falls and rises, an index goes wild."""

TEXT = '''\
import micropython
from array import array
from micropython import const

V = array("i", [0] * 64)  # BOOL, integers, TIME: one slot each
O = [0.0] * 8             # REAL

# controller
_NOW = const(0)           # ms, set by the scheduler before a task runs
_TRIP = const(1)          # not 0: leave every loop (watchdog, stop)
_LINE = const(2)          # source line of the statement that faults
# tank
_LEVEL = const(3)         # sample.st:6   level : INT (%IW0)
_PUMP = const(4)          # sample.st:7   pump : BOOL (%QX0.0)
_N = const(5)             # sample.st:8   n : INT
_BUF = const(6)           # sample.st:9   buf : ARRAY[0..9] OF INT, 6..15
_SUM = const(16)          # sample.st:10  sum : DINT
_AVG = const(17)          # sample.st:11  avg : INT
_DELAY = const(18)        # sample.st:12  delay : TON, 18..24
_RATIO = const(0)         # sample.st:13  ratio : REAL, in O
# TON, from its base
_TON_IN = const(0)
_TON_PT = const(1)
_TON_Q = const(2)
_TON_ET = const(3)
_TON_M = const(4)
_TON_T0 = const(5)


class Fault(Exception):
    pass


@micropython.viper
def TON(v: ptr32, now: int):  # shared body: v points at the instance
    if v[_TON_IN] == 0:
        v[_TON_Q] = 0
        v[_TON_ET] = 0
        v[_TON_M] = 0
    else:
        if v[_TON_M] == 0:
            v[_TON_M] = 1
            v[_TON_T0] = now
        et = now - v[_TON_T0]
        if et >= v[_TON_PT]:
            et = v[_TON_PT]
            v[_TON_Q] = 1
        v[_TON_ET] = et


@micropython.viper
def tank(v: ptr32):
    o = O
    # sample.st:15  buf[n] := level;
    i = v[_N]
    if i < 0 or i > 9:
        v[_LINE] = 15
        raise Fault("index")
    v[_BUF + i] = v[_LEVEL]
    # sample.st:16  n := (n + 1) MOD 10;      n is 0..9 here: no wrap, no sign to mend
    v[_N] = (i + 1) % 10
    # sample.st:17  sum := 0;
    s = 0
    # sample.st:18  FOR i := 0 TO 9 DO sum := sum + buf[i]; END_FOR;
    i = 0
    while i <= 9:
        s += v[_BUF + i]
        i += 1
    v[_SUM] = s
    # sample.st:19  avg := DINT_TO_INT(sum / 10);     truncates toward zero
    if s < 0:
        q = 0 - ((0 - s) // 10)
    else:
        q = s // 10
    if q < -32768 or q > 32767:
        v[_LINE] = 19
        raise Fault("range")
    v[_AVG] = q
    # sample.st:20  ratio := INT_TO_REAL(avg) / 100.0;
    o[_RATIO] = float(q) / 100.0
    # sample.st:21  delay(IN := ratio < 2.5, PT := T#50ms);
    if o[_RATIO] < 2.5:
        v[_DELAY + _TON_IN] = 1
    else:
        v[_DELAY + _TON_IN] = 0
    v[_DELAY + _TON_PT] = 50
    TON(uint(v) + (_DELAY << 2), v[_NOW])
    # sample.st:22  pump := delay.Q OR (pump AND ratio < 8.0);
    r = 0
    if o[_RATIO] < 8.0:
        r = 1
    v[_PUMP] = v[_DELAY + _TON_Q] | (v[_PUMP] & r)
'''

SCANS = '''
trace = []
for scan in range(56):
    V[_NOW] = scan * 10
    V[_LEVEL] = 40 - scan * 2 if scan < 20 else scan * 12
    if scan == 50:
        V[_N] = 10
    try:
        tank(V)
    except Fault as fault:
        trace.append(("fault", str(fault)))
    trace.append((scan, V[_PUMP], V[_SUM], V[_AVG], V[_DELAY + _TON_ET], int(O[_RATIO] * 1000.0 + 0.5)))
'''
