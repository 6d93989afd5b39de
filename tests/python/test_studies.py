"""compare, effects, precision, figures and reports: the same figures as those of the commands."""

import base64
import os
import subprocess

import numpy as np
import pandas
import pytest

import rheonet

SCENE = """
title = "Two pads"
[elements]
drive = { type = "motion", at = "a", position = { sine = "1 mm", frequency = "1 Hz" } }
k1 = { type = "spring", between = ["a", "b"], stiffness = "200 N/m" }
s1 = { type = "slider", between = ["b", "ground"], coulomb = "0.1 N" }
c1 = { type = "dashpot", between = ["a", "ground"], damping = "3 N*s/m" }
[simulate]
stop = 1.3
output = { points = 401 }
record = ["a.position", "s1.force", "k1.force"]
[expect]
"s1.force" = { max = "0.1 N" }
"""
OTHER = SCENE.replace("k1", "soft").replace("200 N/m", "150 N/m").replace("Two pads", "Softer pads")


@pytest.fixture
def scene(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pads.toml").write_text(SCENE)
    (tmp_path / "other.toml").write_text(OTHER)
    return rheonet.load("pads.toml")


def command(*words):
    done = subprocess.run([os.environ["RHEONET"], *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def csv(path):
    return pandas.read_csv(path, float_precision="round_trip", keep_default_na=False, na_values=[""])


def test_a_comparison_is_that_of_the_command(scene):
    printed = command("compare", "pads.toml", "other.toml", "--pair", "k1.force=soft.force", "--pair", "s1.force=s1.force", "-o", "rows.csv")
    found = scene.compare(rheonet.load("other.toml"), pairs={"k1.force": "soft.force", "s1.force": ["s1.force"]})
    assert str(found) == printed
    rows, data = csv("rows.csv"), found.to_xarray()
    assert (rows["time"] == data["time"].values).all()
    assert (rows["A.k1.force"] == data["k1.force"].sel(scene=0).values).all()
    assert (rows["B.soft.force"] == data["k1.force"].sel(scene=1).values).all()
    gap = np.abs(rows["A.k1.force"] - rows["B.soft.force"])
    (differences,) = found.differences
    assert differences["k1.force"].largest == gap.max() > 0
    assert differences["k1.force"].time == rows["time"][gap.argmax()]
    assert found.furthest == max(d.relative for d in differences.values())
    frame = found.to_dataframe()
    assert list(frame["record"]) == ["soft.force", "s1.force"] and frame.loc["k1.force", "largest"] == gap.max()
    assert found.units == {"k1.force": "N", "s1.force": "N"}


def test_scenes_of_three_lengths_are_compared_as_far_as_the_shortest_goes(scene):
    found = scene.compare(rheonet.loads(SCENE, {"simulate.stop": 1.1}), rheonet.loads(SCENE, {"s1.coulomb": "0.05 N"}))
    assert found.to_xarray()["time"].values[-1] == pytest.approx(1.1, abs=0.004)
    assert found.differences[0]["s1.force"].largest == 0
    assert found.differences[1]["s1.force"].largest == pytest.approx(0.05, rel=1e-9)
    assert found.dissipated[0] == found.dissipated[1] != found.dissipated[2]
    assert found.furthest == max(d.relative for of_scene in found.differences for d in of_scene.values()) >= 0.5
    assert f"relative difference up to {found.furthest:.3g}" in repr(found)


def test_what_cannot_be_compared_is_said(scene):
    other = rheonet.load("other.toml")
    with pytest.raises(ValueError, match="`s1.force` and `a.position` are different quantities"):
        scene.compare(other, pairs={"s1.force": "a.position"})
    with pytest.raises(ValueError, match="names 3 records of 's1.force' for 2 scenes"):
        scene.compare(other, pairs={"s1.force": ["s1.force", "c1.force"]})
    with pytest.raises(rheonet.NetlistError, match="sof.force"):
        scene.compare(other, pairs={"k1.force": "sof.force"})
    with pytest.raises(ValueError, match="start at different times"):
        scene.compare(rheonet.loads(SCENE, {"simulate.start": 0.5}))
    with pytest.raises(ValueError, match="nothing of the same name"):
        scene.compare(rheonet.loads(SCENE, {"simulate.record": ["b.position"]}))
    with pytest.raises(TypeError, match="at least one"):
        scene.compare()


def test_a_scene_that_cannot_be_simulated_has_its_place():
    stuck = rheonet.loads(SCENE.replace('position = { sine = "1 mm", frequency = "1 Hz" }', 'force = "1 N"').replace('"motion"', '"force"').replace("c1 = ", "# "))
    for study in (lambda: stuck.compare(stuck), stuck.effects, stuck.precision, lambda: stuck.plot(), lambda: stuck.report(certify=True)):
        with pytest.raises(rheonet.SimulationError, match="s1"):
            study()


def test_effects_are_those_of_the_command(scene):
    command("effects", "pads.toml", "--runs", "1", "-o", "effects.csv")
    rows, found = csv("effects.csv"), scene.effects(runs=1)
    frame = found.to_dataframe()
    assert found.effects == ["elasticity", "viscosity", "dry_friction"]
    assert list(frame["without"]) == list(rows["without"].fillna(""))
    assert list(frame["record"]) == list(rows["record"])
    for own, theirs in {"largest": "largest_difference", "time": "time", "rms": "rms_difference", "scale": "largest_magnitude", "steps": "steps"}.items():
        np.testing.assert_array_equal(frame[own], rows[theirs])
    # The largest force of the dashpot: 3 N*s/m at 2 pi mm/s, of which nothing is recorded.
    assert found.barest(1e-9).without == ("viscosity",)
    friction = next(model for model in found.each if model.without == ("dry_friction",))
    assert friction.differences["s1.force"].largest == pytest.approx(0.1, rel=1e-9) and friction.relative > 0.4
    assert found.full.relative == 0 and found.full.cpu_seconds > 0


def test_prices_are_those_of_the_command(scene):
    words = ["--accuracies", "1e-3,1e-6", "--runs", "1", "--set", "simulate.record=[\"s1.force\"]"]
    command("precision", "pads.toml", *words, "--variant", "other.toml", "-o", "prices.csv")
    rows = csv("prices.csv")
    scene = rheonet.load("pads.toml", {"simulate.record": ["s1.force"]})
    found = scene.precision([1e-3, 1e-6], runs=1, models={"other.toml": rheonet.load("other.toml")})
    frame = found.to_dataframe()
    assert list(frame["method"]) == list(rows["manner"])
    for own, theirs in {"accuracy": "accuracy", "order": "order", "error": "error", "error s1.force": "error s1.force", "steps": "steps", "rejected_steps": "rejected",
                        "residual_evaluations": "residuals", "jacobian_evaluations": "jacobians", "restarts": "starts"}.items():  # fmt: skip
        np.testing.assert_array_equal(frame[own], rows[theirs])
    assert found.own.accuracy == scene.accuracy and found.cheapest.meets and found.cheapest.cpu_seconds > 0
    assert next(price for price in found.prices if price.method == "other.toml").error > 0.01
    with pytest.raises(ValueError, match="'k1.force', which the scene does not record"):
        scene.precision(pairs={"k1.force": "soft.force"})
    for wrong in ({"accuracies": [1e-15]}, {"runs": 0}):
        with pytest.raises(ValueError, match="from 1e-12|at least 1"):
            scene.precision(**wrong)


def test_figures_are_those_of_the_command(scene):
    command("plot", "pads.toml", "--loop", "s1", "--loop", "c1", "--unit", "mm", "--title", "Loops", "-o", "loops.svg")
    assert scene.plot(loop=["s1", "c1"], units="mm", title="Loops").svg == open("loops.svg").read()
    command("plot", "pads.toml", "-y", "s1.force", "--x-range", "0.2:1", "-o", "force.svg")
    assert scene.plot("s1.force", x_range=(0.2, 1)).svg == open("force.svg").read()
    result = scene.run()
    figure = result.plot(["s1.force", "k1.force"], x="a.position", names=["slider", "spring"])
    assert base64.b64encode(figure.svg.encode()).decode() in figure._repr_html_() and "slider" in figure.svg and "spring" in figure.svg
    figure.save("figure.svg")
    assert open("figure.svg").read() == figure.svg
    with pytest.raises(ValueError, match="saved as .svg or .png"):
        figure.save("figure.pdf")
    with pytest.raises(ValueError, match="did you mean `s1.force`"):
        result.plot("s1.forc")
    with pytest.raises(rheonet.NetlistError, match="did you mean `s1.force`"):
        scene.plot("s1.forc")
    with pytest.raises(ValueError, match="x_range takes two numbers"):
        result.plot(x_range=3)
    with pytest.raises(OSError):
        figure.save("no/folder/figure.svg")


def test_a_figure_on_axes_of_matplotlib(scene):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is missing (Debian: python3-matplotlib)")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    result = scene.run()
    _, ax = pyplot.subplots()
    assert result.plot(["s1.force", "k1.force"], ax=ax) is ax
    spring = ax.get_lines()[1]
    np.testing.assert_array_equal(spring.get_ydata(), result["k1.force"])
    np.testing.assert_array_equal(spring.get_xdata(), result.time)
    assert ax.get_xlabel() == "time [s]" and ax.get_ylabel() == "[N]"
    with pytest.raises(ValueError, match=r"several units \(N, m\) along y"):
        result.plot(ax=ax)


def test_a_report_is_that_of_the_command(scene):
    found = scene.report(title="Pads")
    assert found.failures == [] and found.html.startswith("<!doctype html>") and "Pads" in found.html
    assert "<iframe srcdoc=" in found._repr_html_() and found.html not in found._repr_html_()
    found.save("pads.html")
    assert open("pads.html", encoding="utf-8").read() == found.html
    command("report", "pads.toml", "--title", "Pads", "-o", "command.html")
    page = open("command.html", encoding="utf-8").read()
    # The two differ in the time that the run took, and nowhere else.
    assert abs(len(page) - len(found.html)) < 50
    rows = page[page.index('"kind":"rows"') - 1000 : page.index('"kind":"done"')]
    assert rows in found.html
    wrong = rheonet.loads(SCENE.replace('max = "0.1 N"', 'max = "0.2 N"')).run(accuracy=1e-3).report()
    assert wrong.failures == ["<text>: a claim of its [expect] fails; the report says which"] and '"accuracy":0.001' in wrong.html


def test_ctrl_c_ends_a_study(scene):
    import signal
    import threading
    import time

    slow = rheonet.loads(SCENE, {"simulate.stop": 1e5, "simulate.method": "ida"})
    for study in (lambda: slow.compare(slow), slow.effects, slow.precision):
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        start = time.perf_counter()
        with pytest.raises(KeyboardInterrupt):
            study()
        assert time.perf_counter() - start < 2.5


def test_progress_of_a_study_goes_up(scene):
    seen = []
    slow = rheonet.loads(SCENE, {"simulate.stop": 100})
    slow.precision([1e-3, 1e-6], runs=20, progress=seen.append)
    assert len(seen) > 2 and seen == sorted(seen) and 0 <= seen[0] < seen[-1] <= 1


def test_sensitivities_are_those_of_the_command(scene):
    paths = ["k1.stiffness", "s1.coulomb"]
    printed = command("run", "pads.toml", "--sensitivities", ",".join(paths), "-q", "-o", "rows.csv")
    found = scene.sensitivities(paths)
    assert printed == ""
    rows, data = csv("rows.csv"), found.to_xarray()
    assert (rows["time"] == found.time).all()
    assert found.values == paths and found.units == scene.units
    for record in scene.names:
        for k, path in enumerate(paths):
            assert (rows[f"d({record})/dln {path}"] == found[record][k]).all()
            assert (data[record].sel(value=path).values == found[record][k]).all()
    # Where the slider slips, its force is the Coulomb force: Fc dF/dFc = F. Where it sticks, the force is that of the spring.
    assert np.abs(found["s1.force"][1]).max() == pytest.approx(0.1, rel=1e-8)
    table = found.to_dataframe().set_index(["value", "record"])
    assert table["largest"]["s1.coulomb", "s1.force"] == pytest.approx(0.1, rel=1e-8)
    assert table["error"].max() < 1e-6
    assert "s1.coulomb" in str(found)


def test_sensitivities_are_a_collection_of_records(scene):
    slopes = scene.sensitivities("s1.coulomb")
    assert "s1.force" in slopes and "s1.velocity" not in slopes and 3 not in slopes
    assert list(slopes) == ["a.position", "s1.force", "k1.force"] and len(slopes) == 3


def test_sensitivities_name_what_has_no_derivative(scene):
    with pytest.raises(rheonet.NetlistError, match="k1.stifness"):
        scene.sensitivities("k1.stifness")
    with pytest.raises(ValueError, match="at least one value"):
        scene.sensitivities([])
    with pytest.raises(KeyError, match="was not recorded; recorded: a.position"):
        scene.sensitivities("k1.stiffness")["b.force"]


def test_sensitivities_see_the_changes_of_the_scene(scene):
    changed = rheonet.load("pads.toml", {"s1.coulomb": 0.05})
    assert np.abs(changed.sensitivities("s1.coulomb")["s1.force"]).max() == pytest.approx(0.05, rel=1e-8)
