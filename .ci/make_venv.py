"""Makes a virtual environment with pip: `python3 make_venv.py DIR`. Runs with nothing but the standard library.

Debian's python3 comes without `ensurepip`, which the module venv needs; the package python3-venv holds it. Where it is
missing, pip is put into the new environment by a pip that is there already, or from its wheel at PyPI.
"""

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import urllib.parse
import urllib.request
import venv

OLDEST = (3, 11)
INDEX = "https://pypi.org/pypi/pip/json"


def this_python_can(statement):
    return subprocess.call([sys.executable, "-c", statement], stderr=subprocess.DEVNULL) == 0


def pip_of_this_python(python):
    """An installed pip of 22.3 or later can install for another interpreter."""
    command = [sys.executable, "-m", "pip", "--python", python, "install", "--quiet", "pip"]
    return this_python_can("import pip.__main__") and subprocess.call(command) == 0


def pip_from_its_wheel(python):
    """A wheel is an archive that Python can import from: pip's own can install itself."""
    print("This Python has no ensurepip and no pip: fetching pip from " + INDEX)
    try:
        with urllib.request.urlopen(INDEX, timeout=60) as answer:
            files = json.load(answer)["urls"]
        wheel = next(file for file in files if file["packagetype"] == "bdist_wheel")
        with urllib.request.urlopen(urllib.parse.urljoin(INDEX, wheel["url"]), timeout=60) as answer:
            data = answer.read()
    except (OSError, ValueError, KeyError, StopIteration) as error:
        print("It cannot be fetched: " + str(error), file=sys.stderr)
        return False
    if hashlib.sha256(data).hexdigest() != wheel["digests"]["sha256"]:
        print("It is damaged: its hash is not the one that the index states.", file=sys.stderr)
        return False
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, wheel["filename"])
        with open(path, "wb") as file:
            file.write(data)
        command = [python, os.path.join(path, "pip"), "install", "--quiet", "--no-index", path]
        return subprocess.call(command) == 0


def main():
    if sys.version_info < OLDEST:
        here = sys.version.split()[0]
        sys.exit("iec2mpy needs Python 3.11 or later; this is " + here + ". Name another one: make PYTHON=python3.12")
    folder = os.path.abspath(sys.argv[1])
    with_pip = this_python_can("from ensurepip import version")
    venv.create(folder, clear=True, with_pip=with_pip, symlinks=os.name != "nt")
    python = os.path.join(folder, "bin", "python")
    if not (with_pip or pip_of_this_python(python) or pip_from_its_wheel(python)):
        sys.exit(
            "A virtual environment cannot be made: this Python has no ensurepip.\n"
            "On Debian and Ubuntu, install it with:  sudo apt install python3-venv"
        )


if __name__ == "__main__":
    main()
