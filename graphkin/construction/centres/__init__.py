"""Instantaneous centres, poles and inflection circles."""
