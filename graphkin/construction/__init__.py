"""What a hand draws: steps, their values, marks and words, a folder for each kind."""
