"""A mechanism ready to construct: its scene, groups and program, and how to run them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from msgspec import Struct
from msgspec.structs import force_setattr

from graphkin import service
from graphkin.construction.compile import Laid, laid, write
from graphkin.construction.core.branches import may_be_numbered
from graphkin.construction.core.program import Program, Target
from graphkin.construction.core.quantities import ASKED, TRAVEL
from graphkin.construction.core.run import StepFailed, Trace, run
from graphkin.construction.core.solution import (
    Solution,
    Verdict,
    gathered,
    product_of_sines,
    row_of,
    rows_of,
    without_touching,
)
from graphkin.numbers.arithmetic import FLOAT, Kind, np
from graphkin.scene import scene_files
from graphkin.scene.link_points import point_of
from graphkin.scene.model import Scene
from graphkin.scene.phrases import in_language
from graphkin.scene.read_scene import read_scene
from graphkin.structure.decomposition import decompose
from graphkin.structure.driver_count import refuse_drivers
from graphkin.structure.groups import CoupledTrain, Group, Higher
from graphkin.text.errors import GraphkinError, Problem, SceneError, Setting, joined, message

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from graphkin.construction.core.solution import ForceSolution
    from graphkin.construction.tape.emitted import BatchRunner
    from graphkin.loops.equilibrium import ForceVerdict
    from graphkin.loops.witness import Check

K = TypeVar("K")
V = TypeVar("V")
Which = Literal["mechanism", "velocity", "acceleration"]
"""The drawings of a mechanism that can be plotted into axes."""

DECIDED = 1e-6
"""The sine of a crossing below which its existence is decided without rounding."""

LOSSY = 1e-11
"""The limit of (product of all sines × evenness)² × smallest sine for rounding errors.

