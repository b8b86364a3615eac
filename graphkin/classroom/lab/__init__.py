"""Labs: a scene, the rule for each student's data, the limits of fairness, and the rubric."""
