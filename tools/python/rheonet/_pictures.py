"""Figures and reports, which show themselves in Jupyter."""

import base64
import html
import os
import pathlib
import warnings

from . import _arguments, _rheonet


def image(svg, description):
    """A drawing as HTML. Jupyter would show SVG itself, but pages that nbconvert makes of a notebook strip it."""
    data = base64.b64encode(svg.encode()).decode()
    return f'<img src="data:image/svg+xml;base64,{data}" alt="{html.escape(description)}" style="max-width: 100%">'


def _write(path, content):
    """Replaces a file when the new one is complete: if the disk is full the earlier file stays."""
    error = _rheonet.write_file(os.fsencode(os.path.abspath(path)), content)
    if error:
        raise OSError(error, os.strerror(error), os.fspath(path))


class Figure:
    """A drawing of curves, as `rheonet plot` makes it."""

    def __init__(self, svg):
        """Made by Scene.plot() and Result.plot()."""
        self._svg = svg

    @property
    def svg(self):
        """The drawing as SVG text."""
        return self._svg

    def save(self, path):
        """Writes the drawing to a file: `.svg`, or `.png` where librsvg's `rsvg-convert` is installed. Raises ValueError for
        another ending, OSError if the file cannot be written, and an earlier one stays then, or if `rsvg-convert` is missing."""
        ending = pathlib.Path(path).suffix
        if ending not in (".svg", ".png"):
            raise ValueError(f"a figure is saved as .svg or .png, not as {os.fspath(path)!r}")
        _write(path, self._svg.encode() if ending == ".svg" else _rheonet.png(self._svg))

    def _repr_html_(self):
        return image(self._svg, "figure")

    def __repr__(self):
        return f"<rheonet.Figure: {len(self._svg)} bytes of SVG>"


class Report:
    """One HTML page about one or several scenes, as `rheonet report` makes it. It needs no network."""

    def __init__(self, text, failures):
        """Made by Scene.report() and Result.report()."""
        self._html, self._failures = text, failures

    @property
    def html(self):
        """The page as text."""
        return self._html

    @property
    def failures(self):
        """What a scene did not do as it should, a text for each: a run that ended early, a claim that fails, an accuracy that is not met."""
        return list(self._failures)

    def save(self, path):
        """Writes the page to a file. Raises OSError if it cannot be written; an earlier file stays then."""
        _write(path, self._html.encode())

    def _repr_html_(self):
        return f'<iframe srcdoc="{html.escape(self._html)}" style="width: 100%; height: 80vh; border: 0"></iframe>'

    def __repr__(self):
        return f"<rheonet.Report: {len(self._html)} characters of HTML>"


def _texts(value):
    return [value] if isinstance(value, str) else list(value)


def _range(name, value):
    if value is None:
        return ""
    try:
        low, high = map(float, value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} takes two numbers, the lower one first: {name}=(0, 2.5), not {value!r}") from None
    return f"{low!r}:{high!r}"


def plot_options(y=(), x="", loop=(), flow=(), phase=(), decay=(), units=(), names=(), title="", x_label="", y_label="", x_range=None,
                 y_range=None, log="", magnitudes=False, marks=False, size=None):  # fmt: skip
    """The keywords of plot() as the options of `rheonet plot`."""
    for name, text in {"x": x, "log": log, "title": title, "x_label": x_label, "y_label": y_label}.items():
        _arguments.text(name, text)
    if size is not None and (isinstance(size, str) or len(size) != 2):
        raise ValueError(f"size takes a width and a height: size=(640, 400), not {size!r}")
    lists = {"y": y, "loop": loop, "flow": flow, "phase": phase, "decay": decay, "units": units, "names": names}
    return {name: _texts(value) for name, value in lists.items()} | {
        "x": x, "log": log, "title": title, "x_label": x_label, "y_label": y_label, "magnitudes": magnitudes, "marks": marks,
        "x_range": _range("x_range", x_range), "y_range": _range("y_range", y_range),
        "size": "" if size is None else "x".join(f"{_arguments.number('a length', length):g}" for length in size),
    }  # fmt: skip


def plot(run, name, units, ax, options):
    """The figure of a run's rows, or its curves on the axes `ax` of matplotlib."""
    drawn = run.plot(name, **options)
    for note in drawn.notes:
        warnings.warn(note, stacklevel=4)
    return Figure(drawn.svg) if ax is None else _on_axes(ax, run, units, drawn, options)


def _on_axes(ax, run, units, drawn, options):
    columns = {"time": run.time} | {record: run.column(k) for k, record in enumerate(units)}
    unit = {"time": "s"} | units
    for position, axis in ((1, "x"), (2, "y")):
        found = {unit[curve[position]] for curve in drawn.curves}
        if len(found) > 1:
            raise ValueError(f"one pair of axes has no place for several units ({', '.join(sorted(found))}) along {axis}: choose records by `y`")
    for label, x, y in drawn.curves:
        values = abs(columns[y]) if drawn.magnitudes or options["decay"] else columns[y]
        ax.plot(columns[x], values, "." if options["marks"] else "-", label=label)
    _, x, y = drawn.curves[0]
    several = len(drawn.curves) > 1
    ax.set(
        xlabel=options["x_label"] or f"{x} [{unit[x]}]",
        ylabel=options["y_label"] or (f"[{unit[y]}]" if several else f"{y} [{unit[y]}]"),
        title=options["title"],
        xscale="log" if drawn.logarithmic_x else "linear",
        yscale="log" if drawn.logarithmic_y else "linear",
    )
    if several:
        ax.legend()
    return ax
