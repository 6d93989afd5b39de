"""Data frames, data sets, sweeps, and what Jupyter shows."""

import base64
import fractions
import os
import re
import signal
import subprocess
import threading
import time
import tomllib
import xml.etree.ElementTree

import numpy as np
import pandas
import pytest

import rheonet
from test_scene import FRICTION, OSCILLATOR, endless, k, x0

SPRINGS = """
[elements]
m1 = { type = "mass", at = "a", mass = "2 kg" }
k1 = { type = "spring", between = ["a", "ground"], stiffness = "200 N/m" }
[nodes]
a = { position = "1 mm", velocity = "20 mm/s" }
[simulate]
stop = 2
output = { points = 2 }
record = ["k1.force"]
"""


def shown_svg(scene):
    return base64.b64decode(re.search("base64,([^\"]*)", scene._repr_html_())[1]).decode()


def test_a_data_frame():
    result = rheonet.load(OSCILLATOR).run()
    frame = result.to_dataframe()
    assert list(frame) == ["a.position", "k1.force"] and frame.index.name == "time"
    assert frame.attrs == {"title": "An oscillator", "units": {"a.position": "m", "k1.force": "N"}}
    assert np.array_equal(frame["k1.force"], result["k1.force"]) and np.array_equal(frame.index, result.time)


def test_a_data_set():
    result = rheonet.load(OSCILLATOR).run()
    data = result.to_xarray()
    assert dict(data.sizes) == {"time": 201} and data.attrs["title"] == "An oscillator"
    assert data["k1.force"].units == "N" and data.time.units == "s"
    assert np.shares_memory(data["k1.force"].values, result["k1.force"])


def test_a_sweep_has_the_parameters_as_coordinates():
    data = rheonet.load(OSCILLATOR).sweep({"k1.stiffness": ["200 N/m", "800 N/m"], "m1.mass": [0.5, 2, 8]})
    assert dict(data.sizes) == {"k1.stiffness": 2, "m1.mass": 3, "time": 201}
    assert data["k1.stiffness"].units == "N/m" and data["a.position"].units == "m"
    omega = np.sqrt(data["k1.stiffness"] / data["m1.mass"])
    np.testing.assert_allclose(data["a.position"], x0 * np.cos(omega * data.time), atol=2e-9 * x0)


def test_a_sweep_of_measures():
    data = rheonet.loads(FRICTION).sweep({"s1.coulomb": [0.05, 0.1, 0.4]}, measure=["max(s1.force)", "time of crossing(s1.force, 0.02 N)"])
    assert dict(data.sizes) == {"s1.coulomb": 3}
    # The spring carries at most 200 N/m times 1 mm.
    np.testing.assert_allclose(data["max(s1.force)"], [0.05, 0.1, 0.2], rtol=1e-5)
    assert data["max(s1.force)"].units == "N"
    np.testing.assert_allclose(data["time of crossing(s1.force, 0.02 N)"], np.arcsin(0.1) / (2 * np.pi), rtol=1e-5)


@pytest.mark.parametrize(
    ("values", "expected", "unit"),
    [
        (["1*Tc", "3/2*Tc"], ["1*Tc", "3/2*Tc"], None),
        (["Tc*0.5", "0.1 N"], ["Tc*0.5", "0.1 N"], None),
        (["10-2", "1/2", "2^-1", "1e-1*2"], [8, 0.5, 0.5, 0.2], None),
        (["3/2", 2, "0.25"], [1.5, 2, 0.25], None),
        (["1 N", "2.5 N"], [1, 2.5], "N"),
        (["1 N", "10 cN"], ["1 N", "10 cN"], None),
        (["1 N", 2], ["1 N", "2"], None),
    ],
)
def test_coordinates_are_the_values_of_the_runs(values, expected, unit):
    text = FRICTION.replace('"0.1 N" }\n[sim', '"Tc" }\n[parameters]\nTc = "0.07 N"\n[sim')
    data = rheonet.loads(text, {"k1.stiffness": 1e5}).sweep({"s1.coulomb": values}, "max(s1.force)")
    assert data["s1.coulomb"].values.tolist() == expected and data["s1.coulomb"].attrs.get("units") == unit
    if not isinstance(expected[0], str):
        np.testing.assert_allclose(data["max(s1.force)"], expected, rtol=1e-4)


def test_a_sweep_keeps_to_the_file_that_was_loaded(tmp_path):
    file = tmp_path / "friction.toml"
    file.write_text(FRICTION)
    scene = rheonet.load(file, {"s1.coulomb": 0.05})
    file.write_text(FRICTION.replace("1 mm", "0.1 mm"))
    data = scene.sweep({"k1.stiffness": [100, 200]}, measure="max(s1.force)")
    np.testing.assert_allclose(data["max(s1.force)"], 0.05, rtol=1e-5)  # 0.02 N with the other motion