Below this limit rounding may take every digit. In hundreds of hard scenes the value was 1e-16 or
less wherever rounding did so.
"""

EXAMINED = 4096
"""The number of variants that the independent check examines at once."""

STREAMED = 65_536
"""The number of variants of a stream that are run at once."""


def load(name: str | Path, /, **settings: object) -> Mechanism:
    """The mechanism of a shipped lab or a scene file, with parameters set: load("pump", n=7).

    Raises SceneError or StructureError with all mistakes.
    """
    return Mechanism(read_scene(scene_files.find(str(name)), settings))


def wrong_with_structure(scene: Scene) -> tuple[Problem, ...]:
    """The problems that keep the links of a scene from being put together; empty if none."""
    try:
        mechanism = Mechanism(scene)
        write(mechanism.scene, mechanism.groups)
    except GraphkinError as error:
        return error.problems
    return ()


LAST = 6
"""The number of slices and of drawings that a mechanism keeps."""


def kept(memory: dict[K, V], key: K, value: V) -> None:
    """Store a value, and remove the oldest if there are too many."""
    memory[key] = value
    if len(memory) > LAST:
        del memory[next(iter(memory))]


class Mechanism(Struct, frozen=True, dict=True):
    """A scene with its derived data; lengths in m, angles in rad, times in s.

    The scene states the branches of its groups, also where it was ``written`` with the number of a
    closure of links that are grouped otherwise. ``closings`` holds what closes groups of higher
    class in this position, by their links, where a motion has found it; other closures are
    searched for.
    """

    scene: Scene
    closings: Mapping[tuple[str, ...], tuple[Any, ...]] = {}

    def __post_init__(self) -> None:
        if not may_be_numbered(self.scene):
            return
        from graphkin.construction.earlier_branches import in_present_words

        self.__dict__["written"] = self.scene
        force_setattr(self, "scene", in_present_words(self.scene))

    @cached_property
    def written(self) -> Scene:
        """The scene as it was written."""
        return self.scene

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """Driven links and Assur groups in the order of construction."""
        groups = decompose(self.scene)
        refuse_drivers(self.scene, groups)
        return groups

    @cached_property
    def laid(self) -> Laid:
        """The groups as they are drawn in the scene's position, and their construction."""
        return laid(self.scene, self.groups)

    @cached_property
    def program(self) -> Program:
        """The construction, step by step, of everything that can be asked."""
        return self.laid[1]

    @cached_property
    def with_forces(self) -> Mechanism:
        """The mechanism with the plan of forces after its motion; itself where none is drawn."""
        if self.scene.forces is None:
            return self
        from graphkin.construction.forces.force_plan import force_program, undrawn

        groups = self.laid[0]
        if undrawn(self.scene, groups) is not None:
            return self
        found = Mechanism(self.scene)
        whole = force_program(self.scene, self.program, groups)
        found.__dict__.update(groups=self.groups, laid=(groups, whole), with_forces=found)
        return found

    @cached_property
    def press(self) -> BatchRunner:
        """The runner of the program for many variants at once."""
        from graphkin.construction.tape.emitted import BatchRunner

        return BatchRunner(self.program)

    @cached_property
    def is_of_higher_class(self) -> bool:
        """Whether a group is closed by trial; only then the code for such groups is loaded."""
        return any(isinstance(group, CoupledTrain | Higher) for group in self.groups)

    @cached_property
    def trial_rates(self) -> Mapping[int, float]:
        """The trial rates in the auxiliary plans of groups of higher class, by step."""
        if not self.is_of_higher_class:
            return {}
        from graphkin.construction.higher_class.trial_rates import trial_rates

        return trial_rates(self.scene, self.program, self.closed)

    @cached_property
    def closed(self) -> Mapping[int, tuple[Any, ...]]:
        """The steps of groups of higher class whose closings are known, with these closings."""
        if not self.closings:
            return {}
        from graphkin.construction.core.kind import constructions
        from graphkin.construction.higher_class.closed_group import ClosedGroup

        groups = constructions(self.program, ClosedGroup)
        known = (each for each in groups if each.closes in self.closings)
        return {each.closing: self.closings[each.closes] for each in known}

    @cached_property
    def check(self) -> Check:
        """The independent check, whose loop equations are written only once."""
        from graphkin.loops.witness import Check

        return Check(self.scene)

    @cached_property
    def sliced(self) -> dict[tuple[tuple[Target, ...], bool], tuple[int, ...]]:
        """The steps needed by the targets requested last, by targets and ``by_hand``."""
        return {}

    @cached_property
    def drawings(self) -> dict[tuple[int, ...], Trace]:
        """The last traces, by their steps, each at its own scale of velocities."""
        return {}

    def steps_of(self, targets: tuple[Target, ...], by_hand: bool) -> tuple[int, ...]:
        """The steps that targets need, computed once."""
        key = targets, by_hand
        if key not in self.sliced:
            kept(self.sliced, key, self.program.needed(targets, by_hand=by_hand))
        return self.sliced[key]

    def spoken(self, language: str | None) -> Mechanism:
        """The mechanism with its links named in a language; in the scene's own if None."""
        scene = in_language(self.scene, language or self.scene.sheet.language)
        return self if scene is self.scene else Mechanism(scene)

    @cached_property
    def measured(self) -> Mechanism:
        """The mechanism computed in the unit of its results, such as inches; its own in metres."""
        scene = self.scene.computed_in(self.scene.unit_of_results)
        return self if scene is self.scene else Mechanism(scene)

    def asked(self) -> tuple[Target, ...]:
        """The targets that the scene asks for; all targets if it asks for nothing.

        A scene that asks for forces alone asks for the motions from which they follow.
        """
        wanted = [
            (quantity.target, point_of(self.scene, name))
            for key, some in ASKED.items()
            for name in getattr(self.scene.ask, key)
            for quantity in some
            if quantity not in TRAVEL
        ]
        wanted = wanted or self.for_forces() or list(self.program.answers)
        wanted += self.forces_asked()
        return tuple(target for target in wanted if self.gives(target))

    def forces_asked(self) -> list[Target]:
        """The reactions and balances that the scene asks for, where the program draws them."""
        given = self.scene.forces
        if given is None or not given.asked or not self.program.reactions:
            return []
        from graphkin.construction.forces.loads import is_asked

        return [target for target in self.program.targets if is_asked(self.scene, given, target)]

    def for_forces(self) -> list[Target]:
        """The motions from which the asked forces follow; none where no force is asked."""
        given = self.scene.forces
        if given is None or not given.asked:
            return []
        every = (each for each in given.motions() if each[1] not in self.scene.fixed_points)
        return [target for target in dict.fromkeys(every) if self.gives(target)]

    def gives(self, target: Target) -> bool:
        """Whether the program constructs a quantity."""
        return target in self.program.targets

    def trace(
        self,
        targets: Iterable[Target] | None = None,
        *,
        by_hand: bool = False,
        seconds: float | None = None,
        kind: Kind = FLOAT,
        aside: bool = True,
    ) -> Trace:
        """Every value that the targets need (all targets if None), for this one scene.

        ``by_hand`` runs the drawn steps too, with velocities drawn on the mechanism at the scale
        ``seconds`` = kL/kv. Auxiliary plans that nobody sees (not ``aside``) have any trial rates.
        ``kind`` is the kind of numbers (see kinds). Raises ClosureError for a step that cannot be
        drawn.
        """
        program = self.program
        wanted = program.answers if targets is None else tuple(targets)
        needed = self.steps_of(wanted, by_hand)
        overrides = {} if seconds is None or program.seconds is None else {program.seconds: seconds}
        overrides |= self.trial_rates if by_hand and aside else {}
        try:
            if kind is FLOAT:
                trace = self.in_doubles(needed, overrides, by_hand)
            else:
                with kind.working():
                    values = self.scene.values_in(kind)
                    trace = run(program, needed, values, kind, overrides=overrides)
        except StepFailed as failed:
            explained = service("does_not_close")(self.scene, program, needed, failed)
            raise explained from failed
        if kind is FLOAT and min(trace.margins.values(), default=1.0) < DECIDED:
            service("refuse_touching")(self.scene, trace)
        return trace

    def in_doubles(
        self, needed: tuple[int, ...], overrides: Mapping[int, Any], by_hand: bool
    ) -> Trace:
        """The values of some steps in doubles, starting from the last drawing.

        For groups closed by trial, only a drawing of the same steps by hand is reused. Raises
        StepFailed.
        """
        program, begun = self.program, self.drawings.get(needed)
        if not self.is_of_higher_class:
            begun = begun or next(reversed(self.drawings.values()), None)
            values = self.scene.values
            trace = run(program, needed, values, FLOAT, overrides=overrides, begun=begun)
        else:
            from graphkin.construction.higher_class.closure_solver import run_settled

            begun = begun if by_hand else None
            overrides = {**self.closed, **overrides}
            trace = run_settled(self.scene, program, needed, overrides=overrides, begun=begun)
        if by_hand or not self.is_of_higher_class:
            kept(self.drawings, needed, trace)
        return trace

    def solve(self, *, asked: bool = False) -> Solution:
        """The motion of every point and link, or only what the scene asks for."""
        trace = self.trace(self.asked() if asked else None)
        return gathered(trace, self.scene.links)

    def witness(self, solution: Solution, *, numbered: bool = True) -> Verdict:
        """The verdict of the independent check on a solution of this scene.

        Without ``numbered`` it does not count all closures of groups of class III and higher. The
        count shows whether the stated closure is drawn, and takes longer than everything else.
        """
        return self.check.compare(solution, numbered=numbered)

    def forces(self) -> tuple[ForceSolution, ForceVerdict] | None:
        """Reactions and balance with the verdict of two independent routes; None without forces.

        Groups without a construction of their reactions have those of all equations at once. Raises
        StructureError where equilibrium does not determine the reactions, and for belts.
        """
        given = self.scene.forces
        if given is None:
            return None
        from graphkin.construction.core.solution import reactions_of
        from graphkin.loops.equilibrium import (
            by_equations,
            by_power_alone,
            compare_forces,
            equilibrium,
        )

        trace, whole = self.trace(), self.with_forces
        solution = gathered(trace, self.scene.links)
        motion = self.check.examine(solution, numbered=0).solved.motion
        here = equilibrium(self.scene, given, motion)
        if whole is self:
            verdict = by_power_alone(self.scene, given, motion, here)
            return by_equations(self.scene, motion, here), verdict
        found = reactions_of(whole.program, self.scene.values, trace)
        return found, compare_forces(self.scene, given, motion, here, found)

    def batch(
        self,
        *,
        asked: bool = False,
        kind: str = "float64",
        **parameters: Any,
    ) -> Solution:
        """The motion of many variants at once, each parameter a number or an array of one length.

        The solution has NaN where a mechanism does not close, and where two loci only touch: below
        a sine of crossing of 8·sqrt(eps) no digit of a velocity is correct. In float64 it also has
        NaN for every quantity of which flat crossings leave no digit sure, by the same check as
        ``witness``. Values between a parameter's steps are allowed, for sweeps. ``kind`` names the
        numbers: float32, float64 or longdouble.

        Raises SceneError for a name that is no parameter of the scene, for values outside a
        parameter's range, and for arrays of several dimensions or different lengths.
        """
        return self.run_many(self.entered(parameters), asked, kind)

    def stream(
        self,
        *,
        asked: bool = False,
        kind: str = "float64",
        block: int = STREAMED,
        **parameters: Any,
    ) -> Iterator[Solution]:
        """As ``batch``, but in blocks of ``block`` variants, for results that are summed up.

        Only one block is held in memory, however many variants there are. Raises as ``batch`` does,
        before the first block.
        """
        given = self.entered(parameters)
        size = max((len(array) for array in given.values()), default=1)
        return (
            self.run_many(
                {name: array[start : start + block] for name, array in given.items()},
                asked,
                kind,
            )
            for start in range(0, size, block)
        )

    def entered(self, parameters: Mapping[str, Any]) -> dict[str, Any]:
        """Parameters as arrays of floats of one length. Raises SceneError as ``batch`` does."""
        strangers = sorted(set(parameters) - set(self.scene.values))
        if strangers:
            known = joined(", ", self.scene.values) or message("none: the scene has no parameters")
            raise SceneError(
                [Problem(name, message("is no parameter"), known) for name in strangers]
            )
        arrays = {name: np.atleast_1d(value) for name, value in parameters.items()}
        refuse_shapes(arrays)
        strange = [name for name, array in arrays.items() if array.dtype.kind not in "iuf"]
        if strange:
            raise SceneError(
                [
                    Problem(name, message("holds what is no number"), message("real numbers"))
                    for name in strange
                ]
            )
        alike = np.broadcast_arrays(*arrays.values())
        floats = [np.asarray(array, dtype=float) for array in alike]
        given = dict(zip(parameters, floats, strict=True))
        refuse_out_of_range(self.scene, given)
        return given

    def run_many(self, given: Mapping[str, Any], asked: bool, kind: str) -> Solution:
        """The motion of variants whose parameters are arrays of floats."""
        values = {**self.scene.values, **given}
        targets = self.asked() if asked else self.program.answers
        needed = self.program.needed(targets)
        keep = [self.program.targets[target] for target in targets]
        with np.errstate(all="ignore"):
            if kind == "float64":
                trace = self.press.run(needed, values, keep, margins="least")
            else:
                from graphkin.construction.core.run import run_blocks
                from graphkin.numbers.kinds import array_kind

                numbers = array_kind(kind)
                trace = run_blocks(self.program, needed, values, numbers, keep, margins=True)
        solution = gathered(without_touching(trace), self.scene.links)
        if kind != "float64":
            return solution
        return self.sure(solution, values, product_of_sines(trace))

    def sure(self, solution: Solution, values: Mapping[str, Any], sines: Any) -> Solution:
        """A batch with NaN where no digit of a quantity is sure, by the independent check.

        The check runs only where rounding may take every digit: where crossings are very flat
        (``sines`` is the product of their sines), or the lengths of the scene very unequal.
        """
        count = max(np.size(value) for value in values.values()) if values else 1
        with np.errstate(all="ignore"):
            losing = (sines * self.evenness) ** 2 * solution.margin
        flat = np.flatnonzero(np.broadcast_to(losing, count) < LOSSY)
        if not flat.size:
            return solution
        from graphkin.loops.differences import sure_of
        from graphkin.loops.witness import examine

        unsure: dict[str, Any] = {}
        for start in range(0, flat.size, EXAMINED):
            rows = flat[start : start + EXAMINED]
            some = {name: row_of(value, rows) for name, value in values.items()}
            for name, lost in examine(self.scene, rows_of(solution, rows), some).unsure.items():
                unsure.setdefault(name, np.zeros(count, dtype=bool))[rows] = lost
        return sure_of(solution, unsure)

    @cached_property
    def evenness(self) -> float:
        """The shortest length of the mechanism divided by its longest."""
        from graphkin.loops.differences import evenness

        return evenness(self.scene)

    def plot(self, ax: Axes, which: Which = "velocity", **options: Any) -> Axes:
        """Draw the mechanism or one of its plans into axes of matplotlib (see notebook.plot)."""
        drawn: Axes = service("plot")(self, ax, which, **options)
        return drawn

    def _repr_svg_(self) -> str:
        """The first sheet as SVG, for a notebook."""
        return str(service("picture")(self))


