"""The plan of forces: loads, arms, polygons of groups, and Zhukovsky's lever."""
