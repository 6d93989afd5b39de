"""Reading netlists and running them: against closed forms, and against the command."""

import csv
import os
import pathlib
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import rheonet

m, k, x0 = 2.0, 200.0, 1e-3  # kg, N/m, m: omega = 10 rad/s
OSCILLATOR = {
    "title": "An oscillator",
    "nodes": {"a": {"position": x0}},
    "elements": {
        "m1": {"type": "mass", "at": "a", "mass": m},
        "k1": {"type": "spring", "between": ["a", "ground"], "stiffness": "200 N/m"},
    },
    "simulate": {"stop": 2, "accuracy": 1e-9, "output": {"every": "10 ms"}, "record": ["a.position", "k1.force"]},
}
# 1 mm of motion, of which the spring takes 0.5 mm before the slider slips at 0.1 N.
FRICTION = """
[elements]
drive = { type = "motion", at = "a", position = { sine = "1 mm", frequency = "1 Hz" } }
k1 = { type = "spring", between = ["a", "b"], stiffness = "200 N/m" }
s1 = { type = "slider", between = ["b", "ground"], coulomb = "0.1 N" }
[simulate]
stop = 2
output = { points = 401 }
record = ["a.position", "s1.force", "s1.velocity"]
[expect]
"s1.force" = { max = "0.1 N" }
"""


def endless(tables={}, record=["a.position"]):
    simulate = {"stop": 1e7, "accuracy": 1e-9, "output": {"every": 1e6}, "method": "ida", "record": record}
    return rheonet.load({**OSCILLATOR, "simulate": simulate, **tables})


def test_an_oscillator_follows_its_closed_form():
    scene = rheonet.load(OSCILLATOR)
    result = scene.run()
    omega = np.sqrt(k / m)
    assert result.time.shape == (201,)
    np.testing.assert_allclose(result["a.position"], x0 * np.cos(omega * result.time), atol=1e-9 * x0)
    np.testing.assert_allclose(result["k1.force"], k * x0 * np.cos(omega * result.time), atol=1e-9 * k * x0)
    assert (scene.title, scene.start, scene.stop, scene.accuracy) == ("An oscillator", 0, 2, 1e-9)
    assert len(result) == 2 and "k1.force" in result and "k1.power" not in result
    assert result.names == scene.names == list(result) == ["a.position", "k1.force"]
    assert result.units == scene.units == {"a.position": "m", "k1.force": "N"}


def test_changes_are_in_si_or_with_a_unit():
    for stiffness in (800, np.float32(800), "800", "0.8 N/mm"):
        result = rheonet.load(OSCILLATOR, {"k1.stiffness": stiffness}).run()
        np.testing.assert_allclose(result["a.position"], x0 * np.cos(20 * result.time), atol=1e-9 * x0)


def test_rows_and_events_are_those_of_the_command(tmp_path):
    file = tmp_path / "friction.toml"
    file.write_text(FRICTION)
    subprocess.run([os.environ["RHEONET"], "run", "-q", file, "--set", "k1.stiffness=300 N/m", "-o", tmp_path / "rows.csv", "--events", tmp_path / "events.csv"], check=True)
    result = rheonet.load(file, {"k1.stiffness": "300 N/m"}).run()
    with open(tmp_path / "rows.csv") as rows:
        header, *lines = csv.reader(rows)
    assert header == ["time", *result.names]
    assert np.array_equal(np.array(lines, float).T, [result.time, *(result[name] for name in result)])
    with open(tmp_path / "events.csv") as rows:
        _, *lines = csv.reader(rows)
    assert [(float(t), element, what, int(direction)) for t, element, what, direction in lines] == result.events
    # The spring reaches 0.1 N at 1/3 mm = sin(2 pi t) mm.
    assert result.events[0].element == "s1" and result.events[0].event == "slip" and result.events[0].direction == 1
    assert result.events[0].time == pytest.approx(np.arcsin(1 / 3) / (2 * np.pi), rel=1e-6)


