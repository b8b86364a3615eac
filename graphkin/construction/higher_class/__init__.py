"""Groups of class III and higher: their closures, and the plans found from two trial plans."""
