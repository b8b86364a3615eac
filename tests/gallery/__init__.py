"""Contact sheets of every lab and example scene, and the pictures of the README."""
