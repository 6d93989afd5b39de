"""Tables of the command `rheonet` in formats other than CSV, opened with the tools that people use."""

import io
import os
import random
import re
import resource
import signal
import struct
import subprocess
import time
import zlib

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


def savemat(path, data, **options):
    pytest.importorskip("scipy.io").savemat(path, data, **options)


def measured():
    """Variables as SciPy writes them, of which `n`, `load`, and the columns of `curve` are a table."""
    return {"n": np.arange(5), "load": np.array([1.5, -2, 3, 4e30, 0]), "curve": np.arange(10.0).reshape(5, 2), "remark": "text", "s": {"a": 1, "b": "x"}}


def in_process(rheonet, contents, columns=', columns = ["n", "load"]'):
    """The values of the table, or the message."""
    (rheonet.folder / "rows.mat").write_bytes(contents)
    try:
        return package.loads(PULLED % columns, folder=rheonet.folder).run()["f1.force"].tolist()
    except package.NetlistError as error:
        return str(error)


def variable_ends(contents):
    """Where a file may be cut without a trace: after each variable."""
    ends = [128]
    while ends[-1] < len(contents):
        ends.append(ends[-1] + 8 + struct.unpack_from("<I", contents, ends[-1] + 4)[0])
    return ends


@pytest.mark.parametrize("compressed", [False, True])
def test_a_mat_file_that_is_cut_is_refused(rheonet, compressed):
    savemat(rheonet.folder / "rows.mat", measured(), do_compression=compressed)
    contents = (rheonet.folder / "rows.mat").read_bytes()
    for size in set(range(len(contents))) - set(variable_ends(contents)):
        said = in_process(rheonet, contents[:size])
        assert isinstance(said, str), size
        assert ("is damaged or cut" if size > 128 else "cannot be read") in said, size


def test_a_mat_file_of_rheonet_that_is_cut_anywhere_is_refused(rheonet):
    rheonet("run", "scene.toml", "-q", "--set", "simulate.output={ points = 5 }", "-o", "rows.mat")
    contents = (rheonet.folder / "rows.mat").read_bytes()
    columns = ', columns = ["time", "k1.force"]'
    assert len(in_process(rheonet, contents, columns)) == 11
    for size in range(len(contents)):
        said = in_process(rheonet, contents[:size], columns)
        assert isinstance(said, str) and "cannot be read" in said, size


@pytest.mark.parametrize("compressed", [False, True])
def test_a_mat_file_with_a_changed_byte_keeps_its_rows_or_is_refused(rheonet, compressed):
    savemat(rheonet.folder / "rows.mat", measured(), do_compression=compressed)
    contents = (rheonet.folder / "rows.mat").read_bytes()
    whole = in_process(rheonet, contents)
    drawn = random.Random(1)
    read = 0
    # A column that is no longer one, as its class or name is another, is named in the message, and all others keep 5 rows.
    for at in range(116, len(contents)):
        for value in {0, 1, 0x7F, 0xFF, drawn.randrange(256)} - {contents[at]}:
            said = in_process(rheonet, contents[:at] + bytes([value]) + contents[at + 1:])
            read += isinstance(said, list)
            if isinstance(said, list):
                assert len(said) == 11
                assert not compressed or said == whole, (at, value)  # zlib has a check sum
            else:
                assert any(text in said for text in ("cannot be read", "no column `", "decrease", "finite")), (at, value, said)
    assert compressed or read > 100


def test_numbers_of_all_classes_in_mat_files(rheonet):
    for kind in ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"):
        for options in ({}, {"do_compression": True}):
            savemat(rheonet.folder / "rows.mat", {"n": np.arange(2, dtype=kind), "load": np.array([7, 107], dtype=kind)}, **options)
            np.testing.assert_allclose(in_process(rheonet, (rheonet.folder / "rows.mat").read_bytes()), np.linspace(7, 107, 11), rtol=1e-12)
    savemat(rheonet.folder / "rows.mat", {"n": np.arange(2), "load": np.array([False, True])})
    np.testing.assert_allclose(in_process(rheonet, (rheonet.folder / "rows.mat").read_bytes()), np.linspace(0, 1, 11), atol=1e-12)


def test_a_mat_file_with_the_other_byte_order(rheonet):
    def element(kind, data):
        return struct.pack(">II", kind, len(data)) + data + bytes(-len(data) % 8)

    def vector(name, numbers):
        size = element(5, struct.pack(">ii", len(numbers), 1))
        word = struct.pack(">HH4s", len(name), 1, name)  # a small element
        return element(14, element(6, struct.pack(">II", 6, 0)) + size + word + element(9, struct.pack(f">{len(numbers)}d", *numbers)))

    header = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack(">H", 0x0100) + b"MI"
    contents = header + vector(b"n", [0, 1]) + vector(b"load", [7, 9])
    np.testing.assert_allclose(in_process(rheonet, contents), np.linspace(7, 9, 11), rtol=1e-12)
    packed = zlib.compress(vector(b"load", [7, 9]))
    contents = header + vector(b"n", [0, 1]) + struct.pack(">II", 15, len(packed)) + packed
    np.testing.assert_allclose(in_process(rheonet, contents), np.linspace(7, 9, 11), rtol=1e-12)


def test_a_mat_file_that_claims_gigabytes_is_refused(rheonet):
    def bomb(claimed, rows, columns):
        head = struct.pack("<II", 14, claimed) + struct.pack("<IIII", 6, 8, 9, 0) + struct.pack("<IIii", 5, 8, rows, columns)
        packer = zlib.compressobj(9)
        packed = packer.compress(head + struct.pack("<HH4s", 1, 1, b"n") + struct.pack("<II", 2, rows * columns))
        packed += b"".join(packer.compress(bytes(1 << 20)) for _ in range(160)) + packer.flush()
        return b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM" + struct.pack("<II", 15, len(packed)) + packed

    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # kB
    size = 160 << 20
    assert "too few for the size" in in_process(rheonet, bomb(0xFFFFFFF8, 1, size))
    assert "of a different size" in in_process(rheonet, bomb(1 << 20, 1, size))
    assert "too large for a table" in in_process(rheonet, bomb(48 + size, 1, size))
    assert "too large for a table" in in_process(rheonet, bomb(48 + size, 2, size // 2))
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 600_000


def test_mat_files_of_level_4_and_netcdf_files_are_refused(rheonet):
    savemat(rheonet.folder / "old.mat", {"t": np.arange(3.0), "f": np.arange(3.0)}, format="4")
    assert "it is a MAT file of level 4; save it as level 5" in in_process(rheonet, (rheonet.folder / "old.mat").read_bytes())
    for contents in (b"\x89HDF\r\n\x1a\n" + bytes(100), b"CDF\x01" + bytes(100)):
        (rheonet.folder / "rows.nc").write_bytes(contents)
        (rheonet.folder / "pulled.toml").write_text((PULLED % "").replace("rows.mat", "rows.nc"))
        said = rheonet("run", "pulled.toml", "-q", status=2).stderr
        assert "pulled.toml:3:52: error: `rows.nc` is a NetCDF or HDF5 file, but tables are read from CSV and MAT files" in said
        done = rheonet("sweep", "scene.toml", "--list", "rows.nc", "-q", status=2)
        assert "`--list rows.nc` is a NetCDF or HDF5 file" in done.stderr