def test_a_varied_value_comes_after_the_changes_of_load():
    expected = rheonet.loads(FRICTION).sweep({"s1.coulomb": [0.05, 0.1]}, "max(s1.force)")
    scene = rheonet.loads(FRICTION, {"s1.coulomb": 0.02, "s1.coulomb*": 2})
    assert scene.sweep({"s1.coulomb": [0.05, 0.1]}, "max(s1.force)").identical(expected)


def test_a_run_without_the_measure_leaves_the_others():
    scene, measure = rheonet.load(OSCILLATOR), "value(k1.force, 0.5 s)"
    with pytest.warns(RuntimeWarning, match="1 of 2 runs failed"):
        data = scene.sweep({"simulate.stop": ["0.1 s", "2 s"]}, measure)
    assert np.isnan(data[measure][0]) and data[measure][1] == rheonet.load(OSCILLATOR).sweep({"simulate.stop": ["2 s"]}, measure)[measure][0]
    with pytest.raises(rheonet.NetlistError, match="nothing is called"):
        scene.sweep({"simulate.stop": ["0.1 s", "2 s"]}, "max(k2.force)")


@pytest.mark.parametrize("measure", [None, "max(k1.force)"])
def test_runs_with_other_units_are_told(measure):
    text = """[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 3 }
drive = { type = "motion", at = "a", velocity = 2 }
[simulate]
stop = 1
record = ["k1.force"]
"""
    with pytest.raises(ValueError, match="k1.force.* has the unit N"):
        rheonet.loads(text, {"domain": "translation"}).sweep({"domain": ["translation", "rotation"]}, measure)


def test_a_varied_signal_that_is_recorded(tmp_path):
    text = """[elements]
push = { type = "force", at = "a", force = 2 }
c1 = { type = "dashpot", between = ["a", "ground"], damping = 1 }
[simulate]
stop = 1
record = ["push.force"]
"""
    data = rheonet.loads(text).sweep({"push.force": ["3 N", "5 N"]})
    assert data["push.force"].values.tolist() == [3, 5] and data["push.force_"].long_name == "push.force"
    np.testing.assert_array_equal(data["push.force_"].values[:, -1], [3, 5])
    data.to_netcdf(tmp_path / "sweep.nc")


def test_values_that_are_no_floats():
    data = rheonet.loads(FRICTION).sweep({"k1.stiffness": [10**30, fractions.Fraction(1, 3)]}, "max(s1.force)")
    assert data["k1.stiffness"].dtype == float and data["k1.stiffness"].values.tolist() == [1e30, 1 / 3]
    with pytest.raises(ValueError, match="masked"):
        rheonet.loads(FRICTION).sweep({"k1.stiffness": np.ma.array([1, 2], mask=[0, 1])}, "max(s1.force)")
    for changes in ({"title": "\udc80"}, {"k1.stiffness": "\udc80"}, {"\udc80": 1}):
        with pytest.raises(ValueError, match="must be Unicode text"):
            rheonet.loads(FRICTION, changes)
    assert rheonet.load(tomllib.loads(FRICTION) | {"title": "a\x7fb"}).title == "a\x7fb"


def test_ctrl_c_ends_a_sweep():
    threading.Timer(0.3, signal.pthread_kill, [threading.get_ident(), signal.SIGINT]).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        endless().sweep({"k1.stiffness": range(100, 120)})
    assert time.monotonic() - began < 10


def test_bad_use_of_a_sweep():
    scene = rheonet.load(OSCILLATOR)
    with pytest.raises(rheonet.NetlistError, match="at least 0, but is -2 kg") as caught:
        scene.sweep({"m1.mass": [1, -2]}, on_error="raise")
    assert caught.value.__notes__ == ["in the run with {'m1.mass': -2}"]
    with pytest.raises(rheonet.NetlistError, match="colour"):
        scene.sweep({"k1.stiffness": [1, 2]}, measure="max(k1.colour)")
    with pytest.raises(ValueError, match="different times"):
        scene.sweep({"simulate.stop": [1, 2]})
    with pytest.raises(ValueError, match="have different records"):
        scene.sweep({"simulate.record": [["a.position"], ["k1.force"]]})
    with pytest.raises(ValueError, match="at least one value"):
        scene.sweep({"k1.stiffness": []})
    with pytest.raises(ValueError, match="on_error must be 'nan' or 'raise'"):
        scene.sweep({"k1.stiffness": [1]}, on_error="skip")


