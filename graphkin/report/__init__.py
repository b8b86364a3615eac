"""What the command line says: records for machines (JSON), aligned text for people."""
