"""Scenes, results and errors in other processes, and copies of them."""

import copy
import multiprocessing
import pickle
import shutil

import numpy as np
import pytest

import rheonet
from test_dask import MODEL, SCENE
from test_scene import FRICTION, OSCILLATOR


def again(value):
    return pickle.loads(pickle.dumps(value))


def test_a_scene_has_the_files_that_were_loaded(tmp_path, monkeypatch):
    folder = tmp_path / "scene"
    folder.mkdir()
    (folder / "scene.toml").write_text(SCENE)
    (folder / "spring.toml").write_text(MODEL)
    monkeypatch.chdir(tmp_path)
    scene = rheonet.load("scene/scene.toml", {"m1.mass": "3 kg"})
    expected = scene.run()["a.position"].copy()
    (folder / "scene.toml").write_text(SCENE.replace("2 kg", "1 kg"))
    (folder / "spring.toml").write_text("no netlist")
    monkeypatch.chdir("/")
    assert np.array_equal(again(scene).run()["a.position"], expected)
    shutil.rmtree(folder)
    other = again(again(scene))
    assert np.array_equal(other.run()["a.position"], expected) and other.title == "let go"
    assert other.sweep({"k1.k": [100, 300]}, "min(a.position)").identical(scene.sweep({"k1.k": [100, 300]}, "min(a.position)"))


def test_a_scene_of_text_or_a_dictionary():
    for scene in (rheonet.loads(FRICTION), rheonet.load(OSCILLATOR, {"m1.mass": 3})):
        record = scene.names[0]
        assert np.array_equal(again(scene).run()[record], scene.run()[record])
        assert copy.copy(scene) is scene and copy.deepcopy([scene])[0] is scene


def test_a_result():
    result = rheonet.loads(FRICTION).run(certify=True)
    for other in (again(result), copy.deepcopy(result), copy.copy(result)):
        assert list(other) == list(result) and all(np.array_equal(other[name], result[name]) for name in result)
        assert not other["s1.force"].flags.writeable
        assert np.array_equal(other.time, result.time) and other.units == result.units
        assert other.events == result.events and other.summary == result.summary and other.certificate == result.certificate
        assert other.plot("s1.force").svg == result.plot("s1.force").svg
        assert other.to_xarray().identical(result.to_xarray())
        assert other.scene.run().time[-1] == 2


def fail(kind):
    if kind == "netlist":
        rheonet.loads(FRICTION, {"s1.colomb": 1})
    rheonet.loads(CLASH).run()


CLASH = """
[elements]
a = { type = "motion", at = "n", position = 1 }
b = { type = "motion", at = "n", position = 2 }
[simulate]
stop = 1
"""


@pytest.mark.parametrize(("kind", "error"), [("netlist", rheonet.NetlistError), ("simulation", rheonet.SimulationError)])
def test_errors_of_another_process(kind, error):
    with pytest.raises(error) as here:
        fail(kind)
    with multiprocessing.get_context("spawn").Pool(1) as pool, pytest.raises(error) as there:
        pool.map(fail, [kind])
    assert str(there.value) == str(here.value) and there.value.diagnostics == here.value.diagnostics
    for field in ("file", "line", "column", "message", "hint"):
        assert getattr(there.value, field) == getattr(here.value, field)


def test_an_error_of_a_run_that_ended_early_has_its_rows():
    # A force that grows without bound: the run cannot reach its end.
    text = """
[elements]
m = { type = "mass", at = "n", mass = 1 }
k = { type = "spring", between = ["n", "ground"], force = "-q*d^3" }
[parameters]
q = "1 N/m^3"
[nodes]
n = { position = 1 }
[simulate]
stop = 50
output = { every = 0.001 }
record = ["n.position"]
"""
    with pytest.raises(rheonet.SimulationError) as caught:
        rheonet.loads(text).run()
    caught.value.add_note("a note")
    other = again(caught.value)
    assert other.message == caught.value.message and other.__notes__ == ["a note"]
    assert len(other.result.time) > 1 and np.array_equal(other.result["n.position"], caught.value.result["n.position"])


def test_studies_say_what_to_use_instead():
    scene = rheonet.loads(FRICTION)
    with pytest.raises(TypeError, match=r"a Comparison cannot be pickled or copied: use what its to_xarray\(\) or to_dataframe\(\) returns"):
        pickle.dumps(scene.compare(scene))
    figure = again(scene.plot("s1.force"))
    assert figure.svg == scene.plot("s1.force").svg


def test_a_change_that_is_changed_later():
    table = np.array([[0, 0], [1, 0.001], [2, 0]])
    points = [[0, 0], [1, 0.001], [2, 0]]
    for value in (table, points):
        changes = {"drive.position": {"table": value}}
        scene = rheonet.loads(FRICTION, changes)
        expected = scene.run()["a.position"].max()
        value[1][1] = 0.002
        changes["s1.coulomb"] = 7
        assert scene.sweep({"k1.stiffness": [100]}, "max(a.position)")["max(a.position)"] == pytest.approx(expected)
        assert scene.compare(rheonet.loads(FRICTION, changes)).furthest > 0.4
