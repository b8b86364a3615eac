"""A lab: a scene, the rule that gives each student other data, what is fair, what earns marks."""
