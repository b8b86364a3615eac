"""Points that slide on what turns: coincident points and the Coriolis component."""
