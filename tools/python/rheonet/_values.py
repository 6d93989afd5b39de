"""Values of parameters: as TOML text, and as coordinates of a data set."""

import json
import numbers
import re
from collections.abc import Mapping

import numpy as np

from . import _arguments, _rheonet


def setting(value):
    """A value as after `--set PATH=`, where text stands without quotes."""
    return _arguments.unicode("a value", value) if isinstance(value, str) else toml_value(value)


def toml_value(value):
    if hasattr(value, "tolist"):  # NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Real):
        return repr(value) if isinstance(value, int) and abs(value) < 2**63 else repr(float(value))
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{quoted(str(key))} = {toml_value(item)}" for key, item in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    raise TypeError(f"a netlist holds numbers, text, lists and dictionaries, not {value!r}")


def quoted(text):
    """A string of TOML, which has the escapes of JSON but for pairs of surrogates, and escapes DEL."""
    return json.dumps(_arguments.unicode("a text", text), ensure_ascii=False).replace("\x7f", "\\u007f")


def toml_of(tables):
    """A dictionary as TOML text, one line for each entry of a table, so that messages point to the entry."""
    plain = [f"{quoted(key)} = {toml_value(value)}" for key, value in tables.items() if not isinstance(value, Mapping)]
    for name, table in tables.items():
        if isinstance(table, Mapping):
            plain += [f"[{quoted(name)}]", *(f"{quoted(key)} = {toml_value(value)}" for key, value in table.items())]
    return "\n".join(plain) + "\n"


# As the netlist reads it: a number, a space and a unit, which does not begin with an operator.
quantity = re.compile(r"\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)(?:\s+([^-+*/^<>=!&|?:,.)].*?))?\s*")


def coordinate(path, values):
    """The values of a parameter as an xarray coordinate: numbers if all have the same unit, or are expressions of numbers without a unit, and else
    text."""
    texts = [value for value in values if isinstance(value, str)]
    all_scalar = all(isinstance(value, (str, numbers.Real, np.bool_)) for value in values)
    if not texts and all_scalar:
        return (path, [value if isinstance(value, (bool, np.bool_)) else float(value) for value in values])
    evaluated = [_rheonet.evaluated(text) for text in texts]  # in SI, and whether it has a unit; None for a text that is no number
    if not all_scalar or None in evaluated:
        return (path, [setting(value) for value in values])
    if not any(has_unit for _, has_unit in evaluated):
        in_order = iter(evaluated)
        return (path, [next(in_order)[0] if isinstance(value, str) else float(value) for value in values])
    matches = [quantity.fullmatch(text) for text in texts]
    units = {match and match[2] for match in matches}
    if len(texts) < len(values) or len(units) > 1 or None in units:
        return (path, [setting(value) for value in values])
    return (path, [float(match[1]) for match in matches], {"units": units.pop()})
