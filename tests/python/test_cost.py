"""The measurements of tools/bench/python_calls.py run, and a call costs little beside a process for each run."""

import os
import pathlib
import re
import subprocess
import sys

BENCH = pathlib.Path(__file__).parents[2] / "tools/bench/python_calls.py"


def test_a_call_costs_little_and_leaves_no_memory_behind():
    done = subprocess.run([sys.executable, BENCH, "--calls", "20000", "--program", os.environ["RHEONET"]], check=True, capture_output=True, text=True)
    figures = {name.strip(): float(value) for name, value in re.findall(r"^(.*?)  +([-0-9.]+) (?:us|runs/s|KiB)$", done.stdout, re.MULTILINE)}
    assert len(figures) == 7, done.stdout
    # Far from the limits on an idle machine: about 20 us, 150 us, and 10 ms.
    assert 0 < figures["call, beyond the engine"] < 200
    assert figures["changed, beyond the engine"] < figures["process"] / 2
    # Four bytes a call would be a leak of the smallest object.
    assert figures["memory, 20000 calls"] < 200
