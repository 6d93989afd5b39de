#!/usr/bin/python3
"""What a call from Python costs beside the run itself, beside a process for each run, and in memory.

    PYTHONPATH=build/release/python tools/bench/python_calls.py [--calls N] [--program build/release/bin/rheonet]

The scene is short, so that the cost of a call shows: an oscillator, 11 rows, about 0.1 ms. Prints a table.

  call            CPU time of scene.run() with its first array, less that of the engine for the same run, which it counts itself
  changed         the same of rheonet.loads() with a changed value, and run(): what an optimiser does
  threads         runs in a second of wall time, by one Python thread and by two
  process         wall time of `rheonet run` for the same scene, with its rows as CSV
  memory          growth of the resident set over all calls, after the first hundredth of them
"""

import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

import rheonet

SCENE = """
title = "An oscillator"
[elements]
m1 = { type = "mass", at = "a", mass = "2 kg" }
k1 = { type = "spring", between = ["a", "ground"], stiffness = "200 N/m" }
[nodes]
a = { position = "1 mm" }
[simulate]
stop = 1
output = { points = 11 }
record = ["a.position", "k1.force"]
"""


def resident():
    """Resident set of this process [bytes]."""
    words = pathlib.Path("/proc/self/status").read_text().split()
    return int(words[words.index("VmRSS:") + 1]) * 1024


def beyond_the_engine(call, times):
    """CPU time of a call beyond that of the engine, and of the engine [s]: medians."""
    beyond, engine = [], []
    for _ in range(times):
        start = time.thread_time()
        result = call()
        result["k1.force"]
        spent = time.thread_time() - start
        engine.append(result.summary["cpu_seconds"])
        beyond.append(spent - engine[-1])
    return statistics.median(beyond), statistics.median(engine)


def runs_in_a_second(scene, threads, times):
    with ThreadPoolExecutor(threads) as pool:
        start = time.perf_counter()
        for _ in pool.map(lambda _: scene.run(), range(times)):
            pass
        return times / (time.perf_counter() - start)


def process_seconds(program, times):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scene.toml"
        file.write_text(SCENE)
        spent = []
        for _ in range(times):
            start = time.perf_counter()
            subprocess.run([program, "run", "-q", str(file)], check=True, stdout=subprocess.DEVNULL)
            spent.append(time.perf_counter() - start)
        return statistics.median(spent)


def growth(scene, calls):
    """Growth of the resident set over `calls` runs [bytes]."""
    for _ in range(max(calls // 100, 10)):
        scene.run()["k1.force"]
    before = resident()
    for _ in range(calls):
        scene.run()["k1.force"]
    return resident() - before


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--calls", type=int, default=1_000_000, help="for the memory; a hundredth of them for each of the other figures")
    options.add_argument("--program", default="build/release/bin/rheonet")
    arguments = options.parse_args()
    few = max(arguments.calls // 100, 20)

    scene = rheonet.loads(SCENE)
    call, engine = beyond_the_engine(scene.run, few)
    stiffness = iter(range(100, 100 + few))
    changed, _ = beyond_the_engine(lambda: rheonet.loads(SCENE, {"k1.stiffness": next(stiffness)}).run(), few)
    rows = [
        ("engine alone", f"{engine * 1e6:.1f} us"),
        ("call, beyond the engine", f"{call * 1e6:.1f} us"),
        ("changed, beyond the engine", f"{changed * 1e6:.1f} us"),
        *((f"threads: {threads}", f"{runs_in_a_second(scene, threads, few * threads):.0f} runs/s") for threads in (1, 2)),
        ("process", f"{process_seconds(arguments.program, min(few, 50)) * 1e6:.0f} us"),
        (f"memory, {arguments.calls} calls", f"{growth(scene, arguments.calls) / 1024:.0f} KiB"),
    ]
    for name, value in rows:
        print(f"{name:<30}{value:>16}")


if __name__ == "__main__":
    sys.exit(main())
