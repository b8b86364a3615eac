"""What each further scope of what is asked costs: position : + velocity : + acceleration.

``python -m tests.bench.effects``. Of one point or link of some scenes: the steps, the time on one
scene, the time of a variant of a batch and the most bytes that it needs, each as a ratio to the
position's own, in one run.
"""

from __future__ import annotations

import timeit
import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from msgspec.structs import replace

from graphkin.mechanism import Mechanism, load
from graphkin.scene.model import Ask

ROOT = Path(__file__).resolve().parents[2]
VARIANTS = 20_000
SCENES = {
    "pump": ("D", "n", (1.0, 30.0)),
    "examples/scenes/oscillating-slide.toml": ("E", "angle", (10.0, 60.0)),
    "examples/scenes/gears-planet.toml": ("Q", "angle", (10.0, 60.0)),
    "examples/scenes/excavator-absolute.toml": ("C", "", (0.0, 0.0)),
}
"""Scenes, the point that is asked, and the parameter that a batch sweeps, if there is one."""


@dataclass(frozen=True, slots=True)
class Cost:
    """Steps, seconds of one scene, seconds and bytes of a variant; None without a parameter."""

    steps: int
    scalar: float
    variant: float | None
    room: float | None


def scopes(point: str) -> dict[str, Ask]:
    """What is asked, more each time."""
    return {
        "position": Ask(curves=(point,)),
        "+ velocity": Ask(velocity=(point,)),
        "+ acceleration": Ask(velocity=(point,), acceleration=(point,)),
        "everything": Ask(),
    }


def cost(mechanism: Mechanism, parameter: str, span: tuple[float, float]) -> Cost:
    """What one scope costs."""
    asked = mechanism.asked()
    steps = len(mechanism.program.needed(asked))
    scalar = usual(lambda: mechanism.trace(asked), 200)
    if not parameter:
        return Cost(steps, scalar, None, None)
    values = {parameter: np.linspace(*span, VARIANTS)}
    variant = usual(lambda: mechanism.batch(asked=True, **values), 3) / VARIANTS
    tracemalloc.start()
    mechanism.batch(asked=True, **values)
    room = tracemalloc.get_traced_memory()[1] / VARIANTS
    tracemalloc.stop()
    return Cost(steps, scalar, variant, room)


def usual(work: Callable[[], object], calls: int, rounds: int = 9) -> float:
    """Median time of one call in seconds, the first left out."""
    work()
    return median(timeit.repeat(work, number=calls, repeat=rounds)) / calls


def costs(name: str) -> dict[str, Cost]:
    """What each scope of a scene costs."""
    point, parameter, span = SCENES[name]
    found = load(str(ROOT / name) if "/" in name else name)
    return {
        scope: cost(Mechanism(replace(found.scene, ask=ask)), parameter, span)
        for scope, ask in scopes(point).items()
    }


def table(names: tuple[str, ...] = tuple(SCENES)) -> str:
    """Steps, and times and room as ratios to those of the position alone."""
    lines = [
        f"{'scope of what is asked':34}{'steps':>6}{'one scene':>12}{'':8}"
        f"{'a variant':>12}{'':8}{'its room':>12}"
    ]
    for name in names:
        found = costs(name)
        first = found["position"]
        for scope, each in found.items():
            cells = f"{each.steps:6d}{each.scalar * 1e6:9.1f} µs{each.scalar / first.scalar:6.2f} ×"
            if each.variant and first.variant and each.room and first.room:
                cells += f"{each.variant * 1e9:9.1f} ns{each.variant / first.variant:6.2f} ×"
                cells += f"{each.room:9.0f} B {each.room / first.room:6.2f} ×"
            lines.append(f"{Path(name).stem + ', ' + scope:34}{cells}")
    return "\n".join(lines)


if __name__ == "__main__":
    print(table())
