"""Runs the `test_` functions of a scenario, on CPython or MicroPython: `run_scenario.py CHECKOUT DIRECTORY NAME`.

Prints a line for each: its name, a tab, and `ok` or the error.
"""

import sys

sys.path.append(sys.argv[1])
sys.path.append(sys.argv[2])


def run(name):
    scenario = __import__(name)
    for function in sorted(dir(scenario)):
        if not function.startswith("test_"):
            continue
        try:
            getattr(scenario, function)()
            print(function + "\tok")
        except Exception as error:
            if hasattr(sys, "print_exception"):
                sys.print_exception(error, sys.stderr)
            else:
                import traceback

                traceback.print_exc()
            print(f"{function}\t{type(error).__name__}: {error}")


run(sys.argv[3])
