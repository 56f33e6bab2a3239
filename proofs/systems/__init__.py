"""Published systems, a file each."""
