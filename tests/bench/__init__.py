"""How fast it is, told in ratios against plain code in the same run: python -m tests.bench."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as the command line has it
