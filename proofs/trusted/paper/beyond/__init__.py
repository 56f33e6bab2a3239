"""Beyond the paper: what is asked at any parameters, in rows of the project's own."""
