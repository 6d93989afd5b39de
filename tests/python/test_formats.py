"""Tables of the command `rheonet` in formats other than CSV, opened with the tools that people use."""

import io
import os
import re
import signal
import subprocess
import time

import numpy as np
import pandas
import pytest

import rheonet as package

RHEONET = os.environ["RHEONET"]

SCENE = """
title = "let go, from 1 mm"
[elements]
m1 = { type = "mass", at = "a", mass = "1 kg" }
k1 = { type = "spring", between = ["a", "ground"], stiffness = "100 N/m" }
push = { type = "force", at = "a", force = 0 }
[nodes]
a = { position = "1 mm" }
[simulate]
stop = 1
output = { points = 20001 }
record = ["a.position", "k1.force", "k1.power"]
"""


@pytest.fixture
def rheonet(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)

    def call(*words, status=0, file_limit=None):
        command = [RHEONET, *words]
        if file_limit is not None:
            command = ["sh", "-c", f'ulimit -f {file_limit}; exec "$@"', "sh", *command]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
        if "part of rheonet that is missing" in done.stderr:
            pytest.skip(done.stderr)
        assert done.returncode == status, done.stderr
        return done

    call.folder = tmp_path
    return call


def csv(text):
    return pandas.read_csv(io.StringIO(text), float_precision="round_trip")


def netcdf(path):
    pytest.importorskip("netCDF4")
    return pytest.importorskip("xarray").open_dataset(path)


def mat(path):
    return pytest.importorskip("scipy.io").loadmat(path, squeeze_me=True)


def test_netcdf_of_a_run(rheonet):
    rows = csv(rheonet("run", "scene.toml", "-q").stdout)
    rheonet("run", "scene.toml", "-q", "-o", "run.nc")
    data = netcdf(rheonet.folder / "run.nc")
    assert data.title == "let go, from 1 mm"
    assert data.sizes == {"time": 20001}
    assert list(data.variables) == list(rows.columns)
    for name in rows.columns:
        assert (data[name].values == rows[name].values).all()
    assert data.time.units == "s"
    assert data.time.dtype == float  # not decoded as a duration
    assert [data[name].units for name in data.data_vars] == ["m", "N", "W"]


def test_mat_of_a_run(rheonet):
    rows = csv(rheonet("run", "scene.toml", "-q").stdout)
    rheonet("run", "scene.toml", "-q", "-o", "run.mat")
    data = mat(rheonet.folder / "run.mat")
    assert str(data["title"]) == "let go, from 1 mm"
    for name, column in zip(["time", "a_position", "k1_force", "k1_power"], rows.columns):
        assert (data[name] == rows[column].values).all()
    assert list(data["columns"]) == list(rows.columns)
    assert list(data["units"]) == ["s", "m", "N", "W"]


SWEEP = ["sweep", "scene.toml", "--vary", "k1.stiffness=100 N/m,-1 N/m,400 N/m", "push.force={ ramp = 1 },0",
         "--measure", "max(k1.force)", "time of crossing(a.position, 1 m)", "-q"]


def test_tables_of_a_sweep(rheonet):
    rows = csv(rheonet(*SWEEP, status=1).stdout)
    rheonet(*SWEEP, "-o", "sweep.nc", status=1)
    data = netcdf(rheonet.folder / "sweep.nc")
    assert data.sizes == {"run": 6}
    assert list(data.run.values) == [1, 2, 3, 4, 5, 6]
    assert data["k1.stiffness"].units == "N/m"
    assert list(data["k1.stiffness"].values) == [100, 100, -1, -1, 400, 400]
    assert list(data["push.force"].values) == ["{ ramp = 1 }", "0"] * 3
    np.testing.assert_array_equal(data["max(k1.force)"].values, rows["max(k1.force) [N]"].values)
    assert np.isnan(data["time of crossing(a.position, 1 m)"].values).all()
    assert ["must be" in text for text in data.error.values] == [False, False, True, True, False, False]
    rheonet(*SWEEP, "-o", "sweep.mat", status=1)
    table = mat(rheonet.folder / "sweep.mat")
    np.testing.assert_array_equal(table["max_k1_force"], rows["max(k1.force) [N]"].values)
    assert list(table["error"]) == [0, 0, 1, 1, 0, 0]
    assert "must be" in str(table["error_texts"])
    assert [table["push_force_texts"][int(k) - 1] for k in table["push_force"]] == ["{ ramp = 1 }", "0"] * 3


def test_shards_merge_into_other_formats(rheonet):
    rheonet(*SWEEP, "-o", "whole.nc", status=1)
    for k in (1, 2, 3):
        rheonet(*SWEEP, "--shard", f"{k}/3", "-o", f"part-{k}.csv", status=1 if k == 2 else 0)
    rheonet(*SWEEP, "--merge", "part-1.csv", "part-2.csv", "part-3.csv", "-o", "merged.nc", status=1)
    assert netcdf(rheonet.folder / "merged.nc").identical(netcdf(rheonet.folder / "whole.nc"))


