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
PLATFORM = (
    "ray 0:A 16.57deg|off 0:A 1 72.00mm|name 2 0:D|arc 0:B 68.00mm|arc 2 l:D-E|cut 4 5 /1|"
    "name 6 0:E|arc 2 l:D-F|arc 6 l:E-F|cut 8 9|name 10 0:F|join 0:B 6|join 0:C 10|par 1: 1|"
    "par 1: 12|par 1: 13|perp 1: 1|perp 1: 13|off 1: 14 100.00mm|off 1: 15 60.00mm /1|"
    "perp 20 12|perp 19 D-E|cut 21 22|perp 19 D-F|perp 23 E-F|cut 24 25|off 1: 17 90mm|"
    "par 27 1|off 27 28 100.00mm|perp 29 D-E|cut 21 30|perp 29 D-F|perp 31 E-F|cut 32 33|"
    "off 1: 16 30.00mm|perp 35 13|join 26 34|cut 37 36|name 38 1:F|div 19 29 26 34 38|"
    "name 40 1:D|div 23 31 26 34 38|name 42 1:E"
)
"""The platform on three cylinders, of class III: two trials, the crossing, the ratio."""
RING = (
    "ray 0:O a:1|off 0:O 1 l:O-P|name 2 0:P|off 0:O 1 60.00mm|name 4 0:T1|ray 2 -20deg|"
    "off 2 6 l:P-Q|name 7 0:Q|off 0:O 1 20.00mm|name 9 0:T2|ray 0:O 40deg|off 0:O 11 l:O-S|"
    "name 12 0:S|perp 1: 1|off 1: 14 60mm|name 15 1:P|perp 15 P-Q|perp 1: T1-Q|cut 17 18|"
    "name 19 1:Q|div 15 1: 2 0:T1 9|name 21 1:T2@2|perp 1: O-S|perp 21 T2-S|cut 23 24|"
    "name 25 1:S"
)
"""The planetary gear in a fixed ring: the contact divides the image of the planet's diameter."""