def test_the_summary_has_the_energy_account_and_the_claims():
    summary = rheonet.loads(FRICTION).run().summary
    # The slider moves by 0.5 mm in the first quarter, by 1 mm in each of three reversals, and not in the last quarter.
    assert summary["energy_dissipated"] == pytest.approx(0.1 * 3.5e-3, rel=1e-5)
    assert summary["energy_supplied"] == pytest.approx(summary["energy_stored"] + summary["energy_dissipated"], abs=1e-9)
    assert summary["events"] == sum(summary["switched"].values()) > 0
    (claim,) = summary["claims"]
    assert claim["name"] == "largest s1.force" and claim["holds"] and claim["unit"] == "N"
    assert claim["found"] == pytest.approx(0.1, abs=1e-6)


def test_arrays_are_views_that_keep_the_result_alive():
    result = rheonet.load(OSCILLATOR).run()
    force = result["k1.force"]
    assert np.shares_memory(force, result["k1.force"]) and np.shares_memory(result.time, result.time)
    assert not np.shares_memory(force, result["a.position"])
    assert not force.flags.owndata and force.flags.c_contiguous
    with pytest.raises(ValueError, match="read-only"):
        force[0] = 1
    del result
    assert force[0] == pytest.approx(k * x0)
    with pytest.raises(KeyError, match="k1.power.*was not recorded"):
        rheonet.load(OSCILLATOR).run()["k1.power"]


