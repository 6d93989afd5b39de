"""Checks of arguments, with messages that say what would be right."""

import numbers
import os
from collections.abc import Iterable, Mapping

import numpy as np


def mapping(name, value, example):
    """A dictionary whose keys are text."""
    if not isinstance(value, Mapping):
        raise TypeError(f"{name} must be a dictionary, as {example}, not {value!r}")
    for key in value:
        if not isinstance(key, str):
            raise TypeError(f"the keys of {name} must be text, as in {example}, not {key!r}")
        unicode(f"a key of {name}", key)
    return value


def text(name, value):
    if not isinstance(value, str):
        raise TypeError(f"{name} must be text, not {value!r}")
    return unicode(name, value)


def unicode(name, value):
    """Text that can be written as UTF-8."""
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{name} must be Unicode text, but is {value!r}") from None
    return value


def texts(name, value, example):
    """One text, or several of them, as a list."""
    found = [value] if isinstance(value, str) else list(value) if isinstance(value, Iterable) else [None]
    if not all(isinstance(one, str) for one in found):
        raise TypeError(f"{name} must be text or a list of text, as {example!r}, not {value!r}")
    return [unicode(name, one) for one in found]


def count(name, value, least=1, most=2**31 - 1):
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{name} must be a whole number, but is {value!r}")
    if not least <= value <= most:
        raise ValueError(f"{name} must be at {'least' if value < least else 'most'} {least if value < least else most}, but is {value!r}")
    return int(value)


def number(name, value):
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} must be a number, but is {value!r}")
    return float(value)


def flag(name, value):
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} must be True or False, but is {value!r}")
    return bool(value)


def accuracy(value, name="accuracy"):
    finest, coarsest = 1e-12, 0.1  # as core/netlist/simulate_table.cpp
    if value is None:
        return None
    found = number(name, value)
    if not finest <= found <= coarsest:
        raise ValueError(f"{name} must be from 1e-12 to 0.1, but is {value!r}")
    return found


def accuracies(value):
    if isinstance(value, (str, Mapping)) or np.ndim(value) != 1:
        raise TypeError(f"accuracies must be a list of numbers, as [1e-3, 1e-6], but is {value!r}")
    return [accuracy(one, "each of accuracies") for one in value]


def progress(value):
    if value is not None and not callable(value):
        raise TypeError(f"progress must be a function of the fraction completed, but is {value!r}")
    return value


def client(value):
    if not all(hasattr(value, name) for name in ("map", "gather", "cancel")):
        raise TypeError(f"client must be a dask.distributed.Client, but is {value!r}")
    return value


def values(path, given):
    """The values of a parameter as a list; text is one value, not a list of characters."""
    if np.ma.is_masked(given):
        raise ValueError(f"the values of {path!r} have masked entries: leave them out, as with compressed()")
    if isinstance(given, (str, Mapping)) or np.ndim(np.asarray(given, dtype=object)) == 0:
        raise TypeError(f"the values of {path!r} must be a list, as [{given!r}], not {given!r}")
    return list(np.asarray(given) if hasattr(given, "__array__") else given)  # an array of xarray would give arrays without dimensions


def correlations(given):
    """Coefficients of pairs as after `--correlate` of the command."""
    example = '{("k1.stiffness", "s1.coulomb"): 0.5}'
    if not isinstance(given, Mapping):
        raise TypeError(f"correlations must be a dictionary, as {example}, not {given!r}")
    for pair in given:
        if not isinstance(pair, tuple) or len(pair) != 2 or not all(isinstance(path, str) for path in pair):
            raise TypeError(f"the keys of correlations must be pairs of paths, as in {example}, not {pair!r}")
    return [f"{one},{other}={number('a correlation', value)!r}" for (one, other), value in given.items()]


def file(name, value):
    """The path of a file as text."""
    try:
        return unicode(name, os.fsdecode(value))
    except TypeError:
        raise TypeError(f"{name} must be the path of a file, but is {value!r}") from None