def test_a_failed_run_is_nan_and_says_why():
    scene = rheonet.load(OSCILLATOR)
    good = scene.sweep({"m1.mass": [1, 3], "k1.stiffness": [100, 200]})
    with pytest.warns(RuntimeWarning, match="2 of 6 runs failed, as the one with {'m1.mass': -2, 'k1.stiffness': 100}: `mass` must be at least 0") as warned:
        data = scene.sweep({"m1.mass": [1, -2, 3], "k1.stiffness": [100, 200]})
    assert warned[0].filename == __file__
    assert data["error"].dims == ("m1.mass", "k1.stiffness") and (data["error"].sel({"m1.mass": [1, 3]}) == "").all()
    assert all("at least 0, but is -2 kg" in reason for reason in data["error"].sel({"m1.mass": -2}).values)
    assert np.isnan(data["a.position"].sel({"m1.mass": -2})).all()
    assert data.drop_vars("error").sel({"m1.mass": [1, 3]}).identical(good)
    with pytest.warns(RuntimeWarning):
        peaks = scene.sweep({"m1.mass": [-2, 1, 3]}, "max(k1.force)")
    assert np.isnan(peaks["max(k1.force)"][0]) and peaks["max(k1.force)"].units == "N" and not np.isnan(peaks["max(k1.force)"][1:]).any()
    with pytest.warns(RuntimeWarning):
        drawn = scene.sample({"m1.mass": "-1 kg,2 kg"}, 16, "max(k1.force)")
    assert ((drawn["error"] != "") == (drawn["m1.mass"] < 0)).all() and (np.isnan(drawn["max(k1.force)"]) == (drawn["m1.mass"] < 0)).all()


def test_a_run_that_ends_early_is_nan():
    text = OSCILLATOR | {"elements": {**OSCILLATOR["elements"], "x": {"type": "motion", "at": "b", "position": 0.5}}}
    text["simulate"] = text["simulate"] | {"record": ["a.position", "x.force"]}
    scene = rheonet.load(text)
    with pytest.warns(RuntimeWarning, match="1 of 2 runs failed"):
        data = scene.sweep({"x.at": ["b", "a"]})  # a starts elsewhere than where x holds it
    assert np.isnan(data["a.position"].sel({"x.at": "a"})).all() and not np.isnan(data["a.position"].sel({"x.at": "b"})).any()


def test_what_concerns_all_runs_is_an_error_at_once():
    scene = rheonet.load(OSCILLATOR)
    for changes, measure in (({"m1.mas": [1, 2]}, None), ({"m1.mass": [-1, 1]}, "max(k1.colour)")):
        with pytest.raises(rheonet.NetlistError):
            scene.sweep(changes, measure)
    began = time.monotonic()
    with pytest.raises(rheonet.NetlistError):
        endless().sweep({"k1.stiffness": [200, 300, 400], "m2.mass": [1]})
    assert time.monotonic() - began < 10
    with pytest.raises(rheonet.NetlistError) as caught:
        scene.sweep({"m1.mass": [-1, -2, -3]})
    assert caught.value.__notes__ == ["in the run with {'m1.mass': -1}", "and all other runs of 3 failed as well"]


def test_tables_as_values_are_text_coordinates():
    scene = rheonet.loads(FRICTION)
    tables = [[[0, 0], [2, 0.001]], [[0, 0], [1, 0.002], [2, 0.003]]]
    data = scene.sweep({"drive.position": [{"table": table} for table in tables], "k1.stiffness": [100]}, "max(a.position)")
    assert data["drive.position"].values.tolist() == ['{ "table" = [[0, 0], [2, 0.001]] }', '{ "table" = [[0, 0], [1, 0.002], [2, 0.003]] }']
    np.testing.assert_allclose(data["max(a.position)"].values[:, 0], [0.001, 0.003])
    with pytest.raises(TypeError, match="a netlist holds numbers, text, lists and dictionaries"):
        endless().sweep({"k1.stiffness": [200, object()]})  # before any run


@pytest.mark.parametrize("name", ["scene", "title", "value", "error"])
def test_records_with_the_names_of_dimensions(name):
    scene = rheonet.loads(FRICTION.replace('"s1.velocity"]', f'{{ name = "{name}", value = "2*s1.force" }}]'))
    result = scene.run()
    np.testing.assert_array_equal(result.to_xarray()[name], result[name])
    compared = scene.compare(scene).to_xarray()
    np.testing.assert_array_equal(compared[name][1], compared[name][0])
    slopes = scene.sensitivities("s1.coulomb")
    np.testing.assert_array_equal(slopes.to_xarray()[name], slopes[name])
    with pytest.warns(RuntimeWarning):
        swept = scene.sweep({"s1.coulomb": [-1, "0.1 N"]})
    np.testing.assert_array_equal(swept[name][1], result[name])


def test_an_explanation_is_data():
    explained = rheonet.load(OSCILLATOR).explain()
    assert explained["title"] == "An oscillator"
    assert "m1" in next(effect["brought_by"] for effect in explained["effects"] if effect["effect"] == "inertia")


