"""Each student of a class gets data of his own: assigned, judged as one batch, written down."""
