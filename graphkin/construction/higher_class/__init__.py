"""Groups of class III and higher: where they close, and the plans that two wrong ones give."""
