"""Groups of class III and higher: trials, closures, and two trial plans."""