def refuse_shapes(arrays: Mapping[str, NDArray[Any]]) -> None:
    """Raise SceneError for arrays that do not hold one number for each variant."""
    problems = [
        Problem(
            name,
            message("an array of {ndim} dimensions", ndim=array.ndim),
            message("one number for each variant"),
        )
        for name, array in arrays.items()
        if array.ndim > 1
    ]
    sizes = {n: len(array) for n, array in arrays.items() if array.ndim == 1 and array.size != 1}
    longest = max(sizes, key=lambda name: sizes[name], default="")
    problems += [
        Problem(
            name,
            message(
                "{size} values beside {other} of {longest}",
                size=size,
                other=sizes[longest],
                longest=longest,
            ),
            message("as many, or one"),
        )
        for name, size in sizes.items()
        if size != sizes[longest]
    ]
    if problems:
        raise SceneError(problems)


def refuse_out_of_range(scene: Scene, given: Mapping[str, Any]) -> None:
    """Raise SceneError for every parameter with values outside the scene's range."""
    problems = []
    for name, array in given.items():
        parameter = scene.parameters.get(name)
        if parameter is None:
            continue
        for bound, is_low in ((parameter.minimum, True), (parameter.maximum, False)):
            if bound is None:
                continue
            limit = float(bound.number({}))
            outside = array[(array < limit) if is_low else (array > limit)]
            if outside.size:
                found = message(
                    "{size} values outside the range, such as {example:g}",
                    size=outside.size,
                    example=outside.flat[0],
                )
                words = message(
                    "at least {limit:g}" if is_low else "at most {limit:g}", limit=limit
                )
                place = message("parameter {name}", name=name)
                problems.append(Problem(place, found, words, about=(Setting(name),)))
    if problems:
        raise SceneError(problems)
