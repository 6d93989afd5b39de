"""What is wrong is said by an exception whose text would mend it."""

import functools
import os
import pathlib
import resource

import numpy as np
import pytest

import rheonet
from test_scene import FRICTION, OSCILLATOR, endless


@pytest.fixture
def scene():
    return rheonet.loads(FRICTION)


def test_a_wrong_unit_and_an_unknown_path():
    with pytest.raises(rheonet.NetlistError, match="N/m") as error:
        rheonet.load(OSCILLATOR, {"k1.stiffness": "2 kg"})
    assert error.value.file is None and "k1.stiffness=2 kg" in str(error.value)
    with pytest.raises(rheonet.NetlistError, match="nothing is called `k2`"):
        rheonet.load(OSCILLATOR, {"k2.stiffness": 2})
    with pytest.raises(rheonet.NetlistError, match="cannot be read: No such file"):
        rheonet.load("no.toml")
    with pytest.raises(ValueError, match="loads\\(\\) reads a netlist from text"):
        rheonet.load("title = 'A spring'\n[elements]\n")
    with pytest.raises(ValueError, match="must be Unicode text"):
        rheonet.loads("title = '\udcff'")
    with pytest.raises(TypeError, match="a netlist holds numbers, text, lists and dictionaries"):
        rheonet.load(OSCILLATOR, {"k1.stiffness": 2j})


def test_a_wrong_shape(scene):
    for values in (2.0, "2 N/m", np.float64(3), {"sine": 1}):
        with pytest.raises(TypeError, match="the values of 'k1.stiffness' must be a list"):
            scene.sweep({"k1.stiffness": values})
    with pytest.raises(ValueError, match="at least one value"):
        scene.sweep({"k1.stiffness": []})
    with pytest.raises(rheonet.NetlistError) as error:
        scene.sweep({"k1.stiffness": np.ones((2, 2))}, "max(s1.force)")
    assert "in the run with" in error.value.__notes__[0]


