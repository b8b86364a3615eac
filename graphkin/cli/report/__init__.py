"""What the commands print: records for machines (JSON), aligned text for people."""
