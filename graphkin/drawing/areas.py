"""The areas of the paper, in mm with y down: frames, title block, drawings and tables."""

from __future__ import annotations

Rect = tuple[float, float, float, float]
"""Left, top, right and bottom in mm."""

A3_AREA: Rect = (20.0, 10.0, 410.0, 287.0)
"""Inside the frame of an A3 sheet (ISO 5457)."""
TITLE_WIDTH, TITLE_HEIGHT = 180.0, 36.0
A3_TITLE_BLOCK: Rect = (230.0, 251.0, 410.0, 287.0)
A4_SIZE = (210.0, 297.0)
A4_FRAME: Rect = (20.0, 10.0, 200.0, 287.0)
A4_AREA: Rect = (20.0, 18.0, 200.0, 279.0)
"""Between header and footer of an A4 page."""

MARGIN = 15.0
"""Room left and right of a drawing for symbols, ends of lines and labels, in mm."""
ABOVE = 8.5
"""Room above and below a drawing, in mm."""
LEAST_FIELD = 80.0
"""Width that every field has, in mm, so that its caption stands above it in two lines."""
HEADER = 28.0
"""Height of the title, the data and the fields' captions below the frame's upper edge, in mm."""
FOOT = 201.0
"""Where the tables below the drawings begin, in mm from the page's upper edge."""

AREA: Rect = (A3_AREA[0] + 2, A3_AREA[1] + HEADER, A3_AREA[2] - 2, FOOT)
"""The part of the sheet for the mechanism and the plan side by side, below their captions."""
WIDTH, HEIGHT = AREA[2] - AREA[0] - 4 * MARGIN, AREA[3] - AREA[1] - 2 * ABOVE
"""The room for both drawings together, without their margins."""
BELOW: Rect = (AREA[0], FOOT + 2, AREA[2], A3_AREA[3] - 2)
"""The part for steps, tables and check bar."""
SCHEME: Rect = (150.0, 210.0, 226.0, 281.0)
"""The kinematic scheme of a task, right of what is asked and above the centring mark."""
MARKED = (207.0, 276.0)
"""Left of this, or above it, words stay clear of the centring mark at the sheet's lower edge."""
TABLES: Rect = (A3_TITLE_BLOCK[0], FOOT + 2, AREA[2], A3_TITLE_BLOCK[1] - 2)
"""The table above the title block."""
