"""What a cold start takes, beside an interpreter that only imports numpy.

``python -m tests.bench.start`` counts instructions, where valgrind is installed: they do not depend
on what else the machine does. Time of the processor, the least of some runs taken in turn, stands
beside them.
"""

from __future__ import annotations

import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RUNS = 15
STARTS = {
    "python -c pass": ("-c", "pass"),
    "import numpy": ("-c", "import numpy"),
    "import graphkin": ("-c", "import graphkin"),
    "graphkin solve pump": ("-m", "graphkin", "solve", "pump"),
}
PLAIN = "import numpy"
BARE = "import sys; sys.modules['typing_extensions'] = None; import runpy; sys.argv[1:] = "
STARTS["the same, no typing_extensions"] = (
    "-c",
    f"{BARE}['solve', 'pump']; runpy.run_module('graphkin', run_name='__main__')",
)
"""Test tools bring typing_extensions, which msgspec loads where it finds it; users have none."""
COUNT = ("valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null")


def seconds(arguments: tuple[str, ...]) -> float:
    """Time of the processor of one fresh interpreter, its own and the system's."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ran([sys.executable, *arguments])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def instructions(arguments: tuple[str, ...]) -> int:
    """How many instructions one fresh interpreter takes; 0 where none are counted."""
    if shutil.which(COUNT[0]) is None:
        return 0
    found = re.search(r"I\s+refs:\s*([\d,]+)", ran([*COUNT, sys.executable, *arguments]))
    return int(found[1].replace(",", "")) if found else 0


def ran(command: list[str]) -> str:
    """What a command says on its standard error, bytecode kept and compiled before.

    OpenBLAS starts no threads: the instructions in which they wait differ from run to run, up to
    a tenth of what numpy takes.
    """
    env = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    env |= {"PYTHONHASHSEED": "0", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(command, cwd=ROOT, env=env, check=True, capture_output=True, text=True)
    return done.stderr


def table() -> str:
    """Every start, with how many times the one that only imports numpy."""
    least = dict.fromkeys(STARTS, float("inf"))
    for _ in range(RUNS):
        for name, arguments in STARTS.items():
            least[name] = min(least[name], seconds(arguments))
    counted = {name: instructions(arguments) for name, arguments in STARTS.items()}
    lines = []
    for name, count in counted.items():
        times = f"{1e3 * least[name]:6.0f} ms {least[name] / least[PLAIN]:6.2f} ×"
        if count:
            times += f" {count / 1e6:8.1f} million instructions {count / counted[PLAIN]:6.2f} ×"
        lines.append(f"start: {name:32}{times}")
    return "\n".join(lines)


if __name__ == "__main__":
    print(table())
