"""Why a mechanism does not close, where it does, and which effects its motion has."""
