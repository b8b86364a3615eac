"""Drawings made on the board of two labs, with their own data, as the page writes them."""

from __future__ import annotations

VELOCITIES = (
    "ray 0:O1 44deg|off 0:O1 1 60mm|name 2 0:A|arc 2 l:A-B|arc 0:O2 l:O2-B|cut 4 5 /1|"
    "name 6 0:B|arc 2 l:A-C|arc 6 l:B-C|cut 8 9|name 10 0:C|arc 10 l:C-D|cut 12 g:5|"
    "name 13 0:D|perp 1: O1-A|off 1: 15 150mm|name 16 1:A|perp 16 A-B|perp 1: O2-B|"
    "cut 18 19|name 20 1:B|perp 16 A-C|perp 20 B-C|cut 22 23|name 24 1:C|perp 24 C-D|"
    "par 1: g:5|cut 26 27|name 28 1:D"
)
"""The pump and its velocity plan."""
PUMP = VELOCITIES + (
    "|tri 2 O1-A 1:>A|lay 2: 30|name 31 2:A|tri 6 O2-B 1:>B|lay 2: 33|perp 34 O2-B|"
    "tri 6 A-B 1:A>B|lay 31 36|perp 37 A-B|cut 35 38|name 39 2:B|sim 31 39 10|"
    "name 41 2:C|tri 13 C-D 1:C>D|lay 41 43|perp 44 C-D|par 2: g:5|cut 45 46|"
    "name 47 2:D"
)
"""The pump with both plans."""
LEVER = (
    "ray 0:O1 a:1|off 0:O1 1 l:O1-A|name 2 0:A|join 0:O2 2|off 0:O2 4 l:O2-B|"
    "name 5 0:B|arc 5 l:B-C|cut g:5 7|name 8 0:C|perp 1: O1-A|off 1: 10 120mm|"
    "name 11 1:A|perp 1: O2-A|par 11 4|cut 13 14|name 15 1:A@3|sim 1: 15 5 /1|"
    "name 17 1:B|perp 17 B-C|par 1: g:5|cut 19 20|name 21 1:C|tri 2 O1-A 1:>A|"
    "lay 2: 23|name 24 2:A|tri 2 O2-A 1:>A@3|lay 2: 26|perp 27 O2-A|"
    "cor 1.6533rad 1:A@3>A|lay 24 29 /1|par 30 4|cut 28 31|name 32 2:A@3|"
    "sim 2: 32 5 /1|name 34 2:B|tri 8 B-C 1:B>C|lay 34 36|perp 37 B-C|par 2: g:5|"
    "cut 38 39|name 40 2:C"
)
"""The slotted lever with both plans: two pairs of similar triangles, and a Coriolis component."""
