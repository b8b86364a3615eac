"""Why a mechanism does not close, where it closes, and which effects its motion contains."""
