"""Makes a virtual environment with pip: `python3 make_venv.py DIR`. Runs with nothing but the standard library.

Debian's python3 comes without `ensurepip`, which the module venv needs; the package python3-venv holds it. Where it is
missing, pip is put into the new environment by a pip that is there already, or by pip's own installer.
"""

import os
import subprocess
import sys
import tempfile
import urllib.request
import venv

OLDEST = (3, 11)
INSTALLER = "https://bootstrap.pypa.io/get-pip.py"


def this_python_can(statement):
    return subprocess.call([sys.executable, "-c", statement], stderr=subprocess.DEVNULL) == 0


def pip_of_this_python(python):
    """An installed pip of 22.3 or later can install for another interpreter."""
    command = [sys.executable, "-m", "pip", "--python", python, "install", "--quiet", "pip"]
    return this_python_can("import pip.__main__") and subprocess.call(command) == 0


def pip_by_its_installer(python):
    print("This Python has no ensurepip and no pip: fetching pip's installer, " + INSTALLER)
    try:
        with urllib.request.urlopen(INSTALLER, timeout=60) as answer:
            text = answer.read()
    except OSError as error:
        print("It cannot be fetched: " + str(error), file=sys.stderr)
        return False
    with tempfile.TemporaryDirectory() as folder:
        script = os.path.join(folder, "get-pip.py")
        with open(script, "wb") as file:
            file.write(text)
        return subprocess.call([python, script, "-q"]) == 0


def main():
    if sys.version_info < OLDEST:
        here = sys.version.split()[0]
        sys.exit("iec2mpy needs Python 3.11 or later; this is " + here + ". Name another one: make PYTHON=python3.12")
    folder = os.path.abspath(sys.argv[1])
    with_pip = this_python_can("from ensurepip import version")
    venv.create(folder, clear=True, with_pip=with_pip, symlinks=os.name != "nt")
    python = os.path.join(folder, "bin", "python")
    if not (with_pip or pip_of_this_python(python) or pip_by_its_installer(python)):
        sys.exit(
            "A virtual environment cannot be made: this Python has no ensurepip.\n"
            "On Debian and Ubuntu, install it with:  sudo apt install python3-venv"
        )


if __name__ == "__main__":
    main()
