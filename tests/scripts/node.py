"""Node and its tools beside this file, where they are installed."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TOOLS = HERE / "node_modules" / ".bin"


def missing_tools() -> str:
    """What is missing to run Node's tools here; empty if nothing is."""
    if shutil.which("node") is None:
        return "Node is not installed"
    if not TOOLS.is_dir():
        return f"Node's tools are not installed: npm ci --prefix {HERE.relative_to(ROOT)}"
    return ""


def ran(*command: str) -> subprocess.CompletedProcess[str]:
    """A command of Node's tools, run at the root of the repository."""
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
