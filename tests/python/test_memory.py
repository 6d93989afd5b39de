"""The memory of the command `rheonet` does not grow with the rows and the runs."""

import os
import subprocess
import sys

import pytest

RHEONET = os.environ["RHEONET"]

# In a small process of its own: until the command begins, its memory counts as that of the process that starts it.
MEASURE = """
import os, sys
_, status, usage = os.wait4(os.spawnv(os.P_NOWAIT, sys.argv[1], sys.argv[1:]), 0)
print(usage.ru_maxrss * 1024, os.waitstatus_to_exitcode(status))
"""
GROWTH = 3e6  # bytes; the memory of the same command varies by some 0.5 MB

SCENE = """
[elements]
m1 = { type = "mass", at = "a", mass = "1 kg" }
k1 = { type = "spring", between = ["a", "ground"], stiffness = "100 N/m" }
[nodes]
a = { position = "1 mm" }
[simulate]
stop = "1 s"
output = { every = "10 us" }
record = ["k1.force"]
"""


@pytest.fixture
def peak(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)

    def measure(*words, status=0):
        command = [sys.executable, "-I", "-S", "-c", MEASURE, RHEONET, *words, *([] if words[0] == "precision" else ["-q"])]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        if "part of rheonet that is missing" in done.stderr:
            pytest.skip(done.stderr)
        peak, found = map(int, done.stdout.split()[-2:])
        assert found == status, done.stderr
        return peak  # bytes

    measure.folder = tmp_path
    return measure


def length(seconds):
    return ["--set", f"simulate.stop={seconds} s"]


@pytest.mark.parametrize("ending", ["csv", "nc", "mat"])
def test_rows_of_a_run(peak, ending):
    short, long = (peak("run", "scene.toml", *length(seconds), "-o", f"rows.{ending}") for seconds in (1, 8))
    assert long - short < GROWTH  # a column of the long run has 6 MB


@pytest.mark.parametrize("option", [["--certify"], ["--sensitivities", "k1.stiffness,m1.mass"]])
def test_rows_that_wait_for_other_runs(peak, option):
    short, long = (peak("run", "scene.toml", *length(seconds), *option, "-o", "rows.csv") for seconds in (1, 6))
    assert long - short < GROWTH  # a column of one of the long runs has 5 MB


def test_rows_of_a_price_list(peak):
    def priced(seconds):
        return peak("precision", "scene.toml", *length(seconds), "--accuracies", "1e-4", "--runs", "1")

    assert priced(6) - priced(1) < GROWTH  # a column of one of the long runs has 5 MB


@pytest.mark.parametrize("ending", ["csv", "nc", "mat"])
def test_rows_of_a_sweep(peak, ending):
    short, long = (
        peak("sweep", "scene.toml", "--vary", "k1.stiffness=100,200,300", *length(seconds), "-o", f"rows.{ending}") for seconds in (0.5, 3)
    )
    assert long - short < GROWTH  # a run has 12 MB as text


def test_a_sweep_that_is_resumed_in_a_long_run(peak):
    sweep = ["sweep", "scene.toml", "--vary", "k1.stiffness=100,200", *length(4), "-o", "rows.csv"]
    peak(*sweep)
    whole = (peak.folder / "rows.csv").read_bytes()
    (peak.folder / "rows.csv").write_bytes(whole[: len(whole) // 2 - 1000])
    resumed = peak(*sweep, "--resume")
    assert (peak.folder / "rows.csv").read_bytes() == whole
    assert resumed - peak(*sweep[:4], "-o", "short.csv", *length(0.01)) < GROWTH  # a run has 16 MB as text


def test_points_of_a_list(peak):
    def shard_of(points):
        (peak.folder / "list.csv").write_text("k1.stiffness [N/m],m1.mass\n" + "".join(f"{100 + 1e-4 * k},1\n" for k in range(points)))
        return peak("sweep", "scene.toml", "--list", "list.csv", *length(0.001), "--measure", "max(k1.force)", "--shard", f"1/{points}", "-o", "shard.csv")

    assert shard_of(200_000) - shard_of(100) < GROWTH


@pytest.mark.parametrize("ending", ["nc", "mat"])
def test_errors_of_a_table(peak, ending):
    def failing(runs):
        return peak("sweep", "scene.toml", "--vary", "k1.stiffness=uniform(-2, -1)", "--random", f"{runs}", "--measure", "max(k1.force)",
                    "-o", f"rows.{ending}", status=1)  # fmt: skip

    assert failing(80_000) - failing(20_000) < GROWTH


def test_a_temporary_file_that_cannot_be_written_is_named(peak, tmp_path):
    command = [RHEONET, "sweep", "scene.toml", "--vary", "k1.stiffness=100,200", *length(1), "-q", "-o", "rows.csv"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env={**os.environ, "TMPDIR": "/proc"})
    assert done.returncode == 1
    assert "the rows of a sweep cannot be written to a temporary file in `/proc`" in done.stderr
    assert "TMPDIR names another folder" in done.stderr
    done = subprocess.run([*command, "--resume"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "rows.csv").read_text().count("\n") == 200_003


@pytest.mark.parametrize("option", [["--certify"], ["--sensitivities", "k1.stiffness"]])
def test_rows_that_cannot_wait_leave_the_earlier_file(peak, tmp_path, option):
    (tmp_path / "rows.csv").write_text("earlier\n")
    command = [RHEONET, "run", "scene.toml", *length(1), *option, "-q", "-o", "rows.csv"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env={**os.environ, "TMPDIR": "/proc"})
    assert done.returncode == 1
    assert "the rows of a run cannot be written to a temporary file in `/proc`" in done.stderr
    assert (tmp_path / "rows.csv").read_text() == "earlier\n"


SAMPLE = """
import resource, sys, warnings
import rheonet
warnings.simplefilter("ignore")
scene = rheonet.load("scene.toml", {"simulate.output": {"points": 2}, "simulate.stop": "1 ms"})
# one run in ten thousand fails, for want of a mass above 0
values = {"k1.stiffness": "normal(100 N/m, 5 %)", "m1.mass": "uniform(-0.0001 kg, 1 kg)"}
found = scene.sample(values, int(sys.argv[1]), ["max(k1.force)"], kind="latin")
assert found.error.dtype == object and 0 < (found.error != "").sum() < 5
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
"""


def test_runs_of_a_sample_in_python(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)

    def peak(runs):
        return int(subprocess.run([sys.executable, "-c", SAMPLE, str(runs)], cwd=tmp_path, check=True, capture_output=True, text=True).stdout)

    assert peak(30_000) - peak(10_000) < 20_000 * 100 + GROWTH  # 40 bytes a run are the result
