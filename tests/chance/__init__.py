"""Mechanisms of every kind made at random, and three routes to their motion held together."""
