#!/usr/bin/python3
"""What a Monte Carlo costs beside its runs: a mass that sticks and slips, 25 slips in 30 s, about 1 ms of CPU time a run.

    tools/bench/monte_carlo.py [--runs N] [--program build/release/bin/rheonet]

The force at which the slider breaks away is lognormal. The largest force of the spring follows from it in closed form: from the moment of
breaking away the force is Fc + (Fs - Fc) cos(w t) + (k v / w) sin(w t), with w^2 = k/m, until the mass sticks again. Prints a table:

  beyond     CPU time of the whole process less that of the simulations, as a share of the latter
  memory     largest resident set, for a hundredth of the runs and for all of them
  quantiles  each from the runs, with its interval of 95 %, beside the closed form
"""

import argparse
import json
import math
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile

K, M, V, COULOMB, MEDIAN, DEVIATION = 10.0, 1.0, 0.1, 1.0, 1.5, 0.05
SCENE = f"""
title = "Stick-slip"
[elements]
belt = {{ type = "motion", at = "belt", velocity = "{V} m/s" }}
k = {{ type = "spring", between = ["belt", "m"], stiffness = "{K} N/m" }}
m = {{ type = "mass", at = "m", mass = "{M} kg" }}
f = {{ type = "slider", between = ["m", "ground"], coulomb = "{COULOMB} N", breakaway = "{MEDIAN} N" }}
[simulate]
stop = "30 s"
output = {{ points = 101 }}
record = ["k.force"]
"""


def closed_form(probability):
    """Quantile of the largest force of the spring [N]."""
    breakaway = MEDIAN * math.exp(DEVIATION * statistics.NormalDist().inv_cdf(probability))
    return COULOMB + math.hypot(breakaway - COULOMB, V * math.sqrt(K * M))


def seconds(text):
    """The value [s] of "120.0 ms" or "2 min 5 s"."""
    units = {"us": 1e-6, "ms": 1e-3, "s": 1, "min": 60}
    words = text.split()
    return sum(float(number) * units[unit] for number, unit in zip(words[::2], words[1::2]))


def sweep(program, folder, runs):
    """CPU time of the process and of the simulations [s], largest resident set [bytes], the statistics."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "sweep", "scene.toml", "--vary", f"f.breakaway=lognormal({MEDIAN} N, {DEVIATION})", "--random", str(runs),
                           "--measure", "max(k.force)", "--statistics", "statistics.json", "-o", "rows.csv"],
                          cwd=folder, check=True, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    inside = seconds(re.search(r"  ([\d.]+ \w+(?: \d+ s)?) in the simulations", done.stdout + done.stderr).group(1))
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return spent, inside, after.ru_maxrss * 1024, json.loads((folder / "statistics.json").read_text())["measures"][0]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--runs", type=int, default=1_000_000)
    options.add_argument("--program", default="build/release/bin/rheonet")
    arguments = options.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.toml").write_text(SCENE)
        few = max(arguments.runs // 100, 100)
        memory = {few: sweep(program, folder, few)[2]}  # The fewer runs come first: the largest resident set of all children is kept.
        spent, inside, memory[arguments.runs], measure = sweep(program, folder, arguments.runs)
    print(f"{arguments.runs} runs: {1e3 * inside / arguments.runs:.3f} ms a run, {100 * (spent / inside - 1):.1f} % beyond the runs")
    for runs, size in memory.items():
        print(f"memory, {runs} runs: {size / 2**20:.1f} MiB")
    for quantile in measure["quantiles"]:
        exact = closed_form(quantile["probability"])
        within = quantile["from"] <= exact <= quantile["to"]
        print(f"quantile {quantile['probability']:<5g} {quantile['value']:.6f} N in [{quantile['from']:.6f}, {quantile['to']:.6f}], "
              f"closed form {exact:.6f} N{'' if within else ': outside'}")


if __name__ == "__main__":
    sys.exit(main())