def test_a_mistake_has_its_place_and_a_hint(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text(FRICTION.replace("coulomb", "colomb").replace('"spring"', '"sprong"'))
    with pytest.raises(rheonet.NetlistError) as caught:
        rheonet.load(file)
    error = caught.value
    assert (error.file, error.line, error.column) == (str(file), 4, 15)
    assert "sprong" in error.message and "spring" in error.hint
    assert [d.line for d in error.diagnostics if d.severity == "error"][:2] == [4, 5]
    printed = subprocess.run([os.environ["RHEONET"], "check", file], capture_output=True, text=True).stderr
    assert all(line in printed for line in str(error).splitlines())
    assert isinstance(error, ValueError)


@pytest.mark.parametrize("changes, said", [({"k1.stifness": 3}, "did you mean `stiffness`"), ({"k1.stiffness": "3 kg"}, "k1.stiffness=3 kg")])
def test_a_mistaken_change_is_shown(changes, said):
    with pytest.raises(rheonet.NetlistError, match=said) as caught:
        rheonet.load(OSCILLATOR, changes)
    assert caught.value.file is None and caught.value.line is None


def test_a_missing_file_and_other_bad_use():
    with pytest.raises(rheonet.NetlistError, match="nowhere.toml"):
        rheonet.load("nowhere.toml")
    with pytest.raises(TypeError, match="a netlist holds"):
        rheonet.load({"elements": {"k1": {1, 2}}})
    scene = rheonet.load(OSCILLATOR)
    for wrong in ({"accuracy": 0.5}, {"accuracy": 1e-13}, {"threads": 0}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            scene.run(**wrong)
    with pytest.raises(TypeError, match="progress must be a function"):
        scene.run(progress=3)
    assert len(scene.run(accuracy=0.1).time) == len(scene.run(accuracy=1e-12).time) == 201


def test_a_scene_that_cannot_start():
    # Two motions move one node: no state agrees with both.
    scene = rheonet.loads(FRICTION.replace("[simulate]", 'other = { type = "motion", at = "a", velocity = 1 }\n[simulate]'))
    with pytest.raises(rheonet.SimulationError, match="other") as caught:
        scene.run()
    assert isinstance(caught.value, RuntimeError) and len(caught.value.result.time) == 0
    with pytest.raises(rheonet.SimulationError, match="other"):
        scene.explain()


def test_a_run_that_ends_early_keeps_its_rows():
    scene = rheonet.loads("""[elements]
pull = { type = "force", at = "b", force = { ramp = "1 N/s" } }
s1 = { type = "slider", between = ["b", "ground"], coulomb = "0.5 N" }
[simulate]
stop = 1
output = { every = "0.2 s" }
record = ["s1.force"]
""")
    with pytest.raises(rheonet.SimulationError, match="0.5 s.*`s1` is at the largest force") as caught:
        scene.run()
    assert (caught.value.file, caught.value.line) == ("<text>", 2)
    np.testing.assert_allclose(caught.value.result.time, [0, 0.2, 0.4])
    np.testing.assert_allclose(caught.value.result["s1.force"], [0, 0.2, 0.4])


def test_warnings_are_issued():
    with pytest.warns(rheonet.NetlistWarning):
        scene = rheonet.loads(FRICTION.replace("[simulate]", 'k2 = { type = "spring", between = ["a", "loose"], stiffness = 1 }\n[simulate]'))
    assert "loose" in scene.warnings[0].message
    assert scene.warnings[0].severity == "warning"


def test_accuracy_and_certificate():
    scene = rheonet.load(OSCILLATOR, {"simulate.method": "ida"})
    exact = x0 * np.cos(10 * scene.run().time)
    error = {a: np.abs(scene.run(accuracy=a)["a.position"] - exact).max() / x0 for a in (1e-3, 1e-9)}
    assert error[1e-9] < 1e-9 < 1e-7 < error[1e-3]
    certificate = scene.run(accuracy=1e-6, certify=True).certificate
    assert certificate["holds"] and certificate["runs"] >= 2
    assert 0 < certificate["errors"]["a.position"]["relative"] < 1e-6
    assert scene.run().certificate is None


def test_progress_of_independent_parts_is_that_of_all():
    seen = []
    parts = {f"c{name}": {"type": "dashpot", "between": [name, "ground"], "damping": 1} for name in "ab"}
    parts |= {f"f{name}": {"type": "force", "at": name, "force": {"chirp": 1, "frequency": "0 Hz", "end_frequency": "100 Hz", "duration": 500}} for name in "ab"}
    scene = rheonet.load({"elements": parts, "simulate": {"stop": 500, "output": {"points": 11}, "record": ["a.position", "b.position"]}})
    scene.run(progress=seen.append)
    assert len(seen) > 1 and seen == sorted(seen) and seen[-1] == 1


def test_progress_rises_and_may_end_the_run():
    seen = []

    def progress(fraction):
        seen.append(fraction)
        if len(seen) == 5:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        endless().run(progress=progress)
    assert seen == sorted(seen) and 0 <= seen[0] <= seen[-1] < 1


@pytest.mark.parametrize("settings", [{}, {"certify": True}, {"threads": 2}])
def test_ctrl_c_ends_a_run(settings):
    # With 2 threads, one part ends soon; the other one is endless.
    short = {"k2": {"type": "spring", "between": ["b", "ground"], "stiffness": 1}, "m2": {"type": "mass", "at": "b", "mass": 1e12}}
    tables = {"nodes": {"a": {"position": x0}, "b": {"position": x0}}, "elements": {**OSCILLATOR["elements"], **short}}
    scene = endless(tables, ["a.position", "b.position"])
    threading.Timer(0.2, signal.raise_signal, [signal.SIGINT]).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        scene.run(**settings)
    assert time.monotonic() - began < 10


def test_other_python_threads_go_on_during_a_run():
    enough = threading.Event()

    def progress(_):
        if enough.is_set():
            raise LookupError

    def run():
        with pytest.raises(LookupError):
            endless().run(progress=progress)

    thread = threading.Thread(target=run)
    thread.start()
    enough.set()  # never reached if the run kept the interpreter lock
    thread.join(timeout=60)
    assert not thread.is_alive()


def test_runs_in_several_threads_have_the_same_rows():
    scene = rheonet.loads(FRICTION)
    expected = scene.run()["s1.force"]
    results = []
    threads = [threading.Thread(target=lambda: results.extend(scene.run() for _ in range(20))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 80 and all(np.array_equal(result["s1.force"], expected) for result in results)


def test_many_calls_leave_no_memory_behind():
    def resident():  # [bytes]
        return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    scene = rheonet.loads(FRICTION)

    def calls(count):
        for i in range(count):
            result = scene.run()
            result["s1.force"], result.time, result.events, result.summary
            if i % 10 == 0:
                rheonet.load(OSCILLATOR)
                with pytest.raises(rheonet.NetlistError):
                    rheonet.load(OSCILLATOR, {"k1.stifness": 1})

    calls(500)
    before = resident()
    calls(2000)
    # One row of 4 numbers that is left behind in each call would be 60 kB, a result 26 MB.
    assert resident() - before < 4e6
