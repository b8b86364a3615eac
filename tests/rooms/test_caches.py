"""Whoever draws a thousand classes in one process needs no more room than for one."""

from __future__ import annotations

from tests.rooms.sources import SOURCES, read, source

MOST = 4096


def test_no_cache_grows_without_bound():
    sizes = {f"{path.name}:{line}": size for path in SOURCES for line, size in source(path).caches}
    assert len(sizes) > 10
    assert {place: size for place, size in sizes.items() if not 0 < (size or 0) <= MOST} == {}


def test_a_cache_without_bound_is_seen():
    for kept in ("cache", "functools.cache", "lru_cache", "lru_cache()", "lru_cache(maxsize=None)"):
        ((_, size),) = read(f"@{kept}\ndef f(x): return x").caches
        assert size is None
