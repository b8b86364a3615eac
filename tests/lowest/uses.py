"""What no command of tests.lowest does: arrays, a notebook's figure, a cluster, the studio."""

from __future__ import annotations

from pathlib import Path
from threading import Thread
from urllib.request import urlopen

import numpy as np
from distributed import LocalCluster
from matplotlib.figure import Figure

import graphkin
from graphkin.classroom.printing.workers import CLUSTER, engine
from graphkin.studio.folder import Folder
from graphkin.studio.server import serve
from graphkin.studio.session import Session


def main() -> None:
    """Use what is left; an error ends it."""
    pump = graphkin.load("pump", n=7)
    pump.plot(Figure().add_subplot(), "velocity")
    numbers = np.arange(1, 31)
    singles = [graphkin.load("pump", n=int(n)).solve().points["D"].velocity for n in numbers]
    assert np.allclose(pump.batch(n=numbers).points["D"].velocity, singles)
    streamed = [block.points["D"].velocity for block in pump.stream(n=numbers)]
    assert np.allclose(np.concatenate(streamed), singles)
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster,
        engine(1, CLUSTER + cluster.scheduler_address.removeprefix("tcp://")) as (
            executor,
            workers,
        ),
    ):
        assert workers == 1
        assert executor is not None
        assert executor.submit(abs, -3).result() == 3
    served = serve(Session(Folder(Path())))
    Thread(target=served.server.run, daemon=True).start()
    with urlopen(served.address) as answer:
        assert b"<html" in answer.read()


if __name__ == "__main__":
    main()
