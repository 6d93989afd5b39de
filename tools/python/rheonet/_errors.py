"""What goes wrong, and where."""

from typing import NamedTuple


class Diagnostic(NamedTuple):
    """A mistake in a netlist, or a warning."""

    severity: str  #: "error" or "warning"
    file: str | None  #: None for a value of `changes` or a measure, which stand in no file
    line: int | None  #: counts from 1
    column: int | None  #: counts from 1, in characters
    message: str  #: what was found and what was expected
    hint: str  #: the remedy; may be empty
    text: str  #: all of this with an excerpt of the file, as the command `rheonet` prints it


class _Located(Exception):
    """An error with its place in a netlist: the attributes of Diagnostic, for the first of `diagnostics`."""

    def __init__(self, diagnostics):
        self.diagnostics = diagnostics
        first = next(d for d in diagnostics if d.severity == "error")
        self.file, self.line, self.column = first.file, first.line, first.column
        self.message, self.hint = first.message, first.hint

    def __str__(self):
        return "\n".join(diagnostic.text for diagnostic in self.diagnostics)


class NetlistError(_Located, ValueError):
    """A netlist has mistakes. `diagnostics` lists all of them; `file`, `line`, `column`, `message` and `hint` are those of the first."""


class SimulationError(_Located, RuntimeError):
    """A scene cannot be simulated, or its run ended early. `result` holds the rows up to there; the other attributes are those of
    NetlistError. `file`, `line` and `column` are None if the cause is at no place in the netlist."""

    def __init__(self, diagnostics, result):
        super().__init__(diagnostics)
        self.result = result


class NetlistWarning(UserWarning):
    """A likely mistake in a netlist that can be simulated."""


def diagnostics_of(reading):
    return [Diagnostic(**diagnostic) for diagnostic in reading.diagnostics]
