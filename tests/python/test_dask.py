"""Sweeps on a Dask cluster, on this host alone: against sweeps in threads."""

import os
import signal
import threading
import time

import pytest

import rheonet

distributed = pytest.importorskip("distributed", reason="Dask is missing (Debian: python3-distributed)")

SCENE = """
title = "let go"
include = ["spring.toml"]
[elements]
m1 = { type = "mass", at = "a", mass = "2 kg" }
k1 = { type = "soft", between = ["a", "ground"] }
[nodes]
a = { position = "1 mm" }
[simulate]
stop = 1
record = ["a.position"]
"""
MODEL = """
[models.soft]
ports = ["a", "b"]
parameters = { k = "200 N/m" }
[models.soft.elements]
s = { type = "spring", between = ["a", "b"], stiffness = "k" }
"""
VALUES = {"k1.k": [50 + k for k in range(400)], "m1.mass": ["1 kg", "2 kg"]}


@pytest.fixture(scope="module")
def cluster():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, protocol="tcp://") as cluster:
        with distributed.Client(cluster) as client:
            yield client


@pytest.fixture
def scene(tmp_path, monkeypatch):
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "spring.toml").write_text(MODEL)
    monkeypatch.chdir(tmp_path)
    return rheonet.load("scene.toml", {"simulate.stop": 2})


def test_measures_are_those_of_threads(cluster, scene):
    measures = ["min(a.position)", "time of min(a.position)"]
    assert scene.sweep(VALUES, measures, client=cluster).identical(scene.sweep(VALUES, measures))


def test_rows_are_those_of_threads(cluster, scene):
    few = {"k1.k": VALUES["k1.k"][:30]}
    assert scene.sweep(few, client=cluster).identical(scene.sweep(few))
    text = rheonet.loads(SCENE)
    assert text.sweep(few, client=cluster).identical(text.sweep(few))


def test_a_killed_worker_loses_nothing(cluster, scene):
    def kill():
        time.sleep(0.3)
        os.kill(pids[0], signal.SIGKILL)

    pids = list(cluster.run(os.getpid).values())
    killer = threading.Thread(target=kill)
    expected = scene.sweep(VALUES, "min(a.position)")
    killer.start()
    found = scene.sweep(VALUES, "min(a.position)", client=cluster)
    killer.join()
    assert found.identical(expected)


@pytest.mark.parametrize("tasks", [1, 7, 64])
def test_the_number_of_tasks_does_not_matter_and_a_killed_one_is_done_again(cluster, scene, tmp_path, monkeypatch, tasks):
    def group(items, function):  # that of rheonet, but the middle task ends with its worker when it is begun for the first time
        results = [function(item) for item in items]
        if middle in items:
            try:
                os.mkdir(folder)
                os.kill(os.getpid(), signal.SIGKILL)
            except FileExistsError:
                pass
        return results

    values = {"k1.k": [50 + k for k in range(1 + 7 * 64)]}  # the first run is simulated here
    middle, folder = (50 + 7 * 32,), str(tmp_path / "killed")
    monkeypatch.setattr(rheonet._parallel, "TASK_COST", 0)
    monkeypatch.setattr(rheonet._parallel, "SCHEDULED_AT_ONCE", tasks)
    monkeypatch.setattr(rheonet._parallel, "_group", group)
    sent = []
    original = cluster.map
    monkeypatch.setattr(cluster, "map", lambda task, groups, **options: sent.extend(groups) or original(task, groups, **options))
    found = scene.sweep(values, "min(a.position)", client=cluster)
    assert len(sent) == tasks and os.path.isdir(folder)
    assert found.identical(scene.sweep(values, "min(a.position)"))


def test_an_error_says_which_run(cluster, scene):
    with pytest.raises(rheonet.NetlistError) as error:
        scene.sweep({"k1.k": [100, 200, -3]}, "min(a.position)", client=cluster, on_error="raise")
    assert "in the run with {'k1.k': -3}" in error.value.__notes__
    assert "must be" in error.value.message


def test_a_failed_run_is_that_of_threads(cluster, scene):
    for measure in (None, "min(a.position)"):
        with pytest.warns(RuntimeWarning, match="1 of 3 runs failed"):
            found = scene.sweep({"k1.k": [100, -3, 200]}, measure, client=cluster)
        with pytest.warns(RuntimeWarning, match="1 of 3 runs failed"):
            assert found.identical(scene.sweep({"k1.k": [100, -3, 200]}, measure))


def test_files_are_those_that_were_loaded(cluster, scene, tmp_path):
    expected = scene.sweep(VALUES, "min(a.position)")
    (tmp_path / "scene.toml").write_text(SCENE.replace("1 mm", "2 mm"))
    (tmp_path / "spring.toml").write_text("")
    assert scene.sweep(VALUES, "min(a.position)", client=cluster).identical(expected)
    assert cluster.submit(lambda scene: float(scene.run()["a.position"].min()), scene).result() == scene.run()["a.position"].min()


def test_a_client_that_is_none(scene):
    with pytest.raises(TypeError, match="client must be a dask.distributed.Client, but is 3"):
        scene.sweep(VALUES, "min(a.position)", client=3)
