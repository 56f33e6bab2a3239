"""All that a sceptic reads: on the standard library alone."""
