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
    for public in (getattr(rheonet, name) for name in rheonet.__all__):
        if not isinstance(public, type):
            continue
        stub = re.search(rf"^class {public.__name__}\b.*?(?=^\S)", stubs + "\nend", re.MULTILINE | re.DOTALL)[0]
        for name in vars(public) | getattr(public, "__annotations__", {}):
            if not name.startswith("_") or name in ("__getitem__", "__len__", "__iter__"):
                assert re.search(rf"\bdef {name}\(|^    {name}:", stub, re.MULTILINE), f"{public.__name__}.{name}"


def test_everything_public_has_a_docstring():
    for public in (getattr(rheonet, name) for name in rheonet.__all__):
        assert public.__doc__, public
        for name, member in vars(public).items() if isinstance(public, type) else ():
            if not name.startswith("_") and (callable(member) or isinstance(member, property)):
                assert member.__doc__, f"{public.__name__}.{name}"
