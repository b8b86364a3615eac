"""Parameters: the numbers that a variant may change, their ranges, and the values as set."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from msgspec.structs import replace

from graphkin.scene.expression import RESERVED, Name, UnreadableError
from graphkin.scene.findings import Findings, Table, listed, nearest, shown
from graphkin.scene.measures import quantity
from graphkin.scene.model import Parameter
from graphkin.scene.phrases import is_name
from graphkin.scene.quantity import Quantity, exact, shortest
from graphkin.text.errors import Mend, Problem, SceneError, Setting

MOST = 200


def read_parameters(table: Table, findings: Findings) -> dict[str, Parameter]:
    """The parameters of a scene: a bare number, or ``{ value, min, max, step }``."""
    parameters: dict[str, Parameter] = {}
    if len(table.raw) > MOST:
        findings.add(table.place, f"{len(table.raw)} parameters", f"at most {MOST}")
        return parameters
    for name, raw in table.raw.items():
        place = table.at(name)
        if not is_name(name):
            findings.add(place, "no name of a parameter", "a letter, then letters, digits or _")
        elif name in RESERVED:
            findings.add(place, f"{name} has a meaning of its own in expressions", "another name")
        else:
            inner = raw if isinstance(raw, dict) else {"value": raw}
            where = place if not isinstance(raw, dict) else f"{place}.value"
            parameters[name] = read_parameter(name, Table(place, inner, findings), where)
    return parameters


def read_parameter(name: str, table: Table, place: str) -> Parameter:
    """One parameter, with its range and steps checked against its value."""
    value = rational(place, table.take("value"), table.findings) or exact(1)
    least, most, step = (optional(table, key) for key in ("min", "max", "step"))
    table.finish()
    parameter = Parameter(name, value, least, most, step)
    if least and most and plain(least) > plain(most):
        table.findings.add(table.at("min"), f"{least.text} is above max", f"at most {most.text}")
    elif step and plain(step) <= 0:
        table.findings.add(table.at("step"), step.text, "a number above 0")
    else:
        table.findings.extend(out_of_range(parameter, plain(value), place))
    return parameter


def optional(table: Table, key: str) -> Quantity | None:
    """A bound or a step, or None without one."""
    raw = table.take(key)
    return None if raw is None else rational(table.at(key), raw, table.findings)


def rational(place: str, raw: object, findings: Findings) -> Quantity | None:
    """An exact number without parameters; None, with a problem recorded, for anything else."""
    try:
        read = quantity(raw, "", place)
        value = None if read.uses() else read.number({})
    except UnreadableError as error:
        found = "nothing" if raw is None else error.found
        comma = isinstance(raw, str) and "," in raw
        hint = Mend(",", ".", "write a decimal point") if comma else error.hint
        findings.add(place, found, "a number", hint)
        return None
    except SceneError as error:
        findings.extend(error.problems)
        return None
    if isinstance(value, Fraction):
        return read
    says = "is not rational", "a whole number, decimal or fraction"
    if isinstance(read.tree, Name) and read.uses():
        says = "is no number", "a number"
    elif read.uses():
        says = f"uses {', '.join(sorted(read.uses()))}", "a number, without parameters"
    findings.add(place, f"{shown(read.text)} {says[0]}", says[1])
    return None


def plain(read: Quantity) -> Fraction:
    """The value of a quantity without parameters."""
    return Fraction(read.number({}))


def out_of_range(parameter: Parameter, value: Fraction, place: str) -> list[Problem]:
    """The problem of a value outside its parameter's range or off its steps, if any."""
    wrong, given = misfit(parameter, value), f"{parameter.name} = {shortest(value)}"
    return [Problem(place, f"{given} is {wrong}", range_words(parameter))] if wrong else []


def misfit(parameter: Parameter, value: Fraction) -> str:
    """Words for a value that a parameter may not have; empty for any other."""
    least, most, step = parameter.minimum, parameter.maximum, parameter.step
    if (least and value < plain(least)) or (most and value > plain(most)):
        return "out of range"
    start = plain(least) if least else plain(parameter.value)
    return "off the step" if step and (value - start) % plain(step) else ""


def range_words(parameter: Parameter) -> str:
    """The range of a parameter in words: ``n from 1 to 30 in steps of 1``."""
    words = [parameter.name]
    if parameter.minimum:
        words.append(f"from {parameter.minimum.written({})}")
    if parameter.maximum:
        words.append(f"{'to' if parameter.minimum else 'up to'} {parameter.maximum.written({})}")
    if parameter.step:
        start = "" if parameter.minimum else f" from {parameter.value.written({})}"
        words.append(f"in steps of {parameter.step.written({})}{start}")
    return " ".join(words)


def set_values(
    parameters: Mapping[str, Parameter], settings: Mapping[str, object], findings: Findings
) -> dict[str, Fraction]:
    """The exact value of each parameter, as written or as set from outside within its range."""
    values = {name: plain(parameter.value) for name, parameter in parameters.items()}
    for name, raw in settings.items():
        wrong = Findings()
        if name not in parameters:
            expected = listed(parameters) or "no setting, for the scene has no parameters"
            wrong.add("", f"{shown(name)} is no parameter", expected, nearest(name, parameters))
        elif (read := rational("", raw, wrong)) is not None:
            values[name] = plain(read)
            wrong.extend(out_of_range(parameters[name], values[name], ""))
        findings.extend(of_setting(name, wrong.problems))
    return values


def of_setting(name: str, problems: Iterable[Problem]) -> Iterator[Problem]:
    """Problems of values set from outside, with the setting as their place."""
    about = Setting(name)
    return (replace(each, place=str(about), about=(about,)) for each in problems)