def test_jupyter_shows_schematic_and_table():
    scene = rheonet.load(OSCILLATOR)
    drawing = xml.etree.ElementTree.fromstring(shown_svg(scene))
    assert drawing.tag.endswith("svg") and "k1" in "".join(drawing.itertext())
    table = scene.run()._repr_html_()
    xml.etree.ElementTree.fromstring(table)
    assert "k1.force" in table and f"{k * x0:.6g}" in table
    assert repr(scene) == "<rheonet.Scene 'An oscillator': 2 records, 0 s to 2 s>"
    assert repr(scene.run()) == "<rheonet.Result 'An oscillator': 2 records, 201 rows>"


CHAIN = """
[elements]
drive = { type = "motion", at = "first", position = { sine = "1 mm", frequency = "1 Hz" } }
[elements.chain]
repeat = { count = 40000, as = "i", arrange = "series" }
type = "link"
between = ["first", "last"]
[models.link]
ports = ["a", "b"]
[models.link.elements]
k = { type = "spring", between = ["a", "b"], stiffness = "1000 N/m" }
c = { type = "dashpot", between = ["a", "b"], damping = "1 N*s/m" }
m = { type = "mass", at = "b", mass = "1 g" }
[simulate]
stop = 1
record = ["drive.force"]
"""


def test_a_long_chain_is_drawn_at_once():
    scene = rheonet.loads(CHAIN)
    began = time.process_time()
    assert scene._repr_html_() is not None
    assert time.process_time() - began < 4


def test_a_netlist_as_a_dictionary_points_to_the_entry():
    with pytest.raises(rheonet.NetlistError) as caught:
        rheonet.load({**OSCILLATOR, "elements": {**OSCILLATOR["elements"], "d1": {"type": "dashpod", "at": "ä \"quoted\"\\"}}})
    error = caught.value
    # Of the text: the title, [nodes] with one entry, [elements] with m1 and k1, then d1.
    assert (error.file, error.line) == ("<dictionary>", 7)
    assert "dashpot" in error.hint and '"d1" = { "type" = "dashpod"' in str(error)
    assert rheonet.load({**OSCILLATOR, "title": "Öl, \"heiß\" \\ 😀"}).title == "Öl, \"heiß\" \\ 😀"


def test_drawn_points_are_those_of_the_command(tmp_path):
    (tmp_path / "scene.toml").write_text(SPRINGS)
    vary = {"k1.stiffness": "normal(200 N/m, 5 %)", "m1.mass": "1 kg:2 kg:log"}
    words = [f"{path}={distribution}" for path, distribution in vary.items()]
    for kind, more in (("random", ["--correlate", "k1.stiffness,m1.mass=0.5"]), ("latin", []), ("sobol", [])):
        command = ["sweep", "scene.toml", "--vary", *words, f"--{kind}", "16", "--seed", "7", *more, "--measure", "max(k1.force)", "-q", "-o", "drawn.csv"]
        subprocess.run([os.environ["RHEONET"], *command], cwd=tmp_path, check=True)
        rows = pandas.read_csv(tmp_path / "drawn.csv", float_precision="round_trip")
        correlations = {("k1.stiffness", "m1.mass"): 0.5} if more else {}
        data = rheonet.loads(SPRINGS).sample(vary, 16, "max(k1.force)", kind=kind, seed=7, correlations=correlations)
        assert data.sizes == {"run": 16} and data["m1.mass"].units == "kg" and data["max(k1.force)"].units == "N"
        np.testing.assert_array_equal(data["k1.stiffness"], rows["k1.stiffness [N/m]"])
        np.testing.assert_array_equal(data["m1.mass"], rows["m1.mass [kg]"])
        np.testing.assert_array_equal(data["max(k1.force)"], rows["max(k1.force) [N]"])


def test_a_wrong_distribution_is_said():
    scene = rheonet.loads(SPRINGS)
    with pytest.raises(ValueError, match="gauss"):
        scene.sample({"k1.stiffness": "gauss(200, 5)"}, 4, "max(k1.force)")
    with pytest.raises(ValueError, match="'random', 'latin' or 'sobol'"):
        scene.sample({"k1.stiffness": "100:200"}, 4, "max(k1.force)", kind="halton")
    with pytest.raises(ValueError, match="at least one measure"):
        scene.sample({"k1.stiffness": "100:200"}, 4, [])
    with pytest.raises(ValueError, match="count must be at least 1"):
        scene.sample({"k1.stiffness": "100:200"}, 0, "max(k1.force)")
    with pytest.raises(rheonet.NetlistError, match="stifness"):
        scene.sample({"k1.stifness": "100:200"}, 2, "max(k1.force)")
