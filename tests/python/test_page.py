"""The examples of tools/python/README.md run, one after the other."""

import os
import pathlib
import re

import rheonet

PAGE = pathlib.Path(__file__).parents[2] / "tools/python/README.md"


def test_every_example_of_the_page_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = PAGE.read_text()
    blocks = re.findall(r"^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert [language for language, _ in blocks].count("python") >= 4
    names = {}
    for language, text in blocks:
        if language == "toml":
            pathlib.Path(text.split()[1]).write_text(text)  # "# pad.toml"
        elif language == "python":
            exec(compile(text, str(PAGE), "exec"), names)
            check_comments(text, names)
    assert os.path.exists("stiff.csv")


def check_comments(text, names):
    """A line "expression  # = value" shows a value."""
    for expression, value in re.findall(r"^([^#\n]+?)  +# = (.*)$", text, re.MULTILINE):
        shown = eval(expression, names)
        assert (f"{shown:.6g}" if isinstance(shown, float) else repr(shown)) == value, expression


def test_the_stubs_name_everything():
    stubs = (PAGE.parent / "rheonet/__init__.pyi").read_text()
    for name in rheonet.__all__:
        assert re.search(rf"\b(def|class) {name}\b", stubs), name
    for public in (rheonet.Scene, rheonet.Result):
        for name in vars(public):
            if not name.startswith("_") or name in ("__getitem__", "__len__", "__iter__"):
                assert re.search(rf"\bdef {name}\b", stubs), name
