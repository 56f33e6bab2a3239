"""Arguments, progress, signals, files, counts: what commands share."""
