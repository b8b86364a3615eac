"""What every kind of construction builds on: program, pen, run, canvas."""
