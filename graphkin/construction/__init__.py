"""Everything drawn by hand: steps with their values, marks and words, one folder for each kind."""