@pytest.mark.parametrize("ending", ["nc", "mat"])
def test_a_full_disk_leaves_the_earlier_file(rheonet, ending):
    file = rheonet.folder / f"run.{ending}"
    rheonet("run", "scene.toml", "-q", "-o", file.name)
    earlier = file.read_bytes()
    done = rheonet("run", "scene.toml", "-q", "-o", file.name, status=1, file_limit=20)
    assert f"cannot write to `{file.name}`: File too large" in done.stderr
    assert file.read_bytes() == earlier
    assert not [name for name in os.listdir(rheonet.folder) if name.startswith(".")]


@pytest.mark.parametrize("ending", ["nc", "mat"])
def test_an_interrupted_run_keeps_its_rows(rheonet, ending):
    endless = ["--set", "simulate.stop=1e4", "--set", "simulate.output={ every = 0.001 }"]
    rheonet("run", "scene.toml", "-q", "-o", f"run.{ending}")
    process = subprocess.Popen([RHEONET, "run", "scene.toml", "-q", *endless, "-o", f"run.{ending}"], cwd=rheonet.folder, stderr=subprocess.PIPE, text=True)
    time.sleep(0.7)
    process.send_signal(signal.SIGINT)
    message = process.communicate()[1]
    assert process.returncode == 1
    assert "interrupted" in message
    rows = int(re.search(r"the (\d+) rows up to there", message)[1])
    path = rheonet.folder / f"run.{ending}"
    times = netcdf(path).time.values if ending == "nc" else mat(path)["time"]
    assert len(times) == rows > 100
    np.testing.assert_allclose(times, np.arange(rows) * 0.001, rtol=1e-12)


PULLED = """
[elements]
f1 = { type = "force", at = "a", force = { table = "rows.mat"%s } }
c1 = { type = "dashpot", between = ["a", "ground"], damping = "1 N*s/m" }
[simulate]
stop = 1
output = { points = 11 }
record = ["f1.force"]
"""


def pulled(rheonet, columns, status=0):
    (rheonet.folder / "pulled.toml").write_text(PULLED % columns)
    return rheonet("run", "pulled.toml", "-q", status=status)


def test_a_table_of_a_mat_file_is_that_of_the_csv_file(rheonet):
    rheonet("run", "scene.toml", "-q", "-o", "rows.mat")
    rheonet("run", "scene.toml", "-q", "-o", "rows.csv")
    columns = ', columns = ["time", "k1.force"]'
    from_mat = pulled(rheonet, columns).stdout
    (rheonet.folder / "csv.toml").write_text((PULLED % columns).replace("rows.mat", "rows.csv"))
    assert from_mat == rheonet("run", "csv.toml", "-q").stdout
    assert len(set(from_mat.splitlines())) > 5
    # The columns have units: a position is no force.
    refused = pulled(rheonet, ', columns = ["time", "a.position"]', 2).stderr
    assert "expected a force (N), found a length (m)" in refused
    (rheonet.folder / "pulled.toml").write_text(PULLED % columns)
    in_process = package.load(rheonet.folder / "pulled.toml").run()
    np.testing.assert_array_equal(in_process["f1.force"], csv(from_mat)["f1.force"])


def test_tables_of_mat_files_from_elsewhere(rheonet):
    io_ = pytest.importorskip("scipy.io")
    rheonet("run", "scene.toml", "-q", "-o", "probe.mat")  # skips without the part for MAT files
    t = np.linspace(0, 1, 11)
    io_.savemat(rheonet.folder / "rows.mat", {"t": t, "load": (10 * t).astype("int16"), "remark": "measured", "rate": 50.0})
    rows = csv(pulled(rheonet, ', columns = ["t", "load"]').stdout)
    np.testing.assert_allclose(rows["f1.force"], np.trunc(10 * t), atol=1e-12)
    io_.savemat(rheonet.folder / "rows.mat", {"curve": np.column_stack([t, 3 * t])})
    rows = csv(pulled(rheonet, "").stdout)
    np.testing.assert_allclose(rows["f1.force"], 3 * t, atol=1e-12)
    assert "no column `lod`" in pulled(rheonet, ', columns = ["curve_1", "lod"]', 2).stderr
    assert "curve_1` and `curve_2" in pulled(rheonet, ', columns = ["curve_1", "lod"]', 2).stderr


def test_a_mat_file_that_is_no_table_is_refused(rheonet):
    io_ = pytest.importorskip("scipy.io")
    rheonet("run", "scene.toml", "-q", "-o", "probe.mat")
    io_.savemat(rheonet.folder / "rows.mat", {"remark": "nothing else"})
    assert "it has no vector of numbers" in pulled(rheonet, "", 2).stderr
    (rheonet.folder / "rows.mat").write_text("time,force\n0,1\n")
    assert "`rows.mat` cannot be read: it is no MAT file" in pulled(rheonet, "", 2).stderr
    io_.savemat(rheonet.folder / "rows.mat", {"t": [0.0, 2.0, 1.0], "f": [1.0, 2.0, 3.0]})
    assert "must not decrease" in pulled(rheonet, ', columns = ["t", "f"]', 2).stderr
