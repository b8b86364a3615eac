"""The manual: its pages as Markdown, what they explain of each key, and its web site."""
