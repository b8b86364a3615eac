"""What drivers move, and how they are drawn."""
