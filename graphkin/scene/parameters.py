"""Parameters: the values that a variant may change, with their ranges and their settings."""

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
from graphkin.text.errors import (
    NO_WORDS,
    Mend,
    Message,
    Problem,
    SceneError,
    Setting,
    joined,
    message,
    verbatim,
)

MOST = 200


def read_parameters(table: Table, findings: Findings) -> dict[str, Parameter]:
    """The parameters of a scene: each is a bare number, or ``{ value, min, max, step }``."""
    parameters: dict[str, Parameter] = {}
    if len(table.raw) > MOST:
        findings.add(
            table.place,
            message("{count} parameters", count=len(table.raw)),
            message("at most {most}", most=MOST),
        )
        return parameters
    for name, raw in table.raw.items():
        place = table.at(name)
        if not is_name(name):
            findings.add(
                place,
                message("no name of a parameter"),
                message("a letter, then letters, digits or _"),
            )
        elif name in RESERVED:
            findings.add(
                place,
                message("{name} has a meaning of its own in expressions", name=name),
                message("another name"),
            )
        else:
            inner = raw if isinstance(raw, dict) else {"value": raw}
            where = place if not isinstance(raw, dict) else f"{place}.value"
            parameters[name] = read_parameter(name, Table(place, inner, findings), where)
    return parameters


def read_parameter(name: str, table: Table, place: str) -> Parameter:
    """One parameter, with its range and its steps checked against its value."""
    value = rational(place, table.take("value"), table.findings) or exact(1)
    least, most, step = (optional(table, key) for key in ("min", "max", "step"))
    table.finish()
    parameter = Parameter(name, value, least, most, step)
    if least and most and plain(least) > plain(most):
        table.wrong(
            "min",
            message("{least} is above max", least=least.text),
            message("at most {most}", most=most.text),
        )
    elif step and plain(step) <= 0:
        table.wrong("step", verbatim(step.text), message("a number above 0"))
    else:
        table.findings.extend(out_of_range(parameter, plain(value), place))
    return parameter


def optional(table: Table, key: str) -> Quantity | None:
    """A bound or a step; None where the key is absent."""
    raw = table.take(key)
    return None if raw is None else rational(table.at(key), raw, table.findings)


def rational(place: str, raw: object, findings: Findings) -> Quantity | None:
    """An exact number without parameters; None, with a problem noted, where it is not one."""
    try:
        read = quantity(raw, "", place)
        value = None if read.uses() else read.number({})
    except UnreadableError as error:
        found = message("nothing") if raw is None else error.found
        comma = isinstance(raw, str) and "," in raw
        hint = Mend(",", ".", message("write a decimal point")) if comma else error.hint
        findings.add(place, found, message("a number"), hint)
        return None
    except SceneError as error:
        findings.extend(error.problems)
        return None
    if isinstance(value, Fraction):
        return read
    text = shown(read.text)
    if isinstance(read.tree, Name) and read.uses():
        found, expected = message("{text} is no number", text=text), message("a number")
    elif read.uses():
        used = ", ".join(sorted(read.uses()))
        found = message("{text} uses {names}", text=text, names=used)
        expected = message("a number, without parameters")
    else:
        found = message("{text} is not rational", text=text)
        expected = message("a whole number, decimal or fraction")
    findings.add(place, found, expected)
    return None


def plain(read: Quantity) -> Fraction:
    """The value of a quantity without parameters."""
    return Fraction(read.number({}))


def out_of_range(parameter: Parameter, value: Fraction, place: str) -> list[Problem]:
    """The problem of a value outside its parameter's range or off its steps, if any."""
    wrong, given = misfit(parameter, value), f"{parameter.name} = {shortest(value)}"
    return (
        [
            Problem(
                place, message("{text} is {found}", text=given, found=wrong), range_words(parameter)
            )
        ]
        if wrong
        else []
    )


def misfit(parameter: Parameter, value: Fraction) -> Message:
    """What is wrong with a value of a parameter, in words; "" for an allowed value."""
    least, most, step = parameter.minimum, parameter.maximum, parameter.step
    if (least and value < plain(least)) or (most and value > plain(most)):
        return message("out of range")
    start = plain(least) if least else plain(parameter.value)
    return message("off the step") if step and (value - start) % plain(step) else NO_WORDS


def range_words(parameter: Parameter) -> Message:
    """The range of a parameter in words: ``n from 1 to 30 in steps of 1``."""
    least, most, step = parameter.minimum, parameter.maximum, parameter.step
    words: list[str] = [parameter.name]
    if least and most:
        bounds = {"least": least.written({}), "most": most.written({})}
        words.append(message("from {least} to {most}", **bounds))
    elif least:
        words.append(message("from {least}", least=least.written({})))
    elif most:
        words.append(message("up to {most}", most=most.written({})))
    if step and least:
        words.append(message("in steps of {step}", step=step.written({})))
    elif step:
        start = parameter.value.written({})
        words.append(message("in steps of {step} from {start}", step=step.written({}), start=start))
    return joined(" ", words)


def set_values(
    parameters: Mapping[str, Parameter], settings: Mapping[str, object], findings: Findings
) -> dict[str, Fraction]:
    """The exact value of each parameter: as written, or as set from outside within its range."""
    values = {name: plain(parameter.value) for name, parameter in parameters.items()}
    for name, raw in settings.items():
        wrong = Findings()
        if name not in parameters:
            expected = listed(parameters) or message("no setting, for the scene has no parameters")
            wrong.add(
                "",
                message("{name} is no parameter", name=shown(name)),
                expected,
                nearest(name, parameters),
            )
        elif (read := rational("", raw, wrong)) is not None:
            values[name] = plain(read)
            wrong.extend(out_of_range(parameters[name], values[name], ""))
        findings.extend(of_setting(name, wrong.problems))
    return values


def of_setting(name: str, problems: Iterable[Problem]) -> Iterator[Problem]:
    """The problems of a setting from outside, attributed to that setting."""
    about = Setting(name)
    return (replace(each, place=about.message, about=(about,)) for each in problems)