def test_wrong_arguments(scene):
    for wrong, kind, text in (
        ({"accuracy": "fine"}, TypeError, "accuracy must be a number"),
        ({"accuracy": 1.0}, ValueError, "from 1e-12 to 0.1"),
        ({"threads": 0}, ValueError, "threads must be at least 1"),
        ({"threads": 1.5}, TypeError, "threads must be a whole number"),
        ({"threads": 10**12}, ValueError, "threads must be at most 2147483647, but is 1000000000000"),
        ({"certify": "no"}, TypeError, "certify must be True or False"),
        ({"progress": 3}, TypeError, "progress must be a function"),
    ):
        with pytest.raises(kind, match=text):
            scene.run(**wrong)
    drawn = {"k1.stiffness": "100:200"}
    for study, kind, text in (
        (lambda: scene.sample(drawn, 4, "max(s1.force)", seed=-1), ValueError, "seed must be at least 0, but is -1"),
        (lambda: scene.sample(drawn, 2.5, "max(s1.force)"), TypeError, "count must be a whole number, but is 2.5"),
        (lambda: scene.sample(drawn, 4, [3]), TypeError, "measure must be text or a list of text, as .*, not .3."),
        (lambda: scene.sample({"k1.stiffness": 3}, 4, "max(s1.force)"), TypeError, "the distribution of 'k1.stiffness' must be text, not 3"),
        (lambda: scene.sample(drawn, 4, "max(s1.force)", correlations={"a,b": 0.5}), TypeError, "the keys of correlations must be pairs of paths"),
        (lambda: scene.sample(drawn, 4, "max(s1.force)", correlations=[0.5]), TypeError, "correlations must be a dictionary"),
        (lambda: scene.sweep({"k1.stiffness": [1]}, jobs=-1), ValueError, "jobs must be at least 1, but is -1"),
        (lambda: scene.sweep({"k1.stiffness": [1]}, jobs="2"), TypeError, "jobs must be a whole number, but is '2'"),
        (lambda: scene.sweep({"k1.stiffness": [1]}, measure=3), TypeError, "measure must be text or a list of text"),
        (lambda: scene.sweep({"k1.stiffness": [1]}, client=3), TypeError, "client must be a dask.distributed.Client, but is 3"),
        (lambda: scene.sweep([1, 2]), TypeError, "changes must be a dictionary, as {.*}, not .1, 2."),
        (lambda: rheonet.loads(FRICTION, ["k1.stiffness=2"]), TypeError, "changes must be a dictionary"),
        (lambda: rheonet.loads(FRICTION, {3: 1}), TypeError, "the keys of changes must be text"),
        (lambda: rheonet.loads(3), TypeError, "the netlist must be text, not 3"),
        (lambda: rheonet.load(3), TypeError, "source must be the path of a file, but is 3"),
        (lambda: scene.precision(1e-3), TypeError, "accuracies must be a list of numbers, as .1e-3, 1e-6., but is 0.001"),
        (lambda: scene.precision(["fine"]), TypeError, "each of accuracies must be a number"),
        (lambda: scene.precision([1e-3], models=[scene]), TypeError, "models must be a dictionary"),
        (lambda: scene.precision([1e-3], variants="all"), TypeError, "variants must be True or False"),
        (lambda: scene.effects(runs=10**12), ValueError, "runs must be at most"),
        (lambda: scene.sensitivities(3), TypeError, "values must be text or a list of text"),
        (lambda: scene.compare(scene, pairs=["s1.force"]), TypeError, "pairs must be a dictionary"),
        (lambda: scene.report(title=3), TypeError, "title must be text, not 3"),
    ):
        with pytest.raises(kind, match=text):
            study()
    for study in (lambda: scene.compare("other.toml"), lambda: scene.report("other.toml"), lambda: scene.precision(models={"x": "other.toml"})):
        with pytest.raises(TypeError, match="expected a Scene, made by load"):
            study()
    with pytest.raises(TypeError, match="unexpected keyword argument 'colour'"):
        scene.plot(colour="red")
    with pytest.raises(ValueError, match="`--log z` names no axes"):
        scene.plot(log="z")


def test_a_full_disk(scene):
    if not pathlib.Path("/dev/full").exists():
        pytest.skip("/dev/full is missing")
    figure, report = scene.plot("s1.force"), scene.report()
    with pytest.raises(OSError, match="No space left"):
        report.save("/dev/full")
    full = pathlib.Path("/dev/full").resolve()
    os.chdir("/")
    with pytest.raises(ValueError, match="saved as .svg or .png"):
        figure.save(full)


@pytest.mark.parametrize("ending", ["svg", "html"])
def test_a_full_disk_leaves_the_earlier_file(scene, tmp_path, monkeypatch, ending):
    monkeypatch.chdir(tmp_path)
    saved = scene.plot("s1.force") if ending == "svg" else scene.report()
    name = f"ü-{ending}.{ending}"
    file = pathlib.Path(name)
    file.write_text("earlier")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    try:
        with pytest.raises(OSError, match="too large") as error:
            saved.save(name)
        with pytest.raises(OSError):
            saved.save(tmp_path / "missing" / name)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert error.value.filename == name
    assert file.read_text() == "earlier" and os.listdir() == [name]
    saved.save(file)
    assert file.read_text(encoding="utf-8") == (saved.svg if ending == "svg" else saved.html)


def test_an_error_in_progress_ends_a_study(scene):
    def fail(_):
        raise ZeroDivisionError("of the caller")

    slow = rheonet.loads(FRICTION, {"simulate.stop": 1e4, "simulate.method": "ida"})
    variants = functools.partial(endless().precision, [1e-4], runs=1, variants=True)
    for study in (slow.run, lambda **more: slow.compare(slow, **more), slow.effects, slow.precision, variants):
        with pytest.raises(ZeroDivisionError, match="of the caller"):
            study(progress=fail)
