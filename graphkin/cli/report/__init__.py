"""The output of the commands: records for machines (JSON), aligned text for people."""
