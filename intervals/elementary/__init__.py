"""Elementary functions with proved remainders, one family a file."""
